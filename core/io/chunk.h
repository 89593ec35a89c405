/* chunk.h - one chunk of a data set, compressed as HDF5's filters shuffle and deflate (level 1) do it, but by
 * the rank that has the numbers. */
#ifndef CHUNK_H
#define CHUNK_H

#include <stddef.h>
#include <stdint.h>

/* Packs `n` bytes of elements of `element` bytes; `out` has room for n bytes. Returns the packed size;
 * *ret_skipped: the filters that were left out, as bits (deflate is, where it gains nothing). */
size_t chunk_pack(const void *in, size_t n, size_t element, void *out, uint32_t *ret_skipped);

#endif
