/* patch_state.h - primitives as patches: which components a mirror turns, and what the scene's boundaries give. */
#ifndef PATCH_STATE_H
#define PATCH_STATE_H

#include "phys/model.h"
#include "scheme/bound.h"
#include "scheme/patch.h"

/* What a patch_source of primitives points at. */
struct patch_state {
    unsigned char parity[MODEL_FIELDS];
    int weight[MODEL_FIELDS];
};

/* The rules of a scene's boundaries. `given`: inflows and characteristic boundaries are PATCH_GIVEN; else both are
 * PATCH_COPY, for fields of which they say nothing. */
void patch_state_rules(const struct scene *scene, bool given, enum patch_rule ret_rules[MESH_FACES]);

/* The `given` of a patch_source of all primitives; data: struct bound. */
void patch_state_given(void *data, unsigned local, int face, const struct box_block *ret);

/* The same for what a path looks at around a tile (model->around), where bound_fill_flow says what lies behind. */
void patch_state_flow(void *data, unsigned local, int face, const struct box_block *ret);

/* A source of the primitives w of a level, with g layers; slots as in rim_form. `bound`: of that level, its time set
 * (bound_fill says what is given); it and `keep` must live as long as the source. */
struct patch_source patch_state_source(const struct model *model, const struct mesh *mesh, int l, int g, int slots,
                                       struct bound *bound, struct patch_state *keep);

/* A source of the volume fractions, from the primitives w of a level; characteristic boundaries are copies. `model`
 * must live as long as the source. */
struct patch_source patch_state_fractions(const struct model *model, const struct mesh *mesh, int l, int g, int slots);

#endif
