/* Derived fields against their formulas, point by point, and the list of names against what is found. */
#include "flow.h"

static const char MATERIALS[] = FLOW_WATER FLOW_AIR "  oil: {eos: {type: mnasg}}\n";

static void set_noise(const struct model *model, const double x[3], double *w)
{
    uint64_t seed = (uint64_t)(1e5 * (x[0] + 17.0 * x[1] + 331.0 * x[2]));
    double sum = 0.0;
    for (unsigned l = 0; l < model->n_material; l++) {
        double a = flow_random(&seed);
        w[l] = flow_random(&seed) < 0.3 ? 0.0 : a;
        if (l == 2 && sum == 0.0) w[l] = 1.0;
        sum += w[l];
        w[model->i_m + l] = w[l] > 0.0 ? model->eos[l].rho_fill * (0.8 + 0.4 * a) : model->eos[l].rho_fill;
    }
    for (unsigned l = 0; l < model->n_material; l++) w[l] /= sum;
    for (int d = 0; d < model->dim; d++) w[model->i_u + (unsigned)d] = 300.0 * (flow_random(&seed) - 0.5);
    w[model->i_E] = 1e5 * (1.0 + 9.0 * flow_random(&seed));
}

static void start(struct flow *flow, const char *domain)
{
    flow_start(flow,
               mem_print("bulla: 1\ntitle: derive\ndomain: %s\nmaterials:\n%sinitial:\n"
                         "  - {everywhere: true, material: water, density: 1000, pressure: 1e5}\nrun: {until: 1}\n",
                         domain, MATERIALS));
}

static const char PLANE[] =
    "{lower: [0, 0], upper: [1, 2], cells: [16, 32], boundaries: {x-: outflow, x+: outflow, y-: "
    "outflow, y+: outflow}}";

/* What a cell with primitives w must show. */
struct shown {
    double density, sound_speed, speed, energy, temperature, each[3];
};

static struct shown formula(const struct model *model, const double *w)
{
    struct shown shown = {0};
    double compliance = 0.0, p = w[model->i_E], heat = 0.0;
    for (unsigned l = 0; l < model->n_material; l++) {
        const struct model_eos *eos = &model->eos[l];
        double rho = w[model->i_m + l], e, stiff, T;
        if (w[l] == 0.0) continue;
        eos->law->state(eos->self, 1, &rho, &p, &e, &stiff);
        eos->law->temperature(eos->self, 1, &rho, &p, &T);
        shown.density += w[l] * rho;
        shown.energy += w[l] * e;
        shown.each[l] = T;
        heat += w[l] * rho * T;
        compliance += w[l] / stiff;
    }
    for (int d = 0; d < model->dim; d++) shown.speed += pow(w[model->i_u + (unsigned)d], 2.0);
    shown.speed = sqrt(shown.speed);
    shown.temperature = heat / shown.density;
    shown.sound_speed = sqrt(1.0 / (shown.density * compliance));
    return shown;
}

static void near(double value, double wanted, const char *what)
{
    if (!(fabs(value - wanted) <= 1e-12 * fabs(wanted) + 1e-300)) fail_msg("%s: %.17g, not %.17g", what, value, wanted);
}

/* Value of a named field in a cell. */
static double value_of(const struct flow *flow, const char *name, unsigned component, size_t cell)
{
    double *field = flow_derived(flow, name, component), value = field[cell];
    mem_free(field);
    return value;
}

static void check_cell(const struct flow *flow, size_t c)
{
    const struct model *model = flow->state->model;
    static const char *const each[] = {"water", "air", "oil"};
    double w[FLOW_FIELDS], count = 0.0;
    for (unsigned q = 0; q < model->n_field; q++) {
        double *all = flow_primitive(flow, q);
        w[q] = all[c];
        mem_free(all);
    }
    struct shown shown = formula(model, w);
    near(value_of(flow, "density", 0, c), shown.density, "density");
    near(value_of(flow, "pressure", 0, c), w[model->i_E], "pressure");
    near(value_of(flow, "sound_speed", 0, c), shown.sound_speed, "sound_speed");
    near(value_of(flow, "mach", 0, c), shown.speed / shown.sound_speed, "mach");
    near(value_of(flow, "temperature", 0, c), shown.temperature, "temperature");
    near(value_of(flow, "total_energy", 0, c), shown.energy + 0.5 * shown.density * shown.speed * shown.speed,
         "total_energy");
    double e = value_of(flow, "internal_energy", 0, c); /* a difference: relative to the total */
    assert_true(fabs(e - shown.energy / shown.density) <= 1e-12 * (fabs(e) + shown.speed * shown.speed));
    for (unsigned d = 0; d < 3; d++) {
        const char name[] = {'v', 'e', 'l', 'o', 'c', 'i', 't', 'y', '_', (char)('x' + d), '\0'};
        double u = d < (unsigned)model->dim ? w[model->i_u + d] : 0.0;
        near(value_of(flow, "velocity", d, c), u, "velocity");
        near(value_of(flow, name, 0, c), u, name);
    }
    for (unsigned l = 0; l < 3; l++) {
        char name[64];
        snprintf(name, sizeof name, "alpha_%s", each[l]);
        near(value_of(flow, name, 0, c), w[l], name);
        snprintf(name, sizeof name, "density_%s", each[l]);
        near(value_of(flow, name, 0, c), w[l] > 0.0 ? w[model->i_m + l] : 0.0, name);
        snprintf(name, sizeof name, "temperature_%s", each[l]);
        near(value_of(flow, name, 0, c), shown.each[l], name);
        snprintf(name, sizeof name, "partial_density_%s", each[l]);
        near(value_of(flow, name, 0, c), w[l] * w[model->i_m + l], name);
        count += w[l] > 0.0;
    }
    near(value_of(flow, "cost", 0, c), count, "cost");
    near(value_of(flow, "level", 0, c), 0.0, "level");
    near(value_of(flow, "rank", 0, c), 0.0, "rank");
}

