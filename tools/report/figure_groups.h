/** The groups that the list of figures (tools/report/figure.h) is made of; each file draws its own.
 */
#ifndef HOOKE_TOOLS_REPORT_FIGURE_GROUPS_H
#define HOOKE_TOOLS_REPORT_FIGURE_GROUPS_H

#include "tools/report/figure.h"

extern const Figure figure_euler[3];   /**< 3 to 5: three methods of Euler */
extern const Figure figure_regions[3]; /**< 8 to 10: which motion, and how long it is stable */
extern const Figure figure_warping[5]; /**< 11 to 15: pitch and decay against the oscillator's */
extern const Figure figure_lines[2];   /**< 16, 17: equal pitch, equal decay */
extern const Figure figure_sounds[3];  /**< 18, 19, 21: what is heard */
extern const Figure figure_margin[2];  /**< 31, 32: how far the instrument is from its limit */

/** Head a block of a data file, and part it from the last. */
void figure_block(FILE* data, const char* name);

#endif
