/* sweep_look.c - see sweep_look.h. */
#include "batch/sweep_look.h"

#include "base/mem.h"
#include "base/status.h"
#include "base/text.h"
#include "batch/study_row.h"
#include "case/parse.h"
#include "case/show.h"
#include "run/outdir.h"

#include <dirent.h>
#include <stdbool.h>
#include <stdio.h>
#include <string.h>

/* The text of a file, "" if there is none. */
static char *sweep_look_load(const char *directory, const char *name)
{
    char *path = mem_print("%s/%s", directory, name), buffer[4096];
    struct text text = {0};
    FILE *file = fopen(path, "r");
    text_add(&text, "%s", "");
    for (size_t n; file && (n = fread(buffer, 1, sizeof buffer, file)) > 0;) text_add_n(&text, buffer, n);
    if (file) fclose(file);
    mem_free(path);
    return text.at;
}

/* A resolved case without its output directory, in the form that `bulla show` gives it; "" if it is none. */
static char *sweep_look_core(const char *case_text)
{
    struct forest *forest = tree_forest_new();
    struct diag *diag = diag_new();
    struct text text = {0};
    struct node *root = parse_source(forest, diag, diag_text(diag, "case.yaml", case_text));
    struct node *output = root ? tree_get(root, "output") : NULL;
    int at = tree_find(output, "directory");
    if (at >= 0) tree_remove(output, (unsigned)at);
    text_add(&text, "%s", "");
    if (root && root->kind == TREE_MAP) show_tree(root, &text);
    diag_free(diag);
    tree_forest_free(forest);
    return text.at;
}

/* The first line that differs; NULL: none. */
static char *sweep_look_compare(const char *old, const char *now)
{
    while (*old || *now) {
        size_t a = strcspn(old, "\n"), b = strcspn(now, "\n");
        if (a != b || strncmp(old, now, a) != 0)
            return mem_print("its case has '%.*s', now it would be '%.*s'", (int)a, old, (int)b, now);
        old += a + (old[a] == '\n');
        now += b + (now[b] == '\n');
    }
    return NULL;
}

static char *sweep_look_difference(const char *there, const char *resolved)
{
    char *old = sweep_look_core(there), *now = sweep_look_core(resolved);
    char *difference = sweep_look_compare(old, now);
    mem_free(old);
    mem_free(now);
    return difference;
}

static bool sweep_look_saved(const char *directory)
{
    char *path = mem_print("%s/checkpoints", directory);
    DIR *folder = opendir(path);
    bool saved = false;
    for (struct dirent *entry; folder && !saved && (entry = readdir(folder));) {
        const char *dot = strrchr(entry->d_name, '.');
        saved = dot && strcmp(dot, ".chk") == 0;
    }
    if (folder) closedir(folder);
    mem_free(path);
    return saved;
}

enum sweep_look sweep_look_at(const char *directory, const char *resolved, char **ret_difference)
{
    *ret_difference = NULL;
    if (outdir_check(directory, false) == STATUS_OK) return SWEEP_LOOK_NEW;
    char *there = sweep_look_load(directory, "case.yaml");
    *ret_difference = *there ? sweep_look_difference(there, resolved) : mem_text("it has no case.yaml");
    mem_free(there);
    if (*ret_difference) return SWEEP_LOOK_FOREIGN;
    int code = study_row_exit(directory);
    if (code == STATUS_OK || code == STATUS_EXPECT) return SWEEP_LOOK_DONE;
    return sweep_look_saved(directory) ? SWEEP_LOOK_SAVED : SWEEP_LOOK_BEGUN;
}
