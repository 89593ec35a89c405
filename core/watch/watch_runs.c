/* watch_runs.c - see watch_runs.h. */
#include "watch/watch_runs.h"

#include "base/mem.h"
#include "base/status.h"

#include <dirent.h>
#include <stdbool.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

/* Has a run begun here? */
static bool watch_runs_is_run(const char *path)
{
    static const char *const files[] = {"case.yaml", "provenance.json", "history.csv", "log.txt"};
    struct stat entry;
    bool is_run = false;
    for (size_t i = 0; !is_run && i < sizeof files / sizeof *files; i++) {
        char *file = mem_print("%s/%s", path, files[i]);
        is_run = stat(file, &entry) == 0 && S_ISREG(entry.st_mode);
        mem_free(file);
    }
    return is_run;
}

/* Takes both texts. */
static void watch_runs_add(struct watch_runs *runs, char *path, char *name)
{
    for (unsigned i = 0; i < runs->n; i++)
        if (strcmp(runs->paths[i], path) == 0) {
            mem_free(path);
            mem_free(name);
            return;
        }
    runs->paths[runs->n] = path;
    runs->names[runs->n++] = name;
}

/* Runs in a directory, numbers in their names by size. */
static void watch_runs_inside(struct watch_runs *runs, const char *directory)
{
    struct dirent **entries = NULL;
    int n = scandir(directory, &entries, NULL, versionsort);
    for (int i = 0; i < n; i++) {
        const char *name = entries[i]->d_name;
        char *path = mem_print("%s/%s", directory, name);
        if (name[0] != '.' && runs->n < WATCH_RUNS_MOST && watch_runs_is_run(path))
            watch_runs_add(runs, path, runs->n_given > 1 ? mem_text(path) : mem_text(name));
        else mem_free(path);
        free(entries[i]);
    }
    free(entries);
}

void watch_runs_look(struct watch_runs *runs)
{
    for (unsigned i = 0; i < runs->n_given && runs->n < WATCH_RUNS_MOST; i++)
        if (watch_runs_is_run(runs->given[i])) watch_runs_add(runs, mem_text(runs->given[i]), mem_text(runs->given[i]));
        else watch_runs_inside(runs, runs->given[i]);
}

int watch_runs_begin(const char *const *given, unsigned n_given, struct watch_runs *ret_runs)
{
    struct stat entry;
    for (unsigned i = 0; i < n_given; i++)
        if (stat(given[i], &entry) || !S_ISDIR(entry.st_mode))
            return status_fail(STATUS_CASE,
                               "no directory %s: watch wants the output directory of a run, or one that holds several",
                               given[i]);
    *ret_runs = (struct watch_runs){.given = given, .n_given = n_given};
    watch_runs_look(ret_runs);
    return STATUS_OK;
}

void watch_runs_done(struct watch_runs *runs)
{
    for (unsigned i = 0; i < runs->n; i++) {
        mem_free(runs->paths[i]);
        mem_free(runs->names[i]);
    }
    runs->n = 0;
}
