/* Tags against brute force over the whole domain: differences, surfaces, values, scripts, regions, limits, symmetry.
 * The expected marks are computed from the numbers of the whole domain on every rank, so it also runs under mpirun. */
#include "replicated.h"
#include "tag_world.h"

/* Fields. Random, but the same on all ranks. */

static double at_random(const int cell[3], unsigned stream)
{
    uint64_t z = (uint64_t)(cell[0] + 1000 * cell[1] + 1000000 * cell[2]) * 0x9e3779b97f4a7c15u + stream;
    z = (z ^ z >> 30) * 0xbf58476d1ce4e5b9u;
    z = (z ^ z >> 27) * 0x94d049bb133111ebu;
    return (double)((z ^ z >> 31) >> 11) * 0x1p-53;
}

static double rough_pressure(const int cell[3])
{
    double x = at_random(cell, 1);
    return 1e5 * (1.0 + 0.5 * x * x * x * x * x * x);
}

static double rough_u(const int cell[3])
{
    return at_random(cell, 2) < 0.05 ? 10.0 : 1.0;
}

static double rough_v(const int cell[3])
{
    return at_random(cell, 3) < 0.05 ? -10.0 : 1.0;
}

static double rough_water(const int cell[3])
{
    double x = at_random(cell, 4);
    return cell[0] < 5 ? 0.0 : x < 0.02 ? 0.5 : x < 0.04 ? 1.0 - 1e-5 : x < 0.1 ? 1.0 - 1e-8 : 1.0;
}

static double rough_air(const int cell[3])
{
    return 1.0 - rough_water(cell);
}

/* Largest over the faces of a measure of the pair. */
static double over_faces(const struct world *world, const int cell[3], world_field *value,
                         double (*measure)(const struct world *world, int axis, double a, double b))
{
    double most = 0.0;
    for (int face = 0; face < 2 * world->mesh->dim; face++) {
        int other[3] = {cell[0], cell[1], cell[2]}, axis = face / 2, n = world->scene->domain.cells[axis];
        other[axis] += face % 2 ? 1 : -1;
        if (world->mesh->periodic[axis]) other[axis] = (other[axis] + n) % n;
        if (other[axis] < 0 || other[axis] >= n) continue;
        most = fmax(most, measure(world, axis, value(cell), value(other)));
    }
    return most;
}

static double jump(const struct world *world, int axis, double a, double b)
{
    (void)world, (void)axis;
    return fabs(a - b);
}

static double relative_jump(const struct world *world, int axis, double a, double b)
{
    (void)world, (void)axis;
    return fabs(a - b) / fmax(fabs(a), fabs(b));
}

static double slope(const struct world *world, int axis, double a, double b)
{
    return fabs(a - b) / world->mesh->levels[0].h[axis];
}

static bool jumps(const struct world *world, const int cell[3])
{
    return over_faces(world, cell, rough_pressure, jump) > 3e4;
}

static bool jumps_relative(const struct world *world, const int cell[3])
{
    return over_faces(world, cell, rough_pressure, relative_jump) > 0.2;
}

static bool steep(const struct world *world, const int cell[3])
{
    return over_faces(world, cell, rough_pressure, slope) > 2.5e5;
}

static void check_pressure(int dim, const char *faces, const char *refine, world_wanted *wanted)
{
    struct world world;
    world_open(&world, dim, faces, refine);
    world_rest(&world);
    world_fill(&world, world.model->i_E, rough_pressure);
    world_tag(&world, 0.0);
    world_expect(&world, wanted);
    world_close(&world);
}

static void differences_equal_brute_force(void **state)
{
    (void)state;
    for (int dim = 1; dim <= 3; dim++)
        for (int periodic = 0; periodic < 2; periodic++) {
            const char *faces = periodic ? "periodic" : "outflow";
            check_pressure(dim, faces, "{jump: pressure, above: 0.3 bar}", jumps);
            check_pressure(dim, faces, "{jump: pressure, above: 0.2}", jumps_relative);
            check_pressure(dim, faces, "{gradient: pressure, above: 20 %}", jumps_relative);
            check_pressure(dim, faces, "{gradient: pressure, above: 0.25 MPa/m}", steep);
        }
}

static bool shears(const struct world *world, const int cell[3])
{
    return over_faces(world, cell, rough_u, jump) > 8.0 || over_faces(world, cell, rough_v, jump) > 8.0;
}

static bool fast(const struct world *world, const int cell[3])
{
    double u = rough_u(cell), v = rough_v(cell);
    (void)world;
    return sqrt(u * u + v * v) > 10.5;
}

