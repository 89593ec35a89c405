/* derive.c - named fields from primitives, see derive.h.
 *
 * One table row per quantity: a point-wise function of a tile's primitives, here or, for solids, in derive_stress.c, or
 * one of gradients (derive_slope.c), and what it needs that the tile does not hold. */
#include "derive/derive.h"

#include "base/comm.h"
#include "base/mem.h"
#include "base/status.h"
#include "base/text.h"
#include "derive/derive_curvature.h"
#include "derive/derive_formula.h"
#include "derive/derive_heat.h"
#include "derive/derive_law.h"
#include "derive/derive_slope.h"
#include "derive/derive_stress.h"
#include "derive/derive_vapour.h"
#include "derive/derive_viscous.h"
#include "mesh/rigid.h"
#include "phys/mix.h"
#include "phys/presence.h"

#include <math.h>
#include <string.h>

/* What a name stands for: DERIVE_STRONG needs a solid with a strength, DERIVE_STRAINED one whose strength knows
 * strains, DERIVE_BREAKING one that can break; DERIVE_OF_SCENE is a name of the case's own. */
enum derive_form {
    DERIVE_ONE,
    DERIVE_VECTOR,
    DERIVE_AXIS,
    DERIVE_MATERIAL,
    DERIVE_SOLID,
    DERIVE_TENSOR,
    DERIVE_STRONG,
    DERIVE_STRAINED,
    DERIVE_BREAKING,
    DERIVE_BRANCHED,
    DERIVE_RIGID,          /* of scenes with rigid bodies */
    DERIVE_VISCOUS,        /* of scenes with a viscous material */
    DERIVE_VISCOUS_TENSOR, /* by component */
    DERIVE_VAPOUR,         /* by material, of those that are the vapour of a liquid */
    DERIVE_OF_SCENE
};

struct derive_quantity {
    const char *name; /* with a trailing "_" for per-material, per-axis and tensor quantities */
    const char *unit;
    enum derive_form form;
    void (*compute)(const struct derive_view *tile, double *out);
    int index; /* DERIVE_SOLID: tells rows with the same function apart */
    unsigned needs;
};

/* What a quantity needs beyond the primitives of a tile; derive_prepare brings it. */
enum {
    DERIVE_ALONE = 0,
    DERIVE_LAYERS = 1,     /* the layers of neighbours */
    DERIVE_STEEPEST = 2,   /* the largest density gradient of all, in field->scale */
    DERIVE_AROUND = 8,     /* what lies around tiles, edges and corners too */
    DERIVE_ARGUMENTS = 16, /* what the arguments of an expression need */
    DERIVE_DECLARED = 32,  /* what its module says */
    DERIVE_PRESENCE = 4,   /* the density from which on its material is felt (presence.h), in field->scale */
};

static void derive_density(const struct derive_view *tile, double *out)
{
    memset(out, 0, tile->n * sizeof *out);
    for (unsigned l = 0; l < tile->model->n_material; l++)
        for (size_t i = 0; i < tile->n; i++)
            out[i] += derive_view_alpha(tile, l, i) * derive_view_w(tile, tile->model->i_m + l)[i];
}

static void derive_pressure(const struct derive_view *tile, double *out)
{
    memcpy(out, derive_view_w(tile, tile->model->i_E), tile->n * sizeof *out);
}

static void derive_velocity_axis(const struct derive_view *tile, double *out)
{
    int axis = tile->field->index;
    if (axis < (int)tile->model->n_velocity)
        memcpy(out, derive_view_w(tile, tile->model->i_u + (unsigned)axis), tile->n * sizeof *out);
    else memset(out, 0, tile->n * sizeof *out);
}

static void derive_velocity(const struct derive_view *tile, double *out)
{
    struct derive axis = *tile->field;
    struct derive_view one = *tile;
    one.field = &axis;
    for (axis.index = 0; axis.index < 3; axis.index++) derive_velocity_axis(&one, out + (size_t)axis.index * tile->n);
}

static double derive_speed2(const struct derive_view *tile, size_t i)
{
    double sum = 0.0;
    for (unsigned d = 0; d < tile->model->n_velocity; d++) {
        double u = derive_view_w(tile, tile->model->i_u + d)[i];
        sum += u * u;
    }
    return sum;
}

