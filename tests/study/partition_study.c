/* partition_study.c - what many ranks would cost: cuts of real tile sets simulated for 12 to 10^5 ranks, as tables.
 *
 *     build/tests/partition-study [tiny]
 *
 * docs/scaling.md holds its output and says what it means. `tiny` takes small sets and few ranks, checks that the
 * figures hang together, and exits with 1 where they do not; it is what the test suite runs. */
#include "sets.h"
#include "traffic.h"

#include "base/mem.h"
#include "base/status.h"
#include "mesh/level.h"
#include "mesh/partition.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

enum { STUDY_REGRID = 4, STUDY_RANKS = 6, STUDY_REPEATS = 5 };

/* The machine of the projection: seconds per cell and stage of cost 1, per message, per byte. */
static const double STUDY_CELL = 45e-9, STUDY_MESSAGE = 2e-6, STUDY_BYTE = 1e-10;

struct study {
    struct sets_scene scene;
    struct mesh mesh;
    struct traffic_graph graphs[MESH_LEVELS];
    double *costs[MESH_LEVELS];
    double tiles;
    double topology, idle; /* seconds per tile: a regrid that changes all, one that changes nothing */
};

static const int RANKS[STUDY_RANKS] = {12, 96, 1000, 10000, 30000, 100000};

static const struct sets_scene SHELL_2D = {.name = "circle",
                                           .dim = 2,
                                           .n = 16,
                                           .base = 32,
                                           .levels = 8,
                                           .n_feature = 1,
                                           .features = {{SETS_SHELL, {1.0, 1.0, 0.0}, 0.3, 8, false}}};
static const struct sets_scene SHELL_3D = {.name = "sphere",
                                           .dim = 3,
                                           .n = 16,
                                           .base = 8,
                                           .levels = 6,
                                           .n_feature = 1,
                                           .features = {{SETS_SHELL, {1.0, 1.0, 1.0}, 0.3, 6, false}}};
static const struct sets_scene BUBBLE_2D = {.name = "bubble and pulse",
                                            .dim = 2,
                                            .n = 16,
                                            .base = 32,
                                            .levels = 8,
                                            .n_feature = 3,
                                            .features = {{SETS_SHELL, {1.0, 1.0, 0.0}, 0.1, 8, true},
                                                         {SETS_BALL, {1.0, 1.0, 0.0}, 0.12, 6, false},
                                                         {SETS_PLANE, {0.0, 0.0, 0.0}, 1.3, 5, false}}};
static const struct sets_scene BUBBLE_3D = {.name = "bubble and pulse",
                                            .dim = 3,
                                            .n = 16,
                                            .base = 8,
                                            .levels = 6,
                                            .n_feature = 3,
                                            .features = {{SETS_SHELL, {1.0, 1.0, 1.0}, 0.15, 6, true},
                                                         {SETS_BALL, {1.0, 1.0, 1.0}, 0.18, 4, false},
                                                         {SETS_PLANE, {0.0, 0.0, 0.0}, 1.3, 3, false}}};

static void study_start(struct study *study, struct sets_scene scene, int n)
{
    *study = (struct study){.scene = scene};
    study->scene.base = scene.base * scene.n / n; /* the same cells in other tiles */
    study->scene.n = n;
    sets_make(&study->scene, &study->mesh);
    study->mesh.n_field = 5 + (unsigned)scene.dim; /* two materials: alpha, m; momentum, energy */
    if (nest_check(&study->mesh)) {
        fprintf(stderr, "%s\n", status_text());
        exit(1);
    }
    for (int l = 0; l < study->mesh.n_level; l++) {
        study->graphs[l] = traffic_connect(&study->mesh, l);
        study->costs[l] = sets_costs(&study->scene, &study->mesh, l);
        study->tiles += study->mesh.levels[l].n_tile;
    }
}

static void study_stop(struct study *study)
{
    for (int l = 0; l < study->mesh.n_level; l++) {
        traffic_free_graph(&study->graphs[l]);
        mem_free(study->costs[l]);
        level_drop(&study->mesh.levels[l]);
    }
}

