/* plan.h - the stages of a step, as data: what `bulla plan` prints is what advance.c runs. */
#ifndef PLAN_H
#define PLAN_H

#include "base/text.h"
#include "case/scene.h"
#include "solve/stage.h"

struct plan_stage {
    const char *name;
    const char *doc;                  /* one line; %L, %R, %C, %E stand for reconstruction, solver, closure, laws */
    void (*run)(struct stage *stage); /* never NULL */
};

/* The stages of one step of a level, in order; ends with name == NULL. Explicit midpoint rule:
 * u* = u^n + dt/2 L(w^n), u^{n+1} = u^n + dt L(w*). */
const struct plan_stage *plan_stages(void);

/* The plan of a scene for people. */
void plan_text(const struct scene *scene, struct text *ret_text);

#endif
