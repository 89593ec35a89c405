/* contract_boundary.c - see contract_boundary.h. States of two materials that move in space are drawn from traces of
 * vapour to shocked metal. What a boundary says of itself decides what it must keep: core skips work by it. */
#include "suite/contract_boundary.h"

#include "bulla/boundary.h"
#include "suite/contract_batch.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

enum { BOUNDARY_STATES = 3000, BOUNDARY_MATERIALS = 2, BOUNDARY_AXES = 3 };

/* Rows of a face: what is behind comes first, inside and out. */
enum {
    BOUNDARY_ALPHA,
    BOUNDARY_RHO = BOUNDARY_ALPHA + BOUNDARY_MATERIALS,
    BOUNDARY_U = BOUNDARY_RHO + BOUNDARY_MATERIALS,
    BOUNDARY_P = BOUNDARY_U + BOUNDARY_AXES,
    BOUNDARY_OUT,
    BOUNDARY_Z = BOUNDARY_OUT,
    BOUNDARY_P_START,
    BOUNDARY_U_START,
    BOUNDARY_X,
    BOUNDARY_IN = BOUNDARY_X + BOUNDARY_AXES
};

#define BOUNDARY_ROUND 1e-12 /* of a pressure, relative */
#define BOUNDARY_WAVE 0.01   /* [Pa] of the wave that asks what a face reflects */

/* Where and when the faces are. */
struct boundary_place {
    uint32_t axis, side;
    double t;
};

static uint32_t contract_boundary_traits(const struct contract *contract)
{
    return ((const struct bulla_boundary *)contract->module->table)->traits;
}

static void contract_boundary_call(const struct contract *contract, const struct boundary_place *place, size_t n,
                                   const double *const *in, double *const *out)
{
    const struct bulla_boundary *law = contract->module->table;
    bool refers = law->traits & BULLA_BEHIND_REFERS;
    for (int k = 0; k < BOUNDARY_OUT; k++) memcpy(out[k], in[k], n * sizeof **out);
    const struct bulla_behind faces = {.size = sizeof faces,
                                       .n_material = BOUNDARY_MATERIALS,
                                       .n_velocity = BOUNDARY_AXES,
                                       .axis = place->axis,
                                       .side = place->side,
                                       .n = n,
                                       .t = place->t,
                                       .depth = 5e-7,
                                       .x = {in[BOUNDARY_X], in[BOUNDARY_X + 1], in[BOUNDARY_X + 2]},
                                       .alpha = in + BOUNDARY_ALPHA,
                                       .rho = in + BOUNDARY_RHO,
                                       .u = in + BOUNDARY_U,
                                       .p = in[BOUNDARY_P],
                                       .Z = in[BOUNDARY_Z],
                                       .p_start = refers ? in[BOUNDARY_P_START] : NULL,
                                       .u_start = refers ? in[BOUNDARY_U_START] : NULL,
                                       .alpha_behind = out + BOUNDARY_ALPHA,
                                       .rho_behind = out + BOUNDARY_RHO,
                                       .u_behind = out + BOUNDARY_U,
                                       .p_behind = out[BOUNDARY_P]};
    law->fill(contract->self, &faces);
}

static void contract_boundary_at(const struct contract *contract, const struct boundary_place *place,
                                 const double in[static BOUNDARY_IN], double out[static BOUNDARY_OUT])
{
    const double *rows[BOUNDARY_IN];
    double *results[BOUNDARY_OUT];
    for (int k = 0; k < BOUNDARY_IN; k++) rows[k] = &in[k];
    for (int k = 0; k < BOUNDARY_OUT; k++) results[k] = &out[k];
    contract_boundary_call(contract, place, 1, rows, results);
}

static void contract_boundary_draw(const struct contract *contract, const struct contract_call *call, uint64_t *seed,
                                   double *in)
{
    double a = contract_random(seed, -0.3, 1.3), c = contract_decades(seed, 10.0, 1e4);
    (void)contract, (void)call;
    a = a < 0.0 ? 0.0 : a > 1.0 ? 1.0 : a;
    in[BOUNDARY_ALPHA] = a;
    in[BOUNDARY_ALPHA + 1] = 1.0 - a;
    for (int l = 0; l < BOUNDARY_MATERIALS; l++) in[BOUNDARY_RHO + l] = contract_decades(seed, 1e-3, 2e4);
    for (int d = 0; d < BOUNDARY_AXES; d++) in[BOUNDARY_U + d] = contract_random(seed, -2e3, 2e3);
    in[BOUNDARY_P] = contract_decades(seed, 1e2, 1e10);
    in[BOUNDARY_Z] = c * (a * in[BOUNDARY_RHO] + (1.0 - a) * in[BOUNDARY_RHO + 1]);
    in[BOUNDARY_P_START] = contract_decades(seed, 1e3, 1e8);
    in[BOUNDARY_U_START] = contract_random(seed, -10.0, 10.0);
    for (int d = 0; d < BOUNDARY_AXES; d++) in[BOUNDARY_X + d] = contract_random(seed, -1.0, 1.0);
}

