/* Maxwell branches along homogeneous motions, relaxation before, in the middle of and after the motion, against exact
 * solutions of the equations (tests/data/branches): start of shear of a Maxwell fluid, relaxation of a sheared solid,
 * oscillation, three branches pulled in two directions, uniaxial strain and back. Then what relaxing does to a single
 * stretch: exponentials, any time at once, axes, nothing to the identity. */
#include "phys/elastic.h"
#include "phys/elastic_tensor.h"
#include "phys/flow_relax.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

enum { COLUMNS = 34, ROWS = 256, STRETCHES = 4 };

static const double RHO0 = 1000.0, TAU = 1e-6;

/* The springs at rest: neo-Hookean; self is mu/(2 rho0). */
static void plain(const void *self, size_t n, const double *I1, const double *I2, double *e, double *e_1, double *e_2)
{
    double k = *(const double *)self;
    for (size_t i = 0; i < n; i++) {
        e[i] = k * (I1[i] - 3.0) + 0.0 * I2[i];
        e_1[i] = k;
        e_2[i] = 0.0;
    }
}

static const struct bulla_constitutive PLAIN = {.size = sizeof PLAIN, .energy = plain, .first_only = 1};

/* A solid alone; fields: m, then V of the springs at rest and of the branches. */
static struct model model_of(unsigned n_velocity, const double *slope, unsigned n, const double (*branches)[2])
{
    struct model model = {.dim = (int)n_velocity, .n_velocity = n_velocity, .n_material = 1, .n_solid = 1};
    model.i_V = 1;
    model.n_stretch = elastic_tensor_count(n_velocity);
    model.n_branch = n;
    model.n_stretched = (1 + n) * model.n_stretch;
    model.solids[0] = (struct model_solid){.stretch = model.i_V, .law = &PLAIN, .self = slope, .slack = *slope == 0.0};
    for (unsigned b = 0; b < n; b++)
        model.branches[b] = (struct model_branch){.field = model.i_V + (1 + b) * model.n_stretch,
                                                  .k = 0.5 * branches[b][0] / RHO0,
                                                  .time = branches[b][1]};
    return model;
}

/* Motions: L[i][k] = d_k u_i and the volume at a time. */
static void startup(double t, double L[3][3], double *J)
{
    (void)t, (void)J;
    L[0][1] = 5.0 / TAU;
}

static void held(double t, double L[3][3], double *J)
{
    (void)J;
    L[0][1] = t < 1e-3 * TAU ? 1e3 / TAU : 0.0;
}

static void swing(double t, double L[3][3], double *J)
{
    (void)J;
    L[0][1] = cos(t / TAU) / TAU;
}

static void biaxial(double t, double L[3][3], double *J)
{
    (void)t, (void)J;
    L[0][0] = L[1][1] = 7e5;
    L[2][2] = -1.4e6;
}

static void squeeze(double t, double L[3][3], double *J)
{
    double s = t / TAU, rate = s < 1.0 ? -0.1 / TAU : 0.1 / TAU;
    *J = s < 1.0 ? 1.0 - 0.1 * s : 0.8 + 0.1 * s;
    L[0][0] = rate / *J;
}

typedef void motion_of(double t, double L[3][3], double *J);

static double density(motion_of *motion, double t)
{
    double L[3][3] = {{0}}, J = 1.0;
    motion(t, L, &J);
    return RHO0 / J;
}

