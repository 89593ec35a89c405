/* resume.c - see resume.h. */
#include "io/resume.h"

#include "base/comm.h"
#include "base/log.h"
#include "base/mem.h"
#include "base/status.h"
#include "base/swap.h"
#include "io/checkpoint.h"
#include "io/parts.h"
#include "io/resume_runs.h"
#include "mesh/morton.h"
#include "mesh/partition.h"

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

/* STATUS_OK on all that share the lists, or a failure on all. */
static int resume_agree(const struct resume *resume, int code)
{
    return resume->size > 1 ? comm_agree(code) : code;
}

static int resume_check_rows(const struct resume *resume, const char *name, uint64_t bytes)
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

int resume_has_rows(const struct resume *resume, const char *name, uint64_t bytes)
{
    return resume_agree(resume, resume->rank == 0 ? resume_check_rows(resume, name, bytes) : STATUS_OK);
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
    const struct resume_run *run = resume_runs_find(resume, tile);
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

/* A row of /tiles, of which some rank has looked at what is in it. */
static struct tile resume_tile(const int32_t row[CHECKPOINT_TILE])
{
    struct tile tile = {.at = {row[1], row[2], row[3]}, .unwanted = (unsigned char)row[4]};
    tile.key = morton_key(tile.at);
    return tile;
}

/* A row of /tiles, and the one before it (NULL: it is the first); rows are sorted by level and along the curve, and no
 * level is left out. */
static int resume_check_tile(const struct resume *resume, const int32_t row[CHECKPOINT_TILE], const int32_t *before)
{
    bool same = before && row[0] == before[0], next = row[0] == (before ? before[0] + 1 : 0);
    if ((!next && !same) || row[0] < 0 || row[0] >= MESH_LEVELS)
        return resume_damaged(resume, "levels are not in order");
    if (row[4] < 0 || row[4] > UINT8_MAX) return resume_damaged(resume, "a tile has been unwanted too often");
    for (int d = 0; d < 3; d++)
        if (row[1 + d] < 0 || row[1 + d] > 0x1fffff) return resume_damaged(resume, "a tile outside of any domain");
    if (same && resume_tile(before).key >= resume_tile(row).key)
        return resume_damaged(resume, "tiles are not in order");
    return STATUS_OK;
}

/* Rows of /tiles from `first` on. */
static int resume_rows(const struct resume *resume, const struct seal_part *part, size_t first, size_t n, int32_t *rows)
{
    size_t row = CHECKPOINT_TILE * sizeof *rows;
    return seal_bytes(resume->file, resume->path, part->offset + first * row, n * row, rows);
}

/* Looks at an equal part of the whole list; how many of each level it has. */
static int resume_survey(const struct resume *resume, const struct seal_part *part, long long ret_counts[MESH_LEVELS])
{
    size_t size = (size_t)resume->size, rank = (size_t)resume->rank;
    size_t from = resume->n_all * rank / size, end = resume->n_all * (rank + 1) / size, seen = from ? from - 1 : 0;
    int32_t *rows = mem_new((end - seen + 1) * CHECKPOINT_TILE, sizeof *rows), *row = rows;
    int code = resume_rows(resume, part, seen, end - seen, rows);
    if (from) row += CHECKPOINT_TILE;
    for (size_t i = from; !code && i < end; i++, row += CHECKPOINT_TILE) {
        code = resume_check_tile(resume, row, i ? row - CHECKPOINT_TILE : NULL);
        if (!code) ret_counts[row[0]]++;
    }
    mem_free(rows);
    return code;
}

/* Which tiles of each level are this rank's. */
static void resume_cut(struct resume *resume, const long long counts[MESH_LEVELS])
{
    uint32_t *first = mem_new((size_t)resume->size + 1, sizeof *first);
    for (int l = 0; l < MESH_LEVELS && counts[l]; l++) {
        resume->n_level = l + 1;
        resume->n_tile[l] = (unsigned)counts[l];
        partition_equal(resume->n_tile[l], resume->size, first);
        resume->first[l] = first[resume->rank];
        resume->n_own[l] = first[resume->rank + 1] - first[resume->rank];
        resume->n_here += resume->n_own[l];
    }
    mem_free(first);
}

static int resume_read_pieces(struct resume *resume, const struct seal_part *part)
{
    size_t begin = 0;
    int code = STATUS_OK;
    struct tile *tile = resume->tiles = mem_new(resume->n_here + 1, sizeof *tile);
    for (int l = 0; l < resume->n_level && !code; begin += resume->n_tile[l++]) {
        size_t n = resume->n_own[l];
        int32_t *rows = mem_new((n + 1) * CHECKPOINT_TILE, sizeof *rows);
        code = resume_rows(resume, part, begin + resume->first[l], n, rows);
        for (size_t i = 0; i < n && !code; i++) *tile++ = resume_tile(rows + i * CHECKPOINT_TILE);
        mem_free(rows);
    }
    return code;
}

/* An empty piece begins where the next one does. */
static void resume_tell_keys(struct resume *resume)
{
    const struct tile *tile = resume->tiles;
    for (int l = 0; l < resume->n_level; tile += resume->n_own[l++]) {
        uint64_t own = resume->n_own[l] ? tile->key : UINT64_MAX;
        uint64_t *keys = resume->first_keys[l] = mem_new((size_t)resume->size, sizeof *keys);
        keys[0] = own;
        if (resume->size > 1) comm_join_rows(&own, 1, keys);
        for (int r = resume->size - 1; r-- > 0;)
            if (keys[r] == UINT64_MAX) keys[r] = keys[r + 1];
    }
}

static int resume_read_tiles(struct resume *resume)
{
    const struct seal_part *part;
    long long counts[MESH_LEVELS] = {0};
    TRY(resume_part(resume, "/tiles", &part));
    size_t row = CHECKPOINT_TILE * sizeof(int32_t), n = part->length / row;
    if (part->length % row || !n || n > UINT32_MAX)
        return resume_damaged(resume, "a list of tiles of no possible length");
    resume->n_all = n;
    TRY(resume_agree(resume, resume_survey(resume, part, counts)));
    if (resume->size > 1) comm_sum_counts(counts, MESH_LEVELS);
    resume_cut(resume, counts);
    TRY(resume_agree(resume, resume_read_pieces(resume, part)));
    resume_tell_keys(resume);
    return STATUS_OK;
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
static int resume_read(struct resume *resume, const struct parts_list *list)
{
    TRY(resume_agree(resume, resume_read_notes(resume)));
    TRY(resume_read_tiles(resume));
    if (resume->seal.kind != SEAL_HEAD) {
        resume_read_alone(resume);
        return STATUS_OK;
    }
    TRY(resume_agree(resume, resume->rank == 0 ? resume_read_runs(resume) : STATUS_OK));
    return resume->size > 1 ? resume_runs_deal(resume, list) : STATUS_OK;
}

/* For this rank of so many that share the lists. */
static struct resume *resume_handle(const char *path, int rank, int size)
{
    struct resume *resume = mem_new(1, sizeof *resume);
    resume->path = mem_text(path);
    resume->file = -1;
    resume->rank = rank;
    resume->size = size;
    return resume;
}

static int resume_reach_head(struct resume *resume)
{
    resume->file = open(resume->path, O_RDONLY | O_CLOEXEC | O_NONBLOCK);
    if (resume->file >= 0) return STATUS_OK;
    return status_fail(STATUS_RUN, "%s: rank %d cannot open it: %s", resume->path, comm_rank(), strerror(errno));
}

/* A text of rank 0 (NULL elsewhere), on all. */
static char *resume_spread(char *text)
{
    size_t bytes = text ? strlen(text) + 1 : 0;
    comm_bcast(&bytes, sizeof bytes);
    if (!text) text = mem_new(bytes, 1);
    comm_bcast(text, bytes);
    return text;
}

/* The list of parts of a head, which rank 0 reads. */
static int resume_read_list(struct resume *resume, struct parts_list *ret_list)
{
    char *text = NULL;
    TRY(resume_agree(resume, resume->rank == 0 ? resume_text(resume, "/parts", &text) : STATUS_OK));
    if (resume->size > 1) text = resume_spread(text);
    int code = parts_read(resume->path, text, ret_list);
    mem_free(text);
    if (!code && !ret_list->n) code = resume_damaged(resume, "an empty list of parts");
    return code;
}

/* The files that hold tiles: of several parts rank 0 alone knows all, and has their seals later. */
static void resume_name_parts(struct resume *resume, const struct parts_list *list)
{
    if (resume->seal.kind == SEAL_HEAD && resume->rank > 0) return;
    resume->n_part = list->n ? list->n : 1;
    resume->parts = mem_new(resume->n_part, sizeof *resume->parts);
    for (unsigned i = 0; i < resume->n_part; i++) {
        resume->parts[i].path = mem_text(list->n ? list->at[i].path : resume->path);
        resume->parts[i].file = -1;
    }
    if (!list->n) resume->parts[0].seal = resume->seal;
}

/* The seal of a part, from who has verified it. */
struct resume_seal {
    uint64_t part;
    struct seal seal;
};

/* Verifies the parts that are this rank's to verify, *ret_n of them. */
static int resume_check_parts(const struct resume *resume, const struct parts_list *list, struct resume_seal *ret_seals,
                              unsigned *ret_n)
{
    *ret_n = 0;
    for (unsigned i = (unsigned)resume->rank; i < list->n; i += (unsigned)resume->size) {
        ret_seals[*ret_n].part = i;
        TRY(parts_check(resume->path, list, i, seal_check, &ret_seals[(*ret_n)++].seal));
    }
    return STATUS_OK;
}

/* Rank 0 gets the seals. */
static void resume_join_seals(struct resume *resume, const struct resume_seal *seals, unsigned n)
{
    struct swap got = {0};
    int *to = mem_new(n, sizeof *to);
    if (resume->size > 1) {
        swap_items(seals, sizeof *seals, n, to, &got);
        seals = got.items;
        n = got.n;
    }
    for (unsigned i = 0; i < n; i++) resume->parts[seals[i].part].seal = seals[i].seal;
    swap_done(&got);
    mem_free(to);
}

/* The ranks share the parts among them. */
static int resume_take_parts(struct resume *resume, const struct parts_list *list)
{
    unsigned n;
    if (!list->n) return STATUS_OK;
    struct resume_seal *seals = mem_new(list->n / (unsigned)resume->size + 1u, sizeof *seals);
    int code = resume_agree(resume, resume_check_parts(resume, list, seals, &n));
    if (!code) resume_join_seals(resume, seals, n);
    mem_free(seals);
    return code;
}

/* A file whose seal is known. */
static int resume_take_lists(struct resume *resume, struct parts_list *list)
{
    TRY(resume_agree(resume, resume_reach_head(resume)));
    if (resume->seal.kind == SEAL_HEAD) TRY(resume_read_list(resume, list));
    resume_name_parts(resume, list);
    TRY(resume_take_parts(resume, list));
    return resume_read(resume, list);
}

static int resume_look_at(struct resume *resume)
{
    struct parts_list list = {0};
    TRY(seal_check(resume->path, &resume->seal));
    int code = resume_take_lists(resume, &list);
    parts_done(&list);
    return code;
}

int resume_look(const char *path, struct resume **ret_resume)
{
    struct resume *resume = resume_handle(path, 0, 1);
    int code = resume_look_at(resume);
    if (code) resume_close(resume);
    else *ret_resume = resume;
    return code;
}

/* Rank 0 verifies the file for all. */
static int resume_take_all(struct resume *resume)
{
    struct parts_list list = {0};
    TRY(comm_agree(comm_rank() == 0 ? seal_check(resume->path, &resume->seal) : STATUS_OK));
    comm_bcast(&resume->seal, sizeof resume->seal);
    int code = comm_agree(resume_take_lists(resume, &list));
    parts_done(&list);
    return code;
}

static int resume_take(const char *path, struct resume **ret_resume)
{
    struct resume *resume = resume_handle(path, comm_rank(), comm_size());
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
    for (int l = 0; l < resume->n_level; l++) mem_free(resume->first_keys[l]);
    mem_free(resume->path);
    mem_free(resume);
}
