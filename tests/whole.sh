# whole.sh - output arrives whole or not at all; the same input gives the same bytes.
. "$srcdir/tests/tap.sh"

"$ISOLOFT" "$vase" -t ply >vase.ply
"$ISOLOFT" read "$vase" >vase.read

# ---- full disks, closed outputs, closed pipes ----------------------------------

if [ -w /dev/full ]; then
    for verb in convert read plot; do
        exits 4 "$verb: a full disk on standard output" sh -c '"$ISOLOFT" $1 "$2" >/dev/full' - $verb "$vase"
        holds "is told in one line" one_error
        exits 4 "$verb: a full disk on -o" "$ISOLOFT" $verb "$vase" -o /dev/full
        holds "is told in one line" one_error
    done
    for words in "info $vase" --help --version --formats "check vase.ply" "read --help"; do
        exits 4 "a full disk: isoloft $(echo "$words" | cut -c 1-10)" sh -c '"$ISOLOFT" $1 >/dev/full' - "$words"
    done
    exits 4 "a full disk on --pairs" "$ISOLOFT" "$vase" -o p.ply --pairs /dev/full
    exits 4 "a full disk on --json" "$ISOLOFT" "$vase" -o j.ply --json=/dev/full
    exits 4 "a full disk under info --json" sh -c '"$ISOLOFT" info "$1" --json >/dev/full' - "$vase"
else
    skip "full disks" "no /dev/full"
fi
exits 4 "a closed standard output" sh -c '"$ISOLOFT" "$1" >&-' - "$vase"
holds "is told in one line" one_error
exits 4 "a closed standard output of read" sh -c '"$ISOLOFT" read "$1" >&-' - "$vase"
exits 4 "a closed standard output of info" sh -c '"$ISOLOFT" info "$1" >&-' - "$vase"
exits 4 "a closed standard output of --help" sh -c '"$ISOLOFT" --help >&-'
exits 4 "a closed standard input" sh -c '"$ISOLOFT" <&-'
exits 0 "a closed standard output that is not needed" sh -c '"$ISOLOFT" "$1" -o c.ply >&-' - "$vase"
holds "leaves the file whole" cmp c.ply vase.ply
exits 0 "a closed standard error too" sh -c '"$ISOLOFT" "$1" -v -o d.ply 2>&-' - "$vase"
holds "leaves the file whole" cmp d.ply vase.ply

for verb in read convert plot; do
    { sleep 0.2; "$ISOLOFT" $verb "$vase" 2>pipe.err; echo $? >pipe.status; } | :
    holds "$verb: a pipe that nobody reads kills" grep -qx 141 pipe.status
    holds "without a word" test ! -s pipe.err
done
{ sleep 0.2; sh -c 'trap "" PIPE; exec "$ISOLOFT" read "$1"' - "$vase" 2>pipe.err; echo $? >pipe.status; } | :
holds "even when the parent ignored the signal" grep -qx 141 pipe.status

# ---- a failed run leaves things as they were -----------------------------------

head -c 40000 "$vase" >cut.loft
head -c 40000 "$vase_svg" >cut.svg
sed 's/^ring$/rings/' "$vase" >word.loft
mkdir old
untouched() { # SENTENCE: old/ has the old file and nothing else
    holds "$1" sh -c 'echo old | cmp -s - old/file.stl && [ "$(ls -A old)" = file.stl ]'
}
fails() { # CODE SENTENCE COMMAND...
    echo old >old/file.stl
    exits "$@"
    untouched "the old file stands, alone: $2"
}
fails 3 "a stream that was cut" "$ISOLOFT" cut.loft -o old/file.stl
fails 3 "a drawing that was cut" "$ISOLOFT" cut.svg -o old/file.stl
fails 3 "a wrong word" "$ISOLOFT" word.loft -o old/file.stl
fails 3 "nothing to write" "$ISOLOFT" "$vase" --stack none -o old/file.stl
fails 3 "repairs under --strict" sh -c 'printf "isoloft 1\nunit mm\nstack \"a\"\nslice 0\nring\n0 0\n0 0\n1 0\n0 1
slice 1\nring\n0 0\n1 0\n0 1\nend\n" | "$ISOLOFT" --strict -o old/file.stl'
fails 4 "an input that is not there" "$ISOLOFT" no-such-file -o old/file.stl
fails 4 "a folder as input" "$ISOLOFT" old -o old/file.stl
fails 2 "a wrong command line" "$ISOLOFT" "$vase" -o old/file.stl --no-such-option
fails 2 "a picture that is none" "$ISOLOFT" plot "$vase" -o old/file.stl
fails 4 "pairs that have no place" "$ISOLOFT" "$vase" -o old/file.stl --pairs no/such/folder
pillar 60 400 >pillar.loft
fails 4 "a spool that has no place" env TMPDIR=/no/such/folder "$ISOLOFT" pillar.loft -o old/file.stl
fails 4 "a disk that fills" sh -c 'trap "" XFSZ; ulimit -f 100; exec "$ISOLOFT" "$1" -o old/file.stl' - "$vase"
fails 4 "a disk that fills while read writes" \
    sh -c 'trap "" XFSZ; ulimit -f 100; exec "$ISOLOFT" read "$1" -o old/file.stl -t loft' - "$vase"
