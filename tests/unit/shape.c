/* Regions: volumes against closed forms, cells against brute force, levels against distances, symmetry to the bit. */
#include "case/shape.h"

#include "base/mem.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

struct grid {
    double lower[3], upper[3];
    int cells, dim, beta;
};

static double weight(double a, double b, int beta)
{
    return (pow(b, beta + 1) - pow(a, beta + 1)) / (beta + 1);
}

/* Node i of an axis, symmetric to the bit when the domain is. */
static double node(const struct grid *grid, int d, int i)
{
    return (grid->lower[d] * (grid->cells - i) + grid->upper[d] * i) / grid->cells;
}

static double cell_of(const struct shape *shape, const struct grid *grid, int i, int j, int k, double *ret_volume)
{
    int at[3] = {i, j, k};
    double lower[3] = {0.0}, upper[3] = {1.0, 1.0, 1.0};
    *ret_volume = 1.0;
    for (int d = 0; d < grid->dim; d++) {
        lower[d] = node(grid, d, at[d]);
        upper[d] = node(grid, d, at[d] + 1);
        *ret_volume *= d ? upper[d] - lower[d] : weight(lower[0], upper[0], grid->beta);
    }
    return shape_fraction(shape, lower, upper, grid->dim, grid->beta);
}

static double total(const struct shape *shape, const struct grid *grid)
{
    double sum = 0.0, lost = 0.0, volume; /* compensated: a million equal cells add up to round-off of their own */
    for (int k = 0; k < (grid->dim > 2 ? grid->cells : 1); k++)
        for (int j = 0; j < (grid->dim > 1 ? grid->cells : 1); j++)
            for (int i = 0; i < grid->cells; i++) {
                double fraction = cell_of(shape, grid, i, j, k, &volume);
                assert_true(fraction >= 0.0 && fraction <= 1.0);
                double part = fraction * volume - lost, next = sum + part;
                lost = (next - sum) - part;
                sum = next;
            }
    return sum;
}

static void assert_near(double value, double exact, double relative)
{
    if (!(fabs(value - exact) <= relative * fabs(exact)))
        fail_msg("%.17g, wanted %.17g: relative error %.3g", value, exact, value / exact - 1.0);
}

/* Radius of 8 cells; the centre on a node, in a cell, anywhere. */
static void fills_spheres(void **state)
{
    (void)state;
    static const double shift[4][3] = {{0.0, 0.0, 0.0}, {0.5, 0.5, 0.5}, {0.123, -0.4, 0.031}, {0.5, 0.0, 0.27}};
    for (int s = 0; s < 4; s++) {
        struct shape ball = {.type = SHAPE_SPHERE, .radius = 8.0};
        struct grid grid = {{-10, -10, -10}, {10, 10, 10}, 20, 3, 0};
        memcpy(ball.a, shift[s], sizeof ball.a);
        assert_near(total(&ball, &grid), 4.0 / 3.0 * M_PI * 512.0, 1e-8);
        ball.a[2] = 0.0;
        grid.dim = 2;
        assert_near(total(&ball, &grid), M_PI * 64.0, 1e-13);
        struct grid turned = {{0, -10, 0}, {20, 10, 0}, 20, 2, 1};
        ball.a[0] = 0.0;
        assert_near(total(&ball, &turned), 2.0 / 3.0 * 512.0, 1e-13);
        ball.a[0] = 10.0 + shift[s][0];
        assert_near(total(&ball, &turned), M_PI * 64.0 * ball.a[0], 1e-13);
        grid.dim = 1;
        ball.a[0] = shift[s][0], ball.a[1] = 0.0;
        assert_near(total(&ball, &grid), 16.0, 1e-14);
    }
    struct shape ball = {.type = SHAPE_SPHERE, .radius = 8.3};
    struct grid radial = {{0}, {20}, 20, 1, 2};
    assert_near(total(&ball, &radial), 8.3 * 8.3 * 8.3 / 3.0, 1e-14);
    struct grid cylindrical = {{0}, {20}, 20, 1, 1};
    assert_near(total(&ball, &cylindrical), 8.3 * 8.3 / 2.0, 1e-14);
}

