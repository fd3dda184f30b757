#include "tools/formats/midiwalk.h"

#include <stdarg.h>
#include <stdio.h>

static const uint64_t MAX_TICK = INT32_MAX;

static bool need(const MidiWalk* walk, size_t n_bytes, const char* what) {
  const size_t left = walk->end - walk->at;
  return n_bytes <= left ||
         midiwalk_fail(walk, walk->at, "%zu bytes to the end of the track, expected %zu of %s",
                       left, n_bytes, what);
}

/* A number in groups of seven bits, four groups at most. */
static bool read_number(MidiWalk* walk, const char* what, uint32_t* number) {
  const size_t start = walk->at;
  *number = 0;
  for (unsigned i = 0; i < 4; ++i) {
    if (!need(walk, 1, what)) {
      return false;
    }
    const uint8_t byte = walk->data[walk->at++];
    *number = (*number << 7) | (byte & 0x7FU);
    if (!(byte & 0x80U)) {
      return true;
    }
  }
  return midiwalk_fail(walk, start, "%s of more than 4 bytes, expected at most 4", what);
}

static bool read_block(MidiWalk* walk, const char* what, MidiMessage* message) {
  uint32_t length = 0;
  if (!read_number(walk, "a length", &length) || !need(walk, length, what)) {
    return false;
  }
  message->at = walk->at;
  message->size = length;
  walk->at += length;
  return true;
}

static bool read_meta(MidiWalk* walk, MidiMessage* message) {
  const size_t start = walk->at;
  if (!need(walk, 1, "a meta event")) {
    return false;
  }
  message->meta = walk->data[walk->at++];
  if (!read_block(walk, "a meta event", message)) {
    return false;
  }
  if (message->meta == MIDI_META_TEMPO && message->size != 3) {
    return midiwalk_fail(walk, start, "a tempo of %zu bytes, expected 3", message->size);
  }
  return true;
}

static bool read_channel_message(MidiWalk* walk, MidiMessage* message) {
  const unsigned kind = walk->status & 0xF0U;
  message->size = kind == 0xC0 || kind == 0xD0 ? 1 : 2;
  message->at = walk->at;
  if (!need(walk, message->size, "a message")) {
    return false;
  }
  for (; walk->at < message->at + message->size; ++walk->at) {
    const unsigned byte = walk->data[walk->at];
    if (byte >= 0x80) {
      return midiwalk_fail(walk, walk->at,
                           "0x%02x in a message of status 0x%02x, expected 0 to 0x7f", byte,
                           walk->status);
    }
  }
  return true;
}

/* Only channel messages leave a running status behind. */
static bool read_message(MidiWalk* walk, MidiMessage* message) {
  if (!need(walk, 1, "a message")) {
    return false;
  }
  const size_t start = walk->at;
  const unsigned byte = walk->data[start];
  walk->at += byte >= 0x80 ? 1 : 0;
  walk->status = byte >= 0xF0 ? 0 : byte >= 0x80 ? byte : walk->status;
  message->status = byte >= 0xF0 ? byte : walk->status;
  if (!message->status) {
    return midiwalk_fail(walk, start, "0x%02x, expected a status byte of 0x80 or more", byte);
  }
  if (message->status < 0xF0) {
    return read_channel_message(walk, message);
  }
  if (byte == MIDI_META) {
    return read_meta(walk, message);
  }
  if (byte == MIDI_SYSEX || byte == MIDI_ESCAPE) {
    return read_block(walk, "a system exclusive message", message);
  }
  return midiwalk_fail(walk, start,
                       "status 0x%02x, expected a channel message, sysex or meta event", byte);
}

bool midiwalk_fail(const MidiWalk* walk, size_t at, const char* format, ...) {
  char what[160];
  va_list args;
  va_start(args, format);
  (void)vsnprintf(what, sizeof(what), format, args);
  va_end(args);
  if (walk->track) {
    (void)snprintf(walk->error, walk->error_size, "track %u, byte %zu: found %s", walk->track, at,
                   what);
  } else {
    (void)snprintf(walk->error, walk->error_size, "byte %zu: found %s", at, what);
  }
  return false;
}

uint32_t midiwalk_big_endian(const uint8_t* data, unsigned n_bytes) {
  uint32_t value = 0;
  for (unsigned i = 0; i < n_bytes; ++i) {
    value = (value << 8) | data[i];
  }
  return value;
}

bool midiwalk_next(MidiWalk* walk, MidiMessage* message) {
  const size_t start = walk->at;
  uint32_t delta = 0;
  *message = (MidiMessage){0};
  if (!read_number(walk, "a delta time", &delta)) {
    return false;
  }
  walk->tick += delta;
  if (walk->tick > MAX_TICK) {
    return midiwalk_fail(walk, start, "tick %llu, expected at most %llu",
                         (unsigned long long)walk->tick, (unsigned long long)MAX_TICK);
  }
  return read_message(walk, message);
}
