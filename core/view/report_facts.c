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

static json_t *report_facts_json(const char *directory, const char *name)
{
    char *path = mem_print("%s/%s", directory, name);
    json_t *root = json_load_file(path, 0, NULL);
    mem_free(path);
    return root;
}

static FILE *report_facts_open(const char *directory, const char *name)
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
    const char *why;                /* what it counts, in one line; "" where the label says it */
};

/* What the guard does, in the order of its means (docs/numerics.md 8). */
static const char *const report_facts_guards[][2] = {
    {"fallback", "cells whose step was repeated with first-order fluxes, as its result was not admissible; every "
                 "repetition counts"},
    {"relaxed",
     "mixed cells whose materials were brought to a common pressure, as their state was not admissible; each "
     "time counts"},
    {"clipped",
     "cells whose compression term was bounded, as it would have taken more of a material than there is; each "
     "time counts"},
    {"retries", "steps that were repeated with half of their length"},
};

static void report_facts_value(const json_t *value, const char *unit, char *ret_words, size_t size)
{
    double number = json_number_value(value);
    char shown[PICTURE_SCALE_LABEL];
    if (json_is_string(value)) snprintf(ret_words, size, "%s", json_string_value(value));
    else if (unit && strcmp(unit, "B") == 0) snprintf(ret_words, size, "%.1f MB", 1e-6 * number);
    else if (json_is_integer(value)) snprintf(ret_words, size, "%lld", (long long)json_integer_value(value));
    else if (unit && strcmp(unit, "wall") == 0) snprintf(ret_words, size, "%.1f s", number);
    else if (unit && strcmp(unit, "ns") == 0) snprintf(ret_words, size, "%.4g ns", number);
    else if (unit && *unit) {
        picture_scale_quantity(number, number, unit, shown);
        snprintf(ret_words, size, "%s", shown);
    } else snprintf(ret_words, size, "%.6g", number);
}

static void report_facts_add(struct text *page, const char *label, const char *words, const char *why)
{
    text_add(page, "<div><span>");
    report_html_text(page, label);
    if (*why) text_add(page, "<small>%s</small>", why);
    text_add(page, "</span><b>");
    report_html_text(page, words);
    text_add(page, "</b></div>\n");
}

/* The largest relative change of a conserved total, as the run noted it. */
static void report_facts_drift(struct text *page, json_t *conservation)
{
    const char *name;
    const char *why = "of the total, relative to the start; what went through boundaries is part of it";
    json_t *entry;
    json_object_foreach(conservation, name, entry)
    {
        const json_t *change = json_object_get(entry, "relative_change");
        char label[160], words[64];
        if (!json_is_number(change)) continue;
        snprintf(label, sizeof label, "change of %.100s", name);
        snprintf(words, sizeof words, "%.2e", json_number_value(change));
        report_facts_add(page, label, words, why);
        why = "";
    }
}

static void report_facts_guard(struct text *page, json_t *guard)
{
    const char *name;
    json_t *count;
    json_object_foreach(guard, name, count)
    {
        char label[160], words[64];
        const char *why = "";
        for (size_t i = 0; i < sizeof report_facts_guards / sizeof *report_facts_guards; i++)
            if (strcmp(report_facts_guards[i][0], name) == 0) why = report_facts_guards[i][1];
        snprintf(label, sizeof label, "guard: %.100s", name);
        snprintf(words, sizeof words, "%lld", (long long)json_integer_value(count));
        report_facts_add(page, label, words, why);
    }
}

/* What iterated pressures took, and where laws were left. */
static void report_facts_laws(struct text *page, const json_t *closures, json_t *outside)
{
    char label[160], words[128];
    const char *name;
    json_t *counts;
    if (json_integer_value(json_object_get(closures, "solved")) > 0) {
        snprintf(words, sizeof words, "%lld, %.3g steps each, at most %lld",
                 (long long)json_integer_value(json_object_get(closures, "solved")),
                 json_number_value(json_object_get(closures, "mean_steps")),
                 (long long)json_integer_value(json_object_get(closures, "most_steps")));
        report_facts_add(page, "pressures iterated", words,
                         "mixture pressures found by Newton's method, cells times stages");
    }
    json_object_foreach(outside, name, counts)
    {
        snprintf(label, sizeof label, "law of %.100s left", name);
        snprintf(words, sizeof words, "%lld cell-steps, %lld cells at most",
                 (long long)json_integer_value(json_object_get(counts, "cell_steps")),
                 (long long)json_integer_value(json_object_get(counts, "most_cells")));
        report_facts_add(page, label, words, "beyond its range a continuation stands in for it: cells times steps");
    }
}

