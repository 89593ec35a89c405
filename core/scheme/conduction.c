/* conduction.c - see conduction.h. Temperatures are made of the frame before anything changes it (`frame`), the
 * channels when the other fluxes are there (`faces`), volume moves at the end (`cells`). */
#include "scheme/conduction.h"

#include "base/mem.h"
#include "phys/mix.h"
#include "phys/traction.h"
#include "phys/phase_pair.h"
#include "phys/row.h"
#include "scheme/conduction_channel.h"
#include "scheme/conduction_front.h"
#include "scheme/conduction_law.h"
#include "scheme/conduction_pace.h"
#include "scheme/conduction_plain.h"
#include "scheme/conduction_wall.h"
#include "scheme/distance.h"
#include "scheme/heed.h"
#include "scheme/swell.h"
#include "scheme/terms.h"

#include <float.h>
#include <string.h>

/* Rows of a frame: [n_material] of cells or faces with pitch FACE_ROOM. */
struct conduction {
    double *rows; /* all of the below */
    double *T, *part, *sets, *c, *k;
    const struct model *of;  /* the path whose numbers stand in k: a narrow one has other materials in the same rows */
    double *left, *right;    /* what is left of the materials on both sides of the faces */
    const double *beside[2]; /* their fractions there */
    double *rest, *width, *series, *q, *pair, *per_d;
    double *wet[2];                   /* on both sides of the faces */
    struct conduction_front *surface; /* of pairs with an `onset`, or NULL */
    bool front;                       /* the piece has one */
    struct conduction_wall_fault fault;
    int plain;   /* the piece is one of conduction_plain.h, of this material, whose T alone is made; or -1 */
    bool traces; /* some material of the piece does not set the time step */
};

static bool conduction_wanted(const struct model *path)
{
    return path->conducts;
}

static unsigned conduction_rows(const struct model *path)
{
    return path->n_alpha;
}

static void conduction_list(struct terms *terms, int axis, unsigned first, const struct face_work *faces)
{
    const struct model *model = terms->model;
    for (unsigned l = 0; l < model->n_alpha; l++)
        terms_flux(terms, axis,
                   (struct term_flux){.below = faces ? faces->heat_below + l * FACE_ROOM : NULL,
                                      .above = faces ? faces->heat_above + l * FACE_ROOM : NULL,
                                      .rate = first + l,
                                      .sides = true},
                   "heat", model->scene->material[model->first + l].name);
}

/* Conductivities that are numbers stand in their rows as long as the path is the same. */
static void conduction_set(const struct model *path, struct conduction *own)
{
    if (own->of == path) return;
    own->of = path;
    for (unsigned l = 0; l < path->n_material; l++) {
        if (!conduction_law_is(path, l) || path->conductivity[l].law->needs) continue;
        for (size_t i = 0; i < FACE_ROOM; i++) own->k[l * (size_t)FACE_ROOM + i] = path->conductivity[l].k;
    }
}

static void *conduction_open(const struct term_room *room)
{
    struct conduction *own = mem_new(1, sizeof *own);
    size_t n = room->model->n_material, block = n * FACE_ROOM;
    double **blocks[] = {&own->T, &own->part, &own->sets, &own->c, &own->k, &own->left, &own->right};
    double **single[] = {&own->rest, &own->width, &own->series, &own->q,
                         &own->pair, &own->per_d, &own->wet[0], &own->wet[1]};
    double *at = own->rows = mem_new(7 * block + 8 * FACE_ROOM, sizeof *own->rows);
    for (size_t i = 0; i < sizeof blocks / sizeof *blocks; i++, at += block) *blocks[i] = at;
    for (size_t i = 0; i < sizeof single / sizeof *single; i++, at += FACE_ROOM) *single[i] = at;
    own->surface = conduction_front_new(room->model);
    return own;
}

static void conduction_close(void *data)
{
    struct conduction *own = data;
    conduction_front_free(own->surface);
    mem_free(own->rows);
    mem_free(own->fault.message);
    mem_free(own);
}

/* The fraction where it is felt: more than nothing, with a temperature (volume without mass has none). */
static BULLA_KERNEL void conduction_feel(size_t n, const double *restrict alpha, const double *restrict T,
                                         double *restrict part)
{
#pragma omp simd
    for (size_t i = 0; i < n; i++) {
        double a = alpha[i], felt = a > MIX_ABSENT ? a : 0.0;
        part[i] = ((T[i] > 0.0) & (T[i] <= DBL_MAX)) ? felt : 0.0;
    }
}

