/* checkpoint.c - see checkpoint.h. The order of events for one file: draft written by rank 0 with the rows of
 * all ranks, closed, made lasting, read back and compared, sealed, renamed, folder made lasting; then older
 * files removed. Where there are parts, each writer does all this with its own first, up to the renaming. A crash
 * anywhere leaves the older files and at most a draft. */
#include "io/checkpoint.h"

#include "base/comm.h"
#include "base/gather.h"
#include "base/mem.h"
#include "base/status.h"
#include "base/version.h"
#include "io/facts.h"
#include "io/h5out.h"
#include "io/parts.h"
#include "io/place.h"
#include "io/roll.h"
#include "io/room.h"
#include "io/seal.h"
#include "io/writers.h"
#include "solve/evaporate.h"
#include "solve/peak.h"

#include <dirent.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>
#include <unistd.h>

enum { CHECKPOINT_MESSAGE = 4 << 20, CHECKPOINT_KEEP = 2 }; /* bytes of rows that travel together; files kept */

struct checkpoints {
    const struct scene *scene;
    char *folder, *last;
    int keep, writers;
    long step; /* of the last file, or -1 */
};

/* One file being written. */
struct checkpoint {
    struct h5 *file;
    const struct state *state;
    struct roll roll;
    struct seal seal; /* rank 0 */
    struct seal part; /* of this rank's writer, if there are several */
};

struct checkpoints *checkpoint_new(const struct scene *scene)
{
    struct checkpoints *checkpoints = mem_new(1, sizeof *checkpoints);
    checkpoints->scene = scene;
    checkpoints->folder = mem_print("%s/checkpoints", scene->output.directory);
    checkpoints->writers = writers_count(scene);
    checkpoints->keep = scene->output.checkpoints_keep > 0 ? scene->output.checkpoints_keep : CHECKPOINT_KEEP;
    checkpoints->step = -1;
    return checkpoints;
}

void checkpoint_free(struct checkpoints *checkpoints)
{
    if (!checkpoints) return;
    mem_free(checkpoints->folder);
    mem_free(checkpoints->last);
    mem_free(checkpoints);
}

const char *checkpoint_last(const struct checkpoints *checkpoints)
{
    return checkpoints->last;
}

/* A checkpoint in a folder; number 0: its header is damaged. */
struct checkpoint_entry {
    uint64_t number;
    char *path;
};

static int checkpoint_compare(const void *a, const void *b)
{
    uint64_t x = ((const struct checkpoint_entry *)a)->number, y = ((const struct checkpoint_entry *)b)->number;
    return x && y ? (x < y) - (x > y) : (x > y) - (x < y);
}

/* All of them, damaged ones first, then the highest number; NULL if there are none. */
static struct checkpoint_entry *checkpoint_entries(const char *folder, unsigned *ret_n)
{
    struct checkpoint_entry *entries = NULL;
    unsigned n = 0;
    DIR *stream = opendir(folder);
    for (struct dirent *entry; stream && (entry = readdir(stream));) {
        size_t length = strlen(entry->d_name);
        if (length < 4 || strcmp(entry->d_name + length - 4, ".chk")) continue;
        struct seal seal;
        char *path = mem_print("%s/%s", folder, entry->d_name);
        entries = mem_grow(entries, n, n + 1, sizeof *entries);
        entries[n++] = (struct checkpoint_entry){seal_read(path, &seal) ? 0 : seal.number, path};
    }
    if (stream) closedir(stream);
    if (n) qsort(entries, n, sizeof *entries, checkpoint_compare);
    *ret_n = n;
    return entries;
}

void checkpoint_list(const char *folder, unsigned *ret_n, char ***ret_paths)
{
    struct checkpoint_entry *entries = checkpoint_entries(folder, ret_n);
    char **paths = mem_new(*ret_n + 1u, sizeof *paths);
    for (unsigned i = 0; i < *ret_n; i++) paths[i] = entries[i].path;
    mem_free(entries);
    *ret_paths = paths;
}

/* What each criterion of refinement has tagged, on all ranks. */
static void checkpoint_note_tagged(const struct state *state, struct notes *notes)
{
    unsigned n = state->scene->mesh.n_refine;
    long long *counts = mem_new(n + 1, sizeof *counts);
    double *tagged = mem_new(n + 1, sizeof *tagged);
    memcpy(counts, state->tagged, n * sizeof *counts);
    comm_sum_counts(counts, (int)n);
    for (unsigned i = 0; i < n; i++) tagged[i] = (double)counts[i];
    notes_put(notes, "refine.tagged", n, tagged);
    mem_free(tagged);
    mem_free(counts);
}

