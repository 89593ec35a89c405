/* contract_field.c - see contract_field.h. Cells of two materials that move in space, and of one on a line. Rows that a
 * module does not ask for are not there: one that looks at them crashes here and not in a run. */
#include "suite/contract_field.h"

#include "bulla/field.h"
#include "case/unit.h"
#include "suite/contract_batch.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

enum { FIELD_STATES = 3000, FIELD_MATERIALS = 2, FIELD_AXES = 3 };

/* Rows of a cell. */
enum {
    FIELD_X,
    FIELD_VOLUME = FIELD_X + FIELD_AXES,
    FIELD_ALPHA,
    FIELD_RHO = FIELD_ALPHA + FIELD_MATERIALS,
    FIELD_U = FIELD_RHO + FIELD_MATERIALS,
    FIELD_P = FIELD_U + FIELD_AXES,
    FIELD_C,
    FIELD_T,
    FIELD_E = FIELD_T + FIELD_MATERIALS,
    FIELD_DU,
    FIELD_DP = FIELD_DU + FIELD_AXES * FIELD_AXES,
    FIELD_DRHO = FIELD_DP + FIELD_AXES,
    FIELD_IN = FIELD_DRHO + FIELD_AXES
};

#define FIELD_SAME 1e-10 /* of facts that hold to round-off */

/* What scene the cells are of. */
struct field_scene {
    uint32_t n_material, n_velocity, dim, beta;
    double t;
};

static const struct bulla_field *contract_field_law(const struct contract *contract)
{
    return contract->module->table;
}

static unsigned contract_field_count(const struct contract *contract)
{
    unsigned count = 0;
    while (contract_field_law(contract)->outputs[count].unit) count++;
    return count;
}

static void contract_field_slopes(uint32_t needs, const double *const *in, struct bulla_points *cells)
{
    for (int i = 0; i < FIELD_AXES * FIELD_AXES && needs & BULLA_FIELD_VELOCITY_SLOPES; i++)
        cells->du[i / FIELD_AXES][i % FIELD_AXES] = in[FIELD_DU + i];
    for (int d = 0; d < FIELD_AXES && needs & BULLA_FIELD_PRESSURE_SLOPES; d++) cells->dp[d] = in[FIELD_DP + d];
    for (int d = 0; d < FIELD_AXES && needs & BULLA_FIELD_DENSITY_SLOPES; d++) cells->drho[d] = in[FIELD_DRHO + d];
}

static void contract_field_call(const struct contract *contract, const struct field_scene *scene, size_t n,
                                const double *const *in, double *const *out)
{
    uint32_t needs = contract_field_law(contract)->needs;
    const double *alpha[FIELD_MATERIALS] = {0}, *rho[FIELD_MATERIALS] = {0}, *u[FIELD_AXES] = {0};
    struct bulla_points cells = {.size = sizeof cells,
                                 .n_material = scene->n_material,
                                 .n_velocity = scene->n_velocity,
                                 .dim = scene->dim,
                                 .beta = scene->beta,
                                 .n = n,
                                 .t = scene->t,
                                 .x = {in[FIELD_X], in[FIELD_X + 1], in[FIELD_X + 2]},
                                 .volume = in[FIELD_VOLUME],
                                 .alpha = alpha,
                                 .rho = rho,
                                 .u = u,
                                 .p = in[FIELD_P],
                                 .c = needs & BULLA_FIELD_SOUND ? in[FIELD_C] : NULL,
                                 .T = needs & BULLA_FIELD_TEMPERATURES ? in + FIELD_T : NULL,
                                 .rho_E = needs & BULLA_FIELD_ENERGY ? in[FIELD_E] : NULL};
    for (uint32_t l = 0; l < scene->n_material; l++) alpha[l] = in[FIELD_ALPHA + l], rho[l] = in[FIELD_RHO + l];
    for (uint32_t d = 0; d < scene->n_velocity; d++) u[d] = in[FIELD_U + d];
    for (uint32_t d = 0; d < scene->dim; d++) cells.h[d] = 1e-6;
    contract_field_slopes(needs, in, &cells);
    contract_field_law(contract)->compute(contract->self, &cells, out);
}

static void contract_field_at(const struct contract *contract, const struct field_scene *scene,
                              const double in[static FIELD_IN], double out[static BULLA_FIELD_OUTPUTS])
{
    const double *rows[FIELD_IN];
    double *results[BULLA_FIELD_OUTPUTS];
    for (int k = 0; k < FIELD_IN; k++) rows[k] = &in[k];
    for (int k = 0; k < BULLA_FIELD_OUTPUTS; k++) out[k] = 0.0, results[k] = &out[k];
    contract_field_call(contract, scene, 1, rows, results);
}

