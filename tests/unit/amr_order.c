/* Order of accuracy with refinement: smooth small waves run through patches that stand, at two resolutions, against the
 * exact solution; and what the faces between levels send back gets less with order two. */
#include "amr.h"

static const double SIZE = 1e-5, RHO = 1.2, PRESSURE = 1e5, GAMMA = 1.4, WIDTH = 0.09;

/* Where the pulse has its middle now, and the cell size it is averaged over. */
static double middle, cell_width;

static double sound(void)
{
    return sqrt(GAMMA * PRESSURE / RHO);
}

/* Mean over a cell of exp(-((x - middle)/WIDTH)^2), periodic. */
static double mean_pulse(double x, double h)
{
    double sum = 0.0;
    for (int image = -2; image <= 2; image++) {
        double at = (x - middle + image) / WIDTH, half = 0.5 * h / WIDTH;
        sum += 0.25 * sqrt(M_PI) * (erf(at + half) - erf(at - half)) / half;
    }
    return sum;
}

static void set_pulse(const struct model *model, const double x[3], double *w)
{
    double s = SIZE * mean_pulse(x[0], cell_width);
    w[model->i_m] = RHO * (1.0 + s);
    w[model->i_u] = sound() * s;
    w[model->i_E] = PRESSURE * (1.0 + GAMMA * s);
}

/* Mean of sin(2 pi (x + y) - phase) over a cell; in 1D without y. */
static double phase;

static double mean_wave(int dim, const double x[3], double h)
{
    double factor = sin(M_PI * h) / (M_PI * h);
    return (dim > 1 ? factor * factor : factor) * sin(2.0 * M_PI * (x[0] + x[1]) - phase);
}

static void set_wave(const struct model *model, const double x[3], double *w)
{
    double s = SIZE * mean_wave(model->dim, x, cell_width);
    w[model->i_m] = RHO * (1.0 + s);
    for (int d = 0; d < model->dim; d++) w[model->i_u + (unsigned)d] = sound() * s / sqrt((double)model->dim);
    w[model->i_E] = PRESSURE * (1.0 + GAMMA * s);
}

struct errors {
    double density, reflected; /* L1 of rho, and of the wave that runs the other way, in units of the pulse */
};

/* Tiles grow with the resolution, so that levels cover the same places. */
static void start(struct flow *flow, const char *lower, const char *upper, const char *cells, const char *sides,
                  const char *patch, int tile, const char *more)
{
    flow_start(flow, mem_print("bulla: 1\ntitle: order\ndomain: {lower: %s, upper: %s, cells: %s, boundaries: {%s}}\n"
                               "mesh: {levels: 2, tile: %d, regrid-every: 1, buffer: 2%s, refine: [{region: %s, "
                               "finest: 1}, {region: %s}]}\n"
                               "materials:\n" FLOW_AIR
                               "initial:\n  - {everywhere: true, material: air, density: 1.2, pressure: 1e5}\n"
                               "scheme: {limiter: mc, cfl: 0.4}\nrun: {until: 1}\n",
                               lower, upper, cells, sides, tile, more, patch, patch));
}

/* A pulse from x = 0.2 through the patch to 0.8. */
static struct errors pulse_errors(int cells, const char *more)
{
    struct flow flow;
    struct errors errors = {0};
    char *n = mem_print("[%d]", cells);
    start(&flow, "[0]", "[1]", n, "x-: periodic, x+: periodic", "{box: {lower: [0.45], upper: [0.55]}}", cells / 16,
          more);
    mem_free(n);
    assert_int_equal(flow.state->mesh->n_level, 3);
    middle = 0.2;
    amr_set(&flow, set_pulse, &cell_width);
    flow_until(&flow, 0.6 / sound());
    middle = 0.8;
    const struct model *model = flow.state->model;
    struct amr_leaves leaves = amr_leaves(&flow);
    for (size_t i = 0; i < leaves.n; i++) {
        const struct amr_leaf *leaf = &leaves.all[i];
        double h = flow.state->mesh->levels[leaf->l].h[0], rho = amr_primitive(&flow, leaf, model->i_m);
        double p = amr_primitive(&flow, leaf, model->i_E), u = amr_primitive(&flow, leaf, model->i_u);
        errors.density += leaf->volume * fabs(rho / RHO - 1.0 - SIZE * mean_pulse(leaf->x[0], h)) / SIZE;
        if (leaf->x[0] < 0.45)
            errors.reflected += leaf->volume * fabs((p - PRESSURE) / (GAMMA * PRESSURE) - u / sound()) / SIZE;
    }
    mem_free(leaves.all);
    flow_stop(&flow);
    return errors;
}

