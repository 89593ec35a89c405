/* dump_show.c - a dump for people, and its replay, see dump_show.h. Showing needs nothing but the file; a replay needs
 * the case in it and the modules that the case names. */
#include "io/dump_show.h"

#include "base/mem.h"
#include "base/status.h"
#include "case/scene_read.h"
#include "io/dump_read.h"
#include "io/start.h"
#include "plug/registry.h"
#include "solve/blame_replay.h"

#include <errno.h>
#include <inttypes.h>
#include <jansson.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

static void dump_show_line(FILE *out, const struct dump *dump, const char *label, const char *name)
{
    char *text = notes_get_text(&dump->notes, name);
    if (text && *text) fprintf(out, "%-10s%s\n", label, text);
    mem_free(text);
}

/* Word i of a list of names; "?" beyond its end. */
static void dump_show_word(const char *words, unsigned i, size_t room, char *ret)
{
    snprintf(ret, room, "?");
    for (; words && *words; words += strspn(words, " ")) {
        size_t length = strcspn(words, " ");
        if (i-- == 0) {
            snprintf(ret, room, "%.*s", (int)length, words);
            return;
        }
        words += length;
    }
}

/* Is the module here now, and the same? */
static const char *dump_show_compare_module(const json_t *module)
{
    const char *kind = json_string_value(json_object_get(module, "kind"));
    const char *name = json_string_value(json_object_get(module, "name"));
    const char *was = json_string_value(json_object_get(module, "xxh64"));
    const struct registry_entry *entry = kind && name ? registry_find(kind, name) : NULL;
    char is[32];
    if (!entry) return "not loaded here";
    snprintf(is, sizeof is, "%016" PRIx64, entry->hash);
    return was && !strcmp(was, is) ? "the same here" : "another file here";
}

static void dump_show_modules(FILE *out, const struct dump *dump, bool compare)
{
    json_t *root = json_loads(dump->provenance, 0, NULL), *module;
    size_t i;
    json_array_foreach(json_object_get(root, "modules"), i, module)
    {
        const char *texts[4];
        static const char *const keys[] = {"kind", "name", "version", "xxh64"};
        for (int k = 0; k < 4; k++) {
            texts[k] = json_string_value(json_object_get(module, keys[k]));
            if (!texts[k]) texts[k] = "?";
        }
        fprintf(out, "%-10s%-8s %-16s %-8s xxh64 %s%s%s\n", i ? "" : "modules", texts[0], texts[1], texts[2], texts[3],
                compare ? "  " : "", compare ? dump_show_compare_module(module) : "");
    }
    json_decref(root);
}

static void dump_show_place(FILE *out, const struct dump *dump)
{
    static const char *const between[] = {"after averages and fluxes of a finer level",
                                          "before a step too short to be taken"};
    const struct blame_facts *facts = &dump->facts;
    unsigned n0 = (unsigned)facts->n[0], n1 = (unsigned)facts->n[1];
    fprintf(out, "step      %ld, from t = %.9g s over dt = %.9g s\n", facts->step, facts->t, facts->dt);
    const struct tableau_stage *row = &tableau_numbered(facts->integrator)->stage[facts->stage % TABLEAU_STAGES];
    if (blame_moves(facts)) fprintf(out, "stage     stage %d: %s", facts->stage + 1, row->doc);
    else fprintf(out, "stage     %s", between[facts->stage - TABLEAU_STAGES]);
    fprintf(out, "%s\n", facts->masked ? ", with first-order fluxes at marked cells" : "");
    fprintf(out, "level     %d, cells of %.6g m\n", facts->level, facts->h[0]);
    fprintf(out, "tile      (%d, %d, %d)", facts->tile[0], facts->tile[1], facts->tile[2]);
    if (facts->pure == SCENE_MATERIALS) fprintf(out, ", advanced as fluids alone");
    else if (facts->pure >= 0) fprintf(out, ", advanced as material %d alone", facts->pure);
    fprintf(out, "\ncell      (%u, %u, %u) of the tile\n", facts->cell % n0, facts->cell / n0 % n1,
            facts->cell / n0 / n1);
    fprintf(out, "field     %s = %.17g\nverdict   %s\n", facts->field, facts->value, facts->verdict);
}

static double dump_show_value(const struct dump *dump, enum blame_block block, unsigned row)
{
    return dump->block[block][row * dump->shape[block].columns + dump->facts.cell];
}

static void dump_show_cell(FILE *out, const struct dump *dump)
{
    char *fields = notes_get_text(&dump->notes, "fields"), name[BLAME_NAME];
    bool old = dump->block[BLAME_U_OLD] != NULL;
    fprintf(out, "\n%-28s  %22s  %22s\n", "the cell: conserved", old ? "before the step" : "", "after");
    for (unsigned q = 0; q < dump->n_field; q++) {
        dump_show_word(fields, q, sizeof name, name);
        fprintf(out, "%-28s  ", name);
        if (old) fprintf(out, "%22.15g", dump_show_value(dump, BLAME_U_OLD, q));
        else fprintf(out, "%22s", "");
        fprintf(out, "  %22.15g\n", dump_show_value(dump, BLAME_U, q));
    }
    fprintf(out, "%-28s  %22s  %22s\n", "primitives", "where rates were taken", "after");
    for (unsigned q = 0; q < dump->n_field; q++) {
        dump_show_word(fields, q, sizeof name, name);
        const char *of = !strcmp(name, "total_energy") ? "pressure" : name;
        if (!strncmp(of, "partial_", 8)) of += 8; /* of the material itself */
        bool velocity = !strncmp(of, "momentum_", 9);
        fprintf(out, "%s%-*s  %22.15g  %22.15g\n", velocity ? "velocity_" : "", velocity ? 19 : 28,
                velocity ? of + 9 : of, dump_show_value(dump, BLAME_W, q), dump_show_value(dump, BLAME_W_NEW, q));
    }
    mem_free(fields);
}

