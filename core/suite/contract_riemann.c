/* contract_riemann.c - see contract_riemann.h.
 *
 * Every check takes a random face, makes of it what the check is about, and compares fluxes on the
 * scale of the sides' own. Solvers may smear a contact of one material or take both sides in
 * supersonic flow: such properties are told, not judged. With several materials the contact
 * must be kept, because no solver knows the laws that pressure would have to be restored with. */
#include "suite/contract_riemann.h"

#include "bulla/riemann.h"
#include "suite/contract_face.h"
#include "suite/contract_solid.h"

#include <math.h>
#include <stddef.h>
#include <stdio.h>
#include <string.h>

enum { RIEMANN_FACES = 200 };

/* How many materials; last one that core lists alone in a scene of several. */
static const struct contract_shape contract_riemann_shapes[] = {
    {.n_material = 1}, {.n_material = 2}, {.n_material = 3}, {.n_material = 5}, {.n_material = 1, .mixed = true}};

/* The same with solids. */
static const struct contract_shape contract_riemann_solids[] = {{.n_material = 1, .solid = true},
                                                                {.n_material = 2, .solid = true},
                                                                {.n_material = 3, .solid = true},
                                                                {.n_material = 1, .mixed = true, .solid = true}};

/* The names of facts and of checks that several places share. */
#define RIEMANN_CONTACT "keeps contacts of one material sharp"
#define RIEMANN_SHEAR "keeps shear sharp"
#define RIEMANN_UPWIND "takes the upwind side alone in supersonic flow"
#define RIEMANN_REST "with several materials nothing moves in a fluid at rest"

/* The errors of all fluxes under the check at work. */
static void contract_riemann_compare(struct contract *contract, const struct contract_face *face,
                                     const struct contract_flux *got, const struct contract_flux *want)
{
    static const char *const names[] = {"m", "momentum", "energy", "u*", "alpha*", "u*_t"};
    static const unsigned ends[] = {CONTRACT_FACE_MATERIALS,
                                    CONTRACT_FACE_MATERIALS + CONTRACT_FACE_AXES,
                                    CONTRACT_FACE_MATERIALS + CONTRACT_FACE_AXES + 1,
                                    CONTRACT_FACE_MATERIALS + CONTRACT_FACE_AXES + 2,
                                    2 * CONTRACT_FACE_MATERIALS + CONTRACT_FACE_AXES + 2,
                                    sizeof *got / sizeof(double)};
    struct contract_flux scale = contract_face_scale(face);
    double g[sizeof *got / sizeof(double)], w[sizeof *got / sizeof(double)], s[sizeof *got / sizeof(double)];
    char state[CONTRACT_NAME], where[2 * CONTRACT_NAME];
    memcpy(g, got, sizeof *got);
    memcpy(w, want, sizeof *want);
    memcpy(s, &scale, sizeof scale);
    contract_face_where(face, state);
    for (unsigned i = 0, kind = 0; i < ends[5]; i++) {
        while (i >= ends[kind]) kind++;
        snprintf(where, sizeof where, "%s, %s", state, names[kind]);
        contract_near(contract, g[i], w[i], s[i], where);
    }
}

/* F(U, U) = F(U). */
static void contract_riemann_consistent(struct contract *contract, struct contract_face face)
{
    face.right = face.left;
    struct contract_flux got = contract_face_solve(contract, &face);
    struct contract_flux want = contract_face_physical(&face.shape, &face.left);
    contract_begin(contract, "equal sides give the physical flux", 1e-14);
    contract_riemann_compare(contract, &face, &got, &want);
}

