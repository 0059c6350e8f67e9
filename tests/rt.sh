# rt.sh - structure sets as a user meets them: lists, choices, sums, planes, coordinates.
. "$srcdir/tests/tap.sh"
. "$srcdir/tests/rt-dump.sh"

latin=$(printf 'Dr\303\274se')
dump_begin
roi 3 "$latin" '255\128\0' ORGAN
for z in 0 3 6; do square $z 10; done
roi 7 'PTV 50' '0\0\255' PTV
for z in 0 2 4 30 32; do square $z 10 50; done
square 4 10 50
roi 8 single '' ''
square 3 10 100
roi_named 9 'no item' ORGAN
roi 11 'no contours' '1\2\3'
roi 12 point '' MARKER
contour '1\2\3' POINT
dump_end >set.txt

# ---- --list -----------------------------------------------------------------------

exits 0 "a structure set is listed" "$ISOLOFT" --list set.txt
cat >expected <<END
NUMBER  NAME         TYPE    COLOUR   SLICES  RINGS  POINTS  SPACING  ODDITIES
     3  $latin        ORGAN   #ff8000       3      3      12     3 mm
     7  PTV 50       PTV     #0000ff       5      5      20     2 mm  1 gap, spacing unlike the others', 1 duplicate ring
     8  single       -       -             1      1       4        -  single slice
     9  no item      ORGAN   -             0      0       0        -  empty
    11  no contours  -       #010203       0      0       0        -  empty
    12  point        MARKER  -             0      0       0        -  empty, 1 part skipped
END
holds "in a table, aligned" diff out expected
holds "and nothing else is said" test ! -s err
for verb in convert read info; do
    "$ISOLOFT" $verb --list set.txt | cmp -s - expected || echo $verb
done >failed
holds "by all the verbs that read" test ! -s failed
exits 0 "so are files of other formats" "$ISOLOFT" --list "$vase_svg"
holds "by their stacks" sh -c '[ "$(wc -l <out)" -eq 2 ]'
exits 0 "and standard input" sh -c '"$ISOLOFT" --list <set.txt'
holds "with the same table" cmp out expected
exits 2 "a list has no output file" "$ISOLOFT" --list set.txt -o x.stl
if command -v script >/dev/null && script -qec true /dev/null >/dev/null 2>&1 </dev/null; then
    dump_begin
    roi 1 "$(awk 'BEGIN { for (k = 0; k < 30; k++) printf "long " }')"
    dump_end >long.txt
    script -qec "'$ISOLOFT' --list long.txt" /dev/null </dev/null >out 2>&1
    holds "long names are cut on a terminal" grep -q 'long \(long \)*lo*n*g*\.\.\.  *-' out
    "$ISOLOFT" --list long.txt >out
    holds "and nowhere else" sh -c '! grep -q "\.\.\." out'
else
    skip "long names are cut on a terminal" "no script(1)"
fi

dump_begin
roi 1 good
square 0 10; square 3 10
roi 2 bad
contour '0\0\0\1\0\0\1\nan\0'
square 3 10
roi 3 last
square 0 10; square 3 10
dump_end >fault.txt
exits 3 "an ROI with a fault shows in the list" "$ISOLOFT" --list fault.txt
holds "with its reason, and nothing else" grep -q '^ *2  bad .* -  failed: fault.txt:[0-9]*: ' out
holds "and the others as well" sh -c '[ "$(grep -c " 2  *2  *8 " out)" -eq 2 ]'

# ---- --roi -------------------------------------------------------------------------

chosen() { "$ISOLOFT" --list "$@" set.txt 2>/dev/null | awk 'NR > 1 { printf "%s ", $1 }'; }
while read -r numbers words; do
    eval "set -- $words"
    holds "--roi $words chooses" test "$(chosen "$@")" = "$(echo "$numbers" | tr , ' ') "
done <<END
7 --roi 'PTV*'
3,7 --roi 'PTV*' --roi 'D*'
3 --stack 'D?*se' --roi 'Dr?se'
3,7,8,12 --roi '!no*'
8 --roi '!*o*' --roi 's*' --roi 'P*' --stack '!PTV*'
END
exits 3 "a choice of nothing" "$ISOLOFT" --list --roi 'Dr??se' set.txt
holds "names some of what there is" grep -q "no name matches 'Dr??se'; there are '$latin', 'PTV 50', 'single', 'no item', 'no contours' and 1 more" err
holds "in one line" one_error
exits 0 "a mesh of one ROI" "$ISOLOFT" --roi D* set.txt -o one.ply
holds "is of that alone" sh -c '"$ISOLOFT" check one.ply --json | grep -q "\"components\":1"'

