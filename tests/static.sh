#!/bin/sh
# What tools find in the source that the build does not ask, for `make static`: the kernels as clang's front end reads them, the layout of the
# text, what clang-tidy, cppcheck and doxygen say. Prints "ok" or "FAIL" for each check, and SKIPPED where there is no such tool (a
# failure with CAROM_NO_SKIP=1); tools/bootstrap --developer installs them. Run it from the root of the repository.
# C_FLAGS and CXX_FLAGS are what a compiler needs to read the C and the C++.
. tests/report.sh
jobs=$(nproc 2>/dev/null || echo 2)
folder=$(mktemp -d "${TMPDIR:-/tmp}/carom-static-XXXXXX") || exit 1
trap 'rm -rf "$folder"' EXIT

# tool NAME VERSION: the command of that version, or nothing where there is another or none: others find other things.
tool() {
	for name in "$1-$2" "$1"; do
		"$name" --version 2>/dev/null | grep -qE "(^| )$2(\.|$)" && echo "$name" && return
	done
}

# ---- The kernels. The programs are put together from the tables of the library, as it does itself, but those of all steps are one here.

# headers DRAWS: those of the program of pictures, or of steps
headers() {
	case $1 in
	true) sed -nE '/^static const char \*const headers_of_pictures/s/.*\{(.*)\};/\1/p' src/cl/sources.c | tr -cs 'a-z_' ' ' ;;
	false) sed -nE 's/^\t\{"([a-z_]+)", USED_[A-Z_]+\},$/\1/p' src/cl/sources.c ;;
	esac
}

# The slots in their order, each with its default alternative and whether it is one of pictures.
slots() {
	sed -nE 's/^\t\{"([a-z_]+)", .*, "?([A-Za-z0-9_]+)"?, (USED_[A-Z_]+)\},$/\1 \2 \3/p' src/stage.c |
		awk '$1 != "step" { print $1, $2, $3 == "USED_PICTURES" ? "true" : "false" }'
}

# program FILE: the files of a program with that alternative and beside it the defaults
program() {
	slot=$(basename "$(dirname "$1")")
	draws=$(slots | awk -v slot="$slot" '$1 == slot { print $3 }')
	printf 'kernels/%s.h\n' $(headers "$draws")
	slots | while read -r name standard pictures; do
		case "$pictures $name $standard" in
		"$draws $slot NULL" | "$draws "*" NULL") ls kernels/"$name"/*.cl ;;
		"$draws $slot "*) echo "$1" ;;
		"$draws "*) echo "kernels/$name/$standard.cl" ;;
		esac
	done
}

# Every alternative is in a program; most programs are one.
programs() {
	for file in kernels/*/*.cl; do
		program "$file" >"$folder/parts"
		grep -qx "$file" "$folder/parts" || { echo "$file is in no program" && continue; }
		text=$folder/$(cksum <"$folder/parts" | cut -d ' ' -f 1).cl
		[ -e "$text" ] || while read -r part; do
			echo "#line 1 \"$part\""
			cat "$part"
		done <"$folder/parts" >"$text"
	done
}

