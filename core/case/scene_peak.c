/* scene_peak.c - peaks: the largest and the least value of a field over the run in every cell, and when they were.
 *
 * They are fields like any other, `max_pressure`, `min_pressure`, `when_max_pressure`, `when_min_pressure`: to name one
 * anywhere is to have it kept. */
#include "case/scene_draft.h"

#include "base/mem.h"

#include <math.h>
#include <string.h>

static const struct key scene_peak_rows[] = {
    {.name = "from", .type = KEYS_NUMBER, .unit = "s", .min = 0, .max = KEYS_MOST, .doc = "Only from this time on."},
    {.name = "until", .type = KEYS_NUMBER, .unit = "s", .min = 0, .max = KEYS_MOST, .doc = "Only until this time."},
    {0},
};

const struct keys_section scene_peak_keys = {
    .name = "peaks",
    .doc = "The time that counts for fields like `max_pressure` and `when_min_pressure`; the whole run if not given.",
    .keys = scene_peak_rows};

enum { SCENE_PEAK_KINDS = 4, SCENE_PEAK_WHEN = 2 }; /* the kinds from the second number on are times */

static const char *const scene_peak_prefixes[SCENE_PEAK_KINDS] = {"max_", "min_", "when_max_", "when_min_"};

static int *scene_peak_row(struct scene_peak *peak, int kind)
{
    int *rows[SCENE_PEAK_KINDS] = {&peak->most, &peak->least, &peak->when_most, &peak->when_least};
    return rows[kind];
}

/* The peak of a field, made if it is new. */
static struct scene_peak *scene_peak_of(struct scene_output *output, const char *field)
{
    for (unsigned i = 0; i < output->n_peak; i++)
        if (strcmp(output->peaks[i].field, field) == 0) return &output->peaks[i];
    output->peaks = mem_grow(output->peaks, output->n_peak, output->n_peak + 1, sizeof *output->peaks);
    struct scene_peak *peak = &output->peaks[output->n_peak++];
    *peak = (struct scene_peak){.most = -1, .least = -1, .when_most = -1, .when_least = -1};
    snprintf(peak->field, SCENE_NAME, "%s", field);
    return peak;
}

static void scene_peak_keep(struct scene_output *output, const char *field, int kind)
{
    int *row = scene_peak_row(scene_peak_of(output, field), kind);
    if (*row < 0) *row = (int)output->n_kept++;
}

bool scene_peak_is(const char *name)
{
    for (int kind = 0; kind < SCENE_PEAK_KINDS; kind++)
        if (strncmp(name, scene_peak_prefixes[kind], strlen(scene_peak_prefixes[kind])) == 0) return true;
    return false;
}

/* Not of what is a peak itself. */
static bool scene_peak_is_field(const char *name, const char *const *names)
{
    if (scene_peak_is(name)) return false;
    for (; *names; names++)
        if (strcmp(*names, name) == 0) return strcmp(name, "rank") != 0;
    return false;
}

bool scene_peak_find(struct draft *draft, const char *name, const char *const *names)
{
    struct scene_output *output = &draft->scene->output;
    for (int kind = 0; kind < SCENE_PEAK_KINDS; kind++) {
        size_t length = strlen(scene_peak_prefixes[kind]);
        if (strncmp(name, scene_peak_prefixes[kind], length) != 0) continue;
        if (!scene_peak_is_field(name + length, names)) continue;
        scene_peak_keep(output, name + length, kind);
        if (kind >= SCENE_PEAK_WHEN) scene_peak_keep(output, name + length, kind - SCENE_PEAK_WHEN);
        return true;
    }
    return false;
}

unsigned scene_peak_list(struct draft *draft, const struct scene_field *fields, struct scene_field *list)
{
    struct scene_output *output = &draft->scene->output;
    unsigned count = 0;
    for (unsigned i = 0; i < output->n_peak; i++) {
        const struct scene_field *of = fields;
        while (of->name && strcmp(of->name, output->peaks[i].field) != 0) of++;
        for (int kind = 0; of->name && kind < SCENE_PEAK_KINDS; kind++) {
            if (*scene_peak_row(&output->peaks[i], kind) < 0) continue;
            bool when = kind >= SCENE_PEAK_WHEN;
            unsigned is = (of->is & ~(unsigned)SCENE_FIELD_VECTOR) | SCENE_FIELD_VANISHING;
            list[count++] =
                (struct scene_field){tree_print(draft->keys.forest, "%s%s", scene_peak_prefixes[kind], of->name),
                                     when ? "s" : of->unit, when ? SCENE_FIELD_VANISHING : is};
        }
    }
    return count;
}

void scene_peak(struct draft *draft)
{
    const struct keys_value *peaks = keys_at(keys_at(draft->root, "output")->map, "peaks");
    const struct keys_value *from = keys_at(peaks->map, "from"), *until = keys_at(peaks->map, "until");
    struct scene *scene = draft->scene;
    scene->output.peaks_from = from->number;
    scene->output.peaks_until = until->given ? until->number : INFINITY;
    if (from->given && until->given && from->number > until->number)
        keys_error(&draft->keys, until, "%g s is before 'from', %g s", until->number, from->number);
    if (!peaks->map || scene->output.n_peak) return;
    keys_error(&draft->keys, peaks, "no peaks are kept: no list of fields names one");
    diag_help(draft->keys.diag, "for example 'output.snapshots.fields: [pressure, max_pressure, when_min_pressure]'");
}
