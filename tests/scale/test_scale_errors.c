#include "core/scale/scale.h"

#include "tests/support/scala.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

typedef struct {
  const char* text;
  unsigned line;
  const char* found;
  const char* expected; // Its beginning
} Refusal;

#define COUNT "the number of notes, from 0 to 8388608"
#define RATIO "a ratio of whole numbers from 1 to 1e30, or cents with a point"
#define CENTS "cents from -120000 to 120000"

static const Refusal bad_scales[] = {
    {"", 1, "the end of the text", "a line that describes the scale"},
    {"! nothing", 1, "the end of the text", "a line that describes the scale"},
    {"!\n!\r\n!\n", 3, "the end of the text", "a line that describes the scale"},
    {"name", 1, "the end of the text", COUNT},
    {"\n", 1, "the end of the text", COUNT},
    {"name\n\n \n!\n", 4, "the end of the text", COUNT},
    {"name\nmany\n", 2, "'many'", COUNT},
    {"name\n-1\n", 2, "'-1'", COUNT},
    {"name\n8388609\n", 2, "'8388609'", COUNT},
    {"name\n4294967297\n1.\n", 2, "'4294967297'", COUNT},
    {"name\n99999999999999999999999999999999999999999\n", 2,
     "'99999999999999999999999999999999999999999'", COUNT},
    {"name\n2.0\n1.\n2.\n", 2, "'2.0'", COUNT},
    {"name\n2/1\n1.\n2.\n", 2, "'2/1'", COUNT},
    {"name\n2,5\n1.\n2.\n", 2, "'2,5'", COUNT},
    {"12\n100.0\n200.0\n", 2, "'100.0'", COUNT},
    {"name\n2\n3/2\n", 3, "the end of the text", "pitch 2 of 2, such as 701.955 or 3/2"},
    {"name\n1", 2, "the end of the text", "pitch 1 of 1, such as 701.955 or 3/2"},
    {"name\n2\n\n! no\n3/2\nfifth", 6, "'fifth'", "pitch 2 of 2, such as 701.955 or 3/2"},
    {"name\n1\n.\n", 3, "'.'", "pitch 1 of 1, such as"},
    {"name\n1\n-\n", 3, "'-'", "pitch 1 of 1, such as"},
    {"name\n1\n- 5.\n", 3, "'- 5.'", "pitch 1 of 1, such as"},
    {"name\n1\n--5.\n", 3, "'--5.'", "pitch 1 of 1, such as"},
    {"name\n1\n/2\n", 3, "'/2'", "pitch 1 of 1, such as"},
    {"name\n1\nnan\n", 3, "'nan'", "pitch 1 of 1, such as"},
    {"name\n1\ninf\n", 3, "'inf'", "pitch 1 of 1, such as"},
    {"name\n1\n0\n", 3, "'0'", "pitch 1 of 1, " RATIO},
    {"name\n1\n-3\n", 3, "'-3'", "pitch 1 of 1, " RATIO},
    {"name\n1\n-3/2\n", 3, "'-3/2'", "pitch 1 of 1, " RATIO},
    {"name\n1\n3/-2\n", 3, "'3/-2'", "pitch 1 of 1, " RATIO},
    {"name\n1\n-3/-2\n", 3, "'-3/-2'", "pitch 1 of 1, " RATIO},
    {"name\n1\n0/2\n", 3, "'0/2'", "pitch 1 of 1, " RATIO},
    {"name\n1\n2/0\n", 3, "'2/0'", "pitch 1 of 1, " RATIO},
    {"name\n1\n2/\n", 3, "'2/'", "pitch 1 of 1, " RATIO},
    {"name\n1\n2/x\n", 3, "'2/x'", "pitch 1 of 1, " RATIO},
    {"name\n1\n2/1/1\n", 3, "'2/1/1'", "pitch 1 of 1, " RATIO},
    {"name\n1\n3/2.0\n", 3, "'3/2.0'", "pitch 1 of 1, " RATIO},
    {"name\n1\n701,955\n", 3, "'701,955'", "pitch 1 of 1, " RATIO},
    {"name\n1\n3:2\n", 3, "'3:2'", "pitch 1 of 1, " RATIO},
    {"name\n1\n7\\12\n", 3, "'7\\12'", "pitch 1 of 1, " RATIO},
    {"name\n1\n2^7\n", 3, "'2^7'", "pitch 1 of 1, " RATIO},
    {"name\n1\n1e3\n", 3, "'1e3'", "pitch 1 of 1, " RATIO},
    {"name\n1\n1E+3\n", 3, "'1E+3'", "pitch 1 of 1, " RATIO},
    {"name\n1\n1e-3\n", 3, "'1e-3'", "pitch 1 of 1, " RATIO},
    {"name\n1\n3\xe2\x81\x84"
     "2\n",
     3, "'3???2'", "pitch 1 of 1, " RATIO},
    {"name\n1\n3/2\xbd\n", 3, "'3/2?'", "pitch 1 of 1, " RATIO},
    {"name\n1\n2000000000000000000000000000000/1\n", 3, "'2000000000000000000000000000000/1'",
     "pitch 1 of 1, " RATIO},
    {"name\n1\n1/2000000000000000000000000000000\n", 3, "'1/2000000000000000000000000000000'",
     "pitch 1 of 1, " RATIO},
    {"name\n1\n700.0.1\n", 3, "'700.0.1'", "pitch 1 of 1, " CENTS},
    {"name\n1\n700.0/2\n", 3, "'700.0/2'", "pitch 1 of 1, " CENTS},
    {"name\n1\n7.0e2\n", 3, "'7.0e2'", "pitch 1 of 1, " CENTS},
    {"name\n1\n1.200,0\n", 3, "'1.200,0'", "pitch 1 of 1, " CENTS},
    {"name\n1\n120000.001\n", 3, "'120000.001'", "pitch 1 of 1, " CENTS},
    {"name\n1\n-120000.001\n", 3, "'-120000.001'", "pitch 1 of 1, " CENTS},
    {"name\r\n2\r\n3/2\r\n0/1 \t\r\n", 4, "'0/1'", "pitch 2 of 2, " RATIO},
    {"name\r2\r3/2\r0/1", 4, "'0/1'", "pitch 2 of 2, " RATIO},
    {"name\n1\nx\a\033[31m 1234567890123456789012345678901234567890\n", 3,
     "'x??[31m 1234567890123456789012345678901234567890'", "pitch 1 of 1, "},
    {"name\n1\nx23456789012345678901234567890123456789012345678\n", 3,
     "'x23456789012345678901234567890123456789012345678'", "pitch 1 of 1, "},
    {"name\n1\nx234567890123456789012345678901234567890123456789\n", 3,
     "'x23456789012345678901234567890123456789012345678...'", "pitch 1 of 1, "},
};

