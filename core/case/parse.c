/* parse.c - see parse.h. One function per kind of event, recursion along the nesting (bounded
 * by PARSE_DEPTH). An alias is expanded by copying; its nodes count against the same budget as
 * written ones, so a small text cannot grow into a large tree. Mistakes in the meaning
 * (duplicate keys, tags) are recorded and reading goes on; a mistake in the syntax ends it. */
#include "case/parse.h"

#include "base/mem.h"

#include <string.h>
#include <yaml.h>

struct parse_anchor {
    char *name;
    struct node *node;
    unsigned nodes; /* in the tree below it */
};

struct parse {
    yaml_parser_t yaml;
    struct forest *forest;
    struct diag *diag;
    const struct source *source;
    struct parse_anchor anchors[PARSE_ALIASES];
    unsigned n_anchor, n_alias, n_node;
    bool ended; /* an error after which nothing can be read */
};

static struct mark parse_mark(const struct parse *parse, yaml_mark_t from, yaml_mark_t to)
{
    int width = to.line == from.line && to.column > from.column ? (int)(to.column - from.column) : 1;
    return (struct mark){parse->source, (int)from.line + 1, (int)from.column + 1, width};
}

static void parse_stop(struct parse *parse, const yaml_event_t *event, const char *what, unsigned most)
{
    struct mark mark = parse_mark(parse, event->start_mark, event->start_mark);
    if (!parse->ended) diag_error(parse->diag, &mark, "%s (more than %u)", what, most);
    parse->ended = true;
}

/* libyaml gives bytes that are no UTF-8 by their offset only. */
static struct mark parse_mark_of_byte(const struct parse *parse, size_t offset)
{
    struct mark mark = {parse->source, 1, 1, 1};
    for (size_t i = 0; i < offset && i < parse->source->length; i++) {
        char byte = parse->source->text[i];
        if (byte == '\n') {
            mark.line++;
            mark.column = 1;
        } else if (((unsigned char)byte & 0xc0) != 0x80) mark.column++;
    }
    return mark;
}

/* The first byte of the line that a mark is on. */
static const char *parse_line(const struct parse *parse, int number)
{
    const char *line = parse->source->text;
    for (int i = 1; i < number; i++) {
        const char *next = strchr(line, '\n');
        if (!next) break;
        line = next + 1;
    }
    return line;
}

/* What people usually did when libyaml says this. */
static void parse_hint(struct parse *parse, const struct mark *mark)
{
    const char *problem = parse->yaml.problem, *context = parse->yaml.context ? parse->yaml.context : "";
    const char *line = parse_line(parse, mark->line);
    size_t blanks = strspn(line, " \t");
    if (memchr(line, '\t', blanks)) diag_help(parse->diag, "this line is indented with a tab; YAML wants blanks");
    else if (strstr(problem, "mapping values are not allowed"))
        diag_help(parse->diag, "is the indentation right? A text that contains ': ' must be quoted");
    else if (strstr(problem, "could not find expected ':'"))
        diag_help(parse->diag, "a key needs a colon and a blank after it, as in 'gamma: 1.4'");
    else if (strstr(context, "block mapping") && mark->column > (int)blanks + 1)
        diag_help(parse->diag, "the value before this place is complete already: are the quotes and brackets right?");
    else if (strstr(context, "block mapping") || strstr(context, "block collection"))
        diag_help(parse->diag,
                  "this line's indentation fits nothing above it; the block that is open began in line %zu",
                  parse->yaml.context_mark.line + 1);
    else if (strstr(context, "flow"))
        diag_help(parse->diag, "the bracket opened in line %zu is not closed, or a comma is missing",
                  parse->yaml.context_mark.line + 1);
    else if (strstr(context, "quoted scalar"))
        diag_help(parse->diag, "the quote opened in line %zu is not closed", parse->yaml.context_mark.line + 1);
    else if (strstr(problem, "cannot start any token"))
        diag_help(parse->diag, "a text that starts with this character must be quoted");
}

