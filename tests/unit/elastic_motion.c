/* Homogeneous motions of a solid, moved as the midpoint scheme does with the exact velocity gradient, against closed
 * forms (tests/data/elastic): shear, stretch, rotation, compression, dilatation, a closing spherical cavity. What the
 * scheme adds on a grid is the business of cases/verify; here the stretch itself is measured. */
#include "phys/elastic.h"
#include "phys/elastic_tensor.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

enum { COLUMNS = 28, ROWS = 64 };

/* Neo-Hookean: self is the shear modulus over the reference density. */
static void energy(const void *self, size_t n, const double *I1, const double *I2, double *e, double *e_1, double *e_2)
{
    double half = 0.5 * *(const double *)self;
    for (size_t i = 0; i < n; i++) {
        e[i] = half * (I1[i] - 3.0) + 0.0 * I2[i];
        e_1[i] = half;
        e_2[i] = 0.0;
    }
}

static const struct bulla_constitutive LAW = {.size = sizeof LAW, .energy = energy, .first_only = 1};

static struct model model_of(unsigned dim, int beta, unsigned n_velocity, const double *self)
{
    struct model model = {.dim = (int)dim, .beta = beta, .n_velocity = n_velocity, .n_material = 1, .n_solid = 1};
    model.i_u = 1;
    model.i_E = model.i_u + n_velocity;
    model.i_V = model.i_E + 1;
    model.n_stretch = elastic_tensor_count(n_velocity);
    model.n_field = model.i_V + model.n_stretch;
    model.elastic = true;
    model.solids[0] = (struct model_solid){.stretch = model.i_V, .law = &LAW, .self = self};
    return model;
}

/* A velocity gradient L, L[i][k] = d_k u_i, and the solid's density before, amid and after the step. */
struct push {
    double L[3][3], rho[3];
};

/* One stage from V_old over dt, with V_face at the faces. */
static void stage(const struct model *model, double dt, const struct push *push, double rho_new, const double *V_old,
                  const double *V_face, double *V_new)
{
    unsigned dim = (unsigned)model->dim;
    double gradient[9] = {0}, carried[6], div = -(push->L[0][0] + push->L[1][1] + push->L[2][2]);
    for (unsigned i = 0; i < model->n_velocity; i++)
        for (unsigned k = 0; k < dim; k++) gradient[i * dim + k] = -push->L[i][k];
    for (unsigned c = 0; c < model->n_stretch; c++) carried[c] = V_face[c] * (rho_new - push->rho[0]) / dt;
    const struct elastic_rates rates = {
        .carried = carried, .m_old = push->rho, .m_new = &rho_new, .div = &div, .gradient = gradient};
    elastic_advance(model, 1, 1, dt, V_old, &rates, V_new);
    elastic_unimodular(model, 1, 1, V_new);
}

/* A step of the midpoint rule with the gradient of its middle, in place. */
static void step(const struct model *model, double dt, const struct push *push, double *V)
{
    double old[6], middle[6];
    memcpy(old, V, sizeof old);
    stage(model, 0.5 * dt, push, push->rho[1], old, old, middle);
    stage(model, dt, push, push->rho[2], old, middle, V);
}

static double det(const struct model *model, const double *V)
{
    double xy = model->n_stretch > 3 ? V[3] : 0.0, xz = model->n_stretch > 4 ? V[4] : 0.0,
           yz = model->n_stretch > 4 ? V[5] : 0.0;
    return V[0] * (V[1] * V[2] - yz * yz) - xy * (xy * V[2] - yz * xz) + xz * (xy * yz - V[1] * xz);
}

/* A homogeneous motion of a reference file. */
struct motion {
    const char *file;
    double L[3][3], start[3], rho0, mu;
    unsigned n_velocity;
    double rate; /* trace of L */
    double most; /* largest error of V after 100 steps seen, plus a tenth; 0: exact but for round-off */
};

