/* The mixture pressure of laws that are not linear in p: how many Newton steps it takes, that it is a fixed point, that
 * no point knows its neighbours or the path it is on, and that a point without a pressure is named. */
#include "flow.h"

enum { POINTS = 1100 };

#define RKPR "{eos: {type: rkpr}}"
#define MNASG "{eos: {type: mnasg, preset: water}}"
#define IAPWS "{eos: {type: iapws95}}"
#define TABLE "{eos: {type: rkpr, eval: table}}"

struct mixture {
    struct flow flow;
    const struct model *model;
    double *w, *u, *got; /* [n_field][POINTS] */
};

static void start(struct mixture *mix, const char *air, const char *water, bool tissue)
{
    flow_start(&mix->flow, mem_print("bulla: 1\ntitle: mix\ndomain: {lower: [0], upper: [1], cells: [8], boundaries: "
                                     "{x-: outflow, x+: outflow}}\nmaterials:\n  air: %s\n  water: %s\n%sinitial:\n"
                                     "  - {everywhere: true, material: water, density: 998, pressure: 1 bar}\n"
                                     "run: {until: 1}\n",
                                     air, water, tissue ? "  tissue: " MNASG "\n" : ""));
    mix->model = mix->flow.state->model;
    size_t size = (size_t)mix->model->n_field * POINTS;
    mix->w = mem_new(size, sizeof *mix->w);
    mix->u = mem_new(size, sizeof *mix->u);
    mix->got = mem_new(size, sizeof *mix->got);
}

static void stop(struct mixture *mix)
{
    mem_free(mix->w);
    mem_free(mix->u);
    mem_free(mix->got);
    flow_stop(&mix->flow);
}

/* As eos.md 9: fractions down to 1e-8, pressures from 3 kPa to 5 GPa, each material between warm and hot; every tenth
 * point holds one material alone. */
static void random_states(struct mixture *mix)
{
    const struct model *model = mix->model;
    uint64_t seed = 11;
    for (size_t i = 0; i < POINTS; i++) {
        double p = 3e3 * pow(5e9 / 3e3, flow_random(&seed)), left = 1.0;
        for (unsigned l = 0; l < model->n_material; l++) {
            double T = l == 0 ? 300.0 * pow(20.0, flow_random(&seed)) : 300.0 + 200.0 * flow_random(&seed);
            double small = pow(10.0, -8.0 * flow_random(&seed)), side = flow_random(&seed);
            double alpha = l + 1 == model->n_material ? left : left * (side < 0.5 ? small : 1.0 - small);
            if (i % 10 == 0) alpha = l == i / 10 % model->n_material ? 1.0 : 0.0;
            left -= alpha;
            mix->w[(model->i_alpha + l) * POINTS + i] = alpha;
            const struct model_eos *eos = &model->eos[l];
            double *rho = &mix->w[(model->i_m + l) * POINTS + i];
            eos->law->density(eos->self, 1, &p, &T, rho);
            if (alpha == 0.0) *rho = eos->rho_fill;
        }
        mix->w[model->i_u * POINTS + i] = 10.0;
        mix->w[model->i_E * POINTS + i] = p;
    }
    mix_conserved(model, POINTS, POINTS, mix->w, mix->u);
}

/* Pressures of all points from `guess` times the right one, or from 1 bar if that is 0. */
static struct mix_effort close_from(struct mixture *mix, double guess)
{
    double *p = mix->got + mix->model->i_E * POINTS;
    for (size_t i = 0; i < POINTS; i++) p[i] = guess > 0.0 ? guess * mix->w[mix->model->i_E * POINTS + i] : 1e5;
    return mix_primitives(mix->model, POINTS, POINTS, mix->u, mix->got);
}

/* Largest error of p against what energies resolve: 1e-12 p, 8 eps S/F'. */
static double worst_error(const struct mixture *mix)
{
    const struct model *model = mix->model;
    double worst = 0.0;
    for (size_t i = 0; i < POINTS; i++) {
        double p = mix->w[model->i_E * POINTS + i], S = fabs(mix->u[model->i_E * POINTS + i]), slope = 0.0;
        for (unsigned l = 0; l < model->n_material; l++) {
            double alpha = mix->w[(model->i_alpha + l) * POINTS + i], e, c2, de_dp, de_drho;
            const double *rho = &mix->w[(model->i_m + l) * POINTS + i];
            model->eos[l].law->state(model->eos[l].self, 1, rho, &p, &e, &c2);
            model->eos[l].law->derivatives(model->eos[l].self, 1, rho, &p, &de_dp, &de_drho);
            S += alpha * (fabs(e) + *rho * fabs(de_drho)); /* densities are recovered too, to a last bit */
            slope += alpha * de_dp;
        }
        double off = fabs(mix->got[model->i_E * POINTS + i] - p) / (1e-12 * p + 8.0 * 2.2e-16 * S / slope);
        if (!(off <= worst)) worst = off;
    }
    return worst;
}

