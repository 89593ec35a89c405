/* The closure of mixtures in a step: slow compression raises the pressure by Wood's stiffness, not by the frozen one;
 * and the exchange of volume takes no more than a part of what a material has, whatever faces bring; what is cut off
 * counts if it is more than a trace. */
#include "flow.h"

#include "scheme/closure.h"
#include "scheme/convection.h"
#include "scheme/exchange.h"
#include "scheme/rate.h"

static void start_with(struct flow *flow, const char *water)
{
    flow_start(flow,
               mem_print("bulla: 1\ntitle: closure\ndomain: {lower: [0], upper: [1], cells: [64], boundaries: {x-: "
                         "periodic, x+: periodic}}\nmaterials:\n%s" FLOW_AIR
                         "initial:\n  - {everywhere: true, fractions: {water: 0.6, air: 0.4}, density: {water: 1000, "
                         "air: 1.2}, pressure: 1e5}\nscheme: {dt: 0.1 us}\nrun: {until: 1}\n",
                         water));
}

static void start(struct flow *flow)
{
    start_with(flow, FLOW_WATER);
}

static void set_breath(const struct model *model, const double x[3], double *w)
{
    w[model->i_u] = 0.1 * sin(2.0 * M_PI * x[0]);
}

/* dp = -dt rho c_w^2 du/dx, 1/(rho c_w^2) = sum alpha_l/(rho_l c_l^2). */
static void test_wood(void **state)
{
    (void)state;
    struct flow flow;
    start(&flow);
    flow_set(&flow, set_breath);
    flow_steps(&flow, 1);
    double stiffness = 1.0 / (0.6 / (4.4 * (1e5 + 6e8)) + 0.4 / (1.4 * 1e5)), worst = 0.0;
    double *p = flow_primitive(&flow, flow.state->model->i_E), most = 1e-7 * stiffness * 0.1 * 2.0 * M_PI;
    for (size_t i = 0; i < flow.n_cell; i++) {
        double x[3];
        flow_centre(&flow, i, x);
        worst = fmax(worst, fabs(p[i] - 1e5 + most * cos(2.0 * M_PI * x[0])));
    }
    print_message("pressure rises by %.3e Pa, off by %.1e\n", most, worst);
    assert_true(worst < 0.1 * most);
    mem_free(p);
    flow_stop(&flow);
}

/* Rates that bring any pressure and strain, in a flow so fast that all of the exchange is wanted. Water that is alone
 * exchanges nothing, to the bit. */
static void test_most(void **state)
{
    (void)state;
    struct flow flow;
    uint64_t seed = 12;
    start(&flow);
    const struct model *model = flow.state->model;
    size_t n = flow.state->mesh->n_cell;
    struct terms *terms = terms_new(model, NULL);
    void *own[TERMS_MOST] = {0};
    double *rates = mem_new(terms->n_rates * n, sizeof *rates), *u_old = mem_new(model->n_field * n, sizeof *u_old);
    double *w = mem_new(model->n_field * n, sizeof *w), *u_new = mem_new(model->n_field * n, sizeof *u_new);
    double *K = mem_new(2 * n, sizeof *K), *rho_c2 = mem_new(2 * n, sizeof *rho_c2);
    for (int round = 0; round < 20; round++) {
        for (size_t i = 0; i < n; i++) {
            double air = pow(10.0, -6.0 * flow_random(&seed));
            air = flow_random(&seed) < 0.5 ? air : 1.0 - air;
            air = i % 8 == 3 ? 0.0 : air;
            w[i] = 1.0 - air;
            w[n + i] = air;
            w[model->i_m * n + i] = 1000.0;
            w[(model->i_m + 1) * n + i] = 1e-6;
            w[model->i_u * n + i] = 1e5;
            w[model->i_E * n + i] = 0.1;
            rho_c2[i] = 2.6e9;
            rho_c2[n + i] = 0.14;
            for (unsigned l = 0; l < 2; l++) {
                double *carried = rates + (terms_first(terms, &exchange_term) + l) * n + i;
                *carried = 1e9 * (flow_random(&seed) - 0.5);
                carried[2 * n] = 1e3 * (flow_random(&seed) - 0.5);
            }
        }
        mix_conserved(model, n, n, w, u_old);
        struct term_tile tile = {.terms = terms, .model = model, .level = flow_level(&flow), .n_cell = n, .dt = 1e-3};
        tile.u = u_old;
        tile.w = w;
        tile.rates = rates;
        tile.K = K;
        tile.rho_c2 = rho_c2;
        rate_apply(&tile, own, u_new);
        for (size_t i = 0; i < n; i++) assert_true(w[i] < 1.0 || exchange_volume(&tile)[i] == 0.0);
        for (size_t i = 0; i < 2 * n; i++) {
            double moved = u_new[i] - w[i];
            assert_true(moved >= -EXCHANGE_MOST * w[i] - 1e-8);
            assert_true(moved <= EXCHANGE_MOST * w[i] + EXCHANGE_TRACE + 1e-8);
        }
    }
    terms_free(terms);
    double *all[] = {rates, u_old, w, u_new, K, rho_c2};
    for (size_t k = 0; k < sizeof all / sizeof *all; k++) mem_free(all[k]);
    flow_stop(&flow);
}

