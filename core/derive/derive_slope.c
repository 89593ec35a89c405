/* derive_slope.c - see derive_slope.h. Central differences over gathered frames, boundaries included. */
#include "derive/derive_slope.h"

#include "base/mem.h"
#include "levels/prolong.h"
#include "mesh/metric.h"
#include "scheme/bound.h"

#include <math.h>
#include <string.h>

/* Layers behind the domain's boundary. Of the start of the run nothing is known here: where a boundary refers to it the
 * value inside goes on. */
static void derive_slope_behind(void *data, unsigned local, const struct frame *frame, int side, size_t pitch,
                                double *w)
{
    const struct bound *bound = data;
    const struct model *model = bound->model;
    if (!scene_boundary_is(model->scene, 2 * frame->axis + side, SCENE_BOUNDARY_REFERS)) {
        bound_fill(data, local, frame, side, pitch, w);
        return;
    }
    for (unsigned i = 0; i < model->n_active; i++)
        bound_copy(NULL, local, frame, side, pitch, w + model->active[i] * pitch);
}

void derive_slope_gather(const struct derive_view *tile, const struct frame *frame, size_t pitch, double *w)
{
    const struct model *model = tile->model;
    struct bound bound = {.model = model, .mesh = tile->mesh, .level = tile->level, .t = tile->t};
    const struct frame_source source = {.mesh = tile->mesh,
                                        .level = tile->level,
                                        .arrays = tile->level->w,
                                        .halo = tile->level->halo,
                                        .link = tile->level->link,
                                        .n_field = model->n_active,
                                        .fields = model->active,
                                        .boundary = derive_slope_behind,
                                        .data = &bound};
    frame_gather(&source, tile->local, frame, pitch, w);
}

/* A primitive at one place of a gathered piece, or the density (DERIVE_SLOPE_RHO). */
static double derive_slope_at(const struct model *model, const double *w, int q)
{
    double rho = 0.0;
    if (q != DERIVE_SLOPE_RHO) return w[(size_t)q * FRAME_CELLS];
    for (unsigned l = 0; l < model->n_material; l++)
        rho += (model->n_alpha ? w[(model->i_alpha + l) * FRAME_CELLS] : 1.0) * w[(model->i_m + l) * FRAME_CELLS];
    return rho;
}

/* Of one of them, in the cells of the piece. */
static void derive_slope_piece(const struct derive_view *tile, const struct frame *frame, const double *w, int q,
                               double *grad)
{
    for (size_t o = 0; o < frame->outer; o++)
        for (size_t i = 0; i < frame->n; i++)
            for (size_t j = 0; j < frame->inner; j++) {
                size_t at = frame_at(frame, o, (int)i) + j;
                double up = derive_slope_at(tile->model, w + at + frame->inner, q);
                double down = derive_slope_at(tile->model, w + at - frame->inner, q);
                grad[frame_tile_at(frame, o, i) + j] = (up - down) / (2.0 * tile->level->h[frame->axis]);
            }
}

void derive_slope_rows(const struct derive_view *tile, int axis, unsigned n, const int *q, double *const *grad)
{
    double *w = mem_new((size_t)tile->model->n_field * FRAME_CELLS, sizeof *w);
    for (size_t piece = 0; piece < frame_pieces(tile->mesh, axis); piece++) {
        struct frame frame = frame_piece(tile->mesh, axis, piece);
        derive_slope_gather(tile, &frame, FRAME_CELLS, w);
        for (unsigned k = 0; k < n; k++) derive_slope_piece(tile, &frame, w, q[k], grad[k]);
    }
    mem_free(w);
}

/* What turns by u_th around the axis has u_th/r more of it along the axis, with the sign of -du_th/dr. */
static void derive_slope_whirl(const struct derive_view *tile, double *out)
{
    const struct level *level = tile->level;
    const double *w = derive_view_w(tile, tile->model->i_u + 2);
    struct metric metric;
    metric_of_tile(tile->mesh, level, &level->tiles[level->first + tile->local], &metric);
    for (size_t i = 0; i < tile->n; i++) out[tile->n + i] -= w[i] / metric.centre[i % (size_t)tile->mesh->n[0]];
}

