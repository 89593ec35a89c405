/* rebuild.c - see rebuild.h. Every rank reads the tiles that it gets at their places in the file. */
#include "io/rebuild.h"

#include "base/comm.h"
#include "base/log.h"
#include "base/mem.h"
#include "base/status.h"
#include "io/facts.h"
#include "mesh/fringe.h"
#include "mesh/level.h"
#include "mesh/nest.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

struct rebuild {
    const struct resume *from;
    const struct scene *scene;
    int tile; /* side of a tile */
    size_t n_cell, n_field;
    bool iterated; /* the closure of the scene needs pressures */
    size_t n_kept; /* rows of what outputs keep, if the file has them */
};

/* The source's `fill`: a tile's block, at its place in the file. */
static int rebuild_fill(void *data, int level, unsigned tile, double *u, double *p, double *kept)
{
    const struct rebuild *rebuild = data;
    const struct resume *resume = rebuild->from;
    size_t index = tile, n = rebuild->n_field * rebuild->n_cell;
    uint64_t row = rebuild->n_cell * sizeof(double);
    for (int l = 0; l < level; l++) index += resume->n_tile[l];
    TRY(resume_row(resume, "/u", index, n * sizeof(double), u));
    for (size_t i = 0; i < n; i++)
        if (!isfinite(u[i])) return resume_damaged(resume, "a value that is not finite");
    if (kept && rebuild->n_kept) TRY(resume_row(resume, "/kept", index, rebuild->n_kept * row, kept));
    return rebuild->iterated ? resume_row(resume, "/p", index, row, p) : STATUS_OK;
}

/* Peaks go on if the file has the same ones; else they begin anew. */
static int rebuild_kept(struct rebuild *rebuild)
{
    const struct resume *resume = rebuild->from;
    size_t row = rebuild->n_cell * sizeof(double), n_kept = rebuild->scene->output.n_kept;
    if (!n_kept) return STATUS_OK;
    if (!facts_same_kept(rebuild->scene, &resume->notes)) {
        log_warn("%s has not the same peaks (max_..., min_..., when_...): they begin anew", resume->path);
        return STATUS_OK;
    }
    TRY(resume_has_rows(resume, "/kept", n_kept * row));
    rebuild->n_kept = n_kept;
    return STATUS_OK;
}

static int rebuild_numbers(const struct resume *resume, const char *name, unsigned n, double *ret)
{
    if (notes_get(&resume->notes, name, n, ret)) return STATUS_OK;
    return status_fail(STATUS_RUN, "%s: impossible checkpoint: no %s", resume->path, name);
}

/* Are the numbers whole ones that a count may have (a double holds them exactly)? */
static bool rebuild_is_count(unsigned n, const double *values)
{
    bool good = true;
    for (unsigned i = 0; i < n; i++) good = good && values[i] >= 0.0 && values[i] <= 0x1p53;
    return good;
}

static int rebuild_steps(const struct resume *resume, struct state_source *source)
{
    double step, steps[MESH_LEVELS];
    TRY(rebuild_numbers(resume, "state.t", 1, &source->t));
    TRY(rebuild_numbers(resume, "state.dt", 1, &source->dt));
    TRY(rebuild_numbers(resume, "state.dt_shrink", 1, &source->dt_shrink));
    TRY(rebuild_numbers(resume, "state.step", 1, &step));
    TRY(rebuild_numbers(resume, "state.level_steps", MESH_LEVELS, steps));
    source->dt_longest = source->dt; /* older checkpoints do not say it */
    notes_get(&resume->notes, "state.dt_longest", 1, &source->dt_longest);
    bool sound = isfinite(source->t) && source->dt_longest >= 0.0 && isfinite(source->dt_longest) &&
                 source->dt >= 0.0 && isfinite(source->dt) && source->dt_shrink > 0.0 && source->dt_shrink <= 1.0 &&
                 rebuild_is_count(1, &step) && rebuild_is_count(MESH_LEVELS, steps);
    if (!sound) return resume_damaged(resume, "a time or a number of steps that no run can have");
    source->step = (long)step;
    for (int l = 0; l < MESH_LEVELS; l++) source->level_steps[l] = (long)steps[l];
    return STATUS_OK;
}

/* What checkpoint_note_cells wrote; older checkpoints do not have it. */
static bool rebuild_cells(const struct resume *resume, const char *name, unsigned n, long long *sum, long long *most)
{
    double cells[2 * SCENE_MATERIALS] = {0};
    notes_get(&resume->notes, name, 2 * n, cells);
    if (!rebuild_is_count(2 * n, cells)) return false;
    for (unsigned i = 0; i < n; i++) {
        sum[i] = (long long)cells[2 * i];
        most[i] = (long long)cells[2 * i + 1];
    }
    return true;
}

