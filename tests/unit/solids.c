/* All Riemann solvers with solids: equal sides, mirrors, fluids among solids, slip, wild states. */
#include "sides.h"

static const char *const NAMES[] = {"rusanov", "hll", "hllc", "hlld", NULL};

/* Calls `check` for every solver and shape. */
static void each_shape(unsigned solid, void (*check)(const char *name, struct shape shape, uint64_t *seed))
{
    static const struct shape shapes[] = {{.n_material = 1},
                                          {.n_material = 2, .mixed = 1},
                                          {.n_material = 1, .mixed = 1}};
    uint64_t seed = 5;
    for (const char *const *name = NAMES; *name; name++)
        for (unsigned i = 0; i < 3; i++)
            for (unsigned d = 1; d <= AXES; d++) {
                struct shape shape = shapes[i];
                shape.n_velocity = d;
                shape.solid = solid;
                for (unsigned j = 0; j < 500; j++) check(*name, shape, &seed);
            }
}

static void check_uniform(const char *name, struct shape shape, uint64_t *seed)
{
    struct face face = draw_face(seed, shape, 1.5);
    face.right = face.left;
    compare(name, &face, solve(name, shape, face), physical(shape, &face.left), 1e-15);
}

static void test_uniform(void **state)
{
    (void)state;
    each_shape(1, check_uniform);
}

static void check_mirror(const char *name, struct shape shape, uint64_t *seed)
{
    struct face face = draw_face(seed, shape, random_unit(seed) < 0.5 ? 0.02 : 1.5), image;
    if (random_unit(seed) < 0.1) { /* at rest and level: u* is exactly 0 */
        face.left.u[0] = face.right.u[0] = 0.0;
        face.right.p = face.left.p;
    }
    image = (struct face){.left = face.right, .right = face.left};
    struct side *sides[2] = {&image.left, &image.right};
    for (unsigned i = 0; i < 2; i++) {
        sides[i]->u[0] = -sides[i]->u[0];
        for (unsigned k = 0; k + 1 < AXES; k++) sides[i]->s[k] = -sides[i]->s[k];
    }
    struct out got = solve(name, shape, face), seen = solve(name, shape, image), swap = seen;
    seen.u = -seen.u;
    seen.rho_E = -seen.rho_E;
    for (unsigned l = 0; l < MATERIALS; l++) seen.m[l] = -seen.m[l];
    for (unsigned k = 1; k < AXES; k++) seen.momentum[k] = -seen.momentum[k];
    memcpy(seen.slide_left, swap.slide_right, sizeof seen.slide_left);
    memcpy(seen.slide_right, swap.slide_left, sizeof seen.slide_right);
    if (got.u == 0.0) memcpy(seen.alpha, got.alpha, sizeof seen.alpha); /* nothing moves: either side may be upwind */
    compare(name, &face, got, seen, 0.0);
}

static void test_mirror(void **state)
{
    (void)state;
    each_shape(1, check_mirror);
}

/* Two fluids in a scene of solids: as without, bitwise; and hlld is hllc. */
static void check_fluids(const char *name, struct shape shape, uint64_t *seed)
{
    double speed = random_unit(seed) < 0.5 ? 0.02 : 1.5;
    struct face face = {.left = draw(seed, shape, 0.0, speed), .right = draw(seed, shape, 0.0, speed)};
    struct shape fluid = shape;
    fluid.solid = 0;
    struct out got = solve(name, shape, face), want = solve(name, fluid, face);
    for (unsigned k = 1; k < shape.n_velocity; k++) {
        want.slide_left[k - 1] = face.left.u[k];
        want.slide_right[k - 1] = face.right.u[k];
    }
    compare(name, &face, got, want, 0.0);
    if (strcmp(name, "hlld") == 0) {
        struct out contact = solve("hllc", fluid, face);
        compare("hlld as hllc", &face, solve(name, fluid, face), contact, 0.0);
    }
}

static void test_fluids(void **state)
{
    (void)state;
    each_shape(1, check_fluids);
}

/* A stressed solid on the left of a fluid: nothing pulls at the fluid, which keeps its velocity. */
static void check_slip(const char *name, struct shape shape, uint64_t *seed)
{
    if (shape.n_material == 1 && !shape.mixed) return; /* averages contacts */
    double speed = random_unit(seed) < 0.5 ? 1e-4 : 0.3;
    struct face face = {.left = draw(seed, shape, 1e7, speed), .right = draw(seed, shape, 0.0, speed)};
    if (random_unit(seed) < 0.2) {
        face.left.u[0] = face.right.u[0] = 0.0;
        face.right.p = face.left.p;
    }
    struct out got = solve(name, shape, face), scale = scale_of(&face);
    double mass = 0.0;
    for (unsigned l = 0; l < shape.n_material; l++) mass += got.m[l];
    for (unsigned k = 1; k < shape.n_velocity; k++) {
        assert_true(got.slide_right[k - 1] == face.right.u[k]);
        assert_true(got.slide_left[k - 1] != face.right.u[k]);
        if (got.u < 0.0) assert_true(fabs(got.momentum[k] - mass * face.right.u[k]) <= 1e-15 * scale.momentum[k]);
        if (got.u == 0.0) assert_true(got.momentum[k] == 0.0 && got.rho_E == 0.0);
    }
}

static void test_slip(void **state)
{
    (void)state;
    each_shape(1, check_slip);
}

/* Wild states: finite in every case, whatever the mixture of fluids and solids of a row. */
static void test_finite(void **state)
{
    (void)state;
    struct shape shape = {.n_material = 2, .n_velocity = AXES, .mixed = 1, .solid = 1};
    static struct face faces[ROW];
    static struct out outs[ROW];
    uint64_t seed = 77;
    for (unsigned j = 0; j < 1000000 / ROW; j++) {
        for (unsigned i = 0; i < ROW; i++) {
            double mu[2];
            for (unsigned k = 0; k < 2; k++)
                mu[k] = random_unit(&seed) < 0.2 ? 0.0 : pow(10.0, random_between(&seed, -300.0, 12.0));
            double speed = pow(10.0, random_between(&seed, -6.0, 1.0));
            faces[i] = (struct face){draw(&seed, shape, mu[0], speed), draw(&seed, shape, mu[1], speed)};
        }
        shape.n_material = 1 + j % 2;
        shape.mixed = shape.n_material == 2 || j % 4 == 0;
        for (const char *const *name = NAMES; *name; name++) {
            solve_row(*name, shape, ROW, faces, outs);
            double values[ROW][OUT];
            memcpy(values, outs, sizeof values);
            for (unsigned i = 0; i < ROW; i++)
                for (unsigned q = 0; q < OUT; q++)
                    if (!isfinite(values[i][q])) fail_msg("%s: value %u is %g", *name, q, values[i][q]);
        }
        shape.n_material = 2;
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_uniform), cmocka_unit_test(test_mirror), cmocka_unit_test(test_fluids),
        cmocka_unit_test(test_slip),    cmocka_unit_test(test_finite),
    };
    return cmocka_run_group_tests(tests, sides_start, sides_stop);
}
