/* prolong.c - ghosts behind coarse-fine faces: bounds, fractions, linear fields, uniform p and u, symmetry, place. */
#include "prolong_levels.h"

/* Strips of every patch of every coarse tile that a fine face could look at: called with the coordinates of each ghost
 * on the fine level and of its coarse cell, and the ghost's offset in the strip. */
typedef void patch_check(const struct twolevel *two, const int fine[3], const int coarse[3], const double *strip,
                         size_t size);

static void patches_of_tile(const struct twolevel *two, unsigned tile, struct link_face *faces, unsigned *count)
{
    const struct mesh *mesh = two->mesh;
    int n = mesh->n[0], layers[] = {0, n / 2 - 1, n / 2, n - 1};
    size_t strip = mesh->n_field * (mesh->n_cell / (size_t)n) * 2 * (size_t)link_depth(mesh);
    for (int axis = 0; axis < mesh->dim; axis++)
        for (int corner = 0; corner < 1 << mesh->dim; corner++)
            for (int i = 0; i < 4; i++) {
                if (corner >> axis & 1) continue;
                struct link_face *face = &faces[(*count)++];
                *face = (struct link_face){.coarse = tile, .face = 2 * axis + i % 2, .layer = layers[i]};
                for (int d = 0; d < mesh->dim; d++) face->from[d] = (corner >> d & 1) * n / 2;
                face->from[axis] = layers[i];
                face->strip[0] = mem_new(strip, sizeof(double));
                face->strip[1] = mem_new(strip, sizeof(double));
            }
}

static void check_patch(const struct twolevel *two, const struct link_face *face, patch_check *check)
{
    const struct mesh *mesh = two->mesh;
    int axis = face->face / 2, extent[3], size = 1;
    for (int d = 0; d < 3; d++) size *= extent[d] = d == axis ? 2 : mesh->n[d];
    for (int c = 0; c < size; c++) {
        int fine[3], coarse[3];
        for (int d = 0, rest = c; d < 3; rest /= extent[d], d++) {
            int at = mesh->n[d] * two->coarse->tiles[face->coarse].at[d] + face->from[d];
            fine[d] = d < mesh->dim ? 2 * at + rest % extent[d] : 0;
            coarse[d] = d < mesh->dim ? fine[d] / 2 : 0;
        }
        check(two, fine, coarse, face->strip[0] + c, (size_t)size);
    }
}

static void check_strips(struct twolevel *two, patch_check *check)
{
    struct link own = {.fine_level = 1}, *link = &own, *kept = two->fine->link;
    two->fine->link = link;
    unsigned n_tile = two->coarse->n_tile;
    link->sources = mem_new(n_tile * 3 * 4 * 4, sizeof *link->sources);
    link->source_from = mem_new(n_tile + 1, sizeof *link->source_from);
    for (unsigned t = 0; t < n_tile; t++) {
        link->source_from[t] = link->n_source;
        patches_of_tile(two, t, link->sources, &link->n_source);
    }
    link->source_from[n_tile] = link->n_source;
    struct prolong *prolong = prolong_new(two->model, two->mesh);
    prolong_strips(prolong, two->mesh, 0, two->bound, 0);
    prolong_free(prolong);
    for (unsigned s = 0; s < link->n_source; s++) {
        check_patch(two, &link->sources[s], check);
        mem_free(link->sources[s].strip[0]);
        mem_free(link->sources[s].strip[1]);
    }
    mem_free(link->sources);
    mem_free(link->source_from);
    two->fine->link = kept;
}

static unsigned ghosts;

static void ghost_is_bounded(const struct twolevel *two, const int fine[3], const int coarse[3], const double *strip,
                             size_t size)
{
    const struct model *model = two->model;
    double sum = 0.0;
    (void)fine;
    ghosts++;
    for (unsigned q = 0; q < model->n_field; q++) {
        double low, high, value = strip[q * size];
        twolevel_range(two, two->coarse->w, q, coarse, &low, &high);
        if (q < model->n_alpha) sum += value;
        if (q < model->n_alpha && model->n_alpha > 2) { /* normalised: within 0 and 1, and absent stays absent */
            low = 0.0;
            if (high > 0.0) high = 1.0;
        }
        double slack = 4e-16 * fmax(fabs(low), fabs(high));
        if (q < model->n_alpha && low == 0.0) slack = 0.0;
        if (!(value >= low - slack && value <= high + slack))
            fail_msg("field %u: %.17g outside [%.17g, %.17g]", q, value, low, high);
    }
    if (model->n_alpha && fabs(sum - 1.0) > 1e-15) fail_msg("sum of alpha - 1 = %g", sum - 1.0);
}

