# gaps.sh - slices that are missing, and slices that stand alone.
. "$srcdir/tests/tap.sh"

# ---- stacks and structure sets to try ------------------------------------------

# Slices at the heights given, each a round shape that turns, with a hole.
tower() { # NAME Z...
    name=$1
    shift
    echo "$@" | awk -v name="$name" '{
        print "isoloft 1\nunit mm\nstack \"" name "\""
        for (i = 1; i <= NF; i++) {
            printf "slice %s\nring\n", $i
            for (k = 0; k < 24; k++) {
                t = 6.283185307179586 * k / 24
                r = 9 + 2 * sin(3 * t + $i / 4)
                printf "%.7g %.7g\n", r * cos(t), r * sin(t)
            }
            print "ring"
            for (k = 0; k < 7; k++)
                printf "%.7g %.7g\n", 3 * cos(k / 7 * 6.283185307179586), 3 * sin(k / 7 * 6.283185307179586)
        }
        print "end" }'
}

# The same as what dcmdump makes of a structure set: an ROI for each line of
# standard input, which holds its heights; a height with "!" has a contour
# without area.
dump() {
    awk 'function sequence(tag, s) { printf "(%s) SQ (Sequence with undefined length #=1) # u/l, 1 Sequence\n%s(fffe,e0dd) na (Sequence end) # 0, 0 End\n", tag, s }
        function in_item(s) { return "(fffe,e000) na (Item with undefined length #=1) # u/l, 1 Item\n" s "(fffe,e00d) na (Item end) # 0, 0 End\n" }
        function contour(z, flat,    s, k, n, t, r) {
            n = 24
            for (k = 0; k < n; k++) {
                t = 6.283185307179586 * k / n
                r = 9 + 2 * sin(3 * t + z / 4)
                s = s (k ? "\\" : "") sprintf("%.7g\\%.7g\\%s", r * cos(t), flat ? 0 : r * sin(t), z)
            }
            return in_item("(3006,0042) CS [CLOSED_PLANAR] # 14, 1 Type\n(3006,0050) DS [" s "] # 100, " 3 * n " Data\n")
        }
        {
            list = list in_item("(3006,0022) IS [" NR "] # 2, 1 Number\n(3006,0026) LO [roi " NR "] # 6, 1 Name\n")
            all = ""
            for (i = 1; i <= NF; i++)
                all = all contour($i + 0, $i ~ /!/)
            contours = contours in_item("(3006,0040) SQ (Sequence with undefined length #=1) # u/l, 1 Contours\n" all "(fffe,e0dd) na (Sequence end) # 0, 0 End\n(3006,0084) IS [" NR "] # 2, 1 Number\n")
        }
        END {
            print "# Dicom-Data-Set\n(0008,0060) CS [RTSTRUCT] # 8, 1 Modality"
            sequence("3006,0020", list)
            sequence("3006,0039", contours)
        }'
}

# The value of KEY in the account of the one stack in the file FILE.
value() { sed "s/.*\"$1\":\([^,}]*\)[,}].*/\1/" "$2"; }

tower gap 0 3 6 9 30 33 36 >gap.loft
tower alone 0 3 6 20 40 43 46 >alone.loft
tower first 0 20 23 26 50 >first.loft
echo 0 3 6 9 30 33 36 | dump >gap.txt
echo 0 3 6 20 40 43 46 | dump >alone.txt

# ---- native streams and SVG: only where it is asked for ------------------------

exits 0 "without --gap a wide distance is bridged" "$ISOLOFT" gap.loft -o plain.ply --json
holds "which is told" grep -q "1 gap wider than 2.5 usual spacings joined across, from z 9 to 30" err
tail -n 1 err >account
holds "also in the account" grep -q '"gaps":\[{"from":9,"to":30,"capped":false}\]' account
holds "and is one piece" test "$(value components account)" = 1
exits 0 "--gap bridge gives the same bytes" "$ISOLOFT" gap.loft --gap bridge -o bridged.ply
holds "they are the same" cmp plain.ply bridged.ply

