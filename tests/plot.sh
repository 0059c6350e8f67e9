# plot.sh - pictures: what they are of, that they are SVG, and what is refused.
. "$srcdir/tests/tap.sh"

samples=$srcdir/formats/loft/valid
"$ISOLOFT" read "$vase" >clean.loft
"$ISOLOFT" match clean.loft --matcher none >matched.loft
has_xmllint=$(command -v xmllint)

# The picture FILE is one: whole, well-formed, every number short and finite.
picture() { # SENTENCE FILE
    sed 's/="#[0-9a-f]*"//g; s/>[^<]*</></g' "$2" >numbers
    if ! grep -q '^</svg>$' "$2" || [ "$(grep -c '<svg ' "$2")" -ne 1 ]; then
        case_bad "$1" "it does not begin or does not end"
    elif grep -q -i -e '[^a-z]nan' -e '[0-9.]e[-+0-9]' -e '[^a-z]inf' -e '\.[0-9][0-9][0-9]' numbers; then
        case_bad "$1" "$(grep -i -m 1 -e '[^a-z]nan' -e '[0-9.]e[-+0-9]' -e '[^a-z]inf' -e '\.[0-9][0-9][0-9]' numbers)"
    elif [ -n "$has_xmllint" ] && ! xmllint --noout --nonet "$2" 2>lint; then
        case_bad "$1" "$(head -n 3 lint)"
    else
        case_ok "$1"
    fi
}
says() { # SENTENCE FILE WORDS: the picture has a text with these words
    holds "$1" grep -q "<text [^>]*>[^<]*$3" "$2"
}
count() { grep -c "$1" "$2"; }

# ---- the three pictures --------------------------------------------------------

exits 0 "slices without pairs are a strip" "$ISOLOFT" plot clean.loft
cp out strip.svg
picture "which is a picture" strip.svg
says "it names the stack" strip.svg "vase"
says "and how much there is" strip.svg "33 slices, z 0 to 64 mm"
holds "every slice has its height" test "$(count '>z [0-9.]*</text>' strip.svg)" -eq 33
says "there is a scale in the stack's unit" strip.svg "50 mm"
exits 0 "pairs are a sheet" "$ISOLOFT" plot matched.loft
cp out sheet.svg
picture "which is a picture" sheet.svg
holds "every pair has its heights" test "$(count '>z [0-9.]* to [0-9.]*</text>' sheet.svg)" -eq 32
exits 0 "--slices is the strip of a stream with pairs" "$ISOLOFT" plot matched.loft --slices
holds "the same one" cmp out strip.svg
exits 0 "--no-slices takes it back" "$ISOLOFT" plot matched.loft --slices --no-slices
holds "to the sheet" cmp out sheet.svg
exits 0 "--pair draws a pair" "$ISOLOFT" plot matched.loft --pair 3
picture "which is a picture" out
says "and says which" out "Pair 3: lower slice 3 (z 6 mm), upper slice 4 (z 8 mm)"
exits 0 "the last one" "$ISOLOFT" plot matched.loft --pair 31
exits 0 "a pair without a record is drawn" "$ISOLOFT" plot "$vase" --pair 3
says "and said to be without" out "Not matched"

exits 0 "arcs that are near without it" "$ISOLOFT" plot "$samples/v_pair_near.loft" --pair 0
holds "are no matched arcs" grep -q "1 pair of matched arcs" out
exits 0 "a deformation" "$ISOLOFT" plot "$samples/v_pair_ffd.loft" --pair 0
picture "is a picture" out
says "with the plane it makes" out "upper slice carried by"
says "the figures of its groups" out "least Jacobian"
says "and its lattices" out "under φ, 2 lattice steps"
says "one that the record has not is no lattice" out "global step alone: no lattices in the record"
exits 0 "arcs" "$ISOLOFT" plot "$samples/v_pair_arcs.loft" --pair 0
picture "are a picture" out
for event in branch cap hole; do
    says "unmatched: $event" out "unmatched: $event"
