/* equilibrium_point.h - one cell at one p and one T with given masses of liquid and vapour: what the search bisects
 * over. */
#ifndef EQUILIBRIUM_POINT_H
#define EQUILIBRIUM_POINT_H

#include "phys/equilibrium.h"

struct equilibrium_point {
    const struct equilibrium_family *family;
    double m[SCENE_MATERIALS]; /* of the family */
    double energy;             /* less e0 of the others [J/m3] */
    unsigned n_other;
    const struct model_eos *other;
    double m_other[SCENE_MATERIALS], v0[SCENE_MATERIALS], e0[SCENE_MATERIALS];
    double jump;                                         /* p of the liquid over that of the others [Pa] */
    double own[SCENE_MATERIALS];                         /* s'_nn of the others at v0 [Pa] */
    double moles;                                        /* sum m R of gases among the others [J/(m3 K)] */
    double p, T;                                         /* start and answer */
    double v[SCENE_MATERIALS], v_other[SCENE_MATERIALS]; /* answers */
    double h[SCENE_MATERIALS], s[SCENE_MATERIALS], v_T[SCENE_MATERIALS], v_p[SCENE_MATERIALS], c_p[SCENE_MATERIALS];
    double volume, volume_p, volume_T, heat, heat_p, heat_T; /* residuals of volume and enthalpy, and their slopes */
};

/* Cell i of a block, at its masses and guesses. */
void equilibrium_point_take(const struct equilibrium_family *family, const struct equilibrium_cells *cells, size_t i,
                            struct equilibrium_point *ret_point);

/* p, T and the volumes for the masses that the point has now, by Newton's method in a bracket. False: there is no such
 * state (too little energy). Masses may be 0. */
bool equilibrium_point_solve(struct equilibrium_point *point);

/* D = mu_v - g_l [J/kg] at a solved point; -inf for a vapour of no mass among gases, for a stretched liquid (p <= 0),
 * or where there is no liquid; +inf where the vapour has no state. */
double equilibrium_point_drive(const struct equilibrium_point *point);

/* Mole fraction of the vapour in vapour and gases; 1 without mixing. */
double equilibrium_point_share(const struct equilibrium_point *point);

#endif
