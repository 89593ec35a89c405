/* h5in.c - see h5in.h. */
#include "io/h5in.h"

#include "base/mem.h"
#include "base/status.h"

#include <hdf5.h>
#include <stdlib.h>
#include <string.h>

bool h5in_has(struct h5 *file, const char *path)
{
    char *part = mem_text(path);
    bool found = true;
    for (char *end = part + 1; found && *end; end++) {
        if (*end != '/') continue;
        *end = '\0';
        found = H5Lexists(file->id, part, H5P_DEFAULT) > 0;
        *end = '/';
    }
    found = found && H5Lexists(file->id, part, H5P_DEFAULT) > 0;
    mem_free(part);
    return found;
}

static int h5in_compare(const void *a, const void *b)
{
    return strcmp(*(char *const *)a, *(char *const *)b);
}

int h5in_names(struct h5 *file, const char *group, unsigned *ret_n, char ***ret_names)
{
    H5G_info_t info = {0};
    h5_check(file, H5Gget_info_by_name(file->id, group, &info, H5P_DEFAULT), group);
    TRY(file->code);
    char **names = mem_new((size_t)info.nlinks + 1, sizeof *names);
    for (hsize_t i = 0; i < info.nlinks; i++) {
        ssize_t length = H5Lget_name_by_idx(file->id, group, H5_INDEX_NAME, H5_ITER_INC, i, NULL, 0, H5P_DEFAULT);
        names[i] = mem_new((size_t)(length > 0 ? length : 0) + 1, 1);
        if (length > 0)
            H5Lget_name_by_idx(file->id, group, H5_INDEX_NAME, H5_ITER_INC, i, names[i], (size_t)length + 1,
                               H5P_DEFAULT);
    }
    qsort(names, (size_t)info.nlinks, sizeof *names, h5in_compare);
    *ret_n = (unsigned)info.nlinks;
    *ret_names = names;
    return STATUS_OK;
}

/* Opens an attribute; missing: a message that names it. */
static hid_t h5in_find(struct h5 *file, const char *object, const char *name)
{
    bool there =
        (!strcmp(object, "/") || h5in_has(file, object)) && H5Aexists_by_name(file->id, object, name, H5P_DEFAULT) > 0;
    if (!there && !file->code)
        file->code = status_fail(STATUS_RUN, "%s: no attribute %s of %s: not a file of bulla, or a broken one",
                                 file->path, name, object);
    return there ? h5_check(file, H5Aopen_by_name(file->id, object, name, H5P_DEFAULT, H5P_DEFAULT), name) : -1;
}

int h5in_attribute(struct h5 *file, const char *object, const char *name, unsigned n, double *ret_values)
{
    hid_t found = h5in_find(file, object, name);
    TRY(file->code);
    hid_t space = h5_check(file, H5Aget_space(found), name);
    if (H5Sget_simple_extent_npoints(space) != (hssize_t)n)
        file->code =
            status_fail(STATUS_RUN, "%s: attribute %s of %s should have %u numbers", file->path, name, object, n);
    else h5_check(file, H5Aread(found, H5T_NATIVE_DOUBLE, ret_values), name);
    H5Sclose(space);
    H5Aclose(found);
    return file->code;
}

/* The bytes of a fixed-length text type, or 0 with a recorded message. */
static size_t h5in_length(struct h5 *file, hid_t type, const char *name)
{
    bool text = H5Tget_class(type) == H5T_STRING && H5Tis_variable_str(type) == 0;
    size_t length = text ? H5Tget_size(type) : 0;
    if (!length && !file->code) file->code = status_fail(STATUS_RUN, "%s: %s is not a text", file->path, name);
    return length;
}

int h5in_attribute_text(struct h5 *file, const char *object, const char *name, char **ret_text)
{
    hid_t found = h5in_find(file, object, name);
    TRY(file->code);
    hid_t type = h5_check(file, H5Aget_type(found), name);
    size_t length = h5in_length(file, type, name);
    char *text = mem_new(length + 1, 1);
    if (length) h5_check(file, H5Aread(found, type, text), name);
    H5Tclose(type);
    H5Aclose(found);
    if (file->code) mem_free(text);
    else *ret_text = text;
    return file->code;
}

static hid_t h5in_set(struct h5 *file, const char *path)
{
    bool there = h5in_has(file, path);
    if (!there && !file->code)
        file->code =
            status_fail(STATUS_RUN, "%s: no data set %s: not a file of bulla, or a broken one", file->path, path);
    return there ? h5_check(file, H5Dopen2(file->id, path, H5P_DEFAULT), path) : -1;
}

int h5in_text(struct h5 *file, const char *path, char **ret_text)
{
    hid_t set = h5in_set(file, path);
    TRY(file->code);
    hid_t type = h5_check(file, H5Dget_type(set), path);
    size_t length = h5in_length(file, type, path);
    char *text = mem_new(length + 1, 1);
    if (length) h5_check(file, H5Dread(set, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, text), path);
    H5Tclose(type);
    H5Dclose(set);
    if (file->code) mem_free(text);
    else *ret_text = text;
    return file->code;
}

int h5in_shape(struct h5 *file, const char *path, size_t *ret_rows, unsigned *ret_columns)
{
    hid_t set = h5in_set(file, path);
    TRY(file->code);
    hid_t space = h5_check(file, H5Dget_space(set), path);
    int rank = H5Sget_simple_extent_ndims(space);
    hsize_t extent[2] = {0, 0};
    if (rank != 1 && rank != 2) file->code = status_fail(STATUS_RUN, "%s: %s is no table", file->path, path);
    else h5_check(file, H5Sget_simple_extent_dims(space, extent, NULL), path);
    H5Sclose(space);
    H5Dclose(set);
    TRY(file->code);
    *ret_rows = (size_t)extent[0];
    *ret_columns = (unsigned)extent[1];
    return STATUS_OK;
}

int h5in_read(struct h5 *file, const char *path, double *out)
{
    hid_t set = h5in_set(file, path);
    TRY(file->code);
    h5_check(file, H5Dread(set, H5T_NATIVE_DOUBLE, H5S_ALL, H5S_ALL, H5P_DEFAULT, out), path);
    H5Dclose(set);
    return file->code;
}
