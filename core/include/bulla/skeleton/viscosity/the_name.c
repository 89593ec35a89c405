/* the_name.c - the viscosity of a liquid that thins when it is sheared and when it gets warm.
 *
 *     mu = mu0 exp(-b (T - T0))/(1 + rate/g),   T - T0 no further from 0 than 50 K.
 * Yours may be any function that keeps to bulla/viscosity.h: finite and not negative wherever a solver may get, without
 * jumps, and no more than `most`. `bulla module check` tests all of that. */
#include <bulla/viscosity.h>

#include <math.h>
#include <stdlib.h>

#define THE_NAME_SPAN 50.0 /* the fit ends so many kelvins from T0 */

/* One instance: what `open` makes of the values in a case. */
struct the_name_values {
    double mu, b, T, g, zeta;
};

/* Compare so that a NaN stays one: who asks with it must not get a good number. */
static double the_name_bounded(double x)
{
    x = x < -THE_NAME_SPAN ? -THE_NAME_SPAN : x;
    return x > THE_NAME_SPAN ? THE_NAME_SPAN : x;
}

/* Rows that `needs` does not name are NULL: here p and rho. */
static void the_name_mu(const void *self, size_t n, const double *BULLA_RESTRICT rate, const double *BULLA_RESTRICT T,
                        const double *BULLA_RESTRICT p, const double *BULLA_RESTRICT rho, double *BULLA_RESTRICT mu)
{
    const struct the_name_values par = *(const struct the_name_values *)self;
    (void)p, (void)rho;
    for (size_t i = 0; i < n; i++)
        mu[i] = par.mu * exp(-par.b * the_name_bounded(T[i] - par.T)) / (1.0 + rate[i] / par.g);
}

/* What mu never exceeds: the time step goes by it. */
static double the_name_most(const void *self)
{
    const struct the_name_values par = *(const struct the_name_values *)self;
    return par.mu * exp(par.b * THE_NAME_SPAN);
}

/* Optional: the bulk viscosity. */
static void the_name_zeta(const void *self, size_t n, const double *BULLA_RESTRICT T, const double *BULLA_RESTRICT p,
                          const double *BULLA_RESTRICT rho, double *BULLA_RESTRICT zeta)
{
    const struct the_name_values par = *(const struct the_name_values *)self;
    (void)p, (void)rho;
    for (size_t i = 0; i < n; i++) zeta[i] = par.zeta * exp(-par.b * the_name_bounded(T[i] - par.T));
}

static const struct bulla_viscosity the_name_table = {.mu = {.size = sizeof(struct bulla_viscosity),
                                                             .needs = BULLA_NEEDS_RATE | BULLA_NEEDS_TEMPERATURE,
                                                             .value = the_name_mu,
                                                             .most = the_name_most},
                                                      .zeta = the_name_zeta};

/* The keys of a case: name, SI unit, least, most, default (NAN: must be given), one sentence.
 * `open` gets the values in this order. */
enum { MU, THINNING, TEMPERATURE, RATE, ZETA };

static const struct bulla_param the_name_params[] = {
    {"mu", "Pa s", 0.0, 1e6, 1e-3, "viscosity at rest and at the reference temperature", BULLA_NUMBER, 0},
    {"thinning", "1/K", 0.0, 0.1, 0.02, "b: relative loss of viscosity per kelvin", BULLA_NUMBER, 0},
    {"temperature", "K", 1.0, 1e4, 298.15, "reference temperature T0", BULLA_NUMBER, 0},
    {"rate", "1/s", 1e-6, 1e12, 1e3, "g: rate of shear at which half of the viscosity is left", BULLA_NUMBER, 0},
    {"zeta", "Pa s", 0.0, 1e6, 0.0, "bulk viscosity at the reference temperature", BULLA_NUMBER, 0},
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
    self->mu = values[MU].number;
    self->b = values[THINNING].number;
    self->T = values[TEMPERATURE].number;
    self->g = values[RATE].number;
    self->zeta = values[ZETA].number;
    *ret_self = self;
    return 0;
}

BULLA_EXPORT const struct bulla_module bulla_module = {
    .magic = BULLA_MAGIC,
    .abi = BULLA_ABI,
    .size = sizeof(struct bulla_module),
    .kind = "viscosity",
    .name = "the-name",
    .version = "0.1",
    .doc = "Say what the law is. Say what liquid it is good for.",
    .cite = "paper and equation",
    .params = the_name_params,
    .open = the_name_open,
    .close = free,
    .table = &the_name_table,
};