exits 0 "--gap cap closes both sides" "$ISOLOFT" gap.loft --gap cap -o capped.ply --pairs capped.loft --json
holds "which is told" grep -q "1 gap closed on either side, from z 9 to 30" err
tail -n 1 err >account
holds "also in the account" grep -q '"gaps":\[{"from":9,"to":30,"capped":true}\]' account
holds "two pieces" test "$(value components account)" = 2
holds "a mesh that is sound" "$ISOLOFT" check capped.ply
holds "and a record between the pairs" test "$(grep -c '^gap$' capped.loft) $(grep -c '^pair$' capped.loft)" = "1 5"
"$ISOLOFT" mesh capped.loft -o again.ply
holds "of which the same mesh is made" cmp again.ply capped.ply
exits 0 "--gap bridge joins it all the same" "$ISOLOFT" capped.loft --gap bridge -o bridged.ply
holds "as if no record had been there" cmp plain.ply bridged.ply
holds "the two pieces' volumes add up" sh -c '
    sed "/^slice 30/,/^slice 36/{/^slice 36/!d;}" gap.loft | sed "/^slice 36/,\$d" >low; echo end >>low
    sed "4,/^slice 30/{/^slice 30/!d;}" gap.loft >high
    for part in low high; do "$ISOLOFT" info --json <$part 2>/dev/null | sed "s/.*\"volume\":\([^,]*\),.*/\1/"; done >volumes
    "$ISOLOFT" info --gap cap --json gap.loft 2>/dev/null | sed "s/.*\"volume\":\([^,]*\),.*/\1/" >>volumes
    awk "{ v[NR] = \$1 } END { d = v[1] + v[2] - v[3]; exit !(NR == 3 && v[1] > 500 && d * d < 1e-12) }" volumes'

exits 3 "--gap fail refuses it" "$ISOLOFT" gap.loft --gap fail -o failed.ply
holds "names stack and heights in one line" grep -q "stack 'gap': a gap from z = 9 to z = 30" err
holds "and writes nothing" test ! -e failed.ply
exits 3 "as it does what the stream calls a gap" "$ISOLOFT" capped.loft --gap fail -o failed.ply
exits 0 "what has no gap it lets pass" "$ISOLOFT" "$vase" --gap fail -o vase.ply
"$ISOLOFT" "$vase" -o plain-vase.ply
holds "unchanged" cmp vase.ply plain-vase.ply

# ---- slices that stand alone ---------------------------------------------------

exits 0 "a slice between two gaps is thickened" "$ISOLOFT" alone.loft --gap cap -o alone.ply --json
holds "which is told" grep -q "1 x single slice given a thickness" err
tail -n 1 err >account
holds "also in the account" test "$(value thickened_slices account)" = 1
holds "three pieces" test "$(value components account)" = 3
holds "from the slices of the input" test "$(value slices account)" = 7
exits 3 "--strict refuses that" "$ISOLOFT" alone.loft --gap cap --strict -o strict.ply
exits 0 "so are those at the ends" "$ISOLOFT" first.loft --gap cap --thickness 2 -t ply-ascii -o first.ply --json
tail -n 1 err >account
holds "three pieces" test "$(value components account)" = 3
holds "as thick as is wanted" grep -q '"z":\[-1,51\]' account
"$ISOLOFT" read --gap cap --thickness 2 first.loft 2>/dev/null >first.read
holds "the copies are marked as inserted" test "$(grep -c '^inserted 0 1 2' first.read)" = 8

tower one 7 >one.loft
exits 3 "a stack of one slice has no body of its own" "$ISOLOFT" one.loft -o one.ply
exits 0 "--thickness gives it one" "$ISOLOFT" one.loft --thickness 3 -o one.ply --json
tail -n 1 err >account
holds "that reaches as far up as down" grep -q '"z":\[5.5,8.5\]' account
exits 0 "in the unit of the input" "$ISOLOFT" one.loft --thickness 25.4 --to in -o one.ply --json
tail -n 1 err >account
holds "which is converted with it" sh -c 'grep -o "\"z\":\[[^]]*\]" account | tr -c "0-9.\n-" " " | awk "{ d = \$2 - \$1 - 1; exit !(d * d < 1e-20) }"'
exits 0 "--thickness alone leaves gaps joined" "$ISOLOFT" gap.loft --thickness 3 -o thick.ply
holds "and all the rest as it was" cmp thick.ply plain.ply
sed 's/^slice 20$/slice 20.5/; /^slice 40/,$d' alone.loft >given.loft
printf 'gap\nend\n' >>given.loft
exits 3 "a slice alone behind a gap record is refused" "$ISOLOFT" given.loft -o given.ply
holds "by its height and with a way out" grep -q "z = 20.5 stands alone beside a gap.*--thickness" err
exits 0 "and has a body with --thickness" "$ISOLOFT" given.loft --thickness 1 -o given.ply
holds "that is sound" "$ISOLOFT" check given.ply

