#include "tools/commands/settings.h"

#include "tools/commands/near_miss.h"

#include <ctype.h>
#include <float.h>
#include <math.h>
#include <stdint.h>
#include <stdio.h>
#include <string.h>
#include <strings.h>

enum { HINT_SIZE = 128, SYMBOL_SIZE = 128, NAMES_SIZE = 512 };

static const struct {
  const char* name;
  float value;
} SWITCH[] = {{"off", 0.0F},  {"on", 1.0F}, {"false", 0.0F},
              {"true", 1.0F}, {"no", 0.0F}, {"yes", 1.0F}};

static bool refuse_symbol(const Args* args, const Host* host, const char* symbol) {
  NearMiss miss = near_miss_of(symbol);
  char hint[HINT_SIZE];
  HostRange range;
  for (uint32_t i = 0; host_symbol(host, i); ++i) {
    if (host_range(host, host_symbol(host, i), &range)) {
      near_miss_try(&miss, host_symbol(host, i));
    }
  }
  return args_fail(
      args, false,
      "found '%s', expected the symbol of a control input, which --list-controls names%s", symbol,
      near_miss_hint(&miss, hint, sizeof(hint)));
}

static bool is_named(
    const Host* host, const char* symbol, const HostRange* range, const char* text, float* value) {
  uint32_t n_choices = 0;
  const HostChoice* const choices = host_choices(host, symbol, &n_choices);
  for (uint32_t i = 0; i < n_choices; ++i) {
    if (!strcasecmp(choices[i].label, text)) {
      *value = choices[i].value;
      return true;
    }
  }
  for (size_t i = 0; range->is_toggle && i < sizeof(SWITCH) / sizeof(SWITCH[0]); ++i) {
    if (!strcasecmp(SWITCH[i].name, text)) {
      *value = SWITCH[i].value;
      return true;
    }
  }
  return false;
}

static void add_name(char names[NAMES_SIZE], double value, const char* label) {
  const size_t length = strlen(names);
  (void)snprintf(names + length, NAMES_SIZE - length, "%s%g %s", length ? ", " : "", value, label);
}

/* The names of its values, where they are all that there is. */
static const char*
names_of(const Host* host, const char* symbol, const HostRange* range, char names[NAMES_SIZE]) {
  uint32_t n_choices = 0;
  const HostChoice* const choices = host_choices(host, symbol, &n_choices);
  *names = '\0';
  for (uint32_t i = 0; range->is_choice && i < n_choices; ++i) {
    add_name(names, (double)choices[i].value, choices[i].label);
  }
  if (range->is_toggle) {
    add_name(names, 0.0, "off");
    add_name(names, 1.0, "on");
  }
  return names;
}

/* The bound is a float, up to 6e-8 of it away from the decimal meant: allow for that, and take the
 * bound. */
static bool set_number(
    const Args* args, Host* host, const char* symbol, const HostRange* range, const char* text) {
  const double min = isnan(range->min) ? -(double)FLT_MAX : (double)range->min;
  const double max = isnan(range->max) ? (double)FLT_MAX : (double)range->max;
  if (range->is_integer) {
    long whole = 0;
    const long from = (long)fmax(min, INT32_MIN);
    const long to = (long)fmin(max, INT32_MAX);
    return args_whole(args, symbol, text, from, to, &whole) && host_set(host, symbol, (float)whole);
  }
  double value = 0.0;
  const double hair = 1e-7;
  return args_number(args, symbol, text, min - hair * fabs(min), max + hair * fabs(max), &value) &&
         host_set(host, symbol, (float)fmin(fmax(value, min), max));
}

bool settings_set(const Args* args, Host* host, const char* symbol, const char* text) {
  HostRange range = {0};
  char names[NAMES_SIZE];
  float value = 0.0F;
  if (!host_range(host, symbol, &range)) {
    return refuse_symbol(args, host, symbol);
  }
  if (is_named(host, symbol, &range, text, &value)) {
    return host_set(host, symbol, value);
  }
  if (*names_of(host, symbol, &range, names) && isalpha((unsigned char)*text)) {
    return args_fail(args, false, "%s: found '%s', expected one of %s", symbol, text, names);
  }
  return set_number(args, host, symbol, &range, text);
}

bool settings_apply(const Args* args, Host* host, const char* setting) {
  char symbol[SYMBOL_SIZE];
  const char* const equals = strchr(setting, '=');
  const size_t length = equals ? (size_t)(equals - setting) : 0;
  if (length == 0 || length >= sizeof(symbol)) {
    return args_fail(args, false, "found '%s', expected SYMBOL=VALUE", setting);
  }
  memcpy(symbol, setting, length);
  symbol[length] = '\0';
  return settings_set(args, host, symbol, equals + 1);
}

void settings_list(Host* host) {
  printf("%-14s %10s %10s %10s  %s\n", "symbol", "least", "most", "default", "unit, or names");
  for (uint32_t i = 0; host_symbol(host, i); ++i) {
    const char* const symbol = host_symbol(host, i);
    HostRange range;
    char names[NAMES_SIZE];
    if (host_range(host, symbol, &range)) {
      (void)names_of(host, symbol, &range, names);
      printf("%-14s %10.7g %10.7g %10.7g  %s\n", symbol, (double)range.min, (double)range.max,
             (double)range.initial, *names ? names : host_unit(host, symbol));
    }
  }
}
