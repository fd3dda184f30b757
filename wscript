"""How Hooke is built, tested, installed and packed. `./waf --help` lists the commands and options.

Sources are found by where they lie, so that a new one needs no line here:

    core/*/*.c             a static library, in the plugin and in everything else
    core/*/*_avx2.c        the part of it for processors with AVX2 and FMA, which is chosen when it runs
    core/*/*_avx512.c      the same with AVX-512
    core/analysis/*.c      what needs LAPACK: a library for the program and the tests, and no part of the plugin
    presets/bodies/        networks and tables which a program reduces to core/bank/bodies.c, see tools/native.py
    plugin/*.c             the plugin, hooke.lv2/hooke.so, and a static library for the bench and the tests
    ttl/, presets/         the plugin's descriptions and presets, beside it; ttl/modgui/, a pedal for MOD's hosts
    tools/commands/main.c  the program `hooke`; the tools/*/*.c but main.c are a library which the tests share
    tests/*/test_*.c       a test program each; the rest of tests/support/*.c is linked into all of them
    tests/support/plant_*  a library each, built as the plugin is, with a fault that a test has to find
    tests/hosts/*.c        a program each, for the tests that run hosts; watch_*.c are one library, preloaded into them
    tests/*/test_*.sh      run as tests too
    tests/fuzz/            the fuzz harnesses, see tests/fuzzing.py

The rest lies in tools/packing.py (installing, packing), tools/cross.py (other machines), tools/report.py (the paper's
figures) and tests/runner.py.
"""

import json
import os
import subprocess
import sys
import tempfile

from tests import allowed, fuzzing, memcheck, runner, sanitizing
from tools import cross, native, packing
from waflib import Build, Configure, Context, Errors, Options

APPNAME = 'hooke'
VERSION = '0.2.0'

top = '.'
out = 'build'

default_prefix = '/usr/local'

# What was built stays so for another Python, as that of sudo may be: its version is in this name by default.
Context.DBFILE = '.wafpickle'
Build.PROTOCOL = 4

# Configure when needed, and again with the same options when this file has changed.
Configure.autoconfig = 'clobber'

# The room of core/ that knows LAPACK. It serves the tools and the tests and stays out of the plugin.
ANALYSIS = 'core/analysis/*.c'

WARNINGS = '''
    -Wall -Wextra -Wpedantic -Wshadow -Wconversion -Wstrict-prototypes -Wmissing-prototypes -Wcast-qual -Wvla
    -Wdouble-promotion -Wwrite-strings -Wundef -Wformat=2 -Wno-psabi
'''.split()

# Not -ffast-math, which would delete the NaN checks, and no contraction, so that every compiler gives the same bits.
MATHS = ['-fno-math-errno', '-fno-trapping-math', '-ffp-contract=off']

# For the files that are run only where the processor has them.
WIDER = {
    'avx2': ['-mavx2', '-mfma'],
    'avx512': ['-mavx512f', '-mavx512dq', '-mavx512vl', '-mavx512bw', '-mfma', '-mprefer-vector-width=512'],
}

# Of those, the ones that are worth contracting; a bank is not, so that it gives the same bits on every processor.
CONTRACTED = 'core/string'

SANITIZERS = ['-fsanitize=address,undefined,float-cast-overflow', '-fno-sanitize-recover=all',
              '-fno-omit-frame-pointer']

# The variant for `test --sanitize`.
SANITIZED = 'sanitized'

# That nothing is left to be found elsewhere, in the plugin; sanitizers are.
WHOLE = ['-Wl,-z,defs', '-static-libgcc']

# What is fixed by `configure` and cannot be changed by a later command.
CONFIGURE_OPTIONS = ['prefix', 'lv2dir', 'user', 'debug', 'sanitize', 'werror', 'cross']


# Options and configuration


