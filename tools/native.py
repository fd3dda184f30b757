"""What is run while Hooke is built, on the machine that builds, for the wscript: the program that makes core/bank/bodies.c.

It reduces the networks and reads the tables of presets/bodies/, with LAPACK, which the plugin so can do without. Where all is
built for another machine, it has a compiler of its own: CC_FOR_BUILD, or what is found.
"""

import os

SOURCES = ['core/base/*.c', 'core/bank/*.c', 'core/string/pole.c', 'core/analysis/*.c', 'tools/bodies/*.c'] + [
    'tools/formats/%s.c' % name for name in ['bytes', 'escape', 'text', 'scene', 'scene_body', 'scene_mesh', 'scene_reader']]

# It is not worth more than every processor has.
WIDER = ['core/*/*_avx2.c', 'core/*/*_avx512.c']

# What is the target's own and would be taken for ours.
OF_TARGET = ['CC', 'AR', 'CFLAGS', 'CPPFLAGS', 'LDFLAGS', 'LINKFLAGS', 'PKG_CONFIG_PATH']


def configure(conf, flags):
    """makes the environment `native`, before sanitizers come into the other"""
    if conf.options.cross:
        conf.setenv('native')
        find_compiler(conf)
        find_lapack(conf)
        conf.env.CFLAGS = flags
        conf.env.INCLUDES = [conf.path.abspath()]
    else:
        conf.setenv('native', conf.env)
    conf.env.append_value('CFLAGS', ['-O2'])
    conf.env.CFLAGS = [flag for flag in conf.env.CFLAGS if flag != '-Og']
    conf.setenv('')


def find_compiler(conf):
    kept = {name: conf.environ.pop(name) for name in OF_TARGET if name in conf.environ}
    if 'CC_FOR_BUILD' in conf.environ:
        conf.environ['CC'] = conf.environ['CC_FOR_BUILD']
    conf.load('compiler_c')
    conf.environ.pop('CC', None)
    conf.environ.update(kept)


def find_lapack(conf):
    conf.check_cc(lib='m', uselib_store='M', msg='Checking for library m of this machine')
    conf.check_cfg(package='lapack', uselib_store='LAPACK', args=['--cflags', '--libs'], msg='Checking for LAPACK of this machine',
                   errmsg='none: it is needed to make the bodies while building (Debian: liblapack-dev)')


def bodies(bld):
    """core/bank/bodies.c, which is to be built as the rest of that room is"""
    return bld.bldnode.find_or_declare('core/bank/bodies.c')


def build(bld):
    """makes it, anew when a body or what reduces it has changed"""
    env = bld.all_envs['native'].derive()
    bld.program(source=bld.path.ant_glob(SOURCES, excl=WIDER), target='native/bodies', env=env, use='LAPACK M', install_path=None)
    program = bld.bldnode.find_or_declare('native/bodies')
    files = bld.path.ant_glob(['presets/bodies/*.scene', 'presets/bodies/*.body'])
    bld(rule=run, source=[program] + files, target=[bodies(bld)], name='bodies')


def run(task):
    names = [node.path_from(task.generator.bld.path) for node in task.inputs[1:]]
    command = [task.inputs[0].abspath(), task.outputs[0].abspath()] + names
    return task.exec_command(command, cwd=task.generator.bld.path.abspath(), env=dict(os.environ, LC_ALL='C'))
