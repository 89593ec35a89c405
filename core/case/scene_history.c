/* scene_history.c - the columns of history.csv. */
#include "case/scene_draft.h"

#include "base/mem.h"
#include "base/text.h"

#include <string.h>

/* In the order of enum scene_measure, which is that of the rows. */
enum { SCENE_HISTORY_MEASURES = SCENE_VALUE + 1 };

static const struct key scene_history_rows[] = {
    {.name = "volume", .type = KEYS_TEXT, .doc = "Volume of a material."},
    {.name = "mass", .type = KEYS_TEXT, .doc = "Mass of a material."},
    {.name = "centroid", .type = KEYS_TEXT, .doc = "Position of a material's centre of volume, `along` an axis."},
    {.name = "min", .type = KEYS_FIELD, .doc = "Least value of a field."},
    {.name = "max", .type = KEYS_FIELD, .doc = "Largest value of a field."},
    {.name = "mean",
     .type = KEYS_FIELD,
     .doc = "Mean of a field over the volume; `temperature_M` counts where there is enough of M to have one."},
    {.name = "integral", .type = KEYS_FIELD, .doc = "Integral of a field over the volume."},
    {.name = "plane-integral",
     .type = KEYS_FIELD,
     .doc = "Integral of a field over the plane of r and z, without the 2 pi r of `integral`."},
    {.name = "total",
     .type = KEYS_CHOICE,
     .choices = "mass|momentum_x|momentum_y|momentum_z|energy",
     .doc = "Total of a conserved quantity."},
    {.name = "penetration",
     .type = KEYS_TEXT,
     .doc = "How far a material's surface on the axis has moved into it, `along` an axis; negative: it was pulled "
            "out."},
    {.name = "equivalent-radius", .type = KEYS_TEXT, .doc = "Radius of the sphere (disc) of a material's volume."},
    {.name = "jet-speed",
     .type = KEYS_TEXT,
     .doc = "Velocity `along` an axis of largest magnitude in a material, with its sign."},
    {.name = "isosurface-mean", .type = KEYS_FIELD, .doc = "Mean of a field over the surface of the material `in`."},
    {.name = "isosurface-min",
     .type = KEYS_FIELD,
     .doc = "Least value of a field on the surface of the material `in`."},
    {.name = "isosurface-max",
     .type = KEYS_FIELD,
     .doc = "Largest value of a field on the surface of the material `in`."},
    {.name = "outside",
     .type = KEYS_TEXT,
     .doc = "Number of cells in which a continuation stands in for the equation of state of a material, traces "
            "excepted."},
    {.name = "min-between",
     .type = KEYS_TEXT,
     .doc = "Least value of a column further up, over all steps since the row before."},
    {.name = "max-between",
     .type = KEYS_TEXT,
     .doc = "Largest value of a column further up, over all steps since the row before."},
    {.name = "evaporated",
     .type = KEYS_TEXT,
     .doc = "Mass of a vapour that has come from its liquid since the start, less what has condensed."},
    {.name = "force",
     .type = KEYS_TEXT,
     .doc = "Force of the fluids on a body, `along` an axis: what presses on its walls. Per metre of depth in 2D."},
    {.name = "power",
     .type = KEYS_TEXT,
     .doc = "Power that fluids give to a body that moves: what the pressure on its walls works; they lose as much "
            "energy."},
    {.name = "body-displacement", .type = KEYS_TEXT, .doc = "How far a body has moved `along` an axis."},
    {.name = "body-velocity",
     .type = KEYS_TEXT,
     .doc = "Velocity of a body `along` an axis; of its pivot, if it turns."},
    {.name = "body-angle", .type = KEYS_TEXT, .doc = "By how much a body has turned."},
    {.name = "value", .type = KEYS_TREE, .doc = "An expression of t, columns further up, and parameters."},
    {.name = "in", .type = KEYS_TEXT, .doc = "Only in this material."},
    {.name = "where", .type = KEYS_SECTION, .section = &scene_shape_keys, .doc = "Only in this region."},
    {.name = "along",
     .type = KEYS_CHOICE,
     .choices = "x|y|z|r|axis",
     .doc = "An axis; in axisymmetric geometry r is x and axis is y."},
    {0},
};

const struct keys_section scene_history_column_keys = {.name = "column",
                                                       .doc = "One measure per column.",
                                                       .keys = scene_history_rows,
                                                       .choose = SCENE_HISTORY_MEASURES,
                                                       .rules = "{'dependencies': {'isosurface-mean': ['in'], "
                                                                "'isosurface-min': ['in'], 'isosurface-max': ['in']}}"};

static bool scene_history_of_material(enum scene_measure measure)
{
    return measure == SCENE_VOLUME || measure == SCENE_MASS || measure == SCENE_CENTROID ||
           measure == SCENE_PENETRATION || measure == SCENE_EQUIVALENT_RADIUS || measure == SCENE_JET_SPEED ||
           measure == SCENE_OUTSIDE;
}

