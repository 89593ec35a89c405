/* around.c - see around.h. */
#include "solve/around.h"

#include "base/mem.h"
#include "levels/prolong_rim.h"
#include "scheme/patch_state.h"

#include <string.h>

struct around {
    const struct model *model;
    const struct mesh *mesh;
    enum patch_rule rules[MESH_FACES];
    unsigned char given; /* by faces, of them */
    unsigned char parity[MODEL_FIELDS];
    double *patch; /* of a tile */
    double *layer; /* of all primitives behind a face */
};

/* The most cells of a layer behind a face. */
static size_t around_face_cells(const struct mesh *mesh)
{
    size_t most = 1;
    for (int d = 0; d < mesh->dim; d++) {
        size_t cells = mesh->n_cell / (size_t)mesh->n[d];
        most = cells > most ? cells : most;
    }
    return most;
}

/* Do velocities go on behind a face as bound_fill_flow says? */
static bool around_flows(const struct model *model, int face)
{
    return model->viscous && bound_has_rays(model, face);
}

static void around_rules(struct around *around)
{
    const struct scene *scene = around->model->scene;
    patch_state_rules(scene, true, around->rules);
    for (int face = 0; face < 2 * scene->domain.dim; face++)
        if (scene_boundary_is(scene, face, SCENE_BOUNDARY_REFERS) && !around_flows(around->model, face))
            around->rules[face] = PATCH_COPY;
    around->given = patch_given(around->rules);
}

struct around *around_new(const struct model *model, const struct mesh *mesh)
{
    if (!model->n_around) return NULL;
    struct around *around = mem_new(1, sizeof *around);
    *around = (struct around){.model = model, .mesh = mesh};
    around_rules(around);
    for (unsigned k = 0; k < model->n_around; k++) {
        unsigned d = model->around[k] - model->i_u; /* wraps below i_u */
        around->parity[k] = (unsigned char)(d < model->n_velocity ? 1u << d | PATCH_VELOCITY : 0u);
    }
    around->patch = mem_new(model->n_around * rim_block(mesh, 1, NULL).pitch, sizeof *around->patch);
    around->layer = mem_new(model->n_field * around_face_cells(mesh), sizeof *around->layer);
    return around;
}

void around_free(struct around *around)
{
    if (!around) return;
    mem_free(around->patch);
    mem_free(around->layer);
    mem_free(around);
}

/* What the source's `given` needs. */
struct around_given {
    struct around *around;
    struct bound *bound;
};

/* All primitives behind the face, and of them what is wanted. */
static void around_give(void *data, unsigned local, int face, const struct box_block *ret)
{
    const struct around_given *given = data;
    struct around *around = given->around;
    struct box_block all = *ret;
    all.data = around->layer;
    if (around_flows(around->model, face)) patch_state_flow(given->bound, local, face, &all);
    else patch_state_given(given->bound, local, face, &all);
    for (unsigned k = 0; k < around->model->n_around; k++)
        memcpy(ret->data + k * ret->pitch, all.data + around->model->around[k] * all.pitch,
               ret->pitch * sizeof *ret->data);
}

static struct rim *around_rim(const struct around *around, int l)
{
    const struct rim_form form = {.n_field = around->model->n_around,
                                  .g = 1,
                                  .slots = 2,
                                  .given = around->given,
                                  .fields = around->model->around};
    return rim_of(around->mesh, l, &form);
}

/* `given` must live as long as the source. */
static struct patch_source around_source(struct around *around, int l, struct bound *bound, struct around_given *given)
{
    const struct mesh *mesh = around->mesh;
    *given = (struct around_given){around, bound};
    struct patch_source source = {.mesh = mesh,
                                  .level = &mesh->levels[l],
                                  .arrays = mesh->levels[l].w,
                                  .parity = around->parity,
                                  .given = around_give,
                                  .data = given};
    memcpy(source.rules, around->rules, sizeof source.rules);
    source.rim = around_rim(around, l);
    return source;
}

void around_start(struct around *around, int l, struct bound *bound)
{
    struct around_given given;
    if (!around) return;
    const struct patch_source source = around_source(around, l, bound, &given);
    patch_start(&source);
}

void around_finish(struct around *around, int l, struct bound *bound)
{
    struct around_given given;
    if (!around) return;
    const struct patch_source source = around_source(around, l, bound, &given);
    patch_finish(&source);
}

void around_finer(struct around *around, int l, struct bound *bound, int slot)
{
    struct around_given given, finer;
    if (!around) return;
    const struct patch_source source = around_source(around, l, bound, &given);
    prolong_rim(&source, around_source(around, l + 1, bound, &finer).rim, slot, NULL);
}

void around_down(const struct around *around, int l)
{
    if (around) rim_down(around_rim(around, l));
}

bool around_is_remote(const struct around *around, int l, unsigned local)
{
    return around && around_rim(around, l)->remote[local];
}

const double *around_gather(struct around *around, int l, struct bound *bound, unsigned local)
{
    struct around_given given;
    if (!around) return NULL;
    const struct patch_source source = around_source(around, l, bound, &given);
    patch_gather(&source, local, around->patch);
    return around->patch;
}

int around_diagonal(const struct around *around, int l, unsigned local, unsigned ret_tiles[static 26])
{
    int n = 0;
    if (!around) return 0;
    const struct rim_piece *pieces = around_rim(around, l)->pieces[local];
    for (int way = 0; way < RIM_WAYS; way++) {
        int steps = 0;
        for (int d = 0; d < 3; d++) steps += rim_step(way, d) != 0;
        if (steps < 2 || pieces[way].kind == RIM_UNUSED || pieces[way].kind == RIM_BEHIND) continue;
        if (pieces[way].kind != RIM_LOCAL) return -1;
        ret_tiles[n++] = pieces[way].index;
    }
    return n;
}
