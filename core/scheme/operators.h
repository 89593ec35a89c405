/* operators.h - which operators (operator.h) a scene has: a list like that of the terms, compiled once for each path.
 *
 * Stages, replays of dumps, the census and `bulla plan` walk it. A new operator is its two files and one line in
 * operators.c. */
#ifndef OPERATORS_H
#define OPERATORS_H

#include "phys/mix_pressure.h"
#include "scheme/operator.h"

enum { OPERATORS_MOST = 8 };

/* The list of one path, in the order in which they act. */
struct operators {
    unsigned n[OPERATOR_TIMES];
    const struct operator* at[OPERATOR_TIMES][OPERATORS_MOST];
    bool moves; /* some operator may change what rests */
    bool reads; /* some operator reads primitives */
    unsigned n_waiting;
    const struct operator* waiting[OPERATORS_MOST]; /* not on this path until they wake */
};

/* Every operator there is, in the order in which they act; ends with NULL. There is room for OPERATORS_MOST, to which
 * tests add theirs before a state is made. */
extern const struct operator* operators_all[OPERATORS_MOST + 1];

void operators_of(const struct model *path, struct operators *ret_operators);

/* Does some operator bring a material to tiles of this path, which lacks it? Then none has it (census.h). */
bool operators_spread(const struct model *path);

/* Does an operator that waits wake in one of n cells with primitives w at q * stride of `path`? */
bool operators_wake(const struct operators *operators, const struct model *path, size_t n, size_t stride,
                    const double *w);

/* The state of a tile after a stage; `last`: of the step. Primitives are made where an operator asks for them; w
 * then has the pressures `before` again: those from which a closure is iterated decide its last digits, which must not
 * depend on whether a path has such an operator. Returns what that took. */
struct mix_effort operators_act(const struct operators *operators, bool last, const struct operator_tile *tile);

/* The list for people, a line each: name, equation, owner. Nothing if the scene has none of this time. */
void operators_say(const struct model *model, enum operator_when when, struct text *text);

#endif
