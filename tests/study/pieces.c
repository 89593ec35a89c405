/* pieces.c - see pieces.h. Of messages only what travels is left out: lists of the sender are made by it, and taken by
 * the receiver, as in core/mesh/nest_share.c. */
#include "pieces.h"

#include "../unit/replicated.h"
#include "base/mem.h"
#include "base/swap.h"
#include "io/leaves.h"
#include "io/nodes.h"
#include "mesh/carry.h"
#include "mesh/deal.h"
#include "mesh/fringe.h"
#include "mesh/level.h"
#include "mesh/nest_share.h"

#include <malloc.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

/* What has come for a rank. */
struct pieces_mail {
    unsigned n, room;
    struct nest_family *list;
};

/* A rank at work. */
struct pieces_rank {
    struct nest_set sets[MESH_LEVELS];
    struct pieces_mail mail;
    double seconds, least, bytes, messages, held, files;
};

enum { PIECES_REPEATS = 3 }; /* the machine is shared: the least counts */

struct pieces_world {
    struct mesh *mesh;
    int size;
    struct pieces_rank *ranks;
    unsigned (*first)[MESH_LEVELS]; /* [size + 1] first tile of each rank on each level */
};

static double pieces_clock(void)
{
    struct timespec now;
    clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &now);
    return (double)now.tv_sec + 1e-9 * (double)now.tv_nsec;
}

/* The mesh as rank r sees it. */
static void pieces_be(const struct pieces_world *world, int r)
{
    for (int l = 0; l < world->mesh->n_level; l++) {
        world->mesh->levels[l].first = world->first[r][l];
        world->mesh->levels[l].n_local = world->first[r + 1][l] - world->first[r][l];
    }
}

static struct pieces_world pieces_start(struct study *study, int size)
{
    struct pieces_world world = {&study->mesh, size, mem_new((size_t)size, sizeof *world.ranks),
                                 mem_new((size_t)size + 1, sizeof *world.first)};
    for (int l = 0; l < study->mesh.n_level; l++) {
        struct level *level = &study->mesh.levels[l];
        mem_free(level->first_keys);
        level->n_rank = size;
        level->first_keys = replicated_first(level->tiles, level->n_tile, size);
        unsigned i = 0;
        for (int r = 0; r <= size; r++) {
            while (i < level->n_tile && level->tiles[i].rank < r) i++;
            world.first[r][l] = i;
        }
    }
    return world;
}

/* One rank again, which has all. */
static void pieces_stop(struct pieces_world *world)
{
    for (int l = 0; l < world->mesh->n_level; l++) {
        struct level *level = &world->mesh->levels[l];
        level->first = 0;
        level->n_local = level->n_tile;
        level->n_rank = 1;
        level->first_keys[0] = 0;
    }
    mem_free(world->ranks);
    mem_free(world->first);
}

static void pieces_post(struct pieces_mail *mail, const struct nest_family *family)
{
    if (mail->n == mail->room) {
        unsigned room = 2 * mail->room + 8;
        mail->list = mem_grow(mail->list, mail->room, room, sizeof *mail->list);
        mail->room = room;
    }
    mail->list[mail->n++] = *family;
}

/* Each rank tells the others what its tiles of level l need of level l - 1. */
static void pieces_needs(struct pieces_world *world, int l)
{
    struct span span = span_of(world->mesh, l - 1);
    for (int r = 0; r < world->size; r++) world->ranks[r].mail.n = 0;
    for (int r = 0; r < world->size; r++) {
        struct pieces_rank *rank = &world->ranks[r];
        struct nest_families needs = {0};
        int *to, last = r;
        pieces_be(world, r);
        double start = pieces_clock();
        nest_family_needs(world->mesh, l, rank->sets[l].tiles, rank->sets[l].n, &needs);
        nest_family_sort(&needs);
        struct nest_families dealt = nest_share_deal(&span, &needs, &to);
        rank->seconds += pieces_clock() - start;
        for (unsigned i = 0; i < dealt.n; i++) {
            pieces_post(&world->ranks[to[i]].mail, &dealt.list[i]);
            rank->bytes += to[i] != r ? sizeof *dealt.list : 0.0;
            rank->messages += to[i] != r && to[i] != last;
            last = to[i];
        }
        mem_free(to);
        nest_family_free(&dealt);
        nest_family_free(&needs);
    }
}