/* Each component of a jump counts, a cell only once; values are magnitudes. */
static void vectors_have_components(void **state)
{
    (void)state;
    static const char *const refine[] = {"{jump: velocity, above: 8 m/s}", "{value: velocity, above: 10.5 m/s}"};
    world_wanted *wanted[] = {shears, fast};
    for (int i = 0; i < 2; i++) {
        struct world world;
        world_open(&world, 2, "periodic", refine[i]);
        world_rest(&world);
        world_fill(&world, world.model->i_u, rough_u);
        world_fill(&world, world.model->i_u + 1, rough_v);
        world_tag(&world, 0.0);
        world_expect(&world, wanted[i]);
        world_close(&world);
    }
}

static bool mixed(const struct world *world, const int cell[3])
{
    double air = rough_air(cell);
    return (air > 1e-6 && air < 1.0 - 1e-6) || over_faces(world, cell, rough_air, jump) > 1e-6;
}

/* Mixed cells and both sides of a sharp surface; less than 1e-6 is none. */
static void surfaces_are_covered_on_both_sides(void **state)
{
    (void)state;
    for (int dim = 1; dim <= 3; dim++) {
        struct world world;
        world_open(&world, dim, "outflow", dim == 2 ? "{interface: water}" : "{interface: air}");
        world_rest(&world);
        world_fill(&world, 0, rough_water);
        world_fill(&world, 1, rough_air);
        world_tag(&world, 0.0);
        world_expect(&world, mixed);
        world_close(&world);
    }
}

static bool between(const struct world *world, const int cell[3])
{
    (void)world;
    return rough_pressure(cell) > 1.1e5 && rough_pressure(cell) < 1.3e5;
}

static void centre(const struct world *world, const int cell[3], double ret_x[3])
{
    for (int d = 0; d < 3; d++)
        ret_x[d] = d < world->mesh->dim ? world->mesh->lower[d] + (cell[d] + 0.5) * world->mesh->levels[0].h[d] : 0.0;
}

/* Does a disc of radius 0.45 about the origin cover any of the cell? */
static bool disc(const struct world *world, const int cell[3])
{
    double x[3], near[2];
    centre(world, cell, x);
    for (int d = 0; d < 2; d++) near[d] = fmax(fabs(x[d]) - 0.5 * world->mesh->levels[0].h[d], 0.0);
    return hypot(near[0], near[1]) < 0.45;
}

static bool speck(const struct world *world, const int cell[3])
{
    (void)world;
    return cell[0] == 15 && (cell[1] == 3 || cell[1] == 4);
}

static bool jumps_in_disc(const struct world *world, const int cell[3])
{
    return jumps(world, cell) && disc(world, cell);
}

static bool script(const struct world *world, const int cell[3])
{
    double x[3];
    centre(world, cell, x);
    return rough_pressure(cell) > 1.01e5 + 1e4 * x[0] && x[1] < 0.3;
}

static bool script_in_disc(const struct world *world, const int cell[3])
{
    return script(world, cell) && disc(world, cell);
}

#define TAG_DISC "{sphere: {center: [0, 0], radius: 0.45}}"

static void values_regions_and_scripts(void **state)
{
    (void)state;
    check_pressure(2, "outflow", "{value: pressure, above: 1.1 bar, below: 1.3 bar}", between);
    check_pressure(2, "outflow", "{region: " TAG_DISC "}", disc);
    check_pressure(2, "outflow", "{region: {box: {lower: [0.26, -0.668], upper: [0.27, -0.666]}}}", speck);
    check_pressure(2, "outflow", "{jump: pressure, above: 0.3 bar, where: " TAG_DISC "}", jumps_in_disc);
    check_pressure(2, "outflow", "{lua: = pressure > 1.01e5 + 1e4 * x and y < 0.3}", script);
    check_pressure(2, "outflow",
                   "{lua: \"function(y, t, x, pressure) return y < 0.3 and pressure - 1.01e5 - 1e4 * x + 0 * t end\", "
                   "where: " TAG_DISC "}",
                   script_in_disc);
}

/* A script that fails says where and at which values. */
static void failing_scripts_are_reported(void **state)
{
    (void)state;
    struct world world;
    world_open(&world, 2, "outflow", "{lua: \"= x > 0 and pressure .. 'a' or 1\"}");
    world_rest(&world);
    struct derive_moment moment = derive_moment(world.model, world.mesh, 0.0);
    assert_int_equal(tag_level(&moment, 0, world.halo, world.marks, world.hits), STATUS_CASE);
    assert_non_null(strstr(status_text(), ".yaml:3: a number is needed here"));
    assert_non_null(strstr(status_text(), "pressure = "));
    world_close(&world);
}

