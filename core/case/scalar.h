/* scalar.h - one scalar of a case: a quantity, a choice, a flag ..., by its row in a table. */
#ifndef SCALAR_H
#define SCALAR_H

#include "case/keys.h"

/* Reads value->node by value->key and normalises the node. `choices`: allowed words of a
 * selector, or NULL to take the key's own. Mistakes are recorded; value->given tells. */
void scalar_read(struct keys *keys, struct keys_value *value, const char *const *choices);

/* "a pressure", "an integer", "one of a, b": what a key wants; in the forest. */
const char *scalar_wanted(struct forest *forest, const struct key *key);

/* NULL-terminated list from "a|b|c", in the forest. */
const char *const *scalar_choices(struct forest *forest, const char *choices);

/* The text of a number as it stands in a resolved case; in the forest. */
const char *scalar_number(struct forest *forest, double value);

#endif