static void test_fields(void **state)
{
    (void)state;
    struct flow flow;
    start(&flow, PLANE);
    flow_set(&flow, set_noise);
    for (size_t c = 0; c < flow.n_cell; c += 7) check_cell(&flow, c);
    flow_stop(&flow);
}

/* Linear velocities: u = (a y, b x, c x + d y) has the curl (d, -c, b - a). */
static void set_linear(const struct model *model, const double x[3], double *w)
{
    w[model->i_u] = 3.0 * x[1];
    if (model->dim > 1) w[model->i_u + 1] = -5.0 * x[0];
    if (model->dim > 2) w[model->i_u + 2] = 7.0 * x[0] + 11.0 * x[1];
}

static void check_curl(const char *domain, const double wanted[3])
{
    struct flow flow;
    size_t inside = 0;
    start(&flow, domain);
    flow_set(&flow, set_linear);
    double *curl[3];
    for (unsigned d = 0; d < 3; d++) curl[d] = flow_derived(&flow, "vorticity", d);
    for (size_t c = 0; c < flow.n_cell; c++) {
        double x[3];
        bool edge = false;
        flow_centre(&flow, c, x);
        for (int d = 0; d < flow.scene->domain.dim; d++) {
            double h = flow_level(&flow)->h[d];
            edge = edge || x[d] - flow.scene->domain.lower[d] < h || flow.scene->domain.upper[d] - x[d] < h;
        }
        if (edge) continue;
        for (unsigned d = 0; d < 3; d++) assert_true(fabs(curl[d][c] - wanted[d]) <= 1e-12 * 20.0);
        inside++;
    }
    assert_true(inside > 0);
    for (unsigned d = 0; d < 3; d++) mem_free(curl[d]);
    flow_stop(&flow);
}

static void test_vorticity(void **state)
{
    (void)state;
    check_curl(PLANE, (const double[]){0.0, 0.0, -8.0});
    check_curl("{lower: [0, 0, 0], upper: [1, 2, 1], cells: [16, 16, 16], boundaries: {x-: outflow, x+: outflow, y-: "
               "outflow, y+: outflow, z-: outflow, z+: outflow}}",
               (const double[]){11.0, -7.0, -8.0});
    check_curl("{lower: [0], upper: [1], cells: [16], boundaries: {x-: outflow, x+: outflow}}",
               (const double[]){0.0, 0.0, 0.0});
}

/* In (0, 1]: 1 in uniform fluid, exp(-200) at the steepest place. */
static void set_step(const struct model *model, const double x[3], double *w)
{
    w[model->i_m] = x[0] < 0.5 ? 1000.0 : x[1] < 1.0 ? 1001.0 : 1000.5;
}

static void test_schlieren(void **state)
{
    (void)state;
    struct flow flow;
    double least = 2.0;
    start(&flow, PLANE);
    double *flat = flow_derived(&flow, "schlieren", 0);
    for (size_t c = 0; c < flow.n_cell; c++) assert_true(flat[c] == 1.0);
    mem_free(flat);
    flow_set(&flow, set_step);
    double *steep = flow_derived(&flow, "schlieren", 0);
    for (size_t c = 0; c < flow.n_cell; c++) {
        assert_true(steep[c] > 0.0 && steep[c] <= 1.0);
        least = fmin(least, steep[c]);
    }
    assert_true(fabs(log(least) + 200.0) < 1e-6);
    size_t half = 16 * 28 + 7; /* beside half the jump; the steepest cell has the whole one and the half across */
    assert_true(fabs(log(steep[half]) + 100.0 / sqrt(1.25)) < 1e-6);
    assert_true(steep[2] == 1.0);
    mem_free(steep);
    flow_stop(&flow);
}

static void test_names(void **state)
{
    (void)state;
    struct flow flow;
    start(&flow, PLANE);
    const struct model *model = flow.state->model;
    size_t count = 0;
    for (const char *const *name = derive_names(model); *name; name++, count++) {
        struct derive field;
        assert_int_equal(derive_find(model, *name, &field), 0);
        assert_string_equal(field.name, *name);
        assert_non_null(field.unit);
        bool vector = !strcmp(*name, "velocity") || !strcmp(*name, "vorticity") || !strcmp(*name, "heat_flux");
        assert_int_equal(field.components, vector ? 3 : 1);
    }
    assert_int_equal(count, 17 + 5 * 3);
    flow_stop(&flow);
}

static void test_unknown(void **state)
{
    (void)state;
    static const char *const pairs[][2] = {{"presure", "pressure"},      {"alpha_wather", "alpha_water"},
                                           {"velocity_w", "velocity_"},  {"temperature_ait", "temperature_air"},
                                           {"velocity_xy", "velocity_"}, {"density_", "density"},
                                           {"Schlieren", "schlieren"}};
    struct flow flow;
    start(&flow, PLANE);
    for (size_t i = 0; i < sizeof pairs / sizeof *pairs; i++) {
        struct derive field;
        assert_int_equal(derive_find(flow.state->model, pairs[i][0], &field), STATUS_CASE);
        if (!strstr(status_text(), pairs[i][1])) fail_msg("no '%s' in: %s", pairs[i][1], status_text());
    }
    flow_stop(&flow);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_fields), cmocka_unit_test(test_vorticity), cmocka_unit_test(test_schlieren),
        cmocka_unit_test(test_names),  cmocka_unit_test(test_unknown),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