def options(opt):
    opt.load('compiler_c')
    cross.options(opt)
    opt.add_option('--lv2dir', help='configure: where LV2 bundles are installed [<prefix>/lib/lv2]')
    opt.add_option('--user', action='store_true', help='configure: install for this user, in ~/.lv2 and ~/.local')
    opt.add_option('--debug', action='store_true', help='configure: build for a debugger')
    opt.add_option('--sanitize', action='store_true',
                   help='configure, test: ASan and UBSan, stopping at the first error; test: in build/sanitized')
    sanitizing.options(opt)
    opt.add_option('--valgrind', action='store_true', help='test: under valgrind')
    opt.add_option('--werror', action='store_true', help='configure: let a warning fail the build')
    opt.add_option('--long', action='store_true', help='test: run the long versions of the tests as well')
    opt.add_option('--only', default='', metavar='WORD', help='test: run those with one of WORD,WORD,… in their name')
    opt.add_option('--timeout', type=int, metavar='S', help='test: let each program take S seconds [600; --long, --sanitize, --valgrind: 3600]')


def configure(conf):
    """finds the compiler and the libraries, and fixes the options"""
    keep_environment(conf)
    know_new_options(conf)
    cross.prepare(conf)
    conf.load('compiler_c')
    check_compiler(conf)
    packing.set_directories(conf)
    check_libraries(conf)
    set_flags(conf)
    conf.env.CHOICES = {name: getattr(conf.options, name) for name in CONFIGURE_OPTIONS}
    fuzzing.configure(conf)
    sanitizing.configure(conf)
    conf.setenv(SANITIZED, conf.env)
    add_sanitizers(conf)
    conf.setenv('')
    conf.msg('Installing the program in', conf.env.BINDIR)
    conf.msg('Installing the bundle in', conf.env.LV2DIR)


# A configuration that is renewed by itself keeps the compiler it was first given.
def keep_environment(conf):
    kept = getattr(conf.options, 'environment', {})
    conf.environ.update({name: value for name, value in kept.items() if name not in conf.environ})
    names = ['CC', 'CC_FOR_BUILD', 'AR', 'CFLAGS', 'CPPFLAGS', 'LDFLAGS', 'LINKFLAGS', 'PKG_CONFIG_PATH']
    conf.options.environment = {name: conf.environ[name] for name in names if name in conf.environ}


# Nor does it know the options that came after it.
def know_new_options(conf):
    for name in CONFIGURE_OPTIONS:
        if not hasattr(conf.options, name):
            setattr(conf.options, name, None)


# What the chains' loops are written with.
VECTORS = '''
typedef float Vector __attribute__((vector_size(16)));
typedef int Whole __attribute__((vector_size(16)));
Vector turn(Vector a) { return __builtin_shufflevector(a, a, 1, 2, 3, 0); }
Whole whole(Vector a) { return __builtin_convertvector(a, Whole); }
int main(void) { return whole(turn((Vector){0}))[0]; }
'''


def check_compiler(conf):
    if ':' in conf.path.abspath():
        conf.fatal('hosts cannot be shown a bundle below %s: LV2_PATH has colons between directories' % conf.path.abspath())
    conf.check_cc(fragment=VECTORS, msg='Checking for vectors', features='c',
                  errmsg='none: gcc has them from version 12 on, clang from 13; choose one with CC=')


# The bundle can be built always. What tests alone need is looked for when they are built.
def check_libraries(conf):
    conf.env.WITH_TOOLS = not conf.options.cross or bool(conf.env.CROSS_SYSTEM)
    for lib in ['m', 'dl', 'pthread']:
        conf.check_cc(lib=lib, uselib_store=lib.upper(), mandatory=lib == 'm')
    for_tools = ['lilv-0', 'sndfile', 'lapack'] if conf.env.WITH_TOOLS else []
    for package in ['lv2'] + for_tools:
        check_package(conf, package)
    if conf.options.cross and not conf.env.CROSS_SYSTEM:
        cross.use_lv2_headers(conf)
    conf.env.SPEC_LV2DIR = spec_lv2dir(conf)


def check_package(conf, package):
    store = package.split('-')[0].upper()
    conf.check_cfg(package=package, uselib_store=store, args=['--cflags', '--libs'])
    # Their headers are not held to our warnings.
    for path in conf.env['INCLUDES_' + store]:
        conf.env.append_value('CFLAGS_' + store, ['-isystem', path])
    conf.env['INCLUDES_' + store] = []


