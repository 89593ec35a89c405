/* derive_formula.c - see derive_formula.h. */
#include "derive/derive_formula.h"

#include "base/mem.h"

#include <string.h>

/* Centres of the cells along an axis; 0 beyond the dimension. */
static void derive_formula_places(const struct derive_view *tile, int axis, double *out)
{
    const struct mesh *mesh = tile->mesh;
    double corner[3];
    size_t cell = 0;
    int at[3];
    mesh_corner(mesh, tile->level, &tile->level->tiles[tile->level->first + tile->local], corner);
    for (at[2] = 0; at[2] < mesh->n[2]; at[2]++)
        for (at[1] = 0; at[1] < mesh->n[1]; at[1]++)
            for (at[0] = 0; at[0] < mesh->n[0]; at[0]++)
                out[cell++] = axis < mesh->dim ? corner[axis] + (at[axis] + 0.5) * tile->level->h[axis] : 0.0;
}

/* One argument in all cells of the tile. */
static void derive_formula_argument(const struct derive_view *tile, const char *name, double scale, double *out)
{
    struct derive field;
    if (strlen(name) == 1 && *name != 't') {
        derive_formula_places(tile, *name - 'x', out);
    } else if (strlen(name) == 1) {
        for (size_t i = 0; i < tile->n; i++) out[i] = tile->t;
    } else if (!derive_find(tile->model, name, &field)) { /* the case was checked */
        field.scale = scale;
        derive_tile(tile->model, tile->mesh, tile->level_index, tile->local, tile->t, &field, out);
    }
}

void derive_formula(const struct derive_view *tile, double *out)
{
    const struct scene_formula *formula = &tile->model->scene->output.formulas[tile->field->index];
    double *values = mem_new(formula->n_use * tile->n + 1, sizeof *values);
    const double *in[SCRIPT_ARGUMENTS];
    for (unsigned k = 0; k < formula->n_use; k++) {
        in[k] = values + k * tile->n;
        derive_formula_argument(tile, formula->uses[k], tile->field->scales[k], values + k * tile->n);
    }
    script_row(formula->script, tile->n, in, formula->n_use, out);
    mem_free(values);
}

void derive_formula_prepare(struct derive_moment *moment, struct derive *field)
{
    const struct scene_formula *formula = &moment->model->scene->output.formulas[field->index];
    struct derive of;
    for (unsigned k = 0; k < formula->n_use; k++) {
        if (strlen(formula->uses[k]) < 2 || derive_find(moment->model, formula->uses[k], &of)) continue;
        derive_prepare(moment, &of);
        field->scales[k] = of.scale;
    }
}
