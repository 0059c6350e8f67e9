# surface.sh - surfaces of maps as typed: open ones and solids, their place, their account.
. "$srcdir/tests/tap.sh"
. "$srcdir/tests/maps-forms.sh"

# ---- terrains: a line an isoline, H X,Y X,Y ... ------------------------------------

# Rings around the origin: HEIGHT RADIUS ... in turn, of 24 points each.
rings() {
    awk -v list="$*" 'BEGIN {
        m = split(list, v, " ")
        for (i = 1; i < m; i += 2) {
            text = v[i]
            for (k = 0; k <= 24; k++)
                text = text sprintf(" %.3f,%.3f", 500300.5 + v[i + 1] * cos(k % 24 * 0.2617993877991494), 4000200.25 + v[i + 1] * sin(k % 24 * 0.2617993877991494))
            print text
        } }'
}
# The ground x y / 10 where |x|, |y| <= 10: rises to two corners and falls to the others.
saddle() {
    awk 'BEGIN {
        for (h = -7; h <= 7; h += 2)
            for (side = -1; side <= 1; side += 2) {
                text = h
                s = h < 0 ? -1 : 1
                low = h * s
                for (k = 0; k <= 16; k++) {
                    x = low * (10 / low) ^ (k / 16)
                    text = text sprintf(" %.4f,%.4f", side * x, side * s * 10 * low / x)
                }
                print text
            } }' | sed 's/\.0000//g'
}
rings 10 50 20 40 30 30 40 20 50 10 >cone.lines
rings 10 60 20 50 30 40 40 30 40 20 30 10 >volcano.lines
saddle >saddle.lines
for name in cone volcano saddle; do
    map_as loft metres <$name.lines | sed "s/^stack .*/stack \"$name\"/" >$name.loft
done

# Vertices of ./out, a PLY as text: "x y z stack slice ring vertex"; a stack has no colour.
vertices() { awk 'in_data && NF == 7; /^end_header/ { in_data = 1 }' out; }
# The height of the vertex nearest to (X, Y).
height_near() {
    vertices | awk -v x="$1" -v y="$2" '{ d = ($1 - x) ^ 2 + ($2 - y) ^ 2; if (NR == 1 || d < least) { least = d; z = $3 } } END { print z }'
}
between() { awk -v low="$1" -v value="$2" -v high="$3" 'BEGIN { exit !(low < value && value < high) }'; }

for name in cone volcano saddle; do
    exits 0 "$name: a surface" "$ISOLOFT" $name.loft -t ply-ascii
    holds "says nothing" test ! -s err
    points=$(awk 'NF == 2 && $1 + 0 == $1' $name.loft | wc -l)
    holds "has every vertex of the lines" test "$(vertices | awk '$7 >= 0' | wc -l)" -eq "$points"
    vertices | awk '$7 >= 0 { printf "%.9g %.9g %.9g\n", $1, $2, $3 }' | sort >got
    awk '$1 == "slice" { z = $2 } NF == 2 && $1 + 0 == $1 { printf "%.9g %.9g %.9g\n", $1, $2, z }' $name.loft | sort >want
    holds "where they were" cmp got want
    cp out $name.ply
    exits 1 "it ends at the frame" "$ISOLOFT" check $name.ply
    holds "which check calls open" grep -q "closed  *no, .* edges of one triangle" out
    holds "and else it is sound" test "$(grep -c -e 'manifold *yes' -e 'oriented *yes' -e 'crossings *none' out)" -eq 3
    exits 0 "$name: a solid" "$ISOLOFT" $name.loft --solid -o $name.stl
    exits 0 "is closed and sound" "$ISOLOFT" check $name.stl
    holds "in one piece" grep -q "components  *1, genus 0" out
