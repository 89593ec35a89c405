/* Refinement with a solid: a uniform stretch stays uniform over all faces between levels; masses, momentum and energy
 * are conserved; a mesh refined everywhere is the uniform fine one; and refluxing corrects the stretch by what the
 * velocity at the face does to it. */
#include "amr.h"

#include "phys/elastic.h"

#define TISSUE                                                                                              \
    "  tissue: {eos: {type: stiffened-gas, gamma: 4.4, p-inf: 600 MPa}, constitutive: {type: neo-hookean, " \
    "shear-modulus: 500 MPa, reference-density: 1000}}\n"

#define BOX1 "boundaries: {x-: periodic, x+: periodic}"
#define BOX2 "boundaries: {x-: periodic, x+: periodic, y-: periodic, y+: periodic}"
#define BOX3 "boundaries: {x-: periodic, x+: periodic, y-: periodic, y+: periodic, z-: periodic, z+: periodic}"
#define MOVING "{lua: '= math.abs(x - 0.4 - 2500 * t) < 0.12'}"

struct setup {
    const char *name, *domain, *mesh, *refine, *velocity;
    double V[6]; /* a stretch that stays where it is */
};

/* Around an axis only what is alike in r and theta is at rest. */
static const struct setup STREAMS[] = {
    {"line",
     "{lower: [0], upper: [1], cells: [64], velocity-components: 3, " BOX1 "}",
     "levels: 2, tile: 8",
     "{region: {box: {lower: [0.3], upper: [0.6]}}}",
     "[130, 20, -40]",
     {1.2, 0.9, 1.0, 0.2, -0.1, 0.15}},
    {"moving line",
     "{lower: [0], upper: [1], cells: [64], " BOX1 "}",
     "levels: 2, tile: 8",
     MOVING,
     "[130]",
     {1.3, 0.9, 0.8}},
    {"plane",
     "{lower: [0, 0], upper: [1, 1], cells: [32, 32], " BOX2 "}",
     "levels: 2, tile: 8",
     "{region: {sphere: {center: [0.5, 0.4], radius: 0.2}}}",
     "[130, -70]",
     {1.2, 0.9, 1.0, 0.3}},
    {"moving plane",
     "{lower: [0, 0], upper: [1, 1], cells: [32, 32], velocity-components: 3, " BOX2 "}",
     "levels: 2, tile: 8",
     MOVING,
     "[130, -70, 25]",
     {1.2, 0.9, 1.0, 0.3, -0.2, 0.1}},
    {"space",
     "{lower: [0, 0, 0], upper: [1, 1, 1], cells: [8, 8, 8], " BOX3 "}",
     "levels: 2, tile: 4",
     MOVING,
     "[130, -70, 40]",
     {1.2, 0.9, 1.0, 0.3, -0.2, 0.1}},
    {"axisymmetric along the axis",
     "{geometry: axisymmetric, lower: [0, 0], upper: [1, 1], cells: [32, 32], boundaries: {x-: axis, x+: reflecting, "
     "y-: periodic, y+: periodic}}",
     "levels: 2, tile: 8",
     MOVING,
     "[0, 130]",
     {1.1, 0.8264462809917354, 1.1, 0.0}},
    {"spherical at rest",
     "{geometry: spherical, lower: [0], upper: [1], cells: [64], boundaries: {x-: axis, x+: reflecting}}",
     "levels: 2, tile: 8",
     MOVING,
     "[0]",
     {1.0, 1.0, 1.0}},
};
enum { N_STREAM = sizeof STREAMS / sizeof *STREAMS, STREAM_STEPS = 16 };

/* The stretch that set_stretch gives. */
static double stretch[6];

static void set_stretch(const struct model *model, const double x[3], double *w)
{
    (void)x;
    for (unsigned c = 0; c < model->n_stretch; c++) w[model->i_V + c] = stretch[c];
    elastic_unimodular(model, 1, 1, w + model->i_V);
}

