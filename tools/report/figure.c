#include "tools/report/figure.h"

#include "tools/report/figure_groups.h"

#include <assert.h>
#include <stddef.h>

typedef struct {
  const Figure* first;
  unsigned n;
} Group;

#define GROUP(figures)                                                                             \
  { figures, sizeof(figures) / sizeof((figures)[0]) }

static const Group groups[] = {GROUP(figure_euler), GROUP(figure_regions), GROUP(figure_warping),
                               GROUP(figure_lines), GROUP(figure_sounds),  GROUP(figure_margin)};

#undef GROUP

const Figure* figure_at(unsigned index) {
  const Group* group = groups;
  while (index >= group->n) {
    index -= group->n;
    ++group;
    assert(group < groups + sizeof(groups) / sizeof(groups[0]));
  }
  return group->first + index;
}

void figure_block(FILE* data, const char* name) {
  (void)fprintf(data, "\n\n# %s\n", name);
}