/* Small in a cell, large in the grid, and a slice beside the centre. */
static void fills_odd_spheres(void **state)
{
    (void)state;
    struct shape ball = {.type = SHAPE_SPHERE, .radius = 0.3, .a = {0.1, 0.05, -0.2}};
    struct grid grid = {{-2, -2, -2}, {2, 2, 2}, 4, 3, 0};
    assert_near(total(&ball, &grid), 4.0 / 3.0 * M_PI * 0.027, 1e-6);
    struct grid plane = {{-10, -10, 0}, {10, 10, 0}, 1000, 2, 0};
    ball = (struct shape){.type = SHAPE_SPHERE, .radius = 8.0, .a = {0.0, 0.0, 3.0}};
    assert_near(total(&ball, &plane), M_PI * (64.0 - 9.0), 1e-12);
}

static void fills_planes_and_boxes(void **state)
{
    (void)state;
    static const double normals[][3] = {{1, 0, 0}, {0, -1, 0}, {0.6, 0.8, 0}, {1e-9, 0.6, -0.8}, {0.48, -0.6, 0.64}};
    struct grid grid = {{-1, -1, -1}, {1, 1, 1}, 13, 3, 0};
    for (int dim = 1; dim <= 3; dim++)
        for (size_t i = 0; i < sizeof normals / sizeof *normals; i++) {
            struct shape half = {.type = SHAPE_HALF_SPACE}; /* through the middle: half of the domain */
            memcpy(half.b, normals[i], sizeof half.b);
            if (dim == 1 && normals[i][0] == 0.0) continue;
            grid.dim = dim;
            assert_near(total(&half, &grid), dim == 1 ? 1.0 : dim == 2 ? 2.0 : 4.0, 1e-14);
        }
    struct shape box = {.type = SHAPE_BOX, .a = {-0.7, -0.2, 0.1}, .b = {0.33, 0.9, 0.15}};
    assert_near(total(&box, &grid), 1.03 * 1.1 * 0.05, 1e-13);
    box.a[2] = box.b[2] = 0.0; /* not bounded */
    assert_near(total(&box, &grid), 1.03 * 1.1 * 2.0, 1e-13);
    struct grid turned = {{0, -1, 0}, {2, 1, 0}, 13, 2, 1};
    box = (struct shape){.type = SHAPE_BOX, .a = {0.31, -0.2}, .b = {1.33, 0.9}};
    assert_near(total(&box, &turned), 0.5 * (1.33 * 1.33 - 0.31 * 0.31) * 1.1, 1e-13);
    struct shape cone = {.type = SHAPE_HALF_SPACE, .a = {0.0, 0.5}, .b = {-0.6, -0.8}}; /* z < 0.5 - 0.75 r */
    assert_near(total(&cone, &turned), 1.0, 1e-13); /* a cone that meets the bottom at r = 2: 4 * 1.5 / 6 */
    cone.b[1] = 0.8;
    cone.a[1] = -0.5;
    assert_near(total(&cone, &turned), 1.0, 1e-13);
}

