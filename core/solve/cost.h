/* cost.h - where the CPU time of a step goes, from samples.
 *
 * Every COST_EVERY-th window (a step of a level; what links two levels) is timed in laps; the others are only
 * counted. Laps are read from the wall clock, which is cheap, and scaled to the CPU time of their window, so that
 * other programs on the machine do not count. The period is a prime that no order of levels has, so that all levels
 * are sampled alike. */
#ifndef COST_H
#define COST_H

#include <stdbool.h>

enum { COST_EVERY = 37 };

enum cost_part {
    COST_EXCHANGE, /* messages, waiting for them, reductions */
    COST_GATHER,
    COST_FACES,      /* reconstruction and Riemann problems */
    COST_UPDATE,     /* divergence, closure, new state; tiles that are carried on */
    COST_PRIMITIVES, /* and admissibility, signal speed */
    COST_LEVELS,     /* ghosts of finer levels, averages, refluxing */
    COST_PARTS
};

/* What windows are about; each kind has its own count. */
enum cost_kind { COST_STEP, COST_SYNC, COST_KINDS };

struct cost {
    bool on;         /* a sampled window is open */
    double lap;      /* when the last lap ended [s] */
    double begin[2]; /* wall and CPU time when the window was opened [s] */
    double window[COST_PARTS];
    double sum[COST_KINDS][COST_PARTS]; /* CPU s of all sampled windows */
    long n[COST_KINDS], sampled[COST_KINDS];
};

void cost_open(struct cost *cost, enum cost_kind kind);

/* Returns the CPU time of the window without messages; 0 of one that is not sampled [s]. */
double cost_close(struct cost *cost, enum cost_kind kind);

/* For cost_lap. */
void cost_note(struct cost *cost, enum cost_part part);

/* The time since the last lap was spent on `part`. */
static inline void cost_lap(struct cost *cost, enum cost_part part)
{
    if (cost->on) cost_note(cost, part);
}

/* Estimated CPU time of each part so far, of this rank [s]. */
void cost_total(const struct cost *cost, double ret_seconds[COST_PARTS]);

/* CPU time of this process [s]. */
double cost_cpu(void);

#endif
