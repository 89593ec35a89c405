/* map_store.c - see map_store.h. The table is read back: it is all there is after restarts, and whatever ended the
 * runs before. Rank 0 holds the numbers, the others take part in the calls. */
#include "io/map_store.h"

#include "base/comm.h"
#include "base/mem.h"
#include "base/status.h"
#include "base/version.h"
#include "case/table.h"
#include "io/h5out.h"
#include "io/place.h"

#include <string.h>

const char *map_store_place(const struct scene_map *map)
{
    static const char *const names[] = {"x", "y", "z"};
    return map->second ? "s1,s2" : map->axis < 0 ? "s" : names[map->axis];
}

unsigned map_store_head(const struct scene_map *map)
{
    return map->second ? 3 : 2;
}

static void map_store_origin(struct h5 *file, const struct scene *scene, const struct scene_map *map)
{
    static const char *const geometries[] = {"cartesian", "axisymmetric", "spherical"};
    h5_attribute_text(file, "/", "case", scene->name);
    h5_attribute_text(file, "/", "title", scene->title ? scene->title : "");
    h5_attribute_text(file, "/", "geometry", geometries[scene->domain.geometry]);
    h5_attribute_text(file, "/", "map", map->name);
    h5_attribute_text(file, "/", "version", BULLA_VERSION);
    if (!map->second) return;
    h5_attribute(file, "/", "corner", H5_F64, SCENE_AXES, map->corner);
    h5_attribute(file, "/", "first", H5_F64, SCENE_AXES, map->side[0]);
    h5_attribute(file, "/", "second", H5_F64, SCENE_AXES, map->side[1]);
}

/* One data set; `name` is a column of the table, or of other ranks nothing to be looked up. */
static void map_store_column(struct h5 *file, const struct table *table, const char *name, const char *unit,
                             const size_t shape[2])
{
    const double *from = NULL;
    char *path = mem_print("/%s", name);
    for (unsigned c = 0; c < table->n_column; c++)
        if (!strcmp(table->names[c], name)) from = table->columns[c];
    h5out_array(file, path, H5_F64, shape[0], (unsigned)shape[1], from);
    h5out_unit(file, path, unit);
    mem_free(path);
}

/* The distances along a side of a rectangle: [n] of those of all places, `step` apart. */
static void map_store_side(struct h5 *file, const char *path, size_t n, size_t step, const double *all)
{
    double *own = mem_new(n, sizeof *own);
    for (size_t i = 0; i < n; i++) own[i] = all[i * step];
    h5out_array(file, path, H5_F64, n, 0, own);
    h5out_unit(file, path, "m");
    mem_free(own);
}

/* Where the places are. */
static void map_store_places(struct h5 *file, const struct scene_map *map, const struct table *table)
{
    if (!map->second) {
        map_store_column(file, table, map_store_place(map), "m", (size_t[]){map->n_point, 0});
        return;
    }
    map_store_side(file, "/s1", map->n_side[0], map->n_side[1], map->place);
    map_store_side(file, "/s2", map->n_side[1], 1, map->second);
}

static void map_store_fields(struct h5 *file, const struct map_values *values, const struct table *table,
                             const size_t shape[2])
{
    for (unsigned i = 0; i < values->n_field; i++) {
        const struct derive *field = &values->fields[i];
        unsigned components = values->map->at ? field->components : 1;
        for (unsigned q = 0; q < components; q++) {
            char *name = components > 1 ? mem_print("%s_%c", field->name, "xyz"[q]) : mem_print("%s", field->name);
            map_store_column(file, table, name, field->unit, shape);
            mem_free(name);
        }
    }
}

static int map_store_draft(const struct map_values *values, const struct scene *scene, const struct table *table,
                           const char *path)
{
    size_t n_point = values->map->n_point, n = table->n_row / n_point;
    double *t = mem_new(n, sizeof *t);
    for (size_t i = 0; i < n && table->n_column; i++) t[i] = table->columns[0][i * n_point];
    struct h5 *file;
    char *draft = place_draft(path);
    int code = h5_create(draft, &file);
    if (!code) {
        map_store_origin(file, scene, values->map);
        h5out_array(file, "/t", H5_F64, n, 0, t);
        h5out_unit(file, "/t", "s");
        map_store_places(file, values->map, table);
        map_store_fields(file, values, table, (size_t[]){n, n_point});
        code = h5_close(file);
    }
    mem_free(draft);
    mem_free(t);
    return code;
}

int map_store_write(const struct map_values *values, const struct scene *scene, const char *csv, const char *arrays)
{
    struct table table = {0};
    size_t n_row = 0;
    TRY(comm_agree(comm_rank() == 0 ? table_read(csv, TABLE_OF_RUN, &table) : STATUS_OK));
    if (comm_rank() == 0) n_row = table.n_row;
    comm_bcast(&n_row, sizeof n_row);
    table.n_row = n_row;
    int code = STATUS_OK;
    if (n_row >= values->map->n_point) {
        code = map_store_draft(values, scene, &table, arrays);
        if (code) place_reject(arrays);
        else code = place_accept(arrays);
    }
    if (comm_rank() == 0) table_done(&table);
    return code;
}
