/* Regridding: hundreds of regrids leave fractions in their bounds and what is conserved where it was; one that changes
 * nothing touches no bit; fine data dropped and made again is what averages and interpolation say. */
#include "amr.h"

#define BOX2 "boundaries: {x-: periodic, x+: periodic, y-: periodic, y+: periodic}"

static char *bubble_case(const char *domain, const char *mesh, const char *shape, const char *velocity)
{
    return mem_print("bulla: 1\ntitle: moving bubble\ndomain: %s\n"
                     "mesh: {%s}\nmaterials:\n" FLOW_WATER FLOW_HELIUM FLOW_AIR "initial:\n"
                     "  - {everywhere: true, material: water, density: 1000, pressure: 1e6, velocity: %s}\n"
                     "  - {%s, fractions: {air: 0.7, helium: 0.3}, density: {air: 1.2, helium: 0.17}, pressure: 1e5, "
                     "velocity: %s}\nscheme: {limiter: superbee}\nrun: {until: 1}\n",
                     domain, mesh, velocity, shape, velocity);
}

/* Steps with checks of bounds after each regrid. */
static void check_many(const char *name, char *text, int steps, int regrids)
{
    struct flow flow;
    flow_start(&flow, text);
    const struct model *model = flow.state->model;
    double size[FLOW_FIELDS], now, worst = 0.0;
    long double before[FLOW_FIELDS];
    for (unsigned q = model->i_m; q < model->n_field; q++) before[q] = amr_total(&flow, q, &size[q]);
    for (int step = 0; step < steps; step++) {
        flow_steps(&flow, 1);
        if (step % 5 == 4) worst = fmax(worst, amr_fraction_fault(&flow));
    }
    amr_print(&flow, name);
    print_message("  fractions off by %.1e, %lld coarse cells limited at births\n", worst, flow.state->counts.limited);
    assert_true(worst <= 1e-15 * 4);
    assert_true(flow.state->counts.regrids >= regrids);
    for (unsigned q = model->i_m; q < model->n_field; q++) {
        long double drift = amr_total(&flow, q, &now) - before[q];
        if (!(fabsl(drift) <= 1e-14L * fmax(size[q], now))) fail_msg("%s drifts by %Lg", model->field_names[q], drift);
    }
    flow_stop(&flow);
}

static void test_many(void **state)
{
    (void)state;
    check_many("line",
               bubble_case("{lower: [0], upper: [1], cells: [64], boundaries: {x-: periodic, x+: periodic}}",
                           "levels: 3, tile: 8, regrid-every: 1, buffer: 2, patience: 1, refine: [{jump: alpha_air, "
                           "above: 0.01}]",
                           "box: {lower: [0.3], upper: [0.5]}", "[900]"),
               500, 290);
    check_many("plane",
               bubble_case("{lower: [0, 0], upper: [1, 1], cells: [16, 16], " BOX2 "}",
                           "levels: 2, tile: 4, regrid-every: 1, buffer: 2, patience: 1, refine: [{jump: alpha_air, "
                           "above: 0.05}]",
                           "sphere: {center: [0.4, 0.5], radius: 0.2}", "[700, 300]"),
               120, 100);
}

/* An interface that crosses faces between levels at an angle: coarse cells cannot always bear what the fine fluxes take
 * from them, and pass it on to others that hold it, in the end to the fine cells. */
static void test_spread(void **state)
{
    (void)state;
    static const char *const DOMAINS[] = {
        "{lower: [0, 0], upper: [1, 1], cells: [16, 16], " BOX2 "}",
        "{geometry: axisymmetric, lower: [0, 0], upper: [1, 1], cells: [16, 16], boundaries: {x-: axis, x+: "
        "reflecting, "
        "y-: periodic, y+: periodic}}",
    };
    for (int i = 0; i < 2; i++) {
        struct flow flow;
        flow_start(&flow, bubble_case(DOMAINS[i],
                                      "levels: 2, tile: 4, regrid-every: 2, buffer: 2, patience: 1, refine: [{region: "
                                      "{box: {lower: [0.55, 0.3], upper: [0.8, 0.55]}}}]",
                                      "sphere: {center: [0.45, 0.45], radius: 0.2}",
                                      i ? "['= 300 * x * (1 - x)', 900]" : "[900, 350]"));
        const struct model *model = flow.state->model;
        double size[FLOW_FIELDS], now;
        long double before[FLOW_FIELDS];
        for (unsigned q = model->i_m; q < model->n_field; q++) before[q] = amr_total(&flow, q, &size[q]);
        flow_steps(&flow, 150);
        amr_print(&flow, "spread");
        assert_true((i || flow.state->counts.spread > 0) && amr_fraction_fault(&flow) <= 1e-15 * 4);
        for (unsigned q = model->i_m; q < model->n_field; q++) {
            double drift = (double)fabsl(amr_total(&flow, q, &now) - before[q]) / fmax(size[q], now);
            print_message("  %s: relative drift %.1e\n", model->field_names[q], drift);
            if (i && q == model->i_u) continue;
            assert_true(drift <= 1e-14);
        }
        flow_stop(&flow);
    }
}

