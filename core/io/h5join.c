/* h5join.c - see h5join.h. Objects are visited by name, groups before what is in them. */
#include "io/h5join.h"

#include "base/mem.h"
#include "base/status.h"
#include "io/h5in.h"

#include <hdf5.h>
#include <string.h>
#include <xxhash.h>

enum { H5JOIN_BYTES = 4 << 20 }; /* that travel together */

struct h5join {
    struct h5 *from, *to;
    const char *const *without;
    h5join_told *told;
    void *context;
};

/* What has failed on either side. */
static int h5join_code(const struct h5join *join)
{
    return join->from->code ? join->from->code : join->to->code;
}

/* Copies one attribute of an object. */
static void h5join_attribute(const struct h5join *join, hid_t object, hid_t copy, hsize_t i)
{
    hid_t from =
        h5_check(join->from, H5Aopen_by_idx(object, ".", H5_INDEX_NAME, H5_ITER_INC, i, H5P_DEFAULT, H5P_DEFAULT),
                 "read an attribute");
    if (from < 0) return;
    char name[256] = "";
    hid_t type = H5Aget_type(from), space = H5Aget_space(from);
    void *value = mem_new((size_t)H5Sget_simple_extent_npoints(space) + 1, H5Tget_size(type));
    h5_check(join->from, H5Aget_name(from, sizeof name, name), "read an attribute");
    h5_check(join->from, H5Aread(from, type, value), name);
    hid_t to = h5_check(join->to, H5Acreate2(copy, name, type, space, H5P_DEFAULT, H5P_DEFAULT), name);
    h5_check(join->to, to < 0 ? -1 : H5Awrite(to, type, value), name);
    if (to >= 0) H5Aclose(to);
    mem_free(value);
    H5Sclose(space);
    H5Tclose(type);
    H5Aclose(from);
}

static void h5join_attributes(const struct h5join *join, const char *path)
{
    hid_t object = h5_check(join->from, H5Oopen(join->from->id, path, H5P_DEFAULT), path);
    hid_t copy = h5_check(join->to, H5Oopen(join->to->id, path, H5P_DEFAULT), path);
    H5O_info_t info = {0};
    h5_check(join->from, object < 0 ? -1 : H5Oget_info(object, &info), path);
    for (hsize_t i = 0; copy >= 0 && i < info.num_attrs && !h5join_code(join); i++)
        h5join_attribute(join, object, copy, i);
    if (object >= 0) H5Oclose(object);
    if (copy >= 0) H5Oclose(copy);
}

/* How a part packs the rows of a data set: those of the first part that it is a view of. Not of parts: -1. */
static hid_t h5join_layout(const struct h5join *join, hid_t set)
{
    hid_t layout = H5Dget_create_plist(set), found = -1;
    size_t count = 0;
    char name[1024] = ".", inside[256] = "";
    if (H5Pget_layout(layout) == H5D_VIRTUAL && H5Pget_virtual_count(layout, &count) >= 0 && count) {
        H5Pget_virtual_filename(layout, 0, name, sizeof name);
        H5Pget_virtual_dsetname(layout, 0, inside, sizeof inside);
    }
    H5Pclose(layout);
    if (!strcmp(name, ".")) return found;
    const char *slash = strrchr(join->from->path, '/');
    char *path = mem_print("%.*s%s", slash ? (int)(slash + 1 - join->from->path) : 0, join->from->path, name);
    hid_t file = h5_check(join->from, H5Fopen(path, H5F_ACC_RDONLY, H5P_DEFAULT), "open a part");
    hid_t part = h5_check(join->from, file < 0 ? -1 : H5Dopen2(file, inside, H5P_DEFAULT), inside);
    if (part >= 0) found = H5Dget_create_plist(part);
    if (part >= 0) H5Dclose(part);
    if (file >= 0) H5Fclose(file);
    mem_free(path);
    return found;
}

