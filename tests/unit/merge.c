/* Overlays on the level of trees: what is merged, replaced, deleted, and where marks point afterwards. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>

#include <cmocka.h>

#include "base/mem.h"
#include "base/text.h"
#include "case/merge.h"
#include "case/show.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

static char folder[] = "/tmp/bulla-merge-XXXXXX";

struct reading {
    struct forest *forest;
    struct diag *diag;
    struct node *root;
};

static const char *path_of(const char *name)
{
    static char path[256];
    snprintf(path, sizeof path, "%s/%s", folder, name);
    return path;
}

static void put(const char *name, const char *text)
{
    FILE *file = fopen(path_of(name), "w");
    assert_non_null(file);
    fputs(text, file);
    fclose(file);
}

static struct reading merge(const char *name, const char *variant, const char *set)
{
    const char *sets[] = {set, NULL};
    struct merge_options options = {set ? sets : NULL, variant};
    struct reading reading = {tree_forest_new(), diag_new(), NULL};
    reading.root = merge_case(reading.forest, reading.diag, path_of(name), &options);
    return reading;
}

static void done(struct reading *reading)
{
    tree_forest_free(reading->forest);
    diag_free(reading->diag);
}

static void check(const char *variant, const char *set, const char *expected)
{
    struct reading reading = merge("case.yaml", variant, set);
    struct text text = {0};
    if (!reading.root) {
        diag_print(reading.diag, stderr, false);
        fail_msg("not merged: %s", set ? set : "");
    }
    show_value(reading.root, &text);
    assert_string_equal(text.at, expected);
    text_done(&text);
    done(&reading);
}

static void refuses(const char *name, const char *variant, const char *set, const char *words)
{
    struct reading reading = merge(name, variant, set);
    char *said = NULL;
    size_t length;
    FILE *stream = open_memstream(&said, &length);
    diag_print(reading.diag, stream, false);
    fclose(stream);
    if (diag_errors(reading.diag) == 0 || !strstr(said, words)) fail_msg("%s, %s: %s", variant, set, said);
    free(said);
    done(&reading);
}

static void maps_merge_lists_and_types_replace_null_deletes(void **state)
{
    (void)state;
    put("base.yaml", "a: {x: 1, y: {p: 1, q: 2}}\nl: [1, 2, 3]\nt: {type: old, k: 1}\ngone: 1\n");
    put("case.yaml", "extends: base.yaml\na: {y: {q: 3}}\nl: [4]\nt: {type: new, m: 2}\ngone: null\n");
    check(NULL, NULL, "{a: {x: 1, y: {p: 1, q: 3}}, l: [4], t: {type: new, m: 2}}");
}

/* Keys of the old pulse go with it; those of every incoming wave, and of maps that are none, stay. */
static void pulses_replace_their_keys(void **state)
{
    (void)state;
    put("base.yaml", "w: {type: incoming-wave, pulse: sine, amplitude: 1, frequency: 2, delay: 3}\n"
                     "p: {pulse: 1, frequency: 2}\n");
    put("case.yaml", "extends: base.yaml\nw: {pulse: gaussian, width: 4}\np: {pulse: 5}\n");
    check(NULL, NULL, "{w: {type: incoming-wave, delay: 3, pulse: gaussian, width: 4}, p: {frequency: 2, pulse: 5}}");
    put("case.yaml", "extends: base.yaml\nw: {pulse: sine, frequency: 4}\n");
    check(NULL, NULL,
          "{w: {type: incoming-wave, amplitude: 1, delay: 3, pulse: sine, frequency: 4}, p: {pulse: 1, frequency: 2}}");
    put("case.yaml", "extends: base.yaml\nvariants: {v: {w: {pulse: series, file: a.csv}}}\n");
    check("v", "variants=null",
          "{w: {type: incoming-wave, delay: 3, pulse: series, file: a.csv}, p: {pulse: 1, frequency: 2}}");
}

static void variants_lie_over_the_file_and_settings_over_variants(void **state)
{
    (void)state;
    put("case.yaml", "a: {x: 1}\nvariants: {v: {a: {x: 2, y: 3}}}\nquick: {a: {x: 4}}\n");
    check("v", NULL, "{a: {x: 2, y: 3}, variants: {v: {a: {x: 2, y: 3}}}, quick: {a: {x: 4}}}");
    check("quick", NULL, "{a: {x: 4}, variants: {v: {a: {x: 2, y: 3}}}, quick: {a: {x: 4}}}");
    check("quick", "a.x=5 um", "{a: {x: 5 um}, variants: {v: {a: {x: 2, y: 3}}}, quick: {a: {x: 4}}}");
    refuses("case.yaml", "w", NULL, "no such variant");
    put("case.yaml", "a: 1\nvariants: {v: {extends: x.yaml}}\n");
    refuses("case.yaml", "v", NULL, "no 'extends' of its own");
}

