/* plot_space.c - see plot_space.h. */
#include "view/plot_space.h"

#include "base/mem.h"
#include "base/status.h"
#include "view/picture_space.h"
#include "view/picture_text.h"
#include "view/plot_field.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

struct plot_space {
    const struct snapshot *snapshot;
    const struct plot_picture *picture;
    double domain[2][3];                     /* what is shown */
    unsigned n;                              /* surfaces */
    struct voxels surface[PLOT_ISOS], field; /* field: n[0] = 0 without one */
    struct plot_field names[PLOT_ISOS], name;
};

static int plot_space_load(const struct plot_space *space, const char *name, struct plot_field *field,
                           struct voxels *voxels)
{
    const struct snapshot *snapshot = space->snapshot;
    TRY(plot_field_find(snapshot, name, field));
    double *values = mem_new(snapshot->n_cell, sizeof *values);
    for (size_t c = 0; c < snapshot->n_cell; c++) values[c] = plot_field_value(field, c);
    voxels_fill(snapshot, values, space->domain, VOXELS_MOST, voxels);
    mem_free(values);
    return STATUS_OK;
}

/* All of the box unless --xlim, --ylim, --zlim say otherwise. */
static int plot_space_window(const struct snapshot *snapshot, const struct plot_option *option, double domain[2][3])
{
    voxels_domain(snapshot, domain);
    for (int k = 0; k < 3; k++) {
        const struct plot_option_span *limit = &option->limit[k];
        if (!limit->given) continue;
        if (limit->hi <= domain[0][k] || limit->lo >= domain[1][k])
            return status_fail(STATUS_CASE, "--%clim %g,%g: the box reaches from %g to %g", 'x' + k, limit->lo,
                               limit->hi, domain[0][k], domain[1][k]);
        domain[0][k] = fmax(domain[0][k], limit->lo);
        domain[1][k] = fmin(domain[1][k], limit->hi);
    }
    return STATUS_OK;
}

static int plot_space_open(const struct snapshot *snapshot, const struct plot_picture *picture,
                           struct plot_space *space)
{
    const struct plot_option *option = picture->option;
    *space = (struct plot_space){.snapshot = snapshot, .picture = picture};
    if (snapshot->dim != 3 && !(snapshot->dim == 2 && snapshot->beta == 1))
        return status_fail(STATUS_CASE, "--iso %s: surfaces need a run in space, or an axisymmetric one",
                           option->iso[0].field);
    TRY(plot_space_window(snapshot, option, space->domain));
    for (; space->n < option->n_iso; space->n++)
        TRY(plot_space_load(space, option->iso[space->n].field, &space->names[space->n], &space->surface[space->n]));
    return picture->n_field ? plot_space_load(space, picture->fields[0], &space->name, &space->field) : STATUS_OK;
}

static void plot_space_close(struct plot_space *space)
{
    for (unsigned i = 0; i < PLOT_ISOS; i++) voxels_done(&space->surface[i]);
    voxels_done(&space->field);
}

static int plot_space_cuts(const struct plot_space *space, struct picture_space *drawn)
{
    const struct plot_option *option = space->picture->option;
    for (int axis = 0; axis < 3; axis++) {
        if (!option->sliced[axis]) continue;
        if (!space->picture->n_field)
            return status_fail(STATUS_CASE,
                               "--slice %c=%g: which field colours the cut? bulla plot DIR pressure --iso ...",
                               'x' + axis, option->slice[axis]);
        if (!(option->slice[axis] >= space->domain[0][axis] && option->slice[axis] <= space->domain[1][axis]))
            return status_fail(STATUS_CASE, "--slice %c=%g: the box reaches from %g to %g", 'x' + axis,
                               option->slice[axis], space->domain[0][axis], space->domain[1][axis]);
        drawn->cut[drawn->n_cut++] = (struct picture_space_cut){axis, option->slice[axis]};
    }
    return STATUS_OK;
}

/* Values on a cut: of all cells that it goes through. */
static void plot_space_cut_range(const struct voxels *field, const struct picture_space_cut *cut, double extremes[2])
{
    double at = floor((cut->at - field->domain[0][cut->axis]) / field->h[cut->axis]);
    size_t layer = (size_t)fmin(fmax(at, 0.0), (double)field->n[cut->axis] - 1.0), i[3];
    for (i[2] = 0; i[2] < field->n[2]; i[2]++)
        for (i[1] = 0; i[1] < field->n[1]; i[1]++)
            for (i[0] = 0; i[0] < field->n[0]; i[0]++) {
                if (i[cut->axis] != layer) continue;
                double value = field->values[(i[2] * field->n[1] + i[1]) * field->n[0] + i[0]];
                if (value < extremes[0]) extremes[0] = value;
                if (value > extremes[1]) extremes[1] = value;
            }
}

