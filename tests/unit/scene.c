/* Cases as files. Every file of tests/data/case/bad ends with what must be said about it: one
 * line `# expect: LINE:COLUMN: words` per error (or `# expect: --set ...: words`), none more,
 * and `# help: words`. Every file of good is read without an error, and what `bulla show` makes of it
 * reads back to the same text. `# set:` and `# variant:` lines are command-line options. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>

#include <cmocka.h>

#include "base/mem.h"
#include "base/status.h"
#include "base/text.h"
#include "case/scene_read.h"
#include "derive/derive.h"
#include "phys/model.h"

#include <glob.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

enum { LINES = 32, LINE = 512 };

/* The `# WORD: ` lines of a file. */
struct notes {
    char line[LINES][LINE];
    unsigned count;
};

static struct notes notes_of(const char *path, const char *word)
{
    struct notes notes = {.count = 0};
    char line[4096], head[64];
    FILE *file = fopen(path, "r");
    assert_non_null(file);
    int length = snprintf(head, sizeof head, "# %s: ", word);
    while (fgets(line, sizeof line, file)) {
        line[strcspn(line, "\r\n")] = '\0';
        if (strncmp(line, head, (size_t)length) != 0) continue;
        assert_true(notes.count < LINES);
        snprintf(notes.line[notes.count++], LINE, "%.*s", LINE - 1, line + length);
    }
    fclose(file);
    return notes;
}

/* Reads a case with the options it notes; what was printed comes back in `ret_said`. */
static int read_case(const char *path, struct scene **ret_scene, char **ret_said)
{
    struct notes sets = notes_of(path, "set"), variant = notes_of(path, "variant");
    const char *list[LINES + 1] = {NULL};
    size_t length;
    for (unsigned i = 0; i < sets.count; i++) list[i] = sets.line[i];
    struct scene_options options = {.sets = list, .variant = variant.count ? variant.line[0] : NULL};
    options.messages = open_memstream(ret_said, &length);
    int code = scene_read(path, &options, ret_scene);
    fclose(options.messages);
    return code;
}

static unsigned count_of(const char *text, const char *word)
{
    unsigned count = 0;
    for (; (text = strstr(text, word)) != NULL; text += strlen(word)) count++;
    return count;
}

/* Is there a line that begins with "PATH:12:3: error: " (or "--set ...: error: ") and goes on with the words? */
static int says(const char *said, const char *path, const char *expected)
{
    char head[2 * LINE];
    const char *words = strstr(expected, ": ");
    assert_non_null(words);
    int place = (int)(words - expected);
    if (expected[0] == '-') snprintf(head, sizeof head, "%.*s: error: ", place, expected);
    else snprintf(head, sizeof head, "%s:%.*s: error: ", path, place, expected);
    for (const char *line = said; *line; line += strcspn(line, "\n"), line += *line == '\n') {
        if (strncmp(line, head, strlen(head)) != 0) continue;
        char rest[LINE];
        snprintf(rest, sizeof rest, "%.*s", (int)strcspn(line, "\n"), line);
        if (strstr(rest, words + 2)) return 1;
    }
    return 0;
}

static void check_bad(const char *path)
{
    struct notes expected = notes_of(path, "expect"), helps = notes_of(path, "help");
    struct scene *scene = NULL;
    char *said = NULL;
    int code = read_case(path, &scene, &said);
    int good = code == STATUS_CASE && scene == NULL && expected.count > 0;
    good = good && count_of(said, ": error: ") == expected.count;
    for (unsigned i = 0; i < expected.count; i++) good = good && says(said, path, expected.line[i]);
    for (unsigned i = 0; i < helps.count; i++) good = good && strstr(said, helps.line[i]) != NULL;
    if (!good) fail_msg("%s: code %d, said:\n%s", path, code, said);
    free(said);
}