static long long tagged(struct world *world, double t, unsigned criterion)
{
    world_tag(world, t);
    long long hits = world->hits[criterion];
    comm_sum_counts(&hits, 1);
    return hits;
}

static void criteria_have_windows_and_levels(void **state)
{
    (void)state;
    struct world world;
    world_open(&world, 2, "outflow",
               "{region: " TAG_DISC ", from: 1 s, until: 2 s}, {region: " TAG_DISC ", finest: 1}, "
               "{region: {everywhere: true}, finest: 2}");
    world_rest(&world);
    assert_int_equal(tagged(&world, 0.9, 0), 0);
    assert_true(tagged(&world, 1.0, 0) > 0);
    assert_true(tagged(&world, 2.0, 0) > 0);
    assert_int_equal(tagged(&world, 2.1, 0), 0);
    assert_int_equal(tagged(&world, 0.0, 2), 24 * 24);
    assert_true(tagged(&world, 0.0, 1) > 0 && tagged(&world, 0.0, 1) < 24 * 24);
    world.scene->mesh.refines[1].finest = 0;
    assert_int_equal(tagged(&world, 0.0, 1), 0);
    world_close(&world);
}

static double pulse(const int cell[3])
{
    return 1e5 * (1.0 + 1e-7 * exp(-pow((cell[0] - 12) / 3.0, 2.0)));
}

/* A sound wave of a ten-millionth: seen by an absolute threshold, not by a relative one. Fluid at rest is not seen. */
static void faint_pulses_can_be_tagged(void **state)
{
    (void)state;
    struct world world;
    world_open(&world, 2, "outflow", "{jump: pressure, above: 1e-3 Pa}, {gradient: pressure, above: 0.05}");
    world_rest(&world);
    assert_int_equal(tagged(&world, 0.0, 0), 0);
    world_fill(&world, world.model->i_E, pulse);
    assert_true(tagged(&world, 0.0, 0) >= 4 * 24);
    assert_int_equal(tagged(&world, 0.0, 1), 0);
    world_close(&world);
}

/* A field with its axes exchanged and one mirrored. */

static bool turned;

static double turn(const int cell[3], world_field *value)
{
    int other[3] = {23 - cell[1], cell[0], 0};
    return value(turned ? other : cell);
}

static double turned_pressure(const int cell[3])
{
    return turn(cell, rough_pressure);
}

static double turned_water(const int cell[3])
{
    return turn(cell, rough_water);
}

static double turned_air(const int cell[3])
{
    return turn(cell, rough_air);
}

static double turned_u(const int cell[3])
{
    return turned ? turn(cell, rough_v) : rough_u(cell);
}

static double turned_v(const int cell[3])
{
    return turned ? -turn(cell, rough_u) : rough_v(cell);
}

/* Marks of the domain, at their place before turning. */
static void turned_marks(const char *refine, double ret_marks[24 * 24])
{
    struct world world;
    world_open(&world, 2, "periodic", refine);
    world_rest(&world);
    world_fill(&world, 0, turned_water);
    world_fill(&world, 1, turned_air);
    world_fill(&world, world.model->i_E, turned_pressure);
    world_fill(&world, world.model->i_u, turned_u);
    world_fill(&world, world.model->i_u + 1, turned_v);
    world_tag(&world, 0.0);
    memset(ret_marks, 0, 24 * 24 * sizeof *ret_marks);
    for (unsigned t = 0; t < world.mesh->levels[0].n_local; t++)
        for (size_t c = 0; c < world.mesh->n_cell; c++) {
            int cell[3];
            world_cell(&world, t, c, cell);
            int at = turned ? 23 - cell[1] + 24 * cell[0] : cell[0] + 24 * cell[1];
            ret_marks[at] = world.marks[t][c];
        }
    comm_max(ret_marks, 24 * 24);
    world_close(&world);
}

