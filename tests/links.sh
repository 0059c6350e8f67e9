# links.sh - which rings belong together: --pieces, --links, --links-out and what is told of them.
. "$srcdir/tests/tap.sh"

# A trunk, and beside it thin branches that leave it: one slants by 2.5 a slice, so that its rings
# lie half a height apart, the other by 4, so that they lie 2 heights apart.
tree() { # NAME
    awk -v name="$1" 'function ring(x, y, r,    k) {
        print "ring"
        for (k = 0; k < 12; k++)
            printf "%.6g %.6g\n", x + r * cos(0.5235987755982988 * k), y + r * sin(0.5235987755982988 * k)
    }
    BEGIN {
        print "isoloft 1\nunit mm\nstack \"" name "\""
        for (z = 0; z < 8; z++) {
            print "slice", z
            ring(0, 0, 8)
            ring(9.5 + 2.5 * z, 0, 1)
            ring(-11 - 4 * z, 0, 1)
        }
        print "end" }'
}
not() { ! "$@"; }
count() { grep -c "$@"; }

tree tree | "$ISOLOFT" read >tree.loft
slabs=7

# ---- --pieces ---------------------------------------------------------------------------

exits 0 "overlaps alone are linked with --pieces overlap" "$ISOLOFT" match --pieces overlap tree.loft -o overlap.loft --links-out overlap.links
holds "so only the trunk holds together" test "$(count '^link .* overlap 0$' overlap.loft) $(count '^link' overlap.loft)" = "$slabs $slabs"
exits 0 "by default gaps of half a height are" "$ISOLOFT" match tree.loft -o usual.loft --links-out usual.links
holds "and gaps of two are not" test "$(count '^link .* join' usual.loft) $(count '^link' usual.loft)" = "$((slabs + 1)) $((2 * slabs + 1))"
exits 0 "gaps of two are with --pieces few" "$ISOLOFT" match --pieces few tree.loft -o few.loft --links-out few.links
holds "and all is one" test "$(count '^link .* join' few.loft) $(count '^link' few.loft)" = "$((2 * slabs + 2)) $((3 * slabs + 2))"
for words in "--pieces few --no-pieces" "--pieces overlap --no-pieces" "--no-pieces"; do
    # shellcheck disable=SC2086 # words of a line
    "$ISOLOFT" match $words tree.loft >again
    holds "the default again: $words" cmp usual.loft again
done
for pieces in overlap few; do
    "$ISOLOFT" mesh --pieces $pieces tree.loft -t ply >one.ply
    "$ISOLOFT" mesh $pieces.loft -t ply >two.ply
    holds "a mesh is made likewise: $pieces" cmp one.ply two.ply
    "$ISOLOFT" tree.loft --pieces $pieces -t ply >two.ply
    holds "and by convert: $pieces" cmp one.ply two.ply
    "$ISOLOFT" info --json --pieces $pieces tree.loft >$pieces.json
done
holds "more pieces without gaps" grep -q '"components":17,' overlap.json
holds "few with few" grep -q '"components":[123],' few.json
for threads in 1 2 3; do
    "$ISOLOFT" match --pieces few --threads $threads tree.loft >again
    holds "$threads threads: the same bytes" cmp few.loft again
done

# Does a slice come out while the stack has not ended?  Waits until it does, for so many tenths of
# a second at most; the whole stack is in ./early then.
comes_early() { # TENTHS WORD
    rm -f pipe early
    mkfifo pipe
    "$ISOLOFT" match "$2" <pipe >early 2>/dev/null &
    exec 9>pipe
    pillar 40 300 | sed '$d' >&9
    tries=0
    while [ ! -s early ] && [ $tries -lt "$1" ]; do
        sleep 0.1
        tries=$((tries + 1))
    done
    was=$(wc -c <early)
    echo end >&9
    exec 9>&-
    wait $!
    [ "$was" -gt 0 ]
}
holds "with overlap slices come before the stack ends" comes_early 600 --pieces=overlap
holds "by default none does" not comes_early 10 --no-pieces
holds "but all do then" test "$(count '^slice' early)" -eq 40

