/* registry.h - which modules there are, by kind and name.
 *
 * Built-in laws are found exactly like foreign ones: shared objects in a folder. Search
 * order: files named by the case (`modules:`), BULLA_MODULE_PATH (colon separated folders),
 * the program's own folder ../lib/bulla/modules (build and install tree alike).
 *
 * This folder, plug: modules, which are loaded, vetted, described and opened here; what they compute is not looked
 * at. */
#ifndef REGISTRY_H
#define REGISTRY_H

#include "bulla/module.h"

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

struct registry_entry {
    const struct bulla_module *module;
    const char *path; /* absolute path of the shared object */
    uint64_t hash;    /* xxh64 of the file, for provenance */
};

/* Scans the search path once (later calls return at once). A file that is not a loadable
 * module of this ABI gives a warning in the log and is skipped. What is built in, KIND-NAME.so each,
 * is loaded when one of the functions below asks for it. Returns 0 or a status. */
int registry_init(void);
void registry_done(void);

/* Loads one shared object and adds it. Errors (missing, not a module, wrong ABI, bad table,
 * name already taken by another file) return STATUS_CASE with a message that says why. */
int registry_load(const char *path);

/* Is there no module at all? */
bool registry_is_empty(void);

/* All entries, sorted by kind, then name. Entries move when a module is loaded, which registry_find may do: keep what
 * they point to, not the entry. */
size_t registry_count(void);
const struct registry_entry *registry_at(size_t index);

/* NULL if there is none. */
const struct registry_entry *registry_find(const char *kind, const char *name);

/* NULL-terminated list of the names of a kind (for messages); valid until the next load. */
const char *const *registry_names(const char *kind);

#endif
