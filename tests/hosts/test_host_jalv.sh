#!/bin/sh
#
# jalv plays both plugins on a JACK server of its own: live and faster than time, with presets and with states from a directory.

set -u

. "$HOOKE_SOURCE/tests/hosts/claims.sh"

needs jalv jalv
needs jackd jackd2
needs jack_lsp jackd2
needs python3 python3

JACK_NO_AUDIO_RESERVATION=1
JACK_NO_START_SERVER=1
export JACK_NO_AUDIO_RESERVATION JACK_NO_START_SERVER

period=256
seconds=4.5
hanging=9 # how a try ends in which JACK hangs
server= # the processes
host=
open=

# Ended, or about to be taken note of
is_gone() {
    case $(sed 's/.*) //; s/ .*//' "/proc/$1/stat" 2>/dev/null) in
    '' | Z) return 0 ;;
    *) return 1 ;;
    esac
}

# finish PROCESS...: what we have started ends, by force if need be; false where it was.
finish() {
    kill "$@" 2>/dev/null
    forced=0
    for process in "$@"; do
        for _ in $(seq 100); do
            is_gone "$process" && break
            sleep 0.1
        done
        is_gone "$process" || forced=1
        kill -KILL "$process" 2>/dev/null
        wait "$process" 2>/dev/null
    done
    return $forced
}

end_host() {
    ended=0
    test -z "$host" || finish "$host" "$open" || ended=1
    host=
    open=
    return $ended
}

# A host that cannot leave JACK has freed no plugin, and nothing is told of what it did.
stop_host() {
    end_host || give_up_jack
}

stop() {
    end_host
    test -z "$server" || finish "$server"
    server=
    rm -f "/dev/shm/jack_${JACK_DEFAULT_SERVER}_"* /dev/shm/jack_sem.*_"${JACK_DEFAULT_SERVER}_"*
}

# Once in a while its server comes to a stand for good, whatever its clients are.
give_up_jack() {
    echo '    JACK hangs'
    exit $hanging
}

# wait_until COMMAND...: at most as long as a host may take
wait_until() {
    for _ in $(seq $((10 * patience))); do
        "$@" && return 0
        sleep 0.1
    done
    return 1
}

ports() {
    timeout --foreground -k 1 20 jack_lsp 2>/dev/null
    test $? -ne 124 || give_up_jack
}

# A server that waits for its clients, for a busy machine is no faulty one.
start_server() {
    jackd -n "$JACK_DEFAULT_SERVER" -r -S -t 5000 -d dummy -r 48000 -p $period -C 0 -P 2 >server.log 2>&1 &
    server=$!
    wait_until server_answers || fail "jackd does not start: $(cat server.log)"
}

server_answers() {
    ports >listed && test -s listed
}

# start_host URI ARGUMENT...: its commands go to the file `orders`, and what it says to `said`.
start_host() {
    uri=$1
    shift
    rm -f orders
    mkfifo orders
    sleep 3600 >orders & # or the first command would be its last
    open=$!
    HOOKE_WATCH_LOG=$dir/watched LD_PRELOAD=$built/watch.so jalv -x -n dut "$@" "$uri" <orders >said 2>&1 &
    host=$!
    wait_until host_is_there || fail "jalv does not start: $(cat said)"
}

host_is_there() {
    ports >listed
    grep -q '^dut:' listed || is_gone "$host"
}

# order LINE...: to the host; then all its values are in `values`.
order() {
    if is_gone "$host"; then
        fail "jalv has ended: $(cat said)"
        return
    fi
    before=$(grep -c '^stability_used = ' said)
    printf '%s\n' "$@" controls monitors >orders
    wait_until has_answered "$before" || fail "jalv does not obey '$*': $(cat said)"
    tac said | awk '/^> level = / { print; exit } /^(> )?[a-z0-9_]+ = / { print }' | sed 's/^> //' >values
}

has_answered() {
    test "$(grep -c '^stability_used = ' said)" -gt "$1"
}

# play OUT [freewheel]: the song, to the host
play() {
    timeout --foreground -k 1 60 "$built/player" dut song.mid "$@" >played 2>&1
    case $? in
    0) ;;
    124) give_up_jack ;;
    *) fail "player: $(cat played)" ;;
    esac
    echo "    $1: $(cat played)"
}

# keep URI PRESET SYMBOL=VALUE...: a state as jalv reads it, in the directory `state`
keep() {
    uri=$1
    preset=$2
    shift 2
    rm -rf state
    "$built/keep" "$uri" "$preset" state "$@" || fail "no state of $uri"
}

# value SYMBOL: the newest, for what was told before may stand there as well
value() {
    awk -v symbol="$1" '$1 == symbol { print $3; exit }' values
}

