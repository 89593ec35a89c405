/* restrict.c - from fine to coarse: conservation, equal numbers, symmetry, faces, other ranks. */
#include "prolong_levels.h"

static uint64_t seed = 7;

static void fill_fine(const struct twolevel *two, bool constant)
{
    for (unsigned t = 0; t < two->fine->n_tile; t++)
        for (size_t i = 0; i < two->mesh->n_field * two->mesh->n_cell; i++)
            two->fine->u_old[t][i] = constant ? 0.1 + 0.3 * (double)(i / two->mesh->n_cell) : flow_random(&seed) - 0.25;
}

static void restrict_all(const struct twolevel *two)
{
    for (int depth = 0; depth <= 1; depth++) {
        restrict_averages(two->mesh, 1, depth);
        restrict_take(two->mesh, 1, depth);
    }
}

typedef void geometry_check(struct twolevel *two);

static void each_geometry(geometry_check *check)
{
    for (int dim = 1; dim <= 3; dim++)
        for (int beta = 0; beta < 3; beta++) {
            struct twolevel two;
            if (beta == 1 ? dim != 2 : beta == 2 ? dim != 1 : 0) continue;
            twolevel_start(&two, twolevel_case(dim, TWOLEVEL_GEOMETRY[beta], FLOW_WATER FLOW_AIR), NULL, NULL);
            check(&two);
            twolevel_stop(&two);
        }
}

/* Integral of a field over a level. */
static long double integral(const struct twolevel *two, const struct level *level, size_t q)
{
    const struct mesh *mesh = two->mesh;
    double *volume = mem_new(mesh->n_cell, sizeof *volume);
    long double sum = 0.0L;
    for (unsigned t = 0; t < level->n_tile; t++) {
        metric_volumes(mesh, level, &level->tiles[t], volume);
        for (size_t c = 0; c < mesh->n_cell; c++) sum += (long double)volume[c] * level->u_old[t][q * mesh->n_cell + c];
    }
    mem_free(volume);
    return sum;
}

/* Whole, and cell by cell: a wrong place would show in a field that is not random. */
static void check_conservation(struct twolevel *two)
{
    const struct mesh *mesh = two->mesh;
    fill_fine(two, false);
    restrict_all(two);
    for (size_t q = 0; q < mesh->n_field; q++) {
        long double fine = integral(two, two->fine, q), coarse = integral(two, two->coarse, q);
        assert_true(fabsl(fine - coarse) <= 1e-14L * fabsl(fine));
    }
    for (unsigned t = 0; t < two->fine->n_tile; t++)
        for (size_t c = 0; c < mesh->n_cell; c++) {
            int at[3];
            twolevel_at(mesh, &two->fine->tiles[t], c, at);
            two->fine->u_old[t][c] = at[0] / 2 + 100 * (at[1] / 2) + 10000 * (at[2] / 2);
        }
    restrict_all(two);
    for (unsigned t = 0; t < two->coarse->n_tile; t++)
        for (size_t c = 0; c < mesh->n_cell; c++) {
            int at[3];
            twolevel_at(mesh, &two->coarse->tiles[t], c, at);
            assert_true(two->coarse->u_old[t][c] == at[0] + 100 * at[1] + 10000 * at[2]);
        }
}

static void mass_is_kept(void **state)
{
    (void)state;
    each_geometry(check_conservation);
}

static void check_constants(struct twolevel *two)
{
    fill_fine(two, true);
    restrict_all(two);
    for (unsigned t = 0; t < two->coarse->n_tile; t++)
        for (size_t i = 0; i < two->mesh->n_field * two->mesh->n_cell; i++)
            assert_true(two->coarse->u_old[t][i] == 0.1 + 0.3 * (double)(i / two->mesh->n_cell));
}

static void equal_numbers_stay(void **state)
{
    (void)state;
    each_geometry(check_constants);
}

/* The average sent to another rank's tile gives the bits of the one written in place. */
static void check_away(struct twolevel *two)
{
    const struct mesh *mesh = two->mesh;
    struct link *link = two->fine->link, kept = *link;
    size_t block = mesh->n_field * mesh->n_cell;
    fill_fine(two, false);
    restrict_all(two);
    double *here = mem_new(two->coarse->n_tile * block, sizeof *here);
    for (unsigned t = 0; t < two->coarse->n_tile; t++) {
        memcpy(here + t * block, two->coarse->u_old[t], block * sizeof *here);
        memset(two->coarse->u_old[t], 0, block * sizeof *here);
    }
    for (unsigned i = 0; i < link->n_child; i++)
        if (i % 3) link->children[i].average = mem_new(mesh->n_field * link->octant_cells, sizeof(double));
    link->octants = link->children; /* what arrived is what was sent */
    link->n_octant = link->n_child;
    restrict_all(two);
    for (unsigned t = 0; t < two->coarse->n_tile; t++)
        assert_memory_equal(here + t * block, two->coarse->u_old[t], block * sizeof *here);
    for (unsigned i = 0; i < link->n_child; i++) {
        mem_free(link->children[i].average);
        link->children[i].average = NULL;
    }
    *link = kept;
    mem_free(here);
}

static void averages_travel(void **state)
{
    (void)state;
    each_geometry(check_away);
}

