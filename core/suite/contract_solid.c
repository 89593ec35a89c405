/* contract_solid.c - see contract_solid.h.
 *
 * With nothing moving through the face what is left of HLLD are two shear waves (model.md 5, Barton 2019):
 *     s** = (Z_L s_R + Z_R s_L + Z_L Z_R (u_R - u_L))/(Z_L + Z_R),  u** = (Z_L u_L + Z_R u_R + s_R - s_L)/(Z_L + Z_R).
 * Z = rho c_s keeps them sharp. A solver that does not know them may take any Z up to that of its fastest signal, which
 * smears them, and still joins solids and lets fluids slip. */
#include "suite/contract_solid.h"

#include <math.h>
#include <string.h>

/* Where both sides are fluids a scene with solids gives the bits of one without. */
static void contract_solid_fluids(struct contract *contract, struct contract_face face)
{
    struct contract_side *sides[2] = {&face.left, &face.right};
    for (int i = 0; i < 2; i++) {
        sides[i]->c_s = 0.0;
        memset(sides[i]->s, 0, sizeof sides[i]->s);
    }
    struct contract_face plain = face;
    plain.shape.solid = false;
    struct contract_flux got = contract_face_solve(contract, &face), want = contract_face_solve(contract, &plain);
    memcpy(want.slide_left, got.slide_left, sizeof got.slide_left); /* fluids have no stretch that would ask */
    memcpy(want.slide_right, got.slide_right, sizeof got.slide_right);
    char where[CONTRACT_NAME];
    contract_face_where(&face, where);
    contract_begin(contract, "two fluids: as in a scene without solids, bitwise", 0.0);
    contract_holds(contract, memcmp(&got, &want, sizeof got) == 0, where);
}

/* Nothing moves through the face: what is left is shear. */
static void contract_solid_still(struct contract_face *face)
{
    struct contract_side *sides[2] = {&face->left, &face->right};
    for (int i = 0; i < 2; i++) {
        double u = sides[i]->u[0];
        sides[i]->rho_E -= 0.5 * sides[i]->rho * u * u;
        sides[i]->u[0] = 0.0;
        sides[i]->p = face->left.p;
    }
}

/* A traction s that changes a velocity by du: how far du lies beyond what the impedances of the shear wave and of the
 * fastest signal give, on the scale of the velocities that it was computed from. */
static double contract_solid_beyond(const struct contract_face *face, const struct contract_side *side, double s,
                                    double du)
{
    double fastest = face->left.c > face->right.c ? face->left.c : face->right.c, size = fabs(s), most = fabs(du);
    double least_du = size / (side->rho * fastest), most_du = size / (side->rho * side->c_s);
    for (unsigned k = 1; k < face->shape.n_velocity; k++)
        most = fmax(most, fmax(fabs(face->left.u[k]), fabs(face->right.u[k])));
    double along = s < 0.0 ? -du : du, beyond = fmax(least_du - along, along - most_du);
    return beyond > 0.0 ? beyond / most : 0.0;
}

/* A solid on itself, moving apart along the face at the speeds -+v: s** = s + Z v with an impedance Z of the solver's
 * choice; then at one speed with opposed tractions: u** = v - s/Z. No work goes through in either. */
static double contract_solid_welded(struct contract *contract, struct contract_face face)
{
    struct contract_side *l = &face.left, *r = &face.right;
    double v = 0.1 * l->c_s;
    char where[CONTRACT_NAME];
    contract_solid_still(&face);
    for (unsigned k = 1; k < face.shape.n_velocity; k++) {
        l->rho_E += 0.5 * l->rho * (v * v - l->u[k] * l->u[k]);
        l->u[k] = -v;
    }
    *r = *l;
    for (unsigned k = 1; k < face.shape.n_velocity; k++) r->u[k] = v;
    struct contract_flux apart = contract_face_solve(contract, &face), scale = contract_face_scale(&face);
    *l = *r;
    for (unsigned k = 0; k + 1 < CONTRACT_FACE_AXES; k++) r->s[k] = -l->s[k];
    struct contract_flux torn = contract_face_solve(contract, &face);
    contract_face_where(&face, where);
    contract_begin(contract, "welded solids share traction and velocity, of an impedance from rho c_s to rho c", 1e-12);
    double impedance = -(apart.momentum[1] + l->s[0]) / v;
    for (unsigned k = 1; k < face.shape.n_velocity; k++) {
        double s = l->s[k - 1], slide = torn.slide_left[k - 1];
        contract_error(contract, contract_solid_beyond(&face, l, -(apart.momentum[k] + s), v), "%s, moving apart",
                       where);
        contract_error(contract, contract_solid_beyond(&face, l, s, v - slide), "%s, opposed tractions", where);
        contract_error(contract, slide != torn.slide_right[k - 1], "%s: the sides slip", where);
        contract_near(contract, torn.momentum[k], 0.0, scale.momentum[k], where);
    }
    contract_near(contract, apart.rho_E, 0.0, scale.rho_E, where);
    contract_near(contract, torn.rho_E, 0.0, scale.rho_E, where);
    contract_fact(contract, "keeps shear waves of solids sharp", fabs(impedance / (l->rho * l->c_s) - 1.0) <= 1e-9);
    return impedance / (l->rho * l->c_s) - 1.0;
}

