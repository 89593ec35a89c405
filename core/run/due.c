/* due.c - see due.h. */
#include "run/due.h"

#include "solve/advance.h"

#include <math.h>

static const double due_same = 1e-9; /* of the interval */

void due_init(struct due *due, struct scene_every every)
{
    *due = (struct due){.every = every, .next = 0, .last_step = -1};
}

bool due_now(const struct due *due, double t, long step)
{
    if (step == due->last_step) return false;
    double every = due->every.time;
    if (every > 0) return (double)due->next * every - t <= due_same * every;
    return due->every.steps > 0 && step % due->every.steps == 0;
}

void due_written(struct due *due, double t, long step)
{
    due->last_step = step;
    double every = due->every.time;
    if (every > 0) due->next = (long)floor(t / every + due_same) + 1;
}

bool due_wall_now(struct due_wall *due, double clock)
{
    due->now = clock;
    return due->every > 0.0 && clock - due->last >= due->every;
}

void due_wall_written(struct due_wall *due)
{
    due->last = due->now;
}

void due_keep(const struct due *due, const char *name, struct notes *notes)
{
    const double values[] = {due->every.time, (double)due->every.steps, (double)due->next, (double)due->last_step};
    notes_put(notes, name, 4, values);
}

void due_recall(struct due *due, const char *name, const struct notes *notes, double t, long step)
{
    double values[4];
    bool known = notes_get(notes, name, 4, values);
    if (known && values[0] == due->every.time && (long)values[1] == due->every.steps) {
        due->next = (long)values[2];
        due->last_step = (long)values[3];
    } else {
        due_written(due, t, step);
    }
}

double due_target(const struct due *const *dues, int n, double t, double until)
{
    double target = until;
    for (int i = 0; i < n; i++) {
        double every = dues[i]->every.time;
        if (every <= 0) continue;
        double time = (double)dues[i]->next * every, slack = due_same * every;
        if (time > t + slack && time < target - slack) target = time;
    }
    return target;
}

double due_step(double dt, double remaining)
{
    if (remaining <= ADVANCE_STRETCH * dt) return remaining;
    if (remaining < 2 * dt) return remaining / 2;
    return dt;
}
