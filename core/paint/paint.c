/* paint.c - see paint.h.
 *
 * A layer is first compared with the whole tile, then with each cell. A constant state is made
 * once per tile; anything else is asked for cell by cell. Averages are of conserved fields, and
 * added so that cells mirrored on each other get mirrored bits: Gauss points in pairs. */
#include "paint/paint.h"

#include "base/mem.h"
#include "base/status.h"
#include "base/text.h"
#include "case/donor.h"
#include "case/shape.h"
#include "paint/paint_contact.h"
#include "paint/paint_press.h"
#include "paint/paint_curvature.h"
#include "paint/paint_smear.h"
#include "paint/paint_stretch.h"
#include "paint/paint_values.h"
#include "phys/mix.h"
#include "phys/phase_pair.h"

#include <math.h>
#include <stdbool.h>
#include <string.h>

enum { PAINT_GAUSS = 4, PAINT_POINTS = PAINT_GAUSS * PAINT_GAUSS * PAINT_GAUSS };

/* How far a cell looks beyond its faces for surfaces that lie on them, over its size. What is seen has to be felt
 * (PHASE_PAIR_FELT) around an axis and a point, too. */
#define PAINT_REACH 4e-6

struct paint_block {
    double at[MODEL_FIELDS][PAINT_POINTS];
};

/* A tile while it is painted, and the cells around it that give it something (paint_smear.h). */
struct paint {
    const struct model *model;
    const struct mesh *mesh;
    int n[3], below[3]; /* cells along each axis, and how many of them lie before the tile */
    size_t n_cell;
    double *edges[3]; /* [n + 1] along each axis; mirrored to the bit in a domain symmetric about 0 */
    double *u;        /* [n_field][n_cell] */
    double *covered;  /* [n_cell] part of a cell that has a state */
    struct paint_values values;
    struct paint_block w, conserved;
};

struct paint_cell {
    size_t index;
    double lower[3], upper[3];
};

static struct paint_cell paint_cell_at(const struct paint *paint, size_t index)
{
    struct paint_cell cell = {.index = index};
    size_t rest = index;
    for (int d = 0; d < paint->mesh->dim; d++) {
        size_t n = (size_t)paint->n[d], i = rest % n;
        rest /= n;
        cell.lower[d] = paint->edges[d][i];
        cell.upper[d] = paint->edges[d][i + 1];
    }
    return cell;
}

/* The fraction that a layer covers of all cells of the tile at once: 0, 1, or -1 if it has to be seen. */
static double paint_cover_tile(const struct paint *paint)
{
    const struct shape *shape = paint->values.layer->shape;
    double middle[3] = {0.0}, square = 0.0;
    if (!shape) return 1.0;
    for (int d = 0; d < paint->mesh->dim; d++) {
        double lower = paint->edges[d][0], upper = paint->edges[d][paint->n[d]];
        middle[d] = 0.5 * (lower + upper);
        square += 0.25 * (upper - lower) * (upper - lower);
    }
    double level = shape_level(shape, middle), reach = sqrt(square) * (paint->model->reaches ? 1.0 + PAINT_REACH : 1.0);
    return level >= reach ? 0.0 : level <= -reach ? 1.0 : -1.0;
}

/* What two bodies lose of their kinetic energy when they take one velocity [J/m3]: half their reduced mass times the
 * square of the difference. 0 to the bit where they move alike or one is not there. */
static double paint_lost(const struct model *model, const double *a, size_t a_stride, double a_part, const double *b,
                         size_t b_stride, double b_part)
{
    double a_mass = 0.0, b_mass = 0.0, square = 0.0;
    for (unsigned l = 0; l < model->n_material; l++) {
        a_mass += a[(model->i_m + l) * a_stride];
        b_mass += b[(model->i_m + l) * b_stride];
    }
    if (!(a_mass > 0.0) || !(b_mass > 0.0)) return 0.0;
    for (unsigned d = 0; d < model->n_velocity; d++) {
        double slip = a[(model->i_u + d) * a_stride] / a_mass - b[(model->i_u + d) * b_stride] / b_mass;
        square += slip * slip;
    }
    a_mass *= a_part;
    b_mass *= b_part;
    return 0.5 * (a_mass * b_mass / (a_mass + b_mass)) * square;
}

