/* Patches of primitives: what lies across faces has the bits of the frames that fluxes are made from, at every kind of
 * boundary and between levels at any time of a coarse step; and how the domain is cut into tiles changes no bit,
 * edges and corners included. */
#include "prolong_levels.h"

#include "levels/prolong_rim.h"
#include "mesh/halo.h"
#include "phys/elastic.h"
#include "scheme/patch_state.h"

/* A solid by the name that the domains know. */
#define GEL                                                                                                \
    "  water: {eos: {type: stiffened-gas, gamma: 4.4, p-inf: 600 MPa}, constitutive: {type: neo-hookean, " \
    "shear-modulus: 1 MPa, reference-density: 1000}}\n"

static const char *const FLUIDS[] = {FLOW_WATER FLOW_AIR, FLOW_WATER FLOW_AIR FLOW_HELIUM, GEL FLOW_AIR FLOW_HELIUM,
                                     FLOW_WATER};

#define WAVE "{type: incoming-wave, pulse: sine, amplitude: 1 MPa, frequency: 10 kHz}"
#define WIND(u) "{type: inflow, material: water, density: 1000, pressure: '= 1e5 * (2 + y)', velocity: [" u "]}"

static const char *const DOMAINS[] = {
    "{lower: [0], upper: [1], cells: [32], boundaries: {x-: non-reflecting, x+: reflecting}}",
    "{lower: [0, 0], upper: [1, 1], cells: [32, 32], boundaries: {x-: outflow, x+: reflecting, y-: no-slip, "
    "y+: non-reflecting}}",
    "{lower: [0, 0], upper: [1, 1], cells: [32, 32], boundaries: {x-: " WIND(
        "1, 0") ", x+: " WAVE ", y-: non-reflecting, y+: symmetry}}",
    "{geometry: axisymmetric, lower: [0, 0], upper: [1, 1], cells: [32, 32], boundaries: {x-: axis, x+: " WAVE
    ", y-: periodic, y+: periodic}}",
    "{lower: [0, 0, 0], upper: [1, 1, 1], cells: [16, 16, 16], boundaries: {x-: no-slip, x+: non-reflecting, y-: " WAVE
    ", y+: reflecting, z-: outflow, z+: " WIND("0, 0, 1") "}}",
    "{lower: [0, 0, 0], upper: [1, 1, 1], cells: [16, 16, 16], boundaries: {x-: periodic, x+: periodic, y-: periodic, "
    "y+: periodic, z-: periodic, z+: periodic}}",
};
enum { DOMAIN_COUNT = sizeof DOMAINS / sizeof *DOMAINS, FLUID_COUNT = sizeof FLUIDS / sizeof *FLUIDS };

static char *text_of(int domain, int fluid, int tile)
{
    return mem_print("bulla: 1\ntitle: patches\ndomain: %s\nmesh: {tile: %d}\nmaterials:\n%sinitial:\n"
                     "  - {everywhere: true, material: water, density: 1000, pressure: 1e5}\nrun: {until: 1}\n",
                     DOMAINS[domain], tile, FLUIDS[fluid]);
}

/* Smooth here, jumping there, and other in every field. */
static void set_state(const struct model *model, const double x[3], double *w)
{
    uint64_t seed = (uint64_t)(1e5 * (x[0] + 17.0 * x[1] + 331.0 * x[2]));
    double sum = 0.0;
    for (unsigned l = 0; l < model->n_alpha; l++)
        sum += w[l] = x[0] < 0.4 ? flow_random(&seed) : 0.3 + 0.2 * sin(3.0 * x[1] + l);
    for (unsigned l = 0; l < model->n_alpha; l++) w[l] /= sum;
    for (unsigned l = 0; l < model->n_material; l++)
        w[model->i_m + l] = (l ? 1.0 : 1000.0) * (1.1 + 0.1 * sin(5.0 * x[0] + x[1]));
    for (unsigned d = 0; d < model->n_velocity; d++) w[model->i_u + d] = 20.0 * cos(4.0 * x[0] + 3.0 * x[1] + x[2] + d);
    w[model->i_E] = 1e5 * (2.0 + sin(6.0 * x[1]) + flow_random(&seed));
    for (unsigned c = 0; c < model->n_stretch; c++)
        w[model->i_V + c] = (c < 3 ? 1.0 : 0.0) + 0.05 * sin(2.0 * x[0] + c);
    elastic_settle(model, 1, 1, w);
}

