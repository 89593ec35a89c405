/* What rigid bodies leave of cells and faces: exact volumes, walls that close every cell and every body, faces that are
 * shut by what lies in them, and for bodies that move dtheta = W . U dt. */
#include "case/pose.h"
#include "close.h"
#include "mesh/metric.h"
#include "mesh/rigid.h"
#include "small.h"

#include <math.h>

#define CASE(domain, bodies)                                                      \
    "bulla: 1\ntitle: t\ndomain: " domain                                         \
    "\nmesh: {tile: 8}\nmaterials: {air: {eos: {type: ideal-gas, gamma: 1.4}}}\n" \
    "bodies:\n" bodies "initial: [{everywhere: true, material: air, density: 1.2, pressure: 1e5}]\nrun: {until: 1}\n"
#define WALLS2 "boundaries: {x-: reflecting, x+: reflecting, y-: reflecting, y+: reflecting}"
#define SQUARE "{lower: [-1, -1], upper: [1, 1], cells: [24, 24], " WALLS2 "}"
#define ROUND                                                                                                    \
    "{geometry: axisymmetric, lower: [0, -1], upper: [1, 1], cells: [16, 32], boundaries: {x+: reflecting, y-: " \
    "reflecting, "                                                                                               \
    "y+: reflecting}}"
#define CUBE                                                                                                         \
    "{lower: [-1, -1, -1], upper: [1, 1, 1], cells: [16, 16, 16], boundaries: {x-: reflecting, x+: reflecting, y-: " \
    "reflecting, y+: reflecting, z-: reflecting, z+: reflecting}}"

/* What a scene's cells hold in all. */
struct sums {
    double volume, wall[3]; /* of fluid; area vectors of walls */
    double room;            /* d theta/dt - W . U, the largest over the largest W . U */
    unsigned shut;          /* cells with a wall in a face and nothing covered */
};

static void add_cell(const struct rigid_cells *cells, const int at[3], int dim, double volume, double duration,
                     struct sums *sums)
{
    size_t i = rigid_offset(cells, at);
    double room = 0.0, length = 0.0;
    sums->volume += cells->now[i] * volume;
    for (int d = 0; d < dim; d++) {
        sums->wall[d] += cells->wall[d][i] * volume;
        length += fabs(cells->wall[d][i]);
        if (cells->speed[d]) room += cells->wall[d][i] * cells->speed[d][i];
    }
    if (cells->now[i] == 1.0 && length > 0.0) sums->shut++;
    double change = 2.0 * (cells->part[i] - cells->was[i]) / duration; /* part: the mean of both ends */
    if (duration > 0.0) sums->room = fmax(sums->room, fabs(change - room));
}

static struct sums sums_of(const char *text, double from, double to)
{
    struct small small;
    struct sums sums = {0};
    small_start(&small, text);
    const struct mesh *mesh = small.state->mesh;
    const struct level *level = &mesh->levels[0];
    double *volume = mem_new(mesh->n_cell, sizeof *volume);
    for (unsigned t = 0; t < level->n_local; t++) {
        const struct rigid_cells *cells = rigid_at(mesh, level, &level->tiles[t], (struct rigid_times){from, to, from});
        size_t i = 0;
        metric_volumes(mesh, level, &level->tiles[t], volume);
        for (int z = 0; z < mesh->n[2]; z++)
            for (int y = 0; y < mesh->n[1]; y++)
                for (int x = 0; x < mesh->n[0]; x++, i++)
                    if (cells) add_cell(cells, (int[]){x, y, z}, mesh->dim, volume[i], to - from, &sums);
                    else sums.volume += volume[i];
    }
    mem_free(volume);
    small_stop(&small);
    return sums;
}

static void test_volumes(void **state)
{
    (void)state;
    struct sums disc = sums_of(CASE(SQUARE, "  a: {sphere: {center: [0.1, -0.07], radius: 0.4}}\n"), 0, 0);
    struct sums ball = sums_of(CASE(CUBE, "  a: {sphere: {center: [0.1, -0.07, 0.02], radius: 0.4}}\n"), 0, 0);
    struct sums axis = sums_of(CASE(ROUND, "  a: {sphere: {center: [0, 0.11], radius: 0.4}}\n"), 0, 0);
    assert_close(disc.volume, 4.0 - M_PI * 0.16, 1e-12);
    assert_close(ball.volume, 8.0 - 4.0 / 3.0 * M_PI * 0.064, 1e-7); /* without slivers */
    assert_close(axis.volume, 2.0 * M_PI - 4.0 / 3.0 * M_PI * 0.064, 1e-7);
    for (int d = 0; d < 3; d++) {
        assert_close(disc.wall[d], 0.0, 1e-14);
        assert_close(ball.wall[d], 0.0, 1e-13);
    }
    assert_close(axis.wall[1], 0.0, 1e-13);
}

