/* A repeated attempt beside a wall, cells of four thousandths and whole ones: what the first get of water that is
 * pressed against the wall is what a whole cell would get, and air beside it feels its own pressure. */
#include "flow.h"
#include "phys/mix.h"
#include "scheme/rate.h"

static const double PRESSED = 1e7, AIR = 1e5;

/* Water in the last cell, which the body cuts. */
static void set_pressed(const struct model *model, const double x[3], double *w)
{
    bool last = x[0] > 0.875;
    w[model->i_alpha] = last ? 1.0 : 0.0;
    w[model->i_alpha + 1] = last ? 0.0 : 1.0;
    w[model->i_E] = last ? PRESSED : AIR;
}

static void cut_gather(void *data, const struct frame *frame, struct face_work *faces)
{
    const struct frame_source source = flow_source(data);
    frame_gather(&source, 0, frame, FACE_ROOM, faces->frame);
    memset(faces->mask, 0, frame->count * sizeof *faces->mask);
}

static void cut_seen(void *data, const struct frame *frame, struct face_work *faces)
{
    (void)data;
    (void)frame;
    (void)faces;
}

static void test_pressed(void **state)
{
    (void)state;
    struct flow flow;
    flow_start(&flow, mem_print("bulla: 1\ntitle: pressed\ndomain: {lower: [0], upper: [1], cells: [8], boundaries: "
                                "{x-: reflecting, x+: reflecting}}\nmesh: {tile: 8}\nmaterials:\n" FLOW_WATER FLOW_AIR
                                "bodies: {wall: {box: {lower: [0.8755], upper: [2]}}}\n"
                                "initial:\n  - {everywhere: true, fractions: {water: 0.5, air: 0.5}, density: {water: "
                                "1000, air: 1.2}, pressure: 1e5}\nrun: {until: 1}\n"));
    flow_set(&flow, set_pressed);
    const struct model *model = flow.state->model;
    const struct mesh *mesh = flow.state->mesh;
    const struct level *level = flow_level(&flow);
    size_t n = mesh->n_cell;
    void *own[TERMS_MOST];
    struct face_work *faces = face_new(model);
    struct terms *terms = terms_new(model, faces);
    terms_open(&(struct term_room){.model = model, .mesh = mesh}, own);
    double *rates = mem_new(terms->n_rates * n, sizeof *rates), *K = mem_new(2 * n, sizeof *K);
    double *rho_c2 = mem_new(2 * n, sizeof *rho_c2);
    mix_stiffness(model, n, n, level->w[0], rho_c2);
    struct term_tile tile = {.terms = terms,
                             .model = model,
                             .mesh = mesh,
                             .level = level,
                             .tile = level->tiles,
                             .n_cell = n,
                             .dt = 1e-6,
                             .u = level->u_old[0],
                             .w = level->w[0],
                             .rates = rates,
                             .K = K,
                             .rho_c2 = rho_c2};
    rate_take(&tile, own, &(struct rate_watch){&flow, cut_gather, cut_seen, NULL}, true);
    const double *push = rates + model->i_u * n, whole = (PRESSED - AIR) / level->h[0];
    assert_true(push[n - 1] < 0.0 && push[n - 1] > -2.5 * whole);
    assert_true(push[n - 2] < 0.0 && push[n - 2] > -0.01 * whole);
    double *all[] = {rates, K, rho_c2};
    for (size_t k = 0; k < sizeof all / sizeof *all; k++) mem_free(all[k]);
    terms_free(terms);
    terms_close(own);
    face_free(faces);
    flow_stop(&flow);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(test_pressed)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
