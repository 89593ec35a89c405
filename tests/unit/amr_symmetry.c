/* Symmetry with refinement: an explosion in a box keeps symmetric sets of tiles and, to the bit, symmetric states: all
 * eight images in 2D (x and y change places too), the three mirrors in 3D, both halves in 1D. */
#include "amr.h"

#include "phys/elastic.h"

struct setup {
    const char *name, *lower, *upper, *cells, *sides, *levels;
    int dim, steps;
};

static const struct setup SETUPS[] = {
    {"line", "[-1]", "[1]", "[64]", "{x-: reflecting, x+: reflecting}", "levels: 3, tile: 8", 1, 100},
    {"plane", "[-1, -1]", "[1, 1]", "[32, 32]", "{x-: outflow, x+: outflow, y-: outflow, y+: outflow}",
     "levels: 2, tile: 8", 2, 40},
    {"odd plane", "[-1, -1]", "[1, 1]", "[24, 24]", "{x-: periodic, x+: periodic, y-: periodic, y+: periodic}",
     "levels: 2, tile: 8", 2, 30},
    {"space", "[-1, -1, -1]", "[1, 1, 1]", "[16, 16, 16]",
     "{x-: outflow, x+: outflow, y-: reflecting, y+: reflecting, z-: non-reflecting, z+: non-reflecting}",
     "levels: 1, tile: 4", 3, 20},
};

static const char *const CENTRES[] = {"[0]", "[0, 0]", "[0, 0, 0]"};

static void start(struct flow *flow, const struct setup *setup, const char *materials, const char *inside)
{
    flow_start(flow, mem_print("bulla: 1\ntitle: explosion\ndomain: {lower: %s, upper: %s, cells: %s, boundaries: %s}\n"
                               "mesh: {%s, regrid-every: 2, buffer: 2, patience: 1, refine: [{interface: air}, "
                               "{jump: pressure, above: 0.9, finest: 1}]}\n"
                               "materials:\n%sinitial:\n"
                               "  - {everywhere: true, material: water, density: 1000, pressure: 1e5}\n"
                               "  - {sphere: {center: %s, radius: 0.27}, %s}\nrun: {until: 1}\n",
                               setup->lower, setup->upper, setup->cells, setup->sides, setup->levels, materials,
                               CENTRES[setup->dim - 1], inside));
}

/* The leaf at x mapped: x' = sign * x of another axis. */
static double image(const struct flow *flow, const struct amr_leaf *leaf, const double sign[3], const int axis[3],
                    unsigned q)
{
    double x[3] = {0};
    struct amr_leaf other = {0};
    for (int d = 0; d < flow->scene->domain.dim; d++) x[d] = sign[d] * leaf->x[axis[d]];
    mesh_locate(flow->state->mesh, x, &other.l, &other.tile, &other.cell);
    return other.l == leaf->l ? amr_conserved(flow, &other, q) : NAN;
}

/* The field whose image field q is, and its sign. */
static unsigned origin(const struct model *model, const double sign[3], const int axis[3], unsigned q,
                       double *ret_turned)
{
    if (q >= model->i_u && q < model->i_E) {
        *ret_turned = sign[q - model->i_u];
        return model->i_u + (unsigned)axis[q - model->i_u];
    }
    if (q - model->i_normal < model->n_normal) { /* wraps below i_normal */
        *ret_turned = sign[q - model->i_normal];
        return model->i_normal + (unsigned)axis[q - model->i_normal];
    }
    for (unsigned i = 0; q >= model->i_V && i < 3; i++)
        for (unsigned j = i; j < 3; j++) {
            if (elastic_component(i, j) != q - model->i_V) continue;
            *ret_turned = sign[i] * sign[j];
            return model->i_V + elastic_component((unsigned)axis[i], (unsigned)axis[j]);
        }
    return q;
}

static void check_map(const struct flow *flow, const double sign[3], const int axis[3])
{
    const struct model *model = flow->state->model;
    struct amr_leaves leaves = amr_leaves(flow);
    size_t off = 0;
    for (size_t i = 0; i < leaves.n; i++)
        for (unsigned q = 0; q < model->n_field; q++) {
            double turned = 1.0;
            unsigned from = origin(model, sign, axis, q, &turned);
            double a = amr_conserved(flow, &leaves.all[i], from), b = image(flow, &leaves.all[i], sign, axis, q);
            if (!(b == turned * a) && ++off < 5)
                print_error("level %d at (%g, %g, %g), %s: %.17g and %.17g\n", leaves.all[i].l, leaves.all[i].x[0],
                            leaves.all[i].x[1], leaves.all[i].x[2], model->field_names[q], a, b);
        }
    mem_free(leaves.all);
    if (off)
        fail_msg("%zu values differ from their image (%g, %g, %g; %d, %d, %d)", off, sign[0], sign[1], sign[2], axis[0],
                 axis[1], axis[2]);
}

static void check(const struct setup *setup, const char *materials, const char *inside)
{
    const int same[] = {0, 1, 2};
    struct flow flow;
    start(&flow, setup, materials, inside);
    for (int step = 0; step < setup->steps; step += 10) {
        for (int d = 0; d < setup->dim; d++) {
            double sign[3] = {1, 1, 1};
            sign[d] = -1;
            check_map(&flow, sign, same);
        }
        if (setup->dim == 2) check_map(&flow, (const double[]){1, 1, 1}, (const int[]){1, 0, 2});
        if (setup->dim == 2) check_map(&flow, (const double[]){-1, 1, 1}, (const int[]){1, 0, 2});
        flow_steps(&flow, 10);
    }
    amr_print(&flow, setup->name);
    assert_true(flow.state->counts.regrids > 1);
    flow_stop(&flow);
}

static void test_gas_in_water(void **state)
{
    (void)state;
    for (size_t i = 0; i < sizeof SETUPS / sizeof *SETUPS; i++)
        check(&SETUPS[i], FLOW_AIR FLOW_WATER, "material: air, density: 100, pressure: 5e7");
}

static void test_three(void **state)
{
    (void)state;
    for (size_t i = 0; i < 2; i++)
        check(&SETUPS[i], FLOW_WATER FLOW_HELIUM FLOW_AIR,
              "fractions: {air: 0.6, helium: 0.4}, density: {air: 100, helium: 20}, pressure: 5e7");
}

/* The gas in a solid, which is sheared on all sides, with one pressure and with one traction. */
static void test_gas_in_solid(void **state)
{
    (void)state;
    static const char *const solid = "  water: {eos: {type: stiffened-gas, gamma: 4.4, p-inf: 600 MPa}, constitutive: "
                                     "{type: neo-hookean, shear-modulus: 200 MPa, reference-density: 1000}}\n";
    for (int common = 0; common < 2; common++) {
        char *materials =
            mem_print(FLOW_AIR "%sscheme: {traction: %s, cfl: 0.8}\n", solid, common ? "common" : "pressure");
        for (size_t i = 0; i < sizeof SETUPS / sizeof *SETUPS; i++)
            check(&SETUPS[i], materials, "material: air, density: 100, pressure: 5e7");
        mem_free(materials);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_gas_in_water),
        cmocka_unit_test(test_three),
        cmocka_unit_test(test_gas_in_solid),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
