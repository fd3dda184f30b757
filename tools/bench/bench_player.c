#include "tools/bench/bench_player.h"

#include "core/analysis/network.h"
#include "core/excite/exciter.h"
#include "core/string/chain.h"
#include "tools/bench/bench_bank.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

static const double PI = 3.14159265358979323846;

static const Pluck pluck = {.place = 0.13, .hardness = 1.0, .amplitude = 0.5};

struct BenchPlayer {
  BenchWay method;
  TradeString string;
  uint32_t n_masses;
  uint32_t reader; /* Mass that is read */
  double gain;     /* Of what is read, after the last step */
  double fade;     /* What a step makes of it */
  Chain chain;
  void* memory;
  Network* network;
  BenchBank* bank;
};

static void* aligned(size_t size) {
  const size_t whole = (size + CHAIN_ALIGNMENT - 1) / CHAIN_ALIGNMENT * CHAIN_ALIGNMENT;
  void* const memory = aligned_alloc(CHAIN_ALIGNMENT, whole);
  if (memory) {
    memset(memory, 0, whole);
  }
  return memory;
}

static bool string_chain(BenchPlayer* engine, StringCoefs coefs) {
  engine->memory = aligned(chain_size(engine->n_masses));
  if (!engine->memory) {
    return false;
  }
  chain_init(&engine->chain, chain_kernel(0), engine->memory, engine->n_masses);
  chain_set(&engine->chain, coefs);
  exciter_pluck(&engine->chain, pluck, 2.0 * PI * engine->string.f0_hz / engine->string.rate_hz);
  return true;
}

/* Springs and dampers between the masses, and a damper from each to the ground. */
static Status fill_network(Network* network, StringCoefs coefs, uint32_t n_masses) {
  uint32_t first = 0;
  uint32_t ground = 0;
  Status status = network_add_string(network, n_masses, 1.0, coefs.k1, coefs.z1, &first);
  status = status ? status : network_add_ground(network, &ground);
  for (uint32_t i = 0; i < n_masses && !status; ++i) {
    status = network_add_damper(network, first + i, ground, coefs.z0);
  }
  status = status ? status : network_check(network, NULL);
  return status ? status : network_prepare(network);
}

/* As the chain of the same string is plucked. */
static bool string_network(BenchPlayer* engine, StringCoefs coefs) {
  engine->network = network_new();
  if (!engine->network || fill_network(engine->network, coefs, engine->n_masses) ||
      !string_chain(engine, coefs)) {
    return false;
  }
  for (uint32_t i = 0; i < engine->n_masses; ++i) {
    engine->network->x[i] = (double)chain_position(&engine->chain, i);
    engine->network->v[i] = (double)chain_velocity(&engine->chain, i);
  }
  return true;
}

static bool fill_bank(BenchPlayer* engine, bool is_exact) {
  const double rate_hz = engine->string.rate_hz;
  const double r = exp(-1.0 / (engine->string.tau_s * rate_hz));
  engine->bank = aligned(sizeof(BenchBank));
  if (!engine->bank) {
    return false;
  }
  engine->bank->is_double = is_exact || engine->method.numbers == CHAIN_DOUBLE;
  for (uint32_t k = 1; k <= engine->n_masses; ++k) {
    const double turn = 2.0 * PI * bench_way_ideal_hz(engine->string, k) / rate_hz;
    const bool is_float = engine->method.numbers == CHAIN_FLOAT;
    const double c = r * cos(turn);
    const double s = r * sin(turn);
    const double level = sin(PI * k * pluck.place) / k;
    bench_bank_add(engine->bank, (double)(float)level, is_float ? (double)(float)c : c,
                   is_float ? (double)(float)s : s);
  }
  return true;
}

static StringCoefs rounded(StringCoefs c) {
  return (StringCoefs){.k1 = (double)(float)c.k1,
                       .k2 = (double)(float)c.k2,
                       .z0 = (double)(float)c.z0,
                       .z1 = (double)(float)c.z1,
                       .k3 = (double)(float)c.k3};
}