/* Accounts of what has evaporated, where some column asks for it. */
static void checkpoint_note_evaporated(const struct state *state, struct notes *notes)
{
    for (unsigned k = 0; k < state->scene->n_phase; k++) {
        const struct account all = evaporate_account(state, k);
        double digits[ACCOUNT_DIGITS];
        bool any = false;
        char name[32];
        snprintf(name, sizeof name, "evaporated.%u", k);
        for (int i = 0; i < ACCOUNT_DIGITS; i++) {
            digits[i] = (double)all.digit[i];
            any = any || all.digit[i];
        }
        if (any) notes_put(notes, name, ACCOUNT_DIGITS, digits);
    }
}

/* Cell-steps, and most cells at a time, one after the other. */
static void checkpoint_note_cells(struct notes *notes, const char *name, unsigned n, const long long *sum,
                                  const long long *most)
{
    double cells[2 * SCENE_MATERIALS];
    for (unsigned i = 0; i < n; i++) {
        cells[2 * i] = (double)sum[i];
        cells[2 * i + 1] = (double)most[i];
    }
    if (n) notes_put(notes, name, 2 * n, cells);
}

/* Counts about laws. */
static void checkpoint_note_laws(const struct state_counts *counts, const struct model *model, struct notes *notes)
{
    const struct mix_effort *closures = &counts->closures;
    notes_put(notes, "counts.closures", 4,
              (double[]){(double)closures->solved, (double)closures->steps, (double)closures->failed,
                         (double)closures->most});
    checkpoint_note_cells(notes, "counts.outside", model->n_material, counts->outside, counts->outside_most);
    checkpoint_note_cells(notes, "counts.past", model->n_phase, counts->past, counts->past_most);
}

/* The numbers of a state, as rebuild.c reads them back. */
static void checkpoint_note(const struct state *state, struct notes *notes)
{
    struct state_counts counts = state_counts_total(state);
    double steps[MESH_LEVELS];
    const double sums[] = {(double)counts.cells,   (double)counts.fallback, (double)counts.relaxed,
                           (double)counts.clipped, (double)counts.limited,  (double)counts.spread};
    for (int l = 0; l < MESH_LEVELS; l++) steps[l] = (double)state->level_steps[l];
    notes_put_one(notes, "state.t", state->t);
    notes_put_one(notes, "state.dt", state->dt);
    notes_put_one(notes, "state.dt_shrink", state->dt_shrink);
    notes_put_one(notes, "state.dt_longest", state->dt_longest);
    notes_put_one(notes, "state.step", (double)state->step);
    notes_put(notes, "state.level_steps", MESH_LEVELS, steps);
    notes_put(notes, "counts.of_all_ranks", 6, sums);
    notes_put_one(notes, "cells.carried", (double)counts.carried);
    checkpoint_note_laws(&counts, state->model, notes);
    checkpoint_note_tagged(state, notes);
    checkpoint_note_evaporated(state, notes);
    notes_put(notes, "counts.of_each_rank", 2, (double[]){(double)counts.retries, (double)counts.regrids});
}

/* Who wrote it, when, and what it is of. */
static void checkpoint_note_origin(const struct state *state, struct notes *notes)
{
    char now[32];
    time_t clock = time(NULL);
    struct tm parts;
    strftime(now, sizeof now, "%Y-%m-%dT%H:%M:%SZ", gmtime_r(&clock, &parts));
    notes_put_text(notes, "written.at", now);
    notes_put_text(notes, "written.by", "bulla " BULLA_VERSION);
    notes_put_text(notes, "written.commit", version_commit());
    notes_put_one(notes, "written.ranks", comm_size());
    notes_put_text(notes, "case.name", state->scene->name);
    notes_put_text(notes, "case.title", state->scene->title ? state->scene->title : "");
}

static void checkpoint_fill_u(void *context, size_t first, size_t count, void *out)
{
    const struct roll *roll = &((struct checkpoint *)context)->roll;
    const struct mesh *mesh = roll->mesh;
    size_t block = mesh->n_field * mesh->n_cell;
    for (size_t i = 0; i < count; i++) {
        int l;
        unsigned local = roll_local(roll, first + i, &l);
        memcpy((double *)out + i * block, mesh->levels[l].u_old[local], block * sizeof(double));
    }
}

static void checkpoint_fill_p(void *context, size_t first, size_t count, void *out)
{
    const struct roll *roll = &((struct checkpoint *)context)->roll;
    const struct state *state = ((struct checkpoint *)context)->state;
    const struct mesh *mesh = roll->mesh;
    for (size_t i = 0; i < count; i++) {
        int l;
        unsigned local = roll_local(roll, first + i, &l);
        memcpy((double *)out + i * mesh->n_cell, mesh->levels[l].w[local] + state->model->i_E * mesh->n_cell,
               mesh->n_cell * sizeof(double));
    }
}