# ---- folders -----------------------------------------------------------------------

exits 3 "one file an ROI, one of which fails" "$ISOLOFT" fault.txt -o parts/
holds "writes the others" sh -c '[ "$(ls parts | tr "\n" " ")" = "0001-good.stl 0003-last.stl index.json " ]'
holds "the index has the reason" grep -q '"file":null,"number":2,"name":"bad","colour":null,"status":"failed","error":"fault.txt:[0-9]*: ' parts/index.json
exits 0 "empty ROIs are no failure" "$ISOLOFT" set.txt -o whole/ -t ply
for number in 9 11 12; do
    holds "empty ROI $number has no file" grep -q "{\"file\":null,\"number\":$number,\"name\":\"[^\"]*\",\"colour\":[^{]*,\"status\":\"empty\",\"error\":null}" whole/index.json
done
holds "the colour is in the index" grep -q '"number":3,"name":"[^"]*","colour":\[255,128,0\],"status":"ok"' whole/index.json
holds "there is a file for each of the others" sh -c '[ "$(ls whole | wc -l)" -eq 4 ]'

# ---- info --------------------------------------------------------------------------

exits 0 "info tells of ROIs" "$ISOLOFT" info set.txt
holds "their type and algorithm" sh -c 'grep -q "^  type        ORGAN" out && grep -q "^  algorithm   MANUAL" out'
holds "volumes in cm^3 as well" grep -q '^  volume      600 mm^3 = 0.6 cm^3' out
holds "areas times spacing" grep -q '^  slice sum   900 mm^3 = 0.9 cm^3' out
holds "trapezoids" grep -q '^  trapezoids  600 mm^3 = 0.6 cm^3' out
holds "without the gap" grep -q '^  trapezoids  600 mm^3 .*' out
if command -v jq >/dev/null; then
    "$ISOLOFT" info set.txt --json >info.json
    holds "in JSON: the organ" jq -e '.stacks[0] | .slice_sum == 900 and .trapezoid_sum == 600 and .volume == 600 and
        .type == "ORGAN" and .algorithm == "MANUAL" and .colour == [255, 128, 0] and .seconds >= 0 and .planes == null' info.json
    holds "the one with a gap" jq -e '.stacks[1] | .slice_sum == 1000 and .trapezoid_sum == 600 and .components == 2 and
        (.gaps | length) == 1 and (.oddities | length) == 3' info.json
    holds "the single slice, as thick as the spacing is usually" jq -e '.stacks[2] | .slices == 1 and .volume == .slice_sum and
        .volume == .trapezoid_sum and .volume > 0' info.json
    "$ISOLOFT" --list --json set.txt >list.json
    holds "the list is JSON too" jq -e '[.stacks[].number] == [3, 7, 8, 9, 11, 12] and .stacks[3].oddities == ["empty"]' list.json
    jq -r '.["$defs"].stack.properties | keys[]' "$srcdir/formats/summary.schema.json" | sort >schema
    jq -r '.stacks[0] | keys[]' list.json | sort >keys
    holds "with the keys of the schema" cmp schema keys
else
    skip "in JSON" "no jq"
fi

# ---- heights that look like one slice ----------------------------------------------

dump_begin
roi 1 near; for z in 0 2.5 5 5.6 7.5 10; do square $z 10; done
roi 2 even; for z in 0 2.5 5 7.5 10; do square $z 10 50; done
dump_end >near.txt
exits 0 "slices much nearer than usual are lofted" "$ISOLOFT" near.txt -o near.ply
holds "and told" sh -c '[ "$(grep -c "slices as near as" err)" -eq 1 ] && grep -q "near.: slices as near as 0.6 mm, where 2.5 mm is usual" err'

# ---- coordinates ---------------------------------------------------------------------

