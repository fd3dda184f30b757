#!/bin/sh
#
# `hooke modes` from the outside: what it says of a scene, how, and what it returns.

set -u

. "$HOOKE_SOURCE/tests/support/claims.sh"

# column NAME: of the CSV in `log`, a line for each mode.
column() {
    awk -F, -v name="$1" 'NR == 1 { for (i = 1; i <= NF; ++i) if ($i == name) c = i; next } { print $c }' log
}

# json EXPRESSION: of the object in `log`, where there is a Python to read it.
json() {
    python3 -c "import json; modes = json.load(open('log')); print($1)"
}

has_python() {
    python3 -c 'import json' 2>errors || {
        echo "no python3: JSON is not parsed"
        return 1
    }
}

cat >string.scene <<'END'
rate 6000
string s 5 mass 1.0 stiffness 28018382.290630583 damping 7.46285773641449
END

# One mass: omega0 = 1000 rad/s, gamma = 2500 1/s, so s = -500 and -2000; and one that never dies.
cat >two.scene <<'END'
rate 48000
mass a 1
mass b 1
ground g
spring a g 1e6
damper a g 2500
spring b g 4e6
END

cat >ring.scene <<'END'
rate 48000
mass b 1
ground g
spring b g 4e6
END

# Dampers so unequal that the paper's rule is wrong: its radius of 0.9756 is 3.72 in truth.
cat >paper.scene <<'END'
rate 1000
mass a 1
mass b 1
ground g
spring a b 1.9e6
spring a g 26000
spring b g 36000
damper a g 2500
END

the_table_is_that_of_the_paper() {
    answer 0 modes string.scene
    for mode in 440.00000 872.76842 1287.45585 1662.75731 1951.81777; do
        grep -qF " $mode " log || fail "no mode of $mode Hz in '$(cat log)'"
    done
    for tau in 1.0000000 0.2678272 0.1338302 0.0891645 0.0716419; do
        grep -qF " $tau " log || fail "no mode of $tau s in '$(cat log)'"
    done
    same "$(grep -c 'vibrates' log)" 5 'modes that vibrate'
    printf 'rate 48000\nmass a 1\nground g\nspring a g 1e6\nend 1\n' >undamped.scene
    "$HOOKE_BIN" modes undamped.scene | grep -q ' 0 ± 1000j' || fail 'what nothing damps has an eigenvalue of -0'
    grep -q '^stable at 6000 Hz; the largest stable step is ' log || fail "no verdict in '$(cat log)'"
    ! grep -q paper log || fail "the paper's rule does not differ here: '$(cat log)'"
}

# The highest mode is one mass: a = h^2 k lambda, g = h Z lambda, lambda = 4 sin^2(5 pi/12); a + 2 g = 4.
the_largest_step_is_that_of_the_highest_mode() {
    answer 0 modes --csv string.scene
    step=$(awk 'BEGIN { l = 2 + sqrt(3); k = 28018382.290630583 * l; z = 7.46285773641449 * l
                        printf "%.15g", (-z + sqrt(z * z + 4 * k)) / k }')
    near "$(column largest_step_s | head -n 1)" "$step" 1e-12 'largest step'
    limit=$(awk -v h="$step" 'BEGIN { printf "%.15g", 1 / h }')
    answer 0 modes --rate "$(awk -v r="$limit" 'BEGIN { printf "%.15g", r * (1 + 1e-9) }')" string.scene
    answer 3 modes --rate "$(awk -v r="$limit" 'BEGIN { printf "%.15g", r * (1 - 1e-9) }')" string.scene
    grep -q '^unstable at ' log || fail "no verdict in '$(cat log)'"
    grep -q 'grows.*unstable$' log || fail "no mode grows in '$(cat log)'"
}

