/* blame.c - see blame.h. Recording and replaying go through the same functions: a replay records its own blame, and
 * the two are compared. */
#include "solve/blame.h"

#include "base/comm.h"
#include "base/mem.h"
#include "solve/stage.h"
#include "solve/state.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

const char *blame_name(enum blame_block block)
{
    static const char *const names[] = {"u_old",  "w",       "u",       "w_new",   "K",
                                        "rho_c2", "u_stage", "frame_x", "frame_y", "frame_z",
                                        "mark_x", "mark_y",  "mark_z",  "around",  "faces"};
    return names[block];
}

static const struct model *blame_used(const struct model *model, const struct blame_facts *facts)
{
    return model_numbered(model, facts->pure);
}

/* The stage that was under way; of failures between steps any. */
static const struct tableau_stage *blame_row(const struct blame_facts *facts)
{
    static const struct tableau_stage none;
    const struct tableau *tableau = tableau_numbered(facts->integrator);
    return blame_moves(facts) && facts->stage < tableau->n ? &tableau->stage[facts->stage] : &none;
}

/* Cells of the whole frame of the tile along an axis. */
static size_t blame_frame_cells(const struct model *model, const struct blame_facts *facts, int axis)
{
    size_t n = (size_t)facts->n[axis];
    return facts->n_cell / n * (n + 2 * (size_t)model->scene->scheme.ghosts);
}

/* Cells of the tile and one layer around it. */
static size_t blame_around_cells(const struct model *model, const struct blame_facts *facts)
{
    size_t cells = 1;
    for (int d = 0; d < model->dim; d++) cells *= (size_t)facts->n[d] + 2;
    return cells;
}

/* Blocks that hold frames, marks, faces; they exist where a stage was gone through. */
static struct blame_shape blame_shape_swept(const struct model *model, const struct blame_facts *facts,
                                            enum blame_block block, const char *name)
{
    static char columns[BLAME_COLUMNS][BLAME_NAME];
    unsigned dim = (unsigned)model->dim;
    int frame = (int)block - BLAME_FRAME_X, mask = (int)block - BLAME_MASK_X;
    if (!blame_moves(facts)) return (struct blame_shape){name, 0, 0};
    if (block == BLAME_AROUND)
        return (struct blame_shape){name, model_looks_around(blame_used(model, facts)) ? model->n_around : 0,
                                    blame_around_cells(model, facts)};
    if (block == BLAME_FACES) return (struct blame_shape){name, 2 * dim, blame_columns(model, facts, columns)};
    if (mask < 0)
        return (struct blame_shape){name, frame < model->dim ? model->n_field : 0,
                                    frame < model->dim ? blame_frame_cells(model, facts, frame) : 0};
    return (struct blame_shape){name, facts->masked && mask < model->dim ? 1 : 0,
                                mask < model->dim ? blame_frame_cells(model, facts, mask) : 0};
}

struct blame_shape blame_shape(const struct model *model, const struct blame_facts *facts, enum blame_block block)
{
    const char *name = blame_name(block);
    const struct model *used = blame_used(model, facts);
    bool closure = used->kapila && blame_moves(facts);
    if (block >= BLAME_FRAME_X) return blame_shape_swept(model, facts, block, name);
    bool material = block == BLAME_K || block == BLAME_STIFFNESS;
    if (block == BLAME_BASE && !blame_row(facts)->previous) return (struct blame_shape){name, 0, 0};
    unsigned rows = !material ? model->n_field : closure ? used->n_material : 0;
    return (struct blame_shape){name, rows, facts->n_cell};
}

/* A column of BLAME_FACES; `row`: where its values are for the faces of a piece. */
struct blame_column {
    char name[BLAME_NAME];
    const double *row;
};

struct blame_list {
    unsigned n;
    struct blame_column at[BLAME_COLUMNS];
};

static void blame_add(struct blame_list *list, const double *row, const char *group, const char *name,
                      const char *material)
{
    struct blame_column *column = &list->at[list->n++];
    snprintf(column->name, sizeof column->name, "%s.%s%s%s", group, name, *material ? "_" : "", material);
    column->row = row;
}

