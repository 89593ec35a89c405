/* csv.c - tables that are taken up again: at the byte where a checkpoint found them, from the directory of the
 * older run if need be, and never by throwing rows away silently. */
#include "io/csv.h"

#include "base/mem.h"
#include "base/status.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

static char folder[64], path[128], other[128];

static int make(void **state)
{
    (void)state;
    snprintf(folder, sizeof folder, "/tmp/bulla-csv-XXXXXX");
    if (!mkdtemp(folder)) return 1;
    snprintf(path, sizeof path, "%s/a.csv", folder);
    snprintf(other, sizeof other, "%s/b.csv", folder);
    return 0;
}

static int drop(void **state)
{
    (void)state;
    char *command = mem_print("rm -rf '%s'", folder);
    int code = system(command);
    mem_free(command);
    return code;
}

static char *text_of(const char *name)
{
    static char text[4096];
    FILE *file = fopen(name, "r");
    assert_non_null(file);
    text[fread(text, 1, sizeof text - 1, file)] = '\0';
    fclose(file);
    return text;
}

static void add_rows(struct csv *csv, int from, int to)
{
    for (int i = from; i <= to; i++) assert_int_equal(csv_row(csv, 2, (double[]){i, 0.1 * i}), 0);
}

/* Rows 0 to 4, noted after `kept`. */
static void write_table(struct notes *notes, int kept)
{
    struct csv *csv;
    assert_int_equal(csv_open(path, "n,x", NULL, false, 0.0, &csv), 0);
    add_rows(csv, 0, kept);
    assert_int_equal(csv_keep(csv, "a.csv", notes), 0);
    add_rows(csv, kept + 1, 4);
    csv_close(csv);
}

/* Goes on with `name` at row 2 after a kept row 1; the table must be as if nothing had happened. */
static void go_on(const char *name, const char *origin, struct notes *notes)
{
    struct csv *csv;
    assert_int_equal(csv_open(name, "n,x", NULL, true, 3.0, &csv), 0);
    assert_int_equal(csv_recall(csv, "a.csv", notes, origin), 0);
    add_rows(csv, 2, 2);
    assert_int_equal(csv_keep(csv, "again", notes), 0);
    csv_close(csv);
    assert_string_equal(text_of(name), "n,x\n0,0\n1,0.10000000000000001\n2,0.20000000000000001\n");
}

static void rows_after_the_mark_are_cut(void **state)
{
    (void)state;
    struct notes notes = {0};
    write_table(&notes, 1);
    go_on(path, NULL, &notes);
    text_done(&notes.text);
}

/* A checksum that has gone on over a cut is that of the file. */
static void marks_hold_after_a_cut(void **state)
{
    (void)state;
    struct notes notes = {0}, fresh = {0};
    double again[3], first[3];
    write_table(&notes, 1);
    go_on(path, NULL, &notes);
    write_table(&fresh, 2);
    assert_true(notes_get(&notes, "again", 3, again) && notes_get(&fresh, "a.csv", 3, first));
    assert_memory_equal(again, first, sizeof again);
    text_done(&notes.text);
    text_done(&fresh.text);
}

static void rows_come_from_the_older_directory(void **state)
{
    (void)state;
    struct notes notes = {0};
    write_table(&notes, 1);
    go_on(other, path, &notes);
    text_done(&notes.text);
}

static void a_broken_last_row_is_cut(void **state)
{
    (void)state;
    struct notes notes = {0};
    write_table(&notes, 1);
    FILE *file = fopen(path, "a");
    fputs("5,0.", file);
    fclose(file);
    go_on(path, NULL, &notes);
    text_done(&notes.text);
}

static void missing_rows_leave_what_is_there(void **state)
{
    (void)state;
    struct notes notes = {0};
    struct csv *csv;
    write_table(&notes, 1);
    FILE *file = fopen(path, "w");
    fputs("n,x\n1,7\n", file);
    fclose(file);
    assert_int_equal(csv_open(path, "n,x", NULL, true, 3.0, &csv), 0);
    assert_int_equal(csv_recall(csv, "a.csv", &notes, other), 0);
    add_rows(csv, 2, 2);
    csv_close(csv);
    assert_string_equal(text_of(path), "n,x\n1,7\n2,0.20000000000000001\n");
    text_done(&notes.text);
}

