/* The initial state: exact totals, pure cells, averages of profiles, overlays, Lua, symmetry, and messages. */
#include "paint/paint.h"

#include "base/mem.h"
#include "base/status.h"
#include "case/scene_read.h"
#include "mesh/metric.h"
#include "phys/mix.h"
#include "phys/model.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include <cmocka.h>

/* A scene painted as a whole: u[field][cell], cells x fastest. */
struct canvas {
    struct scene *scene;
    struct model *model;
    struct mesh *mesh;
    size_t n_cell;
    double *u, *volume;
};

static char path[] = "/tmp/bulla-paint-XXXXXX.yaml";

static int make_file(void **state)
{
    (void)state;
    int file = mkstemps(path, 5);
    return file < 0 ? 1 : close(file);
}

static int drop_file(void **state)
{
    (void)state;
    return unlink(path);
}

static size_t place_of(const struct mesh *mesh, const struct level *level, const struct tile *tile, size_t c)
{
    size_t index = 0, step = 1, rest = c;
    for (int d = 0; d < 3; d++) {
        size_t n = (size_t)mesh->n[d];
        index += ((size_t)tile->at[d] * n + rest % n) * step;
        rest /= n;
        step *= n * (size_t)level->extent[d];
    }
    return index;
}

static int paint_all(struct canvas *canvas)
{
    const struct mesh *mesh = canvas->mesh;
    const struct level *level = &mesh->levels[0];
    double *volume = mem_new(mesh->n_cell, sizeof *volume);
    int code = STATUS_OK;
    for (unsigned t = 0; t < level->n_tile && !code; t++) {
        code = paint_tile(canvas->model, mesh, level, &level->tiles[t], level->u_old[t]);
        metric_volumes(mesh, level, &level->tiles[t], volume);
        for (size_t c = 0; c < mesh->n_cell; c++) {
            size_t place = place_of(mesh, level, &level->tiles[t], c);
            canvas->volume[place] = volume[c];
            for (unsigned q = 0; q < canvas->model->n_field; q++)
                canvas->u[q * canvas->n_cell + place] = level->u_old[t][q * mesh->n_cell + c];
        }
    }
    mem_free(volume);
    return code;
}

static void canvas_done(struct canvas *canvas)
{
    mem_free(canvas->u);
    mem_free(canvas->volume);
    mesh_free(canvas->mesh);
    model_free(canvas->model);
    scene_free(canvas->scene);
}

/* `domain`, `initial`: YAML; two materials, or water alone if `alone`. */
static int paint_scene(const char *domain, const char *initial, bool alone, struct canvas *canvas)
{
    FILE *file = fopen(path, "w");
    fprintf(file, "bulla: 1\ntitle: paint\n%s\nmaterials:\n", domain);
    fprintf(file, "  water: {eos: {type: stiffened-gas, gamma: 4.4, p-inf: 600 MPa}}\n");
    if (!alone) fprintf(file, "  air: {eos: {type: ideal-gas, gamma: 1.4}}\n");
    fprintf(file, "initial:\n%srun: {until: 1 us}\n", initial);
    fclose(file);
    *canvas = (struct canvas){0};
    if (scene_read(path, NULL, &canvas->scene)) fail_msg("%s", status_text());
    canvas->model = model_new(canvas->scene);
    if (mesh_new(canvas->scene, canvas->model->n_field, canvas->model->n_alpha, &canvas->mesh))
        fail_msg("%s", status_text());
    canvas->n_cell = 1;
    for (int d = 0; d < canvas->scene->domain.dim; d++) canvas->n_cell *= (size_t)canvas->scene->domain.cells[d];
    canvas->u = mem_new(canvas->n_cell * canvas->model->n_field, sizeof *canvas->u);
    canvas->volume = mem_new(canvas->n_cell, sizeof *canvas->volume);
    return paint_all(canvas);
}

static struct canvas good(const char *domain, const char *initial, bool alone)
{
    struct canvas canvas;
    if (paint_scene(domain, initial, alone, &canvas)) fail_msg("%s", status_text());
    return canvas;
}

