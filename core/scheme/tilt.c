/* tilt.c - see tilt.h. */
#include "scheme/tilt.h"

#include "base/mem.h"
#include "phys/bearing.h"
#include "phys/elastic.h"
#include "phys/row.h"
#include "phys/traction.h"

#include <string.h>

/* Fractions at the edges of a face this many times apart still meet in the middle. */
#define TILT_APART 16.0

/* Rows of frames. */
struct tilt {
    double *stress; /* [6] deviator of the cells, xx first; those that the scene has not are 0 */
    double *m;      /* [n_solid] partial densities */
    double *bears;  /* the same of solids that can break, as far as they bear; NULL without any */
    double *mean;   /* N.s'N of the cells */
    double *zero;
};

void *tilt_open(const struct term_room *room)
{
    const struct model *model = room->model;
    if (!model->n_normal) return NULL;
    size_t solids = model->n_solid, bears = model->damaged ? solids : 0, rest = 6 + solids + bears;
    double *rows;
    struct tilt *tilt = mem_new(1, sizeof *tilt + (rest + 2) * FACE_ROOM * sizeof *rows);
    rows = (double *)(tilt + 1);
    *tilt = (struct tilt){.stress = rows,
                          .m = rows + 6 * FACE_ROOM,
                          .bears = bears ? rows + (6 + solids) * FACE_ROOM : NULL,
                          .mean = rows + rest * FACE_ROOM,
                          .zero = rows + (rest + 1) * FACE_ROOM};
    return tilt;
}

/* Has any cell a normal? */
static bool tilt_any(const struct model *model, size_t n, const double *w)
{
    double sum = 0.0;
    for (unsigned d = 0; d < model->n_normal; d++) {
        const double *normal = w + (model->i_normal + d) * FACE_ROOM;
        for (size_t i = 0; i < n; i++) sum += normal[i] * normal[i];
    }
    return sum > 0.0;
}

/* A run of cells: 0 where a cell and both neighbours hold the same. */
static void tilt_alone(size_t n, size_t step, const double *solid, double *normal)
{
    const double *before = solid - step, *behind = solid + step;
    for (size_t i = 0; i < n; i++) {
        double a = solid[i], old = normal[i];
        int alone = (a == 0.0) | (a == 1.0), same = (before[i] == a) & (behind[i] == a);
        normal[i] = alone & same ? 0.0 : old;
    }
}

/* Where a cell and both neighbours hold the same nothing meets along this axis: a path of one material says so, too.
 * The outermost layers have no neighbours here. */
static void tilt_forget(const struct model *model, const struct frame *frame, const double *solid, double *w)
{
    size_t run = (frame_layers(frame) - 2) * frame->inner;
    for (unsigned d = 0; d < model->n_normal; d++)
        for (size_t o = 0; o < frame->outer; o++) {
            size_t at = o * frame_layers(frame) * frame->inner + frame->inner;
            tilt_alone(run, frame->inner, solid + at, w + (model->i_normal + d) * FACE_ROOM + at);
        }
}

static void tilt_stress(const struct model *model, size_t n, const double *w, struct tilt *tilt)
{
    const double *m[SCENE_MATERIALS];
    for (unsigned s = 0; s < model->n_solid; s++) {
        unsigned l = model->solids[s].material;
        double *partial = tilt->m + s * FACE_ROOM;
        memset(partial, 0, n * sizeof *partial);
        row_add_product(n, w + (model->i_alpha + l) * FACE_ROOM, w + (model->i_m + l) * FACE_ROOM, partial);
        m[s] = partial;
    }
    bearing_of(model, n, FACE_ROOM, w, FACE_ROOM, tilt->bears, m);
    elastic_stress(model, n, FACE_ROOM, w + model->i_V * FACE_ROOM, m, tilt->stress);
}

/* Stress of the cells on the normals of others. */
struct tilt_lean {
    const double *normal[3], *stress[6], *mean, *p;
};

/* P of cells `to` less p of cells `from` and more their stress on the same normals, or the other way round (sign
 * -1). */
static BULLA_KERNEL void tilt_lean(size_t n, double sign, const struct tilt_lean *to, const struct tilt_lean *from,
                                   double *restrict lean)
{
    const double *restrict x = to->normal[0], *restrict y = to->normal[1], *restrict z = to->normal[2];
    const double *restrict xx = from->stress[ELASTIC_XX], *restrict yy = from->stress[ELASTIC_YY],
                           *restrict zz = from->stress[ELASTIC_ZZ], *restrict xy = from->stress[ELASTIC_XY],
                           *restrict xz = from->stress[ELASTIC_XZ], *restrict yz = from->stress[ELASTIC_YZ];
    const double *restrict mean = to->mean, *restrict p = to->p, *restrict other = from->p;
#pragma omp simd
    for (size_t i = 0; i < n; i++) {
        double a = x[i], b = y[i], c = z[i], held = mean[i], step = p[i] - other[i];
        double straight = a * a * xx[i] + b * b * yy[i] + c * c * zz[i];
        double crossed = a * b * xy[i] + (a * xz[i] + b * yz[i]) * c;
        lean[i] = sign * (step - (held - (straight + 2.0 * crossed)));
    }
}

