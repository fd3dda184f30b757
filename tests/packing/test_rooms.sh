#!/bin/sh
# Includes go from a room to those below it, never up, and no two files need each other but where they are one idea.
set -u

. "${HOOKE_SOURCE:?is the directory of the sources}/tests/support/claims.sh"

# rooms DIRECTORY: what is wrong with its includes.
rooms() {
    python3 - "$1" <<'END'
import pathlib, re, sys

BELOW = {
    'core/base': '', 'core/play': 'core/base', 'core/scale': 'core/base', 'core/string': 'core/base',
    'core/analysis': 'core/base core/string/pole', 'core/excite': 'core/base core/string',
    'core/bank': 'core/base core/string/pole', 'core/voice': 'core/base core/string core/bank core/excite',
    'core/harp': 'core/base core/string core/bank core/excite core/voice core/play core/scale',
    'core/guitar': 'core/base core/string core/bank core/excite core/voice core/play core/scale',
    'plugin': 'core/base core/bank core/play core/scale core/voice core/harp core/guitar',
    'tools/host': 'core plugin tools/formats', 'tools/formats': 'core plugin',
    'tools/bodies': 'core tools/formats', 'tools/bench': 'core plugin tools', 'tools/commands': 'core plugin tools',
}
# One idea each: what a hammer is to do is found by rehearsing it; a chain and what its masses are kept in; a host's inside.
ONE = [{'core/excite/hammer', 'core/excite/rehearsal'}, {'core/string/chain', 'core/string/chain_numbers'},
       {'tools/host/host', 'tools/host/host_impl'}]

top = pathlib.Path(sys.argv[1])
needs = {}
for path in sorted(file for room in ['core', 'plugin', 'tools'] for file in (top / room).rglob('*.[ch]')):
    name = path.relative_to(top).with_suffix('').as_posix()
    room = name.rsplit('/', 1)[0]
    if room not in BELOW:
        print('%s is in no room that is known here' % path.relative_to(top))
        continue
    for other in re.findall(r'^#include "(.*)\.h"$', path.read_text(), re.M):
        needs.setdefault(name, set()).add(other)
        if other.rsplit('/', 1)[0] != room and not any((other + '/').startswith(b + '/') for b in BELOW[room].split()):
            print('%s includes %s, which is not below it' % (path.relative_to(top), other))

def reach(name, seen):
    for other in needs.get(name, set()) - seen:
        seen.add(other)
        reach(other, seen)
    return seen

all_of = {name: reach(name, set()) for name in needs}
for a in sorted(needs):
    for b in sorted(all_of[a]):
        if a < b and a in all_of.get(b, ()) and {a, b} not in ONE:
            print('%s and %s need each other' % (a, b))
END
}

wrong=$(rooms "$HOOKE_SOURCE" 2>&1) || fail 'the includes could not be read'
same "$wrong" '' 'includes'

# callers WORD: the files of the plugins and of the players' room that call a function of that name.
callers() {
    (cd "$HOOKE_SOURCE" && grep -lE "\\b$1[a-z_]*\\(" plugin/*.c core/play/*.c) | tr '\n' ' '
}

same "$(callers harp_)" 'plugin/strings.c ' 'callers of the harp'
same "$(callers 'guitar(ist)?_(new|reset|performance|run|set)')" 'plugin/guitar.c ' 'callers of the guitar'
same "$(callers midi_read)" 'core/play/channels.c core/play/midi.c ' 'where MIDI is read'

# A way up, a circle and an unknown room are seen.
mkdir -p up/core/attic up/core/base up/core/string
touch up/core/attic/x.c
echo '#include "core/string/chain.h"' >up/core/base/line.c
echo '#include "core/string/b.h"' >up/core/string/a.h
echo '#include "core/string/a.h"' >up/core/string/b.h
same "$(rooms up)" 'core/attic/x.c is in no room that is known here
core/base/line.c includes core/string/chain, which is not below it
core/string/a and core/string/b need each other' 'planted includes'

exit $((n_failed > 0))
