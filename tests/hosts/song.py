#!/usr/bin/env python3
"""song.py AT OUT.mid: the notes that hosts play, from AT seconds on, in a Standard MIDI File.

A long note, and when it is over two short ones. All times are whole numbers of frames at 48 kHz, in this file's ticks and in
Ardour's, so that every host plays them on the same frame.
"""

import struct
import sys

TICKS_PER_S = 1920  # 960 to a quarter note, 120 quarter notes a minute

NOTES = [  # Key, velocity, from and to [s]
    (45, 100, 0.10, 2.30),
    (52, 80, 3.00, 3.40),
    (57, 90, 3.05, 3.40),
]


def main():
    start_s = float(sys.argv[1])
    messages = [(on, bytes([0x90, key, velocity])) for key, velocity, on, _ in NOTES]
    messages += [(off, bytes([0x80, key, 64])) for key, _, _, off in NOTES]
    messages.sort()
    track = b'\x00\xff\x51\x03' + (500000).to_bytes(3, 'big')
    last = 0
    for time_s, message in messages:
        tick = round((start_s + time_s) * TICKS_PER_S)
        track += variable(tick - last) + message
        last = tick
    track += b'\x00\xff\x2f\x00'
    with open(sys.argv[2], 'wb') as out:
        out.write(b'MThd' + struct.pack('>IHHH', 6, 0, 1, TICKS_PER_S // 2))
        out.write(b'MTrk' + struct.pack('>I', len(track)) + track)


# Seven bits a byte, the highest first, all but the last with the eighth bit set.
def variable(number):
    groups = [number & 0x7F]
    while number > 0x7F:
        number >>= 7
        groups.append(0x80 | number & 0x7F)
    return bytes(reversed(groups))


main()
