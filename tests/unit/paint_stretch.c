/* Painted solids: the stretch is what the layers say, unimodular, the solid's own in cut cells (where the pressure
 * stays as said), the identity in fluids; and what is no stretch is refused where it is met. */
#include "paint/paint_stretch.h"

#include "case/scene_read.h"
#include "phys/elastic.h"
#include "phys/mix.h"
#include "small.h"

#include <math.h>

#define LAWS                                                                                            \
    "materials:\n"                                                                                      \
    "  gel: {eos: {type: stiffened-gas, gamma: 4.4, p-inf: 600 MPa}, constitutive: {type: neo-hookean," \
    " shear-modulus: 1 MPa, reference-density: 1000}}\n"                                                \
    "  air: {eos: {type: ideal-gas, gamma: 1.4}}\n"
#define PLANE                                                                                     \
    "bulla: 1\ndomain: {lower: [0, 0], upper: [1, 1], cells: [16, 16], boundaries: {x-: outflow," \
    " x+: outflow, y-: outflow, y+: outflow}}\nscheme: {traction: pressure}\nrun: {until: 1}\n" LAWS
#define LINE                                                                                                    \
    "bulla: 1\ndomain: {lower: [0], upper: [1], cells: [16], velocity-components: 3, boundaries: {x-: outflow," \
    " x+: outflow}}\nrun: {until: 1}\n" LAWS
#define BALL                                                                                                    \
    "bulla: 1\ndomain: {geometry: spherical, lower: [0], upper: [1], cells: [16], boundaries: {x+: outflow}}\n" \
    "run: {until: 1}\n" LAWS
#define GEL "material: gel, density: 1000, pressure: 1e5"
#define AIR "material: air, density: 1, pressure: 1e5"

static double field(const struct small *small, unsigned q, size_t cell)
{
    const struct mesh *mesh = small->state->mesh;
    return mesh->levels[0].u_old[cell / mesh->n_cell][q * mesh->n_cell + cell % mesh->n_cell];
}

/* Stretch of a cell, components in the order of elastic.h. */
static void stretch_at(const struct small *small, size_t cell, double V[6])
{
    const struct model *model = small->state->model;
    for (unsigned c = 0; c < 6; c++) V[c] = c < model->n_stretch ? field(small, model->i_V + c, cell) : 0.0;
}

static double pressure_at(const struct small *small, size_t cell)
{
    const struct model *model = small->state->model;
    double u[MODEL_FIELDS], w[MODEL_FIELDS] = {0};
    for (unsigned q = 0; q < model->n_field; q++) u[q] = field(small, q, cell);
    mix_primitives(model, 1, 1, u, w);
    return w[model->i_E];
}

static void near(double value, double wanted, double error)
{
    if (!(fabs(value - wanted) <= error)) fail_msg("%.17g, wanted %.17g: off by %.3g", value, wanted, value - wanted);
}

static void expect_stretch(const struct small *small, size_t cell, const double wanted[6], double error)
{
    double V[6];
    stretch_at(small, cell, V);
    for (unsigned c = 0; c < 6; c++) near(V[c], wanted[c], error);
}

static const double identity[6] = {1, 1, 1, 0, 0, 0};

static void what_is_said_becomes_unimodular(void **state)
{
    (void)state;
    struct small small;
    small_start(&small, LINE "initial:\n  - {everywhere: true, " GEL
                             ", stretch: {xx: 20, yy: 0.5, xy: 0.4, xz: -0.3, yz: 0.02}}\n");
    double said[6] = {20, 0.5, 1, 0.4, -0.3, 0.02}, root = cbrt(paint_stretch_det(said));
    for (unsigned c = 0; c < 6; c++) said[c] /= root;
    for (size_t cell = 0; cell < 16; cell++) expect_stretch(&small, cell, said, 1e-14);
    near(paint_stretch_det(said), 1, 1e-14);
    near(pressure_at(&small, 3), 1e5, 1e-4);
    small_stop(&small);
}

static void a_case_without_a_stretch_is_exactly_unstretched(void **state)
{
    (void)state;
    struct small small;
    small_start(&small, PLANE "initial:\n  - {everywhere: true, " GEL "}\n  - {sphere: {center: [0.5, 0.5],"
                              " radius: 0.3}, " AIR "}\n");
    for (size_t cell = 0; cell < 256; cell++) expect_stretch(&small, cell, identity, 0);
    small_stop(&small);
}

/* A stretched disc in air: its edge cells have its stretch and the pressure of both; far away nothing is stretched. */
static void a_cut_cell_has_the_stretch_of_its_solid(void **state)
{
    (void)state;
    struct small small;
    unsigned cut = 0;
    small_start(&small, PLANE "initial:\n  - {everywhere: true, " AIR "}\n  - {sphere: {center: [0.5, 0.5],"
                              " radius: 0.3}, " GEL ", stretch: [1.25, 0.8, 1]}\n");
    const double inside[6] = {1.25, 0.8, 1, 0, 0, 0};
    for (size_t cell = 0; cell < 256; cell++) {
        double alpha = field(&small, small.state->model->i_alpha, cell);
        if (alpha >= ELASTIC_FADE) expect_stretch(&small, cell, inside, 1e-15);
        if (alpha == 0.0) expect_stretch(&small, cell, identity, 0);
        if (alpha == 0.0 || alpha >= ELASTIC_FADE) near(pressure_at(&small, cell), 1e5, 1e-3);
        cut += alpha > ELASTIC_FADE && alpha < 0.99;
    }
    assert_true(cut > 20);
    small_stop(&small);
}

