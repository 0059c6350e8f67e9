# fuzz.sh - the fuzz harnesses over their formats' samples and over what fuzzing
# has found, without a fuzzer; one case a harness.

harnesses="
bln
csv
dcmdump
dicom-json
dicom-xml
dxf
geojson
gmt
gpx
json
keyhole
kml
lines
links
loft
mesh
relief
shp
svg
"

set -- $harnesses
echo "1..$#"
i=0
for format in $harnesses; do
    i=$((i + 1))
    seeds=$srcdir/formats/$format
    [ $format != json ] || seeds=$srcdir/formats/dicom-json
    [ -d "$seeds" ] || seeds= # rings are in no format
    found=$srcdir/tests/fuzz/found/$format
    [ -d "$found" ] || found=
    if ./tests/fuzz/fuzz-$format -runs=0 ${seeds:+"$seeds"} ${found:+"$found"} >"$TMPDIR/out" 2>"$TMPDIR/err"; then
        echo "ok $i - fuzz-$format stands what it has met"
    else
        echo "not ok $i - fuzz-$format stands what it has met"
        tail -n 20 "$TMPDIR/err" | sed 's/^/# /'
    fi
done
