/* describe.c - the texts of `bulla modules`. */
#include "plug/describe.h"

#include "base/status.h"
#include "plug/registry.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stdint.h>
#include <string.h>

#include <cmocka.h>

static void assert_says(const struct text *text, const char *part)
{
    if (!strstr(text->at, part)) fail_msg("no '%s' in:\n%s", part, text->at);
}

static void test_all(void **state)
{
    (void)state;
    struct text text = {0};
    describe_all(&text);
    assert_int_equal(strncmp(text.at, "conductivity\n  constant", 23), 0);
    assert_says(&text, "\neos\n  cochran-chan");
    assert_says(&text, "\ndamage\n");
    assert_says(&text, "\ninelastic\n");
    assert_says(&text, "\nlimiter\n  koren             1.0    Koren: the parabola");
    assert_says(&text, "\nreconstruction\n  muscl ");
    assert_says(&text, "\nriemann\n  hll ");
    assert_says(&text, "\nviscosity\n  ");
    size_t lines = 0;
    for (const char *at = text.at; *at; at++) lines += *at == '\n';
    assert_int_equal(lines, registry_count() + 9 + 8); /* heads of nine kinds, eight blank lines */
    text_done(&text);
}

static void test_one(void **state)
{
    (void)state;
    struct text text = {0};
    assert_int_equal(describe_one("stiffened-gas", &text), 0);
    assert_says(&text, "eos stiffened-gas 1.0\n");
    assert_says(&text, "lib/bulla/modules/eos-stiffened-gas.so\n  xxh64   ");
    assert_says(&text, "  parameter     unit    default   range ");
    assert_says(&text, "  gamma         1       required  1.0001 to 100 ");
    assert_says(&text, "  cv            J/kg/K  1000      0.001 to 1e+09 ");
    assert_says(&text, "\n  sg235           water, gamma 2.35, p-inf 1 GPa (Le Metayer et al. 2004): gamma 2.35, p-inf "
                       "1e+09, cv 1816");
    assert_says(&text, "materials: {NAME: {eos: {type: stiffened-gas, preset: sg44}}}\n");
    text_done(&text);
}

static void test_kind_and_name(void **state)
{
    (void)state;
    struct text text = {0};
    assert_int_equal(describe_one("riemann/hllc", &text), 0);
    assert_says(&text, "  no parameters\n");
    assert_says(&text, "scheme: {riemann: hllc}\n");
    text_done(&text);
    assert_int_equal(describe_one("weno5-z", &text), 0);
    assert_says(&text, "scheme: {reconstruction: weno5-z}\n");
    text_done(&text);
    assert_int_equal(describe_one("limiter/hllc", &text), STATUS_CASE);
}

static void test_unknown(void **state)
{
    (void)state;
    struct text text = {0};
    assert_int_equal(describe_one("stifened-gas", &text), STATUS_CASE);
    assert_string_equal(status_text(), "no module is called 'stifened-gas'; did you mean 'stiffened-gas'?");
    assert_int_equal(describe_one("weather", &text), STATUS_CASE);
    assert_string_equal(status_text(), "no module is called 'weather'; `bulla modules` lists them");
    assert_int_equal(text.length, 0);
}

static int start(void **state)
{
    (void)state;
    return registry_init();
}

static int stop(void **state)
{
    (void)state;
    registry_done();
    return 0;
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_all),
        cmocka_unit_test(test_one),
        cmocka_unit_test(test_kind_and_name),
        cmocka_unit_test(test_unknown),
    };
    return cmocka_run_group_tests(tests, start, stop);
}
