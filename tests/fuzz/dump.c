/* dump.c - dumps of failed steps. HDF5 itself is not the target: the input says what is in a sound HDF5 file, in parts
 * that end with a line "%%": notes; the blocks, one "name rows columns" a line; provenance. The case is that of the
 * dump in the corpus, so that its replay reaches the kernels. Numbers of the blocks follow from their places. */
#include "fuzz.h"
#include "io/dump.h"
#include "io/dump_show.h"
#include "io/h5out.h"
#include "solve/blame.h"

enum { DUMP_MOST = 1 << 16 };

static const char dump_case[] =
    "bulla: 1\ntitle: torn\ndomain: {lower: [-1], upper: [1], cells: [32], boundaries: {x-: periodic, x+: periodic}}\n"
    "mesh: {tile: 8}\nmaterials: {water: {eos: {type: stiffened-gas, gamma: 4.4, p-inf: 6e8}}, air: {eos: {type: "
    "ideal-gas, gamma: 1.4}}}\ninitial: [{everywhere: true, material: water, density: 1000, pressure: 1e5}]\n"
    "scheme: {limiter: mc}\nrun: {until: 1}\n";

/* Cuts the part before the next line "%%" off. */
static char *dump_part(char **rest)
{
    static char nothing[1];
    char *part = *rest, *end = part ? strstr(part, "\n%%\n") : NULL;
    *rest = end ? end + 4 : NULL;
    if (end) end[1] = '\0';
    return part ? part : nothing;
}

static void dump_block(struct h5 *file, const char *name, unsigned rows, unsigned columns)
{
    char path[64];
    if (rows > DUMP_MOST || columns > DUMP_MOST || (size_t)rows * columns > DUMP_MOST) return;
    double *values = calloc((size_t)rows * (columns + 1) + 1, sizeof *values); /* 0 columns: the shape is [rows] */
    if (!values) abort();
    for (size_t i = 0; i < (size_t)rows * columns; i++) values[i] = i % 7 ? 1e5 / (double)(i % 11 + 1) : 1e3;
    snprintf(path, sizeof path, DUMP_GROUP "/%s", name);
    h5out_array(file, path, H5_F64, rows, columns, values);
    free(values);
}

static void dump_blocks(struct h5 *file, char *list)
{
    bool seen[BLAME_BLOCKS] = {false};
    for (char *line = strtok(list, "\n"); line; line = strtok(NULL, "\n")) {
        char name[32];
        unsigned rows, columns;
        if (sscanf(line, "%31s %u %u", name, &rows, &columns) != 3) continue;
        for (int i = 0; i < BLAME_BLOCKS; i++) {
            if (seen[i] || strcmp(name, blame_name((enum blame_block)i)) != 0) continue;
            seen[i] = true;
            dump_block(file, name, rows, columns);
        }
    }
}

static bool dump_make(char *text)
{
    char *rest = text, *notes = dump_part(&rest), *blocks = dump_part(&rest), *provenance = dump_part(&rest);
    int32_t format = DUMP_FORMAT;
    double value = 1.0;
    struct h5 *file;
    if (h5_create("input.h5", &file)) abort();
    h5_group(file, DUMP_GROUP);
    h5_attribute(file, DUMP_GROUP, "format", H5_I32, 0, &format);
    h5_attribute(file, DUMP_GROUP, "value", H5_F64, 0, &value);
    h5out_text(file, DUMP_GROUP "/notes", notes);
    h5out_text(file, DUMP_GROUP "/case.yaml", dump_case);
    h5out_text(file, DUMP_GROUP "/provenance.json", provenance);
    dump_blocks(file, blocks);
    return h5_close(file) == 0;
}

FUZZ(data, size)
{
    fuzz_start();
    setenv("TMPDIR", fuzz_folder, 1);
    char *text = fuzz_text(data, size);
    if (dump_make(text)) {
        dump_show(fuzz_nowhere(), "input.h5");
        dump_show_replay(fuzz_nowhere(), "input.h5");
    }
    free(text);
    return 0;
}
