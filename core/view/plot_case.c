/* plot_case.c - see plot_case.h. The case is read as plain YAML: no module and no check of the scene stands
 * between a finished run and its pictures. */
#include "view/plot_case.h"

#include "base/file.h"
#include "base/mem.h"

#include <stdbool.h>
#include <stdio.h>
#include <string.h>
#include <yaml.h>

enum { CASE_BRIEF = 48 }; /* longest title that a legend has room for */

/* The value of a key of the top mapping, in new memory, or NULL. */
static char *plot_case_of_document(yaml_document_t *document, const char *key)
{
    yaml_node_t *root = yaml_document_get_root_node(document);
    if (!root || root->type != YAML_MAPPING_NODE) return NULL;
    for (yaml_node_pair_t *pair = root->data.mapping.pairs.start; pair < root->data.mapping.pairs.top; pair++) {
        yaml_node_t *name = yaml_document_get_node(document, pair->key);
        yaml_node_t *value = yaml_document_get_node(document, pair->value);
        if (!name || !value || name->type != YAML_SCALAR_NODE || value->type != YAML_SCALAR_NODE) continue;
        if (strcmp((const char *)name->data.scalar.value, key) == 0)
            return mem_text((const char *)value->data.scalar.value);
    }
    return NULL;
}

char *plot_case_scalar(const char *directory, const char *key)
{
    char *path = mem_print("%s/case.yaml", directory);
    const char *why;
    FILE *file = file_open(path, &why);
    mem_free(path);
    char *value = NULL;
    yaml_parser_t parser;
    yaml_document_t document;
    if (!file) return NULL;
    if (yaml_parser_initialize(&parser)) {
        yaml_parser_set_input_file(&parser, file);
        if (yaml_parser_load(&parser, &document)) {
            value = plot_case_of_document(&document, key);
            yaml_document_delete(&document);
        }
        yaml_parser_delete(&parser);
    }
    fclose(file);
    return value;
}

char *plot_case_directory(const char *directory)
{
    size_t length = strlen(directory);
    while (length > 1 && directory[length - 1] == '/') length--;
    return mem_text_n(directory, length);
}

char *plot_case_title(const char *directory)
{
    char *title = plot_case_scalar(directory, "title");
    if (title) return title;
    char *bare = plot_case_directory(directory);
    const char *slash = strrchr(bare, '/');
    title = mem_text(slash && slash[1] ? slash + 1 : bare);
    mem_free(bare);
    return title;
}

char *plot_case_common_title(const char *const *directories, unsigned n)
{
    char *title = plot_case_title(directories[0]);
    for (unsigned i = 1; i < n; i++) {
        char *other = plot_case_title(directories[i]);
        if (strcmp(other, title) != 0) *title = '\0';
        mem_free(other);
    }
    return title;
}

static void plot_case_forget(char **names, unsigned n)
{
    for (unsigned i = 0; i < n; i++) mem_free(names[i]);
}

static bool plot_case_are_distinct(char *const *names, unsigned n)
{
    for (unsigned i = 0; i < n; i++)
        for (unsigned k = 0; k < i; k++)
            if (strcmp(names[i], names[k]) == 0) return false;
    return true;
}

/* Bytes at the start of all the paths that are the same, up to a slash. */
static size_t plot_case_lead(const char *const *paths, unsigned n)
{
    size_t lead = 0;
    for (size_t at = 0; paths[0][at]; at++) {
        for (unsigned i = 1; i < n; i++)
            if (paths[i][at] != paths[0][at]) return lead;
        if (paths[0][at] == '/') lead = at + 1;
    }
    return lead;
}

/* Bytes at the end of all the paths that are the same, from a slash on, behind the first `lead` bytes. */
static size_t plot_case_tail(const char *const *paths, unsigned n, size_t lead)
{
    size_t tail = 0, length = strlen(paths[0]);
    for (size_t back = 1; back + lead < length; back++) {
        for (unsigned i = 1; i < n; i++) {
            size_t other = strlen(paths[i]);
            if (back + lead >= other || paths[i][other - back] != paths[0][length - back]) return tail;
        }
        if (paths[0][length - back] == '/') tail = back;
    }
    return tail;
}

/* By their paths. */
static void plot_case_places(const char *const *paths, unsigned n, char **ret_names)
{
    for (unsigned i = 0; i < n; i++) {
        const char *slash = strrchr(paths[i], '/');
        ret_names[i] = mem_text(slash && slash[1] ? slash + 1 : paths[i]);
    }
    if (plot_case_are_distinct(ret_names, n)) return;
    plot_case_forget(ret_names, n);
    size_t lead = plot_case_lead(paths, n), tail = plot_case_tail(paths, n, lead);
    for (unsigned i = 0; i < n; i++) ret_names[i] = mem_text_n(paths[i] + lead, strlen(paths[i]) - lead - tail);
}

void plot_case_names(const char *const *directories, unsigned n, char **ret_names)
{
    bool brief = true;
    for (unsigned i = 0; i < n; i++) {
        ret_names[i] = plot_case_title(directories[i]);
        brief = brief && strlen(ret_names[i]) <= CASE_BRIEF && !strchr(ret_names[i], '\n');
    }
    if (brief && plot_case_are_distinct(ret_names, n)) return;
    plot_case_forget(ret_names, n);
    plot_case_places(directories, n, ret_names);
}
