/* trace.h - one column of a run over time. */
#ifndef TRACE_H
#define TRACE_H

#include <stddef.h>

struct trace {
    size_t n;
    const double *t, *v; /* [n]; times do not descend */
};

#endif
