#!/bin/sh
#
# `hooke render` from the outside: what it writes, what it refuses, and what it leaves behind.

set -u

. "$HOOKE_SOURCE/tests/support/claims.sh"

size() {
    wc -c <"$1" | tr -d ' '
}

# A song without a note, a note of half a second, and a song of three notes at three tempi.
printf 'MThd\0\0\0\006\0\0\0\001\001\340MTrk\0\0\0\004\0\377\057\0' >rest.mid
printf 'MThd\0\0\0\006\0\0\0\001\001\340MTrk\0\0\0\014\0\220\074\144\203\140\074\0\0\377\057\0' >note.mid
{
    printf 'MThd\0\0\0\006\0\001\0\002\001\340'
    printf 'MTrk\0\0\0\032\0\377\121\003\003\320\220\201\160\377\121\003\007\241\040\074\377\121\003\003\015\100\0\377\057\0'
    printf 'MTrk\0\0\0\027\0\220\060\144\201\000\220\067\120\202\000\220\074\160\203\140\260\100\177\0\377\057\0'
} >song.mid

writes_a_stereo_wav_of_floats() {
    render note.mid out/a.wav || return
    same "$(field out/a.wav 20 2)" 3 'format of a.wav'
    same "$(field out/a.wav 22 2)" 2 'channels of a.wav'
    same "$(field out/a.wav 24 4)" 48000 'rate of a.wav'
    grep -q '^out/a\.wav: [0-9.]* s, peak -*[0-9.]* dBFS, [0-9.]* times as fast as real time$' log ||
        fail "said '$(cat log)'"
    test ! -s errors || fail "not on a terminal, and yet '$(cat errors)'"
    render --quiet note.mid out/b.wav || return
    test ! -s log || fail "--quiet said '$(cat log)'"
    cmp out/a.wav out/b.wav || fail "two runs differ"
}

the_rate_is_what_was_asked_for() {
    render --rate 44100 --tail 1 note.mid out/a.wav || return
    same "$(field out/a.wav 24 4)" 44100 rate
    grep -q ': 1\.50 s' log || fail "half a second and a tail of one: '$(cat log)'"
}

the_ending_chooses_the_format() {
    for name in a.flac b.FLAC c.ogg d.wav; do
        render note.mid "out/$name" || return
    done
    same "$(head -c 4 out/a.flac)" fLaC a.flac
    same "$(head -c 4 out/b.FLAC)" fLaC b.FLAC
    same "$(head -c 4 out/c.ogg)" OggS c.ogg
    same "$(head -c 4 out/d.wav)" RIFF d.wav
}

the_depth_is_what_was_asked_for() {
    for bits in 16 24 32; do
        render --bits=$bits note.mid out/a.wav || return
        same "$(field out/a.wav 34 2)" $bits 'bits of a.wav'
    done
}

block_size_does_not_change_the_file() {
    for block in 64 1000 1 65536; do
        render --block $block song.mid "out/block$block.wav" || return
        cmp out/block64.wav "out/block$block.wav" || fail "--block 64 and --block $block differ"
    done
}

a_quarter_of_a_second_of_silence_is_the_end() {
    for block in 64 1000; do
        render --block $block rest.mid "out/rest$block.wav" || return
        same "$(sed 's/^.*: \(0\.25 s, silent\),.*$/\1/' log)" '0.25 s, silent' "with --block $block"
    done
    cmp out/rest64.wav out/rest1000.wav || fail "--block 64 and --block 1000 end elsewhere"
}

the_tail_is_as_long_as_asked_for() {
    render --tail 0 note.mid out/short.wav && render --tail 1 note.mid out/long.wav || return
    more=$(($(size out/long.wav) - $(size out/short.wav)))
    test $more -eq $((48000 * 8)) || fail "a second more is $more bytes more, expected $((48000 * 8))"
}

# A string that dies to 1/e in R seconds has fallen by 80 dB in R ln(10^4) = 9.21 R; then comes a quarter of a second. The
# limiter and the level have no part in that, nor has the loudness of the note.
the_tail_ends_80_dB_below_the_peak() {
    for level in 0 -40; do
        render --rate 16000 --set release=0.5 --set damping=0.02 --set tracking=0 --set masses=1 --set level=$level note.mid out/a.wav || return
        seconds=$(sed 's/^.*: \([0-9.]*\) s,.*$/\1/' log)
        near "$seconds" "$(awk 'BEGIN { print 0.5 + 0.5 * log(1e4) + 0.25 }')" 0.02 "length with --set level=$level"
    done
    render --rate 16000 --set release=0.5 --set damping=0.02 --set tracking=0 --set masses=1 --set level=-40 --tail auto note.mid out/b.wav || return
    cmp out/a.wav out/b.wav || fail '--tail auto is not what is usual'
}