static void for_files(const char *pattern, unsigned least, void (*check)(const char *path))
{
    glob_t found;
    assert_int_equal(glob(pattern, 0, NULL, &found), 0);
    assert_true(found.gl_pathc >= least);
    for (size_t i = 0; i < found.gl_pathc; i++) check(found.gl_pathv[i]);
    globfree(&found);
}

static void in_folder(const char *folder, void (*run)(void))
{
    char here[4096];
    assert_non_null(getcwd(here, sizeof here));
    assert_int_equal(chdir(folder), 0);
    run();
    assert_int_equal(chdir(here), 0);
}

static void run_bad(void)
{
    for_files("*.yaml", 90, check_bad);
}

static void bad_cases_are_refused_with_their_message(void **state)
{
    (void)state;
    in_folder("tests/data/case/bad", run_bad);
}

/* The resolved text again, through a file: resolves to itself, with nothing to say. */
static void check_again(const char *name, const char *text)
{
    char folder[] = "/tmp/bulla-XXXXXX", path[4096], *said = NULL;
    assert_non_null(mkdtemp(folder));
    snprintf(path, sizeof path, "%s/%s", folder, name);
    FILE *file = fopen(path, "w");
    assert_non_null(file);
    fputs(text, file);
    fclose(file);
    struct scene *scene = NULL;
    if (read_case(path, &scene, &said)) fail_msg("%s resolved is refused:\n%s\n%s", name, said, text);
    assert_string_equal(said, "");
    assert_string_equal(scene->resolved, text);
    scene_free(scene);
    free(said);
    unlink(path);
    rmdir(folder);
}

static void check_good(const char *path)
{
    struct scene *scene = NULL;
    char *said = NULL;
    if (read_case(path, &scene, &said)) fail_msg("%s is refused:\n%s", path, said);
    check_again(path, scene->resolved);
    scene_free(scene);
    free(said);
}

static void run_good(void)
{
    for_files("*.yaml", 14, check_good);
}

static void good_cases_resolve_to_a_fixed_point(void **state)
{
    (void)state;
    in_folder("tests/data/case/good", run_good);
}

static struct scene *good(const char *name)
{
    char path[256], *said = NULL;
    struct scene *scene = NULL;
    snprintf(path, sizeof path, "tests/data/case/good/%s.yaml", name);
    if (read_case(path, &scene, &said)) fail_msg("%s is refused:\n%s", path, said);
    free(said);
    return scene;
}

static void the_least_case_has_all_defaults(void **state)
{
    (void)state;
    struct scene *scene = good("minimal");
    assert_string_equal(scene->name, "minimal");
    assert_int_equal(scene->domain.dim, 1);
    assert_int_equal(scene->domain.geometry, SCENE_CARTESIAN);
    assert_int_equal(scene->domain.cells[0], 10);
    assert_int_equal(scene->domain.cells[1], 1);
    assert_int_equal(scene->mesh.levels, 0);
    assert_int_equal(scene->mesh.regrid_every, 4);
    assert_int_equal(scene->mesh.buffer, 4);
    assert_int_equal(scene->mesh.patience, 2);
    assert_true(scene->mesh.subcycle);
    assert_int_equal(scene->mesh.reflux, SCENE_REFLUX_CORRECTED);
    assert_int_equal(scene->mesh.n_refine, 0);
    assert_int_equal(scene->scheme.closure, SCENE_KAPILA);
    assert_string_equal(scene->scheme.riemann.module->name, "hllc");
    assert_string_equal(scene->scheme.limiter.module->name, "mc");
    assert_true(scene->scheme.cfl == 0.4);
    assert_true(scene->scheme.low_mach == 1.0);
    assert_true(scene->scheme.dt_fixed == 0.0);
    assert_int_equal(scene->scheme.guard, SCENE_GUARD_NORMAL);
    assert_int_equal(scene->run.max_steps, 0);
    assert_string_equal(scene->output.directory, "out/minimal");
    assert_int_equal(scene->output.history.steps, 1);
    assert_int_equal(scene->output.snapshots.steps, 0);
    assert_true(scene->output.snapshots.time == 0.0);
    assert_int_equal(scene->output.n_column, 0);
    scene_free(scene);
}

