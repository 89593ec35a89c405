/* scenes.c - see scenes.h. */
#include "app/scenes.h"

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
    return options.json ? code : cli_failed(code);
}

double scenes_cells(const struct scene *scene)
{
    return (double)scene->cells[0] * (double)scene->cells[1] * (double)scene->cells[2];
}
