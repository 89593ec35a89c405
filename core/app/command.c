/* command.c - the one table that drives dispatch, help and usage errors.
 *
 * What an option means is said here, what it does in the command's own file. */
#include "app/command.h"

#include "base/comm.h"
#include "base/log.h"
#include "base/mem.h"
#include "base/status.h"
#include "base/text.h"
#include "base/version.h"
#include "batch/sweep.h"
#include "batch/verify.h"
#include "cli/cli.h"
#include "run/check.h"
#include "run/inspect.h"
#include "run/run.h"
#include "suite/module_check.h"
#include "suite/module_new.h"
#include "suite/module_table.h"
#include "view/view.h"
#include "watch/watch.h"

#include <stdio.h>
#include <string.h>

static int command_help(const struct cli_given *given);
static int command_version(const struct cli_given *given);
static int command_module(const struct cli_given *given);

static const struct cli_option
    command_output = {"--output", "-o", "DIR", "Output directory, instead of the case's."},
    command_ranks = {"--ranks", "-n", "RANKS", "MPI ranks; the numbers do not depend on them."},
    command_set = {"--set", NULL, "PATH=VALUE", "Changes a setting, e.g. 'run.until=2 us'; may be repeated."},
    command_variant = {"--variant", NULL, "NAME", "Applies a variant that the case defines."},
    command_until = {"--until", NULL, "T", "Ends at this time, e.g. '2 us'."},
    command_steps = {"--max-steps", NULL, "N", "Ends after so many steps."},
    command_memory = {"--max-memory", NULL, "SIZE", "Most that all ranks' blocks of cells may take, e.g. '8 GiB'."},
    command_walltime = {"--walltime", NULL, "HH:MM:SS", "Saves and stops when this much time has passed."},
    command_writers = {"--writers", NULL, "N", "Ranks that write files (one per machine, if the case says nothing)."},
    command_quiet = {"--quiet", NULL, NULL, "Says nothing but warnings and errors."},
    command_json = {"--json", NULL, NULL, "Progress and errors on stdout, one JSON object per line."},
    command_overwrite = {"--overwrite", NULL, NULL, "Replaces the run that is in the output directory."},
    command_dry = {"--dry-run", NULL, NULL,
                   "Does everything up to the first step, says what it found, writes nothing."},
    command_restart = {"--restart", NULL, "[FILE]",
                       "Goes on from a checkpoint: FILE, or the newest in the output directory."};

static const struct cli_option *const command_run_options[] = {&command_output,    &command_ranks,   &command_set,
                                                               &command_variant,   &command_until,   &command_steps,
                                                               &command_walltime,  &command_quiet,   &command_json,
                                                               &command_overwrite, &command_restart, &command_memory,
                                                               &command_dry,       &command_writers, NULL};
static const struct cli_option command_jobs = {"--jobs", "-j", "JOBS", "Runs at a time (1)."};
static const struct cli_option command_value = {"--value", NULL, "[NAME=]EXPRESSION",
                                                "A column of the table, as in 'min(V)/first(V)'; may be repeated."};
static const struct cli_option command_again = {"--overwrite", NULL, NULL,
                                                "Replaces runs of another case that are in the way."};
static const struct cli_option command_list_only = {"--dry-run", NULL, NULL,
                                                    "Checks and lists the combinations; runs and writes nothing."};
static const struct cli_option *const command_sweep_options[] = {&command_output,    &command_jobs,
                                                                 &command_ranks,     &command_set,
                                                                 &command_variant,   &command_value,
                                                                 &command_quiet,     &command_again,
                                                                 &command_list_only, NULL};
static const struct cli_option *const command_case_options[] = {&command_set,   &command_variant, &command_until,
                                                                &command_steps, &command_output,  NULL};
static const struct cli_option *const command_check_options[] = {&command_set,    &command_variant,
                                                                 &command_until,  &command_steps,
                                                                 &command_output, &command_memory,
                                                                 &command_json,   NULL};

static const struct cli_option command_parameter = {"--set", NULL, "NAME=VALUE",
                                                    "Gives a parameter, e.g. 'gamma=1.4'; may be repeated."};
static const struct cli_option command_density = {"--density", NULL, "A..B",
                                                  "Of `table`: densities [kg/m3], not the law's own range."};
static const struct cli_option command_temperature = {"--temperature", NULL, "A..B", "Of `table`: temperatures [K]."};
static const struct cli_option command_states = {"--states", NULL, "NxM",
                                                 "Of `table`: densities x temperatures (100x100)."};
static const struct cli_option *const command_module_options[] = {&command_parameter, &command_density,
                                                                  &command_temperature, &command_states, NULL};

static const struct cli_option command_markdown = {"--markdown", NULL, NULL, "A page to read instead of a schema."};
static const struct cli_option *const command_schema_options[] = {&command_markdown, NULL};

static const struct cli_option command_replay = {"--replay", NULL, NULL,
                                                 "Of a dump: computes the failed step of its tile again and compares."};
static const struct cli_option *const command_info_options[] = {&command_replay, NULL};

