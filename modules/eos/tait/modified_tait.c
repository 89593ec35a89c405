/* modified_tait.c - water whose stiffness and density scale of Tait's law depend on temperature, with a
 * specific heat: the law of modified_tait.h as rows.
 *
 * All temperatures of a block come from a Newton iteration in which a point that has converged no longer moves, so that
 * its neighbours do not matter; implicit_rows.h does the rest. Its row in aid is ln(rho/rho0). */
#include "bulla/eos.h"
#include "modified_tait.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>

enum { IMPLICIT_BLOCK = 128, ROUNDS = 20 };

/* Where Newton begins: p taken as linear in T between its ends. */
BULLA_KERNEL static void modified_tait_guess(const struct modified_tait *self, size_t n,
                                             const double *BULLA_RESTRICT rho, const double *BULLA_RESTRICT p,
                                             double *BULLA_RESTRICT log_x, double *BULLA_RESTRICT T)
{
    const struct modified_tait par = *self;
#pragma omp simd
    for (size_t i = 0; i < n; i++) {
        double density = continuation_inside(&par.ends, rho[i]), pressure = p[i];
        double x = elementary_log(density / par.rho0), T_max = modified_tait_T_max(&par, density);
        double low = modified_tait_pressure(modified_tait_cold(&par, x));
        double high = modified_tait_pressure(modified_tait_heat(&par, x, T_max));
        double part = (pressure - low) / (high - low);
        part = part < 0.0 ? 0.0 : part;
        part = part > 1.0 ? 1.0 : part;
        log_x[i] = x;
        T[i] = par.T_min + part * (T_max - par.T_min);
    }
}

/* A step for the points that still move: when a step is below 1e-8 the next would be below round-off.
 * Returns how many go on. */
BULLA_KERNEL static double modified_tait_step(const struct modified_tait *self, size_t n,
                                              const double *BULLA_RESTRICT rho, const double *BULLA_RESTRICT p,
                                              const double *BULLA_RESTRICT log_x, double *BULLA_RESTRICT T,
                                              double *BULLA_RESTRICT moving)
{
    const struct modified_tait par = *self;
    double going = 0.0;
#pragma omp simd reduction(+ : going)
    for (size_t i = 0; i < n; i++) {
        double density = continuation_inside(&par.ends, rho[i]), pressure = p[i], old = T[i], moves = moving[i];
        double T_max = modified_tait_T_max(&par, density);
        struct modified_tait_heat heat = modified_tait_heat(&par, log_x[i], old);
        double next = old + (pressure - modified_tait_pressure(heat)) / modified_tait_p_T(&par, heat, old);
        next = next < par.T_min ? par.T_min : next;
        next = next > T_max ? T_max : next;
        double change = next - old, size = change < 0.0 ? -change : change;
        T[i] = moves > 0.0 ? next : old;
        moves = size > 1e-8 * old ? moves : 0.0;
        moving[i] = moves;
        going += moves;
    }
    return going;
}

static void modified_tait_solve(const struct modified_tait *par, size_t n, const double *rho, const double *p,
                                double *log_x, double *T)
{
    double moving[IMPLICIT_BLOCK];
    for (size_t i = 0; i < n; i++) moving[i] = 1.0;
    modified_tait_guess(par, n, rho, p, log_x, T);
    for (int round = 0; round < ROUNDS; round++)
        if (modified_tait_step(par, n, rho, p, log_x, T, moving) == 0.0) break;
    for (size_t i = 0; i < n; i++)
        if (T[i] > par->T_min && T[i] < par->T_dense) T[i] = elementary_coarse(T[i]);
}

ELEMENTARY_INLINE struct continuation_point modified_tait_at(const struct modified_tait *par, double rho, double log_x,
                                                             double T)
{
    double inside = continuation_inside(&par->ends, rho);
    return modified_tait_edge(par, modified_tait_heat(par, log_x, T), inside, T);
}

ELEMENTARY_INLINE struct continuation_state modified_tait_state_at(const struct modified_tait *par, double rho,
                                                                   double p, double log_x, double T)
{
    return continuation_state(&par->ends, modified_tait_at(par, rho, log_x, T), rho, p, T);
}

