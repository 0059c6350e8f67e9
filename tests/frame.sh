# frame.sh - where maps end: boxes, hulls, outlines of any format, and what is no outline.
. "$srcdir/tests/tap.sh"

cp "$srcdir/examples/island.geojson" .
vertices() { sed -n 's/^element vertex //p' "$1"; }

# ---- boxes and hulls -----------------------------------------------------------

exits 0 "a map ends at the box of its lines" "$ISOLOFT" -q island.geojson -o box.ply
exits 0 "which is the default" "$ISOLOFT" -q --frame bbox island.geojson -o same.ply
holds "byte by byte" cmp box.ply same.ply
"$ISOLOFT" read -q island.geojson >island.loft
exits 0 "a native stream knows the box of degrees" "$ISOLOFT" mesh -q island.loft -o same.ply
holds "so it gives the same mesh" cmp box.ply same.ply
exits 0 "or at their hull" "$ISOLOFT" -q --frame hull island.geojson -o hull.ply
holds "which is another" sh -c '! cmp -s box.ply hull.ply'
exits 0 "info tells which" "$ISOLOFT" info --frame hull island.geojson
holds "in words" grep -q "^  frame  *hull, " out

# ---- outlines --------------------------------------------------------------------

outer="-9.61 53.045,-9.54 53.045,-9.54 53.08,-9.61 53.08,-9.61 53.045"
hole="-9.59 53.05,-9.58 53.05,-9.58 53.06,-9.59 53.06,-9.59 53.05"
rows() { printf '%s\n' "$1" | tr ',' '\n'; }
pairs() { printf '%s' "$1" | sed 's/ /,/g; s/,\(-\)/],[\1/g; s/.*/[[&]]/'; }
printf '{"type":"Polygon","coordinates":[%s,%s]}\n' "$(pairs "$outer")" "$(pairs "$hole")" >outline.geojson
printf 'wkt\n"POLYGON((%s),(%s))"\n' "$outer" "$hole" >outline.csv
for ring in "$outer" "$hole"; do echo '>'; rows "$ring"; done >outline.gmt
for ring in "$outer" "$hole"; do echo '5,1'; rows "$ring" | tr ' ' ','; done >outline.bln
kml() { printf '<LinearRing><coordinates>%s</coordinates></LinearRing>' "$(rows "$1" | tr ' \n' ', ')"; }
printf '<kml xmlns="http://www.opengis.net/kml/2.2"><Placemark><Polygon><outerBoundaryIs>%s</outerBoundaryIs><innerBoundaryIs>%s</innerBoundaryIs></Polygon></Placemark></kml>' "$(kml "$outer")" "$(kml "$hole")" >outline.kml
{ printf 'isoloft 1\nunit deg\nstack ""\nslice 7\n'; for ring in "$outer" "$hole"; do echo ring; rows "$ring" | sed '$d'; done; echo end; } >outline.loft

exits 0 "or at a polygon with a hole" "$ISOLOFT" --frame outline.geojson --solid island.geojson -o lake.stl
holds "whose solid has a handle" sh -c '"$0" check lake.stl | grep -q "components  1, genus 1$"' "$ISOLOFT"
"$ISOLOFT" -q --frame outline.geojson island.geojson -o lake.ply
for form in csv gmt bln kml loft; do
    exits 0 "the same polygon from $form" "$ISOLOFT" --frame outline.$form island.geojson -o same.ply
    holds "makes the same mesh" cmp lake.ply same.ply
    case $form in csv | gmt | bln)
        holds "and that its numbers are degrees is told" grep -q "outline's numbers are taken as degrees" err ;;
    esac
done
exits 0 "a native map takes it as well" "$ISOLOFT" mesh -q --frame outline.kml island.loft -o same.ply
holds "and makes the same of it" cmp lake.ply same.ply
exits 0 "and one in feet" sh -c '"$0" read -q --to ft island.geojson | "$0" mesh -q --frame outline.kml -o feet.ply' "$ISOLOFT"

