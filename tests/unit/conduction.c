/* Heat through channels: they are the whole face for any interface, mixed cells keep one pressure, mirrors mirror to
 * the bit, heat and mass are conserved in every geometry, and traces neither hold up steps nor blow up. */
#include "conduction.h"

#include "scheme/conduction_channel.h"
#include "scheme/conduction_front.h"
#include "scheme/face.h"
#include "scheme/heed.h"

/* --- the channels themselves --- */

enum { FACES = 200, KINDS = 4 };

static void random_fractions(uint64_t *seed, double alpha[KINDS][FACES + 1])
{
    for (int i = 0; i <= FACES; i++) {
        double sum = 0.0;
        for (int l = 0; l < KINDS; l++) sum += alpha[l][i] = flow_random(seed) < 0.4 ? 0.0 : flow_random(seed);
        if (sum == 0.0) sum = alpha[0][i] = 1.0;
        for (int l = 0; l < KINDS; l++) alpha[l][i] /= sum;
    }
}

static void test_channels_fill_the_face(void **state)
{
    (void)state;
    uint64_t seed = 7;
    double alpha[KINDS][FACES + 1], own[FACES], left[KINDS][FACES], right[KINDS][FACES], rest[FACES] = {0};
    double all[FACES] = {0}, touched[KINDS][FACES] = {{0}}, cross[FACES];
    random_fractions(&seed, alpha);
    for (int l = 0; l < KINDS; l++) {
        conduction_channel_own(FACES, alpha[l], alpha[l] + 1, own, left[l], right[l], rest);
        for (int i = 0; i < FACES; i++) all[i] += own[i], touched[l][i] += own[i];
    }
    for (int l = 0; l < KINDS; l++)
        for (int m = 0; m < KINDS; m++) {
            if (m == l) continue;
            conduction_channel_cross(FACES, left[l], right[m], rest, cross);
            for (int i = 0; i < FACES; i++) {
                assert_true(cross[i] >= 0.0);
                all[i] += cross[i], touched[l][i] += cross[i];
            }
        }
    for (int i = 0; i < FACES; i++) {
        assert_true(fabs(all[i] - 1.0) < 1e-14);
        for (int l = 0; l < KINDS; l++) assert_true(fabs(touched[l][i] - alpha[l][i]) < 1e-14);
    }
}

/* Hot vapour (or superheated liquid) beside a cell that holds liquid and vapour at one temperature: only the half cell
 * on this side resists; as in series where nothing is at one temperature; mirrors mirror to the bit. */
static void test_surface(void **state)
{
    (void)state;
    double there[4] = {1.0, 0.5, 0.5, 0.0}, missing[4] = {0.0, 0.5, 0.5, 1.0}, T_l[4] = {390.0, 373.0, 380.0, 0.0},
           T_v[4] = {0.0, 373.0, 373.0, 373.0}, wet[4];
    struct conduction_channel_side l = {.part = there, .T = T_l}, v = {.part = missing, .T = T_v};
    conduction_channel_wet(4, &l, &v, wet);
    assert_true(wet[0] == 0.0 && wet[1] == 1.0 && wet[2] == 0.0 && wet[3] == 0.0);
    double a[4] = {0.6, 0.6, 0.6, 0.6}, b[4] = {0.025, 0.025, 0.025, 0.025}, no[4] = {0.0, 0.0, 1.0, 1.0},
           yes[4] = {0.0, 1.0, 0.0, 1.0}, k[4], back[4];
    struct conduction_channel_side left = {.k = a}, right = {.k = b};
    conduction_channel_surface(4, &left, &right, no, yes, k);
    conduction_channel_surface(4, &right, &left, yes, no, back);
    const double answers[] = {2.0 * 0.6 * 0.025 / 0.625, 1.2, 0.05, 1.2};
    for (int i = 0; i < 4; i++) assert_true(fabs(k[i] - answers[i]) < 1e-15 && k[i] == back[i]);
}

/* A trace is warmed to no more than its mean with a neighbour, and by no more than its own temperature at once; what
 * sets the time step, and what wants less, is left as it is. */
