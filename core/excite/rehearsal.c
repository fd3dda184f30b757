#include "core/excite/rehearsal.h"

#include "core/base/maths.h"
#include "core/excite/pluck.h"
#include "core/string/tuning.h"

#include <math.h>
#include <stdbool.h>

/* The most masses that are rehearsed with, steps that a period then has, periods that are watched,
 * and tries: after two, 999 of 1000 strikes are as loud as they are to be within 0.05 dB. */
enum { MOST_MASSES = REHEARSAL_PARTIALS, PERIOD_STEPS = 54, MOST_PERIODS = 2, N_TRIES = 2 };

/* A blow as hard as it was thrown loses so much of the felt's force. */
static const double LOSS = 0.3;

/* Its stiffness where it is pressed by its depth, by which a soft and a hard felt make the string's
 * whole mass swing, in terms of the fundamental's (ω h)². */
static const double SOFTEST = 0.6;
static const double HARDEST = 60.0;

/* The mass that this is for; heavier hammers have more felt. */
static const double USUAL_MASS = 0.1;

/* That depth, of the loudest strike's amplitude; three quarters of a softer strike's decibels. */
static const double LOUDEST = 0.25;
static const double DEPTH = 0.4;

/* A hammer is so wide that it comes no nearer to a wall; the few masses have one there. */
static const double LEAST_PLACE = 0.05;

/* How far a hammer must fly back, of the amplitude, for the string not to reach it. */
static const double GONE = 1.0;

/* A string of few masses. */
typedef struct {
  uint32_t n;
  double angle1;
  double k1;
  double place;
  double x[MOST_MASSES + 2]; /* Walls at both ends */
  double u[MOST_MASSES + 2];
} Model;

/* Its fundamental alone, in amplitude. */
typedef struct {
  double a, x, u;
} Mode;

static void step(Model* m) {
  for (uint32_t i = 1; i <= m->n; ++i) {
    m->u[i] -= m->k1 * (2.0 * m->x[i] - m->x[i - 1] - m->x[i + 1]);
  }
  for (uint32_t i = 1; i <= m->n; ++i) {
    m->x[i] += m->u[i];
  }
}

/* The amplitude of the fundamental that a hammer leaves. */
static double strike(Model* m, const HammerMake* make, double gone) {
  const double length = m->n + 1.0;
  const double mass = make->mass * length;
  const double at = m->place * length;
  const uint32_t i = (uint32_t)at;
  const double weight[] = {1.0 - (at - i), at - i};
  const double share =
      2.0 / length * (weight[0] * sin(PI * i / length) + weight[1] * sin(PI * (i + 1.0) / length));
  const double square = weight[0] * weight[0] + weight[1] * weight[1];
  const uint32_t n_steps = (uint32_t)(MOST_PERIODS * 2.0 * PI / m->angle1) + 1;
  Mode mode = {.a = 2.0 - 2.0 * cos(m->angle1)};
  Felt felt = make->felt;
  double position = 0.0;
  double velocity = make->velocity;
  double before = -velocity;
  double now = 0.0;
  felt.stiffness *= length;
  for (uint32_t j = 0; j <= m->n + 1; ++j) {
    m->x[j] = m->u[j] = 0.0;
  }
  for (uint32_t n = 0; n < n_steps && (velocity > 0.0 || position > -gone); ++n) {
    double after = 0.0;
    step(m);
    const double free = position + velocity - weight[0] * m->x[i] - weight[1] * m->x[i + 1];
    const double force = felt_press(&felt, before, free, square + 1.0 / mass, &after);
    before = now;
    now = after;
    velocity -= force / mass;
    position += velocity;
    for (uint32_t side = 0; side < 2; ++side) {
      m->u[i + side] += weight[side] * force;
      m->x[i + side] += weight[side] * force;
    }
    mode.u += share * force - mode.a * mode.x;
    mode.x += mode.u;
  }
  return sqrt((mode.x * mode.x - mode.x * mode.u + mode.u * mode.u / mode.a) /
              (1.0 - 0.25 * mode.a));
}

static double kept_off_walls(double place, uint32_t n_masses) {
  const double least = 1.0 / (n_masses + 1.0);
  return fmin(fmax(place, least), 1.0 - least);
}

