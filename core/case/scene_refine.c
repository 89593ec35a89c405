/* scene_refine.c - the criteria of refinement: `mesh.refine`.
 *
 * A threshold says by its unit what it means: a pure number is a relative jump between neighbouring cells, a
 * number with a unit an absolute one. The resolved case, where no number has a unit, has `relative:` instead. */
#include "case/scene_draft.h"

#include "base/mem.h"
#include "base/text.h"

#include <math.h>
#include <string.h>

/* In the order of the kinds in struct scene_refine, which is that of the rows. */
enum { SCENE_REFINE_KINDS = SCENE_REFINE_REGION + 1 };

static const struct key scene_refine_rows[] = {
    {.name = "gradient",
     .type = KEYS_FIELD,
     .doc = "A field whose gradient asks for refinement: `above` with a unit per metre ('1 MPa/mm'), the steepest "
            "difference to a neighbouring cell over the distance; or `above` as a pure number, then as `jump`."},
    {.name = "jump",
     .type = KEYS_FIELD,
     .doc = "A field whose jump to a neighbouring cell asks for refinement: `above` with the field's unit, or as a "
            "pure number: the jump over the larger of the two values (volume fractions and schlieren: over 1)."},
    {.name = "value", .type = KEYS_FIELD, .doc = "A field that asks for refinement where it is `above` and `below`."},
    {.name = "interface", .type = KEYS_TEXT, .doc = "A material whose surface is refined, on both sides."},
    {.name = "lua",
     .type = KEYS_SCRIPT,
     .doc = "Refines where it gives true or a number above 0: an expression, '= pressure > 1e6 and x < 1e-3', or a "
            "function, of x, y, z, t and any fields."},
    {.name = "region", .type = KEYS_SECTION, .section = &scene_shape_keys, .doc = "Refines all of a region."},
    {.name = "above", .type = KEYS_NUMBER, .doc = "Refines where it is more than this."},
    {.name = "below", .type = KEYS_NUMBER, .doc = "Of `value`: refines where it is less than this."},
    {.name = "where", .type = KEYS_SECTION, .section = &scene_shape_keys, .doc = "Only in this region."},
    {.name = "finest",
     .type = KEYS_INTEGER,
     .min = 1,
     .max = 15,
     .doc = "Finest level that the criterion asks for; all of mesh.levels if not given."},
    {.name = "from", .type = KEYS_NUMBER, .unit = "s", .min = 0, .max = KEYS_MOST, .doc = "Only from this time on."},
    {.name = "until", .type = KEYS_NUMBER, .unit = "s", .min = 0, .max = KEYS_MOST, .doc = "Only until this time."},
    {.name = "relative",
     .type = KEYS_FLAG,
     .doc = "Is `above` of a gradient or jump relative? If not given: yes for a pure number, no for one with a unit."},
    {0},
};

/* What goes with what: scene_refine_strangers and scene_refine_threshold. */
#define SCENE_REFINE_RULES                                                                                  \
    "{'if': {'anyOf': [{'required': ['gradient']}, {'required': ['jump']}]},"                               \
    " 'then': {'required': ['above'], 'properties': {'below': false}}},"                                    \
    "{'if': {'required': ['value']}, 'then': {'anyOf': [{'required': ['above']}, {'required': ['below']}]," \
    " 'properties': {'relative': false}}},"                                                                 \
    "{'if': {'anyOf': [{'required': ['interface']}, {'required': ['lua']}, {'required': ['region']}]},"     \
    " 'then': {'properties': {'above': false, 'below': false, 'relative': false}}},"                        \
    "{'if': {'required': ['region']}, 'then': {'properties': {'where': false}}}"

const struct keys_section scene_refine_keys = {.name = "refine",
                                               .doc = "One criterion of refinement, which may be limited to a region, "
                                                      "to coarser levels and to a time window.",
                                               .keys = scene_refine_rows,
                                               .choose = SCENE_REFINE_KINDS,
                                               .rules = SCENE_REFINE_RULES};

static bool scene_refine_differs(const struct scene_refine *refine)
{
    return refine->kind == SCENE_REFINE_GRADIENT || refine->kind == SCENE_REFINE_JUMP;
}

