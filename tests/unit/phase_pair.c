/* What terms ask of a liquid and its vapour: who belongs together, and in how many cells pressure has left their
 * saturation curve. */
#include "phys/phase_pair.h"

#include "phys/equilibrium.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stdint.h>

#include <cmocka.h>

enum { CELLS = 8, STRIDE = 9, WATER = 1, STEAM = 0, AIR = 3, STONE = 2 };

static struct scene_phase pair = {.onset = 0.9, .curve = {.p_max = 4e7}};

static struct model scene_of_four(void)
{
    struct model model = {.n_phase = 1, .n_material = 4, .n_alpha = 4, .i_alpha = 2, .i_E = 1};
    model.phases[0] = (struct model_phase){.n = 3, .member = {WATER, STEAM, AIR}, .scene = &pair};
    return model;
}

static void test_joins(void **state)
{
    (void)state;
    const struct model model = scene_of_four();
    assert_true(phase_pair_joins(&model, WATER, STEAM));
    assert_true(phase_pair_joins(&model, AIR, WATER));
    assert_false(phase_pair_joins(&model, AIR, STEAM));
    assert_false(phase_pair_joins(&model, WATER, STONE));
    assert_false(phase_pair_joins(&model, WATER, WATER));
}

static void test_past(void **state)
{
    (void)state;
    const struct model model = scene_of_four();
    static const double p[CELLS] = {5e7, 5e7, 3e7, 5e7, 5e7, 5e7, 5e7, 4e7},
                        water[CELLS] = {0.5, 1.0, 0.5, 0.9991, 0.9989, 5e-4, 0.4, 0.5},
                        steam[CELLS] = {0.5, 0.0, 0.5, 5e-4, 5e-4, 0.9995, 0.0, 0.5},
                        air[CELLS] = {0.0, 0.0, 0.0, 4e-4, 6e-4, 0.0, 0.0, 0.0},
                        weight[CELLS] = {0, 1, 1, 1, 1, 1, 1, 1};
    double w[6 * STRIDE] = {0};
    for (unsigned i = 0; i < CELLS; i++) {
        w[STRIDE + i] = p[i];
        w[(2 + WATER) * STRIDE + i] = water[i];
        w[(2 + STEAM) * STRIDE + i] = steam[i];
        w[(2 + AIR) * STRIDE + i] = air[i];
        w[(2 + STONE) * STRIDE + i] = 1.0 - water[i] - steam[i] - air[i];
    }
    assert_int_equal(phase_pair_past(&model, 0, CELLS, STRIDE, w, NULL), 2); /* 0, and 4: steam and air together */
    assert_int_equal(phase_pair_past(&model, 0, CELLS, STRIDE, w, weight), 1);
    assert_int_equal(phase_pair_past(&model, 0, 3, STRIDE, w, NULL), 1);
    assert_int_equal(phase_pair_past(&model, 0, 1, STRIDE, w + 2, NULL), 0);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(test_joins), cmocka_unit_test(test_past)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