/* Rows from cell `at` on. */
static struct tilt_lean tilt_rows(const struct model *model, const struct tilt *tilt, const double *w, size_t at)
{
    struct tilt_lean rows = {.mean = tilt->mean + at, .p = w + model->i_E * FACE_ROOM + at};
    for (unsigned d = 0; d < 3; d++)
        rows.normal[d] = (d < model->n_normal ? w + (model->i_normal + d) * FACE_ROOM : tilt->zero) + at;
    for (unsigned c = 0; c < 6; c++)
        rows.stress[c] = (c < model->n_stretch ? tilt->stress + c * FACE_ROOM : tilt->zero) + at;
    return rows;
}

/* The differences where nothing has a normal. */
static void tilt_plain(size_t n, size_t step, const double *p, double *const *lean)
{
    for (int side = 0; side < 2; side++) {
        const double *one = side ? p : p - step, *next = one + step;
        for (size_t i = 0; i < n; i++) lean[side][step + i] = next[i] - one[i];
    }
}

void tilt_frame(const struct term_piece *piece)
{
    const struct model *model = piece->model;
    const struct frame *frame = piece->frame;
    struct tilt *tilt = piece->own;
    double *w = piece->faces->frame, *const *lean = piece->faces->lean;
    size_t n = frame->count, step = frame->inner, inside = n - 2 * step;
    elastic_sum(model, n, FACE_ROOM, w + model->i_alpha * FACE_ROOM, tilt->mean);
    tilt_forget(model, frame, tilt->mean, w);
    if (!tilt_any(model, n, w)) {
        tilt_plain(inside, step, w + model->i_E * FACE_ROOM + step, lean);
        return;
    }
    traction_mean(model, n, FACE_ROOM, w, tilt->mean);
    tilt_stress(model, n, w, tilt);
    const struct tilt_lean below = tilt_rows(model, tilt, w, 0), here = tilt_rows(model, tilt, w, step),
                           above = tilt_rows(model, tilt, w, 2 * step);
    tilt_lean(inside, 1.0, &here, &below, lean[0] + step);
    tilt_lean(inside, -1.0, &here, &above, lean[1] + step);
    row_take(n, tilt->mean, w + model->i_E * FACE_ROOM);
}

void tilt_aim(const struct model *model, const struct frame *frame, const double *cells, double *state)
{
    size_t n = frame_edged(frame), reach = frame_reach(frame);
    for (unsigned q = model->i_normal; q < model->i_normal + model->n_normal; q++)
        for (size_t side = 0; side < 2; side++)
            memcpy(state + 2 * q * FACE_ROOM + side * n, cells + q * FACE_ROOM + reach, n * sizeof *state);
}

/* 1 where one of the two sides of a face has a normal. */
static void tilt_meets(const struct model *model, size_t n, size_t right, const double *state, double *meets)
{
    memset(meets, 0, n * sizeof *meets);
    for (unsigned q = model->i_normal; q < model->i_normal + model->n_normal; q++) {
        const double *a = state + 2 * q * FACE_ROOM, *b = a + right;
        for (size_t i = 0; i < n; i++) meets[i] = (a[i] != 0.0) | (b[i] != 0.0) ? 1.0 : meets[i];
    }
}

/* What the fractions at both edges of a face are to be multiplied with: A over each. `left` and `right` hold the
 * fractions. */
static BULLA_KERNEL void tilt_parts(size_t n, const double *restrict meets, double *restrict left,
                                    double *restrict right)
{
#pragma omp simd
    for (size_t i = 0; i < n; i++) {
        double a = left[i], b = right[i], m = meets[i], least = a < b ? a : b, most = a < b ? b : a;
        double near = TILT_APART * least, cut = near < most ? near / most : 1.0, A = 0.5 * (a + b) * cut;
        double one = A / a, other = A / b;
        int borne = least > 0.0;
        one = borne ? one : 0.0;
        other = borne ? other : 0.0;
        left[i] = m > 0.0 ? one : 1.0;
        right[i] = m > 0.0 ? other : 1.0;
    }
}

static BULLA_KERNEL void tilt_bear(size_t n, const double *restrict part, const double *restrict stress,
                                   const double *restrict mean, double *restrict traction)
{
#pragma omp simd
    for (size_t i = 0; i < n; i++) traction[i] -= part[i] * (stress[i] - mean[i]);
}

static BULLA_KERNEL void tilt_scale(size_t n, const double *restrict part, double *restrict shear)
{
#pragma omp simd
    for (size_t i = 0; i < n; i++) shear[i] *= part[i];
}

void tilt_share(const struct model *model, const struct frame *frame, const struct tilt_edges *edges)
{
    double part[2 * FACE_ROOM], meets[FACE_ROOM];
    size_t cells = frame_edged(frame), n = cells - frame->inner, right = cells + frame->inner;
    elastic_sum(model, 2 * cells, 2 * FACE_ROOM, edges->state + 2 * model->i_alpha * FACE_ROOM, part);
    tilt_meets(model, n, right, edges->state, meets);
    tilt_parts(n, meets, part, part + right);
    for (size_t from = 0, side = 0; side < 2; side++, from = right) {
        tilt_bear(n, part + from, edges->stress + from, edges->mean + from, edges->traction + from);
        for (unsigned k = 0; k + 1 < model->n_velocity; k++) tilt_scale(n, part + from, edges->shear[k] + from);
    }
}
