/* scene_field.c - the names of fields, as cases, files and pictures use them. */
#include "case/scene_draft.h"

#include "base/mem.h"
#include "base/text.h"

#include <string.h>

static const struct scene_field scene_field_plain[] = {
    {"density", "kg/m3", SCENE_FIELD_POSITIVE},
    {"pressure", "Pa", 0},
    {"velocity", "m/s", SCENE_FIELD_VECTOR | SCENE_FIELD_VANISHING},
    {"velocity_x", "m/s", SCENE_FIELD_VANISHING | SCENE_FIELD_SIGNED},
    {"velocity_y", "m/s", SCENE_FIELD_VANISHING | SCENE_FIELD_SIGNED},
    {"velocity_z", "m/s", SCENE_FIELD_VANISHING | SCENE_FIELD_SIGNED},
    {"temperature", "K", SCENE_FIELD_POSITIVE},
    {"sound_speed", "m/s", SCENE_FIELD_POSITIVE},
    {"mach", "1", SCENE_FIELD_VANISHING},
    {"internal_energy", "J/kg", 0},
    {"total_energy", "J/m3", 0},
    {"vorticity", "1/s", SCENE_FIELD_VECTOR | SCENE_FIELD_VANISHING},
    {"heat_flux", "W/m2", SCENE_FIELD_VECTOR | SCENE_FIELD_VANISHING},
    {"schlieren", "1", SCENE_FIELD_FRACTION},
    {"surface_energy", "J/m3", SCENE_FIELD_VANISHING},
    {"level", "1", 0},
    {"rank", "1", 0},
    {"cost", "1", SCENE_FIELD_POSITIVE},
};

/* Followed by _ and the name of a material. */
static const struct scene_field scene_field_by_material[] = {
    {"alpha", "1", SCENE_FIELD_FRACTION},
    {"density", "kg/m3", SCENE_FIELD_VANISHING},
    {"temperature", "K", SCENE_FIELD_VANISHING},
    {"partial_density", "kg/m3", SCENE_FIELD_VANISHING},
    {"curvature", "1/m", SCENE_FIELD_VANISHING | SCENE_FIELD_SIGNED},
};

enum {
    SCENE_FIELD_PLAIN = sizeof scene_field_plain / sizeof *scene_field_plain,
    SCENE_FIELD_EACH = sizeof scene_field_by_material / sizeof *scene_field_by_material
};

/* In scenes with a solid (derive_stress.h). */
static const struct scene_field scene_field_solid[] = {
    {"stress_xx", "Pa", 0},
    {"stress_yy", "Pa", 0},
    {"stress_zz", "Pa", 0},
    {"stress_xy", "Pa", SCENE_FIELD_VANISHING | SCENE_FIELD_SIGNED},
    {"stress_xz", "Pa", SCENE_FIELD_VANISHING | SCENE_FIELD_SIGNED},
    {"stress_yz", "Pa", SCENE_FIELD_VANISHING | SCENE_FIELD_SIGNED},
    {"stretch_xx", "1", SCENE_FIELD_POSITIVE},
    {"stretch_yy", "1", SCENE_FIELD_POSITIVE},
    {"stretch_zz", "1", SCENE_FIELD_POSITIVE},
    {"stretch_xy", "1", SCENE_FIELD_VANISHING | SCENE_FIELD_SIGNED},
    {"stretch_xz", "1", SCENE_FIELD_VANISHING | SCENE_FIELD_SIGNED},
    {"stretch_yz", "1", SCENE_FIELD_VANISHING | SCENE_FIELD_SIGNED},
    {"stretch_max", "1", SCENE_FIELD_POSITIVE},
    {"sigma_max", "Pa", 0},
    {"sigma_min", "Pa", 0},
    {"sigma_shear", "Pa", SCENE_FIELD_VANISHING},
    {"sigma_max_dev", "Pa", SCENE_FIELD_VANISHING | SCENE_FIELD_SIGNED},
    {"sigma_min_dev", "Pa", SCENE_FIELD_VANISHING | SCENE_FIELD_SIGNED},
    {"principal_max", "Pa", 0},
    {"principal_min", "Pa", 0},
    {"principal_shear", "Pa", SCENE_FIELD_VANISHING},
    {"principal_max_dev", "Pa", SCENE_FIELD_VANISHING},
    {"principal_min_dev", "Pa", SCENE_FIELD_VANISHING},
    {"von_mises", "Pa", SCENE_FIELD_VANISHING},
    {"strain_energy", "J/m3", SCENE_FIELD_VANISHING},
    {"invariant_1", "1", SCENE_FIELD_POSITIVE},
    {"invariant_2", "1", SCENE_FIELD_POSITIVE},
};
enum { SCENE_FIELD_SOLID = sizeof scene_field_solid / sizeof *scene_field_solid };

