#!/bin/sh
#
# How loud a file is, and what is said of one that is too loud, hardly heard or nothing at all.

set -u

. "$HOOKE_SOURCE/tests/support/claims.sh"

cat >soft.scene <<'END'
rate 8000
mass a 1
ground g
spring a g 1e5
at 0 displace a 0.001
pickup a 1
end 0.5
END
printf 'MThd\0\0\0\006\0\0\0\001\001\340MTrk\0\0\0\014\0\220\074\144\203\140\074\0\0\377\057\0' >note.mid

# Its samples, of a WAV file of floats.
samples() {
    test "$(dd if="$1" bs=1 skip=80 count=4 2>log)" = data || fail "where is the sound of $1?" >&2
    od -A n -v -t f4 -j 88 "$1"
}

# The greatest of them.
peak() {
    samples "$1" | awk '{ for (i = 1; i <= NF; ++i) { x = $i < 0 ? -$i : $i; if (x > p) p = x } } END { print p }'
}

# scaled FILE FACTOR: out/as_it_is.wav, times that.
scaled() {
    near "$(peak "$1")" "$(awk -v p="$(peak out/as_it_is.wav)" -v f="$2" 'BEGIN { print p * f }')" 1e-5 "peak of $1"
}

a_gain_is_in_decibels() {
    render --quiet soft.scene out/as_it_is.wav || return
    for db in 0 6 -20 40; do
        render --quiet --gain $db soft.scene out/a.wav || return
        scaled out/a.wav "$(awk -v db=$db 'BEGIN { print 10 ^ (db / 20) }')"
    done
    render --quiet --gain 0 soft.scene out/b.wav && cmp out/b.wav out/as_it_is.wav || fail '0 dB changes the sound'
}

# Of a song as well, whose tail is the same whatever the gain.
a_peak_is_brought_to_where_it_is_wanted() {
    for what in soft.scene note.mid; do
        for db in '' =-1 '=0' '=-12.5' ' -6'; do
            render --normalize$db $what out/a.wav || return
            wanted=${db#?}
            near "$(peak out/a.wav)" "$(awk -v db="${wanted:--1}" 'BEGIN { print 10 ^ (db / 20) }')" 1e-5 "peak of $what with --normalize$db"
            test ! -s errors || fail "--normalize$db: $(cat errors)"
        done
    done
    render --quiet note.mid out/as_it_is.wav && render --quiet --normalize note.mid out/a.wav || return
    same "$(wc -c <out/a.wav)" "$(wc -c <out/as_it_is.wav)" 'length with --normalize'
    render --quiet --bits 16 --normalize=0 note.mid out/b.wav && render --bits 16 --normalize=0 note.mid out/c.wav || return
    cmp out/b.wav out/c.wav || fail 'two runs differ'
    test ! -s errors || fail "0 dBFS is not above full scale: $(cat errors)"
}

silence_stays_silent() {
    printf 'MThd\0\0\0\006\0\0\0\001\001\340MTrk\0\0\0\004\0\377\057\0' >rest.mid
    render --normalize rest.mid out/a.wav || return
    grep -q silent log || fail "'$(cat log)'"
    test ! -s errors || fail "of silence: $(cat errors)"
}

# One mass is a cosine of 1/50 s: full scale is exceeded by 6.02 dB, at the same samples in whole numbers of any kind.
what_is_clipped_is_said() {
    render --gain 66.0206 soft.scene out/f.wav || return
    test ! -s errors || fail "floats are not clipped: $(cat errors)"
    n=$(samples out/f.wav | awk '{ for (i = 1; i <= NF; ++i) n += $i > 1 || $i < -1 } END { print n }')
    for what in '16 a.wav' '24 a.wav' '16 a.flac' '24 a.flac'; do
        render --bits "${what% *}" --gain 66.0206 soft.scene "out/${what#* }" || return
        same "$(cat errors)" "hooke render: out/${what#* }: clipped $n samples, the loudest 6.0 dB above full scale" "$what"
    done
    render --gain 66.0206 soft.scene out/b.flac || return
    grep -q "clipped $n samples" errors || fail 'a FLAC file of its usual depth'
    render --gain 66.0206 soft.scene out/b.ogg || return
    test ! -s errors || fail "an Ogg file is not clipped: $(cat errors)"
    render --quiet --bits 16 --gain 66.0206 soft.scene out/c.wav || return
    test ! -s errors || fail "--quiet, and yet $(cat errors)"
}

what_is_hardly_heard_is_said() {
    render soft.scene out/a.wav || return
    same "$(cat errors)" 'hooke render: out/a.wav: found a peak of -60.0 dBFS, which is hardly heard; try --normalize' 'a soft scene'
    render --gain 21 soft.scene out/a.wav || return
    test ! -s errors || fail "of -39 dBFS: $(cat errors)"
}

one_way_to_be_louder_is_enough() {
    refuse 2 'found --gain and --normalize, expected one of them' render --gain 1 --normalize soft.scene out/x.wav
    refuse 2 "--gain: found 'loud', expected a number from -200 to 200" render --gain loud soft.scene out/x.wav
    refuse 2 "--normalize: found '1', expected a number from -100 to 0" render --normalize=1 soft.scene out/x.wav
    refuse 2 "--normalize: found '1e3', expected a number from -100 to 0" render --normalize 1e3 soft.scene out/x.wav
}

for claim in \
    a_gain_is_in_decibels \
    a_peak_is_brought_to_where_it_is_wanted \
    silence_stays_silent \
    what_is_clipped_is_said \
    what_is_hardly_heard_is_said \
    one_way_to_be_louder_is_enough; do
    echo "$claim"
    rm -rf out
    mkdir out
    $claim || fail "$claim"
done

test $n_failed -eq 0
