/* scene_rigid.c - rigid bodies: `bodies:`. Where they are is looked at on a lattice of points, at the start and, where
 * they move, at some times of the run. */
#include "case/scene_draft.h"

#include "base/mem.h"
#include "base/status.h"
#include "base/text.h"
#include "bulla/eos.h"
#include "case/pose.h"

#include <math.h>
#include <string.h>

enum { SCENE_RIGID_TIMES = 64, SCENE_RIGID_LOOKS = 9 }; /* at which speeds are taken, and places */

#define SCENE_RIGID_BRISK 1e7 /* a thousand times the speed of sound in anything [m/s] */

static const struct key scene_rigid_rows[] = {
    {.name = "velocity",
     .type = KEYS_NUMBER,
     .many = KEYS_LIST,
     .unit = "m/s",
     .min = -KEYS_MOST,
     .max = KEYS_MOST,
     .doc = "Constant velocity of the body, one number per axis; it rests if not given."},
    {.name = "displacement",
     .type = KEYS_VALUE,
     .many = KEYS_LIST,
     .unit = "m",
     .doc = "How far the body has moved, expressions of t, one per axis, instead of `velocity`."},
    {.name = "angle",
     .type = KEYS_VALUE,
     .unit = "rad",
     .doc = "By how much it has turned, counterclockwise from x to y: an expression of t. Cartesian geometry of two or "
            "three axes."},
    {.name = "pivot",
     .type = KEYS_NUMBER,
     .many = KEYS_LIST,
     .unit = "m",
     .doc = "The point about which it turns, before it is displaced; the origin if not given."},
    {0},
};

const struct keys_section scene_rigid_keys = {.name = "body",
                                              .doc = "A rigid body that stands still or moves as prescribed.",
                                              .base = &scene_shape_keys,
                                              .keys = scene_rigid_rows,
                                              .rules = "{'not': {'required': ['velocity', 'displacement']}}"};

/* What fluids do among themselves only: it is computed, so it is no error, but somebody may wait for it. */
static void scene_rigid_smooth(struct draft *draft, const struct keys_value *section)
{
    const struct scene *scene = draft->scene;
    struct diag *diag = draft->keys.diag;
    const char *viscous = NULL, *conducts = NULL;
    for (unsigned l = 0; l < scene->n_material; l++) {
        if (!viscous && scene->material[l].viscosity.module) viscous = scene->material[l].name;
        if (!conducts && scene->material[l].conductivity.module) conducts = scene->material[l].name;
    }
    if (viscous) {
        diag_warn(diag, &section->node->mark,
                  "bodies: '%s' is viscous, but fluids slip along bodies: they feel no friction", viscous);
        diag_help(diag, "walls of the domain can be 'no-slip'; a very viscous or dense material sticks, too");
    }
    if (conducts) {
        diag_warn(diag, &section->node->mark, "bodies: '%s' conducts heat, but none passes the walls of bodies",
                  conducts);
        diag_help(diag, "walls of the domain can have a temperature; a material in place of the body conducts");
    }
}

/* What is not computed beside bodies. */
static void scene_rigid_beside(struct draft *draft, const struct keys_value *section)
{
    const struct scene *scene = draft->scene;
    const char *solid = scene_matter_solid(draft);
    if (solid) {
        keys_error(&draft->keys, section, "'%s' is an elastic solid: beside rigid bodies only fluids are computed",
                   solid);
        diag_help(draft->keys.diag, "make it a fluid, or the body a stiff material");
    }
    if (scene->n_tension) {
        keys_error(&draft->keys, section,
                   "surface tension is not computed beside rigid bodies: no angle of contact is known");
        diag_help(draft->keys.diag, "leave 'surface-tension' out");
    }
    scene_rigid_smooth(draft, section);
    for (int axis = 0; axis < scene->domain.dim; axis++)
        if (scene_boundary_is(scene, 2 * axis, SCENE_BOUNDARY_WRAPS) && scene->domain.cells[axis] < 8)
            keys_error(&draft->keys, section, "beside bodies a periodic axis has at least 8 cells");
}

