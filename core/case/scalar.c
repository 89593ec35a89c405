/* scalar.c - see scalar.h. */
#include "case/scalar.h"

#include "base/text.h"

#include <math.h>
#include <string.h>

const char *const *scalar_choices(struct forest *forest, const char *choices)
{
    unsigned count = 1;
    for (const char *at = choices; *at; at++) count += *at == '|';
    const char **list = tree_take(forest, (count + 1) * sizeof *list);
    for (unsigned i = 0; i < count; i++) {
        size_t length = strcspn(choices, "|");
        list[i] = tree_print(forest, "%.*s", (int)length, choices);
        choices += length + (choices[length] == '|');
    }
    return list;
}

const char *scalar_number(struct forest *forest, double value)
{
    struct text text = {0};
    text_double(&text, value);
    const char *exponent = strchr(text.at, 'e');
    const char *kept;
    if (exponent && fabs(value) >= 1 && fabs(value) < 1e7) kept = tree_print(forest, "%.0f", value);
    else if (exponent && !strchr(text.at, '.')) /* 1e-05 is a text to YAML 1.1 readers, 1.0e-05 a number to all */
        kept = tree_print(forest, "%.*s.0%s", (int)(exponent - text.at), text.at, exponent);
    else kept = tree_print(forest, "%s", text.at);
    text_done(&text);
    return kept;
}

/* The dimension of a key; a pure number if it has no unit. */
static struct unit scalar_unit(const struct key *key)
{
    struct unit unit;
    char bad[32];
    if (!unit_parse(key->unit ? key->unit : "", &unit, bad)) unit = (struct unit){.factor = 1};
    return unit;
}

const char *scalar_wanted(struct forest *forest, const struct key *key)
{
    char words[80];
    struct unit unit = scalar_unit(key);
    switch (key->type) {
    case KEYS_NUMBER:
    case KEYS_PARAMETER:
    case KEYS_VALUE: return key->unit ? tree_print(forest, "%s", unit_kind(&unit, words, sizeof words)) : "a number";
    case KEYS_INTEGER: return "an integer";
    case KEYS_FLAG: return "true or false";
    case KEYS_NAME: return "an identifier (letters, digits and _)";
    case KEYS_CHOICE: return "a word";
    case KEYS_EVERY: return "a time or a number of steps ('20 ns', '10 steps')";
    case KEYS_FIELD: return "the name of a field or an expression of fields";
    case KEYS_SECTION: return "a map of keys";
    case KEYS_SCRIPT: return "an expression or a function in Lua";
    default: return "a text";
    }
}

static void scalar_refuse(struct keys *keys, const struct keys_value *value)
{
    const struct node *node = value->node;
    if (tree_is_null(node))
        keys_error(keys, value, "the value is missing; %s is needed", scalar_wanted(keys->forest, value->key));
    else keys_error(keys, value, "%s is needed, not %s", scalar_wanted(keys->forest, value->key), tree_describe(node));
}

static void scalar_comma(struct keys *keys)
{
    diag_help(keys->diag, "the decimal sign is a point, and there are no separators of thousands");
}

/* Why a text is no quantity. */
static void scalar_malformed(struct keys *keys, const struct keys_value *value)
{
    const char *text = value->node->text;
    scalar_refuse(keys, value);
    double number;
    struct unit unit;
    char bad[32];
    if (params_has(keys->params, text)) diag_help(keys->diag, "an expression begins with '=': write '= %s'", text);
    else if (text[strspn(text, "+-")] == '0' && text_number(text, &number) == 0)
        diag_help(keys->diag, "a number has no leading zeros");
    else if (strchr(text, ',')) scalar_comma(keys);
    else if (strpbrk(text, "+*/()") && unit_quantity(text, &number, &unit, bad) == UNIT_NO_NUMBER)
        diag_help(keys->diag, "an expression begins with '=': write '= %s'", text);
    else if (strpbrk(text, "+*/("))
        diag_help(keys->diag, "a unit looks like 'kg/m3' or 'J/kg/K'; an expression begins with '=': '= %s'", text);
}

static void scalar_unit_unknown(struct keys *keys, const struct keys_value *value, const struct unit *wanted,
                                const char *bad)
{
    char guess[32];
    const char *text = value->node->text;
    unit_guess(bad, wanted, guess);
    keys_error(keys, value, "'%s' in '%s' is no unit that is known", bad, text);
    if (strchr(text, ',')) scalar_comma(keys);
    else if (guess[0]) diag_help(keys->diag, "did you mean '%s'?", guess);
    else if (params_has(keys->params, bad)) diag_help(keys->diag, "an expression begins with '=': write '= %s'", text);
    else if (unit_examples(wanted)) diag_help(keys->diag, "units that would do: %s", unit_examples(wanted));
}

