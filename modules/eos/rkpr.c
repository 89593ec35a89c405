/* rkpr.c - the three-parameter Redlich-Kwong-Peng-Robinson equation of Cismondi and Mollerup: d1 follows from the
 * critical compressibility factor Zc, d2 = (1 - d1)/(1 + d1), and
 *     alpha = (3/(2 + T/Tc))^k,   k = (0.0017 - 2.4407 z) omega^2 + (1.9681 + 7.4513 z) omega + 12.504 z - 2.7238,
 *     d1 = 0.428363 + 18.496215 (0.338426 - z)^0.66 + 789.723105 (0.338426 - z)^2.512392,   z = 1.168 Zc.
 * The fit ends at Zc = 0.2897; gases above (air: 0.2902) take 0.289.
 *
 * With `eval: table` energies, temperatures and sound speeds come from a table (rkpr_table.h) that `open` makes, and
 * which says how good it is; outside of it, and for entropies and densities, the law itself is asked. */
#include "cubic.h"

#include <math.h>

#define CUBIC_ATTRACTION rkpr_attraction

/* alpha' = -k alpha/(2 Tc + T), alpha'' = k (k + 1) alpha/(2 Tc + T)^2 */
ELEMENTARY_INLINE struct cubic_attraction rkpr_attraction(const struct cubic *par, double T)
{
    double per = 1.0 / (2.0 * par->Tc + T), k = par->shape;
    double a = par->ac * elementary_pow(3.0 * par->Tc * per, k);
    return (struct cubic_attraction){a, -k * a * per, k * (k + 1.0) * a * per * per};
}

#include "rkpr_table.h"

enum { RKPR_ZC = CUBIC_OWN, RKPR_EVAL, RKPR_INTERPOLATION, RKPR_SIZE };

static const struct bulla_param rkpr_params[] = {
    CUBIC_PARAMS,
    {"critical-compressibility", "1", 0.2, 0.289, 0.289,
     "compressibility factor at the critical point; above 0.289 take 0.289", BULLA_NUMBER, NULL},
    {"eval", "1", 0.0, 0.0, 0.0, "the law itself, or a table of it", BULLA_CHOICE, "analytic|table"},
    {"interpolation", "1", 0.0, 0.0, 0.0, "between the nodes of the table", BULLA_CHOICE, "bicubic|bilinear"},
    {"table-size", "1", 8.0, 512.0, 128.0, "nodes of the table in each direction", BULLA_NUMBER, NULL},
    {0},
};

static const struct bulla_preset rkpr_presets[] = {
    {"air", "air as one fluid", (const double[]){CUBIC_AIR, 0.289, 0.0, 0.0, 128.0}},
    {0},
};

/* The constants of the law. */
static struct cubic rkpr_constants(const struct bulla_value *values)
{
    struct cubic par = cubic_rows_read(values);
    double omega = values[CUBIC_OMEGA].number, RT = par.R * par.Tc, pc = values[CUBIC_PC].number;
    double z = 1.168 * values[RKPR_ZC].number, short_of = 0.338426 - z;
    double d1 = 0.428363 + 18.496215 * pow(short_of, 0.66) + 789.723105 * pow(short_of, 2.512392);
    double D = (1.0 + d1 * d1) / (1.0 + d1), y = 1.0 + cbrt(2.0 * (1.0 + d1)) + cbrt(4.0 / (1.0 + d1));
    double size = 3.0 * y + D - 1.0;
    par.shape = (0.0017 - 2.4407 * z) * omega * omega + (1.9681 + 7.4513 * z) * omega + (12.504 * z - 2.7238);
    par.ac = (3.0 * y * y + 3.0 * y * D + D * D + D - 1.0) / (size * size) * RT * RT / pc;
    par.b = RT / (pc * size);
    par.d1 = d1;
    par.d2 = (1.0 - d1) / (1.0 + d1);
    return par;
}

struct rkpr {
    struct cubic law;
    struct rkpr_table table;
};

/* What the table says at the points of a block: where there is a weight, the values that were asked for. */
struct rkpr_block {
    double u[CUBIC_BLOCK], y[CUBIC_BLOCK];
    double weight[CUBIC_BLOCK]; /* of the table; the rest is the law's */
    double a[CUBIC_BLOCK], b[CUBIC_BLOCK], c[CUBIC_BLOCK];
};

