/* fick.c - see fick.h. Shares, enthalpies and D are made of the frame before anything changes it (`frame`), fluxes when
 * the others are there (`faces`), volume moves at the end (`cells`). */
#include "scheme/fick.h"

#include "base/mem.h"
#include "phys/mix.h"
#include "phys/row.h"
#include "phys/traction.h"
#include "scheme/distance.h"
#include "scheme/heed.h"
#include "scheme/swell.h"
#include "scheme/terms.h"

#include <math.h>
#include <string.h>

/* Rows of a frame with pitch FACE_ROOM: of cells, and of the gases in them. */
struct fick_cells {
    double *alpha, *rho, *D; /* of all gases of a mixture */
    double *sets;            /* where they set the time step (heed.h) */
};

struct fick {
    double *rows;          /* all of the below */
    double *share, *h, *v; /* of each material */
    double *e, *c2, *T;
    struct fick_cells of[SCENE_PHASES]; /* of each mixture */
    double *per_d, *through;
};

static bool fick_wanted(const struct model *path)
{
    return path->n_fick > 0;
}

static unsigned fick_rows(const struct model *path)
{
    unsigned rows = 0;
    for (unsigned k = 0; k < path->n_fick; k++) rows += path->ficks[k].n;
    return rows;
}

static void fick_list(struct terms *terms, int axis, unsigned first, const struct face_work *faces)
{
    const struct model *path = terms->model;
    unsigned row = 0;
    for (unsigned k = 0; k < path->n_fick; k++)
        for (unsigned g = 0; g < path->ficks[k].n; g++, row++) {
            const double *volume = faces ? face_mingled(faces) + row * FACE_ROOM : NULL;
            terms_flux(terms, axis, (struct term_flux){.below = volume, .above = volume, .rate = first + row},
                       "mingled", path->scene->material[path->first + path->ficks[k].member[g]].name);
        }
}

static void *fick_open(const struct term_room *room)
{
    struct fick *own = mem_new(1, sizeof *own);
    size_t n = room->model->n_material, block = n * FACE_ROOM;
    double **blocks[] = {&own->share, &own->h, &own->v};
    double **single[] = {&own->e, &own->c2, &own->T, &own->per_d, &own->through};
    double *at = own->rows = mem_new(3 * block + (5 + 4 * (size_t)room->model->n_fick) * FACE_ROOM, sizeof *own->rows);
    for (size_t i = 0; i < sizeof blocks / sizeof *blocks; i++, at += block) *blocks[i] = at;
    for (size_t i = 0; i < sizeof single / sizeof *single; i++, at += FACE_ROOM) *single[i] = at;
    for (unsigned k = 0; k < room->model->n_fick; k++, at += 4 * FACE_ROOM)
        own->of[k] = (struct fick_cells){at, at + FACE_ROOM, at + 2 * FACE_ROOM, at + 3 * FACE_ROOM};
    return own;
}

static void fick_close(void *data)
{
    struct fick *own = data;
    mem_free(own->rows);
    mem_free(own);
}

/* One gas of a mixture: its mass, and what it adds to the sums of fractions, of masses and of m T. */
static BULLA_KERNEL void fick_gather(size_t n, const double *restrict alpha, const double *restrict rho,
                                     const double *restrict T, double *restrict mass, double *restrict all,
                                     double *restrict sum, double *restrict warm)
{
#pragma omp simd
    for (size_t i = 0; i < n; i++) {
        double a = alpha[i], felt = a > MIX_ABSENT ? a : 0.0, m = felt * rho[i], part = all[i], old = sum[i],
               w = warm[i];
        mass[i] = m;
        all[i] = part + felt;
        sum[i] = old + m;
        warm[i] = w + m * T[i];
    }
}

static BULLA_KERNEL void fick_shares(size_t n, const double *restrict sum, double *restrict mass)
{
#pragma omp simd
    for (size_t i = 0; i < n; i++) {
        double m = mass[i], s = sum[i], share = m / s;
        mass[i] = s > 0.0 ? share : 0.0;
    }
}

