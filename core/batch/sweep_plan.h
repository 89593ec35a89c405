/* sweep_plan.h - the combinations of a sweep: their settings, directories, resolved cases, and what is there of them.
 *
 * Every combination is read and checked before the first one runs. */
#ifndef SWEEP_PLAN_H
#define SWEEP_PLAN_H

#include "batch/matrix.h"
#include "batch/sweep_look.h"
#include "case/scene.h"
#include "cli/cli.h"

struct sweep_plan_row {
    char *name, *directory; /* "R0=10um,standoff=1.1"; the plan's directory and the name */
    char **sets;            /* of the command line, then of the matrix; NULL-terminated, owned by others */
    char *resolved;
    enum sweep_look found;
    char *difference; /* SWEEP_LOOK_FOREIGN: what differs */
};

struct sweep_plan {
    const char *path, *variant; /* of the command line */
    char *directory;
    struct matrix matrix;
    char **sets;                 /* of the command line, NULL-terminated */
    struct sweep_plan_row *rows; /* [matrix.n_row] */
};

/* Reads the case, checks all combinations and looks at what their directories hold. Nothing is written. STATUS_CASE
 * after printed mistakes. Release with sweep_plan_done. */
int sweep_plan_make(const struct cli_given *given, struct sweep_plan *ret_plan);
void sweep_plan_done(struct sweep_plan *plan);

/* Looks again at what the directories hold. */
void sweep_plan_look(struct sweep_plan *plan);

/* The scene of a row; messages are dropped. */
int sweep_plan_scene(const struct sweep_plan *plan, unsigned index, struct scene **ret_scene);

#endif
