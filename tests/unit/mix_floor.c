/* The pressure of a mixture lies above what each of its materials bears, however little there is of it; only what
 * nobody feels (MIX_PRESSURE_FELT) does not count. */
#include "flow.h"

/* Iterated water and air: laws without their closed form. */
struct pair {
    struct flow flow;
    struct model model;
    struct bulla_eos hidden[2];
};

static void start(struct pair *pair)
{
    flow_start(&pair->flow,
               mem_print("bulla: 1\ntitle: floor\ndomain: {lower: [0], upper: [1], cells: [8], boundaries: "
                         "{x-: outflow, x+: outflow}}\nmaterials:\n" FLOW_WATER FLOW_AIR
                         "initial:\n  - {everywhere: true, material: water, density: 1000, pressure: 1 "
                         "bar}\nrun: {until: 1}\n"));
    pair->model = *pair->flow.state->model;
    for (unsigned l = 0; l < 2; l++) {
        pair->hidden[l] = *pair->model.eos[l].law;
        pair->hidden[l].linear = NULL;
        pair->model.eos[l].law = &pair->hidden[l];
    }
    pair->model.linear = false;
}

/* Closes water with `air` of gas whose energy asks for a pressure p. */
static struct mix_effort close_at(const struct model *model, double air, double p, double *ret_p)
{
    double w[FLOW_FIELDS] = {0}, u[FLOW_FIELDS];
    w[model->i_alpha] = 1.0 - air;
    w[model->i_alpha + 1] = air;
    w[model->i_m] = 1000.0;
    w[model->i_m + 1] = 1.0;
    w[model->i_E] = p;
    mix_conserved(model, 1, 1, w, u);
    w[model->i_E] = 1e5;
    struct mix_effort effort = mix_primitives(model, 1, 1, u, w);
    *ret_p = w[model->i_E];
    return effort;
}

static void test_floor(void **state)
{
    (void)state;
    static const double felt[] = {0.9, 0.1, 1e-2, 1e-4};
    struct pair pair;
    double p;
    start(&pair);
    for (size_t i = 0; i < sizeof felt / sizeof *felt; i++) {
        assert_int_equal(close_at(&pair.model, felt[i], 2e5, &p).failed, 0);
        assert_true(fabs(p - 2e5) < 1.0);
        struct mix_effort effort = close_at(&pair.model, felt[i], -1e6, &p);
        print_message("air %g: %lld failed, p = %g Pa\n", felt[i], effort.failed, p);
        assert_true(effort.failed == 1 && p < 0.0 &&
                    p >= -2.0); /* just below what the gas bears: the guard will see it */
    }
    assert_int_equal(close_at(&pair.model, 0.1 * MIX_PRESSURE_FELT, -1e6, &p).failed, 0);
    assert_true(fabs(p + 1e6) < 10.0); /* tension, which water bears */
    flow_stop(&pair.flow);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(test_floor)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