static BULLA_KERNEL void conduction_feel_alone(size_t n, const double *restrict T, double *restrict part)
{
#pragma omp simd
    for (size_t i = 0; i < n; i++) part[i] = T[i] > 0.0 ? 1.0 : 0.0;
}

/* How many cells hold what does not set the time step. */
static BULLA_KERNEL double conduction_traces(size_t n, const double *restrict part, const double *restrict sets)
{
    double count = 0.0;
#pragma omp simd reduction(+ : count)
    for (size_t i = 0; i < n; i++) {
        double a = part[i], trace = sets[i] > 0.0 ? 0.0 : 1.0;
        count += a > 0.0 ? trace : 0.0;
    }
    return count;
}

/* Capacities of n <= CONDUCTION_LAW_BATCH cells, of each material at its own pressure. */
static void conduction_weigh_batch(const struct model *path, size_t n, const double *w, double *c)
{
    double T[CONDUCTION_LAW_BATCH];
    struct traction_pressures parts;
    traction_part(path, n, FACE_ROOM, w, &parts);
    for (unsigned l = 0; l < path->n_material; l++) {
        const double *p = traction_pressure(path, n, l, w + path->i_E * FACE_ROOM, &parts);
        conduction_law_capacity(&path->eos[l], n, w + (path->i_m + l) * FACE_ROOM, p, T, c + l * FACE_ROOM);
    }
}

static void conduction_weigh(const struct model *path, size_t n, const double *w, struct conduction *own)
{
    for (size_t from = 0; from < n; from += CONDUCTION_LAW_BATCH)
        conduction_weigh_batch(path, n - from < CONDUCTION_LAW_BATCH ? n - from : CONDUCTION_LAW_BATCH, w + from,
                               own->c + from);
}

/* Does a wall at one of the ends of a piece give heat? */
static bool conduction_is_heated(const struct term_piece *piece, int side)
{
    int face = 2 * piece->frame->axis + side;
    return scene_boundary_is_heated(piece->model->scene, face) && distance_ends(piece, side);
}

/* Fractions, conductivities and capacities of the cells beside faces. */
static void conduction_look(const struct term_piece *piece, size_t n, const double *w, struct conduction *own)
{
    const struct model *path = piece->model;
    conduction_set(path, own);
    const double *rho = heed_density(path, n, FACE_ROOM, w, own->rest);
    for (unsigned l = 0; l < path->n_material; l++) {
        double *T = own->T + l * FACE_ROOM, *part = own->part + l * FACE_ROOM, *sets = own->sets + l * FACE_ROOM;
        if (path->n_alpha) conduction_feel(n, w + (path->i_alpha + l) * FACE_ROOM, T, part);
        else conduction_feel_alone(n, T, part);
        heed_parts(n, part, w + (path->i_m + l) * FACE_ROOM, rho, sets);
        own->traces = own->traces || conduction_traces(n, part, sets) > 0.0;
        if (conduction_law_is(path, l) && path->conductivity[l].law->needs)
            conduction_law_ask(path, l, n, T, w + path->i_E * FACE_ROOM, w + (path->i_m + l) * FACE_ROOM,
                               own->k + l * FACE_ROOM);
    }
    own->front = conduction_front_look(own->surface, path, n, own->part);
    if (own->traces || own->front) conduction_weigh(path, n, w, own);
    if (own->front) conduction_front_weigh(own->surface, path, n, own->part, own->c, own->T);
}

/* Temperatures of the only material of a piece. */
static void conduction_warmth(const struct model *path, unsigned l, size_t n, const double *w, struct conduction *own)
{
    const struct model_eos *eos = &path->eos[l];
    eos->law->temperature(eos->self, n, w + (path->i_m + l) * FACE_ROOM, w + path->i_E * FACE_ROOM,
                          own->T + l * FACE_ROOM);
}

/* Temperatures, and all that is made of them, from the primitives as they were gathered. */
static void conduction_frame(const struct term_piece *piece)
{
    struct conduction *own = piece->own;
    size_t n = frame_edged(piece->frame);
    const double *w = piece->faces->frame + frame_reach(piece->frame);
    own->traces = false, own->plain = -1;
    if (!conduction_is_heated(piece, 0) && !conduction_is_heated(piece, 1))
        own->plain = conduction_plain_find(piece->model, n, FACE_ROOM, w);
    if (own->plain >= 0) {
        conduction_warmth(piece->model, (unsigned)own->plain, n, w, own);
        return;
    }
    mix_temperatures(piece->model, n, FACE_ROOM, w, own->T);
    conduction_look(piece, n, w, own);
}