/* Coordinates and weights; returns the sum of what is left to the law. */
BULLA_KERNEL static double rkpr_place(const struct cubic *self, const double corner[4], size_t n,
                                      const double *BULLA_RESTRICT rho, const double *BULLA_RESTRICT p,
                                      struct rkpr_block *BULLA_RESTRICT block)
{
    const struct cubic par = *self;
    const double u0 = corner[0], u1 = corner[1], y0 = corner[2], y1 = corner[3];
    double rest = 0.0;
#pragma omp simd reduction(+ : rest)
    for (size_t i = 0; i < n; i++) {
        struct cubic_room room = cubic_room(&par, rho[i]);
        double u = -elementary_log(room.v / par.b - 1.0);
        double y = elementary_log((p[i] + par.ac * room.q) / (par.R * room.per_w));
        double weight = (y - y0) * (1.0 / RKPR_TABLE_BAND), down = (y1 - y) * (1.0 / RKPR_TABLE_BAND);
        weight = weight < down ? weight : down;
        weight = weight > 1.0 ? 1.0 : weight;
        weight = weight > 0.0 ? weight : 0.0; /* a NaN is left to the law */
        weight = u >= u0 ? weight : 0.0;
        weight = u <= u1 ? weight : 0.0;
        block->u[i] = u;
        block->y[i] = y;
        block->weight[i] = weight;
        rest += 1.0 - weight;
    }
    return rest;
}

/* True if the law is needed as well. */
static int rkpr_placed(const struct rkpr *self, size_t n, const double *rho, const double *p, struct rkpr_block *block)
{
    const struct rkpr_table *table = &self->table;
    double last = (double)(table->n - 1);
    const double corner[4] = {table->u0, table->u0 + last * table->du, table->y0, table->y0 + last * table->dy};
    return rkpr_place(&self->law, corner, n, rho, p, block) > 0.0;
}

/* The weight of the table's `value` beside the law's: where one has none, it may be anything. */
static inline double rkpr_blend(double weight, double value, double law)
{
    double most = weight > 0.0 ? value : 0.0, least = weight < 1.0 ? law : 0.0;
    return weight * most + (1.0 - weight) * least;
}

static void rkpr_state(const void *instance, size_t n, const double *BULLA_RESTRICT rho, const double *BULLA_RESTRICT p,
                       double *BULLA_RESTRICT rho_e, double *BULLA_RESTRICT rho_c2)
{
    const struct rkpr *self = instance;
    struct rkpr_block block;
    if (!self->table.n) cubic_rows_state(self, n, rho, p, rho_e, rho_c2);
    for (size_t at = 0; at < n && self->table.n; at += CUBIC_BLOCK) {
        size_t m = n - at < CUBIC_BLOCK ? n - at : CUBIC_BLOCK;
        if (rkpr_placed(self, m, rho + at, p + at, &block))
            cubic_rows_state(self, m, rho + at, p + at, rho_e + at, rho_c2 + at);
        for (size_t i = 0; i < m; i++) {
            struct rkpr_look look = rkpr_table_look(&self->table, block.u[i], block.y[i], RKPR_E, RKPR_C);
            block.a[i] = look.f[RKPR_E];
            block.b[i] = look.f[RKPR_C];
        }
        for (size_t i = 0; i < m; i++) {
            double v = 1.0 / rho[at + i], w = v - self->law.b,
                   pressure = p[at + i] + self->law.ac * cubic_room(&self->law, rho[at + i]).q;
            rho_e[at + i] = rkpr_blend(block.weight[i], pressure * w * rho[at + i] * block.a[i], rho_e[at + i]);
            rho_c2[at + i] = rkpr_blend(block.weight[i], pressure * v / w * block.b[i], rho_c2[at + i]);
        }
    }
}

/* With E = e/(R theta) and E_y, E_u: de/dp = w (E + E_y); at constant p, y changes with v by 1/w - ac (-q')/(p + ac q),
 * u by -1/w. */
