/* Levels of tiles against a plain picture of them: finding, neighbours, flags, where points lie, and what becomes of
 * the blocks when tiles come, go and move between ranks (program/ranks_mesh.sh starts several). */
#include "levels.h"

enum { ROUNDS = 6 };

static void each_mesh(void (*check)(struct levels *))
{
    for (int i = 0; i < LEVELS_SHAPE_COUNT; i++) {
        struct levels levels;
        levels_open(&levels, &LEVELS_SHAPES[i], 17u * (unsigned)i + 5u);
        check(&levels);
        for (int round = 0; round < ROUNDS; round++) {
            levels_refine(&levels);
            check(&levels);
        }
        levels_close_all(&levels);
    }
}

/* Own tiles and those around them are found, others may be; what is found is right. */
static void check_find(struct levels *levels)
{
    const struct mesh *mesh = levels->mesh;
    for (int l = 0; l < mesh->n_level; l++) {
        const struct level *level = &mesh->levels[l];
        unsigned found = 0, inside = 0, known = 0;
        assert_int_equal(level->n_tile, levels->counts[l]);
        for (unsigned t = 0; t < level->n_tile; t++) {
            const struct tile *tile = &levels->lists[l][t];
            int index = mesh_find(mesh, level, tile->at);
            known += index >= 0;
            assert_true(levels_has(levels, l, tile->at));
            if (levels_known(levels, l, tile->at)) assert_true(index >= 0);
            if (tile->rank == comm_rank()) assert_int_equal(index, level->first + inside++);
            if (index < 0) continue;
            assert_true(level->tiles[index].key == tile->key && level->tiles[index].rank == tile->rank);
            assert_true(!index || level->tiles[index - 1].key < tile->key);
        }
        for (size_t i = 0; i < levels_places(levels, l); i++) found += levels->maps[l][i];
        assert_int_equal(found, level->n_tile);
        assert_int_equal(known, level->n_known);
        assert_int_equal(inside, level->n_local);
        for (int i = 0; i < 200; i++) {
            int at[3] = {0, 0, 0};
            for (int d = 0; d < mesh->dim; d++)
                at[d] = (int)(levels_random(levels) % (3u * (unsigned)level->extent[d])) - level->extent[d];
            int tile = mesh_find(mesh, level, at);
            if (comm_size() == 1) assert_int_equal(tile >= 0, levels_has(levels, l, at));
            if (tile >= 0) assert_true(levels_has(levels, l, at));
            if (tile >= 0) assert_true(levels_index(levels, l, at) >= 0); /* wraps at */
            if (tile >= 0) assert_memory_equal(level->tiles[tile].at, at, sizeof at);
        }
    }
}

/* A rank of many knows little: of a plain domain in four pieces the tiles within one of its own. */
static void test_few(void **state)
{
    (void)state;
    const struct levels_shape shape = {2, {32, 32, 1}, 4, 0, {false}};
    struct levels levels;
    struct mesh_change change;
    levels_open(&levels, &shape, 7);
    unsigned n;
    struct tile *tiles = levels_list(&levels, 0, &n);
    for (unsigned i = 0; i < n; i++) tiles[i].rank = comm_size() < 4 ? 0 : (int)(4 * i / n);
    levels_give(&levels, 0, tiles, n, &change);
    mesh_change_free(&change);
    const struct level *level = &levels.mesh->levels[0];
    if (comm_size() >= 4) assert_int_equal(level->n_known, comm_rank() < 4 ? 17 * 17 : 0);
    levels_close_all(&levels);
}

static void test_find(void **state)
{
    (void)state;
    each_mesh(check_find);
}