/* The greatest diffusivity that a trace may have, times two [m2/s]. */
static double conduction_most(const struct term_tile *tile)
{
    return 2.0 / (DISTANCE_PACE * tile->dt * distance_squares(tile->level, tile->model->dim));
}

/* One piece: what its channels need. */
struct conduction_piece {
    const struct model *path;
    struct conduction *own;
    size_t n, step; /* faces; from a cell to the next */
    double most;
};

static struct conduction_channel_side conduction_side(const struct conduction_piece *at, unsigned l, bool right)
{
    size_t row = l * (size_t)FACE_ROOM, from = row + (right ? at->step : 0);
    const struct conduction *own = at->own;
    return (struct conduction_channel_side){own->beside[right] + row, own->sets + from, own->T + from, own->k + from,
                                            own->c + from};
}

/* k_lm of a liquid and its vapour. */
static void conduction_meet(const struct conduction_piece *at, unsigned l, unsigned m)
{
    struct conduction *own = at->own;
    for (int side = 0; side < 2; side++) {
        struct conduction_channel_side one = conduction_side(at, l, side), other = conduction_side(at, m, side);
        conduction_channel_wet(at->n, &one, &other, own->wet[side]);
    }
    struct conduction_channel_side left = conduction_side(at, l, false), right = conduction_side(at, m, true);
    conduction_channel_surface(at->n, &left, &right, own->wet[0], own->wet[1], own->series);
}

/* q_lm of a channel of the width own->width into q. */
static void conduction_through(const struct conduction_piece *at, unsigned l, unsigned m, const double *width,
                               double *q)
{
    const struct model *path = at->path;
    struct conduction *own = at->own;
    struct conduction_channel_side left = conduction_side(at, l, false), right = conduction_side(at, m, true);
    if (phase_pair_joins(path, l, m)) conduction_meet(at, l, m);
    else conduction_channel_series(at->n, &left, &right, own->series);
    if (own->traces) conduction_channel_bound(at->n, at->most, &left, &right, own->series);
    if (own->front) conduction_front_take(own->surface, path, l, m, at->n, own->series);
    conduction_channel_flow(at->n, width, own->series, own->per_d, left.T, right.T, q);
}

static bool conduction_joins(const struct model *path, unsigned l, unsigned m)
{
    return conduction_law_is(path, l) && conduction_law_is(path, m);
}

/* What goes from each material to itself. Materials that do not conduct have their part of the face all the same. */
static void conduction_alike(const struct term_piece *piece, const struct conduction_piece *at)
{
    const struct model *path = piece->model;
    struct conduction *own = at->own;
    memset(own->rest, 0, at->n * sizeof *own->rest);
    for (unsigned l = 0; l < path->n_material; l++) {
        size_t row = l * (size_t)FACE_ROOM;
        conduction_channel_own(at->n, own->beside[0] + row, own->beside[1] + row, own->width, own->left + row,
                               own->right + row, own->rest);
        if (conduction_joins(path, l, l)) conduction_through(at, l, l, own->width, own->q);
        else memset(own->q, 0, at->n * sizeof *own->q);
        row_add(at->n, own->q, piece->faces->energy);
        if (!path->n_alpha) continue;
        memcpy(piece->faces->heat_below + row, own->q, at->n * sizeof *own->q);
        memcpy(piece->faces->heat_above + row, own->q, at->n * sizeof *own->q);
    }
}

/* q_lm: out of l on the left into m on the right. */
static void conduction_cross(const struct term_piece *piece, const struct conduction_piece *at, unsigned l, unsigned m,
                             double *q)
{
    struct conduction *own = at->own;
    conduction_channel_cross(at->n, own->left + l * FACE_ROOM, own->right + m * FACE_ROOM, own->rest, own->width);
    conduction_through(at, l, m, own->width, q);
    row_add(at->n, q, piece->faces->heat_above + l * FACE_ROOM);
    row_add(at->n, q, piece->faces->heat_below + m * FACE_ROOM);
}

