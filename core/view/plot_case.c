/* plot_case.c - see plot_case.h. The case is read as plain YAML: no module and no check of the scene stands
 * between a finished run and its pictures. */
#include "view/plot_case.h"

#include "base/file.h"
#include "base/mem.h"

#include <stdio.h>
#include <string.h>
#include <yaml.h>

/* The value of a key of the top mapping, in new memory, or NULL. */
static char *case_of_document(yaml_document_t *document, const char *key)
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
            value = case_of_document(&document, key);
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

const char *plot_case_run(const char *const *directories, unsigned n, unsigned run)
{
    const char *slash = strrchr(directories[run], '/'), *name = slash && slash[1] ? slash + 1 : directories[run];
    for (unsigned i = 0; i < n; i++) {
        const char *other = strrchr(directories[i], '/');
        if (i != run && strcmp(other && other[1] ? other + 1 : directories[i], name) == 0) return directories[run];
    }
    return name;
}