static void check_flags(struct levels *levels)
{
    const struct mesh *mesh = levels->mesh;
    for (int l = 0; l < mesh->n_level; l++)
        for (unsigned t = 0; t < mesh->levels[l].n_known; t++) {
            const struct tile *tile = &mesh->levels[l].tiles[t];
            if (!levels_near(levels, l, tile->at, -1, 1)) continue; /* nobody here reads them */
            for (int o = 0; o < MESH_OCTANTS; o++) {
                const int below[3] = {2 * tile->at[0] + (o & 1), 2 * tile->at[1] + (o >> 1 & 1),
                                      2 * tile->at[2] + (o >> 2)};
                bool covered = o < 1 << mesh->dim && levels_has(levels, l + 1, below);
                assert_int_equal(tile->covered >> o & 1, covered);
            }
            bool hidden = levels_whole(levels, l, tile->at);
            for (int face = 0; face < 2 * mesh->dim; face++) {
                int at[3];
                if (levels_behind(levels, l, tile, face, at)) hidden = hidden && levels_whole(levels, l, at);
            }
            if (tile->rank == comm_rank()) assert_int_equal(tile->hidden, hidden); /* its owner knows */
        }
}

static void test_flags(void **state)
{
    (void)state;
    each_mesh(check_flags);
}

/* The slab behind a face: what the tile at `at` has next to it. */
static void check_slab(const struct levels *levels, int l, const struct tile *tile, int face, const double *slab)
{
    const struct mesh *mesh = levels->mesh;
    int axis = face / 2, n = mesh->n[axis];
    int ends[3] = {mesh->n[0], mesh->n[1], mesh->n[2]}, c[3];
    ends[axis] = mesh->ghosts;
    for (unsigned q = 0; q < LEVELS_FIELDS; q++)
        for (c[2] = 0; c[2] < ends[2]; c[2]++)
            for (c[1] = 0; c[1] < ends[1]; c[1]++)
                for (c[0] = 0; c[0] < ends[0]; c[0]++) {
                    int own[3] = {c[0], c[1], c[2]};
                    if (face % 2 == 0) own[axis] += n - mesh->ghosts; /* upper layers of the lower neighbour */
                    int cell = own[0] + mesh->n[0] * (own[1] + mesh->n[1] * own[2]);
                    assert_true(*slab++ == -levels_value(levels, l, tile, q, (size_t)cell));
                }
}

static void check_neighbours(struct levels *levels)
{
    const struct mesh *mesh = levels->mesh;
    for (int l = 0; l < mesh->n_level; l++) {
        const struct level *level = &mesh->levels[l];
        unsigned slab = 0, strip = 0;
        halo_start(level->halo, level->w);
        halo_finish(level->halo);
        for (unsigned t = 0; t < level->n_local; t++) {
            const struct tile *tile = &level->tiles[level->first + t];
            bool remote = false;
            for (int face = 0; face < MESH_FACES; face++) {
                const struct neighbour *neighbour = &level->neighbours[t][face];
                int at[3];
                if (face >= 2 * mesh->dim || !levels_behind(levels, l, tile, face, at)) {
                    assert_int_equal(neighbour->kind, NEIGHBOUR_BOUNDARY);
                    continue;
                }
                if (!levels_has(levels, l, at)) {
                    assert_int_equal(neighbour->kind, NEIGHBOUR_COARSE);
                    assert_int_equal(neighbour->index, strip++);
                    continue;
                }
                const struct tile *other = &level->tiles[mesh_find(mesh, level, at)];
                if (other->rank == comm_rank()) {
                    assert_int_equal(neighbour->kind, NEIGHBOUR_LOCAL);
                    assert_int_equal(neighbour->index + level->first, other - level->tiles);
                    const struct neighbour *back = &level->neighbours[neighbour->index][face ^ 1];
                    assert_true(back->kind == NEIGHBOUR_LOCAL && back->index == t);
                } else {
                    assert_int_equal(neighbour->kind, NEIGHBOUR_REMOTE);
                    assert_int_equal(neighbour->index, slab++);
                    check_slab(levels, l, other, face, halo_slab(level->halo, neighbour->index));
                    remote = true;
                }
            }
            assert_int_equal(halo_is_remote(level, t), remote);
        }
    }
}