done
cp cone.ply out
holds "a peak rises above its last line, by less than an interval" between 50.5 "$(height_near 500300.5 4000200.25)" 59.901
cp volcano.ply out
holds "a crater goes down behind its last line" between 20.099 "$(height_near 500300.5 4000200.25)" 29.5
cp saddle.ply out
holds "a saddle lies between its levels" between -0.991 "$(height_near 0 0)" 0.991

# ---- the same from everywhere -------------------------------------------------------

bare() { sed '/^comment/d'; } # names and coordinate systems are in comments
"$ISOLOFT" cone.loft -t ply-ascii | bare >want
for form in geojson geojsonseq gmt csv-wkt csv-comma bln dxf; do
    map_as $form metres <cone.lines >cone.$form
    holds "the surface of $form is that of the native stream" sh -c '"$1" -q "$2" --unit m -t ply-ascii | sed /^comment/d | cmp - want' - "$ISOLOFT" cone.$form
done
relief metres >relief.lines
split -l 4 relief.lines sheet.
map_as geojson metres <relief.lines >relief.json
for sheet in sheet.??; do
    map_as geojson metres <"$sheet" >"$sheet.json"
done
"$ISOLOFT" -q relief.json -o whole.ply
holds "sheets of a map give the mesh of the whole" sh -c '"$1" -q sheet.??.json -t ply | cmp - whole.ply' - "$ISOLOFT"
for options in "-t ply" "-t obj --solid --fit 80" "-t stl" "-t stl --solid --fit 6in --z-scale 2.5" "-t ply --recentre --base 3 --solid"; do
    # shellcheck disable=SC2086 # options are several words
    "$ISOLOFT" -q relief.json $options >want
    # shellcheck disable=SC2016,SC2086
    holds "read | mesh does what convert does: $options" sh -c '"$ISOLOFT" read -q relief.json | "$ISOLOFT" mesh -q "$@" | cmp - want' - $options
    # shellcheck disable=SC2086
    holds "so with match" sh -c '"$ISOLOFT" read -q relief.json | "$ISOLOFT" match -q | "$ISOLOFT" mesh -q "$@" | cmp - want' - $options
    for threads in 1 2 3 8; do
        # shellcheck disable=SC2086
        holds "and with $threads threads" sh -c '"$ISOLOFT" -q relief.json --threads '$threads' "$@" | cmp - want' - $options
    done
done

# ---- size and place -------------------------------------------------------------------

# Least and greatest of column K of the vertices in ./out.
range() { vertices | awk -v k="$1" 'NR == 1 || $k < low { low = $k } NR == 1 || $k > high { high = $k } END { printf "%.17g %.17g\n", low, high }'; }
extent() { range "$1" | awk '{ printf "%.12g\n", $2 - $1 }'; }
near() { awk -v a="$1" -v b="$2" 'BEGIN { d = a - b; exit !(-1e-9 < d && d < 1e-9) }'; }

"$ISOLOFT" -q cone.loft -t ply-ascii --solid --fit 150mm >out
holds "--fit 150mm is 150 mm" near "$(extent 1)" 150
"$ISOLOFT" -q saddle.loft -t ply-ascii --fit 6in --recentre >out
holds "--fit 6in is 152.4 mm" near "$(extent 1)" 152.4
holds "and the middle is the origin" test "$(range 1)" = "-76.200000000000003 76.200000000000003"
exits 0 "STL has it too" "$ISOLOFT" cone.loft --solid --fit 15cm -o fit.stl
exits 0 "as check sees" "$ISOLOFT" check fit.stl
holds "its size" grep -q "size  *150 x 150 x " out
"$ISOLOFT" -q cone.loft -t ply-ascii >out
high=$(range 3 | awk '{ print $2 }')
"$ISOLOFT" -q cone.loft -t ply-ascii --z-scale 3 >out
holds "--z-scale exaggerates heights" near "$(range 3 | awk '{ printf "%.17g", $2 / 3 }')" "$high"
holds "and no more" near "$(extent 1)" 100
"$ISOLOFT" -q cone.loft -t ply-ascii --solid --base -12.5 >out
holds "--base is the floor" test "$(range 3 | awk '{ print $1 }')" = -12.5
"$ISOLOFT" -q cone.loft -t ply-ascii --solid --base -12.5 --recentre >out
holds "which is 0 where the map is recentred" test "$(range 3 | awk '{ print $1 }')" = 0
exits 3 "a floor above the ground" "$ISOLOFT" cone.loft --solid --base 12 -o x.stl
holds "is refused" grep -q "floor at height 12 is not below the lowest point of the surface" err
holds "and nothing is written" test ! -e x.stl

