/* equilibrium.h - thermal and chemical equilibrium of a liquid, its vapour and inert gases in cells: pT and pTmu.
 *
 * One family of materials (liquid, vapour, gases) of a cell comes to one pressure and one temperature, and liquid and
 * vapour exchange mass until mu_v = g_l, at the volume, masses and energy of the cell; g = h - T s of `thermal`
 * (eos.h). All other materials o of the cell keep their heat: they do work against the new pressure, e_o + p v_o = e_o0
 * + p v_o0 (squeeze.h). In a unit volume sum m v(p, T) + sum m_o v_o(p) = 1,     sum m h(p, T) = E + p - sum m_o (e_o0
 * + p v_o0),     D = mu_v - g_l = 0, with mu_v = g_v + R_v T ln x_v, x_v = m_v R_v/sum m R over vapour and gases:
 * Dalton's partial pressure, written as the entropy of mixing that one common pressure leaves out. For stable laws D
 * grows with m_v, so there is one root, or the end to which D points: all vapour (D(M) <= 0) or all liquid (D(0) >= 0).
 *
 * Gases that keep their heat (apart) are among the others, and lower the vapour's mole fraction all the same.
 *
 * With surface tension (jumps) p is that of the vapour and the liquid has p + jump; E comes with jump alpha_l added.
 * A solid that shares its traction with them is another material, of pressure p + s'_nn (squeeze_solid()).
 *
 * Cells iterate together (Newton's method in p, T and m_v); what does not converge is bracketed and bisected alone
 * (equilibrium_search.h), so an answer is always found where there is one, and no cell's bits depend on another
 * cell. */
#ifndef EQUILIBRIUM_H
#define EQUILIBRIUM_H

#include "phys/model.h"

enum { EQUILIBRIUM_BLOCK = 32, EQUILIBRIUM_LIQUID = 0, EQUILIBRIUM_VAPOUR = 1, EQUILIBRIUM_GAS = 2 };

/* A phase with less than this share of both masses is taken to be gone by who uses the answer. */
#define EQUILIBRIUM_NOTHING 1e-12

/* Who shares a temperature. */
struct equilibrium_family {
    unsigned n;                            /* liquid, vapour, then gases: at least 2 */
    struct model_eos eos[SCENE_MATERIALS]; /* each law offers `thermal` */
    double R[SCENE_MATERIALS];             /* gas constants [J/(kg K)]; of the liquid 0 */
    bool exchange;                         /* mass is exchanged (pTmu); else pT alone */
    bool mixing;                           /* gases lower the vapour's pressure (Dalton) */
};

/* What became of a cell. */
enum equilibrium_regime { EQUILIBRIUM_NONE, EQUILIBRIUM_TWO_PHASE, EQUILIBRIUM_ALL_VAPOUR, EQUILIBRIUM_ALL_LIQUID };

/* n <= EQUILIBRIUM_BLOCK cells of unit volume. In: masses m of the family [kg/m3], m_o, v0 and e0 of n_other others,
 * energy E [J/m3], and p, T and specific volumes v (or 0) to start from. Out: p, T, masses of liquid and vapour (their
 * sum is kept to round-off), specific volumes of all, regime. EQUILIBRIUM_NONE: no state of these masses has so little
 * energy; numbers of that cell mean nothing. */
struct equilibrium_cells {
    size_t n;
    double m[SCENE_MATERIALS][EQUILIBRIUM_BLOCK], v[SCENE_MATERIALS][EQUILIBRIUM_BLOCK];
    unsigned n_other;
    struct model_eos other[SCENE_MATERIALS];
    double m_other[SCENE_MATERIALS][EQUILIBRIUM_BLOCK], v0[SCENE_MATERIALS][EQUILIBRIUM_BLOCK],
        e0[SCENE_MATERIALS][EQUILIBRIUM_BLOCK], v_other[SCENE_MATERIALS][EQUILIBRIUM_BLOCK];
    bool jumps; /* the liquid has p + jump, energy is without what surfaces have stored at the start; and solids among
                   the others have p + s'_nn, `own` at v0 */
    double jump[EQUILIBRIUM_BLOCK], own[SCENE_MATERIALS][EQUILIBRIUM_BLOCK];
    bool apart; /* gases with a heat of their own are among the others, but the vapour is mixed with them */
    double moles[EQUILIBRIUM_BLOCK]; /* sum m R of these [J/(m3 K)] */
    double energy[EQUILIBRIUM_BLOCK], p[EQUILIBRIUM_BLOCK], T[EQUILIBRIUM_BLOCK];
    unsigned char regime[EQUILIBRIUM_BLOCK];
};

/* What that took. */
struct equilibrium_effort {
    long long cells, steps; /* cells solved; Newton steps of all of them */
    long long searched;     /* cells that went to the bracketed search */
    long long refused;      /* of these, without a state */
};

void equilibrium_solve(const struct equilibrium_family *family, struct equilibrium_cells *cells,
                       struct equilibrium_effort *effort);

#endif
