/* prolong.c - see prolong.h.
 *
 * Both halves start from one block: the primitives of a coarse tile with one layer of neighbours behind each
 * face, taken from gathered frames. Corners of the block are never used. What lies behind the coarse tile's
 * own coarse-fine faces is not used either, because levels nest: a copy of the cell inside stands there. */
#include "levels/prolong.h"

#include "base/comm.h"
#include "base/mem.h"
#include "levels/prolong_cell.h"
#include "levels/prolong_held.h"
#include "levels/prolong_slope.h"
#include "mesh/metric.h"
#include "mesh/post.h"
#include "phys/bearing.h"
#include "phys/mix.h"

#include <string.h>

/* Apart from the tags of post.h. */
enum { PROLONG_TAG = 400 };

struct prolong {
    const struct model *model;
    size_t stride[3], cells, origin; /* of the block: to the next cell along an axis (0 beyond dim), size of a
                                        component, offset of the tile's first cell */
    size_t *edge[3];                 /* by (outer, inner) of an axis: offset of the first cell along it */
    double *frame;                   /* [n_field][pitch]: a line of cells with all beside it along an axis */
    size_t pitch;
    double *w, *u, *rho_c2, *stiffness; /* blocks: primitives, conserved, rho c_f^2 and that of each material */
    double *elastic;                    /* energy per volume, then [n_solid] masses that bear; NULL without a solid */
    struct prolong_held *held;          /* what forces make of pressure; NULL without */
};

static void prolong_edges(const struct mesh *mesh, int axis, struct prolong *prolong)
{
    size_t count = mesh->n_cell / (size_t)mesh->n[axis];
    prolong->edge[axis] = mem_new(count, sizeof *prolong->edge[axis]);
    for (size_t c = 0; c < count; c++) {
        size_t at = prolong->origin, rest = c;
        for (int d = 0; d < mesh->dim; d++) {
            if (d == axis) continue;
            at += rest % (size_t)mesh->n[d] * prolong->stride[d];
            rest /= (size_t)mesh->n[d];
        }
        prolong->edge[axis][c] = at;
    }
}

struct prolong *prolong_new(const struct model *model, const struct mesh *mesh)
{
    struct prolong *prolong = mem_new(1, sizeof *prolong);
    prolong->model = model;
    prolong->cells = 1;
    for (int d = 0; d < mesh->dim; d++) {
        prolong->stride[d] = prolong->cells;
        prolong->origin += prolong->cells;
        prolong->cells *= (size_t)mesh->n[d] + 2;
    }
    for (int axis = 0; axis < mesh->dim; axis++) prolong_edges(mesh, axis, prolong);
    prolong->pitch = (size_t)mesh->n[0] * ((size_t)mesh->n[0] + 2 * (size_t)mesh->ghosts);
    prolong->frame = mem_new(model->n_field * prolong->pitch, sizeof(double));
    prolong->w = mem_new(model->n_field * prolong->cells, sizeof(double));
    prolong->u = mem_new(model->n_field * prolong->cells, sizeof(double));
    prolong->stiffness = mem_new(model->n_material * prolong->cells, sizeof(double));
    prolong->rho_c2 = mem_new(prolong->cells, sizeof(double));
    size_t bearing = model->damaged ? model->n_solid : 0;
    if (model->n_stretch) prolong->elastic = mem_new((1 + bearing) * prolong->cells, sizeof(double));
    prolong->held = prolong_held_new(model, mesh, prolong->cells);
    return prolong;
}

void prolong_free(struct prolong *prolong)
{
    if (!prolong) return;
    for (int axis = 0; axis < 3; axis++) mem_free(prolong->edge[axis]);
    mem_free(prolong->frame);
    mem_free(prolong->w);
    mem_free(prolong->u);
    mem_free(prolong->stiffness);
    mem_free(prolong->rho_c2);
    mem_free(prolong->elastic);
    prolong_held_free(prolong->held);
    mem_free(prolong);
}