static void parse_syntax(struct parse *parse)
{
    const yaml_parser_t *yaml = &parse->yaml;
    if (parse->ended) return;
    parse->ended = true;
    if (yaml->error == YAML_READER_ERROR) {
        struct mark mark = parse_mark_of_byte(parse, yaml->problem_offset);
        diag_error(parse->diag, &mark, "not a text in UTF-8: %s", yaml->problem);
        return;
    }
    struct mark mark = parse_mark(parse, yaml->problem_mark, yaml->problem_mark);
    if (!yaml->problem) {
        diag_error(parse->diag, &mark, "the YAML text cannot be read");
        return;
    }
    diag_error(parse->diag, &mark, "%s%s%s", yaml->context ? yaml->context : "", yaml->context ? ": " : "",
               yaml->problem);
    parse_hint(parse, &mark);
}

/* The next event; false at an error (then there is nothing to delete). */
static bool parse_next(struct parse *parse, yaml_event_t *event)
{
    if (!parse->ended && yaml_parser_parse(&parse->yaml, event)) return true;
    parse_syntax(parse);
    return false;
}

static unsigned parse_size(const struct node *node)
{
    unsigned size = 1;
    for (unsigned i = 0; i < node->count; i++) size += parse_size(node->items[i]) + (node->kind == TREE_MAP);
    return size;
}

static void parse_count(struct parse *parse, const yaml_event_t *event, unsigned nodes)
{
    parse->n_node += nodes;
    if (parse->n_node > PARSE_NODES) parse_stop(parse, event, "the text has too many values", PARSE_NODES);
}

static void parse_anchor_add(struct parse *parse, const yaml_event_t *event, const yaml_char_t *name, struct node *node)
{
    if (!name || parse->ended) return;
    if (parse->n_anchor == PARSE_ALIASES) {
        parse_stop(parse, event, "too many anchors", PARSE_ALIASES);
        return;
    }
    parse->anchors[parse->n_anchor++] = (struct parse_anchor){mem_text((const char *)name), node, parse_size(node)};
}

static struct node *parse_alias(struct parse *parse, const yaml_event_t *event)
{
    const char *name = (const char *)event->data.alias.anchor;
    struct mark mark = parse_mark(parse, event->start_mark, event->end_mark);
    if (++parse->n_alias > PARSE_ALIASES) parse_stop(parse, event, "too many aliases", PARSE_ALIASES);
    for (unsigned i = parse->n_anchor; i-- > 0;) { /* the last anchor of a name counts */
        if (strcmp(parse->anchors[i].name, name) != 0) continue;
        parse_count(parse, event, parse->anchors[i].nodes);
        return parse->ended ? tree_map(parse->forest, &mark) : tree_copy(parse->forest, parse->anchors[i].node);
    }
    diag_error(parse->diag, &mark, "there is no anchor '&%s' above this line", name);
    struct node *nothing = tree_map(parse->forest, &mark);
    nothing->broken = true;
    return nothing;
}

static struct node *parse_scalar(struct parse *parse, const yaml_event_t *event)
{
    struct mark mark = parse_mark(parse, event->start_mark, event->end_mark);
    const char *text = (const char *)event->data.scalar.value;
    enum tree_style style = TREE_QUOTED;
    if (event->data.scalar.style == YAML_PLAIN_SCALAR_STYLE) style = TREE_PLAIN;
    else if (event->data.scalar.style == YAML_LITERAL_SCALAR_STYLE ||
             event->data.scalar.style == YAML_FOLDED_SCALAR_STYLE)
        style = TREE_BLOCK;
    if (strlen(text) != event->data.scalar.length) diag_error(parse->diag, &mark, "the text contains a zero byte");
    return tree_scalar(parse->forest, &mark, style, text);
}

static struct node *parse_node(struct parse *parse, const yaml_event_t *event, int depth);

static void parse_list(struct parse *parse, struct node *list, int depth)
{
    yaml_event_t event;
    while (parse_next(parse, &event)) {
        bool end = event.type == YAML_SEQUENCE_END_EVENT;
        if (!end) tree_append(parse->forest, list, parse_node(parse, &event, depth));
        yaml_event_delete(&event);
        if (end) return;
    }
}

static void parse_key(struct parse *parse, const struct node *map, const struct node *key)
{
    if (key->kind != TREE_SCALAR) {
        diag_error(parse->diag, &key->mark, "a key must be a word, not %s", tree_describe(key));
        return;
    }
    if (strcmp(key->text, "<<") == 0) {
        diag_error(parse->diag, &key->mark, "merge keys '<<' are not used in case files");
        diag_help(parse->diag, "'extends: base.yaml' builds on another file, 'variants:' lays changes over this one");
    }
    int before = tree_find(map, key->text);
    if (before < 0) return;
    diag_error(parse->diag, &key->mark, "key '%s' is already given in line %d", key->text,
               map->keys[before]->mark.line);
}

