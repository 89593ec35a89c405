/* the_name.c - an equation of state: a stiffened gas, to be changed into your law.
 *
 * A law gives everything as a function of density rho and pressure p, for rows of n points. Here
 *     rho e = (p + gamma p_inf)/(gamma - 1),     rho c^2 = gamma (p + p_inf),
 *     T = (p + p_inf)/((gamma - 1) cv rho),      s = cv ln(T rho^(1 - gamma)).
 * Whatever yours is: all functions must belong to one rho e(rho, p), for core uses them together.
 * `bulla module check` tests that with differences; bulla/eos.h says what each must do. */
#include <bulla/eos.h>

#include <math.h>
#include <stdlib.h>

/* One instance: what `open` makes of the values in a case. Two materials with this law have one each. */
struct the_name_values {
    double gamma, p_inf, cv;
};

/* The hot call. Rows of plain arithmetic become vectors; `pow` and `log` keep them scalar, which is fine
 * too: leave out BULLA_KERNEL and the pragma then. */
BULLA_KERNEL static void the_name_state(const void *self, size_t n, const double *BULLA_RESTRICT rho,
                                        const double *BULLA_RESTRICT p, double *BULLA_RESTRICT rho_e,
                                        double *BULLA_RESTRICT rho_c2)
{
    const struct the_name_values par = *(const struct the_name_values *)self;
    const double a = 1.0 / (par.gamma - 1.0), b = par.gamma * par.p_inf * a;
    (void)rho;
#pragma omp simd
    for (size_t i = 0; i < n; i++) {
        double pressure = p[i];
        rho_e[i] = a * pressure + b;
        rho_c2[i] = par.gamma * (pressure + par.p_inf);
    }
}

/* d(rho e)/dp at constant rho, d(rho e)/drho at constant p. */
static void the_name_derivatives(const void *self, size_t n, const double *BULLA_RESTRICT rho,
                                 const double *BULLA_RESTRICT p, double *BULLA_RESTRICT de_dp,
                                 double *BULLA_RESTRICT de_drho)
{
    const struct the_name_values *par = self;
    (void)rho, (void)p;
    for (size_t i = 0; i < n; i++) {
        de_dp[i] = 1.0 / (par->gamma - 1.0);
        de_drho[i] = 0.0;
    }
}

static void the_name_temperature(const void *self, size_t n, const double *BULLA_RESTRICT rho,
                                 const double *BULLA_RESTRICT p, double *BULLA_RESTRICT T)
{
    const struct the_name_values *par = self;
    for (size_t i = 0; i < n; i++) T[i] = (p[i] + par->p_inf) / ((par->gamma - 1.0) * par->cv * rho[i]);
}

/* Up to a constant: only its changes count. T ds = de + p d(1/rho) must hold. */
static void the_name_entropy(const void *self, size_t n, const double *BULLA_RESTRICT rho,
                             const double *BULLA_RESTRICT p, double *BULLA_RESTRICT s)
{
    const struct the_name_values *par = self;
    for (size_t i = 0; i < n; i++)
        s[i] = par->cv * (log((p[i] + par->p_inf) / rho[i]) - (par->gamma - 1.0) * log(rho[i]));
}

/* The inverse of temperature: initial states may be given by p and T. */
static void the_name_density(const void *self, size_t n, const double *BULLA_RESTRICT p, const double *BULLA_RESTRICT T,
                             double *BULLA_RESTRICT rho)
{
    const struct the_name_values *par = self;
    for (size_t i = 0; i < n; i++) rho[i] = (p[i] + par->p_inf) / ((par->gamma - 1.0) * par->cv * T[i]);
}

/* The pressure at which rho c^2 ends. */
static void the_name_p_min(const void *self, size_t n, const double *BULLA_RESTRICT rho, double *BULLA_RESTRICT p)
{
    const struct the_name_values *par = self;
    (void)rho;
    for (size_t i = 0; i < n; i++) p[i] = -par->p_inf;
}

/* rho e = a p + b at fixed density: mixtures then need no iteration. Where a law is not linear in p, leave
 * this function and its line in the table out. Bit by bit what `state` gives. */
static void the_name_linear(const void *self, size_t n, const double *BULLA_RESTRICT rho, double *BULLA_RESTRICT a,
                            double *BULLA_RESTRICT b)
{
    const struct the_name_values *par = self;
    const double slope = 1.0 / (par->gamma - 1.0), rest = par->gamma * par->p_inf * slope;
    (void)rho;
    for (size_t i = 0; i < n; i++) {
        a[i] = slope;
        b[i] = rest;
    }
}

/* Where the formulas are backed by data: here water. Beyond it they must stay well-posed all the same. */
static void the_name_range(const void *self, struct bulla_eos_range *ret_range)
{
    const struct the_name_values *par = self;
    *ret_range = (struct bulla_eos_range){
        .rho_min = 500.0, .rho_max = 2000.0, .p_min = -par->p_inf, .p_max = 1e10, .T_min = 250.0, .T_max = 1000.0};
}

static const struct bulla_eos the_name_table = {.size = sizeof(struct bulla_eos),
                                                .state = the_name_state,
                                                .derivatives = the_name_derivatives,
                                                .temperature = the_name_temperature,
                                                .entropy = the_name_entropy,
                                                .density = the_name_density,
                                                .p_min = the_name_p_min,
                                                .linear = the_name_linear,
                                                .range = the_name_range};

/* The keys of a case: name, SI unit, least, most, default (NAN: must be given), one sentence. Order matters:
 * `open` gets the values in this one. */
enum { GAMMA, P_INF, CV };

static const struct bulla_param the_name_params[] = {
    {"gamma", "1", 1.0001, 100.0, 4.4, "exponent", BULLA_NUMBER, 0},
    {"p-inf", "Pa", 0.0, 1e13, 6e8, "attraction: at the pressure -p-inf the sound speed is zero", BULLA_NUMBER, 0},
    {"cv", "J/kg/K", 1e-3, 1e9, 590.0, "specific heat at constant volume", BULLA_NUMBER, 0},
    {0},
};

/* To refuse values that the table cannot: host->fail("why"); return 1. */
static int the_name_open(const struct bulla_host *host, const struct bulla_value *values, void **ret_self)
{
    struct the_name_values *self = malloc(sizeof *self);
    if (!self) {
        host->fail("out of memory");
        return 1;
    }
    self->gamma = values[GAMMA].number;
    self->p_inf = values[P_INF].number;
    self->cv = values[CV].number;
    *ret_self = self;
    return 0;
}

BULLA_EXPORT const struct bulla_module bulla_module = {
    .magic = BULLA_MAGIC,
    .abi = BULLA_ABI,
    .size = sizeof(struct bulla_module),
    .kind = "eos",
    .name = "the-name",
    .version = "0.1",
    .doc = "Say what the law is. Say what it is good for.",
    .cite = "paper and equation",
    .params = the_name_params,
    .open = the_name_open,
    .close = free,
    .table = &the_name_table,
};