if [ "$(id -u)" -ne 0 ]; then
    chmod a-w old
    fails 4 "a folder that may not be written" "$ISOLOFT" "$vase" -o old/file.stl
    chmod u+w old
else
    skip "a folder that may not be written" "root may write everywhere"
fi
exits 4 "an output in no folder" "$ISOLOFT" "$vase" -o no/such/folder.stl
exits 4 "a folder in no folder" "$ISOLOFT" "$vase" -o no/such/folder/

mkfifo fifo
cat fifo >from.fifo &
exits 0 "a pipe by name is written in place" "$ISOLOFT" "$vase" -o fifo -t ply
wait
holds "whole" cmp from.fifo vase.ply
ln -s target.ply link.ply
exits 0 "a link stays" "$ISOLOFT" "$vase" -o link.ply
holds "and what it points to is written" sh -c 'test -L link.ply && cmp target.ply vase.ply'

# ---- the same bytes ------------------------------------------------------------

for k in 1 2 3 8; do
    "$ISOLOFT" "$vase_svg" --threads $k -t ply >threads.ply
    holds "$k threads give the same bytes" cmp threads.ply vase.ply
    "$ISOLOFT" "$vase_svg" --threads $k --cap dome -t stl >threads-$k.stl
    holds "$k threads, domed, as STL" cmp threads-1.stl threads-$k.stl
done
dd if="$vase" bs=1 2>/dev/null | "$ISOLOFT" -t ply >slow.ply
holds "native text a byte at a time" cmp slow.ply vase.ply
dd if="$vase_svg" bs=1 2>/dev/null | "$ISOLOFT" -t ply >slow.ply
holds "SVG a byte at a time" cmp slow.ply vase.ply
gzip -c "$vase" | dd bs=1 2>/dev/null | "$ISOLOFT" -t ply >slow.ply
holds "gzip a byte at a time" cmp slow.ply vase.ply
for k in 1 2 3; do "$ISOLOFT" "$vase" -t ply; done >thrice
holds "three runs give the same bytes" sh -c 'cat vase.ply vase.ply vase.ply | cmp - thrice'

comma=$(locale -a 2>/dev/null | grep -i -E '^(de|fr|nl|ru)_..\.?utf' | head -n 1)
if [ -z "$comma" ] && command -v localedef >/dev/null && localedef -i de_DE -f UTF-8 "$PWD/de_DE.UTF-8" 2>/dev/null; then
    LOCPATH=$PWD comma=de_DE.UTF-8
    export LOCPATH
fi
if [ -n "$comma" ]; then
    holds "the locale $comma is one with commas" sh -c 'LC_ALL=$1 locale -k decimal_point | grep -q ,' - "$comma"
    for format in ply-ascii obj stl-ascii loft; do
        "$ISOLOFT" "$vase_svg" -t $format >point
        LC_ALL=$comma "$ISOLOFT" "$vase_svg" -t $format >comma
        holds "a locale with commas changes nothing: $format" cmp point comma
    done
    LC_ALL=$comma "$ISOLOFT" info "$vase" | sed '/^  seconds /d' >comma
    holds "nor what info says" sh -c '"$ISOLOFT" info "$1" | sed "/^  seconds /d" | cmp - comma' - "$vase"
    exits 2 "nor what a number is" env LC_ALL="$comma" "$ISOLOFT" "$vase" --spacing 1,5
else
    skip "a locale with commas changes nothing" "there is none"
fi

plan
