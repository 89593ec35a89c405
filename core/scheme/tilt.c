/* tilt.c - see tilt.h. */
#include "scheme/tilt.h"

#include "base/mem.h"
#include "phys/bearing.h"
#include "phys/elastic.h"
#include "phys/elastic_tensor.h"
#include "phys/pick.h"
#include "phys/row.h"

#include <stdint.h>
#include <string.h>

/* Fractions at the edges of a face this many times apart still meet in the middle. */
#define TILT_APART 16.0

/* Work space of frames: rows of their cells, and packed ones of the cells about a surface. */
struct tilt {
    double *solid;             /* fraction of the solids */
    double *stress;            /* [n_stretch] deviator, xx first, packed as `wide` */
    double *room;              /* [3] packed as `wide` */
    double *m;                 /* [n_solid] partial densities, packed as `wide`, as far as they bear */
    double *V;                 /* [n_stretched] packed as `wide` */
    unsigned at[FACE_ROOM];    /* cells that have a normal */
    unsigned wide[FACE_ROOM];  /* and their neighbours along the axis */
    unsigned place[FACE_ROOM]; /* of a cell that is one of them, among them */
};

void *tilt_open(const struct term_room *room)
{
    const struct model *model = room->model;
    if (!model->n_normal) return NULL;
    double *rows;
    struct tilt *tilt =
        mem_new(1, sizeof *tilt + (10 + model->n_solid + model->n_stretched) * FACE_ROOM * sizeof *rows);
    rows = (double *)(tilt + 1);
    tilt->solid = rows;
    tilt->stress = tilt->solid + FACE_ROOM;
    tilt->room = tilt->stress + 6 * FACE_ROOM;
    tilt->m = tilt->room + 3 * FACE_ROOM;
    tilt->V = tilt->m + model->n_solid * FACE_ROOM;
    return tilt;
}

/* Fraction of the solids: of one its own row. */
static const double *tilt_solid(const struct model *model, size_t n, const double *w, struct tilt *tilt)
{
    const double *alpha = w + model->i_alpha * FACE_ROOM;
    if (model->n_solid == 1) return alpha + model->solids[0].material * FACE_ROOM;
    elastic_sum(model, n, FACE_ROOM, alpha, tilt->solid);
    return tilt->solid;
}

/* Does cell i have neighbours along the axis in its slice? */
static bool tilt_is_inside(const struct frame *frame, size_t i)
{
    size_t layers = frame_layers(frame), layer = i / frame->inner % layers;
    return layer > 0 && layer < layers - 1;
}

/* Where a cell and both neighbours hold the same nothing meets along this axis: a path of one material says so, too.
 * The outermost layers have no neighbours here. Returns how many of the n cells `at` keep their normal. */
static size_t tilt_forget(const struct model *model, const struct frame *frame, size_t n, const double *solid,
                          double *w, unsigned *at)
{
    size_t step = frame->inner, kept = 0;
    for (size_t k = 0; k < n; k++) {
        size_t i = at[k];
        double a = solid[i];
        bool whole = a == 0.0 || a == 1.0, between = i >= step && i + step < frame->count;
        if (whole && between && solid[i - step] == a && solid[i + step] == a && tilt_is_inside(frame, i))
            for (unsigned d = 0; d < model->n_normal; d++) w[(model->i_normal + d) * FACE_ROOM + i] = 0.0;
        else at[kept++] = (unsigned)i;
    }
    return kept;
}

/* Those of the n cells `at` that have edges, and their normals. */
static void tilt_aim(const struct model *model, const struct frame *frame, size_t n, const double *w,
                     const unsigned *at, struct tilt_aimed *ret)
{
    size_t reach = frame_reach(frame), edged = frame_edged(frame);
    ret->n = 0;
    for (size_t k = 0; k < n; k++) {
        if (at[k] < reach || at[k] - reach >= edged) continue;
        ret->at[ret->n++] = (unsigned)(at[k] - reach);
    }
    pick_take_rows(ret->n, ret->at, model->n_normal, FACE_ROOM, w + model->i_normal * FACE_ROOM + reach, FACE_ROOM,
                   ret->normal);
    for (unsigned d = 0; d < 3; d++) ret->normal[d * FACE_ROOM + ret->n] = 0.0;
}

/* The n cells `at` and their neighbours along the axis. Returns how many there are. */
static size_t tilt_widen(const struct frame *frame, size_t n, struct tilt *tilt)
{
    unsigned char room[3 * FACE_ROOM], *mark = room + FACE_ROOM; /* neighbours may lie outside */
    size_t step = frame->inner;
    memset(mark - step, 0, frame->count + 2 * step);
    for (size_t k = 0; k < n; k++) {
        unsigned char *here = mark + tilt->at[k];
        here[0] = 1;
        *(here - step) = 1;
        here[step] = 1;
    }
    n = pick_marked(frame->count, 0, mark, tilt->wide);
    for (size_t k = 0; k < n; k++) tilt->place[tilt->wide[k]] = (unsigned)k;
    return n;
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
    pick_take_rows(n, tilt->wide, model->n_stretched, FACE_ROOM, w + model->i_V * FACE_ROOM, FACE_ROOM, tilt->V);
    elastic_stress(model, n, FACE_ROOM, tilt->V, m, tilt->stress);
}