static void test_bound(void **state)
{
    (void)state;
    double none[5] = {0.0, 0.0, 0.0, 1.0, 0.0}, some[5] = {1.0, 1.0, 1.0, 1.0, 1.0}, c[5] = {3.0, 3.0, 3.0, 3.0, 3.0},
           thin[5] = {1.0, 1.0, 1.0, 1.0, 1.0}, T_l[5] = {400.0, 600.0, 3e5, 3e5, 300.0},
           T_r[5] = {300.0, 300.0, 300.0, 300.0, -2.0}, k[5] = {1e3, 1e3, 1e3, 1e3, 1e3}, low[5], back[5];
    struct conduction_channel_side left = {.sets = none, .c = thin, .T = T_l}, right = {.sets = some, .c = c, .T = T_r};
    memcpy(back, k, sizeof k);
    for (int i = 0; i < 5; i++) low[i] = 1e-3;
    conduction_channel_bound(5, 0.1, &left, &right, k);
    conduction_channel_bound(5, 0.1, &right, &left, back);
    conduction_channel_bound(4, 0.1, &left, &right, low);
    const double answers[] = {0.075, 0.075, 0.075 / 999.0, 1e3, 0.0};
    for (int i = 0; i < 5; i++) assert_true(fabs(k[i] - answers[i]) < 1e-15 && k[i] == back[i]);
    assert_true(low[0] == 1e-3 && low[2] < 1e-3);
}

/* Water on the left, gas on the right, a linear fall of temperature in each: the resistance over a smear of any width
 * is that of one sharp interface. */
static void test_resistance(void **state)
{
    (void)state;
    for (int width = 0; width < 6; width++) {
        double alpha[2][FACES + 1], own[2][FACES], left[2][FACES], right[2][FACES], rest[FACES] = {0}, there[FACES],
                                                                                    back[FACES];
        double cross = 0.0;
        for (int i = 0; i <= FACES; i++) {
            alpha[0][i] = width ? 0.5 - 0.5 * tanh((i - 97.3) / width) : i < 97 ? 1.0 : 0.0;
            alpha[1][i] = 1.0 - alpha[0][i];
        }
        for (int l = 0; l < 2; l++)
            conduction_channel_own(FACES, alpha[l], alpha[l] + 1, own[l], left[l], right[l], rest);
        conduction_channel_cross(FACES, left[0], right[1], rest, there);
        conduction_channel_cross(FACES, left[1], right[0], rest, back);
        for (int i = 0; i < FACES; i++) {
            cross += there[i];
            assert_true(back[i] == 0.0);
        }
        assert_true(fabs(cross - 1.0) < 1e-12);
    }
}

/* Liquid, vapour and the heat between their cells, from the left or from the right: cells of 0, 0, 0.2, 0.7, 0.95 and 1
 * vapour, an onset of 0.9. */
enum { FRONT_CELLS = 6 };
static double front_part[2 * FACE_ROOM], front_T[2 * FACE_ROOM], front_k[2 * FACE_ROOM], front_c[2 * FACE_ROOM];

static double front_side[2][2 * FACE_ROOM]; /* on the left and on the right of the faces */
static double front_last = 380.0;           /* of the liquid in the cell of 0.2 vapour [K] */

static struct scene_phase front_pair = {.onset = 0.9};
static struct scene front_scene;
static struct model front_path = {.scene = &front_scene};

static void front_row(bool mirrored, double T_v, double most, double *k)
{
    static const double vapour[FRONT_CELLS] = {0.0, 0.0, 0.2, 0.7, 0.95, 1.0};
    front_path.n_phase = 1;
    front_scene.n_material = front_path.n_material = 2;
    front_path.phases[0] = (struct model_phase){.n = 2, .member = {0, 1}, .scene = &front_pair};
    for (int j = 0; j < FRONT_CELLS; j++) {
        int i = mirrored ? FRONT_CELLS - 1 - j : j, v = FACE_ROOM + i;
        front_part[i] = 1.0 - vapour[j], front_part[v] = vapour[j];
        front_T[i] = j == 2 ? front_last : 380.0, front_T[v] = T_v;
        front_k[i] = K_WATER * (1.0 + 0.1 * j), front_k[v] = K_AIR;
        front_c[i] = 4e6, front_c[v] = 800.0;
    }
    struct conduction_front *front = conduction_front_new(&front_path);
    assert_true(conduction_front_look(front, &front_path, FRONT_CELLS, front_part));
    conduction_front_weigh(front, &front_path, FRONT_CELLS, front_part, front_c, front_T);
    conduction_front_meet(front, &front_path, FRONT_CELLS - 1, 1, most, front_k, front_c);
    const double *beside[2] = {front_part, front_part + 1};
    conduction_front_turn(front, &front_path, FRONT_CELLS - 1, 1, front_T, beside);
    for (int side = 0; side < 2; side++)
        for (int l = 0; l < 2; l++)
            memcpy(front_side[side] + l * FACE_ROOM, beside[side] + l * FACE_ROOM, (FRONT_CELLS - 1) * sizeof **beside);
    for (int i = 0; i < FRONT_CELLS - 1; i++) k[i] = -1.0;
    conduction_front_take(front, &front_path, 0, 1, FRONT_CELLS - 1, k);
    conduction_front_free(front);
}

