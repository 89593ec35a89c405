/* family.h - the cases of a section: `type: outflow`, `type: stiffened-gas`.
 *
 * Cases of core's own sections are tables in core; those of a module kind, which may stand beside them, are made from
 * the parameter tables of modules, so a new module's keys are checked,
 * documented and part of the schema without a line in core. */
#ifndef FAMILY_H
#define FAMILY_H

#include "case/keys.h"

/* The case of that name, or NULL. */
const struct keys_section *family_find(struct forest *forest, const struct keys_section *section, const char *name);

/* NULL-terminated list of the names of the cases, in the forest. */
const char *const *family_names(struct forest *forest, const struct keys_section *section);

/* The same where one name is asked about: without modules of other names if there is this one, so that they need not be
 * loaded. */
const char *const *family_names_for(struct forest *forest, const struct keys_section *section, const char *name);

/* The preset value of a key of a module's case, as text; NULL if the preset does not exist. */
const char *family_preset(struct forest *forest, const struct bulla_module *module, const char *preset,
                          const char *key);

#endif
