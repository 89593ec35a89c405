/* Liquid that comes through the surface of a pair with an `onset` leaves the cell behind it with the density that the
 * straight line from the surface to the cell before has at the face; beside vapour its velocity is the vapour's. No
 * other edge changes, and a mirror changes nothing. */
#include "flow.h"

#include "scheme/edges_front.h"

enum { CELLS = 4, PITCH = 8 };

#define BEGIN                                                                                            \
    "bulla: 1\ndomain: {lower: [0], upper: [16], cells: [16], boundaries: {x-: outflow, x+: outflow}}\n" \
    "materials:\n  water: {eos: {type: nasg, preset: water-2016}, conductivity: 0.6 W/m/K}\n"            \
    "  steam: {eos: {type: ideal-gas, preset: water-2016}}\n"                                            \
    "phase-change:\n  - {liquid: water, vapour: steam, onset: 0.99}\ninitial:\n"                         \
    "  - {everywhere: true, material: water, temperature: 360, pressure: 1 bar}\nrun: {until: 1}\n"

/* Edges of the liquid's density, lower and upper by cell, from fractions of vapour; `back`: the row turned round. */
static void edges(const struct model *model, const double thin[CELLS], const double rho[CELLS], bool back,
                  double ret[CELLS][2])
{
    static double w[FLOW_FIELDS * PITCH], state[2 * FLOW_FIELDS * PITCH], room[PITCH];
    static const double calm[PITCH];
    double *upper = state + 2 * model->i_m * PITCH, *lower = upper + CELLS;
    for (size_t i = 0; i < CELLS; i++) {
        size_t at = back ? CELLS - 1 - i : i;
        w[model->i_alpha * PITCH + at] = 1.0 - thin[i];
        w[(model->i_alpha + 1) * PITCH + at] = thin[i];
        w[model->i_m * PITCH + at] = lower[at] = upper[at] = rho[i];
    }
    edges_front(&(struct edges_front){
        .model = model, .n = CELLS, .step = 1, .pitch = PITCH, .w = w, .state = state, .mask = calm, .thin = room});
    for (size_t i = 0; i < CELLS; i++) {
        size_t at = back ? CELLS - 1 - i : i;
        ret[i][0] = back ? upper[at] : lower[at];
        ret[i][1] = back ? lower[at] : upper[at];
    }
}

/* d = (1/2 - before)/(behind - before) of 0.8, and of 1/2 and less: the mean of the line, 957 or saturated, and of what
 * the cells before go on to, 953 or what bounds it. */
static void test_line(void **state)
{
    (void)state;
    static const double thin[][CELLS] = {{0.0, 0.1, 0.6, 1.0}, {0.0, 0.2, 0.8, 1.0}, {0.0, 0.4, 0.9, 1.0}};
    static const double rho[][CELLS] = {{950.0, 952.0, 960.0, 961.0},
                                        {990.0, 952.0, 960.0, 961.0}}; /* bounded by 952 */
    static const double expected[][3] = {{955.0, 956.5, 956.5}, {954.5, 956.0, 956.0}};
    struct flow flow;
    flow_start(&flow, mem_print("%s", BEGIN));
    for (int k = 0; k < 12; k++) {
        const double *row = rho[k / 6];
        double at[CELLS][2];
        edges(flow.state->model, thin[k % 3], row, k % 2, at);
        assert_true(fabs(at[2][0] - expected[k / 6][k % 3]) < 1e-10);
        for (size_t i = 0; i < CELLS; i++) assert_true(at[i][1] == row[i] && (i == 2 || at[i][0] == row[i]));
    }
    flow_stop(&flow);
}

/* No surface: all before it, all behind it, or no liquid behind it. */
static void test_none(void **state)
{
    (void)state;
    static const double thin[][CELLS] = {{0.0, 0.1, 0.2, 0.3}, {0.6, 0.7, 0.8, 0.9}, {0.0, 0.1, 1.0, 1.0}};
    static const double rho[CELLS] = {950.0, 952.0, 960.0, 961.0};
    struct flow flow;
    flow_start(&flow, mem_print("%s", BEGIN));
    for (int k = 0; k < 3; k++) {
        double at[CELLS][2];
        edges(flow.state->model, thin[k], rho, false, at);
        for (size_t i = 0; i < CELLS; i++) assert_true(at[i][0] == rho[i] && at[i][1] == rho[i]);
    }
    flow_stop(&flow);
}

