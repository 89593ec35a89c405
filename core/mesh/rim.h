/* rim.h - what lies around the tiles of a level, across edges and corners too.
 *
 * The g layers around a tile are cut into 3^dim - 1 pieces, one per way: a step of -1, 0 or 1 along each axis. Each
 * piece lies in one tile of the same level, or in one octant of one tile of the next coarser level (levels nest: the
 * 3^d octants around a tile exist there), or behind the domain's boundary. So each is found by itself, wherever its
 * neighbours come from. Pieces of tiles on other ranks travel in one message per pair of ranks; pieces on the coarser
 * level are made there by the owner of the coarse tile (levels/prolong_rim.h) at the beginning and at the end of its
 * step. What lies behind boundaries is the reader's business (scheme/patch.h), with one exception: where
 * a boundary is `given` (an inflow, a characteristic), only the tile inside can say what is behind it. It
 * writes that into its outer layers, and neighbours get their part of these as they get its cells.
 * A rim is made when a term first asks for it; a scene without such terms has none. */
#ifndef RIM_H
#define RIM_H

#include "mesh/box.h"
#include "mesh/mesh.h"

enum { RIM_WAYS = 27, RIM_HERE = 13, RIM_LAYERS = 3 };

/* What a rim is for; rims of equal forms are one. */
struct rim_form {
    unsigned n_field;
    int g;     /* layers, 1 to RIM_LAYERS (three are a cell and a half of the coarser level) */
    int slots; /* of pieces on the coarser level: 1, or 2 for what is linear in time between them */
    unsigned char
        given; /* bit 2 * axis + side: what is behind that boundary is in the outer layers of the tile inside */
    const unsigned char *fields; /* [n_field] components of the arrays, a list that lives as long as the mesh; NULL: the
                                    first n_field. Told apart by address */
};

struct rim_piece {
    enum { RIM_UNUSED, RIM_LOCAL, RIM_REMOTE, RIM_COARSE, RIM_BEHIND } kind;
    unsigned index;      /* LOCAL: local tile; REMOTE: item of the message; COARSE: of rim->coarse */
    signed char step[3]; /* to the tile where it lies: without the axes along which the way leaves the domain */
    signed char outer;   /* one of those axes, across which it is outer layers of that tile (or is BEHIND); -1: none */
};

/* One end of a piece that lies on the coarser level. */
struct rim_coarse {
    unsigned fine, coarse; /* local tiles; an end that is on another rank: at least n_local */
    int way;
    int base[3];     /* cell i of the fine tile along an axis lies in cell base + floor(i / 2) of the coarse one */
    int outer;       /* axis across which the coarse cells are outer layers, or -1 */
    double *data[2]; /* by slot: [n_field][cells of the piece] */
};

struct rim_send;
struct post;

struct rim {
    const struct mesh *mesh;
    int l;
    struct rim_form form;
    struct rim_piece (*pieces)[RIM_WAYS]; /* [n_local] */
    bool *remote;                         /* [n_local]: some piece is REMOTE */
    unsigned n_coarse;
    struct rim_coarse *coarse; /* of local tiles, in the order (tile, way) */
    /* of local tiles of level l - 1; those of tile c are sources[source_from[c] .. source_from[c + 1]) */
    unsigned n_source, *source_from;
    struct rim_coarse *sources;
    double **outer; /* [n_local * MESH_FACES]: outer layers, or NULL; NULL where nothing is given */
    unsigned n_send;
    struct rim_send *sends;
    struct post *same, *down;
    size_t n_shared;
    double *shared;                  /* [n_shared]: outer layers, data of pieces with both tiles here */
    struct box_move moves[RIM_WAYS]; /* from the tile that lies that way into a block with all layers (rim_block) */
    struct rim *next;                /* of the same level, with another form */
};

/* Step of a way along an axis. */
static inline int rim_step(int way, int axis)
{
    return (axis == 0 ? way : axis == 1 ? way / 3 : way / 9) % 3 - 1;
}

static inline int rim_way(const int step[3])
{
    return step[0] + 3 * step[1] + 9 * step[2] + RIM_HERE;
}

/* The rim of level l with that form, made if it is not there; freed with the mesh, or when tiles of the level or of
 * the coarser one are replaced. Levels must nest. Not collective, but its exchanges are. */
struct rim *rim_of(const struct mesh *mesh, int l, const struct rim_form *form);

/* Where mesh.c keeps them: one list per level. */
struct rim **rim_shelf_new(void);
void rim_shelf_drop(struct rim **shelf, int l);
void rim_shelf_free(struct rim **shelf);

/* The cells of a piece, in the coordinates of the tile it surrounds. */
struct box rim_box(const struct mesh *mesh, int g, int way);

/* A tile's cells with g layers around them along the axes that are used; data may be NULL. The pitch is the number of
 * cells. */
struct box_block rim_block(const struct mesh *mesh, int g, double *data);

/* A tile's own cells as a block. */
struct box_block rim_tile(const struct rim *rim, double *array);

/* The outer layers of a local tile behind a given boundary, to be written before rim_start; data is NULL elsewhere. */
struct box_block rim_outer(const struct rim *rim, unsigned local, int face);

/* Sends what other ranks need of `arrays` ([n_local] tiles, [n_field][n_cell]) and of the outer layers, and receives.
 * Collective. */
void rim_start(struct rim *rim, double *const *arrays);
void rim_finish(struct rim *rim);

/* Pieces on the coarser level to the owners of the fine tiles, after `sources` have been written. Collective. */
void rim_down(struct rim *rim);

/* Where a LOCAL or REMOTE piece comes from; cell c of the piece is cell c + ret_shift of the block. */
struct box_block rim_find(const struct rim *rim, double *const *arrays, unsigned local, int way, int ret_shift[3]);

/* Bytes: sent by this rank per exchange on the level and from the coarser one; held by the rim with its messages. */
struct rim_bytes {
    size_t same, down, held;
};
struct rim_bytes rim_size(const struct rim *rim);

#endif
