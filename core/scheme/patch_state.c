/* patch_state.c - see patch_state.h. */
#include "scheme/patch_state.h"

#include "base/mem.h"
#include "phys/elastic.h"

#include <string.h>

/* What corners go by, for each way in which layers behind a boundary are filled. */
#define PATCH_STATE_slip PATCH_MIRROR
#define PATCH_STATE_no_slip PATCH_NO_SLIP
#define PATCH_STATE_copy PATCH_COPY
#define PATCH_STATE_far PATCH_GIVEN
#define PATCH_STATE_state PATCH_GIVEN
#define PATCH_STATE_wave PATCH_GIVEN
#define PATCH_STATE_RULE(type, word, doc, keys, fill, traits) [SCENE_##type] = PATCH_STATE_##fill,

void patch_state_rules(const struct scene *scene, bool given, enum patch_rule ret_rules[MESH_FACES])
{
    static const enum patch_rule rules[] = {SCENE_BOUNDARY_TABLE(PATCH_STATE_RULE)[SCENE_BOUNDARY_MODULE] =
                                                PATCH_GIVEN};
    for (int face = 0; face < MESH_FACES; face++) {
        const struct scene_boundary *boundary = &scene->domain.boundary[face / 2][face % 2];
        enum patch_rule rule = boundary->moves && given ? PATCH_GIVEN : rules[boundary->type];
        if (rule == PATCH_MIRROR && face < 2 && scene_domain_swirls(&scene->domain))
            rule = PATCH_GIVEN; /* bound_layer_lever() */
        bool known = given && face < 2 * scene->domain.dim;
        ret_rules[face] = rule == PATCH_GIVEN && !known ? PATCH_COPY : rule;
    }
}

/* bound_fill or bound_fill_flow */
typedef void patch_state_fill(void *data, unsigned local, const struct frame *frame, int side, size_t pitch, double *w);

/* One piece of a tile as a frame with nothing beside it but what `fill` writes; its outer layers into the block. */
static void patch_state_piece(struct bound *bound, patch_state_fill *fill, unsigned local, int face,
                              const struct frame *frame, const struct box_block *ret)
{
    const double *own = bound->level->w[local];
    size_t n_cell = bound->mesh->n_cell, g = ret->size[face / 2], pitch = frame->count;
    size_t line = frame->inner * sizeof *own, run = frame->inner == frame->tile_inner ? frame->n : 1;
    double *w = mem_new(bound->model->n_field * pitch, sizeof *w);
    for (unsigned q = 0; q < bound->model->n_field; q++)
        for (size_t o = 0; o < frame->outer; o++)
            for (size_t i = 0; i < frame->n; i += run)
                memcpy(w + q * pitch + frame_at(frame, o, (int)i), own + q * n_cell + frame_tile_at(frame, o, i),
                       run * line);
    fill(bound, local, frame, face % 2, pitch, w);
    for (unsigned q = 0; q < bound->model->n_field; q++)
        for (size_t o = 0; o < frame->outer; o++)
            for (size_t i = 0; i < g; i++) {
                size_t to = ((frame->outer_from + o) * g + i) * frame->tile_inner + frame->inner_from;
                int from = face % 2 ? (int)(frame->n + i) : (int)i - (int)g;
                memcpy(ret->data + q * ret->pitch + to, w + q * pitch + frame_at(frame, o, from), line);
            }
    mem_free(w);
}

static void patch_state_pieces(struct bound *bound, patch_state_fill *fill, unsigned local, int face,
                               const struct box_block *ret)
{
    for (size_t piece = 0; piece < frame_pieces(bound->mesh, face / 2); piece++) {
        struct frame frame = frame_piece(bound->mesh, face / 2, piece);
        patch_state_piece(bound, fill, local, face, &frame, ret);
    }
}

void patch_state_given(void *data, unsigned local, int face, const struct box_block *ret)
{
    patch_state_pieces(data, bound_fill, local, face, ret);
}

void patch_state_flow(void *data, unsigned local, int face, const struct box_block *ret)
{
    patch_state_pieces(data, bound_fill_flow, local, face, ret);
}

static void patch_state_describe(const struct model *model, struct patch_state *ret)
{
    for (unsigned q = 0; q < model->n_field; q++) {
        bool density = q >= model->i_m && q < model->i_m + model->n_alpha;
        ret->parity[q] = 0;
        ret->weight[q] = density ? (int)(q - model->i_m + model->i_alpha) : -1;
    }
    for (unsigned d = 0; d < model->n_velocity; d++)
        ret->parity[model->i_u + d] = (unsigned char)(1u << d | PATCH_VELOCITY);
    for (unsigned i = 0; i < 3; i++)
        for (unsigned j = 0; j < i; j++) {
            unsigned component = elastic_component(i, j);
            if (component >= model->n_stretch) continue;
            for (unsigned k = 0; k < model_stretches(model); k++)
                ret->parity[model_stretch(model, k) + component] = (unsigned char)(1u << i | 1u << j);
        }
}

struct patch_source patch_state_source(const struct model *model, const struct mesh *mesh, int l, int g, int slots,
                                       struct bound *bound, struct patch_state *keep)
{
    struct patch_source source = {.mesh = mesh,
                                  .level = &mesh->levels[l],
                                  .arrays = mesh->levels[l].w,
                                  .parity = keep->parity,
                                  .weight = keep->weight,
                                  .given = patch_state_given,
                                  .data = bound};
    patch_state_describe(model, keep);
    patch_state_rules(model->scene, true, source.rules);
    const struct rim_form form = {model->n_field, g, slots, patch_given(source.rules), NULL};
    source.rim = rim_of(mesh, l, &form);
    return source;
}

/* Inflows bring their own fractions. */
static void patch_state_inflow(void *data, unsigned local, int face, const struct box_block *ret)
{
    const struct model *model = data;
    const struct scene_boundary *boundary = &model->scene->domain.boundary[face / 2][face % 2];
    (void)local;
    for (unsigned l = 0; l < model->n_alpha; l++)
        for (size_t c = 0; c < ret->pitch; c++) ret->data[l * ret->pitch + c] = boundary->fractions[l];
}

struct patch_source patch_state_fractions(const struct model *model, const struct mesh *mesh, int l, int g, int slots)
{
    struct patch_source source = {.mesh = mesh,
                                  .level = &mesh->levels[l],
                                  .arrays = mesh->levels[l].w,
                                  .given = patch_state_inflow,
                                  .data = (void *)model};
    patch_state_rules(model->scene, false, source.rules);
    for (int face = 0; face < 2 * mesh->dim; face++)
        if (model->scene->domain.boundary[face / 2][face % 2].type == SCENE_INFLOW) source.rules[face] = PATCH_GIVEN;
    const struct rim_form form = {model->n_alpha, g, slots, patch_given(source.rules), NULL};
    source.rim = rim_of(mesh, l, &form);
    return source;
}
