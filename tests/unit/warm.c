/* Heat of the materials of mixed cells makes their fractions: one pressure, the volume that they had together, energy
 * to round-off, isentropic where a material got none of it, second order in how much that is; whatever laws and
 * fractions; no cell knows the others; surface tension stores what its lag pushes. */
#include "conduction.h"

#include "phys/row.h"
#include "phys/warm.h"

enum { POINTS = 300 };

#define BOX "lower: [0], upper: [1], cells: [8], boundaries: {x-: outflow, x+: outflow}"
#define IAPWS "  water: {eos: {type: iapws95}, conductivity: 0.607 W/m/K}\n"
#define NASG "  water: {eos: {type: nasg, preset: water}, conductivity: 0.607 W/m/K}\n"
#define GEL "  gel: {eos: {type: stiffened-gas, gamma: 4.4, p-inf: 600 MPa, cv: 590}, conductivity: 0.4 W/m/K}\n"

struct cells {
    struct flow flow;
    const struct model *model;
    double *w, *u, *heat, *got; /* [n_field][POINTS] */
};

static double *row(const struct cells *cells, double *block, unsigned q)
{
    (void)cells;
    return block + q * POINTS;
}

/* Cells of all fractions down to 1e-9, 1 kPa to 1 GPa, gases of 300 to 3000 K. */
static void begin(struct cells *cells, const char *materials)
{
    uint64_t seed = 5;
    start(&cells->flow, BOX, "", materials, "cfl: 0.4");
    const struct model *model = cells->model = cells->flow.state->model;
    size_t size = (size_t)model->n_field * POINTS;
    cells->w = mem_new(size, sizeof(double)), cells->u = mem_new(size, sizeof(double));
    cells->heat = mem_new(size, sizeof(double)), cells->got = mem_new(size, sizeof(double));
    for (size_t i = 0; i < POINTS; i++) {
        double p = 1e3 * pow(1e6, flow_random(&seed)), left = 1.0;
        for (unsigned l = 0; l < model->n_material; l++) {
            double T = model->eos[l].law->linear && l + 1 == model->n_material ? 300.0 * pow(10.0, flow_random(&seed))
                                                                               : 300.0 + 50.0 * flow_random(&seed);
            double small = pow(10.0, -9.0 * flow_random(&seed)), part = flow_random(&seed) < 0.5 ? small : 1.0 - small;
            double alpha = l + 1 == model->n_material ? left : left * part;
            left -= alpha;
            row(cells, cells->w, model->i_alpha + l)[i] = alpha;
            model->eos[l].law->density(model->eos[l].self, 1, &p, &T, &row(cells, cells->w, model->i_m + l)[i]);
        }
        row(cells, cells->w, model->i_u)[i] = 3.0;
        row(cells, cells->w, model->i_E)[i] = p;
    }
    mix_conserved(model, POINTS, POINTS, cells->w, cells->u);
}

static void end(struct cells *cells)
{
    mem_free(cells->w);
    mem_free(cells->u);
    mem_free(cells->heat);
    mem_free(cells->got);
    flow_stop(&cells->flow);
}

/* rho e of material l at pressure p, as the part alpha of a cell. */
static double energy(const struct cells *cells, unsigned l, double alpha, double rho, double p)
{
    double e, c2;
    cells->model->eos[l].law->state(cells->model->eos[l].self, 1, &rho, &p, &e, &c2);
    return alpha * e;
}

/* Each material gets up to `most` of its rho c^2 (a gas: of its energy) as heat, or loses it. */
static void give(struct cells *cells, double most)
{
    const struct model *model = cells->model;
    uint64_t seed = 9;
    for (size_t i = 0; i < POINTS; i++)
        for (unsigned l = 0; l < model->n_material; l++) {
            double p = row(cells, cells->w, model->i_E)[i], e, c2;
            model->eos[l].law->state(model->eos[l].self, 1, &row(cells, cells->w, model->i_m + l)[i], &p, &e, &c2);
            double part = l == 0 ? 0.01 * (2.0 * flow_random(&seed) - 1.0) : 2.0 * flow_random(&seed) - 1.0;
            cells->heat[l * POINTS + i] =
                most * part * row(cells, cells->w, model->i_alpha + l)[i] * (l ? p : 1e-3 * c2);
        }
}