/* The differences of p: of the cells `next` to those before them. */
static BULLA_KERNEL void tilt_plain(size_t n, const double *restrict next, const double *restrict before,
                                    double *restrict lean)
{
#pragma omp simd
    for (size_t i = 0; i < n; i++) lean[i] = next[i] - before[i];
}

/* What a stress has on a normal: a sum of its components, that of xy and so on with twice the weight. */
struct tilt_weights {
    double xx, yy, zz, xy, x, y, z; /* products of N with itself; and N */
};

static inline struct tilt_weights tilt_weights(double x, double y, double z)
{
    return (struct tilt_weights){x * x, y * y, z * z, x * y, x, y, z};
}

static inline double tilt_on(bool plane, struct tilt_weights N, const struct elastic_rows *s, size_t i)
{
    double straight = N.xx * s->row[0][i] + N.yy * s->row[1][i], crossed = N.xy * s->row[3][i];
    if (plane) return straight + 2.0 * crossed;
    return straight + N.zz * s->row[2][i] + 2.0 * (crossed + (N.x * s->row[4][i] + N.y * s->row[5][i]) * N.z);
}

/* A frame and where the differences of its P go. */
struct tilt_slope {
    const double *normal[3];
    struct elastic_rows stress; /* packed as `wide` */
    double *p, *below, *above;
    size_t step, last; /* cells to the neighbour along the axis; first cell without one behind it */
};

/* The differences at n cells with a normal, of their P to p of the neighbours less the stress there on the same normal,
 * and P itself in place of p. */
static inline void tilt_lean(bool plane, const struct tilt *tilt, const struct tilt_slope *to, size_t n)
{
    for (size_t k = 0; k < n; k++) {
        size_t i = tilt->at[k];
        struct tilt_weights N = tilt_weights(to->normal[0][i], to->normal[1][i], plane ? 0.0 : to->normal[2][i]);
        double held = tilt_on(plane, N, &to->stress, tilt->place[i]);
        bool inside = i >= to->step && i < to->last;
        if (inside) to->below[i] -= held - tilt_on(plane, N, &to->stress, tilt->place[i - to->step]);
        if (inside) to->above[i] += held - tilt_on(plane, N, &to->stress, tilt->place[i + to->step]);
        to->p[i] -= held;
    }
}

static void tilt_slopes(const struct model *model, const struct frame *frame, size_t n, const struct tilt *tilt,
                        double *w, double *const *lean)
{
    struct tilt_slope to = {.stress = elastic_tensor_rows(tilt->stress, FACE_ROOM, model->n_stretch),
                            .p = w + model->i_E * FACE_ROOM,
                            .below = lean[0],
                            .above = lean[1],
                            .step = frame->inner,
                            .last = frame->count - frame->inner};
    for (unsigned d = 0; d < 3; d++) to.normal[d] = w + (model->i_normal + d % model->n_normal) * FACE_ROOM;
    if (model->n_normal < 3) tilt_lean(true, tilt, &to, n);
    else tilt_lean(false, tilt, &to, n);
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
    count = tilt_forget(model, frame, count, tilt_solid(model, n, w, tilt), w, tilt->at);
    tilt_aim(model, frame, count, w, tilt->at, piece->faces->aimed);
    if (!count) return;
    tilt_stress(model, tilt_widen(frame, count, tilt), w, tilt);
    tilt_slopes(model, frame, count, tilt, w, lean);
}

/* Faces of which one side has a normal. */
struct tilt_faces {
    size_t n;
    unsigned at[FACE_ROOM];
    unsigned of[2][FACE_ROOM]; /* which of the cells that have one lies below, and above; their number: none */
};

