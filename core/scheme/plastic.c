/* plastic.c - see plastic.h. */
#include "scheme/plastic.h"

#include "phys/flow.h"
#include "phys/settle.h"

#include <string.h>

static bool plastic_wanted(const struct model *path)
{
    return path->plastic;
}

static bool plastic_reads(const struct model *path)
{
    return flow_reads(path) || settle_wanted(path);
}

/* Where the middle of a step is only looked at: what flows there is not counted. */
static bool plastic_wanted_between(const struct model *path)
{
    return path->plastic && path->scene->scheme.integrator == SCENE_MIDPOINT;
}

static void plastic_acts(const struct operator_tile *tile)
{
    const struct model *model = tile->model;
    size_t n = tile->n_cell;
    if (tile->grown) memset(tile->grown, 0, model->n_solid * n * sizeof *tile->grown);
    if (settle_wanted(model)) settle_flow(model, n, n, tile->dt, tile->w, tile->u, tile->grown);
    flow_return(model, n, n, tile->dt, tile->w, tile->u, tile->grown);
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
    .reads = plastic_reads,
    .acts = plastic_acts,
    .say = plastic_say,
};

const struct operator plastic_between_operator = {
    .name = "plastic",
    .owner = "core/scheme/plastic.c",
    .equation = "the same in the middle of the step: the stress that does work is bounded by the strength",
    .when = OPERATOR_BETWEEN,
    .wanted = plastic_wanted_between,
    .reads = plastic_reads,
    .acts = plastic_acts,
};
