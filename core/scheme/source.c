/* source.c - see source.h.
 *
 * Cells are taken in batches: first the values of all sources are asked for, cell by cell, as rows; then
 * kernels make rates of them. Places come from the integer index of a cell in its level, mirrored to the bit in a domain
 * that is symmetric about 0, so that results depend neither on tiles nor on ranks. */
#include "scheme/source.h"

#include "base/mem.h"
#include "base/status.h"
#include "case/script_table.h"
#include "mesh/metric.h"
#include "phys/elastic.h"
#include "phys/mix.h"
#include "phys/row.h"
#include "scheme/exchange.h"
#include "scheme/swell.h"
#include "scheme/terms.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

enum { SOURCE_BATCH = SWELL_BATCH, SOURCE_NAMES = 2 * SCENE_SOURCES };

struct source {
    const struct model *model;
    const struct mesh *mesh;
    double *row[SCENE_SOURCES];                      /* values of a batch; NULL: not given */
    double *rows;                                    /* where they lie */
    unsigned char varying[SCENE_SOURCES], n_varying; /* those that are expressions */
    bool heats, fills, strains;                      /* is there any heat, mass, rate of the stretch? */
    const struct script_table *names;
    unsigned n_name;
    unsigned char slot[SOURCE_NAMES]; /* which value each name of the table means */
    double x[3][METRIC_CELLS];        /* middles of the cells of the tile */
    struct swell swell;
    int status;
    char *message, place[192];
};

static const double source_zero[SOURCE_BATCH];

/* Names of one value in a Lua table: "force_x" and "force.1", or one alone. */
struct source_names {
    char text[SOURCE_NAMES][SCENE_NAME + 24];
    const char *list[SOURCE_NAMES];
};

static void source_name(struct source *source, struct source_names *names, unsigned slot, const char *group,
                        const char *plain, const char *element)
{
    for (int spelling = 0; spelling < (element ? 2 : 1); spelling++) {
        char *text = names->text[source->n_name];
        if (!element) snprintf(text, sizeof *names->text, "%s", group);
        else snprintf(text, sizeof *names->text, spelling ? "%s.%s" : "%s_%s", group, spelling ? element : plain);
        names->list[source->n_name] = text;
        source->slot[source->n_name++] = (unsigned char)slot;
    }
}

/* What a Lua table may hold in this scene. */
static void source_name_all(struct source *source)
{
    static const char *const axis[] = {"x", "y", "z"}, *const number[] = {"1", "2", "3"};
    struct source_names *names = mem_new(1, sizeof *names);
    const struct model *model = source->model;
    for (unsigned d = 0; d < model->n_velocity; d++) {
        source_name(source, names, SCENE_SOURCE_ACCELERATION + d, "acceleration", axis[d], number[d]);
        source_name(source, names, SCENE_SOURCE_FORCE + d, "force", axis[d], number[d]);
    }
    source_name(source, names, SCENE_SOURCE_HEATING, "heating", NULL, NULL);
    for (unsigned l = 0; l < model->n_material; l++) {
        const char *material = model->scene->material[l].name;
        source_name(source, names, SCENE_SOURCE_HEATING_OF + l, "heating", material, material);
        source_name(source, names, SCENE_SOURCE_MASS + l, "mass", material, material);
        if (model->n_alpha) source_name(source, names, SCENE_SOURCE_FRACTION + l, "alpha", material, material);
    }
    for (unsigned c = 0; c < model->n_stretch; c++)
        source_name(source, names, SCENE_SOURCE_STRETCH + c, "stretch", model_tensor[c], model_tensor[c]);
    source->names = script_table(model->scene->host, names->list, source->n_name);
    mem_free(names);
}

static bool source_wanted(const struct model *path)
{
    return path->scene->sources != NULL;
}