/* Beside a third material a trace of liquid is no liquid, however little vapour there is; what has more liquid than
 * vapour is. Fractions of liquid and vapour in three cells, the rest is neither. */
static void test_front_trace(void **state)
{
    (void)state;
    static const double liquid[3] = {1e-7, 0.3, 0.1}, vapour[3] = {0.4, 0.2, 0.2};
    static double part[3 * FACE_ROOM];
    front_scene.n_material = front_path.n_material = 3;
    front_path.n_phase = 1;
    front_path.phases[0] = (struct model_phase){.n = 2, .member = {0, 1}, .scene = &front_pair};
    for (int i = 0; i < 3; i++) {
        part[i] = liquid[i], part[FACE_ROOM + i] = vapour[i];
        part[2 * FACE_ROOM + i] = 1.0 - liquid[i] - vapour[i];
    }
    struct conduction_front *front = conduction_front_new(&front_path);
    assert_true(conduction_front_look(front, &front_path, 3, part));
    assert_true(part[0] == liquid[0] && part[FACE_ROOM] == vapour[0]);
    assert_true(part[1] == liquid[1] + vapour[1] && part[FACE_ROOM + 1] == 0.0);
    assert_true(part[2] == liquid[2] && part[FACE_ROOM + 2] == vapour[2]);
    conduction_front_free(front);
}

/* The last cell of liquid is as far from the surface as its fraction says; behind it heat goes on by what cells hold.
 */
static void test_front(void **state)
{
    (void)state;
    const double most = 1e-3, held[2] = {0.3 * 4e6 + 0.7 * 800.0, 0.05 * 4e6 + 0.95 * 800.0};
    double k[FRONT_CELLS - 1], back[FRONT_CELLS - 1];
    front_row(false, 380.0, most, k);
    front_row(true, 380.0, most, back);
    for (int i = 0; i < FRONT_CELLS - 1; i++) assert_true(k[i] == back[FRONT_CELLS - 2 - i]);
    assert_true(k[0] == -1.0 && k[1] == -1.0 && k[4] == -1.0); /* liquid alone, vapour alone */
    assert_true(fabs(k[2] / (1.2 * K_WATER * (0.7 - 0.2) / (0.5 - 0.2)) - 1.0) < 1e-12);
    assert_true(fabs(k[3] / (0.5 * most * held[0] * held[1] / (held[0] + held[1])) - 1.0) < 1e-12);
    assert_true(front_part[3] == 1.0 && front_part[FACE_ROOM + 3] == 0.0); /* mirrored: the liquid has its cell */
    front_row(false, 380.0, 1e-9, k);
    assert_true(fabs(k[2] / (0.5 * 1e-9 * 4e6) - 1.0) < 1e-12); /* what the step allows */
    front_row(false, 400.0, most, k);
    assert_true(k[2] > 0.0 && k[3] == -1.0); /* a cell whose vapour is warmer is no surface */
}

/* Where the last cell of liquid is colder than the surface, which warms it, the face is one of materials: neither the
 * distance of the surface counts there, nor has the liquid what is in its cell. */
