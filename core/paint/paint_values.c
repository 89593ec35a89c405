/* paint_values.c - see paint_values.h.
 *
 * A layer, whether YAML or Lua, is first turned into one struct in which NaN means "not said";
 * from it, and from the state below, follow velocity, fractions, pressure and densities, in this
 * order, each checked where it arises. */
#include "paint/paint_values.h"

#include "base/status.h"
#include "base/text.h"
#include "case/script_table.h"
#include "paint/paint_pressure.h"
#include "paint/paint_stretch.h"
#include "phys/elastic.h"

#include <math.h>
#include <stdbool.h>
#include <stdio.h>
#include <string.h>

/* What a layer says at a point; NaN: nothing. */
struct paint_said {
    double alpha[SCENE_MATERIALS], density[SCENE_MATERIALS], mixture; /* mixture: density without a material's name */
    double temperature, pressure, velocity[SCENE_AXES], stretch[6];
};

enum { PAINT_VALUES_PLAIN = 3, PAINT_VALUES_NAMES = PAINT_VALUES_PLAIN + 2 * SCENE_AXES + 4 * SCENE_MATERIALS + 12 };

static const char PAINT_VALUES_AXIS[] = "xyz";

/* The fields of a Lua table: three plain ones, two spellings of each velocity, of alpha and density by material and,
 * with a solid, of the components of the stretch. paint_values_hear reads them in the same order. */
static const struct script_table *paint_values_names(const struct scene *scene, bool elastic)
{
    char buffer[PAINT_VALUES_NAMES][SCENE_NAME + 16];
    const char *names[PAINT_VALUES_NAMES] = {"pressure", "temperature", "density"};
    unsigned n = PAINT_VALUES_PLAIN;
    for (int d = 0; d < SCENE_AXES; d++) {
        snprintf(buffer[n], sizeof *buffer, "velocity_%c", PAINT_VALUES_AXIS[d]);
        snprintf(buffer[n + 1], sizeof *buffer, "velocity.%d", d + 1);
        n += 2;
    }
    for (unsigned l = 0; l < scene->n_material; l++) {
        snprintf(buffer[n], sizeof *buffer, "alpha_%s", scene->material[l].name);
        snprintf(buffer[n + 1], sizeof *buffer, "alpha.%s", scene->material[l].name);
        snprintf(buffer[n + 2], sizeof *buffer, "density_%s", scene->material[l].name);
        snprintf(buffer[n + 3], sizeof *buffer, "density.%s", scene->material[l].name);
        n += 4;
    }
    for (unsigned c = 0; c < 6 && elastic; c++) {
        snprintf(buffer[n], sizeof *buffer, "stretch_%s", model_tensor[c]);
        snprintf(buffer[n + 1], sizeof *buffer, "stretch.%s", model_tensor[c]);
        n += 2;
    }
    for (unsigned i = PAINT_VALUES_PLAIN; i < n; i++) names[i] = buffer[i];
    return script_table(scene->host, names, n);
}

void paint_values_of(const struct model *model, unsigned index, struct paint_values *ret_values)
{
    const struct scene *scene = model->scene;
    const struct scene_layer *layer = &scene->layers[index];
    bool varying = layer->script || layer->temperature.script || layer->pressure.script;
    for (unsigned l = 0; l < scene->n_material && layer->density; l++) varying = varying || layer->density[l].script;
    for (int d = 0; d < scene->domain.n_velocity; d++) varying = varying || layer->velocity[d].script;
    for (unsigned c = 0; c < 6; c++) varying = varying || layer->stretch[c].script;
    *ret_values = (struct paint_values){.model = model, .layer = layer, .number = index + 1, .varying = varying};
    ret_values->whole = layer->has_material && !layer->script;
    if (layer->script) ret_values->names = paint_values_names(scene, model->elastic);
}

/* "case.yaml:12: layer 2 of initial, at (1e-05, 0): " before a message. */
static int paint_values_fail(const struct paint_values *values, const double x[3], const char *what)
{
    struct text place = {0};
    for (int d = 0; d < values->model->dim; d++) text_add(&place, "%s%.10g", d ? ", " : "", x[d]);
    status_fail(STATUS_CASE, "%s:%d: layer %u of initial, at (%s): %s", values->model->scene->path, values->layer->line,
                values->number, place.at, what);
    text_done(&place);
    return STATUS_CASE;
}

