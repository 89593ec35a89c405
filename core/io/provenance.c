/* provenance.c - see provenance.h. Figures are collected from all ranks by all; the text is made
 * by rank 0, the only one that knows the time, and sent to the others. */
#include "io/provenance.h"

#include "base/comm.h"
#include "base/mem.h"
#include "base/status.h"
#include "base/text.h"
#include "base/version.h"
#include "io/ledger.h"
#include "io/place.h"
#include "io/provenance_host.h"
#include "io/provenance_laws.h"
#include "plug/registry.h"
#include "scheme/source.h"
#include "solve/stage.h"

#include <jansson.h>
#include <math.h>
#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/resource.h>
#include <time.h>
#include <unistd.h>

enum { PROVENANCE_HOST = 64 };

struct provenance {
    int argc;
    char *const *argv;
    char *path, *text;
    double wall_0, cpu_0; /* at the start of the run [s] */
    long step_0;
    double before[4]; /* wall, CPU, CPU while running, CPU of regridding, of the runs that this one continues [s] */
    double split[COST_PARTS + 1]; /* CPU time by parts, then that of outputs, of the runs before [s] */
    double output;                /* CPU time of this rank spent on outputs [s] */
    int runs;                     /* with this one */
    char started[32];
    unsigned peak[MESH_LEVELS]; /* most tiles of each level */
    struct ledger initial;
    char (*hosts)[PROVENANCE_HOST]; /* [ranks] */
};

const char *provenance_text(const struct provenance *provenance)
{
    return provenance->text;
}

static double provenance_wall(void)
{
    struct timespec now;
    clock_gettime(CLOCK_MONOTONIC, &now);
    return (double)now.tv_sec + 1e-9 * (double)now.tv_nsec;
}

/* User and system time of this process since it began [s]. */
static double provenance_cpu(void)
{
    struct rusage used;
    getrusage(RUSAGE_SELF, &used);
    return (double)(used.ru_utime.tv_sec + used.ru_stime.tv_sec) +
           1e-6 * (double)(used.ru_utime.tv_usec + used.ru_stime.tv_usec);
}

static void provenance_now(char *ret_text, size_t size)
{
    time_t now = time(NULL);
    struct tm parts;
    strftime(ret_text, size, "%Y-%m-%dT%H:%M:%SZ", gmtime_r(&now, &parts));
}

static double provenance_sum(double value)
{
    double *all = mem_new((size_t)comm_size(), sizeof *all), sum = 0.0;
    comm_join(&value, 1, all);
    for (int rank = 0; rank < comm_size(); rank++) sum += all[rank];
    mem_free(all);
    return sum;
}

/* Names of the machines of all ranks; they travel as the bytes of doubles. */
static void provenance_find_hosts(struct provenance *provenance)
{
    double name[PROVENANCE_HOST / sizeof(double)] = {0};
    gethostname((char *)name, sizeof name - 1);
    provenance->hosts = mem_new((size_t)comm_size(), sizeof *provenance->hosts);
    comm_join(name, (int)(sizeof name / sizeof *name), (double *)provenance->hosts);
}

static json_t *provenance_hosts(const struct provenance *provenance)
{
    json_t *hosts = json_object(); /* name: ranks on it */
    for (int rank = 0; rank < comm_size(); rank++) {
        const char *name = provenance->hosts[rank];
        json_int_t ranks = json_integer_value(json_object_get(hosts, name));
        json_object_set_new(hosts, name, json_integer(ranks + 1));
    }
    return hosts;
}

/* A text as JSON. Names of files need not be UTF-8: what is not becomes %FF. */
static json_t *provenance_word(const char *word)
{
    json_t *json = word ? json_string(word) : json_null();
    if (json) return json;
    struct text plain = {0};
    for (const char *at = word; *at; at++) {
        bool odd = *at < ' ' || *at > '~';
        text_add(&plain, odd ? "%%%02X" : "%c", (unsigned char)*at);
    }
    json = json_string(plain.at);
    text_done(&plain);
    return json;
}

