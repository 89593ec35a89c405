/* partition_study.c - what many ranks would cost: cuts of real tile sets simulated for 12 to 10^5 ranks, as tables.
 *
 *     build/tests/partition-study [tiny | topology | coarse]
 *
 * docs/scaling.md holds its output and says what it means. `tiny` takes small sets and few ranks, checks that the
 * figures hang together, and exits with 1 where they do not; it is what the test suite runs. */
#include "moves.h"
#include "pieces.h"
#include "study.h"

#include "../unit/replicated.h"
#include "base/mem.h"
#include "mesh/doze.h"
#include "mesh/level.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

enum { STUDY_REGRID = 4, STUDY_RANKS = 6, STUDY_REPEATS = 5, STUDY_MEETINGS = 9, STUDY_RIPPLE = 2 };

/* The machine of the projection: seconds per cell and stage of cost 1, per message, per byte. */
static const double STUDY_CELL = 45e-9, STUDY_MESSAGE = 2e-6, STUDY_BYTE = 1e-10;

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
            printf("%s%.2f", l ? ", " : " ", study_imbalance(level->tiles, level->n_tile, study->costs[l], sizes[s]));
        }
        printf(" |\n");
    }
}

/* Regrids from level b in a coarse step: one is due every STUDY_REGRID steps of the level, unless one from a coarser
 * one is. */
static double study_regrids(int b)
{
    return ldexp(1.0, b) / STUDY_REGRID * (b ? 0.5 : 1.0);
}

/* How often in a coarse step the tiles of level l that sleep `depth` levels deep are woken: after the steps of the
 * level that they sleep down to, and before regrids from levels between. */
static double study_wakes(int l, int depth)
{
    int down = l - depth;
    double wakes = down >= 0 ? ldexp(1.0, down) : 0.0;
    for (int b = down + 1; b <= l; b++) wakes += study_regrids(b);
    return wakes;
}

/* Registers and averages of level l and the one below in a coarse step: what each exchange costs, by `measure`.
 * eager: as if no tile slept. */
static double study_up(const struct traffic *traffic, int l, bool eager,
                       double (*measure)(const struct traffic_phase *phase))
{
    double sum = 0.5 * ldexp(1.0, l) * measure(eager ? &traffic->eager[l] : &traffic->up[l]);
    for (int depth = 1; depth <= l && !eager; depth++)
        sum += study_wakes(l - 1, depth) * measure(&traffic->late[l][depth]);
    return sum;
}

static double study_most_bytes(const struct traffic_phase *phase)
{
    return phase->most_bytes;
}

static double study_all_bytes(const struct traffic_phase *phase)
{
    return phase->bytes;
}

static double study_most_messages(const struct traffic_phase *phase)
{
    return phase->most_messages;
}

/* Bytes and messages per coarse step of the most loaded rank of each phase, phases added up. */
static void study_print_traffic(const struct study *study, int size)
{
    struct traffic traffic = study_count(study, size);
    double halo = 0.0, down = 0.0, up = 0.0, eager = 0.0, messages = 0.0, eager_messages = 0.0, sum = 0.0;
    for (int l = 0; l < study->mesh.n_level; l++) {
        double steps = ldexp(1.0, l), rest = 2.0 * traffic.halo[l].most_messages + 0.5 * traffic.down[l].most_messages;
        halo += 2.0 * steps * traffic.halo[l].most_bytes;
        down += 0.5 * steps * traffic.down[l].most_bytes;
        up += study_up(&traffic, l, false, study_most_bytes);
        eager += study_up(&traffic, l, true, study_most_bytes);
        messages += steps * rest + study_up(&traffic, l, false, study_most_messages);
        eager_messages += steps * rest + study_up(&traffic, l, true, study_most_messages);
        sum += steps * (2.0 * traffic.halo[l].bytes + 0.5 * traffic.down[l].bytes) +
               study_up(&traffic, l, false, study_all_bytes);
    }
    printf("| %s %dD, %d | %d | %.3g | %.3g | %.3g | %.3g | %.3g | %.0f | %.0f |", study->scene.name, study->scene.dim,
           study->scene.n, size, halo / 1e6, down / 1e6, eager / 1e6, up / 1e6, sum / size / 1e6, eager_messages,
           messages);
    for (int l = 0; l < study->mesh.n_level; l++) printf("%s%.2f", l ? ", " : " ", traffic.deep[l]);
    printf(" |\n");
}