static bool in_patches(const int at[3])
{
    return (at[0] + at[1] + at[2]) % 3 == 1 || (at[0] < 2 && at[1] < 2);
}

/* A level under a part of the domain that keeps to nesting: the coarse level has all tiles. */
static void exchange(struct twolevel *two, struct bound *fine, int g, struct patch_state *keep)
{
    struct prolong *prolong = prolong_new(two->model, two->mesh);
    struct patch_source coarse = patch_state_source(two->model, two->mesh, 0, g, 2, two->bound, keep);
    struct patch_state other;
    struct rim *rim = patch_state_source(two->model, two->mesh, 1, g, 2, fine, &other).rim;
    size_t n = two->mesh->n_cell * two->model->n_field;
    for (int slot = 0; slot < 2; slot++) {
        halo_start(two->coarse->halo, two->coarse->w);
        halo_finish(two->coarse->halo);
        prolong_strips(prolong, two->mesh, 0, two->bound, slot);
        patch_start(&coarse);
        patch_finish(&coarse);
        prolong_rim(&coarse, rim, slot, two->model);
        for (unsigned t = 0; t < two->coarse->n_local; t++) /* another state: that of the tile upside down */
            for (size_t i = 0, q = 0; i < n; q = ++i / two->mesh->n_cell) {
                size_t c = i % two->mesh->n_cell, back = two->mesh->n_cell - 1 - c;
                double *w = two->coarse->w[t] + q * two->mesh->n_cell, here = w[c];
                if (c < back) w[c] = w[back];
                if (c < back) w[back] = here;
            }
    }
    link_down(two->fine->link);
    rim_down(rim);
    prolong_free(prolong);
}

/* Every cell of every frame against the patch. */
static size_t compare_frames(const struct twolevel *two, int l, struct bound *bound, int g)
{
    struct mesh *mesh = two->mesh;
    struct patch_state keep;
    const struct level *level = &mesh->levels[l];
    const struct patch_source source = patch_state_source(two->model, mesh, l, g, 2, bound, &keep);
    const struct frame_source frames = {.mesh = mesh,
                                        .level = level,
                                        .arrays = level->w,
                                        .halo = level->halo,
                                        .link = level->link,
                                        .n_field = two->model->n_active,
                                        .fields = two->model->active,
                                        .boundary = bound_fill,
                                        .data = bound};
    struct box_block patch = rim_block(mesh, g, NULL);
    double *w = mem_new(two->model->n_field * (size_t)FRAME_CELLS, sizeof *w);
    size_t compared = 0;
    patch.data = mem_new(two->model->n_field * patch.pitch, sizeof *patch.data);
    halo_start(level->halo, level->w);
    halo_finish(level->halo);
    patch_start(&source);
    patch_finish(&source);
    for (unsigned t = 0; t < level->n_local; t++) {
        patch_gather(&source, t, patch.data);
        for (int axis = 0; axis < mesh->dim; axis++)
            for (size_t piece = 0; piece < frame_pieces(mesh, axis); piece++) {
                struct frame frame = frame_piece(mesh, axis, piece);
                frame_gather(&frames, t, &frame, FRAME_CELLS, w);
                for (size_t o = 0; o < frame.outer; o++)
                    for (int i = -g; i < (int)frame.n + g; i++)
                        for (size_t k = 0; k < frame.inner; k++) {
                            int at[3] = {0}, place = (int)frame_tile_at(&frame, o, 0) + (int)k;
                            for (int d = 0; d < 3; place /= mesh->n[d], d++) at[d] = place % mesh->n[d];
                            at[axis] = i;
                            for (unsigned q = 0; q < two->model->n_field; q++)
                                if (patch.data[q * patch.pitch + box_at(&patch, at[0], at[1], at[2])] !=
                                    w[q * FRAME_CELLS + frame_at(&frame, o, i) + k])
                                    fail_msg("level %d, tile %u, axis %d, cell (%d, %d, %d), field %u", l, t, axis,
                                             at[0], at[1], at[2], q);
                            compared += i < 0;
                        }
            }
    }
    mem_free(patch.data);
    mem_free(w);
    return compared;
}

