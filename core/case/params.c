/* params.c - see params.h. Parameters are evaluated by depth-first search along the names
 * their expressions mention; a name that is met again while it is still open closes a cycle. */
#include "case/params.h"

#include "base/mem.h"
#include "base/status.h"
#include "base/text.h"
#include "case/unit.h"

#include <ctype.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { PARAMS_MOST = 1000 };

struct param {
    const char *name;
    const struct node *key;
    struct node *node;
    enum { PARAM_NEW, PARAM_OPEN, PARAM_DONE, PARAM_FAILED } state;
    double value;
    bool used; /* by anything */
    bool live; /* by a script that stays */
};

struct params {
    struct forest *forest;
    struct diag *diag;
    struct script_host *host;
    struct param *list;
    unsigned count;
};

struct params *params_new(struct forest *forest, struct diag *diag, struct script_host *host)
{
    struct params *params = mem_new(1, sizeof *params);
    *params = (struct params){.forest = forest, .diag = diag, .host = host};
    return params;
}

void params_free(struct params *params)
{
    if (!params) return;
    mem_free(params->list);
    mem_free(params);
}

static struct param *params_find(const struct params *params, const char *name)
{
    for (unsigned i = 0; i < params->count; i++)
        if (strcmp(params->list[i].name, name) == 0) return &params->list[i];
    return NULL;
}

bool params_has(const struct params *params, const char *name)
{
    return params_find(params, name) != NULL;
}

bool params_is_expression(const struct node *node)
{
    return node->kind == TREE_SCALAR && node->text[strspn(node->text, " \n")] == '=' &&
           node->text[strspn(node->text, " \n") + 1] != '=';
}

/* The text behind the "=". */
static const char *params_body(const char *text)
{
    text += strspn(text, " \n");
    return *text == '=' ? text + 1 : text;
}

/* Past a string, comment or number that begins here; the same place if none does. */
static const char *params_skip(const char *at)
{
    if (*at == '"' || *at == '\'') {
        char quote = *at++;
        while (*at && *at != quote) at += *at == '\\' && at[1] ? 2 : 1;
        return *at ? at + 1 : at;
    }
    if (at[0] == '-' && at[1] == '-') return at + strcspn(at, "\n");
    if (at[0] == '[' && at[1] == '[') {
        const char *end = strstr(at, "]]");
        return end ? end + 2 : at + strlen(at);
    }
    if (isdigit((unsigned char)*at))
        while (isalnum((unsigned char)*at) || *at == '.') at++;
    return at;
}

bool params_next(const char **at, char ret_name[static PARAMS_WORD])
{
    char before = ' ';
    while (**at) {
        const char *past = params_skip(*at);
        if (past != *at) {
            *at = past;
            before = ' ';
        } else if (isalpha((unsigned char)**at) || **at == '_') {
            size_t length = 0;
            while (isalnum((unsigned char)(*at)[length]) || (*at)[length] == '_') length++;
            snprintf(ret_name, PARAMS_WORD, "%.*s", (int)length, *at);
            *at += length;
            if (before != '.' && before != ':' && length < PARAMS_WORD) return true;
            before = ' ';
        } else {
            if (!isspace((unsigned char)**at)) before = **at;
            ++*at;
        }
    }
    return false;
}

static bool params_resolve(struct params *params, struct param *param);

/* Resolves the parameters that a text mentions; false if one of them has failed. */
static bool params_use(struct params *params, const char *text, bool live)
{
    char name[PARAMS_WORD];
    bool good = true;
    while (params_next(&text, name)) {
        struct param *param = params_find(params, name);
        if (!param) continue;
        param->used = true;
        param->live |= live;
        good &= params_resolve(params, param);
    }
    return good;
}

void params_keep(struct params *params, const char *text)
{
    params_use(params, text, true);
}

static bool params_listed(const char *name, const char *names)
{
    size_t length = strlen(name);
    for (const char *at = names; (at = strstr(at, name)) != NULL; at += length)
        if ((at == names || at[-1] == ',') && (at[length] == ',' || at[length] == '\0')) return true;
    return false;
}

bool params_mentions(const char *text, const char *names)
{
    char name[PARAMS_WORD];
    while (params_next(&text, name))
        if (params_listed(name, names)) return true;
    return false;
}

