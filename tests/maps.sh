# maps.sh - the same isolines in every format that maps come in: one native stream.
. "$srcdir/tests/tap.sh"
. "$srcdir/tests/maps-forms.sh"

# ---- by hand, in every text format -----------------------------------------------

# What the isolines are in native text, projected or as they are: they are compared
# without the name of a coordinate system, which not every format says.
native() { "$ISOLOFT" read -q "$@" 2>err | sed '/^crs /d'; }

# The level and the ends of every edge, in whatever order and direction lines run.
edges() {
    awk '$1 == "line" || $1 == "ring" || $1 == "end" || $1 == "slice" {
            if (is_ring) edge(last, first)
            is_ring = $1 == "ring"
            last = ""
        }
        $1 == "slice" { z = $2 }
        NF == 2 && $1 + 0 == $1 {
            if (last != "") edge(last, $0)
            else first = $0
            last = $0
        }
        function edge(a, b) { print z ": " (a < b ? a "  " b : b "  " a) }' | sort
}

same() { # SENTENCE EXPECTED: what ./got has to be
    if cmp -s got "$2"; then
        case_ok "$1"
    else
        case_bad "$1" "$(diff got "$2" | head -n 6)" "$(head -n 3 err)"
    fi
}

relief metres >metres.lines
relief degrees >degrees.lines
for unit in metres degrees; do
    map_as loft $unit <$unit.lines >$unit.loft
    native $unit.loft >$unit.native
    edges <$unit.loft >want
    edges <$unit.native >got
    holds "$unit: the lines in native text have all edges" test "$(wc -l <want)" -gt 200
    same "$unit: and are read as they are" want
    split -l 4 $unit.lines $unit.part.
done
map_as geojson degrees <degrees.lines >degrees.json
native degrees.json >projected.native

check_form() { # FORM READER UNIT EXPECTED OPTIONS...
    form=$1 reader=$2 unit=$3 expected=$4
    shift 4
    map_as "$form" "$unit" <"$unit.lines" >"$form.map"
    native "$form.map" "$@" >got
    same "$form in $unit, $*: the same stream" "$expected"
    native -f "$reader" - "$@" <"$form.map" >got
    same "... from standard input, its format named" "$expected"
    gzip -c "$form.map" >"$form.map.gz"
    native "$form.map.gz" "$@" >got
    same "... compressed" "$expected"
    native "$@" <"$form.map.gz" >got
    same "... compressed, from standard input" "$expected"
    rm -f part.*
    for part in "$unit".part.*; do map_as "$form" "$unit" <"$part" >"part.${part##*.}"; done
    native part.* "$@" >got
    same "... cut into $(ls part.* | wc -l) files" "$expected"
    rm -f "$form".map* part.*
}

echo "$map_forms" >forms
while read -r form reader units; do
    [ -n "$form" ] && is_read "$reader" || continue
    for unit in $units; do
        if [ "$unit" = metres ]; then
            check_form "$form" "$reader" metres metres.native
        else
            check_form "$form" "$reader" degrees degrees.native --project none
            check_form "$form" "$reader" degrees projected.native
        fi
    done
done <forms

# ---- with spot heights ----------------------------------------------------------------

spot_forms="geojson geojson-z geojsonseq csv-wkt dxf dxf-polyline kml kml-z gpx gpx-z"
for unit in metres degrees; do
    { relief $unit; summits $unit; } >summits.lines
    map_as loft $unit <summits.lines >summits.loft
    native summits.loft >summits.native
    holds "$unit: spot heights are in native text" test "$(grep -c '^spot ' summits.native)" -eq 4
    native summits.native >got
    same "$unit: and are read as they are" summits.native
    native summits.native --to cm | sed 's/^unit.*//' >got
    holds "$unit: and are converted" test "$unit" = degrees -o "$(grep -c '^spot .*00 15450$' got)" -eq 1
    sed '/^spot /d' summits.native >got
    same "$unit: lines are what they are without them" $unit.native
    for form in $spot_forms; do
        echo "$map_forms" | grep -q "^$form .* $unit" || continue
        map_as $form $unit <summits.lines >"$form.map"
        native "$form.map" --project none >got
        same "$form in $unit, with spot heights: the same stream" summits.native
        summits $unit | map_as $form $unit >points.map
        map_as $form $unit <$unit.lines >"$form.map"
        native points.map "$form.map" --project none >got
        same "... in a file of their own" summits.native
        exits 3 "... and those alone are refused" "$ISOLOFT" read points.map
    done
