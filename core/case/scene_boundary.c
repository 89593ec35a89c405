/* scene_boundary.c - what lies behind the faces of the domain: see scene_boundary.h. */
#include "case/scene_boundary.h"

#include "base/mem.h"
#include "base/text.h"
#include "bulla/boundary.h"
#include "case/scene_draft.h"
#include "plug/registry.h"

#define AMPLITUDE                                                                                                      \
    {                                                                                                                  \
        .name = "amplitude", .type = KEYS_NUMBER, .unit = "Pa", .min = -KEYS_MOST, .max = KEYS_MOST, .required = true, \
        .doc = "Peak gauge pressure."                                                                                  \
    }

static const struct key scene_boundary_lithotripter[] = {
    AMPLITUDE,
    {.name = "frequency",
     .type = KEYS_NUMBER,
     .unit = "Hz",
     .min = KEYS_POSITIVE,
     .max = KEYS_MOST,
     .fallback = "83.3 kHz",
     .doc = "Frequency of the oscillation."},
    {.name = "decay",
     .type = KEYS_NUMBER,
     .unit = "1/s",
     .min = 0,
     .max = KEYS_MOST,
     .fallback = "9.1e5",
     .doc = "Rate of the exponential decay."},
    {0},
};

static const struct key scene_boundary_sine[] = {
    AMPLITUDE,
    {.name = "frequency",
     .type = KEYS_NUMBER,
     .unit = "Hz",
     .min = KEYS_POSITIVE,
     .max = KEYS_MOST,
     .required = true,
     .doc = "Frequency of the wave."},
    {.name = "cycles",
     .type = KEYS_NUMBER,
     .unit = "1",
     .min = 0,
     .max = KEYS_MOST,
     .fallback = "0",
     .doc = "Number of periods; 0: for ever."},
    {.name = "window",
     .type = KEYS_CHOICE,
     .choices = "none|hann|tukey",
     .fallback = "none",
     .doc = "How a burst rises and falls: at once, over the whole of it (hann), over an eighth at each end (tukey)."},
    {0},
};

static const struct key scene_boundary_gaussian[] = {
    AMPLITUDE,
    {.name = "center",
     .type = KEYS_NUMBER,
     .unit = "s",
     .min = -KEYS_MOST,
     .max = KEYS_MOST,
     .required = true,
     .doc = "Time of the peak at the boundary."},
    {.name = "width",
     .type = KEYS_NUMBER,
     .unit = "s",
     .min = KEYS_POSITIVE,
     .max = KEYS_MOST,
     .required = true,
     .doc = "Time from the peak to 1/e of it."},
    {0},
};

static const struct key scene_boundary_series[] = {
    {.name = "file",
     .type = KEYS_TEXT,
     .required = true,
     .doc = "CSV file with a time (ascending) and a gauge pressure, relative to this file; in s and Pa if neither the "
            "header (`t[us]`, `p (MPa)`, `t_us`) nor `units` says otherwise."},
    {.name = "columns",
     .type = KEYS_TEXT,
     .many = KEYS_LIST,
     .fallback = "[1, 2]",
     .doc = "Names or numbers of the columns of time and pressure."},
    {.name = "units",
     .type = KEYS_SECTION,
     .section = &scene_pulse_units,
     .doc = "Units of these columns, {t: us, p: MPa} or [us, MPa]; they win over the header."},
    {.name = "amplitude",
     .type = KEYS_NUMBER,
     .unit = "Pa",
     .min = KEYS_POSITIVE,
     .max = KEYS_MOST,
     .doc = "Largest magnitude of the pressure: the pulse is scaled to it, whatever unit it is in."},
    {.name = "scale",
     .type = KEYS_NUMBER,
     .unit = "1",
     .min = -KEYS_MOST,
     .max = KEYS_MOST,
     .doc = "Factor by which the pressures are multiplied, instead of an amplitude."},
    {0},
};