/* Seen in a mirror the odd fluxes have the other sign. */
static void contract_riemann_mirror(struct contract *contract, struct contract_face face)
{
    struct contract_face image = face;
    image.left = face.right;
    image.right = face.left;
    image.left.u[0] = -image.left.u[0];
    image.right.u[0] = -image.right.u[0];
    for (unsigned k = 0; k + 1 < CONTRACT_FACE_AXES; k++) {
        image.left.s[k] = -image.left.s[k];
        image.right.s[k] = -image.right.s[k];
    }
    struct contract_flux got = contract_face_solve(contract, &face), seen = contract_face_solve(contract, &image);
    seen.u = -seen.u;
    seen.rho_E = -seen.rho_E;
    for (unsigned k = 1; k < face.shape.n_velocity; k++) seen.momentum[k] = -seen.momentum[k];
    for (unsigned l = 0; l < face.shape.n_material; l++) seen.m[l] = -seen.m[l];
    for (unsigned k = 0; k + 1 < CONTRACT_FACE_AXES; k++) {
        double slide = seen.slide_left[k];
        seen.slide_left[k] = seen.slide_right[k];
        seen.slide_right[k] = slide;
    }
    contract_begin(contract, "mirrored sides give mirrored fluxes", contract->strict ? 0.0 : 1e-13);
    contract_riemann_compare(contract, &face, &got, &seen);
}

/* A side against its own mirror image, as at a wall: nothing goes through but pressure. */
static void contract_riemann_wall(struct contract *contract, struct contract_face face)
{
    face.right = face.left;
    face.right.u[0] = -face.left.u[0];
    for (unsigned k = 0; k + 1 < CONTRACT_FACE_AXES; k++) face.right.s[k] = -face.left.s[k];
    if (fabs(face.left.u[0]) >= face.left.c) return; /* the signals do not enclose the face: no wall flow */
    struct contract_flux got = contract_face_solve(contract, &face), want = got;
    want.u = want.rho_E = 0.0;
    memset(want.m, 0, sizeof want.m);
    memset(want.momentum + 1, 0, sizeof want.momentum - sizeof *want.momentum);
    contract_begin(contract, "nothing but pressure goes through a wall", contract->strict ? 0.0 : 1e-14);
    contract_riemann_compare(contract, &face, &got, &want);
}

/* Tractions that do not jump; where one side is a fluid there are none. */
static void contract_riemann_even(struct contract_face *face)
{
    bool both = face->left.c_s > 0.0 && face->right.c_s > 0.0;
    if (!both) memset(face->left.s, 0, sizeof face->left.s);
    memcpy(face->right.s, face->left.s, sizeof face->left.s);
}

/* Uniform p and u, any jump of alpha and densities (and with several materials of energy, whatever the laws). */
static void contract_riemann_level(struct contract_face *face, uint64_t *seed)
{
    double u = contract_random(seed, -3.0, 3.0) * face->left.c, p = face->left.p, kinetic = 0.0;
    struct contract_side *sides[2] = {&face->left, &face->right};
    for (unsigned k = 1; k < face->shape.n_velocity; k++) kinetic += 0.5 * face->left.u[k] * face->left.u[k];
    for (int i = 0; i < 2; i++) {
        double inner = face->shape.n_material == 1 ? p / 0.4 : p * contract_random(seed, 1.0, 10.0);
        memcpy(sides[i]->u, face->left.u, sizeof face->left.u);
        sides[i]->u[0] = u;
        sides[i]->p = p;
        sides[i]->rho_E = inner + sides[i]->rho * (0.5 * u * u + kinetic);
    }
}

/* Adds what the tractions of the left side do to momentum and energy, and how their face moves. */
static void contract_riemann_pull(const struct contract_face *face, struct contract_flux *flux)
{
    const struct contract_side *side = &face->left;
    for (unsigned k = 1; face->shape.solid && k < face->shape.n_velocity; k++) {
        flux->momentum[k] -= side->s[k - 1];
        flux->rho_E -= side->s[k - 1] * side->u[k];
        flux->slide_left[k - 1] = flux->slide_right[k - 1] = side->u[k];
    }
}

/* u* is u, momentum goes with the mass, and mass, fraction and energy are those of one state between
 * the sides (rho E*, m*, alpha*): mostly the upwind one. One material: diffused mass takes its kinetic
 * energy along and leaves p alone. */
