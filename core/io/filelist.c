/* filelist.c - see filelist.h. */
#include "io/filelist.h"

#include "base/mem.h"
#include "base/status.h"

#include <jansson.h>
#include <stdlib.h>

static void filelist_append(struct filelist *list, const char *name, double time)
{
    list->names = mem_grow(list->names, list->n, list->n + 1, sizeof *list->names);
    list->times = mem_grow(list->times, list->n, list->n + 1, sizeof *list->times);
    list->names[list->n] = mem_text(name);
    list->times[list->n++] = time;
}

int filelist_read(const char *path, struct filelist *ret_list)
{
    json_error_t error;
    json_t *root = json_load_file(path, 0, &error), *files = json_object_get(root, "files"), *entry;
    if (!json_is_array(files)) {
        json_decref(root);
        return status_fail(STATUS_RUN, "%s: not a list of snapshots: %s", path, root ? "no 'files'" : error.text);
    }
    struct filelist list = {0};
    size_t i;
    int code = STATUS_OK;
    json_array_foreach(files, i, entry)
    {
        const char *name = json_string_value(json_object_get(entry, "name"));
        json_t *time = json_object_get(entry, "time");
        if (name && json_is_number(time)) filelist_append(&list, name, json_number_value(time));
        else code = status_fail(STATUS_RUN, "%s: entry %zu has no name or no time", path, i + 1);
    }
    json_decref(root);
    if (code) filelist_done(&list);
    else *ret_list = list;
    return code;
}

void filelist_done(struct filelist *list)
{
    for (size_t i = 0; i < list->n; i++) mem_free(list->names[i]);
    mem_free(list->names);
    mem_free(list->times);
    *list = (struct filelist){0};
}

void filelist_add(struct filelist *list, const char *name, double time)
{
    while (list->n && list->times[list->n - 1] >= time) filelist_drop(list);
    filelist_append(list, name, time);
}

void filelist_drop(struct filelist *list)
{
    mem_free(list->names[--list->n]);
}

char *filelist_text(const struct filelist *list)
{
    json_t *files = json_array();
    for (size_t i = 0; i < list->n; i++)
        json_array_append_new(files, json_pack("{s:s, s:f}", "name", list->names[i], "time", list->times[i]));
    json_t *root = json_pack("{s:s, s:o}", "file-series-version", "1.0", "files", files);
    char *text = json_dumps(root, JSON_INDENT(1)), *copy = mem_text(text);
    free(text);
    json_decref(root);
    return copy;
}
