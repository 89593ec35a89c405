/* Conservation: masses, momentum and energy over 100 steps of violent flow, to 1e-13 of what there is, in
 * every dimension and geometry, with two and three materials, and when the guard repairs a step. */
#include "flow.h"

enum { STEPS = 100 };

#define ALL_PERIODIC "{x-: periodic, x+: periodic, y-: periodic, y+: periodic, z-: periodic, z+: periodic}"
#define CLOSED_RZ "{x-: axis, x+: reflecting, y-: periodic, y+: periodic}"
#define THREE FLOW_WATER FLOW_AIR FLOW_HELIUM

/* Liquid at 1 GPa against gas at 1 bar, moving along all axes. */
#define BLAST                                                                                   \
    "  - {everywhere: true, material: water, density: 1000, pressure: 1e5, velocity: %s}\n"     \
    "  - {sphere: {center: %s, radius: 0.31}, material: water, density: 1150, pressure: 1e9}\n" \
    "  - {sphere: {center: %s, radius: 0.17}, material: air, density: 1.2, pressure: 1e5, velocity: %s}\n"

static char *blast(const char *domain, const char *materials, const char *velocity, const char *at, const char *bubble)
{
    char *core = strcmp(materials, THREE) != 0
                     ? mem_text("")
                     : mem_print("  - {sphere: {center: %s, radius: 0.09}, material: helium, density: 0.17, "
                                 "pressure: 1e5}\n",
                                 bubble);
    char *text =
        mem_print("bulla: 1\ntitle: conservation\ndomain: %s\nmaterials:\n%sinitial:\n" BLAST "%srun: {until: 1}\n",
                  domain, materials, velocity, at, bubble, velocity, core);
    mem_free(core);
    return text;
}

/* Runs and compares all conserved sums; `skip` is a momentum that walls or hoops feed, or -1. */
static void check_kept(struct flow *flow, int skip)
{
    const struct model *model = flow->state->model;
    double size[FLOW_FIELDS], now;
    long double before[FLOW_FIELDS];
    for (unsigned q = model->i_m; q < model->n_field; q++) before[q] = flow_total(flow, q, &size[q]);
    flow_steps(flow, STEPS);
    for (unsigned q = model->i_m; q < model->n_field; q++) {
        if (skip >= 0 && q == model->i_u + (unsigned)skip) continue;
        long double drift = flow_total(flow, q, &now) - before[q];
        double scale = size[q] > now ? size[q] : now;
        print_message("%s: relative drift %.1e\n", model->field_names[q], (double)(drift / scale));
        if (!(fabsl(drift) <= 1e-13L * scale)) fail_msg("%s drifts by %Lg of %g", model->field_names[q], drift, scale);
    }
}

static void check_text(char *text, int skip)
{
    struct flow flow;
    flow_start(&flow, text);
    check_kept(&flow, skip);
    flow_stop(&flow);
}

static void test_line(void **state)
{
    (void)state;
    const char *domain = "{lower: [0], upper: [1], cells: [200], boundaries: {x-: periodic, x+: periodic}}";
    check_text(blast(domain, FLOW_WATER FLOW_AIR, "[300]", "[0.4]", "[0.85]"), -1);
}

static void test_line_closed(void **state)
{
    (void)state;
    const char *domain = "{lower: [0], upper: [1], cells: [200], boundaries: {x-: reflecting, x+: symmetry}}";
    check_text(blast(domain, THREE, "[30]", "[0.4]", "[0.85]"), 0);
}

static void test_plane(void **state)
{
    (void)state;
    const char *domain = "{lower: [0, 0], upper: [1, 1], cells: [32, 32], boundaries: {x-: periodic, x+: periodic, "
                         "y-: periodic, y+: periodic}}";
    check_text(blast(domain, THREE, "[200, -100]", "[0.4, 0.5]", "[0.8, 0.6]"), -1);
}

static void test_space(void **state)
{
    (void)state;
    const char *domain = "{lower: [0, 0, 0], upper: [1, 1, 1], cells: [16, 16, 16], boundaries: " ALL_PERIODIC "}";
    check_text(blast(domain, FLOW_WATER FLOW_AIR, "[200, -100, 50]", "[0.4, 0.5, 0.5]", "[0.8, 0.6, 0.5]"), -1);
}

