/* Curvature of surfaces against 1/R of circles and 2/R of spheres: how fast it converges, in the plane, around an
 * axis, in space and along a radius; across faces between levels and behind symmetry planes; and 0 where there is no
 * surface. */
#include "prolong_levels.h"

enum { AIR = 1 };

/* A bubble whose front is a tanh of `width`. */
static struct {
    double centre[3], radius, width;
    bool drop; /* of water in air */
} ball;

static double distance(const double x[3])
{
    double sum = 0.0;
    for (int d = 0; d < 3; d++) sum += (x[d] - ball.centre[d]) * (x[d] - ball.centre[d]);
    return sqrt(sum);
}

static void set_ball(const struct model *model, const double x[3], double *w)
{
    double inside = 0.5 * (1.0 - tanh((distance(x) - ball.radius) / ball.width));
    w[model->i_alpha + AIR] = ball.drop ? 1.0 - inside : inside;
    w[model->i_alpha] = 1.0 - w[model->i_alpha + AIR];
}

struct room {
    const char *domain; /* of %d cells an axis */
    double centre[3];
    int power; /* of 1/R: 1 in a plane, 2 in space */
    int cells[3];
    double order; /* least, from the second pair to the third */
};

#define OPEN2 "boundaries: {x-: outflow, x+: outflow, y-: outflow, y+: outflow}"
#define OPEN3 "boundaries: {x-: outflow, x+: outflow, y-: outflow, y+: outflow, z-: outflow, z+: outflow}"

static const struct room ROOMS[] = {
    {"{lower: [0, 0], upper: [1, 1], cells: [%1$d, %1$d], " OPEN2 "}", {0.513, 0.487}, 1, {32, 64, 128}, 1.8},
    {"{geometry: axisymmetric, lower: [0, 0], upper: [1, 1], cells: [%1$d, %1$d], boundaries: {x-: axis, x+: outflow, "
     "y-: outflow, y+: outflow}}",
     {0.0, 0.487},
     2,
     {32, 64, 128},
     1.8},
    {"{lower: [0, 0, 0], upper: [1, 1, 1], cells: [%1$d, %1$d, %1$d], " OPEN3 "}",
     {0.513, 0.487, 0.505},
     2,
     {16, 32, 64},
     1.7},
    {"{geometry: spherical, lower: [0], upper: [1], cells: [%1$d], boundaries: {x-: axis, x+: outflow}}",
     {0.0},
     2,
     {32, 64, 128},
     1.8},
};

static void start(struct flow *flow, const char *domain, int cells, int tile)
{
    char *where = mem_print(domain, cells);
    flow_start(flow,
               mem_print("bulla: 1\ntitle: curvature\ndomain: %s\nmesh: {tile: %d}\nmaterials:\n" FLOW_WATER FLOW_AIR
                         "initial:\n  - {everywhere: true, material: water, density: 1000, pressure: 1e5}\n"
                         "run: {until: 1}\n",
                         where, tile));
    mem_free(where);
}

/* Errors of r kappa / power - 1, r the distance of the cell: mean with the weight a (1 - a), and largest. */
struct error {
    double mean, most, weight;
};

/* Where a is far from both ends; kappa is 0 farther from the surface than the front and four cells are wide. */
static void add_error(struct error *error, double a, double kappa, const double x[3], int power, double h)
{
    double r = distance(x), off = fabs(kappa * r / power - (ball.drop ? -1.0 : 1.0));
    if (fabs(r - ball.radius) > 3.5 * ball.width + 4.0 * h) assert_true(kappa == 0.0);
    if (a < 1e-2 || a > 1.0 - 1e-2) return;
    error->mean += a * (1.0 - a) * off;
    error->weight += a * (1.0 - a);
    error->most = fmax(error->most, off);
}

static struct error measure(const struct flow *flow, int power)
{
    double *kappa = flow_derived(flow, "curvature_air", 0), *other = flow_derived(flow, "curvature_water", 0);
    double *a = flow_primitive(flow, AIR);
    struct error error = {0};
    for (size_t c = 0; c < flow->n_cell; c++) {
        double x[3];
        flow_centre(flow, c, x);
        add_error(&error, a[c], kappa[c], x, power, flow_level(flow)->h[0]);
        if (kappa[c] != 0.0 && other[c] != 0.0) assert_true(fabs(other[c] / kappa[c] + 1.0) < 1e-9);
    }
    mem_free(kappa);
    mem_free(other);
    mem_free(a);
    error.mean /= error.weight;
    return error;
}

