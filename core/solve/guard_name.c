/* guard_name.c - see guard_name.h. */
#include "solve/guard_name.h"

#include "base/text.h"
#include "phys/elastic.h"
#include "phys/mix_pressure.h"
#include "phys/traction.h"

#include <math.h>
#include <stdio.h>

/* One cell of a judged tile. */
struct guard_cell {
    const struct guard_tile *tile;
    const struct model *model;
    size_t n_cell, at;
};

static void guard_name_say(struct guard_name *name, const char *field, double value, const char *words)
{
    snprintf(name->field, sizeof name->field, "%s", field);
    snprintf(name->words, sizeof name->words, "%s", words);
    name->value = value;
}

static double guard_name_alpha(const struct guard_cell *cell, unsigned l)
{
    const struct model *model = cell->model;
    return model->n_alpha ? cell->tile->w[(model->i_alpha + l) * cell->n_cell + cell->at] : 1.0;
}

/* Is nothing asked of fluid l here, because solids bear the cell (guard_borne in guard.c)? */
static bool guard_name_borne(const struct guard_cell *cell, unsigned l)
{
    const struct model *model = cell->model;
    double solid = 0.0;
    for (unsigned s = 0; s < model->n_solid; s++) {
        if (model->solids[s].material == l) return false;
        solid += guard_name_alpha(cell, model->solids[s].material);
    }
    return model->split && solid > 0.5;
}

/* " (xx = 1.2, yy = ...)" of a stretch of the cell, whose first component is a field of a block of conserved ones. */
static void guard_name_stretch(struct text *text, const struct guard_cell *cell, unsigned first, const double *u)
{
    const struct model *model = cell->model;
    for (unsigned c = 0; c < model->n_stretch; c++)
        text_add(text, "%s%s = %.4g", c ? ", " : " (", model_tensor[c], u[(first + c) * cell->n_cell + cell->at]);
    text_add(text, ")");
}

static const struct scene_material *guard_name_solid(const struct guard_cell *cell, unsigned s)
{
    return &cell->model->scene->material[cell->model->first + cell->model->solids[s].material];
}

/* The stretch of field q is lost: whose it is, and what it was. */
static void guard_name_lost(const struct guard_cell *cell, unsigned q, struct text *text)
{
    unsigned k = 0;
    while (q - model_stretch(cell->model, k) >= cell->model->n_stretch) k++; /* wraps below */
    const struct scene_material *material = guard_name_solid(cell, model_bearer(cell->model, k));
    text_add(text, " of material '%s' (%s): det V <= 0, or no number; stretch before the step", material->name,
             material->constitutive.module->name);
    guard_name_stretch(text, cell, model_stretch(cell->model, k), cell->tile->u_old);
}

/* The first evolved field that is no number: what all else follows from. */
static bool guard_name_unfinite(const struct guard_cell *cell, struct guard_name *name)
{
    const struct model *model = cell->model;
    for (unsigned i = 0; i < model->n_active; i++) {
        unsigned q = model->active[i];
        double value = cell->tile->u[q * cell->n_cell + cell->at];
        unsigned c;
        struct text text = {0};
        if (isfinite(value)) continue;
        if (model_is_stretch(model, q, &c)) guard_name_lost(cell, q, &text);
        else
            text_add(&text, "%s",
                     model_is_inner(model, q) || (q >= model->i_m && q < model->i_u) ? " kg/m3"
                     : q == model->i_E                                               ? " J/m3"
                     : q < model->i_u                                                ? ""
                                                                                     : " kg/m2/s");
        guard_name_say(name, model->field_names[q], value, text.at);
        text_done(&text);
        return true;
    }
    return false;
}

/* What an elastic law says of the stretch in the cell. */
struct guard_strain {
    double I1, I2, e, slope[2], curvature[3];
    struct bulla_constitutive_range range;
};