static const double *field(const struct canvas *canvas, unsigned q)
{
    return canvas->u + q * canvas->n_cell;
}

static double total(const struct canvas *canvas, unsigned q)
{
    double sum = 0.0;
    for (size_t c = 0; c < canvas->n_cell; c++) sum += field(canvas, q)[c] * canvas->volume[c];
    return sum;
}

static void near(double value, double exact, double relative)
{
    if (!(fabs(value - exact) <= relative * fabs(exact)))
        fail_msg("%.17g, wanted %.17g: relative error %.3g", value, exact, value / exact - 1.0);
}

static const char BUBBLE[] =
    "  - {everywhere: true, material: water, density: 998.2, pressure: 101325}\n"
    "  - {sphere: {center: [0, 0.1], radius: 0.37}, material: air, density: 1.225, pressure: 101325}\n";
static const char TURNED[] =
    "domain: {geometry: axisymmetric, lower: [0, -1], upper: [1, 1], cells: [32, 64], boundaries: "
    "{x-: axis, x+: outflow, y-: outflow, y+: outflow}}\nmesh: {tile: 8}";
static const char LINE[] =
    "domain: {lower: [-1], upper: [1], cells: [32], boundaries: {x-: outflow, x+: outflow}}\nmesh: {tile: 8}";
static const char RADIAL[] =
    "domain: {geometry: spherical, lower: [0], upper: [2], cells: [32], boundaries: {x-: symmetry, x+: outflow}}";
static const char PLANE[] =
    "domain: {lower: [-1, -1], upper: [1, 1], cells: [48, 48], boundaries: {x-: outflow, x+: outflow, "
    "y-: outflow, y+: outflow}}\nmesh: {tile: 16}";

static void paints_a_bubble(void **state)
{
    (void)state;
    struct canvas canvas = good(TURNED, BUBBLE, false);
    unsigned water = canvas.model->i_alpha, air = water + 1, m_water = canvas.model->i_m, m_air = m_water + 1;
    near(total(&canvas, m_air), 1.225 * 4.0 / 3.0 * M_PI * 0.37 * 0.37 * 0.37, 1e-12);
    near(total(&canvas, air), 4.0 / 3.0 * M_PI * 0.37 * 0.37 * 0.37, 1e-12);
    near(total(&canvas, m_water), 998.2 * (2.0 * M_PI - 4.0 / 3.0 * M_PI * 0.37 * 0.37 * 0.37), 1e-12);
    unsigned pure = 0, mixed = 0;
    double *w = mem_new(canvas.n_cell * canvas.model->n_field, sizeof *w);
    mix_primitives(canvas.model, canvas.n_cell, canvas.n_cell, canvas.u, w);
    for (size_t c = 0; c < canvas.n_cell; c++) {
        double a = field(&canvas, water)[c], b = field(&canvas, air)[c];
        if (a == 1.0) assert_true(b == 0.0 && field(&canvas, m_air)[c] == 0.0 && field(&canvas, m_water)[c] == 998.2);
        if (b == 1.0) assert_true(a == 0.0 && field(&canvas, m_water)[c] == 0.0 && field(&canvas, m_air)[c] == 1.225);
        assert_true(fabs(a + b - 1.0) < 4e-16);
        if (a == 1.0 || b == 1.0) pure++;
        else mixed++;
        near(w[canvas.model->i_E * canvas.n_cell + c], 101325.0, 2e-7); /* round-off of p_inf = 6e8 */
        assert_true(field(&canvas, canvas.model->i_u)[c] == 0.0);
    }
    mem_free(w);
    assert_true(mixed > 20 && mixed < 120 && pure + mixed == 2048);
    canvas_done(&canvas);
}

