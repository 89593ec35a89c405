/* curve.c - see curve.h. */
#include "solve/curve.h"

#include "base/mem.h"
#include "levels/prolong_rim.h"
#include "scheme/curvature.h"
#include "scheme/patch_state.h"

#include <string.h>

/* Two for a cell's own curvature, one for the mean with its neighbours'. */
enum { CURVE_LAYERS = 3 };

/* Least product of the fractions of a pair that makes a surface: below it its force is some 1e-6 of the whole one. */
#define CURVE_LEAST 1e-6

struct curve {
    const struct model *model;
    const struct mesh *mesh;
    struct curvature *room;
    double *patch; /* fractions around a tile */
    size_t pitch;
};

struct curve *curve_new(const struct model *model, const struct mesh *mesh)
{
    if (!model->n_pair || mesh->dim == 1) return NULL;
    struct curve *curve = mem_new(1, sizeof *curve);
    curve->model = model;
    curve->mesh = mesh;
    curve->room = curvature_new(mesh, CURVE_LAYERS);
    curve->pitch = patch_block(mesh, CURVE_LAYERS, NULL).pitch;
    curve->patch = mem_new(model->n_alpha * curve->pitch, sizeof *curve->patch);
    return curve;
}

void curve_free(struct curve *curve)
{
    if (!curve) return;
    curvature_free(curve->room);
    mem_free(curve->patch);
    mem_free(curve);
}

static struct patch_source curve_source(const struct curve *curve, int l)
{
    return patch_state_fractions(curve->model, curve->mesh, l, CURVE_LAYERS, 2);
}

/* Cells of a tile that hold a surface of the pair. */
static BULLA_KERNEL int curve_count(size_t n, const double *restrict a, const double *restrict b)
{
    int count = 0;
#pragma omp simd reduction(+ : count)
    for (size_t i = 0; i < n; i++) count += a[i] * b[i] > CURVE_LEAST;
    return count;
}

/* The walls at a tile that give the surface of pair k an angle: false: none. */
static bool curve_walls(const struct curve *curve, const struct patch_source *source, unsigned local, unsigned k,
                        double ret_cosine[MESH_FACES])
{
    const struct level *level = source->level;
    const struct tile *tile = &level->tiles[level->first + local];
    bool some = false;
    for (int face = 0; face < MESH_FACES; face++) {
        int axis = face / 2, last = level->extent[axis] - 1;
        bool there = tile->at[axis] == (face % 2 ? last : 0);
        ret_cosine[face] = there ? curve->model->scene->domain.boundary[axis][face % 2].cosine[k] : 0.0;
        some = some || ret_cosine[face] != 0.0;
    }
    return some;
}

static void curve_tile(struct curve *curve, const struct patch_source *source, unsigned local)
{
    const struct model *model = curve->model;
    const struct level *level = source->level;
    double *block = source->arrays[local];
    size_t n = curve->mesh->n_cell;
    bool gathered = false;
    for (unsigned k = 0; k < model->n_pair; k++) {
        const struct model_pair *pair = &model->pairs[k];
        const double *a = curve->patch + pair->inside * curve->pitch, *b = curve->patch + pair->outside * curve->pitch;
        double *kappa = block + pair->i_kappa * n;
        if (!curve_count(n, block + pair->inside * n, block + pair->outside * n)) {
            memset(kappa, 0, n * sizeof *kappa);
            continue;
        }
        if (!gathered) patch_gather(source, local, curve->patch);
        gathered = true;
        double cosine[MESH_FACES];
        bool leans = curve_walls(curve, source, local, k, cosine);
        curvature_take(curve->room, level, &level->tiles[level->first + local], a, b, leans ? cosine : NULL);
        curvature_mean(curve->room, a, b, CURVE_LEAST, kappa);
    }
}

void curve_take(struct curve *curve, int l, double *const *arrays)
{
    if (!curve) return;
    struct patch_source source = curve_source(curve, l);
    source.arrays = arrays;
    patch_start(&source);
    patch_finish(&source);
    for (unsigned t = 0; t < source.level->n_local; t++) curve_tile(curve, &source, t);
}

void curve_finer(struct curve *curve, int l, int slot)
{
    if (!curve) return;
    const struct patch_source source = curve_source(curve, l);
    prolong_rim(&source, curve_source(curve, l + 1).rim, slot, NULL);
}

void curve_down(struct curve *curve, int l)
{
    if (curve) rim_down(curve_source(curve, l).rim);
}
