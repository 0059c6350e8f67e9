# tables.sh - GMT, CSV and BLN as typed: pipes, several files, what other programs write,
# and what means harm.
. "$srcdir/tests/tap.sh"

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
    if [ $status -ne 3 ] || [ "${peak:-0}" -gt 200000000 ] || [ "$(grep -v -c '^{' err)" -ne 1 ]; then
        case_bad "$sentence" "code $status, $peak bytes" "$(head -n 3 err | cut -c 1-200)"
    else
        case_ok "$sentence"
    fi
}

# ---- as typed ---------------------------------------------------------------------

for form in gmt/valid/v_option_z.gmt csv/valid/v_wkt.csv bln/valid/v_names.bln; do
    sample=$srcdir/formats/$form
    name=${form##*/}
    "$ISOLOFT" read -q <"$sample" >pipe.loft
    same "$name from a pipe" pipe.loft "${sample%.*}.loft"
    gzip -c "$sample" | "$ISOLOFT" read -q >gzip.loft
    same "$name compressed" gzip.loft "${sample%.*}.loft"
done
sed -n 1,5p "$srcdir/formats/gmt/valid/v_option_z.gmt" >low.gmt
sed '1,5d' "$srcdir/formats/gmt/valid/v_option_z.gmt" >high.gmt
"$ISOLOFT" read -q low.gmt high.gmt >two.loft
same "two files are one map" two.loft "$srcdir/formats/gmt/valid/v_option_z.loft"
exits 0 "what is left out is told" "$ISOLOFT" read "$srcdir/formats/csv/valid/v_no_data.csv"
holds "with its line" grep -q 'v_no_data.csv:3: row: x or y is no number' err
exits 3 "and fails with --strict" "$ISOLOFT" read --strict "$srcdir/formats/csv/valid/v_no_data.csv"
exits 3 "a table without heights is refused" "$ISOLOFT" read -f gmt "$srcdir/formats/csv/valid/v_wkt.csv"
holds "in one line" one_error
printf 'x,y,elev,alt\n0,0,1,30\n9000,0,1,30\n0,0,2,40\n9000,0,2,40\n' >choice.csv
exits 0 "--height chooses the column" "$ISOLOFT" read --height alt choice.csv
holds "and no other" grep -q '^slice 40$' out
exits 3 "a column that is not there is refused" "$ISOLOFT" read --height top choice.csv
holds "and those that are there are named" grep -q 'elev, alt' err
printf 'lat;lon;elev\n45,5;3,01;100\n45,6;3,01;100\n45,5;3,02;200\n45,6;3,02;200\n' >degrees.csv
exits 0 "columns called lat and lon are degrees" "$ISOLOFT" read degrees.csv
holds "and projected" grep -q 'EPSG:32631' out
exits 0 "unless that is not wanted" "$ISOLOFT" read --project none degrees.csv
holds "and then x is the longitude" grep -q '^3.02 45.5$' out

# ---- what GDAL writes ---------------------------------------------------------------

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
    ogr2ogr -f GeoJSON -lco COORDINATE_PRECISION=6 lines.json lines.geojson 2>err
    "$ISOLOFT" read -q lines.json >expected.loft
    table() { # NAME OPTION...: as a table, under a name that ogr2ogr makes a file of
        name=$1
        shift
        ogr2ogr -f CSV "$@" made.csv lines.json 2>err && mv made.csv "$name"
    }
    table comma.csv -lco GEOMETRY=AS_WKT
    table semicolon.csv -lco GEOMETRY=AS_WKT -lco SEPARATOR=SEMICOLON
    table tab.tsv -lco GEOMETRY=AS_WKT -lco SEPARATOR=TAB -lco LINEFORMAT=CRLF
    table multi.csv -lco GEOMETRY=AS_WKT -nlt MULTILINESTRING -lco WRITE_BOM=YES -lco STRING_QUOTING=IF_NEEDED
    ogr2ogr -f OGR_GMT -a_srs EPSG:32631 lines.gmt lines.json 2>err
    ogr2ogr -f OGR_GMT -a_srs EPSG:32631 -nlt MULTILINESTRING multi.gmt lines.json 2>err
    for f in comma.csv semicolon.csv tab.tsv multi.csv lines.gmt multi.gmt; do
        "$ISOLOFT" read -q "$f" 2>err | grep -v '^crs ' >got.loft
        same "GDAL's $f" got.loft expected.loft
    done
    # Points with the number of their line, as GDAL and others make them of lines.
    awk 'BEGIN { print "X,Y,line_id,elev" }
        /^slice/ { z = $2 }
        /^(line|ring)/ { id++; closed = /^ring/; first = "" }
        /^[-0-9]/ { if (first == "") first = $1 "," $2
                    last[id] = closed ? first "," id "," z : ""
                    row[++n] = $1 "," $2 "," id "," z; of[n] = id }
        END { for (k = 1; k <= n; k++) { print row[k]; if (of[k] != of[k + 1] && last[of[k]] != "") print last[of[k]] } }' \
        expected.loft >points.csv
    "$ISOLOFT" read -q points.csv >got.loft
    same "a point a row, with numbers of lines" got.loft expected.loft
    cut -d, -f1,2,4 points.csv | tr , ' ' | sed 1d >points.xyz
    "$ISOLOFT" read -q points.xyz >got.loft
    same "and without any numbers or names" got.loft expected.loft
    gdal_translate -q -of XYZ hill.asc grid.xyz 2>err
    exits 3 "a grid is refused" "$ISOLOFT" read grid.xyz
    holds "as such" grep -q 'as in scattered points or a grid' err
fi

# ---- what means harm ------------------------------------------------------------------

repeated() { awk -v n="$1" -v s="$2" 'BEGIN { for (k = 0; k < n; k++) printf "%s", s }'; } # TIMES TEXT
wkt() { awk -v z="$1" 'BEGIN { printf "\"LINESTRING (0 0,9000 0,9000 %d,0 0)\",%d", 9000 - z, z }'; } # HEIGHT
repeated 1000000 1234567890 >digits

{ printf 'WKT,elev'; repeated 1000000 ,c; printf '\n'; wkt 10; repeated 1000000 ,1; printf '\n'; wkt 20; printf '\n'; } >odd.csv
exits 0 "a million columns" "$ISOLOFT" read odd.csv
{ printf 'x,y'; repeated 1000000 ,z; printf '\n0,0'; repeated 1000000 ,1; printf '\n'; } >odd.csv
refused "a million columns of heights" "$ISOLOFT" read odd.csv
{ printf 'note,WKT,elev\n"'; cat digits; printf '\n""",'; wkt 10; printf '\n,'; wkt 20; printf '\n'; } >odd.csv
exits 0 "a cell of ten million bytes" "$ISOLOFT" read odd.csv
exits 3 "unless lines are limited" "$ISOLOFT" read --max-line 1000000 odd.csv
{ printf 'WKT,elev\n"'; repeated 2000000 '1,2
'; } >bad.csv
refused "quotes that do not end" "$ISOLOFT" read bad.csv
{ printf 'WKT;elev\nLINESTRING '; repeated 5000000 '('; } >bad.csv
refused "brackets that do not end" "$ISOLOFT" read bad.csv
{ printf 'WKT\n"'; repeated 100000 'GEOMETRYCOLLECTION('; repeated 100000 ')'; printf '"\n'; } >bad.csv
refused "collections without end" "$ISOLOFT" read bad.csv
refused "which a larger depth does not change" "$ISOLOFT" read bad.csv --max-depth 1000000000
{ printf 'x,y,z\n'; awk 'BEGIN { for (k = 0; k < 300000; k++) print k ",5," k % 7 }'; } >bad.csv
refused "300000 scattered points" "$ISOLOFT" read bad.csv
{ printf 'x,y,z\n0,0,5\n9000,0,5\n'; repeated 300000 'no,0,5
'; printf '0,0,6\n9000,0,6\n'; } >odd.csv
exits 0 "300000 rows without numbers" "$ISOLOFT" read odd.csv
holds "are counted" grep -q '(300000 times)' err
{ printf 'x,y,z\n0,0,5\n'; cat digits; printf ',0,5\n9000,0,5\n0,0,6\n9000,0,6\n'; } >odd.csv
exits 0 "a number of ten million digits is none" "$ISOLOFT" read odd.csv
{ printf '# @VGMT1.0 @GLINESTRING\n# @Nelev'; repeated 1000000 '|elev'; printf '\n>\n# @D1'; repeated 1000000 '|1'; printf '\n1 1\n'; } >bad.gmt
refused "a million attributes in GMT" "$ISOLOFT" read bad.gmt
repeated 1000000 '>
' >bad.gmt
refused "a million segments of nothing" "$ISOLOFT" read -f gmt bad.gmt
{ printf '>'; repeated 1000000 ' -Z1'; printf '\n1 1\n2 2\n'; } >bad.gmt
refused "a million options" "$ISOLOFT" read -f gmt bad.gmt
printf '4000000000,1\n0,0\n1,1\n' >bad.bln
refused "a block that says four thousand million points" "$ISOLOFT" read -f bln bad.bln
{ printf '2,1,5\n0,0\n1,1\n'; head -c 1000000 /dev/zero; } >bad.bln
refused "zero bytes in BLN" "$ISOLOFT" read -f bln bad.bln
{ printf '> -Z1\n0 0\n1 1\n'; head -c 1000000 /dev/zero; } >bad.gmt
refused "zero bytes in GMT" "$ISOLOFT" read -f gmt bad.gmt
printf 'x,y,\033]0;owned\007,z\n0,0,1,1\n1,1,1,2\n' >bad.csv
refused "names with control characters" "$ISOLOFT" read -f csv --height nothing bad.csv
holds "do not reach the terminal" sh -c '! grep -q "$(printf "\033")" err'

plan
