/* bulla/module.h - the contract between core and a module.
 *
 * A module is one shared object that exports one constant, `bulla_module`. Core and
 * module meet only in the headers of this folder; they are C11 and C++ clean and need
 * nothing but <stddef.h> and <stdint.h>. The descriptor can be read before any object
 * exists, so that listing modules, checking a case and writing the schema are cheap.
 *
 * The parameter table is the only place where a module's keys are described: parsing,
 * units, ranges, defaults, documentation and the case schema all follow from it.
 *
 * Versions: `abi` changes when an existing field changes its meaning; structs only grow
 * at their end and carry their `size`, so that an older module still
 * loads. */
#ifndef BULLA_MODULE_H
#define BULLA_MODULE_H

#include <stddef.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#define BULLA_RESTRICT __restrict
#else
#define BULLA_RESTRICT restrict
#endif

#define BULLA_MAGIC 0x414c4c55u /* "ULLA" */
#define BULLA_ABI 1u

/* Marks the one exported symbol; everything else is built with hidden visibility. */
#define BULLA_EXPORT __attribute__((visibility("default")))

/* Builds a kernel for several instruction sets; the loader picks one at run time. All
 * variants give bitwise equal results (no contraction, no reassociation). */
#if defined(__x86_64__) && !defined(__SANITIZE_ADDRESS__) && !defined(BULLA_NO_CLONES)
#define BULLA_KERNEL __attribute__((target_clones("default", "arch=x86-64-v3", "arch=x86-64-v4")))
#else
#define BULLA_KERNEL __attribute__((noinline))
#endif

/* What a parameter holds. */
enum bulla_type {
    BULLA_NUMBER = 0, /* a double with a unit */
    BULLA_TEXT = 1,   /* a string: free text */
    BULLA_CHOICE = 2, /* a string out of `choices` */
    BULLA_FILE = 3    /* the name of a file: in a case relative to the case file, here a path that can be opened */
};

/* One key of a module's section in a case file. A table ends with `name == NULL`. */
struct bulla_param {
    const char *name; /* the key, e.g. "p-inf" */
    const char *unit; /* SI unit, e.g. "Pa", "kg/m3", "J/kg/K", "1"; fixes the dimension */
    double min, max;  /* allowed range, both ends included (numbers only) */
    double fallback;  /* default; NaN: the key must be given (numbers only) */
    const char *doc;  /* one sentence */
    int type;         /* enum bulla_type; zero means a number */
    const char
        *choices; /* choices: "a|b|c"; the first is the default. texts and files: NULL = required, "" = optional */
};

/* The value of one parameter, in table order. Text lives as long as the instance. */
struct bulla_value {
    double number;
    const char *text;
};

/* A named set of parameter values, chosen by the key `preset`; keys given beside it win.
 * The list ends with `name == NULL`. `values` has one number per parameter: for a choice that of the word, from 0;
 * NaN: not set. */
struct bulla_preset {
    const char *name, *doc;
    const double *values;
};

/* Services that core offers to a module while it is opened. */
struct bulla_host {
    uint32_t size;
    void (*say)(const char *text);  /* a line for the log */
    void (*fail)(const char *text); /* the reason why `open` is about to return non-zero */

    /* Slots from here on came later: a host whose `size` ends before them has none of them. */

    /* A block of `bytes` bytes (zeros at first) for what is large and only read: a table. All processes of a machine
     * and all instances opened with the same values have it in common. If nobody has it yet, core calls fill(context,
     * block, phase, part, parts)   for phase = 0 .. phases - 1 on `parts` processes at once, which share the work: each
     * makes part `part` of `parts` (0 .. parts - 1). A phase begins when all parts of the one before are done. What is
     * in the block must not depend on `parts`. `fill` returns 0, or non-zero after host->fail(reason), and then nobody
     * gets the block. Several blocks of an instance have different names. Every process must ask for the same blocks in
     * the same order: `open` must not look at anything but its values and such blocks before it asks. Aligned to pages;
     * it lives as long as the instance, and core frees it. NULL: failed, the reason is given. */
    const void *(*share)(const char *name, size_t bytes, unsigned phases,
                         int (*fill)(void *context, void *block, unsigned phase, unsigned part, unsigned parts),
                         void *context);
};

/* Whether a host has a slot that came later. */
#define BULLA_HOST_HAS(host, slot) ((host)->size > offsetof(struct bulla_host, slot) && (host)->slot)

struct bulla_module {
    uint32_t magic, abi, size;          /* BULLA_MAGIC, BULLA_ABI, sizeof(struct bulla_module) */
    const char *kind;                   /* "eos", "limiter", ...: one of those that docs/modules.md lists */
    const char *name;                   /* the name used in case files, lower case with hyphens */
    const char *version;                /* of the module, e.g. "1.0" */
    const char *doc;                    /* one or two sentences: what it is and when to use it */
    const char *cite;                   /* paper and equation */
    const struct bulla_param *params;   /* may be NULL: no parameters */
    const struct bulla_preset *presets; /* may be NULL */
    /* [start-up, once per use] Makes an instance from the values (one per table row, in
     * table order, defaults filled in). Returns 0, or non-zero after host->fail(reason).
     * May be NULL: instances are then NULL. */
    int (*open)(const struct bulla_host *host, const struct bulla_value *values, void **ret_self);
    void (*close)(void *self); /* [shut-down] frees what `open` made; may be NULL */
    const void *table;         /* the functions of the kind: struct bulla_eos, ... */
};

/* The exported symbol. */
extern BULLA_EXPORT const struct bulla_module bulla_module;

#ifdef __cplusplus
}
#endif
#endif