/* The one thing that a criterion looks at; NULL after a recorded error. */
static const struct keys_value *scene_refine_chosen(struct draft *draft, const struct keys_map *map,
                                                    struct scene_refine *refine)
{
    const struct keys_value *chosen = NULL;
    for (int i = 0; i < SCENE_REFINE_KINDS; i++) {
        const struct keys_value *value = keys_at(map, scene_refine_rows[i].name);
        if (!value->node) continue;
        if (chosen) {
            keys_error(&draft->keys, value, "one criterion each: '%s' is already given", chosen->key->name);
            diag_help(draft->keys.diag, "a cell is refined if any entry of 'refine' asks for it");
            return NULL;
        }
        chosen = value;
        refine->kind = (enum scene_refine_kind)i;
    }
    if (chosen) return chosen;
    diag_error(draft->keys.diag, &map->node->mark, "%s: nothing is said about what asks for refinement", map->path);
    diag_help(draft->keys.diag, "one of gradient, jump, value, interface, lua, region");
    return NULL;
}

/* Keys that mean nothing beside the chosen one. */
static void scene_refine_strangers(struct draft *draft, const struct keys_map *map, const struct scene_refine *refine,
                                   const struct keys_value *chosen)
{
    bool differs = scene_refine_differs(refine), value = refine->kind == SCENE_REFINE_VALUE;
    const struct keys_value *keys[] = {keys_at(map, "above"), keys_at(map, "below"), keys_at(map, "relative"),
                                       keys_at(map, "where")};
    bool fits[] = {differs || value, value, differs, refine->kind != SCENE_REFINE_REGION};
    for (unsigned i = 0; i < sizeof keys / sizeof *keys; i++) {
        if (!keys[i]->node || fits[i]) continue;
        keys_error(&draft->keys, keys[i], "'%s' does not go with '%s'", keys[i]->key->name, chosen->key->name);
        if (i == 1 && differs) diag_help(draft->keys.diag, "'value' takes 'below'");
        if (i == 3) diag_help(draft->keys.diag, "'region: {intersection: [...]}' combines shapes");
    }
}

/* The field, if it is one that can tell cells of a level apart; else NULL after a recorded error. */
static const struct scene_field *scene_refine_field(struct draft *draft, const struct keys_value *value,
                                                    char ret_name[SCENE_NAME])
{
    if (value->given && scene_formula_is(value)) {
        keys_error(&draft->keys, value, "the name of a field is needed, not an expression");
        diag_help(draft->keys.diag, "'lua: = pressure > 1e6' refines by an expression");
        return NULL;
    }
    if (!scene_field_name(draft, value, ret_name)) return NULL;
    const char *constant = scene_field_constant(draft, ret_name);
    if (!constant) return scene_field_find(draft, ret_name);
    keys_error(&draft->keys, value, "'%s' cannot tell where to refine: it is %s", ret_name, constant);
    return NULL;
}

static bool scene_refine_pure(const struct unit *unit)
{
    static const struct unit one;
    return unit_same(unit, &one);
}

/* Is a number with a unit what is wanted? Records an error if not. A number without a unit always is. */
static bool scene_refine_fits(struct draft *draft, const struct keys_value *number, const char *wanted_unit,
                              const char *what)
{
    struct unit wanted;
    char bad[32], words[80];
    unit_parse(strcmp(wanted_unit, "1") == 0 ? "" : wanted_unit, &wanted, bad);
    if (number->bare || unit_same(&number->unit, &wanted)) return true;
    keys_error(&draft->keys, number, "this is %s, but %s is %s", unit_kind(&number->unit, words, sizeof words), what,
               scene_refine_pure(&wanted) ? "a pure number" : tree_print(draft->keys.forest, "in %s", wanted_unit));
    return false;
}

/* Largest relative difference that two neighbouring cells can have. */
static double scene_refine_most(const struct scene_field *field)
{
    bool one_sign = field->is & (SCENE_FIELD_POSITIVE | SCENE_FIELD_FRACTION | SCENE_FIELD_VANISHING);
    return one_sign && !(field->is & (SCENE_FIELD_VECTOR | SCENE_FIELD_SIGNED)) ? 1 : 2;
}

