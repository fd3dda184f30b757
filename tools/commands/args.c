#include "tools/commands/args.h"

#include "tools/commands/near_miss.h"
#include "tools/formats/escape.h"

#include <math.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { MESSAGE_SIZE = 8192, MAX_OPTION = 64 };

/* There is no such option, or there are two that begin so. */
static int refuse(const Args* args, const char* word) {
  char hint[MAX_OPTION];
  char name[MAX_OPTION];
  (void)snprintf(name, sizeof(name), "%.*s", (int)strcspn(word, "="), word);
  NearMiss miss = near_miss_of(name + strspn(name, "-"));
  for (const struct option* i = args->options; i->name; ++i) {
    near_miss_try(&miss, i->name);
  }
  if (miss.name) {
    (void)snprintf(hint, sizeof(hint), "; did you mean --%s?", miss.name);
  }
  return args_fail(args, ARGS_ERROR, "no option '%s'; try hooke help%s", word,
                   miss.name ? hint : "");
}

int args_next(Args* args) {
  const char* const word = args->argv[optind];
  const int found =
      args->is_over ? -1 : getopt_long(args->argc, args->argv, "-:", args->options, NULL);
  args->value = optarg;
  switch (found) {
  case -1: /* Behind "--" there are operands alone */
    args->is_over = true;
    args->value = optind < args->argc ? args->argv[optind++] : NULL;
    return args->value ? ARGS_OPERAND : ARGS_END;
  case 1:
    return ARGS_OPERAND;
  case ':':
    return args_fail(args, ARGS_ERROR, "%s needs a value", word);
  case '?':
    return optopt < ARGS_OPTION
               ? refuse(args, word)
               : args_fail(args, ARGS_ERROR, "%.*s takes no value", (int)strcspn(word, "="), word);
  default:
    return found;
  }
}

bool args_number(
    const Args* args, const char* what, const char* text, double min, double max, double* number) {
  return args_number_or(args, what, text, min, max, NULL, number);
}

bool args_number_or(const Args* args,
                    const char* what,
                    const char* text,
                    double min,
                    double max,
                    const char* word,
                    double* number) {
  char* end = NULL;
  const double value = strtod(text, &end);
  if (end == text || *end || !isfinite(value) || value < min || value > max) {
    return args_fail(args, false, "%s: found '%s', expected a number from %g to %g%s%s", what, text,
                     min, max, word ? ", or " : "", word ? word : "");
  }
  *number = value;
  return true;
}

bool args_whole(
    const Args* args, const char* what, const char* text, long min, long max, long* number) {
  char* end = NULL;
  const double value = strtod(text, &end);
  if (end == text || *end || !(value >= (double)min && value <= (double)max) ||
      value != floor(value)) {
    return args_fail(args, false, "%s: found '%s', expected a whole number from %ld to %ld", what,
                     text, min, max);
  }
  *number = (long)value;
  return true;
}

int args_fail(const Args* args, int code, const char* format, ...) {
  char message[MESSAGE_SIZE];
  va_list list;
  va_start(list, format);
  (void)vsnprintf(message, sizeof(message), format, list);
  va_end(list);
  escape_print(stderr, args->command);
  (void)fputs(": ", stderr);
  escape_print(stderr, message);
  (void)fputc('\n', stderr);
  return code;
}
