/* vet_try.h - one call of an instance with harmless numbers, by kind: does it give any sense? `table`: the functions of
 * the module, vetted; `self`: what its `open` made. */
#ifndef VET_TRY_H
#define VET_TRY_H

#include <stdbool.h>

bool vet_try_limiter(const void *table, const void *self);
bool vet_try_reconstruction(const void *table, const void *self);
bool vet_try_riemann(const void *table, const void *self);
bool vet_try_constitutive(const void *table, const void *self);
bool vet_try_inelastic(const void *table, const void *self);
bool vet_try_damage(const void *table, const void *self);
bool vet_try_coefficient(const void *table, const void *self);
bool vet_try_boundary(const void *table, const void *self);
bool vet_try_field(const void *table, const void *self);

#endif
