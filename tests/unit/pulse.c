/* Pulses against formulas and against the tabulated lithotripter pulse. */
#include "case/pulse.h"
#include "case/script_host.h"
#include "case/series.h"

#include "base/status.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

static double at(const struct scene_boundary *boundary, double t)
{
    const double x[3] = {0.5, 2.0, 4.0};
    double pressure = -1.0;
    if (pulse_pressure(boundary, t, x, &pressure)) fail_msg("%s", status_text());
    return pressure;
}

static const struct scene_boundary lithotripter = {.pulse = SCENE_PULSE_LITHOTRIPTER,
                                                   .amplitude = 30e6,
                                                   .decay = 9.1e5,
                                                   .frequency = 83.3e3};

static void follows_the_table(void **state)
{
    (void)state;
    struct series series;
    assert_int_equal(series_read("tests/data/acoustics/lithotripter_30MPa.csv", &series), 0);
    const double *t, *p, *positive;
    assert_int_equal(series_column(&series, "1", &t) + series_column(&series, "2", &p) +
                         series_column(&series, "3", &positive),
                     0);
    struct scene_boundary front = lithotripter;
    front.compressive_only = true;
    assert_true(series.n_row > 100);
    for (size_t i = 0; i < series.n_row; i++) {
        if (fabs(at(&lithotripter, t[i]) + 101325.0 - p[i]) > 1e-9 * 30e6) fail_msg("t = %g", t[i]);
        if (fabs(at(&front, t[i]) + 101325.0 - positive[i]) > 1e-9 * 30e6) fail_msg("compressive, t = %g", t[i]);
    }
    series_done(&series);
}

static void lithotripter_begins_and_ends(void **state)
{
    (void)state;
    struct scene_boundary late = lithotripter;
    late.delay = 1e-6;
    assert_true(at(&late, 0.99e-6) == 0.0 && at(&late, 1.5e-6) == at(&lithotripter, 1.5e-6 - 1e-6));
    assert_true(at(&lithotripter, -1e-9) == 0.0 && fabs(at(&lithotripter, 0.0) - 30e6) < 1e-6);
    late.compressive_only = true;
    double zero = 1.0 / (12.0 * 83.3e3);
    assert_true(at(&late, 1e-6 + 0.999 * zero) > 0.0 && at(&late, 1e-6 + 1.001 * zero) == 0.0);
    assert_true(at(&late, 1e-6 + 10e-6) == 0.0); /* the pulse is above 0 again there */
    assert_true(at(&lithotripter, 10e-6) > 0.0);
}

static void other_forms(void **state)
{
    (void)state;
    struct scene_boundary sine = {.pulse = SCENE_PULSE_SINE, .amplitude = 2.0, .frequency = 10.0, .cycles = 1.5};
    assert_true(at(&sine, 0.025) == 2.0 * sin(2.0 * M_PI * 10.0 * 0.025) && at(&sine, 0.151) == 0.0 &&
                at(&sine, -0.01) == 0.0);
    assert_true(at(&sine, 0.12) > 0.0);
    sine.compressive_only = true;
    assert_true(at(&sine, 0.025) > 1.9 && at(&sine, 0.075) == 0.0 && at(&sine, 0.12) == 0.0);
    struct scene_boundary bell = {.pulse = SCENE_PULSE_GAUSSIAN, .amplitude = 3.0, .centre = 1.0, .width = 0.5};
    assert_true(at(&bell, 1.0) == 3.0 && at(&bell, 1.5) == 3.0 * exp(-1.0) && at(&bell, 0.0) > 0.0);
}

static void series_is_interpolated(void **state)
{
    (void)state;
    double t[] = {1.0, 2.0, 4.0, 5.0, 6.0}, p[] = {-1.0, 3.0, 7.0, -1.0, 9.0};
    struct scene_boundary series = {.pulse = SCENE_PULSE_SERIES, .series_t = t, .series_p = p, .n_series = 5};
    assert_true(at(&series, 0.99) == 0.0 && at(&series, 1.0) == -1.0 && at(&series, 1.5) == 1.0 &&
                at(&series, 2.0) == 3.0);
    assert_true(at(&series, 3.0) == 5.0 && at(&series, 6.0) == 9.0 && at(&series, 6.01) == 0.0);
    series.compressive_only = true;
    assert_true(at(&series, 1.0) == 0.0 && at(&series, 3.0) == 5.0 && at(&series, 4.8) > 0.0 &&
                at(&series, 5.9) == 0.0);
    series.n_series = 1;
    series.compressive_only = false;
    assert_true(at(&series, 1.0) == -1.0 && at(&series, 1.1) == 0.0);
    series.n_series = 0;
    assert_true(at(&series, 1.0) == 0.0);
}

static void scripts_see_time_and_place(void **state)
{
    (void)state;
    struct script_host *host = script_host_new();
    struct scene_boundary lua = {.pulse = SCENE_PULSE_SCRIPT, .delay = 1.0};
    assert_int_equal(script_compile_function(host, "function(t, x, y, z) return t - x * y * z end", "a.yaml", 3,
                                             &lua.script),
                     0);
    assert_true(at(&lua, 11.0) == 6.0 && at(&lua, 0.5) == 0.0);
    lua.compressive_only = true;
    assert_true(at(&lua, 2.0) == 0.0);
    assert_int_equal(script_compile_function(host, "function(t)\n return 1 / (t - 1) end", "a.yaml", 3, &lua.script),
                     0);
    const double x[3] = {0.0};
    double pressure;
    assert_int_equal(pulse_pressure(&lua, 2.0, x, &pressure), STATUS_CASE);
    assert_non_null(strstr(status_text(), "a.yaml:3: the script gives inf"));
    script_host_free(host);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(follows_the_table),
        cmocka_unit_test(lithotripter_begins_and_ends),
        cmocka_unit_test(other_forms),
        cmocka_unit_test(series_is_interpolated),
        cmocka_unit_test(scripts_see_time_and_place),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