/* Unit normal of the layer's surface at the middle of a cell, into the layer: from central differences of its level. */
static void paint_normal(const struct paint *paint, size_t index, double ret_n[3])
{
    struct paint_cell cell = paint_cell_at(paint, index);
    double middle[3] = {0.0}, square = 0.0;
    memset(ret_n, 0, 3 * sizeof *ret_n);
    for (int d = 0; d < paint->mesh->dim; d++) middle[d] = 0.5 * (cell.lower[d] + cell.upper[d]);
    for (int d = 0; d < paint->mesh->dim; d++) {
        double below[3], above[3];
        memcpy(below, middle, sizeof below);
        memcpy(above, middle, sizeof above);
        below[d] = cell.lower[d];
        above[d] = cell.upper[d];
        double rise = shape_level(paint->values.layer->shape, below) - shape_level(paint->values.layer->shape, above);
        ret_n[d] = rise / (cell.upper[d] - cell.lower[d]);
        square += ret_n[d] * ret_n[d];
    }
    for (int d = 0; d < 3 && square > 0.0; d++) ret_n[d] /= sqrt(square);
}

/* Where a layer cuts a cell that has a state: what the two do to each other at once. `below`: the cell before the
 * layer. */
static void paint_meet(struct paint *paint, size_t cell, const double *below, const double *layer)
{
    const struct model *model = paint->model;
    size_t n_cell = paint->n_cell;
    double n[3], u[MODEL_FIELDS];
    paint_normal(paint, cell, n);
    for (unsigned q = 0; q < model->n_field; q++) u[q] = paint->u[q * n_cell + cell];
    if (!paint_contact(model, below, layer, n, u)) return;
    for (unsigned q = 0; q < model->n_field; q++) paint->u[q * n_cell + cell] = u[q];
}

/* u = (1 - f) u + f layer in one cell. A cut cell has one velocity; what
 * kinetic energy that costs is left out, for as heat it would be a hot spot along the surface of a moving body. */
static void paint_lay(struct paint *paint, size_t cell, double fraction, const double *layer)
{
    const struct model *model = paint->model;
    size_t n_cell = paint->n_cell;
    struct paint_stretch_layer stretch = {fraction, paint->covered[cell], layer, 1};
    double lost = 0.0;
    if (model->n_stretch) paint_stretch_mix(model, &stretch, n_cell, paint->u + cell);
    if (fraction < 1.0) lost = paint_lost(model, paint->u + cell, n_cell, 1.0 - fraction, layer, 1, fraction);
    for (unsigned q = 0; q < model->i_V; q++) {
        double *u = paint->u + q * n_cell + cell;
        *u = fraction < 1.0 ? (1.0 - fraction) * *u + fraction * layer[q] : layer[q];
    }
    paint->u[model->i_E * n_cell + cell] -= lost;
    paint->covered[cell] = fraction < 1.0 ? (1.0 - fraction) * paint->covered[cell] + fraction : 1.0;
}

/* The same; where the layer's surface cuts a cell that has a state, the two meet. */
static void paint_mix(struct paint *paint, size_t cell, double fraction, const double *layer)
{
    const struct model *model = paint->model;
    double below[MODEL_FIELDS], mean[MODEL_FIELDS];
    bool cuts = fraction < 1.0 && paint->covered[cell] == 1.0,
         meets = cuts && model->n_pair == 0; /* tension holds a jump */
    for (unsigned q = 0; cuts && q < model->n_field; q++) below[q] = paint->u[q * paint->n_cell + cell];
    paint_lay(paint, cell, fraction, layer);
    for (unsigned q = 0; cuts && q < model->n_field; q++) mean[q] = paint->u[q * paint->n_cell + cell];
    if (cuts) paint_press(model, below, layer, fraction, mean);
    if (cuts) paint->u[model->i_E * paint->n_cell + cell] = mean[model->i_E];
    if (meets) paint_meet(paint, cell, below, layer);
}

/* Primitives of a cell before the layer, if it has a state. Its pressure starts from that of 1 bar. */
static const double *paint_before(const struct paint *paint, size_t cell, double *w)
{
    double u[MODEL_FIELDS];
    if (!(paint->covered[cell] > 0.0)) return NULL;
    for (unsigned q = 0; q < paint->model->n_field; q++) {
        double part = q < paint->model->i_V ? paint->covered[cell] : 1.0; /* the stretch is a mean already */
        u[q] = paint->u[q * paint->n_cell + cell] / part;
    }
    w[paint->model->i_E] = 1e5;
    mix_primitives(paint->model, 1, 1, u, w);
    return w;
}

static const double PAINT_NODE[PAINT_GAUSS] = {-0.86113631159405257522, -0.33998104358485626480, 0.33998104358485626480,
                                               0.86113631159405257522};

