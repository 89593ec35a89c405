/* snapshot.c - see snapshot.h. The order of one file: root attributes, /VTKHDF with the data,
 * the Chombo view onto them, /bulla. A failure leaves the files before it as they are. */
#include "io/snapshot.h"

#include "base/aside.h"
#include "base/comm.h"
#include "base/mem.h"
#include "base/status.h"
#include "base/text.h"
#include "base/version.h"
#include "io/chombo.h"
#include "io/filelist.h"
#include "io/h5out.h"
#include "io/leaves.h"
#include "io/parts.h"
#include "io/place.h"
#include "io/roll.h"
#include "io/vtkhdf.h"
#include "io/writers.h"

#include <stdio.h>
#include <string.h>

/* Bytes of a cell besides its fields and the numbers of its corners: a point, its offset, its type. */
enum { SNAPSHOT_FORMAT = 2, SNAPSHOT_BLOCK = 6, SNAPSHOT_CELL = 24 + 4 + 1 };

struct snapshots {
    const struct scene *scene;
    char *folder, *list_path;
    int writers;
    struct filelist list; /* rank 0 */
    struct vtkhdf_cells cells;
    bool is_beside, beside; /* files may go to the disk beside the run; this one does */
    enum { SNAPSHOT_NONE, SNAPSHOT_STORING, SNAPSHOT_NAMING } stage; /* of the file on its way; the same on all ranks */
    struct aside *work;                                              /* what this rank does for it, or NULL */
    struct parts *parts;
    char *path, *list_text;
    unsigned n_field;
    struct derive *fields;
    long last; /* step of the last file, or -1 */
};

/* Those that the case names. */
static int snapshot_find_named(struct snapshots *snapshots, const struct model *model)
{
    const struct scene *scene = model->scene;
    snapshots->fields = mem_new(scene->output.n_snapshot_field + 1u, sizeof *snapshots->fields);
    for (unsigned i = 0; i < scene->output.n_snapshot_field; i++) {
        int code = derive_find(model, scene->output.snapshot_fields[i], &snapshots->fields[i]);
        if (code) return status_wrap(code, "output.snapshots.fields: ");
    }
    snapshots->n_field = scene->output.n_snapshot_field;
    return STATUS_OK;
}

/* For a case that names no fields: the primitives of the mixture, and where each material is. */
static int snapshot_choose_fields(struct snapshots *snapshots, const struct model *model)
{
    static const char *const names[] = {"density", "velocity", "pressure"};
    const struct scene *scene = model->scene;
    snapshots->fields = mem_new(4u + scene->n_material, sizeof *snapshots->fields);
    for (; snapshots->n_field < 3; snapshots->n_field++)
        TRY(derive_find(model, names[snapshots->n_field], &snapshots->fields[snapshots->n_field]));
    for (unsigned l = 0; l < model->n_alpha; l++) {
        char *name = mem_print("alpha_%s", scene->material[l].name);
        int code = derive_find(model, name, &snapshots->fields[snapshots->n_field++]);
        mem_free(name);
        TRY(code);
    }
    return scene->n_rigid ? derive_find(model, "body", &snapshots->fields[snapshots->n_field++]) : STATUS_OK;
}

static int snapshot_find_fields(struct snapshots *snapshots, const struct model *model)
{
    bool named = model->scene->output.n_snapshot_field > 0;
    return (named ? snapshot_find_named : snapshot_choose_fields)(snapshots, model);
}

/* Removes the last file of the list. */
static void snapshot_drop(struct snapshots *snapshots)
{
    char *path = mem_print("%s/%s", snapshots->folder, snapshots->list.names[snapshots->list.n - 1]);
    remove(path);
    parts_remove(path);
    mem_free(path);
    filelist_drop(&snapshots->list);
}

