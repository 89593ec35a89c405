/* dump_read.c - reading a dump back, see dump_read.h. What the notes say is checked against the shapes of the blocks
 * before anything is computed from it: a file may come from anywhere. */
#include "io/dump_read.h"

#include "base/file.h"
#include "base/mem.h"
#include "base/status.h"
#include "io/dump.h"
#include "io/h5in.h"
#include "mesh/metric.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

/* HDF5's signature: other files are not given to it. */
static bool dump_read_is_hdf5(const char *path)
{
    static const unsigned char magic[8] = {0x89, 'H', 'D', 'F', '\r', '\n', 0x1a, '\n'};
    unsigned char head[sizeof magic];
    const char *why;
    FILE *stream = file_open(path, &why);
    if (!stream) return false;
    bool is = fread(head, 1, sizeof head, stream) == sizeof head && !memcmp(head, magic, sizeof magic);
    fclose(stream);
    return is;
}

bool dump_read_is(const char *path)
{
    struct h5 *file;
    if (!dump_read_is_hdf5(path) || h5_open(path, &file)) return false;
    bool is = h5in_has(file, DUMP_GROUP);
    h5_abandon(file);
    return is;
}

static int dump_read_lacks(const struct dump *dump, const char *name)
{
    return status_fail(STATUS_RUN, "%s: broken dump: '%s' is missing or impossible", dump->path, name);
}

/* A whole number between bounds. */
static int dump_read_whole(const struct dump *dump, const char *name, double least, double most, int *ret)
{
    double value;
    if (!notes_get(&dump->notes, name, 1, &value) || !(value >= least && value <= most) || value != floor(value))
        return dump_read_lacks(dump, name);
    *ret = (int)value;
    return STATUS_OK;
}

static int dump_read_triple(const struct dump *dump, const char *name, double least, double most, int ret[3])
{
    double values[3];
    if (!notes_get(&dump->notes, name, 3, values)) return dump_read_lacks(dump, name);
    for (int d = 0; d < 3; d++) {
        if (!(values[d] >= least && values[d] <= most) || values[d] != floor(values[d]))
            return dump_read_lacks(dump, name);
        ret[d] = (int)values[d];
    }
    return STATUS_OK;
}

static int dump_read_numbers(const struct dump *dump, const char *name, unsigned n, double *ret)
{
    if (!notes_get(&dump->notes, name, n, ret)) return dump_read_lacks(dump, name);
    return STATUS_OK;
}

static int dump_read_phrase(const struct dump *dump, const char *name, size_t room, char *ret)
{
    char *text = notes_get_text(&dump->notes, name);
    if (!text) return dump_read_lacks(dump, name);
    snprintf(ret, room, "%s", text);
    mem_free(text);
    return STATUS_OK;
}

static int dump_read_place(struct dump *dump)
{
    struct blame_facts *facts = &dump->facts;
    int cell = 0;
    TRY(dump_read_whole(dump, "level", 0, MESH_LEVELS - 1, &facts->level));
    TRY(dump_read_triple(dump, "level.extent", 1, 1 << 30, facts->extent));
    TRY(dump_read_numbers(dump, "level.h", 3, facts->h));
    TRY(dump_read_triple(dump, "tile", 0, 1 << 30, facts->tile));
    TRY(dump_read_triple(dump, "tile.cells", 1, METRIC_CELLS, facts->n));
    TRY(dump_read_whole(dump, "tile.covered", 0, 255, &facts->covered));
    TRY(dump_read_whole(dump, "rank", 0, 1 << 30, &facts->rank));
    facts->n_cell = (unsigned)(facts->n[0] * facts->n[1] * facts->n[2]);
    TRY(dump_read_whole(dump, "cell", 0, facts->n_cell - 1, &cell));
    facts->cell = (unsigned)cell;
    return STATUS_OK;
}

/* The midpoint rule goes without saying. */
static int dump_read_integrator(struct dump *dump)
{
    char *name = notes_get_text(&dump->notes, "integrator");
    dump->facts.integrator = name ? tableau_named(name) : 0;
    mem_free(name);
    return dump->facts.integrator < 0 ? dump_read_lacks(dump, "integrator") : STATUS_OK;
}

