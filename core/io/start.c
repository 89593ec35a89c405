/* start.c - see start.h. */
#include "io/start.h"

#include "base/mem.h"
#include "base/status.h"
#include "case/donor.h"
#include "io/facts.h"
#include "io/resume.h"
#include "mesh/mesh.h"
#include "mesh/morton.h"
#include "phys/model.h"

#include <stdlib.h>
#include <string.h>

struct start {
    const struct scene *scene;
    const struct scene_layer *layer;
    const struct model *model;
    struct resume *from;
    struct donor *donor;
    int tile; /* side of a tile of the donor */
    size_t n_cell;
    unsigned stored; /* fields in the file: without the volume fraction of an only material */
};

static int start_fail(const struct start *start, const char *what)
{
    return status_fail(STATUS_CASE, "%s:%d: initial: %s: %s", start->scene->path, start->layer->line,
                       start->layer->checkpoint, what);
}

static int start_numbers(const struct start *start, const char *name, unsigned n, double *ret)
{
    if (notes_get(&start->from->notes, name, n, ret)) return STATUS_OK;
    char *what = mem_print("the checkpoint says nothing about %s", name);
    int code = start_fail(start, what);
    mem_free(what);
    return code;
}

static int start_geometry(struct start *start)
{
    static const char *const geometries[] = {"cartesian", "axisymmetric", "spherical"};
    const struct scene_domain *domain = &start->scene->domain;
    struct donor *donor = start->donor;
    char *geometry = notes_get_text(&start->from->notes, "domain.geometry");
    double cells[3] = {1, 1, 1}, tile;
    donor->beta = -1;
    for (int beta = 0; geometry && beta < 3; beta++)
        if (strcmp(geometry, geometries[beta]) == 0) donor->beta = beta;
    mem_free(geometry);
    while (donor->dim < 3 && !notes_get(&start->from->notes, "domain.cells", (unsigned)donor->dim + 1, cells))
        donor->dim++;
    donor->dim++;
    bool same = donor->beta == (int)domain->geometry && donor->dim == domain->dim;
    bool ball = donor->beta == 2 && (domain->geometry == SCENE_AXISYMMETRIC || domain->dim == 3);
    bool rings = donor->beta == 1 && domain->dim == 3;
    if (!same && !ball && !rings)
        return start_fail(start, "a checkpoint of this geometry cannot be painted here: the same geometry with as many "
                                 "axes can, a spherical one in axisymmetric and 3D scenes, an axisymmetric one in 3D");
    if (start->layer->axis >= 0 && !rings)
        return start_fail(start, "'axis' is for a checkpoint of an axisymmetric run in a 3D scene");
    donor->axis = start->layer->axis >= 0 ? start->layer->axis : 2;
    if (domain->geometry != SCENE_CARTESIAN && start->layer->at[0] != 0.0)
        return start_fail(start, "'at' must lie on the axis (or at the centre), where the first coordinate is 0");
    TRY(start_numbers(start, "domain.lower", (unsigned)donor->dim, donor->domain[0]));
    TRY(start_numbers(start, "domain.upper", (unsigned)donor->dim, donor->domain[1]));
    TRY(start_numbers(start, "mesh.tile", 1, &tile));
    start->tile = (int)tile;
    start->n_cell = 1;
    for (int d = 0; d < 3; d++) donor->buckets[d] = d < donor->dim ? (int)cells[d] : 1;
    for (int d = 0; d < donor->dim; d++) start->n_cell *= (size_t)start->tile;
    return STATUS_OK;
}

