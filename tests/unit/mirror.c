/* Symmetry: a mirrored or turned start gives the mirrored or turned end, to the bit in 1D and 2D, and a
 * symmetric one stays symmetric. Three materials, shocks, repairs and all. */
#include "flow.h"

enum { STEPS = 60, CELLS = 32 };

static const char MATERIALS[] = FLOW_WATER FLOW_AIR FLOW_HELIUM;

/* What a run starts from: x is mapped before the state is asked for. */
static struct {
    double sign[3];
    int axis[3]; /* axis[d]: axis of the plain state that axis d of this run shows */
} map;

/* A skew state without any symmetry. */
static void set_skew(const struct model *model, const double x[3], double *w)
{
    double y[3] = {0}, velocity[3] = {0};
    for (int d = 0; d < 3; d++) y[map.axis[d]] = map.sign[d] * x[d];
    double bubble = hypot(hypot(y[0] - 0.21, y[1] + 0.13), y[2] + 0.1) < 0.37 ? 1.0 : 0.0;
    double drop = hypot(hypot(y[0] + 0.5, y[1] - 0.45), y[2]) < 0.3 ? 1.0 : 0.0;
    double haze = 0.05 * (1.0 - bubble) * (1.0 - drop) * (y[0] + 1.0) * (y[1] + 1.0);
    w[1] = bubble + haze;
    w[2] = drop;
    w[0] = 1.0 - w[1] - w[2];
    w[0] = w[0] > 0.0 ? w[0] : 0.0;
    velocity[0] = 30.0 * y[1];
    velocity[1] = -20.0 + 10.0 * y[0];
    velocity[2] = 15.0 * y[0] * y[2];
    for (int d = 0; d < model->dim; d++) w[model->i_u + (unsigned)d] = map.sign[d] * velocity[map.axis[d]];
    w[model->i_E] = y[0] + 0.3 * y[1] > 0.55 ? 2e8 : 1e5;
}

static void start(struct flow *flow, int dim, const char *scheme, const double sign[3], const int axis[3])
{
    static const char *const lower[] = {"-1", "-1, -1", "-1, -1, -1"}, *const upper[] = {"1", "1, 1", "1, 1, 1"};
    static const char *const cells[] = {"64", "32, 32", "16, 16, 16"};
    static const char *const sides[] = {"x-: reflecting, x+: reflecting", ", y-: reflecting, y+: reflecting",
                                        ", z-: reflecting, z+: reflecting"};
    flow_start(flow, mem_print("bulla: 1\ntitle: mirror\ndomain: {lower: [%s], upper: [%s], cells: [%s], boundaries: "
                               "{%s%s%s}}\nmesh: {tile: 16}\nmaterials:\n%sinitial:\n"
                               "  - {everywhere: true, material: water, density: 1000, pressure: 1e5}\n"
                               "scheme: %s\nrun: {until: 1}\n",
                               lower[dim - 1], upper[dim - 1], cells[dim - 1], sides[0], dim > 1 ? sides[1] : "",
                               dim > 2 ? sides[2] : "", MATERIALS, scheme));
    memcpy(map.sign, sign, sizeof map.sign);
    memcpy(map.axis, axis, sizeof map.axis);
    flow_set(flow, set_skew);
}

/* Cell of the plain run that cell c of the mapped one shows. */
static size_t source_of(const struct flow *flow, size_t c, const double sign[3], const int axis[3])
{
    size_t n = (size_t)flow->scene->domain.cells[0], at[3] = {0}, from[3] = {0}, dim = (size_t)flow->scene->domain.dim;
    for (size_t d = 0; d < dim; d++, c /= n) at[d] = c % n;
    for (size_t d = 0; d < dim; d++) from[axis[d]] = sign[d] < 0.0 ? n - 1 - at[d] : at[d];
    return from[0] + n * (dim > 1 ? from[1] : 0) + n * n * from[2];
}

/* Largest difference of the mapped run from the plain one, relative to the largest value of each field. */
static double difference(const struct flow *plain, const struct flow *other, const double sign[3], const int axis[3])
{
    const struct model *model = plain->state->model;
    double worst = 0.0;
    for (unsigned q = 0; q < model->n_field; q++) {
        bool velocity = q >= model->i_u && q < model->i_E;
        unsigned d = velocity ? q - model->i_u : 0;
        double *b = flow_conserved(other, q), factor = velocity ? sign[d] : 1.0, size = 0.0, off = 0.0;
        double *a = flow_conserved(plain, velocity ? model->i_u + (unsigned)axis[d] : q);
        for (size_t c = 0; c < plain->n_cell; c++) {
            size = fmax(size, fabs(a[c]));
            off = fmax(off, fabs(b[c] - factor * a[source_of(plain, c, sign, axis)]));
        }
        worst = fmax(worst, size > 0.0 ? off / size : off);
        mem_free(a);
        mem_free(b);
    }
    return worst;
}

