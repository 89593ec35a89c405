/* vet.h - is a module's descriptor one that core can work with? */
#ifndef VET_H
#define VET_H

#include "base/text.h"
#include "bulla/limiter.h"
#include "bulla/module.h"

#include <stdbool.h>
#include <stddef.h>

/* Checks everything that core relies on: magic, interface number, sizes, kind, the functions of
 * the kind, names and texts, the parameter table and the presets. `space` is the size of the
 * symbol in the object file [bytes], 0 if unknown. Returns 0, or STATUS_CASE with a message
 * that is the end of a sentence about the file ("... has no function 'state'"). */
int vet_module(const struct bulla_module *module, size_t space);

/* Calls an instance once with harmless numbers: laws that give NaN even there are refused, because core's guard
 * would quietly replace what they say. STATUS_CASE with a whole sentence. `self` is what `open` made. */
int vet_instance(const struct bulla_module *module, const void *self);

/* How a case names a vetted module, with keys (", preset: water", ", ...") where its kind has a map: "scheme: {riemann:
 * hllc}". */
void vet_use(const struct bulla_module *module, const char *keys, struct text *text);

/* Has this limiter two sides? Tables from before there were flags have not. */
bool vet_two_sided(const struct bulla_limiter *table);

/* Is it for volume fractions of fluids alone? */
bool vet_surfaces(const struct bulla_limiter *table);

#endif
