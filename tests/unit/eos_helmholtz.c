/* eos_helmholtz.c - the laws that are given by a Helmholtz energy: their formulas against the official check values and
 * points computed with 60 digits, the modules over them with both ways of evaluation, tables against what is promised
 * of them, continuations (tests/data/eos has the numbers and where they come from). */
#include "../module/support.h"

#include "../../modules/eos/helmholtz/iapws95_terms.h"
#include "../../modules/eos/helmholtz/lemmon_air_terms.h"
#include "formulas.h"
#include "bulla/eos.h"

#define EPSILON 2.220446049250313e-16

/* An open instance. */
struct law {
    struct instance instance;
    const struct bulla_eos *eos;
};

static struct law open_law(const char *name, const char *eval, double size)
{
    struct law law = {0};
    const struct bulla_module *module = support_module("eos", name);
    const struct bulla_value values[] = {{.number = size}, {.text = eval}, {.text = NULL}};
    if (instance_open(module, values, &law.instance)) fail_msg("%s", status_text());
    law.eos = module->table;
    return law;
}

struct point {
    double e, c2, T, s, e_p, de_drho;
};

static struct point at(const struct law *law, double rho, double p)
{
    const void *self = law->instance.self;
    struct point point;
    law->eos->state(self, 1, &rho, &p, &point.e, &point.c2);
    law->eos->derivatives(self, 1, &rho, &p, &point.e_p, &point.de_drho);
    law->eos->temperature(self, 1, &rho, &p, &point.T);
    law->eos->entropy(self, 1, &rho, &p, &point.s);
    point.e /= rho;
    point.c2 /= rho;
    point.e_p /= rho;
    return point;
}

static size_t count_outside(const struct law *law, double rho, double p)
{
    return law->eos->count_outside(law->instance.self, 1, &rho, &p);
}

/* Rows of a file as numbers, text as NaN; lines with # are left out. Returns how many columns were found. */
static int read_row(FILE *file, double *column, int most)
{
    char line[1024];
    do
        if (!fgets(line, sizeof line, file)) return 0;
    while (line[0] == '#');
    int n = 0;
    for (char *at_text = line, *end; n < most; at_text = end + 1) {
        column[n++] = strtod(at_text, &end);
        if (end == at_text) {
            column[n - 1] = NAN;
            end = at_text + strcspn(at_text, ",\n");
        }
        if (*end != ',') break;
    }
    return n;
}

static FILE *data(const char *name)
{
    char path[256];
    snprintf(path, sizeof path, "tests/data/eos/%s", name);
    FILE *file = fopen(path, "r");
    if (!file) fail_msg("no %s", path);
    return file;
}

/* Table 7 of IAPWS R6-95: one phase, vapour and near-critical states too. The release prints nine digits. */
static void test_official_values(void **state)
{
    (void)state;
    FILE *file = data("iapws95_R6check.csv");
    char line[256], quantity[32];
    double T, rho, official;
    int count = 0;
    while (fgets(line, sizeof line, file)) {
        if (sscanf(line, "7,%lf,%lf,%31[^,],%lf", &T, &rho, quantity, &official) != 4) continue;
        struct exact exact = exact_at(&iapws95_fluid, rho, T);
        double got = 1e-6 * exact.p;
        if (quantity[0] == 'c') got = 1e-3 * exact.cv;
        if (quantity[0] == 'w') got = sqrt(exact.c2);
        if (quantity[0] == 's') got = 1e-3 * exact.s;
        support_near(line, got, official, 5e-9, official);
        count++;
    }
    fclose(file);
    assert_int_equal(count, 44);
}