/* alone: nothing but solid, else mixed with water. */
static char *stream_case(const struct setup *setup, bool alone, const char *more)
{
    return mem_print("bulla: 1\ntitle: free stream of a stretched solid\ndomain: %s\n"
                     "mesh: {%s, regrid-every: 2, buffer: 2, patience: 1%s, refine: [%s]}\n"
                     "materials:\n%s" TISSUE "initial:\n  - {everywhere: true, %s, pressure: 1e5, velocity: %s}\n"
                     "scheme: {closure: allaire}\nrun: {until: 1}\n",
                     setup->domain, setup->mesh, more, setup->refine, alone ? "" : FLOW_WATER,
                     alone ? "material: tissue, density: 1000"
                           : "fractions: {water: 0.7, tissue: 0.3}, density: {water: 1000, tissue: 1040}",
                     setup->velocity);
}

/* Worst distance of any primitive from its first value, relative to what a wave changes. */
static double worst_of(const struct flow *flow, const double *first)
{
    const struct model *model = flow->state->model;
    double worst = 0.0;
    for (unsigned q = 0; q < model->n_field; q++) {
        double scale = q < model->i_m || q >= model->i_V ? 1.0 : q < model->i_u ? 1e3 : q < model->i_E ? 1.8e3 : 3.3e9;
        double off = amr_deviation(flow, q, first[q]) / scale;
        if (off > 1e-12) print_error("%s is off by %.3g\n", model->field_names[q], off);
        worst = fmax(worst, off);
    }
    return worst;
}

static void check_stream(const struct setup *setup, bool alone, const char *more)
{
    struct flow flow;
    double first[FLOW_FIELDS];
    flow_start(&flow, stream_case(setup, alone, more));
    memcpy(stretch, setup->V, sizeof stretch);
    amr_set(&flow, set_stretch, NULL);
    assert_true(flow.state->mesh->n_level == flow.scene->mesh.levels + 1);
    for (unsigned q = 0; q < flow.state->model->n_field; q++)
        first[q] = flow.state->mesh->levels[0].w[0][q * flow.state->mesh->n_cell];
    flow_steps(&flow, STREAM_STEPS);
    amr_print(&flow, setup->name);
    double worst = worst_of(&flow, first);
    print_message("  %s: off by %.1e\n", alone ? "solid" : "mixture", worst);
    if (!(worst <= 1e-12)) fail_msg("%s: off by %g", setup->name, worst);
    assert_int_equal(flow.state->counts.retries, 0);
    assert_true(setup->refine[1] == 'r' || flow.state->counts.regrids > 0);
    flow_stop(&flow);
}

static void test_stream(void **state)
{
    (void)state;
    for (int i = 0; i < N_STREAM; i++) {
        check_stream(&STREAMS[i], true, "");
        check_stream(&STREAMS[i], false, "");
    }
    check_stream(&STREAMS[1], true, ", subcycle: false");
}

struct closed {
    const char *name, *domain, *mesh, *velocity, *core, *bubble;
    int skip; /* a momentum that walls or hoops feed, or -1 */
};

static const struct closed CLOSED[] = {
    {"line", "{lower: [0], upper: [1], cells: [64], velocity-components: 2, " BOX1 "}", "levels: 2, tile: 8",
     "[100, '= 20 * math.sin(6.2831853 * x)']", "[0.4]", "[0.85]", -1},
    {"plane", "{lower: [0, 0], upper: [1, 1], cells: [32, 32], " BOX2 "}", "levels: 2, tile: 8",
     "[100, '= 20 * math.sin(6.2831853 * x)']", "[0.4, 0.5]", "[0.8, 0.6]", -1},
    {"space", "{lower: [0, 0, 0], upper: [1, 1, 1], cells: [8, 8, 8], " BOX3 "}", "levels: 2, tile: 4",
     "[100, '= 20 * math.sin(6.2831853 * x)', 30]", "[0.4, 0.5, 0.5]", "[0.8, 0.6, 0.5]", -1},
    {"axisymmetric",
     "{geometry: axisymmetric, lower: [0, 0], upper: [1, 1], cells: [32, 32], "
     "boundaries: {x-: axis, x+: reflecting, y-: periodic, y+: periodic}}",
     "levels: 2, tile: 8", "[0, 100]", "[0, 0.4]", "[0, 0.8]", 0},
    {"spherical", "{geometry: spherical, lower: [0], upper: [1], cells: [64], boundaries: {x-: axis, x+: reflecting}}",
     "levels: 2, tile: 8", "[0]", "[0.6]", "[0]", 0},
};
enum { N_CLOSED = sizeof CLOSED / sizeof *CLOSED, CLOSED_STEPS = 40 };

