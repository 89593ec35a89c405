/* cost.c - see cost.h. */
#include "solve/cost.h"

#include <string.h>
#include <time.h>

static double cost_clock(clockid_t clock)
{
    struct timespec now;
    clock_gettime(clock, &now);
    return (double)now.tv_sec + 1e-9 * (double)now.tv_nsec;
}

double cost_cpu(void)
{
    return cost_clock(CLOCK_PROCESS_CPUTIME_ID);
}

/* The second window is the first that is sampled: short runs have one too, and caches are warm. */
void cost_open(struct cost *cost, enum cost_kind kind)
{
    cost->on = cost->n[kind]++ % COST_EVERY == 1;
    if (!cost->on) return;
    memset(cost->window, 0, sizeof cost->window);
    cost->begin[1] = cost_cpu();
    cost->begin[0] = cost->lap = cost_clock(CLOCK_MONOTONIC);
}

void cost_note(struct cost *cost, enum cost_part part)
{
    double now = cost_clock(CLOCK_MONOTONIC);
    cost->window[part] += now - cost->lap;
    cost->lap = now;
}

double cost_close(struct cost *cost, enum cost_kind kind)
{
    if (!cost->on) return 0.0;
    double wall = cost_clock(CLOCK_MONOTONIC) - cost->begin[0], cpu = cost_cpu() - cost->begin[1], work = 0.0;
    for (int part = 0; part < COST_PARTS && wall > 0.0; part++) {
        double seconds = cost->window[part] * (cpu / wall);
        cost->sum[kind][part] += seconds;
        if (part != COST_EXCHANGE) work += seconds;
    }
    cost->sampled[kind]++;
    cost->on = false;
    return work;
}

void cost_total(const struct cost *cost, double ret_seconds[COST_PARTS])
{
    memset(ret_seconds, 0, COST_PARTS * sizeof *ret_seconds);
    for (int kind = 0; kind < COST_KINDS; kind++)
        for (int part = 0; part < COST_PARTS && cost->sampled[kind]; part++)
            ret_seconds[part] += cost->sum[kind][part] * ((double)cost->n[kind] / (double)cost->sampled[kind]);
}
