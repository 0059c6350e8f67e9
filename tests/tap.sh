# tap.sh - what the shell tests share; sourced: . "$srcdir/tests/tap.sh"
# Cases are sentences that hold.  The tests work in $TMPDIR/work and end with `plan`.

n=0
vase=$srcdir/examples/vase.loft
vase_svg=$srcdir/examples/vase.svg
mkdir "$TMPDIR/work" && cd "$TMPDIR/work" || exit 1

case_ok() { n=$((n + 1)); echo "ok $n - $1"; }
case_bad() { # SENTENCE WHY...
    n=$((n + 1))
    echo "not ok $n - $1"
    shift
    printf '%s\n' "$@" | sed 's/^/# /' | cut -c 1-300
}
skip() { n=$((n + 1)); echo "ok $n - $1 # SKIP $2"; }
plan() { echo "1..$n"; }

holds() { # SENTENCE COMMAND...: it succeeds
    sentence=$1
    shift
    if "$@" >holds.out 2>&1; then
        case_ok "$sentence"
    else
        case_bad "$sentence" "$* gave $?" "$(head -n 5 holds.out)"
    fi
}

exits() { # CODE SENTENCE COMMAND...: with that code, and its words in ./out and ./err
    code=$1 sentence=$2
    shift 2
    "$@" >out 2>err
    status=$?
    if [ $status -eq "$code" ]; then
        case_ok "$sentence"
    else
        case_bad "$sentence" "$* exits $status, not $code" "$(head -n 5 err)"
    fi
}

# One line of words on standard error, as errors have it.
one_error() { [ "$(wc -l <err)" -eq 1 ] && grep -q "^isoloft: " err; }

# Three slices of a block with a hole, named $1.
block() {
    awk -v name="$1" 'BEGIN {
        print "isoloft 1\nunit mm\nstack \"" name "\""
        for (z = 0; z < 3; z++)
            print "slice", z, "\nring\n0 0\n9 0\n9 9\n0 9\nring\n3 3\n3 6\n6 6\n6 3"
        print "end" }'
}

# A round pillar of $1 slices with $2 vertices each.
pillar() {
    awk -v slices="$1" -v n="$2" 'BEGIN {
        print "isoloft 1\nunit mm\nstack \"pillar\""
        for (z = 0; z < slices; z++) {
            printf "slice %d\nring\n", z
            for (k = 0; k < n; k++) {
                t = 6.283185307179586 * k / n
                printf "%.6f %.6f\n", (9 + sin(3 * t + z / 9)) * cos(t), (9 + sin(3 * t + z / 9)) * sin(t)
            }
        }
        print "end" }'
}

sanitized() { grep -q '^#define IL_SANITIZED 1' "$builddir/config.h"; }