static void scene_refine_relative(struct draft *draft, const struct scene_field *field, const struct keys_value *above)
{
    const char *unit = strcmp(field->unit, "1") == 0 ? "" : field->unit;
    double most = scene_refine_most(field);
    if (above->number >= most) {
        keys_error(&draft->keys, above, "a relative jump of '%s' is never above %g", field->name, most);
        if (*unit) diag_help(draft->keys.diag, "an absolute threshold has a unit: 'above: %g %s'", above->number, unit);
        else diag_help(draft->keys.diag, "an absolute threshold has 'relative: false'");
    } else if (field->is & SCENE_FIELD_VANISHING) {
        diag_warn(draft->keys.diag, &above->node->mark,
                  "%s: '%s' may be nearly 0, where relative jumps are large and mean nothing", above->path,
                  field->name);
        if (*unit) diag_help(draft->keys.diag, "an absolute threshold has a unit: 'above: 10 %s'", unit);
        else diag_help(draft->keys.diag, "an absolute threshold has 'relative: false'");
    }
}

/* gradient and jump: what kind of number is `above`? Fills relative and, for fractions, the scale 1. */
static void scene_refine_difference(struct draft *draft, struct scene_refine *refine, const struct keys_map *map,
                                    const struct scene_field *field)
{
    const struct keys_value *above = keys_at(map, "above"), *relative = keys_at(map, "relative");
    struct forest *forest = draft->keys.forest;
    bool gradient = refine->kind == SCENE_REFINE_GRADIENT, pure = above->bare || scene_refine_pure(&above->unit);
    if (above->number < 0) {
        keys_error(&draft->keys, above, "a difference is never below 0");
        return;
    }
    bool mach = strcmp(field->name, "mach") == 0 && !gradient; /* an absolute jump of it is a pure number too */
    refine->relative = relative->given ? relative->integer != 0 : pure && !mach;
    const char *unit = gradient ? tree_print(forest, "%s/m", field->unit) : field->unit;
    const char *what = tree_print(forest, "a %s of '%s'", gradient ? "gradient" : "jump", field->name);
    if (refine->relative) {
        unit = "1";
        what = "a relative jump";
    }
    if (!scene_refine_fits(draft, above, unit, what)) {
        if (gradient && !refine->relative)
            diag_help(draft->keys.diag, "a difference between neighbouring cells is a 'jump'");
        return;
    }
    if (above->unit.offset != 0) keys_error(&draft->keys, above, "a difference of temperatures is given in K");
    if (refine->relative) scene_refine_relative(draft, field, above);
    tree_set(forest, map->node, "relative",
             tree_scalar(forest, &map->node->mark, TREE_PLAIN, refine->relative ? "true" : "false"));
    if (refine->relative && field->is & SCENE_FIELD_FRACTION) {
        refine->kind = SCENE_REFINE_JUMP;
        refine->relative = false;
    }
}

static void scene_refine_window(struct draft *draft, const struct scene_refine *refine, const struct keys_map *map,
                                const struct scene_field *field)
{
    const struct keys_value *above = keys_at(map, "above"), *below = keys_at(map, "below");
    const char *what = tree_print(draft->keys.forest, "'%s'", field->name);
    bool good = !above->given || scene_refine_fits(draft, above, field->unit, what);
    good &= !below->given || scene_refine_fits(draft, below, field->unit, what);
    if (good && refine->has_above && refine->has_below && refine->above >= refine->below) {
        keys_error(&draft->keys, below, "nothing is both above %g and below %g", refine->above, refine->below);
        diag_help(draft->keys.diag, "two entries, one with 'above' and one with 'below', refine outside of a range");
    }
    if (good && refine->has_above && field->is & SCENE_FIELD_FRACTION && refine->above >= 1)
        keys_error(&draft->keys, above, "'%s' is never above 1", field->name);
    if (good && refine->has_below && field->is & (SCENE_FIELD_POSITIVE | SCENE_FIELD_FRACTION) && refine->below <= 0)
        keys_error(&draft->keys, below, "'%s' is never below 0", field->name);
}

static void scene_refine_threshold(struct draft *draft, struct scene_refine *refine, const struct keys_map *map,
                                   const struct keys_value *chosen)
{
    const struct keys_value *above = keys_at(map, "above"), *below = keys_at(map, "below");
    const struct scene_field *field = scene_refine_field(draft, chosen, refine->field);
    bool differs = scene_refine_differs(refine);
    refine->unit = field ? field->unit : NULL;
    refine->has_above = above->given;
    refine->has_below = below->given;
    refine->above = above->number;
    refine->below = below->number;
    if (!above->node && (differs || !below->node)) {
        keys_error(&draft->keys, chosen, "%s: how much asks for refinement",
                   differs ? "'above' is missing" : "'above' or 'below' is missing");
        return;
    }
    if (!field || (above->node && !above->given) || (below->node && !below->given)) return;
    if (differs) scene_refine_difference(draft, refine, map, field);
    else scene_refine_window(draft, refine, map, field);
}

