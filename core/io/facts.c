/* facts.c - see facts.h. Facts are lines of notes, compared as texts: numbers are written so that equal
 * texts mean equal bits. */
#include "io/facts.h"

#include "base/mem.h"
#include "base/status.h"

#include <string.h>

/* A law with its values in the order of its table: "stiffened-gas gamma=4.4 p-inf=6e8". */
static void facts_put_law(const char *material, const char *kind, const struct instance *instance, struct notes *notes)
{
    const struct bulla_module *module = instance->module;
    if (!module) return;
    char *name = mem_print("materials.%s.%s", material, kind);
    struct text law = {0};
    text_add(&law, "%s", module->name);
    for (unsigned i = 0; i < instance_param_count(module); i++) {
        const struct bulla_value *value = &instance->values[i];
        text_add(&law, " %s=", module->params[i].name);
        if (module->params[i].type == BULLA_NUMBER) text_double(&law, value->number);
        else text_add(&law, "%s", value->text ? value->text : "");
    }
    notes_put_text(notes, name, law.at);
    text_done(&law);
    mem_free(name);
}

/* Names one after the other. */
static void facts_put_names(struct notes *notes, const char *name, unsigned n,
                            const char *(*get)(const void *, unsigned), const void *from)
{
    struct text names = {0};
    for (unsigned i = 0; i < n; i++) text_add(&names, "%s%s", i ? " " : "", get(from, i));
    notes_put_text(notes, name, names.at ? names.at : "");
    text_done(&names);
}

static const char *facts_material(const void *scene, unsigned i)
{
    return ((const struct scene *)scene)->material[i].name;
}

static const char *facts_field(const void *model, unsigned i)
{
    return ((const struct model *)model)->field_names[i];
}

void facts_put(const struct scene *scene, const struct model *model, int tile, struct notes *notes)
{
    static const char *const geometries[] = {"cartesian", "axisymmetric", "spherical"};
    double cells[SCENE_AXES];
    unsigned dim = (unsigned)scene->domain.dim;
    for (unsigned d = 0; d < dim; d++) cells[d] = scene->domain.cells[d];
    notes_put_text(notes, "domain.geometry", geometries[scene->domain.geometry]);
    notes_put(notes, "domain.cells", dim, cells);
    notes_put(notes, "domain.lower", dim, scene->domain.lower);
    notes_put(notes, "domain.upper", dim, scene->domain.upper);
    notes_put_one(notes, "mesh.tile", tile);
    facts_put_names(notes, "materials", scene->n_material, facts_material, scene);
    for (unsigned l = 0; l < scene->n_material; l++) {
        const struct scene_material *material = &scene->material[l];
        facts_put_law(material->name, "eos", &material->eos, notes);
        facts_put_law(material->name, "constitutive", &material->constitutive, notes);
        if (material->plastic.module) facts_put_law(material->name, "plastic", &material->plastic, notes);
        if (material->damage.law.module) facts_put_law(material->name, "damage", &material->damage.law, notes);
        facts_put_law(material->name, "viscosity", &material->viscosity, notes);
        facts_put_law(material->name, "conductivity", &material->conductivity, notes);
    }
    facts_put_names(notes, "fields", model->n_field, facts_field, model);
}

/* Which peaks stand in which rows: "pressure 0 -1 1 -1;". */
static char *facts_kept(const struct scene *scene)
{
    struct text text = {0};
    for (unsigned i = 0; i < scene->output.n_peak; i++) {
        const struct scene_peak *peak = &scene->output.peaks[i];
        text_add(&text, "%s %d %d %d %d;", peak->field, peak->most, peak->least, peak->when_most, peak->when_least);
    }
    return text.at;
}

void facts_put_kept(const struct scene *scene, struct notes *notes)
{
    char *kept = facts_kept(scene);
    if (kept) notes_put_text(notes, "output.kept", kept);
    mem_free(kept);
}

bool facts_same_kept(const struct scene *scene, const struct notes *saved)
{
    char *kept = facts_kept(scene), *was = notes_get_text(saved, "output.kept");
    bool same = kept && was && strcmp(kept, was) == 0;
    mem_free(kept);
    mem_free(was);
    return same;
}

static int facts_compare_one(const struct notes *saved, const char *name, const char *now)
{
    char *was = notes_get_text(saved, name);
    int code = STATUS_OK;
    if (!was || strcmp(was, now))
        code = status_fail(STATUS_CASE, "the checkpoint is of another case: %s is '%s' there and '%s' here", name,
                           was ? was : "", now);
    mem_free(was);
    return code;
}

int facts_compare(const struct notes *saved, const struct notes *now)
{
    int code = STATUS_OK;
    for (const char *line = now->text.at; !code && line && *line;) {
        char *name = mem_text_n(line, strcspn(line, " ")), *value = notes_get_text(now, name);
        code = facts_compare_one(saved, name, value);
        mem_free(name);
        mem_free(value);
        line = strchr(line, '\n');
        line = line ? line + 1 : NULL;
    }
    return code;
}