# A cone about 50, 50, with levels 10, 20, 30 at radii 45, 30, 15.
cone() {
    awk 'BEGIN { print "isoloft 1\nunit m\nstack \"cone\"\nkind terrain"
        for (level = 1; level <= 3; level++) {
            print "slice", 10 * level "\nring"
            for (k = 0; k < 40; k++) printf "%.9f %.9f\n", 50 + (60 - 15 * level) * cos(k * 0.157079632679), 50 + (60 - 15 * level) * sin(k * 0.157079632679)
        }
        print "end" }'
}
cone >cone.loft
square() { printf '{"type":"LineString","coordinates":[[%s,%s],[%s,%s],[%s,%s],[%s,%s],[%s,%s]]}\n' "$1" "$1" "$2" "$1" "$2" "$2" "$1" "$2" "$1" "$1"; }
square 20.5 90.5 >square.geojson
exits 0 "lines are cut at an outline" "$ISOLOFT" --unit m --frame square.geojson --no-detail cone.loft -o square.ply
holds "and lost nowhere" sh -c '! grep -q -e "ends inside" -e "isoline of" err'
# without detail: whether a triangle is just off the law or not may hang on rounding, and a thousand is no power of two
exits 0 "its numbers are those of the map before --to" "$ISOLOFT" -q --unit m --frame square.geojson --no-detail --to mm cone.loft -o mm.ply
holds "so the mesh has as many vertices" test "$(vertices square.ply)" = "$(vertices mm.ply)"
square 20.5 90.5 | sed 's/\[\[.*/[[20.5,20.5],[90.5,90.5],[90.5,20.5],[20.5,90.5],[20.5,20.5]]}/' >bow.geojson
exits 0 "an outline may cross itself" "$ISOLOFT" --unit m --frame bow.geojson cone.loft -o bow.ply
holds "which is told" grep -q "the outline crosses or touches itself at 1 place" err

cat >touching.geojson <<'END'
{"type":"Polygon","coordinates":[[[0,0],[50,0],[100,0],[100,100],[0,100],[0,0]],[[50,0],[60,10],[50,15],[40,10],[50,0]]]}
END
printf '%s\n' 'isoloft 1' 'unit m' 'stack "slope"' 'kind terrain' 'slice 10' line '0 20' '50 22' '100 20' \
    'slice 20' line '0 80' '50 82' '100 80' end >slope.loft
exits 0 "or touch itself at a point that no line comes near" "$ISOLOFT" --unit m --frame touching.geojson slope.loft -o slope.ply
exits 0 "where a solid is split" "$ISOLOFT" --unit m --frame touching.geojson --solid slope.loft -o touching.ply
holds "and is sound" "$ISOLOFT" check touching.ply
exits 0 "info tells of it" "$ISOLOFT" info --unit m --frame touching.geojson slope.loft
holds "in words" grep -q "pinches  *1, where the frame touches itself" out

# ---- what is none -----------------------------------------------------------------

refused() { # CODE SENTENCE WORDS FILE [ARGUMENT]...
    code=$1 sentence=$2 words=$3 file=$4
    shift 4
    exits "$code" "$sentence" "$ISOLOFT" "$@" cone.loft --frame "$file" -o none.ply
    if one_error && grep -q -e "$words" err && [ ! -e none.ply ]; then case_ok "and said"; else case_bad "and said" "$(cat err)"; fi
}
refused 3 "an outline beside the map is refused" "beside the map" outline.csv
square 20.5 80.5 >degrees.geojson
sed 's/^\([0-9][0-9.]*\) /500\1 /' cone.loft >metres.loft
exits 3 "and if it could be in degrees" "$ISOLOFT" --unit m metres.loft --frame degrees.geojson -o none.ply
holds "that is said" grep -q "beside the map; if its numbers are degrees, ogr2ogr -t_srs" err
refused 3 "so is one in degrees where the map is in metres" "in degrees and the map in m" outline.kml
printf '{"type":"LineString","coordinates":[[0,0],[9,0],[9,9]]}' >open.geojson
exits 3 "so is an open line" "$ISOLOFT" --unit m cone.loft --frame open.geojson -o none.ply
holds "and said" grep -q "no line of it is closed" err
printf '{"type":"Polygon","coordinates":[[[0,0],[9,9],[18,18],[0,0]]]}' >flat.geojson
refused 3 "so is one that encloses nothing" "encloses nothing" flat.geojson --unit m
refused 3 "so is a drawing" "which has no outlines of maps" "$vase_svg"
refused 4 "so is a file that is not there" "nowhere.geojson" nowhere.geojson
refused 2 "so is standard input" "name of a file" -
sed 's/^kind/crs "EPSG:32632"\n&/' cone.loft >utm.loft
sed 's/^{/{"crs":{"type":"name","properties":{"name":"EPSG:32633"}},/' square.geojson >zone.geojson
exits 3 "so is one in another system" "$ISOLOFT" utm.loft --frame zone.geojson -o none.ply
holds "and said" grep -q "the map is in EPSG:32632, and its outline in EPSG:32633" err
exits 0 "solids have no frame" "$ISOLOFT" "$vase" --frame hull -o vase.stl
holds "which is told" grep -q -e "--frame is for terrain" err

plan