/* Wishes are where they are answered for; `from` and `to` in the list of all. */
static void pieces_wishes(const struct nest_keys *wishes, const struct span *span, int r, unsigned *from,
                          struct nest_families *families)
{
    for (; *from < wishes->n && span_holds(span, r, wishes->keys[*from]); ++*from)
        nest_family_add_tile(families, wishes->keys[*from]);
}

static void pieces_sets(struct pieces_world *world, int l, const struct nest_keys *wishes)
{
    struct span span = span_of(world->mesh, l);
    unsigned from = 0;
    if (l + 1 < world->mesh->n_level) pieces_needs(world, l + 1);
    for (int r = 0; r < world->size; r++) {
        struct pieces_rank *rank = &world->ranks[r];
        struct nest_families families = {0};
        pieces_be(world, r);
        double start = pieces_clock();
        pieces_wishes(wishes, &span, r, &from, &families);
        if (l + 1 < world->mesh->n_level) nest_share_take(&span, r, rank->mail.list, rank->mail.n, &families);
        rank->sets[l] = nest_piece(world->mesh, l, &families, 2);
        rank->seconds += pieces_clock() - start;
        if (!nest_same(world->mesh, l, &rank->sets[l])) {
            printf("rank %d makes another piece of level %d\n", r, l);
            exit(1);
        }
        nest_family_free(&families);
    }
}

/* Costs carried. */
static void pieces_carry(struct pieces_world *world, const struct study *study)
{
    int n_level = world->mesh->n_level;
    for (int r = 0; r < world->size; r++) {
        struct carry before[MESH_LEVELS] = {0};
        double *carried[MESH_LEVELS] = {0};
        pieces_be(world, r);
        double start = pieces_clock();
        for (int l = 0; l < n_level; l++) {
            const struct level *level = &world->mesh->levels[l];
            before[l] = (struct carry){level->n_local, level->tiles + level->first, study->costs[l] + level->first};
        }
        carry_values(world->mesh, 0, n_level - 1, world->ranks[r].sets, before, carried);
        for (int l = 0; l < n_level; l++) mem_free(carried[l]);
        world->ranks[r].seconds += pieces_clock() - start;
    }
}

/* Appends what a rank tells at a regrid from level `base`. */
static void pieces_append(struct deal *all, const struct deal *own, uint64_t *load)
{
    if (all->n + own->n > all->room) {
        all->runs = mem_grow(all->runs, all->room, 2 * (all->n + own->n), sizeof *all->runs);
        all->room = 2 * (all->n + own->n);
    }
    if (own->n) memcpy(all->runs + all->n, own->runs, own->n * sizeof *own->runs);
    all->n += own->n;
    *load = own->load;
}

/* Runs of all ranks as they come to rank 0, and their loads. */
static struct deal pieces_runs(const struct study *study, int base, int size, uint64_t *load)
{
    struct deal all = {.base = base, .subcycle = true};
    unsigned at[MESH_LEVELS] = {0};
    for (int r = 0; r < size; r++) {
        struct deal own = {.base = base, .subcycle = true};
        for (int l = 0; l < study->mesh.n_level; l++) {
            const struct level *level = &study->mesh.levels[l];
            unsigned from = at[l];
            while (at[l] < level->n_tile && level->tiles[at[l]].rank == r) at[l]++;
            deal_add(&own, l, study->costs[l] + from, at[l] - from);
        }
        pieces_append(&all, &own, &load[r]);
        deal_free(&own);
    }
    all.n_level = study->mesh.n_level;
    return all;
}

