/* measure.c - see measure.h. One pass over the tiles serves all columns: volumes once per tile,
 * each derived field once per tile, then every column adds its sums or extremes. Cells under finer tiles
 * weigh nothing; tiles without a leaf are passed over. Inside a step of level 0 only the levels that have gone on
 * since the last look are passed over again: a look at the finest level costs what that level costs. */
#include "io/measure.h"

#include "base/comm.h"
#include "base/mem.h"
#include "base/status.h"
#include "derive/derive.h"
#include "io/bodies.h"
#include "io/line.h"
#include "io/region.h"
#include "io/surface.h"
#include "mesh/metric.h"
#include "mesh/rigid.h"
#include "mesh/tally.h"
#include "phys/outside.h"
#include "solve/evaporate.h"

#include <math.h>
#include <string.h>

enum { MEASURE_SLOTS = 2 };

struct measure_column {
    const struct scene_column *from;
    struct region *where; /* or NULL */
    int field;            /* in `fields`, or -1 */
    int axis;
    bool wanted;
    double start[2]; /* penetration: where the material ended at the start, and which way it lay from there, 1 or -1 */
};

struct measures {
    unsigned n;
    struct measure_column *columns;
    unsigned n_field;
    struct derive *fields;
    int base; /* the least that moments had since and at the last look: levels below have not gone on */
    /* the tile at hand */
    const struct state *state;
    const struct level *level;
    int l;
    unsigned local;
    double *volume, *ones, *weight, *work; /* [n_cell] */
    double *leaves;                        /* [n_cell] 1 in leaves, 0 in other cells; beside bodies the fluid's part */
    bool partial;                          /* the tile has both */
    double **derived;                      /* [n_field][3 n_cell], the magnitude first */
    bool *is_derived;
    size_t n_tile;    /* local tiles that `sums` has room for */
    double *sums;     /* [n_tile][n][MEASURE_SLOTS], level by level */
    double *extremes; /* [MESH_LEVELS][n][MEASURE_SLOTS]: largest of the values, of their negatives */
};

static bool measure_wants_field(enum scene_measure measure)
{
    return measure == SCENE_MIN || measure == SCENE_MAX || measure == SCENE_MEAN || measure == SCENE_INTEGRAL ||
           measure == SCENE_PLANE_INTEGRAL || measure == SCENE_ISOSURFACE_MEAN || measure == SCENE_ISOSURFACE_MIN ||
           measure == SCENE_ISOSURFACE_MAX;
}

static int measure_find_field(struct measures *measures, const struct model *model, const char *name)
{
    for (unsigned i = 0; i < measures->n_field; i++)
        if (!strcmp(measures->fields[i].name, name)) return (int)i;
    if (derive_find(model, name, &measures->fields[measures->n_field])) return -1;
    return (int)measures->n_field++;
}

static int measure_prepare_column(struct measures *measures, const struct state *state, unsigned i)
{
    struct measure_column *column = &measures->columns[i];
    const struct scene_column *from = &state->scene->output.columns[i];
    column->from = from;
    column->field = -1;
    column->axis = from->along >= 0 && from->along < state->mesh->dim ? from->along : state->mesh->dim - 1;
    if (from->where) column->where = region_new(state->mesh, from->where);
    if (from->measure == SCENE_PENETRATION) {
        int into;
        column->start[0] = line_crossing(state, (unsigned)from->material, column->axis, &into);
        column->start[1] = into;
    }
    if (!measure_wants_field(from->measure)) return STATUS_OK;
    column->field = measure_find_field(measures, state->model, from->field);
    return column->field < 0 ? status_wrap(STATUS_CASE, "output.history.columns.%s: ", from->name) : STATUS_OK;
}

int measure_new(const struct state *state, struct measures **ret_measures)
{
    struct measures *measures = mem_new(1, sizeof *measures);
    size_t n_cell = state->mesh->n_cell;
    unsigned n = state->scene->output.n_column;
    measures->n = n;
    measures->state = state;
    measures->columns = mem_new(n, sizeof *measures->columns);
    measures->fields = mem_new(n, sizeof *measures->fields);
    measures->volume = mem_new(n_cell, sizeof(double));
    measures->ones = mem_new(n_cell, sizeof(double));
    measures->weight = mem_new(n_cell, sizeof(double));
    measures->work = mem_new(n_cell, sizeof(double));
    measures->leaves = mem_new(n_cell, sizeof(double));
    for (size_t i = 0; i < n_cell; i++) measures->ones[i] = 1.0;
    measures->extremes = mem_new((size_t)MESH_LEVELS * n * MEASURE_SLOTS, sizeof(double));
    int code = STATUS_OK;
    for (unsigned i = 0; !code && i < n; i++) code = measure_prepare_column(measures, state, i);
    measures->derived = mem_new(measures->n_field, sizeof *measures->derived);
    measures->is_derived = mem_new(measures->n_field, sizeof *measures->is_derived);
    for (unsigned i = 0; i < measures->n_field; i++) measures->derived[i] = mem_new(3 * n_cell, sizeof(double));
    if (code) measure_free(measures);
    else *ret_measures = measures;
    return code;
}

