# hostile.sh - input that means harm: sizes that are claimed, words for the terminal, depth, bombs.
. "$srcdir/tests/tap.sh"

# COMMAND... exits with $1 and one line of error, and never held more than $2 MB.
modest() { # CODE MB SENTENCE COMMAND...
    code=$1 most=$2 sentence=$3
    shift 3
    "$@" --json >out 2>err
    status=$?
    peak=$(sed -n 's/.*"peak_bytes":\([0-9]*\).*/\1/p' err out | tail -n 1)
    if sanitized; then peak=0; fi
    if [ $status -ne "$code" ]; then
        case_bad "$sentence" "$* exits $status, not $code" "$(head -n 5 err | cut -c 1-200)"
    elif [ "${peak:-0}" -gt $((most * 1000000)) ]; then
        case_bad "$sentence" "it held $peak bytes"
    elif [ "$status" -ne 0 ] && ! grep -v '^{' err | sed 1d | wc -l | grep -qx 0; then
        case_bad "$sentence" "more than one line: $(head -n 3 err | cut -c 1-200)"
    else
        case_ok "$sentence"
    fi
}

# The same within 20 seconds of a processor, where work that grows as the square of the
# input would take minutes.
prompt() { # CODE MB SENTENCE COMMAND...
    code=$1 most=$2 sentence=$3
    shift 3
    if sanitized; then limit=unlimited; else limit=20; fi
    modest "$code" "$most" "$sentence" sh -c 'ulimit -t "$1"; shift; exec "$@"' - "$limit" "$@"
}

head_of() { printf 'isoloft 1\nunit mm\nstack "a"\nslice 0\nring'; }

# ---- sizes that are claimed ----------------------------------------------------

{ head_of; printf ' 4294967295\n0 0\n1 0\n1 1\nend\n'; } >count.loft
modest 3 40 "a ring that claims 4294967295 vertices" "$ISOLOFT" count.loft
{ printf '%80s' x; printf '\377\377\377\377'; printf '%100s' x; } >count.stl
modest 3 40 "an STL that claims 4294967295 triangles" "$ISOLOFT" check count.stl
{ printf '%80s' x; printf '\377\377\377\377'; pillar 60 400; } >count.stl
modest 3 40 "and is longer than the look-ahead" "$ISOLOFT" check count.stl
printf 'ply\nformat ascii 1.0\nelement vertex 4000000000\nproperty double x\nproperty double y\nproperty double z
element face 4000000000\nproperty list uchar int vertex_indices\nend_header\n0 0 0\n' >count.ply
modest 3 40 "a PLY that claims 4000000000 vertices" "$ISOLOFT" check count.ply
printf 'f 1 2 4000000000\nv 0 0 0\nv 0 0 1\n' >count.obj
modest 3 40 "an OBJ corner beyond all vertices" "$ISOLOFT" check count.obj
printf '<svg viewBox="0 0 1e14 1e14" width="1e300mm" height="1e300mm"><rect data-z="1" width="1e14" height="1"/></svg>' >big.svg
modest 3 40 "a drawing larger than numbers" "$ISOLOFT" big.svg
printf '<svg><path data-z="0" d="M0 0A1e9 1e9 0 0 1 9e9 0z"/></svg>' >arc.svg
"$ISOLOFT" read arc.svg --flatness 1e-9 >out 2>err
holds "an arc that would need endless points is refused or bounded" test $? -le 3

# ---- maps that make work ----------------------------------------------------------

# Features on standard input as a collection.
collection() { printf '{"type": "FeatureCollection", "features": [\n'; cat; printf '\n]}\n'; }
awk 'BEGIN {
    printf "{\"type\": \"Feature\", \"properties\": {\"elev\": 1}, \"geometry\": {\"type\": \"Polygon\", \"coordinates\": [["
    for (k = 0; k < 400000; k++) printf "[700,700],[900,900],"
    print "[900,700],[700,700]]]}},"
    print "{\"type\": \"Feature\", \"properties\": {\"elev\": 2}, \"geometry\": {\"type\": \"Polygon\", \"coordinates\":",
        "[[[0,0],[1000,0],[1000,1000],[0,0]]]}}" }' | collection >edges.geojson
