/* After a step, what lies under finer tiles is their average, and its primitives are those of that average: also deep
 * under them, where no coarse-fine face is near. */
#include "amr.h"

/* Largest difference of a primitive of covered cells from that of their conserved fields, relative to the largest
 * value. */
static double stale(const struct flow *flow, unsigned q, long *ret_tiles)
{
    const struct model *model = flow->state->model;
    const struct mesh *mesh = flow->state->mesh;
    size_t n = mesh->n_cell;
    double *w = mem_new(model->n_field * n, sizeof *w), worst = 0.0, size = 0.0;
    for (int l = 0; l + 1 < mesh->n_level; l++)
        for (unsigned t = 0; t < mesh->levels[l].n_tile; t++) {
            if (!mesh->levels[l].tiles[t].covered) continue;
            memcpy(w, mesh->levels[l].w[t], model->n_field * n * sizeof *w);
            mix_primitives(model, n, n, mesh->levels[l].u_old[t], w);
            for (size_t c = 0; c < n; c++) {
                worst = fmax(worst, fabs(w[q * n + c] - mesh->levels[l].w[t][q * n + c]));
                size = fmax(size, fabs(w[q * n + c]));
            }
            ++*ret_tiles;
        }
    mem_free(w);
    return worst / size;
}

static void set_waves(const struct model *model, const double x[3], double *w)
{
    double wave = sin(2.0 * M_PI * x[0]) * (x[1] == 0.0 ? 1.0 : cos(2.0 * M_PI * x[1]));
    w[model->i_m] = 1.0 + 0.3 * wave;
    w[model->i_E] = 1e5 * (1.0 + 0.4 * wave);
    w[model->i_u] = 100.0 * wave;
}

static void check_renewed(const char *domain, const char *region)
{
    struct flow flow;
    flow_start(&flow,
               mem_print("bulla: 1\ntitle: renewed\ndomain: %s\nmesh: {levels: 2, tile: 8, regrid-every: 100, refine: "
                         "[{region: %s}]}\nmaterials:\n" FLOW_AIR
                         "initial:\n  - {everywhere: true, material: air, density: 1, pressure: 1e5}\n"
                         "run: {until: 1}\n",
                         domain, region));
    const struct model *model = flow.state->model;
    amr_set(&flow, set_waves, NULL);
    flow_steps(&flow, 3);
    for (unsigned q = 0; q < model->n_field; q++) {
        long tiles = 0;
        double off = stale(&flow, q, &tiles);
        print_message("%s: off by %.1e in %ld tiles\n", model->field_names[q], off, tiles);
        assert_true(tiles > 3 && off <= 1e-14);
    }
    flow_stop(&flow);
}

static void test_renewed(void **state)
{
    (void)state;
    check_renewed("{lower: [0], upper: [1], cells: [128], boundaries: {x-: periodic, x+: periodic}}",
                  "{box: {lower: [0.2], upper: [0.8]}}");
    check_renewed(
        "{lower: [0, 0], upper: [1, 1], cells: [40, 40], boundaries: {x-: periodic, x+: periodic, y-: periodic, "
        "y+: periodic}}",
        "{box: {lower: [0.2, 0.2], upper: [0.8, 0.8]}}");
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(test_renewed)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
