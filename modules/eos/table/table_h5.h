/* table_h5.h - states from an HDF5 file: arrays `rho` [n] and `T` [m], ascending, and `p`, `e`, `c`, `s` [n][m] over
 * them, each with its unit in the attribute `units`: kg/m3, K, Pa, J/kg, m/s, J/kg/K. Numbers of any kind and
 * precision. What is no such file is refused with the data set and the reason. */
#ifndef TABLE_H5_H
#define TABLE_H5_H

#include "table_file.h"

#include <hdf5.h>

enum { TABLE_H5_UNIT = 64 };

static const char *const table_h5_names[TABLE_COLUMNS] = {"rho", "T", "p", "e", "c", "s"};
static const char *const table_h5_units[TABLE_COLUMNS] = {"kg/m3", "K", "Pa", "J/kg", "m/s", "J/kg/K"};

/* A file being read. */
struct table_h5 {
    const struct bulla_host *host;
    const char *path;
    hid_t file;
    struct table_file *states;
};

/* "FILE: data set 'p': reason"; returns 1. */
__attribute__((format(printf, 3, 4))) static int table_h5_fail(const struct table_h5 *h5, int column,
                                                               const char *format, ...)
{
    char place[700];
    snprintf(place, sizeof place, "%.600s: data set '%s'", h5->path, table_h5_names[column]);
    va_list list;
    va_start(list, format);
    int code = table_file_say(h5->host, place, format, list);
    va_end(list);
    return code;
}

/* The text of an attribute, of fixed or of any length. False: it is none. */
static bool table_h5_text(hid_t attribute, char text[static TABLE_H5_UNIT])
{
    hid_t type = H5Aget_type(attribute), space = H5Aget_space(attribute);
    bool good = H5Tget_class(type) == H5T_STRING && H5Sget_simple_extent_npoints(space) == 1;
    text[0] = '\0';
    if (good && H5Tis_variable_str(type) > 0) {
        char *held = NULL;
        good = H5Aread(attribute, type, &held) >= 0 && held;
        if (good) snprintf(text, TABLE_H5_UNIT, "%s", held);
        if (held) H5free_memory(held);
    } else if (good) {
        size_t length = H5Tget_size(type);
        good = length > 0 && length < TABLE_H5_UNIT && H5Aread(attribute, type, text) >= 0;
        if (good) text[length] = '\0';
        for (size_t i = length; good && i > 0 && text[i - 1] == ' '; i--) text[i - 1] = '\0';
    }
    H5Sclose(space);
    H5Tclose(type);
    return good;
}

static int table_h5_unit(const struct table_h5 *h5, hid_t set, int column)
{
    char text[TABLE_H5_UNIT];
    const char *unit = table_h5_units[column];
    if (H5Aexists(set, "units") <= 0)
        return table_h5_fail(h5, column, "the attribute 'units' is missing; '%s' is wanted", unit);
    hid_t attribute = H5Aopen(set, "units", H5P_DEFAULT);
    bool good = attribute >= 0 && table_h5_text(attribute, text);
    if (attribute >= 0) H5Aclose(attribute);
    if (!good) return table_h5_fail(h5, column, "the attribute 'units' is no short text; '%s' is wanted", unit);
    if (strcmp(text, unit) != 0) return table_h5_fail(h5, column, "the unit is '%s', not '%s'", text, unit);
    return 0;
}

/* The shape must be [n_rho][n_T], or [n] of a coordinate, which is then told. */
static int table_h5_shape(const struct table_h5 *h5, hid_t set, int column)
{
    hsize_t size[2] = {0, 0};
    hid_t space = H5Dget_space(set), type = H5Dget_type(set);
    int rank = H5Sget_simple_extent_ndims(space), wanted = column <= TABLE_T ? 1 : 2;
    bool number = H5Tget_class(type) == H5T_FLOAT || H5Tget_class(type) == H5T_INTEGER;
    if (rank == wanted) H5Sget_simple_extent_dims(space, size, NULL);
    H5Tclose(type);
    H5Sclose(space);
    if (!number) return table_h5_fail(h5, column, "holds no numbers");
    if (rank != wanted) return table_h5_fail(h5, column, "has %d dimensions, not %d", rank, wanted);
    struct table_file *states = h5->states;
    if (column <= TABLE_T) {
        if (size[0] < TABLE_LEAST || size[0] > TABLE_MOST)
            return table_h5_fail(h5, column, "has %llu values; %d to %d are wanted", (unsigned long long)size[0],
                                 TABLE_LEAST, TABLE_MOST);
        *(column == TABLE_RHO ? &states->n_rho : &states->n_T) = (size_t)size[0];
    } else if (size[0] != states->n_rho || size[1] != states->n_T)
        return table_h5_fail(h5, column, "has the shape %llu x %llu; %zu densities x %zu temperatures are wanted",
                             (unsigned long long)size[0], (unsigned long long)size[1], states->n_rho, states->n_T);
    return 0;
}

