/* Films of a viscous liquid in mixed cells: they take motion away at every corner, act on no cell beyond what it holds,
 * do nothing across a surface, and a bubble in a liquid of 10 Pa s runs. */
#include "flow.h"

#include "scheme/patch.h"
#include "scheme/viscous_film.h"

static const double MU = 10.0, GAS = 18.5e-6;

/* One tile, and what lies around it. */
struct scene_of {
    struct flow flow;
    struct viscous_slopes slopes;
    struct viscous_mix mix;
    struct viscous_film film;
    struct viscous_strain *strain;
    struct term_tile tile;
    double *around;
    size_t cells;
};

static const char *const domain[] = {
    "{geometry: spherical, lower: [0], upper: [8], cells: [8], boundaries: {x-: axis, x+: reflecting}}",
    "{lower: [0, 0], upper: [8, 8], cells: [8, 8], boundaries: {x-: reflecting, x+: reflecting, y-: reflecting, y+: "
    "reflecting}}",
    "{lower: [0, 0, 0], upper: [8, 8, 8], cells: [8, 8, 8], boundaries: {x-: reflecting, x+: reflecting, y-: "
    "reflecting, y+: reflecting, z-: reflecting, z+: reflecting}}"};

static void scene_with(struct scene_of *ret, int dim, const char *water, const char *air)
{
    flow_start(&ret->flow,
               mem_print("bulla: 1\ntitle: film\ndomain: %s\nmesh: {tile: 8}\nmaterials:\n"
                         "  water: {eos: {type: stiffened-gas, gamma: 4.4, p-inf: 600 MPa}, viscosity: %s}\n"
                         "  air: {eos: {type: ideal-gas, gamma: 1.4, cv: 717.5}, viscosity: %s}\n"
                         "initial:\n  - {everywhere: true, material: water, density: 1000, pressure: 1 bar}\n"
                         "run: {until: 1}\n",
                         domain[dim - 1], water, air));
    const struct model *model = ret->flow.state->model;
    const struct mesh *mesh = ret->flow.state->mesh;
    const struct level *level = flow_level(&ret->flow);
    ret->cells = rim_block(mesh, 1, NULL).pitch;
    ret->around = mem_new(model->n_around * ret->cells, sizeof *ret->around);
    ret->tile = (struct term_tile){.model = model,
                                   .mesh = mesh,
                                   .level = level,
                                   .tile = &level->tiles[level->first],
                                   .n_cell = mesh->n_cell,
                                   .around = ret->around};
    viscous_slopes_open(mesh, &ret->slopes);
    viscous_mix_open(model, &ret->mix);
    viscous_film_open(mesh, model, &ret->film);
    ret->strain = mem_new(1, sizeof *ret->strain);
}

static void scene_begin(struct scene_of *ret, int dim)
{
    scene_with(ret, dim, "10", "18.5 uPa s");
}

static void scene_make(struct scene_of *of)
{
    viscous_slopes_look(&of->slopes, &of->tile);
    viscous_film_make(&of->film, &of->slopes, &of->mix, of->strain);
}

static void scene_end(struct scene_of *of)
{
    mem_free(of->strain);
    mem_free(of->around);
    viscous_film_close(&of->film);
    viscous_mix_close(&of->mix);
    viscous_slopes_close(&of->slopes);
    flow_stop(&of->flow);
}

static double random_of(uint32_t *seed)
{
    *seed = *seed * 1664525u + 1013904223u;
    return (double)(*seed >> 8) / 16777216.0;
}

/* Inside, a third water, a third gas and a third mixtures of any kind, in motion; around that water at rest. */
static void scene_stir(struct scene_of *of, uint32_t *seed)
{
    const struct mesh *mesh = of->tile.mesh;
    const struct box_block block = rim_block(mesh, 1, NULL);
    memset(of->around, 0, of->tile.model->n_around * of->cells * sizeof *of->around);
    for (int k = 0; k < mesh->n[2]; k++)
        for (int j = 0; j < mesh->n[1]; j++)
            for (int i = 0; i < mesh->n[0]; i++) {
                int at[3] = {i, j, k};
                bool inside = true;
                for (int d = 0; d < mesh->dim; d++) inside = inside && at[d] > 0 && at[d] < mesh->n[d] - 1;
                size_t c = box_at(&block, i, j, k);
                double what = random_of(seed), part = pow(10.0, -8.0 * random_of(seed));
                double gas = what < 0.33 ? 0.0 : what < 0.66 ? 1.0 : what < 0.83 ? part : 1.0 - part;
                if (!inside) continue;
                of->around[c] = gas;
                for (unsigned d = 0; d < of->tile.model->n_velocity; d++)
                    of->around[(1 + d) * of->cells + c] = random_of(seed) - 0.5;
            }
}

