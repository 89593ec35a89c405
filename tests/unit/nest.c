/* Tile sets: wishes and nested sets against their definitions, on all of a small domain; mirrored and turned inputs
 * give mirrored and turned sets. Under a launcher every rank makes the sets of its piece of the curve, cut at random:
 * the definition is the replicated reference. */
#include "nest_world.h"

#include "base/status.h"
#include "mesh/carry.h"
#include "mesh/morton.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

/* Marks on level l - 1 the tiles of the 3^d octants around all marked tiles of level l. */
static void mark_needs(const struct mesh *mesh, int l, const char *tiles, char *coarse)
{
    for (size_t place = 0; place < places(mesh, l); place++) {
        int at[3];
        at_of(mesh, l, place, at);
        for (int o = 0; tiles[place] && o < 27; o++) {
            int octant[3] = {at[0] + o % 3 - 1, at[1] + o / 3 % 3 - 1, at[2] + o / 9 - 1};
            if (!settle(mesh, l, octant)) continue;
            int parent[3] = {octant[0] >> 1, octant[1] >> 1, octant[2] >> 1};
            coarse[place_of(mesh, l - 1, parent)] = 1;
        }
    }
}

static bool could_nest(const struct mesh *mesh, int base, int l, size_t place)
{
    char *needed[MOST + 1] = {0};
    for (int m = base; m <= l; m++) needed[m] = mem_new(places(mesh, m), 1);
    needed[l][place] = 1;
    for (int m = l; m > base; m--) mark_needs(mesh, m, needed[m], needed[m - 1]);
    bool all = true;
    for (size_t p = 0; p < places(mesh, base); p++) {
        int at[3];
        at_of(mesh, base, p, at);
        if (needed[base][p] && mesh_find(mesh, &mesh->levels[base], at) < 0) all = false;
    }
    for (int m = base; m <= l; m++) mem_free(needed[m]);
    return all;
}

/* The sets by their definition: ret_count[l][place] is `unwanted` + 1, 0 where there is no tile. */
static void sets_by_definition(const struct mesh *mesh, int base, char *const *wished, int patience, char **ret_count)
{
    char *set[MOST + 1] = {0};
    for (int l = mesh->most_level; l > base; l--) {
        char *used = mem_new(places(mesh, l), 1);
        set[l] = mem_new(places(mesh, l), 1);
        ret_count[l] = mem_new(places(mesh, l), 1);
        if (l < mesh->most_level) mark_needs(mesh, l + 1, set[l + 1], used);
        for (size_t p = 0; p < places(mesh, l); p++) {
            int at[3];
            at_of(mesh, l, p, at);
            int index = l < mesh->n_level ? mesh_find(mesh, &mesh->levels[l], at) : -1;
            if (used[p] || (wished[l][p] && could_nest(mesh, base, l, p))) ret_count[l][p] = 1;
            else if (index >= 0 && mesh->levels[l].tiles[index].unwanted + 1 < patience)
                ret_count[l][p] = (char)(mesh->levels[l].tiles[index].unwanted + 2);
            set[l][p] = ret_count[l][p] != 0;
        }
        mem_free(used);
    }
    for (int l = 0; l <= MOST; l++) mem_free(set[l]);
}

/* Blobs of wishes, sorted or not as they come from nest_wish and nest_join: here through the latter. */
static void draw_wishes(const struct mesh *mesh, int l, char *ret_wished)
{
    memset(ret_wished, 0, places(mesh, l));
    for (unsigned blobs = pick(3); blobs; blobs--) {
        int middle[3], size = (int)pick(3) + (l == 1);
        at_of(mesh, l, pick((unsigned)places(mesh, l)), middle);
        for (size_t p = 0; p < places(mesh, l); p++) {
            int at[3];
            at_of(mesh, l, p, at);
            bool near = true;
            for (int d = 0; d < 3; d++) near &= abs(at[d] - middle[d]) <= size;
            if (near && pick(8)) ret_wished[p] = 1;
        }
    }
}

static struct nest_keys keys_of(const struct mesh *mesh, int l, const char *wished)
{
    struct nest_keys keys = {.room = (unsigned)places(mesh, l)};
    keys.keys = mem_new(keys.room, sizeof *keys.keys);
    for (size_t p = 0; p < places(mesh, l); p++) {
        int at[3];
        at_of(mesh, l, p, at);
        if (wished[p]) keys.keys[keys.n++] = morton_key(at);
    }
    nest_join(mesh, l, 1, &keys);
    return keys;
}

