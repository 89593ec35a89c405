/* census.h - what each tile holds, and what therefore need not be computed.
 *
 * Tiles that hold one material only, with neighbours that hold the same, are advanced without the others: half the
 * work or less. Tiles that are uniform and at rest, with neighbours in the same state, have a rate of exactly zero:
 * they are copied on. Both give bitwise what the full computation would. */
#ifndef CENSUS_H
#define CENSUS_H

#include "mesh/mesh.h"
#include "phys/model.h"

/* What is known of a tile between stages. */
struct census_tile {
    const struct model *path;       /* the model the tile was last advanced with */
    const struct model *kept;       /* the one of the streak */
    unsigned present, present_next; /* bit l: material l is in the tile now; after this stage */
    unsigned streak; /* stages in a row on the same narrowed path, up to one more than a step has: then what it
                        leaves alone is in place in all three arrays */
    bool still, still_next, skipped; /* uniform and at rest now; after this stage; copied in it */
    double signal;                   /* largest sum over axes of (|u_a| + c) / h_a at the last close [1/s] */
};

struct census {
    const struct model *model;
    const struct mesh *mesh;
    const struct level *level;
    struct census_tile *tiles; /* [n_local] */
    unsigned *behind;          /* [faces of the link] bits of the materials behind a coarse-fine face */
};

/* Looks at what lies behind the coarse-fine faces (after link_down). */
void census_receive(struct census *census);

/* The model that suffices for a tile. */
const struct model *census_choose(const struct census *census, unsigned local);

/* Is a tile at rest, in a state that its neighbours share? */
bool census_rests(const struct census *census, unsigned local);

/* Notes what a tile holds after a stage: its conserved fields and primitives, made with tiles[local].path. */
void census_note(struct census *census, unsigned local, const double *u, const double *w);

/* The same after a stage that makes primitives alone and brings no material to where there was none. */
void census_note_primitives(struct census *census, unsigned local, const double *w);

/* The notes of a stage become what is so now. */
void census_turn(struct census_tile *tile);

/* Bits of the materials that a tile's conserved block holds anything of. */
unsigned census_materials(const struct model *model, size_t n_cell, const double *u);

/* What is known of a tile from its conserved fields alone. */
void census_forget(struct census *census, unsigned local);

#endif
