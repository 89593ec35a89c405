/* halo.c - slabs of face neighbours, packed for a post (post.h).
 *
 * The order of slabs in the message from A to B is that of (receiving tile, receiving face).
 * B numbered its remote faces in just that order; A finds it by sorting what it sends. */
#include "mesh/halo.h"

#include "base/mem.h"
#include "mesh/level.h"
#include "mesh/post.h"

#include <stdlib.h>
#include <string.h>

/* One slab to pack: face `face` of the local tile, for the tile `to` (index in the level's list). */
struct halo_send {
    unsigned local;
    int face;
    unsigned to;
};

struct halo {
    const struct mesh *mesh;
    unsigned n_field, n_send;
    struct halo_send *sends; /* sorted by receiving tile, receiving face */
    struct post *post;
};

static int halo_compare(const void *a, const void *b)
{
    const struct halo_send *x = a, *y = b;
    if (x->to != y->to) return x->to < y->to ? -1 : 1;
    return (x->face ^ 1) - (y->face ^ 1);
}

static struct post_item halo_item(const struct halo *halo, const struct level *level, const struct halo_send *send)
{
    const struct mesh *mesh = halo->mesh;
    size_t cells = mesh->n_cell / (size_t)mesh->n[send->face / 2] * (size_t)mesh->ghosts;
    return (struct post_item){.rank = level->tiles[send->to].rank, .doubles = halo->n_field * cells};
}

/* What this rank sends, in the order of its own tiles and faces: that in which it receives, as adjacency is
 * symmetric. */
static void halo_list(struct halo *halo, const struct level *level)
{
    const struct mesh *mesh = halo->mesh;
    halo->sends = mem_new((size_t)level->n_local * MESH_FACES, sizeof *halo->sends);
    for (unsigned t = 0; t < level->n_local; t++)
        for (int face = 0; face < 2 * mesh->dim; face++) {
            if (level->neighbours[t][face].kind != NEIGHBOUR_REMOTE) continue;
            int other = level_behind(mesh, level, &level->tiles[level->first + t], face);
            halo->sends[halo->n_send++] = (struct halo_send){.local = t, .face = face, .to = (unsigned)other};
        }
}

struct halo *halo_new(const struct mesh *mesh, const struct level *level, unsigned n_field)
{
    struct halo *halo = mem_new(1, sizeof *halo);
    halo->mesh = mesh;
    halo->n_field = n_field;
    halo_list(halo, level);
    unsigned n = halo->n_send;
    struct post_item *in = mem_new(n, sizeof *in), *out = mem_new(n, sizeof *out);
    for (unsigned i = 0; i < n; i++) in[i] = halo_item(halo, level, &halo->sends[i]);
    qsort(halo->sends, n, sizeof *halo->sends, halo_compare);
    for (unsigned i = 0; i < n; i++) out[i] = halo_item(halo, level, &halo->sends[i]);
    halo->post = post_new(POST_HALO + (int)(level - mesh->levels), n, out, n, in);
    mem_free(in);
    mem_free(out);
    return halo;
}

void halo_free(struct halo *halo)
{
    if (!halo) return;
    post_free(halo->post);
    mem_free(halo->sends);
    mem_free(halo);
}

/* The layers next to a face: the first or last of the axis. */
static void halo_pack(const struct halo *halo, const double *array, int face, double *slab)
{
    const struct mesh *mesh = halo->mesh;
    int axis = face / 2, n = mesh->n[axis];
    size_t inner = 1;
    for (int d = 0; d < axis; d++) inner *= (size_t)mesh->n[d];
    size_t outer = mesh->n_cell / inner / (size_t)n;
    size_t skip = face % 2 ? (size_t)(n - mesh->ghosts) * inner : 0, length = (size_t)mesh->ghosts * inner;
    for (size_t block = 0; block < halo->n_field * outer; block++)
        memcpy(slab + block * length, array + block * inner * (size_t)n + skip, length * sizeof *slab);
}

void halo_start(struct halo *halo, double *const *arrays)
{
    for (unsigned i = 0; i < halo->n_send; i++)
        halo_pack(halo, arrays[halo->sends[i].local], halo->sends[i].face, post_out(halo->post, i));
    post_start(halo->post);
}

void halo_finish(struct halo *halo)
{
    post_finish(halo->post);
}

const double *halo_slab(const struct halo *halo, unsigned index)
{
    return post_in(halo->post, index);
}

bool halo_is_remote(const struct level *level, unsigned local)
{
    for (int face = 0; face < MESH_FACES; face++)
        if (level->neighbours[local][face].kind == NEIGHBOUR_REMOTE) return true;
    return false;
}
