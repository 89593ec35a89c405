/* prolong_born.c - first states of new tiles: linear fields, uniform p and u, limits, conservation, symmetry. */
#include "prolong_levels.h"

static double centroid(int beta, double a, double b)
{
    if (beta == 0) return (a + b) / 2.0;
    return (beta + 1.0) / (beta + 2.0) * (pow(b, beta + 2) - pow(a, beta + 2)) / (pow(b, beta + 1) - pow(a, beta + 1));
}

static double width; /* of the coarse cells, for set_linear_conserved */

/* At rest with linear densities and pressure the conserved fields are linear; cells hold the values at the centroids of
 * their volumes. */
static void set_linear_conserved(const struct model *model, const double x[3], double *w)
{
    double y[3] = {centroid(model->beta, x[0] - width / 2.0, x[0] + width / 2.0), x[1], x[2]};
    for (unsigned q = 0; q < model->n_field; q++) w[q] = q >= model->i_u && q < model->i_E ? 0.0 : twolevel_slope(q, y);
}

static void born_tiles_reproduce_linear_fields(void **state)
{
    (void)state;
    for (int dim = 1; dim <= 3; dim++)
        for (int beta = 0; beta < 3; beta++) {
            struct twolevel two;
            unsigned seen = 0;
            if (beta == 1 ? dim != 2 : beta == 2 ? dim != 1 : 0) continue;
            width = dim == 3 ? 2.0 / 16.0 : 2.0 / 32.0;
            twolevel_start(&two, twolevel_case(dim, TWOLEVEL_GEOMETRY[beta], FLOW_AIR), set_linear_conserved, NULL);
            twolevel_bear(&two);
            for (unsigned t = 0; t < two.fine->n_tile; t++)
                for (size_t c = 0; c < two.mesh->n_cell; c++) {
                    int at[3], above[3];
                    double x[3] = {0}, w[FLOW_FIELDS], u[FLOW_FIELDS];
                    twolevel_at(two.mesh, &two.fine->tiles[t], c, at);
                    for (int d = 0; d < 3; d++) above[d] = at[d] / 2;
                    if (twolevel_edge(two.mesh, two.coarse, above)) continue;
                    for (int d = 0; d < dim; d++) x[d] = (at[d] + 0.5) * two.fine->h[d];
                    width /= 2.0;
                    set_linear_conserved(two.model, x, w);
                    width *= 2.0;
                    mix_conserved(two.model, 1, 1, w, u);
                    seen++;
                    for (unsigned q = 0; q < two.model->n_field; q++)
                        if (fabs(two.fine->u_old[t][q * two.mesh->n_cell + c] - u[q]) > 1e-13)
                            fail_msg("%dD, beta %d, field %u: %.17g instead of %.17g", dim, beta, q,
                                     two.fine->u_old[t][q * two.mesh->n_cell + c], u[q]);
                }
            assert_true(seen > 50);
            twolevel_stop(&two);
        }
}

static bool in_second(const int at[3])
{
    return at[0] < 3 && at[1] < 3 && at[2] < 3;
}

/* Level 2 as far into level 1 as nesting allows: one octant from its edge. */
static void start_third(struct twolevel *two, int dim, struct mesh_change *ret_change)
{
    struct mesh *mesh = two->mesh;
    struct level *third = &mesh->levels[2];
    struct tile *tiles = mem_new((size_t)1 << 2 * dim, sizeof *tiles);
    for (int i = 0; i < 1 << 2 * dim; i++) {
        for (int d = 0; d < dim; d++) tiles[i].at[d] = 1 + (i >> 2 * d & 3);
        tiles[i].key = morton_key(tiles[i].at);
    }
    for (int d = 0; d < 3; d++) {
        third->h[d] = d < dim ? two->fine->h[d] / 2.0 : 1.0;
        third->extent[d] = two->fine->extent[d] * (d < dim ? 2 : 1);
    }
    qsort(tiles, (size_t)1 << 2 * dim, sizeof *tiles, twolevel_compare);
    replicated_replace(mesh, 2, tiles, 1u << 2 * dim, ret_change);
}

