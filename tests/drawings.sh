# drawings.sh - DXF drawings and shapefiles as typed: layers, pipes, companions, the
# files of other programs.
. "$srcdir/tests/tap.sh"

dxf=$srcdir/formats/dxf/valid
shp=$srcdir/formats/shp/valid

same() { # SENTENCE FILE FILE
    if cmp "$2" "$3" >out 2>&1; then case_ok "$1"; else case_bad "$1" "$(cat out)" "$(diff "$2" "$3" | head -n 5)"; fi
}

# ---- drawings ----------------------------------------------------------------------

"$ISOLOFT" read -q <"$dxf/v_lwpolyline.dxf" >pipe.loft
same "a drawing from a pipe" pipe.loft "$dxf/v_lwpolyline.loft"
exits 0 "layers are chosen" "$ISOLOFT" read --layer 'CONT*' "$dxf/v_layer.dxf" -o layer.loft
same "and the others left out" layer.loft "$dxf/v_layer.loft"
holds "which is told" grep -q '1 entities on layers that --layer does not choose are left out' err
exits 0 "all layers are read without a choice" "$ISOLOFT" read "$dxf/v_layer.dxf"
holds "the one that is no isoline too" grep -q '^slice 105$' out
exits 3 "a layer that is not there is refused" "$ISOLOFT" read --layer CONTOUR "$dxf/v_layer.dxf"
holds "naming those that are" grep -q "there are 'CONT_MAJOR', 'FRAME', 'CONT_MINOR'" err
exits 0 "a finer flatness gives more points" "$ISOLOFT" read --flatness 0.1 "$dxf/v_circle.dxf" -o fine.loft
exits 0 "than a coarse one" "$ISOLOFT" read --flatness 20 "$dxf/v_circle.dxf" -o coarse.loft
holds "on arcs" test "$(wc -l <fine.loft)" -gt "$(wc -l <coarse.loft)"
holds "and says how many" grep -q 'points were put on arcs and curves' err
exits 3 "what is left out fails with --strict" "$ISOLOFT" read --strict "$dxf/v_other_entities.dxf"
exits 0 "what is not chosen does not" "$ISOLOFT" read --strict --layer 'CONT*' "$dxf/v_layer.dxf"
exits 3 "a drawing of another kind is refused" "$ISOLOFT" "$srcdir/formats/dxf/invalid/x_dwg.dxf"
holds "in one line" one_error

# ---- shapefiles -----------------------------------------------------------------------

cp "$shp"/v_polyline.* "$shp"/v_polyline_z.shp . || exit 1
"$ISOLOFT" read -q v_polyline.shp >alone.loft
same "a shapefile finds its table" alone.loft "$shp/v_polyline.loft"
mkdir folder && mv v_polyline.* folder
"$ISOLOFT" read -q folder/v_polyline.shp >folder.loft
same "in its own folder" folder.loft "$shp/v_polyline.loft"
exits 0 "from a pipe it has z coordinates alone" "$ISOLOFT" read - <v_polyline_z.shp
holds "which is told" grep -q 'standard input brings a .shp without its .dbf' err
exits 3 "without them it is refused" "$ISOLOFT" read - <folder/v_polyline.shp
holds "saying what to give" grep -q 'give the path of the .shp' err
for part in dbf shx; do
    exits 3 "its .$part is not what to give" "$ISOLOFT" read folder/v_polyline.$part
    holds "its .$part: which is said" grep -q 'give its .shp alone' err
    holds "its .$part: in one line" one_error
done
exits 3 "nor are all of them at once" "$ISOLOFT" read folder/v_polyline.*
cp folder/v_polyline.shp two.shp && cp folder/v_polyline.dbf two.dbf
exits 0 "two shapefiles are one map" "$ISOLOFT" read folder/v_polyline.shp two.shp
holds "with the lines of both" test "$(grep -c '^ring' out)" -ge 2

# ---- what GDAL writes ---------------------------------------------------------------------

cat >lines.geojson <<'END'
{"type":"FeatureCollection","features":[
{"type":"Feature","properties":{"elev":10,"name":"a"},"geometry":{"type":"LineString","coordinates":[[0,0],[900,0],[900,900],[0,0]]}},
{"type":"Feature","properties":{"elev":20,"name":"\u00fc"},"geometry":{"type":"LineString","coordinates":[[300,100],[800,100],[800,600]]}}]}
END
if ! command -v ogr2ogr >/dev/null; then
    skip "what GDAL writes is read" "no ogr2ogr"
else
    "$ISOLOFT" read -q --project none lines.geojson | grep -v '^crs' >expected.loft
    reads() { # SENTENCE FILE OPTION...
        sentence=$1 file=$2
        shift 2
        rm -rf made && mkdir made && ogr2ogr "$@" "made/$file" lines.geojson 2>err
        "$ISOLOFT" read -q --project none "made/$file" >whole 2>err
        grep -v '^crs' whole >got.loft
        same "$sentence" got.loft expected.loft
    }
    reads "a shapefile with z and m" a.shp -f 'ESRI Shapefile' -zfield elev -dim XYZM -select name
    reads "in a code page" a.shp -f 'ESRI Shapefile' -lco ENCODING=CP1252
    reads "in UTF-8" a.shp -f 'ESRI Shapefile' -lco ENCODING=UTF-8
    reads "a drawing" a.dxf -f DXF -zfield elev -select name
    exits 0 "whose unit is not believed" "$ISOLOFT" read made/a.dxf
    holds "which is told" grep -q 'INSUNITS says inches' err
fi

plan
