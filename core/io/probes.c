/* probes.c - see probes.h. The cells around a point are found once per mesh; at a sample each rank fills in
 * those that it holds, a maximum over the ranks brings them together, and every rank interpolates
 * the same numbers in the same way. */
#include "io/probes.h"

#include "base/comm.h"
#include "base/mem.h"
#include "base/status.h"
#include "base/text.h"
#include "io/csv.h"
#include "io/place.h"
#include "phys/derive.h"

#include <math.h>
#include <string.h>

enum { PROBES_CORNERS = 8 };

/* The cells around a probe, x fastest: up to 2 per axis. */
struct probes_point {
    int level;
    int at[PROBES_CORNERS][3]; /* cell of the level */
    double weight[PROBES_CORNERS];
};

/* One field of one probe. */
struct probes_trace {
    unsigned point, first; /* first: its first column */
    struct derive field;
};

struct probes {
    struct csv *csv;
    char *header;
    unsigned n_corner, n_trace, n_value; /* n_value: columns after t */
    struct probes_point *points;
    unsigned revision; /* of the mesh in which points were found */
    struct probes_trace *traces;
    double *corners, *tile;     /* [n_value][n_corner]; [3][cells of a tile] */
    double *before, *now, *row; /* [n_value], [n_value], [1 + n_value] */
    double t_before, t_row;     /* of the last sample, of the last row; -infinity: none */
    long next, step;            /* next row is due at next * every; last step sampled */
    struct scene_every every;
};

/* Lower of the two cells of a level around a coordinate, and the share of the upper one. */
static int probes_bracket(const struct mesh *mesh, const struct level *level, int axis, double x, double *ret_share)
{
    int cells = level->extent[axis] * mesh->n[axis];
    double place = (x - mesh->lower[axis]) / level->h[axis] - 0.5, below = floor(place);
    *ret_share = place - below;
    if (mesh->periodic[axis]) return (int)below;
    if (below < 0.0) *ret_share = 0.0;
    if (below >= cells - 1) *ret_share = 0.0;
    return below < 0.0 ? 0 : below >= cells - 1 ? cells - 1 : (int)below;
}

/* The tile of a level that holds a cell, or -1; ret_cell: the cell in it. */
static int probes_tile(const struct mesh *mesh, const struct level *level, const int at[3], size_t *ret_cell)
{
    const int *n = mesh->n, tile[3] = {at[0] / n[0], at[1] / n[1], at[2] / n[2]};
    *ret_cell = (size_t)(at[0] % n[0] + n[0] * (at[1] % n[1] + n[1] * (at[2] % n[2])));
    return mesh_find(mesh, level, tile);
}

/* The cells of a level around x; false if one of them is not there. */
static bool probes_surround(const struct mesh *mesh, int l, const double x[3], struct probes_point *point)
{
    const struct level *level = &mesh->levels[l];
    int below[3] = {0};
    double share[3] = {0};
    bool there = true;
    point->level = l;
    for (int axis = 0; axis < mesh->dim; axis++) below[axis] = probes_bracket(mesh, level, axis, x[axis], &share[axis]);
    for (int corner = 0; corner < 1 << mesh->dim; corner++) {
        size_t cell;
        point->weight[corner] = 1.0;
        for (int axis = 0; axis < 3; axis++) {
            bool upper = corner >> axis & 1;
            int cells = level->extent[axis] * mesh->n[axis];
            int at = below[axis] + (upper && (share[axis] > 0.0));
            point->at[corner][axis] = (at + cells) % cells;
            if (axis < mesh->dim) point->weight[corner] *= upper ? share[axis] : 1.0 - share[axis];
        }
        there = there && probes_tile(mesh, level, point->at[corner], &cell) >= 0;
    }
    return there;
}

/* Finds the cells around every probe: at the start, and again when tiles have come or gone. */
static void probes_look(struct probes *probes, const struct state *state)
{
    const struct mesh *mesh = state->mesh;
    for (unsigned i = 0; i < state->scene->n_probe; i++) {
        size_t cell;
        int l;
        mesh_locate(mesh, state->scene->probes[i].at, &l, &cell);
        if (!probes_surround(mesh, l, state->scene->probes[i].at, &probes->points[i]))
            probes_surround(mesh, l - 1, state->scene->probes[i].at, &probes->points[i]);
    }
    probes->revision = mesh->revision;
}

