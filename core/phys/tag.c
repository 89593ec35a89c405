/* tag.c - see tag.h.
 *
 * A difference is judged once per pair of cells and marks both: |a - b| is the same number from either side, so the
 * marks of a mirrored or turned state are the mirrored or turned marks to the bit. Pairs inside of a tile are
 * compared along the whole tile at once, whatever the axis; pairs that would wrap around a row are taken out again.
 * Most tiles are never looked at a second time: the least and the largest value of a tile and its neighbour bound all
 * of their differences, exactly, since rounding is monotone. */
#include "phys/tag.h"

#include "base/comm.h"
#include "base/mem.h"
#include "base/status.h"
#include "base/text.h"
#include "phys/derive.h"

#include <math.h>
#include <string.h>

/* From this volume fraction on a material counts for its surface: less gas than this at 1 atm changes the stiffness of
 * water by less than 2 %, more of it soon by a factor. */
#define TAG_PRESENT 1e-6

struct tag {
    const struct model *model;
    const struct mesh *mesh;
    const struct level *level;
    int l;
    double t;
    struct halo *halo;
    const struct scene_refine *refine; /* the criterion at hand */
    double **marks;
    double *step; /* [n_cell] work space */
    long long hits;
};

/* Least and largest value of a tile. */
struct tag_bounds {
    double least, most;
};

/* What a difference must exceed. */
struct tag_rule {
    double above[3]; /* per axis */
    bool relative;   /* then in units of the larger magnitude of the pair */
};

/* Centre of a cell, such that cells mirrored at x = 0 have the same bits but the sign. */
static void tag_centre(const struct tag *tag, unsigned local, size_t cell, double ret_x[3])
{
    const struct mesh *mesh = tag->mesh;
    const struct tile *tile = &tag->level->tiles[tag->level->first + local];
    for (int d = 0; d < 3; d++) {
        size_t n = (size_t)mesh->n[d];
        double all = (double)tag->level->extent[d] * mesh->n[d];
        double at = (double)tile->at[d] * mesh->n[d] + (double)(cell % n) + 0.5;
        ret_x[d] = d < mesh->dim ? (mesh->lower[d] * (all - at) + mesh->upper[d] * at) / all : 0.0;
        cell /= n;
    }
}

enum tag_place { TAG_OUTSIDE, TAG_CUT, TAG_INSIDE };

/* Where a tile lies to the criterion's region: by the distance of its middle. */
static enum tag_place tag_place(const struct tag *tag, unsigned local)
{
    const struct mesh *mesh = tag->mesh;
    const struct shape *where = tag->refine->where;
    if (!where) return TAG_INSIDE;
    double middle[3] = {0}, radius2 = 0.0;
    mesh_corner(mesh, tag->level, &tag->level->tiles[tag->level->first + local], middle);
    for (int d = 0; d < 3; d++) {
        double half = d < mesh->dim ? 0.5 * mesh->n[d] * tag->level->h[d] : 0.0;
        middle[d] = d < mesh->dim ? middle[d] + half : 0.0;
        radius2 += half * half;
    }
    double level = shape_level(where, middle), radius = 1.001 * sqrt(radius2);
    return level > radius ? TAG_OUTSIDE : level < -radius ? TAG_INSIDE : TAG_CUT;
}

/* Takes over what was found in a tile, as far as it lies in the region, and forgets it. */
static void tag_keep(struct tag *tag, unsigned local, double *found)
{
    enum tag_place place = tag_place(tag, local);
    double *mark = tag->marks[local], x[3];
    size_t n = tag->mesh->n_cell;
    if (place == TAG_CUT)
        for (size_t i = 0; i < n; i++) {
            if (found[i] <= 0.0) continue;
            tag_centre(tag, local, i, x);
            if (!shape_contains(tag->refine->where, x)) found[i] = 0.0;
        }
    double hits = 0.0;
    for (size_t i = 0; i < n && place != TAG_OUTSIDE; i++) {
        double one = found[i] > 0.0 ? 1.0 : 0.0;
        mark[i] = mark[i] > one ? mark[i] : one;
        hits += one;
    }
    tag->hits += (long long)hits;
    memset(found, 0, n * sizeof *found);
}

/* Does a pair exceed the rule? */
static inline double tag_exceeds(double a, double b, double above, bool relative)
{
    double size_a = fabs(a), size_b = fabs(b), larger = size_a > size_b ? size_a : size_b;
    return fabs(a - b) > (relative ? above * larger : above) ? 1.0 : 0.0;
}

