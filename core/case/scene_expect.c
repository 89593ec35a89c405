/* scene_expect.c - what a case says its result must satisfy. */
#include "case/scene_draft.h"

#include "base/mem.h"
#include "base/status.h"
#include "case/table.h"

#include <stdio.h>
#include <string.h>

static const struct key scene_expect_rows[] = {
    {.name = "value",
     .type = KEYS_TREE,
     .doc = "Expression over history and probe columns: `min(V)/first(V)`, `max(wall.pressure)`."},
    {.name = "norm", .type = KEYS_CHOICE, .choices = "L1|L2|Linf", .doc = "Norm of a difference to a reference."},
    {.name = "at-most", .type = KEYS_NUMBER, .doc = "Largest value that passes."},
    {.name = "at-least", .type = KEYS_NUMBER, .doc = "Least value that passes."},
    {.name = "equals", .type = KEYS_NUMBER, .doc = "Value within tolerance + relative |equals|."},
    {.name = "tolerance", .type = KEYS_NUMBER, .min = 0, .max = KEYS_MOST, .doc = "Absolute tolerance of `equals`."},
    {.name = "relative",
     .type = KEYS_NUMBER,
     .unit = "1",
     .min = 0,
     .max = KEYS_MOST,
     .doc = "Relative tolerance of `equals`."},
    {.name = "field",
     .type = KEYS_TEXT,
     .doc = "What is compared: a field of the last snapshot, or a history or probe column over time."},
    {.name = "reference",
     .type = KEYS_TEXT,
     .doc = "CSV file, relative to this file; or `exact-riemann`, or `initial`."},
    {.name = "column", .type = KEYS_TEXT, .doc = "Column of the CSV; the name of the field if not given."},
    {.name = "coordinate",
     .type = KEYS_TEXT,
     .doc = "Column of the CSV that holds x or t; x for a field, t for a column if not given."},
    {.name = "scale",
     .type = KEYS_NUMBER,
     .min = KEYS_POSITIVE,
     .max = KEYS_MOST,
     .doc = "The norm is divided by this."},
    {.name = "order",
     .type = KEYS_NUMBER,
     .unit = "1",
     .min = 0,
     .max = 10,
     .doc = "Least order of convergence that `bulla verify` accepts."},
    {.name = "label", .type = KEYS_TEXT, .doc = "What reports call it."},
    {0},
};

#define SCENE_EXPECT_RULES                                                                                      \
    "{'anyOf': [{'required': ['at-most']}, {'required': ['at-least']}, {'required': ['equals']}, {'required': " \
    "['order']}]},"                                                                                             \
    "{'dependencies': {'norm': ['field', 'reference']}}"

const struct keys_section scene_expect_keys = {.name = "expectation",
                                               .doc = "A bound on a value or on the distance to a reference.",
                                               .keys = scene_expect_rows,
                                               .choose = 2,
                                               .rules = SCENE_EXPECT_RULES};

static char *scene_expect_text(const struct keys_value *value)
{
    return value->given ? mem_text(value->text) : NULL;
}

/* Names an expression over a run may use: columns, probes, parameters, a few of every run. NULL-terminated. */
static const char *const *scene_expect_names(struct draft *draft)
{
    static const char *const always[] = {
        "t", "step", "dt", "guard_fallback", "guard_relaxed", "guard_clipped", "guard_retries", "pi"};
    const struct scene *scene = draft->scene;
    const struct node *parameters = tree_get(draft->root->node, "parameters");
    unsigned count = sizeof always / sizeof *always, n_param = parameters ? parameters->count : 0;
    const char **names =
        tree_take(draft->keys.forest, (count + scene->n_column + scene->n_probe + n_param + 1) * sizeof *names);
    memcpy(names, always, sizeof always);
    for (unsigned i = 0; i < scene->n_column; i++) names[count++] = scene->columns[i].name;
    for (unsigned i = 0; i < scene->n_probe; i++) names[count++] = scene->probes[i].name;
    for (unsigned i = 0; i < n_param; i++) names[count++] = parameters->keys[i]->text;
    return names;
}

