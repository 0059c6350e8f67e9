# style.sh - habits that a machine can keep: layers, doors, sizes, and what is distributed.
# TAP.  Each case looks at all files at once and names every place that breaks it.

. "$srcdir/tests/tap.sh"
cd "$srcdir" || exit 1

found=$TMPDIR/found
none() { # SENTENCE: holds when $found is empty; what stands there breaks it
    if [ -s "$found" ]; then case_bad "$1" "$(cat "$found")"; else case_ok "$1"; fi
}

sources=$(find src -name '*.c' -o -name '*.cpp' | sort)
headers=$(find src -name '*.h' | sort)
tests=$(find tests -name '*.[ch]' | sort)
examples=$(find examples -name '*.c' 2>/dev/null | sort)
scripts="$(grep -l '^#!/bin/sh' bootstrap .ci/run $(find examples tests -type f) 2>/dev/null) $(find tests -name '*.sh')"

# "FILE:LINE: code" with comments gone and strings empty, so that only code is searched.
strip_comments='
function code_of(s,    out, i, c, two) {
    out = ""
    for (i = 1; i <= length(s); i++) {
        c = substr(s, i, 1)
        two = substr(s, i, 2)
        if (inside == "comment") {
            if (two == "*/") { inside = ""; i++ }
        } else if (inside != "") {
            if (c == "\\") i++
            else if (c == inside) { inside = ""; out = out c }
        } else if (two == "/*") { inside = "comment"; i++ }
        else if (two == "//") break
        else {
            if (c == "\"" || c == "\047") inside = c
            out = out c
        }
    }
    if (inside != "comment") inside = ""
    return out
}
FNR == 1 { inside = "" }
/^[ \t]*#/ { next }
{ print FILENAME ":" FNR ": " code_of($0) }'
code=$TMPDIR/code
# shellcheck disable=SC2086 # lists of files are split, here and below
awk "$strip_comments" $sources $headers >"$code"

# uses FILES WORDS: where code of the files (a regular expression) calls one of the functions
calls() { grep -E "^($1)[^:]*:" "$code" | grep -E "(^|[^A-Za-z0-9_.>])($2) *\("; }
names() { grep -E "^($1)[^:]*:" "$code" | grep -E "(^|[^A-Za-z0-9_])($2)([^A-Za-z0-9_]|\$)"; }
below_cli='src/(base|bridge|model|input|region|match|terrain|loft|output|api)/'
below_files='src/(bridge|model|input|region|match|terrain|loft|output|api)/'