#define KEY ", from 0 to 127"
#define HZ "the reference frequency, from 0.001 to 1000000 Hz"
#define OCTAVE "the degree of the formal octave, from -1000000 to 1000000"
#define NO_DEGREE "an entry that is a degree and not an x"
#define ENTRY ", a degree from -1000000 to 1000000 or an x"

static const Refusal bad_maps[] = {
    {"", 1, "the end of the text", "the size of the map, from 0 to 1000000"},
    {"! size\n\n", 2, "the end of the text", "the size of the map, from 0 to 1000000"},
    {"twelve\n", 1, "'twelve'", "the size of the map, from 0 to 1000000"},
    {"-1\n", 1, "'-1'", "the size of the map, from 0 to 1000000"},
    {"1000001\n", 1, "'1000001'", "the size of the map, from 0 to 1000000"},
    {"12.0\n", 1, "'12.0'", "the size of the map, from 0 to 1000000"},
    {"x\n", 1, "'x'", "the size of the map, from 0 to 1000000"},
    {"0\n", 1, "the end of the text", "the first note to retune" KEY},
    {"0\n128\n", 2, "'128'", "the first note to retune" KEY},
    {"0\n0\n", 2, "the end of the text", "the last note to retune" KEY},
    {"0\n60\n59\n", 3, "'59'", "the last note to retune, from 60 to 127"},
    {"0\n0\n128\n", 3, "'128'", "the last note to retune" KEY},
    {"0\n0\n127\n", 3, "the end of the text", "the middle note" KEY},
    {"0\n0\n127\n-1\n", 4, "'-1'", "the middle note" KEY},
    {"0\n0\n127\n128\n", 4, "'128'", "the middle note" KEY},
    {"0\n0\n127\n60\n", 4, "the end of the text", "the reference note" KEY},
    {"0\n0\n127\n60\n440.0\n", 5, "'440.0'", "the reference note" KEY},
    {"0\n0\n127\n60\n128\n", 5, "'128'", "the reference note" KEY},
    {"0\n0\n127\n60\n69\n", 5, "the end of the text", HZ},
    {"0\n0\n127\n60\n69\nA\n", 6, "'A'", HZ},
    {"0\n0\n127\n60\n69\n440,0\n", 6, "'440,0'", HZ},
    {"0\n0\n127\n60\n69\n0\n", 6, "'0'", HZ},
    {"0\n0\n127\n60\n69\n-440\n", 6, "'-440'", HZ},
    {"0\n0\n127\n60\n69\n4.4e2\n", 6, "'4.4e2'", HZ},
    {"0\n0\n127\n60\n69\n1000000.1\n", 6, "'1000000.1'", HZ},
    {"0\n0\n127\n60\n69\n0.00099\n", 6, "'0.00099'", HZ},
    {"0\n0\n127\n60\n69\n440\n", 6, "the end of the text", OCTAVE},
    {"0\n0\n127\n60\n69\n440\nx\n", 7, "'x'", OCTAVE},
    {"0\n0\n127\n60\n69\n440\n1000001\n", 7, "'1000001'", OCTAVE},
    {"0\n0\n127\n60\n69\n440\n-1000001\n", 7, "'-1000001'", OCTAVE},
    {"2\n0\n127\n60\n69\n440\n2\n0\ny\n", 9, "'y'", "entry 2 of 2" ENTRY},
    {"2\n0\n127\n60\n69\n440\n2\n0\nx5\n", 9, "'x5'", "entry 2 of 2" ENTRY},
    {"2\n0\n127\n60\n69\n440\n2\n1.5\n1\n", 8, "'1.5'", "entry 1 of 2" ENTRY},
    {"2\n0\n127\n60\n69\n440\n2\n1000001\n1\n", 8, "'1000001'", "entry 1 of 2" ENTRY},
    {"2\n0\n127\n60\n69\n440\n2\n0\n-1000001\n", 9, "'-1000001'", "entry 2 of 2" ENTRY},
    {"2\n0\n127\n60\n69\n440\n2\nx\nx\n", 9, "the end of the text", NO_DEGREE},
    {"2\n0\n127\n60\n60\n440\n2\n", 7, "the end of the text", NO_DEGREE},
};

