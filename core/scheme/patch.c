/* patch.c - see patch.h. */
#include "scheme/patch.h"

#include "mesh/link.h"
#include "scheme/blend.h"

unsigned char patch_given(const enum patch_rule rules[MESH_FACES])
{
    unsigned char given = 0;
    for (int face = 0; face < MESH_FACES; face++)
        if (rules[face] == PATCH_GIVEN) given = (unsigned char)(given | 1u << face);
    return given;
}

void patch_start(const struct patch_source *source)
{
    const struct level *level = source->level;
    for (unsigned t = 0; source->rim->form.given && t < level->n_local; t++)
        for (int face = 0; face < 2 * source->mesh->dim; face++) {
            const struct box_block outer = rim_outer(source->rim, t, face);
            if (outer.data) source->given(source->data, t, face, &outer);
        }
    rim_start(source->rim, source->arrays);
}

void patch_finish(const struct patch_source *source)
{
    rim_finish(source->rim);
}

/* A row of cells of field q between the two slots of a piece. */
static void patch_blend(const struct patch_source *source, unsigned q, size_t n, double theta, const double *begin,
                        const double *end, size_t pitch, double *to)
{
    int weight = source->weight ? source->weight[q] : -1;
    const double *first = begin + q * pitch, *last = end + q * pitch;
    if (weight < 0) blend_row(n, theta, first, last, to);
    else blend_density(n, theta, first, last, begin + (size_t)weight * pitch, end + (size_t)weight * pitch, to);
}

/* A piece on the coarser level: linear in time between two slots. */
static void patch_coarse(const struct patch_source *source, const struct rim_coarse *piece, const struct box *box,
                         const struct box_block *patch)
{
    static const int still[3];
    const struct rim_form *form = &source->rim->form;
    double theta = form->slots > 1 ? source->level->link->theta : 0.0;
    struct box_block begin = box_pack(box, piece->data[0]);
    if (!(theta > 0.0)) {
        box_copy(form->n_field, box, &begin, still, patch);
        return;
    }
    size_t length = begin.size[0];
    for (unsigned q = 0; q < form->n_field; q++)
        for (int k = box->from[2]; k < box->to[2]; k++)
            for (int j = box->from[1]; j < box->to[1]; j++) {
                size_t at = box_at(&begin, box->from[0], j, k);
                double *to = patch->data + q * patch->pitch + box_at(patch, box->from[0], j, k);
                patch_blend(source, q, length, theta, piece->data[0] + at, piece->data[1] + at, begin.pitch, to);
            }
}

/* Does the sign of a field change behind a boundary? */
static bool patch_turns(const struct patch_source *source, enum patch_rule rule, int axis, unsigned q)
{
    unsigned parity = source->parity ? source->parity[q] : 0;
    if (rule == PATCH_COPY) return false;
    return parity & (rule == PATCH_NO_SLIP ? (unsigned)PATCH_VELOCITY : 1u << axis);
}

static void patch_turn(const struct box *box, const struct box_block *patch, unsigned q)
{
    for (int k = box->from[2]; k < box->to[2]; k++)
        for (int j = box->from[1]; j < box->to[1]; j++) {
            double *row = patch->data + q * patch->pitch + box_at(patch, box->from[0], j, k);
            for (int i = 0; i < box->to[0] - box->from[0]; i++) row[i] = -row[i];
        }
}

/* Fills a box behind a boundary normal to `axis` from the cells on its other side, layer by layer. */
static void patch_reflect(const struct patch_source *source, enum patch_rule rule, int axis, int side,
                          const struct box *box, const struct box_block *patch)
{
    unsigned n_field = source->rim->form.n_field;
    int n = source->mesh->n[axis], shift[3] = {0};
    for (int layer = 0; layer < source->rim->form.g; layer++) {
        struct box one = *box;
        int inside = rule == PATCH_COPY ? 0 : layer;
        one.from[axis] = side ? n + layer : -1 - layer;
        one.to[axis] = one.from[axis] + 1;
        shift[axis] = (side ? n - 1 - inside : inside) - one.from[axis];
        box_copy(n_field, &one, patch, shift, patch);
    }
    for (unsigned q = 0; q < n_field; q++)
        if (patch_turns(source, rule, axis, q)) patch_turn(box, patch, q);
}