static const double TURN = 6.283185307179586, LN4 = 1.3862943611198906, SQUEEZE = 0.006734235772506488;
static const struct motion MOTIONS[] = {
    {"hom1-simple-shear", {{0, 3, 0}}, {1, 1, 1}, 1060, 85e3, 2, 0.0, 0.0},
    {"hom2-stretch", {{LN4}, {0, -LN4 / 2}, {0, 0, -LN4 / 2}}, {1, 1, 1}, 1060, 85e3, 3, 0.0, 1.9e-5},
    {"hom3-rigid-rotation", {{0, -TURN}, {TURN}}, {1.5, 0.8, 1 / 1.2}, 1060, 85e3, 2, 0.0, 4e-4},
    {"hom4-uniaxial-compression", {{-0.05}}, {1, 1, 1}, 1995, 10728633195, 2, -0.05, 9.6e-10},
    {"hom5-dilatation",
     {{-SQUEEZE}, {0, -SQUEEZE}, {0, 0, -SQUEEZE}},
     {1, 1, 1},
     1995,
     10728633195,
     3,
     -3 * SQUEEZE,
     0},
};
enum { N_MOTION = sizeof MOTIONS / sizeof *MOTIONS };

/* Reads the numbers of a file below tests/data/elastic; returns the number of rows. */
static int rows_of(const char *name, int columns, double rows[ROWS][COLUMNS])
{
    char path[128], line[2048];
    int n = 0;
    snprintf(path, sizeof path, "tests/data/elastic/%s.csv", name);
    FILE *stream = fopen(path, "r");
    if (!stream) fail_msg("no %s", path);
    while (fgets(line, sizeof line, stream)) {
        char *at = line;
        if (*line == '#') continue;
        assert_true(n < ROWS);
        for (int c = 0; c < columns; c++) rows[n][c] = strtod(at + (c > 0 ? strspn(at, ",") : 0), &at);
        n++;
    }
    fclose(stream);
    return n;
}

/* Columns of the files of homogeneous motions. */
enum { TIME, DENSITY = 2, PRESSURE = 3, STRETCH = 13, STRESS = 19, ENERGY = 25, TRACE = 26 };

/* Place of component c (order of elastic.h) among the columns xx, xy, xz, yy, yz, zz. */
static const int COLUMN[6] = {0, 3, 5, 1, 2, 4};

struct worst {
    double V, stress, energy, trace, det;
};

/* What a state has against a row, stress relative to the shear modulus. */
static void compare(const struct motion *motion, const struct model *model, const double *V, const double *row,
                    struct worst *worst)
{
    double rho = row[DENSITY], s[6], rho_es, I1, I2;
    const double *m = &rho;
    elastic_stress(model, 1, 1, V, &m, s);
    elastic_energy(model, 1, 1, V, &m, &rho_es);
    elastic_invariants(model, 1, 1, V, &I1, &I2);
    for (unsigned c = 0; c < model->n_stretch; c++) {
        double stress = row[STRESS + COLUMN[c]] + (c < 3 ? row[PRESSURE] : 0.0);
        worst->V = fmax(worst->V, fabs(V[c] - row[STRETCH + COLUMN[c]]));
        worst->stress = fmax(worst->stress, fabs(s[c] - stress) / motion->mu);
    }
    worst->energy = fmax(worst->energy, fabs(rho_es / rho - row[ENERGY]) * motion->rho0 / motion->mu);
    worst->trace = fmax(worst->trace, fabs(I1 - row[TRACE]));
    worst->det = fmax(worst->det, fabs(det(model, V) - 1.0));
}

