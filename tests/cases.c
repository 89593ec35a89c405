/* cases.c - from cases/matrix.yaml to tests: prints them as ctest reads them.
 *
 *     test-cases MATRIX.yaml PROGRAM RUNS ENVIRONMENT FOLDER CASE...
 *
 * MATRIX.yaml lists what is run; PROGRAM is bulla, RUNS the folder for outputs, ENVIRONMENT that of the tests, FOLDER
 * that of the cases, CASE "verify/r01.yaml". A mistake in the file ends the build, with its place. The name of a
 * test says what it is: case-verify-r01, case-verify-r01.limiter=minmod,ranks=2, case-verify-r01.strict. */
#include "base/mem.h"
#include "base/status.h"
#include "base/text.h"
#include "batch/matrix.h"
#include "batch/sweep_name.h"
#include "case/keys_read.h"
#include "case/parse.h"
#include "case/script_host.h"

#include <fnmatch.h>
#include <stdio.h>
#include <string.h>

enum { CASES_TIMEOUT = 1800 }; /* s */

static const struct key cases_entry_rows[] = {
    {.name = "label", .type = KEYS_TEXT, .required = true, .doc = "Label of its tests: ctest -L LABEL."},
    {.name = "cases", .type = KEYS_TEXT, .many = KEYS_LIST, .required = true, .doc = "Patterns: tour/tube, verify/r*."},
    {.name = "variant", .type = KEYS_TEXT, .fallback = "quick", .doc = "Variant that is run."},
    {.name = "ranks", .type = KEYS_INTEGER, .many = KEYS_LIST, .min = 1, .max = 64, .doc = "One test for each."},
    {.name = "matrix", .type = KEYS_TREE, .many = KEYS_NAMED, .doc = "One test for each combination, as in a case."},
    {0},
};
static const struct keys_section cases_entry = {.name = "entry", .doc = "Tests of cases.", .keys = cases_entry_rows};
static const struct key cases_root_rows[] = {
    {.name = "tests",
     .type = KEYS_SECTION,
     .many = KEYS_LIST,
     .section = &cases_entry,
     .required = true,
     .doc = "What is run."},
    {0},
};
static const struct keys_section cases_root = {.name = "file", .doc = "The matrix of tests.", .keys = cases_root_rows};

struct cases {
    const char *program, *runs, *environment, *folder;
    char **files;
    int n_file;
    struct keys keys;
    char **names; /* of all tests so far */
    unsigned n_name;
};

/* One test: a case, settings, ranks (0: as the program takes them). */
struct cases_test {
    const char *file, *label, *variant;
    const struct matrix *matrix;
    unsigned row;
    long ranks;
};

/* "verify/r01.yaml" -> "case-verify-r01", and behind it what is varied, or the label if it is nothing but the case with
 * other settings. */
static char *cases_name(const struct cases_test *test)
{
    struct text name = {0}, varied = {0};
    char *settings = sweep_name_varied(test->matrix, test->row);
    text_add(&name, "case-%.*s", (int)strlen(test->file) - 5, test->file);
    for (char *at = name.at; *at; at++)
        if (*at == '/' || *at == '_') *at = '-';
    text_add(&varied, "%s", settings);
    if (strcmp(test->variant, "quick") != 0) text_add(&varied, "%svariant=%s", varied.length ? "," : "", test->variant);
    if (test->ranks) text_add(&varied, "%sranks=%ld", varied.length ? "," : "", test->ranks);
    if (!varied.length && test->matrix->n_set) text_add(&varied, "%s", test->label);
    if (varied.length) text_add(&name, ".%s", varied.at);
    text_done(&varied);
    mem_free(settings);
    return name.at;
}

static void cases_print(const struct cases *cases, const struct cases_test *test, const char *name)
{
    const char *slash = strchr(test->file, '/');
    printf("add_test([==[%s]==] [==[%s]==] run [==[%s/%s]==] --variant [==[%s]==] --quiet --overwrite -o [==[%s/%s]==]",
           name, cases->program, cases->folder, test->file, test->variant, cases->runs, name);
    if (test->ranks) printf(" -n %ld", test->ranks);
    for (unsigned k = 0; k < test->matrix->n_set; k++)
        printf(" --set [==[%s]==]", test->matrix->rows[test->row].sets[k]);
    printf(
        ")\nset_tests_properties([==[%s]==] PROPERTIES ENVIRONMENT [==[%s]==] LABELS [==[case;%.*s;%s]==] TIMEOUT %d "
        "PROCESSORS %ld)\n",
        name, cases->environment, slash ? (int)(slash - test->file) : 0, test->file, test->label, CASES_TIMEOUT,
        test->ranks ? test->ranks : 1);
    if (test->ranks > 1) /* Open MPI leaks by itself */
        printf("set_tests_properties([==[%s]==] PROPERTIES ENVIRONMENT_MODIFICATION "
               "ASAN_OPTIONS=string_append::detect_leaks=0)\n",
               name);
}