/* A fast body in a gas at the same pressure: the cells that its surface cuts are as warm as the rest. */
static void moving_bodies_stay_cold(void **state)
{
    (void)state;
    struct canvas canvas = good(
        PLANE,
        "  - {everywhere: true, material: air, density: 1.2, pressure: 1 bar, velocity: [0, -20]}\n"
        "  - {sphere: {center: [0.1, 0], radius: 0.43}, material: water, density: 1000, pressure: 1 bar, velocity: "
        "[500, 30]}\n",
        false);
    double *w = mem_new(canvas.model->n_field * canvas.n_cell, sizeof *w);
    unsigned mixed = 0;
    mix_primitives(canvas.model, canvas.n_cell, canvas.n_cell, canvas.u, w);
    for (size_t c = 0; c < canvas.n_cell; c++) {
        mixed += field(&canvas, 0)[c] > 0.0 && field(&canvas, 0)[c] < 1.0;
        near(w[canvas.model->i_E * canvas.n_cell + c], 1e5, 1e-6);
    }
    assert_true(mixed > 40);
    mem_free(w);
    canvas_done(&canvas);
}

static void same_for_all_tiles(void **state)
{
    (void)state;
    struct canvas a = good(TURNED, BUBBLE, false);
    char domain[400];
    snprintf(domain, sizeof domain, "%.*s32}", (int)(strstr(TURNED, "8}") - TURNED), TURNED);
    struct canvas b = good(domain, BUBBLE, false);
    assert_int_equal(b.mesh->n[0], 32);
    assert_memory_equal(a.u, b.u, a.n_cell * a.model->n_field * sizeof *a.u);
    canvas_done(&a);
    canvas_done(&b);
}

/* p = pf + (R0/r)(pb - pf) outside of a bubble, in spherical geometry: averages with the weight r^2. */
static void averages_profiles(void **state)
{
    (void)state;
    struct canvas canvas =
        good(RADIAL,
             "  - {everywhere: true, material: water, density: 998.2, pressure: '= 2e6 + 0.5 / r * (1e5 - 2e6)'}\n"
             "  - {sphere: {center: [0], radius: 0.5}, material: air, density: 1.225, pressure: 100 kPa}\n",
             false);
    unsigned E = canvas.model->i_E;
    double h = 2.0 / 32;
    for (int i = 8; i < 32; i++) {
        double a = i * h, b = a + h, volume = (b * b * b - a * a * a) / 3.0;
        double p = 2e6 + 0.5 * (1e5 - 2e6) * (b * b - a * a) / 2.0 / volume;
        near(field(&canvas, E)[i], (p + 4.4 * 6e8) / 3.4, 1e-13);
        assert_true(field(&canvas, canvas.model->i_m)[i] == 998.2 ||
                    fabs(field(&canvas, canvas.model->i_m)[i] - 998.2) < 1e-12);
    }
    for (int i = 0; i < 8; i++) near(field(&canvas, E)[i], 1e5 / 0.4, 1e-15);
    canvas_done(&canvas);
    canvas = good(LINE,
                  "  - {everywhere: true, material: water, density: '= 1000 + 100 * x + 30 * x^2', pressure: 1 bar, "
                  "velocity: ['= x']}\n",
                  true);
    h = 2.0 / 32;
    for (int i = 0; i < 32; i++) {
        double a = -1.0 + i * h, b = a + h;
        double rho = 1000 + 50 * (a + b) + 10 * (a * a + a * b + b * b);
        double square = (b * b + a * b + a * a) / 3.0, fourth = (pow(b, 5) - pow(a, 5)) / 5.0 / h;
        double momentum = 1000 * (a + b) / 2.0 + 100 * square + 30 * (pow(b, 4) - pow(a, 4)) / 4.0 / h;
        double kinetic = 0.5 * (1000 * square + 25 * (pow(b, 4) - pow(a, 4)) / h + 30 * fourth);
        near(field(&canvas, 0)[i], rho, 1e-14);
        assert_true(fabs(field(&canvas, 1)[i] - momentum) < 1e-10);
        near(field(&canvas, 2)[i], (1e5 + 4.4 * 6e8) / 3.4 + kinetic, 1e-14);
    }
    canvas_done(&canvas);
}