done
exits 0 "cuts" "$ISOLOFT" plot "$samples/v_pair_cut.loft" --pair 0
picture "are a picture" out
says "and explained" out "cut on the medial axis"
holds "all in one bold red line, and that of the legend" test "$(count 'stroke="#d00000" stroke-width="3"/>' out)" -eq 2
holds "they part two regions into four and two pieces" test "$(sed -n '/fill-opacity=".35" fill-rule/,/^<.g>/p' out | grep -c 'M')" -eq 6
exits 0 "on the sheet" "$ISOLOFT" plot "$samples/v_pair_cut.loft"
says "as well" out "cut on the medial axis"
awk 'BEGIN { print "isoloft 1\nunit mm\nstack \"a\"\nslice 0\nring\n0 0\n9 0\n9 9\n0 9\nslice 2"
    print "ring\n1 1\n4 1\n4 8\nring\n5 1\n8 1\n8 8\nring\n9 10\n11 10\n11 12"
    print "pair\nmatcher none\ngroup\nlower 0\nupper 0 1 2\nlink 0 0 overlap 0\nlink 0 1 overlap 0\nlink 0 2 join 3\nend" }' >links.loft
sed 's/^end$/cut lower 0\n2 0\n2 4\nend/' "$samples/v_pair_ffd.loft" >divided.loft
exits 0 "a group that is divided" "$ISOLOFT" plot divided.loft --pair 0
picture "is a picture" out
says "it has no grid" out "has a φ of its own: 1 group"
holds "but others have theirs" sh -c 'grep -q "global step alone" out && ! grep -q "lattice step" out'
exits 0 "links" "$ISOLOFT" plot links.loft --pair 0
says "have their reasons" out "overlap: 2 links"
says "guesses are named" out "guessed, gap &gt; height: 1 link"
says "and how far they reach" out "Links reach over gaps of up to 3 mm, 1.5 of the slab's height"
holds "a dot on each end" test "$(count '<circle' out)" -eq 6
exits 0 "two regions that overlap and nothing else" "$ISOLOFT" plot "$samples/v_pair_arcs.loft" --pair 0
holds "need no line" sh -c '! grep -q "<circle" out'
says "how much is matched" out "2 pairs of matched arcs: 92.9 % of the lower outline"
for sample in "$samples"/v_*.loft; do
    name=${sample##*/}
    "$ISOLOFT" plot "$sample" >out 2>err
    case $?$(cat out) in
        0*) picture "a sample is a picture: $name" out ;;
        3) holds "a sample has nothing to draw: $name" sh -c 'grep -q "nothing to draw" err || ! grep -q ^slice "$1"' - "$sample" ;;
        *) case_bad "a sample: $name" "$(cat err)" ;;
    esac
done
for name in ffd arcs arcs_none groups none empty_slices ffd_one_side; do
    exits 0 "its pair: $name" "$ISOLOFT" plot "$samples/v_pair_$name.loft" --pair 0
    picture "is a picture" out
done

# ---- the skeleton ----------------------------------------------------------------