/* Random cells, mirrored in some axes, and x exchanged with y. */
static void fill_mapped(const struct twolevel *two, const bool mirror[3], bool exchange)
{
    const struct mesh *mesh = two->mesh;
    for (unsigned t = 0; t < two->fine->n_tile; t++)
        for (size_t c = 0; c < mesh->n_cell; c++) {
            int at[3], plain[3];
            twolevel_at(mesh, &two->fine->tiles[t], c, at);
            for (int d = 0; d < 3; d++) {
                int to = exchange && d < 2 ? 1 - d : d;
                plain[to] = mirror[d] ? two->fine->extent[d] * mesh->n[d] - 1 - at[d] : at[d];
            }
            uint64_t own = (uint64_t)plain[0] + 1000u * (uint64_t)plain[1] + 1000000u * (uint64_t)plain[2];
            for (size_t q = 0; q < mesh->n_field; q++)
                two->fine->u_old[t][q * mesh->n_cell + c] = exp(20.0 * flow_random(&own)) - 1e4;
        }
}

static void check_symmetry(int dim, const bool mirror[3], bool exchange)
{
    struct twolevel a, b;
    twolevel_start(&a, twolevel_case(dim, TWOLEVEL_GEOMETRY[0], FLOW_WATER FLOW_AIR), NULL, NULL);
    twolevel_start(&b, twolevel_case(dim, TWOLEVEL_GEOMETRY[0], FLOW_WATER FLOW_AIR), NULL, NULL);
    fill_mapped(&a, (const bool[]){false, false, false}, false);
    fill_mapped(&b, mirror, exchange);
    restrict_all(&a);
    restrict_all(&b);
    const struct mesh *mesh = a.mesh;
    for (unsigned t = 0; t < b.coarse->n_tile; t++)
        for (size_t c = 0; c < mesh->n_cell; c++) {
            int at[3], plain[3];
            twolevel_at(mesh, &b.coarse->tiles[t], c, at);
            for (int d = 0; d < 3; d++) {
                int to = exchange && d < 2 ? 1 - d : d;
                plain[to] = mirror[d] ? b.coarse->extent[d] * mesh->n[d] - 1 - at[d] : at[d];
            }
            assert_true(b.coarse->u_old[t][c] == twolevel_value(mesh, a.coarse, a.coarse->u_old, 0, plain));
        }
    twolevel_stop(&a);
    twolevel_stop(&b);
}

static void symmetry_keeps_bits(void **state)
{
    (void)state;
    check_symmetry(1, (const bool[]){true, false, false}, false);
    for (int mirror = 0; mirror < 8; mirror++)
        for (int exchange = 0; exchange < 2; exchange++) {
            const bool axes[3] = {mirror & 1, mirror & 2, mirror & 4};
            if (mirror < 4) check_symmetry(2, axes, exchange);
            check_symmetry(3, axes, exchange);
        }
}

/* Areas of the cells of a face of a tile, by (outer, inner), as metric.h has them. */
static double face_area(const struct mesh *mesh, const struct level *level, const struct metric *metric, int axis,
                        size_t c)
{
    double area = axis > 0 ? metric->volume[c % (size_t)mesh->n[0]] : 1.0;
    for (int d = 1; d < mesh->dim; d++)
        if (d != axis) area *= level->h[d];
    return area;
}

static void check_face(const struct twolevel *two, unsigned t, int axis)
{
    const struct mesh *mesh = two->mesh;
    const struct tile *tile = &two->fine->tiles[t];
    struct metric metric;
    metric_of_tile(mesh, two->fine, tile, &metric);
    size_t n = mesh->n_cell / (size_t)mesh->n[axis], halves = n >> (mesh->dim - 1);
    int tangent[2] = {axis == 0 ? 1 : 0, axis == 2 ? 1 : 2};
    size_t across = mesh->dim > 1 ? (size_t)mesh->n[tangent[0]] : 1;
    double fine[256], same[256], coarse[256], sum[256] = {0}, area[256] = {0};
    for (size_t c = 0; c < n; c++) {
        size_t x = c % across / 2, y = c / across / 2, to = mesh->dim > 1 ? x + y * (across / 2) : 0;
        fine[c] = flow_random(&seed);
        same[c] = 0.1;
        sum[to] += fine[c] * face_area(mesh, two->fine, &metric, axis, c);
        area[to] += face_area(mesh, two->fine, &metric, axis, c);
    }
    restrict_face(mesh, two->fine, tile, axis, 0, fine, coarse);
    for (size_t c = 0; c < halves; c++) assert_true(fabs(coarse[c] * area[c] - sum[c]) <= 4e-16 * area[c]);
    restrict_face(mesh, two->fine, tile, axis, 0, same, coarse);
    for (size_t c = 0; c < halves; c++) assert_true(coarse[c] == 0.1);
}

static void check_faces(struct twolevel *two)
{
    for (unsigned t = 0; t < two->fine->n_tile; t++)
        for (int axis = 0; axis < two->mesh->dim; axis++) check_face(two, t, axis);
}

static void faces_are_weighted_by_area(void **state)
{
    (void)state;
    each_geometry(check_faces);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(mass_is_kept),
        cmocka_unit_test(equal_numbers_stay),
        cmocka_unit_test(averages_travel),
        cmocka_unit_test(symmetry_keeps_bits),
        cmocka_unit_test(faces_are_weighted_by_area),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