/* Gauss points of a cell with their weight in the geometry (the weights of the rule come in paint_sum); outside of
 * the shape it is 0, unless all are. Returns the number of points. */
static unsigned paint_points(const struct paint *paint, const struct paint_cell *cell, bool cut, double (*x)[3],
                             double *weight)
{
    unsigned n = 1;
    bool any = false;
    for (int d = 0; d < paint->mesh->dim; d++) n *= PAINT_GAUSS;
    for (int pass = 0; pass < 2 && !any; pass++)
        for (unsigned k = 0; k < n; k++) {
            unsigned rest = k;
            for (int d = 0; d < 3; d++) {
                double middle = 0.5 * (cell->lower[d] + cell->upper[d]), half = 0.5 * (cell->upper[d] - cell->lower[d]);
                x[k][d] = d < paint->mesh->dim ? middle + half * PAINT_NODE[rest % PAINT_GAUSS] : 0.0;
                rest /= PAINT_GAUSS;
            }
            bool inside = !cut || pass || shape_contains(paint->values.layer->shape, x[k]);
            weight[k] = inside ? pow(fabs(x[k][0]), paint->mesh->beta) : 0.0;
            any = any || inside;
        }
    return n;
}

/* Gauss sum over n = 4^dim values, in pairs: mirrored values give the same bits. */
static double paint_sum(const double *value, unsigned n)
{
    double fold[PAINT_POINTS];
    memcpy(fold, value, n * sizeof *fold);
    for (; n > 1; n /= PAINT_GAUSS)
        for (unsigned k = 0; k < n / PAINT_GAUSS; k++) {
            const double *v = fold + PAINT_GAUSS * k;
            fold[k] = 0.34785484513745385737 * (v[0] + v[3]) + 0.65214515486254614263 * (v[1] + v[2]);
        }
    return fold[0];
}

/* Weights of the points for field q: those of stretches count by how much of their solid there is. */
static void paint_parts(const struct paint *paint, unsigned q, const double *weight, unsigned n, double *part)
{
    const struct model *model = paint->model;
    unsigned c, s = 0;
    memcpy(part, weight, n * sizeof *part);
    if (!model_is_stretch(model, q, &c)) return;
    s = model_bearer(model, (q - model->i_V) / model->n_stretch);
    for (unsigned k = 0, at = 0; k < n; k++)
        if (weight[k] > 0.0) part[k] *= paint_stretch_share(model, s, &paint->conserved.at[0][at++], PAINT_POINTS);
}

/* Means of the conserved fields over the points that count; of stretches over their solid. */
static void paint_mean(const struct paint *paint, const double *weight, unsigned n, double *ret_mean)
{
    const struct model *model = paint->model;
    double part[PAINT_POINTS], used[PAINT_POINTS];
    for (unsigned q = 0; q < model->n_field; q++) {
        paint_parts(paint, q, weight, n, part);
        for (unsigned k = 0, at = 0; k < n; k++)
            used[k] = weight[k] > 0.0 ? part[k] * paint->conserved.at[q][at++] : 0.0;
        double whole = paint_sum(part, n);
        unsigned c;
        ret_mean[q] = whole > 0.0 ? paint_sum(used, n) / whole : model_is_stretch(model, q, &c) && c < 3 ? 1.0 : 0.0;
    }
}

static int paint_varying(struct paint *paint, const struct paint_cell *cell, double fraction)
{
    double x[PAINT_POINTS][3], weight[PAINT_POINTS], below[MODEL_FIELDS];
    double w[MODEL_FIELDS], mean[MODEL_FIELDS];
    const double *before = paint->values.whole ? NULL : paint_before(paint, cell->index, below);
    unsigned n = paint_points(paint, cell, fraction < 1.0, x, weight), n_field = paint->model->n_field;
    size_t count = 0;
    for (unsigned k = 0; k < n; k++) {
        if (!(weight[k] > 0.0)) continue;
        TRY(paint_values_at(&paint->values, x[k], before, w));
        for (unsigned q = 0; q < n_field; q++) paint->w.at[q][count] = w[q];
        count++;
    }
    mix_conserved(paint->model, count, PAINT_POINTS, paint->w.at[0], paint->conserved.at[0]);
    paint_mean(paint, weight, n, mean);
    paint_mix(paint, cell->index, fraction, mean);
    return STATUS_OK;
}

