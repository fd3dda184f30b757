#include "tools/commands/args.h"

#include <math.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* The length of the name if `word` is the option, alone or before "=", else 0. */
static size_t match(const char* word, const ArgsOption* option) {
  const size_t length = strlen(option->name);
  const bool is_same = !strncmp(word, option->name, length);
  return is_same && (!word[length] || word[length] == '=') ? length : 0;
}

static int take_option(Args* args, const char* word, int index) {
  const ArgsOption* const option = &args->options[index];
  const char* const rest = word + strlen(option->name);
  if (!option->takes_value) {
    return *rest ? args_fail(args, ARGS_ERROR, "%s takes no value", option->name) : index;
  }
  if (!*rest && !*args->words) {
    return args_fail(args, ARGS_ERROR, "%s needs a value", option->name);
  }
  args->value = *rest ? rest + 1 : *args->words++;
  return index;
}

int args_next(Args* args) {
  if (!args->has_no_more_options && *args->words && !strcmp(*args->words, "--")) {
    args->has_no_more_options = true;
    ++args->words;
  }
  const char* const word = *args->words;
  if (!word) {
    return ARGS_END;
  }
  ++args->words;
  args->value = word;
  if (args->has_no_more_options || word[0] != '-' || !word[1]) {
    return ARGS_OPERAND;
  }
  for (int i = 0; args->options[i].name; ++i) {
    if (match(word, &args->options[i])) {
      return take_option(args, word, i);
    }
  }
  return args_fail(args, ARGS_ERROR, "no option '%s'; try hooke help", word);
}

bool args_number(
    const Args* args, const char* what, const char* text, double min, double max, double* number) {
  char* end = NULL;
  const double value = strtod(text, &end);
  if (end == text || *end || !isfinite(value) || value < min || value > max) {
    args_fail(args, 0, "%s: found '%s', expected a number from %g to %g", what, text, min, max);
    return false;
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
    args_fail(args, 0, "%s: found '%s', expected a whole number from %ld to %ld", what, text, min,
              max);
    return false;
  }
  *number = (long)value;
  return true;
}

int args_fail(const Args* args, int code, const char* format, ...) {
  va_list list;
  va_start(list, format);
  (void)fprintf(stderr, "%s: ", args->command);
  (void)vfprintf(stderr, format, list);
  (void)fputc('\n', stderr);
  va_end(list);
  return code;
}
