#include "core/guitar/fretboard.h"

#include <assert.h>
#include <math.h>
#include <stdbool.h>
#include <stdlib.h>

/* What things cost: see the header. */
static const double FINGER = 1.0;
static const double FRET = 0.05;
static const double OPEN = 0.25;
static const double MOVE = 1.0;
static const double STRETCH = 10.0;
static const double SPAN = 0.25;
static const double GAP = 0.5;
static const double CROSSING = 20.0;
static const double RINGING = 1.0;
static const double TAKEN = 1000.0;
static const double TAKEN_LATER = 100.0;
/* More than all strings taken. */
static const double LEFT_OUT = 1e5;

/* Further from a pitch than this a string plays another note. */
static const double SAME_FRET = 0.5;

enum { NO_STRING = GUITAR_STRINGS };

/* The first notes of a chord with strings given to them. */
typedef struct {
  double cost;         /* Of all but the open strings and the hand */
  int32_t lowest;      /* Fret of a finger; 0: there is none yet */
  int32_t highest;     /* Fret of a finger */
  uint32_t n_open;     /* Open strings */
  uint32_t used;       /* Bit n: the n-th string from the lowest is in use */
  uint32_t last_place; /* From the lowest string; NO_STRING: none yet */
} Part;

/* Notes count from the lowest and strings, called places here, as well. */
typedef struct {
  const Fretboard* board;
  int32_t position;
  uint32_t n_notes;
  uint32_t keys[FRETBOARD_NOTES];
  uint32_t given[FRETBOARD_NOTES];                 /* Where each was in the order given */
  uint32_t string[GUITAR_STRINGS];                 /* Of each place */
  double cost[FRETBOARD_NOTES][GUITAR_STRINGS];    /* By place; INFINITY: cannot be played there */
  int32_t finger[FRETBOARD_NOTES][GUITAR_STRINGS]; /* By place */
  double least_after[FRETBOARD_NOTES + 1]; /* What the notes from this one on cost at the least */
  uint32_t place[FRETBOARD_NOTES];
  double best_cost;
  uint32_t best_place[FRETBOARD_NOTES];
  int32_t best_position;
  uint32_t n_tries;
} Search;

int32_t fretboard_finger(const FretboardString* string, uint32_t key) {
  return (int32_t)lround(key - string->open);
}

int32_t fretboard_reach(int32_t position, int32_t lowest, int32_t highest) {
  const int32_t last = highest - FRETBOARD_REACH;
  if (lowest < position || lowest < last) {
    return lowest;
  }
  return last > position ? last : position;
}

/* Insertion sorts: there are few, and what is equal keeps its order. */
static void sort_notes(Search* search, const uint32_t* keys) {
  for (uint32_t n = 0; n < search->n_notes; ++n) {
    uint32_t i = n;
    for (; i > 0 && search->keys[i - 1] > keys[n]; --i) {
      search->keys[i] = search->keys[i - 1];
      search->given[i] = search->given[i - 1];
    }
    search->keys[i] = keys[n];
    search->given[i] = n;
  }
}

static void sort_strings(Search* search) {
  const Fretboard* const board = search->board;
  for (uint32_t n = 0; n < board->n_strings; ++n) {
    const uint32_t string = board->n_strings - 1 - n;
    uint32_t i = n;
    for (; i > 0 && board->strings[search->string[i - 1]].open > board->strings[string].open; --i) {
      search->string[i] = search->string[i - 1];
    }
    search->string[i] = string;
  }
}

/* How many strings were taken longer ago than this one. */
static uint32_t count_older(const Fretboard* board, const FretboardString* string) {
  uint32_t n_older = 0;
  for (uint32_t s = 0; s < board->n_strings; ++s) {
    n_older +=
        board->strings[s].use == FRETBOARD_TAKEN && board->strings[s].played < string->played;
  }
  return n_older;
}

/* What it costs to play a key on a string, whatever else is played. */
static double cost_of_string(const Fretboard* board, const FretboardString* string, uint32_t key) {
  const int32_t finger = fretboard_finger(string, key);
  const double fretted = finger > 0 ? FINGER + FRET * finger : 0.0;
  switch (string->use) {
  case FRETBOARD_TAKEN:
    return fretted + TAKEN + TAKEN_LATER * count_older(board, string);
  case FRETBOARD_RINGING:
    return fabs(key - string->open - string->fret) < SAME_FRET ? fretted : fretted + RINGING;
  case FRETBOARD_FREE:
    break;
  }
  return fretted;
}

/* How far a fret is off the ends of a string. */
static int32_t beyond(int32_t finger) {
  return finger < 0 ? -finger : finger > FRETBOARD_FRETS ? finger - FRETBOARD_FRETS : 0;
}

/* Weigh a note on every string: on those that have it, or if there is none on the nearest. */
static void weigh_note(Search* search, uint32_t note) {
  const Fretboard* const board = search->board;
  int32_t nearest = INT32_MAX;
  for (uint32_t p = 0; p < board->n_strings; ++p) {
    const int32_t off =
        beyond(fretboard_finger(&board->strings[search->string[p]], search->keys[note]));
    nearest = off < nearest ? off : nearest;
  }
  bool is_placed = false;
  for (uint32_t p = 0; p < board->n_strings; ++p) {
    const FretboardString* const string = &board->strings[search->string[p]];
    const int32_t finger = fretboard_finger(string, search->keys[note]);
    const bool is_playable = beyond(finger) == nearest && (nearest == 0 || !is_placed);
    is_placed = is_placed || is_playable;
    search->finger[note][p] = finger < FRETBOARD_FRETS ? finger : FRETBOARD_FRETS;
    search->cost[note][p] =
        is_playable ? cost_of_string(board, string, search->keys[note]) : (double)INFINITY;
  }
}

