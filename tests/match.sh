# match.sh - what `isoloft match` adds to a stream.
. "$srcdir/tests/tap.sh"

# ---- things to match: slices Z APART, each a ring or two of N vertices ----------

leaning() { # a pillar that leans, swells and turns, with a hole
    awk -v n="$1" 'BEGIN {
        print "isoloft 1\nunit mm\nstack \"leaning\""
        for (z = 0; z < 4; z++) {
            printf "slice %d\nring\n", z
            for (k = 0; k < n; k++) {
                t = 6.283185307179586 * k / n
                r = 9 + z / 4 + 2 * sin(3 * t + z / 3)
                printf "%.9g %.9g\n", 2 * z + r * cos(t), z + r * sin(t)
            }
            print "ring"
            for (k = n; k > 0; k -= 4)
                printf "%.9g %.9g\n", 2 * z + 3 * cos(6.283185307179586 * k / n), z + (3 + z / 5) * sin(6.283185307179586 * k / n)
        }
        print "end" }'
}

branching() { # one that becomes two, beside one that ends
    awk -v n="$1" 'BEGIN {
        print "isoloft 1\nunit mm\nstack \"branching\""
        for (z = 0; z < 5; z++) {
            printf "slice %d\n", z
            for (b = 0; b < (z < 2 ? 1 : 2) + (z < 3); b++) {
                print "ring"
                x = b == 2 || (z < 2 && b == 1) ? 40 : z < 2 ? 0 : (b ? 1 : -1) * (4 + 2 * z)
                for (k = 0; k < n; k++)
                    printf "%.9g %.9g\n", x + (z < 2 && b == 0 ? 16 : 7) * cos(6.283185307179586 * k / n), 8 * sin(6.283185307179586 * k / n)
            }
        }
        print "end" }'
}

leaning 60 | "$ISOLOFT" read >leaning.loft
branching 40 | "$ISOLOFT" read >branching.loft
block block | "$ISOLOFT" read >block.loft

# phi of every row of a stream with lattices by formats/loft.txt 8.3 -> the furthest that a row
# is off, in sizes of its box, and how many rows were looked at.
evaluate='
function b(t) { t = t < 0 ? -t : t; return t < 1 ? (4 - 6 * t * t + 3 * t * t * t) / 6 : t < 2 ? (2 - t) * (2 - t) * (2 - t) / 6 : 0 }
function floor(t,    i) { i = int(t); return i > t ? i - 1 : i }
function step(l,    u, v, i, j, i0, j0, w, sx, sy) {
    u = (px - lx[l]) / lh[l]; v = (py - ly[l]) / lh[l]; i0 = floor(u) - 1; j0 = floor(v) - 1
    sx = sy = 0
    for (j = j0; j < j0 + 4; j++)
        for (i = i0; i < i0 + 4; i++)
            if (i >= 0 && j >= 0 && i < nx[l] && j < ny[l]) {
                w = b(u - i) * b(v - j)
                sx += w * dx[l, j * nx[l] + i]; sy += w * dy[l, j * nx[l] + i]
            }
    px += sx; py += sy
}
function look(v, t, x, y,    w, g, l, off, ax, ay) {
    w = v + 1 < n[ring] ? v + 1 : 0
    px = (1 - t) * vx[ring, v] + t * vx[ring, w]; py = (1 - t) * vy[ring, v] + t * vy[ring, w]
    g = group_of[ring]
    if (g == "" || size[g] == 0)
        size[g = "none"] = 1
    else {
        ax = px; ay = py
        px = a11[g] * ax + a12[g] * ay + b1[g]; py = a21[g] * ax + a22[g] * ay + b2[g]
        for (l = first[g]; l < last[g]; l++)
            step(l)
    }
    off = sqrt((px - x) ^ 2 + (py - y) ^ 2) / size[g]
    if (off > most) most = off
    rows++
}
$1 == "slice" { rings = 0; state = "" }
$1 == "ring" { n[rings++] = 0; state = "ring"; next }
$1 == "pair" { groups = lattices = 0; split("", group_of); split("", size); state = ""; next }
$1 == "group" { first[groups] = last[groups] = lattices; groups++; next }
$1 == "upper" { for (i = 2; i <= NF; i++) group_of[$i] = groups - 1; next }
$1 == "global" { a11[groups - 1] = $2; a12[groups - 1] = $3; a21[groups - 1] = $4; a22[groups - 1] = $5; b1[groups - 1] = $6; b2[groups - 1] = $7; next }
$1 == "box" { size[groups - 1] = $4 - $2; next }
$1 == "lattice" { nx[lattices] = $2; ny[lattices] = $3; lx[lattices] = $4; ly[lattices] = $5; lh[lattices] = $6
                  node = 0; last[groups - 1] = ++lattices; state = "lattice"; next }
