/* elastic.h - solids on batches of points: energy, stress, wave speeds, and the motion of the stretch.
 *
 * V is the symmetric unimodular left stretch, B = V V the left Cauchy-Green tensor (model.md 3). Blocks of V have
 * n_stretch components in the order of ELASTIC_XX ...: component c at V + c * stride. m: [n_solid] rows of partial
 * densities alpha_l rho_l of the solids of the model. Batches of any length. A fluid has m = 0, hence no elastic part
 * at all, bitwise.
 *
 * Every solid has a stretch of its own, and so has every Maxwell branch (model_stretch()): V is where the fields of
 * stretches begin, and energy, stress and speeds add up. */
#ifndef ELASTIC_H
#define ELASTIC_H

#include "phys/model.h"

#include <stddef.h>

enum elastic_index { ELASTIC_XX, ELASTIC_YY, ELASTIC_ZZ, ELASTIC_XY, ELASTIC_XZ, ELASTIC_YZ };

/* Position of component (i, j) of a symmetric tensor in a block. */
static inline unsigned elastic_component(unsigned i, unsigned j)
{
    return i == j ? i : i + j + 2;
}

/* Elastic energy per volume, sum over solids of m_l e_l^s [J/m3]. */
void elastic_energy(const struct model *model, size_t n, size_t stride, const double *V, const double *const *m,
                    double *restrict rho_es);

/* Deviatoric stress s' [Pa], a block of n_stretch rows with the same stride; s = -p I + s'. */
void elastic_stress(const struct model *model, size_t n, size_t stride, const double *V, const double *const *m,
                    double *s);

/* Invariants I1, I2 of B of one stretch, whose block V is. */
void elastic_invariants(const struct model *model, size_t n, size_t stride, const double *V, double *restrict I1,
                        double *restrict I2);

/* Has stretch k a constant G1 and no G2? */
bool elastic_is_plain(const struct model *model, unsigned k);

/* I1 alone, which is all that plain laws ask for. */
void elastic_invariants_first(const struct model *model, size_t n, size_t stride, const double *V, double *restrict I1);

/* What a face normal to `axis` needs of one side; rows of n doubles. */
struct elastic_side {
    double *energy;   /* rho e^s [J/m3] */
    double *normal;   /* s'_nn [Pa] */
    double *shear[2]; /* s_nt along tangents 1 and 2 in the order of axis_component [Pa]; n_velocity - 1 of them */
    double *stiff;    /* rho (c^2 - c_f^2): what elasticity adds to the stiffness of the fastest wave [Pa] */
    double *rigid;    /* rho c_s^2 [Pa] */
};

/* Diagonal and fastest eigenvalue of the acoustic tensor (model.md 3): rho c_f^2 in `stiffness`. */
void elastic_sides(const struct model *model, int axis, size_t n, size_t stride, const double *V,
                   const double *const *m, const double *stiffness, const struct elastic_side *ret);

/* What balances the hoop stress of a cell in curved geometry (model.md 4): -s_thth = p - s'_zz [Pa]; exactly p in a
 * fluid. */
void elastic_hoop(const struct model *model, size_t n, size_t stride, const double *V, const double *const *m,
                  const double *p, double *ret);

/* A bound of c^2 of the fastest wave along any axis from the frozen c_f^2, in place, exact where there is no stretch;
 * rho: mixture density. */
void elastic_speed2(const struct model *model, size_t n, size_t stride, const double *V, const double *const *m,
                    const double *rho, double *c2);

/* What moves the stretch of n cells in a step dt: `carried`, the block -div(V* F) with F the mass flux of all solids;
 * m_old, m_new: their partial densities together before and after, m_new = m_old - dt div F; `div`, -div u*;
 * `gradient`, [n_velocity * dim] rows of -d_k u*_i at i * dim + k; all with the same stride. */
struct elastic_rates {
    const double *carried, *m_old, *m_new, *div, *gradient;
    const double *squeeze, *slope; /* in mixtures (else NULL): -(K_s/alpha_s) div u of the solids, and the block [dim]
                                      of -d_k alpha_s, of which only the direction n matters */
    double relaxes; /* relaxation times (flow_relax.h) that the stretch of a branch spends in the middle of the step */
};

