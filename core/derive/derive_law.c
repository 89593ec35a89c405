/* derive_law.c - see derive_law.h. A module gets a whole tile as one row: primitives as they lie, what it needs beside
 * them in rows made for it. All of its outputs are computed, one is kept. */
#include "derive/derive_law.h"

#include "base/mem.h"
#include "derive/derive_slope.h"
#include "mesh/metric.h"
#include "phys/mix.h"

#include <string.h>

enum { DERIVE_LAW_SLOPED = SCENE_AXES + 2 }; /* rows with slopes, at most: velocities, pressure, density */
enum { DERIVE_LAW_SLOPES = BULLA_FIELD_VELOCITY_SLOPES | BULLA_FIELD_PRESSURE_SLOPES | BULLA_FIELD_DENSITY_SLOPES };

static const struct bulla_field *derive_law_table(const struct scene *scene, int index)
{
    return scene->derived[index / BULLA_FIELD_OUTPUTS].law.module->table;
}

int derive_law_find(const struct scene *scene, const char *name, const char **ret_unit)
{
    for (unsigned i = 0; i < scene->n_derived; i++) {
        const struct bulla_field_output *outputs = derive_law_table(scene, (int)(i * BULLA_FIELD_OUTPUTS))->outputs;
        for (unsigned k = 0; outputs[k].unit; k++) {
            if (strcmp(scene->derived[i].names[k], name) != 0) continue;
            *ret_unit = outputs[k].unit;
            return (int)(i * BULLA_FIELD_OUTPUTS + k);
        }
    }
    return -1;
}

bool derive_law_needs_layers(const struct scene *scene, const struct derive *field)
{
    return derive_law_table(scene, field->index)->needs & DERIVE_LAW_SLOPES;
}

/* Rows that are made for one call; those that nobody needs stay NULL. */
struct derive_law_rows {
    double *zero, *one, *place[SCENE_AXES], *volume, *c, *T, *rho_E, *slope[SCENE_AXES * DERIVE_LAW_SLOPED];
    const double *alpha[SCENE_MATERIALS], *rho[SCENE_MATERIALS], *u[SCENE_AXES], *temperatures[SCENE_MATERIALS];
    double *out[BULLA_FIELD_OUTPUTS];
    struct bulla_points cells;
};

static double *derive_law_row(size_t n, double value)
{
    double *row = mem_new(n, sizeof *row);
    for (size_t i = 0; i < n; i++) row[i] = value;
    return row;
}

/* Centres and volumes of the cells. */
static void derive_law_places(const struct derive_view *tile, struct derive_law_rows *rows)
{
    const struct mesh *mesh = tile->mesh;
    double corner[3];
    mesh_corner(mesh, tile->level, &tile->level->tiles[tile->level->first + tile->local], corner);
    for (int d = 0; d < SCENE_AXES; d++) {
        double *row = rows->place[d] = derive_law_row(tile->n, 0.0);
        size_t inner = 1;
        for (int e = 0; e < d; e++) inner *= (size_t)mesh->n[e];
        for (size_t i = 0; i < tile->n && d < mesh->dim; i++)
            row[i] = corner[d] + ((double)(i / inner % (size_t)mesh->n[d]) + 0.5) * tile->level->h[d];
        rows->cells.x[d] = row;
        rows->cells.h[d] = d < mesh->dim ? tile->level->h[d] : 0.0;
    }
    rows->volume = derive_law_row(tile->n, 0.0);
    metric_volumes(mesh, tile->level, &tile->level->tiles[tile->level->first + tile->local], rows->volume);
    rows->cells.volume = rows->volume;
}

static void derive_law_primitives(const struct derive_view *tile, struct derive_law_rows *rows)
{
    const struct model *model = tile->model;
    for (unsigned l = 0; l < model->n_material; l++) {
        rows->alpha[l] = model->n_alpha ? derive_view_w(tile, model->i_alpha + l) : rows->one;
        rows->rho[l] = derive_view_w(tile, model->i_m + l);
    }
    for (unsigned d = 0; d < model->n_velocity; d++) rows->u[d] = derive_view_w(tile, model->i_u + d);
    rows->cells.alpha = rows->alpha;
    rows->cells.rho = rows->rho;
    rows->cells.u = rows->u;
    rows->cells.p = derive_view_w(tile, model->i_E);
}

/* A field of the program's own that needs no neighbours. */
static double *derive_law_own(const struct derive_view *tile, const char *name)
{
    struct derive field;
    double *row = derive_law_row(tile->n, 0.0);
    if (!derive_find(tile->model, name, &field))
        derive_tile(tile->model, tile->mesh, tile->level_index, tile->local, tile->t, &field, row);
    return row;
}

