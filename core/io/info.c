/* info.c - see info.h. */
#include "io/info.h"

#include "base/mem.h"
#include "base/status.h"
#include "io/dump_read.h"
#include "io/dump_show.h"
#include "io/read.h"
#include "io/resume.h"

#include <string.h>

static void info_print_domain(FILE *out, const struct snapshot *snapshot)
{
    static const char *const geometries[] = {"cartesian", "axisymmetric (x = r, y = z)", "spherical (x = r)"};
    fprintf(out, "domain    %dD %s, ", snapshot->dim, geometries[snapshot->beta]);
    for (int axis = 0; axis < snapshot->dim; axis++)
        fprintf(out, "%s[%g, %g]", axis ? " x " : "", snapshot->domain[0][axis], snapshot->domain[1][axis]);
    fprintf(out, " m\ncells     %zu", snapshot->n_cell);
    double least = snapshot->n_cell ? snapshot->upper[0][0] - snapshot->lower[0][0] : 0.0, most = least;
    for (size_t i = 0; i < snapshot->n_cell; i++) {
        double width = snapshot->upper[i][0] - snapshot->lower[i][0];
        least = width < least ? width : least;
        most = width > most ? width : most;
    }
    if (most - least <= 1e-6 * most) fprintf(out, ", %.6g m wide\n", most);
    else fprintf(out, ", %.6g to %.6g m wide\n", least, most);
}

/* Tiles and leaves of each level. */
static void info_print_levels(FILE *out, const struct snapshot *snapshot)
{
    if (snapshot->n_level == 1) {
        fprintf(out, "tiles     %zu\n", snapshot->n_tile);
        return;
    }
    fprintf(out, "levels    %d\n", snapshot->n_level);
    for (int l = 0; l < snapshot->n_level; l++) {
        size_t n_tile = 0, n_cell = 0, under = 0;
        double width = 0.0;
        for (size_t i = 0; i < snapshot->n_tile; i++) {
            const struct snapshot_tile *tile = &snapshot->tiles[i];
            if (tile->level != l) continue;
            n_tile++;
            n_cell += tile->n_cell;
            under += tile->n_cell == 0;
            if (tile->n_cell) width = snapshot->upper[tile->first][0] - snapshot->lower[tile->first][0];
        }
        fprintf(out, "  %-2d      %zu tiles (%zu under finer ones), %zu cells", l, n_tile, under, n_cell);
        if (n_cell) fprintf(out, ", %.6g m wide", width);
        fputc('\n', out);
    }
}

static void info_print_fields(FILE *out, const struct snapshot *snapshot)
{
    int width = (int)strlen("field");
    for (unsigned i = 0; i < snapshot->n_field; i++) {
        int length = (int)strlen(snapshot->fields[i].name);
        width = length > width ? length : width;
    }
    fprintf(out, "\n%-*s  %-8s  %14s  %14s\n", width, "field", "unit", "least", "most");
    for (unsigned i = 0; i < snapshot->n_field; i++) {
        const struct snapshot_field *field = &snapshot->fields[i];
        fprintf(out, "%-*s  %-8s  %14.7g  %14.7g%s\n", width, field->name, field->unit, field->least, field->most,
                field->components > 1 ? "  (magnitude)" : "");
    }
}

/* A line of notes, "?" if it is missing. */
static void info_print_line(FILE *out, const struct resume *resume, const char *const line[3])
{
    char *text = notes_get_text(&resume->notes, line[1]);
    fprintf(out, "%-11s%s%s\n", line[0], text ? text : "?", line[2]);
    mem_free(text);
}

static void info_print_tiles(FILE *out, const struct resume *resume)
{
    double tile = 0.0, cells[SCENE_AXES];
    unsigned dim = 1;
    notes_get(&resume->notes, "mesh.tile", 1, &tile);
    while (dim < SCENE_AXES && !notes_get(&resume->notes, "domain.cells", dim, cells)) dim++;
    double per_tile = tile * (dim > 1 ? tile : 1.0) * (dim > 2 ? tile : 1.0);
    for (int l = 0; l < resume->n_level; l++)
        fprintf(out, "level %-5d%u tiles, %.0f cells\n", l, resume->n_tile[l], resume->n_tile[l] * per_tile);
}

static void info_print_resume(FILE *out, const struct resume *resume)
{
    static const char *const lines[][3] = {
        {"case", "case.name", ""},       {"title", "case.title", ""},
        {"by", "written.by", ""},        {"at", "written.at", ""},
        {"ranks", "written.ranks", ""},  {"time", "state.t", " s"},
        {"step", "state.step", ""},      {"geometry", "domain.geometry", ""},
        {"lower", "domain.lower", " m"}, {"upper", "domain.upper", " m"},
        {"cells", "domain.cells", ""},   {"tile", "mesh.tile", ""},
        {"materials", "materials", ""},  {"fields", "fields", ""},
    };
    fprintf(out, "checkpoint %s\n", resume->path);
    for (size_t i = 0; i < sizeof lines / sizeof *lines; i++) info_print_line(out, resume, lines[i]);
    info_print_tiles(out, resume);
    double bytes = (double)resume->seal.bytes;
    for (unsigned i = 0; resume->seal.kind == SEAL_HEAD && i < resume->n_part; i++)
        bytes += (double)resume->parts[i].seal.bytes;
    if (resume->seal.kind == SEAL_HEAD) fprintf(out, "parts      %u\n", resume->n_part);
    fprintf(out, "size       %.3f MB, all checksums hold\n", bytes / 1e6);
}

static int info_print_checkpoint(FILE *out, const char *path)
{
    struct resume *resume;
    TRY(resume_look(path, &resume));
    info_print_resume(out, resume);
    resume_close(resume);
    return STATUS_OK;
}

int info_print(FILE *out, const char *path)
{
    struct snapshot *snapshot;
    if (seal_is(path)) return info_print_checkpoint(out, path);
    if (seal_is_piece(path))
        return status_fail(STATUS_RUN,
                           "%s: a part of a snapshot or checkpoint: its name without what follows .hdf or .chk "
                           "opens all of it",
                           path);
    if (dump_read_is(path)) return dump_show(out, path);
    TRY(read_snapshot(path, NULL, &snapshot));
    fprintf(out, "snapshot  %s\ncase      %s", path, snapshot->name);
    if (*snapshot->title) fprintf(out, ": %s", snapshot->title);
    fprintf(out, "\nby        bulla %s\ntime      %.9g s\nstep      %ld\n", snapshot->version, snapshot->time,
            snapshot->step);
    info_print_domain(out, snapshot);
    info_print_levels(out, snapshot);
    fprintf(out, "materials");
    for (unsigned l = 0; l < snapshot->n_material; l++) fprintf(out, "%s%s", l ? ", " : " ", snapshot->materials[l]);
    fputc('\n', out);
    info_print_fields(out, snapshot);
    read_free(snapshot);
    return STATUS_OK;
}
