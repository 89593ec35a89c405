/* Patches against a plain picture: every cell around every tile of random nested levels is what a slow recipe says that
 * looks each cell up by itself, bitwise, on any number of ranks (program/ranks_mesh.sh starts several). Linear fields
 * come out linear through all edges and corners, and the exchange of x and y keeps all bits. */
#include "levels.h"

#include "levels/prolong_rim.h"
#include "scheme/patch.h"

#include <math.h>

enum { ROUNDS = 2 }; /* of new levels and owners */

static unsigned char parity_of[] = {0, PATCH_X | PATCH_VELOCITY, PATCH_X | PATCH_Y};
static int weight_of[] = {-1, 0, -1};

/* What is being gathered. */
static struct {
    struct levels *levels;
    enum patch_rule rules[MESH_FACES];
    int now; /* 0 or 1: the beginning or the end of the coarse steps */
    double theta;
    bool linear, symmetric;
} world;

/* Number of cells of a level along an axis. */
static int cells_of(int l, int axis)
{
    const struct mesh *mesh = world.levels->mesh;
    return mesh->levels[l].extent[axis] * mesh->n[axis];
}

/* Noise in [0, 1) of a cell. */
static double noise(int l, const int x[3], unsigned q)
{
    uint64_t z = (uint64_t)(x[0] + 64) + 4096u * (uint64_t)(x[1] + 64) + 16777216u * (uint64_t)(x[2] + 64);
    z = (z * 31 + q) * 31 + (uint64_t)(3 * l + world.now);
    z = (z ^ z >> 30) * 0xbf58476d1ce4e5b9u;
    z = (z ^ z >> 27) * 0x94d049bb133111ebu;
    return (double)((z ^ z >> 31) >> 11) * 0x1p-53;
}

/* The value of field q in a cell; also behind given boundaries. */
static double value(int l, const int x[3], unsigned q)
{
    static const double slopes[][3] = {{0.3, -0.2, 0.5}, {-1.0, 0.7, 0.25}, {0.4, 0.1, -0.6}};
    double sum = 7.0 + (double)q + 0.5 * world.now, h = 1.0 / (1 << l);
    if (world.symmetric) { /* u_x(x, y) = u_y(y, x), the others are the same */
        int turned[3] = {x[1], x[0], x[2]};
        return q == 2 ? noise(l, turned, 1) : q == 1 ? noise(l, x, 1) : noise(l, x, 0) + noise(l, turned, 0);
    }
    for (int d = 0; d < world.levels->shape.dim; d++) sum += slopes[q][d] * (x[d] + 0.5) * h;
    return world.linear ? sum : sum + 0.4 * noise(l, x, q);
}

static double expected(int l, const int x[3], unsigned q);

static double minmod(double a, double b)
{
    return a * b <= 0.0 ? 0.0 : fabs(a) < fabs(b) ? a : b;
}

/* The child at x of the coarse cell above; no slope across `outer`. */
static double child(int l, const int x[3], unsigned q, int outer)
{
    int c[3];
    double slope[3] = {0.0};
    for (int d = 0; d < 3; d++) c[d] = d < world.levels->shape.dim ? (int)floor(0.5 * x[d]) : 0;
    double middle = expected(l - 1, c, q);
    for (int d = 0; d < world.levels->shape.dim; d++) {
        int up[3] = {c[0], c[1], c[2]}, down[3] = {c[0], c[1], c[2]};
        up[d]++;
        down[d]--;
        if (d != outer) slope[d] = 0.25 * minmod(middle - expected(l - 1, down, q), expected(l - 1, up, q) - middle);
        if (x[d] % 2 == 0) slope[d] = -slope[d];
    }
    return middle + ((slope[1] + slope[0]) + slope[2]);
}

/* Between the two ends of the coarse step. */
static double from_coarse(int l, const int x[3], unsigned q, int outer)
{
    double ends[2], weights[2] = {0.0, 0.0};
    int now = world.now;
    for (world.now = 0; world.now < 2; world.now++) {
        ends[world.now] = child(l, x, q, outer);
        if (weight_of[q] >= 0) weights[world.now] = child(l, x, (unsigned)weight_of[q], outer);
    }
    world.now = now;
    double theta = world.theta, late = theta * weights[1], all = (1.0 - theta) * weights[0] + late;
    if (!(theta > 0.0)) return ends[0];
    return ends[0] + (weight_of[q] >= 0 ? late / all : theta) * (ends[1] - ends[0]);
}

static bool has_tile(int l, const int x[3])
{
    int at[3];
    for (int d = 0; d < 3; d++) at[d] = x[d] / world.levels->mesh->n[d];
    return levels_has(world.levels, l, at);
}