/* Liquid and vapour at T: equal pressure and free enthalpy, by Newton from the printed densities. */
static void saturate(double T, double rho[2], struct exact phase[2])
{
    for (int round = 0; round < 30; round++) {
        double g[2], p_r[2];
        for (int k = 0; k < 2; k++) {
            double h = 1e-6 * rho[k];
            phase[k] = exact_at(&iapws95_fluid, rho[k], T);
            g[k] = phase[k].h - T * phase[k].s;
            p_r[k] = (exact_at(&iapws95_fluid, rho[k] + h, T).p - exact_at(&iapws95_fluid, rho[k] - h, T).p) / (2 * h);
        }
        double dp = phase[0].p - phase[1].p, dg = g[0] - g[1], per = 1.0 / rho[0] - 1.0 / rho[1];
        double common = (dp / rho[1] - dg) / per; /* change of p_liquid that makes both equal, and of p_vapour */
        rho[0] += common / p_r[0];
        rho[1] += (common + dp) / p_r[1];
    }
}

/* Table 8: saturation at three temperatures, from nothing but the formulation. */
static void test_official_saturation(void **state)
{
    (void)state;
    static const struct {
        double T, p, rho[2], h[2], s[2];
    } rows[] = {
        {275, 0.000698451167, {999.887406, 0.00550664919}, {7.75972202, 2504.28995}, {0.028309467, 9.10660121}},
        {450, 0.932203564, {890.34125, 4.8120036}, {749.161585, 2774.41078}, {2.10865845, 6.60921221}},
        {625, 16.9082693, {567.090385, 118.29028}, {1686.26976, 2550.71625}, {3.80194683, 5.18506121}},
    };
    for (size_t i = 0; i < sizeof rows / sizeof *rows; i++) {
        double rho[2] = {rows[i].rho[0], rows[i].rho[1]};
        struct exact phase[2];
        saturate(rows[i].T, rho, phase);
        for (int k = 0; k < 2; k++) {
            if (k == 1) support_near("p", 1e-6 * phase[k].p, rows[i].p, 5e-9, rows[i].p); /* liquid: round-off */
            support_near("rho", rho[k], rows[i].rho[k], 5e-9, rho[k]);
            support_near("h", 1e-3 * phase[k].h, rows[i].h[k], 5e-9, rows[i].h[k]);
            support_near("s", 1e-3 * phase[k].s, rows[i].s[k], 5e-9, rows[i].s[k]);
        }
    }
}

enum { RHO, TEMPERATURE, P, E, S, H, CV, CP, C2, GAMMA, DEDP, DEDRHO, COLUMNS };

/* The formulas at every point of a file; c^2 near spinodals is a small difference. */
static void check_formulas(const struct helmholtz_fluid *fluid, const char *name, int least)
{
    FILE *file = data(name);
    double column[COLUMNS];
    int count = 0;
    while (read_row(file, column, COLUMNS) >= COLUMNS) {
        struct exact exact = exact_at(fluid, column[RHO], column[TEMPERATURE]);
        support_near("p", exact.p, column[P], 1e-10, fabs(column[P]));
        support_near("e", exact.e, column[E], 1e-10, fabs(column[E]));
        support_near("s", exact.s, column[S], 1e-10, fabs(column[S]));
        support_near("cv", exact.cv, column[CV], 1e-10, column[CV]);
        support_near("c2", exact.c2, column[C2], 1e-10, column[C2]);
        count++;
    }
    fclose(file);
    assert_true(count >= least);
}

static void test_formulas(void **state)
{
    (void)state;
    check_formulas(&iapws95_fluid, "iapws95_points.csv", 45);
    check_formulas(&iapws95_fluid, "iapws95_hugoniot_1bar_300K.csv", 40);
    check_formulas(&lemmon_air_fluid, "air_lemmon_points.csv", 38);
}

/* What a way of evaluating is allowed to miss, relative: T; c; e in units of p/rho + c^2. */
struct bound {
    double T, c, e;
};

/* All slots at the points of a file that lie in the domain; tables may miss more in tension, near the spinodal.
 * Returns their number. */
