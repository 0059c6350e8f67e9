# terrain.sh - isolines as typed: joined, described, drawn; their surfaces are in surface.sh.
. "$srcdir/tests/tap.sh"

cp "$srcdir/examples/island.geojson" .
"$ISOLOFT" read -q island.geojson >island.loft

# LINES of one level at z 5 as a stack of terrain: "0 0, 1 0" is a line, "ring: 0 0, ..." a ring.
terrain() {
    printf 'isoloft 1\nunit m\nstack "hill"\nkind terrain\nslice 5\n'
    for line in "$@"; do
        case $line in ring:*) echo ring ;; *) echo line ;; esac
        printf '%s\n' "${line#ring:}" | tr ',' '\n'
    done
    echo end
}

# ---- joined --------------------------------------------------------------------

holds "what read writes of a map, it reads and writes again" sh -c '"$ISOLOFT" read -q island.loft | cmp - island.loft'
# Every line in pieces of three edges, the last first.
awk '/^line|^ring/ { flush(); is_ring = /^ring/; next } /^slice|^end/ { flush(); print; next }
     !(/^-?[0-9]/) { print; next } { p[++n] = $0 }
     function flush(    i, k) {
         if (is_ring && n) p[++n] = p[1]
         if (n < 2) { n = 0; return }
         for (i = n - 1 - (n - 2) % 3; i >= 1; i -= 3) {
             print "line"
             for (k = i; k <= i + 3 && k <= n; k++) print p[k]
         }
         n = 0
     }' island.loft >cut.loft
exits 0 "lines that were cut" "$ISOLOFT" read cut.loft
holds "come back" cmp out island.loft
holds "and the joints are told" grep -q "[0-9] x joint where two ends meet" err
exits 3 "--strict refuses them" "$ISOLOFT" read --strict cut.loft
exits 0 "and takes what is whole" "$ISOLOFT" read --strict island.loft

terrain '0 0,1 0,2 0' '2.25 0,3 0,4 0' '9 9,8 8' >gap.loft
exits 0 "ends that lie apart stay so" "$ISOLOFT" read gap.loft
holds "three lines" test "$(grep -c '^line' out)" -eq 3
exits 0 "but for --join" "$ISOLOFT" read gap.loft --join 0.25
holds "two lines" test "$(grep -c '^line' out)" -eq 2
holds "one gap" grep -q "1 x gap between two ends bridged" err
holds "which is told" grep -q "the widest gap bridged by --join is 0.25 m" err
exits 0 "--join is taken back" "$ISOLOFT" read gap.loft --join 0.25 --no-join
holds "by --no-join" test "$(grep -c '^line' out)" -eq 3
exits 2 "--join is a length" "$ISOLOFT" read gap.loft --join -1
exits 0 "solids" "$ISOLOFT" read "$vase" --join 1
holds "have nothing to join" grep -q "join is for terrain" err
paired() { # GROUP LINES of the second slice
    printf 'isoloft 1\nunit m\nstack "a"\nkind terrain\nslice 0\nring\n0 0\n9 0\n9 9\nslice 1\nring\n%bpair\nmatcher none\n%bend\n' "$2" "$1" >pair.loft
}
paired 'group\nlower 0\nupper 0\n' '1 1\n5 1\n5 5\n'
exits 0 "a pair of lines that are as they were stays" "$ISOLOFT" read pair.loft
holds "as it was" cmp out pair.loft
paired 'group\nlower 0\nupper 0\n' '1 1\n5 1\n5 1\n5 5\n'
exits 3 "of others it speaks no longer" "$ISOLOFT" read pair.loft
holds "and is refused" grep -q "pair.loft:16: this pair speaks of lines that are joined" err
paired '' '1 1\n5 1\n5 1\n5 5\n'
exits 0 "unless it says nothing of them" "$ISOLOFT" read pair.loft
paired '' '1 1\n5 1\n5 1\n1 1\n'
exits 3 "and both are there" "$ISOLOFT" read pair.loft

# ---- described -----------------------------------------------------------------

exits 0 "info describes a map" "$ISOLOFT" info island.geojson
row() { holds "$1: $2" grep -q "^  $1  *$2" out; }
row kind 'terrain$'
row crs 'EPSG:32629$'
row levels '14, from -120 to 140 m$'
row interval '20 m$'
row lines '25: 6 open, 19 closed$'
row 'open ends' '12, 0 of them inside the map$'
row points '2337$'
row 'spot heights' '5$'
row degrees 'longitude -9.62 to -9.532, latitude 53.04 to 53.0862$'
row length '136.07.* km, on the ellipsoid$'
row area '57.9.* km^2 in closed lines, on the ellipsoid$'
holds "and no sum of slices" sh -c '! grep -q -e "^  slice sum" out'
exits 0 "a native one knows how it was projected" "$ISOLOFT" info island.loft
row degrees 'longitude -9.62 to -9.532, latitude 53.04 to 53.0862$'
row length '136.07.* km, on the ellipsoid$'
row area '57.9.* km^2 in closed lines, on the ellipsoid$'
exits 0 "in another unit too" sh -c '"$0" read --to ft island.loft | "$0" info' "$ISOLOFT"
row length '136.07.* km, on the ellipsoid$'
exits 0 "in one that its numbers are not in, it does not" "$ISOLOFT" info --unit km island.loft
row length '136[0-9]* km$'
exits 3 "nor where it cannot be" sh -c 'sed "s/^slice -100/line\n9e14 9e14\n0 0\n&/" island.loft | "$0" info' "$ISOLOFT"
holds "which is said" grep -q "a point has no place in the projection" err
exits 0 "without it, it is measured in the plane" sh -c 'sed "/^geographic/d; /^projection/d" island.loft | "$ISOLOFT" info'
row length '136.02[0-9]* km$'
exits 0 "--list has a line of it" "$ISOLOFT" --list island.geojson
holds "with levels, lines and interval" grep -q "terrain .* 14  *25  *2337  *20 m" out

