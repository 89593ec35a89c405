/* plot_option.c - see plot_option.h. Numbers are SI, or carry a unit as in case files: 0.3us, 30MPa. */
#include "view/plot_option.h"

#include "base/mem.h"
#include "base/status.h"
#include "case/unit.h"
#include "view/plot_film.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static const struct cli_option plot_option_output = {
    "--output", "-o", "FILE.png", "Where to write; of several fields FILE_FIELD.png each (a directory with --all)."};
static const struct cli_option plot_option_step = {"--step", NULL, "N", "The snapshot of this step."};
static const struct cli_option plot_option_time = {"--time", NULL, "T",
                                                   "The snapshot nearest to this time; of profiles several."};
static const struct cli_option plot_option_last = {"--last", NULL, NULL, "The last snapshot (default)."};
static const struct cli_option plot_option_all = {"--all", NULL, NULL, "Every snapshot, all on one colour scale."};
static const struct cli_option plot_option_movie = {
    "--movie", NULL, "FILE.mp4", "A film of every snapshot (.webm, .gif); by ffmpeg, else its frames."};
static const struct cli_option plot_option_fps = {"--fps", NULL, "N", "Frames per second of it (12)."};
static const struct cli_option plot_option_beside = {"--beside", NULL, NULL,
                                                     "Several runs beside each other, on one scale; also in a film."};
static const struct cli_option plot_option_iso = {
    "--iso", NULL, "FIELD=VALUE", "In space: the surface of this value; with --slice cuts beside it; up to four."};
static const struct cli_option plot_option_view = {"--view", NULL, "AZ,EL", "Where the viewer is, in degrees (30,25)."};
static const struct cli_option plot_option_over = {
    "--over", NULL, "FILE.csv[:X,Y]", "History: this reference, too; columns t and those drawn, or X and Y."};
static const struct cli_option plot_option_slice = {"--slice", NULL, "x=X",
                                                    "Cut at x, y or z; 3D: the middle of z by default."};
static const struct cli_option plot_option_range = {
    "--range", NULL, "LO,HI", "Values at the ends of the scale; again for the right field, the inside one."};
static const struct cli_option plot_option_log = {"--log", NULL, NULL, "Logarithmic scale of values."};
static const struct cli_option plot_option_map = {"--map", NULL, "NAME",
                                                  "Colour map: lagoon, ember, frost, balance, grey."};
static const struct cli_option plot_option_width = {"--width", NULL, "PX",
                                                    "Width of the picture in pixels (an odd one grows by 1)."};
static const struct cli_option plot_option_mirror = {"--mirror", NULL, NULL, "Axisymmetric: show both halves."};
static const struct cli_option plot_option_contour = {"--contour", NULL, "MATERIAL",
                                                      "Interfaces to draw: names by comma, or none (default: all)."};
static const struct cli_option plot_option_xlim = {"--xlim", NULL, "A,B", "Part of the horizontal axis."};
static const struct cli_option plot_option_ylim = {"--ylim", NULL, "A,B", "Part of the vertical axis."};
static const struct cli_option plot_option_zlim = {"--zlim", NULL, "A,B", "In space: part of z."};
static const struct cli_option plot_option_tiles = {"--tiles", NULL, NULL, "Outlines of the mesh tiles."};
static const struct cli_option plot_option_left = {"--left", NULL, "FIELD",
                                                   "Axisymmetric: this field left of the axis,"};
static const struct cli_option plot_option_right = {"--right", NULL, "FIELD", "and this one right of it."};
static const struct cli_option plot_option_inside = {"--inside", NULL, "MATERIAL=FIELD",
                                                     "In this material, show this field instead."};

