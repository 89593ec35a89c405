/* plastic.c - see plastic.h. */
#include "scheme/plastic.h"

#include "phys/flow.h"

static bool plastic_wanted(const struct model *path)
{
    return path->plastic;
}

static void plastic_acts(const struct operator_tile *tile)
{
    flow_return(tile->model, tile->n_cell, tile->n_cell, tile->dt, tile->w, tile->u, tile->grown);
}

static void plastic_say(const struct scene *scene, struct text *text)
{
    const char *comma = ": ";
    for (unsigned l = 0; l < scene->n_material; l++) {
        const struct bulla_module *law = scene->material[l].plastic.module;
        if (!law) continue;
        text_add(text, "%s%s %s", comma, scene->material[l].name, law->name);
        comma = ", ";
    }
}

const struct operator plastic_operator = {
    .name = "plastic",
    .owner = "core/scheme/plastic.c",
    .equation = "dV/dt = -Dp V until sqrt(3/2 s':s') = Y; the work is heat",
    .when = OPERATOR_STEP,
    .wanted = plastic_wanted,
    .reads = flow_reads,
    .acts = plastic_acts,
    .say = plastic_say,
};
