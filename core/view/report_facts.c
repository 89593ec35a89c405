/* report_facts.c - see report_facts.h. */
#include "view/report_facts.h"

#include "base/mem.h"
#include "view/picture_scale.h"
#include "view/plot_case.h"
#include "view/report_html.h"

#include <jansson.h>
#include <math.h>
#include <stdio.h>
#include <string.h>

static json_t *facts_json(const char *directory, const char *name)
{
    char *path = mem_print("%s/%s", directory, name);
    json_t *root = json_load_file(path, 0, NULL);
    mem_free(path);
    return root;
}

static FILE *facts_open(const char *directory, const char *name)
{
    char *path = mem_print("%s/%s", directory, name);
    FILE *file = fopen(path, "r");
    mem_free(path);
    return file;
}

void report_facts_head(struct text *page, const char *directory)
{
    char *title = plot_case_title(directory), *about = plot_case_scalar(directory, "about");
    char *cite = plot_case_scalar(directory, "cite");
    text_add(page, "<h1>");
    report_html_text(page, title);
    text_add(page, "</h1>\n");
    if (about) {
        text_add(page, "<p class=\"about\">");
        report_html_text(page, about);
        text_add(page, "</p>\n");
    }
    if (cite) {
        text_add(page, "<p class=\"cite\">");
        report_html_text(page, cite);
        text_add(page, "</p>\n");
    }
    mem_free(title);
    mem_free(about);
    mem_free(cite);
}

struct facts_row {
    const char *key, *label, *unit; /* unit NULL: as it is; "" a count */
};

static void facts_value(const json_t *value, const char *unit, char *ret_words, size_t size)
{
    double number = json_number_value(value);
    char shown[PICTURE_SCALE_LABEL];
    if (json_is_string(value)) snprintf(ret_words, size, "%s", json_string_value(value));
    else if (json_is_integer(value)) snprintf(ret_words, size, "%lld", (long long)json_integer_value(value));
    else if (unit && strcmp(unit, "B") == 0) snprintf(ret_words, size, "%.1f MB", 1e-6 * number);
    else if (unit && strcmp(unit, "wall") == 0) snprintf(ret_words, size, "%.1f s", number);
    else if (unit && *unit) {
        picture_scale_quantity(number, number, unit, shown);
        snprintf(ret_words, size, "%s", shown);
    } else snprintf(ret_words, size, "%.6g", number);
}

static void facts_add(struct text *page, const char *label, const char *words)
{
    text_add(page, "<div><span>%s</span>", label);
    report_html_text(page, words);
    text_add(page, "</div>\n");
}

/* The largest relative change of a conserved total, as the run noted it. */
static void facts_drift(struct text *page, json_t *conservation)
{
    const char *name;
    json_t *entry;
    json_object_foreach(conservation, name, entry)
    {
        const json_t *change = json_object_get(entry, "relative_change");
        char label[160], words[64];
        if (!json_is_number(change)) continue;
        snprintf(label, sizeof label, "change of %.100s", name);
        snprintf(words, sizeof words, "%.2e", json_number_value(change));
        facts_add(page, label, words);
    }
}

static void facts_guard(struct text *page, json_t *guard)
{
    const char *name;
    json_t *count;
    json_object_foreach(guard, name, count)
    {
        char label[160], words[64];
        snprintf(label, sizeof label, "guard: %.100s", name);
        snprintf(words, sizeof words, "%lld", (long long)json_integer_value(count));
        facts_add(page, label, words);
    }
}

/* What iterated pressures took, and where laws were left. */
static void facts_laws(struct text *page, const json_t *closures, json_t *outside)
{
    char label[160], words[128];
    const char *name;
    json_t *counts;
    if (json_integer_value(json_object_get(closures, "solved")) > 0) {
        snprintf(words, sizeof words, "%lld, %.3g steps each, at most %lld",
                 (long long)json_integer_value(json_object_get(closures, "solved")),
                 json_number_value(json_object_get(closures, "mean_steps")),
                 (long long)json_integer_value(json_object_get(closures, "most_steps")));
        facts_add(page, "pressures iterated", words);
    }
    json_object_foreach(outside, name, counts)
    {
        snprintf(label, sizeof label, "law of %.100s left", name);
        snprintf(words, sizeof words, "%lld cell-steps, %lld cells at most",
                 (long long)json_integer_value(json_object_get(counts, "cell_steps")),
                 (long long)json_integer_value(json_object_get(counts, "most_cells")));
        facts_add(page, label, words);
    }
}

