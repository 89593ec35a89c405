/* reflux.c - see reflux.h. */
#include "levels/reflux.h"

#include "base/mem.h"
#include "levels/restrict.h"
#include "phys/elastic.h"

#include <math.h>
#include <string.h>

/* Values kept of a coarse cell behind finer faces. */
static unsigned reflux_keeps(const struct model *model)
{
    return model->n_alpha + (model->n_stretch ? model->n_stretched + model_stretches(model) : 0);
}

/* Rows of the coarse side of a face: its registers, then what is kept of the cell. */
static unsigned reflux_rows(const struct model *model, const struct link *up)
{
    return up->n_register + reflux_keeps(model);
}

struct reflux *reflux_new(const struct model *model, const struct mesh *mesh, int l)
{
    struct reflux *reflux = mem_new(1, sizeof *reflux);
    const struct level *level = &mesh->levels[l];
    *reflux = (struct reflux){.model = model, .mesh = mesh, .level = level, .down = level->link};
    if (l + 1 < mesh->n_level) reflux->up = mesh->levels[l + 1].link;
    const struct link *down = reflux->down, *up = reflux->up;
    size_t plane = mesh->n_cell / (size_t)mesh->n[0];
    if (down) reflux->fine = mem_new(down->n_face * down->n_register * down->face_cells, sizeof(double));
    if (down) reflux->plane = mem_new((2 * down->n_register + 1) * plane, sizeof(double));
    if (up) reflux->coarse = mem_new(up->n_source * reflux_rows(model, up) * up->face_cells, sizeof(double));
    return reflux;
}

void reflux_free(struct reflux *reflux)
{
    if (!reflux) return;
    mem_free(reflux->fine);
    mem_free(reflux->coarse);
    mem_free(reflux->plane);
    mem_free(reflux);
}

static unsigned reflux_sources(const struct reflux *reflux, unsigned local)
{
    return reflux->up ? reflux->up->source_from[local + 1] - reflux->up->source_from[local] : 0;
}

bool reflux_concerns(const struct reflux *reflux, unsigned local)
{
    for (int face = 0; reflux->down && face < 2 * reflux->mesh->dim; face++)
        if (reflux->level->neighbours[local][face].kind == NEIGHBOUR_COARSE) return true;
    return reflux_sources(reflux, local) > 0;
}

/* A face velocity after u*: along the face, as the cell below (`left`) or above it sees it. Where nobody feels shear
 * the sides slip. */
static const double *reflux_slide(const struct model *used, const struct face_work *work, unsigned tangent, bool left)
{
    if (used->n_stretch) return (left ? work->slide_left : work->slide_right) + tangent * FACE_ROOM;
    return (left ? &work->faces.left : &work->faces.right)->u[1 + tangent];
}

/* Flux of register component q in a solved row; NULL: no such flux, where the material is absent. What a narrowed path
 * leaves out is as the whole one would find it: a material alone fills the faces, without a solid no stretch is
 * carried. left: the coarse cell lies below. */
static const double *reflux_row(const struct model *model, const struct terms *terms, int axis, unsigned q, bool left)
{
    const struct model *used = terms->model;
    if (q == model->n_field) return terms->faces->u;
    if (q > model->n_field) return reflux_slide(used, terms->faces, q - model->n_field - 1, left);
    for (unsigned i = 0; i < terms->n_flux[axis]; i++) {
        const struct term_flux *flux = &terms->flux[axis][i];
        if (flux->rate == q && term_is_flux(flux->kind)) return flux->below;
    }
    bool alone = q < model->n_alpha && !used->n_alpha && q == used->first;
    return alone ? terms->faces->u : NULL;
}

/* What the coarse cell sees go through a face: a flux, and from it the half of a force there that acts on the cell. */
struct reflux_through {
    const double *flux, *force; /* NULL: none */
    double part;                /* of the force: -1/2 for a cell below the face, 1/2 for one above */
};