/* A layer of constant values over a state: one point tells all. */
static int paint_overlay(struct paint *paint, const struct paint_cell *cell, double fraction)
{
    double below[MODEL_FIELDS], w[MODEL_FIELDS], u[MODEL_FIELDS], x[3];
    for (int d = 0; d < 3; d++) x[d] = 0.5 * (cell->lower[d] + cell->upper[d]);
    TRY(paint_values_at(&paint->values, x, paint_before(paint, cell->index, below), w));
    mix_conserved(paint->model, 1, 1, w, u);
    paint_mix(paint, cell->index, fraction, u);
    return STATUS_OK;
}

/* The state of another run, as far as it reaches. */
static int paint_donor(struct paint *paint, const struct scene_layer *layer)
{
    const struct mesh *mesh = paint->mesh;
    double mean[MODEL_FIELDS];
    if (!layer->donor) return status_fail(STATUS_CASE, "%s has not been read", layer->checkpoint);
    for (size_t c = 0; c < paint->n_cell; c++) {
        struct paint_cell cell = paint_cell_at(paint, c);
        double part = donor_average(layer->donor, layer->at, cell.lower, cell.upper, mesh->dim, mesh->beta,
                                    paint->model->n_field, mean);
        if (part > 0.0) paint_lay(paint, c, part, mean);
    }
    return STATUS_OK;
}

/* Does the layer bring a liquid to its vapour in this cell, or the vapour or a gas to the liquid? */
static bool paint_joins(const struct paint *paint, size_t cell)
{
    const struct model *model = paint->model;
    const double *fractions = paint->values.layer->fractions;
    bool joins = false;
    for (unsigned l = 0; fractions && l < model->n_material; l++)
        for (unsigned m = 0; m < model->n_material && fractions[l] > 0.0; m++)
            joins =
                joins || (paint->u[(model->i_alpha + m) * paint->n_cell + cell] > 0.0 && phase_pair_joins(model, l, m));
    return joins;
}

/* The fraction that a layer covers of a cell. */
static double paint_cover(const struct paint *paint, const struct paint_cell *cell)
{
    const struct mesh *mesh = paint->mesh;
    const struct shape *shape = paint->values.layer->shape;
    double fraction = shape_fraction(shape, cell->lower, cell->upper, mesh->dim, mesh->beta);
    struct paint_cell wide = *cell;
    if (!paint->model->reaches || (fraction > 0.0 && fraction < 1.0) || !paint_joins(paint, cell->index))
        return fraction;
    for (int d = 0; d < mesh->dim; d++) {
        double reach = PAINT_REACH * (cell->upper[d] - cell->lower[d]);
        wide.lower[d] = cell->lower[d] - reach > mesh->lower[d] ? cell->lower[d] - reach : mesh->lower[d];
        wide.upper[d] = cell->upper[d] + reach < mesh->upper[d] ? cell->upper[d] + reach : mesh->upper[d];
    }
    double seen = shape_fraction(shape, wide.lower, wide.upper, mesh->dim, mesh->beta);
    return fabs(seen - fraction) > PHASE_PAIR_FELT ? seen : fraction;
}

static int paint_layer(struct paint *paint)
{
    const struct paint_values *values = &paint->values;
    double w[MODEL_FIELDS], u[MODEL_FIELDS], cover = paint_cover_tile(paint);
    bool constant = values->whole && !values->varying;
    if (cover == 0.0) return STATUS_OK;
    if (constant) {
        TRY(paint_values_at(values, values->layer->centre, NULL, w));
        mix_conserved(paint->model, 1, 1, w, u);
    }
    for (size_t c = 0; c < paint->n_cell; c++) {
        struct paint_cell cell = paint_cell_at(paint, c);
        double fraction = cover;
        if (cover < 0.0) fraction = paint_cover(paint, &cell);
        if (fraction <= 0.0) continue;
        if (constant) paint_mix(paint, c, fraction, u);
        else TRY(values->varying ? paint_varying(paint, &cell, fraction) : paint_overlay(paint, &cell, fraction));
    }
    return STATUS_OK;
}

/* Every cell must have got a state. */
static int paint_check(const struct paint *paint)
{
    for (size_t c = 0; c < paint->n_cell; c++) {
        if (paint->covered[c] > 1.0 - 1e-9) continue;
        struct paint_cell cell = paint_cell_at(paint, c);
        struct text place = {0};
        for (int d = 0; d < paint->mesh->dim; d++)
            text_add(&place, "%s%.10g", d ? ", " : "", 0.5 * (cell.lower[d] + cell.upper[d]));
        status_fail(STATUS_CASE,
                    "%s: initial: the layers give no whole state to the cell at (%s); begin with "
                    "'{everywhere: true, material: ..., density: ..., pressure: ...}'",
                    paint->model->scene->path, place.at);
        text_done(&place);
        return STATUS_CASE;
    }
    return STATUS_OK;
}

