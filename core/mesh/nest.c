/* nest.c - see nest.h.
 *
 * Sets are lists of families (nest_family.h), sorted once per level and merged with lists that are sorted already;
 * nothing is looked up tile by tile, except around the fixed level, once per tile of it (nest_share.c).
 * Coordinates are halved by an arithmetic shift, which rounds down on both sides of zero: a mirrored set
 * then needs the mirrored tiles exactly, since extents above level 0 are even. */
#include "mesh/nest.h"

#include "base/comm.h"
#include "base/mem.h"
#include "base/status.h"
#include "mesh/metric.h"
#include "mesh/morton.h"
#include "mesh/nest_family.h"
#include "mesh/nest_share.h"

#include <assert.h>
#include <string.h>

/* The octants along one axis that a tag in cell i of a tile reaches: first[i] .. last[i], counted from `from`, the
 * first that any cell of the tile reaches; `count` of them in all. */
struct nest_reach {
    int from, count;
    int first[METRIC_CELLS], last[METRIC_CELLS];
};

static int nest_floor(int a, int b)
{
    return a >= 0 ? a / b : -((b - 1 - a) / b);
}

static struct nest_reach nest_reach(const struct mesh *mesh, const struct tile *tile, int d, int buffer)
{
    struct nest_reach reach = {.count = 1};
    if (d >= mesh->dim) return reach;
    int n = mesh->n[d], half = n / 2;
    assert(n % 2 == 0 && n <= METRIC_CELLS);
    int from = nest_floor(-buffer, half);
    for (int i = 0; i < n; i++) {
        reach.first[i] = nest_floor(i - buffer, half) - from;
        reach.last[i] = nest_floor(i + buffer, half) - from;
    }
    reach.from = 2 * tile->at[d] + from;
    reach.count = reach.last[n - 1] + 1;
    return reach;
}

static bool nest_is_tagged(const double *marks, size_t n)
{
    int any = 0;
    for (size_t i = 0; i < n; i++) any |= marks[i] != 0.0;
    return any;
}

/* Marks in `row` the octants along x that a row of cells reaches. */
static void nest_reach_row(const struct nest_reach *x, const double *marks, int n, unsigned char *row)
{
    memset(row, 0, (size_t)x->count);
    for (int i = 0; i < n; i++)
        if (marks[i] != 0.0) memset(row + x->first[i], 1, (size_t)(x->last[i] - x->first[i] + 1));
}

/* Marks in `octants` [z][y][x] all octants that the tags reach, row by row of cells; a row of octants behind them is
 * scratch. */
static void nest_reach_tile(const struct mesh *mesh, const struct nest_reach reach[3], const double *marks,
                            unsigned char *octants)
{
    const struct nest_reach *x = &reach[0], *y = &reach[1], *z = &reach[2];
    unsigned char *row = octants + x->count * y->count * z->count;
    for (int k = 0; k < mesh->n[2]; k++)
        for (int j = 0; j < mesh->n[1]; j++, marks += mesh->n[0]) {
            if (!nest_is_tagged(marks, (size_t)mesh->n[0])) continue;
            nest_reach_row(x, marks, mesh->n[0], row);
            for (int oz = z->first[k]; oz <= z->last[k]; oz++)
                for (int oy = y->first[j]; oy <= y->last[j]; oy++) {
                    unsigned char *to = octants + (oz * y->count + oy) * x->count;
                    for (int ox = 0; ox < x->count; ox++) to[ox] |= row[ox];
                }
        }
}

