/* forged.c - checkpoints whose lists were changed and sealed again, as a forger would, are refused or harmless. With a
 * case, a checkpoint of it, and a number: the ranks that there are (program/checkpoint_forged.sh starts several) take
 * so many forged copies of it together, and say what came of each. */
#include "base/comm.h"
#include "io/checkpoint.h"
#include "io/rebuild.h"
#include "io/seal.h"
#include "mesh/morton.h"
#include "small.h"
#include "solve/advance.h"

#include <fcntl.h>

struct original {
    struct seal seal;
    char *bytes;
};

static struct original read_original(const char *path)
{
    struct original original;
    assert_int_equal(seal_check(path, &original.seal), 0);
    original.bytes = mem_new(original.seal.bytes, 1);
    int file = open(path, O_RDONLY);
    assert_int_equal(seal_bytes(file, path, 0, original.seal.bytes, original.bytes), 0);
    close(file);
    return original;
}

/* Changes a few bytes of `length`: letters of notes, bits of lists. */
static void change(char *bytes, uint64_t length, bool letters)
{
    for (int k = rand() % 4; k >= 0; k--) {
        char *byte = bytes + (uint64_t)rand() % length;
        *byte = (char)(letters ? "0123456789-.einf =\n"[rand() % 19] : *byte ^ 1 << rand() % 8);
    }
}

/* The next place along the curve in the same layer that lies before another tile; false: there is none. */
static bool next_place(int32_t *at, uint64_t end)
{
    int place[3];
    for (uint64_t key = morton_key(at) + 1; key < end; key++) {
        morton_at(key, place);
        if (place[2] != at[2]) continue;
        memcpy(at, place, sizeof place);
        return true;
    }
    return false;
}

/* A tile of the list goes to the next place that is free: still in order, but what lay over it lacks it. */
static void misplace(char *bytes, uint64_t length)
{
    int32_t row[2][CHECKPOINT_TILE];
    uint64_t n = length / sizeof row[0], i = (uint64_t)rand() % (n - 1);
    for (uint64_t k = 0; k < n - 1; k++, i = (i + 1) % (n - 1)) {
        memcpy(row, bytes + i * sizeof row[0], sizeof row);
        if (row[0][0] != row[1][0] || !next_place(row[0] + 1, morton_key(row[1] + 1))) continue;
        memcpy(bytes + i * sizeof row[0], row[0], sizeof row[0]);
        return;
    }
}

enum forgery { FORGED_AND_SEALED, FORGED_PLACES, FORGED_BY_DISK };

/* A copy with a part that was changed; sealed again unless the disk did it. */
static void forge(const struct original *original, const char *path, unsigned part, enum forgery forgery, unsigned seed)
{
    enum { PARTS = 56, PART = SEAL_NAME + 24 };
    const struct seal_part *place = &original->seal.parts[part];
    char *copy = mem_new(original->seal.bytes, 1);
    memcpy(copy, original->bytes, original->seal.bytes);
    srand(seed);
    if (forgery == FORGED_PLACES) misplace(copy + place->offset, place->length);
    else change(copy + place->offset, place->length, !strcmp(place->name, "/notes"));
    if (forgery != FORGED_BY_DISK) {
        uint64_t hash = seal_hash(copy + place->offset, place->length);
        memcpy(copy + PARTS + part * PART + SEAL_NAME + 16, &hash, sizeof hash);
        hash = seal_hash(copy, SEAL_BYTES - sizeof hash);
        memcpy(copy + SEAL_BYTES - sizeof hash, &hash, sizeof hash);
    }
    FILE *file = fopen(path, "wb");
    assert_non_null(file);
    assert_int_equal(fwrite(copy, 1, original->seal.bytes, file), original->seal.bytes);
    fclose(file);
    mem_free(copy);
}

/* What a restart says. Collective. */
static int take_up(const char *path, const struct scene *scene)
{
    struct resume *resume;
    struct state *state;
    int code = resume_open(path, &resume);
    if (code) return code;
    code = rebuild_state(resume, scene, &state);
    if (!code) state_free(state);
    resume_close(resume);
    return code;
}

/* A part of a name; the seal's number of it. */
static unsigned part_of(const struct original *original, const char *name)
{
    const struct seal_part *part = seal_find(&original->seal, name);
    assert_non_null(part);
    return (unsigned)(part - original->seal.parts);
}

static void forged_files_do_no_harm(void **state)
{
    (void)state;
    struct small small;
    struct notes outputs = {0};
    int refused = 0;
    small_start_levels(&small, SMALL_LEVELS, 2);
    struct checkpoints *checkpoints = checkpoint_new(small.scene);
    assert_int_equal(checkpoint_write(checkpoints, small.state, &outputs), 0);
    struct original original = read_original(checkpoint_last(checkpoints));
    char *forged = mem_print("%s/forged.chk", small.folder);
    for (unsigned seed = 0; seed < 300; seed++) {
        forge(&original, forged, part_of(&original, seed % 3 ? "/tiles" : "/notes"), FORGED_AND_SEALED, seed);
        int code = take_up(forged, small.scene);
        assert_true(code == 0 || code == STATUS_CASE);
        assert_true(!code || *status_text());
        refused += code != 0;
    }
    assert_in_range(refused, 150, 300);
    mem_free(original.bytes);
    mem_free(forged);
    checkpoint_free(checkpoints);
    small_stop(&small);
}

/* The lists of a checkpoint, of one writer or several: their numbers, and how many there are. */
static unsigned lists_of(const struct original *original, unsigned ret_parts[SEAL_MOST])
{
    static const char *const names[] = {"/notes", "/tiles", "/runs", "/parts"};
    unsigned n = 0;
    for (unsigned i = 0; i < sizeof names / sizeof *names; i++)
        if (seal_find(&original->seal, names[i])) ret_parts[n++] = part_of(original, names[i]);
    return n;
}

/* Every fifth copy is damaged, of the other lists of tiles half are those of another mesh. */
static enum forgery forgery_of(const struct seal_part *part, unsigned seed)
{
    if (seed % 5 == 4) return FORGED_BY_DISK;
    return !strcmp(part->name, "/tiles") && seed / 4 % 2 ? FORGED_PLACES : FORGED_AND_SEALED;
}

/* The lists take turns. All ranks agree on what is said. */
static void take_copies(const char *yaml, const char *path, const char *forged, unsigned from, unsigned end)
{
    struct scene_options options = {.directory = "out"};
    struct scene *scene;
    struct original original = read_original(path);
    unsigned parts[SEAL_MOST], n = lists_of(&original, parts);
    assert_int_equal(scene_read(yaml, &options, &scene), 0);
    for (unsigned seed = from; seed < end; seed++) {
        unsigned part = parts[seed % n];
        if (comm_rank() == 0) forge(&original, forged, part, forgery_of(&original.seal.parts[part], seed), seed);
        comm_barrier();
        int code = take_up(forged, scene);
        assert_int_equal(comm_agree(code), code);
        if (comm_rank() == 0)
            printf("%u %s %d %s\n", seed, original.seal.parts[part].name, code, code ? status_text() : "");
    }
    scene_free(scene);
    mem_free(original.bytes);
}

int main(int argc, char **argv)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(forged_files_do_no_harm)};
    comm_init(&argc, &argv);
    int failed = registry_init();
    if (!failed && argc == 6) take_copies(argv[1], argv[2], argv[3], (unsigned)atoi(argv[4]), (unsigned)atoi(argv[5]));
    else if (!failed) failed = cmocka_run_group_tests(tests, NULL, NULL);
    comm_done();
    return failed;
}