# render_song OUT SYMBOL=VALUE...: what our own renderer makes of the song
render_song() {
    out=$1
    shift
    set -- $(printf -- '--set %s ' "$@")
    render song.mid "$out" --plugin "$uri" --preset "$preset" --tail 2 --quiet "$@"
}

# The state has a preset and two values beside it, and another is set while it runs.
plays_with_a_state() {
    keep "$1" "$2" masses=100 damping=1
    start_host "$uri" -l state
    order 'set release 0.05'
    same "$(value masses) $(value damping) $(value release)" '100.000000 1.000000 0.050000' 'values beside the preset'
    same "$(value hardness)" "$3" 'a value of the preset'
    render_song rendered.wav masses=100 damping=1 release=0.05
    play live.wav $seconds
    alike 'what is played live' rendered.wav live.wav 0 $heard "$late"
    play fast.wav $seconds freewheel
    alike 'what is played faster than time' rendered.wav fast.wav 0 $heard "$late"
    in_tune 'what is played live' live.wav 0.2 2.2 110 "$(awk -v t="$(value tracking)" 'BEGIN { printf "%.9g", 2 ^ (2 * t) }')"
    order 'set damping 6'
    render_song rendered.wav masses=100 damping=6 release=0.05
    play again.wav $seconds freewheel
    alike 'what is played after a change' rendered.wav again.wav 0 $heard "$late"
    stop_host
}

hooke_strings_is_played_live_and_faster_than_time() {
    plays_with_a_state urn:hooke:strings 'Concert Harp' 0.450000
}

hooke_guitar_is_played_live_and_faster_than_time() {
    plays_with_a_state urn:hooke:guitar 'Clean Bridge' 0.800000
}

# Key 45 is 24 of 19 equal steps below A4.
a_state_brings_its_tuning_file_back() {
    keep urn:hooke:strings Default damping=1 release=0.05 scale="$HOOKE_SOURCE/tests/scales/19-equal.scl"
    start_host "$uri" -l state
    play tuned.wav $seconds freewheel
    in_tune 'with the file of the state' tuned.wav 0.2 2.2 "$(awk 'BEGIN { printf "%.9g", 440 * 2 ^ (-24 / 19) }')" 2
    stop_host
}

jalv_lists_all_presets() {
    for plugin in strings guitar; do
        start_host urn:hooke:$plugin
        order presets
        sed -n 's/^\(> \)*urn:hooke:[^ ]* (\(.*\))$/\2/p' said | sort >found
        "$HOOKE_BIN" render --list-presets --plugin urn:hooke:$plugin | sort >expected
        test "$(grep -c . found)" -gt 9 || fail "found $(cat found)"
        cmp found expected || fail "$(diff found expected)"
        stop_host
    done
}

no_run_does_what_an_audio_thread_must_not() {
    grep -v 'peak=0 ' watched >heard
    mv heard watched
    watched urn:hooke:strings 2
    watched urn:hooke:guitar 1
}

# A plugin that does all of it, in the same host and before the same watch
the_watch_sees_what_is_planted() {
    mkdir -p bundles/plant.lv2
    cp "$hosts/plant.ttl" bundles/plant.lv2/manifest.ttl
    cp "${built%/hosts}/plant_host.so" bundles/plant.lv2
    LV2_PATH=$dir/bundles:$LV2_PATH
    start_host urn:hooke:plant
    play nothing.wav 0.5 freewheel
    stop_host
    told=$(grep '^urn:hooke:plant ' watched)
    echo "    $told"
    for kind in heap lock system floats; do
        case $kind$(uname -sm) in
        system'Linux x86_64' | floats*x86_64 | heap* | lock*) echo "$told" | grep -q "$kind=[1-9]" || fail "$kind is not seen" ;;
        esac
    done
}

late=$(awk -v p=$period 'BEGIN { printf "%.9f", p / 48000 }') # What is sent is answered in the next period
heard=3.9
python3 "$hosts/song.py" 0 song.mid || fail 'there is no song'

# In a shell of its own, for it may end early
play_all() (
    trap stop EXIT
    start_server
    for claim in \
        hooke_strings_is_played_live_and_faster_than_time \
        hooke_guitar_is_played_live_and_faster_than_time \
        a_state_brings_its_tuning_file_back \
        jalv_lists_all_presets \
        no_run_does_what_an_audio_thread_must_not \
        the_watch_sees_what_is_planted; do
        echo "$claim"
        $claim || fail "$claim"
    done
    test $n_failed -eq 0
)

echo "jalv $(dpkg-query -W -f '${Version}' jalv 2>/dev/null), JACK $(dpkg-query -W -f '${Version}' jackd2 2>/dev/null)"
for try in 1 2 3; do
    rm -f watched
    export JACK_DEFAULT_SERVER="hooke-$$-$try"
    play_all
    status=$?
    test $status -eq $hanging || break
done
exit $status
