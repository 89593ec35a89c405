/* Bodies from files: volumes of closed surfaces against closed forms, levels against all triangles, broken files;
 * images and arrays against the shapes that drew them. */
#include "base/mem.h"
#include "base/status.h"
#include "case/raster.h"
#include "case/shape.h"
#include "case/surface.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include <cmocka.h>

static char folder[] = "/tmp/bulla-body-XXXXXX", path[64];

static int make_folder(void **state)
{
    (void)state;
    if (!mkdtemp(folder)) return 1;
    snprintf(path, sizeof path, "%s/body", folder);
    return 0;
}

static int remove_folder(void **state)
{
    (void)state;
    unlink(path);
    return rmdir(folder);
}

/* Writing */

static size_t written;

static void facet(FILE *file, bool text, const double a[3], const double b[3], const double c[3])
{
    const double *corner[3] = {a, b, c};
    written++;
    if (text) fprintf(file, "  facet normal 0 0 0\n    outer loop\n");
    for (int k = 0; text && k < 3; k++)
        fprintf(file, "      vertex %.9g %.9g %.9g\n", corner[k][0], corner[k][1], corner[k][2]);
    if (text) fprintf(file, "    endloop\n  endfacet\n");
    if (text) return;
    float values[12] = {0};
    for (int k = 0; k < 9; k++) values[3 + k] = (float)corner[k / 3][k % 3];
    fwrite(values, sizeof values, 1, file);
    fwrite("\0\0", 2, 1, file);
}

static FILE *begin(bool text)
{
    FILE *file = fopen(path, "wb+");
    char head[84] = "solid of bytes";
    written = 0;
    if (text) fprintf(file, "solid body\n");
    else fwrite(head, sizeof head, 1, file);
    return file;
}

static void end(FILE *file, bool text)
{
    if (text) fprintf(file, "endsolid body\n");
    uint32_t n = (uint32_t)written;
    fseek(file, text ? 0 : 80, text ? SEEK_END : SEEK_SET);
    if (!text) fwrite(&n, sizeof n, 1, file);
    assert_int_equal(fclose(file), 0);
}

/* The faces of an octahedron, each divided into n^2, on a sphere (round) or plane; seen from inside for a negative
 * radius. */
static void ball(FILE *file, bool text, double radius, int n, bool round, const double at[3])
{
    for (int face = 0; face < 8; face++)
        for (int i = 0; i < n; i++)
            for (int j = 0; i + j < n; j++)
                for (int half = 0; half < 2 && i + j + half < n; half++) {
                    double x[3][3];
                    const int places[2][3][2] = {{{i, j}, {i + 1, j}, {i, j + 1}},
                                                 {{i + 1, j + 1}, {i, j + 1}, {i + 1, j}}};
                    if (half && i + j + 1 >= n) continue;
                    for (int k = 0; k < 3; k++) {
                        double part[3] = {(double)places[half][k][0] / n, (double)places[half][k][1] / n, 0.0},
                               length = 0.0;
                        part[2] = (double)(n - places[half][k][0] - places[half][k][1]) / n;
                        for (int d = 0; d < 3; d++) length += part[d] * part[d];
                        for (int d = 0; d < 3; d++)
                            x[k][d] = at[d] + fabs(radius) * part[d] * (face >> d & 1 ? -1.0 : 1.0) /
                                                  (round ? sqrt(length) : 1.0);
                    }
                    bool turned = (face & 1) ^ (face >> 1 & 1) ^ (face >> 2 & 1) ^ (radius < 0.0);
                    facet(file, text, x[0], x[turned ? 2 : 1], x[turned ? 1 : 2]);
                }
}

static void brick(FILE *file, const double lower[3], const double upper[3])
{
    static const int faces[6][4] = {{0, 4, 6, 2}, {1, 3, 7, 5}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 2, 3, 1}, {4, 5, 7, 6}};
    double corner[8][3];
    for (int k = 0; k < 8; k++)
        for (int d = 0; d < 3; d++) corner[k][d] = k >> d & 1 ? upper[d] : lower[d];
    for (int f = 0; f < 6; f++) {
        facet(file, true, corner[faces[f][0]], corner[faces[f][1]], corner[faces[f][2]]);
        facet(file, true, corner[faces[f][0]], corner[faces[f][2]], corner[faces[f][3]]);
    }
}

/* Reading */

static const double STILL[3][3] = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};

static void read_body(struct surface *surface)
{
    *surface = (struct surface){0};
    if (surface_read(path, surface)) fail_msg("%s", status_text());
    surface_place(surface, STILL, 1.0, (double[3]){0.0, 0.0, 0.0});
}