static int paint_values_ask(const struct scene_value *value, const double x[3], double r, double *ret)
{
    if (!value->given) {
        *ret = (double)NAN;
        return STATUS_OK;
    }
    return scene_value_at(value, x, r, 0.0, ret);
}

static int paint_values_read(const struct paint_values *values, const double x[3], struct paint_said *said)
{
    const struct scene_layer *layer = values->layer;
    double square = 0.0;
    for (int d = 0; d < values->model->dim; d++) square += (x[d] - layer->centre[d]) * (x[d] - layer->centre[d]);
    double r = sqrt(square);
    TRY(paint_values_ask(&layer->pressure, x, r, &said->pressure));
    TRY(paint_values_ask(&layer->temperature, x, r, &said->temperature));
    said->mixture = (double)NAN;
    for (unsigned l = 0; l < values->model->n_material; l++) {
        said->alpha[l] = layer->has_material ? layer->fractions ? layer->fractions[l] : 1.0 : (double)NAN;
        said->density[l] = (double)NAN;
        if (layer->density) TRY(paint_values_ask(&layer->density[l], x, r, &said->density[l]));
    }
    for (int d = 0; d < SCENE_AXES; d++) TRY(paint_values_ask(&layer->velocity[d], x, r, &said->velocity[d]));
    for (unsigned c = 0; c < 6; c++) TRY(paint_values_ask(&layer->stretch[c], x, r, &said->stretch[c]));
    return STATUS_OK;
}

/* The second spelling counts where the first is silent. */
static double paint_values_either(const double *pair, unsigned step)
{
    return isnan(pair[0]) ? pair[step] : pair[0];
}

static int paint_values_hear(const struct paint_values *values, const double x[3], struct paint_said *said)
{
    double out[PAINT_VALUES_NAMES];
    TRY(script_table_call(values->layer->script, x, 3, values->names, out));
    said->pressure = out[0];
    said->temperature = out[1];
    said->mixture = out[2];
    const double *at = out + PAINT_VALUES_PLAIN;
    for (int d = 0; d < SCENE_AXES; d++, at += 2) said->velocity[d] = paint_values_either(at, 1);
    for (unsigned l = 0; l < values->model->n_material; l++, at += 4) {
        said->alpha[l] = paint_values_either(at, 1);
        said->density[l] = paint_values_either(at + 2, 1);
    }
    for (unsigned c = 0; c < 6; c++, at += 2)
        said->stretch[c] = values->model->elastic ? paint_values_either(at, 1) : (double)NAN;
    return STATUS_OK;
}

/* Fractions: given, or those below; one that is missing is the rest. Normalised to the sum 1. */
static int paint_values_fractions(const struct paint_values *values, const double x[3], const struct paint_said *said,
                                  const double *before, double *ret_alpha)
{
    const struct model *model = values->model;
    unsigned missing = 0, last = 0;
    double sum = 0.0;
    char what[256];
    for (unsigned l = 0; l < model->n_material; l++) {
        bool silent = isnan(said->alpha[l]);
        ret_alpha[l] = silent ? 0.0 : said->alpha[l];
        sum += ret_alpha[l];
        missing += silent;
        last = silent ? l : last;
        if (ret_alpha[l] >= 0.0 && ret_alpha[l] <= 1.0 + 1e-9) continue;
        snprintf(what, sizeof what, "the volume fraction of %s is %.10g, not between 0 and 1",
                 model->scene->material[l].name, ret_alpha[l]);
        return paint_values_fail(values, x, what);
    }
    if (model->n_material == 1) {
        ret_alpha[0] = 1.0;
        return missing || sum == 1.0 ? STATUS_OK
                                     : paint_values_fail(values, x, "the fraction of the only material is not 1");
    }
    if (missing == model->n_material) {
        if (!before)
            return paint_values_fail(values, x, "it does not say which material is there, nor does a layer below");
        memcpy(ret_alpha, before + model->i_alpha, model->n_material * sizeof *ret_alpha);
        return STATUS_OK;
    }
    if (missing == 1 && sum < 1.0) {
        ret_alpha[last] = 1.0 - sum;
        sum = 1.0;
    }
    if (fabs(sum - 1.0) > 1e-9) {
        snprintf(what, sizeof what, "the volume fractions add up to %.10g, not to 1", sum);
        return paint_values_fail(values, x, what);
    }
    for (unsigned l = 0; l < model->n_material && sum != 1.0; l++) ret_alpha[l] /= sum;
    return STATUS_OK;
}

