/* watch.c - what a page about runs may say: who sees it, whether a run lives, which rows are shown, what is read of
 * files that grow. */
#include "base/mem.h"
#include "close.h"
#include "watch/watch_answer.h"
#include "watch/watch_curve.h"
#include "watch/watch_file.h"
#include "watch/watch_life.h"
#include "watch/watch_page.h"
#include "watch/watch_row.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

static char token[WATCH_GATE_TOKEN + 1];

static void gates(void **state)
{
    char other[WATCH_GATE_TOKEN + 1], path[2 * WATCH_GATE_TOKEN];
    (void)state;
    assert_int_equal(watch_gate_token(token), 0);
    assert_int_equal(watch_gate_token(other), 0);
    assert_int_equal(strspn(token, "0123456789abcdef"), WATCH_GATE_TOKEN);
    assert_string_not_equal(token, other);
    snprintf(path, sizeof path, "/%s/state", token);
    assert_string_equal(watch_gate_open(path, token), "state");
    assert_null(watch_gate_open(path, other));
    for (size_t i = 0; i <= WATCH_GATE_TOKEN + 1; i++) { /* every character counts */
        path[i] ^= 1;
        assert_null(watch_gate_open(path, token));
        path[i] ^= 1;
    }
    path[WATCH_GATE_TOKEN + 1] = '\0';
    assert_null(watch_gate_open(path, token));
    assert_null(watch_gate_open("/", token));
}

static void hosts(void **state)
{
    (void)state;
    assert_true(watch_gate_is_local("127.0.0.1:8123"));
    assert_true(watch_gate_is_local("localhost"));
    static const char *const foreign[] = {"evil.example:8123", "127.0.0.1.evil.example", "localhost.evil:1",
                                          "127.0.0.1:",        "127.0.0.1:80x",          ""};
    for (size_t i = 0; i < sizeof foreign / sizeof *foreign; i++) assert_false(watch_gate_is_local(foreign[i]));
    assert_false(watch_gate_is_local(NULL));
}

static enum watch_life life(struct watch_life_signs signs)
{
    return watch_life_of(&signs);
}

static void lives(void **state)
{
    (void)state;
    assert_int_equal(life((struct watch_life_signs){.locked = 0}), WATCH_LIFE_NONE);
    assert_int_equal(life((struct watch_life_signs){.locked = 1}), WATCH_LIFE_RUNNING);
    assert_int_equal(life((struct watch_life_signs){.known = true, .locked = 1, .here = true}), WATCH_LIFE_RUNNING);
    assert_int_equal(life((struct watch_life_signs){.known = true, .locked = 0, .here = true}), WATCH_LIFE_KILLED);
    /* another machine's lock cannot be seen from here */
    assert_int_equal(life((struct watch_life_signs){.known = true, .locked = 0}), WATCH_LIFE_RUNNING);
    assert_int_equal(life((struct watch_life_signs){.known = true, .locked = -1, .here = true}), WATCH_LIFE_RUNNING);
    assert_int_equal(life((struct watch_life_signs){.known = true, .locked = 0, .silent_s = 1e4}), WATCH_LIFE_QUIET);
    assert_int_equal(life((struct watch_life_signs){.known = true, .locked = 1, .here = true, .silent_s = 1e4}),
                     WATCH_LIFE_QUIET);
    static const enum watch_life ends[] = {WATCH_LIFE_FINISHED, WATCH_LIFE_MISSED, WATCH_LIFE_FAILED, WATCH_LIFE_FAILED,
                                           WATCH_LIFE_STOPPED};
    for (int code = 0; code < 5; code++)
        assert_int_equal(life((struct watch_life_signs){.known = true, .ended = true, .exit_code = code, .here = true}),
                         ends[code]);
}

/* A peak of one row among many is shown, and so are both ends; rows ascend. */
static void peaks(void **state)
{
    enum { N = 100000 };
    size_t rows[2 * WATCH_CURVE_STRETCHES + 2];
    double *values = mem_new(N, sizeof *values);
    bool seen[2] = {false, false};
    (void)state;
    values[77777] = 5.0;
    values[33333] = -5.0;
    values[10] = NAN;
    size_t n = watch_curve_choose(N, values, rows);
    assert_true(n <= 2 * WATCH_CURVE_STRETCHES + 2);
    assert_int_equal(rows[0], 0);
    assert_int_equal(rows[n - 1], N - 1);
    for (size_t i = 0; i < n; i++) {
        if (i) assert_true(rows[i] > rows[i - 1]);
        seen[0] = seen[0] || rows[i] == 77777;
        seen[1] = seen[1] || rows[i] == 33333;
    }
    assert_true(seen[0] && seen[1]);
    for (size_t few = 0; few < 802; few += 267) { /* few rows are all shown */
        assert_int_equal(watch_curve_choose(few, values, rows), few);
        for (size_t i = 0; i < few; i++) assert_int_equal(rows[i], i);
    }
    mem_free(values);
}