prompt 0 300 "a polygon with one edge 800000 times" "$ISOLOFT" read edges.geojson -o out.loft
awk 'BEGIN {
    for (k = 0; k < 200000; k++) printf "> -Z0\n%d 1000\n%d 2000\n> -Z%.15g\n%d 3000\n%d 4000\n", k, k, (k + 1) * 5e-9, k, k
    print "> -Z1\n0 5000\n9 5000" }' >levels.gmt
prompt 0 500 "400000 lines whose heights differ by next to nothing" "$ISOLOFT" read levels.gmt -o out.loft
awk 'BEGIN { for (k = 0; k < 2000; k++) for (i = 0; i < 200; i++) printf "%sc%d%s", i ? "," : "", (i * 7 + k) % 200, i < 199 ? "" : "\n" }' >columns.csv
prompt 3 40 "a table of many columns" "$ISOLOFT" read -f csv columns.csv -o out.loft

# ---- long lines, odd bytes -----------------------------------------------------

awk 'BEGIN { for (k = 0; k < 1000000; k++) printf "1234567890" }' >digits
{ head_of; printf '\n'; cat digits; printf ' 0\nend\n'; } >line.loft
modest 3 100 "a number of ten million digits" "$ISOLOFT" line.loft
{ printf 'isoloft 1\nunit mm\nstack "'; cat digits; printf '"\nslice 0\nend\n'; } >line.loft
exits 0 "a name of ten million bytes is a name" "$ISOLOFT" read line.loft -o named.loft
holds "which is not shortened" sh -c 'sed -n 3p named.loft | wc -c | grep -qx 10000009'
exits 0 "info copes with it" "$ISOLOFT" info line.loft
holds "and shows little of it" test "$(wc -c <out)" -lt 3000
exits 3 "unless lines are limited" "$ISOLOFT" read line.loft --max-line 100000
{ printf '<svg><polygon data-z="0" points="'; cat digits; printf '"/></svg>'; } >line.svg
modest 3 150 "a coordinate of ten million digits in SVG" "$ISOLOFT" line.svg
{ printf '<svg><path data-z="0" d="M 0 0'; cat digits; printf 'z"/></svg>'; } >line.svg
modest 3 150 "a path of ten million digits" "$ISOLOFT" line.svg
{ printf 'solid x\nfacet normal '; cat digits; } >line.stl
modest 3 100 "an STL line of ten million digits" "$ISOLOFT" check line.stl
printf 'isoloft 1\nunit mm\nstack "a\000b"\nend\n' >nul.loft
modest 3 40 "a NUL in native text" "$ISOLOFT" nul.loft
printf '<svg><rect data-z="0" width="1\0001" height="1"/></svg>' >nul.svg
modest 3 40 "a NUL in SVG" "$ISOLOFT" nul.svg
head -c 100000 /dev/zero >zero
modest 3 40 "zeros" "$ISOLOFT" zero
modest 3 40 "zeros to check" "$ISOLOFT" check zero
for verb in convert read match mesh info check plot; do
    exits 3 "$verb: an empty input" "$ISOLOFT" $verb /dev/null
    holds "is told in one line" one_error
done
{ gzip -c "$vase" | head -c 9000; } >cut.gz
modest 3 40 "a gzip stream that was cut" "$ISOLOFT" cut.gz
{ gzip -c "$vase" | head -c 9000; head -c 9000 /dev/zero; } >bad.gz
modest 3 40 "a gzip stream that is damaged" "$ISOLOFT" bad.gz
{ head_of; printf '\n0 0\n9 0\n9 9\n'; awk 'BEGIN { for (k = 0; k < 3000000; k++) print "#" }'; printf 'end\n'; } | gzip -9 >bomb.gz
modest 0 60 "a gzip bomb costs time, not memory" "$ISOLOFT" read bomb.gz -o bomb.loft

# ---- depth and bombs -----------------------------------------------------------

{ printf '<svg>'; awk 'BEGIN { for (k = 0; k < 1000000; k++) printf "<g>" }'; } >deep.svg
modest 3 150 "a million nested groups" "$ISOLOFT" deep.svg
{ printf '<svg>'; awk 'BEGIN { for (k = 0; k < 900; k++) printf "<g>"; printf "<rect data-z=\"0\" width=\"1\" height=\"1\"/>"
    for (k = 0; k < 900; k++) printf "</g>" }'; printf '</svg>'; } >deep.svg
