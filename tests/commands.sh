# commands.sh - the verbs as a user types them, and what they have to agree in.
. "$srcdir/tests/tap.sh"

ply() { "$ISOLOFT" "$1" -t ply >"$2"; }

ply "$vase" whole.ply
holds "SVG and native text give the same bytes" sh -c '"$ISOLOFT" "$1" -t ply | cmp - whole.ply' - "$vase_svg"
for format in stl stl-ascii obj ply ply-ascii; do
    "$ISOLOFT" "$vase_svg" -t $format >whole
    "$ISOLOFT" read "$vase_svg" | "$ISOLOFT" match | "$ISOLOFT" mesh -t $format >pipe
    holds "read | match | mesh is convert, as $format" cmp whole pipe
done
"$ISOLOFT" convert "$vase" -t ply >verb.ply
holds "convert is what happens without a verb" cmp whole.ply verb.ply
"$ISOLOFT" read "$vase" | "$ISOLOFT" mesh -t ply >unmatched.ply
holds "mesh takes streams that are not matched" cmp whole.ply unmatched.ply
"$ISOLOFT" -o named.ply "$vase"
holds "-o FILE has the bytes of standard output, in the format of its name" cmp whole.ply named.ply
cat "$vase" | "$ISOLOFT" - -t ply >dash.ply
holds "a dash is standard input" cmp whole.ply dash.ply
gzip -c "$vase" | "$ISOLOFT" -t ply >gzip.ply
holds "compressed input is read" cmp whole.ply gzip.ply
cat "$vase" >./read
"$ISOLOFT" ./read -t ply >file.ply
holds "a file with the name of a verb is given as ./read" cmp whole.ply file.ply
"$ISOLOFT" -- "$vase" >default.stl
holds "without -o and -t the output is binary STL" test "$(wc -c <default.stl)" -eq \
    $((84 + 50 * $(od -An -tu4 -j80 -N4 default.stl)))

"$ISOLOFT" "$vase" -o with.ply --pairs pairs.loft
"$ISOLOFT" read "$vase" | "$ISOLOFT" match >match.loft
holds "--pairs writes what match writes" cmp pairs.loft match.loft
"$ISOLOFT" "$vase" -o with.stl --pairs pairs.loft
holds "--pairs does not depend on the format of the mesh" cmp pairs.loft match.loft
"$ISOLOFT" "$vase" -t loft >convert.loft
holds "-t loft gives matched contours" cmp convert.loft match.loft
"$ISOLOFT" match <match.loft >again.loft
holds "match leaves pairs as they are" cmp match.loft again.loft
"$ISOLOFT" mesh match.loft -t ply >matched.ply
holds "pairs of the stream give the same mesh" cmp whole.ply matched.ply
"$ISOLOFT" read "$vase" >read.loft
"$ISOLOFT" read read.loft >read2.loft
holds "read leaves what it wrote as it is" cmp read.loft read2.loft

cat "$vase" >both.loft
"$ISOLOFT" read both.loft -o both.loft
holds "a file can be read and replaced in one run" cmp both.loft read.loft
printf 'isoloft 1\nunit mm\nstack "a"\nend\n' >a.loft
holds "native streams follow one another" sh -c '"$ISOLOFT" read a.loft a.loft | grep -c "^stack" | grep -qx 2'
printf 'isoloft 1\nend\n' >empty.loft
holds "a stream without stacks is handed on" sh -c '"$ISOLOFT" read <empty.loft | "$ISOLOFT" match | cmp - empty.loft'
exits 3 "a stream without stacks makes no mesh" "$ISOLOFT" empty.loft -o none.stl
holds "and leaves no file" test ! -e none.stl

block hole >hole.loft
{ sed '$d' hole.loft; block other | sed 1,2d; } >two.loft
"$ISOLOFT" two.loft --stack 'ot*' -t obj >one.obj
holds "--stack takes the stacks that match" sh -c 'grep -q "^o other" one.obj && ! grep -q hole one.obj'
exits 3 "--stack that matches nothing is an error" "$ISOLOFT" two.loft --stack liver
holds "which says so" grep -q "liver" err
"$ISOLOFT" hole.loft --to um -t ply-ascii >um.ply
holds "--to converts lengths" grep -q '^9000 9000 2000 ' um.ply
"$ISOLOFT" read hole.loft --to in | "$ISOLOFT" mesh -t ply >in1.ply
"$ISOLOFT" hole.loft --to in -t ply >in2.ply
holds "and does so alike in every verb" cmp in1.ply in2.ply
exits 0 "conversions that round say so" "$ISOLOFT" hole.loft --to in -o in.ply
holds "with their number" grep -q "converted from mm to in: [0-9]* of [0-9]* coordinates rounded" err
"$ISOLOFT" hole.loft --cap dome -o dome.ply
holds "--cap dome puts something on top" sh -c '! cmp -s dome.ply in2.ply &&
    "$ISOLOFT" check dome.ply --json | grep -q "\"sound\":true"'

printf 'isoloft 1\nunit mm\nstack "a"\nslice 0\nring\n0 0\n4 4\n4 0\n0 4\nslice 1\nring\n0 0\n4 0\n4 4\n0 4\nend\n' >bow.loft
exits 0 "repairs are no failure" "$ISOLOFT" bow.loft -o bow.ply
holds "but told" grep -q "stack 'a': 1 x crossing" err
exits 3 "unless --strict" "$ISOLOFT" bow.loft --strict -o strict.ply
holds "and then nothing is written" test ! -e strict.ply
exits 3 "--strict holds for read as well" sh -c '"$ISOLOFT" read --strict bow.loft >strict.loft'
holds "and the stream has no end" sh -c '! grep -qx end strict.loft'
exits 0 "--strict passes clean input, to STL too" "$ISOLOFT" "$vase" --strict -o strict.stl
exits 0 "--strict passes SVG, whose y axis turns every ring" "$ISOLOFT" "$srcdir/examples/vase.svg" --strict -o strict.stl
exits 0 "-q says nothing" "$ISOLOFT" -q bow.loft -o bow.ply
holds "at all" test ! -s err

exits 0 "info says what is in it" "$ISOLOFT" info "$vase"
for word in "slices      33, z from 0 to 64 mm" "spacing     2 mm" "points      6000" "repairs     none" "components  1, genus 2" \
    "volume      2152[0-9]"; do
    holds "info: $word" grep -q "$word" out
done
exits 0 "info goes on where a stack has no surface" "$ISOLOFT" info a.loft "$vase"

exits 0 "check finds a mesh sound" "$ISOLOFT" check whole.ply
exits 0 "and an STL" "$ISOLOFT" check default.stl
exits 0 "and an OBJ" sh -c '"$ISOLOFT" "$1" -t obj | "$ISOLOFT" check' - "$vase"
exits 0 "and a stream" "$ISOLOFT" check read.loft
holds "which is canonical" grep -q "canonical   yes" out
exits 0 "a stream need not be canonical" "$ISOLOFT" check "$vase"
holds "which is said" grep -q "canonical   no, line" out
exits 1 "a stream that needs repair is not sound" "$ISOLOFT" check bow.loft
exits 1 "a mesh with a hole is not sound" sh -c '"$ISOLOFT" "$1" -t obj | awk "/^f/ && !cut++ { next } { print }" |
    "$ISOLOFT" check' - "$vase"
exits 3 "other files are neither" "$ISOLOFT" check "$vase_svg"
exits 3 "match wants a native stream" "$ISOLOFT" match "$vase_svg"
holds "and says what makes one" grep -q "isoloft read" err

plan