exits 0 "--skeleton is the whole stack" "$ISOLOFT" plot "$vase" --skeleton
cp out skeleton.svg
picture "which is a picture" skeleton.svg
says "with a centre for each region" skeleton.svg "The centres of 53 regions, joined by 54 links: 1 piece, 2"
says "the reasons of its links" skeleton.svg "overlap: 54 links"
says "and its branching places" skeleton.svg "branching places: 2"
holds "which are marked, and explained" test "$(count '<circle' skeleton.svg)" -eq 3
bones() { sed -n 's/^\(<path d="\)*\(M[^"]*\).*/\2/p' "$1" | grep -c '^M[-0-9. ]*l[-0-9. ]*$'; }
holds "every link is a line, and there are its halo, the legend's, axes, scale and ticks" test "$(bones skeleton.svg)" -eq 129
exits 0 "of records" "$ISOLOFT" match clean.loft -o ffd.loft
exits 0 "it is the same" "$ISOLOFT" plot ffd.loft --skeleton
holds "to the byte" cmp out skeleton.svg
exits 0 "records without groups" "$ISOLOFT" plot matched.loft --skeleton
holds "say no less" cmp out skeleton.svg
exits 0 "one thread" "$ISOLOFT" plot matched.loft --skeleton --threads 1
holds "draws the same" cmp out skeleton.svg
exits 0 "--no-skeleton takes it back" "$ISOLOFT" plot matched.loft --skeleton --no-skeleton
holds "to the sheet" cmp out sheet.svg
# A pillar, and a vessel that leaves it without ever overlapping: over gaps of half the
# height of a slab at first, then of one and a half.  Something else lies far away.
awk 'BEGIN {
    print "isoloft 1\nunit mm\nstack \"tree\""
    for (z = 0; z < 6; z++) {
        print "slice", 2 * z; box(0, 0, 9)
        if (z > 0) box(4 + 6 * z, 0, z < 3 ? 5 : 3)
        if (z == 5) box(90, 90, 1)
    }
    print "end"
}
function box(x, y, w) { print "ring\n" x, y "\n" x + w, y "\n" x + w, y + w "\n" x, y + w }' >tree.loft
exits 0 "what does not overlap" "$ISOLOFT" plot tree.loft --skeleton --pieces overlap
says "is in pieces" out "The centres of 12 regions, joined by 5 links: 7 pieces"
says "of which the small ones are counted" out "2 smaller pieces: 2 regions"
says "and ends" out "ends inside the stack: 6"
exits 0 "joins" "$ISOLOFT" plot tree.loft --skeleton
says "are told from overlaps" out "joined over a gap: 3 links"
exits 0 "far ones" "$ISOLOFT" plot tree.loft --skeleton --pieces few
says "are guesses" out "guessed, gap &gt; height: 2 links"
picture "and a picture" out
says "which leave one thing alone" out "ends inside the stack: 1"
"$ISOLOFT" plot tree.loft --skeleton --pieces few >few.svg
exits 0 "linked records" sh -c '"$ISOLOFT" match tree.loft --pieces few 2>/dev/null | "$ISOLOFT" plot --skeleton'
holds "say the same" cmp out few.svg
exits 2 "--pieces for another picture" "$ISOLOFT" plot tree.loft --pieces few
holds "is refused in one line" one_error
{ "$ISOLOFT" read tree.loft | sed '/^end$/d'; echo gap; echo end; } >closed.loft
exits 0 "a gap" "$ISOLOFT" plot closed.loft --skeleton --pieces overlap
says "is no end" out "ends inside the stack: 4"
printf 'isoloft 1\nunit m\nstack "hill"\nkind terrain\nslice 5\nring\n0 0\n9 0\n9 9\nend\n' >hill.loft
exits 0 "terrain" "$ISOLOFT" plot hill.loft --skeleton
says "has none" out "has no skeleton"
awk 'BEGIN { print "isoloft 1\nunit mm\nstack \"a\"\nslice 0\nring\n0 0\n4 4\n4 0\n0 4\nslice 1\nring\n9 9\n1 1\n9 1\nend" }' >tangled.loft
exits 0 "contours in disorder" "$ISOLOFT" plot tangled.loft --skeleton
says "are cleaned first" out "The centres of 3 regions"
for sample in "$samples"/v_pair_*.loft "$samples"/v_gap*.loft; do
    exits 0 "the skeleton of a sample: ${sample##*/}" "$ISOLOFT" plot "$sample" --skeleton
    picture "is a picture" out
done

# ---- the same bytes, any way ---------------------------------------------------

exits 0 "standard input, standard output" sh -c '"$ISOLOFT" plot <matched.loft'
holds "the same" cmp out sheet.svg
exits 0 "both named" "$ISOLOFT" plot - -o - <matched.loft
holds "the same" cmp out sheet.svg
exits 0 "a file" "$ISOLOFT" plot matched.loft -o sheet2.svg
holds "has the same" cmp sheet2.svg sheet.svg
exits 0 "a file of no extension" "$ISOLOFT" plot matched.loft -o sheet3
holds "has the same" cmp sheet3 sheet.svg
exits 0 "another unit" "$ISOLOFT" plot "$vase" --to cm
says "is that of the scale" out "5 cm"
exits 0 "a folder" "$ISOLOFT" plot matched.loft -o folder/
holds "has a picture for every stack" cmp folder/0001-vase.svg sheet.svg
holds "that its index names" grep -q '"file":"0001-vase.svg"' folder/index.json
exits 0 "an account" "$ISOLOFT" plot matched.loft -o x.svg --json=account.json
holds "counts slices" grep -q '"slices":33' account.json

