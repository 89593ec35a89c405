/* h5.c - see h5.h.
 *
 * One rank writes a file: under MPI-IO a full disk shows on some ranks in the middle of a collective
 * call, and the others wait for ever (seen with HDF5 1.10.8 on Open MPI 4.1.4 and 3 ranks).
 * HDF5 drops its error stack at the next call, therefore h5_check reads it on the spot and
 * keeps the first; calls on handles that came of a failure are refused by HDF5 at once. */
#include "io/h5.h"

#include "base/comm.h"
#include "base/file.h"
#include "base/mem.h"
#include "base/status.h"
#include "io/held.h"
#include "io/room.h"
#include "io/writers.h"

#include <hdf5.h>
#include <stdio.h>
#include <string.h>

enum { H5_REASON = 512 };

/* Keeps the innermost entry: it says why, the outer ones only where. */
static herr_t h5_collect(unsigned depth, const H5E_error2_t *entry, void *context)
{
    char *reason = context;
    if (depth == 0 && entry->desc) snprintf(reason, H5_REASON, "%s", entry->desc);
    char *system = strstr(reason, "error message = '"), *end = system ? strchr(system += 17, '\'') : NULL;
    if (end) { /* "file write failed: time = ..., errno = 28, error message = 'No space ...', buf = ..." */
        memmove(reason, system, (size_t)(end - system));
        reason[end - system] = '\0';
    }
    return 0;
}

int64_t h5_check(struct h5 *file, int64_t id, const char *what)
{
    if (id >= 0 || file->code) return id;
    char reason[H5_REASON] = "unknown reason", space[ROOM_TEXT];
    H5Ewalk2(H5E_DEFAULT, H5E_WALK_UPWARD, h5_collect, reason);
    room_left(file->path, reason, space);
    file->code = status_fail(STATUS_RUN, "%s: cannot %s%s: %s%s", file->path, *what == '/' ? "access " : "", what,
                             reason, space);
    return id;
}

int64_t h5_type_id(enum h5_type type)
{
    switch (type) {
    case H5_F32: return H5T_NATIVE_FLOAT;
    case H5_F64: return H5T_NATIVE_DOUBLE;
    case H5_I32: return H5T_NATIVE_INT32;
    case H5_I64: return H5T_NATIVE_INT64;
    default: return H5T_NATIVE_UINT8;
    }
}

size_t h5_type_size(enum h5_type type)
{
    static const size_t sizes[] = {[H5_F32] = 4, [H5_F64] = 8, [H5_I32] = 4, [H5_I64] = 8, [H5_U8] = 1};
    return sizes[type];
}

int64_t h5_string_type(struct h5 *file, const char *text, size_t length)
{
    bool ascii = true;
    for (size_t i = 0; i < length; i++) ascii = ascii && (unsigned char)text[i] < 128;
    hid_t type = h5_check(file, H5Tcopy(H5T_C_S1), "make a text type");
    h5_check(file, H5Tset_size(type, length ? length : 1), "size a text type");
    h5_check(file, H5Tset_strpad(type, H5T_STR_NULLPAD), "pad a text type");
    h5_check(file, H5Tset_cset(type, ascii ? H5T_CSET_ASCII : H5T_CSET_UTF8), "mark a text type");
    return type;
}

int64_t h5_record_type(struct h5 *file, const char *const *members, unsigned n)
{
    hid_t type = h5_check(file, H5Tcreate(H5T_COMPOUND, n * sizeof(int32_t)), "make a record type");
    for (unsigned i = 0; i < n; i++)
        h5_check(file, H5Tinsert(type, members[i], i * sizeof(int32_t), H5T_NATIVE_INT32), "fill a record type");
    return type;
}

void h5_begin(void)
{
    H5dont_atexit();
    H5open();
}

static struct h5 *h5_handle(const char *path)
{
    struct h5 *file = mem_new(1, sizeof *file);
    file->path = mem_text(path);
    file->id = -1;
    file->writers = 1;
    H5Eset_auto2(H5E_DEFAULT, NULL, NULL); /* reasons travel in the status, not to the terminal */
    return file;
}

void h5_abandon(struct h5 *file)
{
    if (!file) return;
    h5_abandon(file->part);
    if (file->id >= 0) H5Fclose(file->id);
    mem_free(file->stem);
    mem_free(file->path);
    mem_free(file);
}

/* Access of a file to be written: format versions that know virtual data sets, and all handles
 * end with the file. */
static hid_t h5_access(struct h5 *file)
{
    hid_t access = h5_check(file, H5Pcreate(H5P_FILE_ACCESS), "prepare");
    if (held_is(file->path)) h5_check(file, H5Pset_fapl_stdio(access), "prepare"); /* others want a name in a folder */
    h5_check(file, H5Pset_libver_bounds(access, H5F_LIBVER_V18, H5F_LIBVER_LATEST), "set the file version");
    h5_check(file, H5Pset_fclose_degree(access, H5F_CLOSE_STRONG), "prepare");
    return access;
}

/* Makes the file of a handle, unless another rank does. */
static void h5_make(struct h5 *file, size_t head)
{
    if (file->idle) return;
    hid_t access = h5_access(file), start = h5_check(file, H5Pcreate(H5P_FILE_CREATE), "prepare");
    h5_check(file, H5Pset_userblock(start, head), "leave room for a header");
    file->id = h5_check(file, H5Fcreate(file->path, H5F_ACC_TRUNC, start, access), "create it");
    H5Pclose(access);
    H5Pclose(start);
}