static const struct cli_command command_table[] = {
    {"run", "CASE.yaml", "Runs a case.", command_run_options, 1, 1, run_command},
    {"check", "CASE.yaml...", "Finds every mistake of a case and tells what it needs.", command_check_options, 1, -1,
     check_command},
    {"plan", "CASE.yaml", "The stages that will run, in order.", command_case_options, 1, 1, inspect_plan},
    {"show", "CASE.yaml", "The resolved case: parameters, defaults and units applied.", command_case_options, 1, 1,
     inspect_show},
    {"sweep", "CASE.yaml", "Runs all combinations of the case's matrix; one result table.", command_sweep_options, 1, 1,
     sweep_command},
    {"modules", "[NAME...]", "The laws there are; of one: parameters, units, ranges, defaults.", NULL, 0, -1,
     inspect_modules},
    {"new", "module KIND NAME", "A module of your own: a folder with sources, a test and a case, ready to build.", NULL,
     3, 3, module_new_command},
    {"module", "check FILE.so... | table LAW FILE", "Tests a module by the contract of its kind; tabulates a law.",
     command_module_options, 2, -1, command_module},
    {"info", "DIR|FILE...", "What a run was; what is inside a snapshot, a checkpoint or the dump of a failed step.",
     command_info_options, 1, -1, inspect_info},
    {"join", "DIR|FILE...", "Makes one file of a snapshot or checkpoint and its parts, of several writers.", NULL, 1,
     -1, inspect_join},
    {VIEW_PLOT, NULL, 1, -1, NULL}, /* viewer.h */
    {VIEW_REPORT, NULL, 1, 1, NULL},
    {WATCH_COMMAND, NULL, 1, -1, NULL},
    {"verify", "[ID...]",
     "Errors, orders and cost of the verification scenes (r09: r09a, r09b, ...; none: all; hard: cases/hard).",
     verify_option_table, 0, -1, verify_command},
    {"schema", "", "The JSON Schema of case files, with all loaded modules.", command_schema_options, 0, 0,
     inspect_schema},
    {"version", "", "Version of the program.", NULL, 0, 0, command_version},
    {"help", "[COMMAND]", "This list, or the help of one command.", NULL, 0, 1, command_help},
};

enum { COMMANDS = sizeof command_table / sizeof *command_table };

/* Words of the launcher, not of the program. */
static const char *const command_launcher[] = {"setup", "test", NULL};

static const struct cli_command *command_find(const char *name)
{
    for (size_t i = 0; i < COMMANDS; i++)
        if (!strcmp(command_table[i].name, name)) return &command_table[i];
    return NULL;
}

static bool command_listed(const char *name, const char *const *names)
{
    for (; *names; names++)
        if (!strcmp(name, *names)) return true;
    return false;
}

static int command_unknown(const char *name)
{
    if (command_listed(name, command_launcher))
        return status_fail(STATUS_CASE, "%s belongs to the launcher: ./bulla %s in the source tree", name, name);
    const char *names[COMMANDS + 1] = {NULL};
    for (size_t i = 0; i < COMMANDS; i++) names[i] = command_table[i].name;
    const char *near = text_nearest(name, names);
    if (near) return status_fail(STATUS_CASE, "there is no command '%s'; did you mean '%s'?", name, near);
    return status_fail(STATUS_CASE, "there is no command '%s'; `bulla help` lists them", name);
}

static void command_list(FILE *stream)
{
    fputs("bulla COMMAND ...: simulates bubbles, shocks and soft materials from case files\n\n", stream);
    for (size_t i = 0; i < COMMANDS; i++) {
        char *words = mem_print("%s %s", command_table[i].name, command_table[i].words);
        cli_line(stream, words, command_table[i].doc);
        mem_free(words);
    }
    fputs("\nFrom the source tree also: ./bulla setup (packages and build), ./bulla test (all tests).\n"
          "`bulla COMMAND -h` has the options of a command.\n"
          "Exit codes: 0 done; 1 an expectation failed; 2 bad usage or case; 3 the run failed; 4 interrupted.\n",
          stream);
}

static int command_version(const struct cli_given *given)
{
    (void)given;
    if (comm_rank() == 0) printf("bulla " BULLA_VERSION " (commit %.12s)\n", version_commit());
    return 0;
}

static int command_module(const struct cli_given *given)
{
    return (strcmp(given->words[0], "table") ? module_check_command : module_table_command)(given);
}

static int command_help(const struct cli_given *given)
{
    if (comm_rank() != 0) return 0;
    if (given->n_word == 0) {
        command_list(stdout);
        return 0;
    }
    const struct cli_command *command = command_find(given->words[0]);
    if (!command) return cli_failed(command_unknown(given->words[0]));
    cli_help(stdout, command);
    return 0;
}

static const char *command_name(const char *word)
{
    if (!strcmp(word, "-h") || !strcmp(word, "--help")) return "help";
    if (!strcmp(word, "-V") || !strcmp(word, "--version")) return "version";
    return word;
}

int command_main(int argc, char **argv)
{
    if (argc < 2) {
        if (comm_rank() == 0) command_list(stderr);
        return STATUS_CASE;
    }
    const char *name = command_name(argv[1]);
    const struct cli_command *command = command_find(name);
    if (!command) return cli_failed(command_unknown(name));
    return cli_run(command, argc, argv);
}
