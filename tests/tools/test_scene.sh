#!/bin/sh
#
# `hooke render` of a scene from the outside: what it writes, what it refuses, what it leaves behind.

set -u

. "$HOOKE_SOURCE/tests/support/claims.sh"

# Where the samples of a WAV file begin.
data_at() {
    LC_ALL=C grep -obUa data "$1" | head -n 1 | awk -F: '{ print $1 + 8 }'
}

# The left samples of a WAV file of floats, one a line.
left() {
    od -A n -v -t f4 -w8 -j "$(data_at "$1")" "$1" | awk '{ print $1 }'
}

# The paper's string, plucked.
cat >string.scene <<'END'
rate 6000
string s 5 mass 1.0 stiffness 28018382.290630583 damping 7.46285773641449
at 0 displace s.3 0.5
pickup s.3 1
end 1
END

# 2000 rad/s at a step that is stable up to 1000 rad/s.
cat >unstable.scene <<'END'
rate 500
mass a 1
mass b 1
ground g
spring a g 1e4
spring b g 4e6
at 0.01 displace b 1
pickup b 1
end 10
END

writes_a_stereo_wav_at_the_rate_of_the_scene() {
    render string.scene out/a.wav || return
    same "$(field out/a.wav 20 2)" 3 'format'
    same "$(field out/a.wav 22 2)" 2 'channels'
    same "$(field out/a.wav 24 4)" 6000 'rate'
    same "$(left out/a.wav | wc -l | tr -d ' ')" 6000 'frames'
    same "$(left out/a.wav | head -n 1)" 0.5 'the first frame'
    grep -q '^out/a\.wav: 1\.00 s, peak -[0-9.]* dBFS, [0-9.]* times as fast as real time$' log ||
        fail "said '$(cat log)'"
    test ! -s errors || fail "not on a terminal, and yet '$(cat errors)'"
    od -A n -v -t x4 -w8 -j "$(data_at out/a.wav)" out/a.wav | awk '$1 != $2 { exit 1 }' ||
        fail "the two sides differ"
}

# Struck at 3 m/s, a free mass of 2 kg is at 3 t m; one on a damper of 1 kg/s comes to rest, 3 m/Z - h m/s away; and
# the spring between two masses is heard without their drift.
what_hangs_on_no_ground_drifts() {
    cat >drift.scene <<'END'
rate 4000
mass a 2
at 0 strike a 3
pickup a 1
end 1
END
    render drift.scene out/a.wav || return
    near "$(left out/a.wav | sed -n 4000p)" "$(awk 'BEGIN { print 3 * 3999 / 4000 }')" 1e-6 'after a second'
    printf 'ground g\ndamper a g 100\n' >>drift.scene
    render drift.scene out/a.wav || return
    near "$(left out/a.wav | sed -n 4000p)" "$(awk 'BEGIN { print 3 * 2 / 100 - 3 / 4000 }')" 1e-5 'at rest'
    cat >pair.scene <<'END'
rate 6000
mass a 1
mass b 1
spring a b 3820000
at 0 strike a 1
pickup a 1
pickup b -1
end 1
END
    render pair.scene out/a.wav || return
    crossings=$(left out/a.wav | awk 'NR > 1 && $1 * last < 0 { ++n } { last = $1 } END { print n }')
    test "$crossings" -ge 878 -a "$crossings" -le 896 || fail "found $crossings crossings, expected some 887 of 443.6 Hz"
}

# The higher modes have died after half a second: what is left crosses zero 880 times a second.
the_pitch_is_that_of_the_scene() {
    render string.scene out/a.wav || return
    crossings=$(left out/a.wav | tail -n 3000 | awk 'NR > 1 && $1 * last < 0 { ++n } { last = $1 } END { print n }')
    test "$crossings" -ge 439 -a "$crossings" -le 441 || fail "found $crossings crossings, expected 440"
}

rate_and_depth_are_what_was_asked_for() {
    render --rate 44100 --bits 16 string.scene out/a.wav || return
    same "$(field out/a.wav 24 4)" 44100 'rate'
    same "$(field out/a.wav 34 2)" 16 'bits'
    grep -q ': 1\.00 s' log || fail "said '$(cat log)'"
    render --quiet string.scene out/a.flac || return
    same "$(head -c 4 out/a.flac)" fLaC 'a.flac'
    test ! -s log || fail "--quiet said '$(cat log)'"
}