static double compare(int dim, const char *scheme, const double sign[3], const int axis[3])
{
    struct flow plain, other;
    start(&plain, dim, scheme, (const double[]){1, 1, 1}, (const int[]){0, 1, 2});
    start(&other, dim, scheme, sign, axis);
    assert_true(difference(&plain, &other, sign, axis) == 0.0);
    flow_steps(&plain, STEPS / dim);
    flow_steps(&other, STEPS / dim);
    double worst = difference(&plain, &other, sign, axis);
    if (dim < 3) assert_true(plain.state->t == other.state->t);
    flow_stop(&plain);
    flow_stop(&other);
    return worst;
}

static const char *const SCHEMES[] = {
    "{limiter: mc, riemann: hllc}",
    "{limiter: superbee, riemann: hll}",
    "{limiter: van-albada, riemann: rusanov}",
};

static void check(int dim, const double sign[3], const int axis[3], double most)
{
    for (int s = 0; s < 3; s++) {
        double worst = compare(dim, SCHEMES[s], sign, axis);
        if (!(worst <= most)) fail_msg("%dD, %s: differs by %g", dim, SCHEMES[s], worst);
        if (dim == 3) print_message("3D, %s: %.1e\n", SCHEMES[s], worst);
    }
}

static void test_mirror(void **state)
{
    (void)state;
    const int same[] = {0, 1, 2};
    check(1, (const double[]){-1, 1, 1}, same, 0.0);
    check(2, (const double[]){-1, 1, 1}, same, 0.0);
    check(2, (const double[]){1, -1, 1}, same, 0.0);
    check(3, (const double[]){1, -1, -1}, same, 0.0);
}

static void test_transpose(void **state)
{
    (void)state;
    check(2, (const double[]){1, 1, 1}, (const int[]){1, 0, 2}, 0.0);
    check(2, (const double[]){-1, 1, 1}, (const int[]){1, 0, 2}, 0.0);
    check(3, (const double[]){1, 1, 1}, (const int[]){1, 2, 0}, 1e-12);
}

/* A round explosion in a square keeps all eight images of a cell equal; in a cube the six of a cell up to round-off. */
static void test_explosion(void **state)
{
    (void)state;
    struct flow flow;
    flow_start(&flow, mem_print("bulla: 1\ntitle: explosion\ndomain: {lower: [-1, -1], upper: [1, 1], cells: [%d, %d], "
                                "boundaries: {x-: outflow, x+: outflow, y-: outflow, y+: outflow}}\n"
                                "materials:\n" FLOW_AIR FLOW_WATER "initial:\n"
                                "  - {everywhere: true, material: water, density: 1000, pressure: 1e5}\n"
                                "  - {sphere: {center: [0, 0], radius: 0.41}, material: air, density: 100, pressure: "
                                "5e7}\nrun: {until: 1}\n",
                                CELLS, CELLS));
    flow_steps(&flow, 2 * STEPS);
    const struct model *model = flow.state->model;
    double *u = flow_conserved(&flow, model->i_u), *v = flow_conserved(&flow, model->i_u + 1);
    for (unsigned q = 0; q < model->n_field; q++) {
        if (q == model->i_u || q == model->i_u + 1) continue;
        double *a = flow_conserved(&flow, q);
        for (size_t j = 0; j < CELLS; j++)
            for (size_t i = 0; i < CELLS; i++) {
                assert_true(a[j * CELLS + i] == a[i * CELLS + j]);
                assert_true(a[j * CELLS + i] == a[j * CELLS + CELLS - 1 - i]);
            }
        mem_free(a);
    }
    for (size_t j = 0; j < CELLS; j++)
        for (size_t i = 0; i < CELLS; i++) {
            assert_true(u[j * CELLS + i] == v[i * CELLS + j]);
            assert_true(u[j * CELLS + i] == -u[j * CELLS + CELLS - 1 - i]);
            assert_true(u[j * CELLS + i] == u[(CELLS - 1 - j) * CELLS + i]);
        }
    mem_free(u);
    mem_free(v);
    flow_stop(&flow);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_mirror),
        cmocka_unit_test(test_transpose),
        cmocka_unit_test(test_explosion),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