/* Linear fields are at rest: densities and pressures tell. */
static void check_third(const struct twolevel *two, const double *arrays, size_t pitch, unsigned q, const int at[3])
{
    const struct level *third = &two->mesh->levels[2];
    double x[3] = {0};
    for (int d = 0; d < two->mesh->dim; d++) x[d] = (at[d] + 0.5) * third->h[d];
    if (fabs(arrays[q * pitch] - twolevel_slope(q, x)) > 1e-12)
        fail_msg("field %u: %.17g instead of %.17g", q, arrays[q * pitch], twolevel_slope(q, x));
}

static void check_third_strip(const struct twolevel *two, const struct link_face *face)
{
    const struct mesh *mesh = two->mesh;
    const struct tile *tile = &mesh->levels[2].tiles[face->fine];
    int axis = face->face / 2, extent[3], size = 1;
    for (int d = 0; d < 3; d++) size *= extent[d] = d == axis ? mesh->ghosts : mesh->n[d];
    for (int c = 0; c < size; c++) {
        int at[3];
        for (int d = 0, rest = c; d < 3; rest /= extent[d], d++)
            at[d] = tile->at[d] * mesh->n[d] + rest % extent[d] +
                    (d != axis        ? 0
                     : face->face % 2 ? mesh->n[d]
                                      : -mesh->ghosts);
        check_third(two, face->strip[0] + c, (size_t)size, two->model->i_m, at);
        check_third(two, face->strip[0] + c, (size_t)size, two->model->i_E, at);
    }
}

/* The second level's own coarse-fine faces, whose ghosts are not at hand, change nothing. */
static void third_level_rests_on_the_second(void **state)
{
    (void)state;
    for (int dim = 1; dim <= 3; dim++) {
        struct twolevel two;
        struct mesh_change change;
        twolevel_start(&two, twolevel_case(dim, TWOLEVEL_GEOMETRY[0], FLOW_AIR), set_linear_conserved, in_second);
        const struct mesh *mesh = two.mesh;
        const struct level *third = &mesh->levels[2];
        twolevel_bear(&two);
        twolevel_close(&two);
        start_third(&two, dim, &change);
        struct bound *bound = bound_new(two.model, mesh, two.fine);
        struct prolong *prolong = prolong_new(two.model, mesh);
        prolong_tiles(prolong, two.mesh, 2, bound, change.born);
        prolong_strips(prolong, mesh, 1, bound, 0);
        link_down(third->link);
        for (unsigned t = 0; t < third->n_tile; t++)
            for (size_t c = 0; c < mesh->n_cell; c++) {
                int at[3];
                twolevel_at(mesh, &third->tiles[t], c, at);
                check_third(&two, third->u_old[t] + c, mesh->n_cell, two.model->i_m, at);
            }
        assert_true(third->link->n_face == 2u * (unsigned)dim << 2 * (dim - 1));
        for (unsigned f = 0; f < third->link->n_face; f++) check_third_strip(&two, &third->link->faces[f]);
        prolong_free(prolong);
        bound_free(bound);
        mesh_change_free(&change);
        twolevel_stop(&two);
    }
}

static void uniform_pressure_and_velocity_stay(void **state)
{
    (void)state;
    for (int dim = 1; dim <= 3; dim++)
        for (int i = 0; i < TWOLEVEL_PAIRS; i++) {
            struct twolevel two;
            twolevel_start(&two, twolevel_case(dim, TWOLEVEL_GEOMETRY[0], TWOLEVEL_PAIR[i]), twolevel_equilibrium,
                           NULL);
            const struct model *model = two.model;
            size_t n = two.mesh->n_cell;
            long long limited = twolevel_bear(&two);
            assert_true(limited * 4 < 3 * (long long)(two.coarse->n_tile * n)); /* the others have full slopes */
            for (unsigned t = 0; t < two.fine->n_tile; t++)                     /* where an iterated closure starts */
                for (size_t c = 0; c < n; c++) assert_true(fabs(two.fine->w[t][model->i_E * n + c] - 1e5) < 1.0);
            twolevel_close(&two);
            for (unsigned t = 0; t < two.fine->n_tile; t++)
                for (size_t c = 0; c < n; c++) {
                    double one[FLOW_FIELDS], stiffness[2], off = 0.0;
                    for (unsigned q = 0; q < model->n_field; q++) one[q] = two.fine->w[t][q * n + c];
                    mix_stiffness(model, 1, 1, one, stiffness);
                    for (int d = 0; d < dim; d++)
                        off = fmax(off, fabs(one[model->i_u + (unsigned)d] / (10.0 - 7.0 * d) - 1.0));
                    assert_true(off <= 1e-12);
                    off = fabs(one[model->i_E] - 1e5) / (one[0] * stiffness[0] + one[1] * stiffness[1]);
                    assert_true(off <= 1e-12);
                }
            twolevel_stop(&two);
        }
}

