/* check.c - see check.h.
 *
 * Steps and time are measured, not guessed: the scene runs for a moment on a coarse copy of its
 * mesh (which also finds scripts that fail). The last time step there, scaled by the cell size,
 * gives the number of steps, and the time of a step the cost per cell on this machine. What
 * happens later in the run may need smaller steps. */
#include "app/check.h"

#include "app/human.h"
#include "app/progress.h"
#include "app/scenes.h"
#include "base/comm.h"
#include "base/status.h"
#include "solve/advance.h"

#include <math.h>
#include <stdio.h>

enum { CHECK_COARSE = 32, CHECK_STEPS = 500 }; /* most cells along an axis of the coarse copy; most steps there */
static const double check_moment = 0.2;        /* most seconds spent on them */

struct check_cost {
    double steps, seconds;
    long coarse_steps; /* what they were measured on */
};

static const char *const check_geometry[] = {"cartesian", "axisymmetric", "spherical"};

static void check_print_module(const char *what, const struct instance *instance)
{
    const struct bulla_module *module = instance->module;
    printf("  %-12s %s:%s", what, module->kind, module->name);
    for (unsigned i = 0; i < instance_param_count(module); i++) {
        const struct bulla_param *param = &module->params[i];
        if (param->type == BULLA_NUMBER) printf("  %s %g %s", param->name, instance->values[i].number, param->unit);
        else if (instance->values[i].text) printf("  %s %s", param->name, instance->values[i].text);
    }
    putchar('\n');
}

static void check_print_fields(const struct model *model)
{
    printf("  %-12s %u:", "fields", model->n_field);
    for (unsigned i = 0; i < model->n_field; i++) printf(" %s", model->field_names[i]);
    putchar('\n');
}

/* Three copies of the fields (old, new, primitive) and a tenth for frames and exchange. */
static double check_memory(const struct scene *scene, unsigned n_field)
{
    return scenes_cells(scene) * 3 * 8 * n_field * 1.1;
}

/* The scene on fewer cells: every axis by about the same factor, in multiples of 8 that tiles
 * can fill. *ret_ratio: how much smaller the time step of the full mesh is. */
static struct scene check_coarsen(const struct scene *scene, double *ret_ratio)
{
    struct scene coarse = *scene;
    int most = 1, limit = scene->dim == 1 ? 8 * CHECK_COARSE : CHECK_COARSE;
    for (int axis = 0; axis < scene->dim; axis++) most = scene->cells[axis] > most ? scene->cells[axis] : most;
    int factor = (most + limit - 1) / limit;
    *ret_ratio = 1;
    for (int axis = 0; axis < scene->dim && factor > 1; axis++) {
        int cells = scene->cells[axis] / factor / 8 * 8;
        if (scene->cells[axis] > 8) coarse.cells[axis] = cells > 8 ? cells : 8;
        double ratio = (double)scene->cells[axis] / coarse.cells[axis];
        if (ratio > *ret_ratio) *ret_ratio = ratio;
    }
    if (factor > 1) coarse.tile = 0;
    if (mesh_tile_size(&coarse)) return coarse;
    *ret_ratio = 1;
    return *scene;
}

static int check_measure(struct state *coarse, double ratio, const struct scene *scene, struct check_cost *ret)
{
    double begin = progress_clock(), spent = 0, dt = advance_dt(coarse);
    while (coarse->step < CHECK_STEPS && coarse->t < scene->until && spent < check_moment) {
        dt = advance_dt(coarse);
        TRY(advance_step(coarse, scene->until - coarse->t));
        spent = progress_clock() - begin;
        comm_max(&spent, 1);
    }
    if (scene->dt_fixed <= 0) dt /= ratio;
    ret->coarse_steps = coarse->step;
    ret->steps = ceil(scene->until / dt);
    if (scene->max_steps > 0 && ret->steps > (double)scene->max_steps) ret->steps = (double)scene->max_steps;
    ret->seconds = ret->steps * spent / (double)coarse->step * scenes_cells(scene) / scenes_cells(coarse->scene);
    return 0;
}

static void check_print(const struct scene *scene, const struct state *coarse, const struct check_cost *cost)
{
    char text[HUMAN_ROOM];
    printf("%s: good\n", scene->path);
    if (scene->title) printf("  %-12s %s\n", "title", scene->title);
    printf("  %-12s %dD %s, %d", "domain", scene->dim, check_geometry[scene->geometry], scene->cells[0]);
    for (int axis = 1; axis < scene->dim; axis++) printf(" x %d", scene->cells[axis]);
    if (scene->dim > 1) printf(" = %.0f", scenes_cells(scene));
    int tile = mesh_tile_size(scene);
    double tiles = 1;
    for (int axis = 0; axis < scene->dim; axis++) tiles *= scene->cells[axis] / (double)tile;
    printf(" cells in %.0f tiles of %d\n", tiles, tile);
    check_print_fields(coarse->model);
    for (unsigned i = 0; i < scene->n_material; i++)
        check_print_module(scene->material[i].name, &scene->material[i].eos);
    printf("  %-12s %s\n", "closure", scene->closure == SCENE_KAPILA ? "kapila" : "allaire");
    check_print_module("riemann", &scene->riemann);
    check_print_module("limiter", &scene->limiter);
    if (scene->n_material > 1) check_print_module("interface", &scene->interface_limiter);
    printf("  %-12s about %s\n", "memory", human_bytes(check_memory(scene, coarse->model->n_field), text));
    printf("  %-12s until %s, about %.0f steps\n", "run", human_si(scene->until, "s", text), cost->steps);
    printf("  %-12s about %s on one core (from %ld steps on a coarse copy)\n", "time",
           cost->seconds < 60 ? human_si(cost->seconds, "s", text) : human_duration(cost->seconds, text),
           cost->coarse_steps);
    printf("  %-12s %s\n", "output", scene->directory);
}

static int check_one(const struct cli_given *given, const char *path)
{
    struct scene *scene = NULL;
    int code = scenes_read(given, path, &scene);
    if (code) return code;
    double ratio;
    struct scene coarse_scene = check_coarsen(scene, &ratio);
    struct state *coarse = NULL;
    struct check_cost cost = {0};
    if (!mesh_tile_size(scene)) code = STATUS_CASE;
    if (!code) code = state_new(&coarse_scene, &coarse);
    if (!code) code = check_measure(coarse, ratio, scene, &cost);
    if (code) cli_failed(code);
    else if (comm_rank() == 0) check_print(scene, coarse, &cost);
    state_free(coarse);
    scene_free(scene);
    return code ? STATUS_CASE : 0;
}

int check_command(const struct cli_given *given)
{
    int worst = 0;
    for (int i = 0; i < given->n_word; i++) {
        int code = check_one(given, given->words[i]);
        if (code > worst) worst = code;
    }
    return worst;
}
