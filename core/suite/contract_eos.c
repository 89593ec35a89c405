/* contract_eos.c - see contract_eos.h.
 *
 * Everything follows from rho e(rho, p): its derivatives are compared with differences, and rho c^2,
 * T and s with the identities (v = 1/rho, h = e + p/rho)
 *     c^2 = (h - d(rho e)/drho)/(d(rho e)/dp),    T ds = de + p dv.
 * A law that passes is one potential. Where continuations begin and end, rho e has no jump: contract_line.h. */
#include "suite/contract_eos.h"

#include "suite/contract_batch.h"
#include "suite/contract_dome.h"
#include "suite/contract_line.h"
#include "suite/contract_point.h"

#include <math.h>
#include <stdio.h>

enum { EOS_STATES = 200 };

/* A step in p for differences: small beside p - p_min, and so small that T hardly changes. */
static double contract_eos_step(const struct contract_points *suite, double rho, double p)
{
    double dp = 1e-4 * (p - contract_point_p_min(suite, rho)), T = contract_point_temperature(suite, rho, p);
    double change = fabs(contract_point_temperature(suite, rho, p + dp) - T);
    return change > 1e-4 * T ? dp * 1e-4 * T / change : dp;
}

/* Differences of rho e and s against derivatives; a difference of large numbers over a small
 * step has round-off of its own, which counts as size. */
static void contract_eos_differences(const struct contract_points *suite, double rho, double p, const char *where)
{
    struct contract *contract = suite->contract;
    struct contract_point here = contract_point_at(suite, rho, p);
    double dp = contract_eos_step(suite, rho, p), dr = 1e-5 * rho;
    struct contract_point up = contract_point_at(suite, rho, p + dp), down = contract_point_at(suite, rho, p - dp);
    struct contract_point dense = contract_point_at(suite, rho + dr, p), thin = contract_point_at(suite, rho - dr, p);
    double h = (here.rho_e + p) / rho, e = here.rho_e / rho, noise = 1e-9 * fabs(here.rho_e);
    double size = fabs(here.de_drho) + fabs(e) + here.c2 * here.de_dp;
    contract_begin(contract, "d(rho e)/dp is the slope of rho e", 1e-6);
    contract_near(contract, (up.rho_e - down.rho_e) / (2 * dp), here.de_dp, here.de_dp + noise / dp, where);
    contract_begin(contract, "d(rho e)/drho is the slope of rho e", 1e-6);
    contract_near(contract, (dense.rho_e - thin.rho_e) / (2 * dr), here.de_drho, size, where);
    contract_begin(contract, "c^2 = (h - d(rho e)/drho)/(d(rho e)/dp)", 1e-6);
    contract_near(contract, (h - here.de_drho) / here.de_dp, here.c2, here.c2 + fabs(e) * 1e-9 / here.de_dp, where);
    double heat = here.T * rho, dull = 1e-9 * heat * fabs(here.s);
    contract_begin(contract, "T ds = de + p dv along p", 1e-6);
    contract_near(contract, (up.s - down.s) / (2 * dp) * heat, here.de_dp, here.de_dp + dull / dp, where);
    contract_begin(contract, "T ds = de + p dv along rho", 1e-6);
    contract_near(contract, (dense.s - thin.s) / (2 * dr) * heat, here.de_drho - h, size + dull / dr, where);
}

static void contract_eos_inverse(const struct contract_points *suite, double rho, double p, const char *where)
{
    double T = contract_point_temperature(suite, rho, p), back = NAN;
    suite->eos->density(suite->self, 1, &p, &T, &back);
    contract_begin(suite->contract, "density(p, T) inverts temperature(rho, p)", 1e-9);
    contract_near(suite->contract, back, rho, rho, where);
}

static void contract_eos_linear(const struct contract_points *suite, double rho, double p, const char *where)
{
    contract_begin(suite->contract, "linear: a p + b is rho e, a is d(rho e)/dp, bitwise", 0.0);
    if (!suite->eos->linear) return;
    double a = NAN, b = NAN;
    suite->eos->linear(suite->self, 1, &rho, &a, &b);
    struct contract_point point = contract_point_at(suite, rho, p);
    contract_holds(suite->contract, a * p + b == point.rho_e && a == point.de_dp, where);
}

static void contract_eos_energy(const struct contract_points *suite, double rho, double p, const char *where)
{
    if (!BULLA_EOS_HAS(suite->eos, energy)) return;
    double rho_e = NAN, de_dp = NAN;
    contract_begin(suite->contract, "energy: what state and derivatives give, bitwise", 0.0);
    suite->eos->energy(suite->self, 1, &rho, &p, &rho_e, &de_dp);
    struct contract_point point = contract_point_at(suite, rho, p);
    contract_holds(suite->contract, rho_e == point.rho_e && de_dp == point.de_dp, where);
}