static void rkpr_derivatives(const void *instance, size_t n, const double *BULLA_RESTRICT rho,
                             const double *BULLA_RESTRICT p, double *BULLA_RESTRICT de_dp,
                             double *BULLA_RESTRICT de_drho)
{
    const struct rkpr *self = instance;
    struct rkpr_block block;
    if (!self->table.n) cubic_rows_derivatives(self, n, rho, p, de_dp, de_drho);
    for (size_t at = 0; at < n && self->table.n; at += CUBIC_BLOCK) {
        size_t m = n - at < CUBIC_BLOCK ? n - at : CUBIC_BLOCK;
        if (rkpr_placed(self, m, rho + at, p + at, &block))
            cubic_rows_derivatives(self, m, rho + at, p + at, de_dp + at, de_drho + at);
        for (size_t i = 0; i < m; i++) {
            struct rkpr_look look = rkpr_table_look(&self->table, block.u[i], block.y[i], RKPR_E, RKPR_E);
            block.a[i] = look.f[RKPR_E];
            block.b[i] = look.f_u[RKPR_E];
            block.c[i] = look.f_y[RKPR_E];
        }
        for (size_t i = 0; i < m; i++) {
            struct cubic_room room = cubic_room(&self->law, rho[at + i]);
            double w = 1.0 / room.per_w, pressure = p[at + i] + self->law.ac * room.q;
            double E = block.a[i], E_u = block.b[i], E_y = block.c[i];
            double widen = room.per_w - self->law.ac * room.dq / pressure;
            double e_v = pressure * w * ((E + E_y) * widen - E_u * room.per_w);
            double slope = rho[at + i] * w * (E + E_y), rest = pressure * w * E - room.v * e_v;
            de_dp[at + i] = rkpr_blend(block.weight[i], slope, de_dp[at + i]);
            de_drho[at + i] = rkpr_blend(block.weight[i], rest, de_drho[at + i]);
        }
    }
}

/* Bit by bit what state and derivatives give. */
static void rkpr_energy(const void *instance, size_t n, const double *BULLA_RESTRICT rho,
                        const double *BULLA_RESTRICT p, double *BULLA_RESTRICT rho_e, double *BULLA_RESTRICT de_dp)
{
    const struct rkpr *self = instance;
    struct rkpr_block block;
    if (!self->table.n) cubic_rows_energy(self, n, rho, p, rho_e, de_dp);
    for (size_t at = 0; at < n && self->table.n; at += CUBIC_BLOCK) {
        size_t m = n - at < CUBIC_BLOCK ? n - at : CUBIC_BLOCK;
        if (rkpr_placed(self, m, rho + at, p + at, &block))
            cubic_rows_energy(self, m, rho + at, p + at, rho_e + at, de_dp + at);
        for (size_t i = 0; i < m; i++) {
            struct rkpr_look look = rkpr_table_look(&self->table, block.u[i], block.y[i], RKPR_E, RKPR_E);
            block.a[i] = look.f[RKPR_E];
            block.c[i] = look.f_y[RKPR_E];
        }
        for (size_t i = 0; i < m; i++) {
            double v = 1.0 / rho[at + i], w = v - self->law.b, E = block.a[i], E_y = block.c[i];
            struct cubic_room room = cubic_room(&self->law, rho[at + i]);
            double pressure = p[at + i] + self->law.ac * room.q, slope = rho[at + i] * (1.0 / room.per_w) * (E + E_y);
            rho_e[at + i] = rkpr_blend(block.weight[i], pressure * w * rho[at + i] * E, rho_e[at + i]);
            de_dp[at + i] = rkpr_blend(block.weight[i], slope, de_dp[at + i]);
        }
    }
}

static void rkpr_temperature(const void *instance, size_t n, const double *BULLA_RESTRICT rho,
                             const double *BULLA_RESTRICT p, double *BULLA_RESTRICT T)
{
    const struct rkpr *self = instance;
    struct rkpr_block block;
    if (!self->table.n) cubic_rows_temperature(self, n, rho, p, T);
    for (size_t at = 0; at < n && self->table.n; at += CUBIC_BLOCK) {
        size_t m = n - at < CUBIC_BLOCK ? n - at : CUBIC_BLOCK;
        if (rkpr_placed(self, m, rho + at, p + at, &block)) cubic_rows_temperature(self, m, rho + at, p + at, T + at);
        for (size_t i = 0; i < m; i++)
            block.a[i] = rkpr_table_look(&self->table, block.u[i], block.y[i], RKPR_T, RKPR_T).f[RKPR_T];
        for (size_t i = 0; i < m; i++) {
            struct cubic_room room = cubic_room(&self->law, rho[at + i]);
            double theta = (p[at + i] + self->law.ac * room.q) / (self->law.R * room.per_w);
            T[at + i] = rkpr_blend(block.weight[i], theta * block.a[i], T[at + i]);
        }
    }
}