static void other_columns_are_set_aside(void **state)
{
    (void)state;
    struct notes notes = {0};
    struct csv *csv;
    write_table(&notes, 4);
    assert_int_equal(csv_open(path, "n,y", NULL, true, 3.0, &csv), 0);
    csv_close(csv);
    assert_string_equal(text_of(path), "n,y\n");
    char *aside = mem_print("%s.before", path);
    assert_non_null(strstr(text_of(aside), "n,x\n0,0\n"));
    mem_free(aside);
    text_done(&notes.text);
}

/* Two places at 0.1 and 0.2, and what a table is when it is opened for others. */
static void other_places_are_set_aside(void **state)
{
    (void)state;
    static const char text[] = "t,x,p\n0,0.1,7\n0,0.2,8\n1,0.1,9\n1,0.2,9\n2,0.";
    static const double numbers[] = {0.1, 0.2, 0.3}, moved[] = {0.1, 0.25};
    const struct {
        struct csv_places places;
        bool stays;
    } tries[] = {{{2, 1, numbers}, true}, {{3, 1, numbers}, false}, {{1, 1, numbers}, false}, {{2, 1, moved}, false}};
    for (size_t i = 0; i < sizeof tries / sizeof *tries; i++) {
        struct csv *csv;
        FILE *file = fopen(path, "w");
        fputs(text, file);
        fclose(file);
        assert_int_equal(csv_open(path, "t,x,p", &tries[i].places, true, 3.0, &csv), 0);
        csv_close(csv);
        if (tries[i].stays) assert_memory_equal(text_of(path), text, sizeof text - 6);
        else assert_string_equal(text_of(path), "t,x,p\n");
    }
}

static void notes_read_back_to_the_bit(void **state)
{
    (void)state;
    struct notes notes = {0};
    const double values[] = {0.1, -0.0, INFINITY, -INFINITY, 5e-324, 1.7976931348623157e308};
    double back[6], nothing[6];
    notes_put_text(&notes, "text", "one two = three");
    notes_put(&notes, "values", 6, values);
    notes_put_one(&notes, "value", NAN);
    notes_put(&notes, "empty", 0, values);
    assert_true(notes_get(&notes, "values", 6, back));
    assert_memory_equal(back, values, sizeof values);
    assert_true(notes_get(&notes, "value", 1, nothing) && isnan(nothing[0]));
    assert_true(notes_get(&notes, "empty", 0, nothing));
    assert_false(notes_get(&notes, "values", 5, nothing));
    assert_false(notes_get(&notes, "values", 7, nothing));
    assert_false(notes_get(&notes, "value", 2, nothing));
    assert_false(notes_get(&notes, "text", 1, nothing));
    assert_false(notes_get(&notes, "val", 1, nothing));
    char *text = notes_get_text(&notes, "text");
    assert_string_equal(text, "one two = three");
    mem_free(text);
    assert_null(notes_get_text(&notes, "one"));
    text_done(&notes.text);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_setup_teardown(rows_after_the_mark_are_cut, make, drop),
        cmocka_unit_test_setup_teardown(marks_hold_after_a_cut, make, drop),
        cmocka_unit_test_setup_teardown(rows_come_from_the_older_directory, make, drop),
        cmocka_unit_test_setup_teardown(a_broken_last_row_is_cut, make, drop),
        cmocka_unit_test_setup_teardown(missing_rows_leave_what_is_there, make, drop),
        cmocka_unit_test_setup_teardown(other_columns_are_set_aside, make, drop),
        cmocka_unit_test_setup_teardown(other_places_are_set_aside, make, drop),
        cmocka_unit_test(notes_read_back_to_the_bit),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