static void study_cut_levels(struct study *study, int size)
{
    double *load = mem_new((size_t)size, sizeof *load);
    for (int l = 0; l < study->mesh.n_level; l++) {
        struct level *level = &study->mesh.levels[l];
        partition_cut(level->tiles, level->n_tile, study->costs[l], size, ldexp(1.0, l), load);
    }
    mem_free(load);
}

/* A tile on the one curve through all levels: by its first descendant on the finest, coarser tiles first. */
struct study_place {
    uint64_t key;
    int level;
    unsigned index;
};

static int study_compare_places(const void *a, const void *b)
{
    const struct study_place *x = a, *y = b;
    if (x->key != y->key) return x->key < y->key ? -1 : 1;
    return x->level - y->level;
}

static void study_cut_curve(struct study *study, int size)
{
    size_t n = (size_t)study->tiles, count = 0;
    struct study_place *places = mem_new(n, sizeof *places);
    struct tile *tiles = mem_new(n, sizeof *tiles);
    double *costs = mem_new(n, sizeof *costs), *load = mem_new((size_t)size, sizeof *load);
    int finest = study->mesh.n_level - 1;
    for (int l = 0; l <= finest; l++)
        for (unsigned i = 0; i < study->mesh.levels[l].n_tile; i++)
            places[count++] = (struct study_place){study->mesh.levels[l].tiles[i].key << 3 * (finest - l), l, i};
    qsort(places, n, sizeof *places, study_compare_places);
    for (size_t i = 0; i < n; i++) costs[i] = ldexp(study->costs[places[i].level][places[i].index], places[i].level);
    partition_cut(tiles, (unsigned)n, costs, size, 1.0, load);
    for (size_t i = 0; i < n; i++) study->mesh.levels[places[i].level].tiles[places[i].index].rank = tiles[i].rank;
    mem_free(places);
    mem_free(tiles);
    mem_free(costs);
    mem_free(load);
}

static struct traffic study_count(const struct study *study, int size)
{
    struct traffic traffic;
    traffic_count(&study->mesh, study->graphs, study->costs, size, &traffic);
    return traffic;
}

/* Ideal over real compute time of a coarse step, each sub-step of each level waiting for its slowest rank. */
static double study_efficiency(const struct study *study, const struct traffic *traffic)
{
    double mean = 0.0, most = 0.0;
    for (int l = 0; l < study->mesh.n_level; l++) {
        mean += ldexp(traffic->mean[l], l);
        most += ldexp(traffic->most[l], l);
    }
    return mean / most;
}

static void study_print_sets(const struct study *study)
{
    printf("| %s | %dD | %d | %.3g |", study->scene.name, study->scene.dim, study->scene.n, study->tiles);
    double updates = 0.0,
           uniform = ldexp((double)study->mesh.levels[0].n_tile, study->scene.levels * (study->scene.dim + 1));
    for (int l = 0; l < study->mesh.n_level; l++) {
        printf("%s%u", l ? ", " : " ", study->mesh.levels[l].n_tile);
        updates += ldexp(study->mesh.levels[l].n_tile, l);
    }
    printf(" | %.2g | %.1e |\n", updates * (double)study->mesh.n_cell, updates / uniform);
}

static void study_print_efficiency(struct study *study, int n_size, const int *sizes)
{
    for (int s = 0; s < n_size; s++) {
        study_cut_curve(study, sizes[s]);
        struct traffic curve = study_count(study, sizes[s]);
        study_cut_levels(study, sizes[s]);
        struct traffic traffic = study_count(study, sizes[s]);
        printf("| %s %dD, %d | %d | %.3f | %.3f | %.2f / %.2f |", study->scene.name, study->scene.dim, study->scene.n,
               sizes[s], study_efficiency(study, &curve), study_efficiency(study, &traffic), curve.remote_parents,
               traffic.remote_parents);
        for (int l = 0; l < study->mesh.n_level; l++) {
            const struct level *level = &study->mesh.levels[l];
            printf("%s%.2f", l ? ", " : " ",
                   partition_imbalance(level->tiles, level->n_tile, study->costs[l], sizes[s]));
        }
        printf(" |\n");
    }
}