/* The law's, moved until the table gives the temperature asked for. */
static void rkpr_density(const void *instance, size_t n, const double *BULLA_RESTRICT p, const double *BULLA_RESTRICT T,
                         double *BULLA_RESTRICT rho)
{
    const struct rkpr *self = instance;
    cubic_rows_density(self, n, p, T, rho);
    for (size_t i = 0; i < n && self->table.n; i++) {
        double sought = T[i], got;
        for (int k = 0; k < 6; k++) {
            rkpr_temperature(self, 1, &rho[i], &p[i], &got);
            sought += T[i] - got;
            rho[i] = cubic_rows_density_at(&self->law, p[i], sought);
        }
    }
}

/* What fills the block. */
struct rkpr_making {
    const struct cubic *law;
    size_t n;
    int bicubic;
};

/* Nodes, then errors. */
static int rkpr_fill(void *context, void *block, unsigned phase, unsigned part, unsigned parts)
{
    const struct rkpr_making *making = context;
    struct rkpr_table table = rkpr_table_in(making->law, making->n, making->bicubic, block);
    if (phase == 0) rkpr_table_build(making->law, &table, part, parts);
    else rkpr_table_errors(making->law, &table, part, parts);
    return 0;
}

/* Makes or finds the table and says what it is worth. */
static int rkpr_tabulate(const struct bulla_host *host, struct rkpr *self, const struct bulla_value *values)
{
    int bicubic = strcmp(values[RKPR_INTERPOLATION].text, "bicubic") == 0;
    size_t n = (size_t)values[RKPR_SIZE].number;
    struct rkpr_making making = {&self->law, n, bicubic};
    double worst[3], *block = NULL;
    char text[200];
    if (BULLA_HOST_HAS(host, share)) block = (double *)host->share("grid", rkpr_table_bytes(n), 2, rkpr_fill, &making);
    else host->fail("this table needs a bulla that shares memory between ranks");
    if (!block) return 1;
    self->table = rkpr_table_in(&self->law, n, bicubic, block);
    rkpr_table_worst(&self->table, worst);
    snprintf(text, sizeof text,
             "rkpr: table of %zu x %zu nodes, %.2g MiB, %s: largest errors of T %.1e, of p(rho, e) %.1e, of c %.1e", n,
             n, (double)(n * n * RKPR_VALUES * sizeof(double)) / 1048576.0, bicubic ? "bicubic" : "bilinear", worst[0],
             worst[1], worst[2]);
    host->say(text);
    return 0;
}

static int rkpr_open(const struct bulla_host *host, const struct bulla_value *values, void **ret_self)
{
    void *self = NULL;
    if (cubic_rows_open(host, rkpr_constants(values), sizeof(struct rkpr), &self)) return 1;
    if (values[RKPR_EVAL].text && strcmp(values[RKPR_EVAL].text, "table") == 0 && rkpr_tabulate(host, self, values)) {
        free(self);
        return 1;
    }
    *ret_self = self;
    return 0;
}

static const struct bulla_eos rkpr_functions = {.size = sizeof(struct bulla_eos),
                                                .state = rkpr_state,
                                                .derivatives = rkpr_derivatives,
                                                .temperature = rkpr_temperature,
                                                .entropy = cubic_rows_entropy,
                                                .density = rkpr_density,
                                                .p_min = cubic_rows_p_min,
                                                .range = cubic_rows_range,
                                                .energy = rkpr_energy,
                                                .count_outside = cubic_rows_count_outside};

BULLA_EXPORT const struct bulla_module bulla_module = {
    .magic = BULLA_MAGIC,
    .abi = BULLA_ABI,
    .size = sizeof bulla_module,
    .kind = "eos",
    .name = "rkpr",
    .version = "1.0",
    .doc = "Redlich-Kwong-Peng-Robinson gas with vibrating molecules. For the content of bubbles that collapse; air "
           "(the defaults) with temperatures good to 1 % up to 3 GPa.",
    .cite = "Cismondi & Mollerup, Fluid Phase Equilib. 232 (2005) 74-89",
    .params = rkpr_params,
    .presets = rkpr_presets,
    .open = rkpr_open,
    .close = free,
    .table = &rkpr_functions,
};
