/* Mixture rules: primitives and conserved fields are inverse to each other, the iteration agrees with the closed
 * form, K sums to 0, and speeds are those of their formulas and of a table of Wood's. */
#include "flow.h"

enum { POINTS = 700 };

static const char *const LAWS[] = {
    "{eos: {type: stiffened-gas, gamma: 4.4, p-inf: 600 MPa}}",
    "{eos: {type: ideal-gas, gamma: 1.4}}",
    "{eos: {type: nasg}}",
    "{eos: {type: mnasg}}",
    "{eos: {type: ideal-gas, gamma: 1.667}}",
};

/* A model of the first n laws. */
static void start(struct flow *flow, unsigned n)
{
    char *materials = mem_text("");
    for (unsigned l = 0; l < n; l++) {
        char *more = mem_print("%s  m%u: %s\n", materials, l, LAWS[l]);
        mem_free(materials);
        materials = more;
    }
    flow_start(flow,
               mem_print("bulla: 1\ntitle: mix\ndomain: {lower: [0, 0], upper: [1, 1], cells: [8, 8], boundaries: "
                         "{x-: outflow, x+: outflow, y-: outflow, y+: outflow}}\nmaterials:\n%sinitial:\n"
                         "  - {everywhere: true, material: m0, density: 1000, pressure: 1e5}\nrun: {until: 1}\n",
                         materials));
    mem_free(materials);
}

/* Makes a model iterate: its laws keep it a secret that they are linear in p. */
static void hide_linear(struct model *model)
{
    static struct bulla_eos hidden[8]; /* of the first material of each law */
    static const struct bulla_eos *laws[8];
    model->linear = false;
    for (unsigned l = 0; l < model->n_material; l++) {
        unsigned k = 0;
        while (laws[k] && laws[k] != model->eos[l].law) k++;
        assert_true(k < 8);
        laws[k] = model->eos[l].law;
        hidden[k] = *laws[k];
        hidden[k].linear = NULL;
        model->eos[l].law = &hidden[k];
    }
}

/* Random fractions, some exactly 0, some 1; densities as those of the absent are defined. */
static void random_states(const struct model *model, double *w)
{
    uint64_t seed = 7;
    for (size_t i = 0; i < POINTS; i++) {
        double sum = 0.0;
        unsigned whole = (unsigned)(flow_random(&seed) * model->n_material), n = model->n_alpha;
        bool pure = flow_random(&seed) < 0.3;
        for (unsigned l = 0; l < n; l++) {
            double a = flow_random(&seed), none = flow_random(&seed);
            w[l * POINTS + i] = l == whole ? 1.0 : pure || none < 0.3 ? 0.0 : pow(a, 8.0) + 1e-6;
            sum += w[l * POINTS + i];
        }
        for (unsigned l = 0; l < n; l++) w[l * POINTS + i] /= sum;
        for (unsigned l = 0; l < model->n_material; l++) {
            double factor = 0.7 + 0.5 * flow_random(&seed);
            bool absent = n && w[l * POINTS + i] == 0.0;
            w[(model->i_m + l) * POINTS + i] = model->eos[l].rho_fill * (absent ? 1.0 : factor);
        }
        for (unsigned q = model->i_u; q < model->i_E; q++) w[q * POINTS + i] = 1000.0 * (flow_random(&seed) - 0.5);
        w[model->i_E * POINTS + i] = 1e4 * pow(1e5, flow_random(&seed));
    }
}

/* Largest error of `got`, relative; of the pressure relative to what the energy can resolve, of which de/dp is the
 * sensitivity: eps rho E / (d rho e / dp) at worst. */
static double error_of(const struct model *model, const double *u, const double *w, const double *got)
{
    double worst = 0.0;
    for (unsigned q = 0; q < model->n_field; q++)
        for (size_t i = 0; i < POINTS; i++) {
            double scale = fabs(w[q * POINTS + i]);
            if (q == model->i_E) scale += 4.0 * fabs(u[q * POINTS + i]);
            double error = fabs(got[q * POINTS + i] - w[q * POINTS + i]) / (scale > 0.0 ? scale : 1.0);
            if (!(error <= worst)) worst = error;
        }
    return worst;
}