# ---- the file --------------------------------------------------------------------------------

for pieces in usual few overlap; do
    exits 0 "what was written is read: $pieces" "$ISOLOFT" match --links $pieces.links --links-out again.links tree.loft -o again.loft
    holds "and gives the same bytes" cmp $pieces.loft again.loft
    holds "and is written again" cmp $pieces.links again.links
    "$ISOLOFT" match --links $pieces.links --links-out again.links usual.loft >again.loft
    holds "also where other records came in" cmp $pieces.loft again.loft
    "$ISOLOFT" mesh $pieces.loft --links-out again.links -t ply >one.ply
    holds "records that came in are written" cmp $pieces.links again.links
    "$ISOLOFT" tree.loft --links $pieces.links -t ply >two.ply
    holds "and the mesh is the same" cmp one.ply two.ply
done
"$ISOLOFT" match --links - tree.loft <few.links >again.loft
holds "it may come from standard input" cmp few.loft again.loft
gzip -c few.links >few.links.gz
"$ISOLOFT" match --links few.links.gz tree.loft >again.loft
holds "and compressed" cmp few.loft again.loft

"$ISOLOFT" plot --skeleton --pieces few tree.loft >one.svg
"$ISOLOFT" plot --skeleton --links few.links tree.loft >two.svg
holds "the skeleton is drawn likewise" cmp one.svg two.svg

# Ring 2 of z = 3 is made to go over into ring 0, not ring 2, of z = 4; nothing above z = 5.
awk '$1 == "slab" { z = $2 } z == 3 && $0 ~ /^link 2 2/ { print "link 2 0 overlap 0 # by hand"; next } z < 5' few.links >edited.links
exits 0 "an edited file is read" "$ISOLOFT" match --links edited.links tree.loft -o edited.loft
holds "what was edited is given, and measured" test "$(count '^link 2 0 given [1-9]' edited.loft)" -eq 1
holds "what was not is as it was" test "$(count '^link .* join' edited.loft)" -eq $((2 * 5 + 1))
holds "slabs without a word have no links" test "$(awk '/^slice/ { z = $2 } /^link/ && z > 5' edited.loft | wc -l)" -eq 0
holds "check takes it" "$ISOLOFT" check edited.loft
"$ISOLOFT" read edited.loft >again.loft
holds "and it is read and written the same" cmp edited.loft again.loft
exits 0 "it makes a mesh" "$ISOLOFT" mesh edited.loft -o edited.ply --json=edited.json
holds "which is certified" "$ISOLOFT" check edited.ply

# A group without links, as old streams have them, is written as links that make it.
grep -v '^link' few.loft | "$ISOLOFT" match --links-out bare.links >/dev/null
holds "groups without links are written, without reasons" test "$(count '^link [0-9]* [0-9]*$' bare.links)" -eq $((3 * slabs + 2))
"$ISOLOFT" match --links bare.links few.loft >again.loft
grep -e '^lower' -e '^upper' few.loft >was
grep -e '^lower' -e '^upper' again.loft >is
holds "the same groups come of them" cmp was is
"$ISOLOFT" match --matcher none tree.loft | "$ISOLOFT" match --links-out none.links 2>err >/dev/null
holds "records that do not tell are left out, and told" grep -q "records of 7 pairs of slices do not tell" err

# ---- which stack ------------------------------------------------------------------------------