/* A cut cell of a profile takes its points from the part inside: no singular value from outside comes in. */
static void averages_the_part_inside(void **state)
{
    (void)state;
    struct canvas canvas = good(LINE,
                                "  - {everywhere: true, material: water, density: 1000, pressure: 1 bar}\n"
                                "  - {half-space: {normal: [1], point: [0.03]}, material: water, pressure: 1 bar, "
                                "density: '= x > 0.03 and 500 or 1e9'}\n",
                                true);
    double inside = 0.0625 - 0.03;
    near(field(&canvas, 0)[16], (500 * inside + 1000 * 0.03) / 0.0625, 1e-12);
    assert_true(field(&canvas, 0)[15] == 1000.0 && fabs(field(&canvas, 0)[17] - 500.0) < 1e-10);
    canvas_done(&canvas);
}

static void overlays(void **state)
{
    (void)state;
    char initial[600];
    snprintf(initial, sizeof initial,
             "%s  - {box: {lower: [0, -0.5], upper: [0.5, 1]}, pressure: 5 bar, velocity: [0, 3]}\n"
             "  - {box: {lower: [0, -0.5], upper: [0.5, 1]}, velocity: ['= 2 * y', 3]}\n",
             BUBBLE);
    struct canvas canvas = good(TURNED, initial, false), plain = good(TURNED, BUBBLE, false);
    double *w = mem_new(canvas.n_cell * canvas.model->n_field, sizeof *w);
    mix_primitives(canvas.model, canvas.n_cell, canvas.n_cell, canvas.u, w);
    for (size_t c = 0; c < canvas.n_cell; c++) {
        bool changed = c % 32 < 16 && c / 32 >= 16;
        double y = -1.0 + (double)(c / 32) / 32.0 + 1.0 / 64.0;
        for (unsigned q = 0; q < 4; q++) /* alpha and m */
            if (fabs(field(&canvas, q)[c] - field(&plain, q)[c]) > 1e-12) fail_msg("field %u of cell %zu", q, c);
        near(w[canvas.model->i_E * canvas.n_cell + c], changed ? 5e5 : 101325.0, 3e-3);
        near(w[(canvas.model->i_u + 1) * canvas.n_cell + c], changed ? 3.0 : 0.0, 1e-12);
        if (changed) assert_true(fabs(w[canvas.model->i_u * canvas.n_cell + c] - 2.0 * y) < 1e-12);
    }
    mem_free(w);
    canvas_done(&canvas);
    canvas_done(&plain);
}

static void listens_to_lua(void **state)
{
    (void)state;
    struct canvas canvas =
        good(LINE,
             "  - lua: |\n      return function(x, y, z)\n        local a = x < 0 and 1 or 0.25\n"
             "        return {pressure = 2e5, alpha = {water = a}, density = {water = 1000, air = 1.2}, velocity = "
             "{7}}\n      end\n"
             "  - {half-space: {normal: [-1], point: [-0.5]}, lua: 'function(x) return {velocity_x = -4} end'}\n"
             "  - {half-space: {normal: [1], point: [0.5]}, lua: 'function(x) return {alpha_air = 1, temperature = "
             "300} end'}\n",
             false);
    near(field(&canvas, 2)[10], 1000.0, 1e-15);
    assert_true(field(&canvas, 0)[10] == 1.0 && field(&canvas, 1)[10] == 0.0 && field(&canvas, 3)[10] == 0.0);
    near(field(&canvas, 4)[10], 7000.0, 1e-14);
    near(field(&canvas, 0)[20], 0.25, 1e-15);
    near(field(&canvas, 1)[20], 0.75, 1e-15);
    near(field(&canvas, 3)[20], 0.9, 1e-15);
    near(field(&canvas, 5)[20], 0.25 * (2e5 + 4.4 * 6e8) / 3.4 + 0.75 * 2e5 / 0.4 + 0.5 * 250.9 * 49.0, 1e-14);
    near(field(&canvas, 4)[2], -4000.0, 1e-14);
    assert_true(field(&canvas, 0)[30] == 0.0 && field(&canvas, 1)[30] == 1.0 && field(&canvas, 2)[30] == 0.0);
    double p = 2e5, T = 300.0, rho;
    canvas.model->eos[1].law->density(canvas.model->eos[1].self, 1, &p, &T, &rho);
    near(field(&canvas, 3)[30], rho, 1e-6);
    near(field(&canvas, 4)[30], 7.0 * rho, 1e-6);
    canvas_done(&canvas);
}

