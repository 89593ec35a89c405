/* maps.c - see maps.h: when rows are due, and the files. */
#include "io/maps.h"

#include "base/mem.h"
#include "base/status.h"
#include "io/csv.h"
#include "io/map_store.h"
#include "io/place.h"

#include <math.h>
#include <string.h>
#include <xxhash.h>

struct maps_one {
    struct map_values values;
    struct csv *csv;
    char *name, *path, *header; /* name: of the file in the directory */
    char *kind;                 /* columns and places: tables of another kind are not gone on with */
    double *rows;               /* [n_point][map_store_head + n_value] */
};

struct maps {
    unsigned n;
    struct maps_one *ones;
    struct scene_every every;
    double t_row; /* of the last rows; -infinity: none */
    long next;    /* rows are due at next * every */
};

/* The numbers that tell places apart, in the rows as in the table: a new array. */
static double *maps_places(const struct scene_map *map)
{
    unsigned n_number = map_store_head(map) - 1;
    double *places = mem_new((size_t)map->n_point * n_number, sizeof *places);
    for (unsigned i = 0; i < map->n_point; i++) {
        places[(size_t)i * n_number] = map->place[i];
        if (map->second) places[(size_t)i * n_number + 1] = map->second[i];
    }
    return places;
}

static int maps_open(struct maps_one *one, const struct state *state, const struct scene_map *map)
{
    struct text header = {0};
    bool resume = state->step > 0;
    text_add(&header, "t,%s", map_store_place(map));
    int code = map_values_init(&one->values, state, map, &header);
    one->name = mem_print("maps/%s.csv", map->name);
    one->path = mem_print("%s/%s", state->scene->output.directory, one->name);
    one->header = mem_text(header.at);
    one->rows = mem_new((size_t)map->n_point * (map_store_head(map) + one->values.n_value), sizeof(double));
    text_done(&header);
    double *numbers = maps_places(map);
    struct csv_places places = {map->n_point, map_store_head(map) - 1, numbers};
    size_t bytes = (size_t)places.n * places.n_number * sizeof *numbers;
    one->kind = mem_print("%s %u %016llx", one->header, places.n, (unsigned long long)XXH64(numbers, bytes, 0));
    if (!code) code = csv_open(one->path, one->header, &places, resume, state->t, &one->csv);
    mem_free(numbers);
    return code;
}

static void maps_schedule(struct maps *maps, double t)
{
    if (maps->every.time > 0.0) maps->next = 1 + (long)floor(t / maps->every.time + 1e-9);
    maps->t_row = t;
}

int maps_new(const struct state *state, struct maps **ret_maps)
{
    const struct scene *scene = state->scene;
    *ret_maps = NULL;
    if (!scene->output.n_map) return STATUS_OK;
    struct maps *maps = mem_new(1, sizeof *maps);
    maps->ones = mem_new(scene->output.n_map, sizeof *maps->ones);
    maps->every = scene->output.maps_every;
    maps->t_row = -INFINITY;
    if (state->step > 0) maps_schedule(maps, state->t);
    char *folder = mem_print("%s/maps", scene->output.directory);
    int code = place_folder(folder);
    for (; !code && maps->n < scene->output.n_map; maps->n++)
        code = maps_open(&maps->ones[maps->n], state, &scene->output.maps[maps->n]);
    mem_free(folder);
    if (code) maps_free(maps);
    else *ret_maps = maps;
    return code;
}

void maps_free(struct maps *maps)
{
    if (!maps) return;
    for (unsigned i = 0; i < maps->n; i++) {
        struct maps_one *one = &maps->ones[i];
        csv_close(one->csv);
        map_values_done(&one->values);
        mem_free(one->name);
        mem_free(one->path);
        mem_free(one->header);
        mem_free(one->kind);
        mem_free(one->rows);
    }
    mem_free(maps->ones);
    mem_free(maps);
}

int maps_keep(struct maps *maps, struct notes *notes)
{
    if (!maps) return STATUS_OK;
    const double schedule[] = {maps->every.time, (double)maps->every.steps, (double)maps->next, maps->t_row};
    notes_put(notes, "maps.schedule", 4, schedule);
    for (unsigned i = 0; i < maps->n; i++) {
        const struct maps_one *one = &maps->ones[i];
        char *columns = mem_print("%s.columns", one->name);
        notes_put_text(notes, columns, one->kind);
        mem_free(columns);
        TRY(csv_keep(one->csv, one->name, notes));
    }
    return STATUS_OK;
}

static int maps_return(struct maps_one *one, const struct notes *notes, const char *origin)
{
    char *key = mem_print("%s.columns", one->name), *columns = notes_get_text(notes, key);
    char *past = mem_print("%s/%s", origin, one->name);
    bool same = columns && !strcmp(columns, one->kind);
    int code = same ? csv_recall(one->csv, one->name, notes, past) : STATUS_OK;
    mem_free(past);
    mem_free(columns);
    mem_free(key);
    return code;
}

int maps_recall(struct maps *maps, const struct notes *notes, const char *origin)
{
    double schedule[4];
    if (!maps) return STATUS_OK;
    if (notes_get(notes, "maps.schedule", 4, schedule) && schedule[0] == maps->every.time &&
        (long)schedule[1] == maps->every.steps) {
        maps->next = (long)schedule[2];
        maps->t_row = schedule[3];
    }
    for (unsigned i = 0; i < maps->n; i++) TRY(maps_return(&maps->ones[i], notes, origin));
    return STATUS_OK;
}

/* Adds the present time to one map. */
static int maps_write(struct maps_one *one, const struct state *state, struct derive_moment *moment)
{
    const struct scene_map *map = one->values.map;
    unsigned n_value = one->values.n_value, head = map_store_head(map);
    double *row = one->rows;
    map_values_take(&one->values, state, moment);
    for (unsigned i = 0; i < map->n_point; i++, row += head + n_value) {
        row[0] = state->t;
        row[1] = map->place[i];
        if (map->second) row[2] = map->second[i];
        memcpy(row + head, one->values.values + (size_t)i * n_value, n_value * sizeof *row);
    }
    return csv_rows(one->csv, map->n_point, head + n_value, one->rows);
}

static int maps_write_all(struct maps *maps, const struct state *state, struct derive_moment *moment)
{
    for (unsigned i = 0; i < maps->n; i++) TRY(maps_write(&maps->ones[i], state, moment));
    maps_schedule(maps, state->t);
    return STATUS_OK;
}

int maps_record(struct maps *maps, const struct state *state, struct derive_moment *moment)
{
    if (!maps || state->t <= maps->t_row) return STATUS_OK;
    double every = maps->every.time;
    bool due =
        every > 0.0 ? (double)maps->next * every <= state->t + 1e-9 * every : state->step % maps->every.steps == 0;
    return due ? maps_write_all(maps, state, moment) : STATUS_OK;
}

/* maps/NAME.hdf beside maps/NAME.csv. */
static int maps_store(const struct maps_one *one, const struct scene *scene)
{
    char *arrays = mem_print("%.*s.hdf", (int)strlen(one->path) - 4, one->path);
    int code = map_store_write(&one->values, scene, one->path, arrays);
    mem_free(arrays);
    return code;
}

int maps_finish(struct maps *maps, const struct state *state, struct derive_moment *moment)
{
    if (!maps) return STATUS_OK;
    if (state->whole && state->t > maps->t_row) TRY(maps_write_all(maps, state, moment));
    for (unsigned i = 0; i < maps->n; i++) TRY(maps_store(&maps->ones[i], state->scene));
    return STATUS_OK;
}