static void dump_show_faces(FILE *out, const struct dump *dump)
{
    const struct blame_shape *shape = &dump->shape[BLAME_FACES];
    const double *values = dump->block[BLAME_FACES];
    if (!values) return;
    char *columns = notes_get_text(&dump->notes, "faces.columns"), name[BLAME_NAME];
    fprintf(out, "\n%-28s", "its faces");
    for (unsigned f = 0; f < shape->rows; f++) fprintf(out, "  %12c%c", "xyz"[f / 2 % 3], "-+"[f % 2]);
    fputc('\n', out);
    for (unsigned c = 0; c < shape->columns; c++) {
        dump_show_word(columns, c, sizeof name, name);
        fprintf(out, "%-28s", name);
        for (unsigned f = 0; f < shape->rows; f++) fprintf(out, "  %13.6g", values[f * shape->columns + c]);
        fputc('\n', out);
    }
    mem_free(columns);
}

static void dump_show_blocks(FILE *out, const struct dump *dump)
{
    fprintf(out, "\nholds     ");
    for (int i = 0; i < BLAME_BLOCKS; i++)
        if (dump->block[i])
            fprintf(out, "%s[%u, %zu] ", dump->shape[i].name, dump->shape[i].rows, dump->shape[i].columns);
    fputc('\n', out);
}

int dump_show(FILE *out, const char *path)
{
    struct dump *dump;
    TRY(dump_read(path, &dump));
    fprintf(out, "dump      %s\n", path);
    dump_show_line(out, dump, "case", "case.name");
    dump_show_line(out, dump, "title", "case.title");
    dump_show_line(out, dump, "by", "written.by");
    dump_show_line(out, dump, "commit", "written.commit");
    dump_show_place(out, dump);
    dump_show_modules(out, dump, false);
    dump_show_cell(out, dump);
    dump_show_faces(out, dump);
    dump_show_blocks(out, dump);
    dump_read_free(dump);
    return STATUS_OK;
}

/* The case of a dump, through a file that is gone again. */
static int dump_show_scene(const struct dump *dump, struct scene **ret_scene)
{
    const char *folder = getenv("TMPDIR");
    char *path = mem_print("%s/bulla-dump-XXXXXX.yaml", folder ? folder : "/tmp");
    int file = mkstemps(path, (int)strlen(".yaml"));
    FILE *stream = file < 0 ? NULL : fdopen(file, "w");
    int code = STATUS_OK;
    if (!stream) code = status_fail(STATUS_RUN, "%s: cannot write: %s", path, strerror(errno));
    if (stream && (fputs(dump->resolved, stream) < 0) + fclose(stream))
        code = status_fail(STATUS_RUN, "%s: cannot write: %s", path, strerror(errno));
    if (!code) code = scene_read(path, NULL, ret_scene);
    if (!code) code = start_load(*ret_scene);
    if (file >= 0) unlink(path);
    if (code) status_wrap(code, "%s: the case in the dump: ", dump->path);
    mem_free(path);
    return code;
}

/* Do scene and file mean the same blocks? */
static int dump_show_fits(const struct dump *dump, const struct model *model)
{
    const struct blame_facts *facts = &dump->facts;
    bool fits = (unsigned)model->dim == dump->dim && model_numbered(model, facts->pure);
    for (int d = model->dim; d < 3; d++) fits = fits && facts->n[d] == 1;
    for (int i = 0; fits && i < BLAME_BLOCKS; i++) {
        struct blame_shape shape = blame_shape(model, facts, (enum blame_block)i);
        fits = shape.rows == dump->shape[i].rows && (!shape.rows || shape.columns == dump->shape[i].columns);
    }
    return fits ? STATUS_OK
                : status_fail(STATUS_RUN, "%s: broken dump: its blocks are not those of its case", dump->path);
}

static int dump_show_compare(FILE *out, const struct dump *dump, const struct model *model)
{
    struct blame blame = {.facts = dump->facts};
    struct blame_outcome outcome;
    memcpy(blame.block, dump->block, sizeof blame.block);
    blame_replay(model, &blame, &outcome);
    fprintf(out, "replay    %zu of %zu quantities at the faces of the cell differ, %zu of %u cells of the tile\n",
            outcome.faces, dump->shape[BLAME_FACES].columns, outcome.cells, dump->facts.n_cell);
    fprintf(out, "value     %s = %.17g: %s\n", dump->facts.field, outcome.value,
            outcome.same_value ? "the same, to the bit" : "another");
    fprintf(out, "verdict   %s: %s\n", outcome.same_verdict ? "the same" : "another",
            outcome.verdict[0] ? outcome.verdict : "no cell is wrong");
    bool same = !outcome.faces && !outcome.cells && outcome.same_value && outcome.same_verdict;
    return same ? STATUS_OK : status_fail(STATUS_EXPECT, "%s: the replay gives something else", dump->path);
}

int dump_show_replay(FILE *out, const char *path)
{
    struct dump *dump;
    struct scene *scene = NULL;
    TRY(dump_read(path, &dump));
    int code = dump_show_scene(dump, &scene);
    if (!code) {
        struct model *model = model_new(scene);
        fprintf(out, "dump      %s\n", path);
        dump_show_modules(out, dump, true);
        code = dump_show_fits(dump, model);
        if (!code) code = dump_show_compare(out, dump, model);
        model_free(model);
    }
    scene_free(scene);
    dump_read_free(dump);
    return code;
}
