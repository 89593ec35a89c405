/* In which cells of a surface a pair changes phase by itself, and which speed of sound its mixtures have: where the
 * case file says nothing, and where it says otherwise. */
#include "phase_box.h"

#define HEAT ", conductivity: 0.6 W/m/K}\n"
#define STEAM "  steam: {eos: {type: ideal-gas, preset: water-2016}}\n"
#define COLD_WATER "  water: {eos: {type: nasg, preset: water-2016}}\n"
#define WATER "  water: {eos: {type: nasg, preset: water-2016}" HEAT
#define PAIR "{liquid: water, vapour: steam"

struct surface {
    const char *materials, *phase;
    double onset, wet;
};

static void test_defaults(void **state)
{
    (void)state;
    static const struct surface table[] = {
        {WATER STEAM, PAIR "}", 0.99, 0.0},
        {COLD_WATER STEAM, PAIR "}", 0.0, 0.0},
        {COLD_WATER "  steam: {eos: {type: ideal-gas, preset: water-2016}" HEAT, PAIR "}", 0.0, 0.0},
        {WATER STEAM, PAIR ", onset: 0}", 0.0, 0.0},
        {WATER STEAM, PAIR ", onset: 0.5}", 0.5, 0.0},
        {WATER STEAM, PAIR ", where: everywhere}", 0.0, 0.0},
        {WATER STEAM, PAIR ", rate: {type: relaxation, time: 1 us}}", 0.0, 0.0},
        {WATER STEAM, PAIR ", direction: evaporation}", 0.99, 0.0},
        {WATER STEAM, PAIR ", direction: condensation}", 0.0, 0.0},
        {WATER STEAM PHASE_BOX_AIR, PAIR ", gases: [air]}", 0.0, 0.9},
        {COLD_WATER STEAM PHASE_BOX_AIR, PAIR ", gases: [air]}", 0.0, 0.0},
        {WATER STEAM PHASE_BOX_AIR, PAIR ", gases: [air], mixing: none}", 0.0, 0.0},
        {WATER STEAM PHASE_BOX_AIR, PAIR ", gases: [air], condense-from: 0}", 0.0, 0.0},
        {WATER STEAM PHASE_BOX_AIR, PAIR ", gases: [air], rate: {type: hertz-knudsen, area: 1e5}}", 0.0, 0.9},
        {COLD_WATER STEAM PHASE_BOX_AIR, PAIR ", gases: [air], rate: {type: hertz-knudsen, area: 1e5}}", 0.0, 0.0},
        {WATER STEAM, PAIR ", rate: {type: hertz-knudsen, area: 1e5}}", 0.0, 0.0},
        {WATER STEAM PHASE_BOX_AIR, PAIR ", gases: [air], onset: 0.9}", 0.9, 0.0},
        {WATER STEAM PHASE_BOX_AIR, PAIR ", gases: [air], direction: evaporation}", 0.0, 0.0},
        {WATER STEAM PHASE_BOX_AIR, PAIR ", gases: [air], direction: evaporation, condense-from: 0}", 0.0, 0.0},
        {WATER STEAM PHASE_BOX_AIR, PAIR ", gases: [air], where: everywhere}", 0.0, 0.0},
    };
    for (size_t i = 0; i < sizeof table / sizeof *table; i++) {
        struct flow flow;
        phase_box_open(&flow, table[i].materials, table[i].phase, 4, "");
        const struct scene_phase *pair = flow.state->model->phases[0].scene;
        assert_true(pair->onset == table[i].onset && pair->wet == table[i].wet);
        flow_stop(&flow);
    }
}

/* Cells over which the pair condenses in a scene whose last layer is this. */
static double over(const char *materials, const char *phase, const char *layer)
{
    struct flow flow;
    flow_start(&flow, mem_print("bulla: 1\ndomain: {lower: [0], upper: [1], cells: [8], boundaries: {x-: periodic, x+: "
                                "periodic}}\nmaterials:\n%sphase-change:\n  - %s\ninitial:\n"
                                "  - {everywhere: true, material: water, temperature: 300, pressure: 1 bar}\n"
                                "  - {half-space: {point: [0.5], normal: [1]}, %s, temperature: 300, pressure: 1 bar}\n"
                                "run: {until: 1}\n",
                                materials, phase, layer));
    double cells = flow.state->model->phases[0].scene->over;
    flow_stop(&flow);
    return cells;
}

/* Painted mixtures condense over cells, surfaces and what heat feeds at once. */
static void test_over(void **state)
{
    (void)state;
    static const char foam[] = "fractions: {water: 0.9, steam: 0.1}",
                      traces[] = "fractions: {water: 0.9995, steam: 5e-4}",
                      damp[] = "fractions: {air: 0.9, steam: 0.1}", bubble[] = "material: steam";
    assert_true(over(COLD_WATER STEAM, PAIR "}", foam) == 8.0);
    assert_true(over(COLD_WATER STEAM PHASE_BOX_AIR, PAIR ", gases: [air]}", foam) == 8.0);
    assert_true(over(WATER STEAM, PAIR ", where: everywhere}", foam) == 8.0);
    assert_true(over(WATER STEAM, PAIR "}", foam) == 0.0);
    assert_true(over(WATER STEAM, PAIR ", onset: 0}", foam) == 8.0);
    assert_true(over(WATER STEAM PHASE_BOX_AIR, PAIR ", gases: [air]}", foam) == 0.0);
    assert_true(over(COLD_WATER STEAM, PAIR "}", traces) == 0.0);
    assert_true(over(COLD_WATER STEAM, PAIR "}", bubble) == 0.0);
    assert_true(over(COLD_WATER STEAM PHASE_BOX_AIR, PAIR ", gases: [air]}", damp) == 0.0);
    assert_true(over(COLD_WATER STEAM, PAIR ", condense-over: 0}", foam) == 0.0);
    assert_true(over(COLD_WATER STEAM, PAIR ", condense-over: 3}", bubble) == 3.0);
    assert_true(over(COLD_WATER STEAM, PAIR ", direction: evaporation}", foam) == 0.0);
    assert_true(over(COLD_WATER STEAM, PAIR ", rate: {type: relaxation, time: 1 us}}", foam) == 0.0);
}

static bool wood(const char *materials, const char *phase, const char *scheme)
{
    struct flow flow;
    phase_box_open(&flow, materials, phase, 4, scheme);
    bool slow = flow.state->model->scene->scheme.wood;
    flow_stop(&flow);
    return slow;
}

/* Mixtures of liquids and their vapours alone show Wood's speed where they expand. */
static void test_wood(void **state)
{
    (void)state;
    assert_true(wood(COLD_WATER STEAM, PAIR "}", ""));
    assert_true(wood(WATER STEAM, PAIR ", where: everywhere}", ""));
    assert_true(wood(WATER STEAM, PAIR "}", "mixture-speed: wood"));
    assert_false(wood(COLD_WATER STEAM, PAIR "}", "mixture-speed: frozen"));
    assert_false(wood(COLD_WATER STEAM, PAIR ", rate: none}", ""));
    assert_false(wood(WATER STEAM, PAIR "}", ""));
    assert_false(wood(COLD_WATER STEAM PHASE_BOX_AIR, PAIR "}", ""));
    assert_false(wood(COLD_WATER STEAM PHASE_BOX_AIR, PAIR ", gases: [air]}", ""));
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(test_defaults), cmocka_unit_test(test_over),
                                       cmocka_unit_test(test_wood)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
