/* Faces in slow flow: the jump of velocity that is left, kernel by kernel and through each Riemann solver. */
#include "flow.h"

#include "scheme/bound.h"
#include "scheme/face.h"
#include "scheme/low_mach.h"
#include "scheme/terms.h"

enum { FACES = 64 };

static uint64_t seed = 5;

/* Edges of FACES faces: water at rest, then what the tests change. */
struct edges_of {
    double rho[2 * FACES], rho_c2[2 * FACES], u[2 * FACES], part[FACES];
    double p[FACES + 3], mask[FACES + 1]; /* p: of the cells, one more on each side */
};

static struct low_mach water(struct edges_of *row, double least)
{
    for (int i = 0; i < 2 * FACES; i++) {
        row->rho[i] = 1000.0;
        row->rho_c2[i] = 2.6e9;
    }
    for (int i = 0; i < FACES + 3; i++) row->p[i] = 1e5 + 1e4 * i; /* an even rise */
    for (int i = 0; i < FACES; i++) {
        double mean = i % 3 ? 0.0 : 20.0 * (flow_random(&seed) - 0.5), jump = 2.0 * (flow_random(&seed) - 0.5);
        row->u[i] = mean - 0.5 * jump;
        row->u[FACES + i] = mean + 0.5 * jump;
    }
    memset(row->mask, 0, sizeof row->mask);
    return (struct low_mach){.n = FACES,
                             .right = FACES,
                             .least = least,
                             .rho = row->rho,
                             .rho_c2 = row->rho_c2,
                             .reach = 1,
                             .p = row->p,
                             .mask = row->mask,
                             .step = 1,
                             .part = row->part};
}

static void draw(const struct low_mach *faces, double *u)
{
    low_mach_weigh(faces, u);
    low_mach_draw(faces, u);
}

/* Beside cells where a liquid evaporates LOW_MACH_FRONT is left, though all others keep their jump. */
static void test_front(void **state)
{
    (void)state;
    struct edges_of row, old;
    struct low_mach faces = water(&row, 1.0);
    double liquid[FACES + 1], front[FACES + 1] = {0};
    for (int i = 0; i <= FACES; i++) liquid[i] = i < FACES / 2 ? 1.0 - 1e-9 : 0.0;
    liquid[FACES / 2] = 0.3;
    low_mach_surface(FACES + 1, liquid, front);
    faces.front = front;
    old = row;
    draw(&faces, row.u);
    for (int i = 0; i < FACES; i++) {
        double left = old.u[i], right = old.u[FACES + i], jump = right - left;
        double mach = fmax(fabs(left), fabs(right)) / sqrt(2.6e9 / 1000.0);
        bool beside = i == FACES / 2 || i == FACES / 2 - 1;
        double part = beside ? LOW_MACH_FRONT + mach : 1.0;
        assert_true(fabs(row.u[FACES + i] - row.u[i] - part * jump) <= 1e-14);
    }
}

/* The jump becomes `least` and the Mach number of the faster side of it, the mean stays. */
static void test_jump(void **state)
{
    (void)state;
    struct edges_of row, old;
    struct low_mach faces = water(&row, 0.05);
    old = row;
    draw(&faces, row.u);
    for (int i = 0; i < FACES; i++) {
        double left = old.u[i], right = old.u[FACES + i];
        double mach = fmax(fabs(left), fabs(right)) / sqrt(2.6e9 / 1000.0), jump = right - left;
        assert_true(fabs(row.u[FACES + i] - row.u[i] - (0.05 + mach) * jump) <= 1e-14);
        assert_true(fabs(row.u[FACES + i] + row.u[i] - (left + right)) <= 1e-14 * (fabs(left) + fabs(right)));
    }
}

/* Air beside water: the Mach number of each side is its own, the stiffer side judges how the pressure bends, the more
 * bent cell counts, and the contact between them is as fast as before: the water hardly moves. */
static void test_sides(void **state)
{
    (void)state;
    struct edges_of row, old;
    struct low_mach faces = water(&row, 0.01);
    for (int i = 0; i < FACES; i++) {
        row.rho[i] = 1.2;
        row.rho_c2[i] = 1.4e5;
    }
    for (int i = 0; i < FACES + 3; i++) row.p[i] = 1e5 + i * i * i * 100.0; /* bends by 600 i about cell i */
    old = row;
    draw(&faces, row.u);
    for (int i = 0; i < FACES; i++) {
        double jump = old.u[FACES + i] - old.u[i];
        double air = fabs(old.u[i]) / sqrt(1.4e5 / 1.2), deep = fabs(old.u[FACES + i]) / sqrt(2.6e9 / 1000.0);
        double z = 0.01 + fmax(air, deep) + 200.0 * 600.0 * (i + 2) / 2.6e9; /* cell i + 1 is number i + 2 here */
        assert_true(fabs(row.u[FACES + i] - row.u[i] - z * jump) <= 1e-14);
        double Z_air = sqrt(1.2 * 1.4e5), Z_water = sqrt(1000.0 * 2.6e9), moved = row.u[FACES + i] - old.u[FACES + i];
        assert_true(fabs(Z_air * (row.u[i] - old.u[i]) + Z_water * moved) <= 1e-14 * Z_water);
        assert_true(fabs(moved) <= 3e-4 * fabs(jump));
    }
}

