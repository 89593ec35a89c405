/* contract_face.h - single faces for Riemann solvers: plain structs of one face instead of rows, random
 * ones, and the call that takes them through a solver's row interface. */
#ifndef CONTRACT_FACE_H
#define CONTRACT_FACE_H

#include "suite/contract_batch.h"

enum { CONTRACT_FACE_MATERIALS = 5, CONTRACT_FACE_AXES = 3 };

/* One side of one face; doubles only, so that it is a column of input rows too. */
struct contract_side {
    double rho, p, rho_E, c, u[CONTRACT_FACE_AXES], m[CONTRACT_FACE_MATERIALS], alpha[CONTRACT_FACE_MATERIALS];
    double c_s, s[CONTRACT_FACE_AXES - 1]; /* shear wave speed and tractions; 0 without a solid */
};

/* What a face of a scene looks like. */
struct contract_shape {
    unsigned n_material, n_velocity;
    bool mixed; /* one material alone, in a scene of several */
    bool solid; /* a scene with a solid; of several materials a side may be a fluid nevertheless */
};

struct contract_face {
    struct contract_shape shape;
    struct contract_side left, right;
};

/* What goes through; fields that the shape does not have are 0. Doubles only. */
struct contract_flux {
    double m[CONTRACT_FACE_MATERIALS], momentum[CONTRACT_FACE_AXES], rho_E, u, alpha[CONTRACT_FACE_MATERIALS];
    double slide_left[CONTRACT_FACE_AXES - 1], slide_right[CONTRACT_FACE_AXES - 1];
};

/* Volume fractions that a shape has. */
unsigned contract_face_n_alpha(const struct contract_shape *shape);

/* A random face: stiff or gas-like sides, up to `mach` times the speed of sound in each direction. */
struct contract_face contract_face_draw(uint64_t *seed, struct contract_shape shape, double mach);

/* Through the solver under test. */
struct contract_flux contract_face_solve(const struct contract *contract, const struct contract_face *face);

/* The flux of one side: F(U). */
struct contract_flux contract_face_physical(const struct contract_shape *shape, const struct contract_side *side);

/* What sums of terms of these sides can reach: the measure of round-off. */
struct contract_flux contract_face_scale(const struct contract_face *face);

/* What a face is like, for messages. */
void contract_face_where(const struct contract_face *face, char where[static CONTRACT_NAME]);

/* The solver as rows in, rows out, for faces of one shape. */
struct contract_call contract_face_call(const struct contract_shape *shape);

#endif