/* Pairs of cells along an axis inside of a tile. */
static void tag_inside(const struct tag *tag, int axis, const struct tag_rule *rule, const double *restrict values,
                       double *restrict found)
{
    size_t n = (size_t)tag->mesh->n[axis], inner = 1;
    for (int d = 0; d < axis; d++) inner *= (size_t)tag->mesh->n[d];
    size_t count = tag->mesh->n_cell - inner;
    double above = rule->above[axis], *restrict step = tag->step;
    if (rule->relative)
        for (size_t i = 0; i < count; i++) step[i] = tag_exceeds(values[i], values[i + inner], above, true);
    else
        for (size_t i = 0; i < count; i++) step[i] = tag_exceeds(values[i], values[i + inner], above, false);
    for (size_t last = (n - 1) * inner; last < count; last += n * inner)
        for (size_t j = 0; j < inner; j++) step[last + j] = 0.0;
    for (size_t i = 0; i < count; i++) found[i] += step[i];
    for (size_t i = 0; i < count; i++) found[i + inner] += step[i];
}

/* Pairs across a face: the cells of this tile are judged, those behind belong to whoever owns them. */
static void tag_across(const struct tag *tag, unsigned local, int face, const struct tag_rule *rule,
                       double *const *values, double *found)
{
    const struct neighbour *neighbour = &tag->level->neighbours[local][face];
    bool remote = neighbour->kind == NEIGHBOUR_REMOTE;
    int axis = face / 2, side = face % 2;
    size_t n = (size_t)tag->mesh->n[axis], inner = 1;
    for (int d = 0; d < axis; d++) inner *= (size_t)tag->mesh->n[d];
    size_t outer = tag->mesh->n_cell / n / inner, depth = remote ? MESH_GHOST : n;
    const double *own = values[local] + (side ? n - 1 : 0) * inner;
    const double *other = remote ? halo_slab(tag->halo, neighbour->index) : values[neighbour->index];
    other += (side ? 0 : depth - 1) * inner;
    double *to = found + (own - values[local]);
    for (size_t o = 0; o < outer; o++)
        for (size_t j = 0; j < inner; j++)
            to[o * n * inner + j] +=
                tag_exceeds(own[o * n * inner + j], other[o * depth * inner + j], rule->above[axis], rule->relative);
}

/* In lanes of their own, so that the compiler may take several values at a time. */
static struct tag_bounds tag_bounds_of(size_t n, const double *values)
{
    enum { LANES = 4 };
    double least[LANES], most[LANES];
    size_t i = 0;
    for (size_t k = 0; k < LANES; k++) least[k] = most[k] = values[0];
    for (; i + LANES <= n; i += LANES)
        for (size_t k = 0; k < LANES; k++) {
            least[k] = values[i + k] < least[k] ? values[i + k] : least[k];
            most[k] = values[i + k] > most[k] ? values[i + k] : most[k];
        }
    for (; i < n; i++) {
        least[0] = values[i] < least[0] ? values[i] : least[0];
        most[0] = values[i] > most[0] ? values[i] : most[0];
    }
    for (size_t k = 1; k < LANES; k++) {
        least[0] = least[k] < least[0] ? least[k] : least[0];
        most[0] = most[k] > most[0] ? most[k] : most[0];
    }
    return (struct tag_bounds){least[0], most[0]};
}

/* Can no two values within the bounds exceed the rule along an axis? */
static bool tag_is_flat(const struct tag_rule *rule, int axis, struct tag_bounds bounds)
{
    double size = bounds.least > 0.0 ? bounds.least : bounds.most < 0.0 ? -bounds.most : 0.0; /* least magnitude */
    return bounds.most - bounds.least <= (rule->relative ? rule->above[axis] * size : rule->above[axis]);
}

/* The same for the tile and what lies behind a face. */
static bool tag_is_flat_across(const struct tag *tag, unsigned local, int face, const struct tag_rule *rule,
                               const struct tag_bounds *bounds)
{
    const struct neighbour *neighbour = &tag->level->neighbours[local][face];
    struct tag_bounds both = bounds[local], other;
    if (neighbour->kind != NEIGHBOUR_LOCAL) return neighbour->kind != NEIGHBOUR_REMOTE;
    other = bounds[neighbour->index];
    both.least = other.least < both.least ? other.least : both.least;
    both.most = other.most > both.most ? other.most : both.most;
    return tag_is_flat(rule, face / 2, both);
}