/* Cells of each level at the end and at most, and what it cost to move them; nothing for a mesh of one level. */
static void report_facts_levels(struct text *page, const json_t *root)
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
        report_facts_add(page, label, words,
                         "cells at the end; leaves have no finer ones above them; most during the run");
    }
    char words[128];
    snprintf(words, sizeof words, "%lld, %.2g %% of the CPU time",
             (long long)json_integer_value(json_object_get(refinement, "regrids")),
             100.0 * json_number_value(json_object_get(refinement, "regrid_share")));
    report_facts_add(page, "regrids", words, "how often levels of the mesh were laid out anew, and what that cost");
}

void report_facts_run(struct text *page, const char *directory)
{
    static const struct facts_row rows[] = {
        {"exit_reason", "ended", NULL, "why the run ended"},
        {"time", "simulated time", "s", ""},
        {"steps", "steps", "", "time steps of the coarsest level"},
        {"leaves", "cells", "", "at the end, those under finer ones left out"},
        {"ranks", "ranks", "", "processes side by side"},
        {"wall_s", "wall time", "wall", "by the clock"},
        {"cpu_s", "CPU time", "wall", "of all ranks together"},
        {"cpu_ns_per_cell_stage", "CPU time per cell and stage", "ns", "one stage of the time integrator in one cell"},
        {"peak_memory_bytes", "peak memory", "B", "of all ranks together"},
        {"started", "started", NULL, ""},
        {"version", "version", NULL, ""},
        {"commit", "commit", NULL, ""},
    };
    json_t *root = report_facts_json(directory, "provenance.json");
    if (!root) return;
    text_add(page, "<h2>Run</h2>\n<div class=\"facts\">\n");
    for (size_t i = 0; i < sizeof rows / sizeof *rows; i++) {
        const json_t *value = json_object_get(root, rows[i].key);
        char words[256];
        if (!json_is_string(value) && !json_is_number(value)) continue;
        report_facts_value(value, rows[i].unit, words, sizeof words);
        report_facts_add(page, rows[i].label, words, rows[i].why);
    }
    report_facts_levels(page, root);
    report_facts_drift(page, json_object_get(root, "conservation"));
    if (json_object_get(root, "sources"))
        report_facts_add(page, "sources, part of these changes", json_string_value(json_object_get(root, "sources")),
                         "what the case feeds in or takes out");
    report_facts_guard(page, json_object_get(root, "guard"));
    report_facts_laws(page, json_object_get(root, "closures"), json_object_get(root, "outside"));
    text_add(page, "</div>\n");
    json_decref(root);
}

/* A row of the table: the value, or why there is none. */
static void report_facts_expectation(struct text *page, const json_t *item)
{
    const char *what = json_string_value(json_object_get(item, "what"));
    const char *bound = json_string_value(json_object_get(item, "bound"));
    const char *fault = json_string_value(json_object_get(item, "fault"));
    const json_t *value = json_object_get(item, "value");
    bool passed = json_is_true(json_object_get(item, "passed"));
    text_add(page, "<tr><td>");
    report_html_text(page, what ? what : "");
    if (json_is_number(value)) text_add(page, "</td><td>%.6g</td><td>", json_number_value(value));
    else {
        text_add(page, "</td><td>");
        report_html_text(page, fault ? fault : "not finite");
        text_add(page, "</td><td>");
    }
    report_html_text(page, bound ? bound : "");
    text_add(page, "</td><td class=\"%s\">%s</td></tr>\n", passed ? "pass" : "fail", passed ? "pass" : "FAIL");
}

void report_facts_expect(struct text *page, const char *directory)
{
    json_t *root = report_facts_json(directory, "expect.json"), *item;
    const json_t *list = json_object_get(root, "expectations");
    size_t i;
    if (json_array_size(list)) {
        text_add(page, "<h2>Expectations</h2>\n<p class=\"note\">Values are in SI units; norms are relative where the "
                       "case gives a "
                       "scale.</p>\n<div class=\"wide\"><table>\n<tr><th>what</th><th>value [SI]</th><th>allowed "
                       "[SI]</th><th></th>"
                       "</tr>\n");
        json_array_foreach(list, i, item) report_facts_expectation(page, item);
        text_add(page, "</table></div>\n");
    }
    json_decref(root);
}

void report_facts_case(struct text *page, const char *directory)
{
    FILE *file = report_facts_open(directory, "case.yaml");
    if (!file) return;
    text_add(page, "<h2>Case</h2>\n<details><summary>The resolved case file</summary>\n<pre>");
    char line[1024];
    while (fgets(line, sizeof line, file)) report_html_text(page, line);
    text_add(page, "</pre></details>\n");
    fclose(file);
}
