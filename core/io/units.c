/* units.c - see units.h. Sums are over whole volumes in three dimensions and where the metric closes them; else per
 * length of what is not there. */
#include "io/units.h"

#include "base/status.h"
#include "derive/derive.h"

#include <string.h>

/* A field and its integral over one, two or three lengths. */
static const char *const units_integrals[][4] = {
    {"1", "m", "m2", "m3"},         {"kg/m3", "kg/m2", "kg/m", "kg"},         {"Pa", "Pa m", "Pa m2", "Pa m3"},
    {"J/m3", "J/m2", "J/m", "J"},   {"m/s", "m2/s", "m3/s", "m4/s"},          {"K", "K m", "K m2", "K m3"},
    {"1/s", "m/s", "m2/s", "m3/s"}, {"J/kg", "J m/kg", "J m2/kg", "J m3/kg"},
};
enum { UNITS_INTEGRALS = sizeof units_integrals / sizeof *units_integrals };

static const char *units_integral(const char *of_field, int extent)
{
    for (int i = 0; of_field && i < UNITS_INTEGRALS; i++)
        if (strcmp(units_integrals[i][0], of_field) == 0) return units_integrals[i][1 + extent];
    return "";
}

static const char *units_total(const char *quantity, int extent)
{
    static const char *const momenta[] = {"kg/m/s", "kg/s", "kg m/s"};
    if (strcmp(quantity, "mass") == 0) return units_integral("kg/m3", extent);
    return strcmp(quantity, "energy") == 0 ? units_integral("J/m3", extent) : momenta[extent];
}

const struct scene_column *units_source(const struct scene *scene, const struct scene_column *column)
{
    bool between = column->measure == SCENE_MIN_BETWEEN || column->measure == SCENE_MAX_BETWEEN;
    return between ? &scene->output.columns[column->of] : column;
}

const char *units_of(const struct scene *scene, const struct scene_column *column, const char *of_field)
{
    int plane = scene->domain.dim - 1, extent = scene->domain.geometry == SCENE_CARTESIAN ? plane : 2;
    switch (column->measure) {
    case SCENE_VOLUME: return units_integral("1", extent);
    case SCENE_EVAPORATED:
    case SCENE_MASS: return units_integral("kg/m3", extent);
    case SCENE_CENTROID:
    case SCENE_PENETRATION:
    case SCENE_EQUIVALENT_RADIUS: return "m";
    case SCENE_JET_SPEED: return "m/s";
    case SCENE_MIN:
    case SCENE_MAX:
    case SCENE_MEAN:
    case SCENE_ISOSURFACE_MEAN:
    case SCENE_ISOSURFACE_MIN:
    case SCENE_ISOSURFACE_MAX: return of_field ? of_field : "";
    case SCENE_INTEGRAL: return units_integral(of_field, extent);
    case SCENE_PLANE_INTEGRAL: return units_integral(of_field, plane);
    case SCENE_TOTAL: return units_total(column->field, extent);
    case SCENE_OUTSIDE: return "1";
    case SCENE_FORCE: return units_integral("N/m3", extent);
    case SCENE_POWER: return units_integral("W/m3", extent);
    case SCENE_BODY_DISPLACEMENT: return "m";
    case SCENE_BODY_VELOCITY: return "m/s";
    case SCENE_BODY_ANGLE: return "rad";
    case SCENE_MIN_BETWEEN:
    case SCENE_MAX_BETWEEN:
    case SCENE_VALUE: return "";
    }
    return "";
}

static int units_history(const struct state *state, struct text *text)
{
    static const char *const guard[] = {"fallback", "relaxed", "clipped", "retries"};
    const struct scene *scene = state->scene;
    text_add(text, "history.csv,step,1\nhistory.csv,t,s\nhistory.csv,dt,s\n");
    for (unsigned i = 0; i < scene->output.n_column; i++) {
        const char *name = scene->output.columns[i].name;
        const struct scene_column *column = units_source(scene, &scene->output.columns[i]);
        struct derive field = {.unit = ""};
        bool total = column->measure == SCENE_TOTAL; /* of a conserved quantity, which is no field */
        if (column->field[0] && !total) TRY(derive_find(state->model, column->field, &field));
        text_add(text, "history.csv,%s,%s\n", name, units_of(scene, column, field.unit));
    }
    for (unsigned i = 0; i < sizeof guard / sizeof *guard; i++) text_add(text, "history.csv,guard_%s,1\n", guard[i]);
    return STATUS_OK;
}

static int units_probe(const struct state *state, const struct scene_probe *probe, struct text *text)
{
    for (unsigned i = 0; i < probe->n_field; i++) {
        struct derive field;
        TRY(derive_find(state->model, probe->fields[i], &field));
        for (unsigned q = 0; q < field.components; q++) {
            text_add(text, "probes.csv,%s.%s", probe->name, probe->fields[i]);
            if (field.components > 1) text_add(text, "_%c", "xyz"[q]);
            text_add(text, ",%s\n", field.unit);
        }
    }
    return STATUS_OK;
}

int units_text(const struct state *state, struct text *text)
{
    const struct scene *scene = state->scene;
    text_add(text, "file,column,unit\n");
    TRY(units_history(state, text));
    if (scene->output.n_probe) text_add(text, "probes.csv,t,s\n");
    for (unsigned i = 0; i < scene->output.n_probe; i++) TRY(units_probe(state, &scene->output.probes[i], text));
    return STATUS_OK;
}