static int check_points(const struct law *law, const char *name, struct bound stated)
{
    FILE *file = data(name);
    double column[COLUMNS];
    int count = 0;
    while (read_row(file, column, COLUMNS) >= COLUMNS) {
        double rho = column[RHO], p = column[P], back;
        if (count_outside(law, rho, p)) continue;
        struct bound bound = stated;
        if (rho > 600.0 && p < 1e3 && stated.T > 1e-9)
            bound = (struct bound){30 * stated.T, 30 * stated.c, 30 * stated.e};
        struct point point = at(law, rho, p);
        double heat = column[CV] * column[TEMPERATURE];
        support_near("T", point.T, column[TEMPERATURE], bound.T, column[TEMPERATURE]);
        support_near("c", sqrt(point.c2), sqrt(column[C2]), bound.c, sqrt(column[C2]));
        support_near("e", point.e, column[E], bound.e, fabs(column[E]) + heat);
        support_near("s", point.s, column[S], bound.e, fabs(column[S]) + column[CV]);
        support_near("e_p", point.e_p, column[DEDP], 10 * bound.c, column[DEDP]);
        support_near("e_rho", (point.de_drho - point.e) / rho, column[DEDRHO], 10 * bound.c,
                     fabs(column[DEDRHO]) + fabs(column[E]) / rho);
        law->eos->density(law->instance.self, 1, &p, &column[TEMPERATURE], &back);
        support_near("rho(p, T)", back, rho, bound.T * column[TEMPERATURE] * 10, rho);
        count++;
    }
    fclose(file);
    return count;
}

/* Air: the whole of its range, from 3e-2 kg/m3 to 1350, and 159 K to 2400 K. */
static void test_points_of_air(void **state)
{
    (void)state;
    static const struct {
        const char *eval;
        double size;
        struct bound bound;
    } ways[] = {
        {"analytic", 128, {1e-10, 1e-10, 1e-10}},
        {"table", 64, {2e-7, 6e-5, 2e-6}},
        {"table", 128, {1e-8, 2e-6, 2e-8}},
        {"table", 256, {2e-9, 4e-7, 4e-9}},
    };
    for (size_t i = 0; i < sizeof ways / sizeof *ways; i++) {
        struct law law = open_law("helmholtz-air", ways[i].eval, ways[i].size);
        assert_true(check_points(&law, "air_lemmon_points.csv", ways[i].bound) >= 38);
        instance_done(&law.instance);
    }
}

static void test_points_of_water(void **state)
{
    (void)state;
    static const struct {
        const char *eval;
        double size;
        struct bound bound;
    } ways[] = {
        {"analytic", 128, {1e-10, 1e-10, 1e-10}},
        {"table", 64, {1.6e-5, 2.4e-3, 3e-5}},
        {"table", 128, {1.6e-7, 3e-5, 5e-7}},
        {"table", 256, {2e-9, 2.6e-6, 1e-8}},
    };
    for (size_t i = 0; i < sizeof ways / sizeof *ways; i++) {
        struct law law = open_law("iapws95", ways[i].eval, ways[i].size);
        assert_true(check_points(&law, "iapws95_points.csv", ways[i].bound) >= 35);
        assert_true(check_points(&law, "iapws95_hugoniot_1bar_300K.csv", ways[i].bound) >= 40);
        assert_true(check_points(&law, "iapws95_hugoniot_1bar_288K.csv", ways[i].bound) >= 40);
        instance_done(&law.instance);
    }
}

/* Along the isentrope of 288.15 K, 1 bar to 10 GPa. */
static void test_isentrope(void **state)
{
    (void)state;
    struct law law = open_law("iapws95", "analytic", 128);
    FILE *file = data("iapws95_isentrope_1bar_288K.csv");
    double column[COLUMNS], s = NAN;
    int count = 0;
    while (read_row(file, column, COLUMNS) >= COLUMNS) {
        if (count_outside(&law, column[RHO], column[P])) continue;
        struct point point = at(&law, column[RHO], column[P]);
        if (count++ == 0) s = point.s;
        support_near("s", point.s, s, 1e-9, s);
        support_near("T", point.T, column[TEMPERATURE], 1e-10, column[TEMPERATURE]);
    }
    fclose(file);
    assert_true(count >= 40);
    instance_done(&law.instance);
}