/* Adds to found[n_cell] where a cell of a tile differs from one of its neighbours. False: nowhere. */
static bool tag_differ(const struct tag *tag, unsigned local, const struct tag_rule *rule, double *const *values,
                       const struct tag_bounds *bounds, double *found)
{
    bool any = false;
    for (int axis = 0; axis < tag->mesh->dim; axis++) {
        bool inside = !tag_is_flat(rule, axis, bounds[local]);
        if (inside) tag_inside(tag, axis, rule, values[local], found);
        any |= inside;
        for (int face = 2 * axis; face < 2 * axis + 2; face++) {
            bool flat = tag_is_flat_across(tag, local, face, rule, bounds);
            if (!flat) tag_across(tag, local, face, rule, values, found);
            any |= !flat;
        }
    }
    return any;
}

static void tag_exchange(const struct tag *tag, double *const *values)
{
    halo_start(tag->halo, values);
    halo_finish(tag->halo);
}

/* Values of all local tiles, one block of n_cell doubles each, and their bounds. */
struct tag_values {
    double **blocks;
    struct tag_bounds *bounds;
};

/* `own` false: the blocks are somebody else's. */
static struct tag_values tag_values_new(const struct tag *tag, bool own)
{
    unsigned count = tag->level->n_local;
    struct tag_values values = {mem_new(count + 1, sizeof *values.blocks), mem_new(count + 1, sizeof *values.bounds)};
    if (own) values.blocks[0] = mem_new_large(count * tag->mesh->n_cell + 1, sizeof **values.blocks);
    for (unsigned t = 1; own && t < count; t++) values.blocks[t] = values.blocks[0] + t * tag->mesh->n_cell;
    return values;
}

static void tag_values_free(struct tag_values values, bool own)
{
    if (own) mem_free(values.blocks[0]);
    mem_free(values.blocks);
    mem_free(values.bounds);
}

static void tag_derive(const struct tag *tag, unsigned local, const struct derive *field, double *out)
{
    derive_tile(tag->model, tag->mesh, tag->l, local, tag->t, field, out);
}

static int tag_find(const struct tag *tag, const char *name, struct derive *ret_field)
{
    TRY(derive_find(tag->model, name, ret_field));
    derive_prepare(tag->model, tag->mesh, tag->t, ret_field);
    return STATUS_OK;
}

/* One component of a field in all local tiles. */
static void tag_derive_all(const struct tag *tag, const struct derive *field, unsigned component,
                           const struct tag_values *values)
{
    size_t n = tag->mesh->n_cell;
    double *all = mem_new(field->components * n, sizeof *all);
    for (unsigned t = 0; t < tag->level->n_local; t++) {
        double *block = values->blocks[t];
        tag_derive(tag, t, field, field->components > 1 ? all : block);
        if (field->components > 1) memcpy(block, all + component * n, n * sizeof *all);
        values->bounds[t] = tag_bounds_of(n, block);
    }
    mem_free(all);
}

/* Gradients and jumps. Components of a vector are judged one by one; a cell counts once. */
static int tag_difference(struct tag *tag)
{
    const struct scene_refine *refine = tag->refine;
    struct derive field;
    TRY(tag_find(tag, refine->field, &field));
    struct tag_rule rule = {.relative = refine->relative};
    bool slope = refine->kind == SCENE_REFINE_GRADIENT && !refine->relative;
    for (int d = 0; d < 3; d++) rule.above[d] = refine->above * (slope ? tag->level->h[d] : 1.0);
    unsigned count = tag->level->n_local, last = field.components - 1;
    size_t pitch = last ? tag->mesh->n_cell : 0; /* scalars: one tile's marks, again and again */
    double *found = mem_new((last ? count : 1) * tag->mesh->n_cell + 1, sizeof *found);
    struct tag_values values = tag_values_new(tag, true);
    for (unsigned c = 0; c <= last; c++) {
        tag_derive_all(tag, &field, c, &values);
        tag_exchange(tag, values.blocks);
        for (unsigned t = 0; t < count; t++) {
            bool any = tag_place(tag, t) != TAG_OUTSIDE &&
                       tag_differ(tag, t, &rule, values.blocks, values.bounds, found + t * pitch);
            if (c == last && (any || last > 0)) tag_keep(tag, t, found + t * pitch);
        }
    }
    tag_values_free(values, true);
    mem_free(found);
    return STATUS_OK;
}

/* Mixed cells, and both cells of a pair between which the fraction jumps: a surface that lies exactly on a face has no
 * mixed cell. */