void nest_wish(const struct mesh *mesh, const struct level *level, const struct tile *tile, const double *marks,
               int buffer, struct nest_keys *keys)
{
    if (!nest_is_tagged(marks, mesh->n_cell)) return;
    struct nest_reach reach[3];
    for (int d = 0; d < 3; d++) reach[d] = nest_reach(mesh, tile, d, buffer);
    int nx = reach[0].count, ny = reach[1].count, nz = reach[2].count;
    unsigned char *octants = mem_new((size_t)(nx * (ny * nz + 1)), 1);
    nest_reach_tile(mesh, reach, marks, octants);
    for (int o = 0; o < nx * ny * nz; o++) {
        int at[3] = {reach[0].from + o % nx, reach[1].from + o / nx % ny, reach[2].from + o / nx / ny};
        uint64_t key;
        if (octants[o] && nest_family_place(mesh, level + 1, at, &key)) nest_keys_push(keys, key);
    }
    mem_free(octants);
}

/* Sorts and drops repetitions. */
static void nest_sort(struct nest_keys *keys)
{
    struct nest_families families = {0};
    for (unsigned i = 0; i < keys->n; i++) nest_family_add_tile(&families, keys->keys[i]);
    nest_family_sort(&families);
    mem_free(keys->keys);
    keys->keys = nest_family_keys(&families, &keys->n);
    keys->room = keys->n + 1;
    nest_family_free(&families);
}

void nest_join(const struct mesh *mesh, int lowest, int count, struct nest_keys *keys)
{
    for (int i = 0; i < count; i++) nest_sort(&keys[i]);
    bool mixed = nest_share_keys(mesh, lowest, count, keys);
    for (int i = 0; mixed && i < count; i++) nest_sort(&keys[i]);
}

/* May a tile of level l exist over the fixed level `base`? What it needs on the way down, and what that needs, is a
 * box that is at most one tile wider on each side than the tile it lies in: `there` says which of the 3^d around that
 * one exist or lie outside the domain. */
static bool nest_is_allowed(const struct mesh *mesh, int base, int l, uint64_t key, uint32_t there)
{
    int lo[3], hi[3], at[3];
    morton_at(key, at);
    for (int d = 0; d < 3; d++) {
        lo[d] = hi[d] = at[d];
        if (d < mesh->dim)
            for (int m = l; m > base; m--) {
                lo[d] = (lo[d] - 1) >> 1;
                hi[d] = (hi[d] + 1) >> 1;
            }
        at[d] >>= l - base;
    }
    for (int z = lo[2]; z <= hi[2]; z++)
        for (int y = lo[1]; y <= hi[1]; y++)
            for (int x = lo[0]; x <= hi[0]; x++) {
                int a = NEST_FAMILY_SELF + (x - at[0]) + 3 * (y - at[1]) + 9 * (z - at[2]);
                if (!(there >> a & 1u)) return false;
            }
    return true;
}

/* The tiles of the fixed level in which wishes lie, and what is around these. */
struct nest_ground {
    struct nest_keys places; /* sorted */
    uint32_t *there;
};

/* Their owners are asked once, for the wishes of all levels. */
static struct nest_ground nest_ground(const struct mesh *mesh, int base, const struct nest_keys *wishes)
{
    struct nest_ground ground = {0};
    for (int l = base + 1; l <= mesh->most_level; l++)
        for (unsigned i = 0; i < wishes[l].n; i++) {
            uint64_t place = wishes[l].keys[i] >> 3 * (l - base);
            if (!ground.places.n || ground.places.keys[ground.places.n - 1] != place)
                nest_keys_push(&ground.places, place);
        }
    nest_sort(&ground.places);
    ground.there = nest_share_around(mesh, base, &ground.places);
    return ground;
}

/* Wishes and places come sorted. */
static void nest_add_wishes(const struct mesh *mesh, int base, int l, const struct nest_keys *wishes,
                            const struct nest_ground *ground, struct nest_families *families)
{
    int shift = 3 * (l - base);
    for (unsigned i = 0, place = 0; i < wishes->n; i++) {
        uint64_t key = wishes->keys[i];
        while (base > 0 && ground->places.keys[place] != key >> shift) place++;
        if (base == 0 || nest_is_allowed(mesh, base, l, key, ground->there[place])) nest_family_add_tile(families, key);
    }
}