static bool cases_add(struct cases *cases, const struct cases_test *test)
{
    char *name = cases_name(test);
    for (unsigned i = 0; i < cases->n_name; i++)
        if (strcmp(cases->names[i], name) == 0) {
            mem_free(name);
            return false;
        }
    cases->names = mem_grow(cases->names, cases->n_name, cases->n_name + 1, sizeof *cases->names);
    cases->names[cases->n_name++] = name;
    cases_print(cases, test, name);
    return true;
}

/* All tests of an entry for one case. */
static void cases_of(struct cases *cases, const struct keys_map *entry, const struct matrix *matrix, const char *file)
{
    const struct keys_value *ranks = keys_at(entry, "ranks"), *label = keys_at(entry, "label");
    struct cases_test test = {file, label->text, keys_at(entry, "variant")->text, matrix, 0, 0};
    for (; test.row < matrix->n_row; test.row++)
        for (unsigned r = 0; r < (ranks->count ? ranks->count : 1); r++) {
            test.ranks = ranks->count ? ranks->list[r].integer : 0;
            if (cases_add(cases, &test)) continue;
            char *name = cases_name(&test);
            keys_error(&cases->keys, label, "'%s' makes the test %s, which another entry has made", label->text, name);
            mem_free(name);
        }
}

static bool cases_wanted(const struct keys_value *patterns, const char *file, bool *used)
{
    bool wanted = false;
    char *stem = mem_text_n(file, strlen(file) - strlen(".yaml"));
    for (unsigned i = 0; i < patterns->count; i++) {
        if (!patterns->list[i].given || fnmatch(patterns->list[i].text, stem, FNM_PATHNAME) != 0) continue;
        wanted = used[i] = true;
    }
    mem_free(stem);
    return wanted;
}

static void cases_read_entry(struct cases *cases, const struct keys_value *value)
{
    const struct keys_map *entry = value->map;
    const struct keys_value *patterns = keys_at(entry, "cases");
    struct matrix matrix;
    if (!keys_at(entry, "label")->given || !patterns->given) return;
    if (matrix_combine(entry->node, &matrix)) {
        keys_error(&cases->keys, value, "%s", status_text());
        return;
    }
    bool *used = mem_new(patterns->count, sizeof *used);
    for (int i = 0; i < cases->n_file; i++)
        if (cases_wanted(patterns, cases->files[i], used)) cases_of(cases, entry, &matrix, cases->files[i]);
    for (unsigned i = 0; i < patterns->count; i++)
        if (patterns->list[i].given && !used[i])
            keys_error(&cases->keys, &patterns->list[i], "there is no case '%s'", patterns->list[i].text);
    mem_free(used);
    matrix_done(&matrix);
}

static void cases_read(struct cases *cases, const char *path)
{
    struct keys *keys = &cases->keys;
    const struct source *source = diag_file(keys->diag, path, PARSE_BYTES, NULL);
    struct node *root = source ? parse_source(keys->forest, keys->diag, source) : NULL;
    const struct keys_map *map = root ? keys_read(keys, root, &cases_root, "") : NULL;
    const struct keys_value *tests = keys_at(map, "tests");
    for (unsigned i = 0; map && i < tests->count; i++)
        if (tests->list[i].map) cases_read_entry(cases, &tests->list[i]);
}

int main(int argc, char **argv)
{
    enum { FIXED = 6 };
    if (argc < FIXED) {
        fprintf(stderr, "usage: test-cases MATRIX.yaml PROGRAM RUNS ENVIRONMENT FOLDER CASE...\n");
        return STATUS_CASE;
    }
    struct cases cases = {argv[2], argv[3], argv[4], argv[5], argv + FIXED, argc - FIXED, {0}, NULL, 0};
    struct diag *diag = diag_new();
    struct forest *forest = tree_forest_new();
    struct script_host *host = script_host_new();
    struct params *params = params_new(forest, diag, host);
    cases.keys = (struct keys){forest, diag, params, &cases_root};
    cases_read(&cases, argv[1]);
    diag_print(diag, stderr, false);
    int code = diag_errors(diag) ? STATUS_CASE : STATUS_OK;
    for (unsigned i = 0; i < cases.n_name; i++) mem_free(cases.names[i]);
    mem_free(cases.names);
    params_free(params);
    script_host_free(host);
    tree_forest_free(forest);
    diag_free(diag);
    return code;
}