static void strips_are_bounded(void **state)
{
    (void)state;
    static const char *const materials[] = {FLOW_AIR, FLOW_WATER FLOW_AIR, FLOW_WATER FLOW_AIR FLOW_HELIUM};
    for (int dim = 1; dim <= 3; dim++)
        for (int m = 0; m < 3; m++) {
            struct twolevel two;
            twolevel_start(&two, twolevel_case(dim, "cartesian", materials[m]), twolevel_rough, NULL);
            check_strips(&two, ghost_is_bounded);
            twolevel_stop(&two);
        }
    assert_true(ghosts > 10000);
}

static void ghost_is_linear(const struct twolevel *two, const int fine[3], const int coarse[3], const double *strip,
                            size_t size)
{
    const struct model *model = two->model;
    double x[3] = {0}, w[FLOW_FIELDS];
    if (twolevel_edge(two->mesh, two->coarse, coarse)) return;
    for (int d = 0; d < two->mesh->dim; d++) x[d] = (fine[d] + 0.5) * two->fine->h[d];
    twolevel_linear(model, x, w);
    ghosts++;
    for (unsigned q = 0; q < model->n_field; q++)
        if (fabs(strip[q * size] - w[q]) > (q == model->i_E ? 1e-5 : 1e-12)) /* p comes from 2e9 J/m3 */
            fail_msg("field %u: %.17g instead of %.17g", q, strip[q * size], w[q]);
}

static void strips_reproduce_linear_fields(void **state)
{
    (void)state;
    for (int dim = 1; dim <= 3; dim++) {
        struct twolevel two;
        ghosts = 0;
        twolevel_start(&two, twolevel_case(dim, "cartesian", FLOW_WATER FLOW_AIR), twolevel_linear, NULL);
        check_strips(&two, ghost_is_linear);
        assert_true(ghosts > 20);
        twolevel_stop(&two);
    }
}

static void ghost_is_in_equilibrium(const struct twolevel *two, const int fine[3], const int coarse[3],
                                    const double *strip, size_t size)
{
    const struct model *model = two->model;
    (void)fine;
    for (unsigned q = model->i_u; q < model->n_field; q++) {
        double low, high;
        twolevel_range(two, two->coarse->w, q, coarse, &low, &high);
        assert_true(strip[q * size] >= low && strip[q * size] <= high);
        assert_true(high - low <= 1e-12 * (1e5 + 1e10 * (q == model->i_E)));
    }
}

static void strips_keep_pressure_and_velocity(void **state)
{
    (void)state;
    for (int dim = 1; dim <= 3; dim++)
        for (int i = 0; i < TWOLEVEL_PAIRS; i++) {
            struct twolevel two;
            twolevel_start(&two, twolevel_case(dim, "cartesian", TWOLEVEL_PAIR[i]), twolevel_equilibrium, NULL);
            check_strips(&two, ghost_is_in_equilibrium);
            twolevel_stop(&two);
        }
}

static void ghost_is_pure(const struct twolevel *two, const int fine[3], const int coarse[3], const double *strip,
                          size_t size)
{
    (void)fine;
    double own = twolevel_value(two->mesh, two->coarse, two->coarse->w, 0, coarse);
    assert_true(strip[0] == own && strip[size] == 1.0 - own);
}

static void pure_strips_stay_pure(void **state)
{
    (void)state;
    struct twolevel two;
    twolevel_start(&two, twolevel_case(2, "cartesian", FLOW_WATER FLOW_AIR FLOW_HELIUM), twolevel_pure, NULL);
    check_strips(&two, ghost_is_pure);
    twolevel_stop(&two);
}

/* A staircase, so that fine faces of all directions look at the coarse level. */
static bool in_staircase(const int at[3])
{
    return (at[0] + at[1] + 2 * at[2]) / 2 % 3 == 1;
}

/* What the link brings to a face of a fine tile is what lies behind that face. */
static void check_face(const struct twolevel *two, const struct link_face *face)
{
    const struct mesh *mesh = two->mesh;
    const struct tile *tile = &two->fine->tiles[face->fine];
    int axis = face->face / 2, extent[3], size = 1;
    for (int d = 0; d < 3; d++) size *= extent[d] = d == axis ? 2 * link_depth(mesh) : mesh->n[d];
    for (int c = 0; c < size; c++) {
        int fine[3], coarse[3];
        for (int d = 0, rest = c; d < 3; rest /= extent[d], d++) {
            int behind = face->face % 2 ? mesh->n[d] : -2 * link_depth(mesh);
            fine[d] = tile->at[d] * mesh->n[d] + rest % extent[d] + (d == axis ? behind : 0);
            coarse[d] = d < mesh->dim ? fine[d] / 2 : 0;
        }
        ghost_is_linear(two, fine, coarse, face->strip[0] + c, (size_t)size);
        ghost_is_linear(two, fine, coarse, face->strip[1] + c, (size_t)size);
    }
}

