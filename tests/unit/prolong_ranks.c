/* prolong_ranks.c - born tiles, strips and averages have the same bits on any number of ranks, with parents and
 * children on different ones. The program starts itself under mpirun; each rank writes what it holds, tile by tile. */
#include "prolong_levels.h"

#include "base/comm.h"

#include <inttypes.h>

static bool in_corner(const int at[3])
{
    return at[0] + at[1] + at[2] < 4 || (at[0] + at[1]) % 5 == 4;
}

static uint64_t digest(const double *values, size_t n)
{
    uint64_t sum = 14695981039346656037u;
    for (size_t i = 0; i < n; i++) {
        uint64_t bits;
        memcpy(&bits, &values[i], sizeof bits);
        sum = (sum ^ bits) * 1099511628211u;
    }
    return sum;
}

/* Children far from their parents: the curve cut where a level of the same owners would never be. */
static void scatter(struct twolevel *two)
{
    struct mesh_change change;
    unsigned size = (unsigned)comm_size();
    struct nest_set set = {two->fine->n_local, mem_new(two->fine->n_local, sizeof *set.tiles)};
    if (set.n) memcpy(set.tiles, two->fine->tiles + two->fine->first, set.n * sizeof *set.tiles);
    replicated_join(&set);
    struct tile *tiles = set.tiles;
    unsigned n = set.n;
    for (unsigned i = 0; i < n; i++) {
        unsigned rank = i < n / 8 ? 0 : 1 + (i - n / 8) * (size - 1) / (n - n / 8);
        tiles[i].rank = (int)(rank < size ? rank : size - 1);
    }
    replicated_replace(two->mesh, 1, tiles, n, &change);
    mesh_change_free(&change);
}

static void write_state(const struct twolevel *two, int dim, FILE *out)
{
    const struct mesh *mesh = two->mesh;
    const struct link *link = two->fine->link;
    size_t block = mesh->n_field * mesh->n_cell;
    for (unsigned t = 0; t < two->fine->n_local; t++)
        fprintf(out, "%d fine %" PRIu64 " %016" PRIx64 " %016" PRIx64 "\n", dim,
                two->fine->tiles[two->fine->first + t].key, digest(two->fine->u_old[t], block),
                digest(two->fine->w[t] + two->model->i_E * mesh->n_cell, mesh->n_cell));
    for (unsigned f = 0; f < link->n_face; f++)
        fprintf(out, "%d strip %" PRIu64 " %d %016" PRIx64 " %016" PRIx64 "\n", dim, link->faces[f].key,
                link->faces[f].face, digest(link->faces[f].strip[0], link->strip_doubles),
                digest(link->faces[f].strip[1], link->strip_doubles));
    for (unsigned t = 0; t < two->coarse->n_local; t++)
        fprintf(out, "%d coarse %" PRIu64 " %016" PRIx64 "\n", dim, two->coarse->tiles[two->coarse->first + t].key,
                digest(two->coarse->u_old[t], block));
}

/* What one rank does. */
static void play(const char *path)
{
    char *own = mem_print("%s.%d", path, comm_rank());
    FILE *out = fopen(own, "w");
    for (int i = 0; i < 6; i++) { /* in 1D to 3D, with two and with three ghost layers */
        struct twolevel two;
        int dim = i % 3 + 1;
        twolevel_scheme = TWOLEVEL_SCHEMES[i / 3];
        twolevel_start(&two, twolevel_case(dim, "cartesian", FLOW_WATER FLOW_AIR), twolevel_shock, in_corner);
        if (comm_size() > 1) scatter(&two);
        halo_start(two.coarse->halo, two.coarse->w);
        halo_finish(two.coarse->halo);
        struct prolong *prolong = prolong_new(two.model, two.mesh);
        bool *born = mem_new(two.fine->n_known, sizeof *born);
        memset(born, 1, two.fine->n_known * sizeof *born);
        prolong_tiles(prolong, two.mesh, 1, two.bound, born);
        prolong_strips(prolong, two.mesh, 0, two.bound, 0);
        prolong_strips(prolong, two.mesh, 0, two.bound, 1);
        link_down(two.fine->link);
        for (unsigned t = 0; t < two.fine->n_local; t++)
            for (size_t c = 0; c < two.mesh->n_cell; c++) two.fine->u_old[t][c] *= 1.0 + 0.01 * (double)(c % 7);
        restrict_averages(two.mesh, 1, 0);
        link_up(two.fine->link);
        restrict_take(two.mesh, 1, 0);
        write_state(&two, i, out);
        prolong_free(prolong);
        mem_free(born);
        twolevel_stop(&two);
    }
    fclose(out);
    mem_free(own);
}

