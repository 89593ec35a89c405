/* small.h - a small scene in memory for the tests of io: a case text, read and painted, whose
 * output goes to a folder that is removed at the end. */
#ifndef SMALL_H
#define SMALL_H

#include "base/mem.h"
#include "base/status.h"
#include "case/scene_read.h"
#include "derive/derive.h"
#include "plug/registry.h"
#include "solve/state.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include <cmocka.h>

struct small {
    char folder[64]; /* holds case.yaml and out/ */
    struct scene *scene;
    struct state *state;
};

/* A moment of its own for one output. */
#define SMALL_NOW(state) (&(struct derive_moment){.model = (state)->model, .mesh = (state)->mesh, .t = (state)->t})

/* Reads and paints a case that may have `levels` above the coarsest; prints why not. */
static inline void small_start_levels(struct small *small, const char *text, int levels)
{
    *small = (struct small){.folder = "/tmp/bulla-test-XXXXXX"};
    assert_non_null(mkdtemp(small->folder));
    char *path = mem_print("%s/tiny.yaml", small->folder), *out = mem_print("%s/out", small->folder);
    FILE *stream = fopen(path, "w");
    assert_non_null(stream);
    fputs(text, stream);
    fclose(stream);
    struct scene_options options = {.directory = out};
    assert_int_equal(scene_read(path, &options, &small->scene), 0);
    small->scene->mesh.levels = levels;
    int code = state_new(small->scene, &small->state);
    if (code) print_error("%s\n", status_text());
    assert_int_equal(code, 0);
    mem_free(path);
    mem_free(out);
}

static inline void small_start(struct small *small, const char *text)
{
    small_start_levels(small, text, 0);
}

/* A path inside the output folder; release with mem_free. */
static inline char *small_path(const struct small *small, const char *name)
{
    return mem_print("%s/out/%s", small->folder, name);
}

static inline void small_stop(struct small *small)
{
    char *command = mem_print("rm -rf '%s'", small->folder);
    state_free(small->state);
    scene_free(small->scene);
    assert_int_equal(system(command), 0);
    mem_free(command);
}

/* The whole text of a file of the output folder. */
static inline char *small_text(const struct small *small, const char *name)
{
    char *path = small_path(small, name);
    FILE *stream = fopen(path, "r");
    assert_non_null(stream);
    char *text = mem_new(1 << 20, 1);
    size_t length = fread(text, 1, (1 << 20) - 1, stream);
    text[length] = '\0';
    fclose(stream);
    mem_free(path);
    return text;
}

/* Moves a state on in time without computing: what is written next belongs to a later step. */
static inline void small_skip(struct small *small, double dt)
{
    small->state->t += dt;
    small->state->dt = dt;
    small->state->step++;
}

#define SMALL_MATERIALS                                                   \
    "materials:\n"                                                        \
    "  water: {eos: {type: stiffened-gas, gamma: 4.4, p-inf: 600 MPa}}\n" \
    "  air: {eos: {type: ideal-gas, gamma: 1.4}}\n"

/* A bubble, half of it; with two finer levels around it. */
#define SMALL_BUBBLE(above, mesh)                                                                                     \
    "bulla: 1\ntitle: A bubble, half of it\n"                                                                         \
    "domain:\n  geometry: axisymmetric\n  lower: [0, -1 mm]\n  upper: [1 mm, 1 mm]\n"                                 \
    "  cells: [32, 64]\n  boundaries: {x-: axis, x+: outflow, y-: outflow, y+: " above "}\n"                          \
    "mesh: {" mesh "}\n" SMALL_MATERIALS                                                                              \
    "initial:\n  - {everywhere: true, material: water, density: 1000, pressure: = 1e5 + 1e8 * y, velocity: [1, 2]}\n" \
    "  - {sphere: {center: [0, 0], radius: 0.5 mm}, material: air, density: 1.2, pressure: 1e5, velocity: [0, -3]}\n" \
    "run: {until: 1 us}\n"
#define SMALL_AXISYMMETRIC SMALL_BUBBLE("outflow", "tile: 16")
#define SMALL_LEVELS SMALL_BUBBLE("non-reflecting", "tile: 8, levels: 2, refine: [{interface: air}]")

#endif
