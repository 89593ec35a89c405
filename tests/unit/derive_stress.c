/* Stresses, stretches and elastic energy as derived fields, against states worked out by hand: uniaxial stretch, simple
 * shear, hoop stretch, a stretch turned in space, cells that are partly or not at all solid. The law is the test's
 * own. */
#include "base/status.h"
#include "derive/derive.h"
#include "phys/elastic.h"
#include "phys/elastic_tensor.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

static const double MU = 85e3, RHO0 = 1060.0, RHO = 1102.4, P = 3.7e6;

static void energy(const void *self, size_t n, const double *I1, const double *I2, double *e, double *e_1, double *e_2)
{
    (void)self;
    for (size_t i = 0; i < n; i++) {
        e[i] = 0.5 * MU / RHO0 * (I1[i] - 3.0) + 0.0 * I2[i];
        e_1[i] = 0.5 * MU / RHO0;
        e_2[i] = 0.0;
    }
}

static const struct bulla_constitutive LAW = {.size = sizeof LAW, .energy = energy, .first_only = 1};

enum { WATER, TISSUE, FIELDS = 2 + 2 + 3 + 1 + 6 };

/* One cell of water and tissue. */
struct world {
    struct scene scene;
    struct model model;
    struct mesh mesh;
    double *block, w[FIELDS];
};

static void world_make(struct world *world, unsigned n_velocity)
{
    static const char *const none[] = {"density", NULL};
    struct model *model = &world->model;
    memset(world, 0, sizeof *world);
    world->block = world->w;
    strcpy(world->scene.material[WATER].name, "water");
    strcpy(world->scene.material[TISSUE].name, "tissue");
    *model = (struct model){.scene = &world->scene, .n_material = 2, .n_alpha = 2, .i_m = 2, .i_u = 4};
    model->n_velocity = n_velocity;
    model->i_E = model->i_u + n_velocity;
    model->i_V = model->i_E + 1;
    model->n_stretch = elastic_tensor_count(n_velocity);
    model->n_solid = 1;
    model->elastic = true;
    model->solids[0] = (struct model_solid){.stretch = model->i_V, .law = &LAW, .material = TISSUE};
    model->names = (char **)(uintptr_t)none;
    world->mesh.n_cell = 1;
    world->mesh.n_level = 1;
    world->mesh.levels[0].w = &world->block;
    world->w[TISSUE] = 1.0;
    world->w[model->i_m + WATER] = 998.0;
    world->w[model->i_m + TISSUE] = RHO;
    world->w[model->i_E] = P;
    for (unsigned c = 0; c < 3; c++) world->w[model->i_V + c] = 1.0;
}

static void world_stretch(struct world *world, double V[3][3])
{
    for (unsigned i = 0; i < 3; i++)
        for (unsigned j = i; j < 3; j++) {
            unsigned c = elastic_component(i, j);
            if (c < world->model.n_stretch) world->w[world->model.i_V + c] = V[i][j];
            else assert_true(V[i][j] == 0.0);
        }
}

static void check(const struct world *world, const char *name, double wanted)
{
    struct derive field;
    double value = NAN, size = P + MU;
    if (derive_find(&world->model, name, &field)) fail_msg("%s", status_text());
    assert_int_equal(field.components, 1);
    derive_tile(&world->model, &world->mesh, 0, 0, 0.0, &field, &value);
    if (!strcmp(field.unit, "1")) size = 1.0 + fabs(wanted);
    if (!(fabs(value - wanted) <= 1e-14 * size)) fail_msg("%s: %.17g, not %.17g", name, value, wanted);
}

/* Stretch a along one of the axes. */
static void check_uniaxial(unsigned n_velocity, unsigned axis, double a)
{
    struct world world;
    double V[3][3] = {{0}}, G = RHO / RHO0 * MU, along = G * (a * a - 1.0 / a), s[3];
    static const char *const stress[] = {"stress_xx", "stress_yy", "stress_zz"};
    world_make(&world, n_velocity);
    for (unsigned i = 0; i < 3; i++) {
        V[i][i] = i == axis ? a : 1.0 / sqrt(a);
        s[i] = along * (i == axis ? 2.0 / 3.0 : -1.0 / 3.0);
    }
    world_stretch(&world, V);
    for (unsigned i = 0; i < 3; i++) check(&world, stress[i], s[i] - P);
    check(&world, "stress_xy", 0.0);
    check(&world, "stress_xz", 0.0);
    check(&world, "stress_yz", 0.0);
    check(&world, "stretch_xx", V[0][0]);
    check(&world, "stretch_zz", V[2][2]);
    check(&world, "stretch_yz", 0.0);
    check(&world, "stretch_max", a > 1.0 ? a : 1.0 / sqrt(a));
    double most = s[0] > s[1] ? s[0] : s[1], least = s[0] > s[1] ? s[1] : s[0];
    check(&world, "sigma_max", most - P);
    check(&world, "sigma_min", least - P);
    check(&world, "sigma_max_dev", most);
    check(&world, "sigma_min_dev", least);
    check(&world, "sigma_shear", 0.5 * (most - least));
    most = along > 0.0 ? 2.0 / 3.0 * along : -along / 3.0;
    least = along > 0.0 ? -along / 3.0 : 2.0 / 3.0 * along;
    check(&world, "principal_max", most - P);
    check(&world, "principal_min", least - P);
    check(&world, "principal_max_dev", most);
    check(&world, "principal_min_dev", least);
    check(&world, "principal_shear", 0.5 * fabs(along));
    check(&world, "von_mises", fabs(along));
    check(&world, "strain_energy", 0.5 * G * (a * a + 2.0 / a - 3.0));
    check(&world, "invariant_1", a * a + 2.0 / a);
    check(&world, "invariant_2", 2.0 * a + 1.0 / (a * a));
}

