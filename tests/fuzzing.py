"""The fuzz harnesses of tests/fuzz, built and run; the wscript's `test` is made of it.

A harness tests/fuzz/fuzz_NAME.c becomes two tests: test_fuzz_NAME plays its seeds and is built as everything else is;
fuzz_NAME looks for more with libFuzzer, which only clang has, in code that ASan and UBSan watch.
"""

import os

# What a harness needs of tools/; the rest of it needs libraries that are none of ours to fuzz.
TOOLS = ['tools/formats/%s.c' % name for name in ['bytes', 'escape', 'text', 'smf', 'scene*', 'score*']]

FLAGS = ['-std=c11', '-O1', '-g', '-w', '-fno-omit-frame-pointer', '-fno-sanitize-recover=all', '-fno-math-errno',
         '-fno-trapping-math', '-ffp-contract=off']
WATCH = 'address,undefined,float-cast-overflow'

SHORT_S = 2
LONG_S = 300
LONGEST_INPUT = 8192
INPUT_TIMEOUT_S = 60

MAIN = '''
#include <stddef.h>
#include <stdint.h>
int LLVMFuzzerTestOneInput(const uint8_t* bytes, size_t n_bytes) { return bytes && n_bytes > 9 ? 0 : 0; }
'''


def configure(conf):
    """looks for a clang with libFuzzer, and remembers in FUZZING why there is none"""
    base = conf.env
    conf.setenv('fuzz', base)
    env = conf.env
    env.CFLAGS = FLAGS + ['-fsanitize=fuzzer-no-link,' + WATCH]
    env.LINKFLAGS = ['-fsanitize=fuzzer,' + WATCH]
    clang = conf.find_program('clang', var='FUZZ_CC', mandatory=False)
    env.CC = env.LINK_CC = clang or env.CC
    works = clang and conf.check_cc(fragment=MAIN, msg='Checking for libFuzzer', mandatory=False)
    conf.setenv('')
    conf.env.NO_FUZZING = '' if works else 'found no clang with libFuzzer, expected one (Debian: clang)'


def harnesses(bld):
    return [node.name[:-len('.c')] for node in bld.path.ant_glob('tests/fuzz/fuzz_*.c')]


def helpers(bld):
    return bld.path.ant_glob('tests/fuzz/*.c', excl=['tests/fuzz/fuzz_*.c', 'tests/fuzz/replay.c'])


def build_replays(bld, use):
    """builds test_fuzz_NAME of every harness"""
    bld.stlib(source=helpers(bld), target='hooke_fuzz', install_path=None, use=use)
    for name in harnesses(bld):
        sources = ['tests/fuzz/%s.c' % name, 'tests/fuzz/replay.c']
        bld.program(source=sources, target='tests/test_' + name, use='hooke_fuzz ' + use, install_path=None,
                    defines=['FUZZ_NAME="%s"' % name[len('fuzz_'):]])


def build(bld, core, wider, analysis):
    """builds fuzz_NAME of every harness, and all that it needs once more, watched"""
    if bld.env.NO_FUZZING:
        return
    parts, defines = wider
    rest = bld.path.ant_glob(TOOLS + ['plugin/*.c', analysis]) + helpers(bld)

    def library(name, sources, **more):
        bld.stlib(source=sources, target='fuzz/' + name, install_path=None, env=environment(bld), **more)

    for name, sources, flags in parts:
        library(name, sources, cflags=flags, defines=defines)
    needed = ' '.join('fuzz/' + part[0] for part in parts)
    library('core', core, defines=defines, use=needed + ' M')
    library('rest', rest, use='fuzz/core LAPACK LV2 M')
    for name in harnesses(bld):
        bld.program(source='tests/fuzz/%s.c' % name, target='fuzz/' + name, install_path=None, env=environment(bld),
                    use='fuzz/rest fuzz/core %s LAPACK LV2 M DL PTHREAD' % needed)


def environment(bld):
    return bld.all_envs['fuzz'].derive()


def programs(bld):
    """(name, command) of all tests there are"""
    return replays(bld) + [(name, command(bld, name)) for name in harnesses(bld)]


def replays(bld):
    """the same of those that play the seeds"""
    return [('test_' + name, [bld.bldnode.make_node('tests/test_' + name).abspath()]) for name in harnesses(bld)]


# What it finds worth keeping goes beside it, for the next run; seeds are committed by hand.
def command(bld, name):
    if bld.env.NO_FUZZING:
        return ['sh', '-c', 'echo "$0"; exit 77', bld.env.NO_FUZZING]
    corpus = bld.bldnode.make_node('fuzz/found/' + name)
    corpus.mkdir()
    seconds = LONG_S if bld.options.long else SHORT_S
    return [bld.bldnode.make_node('fuzz/' + name).abspath(), '-max_total_time=%d' % seconds, '-print_final_stats=1',
            # Its own, 77, is that of a test which is skipped.
            '-error_exitcode=1',
            '-max_len=%d' % LONGEST_INPUT, '-timeout=%d' % INPUT_TIMEOUT_S,
            '-artifact_prefix=' + os.path.join(bld.bldnode.abspath(), 'fuzz', name + '-'),
            corpus.abspath(), bld.path.make_node('tests/fuzz/seeds/' + name[len('fuzz_'):]).abspath()]
