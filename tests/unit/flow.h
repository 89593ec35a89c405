/* flow.h - runs in memory for the tests of mesh, phys and solve: a case text becomes a state, cells can be
 * set point by point, steps are taken, and fields come back as one array of the whole domain, x fastest. */
#ifndef FLOW_H
#define FLOW_H

#include "base/mem.h"
#include "base/status.h"
#include "case/scene_read.h"
#include "derive/derive.h"
#include "mesh/metric.h"
#include "phys/mix.h"
#include "solve/advance.h"
#include "solve/adopt.h"
#include "solve/stage.h"
#include "solve/verdict.h"
#include "solve/state.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include <cmocka.h>

enum { FLOW_FIELDS = MODEL_FIELDS };

#define FLOW_WATER "  water: {eos: {type: stiffened-gas, gamma: 4.4, p-inf: 600 MPa}}\n"
#define FLOW_AIR "  air: {eos: {type: ideal-gas, gamma: 1.4}}\n"
#define FLOW_HELIUM "  helium: {eos: {type: ideal-gas, gamma: 1.667}}\n"

struct flow {
    struct scene *scene;
    struct state *state;
    size_t n_cell; /* of the domain */
};

/* Sets the primitives of the cell with centre x; w holds those that the case painted. */
typedef void flow_setter(const struct model *model, const double x[3], double *w);

/* Takes ownership of `text`. The code of state_new; a case that cannot be read is a failure of the test. */
static inline int flow_open(struct flow *flow, char *text)
{
    char path[] = "/tmp/bulla-flow-XXXXXX.yaml";
    int file = mkstemps(path, 5);
    size_t length = strlen(text);
    *flow = (struct flow){.n_cell = 1};
    assert_true(file >= 0);
    assert_int_equal(write(file, text, length), (ssize_t)length);
    close(file);
    if (scene_read(path, NULL, &flow->scene)) fail_msg("%s\n%s", status_text(), text);
    unlink(path);
    mem_free(text);
    for (int d = 0; d < flow->scene->domain.dim; d++) flow->n_cell *= (size_t)flow->scene->domain.cells[d];
    return state_new(flow->scene, &flow->state);
}

static inline void flow_start(struct flow *flow, char *text)
{
    if (flow_open(flow, text)) fail_msg("%s", status_text());
}

static inline void flow_stop(struct flow *flow)
{
    state_free(flow->state);
    scene_free(flow->scene);
}

static inline const struct level *flow_level(const struct flow *flow)
{
    return &flow->state->mesh->levels[0];
}

/* Where frames of its coarsest level are gathered from, boundaries included. */
static inline struct frame_source flow_source(const struct flow *flow)
{
    const struct level *level = flow_level(flow);
    return (struct frame_source){.mesh = flow->state->mesh,
                                 .level = level,
                                 .arrays = level->w,
                                 .halo = level->halo,
                                 .n_field = flow->state->model->n_field,
                                 .boundary = bound_fill,
                                 .data = flow->state->stages[0]->bound};
}

/* Index in the domain of cell c of a local tile. */
static inline size_t flow_index(const struct flow *flow, unsigned local, size_t c)
{
    const struct mesh *mesh = flow->state->mesh;
    const struct level *level = flow_level(flow);
    const struct tile *tile = &level->tiles[level->first + local];
    size_t index = 0, step = 1;
    for (int d = 0; d < 3; d++) {
        size_t n = (size_t)mesh->n[d];
        index += ((size_t)tile->at[d] * n + c % n) * step;
        c /= n;
        step *= n * (size_t)level->extent[d];
    }
    return index;
}

/* Centre of a cell of the domain. */
static inline void flow_centre(const struct flow *flow, size_t index, double ret_x[3])
{
    const struct scene *scene = flow->scene;
    for (int d = 0; d < 3; d++) {
        size_t n = (size_t)scene->domain.cells[d], i = d < scene->domain.dim ? index % n : 0;
        double width =
            d < scene->domain.dim ? (scene->domain.upper[d] - scene->domain.lower[d]) / scene->domain.cells[d] : 0.0;
        ret_x[d] = d < scene->domain.dim ? scene->domain.lower[d] + ((double)i + 0.5) * width : 0.0;
        if (d < scene->domain.dim) index /= n;
    }
}

/* Closes u_old as after a step: primitives, signal speed and boundary references. */
static inline void flow_close(struct flow *flow)
{
    struct stage *stage = flow->state->stages[0];
    if (verdict_start(stage, &flow->state->counts.relaxed)) fail_msg("%s", status_text());
    flow->state->signal = stage->signal;
    adopt_bounds(stage);
}