/* In scenes where a solid has a strength, and where that knows plastic strains. */
static const struct scene_field scene_field_plastic[] = {
    {"flow_stress", "Pa", SCENE_FIELD_VANISHING},
    {"plastic_strain", "1", SCENE_FIELD_VANISHING},
};

enum { SCENE_FIELD_PLASTIC = sizeof scene_field_plastic / sizeof *scene_field_plastic };

/* In scenes where a solid has Maxwell branches. */
static const struct scene_field scene_field_branched = {"overstress", "Pa", SCENE_FIELD_VANISHING};

/* In scenes where a solid can break. */
static const struct scene_field scene_field_breaking = {"damage", "1", SCENE_FIELD_FRACTION};

/* In scenes with rigid bodies. */
static const struct scene_field scene_field_body = {"body", "1", SCENE_FIELD_FRACTION};

/* In scenes where a material is viscous (derive_viscous.h). */
static const struct scene_field scene_field_viscous[] = {
    {"stress_viscous_xx", "Pa", SCENE_FIELD_VANISHING | SCENE_FIELD_SIGNED},
    {"stress_viscous_yy", "Pa", SCENE_FIELD_VANISHING | SCENE_FIELD_SIGNED},
    {"stress_viscous_zz", "Pa", SCENE_FIELD_VANISHING | SCENE_FIELD_SIGNED},
    {"stress_viscous_xy", "Pa", SCENE_FIELD_VANISHING | SCENE_FIELD_SIGNED},
    {"stress_viscous_xz", "Pa", SCENE_FIELD_VANISHING | SCENE_FIELD_SIGNED},
    {"stress_viscous_yz", "Pa", SCENE_FIELD_VANISHING | SCENE_FIELD_SIGNED},
    {"dissipation", "W/m3", SCENE_FIELD_VANISHING},
};

enum { SCENE_FIELD_VISCOUS = sizeof scene_field_viscous / sizeof *scene_field_viscous };

/* Of a vapour whose liquid is in the scene (derive_vapour.h), followed by _ and its name. */
static const struct scene_field scene_field_vapour[] = {
    {"quality", "1", SCENE_FIELD_FRACTION},
    {"saturation_pressure", "Pa", SCENE_FIELD_VANISHING},
    {"saturation_temperature", "K", SCENE_FIELD_VANISHING},
    {"superheat", "K", SCENE_FIELD_VANISHING | SCENE_FIELD_SIGNED},
};

enum { SCENE_FIELD_VAPOUR = sizeof scene_field_vapour / sizeof *scene_field_vapour };

static bool scene_field_is_solid(const char *name)
{
    for (unsigned i = 0; i < SCENE_FIELD_SOLID; i++)
        if (strcmp(scene_field_solid[i].name, name) == 0) return true;
    return false;
}

static bool scene_field_is_plastic(const char *name)
{
    for (unsigned i = 0; i < SCENE_FIELD_PLASTIC; i++)
        if (strcmp(scene_field_plastic[i].name, name) == 0) return true;
    return false;
}

/* A field of viscous stress in a scene without any. */
static bool scene_field_miss_viscosity(struct draft *draft, const struct keys_value *value)
{
    for (unsigned i = 0; i < SCENE_FIELD_VISCOUS; i++) {
        if (strcmp(scene_field_viscous[i].name, value->text) != 0) continue;
        keys_error(&draft->keys, value, "'%s' is a field of viscous materials, and no material has a 'viscosity'",
                   value->text);
        return true;
    }
    return false;
}

/* A field of strengths in a scene that has none, or none that knows strains. */
static bool scene_field_miss_strength(struct draft *draft, const struct keys_value *value)
{
    if (!scene_field_is_plastic(value->text)) return false;
    if (scene_matter_strength(draft) == 0) {
        keys_error(&draft->keys, value,
                   "'%s' is a field of solids with a strength, and no material has a 'plastic' law", value->text);
    } else {
        keys_error(&draft->keys, value, "no strength here looks at plastic strain, so there is no field '%s'",
                   value->text);
        diag_help(draft->keys.diag, "'strain: always' in a von-mises law keeps it all the same");
    }
    return true;
}