static const char *blame_material(const struct model *used, unsigned l)
{
    return used->scene->material[used->first + l].name;
}

static const char *const blame_axes[] = {"x", "y", "z"}, *const blame_tangents[] = {"1", "2"};

/* Component of vectors at the faces of an axis that points along axis `e` of space. */
static unsigned blame_component(int axis, unsigned e)
{
    unsigned d = 0;
    while (axis_component(axis, d) != e) d++;
    return d;
}

/* Row i of a list, where there are values. */
static const double *blame_at(const double *const *rows, unsigned i)
{
    return rows ? rows[i] : NULL;
}

static void blame_list_side(struct blame_list *list, const struct model *used, int axis, const char *group,
                            const struct bulla_side *side)
{
    blame_add(list, side->rho, group, "density", "");
    blame_add(list, side->p, group, "pressure", "");
    blame_add(list, side->rho_E, group, "energy", "");
    blame_add(list, side->c, group, "sound_speed", "");
    for (unsigned e = 0; e < used->n_velocity; e++)
        blame_add(list, blame_at(side->u, blame_component(axis, e)), group, "velocity", blame_axes[e]);
    for (unsigned l = 0; l < used->n_material; l++)
        blame_add(list, blame_at(side->m, l), group, "partial_density", blame_material(used, l));
    for (unsigned l = 0; l < used->n_alpha; l++)
        blame_add(list, blame_at(side->alpha, l), group, "alpha", blame_material(used, l));
}

/* What a solid adds to a side. */
static void blame_list_shear(struct blame_list *list, const struct model *used, const char *group,
                             const struct bulla_shear *shear)
{
    if (!used->n_stretch) return;
    blame_add(list, shear->c_s, group, "shear_speed", "");
    for (unsigned d = 1; d < used->n_velocity; d++)
        blame_add(list, blame_at(shear->s, d - 1), group, "traction", blame_tangents[d - 1]);
}

/* What the terms have of fluxes: one column, or two where the cells beside a face see different values. */
static void blame_list_fluxes(struct blame_list *list, const struct terms *terms, int axis)
{
    for (unsigned i = 0; i < terms->n_flux[axis]; i++) {
        const struct term_flux *flux = &terms->flux[axis][i];
        if (!*flux->name) continue;
        if (!flux->sides) blame_add(list, flux->below, "flux", flux->name, "");
        if (flux->sides) blame_add(list, flux->above, "left", flux->name, "");
        if (flux->sides) blame_add(list, flux->below, "right", flux->name, "");
    }
}

/* All columns; terms without work space have names alone. */
static void blame_list_all(struct blame_list *list, const struct terms *terms, int axis)
{
    static const struct face_work none;
    const struct face_work *faces = terms->faces ? terms->faces : &none;
    const struct model *used = terms->model;
    list->n = 0;
    blame_list_side(list, used, axis, "left", &faces->faces.left);
    blame_list_side(list, used, axis, "right", &faces->faces.right);
    blame_list_shear(list, used, "left", &faces->faces.shear_left);
    blame_list_shear(list, used, "right", &faces->faces.shear_right);
    blame_list_fluxes(list, terms, axis);
}

unsigned blame_columns(const struct model *model, const struct blame_facts *facts, char (*ret_names)[BLAME_NAME])
{
    struct blame_list list;
    struct terms *terms = terms_new(blame_used(model, facts), NULL);
    blame_list_all(&list, terms, 0);
    terms_free(terms);
    for (unsigned i = 0; i < list.n; i++) memcpy(ret_names[i], list.at[i].name, BLAME_NAME);
    return list.n;
}

static void blame_allocate(const struct model *model, struct blame *blame)
{
    for (int i = 0; i < BLAME_BLOCKS; i++) {
        struct blame_shape shape = blame_shape(model, &blame->facts, (enum blame_block)i);
        if (shape.rows) blame->block[i] = mem_new(shape.rows * shape.columns, sizeof(double));
    }
}

