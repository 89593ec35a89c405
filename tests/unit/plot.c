/* What pictures show of snapshots: cuts, mirror images, fields, ranges, messages. */
#include "base/mem.h"
#include "base/status.h"
#include "view/plot_field.h"
#include "view/plot_interface.h"
#include "view/plot_option.h"
#include "view/plot_draw.h"
#include "view/plot_view.h"
#include "close.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { M = 8 };

static void add_field(struct snapshot *snapshot, const char *name, const char *unit, unsigned components)
{
    struct snapshot_field *field = &snapshot->fields[snapshot->n_field++];
    snprintf(field->name, sizeof field->name, "%s", name);
    snprintf(field->unit, sizeof field->unit, "%s", unit);
    field->components = components;
    field->data = mem_new(snapshot->n_cell * components, sizeof *field->data);
}

/* [0, 1]^dim in M^dim cells, x fastest; pressure = x + 10 y + 100 z, velocity = (x, -y, z), air where x < 1/2. */
static struct snapshot *snapshot_new(int dim, int beta)
{
    struct snapshot *snapshot = mem_new(1, sizeof *snapshot);
    snapshot->title = mem_text("A case");
    snapshot->name = mem_text("case");
    snapshot->version = mem_text("0");
    snapshot->time = 2.5e-7;
    snapshot->dim = dim;
    snapshot->beta = beta;
    snapshot->n_cell = 1;
    for (int axis = 0; axis < dim; axis++) {
        snapshot->domain[1][axis] = 1.0;
        snapshot->n_cell *= M;
    }
    snapshot->n_level = 1;
    snapshot->n_tile = 2;
    snapshot->tiles = mem_new(2, sizeof *snapshot->tiles);
    for (size_t i = 0; i < 2; i++)
        snapshot->tiles[i] = (struct snapshot_tile){.first = i * snapshot->n_cell / 2, .n_cell = snapshot->n_cell / 2};
    snapshot->lower = mem_new(snapshot->n_cell, sizeof *snapshot->lower);
    snapshot->upper = mem_new(snapshot->n_cell, sizeof *snapshot->upper);
    snapshot->n_material = 2;
    snapshot->materials = mem_new(2, sizeof *snapshot->materials);
    snprintf(snapshot->materials[0], READ_NAME, "water");
    snprintf(snapshot->materials[1], READ_NAME, "air");
    snapshot->fields = mem_new(4, sizeof *snapshot->fields);
    add_field(snapshot, "pressure", "Pa", 1);
    add_field(snapshot, "velocity", "m/s", 3);
    add_field(snapshot, "alpha_air", "1", 1);
    for (size_t c = 0; c < snapshot->n_cell; c++) {
        double x[3] = {0.0};
        size_t rest = c;
        for (int axis = 0; axis < dim; axis++, rest /= M) {
            snapshot->lower[c][axis] = (double)(rest % M) / M;
            snapshot->upper[c][axis] = (double)(rest % M + 1) / M;
            x[axis] = (0.5 + (double)(rest % M)) / M;
        }
        snapshot->fields[0].data[c] = x[0] + 10.0 * x[1] + 100.0 * x[2];
        for (int axis = 0; axis < 3; axis++)
            snapshot->fields[1].data[3 * c + (size_t)axis] = axis == 1 ? -x[1] : x[axis];
        snapshot->fields[2].data[c] = x[0] < 0.5;
    }
    return snapshot;
}

