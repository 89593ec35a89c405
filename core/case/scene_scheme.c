/* scene_scheme.c - the numerical method. */
#include "case/scene_draft.h"

#include "bulla/constitutive.h"
#include "bulla/eos.h"
#include "bulla/reconstruction.h"
#include "bulla/riemann.h"
#include "case/keys_read.h"
#include "case/script_host.h"
#include "plug/vet.h"

#include <stddef.h>
#include <stdlib.h>
#include <string.h>

#define MODULE_SECTION(kind_name, what)                                                                   \
    static const struct key scene_scheme_##kind_name##_type[] = {                                         \
        {.name = "type", .type = KEYS_CHOICE, .required = true, .doc = what}, {0}};                       \
    static const struct keys_section scene_scheme_##kind_name = {.name = #kind_name,                      \
                                                                 .doc = what,                             \
                                                                 .keys = scene_scheme_##kind_name##_type, \
                                                                 .selector = "type",                      \
                                                                 .kind = #kind_name};

MODULE_SECTION(riemann, "The Riemann solver.")
MODULE_SECTION(reconstruction, "From cells to the values at their faces.")
MODULE_SECTION(limiter, "The slope limiter.")

static const struct key scene_scheme_rows[] = {
    {.name = "closure",
     .type = KEYS_CHOICE,
     .choices = "kapila|allaire",
     .fallback = "kapila",
     .doc = "Volume fractions: kapila compresses each material by its own stiffness, allaire only advects."},
    {.name = "riemann",
     .type = KEYS_SECTION,
     .section = &scene_scheme_riemann,
     .doc =
         "The Riemann solver: a name, or {type: NAME, ...} with its keys. Default: hlld where a material is a solid, "
         "else hllc."},
    {.name = "reconstruction",
     .type = KEYS_SECTION,
     .section = &scene_scheme_reconstruction,
     .fallback = "muscl",
     .doc = "From cells to the values at their faces: a name, or {type: NAME, ...} with its keys. muscl takes the "
            "slopes of "
            "the limiters; other schemes fall back on them where they would overshoot."},
    {.name = "limiter",
     .type = KEYS_SECTION,
     .section = &scene_scheme_limiter,
     .doc =
         "The slope limiter: a name, or {type: NAME, ...} with its keys. Default: van-albada where a solid is plastic, "
         "because with mc and van-leer plastic shocks converge to wrong ones; else mc."},
    {.name = "interface-limiter",
     .type = KEYS_SECTION,
     .section = &scene_scheme_limiter,
     .doc =
         "The limiter of the volume fractions. Default: thinc where fluids have surface tension in the plane, around "
         "an axis or in space, because it keeps their fronts thin, as curvatures want them; van-albada where an "
         "elastic solid whose "
         "shear waves are faster than 100 m/s meets a gas there, because steeper slopes let it shake; else superbee, "
         "which keeps material interfaces within two or three cells. Give the same as `limiter` for one limiter "
         "throughout."},
    {.name = "interface-along",
     .type = KEYS_CHOICE,
     .choices = "auto|normal|axes",
     .fallback = "auto",
     .doc = "Along what the interface limiter acts in two and three dimensions. normal: along each axis the part n_d^2 "
            "of it, n the normal of the surface, and `along-limiter` for the rest, so that surfaces that move along "
            "themselves get no teeth, which their curvature would see; axes: all of it along every axis, which is "
            "cheaper. auto: normal where fluids have surface tension and there is no solid; else axes."},
    {.name = "along-limiter",
     .type = KEYS_SECTION,
     .section = &scene_scheme_limiter,
     .doc = "The limiter of the volume fractions along their surface, with `interface-along: normal`. Default: that of "
            "`limiter`, whose slopes are best for drops that move."},
    {.name = "exchange",
     .type = KEYS_CHOICE,
     .choices = "auto|fast|full",
     .fallback = "auto",
     .doc = "Whether what flows into a mixed cell from another pressure takes up the volume that is its own at the new "
            "one "
            "(kapila). full: yes, which keeps temperatures at interfaces right; fast: only in mixtures that outrun "
            "their own "
            "sound, which gives least radii of coarse bubbles 1 % closer. auto: fast where all laws are linear in "
            "pressure "
            "(ideal-gas to mnasg, tait), else full."},
    {.name = "traction",
     .type = KEYS_CHOICE,
     .choices = "auto|common|pressure",
     .fallback = "auto",
     .doc = "What solids and fluids of one cell share. common: the traction on their interface, so that each has the "
            "pressure that it needs for that; pressure: one pressure, which heats and shakes the surfaces of stretched "
            "solids. auto: common; pressure in the plane and in space for solids that flow (plastic, or with Maxwell "
            "branches)."},
    {.name = "surface-shear",
     .type = KEYS_CHOICE,
     .choices = "auto|free|kept",
     .fallback = "auto",
     .doc =
         "What solids bear of shear on their surface in cells that they share with fluids. free: nothing, as a fluid "
         "bears none; kept: what the one velocity of such cells shears them by, which drags and shakes what slides "
         "past a gas. auto: free where an elastic solid whose shear waves are faster than 100 m/s shares traction "
         "with a fluid whose rho c^2 is below 10 MPa at 1 atm, in the plane, around an axis or in space; else kept, "
         "as stretched solids rest better with it."},
    {.name = "surface-strain",
     .type = KEYS_CHOICE,
     .choices = "auto|share|face",
     .fallback = "auto",
     .doc =
         "What strains solids in cells that they share with fluids. share: the velocity of a face as far as the solids "
         "of the cell come there, else that of the cell, so that a gas that lies at the face does not strain them; "
         "face: that of the face, whatever lies there, by which stiff solids shake in a gas, the more the sharper "
         "their surface is. auto: share where a solid whose shear waves are faster than 100 m/s meets a fluid whose "
         "rho c^2 is below 10 MPa at 1 atm, in the plane, around an axis or in space; else, and with allaire, face, by "
         "which a solid that slides along a liquid pushes it less."},
    {.name = "mixture-speed",
     .type = KEYS_CHOICE,
     .choices = "auto|frozen|wood",
     .fallback = "auto",
     .doc =
         "Speed of sound that mixtures show to the Riemann solver at faces where cells move apart. frozen: the largest "
         "there is, which nothing breaks and which smears slow waves of boiling mixtures; wood: that of one pressure. "
         "auto: wood where all materials are liquids and vapours of pairs that change phase, and no liquid conducts; "
         "else frozen. Time steps have the frozen one."},
    {.name = "low-mach",
     .type = KEYS_NUMBER,
     .unit = "1",
     .min = KEYS_POSITIVE,
     .max = 1,
     .doc =
         "Faces in slow flow: how much of a jump of velocity a fluid at rest shows to the Riemann solver; more where "
         "it moves and where pressure jumps. 0.05 leaves a tenth of the numerical damping of slow bubbles; 1: all "
         "of it, but at surfaces where a liquid evaporates (onset), which have at most 0.05. Default: 0.05 for several "
         "fluids, or a viscous one, around a centre or an axis, in the plane or in space; 1 on a line, for one fluid "
         "without viscosity, beside solids, with surface tension but around a centre, and for hancock with a cfl above "
         "0.5 per axis, which is wrong without the damping."},
    {.name = "shock-fronts",
     .type = KEYS_CHOICE,
     .choices = "plain|calm",
     .fallback = "plain",
     .doc = "calm: faces along which a strong shock runs resist shear, which keeps the front of shocks along the mesh "
            "plane "
            "(no carbuncle) with any Riemann solver; contacts stay as sharp. In two and three dimensions, for fluids."},
    {.name = "integrator",
     .type = KEYS_CHOICE,
     .choices = "midpoint|ssprk3|hancock",
     .fallback = "midpoint",
     .doc = "The time integrator. midpoint: two stages, second order. ssprk3: the three stages of Shu and Osher, third "
            "order in time; half as dear again, and one array more. hancock: the first of the two stages from the "
            "slopes of "
            "the cells alone, second order and cheaper; for fluids that neither conduct nor are viscous, without phase "
            "change, tension and bodies."},
    {.name = "diffusion",
     .type = KEYS_CHOICE,
     .choices = "explicit|rkl2",
     .fallback = "explicit",
     .doc =
         "How viscosity and conduction are stepped. explicit: with all else, in steps of h^2 where they are the "
         "shorter ones. rkl2: in s stages of their own per stage of the integrator, whose number grows with the root "
         "of the steps that are saved, and none where explicit steps do; for gels and gas at low pressure, with "
         "three arrays more. With finer levels or several materials: all levels together, half before and half after "
         "each step of the coarsest."},
    {.name = "cfl",
     .type = KEYS_NUMBER,
     .unit = "1",
     .min = KEYS_POSITIVE,
     .max = 1,
     .doc = "Courant number of the time step, summed over axes. Default: 0.8 in two and three dimensions, 0.4 in one, "
            "with allaire, phase change or bodies."},
    {.name = "first-step",
     .type = KEYS_NUMBER,
     .unit = "1",
     .min = KEYS_POSITIVE,
     .max = 1,
     .doc =
         "The first time step as a part of the one that cfl allows; each step takes a tenth more of it, until all. "
         "Jumps of the initial state need small steps until they have become waves. Default: 0.05 where cfl is above "
         "0.5 per axis, else 1."},
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

/* Keys whose defaults were found here stand where they would in a case that gives all. */
static void scene_scheme_order(struct node *scheme)
{
    for (size_t row = sizeof scene_scheme_rows / sizeof *scene_scheme_rows - 1; row-- > 0;) {
        int at = tree_find(scheme, scene_scheme_rows[row].name);
        if (at >= 0) tree_first(scheme, (unsigned)at);
    }
}

/* What a case without a word about it gets; it stands in the resolved case, in the order of the table. */
static struct keys_value scene_scheme_default(struct draft *draft, const struct keys_value *absent,
                                              const struct keys_section *section, const char *name)
{
    struct keys_value value = *absent;
    struct node *scheme = keys_at(draft->root, "scheme")->map->node;
    value.node = tree_scalar(draft->keys.forest, &scheme->mark, TREE_PLAIN, name);
    value.map = keys_read(&draft->keys, value.node, section, value.path);
    tree_set(draft->keys.forest, scheme, absent->key->name, value.node);
    scene_scheme_order(scheme);
    return value;
}

/* A scene with a solid needs a solver that knows of stress. Tables of older modules end before they say so. */
static void scene_scheme_solid(struct draft *draft, const struct keys_value *riemann)
{
    const struct scene *scene = draft->scene;
    const struct bulla_module *module = scene->scheme.riemann.module;
    unsigned solid = 0;
    while (solid < scene->n_material && !scene->material[solid].constitutive.module) solid++;
    if (solid == scene->n_material || !module) return;
    const struct bulla_riemann *table = module->table;
    bool told = table->size >= offsetof(struct bulla_riemann, solids) + sizeof table->solids;
    if (told && table->solids) return;
    keys_error(&draft->keys, riemann, "'%s' computes fluids only, but '%s' is a solid", module->name,
               scene->material[solid].name);
    diag_help(draft->keys.diag, "'riemann: hlld' transmits shear waves too");
}

static void scene_scheme_riemann_open(struct draft *draft, const struct keys_map *scheme)
{
    const struct keys_value *riemann = keys_at(scheme, "riemann");
    struct keys_value value = *riemann;
    if (!scheme) return;
    if (!riemann->node && !riemann->meant)
        value =
            scene_scheme_default(draft, riemann, &scene_scheme_riemann, scene_matter_solid(draft) ? "hlld" : "hllc");
    scene_matter_open(draft, &value, &draft->scene->scheme.riemann);
    scene_scheme_solid(draft, &value);
}

/* Plastic shocks want a limiter that is smooth and not steep (docs/numerics.md, 6b). */
static void scene_scheme_slopes(struct draft *draft, const struct keys_map *scheme)
{
    static const char *const wrong[] = {"mc", "van-leer", "superbee"};
    const struct keys_value *limiter = keys_at(scheme, "limiter");
    struct keys_value value = *limiter;
    unsigned strong = scene_matter_strength(draft);
    struct instance *instance = &draft->scene->scheme.limiter;
    if (!scheme) return;
    if (!limiter->node && !limiter->meant)
        value = scene_scheme_default(draft, limiter, &scene_scheme_limiter, strong ? "van-albada" : "mc");
    scene_matter_open(draft, &value, instance);
    for (size_t i = 0; strong && instance->module && i < sizeof wrong / sizeof *wrong; i++)
        if (strcmp(instance->module->name, wrong[i]) == 0)
            diag_warn(draft->keys.diag, &value.node->mark,
                      "with limiter '%s' plastic shocks converge to wrong ones, which look clean; van-albada is the "
                      "default where a solid is plastic",
                      wrong[i]);
}

/* With tension, curvatures are best of thin fronts (docs/decisions/tension.md); stiff solids in a gas shake where steep
 * slopes make their surfaces sharp (docs/decisions/oblique-surfaces.md). */
static const char *scene_scheme_edge(struct draft *draft)
{
    if (scene_meet_drawn(draft)) return "thinc";
    return scene_meet_hard(draft) ? "van-albada" : "superbee";
}

static void scene_scheme_surfaces(struct draft *draft, const struct keys_value *surface)
{
    struct keys_value value = *surface;
    struct scene *scene = draft->scene;
    if (!surface->node && !surface->meant)
        value = scene_scheme_default(draft, surface, &scene_scheme_limiter, scene_scheme_edge(draft));
    scene_matter_open(draft, &value, &scene->scheme.interface_limiter);
    const struct bulla_module *module = scene->scheme.interface_limiter.module;
    bool rests = !module || !strcmp(module->name, "van-albada") || !strcmp(module->name, "minmod");
    if (!rests && scene_meet_hard(draft))
        diag_warn(draft->keys.diag, &value.node->mark,
                  "with interface-limiter '%s' a stiff solid that moves through a gas can shake itself to pieces; "
                  "van-albada is the default there",
                  module->name);
}

/* Some limiters are for the surfaces of fluids: elsewhere they make steps of waves, and slip and traction at the
 * surface of a solid come out wrong. */
static void scene_scheme_liquid(struct draft *draft, const struct keys_value *key, const struct bulla_module *module)
{
    const struct scene *scene = draft->scene;
    for (unsigned l = 0; module && vet_surfaces(module->table) && l < scene->n_material; l++) {
        if (!scene->material[l].constitutive.module) continue;
        keys_error(&draft->keys, key, "'%s' is for the surfaces of fluids, but '%s' is a solid", module->name,
                   scene->material[l].name);
        diag_help(draft->keys.diag, "'interface-limiter: superbee' keeps its slip and traction right");
        return;
    }
}

/* Of fractions along their surface. */
static void scene_scheme_along(struct draft *draft, const struct keys_map *scheme)
{
    const struct keys_value *along = keys_at(scheme, "along-limiter");
    struct scene *scene = draft->scene;
    scene->scheme.slanted = scene_meet_slanted(draft, scheme);
    if (!scheme || !(along->node || along->meant)) return;
    scene_matter_open(draft, along, &scene->scheme.along_limiter);
    scene_scheme_liquid(draft, along, scene->scheme.along_limiter.module);
    if (!scene->scheme.slanted)
        diag_warn(draft->keys.diag, &along->node->mark,
                  "'along-limiter' is for surfaces that lie as they like, and has no effect with all of "
                  "'interface-limiter' along every axis");
}

static void scene_scheme_limit(struct draft *draft, const struct keys_map *scheme)
{
    const struct keys_value *limiter = keys_at(scheme, "limiter"), *surface = keys_at(scheme, "interface-limiter");
    struct scene *scene = draft->scene;
    scene_scheme_slopes(draft, scheme);
    if (!scheme) return;
    scene_scheme_surfaces(draft, surface);
    const struct bulla_module *plain = scene->scheme.limiter.module;
    if (plain && vet_surfaces(plain->table)) {
        keys_error(&draft->keys, limiter, "'%s' is for volume fractions", plain->name);
        diag_help(draft->keys.diag, "'interface-limiter: %s' is where it belongs; 'limiter: koren' for all else",
                  plain->name);
    }
    scene_scheme_liquid(draft, surface, scene->scheme.interface_limiter.module);
}

/* The scheme says how many layers of neighbours tiles need. */
static void scene_scheme_reconstruct(struct draft *draft, const struct keys_map *scheme)
{
    struct scene *scene = draft->scene;
    scene_matter_open(draft, keys_at(scheme, "reconstruction"), &scene->scheme.reconstruction);
    const struct bulla_module *module = scene->scheme.reconstruction.module;
    scene->scheme.ghosts = module ? (int)((const struct bulla_reconstruction *)module->table)->layers : SCENE_GHOSTS;
}

/* Errors follow the Courant number of an axis, costs the sum: what is 0.4 on a line is 0.8 as soon as there are two
 * axes. Where short steps are known to be better they stay (docs/decisions/courant.md). */
static bool scene_scheme_long(struct draft *draft)
{
    const struct scene *scene = draft->scene;
    if (scene->domain.dim < 2 || scene->scheme.closure == SCENE_ALLAIRE) return false;
    return !keys_at(draft->root, "phase-change")->given && !keys_at(draft->root, "bodies")->given;
}

/* A number that the case gives, or `fallback`, which then stands in the resolved case. */
static double scene_scheme_number(struct draft *draft, const struct keys_map *scheme, const char *key,
                                  const char *fallback)
{
    const struct keys_value *value = keys_at(scheme, key);
    struct forest *forest = draft->keys.forest;
    if (!scheme || value->node || value->meant) return value->number;
    tree_set(forest, scheme->node, key, tree_scalar(forest, &scheme->node->mark, TREE_PLAIN, fallback));
    scene_scheme_order(scheme->node);
    return strtod(fallback, NULL);
}

/* Courant numbers of an axis above this one begin with small steps. */
#define SCENE_SCHEME_RAMP 0.5

static bool scene_scheme_far(const struct scene *scene)
{
    return scene->scheme.cfl > SCENE_SCHEME_RAMP * scene->domain.dim;
}

/* Bubbles and what viscosity rules are slow beside sound, and faces that answer as to sound damp them. On a line, in
 * one inviscid fluid and beside solids waves are what matters, and where the curvature of a surface with tension is an
 * estimate, its rest; hancock with long steps needs the damping (docs/decisions/low-mach.md). */
static bool scene_scheme_slow(struct draft *draft)
{
    const struct scene *scene = draft->scene;
    bool several = scene->n_material > 1;
    bool drawn = scene->domain.dim > 1 && keys_at(draft->root, "surface-tension")->count > 0;
    if (scene->domain.dim < 2 && scene->domain.geometry == SCENE_CARTESIAN) return false;
    for (unsigned l = 0; l < scene->n_material && !several; l++) several = scene->material[l].viscosity.module;
    if (scene->scheme.integrator == SCENE_HANCOCK && scene_scheme_far(scene)) return false;
    return several && !drawn && !scene_matter_solid(draft);
}

/* How small the first steps of Courant numbers are that begin with small ones. */
#define SCENE_SCHEME_FIRST 0.05

/* A fixed step is as long as the case says, from the start. */
static double scene_scheme_first(struct draft *draft, const struct keys_map *scheme)
{
    const struct keys_value *first = keys_at(scheme, "first-step"), *dt = keys_at(scheme, "dt");
    const struct scene *scene = draft->scene;
    bool ramp = scene_scheme_far(scene) && !dt->given;
    if (first->given && dt->given) {
        keys_error(&draft->keys, first, "steps are fixed by 'dt': there is no smaller first one");
        diag_help(draft->keys.diag, "give one of the two");
    }
    return first->given ? first->number : ramp ? SCENE_SCHEME_FIRST : 1.0;
}

/* Wood's speed knows no shear. */
static bool scene_scheme_wood(struct draft *draft, const struct keys_map *scheme)
{
    const struct keys_value *speed = keys_at(scheme, "mixture-speed");
    bool wood = speed->integer == 2;
    if (wood && scene_matter_solid(draft)) {
        keys_error(&draft->keys, speed,
                   "'wood' is for mixtures of fluids: with solids the speeds of shear would be lost");
        diag_help(draft->keys.diag, "'mixture-speed: frozen', what scenes with solids have by themselves");
    }
    return wood;
}

void scene_scheme(struct draft *draft)
{
    const struct keys_map *scheme = keys_at(draft->root, "scheme")->map, *run = keys_at(draft->root, "run")->map;
    struct scene *scene = draft->scene;
    scene->scheme.closure = (enum scene_closure)keys_at(scheme, "closure")->integer;
    scene->scheme.traction = (enum scene_traction)keys_at(scheme, "traction")->integer;
    scene->scheme.free = scene_meet_free(draft, scheme);
    scene->scheme.sheltered = scene_meet_sheltered(draft, scheme);
    scene->scheme.exchange = (enum scene_exchange)keys_at(scheme, "exchange")->integer;
    scene->scheme.integrator = (enum scene_integrator)keys_at(scheme, "integrator")->integer;
    scene->scheme.diffusion = (enum scene_diffusion)keys_at(scheme, "diffusion")->integer;
    scene->scheme.guard = (enum scene_guard)keys_at(scheme, "guard")->integer;
    scene->scheme.calm = keys_at(scheme, "shock-fronts")->integer == 1;
    scene->scheme.wood = scene_scheme_wood(draft, scheme);
    scene->scheme.cfl = scene_scheme_number(draft, scheme, "cfl", scene_scheme_long(draft) ? "0.8" : "0.4");
    scene->scheme.low_mach = scene_scheme_number(draft, scheme, "low-mach", scene_scheme_slow(draft) ? "0.05" : "1");
    scene->scheme.dt_fixed = keys_at(scheme, "dt")->number;
    scene->scheme.first_step = scene_scheme_first(draft, scheme);
    scene_scheme_riemann_open(draft, scheme);
    scene_scheme_reconstruct(draft, scheme);
    scene_scheme_limit(draft, scheme);
    scene_scheme_along(draft, scheme);
    scene_meet_idle(draft, scheme);
    scene->run.until = keys_at(run, "until")->number;
    scene->run.max_steps = keys_at(run, "max-steps")->integer;
    scene->run.dt_least = keys_at(run, "smallest-step")->given ? keys_at(run, "smallest-step")->number : -1.0;
    script_host_limit(scene->host, keys_at(run, "script-time")->number);
}
