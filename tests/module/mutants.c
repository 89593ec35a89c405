/* mutants.c - the contract suites can fail: a good module of each kind with one thing wrong at a time, each
 * found by the check that is there for it. Wrong functions call the good one and spoil what it gives. */
#include "mutants.h"

#include "bulla/eos.h"
#include "bulla/limiter.h"
#include "bulla/riemann.h"

static const struct bulla_eos *eos;
static const struct bulla_limiter *limiter;
static const struct bulla_riemann *riemann;

static int start(void **state)
{
    if (support_start(state)) return 1;
    eos = support_module("eos", "mnasg")->table;
    limiter = support_module("limiter", "mc")->table;
    riemann = support_module("riemann", "hllc")->table;
    return 0;
}

/* Equations of state. */

static void stiffer(const void *self, size_t n, IN rho, IN p, OUT rho_e, OUT rho_c2)
{
    eos->state(self, n, rho, p, rho_e, rho_c2);
    for (size_t i = 0; i < n; i++) rho_c2[i] *= 1.0001;
}

static void uneven(const void *self, size_t n, IN rho, IN p, OUT rho_e, OUT rho_c2)
{
    eos->state(self, n, rho, p, rho_e, rho_c2);
    if (n > 8) rho_e[8] *= 1.0 + 0x1p-52;
}

static void wide(const void *self, size_t n, IN rho, IN p, OUT rho_e, OUT rho_c2)
{
    eos->state(self, n, rho, p, rho_e, rho_c2);
    if (n > 8) rho_c2[n] = rho_c2[n - 1]; /* single points lie alone on the stack */
}

static void shared(const void *self, size_t n, IN rho, IN p, OUT rho_e, OUT rho_c2)
{
    bool bad = false;
    eos->state(self, n, rho, p, rho_e, rho_c2);
    for (size_t i = 0; i < n; i++) bad |= !(p[i] == p[i]);
    for (size_t i = 0; i < n && bad; i++) rho_e[i] = NAN;
}

static void repaired(const void *self, size_t n, IN rho, IN p, OUT rho_e, OUT rho_c2)
{
    eos->state(self, n, rho, p, rho_e, rho_c2);
    for (size_t i = 0; i < n; i++) {
        if (!(rho_c2[i] > 1.0)) rho_c2[i] = 1.0;
        if (!isfinite(rho_e[i])) rho_e[i] = 0.0;
    }
}

/* A jump beyond the stated range, and a fall without one. */
static void broken(const void *self, size_t n, IN rho, IN p, OUT rho_e, OUT rho_c2)
{
    eos->state(self, n, rho, p, rho_e, rho_c2);
    for (size_t i = 0; i < n; i++) rho_e[i] *= p[i] > 5e9 ? 1.003 : 1.0;
}

static void sagging(const void *self, size_t n, IN rho, IN p, OUT rho_e, OUT rho_c2)
{
    eos->state(self, n, rho, p, rho_e, rho_c2);
    for (size_t i = 0; i < n; i++) {
        double a, b;
        eos->linear(self, 1, &rho[i], &a, &b);
        rho_e[i] -= p[i] > 5e9 ? 1.1 * a * (p[i] - 5e9) : 0.0;
    }
}

static size_t eager(const void *self, size_t n, IN rho, IN p)
{
    size_t count = eos->count_outside(self, n, rho, p);
    for (size_t i = 0; i < n; i++) count += rho[i] < 10.0;
    return count;
}

static void steep(const void *self, size_t n, IN rho, IN p, OUT de_dp, OUT de_drho)
{
    eos->derivatives(self, n, rho, p, de_dp, de_drho);
    for (size_t i = 0; i < n; i++) de_dp[i] *= 1.00001;
}

static void shifted(const void *self, size_t n, IN rho, IN p, OUT de_dp, OUT de_drho)
{
    eos->derivatives(self, n, rho, p, de_dp, de_drho);
    for (size_t i = 0; i < n; i++) de_drho[i] += 100.0;
}

static void cold(const void *self, size_t n, IN rho, IN p, OUT T)
{
    eos->temperature(self, n, rho, p, T);
    for (size_t i = 0; i < n; i++) T[i] -= 300.0;
}

static void warm(const void *self, size_t n, IN rho, IN p, OUT T)
{
    eos->temperature(self, n, rho, p, T);
    for (size_t i = 0; i < n; i++) T[i] *= 1.001;
}

