/* travel.c - see travel.h. */
#include "run/travel.h"

#include "base/log.h"
#include "case/pose.h"
#include "case/scene_boundary.h"
#include "cli/human.h"
#include "io/ledger.h"

#include <stdio.h>

enum { TRAVEL_TIMES = 64 };

static bool travel_any(const struct scene *scene)
{
    bool any = false;
    for (unsigned k = 0; k < scene->n_rigid; k++) any = any || scene->rigids[k].moves;
    return any;
}

/* Does anything but bodies change the mass in the domain? */
static bool travel_is_open(const struct scene *scene)
{
    bool open = false;
    for (int face = 0; face < 2 * scene->domain.dim; face++)
        open = open || scene_boundary_is(scene, face, SCENE_BOUNDARY_OPEN) ||
               scene->domain.boundary[face / 2][face % 2].type == SCENE_BOUNDARY_MODULE;
    const struct scene_sources *sources = scene->sources;
    for (int i = SCENE_SOURCE_MASS; sources && i < SCENE_SOURCE_FRACTION; i++) open = open || sources->value[i].given;
    return open || (sources && sources->script);
}

static double travel_mass(const struct state *state)
{
    struct ledger ledger;
    double mass = 0.0;
    ledger_take(state, &ledger);
    for (unsigned l = 0; l < state->model->n_material; l++) mass += ledger.total[l];
    return mass;
}

struct travel travel_begin(const struct state *state)
{
    struct travel travel = {.told = travel_any(state->scene) && !travel_is_open(state->scene)};
    if (travel.told) travel.mass = travel_mass(state);
    return travel;
}

void travel_say(const struct travel *travel, const struct state *state)
{
    if (!travel->told) return;
    double change = travel_mass(state) / travel->mass - 1.0;
    log_note(
        "bodies that move: the mass of the fluids has changed by %.2g of itself, which no boundary has let through",
        change);
}

/* Fastest point at some times of the run. */
static double travel_speed(const struct scene *scene, const struct scene_rigid *rigid)
{
    double most = 0.0;
    for (int i = 0; i <= TRAVEL_TIMES; i++) {
        struct pose_rate rate;
        if (pose_rate_at(rigid, i * scene->run.until / TRAVEL_TIMES, &rate)) break;
        double speed = pose_rate_most(rigid, &rate);
        most = speed > most ? speed : most;
    }
    return most;
}

void travel_print(const struct scene *scene)
{
    for (unsigned k = 0; k < scene->n_rigid; k++) {
        const struct scene_rigid *rigid = &scene->rigids[k];
        char speed[HUMAN_ROOM];
        printf("  %-12s %s: ", k ? "" : "bodies", rigid->name);
        if (rigid->moves) printf("moves with up to %s\n", human_si(travel_speed(scene, rigid), "m/s", speed));
        else printf("rests\n");
    }
    if (scene->n_rigid) printf("  %-12s fluids slip along them, and no heat passes\n", "");
    if (travel_any(scene)) printf("  %-12s those that move cost a little of the mass and energy beside them\n", "");
}
