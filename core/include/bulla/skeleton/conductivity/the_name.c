/* the_name.c - the conductivity of a liquid that rises linearly with temperature.
 *
 *     k = k0 (1 + b (T - T0)),   T - T0 no further from 0 than 50 K.
 * Yours may be any function that keeps to bulla/conductivity.h: finite and not negative wherever a solver may get,
 * without jumps. `bulla module check` tests all of that. */
#include <bulla/conductivity.h>

#include <math.h>
#include <stdlib.h>

#define THE_NAME_SPAN 50.0 /* the fit ends so many kelvins from T0 */

/* One instance: what `open` makes of the values in a case. */
struct the_name_values {
    double k, b, T;
};

/* Compare so that a NaN stays one: who asks with it must not get a good number. */
static double the_name_bounded(double x)
{
    x = x < -THE_NAME_SPAN ? -THE_NAME_SPAN : x;
    return x > THE_NAME_SPAN ? THE_NAME_SPAN : x;
}

/* Rows that `needs` does not name are NULL: here rate, p and rho. */
static void the_name_k(const void *self, size_t n, const double *BULLA_RESTRICT rate, const double *BULLA_RESTRICT T,
                       const double *BULLA_RESTRICT p, const double *BULLA_RESTRICT rho, double *BULLA_RESTRICT k)
{
    const struct the_name_values par = *(const struct the_name_values *)self;
    (void)rate, (void)p, (void)rho;
    for (size_t i = 0; i < n; i++) k[i] = par.k * (1.0 + par.b * the_name_bounded(T[i] - par.T));
}

static const struct bulla_conductivity the_name_table = {
    .k = {.size = sizeof(struct bulla_conductivity), .needs = BULLA_NEEDS_TEMPERATURE, .value = the_name_k}};

/* The keys of a case: name, SI unit, least, most, default (NAN: must be given), one sentence.
 * `open` gets the values in this order. */
enum { K, SLOPE, TEMPERATURE };

static const struct bulla_param the_name_params[] = {
    {"k", "W/m/K", 0.0, 1e6, 0.6, "conductivity at the reference temperature", BULLA_NUMBER, 0},
    {"slope", "1/K", -0.02, 0.02, 0.002, "b: relative change per kelvin", BULLA_NUMBER, 0},
    {"temperature", "K", 1.0, 1e4, 298.15, "reference temperature T0", BULLA_NUMBER, 0},
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
    self->k = values[K].number;
    self->b = values[SLOPE].number;
    self->T = values[TEMPERATURE].number;
    *ret_self = self;
    return 0;
}

BULLA_EXPORT const struct bulla_module bulla_module = {
    .magic = BULLA_MAGIC,
    .abi = BULLA_ABI,
    .size = sizeof(struct bulla_module),
    .kind = "conductivity",
    .name = "the-name",
    .version = "0.1",
    .doc = "Say what the law is. Say what material it is good for.",
    .cite = "paper and equation",
    .params = the_name_params,
    .open = the_name_open,
    .close = free,
    .table = &the_name_table,
};
