/* Interfaces across faces between levels: at uniform pressure and velocity both stay uniform while a contact of density
 * ratio 1000 passes from level to level, through a patch that stands and with levels that follow it; fractions stay
 * in [0, 1] and sum to 1. */
#include "amr.h"

enum { STEPS = 260 };

static const char *const PAIRS[] = {
    FLOW_WATER FLOW_AIR,
    "  water: {eos: {type: nasg}}\n" FLOW_AIR,
    "  water: {eos: {type: mnasg}}\n  air: {eos: {type: nasg}}\n",
    FLOW_WATER "  oil: {eos: {type: mnasg}}\n" FLOW_AIR,
};
enum { N_PAIR = sizeof PAIRS / sizeof *PAIRS };

#define LINE "{lower: [0], upper: [1], cells: [64], boundaries: {x-: periodic, x+: periodic}}"
#define PLANE                                                                                                     \
    "{lower: [0, 0], upper: [1, 1], cells: [32, 32], boundaries: {x-: periodic, x+: periodic, y-: periodic, y+: " \
    "periodic}}"
#define TUBE                                                                                                          \
    "{geometry: axisymmetric, lower: [0, 0], upper: [1, 1], cells: [32, 32], boundaries: {x-: axis, x+: reflecting, " \
    "y-: periodic, y+: periodic}}"

struct setup {
    const char *name, *domain, *levels, *refine, *shape, *velocity;
};

static const struct setup SETUPS[] = {
    {"line, patch", LINE, "levels: 2, tile: 8", "{region: {box: {lower: [0.55], upper: [0.7]}}}",
     "box: {lower: [0.2], upper: [0.5]}", "[400]"},
    {"line back, patch", LINE, "levels: 2, tile: 8", "{region: {box: {lower: [0.05], upper: [0.12]}}}",
     "box: {lower: [0.2], upper: [0.5]}", "[-400]"},
    {"line, moving", LINE, "levels: 3, tile: 8", "{interface: air}", "box: {lower: [0.2], upper: [0.52]}", "[400]"},
    {"plane, patch", PLANE, "levels: 2, tile: 8", "{region: {box: {lower: [0.6, 0.3], upper: [0.8, 0.7]}}}",
     "sphere: {center: [0.4, 0.5], radius: 0.23}", "[400, 150]"},
    {"plane, moving", PLANE, "levels: 2, tile: 8", "{interface: air}", "sphere: {center: [0.4, 0.5], radius: 0.23}",
     "[400, 150]"},
    {"tube, patch", TUBE, "levels: 2, tile: 8", "{region: {box: {lower: [0, 0.6], upper: [0.2, 0.8]}}}",
     "box: {lower: [0, 0.2], upper: [0.5, 0.5]}", "[0, 400]"},
};

static char *contact_case(const struct setup *setup, const char *materials, const char *more)
{
    return mem_print("bulla: 1\ntitle: contact\ndomain: %s\n"
                     "mesh: {%s, regrid-every: 2, buffer: 2, patience: 1, refine: [%s]}\nmaterials:\n%sinitial:\n"
                     "  - {everywhere: true, material: air, density: 1, pressure: 1e5, velocity: %s}\n"
                     "  - {%s, material: water, density: 1000, pressure: 1e5, velocity: %s}\n"
                     "scheme: {cfl: 0.5%s}\nrun: {until: 1}\n",
                     setup->domain, setup->levels, setup->refine, materials, setup->velocity, setup->shape,
                     setup->velocity, more);
}

static void check(const struct setup *setup, const char *materials, const char *more)
{
    struct flow flow;
    flow_start(&flow, contact_case(setup, materials, more));
    const struct model *model = flow.state->model;
    const struct level *root = &flow.state->mesh->levels[0];
    double first[3] = {0}, worst_p = 0.0, worst_u = 0.0, worst_alpha = 0.0;
    for (int d = 0; d < model->dim; d++) first[d] = root->w[0][(model->i_u + (unsigned)d) * flow.state->mesh->n_cell];
    for (int step = 0; step < STEPS / model->dim; step++) {
        flow_steps(&flow, 1);
        if (step % 10 != 9) continue;
        worst_p = fmax(worst_p, amr_deviation(&flow, model->i_E, 1e5) / (4.4 * 6e8));
        for (int d = 0; d < model->dim; d++)
            worst_u = fmax(worst_u, amr_deviation(&flow, model->i_u + (unsigned)d, first[d]) / 1625.0);
        worst_alpha = fmax(worst_alpha, amr_fraction_fault(&flow));
    }
    amr_print(&flow, setup->name);
    print_message("  p off by %.1e of rho c2, u by %.1e of c, fractions by %.1e\n", worst_p, worst_u, worst_alpha);
    assert_true(worst_p <= 1e-12);
    assert_true(worst_u <= 1e-12);
    assert_true(worst_alpha <= 1e-15 * 4);
    flow_stop(&flow);
}

static void test_all(void **state)
{
    (void)state;
    for (size_t i = 0; i < sizeof SETUPS / sizeof *SETUPS; i++)
        for (int pair = 0; pair < N_PAIR; pair++) {
            if (SETUPS[i].domain[0] && strstr(SETUPS[i].domain, "y-") && pair > 1) continue;
            check(&SETUPS[i], PAIRS[pair], pair % 2 ? ", closure: allaire" : "");
        }
}

static void test_schemes(void **state)
{
    (void)state;
    check(&SETUPS[0], PAIRS[0], ", riemann: hll, limiter: superbee");
    check(&SETUPS[2], PAIRS[1], ", riemann: rusanov, limiter: minmod, interface-limiter: mc");
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_all),
        cmocka_unit_test(test_schemes),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
