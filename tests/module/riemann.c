/* riemann.c - the contract of kind "riemann" (core/suite/contract_riemann.c) on the built-in solvers, and each
 * against a plain scalar twin in textbook form (conserved vectors, wave by wave) written here. */
#include "support.h"

#include "suite/contract_face.h"
#include "suite/contract_module.h"

enum { FIELDS = CONTRACT_FACE_MATERIALS + CONTRACT_FACE_AXES + 1 };

static const char *const names[] = {"rusanov", "hll", "hllc", "hlld", "hllc-release", NULL};
static const unsigned materials[] = {1, 2, 3, 5};

/* Between fluids hlld is hllc. */
static bool resolves(const char *name)
{
    return strncmp(name, "hll", 3) == 0 && name[3];
}

/* The twin. Conserved vector: m_l, rho u_k, rho E. */
static void twin_vector(const struct contract_face *face, const struct contract_side *side, double *U)
{
    for (unsigned l = 0; l < face->shape.n_material; l++) U[l] = side->m[l];
    for (unsigned k = 0; k < face->shape.n_velocity; k++) U[face->shape.n_material + k] = side->rho * side->u[k];
    U[face->shape.n_material + face->shape.n_velocity] = side->rho_E;
}

static void twin_flux(const struct contract_face *face, const struct contract_side *side, double *F)
{
    unsigned energy = face->shape.n_material + face->shape.n_velocity;
    twin_vector(face, side, F);
    for (unsigned i = 0; i <= energy; i++) F[i] *= side->u[0];
    F[face->shape.n_material] += side->p;
    F[energy] += side->p * side->u[0];
}

/* U* of side K: Toro 2009 (10.39). */
static void twin_star(const struct contract_face *face, const struct contract_side *side, double S, double S_M,
                      double *U)
{
    double factor = (S - side->u[0]) / (S - S_M);
    unsigned energy = face->shape.n_material + face->shape.n_velocity;
    twin_vector(face, side, U);
    for (unsigned i = 0; i <= energy; i++) U[i] *= factor;
    U[face->shape.n_material] = side->rho * factor * S_M;
    U[energy] += factor * side->rho * (S_M - side->u[0]) * (S_M + side->p / (side->rho * (S - side->u[0])));
}

struct twin_speeds {
    double S_L, S_R, S_M;
};

/* Slower signals of sides that let go, where the fractions of a material differ by more than 0.01, in part below. */
static void twin_release(const struct contract_face *face, struct twin_speeds *s)
{
    const struct contract_side *l = &face->left, *r = &face->right;
    double alien = 0.0, c_l = l->c, c_r = r->c;
    for (unsigned i = 0; i < contract_face_n_alpha(&face->shape); i++)
        alien = fmax(alien, fmin(1.0, fabs(r->alpha[i] - l->alpha[i]) / 0.01));
    for (int round = 0; round < 3; round++) {
        double u = (l->rho * c_l * l->u[0] + r->rho * c_r * r->u[0] + l->p - r->p) / (l->rho * c_l + r->rho * c_r);
        c_l = fmax(l->c + l->u[0] - u, 0.5 * l->c);
        c_r = fmax(r->c + u - r->u[0], 0.5 * r->c);
    }
    s->S_L = l->u[0] - (l->u[0] - s->S_L) * fmin(1.0, 1.0 - alien * (1.0 - c_l / l->c));
    s->S_R = r->u[0] + (s->S_R - r->u[0]) * fmin(1.0, 1.0 - alien * (1.0 - c_r / r->c));
}

static struct twin_speeds twin_speeds(const char *name, const struct contract_face *face)
{
    const struct contract_side *l = &face->left, *r = &face->right;
    struct twin_speeds s = {.S_L = fmin(l->u[0] - l->c, r->u[0] - r->c), .S_R = fmax(l->u[0] + l->c, r->u[0] + r->c)};
    if (strcmp(name, "rusanov") == 0) {
        s.S_R = fmax(fabs(l->u[0]) + l->c, fabs(r->u[0]) + r->c);
        s.S_L = -s.S_R;
    }
    if (strcmp(name, "hllc-release") == 0) twin_release(face, &s);
    s.S_M = (r->p - l->p + l->rho * l->u[0] * (s.S_L - l->u[0]) - r->rho * r->u[0] * (s.S_R - r->u[0])) /
            (l->rho * (s.S_L - l->u[0]) - r->rho * (s.S_R - r->u[0]));
    return s;
}

/* HLL: Toro 2009 (10.21). */
static void twin_hll(const struct contract_face *face, struct twin_speeds s, double *F)
{
    double F_L[FIELDS], F_R[FIELDS], U_L[FIELDS], U_R[FIELDS];
    twin_flux(face, &face->left, F_L);
    twin_flux(face, &face->right, F_R);
    twin_vector(face, &face->left, U_L);
    twin_vector(face, &face->right, U_R);
    for (unsigned i = 0; i <= face->shape.n_material + face->shape.n_velocity; i++)
        F[i] = s.S_L >= 0.0   ? F_L[i]
               : s.S_R <= 0.0 ? F_R[i]
                              : (s.S_R * F_L[i] - s.S_L * F_R[i] + s.S_L * s.S_R * (U_R[i] - U_L[i])) / (s.S_R - s.S_L);
}

