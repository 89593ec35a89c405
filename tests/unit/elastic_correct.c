/* What refluxing does to a stretch, and what makes an average of stretches one again: the correction against a small
 * step of the scheme itself, for any stretch and any change of a face, in every geometry. */
#include "base/mem.h"
#include "phys/elastic.h"
#include "phys/elastic_tensor.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

struct world {
    const char *name;
    int dim, beta;
    unsigned n_velocity;
};

static const struct world WORLDS[] = {
    {"line", 1, 0, 1},        {"line, three velocities", 1, 0, 3},
    {"plane", 2, 0, 2},       {"plane, three velocities", 2, 0, 3},
    {"space", 3, 0, 3},       {"axisymmetric", 2, 1, 2},
    {"cylindrical", 1, 1, 1}, {"spherical", 1, 2, 1},
};
enum { N_WORLD = sizeof WORLDS / sizeof *WORLDS };

static struct model model_of(const struct world *world)
{
    struct model model = {.dim = world->dim, .beta = world->beta, .n_velocity = world->n_velocity};
    model.n_stretch = elastic_tensor_count(world->n_velocity);
    model.n_solid = 1;
    model.n_alpha = model.n_material = 2;
    model.i_m = 2;
    model.i_u = 4;
    model.i_E = model.i_u + model.n_velocity;
    model.i_V = model.i_E + 1;
    model.n_field = model.i_V + model.n_stretch;
    model.solids[0].stretch = model.i_V;
    return model;
}

static double any(uint64_t *seed)
{
    *seed = *seed * 6364136223846793005u + 1442695040888963407u;
    return (double)(*seed >> 11) * 0x1p-52 - 1.0;
}

/* A symmetric unimodular positive definite tensor not far from others. */
static void any_stretch(const struct model *model, uint64_t *seed, double *V)
{
    for (unsigned c = 0; c < model->n_stretch; c++) V[c] = (c < 3 ? 1.3 : 0.0) + 0.4 * any(seed);
    elastic_unimodular(model, 1, 1, V);
}

/* The change of one face: of V* F, F, u* and the face velocity. */
struct change {
    double carried[6], arrived, swept, velocity[3];
    int axis;
};

static struct change any_change(const struct model *model, int axis, uint64_t *seed)
{
    struct change change = {.axis = axis};
    for (unsigned c = 0; c < model->n_stretch; c++) change.carried[c] = any(seed);
    for (unsigned d = 0; d < model->n_velocity; d++) change.velocity[d] = any(seed);
    change.arrived = any(seed);
    /* across other faces div u is the gradient; across those of a curved axis the areas differ */
    change.swept = model->beta && axis == 0 ? any(seed) : -change.velocity[axis];
    return change;
}

/* A step of the scheme that differs from rest by `part` of the change alone. */
static void step(const struct model *model, const struct change *change, double part, const double *V, double *ret_V)
{
    double carried[6], gradient[9] = {0}, div = part * change->swept, before = 1.0,
                       after = 1.0 + part * change->arrived;
    for (unsigned c = 0; c < model->n_stretch; c++) carried[c] = part * change->carried[c];
    for (unsigned d = 0; d < model->n_velocity; d++)
        gradient[d * (unsigned)model->dim + (unsigned)change->axis] = -part * change->velocity[d];
    const struct elastic_rates rates = {
        .carried = carried, .m_old = &before, .m_new = &after, .div = &div, .gradient = gradient};
    elastic_advance(model, 1, 1, 1.0, V, &rates, ret_V);
    elastic_unimodular(model, 1, 1, ret_V);
}

static double worst_of(const struct model *model, const struct change *change, const double *V)
{
    const double part = 1e-5;
    double up[6], down[6], more[6], less[6], dV[6], worst = 0.0;
    const struct elastic_correction in = {
        V, change->carried, change->arrived, change->swept, change->velocity, change->axis};
    elastic_correct(model, &in, dV);
    step(model, change, part, V, up);
    step(model, change, -part, V, down);
    for (unsigned c = 0; c < model->n_stretch; c++) {
        more[c] = V[c] + part * dV[c];
        less[c] = V[c] - part * dV[c];
    }
    elastic_unimodular(model, 1, 1, more);
    elastic_unimodular(model, 1, 1, less);
    for (unsigned c = 0; c < model->n_stretch; c++)
        worst = fmax(worst, fabs((more[c] - less[c]) - (up[c] - down[c])) / (2.0 * part));
    return worst;
}

