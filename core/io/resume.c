/* resume.c - see resume.h. */
#include "io/resume.h"

#include "base/comm.h"
#include "base/log.h"
#include "base/mem.h"
#include "base/status.h"
#include "io/checkpoint.h"
#include "mesh/morton.h"

#include <errno.h>
#include <fcntl.h>
#include <string.h>
#include <unistd.h>

int resume_damaged(const struct resume *resume, const char *what)
{
    return status_fail(STATUS_RUN, "%s: impossible checkpoint: %s", resume->path, what);
}

int resume_part(const struct resume *resume, const char *name, const struct seal_part **ret_part)
{
    *ret_part = seal_find(&resume->seal, name);
    return *ret_part ? STATUS_OK : status_fail(STATUS_RUN, "%s: impossible checkpoint: no %s", resume->path, name);
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

/* Everything but the fields. */
static int resume_read(struct resume *resume)
{
    resume->file = open(resume->path, O_RDONLY | O_CLOEXEC | O_NONBLOCK);
    if (resume->file < 0)
        return status_fail(STATUS_RUN, "%s: rank %d cannot open it: %s", resume->path, comm_rank(), strerror(errno));
    TRY(resume_read_notes(resume));
    return resume_read_tiles(resume);
}

static struct resume *resume_handle(const char *path)
{
    struct resume *resume = mem_new(1, sizeof *resume);
    resume->path = mem_text(path);
    resume->file = -1;
    return resume;
}

int resume_look(const char *path, struct resume **ret_resume)
{
    struct resume *resume = resume_handle(path);
    int code = seal_check(path, &resume->seal);
    if (!code) code = resume_read(resume);
    if (code) resume_close(resume);
    else *ret_resume = resume;
    return code;
}

/* Rank 0 verifies for all. */
static int resume_take(const char *path, struct resume **ret_resume)
{
    struct resume *resume = resume_handle(path);
    int code = comm_agree(comm_rank() == 0 ? seal_check(path, &resume->seal) : STATUS_OK);
    if (!code) {
        comm_bcast(&resume->seal, sizeof resume->seal);
        code = comm_agree(resume_read(resume));
    }
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
    text_done(&resume->notes.text);
    mem_free(resume->tiles);
    mem_free(resume->path);
    mem_free(resume);
}
