/* riemann.c - the contract of kind "riemann" on the built-in solvers, and each against a plain
 * scalar twin in textbook form (conserved vectors, wave by wave) written here. */
#include "support.h"

#include "bulla/riemann.h"

enum { ROW = 37, MATERIALS = 5, AXES = 3, FIELDS = MATERIALS + AXES + 1 };

static const char *const names[] = {"rusanov", "hll", "hllc", NULL};
static const unsigned materials[] = {1, 2, 3, 5};

/* One side of one face. */
struct side {
    double rho, p, rho_E, c, u[AXES], m[MATERIALS], alpha[MATERIALS];
};

struct face {
    unsigned n_material, n_velocity;
    struct side left, right;
};

struct flux {
    double m[MATERIALS], momentum[AXES], rho_E, u, alpha[MATERIALS];
};

static unsigned n_alpha(const struct face *face)
{
    return face->n_material > 1 ? face->n_material : 0;
}

/* Batches: arrays for n faces, filled from structs. */
struct batch {
    double rho[2][ROW], p[2][ROW], rho_E[2][ROW], c[2][ROW];
    double u[2][AXES][ROW], m[2][MATERIALS][ROW], alpha[2][MATERIALS][ROW];
    double out_m[MATERIALS][ROW], out_momentum[AXES][ROW], out_E[ROW], out_u[ROW], out_alpha[MATERIALS][ROW];
    double work[4][ROW];
    const double *u_at[2][AXES], *m_at[2][MATERIALS], *alpha_at[2][MATERIALS];
    double *out_m_at[MATERIALS], *out_momentum_at[AXES], *out_alpha_at[MATERIALS];
    struct bulla_faces faces;
};

static void batch_put(struct batch *batch, int side, size_t i, const struct side *from)
{
    batch->rho[side][i] = from->rho;
    batch->p[side][i] = from->p;
    batch->rho_E[side][i] = from->rho_E;
    batch->c[side][i] = from->c;
    for (int k = 0; k < AXES; k++) batch->u[side][k][i] = from->u[k];
    for (int l = 0; l < MATERIALS; l++) {
        batch->m[side][l][i] = from->m[l];
        batch->alpha[side][l][i] = from->alpha[l];
    }
}

static struct bulla_side batch_side(struct batch *batch, int side)
{
    for (int k = 0; k < AXES; k++) batch->u_at[side][k] = batch->u[side][k];
    for (int l = 0; l < MATERIALS; l++) {
        batch->m_at[side][l] = batch->m[side][l];
        batch->alpha_at[side][l] = batch->alpha[side][l];
    }
    return (struct bulla_side){.rho = batch->rho[side],
                               .p = batch->p[side],
                               .rho_E = batch->rho_E[side],
                               .c = batch->c[side],
                               .u = batch->u_at[side],
                               .m = batch->m_at[side],
                               .alpha = batch->alpha_at[side]};
}

/* Solves n faces in one call. */
static void solve(const char *name, size_t n, const struct face *faces, struct flux *flux)
{
    static struct batch batch;
    memset(&batch, 0, sizeof batch);
    for (size_t i = 0; i < n; i++) {
        batch_put(&batch, 0, i, &faces[i].left);
        batch_put(&batch, 1, i, &faces[i].right);
    }
    for (int l = 0; l < MATERIALS; l++) batch.out_m_at[l] = batch.out_m[l], batch.out_alpha_at[l] = batch.out_alpha[l];
    for (int k = 0; k < AXES; k++) batch.out_momentum_at[k] = batch.out_momentum[k];
    batch.faces = (struct bulla_faces){.n = n,
                                       .n_material = faces->n_material,
                                       .n_alpha = n_alpha(faces),
                                       .n_velocity = faces->n_velocity,
                                       .left = batch_side(&batch, 0),
                                       .right = batch_side(&batch, 1),
                                       .flux = {.m = batch.out_m_at,
                                                .momentum = batch.out_momentum_at,
                                                .rho_E = batch.out_E,
                                                .u = batch.out_u,
                                                .alpha = batch.out_alpha_at},
                                       .work = {batch.work[0], batch.work[1], batch.work[2], batch.work[3]}};
    const struct bulla_riemann *table = support_module("riemann", name)->table;
    table->solve(NULL, &batch.faces);
    for (size_t i = 0; i < n; i++) {
        flux[i].rho_E = batch.out_E[i];
        flux[i].u = batch.out_u[i];
        for (int k = 0; k < AXES; k++) flux[i].momentum[k] = batch.out_momentum[k][i];
        for (int l = 0; l < MATERIALS; l++) flux[i].m[l] = batch.out_m[l][i], flux[i].alpha[l] = batch.out_alpha[l][i];
    }
}