static int dump_read_facts(struct dump *dump)
{
    struct blame_facts *facts = &dump->facts;
    double step;
    int stage = 0, dim = 0, masked = 0, repair = 0;
    TRY(dump_read_numbers(dump, "step", 1, &step));
    facts->step = (long)step;
    TRY(dump_read_numbers(dump, "t", 1, &facts->t));
    TRY(dump_read_numbers(dump, "dt", 1, &facts->dt));
    TRY(dump_read_numbers(dump, "t.boundary", 1, &facts->at));
    TRY(dump_read_integrator(dump));
    int n = tableau_numbered(facts->integrator)->n;
    TRY(dump_read_whole(dump, "stage", 1, n + BLAME_TOO_SLOW - TABLEAU_STAGES + 1, &stage));
    facts->stage = stage <= n ? stage - 1 : stage - 1 - n + TABLEAU_STAGES;
    TRY(dump_read_place(dump));
    TRY(dump_read_whole(dump, "pure", -1, SCENE_MATERIALS, &facts->pure));
    TRY(dump_read_whole(dump, "marked", 0, 1, &masked));
    TRY(dump_read_whole(dump, "repair", 0, 1, &repair));
    facts->masked = masked;
    facts->repair = repair;
    TRY(dump_read_whole(dump, "dim", 1, 3, &dim));
    dump->dim = (unsigned)dim;
    TRY(dump_read_phrase(dump, "field", sizeof facts->field, facts->field));
    return dump_read_phrase(dump, "verdict", sizeof facts->verdict, facts->verdict);
}

/* Blocks as they are; a scene says later whether they are complete. */
static int dump_read_blocks(struct dump *dump, struct h5 *file)
{
    for (int i = 0; i < BLAME_BLOCKS; i++) {
        struct blame_shape *shape = &dump->shape[i];
        char path[64];
        size_t rows;
        unsigned columns;
        shape->name = blame_name((enum blame_block)i);
        snprintf(path, sizeof path, DUMP_GROUP "/%s", shape->name);
        if (!h5in_has(file, path)) continue;
        TRY(h5in_shape(file, path, &rows, &columns));
        bool cells = i < BLAME_FRAME_X, frame = !cells && i != BLAME_FACES;
        size_t most = frame ? (size_t)dump->facts.n_cell * (1 + 2 * SCENE_GHOSTS_MOST) : BLAME_COLUMNS;
        if (rows == 0 || rows > MODEL_FIELDS || (cells && columns != dump->facts.n_cell) ||
            (!cells && (columns == 0 || columns > most)))
            return dump_read_lacks(dump, shape->name);
        shape->rows = (unsigned)rows;
        shape->columns = columns;
        dump->block[i] = mem_new(rows * columns, sizeof(double));
        TRY(h5in_read(file, path, dump->block[i]));
    }
    if (!dump->block[BLAME_U] || !dump->block[BLAME_W_NEW] || !dump->block[BLAME_W])
        return dump_read_lacks(dump, "u, w, w_new");
    dump->n_field = dump->shape[BLAME_U].rows;
    for (int i = BLAME_U_OLD; i <= BLAME_W_NEW; i++)
        if (dump->block[i] && dump->shape[i].rows != dump->n_field) return dump_read_lacks(dump, dump->shape[i].name);
    return STATUS_OK;
}

static int dump_read_take(struct dump *dump, struct h5 *file)
{
    double format;
    char *text = NULL;
    TRY(h5in_attribute(file, DUMP_GROUP, "format", 1, &format));
    if (format != DUMP_FORMAT)
        return status_fail(STATUS_RUN, "%s: a dump of format %g; this program reads %d", dump->path, format,
                           DUMP_FORMAT);
    TRY(h5in_attribute(file, DUMP_GROUP, "value", 1, &dump->facts.value));
    TRY(h5in_text(file, DUMP_GROUP "/notes", &text));
    text_add(&dump->notes.text, "%s", text);
    mem_free(text);
    TRY(h5in_text(file, DUMP_GROUP "/case.yaml", &dump->resolved));
    TRY(h5in_text(file, DUMP_GROUP "/provenance.json", &dump->provenance));
    TRY(dump_read_facts(dump));
    return dump_read_blocks(dump, file);
}

int dump_read(const char *path, struct dump **ret_dump)
{
    struct h5 *file;
    if (dump_read_is_hdf5(path) && !dump_read_is(path))
        return status_fail(STATUS_RUN, "%s: not a dump of a failed step", path);
    TRY(h5_open(path, &file));
    struct dump *dump = mem_new(1, sizeof *dump);
    dump->path = mem_text(path);
    int code = dump_read_take(dump, file);
    h5_abandon(file);
    if (code) dump_read_free(dump);
    else *ret_dump = dump;
    return code;
}

void dump_read_free(struct dump *dump)
{
    if (!dump) return;
    for (int i = 0; i < BLAME_BLOCKS; i++) mem_free(dump->block[i]);
    text_done(&dump->notes.text);
    mem_free(dump->path);
    mem_free(dump->resolved);
    mem_free(dump->provenance);
    mem_free(dump);
}
