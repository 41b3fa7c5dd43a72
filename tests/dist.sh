#!/bin/sh
# The release is whole: it unpacks anywhere, is built and installed without git, and what was installed runs where no source is left.
# Prints "ok" or "FAIL" for each check; `make distcheck` runs it from the root of the repository.
# usage: sh tests/dist.sh TARBALL
. tests/report.sh
tarball=$1
name=$(basename "$tarball" .tar.gz)
root=$(mktemp -d "${TMPDIR:-/tmp}/carom-dist-XXXXXX") || exit 1
trap 'rm -rf "$root"' EXIT
make="${MAKE:-make}"
unset MAKEFLAGS MAKELEVEL CAROM_BUILD

made_again() {
	cp "$tarball" "$root/first.tar.gz" && $make dist && cmp "$tarball" "$root/first.tar.gz"
}

has_its_sum() {
	cd "$(dirname "$tarball")" && { sha256sum -c "$name.tar.gz.sha256" || shasum -a 256 -c "$name.tar.gz.sha256"; }
}

unpacks() {
	tar -xzf "$tarball" -C "$root" && [ "$(ls -A "$root/$name" | sort)" = "$(git ls-tree --name-only HEAD | sort)" ]
}

# Where git is called, it fails.
without_git() {
	mkdir -p "$root/bin" && printf '#!/bin/sh\nexit 1\n' >"$root/bin/git" && chmod +x "$root/bin/git"
	(cd "$root/$name" && PATH="$root/bin:$PATH" "$@")
}

installs() {
	without_git $make install PREFIX="$root/usr" LIBDIR="$root/usr/lib64" && test -f "$root/usr/lib64/libcarom.so"
}

# From now on nothing is left of the sources and of what was built.
runs() {
	"$root/usr/bin/carom" generate --shape triangle --count 64 --speed 2 --seed 1 --out "$root/scene.json" --quiet &&
		rm -rf "${root:?}/$name" && mkdir "$root/empty" && cd "$root/empty" && runs_on cpu >"$root/hash" && grep -xE '[0-9a-f]{16}' "$root/hash"
}

runs_on() {
	env -i HOME="$root" PATH="$PATH" "$root/usr/bin/carom" run "$root/scene.json" --device "$1" --steps 100 --hash --quiet
}

agrees() {
	cd "$root/empty" && runs_on opencl | diff "$root/hash" -
}

attempt "the release has the same bytes twice" made_again
attempt "its checksum is right" has_its_sum
attempt "it unpacks into one folder, and has what git has" unpacks
attempt "it is built without git" without_git $make all
without_git sh tests/install.sh || failed=1
attempt "it is installed without git, its libraries where LIBDIR says" installs
attempt "the installed command runs where no source is left" runs
if "$root/usr/bin/carom" devices | grep -q 'OpenCL'; then
	attempt "its kernels are in it: on OpenCL it gives the same bits" agrees
else
	skip "its kernels are in it: on OpenCL it gives the same bits" "there is no OpenCL device"
fi
exit "$failed"
