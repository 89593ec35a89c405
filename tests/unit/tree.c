/* YAML texts as trees: marks, what plain scalars mean, limits, hostile texts; and trees as text. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>

#include <cmocka.h>

#include "base/mem.h"
#include "base/text.h"
#include "case/parse.h"
#include "case/show.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

struct reading {
    struct forest *forest;
    struct diag *diag;
    struct node *root;
};

static struct reading reading_of(const char *text)
{
    struct reading reading = {tree_forest_new(), diag_new(), NULL};
    reading.root = parse_source(reading.forest, reading.diag, diag_text(reading.diag, "text", text));
    return reading;
}

static void reading_done(struct reading *reading)
{
    tree_forest_free(reading->forest);
    diag_free(reading->diag);
}

/* The text is refused, and the message has these words. */
static void refuses(const char *text, const char *words)
{
    struct reading reading = reading_of(text);
    char *said = NULL;
    size_t length;
    FILE *stream = open_memstream(&said, &length);
    diag_print(reading.diag, stream, false);
    fclose(stream);
    if (diag_errors(reading.diag) == 0 || !strstr(said, words)) fail_msg("'%.60s': %s", text, said);
    free(said);
    reading_done(&reading);
}

static void marks_count_lines_and_characters(void **state)
{
    (void)state;
    struct reading reading = reading_of("a: 1\n\"\xc3\xbc\": [x, yy]\n");
    const struct node *list = tree_get(reading.root, "\xc3\xbc");
    assert_int_equal(list->items[1]->mark.line, 2);
    assert_int_equal(list->items[1]->mark.column, 10);
    assert_int_equal(list->items[1]->mark.width, 2);
    reading_done(&reading);
}

static void plain_scalars_mean_what_yaml_1_2_says(void **state)
{
    (void)state;
    struct reading reading = reading_of("[no, true, 'true', ~, '', null, yes, off]");
    static const int flags[] = {0, 1, 0, 0, 0, 0, 0, 0}, nulls[] = {0, 0, 0, 1, 0, 1, 0, 0};
    for (unsigned i = 0; i < 8; i++) {
        bool flag;
        assert_int_equal(tree_flag(reading.root->items[i], &flag), flags[i]);
        assert_int_equal(tree_is_null(reading.root->items[i]), nulls[i]);
    }
    reading_done(&reading);
}

static void aliases_are_copies(void **state)
{
    (void)state;
    struct reading reading = reading_of("a: &x {b: [1, 2]}\nc: *x\n");
    const struct node *c = tree_get(reading.root, "c");
    assert_int_equal(tree_get(c, "b")->count, 2);
    assert_ptr_not_equal(c, tree_get(reading.root, "a"));
    reading_done(&reading);
}

static void hostile_texts_are_refused(void **state)
{
    (void)state;
    struct text bomb = {0}, deep = {0}, many = {0}, anchors = {0}, keys = {0};
    text_add(&bomb, "a0: &a0 [x, x, x, x, x, x, x, x, x, x]\n");
    for (int i = 1; i < 9; i++) {
        text_add(&bomb, "a%d: &a%d [", i, i);
        for (int k = 0; k < 7; k++) text_add(&bomb, "*a%d,", i - 1);
        text_add(&bomb, "]\n");
    }
    for (int i = 0; i < 20000; i++) text_add(&deep, "[");
    text_add(&many, "a: [");
    for (int i = 0; i < PARSE_NODES; i++) text_add(&many, "1,");
    text_add(&many, "]");
    for (int i = 0; i <= PARSE_ALIASES; i++) text_add(&anchors, "k%d: &a%d 1\n", i, i);
    for (int i = 0; i <= PARSE_KEYS; i++) text_add(&keys, "k%d: 1\n", i);
    refuses(bomb.at, "too many");
    refuses(deep.at, "nested too deeply");
    refuses(many.at, "too many values");
    refuses(anchors.at, "too many anchors");
    refuses(keys.at, "too many keys");
    refuses("a: &a [*a]", "no anchor '&a'");
    refuses("a: 1\na: 2\n", "already given in line 1");
    refuses("<<: {a: 1}\n", "merge keys");
    refuses("? [a]\n: b\n", "a key must be a word");
    refuses("a: !!int 3\n", "tags");
    refuses("a: \"x\\0y\"\n", "zero byte");
    refuses("a: \xff\n", "UTF-8");
    refuses("a: 1\n---\nb: 2\n", "second one");
    refuses("%YAML 9.9\n---\na: 1\n", "error");
    text_done(&bomb);
    text_done(&deep);
    text_done(&many);
    text_done(&anchors);
    text_done(&keys);
}

/* A tree written as text reads back as the same tree, and is then written the same. */
static void texts_survive_writing(void **state)
{
    (void)state;
    static const char *const texts[] = {
        "a: 'true'\nb: '12'\nc: ''\nd: ' x '\ne: '- x'\nf: 'a: b'\ng: 'a #b'\n",
        "a: \"tab\\tbell\\a quote\\\" back\\\\ bar\"\n",
        "a: |\n  one\n    two\n\n  three\nb: |-\n  no end\nc: |+\n  two ends\n\n\nd: end\n",
        "a: |2\n   leading\n  blank\n",
        "a: [[1, [2]], {b: {c: []}}, {}]\n",
        "\"\": {\"a b\": 1, 'x,y': [\"{\", \"]\"]}\n",
        "a: '= math.max(1, 2)'\nb: = x * 2\nc: '*x'\nd: '&x'\ne: '!x'\nf: '%x'\ng: '@x'\nh: '`x'\ni: '...'\n",
        "a:\n  - |\n    f\n    g\n  - b: |\n      x\n",
        "a: \"line\\n\"\nb: \"\\n\\nx\\n\\n\"\nc: \"x\\r\\ny\"\nd: \"\\n\"\n",
    };
    for (size_t i = 0; i < sizeof texts / sizeof *texts; i++) {
        struct reading first = reading_of(texts[i]);
        assert_non_null(first.root);
        struct text once = {0}, twice = {0};
        show_tree(first.root, &once);
        struct reading second = reading_of(once.at);
        if (!second.root) fail_msg("not readable:\n%s", once.at);
        show_tree(second.root, &twice);
        assert_string_equal(once.at, twice.at);
        for (unsigned k = 0; k < first.root->count; k++)
            if (first.root->items[k]->kind == TREE_SCALAR)
                assert_string_equal(first.root->items[k]->text, second.root->items[k]->text);
        text_done(&once);
        text_done(&twice);
        reading_done(&first);
        reading_done(&second);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(marks_count_lines_and_characters),
        cmocka_unit_test(plain_scalars_mean_what_yaml_1_2_says),
        cmocka_unit_test(aliases_are_copies),
        cmocka_unit_test(hostile_texts_are_refused),
        cmocka_unit_test(texts_survive_writing),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
