/* keys_unknown.h - keys that no row knows, and what was probably meant: a name that is spelled like it, another case of
 * the section, another section, a missing blank or quote. */
#ifndef KEYS_UNKNOWN_H
#define KEYS_UNKNOWN_H

#include "case/keys_rows.h"

/* Records an error with a suggestion for every key of the map that is in no row; the row that was probably meant is
 * noted. */
void keys_unknown(struct keys *keys, const struct keys_map *map, struct keys_rows *rows);

#endif
