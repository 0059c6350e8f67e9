# map-errors.sh - maps that are damaged, unsuitable or mean harm, in every format: exit 3,
# one clear line on standard error, and no output.
. "$srcdir/tests/tap.sh"
. "$srcdir/tests/maps-forms.sh"

# What is wrong with the run of isoloft on FILE is said on standard output; WORDS have to
# be in its line.
judge() { # FILE WORDS OPTIONS...
    file=$1 words=$2
    shift 2
    rm -f out.loft
    "$ISOLOFT" read "$@" "$file" -o out.loft >out 2>err
    status=$?
    if [ $status -ne 3 ] || ! one_error; then
        echo "$file $*: exit $status: $(head -n 3 err | cut -c 1-200)"
    elif ! grep -q "^isoloft: ${file%.*}[.a-zA-Z]*\(:[0-9][0-9]*\)\?: .*$words" err; then
        echo "$file $*: not '$words': $(cut -c 1-200 err)"
    elif [ "$(wc -c <err)" -gt 600 ]; then
        echo "$file $*: a line of $(wc -c <err) bytes"
    elif [ -e out.loft ] || [ -s out ]; then
        echo "$file $*: left an output"
    fi
}

# The same, but rows of tables that hold no numbers may be left out, which is told.
judge_rows() { # FILE WORDS OPTIONS...
    case $form in
    csv-xyz | csv-comma)
        "$ISOLOFT" read -f csv "$1" -o rows.loft >out 2>err && grep -q '^isoloft: skipped: .*row' err && return
        ;;
    esac
    judge "$@"
}

none() { # SENTENCE: ./wrong is empty
    holds "$1" sh -c 'cat wrong; [ ! -s wrong ]'
}

# "$form" and "$reader" of every form that is read, with coordinates in $unit.
each_form() { # COMMAND...
    while read -r form reader units; do
        [ -n "$form" ] && is_read "$reader" || continue
        unit=${units%% *}
        "$@"
    done <forms
}
echo "$map_forms" >forms
relief metres >metres.lines
relief degrees >degrees.lines
all_lines() { cat "$unit.lines"; }

# ---- nothing in it ------------------------------------------------------------------

empty() {
    : >"$form.map"
    judge "$form.map" "" -f "$reader"
}
each_form empty >wrong
none "an empty file, whatever its format is said to be"
: >nothing
judge nothing "the input is empty" >wrong
none "an empty file of no said format"

header_only() {
    map_as "$form" $unit </dev/null >"$form.map"
    judge "$form.map" "" -f "$reader"
}
each_form header_only >wrong
none "only a header"

# ---- no isolines --------------------------------------------------------------------

# Attributes of other names, whose names are told.
no_heights() {
    case $form in
    *-z | gmt | csv-xyz | csv-comma | bln | dxf* | gpx) return ;; # their heights have no name
    esac
    all_lines | map_as "$form" $unit | sed 's/elev/colour/' >"$form.map"
    judge "$form.map" "colour"
}
each_form no_heights >wrong
none "no heights: refused with the attributes that there are"

# Every point at its own height.
track() {
    case $form in
    *-z | csv-xyz | csv-comma | dxf-polyline) ;;
    *) return ;;
    esac
    sed -n 's/^1[12]0 /@@ /p' $unit.lines | map_as "$form" $unit |
        awk '{ while (sub(/@@/, 100 + ++n)) continue; print }' >"$form.map"
    judge "$form.map" "isoline"
}
each_form track >wrong
none "a track: refused with that word"

# A point a line, as other programs write spot heights.
points() {
    tr ' ' '\n' <$unit.lines | grep , | awk '{ print 100 + NR % 7 " " $1 }' | map_as "$form" $unit >"$form.map"
    judge "$form.map" "no \(iso\)\{0,1\}lines"
}
each_form points >wrong
none "points by themselves: refused with that word"

one_level() {
    grep '^110 ' $unit.lines | map_as "$form" $unit >"$form.map"
    judge "$form.map" "one level"
}
each_form one_level >wrong
none "one level: refused with that word"

# ---- damage -------------------------------------------------------------------------

# Of the form's good map, $lines lines of isolines.
good() { all_lines | map_as "$form" $unit; }

junk() {
    { good | head -c 4500; printf '\377\376\000\001\200\033[2J\n\r\t\010\177\377'; head -c 3000 "$ISOLOFT"; good | tail -c 500; } >"$form.map"
    judge "$form.map" ""
    judge_rows "$form.map" "" -f "$reader"
}
each_form junk >wrong
none "binary junk behind a good beginning"

decimal() { if [ $form = csv-comma ]; then echo ","; else echo "[.]"; fi; }

