#include "core/analysis/retune.h"
#include "core/string/tuning.h"
#include "tools/commands/args.h"
#include "tools/commands/commands.h"
#include "tools/formats/scene.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <strings.h>

const char tune_help[] =
    "usage: hooke tune --freq HZ --tau S --masses N --rate HZ [OPTION]...\n"
    "       hooke tune --freq HZ --tau S [--mode K] [--rate HZ] IN.scene\n"
    "\n"
    "Find the string of N masses between two fixed ends that has this pitch and decay once it is\n"
    "sampled, or what a scene's springs and dampers are to be multiplied by.\n"
    "\n"
    "  --freq HZ           the pitch, below half the rate\n"
    "  --tau S             the time in which it dies to 1/e; inf for never\n"
    "  --rate HZ           steps per second; for a scene its own by default\n"
    "  --masses N          how many\n"
    "  --mass KG           of each, 1 by default\n"
    "  --loss S            the share of the damping that is between masses and not to the ground,\n"
    "                      0 to 1; 1 by default, as in the paper\n"
    "  --stiffness B       inharmonicity, 0 by default\n"
    "  --mode K            which mode of a scene, from 1, by default the lowest that is not of 0 "
    "Hz\n"
    "  --csv               for machines: a line for each mode, or one for a scene, under a line "
    "of\n"
    "                      names; the string's own numbers are in every line\n"
    "\n"
    "Returns 0, or 3 if what was found is unstable, and 1 or 2 if nothing was found.\n";

enum { FREQ = ARGS_OPTION, TAU, RATE, MASSES, MASS, LOSS, STIFFNESS, MODE, CSV };

static const struct option options[] = {{"freq", required_argument, NULL, FREQ},
                                        {"tau", required_argument, NULL, TAU},
                                        {"rate", required_argument, NULL, RATE},
                                        {"masses", required_argument, NULL, MASSES},
                                        {"mass", required_argument, NULL, MASS},
                                        {"loss", required_argument, NULL, LOSS},
                                        {"stiffness", required_argument, NULL, STIFFNESS},
                                        {"mode", required_argument, NULL, MODE},
                                        {"csv", no_argument, NULL, CSV},
                                        {0}};

enum { MAX_MASSES = 10000000 };

typedef struct {
  Args args;
  const char* in;      /* NULL: a string */
  TuningTarget target; /* Its numbers are 0 until they are given */
  double mass_kg;
  long n_masses;             /* 0: not given */
  long mode;                 /* 0: the lowest that is not of 0 Hz */
  const char* string_option; /* One that was given and is for strings only */
  bool is_csv;
} Command;

static bool take_tau(Command* self, const char* value) {
  if (!strcasecmp(value, "inf")) {
    self->target.tone.tau_s = HUGE_VAL;
    return true;
  }
  return args_number_or(&self->args, "--tau", value, 1e-9, 1e9, "inf", &self->target.tone.tau_s);
}

static bool take_operand(Command* self) {
  if (self->in) {
    return args_fail(&self->args, false, "found '%s' too, expected one scene", self->args.value);
  }
  self->in = self->args.value;
  return true;
}

static bool take_string_option(Command* self, int index) {
  const Args* const args = &self->args;
  const char* const value = args->value;
  self->string_option = options[index - ARGS_OPTION].name;
  switch (index) {
  case MASSES:
    return args_whole(args, "--masses", value, 1, MAX_MASSES, &self->n_masses);
  case MASS:
    return args_number(args, "--mass", value, 1e-30, 1e30, &self->mass_kg);
  case LOSS:
    return args_number(args, "--loss", value, 0.0, 1.0, &self->target.loss);
  default:
    return args_number(args, "--stiffness", value, 0.0, 1e6, &self->target.inharmonicity);
  }
}

