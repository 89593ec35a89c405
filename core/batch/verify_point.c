/* verify_point.c - see verify_point.h. */
#include "batch/verify_point.h"

#include "base/mem.h"
#include "base/status.h"
#include "base/system.h"

#include <errno.h>
#include <math.h>
#include <stdint.h>
#include <stdio.h>
#include <string.h>
#include <sys/wait.h>
#include <unistd.h>

void verify_point_done(struct verify_point *point)
{
    mem_free(point->scheme);
    mem_free(point->cells);
}

void verify_point_front(struct verify_point *points, unsigned n)
{
    for (unsigned i = 0; i < n; i++) {
        points[i].front = isfinite(points[i].error);
        for (unsigned k = 0; k < n; k++)
            if (k != i && points[k].error < points[i].error && points[k].cpu < points[i].cpu) points[i].front = false;
    }
}

static void verify_point_cell(struct text *out, const struct verify_point *point)
{
    const char *bold = point->front ? "**" : "";
    if (isfinite(point->error)) text_add(out, " %s%.3g%s, %.3g |", bold, point->error, bold, point->cpu);
    else text_add(out, " - |");
}

/* Rows of other codes have meshes of their own: they stand below the table. */
static void verify_point_others(struct text *out, const struct verify_point *points, unsigned n)
{
    for (unsigned i = 0; i < n; i++) {
        if (!points[i].other) continue;
        bool begins = i == 0 || strcmp(points[i].scheme, points[i - 1].scheme) != 0;
        if (begins) text_add(out, "\n%s: ", points[i].scheme);
        text_add(out, "%s%.3g in %.3g s", begins ? "" : ", ", points[i].error, points[i].cpu);
        if (i + 1 == n || strcmp(points[i].scheme, points[i + 1].scheme) != 0) text_add(out, ".\n");
    }
}

void verify_point_table(struct text *out, const struct verify_point *points, unsigned n, unsigned n_size)
{
    text_add(out, "| scheme |");
    for (unsigned i = 0; i < n_size && i < n; i++) text_add(out, " %s |", points[i].cells);
    text_add(out, "\n| --- |");
    for (unsigned i = 0; i < n_size; i++) text_add(out, " ---: |");
    for (unsigned i = 0; i < n && !points[i].other; i++) {
        if (i % n_size == 0) text_add(out, "\n| %s |", points[i].scheme);
        verify_point_cell(out, &points[i]);
    }
    text_add(out, "\n");
    verify_point_others(out, points, n);
}

int verify_point_csv(const char *path, const char *title, const struct verify_point *points, unsigned n)
{
    FILE *file = fopen(path, "w");
    if (!file) return status_fail(STATUS_RUN, "cannot write %s: %s", path, strerror(errno));
    fprintf(file, "# %s\nscheme,cells,error,cpu_s,cell_steps,kind\n", title);
    for (unsigned i = 0; i < n; i++)
        fprintf(file, "%s,%s,%.6g,%.6g,%.6g,%s\n", points[i].scheme, points[i].cells, points[i].error, points[i].cpu,
                points[i].cell_steps,
                points[i].other   ? "other"
                : points[i].front ? "front"
                                  : "run");
    bool failed = ferror(file);
    return fclose(file) || failed ? status_fail(STATUS_RUN, "cannot write %s", path) : STATUS_OK;
}

int verify_point_picture(const char *csv, const char *png)
{
    const char *words[] = {"bulla", "plot", csv, "cost", "-o", png, NULL};
    int state = 0;
    pid_t pid = fork();
    if (pid == 0) {
        system_again((char **)(uintptr_t)words);
        _exit(STATUS_RUN);
    }
    while (pid > 0 && waitpid(pid, &state, 0) < 0 && errno == EINTR) continue;
    if (pid < 0 || !WIFEXITED(state) || WEXITSTATUS(state) != STATUS_OK)
        return status_fail(STATUS_RUN, "there is no picture of %s", csv);
    return STATUS_OK;
}
