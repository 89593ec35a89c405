/* transport.c - see transport.h. */
#include "run/transport.h"

#include "cli/human.h"
#include "phys/coefficient.h"
#include "plug/vet.h"
#include "scheme/conduction.h"
#include "scheme/distance.h"
#include "solve/rkl.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

/* Mach numbers below which faces for slow flow are worth a word. */
#define TRANSPORT_SLOW 0.05

/* Least side of the cells of a level, and the sums of 1/h and 1/h^2 over the axes. */
struct transport_cells {
    double h, sum, squares;
};

static struct transport_cells transport_cells(const struct scene *scene, int level)
{
    struct transport_cells cells = {.h = HUGE_VAL};
    for (int axis = 0; axis < scene->domain.dim; axis++) {
        double own = (scene->domain.upper[axis] - scene->domain.lower[axis]) / ldexp(scene->domain.cells[axis], level);
        cells.h = fmin(cells.h, own);
        cells.sum += 1 / own;
        cells.squares += 1 / (own * own);
    }
    return cells;
}

/* The shortest side of the domain. */
static double transport_side(const struct scene *scene)
{
    double L = HUGE_VAL;
    for (int axis = 0; axis < scene->domain.dim; axis++)
        L = fmin(L, scene->domain.upper[axis] - scene->domain.lower[axis]);
    return L;
}

/* A material in its reference state; mu and zeta 0: it is not viscous. */
struct transport_fluid {
    double rho, c, mu, zeta;
};

static struct transport_fluid transport_fluid(const struct model *model, unsigned l)
{
    const struct model_eos *eos = &model->eos[l];
    const double p = 101325, rho = eos->rho_fill;
    const struct coefficient_points points = {1, NULL, &p, &rho};
    struct transport_fluid fluid = {.rho = rho};
    double e, rho_c2;
    coefficient_viscosities_most(&model->viscosity[l], eos, &points, &fluid.mu, &fluid.zeta);
    eos->law->state(eos->self, 1, &rho, &p, &e, &rho_c2);
    fluid.c = sqrt(rho_c2 / rho);
    return fluid;
}

/* Stages of rkl2 where steps of sound are so many times those of a diffusivity: of each stage of the integrator, or
 * with levels of the flows of all levels together, half a step of level 0 each, which the finest level asks for
 * (solve/flow.h). */
static void transport_print_stages(const struct scene *scene, double times)
{
    int levels = scene->mesh.levels, own = rkl_stages(times);
    if (scene->scheme.diffusion != SCENE_DIFFUSION_RKL2) return;
    double half = 0.5 * ldexp(times, scene->mesh.subcycle ? levels : 0);
    if (rkl_flows(scene) && own)
        printf("; rkl2 takes %d stages of %s before and after each step", rkl_stages(half),
               levels ? "all levels" : "its own");
    else printf(", rkl2 takes %d stages", own);
}

/* A step that something allows on a level, against that of sound at speed c; returns their ratio: what does not bind is
 * below 1. */
static double transport_print_step(const struct scene *scene, int level, double own, double c)
{
    char step[HUMAN_ROOM];
    double times = scene->scheme.cfl / (c * transport_cells(scene, level).sum) / own;
    printf("%s %s", level ? "," : "", human_si(own, "s", step));
    if (scene->mesh.levels) printf(" on level %d", level);
    printf(" (sound allows %.3g of that)", times);
    return times;
}

/* Steps that a diffusivity allows, by level. */
static void transport_print_limits(const struct scene *scene, double rate, double c)
{
    double times = 0;
    printf("  %-12s its steps:", "");
    for (int level = 0; level <= scene->mesh.levels; level++)
        times = transport_print_step(scene, level, 1 / (rate * transport_cells(scene, level).squares), c);
    transport_print_stages(scene, times);
    putchar('\n');
}

