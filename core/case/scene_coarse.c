/* scene_coarse.c - what the cells are too coarse for: waves that come in, bubbles; and pulses that last much longer
 * than the run or much shorter than a step, whose times are probably in another unit.
 *
 * Limits: 8 cells per wave length (below, a wave dies within a few lengths), 4 per radius of a body (below, it is a
 * cloud of mixed cells). Cells count on the finest level that the criteria may put there; where Lua decides, nothing is
 * said. */
#include "case/scene_draft.h"

#include "bulla/eos.h"

#include <math.h>
#include <string.h>

static const double scene_coarse_wave = 8.0, scene_coarse_radius = 4.0; /* cells */
static const double scene_coarse_times = 1000.0;                        /* a pulse over the run, a step over a pulse */

/* Where something is: a box. */
struct scene_coarse_box {
    double lower[SCENE_AXES], upper[SCENE_AXES];
};

static double scene_coarse_cell(const struct scene *scene, int axis, int level)
{
    return ldexp((scene->domain.upper[axis] - scene->domain.lower[axis]) / scene->domain.cells[axis], -level);
}

/* The last layer before `end` that puts a material at a point; NULL: none, or a script decides. */
static const struct scene_layer *scene_coarse_layer(const struct scene *scene, const double x[SCENE_AXES], unsigned end)
{
    for (unsigned i = end; i-- > 0;) {
        const struct scene_layer *layer = &scene->layers[i];
        if ((!layer->has_material && !layer->script) || !shape_contains(layer->shape, x)) continue;
        return layer->script ? NULL : layer;
    }
    return NULL;
}

/* The material that fills most of a layer, or -1. */
static int scene_coarse_main(const struct scene *scene, const struct scene_layer *layer)
{
    int most = -1;
    for (unsigned l = 0; layer && layer->fractions && l < scene->n_material; l++)
        if (layer->fractions[l] > 0.0 && (most < 0 || layer->fractions[l] > layer->fractions[most])) most = (int)l;
    return most;
}

static double scene_coarse_value(const struct scene_value *value, const struct scene_layer *layer,
                                 const double x[SCENE_AXES])
{
    double square = 0.0, number = NAN;
    for (int d = 0; d < SCENE_AXES; d++) square += (x[d] - layer->centre[d]) * (x[d] - layer->centre[d]);
    if (!value->given || scene_value_at(value, x, sqrt(square), 0.0, &number)) return NAN;
    return number;
}

/* Speed of sound of the material that the initial state has at a point; NaN if that is not known. */
static double scene_coarse_sound(const struct scene *scene, const double x[SCENE_AXES])
{
    const struct scene_layer *layer = scene_coarse_layer(scene, x, scene->n_layer);
    int material = scene_coarse_main(scene, layer);
    if (material < 0) return NAN;
    const struct instance *eos = &scene->material[material].eos;
    const struct bulla_eos *law = eos->module->table;
    double rho = scene_coarse_value(&layer->density[material], layer, x), rho_e, rho_c2;
    double p = scene_coarse_value(&layer->pressure, layer, x), T = scene_coarse_value(&layer->temperature, layer, x);
    if (isnan(rho) && isfinite(T) && isfinite(p)) law->density(eos->self, 1, &p, &T, &rho);
    if (!isfinite(rho) || !isfinite(p) || rho <= 0.0) return NAN;
    law->state(eos->self, 1, &rho, &p, &rho_e, &rho_c2);
    return sqrt(rho_c2 / rho);
}

/* The finest level that criteria may put into a box; surfaces only of the materials in `surfaces` (NULL: none). */
static int scene_coarse_level(const struct scene *scene, const struct scene_coarse_box *box, const bool *surfaces)
{
    int finest = 0;
    for (unsigned i = 0; i < scene->mesh.n_refine; i++) {
        const struct scene_refine *refine = &scene->mesh.refines[i];
        bool surface = refine->kind == SCENE_REFINE_INTERFACE;
        if (refine->kind == SCENE_REFINE_BODIES || refine->finest <= finest || refine->t_from >= scene->run.until)
            continue;
        if (surface && !(surfaces && surfaces[refine->material])) continue;
        if (shape_reaches(refine->where, box->lower, box->upper, scene->domain.dim)) finest = refine->finest;
    }
    return finest;
}

/* Times of a pulse: of a whole wave, three times the width at half of the peak (a sine is a third of its period that
 * high), and of all of it; NaN: not known. */
struct scene_coarse_pulse {
    double wave, all;
};

