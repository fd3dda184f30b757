#include "tests/fuzz/song.h"

#include "tests/fuzz/blocks.h"

#include <lv2/midi/midi.h>

#include <string.h>

enum { BYTES = 4, MOST_PORTS = 8 };

/* Masses stepped, after which it is enough. */
static const double MOST_WORK = 1e6;

typedef struct {
  LV2_Atom_Sequence head;
  LV2_Atom_Event event;
  uint8_t body[8];
} OneEvent;

/* Nothing happens for a while. */
static double wait(Plug* plug, double n_frames) {
  double work = 0.0;
  while (n_frames >= 1.0) {
    const uint32_t n = n_frames < PLUG_FRAMES ? (uint32_t)n_frames : (uint32_t)PLUG_FRAMES;
    plug_run(plug, NULL, n);
    work += n * plug_masses(plug);
    n_frames -= n;
  }
  return work;
}

static void send(Plug* plug, const uint8_t* message) {
  OneEvent one = {.event.body = {3, plug_urid(LV2_MIDI__MidiEvent)}};
  one.body[0] = (uint8_t)(0x80U | message[0]);
  one.body[1] = message[1] & 0x7FU;
  one.body[2] = message[2] & 0x7FU;
  one.event.body.size = (one.body[0] & 0xE0U) == 0xC0 ? 2 : 3;
  one.head.atom = (LV2_Atom){sizeof(one) - sizeof(LV2_Atom), plug_urid(LV2_ATOM__Sequence)};
  plug_run(plug, &one.head, 0);
  ++plug->n_notes;
}

void song_play(const PlugKind* kind, const uint8_t* bytes, size_t n_bytes) {
  FuzzFeed feed = {bytes, n_bytes};
  const uint32_t head = fuzz_byte(&feed);
  Plug* const plug = plug_in(kind, head % 2 ? 11025.0 : 8000.0);
  const double end = (1.0 + (head >> 1) % 8) * plug->rate_hz;
  for (uint32_t i = fuzz_byte(&feed) % (MOST_PORTS + 1); i > 0; --i) {
    blocks_move_port(plug, &feed);
  }
  const size_t n_messages = feed.n_left / BYTES;
  double work = 0.0;
  double frame = 0.0;
  for (size_t i = 0; n_messages > 0 && frame < end && work < MOST_WORK; ++i) {
    const uint8_t* const message = feed.at + BYTES * (i % n_messages);
    /* A loop without a time in it ends as well. */
    const double n_frames = 0.004 * plug->rate_hz * message[0] + (i % n_messages == 0 ? 1.0 : 0.0);
    work += wait(plug, n_frames);
    frame += n_frames;
    send(plug, message + 1);
  }
  plug_claim_silence(plug);
}