$1 == "phi" { ring = $2; state = "phi"; next }
/^[a-z]/ { state = ""; next }
state == "ring" { vx[rings - 1, n[rings - 1]] = $1; vy[rings - 1, n[rings - 1]++] = $2 }
state == "lattice" { dx[lattices - 1, node] = $1; dy[lattices - 1, node++] = $2 }
state == "phi" { look($1, $2, $3, $4) }
END { printf "%.3g %d\n", most, rows }'

without_lattices() { awk '/^[a-z]/ { drop = $1 == "lattice" } !drop'; }

# ---- records ---------------------------------------------------------------------

for name in leaning branching block; do
    exits 0 "match takes the $name" "$ISOLOFT" match $name.loft -o $name.matched.loft
    holds "a record stands between all slices" test "$(grep -cx pair $name.matched.loft)" -eq $(($(grep -c '^slice' $name.matched.loft) - 1))
    holds "by deformation" test "$(grep -cx 'matcher ffd' $name.matched.loft)" -eq "$(grep -cx pair $name.matched.loft)"
    holds "which check accepts" "$ISOLOFT" check $name.matched.loft
    "$ISOLOFT" read $name.matched.loft >again
    holds "which reads and writes the same" cmp $name.matched.loft again
    "$ISOLOFT" match <$name.matched.loft >again
    holds "which match leaves as it is" cmp $name.matched.loft again
    grep -v -e '^[a-z]' $name.loft | sort >was
    sed '/^pair$/,/^slice/{/^slice/!d;}' $name.matched.loft | grep -v -e '^[a-z]' | sort >is
    holds "whose contours are those that came in" cmp was is

    for k in 1 2 3 8; do
        "$ISOLOFT" match --threads $k $name.loft >threads
        holds "$k threads give the same bytes" cmp $name.matched.loft threads
    done
    "$ISOLOFT" match $name.loft >twice
    holds "twice the same bytes" cmp $name.matched.loft twice
    for threads in 1 2 3; do
        "$ISOLOFT" match --threads $threads $name.loft >threads
        holds "with $threads threads too" cmp $name.matched.loft threads
    done
    cat $name.loft | "$ISOLOFT" match >stdin
    holds "from a pipe too" cmp $name.matched.loft stdin
    "$ISOLOFT" match - <$name.loft >dash
    holds "and from a dash" cmp $name.matched.loft dash

    exits 0 "match --lattice takes the $name" "$ISOLOFT" match --lattice $name.loft -o $name.lattice.loft
    holds "with a lattice for every step" test "$(grep -c '^lattice ' $name.lattice.loft)" -eq \
        "$(awk '$1 == "steps" { n += $2 } END { print n + 0 }' $name.lattice.loft)"
    holds "which check accepts" "$ISOLOFT" check $name.lattice.loft
    "$ISOLOFT" read $name.lattice.loft >again
    holds "which reads and writes the same" cmp $name.lattice.loft again
    without_lattices <$name.lattice.loft >bare
    holds "and but for them is what match writes" cmp bare $name.matched.loft
    awk "$evaluate" $name.lattice.loft >off
    holds "the lattices give phi, as the format words it" awk -v rows="$(awk '/^[a-z]/ { phi = $1 == "phi" } phi' $name.lattice.loft |
        grep -c -v '^phi')" '{ good = $1 < 1e-9 && $2 == rows && rows > 0 } END { exit !good }' off

    "$ISOLOFT" match --matcher none $name.loft >none
    holds "--matcher none says no more than that" sh -c 'grep -A 1 -x pair none | grep -v -x -e pair -e -- | sort -u | grep -qx "matcher none" &&
        ! grep -q -e "^group" -e "^phi" -e "^match " none'
    "$ISOLOFT" read none >again
    holds "and reads and writes the same" cmp none again
