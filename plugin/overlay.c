#include "plugin/overlay.h"

#include <inttypes.h>
#include <math.h>
#include <stdio.h>
#include <string.h>

/* How far a host's own rounding may move a port, in part and in all. */
static const float NEAR_SHARE = 1e-4f;
static const float NEAR = 1e-6f;

enum { TAKEN, FIRST_PORT }; /* Words of a record */

enum { IS_ON, VALUE, INPUT }; /* Fields of a port */

static unsigned bits_of(float value) {
  unsigned bits = 0;
  memcpy(&bits, &value, sizeof(value));
  return bits;
}

static float float_of(unsigned bits) {
  float value = 0.0f;
  memcpy(&value, &bits, sizeof(value));
  return value;
}

static unsigned* field(unsigned words[OVERLAY_WORDS], uint32_t port, uint32_t which) {
  return &words[FIRST_PORT + port * OVERLAY_FIELDS + which];
}

static void write_record(OverlayRecord* record, const unsigned words[OVERLAY_WORDS]) {
  const unsigned n = atomic_load_explicit(&record->n_writes, memory_order_relaxed);
  atomic_store_explicit(&record->n_writes, n + 1, memory_order_relaxed);
  atomic_thread_fence(memory_order_release);
  for (uint32_t i = 0; i < OVERLAY_WORDS; ++i) {
    atomic_store_explicit(&record->words[i], words[i], memory_order_relaxed);
  }
  atomic_store_explicit(&record->n_writes, n + 2, memory_order_release);
}

/* False if it is being written. */
static bool
read_record(const OverlayRecord* record, unsigned words[OVERLAY_WORDS], unsigned* n_writes) {
  *n_writes = atomic_load_explicit(&record->n_writes, memory_order_acquire);
  for (uint32_t i = 0; i < OVERLAY_WORDS; ++i) {
    words[i] = atomic_load_explicit(&record->words[i], memory_order_relaxed);
  }
  atomic_thread_fence(memory_order_acquire);
  return *n_writes % 2 == 0 &&
         atomic_load_explicit(&record->n_writes, memory_order_relaxed) == *n_writes;
}

static void publish(Overlay* overlay) {
  unsigned words[OVERLAY_WORDS] = {overlay->n_taken};
  for (uint32_t i = 0; i < PORTS_MAX; ++i) {
    const OverlaidPort* const port = &overlay->ports[i];
    *field(words, i, IS_ON) = port->is_on;
    *field(words, i, VALUE) = bits_of(port->value);
    *field(words, i, INPUT) = bits_of(port->is_unread ? port->before : port->input);
  }
  write_record(&overlay->played, words);
}

static bool is_near(float a, float b) {
  return fabsf(a - b) <= NEAR + NEAR_SHARE * fabsf(b);
}

/* Whether something has changed. */
static bool read_port(OverlaidPort* port, float input) {
  const bool is_moved = !port->is_unread && bits_of(input) != bits_of(port->input);
  const bool is_back = port->is_awaited && is_near(input, port->before);
  const bool is_new = port->is_unread || is_moved;
  port->is_on = !is_moved || is_back;
  port->is_awaited = port->is_awaited && !is_back;
  port->is_unread = false;
  port->input = input;
  return is_new;
}

void overlay_take(Overlay* overlay) {
  unsigned words[OVERLAY_WORDS];
  unsigned n_writes = 0;
  if (atomic_load_explicit(&overlay->restored.n_writes, memory_order_relaxed) == overlay->n_taken ||
      !read_record(&overlay->restored, words, &n_writes)) {
    return;
  }
  for (uint32_t i = 0; i < PORTS_MAX; ++i) {
    overlay->ports[i] = (OverlaidPort){
        .is_on = *field(words, i, IS_ON),
        .is_unread = true,
        .is_awaited = true,
        .value = float_of(*field(words, i, VALUE)),
        .before = float_of(*field(words, i, INPUT)),
    };
  }
  overlay->n_taken = n_writes;
  publish(overlay);
}

void overlay_apply(Overlay* overlay, void* const ports[PORTS_MAX], void* over[PORTS_MAX]) {
  bool is_changed = false;
  memcpy(over, ports, PORTS_MAX * sizeof(void*));
  for (uint32_t i = 0; i < PORTS_MAX; ++i) {
    OverlaidPort* const port = &overlay->ports[i];
    if (port->is_on && ports[i]) {
      is_changed = read_port(port, *(const float*)ports[i]) || is_changed;
    }
    over[i] = port->is_on ? &port->value : ports[i];
  }
  if (is_changed) {
    publish(overlay);
  }
}

void overlay_put(Overlay* overlay,
                 void* const ports[PORTS_MAX],
                 uint32_t n_ports,
                 const uint32_t indices[],
                 const float values[]) {
  for (uint32_t i = 0; i < n_ports; ++i) {
    const float* const held = ports[indices[i]];
    overlay->ports[indices[i]] = (OverlaidPort){
        .is_on = !held || *held != values[i],
        .is_unread = !held,
        .value = values[i],
        .input = held ? *held : 0.0f,
    };
  }
  publish(overlay);
}

uint32_t overlay_write(Overlay* overlay, char text[OVERLAY_TEXT_SIZE]) {
  unsigned words[OVERLAY_WORDS];
  unsigned n_writes = 0;
  uint32_t length = 0;
  while (!read_record(&overlay->played, words, &n_writes)) {
  }
  if (words[TAKEN] != atomic_load_explicit(&overlay->restored.n_writes, memory_order_relaxed)) {
    (void)read_record(&overlay->restored, words, &n_writes); /* It has not been played yet. */
  }
  text[0] = '\0';
  for (uint32_t i = 0; i < PORTS_MAX; ++i) {
    if (*field(words, i, IS_ON)) {
      length += (uint32_t)snprintf(text + length, OVERLAY_TEXT_SIZE - length, "%" PRIu32 ":%x:%x;",
                                   i, *field(words, i, VALUE), *field(words, i, INPUT));
    }
  }
  return length;
}

static bool is_one_of(uint32_t port, uint32_t n_ports, const uint32_t indices[]) {
  bool is_found = false;
  for (uint32_t i = 0; i < n_ports; ++i) {
    is_found = is_found || indices[i] == port;
  }
  return is_found;
}

bool overlay_read(Overlay* overlay, const char* text, uint32_t n_ports, const uint32_t indices[]) {
  unsigned words[OVERLAY_WORDS] = {0};
  bool is_read = true;
  while (*text && is_read) {
    unsigned port = 0;
    unsigned value = 0;
    unsigned input = 0;
    int n = 0;
    (void)sscanf(text, "%2u:%8x:%8x;%n", &port, &value, &input, &n);
    is_read = n > 0 && is_one_of(port, n_ports, indices);
    if (is_read) {
      *field(words, port, IS_ON) = true;
      *field(words, port, VALUE) = value;
      *field(words, port, INPUT) = input;
    }
    text += n;
  }
  if (!is_read) {
    memset(words, 0, sizeof(words));
  }
  write_record(&overlay->restored, words);
  return is_read;
}
