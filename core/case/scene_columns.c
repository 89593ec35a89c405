/* scene_columns.c - see scene_columns.h. Names are those of io/history.c and io/probes.c. */
#include "case/scene_columns.h"

#include "base/mem.h"
#include "case/scene_draft.h"

/* Of every history; `t` is that of the probes too. */
static const char *const scene_columns_always[] = {
    "t", "step", "dt", "guard_fallback", "guard_relaxed", "guard_clipped", "guard_retries"};

static void scene_columns_add(struct formula *plan, char *name)
{
    formula_plan(plan, name);
    mem_free(name);
}

static void scene_columns_add_probe(struct formula *plan, const struct scene_probe *probe)
{
    for (unsigned i = 0; i < probe->n_field; i++) {
        if (!scene_field_is_vector(probe->fields[i])) {
            scene_columns_add(plan, mem_print("%s.%s", probe->name, probe->fields[i]));
            continue;
        }
        for (int axis = 0; axis < SCENE_AXES; axis++)
            scene_columns_add(plan, mem_print("%s.%s_%c", probe->name, probe->fields[i], "xyz"[axis]));
    }
}

struct formula *scene_columns_plan(const struct scene *scene)
{
    struct formula *plan = formula_new(scene->host, true);
    for (unsigned i = 0; i < scene->output.n_column; i++) formula_plan(plan, scene->output.columns[i].name);
    for (unsigned i = 0; i < scene->output.n_probe; i++) scene_columns_add_probe(plan, &scene->output.probes[i]);
    for (size_t i = 0; i < sizeof scene_columns_always / sizeof *scene_columns_always; i++)
        formula_plan(plan, scene_columns_always[i]);
    return plan;
}