/* Wood: 1/(rho c^2) = sum alpha_l / (rho_l c_l^2). The solver itself uses the frozen speed. */
static void derive_sound_speed(const struct derive_view *tile, double *out)
{
    const struct model *model = tile->model;
    double *rho_c2 = mem_new((model->n_material + 1) * tile->n, sizeof *rho_c2);
    double *rho = rho_c2 + model->n_material * tile->n;
    mix_stiffness(model, tile->n, tile->n, tile->w, rho_c2);
    derive_density(tile, rho);
    for (size_t i = 0; i < tile->n; i++) {
        double compliance = 0.0;
        for (unsigned l = 0; l < model->n_material; l++) {
            double alpha = derive_view_alpha(tile, l, i), stiff = rho_c2[l * tile->n + i];
            if (alpha > 0.0 && stiff > 0.0) compliance += alpha / stiff; /* as in mix_closure */
        }
        out[i] = sqrt(1.0 / (rho[i] * compliance));
    }
    mem_free(rho_c2);
}

static void derive_mach(const struct derive_view *tile, double *out)
{
    derive_sound_speed(tile, out);
    for (size_t i = 0; i < tile->n; i++) out[i] = sqrt(derive_speed2(tile, i)) / out[i];
}

static void derive_total_energy(const struct derive_view *tile, double *out)
{
    const struct model *model = tile->model;
    double *u = mem_new(model->n_field * tile->n, sizeof *u);
    mix_conserved(model, tile->n, tile->n, tile->w, u);
    memcpy(out, u + model->i_E * tile->n, tile->n * sizeof *out);
    mem_free(u);
}

/* Specific internal energy e [J/kg]. */
static void derive_internal_energy(const struct derive_view *tile, double *out)
{
    double *rho = mem_new(tile->n, sizeof *rho);
    derive_density(tile, rho);
    derive_total_energy(tile, out);
    for (size_t i = 0; i < tile->n; i++) out[i] = out[i] / rho[i] - 0.5 * derive_speed2(tile, i);
    mem_free(rho);
}

/* T_l where the material is felt (presence.h) and has one, else 0: a gas that a stretched solid pulls has p_l < 0. */
static void derive_material_temperature(const struct derive_view *tile, double *out)
{
    unsigned l = (unsigned)tile->field->index;
    double *T = mem_new(tile->model->n_material * tile->n, sizeof *T);
    const double *own = T + l * tile->n, *rho = derive_view_w(tile, tile->model->i_m + l);
    mix_temperatures(tile->model, tile->n, tile->n, tile->w, T);
    for (size_t i = 0; i < tile->n; i++) {
        bool felt = derive_view_alpha(tile, l, i) >= PRESENCE_FRACTION && rho[i] >= tile->field->scale;
        out[i] = felt && own[i] > 0.0 ? own[i] : 0.0;
    }
    mem_free(T);
}

/* T = sum Y_l T_l (model.md 6). */
static void derive_temperature(const struct derive_view *tile, double *out)
{
    const struct model *model = tile->model;
    double *T = mem_new((model->n_material + 1) * tile->n, sizeof *T), *rho = T + model->n_material * tile->n;
    mix_temperatures(model, tile->n, tile->n, tile->w, T);
    derive_density(tile, rho);
    memset(out, 0, tile->n * sizeof *out);
    for (unsigned l = 0; l < model->n_material; l++)
        for (size_t i = 0; i < tile->n; i++)
            out[i] +=
                derive_view_alpha(tile, l, i) * derive_view_w(tile, model->i_m + l)[i] / rho[i] * T[l * tile->n + i];
    mem_free(T);
}

static void derive_fraction(const struct derive_view *tile, double *out)
{
    for (size_t i = 0; i < tile->n; i++) out[i] = derive_view_alpha(tile, (unsigned)tile->field->index, i);
}

/* rho_l where the material is present, else 0. */
static void derive_material_density(const struct derive_view *tile, double *out)
{
    unsigned l = (unsigned)tile->field->index;
    for (size_t i = 0; i < tile->n; i++)
        out[i] = derive_view_alpha(tile, l, i) > 0.0 ? derive_view_w(tile, tile->model->i_m + l)[i] : 0.0;
}