static void guard_name_ask(const struct guard_cell *cell, unsigned s, struct guard_strain *ret)
{
    const struct model *model = cell->model;
    const struct model_solid *solid = &model->solids[s];
    *ret = (struct guard_strain){0};
    elastic_invariants(model, 1, cell->n_cell, cell->tile->u + solid->stretch * cell->n_cell + cell->at, &ret->I1,
                       &ret->I2);
    solid->law->energy(solid->self, 1, &ret->I1, &ret->I2, &ret->e, &ret->slope[0], &ret->slope[1]);
    if (solid->law->second)
        solid->law->second(solid->self, 1, &ret->I1, &ret->I2, &ret->curvature[0], &ret->curvature[1],
                           &ret->curvature[2]);
    solid->law->range(solid->self, &ret->range);
}

/* An elastic law that gives no number for a stretch that is one. */
static bool guard_name_law(const struct guard_cell *cell, unsigned s, struct guard_name *name)
{
    static const char *const fields[] = {"strain_energy", "e_1", "e_2", "e_11", "e_12", "e_22"};
    const struct scene_material *material = guard_name_solid(cell, s);
    struct guard_strain strain;
    guard_name_ask(cell, s, &strain);
    const double values[] = {
        strain.e, strain.slope[0], strain.slope[1], strain.curvature[0], strain.curvature[1], strain.curvature[2]};
    for (size_t i = 0; i < sizeof values / sizeof *values; i++) {
        struct text text = {0};
        if (isfinite(values[i])) continue;
        text_add(&text, " J/kg by the elastic law '%s' of material '%s' at I1 = %.6g, I2 = %.6g, stretch",
                 material->constitutive.module->name, material->name, strain.I1, strain.I2);
        guard_name_stretch(&text, cell, cell->model->solids[s].stretch, cell->tile->u);
        guard_name_say(name, fields[i], values[i], text.at);
        text_done(&text);
        return true;
    }
    return false;
}

/* Elastic laws that may be behind a pressure: beyond their range, or with more energy in them than the pressure. */
static void guard_name_suspect(const struct guard_cell *cell, double p, struct text *text)
{
    for (unsigned s = 0; s < cell->model->n_solid; s++) {
        const struct scene_material *material = guard_name_solid(cell, s);
        unsigned l = cell->model->solids[s].material;
        double m = cell->tile->u[(cell->model->i_m + l) * cell->n_cell + cell->at];
        struct guard_strain strain;
        if (!cell->model->n_stretch || guard_name_alpha(cell, l) <= GUARD_PRESENT) continue;
        guard_name_ask(cell, s, &strain);
        bool beyond = strain.I1 > strain.range.I1_max || strain.I2 > strain.range.I2_max;
        if (!beyond && !(m * strain.e > fabs(p))) continue;
        text_add(text, "; the elastic law '%s' of '%s' holds %.4g J/m3 at I1 = %.6g, I2 = %.6g",
                 material->constitutive.module->name, material->name, m * strain.e, strain.I1, strain.I2);
        if (beyond)
            text_add(text, ", beyond its range (I1 <= %.4g, I2 <= %.4g)", strain.range.I1_max, strain.range.I2_max);
    }
}

/* A fraction that its mass has left. */
static bool guard_name_void(const struct guard_cell *cell, unsigned l, double m, struct guard_name *name)
{
    const struct model *model = cell->model;
    struct text text = {0};
    double alpha = model->n_alpha ? cell->tile->u[(model->i_alpha + l) * cell->n_cell + cell->at] : 0.0;
    if (m > 0.0 || !(alpha > GUARD_PRESENT)) return false;
    text_add(&text, " kg/m3 in a volume fraction of %.3g", alpha);
    guard_name_say(name, model->field_names[model->i_m + l], m, text.at);
    text_done(&text);
    return true;
}

/* The pressure of a material of its own (phys/traction.h): beside elastic solids and in curved surfaces that of the
 * cell says little of it. */
static double guard_name_pressure(const struct guard_cell *cell, unsigned l)
{
    const struct model *model = cell->model;
    const double *w = cell->tile->w + cell->at, *p = w + model->i_E * cell->n_cell;
    struct traction_pressures parts;
    traction_part(model, 1, cell->n_cell, w, &parts);
    return *traction_pressure(model, 1, l, p, &parts);
}

/* Does p stand where the closure found none (phys/mix_pressure.h): just below the least that material l bears? */
static bool guard_name_lost_pressure(const struct guard_cell *cell, unsigned l, double p)
{
    const struct model_eos *eos = &cell->model->eos[l];
    double least, rho = cell->tile->w[(cell->model->i_m + l) * cell->n_cell + cell->at];
    eos->law->p_min(eos->self, 1, &rho, &least);
    return !cell->model->linear && fabs(p - mix_pressure_none(least)) <= 1e-9 * fabs(p);
}

