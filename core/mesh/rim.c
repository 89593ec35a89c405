/* rim.c - see rim.h. Both ends of a message list its pieces in the order (receiving tile, way): the receiver in the
 * order of its own tiles, the sender by sorting what it sends. Who needs a piece follows from the way back: a tile
 * P that lies `step` from T is seen from T, and T from P with -step; steps out of the domain are the same for both. */
#include "mesh/rim.h"

#include "base/comm.h"
#include "base/mem.h"
#include "mesh/level.h"
#include "mesh/link.h"
#include "mesh/morton.h"
#include "mesh/post.h"

#include <stdlib.h>
#include <string.h>

/* Apart from the tags of post.h and prolong.c; one of each per level (added). */
enum { RIM_TAG_SAME = 500, RIM_TAG_DOWN = 600 };

/* A piece for a tile of another rank: the cells of the way `way` of tile `to`. */
struct rim_send {
    unsigned local, to;
    int way, shift[3];
    signed char outer;
};

/* Where the piece of a way lies. */
struct rim_place {
    int at[3];           /* of the tile it is cut from */
    signed char step[3]; /* to that tile: the way without the axes that leave the domain */
    signed char outer;   /* the last of those axes, or -1 */
    int leaves;          /* their number */
};

static bool rim_is_used(const struct mesh *mesh, int way)
{
    for (int d = mesh->dim; d < 3; d++)
        if (rim_step(way, d)) return false;
    return way != RIM_HERE;
}

static bool rim_is_given(const struct rim *rim, int way, int axis)
{
    return rim->form.given >> (2 * axis + (rim_step(way, axis) > 0)) & 1;
}

static struct rim_place rim_look(const struct mesh *mesh, const struct level *level, const struct tile *tile, int way)
{
    struct rim_place place = {.outer = -1};
    for (int d = 0; d < 3; d++) {
        int step = rim_step(way, d), at = tile->at[d] + step, extent = level->extent[d];
        bool inside = at >= 0 && at < extent;
        place.at[d] = inside ? at : mesh->periodic[d] ? (at + extent) % extent : tile->at[d];
        place.step[d] = (signed char)(inside || mesh->periodic[d] ? step : 0);
        if (inside || mesh->periodic[d]) continue;
        place.leaves++;
        place.outer = (signed char)d;
    }
    return place;
}

struct box rim_box(const struct mesh *mesh, int g, int way)
{
    struct box box;
    for (int d = 0; d < 3; d++) {
        int step = rim_step(way, d), n = mesh->n[d];
        box.from[d] = step < 0 ? -g : step > 0 ? n : 0;
        box.to[d] = step < 0 ? 0 : step > 0 ? n + g : n;
    }
    return box;
}

struct box_block rim_block(const struct mesh *mesh, int g, double *data)
{
    struct box box = {.to = {1, 1, 1}};
    for (int d = 0; d < mesh->dim; d++) {
        box.from[d] = -g;
        box.to[d] = mesh->n[d] + g;
    }
    return box_pack(&box, data);
}

struct box_block rim_tile(const struct rim *rim, double *array)
{
    struct box_block block = {.data = array, .pitch = rim->mesh->n_cell, .fields = rim->form.fields};
    for (int d = 0; d < 3; d++) block.size[d] = (size_t)rim->mesh->n[d];
    return block;
}

/* Box of the outer layers behind a face. */
static struct box rim_outer_box(const struct rim *rim, int face)
{
    int step[3] = {0};
    step[face / 2] = face % 2 ? 1 : -1;
    return rim_box(rim->mesh, rim->form.g, rim_way(step));
}

struct box_block rim_outer(const struct rim *rim, unsigned local, int face)
{
    const struct box box = rim_outer_box(rim, face);
    return box_pack(&box, rim->outer ? rim->outer[local * MESH_FACES + (unsigned)face] : NULL);
}

static void rim_shift(const struct mesh *mesh, const signed char step[3], int ret_shift[3])
{
    for (int d = 0; d < 3; d++) ret_shift[d] = -step[d] * mesh->n[d];
}

static const struct level *rim_level(const struct rim *rim)
{
    return &rim->mesh->levels[rim->l];
}

static size_t rim_doubles(const struct rim *rim, int way)
{
    const struct box box = rim_box(rim->mesh, rim->form.g, way);
    return rim->form.n_field * box_cells(&box);
}