static void test_front_cold(void **state)
{
    (void)state;
    double k[FRONT_CELLS - 1], back[FRONT_CELLS - 1];
    for (int turn = 0; turn < 2; turn++) {
        front_last = turn ? 379.0 : 381.0;
        front_row(true, 380.0, 1e-3, back);
        front_row(false, 380.0, 1e-3, k);
        for (int i = 0; i < FRONT_CELLS - 1; i++) assert_true(k[i] == back[FRONT_CELLS - 2 - i]);
        assert_true((k[2] == -1.0) == (turn == 1) && k[3] > 0.0);
        assert_true(front_side[0][2] == (turn ? 0.8 : 1.0) && front_side[0][FACE_ROOM + 2] == (turn ? 0.2 : 0.0));
        assert_true(front_side[1][2] == front_part[3] && front_side[1][1] == (turn ? 1.0 : 0.8));
    }
    front_last = 380.0;
}

/* A piece that ends before the surface has the same liquid as one that goes on: where a tile ends changes nothing. */
static void test_front_tiles(void **state)
{
    (void)state;
    double k[FRONT_CELLS - 1];
    front_row(false, 380.0, 1e-3, k); /* makes front_path and the cells */
    for (int i = 0; i < FRONT_CELLS; i++) front_part[i] = i < 3 ? 1.0 - 0.1 * i : 1.0 - 0.2 * i;
    for (int i = 0; i < FRONT_CELLS; i++) front_part[FACE_ROOM + i] = 1.0 - front_part[i];
    struct conduction_front *front = conduction_front_new(&front_path);
    assert_true(conduction_front_look(front, &front_path, 3, front_part)); /* no vapour, 0.1, 0.2 */
    for (int i = 0; i < 3; i++) assert_true(front_part[i] == 1.0 && front_part[FACE_ROOM + i] == 0.0);
    assert_false(conduction_front_look(front, &front_path, 1, front_part)); /* liquid alone */
    conduction_front_free(front);
}

/* Half a cell of each in series. */
static void test_series(void **state)
{
    (void)state;
    double water = K_WATER, air = K_AIR, none = 0.0, k;
    const struct conduction_channel_side left = {.k = &water}, right = {.k = &air}, nothing = {.k = &none};
    conduction_channel_series(1, &left, &right, &k);
    assert_true(fabs(k * (0.5 / K_WATER + 0.5 / K_AIR) - 1.0) < 1e-14);
    conduction_channel_series(1, &left, &nothing, &k);
    assert_true(k == 0.0);
    conduction_channel_series(1, &nothing, &nothing, &k);
    assert_true(k == 0.0);
}

/* Little of a cell, or of its mass, does not set the time step, and is bounded. */
static void test_light(void **state)
{
    (void)state;
    const double part[] = {0.5, 0.005, 0.03, 1.0, 0.0}, rho_l[] = {1.2, 1.2, 1e-3, 1e-3, 1.2},
                 rho[] = {500.0, 1000.0, 970.0, 1e-3, 1000.0}, c[] = {1.0, 1.0, 1.0, 1.0, 1.0},
                 T[] = {300.0, 300.0, 300.0, 300.0, 300.0};
    double sets[5], k[] = {9.0, 9.0, 9.0, 9.0, 9.0};
    heed_parts(5, part, rho_l, rho, sets);
    assert_true(sets[0] == 0.5 && sets[1] == 0.0 && sets[2] == 0.0 && sets[3] == 1.0 && sets[4] == 0.0);
    const struct conduction_channel_side side = {.part = part, .sets = sets, .T = T, .c = c};
    conduction_channel_bound(5, 2.0, &side, &side, k);
    assert_true(k[0] == 9.0 && k[1] == 1.0 && k[2] == 1.0 && k[3] == 9.0);
}

/* --- mixed cells --- */

static double jump_water, jump_air; /* in the left half [K] */

static void set_halves(const struct model *model, const double x[3], double *w)
{
    w[model->i_alpha] = w[model->i_alpha + 1] = 0.5;
    w[model->i_m] = rho_water(300.0 + (x[0] < 0.5e-6 * 8 ? jump_water : 0.0));
    w[model->i_m + 1] = rho_air(300.0 + (x[0] < 0.5e-6 * 8 ? jump_air : 0.0));
    w[model->i_E] = P;
}