static void test_neighbours(void **state)
{
    (void)state;
    each_mesh(check_neighbours);
}

/* Leaves tile the domain; each of their centres is located in its own cell. */
static void check_leaves(struct levels *levels)
{
    const struct mesh *mesh = levels->mesh;
    double *leaf = mem_new(mesh->n_cell, sizeof *leaf), covered = 0.0, domain = 1.0;
    for (int d = 0; d < mesh->dim; d++) domain *= mesh->upper[d] - mesh->lower[d];
    for (int l = 0; l < mesh->n_level; l++) {
        const struct level *level = &mesh->levels[l];
        double volume = level->h[0] * level->h[1] * level->h[2];
        assert_true(level->h[0] == mesh->levels[0].h[0] / (1 << l));
        for (unsigned t = 0; t < level->n_tile; t++) {
            const struct tile *tile = &levels->lists[l][t];
            double corner[3], x[3] = {0.0, 0.0, 0.0};
            int index = mesh_find(mesh, level, tile->at);
            bool own = tile->rank == comm_rank();
            if (own) mesh_leaves(mesh, &level->tiles[index], leaf);
            mesh_corner(mesh, level, tile, corner);
            for (size_t c = 0; c < mesh->n_cell; c++) {
                size_t rest = c, cell;
                int found, octant = 0;
                unsigned local;
                for (int d = 0; d < mesh->dim; d++) {
                    size_t i = rest % (size_t)mesh->n[d];
                    x[d] = corner[d] + ((double)i + 0.5) * level->h[d];
                    octant |= i >= (size_t)mesh->n[d] / 2 ? 1 << d : 0;
                    rest /= (size_t)mesh->n[d];
                }
                assert_int_equal(mesh_octant(mesh, c), octant);
                const int below[3] = {2 * tile->at[0] + (octant & 1), 2 * tile->at[1] + (octant >> 1 & 1),
                                      2 * tile->at[2] + (octant >> 2)};
                bool open = !levels_has(levels, l + 1, below), here = mesh_locate(mesh, x, &found, &local, &cell);
                if (own) assert_true(leaf[c] == (open ? 1.0 : 0.0));
                if (open) covered += volume;
                if (open) assert_int_equal(here, own);
                if (open && own) assert_true(found == l && local == (unsigned)index - level->first && cell == c);
                if (!open && here) assert_true(found > l);
            }
        }
    }
    assert_true(covered > domain * (1.0 - 1e-12) && covered < domain * (1.0 + 1e-12));
    mem_free(leaf);
}

static void test_leaves(void **state)
{
    (void)state;
    each_mesh(check_leaves);
}

/* Upper faces of the domain, and points that rounding has moved just outside, belong to the cells inside. */
static void test_corners(void **state)
{
    (void)state;
    struct levels levels;
    levels_open(&levels, &LEVELS_SHAPES[3], 1);
    const struct mesh *mesh = levels.mesh;
    const struct level *level = &mesh->levels[0];
    int found;
    size_t cell;
    unsigned local;
    if (mesh_locate(mesh, mesh->upper, &found, &local, &cell)) {
        assert_int_equal(level->tiles[level->first + local].at[0], level->extent[0] - 1);
        assert_int_equal(level->tiles[level->first + local].at[1], level->extent[1] - 1);
        assert_true(found == 0 && cell == mesh->n_cell - 1);
    } else assert_true(comm_rank() < comm_size() - 1);
    const double below[3] = {mesh->lower[0] - 1e-9, mesh->lower[1], 0.0};
    assert_int_equal(mesh_locate(mesh, below, &found, &local, &cell), comm_rank() == 0);
    if (comm_rank() == 0) assert_true(local == 0 && cell == 0);
    levels_close_all(&levels);
}

