#include "tools/bench/bench_player.h"

#include "core/analysis/network.h"
#include "core/excite/pluck.h"
#include "core/string/chain.h"
#include "tools/bench/bench_bank.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

static const double PI = 3.14159265358979323846;

enum { BLOCK = 256 };

/* How long the noise is listened to [s]. */
static const double NOISE_S = 0.1;

static const Pluck pluck = {.place = 0.13, .hardness = 1.0, .amplitude = 0.5};

struct BenchPlayer {
  BenchWay way;
  TuningTarget wanted;
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

static bool string_chain(BenchPlayer* player, StringCoefs coefs) {
  player->memory = aligned(chain_size(player->n_masses));
  if (!player->memory) {
    return false;
  }
  chain_init(&player->chain, chain_kernel(0), player->memory, player->n_masses);
  chain_set(&player->chain, coefs);
  pluck_pull(&player->chain, pluck);
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
static bool string_network(BenchPlayer* player, StringCoefs coefs) {
  player->network = network_new();
  if (!player->network || fill_network(player->network, coefs, player->n_masses) ||
      !string_chain(player, coefs)) {
    return false;
  }
  for (uint32_t i = 0; i < player->n_masses; ++i) {
    player->network->x[i] = (double)chain_position(&player->chain, i);
    player->network->v[i] = (double)chain_velocity(&player->chain, i);
  }
  return true;
}

static bool fill_bank(BenchPlayer* player) {
  const double rate_hz = player->wanted.rate_hz;
  const double r = exp(-1.0 / (player->wanted.tone.tau_s * rate_hz));
  player->bank = aligned(sizeof(BenchBank));
  if (!player->bank) {
    return false;
  }
  for (uint32_t k = 1; k <= player->n_masses; ++k) {
    const double turn = 2.0 * PI * bench_way_ideal_hz(player->wanted, k) / rate_hz;
    bench_bank_add(player->bank, sin(PI * k * pluck.place) / k, r * cos(turn), r * sin(turn));
  }
  return true;
}

/*
  Of a string in fixed point, x[n] = gain ρⁿ X[n], X without air but else as any string: played in
  doubles, and faded outside.  U = ρ u/gain + (1 − ρ) X.
*/
static bool take_air_out(BenchPlayer* player) {
  float x[CHAIN_MAX_MASSES];
  float u[CHAIN_MAX_MASSES];
  Chain* const chain = &player->chain;
  for (uint32_t i = 0; i < player->n_masses; ++i) {
    x[i] = chain_position(chain, i);
    u[i] = chain_velocity(chain, i);
  }
  if (!chain_hold(chain, CHAIN_FIXED)) {
    return false;
  }
  const StringCoefs whole = bench_way_rounded(chain->fixed);
  player->fade = chain->fade;
  chain_init(chain, chain_kernel(0), player->memory, player->n_masses);
  chain_set(chain, whole);
  for (uint32_t i = 0; i < player->n_masses; ++i) {
    const double of_x = (1.0 - player->fade) * (double)x[i];
    chain_place(chain, i, x[i], (float)(of_x + player->fade * (double)u[i]));
  }
  return true;
}

static bool prepare(BenchPlayer* player, bool is_exact) {
  const BenchWay way = player->way;
  StringCoefs coefs = {0};
  if (way.kind == BENCH_BANK) {
    return fill_bank(player);
  }
  if (!bench_way_coefs(way, player->wanted, player->n_masses, &coefs)) {
    return false;
  }
  if (way.kind == BENCH_NETWORK) {
    return !is_exact && string_network(player, coefs);
  }
  const bool is_float = way.numbers == CHAIN_FLOAT;
  if (!string_chain(player, is_float && is_exact ? bench_way_rounded(coefs) : coefs) ||
      (is_exact && way.numbers == CHAIN_FIXED && !take_air_out(player))) {
    return false;
  }
  return chain_hold(&player->chain, is_exact ? CHAIN_DOUBLE : way.numbers);
}

static BenchPlayer*
new_player(BenchWay way, TuningTarget wanted, uint32_t n_masses, bool is_exact) {
  BenchPlayer* const player = calloc(1, sizeof(*player));
  if (!player) {
    return NULL;
  }
  player->way = way;
  player->wanted = wanted;
  player->n_masses = n_masses;
  player->reader = n_masses / 3;
  player->gain = 1.0;
  player->fade = 1.0;
  if (!prepare(player, is_exact)) {
    bench_player_free(player);
    return NULL;
  }
  return player;
}

BenchPlayer* bench_player_new(BenchWay way, TuningTarget wanted, uint32_t n_masses) {
  return new_player(way, wanted, n_masses, false);
}

void bench_player_free(BenchPlayer* player) {
  if (player) {
    network_free(player->network);
    free(player->bank);
    free(player->memory);
    free(player);
  }
}

void bench_player_run(BenchPlayer* player, uint32_t n_frames, float* out) {
  memset(out, 0, n_frames * sizeof(*out));
  if (player->bank) {
    bench_bank_run(player->bank, n_frames, out);
  } else if (player->network) {
    for (uint32_t n = 0; n < n_frames; ++n) {
      (void)network_step_by(player->network, player->way.scheme, 1.0);
      out[n] = (float)player->network->x[player->reader];
    }
  } else {
    const ChainTap tap = {.mass = {player->reader, player->reader}, .weight = {1.0f, 0.0f}};
    float* const outs[] = {out};
    chain_run(&player->chain, n_frames, &tap, 1, outs);
  }
  for (uint32_t n = 0; player->fade < 1.0 && n < n_frames; ++n) {
    player->gain *= player->fade;
    out[n] = (float)(player->gain * (double)out[n]);
  }
}

void bench_player_mode(const BenchPlayer* player, uint32_t k, double* x, double* u) {
  if (player->bank) {
    bench_bank_mode(player->bank, k, x, u);
    return;
  }
  *x = 0.0;
  *u = 0.0;
  for (uint32_t i = 0; i < player->n_masses; ++i) {
    const double shape = sin(PI * k * (i + 1.0) / (player->n_masses + 1.0));
    const Network* const network = player->network;
    *x += shape * (network ? network->x[i] : (double)chain_position(&player->chain, i));
    *u += shape * (network ? network->v[i] : (double)chain_velocity(&player->chain, i));
  }
}

double bench_player_noise_db(BenchWay way, TuningTarget wanted, uint32_t n_masses) {
  BenchPlayer* const coarse = new_player(way, wanted, n_masses, false);
  BenchPlayer* const exact = new_player(way, wanted, n_masses, true);
  double noise = 0.0;
  double sound = 0.0;
  if (coarse && exact) {
    const uint32_t n_blocks = (uint32_t)ceil(NOISE_S * wanted.rate_hz / BLOCK);
    for (uint32_t block = 0; block < n_blocks; ++block) {
      float heard[BLOCK];
      float true_to_it[BLOCK];
      bench_player_run(coarse, BLOCK, heard);
      bench_player_run(exact, BLOCK, true_to_it);
      for (uint32_t n = 0; n < BLOCK; ++n) {
        const double off = (double)heard[n] - (double)true_to_it[n];
        noise += off * off;
        sound += (double)true_to_it[n] * (double)true_to_it[n];
      }
    }
  }
  bench_player_free(coarse);
  bench_player_free(exact);
  return sound > 0.0 ? 10.0 * log10(noise / sound) : (double)NAN;
}
