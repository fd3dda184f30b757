/**
   What a survey of error against run time says, in sentences.

   Thread: any; allocates nothing.
*/
#ifndef HOOKE_TOOLS_REPORT_TRADE_WORDS_H
#define HOOKE_TOOLS_REPORT_TRADE_WORDS_H

#include "tools/bench/bench_survey.h"
#include "tools/report/trade_check.h"
#include "tools/report/trade_picture.h"

/** The longest text, and its zero. */
enum { TRADE_TEXT_SIZE = 2048 };

/** A default that the plugin could have. */
typedef struct {
  Partials partials;
  uint32_t masses;
} TradeSetting;

/** The chain in whole numbers of a setting, of a string at 48 kHz; NULL if it was not surveyed. */
const TradePoint* trade_words_point(const TradeSurvey* survey,
                                    TradeSetting setting,
                                    unsigned pitch,
                                    unsigned stiffness);

/** The largest error of partials of the strings of 55, 110 and 440 Hz, B = 0 and 1e-4, and the sum
 * of their shares. */
double trade_words_worst(const TradeSurvey* survey, TradeSetting setting, double* share);

/** The setting of the least sum of shares whose error of partials is nowhere over half a cent;
 * and the one of most masses that is as good and takes no more than the default. */
TradeSetting trade_words_best(const TradeSurvey* survey);
TradeSetting trade_words_as_dear(const TradeSurvey* survey);

/** "N masses give x cents at the tenth partial for y % of a core", at 55 Hz. */
void trade_words_sentence(const TradeSurvey* survey,
                          TradeSetting setting,
                          char text[TRADE_TEXT_SIZE]);

/** What was compared and how. */
void trade_words_method(const TradeSurvey* survey, char text[TRADE_TEXT_SIZE]);

/** How far what is played is from what is computed. */
void trade_words_check(const TradeCheck* check, char text[TRADE_TEXT_SIZE]);

/** Whether the default is on the frontier of a picture, and if not, what is before it. */
void trade_words_default(const TradeSurvey* survey,
                         const TradePicture* picture,
                         char text[TRADE_TEXT_SIZE]);

/** Which default the errors of the partials speak for. */
void trade_words_advice(const TradeSurvey* survey, char text[TRADE_TEXT_SIZE]);

#endif
