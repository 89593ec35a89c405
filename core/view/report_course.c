/* report_course.c - see report_course.h. Radio buttons do the stepping: the page needs no script, and arrow keys work,
 * too. Snapshots are read twice, once for the common scale, so that one at a time is in memory. */
#include "view/report_course.h"

#include "base/mem.h"
#include "base/status.h"
#include "view/picture_scale.h"
#include "view/plot_draw.h"
#include "view/report_html.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

enum { COURSE_FRAMES = 24, COURSE_LINES = 8 };

struct course {
    const struct snapshot_series *series;
    size_t n; /* frames */
    struct plot_picture picture;
    char *names[COURSE_LINES]; /* of the fields */
};

static size_t report_course_index(const struct course *course, size_t frame)
{
    return frame * (course->series->n - 1) / (course->n - 1);
}

/* Fields and options, as the first snapshot has them. */
static void report_course_choose(struct course *course, const struct snapshot *snapshot,
                                 const struct plot_option *plain, const struct plot_option *mirrored)
{
    struct plot_picture *picture = &course->picture;
    bool plane = plot_picture_shape(snapshot, plain) == 2;
    picture->option = plane && snapshot->beta == 1 && snapshot->dim == 2 ? mirrored : plain;
    bool pressure = plane && read_field(snapshot, "pressure");
    for (unsigned i = 0; i < snapshot->n_field && i < (plane ? 1 : COURSE_LINES); i++) {
        course->names[i] = mem_text(pressure ? "pressure" : snapshot->fields[i].name);
        picture->fields[picture->n_field++] = course->names[i];
        picture->extremes[i][0] = INFINITY;
        picture->extremes[i][1] = -INFINITY;
    }
}

static int report_course_gather(struct course *course, const struct plot_option *plain,
                                const struct plot_option *mirrored)
{
    for (size_t frame = 0; frame < course->n; frame++) {
        struct snapshot *snapshot;
        TRY(read_snapshot(course->series->paths[report_course_index(course, frame)], NULL, &snapshot));
        if (frame == 0) report_course_choose(course, snapshot, plain, mirrored);
        int code = plot_draw_extremes(snapshot, &course->picture);
        read_free(snapshot);
        if (code) return code;
    }
    return STATUS_OK;
}

/* A way to another frame, or what stands in its place at the ends. */
static void report_course_turn(struct text *page, const struct course *course, size_t frame, const char *word)
{
    if (frame < course->n) text_add(page, "<label for=\"step-%zu\">%s</label>", frame, word);
    else text_add(page, "<span>%s</span>", word);
}

static int report_course_frame(struct text *page, const struct course *course, size_t frame,
                               const struct snapshot *snapshot)
{
    cairo_surface_t *image;
    char time[PICTURE_SCALE_LABEL], unit[PICTURE_SCALE_TEXT], caption[256];
    const struct snapshot_field *field = read_field(snapshot, course->picture.fields[0]);
    TRY(plot_draw(snapshot, &course->picture, &image));
    picture_scale_quantity(snapshot->time, course->picture.time_like, "s", time);
    text_add(page, "<input type=\"radio\" name=\"step\" id=\"step-%zu\"%s aria-label=\"picture %zu of %zu\">\n", frame,
             frame ? "" : " checked", frame + 1, course->n);
    text_add(page, "<div class=\"step\"><p class=\"turn\">");
    report_course_turn(page, course, frame - 1, "‹ previous"); /* before the first: none, as beyond the last */
    text_add(page, "<b>%zu of %zu, t = %s</b>", frame + 1, course->n, time);
    report_course_turn(page, course, frame + 1, "next ›");
    text_add(page, "</p>\n");
    if (course->picture.n_field > 1)
        snprintf(caption, sizeof caption, "%u of %u fields, step %ld", course->picture.n_field, snapshot->n_field,
                 snapshot->step);
    else
        snprintf(caption, sizeof caption, "%.64s [%.32s], step %ld", course->picture.fields[0],
                 report_html_unit(field ? field->unit : "", unit), snapshot->step);
    int code = report_html_figure(page, image, caption, caption);
    text_add(page, "</div>\n");
    cairo_surface_destroy(image);
    return code;
}

static int report_course_draw(struct text *page, const struct course *course)
{
    int code = STATUS_OK;
    text_add(page,
             "<h2>Course</h2>\n<p class=\"note\">%zu of %zu snapshots, all on one scale. Previous and next, or the "
             "arrow keys, step through them.</p>\n<div class=\"steps\">\n",
             course->n, course->series->n);
    for (size_t frame = 0; !code && frame < course->n; frame++) {
        struct snapshot *snapshot;
        TRY(read_snapshot(course->series->paths[report_course_index(course, frame)], NULL, &snapshot));
        code = report_course_frame(page, course, frame, snapshot);
        read_free(snapshot);
    }
    text_add(page, "</div>\n");
    return code;
}

int report_course_add(struct text *page, const struct snapshot_series *series, const struct plot_option *plain,
                      const struct plot_option *mirrored)
{
    if (series->n < 2) return STATUS_OK;
    struct course *course = mem_new(1, sizeof *course);
    course->series = series;
    course->n = series->n < COURSE_FRAMES ? series->n : COURSE_FRAMES;
    course->picture.common = true;
    course->picture.time_like = series->times[series->n - 1];
    int code = report_course_gather(course, plain, mirrored);
    if (!code && course->picture.n_field) code = report_course_draw(page, course);
    for (int i = 0; i < COURSE_LINES; i++) mem_free(course->names[i]);
    mem_free(course);
    return code;
}
