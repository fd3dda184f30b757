#include "tests/fuzz/blocks.h"

#include <lv2/midi/midi.h>

#include <math.h>
#include <stdlib.h>
#include <string.h>

#ifdef __has_include
#if __has_include(<sanitizer/asan_interface.h>)
#include <sanitizer/asan_interface.h>
#endif
#endif
#ifndef ASAN_POISON_MEMORY_REGION
#define ASAN_POISON_MEMORY_REGION(address, size) ((void)(address), (void)(size))
#endif

enum { MOST_EVENTS = 7, EVENT = 16 + BLOCKS_BODY, MOST_FRAMES = 4096 };

/* Masses stepped, after which it is enough: some tenths of a second. */
static const double MOST_WORK = 1e6;

typedef struct {
  Plug* plug;
  FuzzFeed feed;
  uint32_t n_cut; /* Bytes that the last event lacks */
  LV2_URID own_type;
  BlocksOwn own;
} Blocks;

static float odd_value(uint32_t which) {
  static const float values[] = {NAN,     HUGE_VALF, -HUGE_VALF, 1e30f, -1e30f,       1e-40f,
                                 -1e-40f, 0.0f,      -1.0f,      1e9f,  4294967296.0f};
  return values[which % (sizeof(values) / sizeof(values[0]))];
}

/* Sixteen of the values of a byte are odd; the others lie between both ends, which are among them.
 */
void blocks_move_port(Plug* plug, FuzzFeed* feed) {
  const PlugKind* const kind = plug->kind;
  const PortRange* const range = &kind->controls[fuzz_byte(feed) % kind->n_controls];
  const uint32_t byte = fuzz_byte(feed);
  const double low = (double)range->minimum;
  const double high = (double)range->maximum;
  const double t = (byte - 16.0) / 239.0;
  const double value = low > 0.0 ? low * pow(high / low, t) : low + t * (high - low);
  plug->values[range->index] = byte < 16 ? odd_value(byte) : (float)value;
}

/* A message that is one, mostly: of all kinds that mean something there are many. */
static uint32_t make_message(Blocks* blocks, uint8_t body[BLOCKS_BODY]) {
  body[0] = (uint8_t)(0x80U | fuzz_byte(&blocks->feed));
  body[1] = (uint8_t)(0x7FU & fuzz_byte(&blocks->feed));
  body[2] = (uint8_t)(0x7FU & fuzz_byte(&blocks->feed));
  return (body[0] & 0xE0U) == 0xC0 ? 2 : 3;
}

static uint32_t make_bytes(Blocks* blocks, uint8_t body[BLOCKS_BODY]) {
  const uint32_t n_bytes = fuzz_byte(&blocks->feed);
  for (uint32_t i = 0; i < n_bytes; ++i) {
    body[i] = (uint8_t)fuzz_byte(&blocks->feed);
  }
  return n_bytes;
}

/* Before the block, in it, and behind it. */
static int64_t frame_of(uint32_t byte, uint32_t n_frames) {
  return byte == 255   ? INT64_MAX
         : byte == 254 ? INT64_MIN
         : byte == 253 ? n_frames
                       : (int64_t)byte * n_frames / 253;
}

/* What is behind a body is not the event's, so nobody may look at it. */
static uint8_t* append(uint8_t* at, LV2_Atom_Event head, const uint8_t* body) {
  const uint32_t padded = (head.body.size + 7u) & ~7u;
  memcpy(at, &head, sizeof(head));
  memcpy(at + sizeof(head), body, head.body.size);
  ASAN_POISON_MEMORY_REGION(at + sizeof(head) + head.body.size, padded - head.body.size);
  return at + sizeof(head) + padded;
}