static char *closed_case(const struct closed *setup, const char *more)
{
    return mem_print(
        "bulla: 1\ntitle: conservation\ndomain: %s\n"
        "mesh: {%s, regrid-every: 2, buffer: 2, patience: 1, %s, refine: [{jump: alpha_tissue, above: 0.1}, "
        "{jump: pressure, above: 0.9, finest: 1}]}\n"
        "materials:\n" FLOW_WATER FLOW_AIR TISSUE "initial:\n"
        "  - {everywhere: true, material: water, density: 1000, pressure: 1e5, velocity: %s}\n"
        "  - {sphere: {center: %s, radius: 0.2}, material: tissue, density: 1050, pressure: 3e8, velocity: %s}\n"
        "  - {sphere: {center: %s, radius: 0.12}, material: air, density: 1.2, pressure: 1e5, velocity: %s}\n"
        "run: {until: 1}\n",
        setup->domain, setup->mesh, more, setup->velocity, setup->core, setup->velocity, setup->bubble,
        setup->velocity);
}

/* The largest relative drift of all conserved sums. */
static double worst_drift(const struct closed *setup, const char *more, int steps)
{
    struct flow flow;
    flow_start(&flow, closed_case(setup, more));
    const struct model *model = flow.state->model;
    double size[FLOW_FIELDS], now, worst = 0.0, strain = 0.0;
    long double before[FLOW_FIELDS];
    for (unsigned q = model->i_m; q < model->i_V; q++) before[q] = amr_total(&flow, q, &size[q]);
    flow_steps(&flow, steps);
    amr_print(&flow, setup->name);
    for (unsigned q = model->i_m; q < model->i_V; q++) {
        if (setup->skip >= 0 && q == model->i_u + (unsigned)setup->skip) continue;
        double off = (double)fabsl(amr_total(&flow, q, &now) - before[q]) / fmax(size[q], now);
        worst = off <= worst ? worst : off;
    }
    for (unsigned c = 0; c < 3; c++) strain = fmax(strain, amr_deviation(&flow, model->i_V + c, 1.0));
    print_message("  drift %.1e, strain %.2g\n", worst, strain);
    assert_true(strain > 0.01 && strain < 10.0);
    assert_true(flow.state->counts.regrids > 2);
    flow_stop(&flow);
    return worst;
}

static void test_kept(void **state)
{
    (void)state;
    for (int i = 0; i < N_CLOSED; i++) {
        double worst = worst_drift(&CLOSED[i], "subcycle: true", CLOSED_STEPS);
        if (!(worst <= 1e-14)) fail_msg("%s: drift %g", CLOSED[i].name, worst);
    }
}

/* The check can fail. */
static void test_lost(void **state)
{
    (void)state;
    for (int i = 0; i < N_CLOSED; i++) {
        double worst = worst_drift(&CLOSED[i], "reflux: off", CLOSED_STEPS / 2);
        if (!(worst > 1e-10)) fail_msg("%s: drift of only %g without refluxing", CLOSED[i].name, worst);
    }
}

struct whole {
    const char *name, *domain; /* with room for the numbers of cells */
    int cells, levels, steps;
};

static const struct whole WHOLE[] = {
    {"line", "{lower: [0], upper: [1], cells: [%d], velocity-components: 2, " BOX1 "}", 32, 2, 12},
    {"plane",
     "{lower: [0, 0], upper: [1, 1], cells: [%d, %d], boundaries: {x-: periodic, x+: periodic, y-: "
     "reflecting, y+: non-reflecting}}",
     16, 2, 8},
    {"axisymmetric",
     "{geometry: axisymmetric, lower: [0, 0], upper: [1, 1], cells: [%d, %d], boundaries: {x-: axis, "
     "x+: outflow, y-: outflow, y+: reflecting}}",
     16, 2, 8},
    {"space", "{lower: [0, 0, 0], upper: [1, 1, 1], cells: [%d, %d, %d], " BOX3 "}", 8, 1, 4},
};

