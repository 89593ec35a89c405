/* h5in.h - reading attributes and data sets back. Numbers arrive as doubles. What is missing or
 * of another kind is STATUS_RUN with a message that names file and object. */
#ifndef H5IN_H
#define H5IN_H

#include "io/h5.h"

/* Is there an object at this path ("/VTKHDF/CellData")? */
bool h5in_has(struct h5 *file, const char *path);

/* Names of the objects of a group, sorted; release each and the list with mem_free. */
int h5in_names(struct h5 *file, const char *group, unsigned *ret_n, char ***ret_names);

/* Exactly n numbers of an attribute (a scalar counts as one). */
int h5in_attribute(struct h5 *file, const char *object, const char *name, unsigned n, double *ret_values);

/* A text attribute or text data set; release with mem_free. */
int h5in_attribute_text(struct h5 *file, const char *object, const char *name, char **ret_text);
int h5in_text(struct h5 *file, const char *path, char **ret_text);

/* Shape of a data set: columns 0 for [rows], else [rows, columns]. */
int h5in_shape(struct h5 *file, const char *path, size_t *ret_rows, unsigned *ret_columns);

/* A whole data set; `out` has room for its shape. */
int h5in_read(struct h5 *file, const char *path, double *out);

#endif