/* What rank 0 does for all at a regrid from level `base`: they wait. */
static double pieces_cut(const struct study *study, int base, int size, unsigned *ret_runs)
{
    uint64_t *before = mem_new((size_t)size, sizeof *before), *load = mem_new((size_t)size, sizeof *load);
    struct deal all = pieces_runs(study, base, size, before);
    double least = HUGE_VAL;
    for (int repeat = 0; repeat < PIECES_REPEATS; repeat++) {
        struct deal deal = {.base = base, .subcycle = true, .n_level = study->mesh.n_level};
        memcpy(load, before, (size_t)size * sizeof *load);
        double start = pieces_clock();
        deal_share(&deal, all.runs, all.n, size, load);
        least = fmin(least, pieces_clock() - start);
        deal_free(&deal);
    }
    *ret_runs = all.n;
    deal_free(&all);
    mem_free(before);
    mem_free(load);
    return least;
}

static void pieces_cuts(const struct study *study, int size, struct pieces *pieces)
{
    unsigned runs = 0;
    for (int b = study->mesh.n_level - 2; b >= 0; b--) pieces->cut[b] = pieces_cut(study, b, size, &runs);
    pieces->joined = (double)runs * sizeof(struct deal_run) +
                     2.0 * (double)size * sizeof(uint64_t) + /* their number, and what the rank has */
                     (double)study->mesh.n_level * size * (sizeof(uint32_t) + sizeof(uint64_t));
}

/* What the ranks tell each other of their tiles, by who gets it. */
struct pieces_fringe {
    struct swap *got; /* [size] */
    unsigned *room;   /* of items */
};

static void pieces_deliver(struct pieces_fringe *all, int from, int to, const struct fringe_item *item)
{
    struct swap *got = &all->got[to];
    if (got->n == all->room[to]) {
        all->room[to] = 2 * got->n + 8;
        got->items = mem_grow(got->items, got->n, all->room[to], sizeof *item);
    }
    ((struct fringe_item *)got->items)[got->n++] = *item;
    if (got->n_piece && got->pieces[got->n_piece - 1].rank == from) {
        got->pieces[got->n_piece - 1].n++;
        return;
    }
    if ((got->n_piece & (got->n_piece - 1)) == 0)
        got->pieces = mem_grow(got->pieces, got->n_piece, 2 * got->n_piece + 1, sizeof *got->pieces);
    got->pieces[got->n_piece++] = (struct swap_piece){from, 1};
}

static struct pieces_fringe pieces_tell(struct pieces_world *world)
{
    struct pieces_fringe all = {mem_new((size_t)world->size, sizeof *all.got),
                                mem_new((size_t)world->size, sizeof *all.room)};
    for (int r = 0; r < world->size; r++) {
        struct pieces_rank *rank = &world->ranks[r];
        struct swap_list fringe = {0};
        pieces_be(world, r);
        double start = pieces_clock();
        for (int l = 0; l < world->mesh->n_level; l++) fringe_list(world->mesh, l, r, &fringe);
        fringe_sort(&fringe);
        rank->seconds += pieces_clock() - start;
        const struct fringe_item *items = fringe.items;
        for (unsigned i = 0; i < fringe.n; i++) {
            pieces_deliver(&all, r, fringe.to[i], &items[i]);
            rank->messages += !i || fringe.to[i] != fringe.to[i - 1];
        }
        rank->bytes += (double)fringe.n * sizeof *items;
        swap_list_free(&fringe);
    }
    return all;
}

/* Bytes of the numbered cells of n tiles. */
static double pieces_blocks(const struct mesh *mesh, const struct tile *tiles, unsigned n)
{
    double blocks = 0.0;
    for (unsigned t = 0; t < n; t++) {
        blocks += !tiles[t].covered;
        for (int o = 0; tiles[t].covered && o < 1 << mesh->dim; o++) blocks += !(tiles[t].covered >> o & 1);
    }
    return blocks * sizeof(struct leaves_block);
}

