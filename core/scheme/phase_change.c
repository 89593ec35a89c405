/* phase_change.c - see phase_change.h. */
#include "scheme/phase_change.h"

#include "base/status.h"
#include "phys/phase.h"
#include "phys/phase_bear.h"

#include <stdio.h>

static bool phase_change_wanted(const struct model *path)
{
    return path->n_phase > 0;
}

/* Vapour may come to be in tiles of this liquid alone. */
static bool phase_change_cavitates(const struct model *path, const struct scene_phase *pair)
{
    return pair->everywhere && pair->liquid == path->first;
}

static bool phase_change_waits(const struct model *path)
{
    const struct scene *scene = path->scene;
    bool waits = false;
    for (unsigned k = 0; k < scene->n_phase; k++) waits = waits || phase_change_cavitates(path, &scene->phases[k]);
    return waits && path->n_alpha == 0;
}

static bool phase_change_wakes(const struct model *path, size_t n, size_t stride, const double *w)
{
    const struct scene *scene = path->scene;
    bool stays = true;
    for (unsigned k = 0; k < scene->n_phase; k++)
        if (phase_change_cavitates(path, &scene->phases[k]))
            stays = stays && phase_bear_cells(path, &scene->phases[k], n, stride, w);
    return !stays;
}

/* The largest side of the cells of a level. */
static double phase_change_size(const struct operator_tile *tile)
{
    double h = 0.0;
    for (int d = 0; d < tile->mesh->dim; d++) h = h > tile->level->h[d] ? h : tile->level->h[d];
    return h;
}

static void phase_change_acts(const struct operator_tile *tile)
{
    struct equilibrium_effort effort = {0};
    double h = phase_change_size(tile);
    for (unsigned k = 0; k < tile->model->n_phase; k++) {
        const unsigned char *shore = tile->shore ? tile->shore + k * tile->n_cell : NULL;
        int status =
            phase_act(tile->model, k, tile->n_cell, tile->n_cell, tile->dt, h, shore, tile->w, tile->u, &effort);
        if (!status || !tile->fault || tile->fault->status) continue;
        tile->fault->status = status;
        snprintf(tile->fault->message, sizeof tile->fault->message, "%s", status_text());
    }
}

static void phase_change_say(const struct scene *scene, struct text *text)
{
    static const char *const rates[] = {"equilibrium", "none", "relaxation", "hertz-knudsen", "lua"};
    for (unsigned k = 0; k < scene->n_phase; k++) {
        const struct scene_phase *pair = &scene->phases[k];
        text_add(text, "%s%s to %s, %s, %s", k ? "; " : ": ", scene->material[pair->liquid].name,
                 scene->material[pair->vapour].name, rates[pair->rate],
                 pair->everywhere ? "everywhere" : "at interfaces");
        if (pair->onset > 0.0) text_add(text, " from %g of vapour on", pair->onset);
        if (pair->wet > 0.0) text_add(text, ", condensing from %g of liquid on", pair->wet);
        if (pair->over > 0.0) text_add(text, ", condensing while sound crosses %g cells", pair->over);
    }
    if (scene->scheme.wood) text_add(text, "; expanding mixtures have Wood's speed of sound (core/scheme/wood.c)");
}

const struct operator phase_change_operator = {
    .name = "phase",
    .owner = "core/scheme/phase_change.c",
    .equation = "mu_v = g_l at one p and T of liquid, vapour and gases; mass, momentum, energy stay",
    .when = OPERATOR_STAGE,
    .wanted = phase_change_wanted,
    .waits = phase_change_waits,
    .wakes = phase_change_wakes,
    .acts = phase_change_acts,
    .say = phase_change_say,
};
