/* Volume that goes through a face is that of all materials together: limited fractions of three, one by one steeper
 * here and flatter there, are brought back to sum 1. It carries the pressure of where it comes from. */
#include "flow.h"

static uint64_t seed = 21;

static void set_three(const struct model *model, const double x[3], double *w)
{
    double left = 1.0;
    (void)x;
    for (unsigned l = 0; l < 3; l++) {
        double alpha = l == 2 ? left : left * flow_random(&seed);
        w[model->i_alpha + l] = alpha;
        left -= alpha;
    }
    w[model->i_E] = 1e5 * (1.0 + 0.1 * flow_random(&seed));
    w[model->i_u] = 50.0 * (flow_random(&seed) - 0.5);
}

/* With marks everywhere edges are the cells themselves: volume carries the pressure of the cell that it leaves. */
static void check_origin(struct face_work *work, const struct frame *frame, const struct model *model)
{
    int forward = 0, backward = 0;
    for (size_t i = 0; i < frame->count; i++) work->mask[i] = 1.0;
    face_solve(work, frame, true);
    for (int i = 0; i <= 32; i++) {
        size_t face = face_at(frame, 0, (size_t)i);
        bool on = work->u[face] >= 0.0;
        double from = work->frame[model->i_E * FACE_ROOM + frame_at(frame, 0, on ? i - 1 : i)];
        forward += on;
        backward += !on;
        for (unsigned l = 0; l < 3; l++) {
            double volume = work->alpha[l * FACE_ROOM + face], carried = work->carried[l * FACE_ROOM + face];
            assert_true(fabs(carried - volume * from) <= 1e-14 * fabs(carried));
        }
    }
    assert_true(forward > 5 && backward > 5);
}

static void test_sum(void **state)
{
    (void)state;
    struct flow flow;
    flow_start(&flow,
               mem_print("bulla: 1\ntitle: three\ndomain: {lower: [0], upper: [1], cells: [32], boundaries: {x-: "
                         "periodic, x+: periodic}}\nmesh: {tile: 32}\nmaterials:\n" FLOW_WATER FLOW_AIR FLOW_HELIUM
                         "initial:\n  - {everywhere: true, fractions: {water: 0.2, air: 0.3, helium: 0.5}, density: "
                         "{water: 1000, air: 1.2, helium: 0.2}, pressure: 1e5}\nrun: {until: 1}\n"));
    flow_set(&flow, set_three);
    const struct model *model = flow.state->model;
    const struct frame_source source = flow_source(&flow);
    struct face_work *work = face_new(model);
    struct frame frame = frame_piece(flow.state->mesh, 0, 0);
    frame_gather(&source, 0, &frame, FACE_ROOM, work->frame);
    face_solve(work, &frame, false);
    double most = 0.0;
    for (size_t i = 0; i <= 32; i++) {
        size_t face = face_at(&frame, 0, i);
        double sum = work->alpha[face] + work->alpha[FACE_ROOM + face] + work->alpha[2 * FACE_ROOM + face];
        most = fmax(most, fabs(work->u[face]));
        assert_true(fabs(sum - work->u[face]) <= 1e-14 * fabs(work->u[face]));
    }
    assert_true(most > 1.0);
    check_origin(work, &frame, model);
    face_free(work);
    flow_stop(&flow);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(test_sum)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
