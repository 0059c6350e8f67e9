# usage.sh - the command line: help, what is refused, terminals, the account, the manual.
. "$srcdir/tests/tap.sh"

exits 0 "--help helps" "$ISOLOFT" --help
cp out help
holds "it fits a screen of 80 by 24" awk 'length > 79 || NR > 23 { exit 1 }' help
for verb in convert read match mesh info check plot; do
    holds "$verb is in it" grep -q "$verb" help
    exits 0 "$verb has help of its own" "$ISOLOFT" $verb --help
    holds "no line of which is too long" awk 'length > 79 { exit 1 }' out
    cat out >>all.help
done
"$ISOLOFT" --help read | cmp -s - all.help
"$ISOLOFT" --help read >a
"$ISOLOFT" read --help >b
holds "--help VERB is VERB --help" cmp a b
exits 0 "--version names the version" "$ISOLOFT" --version
holds "in one line" grep -qx "isoloft [0-9.]*" out
exits 0 "--formats lists the formats" "$ISOLOFT" --formats
for format in '-f loft' '-f svg' '-t stl' '-t stl-ascii' '-t obj' '-t ply' '-t ply-ascii' '-t loft'; do
    holds "$format" grep -q -e "^$format " out
done

# Every option that help knows is in the manual, and the other way round.
grep -o -e '--[a-z][-a-z]*' all.help | sort -u >known
grep -o 'Fl Fl [a-z][-a-z]*' "$srcdir/man/isoloft.1" | sed 's/Fl Fl /--/' | sort -u >told
for word in --help --formats --version; do echo $word; done | sort -u - told | grep -v -x -e "--no-.*" >told.all
sort -u known | grep -v -x -e --no- >known.all
holds "help and manual know the same options" diff known.all told.all

for line in "--frame - x" "--gap close x" "--thickness 0 x" "--between 65 x" "--between -1 x" "--between x y" "read --between 4 x" "--matcher x y" "plot x -o y.png" "plot x -t stl" "x -o y.zip" \
    "mesh --spacing 3 x" "-t nonsense x" "x --threads 0" "- -" "--pieces many x" "--pieces" "read --pieces few x" "--links - -" \
    "mesh --links l --matcher none x" "match x -o y --links-out y" "info --links-out l x" "plot --links l x" "--list --links-out l x"; do
    # shellcheck disable=SC2086 # words of a line
    exits 2 "refused: $line" "$ISOLOFT" $line
    holds "in one line" one_error
done

# ---- terminals: script(1) gives one --------------------------------------------

on_terminal() { script -qec "$1" /dev/null; }
if command -v script >/dev/null && on_terminal true >/dev/null 2>&1 </dev/null; then
    printf 'x' | on_terminal "'$ISOLOFT' </dev/tty" >out 2>&1
    holds "without input on a terminal it says how it is called" grep -q "usage: isoloft" out
    exits 2 "and exits 2" script -qec "'$ISOLOFT' </dev/tty" /dev/null
    exits 2 "binary is not written to a terminal" script -qec "'$ISOLOFT' '$vase'" /dev/null
    exits 0 "text is" script -qec "'$ISOLOFT' '$vase' -t obj" /dev/null
    exits 0 "progress shows on a terminal" script -qec "'$ISOLOFT' '$vase' -o x.stl" /dev/null
    holds "as a line that is wiped" sh -c 'grep -q "slices, .* slabs" out'
    exits 0 "and can be told not to" script -qec "'$ISOLOFT' '$vase' -o x.stl --progress=never" /dev/null
    holds "at all" test ! -s out
else
    skip "terminals" "no script(1)"
fi
exits 0 "progress stays away from files" "$ISOLOFT" "$vase" -o x.stl
holds "which stay empty" test ! -s err
exits 0 "unless it is asked for" "$ISOLOFT" "$vase" -o x.stl --progress=always
holds "and then it shows" grep -q "slices" err
printf 'isoloft 1\nunit mm\nstack "a"\nslice 0\nring\n0 0\n' >cut.loft
exits 3 "an error under progress" "$ISOLOFT" cut.loft -o y.stl --progress=always
holds "has a line of its own" sh -c 'tr "\r" "\n" <err | grep -q "^isoloft: cut.loft:"'

# ---- the account ---------------------------------------------------------------

exits 0 "--json is the last line on standard error" "$ISOLOFT" "$vase" -o x.stl --json -v
holds "on one line" sh -c 'tail -n 1 err | grep -q "^{.*}$"'
tail -n 1 err >account
exits 0 "--json=FILE is a file" "$ISOLOFT" "$vase" -o x.stl --json=file.json
holds "with the same in it" sh -c 'sed "s/,\"seconds.*//" account >a; sed "s/,\"seconds.*//" file.json | cmp - a'
exits 0 "info --json goes to standard output" "$ISOLOFT" info "$vase" --json
holds "alone" grep -q "^{.*}$" out
cp out info.json
exits 0 "check --json too" "$ISOLOFT" check x.stl --json
holds "alone" grep -q '^{.*"sound":true.*}$' out
exits 3 "there is an account of failures as well" "$ISOLOFT" cut.loft --json=failed.json
holds "with the reason" grep -q '"status":3,"error":"cut.loft:6: ' failed.json
if command -v jq >/dev/null; then
    holds "accounts are JSON" sh -c 'cat account info.json failed.json out | jq -e . >/dev/null'
    jq -r '.["$defs"].stack.properties | keys[]' "$srcdir/formats/summary.schema.json" | sort >schema
    jq -r '.stacks[0] | keys[]' account | sort >keys
    holds "the schema has the keys of a stack, all of them" cmp schema keys
    jq -r '.["$defs"].stack.properties.repairs.required[]' "$srcdir/formats/summary.schema.json" | sort >schema
    jq -r '.stacks[0].repairs | keys[]' account | sort >keys
    holds "and those of the repairs" cmp schema keys
    jq -e '.stacks[0] | .slices == 33 and .points == 6000 and .genus == 2 and .certified and .slabs.S > 5 * .slabs.B and .slabs.P == 0 and .unpaired == 0' account >/dev/null
    holds "the numbers are right" test $? -eq 0
else
    skip "accounts are JSON" "no jq"
fi

# ---- the manual's examples, as they stand there --------------------------------

cp "$srcdir"/examples/vase.svg "$srcdir"/examples/vase.loft "$srcdir"/examples/phantom.* "$srcdir"/examples/island.geojson .
mkdir bin && ln -s "$ISOLOFT" bin/isoloft
awk '/^\.Sh EXAMPLES/ { on = 1 } /^\.Sh SEE ALSO/ { on = 0 }
     on && /^\.Bd/ { k++; inside = 1; next } /^\.Ed/ { inside = 0 }
     on && inside { gsub(/\\e/, "\\"); print >("example" k) }' "$srcdir/man/isoloft.1"
for example in example? example??; do
    exits 0 "the manual's example runs: $(head -n 1 "$example" | cut -c 1-50)" \
        env PATH="$PWD/bin:$PATH" sh -e "./$example"
done
for file in vase.stl vase.ply vase.obj pairs.loft parts/0001-vase.ply parts/index.json account.json organs/0003-Tube.ply vessel.obj cone.stl pieces.stl plate.stl \
    slices.svg pair.svg vase.links linked.stl; do
    holds "and leaves $file" test -s $file
done
holds "the README's pipe runs" sh -c 'sed -n "s|^    ./isoloft read|isoloft read|p" "$srcdir/README.md" |
    sed "s|examples/||; s|\./||g" >pipe && PATH=$PWD/bin:$PATH sh -e ./pipe && test -s vase.ply'

plan
