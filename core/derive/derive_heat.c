/* derive_heat.c - see derive_heat.h. The term itself is asked (scheme/conduction.h): there is one place that knows of
 * channels and walls. */
#include "derive/derive_heat.h"

#include "derive/derive_slope.h"
#include "scheme/conduction.h"
#include "scheme/face.h"

#include <float.h>
#include <string.h>

/* Fluxes of energy through the faces of one piece, as rates of change see them. */
static void derive_heat_piece(const struct term_piece *piece, double *out)
{
    const struct frame *frame = piece->frame;
    const double *q = piece->faces->energy;
    conduction_term.frame(piece);
    conduction_term.faces(piece);
    for (size_t o = 0; o < frame->outer; o++)
        for (size_t i = 0; i < frame->n; i++)
            for (size_t j = 0; j < frame->inner; j++) {
                size_t face = face_at(frame, o, i) + j;
                out[frame_tile_at(frame, o, i) + j] = 0.5 * (q[face] + q[face + frame->inner]);
            }
}

static void derive_heat_axis(const struct derive_view *view, const struct term_tile *tile, void *own, int axis,
                             struct face_work *faces, double *out)
{
    for (size_t index = 0; index < frame_pieces(view->mesh, axis); index++) {
        const struct frame frame = frame_piece(view->mesh, axis, index);
        const struct term_piece piece = {
            .model = view->model, .tile = tile, .frame = &frame, .faces = faces, .own = own};
        derive_slope_gather(view, &frame, FACE_ROOM, faces->frame);
        faces->faces.n = frame_edged(&frame) - frame.inner;
        memset(faces->energy, 0, faces->faces.n * sizeof *faces->energy);
        derive_heat_piece(&piece, out);
    }
}

void derive_heat_flux(const struct derive_view *view, double *out)
{
    const struct model *model = view->model;
    memset(out, 0, 3 * view->n * sizeof *out);
    if (!model->conducts) return;
    struct face_work *faces = face_new(model);
    void *own = conduction_term.open(&(struct term_room){.model = model, .mesh = view->mesh});
    const struct term_tile tile = {.model = model,
                                   .mesh = view->mesh,
                                   .level = view->level,
                                   .tile = &view->level->tiles[view->level->first + view->local],
                                   .n_cell = view->n,
                                   .t = view->t,
                                   .dt = DBL_MIN}; /* so short that nothing is bounded */
    for (int axis = 0; axis < view->mesh->dim; axis++)
        derive_heat_axis(view, &tile, own, axis, faces, out + (size_t)axis * view->n);
    conduction_term.close(own);
    face_free(faces);
}