static void scene_rigid_motion(struct draft *draft, const struct keys_value *value, struct scene_rigid *rigid)
{
    const struct scene_domain *domain = &draft->scene->domain;
    const struct keys_value *velocity = keys_at(value->map, "velocity"), *way = keys_at(value->map, "displacement"),
                            *angle = keys_at(value->map, "angle"), *pivot = keys_at(value->map, "pivot");
    if (velocity->node && way->node) keys_error(&draft->keys, way, "a body has a velocity or a displacement, not both");
    if (velocity->given) scene_domain_vector(draft, velocity, rigid->velocity);
    if (way->given && domain->dim > 0 && way->count != (unsigned)domain->dim)
        keys_error(&draft->keys, way, "%d components are needed, one per axis, not %u", domain->dim, way->count);
    for (unsigned d = 0; way->given && d < way->count && d < SCENE_AXES; d++)
        rigid->displacement[d] = scene_state_value(&way->list[d]);
    rigid->angle = scene_state_value(angle);
    if (pivot->given) scene_domain_vector(draft, pivot, rigid->pivot);
    if (angle->node && (domain->dim < 2 || domain->geometry != SCENE_CARTESIAN))
        keys_error(&draft->keys, angle, "bodies turn in cartesian geometry of two or three axes");
    if (pivot->node && !angle->node) keys_error(&draft->keys, pivot, "without 'angle' nothing turns about this point");
    rigid->moves = velocity->given || way->given || angle->given;
    bool radial = rigid->velocity[0] != 0.0 || rigid->displacement[0].script || rigid->displacement[0].number != 0.0;
    if (domain->geometry == SCENE_CARTESIAN || !radial) return;
    keys_error(&draft->keys, velocity->node ? velocity : way,
               "around an axis or a centre no rigid body moves along the radius: write 0");
}

/* Its script has failed at a time. */
static bool scene_rigid_unknown(struct draft *draft, const struct keys_value *value, double t)
{
    keys_error(&draft->keys, value, "its motion is not known at t = %.6g s: %s", t, status_text());
    return false;
}

/* A finest cell, the smallest of its sides, at a speed that nothing has, rounded to a power of two: sums of times are
 * exact. */
static double scene_rigid_brief(const struct scene *scene)
{
    double least = INFINITY;
    int exponent;
    for (int d = 0; d < scene->domain.dim; d++) {
        double width = scene_domain_width(scene, d);
        least = width < least ? width : least;
    }
    frexp(least / SCENE_RIGID_BRISK, &exponent);
    return ldexp(1.0, exponent);
}

/* The corner of the domain that is farthest from the pivot. */
static double scene_rigid_reach(const struct scene_domain *domain, const double pivot[3])
{
    double square = 0.0;
    for (int d = 0; d < domain->dim; d++) {
        double below = fabs(pivot[d] - domain->lower[d]), above = fabs(domain->upper[d] - pivot[d]);
        double most = below > above ? below : above;
        square += most * most;
    }
    return sqrt(square);
}

/* Fastest point over the run, as some of its times tell [m/s]; false after an error. */
static bool scene_rigid_speed(struct draft *draft, const struct keys_value *value, const struct scene_rigid *rigid,
                              double *ret_fastest)
{
    for (int i = 0; i <= SCENE_RIGID_TIMES; i++) {
        struct pose_rate rate;
        double t = i * draft->scene->run.until / SCENE_RIGID_TIMES;
        if (pose_rate_at(rigid, t, &rate)) return scene_rigid_unknown(draft, value, t);
        double speed = pose_rate_most(rigid, &rate);
        *ret_fastest = speed > *ret_fastest ? speed : *ret_fastest;
    }
    return true;
}