for f in $sources $tests $examples; do
    case $f in *.h | examples/*) continue ;; esac
    awk '/^#[ \t]*include/ { if ($2 != "\"config.h\"") print FILENAME ": " $0; exit }' "$f"
done >"$found"
none "config.h is the first include of every source"

grep -n -E "$(printf '\t')| \$|$(printf '\r')" $sources $headers $tests $examples $scripts >"$found"
none "no tabs, no blanks at the end of a line"

for f in $sources $headers $tests; do
    wc -l "$f" | awk -v most="$(case $f in src/*) echo 700 ;; *) echo 1200 ;; esac)" '$1 > most { print $2 ": " $1 " lines" }'
done >"$found"
none "a file keeps to 700 lines, a test to 1200"

awk 'FNR == 1 { begin = 0 }
    /^{/ { begin = FNR }
    /^}/ { if (begin && FNR - begin > 80) print FILENAME ":" begin ": " FNR - begin - 1 " lines"; begin = 0 }' $sources >"$found"
none "a function keeps to 80 lines"

awk 'FNR == 1 { begin = 0 }
    /^{/ { begin = FNR }
    /^}/ { if (begin) print FNR - begin - 1; begin = 0 }' $sources | sort -n |
    awk '{ a[NR] = $1 } END { if (a[int(NR * .9)] > 50) print "nine in ten keep to " a[int(NR * .9)]
                              if (a[int(NR / 2)] > 16) print "the median is " a[int(NR / 2)] }' >"$found"
none "half of the functions keep to 16 lines, nine in ten to 50"

awk 'length($0) > 140 { print FILENAME ":" FNR ": " length($0) }' $sources $headers $tests $examples >"$found"
none "a line keeps to 140 characters"

# A layer uses model, base and bridge and none of its neighbours; only cli and api bring them together.
awk -F'"' '/^#[ \t]*include[ \t]*"/ {
        split(FILENAME, part, "/")
        from = part[2]
        to = index($2, "/") ? substr($2, 1, index($2, "/") - 1) : ""
        if (to == "" || to == from || from == "main.c" || (from == "cli" && to != "api") || (from == "api" && to != "cli"))
            next
        if (from == "base" || (to != "base" && to != "bridge" && to != "model"))
            print FILENAME ":" FNR ": " $2
    }' $sources $headers >"$found"
none "a layer includes none of its neighbours"

grep -n -E '# *include *<(CGAL|boost|OpenMesh|GeographicLib)' $sources $headers | grep -v '^src/bridge/' >"$found"
none "C++ libraries live in bridges"

{ calls "$below_files" 'fopen|fdopen|freopen|fclose|fread|fwrite|open|openat|creat|mkstemp|mkdtemp|tmpfile|rename|unlink|read|write|close'
  names "$below_files" 'FILE'; } >"$found"
none "only base opens, reads, writes and closes"

{ calls "$below_cli" 'printf|fprintf|vprintf|vfprintf|dprintf|puts|fputs|putchar|putc|fputc|perror|psignal'
  names "$below_cli" 'stdout|stderr|cout|cerr|clog'; } >"$found"
none "nothing below cli prints"

calls 'src/' 'malloc|calloc|realloc|reallocarray|free|strdup|strndup|asprintf|aligned_alloc|posix_memalign' |
    grep -v -E '^src/base/alloc\.c:|^src/bridge/[^:]*\.cpp:' >"$found"
none "the heap has one door, base/alloc.c"

{ calls "$below_cli" 'exit|_exit|_Exit|abort|quick_exit|atexit|signal|sigaction|setlocale'; } >"$found"
none "nothing below cli ends the program or changes the process"

calls 'src/' 'strtod|strtof|strtold|atof|atoi|atol|sscanf|fscanf|scanf|stod|stof|stoi' |
    grep -v '^src/bridge/number\.cpp:' >"$found"
none "text becomes numbers through base/number.h"

# shellcheck disable=SC2046
grep -n -E '%[-+ #0-9.*]*(l|L)?[aefgAEFG]([^A-Za-z]|$)' $(printf '%s\n' $sources | grep -v '^src/cli/\|^src/main') |
    grep '"' | grep -v '%%' >"$found"
none "numbers become text through base/number.h"

calls 'src/' 'strcpy|strcat|sprintf|vsprintf|gets|strtok|alloca|rand|srand|random|localtime|gmtime|ctime|asctime' >"$found"
none "no function that overruns, keeps state or differs between runs"

for f in $headers; do
    guard=IL_$(printf '%s' "${f#src/}" | tr 'a-z/.-' 'A-Z___')
    case $f in src/isoloft.h) guard=ISOLOFT_H ;; esac
    grep -q "^#ifndef $guard\$" "$f" || echo "$f: no guard $guard"
done >"$found"
none "a header is guarded by its path"

if command -v cc >/dev/null; then
    for f in $headers; do
        grep -q -E '<(libxml|CGAL)/' "$f" && continue
        printf '#include "%s"\n' "${f#src/}" | cc -std=c11 -Wno-psabi -D_POSIX_C_SOURCE=200809L -Isrc -fsyntax-only -x c - 2>&1 | head -n 3
    done >"$found"
none "a header needs nothing before it"
else
    skip "a header needs nothing before it" "no cc"
fi

for f in $sources $headers $tests $examples $(find tests -name '*.sh'); do
    case $f in tests/t-*.c | tests/cut.c | tests/bench/*.c) f=${f%.c} ;; esac # where automake knows that it is FILE.c
    grep -q -E "^[^#]*$f(\.c)?( |$)" Makefile.am || echo "$f"
done >"$found"
none "every file is in Makefile.am, so in the distribution"

if command -v shellcheck >/dev/null; then
    shellcheck -s sh -S warning -e SC2046,SC2254,SC2034,SC2154,SC2164 -f gcc $scripts >"$found"
none "shell scripts pass shellcheck"
else
    skip "shell scripts pass shellcheck" "shellcheck is not installed"
fi

printf '#include "config.h"\n' >"$TMPDIR/ndebug.cpp"
if ${CXX:-c++} -I"$builddir" -DNDEBUG -fsyntax-only "$TMPDIR/ndebug.cpp" >"$found" 2>&1; then
    echo "a bridge compiles with -DNDEBUG" >"$found"
elif grep -q 'without -DNDEBUG' "$found"; then
    : >"$found"
fi
none "no bridge is built with NDEBUG"

# Tables of pointers are constant but for the loader; the allocation seam is the one exception.
instrumented='__gcov|__asan|__ubsan|__sancov|__covrec|__llvm'
objects=$(find "$builddir/src" -name '*.o' ! -path '*/bridge/*' 2>/dev/null)
if ! command -v objdump >/dev/null || [ -z "$objects" ]; then
    skip "nothing global is mutable" "no objects to look into, or no objdump"
elif objdump -t $objects | grep -q -E "$instrumented"; then
    skip "nothing global is mutable" "the build is instrumented"
else
    objdump -t $objects | awk '/file format/ { file = $1 }
        { for (i = 2; i < NF; i++) if ($i ~ /^\.t?(data|bss)(\.rel(\.local)?)?$/ && $(i + 1) !~ /^0+$/) print file " " $NF }' |
        grep -v -E '/alloc\.o: +allocations_left$' >"$found"
    none "nothing global is mutable"
fi

if [ -d man ] && command -v mandoc >/dev/null; then
    mandoc -T lint -W warning man/*.[1-9] >"$found" 2>&1
    none "manual pages have nothing that mandoc warns of"
elif [ -d man ] && command -v groff >/dev/null; then
    groff -man -ww -z man/*.[1-9] >"$found" 2>&1
    none "manual pages have nothing that groff warns of"
else
    skip "manual pages pass a lint" "neither mandoc nor groff is installed"
fi

# Commands stand indented in the README.
: >"$found"
command='./bootstrap && make check'
grep -q -x -F "    $command" README.md || echo "README.md: no '$command'" >>"$found"
[ ! -e .ci/run ] || grep -q -F "($command)" .ci/run || echo ".ci/run: no '$command'" >>"$found"
none "continuous integration runs the README's test command"

for word in $(grep -o -E '(examples|formats|man|src|tests)/[A-Za-z0-9_./-]*[A-Za-z0-9_/]' README.md); do
    [ -e "$word" ] || echo "README.md: $word is not there"
done >"$found"
none "files that the README names are there"

plan
