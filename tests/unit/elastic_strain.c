/* What strains a stretch beside the plain gradient of the velocity: what a mixed cell squeezes out across its
 * interface, and what refluxing adds. */
#include "phys/elastic.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "close.h"

static struct model model_of(void)
{
    struct model model = {.dim = 3, .n_velocity = 3, .n_material = 1, .n_solid = 1, .elastic = true};
    model.i_V = 5;
    model.n_stretch = 6;
    model.n_field = 11;
    return model;
}

static double draw(void)
{
    return (double)rand() / RAND_MAX - 0.5;
}

static void draw_stretch(double V[6])
{
    for (int c = 0; c < 6; c++) V[c] = (c < 3 ? 1.0 : 0.0) + 0.4 * draw();
}

/* A squeeze s across n is the velocity gradient -s n n^T, whatever the length of the slope that gives n. */
static void test_squeeze(void **state)
{
    (void)state;
    const struct model model = model_of();
    srand(2);
    for (int i = 0; i < 50; i++) {
        double V[6], squeezed[6], strained[6], zero[9] = {0}, gradient[9], slope[3], n2 = 0.0, m = 1000.0, div = 0.0;
        double dt = 0.1, squeeze = 2.0 * draw();
        draw_stretch(V);
        for (int k = 0; k < 3; k++) slope[k] = 50.0 * draw();
        for (int k = 0; k < 3; k++) n2 += slope[k] * slope[k];
        for (int k = 0; k < 9; k++) gradient[k] = squeeze * slope[k / 3] * slope[k % 3] / n2;
        struct elastic_rates rates = {.carried = zero, .m_old = &m, .m_new = &m, .div = &div, .gradient = gradient};
        elastic_advance(&model, 1, 1, dt, V, &rates, strained);
        rates.gradient = zero;
        rates.squeeze = &squeeze;
        rates.slope = slope;
        elastic_advance(&model, 1, 1, dt, V, &rates, squeezed);
        for (int c = 0; c < 6; c++) assert_close(squeezed[c], strained[c], 1e-9);
    }
}

/* Whatever a face adds to the gradient, det V stays: to first order the change is across the gradient of det. */
static void test_volume(void **state)
{
    (void)state;
    static const double zero[6] = {0};
    srand(6);
    for (int i = 0; i < 60; i++)
        for (int beta = 0; beta <= 2; beta++) {
            struct model model = model_of();
            double V[6], dV[6], velocity[3], size = 0.0;
            model.beta = beta;
            draw_stretch(V);
            for (int k = 0; k < 3; k++) velocity[k] = draw();
            if (beta) V[4] = V[5] = velocity[2] = 0.0;
            if (beta == 2) V[3] = velocity[1] = 0.0;
            const struct elastic_correction in = {V, zero, 0.0, draw(), velocity, beta ? 0 : i % 3};
            elastic_correct(&model, &in, dV);
            const double slope[6] = {V[1] * V[2] - V[5] * V[5], V[0] * V[2] - V[4] * V[4], V[0] * V[1] - V[3] * V[3],
                                     V[4] * V[5] - V[3] * V[2], V[3] * V[5] - V[1] * V[4], V[3] * V[4] - V[0] * V[5]};
            double along = 0.0;
            for (int c = 0; c < 6; c++) {
                along += (c < 3 ? 1.0 : 2.0) * slope[c] * dV[c];
                size += fabs(dV[c]);
            }
            assert_true(size > 1e-3);
            assert_close(along, 0.0, 1e-13);
        }
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(test_squeeze), cmocka_unit_test(test_volume)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
