/* link.c - see link.h. Each rank lists both ends it holds: the faces of its fine tiles, and the faces that look at
 * its coarse tiles, found from the covered octants. Both ends of a message list their faces in the order (fine
 * tile, face) and their octants in the order of the fine tiles. */
#include "mesh/link.h"

#include "base/comm.h"
#include "base/mem.h"
#include "mesh/level.h"
#include "mesh/morton.h"
#include "mesh/post.h"

#include <stdlib.h>

struct link_own {
    struct post *down, *up;
    struct post *late[MESH_LEVELS + 1]; /* of tiles that sleep, by their depth, from 1 on */
    double *shared;                     /* strips and registers of faces with both tiles here */
};

/* A link being made. */
struct link_draft {
    const struct mesh *mesh;
    const struct level *fine, *coarse;
    struct link *link;
    unsigned room;   /* for sources */
    unsigned n_away; /* sources whose fine tile is on another rank, */
    unsigned *away;  /* sorted by (fine tile, face) */
    bool nested;     /* no coarse tile was missing so far */
    struct post_item *out, *in;
    unsigned n_out, n_in;
};

/* The patch of coarse cells in an octant that a fine tile looks at through its face. */
static void link_patch(const struct mesh *mesh, int octant, struct link_face *face)
{
    int axis = face->face / 2;
    for (int d = 0; d < 3; d++) face->from[d] = d < mesh->dim ? (octant >> d & 1) * mesh->n[d] / 2 : 0;
    face->layer = face->from[axis];
    if (face->face % 2) return;
    face->layer += mesh->n[axis] / 2 - 1;
    face->from[axis] = face->layer + 1 - link_depth(mesh);
}

/* Lists of known tiles change with other levels than those of a link: what it keeps is counted from the first local
 * tile on. */
static unsigned link_local(const struct level *level, int tile)
{
    return (unsigned)tile - level->first;
}

static const struct tile *link_tile(const struct level *level, unsigned local)
{
    return &level->tiles[level->first + local];
}

/* The coarse tile above a place of the fine level. */
static unsigned link_above(struct link_draft *draft, uint64_t key)
{
    int coarse = level_find(draft->coarse, key >> 3);
    if (coarse < 0) draft->nested = false;
    return link_local(draft->coarse, coarse);
}

static void link_list_faces(struct link_draft *draft)
{
    const struct level *fine = draft->fine;
    struct link *link = draft->link;
    for (unsigned t = 0; t < fine->n_local; t++)
        for (int face = 0; face < MESH_FACES; face++)
            if (fine->neighbours[t][face].kind == NEIGHBOUR_COARSE) link->n_face++;
    link->faces = mem_new(link->n_face, sizeof *link->faces);
    for (unsigned t = 0; t < fine->n_local; t++)
        for (int face = 0; face < MESH_FACES; face++) {
            const struct neighbour *neighbour = &fine->neighbours[t][face];
            if (neighbour->kind != NEIGHBOUR_COARSE) continue;
            int at[3];
            level_step(draft->mesh, fine, link_tile(fine, t), face, at);
            uint64_t key = morton_key(at);
            struct link_face *entry = &link->faces[neighbour->index];
            *entry = (struct link_face){.key = link_tile(fine, t)->key,
                                        .fine = t,
                                        .coarse = link_above(draft, key),
                                        .face = face};
            link_patch(draft->mesh, (int)(key & 7u), entry);
        }
}

static void link_list_children(struct link_draft *draft)
{
    const struct level *fine = draft->fine;
    struct link *link = draft->link;
    link->n_child = fine->n_local;
    link->children = mem_new(fine->n_local, sizeof *link->children);
    for (unsigned t = 0; t < fine->n_local; t++) {
        uint64_t key = link_tile(fine, t)->key;
        struct link_child *child = &link->children[t];
        *child = (struct link_child){.fine = t, .coarse = link_above(draft, key), .octant = (int)(key & 7u)};
        if (draft->nested) child->sleeps = link_tile(draft->coarse, child->coarse)->sleeps;
    }
}

