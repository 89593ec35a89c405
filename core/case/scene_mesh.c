/* scene_mesh.c - tiles and levels: what fits together is judged here, before anything is allocated. */
#include "case/scene_draft.h"

#include "case/scalar.h"

#include <float.h>
#include <math.h>

/* Tiles are numbered with 21 bits per axis (mesh/morton.h). */
#define SCENE_MESH_TILES 2097152.0

enum { SCENE_MESH_LEAST = 4 };

static const struct key scene_mesh_rows[] = {
    {.name = "levels",
     .type = KEYS_INTEGER,
     .min = 0,
     .max = 15,
     .fallback = "0",
     .doc = "Levels of refinement above the coarsest; each halves the cell size. 0: no refinement."},
    {.name = "tile",
     .type = KEYS_INTEGER,
     .min = SCENE_MESH_LEAST,
     .max = 256,
     .doc = "Cells of a tile along each axis; chosen by the program if not given. Even, if there are levels."},
    {.name = "regrid-every",
     .type = KEYS_INTEGER,
     .min = 1,
     .max = 1000000,
     .fallback = "4",
     .doc = "Steps of a level between two regriddings of the finer ones."},
    {.name = "buffer",
     .type = KEYS_INTEGER,
     .min = 0,
     .max = 64,
     .fallback = "4",
     .doc = "Cells refined around a tagged cell: what a wave crosses between two regriddings, and one more."},
    {.name = "patience",
     .type = KEYS_INTEGER,
     .min = 1,
     .max = 100,
     .fallback = "2",
     .doc = "Regriddings in a row that must find a tile unwanted before it goes."},
    {.name = "subcycle",
     .type = KEYS_FLAG,
     .fallback = "true",
     .doc = "Finer levels take smaller time steps; false: all levels take the step of the finest."},
    {.name = "reflux",
     .type = KEYS_CHOICE,
     .choices = "corrected|plain|off",
     .fallback = "corrected",
     .doc = "What coarse cells beside finer ones get of the difference of fluxes. corrected: everything, and uniform "
            "volume fractions stay uniform; plain: without that correction; off: nothing, mass is lost. The last two "
            "are for comparison."},
    {.name = "refine",
     .type = KEYS_SECTION,
     .many = KEYS_LIST,
     .section = &scene_refine_keys,
     .doc = "Where to refine: a cell is refined if any of the criteria asks for it."},
    {0},
};

#define SCENE_MESH_RULES                                                                            \
    "{'if': {'required': ['levels'], 'properties': {'levels': {'type': 'integer', 'minimum': 1}}}," \
    " 'then': {'properties': {'tile': {'multipleOf': 2}}}}"

const struct keys_section scene_mesh_keys = {.name = "mesh",
                                             .doc = "Tiles and refinement.",
                                             .keys = scene_mesh_rows,
                                             .rules = SCENE_MESH_RULES};

/* Axis of the first count that n does not divide, or -1. */
static int scene_mesh_misfit(const struct scene *scene, int n)
{
    for (int axis = 0; axis < scene->domain.dim; axis++)
        if (scene->domain.cells[axis] % n != 0) return axis;
    return -1;
}

/* The least side of a tile: what is refined has halves that hold the layers which neighbours need. */
static int scene_mesh_least(const struct scene *scene)
{
    return scene->mesh.levels > 0 && 2 * scene->scheme.ghosts > SCENE_MESH_LEAST ? 2 * scene->scheme.ghosts
                                                                                 : SCENE_MESH_LEAST;
}

/* Counts rounded up to multiples of n: "[48, 80]". */
static const char *scene_mesh_multiples(struct draft *draft, int n)
{
    const struct scene *scene = draft->scene;
    const char *list = "";
    for (int axis = 0; axis < scene->domain.dim; axis++)
        list = tree_print(draft->keys.forest, "%s%s%d", list, axis ? ", " : "",
                          (scene->domain.cells[axis] + n - 1) / n * n);
    return list;
}