/* Sum over a grid of cells^3 in [-1.3, 1.3]^3. */
static double filled(const struct shape *shape, int cells, int dim)
{
    double h = 2.6 / cells, sum = 0.0;
    for (int i = 0; i < cells; i++)
        for (int j = 0; j < cells; j++)
            for (int k = 0; k < (dim > 2 ? cells : 1); k++) {
                double lower[3] = {-1.3 + h * i, -1.3 + h * j, -1.3 + h * k}, upper[3];
                for (int d = 0; d < 3; d++) upper[d] = lower[d] + h;
                double fraction = shape_fraction(shape, lower, upper, dim, 0);
                assert_true(fraction >= 0.0 && fraction <= 1.0);
                sum += fraction;
            }
    return sum * h * h * (dim > 2 ? h : 1.0);
}

static void assert_near(double value, double exact, double within)
{
    if (!(fabs(value - exact) <= within)) fail_msg("%.17g, wanted %.17g within %g", value, exact, within);
}

/* Text and binary, outside in, whatever lies in the planes of cells: the volume is that of the polyhedron. */
static void fills_surfaces(void **state)
{
    (void)state;
    for (int way = 0; way < 4; way++) {
        bool text = way & 1, round = way & 2;
        struct surface surface;
        FILE *file = begin(text);
        ball(file, text, way == 2 ? -1.0 : 1.0, round ? 12 : 3, round, (double[3]){0.0, 0.0, 0.0});
        end(file, text);
        read_body(&surface);
        struct shape shape = {.type = SHAPE_SURFACE, .surface = &surface};
        double volume = surface_volume(&surface);
        assert_near(volume, round ? 4.0 / 3.0 * M_PI : 4.0 / 3.0, round ? 0.05 : 1e-6);
        assert_near(filled(&shape, 13, 3), volume, 1e-12);
        assert_near(filled(&shape, 26, 3), volume, 1e-12); /* vertices on planes of cells */
        surface_done(&surface);
    }
}

/* A shell: a hole within, and a brick whose faces are those of cells. */
static void fills_holes_and_bricks(void **state)
{
    (void)state;
    struct surface surface;
    FILE *file = begin(true);
    ball(file, true, 1.0, 4, false, (double[3]){0.1, 0.0, 0.0});
    ball(file, true, -0.5, 2, false, (double[3]){0.1, 0.0, 0.0});
    end(file, true);
    read_body(&surface);
    struct shape shape = {.type = SHAPE_SURFACE, .surface = &surface};
    assert_near(filled(&shape, 17, 3), 4.0 / 3.0 * (1.0 - 0.125), 1e-7);
    assert_true(shape_level(&shape, (double[3]){0.1, 0.0, 0.0}) > 0.0);
    assert_true(shape_level(&shape, (double[3]){0.7, 0.0, 0.0}) < 0.0);
    surface_done(&surface);
    file = begin(true);
    brick(file, (double[3]){-0.65, -0.65, 0.0}, (double[3]){0.65, 0.0, 1.3});
    end(file, true);
    read_body(&surface);
    for (int cells = 4; cells <= 8; cells += 4) {
        const double lower[3] = {-0.65, -0.65, 0.0}, upper[3] = {0.0, 0.0, 0.65};
        assert_near(filled(&shape, cells, 3), 1.3 * 0.65 * 1.3, 1e-7);
        assert_true(shape_fraction(&shape, lower, upper, 3, 0) == 1.0);
    }
    surface_done(&surface);
}

/* The level of an octahedron of radius 1 is known. */
static void knows_distances(void **state)
{
    (void)state;
    struct surface surface;
    FILE *file = begin(true);
    ball(file, true, 1.0, 5, false, (double[3]){0.0, 0.0, 0.0});
    end(file, true);
    read_body(&surface);
    unsigned seed = 1;
    for (int i = 0; i < 400; i++) {
        double x[3], sum = 0.0;
        for (int d = 0; d < 3; d++) {
            seed = seed * 1664525u + 1013904223u;
            x[d] =
                i % 5 ? (double)(seed >> 8) / (1 << 24) * 1.2 - 0.6 : 0.2 * (double)(seed >> 29) - 0.6; /* edges too */
            sum += fabs(x[d]);
        }
        double level = surface_level(&surface, x), plane = (sum - 1.0) / sqrt(3.0);
        if (plane < -1e-9) assert_near(level, plane, 1e-7);
        else assert_true(level >= plane - 1e-7);
    }
    assert_near(surface_level(&surface, (double[3]){0.0, 3.0, 0.0}), 2.0, 1e-7);
    const double turn[3][3] = {{0, -1, 0}, {1, 0, 0}, {0, 0, 1}};
    surface_place(&surface, turn, 2.0, (double[3]){10.0, 0.0, 0.0});
    assert_near(surface_level(&surface, (double[3]){10.0, 0.0, 5.0}), 3.0, 1e-6);
    assert_near(surface_volume(&surface), 8.0 * 4.0 / 3.0, 1e-5);
    surface_done(&surface);
}