static Model model_of(uint32_t n_masses, double place, double angle1) {
  Model m = {.n = n_masses < MOST_MASSES ? n_masses : MOST_MASSES};
  m.angle1 = fmax(angle1, 2.0 * PI / PERIOD_STEPS);
  m.k1 = fmin((2.0 - 2.0 * cos(m.angle1)) / tuning_lambda(m.n, 1), 4.0 / tuning_lambda(m.n, m.n));
  m.place = kept_off_walls(place, m.n);
  return m;
}

/* The hammer for a string whose fundamental has `angle`, but for its speed. */
static HammerMake make_of(Strike strike, double angle) {
  const double depth = DEPTH * LOUDEST * pow(strike.amplitude / LOUDEST, 0.75);
  const double swing =
      SOFTEST * pow(HARDEST / SOFTEST, strike.hardness) * sqrt(strike.mass / USUAL_MASS);
  return (HammerMake){
      .place = fmin(fmax(strike.place, LEAST_PLACE), 1.0 - LEAST_PLACE),
      .mass = strike.mass,
      .felt = {.stiffness = swing * angle * angle * pow(depth, 1.0 - FELT_EXPONENT),
               .exponent = FELT_EXPONENT},
  };
}

static void throw_at(HammerMake* make, double velocity) {
  make->velocity = velocity;
  make->felt.loss = 0.5 * LOSS / velocity;
}

/* The fundamental of a pluck, of that of one in the middle: the mean of its sine over the finger,
 * which a wall may cut.  Few masses are all that is under the finger. */
static double share_of_pluck(uint32_t n_masses, const Strike* wanted) {
  const double length = n_masses + 1.0;
  const Pluck pluck = {.hardness = wanted->hardness};
  const double width = pluck_width(&pluck, n_masses) / length;
  const double centre = kept_off_walls(wanted->place, n_masses);
  const bool is_few = n_masses <= MOST_MASSES;
  const double spacing = is_few ? 1.0 / length : 2.0 * width / MOST_MASSES;
  const double first = is_few ? spacing : centre - width + 0.5 * spacing;
  double sum = 0.0;
  double sines = 0.0;
  for (uint32_t i = 0; i < (is_few ? n_masses : MOST_MASSES); ++i) {
    const double at = first + i * spacing;
    const double distance = (at - centre) / width;
    const bool is_under = at > 0.0 && at < 1.0 && fabs(distance) < 1.0;
    const double weight = is_under ? 1.0 + cos(PI * distance) : 0.0;
    sum += weight;
    sines += weight * sin(PI * at);
  }
  return sines / sum;
}

/* Find the speed of a hammer for the model, which is left as the last try left it. */
static double rehearse(Model* m, uint32_t n_masses, const Strike* wanted) {
  HammerMake make = make_of(*wanted, m->angle1);
  const double goal = 4.0 / PI * wanted->amplitude * share_of_pluck(n_masses, wanted);
  double velocity = 0.5 * wanted->amplitude * m->angle1 / wanted->mass;
  for (int i = 0; i < N_TRIES; ++i) {
    throw_at(&make, velocity);
    velocity *= goal / strike(m, &make, GONE * wanted->amplitude);
  }
  return velocity;
}

HammerMake rehearsal_make(uint32_t n_masses, Strike wanted, double angle1) {
  Model m = model_of(n_masses, wanted.place, angle1);
  HammerMake make = make_of(wanted, angle1);
  throw_at(&make, rehearse(&m, n_masses, &wanted) * angle1 / m.angle1);
  return make;
}

/* The square of what mode k was pushed by. */
static double square_of_push(const Model* m, uint32_t k) {
  const double angle = PI * k / (m->n + 1.0);
  const double twice = 2.0 * cos(angle);
  const double a = m->k1 * (2.0 - twice);
  double before = 0.0;
  double sine = sin(angle);
  double x = 0.0;
  double u = 0.0;
  for (uint32_t i = 1; i <= m->n; ++i) {
    const double next = twice * sine - before;
    x += sine * m->x[i];
    u += sine * m->u[i];
    before = sine;
    sine = next;
  }
  return u * u + a * x * (x - u);
}

uint32_t rehearsal_spectrum(uint32_t n_masses,
                            Strike wanted,
                            double angle1,
                            double shares[REHEARSAL_PARTIALS]) {
  Model m = model_of(n_masses, wanted.place, angle1);
  rehearse(&m, n_masses, &wanted);
  const double first = square_of_push(&m, 1);
  for (uint32_t k = 1; k <= m.n; ++k) {
    shares[k - 1] = square_of_push(&m, k) / first;
  }
  return m.n;
}
