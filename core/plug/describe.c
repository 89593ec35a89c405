/* describe.c - see describe.h. Plain aligned text; columns are as wide as their longest entry. */
#include "plug/describe.h"

#include "base/mem.h"
#include "base/status.h"
#include "bulla/field.h"
#include "plug/instance.h"
#include "plug/registry.h"
#include "plug/vet.h"

#include <inttypes.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { DESCRIBE_COLUMNS = 5 };

/* The first sentence of a text. */
static int describe_sentence(const char *doc)
{
    const char *end = strstr(doc, ". ");
    return (int)(end ? (size_t)(end - doc) + 1 : strlen(doc));
}

void describe_all(struct text *text)
{
    const char *kind = "";
    size_t width = 0;
    for (size_t i = 0; i < registry_count(); i++) {
        size_t length = strlen(registry_at(i)->module->name);
        width = length > width ? length : width;
    }
    for (size_t i = 0; i < registry_count(); i++) {
        const struct bulla_module *module = registry_at(i)->module;
        if (strcmp(kind, module->kind) != 0) text_add(text, "%s%s\n", i ? "\n" : "", module->kind);
        kind = module->kind;
        text_add(text, "  %-*s  %-5s  %.*s\n", (int)width, module->name, module->version,
                 describe_sentence(module->doc), module->doc);
    }
    if (registry_count() == 0) text_add(text, "no modules found; see BULLA_MODULE_PATH\n");
}

/* 1000 reads better than 1e+03: six digits where they give the number back, else as many as it takes. */
static void describe_number(double value, struct text *cell)
{
    char digits[40];
    snprintf(digits, sizeof digits, "%g", value);
    if (strtod(digits, NULL) == value) text_add(cell, "%s", digits);
    else text_double(cell, value);
}

/* The default of a row, as a case would write it. */
static void describe_fallback(const struct bulla_param *row, struct text *cell)
{
    if (row->type == BULLA_NUMBER) {
        if (isnan(row->fallback)) text_add(cell, "required");
        else describe_number(row->fallback, cell);
    } else if (row->type == BULLA_CHOICE) {
        text_add_n(cell, row->choices, strcspn(row->choices, "|"));
    } else {
        text_add(cell, row->choices ? "none" : "required");
    }
}

static void describe_range(const struct bulla_param *row, struct text *cell)
{
    if (row->type == BULLA_NUMBER) {
        describe_number(row->min, cell);
        text_add(cell, " to ");
        describe_number(row->max, cell);
    } else {
        text_add(cell, "%s", row->type == BULLA_CHOICE ? row->choices : row->type == BULLA_FILE ? "file" : "text");
    }
}

static void describe_cells(const struct bulla_param *row, struct text cells[DESCRIBE_COLUMNS])
{
    text_add(&cells[0], "%s", row->name);
    text_add(&cells[1], "%s", row->type == BULLA_NUMBER ? row->unit : "-");
    describe_fallback(row, &cells[2]);
    describe_range(row, &cells[3]);
    text_add(&cells[4], "%s", row->doc);
}

static void describe_params(const struct bulla_module *module, struct text *text)
{
    static const char *const heads[DESCRIBE_COLUMNS] = {"parameter", "unit", "default", "range", "meaning"};
    unsigned count = instance_param_count(module) + 1;
    struct text(*rows)[DESCRIBE_COLUMNS] = mem_new(count, sizeof *rows);
    size_t width[DESCRIBE_COLUMNS] = {0};
    for (unsigned column = 0; column < DESCRIBE_COLUMNS; column++) text_add(&rows[0][column], "%s", heads[column]);
    for (unsigned i = 1; i < count; i++) describe_cells(&module->params[i - 1], rows[i]);
    for (unsigned i = 0; i < count; i++)
        for (unsigned column = 0; column < DESCRIBE_COLUMNS; column++)
            if (rows[i][column].length > width[column]) width[column] = rows[i][column].length;
    for (unsigned i = 0; i < count; i++) {
        for (unsigned column = 0; column + 1 < DESCRIBE_COLUMNS; column++)
            text_add(text, "  %-*s", (int)width[column], rows[i][column].at);
        text_add(text, "  %s\n", rows[i][DESCRIBE_COLUMNS - 1].at);
        for (unsigned column = 0; column < DESCRIBE_COLUMNS; column++) text_done(&rows[i][column]);
    }
    mem_free(rows);
}