/* Behind faces of the coarse level: the domain's boundary, or a coarser level that nobody will look at. */
static void prolong_behind(void *data, unsigned local, const struct frame *frame, int side, size_t pitch, double *w)
{
    struct bound *bound = data;
    const struct neighbour *neighbour = &bound->level->neighbours[local][2 * frame->axis + side];
    if (neighbour->kind == NEIGHBOUR_BOUNDARY) {
        bound_fill(bound, local, frame, side, pitch, w);
        return;
    }
    for (unsigned q = 0; q < bound->model->n_field; q++) bound_copy(bound, local, frame, side, pitch, w + q * pitch);
}

/* The layers next to both ends of a gathered piece, into the block. */
static void prolong_place(struct prolong *prolong, const struct frame *frame)
{
    size_t stride = prolong->stride[frame->axis], length = frame->n * stride;
    for (unsigned q = 0; q < prolong->model->n_field; q++)
        for (size_t o = 0; o < frame->outer; o++) {
            const double *low = prolong->frame + q * prolong->pitch + frame_at(frame, o, -1);
            const double *high = prolong->frame + q * prolong->pitch + frame_at(frame, o, (int)frame->n);
            const size_t *edge =
                prolong->edge[frame->axis] + (frame->outer_from + o) * frame->tile_inner + frame->inner_from;
            double *w = prolong->w + q * prolong->cells;
            for (size_t i = 0; i < frame->inner; i++) {
                w[edge[i] - stride] = low[i];
                w[edge[i] + length] = high[i];
            }
        }
}

/* Cells of a tile: from[d] <= i < to[d]. */
struct prolong_box {
    size_t from[3], to[3];
};

/* Cells of a box on one line across an axis, with all cells of the tile along it. k: index along the third axis. */
static struct frame prolong_line(const struct mesh *mesh, int axis, const struct prolong_box *box, size_t k)
{
    struct frame frame = {.axis = axis,
                          .outer = 1,
                          .inner = 1,
                          .n = (size_t)mesh->n[axis],
                          .ghosts = (size_t)mesh->ghosts,
                          .tile_inner = 1};
    for (int d = 0; d < axis; d++) frame.tile_inner *= (size_t)mesh->n[d];
    frame.tile_outer = mesh->n_cell / frame.n / frame.tile_inner;
    if (axis == 0) {
        frame.outer_from = box->from[1] + (size_t)mesh->n[1] * k;
        frame.outer = box->to[1] - box->from[1];
    } else {
        frame.outer_from = axis == 1 ? k : 0;
        frame.inner_from = box->from[0] + (axis == 1 ? 0 : (size_t)mesh->n[0] * k);
        frame.inner = box->to[0] - box->from[0];
    }
    frame.count = frame.outer * frame_layers(&frame) * frame.inner;
    return frame;
}

/* Copies the cells of a box and their neighbours in the tile to the block. */
static void prolong_inside(struct prolong *prolong, const struct mesh *mesh, const double *w,
                           const struct prolong_box *box)
{
    struct prolong_box wide = *box;
    for (int d = 0; d < mesh->dim; d++) {
        if (wide.from[d] > 0) wide.from[d]--;
        if (wide.to[d] < (size_t)mesh->n[d]) wide.to[d]++;
    }
    size_t n0 = (size_t)mesh->n[0], n1 = (size_t)mesh->n[1], length = wide.to[0] - wide.from[0];
    for (unsigned q = 0; q < prolong->model->n_field; q++)
        for (size_t k = wide.from[2]; k < wide.to[2]; k++)
            for (size_t j = wide.from[1]; j < wide.to[1]; j++)
                memcpy(prolong->w + q * prolong->cells + prolong->edge[0][k * n1 + j] + wide.from[0],
                       w + q * mesh->n_cell + (k * n1 + j) * n0 + wide.from[0], length * sizeof *w);
}

/* Fills the block of primitives with the cells of a box of a local tile and the face neighbours of each. */
static void prolong_gather(struct prolong *prolong, const struct mesh *mesh, const struct level *level, unsigned local,
                           struct bound *bound, const struct prolong_box *box)
{
    struct frame_source source = {.mesh = mesh,
                                  .level = level,
                                  .arrays = level->w,
                                  .halo = level->halo,
                                  .n_field = prolong->model->n_field,
                                  .boundary = prolong_behind,
                                  .data = bound};
    prolong_inside(prolong, mesh, level->w[local], box);
    for (int axis = 0; axis < mesh->dim; axis++) {
        int other = axis == 2 ? 1 : 2;
        if (box->from[axis] > 0 && box->to[axis] < (size_t)mesh->n[axis]) continue;
        for (size_t k = box->from[other]; k < box->to[other]; k++) {
            struct frame frame = prolong_line(mesh, axis, box, k);
            frame_gather(&source, local, &frame, prolong->pitch, prolong->frame);
            prolong_place(prolong, &frame);
        }
    }
}

