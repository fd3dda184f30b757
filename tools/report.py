"""Draw the figures of Morgan and Qiao's paper, hold its numbers against `hooke`, and weigh error against run time.

    python3 tools/report.py HOOKE DIR [--seconds S]

A curve is the paper's formula, computed here; over it lie points that HOOKE, the program, computes by its own code.
Where the two are further apart than is stated, or a number is not the paper's, that is said in one line, nothing is
written, and the status is 1. Equations, figures and sections are numbered as in the preprint of February 19, 2009.
"""

import argparse
import base64
import csv
import html
import io
import json
import math
import os
import re
import struct
import subprocess
import sys
import tempfile

try:
    import matplotlib
    import numpy as np
except ImportError as error:
    sys.exit('report: %s; Debian has it in python3-matplotlib and python3-numpy' % error)

matplotlib.use('svg')
import matplotlib.pyplot as plt  # noqa: E402  (after the choice of what draws)

SOURCE = os.path.dirname(os.path.dirname(os.path.abspath(__file__)))

# Okabe and Ito's colours, which the colour-blind can tell apart, and tints of them for the regions.
BLUE, RED, GREEN, PURPLE, ORANGE, GREY = '#0072b2', '#d55e00', '#009e73', '#b0558a', '#c98400', '#8c8c8c'
TINTS = {'vibrates': '#d3e6f3', 'creeps': '#fbe8c4', 'flips': '#f2dbe8', 'grows': '#e6e6e6'}
MARKS = {'vibrates': ('o', BLUE), 'creeps': ('v', ORANGE), 'flips': ('^', PURPLE), 'grows': ('x', GREY)}
HOOKE = {'linestyle': 'none', 'marker': 'o', 'markerfacecolor': 'white', 'markeredgecolor': 'black', 'zorder': 5}
QUARTERS = ([i * math.pi / 4.0 for i in range(5)], ['0', 'π/4', 'π/2', '3π/4', 'π'])
BELOW = {'loc': 'upper left', 'bbox_to_anchor': (0.0, -0.12), 'ncol': 3, 'columnspacing': 1.0}

plt.rcParams.update({'svg.fonttype': 'none', 'svg.hashsalt': 'hooke', 'font.family': 'sans-serif', 'font.size': 10,
                     'axes.spines.top': False, 'axes.spines.right': False, 'lines.linewidth': 1.4,
                     'lines.markersize': 4.5, 'legend.frameon': False, 'legend.fontsize': 9,
                     'figure.figsize': (7.0, 4.2), 'figure.max_open_warning': 0, 'savefig.facecolor': 'white'})

# What is allowed between hooke and a formula: rounding, where nothing magnifies it much; samples in floats.
EXACT, FLOATS = 1e-9, 1e-6


class Fault(Exception):
    """What was found is not what was expected."""


# The formulas: a = (ω0 h)² and g = γh are all that matters of a mass.


def two_poles(a, g):
    """(25): root 1, where the surd is added, and root 2."""
    half = 0.5 * (2.0 - np.asarray(a) - g)
    surd = np.sqrt(half * half - (1.0 - g) + 0j)
    return half + surd, half - surd


def larger_pole(a, g):
    """The one that is heard; of a pair the upper one."""
    one, two = two_poles(a, g)
    return np.where(np.abs(two) > np.abs(one) * (1.0 + 1e-12), two, one)


def of_eigenvalue(sigma_h, mu_h):
    """(35): a and g of the analog eigenvalue σ ± jμ."""
    return np.square(sigma_h) + np.square(mu_h), -2.0 * np.asarray(sigma_h)


def motion(a, g):
    """The region of Figure 12, in hooke's words."""
    z = complex(larger_pole(a, g))
    if a + 2.0 * g > 4.0:
        return 'grows'
    return 'vibrates' if z.imag != 0.0 else 'creeps' if z.real > 0.0 else 'flips'


def root(square):
    """0 where there is none: what is drawn then lies on the axis."""
    return np.sqrt(np.maximum(0.0, square))


def limit_of_stability(sigma_h):
    """(36)"""
    return root(4.0 + 4.0 * sigma_h - np.square(sigma_h))


def limit_of_pair(sigma_h, sign):
    """(38), with the upper or the lower sign of its inner surd."""
    inner = 2.0 * np.sqrt(1.0 + 2.0 * sigma_h)
    return root(-np.square(sigma_h) + 2.0 + 2.0 * sigma_h + sign * inner)


def limit_of_zero(sigma_h):
    """(39)"""
    return root(-np.square(sigma_h) + 2.0 * sigma_h + 2.0)


def end_of_pair(mu_h):
    """(38) solved for σh, by bisection of whether the poles are a pair."""
    left, right = -1.0, 0.0
    for _ in range(60):
        middle = 0.5 * (left + right)
        is_pair = complex(two_poles(*of_eigenvalue(middle, mu_h))[0]).imag != 0.0
        left, right = (left, middle) if is_pair else (middle, right)
    return right


def turning(mu_h):
    """(39) solved for σh."""
    return 1.0 - math.sqrt(3.0 - mu_h * mu_h)


def line_of_frequency(sigma_h, angle):
    """(30) solved for ω0 h, and (35): the μh where the digital frequency is `angle`."""
    g = -2.0 * np.asarray(sigma_h)
    return root(2.0 - g - 2.0 * np.sqrt(1.0 - g) * math.cos(angle) - np.square(sigma_h))


def line_of_damping(sigma_h, z):
    """(40) solved where poles are real: the μh where the larger is z."""
    g = -2.0 * np.asarray(sigma_h)
    return root(2.0 - g - z - (1.0 - g) / z - np.square(sigma_h))


def discrete(a, g, x, u, n):
    """Sample n of a mass that starts from x with the velocity u/h: its poles, weighted so that x[1] is right too."""
    one, two = two_poles(a, g)
    weight = (x + (1.0 - g) * u - a * x - two * x) / (one - two)
    return np.real(weight * one ** np.asarray(n) + (x - weight) * two ** np.asarray(n))


# The program


def mass_lines(a, g, rate_hz):
    return ['rate %.17g' % rate_hz, 'mass m 1', 'ground e', 'spring m e %.17g' % (a * rate_hz ** 2),
            'damper m e %.17g' % (g * rate_hz)]