/* Is a mass below zero what the guard refuses? Not if it is round-off of the cell, or was so low before the step
 * (guard_owes in guard.c): then something else is. */
static bool guard_name_wants(const struct guard_cell *cell, unsigned l, double m)
{
    const struct model *model = cell->model;
    double rho = 0.0, fill = model->eos[l].rho_fill;
    for (unsigned k = 0; k < model->n_material; k++) rho += cell->tile->u[(model->i_m + k) * cell->n_cell + cell->at];
    bool owed = m >= cell->tile->u_old[(model->i_m + l) * cell->n_cell + cell->at];
    return m < -GUARD_ROUND_OFF * (rho > fill ? rho : fill) && !owed;
}

/* One material: its mass, its stiffness. */
static bool guard_name_material(const struct guard_cell *cell, unsigned l, struct guard_name *name)
{
    const struct model *model = cell->model;
    const char *own = model->scene->material[model->first + l].name;
    double m = cell->tile->u[(model->i_m + l) * cell->n_cell + cell->at], alpha = guard_name_alpha(cell, l);
    double p = guard_name_pressure(cell, l), mean = cell->tile->w[model->i_E * cell->n_cell + cell->at];
    double rho_c2 = cell->tile->rho_c2[l * cell->n_cell + cell->at];
    struct text text = {0};
    if (guard_name_void(cell, l, m, name)) return true;
    if (guard_name_wants(cell, l, m) || (!model->n_alpha && !(m > 0.0))) {
        guard_name_say(name, model->field_names[model->i_m + l], m, " kg/m3");
        return true;
    }
    if (alpha <= GUARD_PRESENT || rho_c2 > 0.0 || !isfinite(p) || guard_name_borne(cell, l)) return false;
    if (isnan(rho_c2))
        text_add(&text, " Pa of material '%s' (density times sound speed squared), from a pressure of %.6g Pa", own, p);
    else text_add(&text, " Pa, below what material '%s' (volume fraction %.3g) can bear", own, alpha);
    if (guard_name_lost_pressure(cell, l, p))
        text_add(&text,
                 "; it stands for none: the materials hold the energy of the cell at no pressure that they bear");
    if (p != mean) text_add(&text, "; the mean of the cell is %.6g Pa", mean);
    if (p < mean && model->n_pair && !model->n_solid) text_add(&text, GUARD_NAME_TENSION " %.4g Pa", mean - p);
    guard_name_suspect(cell, p, &text);
    guard_name_say(name, isnan(rho_c2) ? "rho_c2" : "pressure", isnan(rho_c2) ? rho_c2 : p, text.at);
    text_done(&text);
    return true;
}

/* What is left: the pressure, or the speed that the materials and their elasticity make together. */
static void guard_name_mixture(const struct guard_cell *cell, struct guard_name *name)
{
    double p = cell->tile->w[cell->model->i_E * cell->n_cell + cell->at], c2 = cell->tile->c2[cell->at];
    struct text text = {0};
    if (isfinite(p)) text_add(&text, " m2/s2 in the mixture, at a pressure of %.6g Pa", p);
    else text_add(&text, " Pa in the mixture");
    guard_name_suspect(cell, p, &text);
    guard_name_say(name, isfinite(p) ? "sound_speed squared" : "pressure", isfinite(p) ? c2 : p, text.at);
    text_done(&text);
}

void guard_name_find(const struct guard_tile *tile, size_t n_cell, size_t at, struct guard_name *ret_name)
{
    const struct model *model = tile->model;
    const struct guard_cell cell = {tile, model, n_cell, at};
    if (guard_name_unfinite(&cell, ret_name)) return;
    for (unsigned s = 0; model->n_stretch && s < model->n_solid; s++)
        if (guard_name_law(&cell, s, ret_name)) return;
    for (unsigned l = 0; l < model->n_material; l++)
        if (guard_name_material(&cell, l, ret_name)) return;
    guard_name_mixture(&cell, ret_name);
}
