/* dump.c - writing, see dump.h. Facts are known to all ranks, blocks to the one that had the tile; rank 0 files them
 * (h5out.h). */
#include "io/dump.h"

#include "base/comm.h"
#include "base/mem.h"
#include "base/status.h"
#include "base/version.h"
#include "io/h5out.h"
#include "io/notes.h"
#include "io/place.h"
#include "solve/blame.h"

#include <string.h>

/* For h5out: rows of a block on the rank that has it. */
struct dump_rows {
    const double *block;
    size_t columns;
};

static void dump_fill(void *context, size_t first, size_t count, void *out)
{
    const struct dump_rows *rows = context;
    memcpy(out, rows->block + first * rows->columns, count * rows->columns * sizeof(double));
}

static int dump_put_block(struct h5 *file, const struct blame_shape *shape, const double *block)
{
    struct dump_rows context = {block, shape->columns};
    struct h5out_range range = {0, block ? shape->rows : 0};
    char *path = mem_print(DUMP_GROUP "/%s", shape->name);
    const struct h5out_rows rows = {.type = H5_F64,
                                    .columns = (unsigned)shape->columns,
                                    .total = shape->rows,
                                    .chunk = shape->rows,
                                    .n_range = 1,
                                    .ranges = &range,
                                    .fill = dump_fill,
                                    .context = &context};
    int code = h5out_write(file, path, &rows);
    mem_free(path);
    return code;
}

static void dump_note_names(struct notes *notes, const struct model *model, const struct blame_facts *facts)
{
    static char columns[BLAME_COLUMNS][BLAME_NAME];
    struct text fields = {0}, faces = {0};
    unsigned n = !blame_moves(facts) ? 0 : blame_columns(model, facts, columns);
    for (unsigned q = 0; q < model->n_field; q++) text_add(&fields, "%s%s", q ? " " : "", model->field_names[q]);
    for (unsigned c = 0; c < n; c++) text_add(&faces, "%s%s", c ? " " : "", columns[c]);
    notes_put_text(notes, "fields", fields.at);
    notes_put_text(notes, "faces.columns", faces.at ? faces.at : "");
    text_done(&fields);
    text_done(&faces);
}

static void dump_note_triple(struct notes *notes, const char *name, const int at[3])
{
    notes_put(notes, name, 3, (double[]){at[0], at[1], at[2]});
}

static void dump_note_place(struct notes *notes, const struct blame_facts *facts)
{
    notes_put_one(notes, "level", facts->level);
    dump_note_triple(notes, "level.extent", facts->extent);
    notes_put(notes, "level.h", 3, facts->h);
    dump_note_triple(notes, "tile", facts->tile);
    dump_note_triple(notes, "tile.cells", facts->n);
    notes_put_one(notes, "tile.covered", facts->covered);
    notes_put_one(notes, "cell", facts->cell);
    notes_put_one(notes, "rank", facts->rank);
}

static void dump_note(struct notes *notes, const struct state *state, const struct blame_facts *facts)
{
    notes_put_text(notes, "case.name", state->scene->name);
    notes_put_text(notes, "case.title", state->scene->title ? state->scene->title : "");
    notes_put_text(notes, "written.by", "bulla " BULLA_VERSION);
    notes_put_text(notes, "written.commit", version_commit());
    notes_put_one(notes, "step", (double)facts->step);
    notes_put_one(notes, "t", facts->t);
    notes_put_one(notes, "dt", facts->dt);
    notes_put_one(notes, "t.boundary", facts->at);
    const struct tableau *tableau = tableau_numbered(facts->integrator);
    notes_put_one(notes, "stage", 1 + (blame_moves(facts) ? facts->stage : facts->stage - TABLEAU_STAGES + tableau->n));
    if (facts->integrator) notes_put_text(notes, "integrator", tableau->name);
    dump_note_place(notes, facts);
    notes_put_one(notes, "pure", facts->pure);
    notes_put_one(notes, "marked", facts->masked);
    notes_put_one(notes, "repair", facts->repair);
    notes_put_text(notes, "field", facts->field);
    notes_put_text(notes, "verdict", facts->verdict);
    notes_put_one(notes, "dim", state->model->dim);
    dump_note_names(notes, state->model, facts);
}

static int dump_put(struct h5 *file, const struct state *state, const struct blame_facts *facts,
                    const struct blame *own, const char *provenance)
{
    int32_t format = DUMP_FORMAT;
    struct notes notes = {0};
    dump_note(&notes, state, facts);
    h5_group(file, DUMP_GROUP);
    h5_attribute(file, DUMP_GROUP, "format", H5_I32, 0, &format);
    h5_attribute(file, DUMP_GROUP, "value", H5_F64, 0, &facts->value);
    h5out_text(file, DUMP_GROUP "/notes", notes.text.at);
    h5out_text(file, DUMP_GROUP "/case.yaml", state->scene->resolved ? state->scene->resolved : "");
    h5out_text(file, DUMP_GROUP "/provenance.json", provenance);
    text_done(&notes.text);
    for (int i = 0; i < BLAME_BLOCKS; i++) {
        struct blame_shape shape = blame_shape(state->model, facts, (enum blame_block)i);
        if (shape.rows) TRY(dump_put_block(file, &shape, own ? own->block[i] : NULL));
    }
    return STATUS_OK;
}

static int dump_draft(const char *path, const struct state *state, const struct blame_facts *facts,
                      const struct blame *own, const char *provenance)
{
    struct h5 *file;
    char *draft = place_draft(path);
    int code = h5_create(draft, &file);
    mem_free(draft);
    TRY(code);
    code = dump_put(file, state, facts, own, provenance);
    if (!code) return h5_close(file);
    h5_abandon(file);
    return code;
}

int dump_write(const struct state *state, const char *provenance, char **ret_path)
{
    struct blame_facts facts;
    const struct blame *own;
    *ret_path = NULL;
    if (!blame_find(state, &facts, &own)) return STATUS_OK;
    char *path = mem_print("%s/dump_%06ld.h5", state->scene->output.directory, facts.step);
    int code = dump_draft(path, state, &facts, own, provenance);
    if (code) place_reject(path);
    else code = place_accept(path);
    if (code) mem_free(path);
    else *ret_path = path;
    return code;
}