/* Fastest sound of what is there at the start, as far as its states are constant [m/s]; 0: not known. */
static double scene_rigid_sound(const struct scene *scene)
{
    double most = 0.0;
    for (unsigned i = 0; i < scene->n_layer; i++) {
        const struct scene_layer *layer = &scene->layers[i];
        for (unsigned l = 0; layer->fractions && layer->density && l < scene->n_material; l++) {
            const struct instance *eos = &scene->material[l].eos;
            bool known = eos->module && layer->fractions[l] > 0.0 && layer->density[l].given &&
                         !layer->density[l].script && layer->pressure.given && !layer->pressure.script;
            double rho_e, rho_c2;
            if (!known) continue;
            const struct bulla_eos *law = eos->module->table;
            law->state(eos->self, 1, &layer->density[l].number, &layer->pressure.number, &rho_e, &rho_c2);
            double sound = sqrt(rho_c2 / layer->density[l].number);
            most = sound > most ? sound : most;
        }
    }
    return most;
}

/* A point of the lattice over the domain. */
static void scene_rigid_point(const struct scene_domain *domain, size_t index, size_t side, double ret[3])
{
    for (int d = 0; d < 3; d++, index /= side)
        ret[d] = d < domain->dim ? domain->lower[d] + ((double)(index % side) + 0.5) / (double)side *
                                                          (domain->upper[d] - domain->lower[d])
                                 : 0.0;
}

static bool scene_rigid_holds(const struct scene_rigid *rigid, const struct pose *pose, const double x[3])
{
    double at[3];
    pose_back(pose, x, at);
    return shape_level(rigid->shape, at) < 0.0;
}

/* Does a body reach into the domain, where points may all miss it? */
static bool scene_rigid_reaches(const struct scene_domain *domain, const struct scene_rigid *rigid,
                                const struct pose *pose)
{
    double lower[3] = {0.0}, upper[3] = {0.0};
    if (pose->turned) return true;
    for (int d = 0; d < domain->dim; d++) {
        lower[d] = domain->lower[d] - pose->shift[d];
        upper[d] = domain->upper[d] - pose->shift[d];
    }
    return shape_reaches(rigid->shape, lower, upper, domain->dim);
}

/* All bodies at one time; says what is wrong about the one at `which`, compared with those before it. */
static bool scene_rigid_look(struct draft *draft, const struct keys_value *section, unsigned which, double t)
{
    const struct scene *scene = draft->scene;
    const struct scene_domain *domain = &scene->domain;
    const struct keys_value *value = &section->list[which];
    size_t side = domain->dim == 3 ? 24 : domain->dim == 2 ? 64 : 1024, n = 1, inside = 0;
    struct pose pose[SCENE_RIGIDS];
    for (int d = 0; d < domain->dim; d++) n *= side;
    for (unsigned k = 0; k <= which; k++)
        if (pose_at(&scene->rigids[k], t, &pose[k])) return scene_rigid_unknown(draft, value, t);
    for (size_t i = 0; i < n; i++) {
        double x[3];
        scene_rigid_point(domain, i, side, x);
        if (!scene_rigid_holds(&scene->rigids[which], &pose[which], x)) continue;
        inside++;
        for (unsigned k = 0; k < which; k++) {
            if (!scene_rigid_holds(&scene->rigids[k], &pose[k], x)) continue;
            keys_error(&draft->keys, value, "it overlaps with '%s' at (%.6g, %.6g, %.6g) m, t = %.6g s",
                       scene->rigids[k].name, x[0], x[1], x[2], t);
            diag_help(draft->keys.diag, "make them one body with 'union', or move one");
            return false;
        }
    }
    if (inside == n) keys_error(&draft->keys, value, "it fills the whole domain at t = %.6g s", t);
    if (inside == 0 && !scene_rigid_reaches(domain, &scene->rigids[which], &pose[which])) {
        keys_error(&draft->keys, value,
                   t > 0.0 ? "it has left the domain at t = %.6g s" : "none of it is in the domain", t);
        diag_help(draft->keys.diag,
                  t > 0.0 ? "end the run before that, or let it move less" : "look at its place and size");
        return false;
    }
    return inside < n;
}

