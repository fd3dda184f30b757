#!/usr/bin/env python3
"""Write the MIDI files beside this one, or into the directory named: gestures for the tests to measure.

Each is a list of messages at their times in seconds. Channels count from 1. A tick is 1/960 s.
"""

import os
import sys

TICKS_PER_SECOND = 960  # 480 in a quarter note, of which there are two a second

VIBRATO, DATA, EXPRESSION, DATA_LOWER, SUSTAIN, SOSTENUTO, BRIGHTNESS = 1, 6, 11, 38, 64, 66, 74


def on(time, channel, key, velocity=100):
    return [(time, 0x90 | channel - 1, key, velocity)]


def off(time, channel, key):
    return [(time, 0x80 | channel - 1, key, 64)]


def control(time, channel, number, value):
    return [(time, 0xB0 | channel - 1, number, value)]


def wheel(time, channel, value):
    """From -8192 to 8191."""
    return [(time, 0xE0 | channel - 1, value + 8192 & 0x7F, value + 8192 >> 7)]


def press(time, channel, value):
    return [(time, 0xD0 | channel - 1, value)]


def parameter(time, channel, number, upper, lower=None):
    """A registered parameter; it is none's afterwards, as good senders leave it."""
    messages = control(time, channel, 101, number >> 7) + control(time, channel, 100, number & 0x7F)
    messages += control(time, channel, DATA, upper)
    messages += control(time, channel, DATA_LOWER, lower) if lower is not None else []
    return messages + control(time, channel, 101, 127) + control(time, channel, 100, 127)


def zone(time, leader, n_members):
    return parameter(time, leader, 6, n_members)


SONGS = {
    # One key on two channels, bent apart, and then the other way round.
    'apart': zone(0, 1, 15) + wheel(0, 2, 597) + on(0.0625, 2, 60) + on(0.125, 3, 60) + wheel(0.25, 3, -384)
    + wheel(2.25, 2, -384) + wheel(2.25, 3, 597),
    # A ringing note as far up and down as members bend at first, with its leader's wheel on top.
    'wide': zone(0, 16, 2) + on(0.0625, 15, 60) + wheel(0.5, 15, 8191) + wheel(1.5, 15, -3072) + wheel(1.5, 16, -8192),
    'deep': zone(0, 1, 2) + on(0.0625, 2, 79) + wheel(0.5, 2, -8192),
    # And as far as any wheel does.
    'widest': zone(0, 1, 2) + parameter(0, 3, 0, 96) + on(0.0625, 2, 21) + wheel(1, 2, 8191),
    'deepest': zone(0, 1, 2) + parameter(0, 3, 0, 96) + on(0.0625, 2, 124) + wheel(0.125, 2, -8192),
    # Up and dying slower than the damper alone, faster than the string.
    'half': control(0, 1, SUSTAIN, 32) + on(0.0625, 1, 52) + off(1, 1, 52),
    'mostly': control(0, 1, SUSTAIN, 48) + on(0.0625, 1, 52) + off(1, 1, 52),
    # Half-way at last, with the key up already.
    'later': control(0, 1, SUSTAIN, 127) + on(0.0625, 1, 52) + off(0.5, 1, 52) + control(1, 1, SUSTAIN, 32),
    # The first key was down when the pedal went down, the second one was not.
    'sostenuto': on(0.0625, 1, 50) + control(0.25, 1, SOSTENUTO, 127) + on(0.5, 1, 57) + off(1, 1, 50)
    + off(1, 1, 57) + control(3, 1, SOSTENUTO, 0),
    # The range of the wheel, fine tuning and coarse tuning, one after the other and all added up.
    'tuned': on(0.0625, 1, 60) + wheel(0.0625, 1, 4096) + parameter(1, 1, 0, 7, 25) + parameter(2, 1, 1, 84, 17)
    + parameter(3, 1, 2, 59),
    'loud': on(0.125, 1, 57) + on(0.125, 1, 64),
    'soft': control(0, 1, EXPRESSION, 64) + on(0.125, 1, 57) + on(0.125, 1, 64),
    # What is held by the pedal keeps its bend while its channel plays on.
    'held': zone(0, 1, 15) + control(0, 1, SUSTAIN, 127) + wheel(0, 2, 256) + on(0.0625, 2, 50) + off(0.5, 2, 50)
    + wheel(0.75, 2, -512) + on(1, 2, 57),
    # No sound at all.
    'zone': zone(0, 1, 15),
    # Everything at once.
    'all': zone(0, 1, 7) + zone(0, 16, 5) + parameter(0, 4, 0, 24) + control(0.125, 1, VIBRATO, 60)
    + on(0.125, 2, 60) + on(0.1875, 3, 60) + on(0.25, 4, 67) + wheel(0.3125, 3, 3000) + press(0.375, 4, 90)
    + control(0.4375, 2, BRIGHTNESS, 100) + control(0.5, 1, SUSTAIN, 40) + off(0.5625, 2, 60) + on(0.625, 15, 40)
    + wheel(0.6875, 16, -5000) + control(0.75, 16, SOSTENUTO, 127) + off(0.8125, 15, 40) + on(0.875, 10, 72)
    + wheel(0.9375, 9, 8191) + control(1, 9, EXPRESSION, 90) + control(1.25, 1, 121, 0) + zone(1.5, 16, 10),
}


def length(value):
    """A number as MIDI files write it: seven bits a byte, the highest bit for there is more."""
    digits = [value & 0x7F]
    while value > 0x7F:
        value >>= 7
        digits.insert(0, value & 0x7F | 0x80)
    return bytes(digits)


def track(messages):
    data, now = b'', 0
    for time, *message in sorted(messages, key=lambda message: message[0]):
        tick = round(time * TICKS_PER_SECOND)
        assert tick == time * TICKS_PER_SECOND, time
        data += length(tick - now) + bytes(message)
        now = tick
    return data + b'\x00\xff\x2f\x00'


def main():
    directory = sys.argv[1] if len(sys.argv) > 1 else os.path.dirname(os.path.abspath(__file__))
    for name, messages in SONGS.items():
        data = track(messages)
        header = b'MThd' + (6).to_bytes(4, 'big') + b'\0\0\0\1' + (TICKS_PER_SECOND // 2).to_bytes(2, 'big')
        with open(os.path.join(directory, name + '.mid'), 'wb') as file:
            file.write(header + b'MTrk' + len(data).to_bytes(4, 'big') + data)


if __name__ == '__main__':
    main()
