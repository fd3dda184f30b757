# shellcheck shell=sh disable=SC2034,SC2154
#
# What the tests that run hosts share: to be read by them with `.`, not run. Reads tests/support/claims.sh.

: "${HOOKE_BIN:?is the program to test}"
: "${HOOKE_SOURCE:?is the directory of the sources}"
: "${HOOKE_BUNDLE:?is the bundle to test}"

hosts=$HOOKE_SOURCE/tests/hosts     # scripts
built=${HOOKE_BIN%/*}/tests/hosts   # programs
patience=240                        # seconds that a program of a host's may take on a busy machine

. "$HOOKE_SOURCE/tests/support/claims.sh"

if nm -D "$HOOKE_BUNDLE/hooke.so" 2>/dev/null | grep -q __asan_; then
    skip 'the plugin was built with sanitizers, which hosts were not'
fi

# Nothing of the user's is read or written, and no screen is needed.
export XDG_CONFIG_HOME="$HOME/config" XDG_CACHE_HOME="$HOME/cache" XDG_DATA_HOME="$HOME/data"
export LC_ALL=C.UTF-8
unset DISPLAY WAYLAND_DISPLAY DBUS_SESSION_BUS_ADDRESS

listen() {
    "$built/listen" "$@" 2>>errors || echo "nothing: $(tail -n 1 errors)"
}

# in_tune WHAT FILE FROM TO HZ TAU: to 0.005 cents and 0.02 %, which is what the instruments promise.
in_tune() {
    tone=$(listen tone "$2" "$3" "$4" "$5" "$6")
    echo "    $1: $tone"
    echo "$tone" | awk '{ exit !($1 >= -0.005 && $1 <= 0.005 && $2 >= -0.0002 && $2 <= 0.0002) }' ||
        fail "$1: found '$tone', expected less than 0.005 cents and 0.0002"
}

# below VALUE MOST WHAT; -inf is below all
below() {
    echo "    $3: $1"
    awk -v a="$1" -v b="$2" 'BEGIN { exit !(a == "-inf" || (a ~ /^-?[0-9.]+(e-?[0-9]+)?$/ && a + 0 <= b)) }' ||
        fail "$3: found '$1', expected at most $2"
}

# alike WHAT A B FROM TO LATER: as good as the same samples; a host's lane may give a value that is a rounding off.
alike() {
    below "$(listen differ "$2" "$3" "$4" "$5" "$6")" -100 "$1 differs by dB"
}

# watched URI TIMES: what the watch has told of a plugin, so often; that it ran, was heard and fell silent, and did nothing
# that it must not.
watched() {
    grep "^$1 " watched >lines
    same "$(grep -c . lines)" "$2" "times that $1 was watched"
    while read -r told; do
        echo "    $told"
        echo "$told" | awk '{
            for (i = 2; i <= NF; ++i) { split($i, pair, "="); of[pair[1]] = pair[2] }
            is_heard = of["runs"] > 20 && of["peak"] > 0.01 && of["peak"] < 1 && of["silent"] > 1000
            exit !(is_heard && of["heap"] + of["lock"] + of["system"] + of["floats"] == 0)
        }' || fail "$told"
        test "$(uname -sm)" != 'Linux x86_64' || ! echo "$told" | grep -q blind || fail 'the watch is blind'
    done <lines
}