# Lines of options for each program: for 32 and 64 bits, in each storage, with reads counted or not, polygons as the step events has them, any two of these together; and one without
# optimization. A work-item's number, a size_t, may become an int: on each of the two this is one kind of conversion, which the other still warns of.
translations() {
	for text in "$folder"/*.cl; do
		while read -r options; do
			echo "$options -o $folder/$((number += 1)).ll $text"
		done <<-END
			--target=spir -Wno-sign-conversion
			--target=spir -Wno-sign-conversion -DCAROM_IMAGES -DCAROM_COUNT_READS
			--target=spir -Wno-sign-conversion -DCAROM_OUTLINES
			--target=spir64 -Wno-shorten-64-to-32 -DCAROM_IMAGES
			--target=spir64 -Wno-shorten-64-to-32 -DCAROM_COUNT_READS
			--target=spir64 -Wno-shorten-64-to-32 -DCAROM_IMAGES -DCAROM_OUTLINES
		END
		echo "--target=spir64 -Wno-shorten-64-to-32 -cl-opt-disable -o $folder/plain$((number += 1)).ll $text"
	done
}

# in_parallel COMMAND...: with each line of standard input; prints what they said, each all at once.
in_parallel() {
	xargs -P "$jobs" -L 1 sh -c 'said=$("$@" 2>&1) || said="$said
$*: exit status $?"; [ -z "$said" ] || printf "%s\n" "$said"' - "$@"
}

# Alternatives of one slot take the same arguments, and need not use all. Without its extensions OpenCL C 1.2 has no double.
translate() {
	translations | in_parallel "$command" -x cl -cl-std=CL1.2 -D__opencl_c_images=1 -cl-fp32-correctly-rounded-divide-sqrt -Xclang -finclude-default-header \
		-Xclang -cl-ext=-all -Wall -Wextra -Wshadow -Wconversion -Wdouble-promotion -Werror -Wno-unused-parameter -S -emit-llvm | sort -u
}

contracted() {
	grep -E 'fmuladd|llvm\.fma|_Z3(fma|mad)|= f(add|sub|mul|div) [a-z ]*(contract|fast)' "$folder"/*.ll
	[ "$(find "$folder" -name '*.ll' | wc -l)" -eq "$(translations | wc -l)" ] || echo "some program was not translated"
}

# Where Oclgrind looks for uninitialized values it has them as these are, and crashes where a vector of two is widened, and where a function was inlined.
unreadable() {
	grep -E 'shufflevector <2 x .* <4 x i32>|noalias\.scope\.decl' "$folder"/plain*.ll
}

# ---- The C and C++

# The stages of the CPU device in six files, alternatives of a slot, whose names are alike, in different ones: most of the time goes to the headers of
# Eigen and of C++. What does not go together is looked at one by one.
stages() {
	find src/cpu -mindepth 2 -name '*.cpp' | sort >"$folder/stages"
	for number in 0 1 2 3 4 5; do
		text=$folder/stages$number.cpp
		files=$(awk -v number=$number 'NR % 6 == number' "$folder/stages")
		printf '#include "%s"\n' $files >"$text"
		if g++ $CXX_FLAGS -I. -fsyntax-only -w "$text" 2>/dev/null; then echo "$text"; else printf '%s\n' $files; fi
	done
}

# (The analyzer follows a function's ways until it has seen so many states of it, by default 225,000. Fewer take less time, and templates, each of them twice, for float and for
# double, the most.)
tidy() {
	most='-Xclang -analyzer-config -Xclang max-nodes'
	{ stages && sources src tests tools | grep -E '\.c(pp)?$' | grep -v '^src/cpu/.*/' | sort -r; } | while read -r file; do
		case $file in
		*.c) printf '%s -- %s=50000 %s\n' "$file" "$most" "$C_FLAGS" ;;
		*) printf '%s -- %s=12000 -Xclang -analyzer-opt-analyze-headers -I. %s\n' "$file" "$most" "$CXX_FLAGS" ;;
		esac
	done | in_parallel "$command" --config-file=.clang-tidy --checks=-bugprone-suspicious-include --quiet --warnings-as-errors='*' |
		grep -E ': (warning|error): |exit status' | sort -u
}

look_over() {
	"$command" --quiet -j "$jobs" --std=c11 --std=c++17 --enable=warning,style,performance,portability \
		--suppressions-list=tests/cppcheck.supp --template='{file}:{line}: {message} [{id}]' -Iinclude -Isrc -Ikernels -Itests src tests tools 2>&1
}

# A name that two files give to two types is no error to a linker, but may mix up what they do. GCC sees it when it links its own code.
define_twice() {
	for file in src/cpu/*.cpp src/cpu/*/*.cpp; do
		echo "$file -o $folder/$((number += 1)).o"
	done | in_parallel "$command" $CXX_FLAGS -flto -O0 -fPIC -w -Wno-psabi -c
	"$command" -flto -O0 -shared -Wodr -o "$folder/cpu.so" "$folder"/*.o 2>&1 | grep -E 'Wodr|error' | sort -u
}

layout() {
	{ sources include src kernels tests tools && find kernels -name '*.cl'; } | xargs "$command" --dry-run -Werror 2>&1 | grep 'error: '
}

manual() {
	CAROM_VERSION='' CAROM_BUILD="$folder" "$command" tools/Doxyfile 2>&1
}

# ---- All of it

# check NAME TOOL VERSION FUNCTION: what the function prints is wrong.
check() {
	command=$(tool "$2" "$3")
	if [ -n "$command" ]; then
		report "$1" "$($4)"
	else
		skip "$1" "there is no $2 $3"
	fi
}

report "every kernel is in a program" "$(programs)"
check "kernels are OpenCL C 1.2 without a warning" clang 14 translate
check "no operation of the kernels is contracted" clang 14 contracted
check "Oclgrind can read the kernels" clang 14 unreadable
check "the sources are as .clang-format writes them" clang-format 14 layout
check "doxygen renders carom.h without a warning" doxygen 1 manual
check "cppcheck finds nothing" cppcheck 2.10 look_over
check "each name of the C++ is one thing" g++ '[0-9]+' define_twice
check "clang-tidy finds nothing" clang-tidy 14 tidy
exit "$failed"
