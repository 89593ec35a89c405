/* resume.c - see resume.h. */
#include "io/resume.h"

#include "base/comm.h"
#include "base/log.h"
#include "base/mem.h"
#include "base/status.h"
#include "io/checkpoint.h"
#include "io/parts.h"
#include "mesh/morton.h"

#include <errno.h>
#include <fcntl.h>
#include <string.h>
#include <unistd.h>

int resume_damaged(const struct resume *resume, const char *what)
{
    return status_fail(STATUS_RUN, "%s: impossible checkpoint: %s", resume->path, what);
}

static int resume_lacks(const char *path, const char *name)
{
    return status_fail(STATUS_RUN, "%s: impossible checkpoint: no %s", path, name);
}

/* A part of the file; STATUS_RUN if it is not there. */
static int resume_part(const struct resume *resume, const char *name, const struct seal_part **ret_part)
{
    *ret_part = seal_find(&resume->seal, name);
    return *ret_part ? STATUS_OK : resume_lacks(resume->path, name);
}

int resume_has_rows(const struct resume *resume, const char *name, uint64_t bytes)
{
    for (unsigned i = 0; i < resume->n_part; i++) {
        const struct resume_file *file = &resume->parts[i];
        const struct seal_part *part = seal_find(&file->seal, name);
        if (!part && file->n_tile) return resume_lacks(file->path, name);
        if (part && part->length != file->n_tile * bytes)
            return status_fail(STATUS_RUN, "%s: impossible checkpoint: %s has not one row per tile", file->path, name);
    }
    return STATUS_OK;
}

/* The run that a tile is in. */
static const struct resume_run *resume_run(const struct resume *resume, size_t tile)
{
    size_t low = 0, high = resume->n_run;
    while (high - low > 1) {
        size_t middle = low + (high - low) / 2;
        if (resume->runs[middle].first <= tile) low = middle;
        else high = middle;
    }
    return &resume->runs[low];
}

/* Each rank opens the parts that have its tiles. */
static int resume_reach(struct resume_file *file)
{
    if (file->file < 0) file->file = open(file->path, O_RDONLY | O_CLOEXEC | O_NONBLOCK);
    if (file->file >= 0) return STATUS_OK;
    return status_fail(STATUS_RUN, "%s: rank %d cannot open it: %s", file->path, comm_rank(), strerror(errno));
}

int resume_row(const struct resume *resume, const char *name, size_t tile, uint64_t bytes, void *out)
{
    const struct resume_run *run = resume_run(resume, tile);
    struct resume_file *file = &resume->parts[run->part];
    const struct seal_part *part = seal_find(&file->seal, name);
    if (!part) return resume_lacks(file->path, name);
    TRY(resume_reach(file));
    return seal_bytes(file->file, file->path, part->offset + (run->local + (tile - run->first)) * bytes, bytes, out);
}

/* A part as a text; release with mem_free. */
static int resume_text(const struct resume *resume, const char *name, char **ret_text)
{
    const struct seal_part *part;
    TRY(resume_part(resume, name, &part));
    char *text = mem_new(part->length + 1, 1);
    int code = seal_bytes(resume->file, resume->path, part->offset, part->length, text);
    if (code) mem_free(text);
    else *ret_text = text;
    return code;
}

static int resume_read_notes(struct resume *resume)
{
    char *text;
    TRY(resume_text(resume, "/notes", &text));
    text_add(&resume->notes.text, "%s", text);
    mem_free(text);
    return STATUS_OK;
}

/* One row of /tiles; rows are sorted by level and along the curve, and no level is left out. */
static int resume_take_tile(struct resume *resume, size_t i, const int32_t row[CHECKPOINT_TILE])
{
    struct tile *tile = &resume->tiles[i];
    bool next = i > 0 && row[0] == resume->n_level, same = i > 0 && row[0] == resume->n_level - 1;
    if (i == 0 && row[0] == 0) next = true;
    if ((!next && !same) || row[0] >= MESH_LEVELS) return resume_damaged(resume, "levels are not in order");
    if (row[4] < 0 || row[4] > UINT8_MAX) return resume_damaged(resume, "a tile has been unwanted too often");
    for (int d = 0; d < 3; d++) {
        if (row[1 + d] < 0 || row[1 + d] > 0x1fffff) return resume_damaged(resume, "a tile outside of any domain");
        tile->at[d] = row[1 + d];
    }
    tile->unwanted = (unsigned char)row[4];
    tile->key = morton_key(tile->at);
    if (same && tile[-1].key >= tile->key) return resume_damaged(resume, "tiles are not in order");
    resume->n_level = row[0] + 1;
    resume->n_tile[row[0]]++;
    return STATUS_OK;
}