static int compare_lines(const void *a, const void *b)
{
    return strcmp(*(char *const *)a, *(char *const *)b);
}

/* The sorted lines of all ranks as one text. */
static char *collect(const char *path, int ranks)
{
    enum { LINES = 4096, LINE = 128 };
    char **lines = mem_new(LINES, sizeof *lines), *all = mem_new(LINES * LINE, 1), *end = all;
    size_t count = 0;
    for (int rank = 0; rank < ranks; rank++) {
        char *own = mem_print("%s.%d", path, rank), line[LINE];
        FILE *in = fopen(own, "r");
        assert_non_null(in);
        while (count < LINES && fgets(line, sizeof line, in)) lines[count++] = mem_text(line);
        fclose(in);
        unlink(own);
        mem_free(own);
    }
    qsort(lines, count, sizeof *lines, compare_lines);
    for (size_t i = 0; i < count; i++) {
        end += sprintf(end, "%s", lines[i]);
        mem_free(lines[i]);
    }
    mem_free(lines);
    return all;
}

/* Open MPI leaks by itself: the leak checker of a sanitized build would only see that. */
static char *run(const char *folder, int ranks)
{
    const char *build = getenv("BULLA_BUILD");
    assert_non_null(build);
    char *path = mem_print("%s/ranks%d", folder, ranks);
    char *command = mem_print("ASAN_OPTIONS=detect_leaks=0 OMPI_ALLOW_RUN_AS_ROOT=1 OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1 "
                              "OMPI_MCA_mpi_yield_when_idle=1 OMPI_MCA_rmaps_base_oversubscribe=1 timeout 200 mpirun "
                              "-n %d --bind-to none '%s/tests/test-unit-prolong-ranks' '%s' >'%s.log' 2>&1",
                              ranks, build, path, path);
    if (system(command)) {
        mem_free(command);
        command = mem_print("cat '%s.log'", path);
        if (system(command)) print_error("no log\n");
        fail_msg("%d ranks", ranks);
    }
    char *text = collect(path, ranks);
    mem_free(command);
    mem_free(path);
    return text;
}

static void bits_do_not_depend_on_ranks(void **state)
{
    (void)state;
    char folder[] = "/tmp/bulla-prolong-XXXXXX";
    assert_non_null(mkdtemp(folder));
    char *one = run(folder, 1);
    assert_true(strstr(one, "1 fine") && strstr(one, "3 fine") && strstr(one, "3 strip") && strstr(one, "2 coarse"));
    for (int ranks = 2; ranks <= 4; ranks++) {
        char *other = run(folder, ranks);
        assert_string_equal(one, other);
        mem_free(other);
    }
    mem_free(one);
    char *command = mem_print("rm -rf '%s'", folder);
    assert_int_equal(system(command), 0);
    mem_free(command);
}

int main(int argc, char **argv)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(bits_do_not_depend_on_ranks)};
    if (argc < 2) return cmocka_run_group_tests(tests, NULL, NULL);
    comm_init(&argc, &argv);
    play(argv[1]);
    comm_done();
    return 0;
}
