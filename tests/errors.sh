# errors.sh - a wrong file of every kind: one line "isoloft: FILE:LINE: ...", the documented code,
# and an older output that stands as it was.
. "$srcdir/tests/tap.sh"

mkdir old
wrong() { # CODE PLACE SENTENCE COMMAND...: PLACE is FILE or FILE:LINE
    code=$1 place=$2 sentence=$3
    shift 3
    echo old >old/file
    exits "$code" "$sentence" "$@"
    if [ "$(wc -l <err)" -ne 1 ] || ! grep -q "^isoloft: $place: [^ ]" err; then
        case_bad "... names $place in one line" "$(head -n 3 err)"
    elif ! echo old | cmp -s - old/file || [ "$(ls -A old)" != file ]; then
        case_bad "... leaves an older output alone" "$(ls -lA old)"
    else
        case_ok "... names $place in one line, and the older output stands"
    fi
}

# ---- native text: the samples, each with its line ------------------------------

count=0 lines=0
for file in "$srcdir"/formats/loft/invalid/*.loft; do
    name=$(basename "$file")
    cat "$file" >"$name"
    echo old >old/file
    "$ISOLOFT" read "$name" -o old/file -t loft >out 2>err
    status=$?
    count=$((count + 1))
    if [ $status -ne 3 ] || ! one_error || ! grep -q "^isoloft: $name:" err || ! echo old | cmp -s - old/file; then
        case_bad "$name" "exits $status: $(head -n 2 err)"
    fi
    grep -q "^isoloft: $name:[0-9][0-9]*: " err && lines=$((lines + 1))
    rm "$name"
done
holds "all $count invalid samples are refused in one line with exit 3" test $count -ge 50
holds "all but an empty file with the number of the line" test $lines -ge $((count - 1))
bad=
for file in "$srcdir"/formats/loft/valid/*.loft; do
    "$ISOLOFT" read "$file" -q >out 2>err || grep -q "open line" err || bad="$bad $(basename "$file")"
done
holds "all valid samples are read" test -z "$bad"

# ---- the stages behind the readers ---------------------------------------------

block() { printf 'isoloft 1\nunit %s\nstack "a"\nslice 0\n%s\n0 0\n9 0\n9 9\n%sslice 1\nring\n0 0\n9 0\n9 9\nend\n' "$@"; }
block mm line '' >line.loft
wrong 3 'line.loft:[0-9]*' "an open line makes no solid" "$ISOLOFT" line.loft -o old/file -t stl
block deg ring '' >deg.loft
wrong 3 deg.loft:3 "degrees are no length" "$ISOLOFT" deg.loft --to m -o old/file -t stl
block km ring '' | sed 's/^9 9/9e9 9/' >far.loft
wrong 3 'far.loft:[0-9]*' "a conversion that leaves 1e15" "$ISOLOFT" far.loft --to um -o old/file -t stl
printf 'isoloft 1\nunit mm\nstack "one"\nslice 0\nring\n0 0\n9 0\n9 9\nend\n' >one.loft
wrong 3 'one.loft\(:[0-9]*\)\?' "one slice makes no solid" "$ISOLOFT" one.loft -o old/file -t stl
block mm ring '' | sed '/^stack/a kind terrain' >terrain.loft
wrong 3 'terrain.loft\(:[0-9]*\)\?' "one level of terrain does not tell which side is high" "$ISOLOFT" terrain.loft -o old/file -t stl
printf 'isoloft 1\nend\n' >none.loft
wrong 3 none.loft "nothing" "$ISOLOFT" none.loft -o old/file -t stl
wrong 3 "$vase" "no stack that matches" "$ISOLOFT" "$vase" --stack x -o old/file -t stl
block mm ring '0 0
' >strict.loft
wrong 3 strict.loft "repairs under --strict" "$ISOLOFT" strict.loft --strict -o old/file -t stl
wrong 3 strict.loft "repairs under --strict, read" "$ISOLOFT" read strict.loft --strict -o old/file -t loft

# ---- SVG -----------------------------------------------------------------------

svg() { # LINE SENTENCE TEXT: the text is wrong there
    printf '%s' "$3" >wrong.svg
    wrong 3 "wrong.svg\\(:$1\\)\\?" "SVG: $2" "$ISOLOFT" wrong.svg -o old/file -t stl
}
svg 1 "no end" '<svg><rect data-z="0" width="1" height="1"/>'
svg 2 "tags that do not match" '<svg>
<g></svg>'
svg 2 "a height that is no number" '<svg>
<rect data-z="high" width="1" height="1"/></svg>'
svg 2 "a path that is none" '<svg>
<path data-z="0" d="M 0 0 L 1"/></svg>'
svg 2 "points that are none" '<svg>
<polygon data-z="0" points="0,0 1,a 1,1"/></svg>'
svg 2 "a transform that is none" '<svg>
<g transform="turn(3)"><rect data-z="0" width="1" height="1"/></g></svg>'
svg 1 "a viewBox that is none" '<svg viewBox="0 0 1"><rect data-z="0" width="1" height="1"/></svg>'
svg 2 "infinite coordinates" '<svg>
<polygon data-z="0" points="0,0 1e999,0 1,1"/></svg>'
svg 2 "an entity that nobody declared" '<svg>
<title>&x;</title></svg>'
svg 1 "nothing drawn" '<svg></svg>'
svg 1 "not XML" '<svg <<<'
printf '<svg>\n<rect data-z="0" width="\377" height="1"/></svg>' >bytes.svg
wrong 3 'bytes.svg\(:[0-9]*\)\?' "SVG: bytes that are no UTF-8" "$ISOLOFT" bytes.svg -o old/file -t stl

# ---- meshes --------------------------------------------------------------------

mesh() { # LINE SENTENCE TEXT
    printf '%s' "$3" >wrong.mesh
    wrong 3 "wrong.mesh\\(:$1\\)\\?" "$2" "$ISOLOFT" check wrong.mesh
}
mesh 3 "an OBJ corner that is none" 'v 0 0 0
v 1 0 0
f 1 2 x
'
mesh 2 "an OBJ vertex that is none" 'v 0 0 0
v 1 zero 0
f 1 2 1
'
mesh '[0-9]*' "an ASCII STL that is cut" 'solid x
facet normal 0 0 1
outer loop
vertex 0 0 0
'
mesh '[0-9]*' "a PLY without end of header" 'ply
format ascii 1.0
element vertex 3
'
mesh '[0-9]*' "a PLY that is cut" 'ply
format ascii 1.0
element vertex 3
property float x
property float y
property float z
element face 1
property list uchar int vertex_indices
end_header
0 0 0
'
"$ISOLOFT" "$vase" -t stl | head -c 5000 >cut.stl
wrong 3 'cut.stl\(:[0-9]*\)\?' "a binary STL that is cut" "$ISOLOFT" check cut.stl
printf '%100s' x >other
wrong 3 other:1 "a file of another kind" "$ISOLOFT" other -o old/file -t stl
wrong 3 other "a file of another kind, to check" "$ISOLOFT" check other
wrong 3 '[^:]*' "two formats in one run" "$ISOLOFT" "$vase" "$vase_svg" -o old/file -t stl
wrong 4 no-such-file "no such file" "$ISOLOFT" no-such-file -o old/file -t stl
wrong 4 old "a folder" "$ISOLOFT" old -o old/file -t stl

plan