static void describe_presets(const struct bulla_module *module, struct text *text)
{
    text_add(text, "\n  presets\n");
    size_t width = 0;
    for (const struct bulla_preset *preset = module->presets; preset->name; preset++)
        width = strlen(preset->name) > width ? strlen(preset->name) : width;
    for (const struct bulla_preset *preset = module->presets; preset->name; preset++) {
        text_add(text, "  %-*s  %s:", (int)width, preset->name, preset->doc);
        for (unsigned i = 0; module->params[i].name; i++) {
            if (module->params[i].type != BULLA_NUMBER) continue;
            text_add(text, "%s %s ", i ? "," : "", module->params[i].name);
            describe_number(preset->values[i], text);
        }
        text_add(text, "\n");
    }
}

static void describe_use(const struct bulla_module *module, struct text *text)
{
    struct text keys = {0};
    bool named = module->presets && module->presets->name;
    if (named) text_add(&keys, ", preset: %s", module->presets->name);
    else text_add(&keys, ", ...");
    text_add(text, "\n  in a case\n  ");
    vet_use(module, keys.at, text);
    text_add(text, "\n");
    text_done(&keys);
}

/* What a module of fields makes of the NAME that a case gives them. */
static void describe_outputs(const struct bulla_module *module, struct text *text)
{
    const struct bulla_field *law = module->table;
    text_add(text, "\n  fields\n");
    for (const struct bulla_field_output *output = law->outputs; output->unit; output++)
        text_add(text, "  NAME%s%s  %s  %s\n", *output->suffix ? "_" : "", output->suffix, output->unit, output->doc);
}

static void describe_entry(const struct registry_entry *entry, struct text *text)
{
    const struct bulla_module *module = entry->module;
    text_add(text, "%s %s %s\n  %s\n\n", module->kind, module->name, module->version, module->doc);
    text_add(text, "  source  %s\n  file    %s\n  xxh64   %016" PRIx64 "\n\n", module->cite, entry->path, entry->hash);
    if (instance_param_count(module)) describe_params(module, text);
    else text_add(text, "  no parameters\n");
    if (module->presets && module->presets->name) describe_presets(module, text);
    if (strcmp(module->kind, "field") == 0) describe_outputs(module, text);
    describe_use(module, text);
}

static bool describe_matches(const struct bulla_module *module, const char *name)
{
    size_t length = strlen(module->kind);
    if (strncmp(name, module->kind, length) == 0 && name[length] == '/') name += length + 1;
    return strcmp(module->name, name) == 0;
}

static int describe_unknown(const char *name)
{
    const char **names = mem_new(registry_count() + 1, sizeof *names);
    for (size_t i = 0; i < registry_count(); i++) names[i] = registry_at(i)->module->name;
    const char *nearest = text_nearest(name, names);
    mem_free(names);
    if (nearest) return status_fail(STATUS_CASE, "no module is called '%s'; did you mean '%s'?", name, nearest);
    return status_fail(STATUS_CASE, "no module is called '%s'; `bulla modules` lists them", name);
}

int describe_one(const char *name, struct text *text)
{
    bool found = false;
    for (size_t i = 0; i < registry_count(); i++) {
        if (!describe_matches(registry_at(i)->module, name)) continue;
        if (found) text_add(text, "\n");
        describe_entry(registry_at(i), text);
        found = true;
    }
    return found ? STATUS_OK : describe_unknown(name);
}
