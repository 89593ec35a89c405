/* Viscosity: motion without shear has no stress, in any geometry; linear shear has the stress and the heat of the
 * formula; a mixture heats as two phases at one pressure do; how the domain is cut into tiles, and which tiles are
 * skipped, changes no bit; mirrored and exchanged axes stay so. */
#include "flow.h"

static const char gas[] =
    "  air: {eos: {type: ideal-gas, gamma: 1.4}, viscosity: {type: newtonian, mu: %g, zeta: %g}}\n";

/* One material that moves as `set` says; dt fixed. */
static void start(struct flow *flow, double mu, double zeta, const char *domain, flow_setter *set)
{
    char *material = mem_print(gas, mu, zeta);
    flow_start(flow, mem_print("bulla: 1\ntitle: viscous\ndomain: %s\nmesh: {tile: 4}\nmaterials:\n%sinitial:\n"
                               "  - {everywhere: true, material: air, density: 1.2, pressure: 1e5}\n"
                               "scheme: {dt: 1 ns}\nrun: {until: 1}\n",
                               domain, material));
    mem_free(material);
    flow_set(flow, set);
}

static const double MU = 10.0, ZETA = 7.0, A = 100.0, DT = 1e-9;

/* Largest difference of a conserved field between two runs, over cells at least four layers from all boundaries but the
 * axis. */
static double differ(const struct flow *a, const struct flow *b, unsigned q)
{
    double *x = flow_conserved(a, q), *y = flow_conserved(b, q), most = 0.0;
    const int *n = a->scene->domain.cells;
    for (size_t c = 0; c < a->n_cell; c++) {
        size_t rest = c;
        bool inside = true;
        for (int d = 0; d < a->scene->domain.dim; d++) {
            bool radius = d == 0 && a->scene->domain.geometry != SCENE_CARTESIAN; /* its lower end is the axis */
            int i = (int)(rest % (size_t)n[d]);
            inside = inside && (radius || i >= 4) && i < n[d] - 4;
            rest /= (size_t)n[d];
        }
        if (inside && fabs(x[c] - y[c]) > most) most = fabs(x[c] - y[c]);
    }
    mem_free(x);
    mem_free(y);
    return most;
}

#define BOX1 "{lower: [-1], upper: [1], cells: [16], boundaries: {x-: outflow, x+: outflow}}"
#define BOX2                                                                                                     \
    "{lower: [-1, -1], upper: [1, 1], cells: [16, 16], boundaries: {x-: outflow, x+: outflow, y-: outflow, y+: " \
    "outflow}}"
#define BOX3                                                                                                   \
    "{lower: [-1, -1, -1], upper: [1, 1, 1], cells: [12, 12, 12], boundaries: {x-: outflow, x+: outflow, y-: " \
    "outflow, "                                                                                                \
    "y+: outflow, z-: outflow, z+: outflow}}"
#define RZ                                                                                                             \
    "{geometry: axisymmetric, lower: [0, -1], upper: [1, 1], cells: [16, 16], boundaries: {x+: outflow, y-: outflow, " \
    "y+: outflow}}"
#define BALL "{geometry: spherical, lower: [0], upper: [1], cells: [16], boundaries: {x+: outflow}}"

/* u = a x, with x where values stand: the middle of the volume. */
static void set_swell(const struct model *model, const double x[3], double *w)
{
    for (unsigned d = 0; d < model->n_velocity; d++) {
        double h = 1.0 / 16.0, r = x[d];
        if (d == 0 && model->beta) r = metric_centroid(model->beta, x[0] - 0.5 * h, x[0] + 0.5 * h);
        w[model->i_u + d] = A * r;
    }
}

static void set_turn(const struct model *model, const double x[3], double *w)
{
    w[model->i_u] = -A * x[1];
    w[model->i_u + 1] = A * x[0];
}

static void set_shear(const struct model *model, const double x[3], double *w)
{
    w[model->i_u] = A * x[1];
}

/* What viscosity adds to momentum and energy in one step, beside the same step without. In curved geometry
 * reconstruction about middles of cells makes motion that is not a r in the first half of the step. */
