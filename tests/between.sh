# between.sh - contours put between the slices of solids, and ends that follow.
. "$srcdir/tests/tap.sh"

# A body of round slices with radii $2... one unit apart, named $1; "-" is an empty slice.
lathe() {
    name=$1
    shift
    echo "$@" | awk -v name="$name" '{
        print "isoloft 1\nunit mm\nstack \"" name "\""
        for (i = 1; i <= NF; i++) {
            printf "slice %d\n", i - 1
            if ($i == "-") continue
            print "ring"
            for (k = 0; k < 48; k++)
                printf "%.9g %.9g\n", $i * cos(6.283185307179586 * k / 48), $i * sin(6.283185307179586 * k / 48)
        }
        print "end" }'
}

# The value of KEY in the account in ./account.
value() { sed "s/.*\"$1\":\([^,}]*\)[,}].*/\1/" account; }

# Heights of the vertices of ASCII PLY $1, each once.
heights() { awk '/^element vertex/ { n = $3 } past && n-- > 0 { print $3 } /^end_header/ { past = 1 }' "$1" | sort -gu; }
n_heights() { heights "$1" | awk 'END { print NR }'; }
highest() { heights "$1" | tail -n 1; }

# The coordinates of stack $1 that are no vertex of ASCII PLY $2.
missing() {
    awk 'FNR == NR { if (past && n-- > 0) at[$1 + 0, $2 + 0, $3 + 0] = 1; if (/^element vertex/) n = $3; if (/^end_header/) past = 1; next }
        /^slice/ { z = $2 + 0 } /^[-.0-9]/ && !(($1 + 0, $2 + 0, z) in at) { print }' "$2" "$1"
}

lathe ball 3 4 4.5 4.5 4 3 >ball.loft

# ---- how many ------------------------------------------------------------------

for many in 0 1 2 7 64; do
    exits 0 "--between $many" "$ISOLOFT" ball.loft --between $many -t ply-ascii -o $many.ply --json=account
    holds "gives $many heights between each two slices" test "$(n_heights $many.ply)" -eq $((6 + 5 * many))
    holds "as the account says" test "$(value levels) $(value slabs_halved) $(value slabs_straight)" = "$((5 * many)) 0 0"
    holds "with every contour vertex" test -z "$(missing ball.loft $many.ply)"
    holds "soundly" "$ISOLOFT" check -q $many.ply
done
for words in "--no-between:0" "--between=0:0" "--between auto:auto" "--no-between --between 2:2"; do
    # shellcheck disable=SC2086 # words of a line
    "$ISOLOFT" ball.loft ${words%:*} -t ply-ascii -o one.ply
    [ -e auto.ply ] || "$ISOLOFT" ball.loft -t ply-ascii -o auto.ply
    holds "${words%:*} is what ${words#*:} is" cmp one.ply "${words#*:}.ply"
done
holds "the default is between 1 and 7" sh -c "[ $(n_heights auto.ply) -ge 11 ] && [ $(n_heights auto.ply) -le 41 ]"
lathe pillar 3 3 3 3 >pillar.loft
"$ISOLOFT" pillar.loft -t ply-ascii -o pillar.ply
"$ISOLOFT" pillar.loft -t ply-ascii --no-between -o straight.ply
holds "and what is straight gets none" cmp pillar.ply straight.ply
for t in stl obj ply; do
    "$ISOLOFT" ball.loft --between 3 -o ball.$t
    holds "$t is sound" "$ISOLOFT" check -q ball.$t
done

for value in 65 -1 1.5 x ''; do
    exits 2 "--between '$value' is refused" "$ISOLOFT" ball.loft --between "$value" -o no.ply
    holds "in one line" one_error
done

# ---- the same whatever the road ----------------------------------------------------

