/* plan.h - the steps of a stage as data: what `bulla plan` prints is what advance.c runs. */
#ifndef PLAN_H
#define PLAN_H

#include "base/text.h"
#include "case/scene.h"
#include "solve/stage.h"

struct plan_step {
    const char *name;
    const char *formula;              /* of the stage that it takes, else empty */
    const char *doc;                  /* what it does, one line */
    void (*run)(struct stage *stage); /* never NULL */
    int turn;                         /* row of the tableau */
};

struct plan {
    int n;
    struct plan_step step[3 * TABLEAU_STAGES + 2];
};

/* The steps of one step in time of a level, in order, for an integrator. Valid as long as the program. */
const struct plan *plan_of(const struct tableau *tableau);

/* The plan of a scene for people: the steps, the terms of its equations and where they live. `model`: of the scene. */
void plan_text(const struct model *model, struct text *ret_text);

#endif
