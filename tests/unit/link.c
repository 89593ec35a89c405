/* Links between levels against a plain picture of them: every coarse-fine face once on each side, looking at the
 * right cells, and everything sent through a link arrives (program/ranks_mesh.sh starts several ranks). */
#include "levels.h"

enum { ROUNDS = 6 };

static void each_link(void (*check)(struct levels *, int))
{
    for (int i = 0; i < LEVELS_SHAPE_COUNT; i++) {
        struct levels levels;
        levels_open(&levels, &LEVELS_SHAPES[i], 31u * (unsigned)i + 2u);
        for (int round = 0; round < ROUNDS; round++) {
            levels_refine(&levels);
            assert_null(levels.mesh->levels[0].link);
            for (int l = 1; l < levels.mesh->n_level; l++) check(&levels, l);
        }
        levels_close_all(&levels);
    }
}

static bool here(const struct levels *levels, int l, const int at[3])
{
    return levels_owner(levels, l, at) == comm_rank();
}

/* The local number of an own tile. */
static unsigned local(const struct levels *levels, int l, const int at[3])
{
    const struct level *level = &levels->mesh->levels[l];
    return (unsigned)mesh_find(levels->mesh, level, at) - level->first;
}

/* The cells of the patch, in cells of the coarse level, are those under the first layer behind the fine face. */
static void check_patch(const struct levels *levels, int l, const struct link_face *face)
{
    const struct mesh *mesh = levels->mesh;
    const struct level *coarser = &mesh->levels[l - 1];
    struct tile fine = {.key = face->key};
    int behind[3];
    morton_at(face->key, fine.at);
    assert_true(levels_behind(levels, l, &fine, face->face, behind));
    const int above[3] = {behind[0] >> 1, behind[1] >> 1, behind[2] >> 1};
    const struct tile *coarse = &coarser->tiles[mesh_find(mesh, coarser, above)];
    int axis = face->face / 2, octant = 0;
    assert_int_equal(face->layer, face->from[axis] + (face->face % 2 ? 0 : link_depth(mesh) - 1));
    for (int d = 0; d < 3; d++) {
        int n = mesh->n[d], first = fine.at[d] * n, half = d < mesh->dim ? 2 : 1;
        int cells = mesh->levels[l].extent[d] * n;
        if (d == axis) first += face->face % 2 ? n : -1;
        first = (first + cells) % cells; /* wraps: only a periodic face looks over the end */
        assert_int_equal(coarse->at[d] * n + (d == axis ? face->layer : face->from[d]), first / half);
        assert_true(face->from[d] >= 0 && face->from[d] < n);
        if (d != axis && d < mesh->dim) assert_int_equal(face->from[d] % (n / 2), 0);
        if (d < mesh->dim && face->from[d] >= n / 2) octant |= 1 << d;
    }
    assert_false(coarse->covered >> octant & 1);
}

/* Number of entries of a list for a face of a fine tile. */
static unsigned count(const struct link_face *faces, unsigned from, unsigned to, uint64_t fine, int face)
{
    unsigned n = 0;
    for (unsigned i = from; i < to; i++) n += faces[i].key == fine && faces[i].face == face;
    return n;
}

static void check_faces(struct levels *levels, int l)
{
    const struct mesh *mesh = levels->mesh;
    const struct level *fine = &mesh->levels[l], *coarse = &mesh->levels[l - 1];
    const struct link *link = fine->link;
    unsigned n_face = 0, n_source = 0;
    assert_non_null(link);
    for (unsigned t = 0; t < fine->n_tile; t++)
        for (int face = 0; face < 2 * mesh->dim; face++) {
            const struct tile *tile = &levels->lists[l][t];
            int at[3];
            if (!levels_behind(levels, l, tile, face, at) || levels_has(levels, l, at)) continue;
            const int above[3] = {at[0] >> 1, at[1] >> 1, at[2] >> 1};
            bool both = here(levels, l - 1, above);
            if (here(levels, l, tile->at)) {
                unsigned own = local(levels, l, tile->at), index = fine->neighbours[own][face].index;
                assert_true(link->faces[index].fine == own && link->faces[index].key == tile->key);
                assert_true(link->faces[index].face == face && index == n_face++);
                if (both) assert_int_equal(link->faces[index].coarse, local(levels, l - 1, above));
                else assert_true(link->faces[index].coarse >= coarse->n_local);
                check_patch(levels, l, &link->faces[index]);
            }
            if (!both) continue;
            unsigned from = local(levels, l - 1, above);
            assert_int_equal(count(link->sources, link->source_from[from], link->source_from[from + 1], tile->key,
                                   face),
                             1);
            n_source++;
        }
    assert_int_equal(link->n_face, n_face);
    assert_int_equal(link->n_source, n_source);
    assert_int_equal(link->source_from[coarse->n_local], n_source);
    for (unsigned c = 0; c < coarse->n_local; c++)
        for (unsigned i = link->source_from[c]; i < link->source_from[c + 1]; i++) {
            const struct link_face *source = &link->sources[i];
            assert_int_equal(source->coarse, c);
            check_patch(levels, l, source);
            if (i > link->source_from[c])
                assert_true(source[-1].key < source->key ||
                            (source[-1].key == source->key && source[-1].face < source->face));
        }
}

