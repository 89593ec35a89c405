/* iapws95.c - water by the reference formulation IAPWS-95, as a liquid and above its critical point.
 *
 * Two things keep the formulation from being a function of (rho, p) everywhere. Near its density maximum water has two
 * temperatures at one density and pressure, and below it (dp/dT)_rho < 0; and inside the saturation dome there are
 * states that are none. The domain therefore ends below at a curve T(rho), chosen so that on it and above
 * Gamma >= 0.02 and (dp/drho)_T > 0:
 *   - from 1000 kg/m3 on the isotherm of 280.15 K, above 1 GPa 280.15 K + 119.85 K 1.15 s^2/(s + 0.15), s = log10(p/1
 * GPa);
 *   - below that, in tension, 3 K above the density maximum; below 880 kg/m3 where (dp/drho)_T = 1e5 m2/s2, beside the
 *     spinodal of the metastable liquid. No water vapour, no phase change.
 * Above it ends at 3200 K, towards low density at 467 kg/m3, and at 1720 kg/m3. Beyond, the continuations of
 * helmholtz_state.h hold: well-posed, not accurate. IAPWS states 1273 K and 1 GPa as limits; it extrapolates smoothly
 * from there to the ends of this domain, some 10 GPa on isentropes of cold water. */
#define HELMHOLTZ_GAS 0
#include "helmholtz_open.h"
#include "iapws95_terms.h"

static const struct bulla_param iapws95_params[] = HELMHOLTZ_PARAMS(256.0);

static const struct bulla_preset iapws95_presets[] = {
    {"water", "ordinary water", (const double[]){256.0, NAN, NAN}},
    {0},
};

/* The lower end of the domain up to 1000 kg/m3, K at kg/m3, from scans of Gamma and (dp/drho)_T. */
static const double iapws95_knots[][2] = {{460, 700},   {480, 688},   {500, 676},   {520, 663},    {540, 650},
                                          {560, 636.5}, {580, 622.5}, {600, 608},   {620, 593},    {640, 577},
                                          {660, 560},   {680, 542.5}, {700, 524},   {720, 504.5},  {740, 484},
                                          {760, 462},   {780, 439},   {800, 415},   {820, 391},    {840, 367},
                                          {860, 344},   {880, 325},   {890, 316.5}, {900, 309.5},  {910, 304},
                                          {920, 300.2}, {930, 297.8}, {940, 296},   {950, 294.25}, {960, 292.3},
                                          {970, 290},   {980, 287.3}, {990, 284.1}, {1000, 280.15}};

static double iapws95_T_knots(double rho)
{
    size_t n = sizeof iapws95_knots / sizeof *iapws95_knots, i = 0;
    while (i < n - 2 && rho > iapws95_knots[i + 1][0]) i++;
    const double *low = iapws95_knots[i], *high = iapws95_knots[i + 1];
    return low[1] + (rho - low[0]) / (high[0] - low[0]) * (high[1] - low[1]);
}

/* The curve is given over p: T and p(rho, T) have to agree. p changes little with T, so this converges fast. */
static double iapws95_T_low(const struct helmholtz_law *law, double rho)
{
    if (rho < 1000.0) return iapws95_T_knots(rho);
    double T = 280.15;
    for (int round = 0; round < 40; round++) {
        struct helmholtz_spot spot = helmholtz_exact(law->fluid, HELMHOLTZ_GAS, rho, log(T));
        double p = rho * rho * spot.a_r, s = p > 1e9 ? log10(p / 1e9) : 0.0;
        double next = 280.15 + 119.85 * 1.15 * s * s / (s + 0.15), moved = next - T;
        T += 0.8 * moved;
        if (fabs(moved) < 1e-10) break;
    }
    return T;
}

static const struct helmholtz_law iapws95_law = {
    .name = "iapws95",
    .fluid = &iapws95_fluid,
    .rho_low = 467.0,
    .rho_high = 1720.0,
    .T_high = 3200.0,
    .grid_T = 265.0,
    .grid_T_high = 3300.0,
    .blur = 8.0,
    .gamma = 1.19,
    .pull = 6.2e8,
    .p_min = -6.2e8,
    .T_min = 100.0,
    .T_low = iapws95_T_low,
};

static int iapws95_open(const struct bulla_host *host, const struct bulla_value *values, void **ret_self)
{
    return helmholtz_open(&iapws95_law, host, values, ret_self);
}

/* Where the formulation is backed by data and the liquid is not far from stable. */
static void iapws95_range(const void *self, struct bulla_eos_range *ret_range)
{
    (void)self;
    *ret_range = (struct bulla_eos_range){
        .rho_min = 640.0, .rho_max = 1240.0, .p_min = 1e3, .p_max = 1e9, .T_min = 281.0, .T_max = 1273.0};
}

static const struct bulla_eos iapws95_table = HELMHOLTZ_TABLE(iapws95_range);

BULLA_EXPORT const struct bulla_module bulla_module = {
    .magic = BULLA_MAGIC,
    .abi = BULLA_ABI,
    .size = sizeof bulla_module,
    .kind = "eos",
    .name = "iapws95",
    .version = "1.0",
    .doc =
        "Water by the reference formulation IAPWS-95, tabulated at the start. Liquid, also metastable and in tension, "
        "and supercritical; temperatures good to 10 GPa. No vapour.",
    .cite = "Wagner & Pruss, J. Phys. Chem. Ref. Data 31 (2002) 387-535; IAPWS R6-95(2018)",
    .params = iapws95_params,
    .presets = iapws95_presets,
    .open = iapws95_open,
    .close = free,
    .table = &iapws95_table,
};
