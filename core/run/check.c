/* check.c - see check.h.
 *
 * Steps and time are measured, not guessed: the scene runs for a moment on a coarse copy of its
 * mesh (which also finds scripts that fail). Its steps, scaled by the cell size, give the number of steps, and the CPU
 * time of a step the cost per cell on this machine, whatever else runs on it. Where the copy does not come to the end,
 * the rest is taken at its last time step, with the range of its longest and shortest; what happens later may need
 * smaller ones.
 * With levels the real initial mesh is built too, for its cells; the coarse copy has one level. */
#include "run/check.h"

#include "base/comm.h"
#include "base/log.h"
#include "base/mem.h"
#include "base/status.h"
#include "case/shape.h"
#include "cli/human.h"
#include "cli/scenes.h"
#include "io/snapshot.h"
#include "run/check_phase.h"
#include "run/transport.h"
#include "run/travel.h"
#include "scheme/source.h"
#include "solve/advance.h"
#include "solve/cost.h"
#include "solve/tag.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

enum { CHECK_COARSE = 32, CHECK_STEPS = 500 }; /* most cells along an axis of the coarse copy; most steps there */
static const double check_moment = 0.2;        /* most seconds spent on them */
/* How much less and more runs take than is estimated, without levels and with them: measured (docs/running.md). */
static const double check_error[2][2] = {{0.5, 2}, {1, 5}};
static const double check_build = 1 << 30; /* most bytes of a coarsest level that is built to be refined */

struct check_cost {
    double steps, least, most; /* how many, and between which bounds */
    double seconds;            /* CPU time of that many */
    long coarse_steps;         /* what they were measured on */
    double speed;              /* of the fastest flow there [m/s] */
};

static const char *const check_geometry[] = {"cartesian", "axisymmetric", "spherical"};

static void check_print_sources(const struct scene *scene)
{
    struct text text = {0};
    source_text(scene, &text);
    if (text.at) printf("  %-12s %s\n", "sources", text.at);
    text_done(&text);
}

/* Last layer up to `index` that is all of a material and has a number for pressure; -1: none. */
static int check_layer(const struct scene *scene, int index, unsigned material)
{
    for (; index >= 0; index--) {
        const struct scene_layer *layer = &scene->layers[index];
        bool whole = layer->has_material && layer->fractions && layer->fractions[material] == 1.0;
        if (whole && layer->pressure.given && !layer->pressure.script) return index;
    }
    return -1;
}

/* What surface tension asks of the pressure in a sphere, against what it has. */
static void check_print_jump(const struct scene *scene, int index, unsigned inside, unsigned outside, double sigma)
{
    const struct scene_layer *layer = &scene->layers[index];
    int below = check_layer(scene, index - 1, outside);
    char jump[HUMAN_ROOM], given[HUMAN_ROOM];
    if (check_layer(scene, index, inside) != index || below < 0) return;
    if (!layer->shape || layer->shape->type != SHAPE_SPHERE) return;
    double asked = scene_domain_turns(&scene->domain) * sigma / layer->shape->radius;
    printf("  %-12s asks for %s more in the sphere of initial[%d], which begins with %s more\n", "",
           human_si(asked, "Pa", jump), index,
           human_si(layer->pressure.number - scene->layers[below].pressure.number, "Pa", given));
}

static void check_print_tension(const struct scene *scene, const struct model *model)
{
    for (unsigned k = 0; k < scene->n_tension; k++) {
        const struct scene_tension *pair = &scene->tension[k];
        char sigma[HUMAN_ROOM];
        printf("  %-12s %s+%s %s\n", k ? "" : "tension", scene->material[pair->one].name,
               scene->material[pair->other].name, human_si(pair->sigma, "N/m", sigma));
        for (int i = 0; i < (int)scene->n_layer; i++) {
            check_print_jump(scene, i, pair->one, pair->other, pair->sigma);
            check_print_jump(scene, i, pair->other, pair->one, pair->sigma);
        }
        transport_print_tension(scene, model, k);
    }
}

static void check_print_module(const char *what, const struct instance *instance)
{
    const struct bulla_module *module = instance->module;
    printf("  %-12s %s:%s", what, module->kind, module->name);
    for (unsigned i = 0; i < instance_param_count(module); i++) {
        const struct bulla_param *param = &module->params[i];
        bool pure = !param->unit || strcmp(param->unit, "1") == 0;
        if (param->type == BULLA_NUMBER)
            printf("  %s %g%s%s", param->name, instance->values[i].number, pure ? "" : " ", pure ? "" : param->unit);
        else if (instance->values[i].text) printf("  %s %s", param->name, instance->values[i].text);
    }
    putchar('\n');
}