static json_t *provenance_command(const struct provenance *provenance)
{
    json_t *command = json_array();
    for (int i = 0; i < provenance->argc; i++) json_array_append_new(command, provenance_word(provenance->argv[i]));
    return command;
}

static void provenance_add_module(json_t *modules, const struct bulla_module *module)
{
    if (!module) return;
    json_t *known;
    size_t i;
    json_array_foreach(modules, i, known)
    {
        if (!strcmp(json_string_value(json_object_get(known, "name")), module->name) &&
            !strcmp(json_string_value(json_object_get(known, "kind")), module->kind))
            return;
    }
    const struct registry_entry *entry = registry_find(module->kind, module->name);
    char hash[32] = "";
    if (entry) snprintf(hash, sizeof hash, "%016llx", (unsigned long long)entry->hash);
    json_array_append_new(modules, json_pack("{s:s, s:s, s:o, s:o, s:s}", "kind", module->kind, "name", module->name,
                                             "version", provenance_word(module->version ? module->version : ""), "path",
                                             provenance_word(entry ? entry->path : ""), "xxh64", hash));
}

static json_t *provenance_modules(const struct scene *scene)
{
    json_t *modules = json_array();
    const struct instance *instance;
    for (unsigned i = 0; (instance = scene_instance((struct scene *)scene, i)); i++)
        provenance_add_module(modules, instance->module);
    const struct registry_entry *robust = registry_find("riemann", "rusanov"); /* for troubled cells */
    if (robust) provenance_add_module(modules, robust->module);
    return modules;
}

/* A number, or null where JSON has none. */
static json_t *provenance_number(double value)
{
    return isfinite(value) ? json_real(value) : json_null();
}

/* Totals at the start and now; what went through boundaries is part of the difference. */
static json_t *provenance_conservation(const struct provenance *provenance, const struct state *state,
                                       const struct ledger *now)
{
    json_t *conservation = json_object();
    for (unsigned i = 0; i < now->n; i++) {
        char name[2 * SCENE_NAME];
        ledger_name(state->model, i, name, sizeof name);
        double initial = provenance->initial.total[i], final = now->total[i];
        json_t *entry = json_object();
        json_object_set_new(entry, "initial", provenance_number(initial));
        json_object_set_new(entry, "final", provenance_number(final));
        json_object_set_new(entry, "change", provenance_number(final - initial));
        if (strncmp(name, "momentum", strlen("momentum"))) /* a momentum has no scale of its own: it may be zero */
            json_object_set_new(entry, "relative_change", provenance_number((final - initial) / fabs(initial)));
        json_object_set_new(conservation, name, entry);
    }
    return conservation;
}

/* Who ran what, where. */
static json_t *provenance_origin(const struct provenance *provenance, const struct scene *scene)
{
    return json_pack("{s:s, s:s, s:s, s:o, s:o, s:o, s:o, s:o, s:o, s:o, s:o, s:o, s:i}", "version", BULLA_VERSION,
                     "commit", version_commit(), "compiler", __VERSION__, "compiled", provenance_host_flags(), "cpu",
                     provenance_host_cpu(), "case", provenance_word(scene->path), "name", provenance_word(scene->name),
                     "title", provenance_word(scene->title), "command", provenance_command(provenance), "environment",
                     provenance_host_environment(), "modules", provenance_modules(scene), "hosts",
                     provenance_hosts(provenance), "ranks", comm_size());
}

/* What it cost and how much there is, of all ranks. */
struct provenance_cost {
    double wall, cpu, cpu_run, memory, regrid; /* s, s, s since the run began, bytes, s; sums over ranks but wall */
    double split[COST_PARTS + 1];
    struct state_counts counts;
    struct ledger now;
    struct balance_level share[MESH_LEVELS];
    double leaves[MESH_LEVELS];
};

/* Leaves of each level. Collective. */
static void provenance_leaves(const struct mesh *mesh, double ret_leaves[MESH_LEVELS])
{
    long long open[MESH_LEVELS] = {0}, octants = 1ll << mesh->dim;
    for (int l = 0; l < mesh->n_level; l++) {
        const struct level *level = &mesh->levels[l];
        for (unsigned i = level->first; i < level->first + level->n_local; i++)
            open[l] += octants - __builtin_popcount(level->tiles[i].covered);
    }
    comm_sum_counts(open, MESH_LEVELS);
    for (int l = 0; l < MESH_LEVELS; l++) ret_leaves[l] = (double)open[l] * (double)mesh->n_cell / (double)octants;
}