static void test_as_the_scheme(void **state)
{
    (void)state;
    uint64_t seed = 1;
    for (int i = 0; i < N_WORLD; i++) {
        struct model model = model_of(&WORLDS[i]);
        double worst = 0.0, V[6];
        for (int axis = 0; axis < model.dim; axis++)
            for (int k = 0; k < 50; k++) {
                any_stretch(&model, &seed, V);
                struct change change = any_change(&model, axis, &seed);
                worst = fmax(worst, worst_of(&model, &change, V));
            }
        print_message("%s: off by %.1e\n", WORLDS[i].name, worst);
        if (!(worst < 1e-4)) /* the scheme has a kink of the size of the step where mass turns */
            fail_msg("%s: correction and step differ by %g", WORLDS[i].name, worst);
    }
}

/* Where nothing changes nothing is added, to the bit; nor where a uniform stretch is carried with more or less mass. */
static void test_nothing(void **state)
{
    (void)state;
    uint64_t seed = 7;
    for (int i = 0; i < N_WORLD; i++) {
        struct model model = model_of(&WORLDS[i]);
        double V[6], dV[6], zero[6] = {0}, carried[6];
        any_stretch(&model, &seed, V);
        const struct elastic_correction rest = {V, zero, 0.0, 0.0, zero, 0};
        elastic_correct(&model, &rest, dV);
        for (unsigned c = 0; c < model.n_stretch; c++) assert_true(dV[c] == 0.0);
        if (model.beta) continue; /* there, more u* at one radius alone stretches hoops */
        for (unsigned c = 0; c < model.n_stretch; c++) carried[c] = 0.25 * V[c];
        const struct elastic_correction swept = {V, carried, 0.25, 0.25, zero, 0};
        elastic_correct(&model, &swept, dV);
        for (unsigned c = 0; c < model.n_stretch; c++) assert_true(dV[c] == 0.0);
    }
}

static double det_of(const double *V, unsigned n)
{
    double xy = n > 3 ? V[3] : 0.0, xz = n > 4 ? V[4] : 0.0, yz = n > 4 ? V[5] : 0.0;
    return (V[0] * V[1] - xy * xy) * V[2] + (2.0 * xy * xz * yz - V[0] * yz * yz - V[1] * xz * xz);
}

/* Means of stretches get det 1; single ones keep their bits; without solid all is the identity, with a trace almost. */
static void test_settle(void **state)
{
    (void)state;
    enum { N = 300 };
    uint64_t seed = 3;
    for (int i = 0; i < N_WORLD; i++) {
        struct model model = model_of(&WORLDS[i]);
        double *block = mem_new(model.n_field * N, sizeof *block), *was = mem_new(model.n_stretch * N, sizeof *was);
        double *rows = block + model.i_V * N;
        for (size_t k = 0; k < N; k++) {
            double V[6], W[6];
            any_stretch(&model, &seed, V);
            any_stretch(&model, &seed, W);
            block[k] = k % 4 == 2 ? 0.0 : k % 4 == 3 ? 0.01 * ELASTIC_FADE : 1.0; /* the solid is material 0 */
            for (unsigned c = 0; c < model.n_stretch; c++)
                rows[c * N + k] = was[c * N + k] = k % 4 ? 0.5 * (V[c] + W[c]) : V[c];
            if (k % 8 == 2) /* round-off without solid goes too */
                for (unsigned c = 0; c < model.n_stretch; c++) rows[c * N + k] = (c < 3 ? 1.0 : 0.0) + 1e-16 * V[c];
        }
        elastic_settle(&model, N, N, block);
        for (size_t k = 0; k < N; k++) {
            double V[6] = {0}, off = 0.0;
            for (unsigned c = 0; c < model.n_stretch; c++) {
                double here = V[c] = rows[c * N + k];
                off = fmax(off, fabs(here - (c < 3)));
                if (k % 4 == 0) assert_true(here == was[c * N + k]);
            }
            assert_true(fabs(det_of(V, model.n_stretch) - 1.0) < 1e-14);
            if (k % 4 == 1) assert_true(off > 1e-3);
            if (k % 4 == 2) assert_true(off == 0.0);
            if (k % 4 == 3) assert_true(off > 0.0 && off < 1.1e-4);
        }
        mem_free(block);
        mem_free(was);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_as_the_scheme),
        cmocka_unit_test(test_nothing),
        cmocka_unit_test(test_settle),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