static bool take_option(Command* self, int index) {
  const Args* const args = &self->args;
  switch (index) {
  case FREQ:
    return args_number(args, "--freq", args->value, 1e-9, 1e9, &self->target.tone.f0_hz);
  case TAU:
    return take_tau(self, args->value);
  case RATE:
    return args_number(args, "--rate", args->value, 1e-9, 1e9, &self->target.rate_hz);
  case MODE:
    return args_whole(args, "--mode", args->value, 1, MAX_MASSES, &self->mode);
  case CSV:
    return self->is_csv = true;
  case ARGS_OPERAND:
    return take_operand(self);
  case ARGS_ERROR:
    return false;
  default:
    return take_string_option(self, index);
  }
}

static bool lacks(const Command* self, const char* what) {
  args_fail(&self->args, 0, "found no %s, expected it; try hooke help tune", what);
  return false;
}

static bool check(const Command* self) {
  if (!(self->target.tone.f0_hz > 0.0)) {
    return lacks(self, "--freq");
  }
  if (!(self->target.tone.tau_s > 0.0)) {
    return lacks(self, "--tau");
  }
  if (self->in && self->string_option) {
    return args_fail(&self->args, false, "found --%s for a scene, expected it for a string only",
                     self->string_option);
  }
  if (self->in) {
    return true;
  }
  if (self->mode) {
    return args_fail(&self->args, false, "found --mode for a string, expected it for a scene only");
  }
  return (self->n_masses || lacks(self, "--masses, nor a scene")) &&
         (self->target.rate_hz > 0.0 || lacks(self, "--rate"));
}

static bool parse(Command* self) {
  for (int i = args_next(&self->args); i != ARGS_END; i = args_next(&self->args)) {
    if (!take_option(self, i)) {
      return false;
    }
  }
  return check(self);
}

static bool is_below_half(const Command* self, double rate_hz) {
  const double f0_hz = self->target.tone.f0_hz;
  if (f0_hz < 0.5 * rate_hz) {
    return true;
  }
  return args_fail(&self->args, false,
                   "--freq: found %.12g, expected a pitch below half the rate, %.12g Hz", f0_hz,
                   0.5 * rate_hz);
}

static void print_quantity(const char* name, double value, const char* unit, const char* what) {
  printf("%-8s %-22.17g %-7s %s\n", name, value, unit, what);
}

/* The paper's numbers first; what it does not have only where there is any. */
static void print_string(const Command* self, StringCoefs coefs) {
  const double rate_hz = self->target.rate_hz;
  const double m = self->mass_kg;
  printf("%-8s %-22.16g %-7s %s\n", "omega0", rate_hz * sqrt(coefs.k1), "rad/s",
         "of a mass on one spring");
  printf("%-8s %-22.15g %-7s %s\n", "gamma", rate_hz * coefs.z1, "1/s", "of a mass on one damper");
  print_quantity("m", m, "kg", "each mass");
  print_quantity("k", m * rate_hz * rate_hz * coefs.k1, "N/m", "springs between neighbours");
  print_quantity("Z", m * rate_hz * coefs.z1, "kg/s", "dampers between neighbours");
  if (coefs.z0 > 0.0) {
    print_quantity("Z0", m * rate_hz * coefs.z0, "kg/s", "dampers to the ground");
  }
  if (coefs.k2 > 0.0) {
    print_quantity("k2", m * rate_hz * rate_hz * coefs.k2, "N/m", "stiffness against bending");
  }
}

static void print_mode(unsigned long k, double rate_hz, Pole pole) {
  const Tone tone = pole_tone(rate_hz, pole);
  char tau[40] = "for ever";
  if (isfinite(tone.tau_s)) {
    (void)snprintf(tau, sizeof(tau), "%.7f", tone.tau_s);
  }
  printf("%5lu %16.5f %14s  %s\n", k, tone.f0_hz, tau, pole_region_text(pole_region(pole)));
}

static bool is_stable(const Command* self, StringCoefs coefs) {
  return tuning_headroom(coefs, (uint32_t)self->n_masses) >= 0.0;
}