/* A state from numbers u, w in 0 .. 1: any density of the domain, any temperature. */
static void draw(const struct helmholtz_fluid *fluid, double rho, double T_low, double T_high, double w, double *ret_T,
                 double *ret_p)
{
    *ret_T = T_low * pow(T_high / T_low, w * w);
    *ret_p = exact_at(fluid, rho, *ret_T).p;
}

/* Derivatives of e by differences of e, and c^2 = (p/rho^2 - e_rho)/e_p, at one state. */
static void check_identities(const struct law *law, double rho, double p, double dp)
{
    struct point here = at(law, rho, p), up = at(law, rho, p + dp), down = at(law, rho, p - dp);
    double dr = 1e-6 * rho, size = here.c2 * here.e_p + fabs(p) / (rho * rho);
    struct point dense = at(law, rho + dr, p), thin = at(law, rho - dr, p);
    double e_rho = (here.de_drho - here.e) / rho;
    support_near("e_p", (up.e - down.e) / (2 * dp), here.e_p, 1e-6, here.e_p + 1e-9 * fabs(here.e) / dp);
    support_near("e_rho", (dense.e - thin.e) / (2 * dr), e_rho, 1e-6, fabs(e_rho) + size + 1e-9 * fabs(here.e) / dr);
    support_near("c2", (p / (rho * rho) - e_rho) / here.e_p, here.c2, 1e-6, here.c2);
    support_near("T ds", here.T * (up.s - down.s) / (2 * dp), here.e_p, 1e-6,
                 here.e_p + 1e-9 * here.T * fabs(here.s) / dp);
}

static void check_identities_inside(const struct law *law, const struct helmholtz_fluid *fluid, const double rho[2],
                                    const double T[2])
{
    int count = 0;
    for (int i = 0; i < 1500; i++) {
        double density = rho[0] + (rho[1] - rho[0]) * (i + 0.5) / 1500, temperature, p;
        draw(fluid, density, T[0], T[1], fmod(0.618 * i, 1.0), &temperature, &p);
        double dp = 1e-5 * (fabs(p) + 1e6);
        if (count_outside(law, density * 1.001, p) || count_outside(law, density, p - 2 * dp)) continue;
        check_identities(law, density, p, dp);
        count++;
    }
    assert_true(count > 800);
}

/* One potential: whatever the table says, derivatives, sound speed and entropy say the same. */
static void test_identities(void **state)
{
    (void)state;
    const double water[2] = {470, 1700}, air[2] = {1e-2, 1800}, warm[2] = {300, 3000}, hot[2] = {145, 15000};
    for (int way = 0; way < 2; way++) {
        const char *eval = way ? "analytic" : "table";
        struct law law = open_law("iapws95", eval, 128), gas = open_law("helmholtz-air", eval, 128);
        check_identities_inside(&law, &iapws95_fluid, water, warm);
        check_identities_inside(&gas, &lemmon_air_fluid, air, hot);
        instance_done(&law.instance);
        instance_done(&gas.instance);
    }
}

/* At any density and any p > p_min: e grows with p, c^2 > 0, T > 0, all finite. Beyond the ends in density and below
 * the domain e stays the integral of its derivatives: no jumps. */