struct contract_eos_thermal {
    double rho, v, h, s, v_T, v_p, c_p, g;
};

static struct contract_eos_thermal contract_eos_thermal_at(const struct contract_points *suite, double p, double T,
                                                           double guess)
{
    struct contract_eos_thermal at = {.rho = guess};
    suite->eos->thermal(suite->self, 1, &p, &T, &at.rho, &at.v, &at.h, &at.s, &at.v_T, &at.v_p, &at.c_p);
    at.g = at.h - T * at.s;
    return at;
}

/* `thermal` against the other functions at the same state. */
static void contract_eos_thermal_same(const struct contract_points *suite, double rho, double p, double T,
                                      const char *where)
{
    struct contract *contract = suite->contract;
    struct contract_point here = contract_point_at(suite, rho, p);
    struct contract_eos_thermal at = contract_eos_thermal_at(suite, p, T, 0.0);
    double energy = fabs(at.h) + (fabs(here.rho_e) + p) / rho, spread = here.de_dp * here.c2;
    double c2 = at.v * at.v / (-at.v_p - T * at.v_T * at.v_T / at.c_p);
    /* No closer than a table of 128 nodes is to the formulas of which `thermal` may be. */
    contract_begin(contract, "thermal(p, T): density, enthalpy and entropy of the other functions", 1e-6);
    contract_near(contract, at.rho, rho, rho, where);
    contract_near(contract, at.v * at.rho, 1.0, 1.0, where);
    contract_near(contract, at.h, (here.rho_e + p) / rho, energy + spread, where);
    contract_near(contract, at.s, here.s, fabs(here.s) + at.c_p, where);
    contract_begin(contract, "thermal(p, T): c^2 = v^2/(-v_p - T v_T^2/c_p)", 1e-6);
    contract_near(contract, c2, here.c2, here.c2 * (1.0 + 1e-6 * at.c_p * T / here.c2), where);
    contract_begin(contract, "thermal(p, T) starts from any density", 1e-9);
    contract_near(contract, contract_eos_thermal_at(suite, p, T, rho).v, at.v, at.v, where);
}

/* States two steps and one below, one and two above. */
static void contract_eos_around(const struct contract_points *suite, double p, double T, double rho,
                                const double step[2], struct contract_eos_thermal ret_at[4])
{
    for (int k = 0, by = -2; k < 4; k++, by += by == -1 ? 2 : 1)
        ret_at[k] = contract_eos_thermal_at(suite, p + by * step[0], T + by * step[1], rho);
}

/* A slope, to fourth order. */
#define CONTRACT_EOS_SLOPE(x, what, step) ((8.0 * (x[2].what - x[1].what) - (x[3].what - x[0].what)) / (12.0 * (step)))

/* Its derivatives, as those of one potential g = h - T s; rounding of differences counts as size. */
static void contract_eos_thermal_slopes(const struct contract_points *suite, double rho, double p, double T,
                                        const char *where)
{
    struct contract *contract = suite->contract;
    struct contract_eos_thermal at = contract_eos_thermal_at(suite, p, T, 0.0), warm[4], press[4];
    double dT = 2e-4 * T, dp = 2e-4 * (p - contract_point_p_min(suite, rho));
    contract_eos_around(suite, p, T, rho, (const double[]){0.0, dT}, warm);
    contract_eos_around(suite, p, T, rho, (const double[]){dp, 0.0}, press);
    double noise = 1e-9 * (fabs(at.h) + T * fabs(at.s)), order = fabs(at.s) + at.c_p;
    contract_begin(contract, "thermal(p, T): one potential, g_p = v, g_T = -s", 1e-6);
    contract_near(contract, CONTRACT_EOS_SLOPE(press, g, dp), at.v, at.v + noise / dp, where);
    contract_near(contract, CONTRACT_EOS_SLOPE(warm, g, dT), -at.s, order + noise / dT, where);
    contract_begin(contract, "thermal(p, T): h_T = c_p, s_T = c_p/T, h_p = v - T v_T, s_p = -v_T", 1e-6);
    contract_near(contract, CONTRACT_EOS_SLOPE(warm, h, dT), at.c_p, at.c_p + 1e-9 * fabs(at.h) / dT, where);
    contract_near(contract, CONTRACT_EOS_SLOPE(warm, s, dT) * T, at.c_p, at.c_p + 1e-9 * order * T / dT, where);
    contract_near(contract, CONTRACT_EOS_SLOPE(press, h, dp), at.v - T * at.v_T,
                  at.v + T * fabs(at.v_T) + 1e-9 * fabs(at.h) / dp, where);
    contract_near(contract, CONTRACT_EOS_SLOPE(press, s, dp), -at.v_T, fabs(at.v_T) + at.v / T + 1e-9 * order / dp,
                  where);
    contract_begin(contract, "thermal(p, T): v_T and v_p are slopes of v", 1e-6);
    contract_near(contract, CONTRACT_EOS_SLOPE(warm, v, dT), at.v_T, fabs(at.v_T) + at.v / T, where);
    contract_near(contract, CONTRACT_EOS_SLOPE(press, v, dp), at.v_p, -at.v_p + 1e-9 * at.v / dp, where);
}

