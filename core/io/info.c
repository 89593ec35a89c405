/* info.c - see info.h. */
#include "io/info.h"

#include "base/status.h"
#include "io/read.h"
#include "io/resume.h"
#include "io/seal.h"

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

int info_print(FILE *out, const char *path)
{
    struct snapshot *snapshot;
    if (seal_is(path)) return resume_info(out, path);
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
