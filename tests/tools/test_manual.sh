#!/bin/sh
# The manual page says of every command and option what there is, says nothing of others, and can be read.
set -u

. "${HOOKE_SOURCE:?is the directory of the sources}/tests/support/claims.sh"

page=$HOOKE_SOURCE/doc/hooke.1

# What the page says about a command, and the options that it explains there.
section() {
    awk -v title=".Ss hooke $1" '/^\.S[sh]/ { is_in = $0 == title } is_in' "$page"
}

explained() {
    section "$1" | sed -n 's/^\.It Fl -\([a-z-]*\).*/--\1/p' | sort -u
}

# Those that the program names in its help.
named() {
    "$HOOKE_BIN" help "$1" | grep -oE -e '--[a-z]+(-[a-z]+)*' | sort -u
}

commands=$("$HOOKE_BIN" help | awk '/^  [a-z]/ { print $1 }')
test "$(echo "$commands" | wc -l)" -ge 4 || fail "found only these commands: $commands"

for command in $commands; do
    test -n "$(section "$command")" || fail "the page says nothing of hooke $command"
    same "$(explained "$command")" "$(named "$command")" "options of hooke $command"
    grep -qx "\.Cm $command\( .*\)\?" "$page" || fail "the synopsis has no hooke $command"
done

for title in $(sed -n 's/^\.Ss hooke //p' "$page"); do
    test "$title" = help || echo "$commands" | grep -qx "$title" || fail "there is no hooke $title"
done

# Every part of the benchmark, and each command line that the page shows.
"$HOOKE_BIN" help bench | sed -n '/^  --/q; s/^  \([a-z]\{1,\}\)  .*/\1/p' >parts
test "$(wc -l <parts)" -ge 5 || fail "found only these parts of bench: $(cat parts)"
while read -r part; do
    section bench | grep -q "^\.Cm $part\b" || fail "the page says nothing of the part $part"
done <parts

awk '/^\.Bd/ { is_in = 1; next } /^\.Ed/ { is_in = 0 } is_in' "$page" >one.scene
cp "$HOOKE_SOURCE/doc/demo.mid" tune.mid
sed -n 's/^\.Dl hooke //p' "$page" | sed 's/\\(dq/"/g' >shown
test "$(wc -l <shown)" -ge 4 || fail "the page shows only: $(cat shown)"
while read -r words; do
    eval "\"\$HOOKE_BIN\" $words" >log 2>&1 || fail "hooke $words: $(cat log)"
done <shown

if has mandoc; then
    said=$(mandoc -T lint -W warning "$page" 2>&1) || fail "mandoc: $said"
    sed 's/^\.El$//' "$page" >broken.1
    ! mandoc -T lint -W warning broken.1 >/dev/null 2>&1 || fail 'mandoc does not see a list without an end'
elif has groff; then
    said=$(groff -mdoc -Tutf8 -wall -z "$page" 2>&1)
    test -z "$said" || fail "groff: $said"
else
    echo 'not looked at for faults of syntax: there is neither mandoc nor groff'
fi

exit $((n_failed > 0))
