/* Who writes or reads a file or adds up a history holds its own tiles and what lies around them, never the list of all:
 * on several ranks (program/ranks_mesh.sh starts them) all but the last have the same tiles in a small domain and in
 * one of four times as many, and what they take to write a snapshot and a checkpoint and for sums is the same; of the
 * list of tiles in a checkpoint they take an equal part. */
#include "base/comm.h"
#include "io/checkpoint.h"
#include "io/resume.h"
#include "io/roll.h"
#include "io/snapshot.h"
#include "mesh/tally.h"
#include "replicated.h"
#include "small.h"

#include <malloc.h>

/* Tiles of all ranks but the last; tiles along a side of the domains; bytes by which blocks of the same use may differ
 * (packed numbers, what the C library rounds to): less than two per tile that is more. */
enum { OWN = 64, FEW = 92, MANY = 2 * FEW, SLACK = 4096 };

/* Bytes that are in use, most of them so far, and all that were asked for. */
static long long used, most, asked;

void *__real_mem_new(size_t count, size_t size);
void *__real_mem_new_large(size_t count, size_t size);
void *__real_mem_grow(void *block, size_t old_count, size_t new_count, size_t size);
void __real_mem_free(void *block);
void *__wrap_mem_new(size_t count, size_t size);
void *__wrap_mem_new_large(size_t count, size_t size);
void *__wrap_mem_grow(void *block, size_t old_count, size_t new_count, size_t size);
void __wrap_mem_free(void *block);

static void *count_in(void *block)
{
    used += (long long)malloc_usable_size(block);
    asked += (long long)malloc_usable_size(block);
    if (used > most) most = used;
    return block;
}

void *__wrap_mem_new(size_t count, size_t size)
{
    return count_in(__real_mem_new(count, size));
}

void *__wrap_mem_new_large(size_t count, size_t size)
{
    return count_in(__real_mem_new_large(count, size));
}

void *__wrap_mem_grow(void *block, size_t old_count, size_t new_count, size_t size)
{
    used -= (long long)malloc_usable_size(block);
    return count_in(__real_mem_grow(block, old_count, new_count, size));
}

void __wrap_mem_free(void *block)
{
    used -= (long long)malloc_usable_size(block);
    __real_mem_free(block);
}

/* Water in `side` x `side` tiles of 4 x 4 cells, wherever the domain ends; nothing is kept from one file to the next.
 */
static char *scene_of(int side, int writers)
{
    return mem_print("bulla: 1\ntitle: Water\ndomain: {lower: [0, 0], upper: [%d, %d], cells: [%d, %d],\n"
                     "  boundaries: {x-: outflow, x+: outflow, y-: outflow, y+: outflow}}\nmesh: {tile: 4}\n%s"
                     "initial:\n  - {everywhere: true, material: water, density: 1000, pressure: 1e5}\n"
                     "run: {until: 1 us}\noutput: {writers: %d, snapshots: {every: 1 us, memory: 0}}\n",
                     side, side, 4 * side, 4 * side, SMALL_MATERIALS, writers);
}

/* The first tiles along the curve go to the lower ranks, all others to the last. */
static void share(struct mesh *mesh)
{
    unsigned n = mesh->levels[0].n_tile;
    uint64_t *keys = mem_new(n, sizeof *keys);
    struct tile *tiles = mem_new(n, sizeof *tiles);
    struct mesh_change change;
    unsigned known = 0;
    for (unsigned i = 0; i < mesh->levels[0].n_local; i++)
        keys[i] = mesh->levels[0].tiles[mesh->levels[0].first + i].key;
    uint64_t *all = comm_join_keys(keys, mesh->levels[0].n_local, &known);
    assert_int_equal(known, n);
    for (unsigned i = 0; i < n; i++) {
        int rank = (int)i / OWN, last = comm_size() - 1;
        tiles[i] = (struct tile){.key = all[i], .rank = rank < last ? rank : last};
        morton_at(all[i], tiles[i].at);
    }
    replicated_replace(mesh, 0, tiles, n, &change);
    mesh_change_free(&change);
    mem_free(all);
    mem_free(keys);
}

enum { SNAPSHOT, SNAPSHOT_ALL, CHECKPOINT, CHECKPOINT_ALL, SUMS, SUMS_ALL, READ, READ_ALL, BYTES };

/* Bytes since `before`, when so much was in use and had been asked for: most in use, and all. */
static void tell(const long long before[2], long long ret_bytes[2])
{
    ret_bytes[0] = most - before[0];
    ret_bytes[1] = asked - before[1];
}

/* Totals of as many values as some columns of a history have. */
static void add_up(const struct mesh *mesh)
{
    enum { VALUES = 24 };
    size_t n = tally_tiles(mesh) * VALUES;
    double *local = mem_new(n + 1, sizeof *local), totals[VALUES];
    for (size_t i = 0; i < n; i++) local[i] = (double)(i % VALUES);
    tally_add(mesh, VALUES, local, totals);
    for (int i = 0; i < VALUES; i++) assert_true(totals[i] == (double)mesh->levels[0].n_tile * i);
    mem_free(local);
}

/* The checkpoint that has just been written: its lists of tiles. */
static void read_back(const struct small *small)
{
    struct resume *resume;
    assert_int_equal(resume_newest(small->scene->output.directory, &resume), 0);
    assert_int_equal(resume->n_tile[0], small->state->mesh->levels[0].n_tile);
    resume_close(resume);
}