"$ISOLOFT" <"$vase" -t ply >piped.ply
"$ISOLOFT" "$vase" -o whole.ply
"$ISOLOFT" read "$vase" | "$ISOLOFT" match | "$ISOLOFT" mesh -t ply >filters.ply
holds "a stream gives what the file gives" cmp piped.ply whole.ply
holds "and so do the filters" cmp filters.ply whole.ply
"$ISOLOFT" "$vase" --threads 1 -o one.ply
"$ISOLOFT" "$vase" --threads 5 -o five.ply
holds "and any number of threads" cmp one.ply five.ply
"$ISOLOFT" "$vase" --between 2 --pairs 2.loft -o 2.ply
"$ISOLOFT" "$vase" --no-between --pairs 0.loft -o 0.ply
holds "pair records know nothing of it" cmp 2.loft 0.loft
"$ISOLOFT" mesh --between 2 2.loft -o again.ply
holds "and make the same mesh" cmp again.ply 2.ply
holds "with as many pieces and handles" sh -c '
    for m in 0 2; do "$ISOLOFT" check --json $m.ply | sed "s/.*\"components\":\([0-9]*\),.*\"genus\":\([0-9]*\).*/\1 \2/"; done | uniq | wc -l | grep -qx " *1"'

# ---- what meets -------------------------------------------------------------------

# A body turns back a little beside one that leans away from it.
{
    printf 'isoloft 1\nunit mm\nstack "near"\n'
    awk 'function ring(x, r, n,    k) {
            print "ring"
            for (k = 0; k < n; k++) printf "%.9g %.9g\n", x + r * cos(6.283185307179586 * k / n), r * sin(6.283185307179586 * k / n)
        }
        BEGIN { for (z = 0; z < 4; z++) { print "slice", z; ring(0, z == 1 ? 10 : 8 - (z == 3) * 2, 90); ring(28.05 + 2 * z, 20, 180) } print "end" }'
} >near.loft
exits 0 "strips that would meet" "$ISOLOFT" near.loft -o near.ply --json=account
holds "are bent less there" test "$(value slabs_halved)" -ge 1
holds "but bent" test "$(value slabs_straight)" -eq 0
holds "and are sound" "$ISOLOFT" check -q near.ply
"$ISOLOFT" info near.loft >told
holds "which is told" grep -q "halved where strips met" told

# ---- ends ----------------------------------------------------------------------------

for cap in flat dome auto; do
    exits 0 "--cap $cap" "$ISOLOFT" ball.loft --cap $cap -t ply-ascii -o $cap.ply
    holds "is sound" "$ISOLOFT" check -q $cap.ply
done
holds "flat ends are in the last slice" test "$(highest flat.ply)" = 5
lathe disc 9 7 5 3 >disc.loft
"$ISOLOFT" disc.loft --cap auto -t ply-ascii -o disc.ply
holds "ends that follow are as high as they come in" sh -c "awk 'BEGIN { exit !($(highest disc.ply) > 3.1 && $(highest disc.ply) <= 3.5) }'"
lathe block 3 3 3 >block.loft
"$ISOLOFT" block.loft --cap auto -t ply-ascii -o block.ply
holds "and never higher than half a spacing" sh -c "awk 'BEGIN { exit !($(highest block.ply) > 2.4 && $(highest block.ply) <= 2.5) }'"

# ---- slices that are missing ------------------------------------------------------------

lathe parted 3 4 5 - 2 3 2 >parted.loft
exits 0 "an empty slice in the midst" "$ISOLOFT" parted.loft -o parted.ply --json=account
holds "parts it" test "$(value components)" -eq 2
holds "soundly" "$ISOLOFT" check -q parted.ply
sed 's/^slice 5/slice 25/' ball.loft | sed 's/^slice 4/slice 24/' >gap.loft
for cap in flat auto; do
    exits 0 "a gap with ends that are $cap" "$ISOLOFT" gap.loft --gap cap --cap $cap --between 2 -t ply-ascii -o gap.ply --json=account
    holds "gets nothing between" test "$(value levels)" -eq 8
    holds "and is sound" "$ISOLOFT" check -q gap.ply
done

plan