struct blame *blame_new(const struct model *model, const struct guard *guard)
{
    const struct mesh *mesh = guard->mesh;
    const struct guard_place *found = &guard->found;
    const struct tile *tile = &guard->level->tiles[guard->level->first + found->local];
    struct blame *blame = mem_new(1, sizeof *blame);
    struct blame_facts *facts = &blame->facts;
    blame->local = found->local;
    facts->rank = comm_rank();
    facts->level = guard->l;
    facts->integrator = (int)model->scene->scheme.integrator;
    facts->stage = found->stage;
    facts->covered = tile->covered;
    facts->n_cell = (unsigned)mesh->n_cell;
    facts->cell = (unsigned)found->cell;
    facts->pure = found->pure;
    facts->masked = guard->masked;
    facts->repair = guard->repair;
    facts->value = found->value;
    snprintf(facts->field, sizeof facts->field, "%s", found->field);
    snprintf(facts->verdict, sizeof facts->verdict, "%s", found->words);
    for (int d = 0; d < 3; d++) {
        facts->n[d] = mesh->n[d];
        facts->h[d] = guard->level->h[d];
        facts->tile[d] = tile->at[d];
        facts->extent[d] = guard->level->extent[d];
    }
    blame_allocate(model, blame);
    return blame;
}

struct blame *blame_like(const struct model *model, const struct blame_facts *facts)
{
    struct blame *blame = mem_new(1, sizeof *blame);
    blame->facts = *facts;
    blame_allocate(model, blame);
    return blame;
}

void blame_free(struct blame *blame)
{
    if (!blame) return;
    for (int i = 0; i < BLAME_BLOCKS; i++) mem_free(blame->block[i]);
    mem_free(blame);
}

/* Copies a piece between the whole frame of the tile and the work space; to the whole one if `record`. */
static void blame_copy(const struct frame *frame, double *whole, double *piece, bool record)
{
    size_t layers = frame_layers(frame);
    for (size_t o = 0; o < frame->outer; o++)
        for (size_t i = 0; i < layers; i++) {
            double *there = whole + ((frame->outer_from + o) * layers + i) * frame->tile_inner + frame->inner_from;
            double *here = piece + frame_at(frame, o, (int)i - (int)frame->ghosts);
            memcpy(record ? there : here, record ? here : there, frame->inner * sizeof *here);
        }
}

/* All components of a piece, and the marks. */
static void blame_copy_piece(const struct blame *blame, const struct model *used, const struct frame *frame,
                             const struct face_work *faces, bool record)
{
    size_t cells = blame_frame_cells(used, &blame->facts, frame->axis);
    double *frames = blame->block[BLAME_FRAME_X + frame->axis], *marks = blame->block[BLAME_MASK_X + frame->axis];
    for (unsigned i = 0; i < used->n_active; i++) {
        unsigned q = used->active[i];
        blame_copy(frame, frames + q * cells, faces->frame + q * FACE_ROOM, record);
    }
    if (marks) blame_copy(frame, marks, faces->mask, record);
}

/* The two faces of the cell, if they are in this piece. */
void blame_faces(struct blame *blame, const struct terms *terms, const struct frame *frame)
{
    size_t cell = blame->facts.cell, per_outer = frame->n * frame->tile_inner;
    size_t outer = cell / per_outer, i = cell % per_outer / frame->tile_inner, inner = cell % frame->tile_inner;
    if (outer < frame->outer_from || outer >= frame->outer_from + frame->outer) return;
    if (inner < frame->inner_from || inner >= frame->inner_from + frame->inner) return;
    size_t lower = face_at(frame, outer - frame->outer_from, i) + (inner - frame->inner_from);
    struct blame_list list;
    blame_list_all(&list, terms, frame->axis);
    for (unsigned side = 0; side < 2; side++)
        for (unsigned c = 0; c < list.n; c++)
            blame->block[BLAME_FACES][(2 * (unsigned)frame->axis + side) * list.n + c] =
                list.at[c].row[lower + side * frame->inner];
}

void blame_frame(struct blame *blame, const struct model *used, const struct frame *frame,
                 const struct face_work *faces)
{
    blame_copy_piece(blame, used, frame, faces, true);
}