struct figures {
    double mean;
    long long most;
};

/* From a guess 5 % off, off by a factor of three, and from 1 bar. `rounding`: what the laws add of their own. */
static void check_steps(const char *air, const char *water, bool tissue, double rounding, const struct figures asked[3])
{
    static const double guess[3] = {1.05, 3.0, 0.0};
    struct mixture mix;
    start(&mix, air, water, tissue);
    random_states(&mix);
    for (int k = 0; k < 3; k++) {
        struct mix_effort effort = close_from(&mix, guess[k]);
        double mean = (double)effort.steps / (double)effort.solved, error = worst_error(&mix);
        print_message("%s + %s%s, from %s: %.2f steps, at most %lld, of %lld points; error %.2f\n", air, water,
                      tissue ? " + tissue" : "",
                      k == 0   ? "5 % off"
                      : k == 1 ? "3 p"
                               : "1 bar",
                      mean, effort.most, effort.solved, error);
        assert_true(effort.solved > POINTS / 2 && effort.failed == 0);
        assert_true(mean <= asked[k].mean && effort.most <= asked[k].most);
        assert_true(error <= rounding);
    }
    stop(&mix);
}

static void test_steps(void **state)
{
    (void)state;
    check_steps(RKPR, MNASG, false, 1.0, (struct figures[3]){{2.8, 4}, {3.5, 6}, {3.5, 7}});
    check_steps(TABLE, MNASG, true, 1.0, (struct figures[3]){{2.8, 4}, {3.5, 6}, {3.5, 7}});
    check_steps(RKPR, IAPWS, false, 8.0, (struct figures[3]){{4.8, 10}, {5.5, 12}, {5.5, 12}});
    check_steps(RKPR, IAPWS, true, 8.0, (struct figures[3]){{4.8, 10}, {5.5, 12}, {5.5, 12}});
}

/* Closing again changes no bit and takes no step: what rests rests, and a checkpoint goes on with the same bits. */
static void test_fixed(void **state)
{
    (void)state;
    struct mixture mix;
    start(&mix, TABLE, IAPWS, true);
    random_states(&mix);
    close_from(&mix, 3.0);
    size_t size = (size_t)mix.model->n_field * POINTS * sizeof(double);
    double *before = mem_new(size, 1);
    memcpy(before, mix.got, size);
    struct mix_effort effort = mix_primitives(mix.model, POINTS, POINTS, mix.u, mix.got);
    assert_true(effort.solved > POINTS / 2 && effort.steps == 0 && effort.most == 0);
    assert_memory_equal(before, mix.got, size);
    mem_free(before);
    stop(&mix);
}

/* One point by itself, and on the path of its one material, has the bits that it has among all others. */
static void test_alone(void **state)
{
    (void)state;
    struct mixture mix;
    unsigned pure = 0, linear = 0;
    start(&mix, RKPR, IAPWS, true);
    random_states(&mix);
    close_from(&mix, 3.0);
    const struct model *model = mix.model;
    for (size_t i = 0; i < POINTS; i++) {
        double u[FLOW_FIELDS], got[FLOW_FIELDS] = {0}, p = 3.0 * mix.w[model->i_E * POINTS + i];
        for (unsigned q = 0; q < model->n_field; q++) u[q] = mix.u[q * POINTS + i];
        got[model->i_E] = p;
        mix_primitives(model, 1, 1, u, got);
        for (unsigned q = 0; q < model->n_field; q++) assert_true(got[q] == mix.got[q * POINTS + i]);
        for (unsigned l = 0; l < model->n_material; l++) {
            if (u[model->i_alpha + l] != 1.0) continue;
            got[model->i_E] = p;
            struct mix_effort effort = mix_primitives(model->pure[l], 1, 1, u, got);
            assert_true(got[model->i_E] == mix.got[model->i_E * POINTS + i]);
            assert_true((effort.solved == 0) == (model->eos[l].law->linear != NULL));
            pure++;
            linear += effort.solved == 0;
        }
    }
    print_message("%u points of one material, %u of them in closed form\n", pure, linear);
    assert_true(pure > 50 && linear > 10 && linear < pure);
    stop(&mix);
}