static const struct key scene_boundary_lua[] = {
    {.name = "lua",
     .type = KEYS_TEXT,
     .required = true,
     .doc = "File or block: function(t, x, y, z) that returns the gauge pressure [Pa]."},
    {0},
};

static const struct keys_section scene_boundary_pulses[] = {
    {.name = "lithotripter",
     .keys = scene_boundary_lithotripter,
     .doc = "Shock-wave lithotripter: 2 amplitude exp(-decay t) cos(2 pi frequency t + pi/3)."},
    {.name = "sine", .keys = scene_boundary_sine, .doc = "amplitude sin(2 pi frequency t)."},
    {.name = "gaussian", .keys = scene_boundary_gaussian, .doc = "amplitude exp(-((t - center)/width)^2)."},
    {.name = "series", .keys = scene_boundary_series, .doc = "Measured pulse, interpolated linearly."},
    {.name = "lua", .keys = scene_boundary_lua, .doc = "Gauge pressure from a Lua function."},
};

const struct keys_section *const scene_boundary_pulse_cases[] = {&scene_boundary_pulses[0], &scene_boundary_pulses[1],
                                                                 &scene_boundary_pulses[2], &scene_boundary_pulses[3],
                                                                 &scene_boundary_pulses[4], NULL};

static const struct key scene_boundary_wave[] = {
    {.name = "pulse", .type = KEYS_CHOICE, .required = true, .doc = "The form of the wave in time."},
    {.name = "pressure",
     .type = KEYS_VALUE,
     .unit = "Pa",
     .doc = "Far-field pressure to which the pulse adds; the initial pressure at the boundary if not given."},
    {.name = "delay",
     .type = KEYS_NUMBER,
     .unit = "s",
     .min = -KEYS_MOST,
     .max = KEYS_MOST,
     .fallback = "0",
     .doc = "Time by which the pulse comes later."},
    {.name = "compressive-only",
     .type = KEYS_FLAG,
     .fallback = "false",
     .doc = "Keep only the first compressive phase, up to the first zero."},
    {.name = "direction",
     .type = KEYS_SECTION,
     .section = &scene_beam_plane_keys,
     .doc = "A plane wave under an angle; along the inward normal if neither this nor a focus is given."},
    {.name = "focus",
     .type = KEYS_SECTION,
     .section = &scene_beam_focus_keys,
     .doc = "A wave from a curved transducer to its focus."},
    {.name = "sound-speed",
     .type = KEYS_NUMBER,
     .unit = "m/s",
     .min = KEYS_POSITIVE,
     .max = KEYS_MOST,
     .doc = "With which such a wave comes; that of the initial state at the middle of the face if not given."},
    {0},
};

static const struct key scene_boundary_far[] = {
    {.name = "pressure",
     .type = KEYS_VALUE,
     .unit = "Pa",
     .doc = "Far-field pressure; the initial pressure at the boundary if not given."},
    {.name = "origin",
     .type = KEYS_NUMBER,
     .many = KEYS_LIST,
     .unit = "m",
     .doc = "Point from which the waves come that leave here, say the middle of a bubble: they leave as round waves, "
            "under any angle. Without it as plane ones along the normal; in spherical scenes it is the centre."},
    {0},
};

static const struct key scene_boundary_wall[] = {
    {.name = "temperature",
     .type = KEYS_VALUE,
     .unit = "K",
     .min = KEYS_POSITIVE,
     .max = KEYS_MOST,
     .doc = "Temperature of the wall, in scenes that conduct heat; without it (and `heat-flux`) no heat passes."},
    {.name = "heat-flux",
     .type = KEYS_VALUE,
     .unit = "W/m2",
     .min = -KEYS_MOST,
     .max = KEYS_MOST,
     .doc = "Heat that the wall gives to what is inside, instead of a temperature."},
    {0},
};

