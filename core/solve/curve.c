/* curve.c - see curve.h. */
#include "solve/curve.h"

#include "base/mem.h"
#include "levels/prolong_rim.h"
#include "scheme/curvature.h"
#include "scheme/heights.h"
#include "scheme/patch_state.h"
#include "scheme/slant.h"

#include <string.h>

/* Least product of the fractions of a pair that makes a surface: below it its force is some 1e-6 of the whole one. */
#define CURVE_LEAST 1e-6

struct curve {
    const struct model *model;
    const struct mesh *mesh;
    int g; /* layers around a tile */
    struct curvature *room;
    double *patch; /* fractions around a tile; if there are three, then room for what is not one of them */
    double *slant; /* room for slants */
    struct box_block block;
    size_t pitch;
};

struct curve *curve_new(const struct model *model, const struct mesh *mesh)
{
    bool curved = model->n_pair > 0 && mesh->dim > 1, slanted = slant_acts(model);
    if (!curved && !slanted) return NULL;
    struct curve *curve = mem_new(1, sizeof *curve);
    curve->model = model;
    curve->mesh = mesh;
    curve->g = curved ? HEIGHTS_LAYERS : 1; /* three for columns through a cell, one for the mean with its neighbours */
    curve->block = rim_block(mesh, curve->g, NULL);
    curve->pitch = curve->block.pitch;
    curve->patch = mem_new((model->n_alpha + (model->n_alpha > 2 ? 1 : 0)) * curve->pitch, sizeof *curve->patch);
    if (curved) curve->room = curvature_new(mesh, curve->g);
    if (slanted) curve->slant = mem_new(((size_t)mesh->dim + 1) * curve->pitch, sizeof *curve->slant);
    return curve;
}

void curve_free(struct curve *curve)
{
    if (!curve) return;
    curvature_free(curve->room);
    mem_free(curve->patch);
    mem_free(curve->slant);
    mem_free(curve);
}

static struct patch_source curve_source(const struct curve *curve, int l)
{
    return patch_state_fractions(curve->model, curve->mesh, l, curve->g, 2);
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

/* On a coarser level lies nothing that heights can be taken of. */
static void curve_poor(const struct level *level, unsigned local, bool ret_poor[MESH_FACES])
{
    for (int face = 0; face < MESH_FACES; face++)
        ret_poor[face] = level->neighbours[local][face].kind == NEIGHBOUR_COARSE;
}

/* All fractions but that of material l. */
static const double *curve_rest(const struct curve *curve, unsigned l)
{
    size_t n = curve->pitch;
    double *rest = curve->patch + curve->model->n_alpha * n;
    memset(rest, 0, n * sizeof *rest);
    for (unsigned m = 0; m < curve->model->n_alpha; m++)
        for (size_t c = 0; m != l && c < n; c++) rest[c] += curve->patch[m * n + c];
    return rest;
}

static double curve_sigma(const struct model *model, unsigned one, unsigned other)
{
    const struct scene *scene = model->scene;
    for (unsigned k = 0; k < scene->n_tension; k++) {
        const struct scene_tension *pair = &scene->tension[k];
        if ((pair->one == one && pair->other == other) || (pair->one == other && pair->other == one))
            return pair->sigma;
    }
    return 0.0;
}

/* Share of the first of a pair in its tension, sigma_ab = gamma_a + gamma_b with gamma_a = (sigma_ab + sigma_ac -
 * sigma_bc)/2 among three materials; among more there are no such parts, and it is a half. */
static double curve_part(const struct model *model, const struct model_pair *pair)
{
    unsigned third = 3 - pair->inside - pair->outside;
    if (model->n_alpha != 3) return 0.5;
    double one = curve_sigma(model, pair->inside, third), other = curve_sigma(model, pair->outside, third);
    double part = 0.5 * (1.0 + (one - other) / pair->sigma);
    return part < 0.0 ? 0.0 : part > 1.0 ? 1.0 : part;
}

/* kappa of a pair, in the room. Where there are others, each of the two has its surface against all others, with its
 * part of the tension: at a line where three meet the pulls of their corners are in balance at Neumann's angles. The
 * turn of a corner is the sum of the kappa of its layers, so there none is carried, and columns see no corners. */
static void curve_pair(const struct curve *curve, const struct level *level, unsigned local,
                       const struct model_pair *pair, const double cosines[MESH_FACES], bool leans)
{
    const struct tile *tile = &level->tiles[level->first + local];
    const double *cosine = leans ? cosines : NULL;
    const double *a = curve->patch + pair->inside * curve->pitch, *b = curve->patch + pair->outside * curve->pitch;
    double other[MESH_FACES];
    bool poor[MESH_FACES];
    if (curve->model->n_alpha < 3) {
        curvature_take(curve->room, level, tile, a, b, cosine);
        curvature_carry(curve->room, level, tile);
        curve_poor(level, local, poor);
        curvature_heights(curve->room, level, tile, a, cosine, poor);
        return;
    }
    for (int face = 0; cosine && face < MESH_FACES; face++) other[face] = -cosine[face];
    curvature_take(curve->room, level, tile, a, curve_rest(curve, pair->inside), cosine);
    curvature_keep(curve->room);
    curvature_take(curve->room, level, tile, b, curve_rest(curve, pair->outside), cosine ? other : NULL);
    curvature_oppose(curve->room, curve_part(curve->model, pair));
}

/* Curvatures; the patch may be gathered already. */
static void curve_bend(struct curve *curve, const struct patch_source *source, unsigned local, bool gathered)
{
    const struct model *model = curve->model;
    const struct level *level = source->level;
    double *block = source->arrays[local];
    size_t n = curve->mesh->n_cell;
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
        curve_pair(curve, level, local, pair, cosine, leans);
        curvature_mean(curve->room, a, b, CURVE_LEAST, kappa);
    }
}

/* Slants, of primitives alone. Returns whether there are any, and with them the patch. */
static bool curve_lie(const struct curve *curve, const struct patch_source *source, unsigned local)
{
    const struct model *model = curve->model;
    size_t n = curve->mesh->n_cell;
    double *block = source->arrays[local], *slant = block + model->i_slant * n;
    if (!slant_acts(model) || source->arrays != source->level->w) return false;
    if (!slant_varies(model, n, block + model->i_alpha * n)) {
        memset(slant, 0, model->n_slant * n * sizeof *slant);
        return false;
    }
    patch_gather(source, local, curve->patch);
    slant_make(model, curve->mesh, &curve->block, source->level->h, curve->patch, curve->slant, slant);
    return true;
}

void curve_take(struct curve *curve, int l, double *const *arrays)
{
    if (!curve) return;
    struct patch_source source = curve_source(curve, l);
    source.arrays = arrays;
    patch_start(&source);
    patch_finish(&source);
    for (unsigned t = 0; t < source.level->n_local; t++) curve_bend(curve, &source, t, curve_lie(curve, &source, t));
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
