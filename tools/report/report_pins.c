#include "tools/report/report_pins.h"

#include "core/string/pole.h"
#include "tools/report/figure_plane.h"
#include "tools/report/figure_sound.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

static double string_omega0(double unused) {
  (void)unused;
  return sqrt(figure_sound_tuned().a) * FIGURE_STRING_RATE_HZ;
}

static double string_gamma(double unused) {
  (void)unused;
  return figure_sound_tuned().g * FIGURE_STRING_RATE_HZ;
}

static double partial_hz(double k) {
  return figure_sound_partial(figure_sound_tuned(), (uint32_t)k).f0_hz;
}

static double partial_tau_s(double k) {
  return figure_sound_partial(figure_sound_tuned(), (uint32_t)k).tau_s;
}

static double warped_hz(double k) {
  return figure_sound_partial(figure_sound_untuned(), (uint32_t)k).f0_hz;
}

static double ring_radius(double unused) {
  (void)unused;
  return pole_radius(figure_sound_ring());
}

static double ring_omega(double unused) {
  (void)unused;
  return pole_angle(figure_sound_ring()) * FIGURE_RING_RATE_HZ;
}

static double singular_mu(double unused) {
  (void)unused;
  return figure_plane_singular_mu();
}

/* ω0 and γ of the string are stated to more digits than doubles gave: 1 − exp(−2h/τ) is 3.3e-4 and
 * keeps twelve.  To 20 digits they are 5293.2393003368564032 and 7.4628577364144843712. */
static const ReportPin pins[] = {
    {"10, 12", "σh at μh = 0.1: ceases to vibrate", "", "-0.1954", pole_edge_vibrating, 0.1, 0.0},
    {"10, 12", "σh at μh = 0.1: begins to flip", "", "-0.7292", pole_edge_turning, 0.1, 0.0},
    {"10, 13", "σh at μh = 0.8: ceases to vibrate", "", "-0.4983", pole_edge_vibrating, 0.8, 0.0},
    {"10, 13", "σh at μh = 0.8: begins to flip", "", "-0.5362", pole_edge_turning, 0.8, 0.0},
    {"10, 14", "σh at μh = 0.87: passes π/2", "", "-0.4977", pole_edge_turning, 0.87, 0.0},
    {"10", "μh of the singular point, √3/2, at γh = 1", "", "0.866025404", singular_mu, 0.0, 0.0},
    {"18", "r of the first experiment", "", "0.97467943448090", ring_radius, 0.0, 0.0},
    {"18", "ω_d of the first experiment", "rad/s", "817.7132374981528", ring_omega, 0.0, 0.0},
    {"Table 1", "ω0 of a segment", "rad/s", "5293.239300336853", string_omega0, 0.0, 1e-15},
    {"Table 1", "γ of a segment", "1/s", "7.46285773640857", string_gamma, 0.0, 1e-12},
    {"21, Table 1", "partial 1", "Hz", "440.00000", partial_hz, 1.0, 0.0},
    {"21, Table 1", "partial 2", "Hz", "872.76842", partial_hz, 2.0, 0.0},
    {"21, Table 1", "partial 3", "Hz", "1287.45585", partial_hz, 3.0, 0.0},
    {"21, Table 1", "partial 4", "Hz", "1662.75731", partial_hz, 4.0, 0.0},
    {"21, Table 1", "partial 5", "Hz", "1951.81777", partial_hz, 5.0, 0.0},
    {"Table 1", "τ of partial 1", "s", "1.000000", partial_tau_s, 1.0, 0.0},
    {"Table 1", "τ of partial 2", "s", "0.2678272", partial_tau_s, 2.0, 0.0},
    {"Table 1", "τ of partial 3", "s", "0.1338302", partial_tau_s, 3.0, 0.0},
    {"Table 1", "τ of partial 4", "s", "0.0891645", partial_tau_s, 4.0, 0.0},
    {"Table 1", "τ of partial 5", "s", "0.0716419", partial_tau_s, 5.0, 0.0},
    {"21", "fundamental of the string as it comes", "Hz", "444.026", warped_hz, 1.0, 0.0},
};

const ReportPin* report_pins(unsigned* n_pins) {
  *n_pins = sizeof(pins) / sizeof(pins[0]);
  return pins;
}

int report_pin_decimals(const ReportPin* pin) {
  return (int)strlen(strchr(pin->paper, '.') + 1);
}

double report_pin_precision(const ReportPin* pin) {
  return fmax(pow(10.0, -report_pin_decimals(pin)), pin->rounding * fabs(strtod(pin->paper, NULL)));
}

double report_pin_difference(const ReportPin* pin) {
  return pin->ours(pin->argument) - strtod(pin->paper, NULL);
}
