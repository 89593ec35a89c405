/* Wave speeds of elastic laws against the acoustic tensor from differences of the stress: a strain a (x) n moves B, and
 * what the traction on n changes by is the tensor. A law that is curved in both invariants has all terms. */
#include "mesh/axis.h"
#include "phys/elastic.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "close.h"

#define FLUID 2.0e9 /* rho c_f^2 */
#define DENSITY 1100.0

/* e = c1 (I1 - 3) + c2 (I2 - 3) + c11 (I1 - 3)^2 + c12 (I1 - 3)(I2 - 3) + c22 (I2 - 3)^2 */
struct law {
    double c1, c2, c11, c12, c22;
};

static const struct law CURVED = {2e5, 1e5, 4e4, 3e4, 2e4}, PLAIN = {.c1 = 2e5};

static void energy(const void *self, size_t n, const double *I1, const double *I2, double *e, double *e_1, double *e_2)
{
    const struct law *law = self;
    for (size_t i = 0; i < n; i++) {
        double x = I1[i] - 3.0, y = I2[i] - 3.0;
        e[i] = law->c1 * x + law->c2 * y + law->c11 * x * x + law->c12 * x * y + law->c22 * y * y;
        e_1[i] = law->c1 + 2.0 * law->c11 * x + law->c12 * y;
        e_2[i] = law->c2 + law->c12 * x + 2.0 * law->c22 * y;
    }
}

static void second(const void *self, size_t n, const double *I1, const double *I2, double *e_11, double *e_12,
                   double *e_22)
{
    const struct law *law = self;
    for (size_t i = 0; i < n; i++) {
        e_11[i] = 2.0 * law->c11 + 0.0 * I1[i];
        e_12[i] = law->c12 + 0.0 * I2[i];
        e_22[i] = 2.0 * law->c22;
    }
}

static const struct bulla_constitutive BOTH = {.size = sizeof BOTH, .energy = energy, .second = second};
static const struct bulla_constitutive FIRST = {.size = sizeof FIRST, .energy = energy, .first_only = 1};

static struct model model_of(const struct law *law)
{
    struct model model = {.dim = 3, .n_velocity = 3, .n_material = 1, .n_solid = 1, .elastic = true};
    model.i_u = 1;
    model.i_E = 4;
    model.i_V = 5;
    model.n_stretch = 6;
    model.n_field = 11;
    model.solids[0] = (struct model_solid){.stretch = model.i_V, .law = law == &PLAIN ? &FIRST : &BOTH, .self = law};
    return model;
}

typedef double matrix[3][3];

static void product(const matrix a, const matrix b, matrix ret)
{
    for (int i = 0; i < 3; i++)
        for (int j = 0; j < 3; j++) ret[i][j] = a[i][0] * b[0][j] + a[i][1] * b[1][j] + a[i][2] * b[2][j];
}

/* Traction on the face normal to n, of matter with B. */
static void traction(const struct law *law, const matrix B, double rho, unsigned n, double ret[3])
{
    matrix C;
    product(B, B, C);
    double I1 = B[0][0] + B[1][1] + B[2][2], trace = C[0][0] + C[1][1] + C[2][2], I2 = 0.5 * (I1 * I1 - trace);
    double e, e_1, e_2;
    energy(law, 1, &I1, &I2, &e, &e_1, &e_2);
    double G1 = 2.0 * rho * (e_1 + I1 * e_2), G2 = 2.0 * rho * e_2;
    for (unsigned i = 0; i < 3; i++) {
        ret[i] = G1 * B[i][n] - G2 * C[i][n];
        if (i == n) ret[i] -= (G1 * I1 - G2 * trace) / 3.0;
    }
}

/* Row of the acoustic tensor (times rho) of a strain along `a` across n. */
static void acoustic(const struct law *law, const matrix B, unsigned n, unsigned a, double ret[3])
{
    const double h = 1e-5;
    double t[2][3];
    for (int side = 0; side < 2; side++) {
        double step = side ? h : -h, det = a == n ? 1.0 + step : 1.0;
        matrix F = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}, turned, FB, moved;
        F[a][n] += step;
        for (int i = 0; i < 3; i++)
            for (int j = 0; j < 3; j++) turned[i][j] = F[j][i];
        product(F, B, FB);
        product(FB, turned, moved);
        for (int i = 0; i < 3; i++)
            for (int j = 0; j < 3; j++) moved[i][j] *= pow(det, -2.0 / 3.0);
        traction(law, moved, DENSITY / det, n, t[side]);
    }
    for (int i = 0; i < 3; i++) ret[i] = (t[1][i] - t[0][i]) / (2.0 * h);
}

/* Larger eigenvalue of [a b; b d]. */
static double larger(double a, double d, double b2)
{
    return 0.5 * (a + d) + sqrt(0.25 * (a - d) * (a - d) + b2);
}