/* Counts about laws, which older checkpoints do not have. Those of closures go on with rank 0. */
static int rebuild_laws(const struct rebuild *rebuild, struct state_counts *ret_counts)
{
    const struct resume *resume = rebuild->from;
    const struct scene *scene = rebuild->scene;
    double closures[4] = {0};
    notes_get(&resume->notes, "counts.closures", 4, closures);
    if (!rebuild_is_count(4, closures) ||
        !rebuild_cells(resume, "counts.outside", scene->n_material, ret_counts->outside, ret_counts->outside_most) ||
        !rebuild_cells(resume, "counts.past", scene->n_phase, ret_counts->past, ret_counts->past_most))
        return resume_damaged(resume, "counts that no run can have");
    if (comm_rank() != 0) return STATUS_OK;
    ret_counts->closures = (struct mix_effort){.solved = (long long)closures[0],
                                               .steps = (long long)closures[1],
                                               .failed = (long long)closures[2],
                                               .most = (long long)closures[3]};
    return STATUS_OK;
}

/* Counts of all ranks go on with rank 0. */
static int rebuild_counts(const struct resume *resume, struct state_counts *ret_counts)
{
    double all[6], each[2], carried;
    TRY(rebuild_numbers(resume, "counts.of_all_ranks", 6, all));
    TRY(rebuild_numbers(resume, "cells.carried", 1, &carried));
    TRY(rebuild_numbers(resume, "counts.of_each_rank", 2, each));
    if (!rebuild_is_count(6, all) || !rebuild_is_count(2, each) || !rebuild_is_count(1, &carried))
        return resume_damaged(resume, "counts that no run can have");
    *ret_counts = (struct state_counts){.retries = (long long)each[0], .regrids = (long long)each[1]};
    if (comm_rank() != 0) return STATUS_OK;
    long long *sums[] = {&ret_counts->cells,   &ret_counts->fallback, &ret_counts->relaxed,
                         &ret_counts->clipped, &ret_counts->limited,  &ret_counts->spread};
    for (int i = 0; i < 6; i++) *sums[i] = (long long)all[i];
    ret_counts->carried = (long long)carried;
    return STATUS_OK;
}

/* What criteria have tagged goes on with rank 0, if they are as many as before. */
static void rebuild_tagged(const struct resume *resume, struct state *state)
{
    unsigned n = state->scene->mesh.n_refine;
    double *tagged = mem_new(n + 1, sizeof *tagged);
    if (comm_rank() == 0 && notes_get(&resume->notes, "refine.tagged", n, tagged))
        for (unsigned i = 0; i < n; i++) state->tagged[i] = (long long)tagged[i];
    mem_free(tagged);
}

/* What has evaporated goes on with rank 0; a file of a run without such a column does not say it: then from here. */
static void rebuild_evaporated(const struct resume *resume, struct state *state)
{
    for (unsigned k = 0; comm_rank() == 0 && k < state->scene->n_phase; k++) {
        double digits[ACCOUNT_DIGITS];
        char name[32];
        snprintf(name, sizeof name, "evaporated.%u", k);
        if (!notes_get(&resume->notes, name, ACCOUNT_DIGITS, digits)) continue;
        for (int i = 0; i < ACCOUNT_DIGITS; i++)
            if (fabs(digits[i]) <= 0x1p53) state->evaporated[k].digit[i] = (long long)digits[i];
    }
}

/* Has the file as many blocks, and rows of pressures where they are needed, as tiles? */
static int rebuild_measure(const struct rebuild *rebuild)
{
    size_t row = rebuild->n_cell * sizeof(double);
    TRY(resume_has_rows(rebuild->from, "/u", rebuild->n_field * row));
    return rebuild->iterated ? resume_has_rows(rebuild->from, "/p", row) : STATUS_OK;
}

/* Does the scene fit? Notes what a tile is made of. */
static int rebuild_match(struct rebuild *rebuild)
{
    const struct scene *scene = rebuild->scene;
    struct model *model = model_new(scene);
    struct notes now = {0};
    rebuild->n_field = model->n_field;
    rebuild->iterated = !model->linear;
    rebuild->n_cell = 1;
    for (int d = 0; d < scene->domain.dim; d++) rebuild->n_cell *= (size_t)rebuild->tile;
    facts_put(scene, model, rebuild->tile, &now);
    int code = facts_compare(&rebuild->from->notes, &now);
    if (code) status_wrap(code, "%s: cannot restart: ", rebuild->from->path);
    text_done(&now.text);
    model_free(model);
    return code ? code : rebuild_measure(rebuild);
}