static void link_list_octants(struct link_draft *draft)
{
    const struct level *coarse = draft->coarse;
    struct link *link = draft->link;
    link->octant_from = mem_new(coarse->n_local + 1, sizeof *link->octant_from);
    for (unsigned c = 0; c < coarse->n_local; c++) {
        unsigned covered = link_tile(coarse, c)->covered;
        link->octant_from[c + 1] = link->octant_from[c] + (unsigned)__builtin_popcount(covered);
    }
    link->n_octant = link->octant_from[coarse->n_local];
    link->octants = mem_new(link->n_octant, sizeof *link->octants);
    unsigned count = 0;
    for (unsigned c = 0; c < coarse->n_local; c++) {
        const struct tile *tile = link_tile(coarse, c);
        for (unsigned o = 0; o < MESH_OCTANTS; o++)
            if (tile->covered >> o & 1u)
                link->octants[count++] =
                    (struct link_child){.fine = link_local(draft->fine, level_find(draft->fine, tile->key << 3 | o)),
                                        .coarse = c,
                                        .octant = (int)o,
                                        .sleeps = tile->sleeps};
    }
}

static int link_compare_faces(const void *a, const void *b)
{
    const struct link_face *x = a, *y = b;
    if (x->key != y->key) return x->key < y->key ? -1 : 1;
    return x->face - y->face;
}

static void link_add_source(struct link_draft *draft, struct link_face source, int octant)
{
    struct link *link = draft->link;
    if (link->n_source == draft->room) {
        draft->room = 2 * draft->room + 64;
        link->sources = mem_grow(link->sources, link->n_source, draft->room, sizeof *link->sources);
    }
    link_patch(draft->mesh, octant, &source);
    link->sources[link->n_source++] = source;
}

/* The coarse tile behind a face of local tile c, or NULL. */
static const struct tile *link_beside(const struct link_draft *draft, unsigned c, int face)
{
    const struct level *coarse = draft->coarse;
    const struct neighbour *neighbour = &coarse->neighbours[c][face];
    if (neighbour->kind == NEIGHBOUR_LOCAL) return link_tile(coarse, neighbour->index);
    if (neighbour->kind != NEIGHBOUR_REMOTE) return NULL;
    return &coarse->tiles[level_behind(draft->mesh, coarse, link_tile(coarse, c), face)];
}

/* Faces of fine tiles, on the side `face` of each, that look at octants of local coarse tile c which no fine tile
 * covers. The octant that holds the fine tile differs along the axis: in the same tile or in the one beside it. */
static void link_look(struct link_draft *draft, unsigned c, int face)
{
    const struct tile *tile = link_tile(draft->coarse, c);
    const struct tile *beside = link_beside(draft, c, face ^ 1);
    unsigned bit = 1u << face / 2;
    for (unsigned o = 0; o < 1u << draft->mesh->dim; o++) {
        if (tile->covered >> o & 1u) continue;
        bool inside = ((o & bit) != 0) == (face % 2 == 1); /* looking up at an upper octant, or down at a lower one */
        const struct tile *holder = inside ? tile : beside;
        if (!holder || !(holder->covered >> (o ^ bit) & 1u)) continue;
        uint64_t key = holder->key << 3 | (o ^ bit);
        unsigned fine = link_local(draft->fine, level_find(draft->fine, key));
        link_add_source(draft, (struct link_face){.key = key, .fine = fine, .coarse = c, .face = face}, (int)o);
    }
}

static void link_list_sources(struct link_draft *draft)
{
    const struct level *coarse = draft->coarse;
    struct link *link = draft->link;
    unsigned char whole = level_whole(draft->mesh);
    link->source_from = mem_new(coarse->n_local + 1, sizeof *link->source_from);
    for (unsigned c = 0; c < coarse->n_local; c++) {
        unsigned from = link->source_from[c];
        if (link_tile(coarse, c)->covered != whole)
            for (int face = 0; face < 2 * draft->mesh->dim; face++) link_look(draft, c, face);
        link->source_from[c + 1] = link->n_source;
        if (link->n_source > from)
            qsort(link->sources + from, link->n_source - from, sizeof *link->sources, link_compare_faces);
    }
}

static bool link_here(const struct level *level, unsigned local)
{
    return local < level->n_local;
}

static void link_sort_away(struct link_draft *draft)
{
    const struct link *link = draft->link;
    struct link_away {
        struct link_face face;
        unsigned source;
    } *list = mem_new(link->n_source, sizeof *list);
    for (unsigned i = 0; i < link->n_source; i++)
        if (!link_here(draft->fine, link->sources[i].fine))
            list[draft->n_away++] = (struct link_away){link->sources[i], i};
    qsort(list, draft->n_away, sizeof *list, link_compare_faces);
    draft->away = mem_new(draft->n_away, sizeof *draft->away);
    for (unsigned i = 0; i < draft->n_away; i++) draft->away[i] = list[i].source;
    mem_free(list);
}