static struct flux solve_one(const char *name, const struct face *face)
{
    struct flux flux;
    solve(name, 1, face, &flux);
    return flux;
}

/* A random state: stiff or gas-like, up to `mach` times the speed of sound in each direction. */
static struct side draw_side(uint64_t *seed, unsigned n_material, double mach)
{
    struct side side = {0};
    double sum = 0.0, kinetic = 0.0;
    for (unsigned l = 0; l < n_material; l++) sum += side.alpha[l] = pow(10.0, support_random(seed, -6.0, 0.0));
    for (unsigned l = 0; l < n_material; l++) {
        side.alpha[l] /= sum;
        side.m[l] = side.alpha[l] * pow(10.0, support_random(seed, 0.0, 3.3));
        side.rho += side.m[l];
    }
    double stiff = support_random(seed, 0.0, 1.0) < 0.5 ? 6e8 : 0.0;
    side.p = pow(10.0, support_random(seed, 4.0, 9.0));
    side.c = sqrt(1.4 * (side.p + stiff) / side.rho);
    for (int k = 0; k < AXES; k++) side.u[k] = support_random(seed, -mach, mach) * side.c;
    for (int k = 0; k < AXES; k++) kinetic += 0.5 * side.u[k] * side.u[k];
    side.rho_E = (side.p + 1.4 * stiff) / 0.4 + side.rho * kinetic;
    return side;
}

static struct face draw_face(uint64_t *seed, unsigned n_material, unsigned n_velocity, double mach)
{
    struct face face = {.n_material = n_material, .n_velocity = n_velocity};
    face.left = draw_side(seed, n_material, mach);
    face.right = draw_side(seed, n_material, mach);
    return face;
}

/* The twin. Conserved vector: m_l, rho u_k, rho E. */
static void twin_vector(const struct face *face, const struct side *side, double *U)
{
    for (unsigned l = 0; l < face->n_material; l++) U[l] = side->m[l];
    for (unsigned k = 0; k < face->n_velocity; k++) U[face->n_material + k] = side->rho * side->u[k];
    U[face->n_material + face->n_velocity] = side->rho_E;
}

static void twin_flux(const struct face *face, const struct side *side, double *F)
{
    unsigned energy = face->n_material + face->n_velocity;
    twin_vector(face, side, F);
    for (unsigned i = 0; i <= energy; i++) F[i] *= side->u[0];
    F[face->n_material] += side->p;
    F[energy] += side->p * side->u[0];
}

/* U* of side K: Toro 2009 (10.39). */
static void twin_star(const struct face *face, const struct side *side, double S, double S_M, double *U)
{
    double factor = (S - side->u[0]) / (S - S_M);
    unsigned energy = face->n_material + face->n_velocity;
    twin_vector(face, side, U);
    for (unsigned i = 0; i <= energy; i++) U[i] *= factor;
    U[face->n_material] = side->rho * factor * S_M;
    U[energy] += factor * side->rho * (S_M - side->u[0]) * (S_M + side->p / (side->rho * (S - side->u[0])));
}

struct twin_speeds {
    double S_L, S_R, S_M;
};

