#include "core/voice/radiator.h"

#include "core/base/maths.h"

#include <math.h>
#include <string.h>

/* Frames between the places at which it is seen whether it may rest. */
enum { GRID = 64 };

/* What none hears of it. */
static const double LEAST = 1e-9;

/* How hard a knock is beside a pluck's amplitude, and how long with the softest and the hardest of
 * what plays [s]. */
static const double KNOCK = 2.0;
static const double SOFT_KNOCK_S = 0.006;
static const double HARD_KNOCK_S = 0.0015;

/* The shortest fade to another body [s]: low ones take their time to sound. */
static const double FADE_S = 0.03;

/* How many times as soon it is silent with a hand on it. */
static const double CHOKED = 60.0;

void radiator_init(Radiator* radiator) {
  memset(radiator, 0, sizeof(*radiator));
  radiator->n_until_grid = GRID;
  line_set(&radiator->fade, 1.0);
  line_set(&radiator->strings, 1.0);
}

void radiator_rest(Radiator* radiator) {
  for (int b = 0; b < 2; ++b) {
    if (radiator->is_awake[b]) {
      bank_rest(&radiator->banks[b]);
      radiator->is_awake[b] = false;
    }
  }
  memset(radiator->knocks, 0, sizeof(radiator->knocks));
  radiator->is_choked = false;
  radiator->was_pulled = false;
  radiator->n_until_grid = GRID;
}

bool radiator_body_is_same(const RadiatorBody* a, const RadiatorBody* b) {
  return a->body == b->body && a->version == b->version &&
         (!a->body || (a->shape.size == b->shape.size && a->shape.damping == b->shape.damping));
}

/* What was heard is left behind, and fades. */
static void
take_body(Radiator* radiator, const RadiatorBody* wanted, double rate_hz, uint32_t n_frames) {
  radiator->banks[1] = radiator->banks[0];
  radiator->is_awake[1] = radiator->is_awake[0] && n_frames > 0;
  radiator->is_awake[0] = false;
  bank_clear(&radiator->banks[0]);
  if (wanted->body) {
    body_bank(wanted->body, wanted->shape, rate_hz, &radiator->banks[0]);
  }
  radiator->now = *wanted;
  line_set(&radiator->fade, 0.0);
  line_to(&radiator->fade, 1.0, n_frames);
}

void radiator_take_file(Radiator* radiator, const Body* body) {
  radiator->file.n_modes = 0;
  if (body) {
    radiator->file = *body;
  }
  ++radiator->version;
}

const Body* radiator_body(const Radiator* radiator, BodiesChoice choice) {
  const Body* const body = choice == BODIES_FILE ? &radiator->file : bodies_shipped(choice);
  return body && body->n_modes > 0 ? body : NULL;
}

RadiatorBody radiator_wanted(const Radiator* radiator, const BodyPatch* patch) {
  const Body* const body = radiator_body(radiator, patch->choice);
  return (RadiatorBody){body, body == &radiator->file ? radiator->version : 0, patch->shape};
}

void radiator_set(Radiator* radiator, const BodyPatch* patch, double rate_hz, uint32_t n_frames) {
  RadiatorBody wanted = radiator_wanted(radiator, patch);
  const double mix = wanted.body ? patch->mix : 0.0;
  wanted.shape.damping *= radiator->is_choked ? CHOKED : 1.0;
  if (radiator->fade.n_left == 0 && !radiator_body_is_same(&wanted, &radiator->now)) {
    const bool is_at_rest = radiator->now.body && !radiator->is_awake[0] && !radiator->is_awake[1];
    const uint32_t n_fade = (uint32_t)fmax(n_frames, FADE_S * rate_hz);
    take_body(radiator, &wanted, rate_hz, n_frames > 0 && !is_at_rest ? n_fade : 0);
  }
  if (radiator->gain.goal != sqrt(mix)) {
    line_to(&radiator->strings, sqrt(1.0 - mix), n_frames);
    line_to(&radiator->gain, sqrt(mix), n_frames);
  }
}

void radiator_choke(Radiator* radiator) {
  radiator->is_choked = true;
}

uint32_t radiator_stretch(const Radiator* radiator) {
  return radiator->fade.n_left > 0 ? radiator->fade.n_left : UINT32_MAX;
}

bool radiator_is_on(const Radiator* radiator) {
  return radiator->now.body || radiator->fade.n_left > 0;
}