/* The piece of a tile on another rank, and the one that goes back the same way. */
static void rim_add_send(struct rim *rim, unsigned local, unsigned other, int way, const struct rim_place *place)
{
    signed char step[3];
    int back[3];
    for (int d = 0; d < 3; d++) {
        step[d] = (signed char)-place->step[d];
        back[d] = step[d] ? step[d] : rim_step(way, d);
    }
    struct rim_send *send = &rim->sends[rim->n_send++];
    *send = (struct rim_send){.local = local, .to = other, .way = rim_way(back), .outer = place->outer};
    rim_shift(rim->mesh, step, send->shift);
}

static void rim_add_coarse(struct rim *rim, unsigned fine, int way, const struct rim_place *place, unsigned coarse,
                           struct rim_coarse *ret)
{
    *ret = (struct rim_coarse){.fine = fine, .coarse = coarse, .way = way, .outer = place->outer};
    for (int d = 0; d < rim->mesh->dim; d++)
        ret->base[d] = ((place->at[d] & 1) - place->step[d]) * (rim->mesh->n[d] / 2);
}

static void rim_list_way(struct rim *rim, unsigned t, int way)
{
    const struct level *level = rim_level(rim);
    struct rim_piece *piece = &rim->pieces[t][way];
    struct rim_place place = rim_look(rim->mesh, level, &level->tiles[level->first + t], way);
    bool behind = place.leaves > 1 || (place.leaves == 1 && !rim_is_given(rim, way, place.outer));
    *piece = (struct rim_piece){.kind = RIM_BEHIND, .outer = place.outer};
    memcpy(piece->step, place.step, sizeof piece->step);
    if (behind) return;
    int other = level_find(level, morton_key(place.at));
    if (other < 0) {
        int coarse = level_find(&rim->mesh->levels[rim->l - 1], morton_key(place.at) >> 3);
        piece->kind = RIM_COARSE;
        piece->index = rim->n_coarse;
        rim_add_coarse(rim, t, way, &place, (unsigned)coarse - rim_level(rim)[-1].first, &rim->coarse[rim->n_coarse++]);
    } else if (level->tiles[other].rank == comm_rank()) {
        piece->kind = RIM_LOCAL;
        piece->index = (unsigned)other - level->first;
    } else {
        piece->kind = RIM_REMOTE;
        rim->remote[t] = true;
        piece->index = rim->n_send;
        rim_add_send(rim, t, (unsigned)other, way, &place);
    }
}

static void rim_list(struct rim *rim)
{
    const struct level *level = rim_level(rim);
    size_t most = (size_t)level->n_local * RIM_WAYS;
    rim->pieces = mem_new(level->n_local, sizeof *rim->pieces);
    rim->remote = mem_new(level->n_local, sizeof *rim->remote);
    rim->sends = mem_new(most, sizeof *rim->sends);
    rim->coarse = mem_new(rim->l > 0 ? most : 0, sizeof *rim->coarse);
    for (unsigned t = 0; t < level->n_local; t++)
        for (int way = 0; way < RIM_WAYS; way++)
            if (rim_is_used(rim->mesh, way)) rim_list_way(rim, t, way);
    rim->sends = mem_grow(rim->sends, rim->n_send, rim->n_send, sizeof *rim->sends);
    rim->coarse = mem_grow(rim->coarse, rim->n_coarse, rim->n_coarse, sizeof *rim->coarse);
}

/* The fine tile from which `way` leads to the octant at `at`, leaving the domain across `outer` (-1: not at all); or
 * -1. */
static int rim_viewer(const struct rim *rim, const int at[3], int way, int outer)
{
    const struct level *fine = rim_level(rim);
    int from[3];
    for (int d = 0; d < 3; d++) {
        int step = rim_step(way, d), extent = fine->extent[d];
        from[d] = d == outer ? at[d] : at[d] - step;
        if (d == outer && (rim->mesh->periodic[d] || at[d] != (step > 0 ? extent - 1 : 0))) return -1;
        if (rim->mesh->periodic[d]) from[d] = (from[d] + extent) % extent;
        if (from[d] < 0 || from[d] >= extent) return -1;
    }
    return level_find(fine, morton_key(from));
}

