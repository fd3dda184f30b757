# shellcheck shell=sh disable=SC2034
#
# What the tests of `hooke` from the outside share: to be read by them with `.`, not run.
#
# Reading it leads into a new directory, with an empty out/ in it, which is gone when the test ends.

: "${HOOKE_BIN:?is the program to test}"
: "${HOOKE_SOURCE:?is the directory of the sources}"

dir=$(mktemp -d) || exit 1
child= # a process to end with the test
trap 'test -z "$child" || kill "$child"; rm -rf "$dir"' EXIT
trap 'exit 1' HUP INT TERM
cd "$dir" || exit 1
mkdir home out
HOME=$dir/home
export HOME

search=$PATH # where the program looks for others
n_failed=0

# skip WHY: this test cannot be run here.
skip() {
    echo "skipped: $*"
    exit 77
}

# has PROGRAM: whether there is this one, which no test can count on; if so it can be called from here on. It then finds what
# else there is, which this test does not: PATH is that of tests/allowed.py, and HOOKE_SEARCH the whole.
has() {
    command -v "$1" >/dev/null && return
    test -n "${HOOKE_SEARCH-}" && (PATH=$HOOKE_SEARCH && command -v "$1" >/dev/null) || return
    mkdir -p "$dir/programs"
    printf '%s\n' '#!/bin/sh' 'PATH=$HOOKE_SEARCH' 'exec "${0##*/}" "$@"' >"$dir/programs/$1"
    chmod +x "$dir/programs/$1"
    PATH=${PATH%:"$dir/programs"}:$dir/programs
}

# needs PROGRAM PACKAGE
needs() {
    has "$1" || skip "there is no $1; on Debian: apt-get install $2"
}

fail() {
    echo "FAILED: $*"
    n_failed=$((n_failed + 1))
}

# same FOUND EXPECTED WHAT
same() {
    test "$1" = "$2" || fail "$3: found '$1', expected '$2'"
}

# near VALUE EXPECTED RELATIVE WHAT
near() {
    awk -v a="$1" -v b="$2" -v r="$3" 'BEGIN { d = a - b; d = d < 0 ? -d : d; e = b < 0 ? -b : b; exit !(a != "" && d <= r * e) }' ||
        fail "$4: found '$1', expected $2"
}

# The WAV file's bytes from offset $2 on, $3 of them, as one number, the lowest first.
field() {
    od -A n -t "u$3" -j "$2" -N "$3" "$1" | tr -d ' '
}

render() {
    "$HOOKE_BIN" render "$@" >log 2>errors || {
        fail "render $*: status $?: $(cat errors)"
        return 1
    }
}

# answer STATUS ARGUMENT...: what hooke says to it in `log`, and nothing on stderr.
answer() {
    expected=$1
    shift
    "$HOOKE_BIN" "$@" >log 2>errors
    status=$?
    test "$status" -eq "$expected" || fail "hooke $*: status $status, expected $expected"
    test ! -s errors || fail "hooke $*: $(cat errors)"
}

# refuse STATUS TEXT ARGUMENT...: one line with TEXT on stderr, that status, no answer, and nothing new in out/.
refuse() {
    expected=$1
    text=$2
    shift 2
    before=$(ls -AR out)
    PATH=$search "$HOOKE_BIN" "$@" >log 2>errors
    status=$?
    test "$status" -eq "$expected" || fail "hooke $*: status $status, expected $expected"
    test "$(wc -l <errors)" -eq 1 || fail "hooke $*: not one line: $(cat errors)"
    grep -qF -e "$text" errors || fail "hooke $*: '$(cat errors)' does not say '$text'"
    test ! -s log || fail "hooke $*: wrote '$(cat log)' to stdout"
    test "$(ls -AR out)" = "$before" || fail "hooke $*: left $(ls -AR out)"
}
