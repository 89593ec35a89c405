/* tag.c - see tag.h.
 *
 * Each criterion finds cells tile by tile, or for vectors component by component; what it found in its region is
 * kept. Differences are taken by tag_pair.c. */
#include "solve/tag.h"

#include "base/comm.h"
#include "base/mem.h"
#include "base/status.h"
#include "base/text.h"
#include "mesh/rigid.h"
#include "solve/tag_pair.h"

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
    struct derive_moment *moment;
    struct halo *halo;
    double radius;                     /* half the diagonal of a cell */
    const struct scene_refine *refine; /* the criterion at hand */
    double **marks;
    struct tag_pair pair;
    long long hits;
};

/* A point of a cell, `part` of the cell size above its lower corner: such that cells mirrored at x = 0 have the same
 * bits but the sign. */
static void tag_point(const struct tag *tag, unsigned local, size_t cell, double part, double ret_x[3])
{
    const struct mesh *mesh = tag->mesh;
    const struct tile *tile = &tag->level->tiles[tag->level->first + local];
    for (int d = 0; d < 3; d++) {
        size_t n = (size_t)mesh->n[d];
        double all = (double)tag->level->extent[d] * mesh->n[d];
        double at = (double)tile->at[d] * mesh->n[d] + (double)(cell % n) + part;
        ret_x[d] = d < mesh->dim ? (mesh->lower[d] * (all - at) + mesh->upper[d] * at) / all : 0.0;
        cell /= n;
    }
}

/* Does the criterion's region cover any of a cell? A region smaller than a cell must be found on coarse levels too. */
static bool tag_covers(const struct tag *tag, unsigned local, size_t cell)
{
    const struct shape *where = tag->refine->where;
    double x[3], upper[3];
    tag_point(tag, local, cell, 0.5, x);
    double level = shape_level(where, x);
    if (level <= 0.0 || level > tag->radius) return level <= 0.0;
    tag_point(tag, local, cell, 0.0, x);
    tag_point(tag, local, cell, 1.0, upper);
    return shape_fraction(where, x, upper, tag->mesh->dim, 0) > 0.0;
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
    double *mark = tag->marks[local];
    size_t n = tag->mesh->n_cell;
    if (place == TAG_CUT)
        for (size_t i = 0; i < n; i++)
            if (found[i] > 0.0 && !tag_covers(tag, local, i)) found[i] = 0.0;
    double hits = 0.0;
    for (size_t i = 0; i < n && place != TAG_OUTSIDE; i++) {
        double one = found[i] > 0.0 ? 1.0 : 0.0;
        mark[i] = mark[i] > one ? mark[i] : one;
        hits += one;
    }
    tag->hits += (long long)hits;
    memset(found, 0, n * sizeof *found);
}

static void tag_exchange(const struct tag *tag, double *const *values)
{
    halo_start(tag->halo, values);
    halo_finish(tag->halo);
}

static int tag_find(const struct tag *tag, const char *name, struct derive *ret_field)
{
    TRY(derive_find(tag->model, name, ret_field));
    derive_prepare(tag->moment, ret_field);
    return STATUS_OK;
}

static void tag_derive(const struct tag *tag, unsigned local, const struct derive *field, double *out)
{
    derive_tile(tag->model, tag->mesh, tag->l, local, tag->moment->t, field, out);
}

/* One component of a field in the local tiles that need be looked at twice. Few do, and memory that is written once
 * and read once costs more than the field. */
struct tag_values {
    const struct derive *field;
    unsigned component;
    double *all;     /* [components][n_cell] work space */
    double **blocks; /* [n_local] blocks of n_cell, or NULL */
    struct tag_pair_bounds *bounds;
    bool *need;
};

static void tag_values_fill(const struct tag *tag, const struct tag_values *values, unsigned local, double *out)
{
    size_t n = tag->mesh->n_cell;
    bool vector = values->field->components > 1;
    tag_derive(tag, local, values->field, vector ? values->all : out);
    if (vector) memcpy(out, values->all + values->component * n, n * sizeof *out);
}

