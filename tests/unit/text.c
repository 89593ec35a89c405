/* text.c - texts that go into messages: one line that people and terminals can read. */
#include "base/text.h"

#include "base/file.h"
#include "base/status.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cmocka.h>

static void check(const char *text, size_t most, const char *wanted)
{
    char line[200];
    snprintf(line, sizeof line, "%s", text);
    text_line(line, most);
    assert_string_equal(line, wanted);
}

static void what_no_terminal_should_get_is_replaced(void **state)
{
    (void)state;
    check("as it is: 1 \xc2\xb5m, \xe2\x82\xac, \xf0\x9f\x98\x80", 100,
          "as it is: 1 \xc2\xb5m, \xe2\x82\xac, \xf0\x9f\x98\x80");
    check("\x1b[31mred\r\n\tx\x7f", 100, "?[31mred???x?");
    check("a\xc2\x9b"
          "b",
          100, "a??b");                /* a control character of two bytes */
    check("\xff\xc0\x80", 100, "???"); /* no first byte, overlong */
    check("\xe0\x80\x80\xed\xa0\x80\xf4\x90\x80\x80", 100, "??????????");
    check("cut \xe2\x82", 100, "cut ??");
    check("", 100, "");
}

static void long_texts_end_in_dots(void **state)
{
    (void)state;
    check("0123456789", 10, "0123456789");
    check("0123456789a", 10, "0123456...");
    check("012345\xe2\x82\xac 789", 10, "012345..."); /* between characters */
    assert_int_equal(status_fail(STATUS_CASE, "%s", "two\nlines"), STATUS_CASE);
    assert_string_equal(status_text(), "two?lines");
}

static void only_files_are_opened(void **state)
{
    (void)state;
    char folder[] = "/tmp/bulla-text-XXXXXX", path[64];
    const char *why = "";
    assert_non_null(mkdtemp(folder));
    snprintf(path, sizeof path, "%s/pipe", folder);
    assert_int_equal(mkfifo(path, 0600), 0);
    assert_null(file_open(path, &why));
    assert_string_equal(why, "it is a pipe or a device, not a file");
    assert_null(file_open("/dev/zero", &why));
    assert_null(file_open(folder, &why));
    assert_string_equal(why, "Is a directory");
    unlink(path);
    assert_null(file_open(path, &why));
    assert_string_equal(why, "No such file or directory");
    FILE *file = fopen(path, "w");
    assert_non_null(file);
    fputs("here", file);
    fclose(file);
    file = file_open(path, &why);
    assert_non_null(file);
    assert_int_equal(fgetc(file), 'h');
    fclose(file);
    unlink(path);
    rmdir(folder);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(what_no_terminal_should_get_is_replaced),
        cmocka_unit_test(long_texts_end_in_dots),
        cmocka_unit_test(only_files_are_opened),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
