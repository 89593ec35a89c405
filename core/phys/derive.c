/* derive.c - named fields from primitives, see derive.h.
 *
 * One table row per quantity; a row is either a point-wise function of a tile's primitives or
 * needs the gradient of something (vorticity, schlieren), taken by central differences over
 * gathered frames, boundaries included. */
#include "phys/derive.h"

#include "base/comm.h"
#include "base/mem.h"
#include "base/status.h"
#include "base/text.h"
#include "phys/bound.h"
#include "phys/mix.h"
#include "phys/prolong.h"

#include <math.h>
#include <string.h>

/* One call's view of a tile. */
struct derive_tile {
    const struct model *model;
    const struct mesh *mesh;
    const struct level *level;
    int level_index;
    unsigned local;
    double t;
    const struct derive *field;
    const double *w;
    size_t n;
};

struct derive_quantity {
    const char *name; /* with a trailing "_" for per-material and per-axis quantities */
    const char *unit;
    enum { DERIVE_ONE, DERIVE_VECTOR, DERIVE_AXIS, DERIVE_MATERIAL } form;
    void (*compute)(const struct derive_tile *tile, double *out);
};

static const double *derive_w(const struct derive_tile *tile, unsigned q)
{
    return tile->w + q * tile->n;
}

static double derive_alpha(const struct derive_tile *tile, unsigned l, size_t i)
{
    return tile->model->n_alpha ? derive_w(tile, tile->model->i_alpha + l)[i] : 1.0;
}

static void derive_density(const struct derive_tile *tile, double *out)
{
    memset(out, 0, tile->n * sizeof *out);
    for (unsigned l = 0; l < tile->model->n_material; l++)
        for (size_t i = 0; i < tile->n; i++)
            out[i] += derive_alpha(tile, l, i) * derive_w(tile, tile->model->i_m + l)[i];
}

static void derive_pressure(const struct derive_tile *tile, double *out)
{
    memcpy(out, derive_w(tile, tile->model->i_E), tile->n * sizeof *out);
}

static void derive_velocity_axis(const struct derive_tile *tile, double *out)
{
    int axis = tile->field->index;
    if (axis < (int)tile->model->n_velocity)
        memcpy(out, derive_w(tile, tile->model->i_u + (unsigned)axis), tile->n * sizeof *out);
    else memset(out, 0, tile->n * sizeof *out);
}

static void derive_velocity(const struct derive_tile *tile, double *out)
{
    struct derive axis = *tile->field;
    struct derive_tile one = *tile;
    one.field = &axis;
    for (axis.index = 0; axis.index < 3; axis.index++) derive_velocity_axis(&one, out + (size_t)axis.index * tile->n);
}

static double derive_speed2(const struct derive_tile *tile, size_t i)
{
    double sum = 0.0;
    for (unsigned d = 0; d < tile->model->n_velocity; d++) {
        double u = derive_w(tile, tile->model->i_u + d)[i];
        sum += u * u;
    }
    return sum;
}

/* Wood: 1/(rho c^2) = sum alpha_l / (rho_l c_l^2). The solver itself uses the frozen speed. */
static void derive_sound_speed(const struct derive_tile *tile, double *out)
{
    const struct model *model = tile->model;
    double *rho_c2 = mem_new((model->n_material + 1) * tile->n, sizeof *rho_c2);
    double *rho = rho_c2 + model->n_material * tile->n;
    mix_stiffness(model, tile->n, tile->n, tile->w, rho_c2);
    derive_density(tile, rho);
    for (size_t i = 0; i < tile->n; i++) {
        double compliance = 0.0;
        for (unsigned l = 0; l < model->n_material; l++) {
            double alpha = derive_alpha(tile, l, i), stiff = rho_c2[l * tile->n + i];
            if (alpha > 0.0 && stiff > 0.0) compliance += alpha / stiff; /* as in mix_closure */
        }
        out[i] = sqrt(1.0 / (rho[i] * compliance));
    }
    mem_free(rho_c2);
}

static void derive_mach(const struct derive_tile *tile, double *out)
{
    derive_sound_speed(tile, out);
    for (size_t i = 0; i < tile->n; i++) out[i] = sqrt(derive_speed2(tile, i)) / out[i];
}

static void derive_total_energy(const struct derive_tile *tile, double *out)
{
    const struct model *model = tile->model;
    double *u = mem_new(model->n_field * tile->n, sizeof *u);
    mix_conserved(model, tile->n, tile->n, tile->w, u);
    memcpy(out, u + model->i_E * tile->n, tile->n * sizeof *out);
    mem_free(u);
}

