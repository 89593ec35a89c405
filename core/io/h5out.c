/* h5out.c - see h5out.h.
 *
 * The compressed path: a data set is cut into chunks; whoever holds most rows of a chunk gets the others as plain
 * rows, packs it and sends it to its writer, which files it as it is. So packing runs on all ranks at once, nobody
 * holds more than his own data set packed, and the bytes in the file do not depend on the ranks. All that have rows of
 * a chunk know who else has (portions.h), therefore who sends what, and a writer takes every message even after a
 * failure. With several writers each has a file with its rows alone, in their order, and rank 0 makes the view that
 * unites them. The plain path (`hash`): for what will be read back at its place in the file. */
#include "io/h5out.h"

#include "base/comm.h"
#include "base/mem.h"
#include "base/status.h"
#include "io/chunk.h"
#include "io/portions.h"
#include "io/writers.h"

#include <hdf5.h>
#include <math.h>
#include <mpi.h>
#include <stdlib.h>
#include <string.h>
#include <xxhash.h>

enum { H5OUT_TAG = 77, H5OUT_HEAD = 8 }; /* bytes before a packed chunk: which filters were left out */

/* Messages on their way. */
struct h5out_mail {
    unsigned n;
    MPI_Request *requests;
    char **letters;
};

/* A data set while it is written; rows are numbered as in the file of their writer. */
struct h5out {
    const struct h5out_rows *rows;
    bool is_plain;    /* rows are stored as they are */
    unsigned columns; /* of the data set's shape; 0: none */
    hid_t type;       /* of a number, or a record; of a writer */
    size_t row;       /* bytes */
    struct portions portions;
    struct portions_letter letter; /* of a writer, for the view */
    struct h5out_mail mail;
    char *plain, *packed; /* one chunk; packed: with its head; NULL where nothing is packed */
};

/* What one rank holds of a chunk. */
struct h5out_piece {
    int rank;
    size_t first, count, source; /* source: number of the first row in the whole data set */
};

static hid_t h5out_plain_layout(struct h5 *file)
{
    hid_t layout = h5_check(file, H5Pcreate(H5P_DATASET_CREATE), "prepare a data set");
    h5_check(file, H5Pset_obj_track_times(layout, false), "prepare a data set");
    h5_check(file, H5Pset_fill_time(layout, H5D_FILL_TIME_NEVER), "prepare a data set");
    return layout;
}