static void compare(double mu, double zeta, const char *domain, flow_setter *set, double heat)
{
    struct flow without, with;
    start(&without, 0.0, 0.0, domain, set);
    start(&with, mu, zeta, domain, set);
    flow_steps(&without, 1);
    flow_steps(&with, 1);
    const struct model *model = with.state->model;
    double scale = (mu + zeta) * A * DT * 16.0; /* of a stress over a cell */
    for (unsigned d = 0; d < model->n_velocity; d++) {
        double push = differ(&without, &with, model->i_u + d);
        if (!(push < (model->beta ? 1e-5 : 1e-9) * scale))
            fail_msg("%s: momentum %u differs by %.3g of %.3g", domain, d, push, scale);
    }
    double rise = differ(&without, &with, model->i_E);
    if (heat == 0.0 && !(rise < 1e-5 * scale * A))
        fail_msg("%s: energy differs by %.3g of %.3g", domain, rise, scale * A);
    if (heat > 0.0 && fabs(rise / (heat * DT) - 1.0) > 1e-5)
        fail_msg("%s: %.9g instead of %.9g", domain, rise, heat * DT);
    flow_stop(&without);
    flow_stop(&with);
}

/* Dilatation: no deviator. The bulk viscosity alone resists, with zeta (div u)^2. */
static void test_dilatation(void **state)
{
    (void)state;
    static const char *const domains[] = {BOX3, RZ, BALL};
    for (int i = 0; i < 3; i++) {
        compare(MU, 0.0, domains[i], set_swell, 0.0);
        compare(0.0, ZETA, domains[i], set_swell, ZETA * 9.0 * A * A);
    }
    /* In one and two dimensions there is one: 4/3 mu (du/dx)^2 and 2 mu (a^2 + a^2 - (2 a)^2/3). */
    compare(MU, 0.0, BOX1, set_swell, 4.0 / 3.0 * MU * A * A);
    compare(MU, 0.0, BOX2, set_swell, 4.0 / 3.0 * MU * A * A);
}

static void test_rotation(void **state)
{
    (void)state;
    compare(MU, ZETA, BOX2, set_turn, 0.0);
    compare(MU, ZETA, BOX3, set_turn, 0.0);
}

/* Work goes in through the faces: mu (du/dy)^2 stays as heat. */
static void test_shear(void **state)
{
    (void)state;
    compare(MU, ZETA, BOX2, set_shear, MU * A * A);
    compare(MU, ZETA, BOX3, set_shear, MU * A * A);
}

static void set_foam(const struct model *model, const double x[3], double *w)
{
    set_shear(model, x, w);
    w[model->i_E] = 1e5;
}

/* Water and air, half and half, one of them viscous, sheared: dp = rho c_w^2 sum G_l Q_l/(rho_l c_l^2). */
static void test_foam(void **state)
{
    (void)state;
    double stiff[] = {4.4 * (1e5 + 6e8), 1.4e5}, gruneisen[] = {3.4, 0.4}, heat = 0.5 * 1e3 * A * A;
    double wood = 1.0 / (0.5 / stiff[0] + 0.5 / stiff[1]);
    for (int l = 0; l < 2; l++) {
        struct flow flow;
        flow_start(&flow, mem_print("bulla: 1\ntitle: foam\ndomain: " BOX2 "\nmesh: {tile: 8}\nmaterials:\n"
                                    "  water: {eos: {type: stiffened-gas, gamma: 4.4, p-inf: 600 MPa}, viscosity: %g}\n"
                                    "  air: {eos: {type: ideal-gas, gamma: 1.4}, viscosity: %g}\ninitial:\n"
                                    "  - {everywhere: true, fractions: {water: 0.5, air: 0.5}, density: {water: 1000, "
                                    "air: 1.2}, pressure: 1e5}\nscheme: {dt: 1 us}\nrun: {until: 1}\n",
                                    l ? 0.0 : 1e3, l ? 1e3 : 0.0));
        flow_set(&flow, set_foam);
        flow_steps(&flow, 1);
        double *p = flow_primitive(&flow, flow.state->model->i_E);
        double rise = p[16 * 8 + 8] - 1e5, want = wood * gruneisen[l] * heat / stiff[l] * 1e-6;
        print_message("material %d: pressure rises by %.9g Pa, should by %.9g\n", l, rise, want);
        assert_true(fabs(rise / want - 1.0) < 2e-3);
        mem_free(p);
        flow_stop(&flow);
    }
}

/* Two fluids, a front between them, all else random; most of the domain rests. */
static void set_random(const struct model *model, const double x[3], double *w)
{
    uint64_t seed = (uint64_t)(1e6 * (500.0 + x[0] + 17.0 * x[1] + 331.0 * x[2]));
    double part = 0.5 + 0.5 * tanh(9.0 * (x[0] + 0.7 * x[1] - 0.2));
    if (x[0] < -0.2 || x[1] > 0.3) part = 0.0;
    w[model->i_alpha] = part;
    w[model->i_alpha + 1] = 1.0 - part;
    for (unsigned d = 0; d < model->n_velocity; d++)
        w[model->i_u + d] = x[0] < -0.2 || x[1] > 0.3 ? 0.0 : 10.0 * (flow_random(&seed) - 0.5);
}