/* What becomes of heat at a wall. */
static void scene_boundary_read_wall(struct draft *draft, struct scene_boundary *boundary, const struct keys_map *map)
{
    const struct keys_value *temperature = keys_at(map, "temperature"), *flux = keys_at(map, "heat-flux");
    boundary->temperature = scene_state_value(temperature);
    boundary->heat_flux = scene_state_value(flux);
    if (!temperature->node && !flux->node) return;
    const struct keys_value *last = flux->node ? flux : temperature;
    if (temperature->node && flux->node)
        keys_error(&draft->keys, flux, "a wall has a temperature or gives a flux of heat, not both");
    if (scene_matter_conducts(draft)) return;
    keys_error(&draft->keys, last, "no material conducts heat, so the wall gives none");
    diag_help(draft->keys.diag, "give a material its 'conductivity: 0.607 W/m/K', or leave this out");
}

static void scene_boundary_read_far(struct draft *draft, struct scene_boundary *boundary, const struct keys_map *map)
{
    (void)draft;
    boundary->pressure = scene_state_value(keys_at(map, "pressure"));
}

static void scene_boundary_read_window(struct draft *draft, struct scene_boundary *boundary,
                                       const struct keys_value *window)
{
    if (!window->given) return;
    boundary->window = (unsigned)window->integer;
    if (boundary->window == SCENE_WINDOW_NONE || boundary->cycles > 0.0) return;
    keys_error(&draft->keys, window, "a wave that never ends has no window");
    diag_help(draft->keys.diag, "say how many periods it has: 'cycles: 10'");
}

static void scene_boundary_read_wave(struct draft *draft, struct scene_boundary *boundary, const struct keys_map *map)
{
    boundary->pressure = scene_state_value(keys_at(map, "pressure"));
    if (!keys_at(map, "pulse")->given) return;
    boundary->pulse = (enum scene_pulse)keys_at(map, "pulse")->integer;
    boundary->amplitude = keys_at(map, "amplitude")->number;
    boundary->frequency = keys_at(map, "frequency")->number;
    boundary->decay = keys_at(map, "decay")->number;
    boundary->cycles = keys_at(map, "cycles")->number;
    scene_boundary_read_window(draft, boundary, keys_at(map, "window"));
    boundary->centre = keys_at(map, "center")->number;
    boundary->width = keys_at(map, "width")->number;
    boundary->delay = keys_at(map, "delay")->number;
    boundary->compressive_only = keys_at(map, "compressive-only")->integer != 0;
    if (boundary->pulse == SCENE_PULSE_SERIES) scene_pulse(draft, boundary, map);
    if (keys_at(map, "lua")->given) boundary->script = scene_file_lua(draft, keys_at(map, "lua"));
}

static void scene_boundary_read_state(struct draft *draft, struct scene_boundary *boundary, const struct keys_map *map)
{
    struct keys_value here = {.node = map->node, .path = map->path};
    boundary->pressure = scene_state_value(keys_at(map, "pressure"));
    boundary->fractions = scene_state_fractions(draft, map);
    boundary->density = scene_state_density(draft, map, boundary->fractions);
    scene_state_vector(draft, keys_at(map, "velocity"), boundary->velocity);
    scene_state_check(draft, map, boundary->fractions, boundary->density);
    if (keys_at(map, "temperature")->given)
        keys_error(&draft->keys, keys_at(map, "temperature"), "an inflow is given by its density");
    bool named = keys_at(map, "material")->node || keys_at(map, "fractions")->node;
    if (!named || !keys_at(map, "density")->node || !keys_at(map, "pressure")->node || !keys_at(map, "velocity")->node)
        keys_error(&draft->keys, &here, "an inflow needs material (or fractions), density, pressure and velocity");
}

/* What scene_boundary_read_state wants. */
static const char scene_boundary_state_rules[] =
    "{'required': ['density', 'pressure', 'velocity'], 'properties': {'temperature': false}, "
    "'anyOf': [{'required': ['material']}, {'required': ['fractions']}]}";

