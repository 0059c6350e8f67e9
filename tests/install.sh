# install.sh - what `make install` leaves serves: the program, its manual, the library in another program.
# TAP.  With sanitizers the other program needs them too, so they are passed on.

. "$srcdir/tests/tap.sh"

result() { # STATUS SENTENCE: 0 is ok
    if [ "$1" -eq 0 ]; then case_ok "$2"; else case_bad "$2" "$(tail -n 20 log)"; fi
}

remade() { # TARGET: by the build that is being tested
    env -u MAKEFLAGS -u MAKELEVEL -u MFLAGS make -s -C "$builddir" --no-print-directory "$1" DESTDIR="$root"
}

root=$TMPDIR/root
: ${CC:=cc} ${CXX:=c++}

remade install >log 2>&1
result $? "make install works"

program=$(find "$root" -type f -name isoloft -perm -100)
(cd / && "$program" --version) >version 2>>log && "$ISOLOFT" --version | cmp -s - version
result $? "the installed program runs"

for page in man1/isoloft.1 man5/isoloft.5 man7/isoloft-isolines.7; do
    [ -n "$(find "$root" -path "*/$page")" ] || echo "$page is not installed"
done >log
[ ! -s log ]
result $? "all manual pages are installed"

for file in $(sed -n 's/^\.Pa \([a-z.-]*\.\(txt\|schema\.json\)\)\( .*\)\{0,1\}$/\1/p' "$srcdir"/man/isoloft*); do
    [ -n "$(find "$root" -path "*/doc/isoloft/$file")" ] || echo "$file is not installed"
done >log
[ ! -s log ]
result $? "so is what they name"

found=$(find "$root" -name '*.h' | sed 's/.*\///')
[ "$found" = isoloft.h ]
result $? "isoloft.h is the only header installed"

if command -v xmllint >/dev/null; then
    xmllint --noout "$(find "$root" -path '*/mime/packages/isoloft.xml')" >log 2>&1
    result $? "the media type's entry is well-formed"
else
    skip "the media type's entry is well-formed" "xmllint is not installed"
fi

cp "$srcdir/examples/embed.c" embed.c
if command -v pkg-config >/dev/null; then
    PKG_CONFIG_PATH=$(dirname "$(find "$root" -name isoloft.pc)")${PKG_CONFIG_PATH:+:$PKG_CONFIG_PATH}
    PKG_CONFIG_SYSROOT_DIR=$root
    export PKG_CONFIG_PATH PKG_CONFIG_SYSROOT_DIR
    cflags=$(pkg-config --cflags isoloft 2>log) && libs=$(pkg-config --libs isoloft 2>>log)
    result $? "pkg-config knows how to build with isoloft"
    # The libraries that isoloft needs are the system's, not the installation's.
    cflags=$(echo "$cflags" | sed "s|-I$root/usr/include/libxml2||")

    $CC -std=c99 -pedantic -Wall -Wextra -Werror ${IL_SANITIZE-} $cflags -c embed.c -o embed.o >log 2>&1
    result $? "the example is plain C with no warning"
    linker=$CC
    [ -z "${IL_SANITIZE-}" ] || linker=$CXX # the sanitizers of C++ are not in C's library
    $linker ${IL_SANITIZE-} embed.o -o embed $libs >log 2>&1
    result $? "the example links"
else
    for what in "pkg-config knows how to build with isoloft" "the example is plain C with no warning" "the example links"; do
        skip "$what" "pkg-config is not installed"
    done
fi

if [ -x embed ]; then
    ./embed vase.stl >said 2>log && grep -q '^2340 vertices, 4676 triangles, 81897 mm3, genus 0$' said &&
        "$ISOLOFT" check -q vase.stl >>log 2>&1
    result $? "the example makes a sound mesh"
else
    skip "the example makes a sound mesh" "it was not built"
fi

printf '#include <isoloft.h>\nint main() { il_solids s = IL_SOLIDS_INIT; il_solids_free(&s); return 0; }\n' >plus.cpp
$CXX -std=c++11 -pedantic -Wall -Wextra -Werror -I"$srcdir/src" -fsyntax-only plus.cpp >log 2>&1
result $? "C++ takes the header"

remade uninstall >log 2>&1 && [ -z "$(find "$root" -type f)" ]
result $? "make uninstall leaves no file"

plan
