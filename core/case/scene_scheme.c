/* scene_scheme.c - the numerical method. */
#include "case/scene_draft.h"

#define MODULE_SECTION(kind_name, what, word, why)                                                                 \
    static const struct key scene_scheme_##kind_name##_type[] = {                                                  \
        {.name = "type", .type = KEYS_CHOICE, .required = true, .refused = word, .later = why, .doc = what}, {0}}; \
    static const struct keys_section scene_scheme_##kind_name = {.name = #kind_name,                               \
                                                                 .doc = what,                                      \
                                                                 .keys = scene_scheme_##kind_name##_type,          \
                                                                 .selector = "type",                               \
                                                                 .kind = #kind_name};

MODULE_SECTION(riemann, "The Riemann solver.", "hlld",
               "hlld is for solids, and this version computes fluids only: use hllc")
MODULE_SECTION(limiter, "The slope limiter.", NULL, NULL)

static const struct key scene_scheme_rows[] = {
    {.name = "closure",
     .type = KEYS_CHOICE,
     .choices = "kapila|allaire",
     .fallback = "kapila",
     .doc = "Volume fractions: kapila compresses each material by its own stiffness, allaire only advects."},
    {.name = "riemann",
     .type = KEYS_SECTION,
     .section = &scene_scheme_riemann,
     .fallback = "hllc",
     .doc = "The Riemann solver: a name, or {type: NAME, ...} with its keys."},
    {.name = "limiter",
     .type = KEYS_SECTION,
     .section = &scene_scheme_limiter,
     .fallback = "mc",
     .doc = "The slope limiter: a name, or {type: NAME, ...} with its keys."},
    {.name = "interface-limiter",
     .type = KEYS_SECTION,
     .section = &scene_scheme_limiter,
     .fallback = "superbee",
     .doc = "The limiter of the volume fractions: superbee keeps material interfaces within two or three cells; give "
            "the same as `limiter` for one limiter throughout."},
    {.name = "integrator",
     .type = KEYS_CHOICE,
     .choices = "midpoint",
     .fallback = "midpoint",
     .doc = "The time integrator: the midpoint rule, second order."},
    {.name = "cfl",
     .type = KEYS_NUMBER,
     .unit = "1",
     .min = KEYS_POSITIVE,
     .max = 1,
     .fallback = "0.4",
     .doc = "Courant number of the time step."},
    {.name = "dt",
     .type = KEYS_NUMBER,
     .unit = "s",
     .min = KEYS_POSITIVE,
     .max = KEYS_MOST,
     .doc = "A fixed time step instead of one from the Courant number."},
    {.name = "guard",
     .type = KEYS_CHOICE,
     .choices = "normal|strict",
     .fallback = "normal",
     .doc = "normal: troubled cells are redone at first order and counted; strict: that is an error."},
    {0},
};

const struct keys_section scene_scheme_keys = {.name = "scheme",
                                               .doc = "The numerical method.",
                                               .keys = scene_scheme_rows};

void scene_scheme(struct draft *draft)
{
    const struct keys_map *scheme = keys_at(draft->root, "scheme")->map, *run = keys_at(draft->root, "run")->map;
    struct scene *scene = draft->scene;
    scene->closure = (enum scene_closure)keys_at(scheme, "closure")->integer;
    scene->guard = (enum scene_guard)keys_at(scheme, "guard")->integer;
    scene->cfl = keys_at(scheme, "cfl")->number;
    scene->dt_fixed = keys_at(scheme, "dt")->number;
    scene_material_open(draft, keys_at(scheme, "riemann"), &scene->riemann);
    scene_material_open(draft, keys_at(scheme, "limiter"), &scene->limiter);
    scene_material_open(draft, keys_at(scheme, "interface-limiter"), &scene->interface_limiter);
    scene->until = keys_at(run, "until")->number;
    scene->max_steps = keys_at(run, "max-steps")->integer;
    script_limit(scene->host, keys_at(run, "script-time")->number);
}
