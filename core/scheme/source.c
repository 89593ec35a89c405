/* source.c - see source.h.
 *
 * Cells are taken in batches: first the values of all sources are asked for, cell by cell, as rows
 * (source_value.h); then kernels make rates of them. */
#include "scheme/source.h"

#include "base/mem.h"
#include "base/status.h"
#include "phys/elastic.h"
#include "phys/mix.h"
#include "phys/row.h"
#include "scheme/exchange.h"
#include "scheme/source_value.h"
#include "scheme/source_weight.h"
#include "scheme/swell.h"
#include "scheme/terms.h"

#include <string.h>

enum { SOURCE_BATCH = SOURCE_VALUE_BATCH };

struct source {
    struct source_value *values;
    bool heats, fills, strains; /* is there any heat, mass, rate of the stretch? */
    struct swell swell;
};

static const double source_zero[SOURCE_BATCH];

static bool source_wanted(const struct model *path)
{
    return path->scene->sources != NULL;
}

static void *source_open(const struct term_room *room)
{
    struct source *source = mem_new(1, sizeof *source);
    source->values = source_value_new(room->model, room->mesh);
    for (unsigned s = 0; s < SCENE_SOURCES; s++) {
        if (!source->values->row[s]) continue;
        source->heats = source->heats || (s >= SCENE_SOURCE_HEATING && s < SCENE_SOURCE_MASS);
        source->fills = source->fills || (s >= SCENE_SOURCE_MASS && s < SCENE_SOURCE_FRACTION);
        source->strains = source->strains || s >= SCENE_SOURCE_STRETCH;
    }
    return source;
}

static void source_close(void *own)
{
    struct source *source = own;
    source_value_free(source->values);
    mem_free(source);
}

static int source_failure(const void *own, const char **ret_message, const char **ret_place)
{
    const struct source_value *values = ((const struct source *)own)->values;
    if (!values->status) return STATUS_OK;
    *ret_message = values->message;
    *ret_place = values->place;
    return values->status;
}

static bool source_spreads(const struct scene *scene)
{
    if (!scene->sources) return false;
    for (unsigned l = 0; l < scene->n_material; l++)
        if (scene->sources->value[SCENE_SOURCE_FRACTION + l].given) return true;
    return scene->sources->script != NULL;
}

void source_text(const struct scene *scene, struct text *text)
{
    static const struct {
        unsigned from, to;
        const char *name;
    } kinds[] = {{SCENE_SOURCE_ACCELERATION, SCENE_SOURCE_FORCE, "acceleration"},
                 {SCENE_SOURCE_FORCE, SCENE_SOURCE_HEATING, "force"},
                 {SCENE_SOURCE_HEATING, SCENE_SOURCE_MASS, "heating"},
                 {SCENE_SOURCE_MASS, SCENE_SOURCE_FRACTION, "mass"},
                 {SCENE_SOURCE_FRACTION, SCENE_SOURCE_STRETCH, "fractions"},
                 {SCENE_SOURCE_STRETCH, SCENE_SOURCES, "stretch"}};
    const char *comma = "";
    for (size_t k = 0; scene->sources && k < sizeof kinds / sizeof *kinds; k++) {
        bool given = false;
        for (unsigned s = kinds[k].from; s < kinds[k].to; s++) given = given || scene->sources->value[s].given;
        if (!given) continue;
        text_add(text, "%s%s", comma, kinds[k].name);
        comma = ", ";
    }
    if (scene->sources && scene->sources->script) text_add(text, "%slua", comma);
}

static void source_say(const struct scene *scene, struct text *text)
{
    text_add(text, ": ");
    source_text(scene, text);
}

/* One component of the forces: what it gives to the momentum, and its power. */
static BULLA_KERNEL void source_push(size_t n, const double *restrict acceleration, const double *restrict force,
                                     const double *restrict rho, const double *restrict u, double *restrict momentum,
                                     double *restrict energy)
{
#pragma omp simd
    for (size_t i = 0; i < n; i++) {
        double f = rho[i] * acceleration[i] + force[i], v = u[i], m = momentum[i], e = energy[i];
        momentum[i] = m + f;
        energy[i] = e + f * v;
    }
}

/* A mass source where the material is there, else 0. */
static BULLA_KERNEL void source_where(size_t n, const double *restrict alpha, const double *restrict given,
                                      double *restrict mass)
{
#pragma omp simd
    for (size_t i = 0; i < n; i++) {
        double a = alpha[i], s = given[i];
        mass[i] = a > MIX_ABSENT ? s : 0.0;
    }
}

