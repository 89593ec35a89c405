/* face.h - from a frame of primitives to the fluxes through its faces.
 *
 * Reconstruct (alpha_l, rho_l, u_i, p, V; edges.h), complete both sides (partial
 * densities, energies, frozen speed; with a solid also stress and elastic speeds, face_stress.h), solve the Riemann
 * problems. All arrays are long rows of a frame; face k lies between cells k and k + inner, and the row of faces starts
 * at k = inner. */
#ifndef FACE_H
#define FACE_H

#include "phys/model.h"
#include "scheme/frame.h"

enum { FACE_ROOM = FRAME_CELLS + 32 }; /* doubles per component: the frame and vector tails */

struct face_work {
    const struct model *model;
    double *frame; /* [n_field] primitives of the gathered frame, pitch FACE_ROOM */
    double *mask;  /* troubled cells of the frame: 0 or 1; one component */
    double *flat;  /* cells of the frame whose faces get first-order states: 0 or 1; NULL without rigid bodies */
    struct bulla_faces faces;                  /* what the Riemann solver got and gave; n faces */
    double *alpha, *m, *momentum, *energy, *u; /* the fluxes: blocks with pitch FACE_ROOM; momentum[0] normal,
                                                  alpha: alpha* u*, u: u* */
    double *carried;                           /* [n_alpha] alpha* u* times the pressure of the side it comes from */
    double *strained;                          /* [n_alpha] alpha* u* times the compression on the way to the face */
    double
        *stretch; /* [n_stretched] V* F, F the mass flux of the solid that carries it, V* of the side it comes from */
    double *strains; /* [n_inner] eps* F_l, D* F_l: what solids remember, F_l the mass flux of the solid */
    double *heat_below, *heat_above; /* [n_alpha] heat of each material as the cells above and below the face get and
                                        give it (conduction.h); NULL unless the scene conducts */
    double *solid;                   /* [n_solid] fractions of the solids, means of the sides (mixtures with a solid) */
    double *slide_left,
        *slide_right;               /* [n_velocity - 1] u*_t as the cells left and right of the face see it (solids) */
    double *seen_left, *seen_right; /* [n_velocity] the same with u*, normal first, of the solids in the cells left and
                                       right of the face (shelter.h); NULL: all of them come there */
    double *rise[2]; /* of p from the middle of each cell of the frame to its lower and its upper face, with the sign of
                        going up, where it holds the forces [Pa]; NULL where the scene has none (model->forced) */
    bool held;       /* do cells of the frame hold forces? else `rise` is not filled (face_rise) */
    double *lean[2]; /* of each cell of the frame: what its neighbours' normals make of the differences of the traction
                        to the cells before and behind [Pa]; NULL where normals are axes */
    struct tilt_aimed *aimed; /* the cells that have a normal (tilt.h); NULL where normals are axes */
    bool open[3][2];          /* [axis][side] does the tile of the frames end there, at a boundary that waves cross? */
    double per_h[3];          /* of the tile, along each axis [1/m]; 0: thick liquids are as others */
    double *lag; /* [n_material] p_l - p at the face between each cell of the frame and the next, at the place of the
                        cell before, by what acts in interfaces (lag.h) [Pa]; NULL where the scene has none */
    double *tension; /* force of surface tension at the faces: what p grows by across them [Pa]; likewise */
    void *own;       /* scratch of face.c */
};

struct face_work *face_new(const struct model *model);
void face_free(struct face_work *work);

/* Volume of each gas that diffuses through others (fick.h), a row each, behind `strained`; of scenes with any. */
static inline double *face_mingled(const struct face_work *work)
{
    return work->strained + (work->strained - work->carried); /* of the whole scene, whatever the path */
}

/* Before terms look at a gathered frame: no forces yet. */
void face_begin(struct face_work *work, const struct frame *frame);

/* More that the cells of the frame hold: rises of p [frame.count] to their lower and their upper faces [Pa]. */
void face_rise(struct face_work *work, const struct frame *frame, const double *below, const double *above);

/* No fluxes of mass, momentum and energy: what terms that diffuse add to is 0. */
void face_rest(struct face_work *work, const struct frame *frame);

/* Values at the edges of the cells of the frame in work->frame, by the reconstruction of the scheme: component q at 2 q
 * FACE_ROOM of what is returned, as edges_fill() leaves it. They last until the next call. */
const double *face_edges(struct face_work *work, const struct frame *frame, bool masked);

/* Fills the flux arrays for the frame in work->frame. Face index f of the row is the lower face of
 * frame cell f + ghosts inner. With `masked`, faces of cells marked in work->mask get first-order
 * states and the robust solver. */
void face_solve(struct face_work *work, const struct frame *frame, bool masked);

/* Row index of the lower face of cell (o, i) of the piece, inner index 0; the upper one is `inner` further. */
static inline size_t face_at(const struct frame *frame, size_t o, size_t i)
{
    return frame_at(frame, o, (int)i) - frame->ghosts * frame->inner;
}

#endif
