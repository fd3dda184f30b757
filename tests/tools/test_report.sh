#!/bin/sh
#
# The report from the outside: what it draws and writes, and that a wrong number, of hooke's or of the paper's, stops it.

set -u

. "$HOOKE_SOURCE/tests/support/claims.sh"

python=
for candidate in python3 /usr/bin/python3; do
    test -n "$python" || ! "$candidate" -c 'import matplotlib, numpy' 2>/dev/null || python=$candidate
done
test -n "$python" || {
    echo 'SKIPPED: found no python3 with matplotlib and numpy, which draw'
    exit 77
}

script=$HOOKE_SOURCE/tools/report.py
figures='03 04 05 08 09 10 11 12 13 14 15 16 17 18 19 21'
errors='pitch decay partials partials-stiff noise bodies'

# draw PROGRAM DIR [SCRIPT]: the report, with its words in `log` and `errors`.
draw() {
    "$python" "${3:-$script}" "$1" "$2" --seconds 0 >log 2>errors
}

# A picture has well-formed XML, all the points that it should have, and no number that is none.
draws_every_picture() {
    draw "$HOOKE_BIN" new || fail "status $?: $(cat errors)"
    test ! -s errors || fail "said '$(cat errors)'"
    same "$(cat log)" "new/report.html: 22 figures; 49 numbers of the paper and 24 comparisons of hooke with the formulas agree" "what it says"
    same "$(ls new | wc -l)" 26 "files: $(ls new)"
    "$python" - $figures $errors <<'END' >checked 2>&1 || fail "$(tail -n 1 checked)"
import re, sys, xml.dom.minidom
for name in sys.argv[1:]:
    path = 'new/%s-%s.svg' % ('figure' if name.isdigit() else 'error', name)
    text = open(path, encoding='utf-8').read()
    xml.dom.minidom.parseString(text.encode())
    points = len(re.findall(r'[ML] ?-?[\d.]+ -?[\d.]+|<use ', text))
    assert points > (70 if name.isdigit() or name == 'bodies' else 500), '%s has %d points' % (path, points)
    assert not re.search(r'\b(nan|inf)\b', text), '%s has what is no number' % path
END
}

# | where | quantity | unit | paper | ours | difference | allowed |
numbers_agree() {
    awk -F ' *[|] *' '
        NF == 9 && $5 ~ /^-?[0-9.]+$/ {
            n++
            off = $6 - $5; off = off < 0 ? -off : off
            if (off > $8 + 1e-12 * ($6 < 0 ? -$6 : $6)) { print "differs:", $0; bad++ }
        }
        END { if (n != 49) print n " numbers"; exit bad || n != 49 }' new/report.md || fail 'the numbers do not agree'
    for number in 0.293 1.707 -0.1954 -0.7292 -0.4983 -0.5362 -0.4977 0.866 1.68 1.00050699121789 785.0001752025822 \
        0.03183636632642 0.97467943448090 817.7132374981528 5293.239300336853 7.46285773640857 444.026 0.915 \
        -13.92588212 10225.74360 12263.63276 -13.958304 440.00000 872.76842 1287.45585 1662.75731 1951.81777 1.000000 \
        0.2678272 0.1338302 0.0891645 0.0716419; do
        grep -qF "| $number |" new/report.md || fail "$number is not in the table"
    done
}

# One page that needs nothing else, with every picture as it lies beside it.
page_is_whole() {
    same "$(grep -c 'src="data:image/svg+xml;base64,' new/report.html)" 22 'pictures in the page'
    ! grep -oE '(src|href)="[^d#][^"]{0,40}' new/report.html || fail 'the page needs another file'
    sed -n '/id="figure-21"/,/<img/s/.*base64,\([^"]*\)".*/\1/p' new/report.html | base64 -d | cmp - new/figure-21.svg ||
        fail 'the page has another figure 21'
    for caption in 'Figure 8: .*poles on the z-plane with γh = 0.04' 'Figure 9: .*γh = 0.98' 'Figure 12: Regions of the s-plane' \
        'Figure 16: Iso-frequencies' 'Figure 17: Iso-damping' 'Figure 21: Poles of simulated string with 5 masses'; do
        grep -q "$caption" new/report.html || fail "no '$caption' in the page"
    done
}

# Each sentence stands on a line of the survey.
errors_are_told() {
    default=$(awk -F, '$1 == 55 && $2 == 0 && $3 == 48000 && $4 == "chain" && $6 == "fixed" && $7 == "Truest" && $9 == 128 {
        printf "errs by %.2g cents for %.3g ns (%.2f %% of a core)", $15, $11, 100 * $12 }' new/survey.csv)
    grep -qF "At 55 Hz the default, 128 masses as chain, Truest (fixed point), $default" new/report.md ||
        fail "the report does not say: $default"
    grep -q 'link by link as in the paper' new/report.md || fail 'nothing of the scheme of the paper'
}

# hooke as it is, but for what sed makes of its answers.
wrong_hooke() {
    cat >wrong <<END
#!/bin/sh
"$HOOKE_BIN" "\$@" >answer
status=\$?
sed '$1' answer
exit \$status
END
    chmod +x wrong
}

stops() {
    text=$1
    shift
    ! draw "$@" || fail "does not stop at '$text'"
    grep -qF "$text" errors || fail "'$(cat errors)' does not say '$text'"
    same "$(wc -l <errors)" 1 'lines on stderr'
    test ! -e bad || fail "left $(ls bad)"
}

wrong_numbers_stop_it() {
    wrong_hooke 's/"radius": 0\.[0-9]*/"radius": 0.5/'
    stops 'report: figure 13: digital damping' ./wrong bad
    wrong_hooke 's/"region": "creeps"/"region": "flips"/'
    stops 'report: figure 11: on both sides of 0.293 hooke has vibrates and flips' ./wrong bad
    sed "s/'872.76842'/'872.76852'/" "$script" >wrong.py
    stops 'report: Table 1, line 2: frequency: the paper has 872.76852, ours is 872.76841' "$HOOKE_BIN" bad wrong.py
    stops 'No such file' "$dir/none" bad
}

for claim in draws_every_picture numbers_agree page_is_whole errors_are_told wrong_numbers_stop_it; do
    echo "$claim"
    $claim
done
test "$n_failed" -eq 0