/* The files of the run that is being taken up again, as far as they lie in its past. */
static void snapshot_go_on(struct snapshots *snapshots, const struct state *state)
{
    struct filelist *list = &snapshots->list;
    if (state->step == 0 || comm_rank() != 0 || filelist_read(snapshots->list_path, list)) return;
    while (list->n && list->times[list->n - 1] > state->t) snapshot_drop(snapshots);
}

void snapshot_keep(const struct snapshots *snapshots, struct notes *notes)
{
    notes_put(notes, "snapshots.files", 2, (double[]){(double)snapshots->list.n, (double)snapshots->last});
}

void snapshot_recall(struct snapshots *snapshots, const struct notes *notes)
{
    double files[2];
    if (!notes_get(notes, "snapshots.files", 2, files)) return;
    while ((double)snapshots->list.n > files[0]) snapshot_drop(snapshots);
    snapshots->last = (long)files[1];
}

int snapshot_new(const struct state *state, struct snapshots **ret_snapshots)
{
    struct snapshots *snapshots = mem_new(1, sizeof *snapshots);
    snapshots->scene = state->scene;
    snapshots->last = -1;
    snapshots->folder = mem_print("%s/fields", state->scene->output.directory);
    snapshots->list_path = mem_print("%s/%s.hdf.series", snapshots->folder, state->scene->name);
    int code = snapshot_find_fields(snapshots, state->model);
    snapshots->writers = writers_count(state->scene);
    if (!code) code = place_folder(snapshots->folder);
    if (!code) snapshot_go_on(snapshots, state);
    if (code) snapshot_free(snapshots);
    else *ret_snapshots = snapshots;
    return code;
}

/* Nothing is on its way any more. */
static void snapshot_done(struct snapshots *snapshots)
{
    parts_free(snapshots->parts);
    mem_free(snapshots->path);
    mem_free(snapshots->list_text);
    snapshots->parts = NULL;
    snapshots->path = snapshots->list_text = NULL;
    snapshots->stage = SNAPSHOT_NONE;
}

void snapshot_free(struct snapshots *snapshots)
{
    if (!snapshots) return;
    aside_end(snapshots->work);
    snapshot_done(snapshots);
    vtkhdf_forget(&snapshots->cells);
    filelist_done(&snapshots->list);
    mem_free(snapshots->fields);
    mem_free(snapshots->list_path);
    mem_free(snapshots->folder);
    mem_free(snapshots);
}

/* Level, tile coordinates, rank and covered octants of a tile. */
static void snapshot_block(int level, const struct tile *tile, int32_t *ret_block)
{
    const int32_t block[SNAPSHOT_BLOCK] = {level, tile->at[0], tile->at[1], tile->at[2], tile->rank, tile->covered};
    memcpy(ret_block, block, sizeof block);
}

/* Who wrote it: format, program, case. */
static void snapshot_write_origin(struct h5 *file, const struct scene *scene)
{
    int32_t format = SNAPSHOT_FORMAT;
    struct text materials = {0};
    for (unsigned l = 0; l < scene->n_material; l++)
        text_add(&materials, "%s%s", l ? "," : "", scene->material[l].name);
    h5_group(file, "/bulla");
    h5_attribute(file, "/bulla", "format", H5_I32, 0, &format);
    h5_attribute_text(file, "/bulla", "version", BULLA_VERSION);
    h5_attribute_text(file, "/bulla", "git", version_commit());
    h5_attribute_text(file, "/bulla", "case", scene->name);
    h5_attribute_text(file, "/bulla", "title", scene->title ? scene->title : "");
    h5_attribute_text(file, "/bulla", "materials", materials.at ? materials.at : "");
    text_done(&materials);
}