/* Axes along which a piece leaves the domain. */
struct patch_exits {
    int n, axes[3];
};

static struct patch_exits patch_exits(const struct rim_piece *piece, int way)
{
    struct patch_exits exits = {0};
    for (int d = 0; d < 3; d++)
        if (rim_step(way, d) != piece->step[d]) exits.axes[exits.n++] = d;
    return exits;
}

/* Behind two or three boundaries that are all given: the mean of the nearest cells behind one less. */
static void patch_corner(const struct patch_source *source, const struct patch_exits *exits, const struct box *box,
                         const struct box_block *patch)
{
    for (unsigned q = 0; q < source->rim->form.n_field; q++)
        for (int k = box->from[2]; k < box->to[2]; k++)
            for (int j = box->from[1]; j < box->to[1]; j++)
                for (int i = box->from[0]; i < box->to[0]; i++) {
                    double *w = patch->data + q * patch->pitch, sum = 0.0;
                    for (int e = 0; e < exits->n; e++) {
                        int at[3] = {i, j, k}, axis = exits->axes[e];
                        at[axis] = at[axis] < 0 ? 0 : source->mesh->n[axis] - 1;
                        sum += w[box_at(patch, at[0], at[1], at[2])];
                    }
                    w[box_at(patch, i, j, k)] = sum / exits->n;
                }
}

/* A piece behind boundaries, those behind less of them being there. */
static void patch_behind(const struct patch_source *source, const struct patch_exits *exits, int way,
                         const struct box_block *patch)
{
    const struct box box = rim_box(source->mesh, source->rim->form.g, way);
    for (int e = 0; e < exits->n; e++) {
        int axis = exits->axes[e], side = rim_step(way, axis) > 0;
        enum patch_rule rule = source->rules[2 * axis + side];
        if (rule == PATCH_GIVEN) continue;
        patch_reflect(source, rule, axis, side, &box, patch);
        return;
    }
    patch_corner(source, exits, &box, patch);
}

/* From a local tile itself: most pieces, of most tiles. */
static void patch_take(const struct patch_source *source, unsigned from, int way, const struct box_block *patch)
{
    const struct rim *rim = source->rim;
    box_move_all(rim->form.n_field, &rim->moves[way], source->arrays[from], source->mesh->n_cell, rim->form.fields,
                 patch->data, patch->pitch);
}

static void patch_piece(const struct patch_source *source, unsigned local, int way, const struct box_block *patch)
{
    struct rim *rim = source->rim;
    const struct rim_piece *piece = &rim->pieces[local][way];
    if (piece->kind == RIM_LOCAL && piece->outer < 0) {
        patch_take(source, piece->index, way, patch);
        return;
    }
    const struct box box = rim_box(source->mesh, rim->form.g, way);
    if (piece->kind == RIM_COARSE) {
        patch_coarse(source, &rim->coarse[piece->index], &box, patch);
        return;
    }
    int shift[3];
    const struct box_block from = rim_find(rim, source->arrays, local, way, shift);
    box_copy(rim->form.n_field, &box, &from, shift, patch);
}

void patch_gather(const struct patch_source *source, unsigned local, double *w)
{
    const struct mesh *mesh = source->mesh;
    const struct box_block patch = rim_block(mesh, source->rim->form.g, w);
    const struct rim_piece *pieces = source->rim->pieces[local];
    int most = 0;
    patch_take(source, local, RIM_HERE, &patch);
    for (int way = 0; way < RIM_WAYS; way++) {
        if (pieces[way].kind == RIM_BEHIND) most = mesh->dim;
        else if (pieces[way].kind != RIM_UNUSED) patch_piece(source, local, way, &patch);
    }
    for (int n = 1; n <= most; n++)
        for (int way = 0; way < RIM_WAYS; way++) {
            const struct patch_exits exits = patch_exits(&pieces[way], way);
            if (pieces[way].kind == RIM_BEHIND && exits.n == n) patch_behind(source, &exits, way, &patch);
        }
}
