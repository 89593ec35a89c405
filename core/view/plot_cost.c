/* plot_cost.c - see plot_cost.h. */
#include "view/plot_cost.h"

#include "base/mem.h"
#include "base/status.h"
#include "view/chart.h"
#include "view/picture_canvas.h"

#include <errno.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { PLOT_COST_POINTS = 64, PLOT_COST_NAME = 96, PLOT_COST_LINE = 512 };

struct plot_cost_line {
    char name[PLOT_COST_NAME];
    size_t n;
    double cpu[PLOT_COST_POINTS], error[PLOT_COST_POINTS];
};

struct plot_cost {
    char title[PLOT_COST_LINE];
    unsigned n_line;
    struct plot_cost_line lines[CHART_SERIES]; /* the last one is the front */
    double cpu[2], error[2];                   /* least and largest */
};

static void plot_cost_widen(double range[2], double value)
{
    if (value < range[0]) range[0] = value;
    if (value > range[1]) range[1] = value;
}

static void plot_cost_point(struct plot_cost_line *line, double cpu, double error)
{
    if (line->n == PLOT_COST_POINTS) return;
    line->cpu[line->n] = cpu;
    line->error[line->n++] = error;
}

/* scheme,cells,error,cpu_s,cell_steps,kind */
static int plot_cost_row(struct plot_cost *plot, char *text)
{
    char *part[6] = {0}, *at = text;
    for (int i = 0; i < 6 && at; i++) part[i] = strsep(&at, ",\n");
    if (!part[5]) return status_fail(STATUS_CASE, "'%s' is no row of a study of cost", text);
    double error = strtod(part[2], NULL), cpu = strtod(part[3], NULL);
    if (!isfinite(error) || !(error > 0) || !(cpu > 0)) return STATUS_OK;
    bool next = plot->n_line == 0 || strcmp(plot->lines[plot->n_line - 1].name, part[0]) != 0;
    if (next && plot->n_line == CHART_SERIES - 1)
        return status_fail(STATUS_CASE, "too many schemes for one picture: at most %d", CHART_SERIES - 1);
    if (next) snprintf(plot->lines[plot->n_line++].name, PLOT_COST_NAME, "%s", part[0]);
    plot_cost_point(&plot->lines[plot->n_line - 1], cpu, error);
    if (strcmp(part[5], "front") == 0) plot_cost_point(&plot->lines[CHART_SERIES - 1], cpu, error);
    plot_cost_widen(plot->cpu, cpu);
    plot_cost_widen(plot->error, error);
    return STATUS_OK;
}

static int plot_cost_read(FILE *file, struct plot_cost *plot)
{
    char line[PLOT_COST_LINE];
    bool head = false;
    while (fgets(line, sizeof line, file)) {
        if (line[0] == '#') snprintf(plot->title, sizeof plot->title, "%.*s", (int)strcspn(line + 2, "\n"), line + 2);
        else if (head) TRY(plot_cost_row(plot, line));
        else head = true;
    }
    return plot->n_line ? STATUS_OK : status_fail(STATUS_CASE, "there is nothing in it that can be drawn");
}

/* The front from left to right. */
static void plot_cost_sort(struct plot_cost_line *line)
{
    for (size_t i = 1; i < line->n; i++)
        for (size_t k = i; k > 0 && line->cpu[k] < line->cpu[k - 1]; k--) {
            double cpu = line->cpu[k], error = line->error[k];
            line->cpu[k] = line->cpu[k - 1];
            line->error[k] = line->error[k - 1];
            line->cpu[k - 1] = cpu;
            line->error[k - 1] = error;
        }
}

static struct chart_series plot_cost_series(const struct plot_cost_line *line, bool front)
{
    return (struct chart_series){
        .name = front ? "front" : line->name, .reference = front, .n = line->n, .x = line->cpu, .y = line->error};
}

static int plot_cost_draw(struct plot_cost *plot, int width, cairo_surface_t **ret_image)
{
    struct chart *chart = mem_new(1, sizeof *chart);
    struct chart_panel *panel = &chart->panel[0];
    *chart = (struct chart){.title = plot->title, .note = "", .n_panel = 1};
    plot_cost_sort(&plot->lines[CHART_SERIES - 1]);
    for (unsigned i = 0; i < plot->n_line; i++)
        panel->series[panel->n_series++] = plot_cost_series(&plot->lines[i], false);
    panel->series[panel->n_series++] = plot_cost_series(&plot->lines[CHART_SERIES - 1], true);
    picture_scale_init(&chart->x, &(struct picture_scale_inp){.name = "CPU time of the steps",
                                                              .unit = "s",
                                                              .lo = plot->cpu[0] / 1.2,
                                                              .hi = plot->cpu[1] * 1.2,
                                                              .log = true,
                                                              .like = 1});
    picture_scale_init(&panel->y, &(struct picture_scale_inp){.name = "error",
                                                              .unit = "",
                                                              .lo = plot->error[0] / 1.2,
                                                              .hi = plot->error[1] * 1.2,
                                                              .log = true});
    int code = chart_draw(chart, width, ret_image);
    mem_free(chart);
    return code;
}

int plot_cost_write(const char *path, const struct plot_option *option)
{
    struct plot_cost *plot = mem_new(1, sizeof *plot);
    plot->cpu[0] = plot->error[0] = INFINITY;
    cairo_surface_t *image = NULL;
    FILE *file = fopen(path, "r");
    int code = file ? plot_cost_read(file, plot) : status_fail(STATUS_CASE, "%s", strerror(errno));
    if (file) fclose(file);
    if (!code) code = plot_cost_draw(plot, option->width, &image);
    if (code) status_wrap(code, "%s: ", path);
    char *png = option->output ? mem_text(option->output) : mem_print("%.*s.png", (int)strcspn(path, "."), path);
    if (!code) code = picture_canvas_write(image, png);
    if (!code) printf("%s\n", png);
    if (image) cairo_surface_destroy(image);
    mem_free(png);
    mem_free(plot);
    return code;
}
