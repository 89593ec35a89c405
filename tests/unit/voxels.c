/* voxels.c - fields on equal cells, and rays that look for surfaces in them: leaves of two sizes, turned planes,
 * spheres that must be where they are, and how much of a picture one covers. */
#include "base/mem.h"
#include "close.h"
#include "view/picture_space.h"
#include "view/voxels.h"

#include <stdlib.h>
#include <string.h>

enum { COARSE = 16, LEAVES = COARSE * COARSE * COARSE * 8 };

static struct snapshot leaves;
static double *radius;
static const double cube[2][3] = {{-1, -1, -1}, {1, 1, 1}};

static void leaf(double x, double y, double z, double h)
{
    double lower[3] = {x, y, z}, square = 0.0;
    for (int k = 0; k < 3; k++) {
        leaves.lower[leaves.n_cell][k] = lower[k];
        leaves.upper[leaves.n_cell][k] = lower[k] + h;
        square += (lower[k] + 0.5 * h) * (lower[k] + 0.5 * h);
    }
    radius[leaves.n_cell++] = sqrt(square);
}

/* A cube of side 2 with the distance from its middle; cells of 1/8, of 1/16 where the sphere of 0.6 is. */
static int make(void **state)
{
    (void)state;
    double h = 2.0 / COARSE;
    leaves.dim = 3;
    memcpy(leaves.domain, cube, sizeof cube);
    leaves.lower = mem_new(LEAVES, sizeof *leaves.lower);
    leaves.upper = mem_new(LEAVES, sizeof *leaves.upper);
    radius = mem_new(LEAVES, sizeof *radius);
    for (int c = 0; c < COARSE * COARSE * COARSE; c++) {
        double x[3] = {c % COARSE * h - 1, c / COARSE % COARSE * h - 1, c / COARSE / COARSE * h - 1}, square = 0.0;
        for (int k = 0; k < 3; k++) square += (x[k] + 0.5 * h) * (x[k] + 0.5 * h);
        bool fine = fabs(sqrt(square) - 0.6) < 3 * h;
        for (int part = 0; part < (fine ? 8 : 1); part++)
            leaf(x[0] + (part & 1) * h / 2, x[1] + (part >> 1 & 1) * h / 2, x[2] + (part >> 2) * h / 2,
                 fine ? h / 2 : h);
    }
    return 0;
}

static int drop(void **state)
{
    (void)state;
    mem_free(leaves.lower);
    mem_free(leaves.upper);
    mem_free(radius);
    return 0;
}

static double sum_of(const struct voxels *voxels)
{
    double sum = 0.0;
    for (size_t i = 0; i < voxels->n[0] * voxels->n[1] * voxels->n[2]; i++) sum += voxels->values[i];
    return sum * voxels->h[0] * voxels->h[1] * voxels->h[2];
}

/* On cells as fine as the finest leaves, and on fewer: the integral stays. */
static void means(void **state)
{
    double wanted = 0.0;
    (void)state;
    for (size_t c = 0; c < leaves.n_cell; c++) wanted += radius[c] * pow(leaves.upper[c][0] - leaves.lower[c][0], 3);
    static const size_t rooms[] = {VOXELS_MOST, 32 * 32 * 32, 5000, 900};
    for (size_t i = 0; i < sizeof rooms / sizeof *rooms; i++) {
        struct voxels voxels;
        voxels_fill(&leaves, radius, cube, rooms[i], &voxels);
        if (i < 2) assert_int_equal(voxels.n[0], 32);
        assert_true((double)(voxels.n[0] * voxels.n[1] * voxels.n[2]) <= 1.2 * (double)rooms[i]);
        assert_close(sum_of(&voxels), wanted, 1e-5);
        voxels_done(&voxels);
    }
}

/* From all sides a ray meets the sphere at its place, with its normal; one that passes beside it meets nothing. */
static void expect_sphere(const struct voxels *voxels, const double domain[2][3], double size)
{
    for (int i = 0; i < 200; i++) {
        double az = 0.1 + 0.31 * i, el = asin(-0.98 + 1.96 * i / 199.0), t, normal[3], span[2];
        double out[3] = {cos(el) * cos(az), cos(el) * sin(az), sin(el)}, along[3], from[3], beside[3];
        double side[3] = {-sin(az), cos(az), 0.0};
        for (int k = 0; k < 3; k++) {
            along[k] = -out[k];
            from[k] = 5.0 * out[k];
            beside[k] = from[k] + 1.1 * size * side[k];
        }
        assert_true(voxels_clip(domain, from, along, &span[0], &span[1]));
        assert_true(voxels_hit(voxels, size, from, along, span, &t, normal));
        assert_close(t, 5.0 - size, 3e-3);
        for (int k = 0; k < 3; k++) assert_close(normal[k], out[k], 0.03);
        assert_true(voxels_clip(domain, beside, along, &span[0], &span[1]));
        assert_false(voxels_hit(voxels, size, beside, along, span, &t, normal));
    }
}