/* What stands in cell x of level l, in the domain or behind its boundaries. */
static double expected(int l, const int cell[3], unsigned q)
{
    int x[3] = {cell[0], cell[1], cell[2]}, out[3], n_out = 0;
    for (int d = 0; d < world.levels->shape.dim; d++) {
        int n = cells_of(l, d);
        if (world.levels->shape.periodic[d]) x[d] = (x[d] + n) % n;
        if (x[d] < 0 || x[d] >= n) out[n_out++] = d;
    }
    if (n_out == 0) return has_tile(l, x) ? value(l, x, q) : from_coarse(l, x, q, -1);
    double sum = 0.0;
    for (int e = 0; e < n_out; e++) {
        int axis = out[e], side = x[axis] > 0, edge = side ? cells_of(l, axis) - 1 : 0;
        enum patch_rule rule = world.rules[2 * axis + side];
        int inside[3] = {x[0], x[1], x[2]};
        inside[axis] = edge;
        if (rule == PATCH_GIVEN && n_out == 1) return has_tile(l, inside) ? value(l, x, q) : from_coarse(l, x, q, axis);
        sum += rule == PATCH_GIVEN ? expected(l, inside, q) : 0.0;
        if (rule == PATCH_GIVEN) continue;
        if (rule != PATCH_COPY) inside[axis] = 2 * edge + (side ? 1 : -1) - x[axis];
        bool turned =
            rule == PATCH_NO_SLIP ? parity_of[q] & PATCH_VELOCITY : rule != PATCH_COPY && parity_of[q] >> axis & 1;
        return turned ? -expected(l, inside, q) : expected(l, inside, q);
    }
    return sum / n_out;
}

static void cell_of(const struct tile *tile, int i, int j, int k, int ret_x[3])
{
    const int local[3] = {i, j, k};
    for (int d = 0; d < 3; d++) ret_x[d] = tile->at[d] * world.levels->mesh->n[d] + local[d];
}

/* Gives level l the values of now. */
static void fill(int l)
{
    const struct mesh *mesh = world.levels->mesh;
    const struct level *level = &mesh->levels[l];
    for (unsigned t = 0; t < level->n_local; t++)
        for (size_t c = 0; c < mesh->n_cell * LEVELS_FIELDS; c++) {
            int x[3], cell = (int)(c % mesh->n_cell), n0 = mesh->n[0], n1 = mesh->n[1];
            cell_of(&level->tiles[level->first + t], cell % n0, cell / n0 % n1, cell / n0 / n1, x);
            level->w[t][c] = value(l, x, (unsigned)(c / mesh->n_cell));
        }
}

/* The outer layers, from the same function. data: the level. */
static void give(void *data, unsigned local, int face, const struct box_block *ret)
{
    const struct level *level = data;
    int l = (int)(level - world.levels->mesh->levels);
    assert_int_equal(world.rules[face], PATCH_GIVEN);
    for (unsigned q = 0; q < LEVELS_FIELDS; q++)
        for (size_t c = 0; c < ret->pitch; c++) {
            int x[3], i = (int)(c % ret->size[0]), j = (int)(c / ret->size[0] % ret->size[1]);
            cell_of(&level->tiles[level->first + local], ret->from[0] + i, ret->from[1] + j,
                    ret->from[2] + (int)(c / ret->size[0] / ret->size[1]), x);
            ret->data[q * ret->pitch + c] = value(l, x, q);
        }
}

static struct patch_source source_of(int l, int g)
{
    const struct mesh *mesh = world.levels->mesh;
    struct patch_source source = {.mesh = mesh,
                                  .level = &mesh->levels[l],
                                  .arrays = mesh->levels[l].w,
                                  .parity = parity_of,
                                  .weight = weight_of,
                                  .given = give,
                                  .data = &world.levels->mesh->levels[l]};
    memcpy(source.rules, world.rules, sizeof source.rules);
    const struct rim_form form = {LEVELS_FIELDS, g, 2, patch_given(source.rules), NULL};
    source.rim = rim_of(mesh, l, &form);
    assert_ptr_equal(rim_of(mesh, l, &form), source.rim);
    return source;
}

/* Both ends of a step, coarse levels first, as a run would. */
static void exchange(int g)
{
    struct mesh *mesh = world.levels->mesh;
    for (world.now = 0; world.now < 2; world.now++)
        for (int l = 0; l < mesh->n_level; l++) {
            struct patch_source source = source_of(l, g);
            if (l > 0) mesh->levels[l].link->theta = world.theta;
            fill(l);
            patch_start(&source);
            patch_finish(&source);
            if (l + 1 == mesh->n_level) break;
            struct rim *fine = source_of(l + 1, g).rim;
            prolong_rim(&source, fine, world.now, NULL);
            rim_down(fine);
        }
    world.now = 1;
}

typedef void patch_check(int l, const struct tile *tile, const struct box_block *patch);

