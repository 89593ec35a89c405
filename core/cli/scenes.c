/* scenes.c - see scenes.h. */
#include "cli/scenes.h"

#include "base/comm.h"
#include "base/mem.h"
#include "base/status.h"
#include "case/scene_read.h"
#include "cli/human.h"
#include "io/start.h"
#include "judge/norm.h"
#include "plug/block.h"
#include "solve/rkl.h"
#include "solve/tableau.h"

#include <string.h>

/* Options that are short for a setting. */
static const struct {
    const char *option, *path;
} scenes_short[] = {{"--until", "run.until"}, {"--max-steps", "run.max-steps"}, {"--writers", "output.writers"}};

static char *scenes_setting(const char *option, const char *value)
{
    for (size_t i = 0; i < sizeof scenes_short / sizeof *scenes_short; i++)
        if (!strcmp(option, scenes_short[i].option)) return mem_print("%s=%s", scenes_short[i].path, value);
    return !strcmp(option, "--set") ? mem_text(value) : NULL;
}

/* Memory of all machines that take part, as far as processes may have it. */
static double scenes_machine(void)
{
    double here = comm_neighbours(), own = here * mem_allowed(), all = mem_machine();
    double least = (own < all ? own : all) / here * comm_size();
    comm_min(&least, 1);
    return least;
}

/* The coarsest level is there from the start, whatever is refined. Without a limit of its own a run may have what there
 * is: more would end it where nothing can be saved. `only_look`: the case may be meant for another machine. */
static int scenes_limit(struct scene *scene, const char *size, bool only_look)
{
    char text[HUMAN_ROOM], most[HUMAN_ROOM];
    double bytes = scenes_bytes(scene, scenes_cells(scene)), machine = scenes_machine();
    scene->mesh.memory_limit = machine / SCENES_BESIDE;
    if (size && human_read_bytes(size, &scene->mesh.memory_limit)) return status_wrap(STATUS_CASE, "--max-memory: ");
    if (bytes <= scene->mesh.memory_limit || (only_look && !size)) return STATUS_OK;
    if (size)
        return status_fail(STATUS_CASE,
                           "--max-memory %s: the coarsest level alone takes %s; fewer domain.cells, or more "
                           "memory",
                           size, human_bytes(bytes, text));
    return status_fail(STATUS_CASE,
                       "%s: the coarsest level alone, %.4g cells, takes %s, but there are only %s here; fewer "
                       "domain.cells, more machines, or --max-memory to try nevertheless",
                       scene->path, scenes_cells(scene), human_bytes(SCENES_BESIDE * bytes, text),
                       human_bytes(machine, most));
}

int scenes_read(const struct cli_given *given, const char *path, struct scene **ret_scene)
{
    char **sets = mem_new((size_t)given->n_option + 1, sizeof *sets);
    int n = 0;
    for (int i = 0; i < given->n_option; i++) {
        char *setting = scenes_setting(given->options[i]->name, given->values[i]);
        if (setting) sets[n++] = setting;
    }
    struct scene_options options = {.sets = (const char *const *)sets,
                                    .variant = cli_value(given, "--variant"),
                                    .directory = cli_value(given, "--output"),
                                    .json = cli_value(given, "--json") != NULL};
    if (options.json) options.messages = stdout;
    block_together();
    int code = scene_read(path, &options, ret_scene), all = block_apart(code);
    if (all && !code) scene_free(*ret_scene); /* another rank cannot read it: nobody does */
    if (all) *ret_scene = NULL;
    code = code ? code : all;
    for (int i = 0; i < n; i++) mem_free(sets[i]);
    mem_free(sets);
    if (code) return options.json ? code : cli_failed(code);
    code = scenes_limit(*ret_scene, cli_value(given, "--max-memory"), strcmp(given->command->name, "run") != 0);
    if (!code) code = norm_check(*ret_scene);
    if (!code) code = comm_agree(start_load(*ret_scene));
    if (!code) return STATUS_OK;
    scene_free(*ret_scene);
    *ret_scene = NULL;
    return cli_failed(code);
}

double scenes_cells(const struct scene *scene)
{
    return (double)scene->domain.cells[0] * (double)scene->domain.cells[1] * (double)scene->domain.cells[2];
}

double scenes_bytes(const struct scene *scene, double cells)
{
    unsigned n_alpha = scene->n_material > 1 ? scene->n_material : 0;
    unsigned arrays = 3 + tableau_keeps(tableau_of(scene));
    if (scene->scheme.diffusion == SCENE_DIFFUSION_RKL2) arrays += rkl_flows(scene) ? 4 : 3; /* at most (rkl.h) */
    return cells * arrays * sizeof(double) * (n_alpha + scene->n_material + (unsigned)scene->domain.dim + 1);
}