/* A row of coarse cells and the fine ghosts made from it. */
struct prolong_row {
    size_t n, step, fine_step; /* from one coarse cell of the row to the next, in the block and in the strip */
    size_t stride[3];          /* neighbours in the block; 0 beyond dim */
    size_t fine[3], count[3];  /* strides of the strip; children per axis: 2, 1 beyond dim */
};

/* The children of a coarse value c, with what they lie beside it along each axis. */
static inline void prolong_fill_cell(const struct prolong_row *row, double c, double sx, double sy, double sz,
                                     double *to)
{
    for (size_t k = 0; k < row->count[2]; k++)
        for (size_t j = 0; j < row->count[1]; j++) {
            double y = j ? sy : -sy, z = k ? sz : -sz, *pair = to + k * row->fine[2] + j * row->fine[1];
            pair[0] = c + ((y - sx) + z);
            pair[row->fine[0]] = c + ((y + sx) + z);
        }
}

static BULLA_KERNEL void prolong_fill_row(const struct prolong_row *row, const double *restrict w,
                                          double *restrict strip)
{
    for (size_t i = 0; i < row->n; i++) {
        const double *at = w + i * row->step;
        prolong_fill_cell(row, *at, prolong_slope(at, row->stride[0]), prolong_slope(at, row->stride[1]),
                          prolong_slope(at, row->stride[2]), strip + i * row->fine_step);
    }
}

/* The same for pressure where forces act; G: rows by axis as far as the first cell of the row. */
static void prolong_fill_held(const struct prolong_row *row, const double *p, const double *const G[3], double *strip)
{
    for (size_t i = 0; i < row->n; i++) {
        double s[3];
        for (int d = 0; d < 3; d++)
            s[d] = prolong_held_slope(p + i * row->step, G[d] ? G[d] + i * row->step : NULL, row->stride[d]);
        prolong_fill_cell(row, p[i * row->step], s[0], s[1], s[2], strip + i * row->fine_step);
    }
}

/* A row of component q that begins at `at` in the block. */
static void prolong_fill(const struct prolong *prolong, const struct prolong_row *row, unsigned q, size_t at,
                         double *strip)
{
    const double *w = prolong->w + q * prolong->cells + at, *G[3];
    if (!prolong->held || q != prolong->model->i_E) {
        prolong_fill_row(row, w, strip);
        return;
    }
    const double *const *held = prolong_held_rows(prolong->held);
    for (int d = 0; d < 3; d++) G[d] = held[d] ? held[d] + at : NULL;
    prolong_fill_held(row, w, G, strip);
}

/* Coarse cells along axis d of the patch that the strip of a face across `axis` is made from. */
static size_t prolong_across(const struct mesh *mesh, int axis, int d)
{
    if (d == axis) return (size_t)link_depth(mesh);
    return d < mesh->dim ? (size_t)mesh->n[d] / 2 : 1;
}

static void prolong_strip(const struct prolong *prolong, const struct mesh *mesh, const struct link_face *face,
                          double *strip)
{
    const struct model *model = prolong->model;
    int axis = face->face / 2, along = axis == 0 && mesh->dim > 1 ? 1 : 0, across = along == 0 ? 1 : 0;
    size_t patch[3], from = prolong->origin, size = 1;
    struct prolong_row row = {.step = prolong->stride[along]};
    for (int d = 0; d < 3; d++) {
        bool used = d < mesh->dim;
        row.fine[d] = size;
        row.count[d] = used ? 2 : 1;
        row.stride[d] = prolong->stride[d];
        patch[d] = prolong_across(mesh, axis, d);
        size *= patch[d] * row.count[d];
        from += (size_t)face->from[d] * prolong->stride[d];
    }
    row.n = patch[along];
    row.fine_step = 2 * row.fine[along];
    for (unsigned q = 0; q < model->n_field; q++)
        for (size_t k = 0; k < patch[2]; k++)
            for (size_t j = 0; j < patch[across]; j++)
                prolong_fill(prolong, &row, q, from + j * prolong->stride[across] + k * prolong->stride[2],
                             strip + q * size + 2 * j * row.fine[across] + 2 * k * row.fine[2]);
    if (model->n_alpha > 2) prolong_slope_normalise(size, model->n_alpha, strip);
    elastic_settle(model, size, size, strip);
}

