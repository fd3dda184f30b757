#!/bin/sh
#
# `hooke render` of a score from the outside: what it writes, what it refuses, what it leaves behind.

set -u

. "$HOOKE_SOURCE/tests/support/claims.sh"

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
+0.5b vibrato 3 0.3 for 1b
+0    bend 2 1 for 0.5b
3:1   harmonic 5 3
+1b   palm 0.1
+0    pluck 5 width 0.02
+0.5b mute
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
    refuse 2 'expected .wav, .flac or .ogg' render one.score out/x.mp3
    refuse 2 'found no output' render one.score
    refuse 2 'found --anyway for a score, expected it for a scene only' render --anyway one.score out/x.wav
}

# Where the samples of a WAV file begin.
data_at() {
    LC_ALL=C grep -obUa data "$1" | head -n 1 | awk -F: '{ print $1 + 8 }'
}

# The frames of a WAV file of floats, from the $2-th on, counted from 0.
frames() {
    tail -c +$(($(data_at "$1") + 1 + 8 * $2)) "$1"
}

# after FILE N REFERENCE: N frames of silence and then the reference, bit by bit.
after() {
    head -c $((8 * $2)) /dev/zero >expected
    frames "$3" 0 >>expected
    frames "$1" 0 >found
    cmp found expected || fail "$1 is not $3 after $2 frames"
}

block_size_does_not_change_the_file() {
    render --tail 1 tune.score out/block256.wav || return
    for block in 1 64 1000 4096; do
        render --tail 1 --block $block tune.score "out/block$block.wav" || return
        cmp out/block256.wav "out/block$block.wav" || fail "--block 256 and --block $block differ"
    done
    grep -q ', peak -' log || fail "it is silent: '$(cat log)'"
}

an_event_acts_on_the_frame_nearest_to_its_time() {
    render --tail 0.5 one.score out/at0.wav || return
    for pair in 0.5:24000 0.50001:24000 0.500011:24001 0.00001:0 0.000011:1 0.123456:5926; do
        echo "${pair%:*} pluck 6" >late.score
        render --tail 0.5 --block 1000 late.score out/late.wav || return
        after out/late.wav "${pair#*:}" out/at0.wav
    done
    printf 'meter 3\ntempo 96\n2:1.5 pluck 6\n' >late.score
    render --tail 0.5 late.score out/late.wav || return
    after out/late.wav 105000 out/at0.wav
    render --rate 44100 --tail 0.5 one.score out/at0.wav || return
    render --rate 44100 --tail 0.5 late.score out/late.wav || return
    after out/late.wav 96469 out/at0.wav
}

# Plucked where it is read, a string is heard from the frame of the pluck on.
the_first_frame_sounds() {
    printf 'set pickup 0.2\nset blend 0\n0.01 pluck 6 at 0.2\n' >here.score
    render --tail 0.1 here.score out/a.wav || return
    same "$(frames out/a.wav 0 | od -A n -v -t f4 -w8 | awk '$1 != 0 { print NR - 1; exit }')" 480 'the first frame that sounds'
}

# Each line that is left out is missed.
every_event_is_heard() {
    render --tail 0.5 tune.score out/all.wav || return
    lines=$(awk '/^[0-9+]/ { print NR }' tune.score)
    for line in $lines; do
        sed "${line}s/#.*//; ${line}s/^\([^ ]*\) .*/\1 ring 4/" tune.score >less.score
        render --tail 0.5 less.score out/less.wav || return
        ! cmp -s out/all.wav out/less.wav || fail "nobody hears '$(sed -n "${line}p" tune.score)'"
    done
}

settings_are_as_on_the_command_line() {
    printf 'set level -12\ntuning 62 B3 G3 D3 A2 D2\ncapo 3\n0 strum down 0 0 0 0 0 0\n' >set.score
    echo '0 strum down 0 0 0 0 0 0' >plain.score
    render --tail 0.2 set.score out/set.wav && render --tail 0.2 plain.score out/plain.wav || return
    render --tail 0.2 --set level=-12 --set string1=62 --set string6=38 --set capo=3 plain.score out/line.wav || return
    cmp out/set.wav out/line.wav || fail 'the score and the command line set something else'
    render --tail 0.2 --set level=0 --set string1=64 --set string6=40 --set capo=0 set.score out/back.wav || return
    cmp out/back.wav out/plain.wav || fail 'the command line does not have the last word'
    for i in 1 2 3 4 5 6; do
        tuning=$(echo 64 59 55 50 45 40 | awk -v i=$i '{ $i -= 2; print }')
        printf 'tuning %s\n0 strum down 0 0 0 0 0 0\n' "$tuning" >set.score
        render --tail 0.2 set.score out/set.wav || return
        render --tail 0.2 --set string$i="$(echo "$tuning" | cut -d' ' -f$i)" plain.score out/line.wav || return
        cmp out/set.wav out/line.wav || fail "string $i is not tuned"
    done
}

