/* One normal traction for the materials of a cell: pressures that follow from it, and what it is for, a contact of a
 * stretched solid and water that moves along and leaves traction and velocity uniform. */
#include "flow.h"

#include "phys/elastic.h"
#include "phys/traction.h"
#include "phys/traction_rate.h"

enum { POINTS = 40, STEPS = 200 };

#define GEL                                                                                                \
    "  gel: {eos: {type: stiffened-gas, gamma: 4.4, p-inf: 600 MPa}, constitutive: {type: mooney-rivlin, " \
    "shear-modulus: 90 MPa, ratio: 0.3, reference-density: 1000}}\n"
#define STEEL                                                                                                 \
    "  steel: {eos: {type: stiffened-gas, gamma: 3.4, p-inf: 4591545000}, constitutive: {type: neo-hookean, " \
    "shear-modulus: 10728633195, reference-density: 1995}}\n"

static char *line_case(const char *materials, const char *initial)
{
    return mem_print("bulla: 1\ntitle: traction\ndomain: {lower: [0], upper: [1], cells: [64], velocity-components: 3, "
                     "boundaries: {x-: periodic, x+: periodic}}\nmaterials:\n%sinitial:\n%sscheme: {riemann: hlld}\n"
                     "run: {until: 1}\n",
                     materials, initial);
}

static double any(unsigned *seed, double low, double high)
{
    *seed = *seed * 1664525u + 1013904223u;
    return low + (high - low) * (double)(*seed >> 8) / 16777216.0;
}

/* Primitives of POINTS points with three materials, the last points each with one alone. */
static void draw(const struct model *model, double *w)
{
    unsigned seed = 3;
    for (size_t i = 0; i < POINTS; i++) {
        double a = any(&seed, 0.1, 0.9), b = any(&seed, 0.0, 1.0 - a), alpha[] = {a, b, 1.0 - a - b};
        const double density[] = {998.0, 1000.0, 1995.0};
        for (unsigned l = 0; l < 3; l++) {
            if (i + 6 >= POINTS) alpha[l] = i % 3 == l;
            w[(model->i_alpha + l) * POINTS + i] = alpha[l];
            w[(model->i_m + l) * POINTS + i] = density[l] * any(&seed, 0.98, 1.02);
        }
        for (unsigned d = 0; d < 3; d++) w[(model->i_u + d) * POINTS + i] = any(&seed, -9.0, 9.0);
        w[model->i_E * POINTS + i] = any(&seed, 1e8, 2e8);
        for (unsigned c = 0; c < 12; c++)
            w[(model->i_V + c) * POINTS + i] = (c % 6 < 3 ? 1.0 : 0.0) + any(&seed, -0.02, 0.02);
    }
    for (unsigned s = 0; s < 2; s++) elastic_unimodular(model, POINTS, POINTS, w + model->solids[s].stretch * POINTS);
}

/* p_l - s'_l,xx is the same for all, their mean by volume is p, and one alone has p. */
static void test_pressures(void **state)
{
    (void)state;
    struct flow flow;
    flow_start(&flow, line_case(FLOW_WATER GEL STEEL,
                                "  - {everywhere: true, material: water, density: 998, pressure: 1e5}\n"));
    const struct model *model = flow.state->model;
    static double w[FLOW_FIELDS * POINTS], u[FLOW_FIELDS * POINTS], back[FLOW_FIELDS * POINTS], stress[6 * POINTS];
    static struct traction_pressures parts;
    assert_true(model->split);
    draw(model, w);
    traction_part(model, POINTS, POINTS, w, &parts);
    for (size_t i = 0; i < POINTS; i++) {
        double mean = 0.0, p = w[model->i_E * POINTS + i];
        for (unsigned l = 0; l < 3; l++) mean += w[(model->i_alpha + l) * POINTS + i] * (p + parts.lag[l][i]);
        assert_true(fabs(mean - p) < 1e-4);
        if (i + 6 >= POINTS) assert_true(parts.lag[i % 3][i] == 0.0);
    }
    for (unsigned s = 0; s < 2; s++) { /* the stress of one solid alone in its own volume */
        const double *m[2] = {back, back};
        memset(back, 0, sizeof back);
        m[s] = w + (model->i_m + model->solids[s].material) * POINTS;
        elastic_stress(model, POINTS, POINTS, w + model->i_V * POINTS, m, stress);
        for (size_t i = 0; i < POINTS; i++) {
            double common = parts.lag[model->solids[s].material][i] - stress[i];
            assert_true(fabs(stress[i]) > 1e3);
            assert_true(fabs(common - parts.lag[0][i]) < 1e-4); /* material 0 is water: its own stress is 0 */
        }
    }
    mix_conserved(model, POINTS, POINTS, w, u);
    mix_primitives(model, POINTS, POINTS, u, back);
    for (size_t i = 0; i < POINTS; i++)
        assert_true(fabs(back[model->i_E * POINTS + i] / w[model->i_E * POINTS + i] - 1.0) < 1e-11);
    flow_stop(&flow);
}

