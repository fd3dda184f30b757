#include "tests/support/soak.h"

#include "tests/support/guitar_host.h"
#include "tests/support/host_inside.h"
#include "tests/support/measure.h"
#include "tools/bench/bench_clock.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <string.h>

#include <cmocka.h>

enum { VOLUME = 7, BANK_FINE = 32, SOSTENUTO = 66, BRIGHTNESS = 74, N_CHANNELS = 16 };

static void send(Soak* soak, uint32_t frame, unsigned status, unsigned data1, unsigned data2) {
  for (int i = 0; i < SOAK_MOST_HOSTS && soak->hosts[i]; ++i) {
    strings_midi(soak->hosts[i], frame, status, data1, data2);
  }
}

static void set(Soak* soak, const char* symbol, double value) {
  for (int i = 0; i < SOAK_MOST_HOSTS && soak->hosts[i]; ++i) {
    strings_set(soak->hosts[i], symbol, value);
  }
}

static void look(Soak* soak, const Host* host, uint32_t n_frames) {
  for (uint32_t side = 0; side < 2; ++side) {
    const double peak = measure_peak(host_output(host, side), n_frames);
    assert_true(isfinite(peak));
    soak->peak = fmax(soak->peak, peak);
  }
  assert_true(host_get(host, "headroom") >= 0.0f && host_get(host, "headroom") <= 1.0f);
}

static void compare(Soak* soak, uint32_t n_frames) {
  const float* const mine = host_output(soak->hosts[0], 0);
  const float* const other = soak->hosts[1] ? host_output(soak->hosts[1], 0) : mine;
  for (uint32_t i = 0; i < n_frames; ++i) {
    const double unlike = (double)mine[i] - (double)other[i];
    soak->sound_energy += (double)mine[i] * (double)mine[i];
    soak->unlike_energy += unlike * unlike;
  }
}

static void run_one(Soak* soak, int i, uint32_t n_frames) {
  const double start_s = bench_clock_now_s();
  if (!host_run(soak->hosts[i], n_frames)) {
    fail_msg("%s", host_error(soak->hosts[i]));
  }
  soak->cost_s[i] += bench_clock_now_s() - start_s;
  look(soak, soak->hosts[i], n_frames);
}

/* Who is second finds the code in the cache, so they take turns. */
static void run(Soak* soak, uint32_t n_frames) {
  const int first = soak->hosts[1] ? (int)(soak->n_runs++ % 2) : 0;
  run_one(soak, first, n_frames);
  if (soak->hosts[1]) {
    run_one(soak, 1 - first, n_frames);
  }
  compare(soak, n_frames);
  soak->now += n_frames;
}

static void wait(Soak* soak, double time_s) {
  for (double left = time_s * SOAK_RATE; left > 0.0; left -= SOAK_BLOCK) {
    run(soak, SOAK_BLOCK);
  }
}

static void assert_at_rest(const Soak* soak) {
  for (int i = 0; i < SOAK_MOST_HOSTS && soak->hosts[i]; ++i) {
    assert_true(host_get(soak->hosts[i], "sounding") == 0.0f);
    assert_true(measure_peak(host_output(soak->hosts[i], 0), SOAK_BLOCK) == 0.0);
    assert_true(measure_peak(host_output(soak->hosts[i], 1), SOAK_BLOCK) == 0.0);
  }
}

/* The keys and what they were played with */

static void lift(Soak* soak, uint32_t frame, uint32_t key) {
  send(soak, frame, 0x80U | soak->channel_of[key], key, 64);
  soak->up_at[key] = 0;
}

static void strike(Soak* soak, uint32_t frame, uint32_t key, double seconds) {
  if (soak->up_at[key]) {
    lift(soak, frame, key);
  }
  soak->channel_of[key] = (uint8_t)random_below(&soak->random, soak->n_channels);
  soak->up_at[key] = soak->now + frame + 1 + (uint64_t)(seconds * SOAK_RATE);
  send(soak, frame, 0x90U | soak->channel_of[key], key, 1 + random_below(&soak->random, 127));
  ++soak->n_notes;
}

