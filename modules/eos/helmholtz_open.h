/* helmholtz_open.h - instances of the laws that are given by a Helmholtz energy: their keys, and tables shared by all
 * instances of a process that ask for the same size. */
#ifndef HELMHOLTZ_OPEN_H
#define HELMHOLTZ_OPEN_H

#include "helmholtz_build.h"
#include "helmholtz_rows.h"

#include <stdio.h>

enum { HELMHOLTZ_SIZE, HELMHOLTZ_EVAL, HELMHOLTZ_SHARED = 16, HELMHOLTZ_SAMPLES = 1500 };

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

/* A table, how many instances use it, and what it was measured to miss. */
struct helmholtz_shared {
    struct helmholtz_grid *grid;
    int users;
    double worst_T, worst_c;
};

/* Touched by open and close alone, which core calls from one thread. */
static struct helmholtz_shared helmholtz_shared[HELMHOLTZ_SHARED];

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

/* Worst error of T and c at states spread over the domain, more of them near its cold edge. */
static void helmholtz_measure(const struct helmholtz *self, struct helmholtz_shared *shared)
{
    const struct helmholtz_law *law = self->law;
    double unused, from = law->rho_low > 1.0 ? law->rho_low : 1.0;
    for (int i = 0; i < HELMHOLTZ_SAMPLES; i++) {
        double u = (i + 0.5) / HELMHOLTZ_SAMPLES, golden = fmod(i * 0.6180339887498949, 1.0);
        double rho = HELMHOLTZ_GAS ? from * pow(law->rho_high / from, u) : from + u * (law->rho_high - from);
        double low = HELMHOLTZ_GAS ? self->grid.l_low : helmholtz_edge(&self->grid, rho, &unused);
        double l = low + golden * golden * (self->grid.l_high - low);
        struct helmholtz_spot spot = helmholtz_exact(law->fluid, rho, l);
        double p = rho * rho * spot.a_r;
        struct helmholtz_answer exact = helmholtz_answer(spot, rho, p);
        struct helmholtz_point found = helmholtz_at(self, 0, rho, p);
        double off_T = fabs(helmholtz_T(self, found) / spot.T - 1.0);
        double off_c = fabs(sqrt(found.answer.c2 / exact.c2) - 1.0);
        if (!(off_T <= shared->worst_T)) shared->worst_T = off_T;
        if (!(off_c <= shared->worst_c)) shared->worst_c = off_c;
    }
}

/* The table of n x n nodes, built if no instance has it. NULL: out of memory. */
static struct helmholtz_shared *helmholtz_share(const struct helmholtz_law *law, int n)
{
    struct helmholtz_shared *free_place = NULL;
    for (int i = 0; i < HELMHOLTZ_SHARED; i++) {
        struct helmholtz_shared *shared = &helmholtz_shared[i];
        if (shared->users && shared->grid->n == n) {
            shared->users++;
            return shared;
        }
        if (!shared->users) free_place = shared;
    }
    if (!free_place) return NULL;
    *free_place = (struct helmholtz_shared){.grid = helmholtz_build(law, n), .users = 1};
    if (free_place->grid) return free_place;
    free_place->users = 0;
    return NULL;
}

static void helmholtz_close(void *instance)
{
    struct helmholtz *self = instance;
    for (int i = 0; i < HELMHOLTZ_SHARED && self; i++) {
        struct helmholtz_shared *shared = &helmholtz_shared[i];
        if (!shared->users || shared->grid->node != self->grid.node || --shared->users) continue;
        helmholtz_grid_free(shared->grid);
        shared->grid = NULL;
    }
    free(self);
}

static int helmholtz_open(const struct helmholtz_law *law, const struct bulla_host *host,
                          const struct bulla_value *values, void **ret_self)
{
    char text[200];
    int n = (int)values[HELMHOLTZ_SIZE].number;
    const char *eval = values[HELMHOLTZ_EVAL].text;
    if (values[HELMHOLTZ_SIZE].number != n) {
        host->fail("table-size is a number of nodes: a whole number");
        return 1;
    }
    struct helmholtz *self = malloc(sizeof *self);
    struct helmholtz_shared *shared = self ? helmholtz_share(law, n) : NULL;
    if (!shared) {
        free(self);
        host->fail("out of memory, or tables of more than 16 sizes at once");
        return 1;
    }
    *self = (struct helmholtz){.grid = *shared->grid, .law = law, .analytic = eval && strcmp(eval, "analytic") == 0};
    self->ends = helmholtz_ends_of(law, &self->grid);
    if (shared->worst_T == 0.0) helmholtz_measure(self, shared);
    snprintf(text, sizeof text,
             "%s: table of %d x %d (%.1f MiB): temperature within %.1e, sound speed within %.1e (relative)", law->name,
             n, n, 8.0 * HELMHOLTZ_NODE * n * n / 1048576.0, shared->worst_T, shared->worst_c);
    if (!self->analytic) host->say(text);
    *ret_self = self;
    return 0;
}

#endif
