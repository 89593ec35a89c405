/* scene_pulse.c - a measured pulse: a table of times and gauge pressures, in the units it was written in.
 *
 * The units come from the case (`units:`), else from the header of the file: t[us], p (MPa), time_us. What says nothing
 * is in SI. */
#include "case/scene_draft.h"

#include "base/mem.h"
#include "base/status.h"
#include "case/series.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

static const struct key scene_pulse_units_rows[] = {
    {.name = "t", .type = KEYS_TEXT, .doc = "Unit of the times."},
    {.name = "p", .type = KEYS_TEXT, .doc = "Unit of the pressures."},
    {0},
};

const struct keys_section scene_pulse_units = {.name = "pulse-units",
                                               .doc = "Units of the columns of a measured pulse.",
                                               .keys = scene_pulse_units_rows,
                                               .positional = 2};

bool scene_pulse_owns(const char *key)
{
    for (const struct keys_section *const *pulse = scene_boundary_pulse_cases; *pulse; pulse++)
        for (const struct key *row = (*pulse)->keys; row->name; row++)
            if (strcmp(row->name, key) == 0) return true;
    return false;
}

/* One of the two columns: its number in the file and what it must be. */
struct scene_pulse_column {
    const struct keys_value *name, *unit; /* entries of `columns:` and `units:` */
    const char *wanted;                   /* SI unit */
    bool free;                            /* any unit will do: the amplitude is given */
    unsigned at;
    struct unit is;
};

static bool scene_pulse_fits(const char *text, const char *wanted, struct unit *ret_unit)
{
    struct unit unit, si;
    char bad[32];
    if (!unit_parse(text, &unit, bad) || !unit_parse(wanted, &si, bad) || !unit_same(&unit, &si)) return false;
    *ret_unit = unit;
    return true;
}

/* t_us, time_us, p_MPa: only what ends in a unit of the right kind is one. */
static void scene_pulse_suffix(const char *name, struct scene_pulse_column *column)
{
    const char *end = name ? strrchr(name, '_') : NULL;
    if (end && end > name && end[1]) scene_pulse_fits(end + 1, column->wanted, &column->is);
}

static void scene_pulse_refuse(struct draft *draft, const struct keys_value *value, const char *text,
                               const struct scene_pulse_column *column)
{
    struct unit wanted;
    char bad[32], words[80];
    unit_parse(column->wanted, &wanted, bad);
    keys_error(&draft->keys, value, "'%s' is no unit of %s", text, unit_kind(&wanted, words, sizeof words));
    diag_help(draft->keys.diag, "units that would do: %s", unit_examples(&wanted));
}

/* False after a recorded error. */
static bool scene_pulse_unit(struct draft *draft, const struct series *series, const struct keys_value *file,
                             struct scene_pulse_column *column)
{
    const char *header = series->units ? series->units[column->at] : NULL;
    column->is = (struct unit){.factor = 1};
    if (column->unit->given) {
        if (scene_pulse_fits(column->unit->text, column->wanted, &column->is)) return true;
        scene_pulse_refuse(draft, column->unit, column->unit->text, column);
        return false;
    }
    if (!header) {
        scene_pulse_suffix(series->names ? series->names[column->at] : NULL, column);
        return true;
    }
    if (scene_pulse_fits(header, column->wanted, &column->is) || column->free) return true;
    scene_pulse_refuse(draft, file, header, column);
    diag_help(draft->keys.diag,
              "it stands in the header of '%s', at column '%s'; 'units: {t: us, p: MPa}' wins over it", series->path,
              series->names[column->at]);
    return false;
}

/* A column in SI: a division by a power of ten rounds as the number with its unit would. */
static double *scene_pulse_values(const struct series *series, const struct scene_pulse_column *column)
{
    const double *from = series->columns[column->at], ten = pow(10.0, abs(column->is.decimal));
    double *values = mem_new(series->n_row, sizeof *values);
    for (size_t i = 0; i < series->n_row; i++) {
        double shifted = column->is.decimal < 0 ? from[i] / ten : from[i] * ten;
        values[i] = column->is.factor == 1.0 ? shifted : shifted * column->is.factor;
    }
    return values;
}

/* `scale:` multiplies, `amplitude:` says what the largest magnitude becomes. */
static void scene_pulse_scale(struct draft *draft, struct scene_boundary *boundary, const struct keys_map *map)
{
    const struct keys_value *amplitude = keys_at(map, "amplitude"), *scale = keys_at(map, "scale");
    double factor = scale->given ? scale->number : 1.0, most = 0.0;
    for (unsigned i = 0; i < boundary->n_series; i++) most = fmax(most, fabs(boundary->series_p[i]));
    if (amplitude->given && scale->given) keys_error(&draft->keys, scale, "either 'amplitude' or 'scale', not both");
    else if (amplitude->given && most == 0.0)
        keys_error(&draft->keys, amplitude, "a pulse of zeros cannot be given an amplitude");
    if (amplitude->given && most > 0.0) factor = amplitude->number / most;
    if (factor == 1.0) return;
    for (unsigned i = 0; i < boundary->n_series; i++) boundary->series_p[i] *= factor;
}

static void scene_pulse_take(struct draft *draft, struct scene_boundary *boundary, const struct keys_map *map,
                             const struct series *series, struct scene_pulse_column columns[2])
{
    const struct keys_value *file = keys_at(map, "file");
    bool good = true;
    for (int i = 0; i < 2; i++)
        if (series_find(series, columns[i].name->text, &columns[i].at)) {
            keys_error(&draft->keys, file, "%s", status_text());
            return;
        }
    if (series_ascending(series, columns[0].name->text)) {
        keys_error(&draft->keys, file, "%s", status_text());
        return;
    }
    for (int i = 0; i < 2; i++) good = scene_pulse_unit(draft, series, file, &columns[i]) && good;
    if (!good) return;
    boundary->n_series = (unsigned)series->n_row;
    boundary->series_t = scene_pulse_values(series, &columns[0]);
    boundary->series_p = scene_pulse_values(series, &columns[1]);
    scene_pulse_scale(draft, boundary, map);
}

void scene_pulse(struct draft *draft, struct scene_boundary *boundary, const struct keys_map *map)
{
    const struct keys_value *file = keys_at(map, "file"), *columns = keys_at(map, "columns");
    const struct keys_map *units = keys_at(map, "units")->map;
    if (!file->given || !columns->given) return;
    if (columns->count != 2) {
        keys_error(&draft->keys, columns, "two columns are needed, time and pressure, not %u", columns->count);
        return;
    }
    struct scene_pulse_column pair[2] = {
        {.name = &columns->list[0], .unit = keys_at(units, "t"), .wanted = "s"},
        {.name = &columns->list[1],
         .unit = keys_at(units, "p"),
         .wanted = "Pa",
         .free = keys_at(map, "amplitude")->given},
    };
    struct series series = {0};
    if (series_read(scene_file(draft, file), &series)) keys_error(&draft->keys, file, "%s", status_text());
    else scene_pulse_take(draft, boundary, map, &series, pair);
    series_done(&series);
}