static void check_sweep(const struct law *law, double rho_most)
{
    double p_min, rho = 1e-3;
    size_t outside = 0, all = 0;
    for (; rho < rho_most; rho *= 1.013) {
        double last = -INFINITY;
        law->eos->p_min(law->instance.self, 1, &rho, &p_min);
        for (double above = 1e-2; above <= 1.01e11; above *= 1.7) {
            struct point point = at(law, rho, p_min + above);
            bool finite = isfinite(point.e + point.c2 + point.T + point.s + point.e_p + point.de_drho);
            if (!finite || !(point.e_p > 0) || !(point.c2 > 0) || !(point.T > 0) || !(point.e >= last))
                fail_msg("rho %g, p %g: e %g, e_p %g, c2 %g, T %g, s %g", rho, p_min + above, point.e, point.e_p,
                         point.c2, point.T, point.s);
            last = point.e;
            outside += count_outside(law, rho, p_min + above);
            all++;
        }
    }
    assert_true(outside > all / 4 && outside < all);
}

/* Over the ends of the domain in density and in temperature e is continuous, and its derivative in p. */
static void check_seam(const struct law *law, double rho, double p)
{
    const double near = 1e-9;
    for (int across = 0; across < 2; across++) {
        double dr = across ? near * rho : 0.0, dp = across ? 0.0 : near * (fabs(p) + 1e6);
        struct point below = at(law, rho - dr, p - dp), above = at(law, rho + dr, p + dp), here = at(law, rho, p);
        double along = 2 * dp * here.e_p, slope = 2 * dr * (fabs(here.de_drho - here.e) + above.c2 * above.e_p) / rho;
        support_near("e", above.e, below.e + along, 1e-12, fabs(below.e) + 1e5 + 1e12 * (3 * slope + 1e-5 * along));
        support_near("e_p", above.e_p, below.e_p, 1e-5, below.e_p);
        support_near("T", above.T, below.T, 1e-6, below.T);
    }
}

static void test_continuation(void **state)
{
    (void)state;
    for (int way = 0; way < 2; way++) {
        struct law law = open_law("iapws95", way ? "analytic" : "table", 128);
        if (!way) {
            struct law gas = open_law("helmholtz-air", "table", 128);
            check_sweep(&law, 4600.0);
            check_sweep(&gas, 6000.0);
            instance_done(&gas.instance);
        }
        for (double p = -5e8; p < 3e10; p += 1.3e9) {
            check_seam(&law, 467.0, p);
            check_seam(&law, 1720.0, p);
        }
        for (double rho = 500.0; rho < 1700.0; rho += 17.0) /* the lower edge: where the count changes */
            for (double low = -6e8, high = 2e10, p = 0.0; high - low > 1e-3; check_seam(&law, rho, p)) {
                p = 0.5 * (low + high);
                if (count_outside(&law, rho, p)) low = p;
                else high = p;
                if (exact_at(&iapws95_fluid, rho, 3100.0).p < high) high = exact_at(&iapws95_fluid, rho, 3100.0).p;
            }
        instance_done(&law.instance);
    }
}

/* p from e: Newton from far off comes back to p, to the round-off of e. */
static void test_round_trip(void **state)
{
    (void)state;
    struct law law = open_law("iapws95", "table", 256);
    for (int i = 0; i < 400; i++) {
        double rho = 300.0 + 4.0 * i, want = 1e3 * pow(1e7, fmod(0.618 * i, 1.0)), p = 1e8;
        struct point aim = at(&law, rho, want), here = at(&law, rho, p);
        for (int round = 0; round < 60; round++) {
            here = at(&law, rho, p);
            p -= (here.e - aim.e) / here.e_p;
        }
        support_near("p", p, want, 1e-12, want + 4 * EPSILON * (fabs(aim.e) + want / rho) / aim.e_p * 1e12);
    }
    instance_done(&law.instance);
}

