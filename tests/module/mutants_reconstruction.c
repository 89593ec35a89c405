/* mutants_reconstruction.c - the contract suite of reconstructions can fail: good schemes with one thing wrong at a
 * time, each found by the check that is there for it. */
#include "mutants.h"

#include "bulla/reconstruction.h"

static const struct bulla_reconstruction *muscl, *weno;

static int start(void **state)
{
    if (support_start(state)) return 1;
    muscl = support_module("reconstruction", "muscl")->table;
    weno = support_module("reconstruction", "weno5-z")->table;
    return 0;
}

/* What is spoilt, and how. */
static enum spoil { CREEP, BLUNT, TILT, LOOK, SIZED, STEEP, EXTREME, ROUGH, WIDE, SHARED } spoil;

static double spoilt(size_t i, size_t n, size_t step, const double *w, double edge, bool upper)
{
    double d = w[i + step] - w[i], far = w[i + 2 * step];
    if (spoil == CREEP) return edge + 1e-15 * w[i];
    if (spoil == BLUNT) return w[i] + 0.9 * (edge - w[i]);
    if (spoil == TILT && upper) return w[i] + 0.5 * (edge - w[i]);
    if (spoil == LOOK) return edge + 0.0 * far;
    if (spoil == SIZED) return w[i] + (edge - w[i]) / (1.0 + 1e-3 * fabs(edge - w[i]));
    if (spoil == STEEP) return w[i] + 3.0 * (edge - w[i]);
    if (spoil == EXTREME) return upper ? w[i] + 0.5 * d : w[i] - 0.5 * (w[i] - *(w + i - step));
    if (spoil == ROUGH && i == 8 && n > 8) return edge * (1.0 + 0x1p-52);
    return edge;
}

static void edges(const void *self, const struct bulla_limited *limited, size_t n, size_t step, const double *w,
                  OUT lower, OUT upper)
{
    bool bad = false;
    muscl->edges(self, limited, n, step, w, lower, upper);
    for (size_t i = 0; i < n; i++) {
        lower[i] = spoilt(i, n, step, w, lower[i], false);
        upper[i] = spoilt(i, n, step, w, upper[i], true);
        bad |= w[i] != w[i];
    }
    if (spoil == WIDE && n > 8) upper[n] = upper[n - 1];
    for (size_t i = 0; i < n && bad && spoil == SHARED; i++) lower[i] = (double)NAN;
}

static void test_edges(void **state)
{
    (void)state;
    static const struct {
        enum spoil spoil;
        const char *check;
    } mutants[] = {
        {CREEP, "equal cells"},           {BLUNT, "edges of a straight line"},
        {BLUNT, "edges of a smooth row"}, {TILT, "mirrored cells"},
        {LOOK, "cells further away"},     {SIZED, "units do not matter"},
        {STEEP, "bounded: edges"},        {EXTREME, "bounded: edges"},
        {ROUGH, "a row gives"},           {WIDE, "nothing written"},
        {SHARED, "bad numbers"},
    };
    struct bulla_reconstruction table = *muscl;
    table.edges = edges;
    for (size_t i = 0; i < sizeof mutants / sizeof *mutants; i++) {
        spoil = mutants[i].spoil;
        finds("reconstruction", "muscl", &table, mutants[i].check);
    }
}

/* Schemes of all components: one that does not turn the velocity along the row, one that promises too much, one whose
 * fractions do not sum up. */

static void along(const void *self, const struct bulla_cells *cells)
{
    double *upper = cells->upper[cells->i_u + cells->axis];
    weno->all(self, cells);
    for (size_t i = 0; i < cells->n; i++) upper[i] = fabs(upper[i]);
}

static void first_material(const void *self, const struct bulla_cells *cells)
{
    weno->all(self, cells);
    for (size_t i = 0; i < cells->n; i++) cells->upper[0][i] = cells->w[0][i];
}

static void test_all(void **state)
{
    (void)state;
    struct bulla_reconstruction table = *weno;
    table.bounded = 1;
    finds("reconstruction", "weno5-z", &table, "bounded: edges");
    table.all = first_material;
    finds("reconstruction", "weno5-z", &table, "bounded: fractions");
    table.all = along;
    finds("reconstruction", "weno5-z", &table, "mirrored cells");
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(test_edges), cmocka_unit_test(test_all)};
    return cmocka_run_group_tests(tests, start, support_stop);
}