/* The laws of the materials that the checkpoint has must be those of this case. */
static int start_laws(const struct start *start, const char *materials)
{
    struct notes now = {0};
    int code = STATUS_OK;
    facts_put(start->scene, start->model, start->tile, &now);
    for (const char *at = materials; !code && *at; at += strspn(at, " ")) {
        size_t length = strcspn(at, " ");
        char *name = mem_print("materials.%.*s.eos", (int)length, at),
             *solid = mem_print("materials.%.*s.constitutive", (int)length, at);
        char *was = notes_get_text(&start->from->notes, name), *is = notes_get_text(&now, name);
        char *elastic = notes_get_text(&start->from->notes, solid), *what = NULL;
        if (elastic) what = mem_print("'%.*s' is a solid there: only fluids can be painted", (int)length, at);
        else if (!is) what = mem_print("there is no material '%.*s' here", (int)length, at);
        else if (!was || strcmp(was, is) != 0)
            what = mem_print("the law of '%.*s' is '%s' there and '%s' here", (int)length, at, was ? was : "", is);
        if (what) code = start_fail(start, what);
        char *const texts[] = {name, solid, was, is, elastic, what};
        for (size_t i = 0; i < sizeof texts / sizeof *texts; i++) mem_free(texts[i]);
        at += length;
    }
    text_done(&now.text);
    return code;
}

/* Which field of this run's model a field of the checkpoint is; -1: none. */
static int start_field(const struct start *start, const char *name, size_t length)
{
    for (unsigned q = 0; q < start->model->n_field; q++)
        if (strlen(start->model->field_names[q]) == length && strncmp(start->model->field_names[q], name, length) == 0)
            return (int)q;
    return -1;
}

/* The names of the checkpoint's fields, and the volume fraction of its only material, which it does not have. */
static int start_fields(struct start *start)
{
    struct donor *donor = start->donor;
    char *materials = notes_get_text(&start->from->notes, "materials"),
         *fields = notes_get_text(&start->from->notes, "fields");
    int code = materials && fields ? start_laws(start, materials)
                                   : start_fail(start, "the checkpoint does not name its fields");
    donor->what = mem_new(MODEL_FIELDS + 1, sizeof *donor->what);
    donor->momentum = (int)start->model->i_u;
    for (const char *at = fields; !code && *at; at += strspn(at, " ")) {
        size_t length = strcspn(at, " ");
        int q = start_field(start, at, length);
        if (q < 0 || donor->n_field == MODEL_FIELDS) code = start_fail(start, "it has a field that this case has not");
        else donor->what[donor->n_field++] = q;
        at += length;
    }
    start->stored = donor->n_field;
    if (!code && start->model->n_alpha && donor->what[0] >= (int)start->model->i_m) {
        char *name = mem_print("alpha_%s", materials);
        donor->what[donor->n_field++] = start_field(start, name, strlen(name));
        mem_free(name);
    }
    mem_free(materials);
    mem_free(fields);
    return code;
}

/* Is a tile of the next level under this octant of tile i? Tiles of a level follow the curve. */
static bool start_is_covered(const struct resume *from, size_t first, unsigned n, const int at[3])
{
    size_t low = first, high = first + n;
    uint64_t key = morton_key(at);
    while (low < high) {
        size_t middle = low + (high - low) / 2;
        if (from->tiles[middle].key < key) low = middle + 1;
        else high = middle;
    }
    return low < first + n && from->tiles[low].key == key;
}

/* Adds the leaves of one tile. */
static void start_tile(struct start *start, const struct tile *tile, int level, size_t finer, const double *u)
{
    struct donor *donor = start->donor;
    for (size_t c = 0; c < start->n_cell; c++) {
        struct donor_cell *cell = &donor->cells[donor->n];
        int octant[3] = {0};
        size_t rest = c;
        for (int d = 0; d < donor->dim; d++) {
            int i = (int)(rest % (size_t)start->tile), all = donor->buckets[d] << level;
            int place = tile->at[d] * start->tile + i;
            octant[d] = 2 * tile->at[d] + (i >= start->tile / 2);
            rest /= (size_t)start->tile;
            cell->lower[d] = (donor->domain[0][d] * (all - place) + donor->domain[1][d] * place) / all;
            cell->upper[d] = (donor->domain[0][d] * (all - place - 1) + donor->domain[1][d] * (place + 1)) / all;
        }
        unsigned n = level + 1 < start->from->n_level ? start->from->n_tile[level + 1] : 0;
        if (start_is_covered(start->from, finer, n, octant)) continue;
        double *to = donor->u + donor->n * donor->n_field;
        for (unsigned q = 0; q < donor->n_field; q++) to[q] = q < start->stored ? u[q * start->n_cell + c] : 1.0;
        donor->n++;
    }
}

