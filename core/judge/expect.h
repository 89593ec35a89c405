/* expect.h - does a run show what its case says it must? Evaluates `expect:` of a scene from the
 * files of an output directory, so that it can be repeated at any time without a new run.
 *
 * This folder, judge: is a run right? Norms, exact solutions, expectations. */
#ifndef EXPECT_H
#define EXPECT_H

#include "case/scene.h"

/* Judges all expectations of a finished run: prints a table (what, value, bound, pass or fail) to
 * stdout unless `quiet`, writes expect.json into `directory`, and returns STATUS_EXPECT if one
 * fails; a value that is not finite fails, and so does one that cannot be had from these files (a warning says why,
 * with the line of the case). A scene without expectations passes silently. STATUS_CASE: a norm or reference that makes
 * no sense, with the line of the case file; STATUS_RUN: files that cannot be read or written. Only rank 0 works;
 * collective. */
int expect_judge(const struct scene *scene, const char *directory, bool quiet);

/* The value of an expression (case/formula.h) over the files of a run. Of this process alone. */
int expect_formula(const struct scene *scene, const char *directory, const char *text, double *ret_value);

#endif