/* Density of a material that is present; `only`: no other one is. */
static int paint_values_density(const struct paint_values *values, const double x[3], const struct paint_said *said,
                                const double *before, unsigned l, bool only, double pressure, double *ret_density)
{
    const struct model *model = values->model;
    const char *name = model->scene->material[l].name;
    char what[256];
    if (!isnan(said->density[l])) *ret_density = said->density[l];
    else if (!isnan(said->mixture) && only) *ret_density = said->mixture;
    else if (!isnan(said->mixture)) {
        snprintf(what, sizeof what,
                 "more than one material is there: give the density of each, as in density = {%s = ...}", name);
        return paint_values_fail(values, x, what);
    } else if (!isnan(said->temperature)) {
        if (!(said->temperature > 0.0)) {
            snprintf(what, sizeof what, "the temperature is %.10g K, not above 0", said->temperature);
            return paint_values_fail(values, x, what);
        }
        model->eos[l].law->density(model->eos[l].self, 1, &pressure, &said->temperature, ret_density);
    } else if (before && (!model->n_alpha || before[model->i_alpha + l] > 0.0)) *ret_density = before[model->i_m + l];
    else {
        snprintf(what, sizeof what, "the density of %s is missing", name);
        return paint_values_fail(values, x, what);
    }
    if (*ret_density > 0.0 && isfinite(*ret_density)) return STATUS_OK;
    snprintf(what, sizeof what, "the density of %s is %.10g kg/m3, not above 0", name, *ret_density);
    return paint_values_fail(values, x, what);
}

/* Pressure: given, that of the one material with this density and temperature, or that below. */
static int paint_values_pressure(const struct paint_values *values, const double x[3], const struct paint_said *said,
                                 const double *before, const double *alpha, double *ret_pressure)
{
    const struct model *model = values->model;
    unsigned present = 0, one = 0;
    char what[256];
    bool dense = !isnan(said->mixture);
    for (unsigned l = 0; l < model->n_material; l++) {
        present += alpha[l] > 0.0;
        one = alpha[l] > 0.0 ? l : one;
        dense = dense || (alpha[l] > 0.0 && !isnan(said->density[l]));
    }
    double rho = isnan(said->density[one]) ? said->mixture : said->density[one];
    bool thermal = dense && !isnan(said->temperature);
    if (thermal && !isnan(said->pressure))
        return paint_values_fail(values, x, "two of pressure, density and temperature make a state, not all three");
    *ret_pressure = isnan(said->pressure) && before ? before[model->i_E] : said->pressure;
    if (!thermal) return isnan(*ret_pressure) ? paint_values_fail(values, x, "the pressure is missing") : STATUS_OK;
    if (present > 1)
        return paint_values_fail(values, x,
                                 "density and temperature give the pressure of one material, not of a mixture");
    if (rho > 0.0 && said->temperature > 0.0 && paint_pressure(&model->eos[one], rho, said->temperature, ret_pressure))
        return STATUS_OK;
    snprintf(what, sizeof what, "%s has no state at %.10g kg/m3 and %.10g K", model->scene->material[one].name, rho,
             said->temperature);
    return paint_values_fail(values, x, what);
}

static int paint_values_materials(const struct paint_values *values, const double x[3], const struct paint_said *said,
                                  const double *before, double *w)
{
    const struct model *model = values->model;
    double alpha[SCENE_MATERIALS], pressure, least;
    char what[256];
    unsigned present = 0;
    TRY(paint_values_fractions(values, x, said, before, alpha));
    TRY(paint_values_pressure(values, x, said, before, alpha, &pressure));
    w[model->i_E] = pressure;
    for (unsigned l = 0; l < model->n_material; l++) present += alpha[l] > 0.0;
    for (unsigned l = 0; l < model->n_material; l++) {
        double *density = &w[model->i_m + l];
        if (model->n_alpha) w[model->i_alpha + l] = alpha[l];
        *density = model->eos[l].rho_fill;
        if (!(alpha[l] > 0.0)) continue;
        TRY(paint_values_density(values, x, said, before, l, present == 1, pressure, density));
        model->eos[l].law->p_min(model->eos[l].self, 1, density, &least);
        if (pressure > least) continue;
        snprintf(what, sizeof what, "the pressure is %.10g Pa; %s at %.10g kg/m3 exists above %.10g Pa only", pressure,
                 model->scene->material[l].name, *density, least);
        return paint_values_fail(values, x, what);
    }
    return STATUS_OK;
}