static void weigh_notes(Search* search) {
  for (uint32_t n = search->n_notes; n-- > 0;) {
    double least = LEFT_OUT;
    weigh_note(search, n);
    for (uint32_t p = 0; p < search->board->n_strings; ++p) {
      least = fmin(least, search->cost[n][p]);
    }
    search->least_after[n] = search->least_after[n + 1] + least;
  }
}

static int32_t position_for(const Search* search, const Part* part) {
  return part->lowest == 0 ? search->position
                           : fretboard_reach(search->position, part->lowest, part->highest);
}

static double cost_of_hand(const Search* search, const Part* part) {
  const int32_t span = part->highest - part->lowest;
  const int32_t stretch = span > FRETBOARD_REACH ? span - FRETBOARD_REACH : 0;
  return MOVE * abs(position_for(search, part) - search->position) + SPAN * span +
         STRETCH * stretch;
}

/* What the place of a note costs beside the places of those before it. */
static double cost_of_order(const Part* part, uint32_t place) {
  if (part->last_place == NO_STRING) {
    return 0.0;
  }
  uint32_t n_crossed = 0;
  for (uint32_t above = part->used >> place; above; above >>= 1) {
    n_crossed += above & 1;
  }
  const uint32_t n_between = place > part->last_place ? place - part->last_place - 1 : 0;
  return CROSSING * n_crossed + GAP * n_between;
}

/* The part with one more note. */
static Part extend(const Search* search, const Part* part, uint32_t note, uint32_t place) {
  Part more = *part;
  if (place == NO_STRING) {
    more.cost += LEFT_OUT;
    return more;
  }
  const int32_t finger = search->finger[note][place];
  more.cost += search->cost[note][place] + cost_of_order(part, place);
  more.used |= UINT32_C(1) << place;
  more.last_place = place;
  if (finger <= 0) {
    ++more.n_open;
  } else {
    more.lowest = part->lowest == 0 || finger < part->lowest ? finger : part->lowest;
    more.highest = finger > part->highest ? finger : part->highest;
  }
  return more;
}

/* Whether a note can go to a place that no other has. */
static bool is_open_to(const Search* search, const Part* part, uint32_t note, uint32_t place) {
  return place == NO_STRING ||
         (!(part->used >> place & 1) && search->cost[note][place] < (double)INFINITY);
}

static void keep_if_better(Search* search, const Part* whole) {
  const int32_t position = position_for(search, whole);
  const double cost = whole->cost + cost_of_hand(search, whole) + OPEN * position * whole->n_open;
  if (cost < search->best_cost) {
    search->best_cost = cost;
    search->best_position = position;
    for (uint32_t n = 0; n < search->n_notes; ++n) {
      search->best_place[n] = search->place[n];
    }
  }
}

/* Try all ways, the lowest note first, but those that cannot become the cheapest. */
static void search_all(Search* search) {
  Part parts[FRETBOARD_NOTES + 1] = {{.last_place = NO_STRING}};
  uint32_t next[FRETBOARD_NOTES] = {0};
  const uint32_t n_places = search->board->n_strings;
  uint32_t note = 0;
  while (search->n_tries < FRETBOARD_TRIES) {
    if (next[note] > n_places) {
      if (note == 0) {
        return;
      }
      --note;
      continue;
    }
    const uint32_t place = next[note] == n_places ? NO_STRING : next[note];
    ++next[note];
    ++search->n_tries;
    if (!is_open_to(search, &parts[note], note, place)) {
      continue;
    }
    parts[note + 1] = extend(search, &parts[note], note, place);
    search->place[note] = place;
    const Part* const part = &parts[note + 1];
    if (part->cost + cost_of_hand(search, part) + search->least_after[note + 1] >=
        search->best_cost) {
      continue;
    }
    if (note + 1 == search->n_notes) {
      keep_if_better(search, part);
    } else {
      next[++note] = 0;
    }
  }
}

/* The best place for a note that has to share it. */
static uint32_t shared_place(const Search* search, uint32_t note) {
  uint32_t best = 0;
  for (uint32_t p = 1; p < search->board->n_strings; ++p) {
    best = search->cost[note][p] < search->cost[note][best] ? p : best;
  }
  return best;
}

FretboardGrip
fretboard_grip(const Fretboard* board, int32_t position, const uint32_t* keys, uint32_t n_keys) {
  assert(n_keys <= FRETBOARD_NOTES && board->n_strings >= 1 && board->n_strings <= GUITAR_STRINGS);
  FretboardGrip grip = {.position = position};
  Search search = {.board = board,
                   .position = position,
                   .n_notes = n_keys,
                   .best_cost = (double)INFINITY,
                   .best_position = position};
  if (n_keys == 0) {
    return grip;
  }
  sort_notes(&search, keys);
  sort_strings(&search);
  weigh_notes(&search);
  search_all(&search);
  for (uint32_t n = 0; n < n_keys; ++n) {
    const uint32_t place = search.best_place[n];
    grip.string[search.given[n]] =
        search.string[place == NO_STRING ? shared_place(&search, n) : place];
  }
  grip.position = search.best_position;
  grip.n_tries = search.n_tries;
  return grip;
}
