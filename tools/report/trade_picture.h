/**
   The pictures of error against run time, and the file with all points.

   Thread: any.
*/
#ifndef HOOKE_TOOLS_REPORT_TRADE_PICTURE_H
#define HOOKE_TOOLS_REPORT_TRADE_PICTURE_H

#include "tools/bench/bench_survey.h"
#include "tools/report/report_place.h"

#include <stdio.h>

/** A picture: one error, of the strings of one stiffness, at 48 kHz. */
typedef struct {
  const char* name; /**< Of its files, before ".svg" */
  TradeError error;
  unsigned stiffness; /**< As trade_string() has it */
  const char* title;
  const char* unit;
  const char* shows; /**< In sentences */
} TradePicture;

enum { TRADE_N_PICTURES = 5 };
const TradePicture* trade_picture(unsigned i);

/** Write what a picture is drawn from: blocks of rows as tools/report/figure.h has them. */
void trade_picture_data(FILE* data, const TradeSurvey* survey, const TradePicture* picture);

/** Write the gnuplot commands of a picture, which make NAME.svg from NAME.dat. */
void trade_picture_script(FILE* script, const TradePicture* picture);

/** Write all points as comma-separated values. */
void trade_picture_points(FILE* file, const TradeSurvey* survey);

#endif