/* Two different solids: a solver that keeps shear waves sharp gives the state between them (model.md 5). */
static void contract_solid_star(struct contract *contract, struct contract_face face)
{
    const struct contract_side *l = &face.left, *r = &face.right;
    contract_solid_still(&face);
    double Z_l = l->rho * l->c_s, Z_r = r->rho * r->c_s;
    struct contract_flux got = contract_face_solve(contract, &face), scale = contract_face_scale(&face);
    double work = 0.0;
    char where[CONTRACT_NAME];
    contract_face_where(&face, where);
    contract_begin(contract, "sharp shear waves: the state between them, and its work s** u**", 1e-12);
    for (unsigned k = 1; k < face.shape.n_velocity; k++) {
        double s_l = l->s[k - 1], s_r = r->s[k - 1], du = r->u[k] - l->u[k];
        double s = (Z_l * s_r + Z_r * s_l + Z_l * Z_r * du) / (Z_l + Z_r);
        double u = (Z_l * l->u[k] + Z_r * r->u[k] + s_r - s_l) / (Z_l + Z_r);
        work += s * u;
        contract_near(contract, got.momentum[k], -s, scale.momentum[k], where);
        contract_near(contract, got.slide_left[k - 1], u, scale.slide_left[k - 1], where);
        contract_near(contract, got.slide_right[k - 1], u, scale.slide_right[k - 1], where);
    }
    contract_near(contract, got.rho_E, -work, scale.rho_E, where);
}

/* A fluid on a solid: no traction, no work, the fluid goes on as it was and the solid as at a free surface. */
static void contract_solid_slip(struct contract *contract, struct contract_face face)
{
    bool left = face.left.c_s > 0.0;
    struct contract_side *solid = left ? &face.left : &face.right, *fluid = left ? &face.right : &face.left;
    contract_solid_still(&face);
    for (unsigned k = 1; k < face.shape.n_velocity; k++) {
        solid->rho_E -= 0.5 * solid->rho * solid->u[k] * solid->u[k];
        solid->u[k] = 0.0; /* what its surface gains would drown in a large one */
    }
    struct contract_flux got = contract_face_solve(contract, &face), scale = contract_face_scale(&face);
    char where[CONTRACT_NAME];
    contract_face_where(&face, where);
    contract_begin(contract, "a fluid slips on a solid: no traction, no work, a free surface", 1e-12);
    for (unsigned k = 1; k < face.shape.n_velocity; k++) {
        double own = (left ? got.slide_right : got.slide_left)[k - 1];
        double surface = (left ? got.slide_left : got.slide_right)[k - 1];
        double jump = left ? -surface : surface;
        contract_near(contract, got.momentum[k], 0.0, scale.momentum[k], where);
        contract_near(contract, own, fluid->u[k], scale.slide_left[k - 1], where);
        contract_error(contract, contract_solid_beyond(&face, solid, solid->s[k - 1], jump), "%s: free surface", where);
    }
    contract_near(contract, got.rho_E, 0.0, scale.rho_E, where);
}

void contract_solid_face(struct contract *contract, const struct contract_face *given)
{
    const struct contract_face face = *given;
    bool left = face.left.c_s > 0.0, right = face.right.c_s > 0.0;
    contract_solid_fluids(contract, face);
    if (face.shape.n_velocity < 2) return;
    if (left != right) contract_solid_slip(contract, face);
    if (!left || !right) return;
    bool sharp = fabs(contract_solid_welded(contract, face)) <= 1e-9;
    if (sharp) contract_solid_star(contract, face);
}