/* A coarse tile beside a fine one, and one without leaves: outlines are those of the tiles, whatever their cells. */
static void tiles_have_their_own_sizes(void **state)
{
    (void)state;
    struct snapshot *snapshot = snapshot_new(2, 0);
    struct plot_option option = {0};
    struct plot_view view;
    struct snapshot_tile tiles[3] = {{.first = 0, .n_cell = 0},
                                     {.first = 16, .n_cell = 48},
                                     {.first = 0, .n_cell = 16}};
    size_t n;
    mem_free(snapshot->tiles);
    snapshot->n_tile = 3;
    snapshot->tiles = mem_new(3, sizeof *snapshot->tiles);
    memcpy(snapshot->tiles, tiles, sizeof tiles);
    assert_int_equal(plot_view_make(snapshot, &option, &view), 0);
    struct raster_cell *boxes = plot_view_tiles(&view, &n);
    assert_int_equal(n, 2);
    assert_close(boxes[0].at[1][0], 0.25, 0.0);
    assert_close(boxes[0].at[1][1], 1.0, 0.0);
    assert_close(boxes[1].at[1][0], 0.0, 0.0);
    assert_close(boxes[1].at[1][1], 0.25, 0.0);
    mem_free(boxes);
    plot_view_done(&view);
    read_free(snapshot);
}

static void a_plane_has_all_cells(void **state)
{
    (void)state;
    struct snapshot *snapshot = snapshot_new(2, 0);
    struct plot_option option = {0};
    struct plot_view view;
    assert_int_equal(plot_view_make(snapshot, &option, &view), 0);
    assert_int_equal(view.n_axis, 2);
    assert_int_equal(view.n, M * M);
    assert_close(view.cells[M + 1].at[1][0], 1.0 / M, 0.0);
    assert_string_equal(view.note, "");
    plot_view_done(&view);
    read_free(snapshot);
}

static void a_box_is_cut_in_its_middle(void **state)
{
    (void)state;
    struct snapshot *snapshot = snapshot_new(3, 0);
    struct plot_option option = {0};
    struct plot_view view;
    struct plot_field field;
    assert_int_equal(plot_view_make(snapshot, &option, &view), 0);
    assert_int_equal(view.n, M * M);
    assert_int_equal(plot_field_find(snapshot, "pressure", &field), 0);
    double *values = plot_view_values(&view, &field);
    assert_close(values[0], (0.5 + 5.0 + 100.0 * (M / 2 + 0.5)) / M, 1e-12); /* the cells above the middle */
    mem_free(values);
    plot_view_done(&view);
    read_free(snapshot);
}

static void a_cut_may_touch_the_ends(void **state)
{
    (void)state;
    struct snapshot *snapshot = snapshot_new(3, 0);
    struct plot_option option = {.sliced = {true}, .slice = {1.0}};
    struct plot_view view;
    assert_int_equal(plot_view_make(snapshot, &option, &view), 0);
    assert_int_equal(view.n, M * M);
    assert_int_equal(view.axis[0], 1);
    assert_int_equal(view.axis[1], 2);
    assert_close(snapshot->upper[view.source[0]][0], 1.0, 0.0);
    plot_view_done(&view);
    option.slice[0] = 1.01;
    assert_int_equal(plot_view_make(snapshot, &option, &view), STATUS_CASE);
    assert_non_null(strstr(status_text(), "--slice x=1.01: the domain reaches from 0 to 1"));
    read_free(snapshot);
}

static void two_cuts_leave_a_sorted_line(void **state)
{
    (void)state;
    struct snapshot *snapshot = snapshot_new(3, 0);
    struct plot_option option = {.sliced = {true, false, true}, .slice = {0.0, 0.0, 0.3}};
    struct plot_view view;
    for (size_t c = 0; c < snapshot->n_cell / 2; c++) /* the file may have any order of tiles */
        for (int axis = 0; axis < 3; axis++) {
            size_t other = snapshot->n_cell - 1 - c;
            double lower = snapshot->lower[c][axis], upper = snapshot->upper[c][axis];
            snapshot->lower[c][axis] = snapshot->lower[other][axis];
            snapshot->upper[c][axis] = snapshot->upper[other][axis];
            snapshot->lower[other][axis] = lower;
            snapshot->upper[other][axis] = upper;
        }
    assert_int_equal(plot_view_make(snapshot, &option, &view), 0);
    assert_int_equal(view.n_axis, 1);
    assert_int_equal(view.axis[0], 1);
    assert_int_equal(view.n, M);
    for (int i = 0; i < M; i++) assert_close(view.cells[i].at[0][0], (double)i / M, 0.0);
    plot_view_done(&view);
    option.sliced[1] = true;
    assert_int_equal(plot_view_make(snapshot, &option, &view), STATUS_CASE);
    read_free(snapshot);
}

