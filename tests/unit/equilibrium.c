/* equilibrium.c - cells that come to equilibrium: the reference cells (40 digits), random cells far from it with and
 * without another material, entropy, what is kept, and that no cell knows its neighbours. */
#include "phase_pairs.h"

#include "phys/equilibrium_point.h"

#include <time.h>

enum { ROWS = 3200, POINTS = 20000 }; /* BULLA_POINTS in the environment: random cells instead of POINTS */

static const char *const regimes[] = {"none", "two-phase", "all-vapour", "all-liquid"};

/* One row of equilibrium_points.csv. */
struct row {
    char pair[32], kind[16], mixing[16], regime[16];
    double m[3], energy, p_T, T_T, p, T, m_l, m_v, gain, ratio;
};

static size_t read_rows(struct row *rows)
{
    char line[512];
    size_t n = 0;
    FILE *file = fopen("tests/data/phase/equilibrium_points.csv", "r");
    assert_non_null(file);
    while (fgets(line, sizeof line, file)) {
        struct row *row = &rows[n];
        if (line[0] == '#' || strncmp(line, "pair,", 5) == 0) continue;
        assert_int_equal(sscanf(line, "%31[^,],%15[^,],%15[^,],%lf,%lf,%lf,%lf,%lf,%lf,%15[^,],%lf,%lf,%lf,%lf,%lf,%lf",
                                row->pair, row->kind, row->mixing, &row->m[0], &row->m[1], &row->m[2], &row->energy,
                                &row->p_T, &row->T_T, row->regime, &row->p, &row->T, &row->m_l, &row->m_v, &row->gain,
                                &row->ratio),
                         16);
        n++;
    }
    fclose(file);
    return n;
}

/* Worst deviations of all rows. */
struct worst {
    double p, T, m, gain;
    int regimes;
};

static void note(double *worst, double error)
{
    if (!(error <= *worst)) *worst = error;
}

/* Entropy of the family per volume, with that of mixing. */
static double entropy(const struct equilibrium_family *family, const double *m, double p, double T)
{
    double sum = 0.0, moles = 0.0;
    for (unsigned k = 0; k < family->n; k++) {
        double rho = 0.0, v, h, s, v_T, v_p, c_p;
        if (!(m[k] > 0.0)) continue;
        family->eos[k].law->thermal(family->eos[k].self, 1, &p, &T, &rho, &v, &h, &s, &v_T, &v_p, &c_p);
        sum += m[k] * s;
        if (k > 0) moles += m[k] * family->R[k];
    }
    for (unsigned k = 1; k < family->n && family->mixing; k++)
        if (m[k] > 0.0) sum -= m[k] * family->R[k] * log(m[k] * family->R[k] / moles);
    return sum;
}

static void fill(struct equilibrium_cells *cells, const struct row *row, const struct equilibrium_family *family,
                 double p, double T)
{
    *cells = (struct equilibrium_cells){.n = 1};
    for (unsigned k = 0; k < family->n; k++) cells->m[k][0] = row->m[k];
    cells->energy[0] = row->energy;
    cells->p[0] = p;
    cells->T[0] = T;
}

static void check_row(const struct row *row, struct phase_laws *laws, double start, struct worst *worst)
{
    struct equilibrium_cells cells;
    struct equilibrium_effort effort = {0};
    struct equilibrium_family *family = &laws->family;
    const struct bulla_value *v = laws->law[0].instance.values;
    double p_inf = v[1].number, all = row->m[0] + row->m[1], m[SCENE_MATERIALS] = {row->m[0], row->m[1], row->m[2]};
    family->n = row->m[2] > 0.0 ? 3 : 2;
    family->mixing = strcmp(row->mixing, "dalton") == 0;
    family->exchange = false;
    fill(&cells, row, family, start * row->p_T, row->T_T);
    equilibrium_solve(family, &cells, &effort);
    double before = entropy(family, m, cells.p[0], cells.T[0]), tolerable = 1e-9 * p_inf;
    note(&worst->p, fabs(cells.p[0] - row->p_T) / (fabs(row->p_T) + tolerable));
    note(&worst->T, fabs(cells.T[0] / row->T_T - 1.0));
    family->exchange = true;
    fill(&cells, row, family, start * row->p_T, row->T_T);
    equilibrium_solve(family, &cells, &effort);
    enum equilibrium_regime regime = cells.regime[0];
    if (regime == EQUILIBRIUM_TWO_PHASE && cells.m[1][0] < EQUILIBRIUM_NOTHING * all && !family->mixing)
        regime = EQUILIBRIUM_ALL_LIQUID;
    if (strcmp(regimes[regime], row->regime) != 0) {
        worst->regimes++;
        print_message("%s %s %s: %s, not %s: p %g %g, m_v %g %g\n", row->pair, row->kind, row->mixing, regimes[regime],
                      row->regime, cells.p[0], row->p, cells.m[1][0], row->m_v);
        return;
    }
    for (int k = 0; k < 2; k++) m[k] = cells.m[k][0];
    note(&worst->p, fabs(cells.p[0] - row->p) / (fabs(row->p) + tolerable));
    note(&worst->T, fabs(cells.T[0] / row->T - 1.0));
    note(&worst->m, fabs(cells.m[1][0] - row->m_v) / all);
    double gain = entropy(family, m, cells.p[0], cells.T[0]) - before, size = 1e-12 * fabs(before);
    note(&worst->gain, fabs(gain - row->gain) / (fabs(row->gain) + 1e6 * size));
}