static void *source_open(const struct term_room *room)
{
    const struct model *model = room->model;
    const struct scene_sources *sources = model->scene->sources;
    struct source *source = mem_new(1, sizeof *source);
    source->model = model;
    source->mesh = room->mesh;
    if (sources->script) source_name_all(source);
    source->rows = mem_new((size_t)SCENE_SOURCES * SOURCE_BATCH, sizeof *source->rows);
    for (unsigned s = 0; s < SCENE_SOURCES; s++) {
        const struct scene_value *value = &sources->value[s];
        bool named = value->given;
        for (unsigned i = 0; i < source->n_name; i++) named = named || source->slot[i] == s;
        if (!named) continue;
        source->row[s] = source->rows + (size_t)s * SOURCE_BATCH;
        if (value->given && value->script) source->varying[source->n_varying++] = (unsigned char)s;
        else
            for (size_t i = 0; i < SOURCE_BATCH; i++) source->row[s][i] = value->given ? value->number : 0.0;
        source->heats = source->heats || (s >= SCENE_SOURCE_HEATING && s < SCENE_SOURCE_MASS);
        source->fills = source->fills || (s >= SCENE_SOURCE_MASS && s < SCENE_SOURCE_FRACTION);
        source->strains = source->strains || s >= SCENE_SOURCE_STRETCH;
    }
    return source;
}

static void source_close(void *own)
{
    struct source *source = own;
    mem_free(source->rows);
    mem_free(source->message);
    mem_free(source);
}

static int source_failure(const void *own, const char **ret_message, const char **ret_place)
{
    const struct source *source = own;
    if (!source->status) return STATUS_OK;
    *ret_message = source->message;
    *ret_place = source->place;
    return source->status;
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

static void source_places(struct source *source, const struct level *level, const struct tile *tile)
{
    const struct mesh *mesh = source->mesh;
    for (int d = 0; d < mesh->dim; d++) {
        int cells = level->extent[d] * mesh->n[d], first = tile->at[d] * mesh->n[d];
        double lower = mesh->lower[d];
        for (int i = 0; i < mesh->n[d]; i++) {
            int next = first + i + 1;
            double upper = (mesh->lower[d] * (cells - next) + mesh->upper[d] * next) / cells;
            if (i == 0) lower = (mesh->lower[d] * (cells - first) + mesh->upper[d] * first) / cells;
            source->x[d][i] = metric_centroid(d ? 0 : mesh->beta, lower, upper);
            lower = upper;
        }
    }
}

/* The first failure: in which cell of which tile. */
static void source_fail(struct source *source, const struct tile *tile, int status, const double x[3],
                        const size_t cell[3])
{
    if (source->status) return;
    source->status = status;
    source->message = mem_text(status_text());
    snprintf(source->place, sizeof source->place,
             "tile (%d, %d, %d), sources at (%.9g, %.9g, %.9g) m, in cell (%zu, %zu, %zu)", tile->at[0], tile->at[1],
             tile->at[2], x[0], x[1], x[2], cell[0], cell[1], cell[2]);
}

/* The values that vary, at one point, into element i of their rows. */
static int source_ask(struct source *source, const double x[3], double t, size_t i)
{
    const struct scene_sources *sources = source->model->scene->sources;
    double r = sqrt(x[0] * x[0] + x[1] * x[1] + x[2] * x[2]), out[SOURCE_NAMES], in[] = {x[0], x[1], x[2], t};
    for (unsigned k = 0; k < source->n_name; k++) {
        const struct scene_value *value = &sources->value[source->slot[k]];
        source->row[source->slot[k]][i] = value->given ? value->number : 0.0;
    }
    for (unsigned k = 0; k < source->n_varying; k++) {
        unsigned s = source->varying[k];
        TRY(scene_value_at(&sources->value[s], x, r, t, &source->row[s][i]));
    }
    if (!sources->script) return STATUS_OK;
    TRY(script_table_call(sources->script, in, 4, source->names, out));
    for (unsigned k = 0; k < source->n_name; k++)
        if (!isnan(out[k])) source->row[source->slot[k]][i] += out[k];
    return STATUS_OK;
}

static void source_evaluate(struct source *source, const struct tile *tile, double t, size_t from, size_t n)
{
    const struct mesh *mesh = source->mesh;
    for (size_t i = 0; i < n; i++) {
        double x[3] = {0.0};
        size_t rest = from + i, cell[3] = {0};
        for (int d = 0; d < mesh->dim; d++) {
            cell[d] = rest % (size_t)mesh->n[d];
            rest /= (size_t)mesh->n[d];
            x[d] = source->x[d][cell[d]];
        }
        int status = source_ask(source, x, t, i);
        if (!status) continue;
        source_fail(source, tile, status, x, cell);
        for (unsigned k = 0; k < source->n_varying; k++) source->row[source->varying[k]][i] = (double)NAN;
        for (unsigned k = 0; k < source->n_name; k++) source->row[source->slot[k]][i] = (double)NAN;
    }
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
    return source->row[slot] ? source->row[slot] : source_zero;
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
        const double *given = source->row[SCENE_SOURCE_MASS + path->first + l];
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
        if (source->row[a] || source->row[f])
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
    if (source->row[heat]) row_add(batch->n, source->row[heat], batch->heat);
    row_add_product(batch->n, source_alpha(batch, l), batch->heat, source_rate(batch, path->i_E));
    const double *brings = source->row[mass] ? batch->mass[l] : source_zero;
    if (!path->kapila && !source->row[mass]) return;
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
        const double *given = source->row[SCENE_SOURCE_FRACTION + path->first + l];
        if (!given) continue;
        row_add(batch->n, given, source_rate(batch, path->i_alpha + l));
        if (path->kapila) row_add_product(batch->n, given, p, source_rate(batch, batch->exchange + l));
    }
}