/* A stretch with det 1, all components in use. */
static void draw_stretch(double size, matrix V, double rows[6])
{
    for (int i = 0; i < 3; i++)
        for (int j = i; j < 3; j++) V[i][j] = V[j][i] = (i == j) + size * ((double)rand() / RAND_MAX - 0.5);
    double det = V[0][0] * (V[1][1] * V[2][2] - V[1][2] * V[2][1]) - V[0][1] * (V[1][0] * V[2][2] - V[1][2] * V[2][0]) +
                 V[0][2] * (V[1][0] * V[2][1] - V[1][1] * V[2][0]);
    assert_true(det > 0.1);
    for (unsigned i = 0; i < 3; i++)
        for (unsigned j = i; j < 3; j++) rows[elastic_component(i, j)] = (V[i][j] /= cbrt(det));
    for (int i = 0; i < 3; i++)
        for (int j = 0; j < i; j++) V[i][j] = V[j][i];
}

static void check_point(const struct law *law, int axis, const matrix V, const double rows[6])
{
    struct model model = model_of(law);
    double A[3][3], normal, shear[2], stiff, rigid, es, wanted[3], fluid = FLUID, rho = DENSITY;
    const double *const m[] = {&rho};
    unsigned n = axis_component(axis, 0), p = axis_component(axis, 1), q = axis_component(axis, 2);
    const struct elastic_side side = {&es, &normal, {&shear[0], &shear[1]}, &stiff, &rigid};
    matrix B;
    product(V, V, B);
    elastic_sides(&model, axis, 1, 1, rows, m, &fluid, &side);
    traction(law, B, DENSITY, n, wanted);
    for (unsigned a = 0; a < 3; a++) acoustic(law, B, n, a, A[a]);
    double size = fabs(A[n][n]) + fabs(A[p][p]) + fabs(A[q][q]), most = A[p][p] > A[q][q] ? A[p][p] : A[q][q];
    double across = A[n][p] * A[n][p] + A[n][q] * A[n][q];
    assert_close(normal, wanted[n], 1e-12 * size);
    assert_close(shear[0], wanted[p], 1e-12 * size);
    assert_close(shear[1], wanted[q], 1e-12 * size);
    assert_close(stiff, larger(FLUID + A[n][n], most + fabs(A[p][q]), across) - FLUID, 1e-7 * size + 1e-15 * FLUID);
    assert_close(rigid, most > 0.0 ? most : 0.0, 1e-7 * size);
}

static void test_speeds(void **state)
{
    (void)state;
    srand(3);
    for (int i = 0; i < 60; i++) {
        matrix V;
        double rows[6];
        draw_stretch(0.1 + 0.01 * i, V, rows);
        for (int axis = 0; axis < 3; axis++) {
            check_point(&CURVED, axis, V, rows);
            check_point(&PLAIN, axis, V, rows);
        }
    }
}

/* The bound for all directions, which sets the time step, is the fastest of the axes. */
static void test_bound(void **state)
{
    (void)state;
    struct model model = model_of(&CURVED);
    const struct bulla_module module = {.table = model.solids[0].law};
    const struct scene scene = {.n_material = 1, .material = {{.constitutive = {.module = &module}}}};
    model.scene = &scene;
    srand(5);
    for (int i = 0; i < 20; i++) {
        matrix V;
        double rows[6], normal, shear[2], stiff, rigid, es, fluid = FLUID, rho = DENSITY, c2 = FLUID / DENSITY,
                                                            most = 0.0;
        const double *const m[] = {&rho};
        const struct elastic_side side = {&es, &normal, {&shear[0], &shear[1]}, &stiff, &rigid};
        draw_stretch(0.5, V, rows);
        for (int axis = 0; axis < 3; axis++) {
            elastic_sides(&model, axis, 1, 1, rows, m, &fluid, &side);
            most = stiff > most ? stiff : most;
        }
        elastic_speed2(&model, 1, 1, rows, m, &rho, &c2);
        assert_close(c2, (FLUID + most) / DENSITY, 1e-12 * FLUID / DENSITY);
    }
}

/* What stands against the hoop stress where zz stands alone. */
static void test_hoop(void **state)
{
    (void)state;
    static const struct law *const laws[] = {&CURVED, &PLAIN};
    srand(8);
    for (int i = 0; i < 40; i++) {
        struct model model = model_of(laws[i % 2]);
        double a = 0.7 + 0.6 * rand() / RAND_MAX, b = 0.7 + 0.6 * rand() / RAND_MAX, c = 0.2 * rand() / RAND_MAX;
        double rows[6] = {a, b, 1.0 / (a * b - c * c), c, 0.0, 0.0}, p = 3e5, rho = DENSITY, got, wanted[3];
        const double *const m[] = {&rho};
        const matrix V = {{a, c, 0.0}, {c, b, 0.0}, {0.0, 0.0, rows[2]}};
        matrix B;
        product(V, V, B);
        traction(laws[i % 2], B, DENSITY, 2, wanted);
        elastic_hoop(&model, 1, 1, rows, m, &p, &got);
        assert_close(got, p - wanted[2], 1e-12 * (p + fabs(wanted[2])));
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(test_speeds), cmocka_unit_test(test_bound),
                                       cmocka_unit_test(test_hoop)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
