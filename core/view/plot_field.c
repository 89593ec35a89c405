/* plot_field.c - see plot_field.h. */
#include "view/plot_field.h"

#include "base/mem.h"
#include "base/status.h"
#include "base/text.h"
#include "view/picture_text.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

const char *plot_field_axis(const struct snapshot *snapshot, int axis)
{
    static const char *const symbols[3][3] = {
        {PICTURE_ITALIC "x" PICTURE_UPRIGHT, PICTURE_ITALIC "y" PICTURE_UPRIGHT, PICTURE_ITALIC "z" PICTURE_UPRIGHT},
        {PICTURE_ITALIC "r" PICTURE_UPRIGHT, PICTURE_ITALIC "z" PICTURE_UPRIGHT, PICTURE_ITALIC "θ" PICTURE_UPRIGHT},
        {PICTURE_ITALIC "r" PICTURE_UPRIGHT, PICTURE_ITALIC "θ" PICTURE_UPRIGHT, PICTURE_ITALIC "φ" PICTURE_UPRIGHT},
    };
    return symbols[snapshot->beta][axis];
}

/* "velocity" of "velocity_y", and the component; 0 if it is no component name. */
static size_t plot_field_stem(const char *name, int *ret_component)
{
    size_t length = strlen(name);
    if (length < 3 || name[length - 2] != '_' || name[length - 1] < 'x' || name[length - 1] > 'z') return 0;
    *ret_component = name[length - 1] - 'x';
    return length - 2;
}

static const struct snapshot_field *plot_field_lookup(const struct snapshot *snapshot, const char *name,
                                                      int *ret_component)
{
    const struct snapshot_field *exact = read_field(snapshot, name);
    bool plain = snapshot->dim == 1; /* a vector along a line is a number with a sign */
    *ret_component = exact && exact->components > 1 && !plain ? PLOT_FIELD_MAGNITUDE : 0;
    if (exact) return exact;
    size_t stem = plot_field_stem(name, ret_component);
    for (unsigned i = 0; stem && i < snapshot->n_field; i++) {
        const struct snapshot_field *field = &snapshot->fields[i];
        if (strlen(field->name) == stem && strncmp(field->name, name, stem) == 0 && field->components > 1 &&
            *ret_component < (int)field->components)
            return field;
    }
    return NULL;
}

static int plot_field_unknown(const struct snapshot *snapshot, const char *name)
{
    struct text list = {0};
    const char **names = mem_new(snapshot->n_field + 1, sizeof *names);
    for (unsigned i = 0; i < snapshot->n_field; i++) {
        names[i] = snapshot->fields[i].name;
        text_add(&list, "%s%s", i ? ", " : "", names[i]);
        if (snapshot->fields[i].components > 1) text_add(&list, " (_x, _y, _z)");
    }
    const char *near = text_nearest(name, names);
    int code =
        status_fail(STATUS_CASE, "no field '%s' in the snapshots%s%s%s; there are: %s", name,
                    near ? " (did you mean '" : "", near ? near : "", near ? "'?)" : "", list.at ? list.at : "none");
    mem_free(names);
    text_done(&list);
    return code;
}

/* Vector components by what they are: "axial velocity", "x velocity". */
static void plot_field_label_component(const struct snapshot *snapshot, const char *stem, int component,
                                       char *ret_label)
{
    static const char *const axisymmetric[3] = {"radial", "axial", "azimuthal"};
    const char *what = snapshot->beta ? axisymmetric[component] : plot_field_axis(snapshot, component);
    snprintf(ret_label, PLOT_FIELD_LABEL, "%s %s", what, stem);
}

static void plot_field_label(const struct snapshot *snapshot, const struct snapshot_field *field, int component,
                             char *ret_label)
{
    char words[READ_NAME], stem[READ_NAME];
    snprintf(words, sizeof words, "%s", field->name);
    for (char *c = words; *c; c++)
        if (*c == '_') *c = ' ';
    snprintf(ret_label, PLOT_FIELD_LABEL, "%s", words);
    int named;
    size_t length = plot_field_stem(field->name, &named);
    if (field->components > 1 && component != PLOT_FIELD_MAGNITUDE) {
        plot_field_label_component(snapshot, words, component, ret_label);
    } else if (field->components > 1) {
        snprintf(ret_label, PLOT_FIELD_LABEL, "%s magnitude", words);
    } else if (length) {
        snprintf(stem, sizeof stem, "%.*s", (int)length, words);
        plot_field_label_component(snapshot, stem, named, ret_label);
    }
    for (unsigned m = 0; m < snapshot->n_material; m++) { /* "density_air" */
        size_t all = strlen(field->name), tail = strlen(snapshot->materials[m]);
        if (all < tail + 2 || strcmp(field->name + all - tail, snapshot->materials[m]) != 0) continue;
        if (field->name[all - tail - 1] != '_') continue;
        snprintf(stem, sizeof stem, "%.*s", (int)(all - tail - 1), words);
        snprintf(ret_label, PLOT_FIELD_LABEL, "%s of %s", strcmp(stem, "alpha") == 0 ? "volume fraction" : stem,
                 snapshot->materials[m]);
    }
}

static bool plot_field_is_blank(const struct snapshot *snapshot, const char *name)
{
    for (unsigned m = 0; m < snapshot->n_material; m++)
        for (int which = 0; which < 2; which++) {
            char own[READ_NAME];
            snprintf(own, sizeof own, "%s_%.48s", which ? "temperature" : "density", snapshot->materials[m]);
            if (strcmp(name, own) == 0) return true;
        }
    return false;
}

int plot_field_find(const struct snapshot *snapshot, const char *name, struct plot_field *ret_field)
{
    int component;
    const struct snapshot_field *field = plot_field_lookup(snapshot, name, &component);
    if (!field) return plot_field_unknown(snapshot, name);
    ret_field->field = field;
    ret_field->component = component;
    plot_field_label(snapshot, field, component, ret_field->label);
    ret_field->blank = plot_field_is_blank(snapshot, field->name);
    ret_field->body = strcmp(field->name, "body") ? read_field(snapshot, "body") : NULL;
    return STATUS_OK;
}

double plot_field_value(const struct plot_field *field, size_t cell)
{
    const double *at = &field->field->data[cell * field->field->components];
    if (field->blank && *at == 0.0) return (double)NAN;
    if (field->body && field->body->data[cell] > 0.5) return (double)NAN;
    if (field->component != PLOT_FIELD_MAGNITUDE) return at[field->component];
    double square = 0.0;
    for (unsigned i = 0; i < field->field->components; i++) square += at[i] * at[i];
    return sqrt(square);
}