/* At how many faces. */
static BULLA_KERNEL double conduction_meeting(size_t n, const double *restrict rest)
{
    double count = 0.0;
#pragma omp simd reduction(+ : count)
    for (size_t i = 0; i < n; i++) count += rest[i] > 0.0 ? 1.0 : 0.0;
    return count;
}

/* What goes from each material to another. Both ways of a pair are one number, so that a mirror changes its sign. */
static void conduction_unlike(const struct term_piece *piece, const struct conduction_piece *at)
{
    const struct model *path = piece->model;
    struct conduction *own = at->own;
    if (conduction_meeting(at->n, own->rest) == 0.0) return;
    for (unsigned l = 0; l < path->n_alpha; l++)
        for (unsigned m = l + 1; m < path->n_alpha; m++) {
            if (!conduction_joins(path, l, m)) continue;
            conduction_cross(piece, at, l, m, own->pair);
            conduction_cross(piece, at, m, l, own->q);
            row_add(at->n, own->q, own->pair);
            row_add(at->n, own->pair, piece->faces->energy);
        }
}

static void conduction_walls(const struct term_piece *piece, const struct conduction_piece *at)
{
    struct conduction *own = at->own;
    const struct conduction_wall_cells cells = {own->T, own->part, own->sets, own->traces ? own->c : NULL, at->most};
    for (int side = 0; side < 2; side++)
        if (conduction_is_heated(piece, side)) conduction_wall_add(piece, side, &cells, &own->fault);
}

/* Material l is alone: all heat is its own. */
static void conduction_only(const struct term_piece *piece, const struct conduction_piece *at, unsigned l)
{
    struct conduction *own = at->own;
    size_t bytes = at->n * sizeof *own->q;
    conduction_plain_flux(at->path, l, at->n, at->step, own->T + l * FACE_ROOM, own->per_d, own->q);
    row_add(at->n, own->q, piece->faces->energy);
    for (unsigned m = 0; m < at->path->n_alpha; m++) {
        double *below = piece->faces->heat_below + m * FACE_ROOM, *above = piece->faces->heat_above + m * FACE_ROOM;
        if (m == l) memcpy(below, own->q, bytes), memcpy(above, own->q, bytes);
        else memset(below, 0, bytes), memset(above, 0, bytes);
    }
}

static void conduction_faces(const struct term_piece *piece)
{
    struct conduction *own = piece->own;
    const struct conduction_piece at = {piece->model, own, piece->faces->faces.n, piece->frame->inner,
                                        conduction_most(piece->tile)};
    distance_faces(piece, own->per_d);
    if (own->plain >= 0) {
        conduction_only(piece, &at, (unsigned)own->plain);
        return;
    }
    own->beside[0] = own->part, own->beside[1] = own->part + at.step;
    if (own->front) conduction_front_meet(own->surface, at.path, at.n, at.step, at.most, own->k, own->c);
    if (own->front) conduction_front_turn(own->surface, at.path, at.n, at.step, own->T, own->beside);
    conduction_alike(piece, &at);
    conduction_unlike(piece, &at);
    conduction_walls(piece, &at);
}

static int conduction_failure(const void *data, const char **ret_message, const char **ret_place)
{
    const struct conduction *own = data;
    *ret_message = own->fault.message;
    *ret_place = own->fault.place;
    return own->fault.status;
}

/* Heat per own volume from heat per cell. */
static BULLA_KERNEL void conduction_own_volume(size_t n, const double *restrict alpha, const double *restrict power,
                                               double *restrict heat)
{
#pragma omp simd
    for (size_t i = 0; i < n; i++) {
        double a = alpha[i], own = power[i] / a;
        heat[i] = a > MIX_ABSENT ? own : 0.0;
    }
}

/* Cells that are looked at together for mixed ones: in the others heat moves no volume. */
enum { CONDUCTION_SWELLS = 64 };
_Static_assert(CONDUCTION_SWELLS <= (int)CONDUCTION_LAW_BATCH, "a batch is asked of a law at once");

/* At how many cells a material is there and not alone. */
static BULLA_KERNEL double conduction_mixtures(size_t n, const double *restrict alpha)
{
    double count = 0.0;
#pragma omp simd reduction(+ : count)
    for (size_t i = 0; i < n; i++) count += ((alpha[i] > MIX_ABSENT) & (alpha[i] < 1.0)) ? 1.0 : 0.0;
    return count;
}

