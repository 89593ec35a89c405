/* Surface tension in the plane, around an axis and in space: any interface of one curvature rests to round-off, the
 * curvature that the solver makes is of second order, a drop that is painted sharp rests nearly, has the jump of
 * pressure of its size and keeps mirrors to the bit, and tiles do not matter. */
#include "flow.h"

#include "solve/curve.h"

static const double SIGMA = 0.0728, RADIUS = 10e-6, P = 101325.0;

/* %1$d cells an axis. */
#define PLANE "{lower: [0, 0], upper: [20 um, 20 um], cells: [%1$d, %1$d], "
#define PLANE_WALLS "boundaries: {x-: symmetry, x+: reflecting, y-: symmetry, y+: reflecting}}"
#define AXIS "{geometry: axisymmetric, lower: [0, 0], upper: [20 um, 20 um], cells: [%1$d, %1$d], "
#define AXIS_WALLS "boundaries: {x-: axis, x+: reflecting, y-: symmetry, y+: reflecting}}"
#define SPACE "{lower: [0, 0, 0], upper: [20 um, 20 um, 20 um], cells: [%1$d, %1$d, %1$d], "
#define SPACE_WALLS \
    "boundaries: {x-: symmetry, x+: reflecting, y-: symmetry, y+: reflecting, z-: symmetry, z+: reflecting}}"

static const struct {
    const char *domain;
    int dim, turns; /* of a ball: kappa R */
    double off;     /* mean error of the curvature on 64 cells, in space 32 */
    double most;    /* velocity beside a drop [m/s] */
} ROOMS[] = {{PLANE PLANE_WALLS, 2, 1, 0.002, 0.004},
             {AXIS AXIS_WALLS, 2, 2, 0.005, 0.004},
             {SPACE SPACE_WALLS, 3, 2, 0.02, 0.004}};

static void start(struct flow *flow, const char *domain, int cells, int tile, const char *layer)
{
    char *where = mem_print(domain, cells);
    flow_start(flow,
               mem_print("bulla: 1\ntitle: tension\ndomain: %s\nmesh: {tile: %d}\nmaterials:\n" FLOW_WATER FLOW_AIR
                         "surface-tension: {water+air: 72.8 mN/m}\ninitial:\n"
                         "  - {everywhere: true, material: air, density: 1.2, pressure: 101325}\n"
                         "%srun: {until: 1}\n",
                         where, tile, layer));
    mem_free(where);
}

static double largest(const struct flow *flow)
{
    double most = 0.0;
    for (unsigned d = 0; d < flow->state->model->n_velocity; d++) {
        double *row = flow_primitive(flow, flow->state->model->i_u + d);
        for (size_t c = 0; c < flow->n_cell; c++) most = fmax(most, fabs(row[c]));
        mem_free(row);
    }
    return most;
}

/* Fractions of all kinds, and the pressure that balances them with kappa = 1/R everywhere. */
static void set_random(const struct model *model, const double x[3], double *w)
{
    uint64_t seed = (uint64_t)(x[0] * 1e9) * 1000003u + (uint64_t)(x[1] * 1e9) * 7919u + (uint64_t)(x[2] * 1e9);
    double part = 0.01 + 0.98 * flow_random(&seed);
    w[model->i_alpha] = part;
    w[model->i_alpha + 1] = 1.0 - part;
    w[model->i_m] = 998.2;
    w[model->i_m + 1] = 1.2;
    w[model->pairs[0].i_kappa] = 1.0 / RADIUS;
    w[model->i_E] = P + part * SIGMA / RADIUS;
}

/* A given curvature: without the pass that makes it, and behind walls there is the same. */
static void test_balance(void **state)
{
    (void)state;
    for (int i = 0; i < 3; i++) {
        struct flow flow;
        start(&flow, ROOMS[i].domain, ROOMS[i].dim == 3 ? 8 : 16, ROOMS[i].dim == 3 ? 4 : 8, "");
        curve_free(flow.state->work->curve);
        flow.state->work->curve = NULL;
        flow_set(&flow, set_random);
        double *before = flow_primitive(&flow, flow.state->model->i_E);
        flow_steps(&flow, 100);
        double *p = flow_primitive(&flow, flow.state->model->i_E), off = 0.0;
        for (size_t c = 0; c < flow.n_cell; c++) off = fmax(off, fabs(p[c] / before[c] - 1.0));
        print_message("%d: largest velocity %.3g m/s, pressure off by %.3g\n", i, largest(&flow), off);
        assert_true(largest(&flow) < 1e-8);
        assert_true(off < 1e-8);
        mem_free(before);
        mem_free(p);
        flow_stop(&flow);
    }
}