static void mirror_images_need_an_axis(void **state)
{
    (void)state;
    struct snapshot *snapshot = snapshot_new(2, 1);
    struct plot_option option = {.mirror = true};
    struct plot_view view;
    assert_int_equal(plot_view_make(snapshot, &option, &view), 0);
    assert_int_equal(view.n, 2 * M * M);
    assert_close(view.domain[0][0], -1.0, 0.0);
    assert_close(view.cells[M * M].at[0][0], -1.0 / M, 0.0);
    assert_close(view.cells[M * M].at[0][1], 0.0, 0.0);
    assert_int_equal(view.source[M * M], view.source[0]);
    size_t tiles;
    struct raster_cell *boxes = plot_view_tiles(&view, &tiles);
    assert_int_equal(tiles, 4);
    assert_close(boxes[1].at[1][0], 0.5, 0.0);
    assert_close(boxes[2].at[0][0], -1.0, 0.0);
    mem_free(boxes);
    plot_view_done(&view);
    snapshot->beta = 0;
    assert_int_equal(plot_view_make(snapshot, &option, &view), STATUS_CASE);
    assert_non_null(strstr(status_text(), "axisymmetric"));
    read_free(snapshot);
}

static void fields_are_found_by_name_and_component(void **state)
{
    (void)state;
    struct snapshot *snapshot = snapshot_new(2, 1);
    struct plot_field field;
    assert_int_equal(plot_field_find(snapshot, "velocity", &field), 0);
    assert_string_equal(field.label, "velocity magnitude");
    assert_close(plot_field_value(&field, 0), hypot(0.5 / M, 0.5 / M), 1e-15);
    assert_int_equal(plot_field_find(snapshot, "velocity_y", &field), 0);
    assert_string_equal(field.label, "axial velocity");
    assert_close(plot_field_value(&field, 0), -0.5 / M, 0.0);
    assert_int_equal(plot_field_find(snapshot, "alpha_air", &field), 0);
    assert_string_equal(field.label, "volume fraction of air");
    assert_int_equal(plot_field_find(snapshot, "pressur", &field), STATUS_CASE);
    assert_non_null(strstr(status_text(), "did you mean 'pressure'"));
    assert_non_null(strstr(status_text(), "pressure, velocity (_x, _y, _z), alpha_air"));
    assert_int_equal(plot_field_find(snapshot, "pressure_x", &field), STATUS_CASE);
    read_free(snapshot);
}

/* Where there is no air, its temperature is no number: neither drawn nor part of the scale. */
static void an_absent_material_stays_blank(void **state)
{
    (void)state;
    struct snapshot *snapshot = snapshot_new(2, 1);
    struct plot_option option = {0};
    struct plot_view view;
    struct plot_field field;
    add_field(snapshot, "temperature_air", "K", 1);
    double *T = snapshot->fields[snapshot->n_field - 1].data;
    for (size_t c = 0; c < snapshot->n_cell; c++) T[c] = c % M < M / 2 ? 300.0 + (double)c : 0.0;
    assert_int_equal(plot_field_find(snapshot, "temperature_air", &field), 0);
    assert_close(plot_field_value(&field, 1), 301.0, 0.0);
    assert_true(isnan(plot_field_value(&field, M - 1)));
    assert_int_equal(plot_view_make(snapshot, &option, &view), 0);
    double *values = plot_view_values(&view, &field), extremes[2] = {INFINITY, -INFINITY};
    plot_view_range(&view, values, (const double[2][2]){{0, 1}, {0, 1}}, false, extremes);
    assert_close(extremes[0], 300.0, 0.0);
    mem_free(values);
    plot_view_done(&view);
    assert_int_equal(plot_field_find(snapshot, "alpha_air", &field), 0);
    assert_close(plot_field_value(&field, M - 1), 0.0, 0.0); /* no air is a fraction, too */
    read_free(snapshot);
}

