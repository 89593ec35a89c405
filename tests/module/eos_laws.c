/* eos_laws.c - what must be true of every equation of state there is, asked of all of them in the same way: one list of
 * laws, presets and ways of evaluating, and for each the contract, sweeps far into its continuations, isentropes,
 * round trips. A law that is missing from the list is found. */
#include "law.h"

#include <unistd.h>

/* An isentrope: from rho(p, T) at p, in density by the factor `span`. */
struct start {
    double p, T, span;
};

/* A law. */
struct row {
    const char *module, *sets[4];
    double rho_most;                    /* of sweeps: three times what the co-volume or the range ends with */
    const struct contract_eos_box *far; /* beyond the stated range, where identities hold too; NULL: none */
    const struct start *start;          /* two */
    double slack;                       /* units in the last place of rho c^2 that p may lose in a round trip */
    double drift;                       /* of the entropy along isentropes, in units of cv */
    double rough;                       /* what identities may be off by in the contract */
};

static const struct contract_eos_box thin_gas = {{1e-3, 1e3}, -INFINITY, 1e10, {0.0, INFINITY}},
                                     dense_water = {{1.0, 2800.0}, -INFINITY, 1e11, {0.0, INFINITY}},
                                     on_curve = {{700.0, 3e3}, 1e3, 1e11, {10.0, 1e5}},
                                     in_published = {{510.0, 1490.0}, -INFINITY, 1e11, {272.0, 550.0}},
                                     in_refit = {{460.0, 1600.0}, -INFINITY, 1e11, {275.0, 850.0}},
                                     hard_core = {{1e-3, 2500.0}, -INFINITY, 1e11, {135.0, 2e4}},
                                     in_lemmon = {{1e-2, 1800.0}, -INFINITY, 1e11, {145.0, 1.5e4}},
                                     in_states = {{805.0, 1295.0}, -INFINITY, 1e11, {280.0, 690.0}},
                                     in_plugin = {{960.0, 1010.0}, 3e7, 1e9, {0.0, INFINITY}};

static const struct start of_air[2] = {{1e5, 300.0, 300.0}, {1e8, 1500.0, 0.01}},
                          of_water[2] = {{1e5, 300.0, 1.25}, {3e8, 350.0, 1.2}},
                          of_liquid[2] = {{1e5, 300.0, 1.2}, {3e8, 350.0, 1.1}},
                          of_products[2] = {{2e10, 3500.0, 0.02}, {1e8, 2500.0, 3.0}},
                          of_solid[2] = {{1e8, 320.0, 1.3}, {1e10, 800.0, 1.2}},
                          of_states[2] = {{1e5, 300.0, 1.1}, {3e8, 350.0, 0.95}};

static char table[4096], file[4200];

