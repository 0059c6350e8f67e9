# isolines.sh - isolines between those of a map (--between N -t loft), as typed and read again.
. "$srcdir/tests/tap.sh"

island=$srcdir/examples/island.geojson
"$ISOLOFT" -q -t loft "$island" >plain.loft

# The slices that are the map's own, of a native stream; those of interpolated lines alone.
own() { awk 'function flush() { if (!put_in) printf "%s", text; text = ""; put_in = 0 }
             /^slice/ || /^end/ { flush() } /^inserted/ { put_in = 1 } { text = text $0 "\n" } END { flush() }' "$1"; }
levels() { awk '/^slice/ { print $2 }' "$1"; }

exits 0 "four levels between each two" "$ISOLOFT" --between 4 -t loft "$island" -o denser.loft
holds "are told" grep -q "[0-9]* isolines at 52 heights are interpolated between those of the map" err
holds "there are four" test "$(levels denser.loft | wc -l)" -eq $((5 * $(levels plain.loft | wc -l) - 4))
holds "at even distances" sh -c "awk '/^slice/ { if (n++ && \$2 - z != 4) exit 1; z = \$2 }' denser.loft"
own denser.loft >own.loft
holds "the map's own lines stay as they are" cmp own.loft plain.loft
holds "the others are marked, all of their vertices" awk '
    function flush() { if (n && own != "" && marks != n && marks > 0) exit 1; n = marks = 0 }
    /^(ring|line|slice|end)/ { flush(); own = "x" } NF == 2 && $1 + 0 == $1 { n++ } /^inserted/ { marks = NF - 1 }' denser.loft
exits 0 "it comes from standard input" sh -c '"$ISOLOFT" -q --between 4 -t loft <"$1"' sh "$island"
holds "the same" cmp out denser.loft
exits 0 "for any number of threads" "$ISOLOFT" -q --between 4 -t loft --threads 3 "$island"
holds "the same" cmp out denser.loft

exits 0 "read takes it" "$ISOLOFT" read --strict denser.loft
holds "as it is" cmp out denser.loft
exits 0 "check finds it sound" "$ISOLOFT" check denser.loft
exits 0 "info tells of its levels" "$ISOLOFT" info denser.loft
holds "their distance" grep -q "interval  *4 m" out
holds "that nothing is missing or left out" test "$(grep -c -e 'repairs *none' -e 'skipped *nothing' out)" -eq 2
holds "and no line ends inside" grep -q "open ends .* 0 of them inside the map" out
exits 0 "a surface is made of it" "$ISOLOFT" --strict denser.loft -o denser.ply
holds "without a word" test ! -s err
exits 0 "and a solid" "$ISOLOFT" --strict denser.loft --solid -o denser.stl
exits 0 "which is sound" "$ISOLOFT" check denser.stl
exits 0 "more between those" "$ISOLOFT" -q --between 1 -t loft denser.loft -o again.loft
holds "doubles them" test "$(levels again.loft | wc -l)" -eq $((2 * $(levels denser.loft | wc -l) - 1))

# A cone of rings 0, 10, 20 high, which on the mean has its lines where the radius is.
awk 'BEGIN { print "isoloft 1\nunit m\nstack \"cone\"\nkind terrain"
    for (z = 0; z <= 20; z += 10) {
        print "slice " z "\nring"
        for (k = 0; k < 48; k++) {
            turn = k * 0.1308996938995747
            printf "%.6f %.6f\n", (100 - 4 * z) * cos(turn), (100 - 4 * z) * sin(turn)
        }
    }
    print "end" }' >cone.loft
exits 0 "a cone" "$ISOLOFT" -q --between 3 -t loft cone.loft -o lines.loft
holds "has no lines above its highest" test "$(levels lines.loft | tr '\n' ' ')" = "0 2.5 5 7.5 10 12.5 15 17.5 20 "
holds "closed lines within each other" awk '
    function flush() { if (n) { if (!(least < before + 1e-9) || (z > 0 && !(most < inner))) exit 1; inner = least; before = most } n = 0 }
    BEGIN { before = 1e9; inner = 1e9 }
    /^slice/ { flush(); z = $2 } /^line/ { exit 1 }
    NF == 2 && $1 + 0 == $1 { r = sqrt($1 ^ 2 + $2 ^ 2); if (!n++) least = most = r; if (r < least) least = r; if (r > most) most = r }
    END { flush() }' lines.loft
holds "with the higher ground on their left" awk '
    function flush() { if (n && marked && sum + x * y0 - x0 * y <= 0) exit 1; n = sum = marked = 0 }
    /^(ring|slice|end)/ { flush() } /^inserted/ { marked = 1 }
    NF == 2 && $1 + 0 == $1 { if (n++) sum += x * $2 - $1 * y; else { x0 = $1; y0 = $2 } x = $1; y = $2 }' lines.loft

for words in "--between auto" "--between 0" "--no-between"; do
    # shellcheck disable=SC2086 # words of a line
    exits 0 "$words" "$ISOLOFT" -q $words -t loft "$island"
    holds "puts none in" cmp out plain.loft
done
exits 0 "a surface" "$ISOLOFT" "$island" --between 4 -o a.ply
holds "is told to be the same" grep -q "between changes no surface of terrain" err
"$ISOLOFT" -q "$island" -o b.ply
holds "and is" cmp a.ply b.ply
exits 0 "contours of solids" "$ISOLOFT" "$vase" --between 4 -t loft -o vase.loft
holds "get none in a native stream" grep -q "none into a native stream" err
"$ISOLOFT" -q "$vase" -t loft -o pairs.loft
holds "which is what it was" cmp vase.loft pairs.loft
exits 0 "a frame of the user's" "$ISOLOFT" -q --between 1 --frame hull -t loft "$island" -o hull.loft
holds "cuts off what is outside" "$ISOLOFT" read --strict hull.loft -o hull2.loft
exits 2 "65 are too many" "$ISOLOFT" --between 65 -t loft "$island"
holds "in one line" one_error
printf 'isoloft 1\nunit m\nstack "a"\nkind terrain\nend\n' >empty.loft
exits 0 "a map without lines" "$ISOLOFT" -q --between 4 -t loft empty.loft
holds "stays one" cmp out empty.loft
printf 'isoloft 1\nunit m\nstack "a"\nkind terrain\nslice 0\nline\n0 0\n1 1\n2 0\nslice 1\nline\n0 1\n1 1\n2 1\nend\n' >loose.loft
"$ISOLOFT" -q --between 1 -t loft loose.loft >out 2>err
status=$?
holds "lines that no ground stands on are an error, or kept" sh -c "[ $status -eq 0 ] || { [ $status -eq 3 ] && [ ! -s out ]; }"
plan
