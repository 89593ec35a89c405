/* h5out.c - see h5out.h.
 *
 * The compressed path: a data set is cut into chunks; whoever holds all rows of a chunk packs it and
 * sends it to rank 0, which files it as it is; pieces of a chunk that several ranks hold travel as
 * plain rows, and rank 0 packs it. So packing runs on all ranks at once, nobody holds more than his
 * own data set packed, and the bytes in the file do not depend on the ranks. All ranks know all
 * ranges, therefore who sends what, and rank 0 takes every message even after a failure.
 * The plain path (`hash`): for what will be read back at its place in the file. */
#include "io/h5out.h"

#include "base/comm.h"
#include "base/mem.h"
#include "base/status.h"
#include "io/chunk.h"

#include <hdf5.h>
#include <mpi.h>
#include <string.h>
#include <xxhash.h>

enum { H5OUT_TAG = 77, H5OUT_HEAD = 8 }; /* bytes before a packed chunk: which filters were left out */

/* A data set while it is written. */
struct h5out {
    const struct h5out_rows *rows;
    size_t row, chunk;    /* bytes of a row, rows of a chunk */
    unsigned n_range;     /* of all ranks */
    double (*ranges)[2];  /* first, count; the ranges of rank r are r * rows->n_range ... */
    char *plain, *packed; /* one chunk; packed: with its head */
};

/* What one rank holds of a chunk. */
struct h5out_piece {
    int rank;
    size_t first, count;
};

