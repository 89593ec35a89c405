/* keys.h - one table per section of a case: the only place where its keys are described.
 *
 * A table drives reading, units, ranges, defaults, messages, `bulla show` and the schema. A
 * section may have cases, chosen by one of its keys (`type: incoming-wave`), which add keys;
 * the cases of a module section are the loaded modules, their keys the modules' parameters.
 * Reading (keys_read.h) normalises the tree in place: numbers in SI, defaults written out, keys in the order
 * of the table, so that the tree can be printed as the resolved case. */
#ifndef KEYS_H
#define KEYS_H

#include "case/params.h"
#include "case/tree.h"
#include "case/unit.h"

#include <float.h>

#define KEYS_POSITIVE DBL_MIN /* as `min`: above zero */
#define KEYS_MOST DBL_MAX     /* as `max`: no bound; as -KEYS_MOST for `min` too */

enum keys_type {
    KEYS_NUMBER = 1, /* a quantity: number, number with unit, constant expression */
    KEYS_INTEGER,
    KEYS_FLAG,
    KEYS_TEXT,
    KEYS_FIELD,     /* a text: the name of a field, or an expression of fields, "= ...", which {NAME: "= ..."} names */
    KEYS_NAME,      /* an identifier */
    KEYS_CHOICE,    /* one of `choices`; of a selector: one of the cases */
    KEYS_VALUE,     /* a quantity, or an expression of x, y, z, r, t */
    KEYS_EVERY,     /* a time, or "N steps" */
    KEYS_SECTION,   /* a map described by `section` */
    KEYS_SCRIPT,    /* Lua: an expression, a function, or the name of a file with one */
    KEYS_PARAMETER, /* a quantity of any dimension; params.h has read it */
    KEYS_TREE,      /* anything; checked where it is used. With a section: a part of one, laid over it */
};

/* How many: one, a list of them, a map NAME: one, or one or such a map. */
enum keys_many { KEYS_ONE, KEYS_LIST, KEYS_NAMED, KEYS_ONE_OR_NAMED };

struct keys_section;

struct key {
    const char *name;
    enum keys_type type;
    enum keys_many many;
    bool required;
    const char *unit;     /* of numbers: "Pa", "1"; fixes the dimension. NULL: any (integers: none) */
    double min, max;      /* both ends included; both 0: no bounds */
    const char *fallback; /* default, as it would stand in the file; NULL: none */
    const char *choices;  /* "a|b|c" */
    const struct keys_section *section;
    const char *doc;
};

struct keys_section {
    const char *name; /* "domain"; of a case: the value that chooses it */
    const char *doc;
    const struct keys_section *base;         /* its keys come first, or NULL */
    const struct key *keys;                  /* ends with name NULL; may be NULL */
    unsigned choose;                         /* exactly one of the first so many rows stands in it (who reads it sees
                                                to that, the schema says it); 0: any */
    unsigned positional;                     /* a list of so many values stands for the first rows; 0: no list does */
    const struct key *others;                /* the row of all keys that are not in a table (their names are free) */
    const char *selector;                    /* the key that chooses a case, or NULL; its value may stand for the map */
    const struct keys_section *const *cases; /* ends with NULL */
    const char *rules;                       /* what else the reader sees to, for the schema: a list of JSON Schemas
                                                without its brackets, ' instead of "; or NULL */
    const char *kind;                        /* the modules of this kind are cases, too */
    const char *amount, *amount_key;         /* a quantity stands for the map of this case with this key; or NULL */
    const struct bulla_module *module;       /* of a case that is a module */
};

/* What was read for one key. */
struct keys_value {
    const struct key *key;
    struct node *node;           /* NULL: absent, no default */
    const char *path;            /* "domain.cells[1]", for messages */
    bool given;                  /* present or defaulted, and right */
    bool meant;                  /* an unknown key, which is recorded, was probably meant to be this one */
    double number;               /* numbers, values; of `every` when it is a time */
    bool bare;                   /* of a number: written without a unit */
    struct unit unit;            /* of a number that is not bare: the unit it was written in */
    long integer;                /* integers; steps of `every`; flags 0, 1; index of a choice in `choices` */
    const char *text;            /* texts, names, choices */
    const char *name;            /* of an entry of a named map */
    const struct script *script; /* of a value that is a field expression; then no number */
    struct keys_map *map;        /* sections */
    struct keys_value *list;     /* entries of a list or named map */
    unsigned count;
};

struct keys_map {
    const struct keys_section *section, *chosen; /* chosen: the innermost case, or NULL */
    struct node *node;
    const char *path;
    unsigned count;
    struct keys_value *values;
};

struct keys {
    struct forest *forest;
    struct diag *diag;
    struct params *params;
    const struct keys_section *root; /* to tell where a misplaced key belongs */
};

/* The value of a key. The key must be in the table; `map` may be NULL (then nothing is given). */
const struct keys_value *keys_at(const struct keys_map *map, const char *name);

/* Records an error at a value. */
void keys_error(struct keys *keys, const struct keys_value *value, const char *format, ...)
    __attribute__((format(printf, 3, 4)));

#endif