{ tree one; tree two | sed 1,2d; } | sed 's/^end$//; $s/$/\nend/' | "$ISOLOFT" read >both.loft
"$ISOLOFT" match --pieces few both.loft --links-out both.links >both.matched.loft
"$ISOLOFT" match --links both.links both.loft >again.loft
holds "stacks without a number go by their place" cmp both.matched.loft again.loft
sed -n '1p; /^stack 2/,$p' both.links >second.links
exits 0 "a file may name some of the stacks" "$ISOLOFT" match --links second.links both.loft -o second.loft
holds "the other's links are found, which is told" test "$(grep -c "stack 'one'.*second.links says nothing of it" err)" -eq 1
holds "as without the file" sh -c 'awk "/^stack/ { k++ } k == 1 && /^link/" second.loft >a; grep ^link usual.loft | cmp - a'
holds "and those of the stack that is named are as it says" sh -c 'awk "/^stack/ { k++ } k == 2 && /^link/" second.loft >a; grep ^link few.loft | cmp - a'
sed 's/^stack 2 "two"/stack 2 "tow"/' both.links >misspelt.links
exits 0 "a stack that does not come" "$ISOLOFT" match --links misspelt.links both.loft -o /dev/null
holds "is told with its line" grep -q "misspelt.links:$(grep -n tow misspelt.links | cut -d : -f 1): there is no stack 2 'tow'" err
{ tree one; tree one | sed 1,2d; } | sed 's/^end$//; $s/$/\nend/' | sed 's/^stack.*/&\nnumber 5/' | "$ISOLOFT" read >twins.loft
"$ISOLOFT" match twins.loft --links-out twins.links >twins.matched.loft
"$ISOLOFT" match --links twins.links twins.loft >again.loft 2>err
holds "twins are taken in their order" cmp twins.matched.loft again.loft
holds "without a word" not grep -q twins.links err
exits 3 "a ring that there is not ends the run" "$ISOLOFT" match -o no.loft --links "$srcdir/formats/links/invalid/x_link_lower.links" "$srcdir/formats/links/contours.loft"
holds "in one line" one_error
holds "and leaves nothing" test ! -e no.loft
exits 4 "a file that is not there" "$ISOLOFT" match --links nowhere.links tree.loft
holds "in one line" one_error

# ---- what is told --------------------------------------------------------------------------------------

tells() { # SENTENCE JSON WORDS...: the account of match WORDS has JSON in it
    sentence=$1 json=$2
    shift 2
    "$ISOLOFT" match --json "$@" tree.loft 2>err >/dev/null
    holds "$sentence" grep -q -F "$json" err
}
tells "links are counted" '"links":{"overlap":7,"slant":0,"near":0,"join":8,"opening":0,"given":0},"guessed":[],"parts":9,"median_join":0.5,' --no-pieces
tells "by overlap there are no joins" '"links":{"overlap":7,"slant":0,"near":0,"join":0,"opening":0,"given":0},"guessed":[],"parts":17,"median_join":0,' --pieces overlap
tells "one part, where links reach farther" '"parts":1,"median_join":0.5,"undersampled":true' --pieces few
tells "links farther than the slab is high are guesses" '"guessed":[{"from":0,"to":1,"lower":0,"upper":0,"reach":2,"heights":2},{"from":0,' --pieces few
holds "and are counted in a sentence" grep -q "stack 'tree': 8 links reach farther than the slab is high, and are guesses" err
holds "and so are slices too far apart" grep -q "there are few slices for what is in them: 16 links reach across gaps, which measure 50 %" err
tells "nothing of this where little is joined" '"undersampled":false' --pieces overlap
tells "what is given is no guess" '"join":0,"opening":0,"given":23},"guessed":[],' --links bare.links
tells "slices compared as they lie have links of no kind" '"given":0},"guessed":[],"parts":null' --matcher none
"$ISOLOFT" match -v --pieces few tree.loft 2>err >/dev/null
holds "-v lists links" grep -q "stack 'tree': links: 6 overlap, 1 slant, 16 join" err
holds "and guesses, each" test "$(count "guessed from z .*: ring [0-9]* to ring [0-9]*, 2 mm apart, 2 heights" err)" -eq 8
"$ISOLOFT" info --pieces few tree.loft >out
holds "info has them in its table" test "$(grep -c -e '^  links  *6 overlap, 1 slant, 16 join$' -e '^  guessed  *8 of them$' -e '^  parts  *1, as linked$' out)" -eq 3
"$ISOLOFT" mesh few.loft -t stl --json 2>err >/dev/null
holds "records that came in are counted too" grep -q '"links":{"overlap":6,"slant":1,"near":0,"join":16,' err

