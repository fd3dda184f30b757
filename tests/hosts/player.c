/* A client of JACK that plays a MIDI file to another and records what it answers.

     player CLIENT SONG.mid OUT.wav SECONDS [freewheel]

   CLIENT is waited for.  Each message is sent on its frame.  What is recorded comes one period
   later. */
#define _POSIX_C_SOURCE 200809L

#include "tests/hosts/jack.h"
#include "tools/formats/smf.h"
#include "tools/formats/soundfile.h"

#include <dlfcn.h>
#include <math.h>
#include <stdatomic.h>
#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

enum { SIDES = 2, MOST_WAITS = 1200, STEP_NS = 50000000 };

typedef struct {
  Jack jack;
  JackClient* client;
  JackPort* out;
  JackPort* in[SIDES];
  const Smf* song;
  size_t n_sent;
  double rate_hz;
  float* frames;
  size_t at;
  size_t n_frames;
  atomic_bool is_running;
  atomic_bool is_over;
  atomic_uint n_xruns;
} Player;

static int die(const char* what) {
  (void)fprintf(stderr, "player: %s\n", what);
  return EXIT_FAILURE;
}

static void wait_a_step(void) {
  const struct timespec step = {0, STEP_NS};
  (void)nanosleep(&step, NULL);
}

int jack_find(Jack* jack) {
  void* const library = dlopen("libjack.so.0", RTLD_NOW);
  void* found = NULL;
  if (!library) {
    (void)fprintf(stderr, "player: %s\n", dlerror());
    return -1;
  }
#define X(name, type, arguments)                                                                   \
  found = dlsym(library, "jack_" #name);                                                           \
  if (!found) {                                                                                    \
    return die("there is no jack_" #name), -1;                                                     \
  }                                                                                                \
  memcpy(&jack->name, &found, sizeof(found));
  JACK_FUNCTIONS(X)
#undef X
  return 0;
}

static void send(Player* self, void* buffer, uint32_t n_frames) {
  for (; self->n_sent < self->song->n_events; ++self->n_sent) {
    const SmfEvent* const event = &self->song->events[self->n_sent];
    const size_t frame = (size_t)llround(event->time_s * self->rate_hz);
    if (frame >= self->at + n_frames) {
      return;
    }
    (void)self->jack.midi_event_write(buffer, (uint32_t)(frame - self->at), event->bytes,
                                      event->size);
  }
}

static void record(Player* self, uint32_t n_frames) {
  for (int k = 0; k < SIDES; ++k) {
    const float* const heard = self->jack.port_get_buffer(self->in[k], n_frames);
    for (uint32_t i = 0; i < n_frames && self->at + i < self->n_frames; ++i) {
      self->frames[SIDES * (self->at + i) + (size_t)k] = heard[i];
    }
  }
}

static int process(uint32_t n_frames, void* data) {
  Player* const self = data;
  void* const buffer = self->jack.port_get_buffer(self->out, n_frames);
  self->jack.midi_clear_buffer(buffer);
  if (atomic_load(&self->is_running) && !atomic_load(&self->is_over)) {
    send(self, buffer, n_frames);
    record(self, n_frames);
    self->at += n_frames;
    atomic_store(&self->is_over, self->at >= self->n_frames);
  }
  return 0;
}

static int count_xrun(void* data) {
  Player* const self = data;
  atomic_fetch_add(&self->n_xruns, atomic_load(&self->is_running) ? 1u : 0u);
  return 0;
}

/* The k-th port of the other client; it may take its time to be there.  The array and its names are
 * JACK's, and this program ends soon. */
static const char* port_of(Player* self, const char* client, const char* type, int flags, int k) {
  char pattern[256];
  (void)snprintf(pattern, sizeof(pattern), "^%s:", client);
  for (int wait = 0; wait < MOST_WAITS; ++wait) {
    const char** const names =
        self->jack.get_ports(self->client, pattern, type, (unsigned long)flags);
    if (names && names[0] && (k == 0 || names[1])) {
      return names[k];
    }
    wait_a_step();
  }
  return NULL;
}

static bool join(Player* self, const char* from, const char* to) {
  return from && to && !self->jack.connect(self->client, from, to);
}

static bool open_ports(Player* self, const char* other) {
  const Jack* const jack = &self->jack;
  self->client = jack->client_open("player", JACK_NO_START_SERVER, NULL);
  if (!self->client) {
    return false;
  }
  self->rate_hz = (double)jack->get_sample_rate(self->client);
  self->out = jack->port_register(self->client, "out", JACK_MIDI, JACK_OUTPUT, 0);
  self->in[0] = jack->port_register(self->client, "left", JACK_AUDIO, JACK_INPUT, 0);
  self->in[1] = jack->port_register(self->client, "right", JACK_AUDIO, JACK_INPUT, 0);
  if (!self->out || !self->in[0] || !self->in[1] ||
      jack->set_process_callback(self->client, process, self) ||
      jack->set_xrun_callback(self->client, count_xrun, self) || jack->activate(self->client)) {
    return false;
  }
  bool is_joined =
      join(self, jack->port_name(self->out), port_of(self, other, JACK_MIDI, JACK_INPUT, 0));
  for (int k = 0; k < SIDES; ++k) {
    is_joined = is_joined && join(self, port_of(self, other, JACK_AUDIO, JACK_OUTPUT, k),
                                  jack->port_name(self->in[k]));
  }
  return is_joined;
}

static bool play(Player* self, bool is_freewheeling) {
  if (is_freewheeling && self->jack.set_freewheel(self->client, 1)) {
    return false;
  }
  atomic_store(&self->is_running, true);
  while (!atomic_load(&self->is_over)) {
    wait_a_step();
  }
  if (is_freewheeling) {
    (void)self->jack.set_freewheel(self->client, 0);
    wait_a_step(); /* Or the server may wait for a client that is gone */
  }
  (void)self->jack.deactivate(self->client);
  (void)self->jack.client_close(self->client);
  return true;
}

static int write_sound(const Player* self, const char* path) {
  char error[512] = "";
  SoundFile* const file = soundfile_new(path, (int)self->rate_hz, 0, error, sizeof(error));
  if (!file) {
    return die(error);
  }
  if (!soundfile_write(file, self->frames, (uint32_t)self->n_frames)) {
    return die(soundfile_error(file));
  }
  const int reason = soundfile_finish(file);
  if (reason) {
    return die(strerror(reason));
  }
  printf("%u xruns\n", atomic_load(&self->n_xruns));
  return EXIT_SUCCESS;
}

int main(int argc, char** argv) {
  static Player self;
  char error[512] = "";
  if (argc < 5 || jack_find(&self.jack)) {
    return die("expected a client, a song, a sound file, seconds, and JACK");
  }
  self.song = smf_new(argv[2], error, sizeof(error));
  if (!self.song) {
    return die(error);
  }
  if (!open_ports(&self, argv[1])) {
    return die("the other client is not there");
  }
  self.n_frames = (size_t)(atof(argv[4]) * self.rate_hz);
  self.frames = calloc(self.n_frames + 1, SIDES * sizeof(float));
  if (!self.frames || !play(&self, argc > 5)) {
    return die("cannot play");
  }
  return write_sound(&self, argv[3]);
}
