/* What counts as a material being there, and as its law being left: densities against the material's own mean, cells
 * with a weight only, fractions that matter only. */
#include "phys/presence.h"

#include "flow.h"
#include "phys/outside.h"

static void set_halves(const struct model *model, const double x[3], double *w)
{
    double air = x[0] < 0.5 ? 0.25 : 0.75;
    w[model->i_alpha] = 1.0 - air;
    w[model->i_alpha + 1] = air;
    w[model->i_m + 1] = x[0] < 0.5 ? 2.0 : 4.0;
}

static void start(struct flow *flow)
{
    flow_start(flow,
               mem_print("bulla: 1\ntitle: presence\ndomain: {lower: [0], upper: [1], cells: [16], boundaries: {x-: "
                         "outflow, x+: outflow}}\nmesh: {tile: 8}\nmaterials:\n  water: {eos: {type: mnasg, preset: "
                         "water}}\n" FLOW_AIR "initial:\n  - {everywhere: true, fractions: {water: 0.5, air: 0.5}, "
                         "density: {water: 1000, air: 1}, pressure: 1e5}\nrun: {until: 1}\n"));
}

/* A thousandth of mass over volume of the material itself: (0.25 x 2 + 0.75 x 4)/(0.25 + 0.75) kg/m3. */
static void test_density(void **state)
{
    (void)state;
    struct flow flow;
    start(&flow);
    flow_set(&flow, set_halves);
    double found = presence_density(flow.state->model, flow.state->mesh, 1);
    assert_true(fabs(found / 3.5e-3 - 1.0) < 1e-12);
    flow_stop(&flow);
}

/* Beyond the co-volume, in cells that count: by weight, by fraction; over more than one batch. */
static void test_outside(void **state)
{
    (void)state;
    enum { N = 1000 };
    struct flow flow;
    start(&flow);
    const struct model *model = flow.state->model;
    double *w = mem_new(model->n_field * N, sizeof *w), *weight = mem_new(N, sizeof *weight);
    size_t all = 0, heavy = 0;
    assert_true(outside_is_told(model, 0));
    for (size_t i = 0; i < N; i++) {
        bool far = i % 3 == 0, there = i % 2 == 0, leaf = i % 5 != 0;
        w[model->i_m * N + i] = far ? 1e5 : 1000.0;
        w[model->i_E * N + i] = 1e5;
        w[model->i_alpha * N + i] = there ? 0.5 : 0.5 * PRESENCE_FRACTION;
        weight[i] = leaf ? 1.0 : 0.0;
        all += far && there;
        heavy += far && there && leaf;
    }
    assert_true(heavy > 0 && heavy < all);
    assert_int_equal(outside_count(model, 0, N, N, w, NULL), all);
    assert_int_equal(outside_count(model, 0, N, N, w, weight), heavy);
    mem_free(w);
    mem_free(weight);
    flow_stop(&flow);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(test_density), cmocka_unit_test(test_outside)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
