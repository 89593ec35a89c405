/* scenes.c - see scenes.h. */
#include "app/scenes.h"

#include "app/human.h"
#include "app/norm.h"
#include "base/mem.h"
#include "base/status.h"

#include <string.h>

/* Options that are short for a setting. */
static const struct {
    const char *option, *path;
} scenes_short[] = {{"--until", "run.until"}, {"--max-steps", "run.max-steps"}};

static char *scenes_setting(const char *option, const char *value)
{
    for (size_t i = 0; i < sizeof scenes_short / sizeof *scenes_short; i++)
        if (!strcmp(option, scenes_short[i].option)) return mem_print("%s=%s", scenes_short[i].path, value);
    return !strcmp(option, "--set") ? mem_text(value) : NULL;
}

/* The coarsest level is there from the start, whatever is refined. */
static int scenes_limit(struct scene *scene, const char *size)
{
    char text[HUMAN_ROOM];
    double bytes = scenes_bytes(scene, scenes_cells(scene));
    if (!size) return STATUS_OK;
    if (human_read_bytes(size, &scene->memory_limit)) return status_wrap(STATUS_CASE, "--max-memory: ");
    if (bytes <= scene->memory_limit) return STATUS_OK;
    return status_fail(STATUS_CASE,
                       "--max-memory %s: the coarsest level alone takes %s; fewer domain.cells, or more "
                       "memory",
                       size, human_bytes(bytes, text));
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
    int code = scene_read(path, &options, ret_scene);
    for (int i = 0; i < n; i++) mem_free(sets[i]);
    mem_free(sets);
    if (code) return options.json ? code : cli_failed(code);
    code = scenes_limit(*ret_scene, cli_value(given, "--max-memory"));
    if (!code) code = norm_check(*ret_scene);
    if (!code) return STATUS_OK;
    scene_free(*ret_scene);
    *ret_scene = NULL;
    return cli_failed(code);
}

double scenes_cells(const struct scene *scene)
{
    return (double)scene->cells[0] * (double)scene->cells[1] * (double)scene->cells[2];
}

double scenes_bytes(const struct scene *scene, double cells)
{
    unsigned n_alpha = scene->n_material > 1 ? scene->n_material : 0;
    return cells * 3 * sizeof(double) * (n_alpha + scene->n_material + (unsigned)scene->dim + 1);
}
