# slic3r.sh - a solid of our own, sliced by Debian's slic3r, comes back in millimetres,
# the right way up, with its holes.  TAP; skipped where slic3r is not installed.

echo "1..9"
n=0

ok() { # STATUS SENTENCE
    n=$((n + 1))
    if [ "$1" -eq 0 ]; then echo "ok $n - $2"; else echo "not ok $n - $2"; fi
}

if ! command -v slic3r >/dev/null; then
    while [ $n -lt 9 ]; do
        n=$((n + 1))
        echo "ok $n # SKIP slic3r is not installed"
    done
    exit 0
fi
cd "$TMPDIR" || exit 1

# Triangles A B C and A C D of a quadrangle, corners as "x y z".
facets='
function corner(s) { print "vertex " s }
function facet(a, b, c) { print "facet normal 0 0 0\nouter loop"; corner(a); corner(b); corner(c); print "endloop\nendfacet" }
function quad(a, b, c, d) { facet(a, b, c); facet(a, c, d) }'

# An angle: a plate of 30 x 20 x 4 with a window of 10 x 5 in it, and along its
# far edge a wall of 30 x 4 up to 14.  Cells of a grid are full or empty; each
# side of a full cell that meets an empty one is a quadrangle of the surface.
awk "$facets"'
function full(i, j, k) {
    if (i < 1 || i > 3 || j < 1 || j > 4 || k < 1 || k > 2) return 0
    return k == 1 ? !(i == 2 && j == 2) : j == 4
}
function p(i, j, k) { return X[i] " " Y[j] " " Z[k] }
BEGIN {
    split("0 10 20 30", X); split("0 5 10 16 20", Y); split("0 4 14", Z)
    print "solid angle"
    for (i = 1; i <= 3; i++) for (j = 1; j <= 4; j++) for (k = 1; k <= 2; k++) if (full(i, j, k)) {
        I = i + 1; J = j + 1; K = k + 1
        if (!full(i - 1, j, k)) quad(p(i, j, k), p(i, j, K), p(i, J, K), p(i, J, k))
        if (!full(i + 1, j, k)) quad(p(I, j, k), p(I, J, k), p(I, J, K), p(I, j, K))
        if (!full(i, j - 1, k)) quad(p(i, j, k), p(I, j, k), p(I, j, K), p(i, j, K))
        if (!full(i, j + 1, k)) quad(p(i, J, k), p(i, J, K), p(I, J, K), p(I, J, k))
        if (!full(i, j, k - 1)) quad(p(i, j, k), p(i, J, k), p(I, J, k), p(I, j, k))
        if (!full(i, j, k + 1)) quad(p(i, j, K), p(I, j, K), p(I, J, K), p(i, J, K))
    }
    print "endsolid angle"
}' >angle.stl

# A torus, 10 from its axis to the middle of a tube of radius 4.
awk "$facets"'
function p(i, j,    u, v) {
    u = 2 * pi * (i % 96) / 96; v = 2 * pi * (j % 48) / 48
    return sprintf("%.9g %.9g %.9g", 14 + (10 + 4 * cos(v)) * cos(u), 14 + (10 + 4 * cos(v)) * sin(u), 4 + 4 * sin(v))
}
BEGIN {
    pi = atan2(0, -1)
    print "solid torus"
    for (i = 0; i < 96; i++) for (j = 0; j < 48; j++) quad(p(i, j), p(i + 1, j), p(i + 1, j + 1), p(i, j + 1))
    print "endsolid torus"
}' >torus.stl

for solid in angle torus; do
    slic3r --export-svg --layer-height 0.5 --first-layer-height 0.5 -o $solid.svg $solid.stl >$solid.out 2>&1 &&
        "$ISOLOFT" read -q $solid.svg >$solid.loft 2>>$solid.out
    status=$?
    [ $status -eq 0 ] || sed 's/^/# /' $solid.out
    ok $status "slic3r slices the $solid and isoloft reads it"
done

# A line a slice: z, rings, holes (rings that run clockwise), area, greatest x and y.
for solid in angle torus; do
    awk '
    function finish(    i, j, a) {
        for (i = 0; i < m; i++) { j = (i + 1) % m; a += x[i] * y[j] - x[j] * y[i] }
        if (m > 0) { rings++; area += a / 2; holes += a < 0 }
        m = 0
    }
    /^(slice|ring|end)/ { finish() }
    /^(slice|end)/ { if (z != "") print z, rings, holes, area, xmax, ymax; z = $2; rings = holes = area = xmax = ymax = 0 }
    /^[-0-9]/ { x[m] = $1; y[m++] = $2; if ($1 > xmax) xmax = $1; if ($2 > ymax) ymax = $2 }' $solid.loft >$solid.slices
done

awk '$1 != 0.25 + 0.5 * (NR - 1) { bad = 1 } END { exit bad || NR != 28 }' angle.slices
ok $? "the angle has 28 slices, in the middles of its layers, in millimetres"

awk '$1 < 4 && !($2 == 2 && $3 == 1) || $1 > 4 && !($2 == 1 && $3 == 0) { bad = 1 } END { exit bad }' angle.slices
ok $? "the window is a hole in the plate, and none is in the wall"

awk '{ d = $4 - ($1 < 4 ? 550 : 120) } d < -.01 || d > .01 { bad = 1 } END { exit bad }' angle.slices
ok $? "the slices of the angle have the areas of plate and wall"

awk '{ d = $5 - 30; e = $6 - 20 } d * d + e * e > 1e-6 { bad = 1 } END { exit bad }' angle.slices
ok $? "the angle is as wide and deep as it was"

# The wall stands at y from 16 to 20: a mirrored drawing would have it at 0 to 4.
awk '/^slice/ { z = $2 } /^[-0-9]/ && z > 4 && $2 < 15.99 { bad = 1 } END { exit bad }' angle.loft
ok $? "the wall stands on the far side: nothing is mirrored"

awk '$1 != 0.25 + 0.5 * (NR - 1) || !($2 == 2 && $3 == 1) { bad = 1 } END { exit bad || NR != 16 }' torus.slices
ok $? "each of the 16 slices of the torus has one hole"

# The chord of the tube at height z - 4 has length 2 c; the ring between 10 - c and 10 + c has area 40 pi c.
awk '{ c = sqrt(16 - ($1 - 4) ^ 2); d = $4 / (40 * 3.14159265 * c) - 1 }
     d < -.02 || d > .02 { bad = 1; print "# z " $1 ": " d } END { exit bad }' torus.slices
ok $? "the slices of the torus have the area of its rings, within 2 %"
