/* scene_formula.c - expressions of fields: in the place of the name of a field, '= pressure * velocity_x'.
 *
 * In lists they have a name, {power: '= pressure * velocity_x'}, by which files call them. */
#include "case/scene_draft.h"

#include "base/mem.h"
#include "base/status.h"
#include "base/text.h"

#include <string.h>

bool scene_formula_argument(struct draft *draft, const char *name)
{
    if (strlen(name) == 1 && strchr("xyzt", *name)) return true;
    const struct scene_field *field = scene_field_find(draft, name);
    return field && !(field->is & SCENE_FIELD_VECTOR) && strcmp(name, "rank") != 0;
}

void scene_formula_help(struct draft *draft)
{
    const char *list = "x, y, z, t";
    for (const struct scene_field *field = scene_field_all(draft); field->name; field++)
        if (scene_formula_argument(draft, field->name))
            list = tree_print(draft->keys.forest, "%s, %s", list, field->name);
    diag_help(draft->keys.diag, "it may use: %s", list);
}

bool scene_formula_use(struct draft *draft, const struct keys_value *value, const char *name, char (*uses)[SCENE_NAME],
                       unsigned *n_use)
{
    for (unsigned i = 0; i < *n_use; i++)
        if (strcmp(uses[i], name) == 0) return true;
    if (*n_use == SCRIPT_ARGUMENTS) {
        keys_error(&draft->keys, value, "more than %d arguments", SCRIPT_ARGUMENTS);
        return false;
    }
    snprintf(uses[(*n_use)++], SCENE_NAME, "%s", name);
    return true;
}

bool scene_formula_compile(struct draft *draft, const struct keys_value *value, const struct node *node,
                           char (*uses)[SCENE_NAME], unsigned *ret_n_use, const struct script **ret_script)
{
    const char *list = "", *text = node->text;
    char name[PARAMS_WORD];
    while (params_next(&text, name))
        if (scene_formula_argument(draft, name) && !scene_formula_use(draft, value, name, uses, ret_n_use))
            return false;
    for (unsigned i = 0; i < *ret_n_use; i++)
        list = tree_print(draft->keys.forest, "%s%s%s", list, i ? "," : "", uses[i]);
    if (params_compile(draft->keys.params, node, value->path, list, ret_script)) return true;
    scene_formula_help(draft);
    return false;
}

bool scene_formula_is(const struct keys_value *value)
{
    return value->node->kind == TREE_MAP || params_is_expression(value->node);
}

/* Does it give numbers? Asked with ones: what is not a number at all shows whatever the fields are. */
static bool scene_formula_try(struct draft *draft, const struct keys_value *value, const struct scene_formula *formula)
{
    double one = 1.0, out;
    const double *in[SCRIPT_ARGUMENTS];
    for (unsigned i = 0; i < formula->n_use; i++) in[i] = &one;
    if (!script_row(formula->script, 1, in, formula->n_use, &out)) return true;
    keys_error(&draft->keys, value, "%s", status_text());
    return false;
}

static bool scene_formula_named(struct draft *draft, const struct keys_value *value, const char *name)
{
    if (!text_is_identifier(name) || strlen(name) >= SCENE_NAME)
        keys_error(&draft->keys, value, "the name of an expression is an identifier (letters, digits and _), not '%s'",
                   name);
    else if (scene_field_find(draft, name) || scene_peak_is(name))
        keys_error(&draft->keys, value, "'%s' is a field already: call the expression something else", name);
    else return true;
    return false;
}

/* The expression of that name, if there is one. */
static struct scene_formula *scene_formula_find(struct scene_output *output, const char *name)
{
    for (unsigned i = 0; i < output->n_formula; i++)
        if (strcmp(output->formulas[i].name, name) == 0) return &output->formulas[i];
    return NULL;
}

static bool scene_formula_add(struct draft *draft, const struct keys_value *value, const struct node *node,
                              const char *name)
{
    struct scene_output *output = &draft->scene->output;
    struct scene_formula formula = {.uses = mem_new(SCRIPT_ARGUMENTS, sizeof *formula.uses)};
    bool good = scene_formula_compile(draft, value, node, formula.uses, &formula.n_use, &formula.script);
    if (!good || !scene_formula_try(draft, value, &formula)) {
        mem_free(formula.uses);
        return false;
    }
    snprintf(formula.name, SCENE_NAME, "%s", name);
    formula.text = mem_text(node->text);
    output->formulas = mem_grow(output->formulas, output->n_formula, output->n_formula + 1, sizeof *output->formulas);
    output->formulas[output->n_formula++] = formula;
    return true;
}

bool scene_formula(struct draft *draft, const struct keys_value *value, const char *name, char ret_name[SCENE_NAME])
{
    const struct node *node = value->node;
    bool named = node->kind == TREE_MAP;
    if (!named && !name) {
        keys_error(&draft->keys, value, "an expression in a list needs a name");
        diag_help(draft->keys.diag, "write {NAME: '%s'}", node->text);
        return false;
    }
    if (named) name = node->keys[0]->text;
    if (named && !scene_formula_named(draft, value, name)) return false;
    if (named) node = node->items[0];
    else name = tree_print(draft->keys.forest, "=%.60s", name); /* no name that a list could have */
    const struct scene_formula *old = scene_formula_find(&draft->scene->output, name);
    if (old && strcmp(old->text, node->text) != 0) {
        keys_error(&draft->keys, value, "'%s' is another expression already: '%s'", name, old->text);
        return false;
    }
    if (!old && !scene_formula_add(draft, value, node, name)) return false;
    snprintf(ret_name, SCENE_NAME, "%s", name);
    return true;
}