static struct reflux_through reflux_through(const struct model *model, const struct terms *terms, int axis, unsigned q,
                                            bool left)
{
    struct reflux_through through = {.flux = reflux_row(model, terms, axis, q, left), .part = left ? -0.5 : 0.5};
    for (unsigned i = 0; i < terms->n_flux[axis]; i++) {
        const struct term_flux *flux = &terms->flux[axis][i];
        if (flux->rate == q && flux->kind == TERM_FORCE) through.force = flux->below;
    }
    return through;
}

/* A square patch of faces (or cells) of a tile across an axis. */
struct reflux_patch {
    int layer;   /* index along the axis */
    int from[3]; /* first cell along the other axes */
    int cells;   /* along each of the others */
};

/* Axes across `axis`, ascending; unused ones have one cell. */
static void reflux_across(int axis, int ret_axes[2])
{
    ret_axes[0] = axis == 0 ? 1 : 0;
    ret_axes[1] = axis == 2 ? 1 : 2;
}

static int reflux_extent(const struct mesh *mesh, const struct reflux_patch *patch, int axis)
{
    return axis < mesh->dim ? patch->cells : 1;
}

/* A value that counts with a weight; the first one is not added to what was there. */
static void reflux_count(const struct reflux *reflux, double value, double *sum)
{
    double counts = reflux->weight * value;
    *sum = reflux->fresh ? counts : *sum + counts;
}

/* Takes what the piece holds of a patch of faces. Counted, or as it is. */
static void reflux_copy(const struct reflux *reflux, bool counted, const struct frame *frame,
                        struct reflux_through through, const struct reflux_patch *patch, double *out)
{
    const struct mesh *mesh = reflux->mesh;
    int across[2];
    reflux_across(frame->axis, across);
    int n0 = reflux_extent(mesh, patch, across[0]), n1 = reflux_extent(mesh, patch, across[1]);
    for (int b = 0; b < n1; b++)
        for (int a = 0; a < n0; a++, out++) {
            size_t at[3] = {0}, inner = 0, outer = 0, step = 1;
            at[across[0]] = (size_t)(patch->from[across[0]] + a);
            at[across[1]] = (size_t)(patch->from[across[1]] + b);
            for (int d = 0; d < frame->axis; d++, step *= (size_t)mesh->n[d - 1]) inner += at[d] * step;
            step = 1;
            for (int d = frame->axis + 1; d < 3; d++, step *= (size_t)mesh->n[d - 1]) outer += at[d] * step;
            if (inner - frame->inner_from >= frame->inner || outer - frame->outer_from >= frame->outer) continue;
            size_t face = face_at(frame, outer - frame->outer_from, (size_t)patch->layer) + inner - frame->inner_from;
            double value = through.flux ? through.flux[face] : 0.0;
            if (through.force) value += through.part * through.force[face];
            if (counted) reflux_count(reflux, value, out);
            else *out = value;
        }
}

static double *reflux_coarse(const struct reflux *reflux, unsigned source)
{
    const struct link *up = reflux->up;
    return reflux->coarse + source * reflux_rows(reflux->model, up) * up->face_cells;
}

void reflux_weigh(struct reflux *reflux, double weight, bool fresh)
{
    reflux->weight = weight;
    reflux->fresh = fresh;
}

static void reflux_collect_fine(struct reflux *reflux, const struct terms *terms, unsigned local,
                                const struct frame *frame)
{
    const struct mesh *mesh = reflux->mesh;
    size_t plane = mesh->n_cell / (size_t)mesh->n[0];
    for (int side = 0; side < 2; side++) {
        if (reflux->level->neighbours[local][2 * frame->axis + side].kind != NEIGHBOUR_COARSE) continue;
        struct reflux_patch patch = {.layer = side ? mesh->n[frame->axis] : 0, .cells = mesh->n[0]};
        for (unsigned q = 0; q < reflux->down->n_register; q++)
            reflux_copy(reflux, false, frame, reflux_through(reflux->model, terms, frame->axis, q, side == 0), &patch,
                        reflux->plane + ((size_t)side * reflux->down->n_register + q) * plane);
    }
}

