/* Quantities with units: values exact to the last bit, dimensions, and what is no unit. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>

#include <cmocka.h>

#include "case/unit.h"

#include <math.h>
#include <string.h>

static double value_of(const char *text, const char *dimension)
{
    struct unit unit, wanted;
    char bad[32];
    double value = NAN;
    assert_int_equal(unit_quantity(text, &value, &unit, bad), UNIT_FINE);
    assert_true(unit_parse(dimension, &wanted, bad));
    if (!unit_same(&unit, &wanted)) fail_msg("%s is not in %s", text, dimension);
    return value;
}

static void values_are_those_of_the_decimal_exponent(void **state)
{
    (void)state;
    assert_true(value_of("10 um", "m") == 10e-6);
    assert_true(value_of("30.1 um", "m") == 30.1e-6);
    assert_true(value_of("0.25 mm", "m") == 0.25e-3);
    assert_true(value_of("10um", "m") == 10e-6);
    assert_true(value_of("10 \xc2\xb5m", "m") == 10e-6);
    assert_true(value_of("10 \xce\xbcm", "m") == 10e-6);
    assert_true(value_of("30 MPa", "Pa") == 30e6);
    assert_true(value_of("83.3 kHz", "1/s") == 83.3e3);
    assert_true(value_of("1.1e5 J/kg/K", "J/kg/K") == 1.1e5);
    assert_true(value_of("-1.5e-3 kJ/kg", "m2/s2") == -1.5);
    assert_true(value_of("998.2 kg/m3", "kg/m3") == 998.2);
    assert_true(value_of("1.2 g/cm3", "kg/m3") == 1200.0);
    assert_true(value_of("4049 atm", "Pa") == 4049.0 * 101325.0);
    assert_true(value_of("2 bar", "Pa") == 2e5);
    assert_true(value_of("37 degC", "K") == 310.15);
    assert_true(value_of("50 %", "1") == 0.5);
    assert_true(value_of("2 min", "s") == 120.0);
    assert_true(value_of("3", "") == 3.0);
}

static void compound_units_in_several_forms(void **state)
{
    (void)state;
    static const char *const same[] = {"4 J/kg/K",     "4 J/(kg K)", "4 J*kg^-1*K^-1",
                                       "4 J kg-1 K-1", "4 m2/s2/K",  "4 J/(kg*K)"};
    for (size_t i = 0; i < sizeof same / sizeof *same; i++) assert_true(value_of(same[i], "J/kg/K") == 4.0);
    assert_true(value_of("1 mPa*s", "Pa s") == 1e-3);
    assert_true(value_of("1 1/us", "Hz") == 1e6);
    assert_true(value_of("72 mN/m", "N/m") == 72e-3);
}

static void what_is_no_quantity(void **state)
{
    (void)state;
    struct unit unit;
    char bad[32];
    double value;
    assert_int_equal(unit_quantity("water", &value, &unit, bad), UNIT_NO_NUMBER);
    assert_int_equal(unit_quantity("012", &value, &unit, bad), UNIT_NO_NUMBER);
    assert_int_equal(unit_quantity(".nan", &value, &unit, bad), UNIT_NO_NUMBER);
    assert_int_equal(unit_quantity("3 furlong", &value, &unit, bad), UNIT_UNKNOWN);
    assert_string_equal(bad, "furlong");
    assert_int_equal(unit_quantity("3 kg//m3", &value, &unit, bad), UNIT_MALFORMED);
    assert_int_equal(unit_quantity("3 m^", &value, &unit, bad), UNIT_MALFORMED);
    assert_int_equal(unit_quantity("3 (m", &value, &unit, bad), UNIT_MALFORMED);
    assert_int_equal(unit_quantity("3 m/", &value, &unit, bad), UNIT_MALFORMED);
    assert_int_equal(unit_quantity("3 m9m9m9m9m9m9m9m9m9m9m9m9m9", &value, &unit, bad), UNIT_MALFORMED);
    assert_int_equal(unit_quantity("1e400 km", &value, &unit, bad), UNIT_FINE);
    assert_true(isinf(value));
}

static void guesses_prefer_what_people_use(void **state)
{
    (void)state;
    struct unit pressure, length;
    char bad[32], guess[32];
    assert_true(unit_parse("Pa", &pressure, bad) && unit_parse("m", &length, bad));
    unit_guess("Mpa", &pressure, guess);
    assert_string_equal(guess, "MPa");
    unit_guess("pa", &pressure, guess);
    assert_string_equal(guess, "Pa");
    unit_guess("umm", &length, guess);
    assert_string_equal(guess, "um");
    unit_guess("furlong", &length, guess);
    assert_string_equal(guess, "");
}

static void dimensions_have_names(void **state)
{
    (void)state;
    struct unit unit;
    char bad[32], words[80];
    assert_true(unit_parse("MPa", &unit, bad));
    assert_string_equal(unit_kind(&unit, words, sizeof words), "a pressure");
    assert_non_null(strstr(unit_examples(&unit), "atm"));
    assert_true(unit_parse("kg m/s", &unit, bad));
    assert_string_equal(unit_kind(&unit, words, sizeof words), "a quantity in m kg s-1");
    assert_null(unit_examples(&unit));
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(values_are_those_of_the_decimal_exponent),
        cmocka_unit_test(compound_units_in_several_forms),
        cmocka_unit_test(what_is_no_quantity),
        cmocka_unit_test(guesses_prefer_what_people_use),
        cmocka_unit_test(dimensions_have_names),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