void measure_free(struct measures *measures)
{
    if (!measures) return;
    for (unsigned i = 0; i < measures->n_field; i++) mem_free(measures->derived[i]);
    for (unsigned i = 0; i < measures->n; i++) region_free(measures->columns[i].where);
    mem_free(measures->derived);
    mem_free(measures->is_derived);
    mem_free(measures->columns);
    mem_free(measures->fields);
    mem_free(measures->volume);
    mem_free(measures->ones);
    mem_free(measures->weight);
    mem_free(measures->work);
    mem_free(measures->leaves);
    mem_free(measures->sums);
    mem_free(measures->extremes);
    mem_free(measures);
}

static char *measure_origin_name(const struct measure_column *column)
{
    return mem_print("history.origin.%s", column->from->name);
}

void measure_keep(const struct measures *measures, struct notes *notes)
{
    for (unsigned i = 0; i < measures->n; i++) {
        const struct measure_column *column = &measures->columns[i];
        if (column->from->measure != SCENE_PENETRATION) continue;
        char *name = measure_origin_name(column);
        notes_put(notes, name, 2, column->start);
        mem_free(name);
    }
}

void measure_recall(struct measures *measures, const struct notes *notes)
{
    for (unsigned i = 0; i < measures->n; i++) {
        char *name = measure_origin_name(&measures->columns[i]);
        double *start = measures->columns[i].start;
        if (!notes_get(notes, name, 2, start)) notes_get(notes, name, 1, start);
        mem_free(name);
    }
}

/* An evolved field of the tile at hand. */
static const double *measure_evolved(const struct measures *measures, unsigned index)
{
    return measures->level->u_old[measures->local] + index * measures->state->mesh->n_cell;
}

/* Volume fraction of a material (-1, or the only one: ones). */
static const double *measure_alpha(const struct measures *measures, int material)
{
    const struct model *model = measures->state->model;
    if (material < 0 || !model->n_alpha) return measures->ones;
    return measure_evolved(measures, model->i_alpha + (unsigned)material);
}

/* A derived field of the tile at hand; of a vector, its magnitude. */
static const double *measure_field(struct measures *measures, int index)
{
    double *values = measures->derived[index];
    if (measures->is_derived[index]) return values;
    const struct derive *field = &measures->fields[index];
    const struct state *state = measures->state;
    size_t n = state->mesh->n_cell;
    derive_tile(state->model, state->mesh, measures->l, measures->local, state->t, field, values);
    for (size_t i = 0; field->components == 3 && i < n; i++) {
        double x = values[i], y = values[n + i], z = values[2 * n + i];
        values[i] = sqrt(x * x + y * y + z * z);
    }
    measures->is_derived[index] = true;
    return values;
}

/* 1 in cells where the field says something, 0 where its material is absent (derive_material); in `work`. */
static const double *measure_said(struct measures *measures, int index)
{
    if (derive_material(&measures->fields[index]) < 0) return measures->ones;
    const double *values = measure_field(measures, index);
    for (size_t i = 0; i < measures->state->mesh->n_cell; i++) measures->work[i] = values[i] != 0.0 ? 1.0 : 0.0;
    return measures->work;
}

/* Covered fraction b f of each leaf, NULL where the column does not look at this tile at all. */
static const double *measure_cover(struct measures *measures, const struct measure_column *column)
{
    const double *fractions = NULL, *cover = measure_alpha(measures, column->from->in);
    double *weight = measures->weight;
    size_t n = measures->state->mesh->n_cell;
    enum region_cover part =
        column->where ? region_tile(column->where, measures->l, measures->local, &fractions) : REGION_ALL;
    if (part == REGION_NONE) return NULL;
    if (measures->partial) {
        for (size_t i = 0; i < n; i++) weight[i] = cover[i] * measures->leaves[i];
        cover = weight;
    }
    if (part == REGION_ALL) return cover;
    for (size_t i = 0; i < n; i++) weight[i] = fractions[i] * cover[i];
    return weight;
}

