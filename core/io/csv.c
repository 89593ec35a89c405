/* csv.c - see csv.h. The checksum of all bytes so far grows with the rows, so that a checkpoint can say
 * what the file was; only whole rows count. */
#include "io/csv.h"

#include "base/comm.h"
#include "base/log.h"
#include "base/mem.h"
#include "base/status.h"
#include "io/room.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>
#include <xxhash.h>

struct csv {
    char *path;
    FILE *stream;       /* rank 0 */
    long bytes;         /* of the header and the whole rows */
    XXH64_state_t *sum; /* of these */
};

/* Is row `row` of a file one of the first block with these places, or begins another one behind it? */
static bool csv_fits(const struct csv_places *places, unsigned row, const char *line, double *first)
{
    char *at;
    double number = strtod(line, &at);
    if (row == 0) *first = number;
    if (row > places->n) return true;
    if (row == places->n) return number != *first;
    for (unsigned i = 0; i < places->n_number; i++) {
        double want = places->numbers[(size_t)row * places->n_number + i];
        if (*at != ',' || strtod(at + 1, &at) != want) return false;
    }
    return number == *first;
}

/* Length of the part of a file that stays: the header and the whole rows up to `limit`; 0 if the
 * header or the places are other ones. */
static long csv_past(FILE *stream, const char *header, const struct csv_places *places, double limit)
{
    double first = 0.0;
    char *line = NULL;
    size_t room = 0;
    long keep = 0;
    ssize_t length = getline(&line, &room, stream);
    bool same = length > 0 && (size_t)length == strlen(header) + 1 && !strncmp(line, header, strlen(header));
    for (unsigned row = 0; same && length > 0 && line[length - 1] == '\n'; row++) {
        keep += length;
        length = getline(&line, &room, stream);
        if (length > 0 && strtod(line, NULL) > limit) break;
        bool broken = length <= 0 || line[length - 1] != '\n'; /* it goes, whatever it was to be */
        same = !places || broken || csv_fits(places, row, line, &first);
    }
    free(line);
    return same ? keep : 0;
}

/* Adds a text, which counts as soon as all of it has been written. */
static int csv_add(struct csv *csv, const char *text, size_t length)
{
    bool good = fwrite(text, 1, length, csv->stream) == length && !fflush(csv->stream);
    if (!good) return room_fail(csv->path, "write");
    csv->bytes += (long)length;
    XXH64_update(csv->sum, text, length);
    return STATUS_OK;
}

/* Copies the first bytes of a file to the stream, which is empty, or only sums them up; returns how many. */
static long csv_replay(struct csv *csv, const char *path, long bytes, bool copy)
{
    char piece[4096];
    FILE *from = fopen(path, "r");
    XXH64_reset(csv->sum, 0);
    csv->bytes = 0;
    while (from && csv->bytes < bytes) {
        size_t want = bytes - csv->bytes < (long)sizeof piece ? (size_t)(bytes - csv->bytes) : sizeof piece;
        size_t got = fread(piece, 1, want, from);
        if (!got || (copy && fwrite(piece, 1, got, csv->stream) != got)) break;
        XXH64_update(csv->sum, piece, got);
        csv->bytes += (long)got;
    }
    if (from) fclose(from);
    return csv->bytes;
}

/* Rows with other columns, or of other places, are not thrown away. */
static void csv_set_aside(const char *path)
{
    char *aside = mem_print("%s.before", path);
    if (!rename(path, aside))
        log_warn("%s has other columns or places than the case asks for now: it is kept as %s", path, aside);
    mem_free(aside);
}

static int csv_start(struct csv *csv, const char *header, const struct csv_places *places, bool resume, double limit)
{
    struct stat about;
    if (!stat(csv->path, &about) && S_ISFIFO(about.st_mode)) /* opening it would wait for a reader */
        return status_fail(STATUS_RUN, "%s: cannot write: it is a pipe", csv->path);
    FILE *old = resume ? fopen(csv->path, "r") : NULL;
    long keep = old ? csv_past(old, header, places, limit) : 0;
    if (old) fclose(old);
    if (old && !keep) csv_set_aside(csv->path);
    if (keep && truncate(csv->path, keep)) return room_fail(csv->path, "write");
    csv->stream = fopen(csv->path, keep ? "a" : "w");
    if (!csv->stream) return room_fail(csv->path, "write");
    csv_replay(csv, csv->path, keep, false);
    if (keep) return STATUS_OK;
    TRY(csv_add(csv, header, strlen(header)));
    return csv_add(csv, "\n", 1);
}