static void fills_other_bodies(void **state)
{
    (void)state;
    struct grid cube = {{-1, -1, -1}, {1, 1, 1}, 20, 3, 0}, plane = {{-1, -1, 0}, {1, 1, 0}, 20, 2, 0};
    struct grid turned = {{0, -1, 0}, {2, 1, 0}, 20, 2, 1};
    struct shape ellipsoid = {.type = SHAPE_ELLIPSOID, .a = {0.1, 0, 0}, .b = {0.8, 0.5, 0.3}};
    assert_near(total(&ellipsoid, &cube), 4.0 / 3.0 * M_PI * 0.12, 1e-7);
    assert_near(total(&ellipsoid, &plane), M_PI * 0.4, 1e-13);
    ellipsoid.a[0] = 0.0;
    assert_near(total(&ellipsoid, &turned), 2.0 / 3.0 * 0.64 * 0.5, 1e-13);
    struct shape shell = {.type = SHAPE_RING, .radius = 0.8, .inner = 0.75};
    assert_near(total(&shell, &cube), 4.0 / 3.0 * M_PI * (0.512 - 0.421875), 1e-7);
    assert_near(total(&shell, &plane), M_PI * (0.64 - 0.5625), 1e-12);
    struct shape rod = {.type = SHAPE_CYLINDER, .a = {0.1, -0.5, 0.2}, .b = {0.1, 0.61, 0.2}, .radius = 0.55};
    assert_near(total(&rod, &cube), M_PI * 0.3025 * 1.11, 1e-12);
    rod = (struct shape){.type = SHAPE_CYLINDER, .a = {-0.3, -0.4, -0.3}, .b = {0.3, 0.4, 0.3}, .radius = 0.3};
    assert_near(total(&rod, &cube), M_PI * 0.09 * sqrt(4 * 0.34), 2e-3);
    rod = (struct shape){.type = SHAPE_CYLINDER, .a = {-0.3, -0.4}, .b = {0.3, 0.4}, .radius = 0.2};
    assert_near(total(&rod, &plane), 0.4, 1e-13);
    rod = (struct shape){.type = SHAPE_CYLINDER, .a = {0.0, -0.4}, .b = {0.0, 0.43}, .radius = 0.7};
    assert_near(total(&rod, &turned), 0.245 * 0.83, 1e-13);
    double corners[][2] = {{-0.5, -0.5}, {0.7, -0.3}, {0.1, 0.0}, {0.6, 0.8}, {-0.4, 0.5}}; /* not convex */
    struct shape polygon = {.type = SHAPE_POLYGON, .n = 5, .vertex = corners};
    double area = 0.0;
    for (int i = 0; i < 5; i++)
        area += 0.5 * (corners[i][0] * corners[(i + 1) % 5][1] - corners[(i + 1) % 5][0] * corners[i][1]);
    assert_near(total(&polygon, &plane), area, 1e-13);
    assert_near(total(&polygon, &cube), 2.0 * area, 1e-13);
    double triangle[][2] = {{0.2, -0.5}, {0.2, 0.7}, {1.4, -0.5}}; /* turned about the axis: Pappus */
    polygon = (struct shape){.type = SHAPE_POLYGON, .n = 3, .vertex = triangle};
    assert_near(total(&polygon, &turned), 0.72 * 0.6, 1e-13);
}

static void combines(void **state)
{
    (void)state;
    struct grid cube = {{-1, -1, -1}, {1, 1, 1}, 20, 3, 0}, plane = {{-1, -1, 0}, {1, 1, 0}, 20, 2, 0};
    struct grid turned = {{0, -1, 0}, {2, 1, 0}, 20, 2, 1}, line = {{0}, {2}, 20, 1, 2};
    struct shape left = {.type = SHAPE_SPHERE, .a = {-0.4}, .radius = 0.3};
    struct shape right = {.type = SHAPE_SPHERE, .a = {0.4}, .radius = 0.37}, *both[2] = {&left, &right};
    struct shape any = {.type = SHAPE_UNION, .n = 2, .parts = both};
    assert_near(total(&any, &plane), M_PI * (0.09 + 0.1369), 1e-12);
    left = (struct shape){.type = SHAPE_SPHERE, .radius = 0.73};
    right = (struct shape){.type = SHAPE_HALF_SPACE, .a = {0.13, 0.2}, .b = {0.6, 0.8}};
    struct shape cap = {.type = SHAPE_INTERSECTION, .n = 2, .parts = both};
    double h = 0.73 - 0.238, cube_cap = M_PI * h * h * (0.73 - h / 3.0);
    assert_near(total(&cap, &cube), cube_cap, 1e-4);
    assert_near(total(&cap, &plane), 0.73 * 0.73 * acos(0.238 / 0.73) - 0.238 * sqrt(0.5329 - 0.238 * 0.238), 1e-4);
    struct shape *whole[1] = {&cap}, rest = {.type = SHAPE_COMPLEMENT, .n = 1, .parts = whole};
    assert_near(total(&rest, &cube), 8.0 - cube_cap, 1e-4);
    right = (struct shape){.type = SHAPE_HALF_SPACE, .b = {0.0, 1.0}};
    assert_near(total(&cap, &turned), 0.73 * 0.73 * 0.73 / 3.0, 1e-4);
    right = (struct shape){.type = SHAPE_SPHERE, .radius = 0.72};
    struct shape *hollow[2] = {&rest, &left};
    whole[0] = &right;
    struct shape shell = {.type = SHAPE_INTERSECTION, .n = 2, .parts = hollow};
    assert_near(total(&shell, &line), (0.73 * 0.73 * 0.73 - 0.72 * 0.72 * 0.72) / 3.0, 1e-8);
    struct shape all = {.type = SHAPE_EVERYWHERE}, *everything[1] = {&all};
    struct shape none = {.type = SHAPE_COMPLEMENT, .n = 1, .parts = everything};
    assert_true(total(&all, &plane) > 3.99 && total(&none, &plane) == 0.0 && fabs(total(NULL, &plane) - 4.0) < 1e-12);
    assert_true(shape_contains(NULL, (double[3]){0}) && shape_contains(&all, (double[3]){0}) &&
                !shape_contains(&none, (double[3]){0}));
}