void reflux_collect(struct reflux *reflux, const struct terms *terms, unsigned local, const struct frame *frame)
{
    const struct mesh *mesh = reflux->mesh;
    const struct link *up = reflux->up;
    if (reflux->down) reflux_collect_fine(reflux, terms, local, frame);
    if (!up) return;
    for (unsigned s = up->source_from[local]; s < up->source_from[local + 1]; s++) {
        const struct link_face *source = &up->sources[s];
        if (source->face / 2 != frame->axis) continue;
        /* Below the fine tile lies its lower face: the upper face of the coarse layer. */
        struct reflux_patch patch = {.layer = source->layer + (source->face % 2 == 0), .cells = mesh->n[0] / 2};
        memcpy(patch.from, source->from, sizeof patch.from);
        for (unsigned q = 0; q < up->n_register; q++)
            reflux_copy(reflux, true, frame,
                        reflux_through(reflux->model, terms, frame->axis, q, source->face % 2 == 0), &patch,
                        reflux_coarse(reflux, s) + q * up->face_cells);
    }
}

void reflux_average(struct reflux *reflux, unsigned local, int axis)
{
    const struct mesh *mesh = reflux->mesh;
    const struct level *level = reflux->level;
    const struct link *down = reflux->down;
    size_t plane = mesh->n_cell / (size_t)mesh->n[0];
    for (int side = 0; down && side < 2; side++) {
        const struct neighbour *neighbour = &level->neighbours[local][2 * axis + side];
        if (neighbour->kind != NEIGHBOUR_COARSE) continue;
        double *fine = reflux->fine + (size_t)neighbour->index * down->n_register * down->face_cells;
        double *mean = reflux->plane + 2 * down->n_register * plane;
        for (unsigned q = 0; q < down->n_register; q++) {
            restrict_face(mesh, level, &level->tiles[level->first + local], axis, q,
                          reflux->plane + ((size_t)side * down->n_register + q) * plane, mean);
            for (size_t i = 0; i < down->face_cells; i++)
                reflux_count(reflux, mean[i], fine + q * down->face_cells + i);
        }
    }
}

size_t reflux_cell(const struct mesh *mesh, const struct link_face *source, size_t index)
{
    int across[2], axis = source->face / 2;
    size_t at[3] = {0}, half = (size_t)mesh->n[0] / 2;
    reflux_across(axis, across);
    at[axis] = (size_t)source->layer;
    for (int i = 0; i < 2; i++) {
        size_t cells = across[i] < mesh->dim ? half : 1;
        at[across[i]] = (size_t)source->from[across[i]] + index % cells;
        index /= cells;
    }
    return at[0] + (size_t)mesh->n[0] * (at[1] + (size_t)mesh->n[1] * at[2]);
}

/* Partial density of the solids of a path that carry the stretch of field q, in one cell. */
static double reflux_solid(const struct model *used, unsigned q, size_t n_cell, const double *w)
{
    double m = 0.0;
    for (unsigned k = 0; k < model_stretches(used); k++)
        for (unsigned s = 0; s < used->n_solid; s++) {
            unsigned l = used->solids[s].material;
            if (model_stretch(used, k) != q || !model_carries(used, k, s)) continue;
            m += (used->n_alpha ? w[(used->i_alpha + l) * n_cell] : 1.0) * w[(used->i_m + l) * n_cell];
        }
    return m;
}

/* Is field q evolved by a path? */
static bool reflux_knows(const struct model *used, unsigned q)
{
    for (unsigned i = model_drawn(used); i < model_edged(used); i++)
        if (used->active[i] == q) return true;
    return false;
}

/* Value q of what is kept of a cell: alpha + K, with K where the path knows of it, then the stretches and m_s of
 * each. */
static double reflux_kept(const struct reflux *reflux, const struct model *used, unsigned q, const double *w,
                          const double *K, size_t cell)
{
    const struct model *model = reflux->model;
    size_t n_cell = reflux->mesh->n_cell;
    unsigned l = q - used->first, c = q - model->n_alpha;
    if (q < model->n_alpha) return w[q * n_cell + cell] + (K && l < used->n_material ? K[l * n_cell + cell] : 0.0);
    if (c >= model->n_stretched)
        return reflux_solid(used, model_stretch(model, c - model->n_stretched), n_cell, w + cell);
    if (reflux_knows(used, model->i_V + c)) return w[(model->i_V + c) * n_cell + cell];
    return c % model->n_stretch <= ELASTIC_ZZ ? 1.0 : 0.0;
}