void transport_print_viscosity(const struct scene *scene, const struct model *model, unsigned l)
{
    char value[HUMAN_ROOM], width[HUMAN_ROOM];
    if (!model->viscosity[l].law) return;
    const struct transport_fluid fluid = transport_fluid(model, l);
    if (!(fluid.mu > 0)) return;
    double h = transport_cells(scene, scene->mesh.levels).h, nu = fluid.mu / fluid.rho, faces = 0.5 * h * fluid.c;
    double layer = sqrt(nu * scene->run.until);
    bool bends = coefficient_sees_rate(&model->viscosity[l].mu);
    printf("  %-12s viscosity %s%s at %g kg/m3 and 1 atm: %.3g m2/s; layers grow to %s in the run, %.3g of the finest "
           "cells\n",
           "", bends ? "at most " : "", human_si(fluid.mu, "Pa s", value), fluid.rho, nu, human_si(layer, "m", width),
           layer / h);
    transport_print_limits(scene, 4 / 1.8 * (4 * fluid.mu / 3 + fluid.zeta) / fluid.rho, fluid.c);
    printf("  %-12s jumps between cells are damped by up to %.3g m2/s, %.3g times that%s\n", "", faces, faces / nu,
           faces > nu && scene->scheme.low_mach == 1 ? " (scheme.low-mach: less)" : "");
}

void transport_print_heat(const struct scene *scene, const struct model *model, unsigned l)
{
    const struct conduction_facts facts = conduction_facts(model, l);
    char k[HUMAN_ROOM], width[HUMAN_ROOM];
    if (!scene->material[l].conductivity.module) return;
    double layer = sqrt(facts.k / facts.rho_cp * scene->run.until), h = transport_cells(scene, scene->mesh.levels).h;
    printf("  %-12s conducts %s at 25 C and 1 atm, cp %.4g J/kg/K", "", human_si(facts.k, "W/m/K", k), facts.cp);
    if (scene->material[l].real) printf(" (%s: %g)", scene->material[l].real, scene->material[l].real_cp);
    printf(": diffusivity %.3g m2/s\n", facts.k / facts.rho_cp);
    printf("  %-12s heat gets %s far in the run, %.3g of the finest cells\n", "", human_si(layer, "m", width),
           layer / h);
    transport_print_limits(scene, 1 / conduction_step(facts.k / facts.rho_cv, 1), transport_fluid(model, l).c);
}

void transport_print_gases(const struct scene *scene, const struct model *model)
{
    char width[HUMAN_ROOM];
    for (unsigned k = 0; k < scene->n_fick; k++) {
        const struct scene_fick *fick = &scene->ficks[k];
        double layer = sqrt(fick->D * scene->run.until), h = transport_cells(scene, scene->mesh.levels).h;
        printf("  %-12s", k ? "" : "gases");
        for (unsigned g = 0; g < fick->n; g++) printf("%s %s", g ? "," : "", scene->material[fick->gas[g]].name);
        printf(" diffuse: %.3g m2/s", fick->D);
        if (!fick->constant) printf(" at %g K and %g Pa, as T^1.75/p", fick->T, fick->p);
        printf("; they get %s far in the run, %.3g of the finest cells\n", human_si(layer, "m", width), layer / h);
        transport_print_limits(scene, DISTANCE_PACE * fick->D, transport_fluid(model, fick->gas[0]).c);
    }
}

/* The smallest sphere of one of two materials that the scene begins with; NULL: none. */
static const struct scene_layer *transport_sphere(const struct scene *scene, const struct scene_tension *pair)
{
    const struct scene_layer *found = NULL;
    for (unsigned i = 0; i < scene->n_layer; i++) {
        const struct scene_layer *layer = &scene->layers[i];
        bool filled = layer->has_material && layer->fractions &&
                      (layer->fractions[pair->one] == 1.0 || layer->fractions[pair->other] == 1.0);
        if (!filled || !layer->shape || layer->shape->type != SHAPE_SPHERE) continue;
        if (!found || layer->shape->radius < found->shape->radius) found = layer;
    }
    return found;
}

/* Laplace numbers sigma rho R/mu^2, of each viscous one of the two. */
static void transport_print_laplace(const struct scene *scene, const struct model *model,
                                    const struct scene_tension *pair)
{
    const struct scene_layer *sphere = transport_sphere(scene, pair);
    const unsigned both[] = {pair->one, pair->other};
    double R = sphere ? sphere->shape->radius : transport_side(scene);
    char length[HUMAN_ROOM];
    const char *comma = "laplace number";
    if (!model->viscosity[both[0]].law && !model->viscosity[both[1]].law) return;
    printf("  %-12s ", "");
    for (int i = 0; i < 2; i++) {
        const struct transport_fluid fluid = transport_fluid(model, both[i]);
        if (!(fluid.mu > 0)) continue;
        printf("%s %s %.2g", comma, scene->material[both[i]].name, pair->sigma * fluid.rho * R / (fluid.mu * fluid.mu));
        comma = ",";
    }
    if (sphere) printf(": in the sphere of initial[%d], %s\n", (int)(sphere - scene->layers), human_si(R, "m", length));
    else printf(": over the shortest side, %s\n", human_si(R, "m", length));
}

