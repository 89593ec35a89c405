/* plot_film.c - frames of a film are all as large as the largest one, in place, on white. */
#include "base/mem.h"
#include "close.h"
#include "view/plot_film.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

static char folder[] = "/tmp/bulla-film-XXXXXX";

static cairo_surface_t *image(int width, int height)
{
    cairo_surface_t *surface = cairo_image_surface_create(CAIRO_FORMAT_RGB24, width, height);
    cairo_t *cr = cairo_create(surface);
    cairo_set_source_rgb(cr, 1.0, 0.0, 0.0);
    cairo_paint(cr);
    cairo_destroy(cr);
    return surface;
}

static void add(struct plot_film *film, int width, int height)
{
    cairo_surface_t *frame = image(width, height);
    assert_int_equal(plot_film_add(film, frame), 0);
    cairo_surface_destroy(frame);
}

static uint32_t pixel(cairo_surface_t *frame, int x, int y)
{
    const unsigned char *row = cairo_image_surface_get_data(frame) + y * cairo_image_surface_get_stride(frame);
    uint32_t value;
    memcpy(&value, row + 4 * x, sizeof value);
    return value & 0xffffff;
}

static void expect_frame(const char *frames, unsigned index, int width, int height)
{
    char *path = mem_print("%s/frame_%06u.png", frames, index);
    cairo_surface_t *frame = cairo_image_surface_create_from_png(path);
    assert_int_equal(cairo_image_surface_get_width(frame), 60);
    assert_int_equal(cairo_image_surface_get_height(frame), 40);
    for (int y = 0; y < 40; y++)
        for (int x = 0; x < 60; x++)
            assert_int_equal(pixel(frame, x, y), x < width && y < height ? 0xff0000 : 0xffffff);
    cairo_surface_destroy(frame);
    assert_int_equal(unlink(path), 0);
    mem_free(path);
}

static void sizes(void **state)
{
    struct plot_film film;
    (void)state;
    assert_int_equal(plot_film_begin("film.mp4", 3, &film), 0);
    add(&film, 40, 40);
    add(&film, 60, 20);
    add(&film, 60, 40);
    char *frames = mem_text(film.folder);
    assert_int_equal(plot_film_end(&film, 12, 0), 0);
    expect_frame(frames, 0, 40, 40);
    expect_frame(frames, 1, 60, 20);
    expect_frame(frames, 2, 60, 40);
    assert_int_equal(rmdir(frames), 0);
    mem_free(frames);
}

/* A frame that fails leaves nothing. */
static void failures(void **state)
{
    struct plot_film film;
    (void)state;
    assert_int_equal(plot_film_begin("film.gif", 3, &film), 0);
    add(&film, 20, 20);
    assert_int_equal(plot_film_end(&film, 12, 3), 3);
    assert_int_not_equal(plot_film_begin("film.png", 3, &film), 0);
    assert_int_not_equal(plot_film_begin("nowhere/film.gif", 3, &film), 0);
}

static int begin(void **state)
{
    (void)state;
    return mkdtemp(folder) && !chdir(folder) && !setenv("PATH", folder, 1) ? 0 : -1; /* no ffmpeg there */
}

static int end(void **state)
{
    (void)state;
    return rmdir(folder); /* nothing is left */
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(sizes), cmocka_unit_test(failures)};
    return cmocka_run_group_tests(tests, begin, end);
}