/* The motion in so many steps to t = 1, compared at every time of the file; the steps must divide its intervals. */
static struct worst move(const struct motion *motion, unsigned n_velocity, int steps)
{
    static double rows[ROWS][COLUMNS];
    double self = motion->mu / motion->rho0, V[6] = {motion->start[0], motion->start[1], motion->start[2]};
    struct model model = model_of(n_velocity, 0, n_velocity, &self);
    struct worst worst = {0};
    int n = rows_of(motion->file, COLUMNS - 1, rows), at = 0, compared = 0;
    elastic_unimodular(&model, 1, 1, V);
    for (int k = 0; k <= steps; k++) {
        double dt = 1.0 / steps, t = k * dt;
        while (at < n && rows[at][TIME] < t - 1e-9) at++;
        if (at < n && fabs(rows[at][TIME] - t) < 1e-9) compare(motion, &model, V, rows[at], &worst), compared++;
        struct push push;
        memcpy(push.L, motion->L, sizeof push.L);
        for (int s = 0; s < 3; s++) push.rho[s] = motion->rho0 * exp(-motion->rate * (t + 0.5 * s * dt));
        step(&model, dt, &push, V);
    }
    assert_int_equal(compared, n);
    return worst;
}

static void check(const struct motion *motion, unsigned n_velocity)
{
    struct worst coarse = move(motion, n_velocity, 50), fine = move(motion, n_velocity, 100);
    print_message("%s, %u velocities: V %.2e, %.2e; stress/mu %.2e, energy rho_0/mu %.2e, tr B %.2e, det %.1e\n",
                  motion->file, n_velocity, coarse.V, fine.V, fine.stress, fine.energy, fine.trace, fine.det);
    assert_true(coarse.det <= 1e-12 && fine.det <= 1e-12);
    if (motion->most == 0.0) {
        assert_true(fine.V <= 1e-12 && fine.stress <= 1e-12 && fine.energy <= 1e-12 && fine.trace <= 1e-12);
        return;
    }
    assert_true(fine.V <= motion->most);
    assert_true(log2(coarse.V / fine.V) > 1.95 && log2(coarse.stress / fine.stress) > 1.95);
}

static void test_motions(void **state)
{
    (void)state;
    for (int i = 0; i < N_MOTION; i++)
        for (unsigned n = MOTIONS[i].n_velocity; n <= 3; n++) check(&MOTIONS[i], n);
}

/* The largest eigenvalue of a symmetric tensor of the plane. */
static double largest(const double *V)
{
    double mean = 0.5 * (V[0] + V[1]), half = 0.5 * (V[0] - V[1]);
    return mean + sqrt(half * half + V[3] * V[3]);
}

/* Turns about an axis, from 10 steps a turn on: the invariants stay whatever the step. */
static void test_turns(void **state)
{
    (void)state;
    static const int steps[] = {10, 40, 1000};
    static const double axes[][3] = {{0, 0, 1}, {1, 0, 0}, {0.6, 0, 0.8}, {0.36, 0.48, 0.8}};
    const double self = 85e3 / 1060.0;
    for (unsigned n_velocity = 2; n_velocity <= 3; n_velocity++)
        for (unsigned a = 0; a < (n_velocity == 2 ? 1u : 4u); a++)
            for (unsigned i = 0; i < 3; i++) {
                struct model model = model_of(n_velocity, 0, n_velocity, &self);
                const double *x = axes[a];
                struct push push = {.L = {{0, -TURN * x[2], TURN * x[1]},
                                          {TURN * x[2], 0, -TURN * x[0]},
                                          {-TURN * x[1], TURN * x[0], 0}},
                                    .rho = {1060, 1060, 1060}};
                double V[6] = {1.5, 0.8, 1 / 1.2, n_velocity == 2 ? 0.0 : 0.1, 0.0, 0.0}, I1, I2, J1, J2;
                elastic_unimodular(&model, 1, 1, V);
                elastic_invariants(&model, 1, 1, V, &I1, &I2);
                for (int k = 0; k < steps[i]; k++) step(&model, 1.0 / steps[i], &push, V);
                elastic_invariants(&model, 1, 1, V, &J1, &J2);
                double off = fmax(fabs(J1 / I1 - 1.0), fabs(J2 / I2 - 1.0));
                print_message("%u velocities, axis %u, %d steps a turn: invariants %.1e\n", n_velocity, a, steps[i],
                              off);
                assert_true(off <= 1e-12);
            }
}