static unsigned random_state = 12345;

static double random_unit(void)
{
    random_state = random_state * 1664525u + 1013904223u;
    return (random_state >> 8) / 16777216.0;
}

/* Share of a fine lattice of points inside. */
static double brute(const struct shape *shape, const double lower[3], const double upper[3], int dim, int beta, int n)
{
    double inside = 0.0, all = 0.0;
    for (int k = 0; k < (dim > 2 ? n : 1); k++)
        for (int j = 0; j < (dim > 1 ? n : 1); j++)
            for (int i = 0; i < n; i++) {
                int at[3] = {i, j, k};
                double x[3] = {0.0};
                for (int d = 0; d < dim; d++) x[d] = lower[d] + (upper[d] - lower[d]) * (at[d] + 0.5) / n;
                double w = pow(x[0], beta);
                all += w;
                if (shape_contains(shape, x)) inside += w;
            }
    return inside / all;
}

static void agrees_with_points(void **state)
{
    (void)state;
    double corners[][2] = {{-0.1, 0.2}, {0.8, -0.3}, {0.9, 0.9}, {0.4, 0.1}};
    const struct shape shapes[] = {
        {.type = SHAPE_SPHERE, .a = {0.2, 0.1, 0.3}, .radius = 0.6},
        {.type = SHAPE_SPHERE, .a = {0.2, 0.1, 0.3}, .radius = 5.0},
        {.type = SHAPE_ELLIPSOID, .a = {0.2, 0.1, 0.3}, .b = {0.9, 0.4, 0.5}},
        {.type = SHAPE_HALF_SPACE, .a = {0.2, 0.4, 0.3}, .b = {0.48, 0.64, -0.6}},
        {.type = SHAPE_CYLINDER, .a = {0.2, 0.1, 0.3}, .b = {0.9, 0.5, 0.6}, .radius = 0.3},
        {.type = SHAPE_CYLINDER, .a = {0.2, 0.1, 0.3}, .b = {0.2, 0.1, 0.9}, .radius = 0.5},
        {.type = SHAPE_RING, .a = {0.2, 0.1, 0.3}, .radius = 0.9, .inner = 0.5},
        {.type = SHAPE_POLYGON, .n = 4, .vertex = corners},
    };
    for (size_t s = 0; s < sizeof shapes / sizeof *shapes; s++)
        for (int trial = 0; trial < 60; trial++) {
            int dim = 1 + trial % 3, beta = dim == 3 ? 0 : trial / 3 % (dim == 1 ? 3 : 2),
                n = dim == 1   ? 20000
                    : dim == 2 ? 300
                               : 50;
            if (dim == 1 && shapes[s].type == SHAPE_POLYGON) continue;
            double lower[3], upper[3];
            for (int d = 0; d < 3; d++) {
                lower[d] = d < dim ? 1.2 * random_unit() - (beta && d == 0 ? 0.0 : 0.6) : 0.0;
                upper[d] = lower[d] + 0.05 + 0.7 * random_unit();
            }
            double fraction = shape_fraction(shapes + s, lower, upper, dim, beta);
            double points = brute(shapes + s, lower, upper, dim, beta, n);
            if (fabs(fraction - points) > (dim == 1 ? 1e-4 : dim == 2 ? 4e-3 : 1e-2))
                fail_msg("shape %zu, dim %d, beta %d: %g, points say %g", s, dim, beta, fraction, points);
        }
}

