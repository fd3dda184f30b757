#!/bin/sh
#
# `hooke bench` from the outside: what it prints, and what it refuses. What it measures is not held to anything here.

set -u

. "$HOOKE_SOURCE/tests/support/claims.sh"

# head TEXT: the first line of `log`.
heads() {
    same "$(head -n 1 log)" "$1" "columns"
}

# numbers FIRST N: of `log`, from column FIRST on, all are numbers and none is below 0, in N lines.
numbers() {
    tail -n +2 log | awk -F, -v first="$1" '{
        for (i = first; i <= NF; ++i) if ($i !~ /^[0-9.]+$/ && !($i == "" && i == NF)) exit 1
    }' || fail "not all are numbers: $(cat log)"
    same "$(tail -n +2 log | wc -l)" "$2" "lines"
}

answer 0 bench scenes --csv --seconds 0 --masses 40 --numbers double --scene straightened-2
heads "kernel,numbers,scene,masses,ns_per_mass_step,share_of_peak"
n_kernels=$(tail -n +2 log | cut -d , -f 1 | uniq | wc -l)
numbers 4 $((4 * n_kernels))
same "$(cut -d , -f 3 log | grep -c -e '-straightened-.*-2$')" $((4 * n_kernels)) "scenes"
awk -F, 'NR > 1 && !($5 > 0 && $6 > 0 && $6 < 1.5) { exit 1 }' log || fail "no likely figures: $(cat log)"

answer 0 bench scenes --seconds 0 --masses 8 --scene ground-flexible-still-1
same "$(grep -c '^ground-flexible-still-1 .*%$' log)" $((3 * n_kernels)) "lines of the table"

answer 0 bench loads --csv --seconds 0
heads "load,strings,masses,ns_per_mass_step,goal_ns,share_of_core,share_of_peak,strings_per_core,strings_cut"
numbers 2 9
same "$(sed -n 's/^one_80,\([0-9]*,[0-9]*\),.*/\1/p' log)" 1,80 "strings and masses of one string"
same "$(sed -n 's/^six_80,\([0-9]*,[0-9]*\),.*/\1/p' log)" 6,480 "strings and masses of six"
same "$(awk -F, '$1 == "keys_88" { print $2, ($3 > 15000 && $3 < 15500), $9 }' log)" "88 1 0" "the keys of a piano"
same "$(awk -F, '$1 == "keys_128" { print $2, ($3 > 36000 && $3 < 37000), $9 }' log)" "128 1 18" "all keys"
awk -F, 'NR > 1 { d = $6 - $3 * $4 * 48000e-9; if (d > 1e-3 * $6 + 2e-6 || -d > 1e-3 * $6 + 2e-6) exit 1 }' log ||
    fail "shares of a core are not mass-steps times their time: $(cat log)"

answer 0 bench start --csv
heads "rate_hz,harp_ms,harp_bytes,plugin_ms"
same "$(tail -n +2 log | cut -d , -f 1 | tr '\n' ' ')" "44100 48000 96000 192000 " "rates"

# Every way of 80 masses; what is truer, in doubles and by Truest partials, comes with its price.
answer 0 bench survey --csv --seconds 0 --masses 80
heads "f0_hz,inharmonicity,rate_hz,kind,scheme,numbers,partials,corrected,masses,stable,ns_per_frame,share_of_core,pitch_cents,decay_percent,partials_cents,noise_db"
awk -F, 'NR > 1 && !(NF == 16 && $9 == 80 && $11 > 0 && $12 > 0 && $13 >= 0 && $14 >= 0 && $15 >= 0 && $16 <= 0) { exit 1 }' log ||
    fail "no likely figures: $(cat log)"
awk -F, 'NR > 1 { d = $12 / ($11 * $3 * 1e-9) - 1; if (d * d > 1e-8) exit 1 }' log || fail "shares are not time times rate"
same "$(awk -F, '$1 == 55 && $2 == 0 && $3 == 48000' log | wc -l)" 20 "ways of one string"
same "$(cut -d , -f 4 log | tail -n +2 | sort -u | tr '\n' ' ')" "bank chain network " "kinds"
same "$(awk -F, '$1 == 55 && $2 == 0 && $3 == 48000 && $6 == "fixed" { printf "%s %.3g ", $7, $15 }' log)" \
    "Lumped 19.9 True 1.17 Truest 0.0812 " "errors of 20 partials [cents]"