static void contract_eos_thermal(const struct contract_points *suite, double rho, double p, const char *where)
{
    if (!BULLA_EOS_HAS(suite->eos, thermal) || contract_dome_outside(suite->eos, suite->self, rho, p)) return;
    double T = contract_point_temperature(suite, rho, p);
    contract_eos_thermal_same(suite, rho, p, T, where);
    contract_eos_thermal_slopes(suite, rho, p, T, where);
}

/* A gas constant is that of the dilute gas. */
static void contract_eos_gas(const struct contract_points *suite)
{
    char where[CONTRACT_WHERE];
    const struct bulla_eos *eos = suite->eos;
    if (!BULLA_EOS_HAS(eos, gas_constant)) return;
    double R = eos->gas_constant(suite->self), T = 0.5 * (suite->range.T_min + suite->range.T_max), p = 1e-3;
    contract_begin(suite->contract, "gas_constant: 0, or the limit of p v/T", 1e-6);
    contract_holds(suite->contract, R >= 0.0 && isfinite(R), "gas_constant is not finite, or negative");
    if (!(R > 0.0) || !BULLA_EOS_HAS(eos, thermal)) return;
    snprintf(where, sizeof where, "p %.6g, T %.6g", p, T);
    contract_near(suite->contract, p * contract_eos_thermal_at(suite, p, T, 0.0).v / T, R, R, where);
}

/* A continuation stands in for the formulas beyond the stated range only, or in the dome that a vapour's range cannot
 * leave out. */
static void contract_eos_counting(const struct contract_points *suite, double rho, double p, const char *where)
{
    const struct bulla_eos_range *range = &suite->range;
    double T = contract_point_temperature(suite, rho, p);
    bool inside = rho >= range->rho_min && rho <= range->rho_max && p >= range->p_min && p <= range->p_max &&
                  T >= range->T_min && T <= range->T_max;
    contract_begin(suite->contract, "count_outside: 0 in the stated range, but for the dome of a vapour", 0.0);
    if (inside && BULLA_EOS_HAS(suite->eos, count_outside))
        contract_holds(suite->contract, contract_dome_fair(suite->eos, suite->self, rho, p, range->p_max), where);
}

static bool contract_eos_well_posed(struct contract_point point)
{
    bool finite = isfinite(point.rho_e) && isfinite(point.c2) && isfinite(point.T) && isfinite(point.s) &&
                  isfinite(point.de_dp) && isfinite(point.de_drho);
    return finite && point.de_dp > 0.0 && point.c2 > 0.0 && point.T > 0.0;
}

static void contract_eos_judge(const struct contract_points *suite, double rho, double p)
{
    struct contract_point point = contract_point_at(suite, rho, p);
    contract_error(suite->contract, !contract_eos_well_posed(point),
                   "rho %.6g, p %.6g: d(rho e)/dp %.3g, c^2 %.3g, T %.3g", rho, p, point.de_dp, point.c2, point.T);
}

/* Identities at states of the box. */
static void contract_eos_states(const struct contract_points *suite)
{
    uint64_t seed = 1;
    for (int i = 0; i < EOS_STATES; i++) {
        char where[64];
        double rho, p;
        bool found = contract_point_draw(suite, &seed, &rho, &p);
        contract_begin(suite->contract, "there are states in the stated range", 0.0);
        contract_holds(suite->contract, found, "no density and pressure of `range` gives a temperature of `range`");
        if (!found) return;
        snprintf(where, sizeof where, "rho %.6g, p %.6g", rho, p);
        contract_begin(suite->contract, "well-posed in the stated range", 0.0);
        contract_eos_judge(suite, rho, p);
        contract_eos_counting(suite, rho, p, where);
        if (contract_dome(suite->eos, suite->self, rho, p, suite->range.p_max)) continue; /* no state of a vapour */
        contract_eos_differences(suite, rho, p, where);
        contract_eos_inverse(suite, rho, p, where);
        contract_eos_linear(suite, rho, p, where);
        contract_eos_energy(suite, rho, p, where);
        contract_eos_thermal(suite, rho, p, where);
    }
}