/* What there is of each level now, and was at most. */
static json_t *provenance_levels(const struct provenance *provenance, const struct state *state,
                                 const struct provenance_cost *cost)
{
    const struct balance_level *share = cost->share;
    const struct mesh *mesh = state->mesh;
    json_t *levels = json_array();
    for (int l = 0; l < MESH_LEVELS && provenance->peak[l]; l++) {
        const struct level *level = &mesh->levels[l];
        unsigned tiles = l < mesh->n_level ? level->n_tile : 0;
        double leaves = cost->leaves[l], n_cell = (double)mesh->n_cell;
        json_array_append_new(levels,
                              json_pack("{s:i, s:f, s:I, s:I, s:I, s:I, s:I, s:I, s:{s:o, s:o}}", "level", l, "width",
                                        level->h[0], "tiles", (json_int_t)tiles, "cells", (json_int_t)(tiles * n_cell),
                                        "leaves", (json_int_t)leaves, "peak_tiles", (json_int_t)provenance->peak[l],
                                        "peak_cells", (json_int_t)(provenance->peak[l] * n_cell), "steps",
                                        (json_int_t)state->level_steps[l], "balance", "predicted",
                                        provenance_number(share[l].predicted), "seen",
                                        provenance_number(share[l].seen)));
    }
    return levels;
}

static json_t *provenance_refinement(const struct provenance_cost *cost)
{
    const struct state_counts *counts = &cost->counts;
    return json_pack("{s:I, s:f, s:o, s:I, s:I}", "regrids", (json_int_t)counts->regrids, "regrid_cpu_s", cost->regrid,
                     "regrid_share", provenance_number(cost->regrid / cost->cpu_run), "limited_cells",
                     (json_int_t)counts->limited, "spread_refluxes", (json_int_t)counts->spread);
}

static json_t *provenance_work(const struct provenance *provenance, const struct state *state,
                               const struct provenance_cost *cost)
{
    const struct mesh *mesh = state->mesh;
    json_t *work = json_object();
    double cells = 0.0, leaves = 0.0;
    for (int l = 0; l < mesh->n_level; l++) {
        cells += (double)mesh->levels[l].n_tile * (double)mesh->n_cell;
        leaves += cost->leaves[l];
    }
    json_object_set_new(work, "cells", json_integer((json_int_t)cells)); /* of all levels, covered ones too */
    json_object_set_new(work, "leaves", json_integer((json_int_t)leaves));
    json_object_set_new(work, "steps", json_integer(state->step));
    json_object_set_new(work, "steps_of_this_run", json_integer(state->step - provenance->step_0));
    json_object_set_new(work, "time", json_real(state->t));
    json_object_set_new(work, "wall_s", json_real(cost->wall));
    json_object_set_new(work, "cpu_s", json_real(cost->cpu));
    json_object_set_new(work, "cells_updated", json_integer(cost->counts.cells));
    json_object_set_new(work, "cells_carried", json_integer(cost->counts.carried)); /* of these, at rest: only copied */
    json_object_set_new(work, "cpu_ns_per_cell_stage",
                        provenance_number(1e9 * cost->cpu_run / (double)cost->counts.cells));
    json_object_set_new(work, "peak_memory_bytes", json_integer((json_int_t)cost->memory));
    json_object_set_new(work, "bytes_per_cell", json_real(cost->memory / cells));
    return work;
}

static json_t *provenance_guard(const struct state_counts *counts)
{
    return json_pack("{s:I, s:I, s:I, s:I}", "fallback", (json_int_t)counts->fallback, "relaxed",
                     (json_int_t)counts->relaxed, "clipped", (json_int_t)counts->clipped, "retries",
                     (json_int_t)counts->retries);
}

/* CPU time by parts. What is left of the whole is `other`: choosing time steps, progress, what starts and ends a
 * run. */