static void check_inverse(unsigned n_material)
{
    struct flow flow;
    start(&flow, n_material);
    struct model closed = *flow.state->model, iterated = closed;
    hide_linear(&iterated);
    size_t size = (size_t)closed.n_field * POINTS;
    double *w = mem_new(size, sizeof *w), *u = mem_new(size, sizeof *u), *got = mem_new(size, sizeof *got);
    assert_true(closed.linear);
    random_states(&closed, w);
    mix_conserved(&closed, POINTS, POINTS, w, u);
    mix_primitives(&closed, POINTS, POINTS, u, got);
    double error = error_of(&closed, u, w, got);
    for (size_t i = 0; i < size; i++) got[i] = 0.0; /* the iteration starts from nothing */
    struct mix_effort effort = mix_primitives(&iterated, POINTS, POINTS, u, got);
    assert_true(effort.solved == POINTS && effort.failed == 0 && effort.steps >= POINTS);
    double newton = error_of(&closed, u, w, got);
    print_message("%u materials: closed form %.1e, iteration %.1e\n", n_material, error, newton);
    assert_true(error < 4e-14);
    assert_true(newton < 1e-10);
    mem_free(w);
    mem_free(u);
    mem_free(got);
    flow_stop(&flow);
}

static void test_inverse(void **state)
{
    (void)state;
    for (unsigned n = 1; n <= 5; n += n < 3 ? 1 : 2) check_inverse(n);
}

/* The value at a point must not depend on its neighbours or its place in the batch. */
static void test_alone(void **state)
{
    (void)state;
    struct flow flow;
    start(&flow, 3);
    struct model model = *flow.state->model;
    size_t size = (size_t)model.n_field * POINTS;
    double *w = mem_new(size, sizeof *w), *u = mem_new(size, sizeof *u), *all = mem_new(size, sizeof *all);
    random_states(&model, w);
    mix_conserved(&model, POINTS, POINTS, w, u);
    for (unsigned iterate = 0; iterate < 2; iterate++) {
        if (iterate) hide_linear(&model);
        for (size_t i = 7; i < POINTS; i += 50) { /* some traces */
            if (u[i] > 0.5) continue;
            u[i] = 1e-14;
            u[model.i_m * POINTS + i] = 1e-11;
        }
        for (size_t i = 0; i < POINTS; i++) all[model.i_E * POINTS + i] = 1e5;
        mix_primitives(&model, POINTS, POINTS, u, all);
        for (size_t i = 0; i < POINTS; i++) {
            double one[FLOW_FIELDS] = {0}, got[FLOW_FIELDS] = {0};
            for (unsigned q = 0; q < model.n_field; q++) one[q] = u[q * POINTS + i];
            got[model.i_E] = 1e5;
            mix_primitives(&model, 1, 1, one, got);
            for (unsigned q = 0; q < model.n_field; q++) assert_true(got[q] == all[q * POINTS + i]);
        }
    }
    mem_free(w);
    mem_free(u);
    mem_free(all);
    flow_stop(&flow);
}

/* An energy below what any pressure above the least one can hold must not become a pressure that looks fine. */
static void test_no_pressure(void **state)
{
    (void)state;
    struct flow flow;
    start(&flow, 2);
    struct model model = *flow.state->model;
    for (unsigned iterate = 0; iterate < 2; iterate++) {
        double w[FLOW_FIELDS] = {0.0, 1.0, 1000.0, 1.2, 0.0, 0.0, 1e5}, u[FLOW_FIELDS], stiff[2];
        if (iterate) hide_linear(&model);
        mix_conserved(&model, 1, 1, w, u);
        u[model.i_E] = -1e3;
        mix_primitives(&model, 1, 1, u, w);
        mix_stiffness(&model, 1, 1, w, stiff);
        assert_true(!(stiff[1] > 0.0));
    }
    flow_stop(&flow);
}

