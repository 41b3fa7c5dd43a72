#!/bin/sh
# An installed copy is all that a program needs: README.md's example is built through pkg-config outside the repository, as C
# and as C++, with the shared and with the static library, and must print what README.md says. Prints "ok" or "FAIL" for
# each check; run it from the repository's root.
. tests/report.sh
CC=${CC:-cc}
CXX=${CXX:-c++}
build=${CAROM_BUILD:-build}
root=$(mktemp -d "${TMPDIR:-/tmp}/carom-install-XXXXXX") || exit 1
trap 'rm -rf "$root"' EXIT
strict="-Wall -Wextra -Wpedantic -Werror"
case $build in */sanitize) strict="$strict -fsanitize=address,undefined" ;; esac

# fenced LANGUAGE: README.md's first block in it.
fenced() {
	awk -v fence="\`\`\`$1" '/^```/ { if (inside) exit; inside = $0 == fence; next } inside' README.md
}

# A directory for staging is no part of any path in carom.pc.
package() {
	PKG_CONFIG_PATH="$root/usr/lib/pkgconfig" "${PKG_CONFIG:-pkg-config}" --define-variable=prefix="$root/usr" "$@" carom
}

install() {
	${MAKE:-make} "$1" DESTDIR="$root" PREFIX=/usr BUILD="${build%/sanitize}"
}

# What there is below the staging folder is what was to be installed, and nothing else.
installs() {
	version=$(sed -n 's/^.define CAROM_VERSION_[MP][A-Z]* //p' include/carom.h | paste -sd. -)
	install install && (cd "$root/usr" && find . ! -type d | LC_ALL=C sort) >"$root/installed" && diff - "$root/installed" <<-END
		./bin/carom
		./include/carom.h
		./lib/libcarom.a
		./lib/libcarom.so
		./lib/libcarom.so.${version%%.*}
		./lib/libcarom.so.$version
		./lib/pkgconfig/carom.pc
		./share/man/man1/carom.1
	END
}

uninstalls() {
	install uninstall && ! find "$root/usr" ! -type d | grep .
}

# compile NAME SOURCE COMPILER STANDARD PACKAGE_OPTION...
compile() {
	program=$root/$1 source=$root/$2 compiler=$3 standard=$4
	shift 4
	$compiler -std="$standard" $strict "$source" $(package --cflags --libs "$@") -o "$program"
}

# In a folder without the repository's files, and without the link that only linking needs.
prints_what_is_said() {
	rm -f "$root/usr/lib/libcarom.so"
	(cd "$root" && LD_LIBRARY_PATH="$root/usr/lib" DYLD_LIBRARY_PATH="$root/usr/lib" LSAN_OPTIONS= "./$1" | diff wanted -)
}

versions_agree() {
	test "carom $(package --modversion)" = "$("$root/usr/bin/carom" --version)"
}

# groff tells what it doesn't understand, and succeeds.
page_is_clean() {
	LC_ALL=C groff -man -ww -z "$root/usr/share/man/man1/carom.1" 2>"$root/warnings"
	! grep . "$root/warnings"
}

# What only developers need is not there everywhere.
names_doxygen() {
	! ${MAKE:-make} doc DOXYGEN=none/doxygen >"$root/said" 2>&1 && grep 'install the package doxygen, or all that tools/bootstrap --developer' "$root/said"
}

fenced c >"$root/example.c"
cp "$root/example.c" "$root/example.cpp"
fenced text >"$root/wanted"

attempt "make install into a staging folder" installs
attempt "the package's version is the command's" versions_agree
attempt "a C program is built with the installed shared library" compile c_shared example.c "$CC" c11
attempt "a C++ program is built with the installed shared library" compile cpp_shared example.cpp "$CXX" c++17
attempt "the C program with the shared library runs" prints_what_is_said c_shared
attempt "the C++ program with the shared library runs" prints_what_is_said cpp_shared
rm -f "$root"/usr/lib/libcarom.so*
attempt "a C program is built with the installed static library" compile c_static example.c "$CC" c11 --static
attempt "a C++ program is built with the installed static library" compile cpp_static example.cpp "$CXX" c++17 --static
attempt "the C program with the static library runs" prints_what_is_said c_static
attempt "the C++ program with the static library runs" prints_what_is_said cpp_static
if command -v groff >/dev/null 2>&1; then
	attempt "the manual page is clean" page_is_clean
else
	skip "the manual page is clean" "there is no groff"
fi

attempt "make uninstall leaves nothing" uninstalls
attempt "make doc says how to get doxygen" names_doxygen

exit "$failed"
