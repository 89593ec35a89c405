/* sides.h - what tests of Riemann solvers with solids share: faces of stretched solids and fluids, one struct each, and
 * the call that takes rows of them through a solver by name. */
#ifndef SIDES_H
#define SIDES_H

#include "bulla/riemann.h"
#include "plug/registry.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <string.h>

#include <cmocka.h>

enum { ROW = 64, MATERIALS = 2, AXES = 3 };

/* One side of one face; doubles only, so that fields are columns of rows. */
struct side {
    double rho, p, rho_E, c, u[AXES], m[MATERIALS], alpha[MATERIALS], c_s, s[AXES - 1];
};

struct shape {
    unsigned n_material, n_velocity, mixed, solid;
};

struct face {
    struct side left, right;
};

struct out {
    double m[MATERIALS], momentum[AXES], rho_E, u, alpha[MATERIALS], slide_left[AXES - 1], slide_right[AXES - 1];
};

enum { IN = sizeof(struct side) / sizeof(double), OUT = sizeof(struct out) / sizeof(double) };

static inline double random_unit(uint64_t *seed)
{
    *seed = *seed * 6364136223846793005u + 1442695040888963407u;
    return (double)(*seed >> 11) * 0x1p-53;
}

static inline double random_between(uint64_t *seed, double low, double high)
{
    return low + (high - low) * random_unit(seed);
}

/* Rows of the sides, and pointers into them at the places of the fields. */
struct rows {
    double in[2][IN][ROW], out[OUT][ROW], work[4][ROW];
    const double *u[2][AXES], *m[2][MATERIALS], *alpha[2][MATERIALS], *s[2][AXES - 1];
    double *flux_m[MATERIALS], *momentum[AXES], *flux_alpha[MATERIALS], *slide[2][AXES - 1];
};

#define PLACE(type, field) (offsetof(struct type, field) / sizeof(double))

static inline struct bulla_side side_of(struct rows *rows, unsigned i)
{
    double(*in)[ROW] = rows->in[i];
    for (unsigned k = 0; k < AXES; k++) rows->u[i][k] = in[PLACE(side, u) + k];
    for (unsigned k = 0; k + 1 < AXES; k++) rows->s[i][k] = in[PLACE(side, s) + k];
    for (unsigned l = 0; l < MATERIALS; l++) {
        rows->m[i][l] = in[PLACE(side, m) + l];
        rows->alpha[i][l] = in[PLACE(side, alpha) + l];
    }
    return (struct bulla_side){.rho = in[PLACE(side, rho)],
                               .p = in[PLACE(side, p)],
                               .rho_E = in[PLACE(side, rho_E)],
                               .c = in[PLACE(side, c)],
                               .u = rows->u[i],
                               .m = rows->m[i],
                               .alpha = rows->alpha[i]};
}

static inline struct bulla_flux flux_of(struct rows *rows)
{
    for (unsigned k = 0; k < AXES; k++) rows->momentum[k] = rows->out[PLACE(out, momentum) + k];
    for (unsigned l = 0; l < MATERIALS; l++) {
        rows->flux_m[l] = rows->out[PLACE(out, m) + l];
        rows->flux_alpha[l] = rows->out[PLACE(out, alpha) + l];
    }
    for (unsigned k = 0; k + 1 < AXES; k++) {
        rows->slide[0][k] = rows->out[PLACE(out, slide_left) + k];
        rows->slide[1][k] = rows->out[PLACE(out, slide_right) + k];
    }
    return (struct bulla_flux){.m = rows->flux_m,
                               .momentum = rows->momentum,
                               .rho_E = rows->out[PLACE(out, rho_E)],
                               .u = rows->out[PLACE(out, u)],
                               .alpha = rows->flux_alpha};
}

/* n <= ROW faces through a solver. */
static inline void solve_row(const char *name, struct shape shape, size_t n, const struct face *face, struct out *out)
{
    static struct rows rows;
    const struct registry_entry *entry = registry_find("riemann", name);
    assert_non_null(entry);
    const struct bulla_riemann *riemann = entry->module->table;
    assert_int_equal(riemann->solids, 1);
    memset(&rows, 0, sizeof rows);
    for (size_t i = 0; i < n; i++) {
        double values[2][IN];
        memcpy(values[0], &face[i].left, sizeof values[0]);
        memcpy(values[1], &face[i].right, sizeof values[1]);
        for (unsigned q = 0; q < IN; q++)
            for (unsigned k = 0; k < 2; k++) rows.in[k][q][i] = values[k][q];
    }
    struct bulla_faces faces = {.n = n,
                                .n_material = shape.n_material,
                                .n_alpha = shape.n_material > 1 ? shape.n_material : 0,
                                .n_velocity = shape.n_velocity,
                                .mixed = shape.mixed,
                                .left = side_of(&rows, 0),
                                .right = side_of(&rows, 1),
                                .flux = flux_of(&rows),
                                .work = {rows.work[0], rows.work[1], rows.work[2], rows.work[3]}};
    if (shape.solid) {
        faces.solid = 1;
        faces.shear_left = (struct bulla_shear){rows.in[0][PLACE(side, c_s)], rows.s[0]};
        faces.shear_right = (struct bulla_shear){rows.in[1][PLACE(side, c_s)], rows.s[1]};
        faces.slide_left = rows.slide[0];
        faces.slide_right = rows.slide[1];
    }
    riemann->solve(NULL, &faces);
    for (size_t i = 0; i < n; i++) {
        double values[OUT];
        for (unsigned q = 0; q < OUT; q++) values[q] = rows.out[q][i];
        memcpy(&out[i], values, sizeof values);
    }
}