/* What is taken while a snapshot and a checkpoint are written, for the row of a history, and for a restart. */
static void weigh(int side, long long ret_bytes[BYTES])
{
    struct small small;
    struct snapshots *snapshots;
    struct notes notes = {0};
    char *text = scene_of(side, 1);
    small_start(&small, text);
    share(small.state->mesh);
    assert_int_equal(small.state->mesh->levels[0].n_tile, side * side);
    if (comm_rank() + 1 < comm_size()) assert_int_equal(small.state->mesh->levels[0].n_local, OWN);
    struct checkpoints *checkpoints = checkpoint_new(small.scene);
    assert_int_equal(snapshot_new(small.state, &snapshots), 0);
    const long long start[2] = {most = used, asked};
    assert_int_equal(snapshot_write(snapshots, small.state, SMALL_NOW(small.state), "{}"), 0);
    tell(start, ret_bytes + SNAPSHOT);
    const long long next[2] = {most = used, asked};
    assert_int_equal(checkpoint_write(checkpoints, small.state, &notes), 0);
    tell(next, ret_bytes + CHECKPOINT);
    const long long last[2] = {most = used, asked};
    add_up(small.state->mesh);
    tell(last, ret_bytes + SUMS);
    const long long back[2] = {most = used, asked};
    read_back(&small);
    tell(back, ret_bytes + READ);
    checkpoint_free(checkpoints);
    snapshot_free(snapshots);
    small_stop(&small);
    mem_free(text);
}

static void test_memory(void **state)
{
    (void)state;
    long long few[BYTES], many[BYTES];
    weigh(FEW, few);
    weigh(MANY, many);
    printf("rank %d of %d, bytes:", comm_rank(), comm_size());
    for (int i = 0; i < BYTES; i++) printf(" %lld %lld,", few[i], many[i]);
    printf("\n");
    const long long all = MANY * MANY * (sizeof(struct tile) + CHECKPOINT_TILE * sizeof(int32_t));
    if (comm_rank() > 0) /* tiles and rows of an equal part; rank 0 verifies the file, a MiB at a time */
        assert_true(many[READ] < all / comm_size() + all / 8);
    if (comm_rank() + 1 == comm_size()) return; /* it has the other tiles */
    for (int i = 0; i < READ; i++) {
        bool reads_back = comm_rank() == 0 && i == CHECKPOINT_ALL; /* by pieces, of small parts by smaller ones */
        if (!reads_back) assert_true(many[i] < few[i] + SLACK);
    }
}

/* The first and the last tile of this rank in the fields of the checkpoint. */
static int read_ends(const struct resume *resume, const struct mesh *mesh)
{
    size_t row = mesh->n_field * mesh->n_cell * sizeof(double), first = resume->first[0];
    double *rows = mem_new(row, 1);
    int code = resume_has_rows(resume, "/u", row);
    if (!code) code = resume_row(resume, "/u", first, row, rows);
    if (!code) code = resume_row(resume, "/u", first + resume->n_own[0] - 1, row, rows);
    mem_free(rows);
    return code;
}

/* Each rank is a writer, and takes its own tiles up again: rank 0 knows all parts, others the one that they wrote. Who
 * finds something wrong goes on: the others would wait for it for ever. */
static void test_parts(void **state)
{
    (void)state;
    struct small small;
    struct resume *resume;
    struct notes notes = {0};
    char *text = scene_of(12, comm_size()); /* 144 tiles: as many for each of 2, 3, 4 ranks */
    small_start(&small, text);
    comm_bcast(small.scene->output.directory, strlen(small.scene->output.directory));
    struct checkpoints *checkpoints = checkpoint_new(small.scene);
    assert_int_equal(checkpoint_write(checkpoints, small.state, &notes), 0);
    const long long before = asked;
    assert_int_equal(resume_newest(small.scene->output.directory, &resume), 0);
    printf("rank %d of %d, bytes for parts: %lld\n", comm_rank(), comm_size(), asked - before);
    unsigned known = comm_rank() ? 1 : (unsigned)comm_size();
    bool right = resume->n_part == known && resume->n_run == known;
    int code = read_ends(resume, small.state->mesh);
    resume_close(resume);
    checkpoint_free(checkpoints);
    comm_barrier();
    small_stop(&small);
    mem_free(text);
    assert_true(right);
    assert_int_equal(code, 0);
}

/* Places of own tiles are those of their keys among all. */
static void test_places(void **state)
{
    (void)state;
    struct small small;
    struct roll roll;
    char *text = scene_of(16, 1);
    small_start(&small, text);
    const struct level *level = &small.state->mesh->levels[0];
    roll_take(small.state->mesh, &roll);
    assert_int_equal(roll.n_tile, 256);
    for (unsigned i = 0; i < level->n_local; i++) {
        int l = -1;
        size_t place = 0; /* the curve of a square without the bits of z */
        uint64_t key = level->tiles[level->first + i].key;
        for (int b = 0; b < 4; b++) place |= (size_t)(key >> 3 * b & 3) << 2 * b;
        assert_int_equal(roll_local(&roll, place, &l), i);
        assert_int_equal(l, 0);
    }
    small_stop(&small);
    mem_free(text);
}

int main(int argc, char **argv)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(test_places), cmocka_unit_test(test_parts),
                                       cmocka_unit_test(test_memory)};
    comm_init(&argc, &argv);
    if (registry_init()) return 1;
    int failed = cmocka_run_group_tests(tests, NULL, NULL);
    comm_done();
    return failed;
}