/* Copies `count` rows from row `first` on. */
static void h5join_piece(const struct h5join *join, const hid_t set[2], hsize_t first, hsize_t count, void *buffer)
{
    hid_t type = H5Dget_type(set[0]), space = H5Dget_space(set[0]);
    hsize_t start[2] = {first, 0}, extent[2] = {0};
    int rank = H5Sget_simple_extent_dims(space, extent, NULL);
    extent[0] = count;
    hid_t memory = H5Screate_simple(rank, extent, NULL);
    H5Sselect_hyperslab(space, H5S_SELECT_SET, start, NULL, extent, NULL);
    h5_check(join->from, H5Dread(set[0], type, memory, space, H5P_DEFAULT, buffer), "read rows");
    h5_check(join->to, H5Dwrite(set[1], type, memory, space, H5P_DEFAULT, buffer), "write rows");
    H5Sclose(memory);
    H5Sclose(space);
    H5Tclose(type);
}

/* Whole chunks at a time. */
static void h5join_rows(const struct h5join *join, const hid_t set[2], hid_t layout, const char *path)
{
    hid_t type = H5Dget_type(set[0]), space = H5Dget_space(set[0]);
    hsize_t extent[2] = {0, 1}, chunk[2] = {1, 1};
    H5Sget_simple_extent_dims(space, extent, NULL);
    if (H5Pget_layout(layout) == H5D_CHUNKED) H5Pget_chunk(layout, 2, chunk);
    size_t row = H5Tget_size(type) * (size_t)extent[1];
    hsize_t rows = chunk[0] * row < H5JOIN_BYTES ? H5JOIN_BYTES / (chunk[0] * row) * chunk[0] : chunk[0];
    XXH64_state_t *sum = XXH64_createState();
    void *buffer = mem_new(rows, row);
    XXH64_reset(sum, 0);
    for (hsize_t first = 0; first < extent[0] && !h5join_code(join); first += rows) {
        hsize_t count = extent[0] - first < rows ? extent[0] - first : rows;
        h5join_piece(join, set, first, count, buffer);
        XXH64_update(sum, buffer, count * row);
    }
    if (join->told) join->told(join->context, path, XXH64_digest(sum));
    XXH64_freeState(sum);
    mem_free(buffer);
    H5Sclose(space);
    H5Tclose(type);
}

/* A data set: as it is, or brought together. */
static void h5join_set(const struct h5join *join, const char *path)
{
    hid_t from = h5_check(join->from, H5Dopen2(join->from->id, path, H5P_DEFAULT), path);
    hid_t layout = from < 0 ? -1 : h5join_layout(join, from);
    if (layout < 0 && !h5join_code(join))
        h5_check(join->to, H5Ocopy(join->from->id, path, join->to->id, path, H5P_DEFAULT, H5P_DEFAULT), path);
    if (layout >= 0) {
        hid_t type = H5Dget_type(from), space = H5Dget_space(from);
        hid_t to =
            h5_check(join->to, H5Dcreate2(join->to->id, path, type, space, H5P_DEFAULT, layout, H5P_DEFAULT), path);
        if (to >= 0) h5join_rows(join, (const hid_t[2]){from, to}, layout, path);
        if (to >= 0) h5_check(join->to, H5Dclose(to), path);
        if (to >= 0) h5join_attributes(join, path);
        H5Sclose(space);
        H5Tclose(type);
        H5Pclose(layout);
    }
    if (from >= 0) H5Dclose(from);
}

static bool h5join_skips(const struct h5join *join, const char *path)
{
    const char *const *name = join->without;
    while (*name && strcmp(*name, path)) name++;
    return *name != NULL;
}

static int h5join_group(const struct h5join *join, const char *path)
{
    unsigned n;
    char **names;
    bool is_root = !strcmp(path, "/");
    if (!is_root) h5_group(join->to, path);
    h5join_attributes(join, path);
    TRY(h5in_names(join->from, path, &n, &names));
    int code = h5join_code(join);
    for (unsigned i = 0; i < n; i++) {
        H5O_info_t info = {0};
        char *child = mem_print("%s/%s", is_root ? "" : path, names[i]);
        if (!code) h5_check(join->from, H5Oget_info_by_name(join->from->id, child, &info, H5P_DEFAULT), child);
        if (!code && info.type == H5O_TYPE_GROUP) code = h5join_group(join, child);
        else if (!code && !h5join_skips(join, child)) h5join_set(join, child);
        code = code ? code : h5join_code(join);
        mem_free(child);
        mem_free(names[i]);
    }
    mem_free(names);
    return code;
}

int h5join_copy(struct h5 *from, struct h5 *to, const char *const *without, h5join_told *told, void *context)
{
    const struct h5join join = {from, to, without, told, context};
    return h5join_group(&join, "/");
}