/* Bytes and messages per coarse step of the most loaded rank of each phase, phases added up. */
static void study_print_traffic(const struct study *study, int size)
{
    struct traffic traffic = study_count(study, size);
    double halo = 0.0, down = 0.0, up = 0.0, messages = 0.0, exchanges = 0.0, sum = 0.0;
    for (int l = 0; l < study->mesh.n_level; l++) {
        double steps = ldexp(1.0, l);
        halo += 2.0 * steps * traffic.halo[l].most_bytes;
        down += 0.5 * steps * traffic.down[l].most_bytes;
        up += 0.5 * steps * traffic.up[l].most_bytes;
        messages += steps * (2.0 * traffic.halo[l].most_messages +
                             0.5 * (traffic.down[l].most_messages + traffic.up[l].most_messages));
        exchanges += steps * (l ? 3.0 : 2.0);
        sum += steps * (2.0 * traffic.halo[l].bytes + 0.5 * (traffic.down[l].bytes + traffic.up[l].bytes));
    }
    printf("| %s %dD, %d | %d | %.3g | %.3g | %.3g | %.3g | %.0f | %.1f |\n", study->scene.name, study->scene.dim,
           study->scene.n, size, halo / 1e6, down / 1e6, up / 1e6, sum / size / 1e6, messages, messages / exchanges);
}

static double study_clock(void)
{
    return (double)clock() / CLOCKS_PER_SEC;
}

struct study_times {
    double sets, list, cover, check, cut;
};

/* CPU time of what every rank does at a regrid from level 0 that replaces all levels by what they are. */
static struct study_times study_regrid(struct study *study, int size)
{
    struct mesh *mesh = &study->mesh;
    struct nest_keys wishes[MESH_LEVELS] = {0};
    struct nest_set sets[MESH_LEVELS] = {0};
    struct study_times times;
    for (int l = 1; l < mesh->n_level; l++) wishes[l] = sets_wishes(&study->scene, mesh, l);
    double start = study_clock();
    nest_sets(mesh, 0, wishes, 2, sets);
    times.sets = study_clock() - start;
    start = study_clock();
    for (int l = 1; l < mesh->n_level; l++) {
        for (unsigned i = 0; i < sets[l].n; i++) sets[l].tiles[i].rank = mesh->levels[l].tiles[i].rank;
        level_adopt(&mesh->levels[l], sets[l].tiles, sets[l].n);
        nest_free_keys(&wishes[l]);
    }
    times.list = study_clock() - start;
    start = study_clock();
    for (int l = 0; l < mesh->n_level; l++) level_cover(mesh, l);
    times.cover = study_clock() - start;
    start = study_clock();
    if (nest_check(mesh)) exit(1);
    times.check = study_clock() - start;
    start = study_clock();
    study_cut_levels(study, size);
    times.cut = study_clock() - start;
    return times;
}

static void study_least(double *least, double value, int repeat)
{
    if (!repeat || value < *least) *least = value;
}

/* Bytes per tile that every rank holds: the list and the table that finds tiles. */
static double study_bytes(const struct study *study)
{
    double bytes = 0.0;
    for (int l = 0; l < study->mesh.n_level; l++) {
        const struct level *level = &study->mesh.levels[l];
        bytes += (double)level->n_tile * sizeof *level->tiles + ldexp(sizeof *level->table, level->table_bits);
    }
    return bytes / study->tiles;
}

static void study_print_topology(struct study *study, int size)
{
    struct study_times least = {0};
    for (int repeat = 0; repeat < STUDY_REPEATS; repeat++) {
        struct study_times times = study_regrid(study, size);
        study_least(&least.sets, times.sets, repeat);
        study_least(&least.list, times.list, repeat);
        study_least(&least.cover, times.cover, repeat);
        study_least(&least.check, times.check, repeat);
        study_least(&least.cut, times.cut, repeat);
    }
    double per = 1e9 / study->tiles, all = least.sets + least.list + least.cover + least.check + least.cut;
    study->topology = all / study->tiles;
    study->idle = least.sets / study->tiles;
    printf("| %s %dD, %d | %.3g | %.0f | %.1f | %.0f | %.0f | %.0f | %.0f | %.0f | %.0f |\n", study->scene.name,
           study->scene.dim, study->scene.n, study->tiles, study_bytes(study), study_bytes(study) * study->tiles / 1e6,
           per * least.sets, per * least.list, per * least.cover, per * least.check, per * least.cut, per * all);
}

