/* parse.h - reads YAML text into a tree, within limits.
 *
 * libyaml's events, not its documents: so the limits hold while reading, duplicate keys and
 * merge keys are refused, and every node carries its file, line and column. */
#ifndef PARSE_H
#define PARSE_H

#include "case/tree.h"

enum { PARSE_DEPTH = 32, PARSE_NODES = 100000, PARSE_KEYS = 2000, PARSE_ALIASES = 64, PARSE_BYTES = 1 << 20 };

/* Parses a source. Mistakes are recorded; NULL if one of them ended the reading. An empty text is an empty map. */
struct node *parse_source(struct forest *forest, struct diag *diag, const struct source *source);

#endif
