/* inspect.c - see inspect.h. Everything goes to stdout, so that it can be piped. */
#include "run/inspect.h"

#include "base/comm.h"
#include "base/mem.h"
#include "base/status.h"
#include "base/text.h"
#include "case/guide.h"
#include "case/schema.h"
#include "cli/scenes.h"
#include "io/dump_show.h"
#include "io/info.h"
#include "io/join.h"
#include "plug/describe.h"
#include "plug/registry.h"
#include "run/retell.h"
#include "solve/plan.h"

#include <stdio.h>
#include <sys/stat.h>

/* Prints and frees. */
static void inspect_put(struct text *text)
{
    if (comm_rank() == 0 && text->at) fputs(text->at, stdout);
    text_done(text);
}

int inspect_show(const struct cli_given *given)
{
    struct scene *scene = NULL;
    int code = scenes_read(given, given->words[0], &scene);
    if (code) return code;
    if (comm_rank() == 0) fputs(scene->resolved, stdout);
    scene_free(scene);
    return 0;
}

int inspect_plan(const struct cli_given *given)
{
    struct scene *scene = NULL;
    int code = scenes_read(given, given->words[0], &scene);
    if (code) return code;
    struct text text = {0};
    struct model *model = model_new(scene);
    plan_text(model, &text);
    model_free(model);
    inspect_put(&text);
    scene_free(scene);
    return 0;
}

int inspect_modules(const struct cli_given *given)
{
    struct text text = {0};
    int code = registry_init();
    for (int i = 0; i < given->n_word && !code; i++) code = describe_one(given->words[i], &text);
    if (!code && given->n_word == 0) describe_all(&text);
    inspect_put(&text);
    return cli_failed(code);
}

/* A file, or the output directory of a run. */
static int inspect_tell(const char *path)
{
    struct stat is;
    bool directory = stat(path, &is) == 0 && S_ISDIR(is.st_mode);
    return directory ? retell_run(stdout, path) : info_print(stdout, path);
}

int inspect_info(const struct cli_given *given)
{
    int code = 0;
    bool replay = cli_value(given, "--replay") != NULL;
    for (int i = 0; i < given->n_word && !code && comm_rank() == 0; i++)
        code = replay ? dump_show_replay(stdout, given->words[i]) : inspect_tell(given->words[i]);
    if (code == STATUS_RUN) code = STATUS_CASE; /* a file that is none of ours, or a broken one: nothing ran */
    return cli_failed(code);
}

int inspect_join(const struct cli_given *given)
{
    int code = comm_size() == 1 ? 0 : status_fail(STATUS_CASE, "bulla join is work for one process, not for ranks");
    for (int i = 0; i < given->n_word && !code; i++) code = join_path(stdout, given->words[i]);
    return cli_failed(code);
}

int inspect_schema(const struct cli_given *given)
{
    int code = registry_init();
    if (code) return cli_failed(code);
    char *text = cli_value(given, "--markdown") ? guide_text() : schema_text();
    if (comm_rank() == 0) fputs(text, stdout);
    mem_free(text);
    return 0;
}