static int probes_check(const struct mesh *mesh, const struct scene_probe *probe)
{
    for (int axis = 0; axis < mesh->dim; axis++)
        if (!(probe->at[axis] >= mesh->lower[axis] && probe->at[axis] <= mesh->upper[axis]))
            return status_fail(STATUS_CASE,
                               "output.probes.%s.at: %g m lies outside the domain, which has %c from %g to %g m",
                               probe->name, probe->at[axis], "xyz"[axis], mesh -> lower[axis], mesh -> upper[axis]);
    return STATUS_OK;
}

static int probes_find_fields(struct probes *probes, const struct state *state, unsigned index, struct text *header)
{
    const struct scene_probe *probe = &state->scene->probes[index];
    for (unsigned i = 0; i < probe->n_field; i++) {
        struct probes_trace *trace = &probes->traces[probes->n_trace++];
        *trace = (struct probes_trace){.point = index, .first = probes->n_value};
        int code = derive_find(state->model, probe->fields[i], &trace->field);
        if (code) return status_wrap(code, "output.probes.%s.fields: ", probe->name);
        for (unsigned q = 0; q < trace->field.components; q++, probes->n_value++) {
            text_add(header, ",%s.%s", probe->name, probe->fields[i]);
            if (trace->field.components > 1) text_add(header, "_%c", "xyz"[q]);
        }
    }
    return STATUS_OK;
}

static int probes_prepare(struct probes *probes, const struct state *state, struct text *header)
{
    const struct scene *scene = state->scene;
    unsigned n_trace = 0;
    for (unsigned i = 0; i < scene->n_probe; i++) n_trace += scene->probes[i].n_field;
    probes->points = mem_new(scene->n_probe, sizeof *probes->points);
    probes->traces = mem_new(n_trace, sizeof *probes->traces);
    probes->n_corner = 1u << state->mesh->dim;
    text_add(header, "t");
    for (unsigned i = 0; i < scene->n_probe; i++) {
        TRY(probes_check(state->mesh, &scene->probes[i]));
        TRY(probes_find_fields(probes, state, i, header));
    }
    probes_look(probes, state);
    probes->corners = mem_new(probes->n_value * probes->n_corner, sizeof(double));
    probes->tile = mem_new(3 * state->mesh->n_cell, sizeof(double));
    probes->before = mem_new(probes->n_value, sizeof(double));
    probes->now = mem_new(probes->n_value, sizeof(double));
    probes->row = mem_new(probes->n_value + 1u, sizeof(double));
    return place_folder(scene->directory);
}

int probes_new(const struct state *state, struct probes **ret_probes)
{
    const struct scene *scene = state->scene;
    *ret_probes = NULL;
    if (!scene->n_probe) return STATUS_OK;
    struct probes *probes = mem_new(1, sizeof *probes);
    struct text header = {0};
    bool resume = state->step > 0;
    probes->every = scene->probes_every;
    probes->step = -1;
    probes->t_before = -INFINITY;
    probes->t_row = resume ? state->t : -INFINITY;
    if (probes->every.time > 0.0 && resume) probes->next = 1 + (long)floor(state->t / probes->every.time + 1e-9);
    int code = probes_prepare(probes, state, &header);
    char *path = mem_print("%s/probes.csv", scene->directory);
    if (!code) code = csv_open(path, header.at, resume, state->t, &probes->csv);
    mem_free(path);
    probes->header = mem_text(header.at);
    text_done(&header);
    if (code) probes_free(probes);
    else *ret_probes = probes;
    return code;
}

void probes_free(struct probes *probes)
{
    if (!probes) return;
    csv_close(probes->csv);
    mem_free(probes->header);
    mem_free(probes->points);
    mem_free(probes->traces);
    mem_free(probes->corners);
    mem_free(probes->tile);
    mem_free(probes->before);
    mem_free(probes->now);
    mem_free(probes->row);
    mem_free(probes);
}

int probes_keep(struct probes *probes, struct notes *notes)
{
    if (!probes) return STATUS_OK;
    const double place[] = {probes->t_before, probes->t_row, (double)probes->step};
    const double next[] = {probes->every.time, (double)probes->every.steps, (double)probes->next};
    notes_put_text(notes, "probes.columns", probes->header);
    notes_put(notes, "probes.place", 3, place);
    notes_put(notes, "probes.next", 3, next);
    notes_put(notes, "probes.before", probes->n_value, probes->before);
    return csv_keep(probes->csv, "probes.csv", notes);
}