static void pressed(const void *self, size_t n, IN rho, IN p, OUT s)
{
    eos->entropy(self, n, rho, p, s);
    for (size_t i = 0; i < n; i++) s[i] += 1e-6 * p[i];
}

static void packed(const void *self, size_t n, IN rho, IN p, OUT s)
{
    eos->entropy(self, n, rho, p, s);
    for (size_t i = 0; i < n; i++) s[i] += rho[i];
}

static void dense(const void *self, size_t n, IN p, IN T, OUT rho)
{
    eos->density(self, n, p, T, rho);
    for (size_t i = 0; i < n; i++) rho[i] *= 1.0 + 1e-8;
}

static void low(const void *self, size_t n, IN rho, OUT p)
{
    eos->p_min(self, n, rho, p);
    for (size_t i = 0; i < n; i++) p[i] *= 1.1;
}

static void high(const void *self, size_t n, IN rho, OUT p)
{
    eos->p_min(self, n, rho, p);
    for (size_t i = 0; i < n; i++) p[i] *= 0.9;
}

static void bent(const void *self, size_t n, IN rho, OUT a, OUT b)
{
    eos->linear(self, n, rho, a, b);
    for (size_t i = 0; i < n; i++) b[i] *= 1.0 + 0x1p-52;
}

static void empty(const void *self, struct bulla_eos_range *ret_range)
{
    eos->range(self, ret_range);
    ret_range->T_max = ret_range->T_min;
}

static void test_eos(void **state)
{
    (void)state;
    const struct {
        struct bulla_eos wrong;
        const char *check;
    } mutants[] = {
        {{.state = stiffer}, "c^2 ="},
        {{.state = uneven}, "a row gives"},
        {{.state = wide}, "nothing written"},
        {{.state = shared}, "bad numbers"},
        {{.state = repaired}, "p = NaN"},
        {{.state = repaired}, "rho c^2 <= 0"},
        {{.state = broken}, "rho e grows with p"},
        {{.state = sagging}, "rho e grows with p"},
        {{.count_outside = eager}, "count_outside"},
        {{.derivatives = steep}, "d(rho e)/dp"},
        {{.derivatives = shifted}, "d(rho e)/drho"},
        {{.temperature = cold}, "well-posed for any"},
        {{.temperature = warm}, "T ds = de + p dv along p"},
        {{.entropy = pressed}, "T ds = de + p dv along p"},
        {{.entropy = packed}, "T ds = de + p dv along rho"},
        {{.density = dense}, "density(p, T)"},
        {{.p_min = low}, "well-posed for any"},
        {{.p_min = high}, "rho c^2 <= 0"},
        {{.linear = bent}, "linear"},
        {{.range = empty}, "the stated range"},
        {{.range = empty}, "there are states"},
    };
    for (size_t i = 0; i < sizeof mutants / sizeof *mutants; i++) {
        const struct bulla_eos *wrong = &mutants[i].wrong;
        struct bulla_eos table = *eos;
        if (wrong->state) table.state = wrong->state;
        if (wrong->derivatives) table.derivatives = wrong->derivatives;
        if (wrong->temperature) table.temperature = wrong->temperature;
        if (wrong->entropy) table.entropy = wrong->entropy;
        if (wrong->density) table.density = wrong->density;
        if (wrong->p_min) table.p_min = wrong->p_min;
        if (wrong->linear) table.linear = wrong->linear;
        if (wrong->range) table.range = wrong->range;
        if (wrong->count_outside) table.count_outside = wrong->count_outside;
        finds("eos", "mnasg", &table, mutants[i].check);
    }
}

/* Limiters, as factors on a good slope. */

static void triple(const void *self, size_t n, IN a, IN b, OUT slope)
{
    limiter->slope(self, n, a, b, slope);
    for (size_t i = 0; i < n; i++) slope[i] *= 3.0;
}

static void central(const void *self, size_t n, IN a, IN b, OUT slope)
{
    (void)self;
    for (size_t i = 0; i < n; i++) slope[i] = 0.5 * (a[i] + b[i]);
}

static void one_sided(const void *self, size_t n, IN a, IN b, OUT slope)
{
    limiter->slope(self, n, a, b, slope);
    for (size_t i = 0; i < n; i++) slope[i] *= a[i] > b[i] ? 0.5 : 1.0;
}

