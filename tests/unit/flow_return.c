/* Plastic flow along homogeneous motions, one step of the motion, one return, against exact solutions of the equations
 * (tests/data/plastic): shear, forth and back, hardening, softening by heat, uniaxial strain and back, circular shear,
 * stretching while turning. Then what a return does to a single state: work is heat, axes stay, far overshoots,
 * mixtures, laws of changing slope. */
#include "phys/elastic.h"
#include "phys/elastic_tensor.h"
#include "phys/flow.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

enum { COLUMNS = 18, ROWS = 256, FIELDS = 12 };

static const double MU = 4.77e10, RHO0 = 8930.0, CV = 383.0;

/* Elastic laws by energy per mass: neo-Hookean, and one that stiffens; self is mu/(2 rho0). */
static void plain(const void *self, size_t n, const double *I1, const double *I2, double *e, double *e_1, double *e_2)
{
    double k = *(const double *)self;
    for (size_t i = 0; i < n; i++) {
        e[i] = k * (I1[i] - 3.0) + 0.0 * I2[i];
        e_1[i] = k;
        e_2[i] = 0.0;
    }
}

static void stiff(const void *self, size_t n, const double *I1, const double *I2, double *e, double *e_1, double *e_2)
{
    double k = *(const double *)self;
    for (size_t i = 0; i < n; i++) {
        double J = I1[i] - 3.0;
        e[i] = k * (J + 0.1 * J * J * J) + 0.0 * I2[i];
        e_1[i] = k * (1.0 + 0.3 * J * J);
        e_2[i] = 0.0;
    }
}

static const struct bulla_constitutive PLAIN = {.size = sizeof PLAIN, .energy = plain, .first_only = 1},
                                       STIFF = {.size = sizeof STIFF, .energy = stiff, .first_only = 1};

/* A material whose pressure is its heat, and whose temperature tells it. */
static void derivatives(const void *self, size_t n, const double *rho, const double *p, double *de_dp, double *de_drho)
{
    (void)self;
    for (size_t i = 0; i < n; i++) {
        de_dp[i] = 1.0 + 0.0 * p[i];
        de_drho[i] = 0.0 * rho[i];
    }
}

static void temperature(const void *self, size_t n, const double *rho, const double *p, double *T)
{
    (void)self;
    for (size_t i = 0; i < n; i++) T[i] = 300.0 + p[i] / (rho[i] * CV);
}

static const struct bulla_eos WARM = {.size = sizeof WARM, .derivatives = derivatives, .temperature = temperature};

/* Strengths. */
static void perfect(const void *self, size_t n, const double *eps, const double *rate, const double *p, const double *T,
                    const double *rho, double *Y)
{
    (void)eps, (void)rate, (void)p, (void)T, (void)rho;
    for (size_t i = 0; i < n; i++) Y[i] = *(const double *)self;
}

static void linear(const void *self, size_t n, const double *eps, const double *rate, const double *p, const double *T,
                   const double *rho, double *Y)
{
    (void)self, (void)rate, (void)p, (void)T, (void)rho;
    for (size_t i = 0; i < n; i++) Y[i] = 3e8 + 0.5e9 * eps[i];
}

static void copper(const void *self, size_t n, const double *eps, const double *rate, const double *p, const double *T,
                   const double *rho, double *Y)
{
    (void)self, (void)p, (void)rho;
    for (size_t i = 0; i < n; i++) {
        double hot = (T[i] - 298.0) / (1356.0 - 298.0);
        Y[i] = (90e6 + 292e6 * pow(eps[i], 0.31)) * (1.0 + 0.025 * log1p(rate[i])) * (1.0 - pow(fmax(hot, 0.0), 1.09));
    }
}

static void guinan(const void *self, size_t n, const double *eps, const double *rate, const double *p, const double *T,
                   const double *rho, double *Y)
{
    (void)self, (void)rate, (void)p, (void)rho;
    for (size_t i = 0; i < n; i++)
        Y[i] = fmin(0.12e9 * pow(1.0 + 36.0 * eps[i], 0.45), 0.64e9) * (1.0 - 3.77e-4 * (T[i] - 300.0));
}