static void compare_set(const struct mesh *mesh, int l, const struct nest_set *set, const char *count)
{
    unsigned expected = 0;
    for (size_t p = 0; p < places(mesh, l); p++) expected += count[p] != 0;
    assert_int_equal(set->n, expected);
    for (unsigned i = 0; i < set->n; i++) {
        const struct tile *tile = &set->tiles[i];
        assert_true(tile->key == morton_key(tile->at));
        assert_true(i == 0 || set->tiles[i - 1].key < tile->key);
        assert_int_equal(tile->unwanted + 1, count[place_of(mesh, l, tile->at)]);
    }
}

/* A number of its own for every tile of every level. */
static double number(int l, uint64_t key)
{
    return (double)((key + 1) * (uint64_t)(2 * l + 1) % 100003);
}

/* Of the finest tile of the mesh as it is at or under a place of level l. */
static double number_under(const struct mesh *mesh, int l, uint64_t key)
{
    for (int m = l; m > 0; m--, key >>= 3)
        if (m < mesh->n_level && level_find(&mesh->levels[m], key) >= 0) return number(m, key);
    return number(0, key);
}

/* Numbers carried to the pieces of new sets are those of the whole lists. */
static void compare_carried(const struct mesh *mesh, int base, const struct nest_set *pieces)
{
    struct carry before[MOST + 1] = {0};
    double *values[MOST + 1] = {0}, *carried[MOST + 1] = {0};
    for (int l = 0; l < mesh->n_level; l++) {
        const struct level *level = &mesh->levels[l];
        values[l] = mem_new(level->n_local, sizeof *values[l]);
        before[l] = (struct carry){level->n_local, level->tiles + level->first, values[l]};
        for (unsigned i = 0; i < before[l].n; i++) values[l][i] = number(l, before[l].tiles[i].key);
    }
    carry_values(mesh, base, mesh->most_level, pieces, before, carried);
    for (int l = base + 1; l <= mesh->most_level; l++)
        for (unsigned i = 0; i < pieces[l].n; i++)
            assert_true(carried[l][i] == number_under(mesh, l, pieces[l].tiles[i].key));
    for (int l = 0; l <= MOST; l++) {
        mem_free(values[l]);
        mem_free(carried[l]);
    }
}

static void regrid(struct mesh *mesh, int base, int patience, char *const *wished, struct nest_set *ret_sets)
{
    struct nest_keys wishes[MESH_LEVELS] = {0};
    for (int l = base + 1; l <= mesh->most_level; l++) wishes[l] = keys_of(mesh, l, wished[l]);
    nest_sets(mesh, base, wishes, patience, ret_sets);
    compare_carried(mesh, base, ret_sets);
    for (int l = base + 1; l <= mesh->most_level; l++) replicated_join(&ret_sets[l]);
    for (int l = base + 1; l <= mesh->most_level; l++) nest_keys_free(&wishes[l]);
}

static void check_definition(int dim, const int extent[3], unsigned periodic, int most_level)
{
    struct mesh mesh;
    mesh_make(&mesh, dim, extent, 8, periodic, most_level);
    char *wished[MOST + 1], *count[MOST + 1] = {0};
    for (int l = 0; l <= most_level; l++) wished[l] = mem_new(places(&mesh, l), 1);
    for (int round = 0; round < ROUNDS; round++) {
        int base = (int)pick((unsigned)(mesh.n_level < most_level ? mesh.n_level : most_level));
        int patience = 1 + (int)pick(3);
        for (int l = base + 1; l <= most_level; l++) draw_wishes(&mesh, l, wished[l]);
        struct nest_set sets[MESH_LEVELS] = {0};
        regrid(&mesh, base, patience, wished, sets);
        sets_by_definition(&mesh, base, wished, patience, count);
        for (int l = base + 1; l <= most_level; l++) {
            compare_set(&mesh, l, &sets[l], count[l]);
            mem_free(count[l]);
        }
        mesh_take(&mesh, base, sets);
        for (int l = base + 1; l <= most_level; l++) {
            const struct level *level = &mesh.levels[l];
            assert_true(nest_same(&mesh, l, &(struct nest_set){level->n_local, level->tiles + level->first}));
        }
        assert_int_equal(nest_check(&mesh), STATUS_OK);
    }
    for (int l = 0; l <= most_level; l++) mem_free(wished[l]);
    mesh_drop(&mesh);
}