/* How far the solid is stretched. What shares its traction with gas of 2 bar must not pull harder than that. */
static double skew;

/* Skew pressures, velocities and stretches, a solid that tile borders cut, a gas beside it. */
static void set_skew(const struct model *model, const double x[3], double *w)
{
    double solid = hypot(hypot(x[0] - 0.52, x[1] - 0.47), x[2] - 0.3) < 0.33 ? 1.0 : 0.0;
    double gas = x[0] > 0.8 && solid == 0.0 ? 1.0 : 0.0;
    w[0] = 1.0 - solid - gas;
    w[1] = gas;
    w[2] = solid;
    w[model->i_m] = w[model->i_m + 2] = 1000.0;
    w[model->i_m + 1] = 1.2;
    for (unsigned d = 0; d < model->n_velocity; d++) w[model->i_u + d] = 4.0 * cos(3.0 * x[0] + 2.0 * x[1] + (double)d);
    w[model->i_E] = x[0] + 0.5 * x[1] - x[2] > 0.6 ? 2e6 : 2e5;
    for (unsigned c = 0; c < model->n_stretch && solid > 0.0; c++)
        w[model->i_V + c] = (c < 3) + skew * sin(4.0 * x[0] + 3.0 * x[1] + (double)c);
    elastic_unimodular(model, 1, 1, w + model->i_V);
}

static void start_whole(struct flow *flow, const struct whole *setup, bool common, bool fine, double dt)
{
    int factor = 1 << setup->levels, n = fine ? setup->cells * factor : setup->cells;
    char *domain = mem_print(setup->domain, n, n, n);
    char *mesh =
        fine ? mem_text("tile: 8") : mem_print("tile: 8, levels: %d, refine: [{lua: '= true'}]", setup->levels);
    flow_start(flow,
               mem_print("bulla: 1\ntitle: refined everywhere\ndomain: %s\nmesh: {%s}\nmaterials:\n" FLOW_WATER FLOW_AIR
                             TISSUE "initial:\n  - {everywhere: true, material: water, density: 1000, "
                         "pressure: 1e5}\nscheme: {dt: %.17g, traction: %s}\nrun: {until: 1}\n",
                         domain, mesh, dt, common ? "common" : "pressure"));
    mem_free(domain);
    mem_free(mesh);
    amr_set(flow, set_skew, NULL);
}

/* Are the finest levels of both the same? */
static bool same_whole(const struct flow *uniform, const struct flow *refined, int levels)
{
    const struct level *a = &uniform->state->mesh->levels[0], *b = &refined->state->mesh->levels[levels];
    size_t bytes = uniform->state->model->n_field * uniform->state->mesh->n_cell * sizeof(double);
    bool equal = a->n_tile == b->n_tile && refined->state->mesh->n_level == levels + 1;
    for (unsigned t = 0; equal && t < a->n_tile; t++) equal = memcmp(a->u_old[t], b->u_old[t], bytes) == 0;
    return equal;
}

static void check_whole(bool common)
{
    skew = common ? 2e-4 : 0.02;
    for (size_t i = 0; i < sizeof WHOLE / sizeof *WHOLE; i++) {
        const struct whole *setup = &WHOLE[i];
        struct flow uniform, refined;
        int factor = 1 << setup->levels;
        double dt = ldexp(floor(ldexp(0.3 / (3.0 * 2000.0 * setup->cells * factor), 40)), -40);
        start_whole(&uniform, setup, common, true, dt);
        start_whole(&refined, setup, common, false, dt * factor);
        assert_true(same_whole(&uniform, &refined, setup->levels));
        flow_steps(&uniform, setup->steps * factor);
        flow_steps(&refined, setup->steps);
        amr_print(&refined, setup->name);
        assert_int_equal(refined.state->counts.retries + uniform.state->counts.retries, 0);
        if (!same_whole(&uniform, &refined, setup->levels)) fail_msg("%s differs from the fine mesh", setup->name);
        flow_stop(&uniform);
        flow_stop(&refined);
    }
}

