/* contract_constitutive.c - see contract_constitutive.h.
 *
 * Everything that core makes of a law follows from e^s(I1, I2): its derivatives are compared with differences, the
 * second ones with differences of the first. Points are those of real stretches l1 l2 l3 = 1, I1 = l1^2 + l2^2 + l3^2,
 * I2 = 1/l1^2 + 1/l2^2 + 1/l3^2, and, because limited face values belong to no stretch, any pair from 1 to 1e6. */
#include "suite/contract_constitutive.h"

#include "bulla/constitutive.h"
#include "suite/contract_batch.h"

#include <math.h>
#include <stdio.h>

enum { CONSTITUTIVE_STATES = 2000, CONSTITUTIVE_GRID = 60 };

#define CONSTITUTIVE_MOST 1e6  /* of the invariants: stretches to a thousand */
#define CONSTITUTIVE_STEP 1e-4 /* of a difference, relative to where it is taken and to what it changes */
#define CONSTITUTIVE_REAL "all shear waves are real (e_1 + l^2 e_2 > 0 for every principal stretch l)"

struct constitutive_point {
    double e, e_1, e_2, e_11, e_12, e_22;
};

static struct constitutive_point contract_constitutive_at(const struct contract *contract, double I1, double I2)
{
    const struct bulla_constitutive *law = contract->module->table;
    struct constitutive_point point = {NAN, NAN, NAN, 0.0, 0.0, 0.0};
    law->energy(contract->self, 1, &I1, &I2, &point.e, &point.e_1, &point.e_2);
    if (law->second) law->second(contract->self, 1, &I1, &I2, &point.e_11, &point.e_12, &point.e_22);
    return point;
}

/* A random stretch, from none to a thousand in each direction; l[] are the principal ones. */
static void contract_constitutive_draw(uint64_t *seed, double l[static 3], double *ret_I1, double *ret_I2)
{
    double size = log(CONSTITUTIVE_MOST) * 0.25 * contract_random(seed, 0.0, 1.0);
    l[0] = exp(size * contract_random(seed, -1.0, 1.0));
    l[1] = exp(size * contract_random(seed, -1.0, 1.0));
    l[2] = 1.0 / (l[0] * l[1]);
    *ret_I1 = *ret_I2 = 0.0;
    for (int k = 0; k < 3; k++) {
        *ret_I1 += l[k] * l[k];
        *ret_I2 += 1.0 / (l[k] * l[k]);
    }
}

/* A step in one invariant: small beside it, and so small that the first derivatives hardly change. */
static double contract_constitutive_step(const struct contract *contract, double I1, double I2, bool second)
{
    double h = CONSTITUTIVE_STEP * (second ? I2 : I1);
    struct constitutive_point here = contract_constitutive_at(contract, I1, I2);
    struct constitutive_point there = contract_constitutive_at(contract, second ? I1 : I1 + h, second ? I2 + h : I2);
    double change = fabs(there.e_1 - here.e_1) + fabs(there.e_2 - here.e_2), size = fabs(here.e_1) + fabs(here.e_2);
    return change > CONSTITUTIVE_STEP * size ? h * CONSTITUTIVE_STEP * size / change : h;
}

/* One derivative against a difference of values that have round-off of their own. */
static void contract_constitutive_slope(struct contract *contract, double up, double down, double h, double want,
                                        const char *where)
{
    double noise = 1e-9 * (fabs(up) + fabs(down)) / h;
    contract_near(contract, (up - down) / (2.0 * h), want, fabs(want) + noise, where);
}

static void contract_constitutive_differences(struct contract *contract, double I1, double I2, const char *where)
{
    struct constitutive_point here = contract_constitutive_at(contract, I1, I2);
    double h = contract_constitutive_step(contract, I1, I2, false),
           k = contract_constitutive_step(contract, I1, I2, true);
    struct constitutive_point a = contract_constitutive_at(contract, I1 - h, I2),
                              b = contract_constitutive_at(contract, I1 + h, I2);
    struct constitutive_point c = contract_constitutive_at(contract, I1, I2 - k),
                              d = contract_constitutive_at(contract, I1, I2 + k);
    contract_begin(contract, "e_1 is the slope of e along I1", 1e-6);
    contract_constitutive_slope(contract, b.e, a.e, h, here.e_1, where);
    contract_begin(contract, "e_2 is the slope of e along I2", 1e-6);
    contract_constitutive_slope(contract, d.e, c.e, k, here.e_2, where);
    contract_begin(contract, "second derivatives are the slopes of e_1 and e_2 (without `second`: 0)", 1e-5);
    contract_constitutive_slope(contract, b.e_1, a.e_1, h, here.e_11, where);
    contract_constitutive_slope(contract, d.e_1, c.e_1, k, here.e_12, where);
    contract_constitutive_slope(contract, b.e_2, a.e_2, h, here.e_12, where);
    contract_constitutive_slope(contract, d.e_2, c.e_2, k, here.e_22, where);
}

