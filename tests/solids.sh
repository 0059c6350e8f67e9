# solids.sh - what the checks on sliced solids have in common: sourced, not run.
#
# Wants SOLIDS and SCORE, and PLANES, ROTATIONS, NAMES and JOBS as they may be set; without
# the first two it says so and ends the check.  Gives $isoloft, the folder $dir, $planes, and
# check_solids, which calls check_case FOLDER NAME ROTATION PLANES of the script for each cut
# of each solid in each position: solid.off lies in the folder, rows go to standard output,
# files FOLDER.* stay until the end, false is a failure.

isoloft=${ISOLOFT:-$(pwd)/isoloft}
planes=${PLANES:-10 20 40 80}
rotations=${ROTATIONS:-3}
jobs=${JOBS:-1}
LC_ALL=C # numbers with points, for awk and sort
export LC_ALL

if [ -z "$SOLIDS" ] || [ -z "$SCORE" ]; then
    echo "SOLIDS and SCORE name no folders: solids not checked"
    echo "0 passed, 0 failed, 1 skipped"
    exit 0
fi

dir=$(mktemp -d "${TMPDIR:-/tmp}/isoloft-solids.XXXXXX") || exit 1
trap 'rm -rf "$dir"' EXIT
trap 'exit 1' HUP INT TERM

build_slicer() { ${CXX:-g++} -O2 -w -o "$dir/slice_mesh" "$SCORE/slice_mesh.cpp"; }

# An OFF on stdin, turned by rotation R: 0 none, else a quaternion of small
# whole numbers that R picks.
turn() { # R
    awk -v r="$1" '
        function pick(i) { return (r * (2 + 3 * i) * 17 + 5 * i + 3) % 23 - 11 }
        BEGIN {
            a = r ? pick(0) : 1; b = r ? pick(1) : 0; c = r ? pick(2) : 0; d = r ? pick(3) : 0
            if (a == 0 && b == 0 && c == 0 && d == 0) a = b = 1
            n = a * a + b * b + c * c + d * d
        }
        { sub(/#.*/, "") }
        NF == 0 || (!counted && $1 == "OFF" && NF == 1) { next }
        !counted { counted = 1; vertices = $1; print "OFF"; print; next }
        seen < vertices && r > 0 {
            seen++
            x = $1; y = $2; z = $3
            printf "%.17g %.17g %.17g\n",
                ((a*a + b*b - c*c - d*d) * x + 2 * (b*c - a*d) * y + 2 * (b*d + a*c) * z) / n,
                (2 * (b*c + a*d) * x + (a*a - b*b + c*c - d*d) * y + 2 * (c*d - a*b) * z) / n,
                (2 * (b*d - a*c) * x + 2 * (c*d + a*b) * y + (a*a - b*b - c*c + d*d) * z) / n
            next
        }
        { print }'
}

# Contours on stdin as native text; the stack has no name, as in the SVG.
native() {
    awk 'BEGIN { print "isoloft 1\nunit mm\nstack \"\"" }
         left == 0 { if (NR == 1 || $1 != z) print "slice " $1; z = $1; left = $2; print "ring"; next }
         { print; left-- }
         END { print "end" }'
}

field() { sed -n "s/.*[{,] *\"$2\": *\([^,}]*\).*/\1/p" "$1" 2>/dev/null | head -n 1; }

# A folder's solid.off -> in.contours, in.svg, in.loft, slice.json; why not in err.
slice() { # FOLDER PLANES
    "$dir/slice_mesh" "$1/solid.off" "$2" "$1/in.contours" "$1/in.svg" >"$1/slice.json" 2>"$1/err" &&
        native <"$1/in.contours" >"$1/in.loft"
}

# ---- all of them ----------------------------------------------------------------

check_solid() { # NAME ROTATION: rows to a file of its own, with its counts at the end
    t=$dir/$1.$2
    mkdir "$t"
    good=0 bad=0
    gzip -dc "$SOLIDS/$1.off.gz" | turn "$2" >"$t/solid.off"
    for n in $planes; do
        if check_case "$t" "$1" "$2" "$n"; then good=$((good + 1)); else bad=$((bad + 1)); fi
    done >"$t.rows"
    cat "$t.rows"
    echo "$good $bad" >"$t.count"
    rm -rf "$t"
}

check_solids() {
    names=$NAMES
    [ -n "$names" ] || names=$(cd "$SOLIDS" && ls | sed -n 's/\.off\.gz$//p')
    running=0
    for name in $names; do
        for rotation in $(awk -v n="$rotations" 'BEGIN { for (i = 0; i <= n; i++) print i }'); do
            check_solid "$name" "$rotation" &
            running=$((running + 1))
            if [ "$running" -ge "$jobs" ]; then wait; running=0; fi
        done
    done
    wait
}

# The last line; false when something failed, or nothing was done.
tell_counts() {
    cat "$dir"/*.count | awk '
        { p += $1; f += $2 }
        END { print p + 0 " passed, " f + 0 " failed, 0 skipped"; exit f > 0 || p == 0 }'
}