/*
  Of a string in whole numbers, x[n] = gain ρⁿ X[n], X without air but else as any string: played in
  doubles, and faded outside.  U = ρ u/gain + (1 − ρ) X.
*/
static bool take_air_out(BenchPlayer* engine) {
  float x[CHAIN_MAX_MASSES];
  float u[CHAIN_MAX_MASSES];
  Chain* const chain = &engine->chain;
  for (uint32_t i = 0; i < engine->n_masses; ++i) {
    x[i] = chain_position(chain, i);
    u[i] = chain_velocity(chain, i);
  }
  if (!chain_hold(chain, CHAIN_FIXED)) {
    return false;
  }
  const StringCoefs whole = rounded(chain->whole);
  engine->fade = chain->fade;
  chain_init(chain, chain_kernel(0), engine->memory, engine->n_masses);
  chain_set(chain, whole);
  for (uint32_t i = 0; i < engine->n_masses; ++i) {
    const double of_x = (1.0 - engine->fade) * (double)x[i];
    chain_place(chain, i, x[i], (float)(of_x + engine->fade * (double)u[i]));
  }
  return true;
}

static bool prepare(BenchPlayer* engine, bool is_exact) {
  const BenchWay method = engine->method;
  StringCoefs coefs = {0};
  if (method.kind == BENCH_BANK) {
    return fill_bank(engine, is_exact);
  }
  if (!bench_way_coefs(method, engine->string, engine->n_masses, &coefs)) {
    return false;
  }
  if (method.kind == BENCH_NETWORK) {
    return !is_exact && string_network(engine, coefs);
  }
  const bool is_float = method.numbers == CHAIN_FLOAT;
  if (!string_chain(engine, is_float && is_exact ? rounded(coefs) : coefs) ||
      (is_exact && method.numbers == CHAIN_FIXED && !take_air_out(engine))) {
    return false;
  }
  return chain_hold(&engine->chain, is_exact ? CHAIN_DOUBLE : method.numbers);
}

static BenchPlayer*
new_engine(BenchWay method, TradeString string, uint32_t n_masses, bool is_exact) {
  BenchPlayer* const engine = calloc(1, sizeof(*engine));
  if (!engine) {
    return NULL;
  }
  engine->method = method;
  engine->string = string;
  engine->n_masses = n_masses;
  engine->reader = n_masses / 3;
  engine->gain = 1.0;
  engine->fade = 1.0;
  if (!prepare(engine, is_exact)) {
    bench_player_free(engine);
    return NULL;
  }
  return engine;
}

BenchPlayer* bench_player_new(BenchWay method, TradeString string, uint32_t n_masses) {
  return new_engine(method, string, n_masses, false);
}

BenchPlayer* bench_player_new_exact(BenchWay method, TradeString string, uint32_t n_masses) {
  return new_engine(method, string, n_masses, true);
}

void bench_player_free(BenchPlayer* engine) {
  if (engine) {
    network_free(engine->network);
    free(engine->bank);
    free(engine->memory);
    free(engine);
  }
}

void bench_player_run(BenchPlayer* engine, uint32_t n_frames, float* out) {
  memset(out, 0, n_frames * sizeof(*out));
  if (engine->bank) {
    bench_bank_run(engine->bank, n_frames, out);
  } else if (engine->network) {
    for (uint32_t n = 0; n < n_frames; ++n) {
      (void)network_step_by(engine->network, engine->method.scheme, 1.0);
      out[n] = (float)engine->network->x[engine->reader];
    }
  } else {
    const ChainTap tap = {.mass = {engine->reader, engine->reader}, .weight = {1.0f, 0.0f}};
    float* const outs[] = {out};
    chain_run(&engine->chain, n_frames, &tap, 1, outs);
  }
  for (uint32_t n = 0; engine->fade < 1.0 && n < n_frames; ++n) {
    engine->gain *= engine->fade;
    out[n] = (float)(engine->gain * (double)out[n]);
  }
}

void bench_player_mode(const BenchPlayer* engine, uint32_t k, double* x, double* u) {
  if (engine->bank) {
    bench_bank_mode(engine->bank, k, x, u);
    return;
  }
  *x = 0.0;
  *u = 0.0;
  for (uint32_t i = 0; i < engine->n_masses; ++i) {
    const double shape = sin(PI * k * (i + 1.0) / (engine->n_masses + 1.0));
    const Network* const network = engine->network;
    *x += shape * (network ? network->x[i] : (double)chain_position(&engine->chain, i));
    *u += shape * (network ? network->v[i] : (double)chain_velocity(&engine->chain, i));
  }
}