# ---- structure sets: by default ------------------------------------------------

exits 0 "gaps of structure sets are closed by default" "$ISOLOFT" gap.txt -o set.ply --json
tail -n 1 err >account
holds "two pieces" test "$(value components account)" = 2
exits 0 "unless they are to be bridged" "$ISOLOFT" gap.txt --gap bridge -o set.ply --json
tail -n 1 err >account
holds "one piece" test "$(value components account)" = 1
exits 0 "their single slices are thickened" "$ISOLOFT" alone.txt -o set.ply --json
tail -n 1 err >account
holds "three pieces" test "$(value components account)" = 3
echo 0 3 6! 9 12 | dump >flat.txt
exits 0 "a slice whose contours have no area is none" "$ISOLOFT" flat.txt -o set.ply --json
tail -n 1 err >account
holds "so that the solid goes on past it" test "$(value components account)" = 1
holds "and the contour is counted" test "$(value degenerate_rings account)" = 1
echo 7 | dump >one.txt
exits 0 "a set of one slice is a millimetre thick" "$ISOLOFT" one.txt -o set.ply --json
holds "which is told" grep -q "a thickness of 1 mm is assumed" err
{ echo 7; echo 0 2.5 5; } | dump >two.txt
exits 0 "an ROI of one slice is as thick as the others' are apart" "$ISOLOFT" two.txt --roi 'roi 1' -o set.ply --json
tail -n 1 err >account
holds "a spacing" grep -q '"z":\[5.75,8.25\]' account
{ echo 0 3 6; echo 0 3 6 30 33 36; echo 0 3 6; } | dump >three.txt
exits 3 "--gap fail drops one ROI" "$ISOLOFT" three.txt --gap fail -o set/ -t ply
holds "and no other" sh -c '[ "$(ls set | tr "\n" " ")" = "0001-roi_1.ply 0003-roi_3.ply index.json " ]'
holds "the index says why" grep -q "a gap from z = 6 to z = 30" set/index.json

# ---- the same bytes on every road ----------------------------------------------

same_bytes() { # SENTENCE INPUT OPTIONS...: convert and the stages, any threads
    sentence=$1 input=$2
    shift 2
    why=
    for type in ply stl; do
        for cap in flat dome; do
            "$ISOLOFT" "$input" "$@" --cap $cap -t $type -q >whole || why="$type, $cap: exit $?"
            [ -s whole ] || why="$type, $cap: nothing"
            "$ISOLOFT" read "$input" "$@" -q | "$ISOLOFT" match -q | "$ISOLOFT" mesh -t $type --cap $cap -q >staged
            cmp whole staged || why="$type, $cap: the stages differ"
            for threads in 1 2 3 8; do
                "$ISOLOFT" "$input" "$@" --cap $cap -t $type --threads $threads -q >threaded
                cmp whole threaded || why="$type, $cap: $threads threads differ"
            done
        done
    done 2>/dev/null
    if [ -z "$why" ]; then case_ok "$sentence"; else case_bad "$sentence" "$why"; fi
}
same_bytes "a gap" gap.loft --gap cap
same_bytes "a slice alone between two" alone.loft --gap cap
same_bytes "slices alone at the ends" first.loft --gap cap --thickness 4
same_bytes "a structure set with a gap" gap.txt
same_bytes "a structure set with a slice alone" alone.txt
same_bytes "in another unit" alone.txt --to in
same_bytes "without matching" alone.loft --gap cap --thickness 1
same_bytes "a gap that is given" capped.loft

# ---- and the other commands ----------------------------------------------------

"$ISOLOFT" read --gap cap gap.loft 2>/dev/null | "$ISOLOFT" match 2>/dev/null >matched.loft
exits 0 "a stream with gaps is sound" "$ISOLOFT" check matched.loft
holds "and canonical" grep -q "canonical  *yes" out
exits 0 "info tells of gaps" "$ISOLOFT" info matched.loft
holds "and that they are closed" grep -q "gap  *z from 9 to 30 mm, closed on either side" out
exits 0 "plot draws them" "$ISOLOFT" plot matched.loft
holds "and says what they are" grep -q "gap: not joined" out
exits 0 "also one by one" "$ISOLOFT" plot matched.loft --pair 3
holds "in words" grep -q "A gap: nothing joins them" out

plan
