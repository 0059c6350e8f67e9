# folder.sh - one file a stack: names that stay inside, the index, failures that stop no others.
. "$srcdir/tests/tap.sh"

block plain | sed '$d' >many.loft
for name in '../../x' '/etc/passwd' '-rf' '.' '..' '' 'a\nb' '\x1b[31mred' 'plain' 'sp ace' 'Ni\xc3\xa8re' '%s%n' '"quote\\' '2-plain'; do
    name=$(printf '%s' "$name" | sed 's/\\\\/\\\\\\\\/; s/^"/\\"/')
    printf 'stack "%s"\nnumber 7\nslice 0\nring\n0 0\n9 0\n9 9\nslice 1\nring\n0 0\n9 0\n9 9\n' "$name"
done >>many.loft
long=$(awk 'BEGIN { for (k = 0; k < 300; k++) printf "L" }')
printf 'stack "%s"\nnumber -3\ncolor 255 128 0\nslice 0\nring\n0 0\n9 0\n9 9\nslice 1\nring\n0 0\n9 0\n9 9\n' "$long" >>many.loft
printf 'stack "empty"\nslice 0\nend\n' >>many.loft
mkdir inside
touch out err holds.out before after
find . | sort >before

exits 0 "names of all kinds" "$ISOLOFT" many.loft -o inside/out/ -t ply
find . | grep -v '^\./inside/out' | sort >after
holds "leave everything else alone" cmp before after
ls -A inside/out >names
holds "each has a file, and there is an index" test "$(wc -l <names)" -eq 17
holds "names are safe" sh -c '! grep -v -x -e index.json -e "[0-9]\{4\}\(-[A-Za-z0-9_-]*\)\?\.ply" names'
for file in 0001-plain.ply 0007-______x.ply 0007-2-_etc_passwd.ply 0007-3--rf.ply 0007-6.ply 0007-10-sp_ace.ply; do
    holds "$file" grep -q -x -e "$file" names
done
holds "names are cut to 64 bytes" grep -q -x "0016-L\{64\}.ply" names
for file in inside/out/*.ply; do
    "$ISOLOFT" check "$file" >/dev/null || echo "$file"
done >unsound
holds "every file is whole" test ! -s unsound
if command -v jq >/dev/null; then
    holds "the index is JSON" jq -e . inside/out/index.json
    holds "with an entry a stack" sh -c 'jq -e ".stacks | length == 17" inside/out/index.json'
    holds "with the names as they are" sh -c 'jq -r ".stacks[].name" inside/out/index.json | grep -q "^Nière$"'
    holds "with numbers and colours" sh -c 'jq -e ".stacks[15] | .number == -3 and .colour == [255, 128, 0]" inside/out/index.json'
    holds "with what had nothing to write" sh -c \
        'jq -e ".stacks[16] | .file == null and .status == \"empty\" and .number == null" inside/out/index.json'
    jq -r '.stacks[].file | values' inside/out/index.json | sort >listed
    holds "and the files that are there" sh -c 'grep -v index.json names | LC_ALL=C sort | cmp - listed'
else
    skip "the index is JSON" "no jq"
fi
holds "no control character in the index" sh -c 'tr -d "\n" <inside/out/index.json | LC_ALL=C grep -q "[[:cntrl:]]" && exit 1 || exit 0'

mkdir there
exits 0 "a folder that is there needs no slash" "$ISOLOFT" "$vase" -o there
holds "and gets binary STL" test -s there/0001-vase.stl
exits 0 "ASCII formats have the extension of their kind" "$ISOLOFT" "$vase" -o there/ -t ply-ascii
holds "in the name" test -s there/0001-vase.ply
exits 0 "read writes into folders too" "$ISOLOFT" read many.loft -o streams/
holds "streams that are whole" sh -c 'for f in streams/*.loft; do "$ISOLOFT" check "$f" >/dev/null || exit 1; done'
holds "one a stack, also without contours" test "$(find streams -name '*.loft' | wc -l)" -eq 17
exits 0 "so does convert, OBJ with its colours" "$ISOLOFT" many.loft -o colours/ -t obj
holds "beside it" sh -c 'ls colours | grep -c "mtl$" | grep -qx 1'

# ---- many stacks ---------------------------------------------------------------

{
    printf 'isoloft 1\nunit mm\n'
    awk 'BEGIN { for (k = 0; k < 3000; k++) print "stack \"s\"\nslice 0\nring\n0 0\n0 0\n9 0\n9 9\nslice 1\nring\n0 0\n9 0\n9 9"
        print "end" }'
} >thousands.loft
exits 0 "three thousand stacks of one name and no number" "$ISOLOFT" read thousands.loft -o thousands/
holds "have three thousand files" test "$(find thousands -name '*.loft' | wc -l)" -eq 3000
holds "and do not fill the screen" test "$(wc -l <err)" -le 12

# ---- one bad stack does not stop the others ------------------------------------

block good | sed '$d' >bad.loft
printf 'stack "single"\nslice 0\nring\n0 0\n9 0\n9 9\n' >>bad.loft
block last | sed 1,2d >>bad.loft
exits 3 "a stack that fails gives its code" "$ISOLOFT" bad.loft -o bad/ --json=bad.json
holds "and its reason" grep -q "single" err
holds "the others are written" sh -c '[ "$(ls -A bad | tr "\n" " ")" = "0001-good.stl 0003-last.stl index.json " ]'
holds "the index says so" grep -q '"file":null,"number":null,"name":"single","colour":null,"status":"failed"' bad/index.json
holds "the account too" grep -q '"name":"single".*"status":3.*"name":"last".*"status":0' bad.json
exits 3 "without a folder nothing is written" "$ISOLOFT" bad.loft -o bad.stl
holds "at all" test ! -e bad.stl
sed '$d' bad.loft >cut.loft
exits 3 "a stream that is cut" "$ISOLOFT" cut.loft -o cut/
holds "leaves the stacks that were whole, and an index" sh -c '[ "$(ls -A cut | tr "\n" " ")" = "0001-good.stl index.json " ]'
printf 'isoloft 1\nunit mm\nstack "r"\nslice 0\nring\n0 0\n0 0\n9 0\n9 9\nslice 1\nring\n0 0\n9 0\n9 9\n' >strict.loft
block clean | sed 1,2d >>strict.loft
exits 3 "--strict fails stack by stack" "$ISOLOFT" strict.loft --strict -o strict/
holds "so that clean ones are written" sh -c '[ "$(ls -A strict | tr "\n" " ")" = "0002-clean.stl index.json " ]'
exits 3 "in read as well" "$ISOLOFT" read strict.loft --strict -o strict-read/
holds "so that clean ones are written" sh -c '[ "$(ls -A strict-read | tr "\n" " ")" = "0002-clean.loft index.json " ]'

plan
