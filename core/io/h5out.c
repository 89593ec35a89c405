/* h5out.c - see h5out.h.
 *
 * Compressed data sets under MPI-IO (HDF5 1.10) have rules of their own: all ranks join every
 * write, also with nothing to write; the type in memory is the type in the file; and nothing
 * is filled in beforehand (a half-written chunk would be read back as if compressed). A chunk
 * is therefore written by one call, and a rank alone in the world may cut its rows into runs
 * of whole chunks, which bounds the memory that writing takes. */
#include "io/h5out.h"

#include "base/comm.h"
#include "base/mem.h"

#include <hdf5.h>
#include <string.h>

enum { H5OUT_RUN = 4 << 20 }; /* bytes of a run, about */

static hid_t h5out_layout(struct h5 *file, const struct h5out_rows *rows)
{
    hid_t layout = h5_check(file, H5Pcreate(H5P_DATASET_CREATE), "prepare a data set");
    h5_check(file, H5Pset_obj_track_times(layout, false), "prepare a data set");
    h5_check(file, H5Pset_fill_time(layout, H5D_FILL_TIME_NEVER), "prepare a data set");
    if (!rows->chunk) return layout;
    hsize_t chunk[2] = {rows->chunk < rows->total ? rows->chunk : rows->total, rows->columns};
    h5_check(file, H5Pset_chunk(layout, rows->columns ? 2 : 1, chunk), "set the chunks of a data set");
    h5_check(file, H5Pset_shuffle(layout), "set the compression of a data set");
    h5_check(file, H5Pset_deflate(layout, 1), "set the compression of a data set");
    return layout;
}

static hid_t h5out_space(struct h5 *file, size_t rows, unsigned columns)
{
    hsize_t extent[2] = {rows, columns};
    return h5_check(file, H5Screate_simple(columns ? 2 : 1, extent, NULL), "shape a data set");
}

static hid_t h5out_transfer(struct h5 *file)
{
    hid_t transfer = h5_check(file, H5Pcreate(H5P_DATASET_XFER), "prepare a transfer");
    if (file->shared) h5_check(file, H5Pset_dxpl_mpio(transfer, H5FD_MPIO_COLLECTIVE), "prepare a collective transfer");
    return transfer;
}

/* Selects the rows of some ranges; returns how many. */
static size_t h5out_select(struct h5 *file, hid_t space, const struct h5out_range *ranges, unsigned n, unsigned columns)
{
    size_t rows = 0;
    h5_check(file, H5Sselect_none(space), "address rows");
    for (unsigned i = 0; i < n; i++) {
        if (!ranges[i].count) continue;
        hsize_t start[2] = {ranges[i].first, 0}, extent[2] = {ranges[i].count, columns};
        H5S_seloper_t how = rows ? H5S_SELECT_OR : H5S_SELECT_SET;
        h5_check(file, H5Sselect_hyperslab(space, how, start, NULL, extent, NULL), "address rows");
        rows += ranges[i].count;
    }
    return rows;
}

/* Writes the rows of some ranges, lying one after the other in `in`, to an open data set. */
static void h5out_put(struct h5 *file, hid_t set, const struct h5out_rows *rows, const struct h5out_range *ranges,
                      unsigned n, const void *in)
{
    hid_t where = h5_check(file, H5Dget_space(set), "address a data set");
    size_t count = h5out_select(file, where, ranges, n, rows->columns);
    hid_t memory = h5out_space(file, count ? count : 1, rows->columns), transfer = h5out_transfer(file);
    if (!count) h5_check(file, H5Sselect_none(memory), "address rows");
    h5_check(file, H5Dwrite(set, h5_type_id(rows->type), memory, where, transfer, in), "write data");
    H5Pclose(transfer);
    H5Sclose(memory);
    H5Sclose(where);
}

/* Bytes of a row. */
static size_t h5out_row(const struct h5out_rows *rows)
{
    return h5_type_size(rows->type) * (rows->columns ? rows->columns : 1);
}

/* All rows of this rank in one collective write. */
static void h5out_fill_shared(struct h5 *file, hid_t set, const struct h5out_rows *rows)
{
    size_t count = 0, row = h5out_row(rows);
    for (unsigned i = 0; i < rows->n_range; i++) count += rows->ranges[i].count;
    char *buffer = mem_new(count + 1, row), *at = buffer;
    for (unsigned i = 0; i < rows->n_range; i++) {
        if (rows->ranges[i].count) rows->fill(rows->context, rows->ranges[i].first, rows->ranges[i].count, at);
        at += rows->ranges[i].count * row;
    }
    h5out_put(file, set, rows, rows->ranges, rows->n_range, buffer);
    mem_free(buffer);
}

/* Run by run of whole chunks. */
static void h5out_fill_alone(struct h5 *file, hid_t set, const struct h5out_rows *rows)
{
    size_t row = h5out_row(rows), chunk = rows->chunk ? rows->chunk : 1, chunks = H5OUT_RUN / (chunk * row);
    size_t most = chunk * (chunks ? chunks : 1);
    if (most > rows->total) most = rows->total;
    char *buffer = mem_new(most, row);
    for (unsigned i = 0; i < rows->n_range; i++) {
        size_t end = rows->ranges[i].first + rows->ranges[i].count;
        for (size_t first = rows->ranges[i].first; first < end && !file->code;) {
            size_t stop = first + most - first % chunk; /* runs end where a chunk ends */
            struct h5out_range run = {first, (stop < end ? stop : end) - first};
            if (run.count > most) run.count = most;
            rows->fill(rows->context, run.first, run.count, buffer);
            h5out_put(file, set, rows, &run, 1, buffer);
            first += run.count;
        }
    }
    mem_free(buffer);
}