int h5_create(const char *path, struct h5 **ret_file)
{
    return h5_create_behind(path, 0, ret_file);
}

int h5_create_behind(const char *path, size_t head, struct h5 **ret_file)
{
    return h5_create_parts(path, head, &(struct h5_parts){.writers = 1}, ret_file);
}

/* What has failed so far, in the file or in the part of this rank's writer. */
static int h5_code(const struct h5 *file)
{
    return file->code || !file->part ? file->code : file->part->code;
}

int h5_create_parts(const char *path, size_t head, const struct h5_parts *parts, struct h5 **ret_file)
{
    struct h5 *file = h5_handle(path);
    file->idle = comm_rank() != 0;
    h5_make(file, head);
    if (parts->writers > 1) {
        file->writers = parts->writers;
        file->stem = mem_text(parts->stem);
        file->part = h5_handle(parts->path);
        file->part->idle = !writers_here(parts->writers);
        h5_make(file->part, parts->head);
    }
    int code = comm_agree(h5_code(file));
    if (code) h5_abandon(file);
    else *ret_file = file;
    return code;
}

int h5_open(const char *path, struct h5 **ret_file)
{
    const char *why;
    FILE *probe = file_open(path, &why); /* the system's reason is clearer than HDF5's */
    if (!probe) return status_fail(STATUS_RUN, "%s: cannot open it: %s", path, why);
    fclose(probe);
    struct h5 *file = h5_handle(path);
    if (H5Fis_hdf5(path) <= 0) {
        h5_abandon(file);
        return status_fail(STATUS_RUN, "%s: not an HDF5 file", path);
    }
    file->id = h5_check(file, H5Fopen(path, H5F_ACC_RDONLY, H5P_DEFAULT), "open it");
    int code = file->code;
    if (code) h5_abandon(file);
    else *ret_file = file;
    return code;
}

int h5_close_part(struct h5 *file)
{
    struct h5 *part = file->part;
    if (!part) return STATUS_OK;
    if (!part->idle) h5_check(part, H5Fclose(part->id), "finish it");
    part->id = -1;
    return comm_agree(h5_code(file));
}

int h5_close(struct h5 *file)
{
    if (!file->idle) h5_check(file, H5Fclose(file->id), "finish it");
    file->id = -1;
    int code = comm_agree(file->code);
    h5_abandon(file);
    return code;
}

void h5_group(struct h5 *file, const char *path)
{
    if (file->idle) return;
    hid_t options = h5_check(file, H5Pcreate(H5P_GROUP_CREATE), "prepare a group");
    h5_check(file, H5Pset_obj_track_times(options, false), "prepare a group"); /* equal runs give equal files */
    hid_t group = h5_check(file, H5Gcreate2(file->id, path, H5P_DEFAULT, options, H5P_DEFAULT), "make a group");
    if (group >= 0) H5Gclose(group);
    if (options >= 0) H5Pclose(options);
}

void h5_parents(struct h5 *file, const char *path)
{
    char *part = mem_text(path);
    for (char *end = part + 1; (end = strchr(end, '/')); *end++ = '/') {
        *end = '\0';
        if (H5Lexists(file->id, part, H5P_DEFAULT) <= 0) h5_group(file, part);
    }
    mem_free(part);
}

/* Makes and writes one attribute of type id[0] and space id[1]; closes the space. */
static void h5_put(struct h5 *file, const char *object, const char *name, const hid_t id[2], const void *values)
{
    hid_t put =
        h5_check(file, H5Acreate_by_name(file->id, object, name, id[0], id[1], H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT),
                 name);
    h5_check(file, put < 0 ? -1 : H5Awrite(put, id[0], values), name);
    if (put >= 0) H5Aclose(put);
    if (id[1] >= 0) H5Sclose(id[1]);
}

void h5_attribute(struct h5 *file, const char *object, const char *name, enum h5_type type, unsigned n, const void *in)
{
    if (file->idle) return;
    hsize_t extent = n;
    hid_t space = n ? H5Screate_simple(1, &extent, NULL) : H5Screate(H5S_SCALAR);
    h5_put(file, object, name, (hid_t[2]){h5_type_id(type), h5_check(file, space, "make an attribute")}, in);
}

void h5_attribute_text(struct h5 *file, const char *object, const char *name, const char *text)
{
    if (file->idle) return;
    hid_t type = h5_string_type(file, text, strlen(text));
    hid_t space = h5_check(file, H5Screate(H5S_SCALAR), "make an attribute");
    h5_put(file, object, name, (hid_t[2]){type, space}, text);
    if (type >= 0) H5Tclose(type);
}

void h5_attribute_record(struct h5 *file, const char *object, const char *name, const char *const *members, unsigned n,
                         const int32_t *values)
{
    if (file->idle) return;
    hid_t type = h5_record_type(file, members, n);
    hid_t space = h5_check(file, H5Screate(H5S_SCALAR), "make an attribute");
    h5_put(file, object, name, (hid_t[2]){type, space}, values);
    if (type >= 0) H5Tclose(type);
}