static void contract_field_draw(const struct contract *contract, const struct contract_call *call, uint64_t *seed,
                                double *in)
{
    double a = contract_random(seed, -0.3, 1.3), steep = contract_decades(seed, 1.0, 1e9);
    (void)contract, (void)call;
    in[FIELD_ALPHA] = a < 0.0 ? 0.0 : a > 1.0 ? 1.0 : a;
    in[FIELD_ALPHA + 1] = 1.0 - in[FIELD_ALPHA];
    for (int d = 0; d < FIELD_AXES; d++) in[FIELD_X + d] = contract_random(seed, 0.001, 1.0);
    in[FIELD_VOLUME] = contract_decades(seed, 1e-18, 1.0);
    for (int l = 0; l < FIELD_MATERIALS; l++) in[FIELD_RHO + l] = contract_decades(seed, 1e-3, 2e4);
    for (int d = 0; d < FIELD_AXES; d++) in[FIELD_U + d] = contract_random(seed, -2e3, 2e3);
    in[FIELD_P] = contract_decades(seed, 1e2, 1e10);
    in[FIELD_C] = contract_decades(seed, 10.0, 1e4);
    for (int l = 0; l < FIELD_MATERIALS; l++) in[FIELD_T + l] = contract_decades(seed, 10.0, 1e5);
    in[FIELD_E] = contract_decades(seed, 1e3, 1e11);
    for (int k = 0; k < FIELD_AXES * FIELD_AXES; k++) in[FIELD_DU + k] = contract_random(seed, -steep, steep);
    for (int d = 0; d < FIELD_AXES; d++) in[FIELD_DP + d] = steep * contract_random(seed, -1e6, 1e6);
    for (int d = 0; d < FIELD_AXES; d++) in[FIELD_DRHO + d] = steep * contract_random(seed, -1.0, 1.0);
}

static void contract_field_say(const struct field_scene *scene, const double in[static FIELD_IN],
                               char where[static CONTRACT_WHERE])
{
    snprintf(where, CONTRACT_WHERE, "%u material(s), %uD, beta %u: alpha %.4g, rho %.4g, u %.4g, p %.6g, du/dx %.4g",
             scene->n_material, scene->dim, scene->beta, in[FIELD_ALPHA], in[FIELD_RHO], in[FIELD_U], in[FIELD_P],
             in[FIELD_DU]);
}

/* Takes away what a scene of fewer axes and materials has not. */
static void contract_field_flatten(const struct field_scene *scene, double in[static FIELD_IN])
{
    for (uint32_t d = scene->dim; d < FIELD_AXES; d++) {
        in[FIELD_X + d] = in[FIELD_DP + d] = in[FIELD_DRHO + d] = 0.0;
        for (uint32_t i = 0; i < FIELD_AXES; i++)
            in[FIELD_DU + FIELD_AXES * i + d] = in[FIELD_DU + FIELD_AXES * d + i] = 0.0;
    }
    if (scene->n_material == 1) in[FIELD_ALPHA] = 1.0;
}

static void contract_field_state(struct contract *contract, const struct field_scene *scene, double *in)
{
    const struct bulla_field_output *outputs = contract_field_law(contract)->outputs;
    double out[BULLA_FIELD_OUTPUTS];
    char where[CONTRACT_WHERE];
    contract_field_flatten(scene, in);
    contract_field_say(scene, in, where);
    contract_field_at(contract, scene, in, out);
    for (unsigned k = 0; outputs[k].unit; k++) {
        contract_begin(contract, "finite in any state", 0.0);
        contract_holds(contract, isfinite(out[k]), where);
        contract_begin(contract, "what says POSITIVE is above 0", 0.0);
        if (outputs[k].is & BULLA_FIELD_POSITIVE) contract_holds(contract, out[k] > 0.0, where);
        contract_begin(contract, "what says FRACTION is from 0 to 1", 0.0);
        if (outputs[k].is & BULLA_FIELD_FRACTION) contract_holds(contract, out[k] >= 0.0 && out[k] <= 1.0, where);
    }
}

/* The same cell at rest, where nothing changes. */
static void contract_field_rest(struct contract *contract, const struct field_scene *scene, double *in)
{
    const struct bulla_field_output *outputs = contract_field_law(contract)->outputs;
    double out[BULLA_FIELD_OUTPUTS];
    char where[CONTRACT_WHERE];
    for (int d = 0; d < FIELD_AXES; d++) in[FIELD_U + d] = 0.0;
    for (int k = FIELD_DU; k < FIELD_IN; k++) in[k] = 0.0;
    contract_field_say(scene, in, where);
    contract_field_at(contract, scene, in, out);
    contract_begin(contract, "what says VANISHING or SIGNED is 0 at rest", 0.0);
    for (unsigned k = 0; outputs[k].unit; k++)
        if (outputs[k].is & (BULLA_FIELD_VANISHING | BULLA_FIELD_SIGNED))
            contract_holds(contract, out[k] == 0.0, where);
    contract_begin(contract, "finite at rest, where nothing changes", 0.0);
    for (unsigned k = 0; outputs[k].unit; k++) contract_holds(contract, isfinite(out[k]), where);
}