/* Of what the field colours. */
static void plot_space_range(const struct plot_space *space, const struct picture_space *drawn, double extremes[2])
{
    for (unsigned i = 0; i < drawn->n_cut; i++) plot_space_cut_range(&space->field, &drawn->cut[i], extremes);
    for (unsigned i = 0; i < space->n && !drawn->n_cut; i++)
        voxels_range(&space->surface[i], space->picture->option->iso[i].value, &space->field, extremes);
}

static int plot_space_scale(const struct plot_space *space, struct picture_space *drawn)
{
    const struct plot_picture *picture = space->picture;
    const struct plot_option *option = picture->option;
    double extremes[2] = {INFINITY, -INFINITY};
    if (picture->common) memcpy(extremes, picture->extremes[0], sizeof extremes);
    else plot_space_range(space, drawn, extremes);
    if (extremes[0] > extremes[1]) extremes[0] = extremes[1] = 0.0; /* no surface at this time */
    const char *map = option->map ? option->map : colormap_for_field(picture->fields[0], extremes[0], extremes[1]);
    TRY(colormap_find(map, &drawn->map));
    TRY(plot_picture_range(&option->range[0], option->log, picture->fields[0], map, extremes));
    picture_scale_init(&drawn->scale, &(struct picture_scale_inp){.name = space->name.label,
                                                                  .unit = space->name.field->unit,
                                                                  .lo = extremes[0],
                                                                  .hi = extremes[1],
                                                                  .log = option->log});
    drawn->field = &space->field;
    return STATUS_OK;
}

static void plot_space_axes(const struct plot_space *space, struct picture_space *drawn)
{
    static const char *const turned[3] = {PICTURE_ITALIC "x" PICTURE_UPRIGHT, PICTURE_ITALIC "y" PICTURE_UPRIGHT,
                                          PICTURE_ITALIC "z" PICTURE_UPRIGHT};
    double size = 0.0;
    for (int k = 0; k < 3; k++) size = fmax(size, fmax(fabs(space->domain[0][k]), fabs(space->domain[1][k])));
    for (int k = 0; k < 3; k++)
        picture_scale_init(&drawn->axis[k], &(struct picture_scale_inp){.name = turned[k],
                                                                        .unit = "m",
                                                                        .lo = space->domain[0][k],
                                                                        .hi = space->domain[1][k],
                                                                        .like = size});
}

/* "t = 3 µs, volume fraction of air = 0.5" */
static void plot_space_note(const struct plot_space *space, size_t room, char *ret_note)
{
    char time[PICTURE_SCALE_LABEL], level[PICTURE_SCALE_LABEL];
    double like = space->picture->time_like > 0.0 ? space->picture->time_like : space->snapshot->time;
    picture_scale_quantity(space->snapshot->time, like, "s", time);
    int used = snprintf(ret_note, room, PICTURE_ITALIC "t" PICTURE_UPRIGHT " = %s", time);
    for (unsigned i = 0; i < space->n && used > 0 && (size_t)used < room; i++) {
        double value = space->picture->option->iso[i].value;
        bool plain = strcmp(space->names[i].field->unit, "1") == 0;
        if (plain) snprintf(level, sizeof level, "%g", value);
        else picture_scale_quantity(value, value, space->names[i].field->unit, level);
        used += snprintf(ret_note + used, room - (size_t)used, ", %s = %s", space->names[i].label, level);
    }
}

static int plot_space_compose(const struct plot_space *space, struct picture_space *drawn)
{
    static const uint32_t colors[PLOT_ISOS] = {0xff6f9fcfu, 0xffd98a4bu, 0xff6fb38au, 0xffb08fc7u};
    const struct plot_option *option = space->picture->option;
    for (unsigned i = 0; i < space->n; i++)
        drawn->surface[i] = (struct picture_space_surface){&space->surface[i], option->iso[i].value, colors[i]};
    drawn->n_surface = space->n;
    drawn->azimuth = option->view[0];
    drawn->elevation = option->view[1];
    plot_space_axes(space, drawn);
    TRY(plot_space_cuts(space, drawn));
    return space->picture->n_field ? plot_space_scale(space, drawn) : STATUS_OK;
}

int plot_space_draw(const struct snapshot *snapshot, const struct plot_picture *picture, cairo_surface_t **ret_image)
{
    struct plot_space space;
    char note[512] = "";
    int code = plot_space_open(snapshot, picture, &space);
    struct picture_space drawn = {.title = snapshot->title, .note = note};
    if (!code) code = plot_space_compose(&space, &drawn);
    if (!code) plot_space_note(&space, sizeof note, note);
    if (!code) code = picture_space_draw(&drawn, picture->option->width, ret_image);
    plot_space_close(&space);
    return code;
}

int plot_space_extremes(const struct snapshot *snapshot, struct plot_picture *picture)
{
    struct plot_space space;
    struct picture_space drawn = {0};
    int code = plot_space_open(snapshot, picture, &space);
    if (!code) code = plot_space_cuts(&space, &drawn);
    if (!code && picture->n_field) plot_space_range(&space, &drawn, picture->extremes[0]);
    plot_space_close(&space);
    return code;
}