/* Compression that would take twice what a material has: half of a cell counts, a trace does not. */
static void test_counts(void **state)
{
    (void)state;
    struct flow flow;
    start(&flow);
    const struct model *model = flow.state->model;
    size_t n = flow.state->mesh->n_cell;
    struct terms *terms = terms_new(model, NULL);
    double *rates = mem_new(terms->n_rates * n, sizeof *rates), *K = mem_new(2 * n, sizeof *K);
    double *u_new = mem_new(model->n_field * n, sizeof *u_new);
    double *div = rates + terms_first(terms, &convection_term) * n;
    for (size_t i = 0; i < n; i++) {
        double air = i == 0 ? 0.5 : i == 1 ? 1e-8 : 0.0;
        u_new[i] = 1.0 - air;
        u_new[n + i] = air;
        K[n + i] = 2.0 * air;
        div[i] = 1e3;
    }
    struct term_tile tile = {.terms = terms, .model = model, .n_cell = n, .dt = 1e-3, .rates = rates, .K = K};
    assert_int_equal(closure_term.apply(&tile, u_new), 1);
    assert_true(u_new[n] == 0.5 * CLOSURE_SHRINK && u_new[n + 1] == 1e-8 * CLOSURE_SHRINK);
    terms_free(terms);
    mem_free(rates);
    mem_free(K);
    mem_free(u_new);
    flow_stop(&flow);
}

/* A trace of a law that stiffens is not squeezed beyond four times what it states; others bear anything. */
static double squeezed(const char *water, double m)
{
    struct flow flow;
    start_with(&flow, water);
    const struct model *model = flow.state->model;
    size_t n = flow.state->mesh->n_cell;
    struct terms *terms = terms_new(model, NULL);
    double *rates = mem_new(terms->n_rates * n, sizeof *rates), *K = mem_new(2 * n, sizeof *K);
    double *u_new = mem_new(model->n_field * n, sizeof *u_new);
    for (size_t i = 0; i < n; i++) {
        u_new[i] = 1e-8;
        u_new[n + i] = 1.0 - 1e-8;
        u_new[model->i_m * n + i] = m;
    }
    struct term_tile tile = {.terms = terms, .model = model, .n_cell = n, .dt = 1e-3, .rates = rates, .K = K};
    closure_term.apply(&tile, u_new);
    double most = model->eos[0].rho_most, ret = u_new[3] * CLOSURE_DENSE * most;
    terms_free(terms);
    mem_free(rates);
    mem_free(K);
    mem_free(u_new);
    flow_stop(&flow);
    return ret / m;
}

static void test_dense(void **state)
{
    (void)state;
    static const char *const stiff[] = {
        "  water: {eos: {type: modified-tait, preset: published}}\n",
        "  water: {eos: {type: tait, preset: water}}\n",
        "  water: {eos: {type: cochran-chan, preset: nitromethane}}\n",
    };
    static const char *const soft[] = {FLOW_WATER, "  water: {eos: {type: nasg, preset: water-2016}}\n",
                                       "  water: {eos: {type: ideal-gas, preset: air}}\n"};
    for (int i = 0; i < 3; i++) {
        assert_true(fabs(squeezed(stiff[i], 1.0) - 1.0) < 1e-14); /* 1e8 kg/m3 before */
        assert_true(squeezed(stiff[i], 1e-5) > 4.0);              /* 1000 kg/m3: as it was */
        assert_true(squeezed(soft[i], 1.0) < 1e-3);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(test_wood), cmocka_unit_test(test_most),
                                       cmocka_unit_test(test_counts), cmocka_unit_test(test_dense)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
