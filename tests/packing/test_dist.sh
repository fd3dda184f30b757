#!/bin/sh
# The archive has the sources and nothing else, and builds, installs and packs itself without git.
set -u

. "${HOOKE_SOURCE:?is the directory of the sources}/tests/support/claims.sh"
. "$HOOKE_SOURCE/tests/support/trees.sh"

version=$(sed -n "s/^VERSION = '\(.*\)'$/\1/p" "$HOOKE_SOURCE/wscript")
name=hooke-$version
same "$("$HOOKE_BIN" --version)" "hooke $version" 'the version that the program says'

# As git has it, with things beside the sources that are not to be packed.
copy_tree tree
mkdir -p tree/build tree/.waf-cache
touch tree/build/x tree/.waf-cache/x tree/notes
source_files >sources
sed "s|^|$name/|" sources | LC_ALL=C sort >wanted
packed() {
    must tree dist
    tar -tf "tree/$name.tar.xz" | grep -v '/$' | LC_ALL=C sort >packed
    cmp -s packed wanted || fail "packed: $(diff wanted packed)"
}

# A checkout of which git cannot tell, or of which nothing is tracked, is not packed.
refused() {
    ! in_tree tree dist || fail "packed without git's word"
    grep -q "^$1" waf.log && ! grep -q Traceback waf.log || fail "said instead of '$1': $(cat waf.log)"
}

mkdir tree/.git
refused 'only git knows what of this checkout is to be packed: git: '
rmdir tree/.git
if has git; then
    git -C tree init -q
    refused 'git tracks none of these files'
    git -C tree add -A && git -C tree rm -q --cached notes
    packed
    # From a hook of another repository's, and in another user's checkout
    (export GIT_DIR="$dir/none" GIT_INDEX_FILE="$dir/none" && packed && exit $((n_failed > 0))) || exit 1
    if test "$(id -u)" = 0; then
        chown -R 65534:65534 tree
        packed
        chown -R 0:0 tree
    fi
else
    rm tree/notes
    must tree dist
fi

tar -xf "tree/$name.tar.xz"
for file in waf wscript .ci/run debian/rules; do
    test -x "tree/$file" -o ! -x "$HOOKE_SOURCE/$file" || fail "the copy's $file cannot be run"
    test -x "$name/$file" -o ! -x "$HOOKE_SOURCE/$file" || fail "the archive's $file cannot be run"
done
while read -r file; do
    cmp -s "$name/$file" "$HOOKE_SOURCE/$file" || fail "$file is another in the archive"
done <sources

# Without git, what has been made there is left out again.
mkdir -p "$name/build" "$name/tests/__pycache__"
touch "$name/build/x" "$name/tests/__pycache__/x" "$name/.lock-waf_x"
must "$name" dist
tar -tf "$name/$name.tar.xz" | grep -v '/$' | LC_ALL=C sort >again
sed "s|^|$name/|" sources | LC_ALL=C sort >wanted
cmp -s again wanted || fail "packed without git: $(diff wanted again)"
rm -r "$name/build" "$name/tests/__pycache__" "$name/.lock-waf_x" "$name/$name.tar.xz"

only_long 'building from the archive'

# Where a shell that is not careful sees three words, a quote and a variable
mkdir "it's a \$tree"
mv "$name" "it's a \$tree"
name="it's a \$tree/$name"

unset LV2_PATH
export CFLAGS="$quick"

# For this user, then for all.
must "$name" configure --user build install
files_below home >found
installed .local/bin .lv2 .local/share/man >wanted
cmp -s found wanted || fail "installed for the user: $(diff wanted found)"
home/.local/bin/hooke render --list-presets >presets 2>&1 || fail "the user's hooke: $(cat presets)"
grep -q 'Concert Harp' presets || fail "the user's hooke does not find its bundle: $(cat presets)"
! in_tree "$name" install --prefix="$dir/elsewhere" || fail 'a prefix given too late is not refused'

# A configuration that is older than an option is renewed with it, by the next build.
sed -i "s/, 'cross': None//" "$name"/.lock-waf*
! grep -q "'cross'" "$name"/.lock-waf* || fail 'the configuration still knows the option'
echo >>"$name/wscript"
must "$name" build

must "$name" uninstall
same "$(find home -mindepth 1 ! -path 'home/.cache*')" '' 'what is left of the user'

mkdir -p usr/lib
must "$name" configure --prefix="$dir/usr" install
files_below usr >found
installed bin lib/lv2 share/man >wanted
cmp -s found wanted || fail "installed for all: $(diff wanted found)"
usr/bin/hooke render --tail 0 "$HOOKE_SOURCE/doc/demo.mid" out/harp.wav >log 2>&1 || fail "hooke for all: $(cat log)"
test -s out/harp.wav || fail 'there is no sound'
must "$name" uninstall
same "$(find usr)" "usr
usr/lib" 'what is left of all'

must "$name" distclean
(cd "$name" && find . -type f | sed 's|^\./||' | LC_ALL=C sort) >cleaned
cmp -s cleaned sources || fail "distclean leaves: $(diff sources cleaned)"

exit $((n_failed > 0))