static void parse_map(struct parse *parse, struct node *map, int depth)
{
    yaml_event_t event;
    struct node *key = NULL;
    while (parse_next(parse, &event)) {
        if (event.type == YAML_MAPPING_END_EVENT) {
            yaml_event_delete(&event);
            return;
        }
        struct node *node = parse_node(parse, &event, depth);
        if (map->count == PARSE_KEYS) parse_stop(parse, &event, "a map has too many keys", PARSE_KEYS);
        yaml_event_delete(&event);
        if (!key) {
            parse_key(parse, map, node);
            key = node->kind == TREE_SCALAR ? node : tree_scalar(parse->forest, &node->mark, TREE_QUOTED, "");
        } else {
            bool merges = strcmp(key->text, "<<") == 0;
            map->broken |= merges;
            if (tree_find(map, key->text) < 0 && !merges) tree_add(parse->forest, map, key, node);
            key = NULL;
        }
    }
}

static void parse_tag(struct parse *parse, const struct node *node, const yaml_char_t *tag)
{
    if (!tag || strcmp((const char *)tag, "!") == 0) return;
    diag_error(parse->diag, &node->mark, "tags ('%s') are not used in case files", (const char *)tag);
}

static struct node *parse_node(struct parse *parse, const yaml_event_t *event, int depth)
{
    struct node *node;
    struct mark mark = parse_mark(parse, event->start_mark, event->end_mark);
    if (depth > PARSE_DEPTH) parse_stop(parse, event, "the values are nested too deeply", PARSE_DEPTH);
    parse_count(parse, event, 1);
    switch (event->type) {
    case YAML_ALIAS_EVENT: return parse_alias(parse, event);
    case YAML_SEQUENCE_START_EVENT:
        node = tree_list(parse->forest, &mark);
        parse_list(parse, node, depth + 1);
        parse_tag(parse, node, event->data.sequence_start.tag);
        parse_anchor_add(parse, event, event->data.sequence_start.anchor, node);
        return node;
    case YAML_MAPPING_START_EVENT:
        node = tree_map(parse->forest, &mark);
        parse_map(parse, node, depth + 1);
        parse_tag(parse, node, event->data.mapping_start.tag);
        parse_anchor_add(parse, event, event->data.mapping_start.anchor, node);
        return node;
    default:
        node = parse_scalar(parse, event);
        parse_tag(parse, node, event->data.scalar.tag);
        parse_anchor_add(parse, event, event->data.scalar.anchor, node);
        return node;
    }
}

static struct node *parse_stream(struct parse *parse)
{
    struct mark start = {parse->source, 1, 1, 1};
    struct node *root = NULL;
    yaml_event_t event;
    while (parse_next(parse, &event)) {
        bool end = event.type == YAML_STREAM_END_EVENT;
        if (event.type == YAML_DOCUMENT_START_EVENT && root) {
            struct mark mark = parse_mark(parse, event.start_mark, event.end_mark);
            diag_error(parse->diag, &mark, "a case is one YAML document; a second one begins here");
            parse->ended = true;
        } else if (event.type != YAML_STREAM_START_EVENT && event.type != YAML_DOCUMENT_START_EVENT &&
                   event.type != YAML_DOCUMENT_END_EVENT && !end)
            root = parse_node(parse, &event, 1);
        yaml_event_delete(&event);
        if (end) break;
    }
    return root ? root : tree_map(parse->forest, &start);
}

struct node *parse_source(struct forest *forest, struct diag *diag, const struct source *source)
{
    struct parse parse = {.forest = forest, .diag = diag, .source = source};
    if (!yaml_parser_initialize(&parse.yaml)) {
        diag_error(diag, NULL, "out of memory while reading '%s'", source->name);
        return NULL;
    }
    yaml_parser_set_encoding(&parse.yaml, YAML_UTF8_ENCODING);
    yaml_parser_set_input_string(&parse.yaml, (const unsigned char *)source->text, source->length);
    struct node *root = parse_stream(&parse);
    for (unsigned i = 0; i < parse.n_anchor; i++) mem_free(parse.anchors[i].name);
    yaml_parser_delete(&parse.yaml);
    return parse.ended ? NULL : root;
}
