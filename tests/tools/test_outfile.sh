#!/bin/sh
#
# Where `hooke render` writes to: files, links, pipes and devices, what cannot be written, and why.

set -u

. "$HOOKE_SOURCE/tests/support/claims.sh"

printf 'MThd\0\0\0\006\0\0\0\001\001\340MTrk\0\0\0\014\0\220\074\144\203\140\074\0\0\377\057\0' >note.mid
render --tail 0 note.mid note.wav || exit 1

# sound FILE WHAT: the file has the note in it, to the bit.
sound() {
    cmp "$1" note.wav || fail "$2"
}

# as_user ARGUMENT...: hooke without what lets root into everything.
as_user() {
    if test "$(id -u)" -eq 0; then
        setpriv --bounding-set -dac_override,-dac_read_search "$HOOKE_BIN" "$@"
    else
        "$HOOKE_BIN" "$@"
    fi
}

# denies TEXT ARGUMENT...: refuse 1, without root's rights.
denies() {
    text=$1
    shift
    as_user "$@" >log 2>errors
    status=$?
    same "$status $(cat errors)" "1 hooke render: $text" "hooke $*"
}

an_old_file_keeps_its_mode() {
    for mode in 600 640 664 444; do
        echo old >out/a.wav
        chmod $mode out/a.wav
        (umask 077 && render --tail 0 note.mid out/a.wav) || test $mode = 444 || return
        same "$(stat -c %a out/a.wav)" $mode 'mode of an old file'
        chmod 600 out/a.wav
        rm out/a.wav
    done
    (umask 027 && render --tail 0 note.mid out/b.wav) || return
    same "$(stat -c %a out/b.wav)" 640 'mode of a new file'
    sound out/b.wav 'a new file is another'
}

a_file_that_may_not_be_written_is_left_alone() {
    echo old >out/a.wav
    chmod 444 out/a.wav
    denies 'out/a.wav: Permission denied' render --tail 0 note.mid out/a.wav
    same "$(cat out/a.wav)" old 'what may not be written'
    mkdir out/closed
    chmod 555 out/closed
    denies 'out/closed/a.wav: Permission denied' render --tail 0 note.mid out/closed/a.wav
    chmod 755 out/closed
    mkdir out/dark
    chmod 000 out/dark
    denies 'out/dark/a.wav: Permission denied' render --tail 0 note.mid out/dark/a.wav
    chmod 755 out/dark
}

the_true_reason_is_told() {
    : >out/file
    refuse 1 'out/file/a.wav: Not a directory' render note.mid out/file/a.wav
    refuse 1 'nowhere/a.wav: No such file or directory' render note.mid nowhere/a.wav
    ln -s round.wav out/round.wav
    refuse 1 'out/round.wav: Too many levels of symbolic links' render note.mid out/round.wav
    # The same process under another name: it is its number that is taken.
    sh -c ': >"out/a.wav.$$.part" && exec "$HOOKE_BIN" render note.mid out/a.wav' >log 2>errors
    status=$?
    part=$(echo out/a.wav.*.part)
    same "$status $(cat errors)" "1 hooke render: $part: File exists" 'an unfinished file of somebody else'
    test -e "$part" || fail "removed $part, which is somebody else's"
}

a_directory_is_told_as_one() {
    mkdir out/dir out/dir.wav
    for place in out/dir out/dir.wav . /; do
        refuse 2 "hooke render: $place: found a directory, expected a file that ends in .wav" render note.mid $place
    done
}

names_may_be_as_long_as_the_system_has_them() {
    for length in 240 244 245 250 255; do
        name=$(printf "%0$((length - 4))d.wav" 0)
        render --tail 0 note.mid "out/$name" || continue
        sound "out/$name" "a name of $length bytes"
        rm "out/$name"
        same "$(ls out)" '' "beside a name of $length bytes"
    done
    name=$(printf '%0252d.wav' 0)
    refuse 1 "$name: File name too long" render note.mid "out/$name"
    refuse 1 ': File name too long' render note.mid "$(printf '%05000d' 0 | sed 's|0|a/|g')x.wav"
}

