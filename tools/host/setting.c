#include "tools/host/setting.h"

#include <float.h>
#include <math.h>
#include <string.h>

/* The bound is a float, up to 6e-8 of it away from the decimal meant: allow for that, and take the
 * bound. */
static bool
set_number(const Args* args, Host* host, const char* symbol, const char* text, HostRange range) {
  const double min = isnan(range.min) ? -(double)FLT_MAX : (double)range.min;
  const double max = isnan(range.max) ? (double)FLT_MAX : (double)range.max;
  double value = 0.0;
  long whole = 0;
  if (range.is_integer) {
    const long from = (long)fmax(min, INT32_MIN);
    const long to = (long)fmin(max, INT32_MAX);
    return args_whole(args, symbol, text, from, to, &whole) && host_set(host, symbol, (float)whole);
  }
  const double hair = 1e-7;
  return args_number(args, symbol, text, min - hair * fabs(min), max + hair * fabs(max), &value) &&
         host_set(host, symbol, (float)fmin(fmax(value, min), max));
}

bool setting_apply(const Args* args, Host* host, const char* setting) {
  char symbol[128];
  const char* const equals = strchr(setting, '=');
  const size_t length = equals ? (size_t)(equals - setting) : 0;
  if (length == 0 || length >= sizeof(symbol)) {
    args_fail(args, 0, "--set: found '%s', expected SYMBOL=VALUE", setting);
    return false;
  }
  memcpy(symbol, setting, length);
  symbol[length] = '\0';
  if (!host_range(host, symbol, &(HostRange){0})) {
    args_fail(args, 0, "--set: found '%s', expected the symbol of a control input", symbol);
    return false;
  }
  return setting_set(args, host, symbol, equals + 1);
}

bool setting_set(const Args* args, Host* host, const char* symbol, const char* text) {
  HostRange range = {0};
  if (!host_range(host, symbol, &range)) {
    args_fail(args, 0, "found '%s', expected the symbol of a control input", symbol);
    return false;
  }
  return set_number(args, host, symbol, text, range);
}