# Where lv2 itself has its bundles, which a host needs to read ours.
def spec_lv2dir(conf):
    directory = conf.cmd_and_log(conf.env.PKGCONFIG + ['--variable=lv2dir', 'lv2'], quiet=True).strip()
    prefix = conf.cmd_and_log(conf.env.PKGCONFIG + ['--variable=prefix', 'lv2'], quiet=True).strip()
    return directory or os.path.join(prefix, 'lib', 'lv2')


# Ours come first, so that the user's CFLAGS and LDFLAGS have the last word.
def set_flags(conf):
    optimization = ['-Og', '-g'] if conf.options.debug else ['-O3']
    flags = ['-std=c11', '-fvisibility=hidden'] + optimization + MATHS + WARNINGS
    if conf.options.werror:
        flags += ['-Werror']
    conf.env.prepend_value('CFLAGS', flags)
    conf.env.append_value('INCLUDES', [conf.path.abspath()])
    if conf.env.DEST_CPU == 'aarch64':
        conf.env.CFLAGS_HELPERS = ['-fno-tree-loop-vectorize']  # gcc 12 fails to compile tests/support/harps.c with it
    if conf.env.DEST_OS == 'win32':
        conf.env.PLUGIN_LINKFLAGS = ['-static']
        cross.suit_windows(conf)
    elif conf.env.DEST_OS != 'darwin':
        conf.env.PLUGIN_LINKFLAGS = ['-Wl,--exclude-libs,ALL', '-Wl,--as-needed'] + WHOLE
    native.configure(conf, flags)
    if conf.options.sanitize:
        add_sanitizers(conf)


def add_sanitizers(conf):
    if SANITIZERS[0] not in conf.env.CFLAGS:
        conf.env.append_value('CFLAGS', ['-g'] + SANITIZERS)
        conf.env.prepend_value('LINKFLAGS', SANITIZERS)
        conf.env.PLUGIN_LINKFLAGS = [flag for flag in conf.env.PLUGIN_LINKFLAGS if flag not in WHOLE]


# Building


def build(bld):
    """compiles the bundle and the program into build/, and no tests"""
    refuse_late_options(bld)
    build_core(bld)
    build_bundle(bld)
    if bld.env.WITH_TOOLS:
        build_tools(bld)
    bld.add_post_fun(link_bundle)
    bld.add_post_fun(write_compile_commands)
    if bld.is_install:
        packing.keep_account_of_directories(bld)


# An option of configure given to a later command would be lost in silence.
def refuse_late_options(bld):
    for name in CONFIGURE_OPTIONS:
        given = None if name == 'sanitize' and bld.cmd == 'test' else getattr(Options.options, name)
        if given not in (None, default_prefix, bld.env.CHOICES.get(name)):
            bld.fatal('--%s is for configure: run `./waf configure` with all the options you want' % name)


# (name, sources, flags) of all that is for wider vectors than every processor has, and what says that it is there.
def wider(bld):
    kinds = WIDER if bld.env.DEST_CPU == 'x86_64' else {}
    parts = []
    for kind, flags in kinds.items():
        strings = bld.path.ant_glob('%s/*_%s.c' % (CONTRACTED, kind))
        others = bld.path.ant_glob('core/*/*_%s.c' % kind, excl=CONTRACTED + '/*')
        parts += [(kind + '_contracted', strings, flags + ['-ffp-contract=fast']), (kind, others, flags)]
    return [part for part in parts if part[1]], ['HOOKE_' + kind.upper() for kind in kinds]


# What every processor can run.
def plain(bld):
    return bld.path.ant_glob('core/*/*.c', excl=[ANALYSIS] + ['core/*/*_%s.c' % kind for kind in WIDER]) + [native.bodies(bld)]


def build_core(bld):
    native.build(bld)
    parts, defines = wider(bld)
    for name, sources, flags in parts:
        bld.objects(source=sources, target='hooke_' + name, cflags=['-fPIC'] + flags, defines=defines)
    library(bld, 'hooke_core', plain(bld), use=' '.join(['M'] + ['hooke_' + part[0] for part in parts]), defines=defines)
    if bld.env.WITH_TOOLS:
        library(bld, 'hooke_analysis', bld.path.ant_glob(ANALYSIS), use='hooke_core LAPACK')


