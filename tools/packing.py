"""Installing, uninstalling and packing, for the wscript: what is put where, and what is removed again."""

import json
import os

from waflib import Build, Context, Errors

# Left out of an archive made where there is no git to say what is tracked.
UNTRACKED = ['build', '.git', '.waf-cache', '.lock-waf*', 'hooke-*.tar.*', '**/__pycache__']


def set_directories(conf):
    """Set where the program (BINDIR), the bundle (LV2DIR) and the manual page (MANDIR) go."""
    home = os.path.expanduser('~')
    lv2dir = None
    if conf.options.user:
        conf.env.PREFIX = os.path.join(home, '.local')
        conf.env.BINDIR = os.path.join(home, '.local', 'bin')
        lv2dir = os.path.join(home, '.lv2')
    conf.env.LV2DIR = conf.options.lv2dir or lv2dir or os.path.join(conf.env.PREFIX, 'lib', 'lv2')
    conf.env.MANDIR = os.path.join(conf.env.PREFIX, 'share', 'man')


def keep_account_of_directories(bld):
    """Let an install note the directories that it makes, and an uninstall remove just those, if they are empty.

    waf would remove each directory which it has emptied, be it the system's or the user's own. The directories can be
    read by all, whatever the umask, as the files that waf installs can.
    """
    os.umask(0o022)
    account = bld.bldnode.make_node('made-directories.json')
    made = set(json.loads(account.read())) if account.exists() else set()
    bundle = os.path.join(bld.env.LV2DIR, 'hooke.lv2')
    made.add(in_stage(bld, bundle))  # it is ours, even if the account is lost
    copy = Build.inst.run

    def run(task):
        if bld.is_install == Build.INSTALL:
            for node in task.outputs:
                made.update(missing_above(node.abspath()))
        return copy(task)

    def remove_emptied(_, path):
        directory = os.path.dirname(path)
        try:
            while directory in made:
                os.rmdir(directory)
                directory = os.path.dirname(directory)
        except OSError:
            pass  # not empty, or gone

    Build.inst.run = run
    Build.inst.rm_empty_dirs = remove_emptied
    bld.add_post_fun(lambda _: account.write(json.dumps(sorted(made), indent=2) + '\n'))


def in_stage(bld, path):
    stage = bld.options.destdir
    return os.path.join(stage, os.path.splitdrive(path)[1].lstrip(os.sep)) if stage else path


def missing_above(path):
    directory = os.path.dirname(path)
    while not os.path.isdir(directory):
        yield directory
        directory = os.path.dirname(directory)


def files_to_pack(ctx):
    """Return what `dist` packs: what git tracks or, in a tree unpacked from such an archive, what is not made here.

    Such a tree has no .git, even if it lies inside another project's.
    """
    if os.path.exists(os.path.join(ctx.path.abspath(), '.git')):
        return tracked_files(ctx)
    return ctx.path.ant_glob('**', excl=UNTRACKED)


# Git would say nothing of another user's checkout. But who packs that runs its scripts, and so may run its git.
def tracked_files(ctx):
    try:
        names = ctx.cmd_and_log(['git', '-c', 'safe.directory=*', 'ls-files', '-z'], quiet=Context.BOTH).split('\0')
    except Errors.WafError as error:
        said = (getattr(error, 'stderr', '').strip() or 'it cannot be run').splitlines()[0]
        ctx.fatal('only git knows what of this checkout is to be packed: git: ' + said)
    nodes = [ctx.path.find_node(name) for name in names if name]
    return [node for node in nodes if node] or ctx.fatal('git tracks none of these files: there is nothing to pack')