class Hooke:
    """Runs the program, in a directory of its own."""

    def __init__(self, program, directory):
        self.program = os.path.abspath(program)
        self.directory = directory

    def run(self, *words, statuses=(0,)):
        done = subprocess.run([self.program, *words], cwd=self.directory, capture_output=True, text=True, check=False)
        if done.returncode not in statuses:
            raise Fault('hooke %s: status %d: %s' % (' '.join(words), done.returncode, done.stderr.strip()))
        return done.stdout

    def scene(self, lines):
        with open(os.path.join(self.directory, 'one.scene'), 'w', encoding='utf-8') as file:
            file.write('\n'.join(lines) + '\n')
        return 'one.scene'

    def modes(self, lines):
        """All modes, with their poles; of an unstable scene too."""
        return json.loads(self.run('modes', '--json', self.scene(lines), statuses=(0, 3)))['modes']

    def mass(self, a, g, rate_hz=1000.0):
        """The mode of one mass, its two poles, and the angle of the one that is heard."""
        mode, = self.modes(mass_lines(a, g, rate_hz))
        mode['angle'] = 2.0 * math.pi * mode['frequency_hz'] / rate_hz
        mode['z'] = [complex(*pole) for pole in mode['poles']]
        return mode

    def samples(self, a, g, x, u, n):
        """What one mass plays; the same a and g are the same samples at any rate."""
        rate = 48000.0
        rest = ['at 0 displace m %.17g' % x, 'at 0 strike m %.17g' % (u * rate), 'pickup m 1', 'end %.17g' % (n / rate)]
        self.run('render', '--quiet', '--bits', '32', self.scene(mass_lines(a, g, rate) + rest), 'one.wav')
        with open(os.path.join(self.directory, 'one.wav'), 'rb') as file:
            wav = file.read()
        at = wav.index(b'data')
        n_channels, n_bytes = struct.unpack_from('<H', wav, 22)[0], struct.unpack_from('<I', wav, at + 4)[0]
        return np.frombuffer(wav, '<f4', n_bytes // 4, at + 8)[::n_channels].astype(float)[:n]


class Report:
    """What is gathered; `files` are written when all is well."""

    def __init__(self, hooke):
        self.hooke = hooke
        self.figures = []     # (name, title, words, figure)
        self.numbers = []     # (where, quantity, unit, paper, ours, difference, allowed)
        self.agreements = []  # (figure, what, how many, furthest apart, allowed)
        self.files = {}

    def agree(self, figure, what, ours, formula, allowed=EXACT):
        apart = np.abs(np.atleast_1d(ours) - np.atleast_1d(formula))
        worst = float(np.max(apart))
        if not worst <= allowed:
            raise Fault('figure %s: %s: hooke and the formula are %.3g apart, allowed are %.3g'
                        % (figure, what, worst, allowed))
        self.agreements.append((str(figure), what, str(apart.size), '%.1e' % worst, '%.0e' % allowed))

    def number(self, where, quantity, unit, paper, ours, allowed=None):
        """One unit of the last printed digit is allowed, unless the paper's own rounding is known to be worse."""
        decimals = len(paper.partition('.')[2])
        allowed = 10.0 ** -decimals if allowed is None else allowed
        if not abs(ours - float(paper)) <= allowed:
            raise Fault('%s: %s: the paper has %s, ours is %.17g' % (where, quantity, paper, ours))
        self.numbers.append((where, quantity, unit, paper, '%.*f' % (decimals + 1, ours),
                             '%.1e' % (ours - float(paper)), '%.0e' % allowed))

    def region(self, figure, sigma_h, mu_h, expected):
        found = self.hooke.mass(*of_eigenvalue(sigma_h, mu_h))['region']
        if found != expected:
            raise Fault('figure %s: at σh = %.9g, μh = %g hooke has %s, expected %s'
                        % (figure, sigma_h, mu_h, found, expected))

    def picture(self, name, title, words, figure):
        self.figures.append((name, title, words, figure))

    def render(self):
        for name, _, _, figure in self.figures:
            svg = io.StringIO()
            figure.savefig(svg, format='svg', metadata={'Date': None, 'Creator': None}, bbox_inches='tight')
            self.files[name + '.svg'] = svg.getvalue()


def axes_of(xlabel, ylabel, figsize=(7.0, 4.2)):
    figure, axes = plt.subplots(figsize=figsize)
    axes.set(xlabel=xlabel, ylabel=ylabel)
    return figure, axes


# Figures 3 to 5: an undamped mass under the three methods of Euler, ω0 h = π/4


def draw_eulers(report):
    w = math.pi / 4.0

    def forward(x, u):
        return x + u, u - w * w * x

    def backward(x, u):
        after = (u - w * w * x) / (1.0 + w * w)
        return x + after, after

    growth = abs(1.0 + 1j * w)
    for number, name, n_steps, z, step, words in [
            (3, 'Forward', 16, 1.0 + 1j * w, forward, 'Each step multiplies the amplitude by %.4f.' % growth),
            (4, 'Backward', 32, 1.0 / (1.0 - 1j * w), backward, 'Each step divides the amplitude by %.4f.' % growth),
            (5, 'Symplectic', 32, None, None, 'The amplitude stays, and the frequency is %.4f times as high.'
             % (2.0 * math.asin(0.5 * w) / w))]:
        n = np.arange(n_steps + 1)
        fine = np.linspace(0.0, n_steps, 20 * n_steps + 1)
        if step:
            states = [(1.0, 0.0)]
            for _ in range(n_steps):
                states.append(step(*states[-1]))
            points, formula = np.array(states)[:, 0], np.real(z ** n)
            report.agree(number, 'the method, stepped by this script', points, formula)
        else:
            points, formula = report.hooke.samples(w * w, 0.0, 1.0, 0.0, n_steps + 1), discrete(w * w, 0.0, 1.0, 0.0, n)
            report.agree(number, 'samples', points, formula, FLOATS)
        figure, axes = axes_of('time [ms]', 'displacement')
        axes.plot(fine, np.cos(w * fine), color=GREY, label='analytic solution, $\\cos \\omega_0 t$')
        axes.plot(n, formula, color=BLUE, label='%s Euler, in closed form' % name.lower())
        axes.plot(n, points, label='the method, stepped' if step else 'hooke render', **HOOKE)
        axes.legend(loc='lower left', bbox_to_anchor=(0.0, 1.0), ncol=3)
        report.picture('figure-%02d' % number,
                       '%s Euler approximation of the undamped mass-spring system (h = .001)' % name,
                       'ω0 = 125 · 2π, x(0) = 1, x′(0) = 0, a thousand steps a second. %s How long the paper draws it '
                       'for is not in print.' % words, figure)


# Figures 8 and 9: the poles in the z-plane


def draw_poles(report, number, g, masses):
    edges = [math.sqrt(2.0 - g + sign * 2.0 * math.sqrt(1.0 - g)) for sign in (-1.0, 1.0)]
    w = np.concatenate([edges[0] * np.linspace(0.0, 1.0, 80), np.linspace(*edges, 1500),
                        edges[1] + np.linspace(0.0, 1.6, 800) ** 4])
    one, two = two_poles(w * w, g)
    inside = (w >= edges[0]) & (w <= edges[1])
    modes = [report.hooke.mass(m * m, g) for m in masses]

    def in_order(poles):
        return sorted((complex(z) for z in poles), key=lambda z: (round(z.imag, 6), z.real))

    found = np.array([in_order(mode['z']) for mode in modes])
    report.agree(number, 'both poles', found, np.array([in_order(two_poles(m * m, g)) for m in masses]))
    figure, axes = axes_of('real part', 'imaginary part', figsize=(7.0, 4.9))
    turn = np.linspace(0.0, 2.0 * math.pi, 300)
    axes.plot(np.cos(turn), np.sin(turn), color=GREY, linestyle='--', linewidth=1.0, label='unit circle')
    axes.axhline(0.0, color='#d0d0d0', linewidth=0.8)
    axes.axvline(0.0, color='#d0d0d0', linewidth=0.8)
    axes.plot(one.real, np.where(inside, one.imag, 0.0), color=BLUE, label='root 1, the surd added')
    axes.plot(two.real, np.where(inside, two.imag, 0.0), color=RED, label='root 2, the surd subtracted')
    axes.plot(found.real.ravel(), found.imag.ravel(), label='hooke modes', **HOOKE)
    r = math.sqrt(1.0 - g)

    def arrow(colour, start, end):
        axes.annotate('', xy=(end.real, end.imag), xytext=(start.real, start.imag),
                      arrowprops={'arrowstyle': '-|>', 'mutation_scale': 15, 'shrinkA': 0, 'shrinkB': 0, 'color': colour})

    for turned in ((0.8, 2.4) if r > 0.5 else (1.8,)):
        z = r * np.exp(1j * turned)
        arrow(BLUE, z * np.exp(-0.05j), z)
        arrow(RED, np.conj(z * np.exp(-0.05j)), np.conj(z))
    arrow(RED, -1.7 + 0j, -1.95 + 0j)
    arrow(BLUE, *((-0.5 + 0j, -0.3 + 0j) if r > 0.5 else (0.6 + 0j, 0.45 + 0j)))
    axes.set(aspect='equal', xlim=(-2.0, 1.25), ylim=(-1.15, 1.15))
    axes.legend(**dict(BELOW, ncol=4, handletextpad=0.4))
    report.picture('figure-%02d' % number,
                   'Damped mass-spring system using symplectic Euler: poles on the z-plane with γh = %g' % g,
                   'The arrows show how the two roots of (25) move while ω0 h grows from 0: from the positive real axis, '
                   'around the circle of radius √(1 − γh) = %.4f where z is complex (29), to the negative real axis, '
                   'where root 1 goes to the origin and root 2 leaves the unit circle at ω0 h = √(4 − 2γh) = %.4f (32). '
                   'At ω0 h = π root 2 is at %.2f, out of the picture.'
                   % (r, math.sqrt(4.0 - 2.0 * g), two_poles(math.pi ** 2, g)[1].real), figure)


# Figures 10 and 11: frequency warping


def draw_warping(report):
    for number, g, at in [
            (10, 0.0, [0.1, 0.3, 0.5, 0.7, 0.9, 1.1, 1.3, 1.5, 1.7, 1.8, 1.9, 1.95, 1.99]),
            (11, 0.5, [0.1, 0.2, 0.28, 0.3, 0.35, 0.45, 0.6, 0.8, 1.0, 1.2, 1.4, 1.55, 1.65, 1.7, 1.71, 1.72])]:
        w = np.linspace(0.0, math.sqrt(4.0 - 2.0 * g), 2001)
        found = [report.hooke.mass(m * m, g)['angle'] for m in at]
        report.agree(number, 'digital frequency [rad/sample]', found, np.angle(larger_pole(np.square(at), g)))
        figure, axes = axes_of('$\\omega_0 h$ [rad/sample]', 'frequency [rad/sample]')
        axes.plot([0.0, 2.0], [0.0, 2.0], color=GREY, linestyle=':', label='$\\omega_0 h$')
        if g:
            axes.plot(w, root(w * w - 0.25 * g * g), color=GREEN, linestyle='--', label='analog, $\\mu h$')
        axes.plot(w, np.angle(larger_pole(w * w, g)), color=BLUE, label='digital, $\\omega_d h$ (30)')
        axes.plot(at, found, label='hooke modes', **HOOKE)
        axes.set(xlim=(0.0, 2.03), ylim=(0.0, 3.3))
        axes.set_yticks(*QUARTERS)
        if g:
            for name, printed, sign in (('lower', '0.293', -1.0), ('upper', '1.707', 1.0)):
                edge = math.sqrt(2.0 - g + sign * 2.0 * math.sqrt(1.0 - g))
                report.number('Figure 11', '%s limit of ω0 h for z to be complex (27)' % name, 'rad', printed, edge)
                found = [report.hooke.mass((edge + side * sign) ** 2, g)['region'] for side in (-1e-6, 1e-6)]
                if found != ['vibrates', 'creeps' if sign < 0 else 'flips']:
                    raise Fault('figure 11: on both sides of %s hooke has %s' % (printed, ' and '.join(found)))
                axes.axvline(edge, color=RED, linewidth=0.8)
                axes.text(edge - 0.02, 2.0, '%.3f' % edge, color=RED, rotation=90, ha='right', va='center')
        axes.legend(loc='upper left', bbox_to_anchor=(0.2, 1.0))
        title, words = {
            10: ('Frequency warping of undamped system',
                 'Without damping ω_d h = 2 asin(ω0 h/2): true at low frequencies, warped upwards above, and at π '
                 'rad/sample, the Nyquist limit, where ω0 h = 2.'),
            11: ('Frequency for damped mass-spring system, γh = .5',
                 'h = .001, γ = 500. The digital frequency reaches the Nyquist limit at around ω0 h = 1.7; z is complex '
                 'between the red lines, at the limits of (27). The curves end where the system becomes unstable, at '
                 'ω0 h = √(4 − 2γh) = %.3f.' % math.sqrt(3.0))}[number]
        report.picture('figure-%d' % number, title, words, figure)


# Figures 12, 17 and 21: the regions of the s-plane


def draw_regions(axes):
    """By their borders (36), (38) and (39)."""
    pair = np.linspace(-0.5, 0.0, 250)
    zero = 1.0 - math.sqrt(3.0) + (math.sqrt(3.0) - 1.5) * np.linspace(0.0, 1.0, 150) ** 2
    stable = 2.0 - math.sqrt(8.0) + 1e-12 + (math.sqrt(8.0) - 2.0) * np.linspace(0.0, 1.0, 250) ** 2
    axes.set_facecolor(TINTS['grows'])
    for x, low, high, region in [(stable, 0.0, limit_of_stability(stable), 'flips'),
                                 (zero, 0.0, limit_of_zero(zero), 'creeps'),
                                 (pair, 0.0, limit_of_pair(pair, -1.0), 'creeps'),
                                 (pair, limit_of_pair(pair, -1.0), limit_of_pair(pair, 1.0), 'vibrates')]:
        axes.fill_between(x, low, high, color=TINTS[region], linewidth=0)
    axes.plot(stable, limit_of_stability(stable), color=RED, label='(36): limit of stability')
    axes.plot(np.append(pair[::-1], pair), np.append(limit_of_pair(pair, -1.0)[::-1], limit_of_pair(pair, 1.0)),
              color=BLUE, label='(38): z is complex')
    axes.plot(zero, limit_of_zero(zero), color=PURPLE, label='(39): $\\omega_d$ is 0 or π')
    axes.plot([-0.5], [math.sqrt(0.75)], marker='D', color='black', markersize=4, linestyle='none', zorder=6)
    axes.set(xlim=(-1.0, 0.0), ylim=(0.0, 2.05), xlabel='$\\sigma h$', ylabel='$\\mu h$')


def name_regions(axes):
    box = {'facecolor': 'white', 'edgecolor': 'none', 'alpha': 0.8, 'pad': 1.5}
    for name, x, y in [('z is complex', -0.24, 1.02), ('$\\omega_d = 0$', -0.6, 0.22), ('$\\omega_d = \\pi$', -0.62, 1.02),
                       ('unstable', -0.75, 1.66)]:
        axes.text(x, y, name, ha='center', va='center', bbox=box, zorder=7)


def draw_plane(report):
    figure, axes = plt.subplots(figsize=(7.0, 5.0))
    draw_regions(axes)
    points = {region: [] for region in MARKS}
    elsewhere = 0
    for sigma_h in np.linspace(-0.965, -0.035, 16):
        for mu_h in np.linspace(0.06, 1.98, 13):
            region = report.hooke.mass(*of_eigenvalue(sigma_h, mu_h))['region']
            elsewhere += region != motion(*of_eigenvalue(sigma_h, mu_h))
            points[region].append((sigma_h, mu_h))
    report.agree(12, 'points in another region, of %d' % sum(map(len, points.values())), elsewhere, 0, 0.0)
    for region, (mark, colour) in MARKS.items():
        axes.plot(*zip(*points[region]), mark, color=colour, markersize=3.5, label='hooke: %s' % region)
    name_regions(axes)
    axes.legend(**BELOW)
    report.picture('figure-12', 'Regions of the s-plane',
                   'Where a pole σ ± jμ of the analog system lies says what its simulation does; negative frequencies are '
                   'the mirror image. The diamond is the singular point of section 3.7, γh = 1 and μh = √3/2, where both '
                   'poles are 0. Each small mark is a mass of which hooke was asked.', figure)


# Figures 13 to 15: digital against analog damping


def draw_dampings(report):
    at = np.array([-0.95, -0.9, -0.85, -0.8, -0.75, -0.7, -0.65, -0.6, -0.57, -0.54, -0.52, -0.505, -0.495, -0.48, -0.45,
                   -0.4, -0.35, -0.3, -0.25, -0.2, -0.15, -0.1, -0.05, -0.02])
    pair, pi = 'z leaves the region where it is complex', 'z enters the region of ω_d = π'
    for number, mu_h, printed in [(13, 0.1, {'-0.1954': (end_of_pair, pair), '-0.7292': (turning, pi)}),
                                  (14, 0.8, {'-0.4983': (end_of_pair, pair), '-0.5362': (turning, pi)}),
                                  (15, 0.87, {'-0.4977': (turning, '(39)')})]:
        end, unstable = end_of_pair(mu_h), 2.0 - math.sqrt(8.0 - mu_h * mu_h)
        report.region(number, end + 1e-6, mu_h, 'vibrates')
        report.region(number, end - 1e-6, mu_h, 'flips' if number == 15 else 'creeps')
        if number != 15:
            report.region(number, turning(mu_h) + 1e-6, mu_h, 'creeps')
            report.region(number, turning(mu_h) - 1e-6, mu_h, 'flips')
        sigma = np.unique(np.concatenate([np.linspace(-1.0, 0.0, 500), -0.5 + np.linspace(-0.3, 0.3, 400) ** 5,
                                          [end, turning(mu_h)]]))
        damping = np.log(np.abs(larger_pole(*of_eigenvalue(sigma, mu_h))))
        found = np.log([report.hooke.mass(*of_eigenvalue(s, mu_h))['radius'] for s in at])
        report.agree(number, 'digital damping, σ_d h', found, np.log(np.abs(larger_pole(*of_eigenvalue(at, mu_h)))))
        figure, axes = axes_of('analog damping, $\\sigma h$', 'digital damping, $\\sigma_d h$')
        axes.axhline(0.0, color='#d0d0d0', linewidth=0.8)
        axes.plot(sigma, sigma, color=GREY, linestyle='--', label='$\\sigma h$')
        axes.plot(sigma, damping, color=BLUE, label='(40)')
        axes.plot(at, found, label='hooke modes', **HOOKE)
        low = min(-1.1, float(np.min(damping)) - 0.3)
        for text, (where, what) in printed.items():
            edge = where(mu_h)
            report.number('Figure %d' % number, 'σh at μh = %g: %s' % (mu_h, what), '', text, edge)
            axes.axvline(edge, color=RED, linewidth=0.9, linestyle=':')
            is_left = where is turning and number != 15
            axes.text(edge + (-0.008 if is_left else 0.008), low + 0.02, '%.4f' % edge, color=RED, rotation=90,
                      ha='right' if is_left else 'left', va='bottom')
        axes.set(xlim=(-1.0, 0.0), ylim=(low, 0.35))
        axes.legend(loc='lower left', bbox_to_anchor=(0.0, 1.0), ncol=3)
        words = ('The first corner from the right is where z leaves the region where it is complex (38), the second where '
                 'ω_d becomes π (39). From there on more damping is less: at σh = 2 − √(8 − (μh)²) = %.4f the curve passes 0 '
                 'and the system becomes unstable.' % unstable)
        if number == 15:
            words = ('The paper says that at −0.4977 z leaves the region where it is complex. That is a slip: (39) is for '
                     'γh ≥ 1, and here, at γh = 0.9954, z is still complex and only its angle passes π/2 (the dotted line). '
                     'The corner, where by (38) the pair ends and ω_d becomes π at once, is at %.6f; no region of ω_d = 0 is '
                     'left, for μh is above √3/2. The system becomes unstable at %.4f.' % (end, unstable))
        report.picture('figure-%d' % number, 'Digital damping vs. analog damping, μh = %s' % ('%g' % mu_h)[1:], words,
                       figure)
    report.number('Section 3.7', 'μh of the singular point, √3/2, γh = 1', '', '0.866', math.sqrt(0.75))
    report.agree('12', 'both poles, at the singular point', report.hooke.mass(1.0, 1.0)['z'], 0.0)


# Figures 16 and 17: lines of one digital frequency, and of one digital damping


def draw_lines(report):
    figure, axes = axes_of('$\\sigma h$', '$\\mu h$', figsize=(7.0, 5.0))
    sigma = -0.5 + 0.5 * np.linspace(0.0, 1.0, 250) ** 2
    at = np.array([-0.45, -0.3, -0.15, -0.01])
    found = []  # (σh, μh, digital frequency by hooke, by the formula)
    for sign in (-1.0, 1.0):
        axes.plot(sigma, limit_of_pair(sigma, sign), color=GREY, linewidth=1.0,
                  label='(38): z is complex in between' if sign < 0 else None)
    for angle in np.arange(0.25, 3.1, 0.25):
        axes.plot(sigma, line_of_frequency(sigma, angle), color=BLUE, label='(30)' if angle == 0.25 else None)
        if angle % 0.5 == 0.0:
            axes.text(0.008, line_of_frequency(0.0, angle), '$\\omega_d h = %g$' % angle, va='center', fontsize=9)
        found += [(s, m, report.hooke.mass(*of_eigenvalue(s, m))['angle'], angle)
                  for s, m in zip(at, line_of_frequency(at, angle))]
    sigmas, mus, ours, formula = zip(*found)
    report.agree(16, 'digital frequency along its lines [rad/sample]', ours, formula)
    axes.plot(sigmas, mus, label='hooke modes: has that frequency', **HOOKE)
    for s, printed in ((0.0, '1.68'), (-0.4, '1.2')):
        report.number('Figure 16', 'μh of the line ω_d h = 2 at σh = %g, “around”' % s, '', printed,
                      float(line_of_frequency(s, 2.0)))
    axes.set(xlim=(-0.5, 0.0), ylim=(0.0, 2.05))
    axes.legend(**BELOW)
    report.picture('figure-16', 'Iso-frequencies of symplectic Euler',
                   'Along a line the digital frequency is that at its right end; the further left, the lower the analog '
                   'frequency μh that it takes. The text reads the line of 2 rad/sample; here lie others at every quarter.',
                   figure)

    figure, axes = plt.subplots(figsize=(7.0, 5.0))
    draw_regions(axes)
    found = []
    for number, damping in enumerate([-0.05, -0.1, -0.2, -0.3, -0.5, -0.8, -1.2]):
        r = math.exp(damping)
        right = -0.5 * (1.0 - r * r)
        ends = [float(limit_of_pair(right, sign)) for sign in (-1.0, 1.0)]
        left = np.linspace(right, -0.5 * (1.0 + r * r), 2000)
        for z in (r, -r):
            mu = line_of_damping(left, z)
            axes.plot(left[mu > 0.0], mu[mu > 0.0], color='black', linewidth=1.0)
        axes.plot([right] * 2, ends, color='black', linewidth=1.0, label=None if number else '(40): $\\sigma_d h$ as written')
        axes.text(right, ends[0] + (0.55 + 0.06 * (number % 3)) * (ends[1] - ends[0]), '%g' % damping, ha='center',
                  fontsize=8, bbox={'facecolor': 'white', 'edgecolor': 'none', 'pad': 0.6}, zorder=7)
        places = [(right, ends[0] + share * (ends[1] - ends[0])) for share in (0.2, 0.8)]
        places += [(s, float(line_of_damping(s, z))) for s in (left[660], left[1200]) for z in (r, -r)]
        found += [(s, m, math.log(report.hooke.mass(*of_eigenvalue(s, m))['radius']), damping)
                  for s, m in places if m > 0.0]
    sigmas, mus, ours, formula = zip(*found)
    report.agree(17, 'digital damping along its lines, σ_d h', ours, formula)
    axes.plot(sigmas, mus, label='hooke modes: has that damping', **dict(HOOKE, markersize=3.5))
    axes.legend(**BELOW)
    report.picture('figure-17', 'Iso-damping of symplectic Euler',
                   'Where z is complex the lines are vertical, for |z| = √(1 − γh) does not depend on the frequency (29). '
                   'Towards the region of instability the digital damping falls to zero; towards the singular point (the '
                   'diamond) it becomes infinite. Which lines the paper draws is not in print.', figure)


# Figures 18 and 19: the two tests of section 3.9


def draw_first_test(report):
    omega0, gamma, h, n_last = 125.0 * 2.0 * math.pi, 50.0, 1e-3, 40
    a, g = (omega0 * h) ** 2, gamma * h
    mu = math.sqrt(omega0 ** 2 - 0.25 * gamma ** 2)
    phi = math.atan(0.5 * gamma / mu)
    z, mode = complex(larger_pole(a, g)), report.hooke.mass(a, g)
    for name, unit, paper, ours, allowed in [
            ('R', '', '1.00050699121789', 1.0 / math.cos(phi), None), ('φ', 'rad', '0.03183636632642', phi, None),
            ('μ, by hooke', 'rad/s', '785.0001752025822', mode['eigenvalues'][0][1], 1e-12),
            ('r, by hooke', '', '0.97467943448090', mode['radius'], None),
            ('ω_d, by hooke', 'rad/s', '817.7132374981528', mode['angle'] / h, 1e-12)]:
        report.number('Figure 18', name, unit, paper, ours, allowed)
    report.agree(18, 'r and ω_d h', [mode['radius'], mode['angle']], [abs(z), np.angle(z)], 1e-14)
    n = np.arange(n_last + 1)
    t = np.linspace(0.0, n_last, 20 * n_last + 1)
    played = report.hooke.samples(a, g, 1.0, 0.0, n_last + 1)
    theory = discrete(a, g, 1.0, 0.0, n)
    report.agree(18, 'samples', played, theory, FLOATS)
    printed = abs(z) ** n * np.cos(np.angle(z) * n - phi) / math.cos(phi)
    analog = np.exp(-0.5 * gamma * h * t) * np.cos(mu * h * t - phi) / math.cos(phi)
    start = complex(1.0, (z.real - (1.0 - a)) / z.imag)
    figure, axes = axes_of('time [ms]', 'displacement', figsize=(7.0, 4.6))
    axes.plot(t, analog, color=GREY, label='solution of the continuous system')
    axes.plot(n, printed, '.', color=ORANGE, label='(42) with the continuous R and φ')
    axes.plot(n, played, label='actual samples: hooke render', **dict(HOOKE, markersize=6.5))
    axes.plot(n, theory, 'x', color=BLUE, zorder=6, label='theoretical model')
    axes.legend(loc='lower left', bbox_to_anchor=(0.0, 1.0), ncol=2)
    report.picture('figure-18', 'Testing the theoretical model against the actual results',
                   'ω0 = 125 · 2π, γ = 50, h = 1/1000, x(0) = 1, v(0) = 0. Two slips are corrected. (42) takes R and φ from '
                   'the continuous solution: those are the dots, up to %.2f off. Samples have R and φ of their own start, '
                   'x[0] = 1 and x[1] = 1 − (ω0 h)², which are %.5f and %.5f, and with these the crosses lie on what hooke '
                   'plays. And a cosine that starts at rest is R cos(μt − φ) with the φ printed, not + φ as in (16).'
                   % (np.max(np.abs(printed - theory)), abs(start), np.angle(start)), figure)


def draw_second_test(report):
    omega0, gamma, v, h, n_last = 1708.0, 500.0, 2324.0, 1e-3, 20
    a, g = (omega0 * h) ** 2, gamma * h
    smaller, larger = sorted((z.real for z in two_poles(a, g)), key=abs)
    mode = report.hooke.mass(a, g)
    report.agree(19, 'both poles', sorted(z.real for z in mode['z']), [larger, smaller])
    report.agree(19, 'digital frequency: π', mode['angle'], math.pi)
    if mode['region'] != 'flips':
        raise Fault('figure 19: hooke has %s, expected it stable at π' % mode['region'])
    n = np.arange(n_last + 1)
    t = np.linspace(0.0, n_last, 20 * n_last + 1)
    played = report.hooke.samples(a, g, 1.0, v * h, n_last + 1)
    theory = discrete(a, g, 1.0, v * h, n)
    report.agree(19, 'samples', played, theory, FLOATS)
    report.agree(19, 'samples against the dotted line, of one pole', played, larger ** n, 1e-3)
    figure, axes = axes_of('time [ms]', 'displacement')
    axes.plot(t, abs(larger) ** t * np.cos(math.pi * t), color=GREY, linestyle=':', label='(42), continuous time')
    axes.plot(n, played, label='actual samples: hooke render', **dict(HOOKE, markersize=6.5))
    axes.plot(n, theory, 'x', color=BLUE, zorder=6, label='theoretical model')
    axes.legend(loc='upper right')
    report.picture('figure-19',
                   'Testing the theoretical model against the actual results: actual frequency is π radians/sample',
                   'ω0 = 1708, γ = 500, h = 1/1000, x(0) = 1, v(0) = 2324. Both poles are real and negative, %.5f and %.5f: '
                   'the simulation is stable, at π rad/sample. This start leaves only %.5f of the smaller pole, and the '
                   'dotted line is (42) with the larger one, R = 1 and φ = 0, at times between the samples too.'
                   % (larger, smaller, abs((theory[1] - larger) / (smaller - larger))), figure)


# Figure 21 and Table 1: the string of section 4.3

TABLE_1 = [('-0.99983335', '2739.98210', '2764.60154', '-1.000000', '440.00000', '1.000000'),
           ('-3.73142886', '5293.23798', '5483.76570', '-3.733751', '872.76842', '0.2678272'),
           ('-7.46285773', '7485.76708', '8089.32370', '-7.472156', '1287.45585', '0.1338302'),
           ('-11.19428660', '9168.15257', '10447.41229', '-11.215224', '1662.75731', '0.0891645'),
           ('-13.92588212', '10225.74360', '12263.63276', '-13.958304', '1951.81777', '0.0716419')]
COLUMNS = [('Re of the eigenvalue', '1/s'), ('Im of the eigenvalue', 'rad/s'), ('ω_d', 'rad/s'), ('σ_d', '1/s'),
           ('frequency', 'Hz'), ('τ', 's')]


def draw_string(report):
    f_hz, tau_s, h = 440.0, 1.0, 1.0 / 6000.0
    told = list(csv.DictReader(io.StringIO(report.hooke.run(
        'tune', '--freq', '440', '--tau', '1', '--masses', '5', '--rate', '6000', '--csv'))))
    omega0, gamma = float(told[0]['omega0']), float(told[0]['gamma'])
    # In closed form: mode k is one mass with λ_k times the a and the g of a spring and a damper.
    lambdas = 4.0 * np.sin(np.arange(1, 6) * math.pi / 12.0) ** 2
    g1 = -math.expm1(-2.0 * h / tau_s)
    a1 = 2.0 - g1 - 2.0 * math.exp(-h / tau_s) * math.cos(2.0 * math.pi * f_hz * h)
    report.agree('Table 1', 'ω0out and γout, over the closed form',
                 [omega0 * h / math.sqrt(a1 / lambdas[0]), gamma * h / (g1 / lambdas[0])], 1.0, 1e-13)
    # The paper takes exp(−2h/τ) from 1, which leaves twelve digits of γ, and of ω0 fifteen.
    report.number('Section 4.3', 'ω0out, by hooke', 'rad/s', '5293.239300336853', omega0, 5e-12)
    report.number('Section 4.3', 'γout, by hooke', '1/s', '7.46285773640857', gamma, 7e-12)
    modes = report.hooke.modes(['rate 6000', 'string s 5 mass 1 stiffness %(k)s damping %(z)s' % told[0]])
    s = np.array([complex(*mode['eigenvalues'][0]) for mode in modes])
    sigma = -0.5 * lambdas * gamma
    formula = sigma + 1j * np.sqrt(lambdas * omega0 ** 2 - sigma ** 2)
    z = larger_pole(lambdas * (omega0 * h) ** 2, lambdas * gamma * h)
    report.agree(21, 'eigenvalues, over the closed form', s / formula, 1.0, 1e-11)
    heard = np.array([(mode['frequency_hz'], mode['tau_s']) for mode in modes])
    report.agree('Table 1', 'frequencies and τ of hooke modes against (30) and (40) [Hz, s]', heard,
                 np.stack([np.angle(z) / (2.0 * math.pi * h), -h / np.log(np.abs(z))], axis=1), 1e-8)
    report.agree('Table 1', 'frequencies and τ of hooke modes against hooke tune [Hz, s]', heard,
                 np.array([(float(mode['frequency_hz']), float(mode['tau_s'])) for mode in told]), 1e-8)
    for k in range(5):
        frequency, tau = heard[k]
        ours = [s[k].real, s[k].imag, 2.0 * math.pi * frequency, -1.0 / tau, frequency, tau]
        for (name, unit), paper, value in zip(COLUMNS, TABLE_1[k], ours):
            report.number('Table 1, line %d' % (k + 1), name, unit, paper, value, 6e-8 if name[:2] == 'Re' else None)
    plain = report.hooke.mass(*of_eigenvalue(-h, 2.0 * math.pi * f_hz * h), 6000.0)['frequency_hz']
    report.number('Section 4.3', 'lowest frequency if nothing is corrected, by hooke', 'Hz', '444.026', plain)
    report.number('Section 4.3', 'its error, by hooke', '%', '0.915', 100.0 * (plain / f_hz - 1.0))

    figure, panels = plt.subplots(1, 2, figsize=(7.6, 4.4), gridspec_kw={'width_ratios': [3, 2], 'wspace': 0.35})
    for axes, left in zip(panels, (-1.0, -0.003)):
        draw_regions(axes)
        axes.plot(formula.real * h, formula.imag * h, 'x', color=BLUE, markersize=6, zorder=6, label='closed form')
        axes.plot(s.real * h, s.imag * h, label='hooke modes', **dict(HOOKE, markersize=7, clip_on=False))
        axes.set_xlim(left, 0.0)
    for k in range(5):
        panels[1].annotate('%d' % (k + 1), (s[k].real * h, s[k].imag * h), xytext=(-11, -3), textcoords='offset points')
    name_regions(panels[0])
    panels[1].set_title('the same, enlarged', fontsize=9)
    panels[1].set_xticks([-0.003, -0.002, -0.001, 0.0])
    panels[0].legend(**dict(BELOW, bbox_to_anchor=(0.0, -0.14)))
    report.picture('figure-21', 'Poles of simulated string with 5 masses',
                   'N = 5, F = 440 Hz, τ = 1 s, 6000 samples per second: the eigenvalues of Table 1, times h, over the '
                   'regions of Figure 12. All are where z is complex, so the string is stable; σh is so small that on the '
                   'left they seem to be on the axis.', figure)


# Error against run time

ERRORS = [('pitch_cents', 'error-pitch', 'Pitch of the fundamental', 'cents', 0.0),
          ('decay_percent', 'error-decay', 'Decay of the fundamental', '%', 0.0),
          ('partials_cents', 'error-partials', 'The first 20 partials of an ideal string', 'cents', 0.0),
          ('partials_cents', 'error-partials-stiff', 'The first 20 partials of a stiff string, B = 1e-4', 'cents', 1e-4),
          ('noise_db', 'error-noise', 'Noise of the numbers', 'dB', 0.0)]
FLOOR = {'cents': 1e-3, '%': 1e-3, 'dB': -150.0}
CROWDS = {'chain, Lumped': ('o', BLUE), 'chain, True': ('o', GREEN), 'chain, Truest': ('o', RED),
          'chain, uncorrected': ('x', GREY), 'network': ('+', PURPLE), 'network, uncorrected': ('1', PURPLE),
          'bank': ('^', ORANGE)}
SURVEY = ('One string alone, read at one place: 55, 110, 440 and 1760 Hz, τ = 2 s, of 4 masses up to as many as are stable, '
          'at 48 kHz (survey.csv has four more rates). Pitch, decay and partials are in closed form, of the coefficients as '
          'the loop has them; noise is played; run time is the least of many looks at the clock of the machine that made '
          'this page, and differs from run to run. The error of partials is the root of the mean square of the first 20 that '
          'are below Nyquist, where one that is missing counts 1200 cents. What errs less than the lowest mark lies on it. '
          'Forward Euler grows, and is in no picture; backward Euler cannot be corrected. A bank of modes has no masses, and '
          'nothing can touch it.')


def read_survey(report, seconds):
    text = report.hooke.run('bench', 'survey', '--csv', *([] if seconds is None else ['--seconds', '%g' % seconds]))
    report.files['survey.csv'] = text
    rows = list(csv.DictReader(io.StringIO(text)))
    for row in rows:
        for key in set(row) - {'kind', 'scheme', 'numbers', 'partials'}:
            row[key] = float(row[key]) if row[key] else math.nan
        kind, detail = row['kind'], ', ' + row['partials'] if row['kind'] == 'chain' else ''
        row['crowd'] = kind + (detail if row['corrected'] else ', uncorrected')
    if len(rows) < 1000 or not all(row['ns_per_frame'] > 0.0 for row in rows):
        raise Fault('hooke bench survey: found %d strings, expected thousands, each with a time' % len(rows))
    return rows


def frontier(rows, level):
    """Those that nothing else beats: the cheapest first, each truer than all before it."""
    front = []
    for row in sorted(rows, key=lambda row: (row['ns_per_frame'], level(row))):
        if not front or level(row) < level(front[-1]):
            front.append(row)
    return front


def plugin_default(symbol):
    """What the plugin's own description has for a port."""
    with open(os.path.join(SOURCE, 'ttl', 'strings.ttl'), encoding='utf-8') as file:
        found = re.search(r'lv2:symbol "%s" ;.*?lv2:default ([0-9.]+)' % symbol, file.read(), re.DOTALL)
    if not found:
        raise Fault('ttl/strings.ttl: found no default of "%s"' % symbol)
    return float(found[1])


def default_of(rows):
    """The string that the plugin makes as it comes: of as many masses as it asks for, or as there can be."""
    partials = ['Lumped', 'True', 'Truest'][int(plugin_default('partials'))]
    return max((row for row in rows if row['crowd'] == 'chain, ' + partials and row['numbers'] == 'fixed'
                and row['masses'] <= plugin_default('masses')), key=lambda row: row['masses'])


def weigh(report, seconds):
    rows = [row for row in read_survey(report, seconds) if row['rate_hz'] == 48000.0 and row['stable']]
    for error, name, title, unit, stiffness in ERRORS:
        def level(row, error=error, unit=unit):
            return max(row[error], FLOOR[unit])

        def drawn(axes, some, *how, **more):
            axes.plot([row['ns_per_frame'] for row in some], [level(row) for row in some], *how, **more)

        figure, panels = plt.subplots(2, 2, figsize=(8.4, 6.6), sharex=True, sharey=True,
                                      gridspec_kw={'wspace': 0.08, 'hspace': 0.15, 'top': 0.95})
        for axes, f0_hz in zip(panels.flat, (55.0, 110.0, 440.0, 1760.0)):
            here = [row for row in rows if row['f0_hz'] == f0_hz and row['inharmonicity'] == stiffness
                    and math.isfinite(row[error])]
            strings = [row for row in here if row['kind'] != 'bank']
            for crowd, (mark, colour) in CROWDS.items():
                drawn(axes, [row for row in here if row['crowd'] == crowd], mark, color=colour, alpha=0.8, label=crowd,
                      markersize=2.6 if mark == 'o' else 3.6)
            for company, style, label in ((here, '--', 'frontier of all'), (strings, '-', 'frontier of strings')):
                front = frontier(company, level)
                drawn(axes, front + [dict(front[-1], ns_per_frame=1e5)], style, drawstyle='steps-post', color='black',
                      linewidth=1.0, label=label)
            default = default_of([row for row in rows if row['f0_hz'] == f0_hz and row['inharmonicity'] == stiffness])
            drawn(axes, [default], 'o', markersize=9, markerfacecolor='none', markeredgecolor='black', label='the default')
            axes.set_title('%g Hz' % f0_hz, fontsize=10)
            if f0_hz == 55.0:
                words = sentences(error, unit, strings, default, level)
        axes.set(xscale='log', xlim=(2.0, 1e5))
        axes.set(**{'ylim': (-140.0, -80.0)} if unit == 'dB' else {'yscale': 'log', 'ylim': (0.6e-3, 2000.0)})
        for axes in panels.flat:
            axes.minorticks_off()
        figure.supxlabel('run time [ns a sample, one string]', fontsize=10)
        figure.supylabel('%s  [%s]' % ('noise' if unit == 'dB' else 'error', unit), fontsize=10, x=0.04)
        figure.legend(*panels[0, 0].get_legend_handles_labels(), loc='upper center', bbox_to_anchor=(0.5, 0.0), ncol=5)
        report.picture(name, title, words, figure)


def sentences(error, unit, strings, default, level):
    """What a picture says of its lowest string, in numbers."""
    def told(row):
        digits = 3 if unit == 'dB' else 2
        amount = '%.*g' % (digits, row[error]) if row[error] >= FLOOR[unit] else 'less than %g' % FLOOR[unit]
        return '%s %s for %.3g ns (%.2f %% of a core)' % (amount, unit, row['ns_per_frame'], 100.0 * row['share_of_core'])

    def named(row):
        return '%d masses as %s (%s)' % (row['masses'], row['crowd'], row['scheme'] if row['kind'] == 'network'
                                         else {'fixed': 'fixed point'}.get(row['numbers'], row['numbers'] + 's'))

    def of_80(**wanted):
        return told(next(row for row in strings if row['masses'] == 80.0
                         and all(row[key] == value for key, value in wanted.items())))

    cheapest = min((row for row in strings if level(row) <= level(default)), key=lambda row: row['ns_per_frame'])
    words = 'At 55 Hz the default, %s, %s %s; ' % (named(default), 'has' if unit == 'dB' else 'errs by', told(default))
    if cheapest['ns_per_frame'] > 0.95 * default['ns_per_frame']:
        words += 'nothing with masses that costs 5 % less is as true.'
    else:
        words += 'the cheapest with masses that is as true, %s, has %s.' % (named(cheapest), told(cheapest))
    if error == 'partials_cents':
        kinds = [of_80(crowd='chain, ' + kind, numbers='fixed') for kind in ('Lumped', 'True', 'Truest')]
        words += ' Of 80 masses in fixed point Lumped partials have %s, True ones %s, Truest ones %s.' % tuple(kinds)
    elif unit == 'dB':
        floats, whole = ([row[error] for row in strings if row['numbers'] == kind] for kind in ('float', 'fixed'))
        words += ' Floats have %.0f to %.0f dB and fixed point %.0f to %.0f; doubles are what they are held against.' % (
            min(floats), max(floats), min(whole), max(whole))
    else:
        words += ' Not solved for what is heard, 80 masses have %s as a chain, and %s link by link as in the paper.' % (
            of_80(crowd='chain, uncorrected'), of_80(crowd='network, uncorrected', scheme='symplectic Euler'))
    return words


BODIES = ('error-bodies', 'Bodies, by how many of their modes are kept')


def weigh_bodies(report, seconds):
    text = report.hooke.run('bench', 'bodies', '--csv', *([] if seconds is None else ['--seconds', '%g' % seconds]))
    report.files['bodies.csv'] = text
    rows = [{key: value if key == 'body' else float(value) for key, value in row.items()} for row in csv.DictReader(io.StringIO(text))]
    names = list(dict.fromkeys(row['body'] for row in rows))
    figure, axes = plt.subplots(figsize=(7.0, 4.6))
    for i, name in enumerate(names):
        of_it = [row for row in rows if row['body'] == name]
        some, whole = of_it[:-1], of_it[-1]
        colour = plt.get_cmap('tab20')(i)
        axes.plot([row['ns_per_frame'] for row in some], [max(row['error_db'], 0.01) for row in some], 'o-', color=colour, markersize=3,
                  label=name)
        axes.plot([whole['ns_per_frame']], [0.01], 'o', color=colour, markersize=9, markerfacecolor='none')
    axes.set(xscale='log', yscale='log', xlabel='run time [ns a frame, driven and heard in stereo]',
             ylabel='error over thirds of octaves [dB]')
    figure.legend(*axes.get_legend_handles_labels(), loc='upper center', bbox_to_anchor=(0.5, 0.0), ncol=4)
    report.picture(*BODIES, 'The strongest 8, 16, 32 … modes of each body at 48 kHz, against all of them from 80 Hz to 8 kHz: the root of '
                   'the mean square over thirds of octaves. Rings are the bodies as they come, with all their modes, which by this '
                   'measure err by nothing. Of 64 modes the worst errs by %.2g dB, of 128 by %.2g.' % tuple(
                       max(row['error_db'] for row in rows if row['modes'] == n) for n in (64.0, 128.0)), figure)


# The pages

SLIPS = ['Algorithm 2 prints μ = √(R² − γ²/4)/h. R is already (ω0 h)², so μ = √(R/h² − γ²/4), and Table 1 needs that form.',
         'Algorithm 2 prints tan²(ω_d); it is tan²(ω_d h).',
         'The conclusion prints h ≤ Z/m + √((Z/m)² + 4m/k). (33) solved for h is h ≤ (−Z + √(Z² + 4mk))/k.',
         'Algorithm 3 takes the smallest imaginary part; it must be the smallest positive one.',
         '(42) has the amplitude and phase of the continuous solution. Figure 18 has those of the discrete start, and the '
         'printed form as dots.',
         'Section 4.2 maps each eigenvalue by itself. That is exact only where M⁻¹K and M⁻¹Z commute, as in Figure 21.',
         '(16) and section 3.9 print + φ with φ = atan(B/A) > 0; a solution at rest at t = 0 has − φ, as drawn in Figure 18.',
         'Section 3.7 has σh = −0.4977 for the end of the region where z is complex at μh = .87. There its angle passes π/2; '
         'the region ends at −0.49999. Figure 15 says both.',
         '(30) is the arc tangent of a quotient, wrong past π/2. Figures 10, 11 and 16 are drawn with the angle of z.',
         'γout is printed as 7.46285773640857 and is 7.462857736414484, for 1 − exp(−2h/τ) cancels; the imaginary parts of '
         'Table 1 are cut off, not rounded.']
TITLE = 'The figures and numbers of Morgan and Qiao (2009), computed anew'
INTRODUCTION = ('D. Morgan and S. Qiao, “Analysis of Damped Mass-Spring Systems for Sound Synthesis”, 2009; numbered as in the '
                'preprint. Lines are the paper’s formulas, circles are what hooke computes by its own code. Figures 1, 2, 6, 7 '
                'and 20 are sketches, with nothing to compute.')
TABLES = [('Numbers', ('where', 'quantity', 'unit', 'paper', 'ours', 'difference', 'allowed'), 'numbers'),
          ('Hooke and the formulas', ('figure', 'what', 'points', 'furthest apart', 'allowed'), 'agreements')]
STYLE = ('body{font:16px/1.5 sans-serif;max-width:60em;margin:2em auto;padding:0 1em;color:#222;background:#fff}'
         'img{max-width:100%}figure{margin:2em 0}table{border-collapse:collapse;font-size:85%}'
         'td,th{border:1px solid #ccc;padding:.1em .5em;text-align:left}')


def markdown(report):
    lines = ['# ' + TITLE, '', INTRODUCTION]
    for title, head, rows in TABLES:
        lines += ['', '## ' + title, '', '| %s |' % ' | '.join(head), '|---' * len(head) + '|']
        lines += ['| %s |' % ' | '.join(row) for row in getattr(report, rows)]
    lines += ['', '## Where the paper has it otherwise', ''] + ['%d. %s' % both for both in enumerate(SLIPS, 1)]
    lines += ['', '## Error against run time', '', SURVEY]
    for _, title, words, _ in report.figures[-len(ERRORS) - 1:]:
        lines += ['', '%s. %s' % (title, words)]
    return '\n'.join(lines) + '\n'


def page(report):
    def row_of(cells, tag):
        return '<tr>%s</tr>\n' % ''.join('<%s>%s</%s>' % (tag, html.escape(cell), tag) for cell in cells)

    parts = ['<!DOCTYPE html>\n<html lang="en">\n<meta charset="utf-8">\n<title>%s</title>\n<style>%s</style>\n'
             '<h1>%s</h1>\n<p>%s</p>\n' % (TITLE, STYLE, TITLE, INTRODUCTION)]
    for name, title, words, _ in report.figures:
        if name == ERRORS[0][1]:
            parts.append('<h2>Error against run time</h2>\n<p>%s</p>\n' % html.escape(SURVEY))
        number = 'Figure %d: ' % int(name[-2:]) if name.startswith('figure') else ''
        parts.append('<figure id="%s">\n<figcaption><b>%s%s.</b> %s</figcaption>\n<img alt="%s" src="data:image/svg+xml;'
                     'base64,%s">\n</figure>\n' % (name, number, html.escape(title), html.escape(words), html.escape(title),
                                                   base64.b64encode(report.files[name + '.svg'].encode()).decode()))
    for title, head, rows in TABLES:
        parts += ['<h2>%s</h2>\n<table>\n' % title, row_of(head, 'th'), *(row_of(row, 'td') for row in getattr(report, rows)),
                  '</table>\n']
    parts += ['<h2>Where the paper has it otherwise</h2>\n<ol>\n', *('<li>%s</li>\n' % slip for slip in SLIPS), '</ol>\n</html>\n']
    return ''.join(parts)


def make(program, directory, seconds):
    with tempfile.TemporaryDirectory() as work:
        report = Report(Hooke(program, work))
        draw_eulers(report)
        draw_poles(report, 8, 0.04, [0.05, 0.15, 0.4, 0.8, 1.2, 1.6, 1.9, 1.97, 1.975, 1.99, 2.05])
        draw_poles(report, 9, 0.98, [0.3, 0.6, 0.85, 0.9, 1.0, 1.1, 1.15, 1.25, 1.4, 1.6])
        draw_warping(report)
        draw_plane(report)
        draw_dampings(report)
        draw_lines(report)
        draw_first_test(report)
        draw_second_test(report)
        draw_string(report)
        weigh(report, seconds)
        weigh_bodies(report, seconds)
    report.render()
    report.files.update({'report.md': markdown(report), 'report.html': page(report)})
    os.makedirs(directory, exist_ok=True)
    for name, text in report.files.items():
        with open(os.path.join(directory, name), 'w', encoding='utf-8') as file:
            file.write(text)
    print('%s: %d figures; %d numbers of the paper and %d comparisons of hooke with the formulas agree'
          % (os.path.join(directory, 'report.html'), len(report.figures), len(report.numbers), len(report.agreements)))


def main():
    parser = argparse.ArgumentParser(prog='report', description=__doc__.split('\n', maxsplit=1)[0])
    parser.add_argument('hooke', help='the program')
    parser.add_argument('directory', help='where the report goes; made if need be')
    parser.add_argument('--seconds', type=float, help='how long run times are measured')
    words = parser.parse_args()
    try:
        make(words.hooke, words.directory, words.seconds)
    except (Fault, OSError) as error:
        sys.exit('report: %s' % error)


if __name__ == '__main__':
    main()