static double front(const double x[3])
{
    return 0.5 * (1.0 - tanh((sqrt(x[0] * x[0] + x[1] * x[1] + x[2] * x[2]) - RADIUS) / 1.5e-6));
}

static void set_front(const struct model *model, const double x[3], double *w)
{
    w[model->i_alpha] = front(x);
    w[model->i_alpha + 1] = 1.0 - w[model->i_alpha];
}

/* Radius of the sharp disc or ball that holds as much as one with a front of a given width. */
static double sharp_radius(int turns, double width)
{
    double variance = M_PI * M_PI / 12.0 * width * width;
    if (turns == 1) return sqrt(RADIUS * RADIUS + variance);
    return cbrt(RADIUS * RADIUS * RADIUS + 3.0 * RADIUS * variance);
}

/* Mean of |kappa R/turns - 1| over a front of one width, weighted as faces weigh: all its layers have the curvature of
 * the sharp surface. */
static double curvature_error(const char *domain, int cells, int turns)
{
    struct flow flow;
    double sum = 0.0, all = 0.0;
    start(&flow, domain, cells, 8, "");
    flow_set(&flow, set_front);
    curve_take(flow.state->work->curve, 0, flow_level(&flow)->w);
    double *kappa = flow_primitive(&flow, flow.state->model->pairs[0].i_kappa);
    for (size_t c = 0; c < flow.n_cell; c++) {
        double x[3];
        flow_centre(&flow, c, x);
        double a = front(x), weight = a * (1.0 - a);
        if (kappa[c] == 0.0) assert_true(weight < 2e-6);
        sum += weight * weight * fabs(kappa[c] * sharp_radius(turns, 1.5e-6) / turns - 1.0);
        all += weight * weight;
    }
    mem_free(kappa);
    flow_stop(&flow);
    return sum / all;
}

static void test_curvature(void **state)
{
    (void)state;
    for (int i = 0; i < 3; i++) {
        int cells = ROOMS[i].dim == 3 ? 32 : 64;
        double coarse = curvature_error(ROOMS[i].domain, cells, ROOMS[i].turns);
        double fine = curvature_error(ROOMS[i].domain, 2 * cells, ROOMS[i].turns), order = log2(coarse / fine);
        print_message("%d: error of the curvature %.2e, %.2e: order %.2f\n", i, coarse, fine, order);
        assert_true(fine < 0.005 && coarse < ROOMS[i].off);
    }
}

/* A flat surface in the middle of cells, with teeth of a fifth of a cell up and down from column to column. */
static void set_teeth(const struct model *model, const double x[3], double *w)
{
    double h = 20e-6 / 32, tooth = fmod(floor(x[0] / h), 2.0) > 0.0 ? 0.2 : -0.2;
    double height = 16.5 + tooth - (x[1] / h - 0.5);
    w[model->i_alpha] = height < 0.0 ? 0.0 : height > 1.0 ? 1.0 : height;
    w[model->i_alpha + 1] = 1.0 - w[model->i_alpha];
}

/* Teeth of one cell have no curvature but at walls, where they have mirrors: columns would see 0.8/h and drive them. */
static void test_teeth(void **state)
{
    (void)state;
    struct flow flow;
    double h = 20e-6 / 32, most = 0.0, wall = 0.0;
    start(&flow, ROOMS[0].domain, 32, 8, "");
    flow_set(&flow, set_teeth);
    curve_take(flow.state->work->curve, 0, flow_level(&flow)->w);
    double *kappa = flow_primitive(&flow, flow.state->model->pairs[0].i_kappa);
    for (size_t c = 0; c < flow.n_cell; c++) {
        double x[3];
        flow_centre(&flow, c, x);
        bool inside = x[0] > 2.0 * h && x[0] < 30.0 * h;
        most = inside ? fmax(most, fabs(kappa[c])) : most;
        wall = inside ? wall : fmax(wall, fabs(kappa[c]));
    }
    print_message("teeth: curvature %.2e/h, at walls %.2e/h\n", most * h, wall * h);
    assert_true(most * h < 1e-12 && wall * h > 0.05);
    mem_free(kappa);
    flow_stop(&flow);
}

