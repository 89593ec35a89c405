/* calm.c - see calm.h. Differences of pressure along each axis are taken once for a tile and the layer around it; faces
 * look their two cells up there. */
#include "scheme/calm.h"

#include "base/mem.h"
#include "scheme/patch.h"

#include <math.h>

#define CALM_LEAST 0.3
#define CALM_MOST 0.6

/* Of one rank. */
struct calm {
    double *difference[3]; /* [cells of the patch] |p of the next cell - p of the one before| along each axis */
    double *share;         /* [FACE_ROOM] s of the faces of a piece */
    struct box_block block;
    size_t stride[3];
    bool any; /* is there a steep one? */
};

static bool calm_wanted(const struct model *path)
{
    return path->calm && path->dim > 1 && path->n_solid < path->n_material;
}

static void *calm_open(const struct term_room *room)
{
    struct calm *calm = mem_new(1, sizeof *calm);
    size_t stride = 1;
    calm->block = rim_block(room->mesh, 1, NULL);
    calm->share = mem_new(FACE_ROOM, sizeof *calm->share);
    for (int d = 0; d < room->mesh->dim; d++) {
        calm->difference[d] = mem_new(calm->block.pitch, sizeof(double));
        calm->stride[d] = stride;
        stride *= calm->block.size[d];
    }
    return calm;
}

static void calm_close(void *own)
{
    struct calm *calm = own;
    for (int d = 0; d < 3; d++) mem_free(calm->difference[d]);
    mem_free(calm->share);
    mem_free(calm);
}

/* A difference of less than CALM_LEAST of the lesser pressure is none: rho c^2 is no less than p, and tiles that have
 * no more are done. Cells at the ends of a line take neighbours of other lines: nobody asks for them. Returns the
 * sum. */
static BULLA_KERNEL double calm_differ(size_t n, size_t stride, const double *restrict p, double *restrict difference)
{
    double sum = 0.0;
#pragma omp simd reduction(+ : sum)
    for (size_t i = stride; i < n - stride; i++) {
        double a = p[i - stride], b = p[i + stride], least = a < b ? a : b, apart = fabs(b - a);
        double steep = apart > CALM_LEAST * least ? apart : 0.0;
        difference[i] = steep;
        sum += steep;
    }
    return sum;
}

/* Pressure is the last that the scene looks at around its tiles. */
static void calm_begin(struct term_tile *tile)
{
    struct calm *calm = tile->own;
    size_t n = calm->block.pitch;
    const double *p = tile->around + (tile->model->n_around - 1) * n;
    calm->any = false;
    for (int d = 0; d < tile->mesh->dim; d++)
        if (calm_differ(n, calm->stride[d], p, calm->difference[d]) > 0.0) calm->any = true;
}

/* The largest difference along the axes that a face lies in, of the cell `at` of the patch and the next one. */
static inline double calm_steepest(const struct calm *calm, int dim, int axis, size_t at)
{
    double most = 0.0;
    for (int d = 0; d < dim; d++) {
        if (d == axis) continue;
        double below = calm->difference[d][at], above = calm->difference[d][at + calm->stride[axis]];
        most = below > most ? below : most;
        most = above > most ? above : most;
    }
    return most;
}

/* Where cell c (outer o, axis i, then inner) of a piece lies in the patch; i may be -1. */
static inline size_t calm_place(const struct calm *calm, const struct term_piece *piece, size_t o, int i, size_t c)
{
    const struct frame *frame = piece->frame;
    const int *n = piece->tile->mesh->n;
    size_t inner = frame->inner_from + c, outer = frame->outer_from + o;
    int at[3] = {0, 0, 0};
    at[frame->axis] = i;
    if (frame->axis == 0) {
        at[1] = (int)(outer % (size_t)n[1]);
        at[2] = (int)(outer / (size_t)n[1]);
    } else if (frame->axis == 1) {
        at[0] = (int)inner;
        at[2] = (int)outer;
    } else {
        at[0] = (int)(inner % (size_t)n[0]);
        at[1] = (int)(inner / (size_t)n[0]);
    }
    return box_at(&calm->block, at[0], at[1], at[2]);
}