/* Finite, ascending where it is a coordinate, above 0 where it must be. */
static int table_h5_values(const struct table_h5 *h5, int column, const double *values, size_t n)
{
    bool coordinate = column <= TABLE_T, positive = coordinate || column == TABLE_C;
    for (size_t i = 0; i < n; i++) {
        char place[64];
        if (coordinate) snprintf(place, sizeof place, "[%zu]", i);
        else snprintf(place, sizeof place, "[%zu][%zu]", i / h5->states->n_T, i % h5->states->n_T);
        if (!isfinite(values[i])) return table_h5_fail(h5, column, "%s is not finite", place);
        if (positive && !(values[i] > 0.0)) return table_h5_fail(h5, column, "%s is not above 0", place);
        if (coordinate && i && !(values[i] > values[i - 1]))
            return table_h5_fail(h5, column, "must ascend: %s is %.9g after %.9g", place, values[i], values[i - 1]);
    }
    return 0;
}

/* One array into its column. */
static int table_h5_column(const struct table_h5 *h5, hid_t set, int column)
{
    struct table_file *states = h5->states;
    if (table_h5_unit(h5, set, column) || table_h5_shape(h5, set, column)) return 1;
    size_t n = column == TABLE_RHO ? states->n_rho : column == TABLE_T ? states->n_T : states->n_rho * states->n_T;
    double *values = malloc(n * sizeof *values);
    if (column == TABLE_P) { /* rho and T are known */
        states->n_row = n;
        states->row = states->row ? states->row : calloc(n, sizeof *states->row);
    }
    int code = 1;
    if (!values || (column == TABLE_P && !states->row)) table_h5_fail(h5, column, "out of memory");
    else if (H5Dread(set, H5T_NATIVE_DOUBLE, H5S_ALL, H5S_ALL, H5P_DEFAULT, values) < 0)
        table_h5_fail(h5, column, "cannot be read: the file is damaged, or its filter is not there");
    else code = table_h5_values(h5, column, values, n);
    for (size_t i = 0; !code && column > TABLE_T && i < n; i++) states->row[i][column] = values[i];
    free(values);
    return code;
}

/* rho and T once more, now into all rows. */
static int table_h5_spread(const struct table_h5 *h5, hid_t set, int column)
{
    struct table_file *states = h5->states;
    double values[TABLE_MOST];
    if (H5Dread(set, H5T_NATIVE_DOUBLE, H5S_ALL, H5S_ALL, H5P_DEFAULT, values) < 0)
        return table_h5_fail(h5, column, "cannot be read");
    for (size_t r = 0; r < states->n_row; r++)
        states->row[r][column] = values[column == TABLE_RHO ? r / states->n_T : r % states->n_T];
    return 0;
}

static int table_h5_set(const struct table_h5 *h5, int column,
                        int (*use)(const struct table_h5 *h5, hid_t set, int column))
{
    const char *name = table_h5_names[column];
    if (H5Lexists(h5->file, name, H5P_DEFAULT) <= 0)
        return table_file_fail(h5->host, h5->path, 0, "there is no data set '%s'; rho, T, p, e, c and s are wanted",
                               name);
    hid_t set = H5Dopen2(h5->file, name, H5P_DEFAULT);
    if (set < 0) return table_h5_fail(h5, column, "is none");
    int code = use(h5, set, column);
    H5Dclose(set);
    return code;
}

/* Non-zero after host->fail. */
static int table_h5_read(const struct bulla_host *host, const char *path, struct table_file *states)
{
    H5E_auto2_t said;
    void *data;
    H5Eget_auto2(H5E_DEFAULT, &said, &data);
    H5Eset_auto2(H5E_DEFAULT, NULL, NULL); /* HDF5 would print what we say in our own words */
    struct table_h5 h5 = {host, path, H5Fopen(path, H5F_ACC_RDONLY, H5P_DEFAULT), states};
    int code = 0;
    if (h5.file < 0) code = table_file_fail(host, path, 0, "is no HDF5 file that can be opened: damaged, or cut off");
    for (int column = TABLE_RHO; !code && column < TABLE_COLUMNS; column++)
        code = table_h5_set(&h5, column, table_h5_column);
    for (int column = TABLE_RHO; !code && column <= TABLE_T; column++)
        code = table_h5_set(&h5, column, table_h5_spread);
    if (h5.file >= 0) H5Fclose(h5.file);
    H5Eset_auto2(H5E_DEFAULT, said, data);
    return code;
}

#endif