static struct twin_speeds twin_speeds(const char *name, const struct side *l, const struct side *r)
{
    struct twin_speeds s = {.S_L = fmin(l->u[0] - l->c, r->u[0] - r->c), .S_R = fmax(l->u[0] + l->c, r->u[0] + r->c)};
    if (strcmp(name, "rusanov") == 0) {
        s.S_R = fmax(fabs(l->u[0]) + l->c, fabs(r->u[0]) + r->c);
        s.S_L = -s.S_R;
    }
    s.S_M = (r->p - l->p + l->rho * l->u[0] * (s.S_L - l->u[0]) - r->rho * r->u[0] * (s.S_R - r->u[0])) /
            (l->rho * (s.S_L - l->u[0]) - r->rho * (s.S_R - r->u[0]));
    return s;
}

/* HLL: Toro 2009 (10.21). */
static void twin_hll(const struct face *face, struct twin_speeds s, double *F)
{
    double F_L[FIELDS], F_R[FIELDS], U_L[FIELDS], U_R[FIELDS];
    twin_flux(face, &face->left, F_L);
    twin_flux(face, &face->right, F_R);
    twin_vector(face, &face->left, U_L);
    twin_vector(face, &face->right, U_R);
    for (unsigned i = 0; i <= face->n_material + face->n_velocity; i++)
        F[i] = s.S_L >= 0.0   ? F_L[i]
               : s.S_R <= 0.0 ? F_R[i]
                              : (s.S_R * F_L[i] - s.S_L * F_R[i] + s.S_L * s.S_R * (U_R[i] - U_L[i])) / (s.S_R - s.S_L);
}

/* HLLC: F = F_K + S_K (U*_K - U_K), Toro 2009 (10.38). */
static void twin_hllc(const struct face *face, struct twin_speeds s, double *F)
{
    const struct side *from = s.S_L >= 0.0 || (s.S_R > 0.0 && s.S_M >= 0.0) ? &face->left : &face->right;
    double S = from == &face->left ? s.S_L : s.S_R, U[FIELDS], star[FIELDS];
    twin_flux(face, from, F);
    if (s.S_L >= 0.0 || s.S_R <= 0.0) return;
    twin_vector(face, from, U);
    twin_star(face, from, S, s.S_M, star);
    for (unsigned i = 0; i <= face->n_material + face->n_velocity; i++) F[i] += S * (star[i] - U[i]);
}

/* What the two-wave solvers add to HLLC with several materials: diffusion of shear. */
static void twin_shear(const struct face *face, struct twin_speeds s, double *F)
{
    if (s.S_L >= 0.0 || s.S_R <= 0.0) return;
    double resist = -s.S_L * s.S_R / (s.S_R - s.S_L) * fmin(face->left.rho, face->right.rho);
    for (unsigned k = 1; k < face->n_velocity; k++) {
        double stress = resist * (face->right.u[k] - face->left.u[k]);
        F[face->n_material + k] -= stress;
        F[face->n_material + face->n_velocity] -= 0.5 * stress * (face->right.u[k] + face->left.u[k]);
    }
}

static struct flux twin(const char *name, const struct face *face)
{
    struct twin_speeds s = twin_speeds(name, &face->left, &face->right);
    double F[FIELDS];
    if (strcmp(name, "hllc") == 0) twin_hllc(face, s, F);
    else if (face->n_material == 1) twin_hll(face, s, F);
    else {
        twin_hllc(face, s, F);
        twin_shear(face, s, F);
    }
    struct flux flux = {.u = s.S_L >= 0.0 ? face->left.u[0] : s.S_R <= 0.0 ? face->right.u[0] : s.S_M};
    for (unsigned l = 0; l < face->n_material; l++) {
        flux.m[l] = F[l];
        flux.alpha[l] = flux.u >= 0.0 ? face->left.alpha[l] : face->right.alpha[l];
    }
    for (unsigned k = 0; k < face->n_velocity; k++) flux.momentum[k] = F[face->n_material + k];
    flux.rho_E = F[face->n_material + face->n_velocity];
    return flux;
}

