/* census.c - see census.h. */
#include "solve/census.h"

#include "mesh/link.h"
#include "scheme/operators.h"
#include "scheme/terms.h"

#include <string.h>

void census_receive(struct census *census)
{
    const struct link *link = census->level->link;
    size_t block = link->strip_doubles / census->model->n_field;
    for (unsigned f = 0; f < link->n_face; f++) {
        census->behind[f] = 0;
        for (unsigned l = 0; l < census->model->n_alpha; l++)
            for (size_t i = 0; i < 2 * block; i++)
                if (link->faces[f].strip[i / block][l * block + i % block] != 0.0) {
                    census->behind[f] |= 1u << l;
                    break;
                }
    }
}

unsigned census_materials(const struct model *model, size_t n_cell, const double *u)
{
    unsigned present = 0;
    for (unsigned l = 0; l < model->n_alpha; l++) {
        const double *alpha = u + (model->i_alpha + l) * n_cell, *m = u + (model->i_m + l) * n_cell;
        for (size_t i = 0; i < n_cell; i++)
            if ((alpha[i] != 0.0) | (m[i] != 0.0)) {
                present |= 1u << l;
                break;
            }
    }
    return present;
}

/* Does what lies behind a face hold nothing but these materials? Of other ranks that is not known here. */
static bool census_within(const struct census *census, unsigned local, int face, unsigned materials)
{
    const struct neighbour *neighbour = &census->level->neighbours[local][face];
    if (neighbour->kind == NEIGHBOUR_LOCAL) return !(census->tiles[neighbour->index].present & ~materials);
    if (neighbour->kind == NEIGHBOUR_COARSE) return !(census->behind[neighbour->index] & ~materials);
    return neighbour->kind == NEIGHBOUR_BOUNDARY &&
           !scene_boundary_is(census->model->scene, face, SCENE_BOUNDARY_BRINGS);
}

/* Can a tile make do with a narrowed path? */
static bool census_fits(const struct census *census, unsigned local, const struct model *path)
{
    unsigned materials = ((1u << path->n_material) - 1u) << path->first;
    if (census->tiles[local].present & ~materials || operators_spread(path)) return false;
    for (int face = 0; face < 2 * path->dim; face++)
        if (!census_within(census, local, face, materials)) return false;
    return true;
}

const struct model *census_choose(const struct census *census, unsigned local)
{
    const struct model *model = census->model;
    unsigned present = census->tiles[local].present, l = 0;
    if (!model->mixed || !present || terms_spread(model->scene)) return model;
    while (!(present >> l & 1)) l++;
    if (present >> l == 1 && census_fits(census, local, model->pure[l])) return model->pure[l];
    return model->fluids && census_fits(census, local, model->fluids) ? model->fluids : model;
}

/* Is a tile of one material uniform and at rest, to the bit (+0, not -0)? */
static bool census_is_still(const struct model *model, size_t n_cell, const double *w)
{
    static const double zero = 0.0;
    if (model->n_alpha) return false;
    for (unsigned i = 0; i < model->n_active; i++) {
        unsigned q = model->active[i];
        const double *row = w + q * n_cell;
        unsigned c;
        bool velocity = q >= model->i_u && q < model->i_E, stretch = model_is_stretch(model, q, &c);
        if (velocity && memcmp(row, &zero, sizeof zero)) return false;
        if (stretch && *row != (c < 3 ? 1.0 : 0.0)) return false; /* mirrors and hoops feel it; branches relax */
        if (memcmp(row, row + 1, (n_cell - 1) * sizeof *row)) return false;
    }
    return true;
}

/* Does what lies behind a face of a resting tile rest in the same state? */
static bool census_rests_behind(const struct census *census, unsigned local, int face)
{
    const struct level *level = census->level;
    const struct neighbour *neighbour = &level->neighbours[local][face];
    size_t n_cell = census->mesh->n_cell;
    if (neighbour->kind == NEIGHBOUR_BOUNDARY)
        return scene_boundary_is(census->model->scene, face, SCENE_BOUNDARY_RESTS) &&
               !scene_boundary_is_heated(census->model->scene, face);
    if (neighbour->kind != NEIGHBOUR_LOCAL) return false;
    const struct census_tile *other = &census->tiles[neighbour->index];
    if (!other->still || other->present != census->tiles[local].present) return false;
    for (unsigned q = 0; q < census->model->n_field; q++)
        if (memcmp(level->w[local] + q * n_cell, level->w[neighbour->index] + q * n_cell, sizeof(double))) return false;
    return true;
}

bool census_rests(const struct census *census, unsigned local)
{
    if (!census->tiles[local].still) return false;
    for (int face = 0; face < 2 * census->model->dim; face++)
        if (!census_rests_behind(census, local, face)) return false;
    return true;
}

void census_note(struct census *census, unsigned local, const double *u, const double *w)
{
    struct census_tile *tile = &census->tiles[local];
    size_t n_cell = census->mesh->n_cell;
    bool mixed = tile->path->n_alpha || !census->model->mixed;
    tile->present_next = mixed ? census_materials(census->model, n_cell, u) : tile->present;
    tile->still_next = census_is_still(tile->path, n_cell, w);
}

void census_note_primitives(struct census *census, unsigned local, const double *w)
{
    struct census_tile *tile = &census->tiles[local];
    tile->present_next = tile->present;
    tile->still_next = census_is_still(tile->path, census->mesh->n_cell, w);
}

void census_turn(struct census_tile *tile)
{
    tile->present = tile->present_next;
    tile->still = tile->still_next;
}

void census_forget(struct census *census, unsigned local)
{
    struct census_tile *tile = &census->tiles[local];
    *tile = (struct census_tile){.path = census->model, .signal = tile->signal};
    tile->present = census_materials(census->model, census->mesh->n_cell, census->level->u_old[local]);
}