/* A third of the time a chord, else one note of a tune. */
static void play_notes(Soak* soak, uint32_t frame) {
  static const uint32_t chords[][4] = {{0, 4, 7, 12}, {0, 3, 7, 10}, {0, 5, 9, 16}, {0, 7, 12, 15}};
  Random* const random = &soak->random;
  const uint32_t root = random_below(random, soak->n_keys);
  const double seconds = random_log_between(random, 0.05, 3.0);
  const uint32_t* const chord = chords[random_below(random, 4)];
  for (uint32_t i = random_below(random, 3) ? 1 : 4; i-- > 0;) {
    strike(soak, frame, soak->lowest_key + (root + chord[i]) % soak->n_keys, seconds);
  }
}

static void play_keys(Soak* soak, uint32_t n_frames) {
  for (uint32_t key = 0; key < SOAK_KEYS; ++key) {
    if (soak->up_at[key] && soak->up_at[key] < soak->now + n_frames) {
      const uint64_t at = soak->up_at[key] > soak->now ? soak->up_at[key] - soak->now : 0;
      lift(soak, (uint32_t)at, key);
    }
  }
  for (; soak->next_note < soak->now + n_frames;
       soak->next_note += SOAK_RATE / 8 * (1 + random_below(&soak->random, 4))) {
    play_notes(soak, (uint32_t)(soak->next_note - soak->now));
  }
}

static void move_controller(Soak* soak, uint32_t frame) {
  static const uint8_t controllers[] = {1, 2, 7, 11, 64, 64, 64, 66, 67, 74};
  Random* const random = &soak->random;
  const uint32_t channel = random_below(random, soak->n_channels);
  const uint32_t value = random_below(random, 128);
  const uint32_t what = random_below(random, 14);
  if (what < sizeof(controllers)) {
    send(soak, frame, 0xB0U | channel, controllers[what],
         what > 1 && what < 4 ? 64 + value / 2 : value);
  } else if (what == 13) {
    send(soak, frame, 0xD0U | channel, value, 0);
  } else {
    send(soak, frame, 0xE0U | channel, value, what == 12 ? 64 : random_below(random, 128));
  }
}

static void change_program(Soak* soak, uint32_t frame) {
  const uint32_t channel = random_below(&soak->random, soak->n_channels);
  send(soak, frame, 0xB0U | channel, BANK_FINE, random_below(&soak->random, 8));
  send(soak, frame, 0xC0U | channel, random_below(&soak->random, 5), 0);
}

static void load_preset(Soak* soak) {
  const uint32_t k = random_below(&soak->random, host_n_presets(soak->hosts[0]));
  for (int i = 0; i < SOAK_MOST_HOSTS && soak->hosts[i]; ++i) {
    assert_true(host_preset(soak->hosts[i], host_preset_uri(soak->hosts[i], k)));
  }
  set(soak, "limiter", 1.0);
}

/* The limiter stays on, for the bound; so does the plugin.  Strings of few masses cost little. */
static bool is_automated(const char* symbol) {
  return strcmp(symbol, "limiter") != 0 && strcmp(symbol, "enabled") != 0 &&
         strcmp(symbol, "freewheel") != 0;
}

static void choose_port(Soak* soak) {
  const uint32_t port = random_below(&soak->random, host_n_ports(soak->hosts[0]));
  const char* const symbol = host_port_symbol(soak->hosts[0], port);
  HostRange range;
  soak->moving_port = UINT32_MAX;
  if (!host_range(soak->hosts[0], symbol, &range) || !is_automated(symbol)) {
    return;
  }
  const double low = (double)range.min;
  const double high = strcmp(symbol, "masses") == 0 ? 192.0 : (double)range.max;
  soak->moving_port = port;
  soak->aim = low > 0.0 ? random_log_between(&soak->random, low, high)
                        : random_between(&soak->random, low, high);
}

/* A tenth of the way a block, as a hand does. */
static void move_port(Soak* soak) {
  if (soak->moving_port == UINT32_MAX) {
    return;
  }
  const char* const symbol = host_port_symbol(soak->hosts[0], soak->moving_port);
  const double value = (double)host_get(soak->hosts[0], symbol);
  set(soak, symbol, value + 0.1 * (soak->aim - value));
}

/* Whether something that happens every `seconds` on the average does in this block. */
static bool happens(Soak* soak, uint32_t n_frames, double seconds) {
  return random_between(&soak->random, 0.0, seconds * SOAK_RATE) < (double)n_frames;
}

