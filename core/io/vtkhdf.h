/* vtkhdf.h - the group /VTKHDF of a plot file: what ParaView and VTK read.
 *
 * Format: VTK file formats, "VTKHDF", version 1.0, UnstructuredGrid, one part. */
#ifndef VTKHDF_H
#define VTKHDF_H

#include "derive/derive.h"
#include "io/h5.h"
#include "io/leaves.h"
#include "solve/state.h"

/* Which fields, and float64 or float32. */
struct vtkhdf_fields {
    unsigned n;
    const struct derive *at; /* prepared for the state's time */
    enum h5_type type;       /* H5_F32 or H5_F64 */
};

/* Writes the group. More cells than 32-bit numbers can connect are STATUS_RUN. Collective. */
int vtkhdf_write(struct h5 *file, const struct state *state, const struct leaves *leaves,
                 const struct vtkhdf_fields *fields);

#endif
