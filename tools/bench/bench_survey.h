/**
   `hooke bench survey`: error against run time of all ways to make a string.

   Thread: one at a time; allocates.
*/
#ifndef HOOKE_TOOLS_BENCH_BENCH_SURVEY_H
#define HOOKE_TOOLS_BENCH_BENCH_SURVEY_H

#include "tools/bench/bench_choice.h"
#include "tools/bench/bench_way.h"

/** The strings: 55, 110, 440 and 1760 Hz, with B = 0 and 1e-4, at five rates; τ is 2 s, and 1 % of
 * the damping sits between the masses. */
enum { BENCH_N_PITCHES = 4, BENCH_N_STIFFNESSES = 2, BENCH_N_RATES = 5 };
TuningTarget bench_survey_string(unsigned pitch, unsigned stiffness, unsigned rate);

/**
   Measure and print: for machines all strings, each with 4 masses up to as many as are stable, and
   for people those of 55 Hz with 80 masses at 48 kHz.  Where choice->n_masses is given, it is the
   number of masses.

   @return false when memory is out, or no string can have so many masses
*/
bool bench_survey(const BenchChoice* choice);

#endif