/* A cap on the wall y- or y+, which its surface meets at a given angle: centre of the sphere along y, width of a front
 * [m]. The wall asks all layers of the front for this angle, concentric ones differ by width/R: so it is some cells
 * wide. */
static double cap_centre, cap_width;
static int cap_rows = 1; /* at the wall */

static double cap_radius(const double x[3])
{
    double y = x[1] - cap_centre;
    return sqrt(x[0] * x[0] + y * y + x[2] * x[2]);
}

static double cap_front(const double x[3])
{
    return 0.5 * (1.0 - tanh((cap_radius(x) - RADIUS) / cap_width));
}

static void set_cap(const struct model *model, const double x[3], double *w)
{
    w[model->i_alpha] = cap_front(x);
    w[model->i_alpha + 1] = 1.0 - w[model->i_alpha];
}

/* %1$d cells an axis, the wall below or above, %2$s its angle. */
#define CAP_WALLS \
    "boundaries: {x-: %3$s, x+: reflecting, %4$s: reflecting, %5$s: {type: no-slip, contact-angle: {%2$s}}"
static const struct {
    const char *domain;
    int dim, turns;
} CAPS[] = {{"{lower: [0, 0], upper: [20 um, 20 um], cells: [%1$d, %1$d], " CAP_WALLS "}}", 2, 1},
            {"{geometry: axisymmetric, lower: [0, 0], upper: [20 um, 20 um], cells: [%1$d, %1$d], " CAP_WALLS "}}", 2,
             2},
            {"{lower: [0, 0, 0], upper: [20 um, 20 um, 20 um], cells: [%1$d, %1$d, %1$d], " CAP_WALLS
             ", z-: symmetry, z+: reflecting}}",
             3, 2}};

/* kappa of the cap with a front of some cells; means of kappa R/turns - 1, of all cells and of cap_rows rows
 * at the wall. */
static double *cap_curvature(int i, int cells, int tile, const char *angle, bool above, double width, double *ret_all,
                             double *ret_row)
{
    struct flow flow;
    double sum[2] = {0.0}, all[2] = {0.0};
    char *domain =
        mem_print(CAPS[i].domain, cells, angle, i == 1 ? "axis" : "symmetry", above ? "y-" : "y+", above ? "y+" : "y-");
    cap_width = width * 20e-6 / cells;
    start(&flow, domain, cells, tile, "");
    flow_set(&flow, set_cap);
    curve_take(flow.state->work->curve, 0, flow_level(&flow)->w);
    double *kappa = flow_primitive(&flow, flow.state->model->pairs[0].i_kappa);
    for (size_t c = 0; c < flow.n_cell; c++) {
        double x[3];
        flow_centre(&flow, c, x);
        double weight = cap_front(x) * (1.0 - cap_front(x)),
               off = kappa[c] * sharp_radius(CAPS[i].turns, cap_width) / CAPS[i].turns - 1.0;
        bool wall = x[1] < cap_rows * 20e-6 / cells || x[1] > 20e-6 - cap_rows * 20e-6 / cells;
        for (int k = 0; k < (wall ? 2 : 1); k++) {
            sum[k] += weight * weight * off;
            all[k] += weight * weight;
        }
    }
    *ret_all = sum[0] / all[0];
    *ret_row = sum[1] / all[1];
    mem_free(domain);
    flow_stop(&flow);
    return kappa;
}

/* The curvature knows the angle of a wall. */
static void test_angle(void **state)
{
    static const struct {
        double degrees;
        const char *words;
    } ANGLES[] = {{45.0, "water+air: 45 deg"}, {60.0, "water+air: 60 deg"}, {120.0, "air+water: 60 deg"}};
    (void)state;
    for (int i = 0; i < 3; i++)
        for (int a = 0; a < 3; a++) {
            double all[2], row[2];
            int cells = CAPS[i].dim == 3 ? 32 : 64;
            cap_centre = -RADIUS * cos(ANGLES[a].degrees * M_PI / 180.0);
            for (int fine = 0; fine < 2; fine++)
                mem_free(cap_curvature(i, cells << fine, 8, ANGLES[a].words, false, 1.5, &all[fine], &row[fine]));
            print_message("%d: %g deg: error of the curvature %.2e, %.2e, at the wall %.2e, %.2e\n", i,
                          ANGLES[a].degrees, all[0], all[1], row[0], row[1]);
            assert_true(fabs(all[1]) < 0.02 && fabs(row[1]) < 0.3);
        }
}

/* Columns along the wall know its angle: of a front of a cell kappa is right also in the row at the wall, and better in
 * the mean of four. */