/* A mistyped column would be found only after the run. Words before a bracket are functions, which the evaluator knows. */
static void scene_expect_check(struct draft *draft, const char *text, const struct keys_value *value)
{
    const char *const *names = scene_expect_names(draft);
    char name[PARAMS_WORD];
    while (params_next(&text, name)) {
        bool known = text[strspn(text, " ")] == '(';
        for (const char *const *at = names; *at && !known; at++) known = strcmp(*at, name) == 0;
        if (known) continue;
        keys_error(&draft->keys, value, "there is no column, probe or parameter '%s'", name);
        diag_suggest(draft->keys.diag, name, names);
        return;
    }
}

/* Parameters that the expression uses stay in the resolved case. */
static void scene_expect_value(struct draft *draft, struct scene_expect *expect, const struct keys_value *value)
{
    if (value->node->kind != TREE_SCALAR || tree_is_null(value->node)) {
        keys_error(&draft->keys, value, "an expression is needed, not %s", tree_describe(value->node));
        return;
    }
    const char *text = value->node->text;
    text += strspn(text, " ");
    expect->value = mem_text(*text == '=' ? text + 1 : text);
    scene_expect_check(draft, expect->value, value);
    params_keep(draft->keys.params, expect->value);
}

static bool scene_expect_word(const char *name)
{
    return strcmp(name, "exact-riemann") == 0 || strcmp(name, "initial") == 0;
}

/* Is it a column of the history ("V") or of the probes ("wall.pressure")? */
static bool scene_expect_is_column(const struct scene *scene, const char *name)
{
    for (unsigned i = 0; i < scene->n_column; i++)
        if (strcmp(scene->columns[i].name, name) == 0) return true;
    const char *dot = strchr(name, '.');
    for (unsigned i = 0; dot && i < scene->n_probe; i++)
        if (strlen(scene->probes[i].name) == (size_t)(dot - name) &&
            strncmp(scene->probes[i].name, name, (size_t)(dot - name)) == 0)
            return true;
    return false;
}

/* What would be found only after the run, and what would not be found at all. */
static void scene_expect_table(struct draft *draft, const struct scene_expect *expect,
                               const struct keys_value *reference, bool over_time)
{
    const struct scene *scene = draft->scene;
    struct table_pair pair;
    if (!over_time && scene->dim > 1) {
        keys_error(&draft->keys, reference, "a CSV profile can be compared with fields of 1D scenes only");
        return;
    }
    if (table_reference(expect->reference, expect->coordinate, expect->column, &pair)) {
        keys_error(&draft->keys, reference, "%s", status_text());
        return;
    }
    double first = pair.x[0], last = pair.x[pair.table.n_row - 1], begin = over_time ? 0.0 : scene->lower[0],
           end = over_time ? scene->until : scene->upper[0];
    if (first >= end || last <= begin)
        keys_error(&draft->keys, reference, "'%s' goes from %.6g to %.6g in '%s', outside of the %s, %.6g to %.6g",
                   expect->coordinate, first, last, expect->reference, over_time ? "run" : "domain", begin, end);
    table_done(&pair.table);
}

static void scene_expect_reference(struct draft *draft, struct scene_expect *expect, const struct keys_value *reference,
                                   bool over_time)
{
    bool word = scene_expect_word(reference->text);
    expect->reference = mem_text(word ? reference->text : scene_file(draft, reference));
    if (!word) scene_expect_table(draft, expect, reference, over_time);
}

/* Is a field, or the vector that it is a component of, in the snapshots? */
static bool scene_expect_is_written(const struct scene *scene, const char *name)
{
    size_t length = strlen(name), vector = length > 2 && name[length - 2] == '_' ? length - 2 : length;
    bool component = vector < length && name[length - 1] >= 'x' && name[length - 1] <= 'z';
    for (unsigned i = 0; i < scene->n_snapshot_field; i++) {
        const char *written = scene->snapshot_fields[i];
        if (!strcmp(written, name) || (component && strlen(written) == vector && !strncmp(written, name, vector)))
            return true;
    }
    return scene->n_snapshot_field == 0; /* then those that make sense: found out when they are written */
}

