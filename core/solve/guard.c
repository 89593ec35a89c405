/* guard.c - see guard.h. The fast pass only counts; places and causes are worked out in the
 * rare tile that has a bad cell. */
#include "solve/guard.h"

#include "base/mem.h"
#include "mesh/halo.h"
#include "phys/elastic.h"
#include "phys/mix.h"
#include "phys/relax.h"
#include "phys/soft.h"
#include "solve/guard_name.h"
#include "solve/soften.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

enum { GUARD_BATCH = SOFTEN_BATCH };

struct guard *guard_new(const struct model *model, const struct mesh *mesh, int l)
{
    struct guard *guard = mem_new(1, sizeof *guard);
    const struct level *level = &mesh->levels[l];
    *guard = (struct guard){
        .model = model, .mesh = mesh, .level = level, .l = l, .n_local = level->n_local, .debt = GUARD_ROUND_OFF};
    guard->repair = model->n_alpha > 1 && model->scene->scheme.guard != SCENE_GUARD_STRICT;
    guard->mask = mem_new(level->n_local, sizeof *guard->mask);
    guard->fresh = mem_new(level->n_local, sizeof *guard->fresh);
    guard->halo = halo_new(mesh, level, 1);
    return guard;
}

void guard_free(struct guard *guard)
{
    if (!guard) return;
    for (unsigned t = 0; t < guard->n_local; t++) mem_free(guard->mask[t]);
    for (unsigned t = 0; t < guard->n_local; t++) mem_free(guard->fresh[t]);
    mem_free(guard->mask);
    mem_free(guard->fresh);
    halo_free(guard->halo);
    mem_free(guard->kept);
    mem_free(guard);
}

/* Most runs never mark a cell: masks get memory with the first one. */
static void guard_allow_marks(struct guard *guard)
{
    if (guard->marked) return;
    for (unsigned t = 0; t < guard->n_local && !guard->mask[t]; t++) {
        guard->mask[t] = mem_new(guard->mesh->n_cell, sizeof **guard->mask);
        guard->fresh[t] = mem_new(guard->mesh->n_cell, sizeof **guard->fresh);
    }
    guard->marked = true;
}

void guard_clear(struct guard *guard)
{
    for (unsigned t = 0; guard->marked && t < guard->n_local; t++) {
        memset(guard->mask[t], 0, guard->mesh->n_cell * sizeof **guard->mask);
        memset(guard->fresh[t], 0, guard->mesh->n_cell * sizeof **guard->fresh);
    }
    guard->marked = guard->masked = false;
}

void guard_attempt(struct guard *guard)
{
    memset(guard->bad, 0, sizeof guard->bad);
    guard->relaxed = 0;
    guard->cause[0] = '\0';
}

/* 1 where a cell is bad; written so that a NaN counts as bad. */
static BULLA_KERNEL void guard_mixture(size_t n, const double *restrict energy, const double *restrict p,
                                       const double *restrict c2, double *restrict bad)
{
#pragma omp simd
    for (size_t i = 0; i < n; i++) {
        double e = energy[i] - energy[i], q = p[i] - p[i], c = c2[i] - c2[i], s = c2[i];
        double good = e == 0.0 ? 1.0 : 0.0;
        good = q == 0.0 ? good : 0.0;
        good = c == 0.0 ? good : 0.0;
        good = s > 0.0 ? good : 0.0;
        bad[i] = 1.0 - good;
    }
}

static BULLA_KERNEL void guard_material(size_t n, const double *restrict m, const double *restrict alpha,
                                        const double *restrict rho_c2, const double *restrict rho, double fill,
                                        double debt, double *restrict bad)
{
#pragma omp simd
    for (size_t i = 0; i < n; i++) {
        double mass = m[i], a = alpha[i], s = rho_c2[i], r = rho[i], b = bad[i];
        r = r > fill ? r : fill;
        double good = mass >= -debt * r ? 1.0 : 0.0;
        double stiff = s > 0.0 ? 1.0 : 0.0;
        stiff = a > GUARD_PRESENT ? stiff : 1.0;
        bad[i] = b + (1.0 - good * stiff);
    }
}