/* What core skips when a law says that I2 does not matter. */
static void contract_constitutive_first_only(struct contract *contract, double I1, double I2)
{
    const struct bulla_constitutive *law = contract->module->table;
    contract_begin(contract, "first_only is 0 or 1; with 1 nothing depends on I2, bitwise", 0.0);
    contract_error(contract, law->first_only > 1, "first_only = %u", law->first_only);
    if (!law->first_only) return;
    struct constitutive_point point = contract_constitutive_at(contract, I1, I2),
                              other = contract_constitutive_at(contract, I1, 3.0);
    bool alone = point.e_2 == 0.0 && point.e_12 == 0.0 && point.e_22 == 0.0;
    bool same = point.e == other.e && point.e_1 == other.e_1 && point.e_11 == other.e_11;
    contract_error(contract, !(alone && same), "I1 %.6g, I2 %.6g: e_2 %.3g, e %.17g, at I2 = 3 %.17g", I1, I2,
                   point.e_2, point.e, other.e);
}

/* Real stretches. */
static void contract_constitutive_states(struct contract *contract)
{
    const struct bulla_constitutive *law = contract->module->table;
    struct bulla_constitutive_range range;
    uint64_t seed = 1;
    law->range(contract->self, &range);
    bool real = true;
    for (int i = 0; i < CONSTITUTIVE_STATES; i++) {
        char where[64];
        double l[3], I1, I2;
        contract_constitutive_draw(&seed, l, &I1, &I2);
        snprintf(where, sizeof where, "I1 %.6g, I2 %.6g", I1, I2);
        /* At the very edge of the published formulas the second derivatives may jump. */
        bool edge = fabs(I1 / range.I1_max - 1.0) < 1e-3 || fabs(I2 / range.I2_max - 1.0) < 1e-3;
        if (!edge) contract_constitutive_differences(contract, I1, I2, where);
        contract_constitutive_first_only(contract, I1, I2);
        struct constitutive_point point = contract_constitutive_at(contract, I1, I2);
        for (int k = 0; k < 3; k++) real &= point.e_1 + l[k] * l[k] * point.e_2 > 0.0;
    }
    contract_fact(contract, CONSTITUTIVE_REAL, real);
}

static void contract_constitutive_rest(struct contract *contract)
{
    struct constitutive_point rest = contract_constitutive_at(contract, 3.0, 3.0);
    contract_begin(contract, "no energy in the unstretched body", contract->strict ? 0.0 : 1e-14);
    contract_near(contract, rest.e, 0.0, rest.e_1 + rest.e_2, "I1 = I2 = 3");
}

/* Any pair of invariants. */
static void contract_constitutive_everywhere(struct contract *contract)
{
    for (int i = 0; i <= CONSTITUTIVE_GRID * CONSTITUTIVE_GRID; i++) {
        double I1 = pow(CONSTITUTIVE_MOST, (double)(i / CONSTITUTIVE_GRID) / CONSTITUTIVE_GRID);
        double I2 = pow(CONSTITUTIVE_MOST, (double)(i % CONSTITUTIVE_GRID) / (CONSTITUTIVE_GRID - 1));
        struct constitutive_point p = contract_constitutive_at(contract, I1, I2);
        bool finite = isfinite(p.e) && isfinite(p.e_1) && isfinite(p.e_2) && isfinite(p.e_11) && isfinite(p.e_12) &&
                      isfinite(p.e_22);
        contract_begin(contract, "finite for any I1, I2 from 1 to 1e6", 0.0);
        contract_error(contract, !finite, "I1 %.6g, I2 %.6g: e %.3g, e_1 %.3g, e_2 %.3g, e_11 %.3g", I1, I2, p.e, p.e_1,
                       p.e_2, p.e_11);
        if (I1 < 3.0 || I2 < 3.0) continue;
        contract_begin(contract, "e_1 + e_2 > 0 for any I1, I2 >= 3", 0.0);
        contract_error(contract, !(p.e_1 + p.e_2 > 0.0), "I1 %.6g, I2 %.6g: e_1 %.3g, e_2 %.3g", I1, I2, p.e_1, p.e_2);
    }
}

/* Energy along a path, in one direction away from rest: stretching always costs work. */
static void contract_constitutive_path(struct contract *contract, const char *name, double (*I1)(double),
                                       double (*I2)(double))
{
    double before = contract_constitutive_at(contract, 3.0, 3.0).e;
    contract_begin(contract, "energy grows with uniaxial stretch, compression and simple shear", 0.0);
    for (int i = 1; i <= 200; i++) {
        double amount = 6.9 * (i / 200.0), e = contract_constitutive_at(contract, I1(amount), I2(amount)).e;
        contract_error(contract, !(e > before), "%s of %.6g: e %.9g after %.9g", name, exp(amount), e, before);
        before = e;
    }
}

/* Invariants at a logarithmic stretch. */

static double contract_constitutive_long_1(double amount)
{
    return exp(2.0 * amount) + 2.0 * exp(-amount);
}

static double contract_constitutive_long_2(double amount)
{
    return 2.0 * exp(amount) + exp(-2.0 * amount);
}