int csv_open(const char *path, const char *header, const struct csv_places *places, bool resume, double limit,
             struct csv **ret_csv)
{
    struct csv *csv = mem_new(1, sizeof *csv);
    csv->path = mem_text(path);
    csv->sum = XXH64_createState();
    XXH64_reset(csv->sum, 0);
    int code = comm_agree(comm_rank() == 0 ? csv_start(csv, header, places, resume, limit) : STATUS_OK);
    if (code) csv_close(csv);
    else *ret_csv = csv;
    return code;
}

static int csv_put(struct csv *csv, unsigned rows, unsigned n, const double *values)
{
    struct text lines = {0};
    for (unsigned row = 0; row < rows; row++, values += n) {
        for (unsigned i = 0; i < n; i++) {
            const char *comma = i ? "," : "";
            if (isnan(values[i])) text_add(&lines, "%snan", comma);
            else text_add(&lines, "%s%.17g", comma, values[i]);
        }
        text_add(&lines, "\n");
    }
    int code = csv_add(csv, lines.at, lines.length);
    text_done(&lines);
    return code;
}

int csv_row(struct csv *csv, unsigned n, const double *values)
{
    return csv_rows(csv, 1, n, values);
}

int csv_rows(struct csv *csv, unsigned rows, unsigned n, const double *values)
{
    return comm_agree(comm_rank() == 0 ? csv_put(csv, rows, n, values) : STATUS_OK);
}

/* Length and checksum, the latter in two halves: a double holds 53 bits. */
static void csv_mark(const struct csv *csv, double ret_mark[3])
{
    XXH64_hash_t hash = XXH64_digest(csv->sum);
    ret_mark[0] = (double)csv->bytes;
    ret_mark[1] = (double)(hash >> 32);
    ret_mark[2] = (double)(hash & 0xffffffffu);
}

int csv_keep(struct csv *csv, const char *name, struct notes *notes)
{
    double mark[3] = {0};
    int code = STATUS_OK;
    if (comm_rank() == 0 && fsync(fileno(csv->stream))) code = room_fail(csv->path, "write");
    csv_mark(csv, mark);
    notes_put(notes, name, 3, mark);
    return comm_agree(code);
}

/* Does a file begin with what was noted? The sum then stands there. */
static bool csv_has(struct csv *csv, const char *path, const double mark[3])
{
    double found[3];
    csv_replay(csv, path, (long)mark[0], false);
    csv_mark(csv, found);
    return !memcmp(found, mark, sizeof found);
}

/* Takes the stream to an empty file, or to one of a length. */
static int csv_cut(struct csv *csv, long bytes)
{
    if (fflush(csv->stream) || ftruncate(fileno(csv->stream), bytes)) return room_fail(csv->path, "write");
    return fseek(csv->stream, 0, SEEK_END) ? room_fail(csv->path, "write") : STATUS_OK;
}

static int csv_return(struct csv *csv, const double mark[3], const char *origin)
{
    long now = csv->bytes;
    if (csv_has(csv, csv->path, mark)) return csv_cut(csv, csv->bytes);
    if (origin && csv_has(csv, origin, mark)) {
        TRY(csv_cut(csv, 0));
        if (csv_replay(csv, origin, (long)mark[0], true) != (long)mark[0] || fflush(csv->stream))
            return room_fail(csv->path, "write");
        return STATUS_OK;
    }
    log_warn("%s does not hold the rows that the checkpoint knows of; new rows follow those that are there", csv->path);
    csv_replay(csv, csv->path, now, false);
    return STATUS_OK;
}

int csv_recall(struct csv *csv, const char *name, const struct notes *notes, const char *origin)
{
    double mark[3];
    if (!notes_get(notes, name, 3, mark)) return STATUS_OK;
    return comm_agree(comm_rank() == 0 ? csv_return(csv, mark, origin) : STATUS_OK);
}

void csv_close(struct csv *csv)
{
    if (!csv) return;
    if (csv->stream) fclose(csv->stream);
    XXH64_freeState(csv->sum);
    mem_free(csv->path);
    mem_free(csv);
}