static double study_clock(void)
{
    return (double)clock() / CLOCKS_PER_SEC;
}

struct study_times {
    double sets, list, find, cover, check, cut;
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
        replicated_adopt(&mesh->levels[l], sets[l].tiles, sets[l].n); /* of one rank */
        nest_keys_free(&wishes[l]);
    }
    times.list = study_clock() - start;
    start = study_clock();
    for (int l = 1; l < mesh->n_level; l++) /* as costs are carried to a new list */
        for (unsigned i = 0; i < mesh->levels[l].n_tile; i++)
            if (mesh_find(mesh, &mesh->levels[l], mesh->levels[l].tiles[i].at) != (int)i) exit(1);
    times.find = study_clock() - start;
    start = study_clock();
    for (int l = 0; l < mesh->n_level; l++) level_cover(mesh, l);
    for (int l = 0; l < mesh->n_level; l++) doze_level(mesh, l);
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
        bytes += (double)level->n_tile * sizeof *level->tiles + ldexp(sizeof *level->slots.taken, level->slots.bits);
    }
    return bytes / study->tiles;
}

/* Compute time of a step of a tile of cost 1: two stages. */
static double study_step(const struct study *study)
{
    return 2.0 * STUDY_CELL * (double)study->mesh.n_cell;
}

/* Tiles in all the regrids of a coarse step: one from base b replaces the levels above b. */
static double study_regridded(const struct study *study)
{
    double tiles = 0.0, above = 0.0;
    for (int b = study->mesh.n_level - 2; b >= 0; b--) {
        above += study->mesh.levels[b + 1].n_tile;
        tiles += above * study_regrids(b);
    }
    return tiles;
}

static void study_print_topology(struct study *study, int size)
{
    struct study_times least = {0};
    for (int repeat = 0; repeat < STUDY_REPEATS; repeat++) {
        struct study_times times = study_regrid(study, size);
        study_least(&least.sets, times.sets, repeat);
        study_least(&least.list, times.list, repeat);
        study_least(&least.find, times.find, repeat);
        study_least(&least.cover, times.cover, repeat);
        study_least(&least.check, times.check, repeat);
        study_least(&least.cut, times.cut, repeat);
    }
    double per = 1e9 / study->tiles, all = least.sets + least.list + least.find + least.cover + least.check + least.cut;
    study->topology = all / study->tiles;
    double share = study->topology * study_regridded(study) / (study_step(study) * study_work(study)); /* on one rank */
    printf("| %s %dD, %d | %.3g | %.0f | %.1f | %.0f | %.0f | %.0f | %.0f | %.0f | %.0f | %.0f | %.0f | %.0f |\n",
           study->scene.name, study->scene.dim, study->scene.n, study->tiles, study_bytes(study),
           study_bytes(study) * study->tiles / 1e6, per * least.sets, per * least.list, per * least.find,
           per * least.cover, per * least.check, per * least.cut, per * all, 0.03 / share, 0.1 / share);
}

/* Each rank posts its messages one after the other; its bytes, or those that its node's link carries, follow. */
static double study_phase(const struct traffic_phase *phase)
{
    double bytes = phase->most_bytes > phase->node_bytes ? phase->most_bytes : phase->node_bytes;
    return phase->most_messages * STUDY_MESSAGE + bytes * STUDY_BYTE;
}

struct study_projection {
    double compute, wait, network, topology; /* seconds per coarse step */
    double eager;                            /* the network if no tile slept */
};

static struct study_projection study_project(const struct study *study, int size)
{
    struct traffic traffic = study_count(study, size);
    struct study_projection p = {.topology = study->topology * study_regridded(study)};
    double step = study_step(study);
    for (int l = 0; l < study->mesh.n_level; l++) {
        double steps = ldexp(1.0, l);
        p.compute += steps * step * traffic.mean[l];
        p.wait += steps * step * (traffic.most[l] - traffic.mean[l]);
        double rest = 2.0 * steps * study_phase(&traffic.halo[l]) + 0.5 * steps * study_phase(&traffic.down[l]);
        p.network += rest + study_up(&traffic, l, false, study_phase);
        p.eager += rest + study_up(&traffic, l, true, study_phase);
    }
    return p;
}