# ---- several stacks, and none --------------------------------------------------

sed '/^end$/d' matched.loft >two.loft
printf 'stack "short"\nslice 0\nring\n0 0\n5 0\n0 5\nslice 1\nring\n0 0\n4 0\n0 4\nend\n' >>two.loft
exits 0 "two stacks are two figures" "$ISOLOFT" plot two.loft
picture "on one page" out
says "the first" out vase
says "the second" out short
exits 0 "one of them can be chosen" "$ISOLOFT" plot two.loft --stack short
holds "alone" sh -c '! grep -q vase out'
exits 0 "a pair that one stack has is drawn" "$ISOLOFT" plot two.loft --pair 7
holds "of that stack" sh -c 'grep -q vase out && ! grep -q short out'
exits 2 "in a folder that is a failure of the other" "$ISOLOFT" plot two.loft --pair 7 -o pairs/
holds "which the index tells" sh -c 'test "$(ls pairs)" = "0001-vase.svg
index.json" && grep -q "\"failed\"" pairs/index.json'
exits 2 "a pair that no stack has" "$ISOLOFT" plot two.loft --pair 32
holds "is refused by naming those there are" grep -q 'no pair 32.*0 to 31' err
exits 2 "nor one" "$ISOLOFT" plot matched.loft --pair 99999999
holds "in one line" one_error
exits 2 "a slice alone" "$ISOLOFT" plot "$samples/v_one_slice.loft" --pair 0
printf 'isoloft 1\nend\n' >none.loft
exits 3 "no stack" "$ISOLOFT" plot none.loft
holds "nothing to draw" one_error
printf 'isoloft 1\nunit mm\nstack "a"\nend\n' >empty.loft
exits 3 "no slice" "$ISOLOFT" plot empty.loft
holds "nothing to draw" grep -q "nothing to draw" err
printf 'isoloft 1\nunit mm\nstack ""\nslice 0\nslice 1\nend\n' >bare.loft
exits 0 "slices without rings" "$ISOLOFT" plot bare.loft
picture "are a picture" out
says "of a stack by number" out "Stack 1"
says "and of nothing" out "empty"
exits 0 "as a pair" "$ISOLOFT" plot bare.loft --pair 0
picture "as well" out
exits 0 "as a skeleton" "$ISOLOFT" plot bare.loft --skeleton
picture "too" out
says "without bones" out "The centres of 0 regions, joined by 0 links: 0 pieces"

exits 3 "an SVG is no native stream" "$ISOLOFT" plot "$vase_svg"
holds "and read makes one of it" grep -q "isoloft read" err
exits 3 "a cut stream" sh -c 'head -c 30000 matched.loft | "$ISOLOFT" plot -o cut.svg'
holds "leaves no picture" test ! -e cut.svg

# ---- names and numbers that mean harm ------------------------------------------