int probes_recall(struct probes *probes, const struct notes *notes, const char *origin)
{
    double place[3], next[3];
    char *columns = notes_get_text(notes, "probes.columns");
    bool same = probes && columns && !strcmp(columns, probes->header);
    mem_free(columns);
    if (!same || !notes_get(notes, "probes.before", probes->n_value, probes->before)) return STATUS_OK;
    if (notes_get(notes, "probes.place", 3, place)) {
        probes->t_before = place[0];
        probes->t_row = place[1];
        probes->step = (long)place[2];
    }
    if (notes_get(notes, "probes.next", 3, next) && next[0] == probes->every.time &&
        (long)next[1] == probes->every.steps)
        probes->next = (long)next[2];
    char *path = mem_print("%s/probes.csv", origin);
    int code = csv_recall(probes->csv, "probes.csv", notes, path);
    mem_free(path);
    return code;
}

/* Values of a field in those cells around its point that this rank holds. */
static void probes_collect(struct probes *probes, const struct state *state, const struct probes_trace *trace)
{
    const struct mesh *mesh = state->mesh;
    const struct probes_point *point = &probes->points[trace->point];
    const struct level *level = &mesh->levels[point->level];
    int derived = -1; /* the tile that is in probes->tile */
    for (unsigned corner = 0; corner < probes->n_corner; corner++) {
        size_t cell;
        int tile = probes_tile(mesh, level, point->at[corner], &cell);
        if (level->tiles[tile].rank != comm_rank()) continue;
        if (tile != derived)
            derive_tile(state->model, mesh, point->level, (unsigned)tile - level->first, state->t, &trace->field,
                        probes->tile);
        derived = tile;
        for (unsigned q = 0; q < trace->field.components; q++)
            probes->corners[(trace->first + q) * probes->n_corner + corner] = probes->tile[q * mesh->n_cell + cell];
    }
}

static void probes_sample(struct probes *probes, const struct state *state)
{
    unsigned n = probes->n_value * probes->n_corner;
    for (unsigned i = 0; i < n; i++) probes->corners[i] = -INFINITY;
    if (probes->revision != state->mesh->revision) probes_look(probes, state);
    for (unsigned i = 0; i < probes->n_trace; i++) {
        derive_prepare(state->model, state->mesh, state->t, &probes->traces[i].field);
        probes_collect(probes, state, &probes->traces[i]);
    }
    comm_max(probes->corners, (int)n);
    for (unsigned i = 0; i < probes->n_trace; i++) {
        const struct probes_trace *trace = &probes->traces[i];
        for (unsigned q = trace->first; q < trace->first + trace->field.components; q++) {
            double sum = 0.0;
            for (unsigned corner = 0; corner < probes->n_corner; corner++) {
                double weight = probes->points[trace->point].weight[corner];
                if (weight > 0.0) sum += weight * probes->corners[q * probes->n_corner + corner];
            }
            probes->now[q] = isinf(sum) ? NAN : sum; /* a NaN is lost in the maximum */
        }
    }
}

/* A row at time t, between the last two samples. */
static int probes_row(struct probes *probes, double t, double t_now)
{
    double share = t >= t_now ? 1.0 : (t - probes->t_before) / (t_now - probes->t_before);
    probes->row[0] = t;
    for (unsigned q = 0; q < probes->n_value; q++)
        probes->row[q + 1] =
            share >= 1.0 ? probes->now[q] : probes->before[q] + share * (probes->now[q] - probes->before[q]);
    probes->t_row = t;
    return csv_row(probes->csv, probes->n_value + 1, probes->row);
}

static int probes_rows(struct probes *probes, const struct state *state)
{
    double every = probes->every.time;
    if (every <= 0.0) {
        bool due = probes->every.steps <= 0 || state->step % probes->every.steps == 0;
        return due && state->t > probes->t_row ? probes_row(probes, state->t, state->t) : STATUS_OK;
    }
    /* times are multiples, never sums; closer than 1e-9 of the interval is the same time */
    while ((double)probes->next * every <= state->t + 1e-9 * every) {
        double t = (double)probes->next * every;
        TRY(probes_row(probes, fabs(t - state->t) <= 1e-9 * every ? state->t : t, state->t));
        probes->next++;
    }
    return STATUS_OK;
}

int probes_record(struct probes *probes, const struct state *state)
{
    if (!probes || probes->step == state->step) return STATUS_OK;
    probes_sample(probes, state);
    TRY(probes_rows(probes, state));
    memcpy(probes->before, probes->now, probes->n_value * sizeof *probes->before);
    probes->t_before = state->t;
    probes->step = state->step;
    return STATUS_OK;
}

int probes_finish(struct probes *probes, const struct state *state)
{
    if (!probes) return STATUS_OK;
    TRY(probes_record(probes, state));
    if (probes->t_row >= state->t) return STATUS_OK;
    memcpy(probes->now, probes->before, probes->n_value * sizeof *probes->now);
    return probes_row(probes, state->t, state->t);
}