static void test_references(void **state)
{
    (void)state;
    struct row *rows = calloc(ROWS + 1, sizeof *rows);
    struct phase_laws laws[PHASE_PAIRS];
    struct worst worst = {0};
    for (unsigned i = 0; i < PHASE_PAIRS; i++) phase_open(&phase_pairs[i], 3, &laws[i]);
    size_t n = read_rows(rows);
    assert_int_equal(n, ROWS);
    for (size_t i = 0; i < n; i++) check_row(&rows[i], &laws[phase_find(rows[i].pair)], 1.0, &worst);
    print_message("p %.2g, T %.2g, m_v/M %.2g, entropy %.2g, wrong regimes %d\n", worst.p, worst.T, worst.m, worst.gain,
                  worst.regimes);
    assert_int_equal(worst.regimes, 0);
    assert_true(worst.p < 1e-9 && worst.T < 1e-11 && worst.m < 1e-11 && worst.gain < 1e-6);
    for (unsigned i = 0; i < PHASE_PAIRS; i++) phase_close(&laws[i]);
    free(rows);
}

static double between(uint64_t *seed, double low, double high)
{
    return low * pow(high / low, contract_random(seed, 0.0, 1.0));
}

/* A cell of liquid, vapour, air and, with `other`, stone (stiffened) that have one pressure and temperatures of their
 * own. `wild`: anywhere; else 1 % off equilibrium-like states. */
static void draw(const struct phase_laws *laws, const struct law *stone, bool wild, uint64_t *seed,
                 struct equilibrium_cells *cells, size_t i)
{
    const struct equilibrium_family *family = &laws->family;
    double p = between(seed, 300.0, 1e8), alpha[4], sum = 0.0, rho_e, c2;
    double T[4] = {between(seed, 300.0, 600.0), between(seed, 300.0, wild ? 1500.0 : 600.0),
                   between(seed, 300.0, wild ? 3000.0 : 600.0), 400.0};
    for (unsigned k = 0; k < 4; k++) {
        bool there = k < family->n || (k == 3 && stone);
        alpha[k] = there ? between(seed, 1e-9, 1.0) : 0.0;
        sum += alpha[k];
    }
    cells->energy[i] = 0.0;
    for (unsigned k = 0; k < 4; k++) {
        const struct law *law = k < 3 ? &laws->law[k] : stone;
        if (!(alpha[k] > 0.0)) continue;
        double rho = law_density(law, p, T[k]), part = alpha[k] / sum;
        law->eos->state(law->instance.self, 1, &rho, &p, &rho_e, &c2);
        cells->energy[i] += part * rho_e;
        if (k < 3) cells->m[k][i] = part * rho;
        if (k < 3) continue;
        cells->m_other[0][i] = part * rho;
        cells->v0[0][i] = 1.0 / rho;
        cells->e0[0][i] = rho_e / rho;
    }
    cells->p[i] = p;
    cells->T[i] = T[0];
}

/* Volume, energy and Gibbs energies of an answer, and that there is more entropy than before; `came` is the cell
 * before. */