vertices() { awk '/^end_header/ { on = 1; next } /^element vertex/ { n = $3 } on && n-- > 0 { print $1, $2, $3 }' "$1"; }
sagittal() { awk -v x="$1" 'BEGIN { printf "%s\\0.1\\-7.25\\%s\\9.3\\-7.25\\%s\\9.3\\4.7\\%s\\0.1\\4.7", x, x, x, x }'; }
coronal() { awk -v y="$1" 'BEGIN { printf "0.1\\%s\\-7.25\\9.3\\%s\\-7.25\\9.3\\%s\\4.7\\0.1\\%s\\4.7", y, y, y, y }'; }
dump_begin
roi 1 sagittal; contour "$(sagittal 0.1)"; contour "$(sagittal 2.3)"; contour "$(sagittal 5.1)"
roi 2 coronal; contour "$(coronal 0.1)"; contour "$(coronal 2.3)"; contour "$(coronal 5.1)"
roi 3 axial; square 0.1 9.3 0.7 0.3; square 2.3 8.1 0.7 0.3
dump_end >planes.txt
exits 0 "planes across other axes are listed" "$ISOLOFT" --list planes.txt
holds "as what they are" sh -c 'grep -q "sagittal.*planes across x" out && grep -q "coronal.*planes across y" out'
exits 0 "their meshes" "$ISOLOFT" planes.txt -o lps/ -t ply-ascii
exits 0 "and those in RAS" "$ISOLOFT" planes.txt --ras -o ras/ -t ply-ascii
holds "say so once" sh -c '[ "$(grep -c "coordinates are RAS" err)" -eq 1 ]'
for file in 0001-sagittal 0002-coronal 0003-axial; do
    vertices lps/$file.ply >lps.xyz
    vertices ras/$file.ply | awk '{ print ($1 == 0 ? 0 : $1 ~ /^-/ ? substr($1, 2) : "-" $1), ($2 == 0 ? 0 : $2 ~ /^-/ ? substr($2, 2) : "-" $2), $3 }' >ras.xyz
    holds "$file: x and y have the other sign, to the last digit" cmp lps.xyz ras.xyz
    holds "$file: both are sound" sh -c "'$ISOLOFT' check lps/$file.ply && '$ISOLOFT' check ras/$file.ply"
    holds "$file: the file says it" grep -q '^comment stack [0-9]* coordinates RAS' ras/$file.ply