static void scene_rigid_place(struct draft *draft, const struct keys_value *section, unsigned which)
{
    const struct scene_rigid *rigid = &draft->scene->rigids[which];
    const struct keys_value *value = &section->list[which];
    double fastest = 0.0;
    bool any = false;
    if (!(draft->scene->run.until > 0.0)) return;
    if (rigid->moves && !scene_rigid_speed(draft, value, rigid, &fastest)) return;
    double sound = scene_rigid_sound(draft->scene);
    if (sound > 0.0 && fastest > sound) {
        keys_error(&draft->keys, value, "it moves with up to %.6g m/s, faster than sound at the start, %.6g m/s",
                   fastest, sound);
        diag_help(draft->keys.diag, "let the fluid flow towards a body at rest, or let it move more slowly");
        return;
    }
    for (unsigned k = 0; k <= which; k++) any = any || draft->scene->rigids[k].moves;
    for (int i = 0; i < (any ? SCENE_RIGID_LOOKS : 1); i++)
        if (!scene_rigid_look(draft, section, which, i * draft->scene->run.until / (SCENE_RIGID_LOOKS - 1))) return;
}

static bool scene_rigid_read(struct draft *draft, const struct keys_value *value)
{
    struct scene *scene = draft->scene;
    struct scene_rigid *rigid = &scene->rigids[scene->n_rigid];
    const struct keys_value *shape;
    *rigid = (struct scene_rigid){.shape = value->map ? scene_shape(draft, value->map, true, &shape) : NULL};
    if (!rigid->shape) return false;
    snprintf(rigid->name, sizeof rigid->name, "%s", value->name);
    scene->n_rigid++;
    scene_rigid_motion(draft, value, rigid);
    rigid->reach = scene_rigid_reach(&scene->domain, rigid->pivot);
    rigid->brief = scene_rigid_brief(scene);
    if (rigid->moves && scene->scheme.integrator != SCENE_MIDPOINT)
        keys_error(&draft->keys, value, "bodies move with 'integrator: midpoint' alone");
    return true;
}

/* Bodies always lie in the finest cells. */
static void scene_rigid_refine(struct scene *scene)
{
    struct scene_mesh *mesh = &scene->mesh;
    if (mesh->levels == 0) return;
    mesh->refines[mesh->n_refine++] = (struct scene_refine){
        .kind = SCENE_REFINE_BODIES, .material = -1, .finest = mesh->levels, .t_from = -INFINITY, .t_until = INFINITY};
}

void scene_rigid(struct draft *draft)
{
    const struct keys_value *section = keys_at(draft->root, "bodies");
    bool good = draft->scene->domain.dim > 0;
    if (!section->node || section->count == 0) return;
    if (section->count > SCENE_RIGIDS) {
        keys_error(&draft->keys, section, "%u bodies are more than %d", section->count, SCENE_RIGIDS);
        diag_help(draft->keys.diag, "'union' makes one body of several shapes");
        return;
    }
    scene_rigid_beside(draft, section);
    for (unsigned i = 0; i < section->count; i++) good = scene_rigid_read(draft, &section->list[i]) && good;
    for (unsigned i = 0; good && i < section->count; i++) scene_rigid_place(draft, section, i);
    scene_rigid_refine(draft->scene);
}

int scene_rigid_index(struct draft *draft, const struct keys_value *value)
{
    const struct scene *scene = draft->scene;
    const char *names[SCENE_RIGIDS + 1] = {NULL};
    if (!value->given) return -1;
    for (unsigned k = 0; k < scene->n_rigid; k++) {
        names[k] = scene->rigids[k].name;
        if (strcmp(names[k], value->text) == 0) return (int)k;
    }
    keys_error(&draft->keys, value, "'%s' is no body of this case", value->text);
    diag_suggest(draft->keys.diag, value->text, names);
    return -1;
}
