/* blame.h - what a step that could not be completed failed on: one tile, with all that its update needed.
 *
 * When the guard gives up, the attempt is repeated with a watch on the tile that holds the first bad cell; so the
 * facts cost nothing as long as all goes well, and are those of the very attempt that the message speaks of.
 * blame_replay.h computes the tile again from these facts alone; io/dump.h writes them to a file. */
#ifndef BLAME_H
#define BLAME_H

#include "scheme/terms.h"
#include "solve/guard.h"

enum {
    BLAME_FAILED_SYNC = TABLEAU_STAGES,
    BLAME_TOO_SLOW,
    BLAME_COLUMNS = 9 * SCENE_MATERIALS + 40,
    BLAME_NAME = SCENE_NAME + 32
};

/* Plain numbers and texts: they can be sent as they are. */
struct blame_facts {
    int rank;         /* which has the blocks */
    long step;        /* under way, counted from 1 */
    double t, dt, at; /* where the step of the level began [s], its size [s]; when the stage took boundary values [s] */
    int integrator;   /* enum scene_integrator */
    int level, stage; /* stage: of the tableau, BLAME_FAILED_SYNC: after averages and fluxes of a finer level,
                  BLAME_TOO_SLOW: before a step that is too short to be taken (pace.h) */
    int tile[3], extent[3], covered; /* as in struct tile and struct level */
    double h[3];
    int n[3]; /* cells of the tile */
    unsigned n_cell, cell;
    int pure; /* model_number of the path that the tile was advanced with */
    bool masked, repair;
    char field[BLAME_NAME]; /* the first field that is wrong in the cell, and its value */
    double value;
    char verdict[GUARD_WORDS];
};

/* Was the tile under way when it failed? Else there are no rates, frames and faces. */
static inline bool blame_moves(const struct blame_facts *facts)
{
    return facts->stage < BLAME_FAILED_SYNC;
}

/* The blocks, [rows][columns]; components are rows, cells columns, x fastest. */
enum blame_block {
    BLAME_U_OLD,     /* conserved at the beginning of the step */
    BLAME_W,         /* primitives at which the rates were taken */
    BLAME_U,         /* what came out, before the guard changed anything */
    BLAME_W_NEW,     /* its primitives */
    BLAME_K,         /* of mix_closure; Kapila closure only */
    BLAME_STIFFNESS, /* rho_l c_l^2 at w, likewise */
    BLAME_BASE,      /* conserved fields that the stage went on from, where these are not u_old */
    BLAME_FRAME_X,   /* w with layers of neighbours along an axis: [field][outer][n + 2 ghosts][inner] */
    BLAME_FRAME_Y,
    BLAME_FRAME_Z,
    BLAME_MASK_X, /* marked cells of the same frames */
    BLAME_MASK_Y,
    BLAME_MASK_Z,
    BLAME_AROUND, /* what terms see across edges: model->around of the tile and a layer of cells around it */
    BLAME_FACES,  /* lower and upper face of the cell along each axis: [2 dim][blame_columns] */
    BLAME_BLOCKS
};

struct blame {
    struct blame_facts facts;
    double *block[BLAME_BLOCKS]; /* NULL: does not exist for this stage (blame_shape: 0 rows), or on another rank */
    int turn;                    /* stage under way */
    unsigned local;
    bool whole; /* the watched stage has been seen to its end */
};

const char *blame_name(enum blame_block block);

/* Name of a block and its shape; 0 rows: there is none. `model` is the whole one of the scene. */
struct blame_shape {
    const char *name;
    unsigned rows;
    size_t columns;
};
struct blame_shape blame_shape(const struct model *model, const struct blame_facts *facts, enum blame_block block);

/* Names of the columns of BLAME_FACES; returns their number. */
unsigned blame_columns(const struct model *model, const struct blame_facts *facts, char (*ret_names)[BLAME_NAME]);

/* Starts to watch what the guard has found, with memory for all blocks. */
struct blame *blame_new(const struct model *model, const struct guard *guard);

/* An empty one with the blocks that the facts ask for. */
struct blame *blame_like(const struct model *model, const struct blame_facts *facts);
void blame_free(struct blame *blame); /* NULL is fine */

/* Is this local tile, in the stage under way, the watched one? `blame` may be NULL. */
static inline bool blame_concerns(const struct blame *blame, unsigned local)
{
    return blame && blame->local == local && blame->turn == blame->facts.stage;
}

/* For stage.c, of a watched tile: a piece as it was gathered; its fluxes; what the new state is made of (u_old: at the
 * beginning of the step); what came out. */
void blame_frame(struct blame *blame, const struct model *used, const struct frame *frame,
                 const struct face_work *faces);
void blame_faces(struct blame *blame, const struct terms *terms, const struct frame *frame);
void blame_rates(struct blame *blame, const struct model *model, const struct term_tile *tile, const double *u_old);
void blame_result(struct blame *blame, const struct model *used, const double *u, const double *w);

/* Of a tile that failed between steps: w there now, and what the guard kept of it ([2][n_field][n_cell]). */
void blame_keep(struct blame *blame, const struct model *model, const double *w, const double *kept);

/* ", at its face x-: left.energy = nan": the first quantity at the faces of the cell that is no number, which says more
 * than the fields that it has spoilt; "" if there is none. */
void blame_say_face(const struct blame *blame, const struct model *model, size_t room, char *ret_text);

/* The other way: a piece of the frames, and of the marks, for the work space of a replay. */
void blame_give(const struct blame *blame, const struct model *used, const struct frame *frame,
                struct face_work *faces);

struct state;

/* After a failed step: is there a blame on any rank? Then its facts on all ranks, and, on facts.rank, the blame itself
 * (else NULL), which belongs to the state. Collective. */
bool blame_find(const struct state *state, struct blame_facts *ret_facts, const struct blame **ret_blame);

#endif