static void link_add_out(struct link_draft *draft, const struct level *level, unsigned local, size_t doubles)
{
    draft->out[draft->n_out++] = (struct post_item){.rank = link_tile(level, local)->rank, .doubles = doubles};
}

static void link_add_in(struct link_draft *draft, const struct level *level, unsigned local, size_t doubles)
{
    draft->in[draft->n_in++] = (struct post_item){.rank = link_tile(level, local)->rank, .doubles = doubles};
}

static struct post *link_post(struct link_draft *draft, int tag)
{
    struct post *post = post_new(tag + draft->link->fine_level, draft->n_out, draft->out, draft->n_in, draft->in);
    draft->n_out = draft->n_in = 0;
    return post;
}

/* Averages that travel of coarse tiles that sleep so deep, or, at 0, of those that do not. */
static void link_add_averages(struct link_draft *draft, int depth)
{
    const struct link *link = draft->link;
    size_t average = draft->mesh->n_field * link->octant_cells;
    for (unsigned i = 0; i < link->n_child; i++)
        if (link->children[i].sleeps == depth && !link_here(draft->coarse, link->children[i].coarse))
            link_add_out(draft, draft->coarse, link->children[i].coarse, average);
    for (unsigned i = 0; i < link->n_octant; i++)
        if (link->octants[i].sleeps == depth && !link_here(draft->fine, link->octants[i].fine))
            link_add_in(draft, draft->fine, link->octants[i].fine, average);
}

static void link_connect(struct link_draft *draft, struct link_own *own)
{
    const struct link *link = draft->link;
    const struct level *fine = draft->fine, *coarse = draft->coarse;
    size_t flux = link->n_register * link->face_cells;
    draft->out = mem_new((size_t)link->n_face + link->n_child + draft->n_away, sizeof *draft->out);
    draft->in = mem_new((size_t)link->n_face + link->n_octant + draft->n_away, sizeof *draft->in);
    for (unsigned i = 0; i < draft->n_away; i++)
        link_add_out(draft, fine, link->sources[draft->away[i]].fine, 2 * link->strip_doubles);
    for (unsigned i = 0; i < link->n_face; i++)
        if (!link_here(draft->coarse, link->faces[i].coarse))
            link_add_in(draft, coarse, link->faces[i].coarse, 2 * link->strip_doubles);
    own->down = link_post(draft, POST_DOWN);
    for (unsigned i = 0; i < link->n_face; i++)
        if (!link_here(draft->coarse, link->faces[i].coarse)) link_add_out(draft, coarse, link->faces[i].coarse, flux);
    for (unsigned i = 0; i < draft->n_away; i++) link_add_in(draft, fine, link->sources[draft->away[i]].fine, flux);
    link_add_averages(draft, 0);
    own->up = link_post(draft, POST_UP);
    for (int depth = 1; depth <= link->fine_level; depth++) {
        link_add_averages(draft, depth);
        own->late[depth] = link_post(draft, POST_LATE);
    }
    mem_free(draft->out);
    mem_free(draft->in);
}

static void link_place(const struct link *link, struct link_face *face, double *strips, double *flux)
{
    face->strip[0] = strips;
    face->strip[1] = strips + link->strip_doubles;
    face->flux = flux;
}

/* Memory of the faces, in their order, remote ones in the posts; then of the sources. */
static void link_store_faces(struct link_draft *draft, struct link_own *own)
{
    struct link *link = draft->link;
    size_t strips = 2 * link->strip_doubles, room = strips + link->n_register * link->face_cells;
    unsigned away = 0, shared = 0;
    for (unsigned i = 0; i < link->n_face; i++) shared += link_here(draft->coarse, link->faces[i].coarse);
    double *next = own->shared = mem_new_large(shared * room, sizeof *own->shared);
    for (unsigned i = 0; i < link->n_face; i++) {
        struct link_face *face = &link->faces[i];
        if (!link_here(draft->coarse, face->coarse)) {
            link_place(link, face, post_in(own->down, away), post_out(own->up, away));
            away++;
            continue;
        }
        link_place(link, face, next, next + strips);
        next += room;
    }
    for (unsigned i = 0; i < draft->n_away; i++)
        link_place(link, &link->sources[draft->away[i]], post_out(own->down, i), post_in(own->up, i));
    for (unsigned i = 0; i < link->n_source; i++) {
        struct link_face *source = &link->sources[i];
        if (!link_here(draft->fine, source->fine)) continue;
        unsigned index = draft->fine->neighbours[source->fine][source->face].index;
        link_place(link, source, link->faces[index].strip[0], link->faces[index].flux);
    }
}