overdamped_and_undamped_modes_are_told() {
    answer 0 modes --csv two.scene
    same "$(column region | tr '\n' ' ')" 'creeps vibrates ' regions
    near "$(column eigenvalue_re | head -n 1)" -500 1e-12 'slower eigenvalue'
    near "$(column eigenvalue2_re | head -n 1)" -2000 1e-12 'faster eigenvalue'
    same "$(column warp_cents | head -n 1)" '' 'warp of what does not vibrate'
    same "$(column stable | tr '\n' ' ')" '1 1 ' stability
    near "$(column frequency_hz | tail -n 1)" 318.33291657 1e-9 'frequency of 2000 rad/s at 48 kHz'
    case $(column tau_s | tail -n 1) in -*) fail "what is stable grows: '$(cat log)'" ;; esac
    answer 0 modes ring.scene
    grep -q 'for ever' log || fail "the undamped mode dies in '$(cat log)'"
    answer 0 modes --csv ring.scene
    same "$(column tau_s)" inf 'time of what does not die'
}

the_paper_is_named_where_it_differs() {
    answer 3 modes paper.scene
    grep -q "^the paper's rule, each eigenvalue by itself, says stable: the largest radius would be 0.9755951[0-9]*, and is 3.719972[0-9]*$" log ||
        fail "'$(cat log)'"
    answer 3 modes --csv paper.scene
    near "$(column frequency_hz | tail -n 1)" 500 1e-12 "frequency of what flips and grows"
    same "$(column all_stable | head -n 1) $(column paper_all_stable | head -n 1)" '0 1' 'two verdicts'
}

only_the_lowest_are_listed() {
    answer 0 modes --csv string.scene
    head -n 3 log | cut -d, -f1-8 >lowest
    answer 0 modes --csv --lowest 2 string.scene
    same "$(wc -l <log | tr -d ' ')" 3 'lines for two modes'
    answer 0 modes --csv --lowest=99 string.scene
    same "$(wc -l <log | tr -d ' ')" 6 'lines for all modes'
    answer 3 modes --lowest 1 --rate 4000 string.scene
    grep -q '^unstable' log || fail "the verdict is of the lowest only: '$(cat log)'"
}

csv_has_as_many_cells_everywhere() {
    for scene in string.scene two.scene; do
        answer 0 modes --csv $scene
        same "$(awk -F, '{ print NF }' log | sort -u)" 15 "cells in a line for $scene"
    done
    answer 3 modes --csv paper.scene
    same "$(awk -F, '{ print NF }' log | sort -u)" 15 'cells in a line for paper.scene'
}

json_parses() {
    has_python || return 0
    answer 0 modes --json two.scene
    python3 -m json.tool <log >parsed 2>errors || fail "no JSON: $(cat errors)"
    same "$(json 'modes["stable"], len(modes["modes"]), modes["modes"][0]["warp_cents"]')" 'True 2 None' 'two.scene'
    same "$(json '[round(s[0]) for s in modes["modes"][0]["eigenvalues"]]')" '[-500, -2000]' eigenvalues
    answer 0 modes --json ring.scene
    same "$(json 'modes["modes"][0]["tau_s"]')" None 'time of what does not die'
    answer 3 modes --json paper.scene
    same "$(json 'modes["stable"], modes["paper_stable"], modes["complete"], modes["proportional"]')" \
        'False True True False' 'paper.scene'
    near "$(json 'modes["largest_step_s"] * modes["lowest_rate_hz"]')" 1 1e-12 'step and rate'
}