static int paint_layers(struct paint *paint)
{
    for (unsigned i = 0; i < paint->model->scene->n_layer; i++) {
        paint_values_of(paint->model, i, &paint->values);
        const struct scene_layer *layer = &paint->model->scene->layers[i];
        TRY(layer->checkpoint ? paint_donor(paint, layer) : paint_layer(paint));
    }
    return paint_check(paint);
}

/* Cells of the tile, and up to `pad` around it that the domain has. */
static void paint_extend(struct paint *paint, const struct level *level, const struct tile *tile, int pad)
{
    const struct mesh *mesh = paint->mesh;
    paint->n_cell = 1;
    for (int d = 0; d < 3; d++) paint->n[d] = mesh->n[d];
    for (int d = 0; d < mesh->dim; d++) {
        int cells = level->extent[d] * mesh->n[d], first = tile->at[d] * mesh->n[d], after = cells - first - mesh->n[d];
        paint->below[d] = first < pad ? first : pad;
        paint->n[d] += paint->below[d] + (after < pad ? after : pad);
        paint->edges[d] = mem_new((size_t)paint->n[d] + 1, sizeof **paint->edges);
        first -= paint->below[d];
        for (int i = 0; i <= paint->n[d]; i++)
            paint->edges[d][i] = (mesh->lower[d] * (cells - first - i) + mesh->upper[d] * (first + i)) / cells;
        paint->n_cell *= (size_t)paint->n[d];
    }
    paint->covered = mem_new(paint->n_cell, sizeof *paint->covered);
}

static void paint_done(struct paint *paint)
{
    for (int d = 0; d < paint->mesh->dim; d++) mem_free(paint->edges[d]);
    mem_free(paint->covered);
    mem_free(paint);
}

/* The fields of the tile itself. */
static void paint_crop(const struct paint *paint, double *ret_u)
{
    const struct mesh *mesh = paint->mesh;
    size_t length = (size_t)mesh->n[0];
    for (unsigned q = 0; q < paint->model->n_field; q++)
        for (int k = 0; k < mesh->n[2]; k++)
            for (int j = 0; j < mesh->n[1]; j++, ret_u += length) {
                size_t row = (size_t)(k + paint->below[2]) * (size_t)paint->n[1] + (size_t)(j + paint->below[1]);
                size_t from = row * (size_t)paint->n[0] + (size_t)paint->below[0];
                memcpy(ret_u, paint->u + q * paint->n_cell + from, length * sizeof *ret_u);
            }
}

static int paint_start(struct paint *paint, double *u)
{
    const struct model *model = paint->model;
    memset(u, 0, model->n_field * paint->n_cell * sizeof *u);
    paint_stretch_relaxed(model, paint->n_cell, paint->n_cell, u);
    paint->u = u;
    return paint_layers(paint);
}

/* With a surface that is smeared. */
static int paint_smeared(struct paint *paint, double *u)
{
    double *room = mem_new(paint->model->n_field * paint->n_cell, sizeof *room);
    int code = paint_start(paint, room);
    if (!code) {
        paint_smear(&(struct paint_smear){.model = paint->model,
                                          .dim = paint->mesh->dim,
                                          .beta = paint->mesh->beta,
                                          .n = {paint->n[0], paint->n[1], paint->n[2]},
                                          .n_cell = paint->n_cell,
                                          .edges = paint->edges,
                                          .u = room});
        paint_crop(paint, u);
    }
    mem_free(room);
    return code;
}

int paint_tile(const struct model *model, const struct mesh *mesh, const struct level *level, const struct tile *tile,
               double *u)
{
    struct paint *paint = mem_new(1, sizeof *paint);
    bool smears = paint_smear_is(model);
    paint->model = model;
    paint->mesh = mesh;
    paint_extend(paint, level, tile, smears ? PAINT_SMEAR_PAD : 0);
    int code = smears ? paint_smeared(paint, u) : paint_start(paint, u);
    if (!code && model->n_pair && mesh->dim == 1) paint_curvature(model, mesh, level, tile, u);
    if (!code && model->n_stretch) paint_stretch_finish(model, mesh->n_cell, mesh->n_cell, u);
    paint_done(paint);
    return code;
}
