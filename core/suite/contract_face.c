/* contract_face.c - see contract_face.h. */
#include "suite/contract_face.h"

#include "bulla/riemann.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

enum {
    FACE_SIDE = sizeof(struct contract_side) / sizeof(double),
    FACE_FLUX = sizeof(struct contract_flux) / sizeof(double),
    FACE_ROW = 512,
    FACE_U = 4,
    FACE_M = FACE_U + CONTRACT_FACE_AXES,
    FACE_ALPHA = FACE_M + CONTRACT_FACE_MATERIALS,
    FACE_SHEAR = FACE_ALPHA + CONTRACT_FACE_MATERIALS,
    FACE_MOMENTUM = CONTRACT_FACE_MATERIALS,
    FACE_ENERGY = FACE_MOMENTUM + CONTRACT_FACE_AXES,
    FACE_FRACTION = FACE_ENERGY + 2,
    FACE_SLIDE = FACE_FRACTION + CONTRACT_FACE_MATERIALS
};

_Static_assert(2 * FACE_SIDE <= (int)CONTRACT_BATCH_IN && FACE_FLUX <= (int)CONTRACT_BATCH_OUT, "rows of a face");

unsigned contract_face_n_alpha(const struct contract_shape *shape)
{
    return shape->n_material > 1 ? shape->n_material : 0;
}

static double contract_face_most(double a, double b)
{
    return a > b ? a : b;
}

static struct contract_side contract_face_draw_side(uint64_t *seed, unsigned n_material, double mach)
{
    struct contract_side side = {0};
    double sum = 0.0, kinetic = 0.0;
    for (unsigned l = 0; l < n_material; l++) sum += side.alpha[l] = pow(10.0, contract_random(seed, -6.0, 0.0));
    for (unsigned l = 0; l < n_material; l++) {
        side.alpha[l] /= sum;
        side.m[l] = side.alpha[l] * pow(10.0, contract_random(seed, 0.0, 3.3));
        side.rho += side.m[l];
    }
    double stiff = contract_random(seed, 0.0, 1.0) < 0.5 ? 6e8 : 0.0;
    side.p = pow(10.0, contract_random(seed, 4.0, 9.0));
    side.c = sqrt(1.4 * (side.p + stiff) / side.rho);
    for (int k = 0; k < CONTRACT_FACE_AXES; k++) side.u[k] = contract_random(seed, -mach, mach) * side.c;
    for (int k = 0; k < CONTRACT_FACE_AXES; k++) kinetic += 0.5 * side.u[k] * side.u[k];
    side.rho_E = (side.p + 1.4 * stiff) / 0.4 + side.rho * kinetic;
    return side;
}

/* Makes a solid of a side, soft or stiff; some of a scene of several materials stay fluids. */
static void contract_face_draw_shear(uint64_t *seed, struct contract_side *side, bool several)
{
    if (several && contract_random(seed, 0.0, 1.0) < 0.4) return;
    side->c_s = side->c * pow(10.0, contract_random(seed, -3.0, -0.3));
    for (int k = 0; k + 1 < CONTRACT_FACE_AXES; k++)
        side->s[k] = side->rho * side->c_s * side->c_s * contract_random(seed, -0.3, 0.3);
}

struct contract_face contract_face_draw(uint64_t *seed, struct contract_shape shape, double mach)
{
    struct contract_face face = {.shape = shape};
    face.left = contract_face_draw_side(seed, shape.n_material, mach);
    face.right = contract_face_draw_side(seed, shape.n_material, mach);
    if (!shape.solid) return face;
    bool several = shape.n_material > 1 || shape.mixed;
    contract_face_draw_shear(seed, &face.left, several);
    contract_face_draw_shear(seed, &face.right, several);
    return face;
}

static struct bulla_side contract_face_side(const double *const *in)
{
    return (struct bulla_side){.rho = in[0],
                               .p = in[1],
                               .rho_E = in[2],
                               .c = in[3],
                               .u = in + FACE_U,
                               .m = in + FACE_M,
                               .alpha = in + FACE_ALPHA};
}

static struct bulla_shear contract_face_shear(const double *const *in)
{
    return (struct bulla_shear){.c_s = in[FACE_SHEAR], .s = in + FACE_SHEAR + 1};
}

/* Is output row k one that the shape has? */
static bool contract_face_used(const struct contract_shape *shape, unsigned k)
{
    unsigned tangents = shape->solid ? shape->n_velocity - 1 : 0, slide = (k - FACE_SLIDE) % (CONTRACT_FACE_AXES - 1);
    if (k >= FACE_SLIDE) return slide < tangents;
    return k < shape->n_material || (k >= FACE_MOMENTUM && k < FACE_MOMENTUM + shape->n_velocity) ||
           (k >= FACE_ENERGY && k < FACE_FRACTION + contract_face_n_alpha(shape));
}

