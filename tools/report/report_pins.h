/**
   The numbers of [MQ09], each beside ours.

   Thread: any; allocates nothing.
*/
#ifndef HOOKE_TOOLS_REPORT_REPORT_PINS_H
#define HOOKE_TOOLS_REPORT_REPORT_PINS_H

/** One number. */
typedef struct {
  const char* where;    /**< Figures and tables that it belongs to */
  const char* quantity; /**< In words */
  const char* unit;     /**< "" if it has none */
  const char* paper;    /**< To the digits that are stated */
  double (*ours)(double argument);
  double argument;
  double rounding; /**< By how much the stated number itself is out, relative; 0: its last digit is
                        right */
} ReportPin;

/** @param[out] n_pins  How many there are @return The first of them */
const ReportPin* report_pins(unsigned* n_pins);

/** How many decimals are stated. */
int report_pin_decimals(const ReportPin* pin);

/** How far ours may be from the stated number: one unit of its last digit, or its rounding. */
double report_pin_precision(const ReportPin* pin);

/** Ours less the paper's. */
double report_pin_difference(const ReportPin* pin);

#endif