void blame_give(const struct blame *blame, const struct model *used, const struct frame *frame, struct face_work *faces)
{
    blame_copy_piece(blame, used, frame, faces, false);
}

static void blame_take(struct blame *blame, enum blame_block block, size_t rows, const double *values)
{
    if (blame->block[block]) memcpy(blame->block[block], values, rows * blame->facts.n_cell * sizeof *values);
}

void blame_rates(struct blame *blame, const struct model *model, const struct term_tile *tile, const double *u_old)
{
    const struct model *used = blame_used(model, &blame->facts); /* a path for fewer materials has fewer rows */
    blame_take(blame, BLAME_U_OLD, model->n_field, u_old);
    blame_take(blame, BLAME_BASE, model->n_field, tile->u);
    blame_take(blame, BLAME_W, model->n_field, tile->w);
    blame_take(blame, BLAME_K, used->n_material, tile->K);
    blame_take(blame, BLAME_STIFFNESS, used->n_material, tile->rho_c2);
    if (blame->block[BLAME_AROUND])
        memcpy(blame->block[BLAME_AROUND], tile->around,
               model->n_around * blame_around_cells(model, &blame->facts) * sizeof *tile->around);
}

/* What a pure model leaves alone stays out: zero. */
void blame_result(struct blame *blame, const struct model *used, const double *u, const double *w)
{
    size_t n = blame->facts.n_cell;
    for (unsigned i = 0; i < used->n_active; i++) {
        size_t at = used->active[i] * n;
        memcpy(blame->block[BLAME_U] + at, u + at, n * sizeof *u);
        memcpy(blame->block[BLAME_W_NEW] + at, w + at, n * sizeof *w);
    }
    blame->whole = true;
}

void blame_keep(struct blame *blame, const struct model *model, const double *w, const double *kept)
{
    size_t block = model->n_field * blame->facts.n_cell;
    blame_take(blame, BLAME_W, model->n_field, w);
    blame_take(blame, BLAME_U, model->n_field, kept);
    blame_take(blame, BLAME_W_NEW, model->n_field, kept + block);
    blame->whole = true;
}

void blame_say_face(const struct blame *blame, const struct model *model, size_t room, char *ret_text)
{
    static char columns[BLAME_COLUMNS][BLAME_NAME];
    struct blame_shape shape = blame_shape(model, &blame->facts, BLAME_FACES);
    const double *values = blame->block[BLAME_FACES];
    *ret_text = '\0';
    if (!values) return;
    blame_columns(model, &blame->facts, columns);
    for (size_t i = 0; i < shape.rows * shape.columns && !*ret_text; i++) {
        size_t face = i / shape.columns;
        if (isfinite(values[i])) continue;
        snprintf(ret_text, room, ", at its face %c%c: %s = %g", "xyz"[face / 2], "-+"[face % 2],
                 columns[i % shape.columns], values[i]);
    }
}

bool blame_find(const struct state *state, struct blame_facts *ret_facts, const struct blame **ret_blame)
{
    enum { LENGTH = (sizeof(struct blame_facts) + sizeof(double) - 1) / sizeof(double) };
    double own[LENGTH] = {0}, *all = mem_new((size_t)comm_size() * LENGTH, sizeof *all);
    bool found = false;
    *ret_blame = NULL;
    for (int l = 0; l < MESH_LEVELS; l++)
        if (state->stages[l] && state->stages[l]->blame) *ret_blame = state->stages[l]->blame;
    if (*ret_blame) memcpy(own, &(*ret_blame)->facts, sizeof(struct blame_facts));
    comm_join(own, LENGTH, all);
    for (int rank = comm_size() - 1; rank >= 0; rank--) {
        struct blame_facts facts;
        memcpy(&facts, all + rank * LENGTH, sizeof facts);
        if (facts.step == 0) continue;
        *ret_facts = facts;
        found = true;
    }
    if (found && ret_facts->rank != comm_rank()) *ret_blame = NULL;
    mem_free(all);
    return found;
}