static void each_patch(int g, patch_check *check)
{
    const struct mesh *mesh = world.levels->mesh;
    struct box_block patch = rim_block(mesh, g, NULL);
    exchange(g);
    patch.data = mem_new(LEVELS_FIELDS * patch.pitch, sizeof *patch.data);
    for (int l = 0; l < mesh->n_level; l++) {
        const struct patch_source source = source_of(l, g);
        for (unsigned t = 0; t < source.level->n_local; t++) {
            for (size_t c = 0; c < LEVELS_FIELDS * patch.pitch; c++) patch.data[c] = (double)NAN;
            patch_gather(&source, t, patch.data);
            check(l, &source.level->tiles[source.level->first + t], &patch);
        }
    }
    mem_free(patch.data);
}

static long long checked[3]; /* cells: all, on the coarser level, behind two boundaries or more */

static void count(int l, const int x[3])
{
    int out = 0, behind[3] = {x[0], x[1], x[2]};
    checked[0]++;
    for (int d = 0; d < world.levels->shape.dim; d++) {
        int n = cells_of(l, d);
        if (world.levels->shape.periodic[d]) behind[d] = (x[d] + n) % n;
        out += behind[d] < 0 || behind[d] >= n;
    }
    checked[2] += out > 1;
    checked[1] += out == 0 && !has_tile(l, behind);
}

static void check_recipe(int l, const struct tile *tile, const struct box_block *patch)
{
    for (unsigned q = 0; q < LEVELS_FIELDS; q++)
        for (size_t c = 0; c < patch->pitch; c++) {
            int x[3], i = (int)(c % patch->size[0]), j = (int)(c / patch->size[0] % patch->size[1]);
            cell_of(tile, patch->from[0] + i, patch->from[1] + j,
                    patch->from[2] + (int)(c / patch->size[0] / patch->size[1]), x);
            double got = patch->data[q * patch->pitch + c], wanted = expected(l, x, q);
            if (got != wanted)
                fail_msg("level %d, cell (%d, %d, %d), field %u: %.17g, not %.17g", l, x[0], x[1], x[2], q, got,
                         wanted);
            count(l, x);
        }
}

/* Slopes of the coarser cells of three layers look at a third one: within an octant if it has so many. */
static int most_layers(void)
{
    return world.levels->mesh->n[0] < 6 ? 2 : RIM_LAYERS;
}

/* Random rules on all faces, then given ones only; one, two and three layers. */
static void test_recipe(void **state)
{
    (void)state;
    for (int i = 0; i < LEVELS_SHAPE_COUNT; i++) {
        struct levels levels;
        levels_open(&levels, &LEVELS_SHAPES[i], 91u * (unsigned)i + 3u);
        world.levels = &levels;
        for (int round = 0; round <= ROUNDS; round++) {
            levels_refine(&levels);
            for (int face = 0; face < MESH_FACES; face++)
                world.rules[face] = round < ROUNDS ? (enum patch_rule)(levels_random(&levels) % 4) : PATCH_GIVEN;
            world.theta = 0.3 * round;
            for (int g = 1; g <= most_layers(); g++) each_patch(g, check_recipe);
        }
        levels_close_all(&levels);
    }
    print_message("%lld cells, %lld of them on the coarser level, %lld behind two boundaries or more\n", checked[0],
                  checked[1], checked[2]);
    if (comm_size() == 1) assert_true(checked[1] > 10000 && checked[2] > 1000);
}

/* Does a coarse slope beside the cell see a boundary? Behind it a copy is no linear field. */
static bool is_near_edge(int l, const int x[3])
{
    for (int d = 0; d < world.levels->shape.dim; d++)
        if (x[d] < 4 || x[d] >= cells_of(l, d) - 4) return true;
    return false;
}

static void check_linear(int l, const struct tile *tile, const struct box_block *patch)
{
    for (unsigned q = 0; q < LEVELS_FIELDS; q++)
        for (size_t c = 0; c < patch->pitch; c++) {
            int x[3], i = (int)(c % patch->size[0]), j = (int)(c / patch->size[0] % patch->size[1]);
            cell_of(tile, patch->from[0] + i, patch->from[1] + j,
                    patch->from[2] + (int)(c / patch->size[0] / patch->size[1]), x);
            if (is_near_edge(l, x) || (weight_of[q] >= 0 && world.theta > 0.0)) continue;
            double wanted = value(l, x, q);
            if (!has_tile(l, x)) wanted += 0.5 * (world.theta - 1.0); /* linear in time too; levels end at 1 */
            assert_true(fabs(patch->data[q * patch->pitch + c] - wanted) < 1e-13 * 50.0);
            count(l, x);
        }
}

