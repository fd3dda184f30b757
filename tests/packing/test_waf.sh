#!/bin/sh
# ./waf says what it needs and how to get it, gets it, and leaves nothing in the way of anyone.
set -u

. "${HOOKE_SOURCE:?is the directory of the sources}/tests/support/claims.sh"
. "$HOOKE_SOURCE/tests/support/trees.sh"

unset HOOKE_NO_CHECK HOOKE_NO_INSTALL
copy_tree tree

# A system without a package, whose apt and sudo only note what they are asked.
mkdir system
printf '%s\n' '#!/bin/sh' 'cat "$system/installed"' >system/dpkg-query
printf '%s\n' '#!/bin/sh' 'echo "apt-get $*" >>"$system/asked"' >system/apt-get
printf '%s\n' '#!/bin/sh' 'echo sudo >>"$system/asked"' 'exec "$@"' >system/sudo
printf '%s\n' '#!/bin/sh' 'cat "$system/user"' >system/id
chmod +x system/*
export system="$dir/system"

# there USER PACKAGE,... ARGUMENT...: ./waf there, for that user; what it says goes to `said`, and what apt is asked to `asked`.
there() {
    echo "$1" >system/user
    printf %s "$2" >system/installed
    shift 2
    : >system/asked
    (cd tree && PATH=$system:$PATH ./waf "$@") >said 2>&1
}

# What is printed works as it is, and where no package lists have been fetched. A demo needs no more than is built.
for work in test demo; do
    ! HOOKE_NO_INSTALL=1 there 0 '' $work || fail "$work goes on without a package"
    same "$(wc -l <said) $(wc -c <system/asked)" '2 0' "lines said by $work, and words to apt"
    sed -n 's/^waf: to install them: //p' said >by_hand
    PATH=$system:$PATH sh by_hand
    same "$(sed -n 1p system/asked)" 'apt-get update' "first command for $work"
    sed -n 2p system/asked >$work.wants
    grep -q '^apt-get install --no-install-recommends python3 gcc .*liblilv-dev' $work.wants || fail "$work wants $(cat $work.wants)"
done
grep -q valgrind test.wants || fail "tests want $(cat test.wants)"
! grep -qE 'valgrind|cmocka|sordi' demo.wants || fail "demo wants $(cat demo.wants)"

! HOOKE_NO_INSTALL=1 there 1000 'ii gcc,' demo || fail 'it goes on without a package'
grep -q 'to install them: sudo apt-get update && sudo apt-get install' said || fail "a user is told: $(cat said)"
! grep -q ' gcc' said || fail "gcc is there, and yet: $(cat said)"

# It helps itself. waf alone needs Python alone.
there 0 '' --version || fail "for root: $(cat said)"
same "$(grep -c . system/asked) $(tail -n 1 system/asked | sed 's/.* //')" '2 python3' 'what root asks of apt'
there 1000 '' --version || fail "for a user: $(cat said)"
same "$(grep -c sudo system/asked)" 2 'what a user asks of sudo'
there 1000 'ii python3,' --version || fail "with Python: $(cat said)"
same "$(wc -c <system/asked)" 0 'what is asked of apt when all is there'

# What it does not do it says in a line or two.
must tree configure
for words in distcheck 'build --prefix=/elsewhere' 'configure --nonsense' nonsense; do
    # shellcheck disable=SC2086  # words
    ! in_tree tree $words || fail "$words is done"
    ! grep -q Traceback waf.log || fail "$words: $(cat waf.log)"
done
mkdir a:b && cp -R tree a:b
! in_tree a:b/tree configure || fail 'a path with a colon is not refused'
grep -q 'LV2_PATH has colons' waf.log || fail "a path with a colon: $(cat waf.log)"

# A tree that is elsewhere now is configured anew.
mv tree moved
must moved configure
same "$(sed -n "s|^top_dir = .\(.*\).$|\1|p" moved/.lock-waf*)" "$dir/moved" 'where the tree is now'

# Another user's tree, in which root works: all of it stays that user's, who can go on. What root left otherwise is named.
as_nobody() {
    setpriv --reuid 65534 --regid 65534 --clear-groups "$@"
}
chmod 755 "$dir"
if test "$(id -u)" = 0 && as_nobody test -w /dev/null -a -r "$dir/moved/waf"; then
    chown -R 65534:65534 moved home
    must moved configure
    same "$(find moved ! -user 65534)" '' 'what became of root'
    (cd moved && as_nobody env HOOKE_NO_CHECK=1 ./waf configure --user) >said 2>&1 || fail "the user cannot go on: $(cat said)"
    if test -n "${HOOKE_TEST_LONG-}"; then # what root installs it does not compile, and the user can build and install again
        user_waf() {
            (cd moved && as_nobody env HOOKE_NO_CHECK=1 CFLAGS="$quick" ./waf "$@") >said 2>&1 || fail "the user's waf $*: $(tail -n 25 said)"
        }
        user_waf configure --prefix=/usr
        user_waf build
        (umask 077 && must moved install --destdir="$dir/stage") || exit 1
        ! grep -qE 'Compiling|Linking' waf.log || fail 'root compiles what the user has built'
        same "$(find stage/usr -type d ! -perm 755 -o ! -type d ! -perm 755 ! -perm 644)" '' 'what others cannot read'
        same "$(find moved ! -user 65534)" '' 'what became of root'
        user_waf configure --user
        user_waf build install
        test -e home/.lv2/hooke.lv2/manifest.ttl || fail 'the user has not installed it'
    fi
    mkdir moved/build/mine
    ! (cd moved && as_nobody env HOOKE_NO_CHECK=1 ./waf configure --user) >said 2>&1 || fail "what is root's is not in the way"
    same "$(wc -l <said)" 1 "lines said of what is root's"
    grep -q 'build/mine .*distclean' said || fail "said of what is root's: $(cat said)"
    (cd moved && as_nobody env HOOKE_NO_CHECK=1 ./waf --version) >said 2>&1 || fail "it is in the way of all: $(cat said)"
    chown 0:0 moved && chmod 755 moved && rm -r moved/build/mine
    ! (cd moved && as_nobody env HOOKE_NO_CHECK=1 ./waf configure) >said 2>&1 || fail 'it writes where it must not'
    grep -q 'nothing can be written into' said || fail "said where nothing can be written: $(cat said)"
else
    echo "left out: what root leaves to others, for this is not root's test, or nobody else can read $dir"
fi

exit $((n_failed > 0))
