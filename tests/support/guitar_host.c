#include "tests/support/guitar_host.h"
#include "tests/support/host_inside.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdio.h>

#include <cmocka.h>

static double port(const Host* host, const char* symbol) {
  const double value = (double)host_get(host, symbol);
  assert_true(!isnan(value));
  return value;
}

Host* guitar_open(double rate_hz, uint32_t max_block) {
  char error[256] = "";
  Host* const host = host_new(GUITAR_URI, rate_hz, max_block, error, sizeof(error));
  if (!host) {
    fail_msg("%s", error);
  }
  return host;
}

void guitar_set_plain(Host* host) {
  strings_set(host, "pickup", 0.45);
  strings_set(host, "blend", 0.0);
  strings_set(host, "pluck", 0.4);
  strings_set(host, "width", 0.0);
}

void guitar_send(Host* host, size_t frame, GuitarEvent event) {
  assert_true(host_atom(host, (uint32_t)frame, GUITAR_EVENT_URI, &event, sizeof(event)));
}

GuitarPatch guitar_patch_of(const Host* host) {
  GuitarPatch patch = {
      .string =
          {
              .damping_per_s = port(host, "damping"),
              .tracking = port(host, "tracking"),
              .loss = host_get(host, "loss") == 1e-5f ? 0.0 : port(host, "loss"),
              .loss_tracking = port(host, "loss_tracking"),
              .inharmonicity = host_get(host, "stiffness") == 1e-6f ? 0.0 : port(host, "stiffness"),
              .inharmonicity_tracking = port(host, "stiffness_tracking"),
              .partials = (Partials)port(host, "partials"),
              .release_s = port(host, "release"),
              .release_tracking = port(host, "release_tracking"),
              .tension = port(host, "tension"),
              .tuning_hz = port(host, "tuning"),
              .max_masses = (uint32_t)port(host, "masses"),
          },
      .level = pow(10.0, port(host, "level") / 20.0),
      .pluck = port(host, "pluck"),
      .hardness = port(host, "hardness"),
      .pickups = {{port(host, "pickup"), 1.0 - port(host, "blend")},
                  {port(host, "pickup2"), port(host, "blend")}},
      .n_strings = 6,
      .capo = port(host, "capo"),
      .palm = port(host, "palm"),
      .course = port(host, "course"),
      .noise = port(host, "noise"),
      .width = port(host, "width"),
      .body = {(BodiesChoice)port(host, "body"),
               port(host, "body_mix"),
               {port(host, "body_size"), port(host, "body_damping")},
               port(host, "knock")},
  };
  for (int i = 0; i < 6; ++i) {
    char symbol[16];
    (void)snprintf(symbol, sizeof(symbol), "string%d", i + 1);
    patch.open[i] = port(host, symbol);
  }
  return patch;
}

GuitaristHow guitar_how_of(const Host* host) {
  return (GuitaristHow){
      .has_channels = port(host, "mode") > 0.0,
      .strum_s = port(host, "strum") / 1000.0,
      .legato = (uint32_t)port(host, "legato"),
      .harmonic = (uint32_t)port(host, "harmonic"),
      .variation = {port(host, "variation"), (uint32_t)port(host, "take")},
  };
}

Duo duo_new(const Host* host, double rate_hz) {
  Duo duo = {.guitar = guitar_new(rate_hz)};
  assert_non_null(duo.guitar);
  duo.guitarist = guitarist_new(guitar_seat(duo.guitar));
  assert_non_null(duo.guitarist);
  const GuitarPatch patch = guitar_patch_of(host);
  guitarist_reset(duo.guitarist);
  guitarist_set_how(duo.guitarist, guitar_how_of(host));
  guitar_reset(duo.guitar);
  guitar_set_patch(duo.guitar, &patch, 0);
  guitarist_set_patch(duo.guitarist, &patch);
  return duo;
}

void duo_free(Duo* duo) {
  guitarist_free(duo->guitarist);
  guitar_free(duo->guitar);
  *duo = (Duo){0};
}

void duo_run(const Duo* duo, Sound* sound, size_t from, size_t to) {
  assert_true(to <= sound->n_frames);
  guitarist_run(duo->guitarist, (uint32_t)(to - from), sound->left + from, sound->right + from);
}
