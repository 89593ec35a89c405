/* cli.h - what a command line may say: commands and options as tables, parsing and help from them.
 *
 * A command that takes the common options lists them; parsing, `-h`, usage errors and
 * suggestions follow from the table. Tables live in command.c.
 *
 * This folder, cli: what a command line says, and how the program speaks to people. */
#ifndef CLI_H
#define CLI_H

#include <stdbool.h>
#include <stddef.h>
#include <stdio.h>

struct cli_option {
    const char *name;   /* "--until" */
    const char *letter; /* "-o", or NULL */
    const char *value;  /* what follows it ("DIR"; "[FILE]": may follow it), or NULL for a switch */
    const char *doc;    /* NULL: not there yet; giving it is refused with a clear sentence */
};

struct cli_given;

struct cli_command {
    const char *name, *words, *doc;          /* "run", "CASE.yaml", one line */
    const struct cli_option *const *options; /* NULL-terminated; NULL: none */
    int least, most;                         /* how many words it takes; most < 0: any number */
    int (*run)(const struct cli_given *given);
};

/* A parsed command line; strings belong to argv. Free with cli_done. */
struct cli_given {
    const struct cli_command *command;
    int argc;
    char **argv; /* the whole command line */
    const char **words;
    int n_word;
    const struct cli_option **options; /* as given, in order */
    const char **values;
    int n_option;
};

/* Reads argv[2..] by the command's tables. Bad usage: STATUS_CASE with a message that suggests. */
int cli_parse(const struct cli_command *command, int argc, char **argv, struct cli_given *ret_given);
void cli_done(struct cli_given *given);

/* The value of an option (the last one given; "" for a switch or without its value), or NULL if it was not given. */
const char *cli_value(const struct cli_given *given, const char *name);

/* Number given by an option that wants a whole number of at least `least`; *ret is untouched
 * when the option was not given. */
int cli_count(const struct cli_given *given, const char *name, long least, long *ret);

/* One line of a list: words, and beside them, or below if they are long, what they mean. */
void cli_line(FILE *stream, const char *words, const char *doc);

/* Help of one command. */
void cli_help(FILE *stream, const struct cli_command *command);

/* Help where the command line asks for it; else parses it and does what the command does. Returns the exit code. */
int cli_run(const struct cli_command *command, int argc, char **argv);

/* Prints the recorded failure, if any, and hands the code on. */
int cli_failed(int code);

#endif
