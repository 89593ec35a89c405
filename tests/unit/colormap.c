/* Colour maps: lightness rises evenly, names, ends. */
#include "base/status.h"
#include "view/colormap.h"
#include "close.h"

#include <string.h>

/* Lightness at every 1/16 of [from, to] of a map must rise by the same amount, to the rounding of 8 bits. */
static void check_even_rise(const char *name, double from, double to)
{
    struct colormap map;
    assert_int_equal(colormap_find(name, &map), 0);
    double first = colormap_lightness(colormap_at(&map, from)), last = colormap_lightness(colormap_at(&map, to));
    double step = (last - first) / 16.0;
    assert_true(step > 3.0);
    for (int i = 1; i <= 16; i++) {
        double here = colormap_lightness(colormap_at(&map, from + (to - from) * i / 16.0));
        double before = colormap_lightness(colormap_at(&map, from + (to - from) * (i - 1) / 16.0));
        assert_close(here - before, step, 0.2 * step);
    }
}

static void lightness_rises_evenly(void **state)
{
    (void)state;
    check_even_rise("lagoon", 0.0, 1.0);
    check_even_rise("ember", 0.0, 1.0);
    check_even_rise("frost", 0.0, 1.0);
    check_even_rise("grey", 0.0, 1.0);
}

static void balance_is_lightest_in_its_centre(void **state)
{
    (void)state;
    check_even_rise("balance", 0.0, 0.5);
    check_even_rise("balance", 1.0, 0.5);
}

static void neighbours_are_close(void **state)
{
    (void)state;
    static const char *const names[] = {"lagoon", "ember", "frost", "balance", "grey"};
    for (size_t m = 0; m < sizeof names / sizeof *names; m++) {
        struct colormap map;
        assert_int_equal(colormap_find(names[m], &map), 0);
        for (int k = 1; k < COLORMAP_STEPS; k++)
            for (int shift = 0; shift < 24; shift += 8) {
                int here = (int)(map.rgb[k] >> shift & 0xff), before = (int)(map.rgb[k - 1] >> shift & 0xff);
                assert_in_range(here - before + 8, 0, 16);
            }
    }
}

static void ends_and_nan(void **state)
{
    (void)state;
    struct colormap map;
    assert_int_equal(colormap_find("grey", &map), 0);
    assert_int_equal(colormap_at(&map, -1.0), 0xff000000);
    assert_int_equal(colormap_at(&map, 2.0), 0xffffffff);
    assert_int_equal(colormap_at(&map, NAN), 0);
    assert_close(colormap_lightness(colormap_at(&map, 0.5)), 50.0, 0.5);
}

static void unknown_name_is_refused_with_a_suggestion(void **state)
{
    (void)state;
    struct colormap map;
    assert_int_equal(colormap_find("lagon", &map), STATUS_CASE);
    assert_non_null(strstr(status_text(), "lagon"));
    assert_non_null(strstr(status_text(), "did you mean 'lagoon'"));
}

static void fields_have_their_maps(void **state)
{
    (void)state;
    assert_string_equal(colormap_for_field("schlieren", 0.0, 1.0), "grey");
    assert_string_equal(colormap_for_field("velocity_y", -3.0, 5.0), "balance");
    assert_string_equal(colormap_for_field("pressure", 1e5, 1e7), "lagoon");
    assert_string_equal(colormap_for_field("temperature_air", 300, 3000), "ember");
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(lightness_rises_evenly), cmocka_unit_test(balance_is_lightest_in_its_centre),
        cmocka_unit_test(neighbours_are_close),   cmocka_unit_test(ends_and_nan),
        cmocka_unit_test(fields_have_their_maps), cmocka_unit_test(unknown_name_is_refused_with_a_suggestion),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