/* A fraction that its mass has left: fluxes take it for none (phys/mix.h), so it can only grow, and the energy with
 * it. */
static BULLA_KERNEL void guard_void(size_t n, const double *restrict m, const double *restrict alpha,
                                    double *restrict bad)
{
#pragma omp simd
    for (size_t i = 0; i < n; i++) {
        double mass = m[i], a = alpha[i], b = bad[i];
        double empty = mass > 0.0 ? 0.0 : 1.0;
        bad[i] = b + (a > GUARD_PRESENT ? empty : 0.0);
    }
}

static BULLA_KERNEL void guard_single(size_t n, const double *restrict rho, double *restrict bad)
{
#pragma omp simd
    for (size_t i = 0; i < n; i++) {
        double r = rho[i], b = bad[i];
        bad[i] = b + (r > 0.0 ? 0.0 : 1.0);
    }
}

static void guard_density(const struct model *model, size_t n, size_t stride, const double *u, double *rho)
{
    for (unsigned l = 0; l < model->n_material; l++)
        for (size_t i = 0; i < n; i++) rho[i] = (l ? rho[i] : 0.0) + u[(model->i_m + l) * stride + i];
}

void guard_where(const struct guard *guard, unsigned local, size_t cell, char ret_text[GUARD_WHERE])
{
    const struct mesh *mesh = guard->mesh;
    const struct level *level = guard->level;
    const struct tile *at = &level->tiles[level->first + local];
    size_t i[3];
    double x[3];
    mesh_corner(mesh, level, at, x);
    for (size_t d = 0, rest = cell; d < 3; rest /= (size_t)mesh->n[d], d++) {
        i[d] = rest % (size_t)mesh->n[d];
        x[d] = (int)d < mesh->dim ? x[d] + ((double)i[d] + 0.5) * level->h[d] : 0.0;
    }
    snprintf(ret_text, GUARD_WHERE,
             "the cell at (%.9g, %.9g, %.9g) m of level %d (cell (%zu, %zu, %zu) of tile (%d, %d, %d))", x[0], x[1],
             x[2], guard->l, i[0], i[1], i[2], at->at[0], at->at[1], at->at[2]);
}

static void guard_describe(struct guard *guard, const struct guard_tile *tile, size_t cell)
{
    struct guard_name fault;
    char where[GUARD_WHERE];
    guard_name_find(tile, guard->mesh->n_cell, cell, &fault);
    guard_where(guard, tile->local, cell, where);
    snprintf(guard->cause, sizeof guard->cause, "%s = %.6g%s, in %s, after stage %d", fault.field, fault.value,
             fault.words, where, tile->stage + 1);
    guard->found = (struct guard_place){.local = tile->local,
                                        .stage = tile->stage,
                                        .pure = model_number(tile->model),
                                        .cell = cell,
                                        .value = fault.value};
    memcpy(guard->found.field, fault.field, sizeof guard->found.field);
    memcpy(guard->found.words, guard->cause, sizeof guard->found.words);
}

/* Has the tile a bad cell that is the first of the attempt? */
static bool guard_is_first(const struct guard *guard, const struct guard_tile *tile)
{
    return !guard->cause[0] || tile->local < guard->found.local;
}

/* Keeps a tile as it came, before its first bad cell is touched. */
static void guard_keep(struct guard *guard, const struct guard_tile *tile)
{
    size_t block = guard->model->n_field * guard->mesh->n_cell;
    if (!guard->kept) guard->kept = mem_new(2 * block, sizeof *guard->kept);
    memcpy(guard->kept, tile->u, block * sizeof *tile->u);
    memcpy(guard->kept + block, tile->w, block * sizeof *tile->w);
}

/* Fractions of material l that are judged where materials have pressures of their own (phys/traction.h): in a cell with
 * more solid than anything else, what fluid there is need not bear the tension of the solid. Its fraction is carried
 * along. */
