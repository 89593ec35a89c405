/* plot_unit.c - see plot_unit.h. Columns of probes are named <probe>.<field>; columns of the history are
 * measures of the scene (measure.h says what they are). */
#include "view/plot_unit.h"

#include "base/mem.h"

#include <stdio.h>
#include <string.h>

struct scene *plot_unit_scene(const char *directory)
{
    struct scene *scene = NULL;
    FILE *nowhere = fopen("/dev/null", "w");
    if (!nowhere) return NULL;
    char *path = mem_print("%s/case.yaml", directory);
    if (scene_read(path, &(struct scene_options){.messages = nowhere}, &scene)) scene = NULL;
    fclose(nowhere);
    mem_free(path);
    return scene;
}

static const char *unit_of_field(const char *field)
{
    static const char *const units[][2] = {
        {"pressure", "Pa"},       {"density", "kg/m3"},  {"partial_density", "kg/m3"},
        {"velocity", "m/s"},      {"temperature", "K"},  {"sound_speed", "m/s"},
        {"vorticity", "1/s"},     {"stress_", "Pa"},     {"sigma_", "Pa"},
        {"principal_", "Pa"},     {"von_mises", "Pa"},   {"strain_energy", "J/m3"},
        {"stretch_", "1"},        {"invariant_", "1"},   {"alpha_", "1"},
        {"schlieren", "1"},       {"mach", "1"},         {"internal_energy", "J/kg"},
        {"total_energy", "J/m3"}, {"curvature_", "1/m"},
    };
    for (size_t i = 0; i < sizeof units / sizeof *units; i++)
        if (strncmp(field, units[i][0], strlen(units[i][0])) == 0) return units[i][1];
    return "";
}

/* Whole volumes in three dimensions and where the metric closes them; else per length of what is not there. */
static const char *unit_of_measure(const struct scene *scene, const struct scene_column *column)
{
    static const char *const volumes[] = {"m", "m2", "m3"}, *const masses[] = {"kg/m2", "kg/m", "kg"};
    int extent = scene->geometry == SCENE_CARTESIAN ? scene->dim - 1 : 2;
    switch (column->measure) {
    case SCENE_VOLUME: return volumes[extent];
    case SCENE_MASS: return masses[extent];
    case SCENE_CENTROID:
    case SCENE_PENETRATION:
    case SCENE_EQUIVALENT_RADIUS: return "m";
    case SCENE_JET_SPEED: return "m/s";
    case SCENE_MIN:
    case SCENE_MAX:
    case SCENE_MEAN:
    case SCENE_ISOSURFACE_MEAN:
    case SCENE_ISOSURFACE_MIN:
    case SCENE_ISOSURFACE_MAX: return unit_of_field(column->field);
    case SCENE_INTEGRAL:
    case SCENE_PLANE_INTEGRAL:
    case SCENE_TOTAL:
    case SCENE_OUTSIDE:
    case SCENE_VALUE: return "";
    }
    return "";
}

const char *plot_unit_of(const struct scene *scene, const char *column)
{
    const char *dot = strchr(column, '.');
    if (dot) return unit_of_field(dot + 1);
    if (strcmp(column, "dt") == 0) return "s";
    for (unsigned c = 0; scene && c < scene->n_column; c++)
        if (strcmp(scene->columns[c].name, column) == 0) return unit_of_measure(scene, &scene->columns[c]);
    return "";
}
