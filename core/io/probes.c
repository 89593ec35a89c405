/* probes.c - see probes.h. What the points see is sample.c's; here are the times and the file. */
#include "io/probes.h"

#include "base/comm.h"
#include "base/mem.h"
#include "base/status.h"
#include "base/text.h"
#include "derive/derive.h"
#include "io/csv.h"
#include "io/place.h"
#include "io/sample.h"

#include <math.h>
#include <string.h>

/* One field of one probe. */
struct probes_trace {
    unsigned point, first, part; /* first: its first column; part: where its parts are */
    struct derive field;
};

struct probes {
    struct csv *csv;
    char *header;
    unsigned n_trace, n_value, n_part; /* n_value: columns after t */
    struct sample *sample;             /* the places of all probes */
    struct probes_trace *traces;
    double *parts;              /* [n_part] of sample_collect */
    double *before, *now, *row; /* [n_value], [n_value], [1 + n_value] */
    double t_before, t_row;     /* of the last sample, of the last row; -infinity: none */
    long next, step;            /* next row is due at next * every; last step sampled */
    struct scene_every every;
};

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
    const struct scene_probe *probe = &state->scene->output.probes[index];
    for (unsigned i = 0; i < probe->n_field; i++) {
        struct probes_trace *trace = &probes->traces[probes->n_trace++];
        *trace = (struct probes_trace){.point = index, .first = probes->n_value, .part = probes->n_part};
        int code = derive_find(state->model, probe->fields[i], &trace->field);
        if (code) return status_wrap(code, "output.probes.%s.fields: ", probe->name);
        probes->n_part += sample_room(probes->sample, &trace->field);
        for (unsigned q = 0; q < trace->field.components; q++, probes->n_value++) {
            text_add(header, ",%s.%s", probe->name, probe->fields[i]);
            if (trace->field.components > 1) text_add(header, "_%c", "xyz"[q]);
        }
    }
    return STATUS_OK;
}

static int probes_place(struct probes *probes, const struct state *state)
{
    const struct scene *scene = state->scene;
    double(*at)[3] = mem_new(scene->output.n_probe, sizeof *at);
    int code = STATUS_OK;
    for (unsigned i = 0; !code && i < scene->output.n_probe; i++) {
        code = probes_check(state->mesh, &scene->output.probes[i]);
        memcpy(at[i], scene->output.probes[i].at, sizeof at[i]);
    }
    if (!code) probes->sample = sample_new(state->mesh, scene->output.n_probe, (const double(*)[3])at);
    mem_free(at);
    return code;
}

static int probes_prepare(struct probes *probes, const struct state *state, struct text *header)
{
    const struct scene *scene = state->scene;
    unsigned n_trace = 0;
    for (unsigned i = 0; i < scene->output.n_probe; i++) n_trace += scene->output.probes[i].n_field;
    probes->traces = mem_new(n_trace, sizeof *probes->traces);
    TRY(probes_place(probes, state));
    text_add(header, "t");
    for (unsigned i = 0; i < scene->output.n_probe; i++) TRY(probes_find_fields(probes, state, i, header));
    probes->parts = mem_new(probes->n_part, sizeof(double));
    probes->before = mem_new(probes->n_value, sizeof(double));
    probes->now = mem_new(probes->n_value, sizeof(double));
    probes->row = mem_new(probes->n_value + 1u, sizeof(double));
    return place_folder(scene->output.directory);
}

int probes_new(const struct state *state, struct probes **ret_probes)
{
    const struct scene *scene = state->scene;
    *ret_probes = NULL;
    if (!scene->output.n_probe) return STATUS_OK;
    struct probes *probes = mem_new(1, sizeof *probes);
    struct text header = {0};
    bool resume = state->step > 0;
    probes->every = scene->output.probes_every;
    probes->step = -1;
    probes->t_before = -INFINITY;
    probes->t_row = resume ? state->t : -INFINITY;
    if (probes->every.time > 0.0 && resume) probes->next = 1 + (long)floor(state->t / probes->every.time + 1e-9);
    int code = probes_prepare(probes, state, &header);
    char *path = mem_print("%s/probes.csv", scene->output.directory);
    if (!code) code = csv_open(path, header.at, NULL, resume, state->t, &probes->csv);
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
    sample_free(probes->sample);
    mem_free(probes->traces);
    mem_free(probes->parts);
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

static void probes_sample(struct probes *probes, const struct state *state, struct derive_moment *moment)
{
    for (unsigned i = 0; i < probes->n_trace; i++) {
        struct probes_trace *trace = &probes->traces[i];
        derive_prepare(moment, &trace->field);
        sample_collect(probes->sample, state, &trace->field, trace->point, 1, probes->parts + trace->part);
    }
    comm_max(probes->parts, (int)probes->n_part);
    for (unsigned i = 0; i < probes->n_trace; i++) {
        const struct probes_trace *trace = &probes->traces[i];
        sample_blend(probes->sample, &trace->field, trace->point, 1, probes->parts + trace->part, 0,
                     probes->now + trace->first);
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

int probes_record(struct probes *probes, const struct state *state, struct derive_moment *moment)
{
    if (!probes || probes->step == state->step) return STATUS_OK;
    probes_sample(probes, state, moment);
    TRY(probes_rows(probes, state));
    memcpy(probes->before, probes->now, probes->n_value * sizeof *probes->before);
    probes->t_before = state->t;
    probes->step = state->step;
    return STATUS_OK;
}

int probes_finish(struct probes *probes, const struct state *state, struct derive_moment *moment)
{
    if (!probes) return STATUS_OK;
    TRY(probes_record(probes, state, moment));
    if (probes->t_row >= state->t) return STATUS_OK;
    memcpy(probes->now, probes->before, probes->n_value * sizeof *probes->now);
    return probes_row(probes, state->t, state->t);
}