static void takes_temperatures_and_fractions(void **state)
{
    (void)state;
    struct canvas canvas =
        good(LINE, "  - {everywhere: true, fractions: {water: 0.4, air: 0.6}, temperature: 310 K, pressure: 3 bar}\n",
             false);
    double p = 3e5, T = 310.0, rho[2];
    for (int l = 0; l < 2; l++) canvas.model->eos[l].law->density(canvas.model->eos[l].self, 1, &p, &T, rho + l);
    assert_true(field(&canvas, 0)[5] == 0.4 && field(&canvas, 1)[5] == 0.6);
    assert_true(field(&canvas, 2)[5] == 0.4 * rho[0] && field(&canvas, 3)[5] == 0.6 * rho[1]);
    canvas_done(&canvas);
}

/* Density and temperature: the pressure is the law's, in YAML, in Lua and where they vary. */
static void takes_densities_with_temperatures(void **state)
{
    (void)state;
    struct canvas canvas =
        good(LINE,
             "  - {everywhere: true, material: air, density: 1.5, temperature: 310 K}\n"
             "  - {half-space: {normal: [-1], point: [-0.5]}, lua: 'function(x) return {alpha = {water = 1}, density = "
             "1010, temperature = 300} end'}\n"
             "  - {half-space: {normal: [1], point: [0.5]}, material: air, density: 2, temperature: '= 300 + x'}\n",
             false);
    double *w = mem_new(canvas.model->n_field * canvas.n_cell, sizeof *w), T[2];
    mix_primitives(canvas.model, canvas.n_cell, canvas.n_cell, canvas.u, w);
    const double *p = w + canvas.model->i_E * canvas.n_cell;
    near(p[20], 1.5 * 0.4 * 717.5 * 310.0, 1e-12);
    const struct model_eos *water = &canvas.model->eos[0], *air = &canvas.model->eos[1];
    double rho = 1010.0;
    water->law->temperature(water->self, 1, &rho, &p[2], &T[0]);
    near(T[0], 300.0, 1e-10);
    rho = 2.0;
    air->law->temperature(air->self, 2, (double[]){rho, rho}, &p[30], T);
    assert_true(T[0] > 300.5 && T[1] > T[0] && T[1] < 301.0);
    mem_free(w);
    canvas_done(&canvas);
}

static void mirrors_to_the_bit(void **state)
{
    (void)state;
    struct canvas canvas = good(
        PLANE,
        "  - {everywhere: true, material: water, density: '= 1000 + math.exp(-4 * (x*x + y*y))', pressure: 1 bar}\n"
        "  - {sphere: {center: [0, 0], radius: 0.53}, material: air, density: '= 1.2 + r', pressure: '= 1e5 * (1 + "
        "x*x*y*y)'}\n"
        "  - {ring: {center: [0, 0], outer: 0.9, inner: 0.4}, velocity: ['= x', '= y']}\n",
        false);
    for (unsigned q = 0; q < canvas.model->n_field; q++)
        for (size_t c = 0; c < canvas.n_cell; c++) {
            size_t i = c % 48, j = c / 48, left = j * 48 + 47 - i, down = (47 - j) * 48 + i;
            double v = field(&canvas, q)[c], l = field(&canvas, q)[left], d = field(&canvas, q)[down];
            if (q == canvas.model->i_u) l = -l;
            if (q == canvas.model->i_u + 1) d = -d;
            if (v != l || v != d) fail_msg("field %u, cell %zu %zu: %.17g %.17g %.17g", q, i, j, v, l, d);
        }
    canvas_done(&canvas);
}