/* That of the potential where it ends, from there with cv. */
ELEMENTARY_INLINE double modified_tait_entropy_at(const struct modified_tait *par, double rho, double log_x, double T,
                                                  double warm)
{
    struct modified_tait_heat heat = modified_tait_heat(par, log_x, T);
    double entropy = modified_tait_potential_entropy(par, heat, continuation_inside(&par->ends, rho), T);
    return entropy + modified_tait_at(par, rho, log_x, T).cv * elementary_log(warm / T);
}

#define IMPLICIT(name) modified_tait_##name
#define IMPLICIT_LAW struct modified_tait
#include "shared/implicit_rows.h"

/* Explicit where the potential holds, by bisection beyond. */
static double modified_tait_density_at(const struct modified_tait *par, double p, double T)
{
    struct modified_tait_heat heat = modified_tait_heat(par, 0.0, T);
    double ratio = 1.0 + p / heat.B;
    double rho = elementary_exp((elementary_log(ratio) - elementary_log(heat.y)) / par->n) * par->rho0;
    if (ratio > 0.0 && T >= par->T_min && rho >= par->rho_min && rho <= par->rho_max &&
        T <= modified_tait_T_max(par, rho))
        return rho;
    return modified_tait_bisect(par, p, T, (const double[2]){1e-4 * par->rho_min, 1e2 * par->rho_max}, 80);
}

/* Where c^2 ends in the linear continuation of the cold side, or in those beyond the densities. */
BULLA_KERNEL static void modified_tait_p_min(const void *self, size_t n, const double *BULLA_RESTRICT rho,
                                             double *BULLA_RESTRICT p)
{
    const struct modified_tait par = *(const struct modified_tait *)self;
#pragma omp simd
    for (size_t i = 0; i < n; i++) {
        double density = rho[i], inside = continuation_inside(&par.ends, density);
        struct modified_tait_heat heat = modified_tait_cold(&par, elementary_log(inside / par.rho0));
        struct continuation_point at = modified_tait_point(&par, heat, inside, par.T_min);
        p[i] = continuation_p_min(&par.ends, at, density);
    }
}

/* Beyond the densities, or where p is not between those of the ends of temperature. */
static size_t modified_tait_count_outside(const void *instance, size_t n, const double *BULLA_RESTRICT rho,
                                          const double *BULLA_RESTRICT p)
{
    const struct modified_tait *self = instance;
    size_t count = 0;
    for (size_t i = 0; i < n; i++) {
        double log_x = elementary_log(continuation_inside(&self->ends, rho[i]) / self->rho0);
        double T_max = modified_tait_T_max(self, continuation_inside(&self->ends, rho[i]));
        int within = rho[i] >= self->rho_min && rho[i] <= self->rho_max &&
                     p[i] >= modified_tait_pressure(modified_tait_cold(self, log_x)) &&
                     p[i] <= modified_tait_pressure(modified_tait_heat(self, log_x, T_max));
        count += !within;
    }
    return count;
}

/* Less than where the continuations begin: on the hot side the Grueneisen coefficient falls fast. */
static void modified_tait_range(const void *self, struct bulla_eos_range *ret_range)
{
    const struct modified_tait *par = self;
    double x = log(par->rho_max / par->rho0), thin = log(par->rho_min / par->rho0), least;
    double low = modified_tait_pressure(modified_tait_heat(par, thin, par->T_max));
    modified_tait_p_min(self, 1, &par->rho_max, &least);
    *ret_range = (struct bulla_eos_range){.rho_min = par->rho_min * (1.0 + 1e-4),
                                          .rho_max = par->rho_max * (1.0 - 1e-4),
                                          .p_min = low > least ? low : least,
                                          .p_max = modified_tait_pressure(modified_tait_heat(par, x, par->T_min)),
                                          .T_min = par->T_min * (1.0 + 2e-3),
                                          .T_max = par->T_max * 0.95};
}

