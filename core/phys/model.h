/* model.h - which fields exist and the laws behind them: built once from a scene.
 *
 * Conserved fields u, in this order: alpha_l (N of them, none if N = 1), m_l = alpha_l rho_l,
 * rho u_i (dim), rho E. Primitives w, same count: alpha_l, rho_l, u_i, p. For N = 1 m is rho. */
#ifndef MODEL_H
#define MODEL_H

#include "bulla/eos.h"
#include "bulla/limiter.h"
#include "bulla/riemann.h"
#include "case/scene.h"

#include <stdbool.h>

struct model_eos {
    const struct bulla_eos *law;
    const void *self;
    double rho_fill; /* density that stands in where the material is absent */
};

struct model {
    const struct scene *scene;
    int dim, beta;
    unsigned n_material, n_alpha, n_field;
    unsigned i_alpha, i_m, i_u, i_E; /* first index of each group; primitives: i_m holds rho_l, i_E holds p */
    unsigned n_active, active[2 * SCENE_MATERIALS + 4]; /* components that evolve; all, but in a pure model */
    unsigned first;                      /* material of the scene that eos[0] is: 0, but in a pure model */
    bool mixed;                          /* the scene has several materials */
    struct model *pure[SCENE_MATERIALS]; /* the same scene where only material l is present (NULL for N = 1): one
                                            material, no fractions, indices into the same storage */
    bool kapila, linear;                 /* linear: every law is linear in p, closed-form mixture pressure */
    struct model_eos eos[SCENE_MATERIALS];
    struct model_limiter {
        const struct bulla_limiter *law;
        const void *self;
    } limiter, limiter_alpha; /* of the primitives, and of the volume fractions */
    const struct bulla_riemann *riemann;
    const void *riemann_self;
    const struct bulla_riemann *robust; /* rusanov: faces of troubled cells (solve/guard.h) */
    char **names;                       /* derived field names, NULL-terminated (derive.h) */
    char **field_names;                 /* names of the evolved fields, for messages and ledgers */
};

struct model *model_new(const struct scene *scene);
void model_free(struct model *model);

#endif