static void test_whole(void **state)
{
    (void)state;
    check_whole(false);
    check_whole(true);
}

/* What refluxing asked the volume of the stretch to change by at last, before det V is put back to 1: tr(V^-1 dV). */
static double refluxed_volume(const struct flow *flow)
{
    const struct model *model = flow->state->model;
    const struct mesh *mesh = flow->state->mesh;
    double worst = 0.0, *delta = mem_new(model->n_field * mesh->n_cell, sizeof *delta);
    for (int l = 0; l + 1 < mesh->n_level; l++)
        for (unsigned t = 0; t < mesh->levels[l].n_tile; t++) {
            reflux_delta(flow->state->stages[l]->reflux, t, flow->state->stages[l]->dt, delta);
            for (size_t i = 0; i < mesh->n_cell; i++) {
                double sum = 0.0;
                for (unsigned c = 0; c < 3; c++) sum += delta[(model->i_V + c) * mesh->n_cell + i] / stretch[c];
                worst = fmax(worst, fabs(sum));
            }
        }
    mem_free(delta);
    return worst;
}

/* Of an almost uniform stretch in a flow that is not. */
static double volume_asked(const char *more)
{
    const struct setup setup = {.domain = STREAMS[1].domain,
                                .mesh = "levels: 2, tile: 8",
                                .refine = STREAMS[0].refine,
                                .velocity = "['= 1e-3 * math.sin(6.2831853 * x)']"};
    struct flow flow;
    flow_start(&flow, stream_case(&setup, true, more));
    memcpy(stretch, STREAMS[1].V, sizeof stretch);
    amr_set(&flow, set_stretch, NULL);
    flow_steps(&flow, 5);
    double volume = refluxed_volume(&flow);
    print_message("refluxing%s asks for %.1e of volume\n", more, volume);
    flow_stop(&flow);
    return volume;
}

/* How far the coarse cells beside finer ones are from V_xx = (rho0/rho)^(2/3). */
static double push_fault(const struct flow *flow)
{
    const struct model *model = flow->state->model;
    struct amr_leaves leaves = amr_leaves(flow);
    double low = 1.0, high = 0.0, h = flow->state->mesh->levels[0].h[0], worst = 0.0;
    for (size_t i = 0; i < leaves.n; i++) {
        if (leaves.all[i].l == 0) continue;
        low = fmin(low, leaves.all[i].x[0]);
        high = fmax(high, leaves.all[i].x[0]);
    }
    for (size_t i = 0; i < leaves.n; i++) {
        double x = leaves.all[i].x[0], rho = amr_primitive(flow, &leaves.all[i], model->i_m);
        if (leaves.all[i].l || x < low - h || x > high + h) continue;
        worst = fmax(worst, fabs(amr_primitive(flow, &leaves.all[i], model->i_V) - pow(1000.0 / rho, 2.0 / 3.0)));
    }
    mem_free(leaves.all);
    return worst;
}

/* A push through the faces of a patch in an unstretched solid, which stays stretched along one line; mean fault. */
static double push_error(const char *more)
{
    const struct setup setup = {.domain = STREAMS[1].domain,
                                .mesh = "levels: 1, tile: 8",
                                .refine = STREAMS[0].refine,
                                .velocity = "['= 40 * math.exp(-((x - 0.2) / 0.05) ^ 2)']"};
    struct flow flow;
    double sum = 0.0;
    flow_start(&flow, stream_case(&setup, true, more));
    for (int step = 0; step < 60; step++) {
        flow_steps(&flow, 1);
        sum += push_fault(&flow) / 60.0;
    }
    print_message("a push%s: V off by %.3e\n", more, sum);
    flow_stop(&flow);
    return sum;
}

