# projection.sh - longitudes and latitudes in metres, against the programs that come
# with GeographicLib, which compute by other ways than the library calls used here.
. "$srcdir/tests/tap.sh"

# lines SEED WEST EAST SOUTH NORTH: 100 lines of two points, each a level of its own, so
# that they stay in order; the points also go to ./points as "lat lon".
lines() {
    awk -v seed="$1" -v w="$2" -v e="$3" -v s="$4" -v n="$5" '
        function lon() { return sprintf("%.7f", w + (e - w) * rand()) }
        function lat() { return sprintf("%.7f", s + (n - s) * rand()) }
        BEGIN {
            srand(seed)
            for (k = 0; k < 100; k++) {
                x = lon(); y = lat()
                u = sprintf("%.7f", x + 0.001 * rand()); v = sprintf("%.7f", y + 0.001 * rand())
                print y, x "\n" v, u >"points"
                printf "{\"type\":\"Feature\",\"properties\":{\"elev\":%d},\"geometry\":{\"type\":\"LineString\",\"coordinates\":[[%s,%s],[%s,%s]]}}\n",
                    100 + k, x, y, u, v
            }
        }'
}

# The vertices of the native stream on stdin, a line each.
vertices() { grep -E '^-?[0-9.]+ -?[0-9.]+$'; }

# near FILE FILE: the same number of pairs, none farther apart than a micrometre.
near() {
    paste "$1" "$2" | awk '
        function off(a, b) { return a > b ? a - b : b - a }
        NF != 4 || off($1, $3) > 1.01e-6 || off($2, $4) > 1.01e-6 { print; bad = 1 }
        END { exit bad || NR != 200 }'
}

# grid SENTENCE CRS GEOCONVERT-OPTIONS SEED WEST EAST SOUTH NORTH
grid() {
    sentence=$1 crs=$2 options=$3
    shift 3
    lines "$@" >map.geojsonl
    # shellcheck disable=SC2086 # options
    GeoConvert -u -p 6 $options <points | awk '{ print $(NF - 1), $NF }' >expected
    exits 0 "$sentence is projected" "$ISOLOFT" read --unit deg map.geojsonl
    holds "its system is $crs" grep -qx "crs \"$crs\"" out
    vertices <out >got
    holds "every point lies where it should to a micrometre" near got expected
}

if command -v GeoConvert >/dev/null && command -v TransverseMercatorProj >/dev/null; then
    grid "a map in a zone of the north" EPSG:32616 "-z 16" 1 -89.9 -84.1 30 33
    grid "one that leaves its zone a little" EPSG:32616 "-z 16" 2 -90.4 -83.6 60 62
    grid "one of the south" EPSG:32719 "-z 19" 3 -71 -67 -40 -38
    grid "one at the pole" EPSG:5041 "" 4 -170 170 85 89
    grid "one at the other pole" EPSG:5042 "" 5 -179 179 -89 -81
    grid "one in the wide zone of Norway" EPSG:32632 "-z 32" 6 3.5 8 57 63

    lines 7 -163 -153 17 24 >map.geojsonl
    exits 0 "a map wider than a zone gets a meridian of its own" "$ISOLOFT" read map.geojsonl
    vertices <out >got
    lon0=$(sed -n 's/.*+lon_0=\([^ ]*\) .*/\1/p' out) lat0=$(sed -n 's/.*+lat_0=\([^ ]*\) .*/\1/p' out)
    y0=$(echo "$lat0 $lon0" | TransverseMercatorProj -l "$lon0" -k 1 -p 6 | awk '{ print $2 }')
    TransverseMercatorProj -l "$lon0" -k 1 -p 6 <points | awk -v y0="$y0" '{ printf "%.6f %.6f\n", $1, $2 - y0 }' >expected
    holds "and every point lies where it should to a micrometre" near got expected

    lines 8 -60 50 10 24 >map.geojsonl
    exits 0 "so does one as wide as an ocean" "$ISOLOFT" read --project tm map.geojsonl
    vertices <out >got
    lon0=$(sed -n 's/.*+lon_0=\([^ ]*\) .*/\1/p' out) lat0=$(sed -n 's/.*+lat_0=\([^ ]*\) .*/\1/p' out)
    y0=$(echo "$lat0 $lon0" | TransverseMercatorProj -l "$lon0" -k 1 -p 6 | awk '{ print $2 }')
    TransverseMercatorProj -l "$lon0" -k 1 -p 6 <points | awk -v y0="$y0" '{ printf "%.6f %.6f\n", $1, $2 - y0 }' >expected
    holds "to a micrometre too" near got expected
else
    skip "projections against GeographicLib's programs" "no geographiclib-tools"
fi

lines 9 170 190 -20 -10 >map.geojsonl
"$ISOLOFT" read -q --threads 1 map.geojsonl >one
holds "a map across the antimeridian has one projection" grep -Eq '^crs "[+]proj=tmerc .*[+]lon_0=-?(179[.]9|180)' one
# The same longitudes, those beyond 180 counted from the west.
awk '{ out = ""; rest = $0
       while (match(rest, /\[18[0-9]\.[0-9]+/)) {
           out = out substr(rest, 1, RSTART) sprintf("%.7f", substr(rest, RSTART + 1, RLENGTH - 1) - 360)
           rest = substr(rest, RSTART + RLENGTH)
       }
       print out rest }' map.geojsonl >west.geojsonl
"$ISOLOFT" read -q west.geojsonl >other
vertices <one >a
vertices <other >b
holds "however its longitudes are counted" near a b

plan