/* Component i of the stress of the films at the face above cell c across an axis. */
static double stress(const struct scene_of *of, size_t c, int axis, unsigned i)
{
    const struct viscous_block block = {.rows = 1, .n = 1, .patch = c, .patch_row = 1, .axis = axis};
    double tau = 0.0;
    viscous_film_faces(&of->film, &block, i, &tau);
    return tau;
}

static double content(const struct scene_of *of, size_t c)
{
    return (1.0 - of->around[c]) * MU + of->around[c] * GAS;
}

/* Whatever moves: what films take is not negative, in sum, and no cell is pushed by more than its own viscosity would
 * by. */
static void test_bears(void **state)
{
    uint32_t seed = 1;
    (void)state;
    for (int dim = 2; dim <= 3; dim++) {
        struct scene_of of;
        double most = 0.0, least = 1e300;
        scene_begin(&of, dim);
        for (int turn = 0; turn < 40; turn++) {
            scene_stir(&of, &seed);
            scene_make(&of);
            double *force = mem_new((size_t)dim * of.cells, sizeof *force), power = 0.0;
            const struct box_block block = rim_block(of.tile.mesh, 1, NULL);
            for (int k = 0; k < (dim > 2 ? 8 : 1); k++)
                for (int j = 0; j < 8; j++)
                    for (int i = 0; i < 8; i++)
                        for (int a = 0; a < dim; a++)
                            for (unsigned d = 0; d < (unsigned)dim; d++) {
                                size_t c = box_at(&block, i, j, k), next = c + of.slopes.stride[a];
                                double tau = stress(&of, c, a, d), *u = of.around + (1 + d) * of.cells;
                                force[d * of.cells + c] += tau;
                                force[d * of.cells + next] -= tau;
                                power += tau * (u[next] - u[c]);
                            }
            least = power < least ? power : least;
            for (size_t c = 0; c < (size_t)dim * of.cells; c++) {
                double push = fabs(force[c]) / content(&of, c % of.cells);
                most = push > most ? push : most;
            }
            mem_free(force);
        }
        print_message("%d axes: least power %.3g, most push of a cell over its viscosity %.3g\n", dim, least, most);
        assert_true(least > 0.1);
        assert_true(most > 0.5 && most < 16.0);
        scene_end(&of);
    }
}

/* A front of some cells across y, from row `first` on, in a liquid that is stretched along x. */
static void scene_stretch(struct scene_of *of, double a, int first)
{
    const struct box_block block = rim_block(of->tile.mesh, 1, NULL);
    for (int j = -1; j <= 8; j++)
        for (int i = -1; i <= 8; i++) {
            size_t c = box_at(&block, i, j, 0);
            of->around[c] = j < first ? 0.0 : j > first + 3 ? 1.0 : 0.2 * (j + 1 - first);
            of->around[of->cells + c] = a * i;
            of->around[2 * of->cells + c] = -a * j;
        }
}

/* The film carries 4 mu_a a along x, as a sheet does (D_t + delta = 2 a), and nothing across. */
static void test_sheet(void **state)
{
    (void)state;
    struct scene_of of;
    const double a = 0.3;
    double along = 0.0, whole = 0.0;
    scene_begin(&of, 2);
    const struct box_block block = rim_block(of.tile.mesh, 1, NULL);
    scene_stretch(&of, a, 2);
    scene_make(&of);
    for (int j = 0; j < 8; j++) {
        size_t c = box_at(&block, 3, j, 0);
        double gas = of.around[c], across = 1.0 / ((1.0 - gas) / MU + gas / GAS);
        along += stress(&of, c, 0, 0);
        whole += gas > 0.0 && gas < 1.0 ? 4.0 * (content(&of, c) - across) * a : 0.0;
        assert_true(fabs(stress(&of, c, 1, 0)) + fabs(stress(&of, c, 1, 1)) + fabs(stress(&of, c, 0, 1)) <
                    1e-5 * MU * a); /* |m| is 1 to 3e-7 */
    }
    print_message("along the sheet %.9g of what it should\n", along / whole);
    assert_true(fabs(along / whole - 1.0) < 1e-5);
    scene_end(&of);
}

