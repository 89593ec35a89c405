/* Contacts: an interface of density ratio 1000 that moves at uniform p and u leaves both uniform, for every
 * limiter, Riemann solver and pair of equations of state, along an axis and across the grid. */
#include "flow.h"

enum { STEPS = 220 };

static const char *const LIMITERS[] = {"minmod", "van-leer", "mc", "van-albada", "superbee"};
static const char *const SOLVERS[] = {"hllc", "hll", "rusanov"};
static const char *const PAIRS[] = {
    FLOW_WATER FLOW_AIR,
    "  water: {eos: {type: nasg}}\n" FLOW_AIR,
    "  water: {eos: {type: mnasg}}\n" FLOW_AIR,
    "  water: {eos: {type: ideal-gas, gamma: 1.667}}\n" FLOW_AIR,
    FLOW_WATER "  oil: {eos: {type: mnasg}}\n" FLOW_AIR,
};
static const char LINE[] = "{lower: [0], upper: [1], cells: [64], boundaries: {x-: periodic, x+: periodic}}";
static const char *const CLOSURES[] = {"kapila", "allaire"};
static const char PLANE[] = "{lower: [0, 0], upper: [1, 1], cells: [32, 32], boundaries: {x-: periodic, x+: periodic, "
                            "y-: periodic, y+: periodic}}";

enum { N_LIMITER = 5, N_SOLVER = 3, N_PAIR = 5 };

struct worst {
    double p, u;
};

static char *contact_case(const char *domain, const char *materials, const char *velocity, const char *shape,
                          const char *scheme)
{
    return mem_print("bulla: 1\ntitle: contact\ndomain: %s\nmaterials:\n%sinitial:\n"
                     "  - {everywhere: true, material: air, density: 1, pressure: 1e5, velocity: %s}\n"
                     "  - {%s, material: water, density: 1000, pressure: 1e5, velocity: %s}\n"
                     "scheme: %s\nrun: {until: 1}\n",
                     domain, materials, velocity, shape, velocity, scheme);
}

/* |p - 1e5|/1e5 and |u - u0|/|u0| at their worst. */
static struct worst worst_of(const struct flow *flow, const double *u0)
{
    const struct model *model = flow->state->model;
    struct worst worst = {0};
    double size = 0.0, *p = flow_primitive(flow, model->i_E);
    for (int d = 0; d < model->dim; d++) size += u0[d] * u0[d];
    for (size_t c = 0; c < flow->n_cell; c++) worst.p = fmax(worst.p, fabs(p[c] - 1e5) / 1e5);
    for (int d = 0; d < model->dim; d++) {
        double *u = flow_primitive(flow, model->i_u + (unsigned)d);
        for (size_t c = 0; c < flow->n_cell; c++) worst.u = fmax(worst.u, fabs(u[c] - u0[d]) / sqrt(size));
        mem_free(u);
    }
    mem_free(p);
    return worst;
}

/* One run; complains where p or u leaves its value by more than 1e-9. */
static void check_run(char *text, const double *u0, const char *what, struct worst *worst)
{
    struct flow flow;
    flow_start(&flow, text);
    flow_steps(&flow, STEPS);
    struct worst now = worst_of(&flow, u0);
    worst->p = fmax(worst->p, now.p);
    worst->u = fmax(worst->u, now.u);
    if (!(now.p < 1e-9 && now.u < 1e-9)) print_error("%s: dp/p %.1e, du/u %.1e\n", what, now.p, now.u);
    flow_stop(&flow);
}

static void check_all(const char *domain, const char *velocity, const char *shape, const double *u0)
{
    struct worst worst[N_PAIR] = {{0}};
    for (int pair = 0; pair < N_PAIR; pair++) {
        for (int s = 0; s < N_SOLVER; s++)
            for (int l = 0; l < N_LIMITER; l++) {
                char *scheme = mem_print("{riemann: %s, limiter: %s, closure: %s, cfl: 0.5}", SOLVERS[s], LIMITERS[l],
                                         CLOSURES[(l + s + pair) % 2]);
                check_run(contact_case(domain, PAIRS[pair], velocity, shape, scheme), u0, scheme, &worst[pair]);
                mem_free(scheme);
            }
        print_message("pair %d: worst dp/p %.1e, du/u %.1e\n", pair, worst[pair].p, worst[pair].u);
    }
    for (int pair = 0; pair < N_PAIR; pair++) assert_true(worst[pair].p < 1e-9 && worst[pair].u < 1e-9);
}

static void test_line(void **state)
{
    (void)state;
    check_all(LINE, "[100]", "box: {lower: [0.2], upper: [0.52]}", (const double[]){100.0});
}

static void test_line_back(void **state)
{
    (void)state;
    check_all(LINE, "[-100]", "box: {lower: [0.2], upper: [0.52]}", (const double[]){-100.0});
}

static void test_plane(void **state)
{
    (void)state;
    check_all(PLANE, "[80, 60]", "sphere: {center: [0.4, 0.5], radius: 0.23}", (const double[]){80.0, 60.0});
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_line),
        cmocka_unit_test(test_line_back),
        cmocka_unit_test(test_plane),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