exits 0 "nine hundred are fine" "$ISOLOFT" read deep.svg
exits 3 "unless depth is limited" "$ISOLOFT" read deep.svg --max-depth 100
exits 3 "points can be limited, in SVG" "$ISOLOFT" read "$vase_svg" --max-points 5999
exits 3 "and in native text" "$ISOLOFT" read "$vase" --max-points 5999
exits 0 "to what is there" "$ISOLOFT" read "$vase" --max-points 6000
{
    printf '<?xml version="1.0"?><!DOCTYPE svg [<!ENTITY a "aaaaaaaaaa">'
    awk 'BEGIN { for (k = 98; k < 110; k++) { printf "<!ENTITY %c \"", k; for (i = 0; i < 10; i++) printf "&%c;", k - 1; printf "\">" } }'
    printf ']><svg><title>&m;</title><rect data-z="0" width="1" height="1"/></svg>'
} >bomb.svg
modest 3 40 "an entity bomb" "$ISOLOFT" bomb.svg
printf '<!DOCTYPE svg [<!ENTITY x SYSTEM "%s">]><svg><title>&x;</title><rect data-z="0" width="1" height="1"/></svg>' \
    "$PWD/digits" >entity.svg
modest 3 40 "an entity that names a file" "$ISOLOFT" entity.svg
printf '<!DOCTYPE svg PUBLIC "x" "http://localhost:1/x.dtd"><svg><rect data-z="0" width="2" height="1"/>
<rect data-z="1" width="1" height="1"/></svg>' >dtd.svg
exits 0 "a DOCTYPE is passed over" "$ISOLOFT" dtd.svg -o dtd.stl

# ---- what is shown -------------------------------------------------------------

shown() { # SENTENCE: nothing in out and err that a terminal obeys
    c1=$(printf '\302[\200-\237]')
    bidi=$(printf '\342\200[\252-\256]')
    if cat out err | tr -d '\n' | LC_ALL=C grep -q -e '[[:cntrl:]]' -e "$c1" -e "$bidi"; then
        case_bad "$1" "$(cat -v out err | head -n 3)"
    else
        case_ok "$1"
    fi
}
red='\\x1b[31mred\\x07\\xc2\\x9b1m\\xe2\\x80\\xae\\x7f\\n'
{
    printf 'isoloft 1\nunit mm\nstack "%b"\nslice 0\nring\n0 0\n0 0\n9 0\n9 9\nslice 1\nring\n0 0\n9 0\n9 9\nend\n' "$red"
} >red.loft
exits 0 "a name with control characters" "$ISOLOFT" red.loft -v --json -o red.stl
shown "is shown without them"
exits 0 "in info" "$ISOLOFT" info red.loft
shown "too"
exits 0 "in the account" "$ISOLOFT" info red.loft --json
shown "too"
exits 3 "in errors" "$ISOLOFT" red.loft --strict
shown "too"
sed '$d' red.loft >red.cut
exits 3 "in errors of reading" "$ISOLOFT" red.cut
shown "too"
printf '\033[31mslice\033 0\n' | cat red.cut - >red.word
exits 3 "a word with control characters" "$ISOLOFT" red.word
shown "is shown without them"
printf '<svg><g id="layer1" data-z="\033[31m1"><rect width="1" height="1"/></g></svg>' >red.svg
exits 3 "an attribute with control characters" "$ISOLOFT" red.svg
shown "is shown without them"
printf '<svg><g data-z="0"><title>&#x9b;31m &#x202e;</title><text>x</text><rect width="9" height="9"/>
<circle r="&#x9b;x"/></g><g data-z="1"><rect width="9" height="9"/></g></svg>' >c1.svg
"$ISOLOFT" c1.svg -v -o c1.stl >out 2>err
shown "nor do references bring any"
exits 4 "a file name with control characters" "$ISOLOFT" "$(printf 'no\033[31msuch\nfile')"
shown "is shown without them"
exits 2 "an option with control characters" "$ISOLOFT" "$(printf -- '--\033[31mx')"
shown "is shown without them"
mv red.loft "$(printf 'red\033[31m.loft')"
exits 1 "a file name that is there" "$ISOLOFT" check "$(printf 'red\033[31m.loft')"
shown "is shown without them"
holds "in formats that hold names too" sh -c '"$ISOLOFT" "$1" -t obj | tr -d "\n" | LC_ALL=C grep -q "[[:cntrl:]]" && exit 1 || exit 0' \
    - "$(printf 'red\033[31m.loft')"

plan