/* Rates of the stretch are those of m V, m the mass of the solids (elastic.h). */
static void source_stretch(const struct source *source, const struct source_batch *batch)
{
    const struct model *path = batch->path;
    double m[SOURCE_BATCH] = {0}, arrives[SOURCE_BATCH] = {0}, energy[SOURCE_BATCH];
    const double *masses[SCENE_MATERIALS], *V = batch->w + path->i_V * batch->stride;
    for (unsigned s = 0; s < path->n_solid; s++) {
        unsigned l = path->solids[s].material;
        bool given = source->row[SCENE_SOURCE_MASS + path->first + l];
        masses[s] = given ? batch->mass[l] : source_zero;
        row_add_product(batch->n, source_alpha(batch, l), batch->w + (path->i_m + l) * batch->stride, m);
        row_add(batch->n, masses[s], arrives);
    }
    elastic_energy(path, batch->n, batch->stride, V, masses, energy);
    row_add(batch->n, energy, source_rate(batch, path->i_E));
    for (unsigned c = 0; c < path->n_stretch; c++) {
        const double *given = source->row[SCENE_SOURCE_STRETCH + c];
        row_add_product(batch->n, V + c * batch->stride, arrives, source_rate(batch, path->i_V + c));
        if (given) row_add_product(batch->n, given, m, source_rate(batch, path->i_V + c));
    }
}

static void source_cells(struct term_tile *tile)
{
    struct source *source = tile->own;
    const struct model *path = tile->model;
    struct source_batch batch; /* large: filled as far as it is used */
    bool varies = source->n_varying || source->n_name;
    batch.path = path;
    batch.exchange = path->kapila ? terms_first(tile->terms, &exchange_term) : 0;
    batch.stride = source->mesh->n_cell;
    if (varies) source_places(source, tile->level, tile->tile);
    for (size_t from = 0; from < batch.stride; from += SOURCE_BATCH) {
        batch.n = batch.stride - from < SOURCE_BATCH ? batch.stride - from : SOURCE_BATCH;
        batch.w = tile->w + from;
        batch.rates = tile->rates + from;
        if (varies) source_evaluate(source, tile->tile, tile->t, from, batch.n);
        source_begin(source, &batch);
        source_forces(source, &batch);
        swell_begin(&source->swell, path, batch.n);
        for (unsigned l = 0; l < path->n_material; l++) source_material(source, &batch, l);
        if (path->kapila && (source->heats || source->fills)) swell_share(&source->swell, tile, from);
        if (path->n_alpha) source_fractions(source, &batch);
        if (path->n_stretch && (source->fills || source->strains)) source_stretch(source, &batch);
    }
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
    .cells = source_cells,
    .say = source_say,
};
