# keyhole.sh - keyholes of structure sets, and of others when they are asked for.
. "$srcdir/tests/tap.sh"

apart=$srcdir/formats/dcmdump/valid/v_keyhole_apart.txt

# Three slices with a hole on a channel whose sides are $1 apart; the unit is $2.
slit() {
    awk -v gap="$1" -v unit="$2" -v scale="${3:-1}" 'BEGIN {
        print "isoloft 1\nunit " unit "\nstack \"slit\""
        n = split("0 0 20 0 20 9 12 9 12 6 6 6 6 14 12 14 12 9 20 9 20 20 0 20", p, " ")
        for (z = 0; z < 3; z++) {
            print "slice " scale * z "\nring"
            for (i = 1; i < n; i += 2) print scale * p[i], scale * (p[i + 1] + (i == 17 || i == 19 ? gap : 0))
        }
        print "end" }'
}

repairs() { sed -n 's/^  repairs  *//p'; }

"$ISOLOFT" info "$apart" | repairs >out
holds "a structure set's keyholes are opened" grep -q -x "2 x keyhole opened.*" out
"$ISOLOFT" info --no-keyhole "$apart" | repairs >out
holds "with --no-keyhole they are not" sh -c '! grep -q keyhole out'
"$ISOLOFT" info --keyhole 0 "$apart" | sed "/^  seconds /d" >zero
"$ISOLOFT" info --no-keyhole "$apart" | sed "/^  seconds /d" >no
holds "--keyhole 0 is --no-keyhole" cmp zero no
"$ISOLOFT" info --keyhole 0.01 "$apart" | repairs >out
holds "a smaller distance than that of the sides leaves them" sh -c '! grep -q keyhole out'
"$ISOLOFT" info --to m "$apart" | repairs >out
holds "the default is a length, whatever the unit" grep -q -x "2 x keyhole opened.*" out

slit 0.04 mm >slit.loft
exits 0 "contours of other formats are taken as they are" "$ISOLOFT" info slit.loft
holds "slit and all" sh -c 'repairs() { sed -n "s/^  repairs  *//p"; }; repairs <out | grep -q -x none'
"$ISOLOFT" info --keyhole 0.05 slit.loft >out
holds "but for --keyhole" sh -c 'sed -n "s/^  repairs  *//p" out | grep -q -x "3 x keyhole opened"'
holds "which makes a ring of them: genus 1" grep -q "genus 1" out
slit 0.04 m 0.001 >metres.loft
"$ISOLOFT" info --keyhole 0.00005 metres.loft >out
holds "it is in the unit of the stack" grep -q "3 x keyhole opened" out

"$ISOLOFT" "$apart" -o whole.ply
"$ISOLOFT" read "$apart" | "$ISOLOFT" match | "$ISOLOFT" mesh -o pipe.ply
holds "read | match | mesh is convert" cmp whole.ply pipe.ply
"$ISOLOFT" slit.loft --keyhole 0.05 -o slit.ply
exits 0 "the mesh is sound" "$ISOLOFT" check slit.ply
"$ISOLOFT" read --keyhole 0.05 slit.loft >read.loft
"$ISOLOFT" read --keyhole 0.05 read.loft >again.loft
holds "what is opened stays as it is" cmp read.loft again.loft
exits 3 "--strict takes keyholes for repairs" "$ISOLOFT" read --strict "$apart"

for value in -1 x '' 1e15 0.05mm; do
    exits 2 "refused: --keyhole '$value'" "$ISOLOFT" info --keyhole "$value" slit.loft
done
exits 2 "match takes contours that read has opened" "$ISOLOFT" match --keyhole 0.05 slit.loft

plan