static bool scene_history_of_surface(enum scene_measure measure)
{
    return measure == SCENE_ISOSURFACE_MEAN || measure == SCENE_ISOSURFACE_MIN || measure == SCENE_ISOSURFACE_MAX;
}

static bool scene_history_directed(enum scene_measure measure)
{
    return measure == SCENE_CENTROID || measure == SCENE_PENETRATION || measure == SCENE_JET_SPEED ||
           measure == SCENE_FORCE || measure == SCENE_BODY_DISPLACEMENT || measure == SCENE_BODY_VELOCITY;
}

static bool scene_history_of_body(enum scene_measure measure)
{
    return measure >= SCENE_FORCE && measure <= SCENE_BODY_ANGLE;
}

/* The arguments of a value expression: t and the columns further up that it mentions. */
static const char *scene_history_uses(struct draft *draft, struct scene_column *column, const struct keys_value *value)
{
    const struct scene *scene = draft->scene;
    const char *text = value->node->text, *list = "";
    column->uses = mem_new(SCRIPT_ARGUMENTS, sizeof *column->uses);
    for (long i = -1; i < column - scene->output.columns; i++) {
        const char *name = i < 0 ? "t" : scene->output.columns[i].name;
        if (!params_mentions(text, name)) continue;
        if (column->n_use == SCRIPT_ARGUMENTS) {
            keys_error(&draft->keys, value, "more than %d columns in one expression", SCRIPT_ARGUMENTS);
            return NULL;
        }
        snprintf(column->uses[column->n_use++], SCENE_NAME, "%s", name);
        list = tree_print(draft->keys.forest, "%s%s%s", list, *list ? "," : "", name);
    }
    return list;
}

static const char *scene_history_above(struct draft *draft, const struct scene_column *column)
{
    const char *above = "";
    for (const struct scene_column *at = draft->scene->output.columns; at < column; at++)
        above = tree_print(draft->keys.forest, "%s%s%s", above, *above ? ", " : "", at->name);
    return above;
}

static void scene_history_value(struct draft *draft, struct scene_column *column, const struct keys_value *value)
{
    if (value->node->kind != TREE_SCALAR || tree_is_null(value->node)) {
        keys_error(&draft->keys, value, "an expression is needed, not %s", tree_describe(value->node));
        return;
    }
    const char *arguments = scene_history_uses(draft, column, value);
    if (!arguments || params_compile(draft->keys.params, value->node, value->path, arguments, &column->script)) return;
    const char *above = scene_history_above(draft, column);
    diag_help(draft->keys.diag, "columns that stand further up can be used: t%s%s", *above ? ", " : "", above);
}

static bool scene_history_between(enum scene_measure measure)
{
    return measure == SCENE_MIN_BETWEEN || measure == SCENE_MAX_BETWEEN;
}

/* What stands further up. */
static void scene_history_suggest(struct draft *draft, const struct scene_column *column, const char *word)
{
    const struct scene_column *columns = draft->scene->output.columns;
    const char **names = mem_new((size_t)(column - columns) + 1, sizeof *names);
    for (const struct scene_column *at = columns; at < column; at++) names[at - columns] = at->name;
    if (column > columns) diag_suggest(draft->keys.diag, word, names);
    mem_free(names);
}

/* The column whose extremes are wanted. */
static void scene_history_of(struct draft *draft, struct scene_column *column, const struct keys_value *value)
{
    const struct scene_output *output = &draft->scene->output;
    if (!value->given) return;
    while (column->of < output->n_column && strcmp(output->columns[column->of].name, value->text) != 0) column->of++;
    const struct scene_column *of = &output->columns[column->of];
    if (of >= column) {
        keys_error(&draft->keys, value, "'%s' is no column further up", value->text);
        scene_history_suggest(draft, column, value->text);
    } else if (scene_history_between(of->measure)) {
        keys_error(&draft->keys, value, "'%s' is itself an extreme between rows", value->text);
    }
}

/* An extreme takes its column as it is. */
static void scene_history_alone(struct draft *draft, const struct keys_map *map, const struct keys_value *measure)
{
    static const char *const others[] = {"in", "where", "along"};
    for (unsigned i = 0; i < sizeof others / sizeof *others; i++) {
        const struct keys_value *value = keys_at(map, others[i]);
        if (!value->node) continue;
        keys_error(&draft->keys, value, "'%s' goes with what is measured, not with extremes of it", others[i]);
        diag_help(draft->keys.diag, "give it to the column that '%s' names", measure->key->name);
    }
}

/* The vapour of a pair. */
static void scene_history_vapour(struct draft *draft, struct scene_column *column, const struct keys_value *value)
{
    const struct scene *scene = draft->scene;
    column->material = scene_matter_index(draft, value);
    if (column->material < 0 || scene_phase_of(scene, (unsigned)column->material)) return;
    keys_error(&draft->keys, value, "'%s' is the vapour of no pair of 'phase-change'", value->text);
    for (unsigned k = 0; k < scene->n_phase; k++)
        diag_help(draft->keys.diag, "there is '%s'", scene->material[scene->phases[k].vapour].name);
}

