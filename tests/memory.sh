# memory.sh - every allocation failing in turn, and memory that does not run away.
. "$srcdir/tests/tap.sh"
. "$srcdir/tests/rt-forms.sh"
. "$srcdir/tests/maps-forms.sh"

block small >block.loft
"$ISOLOFT" block.loft -t ply >block.ply
awk '/^slice/ { $2 *= $2 * $2; n++ } /^end/ { while (n++ < 6) print "slice", 18 + n / 2, "\nring\n0 0\n9 0\n9 9" } { print }' block.loft >broken.loft
printf '<svg><title>s</title><g data-z="0"><rect width="9" height="9"/><circle cx="4" cy="4" r="2"/></g>
<g id="layer2" data-z="1" transform="scale(2)"><path d="M0 0h4v4h-4zM1 1v2h2v-2z"/></g></svg>' >small.svg

# The k-th allocation fails, and all after it, for k = 0, 1, 2 ... until the run
# succeeds: each time exit 5, one line, no crash, nothing left.  A word that was
# lost for want of memory is no failure, so a success has to be the same output.
# Short: every step'th from the 60th on.
stable() { # FILE: without the time and memory that a run takes
    sed '/^  seconds /d; s/"\(seconds\|peak_bytes\)":[^,}]*//g' "$1"
}
step=7
[ -z "${ISOLOFT_LONG-}" ] || step=1
sanitized && step=$((step * 5))
starve() { # SENTENCE COMMAND...: writes to box/
    sentence=$1
    shift
    k=0 why=
    rm -rf box whole
    mkdir box
    "$@" >out 2>/dev/null || why="it fails with all the memory there is"
    stable out >box/out
    cp -r box whole
    while [ -z "$why" ]; do
        rm -rf box
        mkdir box
        ISOLOFT_TEST_ALLOC=$k "$@" >out 2>err
        status=$?
        if [ $status -eq 0 ]; then
            stable out >box/out
            diff -r box whole >/dev/null || why="k = $k: exit 0 and other output"
            break
        elif [ $status -ne 5 ]; then
            why="k = $k: exit $status: $(head -n 3 err)"
        elif ! one_error; then
            why="k = $k: not one line: $(head -n 3 err)"
        else
            for file in box/* box/.[!.]*; do # in a folder a stack may have been written before
                [ ! -e "$file" ] || [ "$file" = box/index.json ] || cmp -s "$file" "whole/${file#box/}" ||
                    why="k = $k: left $file"
            done
        fi
        k=$((k + 1))
        [ $k -lt 60 ] || k=$((k + step - 1))
    done
    if [ -n "$why" ] || [ $k -lt 3 ]; then
        case_bad "$sentence" "$why" "k = $k"
    else
        case_ok "$sentence ($k allocations)"
    fi
}
starve "convert survives every failing allocation" "$ISOLOFT" block.loft -o box/b.stl
starve "so does SVG, with pairs and a dome" "$ISOLOFT" small.svg --cap dome -o box/b.ply --pairs box/p.loft
starve "so do gaps and slices that stand alone" "$ISOLOFT" broken.loft --gap cap --cap dome -o box/b.ply --pairs box/p.loft
for form in $forms; do
    small_set | set_as $form >set.$form
    starve "so do structure sets: a keyhole, a gap and a slice alone, in the form of $form" "$ISOLOFT" set.$form -o box/b.ply
done
starve "so does a folder of them" "$ISOLOFT" set.dcmdump -o box/ -t stl
starve "so do their coordinates as RAS" "$ISOLOFT" set.json --ras -o box/b.obj
starve "so does --list" "$ISOLOFT" --list set.xml
starve "so does info of them" "$ISOLOFT" info set.dcmdump
starve "so does read" "$ISOLOFT" read small.svg -o box/b.loft
starve "so does match" "$ISOLOFT" match block.loft -o box/b.loft
"$ISOLOFT" match block.loft --links-out block.links >/dev/null
starve "so do links that are written" "$ISOLOFT" match block.loft -o box/b.loft --links-out box/b.links
starve "and read" "$ISOLOFT" match --links block.links block.loft -o box/b.loft
starve "so does mesh" "$ISOLOFT" mesh block.loft -o box/b.obj --to in
starve "so does a folder" "$ISOLOFT" block.loft -o box/ -t obj
for name in ffd arcs cut; do
    starve "so does plot of a pair: $name" "$ISOLOFT" plot "$srcdir/formats/loft/valid/v_pair_$name.loft" --pair 0 -o box/p.svg
done
starve "and of all pairs" "$ISOLOFT" plot "$srcdir/formats/loft/valid/v_pair_arcs.loft" -o box/
starve "and of a skeleton" "$ISOLOFT" plot block.loft --skeleton -o box/s.svg
starve "so does info" "$ISOLOFT" info block.loft
starve "so does the list of a structure set" "$ISOLOFT" --list --roi '[VE]*' "$srcdir/examples/phantom.dcmdump.txt"
starve "and a tilted one, turned" "$ISOLOFT" "$srcdir/formats/dcmdump/valid/v_tilted.txt" --ras -o box/t.stl
printf 'isoloft 1\nunit m\nstack "hill"\nkind terrain\nslice 5\nline\n0 0\n1 0\n2 0\nline\n1 0\n2 0\n3 0\nline\n3.5 0\n9 0\nline\n7 7\nring\n0 5\n1 5\n1 6\nend\n' >lines.loft
starve "so do isolines, joined" "$ISOLOFT" read lines.loft --join 1 -o box/l.loft
starve "and listed" "$ISOLOFT" --list lines.loft
printf 'isoloft 1\nunit m\nstack "hill"\nkind terrain\nslice 5\nring\n30 0\n60 30\n30 60\n0 30\nslice 10\nring\n30 20\n40 30\n30 40\n20 30\nslice 25\nline\n0 10\n2 2\n10 0\nend\n' >hill.loft
starve "so do surfaces of terrain" "$ISOLOFT" hill.loft -o box/t.ply
starve "and solids of it" "$ISOLOFT" hill.loft --solid --fit 100 -o box/t.stl
starve "and isolines between its own" "$ISOLOFT" hill.loft --between 2 -t loft -o box/t.loft
starve "and described" "$ISOLOFT" info hill.loft
# A few isolines, two of them of one line, in every format; degrees are projected.
few() { relief "$1" | awk 'NR < 3 || NR > 8 { print $1, $2, $3, $4, $5, $6 } NR == 2 { print $1, $6, $7 }'; }
echo "$map_forms" >forms
while read -r form reader units; do
    [ -n "$form" ] && is_read "$reader" || continue
    few "${units##* }" | map_as "$form" "${units##* }" >map.$form
    starve "so does a map in the form of $form" "$ISOLOFT" read map.$form -o box/m.loft
done <forms
few degrees | map_as geojson degrees >map.geojson
starve "and one joined over gaps, by one of its attributes" "$ISOLOFT" read map.geojson --height elev --join 500 --project utm -o box/m.loft
starve "and listed" "$ISOLOFT" --list map.geojson --json
awk 'BEGIN {
    print "min,max,wkt"
    for (k = 0; k < 4; k++)
        printf "%d,%d,\"POLYGON((%d 0,%d 0,%d 9,%d 9,%d 0))\"\n", k, k + 1, 9 * k, 9 * k + 9, 9 * k + 9, 9 * k, 9 * k }' >bands.csv
starve "and bands" "$ISOLOFT" read bands.csv --unit m -o box/m.loft
for name in code_page float index_leaves_out; do
    cp "$srcdir/formats/shp/valid/v_$name".* .
    starve "and a shapefile: $name" "$ISOLOFT" read v_$name.shp -o box/m.loft
done
starve "so does check of a mesh" "$ISOLOFT" check block.ply
starve "so does check of a stream" "$ISOLOFT" check block.loft
exits 5 "out of memory is exit 5" env ISOLOFT_TEST_ALLOC=0 "$ISOLOFT" block.loft
holds "and says so" grep -q "out of memory" err

if [ -f "$builddir/config.h" ] && ! sanitized; then
    # SENTENCE MOST COMMAND...: twice the input takes at most MOST percent of the memory
    doubles() {
        sentence=$1 most=$2
        shift 2
        "$@" once.loft --json=once.json -o once.out && "$@" twice.loft --json=twice.json -o twice.out
        a=$(sed 's/.*"peak_bytes":\([0-9]*\).*/\1/' once.json) b=$(sed 's/.*"peak_bytes":\([0-9]*\).*/\1/' twice.json)
        if [ $((b * 100)) -le $((a * most)) ]; then
            case_ok "$sentence"
        else
            case_bad "$sentence" "$a bytes, then $b"
        fi
    }
    pillar 400 200 >once.loft
    pillar 800 200 >twice.loft
    doubles "twice the slices: memory grows by less than a tenth in read" 110 "$ISOLOFT" read -t loft
    doubles "and in match by overlap" 110 "$ISOLOFT" match --pieces overlap -t loft
    doubles "and linked over the whole stack in less than 1.7 times" 170 "$ISOLOFT" match -t loft
    doubles "and to a mesh in less than 2.3 times" 230 "$ISOLOFT" -t ply
    pillar 12 4000 >once.loft
    pillar 12 8000 >twice.loft
    doubles "twice the vertices a slice: less than 2.3 times" 230 "$ISOLOFT" -t ply
    pillar 3000 4 >once.loft
    pillar 6000 4 >twice.loft
    doubles "twice the slices of four vertices: less than 2.3 times" 230 "$ISOLOFT" -t stl

    # what linking holds, as the manual says: 25 bytes a vertex, with what the reader's growth leaves
    held() { "$ISOLOFT" match "$@" twice.loft -t loft -o twice.out --json=held.json && sed 's/.*"peak_bytes":\([0-9]*\).*/\1/' held.json; }
    pillar 4000 200 >twice.loft
    a=$(held --pieces overlap) b=$(held --no-pieces)
    holds "linking over the whole stack holds at most 36 bytes a vertex" test $((b - a)) -le $((36 * 800000))

    # points far denser than keyholes are wide lie beside one another all along
    pillar 2 40000 >dense.loft
    peak() { "$ISOLOFT" read -t loft "$@" dense.loft -o dense.out --json=dense.json && sed 's/.*"peak_bytes":\([0-9]*\).*/\1/' dense.json; }
    a=$(peak --no-keyhole) b=$(peak --keyhole 0.05)
    holds "reading and searching them for keyholes takes at most three times the memory of reading" test "${b:-0}" -le $((3 * a))
else
    skip "twice the input, at most 2.3 times the memory" "sanitizers keep memory of their own"
fi

plan