/* Two halves of one solid that meet inside a column of cells: the mean there, weighted by their parts. */
static void means_are_weighted_by_the_solid(void **state)
{
    (void)state;
    struct small small;
    small_start(&small, PLANE "initial:\n  - {everywhere: true, " GEL "}\n  - {box: {lower: [0, 0], upper: [0.515625,"
                              " 1]}, stretch: [1.01, 1.01, 1]}\n  - {box: {lower: [0, 0], upper: [1, 0.5]}, fractions:"
                              " {air: 0.5, gel: 0.5}, density: {air: 1, gel: 1000}, pressure: 1e5}\n");
    double root = cbrt(1.01 * 1.01), part = 0.25 * (1.01 / root - 1), V[6];
    stretch_at(&small, 16 * 12 + 8, V); /* x from 0.5 to 0.5625: a quarter is stretched; y above 0.5 */
    near(V[ELASTIC_XX], 1 + part, 1e-5);
    expect_stretch(&small, 16 * 12 + 9, identity, 0);
    stretch_at(&small, 16 * 12 + 7, V);
    near(V[ELASTIC_XX], 1.01 / root, 1e-14);
    expect_stretch(&small, 16 * 2 + 7, identity, 0); /* a whole layer without a stretch is unstretched */
    small_stop(&small);
}

/* An expression of x: cell averages; in an overlay the unsaid components are those of the identity. */
static void expressions_are_averaged(void **state)
{
    (void)state;
    struct small small;
    small_start(&small, PLANE "initial:\n  - {everywhere: true, " GEL ", stretch: [1.3, 1, 1]}\n"
                              "  - {everywhere: true, stretch: {xy: \"= 0.01 * x\"}}\n");
    for (size_t i = 0; i < 16; i++) {
        double V[6], x = ((double)i + 0.5) / 16;
        stretch_at(&small, 16 * 5 + i, V);
        near(V[ELASTIC_XY], 0.01 * x, 1e-6);
        near(V[ELASTIC_XX], 1, 1e-4);
        near(paint_stretch_det(V), 1, 1e-14);
    }
    small_stop(&small);
}

static void lua_gives_components_by_either_name(void **state)
{
    (void)state;
    struct small small;
    small_start(&small, LINE "initial:\n  - {everywhere: true, " GEL ", stretch: [1.1, 1, 1]}\n"
                             "  - {lua: \"return function(x) return {stretch_xy = 0.01, stretch = {yz = 0.02}} end\"}\n"
                             "  - {lua: \"return function(x) return {alpha = {air = 1}, density = {air = 1},"
                             " stretch_xx = 2} end\", box: {lower: [0.5], upper: [1]}}\n");
    double wanted[6] = {1, 1, 1, 0.01, 0, 0.02}, root = cbrt(paint_stretch_det(wanted));
    for (unsigned c = 0; c < 6; c++) wanted[c] /= root;
    expect_stretch(&small, 2, wanted, 1e-14);
    expect_stretch(&small, 12, identity, 0);
    small_stop(&small);
}

/* What a layer says only while it is painted is judged there. */
static void expect_refusal(const char *text, const char *words)
{
    char path[] = "/tmp/bulla-stretch-XXXXXX";
    struct scene *scene;
    struct state *none;
    int file = mkstemp(path);
    assert_int_equal(write(file, text, strlen(text)), (long)strlen(text));
    close(file);
    assert_int_equal(scene_read(path, NULL, &scene), 0);
    assert_int_equal(state_new(scene, &none), STATUS_CASE);
    if (!strstr(status_text(), words)) fail_msg("%s\nis not about: %s", status_text(), words);
    assert_non_null(strstr(status_text(), "layer 1 of initial, at ("));
    scene_free(scene);
    unlink(path);
}

static void what_is_no_stretch_is_refused(void **state)
{
    (void)state;
    expect_refusal(PLANE "initial:\n  - {everywhere: true, " GEL ", stretch: {xx: \"= x - 0.5\"}}\n",
                   "principal values that are not above 0");
    expect_refusal(PLANE "initial:\n  - {everywhere: true, " GEL ", stretch: {xy: \"= 2 * x\"}}\n",
                   "principal values that are not above 0");
    expect_refusal(PLANE "initial:\n  - {everywhere: true, " GEL
                         ", stretch: {xx: \"= 1e200 + x\", yy: \"= 1e200 + y\"}}\n",
                   "not above 0, or too large");
    expect_refusal(BALL "initial:\n  - {everywhere: true, " GEL ", stretch: [1, \"= 1 + x\", 1]}\n",
                   "both stand around the centre and are equal");
    expect_refusal(BALL "initial:\n  - {lua: \"return function() return {pressure = 1e5, alpha_gel = 1, density = 1000,"
                        " stretch_xy = 0.1} end\"}\n",
                   "stretch_xy is 0.1, but velocities have 1 component here");
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(what_is_said_becomes_unimodular),
        cmocka_unit_test(a_case_without_a_stretch_is_exactly_unstretched),
        cmocka_unit_test(a_cut_cell_has_the_stretch_of_its_solid),
        cmocka_unit_test(means_are_weighted_by_the_solid),
        cmocka_unit_test(expressions_are_averaged),
        cmocka_unit_test(lua_gives_components_by_either_name),
        cmocka_unit_test(what_is_no_stretch_is_refused),
    };
    if (registry_init()) return 1;
    return cmocka_run_group_tests(tests, NULL, NULL);
}
