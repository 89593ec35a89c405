/* phase_entropy.c - entropy never falls by phase change: over one call in cells anywhere, for every pair, rate and kind
 * of family; and over steps of a closed box, shocks included. */
#include "phase_box.h"

enum { CELLS = 256, DRAWS = 2, STEPS = 300 };

#define ROUND 1e-12 /* of the entropy of a cell: the sum of its materials' is rounded */

/* What the calls of one pair did. */
struct tally {
    long moved;           /* cells */
    double least, gained; /* the least gain of a cell over its entropy, and the mean one */
};

static void note(struct tally *tally, double before, double after)
{
    double gain = (after - before) / fabs(before);
    tally->moved += after != before;
    tally->gained += gain;
    if (gain < tally->least) tally->least = gain;
}

/* One call of phase_act on cells anywhere, and what became of the entropy of each. */
static void call(struct flow *flow, double dt, struct tally *tally)
{
    const struct model *model = flow->state->model;
    double *u = flow_level(flow)->u_old[0], *w = flow_level(flow)->w[0], before[CELLS];
    struct equilibrium_effort effort = {0};
    flow_set(flow, phase_box_scatter);
    for (size_t i = 0; i < CELLS; i++) before[i] = phase_box_entropy(model, CELLS, u + i, w + i);
    assert_int_equal(phase_act(model, 0, CELLS, CELLS, dt, 0.0, NULL, w, u, &effort), STATUS_OK);
    mix_primitives(model, CELLS, CELLS, u, w);
    for (size_t i = 0; i < CELLS; i++) {
        double after = phase_box_entropy(model, CELLS, u + i, w + i);
        if (!(after >= before[i] - ROUND * fabs(before[i])))
            fail_msg("cell %zu: entropy %.17g becomes %.17g; p %g, alpha %g %g", i, before[i], after,
                     w[model->i_E * CELLS + i], w[model->i_alpha * CELLS + i], w[(model->i_alpha + 1) * CELLS + i]);
        note(tally, before[i], after);
    }
}

static const char *const pairs[] = {PHASE_BOX_NASG, PHASE_BOX_SG, PHASE_BOX_SG_2017, PHASE_BOX_DODECANE,
                                    PHASE_BOX_IAPWS};
static const char *const pair_names[] = {"nasg water-2016", "sg water-2004", "sg water-2017", "sg dodecane-2004",
                                         "iapws95"};

static const char *const rates[] = {
    "equilibrium",
    "none",
    "{type: relaxation, time: 1 us}",
    "{type: hertz-knudsen, accommodation: 0.4, area: 1e5}",
    "{type: lua, lua: 'return function(p, T, p_eq, share, alpha) return 1e-3 * (p_eq - share * p) end'}",
};

static const char *const families[] = {
    "",
    ", gases: [air]",
    ", gases: [air], mixing: none",
    ", gases: [air], gas-temperature: own",
    ", gases: [air], where: everywhere",
    ", gases: [air], condense-from: 0.9, onset: 0.5",
    ", nucleus: 1e-4",
};

static void family(size_t pair, size_t rate, size_t kind, const char *air)
{
    struct flow flow;
    struct tally tally = {0};
    char *phase = mem_print("{liquid: water, vapour: steam, rate: %s%s}", rates[rate], families[kind]);
    char *materials = mem_print("%s%s%s", pairs[pair], kind ? air : "", kind ? PHASE_BOX_STONE : "");
    phase_box_open(&flow, materials, phase, CELLS, "");
    for (int draw = 0; draw < DRAWS; draw++) call(&flow, draw ? 1e-4 : 1e-7, &tally);
    print_message("%s, %s: %ld of %d changed, least gain %.2g, mean %.2g\n", pair_names[pair], phase, tally.moved,
                  DRAWS * CELLS, tally.least, tally.gained / (DRAWS * CELLS));
    assert_true(tally.moved > CELLS / 8 && tally.gained > 0.0);
    mem_free(materials);
    mem_free(phase);
    flow_stop(&flow);
}

static void test_call(void **state)
{
    (void)state;
    phase_box_seed = 41;
    for (size_t pair = 0; pair < sizeof pairs / sizeof *pairs; pair++)
        for (size_t rate = 0; rate < sizeof rates / sizeof *rates; rate++)
            for (size_t kind = 0; kind < sizeof families / sizeof *families; kind++) {
                bool script = strstr(rates[rate], "lua") != NULL, apart = strstr(families[kind], "own") != NULL;
                bool real = strstr(pairs[pair], "iapws95-vapour") != NULL;
                if (!(script && apart) && !(real && kind)) family(pair, rate, kind, PHASE_BOX_AIR); /* refused */
            }
}

/* Air by a cubic law. */
static void test_cubic(void **state)
{
    (void)state;
    phase_box_seed = 43;
    for (size_t kind = 1; kind < sizeof families / sizeof *families; kind++) family(0, 0, kind, PHASE_BOX_CUBIC_AIR);
}

static double total(const struct flow *flow)
{
    const struct model *model = flow->state->model;
    const struct level *level = flow_level(flow);
    size_t n = flow->state->mesh->n_cell;
    double sum = 0.0;
    for (unsigned t = 0; t < level->n_local; t++)
        for (size_t c = 0; c < n; c++) sum += phase_box_entropy(model, n, level->u_old[t] + c, level->w[t] + c);
    return sum;
}

/* Bubbly water at 372 K, one half of it at ten times the pressure of the other. */
static void shocked(const struct model *model, const double x[3], double *w)
{
    double p = x[0] < 0.5 ? 1e6 : 1e5, T = 372.0;
    w[model->i_alpha] = 0.7;
    w[model->i_alpha + 1] = 0.2;
    w[model->i_alpha + 2] = 0.1;
    for (unsigned l = 0; l < 3; l++) model->eos[l].law->density(model->eos[l].self, 1, &p, &T, &w[model->i_m + l]);
    w[model->i_u] = 0.0;
    w[model->i_E] = p;
}

/* Over whole steps: fluxes, K div u and phase change together. */
static void test_steps(void **state)
{
    (void)state;
    static const char *const ways[] = {"equilibrium", "{type: relaxation, time: 1 ms}"};
    for (size_t way = 0; way < sizeof ways / sizeof *ways; way++) {
        struct flow flow;
        char *phase = mem_print("{liquid: water, vapour: steam, gases: [air], rate: %s}", ways[way]);
        double least = HUGE_VAL, start, now;
        phase_box_open(&flow, PHASE_BOX_NASG PHASE_BOX_AIR, phase, 64, "cfl: 0.4");
        flow_set(&flow, shocked);
        start = now = total(&flow);
        for (int i = 0; i < STEPS; i++) {
            double before = now;
            flow_steps(&flow, 1);
            now = total(&flow);
            least = now - before < least ? now - before : least;
        }
        print_message("%s: entropy %.3g of itself more, at least %.3g in a step\n", phase, now / start - 1.0,
                      least / fabs(start));
        assert_true(least >= -1e-13 * fabs(start) && now > start);
        mem_free(phase);
        flow_stop(&flow);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(test_call), cmocka_unit_test(test_cubic),
                                       cmocka_unit_test(test_steps)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