/* Pieces that fine tiles have in an octant of a local coarse tile that no fine tile covers. */
static void rim_list_octant(struct rim *rim, unsigned coarse, const int at[3])
{
    const struct mesh *mesh = rim->mesh;
    for (int way = 0; way < RIM_WAYS; way++)
        for (int outer = -1; rim_is_used(mesh, way) && outer < mesh->dim; outer++) {
            if (outer >= 0 && (rim_step(way, outer) == 0 || !rim_is_given(rim, way, outer))) continue;
            int fine = rim_viewer(rim, at, way, outer);
            if (fine < 0) continue;
            if ((rim->n_source & (rim->n_source - 1)) == 0)
                rim->sources = mem_grow(rim->sources, rim->n_source, 2 * rim->n_source + 1, sizeof *rim->sources);
            struct rim_place place = rim_look(mesh, rim_level(rim), &rim_level(rim)->tiles[fine], way);
            rim_add_coarse(rim, (unsigned)fine - rim_level(rim)->first, way, &place, coarse,
                           &rim->sources[rim->n_source++]);
        }
}

static void rim_list_sources(struct rim *rim)
{
    const struct mesh *mesh = rim->mesh;
    if (rim->l == 0) return;
    const struct level *coarse = &mesh->levels[rim->l - 1];
    rim->source_from = mem_new(coarse->n_local + 1, sizeof *rim->source_from);
    for (unsigned c = 0; c < coarse->n_local; c++) {
        const struct tile *tile = &coarse->tiles[coarse->first + c];
        for (int o = 0; o < 1 << mesh->dim; o++) {
            int at[3] = {0};
            for (int d = 0; d < mesh->dim; d++) at[d] = 2 * tile->at[d] + (o >> d & 1);
            if (!(tile->covered >> o & 1)) rim_list_octant(rim, c, at);
        }
        rim->source_from[c + 1] = rim->n_source;
    }
}

static int rim_compare_sends(const void *a, const void *b)
{
    const struct rim_send *x = a, *y = b;
    if (x->to != y->to) return x->to < y->to ? -1 : 1;
    return x->way - y->way;
}

/* Tiles of one rank, which lie on one side of the own piece: their numbers rise along the curve. */
static int rim_compare_sources(const void *a, const void *b)
{
    const struct rim_coarse *x = *(struct rim_coarse *const *)a, *y = *(struct rim_coarse *const *)b;
    if (x->fine != y->fine) return x->fine < y->fine ? -1 : 1;
    return x->way - y->way;
}

static void rim_connect_same(struct rim *rim)
{
    const struct level *level = rim_level(rim);
    struct post_item *in = mem_new(rim->n_send, sizeof *in), *out = mem_new(rim->n_send, sizeof *out);
    for (unsigned t = 0; t < level->n_local; t++)
        for (int way = 0; way < RIM_WAYS; way++) {
            const struct rim_piece *piece = &rim->pieces[t][way];
            if (piece->kind == RIM_REMOTE)
                in[piece->index] = (struct post_item){.rank = level->tiles[rim->sends[piece->index].to].rank,
                                                      .doubles = rim_doubles(rim, way)};
        }
    if (rim->n_send) qsort(rim->sends, rim->n_send, sizeof *rim->sends, rim_compare_sends);
    for (unsigned i = 0; i < rim->n_send; i++)
        out[i] = (struct post_item){.rank = level->tiles[rim->sends[i].to].rank,
                                    .doubles = rim_doubles(rim, rim->sends[i].way)};
    rim->same = post_new(RIM_TAG_SAME + rim->l, rim->n_send, out, rim->n_send, in);
    mem_free(in);
    mem_free(out);
}

static bool rim_is_here(const struct level *level, unsigned local)
{
    return local < level->n_local;
}

/* Data of a piece, slot after slot. */
static void rim_place_data(const struct rim *rim, struct rim_coarse *piece, double *data)
{
    for (int slot = 0; slot < rim->form.slots; slot++)
        piece->data[slot] = data + (size_t)slot * rim_doubles(rim, piece->way);
}

/* Pieces of the coarser level: `list` in the order of the message, those whose other end is on another rank. */
static unsigned rim_away(struct rim_coarse *all, unsigned n, const struct level *other, bool fine,
                         struct rim_coarse **list)
{
    unsigned count = 0;
    for (unsigned i = 0; i < n; i++)
        if (!rim_is_here(other, fine ? all[i].fine : all[i].coarse)) list[count++] = &all[i];
    if (count) qsort(list, count, sizeof *list, rim_compare_sources);
    return count;
}