static void scene_history_measure(struct draft *draft, struct scene_column *column, const struct keys_value *value)
{
    if (scene_history_of_material(column->measure)) column->material = scene_matter_index(draft, value);
    else if (column->measure == SCENE_TOTAL) snprintf(column->field, SCENE_NAME, "%s", value->given ? value->text : "");
    else if (column->measure == SCENE_VALUE) scene_history_value(draft, column, value);
    else if (scene_history_between(column->measure)) scene_history_of(draft, column, value);
    else if (scene_history_of_body(column->measure)) column->rigid = scene_rigid_index(draft, value);
    else if (column->measure == SCENE_EVAPORATED) scene_history_vapour(draft, column, value);
    else if (value->given && scene_formula_is(value)) scene_formula(draft, value, column->name, column->field);
    else scene_field_name(draft, value, column->field);
}

/* The one measure of a column; NULL after a recorded error. */
static const struct keys_value *scene_history_chosen(struct draft *draft, const struct keys_map *map,
                                                     struct scene_column *column)
{
    const struct keys_value *chosen = NULL;
    for (int i = 0; i < SCENE_HISTORY_MEASURES; i++) {
        const struct keys_value *value = keys_at(map, scene_history_rows[i].name);
        if (!value->node) continue;
        if (chosen) {
            keys_error(&draft->keys, value, "one measure per column: '%s' is already given", chosen->key->name);
            return NULL;
        }
        chosen = value;
        column->measure = (enum scene_measure)i;
    }
    if (chosen) return chosen;
    diag_error(draft->keys.diag, &map->node->mark, "%s: nothing is measured", map->path);
    diag_help(draft->keys.diag,
              "one of volume, mass, centroid, min, max, mean, integral, plane-integral, total, "
              "penetration, equivalent-radius, jet-speed, isosurface-mean, isosurface-min, isosurface-max, "
              "outside, min-between, max-between, force, power, body-displacement, body-velocity, body-angle, "
              "evaporated, value");
    return NULL;
}

static void scene_history_along(struct draft *draft, struct scene_column *column, const struct keys_value *measure,
                                const struct keys_map *map)
{
    const struct scene *scene = draft->scene;
    column->along = scene_domain_axis(draft, keys_at(map, "along"));
    if (column->along >= 0 || !scene_history_directed(column->measure) || keys_at(map, "along")->node) return;
    if (scene->domain.dim == 1) column->along = 0;
    else if (scene->domain.geometry == SCENE_AXISYMMETRIC) column->along = 1;
    else if (scene->domain.dim > 1)
        keys_error(&draft->keys, measure, "'along' is missing: the axis x, y or z along which to measure");
}

static void scene_history_column(struct draft *draft, struct scene_column *column, const struct keys_value *entry)
{
    static const char *const taken[] = {"step",         "t", "dt", "guard_fallback", "guard_relaxed", "guard_clipped",
                                        "guard_retries"};
    const struct keys_map *map = entry->map;
    const struct keys_value *in = keys_at(map, "in"), *which = NULL, *where = keys_at(map, "where");
    column->material = column->in = column->along = -1;
    snprintf(column->name, SCENE_NAME, "%s", entry->name);
    if (!text_is_identifier(entry->name) || strlen(entry->name) >= SCENE_NAME)
        keys_error(&draft->keys, entry, "the name of a column is an identifier (letters, digits and _)");
    for (unsigned i = 0; i < sizeof taken / sizeof *taken; i++)
        if (strcmp(taken[i], entry->name) == 0)
            keys_error(&draft->keys, entry, "every history has a column '%s' already", taken[i]);
    const struct keys_value *measure = map ? scene_history_chosen(draft, map, column) : NULL;
    if (!measure) return;
    if (in->given) column->in = scene_matter_index(draft, in);
    if (where->given) column->where = scene_shape(draft, where->map, true, &which);
    scene_history_measure(draft, column, measure);
    scene_history_along(draft, column, measure, map);
    if (scene_history_of_surface(column->measure) && !in->node)
        keys_error(&draft->keys, measure, "'in' is missing: the material whose surface it is");
    if (scene_history_between(column->measure)) scene_history_alone(draft, map, measure);
    bool of_body = scene_history_of_body(column->measure);
    if ((!of_body && column->measure != SCENE_EVAPORATED) || (!in->node && !where->node)) return;
    keys_error(&draft->keys, in->node ? in : where,
               of_body ? "a column of a body is of all of it" : "what has evaporated is known of the whole domain");
}

void scene_history(struct draft *draft)
{
    const struct keys_map *output = keys_at(draft->root, "output")->map;
    const struct keys_value *columns = keys_at(keys_at(output, "history")->map, "columns");
    struct scene *scene = draft->scene;
    scene->output.columns = mem_new(columns->count + 1, sizeof *scene->output.columns);
    for (unsigned i = 0; i < columns->count; i++)
        scene_history_column(draft, &scene->output.columns[scene->output.n_column++], &columns->list[i]);
}