/* The shear whose largest principal stretch it is: gamma = l - 1/l. */
static double contract_constitutive_shear(double amount)
{
    double gamma = exp(amount) - exp(-amount);
    return 3.0 + gamma * gamma;
}

static void contract_constitutive_paths(struct contract *contract)
{
    contract_constitutive_path(contract, "stretch", contract_constitutive_long_1, contract_constitutive_long_2);
    contract_constitutive_path(contract, "equal stretch in two directions", contract_constitutive_long_2,
                               contract_constitutive_long_1);
    contract_constitutive_path(contract, "shear with a stretch", contract_constitutive_shear,
                               contract_constitutive_shear);
}

/* Where the formulas end and the continuation begins. */
static void contract_constitutive_edge(struct contract *contract)
{
    const struct bulla_constitutive *law = contract->module->table;
    struct bulla_constitutive_range range = {NAN, NAN};
    char where[CONTRACT_WHERE];
    law->range(contract->self, &range);
    snprintf(where, sizeof where, "I1 to %.6g, I2 to %.6g", range.I1_max, range.I2_max);
    contract_begin(contract, "the stated range goes beyond the unstretched body", 0.0);
    contract_holds(contract, range.I1_max > 3.0 && range.I2_max > 3.0, where);
    contract_begin(contract, "energy and stress are continuous at the end of the range", 1e-6);
    for (int k = 0; k < 2; k++) {
        double end = k ? range.I2_max : range.I1_max, low = end * (1.0 - 1e-10), high = end * (1.0 + 1e-10);
        if (!isfinite(end) || !(end > 3.0)) continue;
        double across[] = {3.0, 10.0, 1e3};
        for (int i = 0; i < 3; i++) {
            struct constitutive_point a = contract_constitutive_at(contract, k ? across[i] : low, k ? low : across[i]);
            struct constitutive_point b =
                contract_constitutive_at(contract, k ? across[i] : high, k ? high : across[i]);
            double scale = fabs(a.e_1) + fabs(a.e_2);
            contract_near(contract, b.e, a.e, fabs(a.e) + scale, where);
            contract_near(contract, b.e_1, a.e_1, scale, where);
            contract_near(contract, b.e_2, a.e_2, scale, where);
        }
    }
}

/* An invariant that is not a number must not come out as a good state. */
static void contract_constitutive_nan(struct contract *contract)
{
    const struct bulla_constitutive *law = contract->module->table;
    contract_begin(contract, "NaN does not become a good energy", 0.0);
    double e = contract_constitutive_at(contract, NAN, 4.0).e;
    contract_error(contract, isfinite(e), "I1 = NaN: e %g", e);
    if (law->first_only) return;
    e = contract_constitutive_at(contract, 4.0, NAN).e;
    contract_error(contract, isfinite(e), "I2 = NaN: e %g", e);
}

/* The functions as rows. */

static void contract_constitutive_draw_row(const struct contract *contract, const struct contract_call *call,
                                           uint64_t *seed, double *in)
{
    double l[3];
    (void)contract, (void)call;
    contract_constitutive_draw(seed, l, &in[0], &in[1]);
}

static void contract_constitutive_run_energy(const struct contract *contract, const struct contract_call *call,
                                             size_t n, const double *const *in, double *const *out)
{
    const struct bulla_constitutive *law = contract->module->table;
    (void)call;
    law->energy(contract->self, n, in[0], in[1], out[0], out[1], out[2]);
}

static void contract_constitutive_run_second(const struct contract *contract, const struct contract_call *call,
                                             size_t n, const double *const *in, double *const *out)
{
    const struct bulla_constitutive *law = contract->module->table;
    (void)call;
    law->second(contract->self, n, in[0], in[1], out[0], out[1], out[2]);
}

void contract_constitutive_run(struct contract *contract)
{
    const struct bulla_constitutive *law = contract->module->table;
    const struct contract_call energy = {
        "energy", 2, 3, contract_constitutive_run_energy, contract_constitutive_draw_row, NULL};
    const struct contract_call second = {
        "second", 2, 3, contract_constitutive_run_second, contract_constitutive_draw_row, NULL};
    contract_doing(contract, "range");
    contract_constitutive_edge(contract);
    contract_doing(contract, "the unstretched body");
    contract_constitutive_rest(contract);
    contract_doing(contract, "stretches");
    contract_constitutive_states(contract);
    contract_constitutive_paths(contract);
    contract_doing(contract, "any invariants");
    contract_constitutive_everywhere(contract);
    contract_doing(contract, "NaN");
    contract_constitutive_nan(contract);
    contract_batch_run(contract, &energy);
    if (law->second) contract_batch_run(contract, &second);
}

void contract_constitutive_probe(const struct contract *contract, double out[static CONTRACT_PROBE])
{
    struct constitutive_point point = contract_constitutive_at(contract, 5.0, 4.25);
    out[0] = point.e;
    out[1] = point.e_1;
    out[2] = point.e_2;
    out[3] = point.e_11;
}
