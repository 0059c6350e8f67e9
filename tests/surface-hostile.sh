# surface-hostile.sh - maps that mean harm: each makes a mesh, or is refused in one line, soon.
. "$srcdir/tests/tap.sh"

# The map on standard input as a terrain: LEVELS in its lines are "level Z", "line" and
# "ring", points, and "square X Y R".
terrain() {
    awk 'BEGIN { print "isoloft 1\nunit m\nstack \"map\"\nkind terrain" }
        $1 == "level" { print "slice", $2; next }
        $1 == "square" {
            printf "ring\n%.17g %.17g\n%.17g %.17g\n", $2 - $4, $3 - $4, $2 + $4, $3 - $4
            printf "%.17g %.17g\n%.17g %.17g\n", $2 + $4, $3 + $4, $2 - $4, $3 + $4
            next
        }
        { print }
        END { print "end" }'
}

# A pyramid of three squares about (X, Y), R wide, at three heights.
pyramid() { # X Y R Z0 Z1 Z2
    awk -v x="$1" -v y="$2" -v r="$3" -v a="$4" -v b="$5" -v c="$6" 'BEGIN {
        printf "level %s\nsquare %.17g %.17g %.17g\nlevel %s\nsquare %.17g %.17g %.17g\nlevel %s\nsquare %.17g %.17g %.17g\n",
            a, x, y, r, b, x, y, r / 2, c, x, y, r / 9 }' | terrain
}

# COMMAND... ends with $1, in one line if it is refused, and within 60 seconds of a processor.
ends() { # CODE SENTENCE COMMAND...
    code=$1 sentence=$2
    shift 2
    if sanitized; then limit=unlimited; else limit=60; fi
    rm -f box.*
    sh -c 'ulimit -t "$1"; shift; exec "$@"' - "$limit" "$@" >out 2>err
    status=$?
    if [ $status -ne "$code" ]; then
        case_bad "$sentence" "$* exits $status, not $code" "$(head -n 5 err | cut -c 1-200)"
    elif [ $status -ne 0 ] && ! one_error; then
        case_bad "$sentence" "not one line: $(head -n 3 err | cut -c 1-200)"
    elif [ $status -eq 0 ] && [ -f box.stl ] && ! "$ISOLOFT" check box.stl >out 2>&1; then
        case_bad "$sentence" "not sound: $(head -n 3 out)"
    else
        case_ok "$sentence"
    fi
}

# ---- numbers ---------------------------------------------------------------------

pyramid 0 0 9e14 0 10 20 >huge.loft
ends 0 "a map almost as large as numbers may be" "$ISOLOFT" huge.loft -o box.ply
ends 0 "and a model of it" "$ISOLOFT" huge.loft --solid --fit 150mm -o box.stl
pyramid 9e14 9e14 9 0 10 20 >far.loft
ends 0 "a map at the end of the world" "$ISOLOFT" far.loft --solid -o box.stl
pyramid 0 0 9e-300 0 10 20 >small.loft
ends 3 "a map smaller than squares of numbers" "$ISOLOFT" small.loft -o box.ply
pyramid 0 0 9 100 100.00000000000001 100.00000000000003 >ulp.loft
ends 0 "heights a last bit apart" "$ISOLOFT" ulp.loft --solid -o box.stl
pyramid 0 0 9 -9e14 0 9e14 >tall.loft
ends 3 "heights whose domes leave the numbers" "$ISOLOFT" tall.loft -o box.ply
ends 0 "which a scale brings back" "$ISOLOFT" tall.loft --z-scale 1e-12 -o box.ply
pyramid 0 0 9 0 10 20 >hill.loft
for scale in 1e300 0 nan -1; do
    ends 2 "heights $scale times as high" "$ISOLOFT" hill.loft --z-scale $scale -o box.ply
done
ends 3 "heights so many times as high that they leave the numbers" "$ISOLOFT" hill.loft --z-scale 9e14 -o box.ply
ends 0 "heights next to none" "$ISOLOFT" hill.loft --z-scale 1e-300 --solid -o box.stl
ends 2 "a model of no length" "$ISOLOFT" hill.loft --fit 0 -o box.stl
ends 2 "and one beyond numbers" "$ISOLOFT" hill.loft --fit 1e300 -o box.stl
ends 3 "a model smaller than 32-bit floats" "$ISOLOFT" hill.loft --fit 1e-300 -o box.stl
ends 3 "a floor above the ground" "$ISOLOFT" hill.loft --solid --base 300 -o box.stl
ends 3 "a floor in it" "$ISOLOFT" hill.loft --solid --base 0 -o box.stl
ends 0 "a floor far below it" "$ISOLOFT" hill.loft --solid --base -9e14 -o box.stl
ends 2 "a floor beyond numbers" "$ISOLOFT" hill.loft --solid --base -1e15 -o box.stl