static char *two(const char *domain, int tile)
{
    return mem_print(
        "bulla: 1\ntitle: two\ndomain: %s\nmesh: {tile: %d}\nmaterials:\n"
        "  water: {eos: {type: stiffened-gas, gamma: 4.4, p-inf: 6 MPa}, viscosity: {type: newtonian, mu: 2, "
        "zeta: 1}}\n  air: {eos: {type: ideal-gas, gamma: 1.4}, viscosity: 0.1}\ninitial:\n"
        "  - {everywhere: true, material: air, density: {water: 1000, air: 1.2}, pressure: 1e5}\n"
        "run: {until: 1}\n",
        domain, tile);
}

static void test_tiles(void **state)
{
    (void)state;
    static const char *const domains[] = {
        "{lower: [-1, -1], upper: [1, 1], cells: [32, 32], boundaries: {x-: reflecting, x+: non-reflecting, y-: {type: "
        "no-slip, velocity: ['= 100*x', 0]}, y+: outflow}}",
        "{geometry: axisymmetric, lower: [0, -1], upper: [1, 1], cells: [16, 32], boundaries: {x+: no-slip, y-: "
        "periodic, y+: periodic}}",
        "{lower: [-1, -1, -1], upper: [1, 1, 1], cells: [16, 16, 16], boundaries: {x-: outflow, x+: no-slip, y-: "
        "periodic, y+: periodic, z-: {type: no-slip, velocity: [3, 4, 0]}, z+: symmetry}}"};
    for (int i = 0; i < 3; i++) {
        struct flow one, other;
        flow_start(&one, two(domains[i], 4));
        flow_set(&one, set_random);
        flow_steps(&one, 6);
        for (int tile = 8; tile <= 16; tile *= 2) {
            flow_start(&other, two(domains[i], tile));
            flow_set(&other, set_random);
            flow_steps(&other, 6);
            if (!flow_equal(&one, &other)) fail_msg("%s: tiles of %d differ from tiles of 4", domains[i], tile);
            flow_stop(&other);
        }
        assert_true(one.state->counts.carried > 0 || i > 0); /* some tiles rested */
        flow_stop(&one);
    }
}

/* A blob that is its own mirror image and stays the same when axes change places. */
static void set_blob(const struct model *model, const double x[3], double *w)
{
    double r2 = x[0] * x[0] + x[1] * x[1] + x[2] * x[2], part = 0.5 - 0.5 * tanh(12.0 * (sqrt(r2) - 0.5));
    w[model->i_alpha] = part;
    w[model->i_alpha + 1] = 1.0 - part;
    for (unsigned d = 0; d < model->n_velocity; d++)
        w[model->i_u + d] = -30.0 * x[d] * exp(-3.0 * r2) * (1.0 + x[d] * x[d]);
}

static void test_symmetry(void **state)
{
    (void)state;
    struct flow flow;
    enum { N = 32 };
    flow_start(&flow,
               two("{lower: [-1, -1], upper: [1, 1], cells: [32, 32], boundaries: {x-: outflow, x+: outflow, y-: "
                   "outflow, y+: outflow}}",
                   8));
    flow_set(&flow, set_blob);
    flow_steps(&flow, 10);
    const struct model *model = flow.state->model;
    for (unsigned q = 0; q < model->n_field; q++) {
        double *w = flow_conserved(&flow, q), *v = flow_conserved(&flow, q == model->i_u       ? q + 1
                                                                         : q == model->i_u + 1 ? q - 1
                                                                                               : q);
        for (size_t j = 0; j < N; j++)
            for (size_t i = 0; i < N; i++) {
                double sign = q == model->i_u ? -1.0 : 1.0;
                assert_true(w[j * N + i] == sign * w[j * N + (N - 1 - i)]);
                assert_true(w[j * N + i] == v[i * N + j]);
            }
        mem_free(w);
        mem_free(v);
    }
    flow_stop(&flow);
}