# By offset and scale of the comments every vertex of a line comes back to where it was.
for options in --recentre "--fit 99 --recentre --solid --z-scale 1.5" "--fit 250" "--z-scale 7"; do
    # shellcheck disable=SC2086
    "$ISOLOFT" -q volcano.loft -t ply-ascii $options >out
    awk '$1 == "comment" && $4 == "offset" { for (k = 0; k < 3; k++) offset[k] = $(5 + k) }
         $1 == "comment" && $4 == "scale" { for (k = 0; k < 3; k++) scale[k] = $(5 + k) }
         in_data && NF == 7 && $7 >= 0 { printf "%.3f %.3f %g\n", $1 * scale[0] + offset[0], $2 * scale[1] + offset[1], $3 * scale[2] + offset[2] }
         /^end_header/ { in_data = 1 }' out | sort >got
    awk '$1 == "slice" { z = $2 } NF == 2 && $1 + 0 == $1 { printf "%.3f %.3f %g\n", $1, $2, z }' volcano.loft | sort >want
    holds "comments of PLY lead back to the map: $options" cmp got want
done
"$ISOLOFT" -q volcano.loft -t obj --recentre >out
holds "those of OBJ are the same" grep -q '^# stack 0 offset 500300.5 4000200.3 0$' out
"$ISOLOFT" -q volcano.loft -t ply-ascii >out
holds "without any of that nothing is said" sh -c '! grep -q -e offset -e scale out'
holds "a header of STL has the offset" sh -c 'head -c 80 volcano.stl | tr -d "\0" | grep -q "^STL isoloft offset 500300.5 4000200.3 [-0-9.]* volcano$"'
"$ISOLOFT" -q volcano.loft --no-recentre -o x.stl
holds "but for --no-recentre" sh -c 'head -c 80 x.stl | tr -d "\0" | grep -qx "STL isoloft volcano"'
sed 's/^unit m/unit deg/' saddle.loft >degrees.loft
exits 3 "degrees fit no length" "$ISOLOFT" degrees.loft --fit 100 -o x.ply
holds "and are to be projected" grep -q "degrees.loft:3: .*--project" err
exits 0 "but have a surface" "$ISOLOFT" degrees.loft -o x.ply

# ---- what is told ----------------------------------------------------------------------