/* Tiles in all the regrids of a coarse step: one from base b replaces the levels above b. It is due every
 * STUDY_REGRID steps of level b, unless one from a coarser base is. */
static double study_regridded(const struct study *study)
{
    double tiles = 0.0, above = 0.0;
    for (int b = study->mesh.n_level - 2; b >= 0; b--) {
        above += study->mesh.levels[b + 1].n_tile;
        tiles += above * ldexp(1.0, b) / STUDY_REGRID * (b ? 0.5 : 1.0);
    }
    return tiles;
}

static double study_phase(const struct traffic_phase *phase, double byte)
{
    return phase->most_messages * STUDY_MESSAGE + phase->most_bytes * byte;
}

struct study_projection {
    double compute, wait, network, shared; /* seconds per coarse step; shared: 64 ranks share a link */
    double topology;
};

static struct study_projection study_project(const struct study *study, int size)
{
    struct traffic traffic = study_count(study, size);
    struct study_projection p = {0};
    double stage = 2.0 * STUDY_CELL * (double)study->mesh.n_cell;
    for (int l = 0; l < study->mesh.n_level; l++) {
        double steps = ldexp(1.0, l);
        p.compute += steps * stage * traffic.mean[l];
        p.wait += steps * stage * (traffic.most[l] - traffic.mean[l]);
        for (int shared = 0; shared < 2; shared++) {
            double byte = shared ? 64.0 * STUDY_BYTE : STUDY_BYTE, *to = shared ? &p.shared : &p.network;
            *to += 2.0 * steps * study_phase(&traffic.halo[l], byte);
            *to += 0.5 * steps * (study_phase(&traffic.down[l], byte) + study_phase(&traffic.up[l], byte));
        }
    }
    p.topology = study->topology * study_regridded(study);
    return p;
}

static void study_print_projection(struct study *study, int size)
{
    study_cut_levels(study, size);
    struct study_projection p = study_project(study, size);
    double ideal = p.compute, busy = p.compute + p.wait;
    printf("| %s %dD, %d | %d | %.2f | %.3g | %.2f | %.2f | %.2f | %.2f | %.2f |\n", study->scene.name,
           study->scene.dim, study->scene.n, size, study->tiles / size, 1e3 * ideal, ideal / busy,
           ideal / (busy + p.network), ideal / (busy + p.network + p.topology), ideal / (busy + p.shared + p.topology),
           p.topology / ideal);
}

/* Share of tiles present before and after that change owner when the features grow by one buffer's width. */
static void study_print_moves(const struct study *study, int size)
{
    struct sets_scene grown = study->scene;
    for (int f = 0; f < grown.n_feature; f++)
        grown.features[f].radius += 2.0 / ((double)grown.base * grown.n) / ldexp(1.0, grown.features[f].finest) * 4.0;
    struct study after;
    study_start(&after, grown, grown.n);
    study_cut_levels(&after, size);
    double same = 0.0, moved = 0.0, born = 0.0;
    for (int l = 1; l < after.mesh.n_level; l++)
        for (unsigned i = 0; i < after.mesh.levels[l].n_tile; i++) {
            const struct tile *tile = &after.mesh.levels[l].tiles[i];
            int index = level_find(&study->mesh.levels[l], tile->key);
            if (index < 0) born++;
            else if (study->mesh.levels[l].tiles[index].rank == tile->rank) same++;
            else moved++;
        }
    double all = same + moved + born;
    printf("| %s %dD, %d | %d | %.2f | %.2f | %.2f |\n", study->scene.name, study->scene.dim, study->scene.n, size,
           born / all, moved / all, same / all);
    study_stop(&after);
}