/* A field of damage in a scene where nothing can break. */
static bool scene_field_miss_damage(struct draft *draft, const struct keys_value *value)
{
    if (strcmp(value->text, scene_field_breaking.name) != 0) return false;
    keys_error(&draft->keys, value, "'%s' is a field of solids that can break, and no material has a 'damage' law",
               value->text);
    return true;
}

/* A field of solids in a scene of fluids. */
static bool scene_field_miss_solid(struct draft *draft, const struct keys_value *value)
{
    if (!scene_field_is_solid(value->text)) return false;
    keys_error(&draft->keys, value, "'%s' is a field of solids, and no material has a 'constitutive' law", value->text);
    return true;
}

bool scene_field_miss(struct draft *draft, const struct keys_value *value)
{
    return scene_field_miss_strength(draft, value) || scene_field_miss_viscosity(draft, value) ||
           scene_field_miss_damage(draft, value) || scene_field_miss_solid(draft, value);
}

bool scene_field_is_vector(const char *name)
{
    for (unsigned i = 0; i < SCENE_FIELD_PLAIN; i++)
        if (strcmp(scene_field_plain[i].name, name) == 0) return scene_field_plain[i].is & SCENE_FIELD_VECTOR;
    return false;
}

/* Appends the fields of modules; returns the end of the list. */
static struct scene_field *scene_field_derived(struct draft *draft, struct scene_field *list)
{
    const struct scene *scene = draft->scene;
    static const unsigned words[][2] = {{BULLA_FIELD_POSITIVE, SCENE_FIELD_POSITIVE},
                                        {BULLA_FIELD_VANISHING, SCENE_FIELD_VANISHING},
                                        {BULLA_FIELD_SIGNED, SCENE_FIELD_VANISHING | SCENE_FIELD_SIGNED},
                                        {BULLA_FIELD_FRACTION, SCENE_FIELD_FRACTION}};
    for (unsigned i = 0; i < scene->n_derived; i++) {
        const struct bulla_field *law = scene->derived[i].law.module->table;
        for (unsigned k = 0; law->outputs[k].unit; k++, list++) {
            const char *name = tree_print(draft->keys.forest, "%s", scene->derived[i].names[k]);
            *list = (struct scene_field){.name = name, .unit = law->outputs[k].unit};
            for (size_t w = 0; w < sizeof words / sizeof *words; w++)
                if (law->outputs[k].is & words[w][0]) list->is |= words[w][1];
        }
    }
    return list;
}

const struct scene_field *scene_field_all(struct draft *draft)
{
    const struct scene *scene = draft->scene;
    struct forest *forest = draft->keys.forest;
    unsigned count = SCENE_FIELD_PLAIN, most = count + SCENE_FIELD_SOLID + SCENE_FIELD_PLASTIC + SCENE_FIELD_VISCOUS +
                                               3 + (SCENE_FIELD_EACH + SCENE_FIELD_VAPOUR) * scene->n_material;
    most += scene->n_derived * BULLA_FIELD_OUTPUTS;
    most += 4 * scene->output.n_peak;
    struct scene_field *list = tree_take(forest, (most + 1) * sizeof *list);
    memcpy(list, scene_field_plain, sizeof scene_field_plain);
    if (scene_matter_solid(draft)) {
        memcpy(list + count, scene_field_solid, sizeof scene_field_solid);
        count += SCENE_FIELD_SOLID;
    }
    for (unsigned i = 0; i < scene_matter_strength(draft); i++) list[count++] = scene_field_plastic[i];
    if (scene_matter_branched(draft)) list[count++] = scene_field_branched;
    if (scene_matter_breaks(draft)) list[count++] = scene_field_breaking;
    if (keys_at(draft->root, "bodies")->count) list[count++] = scene_field_body;
    for (unsigned i = 0; scene_matter_viscous(draft) && i < SCENE_FIELD_VISCOUS; i++)
        list[count++] = scene_field_viscous[i];
    for (unsigned i = 0; i < scene->n_material; i++)
        for (unsigned k = 0; k < SCENE_FIELD_EACH; k++) {
            list[count] = scene_field_by_material[k];
            list[count++].name = tree_print(forest, "%s_%s", scene_field_by_material[k].name, scene->material[i].name);
        }
    for (unsigned i = 0; i < scene->n_phase; i++)
        for (unsigned k = 0; k < SCENE_FIELD_VAPOUR; k++) {
            const char *vapour = scene->material[scene->phases[i].vapour].name;
            list[count] = scene_field_vapour[k];
            list[count++].name = tree_print(forest, "%s_%s", scene_field_vapour[k].name, vapour);
        }
    count = (unsigned)(scene_field_derived(draft, list + count) - list);
    scene_peak_list(draft, list, list + count);
    return list;
}

