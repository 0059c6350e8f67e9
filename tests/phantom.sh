# phantom.sh - the example structure set: its forms agree, and its regions are what they are drawn as.
. "$srcdir/tests/tap.sh"

phantom=$srcdir/examples/phantom
forms="dcmdump.txt json xml"

for form in $forms; do
    awk -v form="${form%.txt}" -f "$phantom.awk" >made
    holds "phantom.$form is what phantom.awk makes" cmp made "$phantom.$form"
    holds "and small" test "$(wc -c <made)" -lt 150000
    for format in ply stl; do "$ISOLOFT" -q "$phantom.$form" -o "$form.$format/" -t $format; done
    mkdir $form.obj
    "$ISOLOFT" -q "$phantom.$form" -o $form.obj/all.obj
    "$ISOLOFT" read -q "$phantom.$form" >"$form.loft"
    "$ISOLOFT" --list "$phantom.$form" >"$form.list"
done
for form in json xml; do
    for format in ply stl; do
        holds "$form gives the dump's bytes, a file a region, as $format" diff -r dcmdump.txt.$format $form.$format
    done
    holds "and in one file, as OBJ" diff -r dcmdump.txt.obj $form.obj
    holds "and as contours" cmp dcmdump.txt.loft $form.loft
    holds "and the same list" cmp dcmdump.txt.list $form.list
done

for roi in 0001-Vessel 0002-Hollow 0003-Tube 0004-Cord; do
    exits 0 "$roi is sound" "$ISOLOFT" check -q "dcmdump.txt.ply/$roi.ply"
    exits 0 "as STL too" "$ISOLOFT" check -q "dcmdump.txt.stl/$roi.stl"
done
holds "the empty region gets no file" sh -c '! ls dcmdump.txt.ply | grep -q 0005'
holds "but a place in the index" grep -q '"file":null,"number":5,"name":"Empty","colour":\[128,128,128\],"status":"empty"' dcmdump.txt.ply/index.json

told() { # ROI WORDS: info says so
    "$ISOLOFT" info --roi "$1" "$phantom.json" >info
    holds "$1: $2" grep -q "^  $2" info
}
told Vessel "components  1, genus 0"
told Hollow "components  2, genus 0"
told Tube "components  1, genus 1"
told Tube "repairs     7 x keyhole opened\$"
told Cord "components  2, genus 0"
told Cord "gap  *z from -11 to 4 mm"
told Cord "type        AVOIDANCE"

# Cut at its contours' planes each mesh gives them back, and its volume is theirs.
holds "the whole of it passes make check-rt" sh -c 'cd "$builddir" && RT="$srcdir/examples" NAMES=phantom sh "$srcdir/tests/check-rt"'

if command -v dump2dcm >/dev/null && command -v dcmdump >/dev/null; then
    dump2dcm -q "$phantom.dcmdump.txt" phantom.dcm
    dcmdump -q +L phantom.dcm | "$ISOLOFT" read -q >real.loft
    holds "what dcmdump writes of it as a file gives the same contours" cmp real.loft json.loft
else
    skip "what dcmdump writes of it as a file gives the same contours" "dcmtk is not installed"
fi

plan
