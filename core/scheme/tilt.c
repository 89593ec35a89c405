/* tilt.c - see tilt.h. */
#include "scheme/tilt.h"

#include "base/mem.h"
#include "phys/bearing.h"
#include "phys/elastic.h"
#include "phys/pick.h"
#include "phys/row.h"

#include <stdint.h>
#include <string.h>

/* Fractions at the edges of a face this many times apart still meet in the middle. */
#define TILT_APART 16.0

/* Work space of frames: rows of their cells, and packed ones of the cells about a surface. */
struct tilt {
    double *solid;            /* fraction of the solids */
    double *stress;           /* [6] deviator, xx first, of the cells `wide`; those that the scene has not are 0 */
    double *m;                /* [n_solid] partial densities, packed as `wide`, as far as they bear */
    double *room;             /* [6] packed */
    double *V;                /* [n_stretched] packed */
    unsigned at[FACE_ROOM];   /* cells that have a normal */
    unsigned wide[FACE_ROOM]; /* and their neighbours along the axis */
};

void *tilt_open(const struct term_room *room)
{
    const struct model *model = room->model;
    if (!model->n_normal) return NULL;
    double *rows;
    struct tilt *tilt =
        mem_new(1, sizeof *tilt + (13 + model->n_solid + model->n_stretched) * FACE_ROOM * sizeof *rows);
    rows = (double *)(tilt + 1);
    tilt->solid = rows;
    tilt->stress = tilt->solid + FACE_ROOM;
    tilt->room = tilt->stress + 6 * FACE_ROOM;
    tilt->m = tilt->room + 6 * FACE_ROOM;
    tilt->V = tilt->m + model->n_solid * FACE_ROOM;
    return tilt;
}

/* Where a cell and both neighbours hold the same nothing meets along this axis: a path of one material says so, too.
 * The outermost layers have no neighbours here. Returns how many of the n cells `at` keep their normal. */
static size_t tilt_forget(const struct model *model, const struct frame *frame, size_t n, const double *solid,
                          double *w, unsigned *at)
{
    size_t step = frame->inner, last = frame_layers(frame) - 1, kept = 0;
    for (size_t k = 0; k < n; k++) {
        size_t i = at[k], layer = i / step % (last + 1);
        double a = solid[i];
        bool whole = a == 0.0 || a == 1.0, inside = layer > 0 && layer < last;
        if (whole && inside && solid[i - step] == a && solid[i + step] == a)
            for (unsigned d = 0; d < model->n_normal; d++) w[(model->i_normal + d) * FACE_ROOM + i] = 0.0;
        else at[kept++] = (unsigned)i;
    }
    return kept;
}

/* The n cells `at` and their neighbours along the axis. Returns how many there are. */
static size_t tilt_widen(const struct frame *frame, size_t n, struct tilt *tilt)
{
    unsigned char mark[FACE_ROOM] = {0};
    size_t step = frame->inner;
    for (size_t k = 0; k < n; k++) {
        size_t i = tilt->at[k];
        mark[i] = 1;
        if (i >= step) mark[i - step] = 1;
        if (i + step < frame->count) mark[i + step] = 1;
    }
    return pick_marked(frame->count, 0, mark, tilt->wide);
}

/* Partial density of solid s in the n cells `wide`, as far as it bears. */
static const double *tilt_mass(const struct model *model, unsigned s, size_t n, const double *w, struct tilt *tilt)
{
    const struct model_solid *solid = &model->solids[s];
    double *m = tilt->m + s * FACE_ROOM, *rho = tilt->room, *D = rho + FACE_ROOM, *left = D + FACE_ROOM;
    memset(m, 0, n * sizeof *m);
    pick_take(n, tilt->wide, w + (model->i_m + solid->material) * FACE_ROOM, rho);
    if (solid->damage.law) {
        pick_take(n, tilt->wide, w + solid->damage.field * FACE_ROOM, D);
        bearing_reduce(n, D, rho, left);
        rho = left;
    }
    pick_take(n, tilt->wide, w + (model->i_alpha + solid->material) * FACE_ROOM, D);
    row_add_product(n, D, rho, m);
    return m;
}

/* Deviator of the n cells `wide`. */
static void tilt_stress(const struct model *model, size_t n, const double *w, struct tilt *tilt)
{
    const double *m[SCENE_MATERIALS];
    for (unsigned s = 0; s < model->n_solid; s++) m[s] = tilt_mass(model, s, n, w, tilt);
    for (unsigned q = 0; q < model->n_stretched; q++)
        pick_take(n, tilt->wide, w + (model->i_V + q) * FACE_ROOM, tilt->V + q * FACE_ROOM);
    elastic_stress(model, n, FACE_ROOM, tilt->V, m, tilt->room);
    for (unsigned c = 0; c < model->n_stretch; c++)
        pick_put(n, tilt->wide, tilt->room + c * FACE_ROOM, tilt->stress + c * FACE_ROOM);
}