static void assert_refused(ScalaRead read, const Refusal* refusal, size_t n_bytes) {
  static union {
    Scale scale;
    ScaleMap map;
  } out, before;
  ScaleError error;
  memset(&out, 0x5a, sizeof(out));
  before = out;
  const Status status = scala_read_copy(read, refusal->text, n_bytes, &out, &error);
  if (status != STATUS_BAD_TEXT || error.line != refusal->line ||
      strcmp(error.found, refusal->found) != 0 ||
      strncmp(error.expected, refusal->expected, strlen(refusal->expected)) != 0) {
    fail_msg("'%s': status %d, '%u: found %s, expected %s'", refusal->text, (int)status, error.line,
             error.found, error.expected);
  }
  assert_memory_equal(&out, &before, sizeof(out));
}

static void what_is_wrong_with_a_scale_is_told_by_its_line(void** state) {
  (void)state;
  for (size_t i = 0; i < sizeof(bad_scales) / sizeof(*bad_scales); ++i) {
    assert_refused(scala_read_scale, &bad_scales[i], strlen(bad_scales[i].text));
  }
}

static void what_is_wrong_with_a_map_is_told_by_its_line(void** state) {
  (void)state;
  for (size_t i = 0; i < sizeof(bad_maps) / sizeof(*bad_maps); ++i) {
    assert_refused(scala_read_map, &bad_maps[i], strlen(bad_maps[i].text));
  }
}

static void a_nul_byte_is_told_by_its_line(void** state) {
  static const Refusal refusals[] = {
      {"\0", 1, "a NUL byte", "plain text"},
      {"\n1\n2/\0\n", 3, "a NUL byte", "plain text"},
      {"\n1\r\n! \0\n2/1", 3, "a NUL byte", "plain text"},
      {"\n1\n2/1\n\n\0", 5, "a NUL byte", "plain text"},
  };
  static const size_t sizes[] = {1, 7, 12, 9};
  (void)state;
  for (size_t i = 0; i < sizeof(refusals) / sizeof(*refusals); ++i) {
    assert_refused(scala_read_scale, &refusals[i], sizes[i]);
    assert_refused(scala_read_map, &refusals[i], sizes[i]);
  }
}

static void a_text_of_absurd_size_is_refused(void** state) {
  char* const text = malloc(SCALE_MAX_BYTES + 1);
  static Scale scale;
  ScaleError error;
  (void)state;
  assert_non_null(text);
  memset(text, '\n', SCALE_MAX_BYTES + 1);
  memcpy(text, "\n1\n2", 4);
  assert_int_equal(scale_read(text, SCALE_MAX_BYTES, &scale, &error), STATUS_OK);
  scale_free(&scale);
  const Refusal refusal = {text, 1, "16777217 bytes", "a text of at most 16777216 bytes"};
  assert_refused(scala_read_scale, &refusal, SCALE_MAX_BYTES + 1);
  free(text);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(what_is_wrong_with_a_scale_is_told_by_its_line),
      cmocka_unit_test(what_is_wrong_with_a_map_is_told_by_its_line),
      cmocka_unit_test(a_nul_byte_is_told_by_its_line),
      cmocka_unit_test(a_text_of_absurd_size_is_refused),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
