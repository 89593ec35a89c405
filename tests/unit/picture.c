/* Scales, ticks, text and the pixels of whole pictures. */
#include "base/status.h"
#include "view/picture.h"
#include "view/picture_canvas.h"
#include "view/picture_scale.h"
#include "view/picture_text.h"
#include "close.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

static void check_ticks(double lo, double hi, unsigned most, const char *wanted)
{
    struct picture_scale scale;
    char list[512] = "";
    picture_scale_init(&scale, &(struct picture_scale_inp){.name = "p", .unit = "Pa", .lo = lo, .hi = hi});
    picture_scale_ticks(&scale, most);
    for (unsigned i = 0; i < scale.n_tick; i++) {
        size_t used = strlen(list);
        snprintf(list + used, sizeof list - used, "%s%s", i ? " " : "", scale.text[i]);
        assert_true(scale.tick[i] >= scale.lo - 1e-9 * (hi - lo) && scale.tick[i] <= scale.hi + 1e-9 * (hi - lo));
    }
    assert_string_equal(list, wanted);
}

static void ticks_are_round(void **state)
{
    (void)state;
    check_ticks(0.0, 1.0, 6, "0.0 0.2 0.4 0.6 0.8 1.0");
    check_ticks(0.0, 1.0, 5, "0.0 0.5 1.0");
    check_ticks(-3.2e6, 7.1e6, 6, "−2 0 2 4 6");
    check_ticks(101325.0, 35e6, 8, "5 10 15 20 25 30 35");
    check_ticks(0.013, 0.087, 4, "20 40 60 80");
}

static void log_ticks_are_decades(void **state)
{
    (void)state;
    struct picture_scale scale;
    picture_scale_init(&scale,
                       &(struct picture_scale_inp){.name = "p", .unit = "Pa", .lo = 2e3, .hi = 5e8, .log = true});
    picture_scale_ticks(&scale, 8);
    assert_string_equal(scale.label, "p [Pa]");
    assert_int_equal(scale.n_tick, 5);
    assert_string_equal(scale.text[0], "10⁴");
    assert_string_equal(scale.text[4], "10⁸");
    assert_close(picture_scale_at(&scale, 1e6), log(1e6 / 2e3) / log(5e8 / 2e3), 1e-14);
    picture_scale_init(&scale,
                       &(struct picture_scale_inp){.name = "p", .unit = "Pa", .lo = 2e5, .hi = 4e6, .log = true});
    picture_scale_ticks(&scale, 8);
    assert_string_equal(scale.label, "p [MPa]");
    assert_string_equal(scale.text[0], "0.2");
    assert_string_equal(scale.text[1], "0.5");
    assert_string_equal(scale.text[2], "1");
}

static void units_take_sensible_prefixes(void **state)
{
    (void)state;
    static const struct {
        const char *unit, *text;
        double magnitude, factor;
    } rows[] = {
        {"Pa", "MPa", 35e6, 1e6},      {"m", "µm", 2.5e-4, 1e-6},      {"s", "µs", 1e-6, 1e-6},
        {"m/s", "m/s", 1500.0, 1.0},   {"kg/m3", "kg/m³", 998.2, 1.0}, {"1/s", "10⁶ 1/s", 4e7, 1e6},
        {"1", "", 0.5, 1.0},           {"K", "K", 5000.0, 1.0},        {"J/m3", "kJ/m³", 2e4, 1e3},
        {"m2", "10⁻⁹ m²", 3e-9, 1e-9}, {"Pa", "Pa", 0.0, 1.0},
    };
    for (size_t i = 0; i < sizeof rows / sizeof *rows; i++) {
        double factor;
        char text[PICTURE_SCALE_TEXT];
        picture_scale_unit(rows[i].unit, rows[i].magnitude, &factor, text);
        assert_string_equal(text, rows[i].text);
        assert_close(factor / rows[i].factor, 1.0, 1e-12);
    }
}