/* p, rho_l of a child inside the range of the coarse twolevel_range, fractions inside 0 and 1, materials well-posed. */
static void child_is_good(const struct twolevel *two, unsigned t, size_t c)
{
    const struct model *model = two->model;
    size_t n = two->mesh->n_cell;
    const double *u = two->fine->u_old[t] + c, *w = two->fine->w[t] + c;
    double sum = 0.0, low, high, one[FLOW_FIELDS], stiffness[SCENE_MATERIALS];
    int at[3], above[3];
    twolevel_at(two->mesh, &two->fine->tiles[t], c, at);
    for (int d = 0; d < 3; d++) above[d] = at[d] / 2;
    for (unsigned q = 0; q < model->n_field; q++) one[q] = w[q * n];
    mix_stiffness(model, 1, 1, one, stiffness);
    for (unsigned l = 0; l < model->n_alpha; l++) {
        double alpha = u[l * n], rho = w[(model->i_m + l) * n];
        sum += alpha;
        assert_true(alpha >= 0.0 && alpha <= 1.0 + 4e-16 && u[(model->i_m + l) * n] >= 0.0);
        if (w[l * n] == 0.0) continue;
        if (w[l * n] > 1e-6) assert_true(stiffness[l] > 0.0);
        twolevel_range(two, two->coarse->w, model->i_m + l, above, &low, &high); /* includes fill densities */
        double slack = (1e-7 + 1e-13 / w[l * n]) * rho;
        if (!(rho >= low - slack && rho <= high + slack))
            fail_msg("rho_%u = %g outside [%g, %g] at alpha %g", l, rho, low, high, w[l * n]);
    }
    assert_true(fabs(sum - 1.0) < 1e-14);
    twolevel_range(two, two->coarse->w, model->i_E, above, &low, &high);
    double coarse = twolevel_value(two->mesh, two->coarse, two->coarse->w, model->i_E, above), p = one[model->i_E];
    assert_true(p >= low - 0.11 * fabs(coarse) - 10.0 && p <= high + 0.11 * fabs(coarse) + 10.0);
}

/* Water and a gas at so low and rough a pressure that what p may leave its range by, the round-off of the
 * water, is more than p: only the gas, which bears no tension, objects. */
static void set_near_vacuum(const struct model *model, const double x[3], double *w)
{
    w[0] = 0.3 + 0.2 * x[0] + 0.01 * x[1];
    w[1] = 1.0 - w[0];
    w[2] = 1000.0;
    w[3] = 1e-5;
    memset(w + model->i_u, 0, (size_t)model->dim * sizeof *w);
    w[model->i_E] = flow_random(&twolevel_seed) < 0.5 ? 1e-3 : 0.1;
}

static void check_children(const char *materials, flow_setter *set, int dim)
{
    struct twolevel two;
    twolevel_start(&two, twolevel_case(dim, TWOLEVEL_GEOMETRY[0], materials), set, NULL);
    size_t n = two.mesh->n_cell, cells = two.coarse->n_tile * n;
    long long limited = twolevel_bear(&two);
    assert_true(limited > 0 && limited < (long long)cells);
    twolevel_close(&two);
    for (unsigned t = 0; t < two.fine->n_tile; t++)
        for (size_t c = 0; c < n; c++) child_is_good(&two, t, c);
    twolevel_stop(&two);
}

static void children_are_bounded_and_admissible(void **state)
{
    (void)state;
    for (int dim = 1; dim <= 3; dim++) {
        check_children(FLOW_WATER FLOW_AIR, twolevel_shock, dim);
        check_children(TWOLEVEL_MNASG FLOW_AIR, twolevel_shock, dim);
        check_children(FLOW_WATER FLOW_AIR, twolevel_half_rough, dim);
        check_children(FLOW_WATER FLOW_AIR, set_near_vacuum, dim);
    }
}