exits 0 "metres in STL" "$ISOLOFT" cone.loft -o x.stl
holds "are told, in one line" test "$(grep -c 'STL has no unit: lengths are in m; --fit 150mm makes a model' err)" -eq "$(wc -l <err)"
exits 0 "with --fit" "$ISOLOFT" cone.loft --fit 100 -o x.stl
holds "they are not" test ! -s err
exits 0 "nor in PLY, which names the unit" "$ISOLOFT" cone.loft -o x.ply
holds "where it is m" grep -aq "^comment stack 0 .* unit m name cone" x.ply
exits 0 "-v says more" "$ISOLOFT" cone.loft -o x.ply --solid --fit 200 -v
holds "the volume in mm" grep -q "area .* mm^2, volume .* mm^3" err
holds "and the place" grep -q "offset 0 0 0, scale 0.5 0.5 0.5: a vertex times scale plus offset is its place on the map, in m" err
exits 0 "info describes the surface" "$ISOLOFT" info cone.loft
row() { holds "$1: $2" grep -q "^  $1  *$2" out; }
row surface 'certified, open at the frame; [0-9]* vertices, [0-9]* triangles$'
row frame 'bbox, [0-9]* faces$'
row 'mesh area' '1[0-9.]* m^2$'
holds "it has no volume" sh -c '! grep -q "^  volume" out'
exits 0 "and a solid" "$ISOLOFT" info cone.loft --solid --recentre --fit 200
row surface 'certified, a solid; '
row offset '500300.5 4000200.3 [-0-9.]* m$'
row scale '0.5 0.5 0.5; a vertex times scale'
row volume '[0-9.]*e\?[+0-9]* mm^3$'
if command -v jq >/dev/null; then
    value() { holds "$1 is $2" test "$(jq -c "$1" account.json)" = "$2"; }
    "$ISOLOFT" cone.loft -q -o x.stl --solid --fit 200 --json=account.json
    value '.stacks[0] | [.certified, .genus, .components, .volume > 0]' '[true,0,1,true]'
    value '.stacks[0].surface | [.solid, .frame, .unit, .faces > 4]' '[true,"bbox","mm",true]'
    value '.stacks[0].surface | [.offset[0], .scale]' '[500300.5,[0.5,0.5,0.5]]'
    "$ISOLOFT" cone.loft -q -o x.ply --json=account.json
    value '.stacks[0] | [.certified, .genus, .volume, .area > 10000]' '[true,null,null,true]'
    value '.stacks[0].surface | [.solid, .unit, .offset, .scale]' '[false,"m",[0,0,0],[1,1,1]]'
    "$ISOLOFT" read cone.loft -q --json=account.json >out
    value '.stacks[0].surface' null
    "$ISOLOFT" info --json cone.loft >account.json
    jq -r '.["$defs"].terrain.properties.surface.properties | keys[]' "$srcdir/formats/summary.schema.json" >schema
    jq -r '.stacks[0].surface | keys[]' account.json >keys
    holds "the schema has the keys of a surface" cmp schema keys
else
    skip "the account in JSON" "no jq"
fi

# ---- what is refused, left out, and does not apply ----------------------------------------

sed '$d' cone.loft >loose.loft
printf 'slice 70\nline\n500300 4000200\n500301 4000201\n500302 4000200\nend\n' >>loose.loft
exits 0 "a line that ends inside the map" "$ISOLOFT" loose.loft -o x.ply
holds "is left out, and told with its line" grep -q "skipped: loose.loft:[0-9]*: .*70 m.*ends inside the map" err
exits 0 "also where the mesh is in mm" "$ISOLOFT" loose.loft -o x.ply --fit 300
holds "which the map is not" grep -q "skipped: loose.loft:[0-9]*: .*70 m .*ends inside the map" err
rm -f x.ply
exits 3 "--strict refuses it" "$ISOLOFT" loose.loft -o x.ply --strict
holds "and writes nothing" test ! -e x.ply
exits 0 "and takes a map without faults" "$ISOLOFT" cone.loft -o x.ply --strict

awk '$1 == "slice" { n++ } n < 2 || $1 == "end"' cone.loft >level.loft
exits 3 "one level tells no side" "$ISOLOFT" level.loft -t ply-ascii
holds "which --high would" grep -q -e "--high" err
"$ISOLOFT" level.loft -q -t ply-ascii --high left >out
holds "a hill" between 10 "$(height_near 500300.5 4000200.25)" 99
"$ISOLOFT" level.loft -q -t ply-ascii --high right >out
holds "or a hole" between -99 "$(height_near 500300.5 4000200.25)" 10