static hid_t h5out_layout(struct h5 *file, const struct h5out *out)
{
    hid_t layout = h5out_plain_layout(file);
    const struct h5out_rows *rows = out->rows;
    if (!rows->chunk || out->is_plain) return layout;
    hsize_t chunk[2] = {out->portions.chunk, rows->columns};
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

static void h5out_begin(struct h5out *out, const struct h5out_rows *rows, int writers)
{
    *out = (struct h5out){.rows = rows,
                          .is_plain = rows->hash || rows->central,
                          .columns = rows->members ? 0 : rows->columns,
                          .row = h5_type_size(rows->type) * (rows->columns ? rows->columns : 1)};
    portions_take(writers, rows->chunk, rows->n_range, rows->ranges, &out->portions);
    out->plain = mem_new(out->portions.chunk, out->row);
    if (!out->is_plain) out->packed = mem_new(out->portions.chunk * out->row + H5OUT_HEAD, 1);
}

static void h5out_end(struct h5out *out)
{
    if (out->mail.n) comm_wait((int)out->mail.n, out->mail.requests, MPI_STATUSES_IGNORE);
    for (unsigned i = 0; i < out->mail.n; i++) mem_free(out->mail.letters[i]);
    mem_free(out->mail.letters);
    mem_free(out->mail.requests);
    portions_free(&out->portions);
    mem_free(out->plain);
    mem_free(out->packed);
}

/* Rows of a chunk; fewer in the last one. */
static size_t h5out_count(const struct h5out *out, size_t first)
{
    return out->portions.total - first < out->portions.chunk ? out->portions.total - first : out->portions.chunk;
}

/* The part of portion `i` that lies in the chunk from row `first` on; count 0: none. */
static struct h5out_piece h5out_piece(const struct h5out *out, size_t first, unsigned i)
{
    const struct portion *portion = &out->portions.list[i];
    size_t begin = portion->place, from = begin, to = from + portion->count;
    size_t end = first + h5out_count(out, first);
    from = from > first ? from : first;
    to = to < end ? to : end;
    return (struct h5out_piece){.rank = portion->rank,
                                .first = from,
                                .count = to > from ? to - from : 0,
                                .source = portion->first + (from - begin)};
}

/* Asks for the rows of a piece. */
static void h5out_fill(const struct h5out *out, const struct h5out_piece *piece, char *to)
{
    out->rows->fill(out->rows->context, piece->source, piece->count, to);
}

/* Packs the chunk in `plain`, with rows [0, count) in use, behind a head; returns the size of both. */
static size_t h5out_pack(struct h5out *out, size_t count)
{
    uint32_t skipped;
    memset(out->plain + count * out->row, 0, (out->portions.chunk - count) * out->row);
    size_t size = chunk_pack(out->plain, out->portions.chunk * out->row, h5_type_size(out->rows->type),
                             out->packed + H5OUT_HEAD, &skipped);
    memset(out->packed, 0, H5OUT_HEAD);
    memcpy(out->packed, &skipped, sizeof skipped);
    return size + H5OUT_HEAD;
}

static void h5out_post(struct h5out_mail *mail, int to, const char *bytes, size_t size)
{
    mail->requests = mem_grow(mail->requests, mail->n, mail->n + 1u, sizeof *mail->requests);
    mail->letters = mem_grow(mail->letters, mail->n, mail->n + 1u, sizeof *mail->letters);
    mail->letters[mail->n] = mem_new(size, 1);
    memcpy(mail->letters[mail->n], bytes, size);
    MPI_Isend(mail->letters[mail->n], (int)size, MPI_BYTE, to, H5OUT_TAG, comm_world(), &mail->requests[mail->n]);
    mail->n++;
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

/* The rank that packs a chunk: that of the largest piece, so that packing is shared where pieces of several meet. */
static int h5out_packer(const struct h5out *out, size_t first)
{
    struct h5out_piece most = h5out_piece(out, first, 0);
    for (unsigned i = 1; i < out->portions.n; i++) {
        struct h5out_piece piece = h5out_piece(out, first, i);
        if (piece.count > most.count) most = piece;
    }
    return most.rank;
}

/* Brings a chunk together in `plain` of the rank that packs it: which one it is. Nobody waits for what belongs to a
 * later chunk, therefore the ranks do not wait for each other in a circle. */
static int h5out_meet(struct h5out *out, size_t first)
{
    int packer = h5out_packer(out, first), rank = comm_rank();
    for (unsigned i = 0; i < out->portions.n; i++) {
        struct h5out_piece piece = h5out_piece(out, first, i);
        if (!piece.count) continue;
        char *at = out->plain + (piece.first - first) * out->row;
        if (piece.rank == rank) h5out_fill(out, &piece, at);
        if (piece.rank == rank && packer != rank) h5out_post(&out->mail, packer, at, piece.count * out->row);
        if (piece.rank != rank && packer == rank) h5out_receive(piece.rank, at, piece.count * out->row);
    }
    return packer;
}

/* Has this rank rows of a chunk? Of others it does not know all that have. */
static bool h5out_concerned(const struct h5out *out, size_t first)
{
    for (unsigned i = 0; i < out->portions.n; i++) {
        struct h5out_piece piece = h5out_piece(out, first, i);
        if (piece.count && piece.rank == comm_rank()) return true;
    }
    return false;
}

/* The part of a rank that is no writer. */
static void h5out_send(struct h5out *out)
{
    for (size_t first = 0; first < out->portions.total; first += out->portions.chunk)
        if (h5out_concerned(out, first) && h5out_meet(out, first) == comm_rank())
            h5out_post(&out->mail, out->portions.leader, out->packed, h5out_pack(out, h5out_count(out, first)));
}

/* A chunk at its writer, packed; returns its size with head. */
static size_t h5out_gather(struct h5out *out, size_t first)
{
    int packer = h5out_meet(out, first);
    if (packer == comm_rank()) return h5out_pack(out, h5out_count(out, first));
    return h5out_receive(packer, out->packed, out->portions.chunk * out->row + H5OUT_HEAD);
}

void h5out_forget(struct h5out_kept *kept)
{
    for (unsigned i = 0; i < kept->n; i++) mem_free(kept->chunks[i]);
    mem_free(kept->chunks);
    mem_free(kept->sizes);
    *kept = (struct h5out_kept){0};
}

static void h5out_keep(struct h5out_kept *kept, const char *packed, size_t size)
{
    kept->sizes = mem_grow(kept->sizes, kept->n, kept->n + 1u, sizeof *kept->sizes);
    kept->chunks = mem_grow(kept->chunks, kept->n, kept->n + 1u, sizeof *kept->chunks);
    kept->sizes[kept->n] = size;
    kept->chunks[kept->n] = mem_new(size, 1);
    memcpy(kept->chunks[kept->n++], packed, size);
}

/* The part of a writer. */
static void h5out_store(struct h5 *file, hid_t set, struct h5out *out, const char *path)
{
    const struct h5out_rows *rows = out->rows;
    size_t i = 0;
    for (size_t first = 0; first < out->portions.total; first += out->portions.chunk, i++) {
        uint32_t skipped;
        hsize_t at[2] = {first, 0};
        size_t size = rows->again ? rows->kept->sizes[i] : h5out_gather(out, first);
        const char *packed = rows->again ? rows->kept->chunks[i] : out->packed;
        if (rows->kept && !rows->again) h5out_keep(rows->kept, packed, size);
        memcpy(&skipped, packed, sizeof skipped);
        if (file->code) continue; /* the others go on sending */
        h5_check(file, H5Dwrite_chunk(set, H5P_DEFAULT, skipped, at, size - H5OUT_HEAD, packed + H5OUT_HEAD), path);
    }
}

/* Rows that are stored as they are go chunk by chunk in the order of the file, and nobody copies his part of
 * them whole: a writer takes one message after the other, and the others wait until it has theirs, so that small
 * ones do not pile up where it is. */
static void h5out_send_plain(struct h5out *out)
{
    for (size_t first = 0; first < out->portions.total; first += out->portions.chunk)
        for (unsigned i = 0; i < out->portions.n; i++) {
            struct h5out_piece piece = h5out_piece(out, first, i);
            if (!piece.count || piece.rank != comm_rank()) continue;
            h5out_fill(out, &piece, out->plain);
            MPI_Request request;
            MPI_Issend(out->plain, (int)(piece.count * out->row), MPI_BYTE, out->portions.leader, H5OUT_TAG,
                       comm_world(), &request);
            comm_wait(1, &request, MPI_STATUSES_IGNORE);
        }
}

/* Brings a chunk together at its writer as it is. */
static void h5out_gather_plain(struct h5out *out, size_t first)
{
    for (unsigned i = 0; i < out->portions.n; i++) {
        struct h5out_piece piece = h5out_piece(out, first, i);
        char *to = out->plain + (piece.first - first) * out->row;
        if (!piece.count) continue;
        if (piece.rank == comm_rank()) h5out_fill(out, &piece, to);
        else h5out_receive(piece.rank, to, piece.count * out->row);
    }
}

/* Selects `count` whole rows from `first` on. */
static void h5out_select(struct h5 *file, hid_t space, size_t first, size_t count, unsigned columns)
{
    hsize_t start[2] = {first, 0}, extent[2] = {count, columns};
    h5_check(file, H5Sselect_hyperslab(space, H5S_SELECT_SET, start, NULL, extent, NULL), "select rows");
}

static void h5out_store_plain(struct h5 *file, hid_t set, struct h5out *out, const char *path)
{
    XXH64_state_t *sum = XXH64_createState();
    XXH64_reset(sum, 0);
    for (size_t first = 0; first < out->portions.total; first += out->portions.chunk) {
        size_t count = h5out_count(out, first);
        h5out_gather_plain(out, first);
        if (file->code) continue; /* the others go on sending */
        XXH64_update(sum, out->plain, count * out->row);
        hid_t memory = h5out_space(file, count, out->columns), space = h5_check(file, H5Dget_space(set), path);
        h5out_select(file, space, first, count, out->columns);
        h5_check(file, H5Dwrite(set, out->type, memory, space, H5P_DEFAULT, out->plain), path);
        if (memory >= 0) H5Sclose(memory);
        if (space >= 0) H5Sclose(space);
    }
    if (out->rows->hash) *out->rows->hash = XXH64_digest(sum);
    XXH64_freeState(sum);
}

/* Writes the rows of a writer into its file. */
static void h5out_put(struct h5 *file, const char *path, struct h5out *out)
{
    const struct h5out_rows *rows = out->rows;
    hid_t layout = h5out_layout(file, out), space = h5out_space(file, out->portions.total, out->columns);
    out->type = rows->members ? h5_record_type(file, rows->members, rows->columns) : h5_type_id(rows->type);
    hid_t set = h5_check(file, H5Dcreate2(file->id, path, out->type, space, H5P_DEFAULT, layout, H5P_DEFAULT), path);
    (out->is_plain ? h5out_store_plain : h5out_store)(file, set, out, path);
    if (set >= 0) h5_check(file, H5Dclose(set), path);
    if (rows->members && out->type >= 0) H5Tclose(out->type);
    if (space >= 0) H5Sclose(space);
    if (layout >= 0) H5Pclose(layout);
}

/* Rows of the whole data set <- rows of a writer's part. */
static void h5out_map_part(struct h5 *file, const char *path, const struct h5out *out, const hid_t id[2], int writer)
{
    struct portions portions;
    unsigned columns = out->rows->columns;
    char *name = mem_print("%s%d", file->stem, writer + 1);
    portions_receive(&out->letter, writers_first(file->writers, writer), &portions);
    hid_t source = h5out_space(file, portions.total, columns);
    for (unsigned i = 0; i < portions.n; i++) {
        const struct portion *run = &portions.list[i];
        h5out_select(file, id[1], run->first, run->count, columns);
        h5out_select(file, source, run->place, run->count, columns);
        h5_check(file, H5Pset_virtual(id[0], id[1], name, path, source), "map a part");
    }
    if (source >= 0) H5Sclose(source);
    mem_free(name);
    portions_free(&portions);
}

/* The whole data set, as a view of those of the parts. What a part should have said and does not, because it is lost,
 * is no number. */
static void h5out_unite(struct h5 *file, const char *path, const struct h5out *out)
{
    const struct h5out_rows *rows = out->rows;
    hid_t layout = h5out_plain_layout(file);
    hid_t space = h5out_space(file, rows->total, rows->columns), type = h5_type_id(rows->type);
    if (rows->type == H5_F32 || rows->type == H5_F64)
        h5_check(file, H5Pset_fill_value(layout, H5T_NATIVE_DOUBLE, &(double){NAN}), "prepare a view");
    for (int writer = 0; writer < file->writers; writer++)
        h5out_map_part(file, path, out, (const hid_t[2]){layout, space}, writer);
    hid_t set = h5_check(file, H5Dcreate2(file->id, path, type, space, H5P_DEFAULT, layout, H5P_DEFAULT), path);
    if (set >= 0) H5Dclose(set);
    if (space >= 0) H5Sclose(space);
    if (layout >= 0) H5Pclose(layout);
}

int h5out_write(struct h5 *file, const char *path, const struct h5out_rows *rows)
{
    struct h5out out;
    struct h5 *part = rows->central ? NULL : file->part, *holder = part ? part : file;
    TRY(comm_agree(file->code ? file->code : holder->code));
    h5out_begin(&out, rows, part ? file->writers : 1);
    if (part) portions_send(&out.portions, &out.letter);
    if (holder->idle && !rows->again) (out.is_plain ? h5out_send_plain : h5out_send)(&out);
    else if (holder->idle)
        ; /* the writer has them */
    else if (!part) h5out_put(holder, path, &out);
    else if (out.portions.total) {
        h5_parents(holder, path);
        h5out_put(holder, path, &out);
    }
    if (part && !file->idle) h5out_unite(file, path, &out);
    if (part) portions_sent(&out.letter);
    h5out_end(&out);
    return STATUS_OK;
}

/* Writes a whole data set of type id[0] and space id[1]; closes the space. */
static void h5out_whole(struct h5 *file, const char *path, const hid_t id[2], const void *values)
{
    hid_t layout = h5out_plain_layout(file);
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

bool h5out_has(struct h5 *file, const char *path)
{
    return H5Lexists(file->id, path, H5P_DEFAULT) > 0;
}

void h5out_unit(struct h5 *file, const char *path, const char *unit)
{
    h5_attribute_text(file, path, "units", unit);
}