static void spheres(void **state)
{
    struct voxels voxels;
    double begin, end, extremes[2] = {INFINITY, -INFINITY};
    (void)state;
    voxels_fill(&leaves, radius, cube, VOXELS_MOST, &voxels);
    expect_sphere(&voxels, cube, 0.6);
    voxels_range(&voxels, 0.6, &voxels, extremes); /* cells beside the surface only */
    assert_true(extremes[0] > 0.5 && extremes[0] < 0.6 && extremes[1] > 0.6 && extremes[1] < 0.7);
    assert_false(voxels_clip(cube, (const double[3]){0, 2, 0}, (const double[3]){1, 0, 0}, &begin, &end));
    voxels_done(&voxels);
}

/* A part of the box shows the same. */
static void windows(void **state)
{
    static const double part[2][3] = {{-0.75, -0.875, -1}, {0.75, 0.75, 0.875}};
    struct voxels voxels;
    (void)state;
    voxels_fill(&leaves, radius, part, VOXELS_MOST, &voxels);
    assert_int_equal(voxels.n[0], 24);
    assert_close(voxels_at(&voxels, (const double[3]){0.5, -0.25, 0.25}), sqrt(0.375), 0.01);
    expect_sphere(&voxels, part, 0.6);
    voxels_done(&voxels);
}

/* An axisymmetric plane with the distance from a point of the axis. */
static void turned(void **state)
{
    enum { N = 48 };
    struct snapshot plane = {.dim = 2, .beta = 1, .domain = {{0, -1, 0}, {1, 1, 0}}};
    double *values = mem_new(N * 2 * N, sizeof *values), box[2][3];
    (void)state;
    plane.lower = mem_new(N * 2 * N, sizeof *plane.lower);
    plane.upper = mem_new(N * 2 * N, sizeof *plane.upper);
    for (int c = 0; c < N * 2 * N; c++) {
        double r = c % N / (double)N, z = c / N / (double)N - 1, h = 1.0 / N;
        memcpy(plane.lower[c], (double[3]){r, z, 0}, sizeof box[0]);
        memcpy(plane.upper[c], (double[3]){r + h, z + h, 0}, sizeof box[0]);
        values[plane.n_cell++] = hypot(r + 0.5 * h, z + 0.5 * h);
    }
    struct voxels voxels;
    voxels_domain(&plane, box);
    assert_memory_equal(box, cube, sizeof box);
    voxels_fill(&plane, values, cube, VOXELS_MOST, &voxels);
    assert_true(isnan(voxels_at(&voxels, (const double[3]){0.95, 0.95, 0}))); /* outside of the cylinder */
    expect_sphere(&voxels, cube, 0.6);
    voxels_done(&voxels);
    mem_free(plane.lower);
    mem_free(plane.upper);
    mem_free(values);
}

/* Pixels of a picture of the sphere that are more blue than red. */
static double blue(const struct picture_space *space)
{
    cairo_surface_t *image;
    double count = 0.0;
    assert_int_equal(picture_space_draw(space, 428, &image), 0);
    int width = cairo_image_surface_get_width(image), stride = cairo_image_surface_get_stride(image);
    for (int j = 0; j < cairo_image_surface_get_height(image); j++)
        for (int i = 0; i < width; i++) {
            uint32_t pixel;
            memcpy(&pixel, cairo_image_surface_get_data(image) + j * stride + 4 * i, sizeof pixel);
            count += (pixel & 0xff) > (pixel >> 16 & 0xff) + 8;
        }
    cairo_surface_destroy(image);
    return count;
}

/* Its disc covers what it must, from wherever it is seen: the box is 330 points high, a pixel each, seen along an
 * axis. */
static void discs(void **state)
{
    struct voxels voxels;
    (void)state;
    voxels_fill(&leaves, radius, cube, VOXELS_MOST, &voxels);
    struct picture_space space = {.title = "A sphere", .note = "t = 0", .n_surface = 1};
    space.surface[0] = (struct picture_space_surface){&voxels, 0.6, 0xff3060ffu};
    for (int k = 0; k < 3; k++)
        picture_scale_init(&space.axis[k], &(struct picture_scale_inp){.name = "x", .unit = "m", .lo = -1, .hi = 1});
    static const double views[][2] = {{0, 0}, {90, 0}, {0, 90}, {180, 0}, {-90, -90}};
    for (size_t i = 0; i < sizeof views / sizeof *views; i++) {
        space.azimuth = views[i][0];
        space.elevation = views[i][1];
        assert_close(blue(&space) / (M_PI * 0.36 * 165.0 * 165.0), 1.0, 0.02);
    }
    voxels_done(&voxels);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(means),  cmocka_unit_test(spheres), cmocka_unit_test(windows),
        cmocka_unit_test(turned), cmocka_unit_test(discs),
    };
    return cmocka_run_group_tests(tests, make, drop);
}