static int resume_read_tiles(struct resume *resume)
{
    const struct seal_part *part;
    TRY(resume_part(resume, "/tiles", &part));
    size_t row = CHECKPOINT_TILE * sizeof(int32_t), n = part->length / row;
    if (part->length % row || !n || n > UINT32_MAX)
        return resume_damaged(resume, "a list of tiles of no possible length");
    int32_t *rows = mem_new(n * CHECKPOINT_TILE, sizeof *rows);
    int code = seal_bytes(resume->file, resume->path, part->offset, part->length, rows);
    resume->tiles = mem_new(n, sizeof *resume->tiles);
    resume->n_all = n;
    for (size_t i = 0; !code && i < n; i++) code = resume_take_tile(resume, i, rows + i * CHECKPOINT_TILE);
    mem_free(rows);
    return code;
}

/* A checkpoint that holds its tiles itself. */
static void resume_read_alone(struct resume *resume)
{
    resume->runs = mem_new(1, sizeof *resume->runs);
    resume->runs[0].n = resume->n_all;
    resume->n_run = 1;
    resume->parts[0].n_tile = resume->n_all;
}

/* Which part has which tiles. */
static int resume_take_runs(struct resume *resume, const int32_t *rows, size_t n)
{
    size_t first = 0;
    resume->runs = mem_new(n, sizeof *resume->runs);
    for (resume->n_run = 0; resume->n_run < n; resume->n_run++, rows += CHECKPOINT_RUN) {
        if (rows[0] < 0 || (unsigned)rows[0] >= resume->n_part || rows[1] <= 0)
            return resume_damaged(resume, "tiles in a part that there is not");
        struct resume_file *file = &resume->parts[rows[0]];
        resume->runs[resume->n_run] = (struct resume_run){(unsigned)rows[0], first, (size_t)rows[1], file->n_tile};
        file->n_tile += (size_t)rows[1];
        first += (size_t)rows[1];
    }
    return first == resume->n_all ? STATUS_OK : resume_damaged(resume, "parts that have not all tiles");
}

static int resume_read_runs(struct resume *resume)
{
    const struct seal_part *part;
    TRY(resume_part(resume, "/runs", &part));
    size_t row = CHECKPOINT_RUN * sizeof(int32_t), n = part->length / row;
    if (part->length % row || !n) return resume_damaged(resume, "a list of runs of no possible length");
    int32_t *rows = mem_new(n * CHECKPOINT_RUN, sizeof *rows);
    int code = seal_bytes(resume->file, resume->path, part->offset, part->length, rows);
    if (!code) code = resume_take_runs(resume, rows, n);
    mem_free(rows);
    return code;
}

/* Everything but the fields. */
static int resume_read(struct resume *resume)
{
    TRY(resume_read_notes(resume));
    TRY(resume_read_tiles(resume));
    if (resume->seal.kind == SEAL_HEAD) return resume_read_runs(resume);
    resume_read_alone(resume);
    return STATUS_OK;
}

static struct resume *resume_handle(const char *path)
{
    struct resume *resume = mem_new(1, sizeof *resume);
    resume->path = mem_text(path);
    resume->file = -1;
    return resume;
}

/* The files that hold tiles, of which parts[i].seal is not known yet. */
static int resume_read_parts(struct resume *resume, struct parts_list *ret_list)
{
    char *text;
    resume->file = open(resume->path, O_RDONLY | O_CLOEXEC | O_NONBLOCK);
    if (resume->file < 0)
        return status_fail(STATUS_RUN, "%s: rank %d cannot open it: %s", resume->path, comm_rank(), strerror(errno));
    if (resume->seal.kind == SEAL_HEAD) {
        TRY(resume_text(resume, "/parts", &text));
        int code = parts_read(resume->path, text, ret_list);
        mem_free(text);
        TRY(code);
        if (!ret_list->n) return resume_damaged(resume, "an empty list of parts");
    }
    resume->n_part = ret_list->n ? ret_list->n : 1;
    resume->parts = mem_new(resume->n_part, sizeof *resume->parts);
    for (unsigned i = 0; i < resume->n_part; i++) {
        resume->parts[i].path = mem_text(ret_list->n ? ret_list->at[i].path : resume->path);
        resume->parts[i].file = -1;
    }
    if (!ret_list->n) resume->parts[0].seal = resume->seal;
    return STATUS_OK;
}