static void test_axisymmetric(void **state)
{
    (void)state;
    const char *domain =
        "{geometry: axisymmetric, lower: [0, 0], upper: [1, 1], cells: [32, 32], boundaries: " CLOSED_RZ "}";
    check_text(blast(domain, THREE, "[0, 200]", "[0, 0.4]", "[0, 0.8]"), 0);
}

static void test_spherical(void **state)
{
    (void)state;
    const char *domain = "{geometry: spherical, lower: [0], upper: [1], cells: [128], boundaries: {x-: axis, "
                         "x+: reflecting}}";
    check_text(blast(domain, FLOW_WATER FLOW_AIR, "[0]", "[0.6]", "[0]"), 0);
}

/* Two streams part so fast that almost nothing stays between them: steps have to be repaired. */
static char *parting(const char *domain, const char *velocity)
{
    return mem_print("bulla: 1\ntitle: parting\ndomain: %s\nmaterials:\n" FLOW_AIR
                     "initial:\n  - {everywhere: true, material: air, density: 1, pressure: 1e4, velocity: %s}\n"
                     "scheme: {limiter: superbee, cfl: 0.9}\nrun: {until: 1}\n",
                     domain, velocity);
}

/* The same with two materials: the closure without relaxation has to fall back on first-order fluxes, the other
 * one relaxes the fractions of the cells that the liquid leaves. */
static char *parting_pair(const char *materials, const char *outside, const char *velocity, const char *closure)
{
    return mem_print("bulla: 1\ntitle: parting\n"
                     "domain: {lower: [-1], upper: [1], cells: [128], boundaries: {x-: periodic, x+: periodic}}\n"
                     "materials:\n%sinitial:\n"
                     "  - {everywhere: true, %s, pressure: 1e5, velocity: %s}\n"
                     "  - {box: {lower: [-0.05], upper: [0.11]}, material: air, density: 1, pressure: 1e5}\n"
                     "scheme: {closure: %s, limiter: superbee, cfl: 0.9}\nrun: {until: 1}\n",
                     materials, outside, velocity, closure);
}

static void check_repaired(char *text)
{
    struct flow flow;
    flow_start(&flow, text);
    check_kept(&flow, -1);
    print_message("cells redone %lld, retries %lld\n", flow.state->counts.fallback, flow.state->counts.retries);
    assert_true(flow.state->counts.fallback > 0);
    flow_stop(&flow);
}

static void test_repaired_line(void **state)
{
    (void)state;
    check_repaired(parting("{lower: [-1], upper: [1], cells: [128], boundaries: {x-: periodic, x+: periodic}}",
                           "['= x > 0 and 1500 or -1500']"));
}

static void test_repaired_pair(void **state)
{
    (void)state;
    check_repaired(parting_pair(FLOW_HELIUM FLOW_AIR, "material: helium, density: 0.17",
                                "['= x > 0.2 and 6000 or -6000']", "allaire"));
}

static void test_relaxed_pair(void **state)
{
    (void)state;
    struct flow flow;
    flow_start(&flow, parting_pair(FLOW_WATER FLOW_AIR, "material: water, density: 1000", "['= x > 0 and 800 or -800']",
                                   "kapila"));
    check_kept(&flow, -1);
    print_message("cells relaxed %lld\n", flow.state->counts.relaxed);
    assert_true(flow.state->counts.relaxed > 0);
    flow_stop(&flow);
}

static void test_repaired_plane(void **state)
{
    (void)state;
    check_repaired(parting("{lower: [-1, -1], upper: [1, 1], cells: [32, 32], boundaries: {x-: periodic, x+: periodic, "
                           "y-: periodic, y+: periodic}}",
                           "['= x > 0.1 and 1500 or -1500', '= y > 0.1 and 900 or -900']"));
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_line),          cmocka_unit_test(test_line_closed),
        cmocka_unit_test(test_plane),         cmocka_unit_test(test_space),
        cmocka_unit_test(test_axisymmetric),  cmocka_unit_test(test_spherical),
        cmocka_unit_test(test_repaired_line), cmocka_unit_test(test_repaired_plane),
        cmocka_unit_test(test_repaired_pair), cmocka_unit_test(test_relaxed_pair),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