static void test_definition(void **state)
{
    (void)state;
    for (unsigned periodic = 0; periodic < 2; periodic++) check_definition(1, (const int[]){7, 1, 1}, periodic, 4);
    for (unsigned periodic = 0; periodic < 4; periodic++) check_definition(2, (const int[]){5, 3, 1}, periodic, 3);
    for (unsigned periodic = 0; periodic < 8; periodic += 7) check_definition(3, (const int[]){2, 3, 3}, periodic, 2);
    check_definition(2, (const int[]){1, 2, 1}, 3, 3);
}

/* A tile lives as long as it is wished for, and patience regrids more; a finer one holds what it stands on. */
static void test_patience(void **state)
{
    (void)state;
    struct mesh mesh;
    mesh_make(&mesh, 1, (const int[]){8, 1, 1}, 8, 0, 2);
    char one[16] = {0}, two[32] = {0}, *wished[3] = {NULL, one, two};
    const unsigned expected[][2] = {{2, 1}, {2, 1}, {2, 1}, {2, 0}, {2, 0}, {0, 0}};
    two[13] = 1; /* needs 6 and 7 of level 1 */
    for (size_t i = 0; i < 6; i++) {
        struct nest_set sets[MESH_LEVELS] = {0};
        regrid(&mesh, 0, 3, wished, sets);
        assert_int_equal(sets[1].n, expected[i][0]);
        assert_int_equal(sets[2].n, expected[i][1]);
        mesh_take(&mesh, 0, sets);
        two[13] = 0;
    }
    assert_int_equal(mesh.n_level, 1);
    mesh_drop(&mesh);
}

/* Mirrors (bits of `how`) and turns (how >> 3: cyclic shifts of the axes) a place. */
static void transform(const struct mesh *from, int l, unsigned how, const int at[3], int ret_at[3])
{
    int dim = from->dim;
    for (int d = 0; d < 3; d++) {
        int c = how >> d & 1u && d < dim ? from->levels[l].extent[d] - 1 - at[d] : at[d];
        ret_at[d < dim ? (d + (int)(how >> 3)) % dim : d] = c;
    }
}

static void compare_transformed(const struct mesh *mesh, const struct mesh *other, unsigned how)
{
    assert_int_equal(mesh->n_level, other->n_level);
    for (int l = 1; l < mesh->n_level; l++) {
        const struct level *level = &mesh->levels[l], *image = &other->levels[l];
        assert_int_equal(level->n_tile, image->n_tile);
        for (unsigned i = 0; i < level->n_tile; i++) {
            int at[3];
            transform(mesh, l, how, level->tiles[i].at, at);
            int index = mesh_find(other, image, at);
            assert_true(index >= 0);
            assert_int_equal(image->tiles[index].unwanted, level->tiles[i].unwanted);
        }
    }
}

static void check_symmetry(int dim, const int extent[3], unsigned periodic, unsigned how)
{
    struct mesh mesh, other;
    int turned[3] = {1, 1, 1};
    unsigned wraps = 0;
    mesh_make(&mesh, dim, extent, 8, periodic, 2);
    for (int d = 0; d < dim; d++) {
        int to = (d + (int)(how >> 3)) % dim;
        turned[to] = extent[d];
        wraps |= (periodic >> d & 1u) << to;
    }
    mesh_make(&other, dim, turned, 8, wraps, 2);
    char *wished[3], *image[3];
    for (int l = 0; l < 3; l++) {
        wished[l] = mem_new(places(&mesh, l), 1);
        image[l] = mem_new(places(&mesh, l), 1);
    }
    for (int round = 0; round < ROUNDS; round++) {
        int base = (int)pick(mesh.n_level > 1 ? 2 : 1);
        for (int l = base + 1; l < 3; l++) {
            draw_wishes(&mesh, l, wished[l]);
            for (size_t p = 0; p < places(&mesh, l); p++) {
                int at[3], to[3];
                at_of(&mesh, l, p, at);
                transform(&mesh, l, how, at, to);
                image[l][place_of(&other, l, to)] = wished[l][p];
            }
        }
        struct nest_set sets[MESH_LEVELS] = {0}, images[MESH_LEVELS] = {0};
        regrid(&mesh, base, 2, wished, sets);
        regrid(&other, base, 2, image, images);
        mesh_take(&mesh, base, sets);
        mesh_take(&other, base, images);
        compare_transformed(&mesh, &other, how);
    }
    for (int l = 0; l < 3; l++) {
        mem_free(wished[l]);
        mem_free(image[l]);
    }
    mesh_drop(&mesh);
    mesh_drop(&other);
}