# One that would ring for 90 s is cut, and that is said.
the_tail_is_a_minute_at_most() {
    render --rate 4000 --set release=10 --set damping=0.02 --set tracking=0 --set masses=1 note.mid out/a.wav || return
    grep -q ': 60\.50 s' log || fail "half a second and a minute: '$(cat log)'"
    same "$(cat errors)" 'hooke render: out/a.wav: cut while it rings; --tail S goes on for S seconds' 'what is said of it'
    render --rate 4000 --set release=10 --set damping=0.02 --tail 1 note.mid out/a.wav || return
    same "$(cat errors)" '' 'said of a tail that was asked for'
}

settings_are_heard() {
    render --tail 0 note.mid out/a.wav && render --tail 0 --set level=-12 note.mid out/b.wav || return
    ! cmp -s out/a.wav out/b.wav || fail "--set level=-12 changes nothing"
    render --tail 0 --set level=-12 --set level=0 note.mid out/c.wav || return
    cmp out/a.wav out/c.wav || fail "of two settings the last does not win"
    render --tail 0 --set level=12 note.mid out/d.wav || fail "the range does not have its end"
}

presets_are_listed_and_found() {
    "$HOOKE_BIN" render --list-presets >presets 2>errors || fail "--list-presets: $(cat errors)"
    name=$(head -n 1 presets)
    test -z "$name" || render --preset "$(echo "$name" | tr '[:upper:]' '[:lower:]')" note.mid out/a.wav
    refuse 2 "no preset named 'Nobody's'" render --preset "Nobody's" note.mid out/b.wav
}