static const struct bulla_eos modified_tait_table = {.size = sizeof(struct bulla_eos),
                                                     .state = modified_tait_state,
                                                     .derivatives = modified_tait_derivatives,
                                                     .temperature = modified_tait_temperature,
                                                     .entropy = modified_tait_entropy,
                                                     .density = modified_tait_density,
                                                     .p_min = modified_tait_p_min,
                                                     .range = modified_tait_range,
                                                     .energy = modified_tait_energy,
                                                     .count_outside = modified_tait_count_outside};

static const struct bulla_param modified_tait_params[] = {
    {"bulk-modulus", "Pa", 1e3, 1e13, 1203320572.5719271, "A: the pressure scale B of the law at 300 K", BULLA_NUMBER,
     NULL},
    {"softening", "1", 0.0, 5.0, 0.5, "s: B falls with temperature as T^-s", BULLA_NUMBER, NULL},
    {"exponent", "1", 1.01, 20.0, 2.0, "exponent n of the law", BULLA_NUMBER, NULL},
    {"density-scale", "kg/m3", 1e-3, 1e5, 708.9997, "rho0: the density at zero pressure and the middle temperature",
     BULLA_NUMBER, NULL},
    {"swing", "1", 0.0, 0.99, 0.659026, "b: how much that density changes around the middle temperature", BULLA_NUMBER,
     NULL},
    {"middle", "K", 1.0, 1e4, 650.0, "T1: middle temperature of the change", BULLA_NUMBER, NULL},
    {"width", "K", 1.0, 1e4, 550.0, "T2: width of the change", BULLA_NUMBER, NULL},
    {"heat-0", "J/kg/K", -1e6, 1e6, 10334.0, "C0 of the heat C = C0 + C1 t + C2 t^2 + C3 t^3, t = T - 300 K",
     BULLA_NUMBER, NULL},
    {"heat-1", "J/kg/K2", -1e6, 1e6, -4.889, "C1", BULLA_NUMBER, NULL},
    {"heat-2", "J/kg/K3", -1e6, 1e6, 0.0, "C2", BULLA_NUMBER, NULL},
    {"heat-3", "J/kg/K4", -1e6, 1e6, 0.0, "C3", BULLA_NUMBER, NULL},
    {"reduced", "1", 0.0, 1.0, 0.0, "1: C is the specific heat at zero pressure; 0: it has no such meaning",
     BULLA_NUMBER, NULL},
    {"heat-bond", "J/kg", -1e12, 1e12, -3438613.615, "shifts the zero of energy", BULLA_NUMBER, NULL},
    {"entropy-zero", "J/kg/K", -1e9, 1e9, -3233.637937, "shifts the zero of entropy", BULLA_NUMBER, NULL},
    {"t-min", "K", 1.0, 1e4, 270.0, "lowest temperature of the law; its continuation begins there", BULLA_NUMBER, NULL},
    {"t-max", "K", 1.0, 1e4, 600.0, "highest temperature of the law", BULLA_NUMBER, NULL},
    {"t-max-dense", "K", 1.0, 1e4, 555.0, "the same at density-max", BULLA_NUMBER, NULL},
    {"density-min", "kg/m3", 1e-3, 1e5, 500.0, "lowest density of the law", BULLA_NUMBER, NULL},
    {"density-max", "kg/m3", 1e-3, 1e5, 1500.0, "highest density of the law", BULLA_NUMBER, NULL},
    {0},
};

static const struct bulla_preset modified_tait_presets[] = {
    {"published", "liquid water, published coefficients",
     (const double[]){1203320572.5719271, 0.5, 2.0, 708.9997, 0.659026, 650.0, 550.0, 10334.0, -4.889, 0.0, 0.0, 0.0,
                      -3438613.615, -3233.637937, 270.0, 600.0, 555.0, 500.0, 1500.0}},
    {"refit", "liquid water, refitted to IAPWS-95 up to 10 GPa",
     (const double[]){4.791067e8, 0.5357751, 5.413159, 1026.9022, 0.2340633, 234.9651, 486.03339, 3944.8949, 1.7389101,
                      -0.044296965, 5.6438063e-5, 1.0, 4627.941488, 16.51203201, 265.0, 900.0, 900.0, 450.0, 1880.0}},
    {0},
};