static int tag_interface(struct tag *tag)
{
    const struct model *model = tag->model;
    const struct tag_rule rule = {.above = {TAG_PRESENT, TAG_PRESENT, TAG_PRESENT}};
    size_t n = tag->mesh->n_cell, at = (model->i_alpha + (unsigned)tag->refine->material) * n;
    unsigned count = tag->level->n_local;
    struct tag_values values = tag_values_new(tag, false);
    double *found = mem_new(n, sizeof *found);
    for (unsigned t = 0; t < count; t++) {
        values.blocks[t] = tag->level->w[t] + at;
        values.bounds[t] = tag_bounds_of(n, values.blocks[t]);
    }
    tag_exchange(tag, values.blocks);
    for (unsigned t = 0; t < count; t++) {
        const double *alpha = values.blocks[t];
        if (tag_place(tag, t) == TAG_OUTSIDE) continue;
        bool any = values.bounds[t].most > TAG_PRESENT && 1.0 - values.bounds[t].least > TAG_PRESENT;
        for (size_t i = 0; any && i < n; i++)
            found[i] = alpha[i] > TAG_PRESENT && 1.0 - alpha[i] > TAG_PRESENT ? 1.0 : 0.0;
        any |= tag_differ(tag, t, &rule, values.blocks, values.bounds, found);
        if (any) tag_keep(tag, t, found);
    }
    tag_values_free(values, false);
    mem_free(found);
    return STATUS_OK;
}

/* |v|; squares are added from the smallest on, so that turned vectors have the same bits. */
static void tag_magnitude(size_t n, double *v)
{
    for (size_t i = 0; i < n; i++) {
        double a = v[i] * v[i], b = v[n + i] * v[n + i], c = v[2 * n + i] * v[2 * n + i];
        double low = a < b ? a : b, high = a < b ? b : a, middle = high < c ? high : c;
        double least = low < c ? low : c, next = low < c ? middle : low, most = high < c ? c : high;
        v[i] = sqrt((least + next) + most);
    }
}

static int tag_value(struct tag *tag)
{
    const struct scene_refine *refine = tag->refine;
    struct derive field;
    TRY(tag_find(tag, refine->field, &field));
    double above = refine->has_above ? refine->above : -INFINITY, below = refine->has_below ? refine->below : INFINITY;
    size_t n = tag->mesh->n_cell;
    double *values = mem_new(field.components * n, sizeof *values), *found = mem_new(n, sizeof *found);
    for (unsigned t = 0; t < tag->level->n_local; t++) {
        if (tag_place(tag, t) == TAG_OUTSIDE) continue;
        tag_derive(tag, t, &field, values);
        if (field.components > 1) tag_magnitude(n, values);
        for (size_t i = 0; i < n; i++) found[i] = values[i] > above && values[i] < below ? 1.0 : 0.0;
        tag_keep(tag, t, found);
    }
    mem_free(values);
    mem_free(found);
    return STATUS_OK;
}

static int tag_region(struct tag *tag)
{
    size_t n = tag->mesh->n_cell;
    double *found = mem_new(n, sizeof *found);
    for (unsigned t = 0; t < tag->level->n_local; t++) {
        if (tag_place(tag, t) == TAG_OUTSIDE) continue;
        for (size_t i = 0; i < n; i++) found[i] = 1.0;
        tag_keep(tag, t, found);
    }
    mem_free(found);
    return STATUS_OK;
}

/* What a script is called with: `from` 0 to 2 are coordinates, 3 the time, 4 a field. */
struct tag_argument {
    int from;
    struct derive field;
    double *values; /* [n_cell] of the tile at hand */
};

static int tag_arguments(const struct tag *tag, struct tag_argument *arguments, double *values)
{
    for (unsigned i = 0; i < tag->refine->n_use; i++) {
        const char *name = tag->refine->uses[i];
        arguments[i].values = values + i * tag->mesh->n_cell;
        arguments[i].from = strlen(name) > 1 ? 4 : *name == 't' ? 3 : *name - 'x';
        if (arguments[i].from == 4) TRY(tag_find(tag, name, &arguments[i].field));
    }
    return STATUS_OK;
}

static int tag_ask(const struct tag *tag, unsigned local, const struct tag_argument *arguments, double *found)
{
    const struct scene_refine *refine = tag->refine;
    bool cut = tag_place(tag, local) == TAG_CUT;
    for (size_t i = 0; i < tag->mesh->n_cell; i++) {
        double x[3], in[SCRIPT_ARGUMENTS];
        bool yes;
        tag_centre(tag, local, i, x);
        if (cut && !shape_contains(refine->where, x)) continue;
        for (unsigned k = 0; k < refine->n_use; k++)
            in[k] = arguments[k].from == 4   ? arguments[k].values[i]
                    : arguments[k].from == 3 ? tag->t
                                             : x[arguments[k].from];
        TRY(script_test(refine->script, in, refine->n_use, &yes));
        found[i] = yes ? 1.0 : 0.0;
    }
    return STATUS_OK;
}