static bool params_known(const char *name, const char *arguments)
{
    static const char *const words[] = {"and", "or", "not",    "true",  "false",  "nil",   "function", "return",
                                        "end", "if", "then",   "else",  "elseif", "local", "for",      "while",
                                        "do",  "in", "repeat", "until", "break",  "goto",  NULL};
    for (unsigned i = 0; words[i]; i++)
        if (strcmp(words[i], name) == 0) return true;
    return params_listed(name, arguments);
}

/* Names that are nothing at all: better said by us, with a suggestion, than by Lua as "nil". */
static bool params_check_names(struct params *params, const struct node *node, const char *path, const char *arguments)
{
    const char *text = params_body(node->text), *names[PARAMS_MOST + 1];
    char name[PARAMS_WORD];
    for (unsigned i = 0; i < params->count; i++) names[i] = params->list[i].name;
    names[params->count] = NULL;
    while (params_next(&text, name)) {
        if (params_find(params, name) || params_known(name, arguments) || script_has(params->host, name)) continue;
        struct mark place =
            diag_within(&node->mark, node->text, (size_t)(text - node->text) - strlen(name), strlen(name));
        diag_error(params->diag, &place, "%s: '%s' is neither a parameter nor known to expressions", path, name);
        const char *nearest = text_nearest(name, names);
        struct unit unit;
        char bad[32];
        if (unit_parse(name, &unit, bad))
            diag_help(params->diag,
                      "no units inside expressions: give a number with its unit a name, 'parameters: {d: 10 %s}'",
                      name);
        else if (nearest) diag_help(params->diag, "did you mean '%s'?", nearest);
        else if (*arguments) diag_help(params->diag, "known here: %s, the case's parameters, math", arguments);
        else diag_help(params->diag, "give it under 'parameters:'");
        return false;
    }
    return true;
}

/* Records what Lua said about a text, without the place that stands before it already. */
static void params_complain(struct params *params, const struct mark *mark, const char *path, const char *text)
{
    const char *said = status_text();
    size_t name = strlen(mark->source->name);
    struct mark place = *mark;
    if (strncmp(said, mark->source->name, name) == 0 && said[name] == ':') {
        int line = atoi(said + name + 1);
        if (line != place.line) place = (struct mark){mark->source, line, 1, 1};
        said += name + 1 + strspn(said + name + 1, "0123456789:");
    }
    said += strspn(said, " ");
    diag_error(params->diag, &place, "%s: %s", path, said);
    unsigned open = 0, closed = 0;
    for (const char *at = text; *at; at++) {
        open += *at == '(';
        closed += *at == ')';
    }
    if (open > closed && strchr(text, '\n') == NULL)
        diag_help(params->diag, "inside [ ] and { } a comma ends a value: quote the expression, \"= ...\"");
}

bool params_evaluate(struct params *params, const struct node *node, const char *path, double *ret_value)
{
    const char *text = params_body(node->text);
    if (!params_check_names(params, node, path, "") || !params_use(params, text, false)) return false;
    if (script_evaluate(params->host, text, node->mark.source->name, node->mark.line, ret_value)) {
        params_complain(params, &node->mark, path, text);
        return false;
    }
    return true;
}

bool params_compile(struct params *params, const struct node *node, const char *path, const char *arguments,
                    const struct script **ret_script)
{
    const char *text = params_body(node->text);
    if (!params_check_names(params, node, path, arguments) || !params_use(params, text, true)) return false;
    if (script_compile(params->host, text, arguments, node->mark.source->name, node->mark.line, ret_script)) {
        params_complain(params, &node->mark, path, text);
        return false;
    }
    return true;
}

bool params_compile_chunk(struct params *params, const struct mark *where, const char *path, const char *text,
                          const struct script **ret_script)
{
    if (!params_use(params, text, true)) return false;
    if (script_compile_function(params->host, text, where->source->name, where->line, ret_script)) {
        params_complain(params, where, path, text);
        return false;
    }
    return true;
}

static void params_cycle(struct params *params, const struct param *param)
{
    diag_error(params->diag, &param->node->mark, "parameter '%s' depends on itself", param->name);
    for (unsigned i = 0; i < params->count; i++)
        if (params->list[i].state == PARAM_OPEN && &params->list[i] != param)
            diag_help(params->diag, "the circle goes through '%s' in line %d", params->list[i].name,
                      params->list[i].key->mark.line);
}

