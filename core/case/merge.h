/* merge.h - one tree from many: `extends:`, `variants:`, `--set`.
 *
 * Maps are merged key by key, everything else is replaced; null deletes a key. A map whose
 * `type` changes is replaced whole, since its other keys belonged to the old type; when the `pulse` of an
 * incoming wave changes, the keys of the old pulse go. Every node keeps the mark of the text it came from. */
#ifndef MERGE_H
#define MERGE_H

#include "case/tree.h"

struct merge_options {
    const char *const *sets; /* NULL-terminated "path=value" list, or NULL */
    const char *variant;     /* or NULL */
};

/* The tree of a case file with the files it extends, the variant and the settings laid over
 * it. Mistakes are recorded; NULL if there is no tree. `extends` is used up; `variants`, `quick`, `matrix` stay. */
struct node *merge_case(struct forest *forest, struct diag *diag, const char *path,
                        const struct merge_options *options);

#endif