exits 0 "solids and terrain in one stream" sh -c '{ sed "\$d" cone.loft; sed 1d "$1"; } >both.loft; "$ISOLOFT" both.loft --solid -t ply-ascii' - "$vase"
holds "count as they came" test "$(vertices | awk '$7 >= 0 { n[$4 " "]++ } END { for (k in n) printf "%s", k }' | tr ' ' '\n' | sort | tr -d '\n')" = 01
holds "and what is for terrain says so" grep -q "stack 'vase': --solid is for terrain, which this is not" err
exits 0 "each gets its file in a folder" "$ISOLOFT" both.loft -o folder/
holds "the terrain" "$ISOLOFT" check --quiet folder/0002-vase.stl
holds "and the solid" test -s folder/0001-cone.stl
exits 0 "--pairs of terrain" "$ISOLOFT" cone.loft -o x.ply --pairs pairs.loft
holds "has no pairs, which is told" grep -q "terrain has no pairs: --pairs holds its lines alone" err
holds "but the lines" sh -c '"$ISOLOFT" read -q cone.loft | cmp - pairs.loft'

# Lines of several levels that run together; a level's rings are "Z: x y, x y, ...; ...".
map_of() {
    printf 'isoloft 1\nunit m\nstack "cliffs"\nkind terrain\n'
    for level in "$@"; do
        printf 'slice %s\n' "${level%%:*}"
        printf '%s\n' "${level#*:}" | tr ';' '\n' | while IFS= read -r ring; do
            printf 'ring\n'
            printf '%s\n' "$ring" | tr ',' '\n' | sed 's/^ *//'
        done
    done
    echo end
}
cliff() { # WHAT LEVEL...: both outputs sound, every vertex there
    what=$1
    shift
    map_of "$@" >cliff.loft
    exits 0 "$what" "$ISOLOFT" cliff.loft --solid -o cliff.ply
    holds "and is sound" "$ISOLOFT" check --quiet cliff.ply
    exits 0 "also to print" "$ISOLOFT" cliff.loft --solid --fit 150mm -q -o cliff.stl
    holds "and sound then" "$ISOLOFT" check --quiet cliff.stl
}
sea='10: 0 0, 100 0, 100 100, 0 100'
hill='20: 20 20, 80 20, 80 80, 20 80'
cliff "two levels share an edge" "$sea" "$hill" '30: 40 20, 60 20, 60 60, 40 60'
cliff "three levels share one" "$sea" "$hill" '30: 40 20, 60 20, 60 60, 40 60' '40: 45 20, 55 20, 50 30'
"$ISOLOFT" cliff.loft -t ply-ascii -o cliff.ply 2>err
holds "which is told" grep -q "isolines of different heights run together: [0-9]* triangles stand upright" err
lacks=$(awk 'NR == FNR { at[$1 " " $2 " " $3]; next } /^slice/ { z = $2 } NF == 2 && /^[0-9]/ && !(($0 " " z) in at) { n++ } END { print n + 0 }' cliff.ply cliff.loft)
holds "no point of the lines is lost" test "$lacks" = 0
cliff "they touch in a point" "$sea" '20: 20 20, 50 20, 80 20, 80 80, 20 80' '30: 50 20, 60 60, 40 60'
cliff "one level touches itself" "$sea" "$hill; 80 80, 90 80, 90 90, 80 90" '30: 40 40, 60 40, 50 60'
cliff "whole lines lie on each other" "$sea" "$hill" '30: 20 20, 80 20, 80 80, 20 80' '50: 40 40, 60 40, 50 60'
holds "one of which is left out" sh -c '"$ISOLOFT" cliff.loft -o x.ply 2>&1 | grep -q "skipped: cliff.loft:18: the isoline of 30 m (line 18): it meets another level"'
cliff "lines cross" "$sea" "$hill" '30: 40 40, 60 40, 90 60, 40 60'
holds "one of which is left out, and both are named" sh -c '"$ISOLOFT" cliff.loft -o x.ply 2>&1 |
    grep -q "the isoline of 30 m (line 18): both of its sides lie below it, against the isoline of 20 m (line 12)"'

exits 0 "what is for slices" "$ISOLOFT" cone.loft -o x.ply --cap dome
holds "does nothing to terrain, which is told" grep -q -e "--cap is for slices of solids, and terrain has none" err

plan
