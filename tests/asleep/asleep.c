/* asleep.c - bulla whose tiles that sleep are poisoned: wherever their cells stop to mean anything (wake_leave, which
 * the linker turns to the function here) they become what BULLA_POISON says, NaN if it says nothing. A reader that does
 * not wake them first gives other numbers than bulla, or none. program/asleep.sh runs it. At the end it tells how many
 * tiles it has poisoned. */
#include "solve/stage.h"
#include "solve/wake.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>

static long long asleep_count;

void __real_wake_leave(struct stage *stage);
void __wrap_wake_leave(struct stage *stage);

static void asleep_tell(void)
{
    fprintf(stderr, "poisoned %lld\n", asleep_count);
}

static void asleep_poison(const struct stage *stage, unsigned local, double poison)
{
    const struct level *level = stage->level;
    for (size_t i = 0; i < stage->model->n_field * stage->mesh->n_cell; i++)
        level->u_old[local][i] = level->u_new[local][i] = level->w[local][i] = poison;
    if (!asleep_count++) atexit(asleep_tell);
}

void __wrap_wake_leave(struct stage *stage)
{
    const char *words = getenv("BULLA_POISON");
    double poison = words ? atof(words) : NAN;
    __real_wake_leave(stage);
    for (unsigned local = 0; local < stage->level->n_local; local++)
        if (stage_tile(stage, local)->sleeps) asleep_poison(stage, local, poison);
}
