#include "core/analysis/modes.h"
#include "tools/commands/args.h"
#include "tools/commands/commands.h"
#include "tools/formats/scene.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

const char modes_help[] =
    "usage: hooke modes [OPTION]... IN.scene\n"
    "\n"
    "Write the modes of a scene's masses, springs and dampers, and whether they are stable at the\n"
    "scene's rate. What is done to them and where they are heard does not matter here.\n"
    "\n"
    "  --lowest M          the lowest M modes only\n"
    "  --rate HZ           another rate than the scene's\n"
    "  --csv               a line for each mode, under a line of names\n"
    "  --json              one object, with a list of modes\n"
    "\n"
    "Of each mode: its eigenvalue, before it is sampled; its motion (vibrates; creeps, with poles\n"
    "that are real and above 0; flips, real and below 0; grows; and of what hangs on no ground, "
    "at\n"
    "0 Hz: drifts, at a speed that stays; stops, where dampers make it); the frequency that is\n"
    "heard, how far sampling has moved it, the time in which it dies to 1/e, of what stops the\n"
    "speed, the larger radius of its poles, and whether it is stable. Then the verdict, that of "
    "the\n"
    "paper's rule where it differs, and the largest stable step.\n"
    "\n"
    "In CSV, two real eigenvalues are in eigenvalue_re and eigenvalue2_re, a number that does not\n"
    "exist is empty, and inf is for ever. In JSON both are null.\n"
    "\n"
    "Returns 0 if the scene is stable, 3 if it is not, and 1 or 2 if it could not be told.\n";

enum { LOWEST = ARGS_OPTION, RATE, CSV, JSON };

static const struct option options[] = {{"lowest", required_argument, NULL, LOWEST},
                                        {"rate", required_argument, NULL, RATE},
                                        {"csv", no_argument, NULL, CSV},
                                        {"json", no_argument, NULL, JSON},
                                        {0}};

typedef struct {
  Args args;
  const char* in;
  long n_lowest;  /* 0: all */
  double rate_hz; /* 0: the scene's */
  bool is_csv;
  bool is_json;
} Command;

static bool take_option(Command* self, int index) {
  const Args* const args = &self->args;
  switch (index) {
  case LOWEST:
    return args_whole(args, "--lowest", args->value, 1, 10000000, &self->n_lowest);
  case RATE:
    return args_number(args, "--rate", args->value, 1e-9, 1e9, &self->rate_hz);
  case CSV:
    return self->is_csv = true;
  case JSON:
    return self->is_json = true;
  case ARGS_OPERAND:
    if (self->in) {
      return args_fail(args, false, "found '%s' too, expected one scene", args->value);
    }
    self->in = args->value;
    return true;
  default:
    return false;
  }
}

static bool parse(Command* self) {
  for (int i = args_next(&self->args); i != ARGS_END; i = args_next(&self->args)) {
    if (!take_option(self, i)) {
      return false;
    }
  }
  if (!self->in) {
    args_fail(&self->args, 0, "found no scene, expected IN.scene; try hooke help modes");
    return false;
  }
  if (self->is_csv && self->is_json) {
    return args_fail(&self->args, false, "found --csv and --json, expected one of them");
  }
  return true;
}

static bool is_stable(const Mode* mode) {
  return mode->region != POLE_UNSTABLE;
}

/* The time it is heard for [s]: rounding may make an undamped mode seem to grow. */
static double heard_tau(const Mode* mode) {
  return is_stable(mode) && mode->tone.tau_s < 0.0 ? HUGE_VAL : mode->tone.tau_s;
}

/* The motion of a mode; what hangs on no ground drifts on, or is stopped by its dampers. */
static const char* motion(const Mode* mode) {
  if (mode->is_free && is_stable(mode)) {
    return mode->analog[1] == 0.0 ? "drifts" : "stops";
  }
  return pole_region_text(mode->region);
}

static bool is_pair(const Mode* mode) {
  return cimag(mode->analog[0]) != 0.0;
}

/* The least rate that is stable [Hz]. */
static double lowest_rate(const Modes* modes) {
  return 1.0 / modes->largest_step_s;
}

/* A number, or a word where there is none, at the right of `width` columns. */
static void print_column(int width, int n_decimals, double value) {
  if (isnan(value)) {
    printf(" %*s", width, "-");
  } else if (isinf(value)) {
    printf(" %*s", width, "for ever");
  } else if (fabs(value) >= 1e9 || (value != 0.0 && fabs(value) < 1e-4)) {
    printf(" %*.6e", width, value);
  } else {
    printf(" %*.*f", width, n_decimals, value);
  }
}

static void print_mode(uint32_t number, const Mode* mode) {
  char eigenvalue[64];
  const double complex* const s = mode->analog;
  if (is_pair(mode)) {
    /* Nought has no sign. */
    (void)snprintf(eigenvalue, sizeof(eigenvalue), "%.7g ± %.10gj", 0.0 + creal(s[0]), cimag(s[0]));
  } else {
    (void)snprintf(eigenvalue, sizeof(eigenvalue), "%.9g, %.9g", creal(s[0]), creal(s[1]));
  }
  /* The sign ± is of two bytes and one column. */
  printf("%5lu  %-*s  %-8s", (unsigned long)number, is_pair(mode) ? 33 : 32, eigenvalue,
         motion(mode));
  print_column(14, 5, mode->tone.f0_hz);
  print_column(12, 4, mode->warp_cents);
  print_column(14, 7, heard_tau(mode));
  print_column(12, 9, mode->radius);
  printf("  %s\n", is_stable(mode) ? "stable" : "unstable");
}