links_are_followed() {
    mkdir out/there
    echo old >out/there/old.wav
    chmod 640 out/there/old.wav
    ln -s there/old.wav out/link.wav
    ln -s "$PWD/out/link.wav" out/there/link.wav
    ln -s there/new.wav out/dangling.wav
    render --tail 0 note.mid out/there/link.wav && render --tail 0 note.mid out/dangling.wav || return
    for link in out/link.wav out/there/link.wav out/dangling.wav; do
        test -L $link || fail "$link is a link no more"
    done
    sound out/there/old.wav 'a link to a link'
    sound out/there/new.wav 'a link to nothing yet'
    same "$(stat -c %a out/there/old.wav)" 640 'mode behind a link'
    same "$(ls out/there | tr '\n' ' ')" 'link.wav new.wav old.wav ' 'files behind links'
}

pipes_get_the_whole_sound() {
    mkfifo out/pipe.wav
    cat out/pipe.wav >out/heard.wav &
    child=$!
    render --tail 0 note.mid out/pipe.wav
    wait $child
    child=
    test -p out/pipe.wav || fail 'the pipe is none any more'
    sound out/heard.wav 'what came out of a pipe'
    ln -s pipe.wav out/link.wav
    cat out/pipe.wav >out/heard.wav &
    child=$!
    render --tail 0 note.mid out/link.wav
    wait $child
    child=
    sound out/heard.wav 'what came out of a pipe behind a link'
}

stdout_gets_the_sound_alone() {
    "$HOOKE_BIN" render --tail 0 note.mid /dev/stdout 2>errors | cat >out/a.wav
    sound out/a.wav 'a pipe at stdout'
    grep -q '^/dev/stdout: 0\.50 s, peak' errors || fail "said nothing of it: '$(cat errors)'"
    "$HOOKE_BIN" render --tail 0 note.mid /dev/stdout >out/b.wav 2>errors || fail "a file at stdout: $(cat errors)"
    sound out/b.wav 'a file at stdout'
    { echo before && "$HOOKE_BIN" render --quiet --tail 0 note.mid /dev/stdout && echo after; } >out/c.wav
    { echo before && cat note.wav && echo after; } | cmp - out/c.wav || fail 'a file at stdout loses what else is in it'
}

devices_are_written() {
    render --tail 0 note.mid /dev/null || return
    test -c /dev/null || fail '/dev/null is gone'
    refuse 1 'hooke render: /dev/full: No space left on device' render --tail 0 note.mid /dev/full
    ln -s /dev/full out/full.flac
    refuse 1 'hooke render: out/full.flac: No space left on device' render --tail 0 note.mid out/full.flac
}

the_input_is_no_output() {
    cp note.mid out/a.wav
    ln out/a.wav out/b.wav
    ln -s a.wav out/c.wav
    for name in a b c; do
        refuse 2 "hooke render: out/$name.wav: found the input itself, expected another file" render out/a.wav out/$name.wav
    done
    cmp out/a.wav note.mid || fail 'the input is no more what it was'
}

# The sound is in none of the places where something could be said, be they closed.
closed_descriptors_are_no_files() {
    "$HOOKE_BIN" render --tail 0 note.mid out/a.wav >log 2>&- <&- || fail "status $? with stderr closed"
    sound out/a.wav 'the sound of one who cannot warn'
    "$HOOKE_BIN" render --quiet --tail 0 note.mid out/b.wav >&- 2>errors || fail "status $? with stdout closed: $(cat errors)"
    sound out/b.wav 'the sound of one who cannot say anything'
    "$HOOKE_BIN" render --tail 3600 --bits 16 note.mid out/endless.flac >log 2>&- &
    child=$!
    tries=0
    until ls out/endless.flac.*.part >names 2>&1; do
        tries=$((tries + 1))
        test $tries -lt 100 || break
        sleep 0.1
    done
    readlink /proc/$child/fd/* >open 2>errors
    grep -q 'part$' open || fail "no unfinished file among $(cat open)"
    readlink /proc/$child/fd/2 | grep -q 'part$' && fail 'what is warned of goes into the sound'
    kill -TERM $child
    wait $child 2>errors
    child=
}

for claim in \
    an_old_file_keeps_its_mode \
    a_file_that_may_not_be_written_is_left_alone \
    the_true_reason_is_told \
    a_directory_is_told_as_one \
    names_may_be_as_long_as_the_system_has_them \
    links_are_followed \
    pipes_get_the_whole_sound \
    stdout_gets_the_sound_alone \
    devices_are_written \
    the_input_is_no_output \
    closed_descriptors_are_no_files; do
    echo "$claim"
    rm -rf out
    mkdir out
    $claim || fail "$claim"
done

test $n_failed -eq 0
