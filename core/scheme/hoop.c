/* hoop.c - see hoop.h. */
#include "scheme/hoop.h"

#include "base/mem.h"
#include "phys/mix.h"

static bool hoop_wanted(const struct model *path)
{
    return path->beta > 0;
}

/* A row, for scenes with a solid. */
static void *hoop_open(const struct term_room *room)
{
    return room->model->elastic ? mem_new(room->mesh->n_cell, sizeof(double)) : NULL;
}

static void hoop_begin(struct term_tile *tile)
{
    const struct model *model = tile->model;
    tile->hoop = tile->w + model->i_E * tile->n_cell;
    if (!model->n_stretch) return;
    mix_hoop(model, tile->n_cell, tile->n_cell, tile->w, tile->own);
    tile->hoop = tile->own;
}

const struct term hoop_term = {
    .name = "hoop",
    .owner = "core/scheme/hoop.c",
    .equation = "d(rho u_r)/dt += -beta s_thth / r, inside the divergence: a state at rest stays at rest",
    .wanted = hoop_wanted,
    .open = hoop_open,
    .close = mem_free,
    .begin = hoop_begin,
};
