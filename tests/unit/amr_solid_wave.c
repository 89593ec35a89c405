/* Small waves in a solid, of pressure and of shear, through a patch of two finer levels: they arrive as they should,
 * and what the faces between levels send back is not more than in a fluid and gets less with order two. */
#include "amr.h"

static const double SIZE = 1e-5, RHO = 1000.0, PRESSURE = 1e5, GAMMA = 4.4, P_INF = 6e8, MODULUS = 1e9, WIDTH = 0.09;

enum kind { FLUID, PUSH, SHEAR };
static const char *const KINDS[] = {"fluid", "pressure wave", "shear wave"};

/* What is under way: where the pulse has its middle, and the cell size it is averaged over. */
static enum kind kind;
static double middle, cell_width;

static double modulus_of(enum kind which)
{
    double fluid = GAMMA * (PRESSURE + P_INF);
    return which == FLUID ? fluid : which == PUSH ? fluid + 4.0 / 3.0 * MODULUS : MODULUS;
}

static double speed(void)
{
    return sqrt(modulus_of(kind) / RHO);
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

/* To the right: a compression s with u = c s, or a shear s with v = -c s. */
static void set_pulse(const struct model *model, const double x[3], double *w)
{
    double s = SIZE * mean_pulse(x[0], cell_width), *V = w + model->i_V;
    if (kind == SHEAR) {
        w[model->i_u + 1] = -speed() * s;
        V[3] = 0.5 * s;
        return;
    }
    w[model->i_m] = RHO * (1.0 + s);
    w[model->i_u] = speed() * s;
    w[model->i_E] = PRESSURE + GAMMA * (PRESSURE + P_INF) * s;
    if (kind == FLUID) return;
    V[0] = pow(1.0 + s, -2.0 / 3.0);
    V[1] = V[2] = pow(1.0 + s, 1.0 / 3.0);
}

struct errors {
    double wave, reflected; /* L1 of the wave to the right, and of the one that runs the other way, over the pulse */
};

/* Strain and velocity over the speed, as waves have them: equal to the right, opposite to the left. */
static void measure(const struct flow *flow, const struct amr_leaf *leaf, double *strain, double *pace)
{
    const struct model *model = flow->state->model;
    double p = amr_primitive(flow, leaf, model->i_E) - PRESSURE;
    double V = kind == FLUID ? 0.0 : amr_primitive(flow, leaf, model->i_V + (kind == SHEAR ? 3 : 0));
    *pace = amr_primitive(flow, leaf, model->i_u + (kind == SHEAR)) / speed();
    *strain = kind == FLUID ? p / modulus_of(kind) : (p - 2.0 * MODULUS * (V - 1.0)) / modulus_of(kind);
    if (kind != SHEAR) return;
    *strain = 2.0 * V;
    *pace = -*pace;
}

/* A pulse from x = 0.2 through the patch to 0.8. */
static struct errors pulse_errors(int cells, double cfl, const char *more)
{
    struct flow flow;
    struct errors errors = {0};
    flow_start(&flow, mem_print("bulla: 1\ntitle: waves\ndomain: {lower: [0], upper: [1], cells: [%d], "
                                "velocity-components: 2, boundaries: {x-: periodic, x+: periodic}}\n"
                                "mesh: {levels: 2, tile: %d, regrid-every: 1, buffer: 2%s, refine: [{region: {box: "
                                "{lower: [0.45], upper: [0.55]}}}]}\n"
                                "materials:\n  body: {eos: {type: stiffened-gas, gamma: 4.4, p-inf: 600 MPa}%s}\n"
                                "initial:\n  - {everywhere: true, material: body, density: 1000, pressure: 1e5}\n"
                                "scheme: {limiter: mc, cfl: %.17g}\nrun: {until: 1}\n",
                                cells, cells / 16, more,
                                kind == FLUID ? ""
                                              : ", constitutive: {type: neo-hookean, shear-modulus: 1 GPa, "
                                                "reference-density: 1000}",
                                cfl));
    assert_int_equal(flow.state->mesh->n_level, 3);
    middle = 0.2;
    amr_set(&flow, set_pulse, &cell_width);
    flow_until(&flow, 0.6 / speed());
    middle = 0.8;
    struct amr_leaves leaves = amr_leaves(&flow);
    for (size_t i = 0; i < leaves.n; i++) {
        const struct amr_leaf *leaf = &leaves.all[i];
        double h = flow.state->mesh->levels[leaf->l].h[0], strain, pace;
        measure(&flow, leaf, &strain, &pace);
        errors.wave += leaf->volume * fabs(0.5 * (strain + pace) / SIZE - mean_pulse(leaf->x[0], h));
        if (leaf->x[0] < 0.45) errors.reflected += leaf->volume * fabs(strain - pace) / SIZE;
    }
    mem_free(leaves.all);
    flow_stop(&flow);
    return errors;
}

static void check(const char *what, double coarse, double fine, double least)
{
    double rate = log2(coarse / fine);
    print_message("%s, %s: %.2e, %.2e: order %.2f\n", KINDS[kind], what, coarse, fine, rate);
    if (!(rate >= least)) fail_msg("%s, %s: order %.3f is below %.2f", KINDS[kind], what, rate, least);
}

/* What a fluid's wave sends back at 256 cells when it goes as far in a step as the waves of `which` do. */
static double fluid_reflection(enum kind which, const char *more)
{
    kind = FLUID;
    return pulse_errors(256, 0.4 * sqrt(modulus_of(which) / modulus_of(which == SHEAR ? PUSH : which)), more).reflected;
}

static void check_waves(const char *more)
{
    for (enum kind which = PUSH; which <= SHEAR; which++) {
        double fluid = fluid_reflection(which, more);
        kind = which;
        struct errors coarse = pulse_errors(128, 0.4, more), fine = pulse_errors(256, 0.4, more);
        check("wave", coarse.wave, fine.wave, 1.7);
        check("reflected", coarse.reflected, fine.reflected, 2.0);
        print_message("  a fluid's: %.2e\n", fluid);
        assert_true(fine.reflected <= 1.1 * fluid);
    }
}

static void test_waves(void **state)
{
    (void)state;
    check_waves("");
}

static void test_waves_in_one_step(void **state)
{
    (void)state;
    check_waves(", subcycle: false");
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_waves),
        cmocka_unit_test(test_waves_in_one_step),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