hinted() { "$ISOLOFT" match "$@" 2>&1 >/dev/null | grep -q "it is a vessel by its name or type, and in 9 parts: --pieces few"; }
for name in Vessels "portal vein" V_cava_Vein LeftRenalArtery "AORTA 2" bronchi; do
    tree "$name" >named.loft
    holds "a vessel by its name gets a hint: $name" hinted named.loft
done
for name in trunk Ventricle myvessel "inveins" BRAINSTEM; do
    tree "$name" >named.loft
    holds "another stack does not: $name" not hinted named.loft
done
tree "ROI 1" | sed 's/^stack.*/&\nattribute "RTROIInterpretedType" "VESSEL"/' >typed.loft
holds "a vessel by its type does" hinted typed.loft
tree vessel >named.loft
for words in "--pieces few" "--pieces overlap" --no-pieces "--links few.links" "--matcher none"; do
    # shellcheck disable=SC2086 # words of a line
    holds "no hint to who has said how to link: $words" not hinted $words named.loft
done
block vessel >named.loft
holds "nor where all is one part" not hinted named.loft

# ---- records in the stream ------------------------------------------------------------------------

# Without the record of one slab the others tell what is one part already, and it is found again.
for z in 1 4 7; do
    awk -v z=$z '/^slice/ { drop = 0 } /^slice/ { at = $2 } $1 == "pair" { drop = at == z } !drop || /^end$/' few.loft >part.loft
    holds "a record is missing above z = $((z - 1))" test "$(count '^pair' part.loft)" -eq $((slabs - 1))
    "$ISOLOFT" match --pieces few part.loft >again.loft
    holds "the same links are found for it" cmp few.loft again.loft
done
# The record joins trunk and branches above; below they must not be joined once more.
awk '/^slice/ { at = $2 } $1 == "pair" && at == 1 { print "pair\nmatcher none\ngroup\nlower 0 1 2\nupper 0 1 2"; drop = 1; next }
    /^slice/ || /^end$/ { drop = 0 } $1 == "pair" { drop = 1 } !drop' few.loft >tied.loft
"$ISOLOFT" match --pieces few tied.loft >again.loft
holds "what a record joins is not joined again" test "$(awk '/^slice/ { z = $2 } /^link .* join/ && z > 1' again.loft | wc -l)" -eq $((2 * (slabs - 1)))

# ---- the samples -----------------------------------------------------------------------------------

folder=$(cd "$srcdir/formats/links" && pwd)
for f in "$folder"/valid/v_*.links; do
    name=$(basename "$f" .links)
    "$ISOLOFT" match -q --links "$f" "$folder/contours.loft" | grep -e '^stack' -e '^slice' -e '^group' -e '^lower' -e '^upper' -e '^link' >out
    holds "read as specified: $name" cmp out "$folder/valid/$name.expected"
done
cd "$folder/invalid" || exit 1
for f in x_*.links; do
    name=${f%.links}
    "$ISOLOFT" match --links "$f" ../contours.loft >/dev/null 2>"$TMPDIR/err"
    status=$?
    { printf 'isoloft: '; cat "$name.error"; } >"$TMPDIR/want"
    holds "refused as specified: $name" sh -c "[ $status -eq 3 ] && cmp '$TMPDIR/err' '$TMPDIR/want'"
done
cd "$TMPDIR/work" || exit 1
grep -o '\[x_[a-z_0-9]*\]' "$folder.txt" | tr -d '[]' | sort -u >named
ls "$folder/invalid" | sed -n 's/\.links$//p' | sort >there
holds "every refusal has its sample, and the other way round" diff named there

plan
