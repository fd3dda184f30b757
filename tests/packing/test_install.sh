#!/bin/sh
# What is installed is what was built, and removing it leaves nothing that was not there before.
set -u

. "${HOOKE_SOURCE:?is the directory of the sources}/tests/support/claims.sh"
. "$HOOKE_SOURCE/tests/support/trees.sh"

bundle=${HOOKE_BUNDLE:?}
stage=$dir/stage
test -e "$HOOKE_SOURCE/build/c4che/_cache.py" || skip 'the tree is not built in build/'
test "$HOOKE_BIN" = "$HOOKE_SOURCE/build/hooke" || skip 'what is tested is not what is installed'

setting() {
    sed -n "s/^$1 = '\(.*\)'$/\1/p" "$HOOKE_SOURCE/build/c4che/_cache.py"
}

bin=$(setting BINDIR)
lv2=$(setting LV2DIR)
man=$(setting MANDIR)

# What others have there, and an empty directory, are to stay.
mkdir -p "$stage$lv2/other.lv2" "$stage$bin"
echo theirs >"$stage$lv2/other.lv2/manifest.ttl"
(cd "$stage" && find . | LC_ALL=C sort) >before

# All is built, for another Python as well: that of sudo is often not the user's.
mkdir other
echo 'import sys; sys.hexversion += 0x10000' >other/sitecustomize.py
(export PYTHONPATH="$dir/other" && must "$HOOKE_SOURCE" install --destdir="$stage") || exit 1
! grep -E 'Compiling|Linking' waf.log || fail 'it compiles what is built'
files_below "$stage" >found
{ installed "${bin#/}" "${lv2#/}" "${man#/}" && echo "${lv2#/}/other.lv2/manifest.ttl"; } | LC_ALL=C sort >wanted
cmp -s found wanted || fail "installed: $(diff wanted found)"

for file in $(files_below "$bundle"); do
    cmp -s "$bundle/$file" "$stage$lv2/hooke.lv2/$file" || fail "$file is not what was built"
done
cmp -s "$HOOKE_BIN" "$stage$bin/hooke" || fail 'the program is not what was built'
cmp -s "$HOOKE_SOURCE/doc/hooke.1" "$stage$man/man1/hooke.1" || fail 'the manual page is another'

# Anyone may read it, and run what is to be run.
same "$(find "$stage" -name '*.ttl' -path '*hooke.lv2*' ! -perm 644)" '' 'files with other rights than 644'
same "$(stat -c %a "$stage$bin/hooke" "$stage$lv2/hooke.lv2/hooke.so" | sort -u)" 755 'rights of what is run'
for file in "$stage$bin/hooke" "$stage$lv2/hooke.lv2/hooke.so"; do
    ! readelf -d "$file" | grep -E 'RPATH|RUNPATH' || fail "$file says where to look for others"
done

# It works from there.
others=${LV2_PATH#*:}
LV2_PATH=$stage$lv2:$others "$stage$bin/hooke" render --tail 0 "$HOOKE_SOURCE/doc/demo.mid" out/staged.wav >/dev/null 2>errors ||
    fail "what is installed does not play: $(cat errors)"
"$HOOKE_BIN" render --tail 0 "$HOOKE_SOURCE/doc/demo.mid" out/built.wav >/dev/null
cmp out/staged.wav out/built.wav || fail 'what is installed plays something else'

# Twice is once, and neither a file that is gone nor one too many is in the way.
must "$HOOKE_SOURCE" install --destdir="$stage"
rm "$stage$man/man1/hooke.1"
must "$HOOKE_SOURCE" uninstall --destdir="$stage"
(cd "$stage" && find . | LC_ALL=C sort) >after
cmp -s before after || fail "left or taken: $(diff before after)"

# What one installs all can use, however private the files are that one makes oneself.
(umask 077 && must "$HOOKE_SOURCE" install --destdir="$dir/private") || exit 1
same "$(find private -type d ! -perm 755 -o ! -type d ! -perm 755 ! -perm 644)" '' 'what others cannot read'
must "$HOOKE_SOURCE" uninstall --destdir="$dir/private"

# A stage that was not there is gone again, and a file that someone laid into the bundle is not taken.
must "$HOOKE_SOURCE" install --destdir="$dir/new/stage"
echo mine >"$dir/new/stage$lv2/hooke.lv2/mine"
must "$HOOKE_SOURCE" uninstall --destdir="$dir/new/stage"
same "$(files_below "$dir/new")" "stage$lv2/hooke.lv2/mine" 'what is left beside a file of mine'
rm "$dir/new/stage$lv2/hooke.lv2/mine"
must "$HOOKE_SOURCE" uninstall --destdir="$dir/new/stage"
test ! -e "$dir/new" || fail "left: $(find "$dir/new")"

exit $((n_failed > 0))
