/* tag_world.h - a level whose primitives are set cell by cell, and what its tags must be. Nothing is computed. */
#ifndef TAG_WORLD_H
#define TAG_WORLD_H

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>

#include <cmocka.h>

#include "base/comm.h"
#include "base/mem.h"
#include "base/status.h"
#include "case/scene_read.h"
#include "mesh/halo.h"
#include "solve/tag.h"

#include <math.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

/* Level 0 of a case, a halo for one component, and marks. */
struct world {
    struct scene *scene;
    struct model *model;
    struct mesh *mesh;
    struct halo *halo;
    double **marks;
    long long hits[8];
};

/* Number of a cell of level 0 in the domain. */
typedef double world_field(const int cell[3]);

static inline void world_open(struct world *world, int dim, const char *faces, const char *refine)
{
    static const char *const lists[][3] = {{"[0]", "[0.5]", "[32]"},
                                           {"[-1, -1]", "[1, 1]", "[24, 24]"},
                                           {"[0, 0, 0]", "[1, 2, 4]", "[8, 12, 8]"}};
    char path[] = "/tmp/bulla-tag-XXXXXX.yaml", boundaries[256] = "";
    for (int axis = 0; axis < dim; axis++)
        snprintf(boundaries + strlen(boundaries), sizeof boundaries - strlen(boundaries), "%s%c-: %s, %c+: %s",
                 axis ? ", " : "", "xyz"[axis], faces, "xyz"[axis], faces);
    int file = mkstemps(path, 5);
    assert_true(file >= 0);
    FILE *stream = fdopen(file, "w");
    fprintf(stream,
            "bulla: 1\ndomain: {lower: %s, upper: %s, cells: %s, boundaries: {%s}}\n"
            "mesh: {levels: 2, tile: %d, refine: [%s]}\n"
            "materials:\n  water: {eos: {type: stiffened-gas, gamma: 4.4, p-inf: 600 MPa}}\n"
            "  air: {eos: {type: ideal-gas, gamma: 1.4}}\n"
            "initial: [{everywhere: true, material: water, density: 1000, pressure: 1 bar}]\nrun: {until: 1}\n",
            lists[dim - 1][0], lists[dim - 1][1], lists[dim - 1][2], boundaries, dim == 2 ? 8 : 4, refine);
    fclose(stream);
    *world = (struct world){0};
    FILE *quiet = fopen("/dev/null", "w");
    struct scene_options options = {.messages = quiet};
    if (scene_read(path, &options, &world->scene)) fail_msg("%s: %s", status_text(), refine);
    fclose(quiet);
    unlink(path);
    world->model = model_new(world->scene);
    if (mesh_new(world->scene, world->model->n_field, world->model->n_alpha, &world->mesh))
        fail_msg("%s", status_text());
    const struct level *level = &world->mesh->levels[0];
    world->halo = halo_new(world->mesh, level, 1);
    world->marks = mem_new(level->n_local + 1, sizeof *world->marks);
    for (unsigned t = 0; t < level->n_local; t++) {
        world->marks[t] = mem_new(world->mesh->n_cell, sizeof **world->marks);
        for (size_t c = 0; c < world->mesh->n_cell; c++) world->marks[t][c] = 7.0;
    }
}

static inline void world_close(struct world *world)
{
    for (unsigned t = 0; t < world->mesh->levels[0].n_local; t++) mem_free(world->marks[t]);
    mem_free(world->marks);
    halo_free(world->halo);
    mesh_free(world->mesh);
    model_free(world->model);
    scene_free(world->scene);
}

/* Place of cell c of a local tile in the domain. */
static inline void world_cell(const struct world *world, unsigned local, size_t c, int ret_cell[3])
{
    const struct level *level = &world->mesh->levels[0];
    for (int d = 0; d < 3; d++) {
        size_t n = (size_t)world->mesh->n[d];
        ret_cell[d] = level->tiles[level->first + local].at[d] * world->mesh->n[d] + (int)(c % n);
        c /= n;
    }
}

static inline void world_fill(struct world *world, unsigned q, world_field *value)
{
    const struct level *level = &world->mesh->levels[0];
    size_t n = world->mesh->n_cell;
    int cell[3];
    for (unsigned t = 0; t < level->n_local; t++)
        for (size_t c = 0; c < n; c++) {
            world_cell(world, t, c, cell);
            level->w[t][q * n + c] = value(cell);
        }
}

/* Water everywhere, at rest and 1 bar. */
static inline void world_rest(struct world *world)
{
    const struct level *level = &world->mesh->levels[0];
    const struct model *model = world->model;
    size_t n = world->mesh->n_cell;
    for (unsigned t = 0; t < level->n_local; t++)
        for (unsigned q = 0; q < model->n_field; q++)
            for (size_t c = 0; c < n; c++) {
                bool alpha = q < model->n_alpha, density = q >= model->i_m && q < model->i_u;
                double w = alpha ? q == 0 : density ? 1000.0 - (q - model->i_m) * 999.0 : q == model->i_E ? 1e5 : 0.0;
                level->w[t][q * n + c] = w;
            }
}

static inline void world_tag(struct world *world, double t)
{
    memset(world->hits, 0, sizeof world->hits);
    struct derive_moment moment = derive_moment(world->model, world->mesh, t);
    if (tag_level(&moment, 0, world->halo, world->marks, world->hits)) fail_msg("%s", status_text());
}

/* Are the marks those of a function of the cell? And are there marked and unmarked ones? */
typedef bool world_wanted(const struct world *world, const int cell[3]);

static inline void world_expect(struct world *world, world_wanted *wanted)
{
    const struct level *level = &world->mesh->levels[0];
    long long count[2] = {0, 0}, hits = world->hits[0];
    for (unsigned t = 0; t < level->n_local; t++)
        for (size_t c = 0; c < world->mesh->n_cell; c++) {
            int cell[3];
            world_cell(world, t, c, cell);
            bool want = wanted(world, cell);
            if (world->marks[t][c] != (want ? 1.0 : 0.0))
                fail_msg("cell %d %d %d: mark %g, wanted %d", cell[0], cell[1], cell[2], world->marks[t][c], want);
            count[want]++;
        }
    assert_true(count[1] == hits);
    comm_sum_counts(count, 2);
    assert_true(count[0] > 0 && count[1] > 0);
}

#endif