/* A strength beside its modulus, and the stress at which a plane wave becomes plastic (Hugoniot's elastic limit). */
static void check_print_strength(const struct model *model, unsigned l, double rho, double mu)
{
    const struct instance *plastic = &model->scene->material[l].plastic;
    const struct bulla_inelastic *law = plastic->module->table;
    const struct model_eos *eos = &model->eos[l];
    double none = 0, p = 101325, T = 300, Y, rho_e, K;
    char yield[HUMAN_ROOM], limit[HUMAN_ROOM];
    law->strength(plastic->self, 1, &none, &none, &p, &T, &rho, &Y);
    eos->law->state(eos->self, 1, &rho, &p, &rho_e, &K);
    check_print_module("", plastic);
    printf("  %-12s plastic: strength %s, %.3g of the shear modulus; elastic limit of plane waves %s\n", "",
           human_si(Y, "Pa", yield), Y / mu, human_si(Y * (K + 4.0 / 3.0 * mu) / (2.0 * mu), "Pa", limit));
    if (!(law->needs(plastic->self) & BULLA_INELASTIC_TEMPERATURE)) return;
    eos->law->temperature(eos->self, 1, &rho, &p, &T);
    printf("  %-12s its strength looks at temperatures: %.4g K at %g kg/m3 and 1 atm\n", "", T, rho);
}

/* How it breaks, how fast, and what then opens. */
static void check_print_damage(const struct scene *scene, const struct scene_damage *damage)
{
    char time[HUMAN_ROOM], pressure[HUMAN_ROOM];
    check_print_module("", &damage->law);
    printf("  %-12s breaks in %s at the fastest", "", human_si(damage->time, "s", time));
    if (damage->opens)
        printf("; where it is in tension a void of %s opens, at %s and %.3g kg/m3", scene->material[damage->gas].name,
               human_si(damage->pressure, "Pa", pressure), damage->density);
    putchar('\n');
}

/* Boundaries and fields that are modules. */
static void check_print_modules(const struct scene *scene)
{
    static const char *const faces[] = {"x-", "x+", "y-", "y+", "z-", "z+"};
    for (int face = 0; face < 2 * SCENE_AXES; face++) {
        const struct instance *law = &scene->domain.boundary[face / 2][face % 2].law;
        if (law->module) check_print_module(faces[face], law);
    }
    for (unsigned i = 0; i < scene->n_derived; i++)
        check_print_module(scene->derived[i].names[0], &scene->derived[i].law);
}

/* The Maxwell branches of a solid: each with its viscosity, and what waves feel that are faster than all of them. */
static void check_print_branches(const struct scene_material *material, double c2)
{
    char modulus[HUMAN_ROOM], time[HUMAN_ROOM], viscosity[HUMAN_ROOM], speed[HUMAN_ROOM];
    for (unsigned b = 0; b < material->n_branch; b++) {
        const struct scene_branch *branch = &material->branch[b];
        c2 += branch->modulus / branch->density;
        printf("  %-12s %s %s over %s: as viscous as %s in slow motion\n", "",
               b ? "and" : "viscoelastic:", human_si(branch->modulus, "Pa", modulus), human_si(branch->time, "s", time),
               human_si(branch->modulus * branch->time, "Pa s", viscosity));
    }
    if (material->n_branch)
        printf("  %-12s before they relax, shear waves at %s\n", "", human_si(sqrt(c2), "m/s", speed));
}

/* A material, and what makes it a solid. */
static void check_print_material(const struct scene *scene, const struct model *model, unsigned l)
{
    const struct scene_material *material = &scene->material[l];
    const struct instance *solid = &material->constitutive;
    char modulus[HUMAN_ROOM], speed[HUMAN_ROOM];
    double unstretched = 3, e, e_1, e_2, rho = model->eos[l].rho_fill;
    check_print_module(material->name, &material->eos);
    if (!solid->module) return;
    const struct bulla_constitutive *law = solid->module->table;
    law->energy(solid->self, 1, &unstretched, &unstretched, &e, &e_1, &e_2);
    double c2 = 2 * (e_1 + e_2); /* of shear waves, whatever the density (elastic.h) */
    check_print_module("", solid);
    printf("  %-12s a solid: shear modulus %s at %g kg/m3, shear waves at %s\n", "", human_si(rho * c2, "Pa", modulus),
           rho, human_si(sqrt(c2), "m/s", speed));
    check_print_branches(material, c2);
    if (material->plastic.module) check_print_strength(model, l, rho, rho * c2);
    if (material->damage.law.module) check_print_damage(scene, &material->damage);
}