static struct tile nest_tile(uint64_t key, unsigned unwanted)
{
    struct tile tile = {.key = key, .unwanted = (unsigned char)(unwanted < UINT8_MAX ? unwanted : UINT8_MAX)};
    morton_at(key, tile.at);
    return tile;
}

/* What is used (sorted), and of what is there what has not been unwanted for too long. */
static struct nest_set nest_merge(const struct nest_keys *used, const struct tile *there, unsigned n_there,
                                  int patience)
{
    struct nest_set set = {.tiles = mem_new((size_t)used->n + n_there, sizeof *set.tiles)};
    unsigned i = 0, j = 0;
    while (i < used->n || j < n_there) {
        if (i < used->n && (j == n_there || used->keys[i] <= there[j].key)) {
            if (j < n_there && used->keys[i] == there[j].key) j++;
            set.tiles[set.n++] = nest_tile(used->keys[i++], 0);
            continue;
        }
        unsigned unwanted = there[j].unwanted + 1u;
        if ((int)unwanted < patience) set.tiles[set.n++] = nest_tile(there[j].key, unwanted);
        j++;
    }
    return set;
}

struct nest_set nest_piece(const struct mesh *mesh, int l, struct nest_families *used, int patience)
{
    struct nest_keys keys = {0};
    const struct level *level = &mesh->levels[l];
    bool exists = l < mesh->n_level;
    nest_family_sort(used);
    keys.keys = nest_family_keys(used, &keys.n);
    struct nest_set set =
        nest_merge(&keys, exists ? level->tiles + level->first : NULL, exists ? level->n_local : 0, patience);
    nest_keys_free(&keys);
    return set;
}

void nest_sets(const struct mesh *mesh, int base, const struct nest_keys *wishes, int patience,
               struct nest_set *ret_sets)
{
    struct nest_ground ground = {0};
    if (base > 0) ground = nest_ground(mesh, base, wishes);
    for (int l = mesh->most_level; l > base; l--) {
        struct nest_families families = {0};
        nest_add_wishes(mesh, base, l, &wishes[l], &ground, &families);
        if (l < mesh->most_level) nest_share_needs(mesh, l + 1, &ret_sets[l + 1], &families);
        ret_sets[l] = nest_piece(mesh, l, &families, patience);
        nest_family_free(&families);
    }
    mem_free(ground.there);
    nest_keys_free(&ground.places);
}

bool nest_same(const struct mesh *mesh, int l, const struct nest_set *set)
{
    if (l >= mesh->n_level) return set->n == 0;
    const struct level *level = &mesh->levels[l];
    if (level->n_local != set->n) return false;
    for (unsigned i = 0; i < set->n; i++)
        if (level->tiles[level->first + i].key != set->tiles[i].key) return false;
    return true;
}

static int nest_check_order(const struct mesh *mesh, int l)
{
    const struct level *level = &mesh->levels[l];
    for (unsigned i = level->first; i < level->first + level->n_local; i++) {
        const struct tile *tile = &level->tiles[i];
        const int *at = tile->at;
        bool inside = true;
        for (int d = 0; d < 3; d++) inside &= at[d] >= 0 && at[d] < mesh->levels[l].extent[d];
        const char *wrong = !inside                                     ? "outside the domain"
                            : morton_key(at) != tile->key               ? "not where its key says"
                            : i && level->tiles[i - 1].key >= tile->key ? "not in its place along the curve"
                                                                        : NULL;
        if (wrong)
            return status_fail(STATUS_RUN, "the mesh is broken: tile (%d, %d, %d) of level %d is %s", at[0], at[1],
                               at[2], l, wrong);
    }
    return STATUS_OK;
}

/* Does a tile of level l need the tile `missing` of level l - 1? */
static bool nest_is_needed_by(const struct mesh *mesh, int l, const struct tile *tile, uint64_t missing)
{
    struct nest_families needs = {0};
    bool found = false;
    nest_family_needs(mesh, l, tile, 1, &needs);
    for (unsigned i = 0; i < needs.n; i++)
        found |= needs.list[i].key == missing >> 3 && (needs.list[i].mask >> (missing & 7u) & 1u);
    nest_family_free(&needs);
    return found;
}