static void test_angle_columns(void **state)
{
    (void)state;
    for (int i = 0; i < 3; i++)
        for (int a = 0; a < 2; a++) {
            double all, row[2];
            int cells = CAPS[i].dim == 3 ? 32 : 64;
            const char *angle = a ? "air+water: 60 deg" : "water+air: 60 deg";
            cap_centre = a ? 0.5 * RADIUS : -0.5 * RADIUS;
            for (int k = 0; k < 2; k++) {
                cap_rows = k ? 4 : 1;
                mem_free(cap_curvature(i, cells, 8, angle, false, 0.9, &all, &row[k]));
            }
            cap_rows = 1;
            print_message("%d: columns at %d deg: %.2e, at the wall %.2e, four rows %.2e\n", i, a ? 120 : 60, all,
                          row[0], row[1]);
            assert_true(fabs(all) < 0.007 && fabs(row[0]) < 0.04 && fabs(row[1]) < 0.012);
        }
}

/* A wall above is one below, to the bit, and tiles do not matter. */
static void test_angle_mirror(void **state)
{
    (void)state;
    for (int i = 0; i < 3; i++) {
        double all, row;
        size_t n = CAPS[i].dim == 3 ? 16 : 32;
        cap_centre = -5e-6;
        double *below = cap_curvature(i, (int)n, 4, "water+air: 60 deg", false, 1.5, &all, &row);
        double *other = cap_curvature(i, (int)n, 8, "water+air: 60 deg", false, 1.5, &all, &row);
        cap_centre = 25e-6;
        double *above = cap_curvature(i, (int)n, 8, "water+air: 60 deg", true, 1.5, &all, &row);
        for (size_t c = 0; c < (CAPS[i].dim == 3 ? n * n * n : n * n); c++) {
            size_t j = c / n % n, up = c + (n - 1 - j) * n - j * n;
            assert_true(below[c] == other[c]);
            assert_true(fabs(below[c] - above[up]) <= 1e-9 * fabs(below[c]));
        }
        mem_free(below);
        mem_free(other);
        mem_free(above);
    }
}

#define DROP                                                                                                     \
    "  - {sphere: {center: [0, 0, 0], radius: 10 um}, material: water, density: 997, pressure: 1 atm, balance: " \
    "tension}\n"
#define DROP2                                                                                                 \
    "  - {sphere: {center: [0, 0], radius: 10 um}, material: water, density: 997, pressure: 1 atm, balance: " \
    "tension}\n"

/* A drop of 8 cells per radius with a staircase for a surface. */
static void test_drop(void **state)
{
    (void)state;
    for (int i = 0; i < 3; i++) {
        struct flow flow;
        start(&flow, ROOMS[i].domain, 16, 8, ROOMS[i].dim == 3 ? DROP : DROP2);
        double *p = flow_primitive(&flow, flow.state->model->i_E), jump = p[0] - p[flow.n_cell - 1];
        assert_true(fabs(jump / (ROOMS[i].turns * SIGMA / RADIUS) - 1.0) < 1e-9);
        mem_free(p);
        flow_steps(&flow, ROOMS[i].dim == 3 ? 30 : 200);
        print_message("%d: largest velocity %.3g m/s\n", i, largest(&flow));
        assert_true(largest(&flow) > 1e-6 && largest(&flow) < ROOMS[i].most);
        flow_stop(&flow);
    }
}

/* A disc between walls keeps both mirrors to the bit. */
static void test_mirrors(void **state)
{
    (void)state;
    struct flow flow;
    start(&flow,
          "{lower: [-20 um, -20 um], upper: [20 um, 20 um], cells: [%1$d, %1$d], boundaries: {x-: reflecting, x+: "
          "reflecting, y-: reflecting, y+: reflecting}}",
          32, 8, DROP2);
    flow_steps(&flow, 100);
    unsigned i_u = flow.state->model->i_u;
    double *u = flow_conserved(&flow, i_u), *v = flow_conserved(&flow, i_u + 1);
    double *E = flow_conserved(&flow, flow.state->model->i_E);
    for (size_t j = 0; j < 32; j++)
        for (size_t i = 0; i < 32; i++) {
            size_t here = 32 * j + i, left = 32 * j + 31 - i, below = 32 * (31 - j) + i;
            assert_true(E[here] == E[left] && E[here] == E[below]);
            assert_true(u[here] == -u[left] && u[here] == u[below] && v[here] == v[left] && v[here] == -v[below]);
        }
    mem_free(u);
    mem_free(v);
    mem_free(E);
    flow_stop(&flow);
}