/* One stage of the motion of one stretch, with the gradient at `at`. */
static void move(const struct model *model, motion_of *motion, double t, double at, double dt, double relaxes,
                 const double *V_old, const double *V_face, double *V_new)
{
    double L[3][3] = {{0}}, gradient[9] = {0}, carried[6], J, old = density(motion, t), now = density(motion, t + dt);
    motion(at, L, &J);
    double div = -(L[0][0] + L[1][1] + L[2][2]);
    unsigned dim = (unsigned)model->dim;
    for (unsigned i = 0; i < model->n_velocity; i++)
        for (unsigned k = 0; k < dim; k++) gradient[i * dim + k] = -L[i][k];
    for (unsigned c = 0; c < model->n_stretch; c++) carried[c] = V_face[c] * (now - old) / dt;
    const struct elastic_rates rates = {
        .carried = carried, .m_old = &old, .m_new = &now, .div = &div, .gradient = gradient, .relaxes = relaxes};
    elastic_advance(model, 1, 1, dt, V_old, &rates, V_new);
    elastic_unimodular(model, 1, 1, V_new);
}

/* The exact path of uniaxial strain has a viscosity that stays while G grows with the density: tau is that over G. */
static double slowed(motion_of *motion, double t)
{
    return motion == squeeze ? RHO0 / density(motion, t) : 1.0;
}

/* A stage as viscoelastic.c takes it. */
static void stage(const struct model *model, unsigned k, motion_of *motion, double t, double at, double dt,
                  const double *V_old, const double *V_face, double *V_new)
{
    double half[6], time = k ? dt / (model->branches[k - 1].time * slowed(motion, t + 0.5 * dt)) : 0.0;
    struct flow_relax_parts parts = flow_relax_split(time);
    memcpy(half, V_old, sizeof half);
    flow_relax(model, 1, 1, parts.ends, half);
    move(model, motion, t, at, dt, parts.middle, half, V_face, V_new);
    flow_relax(model, 1, 1, parts.ends, V_new);
}

static void advance(const struct model *model, motion_of *motion, double t, double dt, double *u)
{
    for (unsigned k = model->solids[0].slack; k <= model->n_branch; k++) {
        double old[6], middle[6], *V = u + model->i_V + k * model->n_stretch;
        memcpy(old, V, sizeof old);
        stage(model, k, motion, t, t, 0.5 * dt, old, old, middle);
        double now[6];
        stage(model, k, motion, t, t + 0.5 * dt, dt, old, middle, now);
        memcpy(V, now, model->n_stretch * sizeof *V);
    }
    u[0] = density(motion, t + dt);
}