const char *const *scene_field_always(struct forest *forest)
{
    enum { SOLID = SCENE_FIELD_PLAIN, PLASTIC = SOLID + SCENE_FIELD_SOLID };
    enum { VISCOUS = PLASTIC + SCENE_FIELD_PLASTIC, ALL = VISCOUS + SCENE_FIELD_VISCOUS + 3 };
    const char **names = tree_take(forest, (ALL + 1) * sizeof *names);
    for (unsigned i = 0; i < SCENE_FIELD_PLAIN; i++) names[i] = scene_field_plain[i].name;
    for (unsigned i = 0; i < SCENE_FIELD_SOLID; i++) names[SOLID + i] = scene_field_solid[i].name;
    for (unsigned i = 0; i < SCENE_FIELD_PLASTIC; i++) names[PLASTIC + i] = scene_field_plastic[i].name;
    names[ALL - 3] = scene_field_breaking.name;
    names[ALL - 2] = scene_field_branched.name;
    names[ALL - 1] = scene_field_body.name;
    for (unsigned i = 0; i < SCENE_FIELD_VISCOUS; i++) names[VISCOUS + i] = scene_field_viscous[i].name;
    return names;
}

const char *const *scene_field_each(struct forest *forest)
{
    const char **names = tree_take(forest, (SCENE_FIELD_EACH + SCENE_FIELD_VAPOUR + 1) * sizeof *names);
    for (unsigned i = 0; i < SCENE_FIELD_EACH; i++) names[i] = scene_field_by_material[i].name;
    for (unsigned i = 0; i < SCENE_FIELD_VAPOUR; i++) names[SCENE_FIELD_EACH + i] = scene_field_vapour[i].name;
    return names;
}

const struct scene_field *scene_field_find(struct draft *draft, const char *name)
{
    for (const struct scene_field *field = scene_field_all(draft); field->name; field++)
        if (strcmp(field->name, name) == 0) return field;
    return NULL;
}

/* Velocities that a scene needs for a shear component of a tensor not to be 0; 0 for other fields. */
static int scene_field_shear(const char *name)
{
    if (strncmp(name, "stress_", 7) != 0 && strncmp(name, "stretch_", 8) != 0) return 0;
    const char *component = strrchr(name, '_') + 1;
    return strcmp(component, "xy") == 0 ? 2 : strcmp(component, "xz") == 0 || strcmp(component, "yz") == 0 ? 3 : 0;
}

const char *scene_field_constant(struct draft *draft, const char *name)
{
    const struct scene *scene = draft->scene;
    bool one = scene->n_material == 1, y = strcmp(name, "velocity_y") == 0, z = strcmp(name, "velocity_z") == 0;
    if (strcmp(name, "level") == 0) return "the same in all cells of a level";
    if (strcmp(name, "rank") == 0) return "a matter of how many ranks compute, on which results do not depend";
    if ((y && scene->domain.n_velocity < 2) || (z && scene->domain.n_velocity < 3))
        return "0 everywhere: velocities have no such component";
    if (scene->domain.n_velocity < scene_field_shear(name)) return "0 everywhere: nothing moves across these axes";
    if (strcmp(name, "vorticity") == 0 && scene->domain.n_velocity == 1)
        return "0 everywhere: velocities have one component";
    if (strcmp(name, "heat_flux") == 0 && !scene_matter_conducts(draft)) return "0 everywhere: no material conducts";
    if (one && (strcmp(name, "cost") == 0 || strncmp(name, "alpha_", 6) == 0))
        return "1 everywhere: there is one material";
    if (strcmp(name, "surface_energy") == 0 && scene->n_tension == 0)
        return "0 everywhere: no pair of materials has a surface tension";
    if (strncmp(name, "curvature_", 10) == 0) {
        if (one) return "0 everywhere: there is one material";
        if (scene->domain.dim == 1 && scene->domain.geometry == SCENE_CARTESIAN)
            return "0 everywhere: surfaces are planes";
    }
    return NULL;
}
