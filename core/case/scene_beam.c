/* scene_beam.c - the ways of waves at the domain's faces: direction or focus of one that comes in (the keys of beam.h
 * beside those of a pulse), origin of those that leave. */
#include "case/scene_draft.h"

#include "case/pulse.h"

#include <math.h>
#include <string.h>

#define POINT(word, unit_of, text)                                                         \
    {                                                                                      \
        .name = word, .type = KEYS_NUMBER, .many = KEYS_LIST, .unit = unit_of, .doc = text \
    }

static const struct key scene_beam_plane_rows[] = {
    {.name = "along",
     .type = KEYS_NUMBER,
     .many = KEYS_LIST,
     .unit = "1",
     .required = true,
     .doc = "Where the wave goes; any length."},
    POINT("from", "m",
          "The pulse is there after its delay; the corner of the domain that the wave meets first if not given."),
    {0}};

static const struct key scene_beam_focus_rows[] = {
    {.name = "at", .type = KEYS_NUMBER, .many = KEYS_LIST, .unit = "m", .required = true, .doc = "The focus."},
    {.name = "radius",
     .type = KEYS_NUMBER,
     .unit = "m",
     .min = KEYS_POSITIVE,
     .max = KEYS_MOST,
     .required = true,
     .doc =
         "Distance from the transducer to the focus: there the pulse has its amplitude, and begins after its delay."},
    {.name = "aperture",
     .type = KEYS_NUMBER,
     .unit = "rad",
     .min = KEYS_POSITIVE,
     .max = M_PI,
     .fallback = "3.141592653589793",
     .doc = "Half of the angle under which the transducer is seen from the focus: `40 deg`."},
    POINT("along", "1", "Direction of its axis; the inward normal of the face if not given."),
    {0}};

const struct keys_section scene_beam_plane_keys = {.name = "direction",
                                                   .doc = "A plane wave under an angle.",
                                                   .keys = scene_beam_plane_rows};
const struct keys_section scene_beam_focus_keys = {.name = "focus",
                                                   .doc = "A wave from a curved transducer to its focus.",
                                                   .keys = scene_beam_focus_rows};

/* The corner of the domain that a plane wave meets first. */
static void scene_beam_corner(const struct scene *scene, struct scene_beam *beam)
{
    for (int d = 0; d < scene->domain.dim; d++)
        beam->point[d] = beam->way[d] >= 0.0 ? scene->domain.lower[d] : scene->domain.upper[d];
}

static void scene_beam_read_plane(struct draft *draft, struct scene_beam *beam, const struct keys_map *map)
{
    const struct keys_value *from = keys_at(map, "from");
    if (!scene_domain_direction(draft, keys_at(map, "along"), beam->way)) return;
    scene_beam_corner(draft->scene, beam);
    if (from->node && !scene_domain_vector(draft, from, beam->point)) return;
    beam->path = SCENE_BEAM_PLANE;
}

/* How the pressure of a wave around a point falls: with 1/r, in the plane with its root. */
static double scene_beam_power(const struct scene *scene)
{
    return scene->domain.dim == 2 && scene->domain.geometry == SCENE_CARTESIAN ? 0.5 : 1.0;
}

static void scene_beam_read_focus(struct draft *draft, struct scene_beam *beam, const struct keys_map *map, int axis,
                                  int side)
{
    const struct keys_value *along = keys_at(map, "along");
    beam->way[axis] = side ? -1.0 : 1.0;
    if (!scene_domain_vector(draft, keys_at(map, "at"), beam->point) || !keys_at(map, "radius")->given) return;
    if (along->node && !scene_domain_direction(draft, along, beam->way)) return;
    beam->radius = keys_at(map, "radius")->number;
    beam->cosine = cos(keys_at(map, "aperture")->number);
    beam->power = scene_beam_power(draft->scene);
    beam->path = SCENE_BEAM_FOCUS;
}