/* Lists of what a rank knows, the flags that follow, and the check. Flags must be those of a rank that knows all. */
static void pieces_know(struct pieces_world *world, int r, const struct swap *got)
{
    struct pieces_rank *rank = &world->ranks[r];
    struct mesh known = *world->mesh;
    uint64_t missing;
    pieces_be(world, r);
    double start = pieces_clock();
    rank->held = 0.0;
    for (int l = 0; l < known.n_level; l++) {
        struct level *level = &known.levels[l];
        *level = world->mesh->levels[l];
        level->slots = (struct slots){0};
        level->tiles = fringe_merge(&world->mesh->levels[l], l, r, got, &level->n_known);
        level->first = 0;
        while (level->n_local && level->tiles[level->first].rank < r) level->first++;
        level_tabulate(level);
        rank->held += (double)level->n_known * sizeof *level->tiles;
    }
    for (int l = 0; l < known.n_level; l++) level_cover(&known, l);
    for (int l = 1; l < known.n_level; l++)
        if (nest_lacks(&known, l, &missing)) exit(1);
    rank->seconds += pieces_clock() - start;
    rank->files = 0.0;
    for (int l = 0; l < known.n_level; l++) {
        const struct level *level = &known.levels[l], *all = &world->mesh->levels[l];
        rank->files += (double)level->n_known * sizeof(struct nodes_tile) +
                       pieces_blocks(&known, level->tiles + level->first, level->n_local);
        for (unsigned t = 0; t < level->n_local; t++) {
            const struct tile *own = &level->tiles[level->first + t], *same = &all->tiles[all->first + t];
            if (own->covered == same->covered && own->hidden == same->hidden) continue;
            printf("rank %d knows too little of level %d\n", r, l);
            exit(1);
        }
        slots_done(&known.levels[l].slots);
        mem_free(level->tiles);
    }
}

static void pieces_fringes(struct pieces_world *world)
{
    struct pieces_fringe all = pieces_tell(world);
    for (int r = 0; r < world->size; r++) {
        pieces_know(world, r, &all.got[r]);
        swap_done(&all.got[r]);
    }
    mem_free(all.got);
    mem_free(all.room);
}

/* All that ranks do with their own pieces, once. */
static void pieces_run(struct pieces_world *world, const struct study *study, const struct nest_keys *wishes)
{
    int n_level = world->mesh->n_level;
    for (int r = 0; r < world->size; r++)
        world->ranks[r].seconds = world->ranks[r].bytes = world->ranks[r].messages = 0.0;
    for (int l = n_level - 1; l > 0; l--) pieces_sets(world, l, &wishes[l]);
    pieces_carry(world, study);
    pieces_fringes(world);
    for (int r = 0; r < world->size; r++) {
        struct pieces_rank *rank = &world->ranks[r];
        if (rank->least == 0.0 || rank->seconds < rank->least) rank->least = rank->seconds;
        for (int l = 1; l < n_level; l++) nest_keys_free_set(&rank->sets[l]);
    }
}

struct pieces pieces_regrid(struct study *study, int size)
{
    struct mesh *mesh = &study->mesh;
    struct pieces pieces = {0};
    struct nest_keys wishes[MESH_LEVELS] = {0};
    for (int l = 1; l < mesh->n_level; l++) wishes[l] = sets_wishes(&study->scene, mesh, l);
    pieces_cuts(study, size, &pieces);
    struct pieces_world world = pieces_start(study, size);
    mallopt(M_MXFAST, 0); /* else a rank now and then pays for sorting what thousands have freed */
    for (int repeat = 0; repeat < PIECES_REPEATS; repeat++) pieces_run(&world, study, wishes);
    for (int r = 0; r < size; r++) {
        struct pieces_rank *rank = &world.ranks[r];
        pieces.mean += rank->least / size;
        pieces.most = fmax(pieces.most, rank->least);
        pieces.bytes = fmax(pieces.bytes, rank->bytes);
        pieces.messages = fmax(pieces.messages, rank->messages);
        pieces.held = fmax(pieces.held, rank->held);
        pieces.files = fmax(pieces.files, rank->files);
        mem_free(rank->mail.list);
    }
    for (int l = 0; l < mesh->n_level; l++) {
        nest_keys_free(&wishes[l]);
        pieces.table += (double)size * sizeof(uint64_t);
        pieces.files_of_all += (double)mesh->levels[l].n_tile * (sizeof(struct tile) + sizeof(size_t)) +
                               pieces_blocks(mesh, mesh->levels[l].tiles, mesh->levels[l].n_tile);
    }
    pieces_stop(&world);
    return pieces;
}