/* The density of the gases, and D: T comes as the sum of m T. x^1.75 = x^2/x^(1/4). */
static BULLA_KERNEL void fick_quicken(size_t n, double D0, double T0, double p0, const double *restrict p,
                                      const double *restrict alpha, double *restrict rho, double *restrict D)
{
#pragma omp simd
    for (size_t i = 0; i < n; i++) {
        double a = alpha[i], m = rho[i], x = D[i] / (m * T0), own = D0 * (p0 / p[i]) * (x * x / sqrt(sqrt(x)));
        double density = m / a;
        rho[i] = a > 0.0 ? density : 0.0;
        D[i] = ((m > 0.0) & (x > 0.0) & (p[i] > 0.0)) ? own : 0.0;
    }
}

static BULLA_KERNEL void fick_steady(size_t n, double D0, const double *restrict alpha, double *restrict rho,
                                     double *restrict D)
{
#pragma omp simd
    for (size_t i = 0; i < n; i++) {
        double a = alpha[i], m = rho[i], density = m / a;
        rho[i] = a > 0.0 ? density : 0.0;
        D[i] = a > 0.0 ? D0 : 0.0;
    }
}

/* Shares, density and D of mixture k in n cells of the primitives w, each gas at its own pressure; share: a row for
 * each material, pitch `room`; T: a row of work space. */
static void fick_mix(const struct model *path, unsigned k, size_t n, size_t stride, const double *w,
                     struct traction_pressures *parts, double *T, double *share, size_t room,
                     const struct fick_cells *of)
{
    const struct model_fick *fick = &path->ficks[k];
    const struct scene_fick *scene = fick->scene;
    const double *mean = w + path->i_E * stride;
    memset(of->alpha, 0, n * sizeof *of->alpha);
    memset(of->rho, 0, n * sizeof *of->rho);
    memset(of->D, 0, n * sizeof *of->D);
    memset(T, 0, n * sizeof *T);
    for (unsigned g = 0; g < fick->n; g++) {
        unsigned l = fick->member[g];
        const double *rho = w + (path->i_m + l) * stride, *p = traction_pressure(path, n, l, mean, parts);
        if (!scene->constant) path->eos[l].law->temperature(path->eos[l].self, n, rho, p, T);
        fick_gather(n, w + (path->i_alpha + l) * stride, rho, T, share + l * room, of->alpha, of->rho, of->D);
    }
    for (unsigned g = 0; g < fick->n; g++) fick_shares(n, of->rho, share + fick->member[g] * room);
    if (scene->constant) fick_steady(n, scene->D, of->alpha, of->rho, of->D);
    else
        fick_quicken(n, scene->D, scene->T, scene->p, traction_pressure(path, n, fick->member[0], mean, parts),
                     of->alpha, of->rho, of->D);
    heed_parts(n, of->alpha, of->rho, heed_density(path, n, stride, w, T), of->sets);
}

/* What a mass of a gas takes along. */
static BULLA_KERNEL void fick_content(size_t n, const double *restrict rho_e, const double *restrict p,
                                      const double *restrict rho, double *restrict h, double *restrict v)
{
#pragma omp simd
    for (size_t i = 0; i < n; i++) {
        double own = 1.0 / rho[i];
        h[i] = (rho_e[i] + p[i]) * own;
        v[i] = own;
    }
}

/* Cells of a frame from `at` on, n <= TRACTION_BATCH. */
static void fick_look(const struct model *path, struct fick *own, size_t at, size_t n, const double *w)
{
    const double *mean = w + path->i_E * FACE_ROOM;
    struct traction_pressures parts; /* large: filled as far as it is used */
    traction_part(path, n, FACE_ROOM, w, &parts);
    for (unsigned k = 0; k < path->n_fick; k++) {
        const struct fick_cells *all = &own->of[k];
        const struct fick_cells of = {all->alpha + at, all->rho + at, all->D + at, all->sets + at};
        fick_mix(path, k, n, FACE_ROOM, w, &parts, own->T, own->share + at, FACE_ROOM, &of);
        for (unsigned g = 0; g < path->ficks[k].n; g++) {
            unsigned l = path->ficks[k].member[g];
            const double *rho = w + (path->i_m + l) * FACE_ROOM, *p = traction_pressure(path, n, l, mean, &parts);
            path->eos[l].law->state(path->eos[l].self, n, rho, p, own->e, own->c2);
            fick_content(n, own->e, p, rho, own->h + l * FACE_ROOM + at, own->v + l * FACE_ROOM + at);
        }
    }
}