static void contract_riemann_equilibrium(struct contract *contract, struct contract_face face, uint64_t *seed)
{
    contract_riemann_level(&face, seed);
    contract_riemann_even(&face);
    const struct contract_side *l = &face.left, *r = &face.right;
    struct contract_flux got = contract_face_solve(contract, &face), want = {.u = l->u[0]};
    double u = l->u[0], mass = 0.0, kinetic = 0.5 * u * u;
    for (unsigned i = 0; i < face.shape.n_material; i++) mass += got.m[i];
    for (unsigned k = 0; k < face.shape.n_velocity; k++) want.momentum[k] = mass * l->u[k];
    for (unsigned k = 1; k < face.shape.n_velocity; k++) kinetic += 0.5 * l->u[k] * l->u[k];
    want.momentum[0] += l->p;
    want.m[0] = got.m[0];
    want.rho_E = u * (l->p / 0.4 + l->p) + mass * kinetic;
    if (contract_face_n_alpha(&face.shape)) {
        double jump = l->alpha[0] - r->alpha[0], weight = (got.alpha[0] - r->alpha[0]) / jump;
        if (fabs(jump) < 1e-2) return; /* too little to tell the weights of the sides from */
        want.rho_E = u * (weight * l->rho_E + (1.0 - weight) * r->rho_E + l->p);
        for (unsigned i = 0; i < face.shape.n_material; i++) {
            want.m[i] = u * (weight * l->m[i] + (1.0 - weight) * r->m[i]);
            want.alpha[i] = weight * l->alpha[i] + (1.0 - weight) * r->alpha[i];
        }
    } else if (!face.shape.mixed) {
        const struct contract_side *from = u >= 0.0 ? l : r;
        contract_fact(contract, RIEMANN_CONTACT, fabs(got.m[0] - from->rho * u) <= 1e-12 * fabs(from->rho * u));
    }
    contract_riemann_pull(&face, &want);
    contract_begin(contract, "uniform p and u stay so, whatever jumps beside them", 1e-13);
    contract_riemann_compare(contract, &face, &got, &want);
}

/* A contact in a fluid at rest. */
static void contract_riemann_rest(struct contract *contract, struct contract_face face)
{
    if (face.shape.n_material == 1 && !face.shape.mixed) return; /* may be smeared: a fact, see above */
    memset(face.left.u, 0, sizeof face.left.u);
    memset(face.right.u, 0, sizeof face.right.u);
    face.right.p = face.left.p;
    contract_riemann_even(&face);
    struct contract_flux got = contract_face_solve(contract, &face), want = {.momentum = {face.left.p}};
    memcpy(want.alpha, got.alpha, sizeof want.alpha);
    contract_riemann_pull(&face, &want);
    contract_begin(contract, RIEMANN_REST, contract->strict ? 0.0 : 1e-14);
    contract_riemann_compare(contract, &face, &got, &want);
}

/* alpha* lies between its sides and sums to 1. */
static void contract_riemann_fractions(struct contract *contract, struct contract_face face)
{
    struct contract_flux got = contract_face_solve(contract, &face);
    unsigned n_alpha = contract_face_n_alpha(&face.shape);
    double sum = 0.0, outside = 0.0;
    char where[CONTRACT_NAME];
    if (!n_alpha) return;
    for (unsigned l = 0; l < n_alpha; l++) {
        double a = face.left.alpha[l], b = face.right.alpha[l], low = a < b ? a : b, high = a < b ? b : a;
        double beyond = got.alpha[l] < low ? low - got.alpha[l] : got.alpha[l] - high;
        outside = beyond > outside ? beyond : outside;
        sum += got.alpha[l];
    }
    contract_face_where(&face, where);
    contract_begin(contract, "alpha* lies between its sides", contract->strict ? 0.0 : 1e-15);
    contract_error(contract, outside, "%s", where);
    contract_begin(contract, "alpha* sums to 1", 4e-15);
    contract_near(contract, sum, 1.0, 1.0, where);
}

/* The same fluid seen as one material of a mixed scene: the sum of the masses, the rest alike. Fractions do not jump:
 * signals may depend on it. */