static void check_print_fields(const struct model *model)
{
    printf("  %-12s %u:", "fields", model->n_field);
    for (unsigned i = 0; i < model->n_field; i++) printf(" %s", model->field_names[i]);
    putchar('\n');
}

/* Cells of the mesh at the start, by level. */
struct check_mesh {
    int n_level;
    double cells[MESH_LEVELS], all;
    double parts;   /* steps of the run for one that the coarsest level alone would take: more without subcycling */
    double updates; /* cells advanced during one of them */
};

/* Of a state; NULL: of the coarsest level alone. */
static void check_levels(const struct scene *scene, const struct state *state, struct check_mesh *ret)
{
    *ret = (struct check_mesh){.n_level = 1, .cells = {scenes_cells(scene)}};
    if (state) ret->n_level = state->mesh->n_level;
    for (int l = 0; state && l < ret->n_level; l++)
        ret->cells[l] = (double)state->mesh->levels[l].n_tile * (double)state->mesh->n_cell;
    ret->parts = scene->mesh.subcycle ? 1 : ldexp(1, ret->n_level - 1);
    for (int l = 0; l < ret->n_level; l++) {
        ret->all += ret->cells[l];
        ret->updates += scene->mesh.subcycle ? ldexp(ret->cells[l], l) : ret->cells[l];
    }
}

/* Builds the initial mesh if the case has levels and its coarsest is not too large for a check. */
static int check_count(const struct scene *scene, struct check_mesh *ret)
{
    struct state *state = NULL;
    if (scene->mesh.levels > 0 && scenes_bytes(scene, scenes_cells(scene)) <= check_build)
        TRY(state_new(scene, &state));
    check_levels(scene, state, ret);
    state_free(state);
    return STATUS_OK;
}

/* The scene on fewer cells: every axis by about the same factor, in multiples of 8 that tiles
 * can fill. *ret_ratio: how much smaller the time step of the full mesh is. */
static struct scene check_coarsen(const struct scene *scene, double *ret_ratio)
{
    struct scene coarse = *scene;
    coarse.mesh.levels = 0;
    int most = 1, limit = scene->domain.dim == 1 ? 8 * CHECK_COARSE : CHECK_COARSE;
    for (int axis = 0; axis < scene->domain.dim; axis++)
        most = scene->domain.cells[axis] > most ? scene->domain.cells[axis] : most;
    int factor = (most + limit - 1) / limit;
    *ret_ratio = 1;
    for (int axis = 0; axis < scene->domain.dim && factor > 1; axis++) {
        int cells = scene->domain.cells[axis] / factor / 8 * 8;
        if (scene->domain.cells[axis] > 8) coarse.domain.cells[axis] = cells > 8 ? cells : 8;
        double ratio = (double)scene->domain.cells[axis] / coarse.domain.cells[axis];
        if (ratio > *ret_ratio) *ret_ratio = ratio;
    }
    if (factor > 1) coarse.mesh.tile = 0;
    if (mesh_tile_size(&coarse)) return coarse;
    *ret_ratio = 1;
    coarse = *scene;
    coarse.mesh.levels = 0;
    return coarse;
}

/* Steps of the whole run if what the coarse copy has left is done in steps of `dt` there. */
static double check_all_steps(const struct scene *scene, const struct state *coarse, double dt, double factor)
{
    double left = scene->run.until - coarse->t, steps = factor * ((double)coarse->step + (left > 0 ? left / dt : 0));
    if (scene->scheme.dt_fixed > 0) steps = scene->run.until / scene->scheme.dt_fixed;
    return scene->run.max_steps > 0 ? fmin(ceil(steps), (double)scene->run.max_steps) : ceil(steps);
}

/* The fastest flow. */
static double check_speed(const struct state *state)
{
    const struct level *level = &state->mesh->levels[0];
    const struct model *model = state->model;
    size_t n = state->mesh->n_cell;
    double most = 0;
    for (unsigned t = 0; t < level->n_local; t++)
        for (size_t i = 0; i < n; i++) {
            double square = 0;
            for (unsigned d = 0; d < model->n_velocity; d++) square += pow(level->w[t][(model->i_u + d) * n + i], 2);
            most = fmax(most, square);
        }
    comm_max(&most, 1);
    return sqrt(most);
}