/* What a trace holds of the energy stays in the pressure; the trace itself is hidden from fluxes. */
static void test_trace(void **state)
{
    (void)state;
    struct flow flow;
    start(&flow, 2);
    const struct model *model = flow.state->model;
    for (int k = 0; k < 40; k++) {
        double trace = pow(10.0, -6.0 - 0.3 * k), w[FLOW_FIELDS] = {trace, 1.0 - trace, 980.0, 1.2, 3.0, 0.0, 1e5};
        double u[FLOW_FIELDS], got[FLOW_FIELDS] = {0};
        mix_conserved(model, 1, 1, w, u);
        mix_primitives(model, 1, 1, u, got);
        assert_true(fabs(got[model->i_E] - 1e5) < 1e-5);
        assert_true(fabs(got[0] + got[1] - 1.0) <= 2.3e-16);
        assert_true(trace <= MIX_ABSENT ? got[0] == 0.0 : got[0] > 0.0);
        assert_true(got[0] > 0.0 || got[2] == model->eos[0].rho_fill);
    }
    flow_stop(&flow);
}

/* A material that is alone gives way by what there is, to the bit: narrowed paths and the full one must agree. */
static void test_closure_alone(void **state)
{
    (void)state;
    struct flow flow;
    start(&flow, 2);
    const struct model *model = flow.state->model;
    uint64_t seed = 7;
    for (int i = 0; i < 1000; i++) {
        double w[FLOW_FIELDS] = {0}, stiff[2], K[2];
        unsigned l = (unsigned)i % 2;
        w[model->i_alpha + l] = 1.0;
        w[model->i_m] = 1.0 + 999.0 * flow_random(&seed);
        w[model->i_m + 1] = 1.0 + 9.0 * flow_random(&seed);
        w[model->i_E] = 1e3 + 1e8 * flow_random(&seed);
        mix_stiffness_everywhere(model, 1, 1, w, stiff);
        mix_closure(model, 1, 1, w, stiff, K);
        assert_true(K[0] == 0.0 && K[1] == 0.0);
    }
    flow_stop(&flow);
}

static void test_closure(void **state)
{
    (void)state;
    struct flow flow;
    double K_worst = 0.0;
    start(&flow, 5);
    const struct model *model = flow.state->model;
    size_t size = (size_t)model->n_field * POINTS;
    double *w = mem_new(size, sizeof *w), *stiff = mem_new(size, sizeof *w), *K = mem_new(size, sizeof *w), c2[POINTS];
    random_states(model, w);
    mix_stiffness(model, POINTS, POINTS, w, stiff);
    mix_closure(model, POINTS, POINTS, w, stiff, K);
    mix_speed2(model, POINTS, POINTS, w, stiff, c2);
    for (size_t i = 0; i < POINTS; i++) {
        double sum = 0.0, largest = 0.0, compliance = 0.0, rho = 0.0, rho_c2 = 0.0;
        for (unsigned l = 0; l < 5; l++) {
            double a = w[l * POINTS + i], m = a * w[(model->i_m + l) * POINTS + i];
            sum += K[l * POINTS + i];
            largest = fmax(largest, fabs(K[l * POINTS + i]));
            compliance += a / stiff[l * POINTS + i];
            rho += m;
            rho_c2 += m * (stiff[l * POINTS + i] / w[(model->i_m + l) * POINTS + i]);
        }
        for (unsigned l = 0; l < 5; l++) {
            double a = w[l * POINTS + i], wanted = a * (1.0 / compliance / stiff[l * POINTS + i] - 1.0);
            assert_true(fabs(K[l * POINTS + i] - wanted) <= 1e-14 * (1.0 + fabs(wanted)));
        }
        K_worst = fmax(K_worst, fabs(sum) / (1.0 + largest));
        assert_true(fabs(c2[i] - rho_c2 / rho) <= 1e-13 * c2[i]);
    }
    print_message("sum of K: %.1e\n", K_worst);
    assert_true(K_worst < 1e-14);
    mem_free(w);
    mem_free(stiff);
    mem_free(K);
    flow_stop(&flow);
}

