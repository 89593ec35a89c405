/* rate.c - see rate.h. */
#include "scheme/rate.h"

#include "phys/elastic.h"
#include "scheme/divergence.h"

#include <string.h>

/* Rows of fields that the path leaves alone are nobody's. */
static void rate_clear(const struct term_tile *tile)
{
    const struct model *model = tile->model;
    size_t n_cell = tile->n_cell;
    for (unsigned i = 0; i < model->n_active; i++)
        memset(tile->rates + model->active[i] * n_cell, 0, n_cell * sizeof(double));
    memset(tile->rates + model->n_field * n_cell, 0, (tile->terms->n_rates - model->n_field) * n_cell * sizeof(double));
}

/* The slot of all terms that have it. */
static void rate_each(struct term_piece *piece, void *const *own, bool faces)
{
    const struct terms *terms = piece->terms;
    for (unsigned i = 0; i < terms->n; i++) {
        void (*slot)(const struct term_piece *) = faces ? terms->at[i]->faces : terms->at[i]->frame;
        piece->own = own[terms->number[i]];
        if (slot && terms_acts(terms->at[i], piece->tile->part)) slot(piece);
    }
}

struct term_piece rate_gather(const struct term_tile *tile, void *const *own, const struct frame *frame,
                              const struct rate_watch *watch)
{
    struct face_work *faces = tile->terms->faces;
    struct term_piece piece = {
        .tile = tile, .terms = tile->terms, .model = tile->model, .frame = frame, .faces = faces};
    watch->gather(watch->data, frame, faces);
    face_begin(faces, frame);
    rate_each(&piece, own, false);
    return piece;
}

static void rate_sweep(const struct term_tile *tile, void *const *own, int axis, const struct rate_watch *watch,
                       bool masked)
{
    struct face_work *faces = tile->terms->faces;
    size_t pieces = frame_pieces(tile->mesh, axis);
    for (size_t index = 0; index < pieces; index++) {
        struct frame frame = frame_piece(tile->mesh, axis, index);
        struct term_piece piece = rate_gather(tile, own, &frame, watch);
        if (tile->part == TERM_DIFFUSION) face_rest(faces, &frame);
        else face_solve(faces, &frame, masked);
        rate_each(&piece, own, true);
        watch->seen(watch->data, &frame, faces);
        divergence_add(tile, &frame);
    }
    if (watch->swept) watch->swept(watch->data, axis);
}

/* The sides of a tile at which waves leave the domain or come in, and the size of its cells. */
static void rate_place(const struct term_tile *tile)
{
    for (int face = 0; face < 2 * tile->mesh->dim; face++) {
        int axis = face / 2, at = tile->tile->at[axis], end = face % 2 ? tile->level->extent[axis] - 1 : 0;
        tile->terms->faces->open[axis][face % 2] =
            at == end && scene_boundary_is(tile->model->scene, face, SCENE_BOUNDARY_OPEN);
    }
    for (int axis = 0; axis < 3; axis++) tile->terms->faces->per_h[axis] = 1.0 / tile->level->h[axis];
}

void rate_take(struct term_tile *tile, void *const *own, const struct rate_watch *watch, bool masked)
{
    const struct terms *terms = tile->terms;
    tile->masked = masked;
    rate_clear(tile);
    terms->faces->model = tile->model;
    rate_place(tile);
    for (unsigned i = 0; i < terms->n; i++) {
        const struct term *term = terms->at[i];
        tile->own = own[terms->number[i]];
        if (term->begin && terms_acts(term, tile->part)) term->begin(tile);
    }
    for (int axis = 0; axis < tile->mesh->dim; axis++) rate_sweep(tile, own, axis, watch, masked);
    for (unsigned i = 0; i < terms->n; i++) {
        tile->own = own[terms->number[i]];
        if (terms->at[i]->cells && terms_acts(terms->at[i], tile->part)) terms->at[i]->cells(tile);
    }
}

size_t rate_apply(struct term_tile *tile, void *const *own, double *u_new)
{
    const struct terms *terms = tile->terms;
    size_t bounded = 0;
    for (unsigned i = 0; i < terms->n; i++) {
        tile->own = own[terms->number[i]];
        if (terms->at[i]->apply) bounded += terms->at[i]->apply(tile, u_new);
    }
    return bounded;
}

/* Equal values stay: what rests does so under any mean. */
static BULLA_KERNEL void rate_mean(size_t n, double mix, const double *restrict old, double *restrict now)
{
#pragma omp simd
    for (size_t i = 0; i < n; i++) {
        double a = old[i], b = now[i];
        now[i] = a + mix * (b - a);
    }
}

void rate_mix(const struct term_tile *tile, const double *u_old, double mix, double *u_new)
{
    const struct model *model = tile->model;
    if (mix == 1.0) return;
    for (unsigned i = 0; i < model->n_active; i++) {
        size_t at = model->active[i] * tile->n_cell;
        rate_mean(tile->n_cell, mix, u_old + at, u_new + at);
    }
    elastic_settle(model, tile->n_cell, tile->n_cell, u_new);
}