static void scene_expect_norm(struct draft *draft, struct scene_expect *expect, const struct keys_map *map)
{
    const struct keys_value *norm = keys_at(map, "norm"), *field = keys_at(map, "field"),
                            *reference = keys_at(map, "reference"), *column = keys_at(map, "column");
    if (!field->node) keys_error(&draft->keys, norm, "'field' is missing: what is compared with the reference");
    if (!reference->node)
        keys_error(&draft->keys, norm, "'reference' is missing: a CSV file, 'exact-riemann' or 'initial'");
    if (!field->given || !reference->given) return;
    char name[SCENE_NAME];
    bool over_time = scene_expect_is_column(draft->scene, field->text);
    if (!over_time) scene_field(draft, field, name);
    if (!over_time && !scene_expect_is_written(draft->scene, field->text)) {
        keys_error(&draft->keys, field, "'%s' is not among the fields of the snapshots", field->text);
        diag_help(draft->keys.diag, "add it to output.snapshots.fields");
    }
    expect->norm = scene_expect_text(norm);
    expect->field = mem_text(field->text);
    expect->column = mem_text(column->given ? column->text : field->text);
    expect->coordinate = scene_expect_text(keys_at(map, "coordinate"));
    if (!expect->coordinate) expect->coordinate = mem_text(over_time ? "t" : "x");
    scene_expect_reference(draft, expect, reference, over_time);
}

static void scene_expect_bounds(struct draft *draft, struct scene_expect *expect, const struct keys_map *map)
{
    const struct keys_value *equals = keys_at(map, "equals");
    expect->has_at_most = keys_at(map, "at-most")->given;
    expect->has_at_least = keys_at(map, "at-least")->given;
    expect->has_equals = equals->given;
    expect->at_most = keys_at(map, "at-most")->number;
    expect->at_least = keys_at(map, "at-least")->number;
    expect->equals = equals->number;
    expect->tolerance = keys_at(map, "tolerance")->number;
    expect->relative = keys_at(map, "relative")->number;
    bool bound =
        equals->node || keys_at(map, "at-most")->node || keys_at(map, "at-least")->node || keys_at(map, "order")->node;
    if (!bound) {
        diag_error(draft->keys.diag, &map->node->mark, "%s: nothing is demanded", map->path);
        diag_help(draft->keys.diag, "give 'at-most', 'at-least' or 'equals' with 'tolerance' or 'relative'");
    }
    if (equals->given && !keys_at(map, "tolerance")->node && !keys_at(map, "relative")->node)
        keys_error(&draft->keys, equals, "a 'tolerance' or 'relative' one is needed beside 'equals'");
}

static void scene_expect_read(struct draft *draft, struct scene_expect *expect, const struct keys_map *map)
{
    if (!map) return;
    const struct keys_value *value = keys_at(map, "value"), *norm = keys_at(map, "norm"),
                            *scale = keys_at(map, "scale");
    expect->line = map->node->mark.line;
    expect->label = scene_expect_text(keys_at(map, "label"));
    expect->scale = scale->given ? scale->number : 1.0;
    expect->order = keys_at(map, "order")->number;
    if (!value->node == !norm->node) {
        diag_error(draft->keys.diag, &map->node->mark, "%s: one of 'value' and 'norm' is needed", map->path);
        return;
    }
    if (value->node) scene_expect_value(draft, expect, value);
    if (norm->given) scene_expect_norm(draft, expect, map);
    scene_expect_bounds(draft, expect, map);
}

void scene_expect(struct draft *draft)
{
    const struct keys_value *list = keys_at(draft->root, "expect");
    struct scene *scene = draft->scene;
    scene->expects = mem_new(list->count + 1, sizeof *scene->expects);
    for (unsigned i = 0; i < list->count; i++)
        scene_expect_read(draft, &scene->expects[scene->n_expect++], list->list[i].map);
}