def build_bundle(bld):
    bundle = '${LV2DIR}/hooke.lv2'
    env = bld.env.derive()
    env.cshlib_PATTERN = '%s' + library_ending(bld)
    sources = bld.path.ant_glob('plugin/*.c')
    if sources:
        bld.shlib(source=sources, target='hooke.lv2/hooke', name='hooke_plugin', env=env,
                  install_path=bundle, install_path_implib=None,
                  use='hooke_core LV2 M PTHREAD', linkflags=bld.env.PLUGIN_LINKFLAGS)
    for node in bld.path.ant_glob(['ttl/*.ttl', 'presets/*.ttl']):
        bld(features='subst', is_copy=True, source=node, target='hooke.lv2/' + node.name, install_path=bundle)
    for node in bld.path.ant_glob('ttl/modgui/*'):
        bld(features='subst', is_copy=True, source=node, target='hooke.lv2/modgui/' + node.name, install_path=bundle + '/modgui')
    for node in bld.path.ant_glob('ttl/*.ttl.in'):
        bld(features='subst', source=node, target='hooke.lv2/' + node.name[:-len('.in')], install_path=bundle,
            LIB_EXT=library_ending(bld))


def library_ending(bld):
    return '.dll' if bld.env.DEST_OS == 'win32' else '.so'


def build_tools(bld):
    defines = ['HOOKE_VERSION="%s"' % VERSION, 'HOOKE_LV2DIR="%s"' % bld.env.LV2DIR]
    library(bld, 'hooke_parts', bld.path.ant_glob('plugin/*.c'), use='hooke_core LV2 M')
    use = 'hooke_parts hooke_analysis hooke_core LILV SNDFILE LV2 M DL PTHREAD'
    library(bld, 'hooke_tools', bld.path.ant_glob('tools/*/*.c', excl=['tools/*/main.c']), use=use, defines=defines)
    for node in bld.path.ant_glob('tools/commands/main.c'):
        bld.program(source=[node], target='hooke', name='hooke_program', use='hooke_tools ' + use, defines=defines)
    bld.install_files('${MANDIR}/man1', 'doc/hooke.1')


def build_tests(bld, folders):
    find_cmocka(bld)
    use = 'hooke_parts hooke_tools hooke_analysis hooke_core CMOCKA LILV SNDFILE LAPACK LV2 M DL PTHREAD'
    helpers = bld.path.ant_glob('tests/support/*.c', excl=['tests/*/test_*.c', 'tests/*/plant_*.c'])
    library(bld, 'hooke_helpers', helpers, use=use + ' HELPERS')
    env = bld.env.derive()
    env.cshlib_PATTERN = '%s.so'
    for node in bld.path.ant_glob('tests/support/plant_*.c'):
        bld.shlib(source=[node], target='tests/' + node.name[:-len('.c')], env=env, install_path=None,
                  linkflags=bld.env.PLUGIN_LINKFLAGS)
    for node in bld.path.ant_glob('tests/hosts/*.c', excl=['tests/hosts/watch_*.c', 'tests/hosts/test_*.c']):
        bld.program(source=[node], target='tests/hosts/' + node.name[:-len('.c')], use='hooke_helpers ' + use, install_path=None)
    bld.shlib(source=bld.path.ant_glob('tests/hosts/watch_*.c'), target='tests/hosts/watch', env=env, use='LILV LV2 DL',
              install_path=None)
    for node in bld.path.ant_glob(['tests/%s/test_*.c' % folder for folder in folders]):
        bld.program(source=[node], target='tests/' + node.name[:-len('.c')], use='hooke_helpers ' + use,
                    install_path=None)
    fuzzing.build_replays(bld, use)