static json_t *provenance_split(const struct provenance_cost *cost)
{
    static const char *const names[COST_PARTS + 1] = {"exchange",   "gather", "faces", "update",
                                                      "primitives", "levels", "output"};
    double other = cost->cpu_run - cost->regrid;
    json_t *split = json_object();
    for (int part = 0; part <= COST_PARTS; part++) {
        json_object_set_new(split, names[part], json_real(cost->split[part]));
        other -= cost->split[part];
    }
    json_object_set_new(split, "regrid", json_real(cost->regrid));
    json_object_set_new(split, "other", json_real(other > 0.0 ? other : 0.0));
    return split;
}

/* Sources that act, whose mass, momentum and energy are part of the change of the totals. */
static void provenance_sources(json_t *root, const struct scene *scene)
{
    struct text text = {0};
    source_text(scene, &text);
    if (text.at) json_object_set_new(root, "sources", json_string(text.at));
    text_done(&text);
}

static char *provenance_compose(const struct provenance *provenance, const struct state *state,
                                const struct provenance_cost *cost, const char *reason, int exit_code)
{
    char time_text[32];
    provenance_now(time_text, sizeof time_text);
    json_t *root = provenance_origin(provenance, state->scene), *work = provenance_work(provenance, state, cost);
    json_object_set_new(root, "started", json_string(provenance->started));
    json_object_set_new(root, "runs", json_integer(provenance->runs));
    json_object_set_new(root, strcmp(reason, "running") ? "ended" : "written", json_string(time_text));
    json_object_update(root, work);
    json_decref(work);
    json_object_set_new(root, "conservation", provenance_conservation(provenance, state, &cost->now));
    provenance_sources(root, state->scene);
    json_object_set_new(root, "guard", provenance_guard(&cost->counts));
    json_object_set_new(root, "closures", provenance_laws_closures(&cost->counts));
    json_object_set_new(root, "outside", provenance_laws_outside(state->model, &cost->counts));
    if (state->scene->n_phase)
        json_object_set_new(root, "past_curve", provenance_laws_past(state->scene, &cost->counts));
    json_object_set_new(root, "levels", provenance_levels(provenance, state, cost));
    json_object_set_new(root, "cpu_split_s", provenance_split(cost));
    json_object_set_new(root, "refinement", provenance_refinement(cost));
    json_object_set_new(root, "exit_reason", json_string(reason));
    json_object_set_new(root, "exit_code", strcmp(reason, "running") ? json_integer(exit_code) : json_null());
    char *json = json_dumps(root, JSON_INDENT(2)), *text = mem_print("%s\n", json ? json : "{}");
    free(json);
    json_decref(root);
    return text;
}

/* Sends the text of rank 0 to all. */
static char *provenance_share(char *text)
{
    size_t length = text ? strlen(text) : 0;
    comm_bcast(&length, sizeof length);
    if (!text) text = mem_new(length + 1, 1);
    comm_bcast(text, length);
    return text;
}

void provenance_watch(struct provenance *provenance, const struct state *state)
{
    for (int l = 0; l < state->mesh->n_level; l++) {
        unsigned tiles = state->mesh->levels[l].n_tile;
        if (tiles > provenance->peak[l]) provenance->peak[l] = tiles;
    }
}

/* Wall, CPU, CPU while running, CPU of regridding, of all ranks and all runs so far. Collective. */
static void provenance_spent(const struct provenance *provenance, const struct state *state, double ret_spent[4])
{
    double cpu = provenance_cpu();
    ret_spent[0] = provenance->before[0] + provenance_wall() - provenance->wall_0;
    ret_spent[1] = provenance->before[1] + provenance_sum(cpu);
    ret_spent[2] = provenance->before[2] + provenance_sum(cpu - provenance->cpu_0);
    ret_spent[3] = provenance->before[3] + provenance_sum(state->counts.regrid_seconds);
}