static void the_design_case_is_understood(void **state)
{
    (void)state;
    struct scene *scene = good("design");
    assert_int_equal(scene->domain.geometry, SCENE_AXISYMMETRIC);
    assert_true(scene->domain.lower[1] == -0.25e-3 && scene->domain.upper[0] == 0.25e-3);
    const struct scene_boundary *top = &scene->domain.boundary[1][1];
    assert_int_equal(top->type, SCENE_INCOMING_WAVE);
    assert_int_equal(top->pulse, SCENE_PULSE_LITHOTRIPTER);
    assert_true(top->amplitude == 30e6 && top->frequency == 83.3e3 && top->decay == 9.1e5);
    assert_false(top->pressure.given);
    assert_int_equal(scene->mesh.tile, 16);
    assert_int_equal(scene->n_material, 3);
    assert_true(scene->material[2].eos.values[instance_param_find(scene->material[2].eos.module, "p-inf")].number ==
                616576970.0);
    assert_int_equal(scene->n_layer, 3);
    const struct scene_layer *bubble = &scene->layers[2];
    assert_int_equal(bubble->shape->type, SHAPE_SPHERE);
    assert_true(bubble->shape->a[1] == 1.1 * 10e-6 && bubble->centre[1] == 1.1 * 10e-6);
    assert_true(bubble->shape->radius == 10e-6);
    assert_true(bubble->fractions[1] == 1.0 && bubble->fractions[0] == 0.0);
    assert_true(bubble->density[1].number == 1.225);
    assert_false(bubble->density[0].given);
    assert_true(scene->output.snapshots.time == 20e-9);
    assert_int_equal(scene->output.n_snapshot_field, 5);
    assert_string_equal(scene->scheme.riemann.module->name, "hlld");
    const struct instance *law = &scene->material[2].constitutive;
    assert_string_equal(law->module->name, "neo-hookean");
    assert_true(law->values[instance_param_find(law->module, "shear-modulus")].number == 85e3);
    assert_null(scene->material[0].constitutive.module);
    assert_int_equal(scene->output.columns[1].in, 2);
    assert_int_equal(scene->output.columns[2].along, 1);
    assert_string_equal(scene->output.probes[0].fields[0], "pressure");
    assert_string_equal(scene->expects[0].value, "min(V)/first(V)");
    scene_free(scene);
}

static void expressions_become_numbers_or_scripts(void **state)
{
    (void)state;
    struct scene *scene = good("expressions");
    const double x[SCENE_AXES] = {2e-3, 0.0, 0.0};
    double value;
    assert_int_equal(scene->domain.cells[0], 128);
    assert_true(scene->run.until == 1.5 * (0.915 * 1e-3 * sqrt(998.2 / (20 * 101325.0))));
    assert_int_equal(scene->domain.boundary[0][0].type, SCENE_SYMMETRY);
    assert_non_null(scene->layers[0].pressure.script);
    assert_int_equal(scene_value_at(&scene->layers[0].pressure, x, 2e-3, 0.0, &value), STATUS_OK);
    assert_true(fabs(value - (20 * 101325.0 + 0.5 * (101325.0 - 20 * 101325.0))) < 1e-6);
    assert_null(scene->layers[1].pressure.script);
    assert_int_equal(scene_value_at(&scene->layers[1].pressure, x, 0.0, 0.0, &value), STATUS_OK);
    assert_true(value == 101325.0);
    const struct scene_column *twice = &scene->output.columns[2];
    assert_int_equal(twice->n_use, 2);
    assert_string_equal(twice->uses[0], "t");
    assert_string_equal(twice->uses[1], "R_over_R0");
    assert_true(scene->expects[0].relative == 0.015);
    scene_free(scene);
}