/* The coarse cells that a strip is made from. */
static struct prolong_box prolong_patch(const struct mesh *mesh, const struct link_face *face)
{
    struct prolong_box box;
    for (int d = 0; d < 3; d++) {
        box.from[d] = (size_t)face->from[d];
        box.to[d] = box.from[d] + prolong_across(mesh, face->face / 2, d);
    }
    return box;
}

/* What forces make of the pressure of a gathered box of a local tile. */
static void prolong_hold(struct prolong *prolong, const struct level *level, unsigned local, double t,
                         const struct prolong_box *box)
{
    const struct prolong_held_block block = {.level = level,
                                             .tile = &level->tiles[level->first + local],
                                             .t = t,
                                             .from = box->from,
                                             .to = box->to,
                                             .stride = prolong->stride,
                                             .origin = prolong->origin,
                                             .cells = prolong->cells,
                                             .w = prolong->w};
    if (prolong->held) prolong_held_fill(prolong->held, &block);
}

void prolong_strips(struct prolong *prolong, const struct mesh *mesh, int l, struct bound *bound, int slot)
{
    const struct level *level = &mesh->levels[l];
    const struct link *link = mesh->levels[l + 1].link;
    for (unsigned t = 0; t < level->n_local; t++) {
        unsigned from = link->source_from[t], to = link->source_from[t + 1];
        for (unsigned s = from; s < to; s++) {
            struct prolong_box box = prolong_patch(mesh, &link->sources[s]);
            prolong_gather(prolong, mesh, level, t, bound, &box);
            prolong_hold(prolong, level, t, bound->t, &box);
            prolong_strip(prolong, mesh, &link->sources[s], link->sources[s].strip[slot]);
        }
    }
}

/* A born tile that this rank makes, or gets. */
struct prolong_birth {
    unsigned child, parent; /* tiles: indices in the lists of the levels */
    int from, to;           /* owners of parent and child */
    unsigned item;          /* of the post, where they differ */
};

/* Those of this rank, in Morton order, which keeps the children of a tile together. */
static unsigned prolong_list(const struct mesh *mesh, int l, const bool *born, struct prolong_birth *births)
{
    const struct level *level = &mesh->levels[l], *coarse = &mesh->levels[l - 1];
    unsigned count = 0, items[2] = {0, 0};
    for (unsigned i = 0; i < level->n_known; i++) {
        if (!born[i]) continue;
        const int *at = level->tiles[i].at, above[3] = {at[0] >> 1, at[1] >> 1, at[2] >> 1};
        int parent = mesh_find(mesh, coarse, above), from = parent < 0 ? -1 : coarse->tiles[parent].rank;
        struct prolong_birth birth = {i, (unsigned)parent, from, level->tiles[i].rank, 0};
        if (from != comm_rank() && birth.to != comm_rank()) continue;
        if (birth.from != birth.to) birth.item = items[birth.to == comm_rank()]++;
        births[count++] = birth;
    }
    return count;
}

/* A child's conserved fields and, from where iterated closures start, its pressure. */
static struct post *prolong_post(const struct mesh *mesh, const struct prolong_birth *births, unsigned n)
{
    struct post_item *out = mem_new(n, sizeof *out), *in = mem_new(n, sizeof *in);
    unsigned n_out = 0, n_in = 0;
    size_t doubles = (mesh->n_field + 1) * mesh->n_cell;
    for (const struct prolong_birth *birth = births; birth < births + n; birth++) {
        if (birth->from == birth->to) continue;
        if (birth->from == comm_rank()) out[n_out++] = (struct post_item){birth->to, doubles};
        else in[n_in++] = (struct post_item){birth->from, doubles};
    }
    struct post *post = post_new(PROLONG_TAG, n_out, out, n_in, in);
    mem_free(out);
    mem_free(in);
    return post;
}