static void fick_frame(const struct term_piece *piece)
{
    size_t n = frame_edged(piece->frame);
    const double *w = piece->faces->frame + frame_reach(piece->frame);
    for (size_t at = 0; at < n; at += TRACTION_BATCH)
        fick_look(piece->model, piece->own, at, n - at < TRACTION_BATCH ? n - at : TRACTION_BATCH, w + at);
}

/* min(alpha) rho D/d of the faces: rho D by the harmonic mean, D at most `most` where there is next to no gas. */
static BULLA_KERNEL void fick_open_faces(size_t n, size_t step, double most, const double *restrict alpha,
                                         const double *restrict rho, const double *restrict D,
                                         const double *restrict sets, const double *restrict per_d,
                                         double *restrict through)
{
#pragma omp simd
    for (size_t i = 0; i < n; i++) {
        double a = alpha[i], b = alpha[i + step], least = a < b ? a : b, Da = D[i], Db = D[i + step];
        double bound = sets[i] * sets[i + step] > 0.0 ? HUGE_VAL : most;
        double left = rho[i] * (Da < bound ? Da : bound), right = rho[i + step] * (Db < bound ? Db : bound);
        double sum = left + right, both = 2.0 * left * right / sum, flux = least * both * per_d[i];
        through[i] = ((least > 0.0) & (sum > 0.0)) ? flux : 0.0;
    }
}

/* j_k = (min(alpha) rho D/d)(Y_L - Y_R), with what it takes along from where it comes. */
static BULLA_KERNEL void fick_pass(size_t n, size_t step, const double *restrict through, const double *restrict share,
                                   const double *restrict h, const double *restrict v, double *restrict mass,
                                   double *restrict energy, double *restrict volume)
{
#pragma omp simd
    for (size_t i = 0; i < n; i++) {
        double j = through[i] * (share[i] - share[i + step]), m = mass[i], e = energy[i];
        double hot = j > 0.0 ? h[i] : h[i + step], wide = j > 0.0 ? v[i] : v[i + step];
        mass[i] = m + j;
        energy[i] = e + j * hot;
        volume[i] = j * wide;
    }
}

static void fick_faces(const struct term_piece *piece)
{
    const struct model *path = piece->model;
    const struct term_tile *tile = piece->tile;
    struct fick *own = piece->own;
    struct face_work *faces = piece->faces;
    size_t n = faces->faces.n, step = piece->frame->inner;
    double most = 1.0 / (DISTANCE_PACE * tile->dt * distance_squares(tile->level, path->dim));
    unsigned row = 0;
    distance_faces(piece, own->per_d);
    for (unsigned k = 0; k < path->n_fick; k++) {
        const struct fick_cells *of = &own->of[k];
        fick_open_faces(n, step, most, of->alpha, of->rho, of->D, of->sets, own->per_d, own->through);
        for (unsigned g = 0; g < path->ficks[k].n; g++, row++) {
            size_t at = path->ficks[k].member[g] * (size_t)FACE_ROOM;
            fick_pass(n, step, own->through, own->share + at, own->h + at, own->v + at, faces->m + at, faces->energy,
                      face_mingled(faces) + row * FACE_ROOM);
        }
    }
}