static void checkpoint_fill_kept(void *context, size_t first, size_t count, void *out)
{
    const struct roll *roll = &((struct checkpoint *)context)->roll;
    const struct mesh *mesh = roll->mesh;
    size_t block = mesh->n_kept * mesh->n_cell;
    for (size_t i = 0; i < count; i++) {
        int l;
        unsigned local = roll_local(roll, first + i, &l);
        memcpy((double *)out + i * block, mesh->levels[l].kept[local], block * sizeof(double));
    }
}

/* Adds a data set that has been written to the list of a seal. */
static void checkpoint_list_part(struct h5 *file, struct seal *seal, const char *path, uint64_t hash)
{
    if (file->idle || file->code) return;
    uint64_t offset, length;
    h5out_place(file, path, &offset, &length);
    if (!file->code) seal_add(seal, path, offset, length, hash);
}

/* Rows lie in the file itself, or in that of a writer, if it has any. */
static void checkpoint_list_rows(struct checkpoint *point, const char *path, uint64_t hash)
{
    struct h5 *part = point->file->part;
    if (!part) checkpoint_list_part(point->file, &point->seal, path, hash);
    else if (!part->idle && h5out_has(part, path)) checkpoint_list_part(part, &point->part, path, hash);
}

static int checkpoint_put_rows(struct checkpoint *point, const char *path, size_t columns,
                               void (*fill)(void *, size_t, size_t, void *))
{
    uint64_t hash = 0;
    size_t rows = CHECKPOINT_MESSAGE / (columns * sizeof(double));
    const struct h5out_rows all = {.type = H5_F64,
                                   .columns = (unsigned)columns,
                                   .total = point->roll.n_tile,
                                   .chunk = rows ? rows : 1,
                                   .hash = &hash,
                                   .n_range = (unsigned)point->state->mesh->n_level,
                                   .ranges = point->roll.tiles,
                                   .fill = fill,
                                   .context = point};
    TRY(h5out_write(point->file, path, &all));
    checkpoint_list_rows(point, path, hash);
    return STATUS_OK;
}

/* What outputs keep in cells; those under finer tiles get what these have, for runs that go on with fewer levels. */
static int checkpoint_put_kept(struct checkpoint *point)
{
    const struct mesh *mesh = point->state->mesh;
    if (!mesh->n_kept) return STATUS_OK;
    peak_up(mesh, &point->state->scene->output, 0);
    return checkpoint_put_rows(point, "/kept", mesh->n_kept * mesh->n_cell, checkpoint_fill_kept);
}

static void checkpoint_tile(int level, const struct tile *tile, int32_t *ret_row)
{
    const int32_t row[CHECKPOINT_TILE] = {level, tile->at[0], tile->at[1], tile->at[2], tile->unwanted};
    memcpy(ret_row, row, sizeof row);
}

static int checkpoint_put_tiles(struct checkpoint *point)
{
    uint64_t hash = 0;
    TRY(roll_write(point->file, "/tiles", &point->roll, CHECKPOINT_TILE, checkpoint_tile, &hash));
    checkpoint_list_part(point->file, &point->seal, "/tiles", hash);
    return STATUS_OK;
}

/* Which tiles a part holds: runs of [part, tiles], in the order of all tiles, from counts[rank][level]. */
static void checkpoint_write_runs(struct checkpoint *point, const uint32_t *counts)
{
    int levels = point->roll.mesh->n_level, ranks = comm_size();
    int32_t *runs = mem_new((size_t)levels * (size_t)point->file->writers * CHECKPOINT_RUN, sizeof *runs);
    size_t n = 0;
    for (int l = 0; l < levels; l++)
        for (int rank = 0; rank < ranks; rank++) {
            int32_t writer = writers_of(point->file->writers, rank), tiles = (int32_t)counts[rank * levels + l];
            if (!tiles) continue;
            if (n == 0 || runs[(n - 1) * CHECKPOINT_RUN] != writer) runs[n++ * CHECKPOINT_RUN] = writer;
            runs[(n - 1) * CHECKPOINT_RUN + 1] += tiles;
        }
    h5out_array(point->file, "/runs", H5_I32, n, CHECKPOINT_RUN, runs);
    checkpoint_list_part(point->file, &point->seal, "/runs", seal_hash(runs, n * CHECKPOINT_RUN * sizeof *runs));
    mem_free(runs);
}

static void checkpoint_put_runs(struct checkpoint *point)
{
    const struct mesh *mesh = point->roll.mesh;
    if (point->file->writers == 1) return;
    uint32_t own[MESH_LEVELS];
    unsigned n;
    for (int l = 0; l < mesh->n_level; l++) own[l] = mesh->levels[l].n_local;
    uint32_t *counts = gather_items(own, sizeof *own, (unsigned)mesh->n_level, &n);
    if (comm_rank() == 0) checkpoint_write_runs(point, counts);
    mem_free(counts);
}