/* Tables that are no potential are several, which fit each other to their errors: `rough`. */
static const struct row rows[] = {
    {"ideal-gas", {"preset=air"}, 1e4, &thin_gas, of_air, 0, 1e-9, 1e-6},
    {"ideal-gas", {"preset=air-r287"}, 1e4, &thin_gas, of_air, 0, 1e-9, 1e-6},
    {"ideal-gas", {"preset=helium"}, 1e4, &thin_gas, of_air, 0, 1e-9, 1e-6},
    {"ideal-gas", {"preset=nitrogen"}, 1e4, &thin_gas, of_air, 0, 1e-9, 1e-6},
    {"ideal-gas", {"preset=argon"}, 1e4, &thin_gas, of_air, 0, 1e-9, 1e-6},
    {"ideal-gas", {"preset=krypton"}, 1e4, &thin_gas, of_air, 0, 1e-9, 1e-6},
    {"ideal-gas", {"preset=carbon-dioxide"}, 1e4, &thin_gas, of_air, 0, 1e-9, 1e-6},
    {"ideal-gas", {"preset=sf6"}, 1e4, &thin_gas, of_air, 0, 1e-9, 1e-6},
    {"ideal-gas", {"preset=r22"}, 1e4, &thin_gas, of_air, 0, 1e-9, 1e-6},
    {"ideal-gas", {"preset=water-vapour"}, 1e4, &thin_gas, of_air, 0, 1e-9, 1e-6},
    {"ideal-gas", {"preset=water-2016"}, 1e4, &thin_gas, of_air, 0, 1e-9, 1e-6},
    {"ideal-gas", {"preset=water-2004"}, 1e4, &thin_gas, of_air, 0, 1e-9, 1e-6},
    {"ideal-gas", {"preset=water-2017"}, 1e4, &thin_gas, of_air, 0, 1e-9, 1e-6},
    {"ideal-gas", {"preset=dodecane-2004"}, 1e4, &thin_gas, of_air, 0, 1e-9, 1e-6},
    {"stiffened-gas", {"preset=sg44"}, 9e3, &dense_water, of_water, 0, 1e-9, 1e-6},
    {"stiffened-gas", {"preset=sg4"}, 9e3, &dense_water, of_water, 0, 1e-9, 1e-6},
    {"stiffened-gas", {"preset=sg659"}, 9e3, &dense_water, of_water, 0, 1e-9, 1e-6},
    {"stiffened-gas", {"preset=sg659b"}, 9e3, &dense_water, of_water, 0, 1e-9, 1e-6},
    {"stiffened-gas", {"preset=sg3"}, 9e3, &dense_water, of_water, 0, 1e-9, 1e-6},
    {"stiffened-gas", {"preset=sg235"}, 9e3, &dense_water, of_water, 0, 1e-9, 1e-6},
    {"stiffened-gas", {"preset=water-2004"}, 9e3, &dense_water, of_water, 0, 1e-9, 1e-6},
    {"stiffened-gas", {"preset=water-2017"}, 9e3, &dense_water, of_water, 0, 1e-9, 1e-6},
    {"stiffened-gas", {"preset=ethanol"}, 2.4e3, NULL, of_liquid, 0, 1e-9, 1e-6},
    {"stiffened-gas", {"preset=dodecane-2004"}, 2.4e3, NULL, of_liquid, 0, 1e-9, 1e-6},
    {"stiffened-gas", {"preset=glycerol"}, 3.8e3, NULL, of_liquid, 0, 1e-9, 1e-6},
    {"stiffened-gas", {"preset=castor-oil"}, 2.9e3, NULL, of_liquid, 0, 1e-9, 1e-6},
    {"stiffened-gas", {"preset=mercury"}, 4e4, NULL, of_liquid, 0, 1e-9, 1e-6},
    {"stiffened-gas", {"preset=blood"}, 3.2e3, NULL, of_liquid, 0, 1e-9, 1e-6},
    {"stiffened-gas", {"preset=begostone"}, 6e3, NULL, of_liquid, 0, 1e-9, 1e-6},
    {"stiffened-gas", {"preset=begostone-15-6"}, 4.8e3, NULL, of_liquid, 0, 1e-9, 1e-6},
    {"stiffened-gas", {"preset=gypsum"}, 5.4e3, NULL, of_liquid, 0, 1e-9, 1e-6},
    {"stiffened-gas", {"preset=pmma"}, 3.6e3, NULL, of_liquid, 0, 1e-9, 1e-6},
    {"stiffened-gas", {"preset=gelatin"}, 3.1e3, NULL, of_liquid, 0, 1e-9, 1e-6},
    {"nasg", {"preset=water"}, 3 / 6.61e-4, &dense_water, of_water, 0, 1e-9, 1e-6},
    {"nasg", {"preset=water-2016"}, 3 / 6.61e-4, &dense_water, of_water, 0, 1e-9, 1e-6},
    {"mnasg", {"preset=water"}, 3 / 6.7212e-4, &dense_water, of_water, 0, 1e-9, 1e-6},
    {"tait", {"preset=water"}, 4600.0, &on_curve, of_water, 0, 1e-9, 1e-6},
    {"modified-tait", {"preset=published"}, 4600.0, &in_published, of_water, 0, 1e-9, 1e-6},
    {"modified-tait", {"preset=refit"}, 5700.0, &in_refit, of_water, 0, 1e-9, 1e-6},
    {"iapws95", {"preset=water", "eval=table"}, 5200.0, NULL, of_water, 0, 1e-9, 1e-6},
    {"iapws95", {"preset=water", "eval=analytic"}, 5200.0, NULL, of_water, 4, 1e-9, 1e-6},
    {"iapws95", {"preset=water", "interpolation=bicubic"}, 5200.0, NULL, of_water, 0, 1e-8, 1e-5},
    {"iapws95", {"preset=water", "interpolation=bilinear"}, 5200.0, NULL, of_water, 0, 3e-4, 0.05},
    {"iapws95-vapour", {"preset=water-vapour", "eval=table"}, 5200.0, NULL, NULL, 0, 1e-9, 1e-6},
    {"iapws95-vapour", {"preset=water-vapour", "eval=analytic"}, 5200.0, NULL, NULL, 4, 1e-9, 1e-6},
    {"peng-robinson", {"preset=air"}, 3 / 7.8e-4, &hard_core, of_air, 0, 1e-9, 1e-6},
    {"peng-robinson", {"preset=air", "eval=table", "table-size=256"}, 3 / 7.8e-4, NULL, of_air, 0, 2e-8, 1e-6},
    {"rkpr", {"preset=air", "eval=analytic"}, 3 / 8.8e-4, &hard_core, of_air, 0, 1e-9, 1e-6},
    {"rkpr", {"preset=air", "eval=table", "table-size=256"}, 3 / 8.8e-4, NULL, of_air, 0, 2e-8, 1e-6},
    {"helmholtz-air", {"preset=air", "eval=table"}, 5700.0, &in_lemmon, of_air, 0, 1e-9, 1e-6},
    {"helmholtz-air", {"preset=air", "eval=analytic"}, 5700.0, &in_lemmon, of_air, 0, 1e-9, 1e-6},
    {"rkpr", {"preset=air", "eval=table", "interpolation=bilinear"}, 3 / 8.8e-4, NULL, of_air, 0, 3e-4, 0.02},
    {"helmholtz-air", {"preset=air", "interpolation=bicubic"}, 5700.0, NULL, of_air, 0, 3e-8, 1e-5},
    {"helmholtz-air", {"preset=air", "interpolation=bilinear"}, 5700.0, NULL, of_air, 0, 2e-3, 0.2},
    {"table", {file}, 3900.0, &in_states, of_states, 0, 1e-9, 1e-6},
    {"jwl", {"preset=tnt"}, 4900.0, NULL, of_products, 0, 1e-9, 1e-6},
    {"jwl", {"preset=c4"}, 4800.0, NULL, of_products, 0, 1e-9, 1e-6},
    {"jwl", {"preset=petn"}, 5300.0, NULL, of_products, 0, 1e-9, 1e-6},
    {"cochran-chan", {"preset=nitromethane"}, 3400.0, NULL, of_solid, 0, 1e-9, 1e-6},
    {"cochran-chan", {"preset=copper"}, 2.6e4, NULL, of_solid, 0, 1e-9, 1e-6},
    {"cochran-chan", {"preset=tnt"}, 5500.0, NULL, of_solid, 0, 1e-9, 1e-6},
    {"tait-murnaghan", {"preset=water"}, 3000.0, &in_plugin, NULL, 0, 1e-9, 1e-6},
};