const struct cli_option *const plot_option_table[] = {
    &plot_option_output,  &plot_option_last,
    &plot_option_step,    &plot_option_time,
    &plot_option_all,     &plot_option_slice,
    &plot_option_range,   &plot_option_log,
    &plot_option_map,     &plot_option_xlim,
    &plot_option_ylim,    &plot_option_zlim,
    &plot_option_mirror,  &plot_option_left,
    &plot_option_right,   &plot_option_inside,
    &plot_option_contour, &plot_option_tiles,
    &plot_option_width,   &plot_option_over,
    &plot_option_movie,   &plot_option_fps,
    &plot_option_beside,  &plot_option_iso,
    &plot_option_view,    NULL,
};

/* What a number must be a quantity of: nothing in particular, a length, a time. */
enum option_kind { OPTION_ANY, OPTION_LENGTH, OPTION_TIME };

/* The first `length` bytes of `text`: a number in SI or with a unit of the kind. */
static int plot_option_number(const char *name, const char *text, size_t length, enum option_kind kind, double *ret)
{
    static const struct unit wanted[] = {[OPTION_LENGTH] = {.power = {1}}, [OPTION_TIME] = {.power = {0, 0, 1}}};
    char word[64], bad[32], words[64];
    struct unit unit;
    snprintf(word, sizeof word, "%.*s", (int)length, text);
    enum unit_fault fault = unit_quantity(word, ret, &unit, bad);
    if (fault == UNIT_UNKNOWN) return status_fail(STATUS_CASE, "%s: there is no unit '%s' in '%s'", name, bad, word);
    if (fault != UNIT_FINE) return status_fail(STATUS_CASE, "%s: '%s' is no number", name, word);
    bool plain = unit_same(&unit, &(struct unit){0});
    if (kind == OPTION_ANY || plain || unit_same(&unit, &wanted[kind])) return STATUS_OK;
    return status_fail(STATUS_CASE, "%s: '%s' is %s; %s is needed", name, word, unit_kind(&unit, words, sizeof words),
                       kind == OPTION_TIME ? "a time" : "a length");
}

static int plot_option_span(const char *name, const char *text, struct plot_option_span *ret)
{
    if (!text) return STATUS_OK;
    const char *comma = strchr(text, ',');
    if (!comma) return status_fail(STATUS_CASE, "%s %s: two numbers with a comma are needed: %s 0,1", name, text, name);
    TRY(plot_option_number(name, text, (size_t)(comma - text), OPTION_ANY, &ret->lo));
    TRY(plot_option_number(name, comma + 1, strlen(comma + 1), OPTION_ANY, &ret->hi));
    if (!(ret->lo < ret->hi))
        return status_fail(STATUS_CASE, "%s %s: the first number must be less than the second", name, text);
    ret->given = true;
    return STATUS_OK;
}

/* Each --range in turn; a single one is that of all fields. */
static int plot_option_ranges(const struct cli_given *given, struct plot_option *option)
{
    int n = 0;
    for (int i = 0; i < given->n_option; i++) {
        if (given->options[i] != &plot_option_range) continue;
        if (n == PLOT_RANGES) return status_fail(STATUS_CASE, "--range is given more than %d times", PLOT_RANGES);
        TRY(plot_option_span("--range", given->values[i], &option->range[n]));
        if (option->log && option->range[n].lo <= 0.0)
            return status_fail(STATUS_CASE, "--log with --range from %g: a logarithmic scale begins above 0",
                               option->range[n].lo);
        n++;
    }
    for (int i = 1; n == 1 && i < PLOT_RANGES; i++) option->range[i] = option->range[0];
    return STATUS_OK;
}

/* --inside tissue=sigma_max */
static int plot_option_inside_read(const struct cli_given *given, struct plot_option *option)
{
    const char *text = cli_value(given, "--inside"), *equals = text ? strchr(text, '=') : NULL;
    if (!text) return STATUS_OK;
    if (!equals || equals == text || !equals[1] || (size_t)(equals - text) >= sizeof option->inside)
        return status_fail(STATUS_CASE, "--inside %s: a material and a field are needed: --inside tissue=sigma_max",
                           text);
    snprintf(option->inside, sizeof option->inside, "%.*s", (int)(equals - text), text);
    option->inside_field = equals + 1;
    return STATUS_OK;
}