static void overlays_are_laid_in_order(void **state)
{
    (void)state;
    struct scene *scene = good("extends");
    assert_int_equal(scene->domain.cells[0], 32);
    assert_int_equal(scene->n_material, 2);
    assert_string_equal(scene->material[1].eos.module->name, "nasg");
    assert_true(scene->layers[1].shape->radius == 40e-6);
    assert_int_equal(scene->output.n_column, 2);
    assert_string_equal(scene->output.columns[1].name, "p");
    assert_string_equal(scene->scheme.limiter.module->name, "minmod");
    assert_int_equal(scene->n_variant, 2);
    assert_string_equal(scene->variants[1], "quick");
    scene_free(scene);
}

static void one_number_in_many_units(void **state)
{
    (void)state;
    struct scene *scene = good("units");
    assert_true(scene->domain.upper[0] == 1.0);
    assert_true(scene->material[0].eos.values[instance_param_find(scene->material[0].eos.module, "gamma")].number ==
                1.4);
    assert_true(scene->material[1].eos.values[instance_param_find(scene->material[1].eos.module, "p-inf")].number ==
                4049 * 101325.0);
    assert_true(scene->layers[0].density[0].number == 998.2);
    assert_true(fabs(scene->layers[0].velocity[0].number - 1.0) < 1e-15);
    assert_true(scene->layers[1].temperature.number == 310.15);
    assert_true(scene->run.until == 120.0);
    scene_free(scene);
}

static void waves_and_inflows_keep_their_numbers(void **state)
{
    (void)state;
    struct scene *scene = good("boundaries");
    const struct scene_boundary *in = &scene->domain.boundary[0][0], *series = &scene->domain.boundary[0][1];
    assert_int_equal(in->type, SCENE_INFLOW);
    assert_true(in->fractions[0] == 1.0 && in->density[0].number == 1000.0 && in->velocity[0].number == 1.0);
    assert_int_equal(series->n_series, 3);
    assert_true(series->series_t[1] == 1e-6 && series->series_p[1] == 1e6);
    assert_true(series->compressive_only && series->delay == 1e-6 && series->pressure.number == 1e5);
    assert_int_equal(scene->domain.boundary[1][0].pulse, SCENE_PULSE_GAUSSIAN);
    assert_non_null(scene->domain.boundary[1][1].script);
    assert_true(scene->layers[0].temperature.number == 300.0);
    scene_free(scene);
}

/* Everything that a case can say about refinement. */
static void refinement_is_understood(void **state)
{
    (void)state;
    struct scene *scene = good("refine");
    const struct scene_refine *refine = scene->mesh.refines;
    assert_int_equal(scene->mesh.levels, 4);
    assert_int_equal(scene->mesh.tile, 8);
    assert_int_equal(scene->mesh.regrid_every, 5);
    assert_int_equal(scene->mesh.buffer, 3);
    assert_int_equal(scene->mesh.patience, 3);
    assert_false(scene->mesh.subcycle);
    assert_int_equal(scene->mesh.reflux, SCENE_REFLUX_PLAIN);
    assert_int_equal(scene->mesh.n_refine, 17);
    assert_true(refine[0].kind == SCENE_REFINE_GRADIENT && refine[0].relative && refine[0].above == 0.05);
    assert_true(refine[0].finest == 4 && refine[0].t_from == 0.0 && isinf(refine[0].t_until) && !refine[0].where);
    assert_true(!refine[1].relative && refine[1].above == 1e9 && refine[1].finest == 2);
    assert_true(refine[2].kind == SCENE_REFINE_JUMP && !refine[2].relative && refine[2].above == 1e-2);
    assert_true(refine[3].relative && refine[3].above == 0.02 && refine[3].t_from == 1e-8 && refine[3].t_until == 2e-8);
    assert_true(!refine[4].relative && refine[4].above == 0.1 * 101325.0);
    assert_true(refine[5].kind == SCENE_REFINE_JUMP && !refine[5].relative && refine[5].above == 0.1);
    assert_true(refine[6].above == 1e6 && refine[6].where && refine[6].where->type == SHAPE_BOX);
    assert_true(!refine[7].relative && refine[7].above == 0.5);
    assert_true(!refine[8].relative && refine[8].above == 10.0);
    assert_true(refine[9].kind == SCENE_REFINE_VALUE && refine[9].has_above && refine[9].has_below);
    assert_true(refine[9].above == 2e5 && refine[9].below == 1e9 && refine[9].finest == 4);
    assert_true(refine[10].above == 373.15 && !refine[10].has_below);
    assert_true(refine[11].kind == SCENE_REFINE_INTERFACE && refine[11].material == 1 && refine[11].where);
    assert_true(refine[16].kind == SCENE_REFINE_REGION && refine[16].where->type == SHAPE_INTERSECTION);
    assert_int_equal(refine[16].line, 37);
    scene_free(scene);
}