/* A number with or without its unit, in SI. */
static bool scalar_quantity(struct keys *keys, const struct keys_value *value, double *ret_value)
{
    struct unit unit, wanted = scalar_unit(value->key);
    char bad[32], words[80], words_wanted[80];
    const char *text = value->node->text;
    enum unit_fault fault = unit_quantity(text, ret_value, &unit, bad);
    double plain;
    bool bare = fault == UNIT_FINE && text[text_number(text, &plain)] == '\0';
    if (fault == UNIT_UNKNOWN) scalar_unit_unknown(keys, value, &wanted, bad);
    else if (fault != UNIT_FINE) scalar_malformed(keys, value);
    else if (!bare && (value->key->unit || value->key->type == KEYS_INTEGER) && !unit_same(&unit, &wanted)) {
        keys_error(keys, value, "'%s' is %s, but %s is needed", text, unit_kind(&unit, words, sizeof words),
                   unit_kind(&wanted, words_wanted, sizeof words_wanted));
        if (unit_examples(&wanted)) diag_help(keys->diag, "units that would do: %s", unit_examples(&wanted));
    } else return true;
    return false;
}

static bool scalar_in_range(struct keys *keys, const struct keys_value *value, double number)
{
    const struct key *key = value->key;
    const char *unit = key->unit && strcmp(key->unit, "1") != 0 ? key->unit : "";
    const char *gap = *unit ? " " : "";
    bool bounded = key->min != 0 || key->max != 0;
    if (isfinite(number) && (!bounded || (number >= key->min && number <= key->max))) return true;
    const char *given = scalar_number(keys->forest, number);
    if (!isfinite(number)) keys_error(keys, value, "the number is too large");
    else if (key->min == key->max)
        keys_error(keys, value, "%s is not possible, only %s", given, scalar_number(keys->forest, key->min));
    else if (number < key->min && key->min == KEYS_POSITIVE)
        keys_error(keys, value, "%s%s%s is not above 0", given, gap, unit);
    else if (key->max == KEYS_MOST)
        keys_error(keys, value, "%s%s%s is less than %s, the least allowed", given, gap, unit,
                   scalar_number(keys->forest, key->min));
    else if (key->min == -KEYS_MOST)
        keys_error(keys, value, "%s%s%s is more than %s, the most allowed", given, gap, unit,
                   scalar_number(keys->forest, key->max));
    else
        keys_error(keys, value, "%s%s%s is outside %s to %s%s%s", given, gap, unit,
                   key->min == KEYS_POSITIVE ? "0" : scalar_number(keys->forest, key->min),
                   scalar_number(keys->forest, key->max), gap, unit);
    return false;
}

/* A constant: number, number with unit, or expression over the parameters. */
static bool scalar_constant(struct keys *keys, const struct keys_value *value, double *ret_value)
{
    bool good = params_is_expression(value->node) ? params_evaluate(keys->params, value->node, value->path, ret_value)
                                                  : scalar_quantity(keys, value, ret_value);
    return good && scalar_in_range(keys, value, *ret_value);
}

static void scalar_rewrite(struct keys *keys, const struct keys_value *value, const char *text)
{
    value->node->text = tree_print(keys->forest, "%s", text);
    value->node->style = TREE_PLAIN;
}

/* Keeps how the number was written, before it is rewritten in SI. */
static void scalar_keep_unit(struct keys_value *value)
{
    const char *text = value->node->text;
    char bad[32];
    double number;
    value->bare = params_is_expression(value->node) || text[text_number(text, &number)] == '\0';
    if (!value->bare) unit_quantity(text, &number, &value->unit, bad);
}

static void scalar_read_number(struct keys *keys, struct keys_value *value)
{
    scalar_keep_unit(value);
    value->given = scalar_constant(keys, value, &value->number);
    if (value->given) scalar_rewrite(keys, value, scalar_number(keys->forest, value->number));
}

