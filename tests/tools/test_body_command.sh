#!/bin/sh
#
# `hooke body` from the outside: what it says of networks and tables, and the tables that it writes; and the program that
# makes the bodies while Hooke is built.

set -u

. "${HOOKE_SOURCE:?is the directory of the sources}/tests/support/claims.sh"

bodies=$HOOKE_SOURCE/presets/bodies
reducer=$(dirname "$HOOKE_BIN")/native/bodies

printf 'mode 100 20 0.5 1 2\nmode 300 40 2 0.5 -1\n' >two.body

"$HOOKE_BIN" body two.body >log 2>errors || fail "two.body: $(cat errors)"
same "$(tail -n 1 log)" 'a table of 2 modes' 'the last line'
"$HOOKE_BIN" body --csv two.body >log || fail 'no CSV'
same "$(cut -d, -f1-4 log | tr '\n' ' ')" 'mode,frequency_hz,q,mass_kg 1,100,20,0.5 2,300,40,2 ' 'the CSV'

# A network becomes a table, which is the same body.
for name in guitar banjo; do
    "$HOOKE_BIN" body --csv "$bodies/$name.scene" out.body >scene.csv || fail "$name.scene is no body"
    "$HOOKE_BIN" body --csv out.body >table.csv || fail "the table of $name.scene is no body"
    paste -d, scene.csv table.csv | awk -F, 'NR > 1 { for (i = 1; i < 7; ++i) { d = $i - $(i + 7); if (d < 0) d = -d
        s = $i < 0 ? -$i : $i; if (d > 1e-9 * s) bad = 1 } } END { exit bad || NR < 100 }' ||
        fail "$name.scene and its table differ"
done
"$HOOKE_BIN" body "$bodies/guitar.scene" >log || fail 'guitar.scene is no body'
grep -qE '^a network of [0-9]+ masses: [0-9]+ modes are heard' log || fail "of a network: $(tail -n 1 log)"

refuse() {
    code=$1 said=$2
    shift 2
    "$HOOKE_BIN" "$@" >log 2>errors
    same "$? $(cat errors)" "$code $said" "hooke $*"
}

echo 'mode 100 20' >short.body
printf 'rate 1\nmass a 1\n' >bare.scene
refuse 2 'hooke body: found no body, expected IN.scene or IN.body; try hooke help body' body
refuse 2 "hooke body: found 'c' too, expected one body and one table" body a b c
refuse 2 "hooke body: found 'two.body' twice, expected two files" body two.body two.body
refuse 1 'hooke body: two.txt: found no body, expected a name that ends with .body or .scene' body two.txt
refuse 1 'hooke body: short.body:1: found the end of the line, expected a mass from 1e-9 to 1e9 kg' body short.body
refuse 1 "hooke body: bare.scene:2: found the end of the file, expected 'bridge MASS WEIGHT'" body bare.scene
refuse 1 'hooke body: nowhere.body: No such file or directory' body nowhere.body
mkdir kept
cp two.body kept/old.body
refuse 1 'hooke body: short.body:1: found the end of the line, expected a mass from 1e-9 to 1e9 kg' body short.body kept/old.body
cmp -s two.body kept/old.body || fail 'a table was changed for nothing'
same "$(ls kept)" 'old.body' 'what is left behind'

# All of them, as they are built: the same bits, in far less than 20 s; and what is missing or there twice is said.
if test -x "$reducer"; then
    began=$(date +%s)
    (cd "$HOOKE_SOURCE" && "$reducer" "$dir/all.c" presets/bodies/*) || fail 'the bodies are not made'
    test $(($(date +%s) - began)) -lt 20 || fail 'the bodies took too long'
    cmp -s all.c "$(dirname "$HOOKE_BIN")/core/bank/bodies.c" || fail 'the bodies are not those that were built'
    "$reducer" none.c two.body 2>errors && fail 'one body is enough'
    same "$(cat errors)" 'bodies: found no guitar.scene and no guitar.body, expected one of them' 'what is missing'
    test ! -e none.c || fail 'a file is left behind'
    cp "$bodies"/* . && cp two.body guitar.body
    "$reducer" none.c ./*.scene ./*.body 2>errors && fail 'two guitars are one too many'
    same "$(cat errors)" 'bodies: found ./guitar.scene and ./guitar.body, expected one of them' 'what is there twice'
fi

exit $((n_failed > 0))