static bool conduction_is_mixed(const struct term_tile *tile, size_t from, size_t n)
{
    const double *alpha = tile->w + tile->model->i_alpha * tile->n_cell + from;
    double count = 0.0;
    for (unsigned l = 0; l < tile->model->n_alpha && count == 0.0; l++)
        count = conduction_mixtures(n, alpha + l * tile->n_cell);
    return count > 0.0;
}

static void conduction_swell(const struct term_tile *tile, size_t from, size_t n)
{
    const struct model *path = tile->model;
    const double *w = tile->w + from, *p = w + path->i_E * tile->n_cell;
    const double *power = tile->rates + terms_first(tile->terms, &conduction_term) * tile->n_cell + from;
    double heat[CONDUCTION_LAW_BATCH], rho_e[CONDUCTION_LAW_BATCH], rho_c2[CONDUCTION_LAW_BATCH];
    struct swell swell; /* large: filled as far as it is used */
    swell_begin(&swell, path, n);
    for (unsigned l = 0; l < path->n_material; l++) {
        const struct model_eos *eos = &path->eos[l];
        const double *rho = w + (path->i_m + l) * tile->n_cell, *alpha = w + (path->i_alpha + l) * tile->n_cell;
        eos->law->state(eos->self, n, rho, p, rho_e, rho_c2);
        conduction_own_volume(n, alpha, power + l * tile->n_cell, heat);
        swell_material(&swell, l, alpha, rho, p, rho_c2, heat, NULL);
    }
    swell_share(&swell, tile, from);
}

/* What each material gets, for warm.h. */
static void conduction_tell(const struct term_tile *tile)
{
    size_t n = tile->n_cell;
    const double *power = tile->rates + terms_first(tile->terms, &conduction_term) * n;
    row_add(tile->model->n_alpha * n, power, tile->rates + tile->model->i_alpha * n);
}

static void conduction_cells(struct term_tile *tile)
{
    if (!tile->model->kapila) return;
    if (swell_waits(tile)) {
        conduction_tell(tile);
        return;
    }
    for (size_t from = 0; from < tile->n_cell; from += CONDUCTION_SWELLS) {
        size_t n = tile->n_cell - from < CONDUCTION_SWELLS ? tile->n_cell - from : CONDUCTION_SWELLS;
        if (conduction_is_mixed(tile, from, n)) conduction_swell(tile, from, n);
    }
}

double conduction_step(double diffusivity, double sum)
{
    return 1.0 / (DISTANCE_PACE * diffusivity * sum);
}

/* cp by the difference of the enthalpy over 1e-4 of the density. */
struct conduction_facts conduction_facts(const struct model *model, unsigned l)
{
    const struct model_eos *eos = &model->eos[l];
    struct conduction_facts facts = {0};
    double p[2] = {101325.0, 101325.0}, T[2] = {298.15, 298.15}, rho[2], e[2], rho_c2[2], c[2];
    if (!conduction_law_is(model, l)) return facts;
    eos->law->density(eos->self, 1, p, T, rho);
    rho[1] = 0.9999 * rho[0];
    conduction_law_ask(model, l, 1, T, p, rho, &facts.k);
    conduction_law_capacity(eos, 2, rho, p, T, c);
    eos->law->state(eos->self, 2, rho, p, e, rho_c2);
    facts.cp = ((e[1] + p[1]) / rho[1] - (e[0] + p[0]) / rho[0]) / (T[1] - T[0]);
    facts.rho_cp = rho[0] * facts.cp;
    facts.rho_cv = c[0];
    return facts;
}

static void conduction_say(const struct scene *scene, struct text *text)
{
    const char *comma = ": ";
    for (unsigned l = 0; l < scene->n_material; l++) {
        if (!scene->material[l].conductivity.module) continue;
        text_add(text, "%s%s %s", comma, scene->material[l].name, scene->material[l].conductivity.module->name);
        comma = ", ";
    }
}

const struct term conduction_term = {
    .name = "conduction",
    .owner = "core/scheme/conduction.c",
    .equation = "d(rho E)/dt -= div q, q = sum over channels A_lm k_lm (T_lL - T_mR)/d; volume moves with Q_l",
    .wanted = conduction_wanted,
    .diffuses = true,
    .rows = conduction_rows,
    .list = conduction_list,
    .open = conduction_open,
    .close = conduction_close,
    .failure = conduction_failure,
    .frame = conduction_frame,
    .faces = conduction_faces,
    .cells = conduction_cells,
    .pace = conduction_pace_add,
    .say = conduction_say,
};