static double w_vapour; /* density of the vapour */

/* Velocities at the face between a wet cell and a dry one, below or above it: of the wet cell's edge, and of the dry
 * cell's. u, thin, p: of the wet cell and the dry one. */
static void meet(const struct model *model, const double thin[2], const double p[2], bool troubled, const double u[2],
                 bool above, double ret_u[2])
{
    static double w[FLOW_FIELDS * PITCH], state[2 * FLOW_FIELDS * PITCH], room[PITCH];
    double mask[2] = {0.0, troubled ? 1.0 : 0.0}, *upper = state + 2 * model->i_u * PITCH, *lower = upper + 2;
    for (size_t i = 0; i < 2; i++) {
        size_t at = above ? 1 - i : i;
        w[model->i_alpha * PITCH + at] = 1.0 - thin[i];
        w[(model->i_alpha + 1) * PITCH + at] = thin[i];
        w[model->i_E * PITCH + at] = p[i];
        w[(model->i_m + 1) * PITCH + at] = w_vapour;
        upper[at] = lower[at] = u[i];
    }
    edges_front(&(struct edges_front){
        .model = model, .n = 2, .step = 1, .pitch = PITCH, .w = w, .state = state, .mask = mask, .thin = room});
    ret_u[0] = above ? lower[1] : upper[0];
    ret_u[1] = above ? upper[0] : lower[1];
    assert_true((above ? upper[1] : lower[0]) == u[0] && (above ? lower[0] : upper[1]) == u[1]);
}

static void test_velocity(void **state)
{
    (void)state;
    static const struct {
        double thin[2], p[2];
        bool troubled;
        double u, rho; /* of the wet cell's edge; of the vapour */
    } cases[] = {
        {{0.8, 1.0}, {1e5, 1e5}, false, 1.25, 62.5}, /* half of a tenth of sqrt(p/rho) */
        {{0.8, 1.0}, {1e5, 1e5}, false, 2.25, 250.0},  {{0.8, 0.995}, {1e5, 1e5}, false, 0.25, 0.0},
        {{0.8, 1.0}, {1e5, 1.25e5}, false, 0.75, 0.0}, {{0.8, 1.0}, {1.5e5, 1e5}, false, 1.25, 0.0},
        {{0.8, 1.0}, {2e5, 1e5}, false, 2.25, 0.0},    {{0.8, 1.0}, {-1e5, 1e5}, false, 2.25, 0.0},
        {{0.8, 1.0}, {1e5, 1e5}, true, 2.25, 0.0},     {{0.8, 0.98}, {1e5, 1e5}, false, 2.25, 0.0},
        {{0.995, 1.0}, {1e5, 1e5}, false, 2.25, 0.0},  {{0.0, 1.0}, {1e5, 1e5}, false, 2.25, 0.0},
    };
    struct flow flow;
    flow_start(&flow, mem_print("%s", BEGIN));
    for (size_t k = 0; k < sizeof cases / sizeof *cases; k++)
        for (int above = 0; above < 2; above++) {
            double away = above ? 1.0 : -1.0, u[2];
            const double leaves[2] = {away * 2.25, away * 0.25}, meets[2] = {away * 0.25, away * 2.25};
            w_vapour = cases[k].rho;
            meet(flow.state->model, cases[k].thin, cases[k].p, cases[k].troubled, leaves, above, u);
            assert_true(u[0] == away * cases[k].u && u[1] == leaves[1]);
            meet(flow.state->model, cases[k].thin, cases[k].p, cases[k].troubled, meets, above, u);
            assert_true(u[0] == meets[0] && u[1] == meets[1]);
        }
    flow_stop(&flow);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(test_line), cmocka_unit_test(test_none),
                                       cmocka_unit_test(test_velocity)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