static void sized(const void *self, size_t n, IN a, IN b, OUT slope)
{
    limiter->slope(self, n, a, b, slope);
    for (size_t i = 0; i < n; i++) slope[i] *= fabs(a[i] + b[i]) / (fabs(a[i] + b[i]) + 1e-3);
}

static void weak(const void *self, size_t n, IN a, IN b, OUT slope)
{
    limiter->slope(self, n, a, b, slope);
    for (size_t i = 0; i < n; i++) slope[i] *= 0.9;
}

static void rough(const void *self, size_t n, size_t step, const double *w, OUT lower, OUT upper)
{
    limiter->edges(self, n, step, w, lower, upper);
    for (size_t i = 0; i < n; i++) upper[i] *= 1.0 + 0x1p-52;
}

static void test_limiter(void **state)
{
    (void)state;
    const struct {
        struct bulla_limiter wrong;
        const char *check;
    } mutants[] = {
        {{.slope = triple}, "0 <= slope/d <= 2"},
        {{.slope = central}, "no slope at an extreme"},
        {{.slope = one_sided}, "odd"},
        {{.slope = one_sided}, "symmetric"},
        {{.slope = sized}, "homogeneous"},
        {{.slope = weak}, "equal differences"},
        {{.edges = rough}, "edges are"},
    };
    for (size_t i = 0; i < sizeof mutants / sizeof *mutants; i++) {
        struct bulla_limiter table = *limiter;
        if (mutants[i].wrong.slope) table.slope = mutants[i].wrong.slope;
        if (mutants[i].wrong.edges) table.edges = mutants[i].wrong.edges;
        finds("limiter", "mc", &table, mutants[i].check);
    }
}

/* Limiters with two sides: the good edges, with a step as it should not be. */

static enum side { FAR, AVERSE, UPPER, SKEW, FLOOR, ROW, EXTREME } side;

static double side_spoilt(double step, double to, double from, size_t at)
{
    if (side == FAR) return 3.0 * step;
    if (side == AVERSE) return -step;
    if (side == SKEW) return from < 0.0 ? 0.9 * step : step;
    if (side == FLOOR) return fabs(step) < 1e-6 ? 0.0 : step;
    if (side == ROW) return at ? 0.9 * step : step;
    if (side == EXTREME && from * to < 0.0) return 0.1 * to;
    return step;
}

static void one_side(const void *self, size_t n, size_t step, const double *w, OUT lower, OUT upper)
{
    const struct bulla_limiter *koren = support_module("limiter", "koren")->table;
    koren->edges(self, n, step, w, lower, upper);
    for (size_t i = 0; i < n; i++) {
        double here = w[i], below = here - *(w + i - step), above = w[i + step] - here;
        upper[i] = here + side_spoilt(upper[i] - here, above, below, i);
        lower[i] = here - (side == UPPER ? 0.9 : 1.0) * side_spoilt(here - lower[i], below, above, i);
    }
}

static void test_sides(void **state)
{
    (void)state;
    static const struct bulla_limiter table = {.size = sizeof table, .edges = one_side, .flags = BULLA_TWO_SIDED};
    static const struct {
        enum side side;
        const char *check;
    } mutants[] = {
        {FAR, "an edge lies between"},
        {AVERSE, "an edge lies between"},
        {EXTREME, "both edges are"},
        {UPPER, "mirrored"},
        {SKEW, "odd"},
        {FLOOR, "homogeneous"},
        {ROW, "edges of a row"},
    };
    for (size_t i = 0; i < sizeof mutants / sizeof *mutants; i++) {
        side = mutants[i].side;
        finds("limiter", "koren", &table, mutants[i].check);
    }
}

/* Riemann solvers. */

/* What is spoilt, and how. */
static enum spoil { MASS, ENERGY, FACE, FRACTION, LEAK, TANGENT, TILT, ALONE, NOTHING } spoil;

static void spoilt(const void *self, const struct bulla_faces *faces)
{
    const struct bulla_flux *flux = &faces->flux;
    riemann->solve(self, faces);
    for (size_t i = 0; i < faces->n; i++) {
        double jump = faces->right.rho[i] - faces->left.rho[i];
        if (spoil == MASS) flux->m[0][i] *= 1.0 + 1e-9;
        if (spoil == ENERGY) flux->rho_E[i] -= faces->left.c[i] * jump * 1e3;
        if (spoil == FACE) flux->u[i] = faces->left.u[0][i];
        if (spoil == FRACTION && faces->n_alpha) flux->alpha[0][i] += 1e-9;
        if (spoil == LEAK && faces->n_alpha) flux->m[0][i] -= 1e-3 * faces->left.c[i] * jump;
        if (spoil == TANGENT && faces->n_velocity > 1)
            flux->momentum[1][i] += faces->left.rho[i] * (faces->right.u[1][i] - faces->left.u[1][i]);
        if (spoil == TILT) flux->momentum[0][i] += 1e-6 * (faces->right.p[i] - faces->left.p[i]);
        if (spoil == ALONE && faces->n_material > 1) flux->rho_E[i] *= 1.0 + 0x1p-52;
    }
}