static void put(const char *name, const char *text)
{
    FILE *file = fopen(name, "w");
    assert_non_null(file);
    fputs(text, file);
    fclose(file);
}

static void expect_tail(const char *text, unsigned most, const char *wanted)
{
    put("tail", text);
    char *tail = watch_file_tail(".", "tail", most);
    assert_string_equal(tail, wanted);
    mem_free(tail);
}

/* Whole lines alone, also where a run is writing one. */
static void tails(void **state)
{
    (void)state;
    expect_tail("", 3, "");
    expect_tail("no end", 3, "");
    expect_tail("a\nb\nc\nd\n", 2, "c\nd");
    expect_tail("a\nb\nhalf", 1, "b");
    expect_tail("a\n", 9, "a");
    assert_int_equal(mkfifo("pipe", 0600), 0); /* nobody writes: reading it would never end */
    char *none = watch_file_tail(".", "pipe", 3);
    assert_string_equal(none, "");
    mem_free(none);
    char *long_file = mem_new(200001, 1);
    memset(long_file, 'x', 200000);
    memcpy(long_file + 199990, "\nlast one\n", 10);
    expect_tail(long_file, 5, "last one");
    mem_free(long_file);
}

static void rows(void **state)
{
    struct watch_row row;
    (void)state;
    put("history.csv", "step,t,V\n0,0,1\n1,2.5e-9,nan\n2,5e");
    watch_row_read(".", "history.csv", &row);
    assert_int_equal(row.n, 3);
    assert_true(watch_row_value(&row, "t") == 2.5e-9);
    assert_true(isnan(watch_row_value(&row, "V")));
    assert_true(isnan(watch_row_value(&row, "none")));
    watch_row_done(&row);
    put("history.csv", "step,t,V\n");
    watch_row_read(".", "history.csv", &row);
    assert_int_equal(row.n, 3);
    assert_true(isnan(watch_row_value(&row, "t")));
    watch_row_done(&row);
}

/* Bytes that are no text do not get out. */
static void words(void **state)
{
    (void)state;
    json_t *word = watch_file_word("a\xff\n\x1b[31m<b>", 40);
    assert_string_equal(json_string_value(word), "a???[31m<b>");
    json_decref(word);
}

static bool no_number(void *data, const char *name, unsigned long *ret_number)
{
    (void)data;
    (void)name;
    (void)ret_number;
    return false;
}

static void expect_answer(const char *method, const char *path, const char *host, unsigned status)
{
    static struct watch_answer_world world;
    struct watch_answer answer;
    memcpy(world.token, token, sizeof token);
    watch_answer_make(&world, &(struct watch_answer_request){method, path, host, no_number, NULL}, &answer);
    assert_int_equal(answer.status, status);
    mem_free(answer.bytes);
}

static void answers(void **state)
{
    char path[256];
    (void)state;
    assert_non_null(strstr(watch_page_text, WATCH_PAGE_NONCE));
    assert_null(strstr(watch_page_text, "https:"));      /* nothing from elsewhere: */
    const char *name = strstr(watch_page_text, "http:"); /* the name of SVG is no address */
    assert_true(!strncmp(name, "http://www.w3.org/2000/svg", 26) && !strstr(name + 1, "http:"));
    assert_null(strstr(watch_page_text, "innerHTML"));
    static const struct {
        const char *word, *method, *host;
        unsigned status;
    } asked[] = {{"", "GET", "localhost:1", 200},        {"state", "GET", "localhost:1", 200},
                 {"state", "GET", "evil.example", 403},  {"state", "GET", NULL, 403},
                 {"state", "POST", "localhost:1", 405},  {"state", "HEAD", "localhost:1", 405},
                 {"run", "GET", "localhost:1", 404},     {"curve", "GET", "localhost:1", 404},
                 {"picture", "GET", "localhost:1", 404}, {"../../etc/passwd", "GET", "localhost:1", 404},
                 {"state/", "GET", "localhost:1", 404}};
    for (size_t i = 0; i < sizeof asked / sizeof *asked; i++) {
        snprintf(path, sizeof path, "/%s/%s", token, asked[i].word);
        expect_answer(asked[i].method, path, asked[i].host, asked[i].status);
    }
    expect_answer("GET", "/state", "localhost:1", 404);
}

static char folder[] = "/tmp/bulla-watch-XXXXXX";

static int begin(void **state)
{
    (void)state;
    return mkdtemp(folder) && !chdir(folder) ? 0 : -1;
}

static int end(void **state)
{
    (void)state;
    return unlink("tail") || unlink("pipe") || unlink("history.csv") || rmdir(folder);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(gates), cmocka_unit_test(hosts), cmocka_unit_test(lives), cmocka_unit_test(peaks),
        cmocka_unit_test(tails), cmocka_unit_test(rows),  cmocka_unit_test(words), cmocka_unit_test(answers),
    };
    return cmocka_run_group_tests(tests, begin, end);
}