/* What the laws of the materials make of a cell. */
static void derive_law_states(const struct derive_view *tile, uint32_t needs, struct derive_law_rows *rows)
{
    const struct model *model = tile->model;
    if (needs & BULLA_FIELD_SOUND) rows->c = derive_law_own(tile, "sound_speed");
    if (needs & BULLA_FIELD_ENERGY) rows->rho_E = derive_law_own(tile, "total_energy");
    if (needs & BULLA_FIELD_TEMPERATURES) {
        rows->T = mem_new(model->n_material * tile->n, sizeof *rows->T);
        mix_temperatures(model, tile->n, tile->n, tile->w, rows->T);
        for (unsigned l = 0; l < model->n_material; l++) rows->temperatures[l] = rows->T + l * tile->n;
        rows->cells.T = rows->temperatures;
    }
    rows->cells.c = rows->c;
    rows->cells.rho_E = rows->rho_E;
}

/* What a module gets slopes of: the primitives, or the density. Returns how many. */
static unsigned derive_law_sloped(const struct model *model, uint32_t needs, int q[static DERIVE_LAW_SLOPED])
{
    unsigned n = 0;
    for (unsigned d = 0; d < model->n_velocity && needs & BULLA_FIELD_VELOCITY_SLOPES; d++)
        q[n++] = (int)(model->i_u + d);
    if (needs & BULLA_FIELD_PRESSURE_SLOPES) q[n++] = (int)model->i_E;
    if (needs & BULLA_FIELD_DENSITY_SLOPES) q[n++] = DERIVE_SLOPE_RHO;
    return n;
}

/* Slopes along an axis; zeros along those that the scene has not. */
static void derive_law_slope(const struct derive_view *tile, int axis, uint32_t needs, struct derive_law_rows *rows)
{
    int q[DERIVE_LAW_SLOPED];
    unsigned n = derive_law_sloped(tile->model, needs, q);
    double *const *slope = rows->slope + axis * DERIVE_LAW_SLOPED;
    const double *row = rows->zero;
    bool varies = axis < tile->mesh->dim;
    for (unsigned k = 0; k < n && varies; k++)
        rows->slope[axis * DERIVE_LAW_SLOPED + (int)k] = derive_law_row(tile->n, 0.0);
    if (varies && n) derive_slope_rows(tile, axis, n, q, slope);
    for (unsigned k = 0; k < n; k++) {
        if (varies) row = slope[k];
        if (q[k] == DERIVE_SLOPE_RHO) rows->cells.drho[axis] = row;
        else if (q[k] == (int)tile->model->i_E) rows->cells.dp[axis] = row;
        else rows->cells.du[q[k] - (int)tile->model->i_u][axis] = row;
    }
    for (unsigned of = tile->model->n_velocity; of < SCENE_AXES && needs & BULLA_FIELD_VELOCITY_SLOPES; of++)
        rows->cells.du[of][axis] = rows->zero;
}

static void derive_law_free(struct derive_law_rows *rows)
{
    double *own[] = {rows->zero, rows->one, rows->volume, rows->c, rows->T, rows->rho_E};
    for (size_t i = 0; i < sizeof own / sizeof *own; i++) mem_free(own[i]);
    for (int d = 0; d < SCENE_AXES; d++) mem_free(rows->place[d]);
    for (size_t i = 0; i < sizeof rows->slope / sizeof *rows->slope; i++) mem_free(rows->slope[i]);
    for (int k = 0; k < BULLA_FIELD_OUTPUTS; k++) mem_free(rows->out[k]);
}

void derive_law(const struct derive_view *tile, double *out)
{
    const struct model *model = tile->model;
    int index = tile->field->index;
    const struct bulla_field *law = derive_law_table(model->scene, index);
    const void *self = model->scene->derived[index / BULLA_FIELD_OUTPUTS].law.self;
    struct derive_law_rows rows = {.zero = derive_law_row(tile->n, 0.0), .one = derive_law_row(tile->n, 1.0)};
    rows.cells = (struct bulla_points){.size = sizeof rows.cells,
                                       .n_material = model->n_material,
                                       .n_velocity = model->n_velocity,
                                       .dim = (uint32_t)tile->mesh->dim,
                                       .beta = (uint32_t)model->beta,
                                       .n = tile->n,
                                       .t = tile->t};
    derive_law_places(tile, &rows);
    derive_law_primitives(tile, &rows);
    derive_law_states(tile, law->needs, &rows);
    for (int axis = 0; axis < SCENE_AXES; axis++) derive_law_slope(tile, axis, law->needs, &rows);
    for (int k = 0; k < BULLA_FIELD_OUTPUTS && law->outputs[k].unit; k++) rows.out[k] = derive_law_row(tile->n, 0.0);
    law->compute(self, &rows.cells, rows.out);
    memcpy(out, rows.out[index % BULLA_FIELD_OUTPUTS], tile->n * sizeof *out);
    derive_law_free(&rows);
}