/* Cells of each level at the end and at most, and what it cost to move them; nothing for a mesh of one level. */
static void facts_levels(struct text *page, const json_t *root)
{
    const json_t *levels = json_object_get(root, "levels"), *refinement = json_object_get(root, "refinement");
    json_t *level;
    size_t l;
    if (json_array_size(levels) < 2) return;
    json_array_foreach(levels, l, level)
    {
        char label[96], words[256], width[PICTURE_SCALE_LABEL];
        double h = json_number_value(json_object_get(level, "width"));
        picture_scale_quantity(h, h, "m", width);
        snprintf(label, sizeof label, "level %zu, cells of %.40s", l, width);
        snprintf(words, sizeof words, "%lld, %lld of them leaves; at most %lld",
                 (long long)json_integer_value(json_object_get(level, "cells")),
                 (long long)json_integer_value(json_object_get(level, "leaves")),
                 (long long)json_integer_value(json_object_get(level, "peak_cells")));
        facts_add(page, label, words);
    }
    char words[128];
    snprintf(words, sizeof words, "%lld, %.2g %% of the CPU time",
             (long long)json_integer_value(json_object_get(refinement, "regrids")),
             100.0 * json_number_value(json_object_get(refinement, "regrid_share")));
    facts_add(page, "regrids", words);
}

void report_facts_run(struct text *page, const char *directory)
{
    static const struct facts_row rows[] = {
        {"exit_reason", "ended", NULL},
        {"time", "simulated time", "s"},
        {"steps", "steps", ""},
        {"leaves", "cells", ""},
        {"ranks", "ranks", ""},
        {"wall_s", "wall time", "wall"},
        {"cpu_s", "CPU time", "wall"},
        {"cpu_ns_per_cell_stage", "CPU per cell and stage [ns]", ""},
        {"peak_memory_bytes", "peak memory", "B"},
        {"started", "started", NULL},
        {"version", "version", NULL},
        {"commit", "commit", NULL},
    };
    json_t *root = facts_json(directory, "provenance.json");
    if (!root) return;
    text_add(page, "<h2>Run</h2>\n<div class=\"facts\">\n");
    for (size_t i = 0; i < sizeof rows / sizeof *rows; i++) {
        const json_t *value = json_object_get(root, rows[i].key);
        char words[256];
        if (!json_is_string(value) && !json_is_number(value)) continue;
        facts_value(value, rows[i].unit, words, sizeof words);
        facts_add(page, rows[i].label, words);
    }
    facts_levels(page, root);
    facts_drift(page, json_object_get(root, "conservation"));
    if (json_object_get(root, "sources"))
        facts_add(page, "sources, part of these changes", json_string_value(json_object_get(root, "sources")));
    facts_guard(page, json_object_get(root, "guard"));
    facts_laws(page, json_object_get(root, "closures"), json_object_get(root, "outside"));
    text_add(page, "</div>\n");
    json_decref(root);
}

void report_facts_expect(struct text *page, const char *directory)
{
    json_t *root = facts_json(directory, "expect.json"), *item;
    const json_t *list = json_object_get(root, "expectations");
    size_t i;
    if (json_array_size(list)) {
        text_add(page,
                 "<h2>Expectations</h2>\n<table>\n<tr><th>what</th><th>value</th><th>allowed</th><th></th></tr>\n");
        json_array_foreach(list, i, item)
        {
            const char *what = json_string_value(json_object_get(item, "what"));
            const char *bound = json_string_value(json_object_get(item, "bound"));
            const json_t *value = json_object_get(item, "value");
            bool passed = json_is_true(json_object_get(item, "passed"));
            text_add(page, "<tr><td>");
            report_html_text(page, what ? what : "");
            if (json_is_number(value)) text_add(page, "</td><td>%.6g</td><td>", json_number_value(value));
            else text_add(page, "</td><td>not finite</td><td>");
            report_html_text(page, bound ? bound : "");
            text_add(page, "</td><td class=\"%s\">%s</td></tr>\n", passed ? "pass" : "fail", passed ? "pass" : "FAIL");
        }
        text_add(page, "</table>\n");
    }
    json_decref(root);
}

void report_facts_case(struct text *page, const char *directory)
{
    FILE *file = facts_open(directory, "case.yaml");
    if (!file) return;
    text_add(page, "<h2>Case</h2>\n<details><summary>The resolved case file</summary>\n<pre>");
    char line[1024];
    while (fgets(line, sizeof line, file)) report_html_text(page, line);
    text_add(page, "</pre></details>\n");
    fclose(file);
}