static void contract_boundary_say(const double in[static BOUNDARY_IN], char where[static CONTRACT_WHERE])
{
    snprintf(where, CONTRACT_WHERE, "alpha %.4g, rho %.4g %.4g, u %.4g, p %.6g, Z %.4g, at the start p %.6g, u %.4g",
             in[BOUNDARY_ALPHA], in[BOUNDARY_RHO], in[BOUNDARY_RHO + 1], in[BOUNDARY_U], in[BOUNDARY_P], in[BOUNDARY_Z],
             in[BOUNDARY_P_START], in[BOUNDARY_U_START]);
}

/* How far what is behind is from what is inside: pressures and fractions relative, velocities as the pressure that
 * stops them. */
static double contract_boundary_change(const double in[static BOUNDARY_IN], const double out[static BOUNDARY_OUT])
{
    double worst = fabs(out[BOUNDARY_P] - in[BOUNDARY_P]) / in[BOUNDARY_P];
    for (int l = 0; l < BOUNDARY_MATERIALS; l++) {
        double rho = fabs(out[BOUNDARY_RHO + l] / in[BOUNDARY_RHO + l] - 1.0);
        double alpha = fabs(out[BOUNDARY_ALPHA + l] - in[BOUNDARY_ALPHA + l]);
        worst = fmax(worst, fmax(rho, alpha));
    }
    for (int d = 0; d < BOUNDARY_AXES; d++) {
        double u = in[BOUNDARY_U + d], scale = in[BOUNDARY_P] / in[BOUNDARY_Z] + fabs(u);
        worst = fmax(worst, fabs(out[BOUNDARY_U + d] - u) / scale);
    }
    return isfinite(out[BOUNDARY_P]) ? worst : (double)NAN;
}

/* A state that core can go on with. */
static void contract_boundary_state(struct contract *contract, const double out[static BOUNDARY_OUT], const char *where)
{
    double sum = 0.0, one = out[BOUNDARY_ALPHA], other = out[BOUNDARY_ALPHA + 1];
    for (int k = 0; k < BOUNDARY_OUT; k++) sum += out[k];
    contract_begin(contract, "finite behind any state", 0.0);
    contract_holds(contract, isfinite(sum), where);
    contract_begin(contract, "fractions from 0 to 1 with sum 1", 1e-14);
    contract_error(contract, one >= 0.0 && other >= 0.0 ? fabs(one + other - 1.0) : (double)NAN, "%s: %.9g, %.9g",
                   where, one, other);
    contract_begin(contract, "densities above 0", 0.0);
    contract_holds(contract, out[BOUNDARY_RHO] > 0.0 && out[BOUNDARY_RHO + 1] > 0.0, where);
}

/* Without a trait what it would allow does not happen. */
static void contract_boundary_keeps(struct contract *contract, const double in[static BOUNDARY_IN],
                                    const double out[static BOUNDARY_OUT], const char *where)
{
    uint32_t traits = contract_boundary_traits(contract);
    contract_begin(contract, "without BRINGS: fractions as inside, bitwise", 0.0);
    for (int l = 0; l < BOUNDARY_MATERIALS && !(traits & BULLA_BEHIND_BRINGS); l++)
        contract_holds(contract, contract_same(out[BOUNDARY_ALPHA + l], in[BOUNDARY_ALPHA + l]), where);
    contract_begin(contract, "with ISENTROPIC: densities are left alone, bitwise", 0.0);
    for (int l = 0; l < BOUNDARY_MATERIALS && traits & BULLA_BEHIND_ISENTROPIC; l++)
        contract_holds(contract, contract_same(out[BOUNDARY_RHO + l], in[BOUNDARY_RHO + l]), where);
}

/* Rest at any pressure, and the state that nothing has disturbed. A mirror has no other rest than u = 0. */
static void contract_boundary_rest(struct contract *contract, const struct boundary_place *place,
                                   double in[static BOUNDARY_IN])
{
    uint32_t traits = contract_boundary_traits(contract);
    double out[BOUNDARY_OUT];
    char where[CONTRACT_WHERE];
    bool still = traits & BULLA_BEHIND_MIRRORS || !(traits & BULLA_BEHIND_REFERS);
    if (still) in[BOUNDARY_U_START] = 0.0;
    in[BOUNDARY_U] = in[BOUNDARY_U_START];
    for (int d = still ? 0 : 1; d < BOUNDARY_AXES; d++) in[BOUNDARY_U + d] = 0.0;
    contract_boundary_say(in, where);
    contract_boundary_at(contract, place, in, out);
    contract_begin(contract, "with RESTS: what rests is the same behind, whatever its pressure", 0.0);
    for (int k = 0; k < BOUNDARY_OUT && traits & BULLA_BEHIND_RESTS; k++)
        contract_holds(contract, out[k] == in[k], where);
    in[BOUNDARY_P] = in[BOUNDARY_P_START];
    contract_boundary_say(in, where);
    contract_boundary_at(contract, place, in, out);
    contract_begin(contract, "without DRIVES: what nothing has disturbed stays", BOUNDARY_ROUND);
    if (!(traits & BULLA_BEHIND_DRIVES)) contract_error(contract, contract_boundary_change(in, out), "%s", where);
}

