/* keys.c - see keys.h: what was read, found by name, and the errors at it. Reading is in keys_read.c. */
#include "case/keys.h"

#include <stdarg.h>
#include <string.h>

void keys_error(struct keys *keys, const struct keys_value *value, const char *format, ...)
{
    char message[1024];
    va_list args;
    va_start(args, format);
    vsnprintf(message, sizeof message, format, args);
    va_end(args);
    diag_error(keys->diag, &value->node->mark, "%s: %s", value->path, message);
}

const struct keys_value *keys_at(const struct keys_map *map, const char *name)
{
    static const struct key none = {.name = ""};
    static const struct keys_value absent = {.key = &none, .path = ""};
    for (unsigned i = 0; map && i < map->count; i++)
        if (strcmp(map->values[i].key->name, name) == 0) return &map->values[i];
    return &absent;
}