static int start_compare(const void *a, const void *b)
{
    double x = ((const struct donor_cell *)a)->lower[0], y = ((const struct donor_cell *)b)->lower[0];
    return (x > y) - (x < y);
}

/* In one dimension the leaves rise along the axis. */
static void start_arrange(struct donor *donor)
{
    if (donor->dim > 1) return;
    struct donor_cell *cells = mem_new(donor->n + 1, sizeof *cells);
    double *u = mem_new(donor->n * donor->n_field + 1, sizeof *u);
    for (size_t i = 0; i < donor->n; i++) {
        cells[i] = donor->cells[i];
        cells[i].lower[1] = (double)i; /* where it was */
    }
    qsort(cells, donor->n, sizeof *cells, start_compare);
    for (size_t i = 0; i < donor->n; i++) {
        memcpy(u + i * donor->n_field, donor->u + (size_t)cells[i].lower[1] * donor->n_field,
               donor->n_field * sizeof *u);
        cells[i].lower[1] = 0.0;
    }
    mem_free(donor->cells);
    mem_free(donor->u);
    donor->cells = cells;
    donor->u = u;
}

static int start_cells(struct start *start)
{
    const struct resume *from = start->from;
    struct donor *donor = start->donor;
    size_t block = start->stored * start->n_cell, tile = 0, finer = 0;
    TRY(resume_has_rows(from, "/u", block * sizeof(double)));
    donor->cells = mem_new(from->n_all * start->n_cell + 1, sizeof *donor->cells);
    donor->u = mem_new(from->n_all * start->n_cell * donor->n_field + 1, sizeof *donor->u);
    double *u = mem_new(block, sizeof *u);
    int code = STATUS_OK;
    for (int level = 0; level < from->n_level; level++) {
        finer += from->n_tile[level];
        for (unsigned i = 0; i < from->n_tile[level] && !code; i++, tile++) {
            code = resume_row(from, "/u", tile, block * sizeof *u, u);
            if (!code) start_tile(start, &from->tiles[tile], level, finer, u);
        }
    }
    mem_free(u);
    return code;
}

static int start_read(struct start *start)
{
    TRY(start_geometry(start));
    TRY(start_fields(start));
    TRY(start_cells(start));
    start_arrange(start->donor);
    donor_sort(start->donor);
    return STATUS_OK;
}

static int start_layer(const struct scene *scene, const struct model *model, struct scene_layer *layer)
{
    struct start start = {.scene = scene, .layer = layer, .model = model};
    if (resume_look(layer->checkpoint, &start.from))
        return status_wrap(STATUS_CASE, "%s:%d: initial: ", scene->path, layer->line);
    start.donor = mem_new(1, sizeof *start.donor);
    int code = start_read(&start);
    resume_close(start.from);
    if (code && code != STATUS_CASE) code = status_wrap(STATUS_CASE, "%s:%d: initial: ", scene->path, layer->line);
    if (code) donor_free(start.donor);
    else layer->donor = start.donor;
    return code;
}

int start_load(struct scene *scene)
{
    struct model *model = NULL;
    int code = STATUS_OK;
    for (unsigned i = 0; i < scene->n_layer && !code; i++) {
        if (!scene->layers[i].checkpoint) continue;
        if (!model) model = model_new(scene);
        code = start_layer(scene, model, &scene->layers[i]);
    }
    model_free(model);
    return code;
}
