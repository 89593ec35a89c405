/* plot_unit.c - see plot_unit.h. Columns of probes are named <probe>.<field>; columns of the history are
 * measures of the scene (measure.h says what they are). */
#include "view/plot_unit.h"

#include "base/mem.h"
#include "case/scene_read.h"
#include "io/units.h"

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

static const char *plot_unit_of_field(const char *field)
{
    static const char *const units[][2] = {
        {"pressure", "Pa"},        {"density", "kg/m3"},   {"partial_density", "kg/m3"}, {"velocity", "m/s"},
        {"temperature", "K"},      {"sound_speed", "m/s"}, {"vorticity", "1/s"},         {"heat_flux", "W/m2"},
        {"stress_", "Pa"},         {"sigma_", "Pa"},       {"principal_", "Pa"},         {"von_mises", "Pa"},
        {"strain_energy", "J/m3"}, {"stretch_", "1"},      {"invariant_", "1"},          {"alpha_", "1"},
        {"schlieren", "1"},        {"mach", "1"},          {"internal_energy", "J/kg"},  {"total_energy", "J/m3"},
        {"curvature_", "1/m"},
    };
    for (size_t i = 0; i < sizeof units / sizeof *units; i++)
        if (strncmp(field, units[i][0], strlen(units[i][0])) == 0) return units[i][1];
    return "";
}

const char *plot_unit_of(const struct scene *scene, const char *column)
{
    const char *dot = strchr(column, '.');
    if (dot) return plot_unit_of_field(dot + 1);
    if (strcmp(column, "dt") == 0) return "s";
    for (unsigned c = 0; scene && c < scene->output.n_column; c++) {
        const struct scene_column *source = units_source(scene, &scene->output.columns[c]);
        if (strcmp(scene->output.columns[c].name, column) == 0)
            return units_of(scene, source, plot_unit_of_field(source->field));
    }
    return "";
}