enum { ROWS = sizeof rows / sizeof *rows };

/* States of modified NASG, whose p(rho, T) is explicit. */
static void write_table(void)
{
    struct law law = law_preset("mnasg", "water");
    const struct bulla_value *v = law.instance.values;
    FILE *out = fopen(table, "w");
    assert_non_null(out);
    fprintf(out, "rho[kg/m3],T[K],p[Pa],e[J/kg],c[m/s],s[J/kg/K]\n");
    for (int r = 0; r < 60 * 40; r++) {
        double rho = 800.0 + 500.0 * (r / 40) / 59.0, T = 275.0 * pow(700.0 / 275.0, (r % 40) / 39.0);
        double p = (v[0].number - 1.0) * v[4].number * T / (1.0 / rho - v[2].number) - v[1].number;
        struct law_point at = law_at(&law, rho, p);
        fprintf(out, "%.17g,%.17g,%.17g,%.17g,%.17g,%.17g\n", rho, T, p, at.rho_e / rho, sqrt(at.c2), at.s);
    }
    assert_int_equal(fclose(out), 0);
    instance_done(&law.instance);
}

/* Runs `test` on every law. */
static void each(void (*test)(const struct row *row, const struct law *law))
{
    for (size_t i = 0; i < ROWS; i++) {
        struct law law = law_open(rows[i].module, rows[i].sets);
        print_message("%s %s %s\n", rows[i].module, rows[i].sets[0], rows[i].sets[1] ? rows[i].sets[1] : "");
        test(&rows[i], &law);
        instance_done(&law.instance);
    }
}

/* Every module of the kind, with every preset and every choice of `eval`, is in the list. */
static void test_all_there(void **state)
{
    (void)state;
    for (size_t i = 0; i < registry_count(); i++) {
        const struct bulla_module *module = registry_at(i)->module;
        if (strcmp(module->kind, "eos") != 0) continue;
        size_t presets = 0, found = 0;
        for (const struct bulla_preset *preset = module->presets; preset && preset->name; preset++) presets++;
        for (size_t k = 0; k < ROWS; k++) found += strcmp(rows[k].module, module->name) == 0;
        if (found < (presets ? presets : 1)) fail_msg("%s: %zu of %zu presets", module->name, found, presets);
    }
}

