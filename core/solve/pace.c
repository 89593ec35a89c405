/* pace.c - see pace.h. Nothing here is computed as long as all goes well but the comparison. */
#include "solve/pace.h"

#include "base/comm.h"
#include "base/text.h"
#include "phys/elastic.h"
#include "phys/mix.h"
#include "solve/stage.h"
#include "solve/verdict.h"

#include <float.h>
#include <math.h>
#include <stdio.h>
#include <string.h>

double pace_least(const struct state *state, int l)
{
    const struct scene *scene = state->scene;
    double least = scene->run.dt_least;
    if (least < 0.0)
        least = PACE_LEAST * (scene->mesh.subcycle ? 1.0 : ldexp(1.0, -scene->mesh.levels)) * state->dt_longest;
    return scene->mesh.subcycle ? ldexp(least, -l) : least;
}

bool pace_allows(const struct state *state, int l, double t, double dt)
{
    bool moves = l > 0 || t + dt > t * (1.0 + 4.0 * DBL_EPSILON);
    return moves && dt > 0.0 && dt >= pace_least(state, l);
}

/* Primitives of one cell, as a block of stride 1, and the square of its sound speed. */
static double pace_cell(const struct model *path, size_t n_cell, const double *w, size_t cell, double *ret_own,
                        double *ret_rho_c2)
{
    double c2;
    for (unsigned q = 0; q < MODEL_FIELDS; q++) ret_own[q] = 0.0;
    for (unsigned i = 0; i < path->n_active; i++) ret_own[path->active[i]] = w[path->active[i] * n_cell + cell];
    mix_stiffness(path, 1, 1, ret_own, ret_rho_c2);
    mix_speed2(path, 1, 1, ret_own, ret_rho_c2, &c2);
    return c2;
}

/* One material of the cell: its law, its state; of a solid also how far it is stretched. */
static void pace_say_material(struct text *text, const struct model *path, const double *own, const double *rho_c2,
                              const double *T, unsigned l)
{
    const struct scene_material *material = &path->scene->material[path->first + l];
    double alpha = path->n_alpha ? own[path->i_alpha + l] : 1.0, rho = own[path->i_m + l];
    if (!(alpha > MIX_ABSENT)) return;
    text_add(text, "; %s (%s) fraction %.3g, density %.4g kg/m3, temperature %.4g K, sound speed %.4g m/s",
             material->name, material->eos.module->name, alpha, rho, T[l], sqrt(rho_c2[l] / rho));
    if (!path->n_stretch || !material->constitutive.module) return;
    double I1 = 3.0, I2 = 3.0;
    for (unsigned s = 0; s < path->n_solid; s++)
        if (path->solids[s].material == l) elastic_invariants(path, 1, 1, own + path->solids[s].stretch, &I1, &I2);
    text_add(text, ", %s at I1 = %.4g, I2 = %.4g", material->constitutive.module->name, I1, I2);
}

void pace_judge(const struct guard *guard, const struct model *path, const double *w, struct guard_place *place)
{
    double own[MODEL_FIELDS], rho_c2[SCENE_MATERIALS], T[SCENE_MATERIALS], speed2 = 0.0;
    double c = sqrt(pace_cell(path, guard->mesh->n_cell, w, place->cell, own, rho_c2));
    char where[GUARD_WHERE];
    struct text text = {0};
    guard_where(guard, place->local, place->cell, where);
    mix_temperatures(path, 1, 1, own, T);
    for (unsigned d = 0; d < path->n_velocity; d++) speed2 += own[path->i_u + d] * own[path->i_u + d];
    text_add(&text, "sound speed %.4g m/s, velocity %.4g m/s, pressure %.4g Pa in %s", c, sqrt(speed2), own[path->i_E],
             where);
    for (unsigned l = 0; l < path->n_material; l++) pace_say_material(&text, path, own, rho_c2, T, l);
    snprintf(place->words, sizeof place->words, "%s", text.at);
    snprintf(place->field, sizeof place->field, "sound_speed");
    place->value = c;
    text_done(&text);
}

/* The cell of a tile whose signal is the largest (as convection_signal, which sets the step). */
static size_t pace_fastest(const struct stage *stage, const struct model *path, const double *w)
{
    size_t n_cell = stage->mesh->n_cell, found = 0;
    double most = -1.0, own[MODEL_FIELDS], rho_c2[SCENE_MATERIALS];
    for (size_t cell = 0; cell < n_cell; cell++) {
        double c = sqrt(pace_cell(path, n_cell, w, cell, own, rho_c2)), signal = 0.0;
        for (unsigned d = 0; d < (unsigned)path->dim; d++)
            signal += (fabs(own[path->i_u + d]) + c) / stage->level->h[d];
        if (!(signal > most)) continue;
        most = signal;
        found = cell;
    }
    return found;
}

/* The level whose signal holds up the steps of level l and of those above it. */
static int pace_level(const struct state *state, int l)
{
    int found = l;
    double most = 0.0, per_step = 1.0;
    for (int k = l; k < state->mesh->n_level; k++, per_step *= state->scene->mesh.subcycle ? 2.0 : 1.0) {
        if (!(state->signals[k] / per_step > most)) continue;
        most = state->signals[k] / per_step;
        found = k;
    }
    return found;
}

struct stage *pace_find(const struct state *state, int l, struct guard_place *ret_place)
{
    struct stage *stage = state->stages[pace_level(state, l)];
    unsigned tile = 0;
    double most;
    verdict_survey(stage);
    most = stage->signal;
    comm_max(&most, 1);
    if (comm_first(stage->level->n_local && stage->signal == most) != comm_rank()) return NULL;
    while (stage_tile(stage, tile)->sleeps || stage->census.tiles[tile].signal != most) tile++;
    const struct model *path = stage->census.tiles[tile].path;
    const double *w = stage->level->w[tile];
    *ret_place = (struct guard_place){.local = tile,
                                      .stage = BLAME_TOO_SLOW,
                                      .pure = model_number(path),
                                      .cell = pace_fastest(stage, path, w)};
    pace_judge(stage->guard, path, w, ret_place);
    return stage;
}