void radiator_knock(Radiator* radiator, double force, uint32_t n_frames) {
  Knock* oldest = &radiator->knocks[0];
  for (int i = 1; i < RADIATOR_KNOCKS; ++i) {
    Knock* const knock = &radiator->knocks[i];
    oldest = knock->turn == 0.0 || (oldest->turn != 0.0 && knock->phase > oldest->phase) ? knock
                                                                                         : oldest;
  }
  *oldest = (Knock){.force = force, .turn = 2.0 * PI / (n_frames + 1.0)};
}

void radiator_play(Radiator* radiator, double rate_hz, double hardness, double amplitude) {
  radiator->is_choked = false;
  const double time_s = SOFT_KNOCK_S * pow(HARD_KNOCK_S / SOFT_KNOCK_S, hardness);
  if (amplitude > 0.0) {
    radiator_knock(radiator, KNOCK * amplitude, (uint32_t)fmax(time_s * rate_hz, 1.0));
  }
}

/* What is pulled and pushed by; whether it is by anything. */
static bool
gather(Radiator* radiator, const float* pull, uint32_t n_frames, float force[RADIATOR_FRAMES]) {
  bool is_pulled = false;
  memcpy(force, pull, n_frames * sizeof(float));
  for (int i = 0; i < RADIATOR_KNOCKS; ++i) {
    Knock* const knock = &radiator->knocks[i];
    for (uint32_t n = 0; n < n_frames && knock->turn > 0.0; ++n) {
      knock->phase += knock->turn;
      force[n] += (float)(0.5 * knock->force * (1.0 - cos(knock->phase)));
      *knock = knock->phase >= 2.0 * PI - 0.5 * knock->turn ? (Knock){0} : *knock;
    }
  }
  for (uint32_t n = 0; n < n_frames; ++n) {
    is_pulled = is_pulled || force[n] != 0.0f;
  }
  return is_pulled;
}

/* On the grid: what nothing pulls and none hears any more is at rest. */
static void settle(Radiator* radiator) {
  radiator->n_until_grid = GRID;
  for (int b = 0; b < 2; ++b) {
    const bool is_over = b == 1 && radiator->fade.n_left == 0;
    if (radiator->is_awake[b] &&
        (is_over || (!radiator->was_pulled && bank_level(&radiator->banks[b]) < LEAST))) {
      bank_rest(&radiator->banks[b]);
      radiator->is_awake[b] = false;
    }
  }
  radiator->was_pulled = false;
}

typedef struct {
  float left[RADIATOR_FRAMES];
  float right[RADIATOR_FRAMES];
} Heard;

static void hear(Radiator* radiator, int b, const float* force, uint32_t n_frames, Heard* heard) {
  memset(heard->left, 0, n_frames * sizeof(float));
  memset(heard->right, 0, n_frames * sizeof(float));
  if (radiator->is_awake[b]) {
    bank_run(&radiator->banks[b], force, n_frames, heard->left, heard->right);
  }
}

static void mix(Radiator* radiator,
                const Heard* now,
                const Heard* old,
                uint32_t n_frames,
                float* left,
                float* right) {
  for (uint32_t n = 0; n < n_frames; ++n) {
    const float share = (float)line_next(&radiator->fade);
    const float strings = (float)line_next(&radiator->strings);
    const float gain = (float)line_next(&radiator->gain);
    left[n] = strings * left[n] + gain * (old->left[n] + share * (now->left[n] - old->left[n]));
    right[n] =
        strings * right[n] + gain * (old->right[n] + share * (now->right[n] - old->right[n]));
  }
}

/* As many as there are up to the next place of the grid. */
static void
run_some(Radiator* radiator, const float* pull, uint32_t n_frames, float* left, float* right) {
  float force[RADIATOR_FRAMES];
  Heard now;
  Heard old;
  const bool is_pulled = gather(radiator, pull, n_frames, force);
  radiator->was_pulled = radiator->was_pulled || is_pulled;
  radiator->is_awake[0] = radiator->is_awake[0] || (is_pulled && radiator->banks[0].n_modes > 0);
  hear(radiator, 0, force, n_frames, &now);
  hear(radiator, 1, force, n_frames, &old);
  mix(radiator, &now, &old, n_frames, left, right);
}

void radiator_run(
    Radiator* radiator, const float* pull, uint32_t n_frames, float* left, float* right) {
  if (!radiator_is_on(radiator) && radiator->gain.n_left == 0 && radiator->strings.value == 1.0) {
    radiator_rest(radiator); /* So that the next begins as the first did, whenever it comes. */
    return;
  }
  for (uint32_t done = 0; done < n_frames;) {
    const uint32_t n = least(n_frames - done, radiator->n_until_grid);
    run_some(radiator, pull + done, n, left + done, right + done);
    radiator->n_until_grid -= n;
    if (radiator->n_until_grid == 0) {
      settle(radiator);
    }
    done += n;
  }
}