static void quantities_have_three_digits(void **state)
{
    (void)state;
    char text[PICTURE_SCALE_LABEL];
    picture_scale_quantity(3.123e-7, 1e-6, "s", text);
    assert_string_equal(text, "0.312 µs");
    picture_scale_quantity(3.123e-7, 3e-7, "s", text);
    assert_string_equal(text, "312 ns");
    picture_scale_quantity(0.0, 1e-6, "s", text);
    assert_string_equal(text, "0 µs");
    picture_scale_quantity(-0.0125, 0.02, "m", text);
    assert_string_equal(text, "−12.5 mm");
}

static void constant_fields_have_a_scale(void **state)
{
    (void)state;
    struct picture_scale scale;
    picture_scale_init(&scale, &(struct picture_scale_inp){.name = "p", .unit = "Pa", .lo = 101325.0, .hi = 101325.0});
    picture_scale_ticks(&scale, 5);
    assert_true(scale.lo < 101325.0 && scale.hi > 101325.0 && scale.n_tick >= 2);
    picture_scale_init(&scale, &(struct picture_scale_inp){.name = "u", .unit = "m/s"});
    picture_scale_ticks(&scale, 5);
    assert_true(scale.lo < 0.0 && scale.hi > 0.0 && scale.n_tick >= 2);
}

static void long_titles_are_broken_and_cut(void **state)
{
    (void)state;
    cairo_surface_t *image = cairo_image_surface_create(CAIRO_FORMAT_ARGB32, 1, 1);
    cairo_t *cr = cairo_create(image);
    char lines[PICTURE_TEXT_LINES][PICTURE_TEXT_LINE];
    struct picture_text font = {10.0, false};
    const char *title = "a bubble near a wall of something soft in water under a pulse of some kind, and so on";
    int count = picture_text_wrap(cr, font, title, 150.0, lines);
    assert_int_equal(count, PICTURE_TEXT_LINES);
    for (int i = 0; i < count; i++) assert_true(picture_text_width(cr, font, lines[i]) <= 150.0);
    assert_non_null(strstr(lines[count - 1], "…"));
    assert_int_equal(picture_text_wrap(cr, font, "short", 150.0, lines), 1);
    assert_string_equal(lines[0], "short");
    assert_int_equal(picture_text_wrap(cr, font, "", 150.0, lines), 0);
    cairo_destroy(cr);
    cairo_surface_destroy(image);
}

static uint32_t pixel_at(cairo_surface_t *image, int i, int j)
{
    uint32_t pixel;
    const unsigned char *bytes = cairo_image_surface_get_data(image);
    memcpy(&pixel, bytes + j * cairo_image_surface_get_stride(image) + 4 * i, 4);
    return pixel;
}

/* The highest rectangle of one colour: its bounds, and how many of its pixels have that colour. */
struct patch {
    int count, left, right, top, bottom;
};

static struct patch find_colour(cairo_surface_t *image, uint32_t rgb)
{
    int width = cairo_image_surface_get_width(image), height = cairo_image_surface_get_height(image), first = 0;
    while (first < width * height && pixel_at(image, first % width, first / width) != rgb) first++;
    assert_true(first < width * height);
    struct patch patch = {0, first % width, first % width, first / width, first / width};
    while (patch.right + 1 < width && pixel_at(image, patch.right + 1, patch.top) == rgb) patch.right++;
    while (patch.bottom + 1 < height && pixel_at(image, patch.left, patch.bottom + 1) == rgb) patch.bottom++;
    for (int j = patch.top; j <= patch.bottom; j++)
        for (int i = patch.left; i <= patch.right; i++) patch.count += pixel_at(image, i, j) == rgb;
    return patch;
}

/* Two cells, side by side, `aspect` high: [0, 1] x [0, aspect]. */
static struct picture two_cells(double aspect, struct raster_cell cells[2], const double values[2])
{
    struct picture picture = {.title = "Two cells of a very long name that may have to be broken",
                              .note = "t = 0",
                              .n_layer = 1,
                              .lines_label = ""};
    for (int i = 0; i < 2; i++) cells[i] = (struct raster_cell){{{0.5 * i, 0.5 * (i + 1)}, {0.0, aspect}}};
    picture_scale_init(&picture.axis[0], &(struct picture_scale_inp){.name = "x", .unit = "m", .hi = 1.0});
    picture_scale_init(&picture.axis[1], &(struct picture_scale_inp){.name = "y", .unit = "m", .hi = aspect});
    picture.layer[0] = (struct picture_layer){.n = 2, .cells = cells, .values = values};
    picture_scale_init(&picture.layer[0].scale, &(struct picture_scale_inp){.name = "p", .unit = "Pa", .hi = 4.0});
    assert_int_equal(colormap_find("ember", &picture.layer[0].map), 0);
    return picture;
}