/* |level| never exceeds the distance: a step of that length in any direction stays on the same side. */
static void levels_are_safe(void **state)
{
    (void)state;
    double corners[][2] = {{-0.1, 0.2}, {0.8, -0.3}, {0.9, 0.9}, {0.4, 0.1}};
    struct shape a = {.type = SHAPE_ELLIPSOID, .a = {0.2, 0.1, 0.3}, .b = {0.9, 0.1, 0.5}};
    struct shape b = {.type = SHAPE_CYLINDER, .a = {0.2, 0.1, 0.3}, .b = {0.9, 0.5, 0.6}, .radius = 0.3};
    struct shape c = {.type = SHAPE_RING, .a = {0.2, 0.1, 0.3}, .radius = 0.9, .inner = 0.5};
    struct shape d = {.type = SHAPE_BOX, .a = {-0.5, -0.5, -0.1}, .b = {0.1, 0.4, 0.7}};
    struct shape e = {.type = SHAPE_POLYGON, .n = 4, .vertex = corners}, *ab[2] = {&a, &b}, *cd[2] = {&c, &d};
    struct shape f = {.type = SHAPE_UNION, .n = 2, .parts = ab}, g = {.type = SHAPE_INTERSECTION, .n = 2, .parts = cd};
    struct shape *ff[1] = {&f}, h = {.type = SHAPE_COMPLEMENT, .n = 1, .parts = ff};
    const struct shape *shapes[] = {&a, &b, &c, &d, &e, &f, &g, &h};
    for (size_t s = 0; s < sizeof shapes / sizeof *shapes; s++)
        for (int trial = 0; trial < 20000; trial++) {
            double x[3], y[3], step[3], length = 0.0;
            for (int k = 0; k < 3; k++) {
                x[k] = 3.0 * random_unit() - 1.5;
                step[k] = random_unit() - 0.5;
                length += step[k] * step[k];
            }
            double level = shape_level(shapes[s], x), reach = fabs(level) * random_unit() * 0.999999 / sqrt(length);
            for (int k = 0; k < 3; k++) y[k] = x[k] + reach * step[k];
            if (level != 0.0 && shape_contains(shapes[s], x) != shape_contains(shapes[s], y))
                fail_msg("shape %zu: level %g at %g %g %g", s, level, x[0], x[1], x[2]);
        }
}

static void same_bits(double a, double b)
{
    if (memcmp(&a, &b, sizeof a) != 0) fail_msg("%.17g and %.17g", a, b);
}

static void mirrors_to_the_bit(void **state)
{
    (void)state;
    struct shape ball = {.type = SHAPE_SPHERE, .radius = 0.71};
    struct grid cube = {{-1, -1, -1}, {1, 1, 1}, 22, 3, 0};
    double v;
    for (int k = 0; k < 22; k++)
        for (int j = 0; j < 22; j++)
            for (int i = 0; i < 22; i++) {
                double f = cell_of(&ball, &cube, i, j, k, &v);
                same_bits(f, cell_of(&ball, &cube, 21 - i, j, k, &v));
                same_bits(f, cell_of(&ball, &cube, i, 21 - j, 21 - k, &v));
                same_bits(f, cell_of(&ball, &cube, k, i, j, &v));
                same_bits(f, cell_of(&ball, &cube, j, i, k, &v));
            }
    struct shape up = {.type = SHAPE_HALF_SPACE, .a = {0.0, 0.3, 0.0}, .b = {0.6, 0.8, 0.0}};
    struct shape down = {.type = SHAPE_HALF_SPACE, .a = {0.0, -0.3, 0.0}, .b = {0.6, -0.8, 0.0}};
    struct grid plane = {{-1, -1, 0}, {1, 1, 0}, 30, 2, 0}, turned = {{0, -1, 0}, {1, 1, 0}, 30, 2, 1};
    for (int j = 0; j < 30; j++)
        for (int i = 0; i < 30; i++) {
            same_bits(cell_of(&ball, &plane, i, j, 0, &v), cell_of(&ball, &plane, 29 - i, j, 0, &v));
            same_bits(cell_of(&ball, &plane, i, j, 0, &v), cell_of(&ball, &plane, j, 29 - i, 0, &v));
            same_bits(cell_of(&up, &plane, i, j, 0, &v), cell_of(&down, &plane, i, 29 - j, 0, &v));
            same_bits(cell_of(&ball, &turned, i, j, 0, &v), cell_of(&ball, &turned, i, 29 - j, 0, &v));
            same_bits(cell_of(&up, &turned, i, j, 0, &v), cell_of(&down, &turned, i, 29 - j, 0, &v));
        }
}

