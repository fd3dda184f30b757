#include "tools/report/figure_groups.h"

#include "core/harp/harp.h"

#include <math.h>
#include <stdlib.h>

static const double RATE_HZ = 48000.0;

/* Rows of a map, evenly in the logarithm. */
enum { N_ROWS = 49 };

/* What the ports are at, if nobody touches them. */
static const HarpPatch untouched = {
    .level = 1.0,
    .string.damping_per_s = 0.6,
    .string.tracking = 0.5,
    .string.loss = 0.01,
    .string.partials = PARTIALS_TRUEST,
    .pickup = 0.2,
    .spread = 0.1,
    .pluck = 0.13,
    .hardness = 0.5,
    .string.release_s = 0.1,
    .string.tuning_hz = 440.0,
    .string.max_masses = 128,
};

/* A patch with one of its values somewhere on its way. */
typedef HarpPatch (*PatchAt)(double way);

static HarpPatch patch_of_stiffness(double way) {
  HarpPatch patch = untouched;
  patch.string.inharmonicity = 1e-6 * pow(1e5, way);
  return patch;
}

static HarpPatch patch_of_loss(double way) {
  HarpPatch patch = untouched;
  patch.string.loss = 1e-5 * pow(1e5, way);
  return patch;
}

/* A string as the harp makes it; its memory is laid over whatever was there. */
static HarpString string_of(const HarpPatch* patch, uint32_t key, void* memory) {
  const Pluck pluck = {patch->pluck, patch->hardness, HARP_NOTE_PEAK};
  HarpString string;
  harp_string_init(&string, patch, RATE_HZ, key, memory, CHAIN_MAX_MASSES, NULL);
  harp_string_play(&string, pluck, 0);
  return string;
}

static void write_map(FILE* data, PatchAt patch_at, double (*value_at)(double), void* memory) {
  figure_block(data, "map: key, value, margin, masses");
  for (uint32_t row = 0; row < N_ROWS; ++row) {
    const double way = row / (N_ROWS - 1.0);
    const HarpPatch patch = patch_at(way);
    for (uint32_t key = 0; key < HARP_KEYS; ++key) {
      const HarpString string = string_of(&patch, key, memory);
      (void)fprintf(data, "%u %.9g %.4g %u\n", key, value_at(way), string.voice.headroom,
                    string.voice.chain.n_masses);
    }
  }
}

/* Key from which on a string has fewer masses than `level`: the higher, the fewer. */
static uint32_t first_below(const HarpPatch* patch, uint32_t level, void* memory) {
  uint32_t low = 0;
  uint32_t high = HARP_KEYS;
  while (low < high) {
    const uint32_t middle = (low + high) / 2;
    if (string_of(patch, middle, memory).voice.chain.n_masses < level) {
      high = middle;
    } else {
      low = middle + 1;
    }
  }
  return low;
}

static void write_levels(FILE* data, PatchAt patch_at, double (*value_at)(double), void* memory) {
  figure_block(data, "levels: key where masses fall below 128, 64, ... 2, value");
  for (uint32_t level = untouched.string.max_masses; level > 1; level /= 2) {
    for (uint32_t row = 0; row < N_ROWS; ++row) {
      const double way = row / (N_ROWS - 1.0);
      const HarpPatch patch = patch_at(way);
      (void)fprintf(data, "%.1f %.6g\n", first_below(&patch, level, memory) - 0.5, value_at(way));
    }
    (void)fputs("\n", data);
  }
}

static Status write_maps(FILE* data, PatchAt patch_at, double (*value_at)(double)) {
  void* const memory = aligned_alloc(CHAIN_ALIGNMENT, chain_size(CHAIN_MAX_MASSES));
  if (!memory) {
    return STATUS_NO_MEMORY;
  }
  write_map(data, patch_at, value_at, memory);
  write_levels(data, patch_at, value_at, memory);
  free(memory);
  return STATUS_OK;
}