static void test_symmetry(void **state)
{
    (void)state;
    for (unsigned how = 1; how < 16; how++) check_symmetry(2, (const int[]){5, 4, 1}, how % 4, how);
    for (unsigned how = 1; how < 24; how += 2) check_symmetry(3, (const int[]){3, 2, 2}, how % 8, how);
}

/* Octants by looking at every cell within the buffer of every tag. */
static void check_wishes(int dim, const int extent[3], int n, unsigned periodic, int buffer)
{
    struct mesh mesh;
    mesh_make(&mesh, dim, extent, n, periodic, 1);
    struct level *level = &mesh.levels[0];
    char *expected = mem_new(places(&mesh, 1), 1);
    double *marks = mem_new(mesh.n_cell, sizeof *marks);
    struct nest_keys keys = {0};
    for (unsigned t = 0; t < level->n_tile; t++) {
        memset(marks, 0, mesh.n_cell * sizeof *marks);
        for (unsigned tags = pick(4); tags; tags--) {
            size_t cell = pick((unsigned)mesh.n_cell), at[3] = {cell % (size_t)n, cell / (size_t)n, 0};
            at[2] = dim == 3 ? at[1] / (size_t)n : 0;
            at[1] = dim > 1 ? at[1] % (size_t)n : 0;
            marks[cell] = 1.0;
            int span = 2 * buffer + 1, sy = dim > 1 ? span : 1, sz = dim > 2 ? span : 1;
            for (int i = 0; i < span * sy * sz; i++) {
                int off[3] = {i % span - buffer, dim > 1 ? i / span % sy - buffer : 0,
                              dim > 2 ? i / span / sy - buffer : 0};
                int octant[3] = {0};
                bool inside = true;
                for (int d = 0; d < dim; d++) {
                    int cells = extent[d] * n, c = level->tiles[t].at[d] * n + (int)at[d] + off[d];
                    if (mesh.periodic[d]) c = (c % cells + cells) % cells;
                    inside &= c >= 0 && c < cells;
                    octant[d] = c / (n / 2);
                }
                if (inside) expected[place_of(&mesh, 1, octant)] = 1;
            }
        }
        nest_wish(&mesh, level, &level->tiles[t], marks, buffer, &keys);
    }
    nest_join(&mesh, 1, 1, &keys);
    whole(&keys);
    unsigned count = 0;
    for (size_t p = 0; p < places(&mesh, 1); p++) count += expected[p] != 0;
    assert_int_equal(keys.n, count);
    for (unsigned i = 0; i < keys.n; i++) {
        int at[3];
        morton_at(keys.keys[i], at);
        assert_true(expected[place_of(&mesh, 1, at)]);
    }
    nest_keys_free(&keys);
    mem_free(expected);
    mem_free(marks);
    mesh_drop(&mesh);
}

static void test_wishes(void **state)
{
    (void)state;
    const int buffers[] = {0, 1, 4, 5, 9};
    for (size_t b = 0; b < 5; b++)
        for (unsigned periodic = 0; periodic < 2; periodic++) {
            check_wishes(1, (const int[]){6, 1, 1}, 64, periodic, buffers[b]);
            check_wishes(2, (const int[]){3, 5, 1}, 16, 3 * periodic, buffers[b]);
            check_wishes(2, (const int[]){3, 5, 1}, 4, 2 * periodic, buffers[b]);
            check_wishes(3, (const int[]){2, 1, 3}, 8, 5 * periodic, buffers[b]);
        }
    check_wishes(2, (const int[]){40, 2, 1}, 4, 0, 64);
}