static void test_corrected(void **state)
{
    (void)state;
    double corrected = volume_asked(""), plain = volume_asked(", reflux: plain");
    assert_true(corrected <= 1e-3 * plain);
    assert_true(plain > 1e-12);
    double good = push_error(""), bad = push_error(", reflux: plain");
    assert_true(good < 0.5 * bad);
}

/* A solid that is bent a little at uniform pressure. */
static void set_bent(const struct model *model, const double x[3], double *w)
{
    double *V = w + model->i_V;
    V[0] = 1.0 + 0.0025 * cos(2.0 * M_PI * (x[0] + x[1]));
    V[1] = 1.0 - 0.0025 * sin(2.0 * M_PI * x[0]);
    V[2] = 1.0;
    V[3] = 0.005 * sin(2.0 * M_PI * (x[0] - x[1]));
    elastic_unimodular(model, 1, 1, V);
}

struct birth {
    double V, p, sums, limited; /* mean error of the stretch; worst of p; drift of sums; part of the parents limited */
};

/* Tiles born by interpolation all over the plane. */
static struct birth birth_of(int cells)
{
    struct flow flow;
    struct birth birth = {0};
    flow_start(&flow, mem_print("bulla: 1\ntitle: births\ndomain: {lower: [0, 0], upper: [1, 1], cells: [%d, %d], " BOX2
                                "}\nmesh: {levels: 1, tile: 8, refine: [{lua: '= t > 0'}]}\nmaterials:\n" TISSUE
                                "initial:\n  - {everywhere: true, material: tissue, density: 1000, pressure: 1e5}\n"
                                "run: {until: 1}\n",
                                cells, cells));
    const struct model *model = flow.state->model;
    double size[FLOW_FIELDS], now, exact[FLOW_FIELDS];
    long double before[FLOW_FIELDS];
    assert_int_equal(flow.state->mesh->n_level, 1);
    amr_set(&flow, set_bent, NULL);
    for (unsigned q = model->i_m; q < model->i_V; q++) before[q] = amr_total(&flow, q, &size[q]);
    flow.state->t = 1e-12;
    if (regrid_levels(flow.state, 0)) fail_msg("%s", status_text());
    assert_int_equal(flow.state->mesh->n_level, 2);
    for (unsigned q = model->i_m; q < model->i_V; q++)
        birth.sums = fmax(birth.sums, (double)fabsl(amr_total(&flow, q, &now) - before[q]) / fmax(size[q], 1.0));
    struct amr_leaves leaves = amr_leaves(&flow);
    for (size_t i = 0; i < leaves.n; i++) {
        double V[6] = {0};
        set_bent(model, leaves.all[i].x, exact);
        for (unsigned c = 0; c < model->n_stretch; c++) {
            V[c] = amr_primitive(&flow, &leaves.all[i], model->i_V + c);
            birth.V += leaves.all[i].volume * fabs(V[c] - exact[model->i_V + c]);
        }
        assert_true(fabs((V[0] * V[1] - V[3] * V[3]) * V[2] - 1.0) < 1e-14);
        birth.p = fmax(birth.p, fabs(amr_primitive(&flow, &leaves.all[i], model->i_E) - 1e5));
    }
    birth.limited = (double)flow.state->counts.limited / (cells * cells);
    mem_free(leaves.all);
    flow_stop(&flow);
    print_message("births %d: V off by %.1e, p by %.3g Pa, sums by %.1e, %.2f limited\n", cells, birth.V, birth.p,
                  birth.sums, birth.limited);
    return birth;
}

static void test_births(void **state)
{
    (void)state;
    struct birth coarse = birth_of(32), fine = birth_of(64);
    assert_true(coarse.sums < 1e-15 && fine.sums < 1e-15);
    assert_true(fine.V < coarse.V / 3.0 && fine.p < coarse.p / 3.0);
    assert_true(coarse.p < 1e4);
    assert_true(fine.limited < coarse.limited);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_stream), cmocka_unit_test(test_births), cmocka_unit_test(test_kept),
        cmocka_unit_test(test_lost),   cmocka_unit_test(test_whole),  cmocka_unit_test(test_corrected),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
