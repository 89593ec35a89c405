/* settle.c - cells of fluids and a solid that flows, brought to one traction (phys/settle.h): their volumes together
 * stay what they are, even of a film of gas that must give way by much. */
#include "flow.h"

#include "phys/settle.h"

enum { CELLS = 256 };

static uint64_t seed = 5;

static double between(double low, double high)
{
    return low * pow(high / low, flow_random(&seed));
}

/* Water and stone under shock, and a film of gas between them. */
static void squeezed(const struct model *model, const double x[3], double *w)
{
    double film = between(1e-5, 0.05), stone = between(2e-3, 0.9), p = between(1e6, 1e10);
    (void)x;
    w[model->i_alpha + 1] = film;
    w[model->i_alpha + 2] = (1.0 - film) * stone;
    w[model->i_alpha] = 1.0 - w[model->i_alpha + 1] - w[model->i_alpha + 2];
    w[model->i_m] = between(900.0, 2500.0);
    w[model->i_m + 1] = between(1e-10, 10.0);
    w[model->i_m + 2] = between(1900.0, 3000.0);
    w[model->i_u] = 30.0;
    w[model->i_E] = p;
}

static void test_volumes(void **state)
{
    (void)state;
    struct flow flow;
    flow_start(&flow,
               mem_print("bulla: 1\ndomain: {lower: [0], upper: [1], cells: [%d], boundaries: {x-: periodic, x+: "
                         "periodic}}\nmesh: {tile: %d}\nmaterials:\n" FLOW_WATER FLOW_AIR
                         "  stone: {eos: {type: stiffened-gas, gamma: 4.4, p-inf: 5 GPa, cv: 2451}, constitutive: "
                         "{type: neo-hookean, shear-modulus: 5 GPa, reference-density: 2000}, plastic: {type: "
                         "von-mises, yield: 20 MPa}}\ninitial:\n  - {everywhere: true, material: water, density: "
                         "1000, pressure: 1 bar}\nrun: {until: 1}\n",
                         CELLS, CELLS));
    flow_set(&flow, squeezed);
    const struct model *model = flow.state->model;
    double *u = flow_level(&flow)->u_old[0], *w = flow_level(&flow)->w[0], worst = 0.0;
    double *before = mem_new(model->n_field * CELLS, sizeof *before);
    double *p = mem_new(6 * CELLS, sizeof *p), *stiff = p + 3 * CELLS;
    int moved = 0;
    memcpy(before, u, model->n_field * CELLS * sizeof *u);
    mix_stiffness(model, CELLS, CELLS, w, stiff);
    for (size_t i = 0; i < 3 * CELLS; i++) p[i] = w[model->i_E * CELLS + i % CELLS] * between(0.5, 2.0);
    settle_fluids(model, CELLS, CELLS, p, stiff, u);
    for (size_t i = 0; i < CELLS; i++) {
        double sum = -1.0;
        for (unsigned l = 0; l < 3; l++) sum += u[(model->i_alpha + l) * CELLS + i];
        for (unsigned q = model->i_m; q < model->i_V; q++) assert_true(u[q * CELLS + i] == before[q * CELLS + i]);
        moved += u[model->i_alpha * CELLS + i] != before[model->i_alpha * CELLS + i];
        worst = fabs(sum) > worst ? fabs(sum) : worst;
        for (unsigned l = 0; l < 3; l++) assert_true(u[(model->i_alpha + l) * CELLS + i] > 0.0);
    }
    print_message("%d of %d cells changed; volumes together off by %.2g\n", moved, CELLS, worst);
    assert_true(moved > CELLS / 2 && worst < 2e-3);
    mem_free(before);
    mem_free(p);
    flow_stop(&flow);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(test_volumes)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