static void derive_partial_density(const struct derive_view *tile, double *out)
{
    unsigned l = (unsigned)tile->field->index;
    for (size_t i = 0; i < tile->n; i++)
        out[i] = derive_view_alpha(tile, l, i) * derive_view_w(tile, tile->model->i_m + l)[i];
}

/* What rigid bodies cover of cells. */
static void derive_body(const struct derive_view *tile, double *out)
{
    const struct level *level = tile->level;
    for (size_t i = 0; i < tile->n; i++) out[i] = 1.0;
    rigid_weigh(tile->mesh, level, &level->tiles[level->first + tile->local], tile->t, out);
    for (size_t i = 0; i < tile->n; i++) out[i] = 1.0 - out[i];
}

static void derive_level(const struct derive_view *tile, double *out)
{
    for (size_t i = 0; i < tile->n; i++) out[i] = tile->level_index;
}

static void derive_rank(const struct derive_view *tile, double *out)
{
    for (size_t i = 0; i < tile->n; i++) out[i] = comm_rank();
}

/* Work per cell relative to a cell of one material: the number of materials present. */
static void derive_cost(const struct derive_view *tile, double *out)
{
    for (size_t i = 0; i < tile->n; i++) {
        out[i] = 0.0;
        for (unsigned l = 0; l < tile->model->n_material; l++) out[i] += derive_view_alpha(tile, l, i) > 0.0;
    }
}

/* What the tile keeps of a field (solve/peak.h): row field->index. */
static void derive_kept(const struct derive_view *tile, double *out)
{
    memcpy(out, tile->level->kept[tile->local] + (size_t)tile->field->index * tile->n, tile->n * sizeof *out);
}