static void study_print_projection(struct study *study, int size)
{
    study_cut_levels(study, size);
    struct study_projection p = study_project(study, size);
    double busy = p.compute + p.wait;
    printf("| %s %dD, %d | %d | %.3g | %.3g | %.2f | %.2f | %.2f | %.2f | %.3f |\n", study->scene.name,
           study->scene.dim, study->scene.n, size, study->tiles / size, 1e3 * p.compute, p.compute / busy,
           p.compute / (busy + p.eager), p.compute / (busy + p.network), p.compute / (busy + p.network + p.topology),
           p.topology / p.compute);
}

/* Meetings of all ranks in all regrids of a coarse step: of a regrid STUDY_MEETINGS, and STUDY_RIPPLE for each level
 * that is made anew. */
static double study_meetings(const struct study *study)
{
    int finest = study->mesh.n_level - 1;
    double meetings = 0.0;
    for (int b = 0; b < finest; b++) meetings += (STUDY_MEETINGS + STUDY_RIPPLE * (finest - b)) * study_regrids(b);
    return meetings;
}

/* Seconds of a rank in all regrids of a coarse step: its piece, waiting for the cut, which follows the ranks of each
 * level that is cut more than its tiles, and messages. To meet takes two messages, there and back, for each doubling of
 * the ranks. */
static double study_shared(const struct study *study, const struct pieces *pieces, int size)
{
    double regrids = study_regridded(study) / study->tiles;
    double meetings = study_meetings(study) * 2.0 * ceil(log2(size)), cuts = 0.0;
    for (int b = 0; b + 1 < study->mesh.n_level; b++) cuts += study_regrids(b) * pieces->cut[b];
    return cuts + regrids * (pieces->most + (pieces->bytes + pieces->joined) * STUDY_BYTE) +
           (regrids * pieces->messages + meetings) * STUDY_MESSAGE;
}

static void study_print_pieces(struct study *study, int size)
{
    study_cut_levels(study, size);
    struct pieces pieces = pieces_regrid(study, size);
    struct study_projection p = study_project(study, size);
    double shared = study_shared(study, &pieces, size), busy = p.compute + p.wait + p.network;
    printf("| %s %dD, %d | %d | %.3g | %.3g | %.2g | %.2g | %.2g | %.0f | %.2g | %.2g | %.2g | %.3g | %.2g | %.3f | "
           "%.3f | %.2f | %.2f |\n",
           study->scene.name, study->scene.dim, study->scene.n, size, study->tiles / size,
           1e3 * study->topology * study->tiles, 1e3 * pieces.mean, 1e3 * pieces.most, 1e3 * pieces.cut[0],
           pieces.messages, pieces.bytes / 1e3, pieces.held / 1e3, pieces.table / 1e3, pieces.files_of_all / 1e3,
           pieces.files / 1e3, p.topology / p.compute, shared / p.compute, p.compute / (busy + p.topology),
           p.compute / (busy + shared));
}

static void study_head(const char *title, const char *columns)
{
    printf("\n### %s\n\n%s\n|", title, columns);
    for (const char *c = columns + 1; *c; c++)
        if (*c == '|') printf(" --- |");
    printf("\n");
}

static void study_topology(struct study *studies, int n_study)
{
    study_head("Topology",
               "| set | tiles | bytes per tile | MB per rank | sets, ns | list | find | cover | check | cut | all "
               "| ranks at 3 % | at 10 % |");
    for (int i = 0; i < n_study; i++) study_print_topology(&studies[i], 1000);
}

/* What each rank does at a regrid: with a list of all tiles on all ranks, and now. */
static void study_pieces(struct study *studies, int n_study)
{
    study_head("Pieces",
               "| set | ranks | tiles per rank | list of all, ms | piece, mean | most | cut "
               "| messages | kB | kB known | kB of keys | kB in files, list | now | topology / ideal, list | now "
               "| efficiency, list | now |");
    for (int i = 0; i < n_study; i++)
        for (int s = 0; s < STUDY_RANKS; s++) study_print_pieces(&studies[i], RANKS[s]);
}