static int snapshot_write_bulla(struct h5 *file, const struct state *state, const char *provenance)
{
    const struct mesh *mesh = state->mesh;
    int32_t dim = mesh->dim, beta = mesh->beta;
    struct roll roll;
    snapshot_write_origin(file, state->scene);
    h5_attribute(file, "/bulla", "dim", H5_I32, 0, &dim);
    h5_attribute(file, "/bulla", "beta", H5_I32, 0, &beta);
    h5_attribute(file, "/bulla", "lower", H5_F64, 3, mesh->lower);
    h5_attribute(file, "/bulla", "upper", H5_F64, 3, mesh->upper);
    h5out_text(file, "/bulla/case.yaml", state->scene->resolved ? state->scene->resolved : "");
    h5out_text(file, "/bulla/provenance.json", provenance);
    roll_take(mesh, &roll);
    return roll_write(file, "/bulla/blocks", &roll, SNAPSHOT_BLOCK, snapshot_block, NULL);
}

static int snapshot_fill(struct h5 *file, const struct state *state, const struct vtkhdf_fields *fields,
                         struct vtkhdf_cells *cells, const char *provenance)
{
    int32_t step = (int32_t)state->step;
    h5_attribute(file, "/", "time", H5_F64, 0, &state->t);
    h5_attribute(file, "/", "iteration", H5_I32, 0, &step);
    struct leaves *leaves = leaves_new(state->mesh);
    int code = vtkhdf_write(file, state, leaves, fields, cells);
    if (!code && state->mesh->dim > 1) code = chombo_write(file, state, leaves, fields);
    if (!code) code = snapshot_write_bulla(file, state, provenance);
    leaves_free(leaves);
    return code;
}

/* Writes the draft of a file, and of its parts. */
static int snapshot_draft(struct snapshots *snapshots, const struct state *state, struct derive_moment *moment,
                          const struct parts *parts, const char *provenance)
{
    struct vtkhdf_fields fields = {snapshots->n_field, snapshots->fields,
                                   snapshots->scene->output.snapshot_double ? H5_F64 : H5_F32};
    struct seal seal = {0};
    struct h5 *file;
    for (unsigned i = 0; i < snapshots->n_field; i++) derive_prepare(moment, &snapshots->fields[i]);
    TRY(parts_create(parts, 0, &file));
    int code = snapshot_fill(file, state, &fields, &snapshots->cells, provenance);
    if (!code) code = parts_seal(parts, file, "/bulla/parts", seal_stamp, &seal, NULL);
    if (!code) return h5_close(file);
    h5_abandon(file);
    return code;
}

/* The file that is complete gets its name, and is listed. Rank 0. */
static int snapshot_name(void *data)
{
    struct snapshots *snapshots = data;
    TRY(place_accept_here(snapshots->path));
    return place_text_here(snapshots->list_path, snapshots->list_text);
}

/* What this rank has of a file goes to the disk; nobody has to be asked about a file without parts. */
static int snapshot_store(void *data)
{
    struct snapshots *snapshots = data;
    TRY(parts_store(snapshots->parts));
    return snapshots->writers == 1 ? snapshot_name(snapshots) : STATUS_OK;
}

/* Does `work`, beside the run if that may be. */
static void snapshot_begin(struct snapshots *snapshots, int stage, bool is_here, int (*work)(void *))
{
    snapshots->stage = stage;
    if (is_here) snapshots->work = aside_start(work, snapshots, snapshots->beside);
}

/* Ends the writing of a file one way or the other. */
static int snapshot_conclude(struct snapshots *snapshots, int code)
{
    if (code) {
        place_reject(snapshots->path);
        place_reject(snapshots->list_path);
        parts_reject(snapshots->parts);
        filelist_drop(&snapshots->list);
        snapshots->last = -1;
    } else parts_clean(snapshots->parts);
    snapshot_done(snapshots);
    return code;
}

bool snapshot_pending(const struct snapshots *snapshots)
{
    return snapshots->stage != SNAPSHOT_NONE;
}

bool snapshot_busy(const struct snapshots *snapshots)
{
    return aside_busy(snapshots->work);
}

