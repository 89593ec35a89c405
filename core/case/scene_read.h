/* scene_read.h - from a case file to a scene. */
#ifndef SCENE_READ_H
#define SCENE_READ_H

#include "case/scene.h"

#include <stdio.h>

/* What the command line adds to a case. */
struct scene_options {
    const char *const *sets; /* NULL-terminated "path=value" list, or NULL */
    const char *variant;     /* or NULL */
    const char *directory;   /* -o, or NULL */
    bool json;               /* messages as one JSON object per line */
    FILE *messages;          /* where they go; NULL: stderr, on rank 0 */
};

/* Reads, checks and resolves a case file. All errors of the file are printed (to stderr, or
 * `messages`; as JSON lines with `json`) in one pass; returns STATUS_CASE then, with a one-line
 * summary as its text. Loads the modules that the case names. `options` may be NULL. */
int scene_read(const char *path, const struct scene_options *options, struct scene **ret_scene);

#endif
