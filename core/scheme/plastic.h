/* plastic.h - plastic flow of solids, after each step: F(dt) A(dt) with A the step of the terms (Lie splitting).
 *
 * A moves the stretch as if the solid were elastic; F puts it back to where the stress is the strength of the law
 * (phys/flow.h), at constant mass, momentum and total energy: the elastic energy that goes is heat. F is a projection
 * for laws that do not know rates; for those that do it is backward Euler. The midpoint rule looks at a state in the
 * middle of A: F acts there as well, else the stress that does the work of a step would be beyond the strength by half
 * of what the step overshoots. Any return is of first order in the strain of a step (docs/numerics.md, 6b). */
#ifndef PLASTIC_H
#define PLASTIC_H

#include "scheme/operator.h"

extern const struct operator plastic_operator, plastic_between_operator;

#endif