/* s'_xx of material l when all is strained by h times the gradient. */
static void strained(const struct model *model, const double *w, const struct traction_strain *strain, double h,
                     double *own)
{
    static double moved[FLOW_FIELDS * POINTS], none[6 * POINTS], one[POINTS];
    for (size_t i = 0; i < POINTS; i++) one[i] = 1.0;
    memcpy(moved, w, sizeof moved);
    for (unsigned s = 0; s < model->n_solid; s++) {
        size_t V = model->solids[s].stretch * POINTS, rho = (model->i_m + model->solids[s].material) * POINTS;
        const struct elastic_rates rates = {
            .carried = none, .m_old = one, .m_new = one, .div = strain->div, .gradient = strain->gradient};
        elastic_advance(model, POINTS, POINTS, h, w + V, &rates, moved + V);
        elastic_unimodular(model, POINTS, POINTS, moved + V);
        for (size_t i = 0; i < POINTS; i++) moved[rho + i] *= 1.0 + h * strain->div[i];
    }
    traction_own(model, POINTS, POINTS, moved, POINTS, own);
}

/* Stiffness along the normal and pull of any strain are the slopes of the traction itself. */
static void test_slopes(void **state)
{
    (void)state;
    struct flow flow;
    flow_start(&flow, line_case(FLOW_WATER GEL STEEL,
                                "  - {everywhere: true, material: water, density: 998, pressure: 1e5}\n"));
    const struct model *model = flow.state->model;
    static double w[FLOW_FIELDS * POINTS], gradient[3 * POINTS], along[3 * POINTS], stiff[3 * POINTS], pull[3 * POINTS];
    static double more[3 * POINTS], less[3 * POINTS], further[3 * POINTS], nearer[3 * POINTS];
    const double h = 1e-5;
    unsigned seed = 11;
    draw(model, w);
    for (size_t i = 0; i < 3 * POINTS; i++) {
        gradient[i] = any(&seed, -1.0, 1.0);
        along[i] = i < POINTS ? -1.0 : 0.0;
    }
    const struct traction_strain given = {gradient, gradient}, normal = {along, along};
    traction_rate(model, POINTS, POINTS, w, &given, POINTS, stiff, pull);
    strained(model, w, &given, h, more);
    strained(model, w, &given, -h, less);
    strained(model, w, &normal, h, further);
    strained(model, w, &normal, -h, nearer);
    for (unsigned l = 0; l < 3; l++)
        for (size_t i = 0; i < POINTS; i++) {
            size_t at = l * POINTS + i;
            double slope = (further[at] - nearer[at]) / (2.0 * h), rate = (more[at] - less[at]) / (2.0 * h);
            if (l == 0) assert_true(stiff[at] == 0.0 && pull[at] == 0.0);
            assert_true(fabs(stiff[at] - slope) <= 1e-6 * stiff[at]);
            assert_true(fabs(pull[at] - (stiff[at] * gradient[i] + rate)) <= 1e-6 * stiff[at]);
        }
    flow_stop(&flow);
}

/* Steel pressed to half a per cent, in water at 1 bar at the same traction, all at 20 m/s. */
static void test_contact(void **state)
{
    (void)state;
    const double xx = 0.995, yy = sqrt(1.0 / xx), B = xx * xx, trace = B + 2.0 * yy * yy;
    const double own = 10728633195.0 * (B - trace / 3.0);
    struct flow flow;
    char *initial =
        mem_print("  - {everywhere: true, material: water, density: 998, pressure: 1e8, velocity: [20, 0, 0]}\n"
                  "  - {box: {lower: [0.26], upper: [0.71]}, material: steel, density: 1995, pressure: %.17g, "
                  "velocity: [20, 0, 0], stretch: {xx: %.17g, yy: %.17g, zz: %.17g}}\n",
                  1e8 + own, xx, yy, yy);
    flow_start(&flow, line_case(FLOW_WATER STEEL, initial));
    mem_free(initial);
    flow_steps(&flow, STEPS);
    const struct model *model = flow.state->model;
    double *w = mem_new(model->n_field * flow.n_cell, sizeof *w), *mean = mem_new(flow.n_cell, sizeof *mean);
    double worst_p = 0.0, worst_u = 0.0, mixed = 0.0;
    for (unsigned q = 0; q < model->n_field; q++) {
        double *row = flow_primitive(&flow, q);
        memcpy(w + q * flow.n_cell, row, flow.n_cell * sizeof *w);
        mem_free(row);
    }
    traction_mean(model, flow.n_cell, flow.n_cell, w, mean);
    for (size_t i = 0; i < flow.n_cell; i++) {
        worst_p = fmax(worst_p, fabs(w[model->i_E * flow.n_cell + i] - mean[i] - 1e8));
        worst_u = fmax(worst_u, fabs(w[model->i_u * flow.n_cell + i] - 20.0));
        mixed += w[i] > 0.01 && w[i] < 0.99;
    }
    print_message("stress %.3g Pa; worst traction %.1e Pa, velocity %.1e m/s; %g mixed cells\n", own, worst_p, worst_u,
                  mixed);
    assert_true(mixed >= 3.0);
    assert_true(worst_p < 1e-10 * fabs(own) && worst_u < 1e-9);
    mem_free(w);
    mem_free(mean);
    flow_stop(&flow);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(test_pressures), cmocka_unit_test(test_slopes),
                                       cmocka_unit_test(test_contact)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
