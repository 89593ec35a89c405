/* derive_viscous.c - see derive_viscous.h. The term itself is asked (scheme/viscous.h), in the cells of the tile, of
 * whose surroundings it needs what lies across faces. */
#include "derive/derive_viscous.h"

#include "base/mem.h"
#include "derive/derive_slope.h"
#include "phys/mix.h"
#include "scheme/face.h"
#include "scheme/patch.h"
#include "scheme/viscous.h"

#include <string.h>

/* One component of a gathered piece, with the layer before it and behind it, into the patch. */
static void derive_viscous_lay(const struct frame *frame, const double *from, const struct box_block *patch, double *to)
{
    for (size_t o = 0; o < frame->outer; o++)
        for (int i = -1; i <= (int)frame->n; i++)
            for (size_t c = 0; c < frame->inner; c++) {
                size_t outer = frame->outer_from + o, inner = frame->inner_from + c, n0 = patch->size[0] - 2;
                size_t n1 = patch->size[1] > 2 ? patch->size[1] - 2 : 1;
                int at[3] = {(int)(inner % n0), (int)(inner / n0), (int)outer};
                if (frame->axis == 0) at[0] = i, at[1] = (int)(outer % n1), at[2] = (int)(outer / n1);
                else at[frame->axis] = i;
                to[box_at(patch, at[0], at[1], at[2])] = from[frame_at(frame, o, i) + c];
            }
}

/* The layer behind a boundary that waves cross. */
static void derive_viscous_copy(const struct derive_view *view, const struct box_block *patch, double *w)
{
    const struct tile *tile = &view->level->tiles[view->level->first + view->local];
    for (int face = 0; face < 2 * view->mesh->dim; face++) {
        int axis = face / 2, side = face % 2, end = side ? view->level->extent[axis] - 1 : 0, shift[3] = {0};
        struct box layer = {.to = {1, 1, 1}};
        if (tile->at[axis] != end || !scene_boundary_is(view->model->scene, face, SCENE_BOUNDARY_REFERS)) continue;
        for (int d = 0; d < view->mesh->dim; d++) layer.to[d] = view->mesh->n[d];
        layer.from[axis] = side ? view->mesh->n[axis] : -1;
        layer.to[axis] = layer.from[axis] + 1;
        shift[axis] = side ? -1 : 1;
        struct box_block block = *patch;
        block.data = w;
        box_copy(view->model->n_around, &layer, &block, shift, &block);
    }
}

/* What term_tile.around is, without edges and corners. */
static double *derive_viscous_around(const struct derive_view *view)
{
    const struct model *model = view->model;
    const struct box_block patch = rim_block(view->mesh, 1, NULL);
    double *w = mem_new(model->n_around * patch.pitch, sizeof *w);
    struct face_work *faces = face_new(model);
    for (int axis = 0; axis < view->mesh->dim; axis++)
        for (size_t index = 0; index < frame_pieces(view->mesh, axis); index++) {
            const struct frame frame = frame_piece(view->mesh, axis, index);
            derive_slope_gather(view, &frame, FACE_ROOM, faces->frame);
            for (unsigned k = 0; k < model->n_around; k++)
                derive_viscous_lay(&frame, faces->frame + model->around[k] * FACE_ROOM, &patch, w + k * patch.pitch);
        }
    derive_viscous_copy(view, &patch, w);
    face_free(faces);
    return w;
}

/* Component (i, j) of the stress, or the heat where i is 3. */
static void derive_viscous_ask(const struct derive_view *view, unsigned i, unsigned j, double *out)
{
    const struct model *model = view->model;
    double *around = derive_viscous_around(view), *rho_c2 = mem_new(model->n_material * view->n, sizeof *rho_c2);
    void *own = viscous_term.open(&(struct term_room){.model = model, .mesh = view->mesh});
    const struct term_tile tile = {.model = model,
                                   .mesh = view->mesh,
                                   .level = view->level,
                                   .tile = &view->level->tiles[view->level->first + view->local],
                                   .n_cell = view->n,
                                   .t = view->t,
                                   .w = view->w,
                                   .around = around,
                                   .rho_c2 = rho_c2};
    if (model->kapila) mix_stiffness_everywhere(model, view->n, view->n, view->w, rho_c2);
    if (i < 3) viscous_stress_field(&tile, own, i, j, out);
    else viscous_dissipation_field(&tile, own, out);
    viscous_term.close(own);
    mem_free(rho_c2);
    mem_free(around);
}

void derive_viscous_stress(const struct derive_view *view, double *out)
{
    static const unsigned row[6] = {0, 1, 2, 1, 2, 2}, column[6] = {0, 1, 2, 0, 0, 1};
    int c = view->field->index;
    derive_viscous_ask(view, row[c], column[c], out);
}

void derive_viscous_dissipation(const struct derive_view *view, double *out)
{
    derive_viscous_ask(view, 3, 3, out);
}