/* A script says by names what it takes, and decides by true or a number above 0. */
static void scripts_ask_for_refinement(void **state)
{
    (void)state;
    struct scene *scene = good("refine");
    const struct scene_refine *high = &scene->mesh.refines[12], *fast = high + 1, *file = high + 2, *dense = high + 3;
    bool yes = false;
    assert_int_equal(high->n_use, 2);
    assert_string_equal(high->uses[0], "pressure");
    assert_string_equal(high->uses[1], "x");
    assert_int_equal(script_test(high->script, (double[]){3e5, 0.0}, 2, &yes), STATUS_OK);
    assert_true(yes);
    assert_int_equal(script_test(high->script, (double[]){3e5, 2e-3}, 2, &yes), STATUS_OK);
    assert_false(yes);
    assert_int_equal(script_test(fast->script, (double[]){-11.0}, 1, &yes), STATUS_OK);
    assert_true(yes);
    assert_int_equal(script_test(fast->script, (double[]){9.0}, 1, &yes), STATUS_OK);
    assert_false(yes);
    assert_int_equal(file->n_use, 3);
    assert_string_equal(file->uses[0], "t");
    assert_string_equal(file->uses[2], "pressure");
    assert_int_equal(file->finest, 1);
    assert_int_equal(dense->n_use, 5);
    assert_string_equal(dense->uses[4], "density");
    assert_int_equal(script_test(fast->script, (double[]){NAN}, 1, &yes), STATUS_CASE);
    assert_non_null(strstr(status_text(), "refine.yaml:31:"));
    scene_free(scene);
}

/* Reads minimal.yaml with settings of the mesh; what is said must hold the words. */
static void warned(const char *mesh, const char *words, const char *help)
{
    char *set = mem_print("mesh=%s", mesh), *said = NULL;
    const char *sets[] = {set, "domain.cells=[16]", NULL};
    struct scene_options options = {.sets = sets};
    struct scene *scene = NULL;
    size_t length;
    options.messages = open_memstream(&said, &length);
    int code = scene_read("tests/data/case/good/minimal.yaml", &options, &scene);
    fclose(options.messages);
    if (code || count_of(said, "warning: ") != (*words != 0) || !strstr(said, words) || !strstr(said, help))
        fail_msg("%s: %s", mesh, said);
    scene_free(scene);
    free(said);
    mem_free(set);
}