static void play_block(Soak* soak) {
  const uint32_t n_frames = (uint32_t)random_log_between(&soak->random, 16.0, SOAK_BLOCK);
  play_keys(soak, n_frames);
  if (happens(soak, n_frames, 0.3)) {
    move_controller(soak, random_below(&soak->random, n_frames));
  }
  if (happens(soak, n_frames, 5.0)) {
    change_program(soak, random_below(&soak->random, n_frames));
  }
  if (happens(soak, n_frames, 6.0)) {
    load_preset(soak);
  }
  if (happens(soak, n_frames, 1.5)) {
    choose_port(soak);
  }
  move_port(soak);
  run(soak, n_frames);
}

/* By what a player has: no panic button. */
static void let_go(Soak* soak) {
  for (uint32_t key = 0; key < SOAK_KEYS; ++key) {
    if (soak->up_at[key]) {
      lift(soak, 0, key);
    }
  }
  for (uint32_t channel = 0; channel < soak->n_channels; ++channel) {
    send(soak, 0, 0xB0U | channel, STRINGS_PEDAL, 0);
    send(soak, 0, 0xB0U | channel, SOSTENUTO, 0);
  }
}

static void set_all(Soak* soak) {
  for (uint32_t i = 0; i < host_n_ports(soak->hosts[0]); ++i) {
    const char* const symbol = host_port_symbol(soak->hosts[0], i);
    HostRange range;
    if (host_range(soak->hosts[0], symbol, &range)) {
      set(soak, symbol, (double)range.initial);
    }
  }
}

Host* soak_open(const char* plugin_uri) {
  Host* const host = strcmp(plugin_uri, STRINGS_URI) == 0 ? strings_open(SOAK_RATE, SOAK_BLOCK)
                                                          : guitar_open(SOAK_RATE, SOAK_BLOCK);
  for (uint32_t k = 0; k < host_n_presets(host); ++k) {
    assert_true(host_preset(host, host_preset_uri(host, k)));
    assert_true(host_run(host, SOAK_BLOCK));
  }
  return host;
}

Soak soak_start(const char* plugin_uri) {
  const bool is_guitar = strcmp(plugin_uri, STRINGS_URI) != 0;
  return (Soak){
      .hosts = {soak_open(plugin_uri)},
      .lowest_key = is_guitar ? 40 : 28,
      .n_keys = is_guitar ? 45 : 70,
      .n_channels = is_guitar ? 6 : 4,
      .moving_port = UINT32_MAX,
  };
}

void soak_sit_down(Soak* soak) {
  for (uint32_t channel = 0; channel < N_CHANNELS; ++channel) {
    send(soak, 0, 0xB0U | channel, STRINGS_SOUND_OFF, 0);
    send(soak, 0, 0xB0U | channel, STRINGS_RESET, 0);
    send(soak, 0, 0xB0U | channel, VOLUME, 127);
    send(soak, 0, 0xB0U | channel, BRIGHTNESS, 64);
  }
  for (int i = 0; i < SOAK_MOST_HOSTS && soak->hosts[i]; ++i) {
    assert_true(host_preset(soak->hosts[i], "Default"));
  }
  set_all(soak);
  memset(soak->up_at, 0, sizeof(soak->up_at));
  soak->moving_port = UINT32_MAX;
  wait(soak, 1.0);
}

void soak_play(Soak* soak, uint64_t seed, double seconds) {
  soak->random = (Random){.state = seed};
  soak->next_note = soak->now;
  const uint64_t end = soak->now + (uint64_t)(seconds * SOAK_RATE);
  while (soak->now < end) {
    play_block(soak);
  }
  set_all(soak);
  set(soak, "release", 0.049);
  let_go(soak);
  wait(soak, 2.0);
  assert_at_rest(soak);
}

void soak_silence(Soak* soak) {
  soak->next_note = soak->now;
  send(soak, 0, 0xB0U, STRINGS_PEDAL, 127);
  play_keys(soak, SOAK_BLOCK);
  wait(soak, 0.3);
  for (uint32_t channel = 0; channel < N_CHANNELS; ++channel) {
    send(soak, 0, 0xB0U | channel, STRINGS_SOUND_OFF, 0);
  }
  wait(soak, 1.0);
  assert_at_rest(soak);
  send(soak, 0, 0x90U, 60, 100);
  send(soak, SOAK_BLOCK / 2, 0x80U, 60, 64);
  wait(soak, 2.0);
  assert_at_rest(soak);
}

void soak_stop(Soak* soak) {
  host_free(soak->hosts[0]);
  host_free(soak->hosts[1]);
}
