/* conduction_front.c - see conduction_front.h. */
#include "scheme/conduction_front.h"

#include "base/mem.h"
#include "bulla/module.h"
#include "phys/phase_pair.h"
#include "phys/row.h"
#include "scheme/conduction_channel.h"
#include "scheme/face.h"

#include <math.h>
#include <string.h>

/* The least distance to the surface, over that of the centres; what the step allows bounds it before in most scenes. */
#define CONDUCTION_FRONT_NEAR 0.02

/* Temperatures of liquid and vapour that are one behind a surface differ by less than this part. */
#define CONDUCTION_FRONT_ALIKE 0.1

/* Rows of one pair: share of vapour and gases in what it fills; above 0 where liquid is at a surface or behind, and as
 * warm as the vapour; what liquid, vapour and gases of a cell hold [J/(m3 K)]; conductivity of faces; 1 at faces
 * through which the surface warms its liquid. */
struct conduction_front_rows {
    double thin[FACE_ROOM], tied[FACE_ROOM], heat[FACE_ROOM], k[FACE_ROOM], warms[FACE_ROOM];
    bool there; /* the piece has vapour or gases of the pair */
};

/* Rows of all materials, with pitch FACE_ROOM: fractions as they were before liquids took in what is in them, and those
 * of the cells on the left and on the right of the faces. */
struct conduction_front {
    struct conduction_front_rows pair[SCENE_PHASES];
    double *rows, *own, *beside[2];
};

struct conduction_front *conduction_front_new(const struct model *model)
{
    bool wanted = false;
    for (unsigned k = 0; k < model->n_phase; k++) wanted = wanted || model->phases[k].scene->onset > 0.0;
    if (!wanted) return NULL;
    struct conduction_front *front = mem_new(1, sizeof *front);
    size_t block = model->n_material * (size_t)FACE_ROOM;
    front->own = front->rows = mem_new(3 * block, sizeof *front->rows);
    for (size_t side = 0; side < 2; side++) front->beside[side] = front->rows + (side + 1) * block;
    return front;
}

void conduction_front_free(struct conduction_front *front)
{
    if (front) mem_free(front->rows);
    mem_free(front);
}

/* How many cells are not liquid alone. Not how many are behind the surface: what a face lets through must not depend on
 * where a tile ends. */
static BULLA_KERNEL double conduction_front_count(size_t n, const double *restrict thin)
{
    double count = 0.0;
#pragma omp simd reduction(+ : count)
    for (size_t i = 0; i < n; i++) count += thin[i] > 0.0 ? 1.0 : 0.0;
    return count;
}

/* Liquid before the surface has the whole cell; nothing is left of what is in it. */
static BULLA_KERNEL void conduction_front_fill(size_t n, double half, const double *thin, const double *volume,
                                               double *restrict liquid)
{
#pragma omp simd
    for (size_t i = 0; i < n; i++) {
        double a = liquid[i], t = thin[i], whole = a + volume[i], filled = a > 0.0 ? whole : a;
        liquid[i] = t < half ? filled : a;
    }
}

static BULLA_KERNEL void conduction_front_empty(size_t n, double half, const double *restrict thin,
                                                const double *restrict liquid, double *restrict part)
{
#pragma omp simd
    for (size_t i = 0; i < n; i++) {
        double a = part[i], left = liquid[i] > 0.0 ? 0.0 : a;
        part[i] = thin[i] < half ? left : a;
    }
}

/* Beside other materials: of what liquid, vapour and gases fill. A trace of liquid in air and vapour is no liquid. */
static BULLA_KERNEL void conduction_front_share(size_t n, const double *restrict liquid, const double *restrict volume,
                                                double *restrict thin)
{
#pragma omp simd
    for (size_t i = 0; i < n; i++) {
        double t = volume[i], share = t / (t + liquid[i]);
        thin[i] = t > 0.0 ? share : 0.0;
    }
}

static bool conduction_front_pair(const struct model_phase *phase, bool others, size_t n, double *part, double *own,
                                  struct conduction_front_rows *rows)
{
    double half = phase_pair_front(phase->scene), *liquid = part + phase->member[0] * (size_t)FACE_ROOM;
    double *thin = rows->thin, *volume = others ? rows->heat : thin; /* until heat is weighed */
    memset(volume, 0, n * sizeof *volume);
    for (unsigned j = 1; j < phase->n; j++) row_add(n, part + phase->member[j] * (size_t)FACE_ROOM, volume);
    if (conduction_front_count(n, volume) == 0.0) return false;
    if (others) conduction_front_share(n, liquid, volume, thin);
    for (unsigned j = 0; j < phase->n; j++) {
        size_t row = phase->member[j] * (size_t)FACE_ROOM;
        memcpy(own + row, part + row, n * sizeof *own);
    }
    conduction_front_fill(n, half, thin, volume, liquid);
    for (unsigned j = 1; j < phase->n; j++)
        conduction_front_empty(n, half, thin, liquid, part + phase->member[j] * (size_t)FACE_ROOM);
    return true;
}

