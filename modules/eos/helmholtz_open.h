/* helmholtz_open.h - instances of the laws that are given by a Helmholtz energy: their keys, and their table in a block that is
 * made and measured once per machine (`share` of bulla/module.h). */
#ifndef HELMHOLTZ_OPEN_H
#define HELMHOLTZ_OPEN_H

#include "helmholtz_build.h"
#include "helmholtz_rows.h"

#include <stdio.h>

enum { HELMHOLTZ_SIZE, HELMHOLTZ_EVAL };

#define HELMHOLTZ_PARAMS(size_)                                                                                     \
    {                                                                                                               \
        {"table-size", "1", 64.0, 512.0, size_, "nodes of the table in density and in temperature, a whole number", \
         BULLA_NUMBER, NULL},                                                                                       \
            {"eval",       "1",                                                                                     \
             0.0,          0.0,                                                                                     \
             0.0,          "table: interpolated, fast; analytic: all terms of the formulas",                        \
             BULLA_CHOICE, "table|analytic"},                                                                       \
            {0},                                                                                                    \
    }

/* Constants of the two ends in density; the cold end of the domain at the last one carries the dense rule. */
static struct helmholtz_ends helmholtz_ends_of(const struct helmholtz_law *law, const struct helmholtz_grid *grid)
{
    double unused, rho = law->rho_high, l = law->gas ? grid->l_low : helmholtz_edge(grid, rho, &unused);
    struct helmholtz_spot spot = helmholtz_exact(law->fluid, rho, l);
    struct helmholtz_answer answer = helmholtz_answer(spot, rho, rho * rho * spot.a_r);
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

/* Errors of T and c at one of the states spread over the domain, more of them near its cold edge. */
static void helmholtz_measure(const struct helmholtz *self, int i)
{
    const struct helmholtz_law *law = self->law;
    double unused, from = law->rho_low > 1.0 ? law->rho_low : 1.0;
    double u = (i + 0.5) / HELMHOLTZ_SAMPLES, golden = fmod(i * 0.6180339887498949, 1.0);
    double rho = HELMHOLTZ_GAS ? from * pow(law->rho_high / from, u) : from + u * (law->rho_high - from);
    double low = HELMHOLTZ_GAS ? self->grid.l_low : helmholtz_edge(&self->grid, rho, &unused);
    double l = low + golden * golden * (self->grid.l_high - low);
    struct helmholtz_spot spot = helmholtz_exact(law->fluid, rho, l);
    double p = rho * rho * spot.a_r;
    struct helmholtz_answer exact = helmholtz_answer(spot, rho, p);
    struct helmholtz_point found = helmholtz_at(self, 0, rho, p);
    self->grid.misses[2 * i] = fabs(helmholtz_T(self, found) / spot.T - 1.0);
    self->grid.misses[2 * i + 1] = fabs(sqrt(found.answer.c2 / exact.c2) - 1.0);
}

/* The largest: of T (0) or c (1). NaN if there is one. */
static double helmholtz_worst(const struct helmholtz_grid *grid, int which)
{
    double worst = 0.0;
    for (int i = 0; i < HELMHOLTZ_SAMPLES && worst == worst; i++) {
        double miss = grid->misses[2 * i + which];
        if (!(miss <= worst)) worst = miss;
    }
    return worst;
}

/* What fills the block. */
struct helmholtz_making {
    const struct bulla_host *host;
    const struct helmholtz_law *law;
    int n;
};

static struct helmholtz helmholtz_of(const struct helmholtz_making *making, double *block)
{
    struct helmholtz self = {.law = making->law, .grid = helmholtz_grid_in(making->law, making->n, block)};
    self.ends = helmholtz_ends_of(making->law, &self.grid);
    return self;
}

static int helmholtz_fill(void *context, void *block, unsigned phase, unsigned part, unsigned parts)
{
    const struct helmholtz_making *making = context;
    struct helmholtz_grid grid = helmholtz_grid_in(making->law, making->n, block);
    if (phase < HELMHOLTZ_MAKE_PHASES) {
        int code = helmholtz_build(making->law, &grid, phase, (int)part, (int)parts);
        if (code) making->host->fail("out of memory for the table");
        return code;
    }
    struct helmholtz self = helmholtz_of(making, block);
    for (int i = (int)part; i < HELMHOLTZ_SAMPLES; i += (int)parts) helmholtz_measure(&self, i);
    return 0;
}

/* The block of an n x n table. NULL after host->fail. */
static double *helmholtz_share(struct helmholtz_making *making)
{
    const struct bulla_host *host = making->host;
    if (BULLA_HOST_HAS(host, share))
        return (double *)host->share("grid", helmholtz_bytes(making->n), HELMHOLTZ_MAKE_PHASES + 1, helmholtz_fill,
                                     making);
    host->fail("this table needs a bulla that shares memory between ranks");
    return NULL;
}

static int helmholtz_open(const struct helmholtz_law *law, const struct bulla_host *host,
                          const struct bulla_value *values, void **ret_self)
{
    char text[200];
    int n = (int)values[HELMHOLTZ_SIZE].number;
    const char *eval = values[HELMHOLTZ_EVAL].text;
    struct helmholtz_making making = {host, law, n};
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
    self->analytic = eval && strcmp(eval, "analytic") == 0;
    snprintf(text, sizeof text,
             "%s: table of %d x %d (%.1f MiB): temperature within %.1e, sound speed within %.1e (relative)", law->name,
             n, n, 8.0 * HELMHOLTZ_NODE * n * n / 1048576.0, helmholtz_worst(&self->grid, 0),
             helmholtz_worst(&self->grid, 1));
    if (!self->analytic) host->say(text);
    *ret_self = self;
    return 0;
}

#endif