void reflux_keep(struct reflux *reflux, const struct model *used, unsigned local, const double *w, const double *K)
{
    const struct link *up = reflux->up;
    for (unsigned s = up ? up->source_from[local] : 0; up && s < up->source_from[local + 1]; s++) {
        double *kept = reflux_coarse(reflux, s) + up->n_register * up->face_cells;
        for (size_t i = 0; i < up->face_cells; i++) {
            size_t cell = reflux_cell(reflux->mesh, &up->sources[s], i);
            for (unsigned q = 0; q < reflux_keeps(reflux->model); q++)
                reflux_count(reflux, reflux_kept(reflux, used, q, w, K, cell), kept + q * up->face_cells + i);
        }
    }
}

void reflux_commit(struct reflux *reflux, double dt)
{
    const struct link *down = reflux->down;
    if (!down) return;
    size_t block = down->n_register * down->face_cells;
    for (unsigned f = 0; f < down->n_face; f++)
        for (size_t i = 0; i < block; i++) down->faces[f].flux[i] += dt * reflux->fine[f * block + i];
}

void reflux_clear(struct reflux *reflux)
{
    const struct link *up = reflux->up;
    for (unsigned f = 0; up && f < up->n_face; f++)
        memset(up->faces[f].flux, 0, up->n_register * up->face_cells * sizeof(double));
}

/* A/V of the face behind which a cell of a source lies [1/m]. */
static double reflux_area(const struct reflux *reflux, const struct metric *metric, const struct link_face *source,
                          size_t cell)
{
    int axis = source->face / 2;
    if (axis > 0 || reflux->mesh->beta == 0) return 1.0 / reflux->level->h[axis];
    size_t i = cell % (size_t)reflux->mesh->n[0];
    return metric->area[i + (source->face % 2 == 0)] / metric->volume[i];
}

/* The same of what turns, over that. */
static double reflux_lever(const struct reflux *reflux, const struct metric *metric, const struct link_face *source,
                           size_t cell)
{
    if (source->face / 2 > 0 || reflux->mesh->turns >= reflux->mesh->n_field) return 1.0;
    size_t i = cell % (size_t)reflux->mesh->n[0], face = i + (source->face % 2 == 0);
    return metric->turn_area[face] / metric->turn_volume[i] * (metric->volume[i] / metric->area[face]);
}

/* Values of one place of a face, register by register. */
struct reflux_value {
    const double *fine, *coarse;
    size_t step;
    double dt;
};

static double reflux_difference(const struct reflux_value *value, unsigned q)
{
    return value->fine[q * value->step] - value->dt * value->coarse[q * value->step];
}

/* Share of the solid in a cell that refluxing may exchange with its stretch. */
#define REFLUX_MOST 0.5

/* V* F as a change of stretch k: per mass of the solid that the cell has; a cell that has hardly any keeps its V.
 * ret_arrived: the mass that comes, as a share of it; or NULL. */
static void reflux_by_mass(const struct reflux *reflux, const struct reflux_value *value, unsigned k, double *change,
                           double *ret_arrived)
{
    const struct model *model = reflux->model;
    unsigned kept = reflux->up->n_register + model->n_alpha + model->n_stretched + k;
    double arrived = 0.0, m = value->coarse[kept * value->step];
    for (unsigned s = 0; s < model->n_solid; s++)
        if (model_carries(model, k, s)) arrived += change[model->i_m + model->solids[s].material];
    double per_m = m > ELASTIC_NOTHING && fabs(arrived) < REFLUX_MOST * m ? 1.0 / m : 0.0;
    for (unsigned c = 0; c < model->n_stretch; c++) change[model_stretch(model, k) + c] *= per_m;
    if (ret_arrived) *ret_arrived = arrived * per_m;
}