static void contract_riemann_sum(struct contract *contract, struct contract_face face)
{
    memcpy(face.right.alpha, face.left.alpha, sizeof face.right.alpha);
    struct contract_face single = face;
    single.shape.n_material = 1;
    single.shape.mixed = true;
    single.left.m[0] = face.left.rho;
    single.right.m[0] = face.right.rho;
    struct contract_flux got = contract_face_solve(contract, &face), one = contract_face_solve(contract, &single);
    double mass = 0.0;
    for (unsigned l = 0; l < face.shape.n_material; l++) mass += got.m[l];
    memset(got.m, 0, sizeof got.m);
    memset(got.alpha, 0, sizeof got.alpha);
    got.m[0] = mass;
    if (face.shape.n_material == 1) return;
    contract_begin(contract, "mass fluxes sum to that of rho", 1e-14);
    contract_riemann_compare(contract, &single, &got, &one);
}

/* Where a tile holds one material only, core lists it alone: the bits must be those of the full list. */
static void contract_riemann_alone(struct contract *contract, struct contract_face face)
{
    if (face.shape.n_material == 1) return;
    struct contract_side *sides[2] = {&face.left, &face.right};
    for (int i = 0; i < 2; i++) {
        for (unsigned l = 1; l < face.shape.n_material; l++) sides[i]->m[l] = sides[i]->alpha[l] = 0.0;
        sides[i]->m[0] = sides[i]->rho;
        sides[i]->alpha[0] = 1.0;
    }
    struct contract_face single = face;
    single.shape = (struct contract_shape){1, face.shape.n_velocity, true, face.shape.solid};
    struct contract_flux full = contract_face_solve(contract, &face), one = contract_face_solve(contract, &single);
    bool same = full.rho_E == one.rho_E && full.u == one.u && full.m[0] == one.m[0];
    for (unsigned k = 0; k < face.shape.n_velocity; k++) same &= full.momentum[k] == one.momentum[k];
    for (unsigned k = 0; k + 1 < CONTRACT_FACE_AXES; k++)
        same &= full.slide_left[k] == one.slide_left[k] && full.slide_right[k] == one.slide_right[k];
    char where[CONTRACT_NAME];
    contract_face_where(&face, where);
    contract_begin(contract, "one material listed alone (mixed): as in the full list, bitwise", 0.0);
    contract_holds(contract, same && full.alpha[0] == 1.0, where);
}

/* What a table says of itself behind the slots that it had first: older ones end before. */
static uint32_t contract_riemann_says(const struct contract *contract, size_t offset)
{
    const struct bulla_riemann *riemann = contract->module->table;
    uint32_t said = 0;
    if (riemann->size >= offset + sizeof said) memcpy(&said, (const char *)riemann + offset, sizeof said);
    return said;
}

/* A jump of tangential velocity alone: if it is diffused, then from the faster to the slower side,
 * taking the mean velocity's work along. */
static void contract_riemann_shear(struct contract *contract, struct contract_face face)
{
    if (face.shape.n_velocity < 2 || face.shape.solid) return;
    for (int k = 0; k < CONTRACT_FACE_AXES; k++) {
        face.left.rho_E -= 0.5 * face.left.rho * face.left.u[k] * face.left.u[k];
        face.left.u[k] = 0.0;
    }
    face.right = face.left;
    face.left.u[1] = 5.0;
    face.right.u[1] = -3.0;
    face.left.rho_E += 0.5 * face.left.rho * 25.0;
    face.right.rho_E += 0.5 * face.right.rho * 9.0;
    struct contract_flux got = contract_face_solve(contract, &face);
    struct contract_flux scale = contract_face_scale(&face);
    char where[CONTRACT_NAME];
    contract_face_where(&face, where);
    contract_begin(contract, "shear is diffused downhill, with the work of its mean", 1e-14);
    contract_error(contract, got.momentum[1] < 0.0, "%s: momentum %.3g", where, got.momentum[1]);
    contract_near(contract, got.rho_E, got.momentum[1] * 1.0, scale.rho_E, where);
    contract_fact(contract, RIEMANN_SHEAR, fabs(got.momentum[1]) <= 1e-12 * scale.momentum[1]);
    if (!contract_riemann_says(contract, offsetof(struct bulla_riemann, resists))) return;
    double sound = got.momentum[1] / (face.left.rho * face.left.c * 8.0);
    contract_begin(contract, "resists: shear is diffused as fast as sound", 0.0);
    contract_error(contract, sound < 0.25, "%s: by %.3g of rho c", where, sound);
}