zeros() {
    good | awk -v number="[0-9]$(decimal)[0-9]" 'NR > 1 && !done && sub(number, "1@2") { done = 1 } { print }' |
        tr '@' '\000' >"$form.map"
    judge_rows "$form.map" "" -f "$reader"
}
each_form zeros >wrong
none "a zero byte in a coordinate"

# In place of the first digit before a point.
awk 'BEGIN { for (k = 0; k < 1000000; k++) printf "1234567890" }' >digits
long_number() {
    good | awk -v number="[0-9]$(decimal)[0-9]" 'NR > 1 && !done && match($0, number) {
            done = 1
            printf "%s", substr($0, 1, RSTART - 1)
            system("cat digits")
            $0 = substr($0, RSTART + 1)
        }
        { print; fflush() }' >"$form.map"
    [ "$(wc -c <"$form.map")" -gt 10000000 ] || echo "$form: not long"
    judge_rows "$form.map" "" -f "$reader"
    judge "$form.map" "" -f "$reader" --max-line 100000
}
each_form long_number >wrong
none "a number of ten million digits"

# A format whose end can be seen is refused wherever it is cut; others may be read, with
# fewer lines.
cut_anywhere() {
    good >whole.map
    size=$(wc -c <whole.map) k=1
    while [ $k -lt 30 ]; do
        head -c $((size * k / 30)) whole.map >"$form.map"
        "$ISOLOFT" read -q -f "$reader" "$form.map" -o out.loft >out 2>err
        status=$?
        case $form:$status in
        *:3) one_error && [ ! -e out.loft ] || echo "$form at $k: $(head -n 2 err)" ;;
        geojsonseq*:0 | gmt*:0 | csv*:0 | bln*:0) [ -s out.loft ] || echo "$form at $k: nothing" ;;
        *) echo "$form at $k: exit $status" ;;
        esac
        rm -f out.loft
        k=$((k + 1))
    done
}
each_form cut_anywhere >wrong
none "cut anywhere it is refused, where that can be seen"

cut_gzip() {
    good | gzip -c >whole.gz
    head -c $(($(wc -c <whole.gz) * 2 / 3)) whole.gz >"$form.map"
    judge "$form.map" ""
}
each_form cut_gzip >wrong
none "a compressed file that was cut"

# Numbers of points that are stated and wrong.
wrong_counts() {
    case $form in bln*) ;; *) return ;; esac
    for count in 3 99 4294967295 99999999999999999999; do
        good | sed "1s/^[0-9]*/$count/" >"$form.map"
        judge "$form.map" "" -f "$reader"
    done
}
each_form wrong_counts >wrong
none "blocks that state wrong numbers of points"

# ---- the samples of every format ---------------------------------------------------------

for format in geojson geojsonseq gmt csv bln dxf shp kml gpx; do
    [ -d "$srcdir/formats/$format/invalid" ] || continue
    mkdir "$format" && cp "$srcdir/formats/$format"/invalid/* "$format"
    for expected in "$format"/*.error; do
        file=$(printf '%s\n' "${expected%.error}".* | grep -v -i '\.\(error\|dbf\|shx\|prj\|cpg\)$')
        # shellcheck disable=SC2046 # the words of the options that a sample asks for
        judge "$file" "" -f "$format" --project none $(sed -n 's/^isoloft read \(--[a-z]* [A-Z]*\)$/\1/p' "$file")
    done >wrong
    none "$format: the invalid samples"
done

# ---- not what it is said to be -----------------------------------------------------------

kind_of() { # READER: tables of numbers may be one another
    case $1 in
    geojson*) echo json ;;
    gmt | csv | bln) echo table ;;
    *) echo "$1" ;;
    esac
}
other_format() {
    good >"$form.map"
    for other in loft svg dcmdump dicom-json dicom-xml geojson geojsonseq gmt csv bln dxf kml gpx; do
        is_read $other && [ "$(kind_of $other)" != "$(kind_of "$reader")" ] || continue
        judge "$form.map" "" -f $other
    done
}
each_form other_format >wrong
none "a map read as any other format"

mixed() {
    good >"$form.map"
    "$ISOLOFT" read "$form.map" "$srcdir/examples/vase.svg" -o out.loft >out 2>err
    [ $? -eq 3 ] && one_error && [ ! -e out.loft ] || echo "$form: $(head -n 2 err)"
}
each_form mixed >wrong
none "two formats in one run"

mkdir folder
folder() {
    "$ISOLOFT" read -f "$reader" folder -o out.loft >out 2>err
    [ $? -eq 4 ] && one_error && [ ! -e out.loft ] || echo "$form: $(head -n 2 err)"
}
each_form folder >wrong
none "a folder is no file, exit 4"

printf 'PK\003\004\024\000\000\000\010\000doc.kml' >map.kmz
judge map.kmz "unzip it first" >wrong
cp map.kmz map.shp
judge map.shp "unzip it first" >>wrong
none "a zip archive is called one"

plan
