/* plot_interface.c - see plot_interface.h. Fractions fill the volume: of all but one, the missing one is the rest. */
#include "view/plot_interface.h"

#include "base/mem.h"
#include "base/status.h"
#include "base/text.h"

#include <stdbool.h>
#include <stdio.h>
#include <string.h>

static const struct snapshot_field *plot_interface_alpha(const struct snapshot *snapshot, unsigned material)
{
    char name[READ_NAME + 8];
    snprintf(name, sizeof name, "alpha_%s", snapshot->materials[material]);
    return read_field(snapshot, name);
}

/* How many volume fractions the snapshot lacks. */
static unsigned plot_interface_absent(const struct snapshot *snapshot)
{
    unsigned absent = 0;
    for (unsigned m = 0; m < snapshot->n_material; m++) absent += !plot_interface_alpha(snapshot, m);
    return absent;
}

/* The volume fraction of a material in the cells of the view, read or the rest of the others, in new memory; NULL if it
 * is not known. */
static double *plot_interface_values(const struct plot_view *view, unsigned material)
{
    const struct snapshot *snapshot = view->snapshot;
    const struct snapshot_field *own = plot_interface_alpha(snapshot, material);
    if (!own && plot_interface_absent(snapshot) > 1) return NULL;
    double *values = mem_new(view->n, sizeof *values);
    for (size_t c = 0; c < view->n; c++) values[c] = own ? own->data[view->source[c]] : 1.0;
    for (unsigned m = 0; !own && m < snapshot->n_material; m++) {
        const struct snapshot_field *alpha = plot_interface_alpha(snapshot, m);
        for (size_t c = 0; alpha && c < view->n; c++) values[c] -= alpha->data[view->source[c]];
    }
    return values;
}

/* The material that fills most of the view, if two or more are known; else n_material. */
static unsigned plot_interface_background(const struct plot_view *view)
{
    const struct snapshot *snapshot = view->snapshot;
    unsigned background = snapshot->n_material, known = 0;
    double most = 0.0;
    for (unsigned m = 0; m < snapshot->n_material; m++) {
        double area = 0.0, *alpha = plot_interface_values(view, m);
        if (!alpha) continue;
        known++;
        for (size_t c = 0; c < view->n; c++) {
            const struct raster_cell *cell = &view->cells[c];
            double height = view->n_axis > 1 ? cell->at[1][1] - cell->at[1][0] : 1.0;
            area += alpha[c] * (cell->at[0][1] - cell->at[0][0]) * height;
        }
        mem_free(alpha);
        if (area > most) {
            most = area;
            background = m;
        }
    }
    return known > 1 ? background : snapshot->n_material;
}

static int plot_interface_unknown(const struct snapshot *snapshot, const char *name)
{
    struct text list = {0};
    const char **names = mem_new(snapshot->n_material + 1, sizeof *names);
    for (unsigned m = 0; m < snapshot->n_material; m++) {
        names[m] = snapshot->materials[m];
        text_add(&list, "%s%s", m ? ", " : "", names[m]);
    }
    const char *near = text_nearest(name, names);
    int code =
        status_fail(STATUS_CASE, "--contour %s: no such material%s%s%s; there are: %s", name,
                    near ? " (did you mean '" : "", near ? near : "", near ? "'?)" : "", list.at ? list.at : "none");
    mem_free(names);
    text_done(&list);
    return code;
}

/* Marks the materials of a list "air,tissue". */
static int plot_interface_chosen(const struct snapshot *snapshot, const char *contours, bool *wanted)
{
    while (*contours) {
        char name[READ_NAME];
        size_t length = strcspn(contours, ",");
        unsigned m = 0;
        snprintf(name, sizeof name, "%.*s", (int)length, contours);
        while (m < snapshot->n_material && strcmp(snapshot->materials[m], name) != 0) m++;
        if (m == snapshot->n_material) return plot_interface_unknown(snapshot, name);
        if (!plot_interface_alpha(snapshot, m) && plot_interface_absent(snapshot) > 1)
            return status_fail(
                STATUS_CASE,
                "--contour %s: the snapshots have no alpha_%s, and it is not the only one they lack; add "
                "it to the fields of output: snapshots:",
                name, name);
        wanted[m] = true;
        contours += length + (contours[length] == ',');
    }
    return STATUS_OK;
}

static void plot_interface_add(const struct plot_view *view, unsigned material, struct plot_interfaces *interfaces)
{
    double *values = interfaces->n < PICTURE_LINES ? plot_interface_values(view, material) : NULL;
    if (!values) return;
    struct contour *contour = &interfaces->contours[interfaces->n];
    contour_find(view->n, view->cells, values, 0.5, contour);
    interfaces->names[interfaces->n] = view->snapshot->materials[material];
    if (contour->n_line) interfaces->n++;
    else contour_done(contour);
    mem_free(values);
}

/* Which materials' interfaces are asked for: wanted[n_material]. */
static int plot_interface_wanted(const struct plot_view *view, const char *contours, bool *wanted)
{
    const struct snapshot *snapshot = view->snapshot;
    if (contours) return strcmp(contours, "none") == 0 ? STATUS_OK : plot_interface_chosen(snapshot, contours, wanted);
    unsigned background = plot_interface_background(view);
    for (unsigned m = 0; m < snapshot->n_material; m++) wanted[m] = m != background;
    return STATUS_OK;
}

int plot_interface_find(const struct plot_view *view, const char *contours, struct plot_interfaces *ret_interfaces)
{
    unsigned count = view->snapshot->n_material;
    bool *wanted = mem_new(count, sizeof *wanted);
    *ret_interfaces = (struct plot_interfaces){0};
    int code = plot_interface_wanted(view, contours, wanted);
    for (unsigned m = 0; !code && m < count; m++)
        if (wanted[m]) plot_interface_add(view, m, ret_interfaces);
    mem_free(wanted);
    return code;
}

int plot_interface_places(const struct plot_view *view, const char *contours, double **ret_places, size_t *ret_n)
{
    unsigned count = view->snapshot->n_material;
    bool *wanted = mem_new(count, sizeof *wanted);
    double *places = mem_new(count * view->n, sizeof *places);
    size_t n = 0;
    int code = plot_interface_wanted(view, contours, wanted);
    for (unsigned m = 0; !code && m < count; m++) {
        double *alpha = wanted[m] ? plot_interface_values(view, m) : NULL;
        for (size_t c = 1; alpha && c < view->n; c++) {
            double a = alpha[c - 1] - 0.5, b = alpha[c] - 0.5;
            const double *left = view->cells[c - 1].at[0], *right = view->cells[c].at[0];
            if ((a >= 0.0) == (b >= 0.0)) continue;
            places[n++] = (0.5 * (left[0] + left[1]) * b - 0.5 * (right[0] + right[1]) * a) / (b - a);
        }
        mem_free(alpha);
    }
    mem_free(wanted);
    *ret_places = places;
    *ret_n = n;
    return code;
}

void plot_interface_done(struct plot_interfaces *interfaces)
{
    for (unsigned i = 0; i < interfaces->n; i++) contour_done(&interfaces->contours[i]);
    *interfaces = (struct plot_interfaces){0};
}

char *plot_interface_lacking(const struct snapshot *snapshot)
{
    struct text list = {0};
    if (plot_interface_absent(snapshot) < 2) return NULL;
    for (unsigned m = 0; m < snapshot->n_material; m++)
        if (!plot_interface_alpha(snapshot, m))
            text_add(&list, "%salpha_%s", list.at ? ", " : "", snapshot->materials[m]);
    char *names = mem_text(list.at);
    text_done(&list);
    return names;
}
