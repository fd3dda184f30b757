#!/bin/sh
#
# `hooke` itself: its answers get to where they are sent or that is said, and every message is one line.

set -u

. "$HOOKE_SOURCE/tests/support/claims.sh"

printf 'MThd\0\0\0\006\0\0\0\001\001\340MTrk\0\0\0\014\0\220\074\144\203\140\074\0\0\377\057\0' >note.mid
printf 'mode 100 20 0.1 1 1\n' >one.body
printf 'rate 8000\nmass a 1\nground g\nspring a g 1e5\nat 0 displace a 1\npickup a 1\nend 0.1\n' >one.scene

answers_that_get_lost_are_failures() {
    while read -r words; do
        "$HOOKE_BIN" $words >/dev/full 2>errors
        same "$? $(cat errors)" '1 hooke: could not write all of the answer: No space left on device' "hooke $words >/dev/full"
        "$HOOKE_BIN" $words >&- 2>errors
        same "$? $(cat errors)" '1 hooke: could not write all of the answer: Bad file descriptor' "hooke $words >&-"
        "$HOOKE_BIN" $words >log 2>errors || fail "hooke $words: $(cat errors)"
        test -s log || fail "hooke $words says nothing"
    done <<'END'
--version
--help
help
help render
help score
render --help
modes one.scene
modes --csv one.scene
modes --json one.scene
body one.body
body --csv one.body
tune --freq 440 --tau 1 --masses 5 --rate 6000
tune --freq 440 --tau 1 --masses 5 --rate 6000 --csv
tune --freq 44 --tau inf one.scene
render --list-presets
render --list-controls
render --tail 0 note.mid out/a.wav
END
    # These lose it before they are done.
    for words in 'bench start --csv' 'bench survey --masses 2 --seconds 0'; do
        "$HOOKE_BIN" $words >/dev/full 2>errors
        same "$? $(cat errors)" '1 hooke: could not write all of the answer: No space left on device' "hooke $words >/dev/full"
    done
}

readers_that_go_away_end_it_in_silence() {
    { "$HOOKE_BIN" render --list-presets 2>errors && "$HOOKE_BIN" help render 2>>errors; } | head -n 1 >log
    test ! -s errors || fail "after the first line: $(cat errors)"
}

# A name in each place where one is said.
names_are_escaped_wherever_they_are_said() {
    name=$(printf 'a\nb\033[31m\177c')
    shown='a\nb\x1b[31m\x7fc'
    cp one.scene "$name.scene"
    echo 'rate loud' >"$name.bad.scene"
    echo '0 pluck 9' >"$name.score"
    echo 'no song' >"$name.mid"
    mkdir "$name.wav"
    refuse 1 "hooke render: $shown: No such file or directory" render "$name" out/x.wav
    refuse 1 "hooke render: $shown.mid: byte 0: found no MThd" render "$name.mid" out/x.wav
    refuse 1 "hooke render: $shown.score:1: found '9'" render "$name.score" out/x.wav
    refuse 1 "hooke render: $shown.bad.scene:1: found 'loud'" render "$name.bad.scene" out/x.wav
    refuse 1 "hooke modes: $shown.bad.scene:1: found 'loud'" modes "$name.bad.scene"
    refuse 1 "hooke tune: $shown.bad.scene:1: found 'loud'" tune --freq 440 --tau 1 "$name.bad.scene"
    refuse 1 "hooke tune: $shown.scene: could not tune mode 9" tune --freq 440 --tau 1 --mode 9 "$name.scene"
    sed 's/1e5/1e9/' one.scene >"$name.fast.scene"
    refuse 3 "hooke render: $shown.fast.scene: found it unstable" render "$name.fast.scene" out/x.wav
    refuse 2 "hooke render: $shown.wav: found a directory" render one.scene "$name.wav"
    refuse 1 "hooke render: out/$shown/x.wav: No such file or directory" render one.scene "out/$name/x.wav"
    refuse 2 "hooke render: out/$shown.mp3: found another ending" render one.scene "out/$name.mp3"
    refuse 2 "hooke: found '$shown', expected a command" "$name"
    refuse 2 "hooke: found '$shown', expected a command" help "$name"
    refuse 2 "no option '--$shown'" render "--$name" one.scene out/x.wav
    refuse 2 "--rate: found '$shown'" render --rate "$name" one.scene out/x.wav
    refuse 2 "found '$shown', expected the symbol" render --set "$name=1" note.mid out/x.wav
    refuse 2 "no preset named '$shown'" render --preset "$name" note.mid out/x.wav
    refuse 1 "$shown" render --plugin "urn:$name" note.mid out/x.wav
    refuse 2 "found '$shown' too" render one.scene out/x.wav "$name"
    refuse 2 "found '$shown', expected a part" bench "$name"
    render --gain 60 one.scene "out/$name.wav" || return
    grep -qF "out/$shown.wav: 0.10 s, peak" log && test "$(wc -l <log)" -eq 1 || fail "'$(cat log)'"
    printf 'MThd\0\0\0\006\0\0\0\001\001\340MTrk\0\0\0\010\0\220\074\144\203\140\074\0' >"$name.odd.mid"
    render --tail 0 "$name.odd.mid" out/a.wav || return
    grep -qF "hooke render: $shown.odd.mid: " errors && test "$(wc -l <errors)" -eq 1 || fail "'$(cat errors)'"
}

for claim in \
    answers_that_get_lost_are_failures \
    readers_that_go_away_end_it_in_silence \
    names_are_escaped_wherever_they_are_said; do
    echo "$claim"
    rm -rf out
    mkdir out
    $claim || fail "$claim"
done

test $n_failed -eq 0
