"""Building for another machine, for the wscript: `configure --cross=TRIPLE`, as aarch64-linux-gnu.

Where the libraries of that machine are at hand, in a copy of a small part of its system under .waf-cache/TRIPLE, all
is built, and the tests are run by qemu. Where they are not, as for Windows, the bundle alone is.
"""

import os
import subprocess


def options(opt):
    opt.add_option('--cross', metavar='TRIPLE', help='configure: build for that machine, as aarch64-linux-gnu')


def prepare(conf):
    """Choose the compilers and where pkg-config looks, before they are asked."""
    triple = conf.options.cross
    if not triple:
        return
    conf.environ.setdefault('CC', triple + '-gcc')
    conf.environ.setdefault('AR', triple + '-ar')
    system = get_system(conf, triple)
    conf.env.CROSS_SYSTEM = system
    if system:
        conf.env.CROSS_RUN = ['qemu-' + triple.split('-')[0], '-L', system]
        described = os.path.join(system, 'usr/lib', triple, 'pkgconfig')
        conf.env.PKGCONFIG = ['env', 'PKG_CONFIG_SYSROOT_DIR=' + system, 'PKG_CONFIG_LIBDIR=' + described, 'pkg-config']
        conf.env.CFLAGS = conf.env.LINKFLAGS = ['--sysroot=' + system]
    else:
        conf.msg('At hand for ' + triple, 'no libraries, so that the bundle alone is built', 'YELLOW')


# None where Debian does not have that machine's packages, or where they are not to be fetched.
def get_system(conf, triple):
    system = conf.path.make_node('.waf-cache/' + triple).abspath()
    if os.path.isdir(system):
        return system
    if 'linux' not in triple or conf.environ.get('HOOKE_NO_INSTALL', '0') != '0':
        return ''
    if subprocess.call(['sh', conf.path.make_node('tools/fetch_system.sh').abspath(), triple, system]):
        conf.fatal('the libraries for %s could not be fetched' % triple)
    return system


def use_lv2_headers(conf):
    """Show the compiler the headers of LV2, which are the same for all machines, and no others of this one."""
    directory = conf.cmd_and_log(conf.env.PKGCONFIG + ['--variable=includedir', 'lv2'], quiet=True).strip()
    headers = conf.bldnode.make_node('headers')
    headers.mkdir()
    link = os.path.join(headers.abspath(), 'lv2')
    if not os.path.lexists(link):
        os.symlink(os.path.join(directory, 'lv2'), link)
    conf.env.CFLAGS_LV2 = ['-isystem', headers.abspath()]


def suit_windows(conf):
    """Allow for what is different there.

    The macros of its <math.h> convert to float where they do not use it. Its stacks begin at multiples of 16 bytes
    even for vectors of 32, which gcc takes them to be fit for, so that the assembler has to see to it. Its threads
    are a library, which a plugin had better bring along.
    """
    conf.env.STLIB_PTHREAD, conf.env.LIB_PTHREAD = conf.env.LIB_PTHREAD, []
    conf.env.append_value('CFLAGS', ['-Wno-float-conversion', '-Wa,-muse-unaligned-vector-move'])