/* Both sides move over the face faster than any signal could return. */
static void contract_riemann_supersonic(struct contract *contract, struct contract_face face)
{
    double most = face.left.c > face.right.c ? face.left.c : face.right.c;
    double u[2] = {2.0 * most, 2.5 * most};
    struct contract_side *sides[2] = {&face.left, &face.right};
    for (int i = 0; i < 2; i++) {
        sides[i]->rho_E += 0.5 * sides[i]->rho * (u[i] * u[i] - sides[i]->u[0] * sides[i]->u[0]);
        sides[i]->u[0] = u[i];
    }
    struct contract_flux got = contract_face_solve(contract, &face);
    struct contract_flux want = contract_face_physical(&face.shape, &face.left), scale = contract_face_scale(&face);
    contract_fact(contract, RIEMANN_UPWIND, fabs(got.rho_E - want.rho_E) <= 1e-12 * scale.rho_E);
    contract_begin(contract, "supersonic flow: u* > 0, alpha* upwind", 1e-13);
    contract_error(contract, !(got.u > 0.0), "u* %.3g between %.3g and %.3g", got.u, u[0], u[1]);
    for (unsigned l = 0; l < contract_face_n_alpha(&face.shape); l++)
        contract_near(contract, got.alpha[l], face.left.alpha[l], 1.0, "alpha*");
}

static void contract_riemann_checks(struct contract *contract, struct contract_shape shape, uint64_t *seed)
{
    for (int j = 0; j < RIEMANN_FACES; j++) {
        struct contract_face face = contract_face_draw(seed, shape, j % 2 ? 2.0 : 0.3);
        contract_riemann_consistent(contract, face);
        contract_riemann_mirror(contract, face);
        contract_riemann_wall(contract, face);
        contract_riemann_equilibrium(contract, face, seed);
        contract_riemann_rest(contract, face);
        contract_riemann_fractions(contract, face);
        contract_riemann_sum(contract, face);
        contract_riemann_alone(contract, face);
        contract_riemann_shear(contract, face);
        contract_riemann_supersonic(contract, face);
        if (shape.solid) contract_solid_face(contract, &face);
    }
}

/* All checks on scenes of the given kinds, and rows of such faces. */
static void contract_riemann_scenes(struct contract *contract, const struct contract_shape *shapes, size_t n,
                                    uint64_t *seed)
{
    for (size_t i = 0; i < n * CONTRACT_FACE_AXES; i++) {
        struct contract_shape shape = shapes[i / CONTRACT_FACE_AXES];
        shape.n_velocity = 1 + (unsigned)(i % CONTRACT_FACE_AXES);
        contract_doing(contract, "single faces");
        contract_riemann_checks(contract, shape, seed);
        struct contract_call call = contract_face_call(&shape);
        contract_batch_run(contract, &call);
    }
}

void contract_riemann_run(struct contract *contract)
{
    uint64_t seed = 11;
    contract_riemann_scenes(contract, contract_riemann_shapes,
                            sizeof contract_riemann_shapes / sizeof *contract_riemann_shapes, &seed);
    uint32_t solids = contract_riemann_says(contract, offsetof(struct bulla_riemann, solids));
    uint32_t resists = contract_riemann_says(contract, offsetof(struct bulla_riemann, resists));
    contract_fact(contract, "knows solids", solids == 1);
    contract_begin(contract, "solids and resists are 0 or 1", 0.0);
    contract_error(contract, solids > 1, "solids = %u", solids);
    contract_error(contract, resists > 1, "resists = %u", resists);
    if (solids)
        contract_riemann_scenes(contract, contract_riemann_solids,
                                sizeof contract_riemann_solids / sizeof *contract_riemann_solids, &seed);
}

void contract_riemann_probe(const struct contract *contract, double out[static CONTRACT_PROBE])
{
    uint64_t seed = 1;
    struct contract_face face = contract_face_draw(&seed, contract_riemann_shapes[0], 0.3);
    struct contract_flux flux = contract_face_solve(contract, &face);
    out[0] = flux.u;
    out[1] = flux.rho_E;
}