static void refused(const char *words)
{
    struct surface surface = {0};
    assert_int_equal(surface_read(path, &surface), STATUS_CASE);
    if (!strstr(status_text(), words)) fail_msg("'%s' says nothing of '%s'", status_text(), words);
    surface_done(&surface);
}

static void refuses_broken_surfaces(void **state)
{
    (void)state;
    const double a[3] = {0, 0, 0}, b[3] = {1, 0, 0}, c[3] = {0, 1, 0}, d[3] = {0, 0, 1};
    FILE *file = begin(true);
    facet(file, true, a, c, b);
    facet(file, true, a, b, d);
    facet(file, true, b, c, d);
    end(file, true);
    refused("3 of its edges belong to one triangle alone");
    file = begin(true);
    facet(file, true, a, c, b);
    facet(file, true, a, b, d);
    facet(file, true, b, c, d);
    facet(file, true, a, c, d);
    end(file, true);
    refused("at 3 two neighbours are wound against each other");
    file = begin(true);
    fprintf(file, "facet\nouter loop\nvertex 0 0 1\nvertex 1 zero 0\n");
    end(file, true);
    refused(":5: three numbers");
    file = begin(false);
    ball(file, false, 1.0, 2, false, a);
    end(file, false);
    assert_int_equal(truncate(path, 500), 0);
    refused("no triangle"); /* it says "solid", and is then a text without any */
    file = begin(true);
    end(file, true);
    refused("no triangle");
    file = fopen(path, "w");
    fprintf(file, "ply\n");
    fclose(file);
    refused("no STL file");
}

/* Arrays */

static void write_array(const char *type, const char *order, int n, size_t bytes, const void *values, size_t count)
{
    FILE *file = fopen(path, "wb");
    char header[128];
    const char *shape = n == 2 ? "(40, 60)" : "(20, 21, 22)";
    int length =
        snprintf(header, sizeof header, "{'descr': '%s', 'fortran_order': %s, 'shape': %s, }\n", type, order, shape);
    const unsigned char head[10] = {0x93, 'N', 'U', 'M', 'P', 'Y', 1, 0, (unsigned char)length, 0};
    fwrite(head, 1, 10, file);
    fwrite(header, 1, (size_t)length, file);
    fwrite(values, bytes, count, file);
    fclose(file);
}

static double disc(double x, double y, double z)
{
    return sqrt(x * x + 4.0 * (y - 0.1) * (y - 0.1) + z * z) - 0.8;
}

/* An ellipse that is no distance, stored in both orders: area and levels, which are never too large. */
static void fills_arrays(void **state)
{
    (void)state;
    double values[40][60], other[60][40];
    for (int i = 0; i < 40; i++)
        for (int j = 0; j < 60; j++)
            other[j][i] = values[i][j] = disc(-1.0 + (i + 0.5) / 20.0, -1.0 + (j + 0.5) / 30.0, 0.0);
    for (int order = 0; order < 2; order++) {
        struct raster raster;
        const double *all = order ? &other[0][0] : &values[0][0];
        write_array("<f8", order ? "True" : "False", 2, sizeof *all, all, 2400);
        assert_int_equal(raster_read_array(path, &raster), STATUS_OK);
        assert_int_equal(raster_place(&raster, (double[3]){-1, -1, 0}, (double[3]){1, 1, 0}, 0.0, 1.0), STATUS_OK);
        struct shape shape = {.type = SHAPE_RASTER, .raster = &raster};
        assert_near(filled(&shape, 26, 2), M_PI * 0.8 * 0.4, 2e-3);
        for (int k = 0; k < 200; k++) {
            double angle = 0.1 * k, away = 0.005 * k, x[3] = {0.8 * cos(angle), 0.1 + 0.4 * sin(angle), 0.0};
            double normal[2] = {0.5 * cos(angle), sin(angle)}, length = hypot(normal[0], normal[1]);
            for (int d = 0; d < 2; d++) x[d] += away * normal[d] / length;
            double level = shape_level(&shape, x);
            assert_true(level <= away + 2e-3 && level >= -2e-3); /* out along the normal: the distance is `away` */
            if (away > 0.3) assert_true(level > 0.3 * away);
        }
        raster_done(&raster);
    }
}

