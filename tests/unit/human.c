/* human.c - numbers as people read them. */
#include "cli/human.h"

#include "base/status.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>
#include <math.h>

static void prefixes(void **state)
{
    (void)state;
    char text[HUMAN_ROOM];
    assert_string_equal(human_si(4.321e-7, "s", text), "432.1 ns");
    assert_string_equal(human_si(0, "s", text), "0 s");
    assert_string_equal(human_si(1e-6, "s", text), "1 us");
    assert_string_equal(human_si(-3.5e7, "Pa", text), "-35 MPa");
    assert_string_equal(human_si(12, "m", text), "12 m");
    assert_string_equal(human_si(1000, "m", text), "1 km");
}

static void counts(void **state)
{
    (void)state;
    char text[HUMAN_ROOM];
    assert_string_equal(human_count(16384, text), "16384");
    assert_string_equal(human_count(2.66e6, text), "2.66 M");
}

static void durations(void **state)
{
    (void)state;
    char text[HUMAN_ROOM];
    assert_string_equal(human_duration(42, text), "0:42");
    assert_string_equal(human_duration(3723, text), "1:02:03");
    assert_string_equal(human_duration(90061, text), "1 d 01:01:01");
    assert_string_equal(human_duration(INFINITY, text), "-");
    double seconds = 0;
    assert_int_equal(human_read_duration("01:02:03", &seconds), 0);
    assert_true(seconds == 3723);
    assert_int_equal(human_read_duration("90", &seconds), 0);
    assert_true(seconds == 90);
    assert_int_equal(human_read_duration("1:60", &seconds), STATUS_CASE);
    assert_int_equal(human_read_duration("1:2:3:4", &seconds), STATUS_CASE);
    assert_int_equal(human_read_duration("", &seconds), STATUS_CASE);
    assert_true(seconds == 90);
}

static void bytes(void **state)
{
    (void)state;
    char text[HUMAN_ROOM];
    assert_string_equal(human_bytes(512, text), "512 B");
    assert_string_equal(human_bytes(12.5 * 1024 * 1024, text), "12.5 MiB");
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(prefixes),
        cmocka_unit_test(counts),
        cmocka_unit_test(durations),
        cmocka_unit_test(bytes),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