static const struct bulla_inelastic PERFECT = {.size = sizeof PERFECT, .strength = perfect},
                                    LINEAR = {.size = sizeof LINEAR, .strength = linear},
                                    COPPER = {.size = sizeof COPPER, .strength = copper},
                                    GUINAN = {.size = sizeof GUINAN, .strength = guinan};

/* One plastic solid, alone. Its fields: m, rho u, rho E, m eps, V. */
static struct model model_of(unsigned n_velocity, const struct bulla_constitutive *law, const double *slope,
                             const struct bulla_inelastic *strength, const double *yield)
{
    struct model model = {
        .dim = (int)n_velocity, .n_velocity = n_velocity, .n_material = 1, .n_solid = 1, .n_inner = 1};
    model.i_u = 1;
    model.i_E = model.i_u + n_velocity;
    model.i_inner = model.i_E + 1;
    model.i_V = model.i_inner + 1;
    model.n_stretch = elastic_tensor_count(n_velocity);
    model.n_field = model.i_V + model.n_stretch;
    model.elastic = model.plastic = true;
    model.eos[0].law = &WARM;
    model.solids[0] = (struct model_solid){.stretch = model.i_V,
                                           .law = law,
                                           .self = slope,
                                           .strength = strength,
                                           .strength_self = yield,
                                           .strain = model.i_inner,
                                           .needs = BULLA_INELASTIC_ALL};
    return model;
}

/* Motions: L[i][k] = d_k u_i and the density at a time. */
static void shear(double t, double L[3][3], double *rho)
{
    (void)t, (void)rho;
    L[0][1] = 1e4;
}

static void shear_back(double t, double L[3][3], double *rho)
{
    (void)rho;
    L[0][1] = t < 50e-6 ? 1e4 : -1e4;
}

static void squeeze(double t, double L[3][3], double *rho)
{
    double J = t < 10e-6 ? 1.0 - 2e4 * t : 0.8 + 2e4 * (t - 10e-6), rate = t < 10e-6 ? -2e4 : 2e4;
    L[0][0] = rate / J;
    *rho = RHO0 / J;
}

static void circle(double t, double L[3][3], double *rho)
{
    double w = 2.0 * 3.141592653589793 / 1e-4;
    (void)rho;
    L[0][1] = -0.05 * w * sin(w * t);
    L[0][2] = 0.05 * w * cos(w * t);
}

static void turn(double t, double L[3][3], double *rho)
{
    double w = 2.0 * 3.141592653589793 / 1e-4, c = cos(w * t), s = sin(w * t), a = 2000.0, b = -1000.0;
    (void)rho;
    L[0][0] = a * c * c + b * s * s;
    L[1][1] = a * s * s + b * c * c;
    L[2][2] = b;
    L[0][1] = (a - b) * c * s - w;
    L[1][0] = (a - b) * c * s + w;
}

static double density(void (*motion)(double, double[3][3], double *), double t)
{
    double L[3][3] = {{0}}, rho = RHO0;
    motion(t, L, &rho);
    return rho;
}

/* One stage of the motion: V_new from V_old over dt, with the gradient at `at`. */
static void stage(const struct model *model, void (*motion)(double, double[3][3], double *), double t, double at,
                  double dt, const double *V_old, const double *V_face, double *V_new)
{
    double L[3][3] = {{0}}, gradient[9] = {0}, carried[6], rho, old = density(motion, t), now = density(motion, t + dt);
    motion(at, L, &rho);
    double div = -(L[0][0] + L[1][1] + L[2][2]);
    unsigned dim = (unsigned)model->dim;
    for (unsigned i = 0; i < model->n_velocity; i++)
        for (unsigned k = 0; k < dim; k++) gradient[i * dim + k] = -L[i][k];
    for (unsigned c = 0; c < model->n_stretch; c++) carried[c] = V_face[c] * (now - old) / dt;
    const struct elastic_rates rates = {
        .carried = carried, .m_old = &old, .m_new = &now, .div = &div, .gradient = gradient};
    elastic_advance(model, 1, 1, dt, V_old, &rates, V_new);
    elastic_unimodular(model, 1, 1, V_new);
}