/* Time for which a table is above half of its largest magnitude, around that. */
static double scene_coarse_peak(const struct scene_boundary *boundary)
{
    const double *t = boundary->series_t, *p = boundary->series_p;
    unsigned peak = 0, from, to;
    for (unsigned i = 1; i < boundary->n_series; i++)
        if (fabs(p[i]) > fabs(p[peak])) peak = i;
    from = to = peak;
    double half = 0.5 * p[peak], sign = half < 0.0 ? -1.0 : 1.0;
    while (from > 0 && sign * p[from] > sign * half) from--;
    while (to + 1 < boundary->n_series && sign * p[to] > sign * half) to++;
    double begin = t[from], end = t[to];
    if (from < peak && p[from] != p[from + 1])
        begin += (half - p[from]) / (p[from + 1] - p[from]) * (t[from + 1] - t[from]);
    if (to > peak && p[to] != p[to - 1]) end -= (half - p[to]) / (p[to - 1] - p[to]) * (t[to] - t[to - 1]);
    return end - begin;
}

static struct scene_coarse_pulse scene_coarse_times_of(const struct scene_boundary *boundary)
{
    double period = 1.0 / boundary->frequency, fall = boundary->decay + 2.0 * M_PI * sqrt(3.0) * boundary->frequency;
    switch (boundary->pulse) {
    case SCENE_PULSE_LITHOTRIPTER: return (struct scene_coarse_pulse){3.0 * log(2.0) / fall, period};
    case SCENE_PULSE_SINE: return (struct scene_coarse_pulse){period, period};
    case SCENE_PULSE_GAUSSIAN:
        return (struct scene_coarse_pulse){6.0 * sqrt(log(2.0)) * boundary->width, 2.0 * boundary->width};
    case SCENE_PULSE_SERIES:
        if (boundary->n_series < 2) break;
        return (struct scene_coarse_pulse){3.0 * scene_coarse_peak(boundary),
                                           boundary->series_t[boundary->n_series - 1] - boundary->series_t[0]};
    case SCENE_PULSE_SCRIPT: break;
    }
    return (struct scene_coarse_pulse){NAN, NAN};
}

/* A pulse of seconds in a run of microseconds, or one that is over within a thousandth of a step. */
static void scene_coarse_units(struct draft *draft, const struct keys_value *pulse, double lasts, double step)
{
    const struct scene *scene = draft->scene;
    bool series = strcmp(pulse->text, "series") == 0;
    if (lasts > scene_coarse_times * scene->run.until)
        diag_warn(draft->keys.diag, &pulse->node->mark, "%s: this pulse lasts %.3g s, but the run only %.3g s",
                  pulse->path, lasts, scene->run.until);
    else if (lasts * scene_coarse_times < step)
        diag_warn(draft->keys.diag, &pulse->node->mark, "%s: this pulse lasts %.3g s, but a time step about %.3g s",
                  pulse->path, lasts, step);
    else return;
    if (series)
        diag_help(draft->keys.diag,
                  "are the times in another unit? 'units: {t: us, p: MPa}' says which, or the header of the "
                  "file: t[us],p[MPa]");
    else diag_help(draft->keys.diag, "are the units right?");
}

static void scene_coarse_boundary(struct draft *draft, int axis, int side, const struct keys_value *pulse)
{
    struct scene *scene = draft->scene;
    struct scene_boundary *boundary = &scene->domain.boundary[axis][side];
    struct scene_coarse_box box;
    double x[SCENE_AXES] = {0.0}, at = side ? scene->domain.upper[axis] : scene->domain.lower[axis];
    memcpy(box.lower, scene->domain.lower, sizeof box.lower);
    memcpy(box.upper, scene->domain.upper, sizeof box.upper);
    for (int d = 0; d < scene->domain.dim; d++) x[d] = 0.5 * (scene->domain.lower[d] + scene->domain.upper[d]);
    x[axis] = box.lower[axis] = box.upper[axis] = at;
    int level = scene_coarse_level(scene, &box, NULL);
    double c = scene_coarse_sound(scene, x), h = scene_coarse_cell(scene, axis, level);
    double step = scene->scheme.dt_fixed > 0.0 ? scene->scheme.dt_fixed
                                               : scene->scheme.cfl * ldexp(h, level - scene->mesh.levels) / c;
    struct scene_coarse_pulse times = scene_coarse_times_of(boundary);
    scene_beam_speed(draft, boundary, pulse, c);
    double length = c * times.wave;
    scene_coarse_units(draft, pulse, times.all, step);
    if (!(length < scene_coarse_wave * h) || times.all * scene_coarse_times < step) return;
    diag_warn(draft->keys.diag, &pulse->node->mark,
              "%s: a wave length is %.3g m here (at %.4g m/s) and has %.2g cells of %.3g m, those of level %d",
              pulse->path, length, c, length / h, h, level);
    diag_help(draft->keys.diag, "a wave needs %g: smaller cells along %c, or a criterion of 'mesh.refine' at this face",
              scene_coarse_wave, "xyz"[axis]);
}

