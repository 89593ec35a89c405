/* due.h - when an output is due, and how steps are cut to hit its times exactly.
 *
 * Times are multiples k * every, never sums, so that they carry no drift. Two times closer
 * than 1e-9 of the interval are one time: 3 * 0.1 us must not ask for a step of one ulp
 * after 0.3 us. */
#ifndef DUE_H
#define DUE_H

#include "case/scene.h"
#include "io/notes.h"

#include <stdbool.h>

struct due {
    struct scene_every every;
    long next;      /* time: the next multiple of every.time */
    long last_step; /* the step written last, -1 before the first */
};

/* A schedule by the wall clock. */
struct due_wall {
    double every; /* s; 0: never */
    double now;   /* the clock when it was looked at last */
    double last;  /* when the output was written last */
};

/* Is an output due at this time of the clock [s]? */
bool due_wall_now(struct due_wall *due, double clock);

/* Notes that the output has been written, or could not be: it is due again after the whole interval. */
void due_wall_written(struct due_wall *due);

/* A schedule that starts at t = 0 with step 0 (both are due at once). */
void due_init(struct due *due, struct scene_every every);

/* Is an output due at this time and step? Nothing is due twice at one step. */
bool due_now(const struct due *due, double t, long step);

/* Notes that the output of this time and step has been written. */
void due_written(struct due *due, double t, long step);

/* Notes a schedule under a name, and goes on with it, if it still has the same interval; with another one the next
 * output is that of the next multiple after t. */
void due_keep(const struct due *due, const char *name, struct notes *notes);
void due_recall(struct due *due, const char *name, const struct notes *notes, double t, long step);

/* The earliest of `until` and the next times of `n` schedules that is later than t. */
double due_target(const struct due *const *dues, int n, double t, double until);

/* The step to take when `dt` is possible and `remaining` time is left to the target: dt, or
 * all that remains (stretched by up to 1e-4), or half of it where dt would leave a sliver. */
double due_step(double dt, double remaining);

#endif
