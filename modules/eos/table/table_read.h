/* table_read.h - reads the file of the equation of state `table`: HDF5 if it begins like it (or is called so), else
 * CSV. */
#ifndef TABLE_READ_H
#define TABLE_READ_H

#include "table_csv.h"
#include "table_h5.h"

#include <sys/stat.h>

/* By its first bytes; an empty or cut file by its name. */
static bool table_read_is_h5(const char *path)
{
    static const char mark[8] = "\211HDF\r\n\032\n";
    char begin[sizeof mark] = {0};
    FILE *stream = fopen(path, "rb");
    size_t n = stream ? fread(begin, 1, sizeof begin, stream) : 0;
    if (stream) fclose(stream);
    const char *dot = strrchr(path, '.');
    return (n == sizeof mark && memcmp(begin, mark, sizeof mark) == 0) ||
           (dot && (strcmp(dot, ".h5") == 0 || strcmp(dot, ".hdf5") == 0 || strcmp(dot, ".hdf") == 0));
}

/* Non-zero after host->fail. */
static int table_read(const struct bulla_host *host, const char *path, struct table_file *ret_file)
{
    struct table_file file = {0};
    struct stat facts;
    if (stat(path, &facts) != 0) return table_file_fail(host, path, 0, "there is no such file");
    if (!S_ISREG(facts.st_mode)) return table_file_fail(host, path, 0, "is no file");
    int code = table_read_is_h5(path) ? table_h5_read(host, path, &file) : table_csv_read(host, path, &file);
    if (!code) code = table_file_monotone(host, path, &file);
    if (code) table_file_free(&file);
    else *ret_file = file;
    return code;
}

#endif