static hid_t h5out_layout(struct h5 *file, const struct h5out_rows *rows)
{
    hid_t layout = h5_check(file, H5Pcreate(H5P_DATASET_CREATE), "prepare a data set");
    h5_check(file, H5Pset_obj_track_times(layout, false), "prepare a data set");
    h5_check(file, H5Pset_fill_time(layout, H5D_FILL_TIME_NEVER), "prepare a data set");
    if (!rows->chunk || rows->hash) return layout;
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

static void h5out_begin(struct h5out *out, const struct h5out_rows *rows)
{
    *out = (struct h5out){.rows = rows, .row = h5_type_size(rows->type) * (rows->columns ? rows->columns : 1)};
    out->chunk = rows->chunk < rows->total ? rows->chunk : rows->total;
    out->n_range = rows->n_range * (unsigned)comm_size();
    out->ranges = mem_new(out->n_range, sizeof *out->ranges);
    out->plain = mem_new(out->chunk, out->row);
    out->packed = mem_new(out->chunk * out->row + H5OUT_HEAD, 1);
    double(*own)[2] = mem_new(rows->n_range, sizeof *own);
    for (unsigned i = 0; i < rows->n_range; i++) {
        own[i][0] = (double)rows->ranges[i].first;
        own[i][1] = (double)rows->ranges[i].count;
    }
    comm_join(*own, 2 * (int)rows->n_range, *out->ranges);
    mem_free(own);
}

static void h5out_end(struct h5out *out)
{
    mem_free(out->ranges);
    mem_free(out->plain);
    mem_free(out->packed);
}

/* Rows of a chunk; fewer in the last one. */
static size_t h5out_count(const struct h5out *out, size_t first)
{
    return out->rows->total - first < out->chunk ? out->rows->total - first : out->chunk;
}

/* The part of range `i` that lies in the chunk from row `first` on; count 0: none. */
static struct h5out_piece h5out_piece(const struct h5out *out, size_t first, unsigned i)
{
    size_t from = (size_t)out->ranges[i][0], to = from + (size_t)out->ranges[i][1];
    size_t end = first + h5out_count(out, first);
    from = from > first ? from : first;
    to = to < end ? to : end;
    return (struct h5out_piece){(int)(i / out->rows->n_range), from, to > from ? to - from : 0};
}

/* Packs the chunk in `plain`, with rows [0, count) in use, behind a head; returns the size of both. */
static size_t h5out_pack(struct h5out *out, size_t count)
{
    uint32_t skipped;
    memset(out->plain + count * out->row, 0, (out->chunk - count) * out->row);
    size_t size = chunk_pack(out->plain, out->chunk * out->row, h5_type_size(out->rows->type), out->packed + H5OUT_HEAD,
                             &skipped);
    memset(out->packed, 0, H5OUT_HEAD);
    memcpy(out->packed, &skipped, sizeof skipped);
    return size + H5OUT_HEAD;
}

/* Messages on their way to rank 0. */
struct h5out_mail {
    unsigned n;
    MPI_Request *requests;
    char **letters;
};

static void h5out_post(struct h5out_mail *mail, const char *bytes, size_t size)
{
    mail->requests = mem_grow(mail->requests, mail->n, mail->n + 1u, sizeof *mail->requests);
    mail->letters = mem_grow(mail->letters, mail->n, mail->n + 1u, sizeof *mail->letters);
    mail->letters[mail->n] = mem_new(size, 1);
    memcpy(mail->letters[mail->n], bytes, size);
    MPI_Isend(mail->letters[mail->n], (int)size, MPI_BYTE, 0, H5OUT_TAG, comm_world(), &mail->requests[mail->n]);
    mail->n++;
}

/* The part of a rank other than 0. */
static void h5out_send(struct h5out *out)
{
    struct h5out_mail mail = {0};
    for (size_t first = 0; first < out->rows->total; first += out->chunk)
        for (unsigned i = 0; i < out->n_range; i++) {
            struct h5out_piece piece = h5out_piece(out, first, i);
            if (!piece.count || piece.rank != comm_rank()) continue;
            out->rows->fill(out->rows->context, piece.first, piece.count, out->plain);
            bool whole = piece.count == h5out_count(out, first);
            size_t size = whole ? h5out_pack(out, piece.count) : piece.count * out->row;
            h5out_post(&mail, whole ? out->packed : out->plain, size);
        }
    comm_wait((int)mail.n, mail.requests, MPI_STATUSES_IGNORE);
    for (unsigned i = 0; i < mail.n; i++) mem_free(mail.letters[i]);
    mem_free(mail.letters);
    mem_free(mail.requests);
}

/* Receives from a rank into `to`, which has room; returns the size. */
static size_t h5out_receive(int rank, void *to, size_t room)
{
    MPI_Status status;
    MPI_Request request;
    int size = 0;
    MPI_Irecv(to, (int)room, MPI_BYTE, rank, H5OUT_TAG, comm_world(), &request);
    comm_wait(1, &request, &status);
    MPI_Get_count(&status, MPI_BYTE, &size);
    return (size_t)size;
}

/* Brings a chunk together on rank 0, packed; returns its size with head. */
static size_t h5out_gather(struct h5out *out, size_t first)
{
    size_t count = h5out_count(out, first);
    for (unsigned i = 0; i < out->n_range; i++) {
        struct h5out_piece piece = h5out_piece(out, first, i);
        if (!piece.count) continue;
        char *to = out->plain + (piece.first - first) * out->row;
        if (piece.rank == 0) out->rows->fill(out->rows->context, piece.first, piece.count, to);
        else if (piece.count < count) h5out_receive(piece.rank, to, piece.count * out->row);
        else return h5out_receive(piece.rank, out->packed, out->chunk * out->row + H5OUT_HEAD);
    }
    return h5out_pack(out, count);
}

/* The part of rank 0. */
static void h5out_store(struct h5 *file, hid_t set, struct h5out *out, const char *path)
{
    for (size_t first = 0; first < out->rows->total; first += out->chunk) {
        uint32_t skipped;
        hsize_t at[2] = {first, 0};
        size_t size = h5out_gather(out, first) - H5OUT_HEAD;
        memcpy(&skipped, out->packed, sizeof skipped);
        if (file->code) continue; /* the others go on sending */
        h5_check(file, H5Dwrite_chunk(set, H5P_DEFAULT, skipped, at, size, out->packed + H5OUT_HEAD), path);
    }
}

/* Rows that are stored as they are go chunk by chunk in the order of the file, and nobody copies his part of
 * them whole: rank 0 takes one message after the other, and the others wait for it. */
static void h5out_send_plain(struct h5out *out)
{
    for (size_t first = 0; first < out->rows->total; first += out->chunk)
        for (unsigned i = 0; i < out->n_range; i++) {
            struct h5out_piece piece = h5out_piece(out, first, i);
            if (!piece.count || piece.rank != comm_rank()) continue;
            out->rows->fill(out->rows->context, piece.first, piece.count, out->plain);
            MPI_Request request;
            MPI_Isend(out->plain, (int)(piece.count * out->row), MPI_BYTE, 0, H5OUT_TAG, comm_world(), &request);
            comm_wait(1, &request, MPI_STATUSES_IGNORE);
        }
}

/* Brings a chunk together on rank 0 as it is. */
static void h5out_gather_plain(struct h5out *out, size_t first)
{
    for (unsigned i = 0; i < out->n_range; i++) {
        struct h5out_piece piece = h5out_piece(out, first, i);
        char *to = out->plain + (piece.first - first) * out->row;
        if (!piece.count) continue;
        if (piece.rank == 0) out->rows->fill(out->rows->context, piece.first, piece.count, to);
        else h5out_receive(piece.rank, to, piece.count * out->row);
    }
}

static void h5out_store_plain(struct h5 *file, hid_t set, struct h5out *out, const char *path)
{
    XXH64_state_t *sum = XXH64_createState();
    XXH64_reset(sum, 0);
    for (size_t first = 0; first < out->rows->total; first += out->chunk) {
        size_t count = h5out_count(out, first);
        h5out_gather_plain(out, first);
        if (file->code) continue; /* the others go on sending */
        XXH64_update(sum, out->plain, count * out->row);
        hid_t memory = h5out_space(file, count, out->rows->columns), space = h5_check(file, H5Dget_space(set), path);
        hsize_t start[2] = {first, 0}, extent[2] = {count, out->rows->columns};
        h5_check(file, H5Sselect_hyperslab(space, H5S_SELECT_SET, start, NULL, extent, NULL), path);
        h5_check(file, H5Dwrite(set, h5_type_id(out->rows->type), memory, space, H5P_DEFAULT, out->plain), path);
        if (memory >= 0) H5Sclose(memory);
        if (space >= 0) H5Sclose(space);
    }
    *out->rows->hash = XXH64_digest(sum);
    XXH64_freeState(sum);
}

int h5out_write(struct h5 *file, const char *path, const struct h5out_rows *rows)
{
    struct h5out out;
    TRY(comm_agree(file->code));
    h5out_begin(&out, rows);
    if (file->idle) {
        (rows->hash ? h5out_send_plain : h5out_send)(&out);
    } else {
        hid_t layout = h5out_layout(file, rows), space = h5out_space(file, rows->total, rows->columns);
        hid_t set =
            h5_check(file, H5Dcreate2(file->id, path, h5_type_id(rows->type), space, H5P_DEFAULT, layout, H5P_DEFAULT),
                     path);
        (rows->hash ? h5out_store_plain : h5out_store)(file, set, &out, path);
        if (set >= 0) h5_check(file, H5Dclose(set), path);
        if (space >= 0) H5Sclose(space);
        if (layout >= 0) H5Pclose(layout);
    }
    h5out_end(&out);
    return STATUS_OK;
}

/* Writes a whole data set of type id[0] and space id[1]; closes the space. */
static void h5out_whole(struct h5 *file, const char *path, const hid_t id[2], const void *values)
{
    hid_t layout = h5out_layout(file, &(struct h5out_rows){0});
    hid_t set = h5_check(file, H5Dcreate2(file->id, path, id[0], id[1], H5P_DEFAULT, layout, H5P_DEFAULT), path);
    h5_check(file, H5Dwrite(set, id[0], H5S_ALL, H5S_ALL, H5P_DEFAULT, values), path);
    if (set >= 0) h5_check(file, H5Dclose(set), path);
    if (layout >= 0) H5Pclose(layout);
    if (id[1] >= 0) H5Sclose(id[1]);
}

void h5out_array(struct h5 *file, const char *path, enum h5_type type, size_t n, unsigned columns, const void *values)
{
    if (file->idle) return;
    h5out_whole(file, path, (hid_t[2]){h5_type_id(type), h5out_space(file, n, columns)}, values);
}

void h5out_records(struct h5 *file, const char *path, const char *const *members, unsigned n, size_t n_row,
                   const int32_t *values)
{
    if (file->idle) return;
    hid_t type = h5_record_type(file, members, n);
    h5out_whole(file, path, (hid_t[2]){type, h5out_space(file, n_row, 0)}, values);
    if (type >= 0) H5Tclose(type);
}

void h5out_text(struct h5 *file, const char *path, const char *text)
{
    if (file->idle) return;
    hid_t type = h5_string_type(file, text, strlen(text));
    h5out_whole(file, path, (hid_t[2]){type, h5_check(file, H5Screate(H5S_SCALAR), path)}, text);
    if (type >= 0) H5Tclose(type);
}

void h5out_place(struct h5 *file, const char *path, uint64_t *ret_offset, uint64_t *ret_length)
{
    if (file->idle) return;
    hid_t set = h5_check(file, H5Dopen2(file->id, path, H5P_DEFAULT), path);
    haddr_t offset = set >= 0 ? H5Dget_offset(set) : HADDR_UNDEF;
    h5_check(file, offset == HADDR_UNDEF ? -1 : 0, path);
    *ret_offset = (uint64_t)offset;
    *ret_length = set >= 0 ? (uint64_t)H5Dget_storage_size(set) : 0;
    if (set >= 0) H5Dclose(set);
}

void h5out_unit(struct h5 *file, const char *path, const char *unit)
{
    h5_attribute_text(file, path, "units", unit);
}

/* Column q of a view with Q columns: block q of every group of Q blocks, from `to` on <- a run of the source. */
static void h5out_map(struct h5 *file, const hid_t id[2], const struct h5out_view *view, const struct h5out_groups *run,
                      size_t to, unsigned q)
{
    const struct h5out_column *column = &view->columns[q];
    hid_t layout = id[0], space = id[1], source = h5out_space(file, view->total, column->columns);
    hsize_t start[2] = {run->first, column->column}, extent[2] = {run->group * run->n_group, 1};
    h5_check(file, H5Sselect_hyperslab(source, H5S_SELECT_SET, start, NULL, extent, NULL), "map a view");
    hsize_t block = run->group, at = to + q * block, stride = view->n_column * block, n_group = run->n_group;
    h5_check(file, H5Sselect_hyperslab(space, H5S_SELECT_SET, &at, &stride, &n_group, &block), "map a view");
    h5_check(file, H5Pset_virtual(layout, space, ".", column->path, source), "map a view");
    if (source >= 0) H5Sclose(source);
}

void h5out_interleave(struct h5 *file, const char *path, const struct h5out_view *view)
{
    if (file->idle) return;
    size_t size = 0, to = 0;
    for (unsigned i = 0; i < view->n_run; i++) size += view->runs[i].n_group * view->runs[i].group * view->n_column;
    hid_t layout = h5_check(file, H5Pcreate(H5P_DATASET_CREATE), "prepare a view");
    hid_t space = h5out_space(file, size, 0);
    for (unsigned i = 0; i < view->n_run; i++) {
        const struct h5out_groups *run = &view->runs[i];
        for (unsigned q = 0; run->n_group && q < view->n_column; q++)
            h5out_map(file, (const hid_t[2]){layout, space}, view, run, to, q);
        to += run->n_group * run->group * view->n_column;
    }
    hid_t set =
        h5_check(file, H5Dcreate2(file->id, path, h5_type_id(view->type), space, H5P_DEFAULT, layout, H5P_DEFAULT),
                 path);
    if (set >= 0) H5Dclose(set);
    if (space >= 0) H5Sclose(space);
    if (layout >= 0) H5Pclose(layout);
}
