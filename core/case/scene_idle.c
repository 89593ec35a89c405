/* scene_idle.c - what a case asks for and never gets: materials that are nowhere, outputs after the end, regions
 * outside.
 *
 * All of it runs, so it is no error; but it costs, or somebody waits for numbers that do not come. A material may be
 * there for a variant or a row of the matrix alone. */
#include "case/scene_draft.h"

#include <string.h>

/* Does Lua mention a material, as in `air` or `alpha_air`? The file of an overlay that is not applied may. */
static bool scene_idle_script(const struct node *node, const char *name)
{
    return node->kind == TREE_SCALAR && (strstr(node->text, name) || strstr(node->text, ".lua"));
}

/* Does anything below a node put a material somewhere? Densities and heating of a material do not. */
static bool scene_idle_has(const struct node *node, const char *name)
{
    if (!node) return false;
    if (node->kind == TREE_SCALAR) return strcmp(node->text, name) == 0;
    for (unsigned i = 0; i < node->count; i++) {
        const char *key = node->kind == TREE_MAP ? node->keys[i]->text : "";
        if (strcmp(key, "density") == 0 || strcmp(key, "heating") == 0) continue;
        if (strcmp(key, name) == 0 || scene_idle_has(node->items[i], name)) return true;
        if (strcmp(key, "lua") == 0 && scene_idle_script(node->items[i], name)) return true;
    }
    return false;
}

/* Does the case put a material anywhere, or does a variant of it, or its matrix? */
static bool scene_idle_found(const struct node *root, const char *name)
{
    static const char *const places[] = {"initial", "sources", "variants", "quick", "matrix"};
    if (scene_idle_has(tree_get(tree_get(root, "domain"), "boundaries"), name)) return true;
    for (unsigned i = 0; i < sizeof places / sizeof *places; i++)
        if (scene_idle_has(tree_get(root, places[i]), name)) return true;
    return false;
}

/* Does it come to be by itself, or is it named where it can only be useful? */
static bool scene_idle_arises(const struct scene *scene, unsigned material)
{
    bool arises = false;
    for (unsigned k = 0; k < scene->n_phase; k++)
        arises = arises || scene->phases[k].vapour == material || scene->phases[k].liquid == material;
    for (unsigned l = 0; l < scene->n_material; l++)
        arises = arises || (scene->material[l].damage.opens && scene->material[l].damage.gas == material);
    return arises;
}

/* A Lua layer may leave one material out: it is the rest. */
static void scene_idle_materials(struct draft *draft, const struct node *root)
{
    const struct keys_value *materials = keys_at(draft->root, "materials");
    unsigned missing = 0;
    bool script = false;
    for (unsigned i = 0; i < draft->scene->n_layer; i++) {
        script = script || draft->scene->layers[i].script;
        if (draft->scene->layers[i].checkpoint) return; /* which may have any */
    }
    for (unsigned i = 0; i < materials->count; i++)
        missing += !scene_idle_arises(draft->scene, i) && !scene_idle_found(root, materials->list[i].name);
    for (unsigned i = 0; missing > (script ? 1 : 0) && i < materials->count; i++) {
        const char *name = materials->list[i].name;
        if (scene_idle_arises(draft->scene, i) || scene_idle_found(root, name)) continue;
        diag_warn(draft->keys.diag, &materials->node->keys[i]->mark,
                  "material '%s' is nowhere: no layer, boundary or source has it", name);
        diag_help(draft->keys.diag, "leave it out: it costs two fields in every cell");
    }
}

/* A time or a number of steps between two outputs that is longer than the run. */
static void scene_idle_every(struct draft *draft, const struct keys_map *section, const char *what)
{
    const struct scene *scene = draft->scene;
    const struct keys_value *every = keys_at(section, "every"), *until;
    const struct keys_map *run = keys_at(draft->root, "run")->map;
    bool steps = every->given && every->integer > 0;
    until = keys_at(run, steps ? "max-steps" : "until");
    if (!every->given || !until->given || !until->node->mark.source->is_file) return; /* cut short for once */
    if (steps ? !scene->run.max_steps || every->integer <= scene->run.max_steps
              : every->number <= 1.000001 * scene->run.until)
        return;
    if (steps)
        diag_warn(draft->keys.diag, &every->node->mark, "%s: the run ends before that, after %ld steps: %s",
                  every->path, scene->run.max_steps, what);
    else
        diag_warn(draft->keys.diag, &every->node->mark, "%s: the run ends before that, at %g s: %s", every->path,
                  scene->run.until, what);
}