/* Verifies parts, each `step`-th from `first` on. */
static int resume_check_parts(struct resume *resume, const struct parts_list *list, int first, int step)
{
    for (unsigned i = (unsigned)first; i < list->n; i += (unsigned)step)
        TRY(parts_check(resume->path, list, i, seal_check, &resume->parts[i].seal));
    return STATUS_OK;
}

static int resume_look_at(struct resume *resume)
{
    struct parts_list list = {0};
    TRY(seal_check(resume->path, &resume->seal));
    int code = resume_read_parts(resume, &list);
    if (!code) code = resume_check_parts(resume, &list, 0, 1);
    parts_done(&list);
    return code ? code : resume_read(resume);
}

int resume_look(const char *path, struct resume **ret_resume)
{
    struct resume *resume = resume_handle(path);
    int code = resume_look_at(resume);
    if (code) resume_close(resume);
    else *ret_resume = resume;
    return code;
}

/* The ranks share the parts among them; all learn what each has found. */
static int resume_take_parts(struct resume *resume)
{
    struct parts_list list = {0};
    int code = comm_agree(resume_read_parts(resume, &list));
    if (!code) code = comm_agree(resume_check_parts(resume, &list, comm_rank(), comm_size()));
    for (unsigned i = 0; !code && i < list.n; i++)
        comm_bcast_from(&resume->parts[i].seal, sizeof resume->parts[i].seal, (int)(i % (unsigned)comm_size()));
    parts_done(&list);
    return code;
}

/* Rank 0 verifies the file for all. */
static int resume_take_all(struct resume *resume)
{
    TRY(comm_agree(comm_rank() == 0 ? seal_check(resume->path, &resume->seal) : STATUS_OK));
    comm_bcast(&resume->seal, sizeof resume->seal);
    TRY(resume_take_parts(resume));
    return comm_agree(resume_read(resume));
}

static int resume_take(const char *path, struct resume **ret_resume)
{
    struct resume *resume = resume_handle(path);
    int code = resume_take_all(resume);
    if (code) resume_close(resume);
    else *ret_resume = resume;
    return code;
}

int resume_open(const char *path, struct resume **ret_resume)
{
    return resume_take(path, ret_resume) ? status_wrap(STATUS_CASE, "cannot restart: ") : STATUS_OK;
}

/* The list of rank 0, on all ranks. */
static char **resume_candidates(const char *folder, unsigned *ret_n)
{
    char **paths = NULL;
    *ret_n = 0;
    if (comm_rank() == 0) checkpoint_list(folder, ret_n, &paths);
    comm_bcast(ret_n, sizeof *ret_n);
    if (comm_rank() != 0) paths = mem_new(*ret_n + 1u, sizeof *paths);
    for (unsigned i = 0; i < *ret_n; i++) {
        size_t length = paths[i] ? strlen(paths[i]) : 0;
        comm_bcast(&length, sizeof length);
        if (!paths[i]) paths[i] = mem_new(length + 1, 1);
        comm_bcast(paths[i], length);
    }
    return paths;
}

int resume_newest(const char *directory, struct resume **ret_resume)
{
    char *folder = mem_print("%s/checkpoints", directory);
    unsigned n;
    char **paths = resume_candidates(folder, &n);
    int code = status_fail(STATUS_CASE,
                           "cannot restart: there is no whole checkpoint in %s; output.checkpoints asks a run for them",
                           folder);
    for (unsigned i = 0; i < n; i++) {
        if (code) {
            code = resume_take(paths[i], ret_resume);
            if (code) log_warn("passed over: %s", status_text());
        }
        mem_free(paths[i]);
    }
    mem_free(paths);
    if (code && n) code = status_fail(STATUS_CASE, "cannot restart: no checkpoint in %s is whole", folder);
    mem_free(folder);
    return code;
}

void resume_close(struct resume *resume)
{
    if (!resume) return;
    if (resume->file >= 0) close(resume->file);
    for (unsigned i = 0; i < resume->n_part; i++) {
        if (resume->parts[i].file >= 0) close(resume->parts[i].file);
        mem_free(resume->parts[i].path);
    }
    mem_free(resume->parts);
    mem_free(resume->runs);
    text_done(&resume->notes.text);
    mem_free(resume->tiles);
    mem_free(resume->path);
    mem_free(resume);
}
