/* terms.h - which terms a scene has: the equations as a list, compiled once for each path (model.h).
 *
 * Stages, replays of dumps, the census, the time step, refluxing and `bulla plan` walk the same list. A new term is its
 * two files and one line in terms.c.
 *
 * This folder, scheme: from cells to faces to rates: frames, boundaries, edges, fluxes, the terms of the equations,
 * a file each. */
#ifndef TERMS_H
#define TERMS_H

#include "scheme/term.h"

enum { TERMS_MOST = 29, TERMS_FLUXES = 5 * SCENE_MATERIALS + 6 * MODEL_STRETCHES + 32 };

/* The list of one path. */
struct terms {
    const struct model *model;
    struct face_work *faces; /* work space that the fluxes lie in, or NULL */
    unsigned n;
    const struct term *at[TERMS_MOST];
    unsigned number[TERMS_MOST]; /* its place in terms_all */
    unsigned first[TERMS_MOST];  /* its first row of rates */
    unsigned n_rates;
    bool moves; /* some term may move what rests */
    unsigned n_flux[3];
    struct term_flux *flux[3]; /* [axis][n_flux] */
};

/* Every term there is, in the order in which they act; ends with NULL. */
extern const struct term *const terms_all[];

/* faces: where the path's fluxes will be (of face_new for this path or one with more fields), or NULL: names alone. */
struct terms *terms_new(const struct model *path, struct face_work *faces);
void terms_free(struct terms *terms); /* NULL is fine; `faces` stays */

/* For the `list` slots: one more flux across `axis`, named "name" or "name_material". Rows may be NULL. */
void terms_flux(struct terms *terms, int axis, struct term_flux flux, const char *name, const char *suffix);

/* First row of rates that a term of the list owns. The term must be in the list. */
unsigned terms_first(const struct terms *terms, const struct term *term);

/* Memory of all terms that a scene has: [TERMS_MOST] by their number. */
void terms_open(const struct term_room *room, void **ret_own);
void terms_close(void **own);

/* The first failure of a script that a term asks: STATUS_OK, or its status, message and place. */
int terms_failure(void *const *own, const char **ret_message, const char **ret_place);

/* Can some term bring a material to where there is none? */
bool terms_spread(const struct scene *scene);

/* Does a term act in this part? */
bool terms_acts(const struct term *term, enum term_part part);

/* Rates of signals of all terms of pace->part in the cells of a tile: rate[n_cell] [1/s]. */
void terms_pace(const struct terms *terms, const struct term_pace *pace, double *rate);

/* The list for people, a line each: name, equation, owner. */
void terms_say(const struct model *model, struct text *text);

#endif