/* Specific internal energy e [J/kg]. */
static void derive_internal_energy(const struct derive_tile *tile, double *out)
{
    double *rho = mem_new(tile->n, sizeof *rho);
    derive_density(tile, rho);
    derive_total_energy(tile, out);
    for (size_t i = 0; i < tile->n; i++) out[i] = out[i] / rho[i] - 0.5 * derive_speed2(tile, i);
    mem_free(rho);
}

static void derive_material_temperature(const struct derive_tile *tile, double *out)
{
    double *T = mem_new(tile->model->n_material * tile->n, sizeof *T);
    mix_temperatures(tile->model, tile->n, tile->n, tile->w, T);
    memcpy(out, T + (size_t)tile->field->index * tile->n, tile->n * sizeof *out);
    mem_free(T);
}

/* T = sum Y_l T_l (model.md 6). */
static void derive_temperature(const struct derive_tile *tile, double *out)
{
    const struct model *model = tile->model;
    double *T = mem_new((model->n_material + 1) * tile->n, sizeof *T), *rho = T + model->n_material * tile->n;
    mix_temperatures(model, tile->n, tile->n, tile->w, T);
    derive_density(tile, rho);
    memset(out, 0, tile->n * sizeof *out);
    for (unsigned l = 0; l < model->n_material; l++)
        for (size_t i = 0; i < tile->n; i++)
            out[i] += derive_alpha(tile, l, i) * derive_w(tile, model->i_m + l)[i] / rho[i] * T[l * tile->n + i];
    mem_free(T);
}

static void derive_fraction(const struct derive_tile *tile, double *out)
{
    for (size_t i = 0; i < tile->n; i++) out[i] = derive_alpha(tile, (unsigned)tile->field->index, i);
}

/* rho_l where the material is present, else 0. */
static void derive_material_density(const struct derive_tile *tile, double *out)
{
    unsigned l = (unsigned)tile->field->index;
    for (size_t i = 0; i < tile->n; i++)
        out[i] = derive_alpha(tile, l, i) > 0.0 ? derive_w(tile, tile->model->i_m + l)[i] : 0.0;
}

static void derive_partial_density(const struct derive_tile *tile, double *out)
{
    unsigned l = (unsigned)tile->field->index;
    for (size_t i = 0; i < tile->n; i++) out[i] = derive_alpha(tile, l, i) * derive_w(tile, tile->model->i_m + l)[i];
}

static void derive_level(const struct derive_tile *tile, double *out)
{
    for (size_t i = 0; i < tile->n; i++) out[i] = tile->level_index;
}

static void derive_rank(const struct derive_tile *tile, double *out)
{
    for (size_t i = 0; i < tile->n; i++) out[i] = comm_rank();
}

/* Work per cell relative to a cell of one material: the number of materials present. */
static void derive_cost(const struct derive_tile *tile, double *out)
{
    for (size_t i = 0; i < tile->n; i++) {
        out[i] = 0.0;
        for (unsigned l = 0; l < tile->model->n_material; l++) out[i] += derive_alpha(tile, l, i) > 0.0;
    }
}

/* Layers behind the domain's boundary. What non-reflecting boundaries send in depends on the start of the run; here
 * they go on with the value inside. */
static void derive_behind(void *data, unsigned local, const struct frame *frame, int side, size_t pitch, double *w)
{
    const struct bound *bound = data;
    const struct model *model = bound->model;
    enum scene_boundary_type type = model->scene->boundary[frame->axis][side].type;
    if (type != SCENE_NONREFLECTING && type != SCENE_INCOMING_WAVE) {
        bound_fill(data, local, frame, side, pitch, w);
        return;
    }
    for (unsigned i = 0; i < model->n_active; i++)
        bound_copy(NULL, local, frame, side, pitch, w + model->active[i] * pitch);
}

/* Central differences along an axis of a combination of primitives: `combine` makes one value per
 * frame cell out of the gathered primitives. grad: [n]. */