printf 'isoloft 1\nunit mm\nstack "</text><script>&\\"\047\\x1b[31m\\xe2\\x80\\xae\\n]]>\\xef\\xbf\\xbe-->"\nslice 0\nring\n0 0\n9 0\n9 9\nend\n' >evil.loft
exits 0 "a name of markup" "$ISOLOFT" plot evil.loft
picture "is text" out
holds "and no markup" sh -c '! grep -q "<script" out && grep -q "&lt;/text&gt;&lt;script&gt;&amp;&quot;" out'
exits 0 "as the name of a skeleton" "$ISOLOFT" plot evil.loft --skeleton
picture "likewise" out
holds "nothing in it steers a terminal" sh -c '! tr -d "\n" <out | LC_ALL=C grep -q "[[:cntrl:]]"'
{ printf 'isoloft 1\nunit mm\nstack "'; awk 'BEGIN { for (k = 0; k < 100000; k++) printf "漢字" }'; printf '"\nslice 0\nring\n0 0\n9 0\n9 9\nend\n'; } >long.loft
exits 0 "a name of two hundred thousand letters" "$ISOLOFT" plot long.loft
picture "is cut" out
holds "to what a page holds" test "$(wc -c <out)" -lt 3000
for scale in 9e14 1e-30 1e-300; do
    awk -v s=$scale 'BEGIN { print "isoloft 1\nunit mm\nstack \"a\"\nslice -" s "\nring\n-" s " -" s "\n" s " -" s "\n" s " " s "\nslice " s "\nring\n-" s " -" s "\n" s " -" s "\n" s " " s
        print "pair\nmatcher none\nend" }' >size.loft
    for words in "" --slices "--pair 0" --skeleton; do
        # shellcheck disable=SC2086 # words of a line
        exits 0 "coordinates of $scale $words" "$ISOLOFT" plot size.loft $words
        picture "are a picture" out
    done
done
sed 's/^0 0\.5$/-9e14 9e14/; s/^lattice 2 3 -2 -2 6.5$/lattice 2 3 -9e14 -2 1e-9/; s/^3 0 0 4$/3 0 -9e14 9e14/' \
    "$samples/v_pair_ffd.loft" >wild.loft
exits 0 "a deformation that leaves the page" "$ISOLOFT" plot wild.loft --pair 0
picture "is a picture" out
awk 'BEGIN { print "isoloft 1\nunit mm\nstack \"a\""
    for (z = 0; z < 2; z++) { print "slice", z, "\nring"; for (k = 0; k < 2000; k++) { t = k / 318.3098862; printf "%.9f %.9f\n", -cos(t), -sin(t) } }
    print "pair\nmatcher none"; for (k = 0; k < 2000; k++) print "unmatched upper 0 " k " 0 " k " 0 cap"
    print "end" }' >over.loft
exits 3 "arcs that lie over one another are refused" "$ISOLOFT" plot over.loft
holds "before they cost time" grep -q "over one another" err

awk 'BEGIN { print "isoloft 1\nunit mm\nstack \"a\"\nslice 0\nring\n0 0\n9 0\n9 9\n0 9\nslice 2\npair\nmatcher none"
    for (k = 0; k < 5000; k++) print "cut lower 0\n" k * 7919 % 5000 / 556 " 0\n" k / 556 " 9"
    print "end" }' >crossed.loft
exits 0 "thousands of cuts across each other" "$ISOLOFT" plot crossed.loft --pair 0
picture "are drawn as lines" out
holds "without their millions of pieces" test "$(wc -c <out)" -lt 1000000

# ---- sizes ---------------------------------------------------------------------

pillar 500 400 >pillar.loft
exits 0 "a sheet of five hundred pairs" sh -c '"$ISOLOFT" match pillar.loft --matcher none | "$ISOLOFT" plot'
picture "is a picture" out
holds "of sane size" test "$(wc -c <out)" -lt 3000000
exits 0 "their skeleton" "$ISOLOFT" plot pillar.loft --skeleton
holds "is smaller" test "$(wc -c <out)" -lt 2000000
pillar 3 100000 >dense.loft
exits 0 "outlines of a hundred thousand vertices" "$ISOLOFT" plot dense.loft --pair 1
holds "lose what no page shows" test "$(wc -c <out)" -lt 30000

if [ -w /dev/full ]; then
    exits 4 "a full disk" sh -c '"$ISOLOFT" plot "$1" >/dev/full' - "$vase"
else
    skip "a full disk" "no /dev/full"
fi
if command -v rsvg-convert >/dev/null; then
    for file in strip.svg sheet.svg skeleton.svg; do
        holds "librsvg draws $file" rsvg-convert $file -o picture.png
    done
else
    skip "librsvg draws it" "no rsvg-convert"
fi

plan
