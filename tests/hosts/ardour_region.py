#!/usr/bin/env python3
"""ardour_region.py SESSION.ardour SECONDS TRACK=SONG.mid...: give tracks of a saved session a region each, from its start to SECONDS.

Ardour's Lua can make all the rest of a session, but it cannot import MIDI. The session's range, which is what is exported, is
set as well. The tempo is Ardour's own, 120 quarter notes a minute.
"""

import os
import shutil
import sys
import xml.etree.ElementTree as ElementTree

TICKS_PER_S = 2 * 1920  # Of Ardour's musical time
UNITS_PER_S = 282240000  # Of its audio time


class Session:
    def __init__(self, path):
        self.path = path
        self.tree = ElementTree.parse(path)
        self.root = self.tree.getroot()
        self.last_id = int(self.root.get('id-counter'))
        interchange = os.path.join(os.path.dirname(path), 'interchange')
        self.midi = os.path.join(interchange, os.listdir(interchange)[0], 'midifiles')

    def new_id(self):
        self.last_id += 1
        return str(self.last_id)

    def add_song(self, track, song, length_s):
        name = track + '-1'
        os.makedirs(self.midi, exist_ok=True)
        shutil.copy(song, os.path.join(self.midi, name + '.mid'))
        source = self.new_id()
        ElementTree.SubElement(self.root.find('Sources'), 'Source', {
            'name': name + '.mid', 'type': 'midi', 'flags': 'Writable,CanRename', 'id': source, 'take-id': '', 'origin': ''})
        ElementTree.SubElement(self.root.find('Regions'), 'Region', self.region(name, source, length_s, True))
        ElementTree.SubElement(self.playlist(track), 'Region', self.region(name, source, length_s, False))

    def playlist(self, track):
        found = [p for p in self.root.find('Playlists') if p.get('type') == 'midi' and p.get('name') in (track, track + '.1')]
        if len(found) != 1:
            sys.exit('ardour_region.py: found %d playlists of %s, expected one' % (len(found), track))
        return found[0]

    def region(self, name, source, length_s, is_whole):
        ticks = round(length_s * TICKS_PER_S)
        marks = dict.fromkeys(['muted', 'locked', 'video-locked', 'import', 'external', 'sync-marked', 'hidden',
                               'position-locked', 'valid-transients', 'layering-index', 'contents'], '0')
        return dict(marks, **{
            'id': self.new_id(), 'name': name, 'type': 'midi', 'first-edit': 'nothing', 'opaque': '1', 'tags': '',
            'automatic': str(int(is_whole)), 'whole-file': str(int(is_whole)), 'start': 'b0', 'length': 'b%d@b0' % ticks,
            'sync-position': 'b0', 'ancestral-start': 'b0', 'ancestral-length': 'b0@b0', 'stretch': '1', 'shift': '1',
            'source-0': source, 'master-source-0': source})

    def set_range(self, length_s):
        locations = self.root.find('Locations')
        for location in list(locations):
            if 'IsSessionRange' in location.get('flags', ''):
                locations.remove(location)
        ElementTree.SubElement(locations, 'Location', {
            'id': self.new_id(), 'name': 'session', 'start': 'a0', 'end': 'a%d' % round(length_s * UNITS_PER_S),
            'flags': 'IsSessionRange', 'locked': '0', 'timestamp': '0'})

    def save(self):
        self.root.set('id-counter', str(self.last_id + 1))
        self.tree.write(self.path, encoding='UTF-8', xml_declaration=True)


def main():
    session = Session(sys.argv[1])
    length_s = float(sys.argv[2])
    for pair in sys.argv[3:]:
        track, song = pair.split('=', 1)
        session.add_song(track, song, length_s)
    session.set_range(length_s)
    session.save()


main()
