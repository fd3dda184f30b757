/** Scales and maps for tests: from tests/scales, from text, and from memory that ends where they
 * do. */
#ifndef HOOKE_TESTS_SUPPORT_SCALA_H
#define HOOKE_TESTS_SUPPORT_SCALA_H

#include "core/scale/scale.h"

/** scale_read() or scale_map_read(). */
typedef Status (*ScalaRead)(const char* text, size_t n_bytes, void* out, ScaleError* error);

Status scala_read_scale(const char* text, size_t n_bytes, void* scale, ScaleError* error);
Status scala_read_map(const char* text, size_t n_bytes, void* map, ScaleError* error);

/** Read a copy at the end of its memory, where a sanitizer sees each byte too many. */
Status
scala_read_copy(ScalaRead read, const char* text, size_t n_bytes, void* out, ScaleError* error);

/** Read what must be right. */
void scala_scale(const char* text, Scale* scale);
void scala_map(const char* text, ScaleMap* map);

/** The same of a file in tests/scales. */
void scala_scale_file(const char* file, Scale* scale);
void scala_map_file(const char* file, ScaleMap* map);

#endif
