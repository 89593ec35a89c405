/* vtkhdf.h - the group /VTKHDF of a plot file: what ParaView and VTK read.
 *
 * Format: VTK file formats, "VTKHDF", version 1.0, UnstructuredGrid, one part. */
#ifndef VTKHDF_H
#define VTKHDF_H

#include "derive/derive.h"
#include "io/h5out.h"
#include "io/leaves.h"
#include "solve/state.h"

/* Which fields, and float64 or float32. */
struct vtkhdf_fields {
    unsigned n;
    const struct derive *at; /* prepared for the state's time */
    enum h5_type type;       /* H5_F32 or H5_F64 */
};

/* The cells of a mesh, points and connections, as the files before had them: they are made and packed anew only where
 * the mesh has changed. Start from {0}. */
struct vtkhdf_cells {
    size_t most; /* bytes of them, not packed, that a writer may keep packed in memory; with more, all are made anew */
    unsigned revision; /* what is kept is of this one of the mesh */
    bool is_kept;
    struct nodes *nodes; /* NULL: there was no file yet */
    struct h5out_kept points, connectivity, offsets, types;
};
void vtkhdf_forget(struct vtkhdf_cells *cells);

/* Writes the group. More cells than 32-bit numbers can connect are STATUS_RUN. Collective. */
int vtkhdf_write(struct h5 *file, const struct state *state, const struct leaves *leaves,
                 const struct vtkhdf_fields *fields, struct vtkhdf_cells *cells);

#endif