/* N.s'N of n cells, with their own normals and the stress of the cells `by` further on. */
static void tilt_on(const struct model *model, size_t n, const unsigned *at, const double *w, const double *stress,
                    ptrdiff_t by, double *ret)
{
    static const double zero[FACE_ROOM];
    const double *normal[3], *s[6];
    for (unsigned d = 0; d < 3; d++) normal[d] = d < model->n_normal ? w + (model->i_normal + d) * FACE_ROOM : zero;
    for (unsigned c = 0; c < 6; c++) s[c] = stress + (ptrdiff_t)(c * FACE_ROOM) + by;
    for (size_t k = 0; k < n; k++) {
        size_t i = at[k];
        double a = normal[0][i], b = normal[1][i], c = normal[2][i];
        double straight = a * a * s[ELASTIC_XX][i] + b * b * s[ELASTIC_YY][i] + c * c * s[ELASTIC_ZZ][i];
        double crossed = a * b * s[ELASTIC_XY][i] + (a * s[ELASTIC_XZ][i] + b * s[ELASTIC_YZ][i]) * c;
        ret[k] = straight + 2.0 * crossed;
    }
}

/* The differences of p: of the cells `next` to those before them. */
static BULLA_KERNEL void tilt_plain(size_t n, const double *restrict next, const double *restrict before,
                                    double *restrict lean)
{
#pragma omp simd
    for (size_t i = 0; i < n; i++) lean[i] = next[i] - before[i];
}

/* The differences at n cells with a normal, of their P to p of the neighbours less the stress there on the same normal,
 * and P itself in place of p. */
static void tilt_lean(const struct model *model, const struct frame *frame, size_t n, const struct tilt *tilt,
                      double *w, double *const *lean)
{
    double held[FACE_ROOM], other[FACE_ROOM], *p = w + model->i_E * FACE_ROOM;
    size_t step = frame->inner, first = 0, end = n;
    while (first < n && tilt->at[first] < step) first++;
    while (end > first && tilt->at[end - 1] >= frame->count - step) end--;
    tilt_on(model, n, tilt->at, w, tilt->stress, 0, held);
    for (int side = 0; side < 2; side++) {
        ptrdiff_t by = side ? (ptrdiff_t)step : -(ptrdiff_t)step;
        tilt_on(model, end - first, tilt->at + first, w, tilt->stress, by, other);
        for (size_t k = first; k < end; k++) {
            double more = held[k] - other[k - first];
            lean[side][tilt->at[k]] -= side ? -more : more;
        }
    }
    for (size_t k = 0; k < n; k++) p[tilt->at[k]] -= held[k];
}

void tilt_frame(const struct term_piece *piece)
{
    const struct model *model = piece->model;
    const struct frame *frame = piece->frame;
    struct tilt *tilt = piece->own;
    double *w = piece->faces->frame, *const *lean = piece->faces->lean;
    const double *p = w + model->i_E * FACE_ROOM;
    size_t n = frame->count, step = frame->inner;
    for (size_t side = 0; side < 2; side++)
        tilt_plain(n - 2 * step, p + (side + 1) * step, p + side * step, lean[side] + step);
    size_t count = pick_nonzero(n, model->n_normal, FACE_ROOM, w + model->i_normal * FACE_ROOM, tilt->at);
    if (!count) return;
    elastic_sum(model, n, FACE_ROOM, w + model->i_alpha * FACE_ROOM, tilt->solid);
    count = tilt_forget(model, frame, count, tilt->solid, w, tilt->at);
    tilt_stress(model, tilt_widen(frame, count, tilt), w, tilt);
    tilt_lean(model, frame, count, tilt, w, lean);
}

void tilt_aim(const struct model *model, const struct frame *frame, const double *cells, double *state,
              struct tilt_aimed *ret)
{
    size_t n = frame_edged(frame), reach = frame_reach(frame);
    const double *normal = cells + model->i_normal * FACE_ROOM + reach;
    for (unsigned q = model->i_normal; q < model->i_normal + model->n_normal; q++)
        for (size_t side = 0; side < 2; side++)
            memcpy(state + 2 * q * FACE_ROOM + side * n, cells + q * FACE_ROOM + reach, n * sizeof *state);
    ret->n = pick_nonzero(n, model->n_normal, FACE_ROOM, normal, ret->at);
}

