/* snapshot.c - see snapshot.h. The order of one file: root attributes, /VTKHDF with the data,
 * the Chombo view onto them, /bulla. A failure leaves the files before it as they are. */
#include "io/snapshot.h"

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
#include "io/vtkhdf.h"
#include "io/writers.h"

#include <stdio.h>
#include <string.h>

enum { SNAPSHOT_FORMAT = 2, SNAPSHOT_BLOCK = 6 };

struct snapshots {
    const struct scene *scene;
    char *folder, *list_path;
    int writers;
    struct filelist list; /* rank 0 */
    unsigned n_field;
    struct derive *fields;
    long last; /* step of the last file, or -1 */
};

static int snapshot_find_fields(struct snapshots *snapshots, const struct state *state)
{
    const struct scene *scene = state->scene;
    snapshots->fields = mem_new(scene->output.n_snapshot_field + 1u, sizeof *snapshots->fields);
    for (unsigned i = 0; i < scene->output.n_snapshot_field; i++) {
        int code = derive_find(state->model, scene->output.snapshot_fields[i], &snapshots->fields[i]);
        if (code) return status_wrap(code, "output.snapshots.fields: ");
    }
    snapshots->n_field = scene->output.n_snapshot_field;
    return STATUS_OK;
}

/* For a case that names no fields: the primitives of the mixture, and where each material is. */
static int snapshot_choose_fields(struct snapshots *snapshots, const struct state *state)
{
    static const char *const names[] = {"density", "velocity", "pressure"};
    const struct scene *scene = state->scene;
    snapshots->fields = mem_new(4u + scene->n_material, sizeof *snapshots->fields);
    for (; snapshots->n_field < 3; snapshots->n_field++)
        TRY(derive_find(state->model, names[snapshots->n_field], &snapshots->fields[snapshots->n_field]));
    for (unsigned l = 0; l < state->model->n_alpha; l++) {
        char *name = mem_print("alpha_%s", scene->material[l].name);
        int code = derive_find(state->model, name, &snapshots->fields[snapshots->n_field++]);
        mem_free(name);
        TRY(code);
    }
    return scene->n_rigid ? derive_find(state->model, "body", &snapshots->fields[snapshots->n_field++]) : STATUS_OK;
}

/* Removes the last file of the list. */
static void snapshot_drop(struct snapshots *snapshots)
{
    char *path = mem_print("%s/%s", snapshots->folder, snapshots->list.names[--snapshots->list.n]);
    remove(path);
    parts_remove(path);
    mem_free(path);
    mem_free(snapshots->list.names[snapshots->list.n]);
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
    int code = state->scene->output.n_snapshot_field ? snapshot_find_fields(snapshots, state)
                                                     : snapshot_choose_fields(snapshots, state);
    snapshots->writers = writers_count(state->scene);
    if (!code) code = place_folder(snapshots->folder);
    if (!code) snapshot_go_on(snapshots, state);
    if (code) snapshot_free(snapshots);
    else *ret_snapshots = snapshots;
    return code;
}

void snapshot_free(struct snapshots *snapshots)
{
    if (!snapshots) return;
    filelist_done(&snapshots->list);
    mem_free(snapshots->fields);
    mem_free(snapshots->list_path);
    mem_free(snapshots->folder);
    mem_free(snapshots);
}

/* Level, tile coordinates, rank and covered octants of every tile. */
static void snapshot_write_blocks(struct h5 *file, const struct mesh *mesh)
{
    size_t n = 0, at = 0;
    for (int l = 0; l < mesh->n_level; l++) n += mesh->levels[l].n_tile;
    int32_t *blocks = mem_new(n * SNAPSHOT_BLOCK, sizeof *blocks);
    for (int l = 0; l < mesh->n_level; l++)
        for (unsigned i = 0; i < mesh->levels[l].n_tile; i++) {
            const struct tile *tile = &mesh->levels[l].tiles[i];
            const int32_t block[SNAPSHOT_BLOCK] = {l, tile->at[0], tile->at[1], tile->at[2], tile->rank, tile->covered};
            for (int q = 0; q < SNAPSHOT_BLOCK; q++) blocks[at++] = block[q];
        }
    h5out_array(file, "/bulla/blocks", H5_I32, n, SNAPSHOT_BLOCK, blocks);
    mem_free(blocks);
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

static void snapshot_write_bulla(struct h5 *file, const struct state *state, const char *provenance)
{
    const struct mesh *mesh = state->mesh;
    int32_t dim = mesh->dim, beta = mesh->beta;
    snapshot_write_origin(file, state->scene);
    h5_attribute(file, "/bulla", "dim", H5_I32, 0, &dim);
    h5_attribute(file, "/bulla", "beta", H5_I32, 0, &beta);
    h5_attribute(file, "/bulla", "lower", H5_F64, 3, mesh->lower);
    h5_attribute(file, "/bulla", "upper", H5_F64, 3, mesh->upper);
    h5out_text(file, "/bulla/case.yaml", state->scene->resolved ? state->scene->resolved : "");
    h5out_text(file, "/bulla/provenance.json", provenance);
    snapshot_write_blocks(file, mesh);
}

static int snapshot_fill(struct h5 *file, const struct state *state, const struct vtkhdf_fields *fields,
                         const char *provenance)
{
    int32_t step = (int32_t)state->step;
    h5_attribute(file, "/", "time", H5_F64, 0, &state->t);
    h5_attribute(file, "/", "iteration", H5_I32, 0, &step);
    struct leaves *leaves = leaves_new(state->mesh);
    int code = vtkhdf_write(file, state, leaves, fields);
    if (!code && state->mesh->dim > 1) chombo_write(file, state, leaves, fields);
    if (!code) snapshot_write_bulla(file, state, provenance);
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
    int code = snapshot_fill(file, state, &fields, provenance);
    if (!code) code = parts_seal(parts, file, "/bulla/parts", seal_stamp, &seal, NULL);
    if (!code) return h5_close(file);
    h5_abandon(file);
    return code;
}

/* Writes a file under its name. */
static int snapshot_put(struct snapshots *snapshots, const struct state *state, struct derive_moment *moment,
                        const char *path, const char *provenance)
{
    struct parts *parts = parts_new(path, snapshots->writers);
    int code = snapshot_draft(snapshots, state, moment, parts, provenance);
    if (!code) code = parts_accept(parts);
    if (code) place_reject(path);
    else code = place_accept(path);
    if (code) parts_reject(parts);
    else parts_clean(parts);
    parts_free(parts);
    return code;
}

int snapshot_write(struct snapshots *snapshots, const struct state *state, struct derive_moment *moment,
                   const char *provenance)
{
    if (snapshots->last == state->step) return STATUS_OK;
    char *name = mem_print("%s_%06ld.hdf", state->scene->name, state->step);
    char *path = mem_print("%s/%s", snapshots->folder, name);
    int code = snapshot_put(snapshots, state, moment, path, provenance);
    if (!code) {
        filelist_add(&snapshots->list, name, state->t);
        code = filelist_write(&snapshots->list, snapshots->list_path);
        snapshots->last = state->step;
    }
    mem_free(path);
    mem_free(name);
    return code;
}