/* HLLC: F = F_K + S_K (U*_K - U_K), Toro 2009 (10.38). */
static void twin_hllc(const struct contract_face *face, struct twin_speeds s, double *F)
{
    const struct contract_side *from = s.S_L >= 0.0 || (s.S_R > 0.0 && s.S_M >= 0.0) ? &face->left : &face->right;
    double S = from == &face->left ? s.S_L : s.S_R, U[FIELDS], star[FIELDS];
    twin_flux(face, from, F);
    if (s.S_L >= 0.0 || s.S_R <= 0.0) return;
    twin_vector(face, from, U);
    twin_star(face, from, S, s.S_M, star);
    for (unsigned i = 0; i <= face->shape.n_material + face->shape.n_velocity; i++) F[i] += S * (star[i] - U[i]);
}

/* What the two-wave solvers add to HLLC with several materials: diffusion of shear. */
static void twin_shear(const struct contract_face *face, struct twin_speeds s, double *F)
{
    if (s.S_L >= 0.0 || s.S_R <= 0.0) return;
    double resist = -s.S_L * s.S_R / (s.S_R - s.S_L) * fmin(face->left.rho, face->right.rho);
    for (unsigned k = 1; k < face->shape.n_velocity; k++) {
        double stress = resist * (face->right.u[k] - face->left.u[k]);
        F[face->shape.n_material + k] -= stress;
        F[face->shape.n_material + face->shape.n_velocity] -= 0.5 * stress * (face->right.u[k] + face->left.u[k]);
    }
}

static struct contract_flux twin(const char *name, const struct contract_face *face)
{
    struct twin_speeds s = twin_speeds(name, face);
    double F[FIELDS];
    if (resolves(name)) twin_hllc(face, s, F);
    else if (face->shape.n_material == 1) twin_hll(face, s, F);
    else {
        twin_hllc(face, s, F);
        twin_shear(face, s, F);
    }
    struct contract_flux flux = {.u = s.S_L >= 0.0 ? face->left.u[0] : s.S_R <= 0.0 ? face->right.u[0] : s.S_M};
    for (unsigned l = 0; l < face->shape.n_material; l++) {
        flux.m[l] = F[l];
        flux.alpha[l] = flux.u >= 0.0 ? face->left.alpha[l] : face->right.alpha[l];
    }
    for (unsigned k = 0; k < face->shape.n_velocity; k++) flux.momentum[k] = F[face->shape.n_material + k];
    flux.rho_E = F[face->shape.n_material + face->shape.n_velocity];
    return flux;
}

static void check_twin(const struct contract *contract, const struct contract_face *face)
{
    struct contract_flux got = contract_face_solve(contract, face), want = twin(contract->module->name, face);
    struct contract_flux scale = contract_face_scale(face);
    support_near("u*", got.u, want.u, 1e-13, scale.u);
    support_near("energy", got.rho_E, want.rho_E, 1e-13, scale.rho_E);
    for (unsigned k = 0; k < face->shape.n_velocity; k++)
        support_near("momentum", got.momentum[k], want.momentum[k], 1e-13, scale.momentum[k]);
    for (unsigned l = 0; l < face->shape.n_material; l++) support_near("mass", got.m[l], want.m[l], 1e-13, scale.m[l]);
    for (unsigned l = 0; l < contract_face_n_alpha(&face->shape); l++) assert_true(got.alpha[l] == want.alpha[l]);
}

static void test_twin(void **state)
{
    (void)state;
    uint64_t seed = 11;
    for (const char *const *name = names; *name; name++)
        for (size_t i = 0; i < sizeof materials / sizeof *materials; i++)
            for (unsigned n_velocity = 1; n_velocity <= CONTRACT_FACE_AXES; n_velocity++)
                for (int j = 0; j < 400; j++) {
                    struct contract contract = {.module = support_module("riemann", *name)};
                    struct contract_shape shape = {.n_material = materials[i], .n_velocity = n_velocity};
                    struct contract_face face = contract_face_draw(&seed, shape, j % 2 ? 2.0 : 0.3);
                    check_twin(&contract, &face);
                }
}

/* HLLC keeps what the two-wave solvers smear, and Rusanov's speeds always enclose the face. */
static void check_facts(const struct contract *contract)
{
    bool hllc = resolves(contract->module->name), rusanov = !strcmp(contract->module->name, "rusanov");
    bool hlld = !strcmp(contract->module->name, "hlld"), solids = strcmp(contract->module->name, "hllc-release");
    assert_int_equal(contract->n_fact, solids ? 5 : 4);
    for (unsigned i = 0; i < contract->n_fact; i++) {
        const char *what = contract->facts[i].what;
        bool upwind = strstr(what, "supersonic") != NULL, slow = strstr(what, "shear waves") != NULL;
        bool wanted = upwind ? !rusanov : slow ? hlld : hllc;
        assert_int_equal(contract->facts[i].holds, strstr(what, "knows solids") ? solids : wanted);
    }
}

static void test_contract(void **state)
{
    (void)state;
    for (const char *const *name = names; *name; name++) {
        struct contract contract = {.module = support_module("riemann", *name), .strict = true};
        assert_int_equal(contract_module_run(&contract, NULL), 0);
        support_holds(&contract);
        /* hlld: the state between sharp shear waves; hll, rusanov: that they resist shear */
        bool solids = strcmp(*name, "hllc-release"), plain = strcmp(*name, "hllc") == 0;
        assert_int_equal(contract.n_row, solids ? 20 - plain : 16);
        check_facts(&contract);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(test_twin), cmocka_unit_test(test_contract)};
    return cmocka_run_group_tests(tests, support_start, support_stop);
}