/* Centroids of the cells along an axis: int x dV / V with the metric along the first axis. */
static void measure_positions(const struct measures *measures, int axis, double *ret_x)
{
    const struct mesh *mesh = measures->state->mesh;
    double corner[3], h = measures->level->h[axis];
    mesh_corner(mesh, measures->level, &measures->level->tiles[measures->level->first + measures->local], corner);
    size_t cell = 0;
    int at[3];
    for (at[2] = 0; at[2] < mesh->n[2]; at[2]++)
        for (at[1] = 0; at[1] < mesh->n[1]; at[1]++)
            for (at[0] = 0; at[0] < mesh->n[0]; at[0]++) {
                double x = corner[axis] + (at[axis] + 0.5) * h;
                if (axis == 0 && mesh->beta == 1) x += h * h / (12.0 * x);
                if (axis == 0 && mesh->beta == 2) x *= 3.0 * (4.0 * x * x + h * h) / (12.0 * x * x + h * h);
                ret_x[cell++] = x;
            }
}

/* The density whose integral `total` and `mass` are; NULL: sum over materials, in `work`. */
static const double *measure_content(struct measures *measures, const struct scene_column *from)
{
    const struct model *model = measures->state->model;
    size_t n = measures->state->mesh->n_cell;
    if (from->measure == SCENE_TOTAL && !strcmp(from->field, "energy")) return measure_evolved(measures, model->i_E);
    if (from->measure == SCENE_TOTAL && !strncmp(from->field, "momentum_", 9)) {
        int axis = from->field[9] - 'x';
        return axis < (int)model->n_velocity ? measure_evolved(measures, model->i_u + (unsigned)axis) : NULL;
    }
    if (from->measure == SCENE_MASS && from->material >= 0)
        return measure_evolved(measures, model->i_m + (unsigned)from->material);
    memset(measures->work, 0, n * sizeof *measures->work);
    for (unsigned l = 0; l < model->n_material; l++) {
        const double *m = measure_evolved(measures, model->i_m + l);
        for (size_t i = 0; i < n; i++) measures->work[i] += m[i];
    }
    return measures->work;
}

/* Multiplies the cover into volumes, unless it is one everywhere. */
static const double *measure_weigh(struct measures *measures, const double *cover)
{
    if (cover == measures->ones) return measures->volume;
    for (size_t i = 0; i < measures->state->mesh->n_cell; i++) measures->weight[i] = cover[i] * measures->volume[i];
    return measures->weight;
}

/* Product of the sides of a cell of the level, whatever the geometry. */
static double measure_extent(const struct measures *measures)
{
    double product = 1.0;
    for (int axis = 0; axis < measures->state->mesh->dim; axis++) product *= measures->level->h[axis];
    return product;
}

static void measure_sum(struct measures *measures, const struct measure_column *column, double *sums)
{
    const struct scene_column *from = column->from;
    size_t n = measures->state->mesh->n_cell;
    const double *cover = measure_cover(measures, column), *content = NULL;
    if (!cover) return;
    const double *weight = from->measure == SCENE_PLANE_INTEGRAL ? NULL : measure_weigh(measures, cover),
                 *alpha = measure_alpha(measures, from->material);
    switch (from->measure) {
    case SCENE_VOLUME:
    case SCENE_EQUIVALENT_RADIUS: sums[0] = tally_row(n, alpha, weight); break;
    case SCENE_MASS:
    case SCENE_TOTAL:
        content = measure_content(measures, from);
        sums[0] = content ? tally_row(n, content, weight) : 0.0;
        break;
    case SCENE_CENTROID:
        measure_positions(measures, column->axis, measures->work);
        for (size_t i = 0; i < n; i++) measures->work[i] *= alpha[i];
        sums[0] = tally_row(n, measures->work, weight);
        sums[1] = tally_row(n, alpha, weight);
        break;
    case SCENE_PLANE_INTEGRAL:
        sums[0] = measure_extent(measures) * tally_row(n, measure_field(measures, column->field), cover);
        break;
    case SCENE_MEAN:
    case SCENE_INTEGRAL:
        sums[0] = tally_row(n, measure_field(measures, column->field), weight);
        sums[1] = tally_row(n, measure_said(measures, column->field), weight);
        break;
    case SCENE_OUTSIDE:
        sums[0] = (double)outside_count(measures->state->model, (unsigned)from->material, n, n,
                                        measures->level->w[measures->local], cover);
        break;
    case SCENE_FORCE:
    case SCENE_POWER: sums[0] = bodies_load(measures->state, measures->l, measures->local, from, column->axis); break;
    default: break;
    }
}

