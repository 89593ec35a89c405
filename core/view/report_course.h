/* report_course.h - pictures of a run's snapshots one after the other, to step through. */
#ifndef REPORT_COURSE_H
#define REPORT_COURSE_H

#include "base/text.h"
#include "io/read.h"
#include "view/plot_option.h"

/* A section with up to 24 snapshots, evenly chosen, the first and the last among them, on one scale: the pressure of
 * planes (or else the first field), all fields of lines. Nothing for fewer than two. `mirrored`: options for
 * axisymmetric planes. */
int report_course_add(struct text *page, const struct snapshot_series *series, const struct plot_option *plain,
                      const struct plot_option *mirrored);

#endif
