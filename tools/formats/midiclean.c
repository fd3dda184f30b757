#include "tools/formats/midiclean.h"

#include "tools/formats/midiwalk.h"

#include <string.h>

enum { HEADER_SIZE = 14, CHUNK_SIZE = 8 };

static const uint64_t MAX_DELTA = 0x0FFFFFFF;

/* Seven bits a byte, the highest first, all but the last with the top bit set. */
static bool write_number(Bytes* out, uint32_t number) {
  uint8_t bytes[4];
  unsigned n_bytes = 0;
  for (unsigned shift = 21; shift > 0; shift -= 7) {
    if (number >> shift) {
      bytes[n_bytes++] = (uint8_t)(0x80U | ((number >> shift) & 0x7FU));
    }
  }
  bytes[n_bytes++] = (uint8_t)(number & 0x7FU);
  return bytes_append(out, bytes, n_bytes);
}

static bool is_whole_sysex(const uint8_t* body, size_t size) {
  if (size == 0 || body[size - 1] != 0xF7) {
    return false;
  }
  for (size_t i = 0; i + 1 < size; ++i) {
    if (body[i] >= 0x80) {
      return false;
    }
  }
  return true;
}

static bool is_kept(const MidiMessage* message, const uint8_t* body) {
  if (message->status == MIDI_META) {
    const bool is_tempo = message->meta == MIDI_META_TEMPO && (body[0] || body[1] || body[2]);
    return is_tempo || message->meta == MIDI_META_END_OF_TRACK;
  }
  return message->status < 0xF0 ||
         (message->status == MIDI_SYSEX && is_whole_sysex(body, message->size));
}

static bool write_message(Bytes* out, const MidiMessage* message, const uint8_t* body) {
  const uint8_t head[2] = {(uint8_t)message->status, (uint8_t)message->meta};
  const bool has_length = message->status >= 0xF0;
  return bytes_append(out, head, message->status == MIDI_META ? 2 : 1) &&
         (!has_length || write_number(out, (uint32_t)message->size)) &&
         bytes_append(out, body, message->size);
}

static bool out_of_memory(const MidiWalk* walk) {
  return midiwalk_fail(walk, walk->at, "no memory left, expected some");
}

/* Copy what is kept; a delta reaches back to the last event kept. */
static bool clean_events(MidiWalk* walk, Bytes* out) {
  uint64_t last_tick = 0;
  MidiMessage message = {0};
  while (message.status != MIDI_META || message.meta != MIDI_META_END_OF_TRACK) {
    if (walk->at == walk->end) {
      return midiwalk_fail(walk, walk->at, "the end of the track, expected End of Track");
    }
    if (!midiwalk_next(walk, &message)) {
      return false;
    }
    const uint8_t* const body = walk->data + message.at;
    if (is_kept(&message, body)) {
      const uint64_t delta = walk->tick - last_tick;
      if (delta > MAX_DELTA) {
        return midiwalk_fail(walk, message.at, "a pause of %lu ticks, expected at most %lu",
                             (unsigned long)delta, (unsigned long)MAX_DELTA);
      }
      if (!write_number(out, (uint32_t)delta) || !write_message(out, &message, body)) {
        return out_of_memory(walk);
      }
      last_tick = walk->tick;
    }
  }
  return true;
}

static bool clean_track(MidiWalk* walk, Bytes* out) {
  static const uint8_t head[CHUNK_SIZE] = {'M', 'T', 'r', 'k'};
  const size_t start = out->size + sizeof(head);
  walk->tick = 0;
  if (!bytes_append(out, head, sizeof(head))) {
    return out_of_memory(walk);
  }
  if (!clean_events(walk, out)) {
    return false;
  }
  const uint32_t length = (uint32_t)(out->size - start);
  for (unsigned i = 0; i < 4; ++i) {
    out->data[start - 4 + i] = (uint8_t)(length >> (24 - 8 * i));
  }
  walk->at = walk->end;
  return true;
}

static bool check_header(const MidiWalk* walk, size_t size, unsigned* n_tracks) {
  const uint8_t* const data = walk->data;
  if (size == 0) {
    return midiwalk_fail(walk, 0, "an empty file, expected a Standard MIDI File");
  }
  if (size < 4 || memcmp(data, "MThd", 4) != 0) {
    return midiwalk_fail(walk, 0, "no MThd, expected a Standard MIDI File");
  }
  if (size < HEADER_SIZE) {
    return midiwalk_fail(walk, size, "the end of the file, expected a header of %d bytes",
                         HEADER_SIZE);
  }
  const uint32_t length = midiwalk_big_endian(data + 4, 4);
  const unsigned type = midiwalk_big_endian(data + 8, 2);
  const unsigned division = midiwalk_big_endian(data + 12, 2);
  *n_tracks = midiwalk_big_endian(data + 10, 2);
  if (length != HEADER_SIZE - CHUNK_SIZE) {
    return midiwalk_fail(walk, 4, "a header of %lu bytes, expected 6", (unsigned long)length);
  }
  if (type > 1) {
    return midiwalk_fail(walk, 8, "type %u, expected 0 or 1", type);
  }
  if (*n_tracks == 0 || (type == 0 && *n_tracks != 1)) {
    return midiwalk_fail(walk, 10, "%u tracks, expected %s", *n_tracks,
                         type ? "1 or more" : "1 in a file of type 0");
  }
  if (division == 0 || division > 0x7FFF) {
    return midiwalk_fail(walk, 12, "division 0x%04x, expected ticks per quarter note, 1 to 0x7fff",
                         division);
  }
  return true;
}

/* Go to the next track and into it, past chunks of other kinds. */
static bool enter_track(MidiWalk* walk, size_t size, unsigned n_tracks) {
  for (;;) {
    const size_t left = size - walk->at;
    if (left < CHUNK_SIZE) {
      return midiwalk_fail(walk, walk->at, "the end of the file, expected %u tracks", n_tracks);
    }
    const uint8_t* const chunk = walk->data + walk->at;
    const uint32_t length = midiwalk_big_endian(chunk + 4, 4);
    if (length > left - CHUNK_SIZE) {
      return midiwalk_fail(walk, walk->at + 4,
                           "a chunk of %lu bytes, expected at most the %zu left",
                           (unsigned long)length, left - CHUNK_SIZE);
    }
    walk->at += CHUNK_SIZE;
    walk->end = walk->at + length;
    if (!memcmp(chunk, "MTrk", 4)) {
      return true;
    }
    walk->at = walk->end;
  }
}

bool midiclean(const uint8_t* data, size_t size, Bytes* out, char* error, size_t error_size) {
  MidiWalk walk = {.data = data, .error = error, .error_size = error_size};
  unsigned n_tracks = 0;
  if (!check_header(&walk, size, &n_tracks)) {
    return false;
  }
  if (!bytes_append(out, data, HEADER_SIZE)) {
    return out_of_memory(&walk);
  }
  walk.at = HEADER_SIZE;
  for (walk.track = 1; walk.track <= n_tracks; ++walk.track) {
    if (!enter_track(&walk, size, n_tracks) || !clean_track(&walk, out)) {
      return false;
    }
  }
  return true;
}