static inline struct out solve(const char *name, struct shape shape, struct face face)
{
    struct out out;
    solve_row(name, shape, 1, &face, &out);
    return out;
}

/* Fields that the shape lacks are 0. */
static inline struct side trim(struct shape shape, struct side side)
{
    for (unsigned k = shape.n_velocity; k < AXES; k++) side.u[k] = side.s[k - 1] = 0.0;
    if (shape.n_material == 1) {
        side.m[0] = side.rho;
        side.m[1] = side.alpha[0] = side.alpha[1] = 0.0;
    }
    return side;
}

/* A stretched solid or, with mu = 0, a fluid. The fast speed is a bound, as core's is. */
static inline struct side draw(uint64_t *seed, struct shape shape, double mu, double speed)
{
    struct side side = {.rho = random_between(seed, 1.0, 2000.0), .alpha = {random_unit(seed)}};
    double stiff = random_between(seed, 1e5, 1e10), p = random_between(seed, -0.2, 1.0) * stiff, kinetic = 0.0;
    double B[AXES];
    for (unsigned k = 0; k < AXES; k++) B[k] = exp(random_between(seed, -1.0, 1.0));
    side.c_s = sqrt(mu * B[0] / side.rho);
    side.c = sqrt((1.4 * stiff + mu * (B[0] + B[1] + B[2])) / side.rho);
    side.p = p - mu * (B[0] - (B[0] + B[1] + B[2]) / 3.0);
    for (unsigned k = 0; k + 1 < AXES; k++) side.s[k] = mu * random_between(seed, -1.0, 1.0) * B[0];
    for (unsigned k = 0; k < AXES; k++) side.u[k] = speed * random_between(seed, -1.0, 1.0) * side.c;
    side.alpha[1] = 1.0 - side.alpha[0];
    side.m[0] = side.rho * random_unit(seed);
    side.m[1] = side.rho - side.m[0];
    side = trim(shape, side);
    for (unsigned k = 0; k < AXES; k++) kinetic += 0.5 * side.u[k] * side.u[k];
    side.rho_E = p / 0.4 + stiff + 0.5 * mu * (B[0] + B[1] + B[2] - 3.0) + side.rho * kinetic;
    return side;
}

/* From none over much softer to as stiff as the bulk. */
static inline double draw_mu(uint64_t *seed)
{
    double kind = random_unit(seed);
    return kind < 0.25 ? 0.0 : pow(10.0, random_between(seed, 0.0, 10.0));
}

static inline struct face draw_face(uint64_t *seed, struct shape shape, double speed)
{
    double mu_left = draw_mu(seed), mu_right = draw_mu(seed);
    return (struct face){.left = draw(seed, shape, mu_left, speed), .right = draw(seed, shape, mu_right, speed)};
}

/* F(U) of one side. */
static inline struct out physical(struct shape shape, const struct side *side)
{
    struct out out = {.u = side->u[0], .rho_E = side->u[0] * (side->rho_E + side->p)};
    out.momentum[0] = side->rho * side->u[0] * side->u[0] + side->p;
    for (unsigned k = 1; k < shape.n_velocity; k++) {
        out.momentum[k] = side->rho * side->u[0] * side->u[k] - side->s[k - 1];
        out.rho_E -= side->s[k - 1] * side->u[k];
        out.slide_left[k - 1] = out.slide_right[k - 1] = side->u[k];
    }
    for (unsigned l = 0; l < shape.n_material; l++) out.m[l] = side->m[l] * side->u[0];
    for (unsigned l = 0; l < shape.n_material && shape.n_material > 1; l++) out.alpha[l] = side->alpha[l];
    return out;
}

/* What terms of these sides can reach: the measure of round-off. */
static inline struct out scale_of(const struct face *face)
{
    struct out scale = {.u = 0.0};
    const struct side *sides[2] = {&face->left, &face->right};
    double most = 0.0, rho = 0.0, p = 0.0, c = 0.0;
    for (unsigned i = 0; i < 2; i++) {
        rho = fmax(rho, sides[i]->rho);
        c = fmax(c, sides[i]->c);
        p = fmax(p, fabs(sides[i]->p));
        for (unsigned k = 0; k < AXES; k++) most = fmax(most, fabs(sides[i]->u[k]));
        for (unsigned k = 0; k + 1 < AXES; k++) p = fmax(p, fabs(sides[i]->s[k]));
        scale.rho_E = fmax(scale.rho_E, fabs(sides[i]->rho_E));
    }
    most += c;
    scale.u = most;
    scale.rho_E = most * (scale.rho_E + p + rho * most * most);
    for (unsigned l = 0; l < MATERIALS; l++) scale.m[l] = rho * most;
    for (unsigned l = 0; l < MATERIALS; l++) scale.alpha[l] = 1.0;
    for (unsigned k = 0; k < AXES; k++) scale.momentum[k] = p + rho * most * most;
    for (unsigned k = 0; k + 1 < AXES; k++) scale.slide_left[k] = scale.slide_right[k] = most;
    return scale;
}

static inline void compare(const char *what, const struct face *face, struct out got, struct out want, double tolerance)
{
    struct out scale = scale_of(face);
    double g[OUT], w[OUT], s[OUT];
    memcpy(g, &got, sizeof g);
    memcpy(w, &want, sizeof w);
    memcpy(s, &scale, sizeof s);
    for (unsigned i = 0; i < OUT; i++)
        if (!(fabs(g[i] - w[i]) <= tolerance * s[i]))
            fail_msg("%s: value %u: got %.17g, want %.17g, scale %.3g", what, i, g[i], w[i], s[i]);
}

static inline int sides_start(void **state)
{
    (void)state;
    return registry_init();
}

static inline int sides_stop(void **state)
{
    (void)state;
    registry_done();
    return 0;
}

#endif
