/* What scripts that run hosts hear: a number or two, measured in a stretch of a sound file.

     listen tone FILE FROM TO HZ TAU    cents from HZ, and how far the decay is from TAU, as a
   fraction listen level FILE FROM TO          peak and root of the mean square listen rough FILE
   FROM TO          largest sixth difference, as a fraction of the peak listen first FILE time of
   the first sample that is not 0 listen differ A B FROM TO LATER    largest difference, B being
   later by so much, in dB below A's peak; -inf if there is none

   Times are in seconds.  The left side is measured, but both are compared. */
#include "tests/support/measure.h"

#include <math.h>
#include <sndfile.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { SIDES = 2, USAGE = 2, DIFFERENCES = 6, BLOCK = 1024 };

typedef struct {
  float* samples[SIDES];
  size_t n_frames;
  double rate_hz;
} Recording;

/* Frames from one time to another; none if they are not there. */
typedef struct {
  size_t from;
  size_t n;
} Stretch;

static void split(Recording* self, const float* frames, int n_sides) {
  for (size_t i = 0; i < self->n_frames; ++i) {
    for (int k = 0; k < SIDES; ++k) {
      self->samples[k][i] = frames[i * (size_t)n_sides + (size_t)(k < n_sides ? k : 0)];
    }
  }
}

static Recording read_file(const char* path) {
  Recording self = {0};
  SF_INFO info = {0};
  SNDFILE* const file = sf_open(path, SFM_READ, &info);
  if (!file) {
    (void)fprintf(stderr, "listen: %s: %s\n", path, sf_strerror(NULL));
    exit(EXIT_FAILURE);
  }
  float* const frames = calloc((size_t)(info.frames * info.channels) + 1, sizeof(float));
  for (int k = 0; k < SIDES; ++k) {
    self.samples[k] = calloc((size_t)info.frames + 1, sizeof(float));
  }
  if (!frames || !self.samples[0] || !self.samples[1]) {
    exit(EXIT_FAILURE);
  }
  self.n_frames = (size_t)sf_readf_float(file, frames, info.frames);
  self.rate_hz = (double)info.samplerate;
  split(&self, frames, info.channels);
  free(frames);
  (void)sf_close(file);
  return self;
}

static void free_samples(Recording* self) {
  for (int k = 0; k < SIDES; ++k) {
    free(self->samples[k]);
  }
}

static Stretch stretch(const Recording* self, const char* from_s, const char* to_s) {
  const double from = round(atof(from_s) * self->rate_hz);
  const double to = round(atof(to_s) * self->rate_hz);
  if (!(from >= 0.0 && to > from && to <= (double)self->n_frames)) {
    (void)fprintf(stderr, "listen: found %s to %s s, expected something within %.3f s\n", from_s,
                  to_s, (double)self->n_frames / self->rate_hz);
    exit(EXIT_FAILURE);
  }
  return (Stretch){(size_t)from, (size_t)(to - from)};
}

static void tell_tone(const Recording* self, Stretch at, double f0_hz, double tau_s) {
  Tone tone;
  if (measure_tone(self->samples[0] + at.from, at.n, self->rate_hz, (Tone){f0_hz, tau_s}, &tone)) {
    printf("%.5f %.6f\n", measure_cents(tone.f0_hz, f0_hz), tone.tau_s / tau_s - 1.0);
  } else {
    printf("none none\n");
  }
}

static void tell_level(const Recording* self, Stretch at) {
  printf("%.6g %.6g\n", measure_peak(self->samples[0] + at.from, at.n),
         measure_rms(self->samples[0] + at.from, at.n));
}

/* Each difference takes 6 dB an octave from what is low: of a sound whose partials are all far
 * below the rate only steps and kinks are left. */
static double roughness(const Recording* self, Stretch at, double step) {
  double largest = 0.0;
  double last[DIFFERENCES + 1] = {0.0};
  for (size_t i = 0; i < at.n; ++i) {
    double value = (double)self->samples[0][at.from + i] * (1.0 + step * (double)(i / BLOCK));
    for (int k = 0; k <= DIFFERENCES; ++k) {
      const double before = last[k];
      last[k] = value;
      value -= before;
    }
    if (i > DIFFERENCES) {
      largest = fmax(largest, fabs(last[DIFFERENCES]));
    }
  }
  return largest / measure_peak(self->samples[0] + at.from, at.n);
}

static void tell_roughness(const Recording* self, Stretch at) {
  printf("%.3g %.3g\n", roughness(self, at, 0.0), roughness(self, at, 0.01));
}

static void tell_first(const Recording* self) {
  size_t i = 0;
  while (i < self->n_frames && self->samples[0][i] == 0.0f && self->samples[1][i] == 0.0f) {
    ++i;
  }
  printf("%.9f\n", (double)i / self->rate_hz);
}

static void tell_difference(const Recording* a, const Recording* b, Stretch at, Stretch there) {
  double peak = 0.0;
  double largest = 0.0;
  for (int k = 0; k < SIDES; ++k) {
    for (size_t i = 0; i < at.n; ++i) {
      const double left = (double)a->samples[k][at.from + i];
      const double right = (double)b->samples[k][there.from + i];
      peak = fmax(peak, fabs(left));
      largest = right - left == 0.0 ? largest : fmax(largest, fabs(right - left));
      largest = isfinite(left) && isfinite(right) ? largest : HUGE_VAL;
    }
  }
  printf("%.1f\n", 20.0 * log10(largest / peak));
}

static int compare(char** argv) {
  Recording a = read_file(argv[2]);
  Recording b = read_file(argv[3]);
  char from[32];
  char to[32];
  (void)snprintf(from, sizeof(from), "%.9f", atof(argv[4]) + atof(argv[6]));
  (void)snprintf(to, sizeof(to), "%.9f", atof(argv[5]) + atof(argv[6]));
  tell_difference(&a, &b, stretch(&a, argv[4], argv[5]), stretch(&b, from, to));
  free_samples(&a);
  free_samples(&b);
  return EXIT_SUCCESS;
}

static bool is_asked(int argc, char** argv, const char* word, int n) {
  return argc == n && !strcmp(argv[1], word);
}

int main(int argc, char** argv) {
  if (is_asked(argc, argv, "differ", 7)) {
    return compare(argv);
  }
  const bool tone = is_asked(argc, argv, "tone", 7);
  const bool level = is_asked(argc, argv, "level", 5);
  const bool rough = is_asked(argc, argv, "rough", 5);
  if (!tone && !level && !rough && !is_asked(argc, argv, "first", 3)) {
    (void)fprintf(stderr, "listen: found %s, expected tone, level, rough, first or differ\n",
                  argc > 1 ? argv[1] : "nothing");
    return USAGE;
  }
  Recording recording = read_file(argv[2]);
  if (tone) {
    tell_tone(&recording, stretch(&recording, argv[3], argv[4]), atof(argv[5]), atof(argv[6]));
  } else if (level) {
    tell_level(&recording, stretch(&recording, argv[3], argv[4]));
  } else if (rough) {
    tell_roughness(&recording, stretch(&recording, argv[3], argv[4]));
  } else {
    tell_first(&recording);
  }
  free_samples(&recording);
  return EXIT_SUCCESS;
}