/* The components of the stretch must be those of one, and be there. */
static int paint_values_stretch_check(const struct paint_values *values, const double x[3], const double V[6])
{
    const struct model *model = values->model;
    char what[256];
    for (unsigned c = model->n_stretch; c < 6; c++) {
        if (V[c] == 0.0) continue;
        snprintf(what, sizeof what, "stretch_%s is %.10g, but velocities have %u component%s here", model_tensor[c],
                 V[c], model->n_velocity, model->n_velocity == 1 ? "" : "s");
        return paint_values_fail(values, x, what);
    }
    if (!(paint_stretch_det(V) > 0.0) || isinf(paint_stretch_det(V))) {
        snprintf(what, sizeof what,
                 "the stretch %.6g, %.6g, %.6g is none: it has principal values that are not above 0, or too large",
                 V[ELASTIC_XX], V[ELASTIC_YY], V[ELASTIC_ZZ]);
        return paint_values_fail(values, x, what);
    }
    if (model->beta < 2 || fabs(V[ELASTIC_YY] - V[ELASTIC_ZZ]) <= 1e-12 * V[ELASTIC_YY]) return STATUS_OK;
    snprintf(what, sizeof what,
             "stretch_yy and stretch_zz both stand around the centre and are equal, not %.10g and %.10g", V[ELASTIC_YY],
             V[ELASTIC_ZZ]);
    return paint_values_fail(values, x, what);
}

/* Where there is a solid its stretch is what is said, with the rest of the identity, or that below. */
static int paint_values_stretch(const struct paint_values *values, const double x[3], const struct paint_said *said,
                                const double *before, double *w)
{
    const struct model *model = values->model;
    double told[6] = {1.0, 1.0, 1.0};
    bool any = false, tells = false;
    for (unsigned c = 0; c < 6; c++) tells = tells || !isnan(said->stretch[c]);
    for (unsigned s = 0; s < model->n_solid; s++) any = any || paint_stretch_share(model, s, w, 1) > 0.0;
    if (any && tells) {
        for (unsigned c = 0; c < 6; c++) told[c] = isnan(said->stretch[c]) ? told[c] : said->stretch[c];
        TRY(paint_values_stretch_check(values, x, told));
        paint_stretch_unimodular(model, told);
    }
    for (unsigned s = 0; s < model->n_solid; s++) {
        unsigned first = model->solids[s].stretch;
        const double *V = tells || !before ? told : before + first;
        elastic_identity(model, 1, 1, w + first);
        if (paint_stretch_share(model, s, w, 1) > 0.0) memcpy(w + first, V, model->n_stretch * sizeof *V);
    }
    return STATUS_OK;
}

int paint_values_at(const struct paint_values *values, const double x[3], const double *before, double *w)
{
    const struct model *model = values->model;
    struct paint_said said;
    TRY(values->layer->script ? paint_values_hear(values, x, &said) : paint_values_read(values, x, &said));
    for (unsigned d = 0; d < model->n_velocity; d++) {
        double below = before ? before[model->i_u + d] : 0.0;
        w[model->i_u + d] = isnan(said.velocity[d]) ? below : said.velocity[d];
    }
    for (unsigned d = model->n_velocity; d < SCENE_AXES; d++) {
        char what[96];
        if (isnan(said.velocity[d]) || said.velocity[d] == 0.0) continue;
        snprintf(what, sizeof what, "velocity_%c is %.10g m/s, but velocities have %u component%s here",
                 PAINT_VALUES_AXIS[d], said.velocity[d], model->n_velocity, model->n_velocity == 1 ? "" : "s");
        return paint_values_fail(values, x, what);
    }
    TRY(paint_values_materials(values, x, &said, before, w));
    for (unsigned s = 0; s < model->n_inner; s++) w[model->i_inner + s] = 0.0;
    paint_stretch_relaxed(model, 1, 1, w);
    for (unsigned q = model->i_normal; q < model->n_field; q++) w[q] = 0.0; /* no surface at a point */
    return model->n_stretch ? paint_values_stretch(values, x, &said, before, w) : STATUS_OK;
}