/* Any density and any pressure above p_min: solvers get there, in traces of a material at least. */
static void contract_eos_everywhere(const struct contract_points *suite)
{
    double most = suite->box->rho[1] * 1.5 > 4600.0 ? suite->box->rho[1] * 1.5 : 4600.0;
    contract_begin(suite->contract, "well-posed for any rho > 0, p > p_min", 0.0);
    for (double rho = 1e-3; rho < most; rho *= 1.01) {
        double p_min = contract_point_p_min(suite, rho);
        for (double above = 1e-3; above < 1e11; above *= 10.0)
            if (above > 1e-9 * fabs(p_min)) contract_eos_judge(suite, rho, p_min + above);
    }
}

/* At and below p_min the value says so; nothing traps. */
static void contract_eos_below(const struct contract_points *suite)
{
    contract_begin(suite->contract, "rho c^2 <= 0 at and below p_min", 0.0);
    for (int i = 0; i < 20; i++) {
        double rho = suite->box->rho[0] * pow(suite->box->rho[1] / suite->box->rho[0], (i + 0.5) / 20.0);
        double p_min = contract_point_p_min(suite, rho), p = p_min - 1e-3 * fabs(p_min) - 1e3;
        if (!isfinite(p_min)) continue;
        double edge = contract_point_at(suite, rho, p_min).stiffness,
               usual = contract_point_at(suite, rho, fabs(p_min) + 1e5).stiffness;
        contract_error(suite->contract, !(edge <= 1e-9 * usual), "rho %.6g at p_min = %.6g: rho c^2 %.3g", rho, p_min,
                       edge);
        double below = contract_point_at(suite, rho, p).stiffness;
        contract_error(suite->contract, below > 0.0, "rho %.6g, p %.6g below p_min: rho c^2 %.3g", rho, p, below);
    }
}

/* A pressure that is not a number must not come out as a good state. */
static void contract_eos_nan(const struct contract_points *suite)
{
    double rho = sqrt(suite->box->rho[0] * suite->box->rho[1]), p = NAN, rho_e, stiffness;
    suite->eos->state(suite->self, 1, &rho, &p, &rho_e, &stiffness);
    contract_begin(suite->contract, "p = NaN does not become a good state", 0.0);
    contract_error(suite->contract, stiffness > 0.0 && isfinite(rho_e), "rho %g, p NaN: rho e %g, rho c^2 %g", rho,
                   rho_e, stiffness);
}

static void contract_eos_range(const struct contract_points *suite)
{
    char where[CONTRACT_WHERE];
    const struct bulla_eos_range *range = &suite->range;
    double lowest = contract_point_p_min(suite, range->rho_max);
    snprintf(where, sizeof where, "rho %.4g to %.4g, p %.4g to %.4g, T %.4g to %.4g; p_min %.4g", range->rho_min,
             range->rho_max, range->p_min, range->p_max, range->T_min, range->T_max, lowest);
    bool ordered = range->rho_min < range->rho_max && range->p_min < range->p_max && range->T_min < range->T_max;
    bool sane = range->rho_min >= 0.0 && range->T_min >= 0.0 && isfinite(range->rho_max) && isfinite(range->p_max);
    contract_begin(suite->contract, "the stated range is one, above p_min", 0.0);
    contract_holds(suite->contract, ordered && sane && range->p_min >= lowest, where);
}

/* The functions as rows; `context` of a call is the suite. */
static void contract_eos_draw_state(const struct contract *contract, const struct contract_call *call, uint64_t *seed,
                                    double *in)
{
    (void)contract;
    contract_point_draw(call->context, seed, &in[0], &in[1]);
}

static void contract_eos_draw_pT(const struct contract *contract, const struct contract_call *call, uint64_t *seed,
                                 double *in)
{
    double rho = NAN, p = NAN;
    (void)contract;
    contract_point_draw(call->context, seed, &rho, &p);
    in[0] = p;
    in[1] = contract_point_temperature(call->context, rho, p);
}