static const double *guard_borne(const struct model *model, size_t n, size_t n_cell, const double *w, unsigned l,
                                 double *alpha)
{
    double solid[GUARD_BATCH];
    elastic_sum(model, n, n_cell, w + model->i_alpha * n_cell, solid);
    for (unsigned s = 0; s < model->n_solid; s++)
        if (model->solids[s].material == l) return w + (model->i_alpha + l) * n_cell;
    for (size_t i = 0; i < n; i++) alpha[i] = solid[i] > 0.5 ? 0.0 : w[(model->i_alpha + l) * n_cell + i];
    return alpha;
}

/* Whole numbers: their sum is the same in any order. */
static BULLA_KERNEL double guard_count(size_t n, const double *restrict bad)
{
    double count = 0.0;
#pragma omp simd reduction(+ : count)
    for (size_t i = 0; i < n; i++) count += bad[i];
    return count;
}

/* The checks on n cells from `from`; bad[i] > 0 where one fails. Returns their sum. */
static double guard_judge(const struct guard *guard, const struct guard_tile *tile, size_t from, size_t n, double *bad)
{
    const struct model *model = tile->model;
    size_t n_cell = guard->mesh->n_cell;
    double rho[GUARD_BATCH], borne[GUARD_BATCH];
    guard_mixture(n, tile->u + model->i_E * n_cell + from, tile->w + model->i_E * n_cell + from, tile->c2 + from, bad);
    if (model->n_alpha) guard_density(model, n, n_cell, tile->u + from, rho);
    else guard_single(n, tile->u + model->i_m * n_cell + from, bad);
    for (unsigned l = 0; l < model->n_alpha; l++) {
        const double *alpha = tile->w + (model->i_alpha + l) * n_cell + from;
        if (model->split) alpha = guard_borne(model, n, n_cell, tile->w + from, l, borne);
        guard_material(n, tile->u + (model->i_m + l) * n_cell + from, alpha, tile->rho_c2 + l * n_cell + from, rho,
                       model->eos[l].rho_fill, guard->debt, bad);
        guard_void(n, tile->u + (model->i_m + l) * n_cell + from, tile->u + (model->i_alpha + l) * n_cell + from, bad);
    }
    return guard_count(n, bad);
}

/* Speeds of one cell, anew; true if it is admissible. */
static bool guard_again(struct guard *guard, const struct guard_tile *tile, size_t cell)
{
    size_t n_cell = guard->mesh->n_cell;
    double bad;
    mix_stiffness(tile->model, 1, n_cell, tile->w + cell, tile->rho_c2 + cell);
    mix_speed2(tile->model, 1, n_cell, tile->w + cell, tile->rho_c2 + cell, tile->c2 + cell);
    return guard_judge(guard, tile, cell, 1, &bad) == 0.0;
}

/* Is nothing wrong with a cell but masses below zero that were so low before the step? What was round-off of the cell
 * that left them is more than that once the cell weighs less; fluxes cannot take it away (the material counts as
 * absent), and no smaller step would help. */
static bool guard_owes(const struct guard *guard, const struct guard_tile *tile, size_t cell)
{
    const struct model *model = tile->model;
    double kept[SCENE_MATERIALS], bad;
    for (unsigned l = 0; l < model->n_alpha; l++) {
        size_t at = (model->i_m + l) * guard->mesh->n_cell + cell;
        kept[l] = tile->u[at];
        if (tile->u[at] < 0.0 && tile->u[at] >= tile->u_old[at]) tile->u[at] = 0.0;
    }
    bool owes = guard_judge(guard, tile, cell, 1, &bad) == 0.0;
    for (unsigned l = 0; l < model->n_alpha; l++) tile->u[(model->i_m + l) * guard->mesh->n_cell + cell] = kept[l];
    return owes;
}

/* Relaxation of one cell; true if it is admissible afterwards, but for what it owes. */
static bool guard_repair(struct guard *guard, const struct guard_tile *tile, size_t cell)
{
    size_t n_cell = guard->mesh->n_cell;
    if (!guard->repair || !relax_cell(tile->model, n_cell, tile->u_old + cell, tile->u + cell, tile->w + cell))
        return false;
    if (!guard_again(guard, tile, cell) && !guard_owes(guard, tile, cell)) return false;
    guard->relaxed++;
    return true;
}