static void check_children(struct levels *levels, int l)
{
    const struct mesh *mesh = levels->mesh;
    const struct level *fine = &mesh->levels[l], *coarse = &mesh->levels[l - 1];
    const struct link *link = fine->link;
    unsigned n_octant = 0;
    assert_int_equal(link->n_child, fine->n_local);
    for (unsigned t = 0; t < fine->n_tile; t++) {
        const struct tile *tile = &levels->lists[l][t];
        const int above[3] = {tile->at[0] >> 1, tile->at[1] >> 1, tile->at[2] >> 1};
        int octant = (tile->at[0] & 1) + 2 * (tile->at[1] & 1) + 4 * (tile->at[2] & 1);
        bool below = here(levels, l - 1, above), both = here(levels, l, tile->at) && below;
        if (here(levels, l, tile->at)) {
            unsigned own = local(levels, l, tile->at);
            const struct link_child *child = &link->children[own];
            assert_true(child->fine == own && child->octant == octant);
            if (both) assert_int_equal(child->coarse, local(levels, l - 1, above));
            else assert_true(child->coarse >= coarse->n_local);
            assert_int_equal(child->average == NULL, both);
        }
        if (!below) continue;
        unsigned found = 0, c = local(levels, l - 1, above);
        for (unsigned i = link->octant_from[c]; i < link->octant_from[c + 1]; i++) {
            const struct link_child *child = &link->octants[i];
            assert_int_equal(child->coarse, c);
            if (i > link->octant_from[c]) assert_true(child[-1].octant < child->octant);
            if (child->octant != octant) continue;
            found++;
            if (both) assert_int_equal(child->fine, local(levels, l, tile->at));
            else assert_true(child->fine >= fine->n_local);
            assert_int_equal(child->average == NULL, both);
        }
        assert_int_equal(found, 1);
        n_octant++;
    }
    assert_int_equal(link->n_octant, n_octant);
    assert_int_equal(link->octant_from[coarse->n_local], n_octant);
}

static void check_sizes(struct levels *levels, int l)
{
    const struct mesh *mesh = levels->mesh;
    const struct link *link = mesh->levels[l].link;
    size_t half = (size_t)mesh->n[0] / 2, cells = 1;
    for (int d = 1; d < mesh->dim; d++) cells *= half;
    assert_int_equal(link->fine_level, l);
    assert_int_equal(link->n_register, LEVELS_FIELDS + 1);
    assert_int_equal(link->face_cells, cells);
    assert_int_equal(link->octant_cells, cells * half);
    assert_int_equal(link->strip_doubles, LEVELS_FIELDS * 2 * (size_t)link_depth(mesh) * (cells << (mesh->dim - 1)));
}

/* A coarse tile waits if some end of its faces is on another rank, or, unless it sleeps, of its octants. */
static void check_waits(const struct levels *levels, int l)
{
    const struct level *fine = &levels->mesh->levels[l], *coarse = fine - 1;
    const struct link *link = fine->link;
    for (unsigned c = 0; c < coarse->n_local; c++) {
        bool away = false;
        for (unsigned i = link->octant_from[c]; i < link->octant_from[c + 1]; i++)
            away = away || (!link->octants[i].sleeps && link->octants[i].fine >= fine->n_local);
        for (unsigned i = link->source_from[c]; i < link->source_from[c + 1]; i++)
            away = away || link->sources[i].fine >= fine->n_local;
        assert_int_equal(link->waits[c], away);
    }
}

