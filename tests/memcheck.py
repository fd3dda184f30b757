"""The tests under valgrind; the wscript's `test --valgrind` is made of it."""

import os
import shlex

COMMAND = ['valgrind', '-q', '--error-exitcode=99', '--leak-check=full', '--errors-for-leak-kinds=definite',
           '--show-leak-kinds=definite']

# What measures time, or watches the heap or counts instructions itself, has nothing to measure there; and libFuzzer
# programs are watched already.
MEASURING = ['test_speed', 'test_bench', 'test_plugin_realtime', 'fuzz_']

# Held to bounds below the rounding of a double, which valgrind computes long doubles as.
LONG_DOUBLES = ['test_scale', 'test_scale_tune']

# For tests that bound their own time.
SLOWDOWN = '100'


def wrap(programs, environment, directory):
    """Put (name, command) pairs under valgrind, and the program that scripts run too.

    Return the pairs; `environment` is changed. What cannot run there says so and is skipped.
    """
    program = os.path.join(directory, 'hooke-valgrind')
    with open(program, 'w', encoding='utf-8') as script:
        script.write('#!/bin/sh\nexec %s "$@"\n' % shlex.join(COMMAND + [environment['HOOKE_BIN']]))
    os.chmod(program, 0o755)
    environment['HOOKE_BIN'] = program
    environment['HOOKE_SLOWDOWN'] = SLOWDOWN
    return [(name, wrapped(name, command)) for name, command in programs]


def wrapped(name, command):
    if any(name.startswith(word) for word in MEASURING):
        return skipped('it measures what valgrind changes')
    if name in LONG_DOUBLES:
        return skipped('valgrind computes its long doubles as doubles')
    return command if name.endswith('.sh') else COMMAND + command


def skipped(why):
    return ['sh', '-c', 'echo "%s"; exit 77' % why]
