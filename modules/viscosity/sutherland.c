/* sutherland.c - mu = mu0 (T/T0)^(3/2) (T0 + S)/(T + S). */
#include "law.h"

enum { MU, TEMPERATURE, CONSTANT, ZETA_RATIO };

static const struct bulla_param sutherland_params[] = {
    {"mu", "Pa s", 0.0, 1e9, NAN, "viscosity at the reference temperature", BULLA_NUMBER, NULL},
    {"temperature", "K", 1.0, 1e5, 273.15, "reference temperature T0", BULLA_NUMBER, NULL},
    {"constant", "K", 0.0, 1e5, NAN, "Sutherland's temperature S", BULLA_NUMBER, NULL},
    LAW_ZETA_RATIO,
    {0},
};

static const struct bulla_preset sutherland_presets[] = {
    {"air", "dry air, 2 % from 170 to 1900 K", (const double[]){1.716e-5, 273.15, 110.4, 0.6}},
    {0},
};

static int sutherland_open(const struct bulla_host *host, const struct bulla_value *values, void **ret_self)
{
    const double par[] = {values[MU].number, values[TEMPERATURE].number, values[CONSTANT].number,
                          values[ZETA_RATIO].number};
    return law_keep(host, par, sizeof par, ret_self);
}

BULLA_KERNEL static void sutherland_row(size_t n, const double *par, double factor, const double *BULLA_RESTRICT T,
                                        double *BULLA_RESTRICT mu)
{
    const double T0 = par[TEMPERATURE], S = par[CONSTANT], scale = factor * (T0 + S);
#pragma omp simd
    for (size_t i = 0; i < n; i++) {
        double x = T[i] / T0;
        mu[i] = scale * (x * sqrt(x)) / (T[i] + S);
    }
}

static void sutherland_mu(const void *self, size_t n, const double *BULLA_RESTRICT rate, const double *BULLA_RESTRICT T,
                          const double *BULLA_RESTRICT p, const double *BULLA_RESTRICT rho, double *BULLA_RESTRICT mu)
{
    const double *par = self;
    (void)rate, (void)p, (void)rho;
    sutherland_row(n, par, par[MU], T, mu);
}

static void sutherland_zeta(const void *self, size_t n, const double *BULLA_RESTRICT T, const double *BULLA_RESTRICT p,
                            const double *BULLA_RESTRICT rho, double *BULLA_RESTRICT zeta)
{
    const double *par = self;
    (void)p, (void)rho;
    sutherland_row(n, par, par[ZETA_RATIO] * par[MU], T, zeta);
}

static const struct bulla_viscosity sutherland_table = {.mu = {.size = sizeof(struct bulla_viscosity),
                                                               .needs = BULLA_NEEDS_TEMPERATURE,
                                                               .value = sutherland_mu},
                                                        .zeta = sutherland_zeta};

BULLA_EXPORT const struct bulla_module bulla_module = {
    .magic = BULLA_MAGIC,
    .abi = BULLA_ABI,
    .size = sizeof bulla_module,
    .kind = "viscosity",
    .name = "sutherland",
    .version = "1.0",
    .doc = "Sutherland's law of gases: grows with temperature, does not depend on pressure.",
    .cite = "Sutherland, Phil. Mag. 36 (1893) 507-531; numbers of air: White, Viscous Fluid Flow, 3rd ed., McGraw-Hill "
            "2006, table 1-2",
    .params = sutherland_params,
    .presets = sutherland_presets,
    .open = sutherland_open,
    .close = free,
    .table = &sutherland_table,
};