static void turned_states_have_turned_marks(void **state)
{
    (void)state;
    static const char *const refine[] = {"{gradient: density, above: 0.3}",
                                         "{gradient: pressure, above: 2.6 bar/m}",
                                         "{jump: velocity, above: 8.9999999999 m/s}",
                                         "{value: velocity, above: 10.049875621120890 m/s}",
                                         "{interface: air}",
                                         "{value: mach, above: 0.0067}",
                                         "{region: " TAG_DISC "}"};
    for (size_t i = 0; i < sizeof refine / sizeof *refine; i++) {
        double straight[24 * 24], other[24 * 24], sum = 0.0;
        turned = false;
        turned_marks(refine[i], straight);
        turned = true;
        turned_marks(refine[i], other);
        for (int c = 0; c < 24 * 24; c++) sum += straight[c];
        if (memcmp(straight, other, sizeof other) != 0) fail_msg("%s is not symmetric", refine[i]);
        if (sum <= 0.0 || sum >= 24 * 24) fail_msg("%s tags %g cells", refine[i], sum);
    }
}

/* A finer level beside nothing: the coarse cells around are no neighbours. */
static void coarse_fine_faces_are_no_jumps(void **state)
{
    (void)state;
    struct world world;
    world_open(&world, 2, "outflow",
               "{jump: pressure, above: 1 Pa}, {interface: air}, {gradient: density, above: 1e-9}");
    world_rest(&world);
    struct tile *tiles = mem_new(1, sizeof *tiles);
    struct mesh_change change;
    tiles[0] = (struct tile){.key = 12, .at = {2, 2, 0}};
    replicated_replace(world.mesh, 1, tiles, 1, &change);
    mesh_change_free(&change);
    const struct level *fine = &world.mesh->levels[1];
    double *marks[1] = {mem_new(world.mesh->n_cell, sizeof **marks)};
    for (unsigned t = 0; t < fine->n_local; t++)
        for (unsigned q = 0; q < world.model->n_field; q++)
            for (size_t c = 0; c < world.mesh->n_cell; c++)
                fine->w[t][q * world.mesh->n_cell + c] = q < 2 ? 0.25 + 0.5 * q : 1.0 + q;
    struct halo *halo = halo_new(world.mesh, fine, 1);
    memset(world.hits, 0, sizeof world.hits);
    struct derive_moment moment = derive_moment(world.model, world.mesh, 0.0);
    assert_int_equal(tag_level(&moment, 1, halo, marks, world.hits), STATUS_OK);
    for (size_t c = 0; c < world.mesh->n_cell; c++) assert_true(marks[0][c] == (fine->n_local ? 1.0 : 0.0));
    assert_true(world.hits[0] == 0 && world.hits[2] == 0); /* a uniform mixture: only the surface */
    halo_free(halo);
    mem_free(marks[0]);
    world_close(&world);
}

static void described(const struct world *world, unsigned criterion, const char *words)
{
    char *text = tag_describe(world->scene, criterion);
    assert_string_equal(text, words);
    mem_free(text);
}

static void criteria_are_described(void **state)
{
    (void)state;
    struct world world;
    world_open(&world, 2, "outflow",
               "{gradient: density, above: 0.05}, {gradient: pressure, above: 1 MPa/mm, finest: 1}, "
               "{value: pressure, above: 1 bar, below: 2 bar, from: 1, until: 2}, "
               "{interface: air, where: {everywhere: true}}, {region: {everywhere: true}}, {lua: = x > 1}");
    described(&world, 0, "mesh.refine[0] (line 3): jump of density above 0.05 of the larger cell");
    described(&world, 1, "mesh.refine[1] (line 3): gradient of pressure above 1e+09 Pa/m, to level 1");
    described(&world, 2,
              "mesh.refine[2] (line 3): value of pressure above 100000 Pa and below 200000 Pa, from 1 s, until 2 s");
    described(&world, 3, "mesh.refine[3] (line 3): interface of air, in a region");
    described(&world, 4, "mesh.refine[4] (line 3): region");
    described(&world, 5, "mesh.refine[5] (line 3): lua");
    world_close(&world);
}

int main(int argc, char **argv)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(differences_equal_brute_force),      cmocka_unit_test(vectors_have_components),
        cmocka_unit_test(surfaces_are_covered_on_both_sides), cmocka_unit_test(values_regions_and_scripts),
        cmocka_unit_test(failing_scripts_are_reported),       cmocka_unit_test(criteria_have_windows_and_levels),
        cmocka_unit_test(faint_pulses_can_be_tagged),         cmocka_unit_test(turned_states_have_turned_marks),
        cmocka_unit_test(coarse_fine_faces_are_no_jumps),     cmocka_unit_test(criteria_are_described),
    };
    comm_init(&argc, &argv);
    int failed = cmocka_run_group_tests(tests, NULL, NULL);
    comm_done();
    return failed;
}
