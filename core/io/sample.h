/* sample.h - fields at points, interpolated between cells: what probes and maps along lines record.
 *
 * Values are linear along each axis between the centres of the cells around the point, across tiles and ranks; beyond
 * the last centre before a boundary they stay constant, across a periodic boundary they go on. These cells are those of
 * the finest level at the point, or, where that ends beside it, of the next coarser one, which holds averages under
 * finer cells: always cells of one level, so second order and within their range. A field that belongs to a material
 * (derive_material) counts with its volume fraction; where none of the cells has the material it is 0. */
#ifndef SAMPLE_H
#define SAMPLE_H

#include "derive/derive.h"
#include "solve/state.h"

struct sample;

/* For n points, which are copied. */
struct sample *sample_new(const struct mesh *mesh, unsigned n, const double (*at)[3]);
void sample_free(struct sample *sample); /* NULL is fine */

/* Numbers that a field needs per point. */
unsigned sample_room(const struct sample *sample, const struct derive *field);

/* Collects a field (prepared for the present time) at `n` points from `first` on, as far as this rank holds their
 * cells, into parts[n][sample_room], after which the largest of all ranks is to be taken of each (comm_max). */
void sample_collect(struct sample *sample, const struct state *state, const struct derive *field, unsigned first,
                    unsigned n, double *parts);

/* The values at these points out of the parts of all ranks: component q of point i at ret_values[i * stride + q]. */
void sample_blend(const struct sample *sample, const struct derive *field, unsigned first, unsigned n,
                  const double *parts, unsigned stride, double *ret_values);

#endif
