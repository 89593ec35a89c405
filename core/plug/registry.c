/* registry.c - see registry.h.
 *
 * A sorted array of loaded objects. The first file that brings a kind and name keeps it: a later
 * one is refused, naming both, unless it is the same file or has the same bytes (a copy in a
 * second folder of the search path).
 *
 * What is built in is called KIND-NAME.so (BULLA_MODULES) and waits until somebody asks for it: a scene needs some six
 * of fifty, and to load them all is a third of the time of a start, and on a cluster fifty files for each rank. */
#include "plug/registry.h"

#include "base/log.h"
#include "base/mem.h"
#include "base/status.h"
#include "base/system.h"
#include "plug/loader.h"

#include <dirent.h>
#include <errno.h>
#include <stdbool.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

static struct loader_object *registry_objects;
static struct registry_entry *registry_entries; /* the public view, same order */
static const char **registry_list;              /* last answer of registry_names */
static size_t registry_size;
static bool registry_scanned;
static char **registry_waiting; /* built-in objects that are not loaded yet: paths, by name */
static size_t registry_n_waiting;

static int registry_compare(const struct bulla_module *a, const char *kind, const char *name)
{
    int order = strcmp(a->kind, kind);
    return order ? order : strcmp(a->name, name);
}

/* First place whose module is not before (kind, name). */
static size_t registry_place(const char *kind, const char *name)
{
    size_t at = 0;
    while (at < registry_size && registry_compare(registry_entries[at].module, kind, name) < 0) at++;
    return at;
}

static void registry_insert(struct loader_object object)
{
    size_t at = registry_place(object.module->kind, object.module->name), size = registry_size++;
    registry_objects = mem_grow(registry_objects, size, size + 1, sizeof *registry_objects);
    registry_entries = mem_grow(registry_entries, size, size + 1, sizeof *registry_entries);
    memmove(registry_objects + at + 1, registry_objects + at, (size - at) * sizeof *registry_objects);
    memmove(registry_entries + at + 1, registry_entries + at, (size - at) * sizeof *registry_entries);
    registry_objects[at] = object;
    registry_entries[at] = (struct registry_entry){object.module, object.path, object.hash};
}

static int registry_add(const char *path, bool known)
{
    struct loader_object object;
    TRY(loader_open(path, known, &object));
    const struct registry_entry *taken = registry_find(object.module->kind, object.module->name);
    if (!taken) {
        registry_insert(object);
        return STATUS_OK;
    }
    bool same = taken->hash == object.hash;
    if (!same)
        status_fail(STATUS_CASE, "%s brings %s '%s', which %s has brought already", object.path, object.module->kind,
                    object.module->name, taken->path);
    loader_close(&object);
    return same ? STATUS_OK : STATUS_CASE;
}

/* Loads the waiting object `at`. One that is refused costs a warning, not the run. */
static void registry_wake_at(size_t at, bool known)
{
    char *path = registry_waiting[at];
    registry_n_waiting--;
    memmove(registry_waiting + at, registry_waiting + at + 1, (registry_n_waiting - at) * sizeof *registry_waiting);
    if (registry_add(path, known)) log_warn("module skipped: %s", status_text());
    mem_free(path);
}

/* The one that is called so. */
static void registry_wake(const char *kind, const char *name)
{
    char *file = mem_print("/%s-%s.so", kind, name);
    for (size_t i = 0; i < registry_n_waiting; i++)
        if (strcmp(strrchr(registry_waiting[i], '/'), file) == 0) {
            registry_wake_at(i, true);
            break;
        }
    mem_free(file);
}

static void registry_wake_all(void)
{
    while (registry_n_waiting) registry_wake_at(0, true);
}

int registry_load(const char *path)
{
    return registry_add(path, false);
}

static int registry_is_object(const struct dirent *entry)
{
    size_t length = strlen(entry->d_name);
    return length > 3 && strcmp(entry->d_name + length - 3, ".so") == 0;
}

/* Is this one of the files that are built with the program? */
static bool registry_is_built_in(const char *file)
{
    char *name = mem_print("/%s/", file);
    bool found = strstr(BULLA_MODULES, name);
    mem_free(name);
    return found;
}