presets_come_first() {
    "$HOOKE_BIN" render --list-presets one.score >presets 2>errors || fail "--list-presets: $(cat errors)"
    test "$(wc -l <presets)" -ge 2 || return 0
    first=$(head -n 1 presets)
    last=$(tail -n 1 presets)
    printf 'set level -3\npreset %s # it comes first all the same\n0 pluck 6\n' "$first" >preset.score
    printf 'set level -3\n0 pluck 6\n' >without.score
    render --tail 0.2 preset.score out/a.wav && render --tail 0.2 --preset "$first" without.score out/b.wav || return
    cmp out/a.wav out/b.wav || fail 'the preset of the score is another'
    render --tail 0.2 --preset "$last" preset.score out/a.wav && render --tail 0.2 --preset "$last" without.score out/b.wav || return
    cmp out/a.wav out/b.wav || fail 'the preset of the command line does not win'
}

settings_that_cannot_be_are_told_by_line() {
    printf '0 mute\nset level 99\n' >bad.score
    refuse 1 "hooke render: bad.score:2: level: found '99', expected a number from -60 to 12" render bad.score out/x.wav
    printf '\n0 mute\nset loudness 1\n' >bad.score
    refuse 1 "bad.score:3: found 'loudness', expected the symbol of a control input" render bad.score out/x.wav
    printf '0 mute\n\ntuning E4 B3 G3 D3 A2 0\n' >bad.score
    refuse 1 "bad.score:3: string6: found '0', expected a whole number from" render bad.score out/x.wav
    printf '0 mute\ncapo 24\n' >bad.score
    refuse 1 "bad.score:2: capo: found '24', expected" render bad.score out/x.wav
    printf "0 mute\npreset Nobody's  Own\n" >bad.score
    refuse 1 "bad.score:2: no preset named 'Nobody's Own'" render bad.score out/x.wav
    refuse 2 "level: found '99'" render --set level=99 one.score out/x.wav
    refuse 2 "no preset named 'x'" render --preset x one.score out/x.wav
}

the_plugin_is_the_guitar_and_others_are_refused() {
    render --tail 0.1 one.score out/a.wav && render --tail 0.1 --plugin urn:hooke:guitar one.score out/b.wav || return
    cmp out/a.wav out/b.wav || fail 'a score is not for the guitar'
    cp one.score ONE.SCORE
    render --tail 0.1 ONE.SCORE out/b.wav || return
    cmp out/a.wav out/b.wav || fail 'a score is none in capitals'
    refuse 2 'found <urn:hooke:strings>, expected a plugin that plays scores, as <urn:hooke:guitar>' render \
        --plugin urn:hooke:strings one.score out/x.wav
    cp "$HOOKE_SOURCE/doc/demo.mid" song.mid
    render --tail 0 --rate 8000 song.mid out/a.wav && render --tail 0 --rate 8000 --plugin urn:hooke:strings song.mid out/b.wav || return
    cmp out/a.wav out/b.wav || fail 'a MIDI file is not for the strings'
    render --tail 0 --rate 8000 --plugin urn:hooke:guitar song.mid out/c.wav || return
    ! cmp -s out/a.wav out/c.wav || fail '--plugin does nothing'
}

# The tail that is asked for, or until silent.
the_end_is_that_of_a_song() {
    echo '1 mute' >rest.score
    render rest.score out/a.wav
    same "$(sed 's/^.*: \(1\.25 s, silent\),.*$/\1/' log)" '1.25 s, silent' 'a rest'
    render --tail 2 one.score out/a.wav
    grep -q ': 2\.00 s, peak' log || fail "a tail of two seconds: '$(cat log)'"
    printf '0 pluck 6\n0.1 mute\n' >short.score
    render short.score out/a.wav
    awk -F': ' '{ exit !($2 + 0 < 5) }' log || fail "muted, and yet '$(cat log)'"
}

an_interrupted_render_leaves_nothing() {
    "$HOOKE_BIN" render --tail 3600 --bits 16 one.score out/endless.flac >log 2>errors &
    child=$!
    tries=0
    until ls out/endless.flac.*.part >names 2>&1; do
        tries=$((tries + 1))
        test $tries -lt 100 || break
        sleep 0.1
    done
    test $tries -lt 100 || fail 'no unfinished file to be seen'
    kill -TERM $child 2>errors
    wait $child 2>>errors
    status=$?
    child=
    test $status -eq 143 || fail "status $status after SIGTERM, expected 143"
    for rest in out/endless*; do
        test ! -e "$rest" || fail "left $rest"
    done
}

for claim in \
    help_says_what_a_score_is \
    block_size_does_not_change_the_file \
    an_event_acts_on_the_frame_nearest_to_its_time \
    the_first_frame_sounds \
    every_event_is_heard \
    settings_are_as_on_the_command_line \
    presets_come_first \
    settings_that_cannot_be_are_told_by_line \
    the_plugin_is_the_guitar_and_others_are_refused \
    the_end_is_that_of_a_song \
    an_interrupted_render_leaves_nothing \
    broken_scores_render_nothing; do
    echo "$claim"
    rm -rf out
    mkdir out
    $claim || fail "$claim"
done

test $n_failed -eq 0