static double energy_of(const struct model *model, const double *u)
{
    const double *m[] = {u};
    double energy;
    elastic_energy(model, 1, 1, u + model->i_V, m, &energy);
    return energy;
}

static double equivalent(const struct model *model, const double *u)
{
    const double *m[] = {u};
    double s[6] = {0}, sum = 0.0;
    elastic_stress(model, 1, 1, u + model->i_V, m, s);
    for (int c = 0; c < 6; c++) sum += (c < 3 ? 1.5 : 3.0) * s[c] * s[c];
    return sqrt(sum);
}

/* A step: the midpoint rule for the motion, then the flow, whose work heats. */
static void advance(const struct model *model, void (*motion)(double, double[3][3], double *), double t, double dt,
                    double *u, double *w)
{
    double old[6], middle[6], *V = u + model->i_V, scale = density(motion, t + dt) / u[0];
    memcpy(old, V, sizeof old);
    stage(model, motion, t, t, 0.5 * dt, old, old, middle);
    stage(model, motion, t, t + 0.5 * dt, dt, old, middle, V);
    u[0] *= scale;
    u[model->i_inner] *= scale;
    w[0] = RHO0; /* at which heat is counted */
    double before = energy_of(model, u);
    flow_return(model, 1, 1, dt, w, u, NULL);
    w[model->i_E] += before - energy_of(model, u);
}

static void begin(const struct model *model, double *u, double *w)
{
    memset(u, 0, FIELDS * sizeof *u);
    memset(w, 0, FIELDS * sizeof *w);
    u[0] = w[0] = RHO0;
    for (int c = 0; c < 3; c++) u[model->i_V + (unsigned)c] = 1.0;
}

static int rows_of(const char *name, double rows[ROWS][COLUMNS])
{
    char path[128], line[2048];
    int n = 0;
    snprintf(path, sizeof path, "tests/data/plastic/%s.csv", name);
    FILE *file = fopen(path, "r");
    if (!file) fail_msg("cannot read %s", path);
    while (fgets(line, sizeof line, file)) {
        char *at = line;
        if (*line == '#') continue;
        assert_true(n < ROWS);
        for (int c = 0; c < COLUMNS; c++, at += *at == ',') rows[n][c] = strtod(at, &at);
        n++;
    }
    fclose(file);
    return n;
}

/* Largest errors along a path: of B against the largest deviator that there is, of eps, of q against Y. */
struct errors {
    double B, eps, q;
};

static void square(const struct model *model, const double *V, double B[6])
{
    double a[6] = {0};
    for (unsigned c = 0; c < model->n_stretch; c++) a[c] = V[c];
    B[0] = a[0] * a[0] + a[3] * a[3] + a[4] * a[4];
    B[1] = a[1] * a[1] + a[3] * a[3] + a[5] * a[5];
    B[2] = a[2] * a[2] + a[4] * a[4] + a[5] * a[5];
    B[3] = a[0] * a[3] + a[3] * a[1] + a[4] * a[5];
    B[4] = a[0] * a[4] + a[3] * a[5] + a[4] * a[2];
    B[5] = a[3] * a[4] + a[1] * a[5] + a[5] * a[2];
}

static struct errors follow(const char *name, const struct model *model, void (*motion)(double, double[3][3], double *),
                            int parts)
{
    static double rows[ROWS][COLUMNS];
    double u[FIELDS], w[FIELDS], B[6], size = 0.0;
    struct errors worst = {0};
    int n = rows_of(name, rows);
    begin(model, u, w);
    for (int r = 1; r < n; r++) {
        double from = rows[r - 1][0], dt = (rows[r][0] - from) / parts, off = 0.0, deviator = 0.0;
        for (int k = 0; k < parts; k++) advance(model, motion, from + k * dt, dt, u, w);
        square(model, u + model->i_V, B);
        double mean = (rows[r][2] + rows[r][3] + rows[r][4]) / 3.0;
        for (int c = 0; c < 6; c++) {
            double weight = c < 3 ? 1.0 : 2.0, is = rows[r][2 + c], d = is - (c < 3 ? mean : 0.0);
            off += weight * (B[c] - is) * (B[c] - is);
            deviator += weight * d * d;
        }
        size = fmax(size, sqrt(deviator));
        worst.B = fmax(worst.B, sqrt(off) / size);
        worst.eps = fmax(worst.eps, fabs(u[model->i_inner] / u[0] - rows[r][14]));
        double eps = u[model->i_inner] / u[0], rate = 0.0, p = w[model->i_E], T = 300.0 + p / (RHO0 * CV), Y;
        model->solids[0].strength->strength(model->solids[0].strength_self, 1, &eps, &rate, &p, &T, u, &Y);
        worst.q = fmax(worst.q, equivalent(model, u) / Y - 1.0);
    }
    print_message("%s: B %.2e, eps %.2e, q %.2e\n", name, worst.B, worst.eps, worst.q);
    return worst;
}

