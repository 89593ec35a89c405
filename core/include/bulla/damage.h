/* bulla/damage.h - functions of a module of kind "damage".
 *
 * How one solid breaks. Its damage D goes from 0, whole, to 1, broken, and never back; core degrades the elastic energy
 * of the solid by (1 - D)^2, and with it stress, strength and the speeds of waves, turns into heat what that frees, and
 * carries D along with the mass. A law is asked after each step, and says of the state of the solid aim    the damage
 * that it drives to, from 0 to 1 (below the present one: nothing happens), rate   how fast D goes there [1/s], >= 0;
 * BULLA_DAMAGE_AT_ONCE for a criterion that knows no time. Core bounds the rate by 1/time, `time` a key of the case:
 * what breaks at once would break at the mesh's whim.
 *
 * The state is that of the undamaged material, so that a law need not know how core degrades it. What `needs` does not
 * ask for comes as rows of zeros. Every call is a batch over n points: [any thread; pure; no allocation; n >= 1; arrays
 * do not overlap; unit stride; SI units]. The value at a point must not depend on its place in the row or on n.
 *
 * Well-posed means, for every state: aim finite, from 0 to 1; rate >= 0, no NaN; aim and rate x (aim > D) never fall
 * with tension, largest stress or stretch, energy, strain: what is pulled harder does not break later. An unstressed
 * solid at 300 K does not
 * break. */
#ifndef BULLA_DAMAGE_H
#define BULLA_DAMAGE_H

#include "bulla/module.h"

#ifdef __cplusplus
extern "C" {
#endif

/* A rate without a time. */
#define BULLA_DAMAGE_AT_ONCE 1e300

/* What a law looks at. */
enum bulla_damage_needs {
    BULLA_DAMAGE_TENSION = 1,       /* minus the pressure */
    BULLA_DAMAGE_PRINCIPAL = 2,     /* the largest principal stress */
    BULLA_DAMAGE_STRETCH = 4,       /* the largest principal elastic stretch */
    BULLA_DAMAGE_ENERGY = 8,        /* elastic energy */
    BULLA_DAMAGE_MISES = 16,        /* equivalent stress */
    BULLA_DAMAGE_STRAIN = 32,       /* plastic strain: of a solid with a strength that knows it */
    BULLA_DAMAGE_RATE = 64,         /* its rate: of a solid with a strength */
    BULLA_DAMAGE_TEMPERATURE = 128, /* which the equation of state must be able to give */
    BULLA_DAMAGE_ALL = 255
};

/* Rows of n. */
struct bulla_damage_state {
    uint32_t size;             /* sizeof(struct bulla_damage_state) */
    const double *damage;      /* D, from 0 to 1 */
    const double *tension;     /* -p [Pa] */
    const double *principal;   /* the largest eigenvalue of -p 1 + s' [Pa] */
    const double *stretch;     /* the largest eigenvalue of V, at constant volume; 1: unstretched */
    const double *energy;      /* elastic energy per volume [J/m3] */
    const double *mises;       /* sqrt(3/2 s':s') [Pa] */
    const double *strain;      /* accumulated plastic strain, >= 0 */
    const double *rate;        /* of plastic strain in the step [1/s] */
    const double *temperature; /* [K] */
};

struct bulla_damage {
    uint32_t size; /* sizeof(struct bulla_damage) */

    void (*grow)(const void *self, size_t n, const struct bulla_damage_state *state, double *BULLA_RESTRICT aim,
                 double *BULLA_RESTRICT rate);

    /* Bits of enum bulla_damage_needs: what this instance looks at. */
    uint32_t (*needs)(const void *self);
};

#ifdef __cplusplus
}
#endif
#endif