static void interfaces_are_where_alpha_is_a_half(void **state)
{
    (void)state;
    struct snapshot *snapshot = snapshot_new(2, 1);
    struct plot_option option = {.mirror = true};
    struct plot_view view;
    struct plot_interfaces interfaces;
    assert_int_equal(plot_view_make(snapshot, &option, &view), 0);
    assert_int_equal(plot_interface_find(&view, NULL, &interfaces), 0);
    assert_int_equal(interfaces.n, 1);
    assert_string_equal(interfaces.names[0], "air");
    assert_int_equal(interfaces.contours[0].n_line, 2); /* and its mirror image */
    assert_close(contour_length(&interfaces.contours[0]), 2.0, 1e-12);
    assert_close(fabs(interfaces.contours[0].lines[0].at[0][0]), 0.5, 1e-12);
    plot_interface_done(&interfaces);
    assert_int_equal(plot_interface_find(&view, "none", &interfaces), 0);
    assert_int_equal(interfaces.n, 0);
    assert_int_equal(plot_interface_find(&view, "watr", &interfaces), STATUS_CASE);
    assert_non_null(strstr(status_text(), "did you mean 'water'"));
    assert_int_equal(plot_interface_find(&view, "water", &interfaces), 0); /* what air leaves */
    assert_int_equal(interfaces.n, 1);
    assert_string_equal(interfaces.names[0], "water");
    assert_close(contour_length(&interfaces.contours[0]), 2.0, 1e-12);
    plot_interface_done(&interfaces);
    assert_null(plot_interface_lacking(snapshot));
    plot_view_done(&view);
    read_free(snapshot);
}

/* Of three fractions one is in the file: its interface is drawn, those of the others cannot be told. */
static void of_two_missing_fractions_nothing_is_known(void **state)
{
    (void)state;
    struct snapshot *snapshot = snapshot_new(2, 0);
    struct plot_option option = {0};
    struct plot_view view;
    struct plot_interfaces interfaces;
    snapshot->materials = mem_grow(snapshot->materials, 2, 3, sizeof *snapshot->materials);
    snprintf(snapshot->materials[2], READ_NAME, "gel");
    snapshot->n_material = 3;
    assert_int_equal(plot_view_make(snapshot, &option, &view), 0);
    assert_int_equal(plot_interface_find(&view, NULL, &interfaces), 0);
    assert_int_equal(interfaces.n, 1);
    assert_string_equal(interfaces.names[0], "air");
    plot_interface_done(&interfaces);
    assert_int_equal(plot_interface_find(&view, "water", &interfaces), STATUS_CASE);
    assert_non_null(strstr(status_text(), "no alpha_water"));
    char *lacking = plot_interface_lacking(snapshot);
    assert_string_equal(lacking, "alpha_water, alpha_gel");
    mem_free(lacking);
    plot_view_done(&view);
    read_free(snapshot);
}

/* Along a line a vector has a direction: the sign is part of the picture. */
static void velocity_of_a_line_keeps_its_sign(void **state)
{
    (void)state;
    struct snapshot *snapshot = snapshot_new(1, 0), *round = snapshot_new(1, 2);
    struct plot_field field;
    snapshot->fields[1].data[3] = -2.0;
    assert_int_equal(plot_field_find(snapshot, "velocity", &field), 0);
    assert_close(plot_field_value(&field, 1), -2.0, 0.0);
    assert_non_null(strstr(field.label, "velocity"));
    assert_null(strstr(field.label, "magnitude"));
    assert_int_equal(plot_field_find(round, "velocity", &field), 0);
    assert_string_equal(field.label, "radial velocity");
    read_free(snapshot);
    read_free(round);
}