static int check_measure(struct state *coarse, double ratio, const struct scene *scene, const struct check_mesh *mesh,
                         struct check_cost *ret)
{
    double begin = cost_cpu(), spent = 0, dt = advance_dt(coarse), longest = dt, shortest = dt;
    bool coarser = ratio > 1.0 || scene->mesh.levels > 0; /* what a copy cannot do, the case may */
    long most = scene->run.max_steps, steps = most > 0 && most < CHECK_STEPS ? most : CHECK_STEPS;
    while (coarse->step < steps && coarse->t < scene->run.until && spent < check_moment) {
        dt = advance_dt(coarse);
        longest = fmax(longest, dt);
        shortest = fmin(shortest, dt);
        int code = advance_step(coarse, scene->run.until - coarse->t);
        if (code == STATUS_RUN && coarse->step > 0 && coarser) {
            log_warn("on a coarse copy of the mesh, %s", status_text());
            break;
        }
        TRY(code);
        spent = cost_cpu() - begin;
        comm_max(&spent, 1);
        ret->speed = fmax(ret->speed, check_speed(coarse));
    }
    double factor = ratio * mesh->parts;
    ret->coarse_steps = coarse->step;
    ret->steps = check_all_steps(scene, coarse, dt, factor);
    ret->least = check_all_steps(scene, coarse, longest, factor);
    ret->most = check_all_steps(scene, coarse, shortest, factor);
    ret->seconds = ret->steps * spent / (double)coarse->step * mesh->updates / scenes_cells(coarse->scene);
    return 0;
}

/* Levels, where they are at the start, and what asks for them. */
static void check_print_levels(const struct scene *scene, const struct check_mesh *mesh)
{
    char text[HUMAN_ROOM];
    if (scene->mesh.levels == 0) {
        if (scene->mesh.n_refine) printf("  %-12s 0: 'refine' is not used\n", "levels");
        return;
    }
    double finest = HUGE_VAL;
    for (int axis = 0; axis < scene->domain.dim; axis++)
        finest = fmin(finest, (scene->domain.upper[axis] - scene->domain.lower[axis]) /
                                  ldexp(scene->domain.cells[axis], scene->mesh.levels));
    printf("  %-12s %d above the coarsest, finest cells %s; regrid every %d steps, buffer %d%s\n", "levels",
           scene->mesh.levels, human_si(finest, "m", text), scene->mesh.regrid_every, scene->mesh.buffer,
           scene->mesh.subcycle ? ", subcycled" : "");
    for (unsigned i = 0; i < scene->mesh.n_refine; i++) {
        char *criterion = tag_describe(scene, i);
        printf("  %-12s %s\n", i ? "" : "refine", criterion);
        mem_free(criterion);
    }
    printf("  %-12s %s", "at the start", human_count(mesh->cells[0], text));
    for (int l = 1; l < mesh->n_level; l++) printf(" + %s", human_count(mesh->cells[l], text));
    printf(" cells\n");
}

static void check_print(const struct scene *scene, const struct model *model, const struct check_mesh *mesh)
{
    char text[HUMAN_ROOM];
    if (scene->title) printf("  %-12s %s\n", "title", scene->title);
    printf("  %-12s %dD %s, %d", "domain", scene->domain.dim, check_geometry[scene->domain.geometry],
           scene->domain.cells[0]);
    for (int axis = 1; axis < scene->domain.dim; axis++) printf(" x %d", scene->domain.cells[axis]);
    if (scene->domain.dim > 1) printf(" = %.0f", scenes_cells(scene));
    int tile = mesh_tile_size(scene);
    double tiles = 1;
    for (int axis = 0; axis < scene->domain.dim; axis++) tiles *= scene->domain.cells[axis] / (double)tile;
    printf(" cells in %.0f tiles of %d", tiles, tile);
    if (scene->domain.n_velocity > scene->domain.dim)
        printf("; velocities with %d components", scene->domain.n_velocity);
    putchar('\n');
    check_print_levels(scene, mesh);
    check_print_fields(model);
    for (unsigned i = 0; i < scene->n_material; i++) {
        check_print_material(scene, model, i);
        if (scene->material[i].viscosity.module) check_print_module("", &scene->material[i].viscosity);
        transport_print_viscosity(scene, model, i);
        if (scene->material[i].conductivity.module) check_print_module("", &scene->material[i].conductivity);
        transport_print_heat(scene, model, i);
    }
    printf("  %-12s %s\n", "closure", scene->scheme.closure == SCENE_KAPILA ? "kapila" : "allaire");
    check_print_module("riemann", &scene->scheme.riemann);
    check_print_module("scheme", &scene->scheme.reconstruction);
    check_print_module("limiter", &scene->scheme.limiter);
    if (scene->scheme.low_mach < 1.0)
        printf("  %-12s %g of a jump of velocity is what faces see of fluids at rest\n", "low-mach",
               scene->scheme.low_mach);
    check_print_modules(scene);
    check_print_sources(scene);
    check_print_tension(scene, model);
    transport_print_sticks(scene, model);
    travel_print(scene);
    check_phase_print(scene);
    transport_print_gases(scene, model);
    if (scene->n_material > 1) check_print_module("interface", &scene->scheme.interface_limiter);
    if (scene->scheme.along_limiter.module) check_print_module("along it", &scene->scheme.along_limiter);
    double bytes = SCENES_BESIDE * scenes_bytes(scene, mesh->all);
    printf("  %-12s about %s", "memory", human_bytes(bytes, text));
    if (bytes > mem_machine()) printf(": more than this machine has, %s", human_bytes(mem_machine(), text));
    putchar('\n');
    double beside = snapshot_memory(model, mesh->all);
    if (beside > 0.0)
        printf("  %-12s and up to %s for snapshots, to write them while the run goes on\n", "",
               human_bytes(beside, text));
}

