/* shore.c - see shore.h. */
#include "scheme/shore.h"

#include "base/mem.h"
#include "phys/phase.h"
#include "phys/phase_pair.h"
#include "phys/row.h"
#include "scheme/patch.h"

#include <string.h>

/* Vapour and gases of a tile and the cells around it, and where in the row neighbours stand. */
struct shore {
    const struct mesh *mesh;
    struct box_block block;
    size_t step[3]; /* from a cell to the next along an axis */
    double front, onset;
    double *thin;
};

size_t shore_marks(const struct model *model, const struct mesh *mesh)
{
    return model->fronts ? model->n_phase * mesh->n_cell : 0;
}

/* Fraction of material `l` of the scene: all are there but the first, which is the rest. */
static void shore_add(const struct shore *shore, const struct model *path, unsigned l, const double *around)
{
    size_t n = shore->block.pitch;
    if (l > 0) {
        row_add(n, around + (l - 1) * n, shore->thin);
        return;
    }
    for (size_t i = 0; i < n; i++) {
        double others = 0.0;
        for (unsigned m = 0; m < path->n_around_alpha; m++) others += around[m * n + i];
        shore->thin[i] += 1.0 - others;
    }
}

/* Is the cell at `at` of the row at the shore? */
static bool shore_is(const struct shore *shore, size_t at)
{
    double own = shore->thin[at];
    bool dry = false, more = false;
    for (int axis = 0; axis < shore->mesh->dim; axis++) {
        double before = shore->thin[at - shore->step[axis]], after = shore->thin[at + shore->step[axis]];
        dry = dry || before >= shore->onset || after >= shore->onset;
        more = more || before > own + PHASE_FELT || after > own + PHASE_FELT;
    }
    return dry || (own >= shore->front && !more);
}

static void shore_pair(const struct shore *shore, unsigned char *ret_shore)
{
    const struct mesh *mesh = shore->mesh;
    for (int k = 0; k < mesh->n[2]; k++)
        for (int j = 0; j < mesh->n[1]; j++) {
            size_t from = box_at(&shore->block, 0, j, k);
            for (int i = 0; i < mesh->n[0]; i++) *ret_shore++ = shore_is(shore, from + (size_t)i);
        }
}

void shore_look(const struct model *path, const struct mesh *mesh, const double *around, unsigned char *ret_shore)
{
    struct shore shore = {.mesh = mesh, .block = patch_block(mesh, 1, NULL)};
    shore.step[0] = 1;
    for (int axis = 1; axis < 3; axis++) shore.step[axis] = shore.step[axis - 1] * shore.block.size[axis - 1];
    shore.thin = mem_new(shore.block.pitch, sizeof *shore.thin);
    for (unsigned k = 0; k < path->n_phase; k++) {
        const struct model_phase *phase = &path->phases[k];
        shore.onset = phase->scene->onset;
        shore.front = phase_pair_front(phase->scene);
        memset(shore.thin, 0, shore.block.pitch * sizeof *shore.thin);
        for (unsigned i = 1; i < phase->n; i++) shore_add(&shore, path, path->first + phase->member[i], around);
        shore_pair(&shore, ret_shore + k * mesh->n_cell);
    }
    mem_free(shore.thin);
}
