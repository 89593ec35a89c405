/* case.c - case files: YAML, overlays, keys, units, expressions, Lua, shapes. What follows the last line that
 * begins with "%%" are settings of the command line, one a line. */
#include "case/scene_read.h"
#include "fuzz.h"

enum { CASE_SETS = 8 };

static const char case_base[] = "bulla: 1\ntitle: base\ndomain: {lower: [0], upper: [1 m], cells: [32], boundaries: "
                                "{x-: reflecting, x+: reflecting}}\nmaterials: {air: {eos: {type: ideal-gas, gamma: "
                                "1.4}}}\ninitial: [{everywhere: true, material: air, density: 1, pressure: 1}]\nrun: "
                                "{until: 1 us}\n";

FUZZ(data, size)
{
    static int runs;
    fuzz_start();
    if (!runs++) {
        fuzz_write("base.yaml", case_base, sizeof case_base - 1);
        fuzz_write("pulse.csv", "0,1\n1e-6,2\n", 11);
        fuzz_write("function.lua", "return function(x, y, z, t) return {pressure = 1} end\n", 54);
    }
    char *text = fuzz_text(data, size), *sets[CASE_SETS + 1] = {NULL}, *rest = strstr(text, "\n%%");
    size_t length = rest ? (size_t)(rest - text) + 1 : size;
    if (rest) strtok(rest, "\n"); /* the line of the mark itself */
    for (int i = 0; rest && i < CASE_SETS && (sets[i] = strtok(NULL, "\n")); i++) continue;
    fuzz_write("case.yaml", data, length);
    struct scene_options options = {.sets = (const char *const *)sets, .messages = fuzz_nowhere()};
    options.json = size % 2;
    struct scene *scene = NULL;
    if (scene_read("case.yaml", &options, &scene) == 0) scene_free(scene);
    free(text);
    return 0;
}