/* What sums of terms of these sides can reach: the measure of round-off. */
static struct flux scale_of(const struct face *face)
{
    const struct side *l = &face->left, *r = &face->right;
    double S = fmax(fabs(l->u[0]) + l->c, fabs(r->u[0]) + r->c), rho = fmax(l->rho, r->rho), most = 0.0;
    for (int k = 0; k < AXES; k++) most = fmax(most, fmax(fabs(l->u[k]), fabs(r->u[k])));
    struct flux scale = {.u = S, .rho_E = S * (fmax(l->rho_E, r->rho_E) + fmax(l->p, r->p) + rho * S * S)};
    for (unsigned k = 0; k < AXES; k++) scale.momentum[k] = rho * S * (S + most) + fmax(l->p, r->p);
    for (unsigned i = 0; i < MATERIALS; i++) scale.m[i] = S * fmax(l->m[i], r->m[i]) + 1e-300;
    return scale;
}

static void check_flux(const struct face *face, const struct flux *got, const struct flux *want, double tolerance)
{
    struct flux scale = scale_of(face);
    support_near("u*", got->u, want->u, tolerance, scale.u);
    support_near("energy", got->rho_E, want->rho_E, tolerance, scale.rho_E);
    for (unsigned k = 0; k < face->n_velocity; k++)
        support_near("momentum", got->momentum[k], want->momentum[k], tolerance, scale.momentum[k]);
    for (unsigned l = 0; l < face->n_material; l++)
        support_near("mass", got->m[l], want->m[l], tolerance * 10.0, scale.m[l]);
    for (unsigned l = 0; l < n_alpha(face); l++) assert_true(got->alpha[l] == want->alpha[l]);
}

/* Calls `check` on random faces of all solvers, numbers of materials and of velocities. */
static void on_all(void (*check)(const char *name, struct face *face, uint64_t *seed))
{
    uint64_t seed = 11;
    for (const char *const *name = names; *name; name++)
        for (size_t i = 0; i < sizeof materials / sizeof *materials; i++)
            for (unsigned n_velocity = 1; n_velocity <= AXES; n_velocity++)
                for (int j = 0; j < 400; j++) {
                    struct face face = draw_face(&seed, materials[i], n_velocity, j % 2 ? 2.0 : 0.3);
                    check(*name, &face, &seed);
                }
}

static void check_twin(const char *name, struct face *face, uint64_t *seed)
{
    (void)seed;
    struct flux got = solve_one(name, face), want = twin(name, face);
    check_flux(face, &got, &want, 1e-13);
}

static void test_twin(void **state)
{
    (void)state;
    on_all(check_twin);
}

/* F(U, U) = F(U). */
static void check_consistent(const char *name, struct face *face, uint64_t *seed)
{
    (void)seed;
    face->right = face->left;
    struct flux got = solve_one(name, face), want = {.u = face->left.u[0]};
    double F[FIELDS];
    twin_flux(face, &face->left, F);
    for (unsigned l = 0; l < face->n_material; l++) want.m[l] = F[l], want.alpha[l] = face->left.alpha[l];
    for (unsigned k = 0; k < face->n_velocity; k++) want.momentum[k] = F[face->n_material + k];
    want.rho_E = F[face->n_material + face->n_velocity];
    check_flux(face, &got, &want, 1e-15);
    assert_true(got.u == face->left.u[0]);
}

static void test_consistency(void **state)
{
    (void)state;
    on_all(check_consistent);
}

static struct face mirrored(const struct face *face)
{
    struct face image = *face;
    image.left = face->right;
    image.right = face->left;
    image.left.u[0] = -image.left.u[0];
    image.right.u[0] = -image.right.u[0];
    return image;
}

/* Seen in a mirror: every bit the same, odd fluxes with the other sign. */
static void check_mirror(const char *name, struct face *face, uint64_t *seed)
{
    (void)seed;
    struct face image = mirrored(face);
    struct flux got = solve_one(name, face), seen = solve_one(name, &image);
    assert_true(seen.u == -got.u && seen.rho_E == -got.rho_E && seen.momentum[0] == got.momentum[0]);
    for (unsigned k = 1; k < face->n_velocity; k++) assert_true(seen.momentum[k] == -got.momentum[k]);
    for (unsigned l = 0; l < face->n_material; l++) assert_true(seen.m[l] == -got.m[l]);
    for (unsigned l = 0; l < n_alpha(face); l++) assert_true(seen.alpha[l] == got.alpha[l]);
}