/* Levels that come and go as a window moves over a flow: everything is born and dropped again and again. */
static void test_window(void **state)
{
    (void)state;
    check_many("window",
               bubble_case("{lower: [0, 0], upper: [1, 1], cells: [24, 24], " BOX2 "}",
                           "levels: 2, tile: 4, regrid-every: 1, buffer: 2, patience: 1, refine: [{lua: '= math.abs(x "
                           "- 0.5 - 0.35 * math.sin(4e4 * t)) < 0.1'}]",
                           "sphere: {center: [0.4, 0.5], radius: 0.25}", "[200, 100]"),
               60, 60);
}

/* All three arrays of all tiles, in one piece. */
static double *everything(const struct flow *flow, size_t *ret_n)
{
    const struct mesh *mesh = flow->state->mesh;
    size_t block = mesh->n_field * mesh->n_cell, n = 0;
    for (int l = 0; l < mesh->n_level; l++) n += 2 * block * mesh->levels[l].n_tile;
    double *all = mem_new(n, sizeof *all), *next = all;
    for (int l = 0; l < mesh->n_level; l++)
        for (unsigned t = 0; t < mesh->levels[l].n_tile; t++, next += 2 * block) {
            memcpy(next, mesh->levels[l].u_old[t], block * sizeof *all);
            memcpy(next + block, mesh->levels[l].w[t], block * sizeof *all);
        }
    *ret_n = n;
    return all;
}

static void test_idle(void **state)
{
    (void)state;
    struct flow flow, other;
    size_t n, m;
    const char *domain = "{lower: [0, 0], upper: [1, 1], cells: [32, 32], " BOX2 "}";
    const char *mesh =
        "levels: 2, tile: 8, regrid-every: 4, patience: 2, refine: [{region: {box: {lower: [0.3, 0.3], "
        "upper: [0.6, 0.5]}}}, {interface: air, finest: 1, where: {box: {lower: [0, 0], upper: [1, 1]}}}]";
    const char *shape = "sphere: {center: [0.4, 0.5], radius: 0.2}";
    flow_start(&flow, bubble_case(domain, mesh, shape, "[100, 50]"));
    flow_start(&other, bubble_case(domain, mesh, shape, "[100, 50]"));
    flow_steps(&flow, 4);
    flow_steps(&other, 4);
    assert_int_equal(flow.state->mesh->n_level, 3);
    unsigned revision = flow.state->mesh->revision;
    long long regrids = flow.state->counts.regrids;
    double *before = everything(&flow, &n);
    for (int i = 0; i < 3; i++)
        for (int l = 0; l < 2; l++)
            if (regrid_levels(flow.state, l)) fail_msg("%s", status_text());
    double *after = everything(&flow, &m);
    assert_true(n == m);
    assert_memory_equal(before, after, n * sizeof *before);
    assert_true(flow.state->mesh->revision == revision && flow.state->counts.regrids == regrids);
    flow_steps(&flow, 3); /* and what follows is what would have been */
    flow_steps(&other, 3);
    assert_true(amr_equal(&flow, &other));
    mem_free(before);
    mem_free(after);
    flow_stop(&flow);
    flow_stop(&other);
}

/* A tile goes when `patience` regrids in a row have found no use for it, not before. */
static void test_patience(void **state)
{
    (void)state;
    struct flow flow;
    flow_start(&flow,
               bubble_case("{lower: [0], upper: [1], cells: [64], boundaries: {x-: periodic, x+: periodic}}",
                           "levels: 1, tile: 8, regrid-every: 1, buffer: 2, patience: 3, refine: [{region: {box: "
                           "{lower: [0.3], upper: [0.5]}}, until: 1 ns}]",
                           "box: {lower: [0.3], upper: [0.5]}", "[0]"));
    unsigned tiles = flow.state->mesh->levels[1].n_tile;
    assert_int_equal(flow.state->mesh->n_level, 2);
    flow_steps(&flow, 2);
    assert_int_equal(flow.state->mesh->n_level, 2);
    assert_int_equal(flow.state->mesh->levels[1].n_tile, tiles);
    flow_steps(&flow, 1);
    assert_int_equal(flow.state->mesh->n_level, 1);
    flow_stop(&flow);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_many), cmocka_unit_test(test_spread),   cmocka_unit_test(test_window),
        cmocka_unit_test(test_idle), cmocka_unit_test(test_patience),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