/* Energy that a source of mass brings along, the kinetic one apart: its enthalpy. */
static BULLA_KERNEL void source_enthalpy(size_t n, const double *restrict mass, const double *restrict rho,
                                         const double *restrict p, const double *restrict rho_e,
                                         double *restrict energy)
{
#pragma omp simd
    for (size_t i = 0; i < n; i++) {
        double h = (rho_e[i] + p[i]) / rho[i], old = energy[i];
        energy[i] = old + mass[i] * h;
    }
}

static BULLA_KERNEL void source_kinetic(size_t n, const double *restrict mass, const double *restrict u,
                                        double *restrict momentum, double *restrict energy)
{
#pragma omp simd
    for (size_t i = 0; i < n; i++) {
        double v = u[i], p = mass[i] * v, m = momentum[i], e = energy[i];
        momentum[i] = m + p;
        energy[i] = e + 0.5 * p * v;
    }
}

/* One batch of one tile: rows of primitives and rates begin at its first cell. */
struct source_batch {
    const struct model *path;
    unsigned exchange; /* first row of what volume carries (exchange.h) */
    size_t n, stride;
    const double *w;
    double *rates;
    double rho[SOURCE_BATCH], mass[SCENE_MATERIALS][SOURCE_BATCH], all[SOURCE_BATCH]; /* all: sources of mass */
    double heat[SOURCE_BATCH], one[SOURCE_BATCH];
};

static const double *source_given(const struct source *source, unsigned slot)
{
    return source->values->row[slot] ? source->values->row[slot] : source_zero;
}

static const double *source_alpha(const struct source_batch *batch, unsigned l)
{
    const struct model *path = batch->path;
    return path->n_alpha ? batch->w + (path->i_alpha + l) * batch->stride : batch->one;
}

/* Density, fractions of a path of one material, and the sources of mass where the materials are. */
static void source_begin(const struct source *source, struct source_batch *batch)
{
    const struct model *path = batch->path;
    for (size_t i = 0; i < batch->n; i++) batch->one[i] = 1.0;
    memset(batch->rho, 0, batch->n * sizeof *batch->rho);
    memset(batch->all, 0, batch->n * sizeof *batch->all);
    for (unsigned l = 0; l < path->n_material; l++) {
        row_add_product(batch->n, source_alpha(batch, l), batch->w + (path->i_m + l) * batch->stride, batch->rho);
        const double *given = source->values->row[SCENE_SOURCE_MASS + path->first + l];
        if (!given) continue;
        source_where(batch->n, source_alpha(batch, l), given, batch->mass[l]);
        row_add(batch->n, batch->mass[l], batch->all);
    }
}

static double *source_rate(const struct source_batch *batch, unsigned q)
{
    return batch->rates + q * batch->stride;
}

static void source_forces(const struct source *source, const struct source_batch *batch)
{
    const struct model *path = batch->path;
    for (unsigned d = 0; d < path->n_velocity; d++) {
        unsigned a = SCENE_SOURCE_ACCELERATION + d, f = SCENE_SOURCE_FORCE + d;
        const double *u = batch->w + (path->i_u + d) * batch->stride;
        double *momentum = source_rate(batch, path->i_u + d), *energy = source_rate(batch, path->i_E);
        if (source->values->row[a] || source->values->row[f])
            source_push(batch->n, source_given(source, a), source_given(source, f), batch->rho, u, momentum, energy);
        if (source->fills) source_kinetic(batch->n, batch->all, u, momentum, energy);
    }
}

/* Heat and mass of one material, and what they would have for a volume. */
static void source_material(struct source *source, struct source_batch *batch, unsigned l)
{
    const struct model *path = batch->path;
    const struct model_eos *eos = &path->eos[l];
    unsigned heat = SCENE_SOURCE_HEATING_OF + path->first + l, mass = SCENE_SOURCE_MASS + path->first + l;
    const double *rho = batch->w + (path->i_m + l) * batch->stride, *p = batch->w + path->i_E * batch->stride;
    double rho_e[SOURCE_BATCH], rho_c2[SOURCE_BATCH];
    if (!source->heats && !source->fills) return;
    memcpy(batch->heat, source_given(source, SCENE_SOURCE_HEATING), batch->n * sizeof *batch->heat);
    if (source->values->row[heat]) row_add(batch->n, source->values->row[heat], batch->heat);
    row_add_product(batch->n, source_alpha(batch, l), batch->heat, source_rate(batch, path->i_E));
    const double *brings = source->values->row[mass] ? batch->mass[l] : source_zero;
    if (!path->kapila && !source->values->row[mass]) return;
    eos->law->state(eos->self, batch->n, rho, p, rho_e, rho_c2);
    source_enthalpy(batch->n, brings, rho, p, rho_e, source_rate(batch, path->i_E));
    row_add(batch->n, brings, source_rate(batch, path->i_m + l));
    if (!path->kapila) return;
    swell_material(&source->swell, l, source_alpha(batch, l), rho, p, rho_c2, batch->heat, brings);
}