static void derive_gradient(const struct derive_tile *tile, int axis,
                            double (*combine)(const struct model *, const double *w, size_t pitch, int which),
                            int which, double *grad)
{
    const struct mesh *mesh = tile->mesh;
    const struct model *model = tile->model;
    struct bound bound = {.model = model, .mesh = mesh, .level = tile->level, .t = tile->t};
    const struct frame_source source = {.mesh = mesh,
                                        .level = tile->level,
                                        .arrays = tile->level->w,
                                        .halo = tile->level->halo,
                                        .link = tile->level->link,
                                        .n_field = model->n_active,
                                        .fields = model->active,
                                        .boundary = derive_behind,
                                        .data = &bound};
    double *w = mem_new((size_t)model->n_field * FRAME_CELLS, sizeof *w);
    for (size_t piece = 0; piece < frame_pieces(mesh, axis); piece++) {
        struct frame frame = frame_piece(mesh, axis, piece);
        frame_gather(&source, tile->local, &frame, FRAME_CELLS, w);
        for (size_t o = 0; o < frame.outer; o++)
            for (size_t i = 0; i < frame.n; i++)
                for (size_t j = 0; j < frame.inner; j++) {
                    size_t at = frame_at(&frame, o, (int)i) + j;
                    double up = combine(model, w + at + frame.inner, FRAME_CELLS, which);
                    double down = combine(model, w + at - frame.inner, FRAME_CELLS, which);
                    grad[frame_tile_at(&frame, o, i) + j] = (up - down) / (2.0 * tile->level->h[axis]);
                }
    }
    mem_free(w);
}

static double derive_combine_velocity(const struct model *model, const double *w, size_t pitch, int which)
{
    return w[(model->i_u + (unsigned)which) * pitch];
}

static double derive_combine_density(const struct model *model, const double *w, size_t pitch, int which)
{
    double rho = 0.0;
    (void)which;
    for (unsigned l = 0; l < model->n_material; l++)
        rho += (model->n_alpha ? w[(model->i_alpha + l) * pitch] : 1.0) * w[(model->i_m + l) * pitch];
    return rho;
}

/* curl u; in axisymmetric scenes the axes are (r, z) and the only component points along theta,
 * which is minus the third direction of the right-handed (r, z, -theta). */
static void derive_vorticity(const struct derive_tile *tile, double *out)
{
    int dim = tile->mesh->dim;
    double *slope = mem_new(tile->n, sizeof *slope);
    memset(out, 0, 3 * tile->n * sizeof *out);
    for (int axis = 0; axis < dim; axis++)
        for (int of = 0; of < (int)tile->model->n_velocity; of++) {
            if (of == axis) continue;
            int component = 3 - axis - of;
            double sign = (axis + 1) % 3 == of ? 1.0 : -1.0;
            derive_gradient(tile, axis, derive_combine_velocity, of, slope);
            for (size_t i = 0; i < tile->n; i++) out[(size_t)component * tile->n + i] += sign * slope[i];
        }
    mem_free(slope);
}

static void derive_density_gradient(const struct derive_tile *tile, double *out)
{
    double *slope = mem_new(tile->n, sizeof *slope);
    memset(out, 0, tile->n * sizeof *out);
    for (int axis = 0; axis < tile->mesh->dim; axis++) {
        derive_gradient(tile, axis, derive_combine_density, 0, slope);
        for (size_t i = 0; i < tile->n; i++) out[i] += slope[i] * slope[i];
    }
    for (size_t i = 0; i < tile->n; i++) out[i] = sqrt(out[i]);
    mem_free(slope);
}

/* exp(-k |grad rho| / max |grad rho|), k = 200 (model.md 9). */
static void derive_schlieren(const struct derive_tile *tile, double *out)
{
    derive_density_gradient(tile, out);
    for (size_t i = 0; i < tile->n; i++)
        out[i] = tile->field->scale > 0.0 ? exp(-200.0 * out[i] / tile->field->scale) : 1.0;
}

static const struct derive_quantity derive_table[] = {
    {"density", "kg/m3", DERIVE_ONE, derive_density},
    {"pressure", "Pa", DERIVE_ONE, derive_pressure},
    {"velocity", "m/s", DERIVE_VECTOR, derive_velocity},
    {"velocity_", "m/s", DERIVE_AXIS, derive_velocity_axis},
    {"temperature", "K", DERIVE_ONE, derive_temperature},
    {"sound_speed", "m/s", DERIVE_ONE, derive_sound_speed},
    {"mach", "1", DERIVE_ONE, derive_mach},
    {"internal_energy", "J/kg", DERIVE_ONE, derive_internal_energy},
    {"total_energy", "J/m3", DERIVE_ONE, derive_total_energy},
    {"vorticity", "1/s", DERIVE_VECTOR, derive_vorticity},
    {"schlieren", "1", DERIVE_ONE, derive_schlieren},
    {"level", "1", DERIVE_ONE, derive_level},
    {"rank", "1", DERIVE_ONE, derive_rank},
    {"cost", "1", DERIVE_ONE, derive_cost},
    {"alpha_", "1", DERIVE_MATERIAL, derive_fraction},
    {"density_", "kg/m3", DERIVE_MATERIAL, derive_material_density},
    {"temperature_", "K", DERIVE_MATERIAL, derive_material_temperature},
    {"partial_density_", "kg/m3", DERIVE_MATERIAL, derive_partial_density},
};