# Here and not by configure, which is content without it if nothing is tested.
def find_cmocka(bld):
    try:
        flags = bld.cmd_and_log(bld.env.PKGCONFIG + ['--cflags', '--libs', 'cmocka'], quiet=Context.BOTH)
    except Errors.WafError:
        bld.fatal('the tests need cmocka, which pkg-config does not find')
    bld.parse_flags(flags, 'CMOCKA')


# A static library fit for the plugin as well; none when there is nothing to put into it.
def library(bld, name, sources, **more):
    if sources:
        bld.stlib(source=sources, target=name, cflags=['-fPIC'], install_path=None, **more)


# A host takes whatever lies in a directory of LV2_PATH for a bundle, so show it one with nothing but ours.
def link_bundle(bld):
    link = bld.bldnode.make_node('lv2/hooke.lv2')
    link.parent.mkdir()
    if not os.path.lexists(link.abspath()):
        os.symlink('../hooke.lv2', link.abspath())


# For clangd, clang-tidy and their like. A task run with its execution stubbed out only notes its command. What an earlier
# command has built besides, tests say, stays known.
def write_compile_commands(bld):
    directory = bld.bldnode.abspath()
    account = bld.bldnode.make_node('compile_commands.json')
    known = json.loads(account.read()) if account.exists() else []
    entries = {entry['file']: entry for entry in known if os.path.exists(entry['file'])}
    for task in all_tasks(bld):
        if type(task).__name__ == 'c':
            task.exec_command = lambda *args, **kw: 0
            task.run()
            source = task.inputs[0].abspath()
            entries[source] = {'directory': directory, 'file': source, 'arguments': task.last_cmd}
    account.write(json.dumps(list(entries.values()), indent=2) + '\n')


def all_tasks(bld):
    generators = [generator for group in bld.groups for generator in group]
    return [task for generator in generators for task in getattr(generator, 'tasks', [])]


# Testing and demonstrating: both build first


class TestContext(Build.BuildContext):
    cmd = 'test'
    fun = 'test'

    def __init__(self, **kw):
        super().__init__(**kw)
        self.variant = SANITIZED if Options.options.sanitize else sanitizing.chosen(Options.options) or ''


class DemoContext(Build.BuildContext):
    cmd = 'demo'
    fun = 'demo'


class ReportContext(Build.BuildContext):
    cmd = 'report'
    fun = 'report'


def test(bld):
    """builds, then runs all tests, or with --only some of them"""
    kind = sanitizing.chosen(bld.options)
    if bld.env['NO_%s' % kind]:
        bld.add_post_fun(run_tests)
        return
    build(bld)
    if not bld.env.WITH_TOOLS:
        bld.fatal('nothing can be tested without the libraries of %s' % bld.env.CHOICES['cross'])
    build_tests(bld, sanitizing.folders(kind))
    if any(name.startswith('fuzz_') for name, _ in test_programs(bld)):
        fuzzing.build(bld, plain(bld), wider(bld), ANALYSIS)
    bld.add_post_fun(run_tests)


def demo(bld):
    """builds, then renders doc/demo.mid and doc/demo.score to build/demo.wav and build/guitar.wav"""
    build(bld)
    bld.add_post_fun(render_demo)


def render_demo(bld):
    program = bld.bldnode.make_node('hooke').abspath()
    if not os.path.exists(program):
        bld.fatal('there is no program to render the demo with')
    for tune, wav in [('demo.mid', 'demo.wav'), ('demo.score', 'guitar.wav')]:
        command = [program, 'render', 'doc/' + tune, bld.bldnode.make_node(wav).path_from(bld.path)]
        if subprocess.call(command, cwd=bld.path.abspath(), env=run_environment(bld)):
            bld.fatal('the demo was not rendered')


def report(bld):
    """builds `hooke`, then draws the paper's figures over what it computes; report DIR: there, and not in build/report"""
    refuse_late_options(bld)
    directory = Options.commands.pop(0) if Options.commands else bld.bldnode.make_node('report').path_from(bld.path)
    if not bld.env.WITH_TOOLS:
        bld.fatal('there is no program to draw a report with')
    build_core(bld)
    build_tools(bld)
    bld.add_post_fun(lambda bld: draw_report(bld, directory))