/* Gives every cell the primitives of a function. */
static inline void flow_set(struct flow *flow, flow_setter *set)
{
    const struct model *model = flow->state->model;
    const struct level *level = flow_level(flow);
    size_t n = flow->state->mesh->n_cell;
    for (unsigned t = 0; t < level->n_local; t++)
        for (size_t c = 0; c < n; c++) {
            double x[3], w[FLOW_FIELDS], u[FLOW_FIELDS];
            for (unsigned q = 0; q < model->n_field; q++) w[q] = level->w[t][q * n + c];
            flow_centre(flow, flow_index(flow, t, c), x);
            set(model, x, w);
            mix_conserved(model, 1, 1, w, u);
            for (unsigned q = 0; q < model->n_field; q++) level->u_old[t][q * n + c] = u[q];
            level->w[t][model->i_E * n + c] = w[model->i_E];
        }
    flow_close(flow);
}

static inline void flow_steps(struct flow *flow, int count)
{
    for (int i = 0; i < count; i++)
        if (advance_step(flow->state, HUGE_VAL)) fail_msg("step %d: %s", i + 1, status_text());
}

/* To the time `until`, exactly; returns the number of steps. */
static inline int flow_until(struct flow *flow, double until)
{
    int steps = 0;
    for (; flow->state->t < until * (1.0 - 1e-12); steps++)
        if (advance_step(flow->state, until - flow->state->t)) fail_msg("%s", status_text());
    return steps;
}

/* A component of one of the arrays of all tiles, as an array of the domain; release with mem_free. */
static inline double *flow_component(const struct flow *flow, double *const *arrays, unsigned q)
{
    size_t n = flow->state->mesh->n_cell;
    double *all = mem_new(flow->n_cell, sizeof *all);
    for (unsigned t = 0; t < flow_level(flow)->n_local; t++)
        for (size_t c = 0; c < n; c++) all[flow_index(flow, t, c)] = arrays[t][q * n + c];
    return all;
}

static inline double *flow_conserved(const struct flow *flow, unsigned q)
{
    return flow_component(flow, flow_level(flow)->u_old, q);
}

static inline double *flow_primitive(const struct flow *flow, unsigned q)
{
    return flow_component(flow, flow_level(flow)->w, q);
}

/* A component of a derived field. */
static inline double *flow_derived(const struct flow *flow, const char *name, unsigned component)
{
    struct derive field;
    const struct state *state = flow->state;
    size_t n = state->mesh->n_cell;
    if (derive_find(state->model, name, &field)) fail_msg("%s", status_text());
    struct derive_moment moment = derive_moment(state->model, state->mesh, state->t);
    derive_prepare(&moment, &field);
    double *all = mem_new(flow->n_cell, sizeof *all), *out = mem_new(field.components * n, sizeof *out);
    for (unsigned t = 0; t < flow_level(flow)->n_local; t++) {
        derive_tile(state->model, state->mesh, 0, t, state->t, &field, out);
        for (size_t c = 0; c < n; c++) all[flow_index(flow, t, c)] = out[component * n + c];
    }
    mem_free(out);
    return all;
}

/* Whole volumes of the cells of the domain. */
static inline double *flow_volumes(const struct flow *flow)
{
    const struct mesh *mesh = flow->state->mesh;
    const struct level *level = flow_level(flow);
    double *all = mem_new(flow->n_cell, sizeof *all), *volume = mem_new(mesh->n_cell, sizeof *volume);
    for (unsigned t = 0; t < level->n_local; t++) {
        metric_volumes(mesh, level, &level->tiles[level->first + t], volume);
        for (size_t c = 0; c < mesh->n_cell; c++) all[flow_index(flow, t, c)] = volume[c];
    }
    mem_free(volume);
    return all;
}

/* Integral over the domain of a conserved field, and of its magnitude. */
static inline long double flow_total(const struct flow *flow, unsigned q, double *ret_size)
{
    double *u = flow_conserved(flow, q), *volume = flow_volumes(flow);
    long double sum = 0.0L, size = 0.0L;
    for (size_t c = 0; c < flow->n_cell; c++) {
        sum += (long double)u[c] * volume[c];
        size += fabsl((long double)u[c] * volume[c]);
    }
    *ret_size = (double)size;
    mem_free(u);
    mem_free(volume);
    return sum;
}

/* Are all evolved fields of both runs the same, to the bit? */
static inline bool flow_equal(const struct flow *a, const struct flow *b)
{
    bool equal = a->n_cell == b->n_cell;
    for (unsigned q = 0; equal && q < a->state->model->n_field; q++) {
        double *x = flow_conserved(a, q), *y = flow_conserved(b, q);
        for (size_t c = 0; c < a->n_cell; c++) equal = equal && x[c] == y[c];
        mem_free(x);
        mem_free(y);
    }
    return equal;
}

/* Numbers that look random and are the same everywhere: 0 <= x < 1 (splitmix64). */
static inline double flow_random(uint64_t *seed)
{
    uint64_t z = *seed += 0x9e3779b97f4a7c15u;
    z = (z ^ z >> 30) * 0xbf58476d1ce4e5b9u;
    z = (z ^ z >> 27) * 0x94d049bb133111ebu;
    return (double)((z ^ z >> 31) >> 11) * 0x1p-53;
}

#endif