two_runs_are_the_same_file() {
    render string.scene out/a.wav && render string.scene out/b.wav || return
    cmp out/a.wav out/b.wav || fail 'two runs differ'
}

the_unstable_is_refused_with_what_would_do() {
    refuse 3 'unstable.scene: found it unstable at 500 Hz, where mode 2 of 2 grows 13.9-fold a step, expected a rate of 1000 Hz or more' render \
        unstable.scene out/x.wav
    sed 's/^rate.*/rate 1000/' unstable.scene >stable.scene
    render stable.scene out/a.wav
    sed 's/^rate.*/rate 999/' unstable.scene >unstable999.scene
    refuse 3 'expected a rate of 1000 Hz or more' render unstable999.scene out/x.wav
    render --rate 4000 unstable.scene out/a.wav
}

anyway_renders_as_long_as_numbers_are_finite() {
    refuse 1 'out/x.wav: found a number that is not finite at 0.0' render --anyway unstable.scene out/x.wav
    sed 's/^end.*/end 0.05/' unstable.scene >short.scene
    render --anyway short.scene out/a.wav || return
    same "$(left out/a.wav | wc -l | tr -d ' ')" 25 'frames'
    render --anyway string.scene out/a.wav
}

broken_scenes_render_nothing() {
    echo old >out/kept.wav
    echo 'mess' >bad.scene
    refuse 1 "bad.scene:1: found 'mess', expected rate" render bad.scene out/kept.wav
    grep -v pickup string.scene >bad.scene
    refuse 1 "bad.scene:4: found the end of the file, expected 'pickup MASS GAIN'" render bad.scene out/kept.wav
    same "$(cat out/kept.wav)" old 'the old file'
    rm out/kept.wav
    refuse 1 'none.scene: No such file or directory' render none.scene out/x.wav
    sed 's/^rate.*/rate 6000.5/' string.scene >bad.scene
    refuse 1 'found a rate of 6000.5 Hz, expected a whole number' render bad.scene out/x.wav
    printf 'rate 1000\nmass a 1e-300\nground g\nspring a g 1e300\npickup a 1\nend 1\n' >bad.scene
    refuse 1 'bad.scene: could not judge whether it is stable: its numbers differ too widely' render bad.scene out/x.wav
    refuse 1 'nowhere/x.wav: No such file or directory' render string.scene nowhere/x.wav
}

options_of_the_other_kind_are_refused() {
    refuse 2 'found --set for a scene' render --set level=0 string.scene out/x.wav
    refuse 2 'found --tail for a scene' render --tail 1 string.scene out/x.wav
    refuse 2 'found --preset for a scene' render --preset x string.scene out/x.wav
    refuse 2 'found --list-presets for a scene' render --list-presets string.scene
    refuse 2 'found --anyway for a MIDI file' render --anyway song.mid out/x.wav
    refuse 2 'found no output' render string.scene
    refuse 2 'expected .wav, .flac or .ogg' render string.scene out/x.mp3
}

an_interrupted_render_leaves_nothing() {
    sed 's/^end.*/end 100000/' string.scene >endless.scene
    "$HOOKE_BIN" render --bits 16 endless.scene out/endless.flac >log 2>errors &
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

the_examples_are_music() {
    for scene in "$HOOKE_SOURCE"/doc/*.scene; do
        render "$scene" out/a.wav || return
        grep -q ', peak -' log || fail "$scene: said '$(cat log)'"
    done
}

for claim in \
    writes_a_stereo_wav_at_the_rate_of_the_scene \
    the_pitch_is_that_of_the_scene \
    what_hangs_on_no_ground_drifts \
    rate_and_depth_are_what_was_asked_for \
    two_runs_are_the_same_file \
    the_unstable_is_refused_with_what_would_do \
    anyway_renders_as_long_as_numbers_are_finite \
    broken_scenes_render_nothing \
    options_of_the_other_kind_are_refused \
    an_interrupted_render_leaves_nothing \
    the_examples_are_music; do
    echo "$claim"
    rm -rf out
    mkdir out
    $claim || fail "$claim"
done

test $n_failed -eq 0