enum { DERIVE_ROWS = sizeof derive_table / sizeof *derive_table };

/* Axis or material that the part after a row's prefix names, or -1. */
static int derive_suffix(const struct model *model, const struct derive_quantity *row, const char *suffix)
{
    if (row->form == DERIVE_AXIS) return strlen(suffix) == 1 && strchr("xyz", *suffix) ? *suffix - 'x' : -1;
    for (unsigned l = 0; l < model->n_material; l++)
        if (!strcmp(suffix, model->scene->material[l].name)) return (int)l;
    return -1;
}

int derive_find(const struct model *model, const char *name, struct derive *ret_field)
{
    for (int i = 0; i < DERIVE_ROWS; i++) {
        const struct derive_quantity *row = &derive_table[i];
        size_t length = strlen(row->name);
        bool whole = row->form == DERIVE_ONE || row->form == DERIVE_VECTOR;
        int index = 0;
        if (whole ? strcmp(name, row->name) != 0 : strncmp(name, row->name, length) != 0) continue;
        if (!whole && (index = derive_suffix(model, row, name + length)) < 0) continue;
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

const char *const *derive_names(const struct model *model)
{
    return (const char *const *)model->names;
}

static struct derive_tile derive_view(const struct model *model, const struct mesh *mesh, int level, unsigned local,
                                      double t, const struct derive *field)
{
    const struct level *of = &mesh->levels[level];
    return (struct derive_tile){.model = model,
                                .mesh = mesh,
                                .level = of,
                                .level_index = level,
                                .local = local,
                                .t = t,
                                .field = field,
                                .w = of->w[local],
                                .n = mesh->n_cell};
}

/* Brings the neighbours' layers up to date, coarser ones too: after a step they still hold the midpoint. */
static void derive_exchange(const struct model *model, const struct mesh *mesh, double t)
{
    struct prolong *prolong = prolong_new(model, mesh);
    for (int l = 0; l < mesh->n_level; l++) {
        halo_start(mesh->levels[l].halo, mesh->levels[l].w);
        halo_finish(mesh->levels[l].halo);
        if (l + 1 == mesh->n_level) break;
        struct link *link = mesh->levels[l + 1].link;
        struct bound *bound = bound_new(model, mesh, &mesh->levels[l]);
        bound->t = t;
        prolong_strips(prolong, mesh, l, bound, 0);
        bound_free(bound);
        link_down(link);
        link->theta = 0.0;
    }
    prolong_free(prolong);
}

/* Raises *scale to the largest gradient in the leaves of a tile. */
static void derive_steepest(const struct derive_tile *tile, double *gradient, double *scale)
{
    const struct tile *here = &tile->level->tiles[tile->level->first + tile->local];
    derive_density_gradient(tile, gradient);
    for (size_t i = 0; i < tile->n; i++)
        if (gradient[i] > *scale && !(here->covered >> mesh_octant(tile->mesh, i) & 1)) *scale = gradient[i];
}

void derive_prepare(const struct model *model, const struct mesh *mesh, double t, struct derive *field)
{
    void (*compute)(const struct derive_tile *, double *) = derive_table[field->what].compute;
    if (compute == derive_schlieren || compute == derive_vorticity) derive_exchange(model, mesh, t);
    if (compute != derive_schlieren) return;
    double *gradient = mem_new(mesh->n_cell, sizeof *gradient);
    field->scale = 0.0;
    for (int l = 0; l < mesh->n_level; l++)
        for (unsigned tile = 0; tile < mesh->levels[l].n_local; tile++) {
            struct derive_tile view = derive_view(model, mesh, l, tile, t, field);
            derive_steepest(&view, gradient, &field->scale);
        }
    mem_free(gradient);
    comm_max(&field->scale, 1);
}

void derive_tile(const struct model *model, const struct mesh *mesh, int level, unsigned local, double t,
                 const struct derive *field, double *out)
{
    struct derive_tile view = derive_view(model, mesh, level, local, t, field);
    derive_table[field->what].compute(&view, out);
}
