#include "core/excite/noise.h"

#include "core/base/chance.h"
#include "core/base/maths.h"

#include <math.h>

/* The masses: where they ring [Hz] and how long [s]; those that are scraped hardly do. */
static const Tone TONES[NOISE_MASSES] = {
    {450.0, 0.0005}, {1500.0, 0.00015}, {5000.0, 0.00005}, {170.0, 0.010}, {680.0, 0.008},
};

/* How long a scrape takes to die to 1/e [s]. */
static const double SCRAPE_S[NOISE_SCRAPES] = {0.006, 0.003, 0.0012};

static const double CHOKE_S = 0.002;

/* As high as a mass may ring, of the rate. */
static const double HIGHEST = 0.4;

/* How strong a scrape begins, in the mean, of its peak; and what a knock is made of, of the same.
 */
static const double SCRAPE_RMS = 0.52;
static const double KNOCK[NOISE_KNOCKS] = {0.7, 0.4};
static const double FELT = 0.3;

/* Every so many frames it is asked whether anything is left. */
enum { LOOK_FRAMES = 32 };

/* Noise of variance 1 pushes a mass to velocities of variance 2/(g (4 − a − 2g)); even chance from
 * −1 to 1 has a third of that. */
static double push_of_scrape(Pole pole) {
  return NOISE_PEAK * SCRAPE_RMS * sqrt(1.5 * pole.g * (4.0 - pole.a - 2.0 * pole.g));
}

NoiseMake noise_make(double rate_hz) {
  NoiseMake make = {.choked = exp(-1.0 / (CHOKE_S * rate_hz))};
  for (int i = 0; i < NOISE_MASSES; ++i) {
    const Tone tone = {fmin(TONES[i].f0_hz, HIGHEST * rate_hz), TONES[i].tau_s};
    (void)pole_solve(rate_hz, tone, &make.poles[i]);
    make.push[i] = i < NOISE_SCRAPES
                       ? push_of_scrape(make.poles[i])
                       : NOISE_PEAK * KNOCK[i - NOISE_SCRAPES] * sqrt(make.poles[i].a);
  }
  for (int i = 0; i < NOISE_SCRAPES; ++i) {
    make.kept[i] = exp(-1.0 / (SCRAPE_S[i] * rate_hz));
  }
  return make;
}

static void begin(Noise* noise, uint64_t seed) {
  if (!noise->is_active) {
    *noise = (Noise){.seed = seed, .is_active = true};
  }
  noise->is_choked = false;
}

void noise_scrape(Noise* noise, uint64_t seed, double hardness, double amplitude) {
  const double way = 2.0 * hardness;
  const double shares[NOISE_SCRAPES] = {1.0 - way, 1.0 - fabs(way - 1.0), way - 1.0};
  begin(noise, seed);
  for (int i = 0; i < NOISE_SCRAPES; ++i) {
    noise->scrape[i] += amplitude * sqrt(fmax(shares[i], 0.0));
  }
}

void noise_knock(
    Noise* noise, const NoiseMake* make, uint64_t seed, double hardness, double amplitude) {
  noise_scrape(noise, seed, 0.5 * hardness, FELT * amplitude);
  for (int i = NOISE_SCRAPES; i < NOISE_MASSES; ++i) {
    noise->u[i] += amplitude * make->push[i];
  }
}

void noise_choke(Noise* noise) {
  noise->is_choked = true;
}

static void choke(Noise* noise, double kept) {
  for (int i = 0; i < NOISE_SCRAPES; ++i) {
    noise->scrape[i] *= kept;
  }
  for (int i = 0; i < NOISE_MASSES; ++i) {
    noise->x[i] *= kept;
    noise->u[i] *= kept;
  }
}

/* From −1 to 1, of a third of the bits each. */
static double chance(uint64_t bits, int i) {
  return (double)(bits >> 21 * i & 0x1fffff) * 0x1p-20 - 1.0;
}

/* Of masses that are scraped the velocity is heard, in which there is little below where they
 * ring. */
static double step(Noise* noise, const NoiseMake* make) {
  const uint64_t bits = chance_bits(noise->seed, noise->n++);
  double sum = 0.0;
  for (int i = 0; i < NOISE_MASSES; ++i) {
    const Pole pole = make->poles[i];
    noise->u[i] -= pole.g * noise->u[i] + pole.a * noise->x[i];
    if (i < NOISE_SCRAPES) {
      noise->u[i] += make->push[i] * noise->scrape[i] * chance(bits, i);
      noise->scrape[i] *= make->kept[i];
    }
    noise->x[i] += noise->u[i];
    sum += i < NOISE_SCRAPES ? noise->u[i] : noise->x[i];
  }
  return sum;
}

/* What a mass may still be heard as, at most. */
static double size_of(const Noise* noise, const NoiseMake* make, int i) {
  const double a = make->poles[i].a;
  const double speed = sqrt(noise->u[i] * noise->u[i] + a * noise->x[i] * noise->x[i]);
  return i < NOISE_SCRAPES ? fmax(speed, noise->scrape[i]) : speed / sqrt(a);
}

static bool is_over(const Noise* noise, const NoiseMake* make) {
  bool is_over = true;
  for (int i = 0; i < NOISE_MASSES; ++i) {
    is_over = is_over && size_of(noise, make, i) < NOISE_FLOOR;
  }
  return is_over;
}

void noise_add(
    Noise* noise, const NoiseMake* make, uint32_t n_frames, uint32_t n_outs, float* const* outs) {
  for (uint32_t n = 0; n < n_frames && noise->is_active; ++n) {
    const double now = step(noise, make);
    if (!isfinite(now) || (noise->n % LOOK_FRAMES == 0 && is_over(noise, make))) {
      *noise = (Noise){0};
      return;
    }
    for (uint32_t i = 0; i < n_outs; ++i) {
      outs[i][n] += (float)now;
    }
    if (noise->is_choked) {
      choke(noise, make->choked);
    }
  }
}
