/* Ghosts behind a coarse-fine face between the beginning and the end of the coarse step: fractions, velocities and
 * pressure are linear in time, densities such that alpha rho is; a density that nobody has at one end does not
 * matter. */
#include "amr.h"

static double at(const struct link_face *face, const struct link *link, const struct model *model, int end, unsigned q,
                 size_t i)
{
    return face->strip[end][q * (link->strip_doubles / model->n_field) + i];
}

/* What the strip says at time theta. */
static double wanted(const struct link_face *face, const struct link *link, const struct model *model, unsigned q,
                     size_t i)
{
    double a = at(face, link, model, 0, q, i), b = at(face, link, model, 1, q, i), late = link->theta;
    if (q < model->i_m || q >= model->i_u) return a + late * (b - a);
    double begin = (1.0 - late) * at(face, link, model, 0, q - model->n_alpha, i);
    double end = late * at(face, link, model, 1, q - model->n_alpha, i);
    return begin + end > 0.0 ? (begin * a + end * b) / (begin + end) : a + late * (b - a);
}

static void fill(const struct link *link, const struct model *model)
{
    uint64_t seed = 9;
    size_t n = link->strip_doubles / model->n_field;
    for (unsigned f = 0; f < link->n_face; f++)
        for (int end = 0; end < 2; end++)
            for (size_t i = 0; i < n; i++) {
                double *strip = link->faces[f].strip[end] + i, pure = flow_random(&seed), alpha = flow_random(&seed);
                alpha = pure < 0.2 ? 0.0 : pure < 0.4 ? 1.0 : alpha;
                for (unsigned q = 0; q < model->n_field; q++) strip[q * n] = 1.0 + 100.0 * flow_random(&seed);
                strip[0] = alpha;
                strip[n] = 1.0 - alpha;
            }
}

static void test_blend(void **state)
{
    (void)state;
    struct flow flow;
    flow_start(
        &flow,
        mem_print("bulla: 1\ntitle: blend\ndomain: {lower: [0, 0], upper: [1, 1], cells: [32, 32], boundaries: "
                  "{x-: periodic, x+: periodic, y-: periodic, y+: periodic}}\nmesh: {levels: 1, tile: 8, "
                  "refine: [{region: {box: {lower: [0.4, 0.4], upper: [0.6, 0.6]}}}]}\nmaterials:\n" FLOW_WATER FLOW_AIR
                  "initial:\n  - {everywhere: true, material: water, density: 1000, pressure: "
                  "1e5}\nrun: {until: 1}\n"));
    const struct model *model = flow.state->model;
    const struct level *fine = &flow.state->mesh->levels[1];
    struct link *link = fine->link;
    const struct frame_source source = {.mesh = flow.state->mesh,
                                        .level = fine,
                                        .arrays = fine->w,
                                        .halo = fine->halo,
                                        .link = link,
                                        .n_field = model->n_field,
                                        .boundary = bound_fill,
                                        .data = flow.state->stages[1]->bound};
    double *w = mem_new((size_t)model->n_field * FRAME_CELLS, sizeof *w);
    long checked = 0;
    fill(link, model);
    for (int part = 0; part <= 4; part++)
        for (unsigned t = 0; t < fine->n_local; t++)
            for (int face = 0; face < 4; face++) {
                const struct neighbour *neighbour = &fine->neighbours[t][face];
                if (neighbour->kind != NEIGHBOUR_COARSE) continue;
                struct frame frame = frame_piece(source.mesh, face / 2, 0);
                link->theta = 0.25 * part;
                frame_gather(&source, t, &frame, FRAME_CELLS, w);
                for (unsigned q = 0; q < model->n_field; q++)
                    for (size_t o = 0; o < frame.outer; o++)
                        for (int row = 0; row < (int)frame.ghosts; row++)
                            for (size_t i = 0; i < frame.inner; i++) {
                                int to = face % 2 ? (int)frame.n + row : row - (int)frame.ghosts;
                                double got = w[q * FRAME_CELLS + frame_at(&frame, o, to) + i];
                                double value = wanted(&link->faces[neighbour->index], link, model, q,
                                                      (o * frame.ghosts + (size_t)row) * frame.tile_inner + i);
                                assert_true(fabs(got - value) <= 1e-12 * fabs(value));
                                checked++;
                            }
            }
    print_message("%ld values\n", checked);
    assert_true(checked > 1000);
    mem_free(w);
    flow_stop(&flow);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(test_blend)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
