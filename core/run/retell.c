/* retell.c - see retell.h. What an older version did not write is left out. */
#include "run/retell.h"

#include "base/mem.h"
#include "base/status.h"
#include "cli/human.h"

#include <jansson.h>
#include <stdbool.h>
#include <stdlib.h>

static json_t *retell_read(const char *directory, const char *name, json_error_t *ret_error)
{
    char *path = mem_print("%s/%s", directory, name);
    json_t *root = json_load_file(path, 0, ret_error);
    mem_free(path);
    return root;
}

static double retell_number(const json_t *root, const char *key)
{
    return json_number_value(json_object_get(root, key));
}

static const char *retell_text(const json_t *root, const char *key)
{
    const char *text = json_string_value(json_object_get(root, key));
    return text ? text : "?";
}

/* Prints the head of a line. */
static void retell_line(FILE *out, const char *what)
{
    fprintf(out, "%-13s", what);
}

static void retell_who(FILE *out, const json_t *root)
{
    const json_t *cpu = json_object_get(root, "cpu");
    int ranks = (int)retell_number(root, "ranks"), hosts = (int)json_object_size(json_object_get(root, "hosts"));
    retell_line(out, "case");
    fprintf(out, "%s\n", retell_text(root, "case"));
    retell_line(out, "by");
    fprintf(out, "bulla %s (%.10s), %s\n", retell_text(root, "version"), retell_text(root, "commit"),
            retell_text(cpu, "model"));
    retell_line(out, "ranks");
    fprintf(out, "%d", ranks);
    if (hosts > 1) fprintf(out, " on %d machines", hosts);
    fputc('\n', out);
}

/* How it ended, after how many runs. */
static void retell_end(FILE *out, const json_t *root)
{
    char t[HUMAN_ROOM], count[HUMAN_ROOM];
    int runs = (int)retell_number(root, "runs");
    retell_line(out, "ended");
    fprintf(out, "%s: %s, exit code %d\n", retell_text(root, "ended"), retell_text(root, "exit_reason"),
            (int)retell_number(root, "exit_code"));
    retell_line(out, "steps");
    fprintf(out, "%s to t = %s", human_count(retell_number(root, "steps"), count),
            human_si(retell_number(root, "time"), "s", t));
    if (runs > 1) fprintf(out, ", in %d runs, the first of %s", runs, retell_text(root, "started"));
    fputc('\n', out);
}

struct retell_share {
    const char *what;
    double seconds;
};

static int retell_compare(const void *a, const void *b)
{
    double x = ((const struct retell_share *)a)->seconds, y = ((const struct retell_share *)b)->seconds;
    return x < y ? 1 : x > y ? -1 : 0;
}

/* Where the CPU time went, most of it first. */
static void retell_split(FILE *out, const json_t *split, double cpu)
{
    struct retell_share *shares = mem_new(json_object_size(split), sizeof *shares);
    const char *key;
    json_t *value;
    size_t n = 0;
    json_object_foreach((json_t *)split, key, value)
    {
        shares[n++] = (struct retell_share){key, json_number_value(value)};
    }
    qsort(shares, n, sizeof *shares, retell_compare);
    retell_line(out, "");
    for (size_t i = 0; i < n && shares[i].seconds >= 0.005 * cpu; i++)
        fprintf(out, "%s%s %.0f %%", i ? ", " : "", shares[i].what, 100.0 * shares[i].seconds / cpu);
    fputc('\n', out);
    mem_free(shares);
}

static void retell_cost(FILE *out, const json_t *root)
{
    char text[HUMAN_ROOM];
    double cpu = retell_number(root, "cpu_s"), all = retell_number(root, "cells_updated");
    double carried = retell_number(root, "cells_carried");
    const json_t *split = json_object_get(root, "cpu_split_s");
    retell_line(out, "time");
    fprintf(out, "%s of wall time,", human_duration(retell_number(root, "wall_s"), text));
    fprintf(out, " %.4g s of CPU time; %.4g ns per cell and stage", cpu, retell_number(root, "cpu_ns_per_cell_stage"));
    if (carried > 0.0 && all > 0.0) fprintf(out, "; %.0f %% of the cells rested", 100.0 * carried / all);
    fputc('\n', out);
    if (cpu > 0.0 && json_object_size(split) > 0) retell_split(out, split, cpu);
    retell_line(out, "memory");
    fprintf(out, "%s at most, ", human_bytes(retell_number(root, "peak_memory_bytes"), text));
    fprintf(out, "%.0f bytes per cell\n", retell_number(root, "bytes_per_cell"));
}