terrain 'ring:0 0,10 0,10 10,0 10' '0 20,5 20' '5 20,10 20' '30 50,40 55,50 50' '0 100,100 100' '3 3' |
    sed 's/^end$/slice 10\nring\n2 2\n8 2\n8 8\nslice 25\nring\n4 4\n6 4\n6 6\nslice 30\nring\n5 5\n5.5 5\n5.5 5.5\nend/' >odd.loft
exits 0 "what is unusual" "$ISOLOFT" --list odd.loft
holds "is told" grep -q "2 missing levels, 3 open ends inside the map, 1 line of one point, 1 joint, 1 line of two points" out
exits 0 "uneven intervals" sh -c 'sed "s/^slice 25/slice 17/" odd.loft | "$ISOLOFT" info'
row interval 'uneven: usually 7 m, least 5, largest 13$'
if command -v jq >/dev/null; then
    "$ISOLOFT" info --json odd.loft >odd.json
    value() { holds "$1 is $2" test "$(jq -c "$1" odd.json)" = "$2"; }
    value '.stacks[0].kind' '"terrain"'
    value '.stacks[0].crs' null
    value '.stacks[0].interval' 5
    value '.stacks[0].missing_levels' 2
    value '.stacks[0].extent' '[0,0,100,100]'
    value '[.stacks[0] | .open, .closed, .points, .ends_inside]' '[3,4,21,3]'
    value '[.stacks[0].levels[0] | .z, .open, .closed, .points, .area]' '[5,3,1,12,100]'
    value '[.stacks[0].levels[].z]' '[5,10,25,30]'
    value '.stacks[0].measured_on' '"plane"'
    value '.stacks[0].levels[0].length == 40 + 10 + 2 * (125 | sqrt) + 100' true
    value '.stacks[0].enclosed_area' '120.125'
    value '[.stacks[0].repairs | .joined_lines, .point_lines, .crumbs]' '[1,1,1]'
    value '[.stacks[0] | .slice_sum, .trapezoid_sum, .volume, .error, .status]' '[null,null,null,null,0]'
    jq -r '.["$defs"].terrain.properties | keys[]' "$srcdir/formats/summary.schema.json" | sort >schema
    jq -r '.stacks[0] | keys[]' odd.json | sort >keys
    holds "the schema has the keys of terrain" test "$(comm -23 schema keys)" = ""
else
    skip "the account in JSON" "no jq"
fi
exits 0 "degrees that stay degrees" "$ISOLOFT" info --project none island.geojson
row extent 'x -9.62 to -9.532, y 53.04 to 53.0862 deg$'
row levels '14, from -120 to 140 m$'
row length '136.07.* km, on the ellipsoid$'
exits 0 "solids and terrain in one stream" sh -c '{ sed "\$d" "$1"; sed 1d island.loft; } >both.loft; "$2" info both.loft' - "$vase" "$ISOLOFT"
holds "both have surfaces" test "$(grep -c '^  surface *certified' out)" -eq 2
holds "one has levels" test "$(grep -c '^  levels' out)" -eq 1

# ---- drawn and checked ---------------------------------------------------------

exits 0 "plot draws isolines" "$ISOLOFT" plot island.loft
holds "and fills none" sh -c 'grep -q "</svg>" out && ! grep -q "fill-rule" out'
exits 0 "a clean map is sound" "$ISOLOFT" check island.loft
exits 1 "one in pieces is not" "$ISOLOFT" check cut.loft
exits 0 "convert makes no mesh for contours" "$ISOLOFT" island.geojson -t loft
holds "and does as read does" cmp out island.loft

# ---- refused -------------------------------------------------------------------

exits 3 "match takes no maps" "$ISOLOFT" match island.geojson
holds "and says what makes them streams" grep -q "'match' takes the native format, which 'isoloft read' makes of it" err
exits 3 "nor does mesh" "$ISOLOFT" mesh island.geojson -o x.stl
exits 0 "match has nothing to do with isolines" "$ISOLOFT" match island.loft
holds "and hands them on" cmp out island.loft
holds "which it says" grep -q "terrain has no pairs to match" err

for option in '--height elev' --depth '--z-unit ft' '--project utm'; do
    exits 2 "$option is for maps" "$ISOLOFT" read "$vase_svg" $option
    holds "which an SVG is not" grep -q "is svg; ${option%% *} is for maps" err
done
for option in '--join 1' '--high left'; do
    exits 2 "$option is for isolines" "$ISOLOFT" read "$vase_svg" $option
    holds "which an SVG has none of" grep -q "is svg; ${option%% *} is for isolines" err
done
for option in --solid '--fit 150mm' '--z-scale 2' --recentre '--solid --base 3'; do
    exits 2 "$option is for isolines" "$ISOLOFT" "$vase_svg" $option -o x.stl
    holds "which an SVG has none of" grep -q "is svg; ${option%% *} is for isolines" err
done
exits 2 "--layer is for DXF" "$ISOLOFT" read island.geojson --layer x

plan