done
# ---- more slices than are held at a time -------------------------------------------

pillar 30 24 | "$ISOLOFT" read >pillar.loft
"$ISOLOFT" match --threads 1 pillar.loft >pillar.matched.loft
holds "thirty slices have 29 records" test "$(grep -cx pair pillar.matched.loft)" -eq 29
# Of the pairs after the slices 5 to 7, 16 and 29 the stream brings those of one thread.
awk '$1 == "slice" { i++; keep = i >= 6 && i <= 8 || i == 17 || i == 30 } $1 == "pair" { drop = !keep } $1 == "slice" || $1 == "end" { drop = 0 } !drop' \
    pillar.matched.loft >some.loft
holds "some of them taken away" test "$(grep -cx pair some.loft)" -eq 5
for k in 1 2 3 8; do
    "$ISOLOFT" match --threads $k pillar.loft >threads
    holds "$k threads give the same bytes" cmp pillar.matched.loft threads
    "$ISOLOFT" match --threads $k some.loft >threads
    holds "and fill the places of those that are wanting" cmp pillar.matched.loft threads
    "$ISOLOFT" --threads $k pillar.loft -t ply >threads.$k.ply
    holds "and give the same mesh" cmp threads.1.ply threads.$k.ply
done
awk '{ print } $1 == "slice" && ++i == 20 { exit } ' pillar.loft >broken.loft
echo "1 2 three" >>broken.loft
for k in 1 3; do
    exits 3 "a stream that breaks off while pairs are matched is refused: $k threads" "$ISOLOFT" match --threads $k broken.loft
    holds "in one line" one_error
    mv out broken.$k
done
holds "with the same bytes before" cmp broken.1 broken.3

holds "slices that lean are deformed" sh -c 'grep "^steps" leaning.matched.loft | grep -qv " 0$"'
holds "slices that are equal are not" sh -c '! grep "^steps" block.matched.loft | grep -qv " 0$"'
holds "nothing folds" sh -c '! cat leaning.matched.loft branching.matched.loft | grep -q "^jacobian -"'

exits 2 "an unknown matcher is refused" "$ISOLOFT" match --matcher magic block.loft
holds "in one line" one_error
holds "that names it" grep -q magic err
holds "and nothing is written" test ! -s out
exits 3 "half a stream is refused" sh -c 'sed \$d block.loft | "$ISOLOFT" match'
if [ -w /dev/full ]; then
    exits 4 "a full disk" sh -c '"$ISOLOFT" match leaning.loft >/dev/full'
    holds "is told in one line" one_error
else
    skip "full disks" "no /dev/full"
fi
{ sleep 0.2; "$ISOLOFT" match leaning.loft 2>pipe.err; echo $? >pipe.status; } | :
holds "a pipe that nobody reads kills" grep -qx 141 pipe.status
holds "without a word" test ! -s pipe.err

# ---- and their meshes --------------------------------------------------------------

for name in leaning branching; do
    for matcher in ffd none; do
        for format in ply stl; do
            "$ISOLOFT" --matcher $matcher $name.loft -t $format >whole
            "$ISOLOFT" match --matcher $matcher $name.loft | "$ISOLOFT" mesh -t $format >pipe
            holds "match | mesh is the whole: $name, $matcher, $format" cmp whole pipe
            holds "and sound" "$ISOLOFT" check whole
        done
    done
    "$ISOLOFT" mesh $name.lattice.loft -t ply >lattice.ply
    "$ISOLOFT" mesh $name.matched.loft -t ply >match.ply
    holds "lattices do not change the mesh" cmp lattice.ply match.ply
done

plan