static bool params_number(struct params *params, struct param *param)
{
    struct unit unit;
    char bad[32];
    enum unit_fault fault = UNIT_NO_NUMBER;
    const struct node *node = param->node;
    if (node->kind == TREE_SCALAR) fault = unit_quantity(node->text, &param->value, &unit, bad);
    if (fault == UNIT_FINE && isfinite(param->value)) return true;
    if (fault == UNIT_FINE)
        diag_error(params->diag, &node->mark, "parameters.%s: %s is too large", param->name, node->text);
    else if (fault == UNIT_UNKNOWN)
        diag_error(params->diag, &node->mark, "parameters.%s: '%s' is no unit that is known", param->name, bad);
    else
        diag_error(params->diag, &node->mark, "parameters.%s: a number is needed, not %s", param->name,
                   tree_describe(node));
    if (fault == UNIT_UNKNOWN) {
        char guess[32];
        unit_guess(bad, NULL, guess);
        if (guess[0]) diag_help(params->diag, "did you mean '%s'?", guess);
    } else if (fault != UNIT_FINE)
        diag_help(params->diag, "a number may carry a unit, '10 um', or be an expression, '= 1.1 * R0'");
    return false;
}

/* Brings one parameter to its number. */
static bool params_resolve(struct params *params, struct param *param)
{
    if (param->state == PARAM_OPEN) params_cycle(params, param);
    if (param->state != PARAM_NEW) return param->state == PARAM_DONE;
    param->state = PARAM_OPEN;
    const char *path = tree_print(params->forest, "parameters.%s", param->name);
    bool good = params_is_expression(param->node) ? params_evaluate(params, param->node, path, &param->value)
                                                  : params_number(params, param);
    param->state = good ? PARAM_DONE : PARAM_FAILED;
    if (good) script_set_number(params->host, param->name, param->value);
    return good;
}

/* Does a name mean something that a parameter must not hide? Functions of math without "math." may be hidden. */
static bool params_taken(const struct params *params, const char *name)
{
    static const char *const open[] = {"abs", "sqrt", "exp", "log", "min", "max"};
    for (size_t i = 0; i < sizeof open / sizeof *open; i++)
        if (strcmp(open[i], name) == 0) return false;
    return script_has(params->host, name);
}

static bool params_is_free(struct params *params, const struct node *key)
{
    bool good = text_is_identifier(key->text) && strlen(key->text) < PARAMS_WORD;
    bool taken = good && (params_known(key->text, PARAMS_FIELD) || params_taken(params, key->text));
    if (good && !taken) return true;
    diag_error(params->diag, &key->mark,
               taken ? "parameters: '%s' already means something in expressions"
                     : "parameters: '%s' is no identifier (letters, digits and _)",
               key->text);
    return false;
}

void params_read(struct params *params, struct node *map)
{
    if (!map || map->kind != TREE_MAP) return; /* the wrong kind is reported with the other keys */
    if (map->count > PARAMS_MOST) {
        diag_error(params->diag, &map->mark, "parameters: more than %d", PARAMS_MOST);
        return;
    }
    params->list = mem_new(map->count, sizeof *params->list);
    for (unsigned i = 0; i < map->count; i++) {
        if (!params_is_free(params, map->keys[i])) continue;
        params->list[params->count++] =
            (struct param){.name = map->keys[i]->text, .key = map->keys[i], .node = map->items[i]};
    }
    for (unsigned i = 0; i < params->count; i++) {
        struct param *param = &params->list[i];
        if (!params_resolve(params, param)) continue;
        struct text number = {0};
        text_double(&number, param->value);
        param->node->text = tree_print(params->forest, "%s", number.at);
        param->node->style = TREE_PLAIN;
        text_done(&number);
    }
}

void params_spare(struct params *params, const struct node *node)
{
    char name[PARAMS_WORD];
    if (!node) return;
    for (unsigned i = 0; i < node->count; i++) params_spare(params, node->items[i]);
    for (const char *text = node->kind == TREE_SCALAR ? node->text : ""; params_next(&text, name);) {
        struct param *param = params_find(params, name);
        if (param) param->used = true;
    }
}

void params_warn_unused(struct params *params)
{
    for (unsigned i = 0; i < params->count; i++)
        if (!params->list[i].used)
            diag_warn(params->diag, &params->list[i].key->mark, "parameter '%s' is not used", params->list[i].name);
}

void params_prune(struct params *params, struct node *map)
{
    if (!map) return;
    for (unsigned i = map->count; i-- > 0;) {
        const struct param *param = params_find(params, map->keys[i]->text);
        if (!param || !param->live) tree_remove(map, i);
    }
}