# ---- maps that are none ----------------------------------------------------------

printf 'level 0\nline\n0 0\n0 9\nlevel 10\nline\n0 1\n0 5\n' | terrain >flat.loft
ends 3 "a map without a width" "$ISOLOFT" flat.loft -o box.ply
for width in 1e-9 3e-8; do
    awk -v w=$width 'BEGIN { printf "level 0\nring\n0.1 0.1\n3.3 3.3\n7.7 %.17g\n1.3 %.17g\n", 7.7 + w, 1.3 + w
        printf "level 5\nring\n0.3 %.17g\n3 3\n2 %.17g\n", 0.3 + w / 9, 2 + w / 20 }' | terrain >thin.loft
    ends 3 "or with one of $width, in 32-bit floats" "$ISOLOFT" thin.loft --frame hull -o box.stl
done
printf 'level 0\nline\n0 0\n9 0\nlevel 10\nline\n9 0\n9 9\nlevel 20\nline\n9 9\n0 9\nlevel 30\nline\n0 9\n0 0\n' | terrain >edge.loft
ends 3 "lines that all lie on the edge of the map" "$ISOLOFT" edge.loft -o box.ply
printf 'level 0\nline\n0 0\n9 9\nlevel 10\nline\n0 9\n9 0\nlevel 20\nline\n0 4\n9 4\n' | terrain >cross.loft
"$ISOLOFT" cross.loft -o box.ply >out 2>err
holds "lines that all cross in a point make a map or are refused" test $? -eq 0 -o $? -eq 3
awk 'BEGIN { for (l = 0; l < 2; l++) { print "level", 10 * l "\nline"
    for (k = 0; k < 20000; k++) printf "%.9g %.9g\n", (k + 1500 * l) * cos(k / 500), (k + 1500 * l) * sin(k / 500) } }' |
    terrain >spiral.loft
ends 3 "two spirals that end inside the map" "$ISOLOFT" spiral.loft -o box.ply
holds "for want of lines" grep -q 'no isoline tells the height of the ground' err
awk 'BEGIN {
    srand(5)
    for (l = 0; l < 20; l++) { print "level", l "\nring"; for (k = 0; k < 40; k++) printf "%.6f %.6f\n", rand(), rand() } }' |
    terrain >tangle.loft
"$ISOLOFT" tangle.loft -o box.ply >out 2>err
status=$?
holds "a tangle of twenty heights makes a map or is refused" test $status -eq 0 -o $status -eq 3

# ---- many of them ------------------------------------------------------------------

awk 'BEGIN {
    print "level 0\nsquare 100 100 150\nlevel 10"
    for (k = 0; k < 40000; k++) print "square", k % 200 + 0.5, int(k / 200) + 0.5, 0.3 }' |
    terrain >rings.loft
ends 0 "40000 tiny hills" "$ISOLOFT" rings.loft -o box.ply
awk 'BEGIN {
    print "level 0\nline"
    for (k = 0; k < 300000; k++) print k, k; print "level 10\nline\n0 10\n299989 299999" }' | terrain >straight.loft
ends 0 "a straight line of 300000 points" "$ISOLOFT" straight.loft -o box.ply
awk 'BEGIN { for (k = 0; k < 2000; k++) { print "level", k; print "square 0 0", 2001 - k } }' | terrain >nested.loft
ends 0 "2000 rings in each other" "$ISOLOFT" nested.loft --solid -o box.stl
awk 'BEGIN { for (k = 0; k < 4000; k++) { print "level", k "\nline\n0", k "\n1000", k } }' | terrain >steps.loft
ends 0 "4000 levels from edge to edge" "$ISOLOFT" steps.loft -o box.ply
awk 'BEGIN {
    print "level 0\nsquare 0 0 1000"
    for (k = 1; k < 1000; k++) print "level", k "\nsquare 5000 5000", 1001 - k; print "level 1000\nsquare 0 0 10" }' |
    terrain >missing.loft
ends 0 "a summit 999 levels above the ground around it" "$ISOLOFT" missing.loft -o box.ply
plan
