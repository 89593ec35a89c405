/* scene_contact.c - angles at which surfaces with tension meet the walls of the domain. */
#include "case/scene_draft.h"

#include "base/mem.h"

#include <math.h>

/* Flatter than this a surface on a wall is a wedge thinner than the cells beside its edge [deg]. */
#define CONTACT_FLAT 15.0

#define CONTACT_DEGREE (M_PI / 180.0)

/* Beyond this a number is one of degrees whose unit was forgotten. */
#define CONTACT_MEANT 10.0

static bool scene_contact_place(struct draft *draft, const struct keys_value *section)
{
    if (draft->scene->domain.dim > 1) return true;
    keys_error(&draft->keys, section, "in one dimension no surface meets a wall at an angle");
    diag_help(draft->keys.diag, "leave it out, or give the domain a second axis");
    return false;
}

/* Between 0 and 180 degrees. */
static bool scene_contact_angle(struct draft *draft, const struct keys_value *value)
{
    double degrees = value->number / CONTACT_DEGREE;
    if (!(degrees < 180.0)) {
        keys_error(&draft->keys, value, "%g deg is no angle of contact, which lies between 0 and 180 deg", degrees);
        if (value->number >= CONTACT_MEANT && value->number < 180.0)
            diag_help(draft->keys.diag, "without a unit it is in rad: did you mean '%g deg'?", value->number);
        else
            diag_help(draft->keys.diag, "'60 deg': the first of the pair wets the wall; '120 deg': the other one does");
        return false;
    }
    if (degrees < CONTACT_FLAT || degrees > 180.0 - CONTACT_FLAT) {
        diag_warn(draft->keys.diag, &value->node->mark,
                  "%s: a wedge of %g deg is thinner than a cell for %.0f cells from its edge: this is not resolved",
                  value->path, fmin(degrees, 180.0 - degrees),
                  1.0 / tan(fmin(degrees, 180.0 - degrees) * CONTACT_DEGREE));
        diag_help(draft->keys.diag, "%g to %g deg are", CONTACT_FLAT, 180.0 - CONTACT_FLAT);
    }
    return true;
}

/* One row of the section. `seen`: pairs that have an angle here. */
static void scene_contact_pair(struct draft *draft, struct scene_boundary *boundary, const struct keys_value *value,
                               bool seen[SCENE_PAIRS])
{
    const struct scene *scene = draft->scene;
    unsigned one, other;
    if (!value->given || !scene_tension_split(draft, value, &one, &other)) return;
    unsigned k = scene_tension_find(scene, one, other);
    if (k == scene->n_tension) {
        keys_error(&draft->keys, value, "this pair has no surface tension, so nothing makes it keep an angle");
        diag_help(draft->keys.diag, "give it: 'surface-tension: {%s: 72.8 mN/m}'", value->name);
    } else if (seen[k]) {
        keys_error(&draft->keys, value, "this pair has an angle here already");
    } else if (scene_contact_angle(draft, value)) {
        double cosine = cos(value->number);
        if (fabs(cosine) < 1e-15) cosine = 0.0;
        seen[k] = true;
        boundary->cosine[k] = scene->tension[k].one == one ? cosine : -cosine;
    }
}

void scene_contact(struct draft *draft)
{
    static const char *const names[SCENE_AXES][2] = {{"x-", "x+"}, {"y-", "y+"}, {"z-", "z+"}};
    const struct keys_map *boundaries = keys_at(keys_at(draft->root, "domain")->map, "boundaries")->map;
    for (int face = 0; boundaries && face < 2 * draft->scene->domain.dim; face++) {
        const struct keys_map *map = keys_at(boundaries, names[face / 2][face % 2])->map;
        const struct keys_value *section = map ? keys_at(map, "contact-angle") : NULL;
        struct scene_boundary *boundary = &draft->scene->domain.boundary[face / 2][face % 2];
        bool seen[SCENE_PAIRS] = {false};
        if (!section || !section->node || !scene_contact_place(draft, section)) continue;
        for (unsigned i = 0; i < section->count; i++) scene_contact_pair(draft, boundary, &section->list[i], seen);
    }
}
