/**
   What may stand where in a statement of a scene: the grammar, one field a word.

   Part of tools/formats/scene.
*/
#ifndef HOOKE_TOOLS_FORMATS_SCENE_FIELDS_H
#define HOOKE_TOOLS_FORMATS_SCENE_FIELDS_H

#include "tools/formats/scene_names.h"
#include "tools/formats/scene_text.h"

#include <stdbool.h>
#include <stdint.h>

/** One word; FIELD_END is the end of the line. */
typedef enum {
  FIELD_END,
  FIELD_NEW_NAME,
  FIELD_POINT, ///< Declared above
  FIELD_MASS,  ///< A point that is not grounded
  FIELD_COUNT,
  FIELD_HZ, ///< From here on numbers
  FIELD_KG,
  FIELD_STIFFNESS,
  FIELD_DAMPING,
  FIELD_TIME,
  FIELD_DURATION,
  FIELD_LENGTH,
  FIELD_VELOCITY,
  FIELD_FORCE,
  FIELD_GAIN,
  FIELD_WORD_MASS, ///< From here on the word itself
  FIELD_WORD_STIFFNESS,
  FIELD_WORD_DAMPING,
  FIELD_WORD_FOR
} Field;

/** The most fields of a statement, with the end. */
enum { FIELDS_MAX = 9 };

/** What was found in a line. */
typedef struct {
  char* name;        ///< Of FIELD_NEW_NAME
  uint32_t count;    ///< Of FIELD_COUNT
  uint32_t point[2]; ///< Of FIELD_POINT and FIELD_MASS, in their order
  double number[3];  ///< Of the numbers, in their order
  uint32_t n_points;
  const char* point_word; ///< For the last point
  uint32_t n_numbers;
} Fields;

/**
   Read words from the line, a field each.

   @param fields    Ended by FIELD_END, which asks for nothing
   @param[out] out  What was found is added to it
   @return false after a message
*/
bool fields_read(SceneText* text, const SceneNames* names, const Field* fields, Fields* out);

/** @return Whether the line has no more words; if not, after a message */
bool fields_end(SceneText* text);

#endif
