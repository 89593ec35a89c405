/* cli.c - command lines: what is read, and what bad ones are told. */
#include "cli/cli.h"

#include "base/status.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>
#include <string.h>

static const struct cli_option until = {"--until", NULL, "T", "end"}, output = {"--output", "-o", "DIR", "folder"},
                               quiet = {"--quiet", NULL, NULL, "silent"};
static const struct cli_option *const options[] = {&until, &output, &quiet, NULL};
static const struct cli_command command = {"run", "CASE.yaml", "Runs.", options, 1, 1, NULL};

static int parse(struct cli_given *given, char **words)
{
    static char *argv[16] = {"bulla", "run"};
    int argc = 2;
    while (*words) argv[argc++] = *words++;
    argv[argc] = NULL;
    return cli_parse(&command, argc, argv, given);
}

#define WORDS(...) ((char *[]){__VA_ARGS__, NULL})

static void options_in_every_spelling(void **state)
{
    (void)state;
    char *const lines[][5] = {{"--until", "1 us", "-o", "out", "a.yaml"}, {"--until=1 us", "a.yaml", "-oout"}};
    for (size_t i = 0; i < 2; i++) {
        struct cli_given given;
        assert_int_equal(parse(&given, WORDS(lines[i][0], lines[i][1], lines[i][2], lines[i][3], lines[i][4])), 0);
        assert_string_equal(cli_value(&given, "--until"), "1 us");
        assert_string_equal(cli_value(&given, "--output"), "out");
        assert_null(cli_value(&given, "--quiet"));
        assert_int_equal(given.n_word, 1);
        assert_string_equal(given.words[0], "a.yaml");
        cli_done(&given);
    }
}

static void last_value_wins_and_switches_are_empty(void **state)
{
    (void)state;
    struct cli_given given;
    assert_int_equal(parse(&given, WORDS("--until=1", "--quiet", "x", "--until=2")), 0);
    assert_string_equal(cli_value(&given, "--until"), "2");
    assert_string_equal(cli_value(&given, "--quiet"), "");
    cli_done(&given);
}

static void dashes_end_options(void **state)
{
    (void)state;
    struct cli_given given;
    assert_int_equal(parse(&given, WORDS("--", "--quiet")), 0);
    assert_string_equal(given.words[0], "--quiet");
    cli_done(&given);
}

static void bad_usage_is_explained(void **state)
{
    (void)state;
    struct cli_given given;
    const struct {
        char *word, *more;
        const char *says;
    } bad[] = {
        {"--untl=3", NULL, "did you mean --until?"},
        {"--zzzzzzzzz", NULL, "bulla help run"},
        {"--until", NULL, "--until wants a value"},
        {"--quiet=3", "x", "--quiet takes no value"},
        {"a.yaml", "b.yaml", "b.yaml"},
        {"--quiet", NULL, "run wants CASE.yaml"},
    };
    for (size_t i = 0; i < sizeof bad / sizeof *bad; i++) {
        assert_int_equal(parse(&given, WORDS(bad[i].word, bad[i].more)), STATUS_CASE);
        assert_non_null(strstr(status_text(), bad[i].says));
    }
}

static void counts_have_a_range(void **state)
{
    (void)state;
    struct cli_given given;
    long value = 7;
    assert_int_equal(parse(&given, WORDS("--until=12", "x")), 0);
    assert_int_equal(cli_count(&given, "--until", 1, &value), 0);
    assert_int_equal(value, 12);
    assert_int_equal(cli_count(&given, "--until", 13, &value), STATUS_CASE);
    cli_done(&given);
    assert_int_equal(parse(&given, WORDS("--until=1.5", "x")), 0);
    assert_int_equal(cli_count(&given, "--until", 1, &value), STATUS_CASE);
    assert_int_equal(cli_count(&given, "--output", 1, &value), 0);
    assert_int_equal(value, 12);
    cli_done(&given);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(options_in_every_spelling), cmocka_unit_test(last_value_wins_and_switches_are_empty),
        cmocka_unit_test(dashes_end_options),        cmocka_unit_test(bad_usage_is_explained),
        cmocka_unit_test(counts_have_a_range),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