/* Bounds of all tiles; values of those that differ within or that other ranks look at. */
static void tag_values_begin(const struct tag *tag, const struct tag_pair_rule *rule, const struct tag_values *values)
{
    double *block = NULL;
    for (unsigned t = 0; t < tag->level->n_local; t++) {
        if (!block) block = mem_new(tag->mesh->n_cell, sizeof *block);
        tag_values_fill(tag, values, t, block);
        values->bounds[t] = tag_pair_bounds_of(tag->mesh->n_cell, block);
        if (tag_pair_is_smooth(&tag->pair, rule, values->bounds[t]) && !halo_is_remote(tag->level, t)) continue;
        values->blocks[t] = block;
        block = NULL;
    }
    mem_free(block);
}

/* Values of the tiles beside them. */
static void tag_values_end(const struct tag *tag, const struct tag_pair_rule *rule, const struct tag_values *values)
{
    for (unsigned t = 0; t < tag->level->n_local; t++)
        tag_pair_needs(&tag->pair, t, rule, values->bounds, values->need);
    for (unsigned t = 0; t < tag->level->n_local; t++) {
        if (!values->need[t] || values->blocks[t]) continue;
        values->blocks[t] = mem_new(tag->mesh->n_cell, sizeof **values->blocks);
        tag_values_fill(tag, values, t, values->blocks[t]);
    }
}

static struct tag_values tag_values_new(const struct tag *tag, const struct derive *field, unsigned component)
{
    unsigned count = tag->level->n_local + 1;
    struct tag_values values = {.field = field, .component = component};
    values.all = mem_new(field->components * tag->mesh->n_cell, sizeof *values.all);
    values.blocks = mem_new(count, sizeof *values.blocks);
    values.bounds = mem_new(count, sizeof *values.bounds);
    values.need = mem_new(count, sizeof *values.need);
    return values;
}

static void tag_values_free(const struct tag *tag, struct tag_values values)
{
    for (unsigned t = 0; t < tag->level->n_local; t++) mem_free(values.blocks[t]);
    mem_free(values.blocks);
    mem_free(values.bounds);
    mem_free(values.need);
    mem_free(values.all);
}

/* Gradients and jumps. Components of a vector are judged one by one; a cell counts once. */
static int tag_difference(struct tag *tag)
{
    const struct scene_refine *refine = tag->refine;
    struct derive field;
    TRY(tag_find(tag, refine->field, &field));
    struct tag_pair_rule rule = {.relative = refine->relative};
    bool slope = refine->kind == SCENE_REFINE_GRADIENT && !refine->relative;
    for (int d = 0; d < 3; d++) rule.above[d] = refine->above * (slope ? tag->level->h[d] : 1.0);
    unsigned count = tag->level->n_local, last = field.components - 1;
    size_t pitch = last ? tag->mesh->n_cell : 0; /* scalars: one tile's marks, again and again */
    double *found = mem_new((last ? count : 1) * tag->mesh->n_cell + 1, sizeof *found);
    for (unsigned c = 0; c <= last; c++) {
        struct tag_values values = tag_values_new(tag, &field, c);
        tag_values_begin(tag, &rule, &values);
        tag_exchange(tag, values.blocks);
        tag_values_end(tag, &rule, &values);
        for (unsigned t = 0; t < count; t++) {
            bool any = tag_place(tag, t) != TAG_OUTSIDE &&
                       tag_pair_differ(&tag->pair, t, &rule, values.blocks, values.bounds, found + t * pitch);
            if (c == last && (any || last > 0)) tag_keep(tag, t, found + t * pitch);
        }
        tag_values_free(tag, values);
    }
    mem_free(found);
    return STATUS_OK;
}

/* Mixed cells, and both cells of a pair between which the fraction jumps: a surface that lies exactly on a face has no
 * mixed cell. */