static uint8_t* add_event(Blocks* blocks, uint8_t* at, uint32_t n_frames) {
  uint8_t body[BLOCKS_BODY] = {0};
  const uint32_t what = fuzz_byte(&blocks->feed) % 8;
  LV2_Atom_Event event = {.time.frames = frame_of(fuzz_byte(&blocks->feed), n_frames)};
  event.body.type = plug_urid(LV2_MIDI__MidiEvent);
  if (what < 4) {
    event.body.size = make_message(blocks, body);
  } else if (what == 4) {
    event.body.size = make_bytes(blocks, body);
  } else if (what == 5) {
    event.body.type = fuzz_byte(&blocks->feed);
    event.body.size = make_bytes(blocks, body);
  } else {
    event.body.type = blocks->own_type;
    event.body.size = blocks->own(&blocks->feed, body);
  }
  ++blocks->plug->n_notes;
  return append(at, event, body);
}

/* In memory that ends with the last of the events, or before its end. */
static void run_block(Blocks* blocks, uint32_t n_frames, uint32_t n_events) {
  const size_t room = sizeof(LV2_Atom_Sequence) + MOST_EVENTS * EVENT;
  uint8_t* const memory = calloc(1, room);
  FUZZ_CLAIM(memory);
  uint8_t* at = memory + sizeof(LV2_Atom_Sequence);
  for (uint32_t i = 0; i < n_events; ++i) {
    at = add_event(blocks, at, n_frames);
  }
  const size_t size = (size_t)(at - memory) - blocks->n_cut;
  const LV2_Atom_Sequence head = {
      {(uint32_t)(size - sizeof(LV2_Atom)), plug_urid(LV2_ATOM__Sequence)}, {0, 0}};
  memcpy(memory, &head, sizeof(head));
  ASAN_POISON_MEMORY_REGION(memory + size, room - size);
  plug_run(blocks->plug, (const LV2_Atom_Sequence*)(const void*)memory, n_frames);
  free(memory);
}

static double play_block(Blocks* blocks) {
  static const uint32_t sizes[] = {0, 1, 7, 32, 64, 150, 256, PLUG_FRAMES};
  const uint32_t head = fuzz_byte(&blocks->feed);
  for (uint32_t i = (head >> 3) % 4; i > 0; --i) {
    blocks_move_port(blocks->plug, &blocks->feed);
  }
  const uint32_t n_frames = sizes[head >> 5];
  run_block(blocks, n_frames, head % (MOST_EVENTS + 1));
  return n_frames;
}

static void play_all(Blocks* blocks) {
  double n_frames = 0.0;
  double work = 0.0;
  while (blocks->feed.n_left > 0 && n_frames < MOST_FRAMES && work < MOST_WORK) {
    const double n = play_block(blocks);
    n_frames += n;
    work += n * plug_masses(blocks->plug);
  }
}

/* How the whole of it is: its rate, and how the host is. */
static void start(Blocks* blocks, const PlugKind* kind) {
  static const double rates_hz[] = {8000.0, 11025.0, 22050.0, 48000.0};
  static const uint32_t rooms[] = {PLUG_MAX_NOTIFY, 0, 4, 8, 24, 100, 200, 1024};
  const uint32_t head = fuzz_byte(&blocks->feed);
  blocks->plug = plug_in(kind, rates_hz[head % 4]);
  blocks->plug->n_room = rooms[(head >> 2) % 8];
  blocks->plug->is_worker_busy = (head >> 5) % 2;
  blocks->n_cut = (head >> 6) % 2 ? 5 : 0;
}

static uint64_t play(Blocks blocks, const PlugKind* kind) {
  start(&blocks, kind);
  play_all(&blocks);
  const uint64_t hash = blocks.plug->hash;
  plug_claim_silence(blocks.plug);
  return hash;
}

void blocks_play(const PlugKind* kind,
                 const uint8_t* bytes,
                 size_t n_bytes,
                 const char* own_uri,
                 BlocksOwn own) {
  const Blocks blocks = {
      .feed = {bytes, n_bytes},
      .own_type = plug_urid(own_uri),
      .own = own,
  };
  const uint64_t hash = play(blocks, kind);
  if (n_bytes > 0 && (bytes[0] & 0x80U)) {
    FUZZ_CLAIM(play(blocks, kind) == hash);
  }
}