static void contract_field_units(struct contract *contract)
{
    const struct bulla_field_output *outputs = contract_field_law(contract)->outputs;
    contract_begin(contract, "outputs have SI units", 0.0);
    for (unsigned k = 0; outputs[k].unit; k++) {
        struct unit unit;
        char bad[32];
        bool known = unit_parse(outputs[k].unit, &unit, bad);
        bool plain = known && unit.factor == 1.0 && unit.decimal == 0 && unit.offset == 0.0;
        contract_error(contract, !plain, "'%s' in '%s'", outputs[k].suffix, outputs[k].unit);
    }
}

static bool contract_field_agrees(const struct contract *contract, const double *one, const double *other)
{
    bool same = true;
    for (unsigned k = 0; k < contract_field_count(contract); k++)
        same = same && fabs(one[k] - other[k]) <= FIELD_SAME * (fabs(one[k]) + fabs(other[k]));
    return same;
}

/* x becomes y, y becomes z, z becomes x. */
static void contract_field_rotate(const double in[static FIELD_IN], double ret[static FIELD_IN])
{
    static const int vectors[] = {FIELD_X, FIELD_U, FIELD_DP, FIELD_DRHO};
    memcpy(ret, in, FIELD_IN * sizeof *ret);
    for (int v = 0; v < 4; v++)
        for (int d = 0; d < FIELD_AXES; d++) ret[vectors[v] + (d + 1) % FIELD_AXES] = in[vectors[v] + d];
    for (int i = 0; i < FIELD_AXES; i++)
        for (int j = 0; j < FIELD_AXES; j++)
            ret[FIELD_DU + FIELD_AXES * ((i + 1) % FIELD_AXES) + (j + 1) % FIELD_AXES] =
                in[FIELD_DU + FIELD_AXES * i + j];
}

/* Told, not asked: what the field does not mind. */
static void contract_field_facts(struct contract *contract)
{
    const struct field_scene space = {FIELD_MATERIALS, FIELD_AXES, FIELD_AXES, 0, 1e-6}, later = {2, 3, 3, 0, 1.0};
    double in[FIELD_IN], turned[FIELD_IN], one[BULLA_FIELD_OUTPUTS], other[BULLA_FIELD_OUTPUTS];
    uint64_t seed = 21;
    contract_field_draw(contract, NULL, &seed, in);
    contract_field_at(contract, &space, in, one);
    contract_field_at(contract, &later, in, other);
    contract_fact(contract, "the same at any time", contract_field_agrees(contract, one, other));
    contract_field_rotate(in, turned);
    contract_field_at(contract, &space, turned, other);
    contract_fact(contract, "the same whichever axis is called x", contract_field_agrees(contract, one, other));
    memcpy(turned, in, sizeof in);
    for (int d = 0; d < FIELD_AXES; d++) turned[FIELD_U + d] += 100.0;
    contract_field_at(contract, &space, turned, other);
    contract_fact(contract, "the same for who moves along", contract_field_agrees(contract, one, other));
}

static void contract_field_run_row(const struct contract *contract, const struct contract_call *call, size_t n,
                                   const double *const *in, double *const *out)
{
    contract_field_call(contract, call->context, n, in, out);
}

void contract_field_run(struct contract *contract)
{
    static const struct field_scene scenes[] = {{FIELD_MATERIALS, FIELD_AXES, FIELD_AXES, 0, 1e-6},
                                                {1, 1, 1, 0, 0.0},
                                                {2, 2, 2, 1, 1e-6},
                                                {1, 1, 1, 2, 1e-6}};
    enum { SCENES = sizeof scenes / sizeof *scenes };
    const struct contract_call compute = {
        "compute", FIELD_IN, contract_field_count(contract), contract_field_run_row, contract_field_draw, &scenes[0]};
    uint64_t seed = 19;
    contract_field_units(contract);
    contract_doing(contract, "cells, with no rows but those that `needs` names");
    for (int i = 0; i < FIELD_STATES; i++) {
        double in[FIELD_IN];
        contract_field_draw(contract, NULL, &seed, in);
        contract_field_state(contract, &scenes[i % SCENES], in);
        contract_field_rest(contract, &scenes[i % SCENES], in);
    }
    contract_field_facts(contract);
    contract_batch_run(contract, &compute);
}

void contract_field_probe(const struct contract *contract, double out[static CONTRACT_PROBE])
{
    const struct field_scene space = {FIELD_MATERIALS, FIELD_AXES, FIELD_AXES, 0, 1e-6};
    double in[FIELD_IN], values[BULLA_FIELD_OUTPUTS];
    uint64_t seed = 3;
    contract_field_draw(contract, NULL, &seed, in);
    contract_field_at(contract, &space, in, values);
    memcpy(out, values, CONTRACT_PROBE * sizeof *out);
}