/* Does a table give what others than `thermal` say? */
static bool tabled(const struct row *row)
{
    bool made = row->rough > 1e-6;
    for (size_t i = 0; i < sizeof row->sets / sizeof *row->sets && row->sets[i]; i++)
        made = made || strcmp(row->sets[i], "eval=table") == 0;
    return made;
}

/* In the range that each law states, with each preset, as `bulla module check` does. */
static void contract_as_stated(const struct row *row, const struct law *law)
{
    struct contract contract = {.module = law->instance.module};
    assert_int_equal(contract_module_run(&contract, row->sets), 0);
    assert_in_range(contract.n_row, 20, 33);
    for (unsigned i = 0; i < contract.n_row; i++)
        if (contract.rows[i].limit == 1e-6 || (tabled(row) && strstr(contract.rows[i].check, "thermal(")))
            contract.rows[i].limit = row->rough; /* `thermal` is the law's own, what it is compared with a table */
    support_holds(&contract);
}

/* Beyond it, where identities must hold all the same. */
static void contract_beyond(const struct row *row, const struct law *law)
{
    struct contract contract = {.module = law->instance.module, .self = law->instance.self, .preset = "beyond"};
    if (!row->far) return;
    contract.strict = true;
    contract_eos_run_in(&contract, row->far);
    support_holds(&contract);
}

static void test_contract(void **state)
{
    (void)state;
    each(contract_as_stated);
    each(contract_beyond);
}

/* Any density, any pressure above p_min. */
static void sweep(const struct row *row, const struct law *law)
{
    law_sweep(law, row->rho_most);
}

static void test_sweep(void **state)
{
    (void)state;
    each(sweep);
}

/* What a row counts is what its points count, wherever they lie. */
static void counts(const struct row *row, const struct law *law)
{
    enum { N = 96 };
    uint64_t seed = 7;
    if (!BULLA_EOS_HAS(law->eos, count_outside)) return;
    for (int round = 0; round < 40; round++) {
        double rho[N], p[N];
        size_t count = 0;
        for (size_t i = 0; i < N; i++) {
            rho[i] = exp(contract_random(&seed, log(1e-3), log(row->rho_most)));
            p[i] = exp(contract_random(&seed, log(1.0), log(1e11)));
            count += law->eos->count_outside(law->instance.self, 1, &rho[i], &p[i]);
        }
        assert_int_equal(count, law->eos->count_outside(law->instance.self, N, rho, p));
    }
}

static void test_counts(void **state)
{
    (void)state;
    each(counts);
}

/* Along dp/drho = c^2 the entropy stays, to 1e-9 of the specific heat. */
static void isentropes(const struct row *row, const struct law *law)
{
    for (const struct start *start = row->start; start && start < row->start + 2; start++) {
        double rho = law_density(law, start->p, start->T), h = 1e-6 * (fabs(start->p) + 1e6);
        double warmer = law_at(law, rho, start->p + h).T - law_at(law, rho, start->p - h).T;
        double cv = law_at(law, rho, start->p).de_dp / rho * 2.0 * h / warmer;
        law_isentrope(law, rho, start->p, start->span, row->drift, cv);
    }
}

static void test_isentropes(void **state)
{
    (void)state;
    each(isentropes);
}

static void round_trips(const struct row *row, const struct law *law)
{
    law_round_trips(law, row->rho_most, row->slack);
}

static void test_round_trips(void **state)
{
    (void)state;
    each(round_trips);
}

static int start(void **state)
{
    char path[4096];
    if (support_start(state)) return 1;
    snprintf(path, sizeof path, "%s/tests/plugin/eos-tait-murnaghan.so", getenv("BULLA_BUILD"));
    if (registry_load(path)) return 1;
    snprintf(table, sizeof table, "%s/tests/laws_table.csv", getenv("BULLA_BUILD"));
    snprintf(file, sizeof file, "file=%s", table);
    write_table();
    return 0;
}

static int stop(void **state)
{
    remove(table);
    return support_stop(state);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_all_there), cmocka_unit_test(test_contract),   cmocka_unit_test(test_sweep),
        cmocka_unit_test(test_counts),    cmocka_unit_test(test_isentropes), cmocka_unit_test(test_round_trips),
    };
    return cmocka_run_group_tests(tests, start, stop);
}
