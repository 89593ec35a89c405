/* the_name.c - the strength of a solid: Voce's law, which saturates.
 *
 *     Y = Y1 - (Y1 - Y0) exp(-eps/eps0)
 * Yours may look at plastic strain, its rate, pressure, temperature and density, and says in `needs` at which; core
 * does the tensors. It keeps to bulla/inelastic.h: finite and not negative wherever a solver may get, never falling
 * with the rate. `bulla module check` tests all of that. */
#include <bulla/inelastic.h>

#include <math.h>
#include <stdlib.h>

/* One instance: what `open` makes of the values in a case. */
struct the_name_values {
    double first, last, per_strain;
};

static void the_name_strength(const void *self, size_t n, const double *BULLA_RESTRICT eps,
                              const double *BULLA_RESTRICT rate, const double *BULLA_RESTRICT p,
                              const double *BULLA_RESTRICT T, const double *BULLA_RESTRICT rho,
                              double *BULLA_RESTRICT Y)
{
    const struct the_name_values par = *(const struct the_name_values *)self;
    (void)rate, (void)p, (void)T, (void)rho;
    for (size_t i = 0; i < n; i++) Y[i] = par.last - (par.last - par.first) * exp(-eps[i] * par.per_strain);
}

/* What it looks at: the rows of all else are zeros. */
static uint32_t the_name_needs(const void *self)
{
    (void)self;
    return BULLA_INELASTIC_STRAIN;
}

static const struct bulla_inelastic the_name_table = {.size = sizeof(struct bulla_inelastic),
                                                      .strength = the_name_strength,
                                                      .needs = the_name_needs};

/* The keys of a case: name, SI unit, least, most, default (NAN: must be given), one sentence.
 * `open` gets the values in this order. */
enum { YIELD, SATURATION, STRAIN };

static const struct bulla_param the_name_params[] = {
    {"yield", "Pa", 1e-3, 1e13, 100e6, "Y0: stress at which the unstrained solid flows", BULLA_NUMBER, 0},
    {"saturation", "Pa", 1e-3, 1e13, 200e6, "Y1: stress that it hardens to", BULLA_NUMBER, 0},
    {"strain", "1", 1e-6, 1e3, 0.1, "eps0: plastic strain that takes most of the way", BULLA_NUMBER, 0},
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
    self->first = values[YIELD].number;
    self->last = values[SATURATION].number;
    self->per_strain = 1.0 / values[STRAIN].number;
    *ret_self = self;
    return 0;
}

BULLA_EXPORT const struct bulla_module bulla_module = {
    .magic = BULLA_MAGIC,
    .abi = BULLA_ABI,
    .size = sizeof(struct bulla_module),
    .kind = "inelastic",
    .name = "the-name",
    .version = "0.1",
    .doc = "Say what the law is. Say what solid it is good for.",
    .cite = "paper and equation",
    .params = the_name_params,
    .open = the_name_open,
    .close = free,
    .table = &the_name_table,
};