/* CPU time by parts and that of outputs, of all ranks and all runs so far. Collective. */
static void provenance_parts(const struct provenance *provenance, const struct state *state,
                             double ret_split[COST_PARTS + 1])
{
    cost_total(&state->work->cost, ret_split);
    ret_split[COST_PARTS] = provenance->output;
    for (int part = 0; part <= COST_PARTS; part++)
        ret_split[part] = provenance->split[part] + provenance_sum(ret_split[part]);
}

void provenance_output(struct provenance *provenance, double seconds)
{
    provenance->output += seconds;
}

int provenance_write(struct provenance *provenance, const struct state *state, const char *reason, int exit_code)
{
    double spent[4];
    provenance_spent(provenance, state, spent);
    struct provenance_cost cost = {.wall = spent[0],
                                   .cpu = spent[1],
                                   .cpu_run = spent[2],
                                   .memory = provenance_sum(mem_peak()),
                                   .regrid = spent[3],
                                   .counts = state_counts_total(state)};
    provenance_parts(provenance, state, cost.split);
    ledger_take(state, &cost.now);
    balance_take(&state->work->balance, cost.share);
    provenance_leaves(state->mesh, cost.leaves);
    char *text = comm_rank() == 0 ? provenance_compose(provenance, state, &cost, reason, exit_code) : NULL;
    mem_free(provenance->text);
    provenance->text = provenance_share(text);
    return place_text(provenance->path, provenance->text);
}

int provenance_new(const struct state *state, int argc, char *const *argv, struct provenance **ret_provenance)
{
    TRY(place_folder(state->scene->output.directory));
    struct provenance *provenance = mem_new(1, sizeof *provenance);
    *provenance = (struct provenance){.argc = argc, .argv = argv, .step_0 = state->step, .runs = 1};
    provenance->path = mem_print("%s/provenance.json", state->scene->output.directory);
    provenance->wall_0 = provenance_wall();
    provenance->cpu_0 = provenance_cpu();
    provenance_now(provenance->started, sizeof provenance->started);
    provenance_find_hosts(provenance);
    ledger_take(state, &provenance->initial);
    provenance_watch(provenance, state);
    int code = provenance_write(provenance, state, "running", 0);
    if (code) provenance_free(provenance);
    else *ret_provenance = provenance;
    return code;
}

void provenance_keep(const struct provenance *provenance, const struct state *state, struct notes *notes)
{
    double spent[4], split[COST_PARTS + 1], peak[MESH_LEVELS];
    provenance_spent(provenance, state, spent);
    provenance_parts(provenance, state, split);
    for (int l = 0; l < MESH_LEVELS; l++) peak[l] = provenance->peak[l];
    notes_put_text(notes, "provenance.started", provenance->started);
    notes_put_one(notes, "provenance.runs", provenance->runs);
    notes_put(notes, "provenance.spent", 4, spent);
    notes_put(notes, "provenance.split", COST_PARTS + 1, split);
    notes_put(notes, "provenance.peak_tiles", MESH_LEVELS, peak);
    notes_put(notes, "provenance.initial", provenance->initial.n, provenance->initial.total);
}

int provenance_recall(struct provenance *provenance, const struct state *state, const struct notes *notes)
{
    double runs = 0.0, peak[MESH_LEVELS] = {0};
    char *started = notes_get_text(notes, "provenance.started");
    if (started) snprintf(provenance->started, sizeof provenance->started, "%s", started);
    mem_free(started);
    if (notes_get(notes, "provenance.runs", 1, &runs)) provenance->runs += (int)runs;
    notes_get(notes, "provenance.spent", 4, provenance->before);
    notes_get(notes, "provenance.split", COST_PARTS + 1, provenance->split);
    notes_get(notes, "provenance.peak_tiles", MESH_LEVELS, peak);
    for (int l = 0; l < MESH_LEVELS; l++)
        if (peak[l] > provenance->peak[l]) provenance->peak[l] = (unsigned)peak[l];
    notes_get(notes, "provenance.initial", provenance->initial.n, provenance->initial.total);
    return provenance_write(provenance, state, "running", 0);
}

void provenance_free(struct provenance *provenance)
{
    if (!provenance) return;
    mem_free(provenance->hosts);
    mem_free(provenance->text);
    mem_free(provenance->path);
    mem_free(provenance);
}