/* What a change says, and the numbers of all tiles that were there before, wherever they were. */
static void check_change(struct levels *levels, int l, const unsigned char *before, const struct mesh_change *change)
{
    const struct level *level = &levels->mesh->levels[l];
    size_t n = levels->mesh->n_cell;
    for (unsigned i = 0; i < level->n_known; i++) {
        int at[3] = {level->tiles[i].at[0], level->tiles[i].at[1], level->tiles[i].at[2]};
        assert_int_equal(change->born[i], !before[levels_index(levels, l, at)]);
    }
    for (unsigned t = 0; t < level->n_local; t++) {
        const struct tile *tile = &level->tiles[level->first + t];
        assert_true(change->from[t] >= -1 && change->from[t] < (int)change->n_before);
        if (change->born[level->first + t]) {
            assert_int_equal(change->from[t], -1);
            memset(level->u_old[t], 0, LEVELS_FIELDS * n * sizeof(double));
            memset(level->w[t], 0, LEVELS_FIELDS * n * sizeof(double));
        } else
            for (size_t i = 0; i < n * LEVELS_FIELDS; i++) {
                double value = levels_value(levels, l, tile, (unsigned)(i / n), i % n);
                assert_true(level->u_old[t][i] == value && level->w[t][i] == -value);
            }
        memset(level->u_new[t], 0xff, LEVELS_FIELDS * n * sizeof(double)); /* nobody else's block */
    }
    for (unsigned t = 0; t < level->n_local; t++)
        if (!change->born[level->first + t])
            assert_true(level->u_old[t][0] == levels_value(levels, l, &level->tiles[level->first + t], 0, 0));
}

static size_t count_blocks(const struct mesh *mesh)
{
    size_t count = 0;
    for (int l = 0; l < mesh->n_level; l++) count += 3 * (size_t)mesh->levels[l].n_local;
    return count;
}

/* Tiles come, go and move. The block of a tile that stays on its rank stays where it is. */
static void replace(struct levels *levels, int l)
{
    struct mesh *mesh = levels->mesh;
    struct level *level = &mesh->levels[l];
    size_t places = levels_places(levels, l);
    unsigned char *before = mem_new(places, 1);
    double **blocks = mem_new(level->n_local, sizeof *blocks);
    for (unsigned t = 0; t < level->n_local; t++) blocks[t] = level->u_old[t];
    if (l < mesh->n_level) memcpy(before, levels->maps[l], places);
    if (l > 0 && l == levels->shape.levels) { /* the finest level may lose any tile */
        for (size_t i = 0; i < places; i++)
            if (levels->maps[l][i] && levels_random(levels) % 3 == 0) levels->maps[l][i] = 0;
        if (!memchr(levels->maps[l], 1, places)) memcpy(levels->maps[l], before, places);
    }
    unsigned n, revision = mesh->revision;
    struct tile *tiles = levels_list(levels, l, &n);
    struct mesh_change change;
    levels_give(levels, l, tiles, n, &change);
    assert_true(mesh->revision != revision);
    check_change(levels, l, before, &change);
    for (unsigned t = 0; t < level->n_local; t++)
        if (change.from[t] >= 0) assert_ptr_equal(level->u_old[t], blocks[change.from[t]]);
    assert_int_equal(pool_used(mesh->pool), count_blocks(mesh));
    mesh_change_free(&change);
    levels_fill(levels, l);
    mem_free(blocks);
    mem_free(before);
}

static void test_moves(void **state)
{
    (void)state;
    for (int i = 0; i < LEVELS_SHAPE_COUNT; i++) {
        struct levels levels;
        levels_open(&levels, &LEVELS_SHAPES[i], 1000u + (unsigned)i);
        assert_int_equal(pool_size(levels.mesh->pool), pool_used(levels.mesh->pool));
        assert_true(mesh_bytes(levels.mesh, 2.0) == 6.0 * (double)pool_bytes(levels.mesh->pool));
        for (int round = 0; round < ROUNDS; round++) {
            levels_refine(&levels);
            assert_int_equal(pool_used(levels.mesh->pool), count_blocks(levels.mesh));
            for (int again = 0; again < 3; again++)
                for (int l = 0; l < levels.mesh->n_level; l++) replace(&levels, l);
            check_flags(&levels);
            check_neighbours(&levels);
        }
        levels_close_all(&levels);
    }
}

