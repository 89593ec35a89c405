/* derive_vapour.c - see derive_vapour.h. The curve is inverted in each cell (case/saturation.h): pictures are few. */
#include "derive/derive_vapour.h"

#include "base/mem.h"
#include "case/saturation.h"
#include "phys/mix.h"
#include "phys/presence.h"
#include "phys/traction.h"

#include <math.h>
#include <string.h>

static const struct scene_phase *derive_vapour_pair(const struct derive_view *tile)
{
    return scene_phase_of(tile->model->scene, (unsigned)tile->field->index);
}

static struct saturation derive_vapour_curve(const struct derive_view *tile, const struct scene_phase *pair)
{
    const struct scene *scene = tile->model->scene;
    struct saturation curve = {{NULL, NULL}, {NULL, NULL}, {0.0, 0.0}, 0.0};
    (void)saturation_of(&scene->material[pair->liquid].eos, &scene->material[pair->vapour].eos, &curve); /* checked */
    return curve;
}

void derive_vapour_quality(const struct derive_view *tile, double *out)
{
    const struct scene_phase *pair = derive_vapour_pair(tile);
    const double *rho_l = derive_view_w(tile, tile->model->i_m + pair->liquid);
    const double *rho_v = derive_view_w(tile, tile->model->i_m + pair->vapour);
    for (size_t i = 0; i < tile->n; i++) {
        double liquid = derive_view_alpha(tile, pair->liquid, i) * rho_l[i];
        double vapour = derive_view_alpha(tile, pair->vapour, i) * rho_v[i];
        out[i] = liquid + vapour > 0.0 ? vapour / (liquid + vapour) : 0.0;
    }
}

/* Temperatures of the liquid; 0 where it is not felt. */
static void derive_vapour_liquid(const struct derive_view *tile, const struct scene_phase *pair, double *out)
{
    double *T = mem_new(tile->model->n_material * tile->n, sizeof *T);
    mix_temperatures(tile->model, tile->n, tile->n, tile->w, T);
    for (size_t i = 0; i < tile->n; i++) {
        double own = T[pair->liquid * tile->n + i];
        out[i] = derive_view_alpha(tile, pair->liquid, i) >= PRESENCE_FRACTION && own > 0.0 ? own : 0.0;
    }
    mem_free(T);
}

void derive_vapour_pressure(const struct derive_view *tile, double *out)
{
    const struct scene_phase *pair = derive_vapour_pair(tile);
    const struct saturation curve = derive_vapour_curve(tile, pair);
    derive_vapour_liquid(tile, pair, out);
    for (size_t i = 0; i < tile->n; i++) {
        double p = out[i] > 0.0 ? saturation_pressure(&curve, out[i]) : 0.0;
        out[i] = isnan(p) ? 0.0 : p;
    }
}

/* Pressures of the liquid, which beside a stretched solid or behind surface tension are not those of the cells. */
static void derive_vapour_pressed(const struct derive_view *tile, const struct scene_phase *pair, double *out)
{
    const double *p = derive_view_w(tile, tile->model->i_E);
    struct traction_pressures parts;
    for (size_t i = 0; i < tile->n; i += TRACTION_BATCH) {
        size_t n = tile->n - i < TRACTION_BATCH ? tile->n - i : TRACTION_BATCH;
        traction_part(tile->model, n, tile->n, tile->w + i, &parts);
        memcpy(out + i, traction_pressure(tile->model, n, pair->liquid, p + i, &parts), n * sizeof *out);
    }
}

void derive_vapour_temperature(const struct derive_view *tile, double *out)
{
    const struct saturation curve = derive_vapour_curve(tile, derive_vapour_pair(tile));
    derive_vapour_pressed(tile, derive_vapour_pair(tile), out);
    for (size_t i = 0; i < tile->n; i++) {
        double T = out[i] > 0.0 ? saturation_temperature(&curve, out[i]) : 0.0;
        out[i] = isnan(T) ? 0.0 : T;
    }
}

void derive_vapour_superheat(const struct derive_view *tile, double *out)
{
    double *T = mem_new(tile->n, sizeof *T);
    derive_vapour_liquid(tile, derive_vapour_pair(tile), T);
    derive_vapour_temperature(tile, out);
    for (size_t i = 0; i < tile->n; i++) out[i] = T[i] > 0.0 && out[i] > 0.0 ? T[i] - out[i] : 0.0;
    mem_free(T);
}