/* Volume that came with the gases, and that all materials of a cell make place for. */
static void fick_swell(const struct term_tile *tile, size_t from, size_t n)
{
    const struct model *path = tile->model;
    const double *w = tile->w + from, *p = w + path->i_E * tile->n_cell;
    const double *volume = tile->rates + terms_first(tile->terms, &fick_term) * tile->n_cell + from;
    double rho_e[SWELL_BATCH], rho_c2[SWELL_BATCH], heat[SWELL_BATCH] = {0};
    struct swell swell; /* large: filled as far as it is used */
    swell_begin(&swell, path, n);
    for (unsigned l = 0; l < path->n_material; l++) {
        const struct model_eos *eos = &path->eos[l];
        const double *rho = w + (path->i_m + l) * tile->n_cell;
        eos->law->state(eos->self, n, rho, p, rho_e, rho_c2);
        swell_material(&swell, l, w + (path->i_alpha + l) * tile->n_cell, rho, p, rho_c2, heat, NULL);
    }
    for (unsigned k = 0; k < path->n_fick; k++)
        for (unsigned g = 0; g < path->ficks[k].n; g++, volume += tile->n_cell)
            swell_volume(&swell, path->ficks[k].member[g], volume);
    swell_share(&swell, tile, from);
}

static void fick_cells(struct term_tile *tile)
{
    for (size_t from = 0; from < tile->n_cell; from += SWELL_BATCH)
        fick_swell(tile, from, tile->n_cell - from < SWELL_BATCH ? tile->n_cell - from : SWELL_BATCH);
}

static BULLA_KERNEL void fick_hurry(size_t n, double a, const double *restrict sets, const double *restrict D,
                                    double *restrict rate)
{
#pragma omp simd
    for (size_t i = 0; i < n; i++) {
        double old = rate[i], more = a * D[i];
        rate[i] = old + (sets[i] > 0.0 ? more : 0.0);
    }
}

/* Are two gases of mixture k in these cells? One alone asks for no steps, whether its tile knows others or not. */
static bool fick_meet(const struct term_pace *pace, unsigned k)
{
    const struct model_fick *fick = &pace->model->ficks[k];
    unsigned there = 0;
    for (unsigned g = 0; g < fick->n; g++) {
        const double *alpha = pace->w + (pace->model->i_alpha + fick->member[g]) * pace->n_cell;
        there += row_most(pace->n_cell, alpha) > MIX_ABSENT;
    }
    return there > 1;
}

static void fick_pace(const struct term_pace *pace, double *rate)
{
    const struct model *path = pace->model;
    double factor = DISTANCE_PACE * path->scene->scheme.cfl * distance_squares(pace->level, path->dim);
    double share[SCENE_MATERIALS * SWELL_BATCH], T[SWELL_BATCH], alpha[SWELL_BATCH], rho[SWELL_BATCH], D[SWELL_BATCH],
        sets[SWELL_BATCH];
    const struct fick_cells of = {alpha, rho, D, sets};
    struct traction_pressures parts; /* large: filled as far as it is used */
    for (unsigned k = 0; k < path->n_fick; k++) {
        if (!fick_meet(pace, k)) continue;
        for (size_t from = 0; from < pace->n_cell; from += SWELL_BATCH) {
            size_t n = pace->n_cell - from < SWELL_BATCH ? pace->n_cell - from : SWELL_BATCH;
            traction_part(path, n, pace->n_cell, pace->w + from, &parts);
            fick_mix(path, k, n, pace->n_cell, pace->w + from, &parts, T, share, SWELL_BATCH, &of);
            fick_hurry(n, factor, sets, D, rate + from);
        }
    }
}

static void fick_say(const struct scene *scene, struct text *text)
{
    for (unsigned k = 0; k < scene->n_fick; k++) {
        text_add(text, "%s", k ? "; " : ": ");
        for (unsigned g = 0; g < scene->ficks[k].n; g++)
            text_add(text, "%s%s", g ? ", " : "", scene->material[scene->ficks[k].gas[g]].name);
    }
}

const struct term fick_term = {
    .name = "fick",
    .owner = "core/scheme/fick.c",
    .equation = "d m_k/dt -= div j_k, d(rho E)/dt -= div sum j_k h_k, j_k = -rho D grad Y_k; volume moves with j_k",
    .wanted = fick_wanted,
    .diffuses = true,
    .rows = fick_rows,
    .list = fick_list,
    .open = fick_open,
    .close = fick_close,
    .frame = fick_frame,
    .faces = fick_faces,
    .cells = fick_cells,
    .pace = fick_pace,
    .say = fick_say,
};