/* Simple shear to 20, in steps of 0.01 and of 1: largest stretch 10 + sqrt 101. */
static void test_shear_20(void **state)
{
    (void)state;
    const double self = 85e3 / 1060.0;
    for (int steps = 20; steps <= 2000; steps *= 10)
        for (unsigned n_velocity = 2; n_velocity <= 3; n_velocity++) {
            struct model model = model_of(n_velocity, 0, n_velocity, &self);
            const struct push push = {.L = {{0, 20, 0}}, .rho = {1060, 1060, 1060}};
            double V[6] = {1, 1, 1}, I1, I2;
            for (int k = 0; k < steps; k++) step(&model, 1.0 / steps, &push, V);
            elastic_invariants(&model, 1, 1, V, &I1, &I2);
            double stretch = largest(V), off = fmax(fabs(I1 / 403.0 - 1.0), fabs(I2 / 403.0 - 1.0));
            print_message("shear 20, %u velocities, %d steps: largest stretch %.12g, invariants %.1e, det %.1e\n",
                          n_velocity, steps, stretch, off, fabs(det(&model, V) - 1.0));
            assert_true(fabs(stretch - (10.0 + sqrt(101.0))) <= 1e-9);
            assert_true(off <= 1e-9 && fabs(det(&model, V) - 1.0) <= 1e-12);
        }
}

/* The closing of a cavity, r^3 = R^3 + q: q goes from 0 to that of the row in t = 1. Returns the error of V. */
static double close_cavity(const double *row, int steps, double *ret_stress, double *ret_energy)
{
    enum { Q, R, RADIUS, V_RR, V_TT, S_RR, S_TT, E_S };
    const double mu = 85e3, rho = 1060.0, self = mu / rho, *m = &rho, q = row[Q], cube = row[R] * row[R] * row[R];
    struct model model = model_of(1, 2, 1, &self);
    double V[6] = {1, 1, 1}, s[3], rho_es, dt = 1.0 / steps;
    for (int k = 0; k < steps; k++) {
        double hoop = q / (3.0 * (cube + q * (k + 0.5) * dt));
        const struct push push = {.L = {{-2.0 * hoop}, {0, hoop}, {0, 0, hoop}}, .rho = {rho, rho, rho}};
        step(&model, dt, &push, V);
    }
    assert_true(V[1] == V[2]);
    assert_true(fabs(det(&model, V) - 1.0) <= 1e-12);
    elastic_stress(&model, 1, 1, V, &m, s);
    elastic_energy(&model, 1, 1, V, &m, &rho_es);
    *ret_stress = fmax(fabs(s[0] - row[S_RR]), fabs(s[1] - row[S_TT])) / fabs(row[S_RR]);
    *ret_energy = fabs(rho_es / rho / row[E_S] - 1.0);
    return fmax(fabs(V[0] / row[V_RR] - 1.0), fabs(V[1] / row[V_TT] - 1.0));
}

static void test_cavity(void **state)
{
    (void)state;
    static double rows[ROWS][COLUMNS];
    int n = rows_of("hom8-spherical-cavity", 8, rows);
    double worst[2] = {0}, stress = 0.0, energy_off = 0.0;
    assert_true(n >= 40);
    for (int i = 0; i < n; i++)
        for (int k = 0; k < 2; k++) {
            double s, e;
            worst[k] = fmax(worst[k], close_cavity(rows[i], 100 << k, &s, &e));
            if (k) stress = fmax(stress, s), energy_off = fmax(energy_off, e);
        }
    print_message("cavity: V %.2e, %.2e; stress %.2e, energy %.2e\n", worst[0], worst[1], stress, energy_off);
    assert_true(worst[1] <= 5.7e-5 && stress <= 1.2e-4 && energy_off <= 1.3e-4);
    assert_true(log2(worst[0] / worst[1]) > 1.9);
}

