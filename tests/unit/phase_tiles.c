/* phase_tiles.c - water that may cavitate anywhere is alone in its tiles until it does: small tiles are advanced
 * without vapour or skipped, to the same bits as one tile that holds everything, and none misses the moment. */
#include "phase_box.h"

enum { STEPS = 30 };

static const char LINE[] = "{lower: [0], upper: [1], cells: [128], boundaries: {x-: reflecting, x+: reflecting}}",
                  PLANE[] = "{lower: [0, 0], upper: [1, 1], cells: [64, 64], boundaries: {x-: reflecting, x+: outflow, "
                            "y-: reflecting, y+: outflow}}";

static const char *materials = PHASE_BOX_NASG PHASE_BOX_AIR;

/* Water of 300 K that is torn apart in the middle, and air in a corner; far from both it rests. */
static void torn(const struct model *model, const double x[3], double *w)
{
    double p = 1e5, T = 300.0, r = hypot(x[0] - 0.5, model->dim > 1 ? x[1] - 0.5 : 0.0);
    double air = x[0] < 0.1 && (model->dim < 2 || x[1] < 0.1) ? 1.0 : 0.0;
    w[model->i_alpha] = 1.0 - air;
    w[model->i_alpha + 2] = air;
    for (unsigned l = 0; l < model->n_material; l++)
        model->eos[l].law->density(model->eos[l].self, 1, &p, &T, &w[model->i_m + l]);
    w[model->i_u] = r < 0.06 ? (x[0] > 0.5 ? 20.0 : -20.0) : 0.0;
    w[model->i_E] = p;
}

/* Stretched water at rest that fills everything. */
static void stretched(const struct model *model, const double x[3], double *w)
{
    double p = -1e6, T = 300.0;
    (void)x;
    w[model->i_alpha] = 1.0;
    model->eos[0].law->density(model->eos[0].self, 1, &p, &T, &w[model->i_m]);
    for (unsigned l = 1; l < model->n_material; l++) w[model->i_m + l] = 1.0;
    w[model->i_E] = p;
}

/* Vapour that is squeezed, then a mixture. */
static void squeezed(const struct model *model, const double x[3], double *w)
{
    double p = 1e5, T = 380.0, water = x[0] > 0.7 ? 0.8 : 0.0;
    w[model->i_alpha] = water;
    w[model->i_alpha + 1] = 1.0 - water;
    for (unsigned l = 0; l < model->n_material; l++)
        model->eos[l].law->density(model->eos[l].self, 1, &p, &T, &w[model->i_m + l]);
    w[model->i_u] = 20.0 * cos(6.283185307179586 * x[0]);
    w[model->i_E] = p;
    if (!model->n_solid) return;
    w[model->i_u] *= -1.0; /* the mixture is squeezed; a gel far away would share its traction */
    w[model->i_alpha + 2] = x[0] < 0.1 ? 1.0 : 0.0;
    w[model->i_alpha + 1] -= w[model->i_alpha + 2];
    for (unsigned c = 0; c < 3; c++) w[model->solids[0].stretch + c] = 1.0;
}

static void run(struct flow *flow, flow_setter *set, const char *domain, int tile, const char *pair, const char *scheme)
{
    flow_start(flow,
               mem_print("bulla: 1\ndomain: %s\nmesh: {tile: %d}\nmaterials:\n%sphase-change:\n  - {liquid: water, "
                         "vapour: steam, where: everywhere%s}\ninitial:\n  - {everywhere: true, material: water, "
                         "temperature: 300, pressure: 1 bar}\nscheme: %s\nrun: {until: 1}\n",
                         domain, tile, materials, pair, scheme));
    flow_set(flow, set);
    flow_steps(flow, STEPS);
}

/* Volume of vapour, over that of the domain. */
static double vapour(const struct flow *flow)
{
    double *alpha = flow_primitive(flow, flow->state->model->i_alpha + 1), sum = 0.0;
    for (size_t i = 0; i < flow->n_cell; i++) sum += alpha[i];
    mem_free(alpha);
    return sum / (double)flow->n_cell;
}

/* Tiles that are advanced without some material. */
static unsigned narrowed(const struct flow *flow)
{
    unsigned n = 0;
    for (unsigned t = 0; t < flow_level(flow)->n_local; t++)
        n += flow->state->stages[0]->census.tiles[t].path != flow->state->model;
    return n;
}

static void check(flow_setter *set, const char *domain, int tile, const char *pair, const char *scheme)
{
    struct flow one, many;
    run(&one, set, domain, tile, pair, scheme);
    run(&many, set, domain, 8, pair, scheme);
    print_message("%s: %u of %u tiles narrowed, %lld of %lld cells carried on, vapour %.3g\n", scheme, narrowed(&many),
                  flow_level(&many)->n_local, many.state->counts.carried, many.state->counts.cells, vapour(&many));
    assert_true(flow_equal(&one, &many) && one.state->t == many.state->t);
    assert_true(vapour(&many) > 0.0);
    if (set == torn) {
        assert_true(narrowed(&many) > 0 && narrowed(&one) == 0);
        assert_true(many.state->counts.carried > many.state->counts.cells / 8);
    }
    flow_stop(&one);
    flow_stop(&many);
}

static void test_torn(void **state)
{
    (void)state;
    check(torn, LINE, 128, "", "{}");
    check(torn, LINE, 128, ", nucleation: {tension: 1 MPa}", "{integrator: ssprk3, limiter: superbee}");
    check(torn, LINE, 128, ", rate: {type: relaxation, time: 1 us}", "{riemann: hll}");
    check(torn, PLANE, 64, "", "{}");
    check(torn, PLANE, 64, ", gases: [air]", "{limiter: van-leer}");
}

static void test_laws(void **state)
{
    (void)state;
    materials = PHASE_BOX_IAPWS PHASE_BOX_AIR;
    check(torn, LINE, 128, "", "{}");
    materials = PHASE_BOX_NASG PHASE_BOX_AIR PHASE_BOX_STONE;
    check(torn, PLANE, 64, "", "{}");
    materials = PHASE_BOX_NASG PHASE_BOX_AIR;
}

/* What rests uniformly is stretched all the same. */
static void test_stretched(void **state)
{
    (void)state;
    check(stretched, LINE, 128, "", "{}");
    check(stretched, PLANE, 64, ", nucleation: {tension: 0.5 MPa}", "{integrator: ssprk3}");
}

/* Where mixtures are squeezed edges are others: not in vapour alone, in which one tile is narrowed and the next is not.
 */
static void test_squeezed(void **state)
{
    (void)state;
    check(squeezed, LINE, 128, ", condense-over: 8", "{}");
    check(squeezed, PLANE, 64, ", condense-over: 8", "{low-mach: 0.1}");
    materials = PHASE_BOX_NASG PHASE_BOX_GEL;
    check(squeezed, PLANE, 64, ", condense-over: 8", "{}");
    materials = PHASE_BOX_NASG PHASE_BOX_AIR;
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(test_torn), cmocka_unit_test(test_laws),
                                       cmocka_unit_test(test_stretched), cmocka_unit_test(test_squeezed)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