static void circles_and_spheres(void **state)
{
    (void)state;
    for (size_t i = 0; i < sizeof ROOMS / sizeof *ROOMS; i++) {
        const struct room *room = &ROOMS[i];
        double last = 0.0, order = 0.0;
        for (int k = 0; k < 3; k++) {
            struct flow flow;
            memcpy(ball.centre, room->centre, sizeof ball.centre);
            ball.radius = 0.25;
            ball.width = 0.03;
            ball.drop = k == 1;
            start(&flow, room->domain, room->cells[k], 8);
            flow_set(&flow, set_ball);
            struct error error = measure(&flow, room->power);
            order = k ? log2(last / error.mean) : 0.0;
            last = error.mean;
            print_message("%zu: %d cells: mean %.2e, most %.2e, order %.2f\n", i, room->cells[k], error.mean,
                          error.most, order);
            assert_true(error.most < (k == 0 ? 0.2 : k == 1 ? 0.05 : 0.01));
            flow_stop(&flow);
        }
        if (order < room->order) fail_msg("order %g", order);
    }
    ball.drop = false;
}

/* Fronts of so many cells do not converge, but are good to some per cent. */
static void fronts_of_cells(void **state)
{
    (void)state;
    static const double most[] = {0.4, 0.1, 0.02};
    for (int k = 0; k < 3; k++) {
        struct flow flow;
        memcpy(ball.centre, ROOMS[0].centre, sizeof ball.centre);
        ball.radius = 0.25;
        ball.width = 0.5 * (k + 1) / 64.0;
        start(&flow, ROOMS[0].domain, 64, 8);
        flow_set(&flow, set_ball);
        struct error error = measure(&flow, 1);
        print_message("tanh of %g cells: mean %.2e, most %.2e\n", 0.5 * (k + 1), error.mean, error.most);
        assert_true(error.mean < 0.3 * most[k] && error.most < most[k]);
        flow_stop(&flow);
    }
}

/* A quarter between planes of symmetry is the quarter of the whole, to the bit, also where both planes meet. */
static void quarters(void **state)
{
    (void)state;
    struct flow whole, quarter;
    ball.radius = 0.02;
    ball.width = 0.05;
    memset(ball.centre, 0, sizeof ball.centre);
    start(&whole, "{lower: [-1, -1], upper: [1, 1], cells: [%1$d, %1$d], " OPEN2 "}", 64, 8);
    start(&quarter,
          "{lower: [0, 0], upper: [1, 1], cells: [%1$d, %1$d], boundaries: {x-: symmetry, x+: outflow, y-: reflecting, "
          "y+: outflow}}",
          32, 8);
    flow_set(&whole, set_ball);
    flow_set(&quarter, set_ball);
    double *all = flow_derived(&whole, "curvature_air", 0), *part = flow_derived(&quarter, "curvature_air", 0);
    for (size_t j = 0; j < 32; j++)
        for (size_t i = 0; i < 32; i++) {
            assert_true(part[32 * j + i] == all[64 * (j + 32) + i + 32]);
            assert_true(part[32 * j + i] == part[32 * i + j]);
            assert_true(all[64 * j + i] == all[64 * (63 - j) + 63 - i]);
        }
    assert_true(part[0] > 5.0);
    mem_free(all);
    mem_free(part);
    flow_stop(&whole);
    flow_stop(&quarter);
}

static bool in_steps(const int at[3])
{
    return (at[0] + at[1]) / 2 % 3 == 1;
}

static void set_level(const struct twolevel *two, const struct level *level)
{
    const struct mesh *mesh = two->mesh;
    for (unsigned t = 0; t < level->n_local; t++)
        for (size_t c = 0; c < mesh->n_cell; c++) {
            double x[3], w[FLOW_FIELDS];
            int at[3];
            twolevel_at(mesh, &level->tiles[t], c, at);
            for (int d = 0; d < 3; d++) x[d] = d < mesh->dim ? mesh->lower[d] + (at[d] + 0.5) * level->h[d] : 0.0;
            set_ball(two->model, x, w);
            for (unsigned l = 0; l < 2; l++) level->w[t][l * mesh->n_cell + c] = w[l];
        }
}

/* Does all that the curvature of the cell at `at` of level 1 is made from lie on that level? Two cells all around. */
static bool is_inside(const struct twolevel *two, const int at[3])
{
    for (int step = 0; step < 27; step++) {
        int there[3] = {0}, steps[3] = {step % 3 - 1, step / 3 % 3 - 1, step / 9 - 1};
        for (int d = 0; d < two->mesh->dim; d++) there[d] = (at[d] + 2 * steps[d]) / two->mesh->n[d];
        if (mesh_find(two->mesh, two->fine, there) < 0) return false;
    }
    return true;
}