static void test_mirror(void **state)
{
    (void)state;
    on_all(check_mirror);
}

/* A side against its own mirror image, as at a wall: nothing goes through but pressure. */
static void check_wall(const char *name, struct face *face, uint64_t *seed)
{
    (void)seed;
    face->right = face->left;
    face->right.u[0] = -face->left.u[0];
    struct flux got = solve_one(name, face);
    if (fabs(face->left.u[0]) >= face->left.c) return; /* the signals do not enclose the face: no wall flow */
    assert_true(got.u == 0.0 && got.rho_E == 0.0);
    for (unsigned l = 0; l < face->n_material; l++) assert_true(got.m[l] == 0.0);
    for (unsigned k = 1; k < face->n_velocity; k++) assert_true(got.momentum[k] == 0.0);
}

static void test_wall(void **state)
{
    (void)state;
    on_all(check_wall);
}

/* Uniform p and u, any jump of alpha and densities (and of energy, whatever the laws): u* is u,
 * one mass, fraction and energy go through together. */
static void check_equilibrium(const char *name, struct face *face, uint64_t *seed)
{
    double u = support_random(seed, -3.0, 3.0) * face->left.c, p = face->left.p, kinetic = 0.0;
    struct side *sides[2] = {&face->left, &face->right};
    for (unsigned k = 1; k < face->n_velocity; k++) kinetic += 0.5 * face->left.u[k] * face->left.u[k];
    for (int i = 0; i < 2; i++) {
        double inner = face->n_material == 1 ? p / 0.4 : p * support_random(seed, 1.0, 10.0);
        memcpy(sides[i]->u, face->left.u, sizeof face->left.u);
        sides[i]->u[0] = u;
        sides[i]->p = p;
        sides[i]->rho_E = inner + sides[i]->rho * (0.5 * u * u + kinetic);
    }
    struct flux got = solve_one(name, face), scale = scale_of(face);
    double mass = 0.0;
    for (unsigned l = 0; l < face->n_material; l++) mass += got.m[l];
    assert_true(got.u == u);
    support_near("momentum", got.momentum[0], mass * u + p, 1e-14, scale.momentum[0]);
    for (unsigned k = 1; k < face->n_velocity; k++)
        support_near("tangential", got.momentum[k], mass * face->left.u[k], 1e-14, scale.momentum[k]);
    const struct side *from = u >= 0.0 ? &face->left : &face->right;
    if (face->n_material > 1 || strcmp(name, "hllc") == 0) {
        assert_true(got.rho_E == u * (from->rho_E + p) && got.momentum[0] == from->rho * u * u + p);
        for (unsigned l = 0; l < face->n_material; l++) assert_true(got.m[l] == from->m[l] * u);
        for (unsigned l = 0; l < n_alpha(face); l++) assert_true(got.alpha[l] == from->alpha[l]);
    } else { /* diffused mass takes its kinetic energy along, and leaves p alone */
        support_near("energy", got.rho_E, u * (p / 0.4 + p) + mass * (0.5 * u * u + kinetic), 1e-14, scale.rho_E);
    }
}

static void test_equilibrium(void **state)
{
    (void)state;
    on_all(check_equilibrium);
}

/* A contact in a fluid at rest: exactly nothing moves. */
static void check_rest(const char *name, struct face *face, uint64_t *seed)
{
    (void)seed;
    if (face->n_material == 1 && strcmp(name, "hllc") != 0) return; /* two waves smear it */
    memset(face->left.u, 0, sizeof face->left.u);
    memset(face->right.u, 0, sizeof face->right.u);
    face->right.p = face->left.p;
    struct flux got = solve_one(name, face);
    assert_true(got.u == 0.0 && got.rho_E == 0.0 && got.momentum[0] == face->left.p);
    for (unsigned k = 1; k < face->n_velocity; k++) assert_true(got.momentum[k] == 0.0);
    for (unsigned l = 0; l < face->n_material; l++) assert_true(got.m[l] == 0.0);
}

