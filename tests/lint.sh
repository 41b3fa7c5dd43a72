#!/bin/sh
# Checks of the source that no compiler makes: third parties stay where they belong, kernels compute the same bits
# everywhere, files stay short, the header stands alone. Prints "ok" or "FAIL" for each; run it from the repository's root.
CC=${CC:-cc}
CXX=${CXX:-c++}
. tests/report.sh

# includes PATTERN DIRECTORY...: the lines that include a header matching the extended regular expression.
includes() {
	pattern=$1
	shift
	sources "$@" | xargs grep -nE "^[[:space:]]*#[[:space:]]*include[[:space:]]*[<\"]$pattern" /dev/null
}

# code: the kernels as PATH:LINE:TEXT, without comments.
code() {
	find kernels -type f -name '*.[ch]*' 2>/dev/null | sort | xargs awk '
		FNR == 1 { inside = 0 }
		{
			text = $0
			if (inside && !(end = index(text, "*/"))) next
			if (inside) text = substr(text, end + 2)
			inside = 0
			gsub(/\/\*([^*]|\*+[^*\/])*\*+\//, " ", text)
			sub(/\/\/.*/, "", text)
			if (sub(/\/\*.*/, "", text)) inside = 1
			print FILENAME ":" FNR ":" text
		}' /dev/null
}

# longer LIMIT: those of the files on standard input that have more lines.
longer() {
	xargs awk -v limit="$1" 'FNR == limit + 1 { print FILENAME ": more than " limit " lines" }' /dev/null
}

# The tests may judge the library with the same third parties, but for OpenCL and Eigen.
report "CL/cl.h is included only in src/cl" "$(includes '(CL|OpenCL)/' include src tools tests | grep -v '^src/cl/')"
report "Eigen is included only in src/cpu" "$(includes '(Eigen|unsupported)/' include src tools tests | grep -v '^src/cpu/')"
report "png.h is included only in src/png.c" "$(includes 'png\.h' include src tools | grep -v '^src/png\.c:')"
report "jansson.h is included only in src/scene_*" \
	"$(includes 'jansson' include src tools | grep -vE '^src/scene_(read|write|json)\.[ch]:')"
report "Box2D is included only in tools/carom_peer_box2d.cpp" "$(includes 'box2d/' include src tools tests | grep -v '^tools/carom_peer_box2d')"
report "Chipmunk is included only in tools/carom_peer_chipmunk.c" \
	"$(includes 'chipmunk/' include src tools tests | grep -v '^tools/carom_peer_chipmunk')"
report "cairo.h is included only in tools/carom_plot*" "$(includes 'cairo' include src tools tests | grep -v '^tools/carom_plot')"

inner=$(sources src kernels | grep -E '\.h(pp)?$' | sed 's|.*/||' | sort -u | tr '\n' '|' | sed 's/\./\\./g; s/|$//')
report "the command sees of Carom only carom.h" \
	"$(find tools -name 'carom*' | xargs grep -nE "#[[:space:]]*include.*([</\"]($inner)[>\"]|\.\./|\.c[>\"])" /dev/null)"

inexact='native_[a-z0-9_]+|half_(cos|divide|exp|exp2|exp10|log|log2|log10|powr|recip|rsqrt|sin|sqrt|tan)'
inexact="$inexact|fast_(distance|length|normalize)|mad|dot|cross|length|distance|normalize|mix|smoothstep"
inexact="$inexact|a?(sin|cos|tan)(h|pi)?|atan2(pi)?|sincos|exp(2|10|m1)?|log(2|10|1p|b)?|pow[nr]?|rootn|cbrt|hypot|rsqrt"
report "kernels call no built-in that rounds as it likes" "$(code | grep -E "(^|[^A-Za-z0-9_])($inexact)[[:space:]]*\(")"

report "kernels have at most 120 lines" "$(find kernels -name '*.cl' 2>/dev/null | sort | longer 120)"
report "sources have at most 400 lines" "$(sources src include tools tests | grep -v '^include/carom\.h$' | longer 400)"

alone="-Wall -Wextra -Wpedantic -Werror -fsyntax-only"
report "carom.h alone is C11" "$($CC -std=c11 $alone -x c include/carom.h 2>&1)"
report "carom.h alone is C++17" "$($CXX -std=c++17 $alone -x c++ include/carom.h 2>&1)"

# What a program can link against is what the header declares, no more and no less.
library=${CAROM_BUILD:-build}/libcarom.so
if [ -f "$library" ] && command -v nm >/dev/null 2>&1; then
	declared=$(grep -oE 'CAROM_API [^(;]*\(' include/carom.h | grep -oE 'carom_[a-z0-9_]+\($' | tr -d '(' | sort -u)
	exported=$(nm -D --defined-only "$library" | awk '{ print $NF }' | sort -u)
	report "libcarom.so exports what carom.h declares" "$(printf '%s\n' "$declared" "$exported" | sort | uniq -u)"
fi

exit "$failed"