/* Parts have their names before the file has its. */
int snapshot_settle(struct snapshots *snapshots)
{
    if (!snapshot_pending(snapshots)) return STATUS_OK;
    struct aside *work = snapshots->work;
    snapshots->work = NULL;
    int code = comm_agree(aside_end(work));
    bool has_name = snapshots->stage == SNAPSHOT_NAMING || snapshots->writers == 1;
    if (!code && !has_name) code = parts_accept(snapshots->parts);
    if (code || has_name) return snapshot_conclude(snapshots, code);
    snapshot_begin(snapshots, SNAPSHOT_NAMING, comm_rank() == 0, snapshot_name);
    return STATUS_OK;
}

int snapshot_wait(struct snapshots *snapshots)
{
    while (snapshot_pending(snapshots)) TRY(snapshot_settle(snapshots));
    return STATUS_OK;
}

/* Bytes of the points and connections of so many cells, and of a file with them, both not packed. */
static double snapshot_bytes(const struct snapshots *snapshots, double cells, double *ret_all)
{
    const struct scene *scene = snapshots->scene;
    double frame = SNAPSHOT_CELL + (double)(sizeof(int32_t) << scene->domain.dim), numbers = 0.0;
    for (unsigned i = 0; i < snapshots->n_field; i++) numbers += snapshots->fields[i].components;
    *ret_all = cells * (frame + numbers * (scene->output.snapshot_double ? sizeof(double) : sizeof(float)));
    return cells * frame;
}

/* May the file of a mesh be held in memory? */
static bool snapshot_fits(const struct snapshots *snapshots, const struct mesh *mesh)
{
    double cells = 0.0, all;
    for (int l = 0; l < mesh->n_level; l++) cells += (double)mesh->levels[l].n_tile * (double)mesh->n_cell;
    snapshot_bytes(snapshots, cells, &all);
    return all / snapshots->writers <= snapshots->scene->output.snapshot_memory;
}

double snapshot_memory(const struct model *model, double cells)
{
    struct snapshots look = {.scene = model->scene};
    double all = 0.0, frame = 0.0;
    if (!snapshot_find_fields(&look, model)) frame = snapshot_bytes(&look, cells, &all);
    mem_free(look.fields);
    return all <= model->scene->output.snapshot_memory ? all + frame : 0.0;
}

/* Makes a file, in memory or on the disk, and has it named. */
static int snapshot_put(struct snapshots *snapshots, const struct state *state, struct derive_moment *moment,
                        const char *name, const char *provenance)
{
    snapshots->beside = snapshots->is_beside && snapshot_fits(snapshots, state->mesh);
    snapshots->cells.most = snapshots->beside ? (size_t)snapshots->scene->output.snapshot_memory : 0;
    snapshots->path = mem_print("%s/%s", snapshots->folder, name);
    snapshots->parts = parts_new(snapshots->path, snapshots->writers, snapshots->beside);
    filelist_add(&snapshots->list, name, state->t);
    snapshots->list_text = filelist_text(&snapshots->list);
    int code = snapshot_draft(snapshots, state, moment, snapshots->parts, provenance);
    if (!code && !snapshots->list_text)
        code = status_fail(STATUS_RUN, "%s: a file name is not UTF-8", snapshots->list_path);
    code = comm_agree(code);
    if (code) return snapshot_conclude(snapshots, code);
    bool is_here = comm_rank() == 0 || writers_here(snapshots->writers);
    snapshot_begin(snapshots, SNAPSHOT_STORING, is_here, snapshot_store);
    snapshots->last = state->step;
    return snapshots->beside ? STATUS_OK : snapshot_wait(snapshots);
}

int snapshot_write(struct snapshots *snapshots, const struct state *state, struct derive_moment *moment,
                   const char *provenance)
{
    if (snapshots->last == state->step) return STATUS_OK;
    TRY(snapshot_wait(snapshots));
    char *name = mem_print("%s_%06ld.hdf", state->scene->name, state->step);
    int code = snapshot_put(snapshots, state, moment, name, provenance);
    mem_free(name);
    return code;
}

void snapshot_beside(struct snapshots *snapshots)
{
    snapshots->is_beside = true;
}