static struct post_item *rim_items(const struct rim *rim, const struct level *other, bool fine, unsigned n,
                                   struct rim_coarse *const *list)
{
    struct post_item *items = mem_new(n, sizeof *items);
    for (unsigned i = 0; i < n; i++)
        items[i] =
            (struct post_item){.rank = other->tiles[other->first + (fine ? list[i]->fine : list[i]->coarse)].rank,
                               .doubles = (size_t)rim->form.slots * rim_doubles(rim, list[i]->way)};
    return items;
}

static void rim_connect_down(struct rim *rim)
{
    if (rim->l == 0) return;
    const struct level *fine = rim_level(rim), *coarse = fine - 1;
    struct rim_coarse **out = mem_new(rim->n_source, sizeof *out), **in = mem_new(rim->n_coarse, sizeof *in);
    unsigned n_out = rim_away(rim->sources, rim->n_source, fine, true, out);
    unsigned n_in = rim_away(rim->coarse, rim->n_coarse, coarse, false, in);
    struct post_item *out_items = rim_items(rim, fine, true, n_out, out);
    struct post_item *in_items = rim_items(rim, coarse, false, n_in, in);
    rim->down = post_new(RIM_TAG_DOWN + rim->l, n_out, out_items, n_in, in_items);
    for (unsigned i = 0; i < n_out; i++) rim_place_data(rim, out[i], post_out(rim->down, i));
    for (unsigned i = 0; i < n_in; i++) rim_place_data(rim, in[i], post_in(rim->down, i));
    mem_free(out_items);
    mem_free(in_items);
    mem_free(out);
    mem_free(in);
}

/* Places the outer layers at `next` (NULL: counts only); returns the doubles they take. */
static size_t rim_place_outer(struct rim *rim, double *next)
{
    const struct level *level = rim_level(rim);
    size_t total = 0;
    for (unsigned i = 0; rim->form.given && i < level->n_local * MESH_FACES; i++) {
        int face = (int)(i % MESH_FACES);
        bool boundary = level->neighbours[i / MESH_FACES][face].kind == NEIGHBOUR_BOUNDARY;
        if (face >= 2 * rim->mesh->dim || !boundary || !(rim->form.given >> face & 1)) continue;
        const struct box box = rim_outer_box(rim, face);
        if (next) rim->outer[i] = next + total;
        total += rim->form.n_field * box_cells(&box);
    }
    return total;
}

/* The same for pieces with both tiles here. */
static size_t rim_place_coarse(struct rim *rim, double *next)
{
    size_t total = 0;
    for (unsigned i = 0; i < rim->n_coarse; i++) {
        struct rim_coarse *piece = &rim->coarse[i];
        if (!rim_is_here(rim_level(rim) - 1, piece->coarse)) continue;
        if (next) rim_place_data(rim, piece, next + total);
        total += (size_t)rim->form.slots * rim_doubles(rim, piece->way);
    }
    return total;
}

/* Memory that no message holds; both ends of a piece share it. */
static void rim_share(struct rim *rim)
{
    const struct level *level = rim_level(rim);
    size_t outer = rim_place_outer(rim, NULL);
    rim->n_shared = outer + rim_place_coarse(rim, NULL);
    rim->shared = mem_new_large(rim->n_shared, sizeof *rim->shared);
    if (rim->form.given) rim->outer = mem_new((size_t)level->n_local * MESH_FACES, sizeof *rim->outer);
    rim_place_outer(rim, rim->shared);
    rim_place_coarse(rim, rim->shared + outer);
    for (unsigned i = 0; i < rim->n_source; i++) {
        struct rim_coarse *source = &rim->sources[i];
        if (!rim_is_here(level, source->fine)) continue;
        const struct rim_piece *piece = &rim->pieces[source->fine][source->way];
        memcpy(source->data, rim->coarse[piece->index].data, sizeof source->data);
    }
}

static void rim_plan(struct rim *rim)
{
    const struct box_block tile = rim_tile(rim, NULL), block = rim_block(rim->mesh, rim->form.g, NULL);
    for (int way = 0; way < RIM_WAYS; way++) {
        const signed char step[3] = {(signed char)rim_step(way, 0), (signed char)rim_step(way, 1),
                                     (signed char)rim_step(way, 2)};
        const struct box box = rim_box(rim->mesh, rim->form.g, way);
        int shift[3];
        rim_shift(rim->mesh, step, shift);
        if (way == RIM_HERE || rim_is_used(rim->mesh, way)) rim->moves[way] = box_move(&box, &tile, shift, &block);
    }
}

