/* helmholtz_open.h - instances of the laws that are given by a Helmholtz energy: their keys, and their table in a block
 * that is made and measured once per machine (`share` of bulla/module.h). */
#ifndef HELMHOLTZ_OPEN_H
#define HELMHOLTZ_OPEN_H

#include "helmholtz_direct_build.h"

#include <stdio.h>

enum { HELMHOLTZ_SIZE, HELMHOLTZ_EVAL, HELMHOLTZ_INTERPOLATION };

#define HELMHOLTZ_PARAMS(size_)                                                                          \
    {                                                                                                    \
        {"table-size", "1", 64.0, 512.0, size_, "nodes of the table in each direction, a whole number",  \
         BULLA_NUMBER, NULL},                                                                            \
            {"eval",       "1",                                                                          \
             0.0,          0.0,                                                                          \
             0.0,          "table: interpolated, fast; analytic: all terms of the formulas",             \
             BULLA_CHOICE, "table|analytic"},                                                            \
            {"interpolation",                                                                            \
             "1",                                                                                        \
             0.0,                                                                                        \
             0.0,                                                                                        \
             0.0,                                                                                        \
             "biquintic: of the Helmholtz energy, consistent; bicubic, bilinear: of e, c and T, faster", \
             BULLA_CHOICE,                                                                               \
             "biquintic|bicubic|bilinear"},                                                              \
            {0},                                                                                         \
    }

/* Constants of the two ends in density; the cold end of the domain at the last one carries the dense rule. */
static struct helmholtz_ends helmholtz_ends_of(const struct helmholtz_law *law, const struct helmholtz_grid *grid)
{
    double unused, rho = law->rho_high, l = helmholtz_cold(grid, rho, &unused);
    struct helmholtz_spot spot = helmholtz_exact(law->fluid, HELMHOLTZ_GAS, rho, l);
    struct helmholtz_answer answer = helmholtz_answer(spot, 1, rho, 1.0 / rho, rho * rho * spot.a_r);
    return (struct helmholtz_ends){.thin = law->rho_low > 0.0 ? law->rho_low : 1e-9,
                                   .gamma = law->gamma,
                                   .pull = law->pull,
                                   .dense = rho,
                                   .p = rho * rho * spot.a_r,
                                   .e = answer.e,
                                   .stiffness = rho * answer.c2,
                                   .p_min = law->p_min,
                                   .T_min = law->T_min};
}

/* Errors of T, c and p(rho, e) at one of the states spread over the domain, more of them near its cold edge; where a
 * continuation stands in because a direct table rounds that edge, none. */
static void helmholtz_measure(const struct helmholtz *self, int i, double *ret_miss)
{
    const struct helmholtz_law *law = self->law;
    double unused, from = HELMHOLTZ_SKEW > 0.0 ? HELMHOLTZ_SKEW : law->rho_low > 1.0 ? law->rho_low : 1.0;
    double u = (i + 0.5) / HELMHOLTZ_SAMPLES, golden = fmod(i * 0.6180339887498949, 1.0);
    double rho = HELMHOLTZ_GAS ? from * pow(law->rho_high / from, u) : from + u * (law->rho_high - from);
    double low = helmholtz_cold(&self->grid, rho, &unused);
    double l = low + golden * golden * (self->grid.l_high - low), T, side, rho_e, rho_c2;
    struct helmholtz_spot spot = helmholtz_exact(law->fluid, HELMHOLTZ_GAS, rho, l);
    double p = rho * rho * spot.a_r;
    struct helmholtz_answer exact = helmholtz_answer(spot, 1, rho, 1.0 / rho, p);
    const double *const in[2] = {&rho, &p};
    helmholtz_blocks_ask(self, HELMHOLTZ_THERMAL, 1, in, (double *const[2]){&T, &side});
    helmholtz_blocks_ask(self, HELMHOLTZ_STATE, 1, in, (double *const[2]){&rho_e, &rho_c2});
    if (self->way != HELMHOLTZ_BIQUINTIC && side != 0.0) return;
    ret_miss[0] = fabs(T / spot.T - 1.0);
    ret_miss[1] = fabs(sqrt(rho_c2 / (rho * exact.c2)) - 1.0);
    ret_miss[2] = fabs((rho_e / rho - exact.e) / (exact.e_p * rho * exact.c2));
}

/* The largest error of one kind. NaN if there is one. */
static double helmholtz_worst(const double *misses, int which)
{
    double worst = 0.0;
    for (int i = 0; i < HELMHOLTZ_SAMPLES && worst == worst; i++) {
        double miss = misses[3 * i + which];
        if (!(miss <= worst)) worst = miss;
    }
    return worst;
}

/* What fills the block. */
struct helmholtz_making {
    const struct bulla_host *host;
    const struct helmholtz_law *law;
    int n;
    enum helmholtz_way way;
};