/* A state that is none must not come out as a good one, unless all of it is given. */
static void contract_boundary_nan(struct contract *contract, const struct boundary_place *place)
{
    double in[BOUNDARY_IN], out[BOUNDARY_OUT];
    uint64_t seed = 5;
    contract_boundary_draw(contract, NULL, &seed, in);
    in[BOUNDARY_P] = (double)NAN;
    contract_boundary_at(contract, place, in, out);
    contract_begin(contract, "without DRIVES: p = NaN does not become a good state", 0.0);
    if (!(contract_boundary_traits(contract) & BULLA_BEHIND_DRIVES))
        contract_error(contract, isfinite(out[BOUNDARY_P]), "p = NaN: %g", out[BOUNDARY_P]);
}

/* The pressure between water that brings a wave of pressure `wave` and what is behind, by the acoustic Riemann
 * problem. */
static double contract_boundary_face(const struct contract *contract, const struct boundary_place *place, double wave)
{
    const double Z = 1.5e6, p = 1e5;
    double in[BOUNDARY_IN] = {0}, out[BOUNDARY_OUT];
    in[BOUNDARY_ALPHA] = 1.0;
    in[BOUNDARY_RHO] = in[BOUNDARY_RHO + 1] = 1000.0;
    in[BOUNDARY_P] = p + wave;
    in[BOUNDARY_U] = wave / Z;
    in[BOUNDARY_Z] = Z;
    in[BOUNDARY_P_START] = p;
    contract_boundary_at(contract, place, in, out);
    return 0.5 * (in[BOUNDARY_P] + out[BOUNDARY_P] + Z * (in[BOUNDARY_U] - out[BOUNDARY_U]));
}

/* What the face reflects of a weak wave: it raises the pressure there by 1 + R of its own. */
static double contract_boundary_reflection(const struct contract *contract, const struct boundary_place *place)
{
    double calm = contract_boundary_face(contract, place, 0.0);
    return (contract_boundary_face(contract, place, BOUNDARY_WAVE) - calm) / BOUNDARY_WAVE - 1.0;
}

static void contract_boundary_facts(struct contract *contract)
{
    const struct boundary_place place = {0, 1, 1e-6}, opposite = {0, 0, 1e-6}, later = {0, 1, 1e-3};
    double in[BOUNDARY_IN], one[BOUNDARY_OUT], other[BOUNDARY_OUT];
    uint64_t seed = 9;
    contract_boundary_draw(contract, NULL, &seed, in);
    contract_boundary_at(contract, &place, in, one);
    contract_boundary_at(contract, &later, in, other);
    contract_fact(contract, "the same at any time", memcmp(one, other, sizeof one) == 0);
    contract_boundary_at(contract, &opposite, in, other);
    contract_fact(contract, "the same at both ends of an axis", memcmp(one, other, sizeof one) == 0);
    double R = contract_boundary_reflection(contract, &place);
    contract_fact(contract, "weak waves in water leave (|R| < 0.01)", fabs(R) < 0.01);
    contract_fact(contract, "weak waves in water come back as from a rigid wall (R > 0.99)", R > 0.99);
}

static void contract_boundary_run_row(const struct contract *contract, const struct contract_call *call, size_t n,
                                      const double *const *in, double *const *out)
{
    contract_boundary_call(contract, call->context, n, in, out);
}

void contract_boundary_run(struct contract *contract)
{
    const struct boundary_place place = {0, 1, 1e-6};
    const struct contract_call fill = {
        "fill", BOUNDARY_IN, BOUNDARY_OUT, contract_boundary_run_row, contract_boundary_draw, &place};
    uint64_t seed = 17;
    contract_doing(contract, "states");
    for (int i = 0; i < BOUNDARY_STATES; i++) {
        const struct boundary_place there = {(uint32_t)i % 3, (uint32_t)i % 2, i * 1e-8};
        double in[BOUNDARY_IN], out[BOUNDARY_OUT];
        char where[CONTRACT_WHERE];
        contract_boundary_draw(contract, NULL, &seed, in);
        contract_boundary_say(in, where);
        contract_boundary_at(contract, &there, in, out);
        contract_boundary_state(contract, out, where);
        contract_boundary_keeps(contract, in, out, where);
        contract_boundary_rest(contract, &there, in);
    }
    contract_doing(contract, "NaN");
    contract_boundary_nan(contract, &place);
    contract_boundary_facts(contract);
    contract_batch_run(contract, &fill);
}

void contract_boundary_probe(const struct contract *contract, double out[static CONTRACT_PROBE])
{
    const struct boundary_place place = {0, 1, 1e-6};
    double in[BOUNDARY_IN], behind[BOUNDARY_OUT];
    uint64_t seed = 3;
    contract_boundary_draw(contract, NULL, &seed, in);
    contract_boundary_at(contract, &place, in, behind);
    out[0] = behind[BOUNDARY_P];
    out[1] = behind[BOUNDARY_U];
    out[2] = behind[BOUNDARY_RHO];
}