/* Velocity along the axis of a jet, from the primitives. */
static const double *measure_velocity(const struct measures *measures, int axis)
{
    const struct state *state = measures->state;
    return measures->level->w[measures->local] + (state->model->i_u + (unsigned)axis) * state->mesh->n_cell;
}

static void measure_extreme(struct measures *measures, const struct measure_column *column, double *extremes)
{
    const struct scene_column *from = column->from;
    bool jet = from->measure == SCENE_JET_SPEED;
    if (!jet && from->measure != SCENE_MIN && from->measure != SCENE_MAX) return;
    const double *cover = measure_cover(measures, column);
    if (!cover) return;
    const double *alpha = jet ? measure_alpha(measures, from->material) : measure_said(measures, column->field);
    const double *values = jet ? measure_velocity(measures, column->axis) : measure_field(measures, column->field);
    tally_extremes(measures->state->mesh->n_cell, values, cover, alpha, extremes);
}

static double *measure_level_extremes(const struct measures *measures, int l)
{
    return measures->extremes + (size_t)l * measures->n * MEASURE_SLOTS;
}

static void measure_tile(struct measures *measures, double *sums)
{
    const struct mesh *mesh = measures->state->mesh;
    const struct tile *tile = &measures->level->tiles[measures->level->first + measures->local];
    memset(sums, 0, measures->n * MEASURE_SLOTS * sizeof *sums);
    if (tally_is_covered(mesh, tile)) return;
    memset(measures->is_derived, 0, measures->n_field * sizeof *measures->is_derived);
    metric_volumes(mesh, measures->level, tile, measures->volume);
    measures->partial = tile->covered != 0 || mesh->rigid;
    if (measures->partial) mesh_leaves(mesh, tile, measures->leaves);
    rigid_weigh(mesh, measures->level, tile, measures->state->t, measures->leaves);
    double *extremes = measure_level_extremes(measures, measures->l);
    for (unsigned i = 0; i < measures->n; i++) {
        if (!measures->columns[i].wanted) continue;
        measure_sum(measures, &measures->columns[i], sums + i * MEASURE_SLOTS);
        measure_extreme(measures, &measures->columns[i], extremes + i * MEASURE_SLOTS);
    }
}

static double measure_radius(const struct mesh *mesh, double volume)
{
    if (mesh->beta || mesh->dim == 3) return cbrt(0.75 * volume / M_PI);
    return mesh->dim == 2 ? sqrt(volume / M_PI) : 0.5 * volume;
}

/* How far the surface has moved into the material. */
static double measure_penetration(const struct state *state, const struct measure_column *column)
{
    int into;
    double place = line_crossing(state, (unsigned)column->from->material, column->axis, &into);
    return column->start[1] * (place - column->start[0]);
}

/* The number of a column from its sums and extremes. */
static double measure_result(struct measures *measures, const struct measure_column *column, const double *sums,
                             const double *extremes)
{
    const struct state *state = measures->state;
    const struct scene_column *from = column->from;
    const struct derive *field = column->field < 0 ? NULL : &measures->fields[column->field];
    bool empty = !(extremes[0] >= -extremes[1]);
    double ends[2];
    switch (from->measure) {
    case SCENE_CENTROID:
    case SCENE_MEAN: return sums[0] / sums[1];
    case SCENE_EQUIVALENT_RADIUS: return measure_radius(state->mesh, sums[0]);
    case SCENE_MIN: return empty ? NAN : -extremes[1];
    case SCENE_MAX: return empty ? NAN : extremes[0];
    case SCENE_JET_SPEED: return empty ? NAN : extremes[0] >= extremes[1] ? extremes[0] : -extremes[1];
    case SCENE_PENETRATION: return measure_penetration(state, column);
    case SCENE_BODY_DISPLACEMENT:
    case SCENE_BODY_VELOCITY:
    case SCENE_BODY_ANGLE: return bodies_motion(state, from, column->axis);
    case SCENE_EVAPORATED: return evaporate_total(state, (unsigned)from->material);
    case SCENE_ISOSURFACE_MEAN: return surface_mean(state, (unsigned)from->in, field, column->where);
    case SCENE_ISOSURFACE_MIN:
    case SCENE_ISOSURFACE_MAX:
        surface_extremes(state, (unsigned)from->in, field, column->where, ends);
        return ends[from->measure == SCENE_ISOSURFACE_MAX];
    case SCENE_MIN_BETWEEN:
    case SCENE_MAX_BETWEEN:
    case SCENE_VALUE: return NAN;
    default: return sums[0];
    }
}