/* V_new from V_old after dt (model.md 2): half of the deformation, the transport, the other half,
 *     V' = W + [-dt div(V* F) - W (m_new - m_old)]/m_new,  W = polar(E V_old),  V_new = polar(E V'),  E = (1 - dt
 * L/4)^-1 (1 + dt L/4), polar(M) = (M M^T)^(1/2). The stretch travels with the mass of the solids, so that what a fluid
 * brings along never mixes into it. In a mixed cell L is the solid's own: L + (K_s/alpha_s) div u n n^T. Along an
 * interface all materials move together, across it each is compressed as its stiffness says (the closure's K), and what
 * the gas gives way by is no strain of the solid: without this the layer next to a bubble would be stretched too little
 * (docs/decisions/solid-gradient.md). The Cayley form turns a rigid rotation into an exact one. det V = 1 is left to
 * elastic_unimodular, which also stands for the trace of L. V_new and V_old may not overlap. A branch relaxes between
 * the transport and the other half, by rates->relaxes. */
void elastic_advance(const struct model *model, size_t n, size_t stride, double dt, const double *V_old,
                     const struct elastic_rates *rates, double *V_new);

/* det V = 1 by scaling, in place; NaN where det V <= 0: no stretch any more, which the guard will see. */
void elastic_unimodular(const struct model *model, size_t n, size_t stride, double *V);

/* Sum over the solids of a block that has one row per material of the model, such as fractions or partial densities. */
void elastic_sum(const struct model *model, size_t n, size_t stride, const double *block, double *restrict sum);

/* The row of the solid that carries stretch k (model_carries()), n values in such a block; where nothing bears it
 * `room`, made 0. */
const double *elastic_carrier(const struct model *model, unsigned k, size_t n, size_t stride, const double *block,
                              double *room);

/* V = 1: a stretch that nothing carries, or one that nothing has stretched yet. */
void elastic_identity(const struct model *model, size_t n, size_t stride, double *V);

/* The block of stretch k in the fields of stretches that begin at V. */
static inline size_t elastic_block(const struct model *model, unsigned k, size_t stride)
{
    return (model_stretch(model, k) - model->i_V) * stride;
}

/* Bounds the stretch where there is little solid: |V - 1| <= (phi/ELASTIC_FADE)^2, phi = alpha the fraction of all
 * solids; the identity where there is none. Idempotent, so a step more or less does not matter; total energy is not
 * touched, so that the elastic energy lost becomes heat. Call before elastic_unimodular. */
void elastic_fade(const struct model *model, size_t n, size_t stride, const double *alpha, double *V);

#define ELASTIC_FADE 1e-4

/* Mass of solids per volume that counts as none [kg/m3]: round-off of a surface at rest leaves 1e-320 behind, by which
 * nothing can be divided. */
#define ELASTIC_NOTHING 1e-280

/* The stretches of n points whose fields (conserved or primitive) were averaged or interpolated: faded, then det 1.
 * What this would change by round-off alone keeps its bits, so that a uniform stretch stays uniform. */
void elastic_settle(const struct model *model, size_t n, size_t stride, double *fields);

/* What refluxing adds to V of one cell at a face normal to `axis`. delta: fine - coarse, sum of dt times face value; s:
 * -1 for the cell on the lower side of the face, else 1. */
struct elastic_correction {
    const double *V;        /* [n_stretch] of the cell at the midpoint */
    const double *carried;  /* [n_stretch] s A/V delta(V* F)/m_s: change asked for by the transport */
    double arrived;         /* s A/V delta(F)/m_s: solid mass that comes in, as a share of what there is */
    double swept;           /* s A/V delta(u*): what -div u changes by */
    const double *velocity; /* [n_velocity] -s/h delta(u_i): what d_axis u_i changes by, as the cell sees the face */
    int axis;
};

/* dV = carried - V arrived + what the change of the velocity gradient stretches V by; exactly 0 if nothing changes. */
void elastic_correct(const struct model *model, const struct elastic_correction *in, double *ret_dV);

#endif
