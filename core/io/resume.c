/* resume.c - see resume.h. */
#include "io/resume.h"

#include "base/comm.h"
#include "base/log.h"
#include "base/mem.h"
#include "base/status.h"
#include "io/checkpoint.h"
#include "io/facts.h"
#include "io/seal.h"
#include "mesh/morton.h"
#include "mesh/nest.h"

#include <errno.h>
#include <fcntl.h>
#include <math.h>
#include <string.h>
#include <unistd.h>

struct resume {
    char *path;
    int file;
    struct seal seal;
    struct notes notes;
    unsigned n_tile[MESH_LEVELS];
    int n_level;
    struct tile *tiles; /* of all levels */
    size_t n_all, n_cell, n_field;
};

static int resume_damaged(const struct resume *resume, const char *what)
{
    return status_fail(STATUS_RUN, "%s: impossible checkpoint: %s", resume->path, what);
}

static int resume_part(const struct resume *resume, const char *name, const struct seal_part **ret_part)
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

static int resume_verify(struct resume *resume)
{
    return seal_check(resume->path, &resume->seal);
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

static int resume_take(const char *path, struct resume **ret_resume)
{
    struct resume *resume = mem_new(1, sizeof *resume);
    resume->path = mem_text(path);
    resume->file = -1;
    int code = comm_agree(comm_rank() == 0 ? resume_verify(resume) : STATUS_OK);
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

const struct notes *resume_notes(const struct resume *resume)
{
    return &resume->notes;
}

const char *resume_path(const struct resume *resume)
{
    return resume->path;
}

/* The source's `fill`: a tile's block, at its place in the file. */
static int resume_fill(void *data, int level, unsigned tile, double *u, double *p)
{
    const struct resume *resume = data;
    const struct seal_part *part;
    size_t index = tile;
    uint64_t block = resume->n_field * resume->n_cell * sizeof(double), row = resume->n_cell * sizeof(double);
    for (int l = 0; l < level; l++) index += resume->n_tile[l];
    TRY(resume_part(resume, "/u", &part));
    TRY(seal_bytes(resume->file, resume->path, part->offset + index * block, block, u));
    for (size_t i = 0; i < resume->n_field * resume->n_cell; i++)
        if (!isfinite(u[i])) return resume_damaged(resume, "a value that is not finite");
    part = seal_find(&resume->seal, "/p");
    return part ? seal_bytes(resume->file, resume->path, part->offset + index * row, row, p) : STATUS_OK;
}

static int resume_numbers(const struct resume *resume, const char *name, unsigned n, double *ret)
{
    if (notes_get(&resume->notes, name, n, ret)) return STATUS_OK;
    return status_fail(STATUS_RUN, "%s: impossible checkpoint: no %s", resume->path, name);
}

/* Are the numbers whole ones that a count may have (a double holds them exactly)? */
static bool resume_counts_something(unsigned n, const double *values)
{
    bool good = true;
    for (unsigned i = 0; i < n; i++) good = good && values[i] >= 0.0 && values[i] <= 0x1p53;
    return good;
}

static int resume_steps(const struct resume *resume, struct state_source *source)
{
    double step, steps[MESH_LEVELS];
    TRY(resume_numbers(resume, "state.t", 1, &source->t));
    TRY(resume_numbers(resume, "state.dt", 1, &source->dt));
    TRY(resume_numbers(resume, "state.dt_shrink", 1, &source->dt_shrink));
    TRY(resume_numbers(resume, "state.step", 1, &step));
    TRY(resume_numbers(resume, "state.level_steps", MESH_LEVELS, steps));
    bool sound = isfinite(source->t) && source->dt >= 0.0 && isfinite(source->dt) && source->dt_shrink > 0.0 &&
                 source->dt_shrink <= 1.0 && resume_counts_something(1, &step) &&
                 resume_counts_something(MESH_LEVELS, steps);
    if (!sound) return resume_damaged(resume, "a time or a number of steps that no run can have");
    source->step = (long)step;
    for (int l = 0; l < MESH_LEVELS; l++) source->level_steps[l] = (long)steps[l];
    return STATUS_OK;
}

/* Counts of all ranks go on with rank 0. */
static int resume_counts(const struct resume *resume, struct state_counts *ret_counts)
{
    double all[6], each[2], carried;
    TRY(resume_numbers(resume, "counts.of_all_ranks", 6, all));
    TRY(resume_numbers(resume, "cells.carried", 1, &carried));
    TRY(resume_numbers(resume, "counts.of_each_rank", 2, each));
    if (!resume_counts_something(6, all) || !resume_counts_something(2, each) || !resume_counts_something(1, &carried))
        return resume_damaged(resume, "counts that are none");
    *ret_counts = (struct state_counts){.retries = (long long)each[0], .regrids = (long long)each[1]};
    if (comm_rank() != 0) return STATUS_OK;
    long long *sums[] = {&ret_counts->cells,   &ret_counts->fallback, &ret_counts->relaxed,
                         &ret_counts->clipped, &ret_counts->limited,  &ret_counts->spread};
    for (int i = 0; i < 6; i++) *sums[i] = (long long)all[i];
    ret_counts->carried = (long long)carried;
    return STATUS_OK;
}

/* What criteria have tagged goes on with rank 0, if they are as many as before. */
static void resume_tagged(const struct resume *resume, struct state *state)
{
    unsigned n = state->scene->n_refine;
    double *tagged = mem_new(n + 1, sizeof *tagged);
    if (comm_rank() == 0 && notes_get(&resume->notes, "refine.tagged", n, tagged))
        for (unsigned i = 0; i < n; i++) state->tagged[i] = (long long)tagged[i];
    mem_free(tagged);
}

/* Does the scene fit, and are the parts as long as they must be? */
static int resume_match(struct resume *resume, const struct scene *scene)
{
    struct model *model = model_new(scene);
    struct notes now = {0};
    int tile = mesh_tile_size(scene), code = STATUS_OK;
    const struct seal_part *part = seal_find(&resume->seal, "/u");
    resume->n_field = model->n_field;
    resume->n_cell = 1;
    for (int d = 0; d < scene->dim; d++) resume->n_cell *= (size_t)tile;
    facts_put(scene, model, tile, &now);
    code = facts_compare(&resume->notes, &now);
    if (code) status_wrap(code, "%s: cannot restart: ", resume->path);
    size_t block = resume->n_field * resume->n_cell * sizeof(double);
    if (!code && (!part || part->length != resume->n_all * block))
        code = resume_damaged(resume, "/u has not one block per tile");
    part = seal_find(&resume->seal, "/p");
    if (!code && !model->linear && (!part || part->length != resume->n_all * resume->n_cell * sizeof(double)))
        code = resume_damaged(resume, "/p has not one row per tile");
    text_done(&now.text);
    model_free(model);
    return code;
}

/* Do the tiles make a mesh of the scene? Asked of a mesh that has nothing but its lists: links and memory of
 * tiles that do not nest cannot be made. */
static int resume_nests(const struct resume *resume, const struct scene *scene, int n_level)
{
    int tile = mesh_tile_size(scene);
    struct mesh *mesh = mem_new(1, sizeof *mesh);
    struct tile *tiles = resume->tiles;
    mesh->dim = scene->dim;
    mesh->n_level = n_level;
    for (int l = 0; l < n_level; l++) {
        struct level *level = &mesh->levels[l];
        level->n_tile = resume->n_tile[l];
        level->tiles = tiles;
        tiles += level->n_tile;
        for (int d = 0; d < 3; d++) level->extent[d] = d < scene->dim ? scene->cells[d] / tile << l : 1;
    }
    for (int d = 0; d < 3; d++) {
        mesh->n[d] = d < scene->dim ? tile : 1;
        mesh->periodic[d] = d < scene->dim && scene->boundary[d][0].type == SCENE_PERIODIC;
    }
    int code = nest_check(mesh);
    if (code) status_wrap(code, "%s: impossible checkpoint: ", resume->path);
    mem_free(mesh);
    return code;
}

static int resume_build(struct resume *resume, const struct scene *scene, struct state **ret_state)
{
    struct state_source source = {.fill = resume_fill, .data = resume};
    struct state_counts counts;
    struct tile *tiles = resume->tiles;
    if (!mesh_tile_size(scene)) return STATUS_CASE;
    TRY(resume_match(resume, scene));
    /* finer levels than the case allows now are left out: the coarser ones hold their averages */
    source.n_level = resume->n_level <= scene->levels ? resume->n_level : scene->levels + 1;
    TRY(resume_nests(resume, scene, source.n_level));
    TRY(resume_steps(resume, &source));
    TRY(resume_counts(resume, &counts));
    for (int l = 0; l < source.n_level; l++) {
        source.n_tile[l] = resume->n_tile[l];
        source.tiles[l] = tiles;
        tiles += resume->n_tile[l];
    }
    TRY(state_resume(scene, &source, ret_state));
    (*ret_state)->counts = counts;
    resume_tagged(resume, *ret_state);
    return STATUS_OK;
}

int resume_state(struct resume *resume, const struct scene *scene, struct state **ret_state)
{
    return resume_build(resume, scene, ret_state) ? STATUS_CASE : STATUS_OK;
}

/* A line of notes, "?" if it is missing. */
static void resume_say(FILE *out, const struct resume *resume, const char *label, const char *name)
{
    char *text = notes_get_text(&resume->notes, name);
    fprintf(out, "%-11s%s\n", label, text ? text : "?");
    mem_free(text);
}

static void resume_say_levels(FILE *out, const struct resume *resume)
{
    double tile = 0.0, cells[SCENE_AXES];
    unsigned dim = 1;
    notes_get(&resume->notes, "mesh.tile", 1, &tile);
    while (dim < SCENE_AXES && !notes_get(&resume->notes, "domain.cells", dim, cells)) dim++;
    double per_tile = tile * (dim > 1 ? tile : 1.0) * (dim > 2 ? tile : 1.0);
    for (int l = 0; l < resume->n_level; l++)
        fprintf(out, "level %-5d%u tiles, %.0f cells\n", l, resume->n_tile[l], resume->n_tile[l] * per_tile);
}

static void resume_describe(FILE *out, const struct resume *resume)
{
    static const char *const lines[][2] = {
        {"case", "case.name"},      {"title", "case.title"},
        {"by", "written.by"},       {"at", "written.at"},
        {"ranks", "written.ranks"}, {"time", "state.t"},
        {"step", "state.step"},     {"geometry", "domain.geometry"},
        {"lower", "domain.lower"},  {"upper", "domain.upper"},
        {"cells", "domain.cells"},  {"tile", "mesh.tile"},
        {"materials", "materials"}, {"fields", "fields"},
    };
    fprintf(out, "checkpoint %s\n", resume->path);
    for (size_t i = 0; i < sizeof lines / sizeof *lines; i++) resume_say(out, resume, lines[i][0], lines[i][1]);
    resume_say_levels(out, resume);
    fprintf(out, "size       %.3f MB, all checksums hold\n", (double)resume->seal.bytes / 1e6);
}

int resume_info(FILE *out, const char *path)
{
    struct resume *resume = mem_new(1, sizeof *resume);
    resume->path = mem_text(path);
    resume->file = -1;
    int code = resume_verify(resume);
    if (!code) code = resume_read(resume);
    if (!code) resume_describe(out, resume);
    resume_close(resume);
    return code;
}