/* What moves as fast as sound, waves, troubled cells and equal velocities keep their bits. */
static void test_kept(void **state)
{
    (void)state;
    struct edges_of row, old;
    struct low_mach faces = water(&row, 0.05);
    for (int i = 0; i < FACES; i++) {
        if (i % 4 == 0) row.u[i] += 1700.0;
        if (i % 4 == 1) row.p[i + 1 + i / 4 % 2] += 2.6e9 / 200.0;
        if (i % 4 == 2) row.u[FACES + i] = row.u[i];
        if (i % 4 == 3) row.mask[i + i / 4 % 2] = 1.0;
    }
    old = row;
    draw(&faces, row.u);
    assert_memory_equal(row.u, old.u, sizeof row.u);
}

static void test_mirror(void **state)
{
    (void)state;
    struct edges_of row, back;
    struct low_mach faces = water(&row, 0.05), mirrored = water(&back, 0.05);
    for (int i = 0; i < FACES + 3; i++) row.p[i] += 1e6 * flow_random(&seed);
    for (int i = 0; i < FACES + 3; i++) back.p[i] = row.p[FACES + 2 - i];
    for (int i = 0; i < 2 * FACES; i++) row.rho[i] *= 0.01 + flow_random(&seed);
    for (int i = 0; i < 2 * FACES; i++) back.rho[i] = row.rho[2 * FACES - 1 - i];
    for (int i = 0; i < 2 * FACES; i++) back.u[i] = -row.u[2 * FACES - 1 - i];
    draw(&faces, row.u);
    draw(&mirrored, back.u);
    for (int i = 0; i < 2 * FACES; i++) assert_true(back.u[i] == -row.u[2 * FACES - 1 - i]);
}

/* Along the faces, of a solver that resists shear: the same z in one liquid, all of the jump where the light side could
 * not diffuse what the heavy one carries. */
static void test_along(void **state)
{
    (void)state;
    struct edges_of row, along;
    struct low_mach faces = water(&row, 0.05);
    for (int i = 0; i < FACES; i += 2) row.rho[FACES + i] = 4.0; /* and gas behind every other face */
    for (int i = 0; i < FACES; i++) row.rho_c2[FACES + i] = row.rho[FACES + i] * 2.6e6;
    along = row;
    low_mach_weigh(&faces, row.u);
    for (int i = 0; i < FACES; i++) row.part[i] = 0.25;
    low_mach_lighten(&faces);
    low_mach_draw(&faces, along.u);
    for (int i = 0; i < FACES; i++) {
        double jump = row.u[FACES + i] - row.u[i], z = i % 2 ? 0.25 : 1.0 - 0.75 * 0.004;
        assert_true(fabs(along.u[FACES + i] - along.u[i] - z * jump) <= 1e-14);
    }
}

/* Water that comes and goes from cell to cell by 1 m/s at one pressure: limiters leave the jumps to the faces. */
static void shake(const struct model *model, const double x[3], double *w)
{
    w[model->i_u] = (int)(x[0] * 32.0) % 2 ? 1.0 : -1.0;
}

/* Jumps that the normal momentum shows at inner faces of the shaken water, in rho c: the largest, and that at the
 * last. */
static double shaken(const char *solver, double least, bool masked, double *ret_last)
{
    struct flow flow;
    flow_start(&flow,
               mem_print("bulla: 1\ntitle: shaken\ndomain: {lower: [0], upper: [1], cells: [32], boundaries: {x-: "
                         "periodic, x+: periodic}}\nmesh: {tile: 32}\nmaterials:\n" FLOW_WATER
                         "initial:\n  - {everywhere: true, material: water, density: 1000, pressure: 1e5}\n"
                         "scheme: {riemann: %s, low-mach: %g}\nrun: {until: 1}\n",
                         solver, least));
    flow_set(&flow, shake);
    const struct model *model = flow.state->model;
    const struct frame_source source = flow_source(&flow);
    struct face_work *work = face_new(model);
    struct frame frame = frame_piece(flow.state->mesh, 0, 0);
    frame_gather(&source, 0, &frame, FACE_ROOM, work->frame);
    for (size_t i = 0; i < frame.count; i++) work->mask[i] = 1.0;
    work->open[0][1] = true;
    face_solve(work, &frame, masked);
    double most = 0.0, c = sqrt(4.4 * (1e5 + 6e8) / 1000.0);
    for (size_t i = 1; i < 31; i++) most = fmax(most, fabs(work->momentum[face_at(&frame, 0, i)] - 1e5));
    *ret_last = fabs(work->momentum[face_at(&frame, 0, 31)] - 1e5) / (1000.0 * c);
    face_free(work);
    flow_stop(&flow);
    return most / (1000.0 * c);
}

