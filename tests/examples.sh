# examples.sh - the vessel tree and the examples of maps, the island and the Jacksboro fault, as the READMEs tell.
# Of the vase see usage.sh, of the phantom phantom.sh.
. "$srcdir/tests/tap.sh"

mkdir bin && ln -s "$ISOLOFT" bin/isoloft
PATH=$PWD/bin:$PATH
row() { holds "$1: $2" grep -q "^  $1  *$2" out; }
between() { awk -v low="$1" -v value="$2" -v high="$3" 'BEGIN { exit !(low < value && value < high) }'; }

# Commands of README file $1 that begin with $2, one a line, as they are typed beside the example.
commands() { sed -n 's|^    ||; s|^\./||; s|examples/||g; /^'"$2"'/p' "$srcdir/$1"; }

# ---- the vessel tree ------------------------------------------------------------

cp "$srcdir"/examples/tree.* .
awk -f tree.awk >made.loft
holds "tree.loft is what tree.awk makes" cmp made.loft tree.loft
commands examples/README.md 'isoloft tree.loft' | grep -v picture.py >told
holds "the README makes something of the tree in three ways" test "$(wc -l <told)" -eq 3
for pieces in 6 4 1; do
    read -r line
    exits 0 "the README's $line" sh -c "$line"
    mesh=${line##* }
    exits 0 "$mesh is sound" isoloft check "$mesh"
    row components "$pieces, genus 0$"
done <told
commands examples/README.md 'isoloft plot tree' >told
holds "and draws how it hangs together" test "$(wc -l <told)" -eq 1
sh told
holds "in the picture that it shows" cmp tree-skeleton.svg "$srcdir/examples/tree-skeleton.svg"
exits 0 "nothing of the tree needs repair" isoloft info tree.loft --pieces few
row repairs 'none$'
row surface certified

# ---- the island ----------------------------------------------------------------

cp "$srcdir"/examples/island.* .
for form in geojson gmt; do awk -v form=$form -f island.awk >made.$form; done
holds "island.geojson is what island.awk makes" cmp made.geojson island.geojson
holds "and small" test "$(wc -c <made.geojson)" -lt 100000
{ commands README.md 'isoloft.* island'; commands examples/README.md 'isoloft.* island'; } | grep -v picture.py >told
holds "both READMEs make something of it" test "$(grep -c 'stl$' told)" -ge 2
while read -r line; do
    rm -f island.stl island.ply
    exits 0 "the README's $line" sh -c "$line"
    [ ! -e island.stl ] || mv island.stl solid.stl
    [ ! -e island.ply ] || mv island.ply open.ply
done <told

exits 0 "the solid is sound" isoloft check solid.stl
row components '1, genus 0$'
row size '100 x 87[.0-9]* x [12][0-9][.0-9]*$'
exits 1 "the surface is open" isoloft check open.ply
holds "and else sound" test "$(grep -c -e 'manifold *yes' -e 'oriented *yes' -e 'crossings *none' out)" -eq 3
exits 0 "info tells of both" isoloft info island.geojson
row surface 'certified, open at the frame; 3[0-9]* vertices'
row frame 'bbox, 26 faces$'

# Lowest and highest vertex of the surface of FILE.
reach() {
    isoloft -q "$1" -t ply-ascii |
        awk 'inside && NF == 7 { if (!n++ || $3 < low) low = $3; if (n == 1 || $3 > high) high = $3 }
             /^end_header/ { inside = 1 } END { print low, high }'
}
holds "its summit and its trough are as high as the points say" test "$(reach island.geojson)" = "-127.9 152.5"
reach made.gmt >reached
holds "without points it rises above its last line" between 140.5 "$(cut -d ' ' -f 2 reached)" 159.9
holds "and falls below it" between -139.9 "$(cut -d ' ' -f 1 reached)" -120.5
isoloft -q --solid made.gmt -o gmt.stl
exits 0 "its solid is sound" isoloft check gmt.stl

# ---- the Jacksboro fault ---------------------------------------------------------

jacksboro=$srcdir/examples/jacksboro.sh
exits 77 "without the elevation model there is nothing" env DEM=nowhere sh "$jacksboro" none
holds "but the name of the package that has it" grep -q "install .*python-matplotlib-data" err
holds "no folder either" test ! -e none
mkdir fault
echo old >fault/jacksboro.geojson
sh "$jacksboro" fault >out 2>err
status=$?
if [ $status -eq 77 ]; then
    skip "the Jacksboro fault" "$(sed 's/.*: //' err)"
else
    holds "the script runs" test $status -eq 0
    exits 0 "it leaves isolines" isoloft info fault/jacksboro.geojson
    row levels '42, from 240 to 1060 m$'
    row lines '20[0-9][0-9]: 4[0-9][0-9] open, 1[0-9]* closed$'
    row repairs 'none$'
    row skipped 'nothing$'
    row surface 'certified, open at the frame'
    exits 0 "a solid that is sound" isoloft check fault/jacksboro.stl
    row components '1, genus 0$'
    row size '142[.0-9]* x 150 x 1[0-9][.0-9]*$'
    exits 1 "and a surface that is open" isoloft check fault/jacksboro.ply
    holds "and else sound" test "$(grep -c -e 'manifold *yes' -e 'oriented *yes' -e 'crossings *none' out)" -eq 3
    # From the lines of 240 and 1060 m it goes on by less than 20 m; the model has 236 to 1076 m.
    row size '3[01][0-9][0-9][0-9][.0-9]* x 3[23][0-9][0-9][0-9][.0-9]* x 8[2-5][0-9][.0-9]*$'
fi

plan