/* Round geometries have waves that keep them: along the axis, or to a focus on it. */
static void scene_beam_round(struct draft *draft, struct scene_beam *beam, const struct keys_value *value)
{
    const struct scene_domain *domain = &draft->scene->domain;
    bool axial = beam->path == SCENE_BEAM_FOCUS ? beam->point[0] == 0.0 : beam->way[0] == 0.0;
    if (domain->geometry == SCENE_CARTESIAN || (domain->dim > 1 && axial)) return;
    keys_error(&draft->keys, value, "this wave is not one around an axis");
    diag_help(draft->keys.diag, "in axisymmetric scenes a focus lies at r = 0, a plane wave goes along the axis");
    beam->path = SCENE_BEAM_NORMAL;
}

void scene_beam(struct draft *draft, struct scene_boundary *boundary, const struct keys_map *map, int axis, int side)
{
    const struct keys_value *plane = keys_at(map, "direction"), *focus = keys_at(map, "focus");
    struct scene_beam *beam = &boundary->beam;
    if (!plane->node && !focus->node) return;
    if (plane->node && focus->node) {
        keys_error(&draft->keys, focus, "a wave has a direction or a focus, not both");
        return;
    }
    if (draft->scene->domain.dim < 2) {
        keys_error(&draft->keys, plane->node ? plane : focus, "in one dimension waves come along the axis");
        return;
    }
    if (plane->map) scene_beam_read_plane(draft, beam, plane->map);
    if (focus->map) scene_beam_read_focus(draft, beam, focus->map, axis, side);
    if (beam->path == SCENE_BEAM_NORMAL) return;
    beam->speed = keys_at(map, "sound-speed")->given ? keys_at(map, "sound-speed")->number : NAN;
    scene_beam_round(draft, beam, plane->node ? plane : focus);
}

/* Why no wave leaves from this point through a face; NULL: it does. */
static const char *scene_beam_lost(const struct draft *draft, const double point[SCENE_AXES], int axis, int side)
{
    const struct scene_domain *domain = &draft->scene->domain;
    double face = side ? domain->upper[axis] : domain->lower[axis],
           inwards = side ? face - point[axis] : point[axis] - face;
    if (domain->geometry == SCENE_SPHERICAL) return "waves leave a ball from its centre";
    if (domain->dim < 2) return "in one dimension waves leave along the axis";
    if (domain->geometry == SCENE_AXISYMMETRIC && point[0] != 0.0)
        return "waves around an axis come from a point on it";
    if (scene_matter_solid(draft)) return "in scenes with a solid waves leave as plane ones";
    return inwards > 0.0 ? NULL : "this point lies behind the face, so waves from there would come in";
}

void scene_beam_origin(struct draft *draft, struct scene_boundary *boundary, const struct keys_map *map, int axis,
                       int side)
{
    const struct keys_value *origin = keys_at(map, "origin");
    struct scene_beam *beam = &boundary->beam;
    beam->power = scene_beam_power(draft->scene);
    if (draft->scene->domain.geometry == SCENE_SPHERICAL && side) beam->path = SCENE_BEAM_ORIGIN;
    if (!origin->node || !scene_domain_vector(draft, origin, beam->point)) return;
    const char *lost = scene_beam_lost(draft, beam->point, axis, side);
    beam->path = SCENE_BEAM_ORIGIN;
    if (!lost) return;
    keys_error(&draft->keys, origin, "%s", lost);
    diag_help(draft->keys.diag, draft->scene->domain.dim < 2 || scene_matter_solid(draft)
                                    ? "leave 'origin' out"
                                    : "give the middle of what sends them out, 'origin: [0, 1 mm]', or leave it out");
}

void scene_beam_speed(struct draft *draft, struct scene_boundary *boundary, const struct keys_value *value,
                      double sound)
{
    struct scene_beam *beam = &boundary->beam;
    if (beam->path == SCENE_BEAM_FOCUS) pulse_sum(boundary, draft->scene->run.until);
    if (beam->path == SCENE_BEAM_NORMAL || beam->speed > 0.0) return;
    beam->speed = sound;
    if (sound > 0.0) return;
    keys_error(&draft->keys, value, "the speed of sound at this face is not known from the initial state");
    diag_help(draft->keys.diag, "give it: 'sound-speed: 1500 m/s'");
}