/* Tiles of 8 and 16, and of an odd half. */
static const struct levels_shape SMOOTH[] = {
    {1, {6, 1, 1}, 16, 2, {false}}, {2, {4, 5, 1}, 8, 2, {false}}, {2, {3, 3, 1}, 16, 2, {false}},
    {2, {4, 3, 1}, 10, 2, {false}}, {3, {3, 3, 2}, 8, 1, {false}}, {3, {2, 3, 2}, 16, 1, {false}},
};

/* In space, and in time those that count with no weight. */
static void test_linear(void **state)
{
    (void)state;
    world.linear = true;
    for (size_t i = 0; i < sizeof SMOOTH / sizeof *SMOOTH; i++) {
        struct levels levels;
        levels_open(&levels, &SMOOTH[i], 7u * (unsigned)i + 1u);
        world.levels = &levels;
        memset(world.rules, 0, sizeof world.rules);
        memset(checked, 0, sizeof checked);
        for (int round = 0; round < ROUNDS; round++) {
            levels_refine(&levels);
            world.theta = 0.25 * round;
            for (int g = 1; g <= most_layers(); g++) each_patch(g, check_linear);
        }
        if (comm_size() == 1) assert_true(checked[0] > checked[1] && checked[1] > 0);
        levels_close_all(&levels);
    }
    world.linear = false;
}

/* Levels that do not change when x and y are exchanged. */
static void refine_symmetric(struct levels *levels)
{
    struct mesh_change change;
    levels_draw(levels);
    for (int l = 1; l <= levels->shape.levels; l++) {
        for (size_t i = 0; i < levels_places(levels, l); i++) {
            int at[3];
            levels_at(levels, l, i, at);
            int turned[3] = {at[1], at[0], at[2]};
            if (levels->maps[l][i]) levels->maps[l][levels_index(levels, l, turned)] = 1;
        }
        unsigned n;
        if (!memchr(levels->maps[l], 1, levels_places(levels, l))) return;
        struct tile *tiles = levels_list(levels, l, &n);
        levels_give(levels, l, tiles, n, &change);
        mesh_change_free(&change);
    }
}

static double *kept[2048]; /* patches of a level by place */

static void keep_patch(int l, const struct tile *tile, const struct box_block *patch)
{
    int at[3] = {tile->at[0], tile->at[1], tile->at[2]};
    double **place = &kept[512 * l + levels_index(world.levels, l, at)];
    *place = mem_new(LEVELS_FIELDS * patch->pitch, sizeof **place);
    memcpy(*place, patch->data, LEVELS_FIELDS * patch->pitch * sizeof **place);
}

static void check_turned(int l, const struct tile *tile, const struct box_block *patch)
{
    int at[3] = {tile->at[1], tile->at[0], tile->at[2]};
    const double *other = kept[512 * l + levels_index(world.levels, l, at)];
    size_t n = patch->size[0];
    if (!other) return; /* on another rank */
    for (unsigned q = 0; q < LEVELS_FIELDS; q++)
        for (size_t c = 0; c < patch->pitch; c++) {
            size_t i = c % n, j = c / n % n, k = c / n / n, turned = q == 0 ? 0 : 3 - q;
            assert_true(patch->data[q * patch->pitch + c] == other[turned * patch->pitch + (k * n + i) * n + j]);
            checked[l > 0]++;
        }
}

/* Fields 1 and 2 are components of a vector along x and y here. */
static void test_symmetric(void **state)
{
    (void)state;
    static const struct levels_shape shapes[] = {{2, {3, 3, 1}, 8, 2, {false}}, {3, {2, 2, 3}, 4, 1, {false}}};
    world.symmetric = true;
    world.theta = 0.6;
    parity_of[2] = PATCH_Y | PATCH_VELOCITY;
    weight_of[1] = -1;
    memset(checked, 0, sizeof checked);
    for (int s = 0; s < 2; s++)
        for (unsigned rules = 0; rules < 64; rules++) {
            struct levels levels;
            levels_open(&levels, &shapes[s], rules);
            world.levels = &levels;
            refine_symmetric(&levels);
            for (int face = 0; face < MESH_FACES; face++)
                world.rules[face] = (enum patch_rule)(rules >> 2 * (face < 4 ? face % 2 : 2) & 3u);
            each_patch(2, keep_patch);
            each_patch(2, check_turned);
            for (size_t i = 0; i < sizeof kept / sizeof *kept; i++) {
                mem_free(kept[i]);
                kept[i] = NULL;
            }
            levels_close_all(&levels);
        }
    world.symmetric = false;
    if (comm_size() == 1) assert_true(checked[1] > 10000);
}

static int run(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(test_recipe), cmocka_unit_test(test_linear),
                                       cmocka_unit_test(test_symmetric)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}

int main(int argc, char **argv)
{
    return levels_main(argc, argv, run);
}
