# What the scripts of checks share: sourced by them, from the root of the repository.
failed=0

# report NAME FINDINGS: what was found is what is wrong.
report() {
	if [ -z "$2" ]; then
		echo "ok   $1"
	else
		failed=1
		echo "FAIL $1"
		printf '%s\n' "$2" | sed 's/^/     /'
	fi
}

# attempt NAME COMMAND...: the command has to succeed, or what it printed is shown.
attempt() {
	tried=$1
	shift
	if said=$("$@" 2>&1); then
		report "$tried" ""
	else
		report "$tried" "${said:-it failed}"
	fi
}

# skip NAME REASON: not where CAROM_NO_SKIP is set.
skip() {
	echo "SKIPPED $1: $2"
	[ -z "${CAROM_NO_SKIP:-}" ] || report "$1" "$2"
}

# sources DIRECTORY...: the C and C++ files below them.
sources() {
	find "$@" -type f \( -name '*.c' -o -name '*.h' -o -name '*.cpp' -o -name '*.hpp' \) 2>/dev/null | sort
}