/* So many steps from one time of the table to the next, and four times as many: the return is of first order in the
 * strain of a step. Where heat counts a step must be short beside the elastic strain: a far trial heats by what it
 * overshoots. */
static void check(const char *name, const struct model *model, void (*motion)(double, double[3][3], double *),
                  int parts, double B, double eps)
{
    struct errors coarse = follow(name, model, motion, parts), fine = follow(name, model, motion, 4 * parts);
    assert_true(coarse.B < B);
    assert_true(coarse.eps < eps);
    assert_true(fine.B < 0.6 * coarse.B);
    assert_true(fine.eps < coarse.eps);
}

static void test_paths(void **state)
{
    (void)state;
    const double slope = 0.5 * MU / RHO0, low = 3e8, high = 4e8;
    struct model plane = model_of(2, &PLAIN, &slope, &PERFECT, &high),
                 space = model_of(3, &PLAIN, &slope, &PERFECT, &low);
    struct model hard = model_of(2, &PLAIN, &slope, &LINEAR, NULL), line = model_of(1, &PLAIN, &slope, &PERFECT, &high);
    struct model warm = model_of(2, &PLAIN, &slope, &COPPER, NULL), guin = model_of(2, &PLAIN, &slope, &GUINAN, NULL);
    check("p01", &plane, shear, 1, 1.5e-2, 2e-4);
    assert_true(follow("p01", &plane, shear, 1).q < 1e-9);
    check("p03", &hard, shear_back, 1, 2e-2, 4e-4);
    assert_true(follow("p03", &hard, shear_back, 1).q < 1e-9);
    check("p05", &warm, shear, 16, 5e-2, 2e-4);
    check("p06", &guin, shear, 16, 5e-2, 2e-4);
    assert_true(follow("p06", &guin, shear, 1).q < 1e-6); /* the heat of the step itself softens */
    check("p07", &line, squeeze, 1, 2e-2, 4e-4);
    check("p08", &space, circle, 16, 6e-2, 4e-3);
    check("p09", &space, turn, 1, 2e-2, 1e-3);
}

/* One return from a far overshoot: on the surface, with the axes and the sign of what was there, det 1; what is not
 * beyond it keeps its bits; and the flow takes what energy says: q d eps, to the order of the path. */