static const struct derive_quantity derive_table[] = {
    {"density", "kg/m3", DERIVE_ONE, derive_density, 0, DERIVE_ALONE},
    {"pressure", "Pa", DERIVE_ONE, derive_pressure, 0, DERIVE_ALONE},
    {"velocity", "m/s", DERIVE_VECTOR, derive_velocity, 0, DERIVE_ALONE},
    {"velocity_", "m/s", DERIVE_AXIS, derive_velocity_axis, 0, DERIVE_ALONE},
    {"temperature", "K", DERIVE_ONE, derive_temperature, 0, DERIVE_ALONE},
    {"sound_speed", "m/s", DERIVE_ONE, derive_sound_speed, 0, DERIVE_ALONE},
    {"mach", "1", DERIVE_ONE, derive_mach, 0, DERIVE_ALONE},
    {"internal_energy", "J/kg", DERIVE_ONE, derive_internal_energy, 0, DERIVE_ALONE},
    {"total_energy", "J/m3", DERIVE_ONE, derive_total_energy, 0, DERIVE_ALONE},
    {"vorticity", "1/s", DERIVE_VECTOR, derive_slope_vorticity, 0, DERIVE_LAYERS},
    {"heat_flux", "W/m2", DERIVE_VECTOR, derive_heat_flux, 0, DERIVE_LAYERS},
    {"schlieren", "1", DERIVE_ONE, derive_slope_schlieren, 0, DERIVE_LAYERS | DERIVE_STEEPEST},
    {"surface_energy", "J/m3", DERIVE_ONE, derive_slope_surface, 0, DERIVE_LAYERS},
    {"level", "1", DERIVE_ONE, derive_level, 0, DERIVE_ALONE},
    {"rank", "1", DERIVE_ONE, derive_rank, 0, DERIVE_ALONE},
    {"cost", "1", DERIVE_ONE, derive_cost, 0, DERIVE_ALONE},
    {"alpha_", "1", DERIVE_MATERIAL, derive_fraction, 0, DERIVE_ALONE},
    {"density_", "kg/m3", DERIVE_MATERIAL, derive_material_density, 0, DERIVE_ALONE},
    {"temperature_", "K", DERIVE_MATERIAL, derive_material_temperature, 0, DERIVE_PRESENCE},
    {"partial_density_", "kg/m3", DERIVE_MATERIAL, derive_partial_density, 0, DERIVE_ALONE},
    {"curvature_", "1/m", DERIVE_MATERIAL, derive_curvature, 0, DERIVE_AROUND},
    {"stress_", "Pa", DERIVE_TENSOR, derive_stress_cauchy, 0, DERIVE_ALONE},
    {"stretch_max", "1", DERIVE_SOLID, derive_stress_stretch_max, 0, DERIVE_ALONE},
    {"stretch_", "1", DERIVE_TENSOR, derive_stress_stretch, 0, DERIVE_ALONE},
    {"sigma_max", "Pa", DERIVE_SOLID, derive_stress_sigma, DERIVE_STRESS_MAX, DERIVE_ALONE},
    {"sigma_min", "Pa", DERIVE_SOLID, derive_stress_sigma, DERIVE_STRESS_MIN, DERIVE_ALONE},
    {"sigma_shear", "Pa", DERIVE_SOLID, derive_stress_sigma, DERIVE_STRESS_SHEAR, DERIVE_ALONE},
    {"sigma_max_dev", "Pa", DERIVE_SOLID, derive_stress_sigma, DERIVE_STRESS_MAX_DEV, DERIVE_ALONE},
    {"sigma_min_dev", "Pa", DERIVE_SOLID, derive_stress_sigma, DERIVE_STRESS_MIN_DEV, DERIVE_ALONE},
    {"principal_max", "Pa", DERIVE_SOLID, derive_stress_principal, DERIVE_STRESS_MAX, DERIVE_ALONE},
    {"principal_min", "Pa", DERIVE_SOLID, derive_stress_principal, DERIVE_STRESS_MIN, DERIVE_ALONE},
    {"principal_shear", "Pa", DERIVE_SOLID, derive_stress_principal, DERIVE_STRESS_SHEAR, DERIVE_ALONE},
    {"principal_max_dev", "Pa", DERIVE_SOLID, derive_stress_principal, DERIVE_STRESS_MAX_DEV, DERIVE_ALONE},
    {"principal_min_dev", "Pa", DERIVE_SOLID, derive_stress_principal, DERIVE_STRESS_MIN_DEV, DERIVE_ALONE},
    {"stress_viscous_", "Pa", DERIVE_VISCOUS_TENSOR, derive_viscous_stress, 0, DERIVE_LAYERS},
    {"dissipation", "W/m3", DERIVE_VISCOUS, derive_viscous_dissipation, 0, DERIVE_LAYERS},
    {"body", "1", DERIVE_RIGID, derive_body, 0, DERIVE_ALONE},
    {"quality_", "1", DERIVE_VAPOUR, derive_vapour_quality, 0, DERIVE_ALONE},
    {"saturation_pressure_", "Pa", DERIVE_VAPOUR, derive_vapour_pressure, 0, DERIVE_ALONE},
    {"saturation_temperature_", "K", DERIVE_VAPOUR, derive_vapour_temperature, 0, DERIVE_ALONE},
    {"superheat_", "K", DERIVE_VAPOUR, derive_vapour_superheat, 0, DERIVE_ALONE},
    {"von_mises", "Pa", DERIVE_SOLID, derive_stress_von_mises, 0, DERIVE_ALONE},
    {"strain_energy", "J/m3", DERIVE_SOLID, derive_stress_energy, 0, DERIVE_ALONE},
    {"flow_stress", "Pa", DERIVE_STRONG, derive_stress_strength, 0, DERIVE_ALONE},
    {"overstress", "Pa", DERIVE_BRANCHED, derive_stress_over, 0, DERIVE_ALONE},
    {"plastic_strain", "1", DERIVE_STRAINED, derive_stress_plastic, 0, DERIVE_ALONE},
    {"damage", "1", DERIVE_BREAKING, derive_stress_damage, 0, DERIVE_ALONE},
    {"invariant_1", "1", DERIVE_SOLID, derive_stress_invariant, 0, DERIVE_ALONE},
    {"invariant_2", "1", DERIVE_SOLID, derive_stress_invariant, 1, DERIVE_ALONE},
    {"", "", DERIVE_OF_SCENE, derive_law, 0, DERIVE_DECLARED},
    {"", "", DERIVE_OF_SCENE, derive_kept, 0, DERIVE_ALONE},
    {"", "", DERIVE_OF_SCENE, derive_formula, 0, DERIVE_ARGUMENTS},
};

enum {
    DERIVE_ROWS = sizeof derive_table / sizeof *derive_table,
    DERIVE_LAW = DERIVE_ROWS - 3,
    DERIVE_KEPT = DERIVE_ROWS - 2,
    DERIVE_FORMULA = DERIVE_ROWS - 1
};