/* The finest level grows from nothing, goes again, and leaves its blocks to the next. */
static void test_removal(void **state)
{
    (void)state;
    struct levels levels;
    struct mesh_change change;
    levels_open(&levels, &LEVELS_SHAPES[6], 3);
    struct mesh *mesh = levels.mesh;
    size_t size = 0;
    for (int round = 0; round < 4; round++) {
        unsigned n;
        memset(levels.maps[1], 1, levels_places(&levels, 1));
        struct tile *tiles = levels_list(&levels, 1, &n);
        for (unsigned i = 0; i < n; i++) tiles[i].rank = (int)(i * (unsigned)comm_size() / n);
        levels_give(&levels, 1, tiles, n, &change);
        assert_int_equal(mesh->n_level, 2);
        assert_non_null(mesh->levels[1].link);
        for (unsigned i = 0; i < mesh->levels[1].n_known; i++) assert_true(change.born[i]);
        for (unsigned t = 0; t < mesh->levels[0].n_local; t++)
            assert_true(mesh->levels[0].tiles[mesh->levels[0].first + t].hidden);
        mesh_change_free(&change);
        if (!round) size = pool_size(mesh->pool);
        assert_int_equal(pool_size(mesh->pool), size);
        assert_int_equal(pool_used(mesh->pool), size);
        memset(levels.maps[1], 0, levels_places(&levels, 1));
        unsigned before = mesh->levels[1].n_local;
        levels_give(&levels, 1, NULL, 0, &change);
        assert_int_equal(change.n_before, before);
        mesh_change_free(&change);
        assert_int_equal(mesh->n_level, 1);
        assert_int_equal(pool_used(mesh->pool), count_blocks(mesh));
        check_flags(&levels);
    }
    levels_close_all(&levels);
}

/* Sides of tiles that can be refined. */
static void test_sides(void **state)
{
    (void)state;
    struct scene scene = {.domain = {.dim = 2, .cells = {60, 90, 1}, .cells_place = "case.yaml:5:10"},
                          .scheme = {.ghosts = SCENE_GHOSTS}};
    assert_int_equal(mesh_tile_size(&scene), 15);
    scene.mesh.levels = 2;
    assert_int_equal(mesh_tile_size(&scene), 6);
    scene.mesh.tile = 5;
    assert_int_equal(mesh_tile_size(&scene), 0);
    assert_non_null(strstr(status_text(), "case.yaml:5:10: mesh.tile: 5 cannot be refined"));
    scene.mesh.tile = 6;
    assert_int_equal(mesh_tile_size(&scene), 6);
    scene.mesh.tile = 0;
    scene.domain.cells[0] = 45;
    assert_int_equal(mesh_tile_size(&scene), 0);
    assert_non_null(strstr(status_text(), "no common even tile side"));
    scene.domain.cells[0] = scene.domain.cells[1] = 1 << 14;
    scene.mesh.levels = 12;
    assert_int_equal(mesh_tile_size(&scene), 0);
    assert_non_null(strstr(status_text(), "fewer mesh.levels"));
    scene.mesh.levels = 10;
    assert_int_equal(mesh_tile_size(&scene), 8);
}

static int run(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_find),       cmocka_unit_test(test_few),     cmocka_unit_test(test_flags),
        cmocka_unit_test(test_neighbours), cmocka_unit_test(test_leaves),  cmocka_unit_test(test_moves),
        cmocka_unit_test(test_corners),    cmocka_unit_test(test_removal), cmocka_unit_test(test_sides),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}

int main(int argc, char **argv)
{
    return levels_main(argc, argv, run);
}