static void doubtful_refinement_gives_warnings(void **state)
{
    (void)state;
    warned("{levels: 1}", "mesh.levels: nothing asks for a finer level", "refine: [{gradient: density");
    warned("{levels: 1, refine: []}", "mesh.levels: nothing asks for a finer level", "");
    warned("{levels: 1, regrid-every: 10, refine: [{gradient: density, above: 0.1}]}",
           "waves cross up to 4 cells in the 10 steps between two regriddings, and leave 4 refined cells",
           "buffer: 5 would do, or regrid-every: 7");
    warned("{levels: 1, regrid-every: 1, buffer: 0, refine: [{gradient: density, above: 0.1}]}", "waves cross",
           "buffer: 2 would do");
    warned("{levels: 1, refine: [{jump: velocity, above: 0.1}]}", "'velocity' may be nearly 0", "'above: 10 m/s'");
    warned("{levels: 1, refine: [{gradient: density, above: 0.1, from: 1 h}]}", "the run ends before that", "");
    warned("{levels: 1, refine: [{gradient: density, above: 0.1}]}", "", "");
    warned("{levels: 0, regrid-every: 10, refine: [{gradient: density, above: 0.1}]}", "", "");
}

static int read_with_fields(const char *fields, struct scene **ret_scene, char **ret_said)
{
    char *set = mem_print("output.snapshots.fields=[%s]", fields);
    const char *sets[] = {set, NULL};
    struct scene_options options = {.sets = sets};
    size_t length;
    options.messages = open_memstream(ret_said, &length);
    int code = scene_read("tests/data/case/good/design.yaml", &options, ret_scene);
    fclose(options.messages);
    mem_free(set);
    return code;
}

static void checkpoints_are_read(void **state)
{
    (void)state;
    const char *sets[] = {"output.checkpoints.every=100 ns", "output.checkpoints.keep=2", NULL};
    struct scene_options options = {.sets = sets};
    struct scene *scene = NULL;
    char *said = NULL;
    size_t length;
    options.messages = open_memstream(&said, &length);
    assert_int_equal(scene_read("tests/data/case/good/minimal.yaml", &options, &scene), STATUS_OK);
    fclose(options.messages);
    assert_true(scene->output.checkpoints.time == 1e-7);
    assert_int_equal(scene->output.checkpoints_keep, 2);
    assert_null(strstr(said, "warning"));
    free(said);
    scene_free(scene);
}

/* Cases may name exactly what can be derived. */
static void fields_of_cases_are_those_that_can_be_derived(void **state)
{
    (void)state;
    struct scene *scene = good("design"), *all = NULL;
    struct model *model = model_new(scene);
    struct text list = {0};
    struct derive field;
    char *said = NULL;
    unsigned count = 0;
    for (const char *const *name = derive_names(model); *name; name++)
        text_add(&list, "%s%s", list.length ? ", " : "", *name);
    if (read_with_fields(list.at, &all, &said)) fail_msg("%s", said);
    free(said);
    assert_int_equal(read_with_fields("qqqqqqqqqqqqqqqq", &all, &said), STATUS_CASE);
    char *allowed = strstr(said, "allowed: ");
    assert_non_null(allowed);
    for (char *name = strtok(allowed + 9, ", \n"); name; name = strtok(NULL, ", \n"), count++)
        if (derive_find(model, name, &field)) fail_msg("%s", status_text());
    assert_true(count >= 16 + 4 * 3);
    free(said);
    text_done(&list);
    scene_free(all);
    model_free(model);
    scene_free(scene);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(bad_cases_are_refused_with_their_message),
        cmocka_unit_test(good_cases_resolve_to_a_fixed_point),
        cmocka_unit_test(the_least_case_has_all_defaults),
        cmocka_unit_test(the_design_case_is_understood),
        cmocka_unit_test(expressions_become_numbers_or_scripts),
        cmocka_unit_test(overlays_are_laid_in_order),
        cmocka_unit_test(one_number_in_many_units),
        cmocka_unit_test(waves_and_inflows_keep_their_numbers),
        cmocka_unit_test(refinement_is_understood),
        cmocka_unit_test(scripts_ask_for_refinement),
        cmocka_unit_test(doubtful_refinement_gives_warnings),
        cmocka_unit_test(checkpoints_are_read),
        cmocka_unit_test(fields_of_cases_are_those_that_can_be_derived),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