same "$(awk -F, 'NR > 1 && $4 == "chain" && $6 == "double" && $8 && !$2 && $16 != "-inf"' log)" "" "noise of doubles"
same "$(awk -F, 'NR > 1 && !$10 { print $5 }' log | sort -u)" "forward Euler" "what grows"
answer 0 bench survey --seconds 0
same "$(grep -c '^\(chain\|network\|bank\), ' log)" 20 "lines of the table"

# The more modes are kept of a body, the less it errs, about; and all of them err by nothing.
answer 0 bench bodies --csv --seconds 0
heads "body,modes,ns_per_frame,error_db,worst_db"
same "$(tail -n +2 log | cut -d , -f 1 | sort -u | wc -l)" 11 "bodies"
awk -F, 'NR > 1 && !(NF == 5 && $3 > 0 && $4 >= 0 && $5 >= $4 && ($1 != last || $4 <= 1.2 * error + 0.05)) { exit 1 } { last = $1; error = $4 }' log ||
    fail "no likely figures: $(cat log)"
same "$(awk -F, 'NR > 2 && $1 != last && error != 0 { print last } { last = $1; error = $4 }' log)" "" "errors of whole bodies"
answer 0 bench bodies --seconds 0

# A bank of five sizes by every kernel, the best first, and the plain one last.
answer 0 bench modes --csv --seconds 0
heads "kernel,modes,heard_ns_per_mode_step,pushed_ns_per_mode_step,ns_per_mass_step,heard_ratio,pushed_ratio"
same "$(tail -n +2 log | cut -d , -f 2 | sort -nu | tr '\n' ' ')" "8 32 64 128 256 " "modes"
same "$(tail -n 1 log | cut -d , -f 1)" plain "the last kernel"
numbers 2 $((5 * $(tail -n +2 log | cut -d , -f 1 | uniq | wc -l)))
awk -F, 'NR > 1 { h = $3 / $5 / $6 - 1; p = $4 / $5 / $7 - 1; if (!($5 > 0) || h * h > 1e-4 || p * p > 1e-4) exit 1 }' log ||
    fail "ratios are not those of times: $(cat log)"
answer 0 bench modes --seconds 0
same "$(grep -c '^plain  ' log)" 5 "lines of the plain kernel"

answer 0 bench --host urn:hooke:strings --csv
heads "notes,ns_per_frame,share_of_core,start_ms"
numbers 1 5
awk -F, 'NR > 2 && !($2 > last) { exit 1 } { last = $2 }' log || fail "more notes cost no more: $(cat log)"

answer 0 bench --one between-bending-moving-2,float,3,1000 --one awake,5,640 --one asleep,5,640
test ! -s log || fail "--one says $(cat log)"

refuse 1 "not found" bench --host urn:hooke:none
refuse 2 "found 2 parts, expected one" bench scenes loads --csv
refuse 2 "found 'humming'" bench humming
refuse 2 "expected words of a scene" bench --scene damp
refuse 2 "expected float, double or fixed" bench --numbers int
refuse 2 "--masses" bench --masses 1025
refuse 2 "--masses" bench --masses 0
refuse 2 "--seconds" bench --seconds nan
refuse 2 "expected no part" bench loads --host urn:hooke:strings
"$HOOKE_BIN" bench survey --masses 1024 >log 2>errors
same "$? $(cat errors)" "1 hooke bench: survey: found nothing to measure, or no memory for it" "too many masses for 55 Hz"
for what in '' ground ground-flexible-still-1,float,80 ground-flexible-still-1,float,0,9 awake,129,64 awake,1,64x \
    between-flexible-moving-1,fixed,80,64 undamped-flexible-still-1,fixed,80,64 asleep,1; do
    refuse 2 "--one: found '$what'" bench --one "$what"
done

test "$n_failed" -eq 0