/* --iso alpha_air=0.5 */
static int plot_option_isos(const struct cli_given *given, struct plot_option *option)
{
    struct plot_option_span view = {.lo = 30.0, .hi = 25.0};
    for (int i = 0; i < given->n_option; i++) {
        const char *text = given->values[i], *equals = strchr(text, '=');
        if (given->options[i] != &plot_option_iso) continue;
        struct plot_option_iso *iso = &option->iso[option->n_iso];
        if (option->n_iso == PLOT_ISOS) return status_fail(STATUS_CASE, "--iso is given more than %d times", PLOT_ISOS);
        if (!equals || equals == text || (size_t)(equals - text) >= sizeof iso->field)
            return status_fail(STATUS_CASE, "--iso %s: a field and a value are needed: --iso alpha_air=0.5", text);
        snprintf(iso->field, sizeof iso->field, "%.*s", (int)(equals - text), text);
        TRY(plot_option_number("--iso", equals + 1, strlen(equals + 1), OPTION_ANY, &iso->value));
        option->n_iso++;
    }
    const char *text = cli_value(given, "--view"), *comma = text ? strchr(text, ',') : NULL;
    if (text && !comma) return status_fail(STATUS_CASE, "--view %s: two angles are needed: --view 30,25", text);
    if (text) TRY(plot_option_number("--view", text, (size_t)(comma - text), OPTION_ANY, &view.lo));
    if (text) TRY(plot_option_number("--view", comma + 1, strlen(comma + 1), OPTION_ANY, &view.hi));
    if (!(view.hi >= -90.0 && view.hi <= 90.0))
        return status_fail(STATUS_CASE, "--view %s: the elevation lies between -90 and 90 degrees", text);
    if (text && !option->n_iso) return status_fail(STATUS_CASE, "--view is for surfaces: --iso alpha_air=0.5");
    option->view[0] = view.lo;
    option->view[1] = view.hi;
    return STATUS_OK;
}

static int plot_option_slices(const struct cli_given *given, struct plot_option *option)
{
    for (int i = 0; i < given->n_option; i++) {
        if (given->options[i] != &plot_option_slice) continue;
        const char *text = given->values[i];
        int axis = text[0] == 'r' ? 0 : text[0] - 'x';
        if (axis < 0 || axis > 2 || text[1] != '=')
            return status_fail(STATUS_CASE, "--slice %s: say which axis and where: --slice z=0", text);
        TRY(plot_option_number("--slice", text + 2, strlen(text + 2), OPTION_LENGTH, &option->slice[axis]));
        option->sliced[axis] = true;
    }
    return STATUS_OK;
}

static int plot_option_when(const struct cli_given *given, struct plot_option *option)
{
    static const char *const names[] = {"--last", "--step", "--time", "--all"}; /* as enum plot_option_when */
    const char *chosen = NULL;
    for (int when = PLOT_LAST; when <= PLOT_ALL; when++) {
        if (!cli_value(given, names[when])) continue;
        if (chosen) return status_fail(STATUS_CASE, "%s and %s contradict each other", chosen, names[when]);
        chosen = names[when];
        option->when = (enum plot_option_when)when;
    }
    TRY(cli_count(given, "--step", 0, &option->step));
    for (int i = 0; i < given->n_option; i++) {
        const char *time = given->values[i];
        if (given->options[i] != &plot_option_time) continue;
        if (option->n_time == PLOT_TIMES)
            return status_fail(STATUS_CASE, "--time is given more than %d times", PLOT_TIMES);
        TRY(plot_option_number("--time", time, strlen(time), OPTION_TIME, &option->times[option->n_time++]));
    }
    return STATUS_OK;
}