# By a Python that has what it takes, be it not the one that runs waf.
def draw_report(bld, directory):
    for python in [sys.executable, '/usr/bin/python3']:
        if os.path.exists(python) and not subprocess.call([python, '-c', 'import matplotlib, numpy'],
                                                          stderr=subprocess.DEVNULL):
            command = [python, 'tools/report.py', bld.bldnode.make_node('hooke').abspath(), directory]
            if subprocess.call(command, cwd=bld.path.abspath()):
                bld.fatal('the report was not made')
            return
    bld.fatal('found no python3 with matplotlib and numpy: install python3-matplotlib and python3-numpy')


# The built bundle and the specifications are what a host sees, whatever else is installed. Numbers have a decimal point in any
# country.
def run_environment(bld):
    build_dir = bld.bldnode.abspath()
    env = dict(os.environ)
    env['LV2_PATH'] = os.pathsep.join([os.path.join(build_dir, 'lv2'), bld.env.SPEC_LV2DIR])
    env['HOOKE_BUNDLE'] = os.path.join(build_dir, 'lv2', 'hooke.lv2')
    env['HOOKE_BIN'] = os.path.join(build_dir, 'hooke')
    env['HOOKE_SOURCE'] = bld.path.abspath()
    env['WAFDIR'] = os.path.dirname(os.path.dirname(Context.__file__))
    env['LC_ALL'] = 'C'
    env.setdefault('UBSAN_OPTIONS', 'print_stacktrace=1')
    if bld.options.long:
        env['HOOKE_TEST_LONG'] = '1'
    return env


def run_tests(bld):
    programs = test_programs(bld)
    slow = bld.options.long or bld.options.sanitize or bld.options.valgrind or sanitizing.chosen(bld.options)
    timeout = bld.options.timeout or (3600 if slow else 600)
    environment = run_environment(bld)
    if bld.options.valgrind:
        programs = memcheck.wrap(programs, environment, bld.bldnode.abspath())
    # Not in /tmp, for there are systems that let nothing run there which a test has made.
    place = bld.bldnode.make_node('tests')
    place.mkdir()
    with tempfile.TemporaryDirectory(prefix='run.', dir=place.abspath(), ignore_cleanup_errors=True) as own:
        environment['TMPDIR'] = own
        for_scripts = allowed.restrict(environment, bld.path.make_node('waf').abspath(), os.path.join(own, 'programs'))
        environments = {name: for_scripts if name.endswith('.sh') else environment for name, _ in programs}
        results = runner.run_all(programs, bld.bldnode.abspath(), environments, bld.jobs, timeout)
    failed = [result['name'] for result in results if result['counts']['FAILED']]
    if failed:
        bld.fatal('failed: ' + ' '.join(failed))
    if not any(result['counts'][word] for result in results for word in ['PASSED', 'SKIPPED']):
        bld.fatal('no test ran')


def test_programs(bld):
    kind = sanitizing.chosen(bld.options)
    if bld.env['NO_%s' % kind]:
        return sanitizing.skipped(bld, kind)
    globs = ['tests/%s/test_*.c' % folder for folder in sanitizing.folders(kind)]
    compiled = [node.name[:-len('.c')] for node in bld.path.ant_glob(globs)]
    run = bld.env.CROSS_RUN
    programs = [(name, run + [bld.bldnode.make_node('tests/' + name).abspath()]) for name in compiled]
    if kind:
        programs = sanitizing.programs(kind, programs + fuzzing.replays(bld))
    elif not bld.env.CHOICES['cross']:
        programs += [(node.name, [node.abspath()]) for node in bld.path.ant_glob('tests/*/test_*.sh')]
        programs += fuzzing.programs(bld)
    return [program for program in programs if any(word in program[0] for word in bld.options.only.split(','))]


# Packing


def dist(ctx):
    """packs the tracked files into hooke-<version>.tar.xz"""
    ctx.algo = 'tar.xz'
    ctx.files = packing.files_to_pack(ctx)


def distcheck(ctx):
    """is a test here: ./waf test --long --only=test_dist"""
    ctx.fatal('the archive is checked by `./waf test --long --only=test_dist`')
