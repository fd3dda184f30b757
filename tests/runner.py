"""Runs test programs side by side and counts what they did; the wscript's `test` is made of it."""

import os
import re
import signal
import subprocess
import time
from concurrent.futures import ThreadPoolExecutor

# The exit status of a test that could not run here.
SKIP = 77


def run_all(programs, directory, environments, jobs, timeout_s):
    """Run (name, command) pairs in `directory`, `jobs` at a time, those named test_speed… alone; report each.

    `environments` has one for each name. The logs go to tests/NAME.log under `directory`. A result is a dictionary: name,
    counts (PASSED, FAILED, SKIPPED), trouble (why it failed, if not by its tests, or was skipped), output, seconds.
    """
    alone = [program for program in programs if program[0].startswith('test_speed')]
    side_by_side = [program for program in programs if program not in alone]
    running = set()

    def run(program):
        result = run_test(directory, environments[program[0]], timeout_s, running, *program)
        report(result)
        return result

    with ThreadPoolExecutor(jobs) as pool:
        try:
            results = list(pool.map(run, side_by_side))
        except KeyboardInterrupt:
            for process in list(running):
                kill(process)
            raise
    results += [run(program) for program in alone]
    print(summary(results), flush=True)
    return results


# The output goes to a file rather than a pipe: a pipe held open by a stray child would never end.
def run_test(directory, environment, timeout_s, running, name, command):
    log = os.path.join(directory, 'tests', name + '.log')
    os.makedirs(os.path.dirname(log), exist_ok=True)
    start = time.monotonic()
    with open(log, 'wb') as output:
        process = subprocess.Popen(command, cwd=directory, env=environment, stdin=subprocess.DEVNULL, stdout=output,
                                   stderr=subprocess.STDOUT, start_new_session=True)
        running.add(process)
        try:
            code = process.wait(timeout_s)
        except subprocess.TimeoutExpired:
            code = None
        finally:
            running.remove(process)
            if process.returncode is None:
                kill(process)
                process.wait()
    with open(log, encoding='utf-8', errors='replace') as output:
        return judge(name, code, output.read(), time.monotonic() - start)


# With all that it has started.
def kill(process):
    os.killpg(process.pid, signal.SIGKILL)


# Count the single tests. However a program ended, it is never taken for a success that it was not.
def judge(name, code, output, seconds):
    counts = {word: cmocka_count(word, output) for word in ['PASSED', 'FAILED', 'SKIPPED']}
    if name.endswith('.sh') or name.startswith('fuzz_'):
        counts = {'PASSED': int(code == 0), 'FAILED': 0, 'SKIPPED': 0}
    if code == SKIP and not any(counts.values()):
        counts['SKIPPED'] = 1
        return {'name': name, 'counts': counts, 'trouble': last_line(output), 'output': output, 'seconds': seconds}
    trouble = ''
    if code is None:
        trouble = 'timed out'
    elif code < 0:
        trouble = 'killed by ' + signal.Signals(-code).name
    elif code > 0:
        trouble = 'exit status %d' % code
    elif not any(counts.values()):
        trouble = 'ran no test'
    if trouble:
        counts['FAILED'] = max(1, counts['FAILED'])
    return {'name': name, 'counts': counts, 'trouble': trouble, 'output': output, 'seconds': seconds}


# What a test that could not run says of it.
def last_line(output):
    return (output.strip().splitlines() or [''])[-1]


def cmocka_count(word, output):
    found = re.findall(r'\[ +%s +\] (?:.*: )?(\d+) test\(s\)' % word, output)
    return sum(int(number) for number in found)


def report(result):
    counts = ', '.join('%d %s' % (n, word.lower()) for word, n in result['counts'].items() if n)
    failed = result['counts']['FAILED']
    line = '%-28s %-32s %7.2f s  %s' % (result['name'], counts, result['seconds'], result['trouble'])
    print(line.rstrip() + ('\n' + result['output'].rstrip() if failed else ''), flush=True)


def summary(results):
    passed, failed, skipped = [sum(r['counts'][word] for r in results) for word in ['PASSED', 'FAILED', 'SKIPPED']]
    return '%d passed, %d failed' % (passed, failed) + (', %d skipped' % skipped if skipped else '')