static void scene_idle_outputs(struct draft *draft)
{
    const struct keys_map *output = keys_at(draft->root, "output")->map;
    const char *ends = "only its start and its end are written";
    scene_idle_every(draft, keys_at(output, "snapshots")->map, ends);
    if (!draft->scene->output.history_finest) scene_idle_every(draft, keys_at(output, "history")->map, ends);
    scene_idle_every(draft, keys_at(output, "probes")->map, ends);
    scene_idle_every(draft, keys_at(output, "maps")->map, ends);
    scene_idle_every(draft, keys_at(output, "checkpoints")->map, "it asks for none but that of the end");
}

/* A region in which there is nothing to measure or to refine. */
static void scene_idle_region(struct draft *draft, const struct keys_value *value, const struct shape *shape)
{
    const struct scene *scene = draft->scene;
    if (!value->node || !shape || shape_reaches(shape, scene->domain.lower, scene->domain.upper, scene->domain.dim))
        return;
    diag_warn(draft->keys.diag, &value->node->mark, "%s: this region lies outside of the domain", value->path);
    diag_help(draft->keys.diag, "the domain is %g to %g m along the first axis: are the units right?",
              scene->domain.lower[0], scene->domain.upper[0]);
}

static void scene_idle_regions(struct draft *draft)
{
    const struct scene *scene = draft->scene;
    const struct keys_map *output = keys_at(draft->root, "output")->map, *maps = keys_at(output, "maps")->map;
    const struct keys_value *columns = keys_at(keys_at(output, "history")->map, "columns");
    const struct keys_value *refine = keys_at(keys_at(draft->root, "mesh")->map, "refine");
    for (unsigned i = 0; i < scene->output.n_column; i++)
        scene_idle_region(draft, keys_at(columns->list[i].map, "where"), scene->output.columns[i].where);
    for (unsigned i = 0; i < scene->output.n_map; i++)
        for (unsigned k = 0; maps && k < maps->count; k++)
            if (strcmp(maps->values[k].key->name, scene->output.maps[i].name) == 0)
                scene_idle_region(draft, keys_at(maps->values[k].map, "where"), scene->output.maps[i].where);
    for (unsigned i = 0; i < refine->count && i < scene->mesh.n_refine; i++) { /* bodies have none */
        bool region = scene->mesh.refines[i].kind == SCENE_REFINE_REGION;
        scene_idle_region(draft, keys_at(refine->list[i].map, region ? "region" : "where"),
                          scene->mesh.refines[i].where);
    }
}

/* A wave that would come in after the end. */
static void scene_idle_waves(struct draft *draft)
{
    const struct scene *scene = draft->scene;
    const struct keys_map *boundaries = keys_at(keys_at(draft->root, "domain")->map, "boundaries")->map;
    const struct keys_value *until = keys_at(keys_at(draft->root, "run")->map, "until");
    for (unsigned i = 0; boundaries && until->given && until->node->mark.source->is_file && i < boundaries->count;
         i++) {
        const struct keys_value *delay = NULL;
        const struct keys_map *map = boundaries->values[i].map;
        if (map && tree_get(map->node, "delay")) delay = keys_at(map, "delay");
        if (!delay || !delay->given || delay->number < scene->run.until) continue;
        diag_warn(draft->keys.diag, &delay->node->mark,
                  "%s: the run ends before that, at %g s: the wave does not come in", delay->path, scene->run.until);
    }
}

void scene_idle(struct draft *draft, const struct node *root)
{
    scene_idle_materials(draft, root);
    scene_idle_outputs(draft);
    scene_idle_regions(draft);
    scene_idle_waves(draft);
}