static void study_head(const char *title, const char *columns)
{
    printf("\n### %s\n\n%s\n|", title, columns);
    for (const char *c = columns + 1; *c; c++)
        if (*c == '|') printf(" --- |");
    printf("\n");
}

static void study_tables(struct study *studies, int n_study)
{
    study_head("Sets", "| set | dim | n | tiles | by level | cell-steps per coarse step | of the uniform grid's |");
    for (int i = 0; i < n_study; i++) study_print_sets(&studies[i]);
    study_head("Balance", "| set | ranks | one curve | per level | remote parents | imbalance by level |");
    for (int i = 0; i < n_study; i++) study_print_efficiency(&studies[i], STUDY_RANKS, RANKS);
    study_head("Traffic", "| set | ranks | halo, MB | down, MB | up, MB | mean rank, MB | messages | per exchange |");
    for (int i = 0; i < n_study; i++)
        for (int s = 0; s < STUDY_RANKS; s++) {
            study_cut_levels(&studies[i], RANKS[s]);
            study_print_traffic(&studies[i], RANKS[s]);
        }
    study_head("Topology",
               "| set | tiles | bytes per tile | MB per rank | sets, ns | list | cover | check | cut | all |");
    for (int i = 0; i < n_study; i++) study_print_topology(&studies[i], 1000);
    study_head("Projection",
               "| set | ranks | tiles per rank | ideal, ms | balance | + network | + topology | link shared | "
               "topology / ideal |");
    for (int i = 0; i < n_study; i++)
        for (int s = 0; s < STUDY_RANKS; s++) study_print_projection(&studies[i], RANKS[s]);
    study_head("Moves", "| set | ranks | born | moved | stayed |");
    for (int i = 0; i < n_study; i++)
        for (int s = 0; s < 3; s++) {
            study_cut_levels(&studies[i], RANKS[s]);
            study_print_moves(&studies[i], RANKS[s]);
        }
}

static int study_expect(bool holds, const char *what)
{
    if (!holds) printf("does not hold: %s\n", what);
    return !holds;
}

/* Small sets: the known advantage of cuts per level, and that a rank alone neither waits nor sends. */
static int study_tiny(void)
{
    struct sets_scene scenes[2] = {SHELL_2D, SHELL_3D};
    int failed = 0;
    for (int i = 0; i < 2; i++) {
        struct study study;
        scenes[i].levels = scenes[i].features[0].finest = 3;
        study_start(&study, scenes[i], 16);
        study_print_sets(&study);
        study_print_efficiency(&study, 1, (const int[]){48});
        study_cut_levels(&study, 48);
        struct traffic traffic = study_count(&study, 48);
        double per_level = study_efficiency(&study, &traffic);
        failed += study_expect(traffic.halo[3].bytes > 0.0 && traffic.down[3].bytes > 0.0, "levels exchange");
        study_cut_curve(&study, 48);
        traffic = study_count(&study, 48);
        failed += study_expect(per_level > study_efficiency(&study, &traffic), "cuts per level balance better");
        failed += study_expect(per_level > 0.9, "cuts per level balance well");
        study_cut_levels(&study, 1);
        traffic = study_count(&study, 1);
        failed += study_expect(study_efficiency(&study, &traffic) == 1.0, "one rank never waits");
        for (int l = 0; l < study.mesh.n_level; l++)
            failed += study_expect(traffic.halo[l].bytes + traffic.down[l].bytes + traffic.up[l].bytes == 0.0,
                                   "one rank sends nothing");
        study_print_topology(&study, 48);
        study_stop(&study);
    }
    return failed;
}

int main(int argc, char **argv)
{
    if (argc == 2 && !strcmp(argv[1], "tiny")) return study_tiny() != 0;
    const struct sets_scene *scenes[4] = {&SHELL_2D, &BUBBLE_2D, &SHELL_3D, &BUBBLE_3D};
    static struct study studies[8];
    for (int i = 0; i < 8; i++) study_start(&studies[i], *scenes[i / 2], i % 2 ? 8 : 16);
    study_tables(studies, 8);
    for (int i = 0; i < 8; i++) study_stop(&studies[i]);
    return 0;
}