static void scene_refine_surface(struct draft *draft, struct scene_refine *refine, const struct keys_value *chosen)
{
    refine->material = scene_matter_index(draft, chosen);
    if (refine->material < 0 || draft->scene->n_material > 1) return;
    keys_error(&draft->keys, chosen, "'%s' is the only material, so it has no surface", chosen->text);
}

/* A function says by the names of its parameters what it wants. */
static void scene_refine_function(struct draft *draft, struct scene_refine *refine, const struct keys_value *value)
{
    const char *name;
    refine->script = scene_file_lua(draft, value);
    for (unsigned i = 0; refine->script && (name = script_parameter(refine->script, i)) != NULL; i++) {
        if (!scene_formula_argument(draft, name)) {
            keys_error(&draft->keys, value, "'%s', which the function wants, is no field of one component", name);
            scene_formula_help(draft);
            return;
        }
        if (!scene_formula_use(draft, value, name, refine->uses, &refine->n_use)) return;
    }
}

static void scene_refine_script(struct draft *draft, struct scene_refine *refine, const struct keys_value *value)
{
    if (!value->given) return;
    const char *text = value->text;
    size_t length = strlen(text);
    bool file = length > 4 && strcmp(text + length - 4, ".lua") == 0;
    refine->uses = mem_new(SCRIPT_ARGUMENTS, sizeof *refine->uses);
    if (params_is_expression(value->node) || (!file && !params_mentions(text, "function,return")))
        scene_formula_compile(draft, value, value->node, refine->uses, &refine->n_use, &refine->script);
    else scene_refine_function(draft, refine, value);
}

static void scene_refine_limits(struct draft *draft, struct scene_refine *refine, const struct keys_map *map)
{
    const struct keys_value *where = keys_at(map, "where"), *finest = keys_at(map, "finest"),
                            *from = keys_at(map, "from"), *until = keys_at(map, "until"), *which;
    const struct scene *scene = draft->scene;
    if (where->given && !refine->where) refine->where = scene_shape(draft, where->map, true, &which);
    refine->finest = finest->given && finest->integer < scene->mesh.levels ? (int)finest->integer : scene->mesh.levels;
    refine->t_from = from->number;
    refine->t_until = until->given ? until->number : INFINITY;
    if (until->given && from->number > until->number)
        keys_error(&draft->keys, until, "%g s is before 'from', %g s", until->number, from->number);
    else if (from->given && scene->run.until > 0 && from->number >= scene->run.until)
        diag_warn(draft->keys.diag, &from->node->mark, "%s: the run ends before that, at %g s", from->path,
                  scene->run.until);
}

static void scene_refine_read(struct draft *draft, struct scene_refine *refine, const struct keys_map *map)
{
    const struct keys_value *which;
    refine->material = -1;
    refine->line = map->node->mark.line;
    const struct keys_value *chosen = scene_refine_chosen(draft, map, refine);
    if (!chosen) return;
    scene_refine_strangers(draft, map, refine, chosen);
    switch (refine->kind) {
    case SCENE_REFINE_INTERFACE: scene_refine_surface(draft, refine, chosen); break;
    case SCENE_REFINE_SCRIPT: scene_refine_script(draft, refine, chosen); break;
    case SCENE_REFINE_REGION: refine->where = scene_shape(draft, chosen->map, true, &which); break;
    default: scene_refine_threshold(draft, refine, map, chosen); break;
    }
    scene_refine_limits(draft, refine, map);
}

void scene_refine(struct draft *draft)
{
    const struct keys_value *list = keys_at(keys_at(draft->root, "mesh")->map, "refine");
    struct scene *scene = draft->scene;
    scene->mesh.refines = mem_new(list->count + 1, sizeof *scene->mesh.refines);
    for (unsigned i = 0; i < list->count; i++)
        if (list->list[i].map)
            scene_refine_read(draft, &scene->mesh.refines[scene->mesh.n_refine++], list->list[i].map);
}