/* 1/dt = signal/cfl + 4/h^2 (4/3 mu + zeta)/(1.8 rho): what viscosity adds. */
static double slower(double mu, double zeta)
{
    struct flow flow;
    char *material = mem_print(gas, mu, zeta);
    flow_start(&flow, mem_print("bulla: 1\ntitle: pace\ndomain: %s\nmaterials:\n%sinitial:\n"
                                "  - {everywhere: true, material: air, density: 1.2, pressure: 1e5}\nrun: {until: 1}\n",
                                BOX1, material));
    double h = flow.state->mesh->levels[0].h[0], rate = 1.0 / advance_dt(flow.state);
    mem_free(material);
    flow_stop(&flow);
    return rate * h * h * 1.8 * 1.2 / 4.0;
}

static void same(double ratio)
{
    if (!(fabs(ratio - 1.0) < 1e-8)) fail_msg("1 expected, not %.12g", ratio);
}

static void test_pace(void **state)
{
    (void)state;
    double still = slower(0.0, 0.0);
    same((slower(MU, 0.0) - still) / (4.0 / 3.0 * MU));
    same((slower(0.0, ZETA) - still) / ZETA);
}

/* A field in the middle of a box; the state of its moment. */
static double field(const char *name, flow_setter *set)
{
    struct flow flow;
    struct derive what;
    start(&flow, MU, ZETA, BOX2, set);
    struct state *now = flow.state;
    struct derive_moment moment = derive_moment(now->model, now->mesh, 0.0);
    double *out = mem_new(3 * now->mesh->n_cell, sizeof *out), most = 0.0;
    if (derive_find(now->model, name, &what)) fail_msg("%s", status_text());
    derive_prepare(&moment, &what);
    for (unsigned t = 0; t < now->mesh->levels[0].n_local; t++) {
        const struct tile *tile = &now->mesh->levels[0].tiles[t];
        bool inside = true;
        for (int d = 0; d < 2; d++)
            inside = inside && tile->at[d] > 0 && tile->at[d] + 1 < now->mesh->levels[0].extent[d];
        if (!inside) continue;
        derive_tile(now->model, now->mesh, 0, t, 0.0, &what, out);
        most = out[0];
    }
    mem_free(out);
    flow_stop(&flow);
    return most;
}

/* Linear motion: stress and heat are those of the formulas. */
static void test_fields(void **state)
{
    (void)state;
    same(field("stress_viscous_xy", set_shear) / (MU * A));
    same(field("dissipation", set_shear) / (MU * A * A));
    double div = 2.0 * A, part = 2.0 * MU * (A - div / 3.0);
    same(field("stress_viscous_yy", set_swell) / (part + ZETA * div));
    same(field("stress_viscous_zz", set_swell) / (ZETA * div - 2.0 / 3.0 * MU * div));
}

/* Gas that moves in the upper right quarter alone. */
static void set_quarter(const struct model *model, const double x[3], double *w)
{
    w[model->i_u] = x[0] > 0.0 && x[1] > 0.0 ? 100.0 * x[0] : 0.0;
    w[model->i_u + 1] = x[0] > 0.0 && x[1] > 0.0 ? 50.0 * x[1] : 0.0;
}

/* A tile at rest whose neighbours rest, but not the one across its corner: what shears there reaches it in the first
 * step. */
static void test_corner(void **state)
{
    (void)state;
    struct flow flows[2];
    for (int k = 0; k < 2; k++) {
        flow_start(&flows[k], mem_print("bulla: 1\ntitle: corner\ndomain: " BOX2 "\nmesh: {tile: %d}\nmaterials:\n"
                                        "  air: {eos: {type: ideal-gas, gamma: 1.4}, viscosity: {type: newtonian, mu: "
                                        "10}}\ninitial:\n  - {everywhere: true, material: air, density: 1.2, "
                                        "pressure: 1e5}\nscheme: {dt: 1 ns}\nrun: {until: 1}\n",
                                        k ? 16 : 8));
        flow_set(&flows[k], set_quarter);
        flow_steps(&flows[k], 1);
    }
    double *u = flow_primitive(&flows[0], flows[0].state->model->i_u);
    assert_true(u[7 * 16 + 7] != 0.0);
    mem_free(u);
    assert_true(flow_equal(&flows[0], &flows[1]));
    flow_stop(&flows[0]);
    flow_stop(&flows[1]);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(test_dilatation), cmocka_unit_test(test_rotation),
                                       cmocka_unit_test(test_shear),      cmocka_unit_test(test_foam),
                                       cmocka_unit_test(test_tiles),      cmocka_unit_test(test_symmetry),
                                       cmocka_unit_test(test_pace),       cmocka_unit_test(test_fields),
                                       cmocka_unit_test(test_corner)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
