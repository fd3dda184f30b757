#!/bin/sh
#
# A render that does not get to its end leaves nothing, whatever ends it, and says why.

set -u

. "$HOOKE_SOURCE/tests/support/claims.sh"

printf 'MThd\0\0\0\006\0\0\0\001\001\340MTrk\0\0\0\014\0\220\074\144\203\140\074\0\0\377\057\0' >note.mid

# begin [PROGRAM ARGUMENT...]: an endless render, under that program, as far as its unfinished file; `child` is its number.
begin() {
    ASAN_OPTIONS=handle_segv=0:handle_abort=0:handle_sigbus=0:handle_sigfpe=0:handle_sigill=0 \
        "$@" "$HOOKE_BIN" render --tail 3600 --bits 16 note.mid out/endless.flac >log 2>errors &
    child=$!
    tries=0
    until ls out/endless.flac.*.part >names 2>&1; do
        tries=$((tries + 1))
        test $tries -lt 100 || break
        sleep 0.1
    done
    test $tries -lt 100 || fail "no unfinished file to be seen: $(cat errors)"
}

# ends STATUS WHAT: so the render does, and leaves nothing.
ends() {
    wait $child 2>log
    same $? "$1" "status after $2"
    child=
    same "$(ls out)" '' "left after $2"
    rm -f out/*
}

# A shell lets what it starts beside itself ignore SIGINT and SIGQUIT.
what_can_be_caught_leaves_nothing() {
    for name in HUP:1 INT:2 QUIT:3 ILL:4 ABRT:6 BUS:7 FPE:8 USR1:10 SEGV:11 USR2:12 PIPE:13 ALRM:14 TERM:15 XCPU:24 \
        VTALRM:26 PROF:27 SYS:31; do
        begin env --default-signal
        kill -${name%:*} $child
        ends $((128 + ${name#*:})) SIG${name%:*}
    done
}

what_is_ignored_ends_nothing() {
    begin env --default-signal --ignore-signal=HUP,INT,XFSZ
    for name in HUP INT XFSZ; do
        kill -$name $child
    done
    sleep 0.3
    kill -0 $child || fail 'ended by what it was to ignore'
    ls out/endless.flac.*.part >names 2>&1 || fail 'removed by what it was to ignore'
    kill -TERM $child
    ends 143 SIGTERM
    begin env --default-signal
    kill -XFSZ $child
    sleep 0.3
    kill -TERM $child
    ends 143 'SIGXFSZ, which its write is told'
}

files_that_may_not_grow_are_told() {
    for ending in wav flac ogg; do
        (ulimit -f 8 && exec "$HOOKE_BIN" render --tail 5 note.mid out/a.$ending) >log 2>errors
        same "$? $(cat errors)" "1 hooke render: out/a.$ending: sound not written: File too large" 'a limit of files'
        same "$(ls out)" '' 'left by a limit of files'
    done
}

# What an encoder keeps to itself is written when its file is closed: that can fail as well.
the_last_bytes_are_looked_after() {
    printf 'rate 8000\nmass a 1\nground g\nspring a g 5e6\nat 0 displace a 1\npickup a 1\nend 0.4\n' >short.scene
    for ending in flac ogg; do
        render short.scene out/a.$ending || return
        whole=$(wc -c <out/a.$ending)
        rm out/a.$ending
        for blocks in $(seq 1 $((whole / 512))); do
            (ulimit -f "$blocks" && exec "$HOOKE_BIN" render short.scene out/a.$ending) >log 2>errors
            same "$? $(sed 's/sound not written: //' errors)" "1 hooke render: out/a.$ending: File too large" "$blocks blocks of $whole bytes"
        done
        same "$(ls out)" '' 'left by a limit of files'
    done
}

# The processor's time: the soft limit is a signal that can be caught.
time_that_is_up_leaves_nothing() {
    (ulimit -S -t 1 && exec "$HOOKE_BIN" render --tail 3600 --bits 16 note.mid out/a.flac) >log 2>errors
    same $? 152 'status when time is up'
    same "$(ls out)" '' 'left when time is up'
}

# within KIB ARGUMENT...: whether hooke can do it with so much memory; if not, it says so.
within() {
    limit=$1
    shift
    (ulimit -c 0 && ulimit -v "$limit" && exec "$HOOKE_BIN" "$@") >log 2>errors
    status=$?
    test $status -ne 0 || return 0
    tail -n 1 errors | grep -q 'out of memory$' || fail "$* with $limit KiB: $(cat errors)"
    same $status 1 "status of $* with $limit KiB"
    return 1
}

# From what does not to what does: a limit is told as such and never ends in a signal, once hooke and its libraries have
# room for themselves.
memory_that_is_out_is_told() {
    if test -n "${HOOKE_SLOWDOWN-}" || grep -q __asan_init "$HOOKE_BIN"; then
        echo 'not tried: valgrind and sanitizers have terabytes of addresses'
        return
    fi
    n_told=0
    least=20000
    cp "$HOOKE_SOURCE/doc/coupled.scene" one.scene
    { echo 'rate 8000' && echo 'string s 3000 mass 1 stiffness 1 damping 0.1' && echo 'pickup s.1 1' && echo 'end 0.1'; } >big.scene
    until (ulimit -c 0 && ulimit -v $least && "$HOOKE_BIN" --version || exit 1) >log 2>&1; do
        least=$((least + 250))
        test $least -lt 1000000 || break
    done
    for what in 'render --tail 0 note.mid out/a.wav' 'render --tail 0 note.mid out/a.ogg' 'render one.scene out/a.flac'; do
        kib=$least
        while test $kib -lt 200000 && ! within $kib $what; do
            n_told=$((n_told + 1))
            kib=$((kib + 500))
        done
    done
    within $((least + 8000)) modes big.scene && fail '3000 masses need no memory'
    test $n_told -gt 0 || fail 'memory was never out'
    rm -f out/*
}

# In a mount of its own: a disk of 16 KiB, and one that can be read alone.
disks_that_are_full_are_told() {
    mkdir disk
    cat >on_disk.sh <<'END'
mount -t tmpfs -o size=16k none disk 2>mounted || exit 77
for ending in wav flac ogg; do
    "$HOOKE_BIN" render --tail 5 note.mid disk/a.$ending 2>&1
    echo "$? $(ls disk)"
done
mount -o remount,ro disk
"$HOOKE_BIN" render --tail 5 note.mid disk/a.wav 2>&1
echo $?
END
    unshare --mount sh on_disk.sh >said 2>errors || unshare --map-root-user --mount sh on_disk.sh >said 2>errors || {
        echo "no disks tried: nothing can be mounted here: $(cat errors mounted 2>&1 | head -n 1)"
        return
    }
    cat >expected <<'END'
hooke render: disk/a.wav: sound not written: No space left on device
1 
hooke render: disk/a.flac: sound not written: No space left on device
1 
hooke render: disk/a.ogg: sound not written: No space left on device
1 
hooke render: disk/a.wav: Read-only file system
1
END
    diff said expected || fail 'disks that are full'
}

for claim in \
    what_can_be_caught_leaves_nothing \
    what_is_ignored_ends_nothing \
    files_that_may_not_grow_are_told \
    the_last_bytes_are_looked_after \
    time_that_is_up_leaves_nothing \
    memory_that_is_out_is_told \
    disks_that_are_full_are_told; do
    echo "$claim"
    rm -rf out
    mkdir out
    $claim || fail "$claim"
done

test $n_failed -eq 0