static void settings_find_their_place(void **state)
{
    (void)state;
    put("case.yaml", "l: [{p: 1}, {p: 2}]\ns: mc\n");
    check(NULL, "l.1.p=3", "{l: [{p: 1}, {p: 3}], s: mc}");
    check(NULL, "l[0].p=3", "{l: [{p: 3}, {p: 2}], s: mc}");
    check(NULL, "l[0]={q: 4}", "{l: [{q: 4}, {p: 2}], s: mc}");
    check(NULL, "s.beta=2", "{l: [{p: 1}, {p: 2}], s: {type: mc, beta: 2}}");
    check(NULL, "n.m.k= = 2 * R0", "{l: [{p: 1}, {p: 2}], s: mc, n: {m: {k: = 2 * R0}}}");
    check(NULL, "l.0.p=null", "{l: [{}, {p: 2}], s: mc}");
    refuses("case.yaml", NULL, "l.2.p=3", "entries 0 to 1");
    refuses("case.yaml", NULL, "l.-1.p=3", "no entry");
    refuses("case.yaml", NULL, "l[0=3", "a path looks like");
    refuses("case.yaml", NULL, "a..b=3", "a path looks like");
    refuses("case.yaml", NULL, "=3", "'path=value' is needed");
    refuses("case.yaml", NULL, "a=", "'path=value' is needed");
    refuses("case.yaml", NULL, "a=[1", "did not find expected");
    refuses("case.yaml", NULL, "nothing=null", "nothing at 'nothing'");
}

static void files_that_extend_in_circles_or_too_deep(void **state)
{
    (void)state;
    char name[32], text[64];
    put("one.yaml", "extends: two.yaml\n");
    put("two.yaml", "extends: one.yaml\n");
    refuses("one.yaml", NULL, NULL, "extends itself");
    for (int i = 0; i < 20; i++) {
        snprintf(name, sizeof name, "deep%d.yaml", i);
        snprintf(text, sizeof text, "extends: deep%d.yaml\n", i + 1);
        put(name, text);
    }
    put("deep20.yaml", "a: 1\n");
    refuses("deep0.yaml", NULL, NULL, "more than 16 files");
    refuses("nowhere.yaml", NULL, NULL, "No such file");
}

static void marks_survive(void **state)
{
    (void)state;
    put("base.yaml", "a:\n  x: 1\n");
    put("case.yaml", "extends: base.yaml\n\na: {y: 2}\n");
    struct reading reading = merge("case.yaml", NULL, "a.z=3");
    const struct node *a = tree_get(reading.root, "a");
    assert_non_null(strstr(tree_get(a, "x")->mark.source->name, "base.yaml"));
    assert_int_equal(tree_get(a, "x")->mark.line, 2);
    assert_non_null(strstr(tree_get(a, "y")->mark.source->name, "case.yaml"));
    assert_int_equal(tree_get(a, "y")->mark.line, 3);
    assert_false(tree_get(a, "z")->mark.source->is_file);
    assert_string_equal(tree_get(a, "z")->mark.source->name, "--set a.z=3");
    done(&reading);
}

static int make_folder(void **state)
{
    (void)state;
    return mkdtemp(folder) ? 0 : -1;
}

static int remove_folder(void **state)
{
    (void)state;
    static const char *const names[] = {"base", "case", "one", "two"};
    char name[32];
    for (int i = 0; i < 25; i++) {
        if (i < 21) snprintf(name, sizeof name, "deep%d.yaml", i);
        else snprintf(name, sizeof name, "%s.yaml", names[i - 21]);
        unlink(path_of(name));
    }
    return rmdir(folder);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(maps_merge_lists_and_types_replace_null_deletes),
        cmocka_unit_test(pulses_replace_their_keys),
        cmocka_unit_test(variants_lie_over_the_file_and_settings_over_variants),
        cmocka_unit_test(settings_find_their_place),
        cmocka_unit_test(files_that_extend_in_circles_or_too_deep),
        cmocka_unit_test(marks_survive),
    };
    return cmocka_run_group_tests(tests, make_folder, remove_folder);
}
