#include "tools/report/trade_check.h"

#include "tools/report/trade_measure.h"

#include <math.h>

static void note(TradeOff* off, Tone heard, Tone wanted) {
  ++off->n;
  off->cents = fmax(off->cents, fabs(1200.0 * log2(heard.f0_hz / wanted.f0_hz)));
  off->decay_percent = fmax(off->decay_percent, 100.0 * fabs(heard.tau_s / wanted.tau_s - 1.0));
}

void trade_check_string(TradeCheck* check, BenchWay method, TradeString string, uint32_t n_masses) {
  static const uint32_t partials[] = {1, 2, 5, 10, 20};
  const bool is_double = method.numbers == CHAIN_DOUBLE;
  for (unsigned i = 0; i < sizeof(partials) / sizeof(partials[0]); ++i) {
    Tone wanted = {0};
    Tone heard = {0};
    if (partials[i] <= n_masses && bench_way_is_stable(method, string, n_masses) &&
        bench_way_tone(method, string, n_masses, partials[i], &wanted) &&
        trade_measure_tone(method, string, n_masses, partials[i], &heard)) {
      note(is_double ? &check->in_doubles : &check->in_floats, heard, wanted);
    }
  }
}

TradeCheck trade_check_all(void) {
  static const double pitches_hz[] = {55.0, 440.0};
  TradeCheck check = {{0}, {0}};
  for (unsigned i = 0; i < 2 * BENCH_N_WAYS; ++i) {
    const BenchWay method = bench_way_at(i / 2);
    const TradeString string = {
        .f0_hz = pitches_hz[i % 2], .tau_s = 2.0, .loss = 0.01, .rate_hz = 48000.0};
    const uint32_t most = bench_way_max_masses(method, string);
    trade_check_string(&check, method, string, 20);
    trade_check_string(&check, method, string, most < 80 ? most : 80);
    if (method.kind != BENCH_NETWORK) {
      trade_check_string(&check, method, string, most);
    }
  }
  return check;
}
