/* flow.h - super time steps of what diffuses where there are finer levels or several materials: `scheme: {diffusion:
 * rkl2}`.
 *
 * A step of level 0 becomes D(dt/2) H(dt) D(dt/2) (Strang): H takes all levels through dt with every term that does not
 * diffuse, as ever (advance.c), D all levels together through half of it, without steps of their own. Each of the s
 * stages of RKL2 (rkl.h) has its ghosts from the coarser level, at the faces between levels the fluxes of the finer
 * one, and ends with the averages of the finer level: so it is one operator over all leaves, conservative and stable
 * with the pace of its fastest cell. Corrections after steps of each level were not (docs/decisions/super-steps.md).
 *
 * Several materials: masses stay, and what flows is the heat of each material, in the rows of the fractions, beside
 * momentum and energy. Of each stage phys/warm.h makes the fractions, from the state that the flow began with.
 *
 * RKL2 is off by tau^3 M^3 u/18, which is much where a front spreads by its own width in a flow. One whose change bends
 * too much halfway is undone, and taken in as many parts as keep that small; s falls with the root of their number.
 * Both flows of a step have as many.
 *
 * u_new, free between steps, keeps what a flow begins from: one that leaves cells inadmissible is undone and taken in
 * two halves. H begins from what D has left, and is never undone beyond that. */
#ifndef FLOW_H
#define FLOW_H

#include "solve/state.h"

/* Does a step dt of level 0 need it: has the scene rkl2 and finer levels or several materials, and is dt, on some
 * level, more than its integrator bears of what diffuses? Collective. */
bool flow_binds(const struct state *state, double dt);

/* What diffuses, on all levels, from t through tau; then primitives, judgement and signals of all. *parts: in how many
 * parts; 0 before the first flow of a step, which finds it. STATUS_RUN: cells stay inadmissible in short flows, too.
 * Collective. */
int flow_take(struct state *state, double t, double tau, int *parts);

#endif
