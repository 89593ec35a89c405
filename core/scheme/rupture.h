/* rupture.h - solids break, after each step and behind plastic flow: damage grows (phys/damage.h), and where a broken
 * solid is in tension a void opens in it (phys/cavity.h).
 *
 * Both act cell by cell at constant mass, momentum and total energy, and on the step that is accepted only: a step that
 * is taken again does not count twice. */
#ifndef RUPTURE_H
#define RUPTURE_H

#include "scheme/operator.h"

extern const struct operator rupture_operator;

#endif
