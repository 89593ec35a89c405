/* scene_file.c - files that a case names: found beside the file in which the name stands. */
#include "case/scene_draft.h"

#include "base/mem.h"
#include "case/parse.h"

#include <limits.h>
#include <stdlib.h>
#include <string.h>

const char *scene_file_beside(struct forest *forest, const struct source *source, const char *name)
{
    const char *slash = source->is_file ? strrchr(source->name, '/') : NULL;
    const char *path = name[0] == '/' || !slash
                           ? name
                           : tree_print(forest, "%.*s/%s", (int)(slash - source->name), source->name, name);
    char *whole = realpath(path, NULL);
    if (whole) path = tree_print(forest, "%s", whole);
    free(whole);
    return path;
}

const char *scene_file(struct draft *draft, const struct keys_value *value)
{
    const char *path = scene_file_beside(draft->keys.forest, value->node->mark.source, value->text);
    value->node->text = path;
    value->node->style = TREE_QUOTED;
    return path;
}

static bool scene_file_is_lua(const char *text)
{
    size_t length = strlen(text);
    return length > 4 && strcmp(text + length - 4, ".lua") == 0 && strpbrk(text, "\n(") == NULL;
}

const struct script *scene_file_lua(struct draft *draft, const struct keys_value *value)
{
    struct mark where = value->node->mark;
    const char *text = value->text;
    const struct script *script = NULL;
    if (scene_file_is_lua(text)) {
        const char *path = scene_file_beside(draft->keys.forest, where.source, text);
        const struct source *source = diag_file(draft->keys.diag, path, PARSE_BYTES, &value->node->mark);
        if (!source) return NULL;
        if (strlen(source->text) != source->length) {
            keys_error(&draft->keys, value, "'%s' is no text", path);
            return NULL;
        }
        where = (struct mark){source, 1, 1, 1};
        text = source->text;
        value->node->text = text;
        value->node->style = TREE_BLOCK;
    } else if (value->node->style == TREE_BLOCK) where.line++; /* the text begins below the `|` */
    params_compile_chunk(draft->keys.params, &where, value->path, text, &script);
    return script;
}
