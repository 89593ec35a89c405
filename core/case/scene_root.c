/* scene_root.c - the top level of a case file. */
#include "case/scene_draft.h"

static const struct key scene_root_run[] = {
    {.name = "until",
     .type = KEYS_NUMBER,
     .unit = "s",
     .min = KEYS_POSITIVE,
     .max = KEYS_MOST,
     .required = true,
     .doc = "Simulated time at which the run ends."},
    {.name = "max-steps",
     .type = KEYS_INTEGER,
     .min = 0,
     .max = 9e15,
     .doc = "Ends the run after so many steps of the coarsest level; 0: no limit."},
    {.name = "smallest-step",
     .type = KEYS_NUMBER,
     .unit = "s",
     .min = 0,
     .max = KEYS_MOST,
     .doc = "The run stops, with exit code 3 and a dump of the fastest cell, when its time step would be smaller than "
            "this; 0: never. Not given: a millionth of its longest step so far."},
    {.name = "script-time",
     .type = KEYS_NUMBER,
     .unit = "s",
     .min = 1e-3,
     .max = 1000,
     .fallback = "0.2 s",
     .doc = "CPU time that one call of a Lua function may take; many calls, one after the other, may take a 200th of "
            "it in the mean."},
    {0},
};

static const struct keys_section scene_root_run_keys = {.name = "run",
                                                        .doc = "How long to compute.",
                                                        .keys = scene_root_run};

static const struct key scene_root[] = {
    {.name = "bulla",
     .type = KEYS_INTEGER,
     .min = 1,
     .max = 1,
     .required = true,
     .doc = "Version of the case format: 1."},
    {.name = "title", .type = KEYS_TEXT, .doc = "One line that says what is computed."},
    {.name = "about", .type = KEYS_TEXT, .doc = "What the case shows, for readers."},
    {.name = "cite", .type = KEYS_TEXT, .doc = "Where the set-up or the reference comes from."},
    {.name = "extends",
     .type = KEYS_TEXT,
     .doc = "A case file on which this one is laid: maps are merged, other values replaced, null deletes."},
    {.name = "modules", .type = KEYS_TEXT, .many = KEYS_LIST, .doc = "Shared objects to load, relative to this file."},
    {.name = "parameters",
     .type = KEYS_PARAMETER,
     .many = KEYS_NAMED,
     .doc = "Named numbers for expressions: `R0: 10 um`, then `radius: = 2 * R0`."},
    {.name = "domain",
     .type = KEYS_SECTION,
     .section = &scene_domain_keys,
     .required = true,
     .doc = "The region, its cells and its boundaries."},
    {.name = "mesh",
     .type = KEYS_SECTION,
     .section = &scene_mesh_keys,
     .fallback = "{}",
     .doc = "Tiles and refinement."},
    {.name = "materials",
     .type = KEYS_SECTION,
     .many = KEYS_NAMED,
     .section = &scene_material_keys,
     .required = true,
     .doc = "The materials, by name."},
    {.name = "surface-tension",
     .type = KEYS_NUMBER,
     .many = KEYS_NAMED,
     .unit = "N/m",
     .min = KEYS_POSITIVE,
     .max = KEYS_MOST,
     .doc =
         "Surface tension by pairs of materials, as in `water+air: 72.8 mN/m`; pairs that are not named have none. In "
         "one dimension, around a centre or an axis."},
    {.name = "initial",
     .type = KEYS_SECTION,
     .many = KEYS_LIST,
     .section = &scene_initial_keys,
     .required = true,
     .doc = "The initial state, painted in order."},
    {.name = "sources",
     .type = KEYS_SECTION,
     .section = &scene_source_keys,
     .doc = "What acts throughout the domain: gravity and other body forces, heating, sources of mass."},
    {.name = "scheme",
     .type = KEYS_SECTION,
     .section = &scene_scheme_keys,
     .fallback = "{}",
     .doc = "The numerical method."},
    {.name = "run",
     .type = KEYS_SECTION,
     .section = &scene_root_run_keys,
     .required = true,
     .doc = "How long to compute."},
    {.name = "output",
     .type = KEYS_SECTION,
     .section = &scene_output_keys,
     .fallback = "{}",
     .doc = "What is written, where and how often."},
    {.name = "expect",
     .type = KEYS_SECTION,
     .many = KEYS_LIST,
     .section = &scene_expect_keys,
     .doc = "What the result must satisfy; a run that does not ends with exit code 1."},
    {.name = "variants",
     .type = KEYS_TREE,
     .many = KEYS_NAMED,
     .section = &scene_root_keys,
     .doc = "Named overlays onto the case, chosen by --variant NAME."},
    {.name = "quick",
     .type = KEYS_TREE,
     .section = &scene_root_keys,
     .doc = "The overlay that --variant quick chooses: a coarse run of seconds."},
    {.name = "matrix",
     .type = KEYS_TREE,
     .many = KEYS_NAMED,
     .doc = "Lists of values by path (`parameters.R0: [5 um, 10 um]`); `bulla sweep` runs all combinations."},
    {0},
};

/* Names of parameters and materials, lists of the matrix, stretches: params.c, scene_material.c, scene.c,
 * scene_stretch.c. */
#define SCENE_ROOT_RULES                                                                                              \
    "{'properties': {'parameters': {'propertyNames': {'pattern': '^(?!([xyzrt]|and|or|not|true|false|nil|function|"   \
    "return|end|if|then|else|elseif|local|for|while|do|in|repeat|until|break|goto|pi|math|string|table)$)[A-Za-z_]"   \
    "[A-Za-z0-9_]{0,62}$', 'patternErrorMessage': 'The name of a parameter is an identifier (letters, digits and _) " \
    "that means nothing in expressions yet.'}},"                                                                      \
    "'materials': {'minProperties': 1, 'maxProperties': 16, 'propertyNames': {'pattern': '^[A-Za-z_][A-Za-z0-9_]"     \
    "{0,31}$', 'patternErrorMessage': 'The name of a material is an identifier (letters, digits and _).'}},"          \
    "'matrix': {'additionalProperties': {'type': 'array', 'minItems': 1, 'errorMessage': 'A list of values is "       \
    "needed.'}}}},"                                                                                                   \
    "{'if': {'required': ['materials'], 'properties': {'materials': {'additionalProperties': {'not': {'required': "   \
    "['constitutive']}}}}}, 'then': {'properties': {'initial': {'items': {'properties': {'stretch': false}}}}}}"

const struct keys_section scene_root_keys = {.name = "case",
                                             .doc = "A case of bulla.",
                                             .keys = scene_root,
                                             .rules = SCENE_ROOT_RULES};
