/* checkpoint.c - checkpoints of a small case. The first byte says what is done to the rest: nothing ('0'), or all
 * checksums are made right again, so that what lies behind them is reached, too. */
#include "case/scene_read.h"
#include "fuzz.h"
#include "io/info.h"
#include "io/rebuild.h"
#include "io/seal.h"

/* Where things stand in the header (seal.c). */
enum { CHECKPOINT_REST = 40, CHECKPOINT_N = 48, CHECKPOINT_PARTS = 56, CHECKPOINT_ROW = SEAL_NAME + 24 };

static const char checkpoint_case[] =
    "bulla: 1\ntitle: small\ndomain: {lower: [0], upper: [1 m], cells: [16], boundaries: {x-: reflecting, x+: "
    "reflecting}}\nmesh: {tile: 8, levels: 1, refine: [{gradient: density, above: 0.5}]}\nmaterials: {air: {eos: "
    "{type: "
    "ideal-gas, gamma: 1.4}}, water: {eos: {type: stiffened-gas, gamma: 4.4, p-inf: 6e8}}}\ninitial: [{everywhere: "
    "true, material: air, density: 1, pressure: 1}, {box: {lower: [0], upper: [0.5]}, material: water, density: 1000, "
    "pressure: 1}]\nrun: {until: 1 us}\n";

static uint64_t checkpoint_get(const uint8_t *file, size_t at)
{
    uint64_t value;
    memcpy(&value, file + at, sizeof value);
    return value;
}

static void checkpoint_put(uint8_t *file, size_t at, uint64_t value)
{
    memcpy(file + at, &value, sizeof value);
}

/* The sum of what lies between the parts. */
static uint64_t checkpoint_rest(const uint8_t *file, size_t size)
{
    uint8_t *rest = malloc(size);
    size_t n = 0, at = SEAL_BYTES;
    for (uint64_t i = 0; rest && i <= checkpoint_get(file, CHECKPOINT_N); i++) {
        size_t row = CHECKPOINT_PARTS + i * CHECKPOINT_ROW + SEAL_NAME;
        bool last = i == checkpoint_get(file, CHECKPOINT_N);
        size_t end = last ? size : checkpoint_get(file, row);
        memcpy(rest + n, file + at, end - at);
        n += end - at;
        if (!last) at = end + checkpoint_get(file, row + 8);
    }
    uint64_t hash = seal_hash(rest, n);
    free(rest);
    return hash;
}

/* Makes the checksums right, as far as the list of parts makes sense. */
static void checkpoint_seal(uint8_t *file, size_t size)
{
    bool sound = checkpoint_get(file, CHECKPOINT_N) <= SEAL_MOST;
    size_t at = SEAL_BYTES;
    for (uint64_t i = 0; sound && i < checkpoint_get(file, CHECKPOINT_N); i++) {
        size_t row = CHECKPOINT_PARTS + i * CHECKPOINT_ROW + SEAL_NAME;
        uint64_t offset = checkpoint_get(file, row), length = checkpoint_get(file, row + 8);
        sound = offset >= at && offset <= size && length <= size - offset;
        if (sound) checkpoint_put(file, row + 16, seal_hash(file + offset, length));
        at = offset + length;
    }
    checkpoint_put(file, 24, size);
    if (sound) checkpoint_put(file, CHECKPOINT_REST, checkpoint_rest(file, size));
    checkpoint_put(file, SEAL_BYTES - 8, seal_hash(file, SEAL_BYTES - 8));
}

static void checkpoint_try(const struct scene *scene)
{
    struct resume *resume;
    struct state *state;
    info_print(fuzz_nowhere(), "input.chk");
    if (resume_open("input.chk", &resume)) return;
    if (rebuild_state(resume, scene, &state) == 0) state_free(state);
    resume_close(resume);
}

FUZZ(data, size)
{
    static struct scene *scene;
    fuzz_start();
    if (!scene) {
        fuzz_write("small.yaml", checkpoint_case, sizeof checkpoint_case - 1);
        if (scene_read("small.yaml", NULL, &scene)) abort();
    }
    if (size < 1) return 0;
    uint8_t *file = (uint8_t *)fuzz_text(data + 1, size - 1);
    if (data[0] != '0' && size - 1 >= SEAL_BYTES) checkpoint_seal(file, size - 1);
    fuzz_write("input.chk", file, size - 1);
    checkpoint_try(scene);
    free(file);
    return 0;
}