/* The hoop stress (zz) is the largest when a ring is widened, and eq. 41 does not see it. */
static void test_uniaxial(void **state)
{
    (void)state;
    for (unsigned n_velocity = 1; n_velocity <= 3; n_velocity++)
        for (unsigned axis = 0; axis < 3; axis++) {
            check_uniaxial(n_velocity, axis, 1.7);
            check_uniaxial(n_velocity, axis, 0.6);
        }
}

/* Simple shear g of x along y: B = (1 + g^2, g; g, 1), V = (B + 1)/sqrt(g^2 + 4). */
static void test_shear(void **state)
{
    double g = 0.9, G = RHO / RHO0 * MU, f = 1.0 / sqrt(g * g + 4.0), root = g * sqrt(1.0 + 0.25 * g * g);
    (void)state;
    for (unsigned n_velocity = 2; n_velocity <= 3; n_velocity++) {
        struct world world;
        world_make(&world, n_velocity);
        world_stretch(&world, (double[3][3]){{(2.0 + g * g) * f, g * f, 0}, {g * f, 2.0 * f, 0}, {0, 0, 1}});
        check(&world, "stress_xx", G * 2.0 / 3.0 * g * g - P);
        check(&world, "stress_yy", -G / 3.0 * g * g - P);
        check(&world, "stress_zz", -G / 3.0 * g * g - P);
        check(&world, "stress_xy", G * g);
        check(&world, "stretch_xy", g * f);
        check(&world, "stretch_max", 0.5 * g + sqrt(1.0 + 0.25 * g * g));
        check(&world, "sigma_shear", G * root);
        check(&world, "sigma_max_dev", G * (g * g / 6.0 + root));
        check(&world, "sigma_min_dev", G * (g * g / 6.0 - root));
        check(&world, "principal_max", G * (g * g / 6.0 + root) - P);
        check(&world, "principal_min", G * (g * g / 6.0 - root) - P);
        check(&world, "von_mises", G * sqrt(g * g * g * g + 3.0 * g * g));
        check(&world, "invariant_1", 3.0 + g * g);
        check(&world, "invariant_2", 3.0 + g * g);
    }
}

/* A uniaxial stretch along a direction that is no axis: two principal values are equal. */
static void test_turned(void **state)
{
    double a = 2.3, d[3] = {2.0 / 7.0, 3.0 / 7.0, 6.0 / 7.0}, V[3][3], G = RHO / RHO0 * MU;
    double along = G * (a * a - 1.0 / a);
    struct world world;
    (void)state;
    world_make(&world, 3);
    for (unsigned i = 0; i < 3; i++)
        for (unsigned j = 0; j < 3; j++) V[i][j] = (i == j ? 1.0 / sqrt(a) : 0.0) + (a - 1.0 / sqrt(a)) * d[i] * d[j];
    world_stretch(&world, V);
    check(&world, "stretch_max", a);
    check(&world, "stress_xz", along * d[0] * d[2]);
    check(&world, "stress_yz", along * d[1] * d[2]);
    check(&world, "principal_max_dev", 2.0 / 3.0 * along);
    check(&world, "principal_min", -along / 3.0 - P);
    check(&world, "von_mises", along);
    check(&world, "strain_energy", 0.5 * G * (a * a + 2.0 / a - 3.0));
}

/* Where 30 % is tissue, 30 % of its stress; in water only the pressure, whatever V is. */
static void test_mixed(void **state)
{
    double a = 1.4, along = 0.3 * RHO / RHO0 * MU * (a * a - 1.0 / a);
    struct world world;
    (void)state;
    world_make(&world, 2);
    world_stretch(&world, (double[3][3]){{a, 0, 0}, {0, 1.0 / sqrt(a), 0}, {0, 0, 1.0 / sqrt(a)}});
    world.w[WATER] = 0.7;
    world.w[TISSUE] = 0.3;
    check(&world, "stress_xx", 2.0 / 3.0 * along - P);
    check(&world, "von_mises", along);
    world.w[WATER] = 1.0;
    world.w[TISSUE] = 0.0;
    check(&world, "stress_xx", -P);
    check(&world, "sigma_max", -P);
    check(&world, "principal_min", -P);
    check(&world, "von_mises", 0.0);
    check(&world, "strain_energy", 0.0);
    check(&world, "stretch_max", a);
}

static void test_names(void **state)
{
    struct world world;
    struct derive field;
    (void)state;
    world_make(&world, 2);
    assert_int_equal(derive_find(&world.model, "stress_zx", &field), STATUS_CASE);
    assert_int_equal(derive_find(&world.model, "stretch_", &field), STATUS_CASE);
    world.model.elastic = false;
    assert_int_equal(derive_find(&world.model, "stress_xx", &field), STATUS_CASE);
    assert_int_equal(derive_find(&world.model, "von_mises", &field), STATUS_CASE);
    assert_int_equal(derive_find(&world.model, "density", &field), STATUS_OK);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(test_uniaxial), cmocka_unit_test(test_shear),
                                       cmocka_unit_test(test_turned), cmocka_unit_test(test_mixed),
                                       cmocka_unit_test(test_names)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
