/* normals.c - see normals.h. */
#include "solve/normals.h"

#include "base/comm.h"
#include "base/status.h"
#include "mesh/link.h"
#include "scheme/normal.h"
#include "solve/around.h"
#include "solve/stage.h"
#include "solve/verdict.h"
#include "solve/work.h"

/* One level, whose coarser one has told what lies around it. */
static void normals_level(struct stage *stage)
{
    const struct level *level = stage->level;
    const struct model *model = stage->model;
    struct around *around = stage->work->around;
    if (level->link) level->link->theta = 0.0;
    around_start(around, stage->l, stage->bound);
    around_finish(around, stage->l, stage->bound);
    for (unsigned t = 0; t < level->n_local; t++)
        normal_make(model, stage->mesh, level->h, around_gather(around, stage->l, stage->bound, t),
                    level->u_old[t] + model->i_normal * stage->mesh->n_cell);
}

int normals_begin(struct state *state)
{
    struct mesh *mesh = state->mesh;
    if (!state->model->n_normal) return STATUS_OK;
    for (int l = 0; l < mesh->n_level; l++) {
        struct stage *stage = state->stages[l];
        normals_level(stage);
        if (l + 1 < mesh->n_level) {
            around_finer(stage->work->around, l, stage->bound, 0);
            around_down(stage->work->around, l + 1);
        }
        TRY(comm_agree(verdict_start(stage, &state->counts.relaxed)));
    }
    return STATUS_OK;
}
