/* Tables of modules on one rank and on several (the program starts itself under mpirun): made once per machine by all
 * ranks together, with the same bits whoever makes what, one copy in memory; failures reach all ranks and nobody
 * waits. */
#include "plug/block.h"

#include "base/abort.h"
#include "base/comm.h"
#include "base/mem.h"
#include "base/status.h"
#include "bulla/eos.h"
#include "plug/instance.h"
#include "plug/registry.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>
#include <xxhash.h>

#include <cmocka.h>

enum { ROWS = 512, ROW = 2048 }; /* 8 MiB */

static int made; /* rows that this rank has made */

/* A module whose instances are its table: row i holds i + value; a value of 13 fails on the last part. */
static int fake_fill(void *context, void *block, unsigned phase, unsigned part, unsigned parts)
{
    double value = *(const double *)context, *row = block;
    if (value == 13.0 && part == parts - 1) return 1;
    for (unsigned i = part; phase == 0 && i < ROWS; i += parts, made++)
        for (unsigned k = 0; k < ROW; k++) row[i * ROW + k] = i + value;
    for (unsigned i = 0; phase == 1 && i < ROWS; i++)
        if (row[i * ROW + 7] != i + value) return 1; /* a phase begins when the one before is done everywhere */
    return 0;
}

static int fake_open(const struct bulla_host *host, const struct bulla_value *values, void **ret_self)
{
    double value = values[0].number;
    if (value == 7.0 && comm_rank() == comm_size() - 1) {
        (host->fail)("out of luck");
        return 1;
    }
    if (value == 13.0) (host->fail)("13 brings bad luck");
    const void *block = host->share("rows", sizeof(double) * ROWS * ROW, 2, fake_fill, &value);
    *ret_self = (void *)block;
    return !block;
}

static const struct bulla_param fake_params[] = {{.name = "value", .unit = "1", .max = 100.0, .doc = "a number"}, {0}};
static const struct bulla_module fake = {
    .kind = "eos", .name = "fake", .version = "1", .params = fake_params, .open = fake_open};

static int open_fake(double value, struct instance *ret_instance)
{
    struct bulla_value given = {.number = value};
    return instance_open(&fake, &given, ret_instance);
}

