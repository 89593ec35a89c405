/* work.h - scratch of one rank, used by its levels and tiles in turn: what a tile needs while it is worked on. */
#ifndef WORK_H
#define WORK_H

#include "levels/prolong.h"
#include "scheme/hancock.h"
#include "scheme/operators.h"
#include "scheme/rate.h"
#include "solve/around.h"
#include "solve/balance.h"
#include "solve/cost.h"
#include "solve/curve.h"

struct work {
    const struct model *model;
    struct face_work *faces;
    struct face_work *faces_pure;                    /* of paths of one material; NULL if the scene has no more */
    struct face_work *faces_fluids;                  /* of the path of all fluids, or NULL */
    struct terms *terms[SCENE_MATERIALS + 2];        /* by model_number + 1; NULL: the scene has no such path */
    struct operators operators[SCENE_MATERIALS + 2]; /* likewise */
    void *own[TERMS_MOST];                           /* memory of the terms */
    struct prolong *prolong;
    struct around *around;                    /* or NULL */
    struct curve *curve;                      /* or NULL */
    struct hancock *hancock;                  /* of integrators with a stage of slopes, or NULL */
    enum term_part part;                      /* of the steps: TERM_SLOW while what diffuses goes apart (flow.h) */
    double *rates, *K, *rho_c2, *c2, *u_star; /* of one tile */
    double *grown;          /* [n_solid] rows of one tile (operator.h); NULL unless plastic solids can break */
    double *shore;          /* where shore_look works; NULL: no pair of the scene asks */
    struct cost cost;       /* where the time goes, of all levels */
    struct balance balance; /* and how evenly */
};

struct work *work_new(const struct model *model, const struct mesh *mesh);
void work_free(struct work *work); /* NULL is fine */

/* The terms of a path of the scene. */
const struct terms *work_terms(const struct work *work, const struct model *path);

/* Its operators. */
const struct operators *work_operators(const struct work *work, const struct model *path);

#endif
