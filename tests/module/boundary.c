/* boundary.c - the contract of kind "boundary" (core/suite/contract_boundary.c): walls that keep it, one fault for each
 * check that must find it, and descriptors that contradict themselves. */
#include "mutants.h"

#include "bulla/boundary.h"
#include "plug/vet.h"

/* Half of what arrives goes on into the wall. */
static void yielding(const void *self, const struct bulla_behind *faces)
{
    (void)self;
    for (size_t i = 0; i < faces->n; i++) {
        double Z = faces->Z[i], p = faces->p_start[i], u = faces->u_start[i];
        double moves = (faces->p[i] - p + Z * (faces->u[0][i] - u)) / (4.0 * Z);
        faces->p_behind[i] = p + 3.0 * Z * moves;
        faces->u_behind[0][i] = u + moves;
    }
}

static void mirror(const void *self, const struct bulla_behind *faces)
{
    (void)self;
    for (size_t i = 0; i < faces->n; i++) faces->u_behind[0][i] = -faces->u[0][i];
}

/* Faults: in the pressure, the fractions, the densities, the velocity. */
static void endless(const void *self, const struct bulla_behind *faces)
{
    yielding(self, faces);
    for (size_t i = 0; i < faces->n; i++)
        if (faces->p[i] > 1e9) faces->p_behind[i] = (double)INFINITY;
}

static void leaking(const void *self, const struct bulla_behind *faces)
{
    yielding(self, faces);
    for (size_t i = 0; i < faces->n; i++) faces->alpha_behind[0][i] *= 1.0 - 1e-9;
}

static void swapping(const void *self, const struct bulla_behind *faces)
{
    yielding(self, faces);
    for (size_t i = 0; i < faces->n && faces->n_material == 2; i++) {
        faces->alpha_behind[0][i] = faces->alpha[1][i];
        faces->alpha_behind[1][i] = faces->alpha[0][i];
    }
}

static void emptying(const void *self, const struct bulla_behind *faces)
{
    yielding(self, faces);
    for (size_t i = 0; i < faces->n; i++) faces->rho_behind[0][i] -= 1.0;
}

static void pushing(const void *self, const struct bulla_behind *faces)
{
    yielding(self, faces);
    for (size_t i = 0; i < faces->n; i++) faces->p_behind[i] *= 1.0 + 1e-9;
}

static void sliding(const void *self, const struct bulla_behind *faces)
{
    mirror(self, faces);
    for (size_t i = 0; i < faces->n && faces->n_velocity > 1; i++) faces->u_behind[1][i] += 1e-6;
}

static void patching(const void *self, const struct bulla_behind *faces)
{
    yielding(self, faces);
    for (size_t i = 0; i < faces->n; i++)
        if (!isfinite(faces->p_behind[i])) faces->p_behind[i] = 1e5;
}

static void straying(const void *self, const struct bulla_behind *faces)
{
    yielding(self, faces);
    if (faces->n > 8) faces->p_behind[8] *= 1.0 + 0x1p-52;
}

static const struct bulla_module wall = {.magic = BULLA_MAGIC,
                                         .abi = BULLA_ABI,
                                         .size = sizeof wall,
                                         .kind = "boundary",
                                         .name = "wall",
                                         .version = "1",
                                         .doc = "Of a test.",
                                         .cite = "none"};

static struct bulla_boundary table_of(void (*fill)(const void *, const struct bulla_behind *), uint32_t traits)
{
    return (struct bulla_boundary){sizeof(struct bulla_boundary), traits, fill};
}

enum { YIELDS = BULLA_BEHIND_REFERS | BULLA_BEHIND_OPEN, MIRRORS = BULLA_BEHIND_MIRRORS | BULLA_BEHIND_RESTS };

static void test_good(void **state)
{
    (void)state;
    const struct bulla_boundary tables[] = {table_of(yielding, YIELDS), table_of(mirror, MIRRORS)};
    for (int i = 0; i < 2; i++) {
        struct bulla_module module = wall;
        module.table = &tables[i];
        assert_int_equal(vet_module(&module, 0), 0);
        struct contract contract = {.module = &module};
        assert_int_equal(contract_module_run(&contract, NULL), 0);
        assert_int_equal(contract_failed(&contract), 0);
    }
}

static void test_faults(void **state)
{
    static const struct {
        void (*fill)(const void *self, const struct bulla_behind *faces);
        uint32_t traits;
        const char *check;
    } faults[] = {
        {endless, YIELDS, "finite behind any state"},
        {leaking, YIELDS | BULLA_BEHIND_BRINGS, "fractions from 0 to 1"},
        {swapping, YIELDS, "without BRINGS"},
        {emptying, YIELDS, "densities above 0"},
        {emptying, YIELDS | BULLA_BEHIND_ISENTROPIC, "with ISENTROPIC"},
        {sliding, MIRRORS, "with RESTS"},
        {pushing, YIELDS, "without DRIVES: what nothing"},
        {sliding, BULLA_BEHIND_MIRRORS, "without DRIVES: what nothing"},
        {patching, YIELDS, "without DRIVES: p = NaN"},
        {straying, YIELDS, "a row gives what single points give"},
    };
    (void)state;
    for (size_t i = 0; i < sizeof faults / sizeof *faults; i++) {
        struct bulla_boundary table = table_of(faults[i].fill, faults[i].traits);
        finds_in(&wall, &table, faults[i].check);
    }
}

static void test_descriptors(void **state)
{
    (void)state;
    struct bulla_boundary unknown = table_of(yielding, 1u << 7), torn = table_of(mirror, MIRRORS | BULLA_BEHIND_DRIVES);
    struct bulla_boundary empty = table_of(NULL, 0);
    struct bulla_module module = wall;
    module.table = &unknown;
    assert_int_equal(vet_module(&module, 0), STATUS_CASE);
    assert_non_null(strstr(status_text(), "has the traits 0x80; this program knows 0x7f"));
    module.table = &torn;
    assert_int_equal(vet_module(&module, 0), STATUS_CASE);
    assert_non_null(strstr(status_text(), "leaves what rests alone (RESTS)"));
    module.table = &empty;
    assert_int_equal(vet_module(&module, 0), STATUS_CASE);
    assert_non_null(strstr(status_text(), "has no function 'fill', which kind boundary needs"));
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_good),
        cmocka_unit_test(test_faults),
        cmocka_unit_test(test_descriptors),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