static void faces_have_the_bits_of_frames(void **state)
{
    (void)state;
    for (int domain = 0; domain < DOMAIN_COUNT; domain++)
        for (int fluid = 0; fluid < FLUID_COUNT; fluid++) {
            struct twolevel two;
            struct patch_state keep;
            twolevel_start(&two, text_of(domain, fluid, 8), set_state, in_patches);
            twolevel_bear(&two);
            twolevel_close(&two);
            struct bound *fine = bound_new(two.model, two.mesh, two.fine);
            for (int g = 1; g <= two.mesh->ghosts; g++) {
                exchange(&two, fine, g, &keep);
                for (int step = 0; step < 3; step++) {
                    two.fine->link->theta = 0.35 * step;
                    assert_true(compare_frames(&two, 0, two.bound, g) > 0);
                    assert_true(compare_frames(&two, 1, fine, g) > 0);
                }
            }
            bound_free(fine);
            twolevel_stop(&two);
        }
}

/* The whole domain with g layers around it, from patches of all tiles, which must agree where they overlap. */
static double *whole(const struct flow *flow, int g, bool *ret_same)
{
    const struct mesh *mesh = flow->state->mesh;
    const struct model *model = flow->state->model;
    const struct level *level = flow_level(flow);
    struct patch_state keep;
    struct bound *bound = flow->state->stages[0]->bound;
    const struct patch_source source = patch_state_source(model, mesh, 0, g, 1, bound, &keep);
    struct box_block patch = rim_block(mesh, g, NULL), all = patch;
    all.pitch = 1;
    for (int d = 0; d < 3; d++) {
        all.size[d] = patch.size[d] + (size_t)(mesh->n[d] * (level->extent[d] - 1));
        all.pitch *= all.size[d];
    }
    all.data = mem_new(model->n_field * all.pitch, sizeof *all.data);
    patch.data = mem_new(model->n_field * patch.pitch, sizeof *patch.data);
    bool *seen = mem_new(all.pitch, sizeof *seen);
    patch_start(&source);
    patch_finish(&source);
    *ret_same = true;
    for (unsigned t = 0; t < level->n_local; t++) {
        patch_gather(&source, t, patch.data);
        for (size_t c = 0; c < patch.pitch; c++) {
            int at[3], place = (int)c;
            for (int d = 0; d < 3; place /= (int)patch.size[d], d++)
                at[d] = patch.from[d] + place % (int)patch.size[d] + mesh->n[d] * level->tiles[t].at[d];
            size_t to = box_at(&all, at[0], at[1], at[2]);
            for (unsigned q = 0; q < model->n_field; q++) {
                double value = patch.data[q * patch.pitch + c], *place_of = &all.data[q * all.pitch + to];
                *ret_same = *ret_same && (!seen[to] || *place_of == value);
                *place_of = value;
            }
            seen[to] = true;
        }
    }
    mem_free(seen);
    mem_free(patch.data);
    return all.data;
}

static void tiles_change_no_bit(void **state)
{
    (void)state;
    for (int domain = 0; domain < DOMAIN_COUNT; domain++)
        for (int fluid = 0; fluid < FLUID_COUNT; fluid++) {
            static const int sizes[] = {32, 16, 8};
            double *first = NULL;
            int whole_tile = strstr(DOMAINS[domain], "32") ? 0 : 1;
            for (int i = whole_tile; i < 3; i++) {
                struct flow flow;
                bool same;
                flow_start(&flow, text_of(domain, fluid, sizes[i]));
                flow_set(&flow, set_state);
                double *all = whole(&flow, 2, &same);
                size_t cells = flow.state->model->n_field;
                for (int d = 0; d < flow.scene->domain.dim; d++) cells *= (size_t)flow.scene->domain.cells[d] + 4;
                assert_true(same);
                if (first) assert_memory_equal(all, first, cells * sizeof *all);
                if (!first) first = all;
                else mem_free(all);
                flow_stop(&flow);
            }
            mem_free(first);
        }
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(faces_have_the_bits_of_frames),
                                       cmocka_unit_test(tiles_change_no_bit)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