static struct rim *rim_new(const struct mesh *mesh, int l, const struct rim_form *form)
{
    struct rim *rim = mem_new(1, sizeof *rim);
    *rim = (struct rim){.mesh = mesh, .l = l, .form = *form};
    rim_plan(rim);
    rim_list(rim);
    rim_list_sources(rim);
    rim_connect_same(rim);
    rim_connect_down(rim);
    rim_share(rim);
    return rim;
}

static void rim_free(struct rim *rim)
{
    post_free(rim->same);
    post_free(rim->down);
    mem_free(rim->shared);
    mem_free(rim->outer);
    mem_free(rim->sends);
    mem_free(rim->sources);
    mem_free(rim->source_from);
    mem_free(rim->coarse);
    mem_free(rim->pieces);
    mem_free(rim->remote);
    mem_free(rim);
}

struct rim **rim_shelf_new(void)
{
    return mem_new(MESH_LEVELS, sizeof(struct rim *));
}

void rim_shelf_drop(struct rim **shelf, int l)
{
    if (l >= MESH_LEVELS) return;
    while (shelf[l]) {
        struct rim *rim = shelf[l];
        shelf[l] = rim->next;
        rim_free(rim);
    }
}

void rim_shelf_free(struct rim **shelf)
{
    for (int l = 0; l < MESH_LEVELS; l++) rim_shelf_drop(shelf, l);
    mem_free(shelf);
}

static bool rim_is_form(const struct rim_form *a, const struct rim_form *b)
{
    return a->n_field == b->n_field && a->g == b->g && a->slots == b->slots && a->given == b->given &&
           a->fields == b->fields;
}

struct rim *rim_of(const struct mesh *mesh, int l, const struct rim_form *form)
{
    struct rim **place = &mesh->rims[l];
    while (*place && !rim_is_form(&(*place)->form, form)) place = &(*place)->next;
    if (!*place) *place = rim_new(mesh, l, form);
    return *place;
}

struct box_block rim_find(const struct rim *rim, double *const *arrays, unsigned local, int way, int ret_shift[3])
{
    const struct rim_piece *piece = &rim->pieces[local][way];
    const struct box box = rim_box(rim->mesh, rim->form.g, way);
    memset(ret_shift, 0, 3 * sizeof *ret_shift);
    if (piece->kind == RIM_REMOTE) return box_pack(&box, post_in(rim->same, piece->index));
    rim_shift(rim->mesh, piece->step, ret_shift);
    if (piece->outer < 0) return rim_tile(rim, arrays[piece->index]);
    return rim_outer(rim, piece->index, 2 * piece->outer + (rim_step(way, piece->outer) > 0));
}

void rim_start(struct rim *rim, double *const *arrays)
{
    for (unsigned i = 0; i < rim->n_send; i++) {
        const struct rim_send *send = &rim->sends[i];
        const struct box box = rim_box(rim->mesh, rim->form.g, send->way);
        const struct box_block to = box_pack(&box, post_out(rim->same, i));
        struct box_block from = rim_tile(rim, arrays[send->local]);
        if (send->outer >= 0)
            from = rim_outer(rim, send->local, 2 * send->outer + (rim_step(send->way, send->outer) > 0));
        box_copy(rim->form.n_field, &box, &from, send->shift, &to);
    }
    post_start(rim->same);
}

void rim_finish(struct rim *rim)
{
    post_finish(rim->same);
}

void rim_down(struct rim *rim)
{
    if (!rim->down) return;
    post_start(rim->down);
    post_finish(rim->down);
}

struct rim_bytes rim_size(const struct rim *rim)
{
    size_t same = post_volume(rim->same), down = rim->down ? post_volume(rim->down) : 0, held = rim->n_shared + down;
    for (unsigned i = 0; i < rim->n_send; i++) held += 2 * rim_doubles(rim, rim->sends[i].way);
    for (unsigned i = 0; i < rim->n_coarse; i++)
        if (!rim_is_here(rim_level(rim) - 1, rim->coarse[i].coarse))
            held += (size_t)rim->form.slots * rim_doubles(rim, rim->coarse[i].way);
    size_t lists = rim_level(rim)->n_local * sizeof *rim->pieces + rim->n_send * sizeof *rim->sends +
                   (rim->n_coarse + rim->n_source) * sizeof *rim->coarse;
    return (struct rim_bytes){same * sizeof(double), down * sizeof(double), held * sizeof(double) + lists};
}
