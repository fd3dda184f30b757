#!/bin/sh
#
# `hooke report` from the outside: what it draws and writes, what it refuses, and what it leaves behind.

set -u

command -v gnuplot >/dev/null 2>&1 || {
    echo 'there is no gnuplot here'
    exit 77
}

. "$HOOKE_SOURCE/tests/support/claims.sh"

mkdir empty old
figures='03 04 05 08 09 10 11 12 13 14 15 16 17 18 19 21 31 32'
errors='pitch decay partials partials-stiff noise'

well_formed() {
    if has xmllint; then
        xmllint --noout --nonet "$1"
    else
        python3 -c 'import sys, xml.dom.minidom; xml.dom.minidom.parse(sys.argv[1])' "$1"
    fi
}

# A picture's text, but for the pixels in it, whose letters may spell anything.
without_images() {
    sed 's/base64,[^"'"'"']*//g' "$1"
}

draws_every_figure() {
    "$HOOKE_BIN" report new >log 2>errors || fail "report: status $?: $(cat errors)"
    test ! -s errors || fail "said '$(cat errors)'"
    test "$(cat log)" = new/report.html || fail "said '$(cat log)'"
    for n in $figures; do
        well_formed "new/figure-$n.svg" || fail "figure-$n.svg is not well formed"
        # A picture with nothing in it has axes, and no path of more than ten points.
        awk '/[LM ][0-9.]+,[0-9.]+/ { n += gsub(/[0-9],[0-9]/, "") } END { exit n < 300 }' "new/figure-$n.svg" ||
            fail "figure-$n.svg has next to nothing in it"
        ! without_images "new/figure-$n.svg" | grep -qi 'nan\|>inf<' || fail "figure-$n.svg has a NaN in it"
        test -s "new/figure-$n.dat" || fail "figure-$n.dat is empty"
    done
    for name in $errors; do
        well_formed "new/error-$name.svg" || fail "error-$name.svg is not well formed"
        test "$(grep -c '<use' "new/error-$name.svg")" -gt 100 || fail "error-$name.svg has next to nothing in it"
        ! without_images "new/error-$name.svg" | grep -qi 'nan\|>inf<' || fail "error-$name.svg has a NaN in it"
    done
    found=$(find new -type f | wc -l)
    test "$found" -eq $((3 * 18 + 3 * 5 + 3)) || fail "found $found files: $(ls -A new)"
}

# The script and the data that lie beside a picture draw it again.
scripts_draw_again() {
    mkdir again
    cp new/figure-10.gp new/figure-10.dat again
    (cd again && gnuplot -d figure-10.gp) || fail 'figure-10.gp does not run'
    cmp new/figure-10.svg again/figure-10.svg || fail 'figure-10.gp draws something else'
}

# | figure | quantity | unit | paper | ours | difference | allowed |
numbers_agree() {
    awk -F ' *[|] *' '
        NF == 9 && $5 ~ /[0-9]/ {
            n++
            difference = $6 - $5
            if (difference < 0) difference = -difference
            stated = $7 < 0 ? -$7 : $7
            if (stated >= $8 + 0) { print "differs:", $0; bad++ }
            if (difference > 1.1 * stated + 1e-11 * ($5 < 0 ? -$5 : $5) + $8 / 50) { print "is not its difference:", $0; bad++ }
        }
        END { if (n != 21) print n " numbers"; exit bad || n != 21 }' new/report.md || fail 'the numbers do not agree'
    for number in 0.1954 0.7292 0.4983 0.5362 0.4977 0.866025404 0.97467943448090 817.7132374981528 \
        5293.239300336853 7.46285773640857 440.00000 872.76842 1287.45585 1662.75731 1951.81777 \
        1.000000 0.2678272 0.1338302 0.0891645 0.0716419 444.026; do
        grep -q "| -\{0,1\}$number |" new/report.md || fail "$number is not in the table"
    done
}