static void cells_are_where_and_what_they_should_be(void **state)
{
    (void)state;
    static const double aspects[] = {0.1, 0.3, 1.0, 2.0, 5.0}, values[2] = {1.0, 3.0};
    for (size_t k = 0; k < sizeof aspects / sizeof *aspects; k++) {
        struct raster_cell cells[2];
        struct picture picture = two_cells(aspects[k], cells, values);
        cairo_surface_t *image;
        assert_int_equal(picture_draw(&picture, 800, &image), 0);
        assert_int_equal(cairo_image_surface_get_width(image), 800);
        struct patch left = find_colour(image, colormap_at(&picture.layer[0].map, 0.25));
        struct patch right = find_colour(image, colormap_at(&picture.layer[0].map, 0.75));
        int w = left.right - left.left + 1, h = left.bottom - left.top + 1;
        assert_in_range(right.left - left.right, 1, 2); /* at most one pixel holds the edge between them */
        assert_int_equal(left.top, right.top);
        assert_int_equal(left.bottom, right.bottom);
        assert_true(abs(right.right - right.left + 1 - w) <= 1);
        assert_close(h / (2.0 * w), aspects[k], 0.02 * aspects[k] + 1.0 / w); /* true to scale */
        assert_int_equal(left.count, w * h);
        const unsigned char *bytes = cairo_image_surface_get_data(image);
        assert_int_equal(bytes[0] & bytes[1] & bytes[2] & bytes[3], 255); /* white corner */
        cairo_surface_destroy(image);
    }
}

static void a_picture_becomes_a_file(void **state)
{
    (void)state;
    static const double values[2] = {1.0, 3.0};
    struct raster_cell cells[2];
    struct picture picture = two_cells(1.0, cells, values);
    cairo_surface_t *image, *back;
    assert_int_equal(picture_draw(&picture, 500, &image), 0);
    char path[64];
    snprintf(path, sizeof path, "/tmp/bulla-test-picture-%ld.png", (long)getpid());
    assert_int_equal(picture_canvas_write(image, path), 0);
    back = cairo_image_surface_create_from_png(path);
    assert_int_equal(cairo_surface_status(back), CAIRO_STATUS_SUCCESS);
    assert_int_equal(cairo_image_surface_get_width(back), 500);
    assert_int_equal(cairo_image_surface_get_height(back), cairo_image_surface_get_height(image));
    uint32_t rgb = colormap_at(&picture.layer[0].map, 0.25);
    assert_int_equal(find_colour(back, rgb).count, find_colour(image, rgb).count);
    remove(path);
    assert_int_equal(picture_canvas_write(image, "/no/such/folder/x.png"), STATUS_RUN);
    assert_non_null(strstr(status_text(), "/no/such/folder/x.png"));
    cairo_surface_destroy(back);
    cairo_surface_destroy(image);
}

static void too_large_is_refused(void **state)
{
    (void)state;
    static const double values[2] = {1.0, 3.0};
    struct raster_cell cells[2];
    struct picture picture = two_cells(1.0, cells, values);
    cairo_surface_t *image;
    assert_int_equal(picture_draw(&picture, 400000, &image), STATUS_RUN);
    assert_non_null(strstr(status_text(), "400000"));
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(ticks_are_round),
        cmocka_unit_test(log_ticks_are_decades),
        cmocka_unit_test(units_take_sensible_prefixes),
        cmocka_unit_test(quantities_have_three_digits),
        cmocka_unit_test(constant_fields_have_a_scale),
        cmocka_unit_test(long_titles_are_broken_and_cut),
        cmocka_unit_test(cells_are_where_and_what_they_should_be),
        cmocka_unit_test(a_picture_becomes_a_file),
        cmocka_unit_test(too_large_is_refused),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
