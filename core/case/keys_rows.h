/* keys_rows.h - the rows that apply to one map: those of the base, its own, those of the cases that its selectors have
 * chosen, and one for each key whose name is free. */
#ifndef KEYS_ROWS_H
#define KEYS_ROWS_H

#include "case/keys.h"

struct keys_row {
    const struct key *key;
    const struct keys_section *selects; /* the section whose selector this row is, or NULL */
    bool meant;                         /* an unknown key probably meant this one: it is not missing */
};

/* While a map is read; in the forest. */
struct keys_rows {
    struct forest *forest;
    struct keys_row *list;
    unsigned count;
    const struct keys_section *chosen; /* the innermost case, or NULL */
    bool open;                         /* a case was not recognised: which keys are allowed is not known */
};

/* All rows of a map that a section describes. */
struct keys_rows keys_rows(struct keys *keys, const struct keys_section *section, const struct node *map);

/* Appends the rows of a section and of its bases. */
void keys_rows_add(struct keys_rows *rows, const struct keys_section *section);

/* Index of the row with this name, or -1. */
int keys_rows_find(const struct keys_rows *rows, const char *name);

#endif