int h5out_write(struct h5 *file, const char *path, const struct h5out_rows *rows)
{
    hid_t layout = h5out_layout(file, rows), space = h5out_space(file, rows->total, rows->columns);
    hid_t set =
        h5_check(file, H5Dcreate2(file->id, path, h5_type_id(rows->type), space, H5P_DEFAULT, layout, H5P_DEFAULT),
                 path);
    int code = h5_outcome(file);
    if (!code && file->shared) h5out_fill_shared(file, set, rows);
    if (!code && !file->shared) h5out_fill_alone(file, set, rows);
    if (set >= 0) h5_check(file, H5Dclose(set), path);
    if (space >= 0) H5Sclose(space);
    if (layout >= 0) H5Pclose(layout);
    return h5_outcome(file);
}

struct h5out_copy {
    const char *from;
    size_t row; /* bytes */
};

static void h5out_copy(void *context, size_t first, size_t count, void *out)
{
    const struct h5out_copy *copy = context;
    memcpy(out, copy->from + first * copy->row, count * copy->row);
}

int h5out_array(struct h5 *file, const char *path, enum h5_type type, size_t n, unsigned columns, const void *values)
{
    struct h5out_copy copy = {values, h5_type_size(type) * (columns ? columns : 1)};
    struct h5out_range all = {0, n};
    struct h5out_rows rows = {.type = type,
                              .columns = columns,
                              .total = n,
                              .n_range = comm_rank() == 0,
                              .ranges = &all,
                              .fill = h5out_copy,
                              .context = &copy};
    return h5out_write(file, path, &rows);
}

/* Writes a data set of a type of its own from rank 0 and closes type and space. */
static int h5out_whole(struct h5 *file, const char *path, const hid_t id[2], const void *values)
{
    hid_t layout = h5out_layout(file, &(struct h5out_rows){0});
    hid_t set = h5_check(file, H5Dcreate2(file->id, path, id[0], id[1], H5P_DEFAULT, layout, H5P_DEFAULT), path);
    int code = h5_outcome(file);
    hid_t memory = h5_check(file, H5Scopy(id[1]), path), transfer = h5out_transfer(file);
    if (comm_rank() != 0) h5_check(file, H5Sselect_none(memory), path);
    if (!code) h5_check(file, H5Dwrite(set, id[0], memory, memory, transfer, values), path);
    if (set >= 0) h5_check(file, H5Dclose(set), path);
    H5Pclose(transfer);
    H5Sclose(memory);
    H5Pclose(layout);
    H5Sclose(id[1]);
    H5Tclose(id[0]);
    return h5_outcome(file);
}

int h5out_records(struct h5 *file, const char *path, const char *const *members, unsigned n, size_t n_row,
                  const int32_t *values)
{
    hid_t type = h5_record_type(file, members, n);
    return h5out_whole(file, path, (hid_t[2]){type, h5out_space(file, n_row, 0)}, values);
}

int h5out_text(struct h5 *file, const char *path, const char *text)
{
    hid_t type = h5_string_type(file, text, strlen(text));
    return h5out_whole(file, path, (hid_t[2]){type, h5_check(file, H5Screate(H5S_SCALAR), path)}, text);
}

int h5out_unit(struct h5 *file, const char *path, const char *unit)
{
    return h5_attribute_text(file, path, "units", unit);
}

/* Column q of a view with Q columns: block q of every group of Q blocks <- a run of the source. */
static void h5out_map(struct h5 *file, hid_t layout, hid_t space, const struct h5out_view *view, unsigned q)
{
    const struct h5out_column *column = &view->columns[q];
    hid_t source = h5out_space(file, view->total, column->columns);
    hsize_t start[2] = {view->first, column->column}, extent[2] = {view->group * view->n_group, 1};
    h5_check(file, H5Sselect_hyperslab(source, H5S_SELECT_SET, start, NULL, extent, NULL), "map a view");
    hsize_t block = view->group, at = q * block, stride = view->n_column * block, n_group = view->n_group;
    h5_check(file, H5Sselect_hyperslab(space, H5S_SELECT_SET, &at, &stride, &n_group, &block), "map a view");
    h5_check(file, H5Pset_virtual(layout, space, ".", column->path, source), "map a view");
    if (source >= 0) H5Sclose(source);
}

int h5out_interleave(struct h5 *file, const char *path, const struct h5out_view *view)
{
    hid_t layout = h5_check(file, H5Pcreate(H5P_DATASET_CREATE), "prepare a view");
    hid_t space = h5out_space(file, view->n_group * view->group * view->n_column, 0);
    for (unsigned q = 0; q < view->n_column; q++) h5out_map(file, layout, space, view, q);
    hid_t set =
        h5_check(file, H5Dcreate2(file->id, path, h5_type_id(view->type), space, H5P_DEFAULT, layout, H5P_DEFAULT),
                 path);
    if (set >= 0) H5Dclose(set);
    if (space >= 0) H5Sclose(space);
    if (layout >= 0) H5Pclose(layout);
    return h5_outcome(file);
}