/* Closes cells with the heat in their energy; the primitives into got. */
static void take(struct cells *cells, double *u)
{
    const struct model *model = cells->model;
    size_t size = (size_t)model->n_field * POINTS;
    memcpy(u, cells->u, size * sizeof *u);
    for (unsigned l = 0; l < model->n_material; l++)
        row_add(POINTS, cells->heat + l * POINTS, row(cells, u, model->i_E));
    warm_mix(model, POINTS, POINTS, cells->w, cells->heat, u);
    memcpy(cells->got, cells->w, size * sizeof *u);
    mix_primitives(model, POINTS, POINTS, u, cells->got);
}

static void check(const char *materials)
{
    struct cells cells;
    begin(&cells, materials);
    const struct model *model = cells.model;
    double *u = mem_new((size_t)model->n_field * POINTS, sizeof *u);
    int torn = 0;
    give(&cells, 0.3);
    take(&cells, u);
    for (size_t i = 0; i < POINTS; i++) {
        double p0 = row(&cells, cells.w, model->i_E)[i], p = row(&cells, cells.got, model->i_E)[i], sum = 0.0;
        unsigned last = model->n_material - 1;
        if (p < 0.0 &&
            row(&cells, cells.w, model->i_alpha + last)[i] < 1e-4) { /* a liquid that tears has no such state */
            torn++;
            continue;
        }
        assert_true(isfinite(p));
        for (unsigned l = 0; l < model->n_material; l++) {
            double a0 = row(&cells, cells.w, model->i_alpha + l)[i], a = row(&cells, u, model->i_alpha + l)[i];
            double rho0 = row(&cells, cells.w, model->i_m + l)[i], H = cells.heat[l * POINTS + i];
            double before = energy(&cells, l, a0, rho0, p0), after = energy(&cells, l, a, a0 * rho0 / a, p);
            double work = 0.5 * (p0 + p) * (a - a0), lost = after - before - H + work;
            sum += a; /* traces that fluxes do not see keep their volume, and their heat is everybody's */
            if (!(a0 > MIX_ABSENT)) continue;
            double noise = 1e-15 * (row(&cells, cells.u, model->i_E)[i] + 1e9);
            assert_true(fabs(lost) <= 1e-10 * (fabs(before) + fabs(H) + fabs(work)) + noise);
        }
        assert_true(fabs(sum - 1.0) < 1e-14);
    }
    assert_true(torn < POINTS / 20);
    mem_free(u);
    end(&cells);
}

static void test_one_pressure(void **state)
{
    (void)state;
    check(WATER AIR);
    check(NASG AIR);
    check(IAPWS AIR);
    check(WATER GEL AIR);
}

/* Gas that gets nothing is compressed on its isentrope, but for a part that falls with the cube of the heat. */
static void test_order(void **state)
{
    (void)state;
    struct cells cells;
    begin(&cells, WATER AIR);
    const struct model *model = cells.model;
    double *u = mem_new((size_t)model->n_field * POINTS, sizeof *u), error[3] = {0};
    for (size_t i = 0; i < POINTS; i++) {
        double p = 1e5, T = 300.0;
        row(&cells, cells.w, model->i_alpha)[i] = 0.5;
        row(&cells, cells.w, model->i_alpha + 1)[i] = 0.5;
        row(&cells, cells.w, model->i_E)[i] = p;
        for (unsigned l = 0; l < 2; l++)
            model->eos[l].law->density(model->eos[l].self, 1, &p, &T, &row(&cells, cells.w, model->i_m + l)[i]);
    }
    mix_conserved(model, POINTS, POINTS, cells.w, cells.u);
    for (int half = 0; half < 3; half++) {
        for (size_t i = 0; i < POINTS; i++) cells.heat[i] = 1e8 * ldexp(1.0, -half), cells.heat[POINTS + i] = 0.0;
        take(&cells, u);
        double p = row(&cells, cells.got, model->i_E)[0], a = row(&cells, u, model->i_alpha + 1)[0];
        assert_true(p > 1.02e5);
        error[half] = fabs(p / 1e5 * pow(a / 0.5, 1.4) - 1.0);
    }
    assert_true(error[0] / error[1] > 6.5 && error[1] / error[2] > 7.0 && error[2] < 1e-3);
    mem_free(u);
    end(&cells);
}