static void scene_coarse_boundaries(struct draft *draft)
{
    static const char *const names[SCENE_AXES][2] = {{"x-", "x+"}, {"y-", "y+"}, {"z-", "z+"}};
    const struct keys_map *boundaries = keys_at(keys_at(draft->root, "domain")->map, "boundaries")->map;
    for (int axis = 0; axis < draft->scene->domain.dim; axis++)
        for (int side = 0; side < 2; side++) {
            const struct keys_value *pulse = keys_at(keys_at(boundaries, names[axis][side])->map, "pulse");
            if (pulse->given) scene_coarse_boundary(draft, axis, side, pulse);
        }
}

/* The size of a round shape along an axis: a radius, half of the thickness of a shell; infinite: not of that kind. */
static double scene_coarse_size(const struct shape *shape, int axis)
{
    switch (shape->type) {
    case SHAPE_SPHERE:
    case SHAPE_CYLINDER: return shape->radius;
    case SHAPE_ELLIPSOID: return shape->b[axis] > 0.0 ? shape->b[axis] : INFINITY;
    case SHAPE_RING: return 0.5 * (shape->radius - shape->inner);
    default: return INFINITY;
    }
}

/* Warns about one round shape of a layer; true if it did. */
static bool scene_coarse_shape(struct draft *draft, unsigned index, const struct shape *shape,
                               const struct keys_value *value)
{
    const struct scene *scene = draft->scene;
    const struct scene_layer *layer = &scene->layers[index];
    const struct scene_layer *below = scene_coarse_layer(scene, shape->a, index);
    bool surfaces[SCENE_MATERIALS] = {false};
    struct scene_coarse_box box = {{0.0}, {0.0}};
    if (!below || scene_coarse_main(scene, below) == scene_coarse_main(scene, layer)) return false;
    for (unsigned l = 0; l < scene->n_material; l++)
        surfaces[l] = layer->fractions[l] > 0.0 || below->fractions[l] > 0.0;
    for (int d = 0; d < scene->domain.dim; d++) {
        double reach = shape->type == SHAPE_RING ? shape->radius : scene_coarse_size(shape, d);
        double end = shape->type == SHAPE_CYLINDER ? shape->b[d] : shape->a[d];
        box.lower[d] = fmin(shape->a[d], end) - reach;
        box.upper[d] = fmax(shape->a[d], end) + reach;
    }
    int level = scene_coarse_level(scene, &box, surfaces), worst = 0;
    double least = INFINITY;
    for (int d = 0; d < scene->domain.dim; d++) {
        double cells = scene_coarse_size(shape, d) / scene_coarse_cell(scene, d, level);
        if (cells < least) worst = d;
        least = fmin(least, cells);
    }
    if (!(least < scene_coarse_radius)) return false;
    diag_warn(draft->keys.diag, &value->node->mark, "%s: %s of %.3g m has %.2g cells of %.3g m, those of level %d",
              value->path, shape->type == SHAPE_RING ? "half of a shell" : "a radius", scene_coarse_size(shape, worst),
              least, scene_coarse_cell(scene, worst, level), level);
    diag_help(draft->keys.diag, "it needs %g to be more than a few mixed cells%s", scene_coarse_radius,
              level < scene->mesh.levels ? "; no criterion of 'mesh.refine' puts the finest level there" : "");
    return true;
}

static bool scene_coarse_same(const struct mark *a, const struct mark *b)
{
    return a->source == b->source && a->line == b->line && a->column == b->column;
}

static void scene_coarse_layers(struct draft *draft)
{
    static const char *const round[] = {"sphere", "cylinder", "ellipsoid", "ring", "union"};
    const struct scene *scene = draft->scene;
    const struct keys_value *initial = keys_at(draft->root, "initial"), *value = NULL;
    const struct keys_value *last = NULL; /* warned of: of a cloud or a row one is enough */
    for (unsigned i = 0; i < scene->n_layer; i++) {
        const struct scene_layer *layer = &scene->layers[i];
        if (!layer->has_material || !layer->shape || !layer->fractions) continue;
        for (unsigned k = 0; k < sizeof round / sizeof *round; k++)
            if (keys_at(initial->list[i].map, round[k])->node) value = keys_at(initial->list[i].map, round[k]);
        if (last && scene_coarse_same(&last->node->mark, &value->node->mark)) continue;
        bool warned = layer->shape->type != SHAPE_UNION && scene_coarse_shape(draft, i, layer->shape, value);
        for (unsigned k = 0; !warned && layer->shape->type == SHAPE_UNION && k < layer->shape->n; k++)
            warned = scene_coarse_shape(draft, i, layer->shape->parts[k], value);
        if (warned) last = value;
    }
}

void scene_coarse(struct draft *draft)
{
    scene_coarse_boundaries(draft);
    scene_coarse_layers(draft);
}