static void judge(const struct equilibrium_family *family, const struct equilibrium_cells *came,
                  const struct equilibrium_cells *cells, size_t i, struct worst *worst)
{
    struct equilibrium_point point;
    double volume = -1.0, heat = -cells->energy[i] - cells->p[i], size = fabs(cells->energy[i]), m[4], held[4];
    if (cells->regime[i] == EQUILIBRIUM_NONE) {
        worst->regimes++;
        return;
    }
    equilibrium_point_take(family, cells, i, &point);
    assert_true(equilibrium_point_solve(&point));
    for (unsigned k = 0; k < family->n; k++) {
        m[k] = cells->m[k][i];
        held[k] = came->m[k][i];
        if (!(m[k] > 0.0)) continue;
        volume += m[k] * cells->v[k][i];
        heat += m[k] * point.h[k];
        size += m[k] * fabs(point.h[k]);
    }
    for (unsigned k = 0; k < cells->n_other; k++) {
        volume += cells->m_other[k][i] * cells->v_other[k][i];
        heat += cells->m_other[k][i] * (cells->e0[k][i] + cells->p[i] * cells->v0[k][i]);
    }
    assert_true(m[0] >= 0.0 && m[1] >= 0.0 && cells->T[i] > 0.0 && isfinite(cells->p[i]));
    note(&worst->m, fabs((m[0] + m[1]) / (held[0] + held[1]) - 1.0));
    note(&worst->p, fabs(volume));
    note(&worst->T, fabs(heat) / size);
    double RT = family->R[1] * cells->T[i], drive = equilibrium_point_drive(&point) / RT;
    if (cells->regime[i] == EQUILIBRIUM_TWO_PHASE) note(&worst->gain, fabs(drive));
    if (cells->regime[i] == EQUILIBRIUM_ALL_VAPOUR) assert_true(drive <= 1e-9);
    if (cells->regime[i] == EQUILIBRIUM_ALL_LIQUID) assert_true(drive >= -1e-9);
    equilibrium_point_take(family, came, i, &point); /* at one p and T before the exchange */
    assert_true(equilibrium_point_solve(&point));
    double before = entropy(family, held, point.p, point.T), after = entropy(family, m, cells->p[i], cells->T[i]);
    if (!cells->n_other && !(after >= before - 1e-12 * fabs(before)))
        fail_msg("entropy falls: %.17g %.17g", before, after);
}

static void random_block(const struct phase_laws *laws, const struct law *stone, bool wild, uint64_t *seed,
                         struct equilibrium_cells *ret)
{
    *ret = (struct equilibrium_cells){.n = EQUILIBRIUM_BLOCK, .n_other = stone ? 1 : 0};
    if (stone) {
        ret->other[0] = (struct model_eos){.law = stone->eos, .self = stone->instance.self, .rho_fill = 1000.0};
    }
    for (size_t i = 0; i < ret->n; i++) draw(laws, stone, wild, seed, ret, i);
}

static long points(void)
{
    const char *wanted = getenv("BULLA_POINTS");
    return wanted ? strtol(wanted, NULL, 10) : POINTS;
}

/* Cells anywhere, with two phases, with air, with stone. */
static void test_random(void **state)
{
    (void)state;
    const long blocks = points() / EQUILIBRIUM_BLOCK / 12;
    struct law stone = law_preset("stiffened-gas", "begostone");
    uint64_t seed = 5;
    for (unsigned kind = 0; kind < 3 * PHASE_PAIRS; kind++) {
        struct phase_laws laws;
        struct worst worst = {0};
        struct equilibrium_effort effort = {0};
        phase_open(&phase_pairs[kind / 3], kind % 3 ? 3 : 2, &laws);
        for (long block = 0; block < blocks; block++) {
            struct equilibrium_cells cells, came;
            random_block(&laws, kind % 3 == 2 ? &stone : NULL, true, &seed, &came);
            cells = came;
            equilibrium_solve(&laws.family, &cells, &effort);
            for (size_t i = 0; i < cells.n; i++) judge(&laws.family, &came, &cells, i, &worst);
        }
        print_message("%s %u: volume %.2g, energy %.2g, drive %.2g, mass %.2g, no state %d, steps %.2f, searched %lld "
                      "of %lld\n",
                      phase_pairs[kind / 3].name, kind % 3, worst.p, worst.T, worst.gain, worst.m, worst.regimes,
                      (double)effort.steps / (double)effort.cells, effort.searched, effort.cells);
        assert_int_equal(worst.regimes, 0);
        /* A stone of 40 GPa resolves 1e-16 of its volume, 4e-6 Pa. */
        assert_true(worst.p < 1e-12 && worst.T < 1e-12 && worst.gain < (kind % 3 == 2 ? 1e-7 : 1e-9) &&
                    worst.m < 1e-15);
        phase_close(&laws);
    }
    instance_done(&stone.instance);
}

