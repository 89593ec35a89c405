/* verdict.h - a tile whose conserved fields are new: its primitives, the guard's judgement, the signal that sets the
 * step. */
#ifndef VERDICT_H
#define VERDICT_H

#include "solve/stage.h"

/* Keeps the pressures w of a tile from before what is judged next, in the rates, which are free between stages: for who
 * asks how far they have gone (soften.h), and for operators that put their own there (operators.h). To be called before
 * these. */
void verdict_hold(struct stage *stage, unsigned local, const double *w);

/* Iterated pressures of a tile start anew, not from what w holds: a failed attempt, of which every rank has done as
 * much as it did, and what a tile held before it slept would show in their last digits. */
void verdict_forget(struct stage *stage, unsigned local);

/* Primitives of u, into w, made with the path the tile was advanced with, and the guard's judgement as stage `judged`;
 * `before`: an earlier admissible state. */
void verdict_judge(struct stage *stage, unsigned local, int judged, const double *before, double *u, double *w);

/* Signal of the tile that was judged last: its speeds are in the work space. */
void verdict_measure(struct stage *stage, unsigned local, const double *w);

/* The largest signal of the tiles, anew. */
void verdict_survey(struct stage *stage);

/* The largest signal of what stands behind boundaries of this rank's tiles at time t, where boundaries bring states of
 * their own; 0 without any. Between stages. */
double verdict_ahead(struct stage *stage, double t);

/* Tile `local` after its u_old was changed from outside (averages, refluxing; u_new holds an earlier admissible
 * state): primitives, the guard's judgement as the last stage, signal. */
void verdict_touch(struct stage *stage, unsigned local);

/* w = primitives of u_old: before the first step and before a step is repeated. */
void verdict_reset(struct stage *stage);

/* An initial state in u_old: primitives, judgement, signal. Nothing is repaired but cells in which a solid pulls on a
 * fluid more than that bears, with one traction; their number is added. STATUS_CASE: inadmissible. relaxed: NULL before
 * there are normals (normals.h): nothing is judged yet. Not collective. */
int verdict_start(struct stage *stage, long long *relaxed);

/* A tile whose primitives are there, from another rank or just made: census and signal. */
void verdict_welcome(struct stage *stage, unsigned local);

#endif