static int tag_script(struct tag *tag)
{
    const struct scene_refine *refine = tag->refine;
    struct tag_argument arguments[SCRIPT_ARGUMENTS] = {0};
    size_t n = tag->mesh->n_cell;
    double *values = mem_new(refine->n_use * n + 1, sizeof *values), *found = mem_new(n, sizeof *found);
    int status = tag_arguments(tag, arguments, values);
    for (unsigned t = 0; t < tag->level->n_local && !status; t++) {
        if (tag_place(tag, t) == TAG_OUTSIDE) continue;
        for (unsigned k = 0; k < refine->n_use; k++)
            if (arguments[k].from == 4) tag_derive(tag, t, &arguments[k].field, arguments[k].values);
        status = tag_ask(tag, t, arguments, found);
        tag_keep(tag, t, found);
    }
    mem_free(values);
    mem_free(found);
    return comm_agree(status);
}

static int tag_criterion(struct tag *tag)
{
    switch (tag->refine->kind) {
    case SCENE_REFINE_GRADIENT:
    case SCENE_REFINE_JUMP: return tag_difference(tag);
    case SCENE_REFINE_VALUE: return tag_value(tag);
    case SCENE_REFINE_INTERFACE: return tag_interface(tag);
    case SCENE_REFINE_SCRIPT: return tag_script(tag);
    default: return tag_region(tag);
    }
}

int tag_level(const struct model *model, const struct mesh *mesh, int l, double t, struct halo *halo, double **marks,
              long long *hits)
{
    const struct scene *scene = model->scene;
    struct tag tag = {
        .model = model, .mesh = mesh, .level = &mesh->levels[l], .l = l, .t = t, .halo = halo, .marks = marks};
    int status = STATUS_OK;
    for (unsigned i = 0; i < tag.level->n_local; i++) memset(marks[i], 0, mesh->n_cell * sizeof **marks);
    tag.step = mem_new(mesh->n_cell, sizeof *tag.step);
    for (unsigned c = 0; c < scene->n_refine && !status; c++) {
        tag.refine = &scene->refines[c];
        tag.hits = 0;
        if (tag.refine->finest <= l || t < tag.refine->t_from || t > tag.refine->t_until) continue;
        status = tag_criterion(&tag);
        hits[c] += tag.hits;
    }
    mem_free(tag.step);
    return status;
}

/* " of pressure above 1e+09 Pa/m", " of density above 0.05 of the larger cell" */
static void tag_describe_bounds(const struct scene_refine *refine, struct text *text)
{
    bool slope = refine->kind == SCENE_REFINE_GRADIENT && !refine->relative, pure = strcmp(refine->unit, "1") == 0;
    const char *unit = refine->relative ? " of the larger cell" : pure && !slope ? "" : refine->unit;
    const char *gap = refine->relative || !*unit ? "" : " ", *per = slope ? "/m" : "";
    text_add(text, " of %s", refine->field);
    if (refine->has_above) text_add(text, " above %g%s%s%s", refine->above, gap, unit, per);
    if (refine->has_below) text_add(text, "%s below %g%s%s", refine->has_above ? " and" : "", refine->below, gap, unit);
}

char *tag_describe(const struct scene *scene, unsigned criterion)
{
    const struct scene_refine *refine = &scene->refines[criterion];
    struct text text = {0};
    text_add(&text, "mesh.refine[%u] (line %d): ", criterion, refine->line);
    switch (refine->kind) {
    case SCENE_REFINE_GRADIENT:
    case SCENE_REFINE_JUMP:
        text_add(&text, "%s", refine->kind == SCENE_REFINE_JUMP || refine->relative ? "jump" : "gradient");
        tag_describe_bounds(refine, &text);
        break;
    case SCENE_REFINE_VALUE:
        text_add(&text, "value");
        tag_describe_bounds(refine, &text);
        break;
    case SCENE_REFINE_INTERFACE: text_add(&text, "interface of %s", scene->material[refine->material].name); break;
    case SCENE_REFINE_SCRIPT: text_add(&text, "lua"); break;
    case SCENE_REFINE_REGION: text_add(&text, "region"); break;
    }
    if (refine->where && refine->kind != SCENE_REFINE_REGION) text_add(&text, ", in a region");
    if (refine->finest < scene->levels) text_add(&text, ", to level %d", refine->finest);
    if (refine->t_from > 0) text_add(&text, ", from %g s", refine->t_from);
    if (isfinite(refine->t_until)) text_add(&text, ", until %g s", refine->t_until);
    return text.at;
}