static struct continuation_point modified_tait_corner(const struct modified_tait *par, double rho, double T)
{
    return modified_tait_point(par, modified_tait_heat(par, elementary_log(rho / par->rho0), T), rho, T);
}

/* The law must be well-posed in all of its range: looked at on a grid. */
static int modified_tait_check(const struct bulla_host *host, const struct modified_tait *par)
{
    char text[200];
    if (!(par->rho_min < par->rho_max && par->T_min < par->T_max && par->T_min < par->T_dense)) {
        host->fail("density-min, density-max and t-min, t-max(-dense) must ascend");
        return 1;
    }
    for (int i = 0; i <= 60; i++)
        for (int j = 0; j <= 60; j++) {
            double rho = par->rho_min * pow(par->rho_max / par->rho_min, i / 60.0);
            double T = par->T_min + j / 60.0 * (modified_tait_T_max(par, rho) - par->T_min);
            struct continuation_point at = modified_tait_corner(par, rho, T);
            if (at.cv > 0.0 && at.G > 0.0 && at.c2 > 0.0) continue;
            snprintf(text, sizeof text,
                     "at %.5g kg/m3, %.5g K the law has cv %.3g, Grueneisen coefficient %.3g, c^2 %.3g: narrow "
                     "its range (t-min, t-max, density-min, density-max)",
                     rho, T, at.cv, at.G, at.c2);
            host->fail(text);
            return 1;
        }
    return 0;
}

static void modified_tait_set_ends(struct modified_tait *par)
{
    double most = 0.0;
    for (int j = 0; j <= 60; j++) {
        double T = par->T_min + j / 60.0 * (modified_tait_T_max(par, par->rho_max) - par->T_min);
        double G = modified_tait_corner(par, par->rho_max, T).G;
        most = G > most ? G : most;
    }
    struct continuation_point thin = modified_tait_corner(par, par->rho_min, par->T_max);
    struct continuation_point dense = modified_tait_corner(par, par->rho_max, par->T_min);
    par->ends.thin = continuation_end(thin, par->rho_min, 1.0 / thin.G, 1e5);
    par->ends.dense = continuation_end(dense, par->rho_max, 0.9 / most, 1e5);
}

static int modified_tait_open(const struct bulla_host *host, const struct bulla_value *values, void **ret_self)
{
    struct modified_tait *self = malloc(sizeof *self);
    if (!self) {
        host->fail("out of memory");
        return 1;
    }
    double *field[] = {&self->A,     &self->s,     &self->n,       &self->rho0,    &self->b,       &self->T1, &self->T2,
                       &self->C[0],  &self->C[1],  &self->C[2],    &self->C[3],    &self->reduced, &self->h0, &self->s0,
                       &self->T_min, &self->T_max, &self->T_dense, &self->rho_min, &self->rho_max};
    for (size_t i = 0; i < sizeof field / sizeof *field; i++) *field[i] = values[i].number;
    if (modified_tait_check(host, self)) {
        free(self);
        return 1;
    }
    self->cold = modified_tait_heat(self, 0.0, self->T_min);
    modified_tait_set_ends(self);
    *ret_self = self;
    return 0;
}

BULLA_EXPORT const struct bulla_module bulla_module = {
    .magic = BULLA_MAGIC,
    .abi = BULLA_ABI,
    .size = sizeof bulla_module,
    .kind = "eos",
    .name = "modified-tait",
    .version = "1.0",
    .doc = "Modified Tait liquid: a Tait law whose constants depend on temperature, with a specific heat. Water "
           "with temperatures good to a few per cent, published up to 1 GPa, refitted up to 10 GPa.",
    .cite = "Doctoral thesis \"Bubbles and soft materials: from computational modeling to applications\", 2023, "
            "equations 18-24; Wagner & Pruss, J. Phys. Chem. Ref. Data 31 (2002) 387-535 (the data of the refit)",
    .params = modified_tait_params,
    .presets = modified_tait_presets,
    .open = modified_tait_open,
    .close = free,
    .table = &modified_tait_table,
};
