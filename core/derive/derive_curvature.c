/* derive_curvature.c - see derive_curvature.h. Corners lie between 2^dim cells; along axes that are not used both
 * cells of a pair are the same one, which leaves means as they are. Sums of four begin with opposite ones, so
 * that mirrors and the exchange of axes keep all bits. */
#include "derive/derive_curvature.h"

#include "base/mem.h"
#include "levels/prolong_rim.h"
#include "mesh/metric.h"
#include "scheme/patch_state.h"

#include <math.h>
#include <string.h>

/* One to average fractions, one for the normals. */
enum { CURVATURE_LAYERS = 2 };

/* Exponent of psi. */
#define CURVATURE_SHARPNESS 0.1

/* Least fraction, of the material and of all others, that makes a surface. */
#define CURVATURE_LEAST 1e-2

/* Least difference of psi over a cell that says where the surface looks. */
#define CURVATURE_FLAT 1e-3

/* Inflows bring their own fractions. */
static void derive_curvature_given(void *data, unsigned local, int face, const struct box_block *ret)
{
    const struct model *model = data;
    const struct scene_boundary *boundary = &model->scene->domain.boundary[face / 2][face % 2];
    (void)local;
    for (unsigned l = 0; l < model->n_alpha; l++)
        for (size_t c = 0; c < ret->pitch; c++) ret->data[l * ret->pitch + c] = boundary->fractions[l];
}

/* The fractions, which are the first of the primitives. */
static struct patch_source derive_curvature_source(const struct model *model, const struct mesh *mesh,
                                                   const struct level *level)
{
    struct patch_source source = {
        .mesh = mesh, .level = level, .arrays = level->w, .given = derive_curvature_given, .data = (void *)model};
    patch_state_rules(model->scene, false, source.rules);
    for (int face = 0; face < 2 * mesh->dim; face++)
        if (model->scene->domain.boundary[face / 2][face % 2].type == SCENE_INFLOW) source.rules[face] = PATCH_GIVEN;
    const struct rim_form form = {model->n_alpha, CURVATURE_LAYERS, 1, patch_given(source.rules), NULL};
    source.rim = rim_of(mesh, (int)(level - mesh->levels), &form);
    return source;
}

void derive_curvature_exchange(const struct model *model, const struct mesh *mesh)
{
    if (!model->n_alpha) return;
    for (int l = 0; l < mesh->n_level; l++) {
        const struct patch_source source = derive_curvature_source(model, mesh, &mesh->levels[l]);
        patch_start(&source);
        patch_finish(&source);
        if (l + 1 == mesh->n_level) break;
        struct rim *fine = derive_curvature_source(model, mesh, &mesh->levels[l + 1]).rim;
        prolong_rim(&source, fine, 0, NULL);
        rim_down(fine);
    }
}

/* Fractions may leave [0, 1] by a rounding. */
static double derive_curvature_psi(double a)
{
    double some = a > 0.0 ? pow(a, CURVATURE_SHARPNESS) : 0.0, rest = a < 1.0 ? pow(1.0 - a, CURVATURE_SHARPNESS) : 0.0;
    return some / (some + rest);
}

/* A box of numbers, x fastest; a stride is 0 along axes that are not used. */
struct derive_curvature_grid {
    size_t n[3], stride[3];
};

static struct derive_curvature_grid derive_curvature_grid(const struct mesh *mesh, int more)
{
    struct derive_curvature_grid grid = {{1, 1, 1}, {0, 0, 0}};
    size_t stride = 1;
    for (int d = 0; d < mesh->dim; d++) {
        grid.n[d] = (size_t)(mesh->n[d] + more);
        grid.stride[d] = stride;
        stride *= grid.n[d];
    }
    return grid;
}

static size_t derive_curvature_at(const struct derive_curvature_grid *grid, size_t i, size_t j, size_t k)
{
    return i * grid->stride[0] + j * grid->stride[1] + k * grid->stride[2];
}

/* Mean of four numbers, at the ends of two strides. */
static double derive_curvature_mean(const double *v, size_t a, size_t b)
{
    return 0.25 * ((v[0] + v[a + b]) + (v[a] + v[b]));
}

/* Means of the numbers around each place of a grid with one place less along each axis: from cells to corners, and from
 * corners to cells. */
static void derive_curvature_between(const struct mesh *mesh, int more, const double *from, double *ret)
{
    const struct derive_curvature_grid of = derive_curvature_grid(mesh, more);
    const struct derive_curvature_grid to = derive_curvature_grid(mesh, more - 1);
    for (size_t k = 0; k < to.n[2]; k++)
        for (size_t j = 0; j < to.n[1]; j++)
            for (size_t i = 0; i < to.n[0]; i++) {
                const double *at = from + derive_curvature_at(&of, i, j, k);
                double low = derive_curvature_mean(at, of.stride[0], of.stride[1]);
                double high = derive_curvature_mean(at + of.stride[2], of.stride[0], of.stride[1]);
                ret[derive_curvature_at(&to, i, j, k)] = 0.5 * (low + high);
            }
}