/* Faces of which one side has a normal: those above and below the cells that have one, of n. Returns how many. */
static size_t tilt_faces(const struct tilt_aimed *aimed, size_t step, size_t n, unsigned *at)
{
    size_t count = 0, above = 0, below = 0;
    const size_t none = SIZE_MAX;
    while (below < aimed->n && aimed->at[below] < step) below++;
    for (;;) {
        size_t up = above < aimed->n && aimed->at[above] < n ? aimed->at[above] : none;
        size_t down = below < aimed->n ? aimed->at[below] - step : none, next = up < down ? up : down;
        if (next == none) return count;
        at[count++] = (unsigned)next;
        above += up == next;
        below += down == next;
    }
}

/* What the fractions at both edges of a face are to be multiplied with: A over each. `left` and `right` hold the
 * fractions. */
static BULLA_KERNEL void tilt_parts(size_t n, double *restrict left, double *restrict right)
{
#pragma omp simd
    for (size_t i = 0; i < n; i++) {
        double a = left[i], b = right[i], least = a < b ? a : b, most = a < b ? b : a;
        double near = TILT_APART * least, cut = near < most ? near / most : 1.0, A = 0.5 * (a + b) * cut;
        double one = A / a, other = A / b;
        int borne = least > 0.0;
        left[i] = borne ? one : 0.0;
        right[i] = borne ? other : 0.0;
    }
}

/* Fractions of the solids at the edges of n faces. */
static void tilt_fractions(const struct model *model, size_t n, const unsigned *at, const double *state, double *ret)
{
    double one[FACE_ROOM];
    memset(ret, 0, n * sizeof *ret);
    for (unsigned s = 0; s < model->n_solid; s++) {
        pick_take(n, at, state + 2 * (model->i_alpha + model->solids[s].material) * FACE_ROOM, one);
        row_add(n, one, ret);
    }
}

/* What faces bear of which no side has a normal: what the edge's own fractions say. */
static BULLA_KERNEL void tilt_leave(size_t n, const double *restrict stress, double *restrict traction)
{
#pragma omp simd
    for (size_t i = 0; i < n; i++) traction[i] -= stress[i];
}

/* Component d of t at an edge, the traction on its normal N without what is along N; and of N. */
struct tilt_slip {
    double t, N;
};

static struct tilt_slip tilt_slip(const struct model *model, const struct tilt_edges *edges, size_t i, unsigned d)
{
    double square = 0.0, N = 0.0;
    for (unsigned e = 0; e < model->n_normal; e++) {
        double n = edges->state[2 * (model->i_normal + e) * FACE_ROOM + i];
        square += n * n;
        if (e == d) N = n;
    }
    double along = square > 0.0 ? edges->mean[i] / square : 0.0;
    return (struct tilt_slip){edges->pull[d][i] - N * along, N};
}

/* How much of t a face takes as it is: all where it lies in the surface. */
static double tilt_alike(double N)
{
    double c = 2.0 * N * N - 1.0;
    return c > 0.0 ? c : 0.0;
}

/* What all of them bear seen from one side, whose n rows begin at `from`; `part`: of the `count` faces `at`. */
static void tilt_bear(const struct model *model, int axis, size_t n, size_t from, size_t count, const unsigned *at,
                      const double *part, const struct tilt_edges *edges)
{
    double borne[FACE_ROOM], *traction = edges->traction + from;
    for (size_t k = 0; k < count; k++) {
        size_t i = from + at[k];
        struct tilt_slip f = tilt_slip(model, edges, i, axis_component(axis, 0));
        double alike = tilt_alike(f.N), slip = alike * 2.0 * f.N * f.t;
        borne[k] = traction[at[k]] - slip - part[k] * (edges->stress[i] - edges->mean[i] - slip);
        for (unsigned d = 0; d + 1 < model->n_velocity; d++) {
            struct tilt_slip g = tilt_slip(model, edges, i, axis_component(axis, d + 1));
            double shear = edges->shear[d][i], slide = alike * (f.N * g.t + g.N * f.t);
            edges->shear[d][i] = slide + part[k] * (shear - slide);
        }
    }
    tilt_leave(n, edges->stress + from, traction);
    pick_put(count, at, borne, traction);
}

void tilt_share(const struct model *model, const struct frame *frame, const struct tilt_edges *edges)
{
    double part[2][FACE_ROOM];
    unsigned at[FACE_ROOM];
    size_t cells = frame_edged(frame), n = cells - frame->inner, right = cells + frame->inner;
    size_t count = tilt_faces(edges->aimed, frame->inner, n, at);
    for (size_t side = 0; side < 2; side++) tilt_fractions(model, count, at, edges->state + side * right, part[side]);
    tilt_parts(count, part[0], part[1]);
    for (size_t side = 0; side < 2; side++)
        tilt_bear(model, frame->axis, n, side * right, count, at, part[side], edges);
}
