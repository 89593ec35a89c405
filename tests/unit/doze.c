/* How deep tiles sleep, on 1 to 4 ranks with random owners, beside the definition; and what travels when: averages of
 * coarse tiles that sleep so deep, and no others. */
#include "levels.h"

enum { DOZE_ROUNDS = 8, DOZE_UNSET = -1 };

/* Does a condition hold at a place and at all others at most `reach` steps along axes away, in the domain? */
static bool around(const struct levels *levels, int l, const int at[3], int reach,
                   bool (*holds)(const struct levels *levels, int l, const int at[3]))
{
    for (int way = 0; way < 27; way++) {
        int there[3], steps = 0;
        bool flat = true;
        for (int d = 0, rest = way; d < 3; d++, rest /= 3) {
            there[d] = at[d] + rest % 3 - 1;
            steps += rest % 3 != 1;
            flat = flat && (d < levels->shape.dim || rest % 3 == 1);
        }
        if (!flat || steps > reach || levels_index(levels, l, there) < 0) continue;
        if (!holds(levels, l, there)) return false;
    }
    return true;
}

static bool hidden(const struct levels *levels, int l, const int at[3])
{
    return around(levels, l, at, 1, levels_whole);
}

static unsigned depth(const struct levels *levels, int l, const int at[3])
{
    const int below[3] = {at[0] >> 1, at[1] >> 1, at[2] >> 1};
    if (!around(levels, l, at, 3, hidden)) return 0;
    return 1 + (l ? depth(levels, l - 1, below) : 0);
}

static void check_depths(const struct levels *levels, unsigned counts[LEVELS_MOST + 2])
{
    const struct mesh *mesh = levels->mesh;
    for (int l = 0; l < mesh->n_level; l++) {
        const struct level *level = &mesh->levels[l];
        for (unsigned t = level->first; t < level->first + level->n_local; t++) {
            assert_int_equal(level->tiles[t].sleeps, depth(levels, l, level->tiles[t].at));
            counts[level->tiles[t].sleeps]++;
        }
        for (unsigned t = 0; l > 0 && t < level->n_local; t++) { /* what covers a tile knows, too */
            const int *at = level->tiles[level->first + t].at;
            const int below[3] = {at[0] >> 1, at[1] >> 1, at[2] >> 1};
            assert_int_equal(level->link->children[t].sleeps, depth(levels, l - 1, below));
        }
    }
}

static void fill(const struct link *link, const struct link_child *list, unsigned n, double value)
{
    for (unsigned i = 0; i < n; i++)
        for (size_t c = 0; list[i].average && c < LEVELS_FIELDS * link->octant_cells; c++) list[i].average[c] = value;
}

/* Averages of this depth have come with this number, those of larger depths not yet. */
static void check_arrived(const struct link *link, int now, double value)
{
    for (unsigned i = 0; i < link->n_octant; i++) {
        const struct link_child *octant = &link->octants[i];
        if (!octant->average) continue;
        if (octant->sleeps == now) assert_true(octant->average[0] == value);
        if (octant->sleeps > now) assert_true(octant->average[0] == DOZE_UNSET);
    }
}

static void check_travel(const struct levels *levels)
{
    for (int l = 1; l < levels->mesh->n_level; l++) {
        struct link *link = levels->mesh->levels[l].link;
        fill(link, link->octants, link->n_octant, DOZE_UNSET);
        fill(link, link->children, link->n_child, 7.0);
        link_up(link);
        check_arrived(link, 0, 7.0);
        for (int now = 1; now <= l; now++) {
            fill(link, link->children, link->n_child, 7.0 + now);
            link_up_late(link, now);
            check_arrived(link, now, 7.0 + now);
        }
    }
}

static void fill_level(struct levels *levels, int l)
{
    struct mesh_change change;
    unsigned n;
    memset(levels->maps[l], 1, levels_places(levels, l));
    struct tile *tiles = levels_list(levels, l, &n);
    levels_give(levels, l, tiles, n, &change);
    mesh_change_free(&change);
}

static void check(const struct levels_shape *shape, uint64_t seed, unsigned counts[LEVELS_MOST + 2])
{
    struct levels levels;
    levels_open(&levels, shape, seed);
    for (int round = 0; round < DOZE_ROUNDS; round++) {
        levels_refine(&levels);
        check_depths(&levels, counts);
        check_travel(&levels);
    }
    for (int l = 1; l <= shape->levels; l++) { /* levels that fill the domain: all but the finest sleep */
        fill_level(&levels, l);
        check_depths(&levels, counts);
        check_travel(&levels);
    }
    levels_close_all(&levels);
}

/* Domains large enough that some tiles sleep, at several depths, and some do not. */
static void test_depths(void **state)
{
    (void)state;
    static const struct levels_shape wide[] = {
        {1, {23, 1, 1}, 4, 3, {false}},
        {2, {9, 8, 1}, 4, 2, {false, true}},
        {3, {5, 6, 5}, 4, 1, {false, false, true}},
    };
    unsigned counts[LEVELS_MOST + 2] = {0};
    double sums[LEVELS_MOST + 2];
    for (int i = 0; i < LEVELS_SHAPE_COUNT; i++) check(&LEVELS_SHAPES[i], 17u * (unsigned)i + 5u, counts);
    for (int i = 0; i < 3; i++) check(&wide[i], 41u * (unsigned)i + 3u, counts);
    for (int i = 0; i < LEVELS_MOST + 2; i++) sums[i] = counts[i];
    comm_max(sums, LEVELS_MOST + 2);
    for (int i = 0; i < 4; i++) print_message("%g tiles of depth %d\n", sums[i], i);
    for (int i = 0; i < 4; i++) assert_true(sums[i] > 0.0);
}

static int run(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(test_depths)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}

int main(int argc, char **argv)
{
    return levels_main(argc, argv, run);
}