/* Sizes of the levels; with several ranks how evenly they shared them. */
static void retell_levels(FILE *out, const json_t *root)
{
    json_t *level;
    size_t l;
    json_array_foreach(json_object_get(root, "levels"), l, level)
    {
        char width[HUMAN_ROOM], cells[HUMAN_ROOM], head[32];
        const json_t *balance = json_object_get(level, "balance"), *seen = json_object_get(balance, "seen");
        snprintf(head, sizeof head, "level %zu", l);
        retell_line(out, head);
        fprintf(out, "%.0f tiles, ", retell_number(level, "tiles"));
        fprintf(out, "%s cells of ", human_count(retell_number(level, "cells"), cells));
        fprintf(out, "%s, %.0f steps", human_si(retell_number(level, "width"), "m", width),
                retell_number(level, "steps"));
        if (retell_number(root, "ranks") > 1.0 && json_is_number(seen))
            fprintf(out, "; ranks share it by %.2f (weights), %.2f (CPU time)", retell_number(balance, "predicted"),
                    json_number_value(seen));
        fputc('\n', out);
    }
}

static void retell_guard(FILE *out, const json_t *guard)
{
    const char *key;
    json_t *value;
    bool any = false;
    retell_line(out, "guard");
    json_object_foreach((json_t *)guard, key, value)
    {
        if (json_number_value(value) > 0.0)
            fprintf(out, "%s%s %.0f", any ? ", " : "", key, json_number_value(value)), any = true;
    }
    fputs(any ? "\n" : "nothing to do\n", out);
}

/* Totals: by how much they changed, boundaries and sources included; of momentum, which may begin with nothing, the
 * change itself. */
static void retell_kept(FILE *out, const json_t *totals)
{
    const char *key, *head = "change of";
    json_t *total;
    json_object_foreach((json_t *)totals, key, total)
    {
        const json_t *relative = json_object_get(total, "relative_change");
        retell_line(out, head);
        head = "";
        if (json_is_number(relative)) fprintf(out, "%s %.3g of it\n", key, json_number_value(relative));
        else fprintf(out, "%s %.3g\n", key, retell_number(total, "change"));
    }
}

static void retell_expectations(FILE *out, const json_t *expect)
{
    const json_t *list = json_object_get(expect, "expectations");
    json_t *one;
    size_t i, held = 0;
    if (json_array_size(list) == 0) return;
    json_array_foreach(list, i, one) held += json_is_true(json_object_get(one, "passed"));
    retell_line(out, "expected");
    fprintf(out, "%zu of %zu hold\n", held, json_array_size(list));
    json_array_foreach(list, i, one)
    {
        if (json_is_true(json_object_get(one, "passed"))) continue;
        retell_line(out, "");
        fprintf(out, "%s %.6g, expected %s\n", retell_text(one, "what"), retell_number(one, "value"),
                retell_text(one, "bound"));
    }
}

int retell_run(FILE *out, const char *directory)
{
    json_error_t error;
    json_t *root = retell_read(directory, "provenance.json", &error), *expect = NULL;
    if (!root)
        return status_fail(STATUS_CASE, "%s: no run is here: %s%s", directory, error.text,
                           json_error_code(&error) == json_error_cannot_open_file
                               ? "; give the output directory of a run, or a file in it"
                               : "");
    fprintf(out, "run          %s: %s\n", retell_text(root, "name"), retell_text(root, "title"));
    retell_who(out, root);
    retell_end(out, root);
    retell_cost(out, root);
    retell_levels(out, root);
    retell_guard(out, json_object_get(root, "guard"));
    retell_kept(out, json_object_get(root, "conservation"));
    expect = retell_read(directory, "expect.json", &error);
    retell_expectations(out, expect);
    json_decref(expect);
    json_decref(root);
    return STATUS_OK;
}
