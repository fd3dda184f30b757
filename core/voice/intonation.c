#include "core/voice/intonation.h"

#include "core/base/maths.h"

#include <math.h>
#include <stdbool.h>

/* The shortest sum [s], and the fewest frames: a string must have the time to follow. */
static const double LEAST_S = 0.004;
static const double LEAST_FRAMES = 192.0;

/* What is made good of an error at the end of each sum, and the most [cents]. */
static const double SHARE = 0.4;
static const double MOST_CHANGE = 15.0;

/* Change of what is wanted after which it is to be heard anew [octaves]. */
static const double FAR = 1.0 / 12.0;

/* Errors that are let be [cents]. */
static const double IN_TUNE = 0.05;

/* The next sum ends where whole periods do, of which there is one or an even number; `late` frames
 * of it are over. */
static void begin_sum(Intonation* ear, double late) {
  const double period = ear->target.rate_hz / ear->target.tone.f0_hz;
  const double shortest = fmax(LEAST_FRAMES, LEAST_S * ear->target.rate_hz);
  const double pairs = ceil(0.5 * shortest / period);
  const bool is_halved = period < shortest;
  ear->due = (is_halved ? 2.0 * pairs : 1.0) * period - late;
  ear->half_due = is_halved ? pairs * period - late : HUGE_VAL;
  ear->sum[0] = ear->sum[1] = 0.0;
  ear->half[0] = ear->half[1] = 0.0;
  ear->n_heard = 0;
}

/* What was heard so far says nothing of what comes. */
static void forget(Intonation* ear) {
  ear->before[0] = ear->before[1] = 0.0;
  begin_sum(ear, 0.0);
}

static void listen_for(Intonation* ear, uint32_t n_frames) {
  const double angle = 2.0 * PI * ear->target.tone.f0_hz / ear->target.rate_hz;
  line_to(&ear->turn[0], cos(angle), n_frames);
  line_to(&ear->turn[1], -sin(angle), n_frames);
}

static bool move(const Intonation* ear, Chain* chain, uint32_t n_glide) {
  TuningTarget target = ear->target;
  StringCoefs coefs = {0};
  target.tone.f0_hz *= exp2(ear->cents / 1200.0);
  if (tuning_fit(&target, chain->n_masses, &coefs)) {
    return false;
  }
  chain_glide(chain, coefs, n_glide);
  return true;
}

void intonation_start(Intonation* ear, const TuningTarget* target) {
  *ear = (Intonation){.target = *target, .now = {1.0, 0.0}, .is_active = true};
  listen_for(ear, 0);
  forget(ear);
}

TuningTarget intonation_retune(Intonation* ear, const TuningTarget* target, uint32_t n_glide) {
  TuningTarget moved = *target;
  if (ear->is_active) {
    const double octaves = log2(target->tone.f0_hz / ear->target.tone.f0_hz);
    ear->target = *target;
    listen_for(ear, n_glide);
    if (fabs(octaves) > FAR) {
      forget(ear);
    }
    moved.tone.f0_hz *= exp2(ear->cents / 1200.0);
  }
  return moved;
}

static double turn_between(const double y[2], const double z[2]) {
  return atan2(z[1] * y[0] - z[0] * y[1], z[0] * y[0] + z[1] * y[1]);
}

/* Whole turns that one sum is ahead of the one before, by how its halves are turned. */
static double whole_turns(const Intonation* ear, double turned) {
  const double rest[] = {ear->sum[0] - ear->half[0], ear->sum[1] - ear->half[1]};
  const double about = 2.0 * turn_between(ear->half, rest);
  return ear->half_due < HUGE_VAL ? 2.0 * PI * round((about - turned) / (2.0 * PI)) : 0.0;
}

/* Cents by which what was heard is above what is wanted, from how far one sum is turned against
 * the one before. */
static double error_of(const Intonation* ear, double n_frames) {
  const double near = turn_between(ear->before, ear->sum);
  const double turned = near + whole_turns(ear, near);
  const double wanted = 2.0 * PI * ear->target.tone.f0_hz / ear->target.rate_hz * n_frames;
  return 1200.0 * log2(1.0 + fmax(-0.5, turned / wanted));
}

/* Tune against what was heard. */
static bool follow(Intonation* ear, Chain* chain, double n_frames) {
  const double error = error_of(ear, n_frames);
  if (!(fabs(error) > IN_TUNE)) {
    return false;
  }
  const double change = clamp(-SHARE * error, -MOST_CHANGE, MOST_CHANGE);
  ear->cents = clamp(ear->cents + change, -INTONATION_MOST_CENTS, INTONATION_MOST_CENTS);
  return ear->turn[0].n_left == 0 && move(ear, chain, ear->n_heard);
}

static void add(Intonation* ear, double speed) {
  const double x = ear->now[0];
  const double y = ear->now[1];
  ear->sum[0] += x * speed;
  ear->sum[1] += y * speed;
  ear->now[0] = x * ear->turn[0].value - y * ear->turn[1].value;
  ear->now[1] = x * ear->turn[1].value + y * ear->turn[0].value;
  ++ear->n_heard;
  if (ear->n_heard <= ear->half_due) {
    ear->half[0] = ear->sum[0];
    ear->half[1] = ear->sum[1];
  }
}

/* What a turn that moves in a straight line loses in length, and rounding. */
static void mend(Intonation* ear) {
  const double size = hypot(ear->now[0], ear->now[1]);
  ear->now[0] /= size;
  ear->now[1] /= size;
}

bool intonation_hear(Intonation* ear, Chain* chain, double speed) {
  bool has_moved = false;
  if (!ear->is_active) {
    return false;
  }
  (void)line_next(&ear->turn[0]);
  (void)line_next(&ear->turn[1]);
  add(ear, speed);
  if (ear->n_heard >= ear->due) {
    has_moved =
        (ear->before[0] != 0.0 || ear->before[1] != 0.0) && follow(ear, chain, ear->n_heard);
    ear->before[0] = ear->sum[0];
    ear->before[1] = ear->sum[1];
    mend(ear);
    begin_sum(ear, ear->n_heard - ear->due);
  }
  return has_moved;
}

void intonation_leave(Intonation* ear, Chain* chain, uint32_t n_glide) {
  if (ear->is_active) {
    ear->is_active = false;
    ear->cents = 0.0;
    (void)move(ear, chain, n_glide);
  }
}