static void fills_arrays_of_bytes(void **state)
{
    (void)state;
    int8_t values[20][21][22];
    for (int i = 0; i < 20; i++)
        for (int j = 0; j < 21; j++)
            for (int k = 0; k < 22; k++) {
                double r = disc(-1.0 + (i + 0.5) / 10.0, -1.0 + (j + 0.5) / 10.5, -1.0 + (k + 0.5) / 11.0);
                values[i][j][k] = (int8_t)(r < -1.2 ? -120 : r > 1.2 ? 120 : 100.0 * r);
            }
    struct raster raster;
    write_array("|i1", "False", 3, 1, values, sizeof values);
    assert_int_equal(raster_read_array(path, &raster), STATUS_OK);
    assert_int_equal(raster_place(&raster, (double[3]){-1, -1, -1}, (double[3]){1, 1, 1}, 0.0, 1.0), STATUS_OK);
    struct shape shape = {.type = SHAPE_RASTER, .raster = &raster};
    assert_near(filled(&shape, 10, 3), 4.0 / 3.0 * M_PI * 0.8 * 0.4 * 0.8, 0.03);
    raster_done(&raster);
    write_array("|i1", "False", 3, 1, values, 100);
    assert_int_equal(raster_read_array(path, &raster), STATUS_CASE);
    assert_non_null(strstr(status_text(), "ends after 100 of 9240"));
    raster_done(&raster);
    write_array("<c8", "False", 3, 1, values, 100);
    assert_int_equal(raster_read_array(path, &raster), STATUS_CASE);
    assert_non_null(strstr(status_text(), "a kind that is not read"));
    raster_done(&raster);
}

/* Jagged circles too: an image of black and white, drawn by a threshold. */
static void fills_masks(void **state)
{
    (void)state;
    uint8_t values[40][60];
    for (int i = 0; i < 40; i++)
        for (int j = 0; j < 60; j++) values[i][j] = disc(-1.0 + (i + 0.5) / 20.0, -1.0 + (j + 0.5) / 30.0, 0.0) < 0.0;
    struct raster raster;
    write_array("|b1", "False", 2, 1, values, sizeof values);
    assert_int_equal(raster_read_array(path, &raster), STATUS_OK);
    assert_int_equal(raster_place(&raster, (double[3]){-1, -1, 0}, (double[3]){1, 1, 0}, 0.5, -1.0), STATUS_OK);
    struct shape shape = {.type = SHAPE_RASTER, .raster = &raster};
    assert_near(filled(&shape, 26, 2), M_PI * 0.8 * 0.4, 0.02);
    assert_true(shape_level(&shape, (double[3]){0.0, 0.1, 0.0}) < -0.2); /* far from the edge it knows how far */
    raster_done(&raster);
    assert_int_equal(raster_read_array(path, &raster), STATUS_OK);
    assert_int_equal(raster_place(&raster, (double[3]){-1, -1, 0}, (double[3]){1, 1, 0}, 2.0, -1.0), STATUS_CASE);
    assert_non_null(strstr(status_text(), "none"));
    raster_done(&raster);
}

/* A turned square is one: the level and the cells. */
static void turns(void **state)
{
    (void)state;
    struct shape square = {.type = SHAPE_BOX, .a = {-0.5, -0.5, -0.5}, .b = {0.5, 0.5, 0.5}}, *part = &square;
    struct shape turned = {.type = SHAPE_TURNED, .a = {0.2, 0.0, 0.0}, .n = 1, .parts = &part};
    double c = cos(0.5), s = sin(0.5);
    const double turn[3][3] = {{c, -s, 0}, {s, c, 0}, {0, 0, 1}};
    memcpy(turned.turn, turn, sizeof turn);
    assert_near(filled(&turned, 20, 2), 1.0, 1e-3);
    assert_near(filled(&turned, 12, 3), 1.0, 2e-2);
    const double corner[3] = {0.2 + c * 0.3 - s * 0.5, s * 0.3 + c * 0.5, 0.0};
    assert_near(shape_level(&turned, corner), 0.0, 1e-14);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(fills_surfaces),  cmocka_unit_test(fills_holes_and_bricks),
        cmocka_unit_test(knows_distances), cmocka_unit_test(refuses_broken_surfaces),
        cmocka_unit_test(fills_arrays),    cmocka_unit_test(fills_arrays_of_bytes),
        cmocka_unit_test(fills_masks),     cmocka_unit_test(turns),
    };
    return cmocka_run_group_tests(tests, make_folder, remove_folder);
}
