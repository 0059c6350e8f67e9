# rt-names.sh - ROI names of all kinds: files stay in their folder, formats stay whole, terminals quiet.
. "$srcdir/tests/tap.sh"
. "$srcdir/tests/rt-dump.sh"

# Every name as a file may have it; a line end and other controls have no place in
# DICOM's names, but files have them.
long=$(awk 'BEGIN { for (k = 0; k < 300; k++) printf "L" }')
escape=$(printf 'a\033[31mred\033]0;title\007')
dump_begin
number=0
for name in '../../etc/x' '-rf' con 'a/b' "$long" "$(printf 'two\nlines')" "$(printf 'a\ttab')" "$escape" \
    "$(printf 'bad\377\376bytes')" twice twice '' "$(printf 'c1\302\233x')" "$(printf 'left\342\200\256right')" '.' '..' \
    '%s%n' '"quoted"' 'back\slash' '[brackets] # 3, 1 x' '#comment' '=COLOR' 'g v f' '肺' 'end_header' '$(touch pwned)'; do
    number=$((number + 1))
    roi $number "$name" "$number\\0\\255" ORGAN
    square 0 10 $((20 * number))
    square 3 10 $((20 * number))
done >/dev/null
dump_end >names.txt
last=$number

# The same numbers again, from another file.
dump_begin
roi 2 -rf; square 0 5; square 3 5
roi 3 other; square 0 5 10; square 3 5 10
dump_end >again.txt

mkdir inside
touch out err holds.out before after control names unsound check.out
find . | sort >before
quiet() { ! LC_ALL=C tr -d '\n' <"$1" | LC_ALL=C grep -q '[[:cntrl:]]'; }  # FILE has no control characters
no_c1() { ! LC_ALL=C grep -q "$(printf '\302[\200-\237]')" "$1"; }

for format in stl stl-ascii obj ply ply-ascii loft; do
    exits 0 "$format in a folder" "$ISOLOFT" names.txt again.txt -o inside/$format/ -t $format -v
    holds "says nothing that a terminal obeys" sh -c '! LC_ALL=C tr -d "\n" <err | LC_ALL=C grep -q "[[:cntrl:]]"'
    find inside/$format -type f ! -name '*.mtl' -exec basename {} \; >names
    holds "writes a file for each, and the index" test "$(wc -l <names)" -eq $((last + 3))
    holds "under names that are safe" sh -c '! grep -v -x -e index.json -e "[0-9]\{4\}\(-[A-Za-z0-9_-]*\)\?\.[a-z]*" names'
    for file in inside/$format/0*; do
        case $file in *.mtl) continue ;; esac
        "$ISOLOFT" check "$file" >check.out 2>&1 || echo "$file: $(head -n 3 check.out)"
    done >unsound
    holds "each of them whole" test ! -s unsound
    case $format in stl | ply) continue ;; esac
    for file in inside/$format/*; do
        quiet "$file" && no_c1 "$file" || echo "$file"
    done >control
    holds "without control characters" test ! -s control
done
find . | grep -v '^\./inside/' | sort >after
holds "nothing outside of the folder has changed" cmp before after
holds "no name was run" test ! -e pwned
for file in 0001-______etc_x 0002--rf 0002-2--rf 0003-con 0003-2-other 0004-a_b 0010-twice 0011-twice 0012; do
    holds "$file" test -s inside/stl/$file.stl
done
holds "long names are cut" test -s "inside/stl/0005-$(printf '%.64s' "$long").stl"

for format in stl stl-ascii obj ply ply-ascii; do
    exits 0 "all in one $format" "$ISOLOFT" names.txt -o all.$format -t $format
    holds "is sound" "$ISOLOFT" check all.$format
    "$ISOLOFT" check all.$format --json >all.json
    holds "and has all of them" grep -q "\"components\":$last," all.json
done
for file in all.stl-ascii all.obj all.ply-ascii all.mtl; do
    [ ! -e $file ] || { quiet $file && no_c1 $file; } || echo $file
done >control
holds "without control characters" test ! -s control
holds "each solid has a name of its own" sh -c '[ "$(grep "^solid" all.stl-ascii | sort -u | wc -l)" -eq '$last' ]'

exits 0 "a native stream of them" "$ISOLOFT" read names.txt -o all.loft
exits 0 "is sound" "$ISOLOFT" check all.loft
holds "without control characters" quiet all.loft
"$ISOLOFT" read all.loft | cmp -s - all.loft
holds "and read back it is the same" test $? -eq 0
if command -v jq >/dev/null; then
    "$ISOLOFT" --list --json names.txt | jq -c '[.stacks[] | [.name, .number, .colour, .type]]' >a
    "$ISOLOFT" --list --json all.loft | jq -c '[.stacks[] | [.name, .number, .colour, .type]]' >b
    holds "with the names as they are" cmp a b
    holds "line ends and all" jq -e '.[5][0] == "two\nlines" and .[0][0] == "../../etc/x" and .[18][0] == "back\\slash"' a
    jq -c '[.stacks[] | [.name, .number]]' inside/ply/index.json >b
    { "$ISOLOFT" --list --json names.txt again.txt | jq -c '[.stacks[] | [.name, .number]]'; } >a
    holds "the index has them too" cmp a b
    holds "with a file each" jq -e '[.stacks[].file] | unique | length == '$((last + 2)) inside/ply/index.json
else
    skip "with the names as they are" "no jq"
fi

for command in --list info 'info --json' '--list --json' '--roi no-such' '-v -o x.stl' '--progress=always -o x.stl' 'plot'; do
    # shellcheck disable=SC2086 # words of a line
    case $command in
    plot) "$ISOLOFT" plot all.loft >out 2>err ;;
    *) "$ISOLOFT" $command names.txt >out 2>err ;;
    esac
    tr '\r' '\n' <err >err.lines # progress wipes its line
    holds "$command: nothing that a terminal obeys" sh -c 'cat out err.lines | LC_ALL=C tr -d "\n" | LC_ALL=C grep -q "[[:cntrl:]]" && exit 1 || exit 0'
    cat out err >both
    holds "$command: no C1 controls either" no_c1 both
done
"$ISOLOFT" --list names.txt >out
holds "a line an ROI" test "$(wc -l <out)" -eq $((last + 1))

# What names the character set is looked through for every name; 10 MB of it must not be.
dump_begin
for k in 1 2 3 4 5 6 7 8 9 10; do roi_named $k "name $k"; done
dump_end | awk '/^.0008,0005/ { set = "ISO_IR 100"; for (k = 0; k < 20; k++) set = set "\\" set; print "(0008,0005) CS [" set "]  # 2, 1 x"; next }
    /^.3006,0026/ { for (k = 0; k < 300; k++) print }
    { print }' >charset.txt
seconds=$("$ISOLOFT" --list --json charset.txt | sed -n 's/.*"seconds":\([0-9]*\).*/\1/p')
holds "a long character set costs nothing for each name" test "${seconds:-99}" -lt 20

plan
