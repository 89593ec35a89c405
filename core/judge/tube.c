/* tube.c - see tube.h. The diaphragm is found by bisection: no kind of shape is special. */
#include "judge/tube.h"

#include "base/status.h"
#include "bulla/eos.h"

/* The layer that shows at x, or -1. */
static int tube_layer(const struct scene *scene, double x)
{
    double point[SCENE_AXES] = {x, 0, 0};
    int found = -1;
    for (unsigned i = 0; i < scene->n_layer; i++)
        if (shape_contains(scene->layers[i].shape, point)) found = (int)i;
    return found;
}

static double tube_parameter(const struct instance *eos, const char *name)
{
    int row = instance_param_find(eos->module, name);
    return row < 0 ? 0 : eos->values[row].number;
}

/* A layer's pure material and uniform state. */
static int tube_side(const struct scene *scene, const struct scene_layer *layer, struct exact_side *ret,
                     int *ret_material)
{
    const double origin[SCENE_AXES] = {0};
    int material = 0;
    while (material < (int)scene->n_material && layer->has_material && layer->fractions[material] < 1) material++;
    if (!layer->has_material || layer->script || material == (int)scene->n_material)
        return status_fail(STATUS_CASE, "%s:%d: the exact Riemann solution needs layers of one material each",
                           scene->path, layer->line);
    const struct instance *eos = &scene->material[material].eos;
    if (instance_param_find(eos->module, "gamma") < 0)
        return status_fail(STATUS_CASE,
                           "the exact Riemann solution knows ideal gas, stiffened gas, NASG and MNASG, not '%s'",
                           eos->module->name);
    const struct bulla_eos *law = eos->module->table;
    double p, u, rho, T;
    TRY(scene_value_at(&layer->pressure, origin, 0, 0, &p));
    u = 0;
    if (layer->velocity[0].given) TRY(scene_value_at(&layer->velocity[0], origin, 0, 0, &u));
    if (layer->temperature.given) {
        TRY(scene_value_at(&layer->temperature, origin, 0, 0, &T));
        law->density(eos->self, 1, &p, &T, &rho);
    } else {
        TRY(scene_value_at(&layer->density[material], origin, 0, 0, &rho));
    }
    *ret = (struct exact_side){
        tube_parameter(eos, "gamma"), tube_parameter(eos, "p-inf"), tube_parameter(eos, "covolume"), rho, u, p};
    *ret_material = material;
    return STATUS_OK;
}

int tube_of_scene(const struct scene *scene, struct tube *ret_tube)
{
    double low = scene->domain.lower[0], high = scene->domain.upper[0];
    int layer[2] = {tube_layer(scene, low), tube_layer(scene, high)}, material[2];
    for (unsigned l = 0; l < scene->n_material; l++)
        if (scene->material[l].constitutive.module)
            return status_fail(STATUS_CASE, "'exact-riemann' is the solution of fluids, and '%s' is a solid",
                               scene->material[l].name);
    if (scene->domain.n_velocity > scene->domain.dim)
        return status_fail(STATUS_CASE, "'exact-riemann' needs velocities of one component, not %d",
                           scene->domain.n_velocity);
    if (scene->domain.dim != 1 || scene->domain.geometry != SCENE_CARTESIAN || layer[0] == layer[1] || layer[0] < 0 ||
        layer[1] < 0)
        return status_fail(STATUS_CASE,
                           "'exact-riemann' needs a 1D cartesian scene of two layers that meet at one point");
    for (;;) {
        double middle = low + (high - low) / 2;
        if (middle <= low || middle >= high) break;
        int here = tube_layer(scene, middle);
        if (here != layer[0] && here != layer[1])
            return status_fail(STATUS_CASE, "'exact-riemann' needs two layers that meet at one point, not three");
        if (here == layer[0]) low = middle;
        else high = middle;
    }
    struct exact_side side[2];
    for (int k = 0; k < 2; k++) TRY(tube_side(scene, &scene->layers[layer[k]], &side[k], &material[k]));
    struct tube tube = {.x0 = low + (high - low) / 2, .material = {material[0], material[1]}};
    TRY(exact_solve(side, &tube.exact));
    *ret_tube = tube;
    return STATUS_OK;
}