/* Cells without heat keep their bits; a cell has the same ones in another place of the row. */
static void test_alone(void **state)
{
    (void)state;
    struct cells cells;
    begin(&cells, WATER AIR);
    const struct model *model = cells.model;
    size_t size = (size_t)model->n_field * POINTS;
    double *u = mem_new(size, sizeof *u), *v = mem_new(size, sizeof *v);
    memset(cells.heat, 0, size * sizeof *u);
    take(&cells, u);
    assert_memory_equal(u, cells.u, size * sizeof *u);
    give(&cells, 0.3);
    take(&cells, u);
    memcpy(v, cells.u, size * sizeof *v);
    for (unsigned l = 0; l < model->n_material; l++)
        row_add(POINTS, cells.heat + l * POINTS, row(&cells, v, model->i_E));
    for (size_t i = POINTS; i-- > 0;) warm_mix(model, 1, POINTS, cells.w + i, cells.heat + i, v + i);
    assert_memory_equal(u, v, size * sizeof *u);
    mem_free(u);
    mem_free(v);
    end(&cells);
}

/* A surface of curvature kappa: its materials push each other at p + lag, and what it stores is missing in the cell. */
static void test_tension(void **state)
{
    (void)state;
    struct cells cells;
    flow_start(&cells.flow,
               mem_print("bulla: 1\ntitle: heat\ndomain: {geometry: spherical, lower: [0], upper: [1 mm], cells: [8], "
                         "boundaries: {x-: axis, x+: outflow}}\nmaterials:\n" WATER AIR
                         "surface-tension: {water+air: 0.0728 N/m}\ninitial:\n  - {everywhere: true, material: air, "
                         "density: 1.2, pressure: 1 atm}\nrun: {until: 1}\n"));
    const struct model *model = cells.model = cells.flow.state->model;
    assert_int_equal(model->n_pair, 1);
    double *w = mem_new(model->n_field, sizeof *w), *u = mem_new(model->n_field, sizeof *u), heat[2] = {0.0, 3e4};
    double p = 1e5, T = 300.0, jump = 0.0728 * 1e6;
    w[model->i_alpha] = 0.3, w[model->i_alpha + 1] = 0.7, w[model->i_E] = p;
    w[model->pairs[0].i_kappa] = model->pairs[0].inside == 1 ? 1e6 : -1e6;
    for (unsigned l = 0; l < 2; l++) model->eos[l].law->density(model->eos[l].self, 1, &p, &T, &w[model->i_m + l]);
    mix_conserved(model, 1, 1, w, u);
    double E = u[model->i_E], alpha = u[model->i_alpha + 1];
    u[model->i_E] += heat[1];
    warm_mix(model, 1, 1, w, heat, u);
    double moved = u[model->i_alpha + 1] - alpha, stored = E + heat[1] - u[model->i_E];
    assert_true(moved > 1e-7);
    assert_true(fabs(stored / (jump * moved) - 1.0) < 1e-6); /* lag of the air less that of the water: sigma kappa */
    mem_free(w);
    mem_free(u);
    flow_stop(&cells.flow);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_one_pressure),
        cmocka_unit_test(test_order),
        cmocka_unit_test(test_alone),
        cmocka_unit_test(test_tension),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