/* A front of some cells across (0.6, 0.8), that lies on a wave of eight cells along (0.8, -0.6), and is wider and
 * thinner along it by so much. */
static double slope_width, slope_vary, slope_cell;

static void slope_place(const double x[3], double *ret_along, double *ret_across)
{
    double X = (x[0] - 10e-6) / slope_cell, Y = (x[1] - 10e-6) / slope_cell;
    *ret_along = (0.8 * X - 0.6 * Y) * M_PI / 4.0;
    *ret_across = 0.6 * X + 0.8 * Y - 0.02 * cos(*ret_along);
}

static void set_slope(const struct model *model, const double x[3], double *w)
{
    double along, across;
    slope_place(x, &along, &across);
    w[model->i_alpha] = 0.5 * (1.0 - tanh(across / (slope_width * (1.0 + slope_vary * cos(1.5 * along)))));
    w[model->i_alpha + 1] = 1.0 - w[model->i_alpha];
}

/* kappa of a wave of the surface, in its front: how far it lies along the surface beside the wave [radians], one way
 * before the surface, the other way behind it. */
static double slope_shift(double width, double vary)
{
    struct flow flow;
    double part[2] = {0.0};
    int cells = 64;
    slope_cell = 20e-6 / cells;
    slope_width = width;
    slope_vary = vary;
    start(&flow, PLANE PLANE_WALLS, cells, 8, "");
    flow_set(&flow, set_slope);
    curve_take(flow.state->work->curve, 0, flow_level(&flow)->w);
    double *kappa = flow_primitive(&flow, flow.state->model->pairs[0].i_kappa);
    for (size_t c = 0; c < flow.n_cell; c++) {
        double x[3], along, across, w[16];
        flow_centre(&flow, c, x);
        slope_place(x, &along, &across);
        if (fabs(along) > 4.0 * M_PI || fabs(across) > 2.0) continue;
        set_slope(flow.state->model, x, w);
        double front = w[flow.state->model->i_alpha] * w[flow.state->model->i_alpha + 1];
        part[0] += front * kappa[c] * cos(along);
        part[1] += front * kappa[c] * sin(along) * (across > 0.0 ? 1.0 : -1.0);
    }
    mem_free(kappa);
    flow_stop(&flow);
    return part[1] / part[0];
}

/* A column through a cell off the surface crosses it beside that cell's foot: kappa of a wide front would be shifted,
 * and feed its waves. Where a front is thin in places, its columns must not speak for the cells around. */
static void test_foot(void **state)
{
    (void)state;
    double thin = slope_shift(0.6, 0.0), wide = slope_shift(1.0, 0.0), varies = slope_shift(0.95, 0.15);
    print_message("foot: shift of a thin front %.3f, of a wide one %.3f, of one that varies %.3f\n", thin, wide,
                  varies);
    assert_true(fabs(wide) < 0.04 && fabs(varies) < 0.04);
}

#define OVAL \
    "  - {ellipsoid: {center: [0, 0], semi-axes: [12 um, 8 um]}, material: water, density: 997, pressure: 1.1 atm}\n"

/* The same bits on tiles of any size. */
static void test_tiles(void **state)
{
    (void)state;
    for (int i = 0; i < 2; i++) {
        struct flow one, many;
        start(&one, ROOMS[i].domain, 32, 16, OVAL);
        start(&many, ROOMS[i].domain, 32, 4, OVAL);
        flow_steps(&one, 40);
        flow_steps(&many, 40);
        assert_true(largest(&one) > 1e-3);
        for (unsigned q = 0; q < one.state->model->pairs[0].i_kappa; q++) {
            double *a = flow_conserved(&one, q), *b = flow_conserved(&many, q);
            assert_memory_equal(a, b, one.n_cell * sizeof *a);
            mem_free(a);
            mem_free(b);
        }
        flow_stop(&one);
        flow_stop(&many);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_balance),      cmocka_unit_test(test_curvature),     cmocka_unit_test(test_drop),
        cmocka_unit_test(test_mirrors),      cmocka_unit_test(test_tiles),         cmocka_unit_test(test_angle),
        cmocka_unit_test(test_angle_mirror), cmocka_unit_test(test_angle_columns), cmocka_unit_test(test_teeth),
        cmocka_unit_test(test_foot),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
