/* Pixels of known cells. */
#include "view/colormap.h"
#include "view/raster.h"
#include "close.h"

/* A coarse cell beside four fine ones: [0, 2] x [0, 1]. */
static const struct raster_cell cells[] = {
    {{{0.0, 1.0}, {0.0, 1.0}}}, {{{1.0, 1.5}, {0.0, 0.5}}}, {{{1.5, 2.0}, {0.0, 0.5}}},
    {{{1.0, 1.5}, {0.5, 1.0}}}, {{{1.5, 2.0}, {0.5, 1.0}}},
};
static const double shade[] = {0.0, 0.2, 0.4, 0.6, 1.0};

static void cells_fill_their_pixels(void **state)
{
    (void)state;
    struct raster_window window = {{{0.0, 2.0}, {0.0, 1.0}}, 8, 4};
    double mean[32];
    raster_mean(&window, 5, cells, shade, mean);
    for (int j = 0; j < 4; j++)
        for (int i = 0; i < 8; i++) {
            int fine = 1 + (i >= 6) + 2 * (j < 2); /* the top row of pixels is the upper edge */
            assert_close(mean[8 * j + i], i < 4 ? shade[0] : shade[fine], 1e-14);
        }
}

static void an_edge_inside_a_pixel_is_shared_by_area(void **state)
{
    (void)state;
    struct raster_window window = {{{0.0, 2.0}, {0.0, 0.5}}, 3, 1};
    double mean[3];
    raster_mean(&window, 5, cells, shade, mean);
    assert_close(mean[0], 0.0, 1e-14);
    assert_close(mean[1], 0.5 * 0.0 + 0.5 * 0.2, 1e-14);
    assert_close(mean[2], 0.25 * 0.2 + 0.75 * 0.4, 1e-14);
}

static void many_cells_in_a_pixel_give_their_mean(void **state)
{
    (void)state;
    struct raster_window window = {{{1.0, 2.0}, {0.0, 1.0}}, 1, 1};
    double mean;
    raster_mean(&window, 5, cells, shade, &mean);
    assert_close(mean, (0.2 + 0.4 + 0.6 + 1.0) / 4, 1e-14);
}

static void outside_and_not_finite_stay_empty(void **state)
{
    (void)state;
    struct raster_window window = {{{-1.0, 2.0}, {0.0, 1.0}}, 3, 1};
    double with_hole[] = {NAN, 0.5, 0.5, 0.5, 0.5}, mean[3];
    raster_mean(&window, 5, cells, with_hole, mean);
    assert_true(isnan(mean[0]));
    assert_true(isnan(mean[1]));
    assert_close(mean[2], 0.5, 1e-14);
}

static void image_has_the_colours_of_the_map(void **state)
{
    (void)state;
    struct colormap map;
    assert_int_equal(colormap_find("lagoon", &map), 0);
    struct raster_window window = {{{0.0, 2.0}, {0.0, 1.0}}, 8, 4};
    double beyond[] = {-3.0, 0.2, 0.4, 0.6, 7.0};
    cairo_surface_t *image = raster_image(&window, 5, cells, beyond, &map);
    const unsigned char *bytes = cairo_image_surface_get_data(image);
    int stride = cairo_image_surface_get_stride(image);
    const uint32_t *top = (const uint32_t *)(const void *)bytes;
    const uint32_t *bottom = (const uint32_t *)(const void *)(bytes + 3 * stride);
    assert_int_equal(top[0], map.rgb[0]); /* clamped */
    assert_int_equal(top[7], map.rgb[COLORMAP_STEPS - 1]);
    assert_int_equal(bottom[4], colormap_at(&map, 0.2));
    assert_int_equal(bottom[7], colormap_at(&map, 0.4));
    cairo_surface_destroy(image);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(cells_fill_their_pixels),
        cmocka_unit_test(an_edge_inside_a_pixel_is_shared_by_area),
        cmocka_unit_test(many_cells_in_a_pixel_give_their_mean),
        cmocka_unit_test(outside_and_not_finite_stay_empty),
        cmocka_unit_test(image_has_the_colours_of_the_map),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