static void scene_mesh_given(struct draft *draft, const struct keys_value *tile)
{
    const struct scene *scene = draft->scene;
    int n = scene->mesh.tile, axis = scene_mesh_misfit(scene, n), step = scene->mesh.levels > 0 ? 2 : 1;
    if (scene->mesh.levels > 0 && n % 2 != 0) {
        keys_error(&draft->keys, tile, "with 'levels' above 0 a tile has an even side, which %d is not", n);
        diag_help(draft->keys.diag, "a tile of a finer level lies under one half of a coarser one along each axis");
        return;
    }
    if (n < scene_mesh_least(scene)) {
        keys_error(&draft->keys, tile, "with 'levels' above 0 and this reconstruction a tile has a side of at least %d",
                   scene_mesh_least(scene));
        diag_help(draft->keys.diag, "its halves must hold the %d layers of cells that '%s' looks at",
                  scene->scheme.ghosts, scene->scheme.reconstruction.module->name);
        return;
    }
    if (axis < 0) return;
    keys_error(&draft->keys, tile, "%d does not divide domain.cells[%d], which is %d", n, axis,
               scene->domain.cells[axis]);
    int other = n - n % step;
    while (other >= scene_mesh_least(scene) && scene_mesh_misfit(scene, other) >= 0) other -= step;
    if (other >= scene_mesh_least(scene))
        diag_help(draft->keys.diag, "cells: [%s] would do, or tile: %d", scene_mesh_multiples(draft, n), other);
    else diag_help(draft->keys.diag, "cells: [%s] would do", scene_mesh_multiples(draft, n));
}

/* Does n divide the cells, and are the tiles of the finest level not too many to be numbered? */
static bool scene_mesh_fits(const struct scene *scene, int n)
{
    for (int axis = 0; axis < scene->domain.dim; axis++)
        if (ldexp(scene->domain.cells[axis], scene->mesh.levels) / n > SCENE_MESH_TILES) return false;
    return scene_mesh_misfit(scene, n) < 0;
}

int scene_mesh_tile(const struct scene *scene)
{
    bool fine = scene->mesh.levels > 0, line = scene->domain.dim == 1;
    int most = line ? 64 : 16, wish = !fine ? most : line ? 16 : 8, step = fine ? 2 : 1, largest = 0;
    for (int n = wish; n >= scene_mesh_least(scene); n -= step)
        if (scene_mesh_fits(scene, n)) return n;
    for (int n = scene_mesh_least(scene); n <= most; n += step) {
        if (n > wish && scene_mesh_fits(scene, n)) return n;
        if (scene_mesh_misfit(scene, n) < 0) largest = n;
    }
    return largest;
}

/* The program will choose the tile: is there one with an even side? */
static void scene_mesh_divisor(struct draft *draft, const struct keys_value *cells)
{
    if (scene_mesh_tile(draft->scene)) return;
    keys_error(&draft->keys, cells, "with 'levels' above 0 the counts need a common even divisor from %d to %d",
               scene_mesh_least(draft->scene), draft->scene->domain.dim == 1 ? 64 : 16);
    diag_help(draft->keys.diag, "[%s] would do: the domain is cut into tiles of that side",
              scene_mesh_multiples(draft, draft->scene->domain.dim == 1 ? 16 : 8));
}

/* Tiles of the finest level are counted in 21 bits per axis, and its cells must be told apart in doubles. */
static void scene_mesh_finest(struct draft *draft, const struct keys_value *levels)
{
    const struct scene *scene = draft->scene;
    int n = scene->mesh.tile ? scene->mesh.tile : scene_mesh_tile(scene);
    for (int axis = 0; n && axis < scene->domain.dim; axis++) {
        double lower = scene->domain.lower[axis], upper = scene->domain.upper[axis];
        double cells = ldexp(scene->domain.cells[axis], scene->mesh.levels), far = fmax(fabs(lower), fabs(upper));
        int most = scene->mesh.levels - (int)ceil(log2(cells / n / SCENE_MESH_TILES));
        if (cells / n > SCENE_MESH_TILES) {
            keys_error(&draft->keys, levels, "%d levels make %.0f tiles along axis %d, and %.0f is the most",
                       scene->mesh.levels, cells / n, axis, SCENE_MESH_TILES);
            diag_help(draft->keys.diag, "levels: %d would do, or fewer cells, or a larger tile", most);
            return;
        }
        if ((upper - lower) / cells >= 1024 * DBL_EPSILON * far) continue;
        keys_error(&draft->keys, levels,
                   "cells of %g m at %g m from the origin cannot be told apart by numbers of 16 "
                   "digits",
                   (upper - lower) / cells, far);
        diag_help(draft->keys.diag, "fewer levels, or an origin inside of the domain");
        return;
    }
}