/* A surface on cell faces leaves pure cells, in spite of the round-off of their corners. */
static void keeps_pure_cells_pure(void **state)
{
    (void)state;
    struct shape half = {.type = SHAPE_HALF_SPACE, .a = {0.3}, .b = {1.0}},
                 box = {.type = SHAPE_BOX, .a = {0.3}, .b = {0.7}};
    struct grid line = {{0}, {1}, 1000, 1, 0};
    double v;
    for (int i = 0; i < 1000; i++) {
        assert_true(cell_of(&half, &line, i, 0, 0, &v) == (i >= 300 ? 1.0 : 0.0));
        assert_true(cell_of(&box, &line, i, 0, 0, &v) == (i >= 300 && i < 700 ? 1.0 : 0.0));
    }
}

static void frees(void **state)
{
    (void)state;
    struct shape *ball = mem_new(1, sizeof *ball), *both = mem_new(1, sizeof *both),
                 *polygon = mem_new(1, sizeof *polygon);
    ball->type = SHAPE_SPHERE;
    polygon->type = SHAPE_POLYGON;
    polygon->vertex = mem_new(3, sizeof *polygon->vertex);
    polygon->n = 3;
    *both = (struct shape){.type = SHAPE_UNION, .n = 2, .parts = mem_new(2, sizeof *both->parts)};
    both->parts[0] = ball;
    both->parts[1] = polygon;
    shape_free(both); /* a leak is the sanitizer's to find */
    shape_free(NULL);
}

/* A shape reaches into a box however small its part is, and does not where it surely stays outside. */
static void reaches(void **state)
{
    (void)state;
    const double lower[3] = {0.0, 0.0, 0.0}, upper[3] = {1.0, 2.0, 3.0};
    struct shape speck = {.type = SHAPE_SPHERE, .a = {0.5, 0.5, 0.5}, .radius = 1e-9};
    struct shape corner = {.type = SHAPE_SPHERE, .a = {-0.1, -0.1, -0.1}, .radius = 0.15};
    struct shape plane = {.type = SHAPE_HALF_SPACE, .a = {0.0, 0.0, 3.5}, .b = {0.0, 0.0, 1.0}};
    struct shape triangle = {.type = SHAPE_POLYGON, .n = 3};
    double vertices[3][2] = {{1.5, 0.0}, {2.0, 0.0}, {2.0, 1.0}};
    struct shape *parts[] = {&speck, &corner};
    struct shape both = {.type = SHAPE_INTERSECTION, .n = 2, .parts = parts}, one = both, none = both;
    triangle.vertex = vertices;
    one.type = SHAPE_UNION;
    none.type = SHAPE_COMPLEMENT;
    assert_true(shape_reaches(NULL, lower, upper, 3) && shape_reaches(&speck, lower, upper, 3));
    assert_true(shape_fraction(&speck, lower, upper, 3, 0) == 0.0);
    assert_false(shape_reaches(&corner, lower, upper, 3)); /* its bounds reach in, it does not */
    assert_true(shape_reaches(&corner, lower, upper, 2) && shape_reaches(&one, lower, upper, 3));
    assert_false(shape_reaches(&both, lower, upper, 3));
    assert_true(shape_reaches(&none, lower, upper, 3)); /* all but a speck */
    assert_false(shape_reaches(&plane, lower, upper, 3));
    plane.b[2] = -1.0;
    assert_true(shape_reaches(&plane, lower, upper, 3));
    assert_false(shape_reaches(&triangle, lower, upper, 2));
    vertices[0][0] = 0.9;
    assert_true(shape_reaches(&triangle, lower, upper, 2));
}