static void print_table(const Command* self, StringCoefs coefs) {
  const unsigned long limit = tuning_max_masses(&self->target, MAX_MASSES);
  const uint32_t n = (uint32_t)self->n_masses;
  print_string(self, coefs);
  printf("\n mode   frequency [Hz]        tau [s]  region\n");
  for (uint32_t k = 1; k <= n; ++k) {
    print_mode(k, self->target.rate_hz, tuning_mode(coefs, n, k));
  }
  printf("\n%s with %ld masses; up to %lu masses are stable\n",
         is_stable(self, coefs) ? "stable" : "unstable", self->n_masses, limit);
}

static void print_csv(const Command* self, StringCoefs coefs) {
  const double rate_hz = self->target.rate_hz;
  const double m = self->mass_kg;
  const uint32_t n = (uint32_t)self->n_masses;
  puts("mode,frequency_hz,tau_s,region,omega0,gamma,mass_kg,k,z,z0,k2,all_stable");
  for (uint32_t k = 1; k <= n; ++k) {
    const Pole pole = tuning_mode(coefs, n, k);
    const Tone tone = pole_tone(rate_hz, pole);
    printf("%lu,%.17g,%.17g,%s,", (unsigned long)k, tone.f0_hz, tone.tau_s,
           pole_region_text(pole_region(pole)));
    printf("%.17g,%.17g,%.17g,%.17g,%.17g,%.17g,%.17g,%d\n", rate_hz * sqrt(coefs.k1),
           rate_hz * coefs.z1, m, m * rate_hz * rate_hz * coefs.k1, m * rate_hz * coefs.z1,
           m * rate_hz * coefs.z0, m * rate_hz * rate_hz * coefs.k2, is_stable(self, coefs));
  }
}

static int tune_string(const Command* self) {
  StringCoefs coefs;
  if (!is_below_half(self, self->target.rate_hz)) {
    return ARGS_USAGE;
  }
  const Status status = tuning_solve(&self->target, (uint32_t)self->n_masses, &coefs);
  if (status) {
    return args_fail(&self->args, ARGS_FAILURE, "could not tune: %s", status_text(status));
  }
  (self->is_csv ? print_csv : print_table)(self, coefs);
  return is_stable(self, coefs) ? ARGS_OK : ARGS_UNSTABLE;
}

static int print_retuning(const Command* self, Retuning retuning) {
  printf(self->is_csv ? "stiffness_factor,damping_factor\n%.17g,%.17g\n"
                      : "stiffness_factor %.17g\ndamping_factor %.17g\n",
         retuning.stiffness_factor, retuning.damping_factor);
  return ARGS_OK;
}

static int retune(const Command* self, const Scene* scene, double rate_hz) {
  Retuning retuning;
  if (!is_below_half(self, rate_hz)) {
    return ARGS_USAGE;
  }
  const Status status =
      retune_solve(scene->network, rate_hz, self->target.tone, (uint32_t)self->mode, &retuning);
  if (status) {
    const int code = status == STATUS_UNSTABLE ? ARGS_UNSTABLE : ARGS_FAILURE;
    char which[40] = "the lowest mode";
    if (self->mode) {
      (void)snprintf(which, sizeof(which), "mode %ld", self->mode);
    }
    return args_fail(&self->args, code, "%s: could not tune %s: %s", self->in, which,
                     status_text(status));
  }
  return print_retuning(self, retuning);
}

static int tune_scene(const Command* self) {
  char error[SCENE_ERROR_SIZE] = "";
  Scene* const scene = scene_new(self->in, SCENE_FOR_MODES, error, sizeof(error));
  if (!scene) {
    return args_fail(&self->args, ARGS_FAILURE, "%s", error);
  }
  const double rate_hz = self->target.rate_hz;
  const int code = retune(self, scene, rate_hz > 0.0 ? rate_hz : scene->rate_hz);
  scene_free(scene);
  return code;
}

int tune_main(int argc, char** argv) {
  Command self = {.args = {.command = "hooke tune", .argc = argc, .argv = argv, .options = options},
                  .target = {.loss = 1.0},
                  .mass_kg = 1.0};
  if (!parse(&self)) {
    return ARGS_USAGE;
  }
  return self.in ? tune_scene(&self) : tune_string(&self);
}
