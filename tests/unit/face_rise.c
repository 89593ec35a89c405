/* Cells of a frame may hold forces: what several terms say of them adds up. Where none is held pressure has the edges
 * that it has where forces of zero are, to the bit and by any scheme: tiles on both sides of a face find the same. */
#include "flow.h"

static void set_waves(const struct model *model, const double x[3], double *w)
{
    w[model->i_E] = 1e5 * (1.0 + 0.2 * sin(6.0 * M_PI * x[0]));
}

static void rise_begin(struct flow *flow, const char *scheme)
{
    flow_start(flow,
               mem_print("bulla: 1\ntitle: forces\ndomain: {lower: [0], upper: [1], cells: [32], boundaries: {x-: "
                         "periodic, x+: periodic}}\nmesh: {tile: 32}\nmaterials:\n" FLOW_AIR
                         "initial:\n  - {everywhere: true, material: air, density: 1.2, pressure: 1e5}\nsources: "
                         "{acceleration: [-9.81]}\n"
                         "scheme: {reconstruction: %s}\nrun: {until: 1}\n",
                         scheme));
    flow_set(flow, set_waves);
}

static void test_sum(void **state)
{
    (void)state;
    struct flow flow;
    rise_begin(&flow, "muscl");
    struct face_work *work = face_new(flow.state->model);
    struct frame frame = frame_piece(flow.state->mesh, 0, 0);
    double below[FACE_ROOM], above[FACE_ROOM];
    for (size_t i = 0; i < frame.count; i++) below[i] = (double)i, above[i] = 100.0 + (double)i;
    for (int again = 0; again < 2; again++) { /* a frame knows nothing of the one before */
        face_begin(work, &frame);
        face_rise(work, &frame, below, above);
        face_rise(work, &frame, above, above);
        for (size_t i = 0; i < frame.count; i++) {
            assert_true(work->rise[0][i] == 100.0 + 2.0 * (double)i);
            assert_true(work->rise[1][i] == 200.0 + 2.0 * (double)i);
        }
    }
    face_free(work);
    flow_stop(&flow);
}

/* Edges of a smooth wave lie between the cells, upper ones towards the next. */
static void check_between(const double *p, const double *upper, size_t n)
{
    const double *lower = upper + n;
    for (size_t i = 1; i + 1 < n; i++) {
        assert_true((upper[i] - p[i]) * (p[i + 1] - p[i]) >= 0.0);
        assert_true((lower[i] - p[i]) * (p[i - 1] - p[i]) >= 0.0);
    }
}

static void check_rest(const char *scheme)
{
    static const double zero[FACE_ROOM];
    struct flow flow;
    rise_begin(&flow, scheme);
    const struct model *model = flow.state->model;
    const struct frame_source source = flow_source(&flow);
    struct face_work *work = face_new(model);
    struct frame frame = frame_piece(flow.state->mesh, 0, 0);
    frame_gather(&source, 0, &frame, FACE_ROOM, work->frame);
    double held[2 * FACE_ROOM];
    size_t n = 2 * frame_edged(&frame);
    face_begin(work, &frame);
    face_rise(work, &frame, zero, zero);
    memcpy(held, face_edges(work, &frame, false) + 2 * model->i_E * FACE_ROOM, n * sizeof *held);
    face_begin(work, &frame);
    const double *plain = face_edges(work, &frame, false) + 2 * model->i_E * FACE_ROOM;
    assert_memory_equal(held, plain, n * sizeof *held);
    check_between(work->frame + model->i_E * FACE_ROOM + frame_reach(&frame), plain, n / 2);
    face_free(work);
    flow_stop(&flow);
}

static void test_rest(void **state)
{
    (void)state;
    check_rest("muscl");
    check_rest("muscl, limiter: koren");
    check_rest("weno5-z");
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(test_sum), cmocka_unit_test(test_rest)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
