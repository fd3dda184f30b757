#!/bin/sh
#
# Controls and presets by name: what --set takes, what is meant by a name that is none, and what there is to choose from.

set -u

. "$HOOKE_SOURCE/tests/support/claims.sh"

printf 'MThd\0\0\0\006\0\0\0\001\001\340MTrk\0\0\0\014\0\220\074\144\203\140\074\0\0\377\057\0' >note.mid

# sets SETTING OTHER: both are the same sound.
sets() {
    render --quiet --tail 0 --rate 8000 --set "$1" note.mid out/a.wav && render --quiet --tail 0 --rate 8000 --set "$2" note.mid out/b.wav || return
    cmp out/a.wav out/b.wav || fail "--set $1 is not --set $2"
}

choices_have_names() {
    for pair in Pluck:0 Strike:1 Bow:2 strike:1 BOW:2; do
        sets exciter="${pair%:*}" exciter="${pair#*:}"
    done
    sets partials=lumped partials=0
    sets 'sense=Bridge Force' sense=2
    render --quiet --tail 0 --rate 8000 --set exciter=bow note.mid out/a.wav && render --quiet --tail 0 --rate 8000 note.mid out/b.wav || return
    ! cmp -s out/a.wav out/b.wav || fail 'a bow sounds like a finger'
    refuse 2 "exciter: found 'bwo', expected one of 0 Pluck, 1 Strike, 2 Bow" render --set exciter=bwo note.mid out/x.wav
    refuse 2 "exciter: found '3', expected a whole number from 0 to 2" render --set exciter=3 note.mid out/x.wav
}

switches_are_on_or_off() {
    for pair in off:0 on:1 Off:0 TRUE:1 false:0 yes:1 No:0; do
        sets enabled="${pair%:*}" enabled="${pair#*:}"
    done
    render --tail 0 --set enabled=off note.mid out/a.wav && grep -q silent log || fail 'what is off can be heard'
    refuse 2 "limiter: found 'of', expected one of 0 off, 1 on" render --set limiter=of note.mid out/x.wav
    refuse 2 "level: found 'off', expected a number from -60 to 12" render --set level=off note.mid out/x.wav
}

scores_take_names_too() {
    printf 'set limiter off\nset partials lumped\n0 pluck 6\n' >named.score
    printf 'set limiter 0\nset partials 0\n0 pluck 6\n' >numbered.score
    render --tail 0.2 named.score out/a.wav && render --tail 0.2 numbered.score out/b.wav || return
    cmp out/a.wav out/b.wav || fail 'names in a score mean something else'
    printf 'set relase 1\n0 pluck 6\n' >bad.score
    refuse 1 "bad.score:1: found 'relase', expected the symbol of a control input, which --list-controls names; did you mean release?" \
        render bad.score out/x.wav
}

what_was_meant_is_asked() {
    refuse 2 "hooke render: --set: found 'relase', expected the symbol of a control input, which --list-controls names; did you mean release?" \
        render --set relase=3 note.mid out/x.wav
    refuse 2 'did you mean Concert Harp?' render --preset 'Conzert Harp' note.mid out/x.wav
    refuse 2 'did you mean Concert Harp?' render --preset concert note.mid out/x.wav
    refuse 2 "hooke render: no option '--normalise=-3'; try hooke help; did you mean --normalize?" render --normalise=-3 note.mid out/x.wav
    refuse 2 "hooke render: no option '--list'; try hooke help; did you mean --list-presets?" render --list
    refuse 2 "hooke tune: no option '--frq'; try hooke help; did you mean --freq?" tune --frq 440
    refuse 2 'did you mean --version?' version
    refuse 2 "hooke: found 'render' too, expected one command" help tune render
    refuse 1 "plugin 'guitar': found no URI, expected one, as urn:hooke:guitar" render --plugin guitar note.mid out/x.wav
    refuse 2 'hooke: found '\''rendr'\'', expected a command, render, modes, body, tune or bench; try hooke --help; did you mean render?' rendr
    refuse 2 "found 'bridges', expected the symbol of a control input, which --list-controls names" render --set bridges=1 note.mid out/x.wav
    ! grep -q 'did you mean' errors || fail "what is far away was meant: '$(cat errors)'"
}

presets_of_others_are_told_as_theirs() {
    refuse 2 "no preset named 'Clean Neck' among 43; --list-presets names them; this one is of --plugin urn:hooke:guitar" \
        render --preset 'Clean Neck' note.mid out/x.wav
    echo '0 pluck 6' >one.score
    refuse 2 'this one is of --plugin urn:hooke:strings' render --preset 'felt piano' one.score out/x.wav
    render --tail 0 --rate 8000 --plugin urn:hooke:guitar --preset 'Clean Neck' note.mid out/a.wav
}

# Of each plugin: what can be set is named, with the numbers that are said to be its range, and nothing else is.
controls_are_listed_with_what_they_take() {
    for plugin in urn:hooke:strings urn:hooke:guitar; do
        answer 0 render --list-controls --plugin $plugin
        tail -n +2 log >controls
        test "$(wc -l <controls)" -ge 20 || fail "of $plugin only $(cat controls)"
        while read -r symbol least most usual rest; do
            for value in "$least" "$most" "$usual"; do
                render --quiet --tail 0 --rate 4000 --plugin $plugin --set "$symbol=$value" note.mid out/a.ogg
            done
        done <controls
        awk '/lv2:InputPort/ { is_input = 1 } is_input && /lv2:ControlPort/ { is_control = 1 }
            is_control && /lv2:symbol/ { gsub(/[";]/, ""); print $2; is_input = is_control = 0 }
            /lv2:OutputPort/ { is_input = 0 }' "$HOOKE_SOURCE/ttl/${plugin##*:}.ttl" | sort >told
        test "$(wc -l <told)" -ge 20 || fail "$plugin.ttl has only $(cat told)"
        cut -d ' ' -f 1 controls | sort | diff - told || fail "of $plugin other controls are listed"
    done
    "$HOOKE_BIN" render --list-controls | grep -Eq '^tuning +400 +480 +440 +Hz$' || fail 'the tuning is not in Hz'
    "$HOOKE_BIN" render --list-controls | grep -Eq '^exciter +0 +2 +0 +0 Pluck, 1 Strike, 2 Bow$' || fail 'exciters are not named'
    "$HOOKE_BIN" render --list-controls | grep -Eq '^limiter +0 +1 +1 +0 off, 1 on$' || fail 'the limiter is no switch'
}

for claim in \
    choices_have_names \
    switches_are_on_or_off \
    scores_take_names_too \
    what_was_meant_is_asked \
    presets_of_others_are_told_as_theirs \
    controls_are_listed_with_what_they_take; do
    echo "$claim"
    rm -rf out
    mkdir out
    $claim || fail "$claim"
done

test $n_failed -eq 0