void derive_slope_vorticity(const struct derive_view *tile, double *out)
{
    int dim = tile->mesh->dim;
    double *slope = mem_new(tile->n, sizeof *slope);
    memset(out, 0, 3 * tile->n * sizeof *out);
    for (int axis = 0; axis < dim; axis++)
        for (int of = 0; of < (int)tile->model->n_velocity; of++) {
            if (of == axis) continue;
            int component = 3 - axis - of;
            double sign = (axis + 1) % 3 == of ? 1.0 : -1.0;
            derive_slope_rows(tile, axis, 1, (const int[]){(int)tile->model->i_u + of}, &slope);
            for (size_t i = 0; i < tile->n; i++) out[(size_t)component * tile->n + i] += sign * slope[i];
        }
    if (model_turns(tile->model)) derive_slope_whirl(tile, out);
    mem_free(slope);
}

static void derive_slope_density(const struct derive_view *tile, double *out)
{
    double *slope = mem_new(tile->n, sizeof *slope);
    memset(out, 0, tile->n * sizeof *out);
    for (int axis = 0; axis < tile->mesh->dim; axis++) {
        derive_slope_rows(tile, axis, 1, (const int[]){DERIVE_SLOPE_RHO}, &slope);
        for (size_t i = 0; i < tile->n; i++) out[i] += slope[i] * slope[i];
    }
    for (size_t i = 0; i < tile->n; i++) out[i] = sqrt(out[i]);
    mem_free(slope);
}

void derive_slope_schlieren(const struct derive_view *tile, double *out)
{
    derive_slope_density(tile, out);
    for (size_t i = 0; i < tile->n; i++)
        out[i] = tile->field->scale > 0.0 ? exp(-200.0 * out[i] / tile->field->scale) : 1.0;
}

/* |alpha_b grad alpha_a - alpha_a grad alpha_b|^2 of a pair; a, b: work space [n]. */
static void derive_slope_pair(const struct derive_view *tile, const struct model_pair *pair, double *a, double *b,
                              double *square)
{
    memset(square, 0, tile->n * sizeof *square);
    for (int axis = 0; axis < tile->mesh->dim; axis++) {
        derive_slope_rows(tile, axis, 2,
                          (const int[]){(int)(tile->model->i_alpha + pair->inside),
                                        (int)(tile->model->i_alpha + pair->outside)},
                          (double *const[]){a, b});
        for (size_t i = 0; i < tile->n; i++) {
            double g =
                derive_view_alpha(tile, pair->outside, i) * a[i] - derive_view_alpha(tile, pair->inside, i) * b[i];
            square[i] += g * g;
        }
    }
}

void derive_slope_surface(const struct derive_view *tile, double *out)
{
    double *work = mem_new(3 * tile->n, sizeof *work), *square = work + 2 * tile->n;
    memset(out, 0, tile->n * sizeof *out);
    for (unsigned k = 0; k < tile->model->n_pair; k++) {
        const struct model_pair *pair = &tile->model->pairs[k];
        derive_slope_pair(tile, pair, work, work + tile->n, square);
        for (size_t i = 0; i < tile->n; i++) out[i] += pair->sigma * sqrt(square[i]);
    }
    mem_free(work);
}

void derive_slope_exchange(const struct model *model, const struct mesh *mesh, int base, double t)
{
    struct prolong *prolong = prolong_new(model, mesh);
    for (int l = base; l < mesh->n_level; l++) {
        halo_start(mesh->levels[l].halo, mesh->levels[l].w);
        halo_finish(mesh->levels[l].halo);
        if (l + 1 == mesh->n_level) break;
        struct link *link = mesh->levels[l + 1].link;
        struct bound *bound = bound_new(model, mesh, &mesh->levels[l]);
        bound->t = t;
        prolong_strips(prolong, mesh, l, bound, 0);
        bound_free(bound);
        link_down(link);
        link->theta = 0.0;
    }
    prolong_free(prolong);
}

void derive_slope_steepest(const struct derive_view *tile, double *gradient, double *scale)
{
    const struct tile *here = &tile->level->tiles[tile->level->first + tile->local];
    derive_slope_density(tile, gradient);
    for (size_t i = 0; i < tile->n; i++)
        if (gradient[i] > *scale && !(here->covered >> mesh_octant(tile->mesh, i) & 1)) *scale = gradient[i];
}
