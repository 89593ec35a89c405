/* csv.c - see csv.h. */
#include "io/csv.h"

#include "base/comm.h"
#include "base/mem.h"
#include "base/status.h"

#include <errno.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

struct csv {
    char *path;
    FILE *stream; /* rank 0 */
};

static int csv_fail(const char *path)
{
    return status_fail(STATUS_RUN, "%s: cannot write: %s", path, strerror(errno));
}

/* Length of the part of a file that stays: the header and the whole rows up to `limit`; 0 if the
 * header is another one. */
static long csv_past(FILE *stream, const char *header, double limit)
{
    char *line = NULL;
    size_t room = 0;
    long keep = 0;
    ssize_t length = getline(&line, &room, stream);
    bool same = length > 0 && (size_t)length == strlen(header) + 1 && !strncmp(line, header, strlen(header));
    while (same && length > 0 && line[length - 1] == '\n') {
        keep += length;
        length = getline(&line, &room, stream);
        if (length > 0 && strtod(line, NULL) > limit) break;
    }
    free(line);
    return keep;
}

static int csv_start(struct csv *csv, const char *header, bool resume, double limit)
{
    FILE *old = resume ? fopen(csv->path, "r") : NULL;
    long keep = old ? csv_past(old, header, limit) : 0;
    if (old) fclose(old);
    if (keep && truncate(csv->path, keep)) return csv_fail(csv->path);
    csv->stream = fopen(csv->path, keep ? "a" : "w");
    if (!csv->stream) return csv_fail(csv->path);
    if (!keep) fprintf(csv->stream, "%s\n", header);
    return fflush(csv->stream) ? csv_fail(csv->path) : STATUS_OK;
}

int csv_open(const char *path, const char *header, bool resume, double limit, struct csv **ret_csv)
{
    struct csv *csv = mem_new(1, sizeof *csv);
    csv->path = mem_text(path);
    int code = comm_agree(comm_rank() == 0 ? csv_start(csv, header, resume, limit) : STATUS_OK);
    if (code) csv_close(csv);
    else *ret_csv = csv;
    return code;
}

static int csv_put(struct csv *csv, unsigned n, const double *values)
{
    for (unsigned i = 0; i < n; i++) {
        const char *comma = i ? "," : "";
        if (isnan(values[i])) fprintf(csv->stream, "%snan", comma);
        else fprintf(csv->stream, "%s%.17g", comma, values[i]);
    }
    fputc('\n', csv->stream);
    return fflush(csv->stream) ? csv_fail(csv->path) : STATUS_OK;
}

int csv_row(struct csv *csv, unsigned n, const double *values)
{
    return comm_agree(comm_rank() == 0 ? csv_put(csv, n, values) : STATUS_OK);
}

void csv_close(struct csv *csv)
{
    if (!csv) return;
    if (csv->stream) fclose(csv->stream);
    mem_free(csv->path);
    mem_free(csv);
}