bool conduction_front_look(struct conduction_front *front, const struct model *path, size_t n, double *part)
{
    bool any = false;
    for (unsigned k = 0; k < path->n_phase && front; k++) {
        struct conduction_front_rows *rows = &front->pair[k];
        const struct model_phase *phase = &path->phases[k];
        bool others = path->scene->n_material > phase->n; /* not of the path: all tiles find the same */
        rows->there = phase->scene->onset > 0.0 && conduction_front_pair(phase, others, n, part, front->own, rows);
        any = any || rows->there;
    }
    return any;
}

/* tied: in, how much liquid and vapour share one temperature (conduction_channel_wet). Behind the surface they need not
 * quite; but what a hot trace of vapour has above its liquid is not the heat of both. */
static BULLA_KERNEL void conduction_front_tie(size_t n, double half, double onset, const double *restrict thin,
                                              const struct conduction_channel_side *l,
                                              const struct conduction_channel_side *v, double *restrict tied)
{
    const double *restrict liquid = l->part, *restrict vapour = v->part, *restrict T_l = l->T, *restrict T_v = v->T;
#pragma omp simd
    for (size_t i = 0; i < n; i++) {
        double t = thin[i], one = tied[i], T = T_l[i], apart = fabs(T_v[i] - T), steam = vapour[i], water = liquid[i];
        double near = apart < CONDUCTION_FRONT_ALIKE * T ? 1.0 : one, alike = steam > 0.0 ? near : 1.0;
        double behind = t < onset ? alike : one, there = water > 0.0 ? behind : 0.0;
        tied[i] = t < half ? 0.0 : there;
    }
}

static BULLA_KERNEL void conduction_front_hold(size_t n, const double *restrict part, const double *restrict c,
                                               double *restrict heat)
{
#pragma omp simd
    for (size_t i = 0; i < n; i++) {
        double a = part[i], sum = heat[i], more = sum + a * c[i];
        heat[i] = a > 0.0 ? more : sum;
    }
}

void conduction_front_weigh(struct conduction_front *front, const struct model *path, size_t n, const double *part,
                            const double *c, const double *T)
{
    for (unsigned k = 0; k < path->n_phase; k++) {
        const struct model_phase *phase = &path->phases[k];
        struct conduction_front_rows *rows = &front->pair[k];
        size_t liquid = phase->member[0] * (size_t)FACE_ROOM, vapour = phase->member[1] * (size_t)FACE_ROOM;
        if (!(phase->scene->onset > 0.0)) continue;
        const struct conduction_channel_side l = {.part = part + liquid, .T = T + liquid},
                                             v = {.part = part + vapour, .T = T + vapour};
        conduction_channel_wet(n, &l, &v, rows->tied);
        conduction_front_tie(n, phase_pair_front(phase->scene), phase->scene->onset, rows->thin, &l, &v, rows->tied);
        memset(rows->heat, 0, n * sizeof *rows->heat);
        for (unsigned j = 0; j < phase->n; j++) {
            size_t row = phase->member[j] * (size_t)FACE_ROOM;
            conduction_front_hold(n, part + row, c + row, rows->heat);
        }
    }
}

/* Between the last cell of liquid and the surface: k_l/d. */
static BULLA_KERNEL void conduction_front_touch(size_t n, double half, double most, const double *restrict thin_l,
                                                const double *restrict thin_r, const double *restrict tied_l,
                                                const double *restrict tied_r, const double *restrict k_l,
                                                const double *restrict k_r, const double *restrict c_l,
                                                const double *restrict c_r, double *restrict k)
{
#pragma omp simd
    for (size_t i = 0; i < n; i++) {
        double a = thin_l[i], b = thin_r[i], kl = k_l[i], kr = k_r[i], cl = c_l[i], cr = c_r[i];
        double tl = tied_l[i], tr = tied_r[i];
        double before = a < b ? a : b, behind = a < b ? b : a, tied = a < b ? tr : tl;
        double way = (half - before) / (behind - before), d = way > CONDUCTION_FRONT_NEAR ? way : CONDUCTION_FRONT_NEAR;
        double wanted = (a < b ? kl : kr) / d, limit = 0.5 * most * (a < b ? cl : cr);
        double kept = limit < wanted ? limit : wanted, passes = before < half ? kept : 0.0;
        k[i] = tied > 0.0 ? passes : 0.0;
    }
}

/* Between two cells behind the surface, one of which is not yet thin enough to evaporate: as fast as the step allows.
 */
static BULLA_KERNEL void conduction_front_pass(size_t n, double onset, double most, const double *restrict thin_l,
                                               const double *restrict thin_r, const double *restrict tied_l,
                                               const double *restrict tied_r, const double *restrict heat_l,
                                               const double *restrict heat_r, double *restrict k)
{
#pragma omp simd
    for (size_t i = 0; i < n; i++) {
        double a = heat_l[i], b = heat_r[i], touches = k[i], limit = 0.5 * most * (a * b / (a + b));
        double least = thin_l[i] < thin_r[i] ? thin_l[i] : thin_r[i], both = tied_l[i] * tied_r[i];
        double passes = least < onset ? limit : touches;
        k[i] = both > 0.0 ? passes : touches;
    }
}

