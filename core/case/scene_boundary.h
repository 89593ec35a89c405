/* scene_boundary.h - the types of boundaries, one row each: all that the program knows of a type stands there.
 *
 * From the rows come the constants, the words and keys of a case (scene_boundary.c), the functions that fill the layers
 * behind a face (scheme/bound_fill.c), and what others ask for: rest, materials, the start, the other side. The order
 * of the rows is that of the manual and means nothing. */
#ifndef SCENE_BOUNDARY_H
#define SCENE_BOUNDARY_H

#include <stdbool.h>

struct scene;

/* What a type means to others. */
enum scene_boundary_trait {
    SCENE_BOUNDARY_RESTS = 1, /* behind it lies a mirror image or a copy of what is inside: beside rest there is rest */
    SCENE_BOUNDARY_BRINGS = 2, /* may bring in materials that are not inside */
    /* Goes by pressure and velocity at the start of the run, which the solver alone keeps: who looks at a finished
     * state (slopes of derived fields) goes on with what is inside. */
    SCENE_BOUNDARY_REFERS = 4,
    SCENE_BOUNDARY_WRAPS = 8,   /* the cells of the opposite face lie behind it: to the mesh there is no boundary */
    SCENE_BOUNDARY_MIDDLE = 16, /* the other half of what is inside lies behind it: may stand at r = 0 */
    SCENE_BOUNDARY_CENTRE = 32, /* stands at r = 0 alone */
    SCENE_BOUNDARY_DRIVES = 64, /* brings states that may be faster than all that is inside: the time step knows them */
    SCENE_BOUNDARY_OPEN = 128,  /* fluid and waves leave or come in */
};

/* ROW(constant, word, what it is, what may be written, who fills the layers behind it, what it means to others). */
#define SCENE_BOUNDARY_TABLE(ROW)                                                                                   \
    ROW(AXIS, "axis", "The axis or centre r = 0.", NOTHING, slip,                                                   \
        SCENE_BOUNDARY_RESTS | SCENE_BOUNDARY_MIDDLE | SCENE_BOUNDARY_CENTRE)                                       \
    ROW(SYMMETRY, "symmetry", "Plane of symmetry.", NOTHING, slip, SCENE_BOUNDARY_RESTS | SCENE_BOUNDARY_MIDDLE)    \
    ROW(REFLECTING, "reflecting", "Rigid wall along which the fluid slips.", WALL, slip, SCENE_BOUNDARY_RESTS)      \
    ROW(NO_SLIP, "no-slip", "Rigid wall to which the fluid sticks.", STICKY, no_slip, SCENE_BOUNDARY_RESTS)         \
    ROW(OUTFLOW, "outflow", "Zero gradient.", NOTHING, copy, SCENE_BOUNDARY_RESTS | SCENE_BOUNDARY_OPEN)            \
    ROW(NONREFLECTING, "non-reflecting", "Outgoing waves leave, none comes in.", FAR, far,                          \
        SCENE_BOUNDARY_REFERS | SCENE_BOUNDARY_OPEN)                                                                \
    ROW(PERIODIC, "periodic", "What leaves here enters at the opposite face.", NOTHING, copy, SCENE_BOUNDARY_WRAPS) \
    ROW(INFLOW, "inflow", "A fixed state flows in.", STATE, state,                                                  \
        SCENE_BOUNDARY_BRINGS | SCENE_BOUNDARY_DRIVES | SCENE_BOUNDARY_OPEN)                                        \
    ROW(INCOMING_WAVE, "incoming-wave", "A pressure wave comes in; outgoing waves leave.", WAVE, wave,              \
        SCENE_BOUNDARY_REFERS | SCENE_BOUNDARY_DRIVES | SCENE_BOUNDARY_OPEN)

#define SCENE_BOUNDARY_TYPE(type, ...) SCENE_##type,
/* The last one is that of all modules of kind "boundary", which say themselves what they mean. */
enum scene_boundary_type { SCENE_BOUNDARY_TABLE(SCENE_BOUNDARY_TYPE) SCENE_BOUNDARY_MODULE, SCENE_BOUNDARY_TYPES };
#undef SCENE_BOUNDARY_TYPE

/* Has the boundary at face 2 * axis + side of a scene all these traits? */
bool scene_boundary_is(const struct scene *scene, int face, unsigned traits);

/* Does heat go through the boundary at a face because a case says so: a temperature, or a flux? */
bool scene_boundary_is_heated(const struct scene *scene, int face);

/* The word for a type in a case. */
const char *scene_boundary_name(enum scene_boundary_type type);

#endif
