/* Sums over tiles do not lose what rounding takes of large terms that cancel; and a point on a face belongs to the cell
 * above, on the last face of the domain to the last cell. */
#include "mesh/tally.h"

#include "flow.h"

static void start(struct flow *flow)
{
    flow_start(flow,
               mem_print(
                   "bulla: 1\ntitle: tally\ndomain: {lower: [0], upper: [1], cells: [64], boundaries: {x-: outflow, "
                   "x+: outflow}}\nmesh: {tile: 8}\nmaterials:\n" FLOW_AIR
                   "initial:\n  - {everywhere: true, material: air, density: 1, pressure: 1e5}\nrun: {until: 1}\n"));
}

static void test_sum(void **state)
{
    (void)state;
    static const double values[8] = {1e16, 1.0, 1.0, 1.0, 1.0, 1.0, 0.5, -1e16};
    struct flow flow;
    double local[16], total[2];
    start(&flow);
    assert_int_equal(tally_tiles(flow.state->mesh), 8);
    for (int i = 0; i < 8; i++) {
        local[2 * i] = values[i];
        local[2 * i + 1] = i;
    }
    tally_add(flow.state->mesh, 2, local, total);
    assert_true(total[0] == 5.5 && total[1] == 28.0);
    flow_stop(&flow);
}

static void test_locate(void **state)
{
    (void)state;
    struct flow flow;
    start(&flow);
    for (int i = 0; i <= 64; i++) {
        size_t cell;
        int l;
        unsigned tile;
        assert_true(mesh_locate(flow.state->mesh, (const double[3]){i / 64.0}, &l, &tile, &cell));
        assert_int_equal(8 * tile + cell, i < 64 ? i : 63);
        assert_int_equal(l, 0);
    }
    flow_stop(&flow);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(test_sum), cmocka_unit_test(test_locate)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