/* Pressure of the cell beside the middle that gets heat, over what heat in one material makes of it. */
static double rise(double hot_water, double hot_air, double k, double per_heat)
{
    struct flow flow;
    const double h = 1e-6, dt = 1e-10;
    jump_water = hot_water;
    jump_air = hot_air;
    start(&flow, "lower: [0], upper: [8 um], cells: [8], boundaries: {x-: reflecting, x+: reflecting}", "", WATER AIR,
          "dt: 0.1 ns");
    flow_set(&flow, set_halves);
    double *before = flow_primitive(&flow, flow.state->model->i_E);
    flow_steps(&flow, 1);
    double *p = flow_primitive(&flow, flow.state->model->i_E), got = p[4] - before[4];
    double heat = 0.5 * k * (hot_water + hot_air) / (h * h) * dt;
    print_message("%g J/m3: pressure rises by %.6g Pa, should by %.6g\n", heat, got, per_heat * heat);
    mem_free(before);
    mem_free(p);
    flow_stop(&flow);
    return got / (per_heat * heat);
}

/* Half water, half air, heat in one of them: reference/transport/mixed_cell_heating.csv. With frozen fractions it would
 * be 0.716 Pa per J/m3 in both. */
static void test_mixed_cell(void **state)
{
    (void)state;
    assert_true(fabs(rise(1.0, 0.0, K_WATER, 0.000365302771606) - 1.0) < 0.01);
    assert_true(fabs(rise(0.0, 10.0, K_AIR, 0.799957023203) - 1.0) < 0.01);
}

/* --- conservation, symmetry --- */

static double middle = 4e-6;

static void set_blob(const struct model *model, const double x[3], double *w)
{
    double y = model->dim > 1 ? x[1] : middle, r = hypot(x[0] - middle, y - middle);
    double gas = 0.5 - 0.5 * tanh((r - 2.2e-6) / 0.4e-6);
    w[model->i_alpha] = 1.0 - gas;
    w[model->i_alpha + 1] = gas;
    w[model->i_m] = rho_water(300.0);
    w[model->i_m + 1] = rho_air(500.0);
    w[model->i_E] = P;
}

static void check_conserved(const char *domain, const char *mesh)
{
    struct flow flow;
    double size;
    start(&flow, domain, mesh, WATER AIR, "cfl: 0.4");
    if (flow.state->mesh->n_level == 1) flow_set(&flow, set_blob);
    unsigned E = flow.state->model->i_E, m = flow.state->model->i_m;
    long double energy = flow_total(&flow, E, &size), air = flow_total(&flow, m + 1, &size);
    flow_steps(&flow, 40);
    long double drift = flow_total(&flow, E, &size) - energy;
    print_message("%s: drift %.3Lg\n", domain, drift / size);
    assert_true(fabs((double)drift) < 1e-13 * size);
    drift = flow_total(&flow, m + 1, &size) - air;
    assert_true(fabs((double)drift) < 1e-12 * size);
    flow_stop(&flow);
}

static void test_conserved(void **state)
{
    (void)state;
    check_conserved("lower: [0], upper: [8 um], cells: [64], boundaries: {x-: reflecting, x+: no-slip}", "");
    check_conserved("geometry: spherical, lower: [0], upper: [8 um], cells: [64], boundaries: {x+: reflecting}", "");
    check_conserved("geometry: axisymmetric, lower: [0, 0], upper: [8 um, 8 um], cells: [32, 32], "
                    "boundaries: {x+: reflecting, y-: symmetry, y+: reflecting}",
                    "");
    check_conserved("lower: [0, 0], upper: [8 um, 8 um], cells: [32, 32], boundaries: {x-: reflecting, x+: reflecting, "
                    "y-: periodic, y+: periodic}",
                    "");
}

/* A round hot bubble in a square: all eight symmetries stay, to the bit. */
static void test_symmetry(void **state)
{
    (void)state;
    struct flow flow;
    enum { N = 32 };
    middle = 0.0; /* and sides of 2^-16 m: centres that mirror to the bit */
    start(&flow,
          "lower: [-7.62939453125e-6, -7.62939453125e-6], upper: [7.62939453125e-6, 7.62939453125e-6], "
          "cells: [32, 32], boundaries: {x-: outflow, x+: outflow, y-: outflow, y+: outflow}",
          "mesh: {tile: 8}\n", WATER AIR, "cfl: 0.4");
    flow_set(&flow, set_blob);
    flow_steps(&flow, 20);
    unsigned rows[] = {0, 1, 2, 3, flow.state->model->i_E};
    for (size_t q = 0; q < sizeof rows / sizeof *rows; q++) {
        double *w = flow_primitive(&flow, rows[q]);
        for (int j = 0; j < N; j++)
            for (int i = 0; i < N; i++) {
                double here = w[j * N + i];
                assert_true(here == w[j * N + N - 1 - i]);
                assert_true(here == w[(N - 1 - j) * N + i]);
                assert_true(here == w[i * N + j]);
            }
        mem_free(w);
    }
    flow_stop(&flow);
}

