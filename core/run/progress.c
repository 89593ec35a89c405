/* progress.c - see progress.h. */
#include "run/progress.h"

#include "base/comm.h"
#include "cli/human.h"
#include "solve/cost.h"

#include <jansson.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <time.h>

/* Seconds between lines, by mode. */
static const double progress_every[] = {
    [PROGRESS_LINES] = 5, [PROGRESS_LIVE] = 0.1, [PROGRESS_JSON] = 1, [PROGRESS_SILENT] = INFINITY};

double progress_clock(void)
{
    struct timespec now;
    clock_gettime(CLOCK_MONOTONIC, &now);
    return (double)now.tv_sec + 1e-9 * (double)now.tv_nsec;
}

enum progress_mode progress_choose(bool json, bool quiet, bool terminal)
{
    if (json) return PROGRESS_JSON;
    if (quiet) return PROGRESS_SILENT;
    return terminal ? PROGRESS_LIVE : PROGRESS_LINES;
}

static void progress_print(json_t *object)
{
    json_dumpf(object, stdout, JSON_COMPACT | JSON_REAL_PRECISION(15));
    putchar('\n');
    fflush(stdout);
    json_decref(object);
}

void progress_begin(struct progress *progress, const char *name, const char *directory)
{
    if (comm_rank() != 0) progress->mode = PROGRESS_SILENT;
    const char *plain = getenv("NO_COLOR");
    progress->color = progress->mode == PROGRESS_LIVE && !(plain && *plain);
    progress->start = progress->shown = progress_clock();
    progress->cpu = cost_cpu();
    eta_begin(&progress->eta, progress->share);
    if (progress->mode == PROGRESS_JSON)
        progress_print(json_pack("{ss ss ss sf sI si}", "event", "start", "case", name, "directory", directory, "until",
                                 progress->until, "cells", (json_int_t)progress->cells, "ranks", comm_size()));
}

void progress_mesh(struct progress *progress, const struct mesh *mesh, const long level_steps[MESH_LEVELS])
{
    bool first = progress->n_level == 0;
    progress->cells = 0;
    progress->n_level = mesh->n_level;
    for (int l = 0; l < MESH_LEVELS; l++) {
        double cells = l < mesh->n_level ? (double)mesh->levels[l].n_tile * (double)mesh->n_cell : 0.0;
        if (!first) progress->work += cells * (double)(level_steps[l] - progress->level_steps[l]);
        progress->level_steps[l] = level_steps[l];
        progress->level_cells[l] = cells;
        progress->cells += cells;
    }
}

/* "16384", with levels "4096+8192+1.2 M", coarsest first. */
static void progress_cells(const struct progress *progress, char *ret_text, size_t size)
{
    char cells[HUMAN_ROOM];
    size_t used = 0;
    snprintf(ret_text, size, "%s", human_count(progress->cells, cells));
    for (int l = 0; progress->n_level > 1 && l < progress->n_level && used < size; l++)
        used += (size_t)snprintf(ret_text + used, size - used, "%s%s", l ? "+" : "",
                                 human_count(progress->level_cells[l], cells));
}

static double progress_share(const struct progress *progress, double t, long step)
{
    double share = progress->until > 0 ? t / progress->until : 0;
    if (progress->most_steps > 0) {
        double steps = (double)step / (double)progress->most_steps;
        if (steps > share) share = steps;
    }
    return share < 1 ? share : 1;
}

/* "3:20", or "3:20 (2:40 to 5:00)" where it is not certain. */
static void progress_left(struct eta_left eta, size_t size, char *ret_text)
{
    char likely[HUMAN_ROOM], least[HUMAN_ROOM], most[HUMAN_ROOM];
    human_duration(eta.likely, likely);
    bool sure = !isfinite(eta.likely) || eta.most < 1.25 * eta.least || eta.most - eta.least < 2;
    if (sure) snprintf(ret_text, size, "%s", likely);
    else
        snprintf(ret_text, size, "%s (%s to %s)", likely, human_duration(eta.least, least),
                 human_duration(eta.most, most));
}

static void progress_show(struct progress *progress, double t, double dt, long step, double rate, struct eta_left eta)
{
    char time[HUMAN_ROOM], end[HUMAN_ROOM], size[HUMAN_ROOM], speed[HUMAN_ROOM], left[4 * HUMAN_ROOM];
    char cells[MESH_LEVELS * HUMAN_ROOM];
    bool live = progress->mode == PROGRESS_LIVE;
    progress_cells(progress, cells, sizeof cells);
    progress_left(eta, sizeof left, left);
    fprintf(stderr, "%s%s%3.0f%%%s  t %s of %s  step %ld  dt %s  %s cells  %s updates/s  ETA %s%s",
            live ? "\r\033[K" : "", progress->color ? "\033[1;32m" : "", floor(100 * progress->share),
            progress->color ? "\033[0m" : "", human_si(t, "s", time), human_si(progress->until, "s", end), step,
            human_si(dt, "s", size), cells, human_count(rate, speed), left, live ? "" : "\n");
    fflush(stderr);
    progress->line_open = live;
}

static void progress_seconds(json_t *object, const char *key, double seconds)
{
    json_object_set_new(object, key, isfinite(seconds) ? json_real(seconds) : json_null());
}

void progress_step(struct progress *progress, double t, double dt, long step)
{
    double now = progress_clock(), passed = now - progress->shown;
    if (passed < progress_every[progress->mode]) return;
    double share = progress_share(progress, t, step);
    double rate = (progress->work - progress->worked) / passed;
    eta_note(&progress->eta, share, cost_cpu() - progress->cpu, now - progress->start);
    progress->shown = now;
    progress->share = share;
    progress->worked = progress->work;
    struct eta_left eta = eta_left(&progress->eta);
    if (progress->mode != PROGRESS_JSON) {
        progress_show(progress, t, dt, step, rate, eta);
        return;
    }
    json_t *object = json_pack("{ss sf sf sI sf sI sf}", "event", "progress", "percent", 100 * share, "t", t, "step",
                               (json_int_t)step, "dt", dt, "cells", (json_int_t)progress->cells, "updates_per_s", rate);
    json_t *levels = json_array();
    for (int l = 0; l < progress->n_level; l++)
        json_array_append_new(levels, json_integer((json_int_t)progress->level_cells[l]));
    json_object_set_new(object, "cells_by_level", levels);
    progress_seconds(object, "eta_s", eta.likely);
    progress_seconds(object, "eta_least_s", eta.least);
    progress_seconds(object, "eta_most_s", eta.most);
    progress_print(object);
}

void progress_clear(struct progress *progress)
{
    if (!progress->line_open) return;
    fputs("\r\033[K", stderr);
    fflush(stderr);
    progress->line_open = false;
}

void progress_end(struct progress *progress, double t, long step, int code, const char *reason)
{
    progress_clear(progress);
    if (progress->mode != PROGRESS_JSON) return;
    progress_print(json_pack("{ss si ss sf sI sf}", "event", "end", "exit", code, "reason", reason, "t", t, "step",
                             (json_int_t)step, "wall_s", progress_clock() - progress->start));
}