static void says_what_is_wrong(void **state)
{
    (void)state;
    static const char *const wrong[][2] = {
        {"{everywhere: true, material: water, density: '= x', pressure: 1e5}", "the density of water is -0.99"},
        {"{everywhere: true, material: water, density: 1000, pressure: '= -7e8 + 0 * x'}",
         "the pressure is -700000000 Pa; water at 1000 kg/m3 exists above -600000000 Pa only"},
        {"{everywhere: true, material: water, density: '= 1 / (x - x)', pressure: 1e5}", "the script gives"},
        {"{everywhere: true, material: water, temperature: '= -1 + 0 * x', pressure: 1e5}",
         "the temperature is -1 K, not above 0"},
        {"{lua: 'function(x) return {alpha = {water = 1}, density = 1000, temperature = 300, pressure = 1e5} end'}",
         "two of pressure, density and temperature make a state, not all three"},
        {"{lua: 'function(x) return {alpha = {water = 0.5}, density = {water = 1000}, temperature = 300} end'}",
         "density and temperature give the pressure of one material, not of a mixture"},
        {"{everywhere: true, material: air, density: 1.2, temperature: '= 1e20 + 0 * x'}",
         "air has no state at 1.2 kg/m3 and 1e+20 K"},
        {"{lua: 'function(x) return {pressure = 1e5, alpha = {water = 0.5, air = 0.6}} end'}",
         "the volume fractions add up to 1.1, not to 1"},
        {"{lua: 'function(x) return {pressure = 1e5, alpha = {water = -0.5}} end'}",
         "the volume fraction of water is -0.5, not between 0 and 1"},
        {"{lua: 'function(x) return {pressure = 1e5} end'}", "it does not say which material is there"},
        {"{lua: 'function(x) return {alpha = {water = 1}, density = 1} end'}", "the pressure is missing"},
        {"{lua: 'function(x) return {alpha = {water = 1}, pressure = 1} end'}", "the density of water is missing"},
        {"{lua: 'function(x) return {alpha = {water = 0.5}, density = 4, pressure = 1} end'}",
         "more than one material is there"},
        {"{lua: 'function(x) return {alpha = {water = 1}, density = 4, pressure = 1, velocity = {0, 2}} end'}",
         "velocity_y is 2 m/s, but velocities have 1 component here"},
        {"{lua: 'function(x) return {presure = 4} end'}", "did you mean 'pressure'"},
        {"{lua: 'function(x) return x.y.z end'}", "attempt to index a number value"},
    };
    for (size_t i = 0; i < sizeof wrong / sizeof *wrong; i++) {
        char initial[400];
        struct canvas canvas;
        snprintf(initial, sizeof initial, "  - %s\n", wrong[i][0]);
        assert_int_equal(paint_scene(LINE, initial, false, &canvas), STATUS_CASE);
        if (!strstr(status_text(), wrong[i][1]) || !strstr(status_text(), "bulla-paint-"))
            fail_msg("'%s', wanted '%s'", status_text(), wrong[i][1]);
        canvas_done(&canvas);
    }
    struct canvas canvas;
    assert_int_equal(paint_scene(LINE, "  - {everywhere: true, lua: 'function(x) return {} end'}\n", false, &canvas),
                     STATUS_CASE);
    assert_non_null(strstr(status_text(), ":9: layer 1 of initial, at (-0.99"));
    canvas_done(&canvas);
}

static void wants_every_cell_covered(void **state)
{
    (void)state;
    struct canvas canvas;
    char initial[] =
        "  - {half-space: {normal: [1], point: [-0.99995]}, material: water, density: 1000, pressure: 1e5}\n";
    assert_int_equal(paint_scene(LINE, initial, false, &canvas), STATUS_CASE);
    assert_non_null(strstr(status_text(), "the layers give no whole state to the cell at (-0.96875)"));
    canvas_done(&canvas);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(paints_a_bubble),
        cmocka_unit_test(moving_bodies_stay_cold),
        cmocka_unit_test(same_for_all_tiles),
        cmocka_unit_test(averages_profiles),
        cmocka_unit_test(averages_the_part_inside),
        cmocka_unit_test(overlays),
        cmocka_unit_test(listens_to_lua),
        cmocka_unit_test(takes_temperatures_and_fractions),
        cmocka_unit_test(takes_densities_with_temperatures),
        cmocka_unit_test(mirrors_to_the_bit),
        cmocka_unit_test(says_what_is_wrong),
        cmocka_unit_test(wants_every_cell_covered),
    };
    return cmocka_run_group_tests(tests, make_file, drop_file);
}
