/* What legends call runs: titles that tell them apart, or the parts of their paths that do; what files are called. */
#include "base/mem.h"
#include "view/plot_case.h"
#include "view/plot_option.h"
#include "close.h"

#include <ftw.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

static void run_new(const char *directory, const char *title)
{
    char path[128];
    for (const char *slash = strchr(directory, '/'); slash; slash = strchr(slash + 1, '/')) {
        snprintf(path, sizeof path, "%.*s", (int)(slash - directory), directory);
        mkdir(path, 0777);
    }
    mkdir(directory, 0777);
    snprintf(path, sizeof path, "%s/case.yaml", directory);
    FILE *file = fopen(path, "w");
    assert_non_null(file);
    if (title) fprintf(file, "title: %s\n", title);
    fclose(file);
}

static void expect_names(const char *const *directories, unsigned n, const char *const *names)
{
    char *found[4];
    plot_case_names(directories, n, found);
    for (unsigned i = 0; i < n; i++) {
        assert_string_equal(found[i], names[i]);
        mem_free(found[i]);
    }
}

static void expect_title(const char *const *directories, unsigned n, const char *title)
{
    char *found = plot_case_common_title(directories, n);
    assert_string_equal(found, title);
    mem_free(found);
}

static void titles_tell_runs_apart(void **state)
{
    (void)state;
    run_new("names/a", "Bubble in water");
    run_new("names/b", "Bubble in gel");
    const char *const directories[] = {"names/a", "names/b"};
    expect_names(directories, 2, (const char *const[]){"Bubble in water", "Bubble in gel"});
    expect_title(directories, 2, "");
    expect_title(directories, 1, "Bubble in water");
}

static void equal_titles_leave_the_directories(void **state)
{
    (void)state;
    run_new("sweep/p=1MPa", "Bubble");
    run_new("sweep/p=2MPa", "Bubble");
    const char *const directories[] = {"sweep/p=1MPa", "sweep/p=2MPa"};
    expect_names(directories, 2, (const char *const[]){"p=1MPa", "p=2MPa"});
    expect_title(directories, 2, "Bubble");
}

static void equal_directories_leave_what_differs(void **state)
{
    (void)state;
    run_new("deep/tree/fine/out", "Bubble");
    run_new("deep/tree/fast/out", "Bubble");
    run_new("deep/tree/fast/other", "Bubble");
    run_new("out", NULL);
    expect_names((const char *const[]){"deep/tree/fine/out", "deep/tree/fast/out"}, 2,
                 (const char *const[]){"fine", "fast"});
    expect_names((const char *const[]){"deep/tree/fine/out", "deep/tree/fast/out", "deep/tree/fast/other"}, 3,
                 (const char *const[]){"fine/out", "fast/out", "fast/other"});
    expect_names((const char *const[]){"out", "deep/tree/fine/out"}, 2, (const char *const[]){"out", "Bubble"});
    run_new("deep/out", NULL);
    expect_names((const char *const[]){"out", "deep/out"}, 2, (const char *const[]){"out", "deep/out"});
}

static void a_legend_has_no_room_for_long_titles(void **state)
{
    (void)state;
    run_new("long/a", "A bubble of 10 um at a wall of polyacrylamide gel, squeezed by a pulse of 30 MPa");
    run_new("long/b", "A bubble");
    const char *const directories[] = {"long/a", "long/b"};
    expect_names(directories, 2, (const char *const[]){"a", "b"});
}

static void files_of_several_fields_have_their_names(void **state)
{
    (void)state;
    const char *const cases[][2] = {
        {"x.png", "x_p.png"}, {"x", "x_p"}, {"a.b/x", "a.b/x_p"}, {"a.b/.x", "a.b/.x_p"}, {"a/x.1.png", "a/x.1_p.png"}};
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        char *file = plot_option_file(cases[i][0], "p");
        assert_string_equal(file, cases[i][1]);
        mem_free(file);
    }
}

/* All runs are in a folder of their own. */
static int enter(void **state)
{
    static char folder[] = "/tmp/plot_case_XXXXXX";
    *state = mkdtemp(folder);
    return *state && chdir(folder) == 0 ? 0 : -1;
}

static int drop(const char *path, const struct stat *entry, int kind, struct FTW *place)
{
    (void)entry;
    (void)kind;
    (void)place;
    return remove(path);
}

static int leave(void **state)
{
    return nftw(*state, drop, 8, FTW_DEPTH | FTW_PHYS);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(titles_tell_runs_apart),
        cmocka_unit_test(equal_titles_leave_the_directories),
        cmocka_unit_test(equal_directories_leave_what_differs),
        cmocka_unit_test(a_legend_has_no_room_for_long_titles),
        cmocka_unit_test(files_of_several_fields_have_their_names),
    };
    return cmocka_run_group_tests(tests, enter, leave);
}