/* The differences beside the faces of a piece, in rows of faces; 0 between the lines. */
static void calm_gather(struct calm *calm, const struct term_piece *piece)
{
    const struct frame *frame = piece->frame;
    int dim = piece->tile->mesh->dim;
    for (size_t k = 0; k < frame_edged(frame); k++) calm->share[k] = 0.0;
    for (size_t o = 0; o < frame->outer; o++)
        for (size_t i = 0; i <= frame->n; i++)
            for (size_t c = 0; c < frame->inner; c++)
                calm->share[face_at(frame, o, i) + c] =
                    calm_steepest(calm, dim, frame->axis, calm_place(calm, piece, o, (int)i - 1, c));
}

/* From differences of pressure to s D min(rho). */
static BULLA_KERNEL void calm_resist(size_t n, const struct bulla_faces *faces, double *restrict share)
{
    const double *restrict rho_l = faces->left.rho, *restrict rho_r = faces->right.rho;
    const double *restrict u_l = faces->left.u[0], *restrict u_r = faces->right.u[0];
    const double *restrict c_l = faces->left.c, *restrict c_r = faces->right.c;
#pragma omp simd
    for (size_t i = 0; i < n; i++) {
        double a = rho_l[i], b = rho_r[i], u = u_l[i], v = u_r[i], c = c_l[i], d = c_r[i];
        double stiff_l = a * c * c, stiff_r = b * d * d, stiff = stiff_l < stiff_r ? stiff_l : stiff_r;
        double steep = (share[i] / stiff - CALM_LEAST) * (1.0 / (CALM_MOST - CALM_LEAST));
        double low = u - c < v - d ? u - c : v - d, high = u + c > v + d ? u + c : v + d;
        double below = low < 0.0 ? low : 0.0, above = high > 0.0 ? high : 0.0;
        double part = steep < 0.0 ? 0.0 : steep, all = part > 1.0 ? 1.0 : part;
        share[i] = all * (-below * above / (above - below)) * (a < b ? a : b);
    }
}

static BULLA_KERNEL void calm_shear(size_t n, const double *restrict resist, const double *restrict left,
                                    const double *restrict right, double *restrict momentum, double *restrict energy)
{
#pragma omp simd
    for (size_t i = 0; i < n; i++) {
        double a = left[i], b = right[i], tau = resist[i] * (b - a), m = momentum[i], e = energy[i];
        momentum[i] = m - tau;
        energy[i] = e - tau * (0.5 * (a + b));
    }
}

/* Faces of cells that hold some of a solid resist nothing; alpha: of the cells, those before the faces first. */
static BULLA_KERNEL void calm_let(size_t n, size_t step, const double *restrict alpha, double *restrict share)
{
    const double *next = alpha + step;
#pragma omp simd
    for (size_t i = 0; i < n; i++) {
        double own = share[i];
        share[i] = alpha[i] + next[i] > 0.0 ? 0.0 : own;
    }
}

static void calm_faces(const struct term_piece *piece)
{
    const struct model *path = piece->model;
    const struct frame *frame = piece->frame;
    struct calm *calm = piece->own;
    struct face_work *work = piece->faces;
    const struct bulla_faces *faces = &work->faces;
    if (!calm->any) return;
    calm_gather(calm, piece);
    calm_resist(faces->n, faces, calm->share);
    for (unsigned s = 0; s < path->n_solid; s++)
        calm_let(faces->n, frame->inner,
                 work->frame + (path->i_alpha + path->solids[s].material) * FACE_ROOM + frame_reach(frame),
                 calm->share);
    for (unsigned k = 1; k < path->n_velocity; k++)
        calm_shear(faces->n, calm->share, faces->left.u[k], faces->right.u[k], work->momentum + k * FACE_ROOM,
                   work->energy);
}

static void calm_say(const struct scene *scene, struct text *text)
{
    (void)scene;
    text_add(text, ": beside strong shocks");
}

const struct term calm_term = {
    .name = "shock fronts",
    .owner = "core/scheme/calm.c",
    .equation = "d(rho u_t)/dt += div tau beside shocks, tau = s D rho (u_tR - u_tL); its work is heat",
    .wanted = calm_wanted,
    .open = calm_open,
    .close = calm_close,
    .begin = calm_begin,
    .faces = calm_faces,
    .say = calm_say,
};
