/* Areas and volumes: they fill the domain exactly, tiles share the bits of a face, and a free stream stays one. */
#include "flow.h"

static const char *const GEOMETRY[] = {"cartesian", "axisymmetric", "spherical"};

/* A gas in 1D or 2D of a geometry. */
static void start(struct flow *flow, int beta, int dim, const char *lower, const char *upper, int tile)
{
    const char *inner = beta && !strcmp(lower, "0") ? "axis" : "reflecting";
    char *sides = mem_print("{x-: %s, x+: %s%s}", inner, beta == 1 ? "symmetry" : "reflecting",
                            dim == 2 ? ", y-: periodic, y+: periodic" : "");
    flow_start(flow, mem_print("bulla: 1\ntitle: metric\ndomain: {geometry: %s, lower: [%s%s], upper: [%s%s], cells: "
                               "[48%s], boundaries: %s}\nmesh: {tile: %d}\nmaterials:\n" FLOW_AIR FLOW_WATER
                               "initial:\n  - {everywhere: true, material: air, density: 1.2, pressure: 1e5}\n"
                               "run: {until: 1}\n",
                               GEOMETRY[beta], lower, dim == 2 ? ", -1" : "", upper, dim == 2 ? ", 2" : "",
                               dim == 2 ? ", 48" : "", sides, tile));
    mem_free(sides);
}

static void check_volume(int beta, int dim, const char *lower, const char *upper, double exact)
{
    struct flow flow;
    long double sum = 0.0L;
    start(&flow, beta, dim, lower, upper, 16);
    double *volume = flow_volumes(&flow);
    for (size_t c = 0; c < flow.n_cell; c++) {
        assert_true(volume[c] > 0.0);
        sum += volume[c];
    }
    if (!(fabsl(sum - exact) <= 4e-15 * exact)) fail_msg("%s: %.17Lg, not %.17g", GEOMETRY[beta], sum, exact);
    mem_free(volume);
    flow_stop(&flow);
}

static void test_volume(void **state)
{
    (void)state;
    check_volume(0, 1, "-0.3", "1.7", 2.0);
    check_volume(0, 2, "-0.3", "1.7", 6.0);
    check_volume(1, 2, "0", "1.3", M_PI * 1.69 * 3.0);
    check_volume(1, 2, "0.5", "1.3", M_PI * (1.69 - 0.25) * 3.0);
    check_volume(2, 1, "0", "1.3", 4.0 / 3.0 * M_PI * 2.197);
    check_volume(2, 1, "0.1", "1.3", 4.0 / 3.0 * M_PI * (2.197 - 0.001));
}

/* The upper face of a tile is the lower face of the next; areas close every cell: A+ - A- of axis 0 is the volume
 * times beta/r averaged, so that a uniform pressure pushes nothing. */
static void test_faces(void **state)
{
    (void)state;
    for (int beta = 0; beta < 3; beta++) {
        struct flow flow;
        struct metric one, next;
        start(&flow, beta, beta == 1 ? 2 : 1, "0", "0.7", 8);
        const struct mesh *mesh = flow.state->mesh;
        const struct level *level = flow_level(&flow);
        int at[3] = {0, 0, 0}, seen = 0;
        for (; at[0] + 1 < level->extent[0]; at[0]++) {
            int after[3] = {at[0] + 1, 0, 0};
            metric_of_tile(mesh, level, &level->tiles[mesh_find(mesh, level, at)], &one);
            metric_of_tile(mesh, level, &level->tiles[mesh_find(mesh, level, after)], &next);
            assert_true(one.area[8] == next.area[0]);
            for (int i = 0; i < 8; i++) {
                double r = one.centre[i], h = level->h[0], exact = beta == 0 ? 1.0 : beta == 1 ? r + h / 2 : 0.0;
                if (beta == 2) exact = (r + h / 2) * (r + h / 2);
                assert_true(fabs(one.area[i + 1] - exact) <= 1e-14);
                assert_true(one.volume[i] >= h * fmin(one.area[i], one.area[i + 1]));
                assert_true(one.volume[i] <= h * fmax(one.area[i], one.area[i + 1]) * (1.0 + 1e-14));
            }
            seen++;
        }
        assert_int_equal(seen, 5);
        flow_stop(&flow);
    }
}

static void set_stream(const struct model *model, const double x[3], double *w)
{
    (void)x;
    w[0] = 0.3;
    w[1] = 0.7;
    w[model->i_m] = 1.2;
    w[model->i_m + 1] = 1000.0;
    w[model->i_u + 1] = 250.0;
    w[model->i_E] = 1e5;
}

/* Along z of an axisymmetric domain. */
static void test_free_stream(void **state)
{
    (void)state;
    struct flow flow;
    start(&flow, 1, 2, "0", "1", 16);
    flow_set(&flow, set_stream);
    const struct model *model = flow.state->model;
    flow_steps(&flow, 100);
    double wanted[FLOW_FIELDS] = {0}, worst = 0.0, dp = 0.0;
    set_stream(model, wanted, wanted);
    for (unsigned q = 0; q < model->n_field; q++) {
        double *w = flow_primitive(&flow, q), scale = q == model->i_u ? 250.0 : wanted[q];
        for (size_t c = 0; c < flow.n_cell; c++) {
            double off = fabs(w[c] - wanted[q]) / scale;
            if (q == model->i_E) dp = fmax(dp, off);
            else worst = fmax(worst, off);
        }
        mem_free(w);
    }
    print_message("free stream: p off by %.1e, the rest by %.1e, relative\n", dp, worst);
    assert_true(worst < 1e-12);
    assert_true(dp < 1e-10);
    flow_stop(&flow);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_volume),
        cmocka_unit_test(test_faces),
        cmocka_unit_test(test_free_stream),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
