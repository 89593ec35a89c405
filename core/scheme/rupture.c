/* rupture.c - see rupture.h. */
#include "scheme/rupture.h"

#include "phys/cavity.h"
#include "phys/damage.h"

static bool rupture_wanted(const struct model *path)
{
    return path->damaged;
}

/* Does a path hold a solid that opens, and not what fills the void? */
static bool rupture_spreads(const struct model *path)
{
    bool opens = false;
    for (unsigned s = 0; s < path->n_solid; s++)
        opens = opens || path->scene->material[path->first + path->solids[s].material].damage.opens;
    return opens && path->n_material < path->scene->n_material;
}

static void rupture_acts(const struct operator_tile *tile)
{
    const struct model *model = tile->model;
    damage_grow(model, tile->n_cell, tile->n_cell, tile->dt, tile->w, model->plastic ? tile->grown : NULL, tile->u);
    cavity_open(model, tile->n_cell, tile->n_cell, tile->w, tile->u);
}

static void rupture_say(const struct scene *scene, struct text *text)
{
    const char *comma = ": ";
    for (unsigned l = 0; l < scene->n_material; l++) {
        const struct scene_damage *damage = &scene->material[l].damage;
        if (!damage->law.module) continue;
        text_add(text, "%s%s %s", comma, scene->material[l].name, damage->law.module->name);
        if (damage->opens) text_add(text, " opens %s", scene->material[damage->gas].name);
        comma = ", ";
    }
}

const struct operator rupture_operator = {
    .name = "rupture",
    .owner = "core/scheme/rupture.c",
    .equation = "dD/dt = min(rate, 1/time) towards the law's aim; e^s (1 - D)^2, what it frees is heat",
    .when = OPERATOR_STEP,
    .wanted = rupture_wanted,
    .moves = true,
    .spreads = rupture_spreads,
    .reads = rupture_wanted,
    .acts = rupture_acts,
    .say = rupture_say,
};