static int rows_of(const char *name, double rows[ROWS][COLUMNS])
{
    char path[128], line[4096];
    int n = 0;
    snprintf(path, sizeof path, "tests/data/branches/%s.csv", name);
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

static void begin(const struct model *model, double *u)
{
    u[0] = RHO0;
    for (unsigned k = 0; k <= model->n_branch; k++)
        elastic_identity(model, 1, 1, u + model->i_V + k * model->n_stretch);
}

/* Largest error of the stress and of the energy over G, the modulus of all springs. */
static double follow(const char *name, const struct model *model, motion_of *motion, double G, int parts)
{
    static double rows[ROWS][COLUMNS];
    double u[1 + 6 * STRETCHES + 6] = {0}, worst = 0.0;
    int n = rows_of(name, rows);
    begin(model, u);
    for (int r = 1; r < n; r++) {
        int some = motion == held && r == 1 ? 20 * parts : parts;
        double from = rows[r - 1][0], dt = (rows[r][0] - from) / some, s[6] = {0}, energy;
        const double *m[] = {u};
        for (int k = 0; k < some; k++) advance(model, motion, from + k * dt, dt, u);
        elastic_stress(model, 1, 1, u + model->i_V, m, s);
        elastic_energy(model, 1, 1, u + model->i_V, m, &energy);
        for (int c = 0; c < 6; c++) worst = fmax(worst, fabs(s[c] - rows[r][2 + c]) / G);
        worst = fmax(worst, fabs(energy * rows[r][1] - rows[r][9]) / G); /* per volume at rest */
    }
    print_message("%s, %d steps: %.2e\n", name, (n - 1) * parts, worst);
    return worst;
}

static void check(const char *name, const struct model *model, motion_of *motion, double G, double most)
{
    double coarse = follow(name, model, motion, G, 2), fine = follow(name, model, motion, G, 4);
    assert_true(coarse < most);
    assert_true(fine < 0.27 * coarse || fine < 1e-6);
}

static void test_paths(void **state)
{
    (void)state;
    const double none = 0.0, rest = 0.5e4 / RHO0;
    const double one[1][2] = {{3e4, 1e-6}}, fluid[1][2] = {{1e4, 1e-6}};
    const double three[3][2] = {{2e4, 1e-6}, {4e4, 1e-7}, {8e4, 1e-8}};
    struct model maxwell = model_of(2, &none, 1, fluid), sls = model_of(2, &rest, 1, one);
    struct model many = model_of(3, &rest, 3, three), line = model_of(1, &rest, 1, one);
    check("v01", &maxwell, startup, 1e4, 1e-4);
    assert_true(follow("v01", &maxwell, startup, 1e4, 11) < 4e-5); /* steps short enough for halves at both ends */
    check("v02", &sls, held, 4e4, 2e-6);
    check("v04", &sls, swing, 4e4, 2e-4);
    check("v05", &many, biaxial, 1.5e5, 4e-4);
    check("v06", &line, squeeze, 4e4, 1e-7);
}

static double det(const double V[6])
{
    double a = V[0] * V[1] - V[3] * V[3];
    return V[2] * a + 2.0 * V[3] * V[4] * V[5] - V[0] * V[5] * V[5] - V[1] * V[4] * V[4];
}

/* A small stretch falls as the exponential, in one step of any length; a large one comes to the same place in one step
 * as in many, keeps det 1 and, in whatever components it stands, the same energy; the identity keeps its bits, and long
 * after nothing is left. */
static void test_single(void **state)
{
    (void)state;
    const double slope = 0.5;
    for (unsigned n_velocity = 1; n_velocity <= 3; n_velocity++) {
        struct model model = model_of(n_velocity, &slope, 0, NULL);
        const double long_ago[] = {1e-3, 0.3, 2.0, 17.0};
        for (int k = 0; k < 4; k++) {
            double V[6] = {1.0 + 2e-7, 1.0 - 1e-7, 1.0 - 1e-7, n_velocity > 1 ? 1e-7 : 0.0, 0.0, 0.0}, one[6], many[6];
            double left = exp(-long_ago[k]);
            flow_relax(&model, 1, 1, long_ago[k], V);
            assert_true(fabs((V[0] - 1.0) - 2e-7 * left) < 1e-13);
            assert_true(n_velocity == 1 || fabs(V[3] - 1e-7 * left) < 1e-13);
            const double far[6] = {
                2.5, 0.8, 0.6, n_velocity > 1 ? 0.4 : 0.0, n_velocity > 2 ? -0.3 : 0.0, n_velocity > 2 ? 0.2 : 0.0};
            memcpy(one, far, sizeof one);
            for (int round = 0; round < 3; round++) elastic_unimodular(&model, 1, 1, one);
            memcpy(many, one, sizeof many);
            flow_relax(&model, 1, 1, long_ago[k], one);
            for (int step = 0; step < 50; step++) flow_relax(&model, 1, 1, long_ago[k] / 50.0, many);
            for (unsigned c = 0; c < model.n_stretch; c++) assert_true(fabs(one[c] - many[c]) < 3e-5);
            assert_true(fabs(det(one) - 1.0) < 1e-11);
            assert_true(fabs(det(many) - 1.0) < 1e-11);
        }
        double still[6] = {1.0, 1.0, 1.0};
        flow_relax(&model, 1, 1, 0.7, still);
        for (int c = 0; c < 6; c++) assert_true(still[c] == (c < 3 ? 1.0 : 0.0));
        double gone[6] = {4.0, 0.5, 0.5};
        flow_relax(&model, 1, 1, 50.0, gone);
        for (int c = 0; c < 6; c++) assert_true(gone[c] == (c < 3 ? 1.0 : 0.0));
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(test_paths), cmocka_unit_test(test_single)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