/* All *.so of a folder, by name; what is built in waits. */
static void registry_scan(const char *folder, bool own)
{
    struct dirent **files;
    int count = scandir(folder, &files, registry_is_object, alphasort);
    if (count < 0) {
        if (!own) log_warn("module folder %s cannot be read: %s", folder, strerror(errno));
        return;
    }
    for (int i = 0; i < count; i++) {
        size_t at = registry_n_waiting++;
        registry_waiting = mem_grow(registry_waiting, at, at + 1, sizeof *registry_waiting);
        registry_waiting[at] = mem_print("%s/%s", folder, files[i]->d_name);
        if (!own || !registry_is_built_in(files[i]->d_name)) registry_wake_at(at, own);
        free(files[i]);
    }
    free(files);
}

/* ../lib/bulla/modules seen from the folder of the running program; NULL where there is none. free() it. */
static char *registry_own_folder(void)
{
    if (!*system_program()) return NULL;
    char *program = mem_text(system_program());
    char *slash = strrchr(program, '/');
    if (slash) *slash = '\0';
    char *folder = mem_print("%s/../lib/bulla/modules", program), *real = realpath(folder, NULL);
    mem_free(folder);
    mem_free(program);
    return real;
}

/* A folder that somebody named: its modules are probed, unless it is the program's own. */
static void registry_scan_named(const char *folder, const char *own, bool *ret_is_own)
{
    char *real = realpath(folder, NULL);
    bool is_own = real && own && strcmp(real, own) == 0;
    free(real);
    if (is_own && *ret_is_own) return;
    registry_scan(folder, is_own);
    *ret_is_own |= is_own;
}

/* Folders of a colon separated list; empty ones are skipped (never the working directory). True if the program's own is
 * one of them. */
static bool registry_scan_list(const char *list, const char *own)
{
    bool has_own = false;
    while (*list) {
        size_t length = strcspn(list, ":");
        if (length) {
            char *folder = mem_text_n(list, length);
            registry_scan_named(folder, own, &has_own);
            mem_free(folder);
        }
        list += length + (list[length] == ':');
    }
    return has_own;
}

int registry_init(void)
{
    if (registry_scanned) return STATUS_OK;
    registry_scanned = true;
    const char *list = getenv("BULLA_MODULE_PATH");
    char *own = registry_own_folder();
    bool has_own = list && registry_scan_list(list, own);
    if (own && !has_own) registry_scan(own, true);
    free(own);
    for (size_t i = 0; i < registry_size; i++) /* that another file has one of their names is said at once */
        registry_wake(registry_entries[i].module->kind, registry_entries[i].module->name);
    return STATUS_OK;
}

void registry_done(void)
{
    for (size_t i = 0; i < registry_size; i++) loader_close(&registry_objects[i]);
    mem_free(registry_objects);
    mem_free(registry_entries);
    mem_free(registry_list);
    for (size_t i = 0; i < registry_n_waiting; i++) mem_free(registry_waiting[i]);
    mem_free(registry_waiting);
    registry_waiting = NULL;
    registry_n_waiting = 0;
    registry_objects = NULL;
    registry_entries = NULL;
    registry_list = NULL;
    registry_size = 0;
    registry_scanned = false;
}

bool registry_is_empty(void)
{
    return !registry_size && !registry_n_waiting;
}

size_t registry_count(void)
{
    registry_wake_all();
    return registry_size;
}

const struct registry_entry *registry_at(size_t index)
{
    registry_wake_all();
    return index < registry_size ? &registry_entries[index] : NULL;
}

const struct registry_entry *registry_find(const char *kind, const char *name)
{
    registry_wake(kind, name);
    size_t at = registry_place(kind, name);
    if (at == registry_size || registry_compare(registry_entries[at].module, kind, name) != 0) return NULL;
    return &registry_entries[at];
}

const char *const *registry_names(const char *kind)
{
    registry_wake_all();
    mem_free(registry_list);
    registry_list = mem_new(registry_size + 1, sizeof *registry_list);
    size_t count = 0;
    for (size_t i = 0; i < registry_size; i++)
        if (strcmp(registry_entries[i].module->kind, kind) == 0)
            registry_list[count++] = registry_entries[i].module->name;
    return registry_list;
}