/* Walls may move. */
static const struct key scene_boundary_slippery[] = {
    {.name = "velocity",
     .type = KEYS_VALUE,
     .many = KEYS_LIST,
     .unit = "m/s",
     .doc = "Velocity of the wall, of which the part across the face counts: a piston that pushes or pulls while the "
            "face stays where it is, for ways that are short against the domain. It rests if not given."},
    {0},
};

static const struct key scene_boundary_sticky[] = {
    {.name = "velocity",
     .type = KEYS_VALUE,
     .many = KEYS_LIST,
     .unit = "m/s",
     .doc = "Velocity of the wall; it rests if not given. Viscous fluids are dragged along; across the face as for "
            "`reflecting`."},
    {.name = "contact-angle",
     .type = KEYS_NUMBER,
     .many = KEYS_NAMED,
     .unit = "rad",
     .min = KEYS_POSITIVE,
     .max = KEYS_MOST,
     .doc = "Angle at which the surface between two materials meets the wall, within the first of them, as in "
            "`water+air: 60 deg`, for pairs with a `surface-tension`; 90 deg if not given."},
    {0},
};

static const struct keys_section scene_boundary_any_wall = {.name = "wall", .keys = scene_boundary_wall};

static void scene_boundary_read_solid(struct draft *draft, struct scene_boundary *boundary, const struct keys_map *map)
{
    const struct keys_value *velocity = keys_at(map, "velocity");
    scene_boundary_read_wall(draft, boundary, map);
    if (!velocity->given) return;
    scene_state_vector(draft, velocity, boundary->velocity);
    boundary->moves = true;
}

/* What a module says of itself, in our words. */
static unsigned scene_boundary_traits(const struct bulla_boundary *law)
{
    static const unsigned words[][2] = {{BULLA_BEHIND_RESTS, SCENE_BOUNDARY_RESTS},
                                        {BULLA_BEHIND_BRINGS, SCENE_BOUNDARY_BRINGS},
                                        {BULLA_BEHIND_REFERS, SCENE_BOUNDARY_REFERS},
                                        {BULLA_BEHIND_DRIVES, SCENE_BOUNDARY_DRIVES},
                                        {BULLA_BEHIND_OPEN, SCENE_BOUNDARY_OPEN}};
    unsigned traits = 0;
    for (size_t i = 0; i < sizeof words / sizeof *words; i++)
        if (law->traits & words[i][0]) traits |= words[i][1];
    return traits;
}

static void scene_boundary_read_module(struct draft *draft, struct scene_boundary *boundary, const struct keys_map *map)
{
    const struct keys_value here = {.node = map->node, .path = map->path, .map = (struct keys_map *)map};
    scene_matter_open(draft, &here, &boundary->law);
    if (boundary->law.module) boundary->traits = scene_boundary_traits(boundary->law.module->table);
}

struct scene_boundary_row {
    struct keys_section section;
    void (*read)(struct draft *draft, struct scene_boundary *boundary, const struct keys_map *map); /* or NULL */
    unsigned traits;
};

/* What may be written beside the type, and who reads it. */
#define SCENE_BOUNDARY_NOTHING .read = NULL
#define SCENE_BOUNDARY_WALL \
    .section.keys = scene_boundary_slippery, .section.base = &scene_boundary_any_wall, .read = scene_boundary_read_solid
#define SCENE_BOUNDARY_FAR .section.keys = scene_boundary_far, .read = scene_boundary_read_far
#define SCENE_BOUNDARY_STICKY \
    .section.keys = scene_boundary_sticky, .section.base = &scene_boundary_any_wall, .read = scene_boundary_read_solid
#define SCENE_BOUNDARY_STATE \
    .section.keys = scene_state_rows, .section.rules = scene_boundary_state_rules, .read = scene_boundary_read_state
#define SCENE_BOUNDARY_WAVE                                                                                        \
    .section.keys = scene_boundary_wave, .section.selector = "pulse", .section.cases = scene_boundary_pulse_cases, \
    .read = scene_boundary_read_wave