/* Averages follow the registers in the messages up, or have messages of their own. */
static void link_store_averages(struct link_draft *draft, struct link_own *own)
{
    struct link *link = draft->link;
    unsigned out = 0, in = draft->n_away, late_out[MESH_LEVELS + 1] = {0}, late_in[MESH_LEVELS + 1] = {0};
    for (unsigned i = 0; i < link->n_face; i++) out += !link_here(draft->coarse, link->faces[i].coarse);
    for (unsigned i = 0; i < link->n_child; i++) {
        struct link_child *child = &link->children[i];
        if (link_here(draft->coarse, child->coarse)) continue;
        unsigned depth = child->sleeps;
        child->average = depth ? post_out(own->late[depth], late_out[depth]++) : post_out(own->up, out++);
    }
    for (unsigned i = 0; i < link->n_octant; i++) {
        struct link_child *child = &link->octants[i];
        if (link_here(draft->fine, child->fine)) continue;
        unsigned depth = child->sleeps;
        child->average = depth ? post_in(own->late[depth], late_in[depth]++) : post_in(own->up, in++);
    }
}

/* Coarse tiles with ends on other ranks. */
static void link_list_waits(struct link_draft *draft)
{
    struct link *link = draft->link;
    link->waits = mem_new(draft->coarse->n_local, sizeof *link->waits);
    for (unsigned i = 0; i < link->n_octant; i++)
        if (!link->octants[i].sleeps && !link_here(draft->fine, link->octants[i].fine))
            link->waits[link->octants[i].coarse] = true;
    for (unsigned i = 0; i < draft->n_away; i++) link->waits[link->sources[draft->away[i]].coarse] = true;
}

static void link_store(struct link_draft *draft)
{
    struct link_own *own = draft->link->own;
    link_sort_away(draft);
    link_connect(draft, own);
    link_store_faces(draft, own);
    link_store_averages(draft, own);
    link_list_waits(draft);
    mem_free(draft->away);
}

struct link *link_new(const struct mesh *mesh, int fine_level)
{
    struct link *link = mem_new(1, sizeof *link);
    struct link_draft draft = {.mesh = mesh,
                               .fine = &mesh->levels[fine_level],
                               .coarse = &mesh->levels[fine_level - 1],
                               .link = link,
                               .nested = true};
    link->fine_level = fine_level;
    link->n_register = mesh->n_field + mesh->n_face_u;
    link->face_cells = link->octant_cells = 1;
    for (int d = 0; d < mesh->dim; d++) link->octant_cells *= (size_t)mesh->n[d] / 2;
    link->face_cells = link->octant_cells / ((size_t)mesh->n[0] / 2);
    link->strip_doubles = mesh->n_field * 2 * (size_t)link_depth(mesh) * mesh->n_cell / (size_t)mesh->n[0];
    link->own = mem_new(1, sizeof(struct link_own));
    link_list_faces(&draft);
    link_list_children(&draft);
    if (draft.nested) {
        link_list_octants(&draft);
        link_list_sources(&draft);
        link_store(&draft);
        return link;
    }
    link_free(link);
    return NULL;
}

void link_free(struct link *link)
{
    if (!link) return;
    struct link_own *own = link->own;
    post_free(own->down);
    post_free(own->up);
    for (int depth = 1; depth <= link->fine_level; depth++) post_free(own->late[depth]);
    mem_free(own->shared);
    mem_free(own);
    mem_free(link->faces);
    mem_free(link->source_from);
    mem_free(link->sources);
    mem_free(link->children);
    mem_free(link->octant_from);
    mem_free(link->octants);
    mem_free(link->waits);
    mem_free(link);
}

void link_down(struct link *link)
{
    struct link_own *own = link->own;
    post_start(own->down);
    post_finish(own->down);
}

void link_up_start(struct link *link)
{
    struct link_own *own = link->own;
    post_start(own->up);
}

void link_up_finish(struct link *link)
{
    struct link_own *own = link->own;
    post_finish(own->up);
}

void link_up(struct link *link)
{
    link_up_start(link);
    link_up_finish(link);
}

void link_up_late(struct link *link, int depth)
{
    struct link_own *own = link->own;
    post_start(own->late[depth]);
    post_finish(own->late[depth]);
}
