#include "tools/bench/bench_survey.h"

#include <math.h>

double trade_floor(TradeError error) {
  return error == TRADE_NOISE ? -120.0 : 1e-2;
}

bool trade_is_same(TradeString a, TradeString b) {
  return a.f0_hz == b.f0_hz && a.tau_s == b.tau_s && a.inharmonicity == b.inharmonicity &&
         a.loss == b.loss && a.rate_hz == b.rate_hz;
}

double trade_level(const TradePoint* point, TradeError error) {
  return isnan(point->error[error]) ? HUGE_VAL : fmax(point->error[error], trade_floor(error));
}

static bool is_in(const TradePoint* point, TradeCompany company) {
  return company == TRADE_AMONG_ALL || point->method.kind != BENCH_BANK;
}

static bool is_fit(const TradePoint* point, TradeError error, TradeCompany company) {
  return point->is_stable && point->share > 0.0 && is_in(point, company) &&
         trade_level(point, error) < HUGE_VAL;
}

static double steps(double value) {
  return floor(log(value) / log(TRADE_GRAIN));
}

static double level_steps(const TradePoint* point, TradeError error) {
  const double level = trade_level(point, error);
  return error == TRADE_NOISE ? floor(2.0 * level) : steps(level);
}

static bool dominates(const TradePoint* a, const TradePoint* b, TradeError error) {
  const double cheaper = steps(b->share) - steps(a->share);
  const double truer = level_steps(b, error) - level_steps(a, error);
  return cheaper >= 0.0 && truer >= 0.0 && (cheaper > 0.0 || truer > 0.0 || a < b);
}

static bool
is_front(const TradePoint* points, size_t n, size_t i, TradeError error, TradeCompany company) {
  bool is_best = is_fit(&points[i], error, company);
  for (size_t j = 0; is_best && j < n; ++j) {
    is_best =
        j == i || !is_fit(&points[j], error, company) || !dominates(&points[j], &points[i], error);
  }
  return is_best;
}

/* Points of the same string follow each other. */
void trade_find_fronts(TradePoint* points, size_t n) {
  for (size_t first = 0, end = 0; first < n; first = end) {
    while (end < n && trade_is_same(points[first].string, points[end].string)) {
      ++end;
    }
    for (size_t i = 0; i < end - first; ++i) {
      for (int company = 0; company < TRADE_N_COMPANIES; ++company) {
        for (int error = 0; error < TRADE_N_ERRORS; ++error) {
          points[first + i].is_front[company][error] =
              is_front(points + first, end - first, i, (TradeError)error, (TradeCompany)company);
        }
      }
    }
  }
}

const TradePoint* trade_cheapest(const TradeSurvey* survey,
                                 const TradePoint* point,
                                 TradeError error,
                                 TradeCompany company) {
  const TradePoint* best = point;
  for (size_t i = 0; i < survey->n; ++i) {
    const TradePoint* const other = &survey->points[i];
    if (trade_is_same(other->string, point->string) && other->is_front[company][error] &&
        trade_level(other, error) <= trade_level(point, error) && other->share < best->share) {
      best = other;
    }
  }
  return best;
}

const TradePoint*
trade_find(const TradeSurvey* survey, BenchWay method, TradeString string, uint32_t n_masses) {
  for (size_t i = 0; i < survey->n; ++i) {
    const TradePoint* const point = &survey->points[i];
    if (trade_is_same(point->string, string) && point->n_masses == n_masses &&
        point->method.kind == method.kind && point->method.scheme == method.scheme &&
        point->method.partials == method.partials && point->method.numbers == method.numbers &&
        point->method.is_corrected == method.is_corrected) {
      return point;
    }
  }
  return NULL;
}