/* Errors of leaves of a level: beside a coarser level, and elsewhere. */
static void measure_level(const struct twolevel *two, const struct derive *field, int l, struct error error[2])
{
    const struct mesh *mesh = two->mesh;
    const struct level *level = &mesh->levels[l];
    double *out = mem_new(2 * mesh->n_cell, sizeof *out), *leaf = out + mesh->n_cell;
    for (unsigned t = 0; t < level->n_local; t++) {
        mesh_leaves(mesh, &level->tiles[t], leaf);
        derive_tile(two->model, mesh, l, t, 0.0, field, out);
        for (size_t c = 0; c < mesh->n_cell; c++) {
            double x[3];
            int at[3];
            twolevel_at(mesh, &level->tiles[t], c, at);
            for (int d = 0; d < 3; d++) x[d] = d < mesh->dim ? (at[d] + 0.5) * level->h[d] : 0.0;
            bool beside = l > 0 && !is_inside(two, at);
            if (leaf[c] > 0.0)
                add_error(&error[!beside], level->w[t][AIR * mesh->n_cell + c], out[c], x, mesh->dim - 1, level->h[0]);
        }
    }
    mem_free(out);
}

/* A staircase of fine tiles across the surface. Cells that see their own level alone are as good as anywhere. Beside a
 * coarser one ghosts are linear, and a second derivative of what is linear says little; but it is bounded. */
static void levels_and_corners(void **state)
{
    (void)state;
    for (int dim = 2; dim <= 3; dim++) {
        struct twolevel two;
        struct derive field;
        struct error error[2] = {{0}};
        for (int d = 0; d < dim; d++) ball.centre[d] = 0.97 + 0.02 * d;
        ball.radius = 0.55;
        ball.width = 0.08;
        twolevel_start(&two, twolevel_case(dim, "cartesian", FLOW_WATER FLOW_AIR), NULL, in_steps);
        assert_int_equal(derive_find(two.model, "curvature_air", &field), 0);
        assert_string_equal(field.unit, "1/m");
        set_level(&two, two.coarse);
        set_level(&two, two.fine);
        struct derive_moment moment = derive_moment(two.model, two.mesh, 0.0);
        derive_prepare(&moment, &field);
        for (int l = 0; l < 2; l++) measure_level(&two, &field, l, error);
        for (int i = 0; i < 2; i++)
            print_message("%dD, %s: mean %.2e, most %.2e\n", dim, i ? "elsewhere" : "beside a coarser level",
                          error[i].mean / error[i].weight, error[i].most);
        assert_true(error[0].weight > 10.0 && error[0].mean / error[0].weight < 1.0);
        assert_true(error[1].weight > 10.0 && error[1].mean / error[1].weight < 0.02 && error[1].most < 0.1);
        twolevel_stop(&two);
        memset(ball.centre, 0, sizeof ball.centre);
    }
}

static void set_mixture(const struct model *model, const double x[3], double *w)
{
    w[model->i_alpha + AIR] = x[0] < 0.5 ? 0.3 : 0.3 + 1e-5 * sin(40.0 * x[1]);
    w[model->i_alpha] = 1.0 - w[model->i_alpha + AIR];
}

/* Uniform mixtures, and flat fronts along a line. */
static void no_surface(void **state)
{
    (void)state;
    struct flow flow;
    start(&flow, ROOMS[0].domain, 16, 8);
    flow_set(&flow, set_mixture);
    double *kappa = flow_derived(&flow, "curvature_air", 0);
    for (size_t c = 0; c < flow.n_cell; c++) assert_true(kappa[c] == 0.0);
    mem_free(kappa);
    flow_stop(&flow);
    ball.radius = 0.5;
    ball.width = 0.04;
    start(&flow, "{lower: [0], upper: [1], cells: [%d], boundaries: {x-: outflow, x+: outflow}}", 32, 8);
    flow_set(&flow, set_ball);
    kappa = flow_derived(&flow, "curvature_air", 0);
    for (size_t c = 0; c < flow.n_cell; c++) assert_true(kappa[c] == 0.0);
    mem_free(kappa);
    flow_stop(&flow);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(circles_and_spheres), cmocka_unit_test(fronts_of_cells), cmocka_unit_test(quarters),
        cmocka_unit_test(levels_and_corners),  cmocka_unit_test(no_surface),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
