/* again.c - the command that goes on with a run, and the option with a value that may be missing. */
#include "run/again.h"

#include "base/mem.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>
#include <string.h>

static const struct cli_option output = {"--output", "-o", "DIR", "folder"}, set = {"--set", NULL, "P=V", "setting"},
                               quiet = {"--quiet", NULL, NULL, "silent"}, old = {"--overwrite", NULL, NULL, "replace"},
                               restart = {"--restart", NULL, "[FILE]", "go on"};
static const struct cli_option *const options[] = {&output, &set, &quiet, &old, &restart, NULL};
static const struct cli_command command = {"run", "CASE.yaml", "Runs.", options, 1, 1, NULL};

static void parse(struct cli_given *given, char **words)
{
    static char *argv[16] = {"bulla", "run"};
    int argc = 2;
    while (*words) argv[argc++] = *words++;
    argv[argc] = NULL;
    assert_int_equal(cli_parse(&command, argc, argv, given), 0);
}

#define WORDS(...) ((char *[]){__VA_ARGS__, NULL})

static void the_file_of_restart_may_be_missing(void **state)
{
    (void)state;
    static const struct {
        char *words[5];
        const char *file;
    } lines[] = {
        {{"a.yaml", "--restart"}, ""},
        {{"--restart", "a.yaml"}, ""},
        {{"a.yaml", "--restart", "--quiet"}, ""},
        {{"a.yaml", "--restart", "b.chk"}, "b.chk"},
        {{"--restart", "b.chk", "a.yaml"}, "b.chk"},
        {{"--restart=b.yaml", "a.yaml"}, "b.yaml"},
        {{"a.yaml"}, NULL},
    };
    for (size_t i = 0; i < sizeof lines / sizeof *lines; i++) {
        struct cli_given given;
        parse(&given, (char **)lines[i].words);
        assert_string_equal(given.words[0], "a.yaml");
        const char *file = cli_value(&given, "--restart");
        assert_true(!file == !lines[i].file);
        if (file) assert_string_equal(file, lines[i].file);
        cli_done(&given);
    }
}

static void a_shell_reads_the_command(void **state)
{
    (void)state;
    struct cli_given given;
    parse(&given, WORDS("--overwrite", "my case.yaml", "--set=run.until=2 us", "-oout", "--quiet", "--set", "a=it's"));
    char *line = again_command(&given);
    assert_string_equal(line,
                        "bulla run 'my case.yaml' --set 'run.until=2 us' -o out --quiet --set 'a=it'\\''s' --restart");
    mem_free(line);
    cli_done(&given);
    parse(&given, WORDS("a.yaml", "--restart=old.chk"));
    line = again_command(&given);
    assert_string_equal(line, "bulla run a.yaml --restart");
    mem_free(line);
    cli_done(&given);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(the_file_of_restart_may_be_missing),
                                       cmocka_unit_test(a_shell_reads_the_command)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