static bool derive_is_tensor(enum derive_form form)
{
    return form == DERIVE_TENSOR || form == DERIVE_VISCOUS_TENSOR;
}

/* Axis, component or material that the part after a row's prefix names, or -1. */
static int derive_suffix(const struct model *model, const struct derive_quantity *row, const char *suffix)
{
    if (row->form == DERIVE_AXIS) return strlen(suffix) == 1 && strchr("xyz", *suffix) ? *suffix - 'x' : -1;
    for (int c = 0; derive_is_tensor(row->form) && c < 6; c++)
        if (!strcmp(suffix, model_tensor[c])) return c;
    if (derive_is_tensor(row->form)) return -1;
    for (unsigned l = 0; l < model->n_material; l++)
        if (!strcmp(suffix, model->scene->material[l].name))
            return row->form == DERIVE_VAPOUR && !scene_phase_of(model->scene, l) ? -1 : (int)l;
    return -1;
}

/* Are there fields of this form in a scene? */
static bool derive_has(const struct model *model, enum derive_form form)
{
    if (form == DERIVE_SOLID || form == DERIVE_TENSOR) return model->elastic;
    if (form == DERIVE_STRONG) return model->plastic;
    if (form == DERIVE_BRANCHED) return model->n_branch > 0;
    if (form == DERIVE_RIGID) return model->scene->n_rigid > 0;
    if (form == DERIVE_VISCOUS || form == DERIVE_VISCOUS_TENSOR) return model->viscous;
    if (form == DERIVE_BREAKING) return model->damaged;
    return form != DERIVE_STRAINED || model->aged;
}

/* One of the peaks that the scene keeps of a field of the table: `prefix` and its name. */
static bool derive_find_peak(const struct model *model, const char *name, const char *prefix, int row, bool when,
                             const char *of, struct derive *ret_field)
{
    size_t length = strlen(prefix);
    if (row < 0 || strncmp(name, prefix, length) != 0 || strcmp(name + length, of) != 0) return false;
    struct derive field;
    if (derive_find(model, of, &field)) return false;
    *ret_field = (struct derive){.unit = when ? "s" : field.unit, .components = 1, .what = DERIVE_KEPT, .index = row};
    strncpy(ret_field->name, name, sizeof ret_field->name - 1);
    return true;
}

static bool derive_find_kept(const struct model *model, const char *name, struct derive *ret_field)
{
    const struct scene_output *output = &model->scene->output;
    for (unsigned i = 0; i < output->n_peak; i++) {
        const struct scene_peak *peak = &output->peaks[i];
        if (derive_find_peak(model, name, "max_", peak->most, false, peak->field, ret_field) ||
            derive_find_peak(model, name, "min_", peak->least, false, peak->field, ret_field) ||
            derive_find_peak(model, name, "when_max_", peak->when_most, true, peak->field, ret_field) ||
            derive_find_peak(model, name, "when_min_", peak->when_least, true, peak->field, ret_field))
            return true;
    }
    return false;
}

static bool derive_find_formula(const struct model *model, const char *name, struct derive *ret_field)
{
    const struct scene_output *output = &model->scene->output;
    for (unsigned i = 0; i < output->n_formula; i++) {
        if (strcmp(output->formulas[i].name, name) != 0) continue;
        *ret_field = (struct derive){.unit = "", .components = 1, .what = DERIVE_FORMULA, .index = (int)i};
        strncpy(ret_field->name, name, sizeof ret_field->name - 1);
        return true;
    }
    return false;
}

static bool derive_find_law(const struct model *model, const char *name, struct derive *ret_field)
{
    const char *unit = "";
    int index = derive_law_find(model->scene, name, &unit);
    if (index < 0) return false;
    *ret_field = (struct derive){.unit = unit, .components = 1, .what = DERIVE_LAW, .index = index};
    strncpy(ret_field->name, name, sizeof ret_field->name - 1);
    return true;
}