static double wave_error(int dim, int cells, const char *more)
{
    struct flow flow;
    double error = 0.0, per_time = 2.0 * M_PI * sqrt((double)dim) * sound();
    char *n = dim == 1 ? mem_print("[%d]", cells) : mem_print("[%d, %d]", cells, cells);
    if (dim == 1)
        start(&flow, "[0]", "[1]", n, "x-: periodic, x+: periodic", "{box: {lower: [0.45], upper: [0.55]}}", cells / 16,
              more);
    else
        start(&flow, "[0, 0]", "[1, 1]", n, "x-: periodic, x+: periodic, y-: periodic, y+: periodic",
              "{sphere: {center: [0.5, 0.5], radius: 0.2}}", cells / 4, more);
    mem_free(n);
    phase = 0.0;
    amr_set(&flow, set_wave, &cell_width);
    flow_until(&flow, M_PI / per_time);
    phase = per_time * flow.state->t;
    struct amr_leaves leaves = amr_leaves(&flow);
    for (size_t i = 0; i < leaves.n; i++) {
        double h = flow.state->mesh->levels[leaves.all[i].l].h[0];
        double rho = amr_primitive(&flow, &leaves.all[i], flow.state->model->i_m);
        error += leaves.all[i].volume * fabs(rho / RHO - 1.0 - SIZE * mean_wave(dim, leaves.all[i].x, h)) / SIZE;
    }
    mem_free(leaves.all);
    flow_stop(&flow);
    return error;
}

static void check(const char *what, double coarse, double fine, double least)
{
    double rate = log2(coarse / fine);
    print_message("%s: %.2e, %.2e: order %.2f\n", what, coarse, fine, rate);
    if (!(rate >= least)) fail_msg("%s: order %.3f is below %.2f", what, rate, least);
}

/* The limiter clips the crest of the pulse, which costs some of the order, as on one level. */
static void test_pulse(void **state)
{
    (void)state;
    struct errors coarse = pulse_errors(128, ""), fine = pulse_errors(256, ""), finest = pulse_errors(512, "");
    check("pulse 128", coarse.density, fine.density, 1.7);
    check("pulse 256", fine.density, finest.density, 1.8);
    check("reflected 128", coarse.reflected, fine.reflected, 2.0);
    check("reflected 256", fine.reflected, finest.reflected, 2.0);
}

static void test_pulse_in_one_step(void **state)
{
    (void)state;
    struct errors coarse = pulse_errors(128, ", subcycle: false"), fine = pulse_errors(256, ", subcycle: false");
    check("pulse", coarse.density, fine.density, 1.7);
    check("reflected", coarse.reflected, fine.reflected, 2.0);
}

static void test_wave(void **state)
{
    (void)state;
    check("wave", wave_error(1, 128, ""), wave_error(1, 256, ""), 1.9);
    check("wave in one step", wave_error(1, 128, ", subcycle: false"), wave_error(1, 256, ", subcycle: false"), 1.9);
    check("oblique wave", wave_error(2, 48, ""), wave_error(2, 96, ""), 1.9);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_pulse),
        cmocka_unit_test(test_pulse_in_one_step),
        cmocka_unit_test(test_wave),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