/* Every width and height is even, so that films can be made of pictures. */
static void pictures_have_even_sizes(void **state)
{
    (void)state;
    struct snapshot *snapshot = snapshot_new(2, 0);
    for (int width = 300; width < 320; width++) {
        struct plot_option option = {.width = width};
        struct plot_picture picture = {.option = &option, .n_field = 1, .fields = {"pressure"}};
        cairo_surface_t *image;
        assert_int_equal(plot_draw(snapshot, &picture, &image), 0);
        assert_int_equal(cairo_image_surface_get_width(image), width + width % 2);
        assert_int_equal(cairo_image_surface_get_height(image) % 2, 0);
        cairo_surface_destroy(image);
    }
    read_free(snapshot);
}

static void interfaces_of_a_line_are_places(void **state)
{
    (void)state;
    struct snapshot *snapshot = snapshot_new(1, 2);
    struct plot_option option = {0};
    struct plot_view view;
    double *places;
    size_t n;
    assert_int_equal(plot_view_make(snapshot, &option, &view), 0);
    snapshot->fields[2].data[M / 2 - 1] = 0.75; /* 0.75 -> 0: a half is a third of a cell behind the centre */
    assert_int_equal(plot_interface_places(&view, NULL, &places, &n), 0);
    assert_int_equal(n, 1);
    assert_close(places[0], (M / 2 - 0.5 + 1.0 / 3.0) / M, 1e-14);
    mem_free(places);
    plot_view_done(&view);
    read_free(snapshot);
}

static int draw(const struct snapshot *snapshot, const struct plot_option *option, const char *name)
{
    struct plot_picture picture = {.option = option, .n_field = 1, .fields = {name}};
    cairo_surface_t *image;
    int code = plot_draw(snapshot, &picture, &image);
    if (code) return code;
    assert_int_equal(cairo_image_surface_get_width(image), 300);
    cairo_surface_destroy(image);
    return 0;
}

static void every_dimension_and_geometry_is_drawn(void **state)
{
    (void)state;
    for (int dim = 1; dim <= 3; dim++)
        for (int beta = 0; beta < 3; beta++) {
            struct snapshot *snapshot = snapshot_new(dim, beta);
            struct plot_option option = {.width = 300, .tiles = true};
            assert_int_equal(draw(snapshot, &option, "pressure"), 0);
            assert_int_equal(draw(snapshot, &option, "velocity_x"), 0);
            option.log = true;
            assert_int_equal(draw(snapshot, &option, "pressure"), 0);
            read_free(snapshot);
        }
}

static void what_cannot_be_drawn_is_said(void **state)
{
    (void)state;
    struct snapshot *snapshot = snapshot_new(2, 1);
    struct plot_option outside = {.width = 300, .limit = {{true, 3.0, 4.0}}}, log = {.width = 300, .log = true};
    assert_int_equal(draw(snapshot, &outside, "pressure"), STATUS_CASE);
    assert_non_null(strstr(status_text(), "--xlim 3,4: the domain reaches from 0 to 1"));
    assert_int_equal(draw(snapshot, &log, "velocity_y"), STATUS_CASE);
    assert_non_null(strstr(status_text(), "no values above 0"));
    for (size_t c = 0; c < snapshot->n_cell; c++) snapshot->fields[0].data[c] = NAN;
    struct plot_option plain = {.width = 300};
    assert_int_equal(draw(snapshot, &plain, "pressure"), STATUS_CASE);
    assert_non_null(strstr(status_text(), "no finite values"));
    read_free(snapshot);
}

static void a_pair_fills_the_two_halves(void **state)
{
    (void)state;
    struct snapshot *snapshot = snapshot_new(2, 1);
    struct plot_option option = {.width = 300, .left = "pressure", .right = "velocity"};
    struct plot_picture picture = {.option = &option, .n_field = 2, .fields = {"pressure", "velocity"}};
    cairo_surface_t *image;
    assert_int_equal(plot_draw(snapshot, &picture, &image), 0);
    cairo_surface_destroy(image);
    read_free(snapshot);
}