static const char *check_seconds(double seconds, char text[HUMAN_ROOM])
{
    double digit = pow(10, floor(log10(fmax(seconds, 1e-300))) - 1); /* no more than two are meant */
    return seconds < 60 ? human_si(digit * round(seconds / digit), "s", text) : human_duration(seconds, text);
}

static void check_print_cost(const struct scene *scene, const struct check_cost *cost)
{
    char text[HUMAN_ROOM], least[HUMAN_ROOM], most[HUMAN_ROOM];
    const double *error = check_error[scene->mesh.levels > 0];
    printf("  %-12s until %s, about %.0f steps", "run", human_si(scene->run.until, "s", text), cost->steps);
    if (cost->most > 1.1 * cost->least) printf(" (%.0f to %.0f)", cost->least, cost->most);
    printf("\n  %-12s about %s of CPU time, %s to %s (from %ld steps on a coarse copy%s)\n", "time",
           check_seconds(cost->seconds, text),
           check_seconds(error[0] * cost->seconds * cost->least / cost->steps, least),
           check_seconds(error[1] * cost->seconds * cost->most / cost->steps, most), cost->coarse_steps,
           scene->mesh.levels > 0 ? "; levels as at the start, which may grow" : "");
    printf("  %-12s %s\n", "output", scene->output.directory);
}

/* The steps that remain if all are like the first. */
static double check_steps(const struct scene *scene, const struct state *state, double dt)
{
    double steps = ceil((scene->run.until - state->t) / dt), most = (double)(scene->run.max_steps - state->step);
    if (scene->run.max_steps > 0 && steps > most) steps = most;
    return steps > 0 ? steps : 0;
}

void check_ready(const struct scene *scene, const struct state *state)
{
    char begin[HUMAN_ROOM], end[HUMAN_ROOM], step[HUMAN_ROOM];
    struct check_mesh mesh;
    double dt = advance_dt(state);
    check_levels(scene, state, &mesh);
    if (comm_rank() != 0) return;
    printf("%s: ready\n", scene->path);
    check_print(scene, state->model, &mesh);
    printf("  %-12s %d\n", "ranks", comm_size());
    printf("  %-12s from %s, step %ld, until %s; the first step is %s: %.0f steps of that size\n", "run",
           human_si(state->t, "s", begin), state->step, human_si(scene->run.until, "s", end), human_si(dt, "s", step),
           check_steps(scene, state, dt));
    printf("  %-12s %s\n", "output", scene->output.directory);
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
    struct check_mesh mesh;
    if (!mesh_tile_size(scene)) code = STATUS_CASE;
    if (!code) code = check_count(scene, &mesh);
    if (!code) code = state_new(&coarse_scene, &coarse);
    if (!code) code = check_measure(coarse, ratio, scene, &mesh, &cost);
    if (code) cli_failed(code);
    else if (comm_rank() == 0) {
        printf("%s: good\n", scene->path);
        check_print(scene, coarse->model, &mesh);
        transport_print_reynolds(scene, coarse->model, cost.speed);
        transport_print_slow(scene, coarse->model, cost.speed);
        check_print_cost(scene, &cost);
    }
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
