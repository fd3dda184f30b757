#define _POSIX_C_SOURCE 200809L

#include "tools/report/trade_measure.h"

#include "tools/bench/bench_player.h"

#include <math.h>
#include <time.h>

static const double PI = 3.14159265358979323846;

enum { BLOCK = 256 };

/* Between two states, where the numbers are coarse and where steps are dear [s]. */
static const double LONG_S = 0.2;
static const double SHORT_S = 0.0;

/* How long the noise is listened to [s]. */
static const double NOISE_S = 0.1;

/* Of one look at the clock [ns]. */
static const double LOOK_NS = 3e4;

typedef struct {
  double x, u;
} State;

static void run(BenchPlayer* engine, uint32_t n_frames) {
  float out[BLOCK];
  for (uint32_t left = n_frames; left > 0;) {
    const uint32_t n = left < BLOCK ? left : BLOCK;
    bench_player_run(engine, n, out);
    left -= n;
  }
}

/* The steps from a state to the next, so that the mode turns by about a quarter more than whole
 * turns: states of which one is a multiple of another would tell nothing. */
static uint32_t stride_of(double turn, double rate_hz, double length_s) {
  const double turns = floor(length_s * rate_hz * turn / (2.0 * PI));
  const uint32_t first = (uint32_t)fmax(1.0, floor((turns + 0.25) * 2.0 * PI / turn));
  uint32_t best = first;
  for (uint32_t m = first; m < first + 4; ++m) {
    best = fabs(sin(turn * m)) > fabs(sin(turn * best)) ? m : best;
  }
  return best;
}

static bool tone_of(const State s[3], uint32_t m, double turn, double rate_hz, Tone* tone) {
  const double volume = s[1].x * s[0].u - s[1].u * s[0].x;
  const double p = (s[2].x * s[0].u - s[2].u * s[0].x) / volume;
  const double q = (s[2].x * s[1].u - s[2].u * s[1].x) / volume;
  const double radius = sqrt(q);
  const double angle = acos(0.5 * p / radius);
  if (!isfinite(angle)) {
    return false;
  }
  /* Of all angles with this cosine, the one next to where it is about to be. */
  const double near = turn * m;
  const double up = angle + 2.0 * PI * nearbyint((near - angle) / (2.0 * PI));
  const double down = -angle + 2.0 * PI * nearbyint((near + angle) / (2.0 * PI));
  const double turned = fabs(up - near) < fabs(down - near) ? up : down;
  *tone = (Tone){.f0_hz = turned / m * rate_hz / (2.0 * PI),
                 .tau_s = -(double)m / (rate_hz * log(radius))};
  return true;
}

bool trade_measure_tone(
    BenchWay method, TradeString string, uint32_t n_masses, uint32_t k, Tone* tone) {
  Tone near = {0};
  State states[3];
  if (!bench_way_tone(method, string, n_masses, k, &near) || !(near.f0_hz > 0.0)) {
    return false;
  }
  BenchPlayer* const engine = bench_player_new(method, string, n_masses);
  if (!engine) {
    return false;
  }
  const double turn = 2.0 * PI * near.f0_hz / string.rate_hz;
  const double length_s = method.kind == BENCH_NETWORK ? SHORT_S : LONG_S;
  const uint32_t stride = stride_of(turn, string.rate_hz, length_s);
  for (int i = 0; i < 3; ++i) {
    run(engine, i > 0 ? stride : 0);
    bench_player_mode(engine, k, &states[i].x, &states[i].u);
  }
  bench_player_free(engine);
  return tone_of(states, stride, turn, string.rate_hz, tone);
}

double trade_measure_noise(BenchWay method, TradeString string, uint32_t n_masses) {
  BenchPlayer* const coarse = bench_player_new(method, string, n_masses);
  BenchPlayer* const exact = bench_player_new_exact(method, string, n_masses);
  double noise = 0.0;
  double sound = 0.0;
  if (coarse && exact) {
    const uint32_t n_blocks = (uint32_t)ceil(NOISE_S * string.rate_hz / BLOCK);
    for (uint32_t block = 0; block < n_blocks; ++block) {
      float heard[BLOCK];
      float wanted[BLOCK];
      bench_player_run(coarse, BLOCK, heard);
      bench_player_run(exact, BLOCK, wanted);
      for (uint32_t n = 0; n < BLOCK; ++n) {
        const double off = (double)heard[n] - (double)wanted[n];
        noise += off * off;
        sound += (double)wanted[n] * (double)wanted[n];
      }
    }
  }
  bench_player_free(coarse);
  bench_player_free(exact);
  return sound > 0.0 ? 10.0 * log10(noise / sound) : (double)NAN;
}

static double now_ns(void) {
  struct timespec time;
  (void)clock_gettime(CLOCK_THREAD_CPUTIME_ID, &time);
  return 1e9 * (double)time.tv_sec + (double)time.tv_nsec;
}

static double look_ns(BenchPlayer* engine, uint32_t n_frames) {
  const double start = now_ns();
  run(engine, n_frames);
  return now_ns() - start;
}

void trade_measure_time(TradeClock* clock) {
  BenchPlayer* const engine = bench_player_new(clock->method, clock->string, clock->n_masses);
  if (!engine) {
    clock->ns = (double)NAN;
    return;
  }
  double taken = 0.0;
  if (clock->n_frames == 0) {
    clock->n_frames = 1;
    while ((taken = look_ns(engine, clock->n_frames)) < LOOK_NS) {
      clock->n_frames *= 2;
    }
  } else {
    run(engine, clock->n_frames / 16 + 1);
    taken = look_ns(engine, clock->n_frames);
  }
  clock->ns = fmin(clock->ns, taken / clock->n_frames);
  bench_player_free(engine);
}