static void checkpoint_put_text(struct checkpoint *point, const char *path, const char *text)
{
    h5out_text(point->file, path, text);
    checkpoint_list_part(point->file, &point->seal, path, seal_hash(text, strlen(text)));
}

static int checkpoint_fill(struct checkpoint *point, const struct notes *outputs)
{
    const struct state *state = point->state;
    const struct mesh *mesh = state->mesh;
    struct notes notes = {0};
    checkpoint_note_origin(state, &notes);
    checkpoint_note(state, &notes);
    facts_put(state->scene, state->model, mesh->n[0], &notes);
    facts_put_kept(state->scene, &notes);
    text_add(&notes.text, "%s", outputs->text.at ? outputs->text.at : "");
    checkpoint_put_text(point, "/case.yaml", state->scene->resolved);
    checkpoint_put_text(point, "/notes", notes.text.at);
    text_done(&notes.text);
    TRY(checkpoint_put_tiles(point));
    checkpoint_put_runs(point);
    TRY(checkpoint_put_rows(point, "/u", mesh->n_field * mesh->n_cell, checkpoint_fill_u));
    if (!state->model->linear) TRY(checkpoint_put_rows(point, "/p", mesh->n_cell, checkpoint_fill_p));
    return checkpoint_put_kept(point);
}

/* Seals the parts, if there are any, and lists them. */
static int checkpoint_seal_parts(struct checkpoint *point, const struct parts *parts)
{
    uint64_t hash;
    TRY(parts_seal(parts, point->file, "/parts", seal_close, &point->part, &hash));
    if (point->file->part) {
        point->seal.kind = SEAL_HEAD;
        checkpoint_list_part(point->file, &point->seal, "/parts", hash);
    }
    return STATUS_OK;
}

/* Writes the data; the header stays empty. */
static int checkpoint_draft(struct checkpoint *point, const struct parts *parts, const struct notes *outputs)
{
    roll_take(point->state->mesh, &point->roll);
    TRY(parts_create(parts, SEAL_BYTES, &point->file));
    int code = checkpoint_fill(point, outputs);
    if (!code) code = checkpoint_seal_parts(point, parts);
    if (!code) return h5_close(point->file);
    h5_abandon(point->file);
    return code;
}

/* The parts of a file go after it: without it they mean nothing. */
static void checkpoint_remove(const char *path)
{
    unlink(path);
    parts_remove(path);
}

/* Seals the draft, gives it its name and removes what is too old. Rank 0. */
static int checkpoint_accept(const struct checkpoints *checkpoints, struct seal *seal, const char *draft,
                             const char *path)
{
    unsigned n;
    struct checkpoint_entry *entries = checkpoint_entries(checkpoints->folder, &n);
    for (unsigned i = 0; i < n; i++)
        if (entries[i].number > seal->number) seal->number = entries[i].number;
    seal->number++;
    int code = seal_close(draft, seal);
    if (!code && rename(draft, path)) code = room_fail(path, "rename to it");
    if (!code) code = seal_sync_folder(checkpoints->folder);
    if (!code) code = seal_sync_folder(checkpoints->scene->output.directory); /* in which the folder may be new */
    for (unsigned i = 0, kept = 1; i < n; i++) {
        bool counts = entries[i].number && strcmp(entries[i].path, path) != 0;
        if (!code && counts && kept++ >= (unsigned)checkpoints->keep) checkpoint_remove(entries[i].path);
        mem_free(entries[i].path);
    }
    mem_free(entries);
    return code;
}

/* Writes the file `path`. */
static int checkpoint_put(struct checkpoints *checkpoints, const struct state *state, const struct notes *outputs,
                          const char *path)
{
    char *draft = place_draft(path);
    struct parts *parts = parts_new(path, checkpoints->writers, false);
    struct checkpoint point = {.state = state};
    int code = checkpoint_draft(&point, parts, outputs);
    if (!code) code = parts_accept(parts);
    if (!code) code = comm_agree(comm_rank() == 0 ? checkpoint_accept(checkpoints, &point.seal, draft, path) : 0);
    if (code) place_reject(path);
    if (code) parts_reject(parts);
    else parts_clean(parts);
    parts_free(parts);
    mem_free(draft);
    return code;
}

int checkpoint_write(struct checkpoints *checkpoints, const struct state *state, const struct notes *outputs)
{
    if (checkpoints->step == state->step) return STATUS_OK;
    TRY(place_folder(checkpoints->folder));
    char *path = mem_print("%s/%s_%06ld.chk", checkpoints->folder, state->scene->name, state->step);
    int code = checkpoint_put(checkpoints, state, outputs, path);
    if (code) {
        mem_free(path);
        return status_wrap(code, "no checkpoint of step %ld: ", state->step);
    }
    mem_free(checkpoints->last);
    checkpoints->last = path;
    checkpoints->step = state->step;
    return STATUS_OK;
}