static int plot_option_overs(const struct cli_given *given, struct plot_option *option)
{
    for (int i = 0; i < given->n_option; i++) {
        if (given->options[i] != &plot_option_over) continue;
        if (option->n_over == PLOT_OVERS)
            return status_fail(STATUS_CASE, "--over is given more than %d times", PLOT_OVERS);
        option->over[option->n_over++] = given->values[i];
    }
    return STATUS_OK;
}

/* Films show all snapshots; what stands beside each other has times in common, no steps. */
static int plot_option_film(const struct cli_given *given, struct plot_option *option)
{
    long pace = PLOT_FILM_PACE;
    TRY(cli_count(given, "--fps", 1, &pace));
    if (pace > PLOT_FILM_PACE_MOST)
        return status_fail(STATUS_CASE, "--fps %ld: at most %d frames per second", pace, PLOT_FILM_PACE_MOST);
    option->pace = (int)pace;
    if (!option->movie && cli_value(given, "--fps"))
        return status_fail(STATUS_CASE, "--fps is for a film: --movie FILE.mp4");
    if (option->movie && option->output)
        return status_fail(STATUS_CASE, "-o %s and --movie %s: a film has one name", option->output, option->movie);
    bool one = cli_value(given, "--last") || option->when == PLOT_STEP || option->when == PLOT_TIME;
    if (option->movie && one)
        return status_fail(STATUS_CASE, "--movie shows every snapshot: without --last, --step and --time");
    if (option->beside && (option->when == PLOT_STEP || (option->when == PLOT_ALL && !option->movie)))
        return status_fail(STATUS_CASE, "--beside goes by time: --time T, or every snapshot with --movie FILE.mp4");
    return STATUS_OK;
}

int plot_option_read(const struct cli_given *given, struct plot_option *ret_option)
{
    struct plot_option option = {.output = cli_value(given, "--output"),
                                 .movie = cli_value(given, "--movie"),
                                 .beside = cli_value(given, "--beside"),
                                 .map = cli_value(given, "--map"),
                                 .contours = cli_value(given, "--contour"),
                                 .left = cli_value(given, "--left"),
                                 .right = cli_value(given, "--right"),
                                 .log = cli_value(given, "--log"),
                                 .mirror = cli_value(given, "--mirror"),
                                 .tiles = cli_value(given, "--tiles")};
    long width = 0;
    TRY(cli_count(given, "--width", 100, &width));
    if (width > 20000) return status_fail(STATUS_CASE, "--width %ld: at most 20000 pixels", width);
    option.width = (int)width;
    TRY(plot_option_when(given, &option));
    TRY(plot_option_film(given, &option));
    TRY(plot_option_overs(given, &option));
    TRY(plot_option_slices(given, &option));
    TRY(plot_option_isos(given, &option));
    TRY(plot_option_ranges(given, &option));
    TRY(plot_option_inside_read(given, &option));
    TRY(plot_option_span("--xlim", cli_value(given, "--xlim"), &option.limit[0]));
    TRY(plot_option_span("--ylim", cli_value(given, "--ylim"), &option.limit[1]));
    TRY(plot_option_span("--zlim", cli_value(given, "--zlim"), &option.limit[2]));
    if (option.limit[2].given && !option.n_iso)
        return status_fail(STATUS_CASE, "--zlim is for surfaces in space: --iso alpha_air=0.5");
    if (!option.left != !option.right)
        return status_fail(STATUS_CASE, "--left and --right go together: one field for each side of the axis");
    *ret_option = option;
    return STATUS_OK;
}

char *plot_option_file(const char *output, const char *field)
{
    const char *slash = strrchr(output, '/'), *name = slash ? slash + 1 : output, *dot = strrchr(name, '.');
    size_t stem = dot && dot != name ? (size_t)(dot - output) : strlen(output);
    return mem_print("%.*s_%s%s", (int)stem, output, field, output + stem);
}
