# rt-hostile.sh - structure sets that are damaged or mean harm: a clear line, never a wrong mesh.
. "$srcdir/tests/tap.sh"
. "$srcdir/tests/rt-forms.sh"

# ---- every invalid sample, as a user meets it -------------------------------------

for format in dcmdump dicom-json dicom-xml; do
    for file in "$srcdir/formats/$format/invalid"/x_*; do
        case $file in *.error) continue ;; esac
        cp "$file" .
        name=${file##*/}
        "$ISOLOFT" -f $format "$name" -o mesh.ply >out 2>err
        status=$?
        [ $status -eq 3 ] && one_error && grep -q "^isoloft: $name:[0-9]" err && [ ! -s out ] && [ ! -e mesh.ply ] ||
            echo "$name: exit $status: $(head -n 2 err)"
        rm -f "$name" mesh.ply
    done >wrong
    holds "invalid samples as $format: exit 3, one line with file and line, no mesh" sh -c 'cat wrong; [ ! -s wrong ]'
done

# ---- values that are none ----------------------------------------------------------

# Two good ROIs, and between them one with the contour given.
between() {
    echo 'roi 1 first'
    printf 'contour 0\\0\\%d\\9\\0\\%d\\0\\9\\%d\n' 0 0 0 3 3 3
    echo 'roi 2 middle'
    printf 'contour 0\\0\\0\\9\\0\\0\\0\\9\\0\ncontour %s\n' "$1"
    echo 'roi 3 last'
    printf 'contour 0\\0\\%d\\9\\0\\%d\\0\\9\\%d\n' 0 0 0 3 3 3
}

for form in $forms; do
    for value in nan NaN inf -Infinity 1e999 -1e999 1e15 0x10 1,5 '' ; do
        between "0\\0\\3\\9\\$value\\3\\0\\9\\3" | set_as $form >one.set
        "$ISOLOFT" one.set -o parts/ >out 2>err
        status=$?
        [ $status -eq 3 ] && [ "$(ls parts | tr '\n' ' ')" = "0001-first.stl 0003-last.stl index.json " ] &&
            grep -q "^isoloft: one.set:[0-9]*: stack 'middle': value 5 " err || echo "'$value': exit $status: $(head -n 2 err)"
        rm -rf parts
    done >wrong
    holds "$form: what is no finite number costs its ROI, with line and value" sh -c 'cat wrong; [ ! -s wrong ]'

    between '0\0\3\9\0\3' | set_as $form >one.set
    exits 0 "$form: a ring of two points is left out" "$ISOLOFT" --list --json one.set
    holds "and counted" grep -q '"skipped_total":1' out
    between '0\0\3\9\0\3\0\9\3\1' | set_as $form >one.set
    exits 3 "$form: coordinates that are not three by three" "$ISOLOFT" one.set -o parts/
    holds "cost their ROI" sh -c '[ "$(ls parts | wc -l)" -eq 3 ] && grep -q "^isoloft: one.set:[0-9]*: .*no multiple of 3" err'
    rm -rf parts
done

# Contours whose ROI nobody named have a mesh all the same, which tells so.
small_set | set_as dcmdump | sed 's/(3006,0022) IS \[3\]/(3006,0022) IS [7]/' >one.set
exits 0 "contours of an ROI that is not listed" "$ISOLOFT" one.set -o unknown/ -t ply
holds "have a file" sh -c 'ls unknown | grep -q "^0003"'
small_set | set_as json | sed 's/"300600[45]0":{"vr":"DS","Value":[^}]*}/"30060050":{"vr":"DS","BulkDataURI":"file:x"}/' >one.set
exits 3 "contours that are elsewhere, by BulkDataURI" "$ISOLOFT" one.set -o bulk/
holds "are told so, with the line" grep -q "^isoloft: one.set:1: .*BulkDataURI" err
holds "and nothing is written of them" sh -c '! ls bulk 2>/dev/null | grep -q stl'

# ---- files that were cut -----------------------------------------------------------

# What stands behind the contours says the types only, which a file may lack: cut
# just there nothing is missing, and then all meshes have to be there.

for form in $forms; do
    small_set | set_as $form >one.set
    "$ISOLOFT" -q one.set -o whole/ -t ply
    size=$(wc -c <one.set) k=1
    while [ $k -lt 40 ]; do
        head -c $((size * k / 40)) one.set >one.cut
        "$ISOLOFT" -q -f "$(echo $form | sed 's/^[jx]/dicom-&/')" one.cut -o cut.d/ -t ply >out 2>err
        status=$?
        [ $status -eq 0 ] && [ "$(ls cut.d | wc -l)" -eq 4 ] ||
            { [ $status -eq 3 ] && grep -q '^isoloft: one.cut:[0-9]*: ' err; } || echo "at $k: exit $status: $(head -n 2 err)"
        for file in cut.d/*.ply; do
            [ ! -e "$file" ] || cmp "$file" "whole/${file##*/}"
        done
        rm -rf cut.d
        k=$((k + 1))
    done >wrong 2>&1
    holds "$form: cut anywhere it is refused, and no mesh is another" sh -c 'cat wrong; [ ! -s wrong ]'
    rm -rf whole
done

# ---- a value of forty megabytes ----------------------------------------------------

# FORM: of one place again and again, which is no ring.
forty_megabytes() {
    printf 'roi 1 long\ncontour @\n' | set_as "$1" | awk -v form="$1" '
        { at = index($0, "@") }
        !at { print; next }
        {
            sub(/# 2, 1 Name/, "# 2, 3000000 Name")
            n = form == "dcmdump" ? 4000002 : form == "json" ? 3333336 : 1680000
            sub(/, 3000000/, ", " n)
            split("\\ \",\" </Value><Value>", between, " ")
            text = between[form == "dcmdump" ? 1 : form == "json" ? 2 : 3]
            sub(/ number="1"/, "")
            at = index($0, "@")
            printf "%s12.345678", substr($0, 1, at - 1)
            for (k = 1; k < n; k++) printf "%s12.345678", text
            print substr($0, at + 1)
        }'
}
for form in $forms; do
    forty_megabytes $form >one.set
    "$ISOLOFT" --list --json one.set >out 2>err
    status=$?
    holds "$form: a contour of $(($(wc -c <one.set) / 1000000)) MB is read" test $status -eq 0
    peak=$(sed -n 's/.*"peak_bytes":\([0-9]*\).*/\1/p' out)
    if sanitized; then
        skip "and takes memory by the size of the file" "sanitizers keep memory of their own"
    else
        holds "and takes memory by the size of the file" test "${peak:-0}" -gt 0 -a "${peak:-0}" -lt $((2 * $(wc -c <one.set)))
    fi
done

plan