static void print_verdict(const Modes* modes) {
  if (isinf(modes->largest_step_s)) {
    printf("stable at %.12g Hz, as at any other rate\n", modes->rate_hz);
    return;
  }
  printf("%s at %.12g Hz; the largest stable step is %.9g s: %.9g Hz or more\n",
         modes->is_stable ? "stable" : "unstable", modes->rate_hz, modes->largest_step_s,
         lowest_rate(modes));
  if (modes->is_complete && modes->is_stable != modes->paper_is_stable) {
    printf("the paper's rule, each eigenvalue by itself, says %s: the largest radius would be "
           "%.9g, and is %.9g\n",
           modes->paper_is_stable ? "stable" : "unstable", modes->paper_radius, modes->radius);
  }
}

static void print_table(const Modes* modes) {
  printf(" mode  %-32s  %-8s %14s %12s %14s %12s\n", "eigenvalue [1/s]", "region", "frequency [Hz]",
         "warp [cents]", "tau [s]", "radius");
  for (uint32_t k = 0; k < modes->n_modes; ++k) {
    print_mode(k + 1, &modes->mode[k]);
  }
  print_verdict(modes);
}

static void print_cell(double value) {
  if (isnan(value)) {
    putchar(',');
  } else {
    printf("%.17g,", value);
  }
}

static void print_csv(const Modes* modes) {
  puts("mode,eigenvalue_re,eigenvalue_im,eigenvalue2_re,eigenvalue2_im,region,frequency_hz,"
       "warp_cents,tau_s,radius,paper_radius,stable,all_stable,paper_all_stable,largest_step_s");
  for (uint32_t k = 0; k < modes->n_modes; ++k) {
    const Mode* const mode = &modes->mode[k];
    printf("%lu,%.17g,%.17g,%.17g,%.17g,%s,", (unsigned long)k + 1, creal(mode->analog[0]),
           cimag(mode->analog[0]), creal(mode->analog[1]), cimag(mode->analog[1]), motion(mode));
    print_cell(mode->tone.f0_hz);
    print_cell(mode->warp_cents);
    print_cell(heard_tau(mode));
    print_cell(mode->radius);
    print_cell(mode->paper_radius);
    printf("%d,%d,%d,%.17g\n", is_stable(mode), modes->is_stable, modes->paper_is_stable,
           modes->largest_step_s);
  }
}

/* JSON has neither infinity nor NaN. */
static void print_member(const char* name, double value) {
  if (isfinite(value)) {
    printf(", \"%s\": %.17g", name, value);
  } else {
    printf(", \"%s\": null", name);
  }
}

static void print_pair(const char* name, const double complex pair[2]) {
  printf(", \"%s\": [[%.17g, %.17g], [%.17g, %.17g]]", name, creal(pair[0]), cimag(pair[0]),
         creal(pair[1]), cimag(pair[1]));
}

static const char* truth(bool is_true) {
  return is_true ? "true" : "false";
}

static void print_json_mode(uint32_t number, const Mode* mode) {
  printf("{\"mode\": %lu, \"region\": \"%s\"", (unsigned long)number, motion(mode));
  print_pair("eigenvalues", mode->analog);
  print_pair("poles", mode->pole);
  print_member("frequency_hz", mode->tone.f0_hz);
  print_member("warp_cents", mode->warp_cents);
  print_member("tau_s", heard_tau(mode));
  print_member("radius", mode->radius);
  print_member("paper_radius", mode->paper_radius);
  printf(", \"stable\": %s}", truth(is_stable(mode)));
}

static void print_json(const Modes* modes) {
  printf("{\"stable\": %s, \"paper_stable\": %s, \"complete\": %s, \"proportional\": %s",
         truth(modes->is_stable), truth(modes->paper_is_stable), truth(modes->is_complete),
         truth(modes->is_proportional));
  print_member("rate_hz", modes->rate_hz);
  print_member("largest_step_s", modes->largest_step_s);
  print_member("lowest_rate_hz", lowest_rate(modes));
  print_member("radius", modes->radius);
  print_member("paper_radius", modes->paper_radius);
  printf(", \"modes\": [");
  for (uint32_t k = 0; k < modes->n_modes; ++k) {
    fputs(k ? ",\n  " : "\n  ", stdout);
    print_json_mode(k + 1, &modes->mode[k]);
  }
  puts("\n]}");
}

static int print(const Command* self, const Modes* modes) {
  (self->is_json ? print_json : self->is_csv ? print_csv : print_table)(modes);
  return modes->is_stable ? ARGS_OK : ARGS_UNSTABLE;
}

static int solve(const Command* self, const Scene* scene) {
  Modes* modes = NULL;
  const double rate_hz = self->rate_hz > 0.0 ? self->rate_hz : scene->rate_hz;
  Status status = modes_solve(scene->network, rate_hz, (uint32_t)self->n_lowest, &modes);
  status = !status && !(modes->largest_step_s > 0.0) ? STATUS_ILL_SCALED : status;
  if (status) {
    modes_free(modes);
    return args_fail(&self->args, ARGS_FAILURE, "%s: could not find the modes: %s", self->in,
                     status_text(status));
  }
  const int code = print(self, modes);
  modes_free(modes);
  return code;
}

int modes_main(int argc, char** argv) {
  char error[SCENE_ERROR_SIZE] = "";
  Command self = {
      .args = {.command = "hooke modes", .argc = argc, .argv = argv, .options = options}};
  if (!parse(&self)) {
    return ARGS_USAGE;
  }
  Scene* const scene = scene_new(self.in, SCENE_FOR_MODES, error, sizeof(error));
  if (!scene) {
    return args_fail(&self.args, ARGS_FAILURE, "%s", error);
  }
  const int code = solve(&self, scene);
  scene_free(scene);
  return code;
}