# Two masses of 1 and 2 kg on a spring of 50 N/m swing at sqrt(75)/2 pi Hz, and drift together; one on a damper stops.
what_hangs_on_no_ground_is_said() {
    printf 'rate 1000\nmass a 1\nmass b 2\nspring a b 50\n' >free.scene
    answer 0 modes --csv free.scene
    same "$(column region | tr '\n' ' ')" 'drifts vibrates ' motions
    same "$(column frequency_hz | head -n 1)" 0 'frequency of a drift'
    same "$(column tau_s | head -n 1)" inf 'time of a drift'
    near "$(column eigenvalue_im | tail -n 1)" 8.660254037844386 1e-14 'sqrt(75)'
    near "$(column frequency_hz | tail -n 1)" 1.378322 1e-5 'frequency of two masses on a spring'
    answer 0 modes free.scene
    grep -q '^ *1  0, 0 *drifts *0\.00000 *- *for ever *1\.000000000  stable$' log || fail "'$(cat log)'"
    printf 'rate 1000\nmass a 2\nground g\ndamper a g 6\n' >damper.scene
    answer 0 modes --csv damper.scene
    same "$(column region) $(column frequency_hz) $(column eigenvalue_re)" 'stops 0 0' 'on a damper'
    near "$(column eigenvalue2_re)" -3 1e-14 'Z/m'
    near "$(column tau_s)" "$(awk 'BEGIN { printf "%.15g", -0.001 / log(1 - 0.003) }')" 1e-12 'time of its speed'
    answer 3 modes --csv --rate 1.4 damper.scene
    same "$(column region)" grows 'on a damper too strong'
    { echo 'rate 1000' && printf 'mass m%d 1\n' 1 2 3 4 5 && printf 'spring m%d m%d 7\n' 1 2 2 3 3 4 4 5; } >chain.scene
    answer 0 modes --csv chain.scene
    for j in 0 1 2 3 4; do
        near "$(column eigenvalue_im | sed -n "$((j + 1))p")" \
            "$(awk -v j=$j 'BEGIN { printf "%.15g", 2 * sqrt(7) * sin(j * atan2(0, -1) / 10) }')" 1e-12 "mode $j of a chain"
    done
    printf 'rate 1000\nmass a 1\nmass b 1\n' >nothing.scene
    answer 0 modes nothing.scene
    grep -q '^stable at 1000 Hz, as at any other rate$' log || fail "'$(cat log)'"
    answer 0 modes --json nothing.scene
    has_python && same "$(json 'modes["modes"][1]["region"], modes["largest_step_s"]')" 'drifts None' JSON
}

what_is_wrong_is_refused() {
    echo 'mess a 1' >bad.scene
    refuse 1 "bad.scene:1: found 'mess', expected rate" modes bad.scene
    printf 'rate 1\nmass a 1e-300\nground g\nspring a g 1e300\n' >huge.scene
    refuse 1 'huge.scene: could not find the modes: its numbers differ too widely' modes huge.scene
    refuse 1 'none.scene: No such file or directory' modes none.scene
    refuse 2 'found no scene, expected IN.scene' modes
    refuse 2 "found 'b.scene' too, expected one scene" modes a.scene b.scene
    refuse 2 "--lowest: found '0', expected a whole number from 1" modes --lowest 0 string.scene
    refuse 2 "--rate: found 'x', expected a number" modes --rate x string.scene
    refuse 2 'found --csv and --json, expected one of them' modes --csv --json string.scene
    refuse 2 "no option '--tsv'" modes --tsv string.scene
}

an_answer_that_is_not_written_is_a_failure() {
    test -w /dev/full || return 0
    "$HOOKE_BIN" modes string.scene >/dev/full 2>errors
    same $? 1 'status on a full disk'
    grep -q 'could not write' errors || fail "'$(cat errors)'"
}

the_example_is_stable() {
    for scene in "$HOOKE_SOURCE"/doc/*.scene; do
        answer 0 modes "$scene"
    done
}

help_says_what_is_returned() {
    "$HOOKE_BIN" help modes | grep -q 'Returns 0 if the scene is stable, 3 if' || fail "no word on what is returned"
    "$HOOKE_BIN" --help | grep -q '^  modes ' || fail "--help does not name modes"
}

for claim in \
    the_table_is_that_of_the_paper \
    the_largest_step_is_that_of_the_highest_mode \
    overdamped_and_undamped_modes_are_told \
    the_paper_is_named_where_it_differs \
    only_the_lowest_are_listed \
    csv_has_as_many_cells_everywhere \
    json_parses \
    what_hangs_on_no_ground_is_said \
    what_is_wrong_is_refused \
    an_answer_that_is_not_written_is_a_failure \
    the_example_is_stable \
    help_says_what_is_returned; do
    echo "$claim"
    $claim || fail "$claim"
done

test $n_failed -eq 0