/* A box whose sides lie in faces covers whole cells, and shuts their faces. */
static void test_faces(void **state)
{
    (void)state;
    struct sums box = sums_of(CASE(SQUARE, "  a: {box: {lower: [-0.5, -0.25], upper: [0.25, 0.5]}}\n"), 0, 0);
    assert_close(box.volume, 4.0 - 0.5625, 1e-12);
    assert_int_equal(box.shut, 4 * 9);
    assert_close(box.wall[0], 0.0, 1e-15);
}

/* The open part of cells changes by what their walls leave room for: to round-off along an axis. */
static void test_ways(void **state)
{
    (void)state;
    struct sums disc = sums_of(
        CASE(SQUARE,
             "  a: {sphere: {center: [0.1, -0.07], radius: 0.4}, velocity: [0.6, 0]}\n  b: {box: {lower: [-0.9, 0.5], "
             "upper: [-0.5, 0.8]}, displacement: [0, '= 0.2 * t']}\n"),
        0.05, 0.1);
    assert_true(disc.room < 1e-10);
}

/* Turned about a point, then moved; and back. */
static void test_pose(void **state)
{
    (void)state;
    struct scene_rigid rigid = {.angle = {.given = true, .number = 0.3},
                                .pivot = {0.2, 0.1, 0},
                                .velocity = {2, -1, 0}};
    struct pose pose, still;
    double at[3], way[3], x[3] = {0.2 + 1.0, 0.1 - 0.5, 0};
    assert_int_equal(pose_at(&rigid, 0.5, &pose), 0);
    pose_back(&pose, x, at); /* the pivot has come to x */
    assert_close(at[0], 0.2, 1e-15);
    assert_close(at[1], 0.1, 1e-15);
    rigid.angle.given = false;
    assert_int_equal(pose_at(&rigid, 0.0, &still), 0);
    rigid.angle.given = true;
    pose_way(&still, &pose, (double[]){1.2, 0.1, 0}, way);
    assert_close(way[0], 1.0 + cos(0.3) - 1.0, 1e-15);
    assert_close(way[1], -0.5 + sin(0.3), 1e-15);
}

/* How fast a body goes: exactly what is given; what a script moves to second order; no point is faster than said. */
static void test_rates(void **state)
{
    (void)state;
    struct small small;
    struct pose_rate rate;
    double u[3], x[3] = {0.5, 0.25, 0};
    small_start(&small,
                CASE(SQUARE,
                     "  a: {sphere: {center: [0, 0.5], radius: 0.1}, velocity: [0.6, -0.3]}\n  b: {box: {lower: "
                     "[-0.9, -0.8], upper: [-0.5, -0.5]}, displacement: [0, '= 0.02 * math.sin(40 * t)'], "
                     "angle: '= 3 * t', pivot: [-0.7, -0.65]}\n"));
    const struct scene_rigid *a = &small.state->scene->rigids[0], *b = &small.state->scene->rigids[1];
    assert_int_equal(pose_rate_at(a, 0.0137, &rate), 0);
    pose_rate_way(a, &rate, x, u);
    assert_true(u[0] == 0.6 && u[1] == -0.3 && u[2] == 0.0);
    assert_close(pose_rate_most(a, &rate), hypot(0.6, 0.3), 1e-15);
    assert_int_equal(pose_rate_at(b, 0.0137, &rate), 0);
    pose_rate_way(b, &rate, x, u);
    double up = 0.8 * cos(40 * 0.0137);
    assert_close(u[0], -3.0 * (0.25 + 0.65 - 0.02 * sin(40 * 0.0137)), 1e-6);
    assert_close(u[1], up + 3.0 * (0.5 + 0.7), 1e-6);
    assert_close(pose_rate_most(b, &rate), up + 3.0 * hypot(1.7, 1.65), 1e-6);
    const struct mesh *mesh = small.state->mesh;
    assert_close(rigid_pace(mesh, &mesh->levels[0], 0.0137), 2.0 * (up + 3.0 * hypot(1.7, 1.65)) * 12.0, 1e-4);
    small_stop(&small);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_volumes), cmocka_unit_test(test_faces), cmocka_unit_test(test_ways),
        cmocka_unit_test(test_pose),    cmocka_unit_test(test_rates),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