/* Unit normals at the corners: normal[axis][corner]. psi has one cell around the tile. */
static void derive_curvature_normals(const struct derive_view *tile, const double *psi, double *const normal[3])
{
    const struct derive_curvature_grid corners = derive_curvature_grid(tile->mesh, 1);
    const struct derive_curvature_grid cells = derive_curvature_grid(tile->mesh, 2);
    const double *h = tile->level->h;
    for (size_t k = 0; k < corners.n[2]; k++)
        for (size_t j = 0; j < corners.n[1]; j++)
            for (size_t i = 0; i < corners.n[0]; i++) {
                const double *at = psi + derive_curvature_at(&cells, i, j, k);
                double g[3] = {0.0}, length2;
                for (int d = 0; d < tile->mesh->dim; d++) {
                    size_t a = cells.stride[(d + 1) % 3], b = cells.stride[(d + 2) % 3];
                    double up = derive_curvature_mean(at + cells.stride[d], a, b);
                    g[d] = (up - derive_curvature_mean(at, a, b)) * (h[0] / h[d]);
                }
                length2 = (g[0] * g[0] + g[1] * g[1]) + g[2] * g[2];
                bool flat = length2 <= CURVATURE_FLAT * CURVATURE_FLAT;
                for (int d = 0; d < tile->mesh->dim; d++)
                    normal[d][derive_curvature_at(&corners, i, j, k)] = flat ? 0.0 : g[d] / sqrt(length2);
            }
}

/* -div n of a cell from the means of n over its faces. */
static double derive_curvature_cell(const struct derive_view *tile, const struct metric *metric,
                                    const struct derive_curvature_grid *corners, size_t at, size_t column,
                                    double *const normal[3])
{
    double part[3] = {0.0};
    for (int d = 0; d < tile->mesh->dim; d++) {
        size_t a = corners->stride[(d + 1) % 3], b = corners->stride[(d + 2) % 3];
        double low = derive_curvature_mean(normal[d] + at, a, b);
        double high = derive_curvature_mean(normal[d] + at + corners->stride[d], a, b);
        part[d] = d > 0 ? (high - low) / tile->level->h[d]
                        : (metric->area[column + 1] * high - metric->area[column] * low) / metric->volume[column];
    }
    return 0.0 - ((part[0] + part[1]) + part[2]); /* no -0 */
}

/* Where psi is that of a surface; else 0. */
static void derive_curvature_cells(const struct derive_view *tile, const double *psi, double *const normal[3],
                                   double *out)
{
    const struct derive_curvature_grid corners = derive_curvature_grid(tile->mesh, 1);
    const struct derive_curvature_grid cells = derive_curvature_grid(tile->mesh, 2);
    const double *first = psi + cells.stride[0] + cells.stride[1] + cells.stride[2];
    double low = derive_curvature_psi(CURVATURE_LEAST), high = derive_curvature_psi(1.0 - CURVATURE_LEAST);
    size_t n0 = (size_t)tile->mesh->n[0], n1 = (size_t)tile->mesh->n[1];
    struct metric metric;
    metric_of_tile(tile->mesh, tile->level, &tile->level->tiles[tile->level->first + tile->local], &metric);
    for (size_t c = 0; c < tile->n; c++) {
        size_t i = c % n0, j = c / n0 % n1, k = c / n0 / n1, at = derive_curvature_at(&corners, i, j, k);
        double here = first[derive_curvature_at(&cells, i, j, k)];
        out[c] = here < low || here > high ? 0.0 : derive_curvature_cell(tile, &metric, &corners, at, i, normal);
    }
}

/* Is there a surface in or beside the tile? Most have none. */
static bool derive_curvature_is_mixed(size_t n, const double *a)
{
    double least = a[0], most = a[0];
    for (size_t i = 1; i < n; i++) {
        least = a[i] < least ? a[i] : least;
        most = a[i] > most ? a[i] : most;
    }
    return most >= CURVATURE_LEAST && least <= 1.0 - CURVATURE_LEAST;
}

void derive_curvature(const struct derive_view *tile, double *out)
{
    memset(out, 0, tile->n * sizeof *out);
    if (!tile->model->n_alpha) return;
    const struct patch_source source = derive_curvature_source(tile->model, tile->mesh, tile->level);
    size_t cells = patch_block(tile->mesh, CURVATURE_LAYERS, NULL).pitch, all = tile->model->n_alpha * cells;
    double *alpha = mem_new(all + 3 * cells, sizeof *alpha), *psi = alpha + (size_t)tile->field->index * cells;
    double *const normal[3] = {alpha + all, alpha + all + cells, alpha + all + 2 * cells};
    patch_gather(&source, tile->local, alpha);
    if (derive_curvature_is_mixed(cells, psi)) {
        derive_curvature_between(tile->mesh, 4, psi, normal[0]);
        derive_curvature_between(tile->mesh, 3, normal[0], psi);
        for (size_t c = 0; c < cells; c++) psi[c] = derive_curvature_psi(psi[c]);
        derive_curvature_normals(tile, psi, normal);
        derive_curvature_cells(tile, psi, normal, out);
    }
    mem_free(alpha);
}