/* The rates that are given. */
static void source_fractions(const struct source *source, const struct source_batch *batch)
{
    const struct model *path = batch->path;
    const double *p = batch->w + path->i_E * batch->stride;
    for (unsigned l = 0; l < path->n_alpha; l++) {
        const double *given = source->values->row[SCENE_SOURCE_FRACTION + path->first + l];
        if (!given) continue;
        row_add(batch->n, given, source_rate(batch, path->i_alpha + l));
        if (path->kapila) row_add_product(batch->n, given, p, source_rate(batch, batch->exchange + l));
    }
}

/* Rates of a stretch are those of m V, m the mass of the solid that carries it (elastic.h). */
static void source_stretch(const struct source *source, const struct source_batch *batch)
{
    const struct model *path = batch->path;
    double m[SOURCE_BATCH], energy[SOURCE_BATCH];
    const double *masses[SCENE_MATERIALS], *V = batch->w + path->i_V * batch->stride;
    for (unsigned s = 0; s < path->n_solid; s++) {
        unsigned l = path->solids[s].material;
        bool given = source->values->row[SCENE_SOURCE_MASS + path->first + l];
        masses[s] = given ? batch->mass[l] : source_zero;
    }
    elastic_energy(path, batch->n, batch->stride, V, masses, energy);
    row_add(batch->n, energy, source_rate(batch, path->i_E));
    for (unsigned k = 0; k < model_stretches(path); k++) {
        unsigned s = model_bearer(path, k), l = path->solids[s].material, first = model_stretch(path, k);
        memset(m, 0, batch->n * sizeof *m);
        row_add_product(batch->n, source_alpha(batch, l), batch->w + (path->i_m + l) * batch->stride, m);
        for (unsigned c = 0; c < path->n_stretch; c++) {
            const double *given = k < path->n_solid ? source->values->row[SCENE_SOURCE_STRETCH + c] : NULL;
            row_add_product(batch->n, batch->w + (first + c) * batch->stride, masses[s], source_rate(batch, first + c));
            if (given) row_add_product(batch->n, given, m, source_rate(batch, first + c));
        }
    }
}

static void source_cells(struct term_tile *tile)
{
    struct source *source = tile->own;
    const struct model *path = tile->model;
    struct source_batch batch; /* large: filled as far as it is used */
    batch.path = path;
    batch.exchange = path->kapila ? terms_first(tile->terms, &exchange_term) : 0;
    batch.stride = tile->n_cell;
    source_value_places(source->values, tile->level, tile->tile);
    for (size_t from = 0; from < batch.stride; from += SOURCE_BATCH) {
        batch.n = batch.stride - from < SOURCE_BATCH ? batch.stride - from : SOURCE_BATCH;
        batch.w = tile->w + from;
        batch.rates = tile->rates + from;
        source_value_cells(source->values, tile->tile, tile->t, from, batch.n);
        source_begin(source, &batch);
        source_forces(source, &batch);
        swell_begin(&source->swell, path, batch.n);
        for (unsigned l = 0; l < path->n_material; l++) source_material(source, &batch, l);
        if (path->kapila && (source->heats || source->fills)) swell_share(&source->swell, tile, from);
        if (path->n_alpha) source_fractions(source, &batch);
        if (path->n_stretch && (source->fills || source->strains)) source_stretch(source, &batch);
    }
}

static void source_frame(const struct term_piece *piece)
{
    struct source *source = piece->own;
    source->values->path = piece->model;
    source_weight_frame(source->values, piece);
}

const struct term source_term = {
    .name = "sources",
    .owner = "core/scheme/source.c",
    .equation = "d(m_l, rho u, rho E, alpha_l, V)/dt += what the case gives",
    .wanted = source_wanted,
    .moves = true,
    .spreads = source_spreads,
    .open = source_open,
    .close = source_close,
    .failure = source_failure,
    .frame = source_frame,
    .cells = source_cells,
    .say = source_say,
};
