/* A surface between a liquid and its vapour that lies on faces of cells: where heat is carried to it, both sides begin
 * with a trace of the other, whichever tiles they are in; no other surface does, and none where a cell is cut. */
#include "flow.h"

#include "phys/phase_pair.h"
#include "solve/unmixed.h"

static struct flow flow;

/* Materials water, steam and stone; `heat`: of the water. */
static void begin(const char *domain, const char *heat, const char *initial)
{
    flow_start(&flow, mem_print("bulla: 1\n%s\nmaterials:\n  water: {eos: {type: nasg, preset: water-2016}%s}\n"
                                "  steam: {eos: {type: ideal-gas, preset: water-2016}}\n"
                                "  stone: {eos: {type: stiffened-gas, preset: begostone}}\n"
                                "phase-change:\n  - {liquid: water, vapour: steam, onset: 0}\ninitial:\n"
                                "  - {everywhere: true, material: water, temperature: 360, pressure: 1 bar}\n"
                                "%srun: {until: 1}\n",
                                domain, heat, initial));
}

/* Cells of all levels that hold a material and something else, and the smaller part at least on the finest. */
static int mixed(unsigned l, double *ret_least, double *ret_sum)
{
    const struct mesh *mesh = flow.state->mesh;
    int count = 0;
    *ret_least = 1.0, *ret_sum = 0.0;
    for (int level = 0; level < mesh->n_level; level++)
        for (unsigned t = 0; t < mesh->levels[level].n_local; t++)
            for (size_t c = 0; c < mesh->n_cell; c++) {
                double a = mesh->levels[level].u_old[t][(flow.state->model->i_alpha + l) * mesh->n_cell + c];
                double trace = a < 0.5 ? a : 1.0 - a;
                if (!(trace > 0.0)) continue;
                count++;
                *ret_sum += a;
                if (level == mesh->n_level - 1) *ret_least = trace < *ret_least ? trace : *ret_least;
            }
    return count;
}

static void expect(int steam, int stone)
{
    double least, sum;
    assert_int_equal(mixed(1, &least, &sum), steam);
    if (steam) assert_true(least > PHASE_PAIR_FELT);
    assert_int_equal(mixed(2, &least, &sum), stone);
    assert_true(unmixed_is(flow.state, 0) == (steam == 0));
    flow_stop(&flow);
}

#define LINE \
    "domain: {lower: [0], upper: [16], cells: [16], boundaries: {x-: reflecting, x+: outflow}}\nmesh: {tile: %d}"
#define PLANE                                                                                                        \
    "domain: {lower: [0, 0], upper: [8, 8], cells: [8, 8], boundaries: {x-: outflow, x+: outflow, y-: outflow, y+: " \
    "outflow}}\nmesh: {tile: 4}"
#define HEAT ", conductivity: 0.6 W/m/K"

static void test_line(void **state)
{
    (void)state;
    static const char slab[] =
        "  - {box: {lower: [4], upper: [8]}, material: steam, temperature: 360, pressure: 1 bar}\n";
    for (int tile = 4; tile <= 16; tile *= 2) {
        char *domain = mem_print(LINE, tile);
        begin(domain, HEAT, slab);
        expect(4, 0);
        begin(domain, "", slab);
        expect(0, 0);
        mem_free(domain);
    }
}

/* What is lost on one side is had on the other. */
static void test_volume(void **state)
{
    (void)state;
    double least, sum;
    begin("domain: {lower: [0], upper: [16], cells: [16], boundaries: {x-: reflecting, x+: outflow}}", HEAT,
          "  - {box: {lower: [4], upper: [8]}, material: steam, temperature: 360, pressure: 1 bar}\n");
    assert_int_equal(mixed(1, &least, &sum), 4);
    assert_true(fabs(sum - 2.0) < 1e-14 && fabs(least - 4e-6) < 1e-10);
    flow_stop(&flow);
}

static void test_plane(void **state)
{
    (void)state;
    begin(PLANE, HEAT,
          "  - {box: {lower: [0, 0], upper: [2, 8]}, material: stone, density: 2000, pressure: 1 bar}\n"
          "  - {box: {lower: [4, 2], upper: [6, 6]}, material: steam, temperature: 360, pressure: 1 bar}\n");
    expect(8 + 12, 0); /* the edge of 2 by 4 cells within and without; corners touch nothing */
    begin(PLANE, HEAT,
          "  - {box: {lower: [4, 2], upper: [6, 6]}, material: steam, temperature: 360, pressure: 1 bar}\n"
          "  - {box: {lower: [0, 0], upper: [0.5, 1]}, material: steam, temperature: 360, pressure: 1 bar}\n");
    expect(1, 0);
}

static void test_ball(void **state)
{
    (void)state;
    static const char ball[] =
        "  - {sphere: {center: [0], radius: 1}, material: steam, temperature: 360, pressure: 1 bar}\n";
    begin("domain: {geometry: spherical, lower: [0], upper: [8], cells: [8], boundaries: {x-: symmetry, x+: outflow}}",
          HEAT, ball);
    expect(2, 0);
    begin("domain: {geometry: spherical, lower: [0], upper: [8], cells: [8], boundaries: {x-: symmetry, x+: outflow}}\n"
          "mesh: {levels: 1, tile: 4, refine: [{interface: water}]}",
          HEAT, ball);
    expect(4, 0); /* on both levels */
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(test_line), cmocka_unit_test(test_volume),
                                       cmocka_unit_test(test_plane), cmocka_unit_test(test_ball)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