static int tag_interface(struct tag *tag)
{
    const struct model *model = tag->model;
    const struct tag_pair_rule rule = {.above = {TAG_PRESENT, TAG_PRESENT, TAG_PRESENT}};
    size_t n = tag->mesh->n_cell, at = (model->i_alpha + (unsigned)tag->refine->material) * n;
    unsigned count = tag->level->n_local;
    double **values = mem_new(count + 1, sizeof *values), *found = mem_new(n, sizeof *found);
    struct tag_pair_bounds *bounds = mem_new(count + 1, sizeof *bounds);
    for (unsigned t = 0; t < count; t++) {
        values[t] = tag->level->w[t] + at;
        bounds[t] = tag_pair_bounds_of(n, values[t]);
    }
    tag_exchange(tag, values);
    for (unsigned t = 0; t < count; t++) {
        if (tag_place(tag, t) == TAG_OUTSIDE) continue;
        bool any = bounds[t].most > TAG_PRESENT && 1.0 - bounds[t].least > TAG_PRESENT;
        for (size_t i = 0; any && i < n; i++)
            found[i] = values[t][i] > TAG_PRESENT && 1.0 - values[t][i] > TAG_PRESENT ? 1.0 : 0.0;
        any |= tag_pair_differ(&tag->pair, t, &rule, values, bounds, found);
        if (any) tag_keep(tag, t, found);
    }
    mem_free(values);
    mem_free(bounds);
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
        if (cut && !tag_covers(tag, local, i)) continue;
        tag_point(tag, local, i, 0.5, x);
        for (unsigned k = 0; k < refine->n_use; k++)
            in[k] = arguments[k].from == 4   ? arguments[k].values[i]
                    : arguments[k].from == 3 ? tag->moment->t
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

/* Cells that a wall closes a part of. */
static int tag_bodies(struct tag *tag)
{
    const struct mesh *mesh = tag->mesh;
    double t = tag->moment->t, *found = mem_new(mesh->n_cell, sizeof *found);
    for (unsigned local = 0; local < tag->level->n_local; local++) {
        const struct tile *tile = &tag->level->tiles[tag->level->first + local];
        const struct rigid_cells *cells = rigid_at(mesh, tag->level, tile, (struct rigid_times){t, t, t});
        if (!cells) continue;
        for (size_t i = 0; i < mesh->n_cell; i++) found[i] = rigid_is_wall(cells, mesh, i) ? 1.0 : 0.0;
        tag_keep(tag, local, found);
    }
    mem_free(found);
    return STATUS_OK;
}

static int tag_criterion(struct tag *tag)
{
    switch (tag->refine->kind) {
    case SCENE_REFINE_GRADIENT:
    case SCENE_REFINE_JUMP: return tag_difference(tag);
    case SCENE_REFINE_VALUE: return tag_value(tag);
    case SCENE_REFINE_INTERFACE: return tag_interface(tag);
    case SCENE_REFINE_SCRIPT: return tag_script(tag);
    case SCENE_REFINE_BODIES: return tag_bodies(tag);
    default: return tag_region(tag);
    }
}

int tag_level(struct derive_moment *moment, int l, struct halo *halo, double **marks, long long *hits)
{
    const struct model *model = moment->model;
    const struct mesh *mesh = moment->mesh;
    const struct scene *scene = model->scene;
    double t = moment->t;
    struct tag tag = {.model = model,
                      .mesh = mesh,
                      .level = &mesh->levels[l],
                      .l = l,
                      .moment = moment,
                      .halo = halo,
                      .marks = marks};
    int status = STATUS_OK;
    for (int d = 0; d < mesh->dim; d++) tag.radius += 0.25 * tag.level->h[d] * tag.level->h[d];
    tag.radius = 1.001 * sqrt(tag.radius);
    for (unsigned i = 0; i < tag.level->n_local; i++) memset(marks[i], 0, mesh->n_cell * sizeof **marks);
    tag.pair = (struct tag_pair){mesh, tag.level, halo, mem_new(mesh->n_cell, sizeof(double))};
    for (unsigned c = 0; c < scene->mesh.n_refine && !status; c++) {
        tag.refine = &scene->mesh.refines[c];
        tag.hits = 0;
        if (tag.refine->finest <= l || t < tag.refine->t_from || t > tag.refine->t_until) continue;
        status = tag_criterion(&tag);
        hits[c] += tag.hits;
    }
    mem_free(tag.pair.step);
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
    const struct scene_refine *refine = &scene->mesh.refines[criterion];
    struct text text = {0};
    if (refine->kind != SCENE_REFINE_BODIES) text_add(&text, "mesh.refine[%u] (line %d): ", criterion, refine->line);
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
    case SCENE_REFINE_BODIES: text_add(&text, "walls of bodies"); break;
    }
    if (refine->where && refine->kind != SCENE_REFINE_REGION) text_add(&text, ", in a region");
    if (refine->finest < scene->mesh.levels) text_add(&text, ", to level %d", refine->finest);
    if (refine->t_from > 0) text_add(&text, ", from %g s", refine->t_from);
    if (isfinite(refine->t_until)) text_add(&text, ", until %g s", refine->t_until);
    return text.at;
}
