/* tilt.h - faces of models whose materials share the traction on a surface that lies as it likes (scheme/normal.h).
 *
 * In one dimension the traction on faces is the common one, P = p - sum alpha_l s'_l,nn, and takes the place of p
 * (face_stress.h). With a normal n in each cell,
 * - P is that of the cell's own normal, and the limiter sees its neighbours with the same one: the differences to them
 * are made of p and the whole stress (`lean` of face.h), the same in all tiles that see a cell;
 * - the normal of a cell holds at its edges;
 * - the stress of a face of normal f is that of the surface, which both sides share, and what solids bear along it:
 * with t the traction on n without its normal part, s' = s'_nn 1 + c (n t + t n) + H. H, per volume of solid, acts on
 * one part A of the face for both sides, the part that solids cover: the mean of their fractions at the two edges, less
 * where one is below 1/16 of the other. Beside cells without solid nothing bears it. t is that of each side: the solver
 * lets them slip. c = 2 (n.f)^2 - 1 where that is above 0: under 45 degrees faces that hold nothing of t end runs.
 * After docs/decisions/oblique-surfaces.md. */
#ifndef TILT_H
#define TILT_H

#include "scheme/term.h"

/* Work space of a scene, of mem_new; NULL: it has no normals. */
void *tilt_open(const struct term_room *room);

/* The cells with edges, as frame_edged() counts them, that have a normal, and it, packed; component d at
 * normal + d * FACE_ROOM. One value more than that is there in each row, 0. */
struct tilt_aimed {
    size_t n;
    unsigned at[FACE_ROOM];
    double normal[3 * FACE_ROOM];
};

/* P in place of p in the gathered cells, and the differences; and which cells have a normal. */
void tilt_frame(const struct term_piece *piece);

/* What solids have on the normals of the edges: packed rows, those of upper edges first, of lower ones from FACE_ROOM
 * on; with room for one value more. */
struct tilt_held {
    double *mean;    /* sum alpha_l s'_l,nn */
    double *pull[3]; /* [n_velocity] sum alpha_l s'_l N */
};

/* Rows of the edges of a frame, upper ones first. */
struct tilt_edges {
    const double *state; /* primitives, component q at 2 q FACE_ROOM */
    const struct tilt_aimed *aimed;
    const struct tilt_held *held;
    const double *stress; /* s'_ff of the cell */
    double *traction;     /* -s_ff: in: P - s'_ff of the cell; out: of the face */
    double *const *shear; /* [n_velocity - 1] s'_ft: in: of the cell; out: of the face */
};

/* Puts what the face bears in place of what the edges' own fractions say; where no normal is there they stay. */
void tilt_share(const struct model *model, const struct frame *frame, const struct tilt_edges *edges);

#endif