done
grep -o 'DS \[[^]]*' planes.txt | sed 's/DS .//' | tr '\\' '\n' | paste - - - | tr '\t' ' ' | sort -u >given
cat lps/*.ply >all.ply
for file in lps/*.ply; do vertices $file; done | sort -u | comm -13 - given >missing
holds "every point of the file is a vertex, digit by digit" test ! -s missing
for format in stl stl-ascii obj ply; do
    "$ISOLOFT" planes.txt --ras -q -t $format -o ras-$format/ || echo $format
    for file in ras-$format/000*; do
        case $file in *.mtl) continue ;; esac
        "$ISOLOFT" check "$file" >/dev/null || echo "$file"
    done
done >unsound
holds "all formats are sound in RAS" test ! -s unsound
"$ISOLOFT" planes.txt --ras -q -t ply >a.ply
"$ISOLOFT" read planes.txt --ras -q | "$ISOLOFT" match | "$ISOLOFT" mesh -q -t ply >b.ply
holds "read, match and mesh give the same bytes" cmp a.ply b.ply
exits 2 "other input has no RAS" "$ISOLOFT" "$vase" --ras -o x.stl
holds "in one line" one_error

# A frame takes the same contours to places that no float holds.
star() { # the FRAME line or nothing
    awk -v frame="$1" -v reach="$2" 'BEGIN { srand(7); print "isoloft 1\nunit mm\nstack \"star\""; if (frame) print frame
        for (z = 0; z < 5; z++) { print "slice", z, "\nring"
            for (k = 0; k < 40; k++) printf "%.3f %.3f\n", reach * rand(), reach * rand() }
        print "end" }'
}
tilt='frame 1000 -700.5 33 0.6 0.8 0 -0.64 0.48 0.6 0.48 -0.36 0.8'
star "$tilt" 40 >tilted.loft
for format in stl ply obj; do
    exits 0 "a tilted stack as $format" "$ISOLOFT" tilted.loft -q -o tilted.$format
    holds "has no crossings" sh -c "'$ISOLOFT' check tilted.$format --json | grep -q '\"degenerate_triangles\":0.*\"self_intersections\":0'"
done
star 'frame 3e8 0 0 1 0 0 0 1 0 0 0 1' 4 >far.loft
exits 6 "a stack that floats cannot hold where it belongs is refused" "$ISOLOFT" far.loft -q -o far.stl
holds "with its name and the place" grep -q "stack 'star' near (3[0-9.e+]*, [0-9.-]*, [0-9.-]*): " err
holds "and nothing is written" test ! -e far.stl
exits 0 "doubles hold it" "$ISOLOFT" far.loft -q -o far.ply
holds "soundly" "$ISOLOFT" check far.ply

# ---- limits ---------------------------------------------------------------------------

exits 3 "the points of an ROI can be limited" "$ISOLOFT" --list set.txt --max-points 23
holds "which one line says" sh -c '[ "$(wc -l <err)" -eq 1 ] && grep -q "more than 23 points in the contours of one ROI" err'
exits 0 "to what is there" "$ISOLOFT" --list set.txt --max-points 24
nested() { # N: sequences, one in another
    awk -v n="$1" -v item="$item" -v item_end="$item_end" -v end="$sequence_end" '
        /^\(3006,0020\)/ { for (k = 0; k < n; k++) print "(0040,a730) SQ (Sequence with undefined length #=1)  # u/l, 1 ContentSequence\n" item
            for (k = 0; k < n; k++) print item_end "\n" end }
        { print }' set.txt
}
nested 1000 >deep.txt
exits 0 "a thousand nested sequences are fine" "$ISOLOFT" --list deep.txt
nested 1001 >deep.txt
exits 3 "one more is not" "$ISOLOFT" --list deep.txt
exits 0 "but may be allowed" "$ISOLOFT" --list deep.txt --max-depth 1001

exits 0 "of several patterns one may match nothing" "$ISOLOFT" read --roi 'PTV*' --roi 'PVT*' --roi '!nix' set.txt
holds "which is told" grep -q "no name matches 'PVT\*'" err
holds "also of those that leave out" grep -q "no name matches 'nix'" err
holds "and not of those that match" sh -c '! grep -q "matches .PTV" err'

# ---- nothing left ---------------------------------------------------------------------

exits 0 "an ROI of points has no surface" "$ISOLOFT" --roi point --roi 'PTV*' --roi 'no item' set.txt -o left.stl
holds "since nothing is left of it" grep -q "stack 'point': nothing is left of its contours" err
holds "while another has none" grep -q "stack 'no item': it has no contours" err
exits 3 "--strict refuses it" "$ISOLOFT" --strict --roi point --roi single --roi 'no item' set.txt --thickness 1 -o strict/
holds "with its reason" grep -q "stack 'point': 0 repairs and 1 skipped parts, which --strict refuses" err
exits 0 "but not one that has none" "$ISOLOFT" --strict --roi 'no item' --roi "$latin" set.txt -o strict.stl

# ---- text that Windows wrote ----------------------------------------------------------

sample=$srcdir/formats/dcmdump/valid/v_organ.txt
{ printf '\357\273\277'; cat "$sample"; } >mark.txt
for option in "" "-f dcmdump"; do
    exits 0 "a byte order mark before a dump is dropped $option" "$ISOLOFT" read $option mark.txt
    holds "and changes nothing $option" cmp out "${sample%.txt}.loft"
done
printf '#\000 \000D\000i\000c\000' >wide.txt
{ printf '\377\376'; cat wide.txt; } >marked.txt
for file in wide marked; do
    exits 3 "UTF-16 is told: $file" "$ISOLOFT" $file.txt -o x.stl
    holds "with what makes text of it: $file" grep -q "$file.txt: is UTF-16, .* iconv -f UTF-16 -t UTF-8" err
done

# ---- binary files ---------------------------------------------------------------------

{ awk 'BEGIN { for (k = 0; k < 128; k++) printf "x" }'; printf 'DICM\002\000\000\000UL\004\000'; } >rs.dcm
printf '\010\000\005\000CS\012\000ISO_IR 100' >explicit.dcm
printf '\010\000\005\000\012\000\000\000ISO_IR 100' >implicit.dcm
printf '\000\010\000\005CS\000\012ISO_IR 100' >big.dcm
for file in rs explicit implicit big; do
    exits 3 "a binary file: $file" "$ISOLOFT" $file.dcm -o x.stl
    holds "is told with the command that helps" grep -q "$file.dcm: is a binary DICOM file; dcmdump +L '$file.dcm' | isoloft reads its text" err
    holds "in one line" one_error
done
exits 3 "a binary file on standard input" sh -c '"$ISOLOFT" <rs.dcm'
holds "has no name" grep -q 'dcmdump +L FILE | isoloft' err
cp rs.dcm "$(printf "it's\033.dcm")"
exits 3 "a name that no quotes hold" "$ISOLOFT" "$(printf "it's\033.dcm")"
holds "stays out of the command" grep -q 'dcmdump +L FILE | isoloft' err

plan
