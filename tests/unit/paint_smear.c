/* A painted surface between a liquid and its vapour, with an `onset` and conduction: both sides begin with a twentieth
 * of the other, nothing is lost or won, whichever tiles the cells are in; what is not of the pair stays sharp. */
#include "flow.h"

static struct flow flow;

enum { CELLS = 16 };

/* Materials water, steam and stone. */
static void begin(const char *domain, int tile, const char *heat, const char *onset, const char *initial)
{
    flow_start(&flow, mem_print("bulla: 1\ndomain: {%s, lower: [0], upper: [16], cells: [16]}\nmesh: {tile: %d}\n"
                                "materials:\n  water: {eos: {type: nasg, preset: water-2016}%s}\n"
                                "  steam: {eos: {type: ideal-gas, preset: water-2016}}\n"
                                "  stone: {eos: {type: stiffened-gas, preset: begostone}}\n"
                                "phase-change:\n  - {liquid: water, vapour: steam%s}\ninitial:\n"
                                "  - {everywhere: true, material: water, temperature: 360, pressure: 1 bar}\n"
                                "%srun: {until: 1}\n",
                                domain, tile, heat, onset, initial));
}

#define HEAT ", conductivity: 0.6 W/m/K"
#define ONSET ", onset: 0.99"
#define BALL "geometry: spherical, boundaries: {x-: symmetry, x+: outflow}"
#define LINE "boundaries: {x-: outflow, x+: outflow}"
#define STEAM "material: steam, temperature: 380, pressure: 1 bar}\n"

/* Component q of all cells. */
static void take(unsigned q, double ret[CELLS])
{
    const struct mesh *mesh = flow.state->mesh;
    size_t at = 0;
    for (unsigned t = 0; t < mesh->levels[0].n_local; t++)
        for (size_t c = 0; c < mesh->n_cell; c++) ret[at++] = mesh->levels[0].u_old[t][q * mesh->n_cell + c];
    assert_int_equal(at, CELLS);
}

static double steam(size_t i)
{
    double row[CELLS];
    take(flow.state->model->i_alpha + 1, row);
    return row[i];
}

static void test_shares(void **state)
{
    (void)state;
    for (int tile = 4; tile <= 16; tile *= 2) {
        double a[CELLS];
        begin(LINE, tile, HEAT, ONSET,
              "  - {box: {lower: [4], upper: [8]}, " STEAM
              "  - {box: {lower: [12], upper: [14]}, material: stone, density: 2000, pressure: 1 bar}\n");
        take(flow.state->model->i_alpha + 1, a);
        for (size_t i = 0; i < CELLS; i++) {
            double inside = i >= 4 && i < 8 ? 1.0 : 0.0, beside = i == 3 || i == 8 ? 0.05 : 0.0;
            if (i == 4 || i == 7) inside = 0.95;
            assert_true(fabs(a[i] - inside - beside) < 1e-15);
        }
        take(flow.state->model->i_alpha + 2, a);
        for (size_t i = 0; i < CELLS; i++) assert_true(a[i] == (i == 12 || i == 13 ? 1.0 : 0.0));
        flow_stop(&flow);
    }
}

/* Without an `onset`, or without conduction, nothing is smeared. */
static void test_others(void **state)
{
    (void)state;
    static const char *const heat[] = {HEAT, ""}, *const onset[] = {", onset: 0", ONSET};
    for (int i = 0; i < 2; i++) {
        begin(LINE, 16, heat[i], onset[i], "  - {box: {lower: [4.5], upper: [8]}, " STEAM);
        assert_true(steam(4) == 0.5 && steam(5) == 1.0 && steam(3) == 0.0);
        flow_stop(&flow);
    }
}

/* Sums over a ball, whose cells differ in size: those of the sharp one, field by field, whichever tiles. */
static void test_sums(void **state)
{
    (void)state;
    static const char ball[] = "  - {sphere: {center: [0], radius: 2.3}, " STEAM;
    double sum[3][FLOW_FIELDS] = {{0}}, row[CELLS], first[FLOW_FIELDS][CELLS];
    for (int turn = 0; turn < 3; turn++) {
        begin(BALL, turn == 2 ? 4 : 16, turn ? HEAT : "", ONSET, ball);
        unsigned n_field = flow.state->model->n_field;
        for (unsigned q = 0; q < n_field; q++) {
            take(q, row);
            for (int i = 0; i < CELLS; i++) sum[turn][q] += row[i] * (pow(i + 1, 3) - pow(i, 3));
            if (turn == 1) memcpy(first[q], row, sizeof row);
            if (turn == 2) assert_memory_equal(first[q], row, sizeof row);
            if (turn) assert_true(fabs(sum[turn][q] - sum[0][q]) <= 1e-13 * fabs(sum[0][q]));
        }
        assert_true((steam(3) > 0.0) == (turn > 0));
        flow_stop(&flow);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(test_shares), cmocka_unit_test(test_others),
                                       cmocka_unit_test(test_sums)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
