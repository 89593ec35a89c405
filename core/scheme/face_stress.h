/* face_stress.h - the part of faces that only scenes with a solid have.
 *
 * Both edges of the cells of a row get their elastic energy, traction and wave speeds before the Riemann problems are
 * solved, and the stretch is carried through the faces afterwards. Rows are those of face.c: edges in rows of twice
 * FACE_ROOM, upper ones first. */
#ifndef FACE_STRESS_H
#define FACE_STRESS_H

#include "scheme/face.h"
#include "scheme/term.h"
#include "scheme/tilt.h"

/* Scratch of one face_work, for paths with a stretch. */
struct face_stress {
    double *energy, *normal, *shear[2], *stiff, *rigid; /* of elastic_sides; `rigid` becomes c_s */
    double *traction;                                   /* -s_nn = p - s'_nn */
    struct tilt_held held;                              /* of models with normals (tilt.h) */
    double *own;                                        /* [n_material] pressures of the materials (split models) */
    struct tilt_aimed *aimed;                           /* of models with normals; tilt_frame() fills it */
    const double *sides[2][2];                          /* [side][tangent] shear tractions, for the solver */
    double *slide_left[2], *slide_right[2], *robust_left[2], *robust_right[2];
};

/* NULL where the model has no stretch. */
struct face_stress *face_stress_new(const struct model *model);
void face_stress_free(struct face_stress *stress);

/* One traction for all materials of a cell (traction.h): replaces p of a gathered frame by -s_nn, which is what is
 * reconstructed then. */
extern const struct term face_stress_term;

/* Pressures of the materials at the edges of n cells, from the traction. */
void face_stress_split(struct face_stress *stress, const struct model *model, size_t n, const double *state);

/* That of material l, after that. */
const double *face_stress_pressure(const struct face_stress *stress, const struct model *model, unsigned l,
                                   const double *state);

/* Edges of a row, as face.c has completed them without elasticity. */
struct face_stress_edges {
    const struct frame *frame;
    size_t n;
    const double *state;    /* primitives at the edges, component q at 2 q FACE_ROOM */
    const double *const *m; /* [n_solid] partial densities of the solids */
    const double *rho;
    double *energy, *rho_c2; /* in: of the fluid part; out: with the elastic part */
};

void face_stress_complete(struct face_stress *stress, const struct model *model, const struct face_stress_edges *edges);

/* Points the solver to traction, shear and slides of `faces`; right edges begin at `right`. */
void face_stress_point(struct face_stress *stress, const struct model *model, size_t right, struct bulla_faces *faces);

/* V* F of all stretches into `out`, pitch FACE_ROOM: the mass flux of the solid times its stretch on the side that it
 * comes from; m: [n_material] mass fluxes. */
void face_stress_carry(const struct model *model, size_t n, size_t right, const double *state, const double *m,
                       double *out);

/* eps* F_l of the solids that have a plastic strain, the same way. */
void face_stress_age(const struct model *model, size_t n, size_t right, const double *state, const double *m,
                     double *out);

#endif