/* The same of a liquid that thins in shear (rate 2 a) and a hot gas by Sutherland's law. */
static void test_laws(void **state)
{
    (void)state;
    struct scene_of of;
    const double a = 0.3, T = 600.0, p = 1e5, water = 10.0 / sqrt(2.0 * a);
    const double air = 2.0 * pow(T / 273.15, 1.5) * (273.15 + 110.4) / (T + 110.4);
    double along = 0.0, whole = 0.0;
    scene_with(&of, 2, "{type: power, consistency: 10, index: 0.5, mu-max: 1e6}",
               "{type: sutherland, mu: 2, constant: 110.4}");
    const struct model *model = of.tile.model;
    const struct box_block block = rim_block(of.tile.mesh, 1, NULL);
    scene_stretch(&of, a, 2);
    assert_int_equal(model->n_around, 6);
    for (size_t c = 0; c < of.cells; c++) {
        of.around[(model->i_around_rho + 0) * of.cells + c] = 1000.0;
        of.around[(model->i_around_rho + 1) * of.cells + c] = p / (0.4 * 717.5 * T);
        of.around[model->i_around_p * of.cells + c] = p;
        if (of.around[c] == 1.0) of.around[(model->i_around_rho + 0) * of.cells + c] = 1e-30; /* nobody's density */
        if (of.around[c] == 0.0) of.around[(model->i_around_rho + 1) * of.cells + c] = 1e-30;
    }
    scene_make(&of);
    for (int j = 0; j < 8; j++) {
        size_t c = box_at(&block, 3, j, 0);
        double gas = of.around[c], more = (1.0 - gas) * water + gas * air - 1.0 / ((1.0 - gas) / water + gas / air);
        along += stress(&of, c, 0, 0);
        whole += 4.0 * more * a;
    }
    print_message("along a sheet by laws %.9g of what it should\n", along / whole);
    assert_true(fabs(along / whole - 1.0) < 1e-5);
    scene_end(&of);
}

/* Where a film was in the last tile there is none in the next. */
static void test_next(void **state)
{
    (void)state;
    struct scene_of used, fresh;
    scene_begin(&used, 2);
    scene_begin(&fresh, 2);
    scene_stretch(&used, 0.3, -2);
    scene_make(&used);
    scene_stretch(&used, 0.3, 3);
    scene_stretch(&fresh, 0.3, 3);
    scene_make(&used);
    scene_make(&fresh);
    const struct box_block block = rim_block(used.tile.mesh, 1, NULL);
    for (int j = 0; j < 8; j++)
        for (int i = 0; i < 8; i++) {
            size_t c = box_at(&block, i, j, 0);
            assert_true(stress(&used, c, 0, 0) == stress(&fresh, c, 0, 0));
        }
    scene_end(&used);
    scene_end(&fresh);
}

/* The liquid around a ball that grows has a hoop stress of 6 mu u/r in its film, and none elsewhere. */
static void test_ball(void **state)
{
    (void)state;
    struct scene_of of;
    scene_begin(&of, 1);
    for (int i = -1; i <= 8; i++) {
        double r = i + 0.5;
        of.around[i + 1] = i < 2 ? 1.0 : i > 5 ? 0.0 : 0.2 * (6 - i);
        of.around[of.cells + (size_t)(i + 1)] = 1.0 / (r * r) * (i < 0 ? -1.0 : 1.0);
    }
    scene_make(&of);
    const struct viscous_block cells = {.rows = 1, .n = 8, .patch = 1, .patch_row = 1, .axis = -1};
    double tau[8] = {0}, ring = 0.0, all = 0.0;
    viscous_film_cells(&of.film, &cells, tau);
    for (int i = 0; i < 8; i++) {
        double r = of.slopes.centroid[i + 1],
               right = 6.0 * (1.0 - of.around[i + 1]) * MU * of.around[of.cells + (size_t)(i + 1)] / r;
        if (i < 2 || i > 5) assert_true(tau[i] == 0.0);
        else ring += tau[i] * r * r, all += right * r * r;
    }
    print_message("hoop of the film %.3f of what it should be\n", ring / all);
    assert_true(fabs(ring / all - 1.0) < 0.1);
    scene_end(&of);
}

