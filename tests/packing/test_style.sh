#!/bin/sh
# The C looks as clang-format leaves it, and clang-tidy finds no fault in the plugin and what it is made of.
set -u

. "${HOOKE_SOURCE:?is the directory of the sources}/tests/support/claims.sh"
. "$HOOKE_SOURCE/tests/support/trees.sh"

# Another version would have other opinions.
needs clang-format-14 clang-format-14

cp "$HOOKE_SOURCE/.clang-format" "$HOOKE_SOURCE/.clang-tidy" .
source_files | grep '\.[ch]$' >sources
test "$(wc -l <sources)" -gt 100 || fail "found only these sources: $(cat sources)"
(cd "$HOOKE_SOURCE" && tr '\n' '\0' | xargs -0 clang-format-14 --dry-run -Werror) <sources >log 2>&1 ||
    fail "clang-format -i would change: $(grep error: log)"
echo 'int one( void ) { return 1; }' >odd.c
! clang-format-14 --dry-run -Werror odd.c >log 2>&1 || fail 'clang-format does not see a blank too many'

only_long 'clang-tidy'
needs clang-tidy-14 clang-tidy-14

# Each file by itself, or clang-tidy mixes them up; all that are at fault are told.
tidy() {
    tr '\n' '\0' | xargs -0 -n 1 -P "$(nproc)" clang-tidy-14 --quiet -p "${HOOKE_BIN%/*}" >log 2>/dev/null
}
grep -E '^(core|plugin)/.*\.c$' sources | sed "s|^|$HOOKE_SOURCE/|" | tidy || fail "clang-tidy: $(cat log)"
cat >odd.c <<'END'
#include <string.h>
int odd(int a);
int odd(int a) {
  char to[4];
  if (a)
    memset(to, 0, sizeof(to));
  return to[0];
}
END
! clang-tidy-14 --quiet odd.c -- >log 2>/dev/null || fail 'clang-tidy does not see an if without braces'
for check in braces-around-statements UndefReturn; do
    grep -q "$check" log || fail "clang-tidy sees no $check: $(cat log)"
done

exit $((n_failed > 0))
