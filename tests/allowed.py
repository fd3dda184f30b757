"""The programs that test scripts may call: those that a bare Debian has, and those of the packages that `waf` lists.

The scripts are run with a PATH of these alone, so that one which calls another fails here as it would elsewhere. What a script
can do without, it looks for with `has` or `needs` of tests/support/claims.sh, and may call from there on.
"""

import os
import re
import shlex
import subprocess

FIELDS = ['db:Status-Status', 'Package', 'Essential', 'Priority', 'Pre-Depends', 'Depends', 'Provides']


def restrict(environment, launcher, directory):
    """Let PATH be the new `directory`, with these programs, and HOOKE_SEARCH what it was.

    Without dpkg nobody knows what a program belongs to, and all may be called.
    """
    environment = dict(environment, HOOKE_SEARCH=environment['PATH'])
    try:
        packages = installed_packages()
    except (OSError, subprocess.CalledProcessError):
        return environment
    os.makedirs(directory)
    owned = programs_of(with_dependencies(listed_packages(launcher), packages))
    wanted = environment.get('CC', '').split() + environment.get('AR', '').split()
    for folder in reversed(environment['PATH'].split(os.pathsep)):
        for name in os.listdir(folder) if os.path.isdir(folder) else []:
            path = os.path.join(folder, name)
            if name in wanted or os.path.realpath(path) in owned:
                stand_in(path, os.path.join(directory, name))
    return dict(environment, PATH=directory)


def listed_packages(launcher):
    """Those that `waf` installs for its tests."""
    with open(launcher, encoding='utf-8') as script:
        lists = re.findall(r"^(?:build|test)_packages='([^']*)'", script.read(), re.MULTILINE)
    return [name for names in lists for name in names.split()]


# By name, and by the names that they provide.
def installed_packages():
    form = '\t'.join('${%s}' % field for field in FIELDS) + '\n'
    told = subprocess.run(['dpkg-query', '-W', '-f', form], check=True, capture_output=True, encoding='utf-8').stdout
    packages = {}
    for line in told.splitlines():
        package = dict(zip(FIELDS, line.split('\t')))
        if package['db:Status-Status'] == 'installed':
            for provided in alternatives(package['Provides'].replace(',', '|')):
                packages.setdefault(provided, package)
            packages[package['Package']] = package
    return packages


# 'a (>= 1) | b:any' is a or b.
def alternatives(text):
    return [re.split(r'[ :(]', word.strip())[0] for word in text.split('|') if word.strip()]


def with_dependencies(names, packages):
    """Return the names of these packages, of the base of Debian, and of all that they depend on."""
    base = [name for name, package in packages.items()
            if name == package['Package'] and (package['Essential'] == 'yes' or package['Priority'] == 'required')]
    todo = list(names) + base + ['apt']
    found = set()
    while todo:
        package = packages.get(todo.pop())
        if package and package['Package'] not in found:
            found.add(package['Package'])
            for needed in (package['Pre-Depends'] + ',' + package['Depends']).split(','):
                todo += [name for name in alternatives(needed) if name in packages][:1]
    return found


# Where they really are: what is called awk may be a link to one of several.
def programs_of(names):
    told = subprocess.run(['dpkg-query', '-L'] + sorted(names), check=True, capture_output=True, encoding='utf-8').stdout
    return {os.path.realpath(path) for path in told.splitlines() if re.search(r'/s?bin/', path)}


# Not a link: there are programs that look for others where they were called, in any directory but one with a blank in its name.
def stand_in(path, name):
    with open(name, 'w', encoding='utf-8') as script:
        script.write('#!/bin/sh\nexec %s "$@"\n' % shlex.quote(path))
    os.chmod(name, 0o755)
