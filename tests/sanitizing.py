"""MemorySanitizer and ThreadSanitizer, which only clang has, each in a build of its own; the wscript's `test` is made of it.

Neither can see into libraries that were built without it. So memory is watched where none is called that writes for us: below
the tools, and in what the fuzz harnesses are made of. Threads are watched where there are any.
"""

MAIN = 'int main(void) { return 0; }\n'

# By the option of `test`: what it is, its flag, the folders of tests/ that it builds, and the names that it runs.
KINDS = {
    'sanitize_memory': ('MemorySanitizer', ['-fsanitize=memory'],
                        ['base', 'string', 'bank', 'excite', 'voice', 'play', 'scale', 'harp', 'guitar'], ''),
    'sanitize_threads': ('ThreadSanitizer', ['-fsanitize=thread'], ['plugin'], 'test_plugin_threads test_plugin_scale_state'),
}

# Which LAPACK writes for, though they are in those folders: what it writes would pass for unwritten.
LAPACKS = {'sanitize_memory': ['test_bridge', 'test_fuzz_modes']}

FLAGS = ['-O2', '-g', '-w', '-fno-omit-frame-pointer', '-fno-sanitize-recover=all']


def options(opt):
    for name, (what, _, folders, _) in KINDS.items():
        opt.add_option('--' + name.replace('_', '-'), action='store_true',
                       help='test: with %s, tests of %s, in build/%s' % (what, ', '.join(folders), name))


def configure(conf):
    """makes an environment for each, and remembers in NO_… why there is none"""
    base = conf.env
    clang = conf.find_program('clang', var='SANITIZING_CC', mandatory=False)
    for name, (what, flags, _, _) in KINDS.items():
        conf.setenv(name, base)
        env = conf.env
        env.CC = env.LINK_CC = clang or env.CC
        env.CFLAGS = [flag for flag in env.CFLAGS if not flag.startswith('-W')] + FLAGS + flags
        env.LINKFLAGS = flags + env.LINKFLAGS
        env.PLUGIN_LINKFLAGS = []
        works = clang and conf.check_cc(fragment=MAIN, msg='Checking for ' + what, mandatory=False)
        conf.setenv('')
        conf.env['NO_' + name] = '' if works else 'found no clang with %s, expected one (Debian: clang)' % what


def chosen(options):
    """the kind that the command line names, or none"""
    return next((name for name in KINDS if getattr(options, name, None)), None)


def folders(kind):
    return KINDS[kind][2] if kind else ['*']


def programs(kind, programs):
    """those of all (name, command) pairs that are run"""
    names = KINDS[kind][3].split()
    unseen = LAPACKS.get(kind, [])
    return [program for program in programs if (not names or program[0] in names) and program[0] not in unseen]


def skipped(bld, kind):
    """what is run where it cannot be"""
    return [('test_' + kind, ['sh', '-c', 'echo "$0"; exit 77', bld.env['NO_' + kind]])]