/* Which columns count; were they others before? */
static bool measure_choose(struct measures *measures, const bool *wanted)
{
    bool changed = false;
    for (unsigned i = 0; i < measures->n; i++) {
        bool want = !wanted || wanted[i];
        changed = changed || want != measures->columns[i].wanted;
        measures->columns[i].wanted = want;
    }
    return changed;
}

/* Brings what the fields of the columns hang on; has a value that all cells see changed? */
static bool measure_prepare_fields(struct measures *measures, struct derive_moment *moment)
{
    bool changed = false;
    for (unsigned f = 0; f < measures->n_field; f++) {
        bool want = false;
        for (unsigned i = 0; i < measures->n; i++)
            want = want || (measures->columns[i].wanted && measures->columns[i].field == (int)f);
        double before = measures->fields[f].scale;
        if (want) derive_prepare(moment, &measures->fields[f]);
        changed = changed || measures->fields[f].scale != before;
    }
    return changed;
}

/* Makes room for the tiles of this moment, and brings everything up to date that hangs on them; returns the coarsest
 * level whose sums are not those of the last look. */
static int measure_begin(struct measures *measures, const struct state *state, struct derive_moment *moment,
                         const bool *wanted)
{
    size_t tiles = tally_tiles(state->mesh) + 1, row = (size_t)measures->n * MEASURE_SLOTS;
    measures->state = state;
    if (tiles > measures->n_tile) {
        measures->sums = mem_grow(measures->sums, measures->n_tile * row, tiles * row, sizeof *measures->sums);
        measures->n_tile = tiles;
    }
    bool changed = measure_choose(measures, wanted);
    for (unsigned i = 0; i < measures->n; i++) region_follow(measures->columns[i].where, state->mesh);
    if (measure_prepare_fields(measures, moment)) changed = true;
    int from = changed ? 0 : moment->base < measures->base ? moment->base : measures->base;
    double *extremes = measure_level_extremes(measures, 0);
    for (size_t i = (size_t)from * row; i < MESH_LEVELS * row; i++) extremes[i] = -INFINITY;
    measures->base = moment->base;
    return from;
}

void measure_pass(struct measures *measures, int base)
{
    if (base < measures->base) measures->base = base;
}

/* The extremes of all levels and ranks, in the place of level 0's in `ret`. */
static void measure_join_extremes(const struct measures *measures, unsigned slots, double *ret)
{
    memcpy(ret, measures->extremes, slots * sizeof *ret);
    for (int l = 1; l < measures->state->mesh->n_level; l++)
        for (unsigned i = 0; i < slots; i++) {
            double other = measure_level_extremes(measures, l)[i];
            ret[i] = other > ret[i] ? other : ret[i];
        }
    comm_max(ret, (int)slots);
}

void measure_take(struct measures *measures, const struct state *state, struct derive_moment *moment,
                  const bool *wanted, double *ret_values)
{
    const struct mesh *mesh = state->mesh;
    unsigned slots = measures->n * MEASURE_SLOTS;
    int from = measure_begin(measures, state, moment, wanted);
    double *totals = mem_new(2 * slots, sizeof *totals), *extremes = totals + slots, *sums = measures->sums;
    for (measures->l = 0; measures->l < mesh->n_level; measures->l++) {
        measures->level = &mesh->levels[measures->l];
        for (measures->local = 0; measures->local < measures->level->n_local; measures->local++, sums += slots)
            if (measures->l >= from) measure_tile(measures, sums);
    }
    tally_add(mesh, slots, measures->sums, totals);
    measure_join_extremes(measures, slots, extremes);
    for (unsigned i = 0; i < measures->n; i++) {
        const struct measure_column *column = &measures->columns[i];
        unsigned at = i * MEASURE_SLOTS;
        ret_values[i] = column->wanted ? measure_result(measures, column, totals + at, extremes + at) : NAN;
    }
    mem_free(totals);
}