static void pure_stays_pure(void **state)
{
    (void)state;
    struct twolevel two;
    twolevel_start(&two, twolevel_case(2, TWOLEVEL_GEOMETRY[0], FLOW_WATER FLOW_AIR), twolevel_pure, NULL);
    size_t n = two.mesh->n_cell;
    twolevel_bear(&two);
    for (unsigned t = 0; t < two.fine->n_tile; t++)
        for (size_t c = 0; c < n; c++) {
            int at[3];
            twolevel_at(two.mesh, &two.fine->tiles[t], c, at);
            double *u = two.fine->u_old[t] + c, left = at[0] < 32 ? 1.0 : 0.0;
            assert_true(u[0] == left && u[n] == 1.0 - left);
            assert_true((u[2 * n] == 0.0) == (left == 0.0) && (u[3 * n] == 0.0) == (left == 1.0));
        }
    twolevel_stop(&two);
}

/* Restriction of what was born gives back the coarse state. */
static void restriction_undoes_birth(void **state)
{
    (void)state;
    for (int dim = 1; dim <= 3; dim++)
        for (int beta = 0; beta < 3; beta++) {
            struct twolevel two;
            if (beta == 1 ? dim != 2 : beta == 2 ? dim != 1 : 0) continue;
            twolevel_start(&two, twolevel_case(dim, TWOLEVEL_GEOMETRY[beta], FLOW_WATER FLOW_AIR), twolevel_half_rough,
                           NULL);
            size_t block = two.mesh->n_field * two.mesh->n_cell;
            double *before = mem_new(two.coarse->n_tile * block, sizeof *before), size[FLOW_FIELDS] = {0};
            for (unsigned t = 0; t < two.coarse->n_tile; t++)
                memcpy(before + t * block, two.coarse->u_old[t], block * sizeof *before);
            twolevel_bear(&two);
            for (unsigned t = 0; t < two.coarse->n_tile; t++) memset(two.coarse->u_old[t], 0, block * sizeof *before);
            for (int depth = 0; depth <= 1; depth++) restrict_averages(two.mesh, 1, depth); /* one rank: none travel */
            for (size_t i = 0; i < two.coarse->n_tile * block; i++) {
                size_t q = i % block / two.mesh->n_cell;
                size[q] = fmax(size[q], fabs(before[i]));
            }
            for (size_t i = 0; i < two.coarse->n_tile * block; i++) {
                size_t q = i % block / two.mesh->n_cell;
                if (fabs(two.coarse->u_old[i / block][i % block] - before[i]) > 4e-16 * size[q])
                    fail_msg("%dD, beta %d, field %zu: off by %g of %g", dim, beta, q,
                             two.coarse->u_old[i / block][i % block] - before[i], size[q]);
            }
            mem_free(before);
            twolevel_stop(&two);
        }
}

static void compare_mapped(const struct twolevel *a, const struct twolevel *b)
{
    const struct mesh *mesh = a->mesh;
    for (unsigned t = 0; t < b->fine->n_tile; t++)
        for (size_t c = 0; c < mesh->n_cell; c++) {
            int at[3], from[3] = {0};
            twolevel_at(mesh, &b->fine->tiles[t], c, at);
            twolevel_turn(mesh, a->fine, at, from);
            for (unsigned q = 0; q < mesh->n_field; q++) {
                double sign, value = b->fine->u_old[t][q * mesh->n_cell + c];
                unsigned plain = twolevel_turned(a->model, q, &sign);
                assert_true(value == sign * twolevel_value(mesh, a->fine, a->fine->u_old, plain, from));
            }
        }
}

static void check_symmetry(int dim, const double sign[3], const int axis[3])
{
    struct twolevel a, b;
    twolevel_start_pair(&a, &b, dim, sign, axis);
    assert_int_equal(twolevel_bear(&a), twolevel_bear(&b));
    compare_mapped(&a, &b);
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
        cmocka_unit_test(born_tiles_reproduce_linear_fields),
        cmocka_unit_test(third_level_rests_on_the_second),
        cmocka_unit_test(uniform_pressure_and_velocity_stay),
        cmocka_unit_test(children_are_bounded_and_admissible),
        cmocka_unit_test(pure_stays_pure),
        cmocka_unit_test(restriction_undoes_birth),
        cmocka_unit_test(symmetry_keeps_bits),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