static void study_tables(struct study *studies, int n_study)
{
    study_head("Sets", "| set | dim | n | tiles | by level | cell-steps per coarse step | of the uniform grid's |");
    for (int i = 0; i < n_study; i++) study_print_sets(&studies[i]);
    study_head("Balance", "| set | ranks | one curve | per level | remote parents | imbalance by level |");
    for (int i = 0; i < n_study; i++) study_print_efficiency(&studies[i], STUDY_RANKS, RANKS);
    study_head("Traffic",
               "| set | ranks | halo, MB | down, MB | up if none slept, MB | up, MB | mean rank, MB | messages if none "
               "slept | messages | asleep, by level |");
    for (int i = 0; i < n_study; i++)
        for (int s = 0; s < STUDY_RANKS; s++) {
            study_cut_levels(&studies[i], RANKS[s]);
            study_print_traffic(&studies[i], RANKS[s]);
        }
    study_topology(studies, n_study);
    study_head("Projection", "| set | ranks | tiles per rank | ideal, ms | balance | + network if none "
                             "slept | + network | + topology | "
                             "topology / ideal |");
    for (int i = 0; i < n_study; i++)
        for (int s = 0; s < STUDY_RANKS; s++) study_print_projection(&studies[i], RANKS[s]);
    study_pieces(studies, n_study);
    study_head("Moves", "| set | ranks | owners | born | moved | to another node | efficiency |");
    for (int i = 0; i < n_study; i += 2)
        for (int s = 1; s < 4; s++)
            for (int keep = 0; keep < 2; keep++) moves_print(&studies[i], RANKS[s], keep);
}

/* Levels with fewer tiles than ranks in pieces of k tiles; k = 0: cut as they are. */
static void study_print_coarse(struct study *study, int size, int k)
{
    if (k) study_cut_coarse(study, size, k);
    else study_cut_levels(study, size);
    struct traffic traffic = study_count(study, size);
    struct study_projection p = study_project(study, size);
    double messages = 0.0, bytes = 0.0, busy = p.compute + p.wait;
    for (int l = 0; l < study->mesh.n_level; l++) {
        double steps = ldexp(1.0, l);
        messages += steps * (2.0 * traffic.halo[l].most_messages + 0.5 * traffic.down[l].most_messages) +
                    study_up(&traffic, l, false, study_most_messages);
        bytes += steps * (2.0 * traffic.halo[l].most_bytes + 0.5 * traffic.down[l].most_bytes) +
                 study_up(&traffic, l, false, study_most_bytes);
    }
    printf("| %s %dD, %d | %d | %d | %.0f | %.3g | %.3f | %.3f |\n", study->scene.name, study->scene.dim,
           study->scene.n, size, k, messages, bytes / 1e6, p.compute / busy, p.compute / (busy + p.network));
}

static void study_coarse(struct study *studies, int n_study)
{
    static const int pieces[] = {0, 1, 2, 4, 8};
    study_head("Coarse levels on fewer ranks", "| set | ranks | k | messages | MB | balance | + network |");
    for (int i = 0; i < n_study; i++)
        for (int s = 1; s < STUDY_RANKS; s++)
            for (int j = 0; j < 5; j++) study_print_coarse(&studies[i], RANKS[s], pieces[j]);
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
        study_print_pieces(&study, 48);
        study_stop(&study);
    }
    return failed;
}

int main(int argc, char **argv)
{
    if (argc == 2 && !strcmp(argv[1], "tiny")) return study_tiny() != 0;
    const struct sets_scene *scenes[4] = {&SHELL_2D, &BUBBLE_2D, &SHELL_3D, &BUBBLE_3D};
    static struct study studies[8];
    setvbuf(stdout, NULL, _IOLBF, 0);
    bool all = argc < 2, coarse = argc == 2 && !strcmp(argv[1], "coarse"); /* else tiles of 16 alone, and one table */
    int n_study = all ? 8 : 4;
    for (int i = 0; i < n_study; i++) study_start(&studies[i], *scenes[all ? i / 2 : i], all && i % 2 ? 8 : 16);
    if (all) study_tables(studies, n_study);
    else if (coarse) study_coarse(studies, n_study);
    else {
        study_topology(studies, n_study);
        study_pieces(studies, n_study);
    }
    for (int i = 0; i < n_study; i++) study_stop(&studies[i]);
    return 0;
}