static void contract_face_run(const struct contract *contract, const struct contract_call *call, size_t n,
                              const double *const *in, double *const *out)
{
    static double work[4][FACE_ROW];
    const struct contract_shape *shape = call->context;
    const struct bulla_riemann *riemann = contract->module->table;
    struct bulla_faces faces = {.n = n,
                                .n_material = shape->n_material,
                                .n_alpha = contract_face_n_alpha(shape),
                                .n_velocity = shape->n_velocity,
                                .left = contract_face_side(in),
                                .right = contract_face_side(in + FACE_SIDE),
                                .flux = {.m = out,
                                         .momentum = out + FACE_MOMENTUM,
                                         .rho_E = out[FACE_ENERGY],
                                         .u = out[FACE_ENERGY + 1],
                                         .alpha = out + FACE_FRACTION},
                                .work = {work[0], work[1], work[2], work[3]},
                                .mixed = shape->mixed || shape->n_material > 1};
    if (shape->solid) {
        faces.solid = 1;
        faces.shear_left = contract_face_shear(in);
        faces.shear_right = contract_face_shear(in + FACE_SIDE);
        faces.slide_left = out + FACE_SLIDE;
        faces.slide_right = out + FACE_SLIDE + CONTRACT_FACE_AXES - 1;
    }
    for (unsigned k = 0; k < FACE_FLUX; k++)
        if (!contract_face_used(shape, k)) memset(out[k], 0, n * sizeof *out[k]);
    riemann->solve(contract->self, &faces);
}

static void contract_face_draw_row(const struct contract *contract, const struct contract_call *call, uint64_t *seed,
                                   double *in)
{
    (void)contract;
    struct contract_face face = contract_face_draw(seed, *(const struct contract_shape *)call->context, 2.0);
    memcpy(in, &face.left, sizeof face.left);
    memcpy(in + FACE_SIDE, &face.right, sizeof face.right);
}

struct contract_call contract_face_call(const struct contract_shape *shape)
{
    return (struct contract_call){"solve", 2 * FACE_SIDE, FACE_FLUX, contract_face_run, contract_face_draw_row, shape};
}

struct contract_flux contract_face_solve(const struct contract *contract, const struct contract_face *face)
{
    struct contract_call call = contract_face_call(&face->shape);
    double in[2 * FACE_SIDE], out[FACE_FLUX] = {0};
    memcpy(in, &face->left, sizeof face->left);
    memcpy(in + FACE_SIDE, &face->right, sizeof face->right);
    contract_batch_one(contract, &call, in, out);
    struct contract_flux flux;
    memcpy(&flux, out, sizeof flux);
    return flux;
}

struct contract_flux contract_face_physical(const struct contract_shape *shape, const struct contract_side *side)
{
    double u = side->u[0];
    struct contract_flux flux = {.rho_E = u * (side->rho_E + side->p), .u = u};
    for (unsigned l = 0; l < shape->n_material; l++) flux.m[l] = side->m[l] * u;
    for (unsigned k = 0; k < shape->n_velocity; k++) flux.momentum[k] = side->rho * u * side->u[k];
    flux.momentum[0] += side->p;
    for (unsigned l = 0; l < contract_face_n_alpha(shape); l++) flux.alpha[l] = side->alpha[l];
    for (unsigned k = 1; shape->solid && k < shape->n_velocity; k++) {
        flux.momentum[k] -= side->s[k - 1];
        flux.rho_E -= side->s[k - 1] * side->u[k];
        flux.slide_left[k - 1] = flux.slide_right[k - 1] = side->u[k];
    }
    return flux;
}

struct contract_flux contract_face_scale(const struct contract_face *face)
{
    const struct contract_side *l = &face->left, *r = &face->right;
    double S = contract_face_most(fabs(l->u[0]) + l->c, fabs(r->u[0]) + r->c), rho = contract_face_most(l->rho, r->rho),
           most = 0.0;
    double p = contract_face_most(l->p, r->p);
    for (int k = 0; k < CONTRACT_FACE_AXES; k++)
        most = contract_face_most(most, contract_face_most(fabs(l->u[k]), fabs(r->u[k])));
    struct contract_flux scale = {.u = S, .rho_E = S * (contract_face_most(l->rho_E, r->rho_E) + p + rho * S * S)};
    for (unsigned k = 0; k < CONTRACT_FACE_AXES; k++) scale.momentum[k] = rho * S * (S + most) + p;
    for (unsigned i = 0; i < CONTRACT_FACE_MATERIALS; i++) {
        scale.m[i] = 10.0 * S * contract_face_most(l->m[i], r->m[i]) + 1e-300;
        scale.alpha[i] = 1.0;
    }
    for (unsigned k = 0; k + 1 < CONTRACT_FACE_AXES; k++) /* a traction moves a surface by s/(rho c_s) */
        scale.slide_left[k] = scale.slide_right[k] = S + most;
    return scale;
}

void contract_face_where(const struct contract_face *face, char where[static CONTRACT_NAME])
{
    snprintf(where, CONTRACT_NAME, "materials %u, velocities %u, Mach %.3g and %.3g", face->shape.n_material,
             face->shape.n_velocity, face->left.u[0] / face->left.c, face->right.u[0] / face->right.c);
}