# Eight quarters at 120, of which the first has the only note; two patterns of 1.0 and 0.5 s; 1,000 ticks at 25 frames
# of 40; and a note with a second of silence, an hour later.
the_length_is_the_songs() {
    printf 'MThd\0\0\0\006\0\0\0\001\001\340MTrk\0\0\0\015\0\220\074\144\203\140\074\0\232\040\377\057\0' >eight.mid
    {
        printf 'MThd\0\0\0\006\0\002\0\002\001\340'
        printf 'MTrk\0\0\0\011\0\220\074\144\207\100\377\057\0MTrk\0\0\0\011\0\220\074\144\203\140\377\057\0'
    } >patterns.mid
    printf 'MThd\0\0\0\006\0\0\0\001\347\050MTrk\0\0\0\011\0\220\074\144\207\150\377\057\0' >frames.mid
    for song in eight:4000 patterns:1500 frames:1000; do
        render --tail 0 --rate 8000 --bits 16 "${song%:*}.mid" out/a.wav || return
        same "$(($(size out/a.wav) - 44))" $((${song#*:} * 32)) "bytes of sound of ${song%:*}.mid"
    done
    printf 'MThd\0\0\0\006\0\0\0\001\001\340MTrk\0\0\0\013\201\322\370\000\220\074\144\0\377\057\0' >long.mid
    render --tail 0 --rate 4000 long.mid out/a.ogg || return
    grep -q ': 3600\.00 s' log || fail "an hour: '$(cat log)'"
}

# 20 hours are 27.6 GB, which is known before the first frame.
a_wav_file_too_long_is_refused_at_once() {
    printf 'MThd\0\0\0\006\0\0\0\001\001\340MTrk\0\0\0\013\240\372\340\000\220\074\144\0\377\057\0' >day.mid
    refuse 1 'out/x.wav: found a length of 72000 s, expected a WAV file below 4 GiB' render day.mid out/x.wav
}

# Before the song is even looked for; and the rates that are said are written.
rates_that_a_file_cannot_have_are_refused_with_the_options() {
    in_tens='expected at most 655350 Hz for .flac, above 65535 in tens'
    refuse 2 "out/x.flac: found a rate of 768000 Hz, $in_tens" render --rate 768000 nosuch.mid out/x.flac
    refuse 2 "out/x.flac: found a rate of 96001 Hz, $in_tens" render --rate 96001 nosuch.mid out/x.flac
    refuse 2 'out/x.OGG: found a rate of 384000 Hz, expected at most 200000 Hz for .ogg' render --rate 384000 nosuch.mid out/x.OGG
    sed 's/^rate .*/rate 384000/' "$HOOKE_SOURCE/doc/coupled.scene" >fast.scene
    refuse 1 'out/x.ogg: found a rate of 384000 Hz, expected at most 200000 Hz' render fast.scene out/x.ogg
    for rate in 655350:a.flac 65535:b.flac 65540:c.flac 200000:a.ogg 4000:b.ogg 768000:a.wav; do
        render --tail 0 --rate "${rate%:*}" note.mid "out/${rate#*:}" || return
    done
}

blemishes_are_played_with_a_line_for_each_kind() {
    printf 'a letterMThd\0\0\0\006\0\0\0\003\001\340MTrk\0\0\0\014\0\220\074\377\203\140\370\0\074\0\0\370' >odd.mid
    render --tail 0 odd.mid out/a.wav || return
    while read -r line; do
        grep -qF "$line" errors || fail "'$(cat errors)' does not say '$line'"
    done <<'END'
hooke render: odd.mid: byte 0: found other data before MThd, skipped it
hooke render: odd.mid: byte 18: found another number of tracks than there are, played all of them
hooke render: odd.mid: track 1, byte 42: found no End of Track, ended the track with its last event
hooke render: odd.mid: track 1, byte 33: found a data byte over 0x7f, took it for 0x7f
hooke render: odd.mid: track 1, byte 36: found a real-time byte in a track, left it out; 2 times in all
END
    same "$(wc -l <errors)" 5 'lines about odd.mid'
    render --tail 0 --quiet odd.mid out/b.wav || return
    test ! -s errors || fail "--quiet, and yet '$(cat errors)'"
    printf 'MThd\0\0\0\006\0\0\0\001\001\340MTrk\0\0\0\014\0\220\074\177\203\140\074\0\0\377\057\0' >even.mid
    render --tail 0 even.mid out/c.wav || return
    cmp out/a.wav out/b.wav && cmp out/a.wav out/c.wav || fail "odd.mid and even.mid do not sound the same"
}

broken_songs_are_refused() {
    : >empty.mid
    echo 'This is a letter and no song.' >letter.mid
    head -c 20 note.mid >short.mid
    refuse 1 'nosuch.mid: No such file or directory' render nosuch.mid out/x.wav
    refuse 1 'empty.mid: byte 0: found an empty file' render empty.mid out/x.wav
    refuse 1 'letter.mid: byte 0: found no MThd, expected a Standard MIDI File' render letter.mid out/x.wav
    refuse 1 'short.mid: byte 14: found no track, expected one or more' render short.mid out/x.wav
    refuse 1 'Is a directory' render . out/x.wav
    ! grep -q score errors || fail "of a directory: '$(cat errors)'"
    cp letter.mid letter.txt
    refuse 1 "letter.txt: byte 0: found no MThd, expected a Standard MIDI File; a score's name ends in .score, a scene's in .scene" \
        render letter.txt out/x.wav
}

options_may_stand_anywhere_before_two_dashes() {
    render --tail 0 --rate=8000 note.mid out/a.wav && render note.mid out/b.wav --tail=0 --rate 8000 &&
        render note.mid --tail 0 --rate 8000 -- out/c.wav || return
    cmp out/a.wav out/b.wav && cmp out/a.wav out/c.wav || fail 'the order of words changes the sound'
    POSIXLY_CORRECT=1 render note.mid out/d.wav --tail 0 --rate 8000 || return
    cmp out/a.wav out/d.wav || fail 'POSIXLY_CORRECT changes the sound'
    cp note.mid ./--rate
    render --tail 0 --rate 8000 -- --rate out/e.wav || return
    cmp out/a.wav out/e.wav || fail 'behind -- there is no file --rate'
    refuse 2 "expected .wav, .flac or .ogg" render note.mid -- --quiet
}

broken_commands_are_refused() {
    refuse 2 "no option '-q'" render -q note.mid out/x.wav
    refuse 2 "no option '-xyz'" render note.mid out/x.wav -xyz
    refuse 2 "no option '--nil=1'" render --nil=1 note.mid out/x.wav
    refuse 2 "hooke render: --quiet takes no value" render note.mid out/x.wav --quiet=
    refuse 2 "hooke render: --set needs a value" render note.mid out/x.wav --set
    refuse 2 "no option '--loud'; try hooke help" modes --loud x.scene
    refuse 2 "no option '--loud'; try hooke help" tune --loud
    refuse 2 "no option '--loud'; try hooke help" bench --loud
    refuse 2 'found no command, expected render, modes, body, tune or bench; try hooke --help'
    refuse 2 "found 'play', expected a command" play
    refuse 2 "found 'play', expected a command" help play
    refuse 2 'found no input' render
    refuse 2 'found no output' render note.mid
    refuse 2 "found 'third' too" render note.mid out/x.wav third
    refuse 2 "no option '--loud'" render --loud note.mid out/x.wav
    refuse 2 '--rate needs a value' render note.mid out/x.wav --rate
    refuse 2 '--quiet takes no value' render --quiet=yes note.mid out/x.wav
    for value in 0 -1 nan inf 44100.5 48k '' 1e9; do
        refuse 2 "--rate: found '$value', expected a whole number" render --rate "$value" note.mid out/x.wav
    done
    refuse 2 "--block: found '0', expected a whole number from 1" render --block 0 note.mid out/x.wav
    refuse 2 "--tail: found '-1', expected a number from 0 to 3600, or auto" render --tail -1 note.mid out/x.wav
    refuse 2 "--tail: found '1s', expected a number from 0" render --tail 1s note.mid out/x.wav
    for bits in 8 20 0x10 16.0 '' 64; do
        refuse 2 "--bits: found '$bits', expected 16, 24 or 32" render --bits "$bits" note.mid out/x.wav
    done
    refuse 2 'expected .wav, .flac or .ogg' render note.mid out/x.mp3
    refuse 2 'expected .wav, .flac or .ogg' render note.mid out/wav
    refuse 2 'expected 16 or 24 for .flac' render --bits 32 note.mid out/x.flac
}

settings_out_of_range_are_refused() {
    refuse 2 "level: found '99', expected a number from -60 to 12" render --set level=99 note.mid out/x.wav
    refuse 2 "level: found 'nan', expected a number" render --set level=nan note.mid out/x.wav
    refuse 2 "level: found '', expected a number" render --set level= note.mid out/x.wav
    refuse 2 "masses: found '2.5', expected a whole number" render --set masses=2.5 note.mid out/x.wav
    refuse 2 "found 'loudness', expected the symbol" render --set loudness=1 note.mid out/x.wav
    refuse 2 "found 'sounding', expected the symbol" render --set sounding=1 note.mid out/x.wav
    refuse 2 "found 'level', expected SYMBOL=VALUE" render --set level note.mid out/x.wav
}

plugins_that_are_not_there_are_refused() {
    refuse 1 'plugin <urn:nobody:plays>: not found' render --plugin urn:nobody:plays note.mid out/x.wav
    refuse 1 "found no URI" render --plugin nobody note.mid out/x.wav
    refuse 1 'did you mean urn:hooke:guitar?' render --plugin urn:hooke:guitra note.mid out/x.wav
    refuse 1 'did you mean urn:hooke:strings?' render --list-presets --plugin urn:hook:string
}

a_failure_leaves_the_old_file_alone() {
    echo old >out/kept.wav
    refuse 1 'No such file' render nosuch.mid out/kept.wav
    refuse 2 'expected a number' render --set level=99 note.mid out/kept.wav
    test "$(cat out/kept.wav)" = old || fail "the old file is gone"
    rm out/kept.wav
}

the_plugin_beside_the_program_is_found() (
    unset LV2_PATH
    render --tail 0 note.mid out/a.wav
)

help_and_version_are_answers() {
    "$HOOKE_BIN" --version | grep -q '^hooke [^ ]*$' || fail "--version: $("$HOOKE_BIN" --version)"
    "$HOOKE_BIN" --help | grep -q '^  render ' || fail "--help does not name render"
    "$HOOKE_BIN" help render | grep -q '^  --preset NAME' || fail "help render does not name --preset"
    "$HOOKE_BIN" render --help | grep -q '^usage: hooke render' || fail "render --help is no help"
}

# A mapping that is equal temperament changes no bit; one that leaves key 60 out makes it silent; a scale is another sound.
# Which of both a file is, it says itself.
files_tune_both_instruments() {
    printf '0\n0\n127\n60\n69\n440\n0\n' >equal.kbm
    printf '2\n0\n127\n60\n61\n440\n1\nx\n0\n' >odd.kbm
    for plugin in strings guitar; do
        render --plugin urn:hooke:$plugin note.mid out/none.wav || return
        render --plugin urn:hooke:$plugin --mapping equal.kbm note.mid out/equal.wav || return
        render --plugin urn:hooke:$plugin --scale "$HOOKE_SOURCE/tests/scales/19-equal.scl" note.mid out/scale.wav || return
        render --plugin urn:hooke:$plugin --mapping "$HOOKE_SOURCE/tests/scales/19-equal.scl" note.mid out/other.wav || return
        cmp out/none.wav out/equal.wav || fail "$plugin: a mapping of equal temperament is heard"
        cmp out/scale.wav out/other.wav || fail "$plugin: a scale is none as a mapping"
        ! cmp -s out/none.wav out/scale.wav || fail "$plugin: no scale is heard"
        render --plugin urn:hooke:$plugin --tail 0 --mapping odd.kbm note.mid out/odd.wav || return
        grep -q 'silent' log || fail "$plugin: key 60 sounds: $(cat log)"
    done
}

# Whatever a preset says; --set has the last word.
the_body_of_a_file_is_heard() {
    printf 'mode 260 30 0.1 1 0.8\nabove 400 density 0.02 q 30 mass 0.1 radiation 1 seed 1 to 4000\n' >box.body
    render note.mid out/none.wav || return
    render --body box.body note.mid out/body.wav || return
    render --body box.body --preset 'Concert Harp' --set body_mix=1 note.mid out/preset.wav || return
    render --preset 'Concert Harp' --set body_mix=1 --set body=File note.mid out/no_file.wav || return
    render --body box.body --set body=None note.mid out/set.wav || return
    ! cmp -s out/none.wav out/body.wav || fail "no body is heard"
    ! cmp -s out/preset.wav out/no_file.wav || fail "no body is heard with a preset"
    cmp out/none.wav out/set.wav || fail "--set has not the last word"
    render --plugin urn:hooke:guitar --body box.body note.mid out/guitar.wav || return
}

broken_bodies_are_refused() {
    printf 'mode 100 20 1 1 1\nmode 200 x 1 1 1\n' >broken.body
    refuse 1 "broken.body:2: found 'x', expected a Q from" render --body broken.body note.mid out/a.wav
    refuse 1 'nowhere.body:1: found no text (No such file or directory)' render --body nowhere.body note.mid out/a.wav
    refuse 2 'found --body for a scene' render --body broken.body a.scene out/a.wav
    test ! -e out/a.wav || fail "a broken body leaves a sound"
}

broken_scales_are_refused() {
    printf 'two\n2\n3/2\nsecond\n' >broken.scl
    refuse 1 "broken.scl:4: found 'second', expected pitch 2 of 2" render --scale broken.scl note.mid out/a.wav
    refuse 1 'nowhere.scl:1: found no text (No such file or directory)' render --scale nowhere.scl note.mid out/a.wav
    refuse 2 'found --scale for a scene' render --scale broken.scl a.scene out/a.wav
    test ! -e out/a.wav || fail "a broken scale leaves a sound"
}

the_demo_is_music() {
    render --tail 1 --rate 16000 "$HOOKE_SOURCE/doc/demo.mid" out/demo.wav || return
    grep -q 'peak' log || fail "the demo is silent: '$(cat log)'"
}

for claim in \
    writes_a_stereo_wav_of_floats \
    the_rate_is_what_was_asked_for \
    the_ending_chooses_the_format \
    the_depth_is_what_was_asked_for \
    block_size_does_not_change_the_file \
    a_quarter_of_a_second_of_silence_is_the_end \
    the_tail_is_as_long_as_asked_for \
    the_tail_ends_80_dB_below_the_peak \
    the_tail_is_a_minute_at_most \
    settings_are_heard \
    presets_are_listed_and_found \
    the_length_is_the_songs \
    a_wav_file_too_long_is_refused_at_once \
    rates_that_a_file_cannot_have_are_refused_with_the_options \
    blemishes_are_played_with_a_line_for_each_kind \
    broken_songs_are_refused \
    options_may_stand_anywhere_before_two_dashes \
    broken_commands_are_refused \
    settings_out_of_range_are_refused \
    plugins_that_are_not_there_are_refused \
    a_failure_leaves_the_old_file_alone \
    the_plugin_beside_the_program_is_found \
    help_and_version_are_answers \
    files_tune_both_instruments \
    the_body_of_a_file_is_heard \
    broken_bodies_are_refused \
    broken_scales_are_refused \
    the_demo_is_music; do
    echo "$claim"
    rm -rf out
    mkdir out
    $claim || fail "$claim"
done

test $n_failed -eq 0
