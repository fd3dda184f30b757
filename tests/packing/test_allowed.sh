#!/bin/sh
# What a test script calls is declared: it can call what goes with the packages that `waf` lists, and nothing else unasked.
set -u

. "${HOOKE_SOURCE:?is the directory of the sources}/tests/support/claims.sh"

test "${HOOKE_SEARCH:?is where all programs are}" != "$PATH" || skip 'without dpkg nobody knows what a program belongs to'

# A program that is there and belongs to no package
mkdir planted
printf '%s\n' '#!/bin/sh' 'echo "$PATH $1"' >planted/hooke-planted
chmod +x planted/hooke-planted
export HOOKE_SEARCH="$dir/planted:$HOOKE_SEARCH"

# allowed LAUNCHER: the names of all programs that may be called
allowed() {
    PYTHONPATH=$HOOKE_SOURCE python3 - "$1" <<'END' || fail 'found no programs'
import os, sys
from tests import allowed
allowed.restrict(dict(os.environ, PATH=os.environ['HOOKE_SEARCH']), sys.argv[1], 'links')
END
    ls links && rm -r links
}

allowed "$HOOKE_SOURCE/waf" >all
sed '/_packages=/s/ valgrind//' "$HOOKE_SOURCE/waf" >fewer
allowed fewer >without
for name in sh awk gcc python3 xz valgrind; do
    grep -qx $name all || fail "$name cannot be called"
done
! grep -qx valgrind without || fail 'a program can be called whose package is not listed'
! grep -qx hooke-planted all || fail 'a program can be called that belongs to no package'

# It is found when it is asked for, and finds what else there is.
! command -v hooke-planted >/dev/null || fail 'it can be called unasked'
has hooke-planted || fail 'it is not found'
same "$(hooke-planted "it's here")" "$HOOKE_SEARCH it's here" 'what it says'
! has hooke-not-there || fail 'what is not there is found'

exit $((n_failed > 0))
