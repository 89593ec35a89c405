/* cli.c - see cli.h. Accepts --name value, --name=value, -n value, -nvalue; `--` ends options. */
#include "cli/cli.h"

#include "base/comm.h"
#include "base/log.h"
#include "base/mem.h"
#include "base/status.h"
#include "base/text.h"

#include <errno.h>
#include <stdlib.h>
#include <string.h>

enum { CLI_NAMES = 64, CLI_WORDS = 28 }; /* options of a command; columns for the words of a list */

static int cli_unknown(const struct cli_command *command, const char *word)
{
    const char *names[CLI_NAMES] = {NULL};
    size_t n = 0;
    for (const struct cli_option *const *o = command->options; o && *o && n < CLI_NAMES - 1; o++)
        if ((*o)->doc) names[n++] = (*o)->name;
    char bare[64];
    snprintf(bare, sizeof bare, "%.*s", (int)strcspn(word, "="), word);
    const char *near = text_nearest(bare, names);
    if (near) return status_fail(STATUS_CASE, "%s has no option %s; did you mean %s?", command->name, bare, near);
    return status_fail(STATUS_CASE, "%s has no option %s; `bulla help %s` lists them", command->name, bare,
                       command->name);
}

/* The option that `word` spells, and the value attached to it (or NULL). */
static const struct cli_option *cli_match(const struct cli_command *command, const char *word, const char **ret_value)
{
    *ret_value = NULL;
    for (const struct cli_option *const *o = command->options; o && *o; o++) {
        size_t length = strlen((*o)->name);
        if (!strncmp(word, (*o)->name, length) && (word[length] == '\0' || word[length] == '=')) {
            if (word[length] == '=') *ret_value = word + length + 1;
            return *o;
        }
        if ((*o)->letter && !strncmp(word, (*o)->letter, 2) && (word[2] == '\0' || (*o)->value)) {
            if (word[2]) *ret_value = word + 2;
            return *o;
        }
    }
    return NULL;
}

/* Is the next word (NULL: none) the value that an option may have, and neither another option nor a case? */
static bool cli_takes(const char *next)
{
    const char *dot = next ? strrchr(next, '.') : NULL;
    return next && *next != '-' && !(dot && (!strcmp(dot, ".yaml") || !strcmp(dot, ".yml")));
}

/* Reads one option at argv[*at]; *at ends on its last argument. */
static int cli_option_at(struct cli_given *given, int *at)
{
    const char *value, *word = given->argv[*at];
    const struct cli_option *option = cli_match(given->command, word, &value);
    if (!option) return cli_unknown(given->command, word);
    if (!option->doc)
        return status_fail(STATUS_CASE, "%s %s is not part of version " BULLA_VERSION, given->command->name,
                           option->name);
    if (option->value && *option->value == '[') {
        if (!value && cli_takes(given->argv[*at + 1])) value = given->argv[++*at];
    } else if (option->value && !value) {
        const char *next = *at + 1 < given->argc ? given->argv[*at + 1] : NULL;
        if (!next || !strncmp(next, "--", 2))
            return status_fail(STATUS_CASE, "%s wants a value: %s %s", word, option->name, option->value);
        value = next;
        ++*at;
    }
    if (!option->value && value) return status_fail(STATUS_CASE, "%s takes no value", option->name);
    given->options[given->n_option] = option;
    given->values[given->n_option++] = value ? value : "";
    return 0;
}

static int cli_check_words(const struct cli_given *given)
{
    const struct cli_command *command = given->command;
    if (given->n_word < command->least)
        return status_fail(STATUS_CASE, "%s wants %s: bulla %s %s", command->name, command->words, command->name,
                           command->words);
    if (command->most >= 0 && given->n_word > command->most)
        return status_fail(STATUS_CASE, "%s does not know what to do with '%s'; usage: bulla %s %s", command->name,
                           given->words[command->most], command->name, command->words);
    return 0;
}

int cli_parse(const struct cli_command *command, int argc, char **argv, struct cli_given *ret_given)
{
    struct cli_given given = {.command = command, .argc = argc, .argv = argv};
    size_t room = (size_t)argc + 1;
    given.words = mem_new(room, sizeof *given.words);
    given.options = mem_new(room, sizeof *given.options);
    given.values = mem_new(room, sizeof *given.values);
    bool plain = false;
    int code = 0;
    for (int i = 2; i < argc && !code; i++) {
        if (!plain && !strcmp(argv[i], "--")) plain = true;
        else if (!plain && argv[i][0] == '-' && argv[i][1]) code = cli_option_at(&given, &i);
        else given.words[given.n_word++] = argv[i];
    }
    if (!code) code = cli_check_words(&given);
    if (code) cli_done(&given);
    else *ret_given = given;
    return code;
}

void cli_done(struct cli_given *given)
{
    mem_free(given->words);
    mem_free(given->options);
    mem_free(given->values);
    *given = (struct cli_given){0};
}

const char *cli_value(const struct cli_given *given, const char *name)
{
    for (int i = given->n_option; i-- > 0;)
        if (!strcmp(given->options[i]->name, name)) return given->values[i];
    return NULL;
}

int cli_count(const struct cli_given *given, const char *name, long least, long *ret)
{
    const char *text = cli_value(given, name);
    if (!text) return 0;
    char *end;
    errno = 0;
    long value = strtol(text, &end, 10);
    if (errno || end == text || *end || value < least)
        return status_fail(STATUS_CASE, "%s %s: a whole number of at least %ld is needed", name, text, least);
    *ret = value;
    return 0;
}

void cli_line(FILE *stream, const char *words, const char *doc)
{
    if (strlen(words) <= CLI_WORDS) fprintf(stream, "  %-*s %s\n", CLI_WORDS, words, doc);
    else fprintf(stream, "  %s\n  %-*s %s\n", words, CLI_WORDS, "", doc);
}

void cli_help(FILE *stream, const struct cli_command *command)
{
    fprintf(stream, "bulla %s %s%s\n\n%s\n", command->name, command->words, command->options ? " [options]" : "",
            command->doc);
    if (command->options) fputs("\n", stream);
    for (const struct cli_option *const *o = command->options; o && *o; o++) {
        if (!(*o)->doc) continue;
        char *words = mem_print("%s%s%s %s", (*o)->letter ? (*o)->letter : "", (*o)->letter ? ", " : "", (*o)->name,
                                (*o)->value ? (*o)->value : "");
        cli_line(stream, words, (*o)->doc);
        mem_free(words);
    }
}

int cli_failed(int code)
{
    if (code && *status_text()) log_error("%s", status_text());
    return code;
}

/* Is there a -h or --help before any `--`? */
static bool cli_asks_help(int argc, char **argv)
{
    for (int i = 2; i < argc && strcmp(argv[i], "--") != 0; i++)
        if (!strcmp(argv[i], "-h") || !strcmp(argv[i], "--help")) return true;
    return false;
}

int cli_run(const struct cli_command *command, int argc, char **argv)
{
    if (cli_asks_help(argc, argv)) {
        if (comm_rank() == 0) cli_help(stdout, command);
        return 0;
    }
    struct cli_given given;
    int code = cli_parse(command, argc, argv, &given);
    if (code) return cli_failed(code);
    code = command->run(&given);
    cli_done(&given);
    return code;
}