static void strips_of_staircase(int dim)
{
    struct twolevel two;
    ghosts = 0;
    twolevel_start(&two, twolevel_case(dim, "cartesian", FLOW_WATER FLOW_AIR), twolevel_linear, in_staircase);
    const struct link *link = two.fine->link;
    struct prolong *prolong = prolong_new(two.model, two.mesh);
    prolong_strips(prolong, two.mesh, 0, two.bound, 0);
    prolong_strips(prolong, two.mesh, 0, two.bound, 1);
    prolong_free(prolong);
    link_down(two.fine->link);
    for (unsigned f = 0; f < link->n_face; f++) check_face(&two, &link->faces[f]);
    assert_true(ghosts > (dim == 1 ? 3 : 100));
    twolevel_stop(&two);
}

static void strips_reach_the_faces_that_look_at_them(void **state)
{
    (void)state;
    for (int i = 0; i < 2; i++) {
        twolevel_scheme = TWOLEVEL_SCHEMES[i];
        for (int dim = 1; dim <= 3; dim++) strips_of_staircase(dim);
    }
    twolevel_scheme = TWOLEVEL_SCHEMES[0];
}

static double (*strip_values)[FLOW_FIELDS]; /* by fine cell: fields summed over the strips that hold it */

static size_t fine_index(const struct twolevel *two, const int at[3])
{
    size_t index = 0;
    for (int d = 2; d >= 0; d--) index = index * (size_t)(two->fine->extent[d] * two->mesh->n[d]) + (size_t)at[d];
    return index;
}

static void keep_ghost(const struct twolevel *two, const int fine[3], const int coarse[3], const double *strip,
                       size_t size)
{
    (void)coarse;
    for (unsigned q = 0; q < two->model->n_field; q++)
        strip_values[fine_index(two, fine)][q] += strip[q * size]; /* the same value up to three times */
}

static void compare_strips(struct twolevel *a, struct twolevel *b)
{
    size_t cells = a->fine->n_tile * a->mesh->n_cell;
    double(*plain)[FLOW_FIELDS] = mem_new(cells, sizeof *plain);
    strip_values = plain;
    check_strips(a, keep_ghost);
    strip_values = mem_new(cells, sizeof *strip_values);
    check_strips(b, keep_ghost);
    for (unsigned t = 0; t < b->fine->n_tile; t++)
        for (size_t c = 0; c < a->mesh->n_cell; c++) {
            int at[3], from[3] = {0};
            twolevel_at(a->mesh, &b->fine->tiles[t], c, at);
            twolevel_turn(a->mesh, a->fine, at, from);
            for (unsigned q = 0; q < a->mesh->n_field; q++) {
                double sign, plain_value = plain[fine_index(a, from)][twolevel_turned(a->model, q, &sign)];
                assert_true(strip_values[fine_index(b, at)][q] == sign * plain_value);
            }
        }
    mem_free(plain);
    mem_free(strip_values);
}

static void check_symmetry(int dim, const double sign[3], const int axis[3])
{
    struct twolevel a, b;
    twolevel_start_pair(&a, &b, dim, sign, axis);
    compare_strips(&a, &b);
    twolevel_stop(&a);
    twolevel_stop(&b);
}

static void symmetry_keeps_bits(void **state)
{
    (void)state;
    check_symmetry(2, (const double[]){-1, 1, 1}, (const int[]){0, 1, 2});
    check_symmetry(2, (const double[]){1, -1, 1}, (const int[]){0, 1, 2});
    check_symmetry(2, (const double[]){1, 1, 1}, (const int[]){1, 0, 2});
    check_symmetry(3, (const double[]){-1, 1, -1}, (const int[]){0, 1, 2});
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(strips_are_bounded),
        cmocka_unit_test(strips_reproduce_linear_fields),
        cmocka_unit_test(strips_keep_pressure_and_velocity),
        cmocka_unit_test(pure_strips_stay_pure),
        cmocka_unit_test(strips_reach_the_faces_that_look_at_them),
        cmocka_unit_test(symmetry_keeps_bits),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
