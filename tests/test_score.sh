#!/bin/sh
#
# `hooke render` of a score from the outside: what it writes, what it refuses, what it leaves behind.

set -u

. "$HOOKE_SOURCE/tests/claims.sh"

cat >tune.score <<'END'
# A little of everything.
tempo 96
tuning E4 B3 G3 D3 A2 E2
capo 2
set level -3
0.000 pluck 6 force 0.8 at 0.13
0.100 fret 6 3
0.100 pluck 6 up
0.200 slide 6 5 for 0.1
0.300 lift 6
0.400 damp 6 for 0.1
2:1   strum down 0 2 2 1 0 x spread 0.03
+0.5b hammer 3 2
+0.5b vibrato 1 0.3 for 1b
+0    bend 2 1 for 0.5b
3:1   harmonic 5 3
+1b   palm 0.5
+0    pluck 5 width 0.02
4:1   mute
END

echo '0 pluck 6' >one.score

help_says_what_a_score_is() {
    "$HOOKE_BIN" help score | grep -q '^  T strum down|up F F F F F F' || fail 'help score does not tell of strum'
    "$HOOKE_BIN" help render | grep -q 'hooke help score' || fail 'help render does not tell of help score'
    test "$("$HOOKE_BIN" help score | awk 'length > 100' | wc -l)" -eq 0 || fail 'help score is too wide'
    for word in tempo meter tuning capo 'set' preset pluck fret hammer pull lift slide bend vibrato damp ring touch \
        harmonic palm mute strum force at hardness width down up rate for spread; do
        "$HOOKE_BIN" help score | grep -qw "$word" || fail "help score does not tell of $word"
    done
}

broken_scores_render_nothing() {
    echo old >out/kept.wav
    echo '0 plock 6' >bad.score
    refuse 1 "hooke render: bad.score:1: found 'plock', expected tempo or pluck" render bad.score out/kept.wav
    : >empty.score
    refuse 1 'empty.score:1: found the end of the file, expected an event' render empty.score out/kept.wav
    same "$(cat out/kept.wav)" old 'the old file'
    rm out/kept.wav
    refuse 1 'none.score: No such file or directory' render none.score out/x.wav
    mkdir -p dir.score
    refuse 1 'dir.score: Is a directory' render dir.score out/x.wav
    cp one.score ONE.SCORE
    refuse 2 'expected .wav, .flac or .ogg' render ONE.SCORE out/x.mp3
    refuse 2 'found no output' render one.score
    refuse 2 'found --anyway for a score, expected it for a scene only' render --anyway one.score out/x.wav
}

for claim in \
    help_says_what_a_score_is \
    broken_scores_render_nothing; do
    echo "$claim"
    rm -rf out
    mkdir out
    $claim || fail "$claim"
done

test $n_failed -eq 0