/* What waves of surface tension of the length of two cells allow: sqrt((rho_1 + rho_2) h^3/(4 pi sigma)). */
static void transport_print_capillary(const struct scene *scene, const struct model *model,
                                      const struct scene_tension *pair)
{
    const struct transport_fluid one = transport_fluid(model, pair->one), other = transport_fluid(model, pair->other);
    if (scene->domain.dim == 1) return; /* interfaces do not bend */
    printf("  %-12s steps of its waves:", "");
    for (int level = 0; level <= scene->mesh.levels; level++) {
        double h = transport_cells(scene, level).h;
        transport_print_step(scene, level, sqrt((one.rho + other.rho) * h * h * h / (4 * M_PI * pair->sigma)),
                             fmax(one.c, other.c));
    }
    putchar('\n');
}

void transport_print_tension(const struct scene *scene, const struct model *model, unsigned k)
{
    transport_print_laplace(scene, model, &scene->tension[k]);
    transport_print_capillary(scene, model, &scene->tension[k]);
}

/* What walls drag along with; scripts are not asked. */
static double transport_wall(const struct scene *scene)
{
    double most = 0;
    for (int face = 0; face < 2 * scene->domain.dim; face++) {
        const struct scene_boundary *wall = &scene->domain.boundary[face / 2][face % 2];
        for (int d = 0; wall->moves && d < scene->domain.n_velocity; d++)
            if (!wall->velocity[d].script) most = fmax(most, fabs(wall->velocity[d].number));
    }
    return most;
}

void transport_print_reynolds(const struct scene *scene, const struct model *model, double speed)
{
    char fast[HUMAN_ROOM], side[HUMAN_ROOM];
    double L = transport_side(scene), u = fmax(speed, transport_wall(scene));
    const char *comma = "";
    if (!model->viscous) return;
    printf("  %-12s", "reynolds");
    for (unsigned l = 0; l < scene->n_material; l++) {
        if (!model->viscosity[l].law) continue;
        const struct transport_fluid fluid = transport_fluid(model, l);
        printf("%s %s %.2g", comma, scene->material[l].name, fluid.rho * u * L / fluid.mu);
        comma = ",";
    }
    printf(": flow of %s (on a coarse copy, at the start) over the shortest side, %s\n", human_si(u, "m/s", fast),
           human_si(L, "m", side));
}

void transport_print_slow(const struct scene *scene, const struct model *model, double speed)
{
    double c = HUGE_VAL, u = fmax(speed, transport_wall(scene));
    if (scene->scheme.low_mach < 1 || !(model->viscous || scene->n_tension)) return;
    for (unsigned l = 0; l < scene->n_material; l++) c = fmin(c, transport_fluid(model, l).c);
    if (!(u < TRANSPORT_SLOW * c)) return;
    printf(
        "  %-12s flow of %.2g of the slowest speed of sound: with 'scheme: {low-mach: 0.05}' its motion is damped less "
        "by the mesh\n",
        "slow flow", u / c);
}

void transport_print_sticks(const struct scene *scene, const struct model *model)
{
    const char *comma = "";
    bool solid = false, fluid = false;
    for (unsigned l = 0; l < scene->n_material; l++) {
        bool elastic = scene->material[l].constitutive.module;
        solid = solid || elastic;
        fluid = fluid || (!elastic && model->viscosity[l].law);
    }
    if (!solid || !fluid) return;
    printf("  %-12s", "sticks");
    for (unsigned l = 0; l < scene->n_material; l++) {
        if (scene->material[l].constitutive.module || !model->viscosity[l].law) continue;
        printf("%s %s", comma, scene->material[l].name);
        comma = ",";
    }
    printf(" to solids: what is viscous does not slip along them\n");
}
