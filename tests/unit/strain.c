/* Solid and liquid that slide along each other at one pressure: nothing pulls at either, so the solid must not be
 * sheared. What its cells see of the tangential velocity at a face is their own side's, above and below. */
#include "flow.h"

/* Solid in the middle layer along `axis`, so that it has liquid above and below, sliding along all other axes. */
static int slide_axis;

static void set_layers(const struct model *model, const double x[3], double *w)
{
    bool solid = fabs(x[slide_axis] - 0.5) < 0.25;
    w[model->i_alpha] = solid ? 0.0 : 1.0;
    w[model->i_alpha + 1] = solid ? 1.0 : 0.0;
    for (unsigned d = 0; d < model->n_velocity; d++)
        w[model->i_u + d] = (int)d == slide_axis ? 0.0 : (solid ? 3.0 : -2.0) * (1.0 + d);
}

static void check_slide(int dim, const char *solver)
{
    struct flow flow;
    bool plane = dim == 2;
    flow_start(
        &flow,
        mem_print("bulla: 1\ntitle: slide\ndomain: {lower: [%s], upper: [%s], cells: [%s], boundaries: {x-: periodic, "
                  "x+: periodic, y-: periodic, y+: periodic%s}}\nmesh: {tile: 8}\nmaterials:\n" FLOW_WATER
                  "  gel: {eos: {type: stiffened-gas, gamma: 4.4, p-inf: 600 MPa}, constitutive: {type: neo-hookean, "
                  "shear-modulus: 1 MPa, reference-density: 1000}}\n"
                  "initial:\n  - {everywhere: true, fractions: {water: 0.5, gel: 0.5}, density: {water: 1000, gel: "
                  "1000}, pressure: 1e5}\nscheme: {riemann: %s, limiter: minmod}\nrun: {until: 1}\n",
                  plane ? "0, 0" : "0, 0, 0", plane ? "1, 1" : "1, 1, 1", plane ? "16, 16" : "8, 8, 8",
                  plane ? "" : ", z-: periodic, z+: periodic", solver));
    flow_set(&flow, set_layers);
    flow_steps(&flow, 5);
    const struct model *model = flow.state->model;
    for (unsigned c = 0; c < model->n_stretch; c++) {
        double *V = flow_primitive(&flow, model->i_V + c), worst = 0.0;
        for (size_t i = 0; i < flow.n_cell; i++) worst = fmax(worst, fabs(V[i] - (c < 3 ? 1.0 : 0.0)));
        print_message("%dD, slides across %c, %s: V_%s off by %.1e\n", dim, "xyz"[slide_axis], solver, model_tensor[c],
                      worst);
        assert_true(worst <= 1e-12);
        mem_free(V);
    }
    flow_stop(&flow);
}

static void test_slide(void **state)
{
    (void)state;
    for (slide_axis = 0; slide_axis < 2; slide_axis++) check_slide(2, "hlld");
    for (slide_axis = 0; slide_axis < 3; slide_axis++) check_slide(3, "hlld");
}

static void set_band(const struct model *model, const double x[3], double *w)
{
    double stretch = fabs(x[slide_axis] - 0.5) < 0.15 ? 1.25 : 1.0;
    w[model->i_V] = stretch;
    w[model->i_V + 1] = 1.0 / stretch;
    w[model->i_u + (unsigned)slide_axis] = slide_axis ? -100.0 : 100.0;
}

/* A band of a solid that hardly bears any stress is carried along with its stretch, from the side it comes from. */
static void test_carried(void **state)
{
    (void)state;
    for (slide_axis = 0; slide_axis < 2; slide_axis++) {
        struct flow flow;
        flow_start(&flow,
                   mem_print("bulla: 1\ntitle: carried\ndomain: {lower: [0, 0], upper: [1, 1], cells: [16, 16], "
                             "boundaries: {x-: periodic, x+: periodic, y-: periodic, y+: periodic}}\nmesh: {tile: "
                             "8}\nmaterials:\n  gel: {eos: {type: stiffened-gas, gamma: 1.4, p-inf: 0}, "
                             "constitutive: {type: neo-hookean, shear-modulus: 1e-6, reference-density: 1000}}\n"
                             "initial:\n  - {everywhere: true, material: gel, density: 1, pressure: 1e3}\n"
                             "scheme: {limiter: minmod}\nrun: {until: 1}\n"));
        flow_set(&flow, set_band);
        flow_until(&flow, 2e-3); /* a fifth of the domain */
        double *V = flow_primitive(&flow, flow.state->model->i_V), sum = 0.0, place = 0.0;
        for (size_t i = 0; i < flow.n_cell; i++) {
            double x[3];
            flow_centre(&flow, i, x);
            assert_true(V[i] >= 1.0 - 1e-6 && V[i] <= 1.25 + 1e-6);
            sum += V[i] - 1.0;
            place += (V[i] - 1.0) * x[slide_axis];
        }
        print_message("the middle of the band is at %.4f\n", place / sum);
        assert_true(fabs(place / sum - (slide_axis ? 0.3 : 0.7)) < 0.02);
        mem_free(V);
        flow_stop(&flow);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(test_slide), cmocka_unit_test(test_carried)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