/* The slot for closures gives bit by bit what the others give. */
static void test_energy_slot(void **state)
{
    (void)state;
    enum { N = 37 };
    for (int way = 0; way < 2; way++) {
        struct law law = open_law("iapws95", way ? "analytic" : "table", 128);
        double rho[N], p[N], e[N], c2[N], e_p[N], e_rho[N], e_too[N], e_p_too[N];
        for (int i = 0; i < N; i++) {
            rho[i] = 100.0 * pow(30.0, i / 36.0);
            p[i] = 1e4 * pow(1e6, fmod(0.618 * i, 1.0));
        }
        law.eos->state(law.instance.self, N, rho, p, e, c2);
        law.eos->derivatives(law.instance.self, N, rho, p, e_p, e_rho);
        law.eos->energy(law.instance.self, N, rho, p, e_too, e_p_too);
        assert_memory_equal(e, e_too, sizeof e);
        assert_memory_equal(e_p, e_p_too, sizeof e_p);
        instance_done(&law.instance);
    }
}

static struct law open_preset(const char *name, const char *preset_name)
{
    const struct bulla_module *module = support_module("eos", name);
    struct bulla_value values[16] = {{0}};
    const struct bulla_preset *preset = module->presets;
    while (strcmp(preset->name, preset_name) != 0) preset++;
    for (unsigned i = 0; i < instance_param_count(module); i++) {
        values[i].number = preset->values[i];
        if (module->params[i].type == BULLA_CHOICE)
            values[i].text = strcmp(module->params[i].name, "eval") == 0 ? "analytic" : "bicubic";
    }
    struct law law = {.eos = module->table};
    if (instance_open(module, values, &law.instance)) fail_msg("%s", status_text());
    return law;
}

/* Mixtures of air (RKPR), water (IAPWS-95) and tissue (MNASG) at one pressure, closed by an independent program:
 * energies at the given pressure add up to the given sum, temperatures of all are the given ones. */
static void test_mixtures(void **state)
{
    (void)state;
    struct law laws[] = {open_preset("rkpr", "air"), open_law("iapws95", "table", 256), open_preset("mnasg", "water")};
    FILE *file = data("mixture_points.csv");
    char line[1024];
    int count = 0;
    while (fgets(line, sizeof line, file)) {
        double alpha[3] = {0}, rho[3], rho_e, p, T[3], sum = 0.0, size = 0.0;
        int n = sscanf(line, "2;rkpr_air|iapws_water;%lf|%lf;%lf|%lf;%lf;%lf;%lf|%lf;", &alpha[0], &alpha[1], &rho[0],
                       &rho[1], &rho_e, &p, &T[0], &T[1]);
        if (n != 8)
            n = sscanf(line, "3;rkpr_air|iapws_water|tissue_mnasg;%lf|%lf|%lf;%lf|%lf|%lf;%lf;%lf;%lf|%lf|%lf;",
                       &alpha[0], &alpha[1], &alpha[2], &rho[0], &rho[1], &rho[2], &rho_e, &p, &T[0], &T[1], &T[2]);
        if (n < 8) continue;
        for (int l = 0; l < 3 && alpha[l] > 0.0; l++) {
            struct point point = at(&laws[l], rho[l], p);
            sum += alpha[l] * rho[l] * point.e;
            size += alpha[l] * (rho[l] * fabs(point.e) + point.c2 * rho[l]);
            support_near("T", point.T, T[l], 1e-8, T[l]);
        }
        support_near("rho e", sum, rho_e, 1e-9, size);
        count++;
    }
    fclose(file);
    assert_true(count >= 5);
    for (int l = 0; l < 3; l++) instance_done(&laws[l].instance);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_official_values), cmocka_unit_test(test_official_saturation),
        cmocka_unit_test(test_formulas),        cmocka_unit_test(test_points_of_air),
        cmocka_unit_test(test_points_of_water), cmocka_unit_test(test_isentrope),
        cmocka_unit_test(test_identities),      cmocka_unit_test(test_continuation),
        cmocka_unit_test(test_round_trip),      cmocka_unit_test(test_energy_slot),
        cmocka_unit_test(test_mixtures),
    };
    return cmocka_run_group_tests(tests, support_start, support_stop);
}
