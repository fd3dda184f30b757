#!/bin/sh
#
# `hooke tune` from the outside: the paper's example to its last digit, and scenes that are tuned.

set -u

. "$HOOKE_SOURCE/tests/support/claims.sh"

# quantity NAME: what the answer says of it.
quantity() {
    awk -v name="$1" '$1 == name { print $2 }' log
}

paper='--freq 440 --tau 1 --masses 5 --rate 6000'

table_1_is_printed_to_every_digit() {
    answer 0 tune $paper
    same "$(awk '$4 == "vibrates" { print $1, $2, $3 }' log)" '1 440.00000 1.0000000
2 872.76842 0.2678272
3 1287.45585 0.1338302
4 1662.75731 0.0891645
5 1951.81777 0.0716419' 'Table 1'
}

# 6000 sqrt(a1/lambda1) and 6000 (1 - exp(-2/6000))/lambda1, computed with 40 digits.
its_string_is_printed_too() {
    answer 0 tune $paper
    near "$(quantity omega0)" 5293.239300336853 2e-15 omega0
    near "$(quantity gamma)" 7.462857736414484 2e-14 gamma
    near "$(quantity k)" 28018382.290630583 4e-15 k
    near "$(quantity Z)" 7.462857736414484 1e-15 Z
    same "$(quantity m)" 1 m
    answer 0 tune $paper --mass 0.002
    near "$(quantity k)" 56036.764581261166 4e-15 'k for 2 g'
    near "$(quantity Z)" 0.014925715472828968 1e-15 'Z for 2 g'
}

# Table of the largest N at 48 kHz and 1 s: A4 with s = 0.01 and with s = 1.
too_many_masses_are_unstable() {
    answer 0 tune --freq 440 --tau 1 --rate 48000 --masses 53 --loss 0.01
    grep -q '^stable with 53 masses; up to 53 masses are stable$' log || fail "'$(tail -n 1 log)'"
    answer 3 tune --freq 440 --tau 1 --rate 48000 --masses 54 --loss 0.01
    grep -q '^unstable with 54 masses; up to 53 masses are stable$' log || fail "'$(tail -n 1 log)'"
    grep -q grows log || fail "no mode grows with 54 masses"
    answer 0 tune --freq 440 --tau 1 --rate 48000 --masses 52
    grep -q 'up to 52 masses are stable$' log || fail "'$(tail -n 1 log)'"
    answer 0 tune --freq 440 --tau 1 --rate 48000 --masses 50 --loss 0.01 --stiffness 1e-4
    grep -q 'up to 50 masses are stable$' log || fail "'$(tail -n 1 log)'"
}

loss_and_stiffness_are_heard() {
    answer 0 tune --freq 440 --tau 1 --masses 5 --rate 48000 --loss 0 --stiffness 0.01
    same "$(quantity Z)" 0 'dampers between the masses'
    near "$(quantity Z0)" "$(awk 'BEGIN { print 48000 * (1 - exp(-2 / 48000)) }')" 1e-5 'dampers to the ground'
    test -n "$(quantity k2)" || fail "no stiffness against bending in '$(cat log)'"
    same "$(awk '$4 == "vibrates" { print $3 }' log | sort -u)" 1.0000000 'one decay for all modes'
}

what_never_dies_rings_for_ever() {
    answer 0 tune --freq 440 --tau INF --masses 3 --rate 6000
    cp log capitals
    answer 0 tune --freq 440 --tau inf --masses 3 --rate 6000
    cmp log capitals || fail 'INF is not inf'
    same "$(grep -c 'for ever' log)" 3 'modes that ring for ever'
    same "$(quantity Z)" 0 'dampers without decay'
}