static double wood_alpha;

static void set_wood(const struct model *model, const double x[3], double *w)
{
    (void)x;
    w[0] = 1.0 - wood_alpha;
    w[1] = wood_alpha;
    w[model->i_m] = 998.2;
    w[model->i_m + 1] = 1.225;
    w[model->i_E] = 101325.0;
}

/* Columns: alpha_air, rho, c_Wood, c by another rule, K_water, K_air. */
static void test_wood(void **state)
{
    (void)state;
    struct flow flow;
    char line[512];
    int rows = 0;
    start(&flow, 2);
    FILE *file = fopen("tests/data/riemann/wood_water_air.csv", "r");
    assert_non_null(file);
    const struct model *model = flow.state->model;
    while (fgets(line, sizeof line, file)) {
        double rho, wood, other, K_water, K_air, w[FLOW_FIELDS] = {0}, stiff[2], K[2];
        if (sscanf(line, "%lf,%lf,%lf,%lf,%lf,%lf", &wood_alpha, &rho, &wood, &other, &K_water, &K_air) != 6) continue;
        flow_set(&flow, set_wood);
        set_wood(model, w, w);
        mix_stiffness(model, 1, 1, w, stiff);
        mix_closure(model, 1, 1, w, stiff, K);
        assert_true(fabs(K[0] - K_water) <= 1e-11 + 1e-11 * fabs(K_water));
        assert_true(fabs(K[1] - K_air) <= 1e-11 + 1e-11 * fabs(K_air));
        double *c = flow_derived(&flow, "sound_speed", 0), *density = flow_derived(&flow, "density", 0);
        assert_true(fabs(c[5] - wood) <= 1e-7 * wood);
        assert_true(fabs(density[5] - rho) <= 1e-11 * rho);
        mem_free(c);
        mem_free(density);
        rows++;
    }
    fclose(file);
    print_message("%d rows of Wood's table\n", rows);
    assert_true(rows > 50);
    flow_stop(&flow);
}

/* A whole run with the iteration is the run with the closed form: a strong tube of liquid and gas. */
static void test_run(void **state)
{
    (void)state;
    struct flow flow[2];
    for (unsigned i = 0; i < 2; i++) {
        flow_start(&flow[i],
                   mem_print("bulla: 1\ntitle: tube\ndomain: {lower: [0], upper: [1], cells: [128], boundaries: "
                             "{x-: outflow, x+: outflow}}\nmaterials:\n" FLOW_WATER FLOW_AIR "initial:\n"
                             "  - {everywhere: true, material: air, density: 50, pressure: 1e5}\n"
                             "  - {half-space: {point: [0.7], normal: [1]}, material: water, density: 1000, "
                             "pressure: 1e9}\nrun: {until: 1}\n"));
        struct model *model = flow[i].state->model;
        if (i) hide_linear(model);
        for (unsigned l = 0; i && l < model->n_alpha; l++) hide_linear(model->pure[l]);
        flow_until(&flow[i], 1e-4);
    }
    for (unsigned q = 0; q < flow[0].state->model->n_field; q++) {
        double *a = flow_conserved(&flow[0], q), *b = flow_conserved(&flow[1], q), size = 0.0, off = 0.0;
        for (size_t c = 0; c < flow[0].n_cell; c++) {
            size = fmax(size, fabs(a[c]));
            off = fmax(off, fabs(a[c] - b[c]));
        }
        if (!(off <= 1e-8 * size)) fail_msg("field %u differs by %g of %g", q, off, size);
        mem_free(a);
        mem_free(b);
    }
    flow_stop(&flow[0]);
    flow_stop(&flow[1]);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_inverse), cmocka_unit_test(test_alone),   cmocka_unit_test(test_no_pressure),
        cmocka_unit_test(test_trace),   cmocka_unit_test(test_closure), cmocka_unit_test(test_closure_alone),
        cmocka_unit_test(test_wood),    cmocka_unit_test(test_run),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
