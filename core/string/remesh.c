#include "core/string/remesh.h"

#include "core/base/maths.h"

#include <math.h>

/* What a string is doing. */
typedef struct {
  uint32_t n_masses;
  float x[CHAIN_MAX_MASSES];
  float u[CHAIN_MAX_MASSES];
} Shape;

/* The mass that is found `place` steps from the first wall, and whether it is upside down. */
typedef struct {
  uint32_t mass; /* n_masses: a wall */
  double sign;
} Image;

static Image image_of(int64_t place, uint32_t n_masses) {
  const int64_t length = (int64_t)n_masses + 1;
  const int64_t round = ((place % (2 * length)) + 2 * length) % (2 * length);
  const bool is_mirrored = round > length;
  const int64_t inside = is_mirrored ? 2 * length - round : round;
  const bool is_wall = inside == 0 || inside == length;
  return (Image){is_wall ? n_masses : (uint32_t)inside - 1, is_mirrored ? -1.0 : 1.0};
}

/* An angle that turns by the same each time; cheaper than a sine each. */
typedef struct {
  double sine, cosine, sine_step, cosine_step;
} Turn;

static Turn turn_init(double angle, double step) {
  return (Turn){sin(angle), cos(angle), sin(step), cos(step)};
}

static void turn(Turn* t) {
  const double sine = t->sine * t->cosine_step + t->cosine * t->sine_step;
  t->cosine = t->cosine * t->cosine_step - t->sine * t->sine_step;
  t->sine = sine;
}

/*
  Of the shape at `place` (in its own masses from the first wall): Σ w((i − place)/pace) over the
  masses i, with w(t) = sin(πt)/(πt) · cos²(πt/(2 REACH)), that is, without what is finer than
  `pace`.
*/
static void read_shape(const Shape* shape, double place, double pace, double* x, double* u) {
  const int64_t first = (int64_t)ceil(place - REMESH_REACH * pace);
  const int64_t last = (int64_t)floor(place + REMESH_REACH * pace);
  const double start = ((double)first - place) / pace;
  Turn wave = turn_init(PI * start, PI / pace);
  Turn window = turn_init(PI * start / REMESH_REACH, PI / pace / REMESH_REACH);
  double sum = 0.0;
  *x = 0.0;
  *u = 0.0;
  for (int64_t i = first; i <= last; ++i) {
    const double angle = PI * ((double)i - place) / pace;
    const double sinc = fabs(angle) < 1e-6 ? 1.0 : wave.sine / angle;
    const double weight = sinc * (0.5 + 0.5 * window.cosine);
    const Image image = image_of(i, shape->n_masses);
    if (image.mass < shape->n_masses) {
      *x += weight * image.sign * (double)shape->x[image.mass];
      *u += weight * image.sign * (double)shape->u[image.mass];
    }
    sum += weight;
    turn(&wave);
    turn(&window);
  }
  *x /= sum;
  *u /= sum;
}

void remesh(Chain* chain, uint32_t n_masses) {
  Shape shape = {.n_masses = chain->n_masses};
  for (uint32_t i = 0; i < shape.n_masses; ++i) {
    shape.x[i] = chain_position(chain, i);
    shape.u[i] = chain_velocity(chain, i);
  }
  const double ratio = (shape.n_masses + 1.0) / (n_masses + 1.0);
  chain_init(chain, chain->kernel, chain->memory, n_masses);
  for (uint32_t i = 0; i < n_masses; ++i) {
    double x = 0.0;
    double u = 0.0;
    read_shape(&shape, (i + 1.0) * ratio, fmax(ratio, 1.0), &x, &u);
    chain_place(chain, i, (float)x, (float)u);
  }
}