done
{ relief degrees; summits degrees; } | map_as geojson degrees >summits.json
{ summits degrees; relief degrees; } | map_as kml-z degrees >summits.kml
native summits.kml >want
native summits.json >got
same "projected, with spot heights: the same stream" want
native want >got
same "and it is read as it is" want
"$ISOLOFT" info --json summits.json >info.json 2>err
holds "info --json counts them" grep -q '"spots":4,' info.json
"$ISOLOFT" info summits.json >info.txt 2>err
holds "and so does info" grep -q '^  spot heights 4$' info.txt

# ---- by GDAL, in every format that it writes ----------------------------------------

# Elevations over a square: two waves on a slope.
elevations() { # UNIT
    awk -v unit="$1" 'BEGIN {
        print "ncols 60\nnrows 50\n" (unit == "degrees" ? "xllcorner 7.1\nyllcorner 50.2\ncellsize 0.0003" : \
            "xllcorner 431000\nyllcorner 5561000\ncellsize 25")
        for (j = 0; j < 50; j++)
            for (i = 0; i < 60; i++)
                printf "%.2f%s", 100 + 30 * sin(i / 10) * cos(j / 10) + 0.8 * i, i < 59 ? " " : "\n"
    }'
}

# Coordinates are rounded once, in FORM.json, to what every driver keeps.  Drivers that
# know no attributes complain of them.
contours() { # UNIT FORM OPTIONS...
    if [ "$1" = degrees ]; then srs=EPSG:4326 digits=7; else srs=None digits=3; fi
    unit=$1 form=$2
    shift 2
    elevations "$unit" >"$unit.asc"
    gdal_contour -q "$@" -i 10 -f GeoJSON -lco COORDINATE_PRECISION=$digits "$unit.asc" "$form.json" 2>ogr.err
    native "$form.json" >"$form.native"
}
by_gdal() { # SENTENCE READER FILE OPTIONS...: FORM.json as the driver of OPTIONS writes it
    sentence=$1 reader=$2 file=$3
    shift 3
    is_read "$reader" || return
    rm -rf made
    mkdir made
    if ! ogr2ogr -a_srs $srs "$@" "made/$file" "$form.json" 2>ogr.err && [ ! -s "made/$file" ]; then
        skip "$form, $sentence" "this GDAL does not write it"
        return
    fi
    native "made/$file" | $as >got
    $as <"$form.native" >want
    same "$form, $sentence: the same stream" want
}
all_by_gdal() {
    by_gdal "GeoJSON" geojson a.json -f GeoJSON
    by_gdal "GeoJSON of RFC 7946" geojson a.json -f GeoJSON -lco RFC7946=$([ $unit = degrees ] && echo YES || echo NO)
    by_gdal "a sequence" geojsonseq a.geojsons -f GeoJSONSeq
    by_gdal "a sequence with separators" geojsonseq a.geojsons -f GeoJSONSeq -lco RS=YES
    by_gdal "GMT" gmt a.gmt -f OGR_GMT
    by_gdal "CSV" csv a.csv -f CSV -lco GEOMETRY=AS_WKT
    by_gdal "CSV with semicolons" csv a.csv -f CSV -lco GEOMETRY=AS_WKT -lco SEPARATOR=SEMICOLON
    by_gdal "a shapefile" shp a.shp -f "ESRI Shapefile"
    [ $unit = degrees ] || return
    by_gdal "KML" kml a.kml -f KML
    by_gdal "KML by LIBKML" kml a.kml -f LIBKML
}
lines_by_gdal() {
    all_by_gdal
    by_gdal "lines with z in a shapefile" shp a.shp -f "ESRI Shapefile" -zfield elev -nlt LINESTRING25D -select ID
    if is_read shp; then
        native -f shp - <made/a.shp >got
        same "... from standard input, without what belongs to it" want
        gzip made/a.shp
        native made/a.shp.gz >got
        same "... compressed" want
    fi
    by_gdal "GeoJSON with z" geojson a.json -f GeoJSON -zfield elev -select ID
    by_gdal "GMT with z" gmt a.gmt -f OGR_GMT -zfield elev -select ID
    by_gdal "CSV with z" csv a.csv -f CSV -lco GEOMETRY=AS_WKT -zfield elev -select ID
    by_gdal "DXF" dxf a.dxf -f DXF -zfield elev
    [ $unit = degrees ] || return
    by_gdal "KML with z" kml a.kml -f KML -zfield elev -select ID
    by_gdal "KML by LIBKML with z" kml a.kml -f LIBKML -zfield elev -select ID
    by_gdal "tracks of GPX" gpx a.gpx -f GPX -lco FORCE_GPX_TRACK=YES -dsco GPX_USE_EXTENSIONS=YES
    by_gdal "routes of GPX" gpx a.gpx -f GPX -lco FORCE_GPX_ROUTE=YES -zfield elev
}
if command -v gdal_contour >/dev/null && command -v ogr2ogr >/dev/null; then
    for unit in metres degrees; do
        contours $unit "lines" -a elev
        as="cat"
        holds "gdal_contour's lines in $unit are read" test "$(grep -c '^slice' lines.native)" -ge 8
        lines_by_gdal
        contours $unit "bands" -p -amin elev_min -amax elev_max
        as="edges" # formats have their own rules which way round polygons run
        holds "gdal_contour's polygons in $unit are read" test "$(grep -c '^slice' bands.native)" -ge 8
        all_by_gdal
    done
    summits metres | map_as geojson metres >points.json
    relief metres | map_as geojson metres >relief.json
    native points.json relief.json >want
    while read -r extension driver; do
        for part in points relief; do
            rm -f made.$part.*
            ogr2ogr -a_srs None -f "$driver" made.$part.$extension $part.json 2>ogr.err
        done
        native made.points.$extension made.relief.$extension >got
        same "spot heights by $driver, in a file of their own: the same stream" want
    done <<'END'
