/* overlap.c - two meshes that are refined in different places: each place is visited once, on the coarser cells. */
#include "judge/overlap.h"

#include "base/mem.h"
#include "base/status.h"
#include "close.h"

#include <string.h>

/* [0, 1]^2 in 4 x 4 cells, of which those with `lower` <= x < `upper` are halved; each has the mean of x + 2 y. */
static struct snapshot *mesh(double lower, double upper, int cells, double **ret_values)
{
    struct snapshot *snapshot = mem_new(1, sizeof *snapshot);
    size_t most = 4u * (size_t)(cells * cells);
    snapshot->dim = 2;
    snapshot->domain[1][0] = snapshot->domain[1][1] = 1.0;
    snapshot->lower = mem_new(most, sizeof *snapshot->lower);
    snapshot->upper = mem_new(most, sizeof *snapshot->upper);
    *ret_values = mem_new(most, sizeof **ret_values);
    for (int i = 0; i < cells; i++)
        for (int j = 0; j < cells; j++) {
            double x = (double)i / cells;
            int parts = x >= lower && x < upper ? 2 : 1;
            for (int k = 0; k < parts * parts; k++) {
                size_t c = snapshot->n_cell++;
                double h = 1.0 / (cells * parts), at[2] = {x + k % parts * h, (double)j / cells + k / parts * h};
                for (int d = 0; d < 2; d++) {
                    snapshot->lower[c][d] = at[d];
                    snapshot->upper[c][d] = at[d] + h;
                }
                (*ret_values)[c] = at[0] + 0.5 * h + 2.0 * (at[1] + 0.5 * h);
            }
        }
    return snapshot;
}

struct sums {
    int n;
    double size, most, least;
};

static void add(void *data, double size, double one, double other)
{
    struct sums *sums = data;
    double difference = fabs(one - other);
    sums->n++;
    sums->size += size;
    if (difference > sums->most) sums->most = difference;
    if (size < sums->least) sums->least = size;
}

static int compare(struct snapshot *a, const double *va, struct snapshot *b, const double *vb, struct sums *ret_sums)
{
    *ret_sums = (struct sums){.least = 1.0};
    return overlap_visit(&(struct overlap_side){a, va, 1}, &(struct overlap_side){b, vb, 1}, add, ret_sums);
}

/* Left half against right half, and against the same mesh. */
static void places_are_visited_once(void **state)
{
    (void)state;
    double *left_values, *right_values;
    struct snapshot *left = mesh(0.0, 0.5, 4, &left_values), *right = mesh(0.5, 1.0, 4, &right_values);
    struct sums sums;
    assert_int_equal(compare(left, left_values, right, right_values, &sums), 0);
    assert_int_equal(sums.n, 16);
    assert_close(sums.size, 1.0, 1e-12);
    assert_close(sums.most, 0.0, 1e-12);
    right_values[0] += 4e-3; /* a coarse cell, and one of four fine ones in a coarse cell */
    assert_int_equal(compare(left, left_values, right, right_values, &sums), 0);
    assert_close(sums.most, 4e-3, 1e-12);
    right_values[0] -= 4e-3;
    left_values[0] += 4e-3;
    assert_int_equal(compare(left, left_values, right, right_values, &sums), 0);
    assert_close(sums.most, 1e-3, 1e-12);
    assert_int_equal(compare(left, left_values, left, left_values, &sums), 0);
    assert_int_equal(sums.n, 8 + 32);
    assert_close(sums.least, 1.0 / 64, 1e-12);
    assert_true(sums.most == 0.0);
    mem_free(left_values);
    mem_free(right_values);
    read_free(left);
    read_free(right);
}

static void other_lattices_are_refused(void **state)
{
    (void)state;
    double *three_values, *four_values;
    struct snapshot *three = mesh(0.0, 0.0, 3, &three_values), *four = mesh(0.0, 0.0, 4, &four_values);
    struct sums sums;
    assert_int_equal(compare(three, three_values, four, four_values, &sums), STATUS_CASE);
    assert_non_null(strstr(status_text(), "lattice"));
    mem_free(three_values);
    mem_free(four_values);
    read_free(three);
    read_free(four);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(places_are_visited_once),
        cmocka_unit_test(other_lattices_are_refused),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
