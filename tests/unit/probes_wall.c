/* Probes between the last centre and a wall, at both ends of each axis and in the corners: the value of the cell,
 * constant beyond its centre, never one drawn from the cell behind. */
#include "io/probes.h"

#include "small.h"

#include <math.h>

#define CELLS 16
#define H (1e-3 / CELLS)

static double field(double x, double y)
{
    return 1e5 + 1e8 * x + 3e8 * y;
}

/* Probes at parts 0, 1/4, 1/2 of the outermost cells along both axes. */
static void test_walls(void **state)
{
    (void)state;
    static const double places[] = {0.0, 0.25 * H, 0.5 * H, 1e-3 - 0.5 * H, 1e-3 - 0.25 * H, 1e-3};
    enum { N = sizeof places / sizeof *places };
    char *text = mem_print("bulla: 1\ndomain: {lower: [0, 0], upper: [1 mm, 1 mm], cells: [%d, %d], boundaries: {x-: "
                           "reflecting, x+: outflow, y-: symmetry, y+: reflecting}}\nmesh: {tile: 8}\n" SMALL_MATERIALS
                           "initial:\n  - {everywhere: true, material: water, density: 1000, pressure: = 1e5 + 1e8 * x "
                           "+ 3e8 * y}\nrun: {until: 1 us}\noutput:\n  probes:\n",
                           CELLS, CELLS);
    for (int i = 0; i < N; i++)
        for (int j = 0; j < N; j++) {
            char *more =
                mem_print("%s    p%d%d: {at: [%.17g, %.17g], fields: [pressure]}\n", text, i, j, places[i], places[j]);
            mem_free(text);
            text = more;
        }
    struct small small;
    struct probes *probes;
    small_start(&small, text);
    mem_free(text);
    assert_int_equal(probes_new(small.state, &probes), 0);
    assert_int_equal(probes_record(probes, small.state, SMALL_NOW(small.state)), 0);
    probes_free(probes);
    char *file = small_text(&small, "probes.csv"), *at = strchr(file, '\n') + 1;
    strtod(at, &at); /* t */
    for (int i = 0; i < N; i++)
        for (int j = 0; j < N; j++) {
            double x = fmin(fmax(places[i], 0.5 * H), 1e-3 - 0.5 * H),
                   y = fmin(fmax(places[j], 0.5 * H), 1e-3 - 0.5 * H);
            double value = strtod(at + 1, &at);
            if (!(fabs(value - field(x, y)) <= 1e-9 * field(x, y)))
                fail_msg("at (%g, %g): %.12g, not %.12g", places[i], places[j], value, field(x, y));
        }
    mem_free(file);
    small_stop(&small);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(test_walls)};
    if (registry_init()) return 1;
    return cmocka_run_group_tests(tests, NULL, NULL);
}