# One page that needs nothing else.
page_is_whole() {
    test "$(grep -c 'src="data:image/svg+xml;base64,' new/report.html)" -eq 23 || fail 'not 23 pictures in the page'
    ! grep -oE '(src|href)="[^d#][^"]{0,40}' new/report.html || fail 'the page needs another file'
    grep -q 'prefers-color-scheme:dark' new/report.html || fail 'the page knows no dark'
    for n in $figures; do
        grep -q "id=\"figure-$n\"" new/report.html || fail "figure $n is not in the page"
    done
    ! grep -q '<td>no\|<strong>no' new/report.html || fail 'a number is said not to agree'
    # The first picture, back from its base64.
    sed -n 's/.*svg+xml;base64,\([^"]*\)".*/\1/p' new/report.html | head -n 1 | base64 -d | cmp - new/figure-03.svg ||
        fail 'the page has another picture'
}

# What was there stays, but for files of the same names; and the same is drawn.
fills_an_old_directory() {
    echo mine >old/mine
    echo stale >old/report.md
    "$HOOKE_BIN" report old/ >log 2>errors || fail "report old/: $(cat errors)"
    test "$(cat old/mine)" = mine || fail 'another file was touched'
    rm old/mine
    for directory in old new; do
        without_run_time "$directory/report.md" '^## Error' >"$directory.md"
        without_run_time "$directory/report.html" 'id="error"' >"$directory.html"
    done
    diff old.md new.md || fail 'told otherwise the second time'
    cmp old.html new.html || fail 'another page the second time'
    diff -r -x 'error*' -x 'report.*' old new || fail 'drawn otherwise the second time'
}

# Run time is never the same twice, and comes last.
without_run_time() {
    grep -q "$2" "$1" || fail "$1 says nothing of errors"
    sed "/$2/,\$d" "$1"
}

# Every point is compared, the default is among them, and every string has a frontier.
errors_are_weighed() {
    awk -F , '
        NR > 1 { n++; strings[$1 "," $2 "," $3]++ }
        NR > 1 && /,[abd]*c[abd]*$/ { front[$1 "," $2 "," $3]++ }
        END {
            for (s in strings) { count++; if (!front[s]) { print "no frontier:", s; bad++ } }
            exit n < 5000 || count != 40 || bad
        }' new/errors.csv || fail 'errors.csv is not whole'
    grep -q 'masses (True[a-z]*) give .* cents at the tenth partial of 55 Hz, for .* % of a core' new/report.md ||
        fail 'report.md does not say what masses give'
    grep -q 'Which default?' new/report.md || fail 'report.md gives no advice'
}

refuses_without_a_trace() {
    search=$dir/empty
    refuse 1 'found no gnuplot' report out/new
    search=$PATH
    refuse 1 'No such file' report out/no/new
    echo text >out/file
    refuse 1 'Not a directory' report out/file
    refuse 1 'Not a directory' report out/file/new
    refuse 2 'no directory' report
    refuse 2 'one directory only' report out/a out/b
    refuse 2 "no option '--big'" report --big out/a
    test "$(id -u)" -eq 0 || {
        mkdir -m 555 out/locked
        refuse 1 'Permission denied' report out/locked
    }
}

# A gnuplot that fails, and one that draws nothing.
survives_a_bad_gnuplot() {
    mkdir bad
    search=$dir/bad:$PATH
    # shellcheck disable=SC2016  # the dollar is for that gnuplot
    printf '#!/bin/sh\ncase $1 in --version) exit 0 ;; esac\necho "line 3: no such terminal" >&2\nexit 1\n' >bad/gnuplot
    chmod +x bad/gnuplot
    refuse 1 'no such terminal' report out/new
    mkdir out/kept
    echo mine >out/kept/report.md
    refuse 1 'no such terminal' report out/kept
    test "$(cat out/kept/report.md)" = mine || fail 'a failure touched what was there'
    printf '#!/bin/sh\nexit 0\n' >bad/gnuplot
    refuse 1 'No such file' report out/new
}

draws_every_figure
scripts_draw_again
numbers_agree
page_is_whole
errors_are_weighed
fills_an_old_directory
refuses_without_a_trace
survives_a_bad_gnuplot
test "$n_failed" -eq 0