/* What round-off leaves of a solid where there was none has no stretch of its own, nor one that is no number. */
static void test_traces(void **state)
{
    (void)state;
    static const double masses[] = {0.0, 5e-324, 1e-320, 1e-310, 1e-300, 1e-200, 1e-30};
    const double self = 80.0, none = 0.0, div = 0.0, gradient[4] = {0.0, 3e3, -2e3, 0.0};
    struct model model = model_of(2, 0, 2, &self);
    for (size_t i = 0; i < sizeof masses / sizeof *masses; i++) {
        double carried[4] = {masses[i] * 1.5e8, masses[i] * 0.8e8, masses[i] / 1.2e-8, 0.0}, V[6];
        const struct elastic_rates rates = {
            .carried = carried, .m_old = &none, .m_new = &masses[i], .div = &div, .gradient = gradient};
        elastic_advance(&model, 1, 1, 1e-8, (const double[]){1.0, 1.0, 1.0, 0.0}, &rates, V);
        elastic_unimodular(&model, 1, 1, V);
        assert_true(fabs(det(&model, V) - 1.0) < 1e-12);
        assert_true(fabs(V[0] - (masses[i] > 1e-250 ? 1.5 : 1.0)) < 1e-4);
    }
}

/* Error of one step of a stretch that is carried along and deformed while the volume of its solid changes. V =
 * exp(diag(a, b, -a - b)) is chosen; what the flow must carry in for it follows from d V/dt = (L - tr L/3) V + T. */
static double carry(double dt, double swell)
{
    const double L[3] = {0.7 + swell, -0.4 + swell, 0.3 + swell}, self = 1.0, trace = L[0] + L[1] + L[2];
    const double rho[2] = {1.0, exp(-trace * dt)}, middle = exp(-0.5 * trace * dt), div = -trace;
    double gradient[9] = {-L[0], 0, 0, 0, -L[1], 0, 0, 0, -L[2]}, carried[6] = {0}, old[6] = {0}, now[6], worst = 0.0;
    struct model model = model_of(3, 0, 3, &self);
    for (int c = 0; c < 3; c++) {
        const double start[3] = {0.3, 0.1, -0.4}, rate[3] = {1.1, -0.8, -0.3};
        double V = exp(start[c] + 0.5 * rate[c] * dt);
        carried[c] = middle * (rate[c] - L[c] + trace / 3.0) * V + V * (rho[1] - rho[0]) / dt;
        old[c] = exp(start[c]);
    }
    const struct elastic_rates rates = {
        .carried = carried, .m_old = &rho[0], .m_new = &rho[1], .div = &div, .gradient = gradient};
    elastic_advance(&model, 1, 1, dt, old, &rates, now);
    elastic_unimodular(&model, 1, 1, now);
    for (int c = 0; c < 3; c++) {
        const double start[3] = {0.3, 0.1, -0.4}, rate[3] = {1.1, -0.8, -0.3};
        worst = fmax(worst, fabs(now[c] - exp(start[c] + rate[c] * dt)));
    }
    return worst;
}

static void test_carried(void **state)
{
    (void)state;
    for (int i = -1; i <= 1; i++) {
        double coarse = carry(0.02, 0.5 * i), fine = carry(0.01, 0.5 * i);
        print_message("carried along, swelling %+.1f: %.2e, order of a step %.2f\n", 0.5 * i, fine,
                      log2(coarse / fine));
        assert_true(fine <= 3e-6 && log2(coarse / fine) > 2.9);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_motions), cmocka_unit_test(test_turns),  cmocka_unit_test(test_shear_20),
        cmocka_unit_test(test_cavity),  cmocka_unit_test(test_traces), cmocka_unit_test(test_carried),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
