/* cochran_chan.c - condensed explosives and metals under shocks: the law of Cochran and Chan,
 *
 *     p_r = A1 x^E1 - A2 x^E2,   e_r = -integral of p_r dv from rho0 on,   x = rho/rho0,
 *
 * with a constant Grueneisen coefficient G off the curve (shared/reference_rows.h); T = (e - e_r)/cv, so that the curve
 * is the isentrope of T = 0 and p = 0 at rho0 belongs to T = (A2 - A1)/(G rho0 cv), 300 K for the presets. */
#include "bulla/eos.h"
#include "shared/elementary.h"

struct reference {
    double rho0, A1, A2, E1, E2, G, cv;
    double T0, scale; /* 0, 1 K */
};

struct reference_curve {
    double x, p, energy, stiffness;
};

/* rho e_r = A1 (x^E1 - x)/(E1 - 1) - A2 (x^E2 - x)/(E2 - 1) */
ELEMENTARY_INLINE struct reference_curve cochran_chan_curve(const struct reference *par, double rho)
{
    double x = rho / par->rho0, a = par->A1 * elementary_pow(x, par->E1), b = par->A2 * elementary_pow(x, par->E2);
    double energy = (a - par->A1 * x) / (par->E1 - 1.0) - (b - par->A2 * x) / (par->E2 - 1.0);
    return (struct reference_curve){x, a - b, energy, par->E1 * a - par->E2 * b};
}

ELEMENTARY_INLINE double cochran_chan_guess(const struct reference *par, double p, double T)
{
    (void)p;
    (void)T;
    return par->rho0;
}

#define REFERENCE_CURVE cochran_chan_curve
#define REFERENCE_GUESS cochran_chan_guess
#include "shared/reference_rows.h"

/* Around the density of rest, under shocks. */
static void cochran_chan_range(const void *self, struct bulla_eos_range *ret_range)
{
    const struct reference *par = self;
    *ret_range = (struct bulla_eos_range){.rho_min = 0.9 * par->rho0,
                                          .rho_max = 1.7 * par->rho0,
                                          .p_min = -1e8,
                                          .p_max = 1e11,
                                          .T_min = 250.0,
                                          .T_max = 3000.0};
}

static const struct bulla_eos cochran_chan_table = REFERENCE_TABLE(cochran_chan_range);

enum { RHO0, A1, A2, E1, E2, GRUENEISEN, CV };

static const struct bulla_param cochran_chan_params[] = {
    {"reference-density", "kg/m3", 1.0, 1e5, NAN, "density at rest", BULLA_NUMBER, NULL},
    {"a1", "Pa", 0.0, 1e14, NAN, "A1", BULLA_NUMBER, NULL},
    {"a2", "Pa", 0.0, 1e14, NAN, "A2", BULLA_NUMBER, NULL},
    {"e1", "1", 1.01, 20.0, NAN, "E1", BULLA_NUMBER, NULL},
    {"e2", "1", 1.01, 20.0, NAN, "E2", BULLA_NUMBER, NULL},
    {"grueneisen", "1", 0.01, 5.0, NAN, "Grueneisen coefficient G off the curve", BULLA_NUMBER, NULL},
    {"cv", "J/kg/K", 1.0, 1e6, NAN, "specific heat at constant volume; only temperatures depend on it", BULLA_NUMBER,
     NULL},
    {0},
};

/* As Saurel & Abgrall use them; written down from memory, and tested for what they must say: no pressure at 300 K. */
static const struct bulla_preset cochran_chan_presets[] = {
    {"nitromethane", "liquid nitromethane",
     (const double[]){1134.0, 0.819181e9, 1.50835e9, 4.52969, 1.42144, 1.19, 1714.0}},
    {"copper", "copper, without its strength", (const double[]){8900.0, 145.67e9, 147.75e9, 2.99, 1.99, 2.0, 393.0}},
    {"tnt", "solid TNT, without its strength", (const double[]){1840.0, 12.871e9, 13.425e9, 4.1, 3.1, 0.93, 1087.0}},
    {0},
};

static int cochran_chan_open(const struct bulla_host *host, const struct bulla_value *values, void **ret_self)
{
    struct reference par = {.rho0 = values[RHO0].number,
                            .A1 = values[A1].number,
                            .A2 = values[A2].number,
                            .E1 = values[E1].number,
                            .E2 = values[E2].number,
                            .G = values[GRUENEISEN].number,
                            .cv = values[CV].number,
                            .scale = 1.0};
    if (par.A1 * par.E1 > par.A2 * par.E2) return reference_rows_keep(host, &par, ret_self);
    host->fail("a1 e1 must be above a2 e2: else the curve gets softer where it is compressed");
    return 1;
}

BULLA_EXPORT const struct bulla_module bulla_module = {
    .magic = BULLA_MAGIC,
    .abi = BULLA_ABI,
    .size = sizeof bulla_module,
    .kind = "eos",
    .name = "cochran-chan",
    .version = "1.0",
    .doc = "Cochran-Chan: condensed explosives and metals under shocks, as fluids.",
    .cite = "Cochran & Chan, UCID-18024 (1979); Saurel & Abgrall, J. Comput. Phys. 150 (1999) 425-467",
    .params = cochran_chan_params,
    .presets = cochran_chan_presets,
    .open = cochran_chan_open,
    .close = free,
    .table = &cochran_chan_table,
};