static void prolong_strain(struct prolong *prolong)
{
    const struct model *model = prolong->model;
    const double *m[SCENE_MATERIALS];
    if (!prolong->elastic) return;
    for (unsigned s = 0; s < model->n_solid; s++)
        m[s] = prolong->u + (model->i_m + model->solids[s].material) * prolong->cells;
    double *left = prolong->elastic + prolong->cells;
    bearing_of_conserved(model, prolong->cells, prolong->cells, prolong->u, prolong->cells, left, m);
    elastic_energy(model, prolong->cells, prolong->cells, prolong->u + model->i_V * prolong->cells, m,
                   prolong->elastic);
}

/* The block of a coarse tile as source of children. Corners are filled, because laws are called on them too. */
static void prolong_prepare(struct prolong *prolong, const struct mesh *mesh, const struct level *level, unsigned local,
                            struct bound *bound)
{
    const struct model *model = prolong->model;
    const struct prolong_box all = {.to = {(size_t)mesh->n[0], (size_t)mesh->n[1], (size_t)mesh->n[2]}};
    for (unsigned q = 0; q < model->n_field; q++)
        for (size_t c = 0; c < prolong->cells; c++)
            prolong->w[q * prolong->cells + c] = level->w[local][q * mesh->n_cell];
    prolong_gather(prolong, mesh, level, local, bound, &all);
    mix_conserved(model, prolong->cells, prolong->cells, prolong->w, prolong->u);
    mix_stiffness(model, prolong->cells, prolong->cells, prolong->w, prolong->stiffness);
    mix_speed2(model, prolong->cells, prolong->cells, prolong->w, prolong->stiffness, prolong->rho_c2);
    for (size_t c = 0; c < prolong->cells; c++) {
        double rho = 0.0;
        for (unsigned l = 0; l < model->n_material; l++) rho += prolong->u[(model->i_m + l) * prolong->cells + c];
        prolong->rho_c2[c] *= rho;
    }
    prolong_strain(prolong);
}

/* Per coarse column of a fine tile: what its two fine columns get of the difference of its neighbours along axis 0,
 * their distances from the centroid over that of the neighbours. The volume-weighted mean of both is 0. ret_turn: the
 * part of the upper one in the volume of what turns. */
static void prolong_gives(const struct mesh *mesh, const struct level *fine, const struct tile *tile,
                          double (*ret_give)[2], double *ret_turn)
{
    struct metric metric;
    metric_of_tile(mesh, fine, tile, &metric);
    for (int i = 0; i < mesh->n[0] / 2; i++) {
        double r[7], V1 = metric.volume[2 * i], V2 = metric.volume[2 * i + 1];
        ret_give[i][0] = -0.125;
        ret_give[i][1] = 0.125;
        const double *turn = metric.turn_volume + 2 * i;
        ret_turn[i] = mesh->beta == 1 ? turn[1] / (turn[0] + turn[1]) : 0.0;
        if (mesh->beta == 0) continue;
        for (int k = 0; k < 7; k++) r[k] = mesh->lower[0] + (tile->at[0] * mesh->n[0] + 2 * i + k - 2) * fine->h[0];
        double before = metric_centroid(mesh->beta, r[0], r[2]), after = metric_centroid(mesh->beta, r[4], r[6]);
        double apart = metric_centroid(mesh->beta, r[3], r[4]) - metric_centroid(mesh->beta, r[2], r[3]);
        ret_give[i][0] = -apart * (V2 / (V1 + V2)) / (after - before);
        ret_give[i][1] = apart * (V1 / (V1 + V2)) / (after - before);
    }
}

/* Where the children of a coarse cell go. */
struct prolong_target {
    double *u, *p;
    size_t at[3]; /* the coarse cell, counted from the octant's first */
};