/* Does a cell lie under a finer tile? Then it is put back to the state from before the step. */
static bool guard_put_back(struct guard *guard, const struct guard_tile *tile, size_t cell)
{
    const struct mesh *mesh = guard->mesh;
    unsigned covered = guard->level->tiles[guard->level->first + tile->local].covered;
    if (!covered || !(covered >> mesh_octant(mesh, cell) & 1u)) return false;
    for (unsigned i = 0; i < tile->model->n_active; i++) {
        size_t at = tile->model->active[i] * mesh->n_cell + cell;
        tile->u[at] = tile->u_old[at];
    }
    mix_primitives(tile->model, 1, mesh->n_cell, tile->u + cell, tile->w + cell);
    guard_again(guard, tile, cell);
    return true;
}

void guard_settle(struct guard *guard, int first)
{
    if (!guard->last) guard_allow_marks(guard);
    for (unsigned t = 0; guard->marked && t < guard->n_local; t++)
        for (size_t c = 0; c < guard->mesh->n_cell; c++) {
            unsigned char *fresh = &guard->fresh[t][c];
            if (*fresh && *fresh <= 1 + first) guard->mask[t][c] = 1.0;
            *fresh = 0;
        }
    for (int s = first + 1; s < TABLEAU_STAGES; s++) guard->bad[s] = 0;
    if (!guard->bad[first]) guard->cause[0] = '\0';
}

long long guard_bad(const struct guard *guard)
{
    long long bad = 0;
    for (int s = 0; s < TABLEAU_STAGES; s++) bad += guard->bad[s];
    return bad;
}

/* A cell that stays bad: said, counted, marked for the next attempt. */
static void guard_note(struct guard *guard, const struct guard_tile *tile, size_t cell)
{
    if (guard_is_first(guard, tile)) guard_describe(guard, tile, cell);
    guard->bad[tile->stage]++;
    if (guard->last) return;
    guard_allow_marks(guard);
    unsigned char *fresh = &guard->fresh[tile->local][cell];
    if (!*fresh) *fresh = (unsigned char)(1 + tile->stage);
}

/* Cells of a batch, n from `from`, in which pressure and fractions contradict each other. */
static void guard_soften(struct guard *guard, const struct guard_tile *tile, size_t from, size_t n)
{
    const struct model *model = tile->model;
    size_t n_cell = guard->mesh->n_cell;
    struct soften_suspect suspects[SOFTEN_BATCH];
    size_t found = soften_find(model, n, n_cell, tile->u + from, tile->w + from, tile->rho_c2 + from,
                               tile->p_before + from, suspects);
    for (size_t k = 0; k < found; k++) {
        size_t cell = from + suspects[k].cell;
        const double *u_old = tile->u_old + cell;
        if (!soft_cell(model, n_cell, u_old, suspects[k].least, tile->u + cell, tile->w + cell)) continue;
        guard_again(guard, tile, cell);
        guard->relaxed++;
    }
}

void guard_check(struct guard *guard, const struct guard_tile *tile)
{
    size_t n_cell = guard->mesh->n_cell;
    bool kept = !guard_is_first(guard, tile);
    bool softens = guard->repair && tile->p_before && tile->model->n_alpha > 1 && soften_applies(guard->model);
    for (int s = 0; s < tile->stage; s++)
        if (guard->bad[s]) return;
    for (size_t from = 0; from < n_cell; from += GUARD_BATCH) {
        size_t n = n_cell - from < GUARD_BATCH ? n_cell - from : GUARD_BATCH;
        double bad[GUARD_BATCH];
        if (softens) guard_soften(guard, tile, from, n);
        if (guard_judge(guard, tile, from, n, bad) == 0.0) continue;
        if (!kept) guard_keep(guard, tile);
        kept = true;
        for (size_t i = 0; i < n; i++) {
            if (bad[i] == 0.0 || guard_owes(guard, tile, from + i)) continue;
            if (guard_repair(guard, tile, from + i) || guard_put_back(guard, tile, from + i)) continue;
            guard_note(guard, tile, from + i);
        }
    }
}