static void refused(struct mesh *mesh, const char *words)
{
    assert_int_equal(nest_check(mesh), STATUS_RUN);
    if (!strstr(status_text(), words)) fail_msg("%s\ndoes not say: %s", status_text(), words);
}

static void test_broken(void **state)
{
    (void)state;
    at_home = true;
    struct mesh mesh;
    mesh_make(&mesh, 2, (const int[]){4, 4, 1}, 8, 0, 2);
    char *wished[3];
    for (int l = 0; l < 3; l++) wished[l] = mem_new(places(&mesh, l), 1);
    wished[2][place_of(&mesh, 2, (const int[]){6, 9, 0})] = 1; /* needs (2..3, 4..5) of level 1 */
    struct nest_set sets[MESH_LEVELS] = {0};
    regrid(&mesh, 0, 1, wished, sets);
    mesh_take(&mesh, 0, sets);
    assert_int_equal(nest_check(&mesh), STATUS_OK);
    struct level *level = &mesh.levels[1];
    assert_int_equal(level->n_tile, 4);
    struct tile last = level->tiles[3];
    unsigned n_local = level->n_local, n_known = level->n_known;
    level->n_tile = 3;
    level->n_local -= n_local > 0;
    level->n_known -= n_known > 0;
    refused(&mesh, "tile (6, 9, 0) of level 2 needs tile (3, 5, 0) of level 1");
    level->n_tile = 4;
    level->n_local = n_local;
    level->n_known = n_known;
    level->tiles[3].at[1] = 8;
    refused(&mesh, "tile (3, 8, 0) of level 1 is outside the domain");
    level->tiles[3].at[1] = 6;
    refused(&mesh, "not where its key says");
    level->tiles[3] = level->tiles[2];
    refused(&mesh, "tile (2, 5, 0) of level 1 is not in its place");
    level->tiles[3] = last;
    assert_int_equal(nest_check(&mesh), STATUS_OK);
    mesh.levels[0].n_tile--;
    refused(&mesh, "level 0 has 15 of the 16 tiles");
    at_home = false;
    for (int l = 0; l < 3; l++) mem_free(wished[l]);
    mesh_drop(&mesh);
}

/* Every rank brings its own keys, one that all have, and repetitions; cuts go through the middle of them. */
static void test_join(void **state)
{
    (void)state;
    unsigned rank = (unsigned)comm_rank(), size = (unsigned)comm_size();
    struct nest_keys keys = {.n = 2 * rank + 2, .room = 2 * rank + 2};
    keys.keys = mem_new(keys.room, sizeof *keys.keys);
    for (unsigned i = 0; i < 2 * rank + 1; i++) keys.keys[i] = (1ull << 60) - 1 + (uint64_t)rank * (i % (rank + 1));
    keys.keys[2 * rank + 1] = 5;
    struct mesh mesh = {.n_level = 1};
    mesh.levels[0].n_rank = (int)size;
    mesh.levels[0].first_keys = mem_new(size, sizeof *mesh.levels[0].first_keys);
    for (unsigned r = 1; r < size; r++) mesh.levels[0].first_keys[r] = ((1ull << 60) - 1 + 2 * (r - 1)) >> 3;
    nest_join(&mesh, 1, 1, &keys);
    whole(&keys);
    unsigned count = 1, most = (size - 1) * (size - 1);
    for (unsigned key = 0; key <= most; key++) {
        bool brought = false;
        for (unsigned r = 0; r < size; r++) brought |= key == 0 || (r && key % r == 0 && key / r <= r);
        if (!brought) continue;
        assert_true(count < keys.n && keys.keys[count] == (1ull << 60) - 1 + key);
        count++;
    }
    assert_int_equal(keys.n, count);
    assert_true(keys.keys[0] == 5);
    nest_keys_free(&keys);
    nest_join(&mesh, 1, 1, &keys);
    assert_int_equal(keys.n, 0);
    nest_keys_free(&keys);
    level_drop(&mesh.levels[0]);
}

int main(int argc, char **argv)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_join),     cmocka_unit_test(test_wishes),   cmocka_unit_test(test_definition),
        cmocka_unit_test(test_patience), cmocka_unit_test(test_symmetry), cmocka_unit_test(test_broken),
    };
    comm_init(&argc, &argv);
    seed = 3;
    int failed = cmocka_run_group_tests(tests, NULL, NULL);
    comm_done();
    return failed;
}
