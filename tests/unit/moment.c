/* A moment of output (derive.h): what fields need is brought once for all outputs, and they read what they would have
 * read alone. */
#include "io/measure.h"
#include "io/probes.h"
#include "io/snapshot.h"
#include "levels_io.h"

#include <math.h>

static bool inside(const double *x)
{
    return fabs(x[0] - 0.5) < 0.3 && fabs(x[1] - 0.5) < 0.3;
}

static bool core(const double *x)
{
    return fabs(x[0] - 0.5) < 0.13 && fabs(x[1] - 0.5) < 0.13;
}

#define WHIRL                                                                                             \
    "bulla: 1\ndomain: {lower: [0, 0], upper: [1, 1], cells: [32, 32],\n"                                 \
    "  boundaries: {x-: outflow, x+: outflow, y-: outflow, y+: outflow}}\nmesh: {tile: 8}\n"              \
    "materials:\n  air: {eos: {type: ideal-gas, gamma: 1.4}}\n"                                           \
    "  helium: {eos: {type: ideal-gas, gamma: 1.667}}\n"                                                  \
    "initial:\n  - {everywhere: true, material: air, density: = 1 + x + 2 * y, pressure: 1e5,"            \
    " velocity: [= -3 * y * y, = 3 * x]}\n"                                                               \
    "  - {sphere: {center: [0.4, 0.4], radius: 0.2}, material: helium, density: 0.2, pressure: 1e5}\n"    \
    "run: {until: 1 ms}\noutput:\n  history:\n    columns: {w: {max: vorticity}, s: {min: schlieren},"    \
    " T: {mean: temperature_air}}\n  probes:\n    a: {at: [0.31, 0.5], fields: [schlieren, vorticity]}\n" \
    "    b: {at: [0.5, 0.5], fields: [vorticity, temperature_air]}\n"                                     \
    "  snapshots: {every: 1 step, fields: [density, vorticity, schlieren]}\n"

/* Everything that is due at one moment brings the neighbours' layers once, and reads what it would have read alone. */
static void test_moment(void **state)
{
    (void)state;
    struct small small;
    struct measures *measures;
    struct probes *probes;
    struct snapshots *snapshots;
    double alone[3], together[3];
    small_start_levels(&small, WHIRL, 2);
    levels_add(small.state, inside);
    levels_add(small.state, core);
    assert_int_equal(measure_new(small.state, &measures), 0);
    assert_int_equal(probes_new(small.state, &probes), 0);
    assert_int_equal(snapshot_new(small.state, &snapshots), 0);
    measure_take(measures, small.state, SMALL_NOW(small.state), NULL, alone);
    struct derive_moment moment = derive_moment(small.state->model, small.state->mesh, small.state->t);
    struct derive density, vorticity;
    assert_int_equal(derive_find(small.state->model, "density", &density), 0);
    assert_int_equal(derive_find(small.state->model, "vorticity", &vorticity), 0);
    derive_prepare(&moment, &density);
    assert_int_equal(moment.exchanges, 0);
    derive_prepare(&moment, &vorticity);
    assert_int_equal(moment.exchanges, 1);
    assert_int_equal(probes_record(probes, small.state, &moment), 0);
    measure_take(measures, small.state, &moment, NULL, together);
    assert_int_equal(snapshot_write(snapshots, small.state, &moment, "{}"), 0);
    assert_int_equal(moment.exchanges, 1);
    assert_memory_equal(alone, together, sizeof alone);
    assert_true(alone[0] > 3.0 && alone[1] < 1.0 && alone[2] > 0.0);
    snapshot_free(snapshots);
    probes_free(probes);
    measure_free(measures);
    small_stop(&small);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(test_moment)};
    if (registry_init()) return 1;
    return cmocka_run_group_tests(tests, NULL, NULL);
}
