/* law.c - files of the equation of state `table`. CSV as it is. An input that begins with "h5" stands for a sound HDF5
 * file: one array a line, "name units rows columns scale" (0 columns: one dimension), its numbers those of a gas times
 * scale. What is accepted must be a law: numbers for any density and pressure. */
#include "bulla/eos.h"
#include "case/scene_read.h"
#include "fuzz.h"

#include <hdf5.h>
#include <math.h>

enum { LAW_MOST = 64, LAW_SETS = 16 };

static void law_case(const char *file)
{
    char text[512];
    int length = snprintf(text, sizeof text,
                          "bulla: 1\ndomain: {lower: [0], upper: [1], cells: [16], boundaries: {x-: outflow, x+: "
                          "outflow}}\nmaterials: {a: {eos: {type: table, file: %s}}}\ninitial: [{everywhere: true, "
                          "material: a, density: 1, pressure: 1e5}]\nrun: {until: 1}\n",
                          file);
    fuzz_write("case.yaml", text, (size_t)length);
}

/* What a gas has at place [i][j] of an array. */
static double law_number(const char *name, unsigned i, unsigned j)
{
    double rho = 1.0 + i, T = 300.0 + 10.0 * j;
    switch (*name) {
    case 'r': return rho;
    case 'T': return 300.0 + 10.0 * i;
    case 'p': return 287.0 * rho * T;
    case 'c': return sqrt(1.4 * 287.0 * T);
    case 's': return 717.0 * log(T) - 287.0 * log(rho);
    default: return 717.0 * T;
    }
}

static void law_unit(hid_t set, const char *unit)
{
    hid_t type = H5Tcopy(H5T_C_S1), space = H5Screate(H5S_SCALAR);
    H5Tset_size(type, strlen(unit) + 1);
    hid_t attribute = H5Acreate2(set, "units", type, space, H5P_DEFAULT, H5P_DEFAULT);
    H5Awrite(attribute, type, unit);
    H5Aclose(attribute);
    H5Sclose(space);
    H5Tclose(type);
}

static void law_array(hid_t file, const char *line)
{
    char name[8], unit[80];
    unsigned rows, columns;
    double scale = 1.0, values[LAW_MOST * LAW_MOST];
    if (sscanf(line, "%7s %79s %u %u %lf", name, unit, &rows, &columns, &scale) < 4) return;
    if (rows > LAW_MOST || columns > LAW_MOST || strchr(name, '/') || *name == '.') return;
    unsigned across = columns ? columns : 1;
    for (unsigned i = 0; i < rows * across; i++) values[i] = scale * law_number(name, i / across, i % across);
    hsize_t size[2] = {rows, columns};
    if (H5Lexists(file, name, H5P_DEFAULT) > 0) return;
    hid_t space = H5Screate_simple(columns ? 2 : 1, size, NULL);
    hid_t set = H5Dcreate2(file, name, H5T_NATIVE_DOUBLE, space, H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT);
    if (rows) H5Dwrite(set, H5T_NATIVE_DOUBLE, H5S_ALL, H5S_ALL, H5P_DEFAULT, values);
    if (strcmp(unit, "-") != 0) law_unit(set, unit);
    H5Dclose(set);
    H5Sclose(space);
}

static void law_make(char *text)
{
    hid_t file = H5Fcreate("input.h5", H5F_ACC_TRUNC, H5P_DEFAULT, H5P_DEFAULT);
    if (file < 0) abort();
    H5Eset_auto2(H5E_DEFAULT, NULL, NULL);
    char *line = strtok(text, "\n");
    for (int i = 0; line && i < LAW_SETS; i++, line = strtok(NULL, "\n")) law_array(file, line);
    H5Fclose(file);
}

static void law_ask(const struct instance *instance)
{
    static const double rho[] = {1e-6, 0.5, 1.0, 3.3, 900.0, 1e6}, p[] = {-1e5, 1e-3, 1e5, 1e7, 1e9, 1e12};
    const struct bulla_eos *law = instance->module->table;
    double rho_e[6], rho_c2[6], T[6];
    for (int i = 0; i < 6; i++) {
        double density[6];
        for (int k = 0; k < 6; k++) density[k] = rho[(i + k) % 6];
        law->state(instance->self, 6, density, p, rho_e, rho_c2);
        law->temperature(instance->self, 6, density, p, T);
        for (int k = 0; k < 6; k++)
            if (!isfinite(rho_e[k]) || !isfinite(rho_c2[k]) || !isfinite(T[k])) abort();
    }
}

FUZZ(data, size)
{
    fuzz_start();
    char *text = fuzz_text(data, size);
    bool arrays = size > 3 && !memcmp(data, "h5", 2);
    if (arrays) law_make(text);
    else fuzz_write("input.csv", data, size);
    law_case(arrays ? "input.h5" : "input.csv");
    struct scene_options options = {.messages = fuzz_nowhere()};
    struct scene *scene = NULL;
    if (scene_read("case.yaml", &options, &scene) == 0) {
        law_ask(&scene->material[0].eos);
        scene_free(scene);
    }
    free(text);
    return 0;
}