static void test_overshoot(void **state)
{
    (void)state;
    const double slope = 0.5e6 / 1000.0; /* a gel of 1 MPa */
    for (unsigned nv = 1; nv <= 3; nv++)
        for (int l = 0; l < 2; l++)
            for (double over = 1.001; over < 10.0; over *= 1.7) {
                double u[FIELDS], w[FIELDS], before[FIELDS], yield;
                struct model model = model_of(nv, l ? &STIFF : &PLAIN, &slope, &PERFECT, &yield);
                begin(&model, u, w);
                u[0] = 1000.0;
                double *V = u + model.i_V, stretch[6] = {1.6, 0.8, 1.1, 0.3, -0.2, 0.1};
                for (unsigned c = 0; c < model.n_stretch; c++) V[c] = stretch[c];
                elastic_unimodular(&model, 1, 1, V);
                memcpy(before, u, sizeof before);
                double q = equivalent(&model, u), W = energy_of(&model, u);
                yield = 1.01 * q;
                flow_return(&model, 1, 1, 1e-6, w, u, NULL);
                assert_memory_equal(u, before, sizeof u);
                yield = q / over;
                flow_return(&model, 1, 1, 1e-6, w, u, NULL);
                assert_true(fabs(equivalent(&model, u) / yield - 1.0) < 2e-10);
                double C[6] = {0}, A[6] = {0};
                square(&model, before + model.i_V, A);
                square(&model, V, C);
                /* They commute: A C is symmetric. */
                double xy = A[0] * C[3] + A[3] * C[1] + A[4] * C[5], yx = A[3] * C[0] + A[1] * C[3] + A[5] * C[4];
                assert_true(fabs(xy - yx) < 1e-12 * (fabs(xy) + 1.0));
                double xx = V[0], yy = V[1], zz = V[2], b = nv > 1 ? V[3] : 0.0, d = nv > 2 ? V[4] : 0.0,
                       f = nv > 2 ? V[5] : 0.0;
                assert_true(fabs(xx * (yy * zz - f * f) - b * (b * zz - f * d) + d * (b * f - yy * d) - 1.0) < 1e-13);
                double work = W - energy_of(&model, u), grown = u[model.i_inner] / u[0];
                double part = work / (0.5 * (q + yield) * grown), far = (over - 1.0) / over;
                assert_true(fabs(part - 1.0) < 0.5 * far * far + 1e-6);
                memcpy(before, u, sizeof before);
                flow_return(&model, 1, 1, 1e-6, w, u, NULL); /* once is enough */
                assert_memory_equal(u, before, sizeof u);
            }
}

/* A part of the cell is a plastic solid, the rest one without a strength: each on its own stretch, the latter stays. */
static void test_beside_elastic(void **state)
{
    (void)state;
    const double slope = 0.5e6 / 1000.0, yield = 1e5;
    double u[16] = {0}, w[16] = {0}, stays[3];
    struct model model = {.dim = 1, .n_velocity = 1, .n_material = 2, .n_alpha = 2, .n_solid = 2};
    model.i_m = 2;
    model.i_u = 4;
    model.i_E = 5;
    model.i_inner = model.i_V = 6;
    model.n_stretch = 3;
    model.elastic = model.plastic = true;
    model.solids[0] = (struct model_solid){
        .stretch = 6, .law = &PLAIN, .self = &slope, .strength = &PERFECT, .strength_self = &yield};
    model.solids[1] = (struct model_solid){.stretch = 9, .law = &PLAIN, .self = &slope, .material = 1};
    for (int trace = 0; trace < 3; trace++) {
        double share = trace == 0 ? 0.5 : trace == 1 ? 1e-9 : 1.0 - 1e-9;
        u[0] = share;
        u[1] = 1.0 - share;
        u[2] = 1000.0 * share;
        u[3] = 1000.0 * (1.0 - share);
        for (unsigned s = 0; s < 2; s++) {
            u[6 + 3 * s] = 1.5;
            u[7 + 3 * s] = u[8 + 3 * s] = 1.0 / sqrt(1.5);
        }
        memcpy(stays, u + 9, sizeof stays);
        flow_return(&model, 1, 1, 1e-6, w, u, NULL);
        assert_true(fabs(1e6 * (u[6] * u[6] - u[7] * u[7]) - yield) < 1e-9 * yield);
        assert_memory_equal(u + 9, stays, sizeof stays);
    }
}

/* A molten solid loses nearly all of its stress; a NaN does not hang the search. */
static void test_ends(void **state)
{
    (void)state;
    const double slope = 0.5 * MU / RHO0;
    double u[FIELDS], w[FIELDS], yield = 0.0;
    struct model model = model_of(3, &PLAIN, &slope, &PERFECT, &yield);
    begin(&model, u, w);
    u[model.i_V] = 1.002;
    u[model.i_V + 3] = 0.001;
    elastic_unimodular(&model, 1, 1, u + model.i_V);
    double q = equivalent(&model, u);
    flow_return(&model, 1, 1, 1e-6, w, u, NULL);
    assert_true(equivalent(&model, u) < 2e-6 * q);
    u[model.i_V] = NAN;
    flow_return(&model, 1, 1, 1e-6, w, u, NULL);
    assert_true(isnan(u[model.i_V]));
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(test_paths), cmocka_unit_test(test_overshoot),
                                       cmocka_unit_test(test_beside_elastic), cmocka_unit_test(test_ends)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
