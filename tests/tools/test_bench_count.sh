#!/bin/sh
#
# What a mass-step costs in instructions, which is the same in every run: each thing that a string can have adds to it,
# and nothing else does. And a string that sleeps costs nothing.

set -u

. "$HOOKE_SOURCE/tests/support/claims.sh"

masses=80
few=64   # frames
many=192 # frames

skip() {
    echo "SKIPPED: $*"
    exit 77
}

command -v valgrind >/dev/null 2>&1 || skip "found no valgrind, which counts the instructions"
! grep -q __asan_init "$HOOKE_BIN" || skip "built with a sanitizer, which valgrind cannot run"

# What is counted: a line of WHAT with a name for each.
for numbers in float double fixed; do
    for elasticity in flexible bending straightened; do
        for taps in 1 2; do
            for motion in undamped-$elasticity-still ground-$elasticity-still between-$elasticity-still \
                between-$elasticity-moving; do
                case $numbers-$motion in fixed-undamped* | fixed-*moving) continue ;; esac
                echo "$numbers $motion-$taps $motion-$taps,$numbers,$masses"
            done
        done
    done
done >list
cat >>list <<'END'
harp awake-88 awake,88
harp asleep-88 asleep,88
harp never-played asleep,0
END

# In one process, each with few frames and with many: what both have in common is no part of a step.
set -- valgrind --tool=callgrind --callgrind-out-file=part --dump-before=bench_count_mark "$HOOKE_BIN" bench
while read -r kind name what; do
    set -- "$@" --one "$what,$few" --one "$what,$many"
done <list
"$@" >log 2>errors
status=$?
test $status -eq 0 || {
    fail "valgrind or hooke: status $status: $(tail -n 1 errors)"
    exit 1
}

total() {
    sed -n 's/^totals: //p' "part.$1"
}

# Each begins and ends with a mark, so its instructions are in every other part, from the second on.
part=2
while read -r kind name what; do
    echo "$kind $name $(total $part) $(total $((part + 2)))"
    part=$((part + 4))
done <list >totals
test "$(awk 'NF == 4 && $3 > 0 && $4 > $3' totals | wc -l)" -eq "$(wc -l <list)" || {
    fail "no instructions counted for $(awk '!(NF == 4 && $3 > 0 && $4 > $3)' totals | head -n 1)"
    exit 1
}

awk -v masses=$masses -v frames=$((many - few)) '
    $1 == "harp" { printf "%s %s %.1f a block of 64 frames\n", $1, $2, ($4 - $3) * 64 / frames; next }
    { printf "%s %s %.3f a mass-step\n", $1, $2, ($4 - $3) / (masses * frames) }' totals >counts
echo "instructions:"
cat counts

count() {
    awk -v kind="$1" -v name="$2" '$1 == kind && $2 == name { print $3 }' counts
}

# less KIND NAME NAME: the first costs less than the second.
less() {
    awk -v a="$(count "$1" "$2")" -v b="$(count "$1" "$3")" 'BEGIN { exit !(a != "" && b != "" && a + 0 < b + 0) }' ||
        fail "$1: $2 costs $(count "$1" "$2"), expected less than $3, $(count "$1" "$3")"
}

while read -r kind name what; do
    case $name in
    undamped-*) less "$kind" "$name" "ground-${name#*-}" ;;
    ground-*) less "$kind" "$name" "between-${name#*-}" ;;
    between-*-still-*) test "$kind" = fixed || less "$kind" "$name" "${name%-still-*}-moving-${name##*-}" ;;
    esac
    case $name in
    *-flexible-*) less "$kind" "$name" "${name%%-*}-bending-${name#*-flexible-}" ;;
    *-bending-*) less "$kind" "$name" "${name%%-*}-straightened-${name#*-bending-}" ;;
    esac
    case $name in
    *-1) less "$kind" "$name" "${name%-1}-2" ;;
    esac
done <list

same "$(count harp asleep-88)" "$(count harp never-played)" "instructions of 88 strings asleep"
less harp asleep-88 awake-88

test "$n_failed" -eq 0