static int rebuild_affords(const struct rebuild *rebuild, double tiles)
{
    double limit = rebuild->scene->mesh.memory_limit;
    double bytes = 3.0 * tiles * (double)(rebuild->n_field * rebuild->n_cell * sizeof(double));
    if (limit <= 0.0 || bytes <= limit) return STATUS_OK;
    return status_fail(
        STATUS_CASE,
        "%s: cannot restart: its mesh takes %.4g GiB, and may take %.4g GiB (--max-memory, else what the machine has)",
        rebuild->from->path, bytes / 0x1p30, limit / 0x1p30);
}

/* A mesh that has nothing but its lists. */
static struct mesh *rebuild_lists(const struct rebuild *rebuild, int n_level)
{
    const struct scene *scene = rebuild->scene;
    const struct resume *resume = rebuild->from;
    const struct tile *tiles = resume->tiles;
    struct mesh *mesh = mem_new(1, sizeof *mesh);
    mesh->dim = scene->domain.dim;
    mesh->n_level = n_level;
    for (int d = 0; d < 3; d++) {
        mesh->n[d] = d < scene->domain.dim ? rebuild->tile : 1;
        mesh->periodic[d] = d < scene->domain.dim && scene_boundary_is(scene, 2 * d, SCENE_BOUNDARY_WRAPS);
    }
    for (int l = 0; l < n_level; l++) {
        struct level *level = &mesh->levels[l];
        level->n_tile = resume->n_tile[l];
        level->n_known = level->n_local = resume->n_own[l];
        level->n_rank = resume->size;
        level->first_keys = resume->first_keys[l];
        level->tiles = mem_new(level->n_local, sizeof *tiles);
        if (level->n_local) memcpy(level->tiles, tiles, level->n_local * sizeof *tiles);
        tiles += level->n_local;
        for (int d = 0; d < 3; d++)
            level->extent[d] = d < scene->domain.dim ? scene->domain.cells[d] / rebuild->tile << l : 1;
    }
    return mesh;
}

/* Do the tiles make a mesh of the scene? Asked before there is one: links and memory of tiles that do not nest cannot
 * be made. What lies around its own tiles each rank is told by others. */
static int rebuild_nests(const struct rebuild *rebuild, int n_level)
{
    struct mesh *mesh = rebuild_lists(rebuild, n_level);
    double n_tile = 0.0;
    if (rebuild->from->size > 1) fringe_learn(mesh, 0, n_level - 1);
    int code = nest_check(mesh);
    if (code) status_wrap(code, "%s: impossible checkpoint: ", rebuild->from->path);
    for (int l = 0; l < n_level; l++) {
        n_tile += mesh->levels[l].n_tile;
        mesh->levels[l].first_keys = NULL; /* is the checkpoint's */
        level_drop(&mesh->levels[l]);
    }
    mem_free(mesh);
    return code ? code : rebuild_affords(rebuild, n_tile);
}

static int rebuild_source(struct rebuild *rebuild, struct state **ret_state)
{
    const struct resume *resume = rebuild->from;
    struct state_source source = {.fill = rebuild_fill, .data = rebuild};
    struct state_counts counts;
    const struct tile *tiles = resume->tiles;
    if (!rebuild->tile) return STATUS_CASE;
    TRY(rebuild_match(rebuild));
    TRY(rebuild_kept(rebuild));
    /* finer levels than the case allows now are left out: the coarser ones hold their averages */
    source.n_level = resume->n_level <= rebuild->scene->mesh.levels ? resume->n_level : rebuild->scene->mesh.levels + 1;
    TRY(rebuild_nests(rebuild, source.n_level));
    TRY(rebuild_steps(resume, &source));
    TRY(rebuild_counts(resume, &counts));
    TRY(rebuild_laws(rebuild, &counts));
    for (int l = 0; l < source.n_level; l++) {
        source.n_tile[l] = resume->n_tile[l];
        source.first[l] = resume->first[l];
        source.n_own[l] = resume->n_own[l];
        source.first_keys[l] = resume->first_keys[l];
        source.tiles[l] = tiles;
        tiles += resume->n_own[l];
    }
    TRY(state_resume(rebuild->scene, &source, ret_state));
    (*ret_state)->counts = counts;
    rebuild_tagged(resume, *ret_state);
    rebuild_evaporated(resume, *ret_state);
    return STATUS_OK;
}

int rebuild_state(const struct resume *resume, const struct scene *scene, struct state **ret_state)
{
    struct rebuild rebuild = {.from = resume, .scene = scene, .tile = mesh_tile_size(scene)};
    return rebuild_source(&rebuild, ret_state) ? STATUS_CASE : STATUS_OK;
}