static void test_solvers(void **state)
{
    (void)state;
    static const char *const solvers[] = {"hllc", "hll", "hlld", "rusanov"};
    double last;
    for (size_t i = 0; i < sizeof solvers / sizeof *solvers; i++) {
        assert_true(fabs(shaken(solvers[i], 1.0, false, &last) - 1.0) < 0.01);
        assert_true(fabs(shaken(solvers[i], 0.05, false, &last) - 0.05) < 0.002);
        assert_true(fabs(last - 1.0) < 0.01);                                  /* beside an open boundary: all of it */
        assert_true(fabs(shaken(solvers[i], 0.05, true, &last) - 1.0) < 0.01); /* troubled cells: all of it */
    }
}

/* Water that moves slowly across the faces, and along them to and fro from cell to cell. */
static void shear(const struct model *model, const double x[3], double *w)
{
    w[model->i_u] = 1e-3;
    w[model->i_u + 1] = (int)(x[0] * 32.0) % 2 ? 1.0 : -1.0;
}

/* The largest shear stress at inner faces of the sheared water, in rho c/2 times the jump. */
static double sheared(const char *solver, double least)
{
    struct flow flow;
    flow_start(&flow, mem_print("bulla: 1\ntitle: sheared\ndomain: {lower: [0], upper: [1], cells: [32], "
                                "velocity-components: 2, boundaries: {x-: periodic, x+: periodic}}\nmesh: {tile: 32}\n"
                                "materials:\n" FLOW_WATER
                                "initial:\n  - {everywhere: true, material: water, density: 1000, pressure: 1e5}\n"
                                "scheme: {riemann: %s, low-mach: %g}\nrun: {until: 1}\n",
                                solver, least));
    flow_set(&flow, shear);
    const struct frame_source source = flow_source(&flow);
    struct face_work *work = face_new(flow.state->model);
    struct frame frame = frame_piece(flow.state->mesh, 0, 0);
    frame_gather(&source, 0, &frame, FACE_ROOM, work->frame);
    face_solve(work, &frame, false);
    double most = 0.0, c = sqrt(4.4 * (1e5 + 6e8) / 1000.0);
    for (size_t i = 1; i < 31; i++) most = fmax(most, fabs(work->momentum[FACE_ROOM + face_at(&frame, 0, i)]));
    face_free(work);
    flow_stop(&flow);
    return most / (1000.0 * c);
}

/* Only solvers that resist shear have anything to be drawn along the faces. */
static void test_shear(void **state)
{
    (void)state;
    assert_true(fabs(sheared("hll", 1.0) - 1.0) < 1e-5);
    assert_true(fabs(sheared("hll", 0.05) - 0.05) < 1e-5);
    assert_true(fabs(sheared("rusanov", 0.05) - 0.05) < 1e-5);
    assert_true(sheared("hllc", 0.05) > 0.0 && sheared("hllc", 0.05) == sheared("hllc", 1.0)); /* the upwind side */
}

/* Several fluids or a viscous one, not on a line, beside solids, or with tension where curvature is an estimate. */
static void test_default(void **state)
{
    (void)state;
    static const struct {
        const char *name;
        double low_mach;
    } scenes[] = {{"a4-collapse-20", 0.05},
                  {"a4-axisymmetric-20", 0.05},
                  {"sb1", 0.05},
                  {"v04-poiseuille", 0.05},
                  {"k1-rest", 0.05},
                  {"k5-drop", 1.0},
                  {"h8", 1.0},
                  {"a3-acoustic-2d", 1.0},
                  {"rest-gel", 1.0},
                  {"rest-slow", 0.05}};
    for (size_t i = 0; i < sizeof scenes / sizeof *scenes; i++) {
        char path[256];
        struct scene *scene = NULL;
        const struct scene_options options = {0};
        snprintf(path, sizeof path, "cases/verify/%s.yaml", scenes[i].name);
        if (scene_read(path, &options, &scene)) fail_msg("%s is refused", path);
        if (scene->scheme.low_mach != scenes[i].low_mach) fail_msg("%s: %g", path, scene->scheme.low_mach);
        scene_free(scene);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(test_front),  cmocka_unit_test(test_jump),
                                       cmocka_unit_test(test_sides),  cmocka_unit_test(test_kept),
                                       cmocka_unit_test(test_mirror), cmocka_unit_test(test_along),
                                       cmocka_unit_test(test_shear),  cmocka_unit_test(test_solvers),
                                       cmocka_unit_test(test_default)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
