/* scene_expect.c - what a case says its result must satisfy. */
#include "case/scene_draft.h"

#include "base/mem.h"
#include "base/status.h"
#include "case/scene_columns.h"
#include "case/table.h"

#include <stdio.h>
#include <string.h>

static const struct key scene_expect_rows[] = {
    {.name = "value",
     .type = KEYS_TREE,
     .doc = "Lua over history and probe columns, with the parameters: `min(V)/first(V)`, `max(wall.pressure)`."},
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
     .doc = "CSV file, relative to this file; or `exact-riemann`, `initial`, or `mirror-x`, `-y`, `-z`: the same "
            "field about the middle of the domain."},
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

/* Records what is wrong with an expression; a parameter that has no value is an error of its own, recorded already. */
static void scene_expect_complain(struct draft *draft, const struct keys_value *value, size_t head,
                                  const struct formula_fault *fault)
{
    const struct node *node = value->node;
    char *word = mem_text_n(node->text + head + fault->at, fault->length);
    struct mark place = diag_within(&node->mark, node->text, head + fault->at, fault->length);
    if (!params_has(draft->keys.params, word) || !diag_errors(draft->keys.diag)) {
        diag_error(draft->keys.diag, &place, "%s: %s", value->path, fault->said);
        if (fault->help) diag_help(draft->keys.diag, "%s", fault->help);
    }
    mem_free(word);
}

/* Parameters that the expression uses stay in the resolved case. */
static void scene_expect_value(struct draft *draft, struct formula *plan, struct scene_expect *expect,
                               const struct keys_value *value)
{
    if (value->node->kind != TREE_SCALAR || tree_is_null(value->node)) {
        keys_error(&draft->keys, value, "an expression is needed, not %s", tree_describe(value->node));
        return;
    }
    const char *text = value->node->text;
    size_t head = strspn(text, " \n");
    struct formula_fault fault = {0};
    double number;
    if (text[head] == '=') head++;
    expect->value = mem_text(text + head);
    if (formula_value(plan, expect->value, &number, &fault)) scene_expect_complain(draft, value, head, &fault);
    formula_fault_done(&fault);
    params_keep(draft->keys.params, expect->value);
}

static bool scene_expect_word(const char *name)
{
    static const char *const words[] = {"exact-riemann", "initial", "mirror-x", "mirror-y", "mirror-z"};
    for (size_t i = 0; i < sizeof words / sizeof *words; i++)
        if (strcmp(name, words[i]) == 0) return true;
    return false;
}

/* What would be found only after the run, and what would not be found at all. */
static void scene_expect_table(struct draft *draft, const struct scene_expect *expect,
                               const struct keys_value *reference, bool over_time)
{
    const struct scene *scene = draft->scene;
    struct table_pair pair;
    if (!over_time && scene->domain.dim > 1) {
        keys_error(&draft->keys, reference, "a CSV profile can be compared with fields of 1D scenes only");
        return;
    }
    if (table_reference(expect->reference, expect->coordinate, expect->column, &pair)) {
        keys_error(&draft->keys, reference, "%s", status_text());
        return;
    }
    double first = pair.x[0], last = pair.x[pair.table.n_row - 1], begin = over_time ? 0.0 : scene->domain.lower[0],
           end = over_time ? scene->run.until : scene->domain.upper[0];
    if (first >= end || last <= begin)
        keys_error(&draft->keys, reference, "'%s' goes from %.6g to %.6g in '%s', outside of the %s, %.6g to %.6g",
                   expect->coordinate, first, last, expect->reference, over_time ? "run" : "domain", begin, end);
    table_done(&pair.table);
}

static void scene_expect_reference(struct draft *draft, struct scene_expect *expect, const struct keys_value *reference,
                                   bool over_time)
{
    bool word = scene_expect_word(reference->text), mirror = strncmp(reference->text, "mirror-", 7) == 0;
    expect->reference = mem_text(word ? reference->text : scene_file(draft, reference));
    if (!word) scene_expect_table(draft, expect, reference, over_time);
    if (word && mirror && (over_time || reference->text[7] - 'x' >= draft->scene->domain.dim))
        keys_error(&draft->keys, reference, "'%s' needs a field of the snapshots and that axis", reference->text);
}

/* Is a field, or the vector that it is a component of, in the snapshots? */
static bool scene_expect_is_written(const struct scene *scene, const char *name)
{
    size_t length = strlen(name), vector = length > 2 && name[length - 2] == '_' ? length - 2 : length;
    bool component = vector < length && name[length - 1] >= 'x' && name[length - 1] <= 'z';
    for (unsigned i = 0; i < scene->output.n_snapshot_field; i++) {
        const char *written = scene->output.snapshot_fields[i];
        if (!strcmp(written, name) || (component && strlen(written) == vector && !strncmp(written, name, vector)))
            return true;
    }
    return scene->output.n_snapshot_field == 0; /* then those that make sense: found out when they are written */
}

static void scene_expect_norm(struct draft *draft, const struct formula *plan, struct scene_expect *expect,
                              const struct keys_map *map)
{
    const struct keys_value *norm = keys_at(map, "norm"), *field = keys_at(map, "field"),
                            *reference = keys_at(map, "reference"), *column = keys_at(map, "column");
    if (!field->node) keys_error(&draft->keys, norm, "'field' is missing: what is compared with the reference");
    if (!reference->node)
        keys_error(&draft->keys, norm, "'reference' is missing: a CSV file, 'exact-riemann', 'initial' or 'mirror-x'");
    if (!field->given || !reference->given) return;
    char name[SCENE_NAME];
    struct trace trace;
    bool over_time = formula_column(plan, field->text, &trace);
    if (!over_time) scene_field_name(draft, field, name);
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

static void scene_expect_read(struct draft *draft, struct formula *plan, struct scene_expect *expect,
                              const struct keys_map *map)
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
    if (value->node) scene_expect_value(draft, plan, expect, value);
    if (norm->given) scene_expect_norm(draft, plan, expect, map);
    scene_expect_bounds(draft, expect, map);
}

void scene_expect(struct draft *draft)
{
    const struct keys_value *list = keys_at(draft->root, "expect");
    struct scene *scene = draft->scene;
    struct formula *plan = scene_columns_plan(scene);
    scene->expects = mem_new(list->count + 1, sizeof *scene->expects);
    for (unsigned i = 0; i < list->count; i++)
        scene_expect_read(draft, plan, &scene->expects[scene->n_expect++], list->list[i].map);
    formula_free(plan);
}