/* Waves must not leave the refined cells between two regriddings (Berger & Oliger 1984). The Courant number is summed
 * over axes: at most 2/(dim + 1) of it is that of one axis, in cells as wide as high and flow no faster than sound,
 * (u + c)/(u + dim c). */
static void scene_mesh_buffer(struct draft *draft, const struct keys_value *buffer)
{
    const struct scene *scene = draft->scene;
    double per_step = scene->scheme.cfl * 2.0 / (scene->domain.dim + 1);
    double wanted = scene->mesh.regrid_every * per_step + 1;
    if (scene->scheme.dt_fixed > 0 || scene->mesh.buffer >= wanted - 1e-9) return;
    int every = (int)((scene->mesh.buffer - 1) / per_step + 1e-9);
    diag_warn(draft->keys.diag, &buffer->node->mark,
              "%s: waves cross up to %.3g cells in the %d step%s between two regriddings, and leave %d refined cells",
              buffer->path, scene->mesh.regrid_every * per_step, scene->mesh.regrid_every,
              scene->mesh.regrid_every == 1 ? "" : "s", scene->mesh.buffer);
    if (every >= 1) diag_help(draft->keys.diag, "buffer: %.0f would do, or regrid-every: %d", ceil(wanted), every);
    else diag_help(draft->keys.diag, "buffer: %.0f would do", ceil(wanted));
}

void scene_mesh(struct draft *draft)
{
    const struct keys_map *mesh = keys_at(draft->root, "mesh")->map;
    const struct keys_value *levels = keys_at(mesh, "levels"), *tile = keys_at(mesh, "tile"),
                            *buffer = keys_at(mesh, "buffer"), *every = keys_at(mesh, "regrid-every"),
                            *cells = keys_at(keys_at(draft->root, "domain")->map, "cells");
    struct scene *scene = draft->scene;
    scene->mesh.levels = (int)levels->integer;
    scene->mesh.tile = (int)tile->integer;
    scene->mesh.regrid_every = (int)every->integer;
    scene->mesh.buffer = (int)buffer->integer;
    scene->mesh.patience = (int)keys_at(mesh, "patience")->integer;
    scene->mesh.subcycle = keys_at(mesh, "subcycle")->integer != 0;
    scene->mesh.reflux = (enum scene_reflux)keys_at(mesh, "reflux")->integer;
    bool whole = scene->domain.cells_place && levels->given && (tile->given || !tile->node);
    if (whole && tile->given) scene_mesh_given(draft, tile);
    if (whole && scene->mesh.levels > 0 && !tile->given) scene_mesh_divisor(draft, cells);
    if (whole && scene->mesh.levels > 0) scene_mesh_finest(draft, levels);
    if (scene->mesh.levels > 0 && buffer->given && every->given && scene->scheme.cfl > 0)
        scene_mesh_buffer(draft, buffer);
    if (scene->mesh.levels > 0 && keys_at(mesh, "refine")->count == 0 && !keys_at(draft->root, "bodies")->count) {
        diag_warn(draft->keys.diag, &levels->node->mark, "%s: nothing asks for a finer level, so there will be none",
                  levels->path);
        diag_help(draft->keys.diag, "say where to refine: 'refine: [{gradient: density, above: 0.05}]'");
    }
}