/* Of two cells with liquid the wetter one is the colder: the surface warms its liquid. At how many faces. */
static BULLA_KERNEL double conduction_front_warm(size_t n, const double *restrict thin_l, const double *restrict thin_r,
                                                 const double *restrict liquid_l, const double *restrict liquid_r,
                                                 const double *restrict T_l, const double *restrict T_r,
                                                 double *restrict warms)
{
    double count = 0.0;
#pragma omp simd reduction(+ : count)
    for (size_t i = 0; i < n; i++) {
        double both = liquid_l[i] * liquid_r[i], into = (thin_r[i] - thin_l[i]) * (T_r[i] - T_l[i]);
        double wet = both > 0.0 ? 1.0 : 0.0, here = into > 0.0 ? wet : 0.0;
        warms[i] = here;
        count += here;
    }
    return count;
}

/* Where `warms`, take `own`. */
static BULLA_KERNEL void conduction_front_choose(size_t n, const double *restrict warms, const double *restrict own,
                                                 double *restrict value)
{
#pragma omp simd
    for (size_t i = 0; i < n; i++) {
        double a = own[i], b = value[i];
        value[i] = warms[i] > 0.0 ? a : b;
    }
}

/* The fractions on both sides of faces, as they are in cells where the surface warms its liquid. */
static void conduction_front_mend(struct conduction_front *front, const struct model *path, size_t n, size_t step,
                                  const double *ret_part[2])
{
    for (size_t side = 0; side < 2; side++) {
        for (size_t row = 0; row < path->n_material * (size_t)FACE_ROOM; row += FACE_ROOM)
            memcpy(front->beside[side] + row, ret_part[side] + row, n * sizeof **ret_part);
        for (unsigned p = 0; p < path->n_phase; p++)
            for (unsigned j = 0; j < path->phases[p].n && front->pair[p].there; j++) {
                size_t row = path->phases[p].member[j] * (size_t)FACE_ROOM;
                conduction_front_choose(n, front->pair[p].warms, front->own + row + side * step,
                                        front->beside[side] + row);
            }
        ret_part[side] = front->beside[side];
    }
}

static const double conduction_front_none[FACE_ROOM];

void conduction_front_turn(struct conduction_front *front, const struct model *path, size_t n, size_t step,
                           const double *T, const double *ret_part[2])
{
    double any = 0.0;
    for (unsigned p = 0; p < path->n_phase; p++) {
        struct conduction_front_rows *at = &front->pair[p];
        size_t row = path->phases[p].member[0] * (size_t)FACE_ROOM;
        if (!at->there) continue;
        const double *liquid = front->own + row, *warmth = T + row;
        any += conduction_front_warm(n, at->thin, at->thin + step, liquid, liquid + step, warmth, warmth + step,
                                     at->warms);
        conduction_front_choose(n, at->warms, conduction_front_none, at->k);
    }
    if (any > 0.0) conduction_front_mend(front, path, n, step, ret_part);
}

void conduction_front_meet(struct conduction_front *front, const struct model *path, size_t n, size_t step, double most,
                           const double *k, const double *c)
{
    for (unsigned p = 0; p < path->n_phase; p++) {
        const struct model_phase *phase = &path->phases[p];
        struct conduction_front_rows *at = &front->pair[p];
        const double *k_l = k + phase->member[0] * (size_t)FACE_ROOM, *c_l = c + phase->member[0] * (size_t)FACE_ROOM;
        if (!(phase->scene->onset > 0.0)) continue;
        conduction_front_touch(n, phase_pair_front(phase->scene), most, at->thin, at->thin + step, at->tied,
                               at->tied + step, k_l, k_l + step, c_l, c_l + step, at->k);
        conduction_front_pass(n, phase->scene->onset, most, at->thin, at->thin + step, at->tied, at->tied + step,
                              at->heat, at->heat + step, at->k);
    }
}

static BULLA_KERNEL void conduction_front_put(size_t n, const double *restrict at_front, double *restrict k)
{
#pragma omp simd
    for (size_t i = 0; i < n; i++) {
        double here = at_front[i], old = k[i];
        k[i] = here > 0.0 ? here : old;
    }
}

static bool conduction_front_has(const struct model_phase *phase, unsigned l)
{
    bool has = false;
    for (unsigned j = 0; j < phase->n; j++) has = has || phase->member[j] == l;
    return has;
}

void conduction_front_take(const struct conduction_front *front, const struct model *path, unsigned l, unsigned m,
                           size_t n, double *k_lm)
{
    for (unsigned p = 0; p < path->n_phase; p++) {
        const struct model_phase *phase = &path->phases[p];
        if (!(phase->scene->onset > 0.0) || !conduction_front_has(phase, l) || !conduction_front_has(phase, m))
            continue;
        conduction_front_put(n, front->pair[p].k, k_lm);
    }
}
