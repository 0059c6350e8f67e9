# format.sh - the native format as its users meet it: through the program, the
# manual page, file(1) and the summary's schema.
echo "1..11"
n=0
invalid=$srcdir/formats/loft/invalid
valid=$srcdir/formats/loft/valid
page=$srcdir/man/isoloft.5
schema=$srcdir/formats/summary.schema.json

ok() { n=$((n + 1)); echo "ok $n - $1"; }
not_ok() { n=$((n + 1)); echo "not ok $n - $1"; }
skip() { n=$((n + 1)); echo "ok $n - $1 # SKIP $2"; }
check() { # SENTENCE COMMAND...: holds when the command succeeds
    sentence=$1
    shift
    if "$@"; then ok "$sentence"; else not_ok "$sentence"; fi
}

# The K-th literal block of the manual page, as it is printed.
page_block() {
    awk -v k="$1" '/^\.Bd/ { b++; inside = 1; next } /^\.Ed/ { inside = 0 } inside && b == k' "$page" | sed 's/\\e/\\/g'
}

specification_example() {
    sed -n '/^3\.  An example/,/One stack with two slices/p' "$srcdir/formats/loft.txt" | sed -n 's/^      //p' >"$TMPDIR/example.loft"
    "$ISOLOFT" read "$TMPDIR/example.loft" >"$TMPDIR/out" 2>/dev/null && [ "$(wc -l <"$TMPDIR/out")" -eq 19 ]
}
check "the example of the specification is read" specification_example

in_folder() { # run the commands on stdin in $TMPDIR/run, with the program on the path
    (cd "$TMPDIR/run" && PATH=$(dirname "$ISOLOFT"):$PATH LC_ALL=C sh -e)
}

first_page_example() {
    mkdir "$TMPDIR/run"
    page_block 1 | in_folder >"$TMPDIR/out" 2>&1 && [ "$(wc -c <"$TMPDIR/run/cone.stl")" -gt 10000 ]
}
check "the manual page's cone becomes a surface" first_page_example

second_page_example() {
    rm -rf "$TMPDIR/run"
    mkdir "$TMPDIR/run"
    cp "$valid/v_several_stacks.loft" "$TMPDIR/run/slices.loft"
    page_block 2 | in_folder >"$TMPDIR/out" 2>/dev/null
    [ "$(awk 'NF == 3' "$TMPDIR/out" | wc -l)" -eq 12 ]
}
check "the manual page's table has a row for every vertex" second_page_example

errors_as_specified() {
    bad=0
    for f in "$invalid"/x_*.loft; do
        name=$(basename "$f" .loft)
        (cd "$invalid" && "$ISOLOFT" read -q -f loft "$name.loft" >/dev/null 2>"$TMPDIR/err")
        status=$?
        { printf 'isoloft: '; cat "$invalid/$name.error"; } >"$TMPDIR/want"
        if [ $status -ne 3 ] || ! cmp -s "$TMPDIR/err" "$TMPDIR/want"; then
            bad=$((bad + 1))
            echo "# $name: $status, $(cat "$TMPDIR/err")"
        fi
    done
    [ $bad -eq 0 ]
}
check "every invalid sample ends with status 3 and its one line" errors_as_specified

fixed_point() {
    bad=0
    for f in "$valid"/v_*.loft; do
        "$ISOLOFT" read -q "$f" >"$TMPDIR/once" 2>/dev/null || continue # open lines
        "$ISOLOFT" read -q <"$TMPDIR/once" >"$TMPDIR/twice" 2>/dev/null
        cmp -s "$TMPDIR/once" "$TMPDIR/twice" || { bad=$((bad + 1)); echo "# $f"; }
    done
    [ $bad -eq 0 ]
}
check "what read writes, it reads and writes again without changing a byte" fixed_point

cut_stream() { # COMMAND: refuses a stream that lacks its last line
    sed '$d' "$valid/v_pair_none.canonical" | "$ISOLOFT" "$1" >/dev/null 2>"$TMPDIR/err"
    [ $? -eq 3 ] && grep -q 'was cut' "$TMPDIR/err"
}
check "read refuses a cut stream" cut_stream read
check "match refuses a cut stream" cut_stream match
check "mesh refuses a cut stream" cut_stream mesh

if command -v file >/dev/null; then
    told_by_magic() {
        [ "$(file -b -m "$srcdir/formats/magic" "$valid/v_minimal.loft")" = "isoloft contours, version 1 text" ] &&
            [ "$(file -b -m "$srcdir/formats/magic" --mime-type "$valid/v_byte_order_mark.loft")" = text/vnd.isoloft ]
    }
    check "file(1) tells the format by the magic entry" told_by_magic
else
    skip "file(1) tells the format by the magic entry" "file is not installed"
fi

# One key a line; values of the summary's strings hold no quotes here.
keys() { grep -o '"[A-Za-z_]*" *:' | tr -d '": ' | sort -u; }
"$ISOLOFT" info --json "$valid/v_several_stacks.loft" 2>/dev/null | keys >"$TMPDIR/keys"
"$ISOLOFT" info --json "$valid/v_ring_short.loft" 2>/dev/null | keys >>"$TMPDIR/keys"
"$ISOLOFT" info --json --high left "$valid/v_kind_terrain.loft" 2>/dev/null | keys >>"$TMPDIR/keys"

summary_keys_are_described() {
    [ -s "$TMPDIR/keys" ] || return 1
    bad=0
    while read -r key; do
        grep -q "\"$key\": *{" "$schema" || { bad=$((bad + 1)); echo "# $key is not in the schema"; }
    done <"$TMPDIR/keys"
    [ $bad -eq 0 ]
}
check "the schema describes every key of the summary" summary_keys_are_described

required_keys_are_there() {
    bad=0
    for key in $(tr -d '\n' <"$schema" | grep -o '"required": *\[[^]]*\]' | sed 's/.*\[//' | tr -d '],"'); do
        case $key in
        from | to | capped | file | line | what | why | count) continue ;; # of gaps and skipped parts, which there are none of
        lower | upper | reach | heights) continue ;; # nor of guessed links
        esac
        grep -qx "$key" "$TMPDIR/keys" || { bad=$((bad + 1)); echo "# the summary lacks $key"; }
    done
    [ $bad -eq 0 ]
}
check "the summary has every key that the schema requires" required_keys_are_there
