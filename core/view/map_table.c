/* map_table.c - see map_table.h. */
#include "view/map_table.h"

#include "base/mem.h"
#include "base/status.h"
#include "base/text.h"
#include "view/picture_text.h"
#include "view/plot_unit.h"

#include <dirent.h>
#include <math.h>
#include <string.h>
#include <unistd.h>

static void map_table_list(const char *directory, struct text *list)
{
    char *folder = mem_print("%s/maps", directory);
    DIR *stream = opendir(folder);
    for (struct dirent *entry; stream && (entry = readdir(stream));) {
        const char *end = strrchr(entry->d_name, '.');
        if (end && !strcmp(end, ".csv"))
            text_add(list, "%s%.*s", list->length ? ", " : "", (int)(end - entry->d_name), entry->d_name);
    }
    if (stream) closedir(stream);
    mem_free(folder);
}

int map_table_missing(const char *directory, const char *name)
{
    struct text list = {0};
    map_table_list(directory, &list);
    int code = !list.length ? status_fail(STATUS_CASE, "no maps in %s: output.maps asks a run for them", directory)
               : name       ? status_fail(STATUS_CASE, "no map '%s' in %s; there are: %s", name, directory, list.at)
                            : status_fail(STATUS_CASE, "which map and field? There are: %s", list.at);
    text_done(&list);
    return code;
}

int map_table_open(const char *directory, const char *name, struct map_table *ret_map)
{
    char *path = mem_print("%s/maps/%s.csv", directory, name);
    int code = access(path, R_OK) ? map_table_missing(directory, name) : STATUS_OK;
    *ret_map = (struct map_table){.name = name};
    if (!code && table_read(path, TABLE_OF_RUN, &ret_map->table)) code = status_fail(STATUS_CASE, "%s", status_text());
    mem_free(path);
    if (code) return code;
    const struct table *table = &ret_map->table;
    size_t n = 0;
    while (n < table->n_row && table->columns[0][n] == table->columns[0][0]) n++;
    ret_map->n_place = n;
    ret_map->n_time = n ? table->n_row / n : 0;
    if (ret_map->n_time < 2 || n < 2)
        return status_fail(STATUS_CASE, "map %s has %zu times and %zu places: two of each make a picture", name,
                           ret_map->n_time, n);
    ret_map->scene = plot_unit_scene(directory);
    if (strcmp(table->names[1], "s1") != 0) return STATUS_OK;
    size_t side = 0;
    while (side < n && table->columns[1][side] == table->columns[1][0]) side++;
    ret_map->n_side[0] = n / side;
    ret_map->n_side[1] = side;
    return STATUS_OK;
}

void map_table_done(struct map_table *map)
{
    table_done(&map->table);
    scene_free(map->scene);
    *map = (struct map_table){0};
}

int map_table_column(const struct map_table *map, const char *field, const double **ret_values)
{
    struct text list = {0};
    *ret_values = NULL;
    for (unsigned c = map->n_side[0] ? 3 : 2; c < map->table.n_column; c++) {
        if (!strcmp(map->table.names[c], field)) *ret_values = map->table.columns[c];
        text_add(&list, "%s%s", list.length ? ", " : "", map->table.names[c]);
    }
    int code = *ret_values ? STATUS_OK
                           : status_fail(STATUS_CASE, "map %s has no field '%s'; there are: %s", map->name, field,
                                         list.at ? list.at : "none");
    text_done(&list);
    return code;
}

char *map_table_place(const struct map_table *map)
{
    bool round = map->scene && map->scene->domain.geometry != SCENE_CARTESIAN;
    const char *column = map->table.names[1], *symbol = column;
    if (round && *column == 'x') symbol = "r";
    if (round && *column == 'y') symbol = "z";
    return mem_print(PICTURE_ITALIC "%s" PICTURE_UPRIGHT, symbol);
}

size_t map_table_highest(const struct map_table *map, const double *values, const double window[2])
{
    const double *places = map->table.columns[1];
    double highest = -INFINITY;
    size_t at = 0;
    for (size_t i = 0; i < map->n_time * map->n_place; i++) {
        double place = places[i % map->n_place];
        if (!(place >= window[0] && place <= window[1]) || !(values[i] > highest)) continue;
        highest = values[i];
        at = i / map->n_place;
    }
    return at;
}

char *map_table_label(const struct map_table *map, const char *field)
{
    char *label = mem_text(field);
    for (unsigned m = 0; map->scene && m < map->scene->n_material; m++) {
        const char *material = map->scene->material[m].name;
        size_t all = strlen(field), tail = strlen(material);
        if (all < tail + 2 || field[all - tail - 1] != '_' || strcmp(field + all - tail, material) != 0) continue;
        mem_free(label);
        bool fraction = strncmp(field, "alpha_", 6) == 0;
        label = fraction ? mem_print("volume fraction of %s", material)
                         : mem_print("%.*s of %s", (int)(all - tail - 1), field, material);
    }
    for (char *c = label; *c; c++)
        if (*c == '_') *c = ' ';
    return label;
}

const char *map_table_unit(const struct map_table *map, const char *field)
{
    char *column = mem_print("%s.%s", map->name, field);
    const char *unit = plot_unit_of(map->scene, column);
    mem_free(column);
    return unit;
}