/* Laws whose `linear` is hidden give what the closed form gives. */
static void test_closed_form(void **state)
{
    (void)state;
    struct mixture mix;
    start(&mix, "{eos: {type: ideal-gas, gamma: 1.4}}", MNASG, true);
    random_states(&mix);
    struct model model = *mix.model;
    struct bulla_eos hidden[3];
    for (unsigned l = 0; l < 3; l++) {
        hidden[l] = *model.eos[l].law;
        hidden[l].linear = NULL;
        model.eos[l].law = &hidden[l];
    }
    model.linear = false;
    mix.model = &model;
    struct mix_effort effort = close_from(&mix, 3.0);
    print_message("linear laws, iterated: %.2f steps\n", (double)effort.steps / (double)effort.solved);
    assert_true(effort.solved == POINTS && effort.failed == 0);
    assert_true(effort.steps <= 2 * POINTS);
    assert_true(worst_error(&mix) <= 1.0);
    stop(&mix);
}

/* No energy, or one that is no number: a number below what a material bears, never a NaN, and it is counted. */
static void test_failure(void **state)
{
    (void)state;
    static const double energies[] = {-1e12, -HUGE_VAL, (double)NAN, HUGE_VAL};
    struct mixture mix;
    start(&mix, RKPR, IAPWS, true);
    random_states(&mix);
    const struct model *model = mix.model;
    for (size_t k = 0; k < 4; k++)
        for (size_t i = 1; i < 40; i += 10) {
            double u[FLOW_FIELDS], got[FLOW_FIELDS] = {0}, stiff[3], least = HUGE_VAL;
            for (unsigned q = 0; q < model->n_field; q++) u[q] = mix.u[q * POINTS + i];
            u[model->i_E] = energies[k];
            struct mix_effort effort = mix_primitives(model, 1, 1, u, got);
            assert_true(effort.failed == 1 && isfinite(got[model->i_E]));
            mix_stiffness(model, 1, 1, got, stiff);
            for (unsigned l = 0; l < 3; l++)
                if (got[l] > MIX_PRESSURE_FELT && stiff[l] < least) least = stiff[l];
            assert_true(!(least > 0.0));
        }
    stop(&mix);
}

/* Such a cell is named, with the material. */
static void test_named(void **state)
{
    (void)state;
    struct mixture mix;
    start(&mix, RKPR, IAPWS, false);
    const struct model *model = mix.model;
    struct stage *stage = mix.flow.state->stages[0];
    size_t n = mix.flow.state->mesh->n_cell;
    stage->level->u_old[0][model->i_E * n + 3] = -1e12;
    assert_int_equal(verdict_start(stage, &mix.flow.state->counts.relaxed), STATUS_CASE);
    print_message("%s\n", status_text());
    assert_non_null(strstr(status_text(), "below what material 'water'"));
    assert_non_null(strstr(status_text(), "cell (3, 0, 0)"));
    stop(&mix);
}

/* A law that is iterated itself has noise: a bracket that holds nothing else is an end, not a loss. */
static void test_noise(void **state)
{
    (void)state;
    struct mixture mix;
    uint64_t seed = 7;
    start(&mix, "{eos: {type: ideal-gas, gamma: 1.4}}", "{eos: {type: iapws95, eval: analytic}}", false);
    const struct model *model = mix.model;
    random_states(&mix);
    for (size_t i = 0; i < POINTS; i++) {
        double p = 5e4 + 2e5 * flow_random(&seed), T = 280.0 + 20.0 * flow_random(&seed), alpha = flow_random(&seed);
        for (unsigned l = 0; l < 2; l++) {
            model->eos[l].law->density(model->eos[l].self, 1, &p, &T, &mix.w[(model->i_m + l) * POINTS + i]);
            mix.w[(model->i_alpha + l) * POINTS + i] = l == 0 ? alpha : 1.0 - alpha;
        }
        mix.w[model->i_E * POINTS + i] = p;
    }
    mix_conserved(model, POINTS, POINTS, mix.w, mix.u);
    struct mix_effort effort = close_from(&mix, 0.0);
    assert_int_equal(effort.failed, 0);
    for (size_t i = 0; i < POINTS; i++) {
        double want = mix.w[model->i_E * POINTS + i], p = mix.got[model->i_E * POINTS + i];
        assert_true(fabs(p / want - 1.0) < 1e-6);
    }
    stop(&mix);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_steps),       cmocka_unit_test(test_fixed),   cmocka_unit_test(test_alone),
        cmocka_unit_test(test_closed_form), cmocka_unit_test(test_failure), cmocka_unit_test(test_named),
        cmocka_unit_test(test_noise),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