#define CONTRACT_EOS_RUN(name, ...)                                                                                  \
    static void contract_eos_run_##name(const struct contract *contract, const struct contract_call *call, size_t n, \
                                        const double *const *in, double *const *out)                                 \
    {                                                                                                                \
        const struct bulla_eos *eos = contract->module->table;                                                       \
        (void)call;                                                                                                  \
        eos->name(contract->self, n, in[0], __VA_ARGS__);                                                            \
    }

CONTRACT_EOS_RUN(state, in[1], out[0], out[1])
CONTRACT_EOS_RUN(derivatives, in[1], out[0], out[1])
CONTRACT_EOS_RUN(temperature, in[1], out[0])
CONTRACT_EOS_RUN(entropy, in[1], out[0])
CONTRACT_EOS_RUN(density, in[1], out[0])
CONTRACT_EOS_RUN(p_min, out[0])
CONTRACT_EOS_RUN(linear, out[0], out[1])
CONTRACT_EOS_RUN(energy, in[1], out[0], out[1])

static void contract_eos_run_thermal(const struct contract *contract, const struct contract_call *call, size_t n,
                                     const double *const *in, double *const *out)
{
    const struct bulla_eos *eos = contract->module->table;
    (void)call;
    for (size_t i = 0; i < n; i++) out[0][i] = 0.0; /* no density to start from */
    eos->thermal(contract->self, n, in[0], in[1], out[0], out[1], out[2], out[3], out[4], out[5], out[6]);
}

static void contract_eos_rows(const struct contract_points *suite)
{
    const struct contract_call calls[] = {
        {"state", 2, 2, contract_eos_run_state, contract_eos_draw_state, suite},
        {"derivatives", 2, 2, contract_eos_run_derivatives, contract_eos_draw_state, suite},
        {"temperature", 2, 1, contract_eos_run_temperature, contract_eos_draw_state, suite},
        {"entropy", 2, 1, contract_eos_run_entropy, contract_eos_draw_state, suite},
        {"density", 2, 1, contract_eos_run_density, contract_eos_draw_pT, suite},
        {"p_min", 2, 1, contract_eos_run_p_min, contract_eos_draw_state, suite},
        {"linear", 2, 2, contract_eos_run_linear, contract_eos_draw_state, suite},
        {"energy", 2, 2, contract_eos_run_energy, contract_eos_draw_state, suite},
        {"thermal", 2, 7, contract_eos_run_thermal, contract_eos_draw_pT, suite},
    };
    for (size_t i = 0; i < sizeof calls / sizeof *calls; i++) {
        if (calls[i].run == contract_eos_run_linear && !suite->eos->linear) continue;
        if (calls[i].run == contract_eos_run_energy && !BULLA_EOS_HAS(suite->eos, energy)) continue;
        if (calls[i].run == contract_eos_run_thermal && !BULLA_EOS_HAS(suite->eos, thermal)) continue;
        contract_batch_run(suite->contract, &calls[i]);
    }
}

void contract_eos_run_in(struct contract *contract, const struct contract_eos_box *box)
{
    struct contract_points suite = {.contract = contract,
                                    .eos = contract->module->table,
                                    .self = contract->self,
                                    .box = box};
    contract_doing(contract, "range");
    suite.eos->range(contract->self, &suite.range);
    contract_eos_range(&suite);
    contract_doing(contract, "states of the range");
    contract_eos_states(&suite);
    contract_eos_gas(&suite);
    contract_doing(contract, "any rho and p");
    contract_eos_everywhere(&suite);
    contract_doing(contract, "lines of constant rho and p");
    contract_line_all(&suite);
    contract_doing(contract, "states below p_min");
    contract_eos_below(&suite);
    contract_doing(contract, "p = NaN");
    contract_eos_nan(&suite);
    contract_eos_rows(&suite);
}

void contract_eos_run(struct contract *contract)
{
    const struct bulla_eos *eos = contract->module->table;
    struct bulla_eos_range range = {0};
    eos->range(contract->self, &range);
    double thin = 1e-6 * range.rho_max;
    struct contract_eos_box box = {.rho = {range.rho_min > thin ? range.rho_min : thin, range.rho_max},
                                   .p_least = range.p_min,
                                   .p_most = range.p_max,
                                   .T = {range.T_min, range.T_max}};
    contract_eos_run_in(contract, &box);
}

void contract_eos_probe(const struct contract *contract, double out[static CONTRACT_PROBE])
{
    const struct bulla_eos *eos = contract->module->table;
    const double rho = 900.0, p = 1e7;
    eos->state(contract->self, 1, &rho, &p, &out[0], &out[1]);
    eos->temperature(contract->self, 1, &rho, &p, &out[2]);
}
