/* Faces in thick liquids: the jump of pressure that is left beside a mixture, and what keeps all of it. */
#include "flow.h"

#include "scheme/viscous_face.h"

enum { FACES = 24, CELLS = FACES + 3, MIXED = 12 };

static uint64_t seed = 7;

/* Edges of FACES faces between water and water; in cell MIXED there is air, too. */
struct row {
    double cells[2 * CELLS], alpha[4 * FACES], rho_l[4 * FACES], rho[2 * FACES], rho_c2[2 * FACES], p[2 * FACES];
    double mask[FACES + 1], N[2 * FACES], part[FACES], mixed[CELLS];
};

static struct viscous_face fill(struct row *row, double per_h)
{
    *row = (struct row){0};
    for (int i = 0; i < CELLS; i++) row->cells[i] = 1.0;
    row->cells[MIXED + 1] = row->cells[CELLS + MIXED + 1] = 0.5;
    for (int i = 0; i < 2 * FACES; i++) {
        row->alpha[i] = 1.0;
        row->rho_l[i] = row->rho[i] = 1000.0;
        row->rho_l[2 * FACES + i] = 1.0;
        row->rho_c2[i] = 2.6e9;
        row->p[i] = 1e5 + 1e5 * flow_random(&seed);
    }
    return (struct viscous_face){.n = FACES,
                                 .right = FACES,
                                 .step = 1,
                                 .edges = 2 * FACES,
                                 .pitch = 2 * FACES,
                                 .room = CELLS,
                                 .per_h = per_h,
                                 .cells = row->cells + 1,
                                 .alpha = row->alpha,
                                 .rho_l = row->rho_l,
                                 .rho = row->rho,
                                 .rho_c2 = row->rho_c2,
                                 .N = row->N,
                                 .part = row->part,
                                 .mixed = row->mixed};
}

static void start(struct flow *flow, const char *water)
{
    flow_start(flow, mem_print("bulla: 1\ntitle: thick\ndomain: {lower: [0], upper: [1], cells: [32], boundaries: {x-: "
                               "periodic, x+: periodic}}\nmaterials:\n"
                               "  water: {eos: {type: stiffened-gas, gamma: 4.4, p-inf: 600 MPa, cv: 590}%s}\n"
                               "  air: {eos: {type: ideal-gas, gamma: 1.4, cv: 717.5}}\n"
                               "initial:\n  - {everywhere: true, material: water, density: 1000, pressure: 1e5}\n"
                               "run: {until: 1}\n",
                               water));
}

/* Faces MIXED - 2 ... MIXED + 1 have the mixture among their four cells. */
static bool is_near(int face)
{
    return face >= MIXED - 2 && face <= MIXED + 1;
}

/* What is left of the jump of all faces near the mixture: Z/(Z + N); the others and the mean stay. */
static double left(const struct flow *flow, struct row *row, const struct viscous_face *faces)
{
    struct row old = *row;
    double least = 1.0, most = 0.0;
    bool drawn = viscous_face_draw(flow->state->model, faces, row->p);
    for (int i = 0; i < FACES; i++) {
        double part = (row->p[FACES + i] - row->p[i]) / (old.p[FACES + i] - old.p[i]);
        if (!is_near(i)) assert_true(row->p[i] == old.p[i] && row->p[FACES + i] == old.p[FACES + i]);
        if (!is_near(i) || row->mask[i] + row->mask[i + 1] > 0.0) continue;
        assert_true(fabs(row->p[FACES + i] + row->p[i] - old.p[FACES + i] - old.p[i]) < 1e-9);
        least = fmin(least, part);
        most = fmax(most, part);
    }
    assert_true(most - least < 1e-12);
    assert_true(drawn == (least < 1.0));
    return least;
}

static double of_law(double mu, double per_h)
{
    double Z = sqrt(1000.0 * 2.6e9), N = VISCOUS_FACE_HOLD * 8.0 / 3.0 * mu * per_h;
    double share = fmin(fmax(N / (VISCOUS_FACE_THIN * Z) - 1.0, 0.0), 1.0);
    return 1.0 - share * N / (Z + N);
}

static void test_jump(void **state)
{
    (void)state;
    static const double per_h[] = {1e3, 1e4, 2e4, 1e5, 5e6};
    struct flow flow;
    struct row row;
    start(&flow, ", viscosity: 0.2");
    for (size_t k = 0; k < sizeof per_h / sizeof *per_h; k++) {
        const struct viscous_face faces = fill(&row, per_h[k]);
        double got = left(&flow, &row, &faces), want = of_law(0.2, per_h[k]);
        print_message("per h %g: %.6f of the jump\n", per_h[k], got);
        assert_true(fabs(got - want) < 1e-12);
    }
    assert_true(of_law(0.2, 1e3) == 1.0 && of_law(0.2, 5e6) < 0.2);
    flow_stop(&flow);
}

/* Vogel's law, 0.2 Pa s at the temperature of the row, is asked at the edges; one of the rate counts as nothing. */
static void test_laws(void **state)
{
    (void)state;
    struct flow flow;
    struct row row;
    start(&flow, ", viscosity: {type: vogel, amplitude: 0.2, temperature: 0, pole: 0}");
    struct viscous_face faces = fill(&row, 1e6);
    assert_true(fabs(left(&flow, &row, &faces) - of_law(0.2, 1e6)) < 1e-12);
    flow_stop(&flow);
    start(&flow, ", viscosity: {type: carreau, mu-0: 0.2, mu-infinity: 0.1, time: 1, index: 0.5}");
    faces = fill(&row, 1e6);
    assert_true(left(&flow, &row, &faces) == 1.0);
    flow_stop(&flow);
}

/* Troubled cells keep the jumps at their faces; a row without mixtures all of them; mirror images are mirror images. */
static void test_kept(void **state)
{
    (void)state;
    struct flow flow;
    struct row row, image;
    start(&flow, ", viscosity: 0.2");
    struct viscous_face faces = fill(&row, 1e6), back = fill(&image, 1e6);
    row.mask[MIXED] = 1.0;
    faces.mask = row.mask;
    double a = row.p[MIXED - 1], b = row.p[FACES + MIXED];
    assert_true(left(&flow, &row, &faces) < 0.5);
    assert_true(row.p[MIXED - 1] == a && row.p[FACES + MIXED] == b);
    for (int i = 0; i < CELLS; i++) row.cells[i] = 1.0;
    assert_false(viscous_face_draw(flow.state->model, &faces, row.p));
    faces = fill(&row, 1e6);
    for (int i = 0; i < 2 * FACES; i++) image.p[i] = row.p[2 * FACES - 1 - i];
    for (int i = 0; i < CELLS; i++) image.cells[i] = row.cells[CELLS - 1 - i];
    assert_true(viscous_face_draw(flow.state->model, &faces, row.p));
    assert_true(viscous_face_draw(flow.state->model, &back, image.p));
    for (int i = 0; i < 2 * FACES; i++) assert_true(image.p[i] == row.p[2 * FACES - 1 - i]);
    flow_stop(&flow);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(test_jump), cmocka_unit_test(test_laws),
                                       cmocka_unit_test(test_kept)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