static double stiffness_at(double way) {
  return patch_of_stiffness(way).string.inharmonicity;
}

static double loss_at(double way) {
  return patch_of_loss(way).string.loss;
}

static Status write_stiffness(FILE* data) {
  return write_maps(data, patch_of_stiffness, stiffness_at);
}

static Status write_loss(FILE* data) {
  return write_maps(data, patch_of_loss, loss_at);
}

/* Side by side in the same colours: dark red is near the limit, or few; dark blue far, or many. */
#define MAPS(port, range)                                                                          \
  "set multiplot\n"                                                                                \
  "set logscale cb\n"                                                                              \
  "set format y '10^{%g}'\n"                                                                       \
  "set xlabel 'key'\n"                                                                             \
  "set xtics 0,24,127\n"                                                                           \
  "set ytics 1\n"                                                                                  \
  "set ylabel '" port "'\n"                                                                        \
  "set palette defined (0 '#7a0403', 1 '#d55e00', 2 '#f0c35a', 3 '#56b4e9', 4 '#0b3c5d')\n"        \
  "unset key\n"                                                                                    \
  "set lmargin at screen 0.10\n"                                                                   \
  "set rmargin at screen 0.41\n"                                                                   \
  "set cbrange [1e-3:1]\n"                                                                         \
  "set format cb '10^{%T}'\n"                                                                      \
  "set title 'margin  1 − max (a_k + 2 g_k)/4'\n"                                                \
  "plot [-0.5:127.5][" range "] data index 'map' using 1:(log10($2)):3 with image\n"               \
  "set lmargin at screen 0.60\n"                                                                   \
  "set rmargin at screen 0.91\n"                                                                   \
  "set cbrange [1:128]\n"                                                                          \
  "set cbtics (1, 2, 4, 8, 16, 32, 64, 128)\n"                                                     \
  "set format cb '%g'\n"                                                                           \
  "set title 'masses'\n"                                                                           \
  "plot [-0.5:127.5][" range "] data index 'map' using 1:(log10($2)):4 with image, \\\n"           \
  "  data index 'levels' using 1:(log10($2)) with lines lw 1.2 lc rgb black\n"                     \
  "unset multiplot\n"

static const char stiffness_script[] = MAPS("stiffness B", "-6:-1");
static const char loss_script[] = MAPS("loss s", "-5:0");

#undef MAPS

static const char EQUATION[] =
    "1 − max (a_k + 2 g_k)/4 over the modes, by (33) of each; the masses are the most, up to the "
    "port's 128, that leave 1e-3 of it";

static const char SOURCE[] =
    "None: this map is Hooke's own, of its strings at 48 kHz with every other port at its default.";

const Figure figure_margin[2] = {
    {.number = 31,
     .title = "Margin of stability and masses, by key and stiffness",
     .shows = "Nothing is unstable anywhere: the least margin in the map is 1.0e-3, which is what "
              "is left for rounding.  Left: the plain at low keys is where the port's masses, not "
              "stability, are the limit.  Elsewhere a string takes all the masses that it can have "
              "and its margin is what one more would have cost, so it is of chance, and larger the "
              "fewer they are.  Right: what stiffness costs.  Along each line the masses are 128, "
              "128, 64 and so on to 2.  A4 has 53 when it is flexible and 15 at the stiffest.",
     .equation = EQUATION,
     .source = SOURCE,
     .script = stiffness_script,
     .write = write_stiffness},
    {.number = 32,
     .title = "Margin of stability and masses, by key and loss",
     .shows = "The same over the share of the damping that sits between the masses.  Nothing is "
              "unstable anywhere; the least margin is 1.0e-3.  At the default damping loss costs "
              "next to no masses, at most nine in a hundred and that at G2: it is the pitch that "
              "limits them.",
     .equation = EQUATION,
     .source = SOURCE,
     .script = loss_script,
     .write = write_loss},
};