/* The part of stretch k in the corrected change. s: -1 for a cell on the lower side of the face, else 1. */
static void reflux_stretch(const struct reflux *reflux, const struct reflux_value *value, unsigned k, int axis,
                           double s, double swept, double *change)
{
    const struct model *model = reflux->model;
    double V[6], velocity[3], per_h = s / reflux->level->h[axis], arrived;
    unsigned first = model_stretch(model, k), kept = reflux->up->n_register + model->n_alpha + first - model->i_V;
    reflux_by_mass(reflux, value, k, change, &arrived);
    for (unsigned c = 0; c < model->n_stretch; c++) V[c] = value->coarse[(kept + c) * value->step];
    double carried[6];
    for (unsigned c = 0; c < model->n_stretch; c++) carried[c] = change[first + c];
    for (unsigned d = 0; d < model->n_velocity; d++)
        velocity[axis_component(axis, d)] = -per_h * reflux_difference(value, model->n_field + d);
    const struct elastic_correction in = {V, carried, arrived, swept, velocity, axis};
    elastic_correct(model, &in, change + first);
}

void reflux_source(const struct reflux *reflux, unsigned s, size_t index, const struct metric *metric, double dt,
                   double *ret_change)
{
    const struct model *model = reflux->model;
    const struct link_face *source = &reflux->up->sources[s];
    const struct reflux_value value = {source->flux + index, reflux_coarse(reflux, s) + index, reflux->up->face_cells,
                                       dt};
    double sign = source->face % 2 == 0 ? -1.0 : 1.0; /* the cell lies on the lower or upper side of the face */
    size_t cell = reflux_cell(reflux->mesh, source, index);
    double scale = sign * reflux_area(reflux, metric, source, cell);
    for (unsigned q = 0; q < model->n_field; q++) ret_change[q] = scale * reflux_difference(&value, q);
    if (model_turns(model)) ret_change[model->i_u + 2] *= reflux_lever(reflux, metric, source, cell);
    if (model->scene->mesh.reflux != SCENE_REFLUX_CORRECTED || !reflux->mesh->n_face_u) {
        for (unsigned k = 0; k < model_stretches(model); k++) reflux_by_mass(reflux, &value, k, ret_change, NULL);
        return;
    }
    double swept = scale * reflux_difference(&value, model->n_field);
    for (unsigned l = 0; l < model->n_alpha; l++)
        ret_change[l] -= value.coarse[(reflux->up->n_register + l) * value.step] * swept;
    for (unsigned k = 0; k < model_stretches(model); k++)
        reflux_stretch(reflux, &value, k, source->face / 2, sign, swept, ret_change);
}

/* Of the sources across one axis. */
static void reflux_delta_axis(const struct reflux *reflux, unsigned local, int axis, const struct metric *metric,
                              double dt, double *delta)
{
    const struct mesh *mesh = reflux->mesh;
    const struct link *up = reflux->up;
    double change[MODEL_FIELDS];
    for (unsigned s = up->source_from[local]; s < up->source_from[local + 1]; s++)
        for (size_t i = 0; up->sources[s].face / 2 == axis && i < up->face_cells; i++) {
            size_t cell = reflux_cell(mesh, &up->sources[s], i);
            reflux_source(reflux, s, i, metric, dt, change);
            for (unsigned q = 0; q < reflux->model->n_field; q++) delta[q * mesh->n_cell + cell] += change[q];
        }
}

/* A cell may have finer neighbours across all three axes. The list of sources follows the Morton curve, which a mirror
 * turns around, and sums of three depend on their order: axis by axis they do not. */
void reflux_delta(const struct reflux *reflux, unsigned local, double dt, double *delta)
{
    const struct mesh *mesh = reflux->mesh;
    struct metric metric;
    memset(delta, 0, reflux->model->n_field * mesh->n_cell * sizeof *delta);
    if (mesh->beta) metric_of_tile(mesh, reflux->level, &reflux->level->tiles[reflux->level->first + local], &metric);
    for (int axis = 0; axis < mesh->dim; axis++) reflux_delta_axis(reflux, local, axis, &metric, dt, delta);
}