geojsonl GeoJSONSeq
gmt OGR_GMT
shp ESRI Shapefile
END
    ogr2ogr -a_srs None -f GPKG made.gpkg lines.json 2>ogr.err
    ogr2ogr -f GeoJSONSeq /vsistdout/ made.gpkg 2>ogr.err | native - >got
    native lines.json >want
    same "what isoloft does not read itself comes through ogr2ogr's pipe" want
else
    skip "GDAL's isolines are the same stream in every format" "GDAL is not installed"
fi

# ---- the acceptance of published isolines -----------------------------------------------

accept() { sh "$srcdir/tests/check-isolines" >accepted 2>&1; }
mkdir published
for form in geojson kml-z gpx-z; do map_as $form degrees <degrees.lines >published/$form; done
gzip -c published/kml-z >published/packed.kml.gz
grep '^110 ' degrees.lines | map_as geojson degrees >published/one-level
ISOLINES=published
export ISOLINES
holds "good maps pass make check-isolines" accept
holds "and one that is refused with a reason is counted" sh -c 'tail -n 1 accepted | grep -x "4 passed, 0 failed, 1 skipped"'
holds "and shown with it" grep -q '^one-level .*refused: has one level only' accepted
ISOLINES=
holds "without a folder it is skipped" accept
holds "which counts" sh -c 'tail -n 1 accepted | grep -x "0 passed, 0 failed, 1 skipped"'

plan
