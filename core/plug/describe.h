/* describe.h - what `bulla modules` prints: the loaded modules, and one of them in full.
 *
 * All of it comes from the descriptors, so a new module documents itself. */
#ifndef DESCRIBE_H
#define DESCRIBE_H

#include "base/text.h"

/* Appends the list of all loaded modules: by kind, one line each with name, version and the
 * first sentence of what it is. */
void describe_all(struct text *text);

/* Appends every module called `name` (or "kind/name"): doc, source, file and hash, its
 * parameters with units, defaults and ranges, its presets, and how a case uses it. Unknown:
 * STATUS_CASE, the message suggests the nearest. */
int describe_one(const char *name, struct text *text);

#endif