int derive_find(const struct model *model, const char *name, struct derive *ret_field)
{
    if (derive_find_kept(model, name, ret_field) || derive_find_formula(model, name, ret_field) ||
        derive_find_law(model, name, ret_field))
        return STATUS_OK;
    for (int i = 0; i < DERIVE_ROWS; i++) {
        const struct derive_quantity *row = &derive_table[i];
        if (row->form == DERIVE_OF_SCENE) continue;
        size_t length = strlen(row->name);
        bool suffixed = row->form == DERIVE_AXIS || derive_is_tensor(row->form) || row->form == DERIVE_MATERIAL ||
                        row->form == DERIVE_VAPOUR;
        int index = row->index;
        if (!derive_has(model, row->form)) continue;
        if (!suffixed ? strcmp(name, row->name) != 0 : strncmp(name, row->name, length) != 0) continue;
        if (suffixed && (index = derive_suffix(model, row, name + length)) < 0) continue;
        *ret_field = (struct derive){.unit = row->unit,
                                     .components = row->form == DERIVE_VECTOR ? 3 : 1,
                                     .what = i,
                                     .index = index};
        strncpy(ret_field->name, name, sizeof ret_field->name - 1);
        return STATUS_OK;
    }
    const char *near = text_nearest(name, derive_names(model));
    return status_fail(STATUS_CASE, "unknown field '%s'%s%s%s", name, near ? "; did you mean '" : "", near ? near : "",
                       near ? "'?" : "");
}

int derive_material(const struct derive *field)
{
    void (*compute)(const struct derive_view *, double *) = derive_table[field->what].compute;
    return compute == derive_material_density || compute == derive_material_temperature ? field->index : -1;
}

const char *const *derive_names(const struct model *model)
{
    return (const char *const *)model->names;
}

static struct derive_view derive_view(const struct model *model, const struct mesh *mesh, int level, unsigned local,
                                      double t, const struct derive *field)
{
    const struct level *of = &mesh->levels[level];
    return (struct derive_view){.model = model,
                                .mesh = mesh,
                                .level = of,
                                .level_index = level,
                                .local = local,
                                .t = t,
                                .field = field,
                                .w = of->w[local],
                                .n = mesh->n_cell};
}

struct derive_moment derive_moment(const struct model *model, const struct mesh *mesh, double t)
{
    return (struct derive_moment){.model = model, .mesh = mesh, .t = t};
}

static void derive_bring_layers(struct derive_moment *moment)
{
    if (moment->exchanges) return;
    derive_slope_exchange(moment->model, moment->mesh, moment->base, moment->t);
    moment->exchanges++;
}

static void derive_bring_around(struct derive_moment *moment)
{
    if (!moment->has_around) derive_curvature_exchange(moment->model, moment->mesh);
    moment->has_around = true;
}

/* Wants the layers. */
static double derive_steepest(struct derive_moment *moment)
{
    const struct mesh *mesh = moment->mesh;
    if (moment->has_steepest) return moment->steepest;
    double *gradient = mem_new(mesh->n_cell, sizeof *gradient);
    for (int l = 0; l < mesh->n_level; l++)
        for (unsigned tile = 0; tile < mesh->levels[l].n_local; tile++) {
            struct derive_view view = derive_view(moment->model, mesh, l, tile, moment->t, NULL);
            derive_slope_steepest(&view, gradient, &moment->steepest);
        }
    mem_free(gradient);
    comm_max(&moment->steepest, 1);
    moment->has_steepest = true;
    return moment->steepest;
}

static double derive_presence(struct derive_moment *moment, unsigned material)
{
    if (!moment->has_presence[material])
        moment->presence[material] = presence_density(moment->model, moment->mesh, material);
    moment->has_presence[material] = true;
    return moment->presence[material];
}

void derive_prepare(struct derive_moment *moment, struct derive *field)
{
    unsigned needs = derive_table[field->what].needs;
    bool layers = needs & DERIVE_DECLARED && derive_law_needs_layers(moment->model->scene, field);
    if (layers || needs & DERIVE_LAYERS) derive_bring_layers(moment);
    if (needs & DERIVE_AROUND) derive_bring_around(moment);
    if (needs & DERIVE_STEEPEST) field->scale = derive_steepest(moment);
    if (needs & DERIVE_ARGUMENTS) derive_formula_prepare(moment, field);
    if (needs & DERIVE_PRESENCE) field->scale = derive_presence(moment, (unsigned)field->index);
}

void derive_tile(const struct model *model, const struct mesh *mesh, int level, unsigned local, double t,
                 const struct derive *field, double *out)
{
    struct derive_view view = derive_view(model, mesh, level, local, t, field);
    derive_table[field->what].compute(&view, out);
}
