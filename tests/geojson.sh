# geojson.sh - GeoJSON as typed: pipes, several files, what other programs write, and
# what means harm.
. "$srcdir/tests/tap.sh"

samples=$srcdir/formats/geojson

same() { # SENTENCE FILE FILE
    if cmp "$2" "$3" >out 2>&1; then case_ok "$1"; else case_bad "$1" "$(cat out)" "$(diff "$2" "$3" | head -n 5)"; fi
}
refused() { # SENTENCE COMMAND...: with code 3, one line, and little memory
    sentence=$1
    shift
    "$@" --json >out 2>err
    status=$?
    peak=$(sed -n 's/.*"peak_bytes":\([0-9]*\).*/\1/p' err out | tail -n 1)
    if sanitized; then peak=0; fi
    if [ $status -ne 3 ] || [ "${peak:-0}" -gt 60000000 ] || [ "$(grep -v -c '^{' err)" -ne 1 ]; then
        case_bad "$sentence" "code $status, $peak bytes" "$(head -n 3 err | cut -c 1-200)"
    else
        case_ok "$sentence"
    fi
}

# ---- as typed ---------------------------------------------------------------------

expected=$samples/valid/v_collection.loft
"$ISOLOFT" read -q "$samples/valid/v_collection.geojson" -o file.loft
same "a collection from a file" file.loft "$expected"
"$ISOLOFT" read -q <"$samples/valid/v_collection.geojson" >pipe.loft
same "from a pipe" pipe.loft "$expected"
gzip -c "$samples/valid/v_one_a_line.geojsonl" | "$ISOLOFT" read -q >gzip.loft
same "a sequence that is compressed" gzip.loft "$expected"
"$ISOLOFT" read -q -f geojsonseq "$samples/valid/v_collection.geojson" >seq.loft
same "one that is not one line, said to be a sequence" seq.loft "$expected"
"$ISOLOFT" read -q <"$samples/valid/v_javascript.js" >js.loft
same "JavaScript" js.loft "$expected"
sed -n 1p "$samples/valid/v_one_a_line.geojsonl" >low.geojson
sed -n 2p "$samples/valid/v_one_a_line.geojsonl" >high.geojson
"$ISOLOFT" read -q high.geojson low.geojson >two.loft
same "two files are one map" two.loft "$expected"
exits 0 "what is passed over is told" "$ISOLOFT" read "$samples/valid/v_points_without_heights.geojson"
holds "with its line" grep -q 'v_points_without_heights.geojson:4: point: a point by itself is no isoline (3 times)' err
exits 3 "and fails with --strict" "$ISOLOFT" read --strict "$samples/valid/v_points_without_heights.geojson"
exits 3 "home-made JSON is refused" "$ISOLOFT" "$samples/invalid/x_home_made.geojson"
holds "in one line" one_error

# ---- what GDAL writes ---------------------------------------------------------------

# A hill and a hollow as a grid of metres, where no program takes them for degrees.
awk 'BEGIN {
    print "ncols 60\nnrows 50\nxllcorner 400000\nyllcorner 5100000\ncellsize 10"
    for (r = 0; r < 50; r++) {
        for (c = 0; c < 60; c++)
            printf "%.3f ", 100 + 40 * exp(-((c - 20) ^ 2 + (r - 25) ^ 2) / 90) - 30 * exp(-((c - 45) ^ 2 + (r - 20) ^ 2) / 60) + c / 20
        print ""
    }
}' >hill.asc
if ! command -v gdal_contour >/dev/null || ! command -v ogr2ogr >/dev/null; then
    skip "what GDAL writes is read" "no gdal_contour, ogr2ogr"