/* Nodes of the table of the potential: a direct table is made from a good one. */
static int helmholtz_potential_nodes(const struct helmholtz_making *making)
{
    return making->way == HELMHOLTZ_BIQUINTIC ? making->n : HELMHOLTZ_SCAFFOLD;
}

/* How many numbers the block has. */
static size_t helmholtz_count(const struct helmholtz_making *making)
{
    size_t count = helmholtz_grid_count(helmholtz_potential_nodes(making)) + 3 * HELMHOLTZ_SAMPLES;
    return making->way == HELMHOLTZ_BIQUINTIC
               ? count
               : count + helmholtz_direct_count(making->n, making->way == HELMHOLTZ_BICUBIC);
}

/* The instance whose tables are in the block. */
static struct helmholtz helmholtz_of(const struct helmholtz_making *making, double *block)
{
    int n = helmholtz_potential_nodes(making);
    double *direct = block + 3 * HELMHOLTZ_SAMPLES + helmholtz_grid_count(n);
    struct helmholtz self = {.law = making->law,
                             .way = making->way,
                             .grid = helmholtz_grid_in(making->law, n, block + 3 * HELMHOLTZ_SAMPLES)};
    if (making->way != HELMHOLTZ_BIQUINTIC)
        self.direct = helmholtz_direct_in(making->law, making->n, making->way == HELMHOLTZ_BICUBIC, direct);
    self.ends = helmholtz_ends_of(making->law, &self.grid);
    return self;
}

static int helmholtz_fill(void *context, void *block, unsigned phase, unsigned part, unsigned parts)
{
    const struct helmholtz_making *making = context;
    struct helmholtz self = helmholtz_of(making, block);
    if (phase < HELMHOLTZ_MAKE_PHASES) {
        int code = helmholtz_build(making->law, &self.grid, phase, (int)part, (int)parts);
        if (code) making->host->fail("out of memory for the table");
        return code;
    }
    phase -= HELMHOLTZ_MAKE_PHASES;
    if (phase < HELMHOLTZ_DIRECT_PHASES) {
        if (self.way != HELMHOLTZ_BIQUINTIC) helmholtz_direct_build(&self, phase, (int)part, (int)parts);
        return 0;
    }
    for (int i = (int)part; i < HELMHOLTZ_SAMPLES; i += (int)parts)
        helmholtz_measure(&self, i, (double *)block + 3 * i);
    return 0;
}

/* The block with the tables. NULL after host->fail. */
static double *helmholtz_share(struct helmholtz_making *making)
{
    const struct bulla_host *host = making->host;
    if (BULLA_HOST_HAS(host, share))
        return (double *)host->share("grid", helmholtz_count(making) * sizeof(double),
                                     HELMHOLTZ_MAKE_PHASES + HELMHOLTZ_DIRECT_PHASES + 1, helmholtz_fill, making);
    host->fail("this table needs a bulla that shares memory between ranks");
    return NULL;
}

/* Says what the table is worth. */
static void helmholtz_tell(const struct helmholtz_making *making, const double *misses)
{
    static const char *const words[] = {"biquintic", "bicubic", "bilinear"};
    static const double numbers[] = {HELMHOLTZ_CELL, 4 * HELMHOLTZ_FIELDS, HELMHOLTZ_FIELDS};
    char text[240];
    int n = making->n;
    snprintf(
        text, sizeof text,
        "%s: table of %d x %d, %s (%.1f MiB): temperature within %.1e, sound speed within %.1e, pressure of an energy "
        "within %.1e rho c^2 (relative)",
        making->law->name, n, n, words[making->way], 8.0 * numbers[making->way] * n * n / 1048576.0,
        helmholtz_worst(misses, 0), helmholtz_worst(misses, 1), helmholtz_worst(misses, 2));
    making->host->say(text);
}

static int helmholtz_open(const struct helmholtz_law *law, const struct bulla_host *host,
                          const struct bulla_value *values, void **ret_self)
{
    int n = (int)values[HELMHOLTZ_SIZE].number;
    const char *eval = values[HELMHOLTZ_EVAL].text, *between = values[HELMHOLTZ_INTERPOLATION].text;
    int analytic = eval && strcmp(eval, "analytic") == 0;
    struct helmholtz_making making = {host, law, n, HELMHOLTZ_BIQUINTIC};
    if (!analytic && between && strcmp(between, "bicubic") == 0) making.way = HELMHOLTZ_BICUBIC;
    if (!analytic && between && strcmp(between, "bilinear") == 0) making.way = HELMHOLTZ_BILINEAR;
    if (values[HELMHOLTZ_SIZE].number != n) {
        host->fail("table-size is a number of nodes: a whole number");
        return 1;
    }
    double *block = helmholtz_share(&making);
    struct helmholtz *self = block ? malloc(sizeof *self) : NULL;
    if (!self) {
        if (block) host->fail("out of memory");
        return 1;
    }
    *self = helmholtz_of(&making, block);
    self->analytic = analytic;
    if (!analytic) helmholtz_tell(&making, block);
    *ret_self = self;
    return 0;
}

#endif
