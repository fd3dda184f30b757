#!/bin/sh
#
# The MIDI files that the tests measure are those that their script makes.

set -u

. "$HOOKE_SOURCE/tests/support/claims.sh"

every_file_is_what_the_script_makes() {
    python3 "$HOOKE_SOURCE/tests/mpe/make.py" out || fail "the script fails"
    for file in out/*.mid; do
        cmp "$file" "$HOOKE_SOURCE/tests/mpe/${file##*/}" || fail "${file##*/} is another"
    done
    same "$(ls "$HOOKE_SOURCE/tests/mpe" | grep -c '\.mid$')" "$(ls out | grep -c '\.mid$')" 'number of files'
}

for claim in \
    every_file_is_what_the_script_makes; do
    echo "$claim"
    rm -rf out
    mkdir out
    $claim || fail "$claim"
done

test $n_failed -eq 0
