/* unmixed_say.c - see unmixed_say.h. */
#include "run/unmixed_say.h"

#include "base/log.h"
#include "solve/unmixed.h"

void unmixed_say(const struct state *state)
{
    const struct scene *scene = state->scene;
    for (unsigned k = 0; k < scene->n_phase; k++)
        if (unmixed_is(state, k))
            log_warn(
                "phase-change[%u]: no cell holds both '%s' and what it evaporates into; where they touch, their "
                "surface lies on faces of cells, and no mass is exchanged until it moves into one: move it by part "
                "of a cell",
                k, scene->material[scene->phases[k].liquid].name);
}
