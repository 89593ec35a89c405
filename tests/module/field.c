/* field.c - the contract of kind "field" (core/suite/contract_field.c): one that keeps it, one fault for each check
 * that must find it, and descriptors that core could not work with. */
#include "mutants.h"

#include "bulla/field.h"
#include "plug/vet.h"

/* How fast a cell is stretched along x, as part of what is there beside. */
static void stretching(const void *self, const struct bulla_points *cells, double *const *values)
{
    (void)self;
    for (size_t i = 0; i < cells->n; i++) {
        double a = fabs(cells->du[0][0][i]);
        values[0][i] = a / (a + 1.0);
    }
}

static void endless(const void *self, const struct bulla_points *cells, double *const *values)
{
    stretching(self, cells, values);
    for (size_t i = 0; i < cells->n; i++) values[0][i] /= cells->p[i] < 1e9 ? 1.0 : 0.0;
}

static void dividing(const void *self, const struct bulla_points *cells, double *const *values)
{
    (void)self;
    for (size_t i = 0; i < cells->n; i++) values[0][i] = cells->du[0][0][i] / fabs(cells->du[0][0][i]);
}

static void constant(const void *self, const struct bulla_points *cells, double *const *values)
{
    (void)self;
    for (size_t i = 0; i < cells->n; i++) values[0][i] = 0.5;
}

static void signed_one(const void *self, const struct bulla_points *cells, double *const *values)
{
    (void)self;
    for (size_t i = 0; i < cells->n; i++) values[0][i] = cells->du[0][0][i];
}

static void straying(const void *self, const struct bulla_points *cells, double *const *values)
{
    stretching(self, cells, values);
    if (cells->n > 8) values[0][8] *= 1.0 + 0x1p-52;
}

static const struct bulla_module field = {.magic = BULLA_MAGIC,
                                          .abi = BULLA_ABI,
                                          .size = sizeof field,
                                          .kind = "field",
                                          .name = "field",
                                          .version = "1",
                                          .doc = "Of a test.",
                                          .cite = "none"};

enum { IS = BULLA_FIELD_VANISHING | BULLA_FIELD_FRACTION };

static void test_good(void **state)
{
    (void)state;
    const struct bulla_field_output outputs[] = {{"", "1", "A part.", IS}, {0}};
    const struct bulla_field table = {sizeof table, BULLA_FIELD_VELOCITY_SLOPES, outputs, stretching};
    struct bulla_module module = field;
    module.table = &table;
    assert_int_equal(vet_module(&module, 0), 0);
    struct contract contract = {.module = &module};
    assert_int_equal(contract_module_run(&contract, NULL), 0);
    assert_int_equal(contract_failed(&contract), 0);
}

static void test_faults(void **state)
{
    static const struct {
        void (*compute)(const void *self, const struct bulla_points *cells, double *const *values);
        const char *unit;
        uint32_t is;
        const char *check;
    } faults[] = {
        {endless, "1", 0, "finite in any state"},
        {dividing, "1", 0, "finite at rest"},
        {constant, "1", IS, "what says VANISHING"},
        {constant, "1", BULLA_FIELD_SIGNED, "what says VANISHING"},
        {signed_one, "1", BULLA_FIELD_FRACTION, "what says FRACTION"},
        {signed_one, "1", BULLA_FIELD_POSITIVE, "what says POSITIVE"},
        {stretching, "mm", IS, "outputs have SI units"},
        {stretching, "parsecs", IS, "outputs have SI units"},
        {straying, "1", IS, "a row gives what single points give"},
    };
    (void)state;
    for (size_t i = 0; i < sizeof faults / sizeof *faults; i++) {
        const struct bulla_field_output outputs[] = {{"", faults[i].unit, "A part.", faults[i].is}, {0}};
        const struct bulla_field table = {sizeof table, BULLA_FIELD_VELOCITY_SLOPES, outputs, faults[i].compute};
        finds_in(&field, &table, faults[i].check);
    }
}

static void refused(const struct bulla_field *table, const char *why)
{
    struct bulla_module module = field;
    module.table = table;
    assert_int_equal(vet_module(&module, 0), STATUS_CASE);
    if (!strstr(status_text(), why)) fail_msg("'%s' instead of '%s'", status_text(), why);
}

static void test_descriptors(void **state)
{
    (void)state;
    const struct bulla_field_output none[] = {{0}}, bad[] = {{"Q", "1", "A part.", 0}, {0}},
                                    twice[] = {{"q", "1", "One.", 0}, {"q", "1", "Other.", 0}, {0}};
    struct bulla_field_output many[BULLA_FIELD_OUTPUTS + 2] = {{0}};
    static const char *const suffixes[] = {"a", "b", "c", "d", "e", "f", "g", "h", "i"};
    for (int k = 0; k < BULLA_FIELD_OUTPUTS + 1; k++)
        many[k] = (struct bulla_field_output){suffixes[k], "1", "A part.", 0};
    refused(&(struct bulla_field){sizeof(struct bulla_field), 0, none, constant}, "has no outputs");
    refused(&(struct bulla_field){sizeof(struct bulla_field), 0, bad, constant}, "has an output 'Q' without");
    refused(&(struct bulla_field){sizeof(struct bulla_field), 0, twice, constant}, "has the output 'q' twice");
    refused(&(struct bulla_field){sizeof(struct bulla_field), 0, many, constant}, "has more than 8 outputs");
    refused(&(struct bulla_field){sizeof(struct bulla_field), 1u << 6, twice, constant}, "needs 0x40");
    refused(&(struct bulla_field){sizeof(struct bulla_field), 0, NULL, constant}, "has no function 'outputs'");
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