static void check_lists(struct levels *levels, int l)
{
    check_waits(levels, l);
    check_sizes(levels, l);
    check_faces(levels, l);
    check_children(levels, l);
}

static void test_lists(void **state)
{
    (void)state;
    each_link(check_lists);
}

/* Numbers that say what they belong to: `kind` 0 and 1 strips, 2 register, 3 average; writes or compares. */
static void stamp(bool write, double *at, size_t doubles, int kind, uint64_t fine, int place, int round)
{
    for (size_t i = 0; i < doubles; i++) {
        double value = kind + 10.0 * place + 100.0 * round + 1e4 * (double)i + 1e9 * (double)fine;
        if (write) at[i] = value;
        else assert_true(at[i] == value);
    }
}

static void stamp_fluxes(const struct link *link, const struct link_face *faces, unsigned n, bool write, int round)
{
    for (unsigned i = 0; i < n; i++)
        stamp(write, faces[i].flux, link->n_register * link->face_cells, 2, faces[i].key, faces[i].face, round);
}

static void stamp_strips(const struct link *link, const struct link_face *faces, unsigned n, bool write, int round)
{
    for (unsigned i = 0; i < n; i++)
        for (int slot = 0; slot < 2; slot++)
            stamp(write, faces[i].strip[slot], link->strip_doubles, slot, faces[i].key, faces[i].face, round);
}

/* Told apart by the fine tile: by its own end on level `fine`, or by the octant above on the coarser one (NULL). */
static void stamp_averages(const struct link *link, const struct level *fine, const struct level *coarse,
                           const struct link_child *list, unsigned n, int round)
{
    for (unsigned i = 0; i < n; i++) {
        uint64_t key = fine ? fine->tiles[fine->first + list[i].fine].key
                            : coarse->tiles[coarse->first + list[i].coarse].key << 3 | (unsigned)list[i].octant;
        if (list[i].average)
            stamp(fine, list[i].average, LEVELS_FIELDS * link->octant_cells, 3, key, list[i].octant, round);
    }
}

/* Strips go down, registers and averages up; neither disturbs the other. */
static void check_traffic(struct levels *levels, int l)
{
    struct link *link = levels->mesh->levels[l].link;
    const struct level *fine = &levels->mesh->levels[l], *coarse = fine - 1;
    for (int round = 0; round < 2; round++) {
        stamp_strips(link, link->sources, link->n_source, true, round);
        link_down(link);
        stamp_fluxes(link, link->faces, link->n_face, true, round);
        stamp_averages(link, fine, NULL, link->children, link->n_child, round);
        stamp_strips(link, link->faces, link->n_face, false, round);
        link_up(link);
        for (int depth = 1; depth <= l; depth++) link_up_late(link, depth);
        stamp_fluxes(link, link->sources, link->n_source, false, round);
        stamp_averages(link, NULL, coarse, link->octants, link->n_octant, round);
        stamp_strips(link, link->faces, link->n_face, false, round);
    }
}

static void test_traffic(void **state)
{
    (void)state;
    each_link(check_traffic);
}

/* Gives level l the tiles of its map with other owners and compares all links. */
static void replace(struct levels *levels, int l)
{
    unsigned n;
    struct mesh_change change;
    struct tile *tiles = levels_list(levels, l, &n);
    levels_give(levels, l, tiles, n, &change);
    mesh_change_free(&change);
    for (int finer = 1; finer < levels->mesh->n_level; finer++) {
        check_lists(levels, finer);
        check_traffic(levels, finer);
    }
}

/* Other owners of the coarse tiles, then of the fine ones; then more coarse tiles: links follow. */
static void test_owners(void **state)
{
    (void)state;
    for (int i = 0; i < LEVELS_SHAPE_COUNT; i++) {
        struct levels levels;
        levels_open(&levels, &LEVELS_SHAPES[i], 77u + (unsigned)i);
        levels_refine(&levels);
        for (int l = 0; l < levels.mesh->n_level; l++) replace(&levels, l);
        for (int l = 1; l < levels.mesh->n_level; l++) {
            memset(levels.maps[l], 1, levels_places(&levels, l));
            replace(&levels, l);
        }
        levels_close_all(&levels);
    }
}

static int run(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(test_lists), cmocka_unit_test(test_traffic),
                                       cmocka_unit_test(test_owners)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}

int main(int argc, char **argv)
{
    return levels_main(argc, argv, run);
}