/* The bits of a cell do not depend on which others it is solved with; and what is in equilibrium stays, to
 * round-off. */
static void test_alone(void **state)
{
    (void)state;
    struct phase_laws laws;
    struct equilibrium_effort effort = {0};
    uint64_t seed = 9;
    phase_open(&phase_pairs[2], 3, &laws);
    for (int block = 0; block < 20; block++) {
        struct equilibrium_cells cells, one, came;
        random_block(&laws, NULL, true, &seed, &came);
        cells = came;
        equilibrium_solve(&laws.family, &cells, &effort);
        for (size_t i = 0; i < cells.n; i++) {
            one = (struct equilibrium_cells){.n = 1, .energy = {came.energy[i]}, .p = {came.p[i]}, .T = {came.T[i]}};
            for (unsigned k = 0; k < 3; k++) one.m[k][0] = came.m[k][i];
            equilibrium_solve(&laws.family, &one, &effort);
            assert_true(one.p[0] == cells.p[i] && one.T[0] == cells.T[i] && one.regime[0] == cells.regime[i]);
            for (unsigned k = 0; k < 2; k++) assert_true(one.m[k][0] == cells.m[k][i]);
        }
    }
    phase_close(&laws);
}

/* Energy below that of any state: said, nothing else. */
static void test_nothing(void **state)
{
    (void)state;
    struct phase_laws laws;
    struct equilibrium_effort effort = {0};
    struct equilibrium_cells cells = {.n = 1, .m = {{900.0}, {1e-3}}, .energy = {-5e9}, .p = {1e5}, .T = {300.0}};
    phase_open(&phase_pairs[0], 2, &laws);
    equilibrium_solve(&laws.family, &cells, &effort);
    assert_int_equal(cells.regime[0], EQUILIBRIUM_NONE);
    assert_int_equal(effort.refused, 1);
    phase_close(&laws);
}

/* Cell i moves to place `to` if it has two phases, with 1 % off its vapour and temperature. Returns the next place. */
static size_t keep(struct equilibrium_cells *cells, size_t i, size_t to)
{
    double all = cells->m[0][i] + cells->m[1][i];
    if (cells->regime[i] != EQUILIBRIUM_TWO_PHASE || cells->m[1][i] < 1e-9 * all) return to;
    for (unsigned k = 0; k < 3; k++) cells->m[k][to] = cells->m[k][i];
    cells->m[0][to] += 0.01 * cells->m[1][to];
    cells->m[1][to] *= 0.99;
    cells->p[to] = 1.01 * cells->p[i];
    cells->T[to] = cells->T[i];
    cells->energy[to] = cells->energy[i];
    return to + 1;
}

/* What a cell costs that a step has left near equilibrium; printed. */
static void test_cost(void **state)
{
    (void)state;
    for (unsigned n = 2; n < 4; n++) {
        struct phase_laws laws;
        struct equilibrium_cells cells, came;
        struct equilibrium_effort effort = {0};
        uint64_t seed = 3;
        struct timespec from, to;
        double spent = 0.0;
        phase_open(&phase_pairs[2], n, &laws);
        for (int block = 0; block < 200; block++) {
            random_block(&laws, NULL, false, &seed, &came);
            for (size_t i = 0; i < came.n; i++) came.m[1][i] = came.m[1][i] > 1e-6 ? came.m[1][i] : 1e-6;
            equilibrium_solve(&laws.family, &came, &(struct equilibrium_effort){0});
            size_t left = 0;
            for (size_t i = 0; i < came.n; i++) left = keep(&came, i, left);
            came.n = left;
            for (size_t i = 0; i < came.n; i++) came.energy[i] *= 1.0 + 1e-6 * contract_random(&seed, -1.0, 1.0);
            cells = came;
            clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &from);
            equilibrium_solve(&laws.family, &cells, &effort);
            clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &to);
            spent += (double)(to.tv_sec - from.tv_sec) * 1e9 + (double)(to.tv_nsec - from.tv_nsec);
        }
        print_message("%u materials: %.0f ns per cell, %.2f steps, %lld of %lld searched\n", n,
                      spent / (double)effort.cells, (double)effort.steps / (double)effort.cells, effort.searched,
                      effort.cells);
        phase_close(&laws);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_references), cmocka_unit_test(test_random), cmocka_unit_test(test_alone),
        cmocka_unit_test(test_nothing),    cmocka_unit_test(test_cost),
    };
    return cmocka_run_group_tests(tests, support_start, support_stop);
}