static void test_riemann(void **state)
{
    (void)state;
    static const struct bulla_riemann table = {.size = sizeof table, .solve = spoilt};
    static const struct {
        enum spoil spoil;
        const char *check;
    } mutants[] = {
        {MASS, "equal sides"},  {ENERGY, "uniform p and u"},    {FACE, "nothing but pressure"},
        {FACE, "mirrored"},     {FRACTION, "alpha* lies"},      {FRACTION, "alpha* sums"},
        {LEAK, "with several"}, {LEAK, "mass fluxes sum"},      {TANGENT, "shear"},
        {TILT, "mirrored"},     {ALONE, "one material listed"}, {FRACTION, "supersonic"},
    };
    static const struct bulla_riemann boast = {.size = sizeof boast, .solve = spoilt, .resists = 1};
    for (size_t i = 0; i < sizeof mutants / sizeof *mutants; i++) {
        spoil = mutants[i].spoil;
        finds("riemann", "hllc", &table, mutants[i].check);
    }
    spoil = NOTHING;
    finds("riemann", "hllc", &boast, "resists: shear");
}

/* The classic mistake: values in a global, where the second material's replace the first one's. */

static void *made[64], *newest;
static size_t n_made;
static const struct bulla_module *original;

static int keep(const struct bulla_host *host, const struct bulla_value *values, void **ret_self)
{
    int code = original->open(host, values, ret_self);
    newest = *ret_self;
    assert_true(n_made < sizeof made / sizeof *made);
    if (!code) made[n_made++] = newest;
    return code;
}

static void global(const void *self, size_t n, IN rho, IN p, OUT T)
{
    (void)self;
    eos->temperature(newest, n, rho, p, T);
}

static void test_instances(void **state)
{
    (void)state;
    original = support_module("eos", "mnasg");
    struct bulla_eos table = *eos;
    struct bulla_module module = *original;
    table.temperature = global;
    module.table = &table;
    module.open = keep;
    module.close = NULL; /* here `newest` outlives its owner */
    struct contract contract = {.module = &module};
    assert_int_equal(contract_module_run(&contract, NULL), 0);
    while (n_made) original->close(made[--n_made]);
    assert_int_equal(contract_failed(&contract), 1);
    const struct contract_row *last = &contract.rows[contract.n_row - 1];
    assert_non_null(strstr(last->check, "do not touch each other"));
    assert_true(last->worst > last->limit);
}

/* Settings by hand: units and ranges are looked at, a missing one is named. */
static void test_settings(void **state)
{
    (void)state;
    static const struct {
        const char *setting, *says;
    } bad[] = {{"gama=1.4", "no such parameter"},
               {"gamma", "NAME=VALUE"},
               {"gamma=abc", "no quantity"},
               {"cv=3 m", "is wanted"},
               {"gamma=0.5", "allowed is"},
               {"cv=700", "parameter 'gamma' has no default; give one with --set gamma=VALUE"}};
    struct contract contract = {.module = support_module("eos", "ideal-gas")};
    for (size_t i = 0; i < sizeof bad / sizeof *bad; i++) {
        assert_int_equal(contract_module_run(&contract, (const char *const[]){bad[i].setting, NULL}), STATUS_CASE);
        if (!strstr(status_text(), bad[i].says)) fail_msg("'%s': %s", bad[i].setting, status_text());
    }
    assert_int_equal(contract_module_run(&contract, (const char *const[]){"gamma=1.2", "cv=0.7 kJ/kg/K", NULL}), 0);
    support_holds(&contract);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(test_eos),       cmocka_unit_test(test_limiter),
                                       cmocka_unit_test(test_sides),     cmocka_unit_test(test_riemann),
                                       cmocka_unit_test(test_instances), cmocka_unit_test(test_settings)};
    return cmocka_run_group_tests(tests, start, support_stop);
}