/* A bubble of 2 um, sharp, in 10 Pa s that press it with 3 bar: 40 steps in which no cell is touched, and nothing moves
 * faster than the shock that comes in. */
static void test_runs(void **state)
{
    (void)state;
    struct flow flow;
    flow_start(&flow,
               mem_print("bulla: 1\ntitle: bubble\ndomain: {geometry: axisymmetric, lower: [0, 0], upper: [4 um, "
                         "4 um], cells: [16, 16], boundaries: {x-: axis, x+: reflecting, y-: symmetry, y+: "
                         "reflecting}}\nmesh: {tile: 8}\nmaterials:\n"
                         "  water: {eos: {type: stiffened-gas, gamma: 4.4, p-inf: 600 MPa}, viscosity: 10}\n"
                         "  air: {eos: {type: ideal-gas, gamma: 1.4}, viscosity: 18.5 uPa s}\n"
                         "initial:\n  - {everywhere: true, material: water, density: 1000, pressure: 3 bar}\n"
                         "  - {sphere: {center: [0, 0], radius: 2 um}, material: air, density: 1.2, pressure: 1 "
                         "bar}\nscheme: {guard: strict}\nrun: {until: 1}\n"));
    double most = 0.0;
    flow_steps(&flow, 40);
    for (unsigned d = 0; d < 2; d++) {
        double *u = flow_primitive(&flow, flow.state->model->i_u + d);
        for (size_t c = 0; c < flow.n_cell; c++) most = fabs(u[c]) > most ? fabs(u[c]) : most;
        mem_free(u);
    }
    print_message("fastest %.3g m/s\n", most);
    assert_true(most > 1e-4 && most < 0.2);
    flow_stop(&flow);
}

/* Fractions of three materials that a coarser level gives need not sum to 1: of the first there is none then, and not
 * less. */
static void test_fractions(void **state)
{
    (void)state;
    static const double rows[2][4] = {{0.25, 0.393583, 0.0, 1.0}, {0.25, 0.636107, 1.0, 0.0}};
    static const unsigned at[] = {0, 1, 2};
    struct model model = {.n_around_alpha = 2};
    const struct term_tile tile = {.model = &model};
    const struct viscous_slopes slopes = {.tile = &tile, .data = rows[0], .pitch = 4};
    double first[3], second[3];
    for (size_t around = 0; around < 2; around++) {
        static const double expected[4] = {0.5, 0.0, 0.0, 0.0};
        viscous_hold_fraction(&slopes, 3, at, around, 0, first);
        viscous_hold_fraction(&slopes, 3, at, around, 1, second);
        for (size_t i = 0; i < 3; i++)
            assert_true(first[i] == expected[around + i] && second[i] == rows[0][around + i]);
    }
}

/* A step that failed leaves NANs behind; the next tile has nothing of them. */
static void test_failed(void **state)
{
    (void)state;
    struct scene_of of;
    scene_begin(&of, 2);
    const struct box_block block = rim_block(of.tile.mesh, 1, NULL);
    uint32_t seed = 1;
    scene_stir(&of, &seed);
    scene_make(&of);
    for (size_t i = 0; i < of.film.count; i++)
        for (int axis = 0; axis < 2; axis++)
            for (unsigned p = 0; p < of.film.pairs; p++) of.film.weight[axis][p][of.film.at[i]] = (double)NAN;
    scene_stretch(&of, 0.3, 2);
    scene_make(&of);
    for (int j = 0; j < 8; j++)
        for (int i = 0; i < 8; i++)
            for (int a = 0; a < 2; a++)
                assert_true(isfinite(stress(&of, box_at(&block, i, j, 0), a, 0)) &&
                            isfinite(stress(&of, box_at(&block, i, j, 0), a, 1)));
    scene_end(&of);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(test_fractions), cmocka_unit_test(test_bears),
                                       cmocka_unit_test(test_sheet),     cmocka_unit_test(test_laws),
                                       cmocka_unit_test(test_next),      cmocka_unit_test(test_ball),
                                       cmocka_unit_test(test_runs),      cmocka_unit_test(test_failed)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
