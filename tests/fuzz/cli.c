/* cli.c - command lines, one argument a line: options in every spelling, numbers, durations, sizes. */
#include "cli/cli.h"
#include "cli/human.h"
#include "fuzz.h"

enum { CLI_WORDS = 64 };

static const struct cli_option cli_output = {"--output", "-o", "DIR", "A folder."},
                               cli_ranks = {"--ranks", "-n", "N", "A number."},
                               cli_quiet = {"--quiet", "-q", NULL, "A switch."},
                               cli_restart = {"--restart", NULL, "[FILE]", "A value, or none."},
                               cli_later = {"--later", NULL, "X", NULL};
static const struct cli_option *const cli_options[] = {&cli_output,  &cli_ranks, &cli_quiet,
                                                       &cli_restart, &cli_later, NULL};
static const struct cli_command cli_commands[] = {
    {"run", "CASE", "One word.", cli_options, 1, 1, NULL},
    {"check", "CASE...", "Any number.", cli_options, 1, -1, NULL},
    {"version", "", "None.", NULL, 0, 0, NULL},
};

static void cli_try(const struct cli_command *command, int argc, char **argv)
{
    struct cli_given given;
    if (cli_parse(command, argc, argv, &given)) return;
    long count = 0;
    double amount = 0;
    const char *value = cli_value(&given, "--output");
    cli_count(&given, "--ranks", 1, &count);
    if (value) human_read_duration(value, &amount);
    if (value) human_read_bytes(value, &amount);
    cli_done(&given);
}

FUZZ(data, size)
{
    char *text = fuzz_text(data, size), *argv[CLI_WORDS + 1] = {(char[]){"bulla"}, (char[]){"run"}};
    int argc = 2;
    for (char *at = text; at && argc < CLI_WORDS; argc++) {
        argv[argc] = at;
        at = strchr(at, '\n');
        if (at) *at++ = '\0';
    }
    for (size_t i = 0; i < sizeof cli_commands / sizeof *cli_commands; i++) cli_try(&cli_commands[i], argc, argv);
    free(text);
    return 0;
}