static void prolong_store(const struct mesh *mesh, const struct model *model, const struct prolong_children *children,
                          const struct prolong_target *target)
{
    for (size_t o = 0; o < (size_t)1 << mesh->dim; o++) {
        size_t cell = 0;
        for (int d = mesh->dim - 1; d >= 0; d--) cell = cell * (size_t)mesh->n[d] + 2 * target->at[d] + (o >> d & 1);
        for (unsigned q = 0; q < model->n_field; q++) target->u[q * mesh->n_cell + cell] = children->u[q][o];
        target->p[cell] = children->w[model->i_E][o];
    }
}

/* Fills a child from the prepared block of its parent; returns the number of limited coarse cells. */
static long long prolong_child(const struct prolong *prolong, const struct mesh *mesh, int l,
                               const struct prolong_birth *birth, struct prolong_target *target)
{
    const struct model *model = prolong->model;
    const struct level *coarse = &mesh->levels[l - 1], *fine = &mesh->levels[l];
    const struct tile *tile = &fine->tiles[birth->child];
    struct prolong_cells source = {model,           prolong->cells,   {0}, prolong->w, prolong->u,
                                   prolong->rho_c2, prolong->elastic, 0.0};
    const double *u_old = coarse->u_old[birth->parent - coarse->first];
    double columns[METRIC_CELLS / 2][2], turns[METRIC_CELLS / 2], mean[PROLONG_FIELDS];
    long long limited = 0;
    memcpy(source.stride, prolong->stride, sizeof source.stride);
    prolong_gives(mesh, fine, tile, columns, turns);
    size_t count = mesh->n_cell >> mesh->dim;
    for (size_t c = 0; c < count; c++) {
        size_t at = prolong->origin, cell = 0, step = 1, rest = c;
        for (int d = 0; d < mesh->dim; d++) {
            size_t half = (size_t)mesh->n[d] / 2, index = (size_t)(tile->at[d] & 1) * half + rest % half;
            target->at[d] = rest % half;
            at += index * prolong->stride[d];
            cell += index * step;
            step *= (size_t)mesh->n[d];
            rest /= half;
        }
        for (unsigned q = 0; q < model->n_field; q++) mean[q] = u_old[q * mesh->n_cell + cell];
        const double *column = columns[target->at[0]];
        source.turn = turns[target->at[0]];
        const double give[3][2] = {{column[0], column[1]}, {-0.125, 0.125}, {-0.125, 0.125}};
        struct prolong_children children;
        limited += prolong_cell_children(&source, at, mean, give, &children) < 1.0;
        prolong_store(mesh, model, &children, target);
    }
    return limited;
}

long long prolong_tiles(struct prolong *prolong, struct mesh *mesh, int l, struct bound *bound, const bool *born)
{
    const struct level *coarse = &mesh->levels[l - 1];
    struct level *fine = &mesh->levels[l];
    struct prolong_birth *births = mem_new(fine->n_known, sizeof *births);
    unsigned n = prolong_list(mesh, l, born, births), prepared = coarse->n_known;
    struct post *post = prolong_post(mesh, births, n);
    size_t block = mesh->n_field * mesh->n_cell, i_p = prolong->model->i_E * mesh->n_cell;
    long long limited = 0;
    for (const struct prolong_birth *birth = births; birth < births + n; birth++) {
        if (birth->from != comm_rank()) continue;
        bool away = birth->to != birth->from;
        unsigned local = birth->child - fine->first;
        struct prolong_target target = {.u = away ? post_out(post, birth->item) : fine->u_old[local]};
        target.p = away ? target.u + block : fine->w[local] + i_p;
        if (birth->parent != prepared) prolong_prepare(prolong, mesh, coarse, birth->parent - coarse->first, bound);
        prepared = birth->parent;
        limited += prolong_child(prolong, mesh, l, birth, &target);
    }
    post_start(post);
    post_finish(post);
    for (const struct prolong_birth *birth = births; birth < births + n; birth++) {
        if (birth->to != comm_rank() || birth->from == birth->to) continue;
        const double *made = post_in(post, birth->item);
        memcpy(fine->u_old[birth->child - fine->first], made, block * sizeof *made);
        memcpy(fine->w[birth->child - fine->first] + i_p, made + block, mesh->n_cell * sizeof *made);
    }
    post_free(post);
    mem_free(births);
    return limited;
}