else
    gdal_contour -q -a elev -i 5 -f GeoJSON hill.asc lines.geojson 2>err
    gdal_contour -q -3d -i 5 -f GeoJSON hill.asc heights.geojson 2>err
    ogr2ogr -f GeoJSONSeq lines.geojsonl lines.geojson 2>err
    ogr2ogr -f GeoJSONSeq -lco RS=YES lines.rs lines.geojson 2>err
    ogr2ogr -f GeoJSON -lco COORDINATE_PRECISION=7 -lco WRITE_BBOX=YES rounded.geojson lines.geojson 2>err
    ogr2ogr -f GeoJSON -lco COORDINATE_PRECISION=7 -nlt MULTILINESTRING multi.geojson lines.geojson 2>err
    for f in lines.geojson heights.geojson lines.geojsonl lines.rs rounded.geojson multi.geojson; do
        exits 0 "GDAL's $f" "$ISOLOFT" read "$f" -o "$f.loft"
    done
    same "heights in positions are those in properties" lines.geojson.loft heights.geojson.loft
    for f in lines.rs rounded.geojson multi.geojson; do
        same "$f says what lines.geojsonl says" "$f.loft" lines.geojsonl.loft
    done
    printf '%s' '{"geometryType":"esriGeometryPolyline","fields":[{"name":"elev","type":"esriFieldTypeDouble"}],"features":[
{"attributes":{"elev":10},"geometry":{"paths":[[[0,0],[900,0],[900,900],[0,0]]]}},
{"attributes":{"elev":20},"geometry":{"paths":[[[300,100],[800,100],[800,600],[300,100]]]}}]}' >esri.json
    exits 3 "Esri's JSON is refused" "$ISOLOFT" read esri.json
    ogr2ogr -f GeoJSONSeq /vsistdout/ esri.json 2>err | "$ISOLOFT" read -q >esri.loft
    same "and the command that is named makes what is read" esri.loft "$expected"
fi
if ! command -v jq >/dev/null; then
    skip "keys in another order change nothing" "no jq"
else
    jq -S . "$samples/valid/v_polygons.geojson" >sorted.geojson
    "$ISOLOFT" read -q sorted.geojson >sorted.loft
    same "keys in another order change nothing" sorted.loft "$samples/valid/v_polygons.loft"
fi

# ---- what means harm ------------------------------------------------------------------

repeated() { awk -v n="$1" -v s="$2" 'BEGIN { for (k = 0; k < n; k++) printf "%s", s }'; } # TIMES TEXT
two='{"type":"MultiLineString","coordinates":[[[0,0,10],[900,0,10],[0,900,10]],[[0,0,20],[800,0,20],[0,800,20]]]}'
repeated 1000000 1234567890 >digits

{ printf '{"type":"LineString","coordinates":'; repeated 1000000 '['; } >bad.json
refused "a million arrays in one another" "$ISOLOFT" read bad.json
repeated 1000000 '{"a":' >bad.json
refused "a million objects" "$ISOLOFT" read bad.json
repeated 100000 '{"type":"GeometryCollection","geometries":[' >bad.json
refused "collections without end" "$ISOLOFT" read bad.json
refused "which a larger depth does not change" "$ISOLOFT" read bad.json --max-depth 1000000000
{ printf '{"type":"'; cat digits; printf '"}'; } >bad.json
refused "a type of ten million bytes" "$ISOLOFT" read bad.json
{ printf '{"type":"LineString","coordinates":[['; cat digits; printf '0,1],[2,3]]}'; } >bad.json
refused "a coordinate of ten million digits" "$ISOLOFT" read bad.json
{ printf '{"'; cat digits; printf '":1}'; } >bad.json
refused "a member with a name of ten million bytes" "$ISOLOFT" read -f geojson bad.json
{ printf '{"type":"FeatureCollection","features":['; head -c 1000000 /dev/zero; } >bad.json
refused "zero bytes" "$ISOLOFT" read bad.json
{ printf '{'; awk 'BEGIN { for (k = 0; k < 300000; k++) printf "%s\"m%d\":[]", k ? "," : "", k }'; printf '}'; } >bad.json
refused "a home-made object of many members" "$ISOLOFT" read bad.json
{ printf '{"type":"FeatureCollection","features":[%s' "$two"; repeated 300000 ',{"type":"Feature","geometry":null}'; printf ']}'; } >odd.json
exits 0 "300000 features without geometry" "$ISOLOFT" read odd.json
holds "are counted" grep -q '(300000 times)' err
{ printf '{"type":"Feature","geometry":%s,"properties":{' "$two"
  awk 'BEGIN { for (k = 0; k < 300000; k++) printf "%s\"p%d\":%d", k ? "," : "", k, k }'; printf '}}'; } >odd.json
exits 0 "300000 properties" "$ISOLOFT" read odd.json
{ printf '{"type":"Feature","geometry":%s,"properties":{"elev":"' "$two"; cat digits; printf '","'; cat digits; printf '":null}}'; } >odd.json
exits 0 "strings of ten million bytes" "$ISOLOFT" read odd.json
exits 3 "unless tokens are limited" "$ISOLOFT" read odd.json --max-line 1000000
exits 3 "points can be limited" "$ISOLOFT" read "$samples/valid/v_collection.geojson" --max-points 6
exits 0 "to what is there" "$ISOLOFT" read "$samples/valid/v_collection.geojson" --max-points 7

plan
