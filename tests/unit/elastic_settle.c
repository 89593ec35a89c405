/* Stretches that were averaged become stretches again: the nearest of det 1, not a scaled mean; what is a stretch but
 * for round-off keeps its bits; and where there is little solid, or none, V goes to 1. */
#include "phys/elastic.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "close.h"

/* Solid in a mixture with a fluid (n_alpha 2), or alone: fractions first, then V. */
static struct model model_of(bool mixed)
{
    struct model model = {.dim = 3, .n_velocity = 3, .n_material = mixed ? 2 : 1, .n_solid = 1, .elastic = true};
    model.n_alpha = mixed ? 2 : 0;
    model.i_V = model.n_alpha;
    model.n_stretch = 6;
    model.n_field = model.i_V + 6;
    model.solids[0].stretch = model.i_V;
    return model;
}

static double det(const double *V)
{
    return V[0] * (V[1] * V[2] - V[5] * V[5]) - V[3] * (V[3] * V[2] - V[5] * V[4]) + V[4] * (V[3] * V[5] - V[1] * V[4]);
}

static double distance(const double *V, const double *W)
{
    double sum = 0.0;
    for (int c = 0; c < 6; c++) sum += (c < 3 ? 1.0 : 2.0) * (V[c] - W[c]) * (V[c] - W[c]);
    return sqrt(sum);
}

/* The mean of a stretch and its inverse has det > 1. To second order in the excess the nearest of det 1 is one step
 * along the gradient of det; any other of det 1 in the neighbourhood lies farther off. */
static void test_nearest(void **state)
{
    (void)state;
    const struct model model = model_of(false);
    srand(7);
    for (int i = 0; i < 50; i++) {
        double a = 1.0 + 0.3 * rand() / RAND_MAX, b = 0.1 * rand() / RAND_MAX, V[6], mean[6], scaled[6];
        const double start[6] = {0.5 * (a + 1.0 / a), 1.02, 1.0, b, 0.5 * b, 0.2 * b};
        memcpy(V, start, sizeof V);
        memcpy(mean, start, sizeof mean);
        elastic_settle(&model, 1, 1, V);
        assert_close(det(V), 1.0, 1e-14);
        for (int c = 0; c < 6; c++) scaled[c] = mean[c] / cbrt(det(mean));
        for (int k = 0; k < 40; k++) { /* neighbours of det 1 */
            double other[6], size;
            for (int c = 0; c < 6; c++) other[c] = V[c] + 0.05 * ((double)rand() / RAND_MAX - 0.5);
            size = cbrt(det(other));
            for (int c = 0; c < 6; c++) other[c] /= size;
            assert_true(distance(V, mean) <= distance(other, mean) + 1e-3 * distance(other, V));
        }
        assert_true(distance(V, mean) < distance(scaled, mean));
    }
}

/* A stretch whose det is 1 but for rounding keeps its bits; one that is off by more is moved. */
static void test_kept(void **state)
{
    (void)state;
    const struct model model = model_of(false);
    double V[6] = {1.25, 0.8, 1.0, 0.0, 0.0, 0.0}, before[6];
    memcpy(before, V, sizeof V);
    elastic_settle(&model, 1, 1, V);
    assert_memory_equal(V, before, sizeof V);
    for (double off = 1e-12; off < 1e-3; off *= 10.0) {
        double W[6] = {1.25 * (1.0 + off), 0.8, 1.0, 0.0, 0.0, 0.0};
        elastic_settle(&model, 1, 1, W);
        assert_close(det(W), 1.0, 1e-15);
    }
}

/* det V <= 0 is no stretch: that must not look like one. */
static void test_inside_out(void **state)
{
    (void)state;
    const struct model model = model_of(false);
    double V[6] = {-1.0, 1.0, 1.0, 0.0, 0.0, 0.0};
    elastic_unimodular(&model, 1, 1, V);
    for (int c = 0; c < 3; c++) assert_true(isnan(V[c]));
}

/* |V - 1| <= (phi/ELASTIC_FADE)^2. */
static void test_faded(void **state)
{
    (void)state;
    const struct model model = model_of(true);
    static const double parts[] = {0.0, 1e-3, 0.1, 0.5, 1.0, 1e3};
    for (size_t i = 0; i < sizeof parts / sizeof *parts; i++) {
        double phi = parts[i] * ELASTIC_FADE, block[8] = {phi, 1.0 - phi, 1.25, 0.8, 1.0, 0.0, 0.0, 0.0};
        const double one[6] = {1.0, 1.0, 1.0, 0.0, 0.0, 0.0};
        elastic_settle(&model, 1, 1, block);
        double bound = parts[i] * parts[i], size = distance(block + 2, one);
        assert_true(size <= bound * (1.0 + 0.2 * bound) && (bound > 0.3 || size >= 0.9 * bound));
        if (bound >= 1.0) assert_true(block[2] == 1.25 && block[3] == 0.8);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(test_nearest), cmocka_unit_test(test_kept),
                                       cmocka_unit_test(test_faded), cmocka_unit_test(test_inside_out)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
