/* loader.h - one shared object into the process, or a clear refusal.
 *
 * Modules are trusted code (their constructors run before anything can be checked); the checks
 * guard against accidents: damaged files, other interfaces, half-filled tables, and objects that
 * change how the processor computes. */
#ifndef LOADER_H
#define LOADER_H

#include "bulla/module.h"

#include <stdbool.h>

struct loader_object {
    const struct bulla_module *module; /* inside the object: valid until loader_close */
    char *path;                        /* absolute, without symbolic links; owned */
    uint64_t hash;                     /* xxh64 of the file */
    void *handle;
};

/* Loads and vets; what is not `known` to be sound (bulla's own modules) is tried in a child process first. On
 * failure STATUS_CASE with "PATH reason" as the message, nothing stays loaded. */
int loader_open(const char *path, bool known, struct loader_object *ret_object);

/* Unloads; a zeroed object is fine. */
void loader_close(struct loader_object *object);

#endif