/* Who needs what is missing says so. */
static int nest_fail(const struct mesh *mesh, int l, uint64_t missing)
{
    const struct level *level = &mesh->levels[l];
    int at[3];
    morton_at(missing, at);
    for (const struct tile *tile = level->tiles + level->first; tile < level->tiles + level->first + level->n_local;
         tile++)
        if (nest_is_needed_by(mesh, l, tile, missing))
            return status_fail(STATUS_RUN,
                               "the mesh is broken: tile (%d, %d, %d) of level %d needs tile (%d, %d, %d) of level "
                               "%d, which does not exist",
                               tile->at[0], tile->at[1], tile->at[2], l, at[0], at[1], at[2], l - 1);
    return STATUS_OK;
}

bool nest_lacks(const struct mesh *mesh, int l, uint64_t *ret_missing)
{
    const struct level *level = &mesh->levels[l], *coarse = &mesh->levels[l - 1];
    const struct tile *tile = coarse->tiles, *end = tile + coarse->n_known;
    struct nest_families needs = {0};
    uint32_t missing = 0;
    nest_family_needs(mesh, l, level->tiles + level->first, level->n_local, &needs);
    nest_family_sort(&needs);
    for (unsigned i = 0; i < needs.n && !missing; i++) {
        uint64_t family = needs.list[i].key;
        missing = needs.list[i].mask;
        while (tile < end && tile->key >> 3 < family) tile++;
        for (; tile < end && tile->key >> 3 == family; tile++) missing &= ~(1u << (tile->key & 7u));
        if (missing) *ret_missing = family << 3 | (unsigned)__builtin_ctz(missing);
    }
    nest_family_free(&needs);
    return missing != 0;
}

/* A tile that is not there, by how it is named: that of the coarsest level first. */
struct nest_hole {
    uint64_t l, key; /* of the tile that needs it; its own */
};

/* The first hole in what this rank's pieces need; l = MESH_LEVELS: there is none. */
static struct nest_hole nest_hole(const struct mesh *mesh)
{
    struct nest_hole hole = {.l = MESH_LEVELS};
    for (int l = 1; l < mesh->n_level && hole.l == MESH_LEVELS; l++)
        if (nest_lacks(mesh, l, &hole.key)) hole.l = (uint64_t)l;
    return hole;
}

/* The first of all ranks' holes. Collective. */
static struct nest_hole nest_first_hole(struct nest_hole hole)
{
    struct nest_hole *all = mem_new((size_t)comm_size(), sizeof *all), first = hole;
    comm_join_rows(&hole.l, 2, &all->l);
    for (int rank = 0; rank < comm_size(); rank++)
        if (all[rank].l < first.l || (all[rank].l == first.l && all[rank].key < first.key)) first = all[rank];
    mem_free(all);
    return first;
}

static int nest_check_cover(const struct mesh *mesh)
{
    const int *extent = mesh->levels[0].extent;
    unsigned n = (unsigned)extent[0] * (unsigned)extent[1] * (unsigned)extent[2];
    if (mesh->levels[0].n_tile == n) return STATUS_OK;
    return status_fail(STATUS_RUN, "the mesh is broken: level 0 has %u of the %u tiles of the domain",
                       mesh->levels[0].n_tile, n);
}

int nest_check(const struct mesh *mesh)
{
    int code = nest_check_cover(mesh);
    for (int l = 0; l < mesh->n_level && !code; l++) code = nest_check_order(mesh, l);
    struct nest_hole hole = nest_hole(mesh);
    if (comm_first(code || hole.l < MESH_LEVELS) == comm_size()) return STATUS_OK;
    TRY(comm_agree(code));
    hole = nest_first_hole(hole);
    return comm_agree(nest_fail(mesh, (int)hole.l, hole.key));
}