#define SCENE_BOUNDARY_ROW(type, word, what, written, fill, means) \
    [SCENE_##type] = {.section.name = word, .section.doc = what, .traits = (means), SCENE_BOUNDARY_##written},
#define SCENE_BOUNDARY_CASE(type, ...) &scene_boundary_types[SCENE_##type].section,

static const struct scene_boundary_row scene_boundary_types[] = {
    SCENE_BOUNDARY_TABLE(SCENE_BOUNDARY_ROW)[SCENE_BOUNDARY_MODULE] = {.read = scene_boundary_read_module}};
static const struct keys_section *const scene_boundary_cases[] = {SCENE_BOUNDARY_TABLE(SCENE_BOUNDARY_CASE) NULL};

_Static_assert(sizeof scene_boundary_types / sizeof *scene_boundary_types == SCENE_BOUNDARY_TYPES, "a row per type");

static const struct key scene_boundary_rows[] = {
    {.name = "type",
     .type = KEYS_CHOICE,
     .required = true,
     .doc = "What lies behind this face; a module of kind `boundary` is a type, too."},
    {0},
};

const struct keys_section scene_boundary_keys = {.name = "boundary",
                                                 .doc = "What lies behind a face of the domain.",
                                                 .keys = scene_boundary_rows,
                                                 .selector = "type",
                                                 .cases = scene_boundary_cases,
                                                 .kind = "boundary"};

bool scene_boundary_is(const struct scene *scene, int face, unsigned traits)
{
    const struct scene_boundary *boundary = &scene->domain.boundary[face / 2][face % 2];
    unsigned has = scene_boundary_types[boundary->type].traits | boundary->traits;
    if (boundary->moves) has = (has & ~(unsigned)SCENE_BOUNDARY_RESTS) | SCENE_BOUNDARY_DRIVES;
    return (has & traits) == traits;
}

bool scene_boundary_is_heated(const struct scene *scene, int face)
{
    const struct scene_boundary *boundary = &scene->domain.boundary[face / 2][face % 2];
    return boundary->temperature.given || boundary->heat_flux.given;
}

const char *scene_boundary_name(enum scene_boundary_type type)
{
    return scene_boundary_types[type].section.name;
}

static void scene_boundary_read(struct draft *draft, struct scene_boundary *boundary, const struct keys_map *map)
{
    const struct keys_value *type = keys_at(map, "type");
    if (!type->given) return;
    bool module = map->chosen && map->chosen->module;
    if (!module && registry_find("boundary", type->text))
        diag_warn(draft->keys.diag, &type->node->mark,
                  "%s: '%s' is that of the program; the module of the same name is not used", type->path, type->text);
    boundary->type = module ? SCENE_BOUNDARY_MODULE : (enum scene_boundary_type)type->integer;
    const struct scene_boundary_row *row = &scene_boundary_types[boundary->type];
    if (row->read) row->read(draft, boundary, map);
}

/* Rules that concern the type and the place together. */
static void scene_boundary_place(struct draft *draft, int axis, int side, const struct keys_map *map)
{
    const struct scene *scene = draft->scene;
    const struct keys_value *type = keys_at(map, "type");
    if (!type->given) return;
    int face = 2 * axis + side;
    bool radial = scene->domain.geometry != SCENE_CARTESIAN && axis == 0,
         centre = radial && side == 0 && scene->domain.lower[0] == 0.0;
    if (scene_boundary_is(scene, face, SCENE_BOUNDARY_CENTRE) && !centre)
        keys_error(&draft->keys, type,
                   radial && side == 0 ? "the axis is at r = 0, but the domain begins elsewhere"
                                       : "only 'x-' of axisymmetric or spherical domains is an axis");
    if (centre && !scene_boundary_is(scene, face, SCENE_BOUNDARY_MIDDLE)) {
        keys_error(&draft->keys, type, "at r = 0 there is the axis or a symmetry, not '%s'", type->text);
        diag_help(draft->keys.diag, "write 'x-: axis'");
    }
    if (radial && scene_boundary_is(scene, face, SCENE_BOUNDARY_WRAPS))
        keys_error(&draft->keys, type, "the radius is not periodic");
    scene_wall(draft, axis, side, map);
}

/* Both faces of an axis are periodic, or none. */
static void scene_boundary_pair(struct draft *draft, int axis, const struct keys_value *pair[2])
{
    const struct scene *scene = draft->scene;
    for (int side = 0; side < 2; side++) {
        const struct keys_value *type = keys_at(pair[side]->map, "type"), *other = keys_at(pair[1 - side]->map, "type");
        if (!type->given || !other->given || !scene_boundary_is(scene, 2 * axis + side, SCENE_BOUNDARY_WRAPS)) continue;
        if (scene_boundary_is(scene, 2 * axis + 1 - side, SCENE_BOUNDARY_WRAPS)) continue;
        keys_error(&draft->keys, type, "periodic faces come in pairs, but '%s' is '%s'", pair[1 - side]->key->name,
                   other->text);
    }
}

/* The face at r = 0 needs no words: it is the axis, or the centre. */
static bool scene_boundary_default(struct draft *draft, int axis, int side, const struct keys_map *boundaries)
{
    const struct scene *scene = draft->scene;
    if (axis || side || scene->domain.geometry == SCENE_CARTESIAN || scene->domain.lower[0] != 0.0) return false;
    enum scene_boundary_type type = scene->domain.geometry == SCENE_SPHERICAL ? SCENE_SYMMETRY : SCENE_AXIS;
    struct node *map = tree_map(draft->keys.forest, &boundaries->node->mark);
    tree_set(draft->keys.forest, map, "type",
             tree_scalar(draft->keys.forest, &map->mark, TREE_PLAIN, scene_boundary_name(type)));
    draft->scene->domain.boundary[0][0].type = type;
    tree_set(draft->keys.forest, boundaries->node, "x-", map);
    tree_first(boundaries->node, boundaries->node->count - 1);
    return true;
}

void scene_boundary(struct draft *draft)
{
    static const char *const names[SCENE_AXES][2] = {{"x-", "x+"}, {"y-", "y+"}, {"z-", "z+"}};
    const struct keys_map *boundaries = keys_at(keys_at(draft->root, "domain")->map, "boundaries")->map;
    struct text missing = {0};
    if (!boundaries || draft->scene->domain.dim == 0) return;
    for (int axis = 0; axis < SCENE_AXES; axis++) {
        const struct keys_value *pair[2] = {keys_at(boundaries, names[axis][0]), keys_at(boundaries, names[axis][1])};
        for (int side = 0; side < 2; side++) {
            struct scene_boundary *boundary = &draft->scene->domain.boundary[axis][side];
            if (pair[side]->node && axis >= draft->scene->domain.dim)
                keys_error(&draft->keys, pair[side], "the domain has only %d ax%s", draft->scene->domain.dim,
                           draft->scene->domain.dim == 1 ? "is" : "es");
            else if (pair[side]->node) scene_boundary_read(draft, boundary, pair[side]->map);
            else if (axis < draft->scene->domain.dim && !scene_boundary_default(draft, axis, side, boundaries))
                text_add(&missing, "%s%s", missing.length ? ", " : "", names[axis][side]);
            if (pair[side]->map && boundary->type == SCENE_INCOMING_WAVE)
                scene_beam(draft, boundary, pair[side]->map, axis, side);
            if (pair[side]->map && boundary->type == SCENE_NONREFLECTING)
                scene_beam_origin(draft, boundary, pair[side]->map, axis, side);
            scene_boundary_place(draft, axis, side, pair[side]->map);
        }
        scene_boundary_pair(draft, axis, pair);
    }
    if (missing.length) {
        diag_error(draft->keys.diag, &boundaries->node->mark, "domain.boundaries: nothing is said about %s",
                   missing.at);
        diag_help(draft->keys.diag, "every face of the domain needs a boundary, as in '%.2s: outflow'", missing.at);
    }
    text_done(&missing);
}
