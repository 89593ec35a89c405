/* How the domain is cut into tiles, and a tile into frames, changes no bit of a result. */
#include "flow.h"

enum { STEPS = 25 };

static const char *const DOMAINS[] = {
    "{lower: [0], upper: [1], cells: [256], boundaries: {x-: non-reflecting, x+: reflecting}}",
    "{geometry: spherical, lower: [0], upper: [1], cells: [256], boundaries: {x-: axis, x+: outflow}}",
    "{lower: [0, 0], upper: [1, 1], cells: [64, 64], boundaries: {x-: periodic, x+: periodic, y-: no-slip, "
    "y+: non-reflecting}}",
    "{geometry: axisymmetric, lower: [0, 0], upper: [1, 1], cells: [64, 64], boundaries: {x-: axis, "
    "x+: {type: incoming-wave, pulse: sine, amplitude: 1 MPa, frequency: 10 kHz}, y-: outflow, y+: non-reflecting}}",
    "{lower: [0, 0], upper: [1, 1], cells: [64, 64], boundaries: {x-: {type: inflow, material: air, density: 1.2, "
    "pressure: 2e5, velocity: [40, 0]}, x+: outflow, y-: reflecting, y+: symmetry}}",
    "{lower: [0, 0, 0], upper: [1, 1, 1], cells: [32, 32, 32], boundaries: {x-: periodic, x+: periodic, "
    "y-: non-reflecting, y+: reflecting, z-: outflow, z+: {type: incoming-wave, pulse: sine, amplitude: 1 MPa, "
    "frequency: 10 kHz}}}",
};

static const char *const FLUIDS[] = {
    (FLOW_WATER FLOW_AIR),
    "  water: {eos: {type: mnasg, preset: water}}\n  air: {eos: {type: rkpr}}\n",
    ("  water: {eos: {type: iapws95}}\n" FLOW_AIR),
};

static const char *materials = FLOW_WATER FLOW_AIR;

static bool quiet; /* most of the domain rests: small tiles are carried on, large ones computed */
static bool whole; /* pure materials only: small tiles then hold one, large ones both */

/* Skew pressures and velocities, a bubble that tile borders cut. */
static void set_state(const struct model *model, const double x[3], double *w)
{
    double bubble = hypot(hypot(x[0] - 0.52, x[1] - 0.47), x[2] - 0.3) < 0.33 ? 1.0 : 0.0;
    double solid = model->n_solid && x[1] < 0.2 ? 1.0 : 0.0;
    w[1] = (1.0 - solid) * (whole ? bubble : 0.9 * bubble + 0.1 * x[0] * x[0]);
    w[0] = 1.0 - solid - w[1];
    if (model->n_solid) w[2] = solid;
    for (int d = 0; d < model->dim; d++) w[model->i_u + (unsigned)d] = 40.0 * cos(3.0 * x[0] + 2.0 * x[1] + (double)d);
    w[model->i_E] = x[0] + 0.5 * x[1] - x[2] > 0.6 ? 1e8 : 2e5;
    if (!quiet) return;
    for (int d = 0; d < model->dim; d++) w[model->i_u + (unsigned)d] = 0.0;
    w[model->i_E] = hypot(x[0] - 0.8, x[1] - 0.7) < 0.1 ? 1e7 : 2e5;
}

static void run(struct flow *flow, const char *domain, int tile, const char *extra)
{
    flow_start(flow, mem_print("bulla: 1\ntitle: tiles\ndomain: %s\nmesh: {tile: %d}\nmaterials:\n%sinitial:\n  - "
                               "{everywhere: true, material: water, density: 1000, pressure: 1e5}\n"
                               "scheme: %s\nrun: {until: 1}\n",
                               domain, tile, materials, extra));
    flow_set(flow, set_state);
    flow_steps(flow, flow->scene->domain.dim == 3 ? STEPS / 3 : STEPS);
}

static void compare(const char *domain, const int *tiles, int count, const char *extra)
{
    struct flow first, other;
    run(&first, domain, tiles[0], extra);
    for (int i = 1; i < count; i++) {
        run(&other, domain, tiles[i], extra);
        if (!flow_equal(&first, &other)) fail_msg("tiles of %d and %d differ: %s", tiles[0], tiles[i], domain);
        assert_true(first.state->t == other.state->t);
        flow_stop(&other);
    }
    flow_stop(&first);
}

static void check(const char *domain, const int *tiles, int count, const char *extra)
{
    for (int pure = 0; pure < 2; pure++) {
        whole = pure;
        compare(domain, tiles, count, extra);
    }
}

static void test_line(void **state)
{
    (void)state;
    const int tiles[] = {8, 4, 16, 32, 128, 256};
    check(DOMAINS[0], tiles, 6, "{limiter: mc}");
    check(DOMAINS[1], tiles, 6, "{limiter: superbee}");
}