static void test_rest(void **state)
{
    (void)state;
    on_all(check_rest);
}

/* alpha* lies between its sides and sums to 1; the mass fluxes sum to the flux of rho. */
static void check_sums(const char *name, struct face *face, uint64_t *seed)
{
    (void)seed;
    struct flux got = solve_one(name, face);
    double sum = 0.0;
    for (unsigned l = 0; l < n_alpha(face); l++) {
        double low = fmin(face->left.alpha[l], face->right.alpha[l]),
               high = fmax(face->left.alpha[l], face->right.alpha[l]);
        assert_true(got.alpha[l] >= low && got.alpha[l] <= high);
        sum += got.alpha[l];
    }
    if (n_alpha(face)) support_near("sum of alpha*", sum, 1.0, 1e-15, 4.0);
    struct face single = *face;
    single.n_material = 1;
    single.left.m[0] = face->left.rho;
    single.right.m[0] = face->right.rho;
    if (strcmp(name, "hllc") != 0) return; /* the others have one form for one material, one for several */
    double mass = 0.0;
    for (unsigned l = 0; l < face->n_material; l++) mass += got.m[l];
    support_near("sum of mass fluxes", mass, solve_one(name, &single).m[0], 1e-14,
                 scale_of(face).momentum[0] / scale_of(face).u);
}

static void test_sums(void **state)
{
    (void)state;
    on_all(check_sums);
}

/* A jump of tangential velocity: sharp with HLLC, diffused by the others, who turn kinetic energy
 * into heat and never the other way. */
static void test_shear(void **state)
{
    (void)state;
    for (const char *const *name = names; *name; name++)
        for (unsigned i = 0; i < 4; i++) {
            uint64_t seed = 21 + i;
            struct face face = draw_face(&seed, materials[i], 2, 0.0);
            face.right = face.left;
            face.left.u[1] = 5.0;
            face.right.u[1] = -3.0;
            face.left.rho_E += 0.5 * face.left.rho * 25.0;
            face.right.rho_E += 0.5 * face.right.rho * 9.0;
            struct flux got = solve_one(*name, &face);
            if (strcmp(*name, "hllc") == 0) {
                assert_true(got.momentum[1] == 0.0 && got.rho_E == 0.0);
                continue;
            }
            assert_true(got.momentum[1] > 0.0); /* from the faster to the slower side */
            support_near("work of shear", got.rho_E, got.momentum[1] * 1.0, 1e-12, got.rho_E);
        }
}

/* A face's flux depends on its two sides alone. */
static void test_rows(void **state)
{
    (void)state;
    uint64_t seed = 31;
    for (const char *const *name = names; *name; name++)
        for (unsigned i = 0; i < 4; i++) {
            struct face faces[ROW];
            struct flux flux[ROW];
            for (int j = 0; j < ROW; j++) faces[j] = draw_face(&seed, materials[i], AXES, 2.0);
            for (size_t first = 0; first < 9; first++) {
                size_t n = ROW - 4 * first;
                solve(*name, n, faces + first, flux);
                for (size_t j = 0; j < n; j++) {
                    struct flux one = solve_one(*name, &faces[first + j]);
                    assert_memory_equal(&flux[j], &one, sizeof one);
                }
            }
        }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_twin), cmocka_unit_test(test_consistency), cmocka_unit_test(test_mirror),
        cmocka_unit_test(test_wall), cmocka_unit_test(test_equilibrium), cmocka_unit_test(test_rest),
        cmocka_unit_test(test_sums), cmocka_unit_test(test_shear),       cmocka_unit_test(test_rows),
    };
    return cmocka_run_group_tests(tests, support_start, support_stop);
}
