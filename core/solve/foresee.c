/* foresee.c - see foresee.h. */
#include "solve/foresee.h"

#include "phys/row.h"

/* Three arrays of a level [bytes] that caches do not hold from pass to pass. */
enum { FORESEE_LEAST = 8 << 20 };

static bool foresee_pays(const struct stage *stage)
{
    return 3 * stage->level->n_local * stage->model->n_field * stage->mesh->n_cell * sizeof(double) > FORESEE_LEAST;
}

/* What the tile was last advanced with; NULL: nothing is to be asked for. */
static const struct model *foresee_path(const struct stage *stage, unsigned local)
{
    if (local >= stage->level->n_local || stage->census.tiles[local].skipped || !foresee_pays(stage)) return NULL;
    return stage->census.tiles[local].path;
}

static void foresee_rows(const struct stage *stage, const struct model *path, const double *block)
{
    size_t n_cell = stage->mesh->n_cell;
    for (unsigned i = 0; i < path->n_active; i++) row_ask(1, 0, n_cell, block + path->active[i] * n_cell);
}

void foresee_block(const struct stage *stage, unsigned local, const double *block)
{
    if (foresee_pays(stage)) foresee_rows(stage, stage->census.tiles[local].path, block);
}

void foresee_gather(const struct stage *stage, const struct frame_source *source, const struct frame *frame,
                    unsigned local)
{
    const struct model *path = foresee_path(stage, local);
    if (!path || frame->axis + 1 < stage->mesh->dim || frame->outer_from || frame->inner_from) return;
    struct frame_source next = *source;
    next.n_field = path->n_active;
    next.fields = path->active;
    frame_foresee(&next, local);
}

void foresee_close(const struct stage *stage, unsigned local)
{
    const struct model *path = foresee_path(stage, local);
    if (!path) return;
    foresee_rows(stage, path, stage->level->u_new[local]);
    foresee_rows(stage, path, stage->level->w[local]);
}