static void test_plane(void **state)
{
    (void)state;
    const int tiles[] = {8, 16, 32, 64};
    check(DOMAINS[2], tiles, 4, "{limiter: mc}");
    check(DOMAINS[3], tiles, 4, "{limiter: van-leer, riemann: rusanov}");
    check(DOMAINS[4], tiles, 4, "{limiter: superbee, riemann: hll}");
}

static void test_space(void **state)
{
    (void)state;
    const int tiles[] = {8, 16, 32};
    check(DOMAINS[5], tiles, 3, "{limiter: mc}");
}

/* Some small tiles are indeed advanced as if there were one material, and some are not. */
static void test_paths(void **state)
{
    (void)state;
    struct flow flow;
    unsigned pure = 0, all;
    whole = true;
    run(&flow, DOMAINS[2], 8, "{limiter: mc}");
    all = flow_level(&flow)->n_local;
    for (unsigned t = 0; t < all; t++) pure += flow.state->stages[0]->census.tiles[t].path != flow.state->model;
    print_message("%u of %u tiles were advanced with one material\n", pure, all);
    assert_true(pure > 0 && pure < all);
    flow_stop(&flow);
}

/* Fluids beside a solid that is stiffer than they are: tiles without it are advanced as if there were none. */
static void test_fluids(void **state)
{
    (void)state;
    const int tiles[] = {8, 16, 64};
    materials =
        FLOW_WATER FLOW_AIR "  bone: {eos: {type: stiffened-gas, gamma: 4.4, p-inf: 6 GPa}, constitutive: {type: "
                            "neo-hookean, shear-modulus: 1 MPa, reference-density: 1000}}\n";
    check(DOMAINS[2], tiles, 3, "{riemann: hlld, exchange: fast}");
    check(DOMAINS[2], tiles, 3, "{riemann: hlld, exchange: full}");
    materials = FLUIDS[0];
}

/* Laws with iterated pressures, beside some without. */
static void test_laws(void **state)
{
    (void)state;
    const int tiles[] = {8, 16, 64};
    for (size_t i = 1; i < sizeof FLUIDS / sizeof *FLUIDS; i++) {
        materials = FLUIDS[i];
        check(DOMAINS[2], tiles, 3, "{limiter: mc}");
    }
    materials = FLUIDS[0];
}

/* Small tiles that rest are indeed carried on, whatever the law, and large ones that hold them are not. */
static void test_resting(void **state)
{
    (void)state;
    const int tiles[] = {8, 64};
    quiet = whole = true;
    for (size_t i = 0; i < sizeof FLUIDS / sizeof *FLUIDS; i++) {
        struct flow flow;
        materials = FLUIDS[i];
        run(&flow, DOMAINS[2], 8, "{limiter: mc}");
        print_message("%lld of %lld cells were carried on\n", flow.state->counts.carried, flow.state->counts.cells);
        assert_true(flow.state->counts.carried > flow.state->counts.cells / 8);
        flow_stop(&flow);
        compare(DOMAINS[2], tiles, 2, "{limiter: mc}");
    }
    quiet = false;
    materials = FLUIDS[0];
}

/* Frames stay within their room and cover every cell once, whatever the tile. */
static void test_frames(void **state)
{
    (void)state;
    const struct {
        int dim, n;
    } tiles[] = {{1, 4}, {1, 256}, {2, 8}, {2, 37}, {2, 64}, {2, 256}, {3, 4}, {3, 16}, {3, 32}, {3, 64}};
    for (size_t i = 0; i < sizeof tiles / sizeof *tiles; i++) {
        struct mesh mesh = {.dim = tiles[i].dim, .n = {1, 1, 1}, .n_cell = 1};
        for (int d = 0; d < mesh.dim; d++) {
            mesh.n[d] = tiles[i].n;
            mesh.n_cell *= (size_t)tiles[i].n;
        }
        for (int axis = 0; axis < mesh.dim; axis++) {
            unsigned char *seen = mem_new(mesh.n_cell, 1);
            for (size_t piece = 0; piece < frame_pieces(&mesh, axis); piece++) {
                struct frame frame = frame_piece(&mesh, axis, piece);
                assert_true(frame.count > 0 && frame.count <= FRAME_CELLS);
                for (size_t o = 0; o < frame.outer; o++)
                    for (size_t a = 0; a < frame.n; a++)
                        for (size_t k = 0; k < frame.inner; k++) seen[frame_tile_at(&frame, o, a) + k]++;
            }
            for (size_t c = 0; c < mesh.n_cell; c++) assert_int_equal(seen[c], 1);
            mem_free(seen);
        }
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_frames), cmocka_unit_test(test_line),    cmocka_unit_test(test_plane),
        cmocka_unit_test(test_space),  cmocka_unit_test(test_paths),   cmocka_unit_test(test_fluids),
        cmocka_unit_test(test_laws),   cmocka_unit_test(test_resting),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