/* --- traces --- */

static double trace;

static void set_traced(const struct model *model, const double x[3], double *w)
{
    double gas = fabs(x[0] - 4e-6) < 1e-6 ? 1.0 : trace;
    w[model->i_alpha] = 1.0 - gas;
    w[model->i_alpha + 1] = gas;
    w[model->i_m] = rho_water(300.0);
    w[model->i_m + 1] = rho_air(gas == 1.0 ? 300.0 : 1e5);
    w[model->i_E] = P;
}

/* A millionth of gas at 1e5 K in the water around a bubble of 300 K. */
static void test_traces(void **state)
{
    (void)state;
    double dt[2], T[2];
    for (int k = 0; k < 2; k++) {
        struct flow flow;
        double size;
        trace = k ? 1e-6 : 0.0;
        start(&flow, "lower: [0], upper: [8 um], cells: [64], boundaries: {x-: reflecting, x+: reflecting}", "",
              WATER AIR, "cfl: 0.4");
        flow_set(&flow, set_traced);
        long double before = flow_total(&flow, flow.state->model->i_E, &size);
        flow_steps(&flow, 200);
        dt[k] = flow.state->t / 200;
        long double drift = flow_total(&flow, flow.state->model->i_E, &size) - before;
        assert_true(fabs((double)drift) < 1e-13 * size);
        double *t = flow_derived(&flow, "temperature_water", 0);
        T[k] = t[2];
        mem_free(t);
        flow_stop(&flow);
    }
    print_message("steps %.4g s without, %.4g s with traces; water %.9g, %.9g K\n", dt[0], dt[1], T[0], T[1]);
    assert_true(dt[1] >= 0.9 * dt[0]);
    assert_true(fabs(T[1] - T[0]) < 1e-2);
}

/* Gas so thin that it would conduct a thousand times more in a step than it holds: bounded where it is a trace. */
static void set_void(const struct model *model, const double x[3], double *w)
{
    double gas = 1e-4 + 4e-3 * (x[0] > 3e-6 && x[0] < 5e-6);
    w[model->i_alpha] = 1.0 - gas;
    w[model->i_alpha + 1] = gas;
    w[model->i_m] = rho_water(300.0);
    w[model->i_m + 1] = rho_air(3e6);
    w[model->i_E] = P;
}

static void test_void(void **state)
{
    (void)state;
    struct flow flow;
    start(&flow, "lower: [0], upper: [8 um], cells: [256], boundaries: {x-: reflecting, x+: reflecting}", "", WATER AIR,
          "cfl: 0.4");
    flow_set(&flow, set_void);
    flow_steps(&flow, 100);
    double *rho = flow_primitive(&flow, flow.state->model->i_m + 1), *p = flow_primitive(&flow, flow.state->model->i_E);
    for (size_t c = 0; c < flow.n_cell; c++) {
        double T = p[c] / (0.4 * CV_AIR * rho[c]);
        assert_true(T > 290.0 && T < 3.01e6);
        assert_true(p[c] > 100.0 && p[c] < 1.01 * P);
    }
    mem_free(rho);
    mem_free(p);
    flow_stop(&flow);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_channels_fill_the_face),
        cmocka_unit_test(test_surface),
        cmocka_unit_test(test_bound),
        cmocka_unit_test(test_resistance),
        cmocka_unit_test(test_front),
        cmocka_unit_test(test_front_trace),
        cmocka_unit_test(test_front_cold),
        cmocka_unit_test(test_front_tiles),
        cmocka_unit_test(test_series),
        cmocka_unit_test(test_light),
        cmocka_unit_test(test_mixed_cell),
        cmocka_unit_test(test_conserved),
        cmocka_unit_test(test_symmetry),
        cmocka_unit_test(test_traces),
        cmocka_unit_test(test_void),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