/* A command line of `bulla plot`, read. */
static int parse(struct plot_option *option, int argc, char **argv)
{
    static const struct cli_command command = {"plot", "DIR FIELD", "", plot_option_table, 1, -1, NULL};
    struct cli_given given;
    int code = cli_parse(&command, argc, argv, &given);
    if (code) return code;
    code = plot_option_read(&given, option);
    cli_done(&given);
    return code;
}

static void options_are_read(void **state)
{
    (void)state;
    char *argv[] = {"bulla",   "plot",   "dir",     "p",       "--step",  "12",  "--slice", "z=-0.5",
                    "--slice", "x=2e-3", "--range", "-1,3MPa", "--width", "640", "--ylim",  "0,1"};
    struct plot_option option;
    assert_int_equal(parse(&option, sizeof argv / sizeof *argv, argv), 0);
    assert_int_equal(option.when, PLOT_STEP);
    assert_int_equal(option.step, 12);
    assert_true(option.sliced[0] && !option.sliced[1] && option.sliced[2]);
    assert_close(option.slice[0], 2e-3, 0.0);
    assert_close(option.slice[2], -0.5, 0.0);
    assert_close(option.range[0].lo, -1.0, 0.0);
    assert_close(option.range[0].hi, 3e6, 0.0);
    assert_int_equal(option.width, 640);
    assert_true(option.limit[1].given && !option.limit[0].given);
}

static void bad_options_are_refused(void **state)
{
    (void)state;
    static const struct {
        char *option, *value, *message;
    } rows[] = {
        {"--range", "3", "two numbers"},         {"--range", "5,2", "first number must be less"},
        {"--range", "a,2", "'a' is no number"},  {"--slice", "0.5", "which axis"},
        {"--slice", "z=here", "no number"},      {"--width", "3", "at least 100"},
        {"--width", "999999", "at most"},        {"--time", "soon", "no number"},
        {"--step", "1.5", "whole number"},       {"--time", "3 mm", "a time is needed"},
        {"--range", "0,3 Pax", "no unit 'Pax'"}, {"--left", "pressure", "go together"},
    };
    for (size_t i = 0; i < sizeof rows / sizeof *rows; i++) {
        char *argv[] = {"bulla", "plot", "dir", "p", rows[i].option, rows[i].value};
        struct plot_option option;
        assert_int_equal(parse(&option, 6, argv), STATUS_CASE);
        if (!strstr(status_text(), rows[i].message)) fail_msg("%s: %s", rows[i].value, status_text());
    }
    char *both[] = {"bulla", "plot", "dir", "p", "--all", "--last"};
    struct plot_option option;
    assert_int_equal(parse(&option, 6, both), STATUS_CASE);
    assert_non_null(strstr(status_text(), "contradict"));
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(tiles_have_their_own_sizes),
        cmocka_unit_test(a_plane_has_all_cells),
        cmocka_unit_test(a_box_is_cut_in_its_middle),
        cmocka_unit_test(a_cut_may_touch_the_ends),
        cmocka_unit_test(two_cuts_leave_a_sorted_line),
        cmocka_unit_test(mirror_images_need_an_axis),
        cmocka_unit_test(fields_are_found_by_name_and_component),
        cmocka_unit_test(an_absent_material_stays_blank),
        cmocka_unit_test(interfaces_are_where_alpha_is_a_half),
        cmocka_unit_test(interfaces_of_a_line_are_places),
        cmocka_unit_test(of_two_missing_fractions_nothing_is_known),
        cmocka_unit_test(velocity_of_a_line_keeps_its_sign),
        cmocka_unit_test(pictures_have_even_sizes),
        cmocka_unit_test(every_dimension_and_geometry_is_drawn),
        cmocka_unit_test(what_cannot_be_drawn_is_said),
        cmocka_unit_test(a_pair_fills_the_two_halves),
        cmocka_unit_test(options_are_read),
        cmocka_unit_test(bad_options_are_refused),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
