/* transport.c - see transport.h. */
#include "run/transport.h"

#include "cli/human.h"
#include "phys/coefficient.h"
#include "scheme/conduction.h"
#include "scheme/distance.h"
#include "solve/rkl.h"

#include <math.h>
#include <stdio.h>

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

/* A viscous material in its reference state. */
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

/* Stages of rkl2 where steps of sound are so many times those of a diffusivity: of each stage of the integrator, or with levels
 * of the flows of all levels together, half a step of level 0 each, which the finest level asks for (solve/flow.h). */
static void transport_print_stages(const struct scene *scene, double times)
{
    int levels = scene->mesh.levels, own = rkl_stages(times);
    if (scene->scheme.diffusion != SCENE_DIFFUSION_RKL2) return;
    double half = 0.5 * ldexp(times, scene->mesh.subcycle ? levels : 0);
    if (levels && own) printf("; rkl2 takes %d stages of all levels before and after each step", rkl_stages(half));
    else printf(", rkl2 takes %d stages", own);
}

/* Steps that a diffusivity allows against those of sound, by level: what does not bind stands below 1. */
static void transport_print_limits(const struct scene *scene, double rate, double c)
{
    char step[HUMAN_ROOM];
    double times = 0;
    printf("  %-12s its steps:", "");
    for (int level = 0; level <= scene->mesh.levels; level++) {
        const struct transport_cells cells = transport_cells(scene, level);
        double own = 1 / (rate * cells.squares), sound = scene->scheme.cfl / (c * cells.sum);
        times = sound / own;
        printf("%s %s", level ? "," : "", human_si(own, "s", step));
        if (scene->mesh.levels) printf(" on level %d", level);
        printf(" (sound allows %.3g of that)", times);
    }
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
    printf("  %-12s viscosity %s at %g kg/m3 and 1 atm: %.3g m2/s; layers grow to %s in the run, %.3g of the finest "
           "cells\n",
           "", human_si(fluid.mu, "Pa s", value), fluid.rho, nu, human_si(layer, "m", width), layer / h);
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
    printf("  %-12s conducts %s at 25 C and 1 atm, cp %.4g J/kg/K: diffusivity %.3g m2/s\n", "",
           human_si(facts.k, "W/m/K", k), facts.cp, facts.k / facts.rho_cp);
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
    double L = HUGE_VAL, u = fmax(speed, transport_wall(scene));
    const char *comma = "";
    if (!model->viscous) return;
    for (int axis = 0; axis < scene->domain.dim; axis++)
        L = fmin(L, scene->domain.upper[axis] - scene->domain.lower[axis]);
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
