/* eta.c - see eta.h. */
#include "run/eta.h"

#include <math.h>

static const double eta_memory = 10; /* s of wall time over which the pace is smoothed */
static const double eta_bend = 4;    /* most that a trend may change the guess, early in a run */
static const double eta_margin = 1.1;

void eta_begin(struct eta *eta, double share)
{
    *eta = (struct eta){.first = share, .share = share};
}

void eta_note(struct eta *eta, double share, double cpu, double wall)
{
    double gone = share - eta->share;
    if (!(gone > 0)) return;
    double pace = (cpu - eta->cpu) / gone, keep = eta->pace > 0 ? exp((eta->wall - wall) / eta_memory) : 0;
    eta->pace = keep * eta->pace + (1 - keep) * pace;
    eta->share = share;
    eta->cpu = cpu;
    eta->wall = wall;
}

struct eta_left eta_left(const struct eta *eta)
{
    double done = eta->share - eta->first, left = 1 - eta->share;
    if (!(done > 0) || !(eta->cpu > 0)) return (struct eta_left){INFINITY, INFINITY, INFINITY};
    double slowness = eta->wall / eta->cpu, flat = slowness * eta->pace * left;
    double change = (eta->pace - eta->cpu / done) * left / done; /* the mean pace was that of the middle */
    double bent = slowness * (eta->pace + change) * left;
    bent = fmin(fmax(bent, flat / eta_bend), flat * eta_bend);
    return (struct eta_left){0.5 * (flat + bent), fmin(flat, bent) / eta_margin, fmax(flat, bent) * eta_margin};
}