/* One whole turns by 0.3 about (0.1, -0.2), then by 0.4 about the origin. */
static void turn_twice(const double x[2], double ret[3])
{
    double a = x[0] - 0.1, b = x[1] + 0.2, c = 0.1 + cos(0.3) * a - sin(0.3) * b,
           d = -0.2 + sin(0.3) * a + cos(0.3) * b;
    ret[0] = cos(0.4) * c - sin(0.4) * d;
    ret[1] = sin(0.4) * c + cos(0.4) * d;
    ret[2] = 0.0;
}

static struct shape turned_by(double angle, double x, double y, struct shape **part)
{
    return (struct shape){.type = SHAPE_TURNED,
                          .a = {x, y},
                          .n = 1,
                          .parts = part,
                          .turn = {{cos(angle), -sin(angle), 0}, {sin(angle), cos(angle), 0}, {0, 0, 1}}};
}

/* Cells of a shape that turns twice hold what those of the same shape hold that stands there. */
static void same_as(struct shape *part, const struct shape *there)
{
    const struct grid plane = {{-1, -1, 0}, {1, 1, 0}, 17, 2, 0};
    struct shape once = turned_by(0.3, 0.1, -0.2, &part), *again = &once, twice = turned_by(0.4, 0.0, 0.0, &again);
    for (int i = 0; i < plane.cells; i++)
        for (int j = 0; j < plane.cells; j++) {
            double volume;
            assert_near(cell_of(&twice, &plane, i, j, 0, &volume), cell_of(there, &plane, i, j, 0, &volume), 1e-12);
        }
}

static void turns(void **state)
{
    (void)state;
    struct shape ball = {.type = SHAPE_SPHERE, .a = {0.3, 0.2}, .radius = 0.31}, there = ball;
    turn_twice(ball.a, there.a);
    same_as(&ball, &there);
    struct shape ring = {.type = SHAPE_RING, .a = {0.3, 0.2}, .radius = 0.5, .inner = 0.2};
    there = ring;
    turn_twice(ring.a, there.a);
    same_as(&ring, &there);
    struct shape half = {.type = SHAPE_HALF_SPACE, .a = {0.3, 0.2}, .b = {0.6, 0.8}};
    there = half;
    turn_twice(half.a, there.a);
    there.b[0] = cos(0.7) * 0.6 - sin(0.7) * 0.8;
    there.b[1] = sin(0.7) * 0.6 + cos(0.7) * 0.8;
    same_as(&half, &there);
    double corners[4][2] = {{-0.3, -0.2}, {0.5, -0.2}, {0.5, 0.1}, {-0.3, 0.1}}, moved[4][2];
    for (int i = 0; i < 4; i++) {
        double to[3];
        turn_twice(corners[i], to);
        moved[i][0] = to[0];
        moved[i][1] = to[1];
    }
    there = (struct shape){.type = SHAPE_POLYGON, .n = 4, .vertex = moved};
    struct shape box = {.type = SHAPE_BOX, .a = {-0.3, -0.2}, .b = {0.5, 0.1}};
    same_as(&box, &there);
    struct shape polygon = {.type = SHAPE_POLYGON, .n = 4, .vertex = corners};
    same_as(&polygon, &there);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(fills_spheres),
        cmocka_unit_test(fills_odd_spheres),
        cmocka_unit_test(fills_planes_and_boxes),
        cmocka_unit_test(fills_other_bodies),
        cmocka_unit_test(combines),
        cmocka_unit_test(turns),
        cmocka_unit_test(agrees_with_points),
        cmocka_unit_test(levels_are_safe),
        cmocka_unit_test(mirrors_to_the_bit),
        cmocka_unit_test(keeps_pure_cells_pure),
        cmocka_unit_test(frees),
        cmocka_unit_test(reaches),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
