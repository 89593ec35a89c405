/* h5view.c - see h5view.h. */
#include "io/h5view.h"

#include <hdf5.h>

static hid_t h5view_space(struct h5 *file, size_t rows, unsigned columns)
{
    hsize_t extent[2] = {rows, columns};
    return h5_check(file, H5Screate_simple(columns ? 2 : 1, extent, NULL), "shape a data set");
}

/* Column q of a view with Q columns: block q of every group of Q blocks, from `to` on <- a run of the source. */
static void h5view_map(struct h5 *file, const hid_t id[2], const struct h5view *view, const struct h5view_groups *run,
                       size_t to, unsigned q)
{
    const struct h5view_column *column = &view->columns[q];
    hid_t layout = id[0], space = id[1], source = h5view_space(file, view->total, column->columns);
    hsize_t start[2] = {run->first, column->column}, extent[2] = {run->group * run->n_group, 1};
    h5_check(file, H5Sselect_hyperslab(source, H5S_SELECT_SET, start, NULL, extent, NULL), "map a view");
    hsize_t block = run->group, at = to + q * block, stride = view->n_column * block, n_group = run->n_group;
    h5_check(file, H5Sselect_hyperslab(space, H5S_SELECT_SET, &at, &stride, &n_group, &block), "map a view");
    h5_check(file, H5Pset_virtual(layout, space, ".", column->path, source), "map a view");
    if (source >= 0) H5Sclose(source);
}

void h5view_write(struct h5 *file, const char *path, const struct h5view *view)
{
    if (file->idle) return;
    size_t size = 0, to = 0;
    for (unsigned i = 0; i < view->n_run; i++) size += view->runs[i].n_group * view->runs[i].group * view->n_column;
    hid_t layout = h5_check(file, H5Pcreate(H5P_DATASET_CREATE), "prepare a view");
    hid_t space = h5view_space(file, size, 0);
    for (unsigned i = 0; i < view->n_run; i++) {
        const struct h5view_groups *run = &view->runs[i];
        for (unsigned q = 0; run->n_group && q < view->n_column; q++)
            h5view_map(file, (const hid_t[2]){layout, space}, view, run, to, q);
        to += run->n_group * run->group * view->n_column;
    }
    hid_t set =
        h5_check(file, H5Dcreate2(file->id, path, h5_type_id(view->type), space, H5P_DEFAULT, layout, H5P_DEFAULT),
                 path);
    if (set >= 0) H5Dclose(set);
    if (space >= 0) H5Sclose(space);
    if (layout >= 0) H5Pclose(layout);
}