/* Those above and below the cells that have one, of n. */
static void tilt_faces(const struct tilt_aimed *aimed, size_t step, size_t n, struct tilt_faces *ret)
{
    size_t above = 0, below = 0;
    const size_t none = SIZE_MAX;
    ret->n = 0;
    while (below < aimed->n && aimed->at[below] < step) below++;
    for (;;) {
        size_t up = above < aimed->n && aimed->at[above] < n ? aimed->at[above] : none;
        size_t down = below < aimed->n ? aimed->at[below] - step : none, next = up < down ? up : down;
        if (next == none) return;
        ret->at[ret->n] = (unsigned)next;
        ret->of[0][ret->n] = (unsigned)(up == next ? above : aimed->n);
        ret->of[1][ret->n++] = (unsigned)(down == next ? below : aimed->n);
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

/* What of t, the traction on a normal N without what is along N, the faces of axis f take as it is: c 2 N_f t_f and
 * c (N_f t_g + N_g t_f), c = 1 where they lie in the surface. Packed as the cells that have a normal, with a 0 more. */
struct tilt_slip {
    double along[FACE_ROOM], alike[FACE_ROOM], t[FACE_ROOM]; /* mean/N^2, c, t_f */
    double straight[FACE_ROOM], across[2][FACE_ROOM];
};

static BULLA_KERNEL void tilt_slip_straight(size_t n, const double *restrict normal, const double *restrict N,
                                            const double *restrict mean, const double *restrict pull,
                                            struct tilt_slip *ret)
{
    const double *restrict nx = normal, *restrict ny = normal + FACE_ROOM, *restrict nz = ny + FACE_ROOM;
    double *restrict along = ret->along, *restrict alike = ret->alike, *restrict t = ret->t;
    double *restrict straight = ret->straight;
#pragma omp simd
    for (size_t i = 0; i < n; i++) {
        double square = nx[i] * nx[i] + ny[i] * ny[i] + nz[i] * nz[i], f = N[i], part = mean[i] / square;
        double c = 2.0 * f * f - 1.0;
        part = square > 0.0 ? part : 0.0;
        c = c > 0.0 ? c : 0.0;
        double over = pull[i] - f * part;
        along[i] = part;
        alike[i] = c;
        t[i] = over;
        straight[i] = c * 2.0 * f * over;
    }
}

static BULLA_KERNEL void tilt_slip_across(size_t n, const double *restrict N, const double *restrict across,
                                          const double *restrict pull, const struct tilt_slip *slip,
                                          double *restrict ret)
{
    const double *restrict along = slip->along, *restrict alike = slip->alike, *restrict t = slip->t;
#pragma omp simd
    for (size_t i = 0; i < n; i++) {
        double f = N[i], g = across[i], over = pull[i] - g * along[i];
        ret[i] = alike[i] * (f * over + g * t[i]);
    }
}

/* The same for all cells, seen from one side. */
static void tilt_slip(const struct model *model, int axis, size_t side, const struct tilt_edges *edges,
                      struct tilt_slip *ret)
{
    const struct tilt_aimed *aimed = edges->aimed;
    const double *N = aimed->normal + axis * FACE_ROOM, *zero = aimed->normal + 2 * FACE_ROOM;
    size_t from = side * FACE_ROOM, n = aimed->n;
    tilt_slip_straight(n, aimed->normal, N, edges->held->mean + from, edges->held->pull[axis] + from, ret);
    for (unsigned d = 0; d + 1 < model->n_velocity; d++) {
        unsigned g = axis_component(axis, d + 1);
        const double *across = g < model->n_normal ? aimed->normal + g * FACE_ROOM : zero;
        tilt_slip_across(n, N, across, edges->held->pull[g] + from, ret, ret->across[d]);
        ret->across[d][n] = 0.0;
    }
    ret->straight[n] = edges->held->mean[from + n] = 0.0;
}

/* What all of them bear seen from one side, whose rows begin at `from`. */
static void tilt_bear(const struct model *model, int axis, size_t side, size_t from, const struct tilt_faces *faces,
                      const double *part, const struct tilt_edges *edges)
{
    struct tilt_slip slip;
    tilt_slip(model, axis, side, edges, &slip);
    const unsigned *at = faces->at, *of = faces->of[side];
    const double *mean = edges->held->mean + side * FACE_ROOM, *stress = edges->stress + from;
    const double *P = edges->state + 2 * model->i_E * FACE_ROOM + from;
    double *traction = edges->traction + from;
    for (size_t k = 0; k < faces->n; k++) {
        size_t i = at[k], own = of[k];
        double slides = slip.straight[own];
        traction[i] = P[i] - slides - part[k] * (stress[i] - mean[own] - slides);
    }
    for (unsigned d = 0; d + 1 < model->n_velocity; d++) {
        double *shear = edges->shear[d] + from;
        const double *across = slip.across[d];
        for (size_t k = 0; k < faces->n; k++) {
            double slides = across[of[k]];
            shear[at[k]] = slides + part[k] * (shear[at[k]] - slides);
        }
    }
}

void tilt_share(const struct model *model, const struct frame *frame, const struct tilt_edges *edges)
{
    double part[2][FACE_ROOM];
    struct tilt_faces faces;
    size_t cells = frame_edged(frame), n = cells - frame->inner, right = cells + frame->inner;
    tilt_faces(edges->aimed, frame->inner, n, &faces);
    if (!faces.n) return;
    for (size_t side = 0; side < 2; side++)
        tilt_fractions(model, faces.n, faces.at, edges->state + side * right, part[side]);
    tilt_parts(faces.n, part[0], part[1]);
    for (size_t side = 0; side < 2; side++)
        tilt_bear(model, frame->axis, side, side * right, &faces, part[side], edges);
}