static void scalar_read_integer(struct keys *keys, struct keys_value *value)
{
    if (!scalar_constant(keys, value, &value->number)) return;
    value->integer = fabs(value->number) < 9e15 ? (long)value->number : 0;
    value->given = (double)value->integer == value->number;
    if (value->given) scalar_rewrite(keys, value, tree_print(keys->forest, "%ld", value->integer));
    else keys_error(keys, value, "an integer is needed, not %s", scalar_number(keys->forest, value->number));
}

/* An expression that uses none of x, y, z, r, t is a number at once. */
static void scalar_read_value(struct keys *keys, struct keys_value *value)
{
    if (params_is_expression(value->node) && params_mentions(value->node->text, PARAMS_FIELD))
        value->given = params_compile(keys->params, value->node, value->path, PARAMS_FIELD, &value->script);
    else scalar_read_number(keys, value);
}

static void scalar_read_every(struct keys *keys, struct keys_value *value)
{
    double number;
    const char *text = value->node->text;
    size_t read = text_number(text, &number);
    const char *unit = text + read + strspn(text + read, " ");
    if (!read || (strcmp(unit, "step") != 0 && strcmp(unit, "steps") != 0)) {
        scalar_read_number(keys, value);
        return;
    }
    value->integer = number >= 1 && number < 9e15 ? (long)number : 0;
    value->given = value->integer > 0 && (double)value->integer == number;
    if (!value->given) keys_error(keys, value, "'%s' is no number of steps: 1 or more, and whole", text);
    else
        scalar_rewrite(keys, value,
                       tree_print(keys->forest, "%ld step%s", value->integer, value->integer == 1 ? "" : "s"));
}

static void scalar_read_choice(struct keys *keys, struct keys_value *value, const char *const *choices)
{
    if (!choices) choices = scalar_choices(keys->forest, value->key->choices);
    value->text = value->node->text;
    for (long i = 0; choices[i]; i++) {
        if (strcmp(choices[i], value->text) != 0) continue;
        value->integer = i;
        value->given = true;
        return;
    }
    keys_error(keys, value, "there is no '%s' here", value->text);
    if (choices[0]) diag_suggest(keys->diag, value->text, choices);
    else diag_help(keys->diag, "no modules of this kind were found: look at BULLA_MODULE_PATH and 'bulla modules'");
}

static void scalar_read_flag(struct keys *keys, struct keys_value *value)
{
    bool flag;
    value->given = tree_flag(value->node, &flag);
    if (value->given) value->integer = flag;
    else scalar_refuse(keys, value);
}

static void scalar_read_text(struct keys *keys, struct keys_value *value)
{
    value->text = value->node->text;
    value->given = value->key->type != KEYS_NAME || text_is_identifier(value->text);
    if (!value->given) scalar_refuse(keys, value);
}

/* An expression in the place of a field, '= ...', or one with a name, {NAME: '= ...'}. */
static bool scalar_is_formula(const struct node *node)
{
    if (node->kind == TREE_MAP && node->count == 1) node = node->items[0];
    return params_is_expression(node);
}

static void scalar_read_formula(struct keys_value *value)
{
    const struct node *node = value->node;
    value->text = node->kind == TREE_MAP ? node->items[0]->text : node->text;
    value->given = true;
}

void scalar_read(struct keys *keys, struct keys_value *value, const char *const *choices)
{
    enum keys_type type = value->key->type;
    bool words = type == KEYS_TEXT || type == KEYS_FIELD || type == KEYS_NAME || type == KEYS_CHOICE;
    bool empty = value->node->kind == TREE_SCALAR && tree_is_null(value->node);
    if (type == KEYS_FIELD && scalar_is_formula(value->node)) {
        scalar_read_formula(value);
        return;
    }
    if (value->node->kind != TREE_SCALAR || empty) {
        scalar_refuse(keys, value);
        return;
    }
    if (words && value->node->style == TREE_PLAIN && params_is_expression(value->node)) {
        keys_error(keys, value, "an expression gives a number, but %s is needed",
                   scalar_wanted(keys->forest, value->key));
        return;
    }
    switch (type) {
    case KEYS_NUMBER:
    case KEYS_PARAMETER: scalar_read_number(keys, value); break;
    case KEYS_INTEGER: scalar_read_integer(keys, value); break;
    case KEYS_VALUE: scalar_read_value(keys, value); break;
    case KEYS_EVERY: scalar_read_every(keys, value); break;
    case KEYS_FLAG: scalar_read_flag(keys, value); break;
    case KEYS_CHOICE: scalar_read_choice(keys, value, choices); break;
    default: scalar_read_text(keys, value); break;
    }
}