#define MUST(condition)                                                                 \
    do {                                                                                \
        if (!(condition)) {                                                             \
            fprintf(stderr, "line %d: %s (%s)\n", __LINE__, #condition, status_text()); \
            abort_all(1);                                                               \
        }                                                                               \
    } while (0)

/* Memory of all ranks that the blocks take, shared pages counted once: Pss of what share.c maps [KiB]. */
static double mapped(void)
{
    char line[512];
    double sum = 0.0, number, all[64] = {0.0};
    bool ours = false;
    FILE *file = fopen("/proc/self/smaps", "r");
    MUST(file);
    while (fgets(line, sizeof line, file)) {
        if (strchr(line, '-') && strchr(line, ' ') > strchr(line, '-')) ours = strstr(line, "bulla-table") != NULL;
        if (ours && sscanf(line, "Pss: %lf", &number) == 1) sum += number;
    }
    fclose(file);
    comm_join(&sum, 1, all);
    sum = 0.0;
    for (int rank = 0; rank < comm_size(); rank++) sum += all[rank];
    return sum;
}

static void blocks_are_one(void)
{
    struct instance one = {0}, same = {0}, other = {0};
    long long rows;
    block_together();
    MUST(open_fake(1.0, &one) == STATUS_OK && open_fake(1.0, &same) == STATUS_OK);
    MUST(one.self == same.self);
    rows = made;
    comm_sum_counts(&rows, 1);
    MUST(rows == ROWS); /* by all ranks together */
    MUST(open_fake(2.0, &other) == STATUS_OK && other.self != one.self);
    MUST(block_apart(STATUS_OK) == STATUS_OK);
    comm_barrier();
    double kib = mapped(), want = comm_size() > 1 ? 2 * 8192.0 : 0.0; /* alone: no file */
    MUST(kib >= 0.99 * want && kib <= 1.01 * want);
    comm_barrier();
    instance_done(&one);
    const double *row = same.self, *row2 = other.self;
    for (int i = 0; i < ROWS; i++) MUST(row[i * ROW + ROW - 1] == i + 1.0 && row2[i * ROW] == i + 2.0);
    instance_done(&same);
    instance_done(&other);
    comm_barrier();
    MUST(mapped() == 0.0);
}

static void failures_are_everybodys(void)
{
    struct instance instance = {0};
    block_together();
    MUST(open_fake(13.0, &instance) == STATUS_CASE && strstr(status_text(), "13 brings bad luck"));
    MUST(open_fake(3.0, &instance) == STATUS_OK);
    MUST(block_apart(STATUS_OK) == STATUS_OK);
    instance_done(&instance);
    /* the last rank fails before it asks for the block */
    block_together();
    int code = open_fake(7.0, &instance);
    MUST(code == STATUS_CASE);
    MUST(block_apart(code) == STATUS_CASE);
    /* the last rank reads another case */
    block_together();
    code = open_fake(comm_rank() == comm_size() - 1 ? 4.0 : 5.0, &instance);
    MUST(comm_size() == 1 ? !code : code == STATUS_CASE && strstr(status_text(), "ranks open different laws"));
    MUST(block_apart(code) == code);
    if (!code) instance_done(&instance);
    /* and may find no law in it */
    block_together();
    code = comm_rank() == comm_size() - 1 ? status_fail(STATUS_CASE, "no such case") : open_fake(6.0, &instance);
    MUST(code == STATUS_CASE && strstr(status_text(), "no such case"));
    MUST(block_apart(code) == STATUS_CASE);
    /* alone it opens what it likes */
    MUST(open_fake(comm_rank(), &instance) == STATUS_OK);
    instance_done(&instance);
}

/* All bits that a law gives at some thousand states, as one number. */
static uint64_t answers(const char *name, double (*number)(const struct bulla_param *row))
{
    enum { N = 256 };
    const struct bulla_module *module = registry_find("eos", name)->module;
    const struct bulla_eos *eos = module->table;
    struct bulla_value values[16] = {{0}};
    struct instance instance = {0};
    double rho[N], p[N], out[4][N];
    uint64_t hash = 0;
    for (unsigned i = 0; i < instance_param_count(module); i++) {
        const struct bulla_param *row = &module->params[i];
        values[i] = (struct bulla_value){number(row), row->type == BULLA_CHOICE ? "table" : ""};
        if (!strcmp(row->name, "interpolation")) values[i].text = "bicubic";
    }
    MUST(instance_open(module, values, &instance) == STATUS_OK);
    for (int k = 0; k < 40; k++) {
        for (int i = 0; i < N; i++) {
            rho[i] = 1.0 + 1500.0 * ((37 * i + 11 * k) % 1013) / 1013.0;
            p[i] = 1e5 + 3e9 * ((101 * i + 7 * k) % 997) / 997.0;
        }
        eos->state(instance.self, N, rho, p, out[0], out[1]);
        eos->temperature(instance.self, N, rho, p, out[2]);
        eos->entropy(instance.self, N, rho, p, out[3]);
        hash = XXH64(out, sizeof out, hash);
    }
    instance_done(&instance);
    return hash;
}

static double fallback(const struct bulla_param *row)
{
    return strcmp(row->name, "table-size") ? row->fallback : 128.0;
}

static void play(const char *path)
{
    char *own = mem_print("%s.%d", path, comm_rank());
    FILE *out = fopen(own, "w");
    MUST(out && registry_init() == STATUS_OK);
    blocks_are_one();
    failures_are_everybodys();
    block_together();
    for (const char *const *law = (const char *const[]){"iapws95", "helmholtz-air", "rkpr", NULL}; *law; law++)
        fprintf(out, "%s %016llx\n", *law, (unsigned long long)answers(*law, fallback));
    MUST(block_apart(STATUS_OK) == STATUS_OK);
    MUST(fclose(out) == 0);
    registry_done();
    mem_free(own);
}

/* What rank `rank` of `ranks` has written. */
static char *said(const char *folder, int ranks, int rank)
{
    char *path = mem_print("%s/ranks%d.%d", folder, ranks, rank), text[512];
    FILE *in = fopen(path, "r");
    assert_non_null(in);
    text[fread(text, 1, sizeof text - 1, in)] = '\0';
    fclose(in);
    mem_free(path);
    return mem_text(text);
}

static void run(const char *folder, int ranks)
{
    char *command = mem_print("ASAN_OPTIONS=detect_leaks=0 OMPI_ALLOW_RUN_AS_ROOT=1 OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1 "
                              "OMPI_MCA_mpi_yield_when_idle=1 OMPI_MCA_rmaps_base_oversubscribe=1 timeout 200 mpirun "
                              "-n %d --bind-to none '%s/tests/test-unit-block' '%s/ranks%d' >'%s/log' 2>&1",
                              ranks, getenv("BULLA_BUILD"), folder, ranks, folder);
    if (system(command)) {
        mem_free(command);
        command = mem_print("cat '%s/log'", folder);
        if (system(command)) print_error("no log\n");
        fail_msg("%d ranks", ranks);
    }
    mem_free(command);
}

static void one_table_per_machine(void **state)
{
    (void)state;
    char folder[] = "/tmp/bulla-block-XXXXXX";
    assert_non_null(mkdtemp(folder));
    run(folder, 1);
    char *one = said(folder, 1, 0);
    assert_true(strstr(one, "iapws95 ") && strstr(one, "rkpr "));
    for (int ranks = 2; ranks <= 3; ranks++) {
        run(folder, ranks);
        for (int rank = 0; rank < ranks; rank++) {
            char *other = said(folder, ranks, rank);
            assert_string_equal(one, other);
            mem_free(other);
        }
    }
    mem_free(one);
    char *command = mem_print("rm -rf '%s'", folder);
    assert_int_equal(system(command), 0);
    mem_free(command);
}

int main(int argc, char **argv)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(one_table_per_machine)};
    if (argc < 2) return cmocka_run_group_tests(tests, NULL, NULL);
    comm_init(&argc, &argv);
    play(argv[1]);
    comm_done();
    return 0;
}