# The string of Table 1, out of tune on purpose: the factors bring its numbers back.
a_scene_is_tuned() {
    cat >string.scene <<'END'
rate 6000
string s 5 mass 2 stiffness 1e6 damping 0.5
END
    answer 0 tune --freq 440 --tau 1 string.scene
    near "$(quantity stiffness_factor)" 56.036764581261166 1e-12 'factor of springs'
    near "$(quantity damping_factor)" 29.851430945657936 1e-12 'factor of dampers'
    answer 0 tune --freq 872.76842 --tau 0.2678272 --mode 2 string.scene
    near "$(quantity stiffness_factor)" 56.036764581261166 1e-7 'factor of springs by mode 2'
    answer 0 tune --freq 440 --tau 1 --rate 48000 string.scene
    near "$(quantity stiffness_factor)" 57.05 1e-3 'factor of springs at 48 kHz'
}

# The same answer for machines: all digits of what people are told, and of what the string is made of.
csv_says_the_same() {
    answer 0 tune $paper
    awk '$4 == "vibrates" { print $1, $2, $3 }' log >told
    spring=$(quantity k)
    damper=$(quantity Z)
    answer 0 tune $paper --csv
    same "$(head -n 1 log)" 'mode,frequency_hz,tau_s,region,omega0,gamma,mass_kg,k,z,z0,k2,all_stable' 'columns'
    same "$(awk -F, 'NR > 1 { printf "%d %.5f %.7f\n", $1, $2, $3 }' log)" "$(cat told)" 'modes'
    same "$(cut -d, -f4,7-12 log | tail -n +2 | sort -u)" "vibrates,1,$spring,$damper,0,0,1" 'the string'
    near "$(sed -n 2p log | cut -d, -f5)" 5293.239300336857 2e-15 omega0
    near "$(sed -n 6p log | cut -d, -f6)" 7.462857736414484 1e-15 gamma
    answer 3 tune --freq 440 --tau inf --rate 48000 --masses 60 --csv
    same "$(cut -d, -f12 log | sort -u | head -n 1)" 0 'stability of 60 masses'
    answer 0 tune --freq 440 --tau 1 --csv string.scene
    same "$(head -n 1 log)" 'stiffness_factor,damping_factor' 'columns of a scene'
    near "$(sed -n 2p log | cut -d, -f1)" 56.036764581261166 1e-12 'factor of springs'
}

what_is_wrong_is_refused() {
    refuse 2 'found no --freq' tune --tau 1 --masses 5 --rate 6000
    refuse 2 'found no --tau' tune --freq 440 --masses 5 --rate 6000
    refuse 2 'found no --masses' tune --freq 440 --tau 1 --rate 6000
    refuse 2 'found no --rate' tune --freq 440 --tau 1 --masses 5
    refuse 2 'expected a pitch below half the rate, 3000 Hz' tune --freq 3000 --tau 1 --masses 5 --rate 6000
    refuse 2 "--freq: found '-1', expected a number" tune $paper --freq -1
    refuse 2 "--tau: found '0', expected a number from 1e-09 to 1e+09, or inf" tune $paper --tau 0
    refuse 2 "--masses: found '2.5', expected a whole number" tune $paper --masses 2.5
    refuse 2 "--loss: found '1.1', expected a number from 0 to 1" tune $paper --loss 1.1
    refuse 2 'found --mode for a string' tune $paper --mode 2
    refuse 2 'found --masses for a scene' tune $paper string.scene
    refuse 1 'nowhere.scene: No such file' tune --freq 440 --tau 1 nowhere.scene
    refuse 1 'could not tune mode 6: there is no such mode' tune --freq 440 --tau 1 --mode 6 string.scene
    refuse 3 'could not tune the lowest mode: no stable system' tune --freq 2000 --tau 1 string.scene
}

help_says_what_is_returned() {
    "$HOOKE_BIN" help tune | grep -q '^Returns 0, or 3' || fail "no word on what is returned"
    "$HOOKE_BIN" --help | grep -q '^  tune ' || fail "--help does not name tune"
}

for claim in \
    table_1_is_printed_to_every_digit \
    its_string_is_printed_too \
    too_many_masses_are_unstable \
    loss_and_stiffness_are_heard \
    what_never_dies_rings_for_ever \
    a_scene_is_tuned \
    csv_says_the_same \
    what_is_wrong_is_refused \
    help_says_what_is_returned; do
    echo "$claim"
    $claim || fail "$claim"
done

test $n_failed -eq 0
