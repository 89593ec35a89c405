/* Conservation with refinement: masses, momentum and energy over 100 coarse steps with levels that move, to 1e-14 of
 * what there is, in every dimension and geometry; without refluxing the same check must fail. */
#include "amr.h"

enum { STEPS = 100 };

#define BOX1 "boundaries: {x-: periodic, x+: periodic}"
#define BOX2 "boundaries: {x-: periodic, x+: periodic, y-: periodic, y+: periodic}"
#define BOX3 "boundaries: {x-: periodic, x+: periodic, y-: periodic, y+: periodic, z-: periodic, z+: periodic}"

struct setup {
    const char *name, *domain, *mesh, *velocity, *core, *bubble;
    int skip; /* a momentum that walls or hoops feed, or -1 */
};

static const struct setup SETUPS[] = {
    {"line", "{lower: [0], upper: [1], cells: [64], " BOX1 "}", "levels: 3, tile: 8", "[300]", "[0.4]", "[0.85]", -1},
    {"closed line", "{lower: [0], upper: [1], cells: [64], boundaries: {x-: reflecting, x+: symmetry}}",
     "levels: 3, tile: 8", "[30]", "[0.4]", "[0.85]", 0},
    {"plane", "{lower: [0, 0], upper: [1, 1], cells: [32, 32], " BOX2 "}", "levels: 2, tile: 8", "[200, -100]",
     "[0.4, 0.5]", "[0.8, 0.6]", -1},
    {"space", "{lower: [0, 0, 0], upper: [1, 1, 1], cells: [8, 8, 8], " BOX3 "}", "levels: 2, tile: 4",
     "[200, -100, 50]", "[0.4, 0.5, 0.5]", "[0.8, 0.6, 0.5]", -1},
    {"axisymmetric",
     "{geometry: axisymmetric, lower: [0, 0], upper: [1, 1], cells: [32, 32], "
     "boundaries: {x-: axis, x+: reflecting, y-: periodic, y+: periodic}}",
     "levels: 2, tile: 8", "[0, 200]", "[0, 0.4]", "[0, 0.8]", 0},
    {"swirl",
     "{geometry: axisymmetric, velocity-components: 3, lower: [0, 0], upper: [1, 1], cells: [32, 32], "
     "boundaries: {x-: axis, x+: reflecting, y-: periodic, y+: periodic}}",
     "levels: 2, tile: 8", "[0, 200, '= 100 * x']", "[0, 0.4]", "[0.3, 0.8]", 0},
    {"spherical", "{geometry: spherical, lower: [0], upper: [1], cells: [64], boundaries: {x-: axis, x+: reflecting}}",
     "levels: 3, tile: 8", "[0]", "[0.6]", "[0]", 0},
};
enum { N_SETUP = sizeof SETUPS / sizeof *SETUPS };

static char *blast(const struct setup *setup, const char *more)
{
    return mem_print(
        "bulla: 1\ntitle: conservation\ndomain: %s\n"
        "mesh: {%s, regrid-every: 2, buffer: 2, patience: 1, %s, refine: [{jump: alpha_air, above: 0.1}, "
        "{jump: pressure, above: 0.9, finest: 1}]}\n"
        "materials:\n" FLOW_WATER FLOW_AIR "initial:\n"
        "  - {everywhere: true, material: water, density: 1000, pressure: 1e5, velocity: %s}\n"
        "  - {sphere: {center: %s, radius: 0.2}, material: water, density: 1150, pressure: 1e9}\n"
        "  - {sphere: {center: %s, radius: 0.12}, material: air, density: 1.2, pressure: 1e5, velocity: %s}\n"
        "run: {until: 1}\n",
        setup->domain, setup->mesh, more, setup->velocity, setup->core, setup->bubble, setup->velocity);
}

/* The largest relative drift of all conserved sums. */
static double worst_drift(const struct setup *setup, const char *more, int steps, int regrids)
{
    struct flow flow;
    flow_start(&flow, blast(setup, more));
    const struct model *model = flow.state->model;
    double size[FLOW_FIELDS], now, worst = 0.0;
    long double before[FLOW_FIELDS];
    for (unsigned q = model->i_m; q < model->n_field; q++) before[q] = amr_total(&flow, q, &size[q]);
    flow_steps(&flow, steps);
    amr_print(&flow, setup->name);
    for (unsigned q = model->i_m; q < model->n_field; q++) {
        if (setup->skip >= 0 && q == model->i_u + (unsigned)setup->skip) continue;
        long double drift = amr_total(&flow, q, &now) - before[q];
        double off = (double)fabsl(drift) / fmax(size[q], now);
        print_message("  %s: relative drift %.1e\n", model->field_names[q], off);
        worst = off <= worst ? worst : off;
    }
    assert_true(flow.state->counts.regrids >= regrids);
    flow_stop(&flow);
    return worst;
}

static void test_kept(void **state)
{
    (void)state;
    for (int i = 0; i < N_SETUP; i++) {
        double worst = worst_drift(&SETUPS[i], "subcycle: true", STEPS, 20);
        if (!(worst <= 1e-14)) fail_msg("%s: drift %g", SETUPS[i].name, worst);
    }
}

static void test_kept_in_one_step(void **state)
{
    (void)state;
    for (int i = 0; i < N_SETUP; i++) {
        double worst = worst_drift(&SETUPS[i], "subcycle: false", STEPS, 3);
        if (!(worst <= 1e-14)) fail_msg("%s: drift %g", SETUPS[i].name, worst);
    }
}

/* The check can fail: fluxes that nobody corrects lose mass. */
static void test_lost(void **state)
{
    (void)state;
    for (int i = 0; i < N_SETUP; i++) {
        double worst = worst_drift(&SETUPS[i], "reflux: off", STEPS / 2, 10);
        if (!(worst > 1e-10)) fail_msg("%s: drift of only %g without refluxing", SETUPS[i].name, worst);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_kept),
        cmocka_unit_test(test_kept_in_one_step),
        cmocka_unit_test(test_lost),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
