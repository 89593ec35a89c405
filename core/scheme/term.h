/* term.h - one term of the equations as data: what a scene must have for it, which rows of rates it owns, what it does.
 *
 * The rate of change of a tile is a block of rows of n_cell: the n_field evolved fields, then the rows that terms own,
 * in the order of their list (terms.h). In a stage every term of the list acts in this order: begin    in the cells,
 * before any face: what the others are taken relative to frame    on the gathered primitives of a piece, before it is
 * reconstructed faces    on the fluxes of a piece, after the Riemann problems then the fluxes that terms list become
 * rates (divergence.h) cells    adds to the rates what acts in the cells, from the primitives apply    makes the new
 * state: u + dt rate, and what is not of that form All slots may be NULL. What a term does in one tile may not depend
 * on other tiles but through the frames, so that numbers depend neither on ranks nor on the order of tiles.
 * docs/extending.md adds one. */
#ifndef TERM_H
#define TERM_H

#include "base/text.h"
#include "mesh/metric.h"
#include "phys/model.h"
#include "scheme/face.h"

struct term;
struct terms;

/* Which terms act: all, those that diffuse (solve/rkl.h takes them by themselves), or the others. */
enum term_part { TERM_WHOLE, TERM_SLOW, TERM_DIFFUSION };

/* One tile in one stage. Blocks are [rows][n_cell]; only `rates` and what `apply` is given are written, and in `begin`
 * and `cells` the rows of the work space. */
struct term_tile {
    const struct terms *terms;
    const struct model *model; /* the path that the tile is advanced with */
    const struct mesh *mesh;
    const struct level *level;
    const struct tile *tile;
    const struct metric *metric; /* in curved geometry */
    size_t n_cell;
    double t;     /* of the primitives [s] */
    double dt;    /* from u to the new state [s] */
    double begun; /* time of u [s] */
    bool masked;  /* troubled cells are marked: the attempt is a robust one */
    enum term_part part;
    const double *u; /* conserved fields that the step starts from */
    const double *w; /* primitives at which the rates are taken */
    double *rates;
    const double *around; /* model->around of the tile and one layer of cells around it (scheme/patch.h); NULL: no term
                             of the scene looks there */
    const double *hoop; /* what the radial momentum is taken relative to in curved geometry (hoop.h): a row; NULL: 0 */
    double *K,
        *rho_c2; /* Kapila closure: K_l of mix_closure, rho_l c_l^2 of mix_stiffness_everywhere; [n_material] rows */
    void *own;   /* of the term that is called: what its `open` gave */
};

/* One piece of a tile along one axis. */
struct term_piece {
    const struct terms *terms;
    const struct model *model;
    const struct term_tile
        *tile; /* the tile it is a piece of; a replay of a dump knows no neighbours but tile->around */
    const struct frame *frame;
    struct face_work *faces;
    void *own; /* of the term that is called */
};

/* How a row of fluxes becomes rates. */
enum term_kind {
    TERM_DIVERGENCE, /* -(A+ F+ - A- F-)/V */
    TERM_BALANCED,   /* the same of F - q, q the hoop row of the cell, where faces are curved */
    TERM_DIFFERENCE, /* -(F+ - F-)/h, in any geometry */
    TERM_FORCE,      /* (A+ F+ + A- F-)/(2V): no flux, a force at the faces that acts on both sides */
    TERM_TOLD        /* not at all: dumps tell it */
};

/* Does a row go through the faces, so that other levels count with it? */
static inline bool term_is_flux(enum term_kind kind)
{
    return kind != TERM_TOLD && kind != TERM_FORCE;
}

/* Values at the faces across one axis. `below` is what the cell above a face sees at its lower face, `above` what the
 * cell below sees at its upper one: the same row, but for velocities along a face where the sides slip. */
struct term_flux {
    char name[SCENE_NAME + 24];  /* "mass_water": as dumps say it; empty: not told */
    const double *below, *above; /* rows of faces as in face.h; NULL where a list has no work space */
    unsigned rate;               /* row of the rates */
    enum term_kind kind;
    bool sides; /* the two differ */
};

/* What a term needs of memory: opened once per rank for the whole scene. */
struct term_room {
    const struct model *model; /* the whole one */
    const struct mesh *mesh;
};

/* What a term asks of the time step. */
struct term_pace {
    const struct model *model;
    const struct mesh *mesh;
    const struct level *level;
    const struct tile *tile; /* NULL: no cells, but a layer behind a boundary */
    size_t n_cell;
    const double *w, *c2; /* primitives; squares of the fastest signal */
    enum term_part part;
};

struct term {
    const char *name;
    const char *owner;    /* the file it lives in */
    const char *equation; /* one line for people */

    bool (*wanted)(const struct model *path); /* has a path of a scene this term? */
    bool diffuses;                            /* parabolic: may be taken in super steps (solve/rkl.h) */
    bool moves;                               /* may it move what is uniform and at rest? Then no tile is skipped */
    bool (*spreads)(
        const struct scene *scene); /* can it bring a material to where there is none? Then no path is narrowed */

    unsigned (*rows)(const struct model *path); /* rows of rates that it owns */
    void (*list)(struct terms *terms, int axis, unsigned first,
                 const struct face_work *faces); /* terms_flux() for each of its fluxes;
                                                           first: its first row of rates; faces: NULL for names alone */
    void *(*open)(const struct term_room *room);
    void (*close)(void *own);
    int (*failure)(const void *own, const char **ret_message, const char **ret_place); /* of a script; or STATUS_OK */

    void (*begin)(struct term_tile *tile);
    void (*frame)(const struct term_piece *piece);
    void (*faces)(const struct term_piece *piece);
    void (*cells)(struct term_tile *tile);
    size_t (*apply)(const struct term_tile *tile,
                    double *u_new);                            /* returns the number of cells in which a bound acted */
    void (*pace)(const struct term_pace *pace, double *rate);  /* adds to rate[n_cell] how fast each cell changes [1/s]:
                                                                                  dt = cfl / largest sum */
    void (*say)(const struct scene *scene, struct text *text); /* what the scene asks of it, for the plan */
};

#endif
