/* scene_output.c - where results go: directory, snapshots, probes, checkpoints. */
#include "case/scene_draft.h"

#include "base/mem.h"
#include "base/text.h"

#include <string.h>

static const struct key scene_output_snapshot_rows[] = {
    {.name = "every",
     .type = KEYS_EVERY,
     .unit = "s",
     .min = KEYS_POSITIVE,
     .max = KEYS_MOST,
     .required = true,
     .doc = "Time, or `N steps`, between two snapshots."},
    {.name = "fields",
     .type = KEYS_FIELD,
     .many = KEYS_LIST,
     .fallback = "[density, velocity, pressure]",
     .doc = "The fields to write."},
    {.name = "precision",
     .type = KEYS_CHOICE,
     .choices = "single|double",
     .fallback = "single",
     .doc = "Bits of the numbers: single halves the files."},
    {.name = "memory",
     .type = KEYS_INTEGER,
     .min = 0,
     .max = 1000000,
     .fallback = "256",
     .doc =
         "MiB that a writer may take for a snapshot (before it is packed) to write it while the run goes on; 0, or a "
         "larger snapshot: the run waits for it."},
    {0},
};

static const struct key scene_output_history_rows[] = {
    {.name = "every",
     .type = KEYS_EVERY,
     .unit = "s",
     .min = KEYS_POSITIVE,
     .max = KEYS_MOST,
     .fallback = "1 step",
     .doc = "Time, or `N steps`, between two rows of history.csv."},
    {.name = "steps-of",
     .type = KEYS_CHOICE,
     .choices = "coarsest|finest",
     .fallback = "coarsest",
     .doc = "Whose steps count, for `N steps` and for extremes between rows: those of the coarsest level, or those of "
            "the finest one."},
    {.name = "columns",
     .type = KEYS_SECTION,
     .many = KEYS_NAMED,
     .section = &scene_history_column_keys,
     .fallback = "{}",
     .doc = "What is measured, by column name."},
    {0},
};

static const struct key scene_output_probe_rows[] = {
    {.name = "at", .type = KEYS_NUMBER, .many = KEYS_LIST, .unit = "m", .required = true, .doc = "Where."},
    {.name = "fields", .type = KEYS_FIELD, .many = KEYS_LIST, .required = true, .doc = "The fields to record there."},
    {0},
};

/* Names of columns: identifiers, and none that every history has already (scene_history.c). */
#define SCENE_OUTPUT_COLUMNS                                                                                      \
    "{'properties': {'columns': {'propertyNames': {'pattern': "                                                   \
    "'^(?!(step|t|dt|guard_fallback|guard_relaxed|guard_clipped|guard_retries)$)[A-Za-z_][A-Za-z0-9_]{0,62}$',"   \
    "'patternErrorMessage': 'The name of a column is an identifier (letters, digits and _), and none that every " \
    "history has (step, t, dt, guard_...).'}}}}"
#define SCENE_OUTPUT_AT "{'properties': {'at': {'minItems': 1, 'maxItems': 3}}}"

static const struct keys_section scene_output_probe = {.name = "probe",
                                                       .doc = "Fields at a point, over time.",
                                                       .keys = scene_output_probe_rows,
                                                       .rules = SCENE_OUTPUT_AT};

static const struct key scene_output_probes_rows[] = {
    {.name = "every",
     .type = KEYS_EVERY,
     .unit = "s",
     .min = KEYS_POSITIVE,
     .max = KEYS_MOST,
     .fallback = "1 step",
     .doc = "Time, or `N steps`, between two rows of probes.csv."},
    {0},
};

static const struct key scene_output_probe_row = {.name = "NAME",
                                                  .type = KEYS_SECTION,
                                                  .section = &scene_output_probe,
                                                  .doc = "A probe."};

static const struct key scene_output_checkpoint_rows[] = {
    {.name = "every",
     .type = KEYS_EVERY,
     .unit = "s",
     .min = KEYS_POSITIVE,
     .max = KEYS_MOST,
     .doc = "Time, or `N steps`, between two checkpoints, and one at the end."},
    {.name = "wall",
     .type = KEYS_NUMBER,
     .unit = "s",
     .min = 0,
     .max = KEYS_MOST,
     .fallback = "30 min",
     .doc = "Wall time after which a checkpoint is written if there was none meanwhile; 0: never. One that cannot be "
            "written is a warning."},
    {.name = "keep", .type = KEYS_INTEGER, .min = 1, .max = 1000, .fallback = "2", .doc = "How many to keep."},
    {0},
};

static const struct keys_section scene_output_snapshots = {.name = "snapshots",
                                                           .doc = "Fields for ParaView, yt and pictures.",
                                                           .keys = scene_output_snapshot_rows};
static const struct keys_section scene_output_history = {.name = "history",
                                                         .doc = "Scalars over time: history.csv.",
                                                         .keys = scene_output_history_rows,
                                                         .rules = SCENE_OUTPUT_COLUMNS};
static const struct keys_section scene_output_probes = {.name = "probes",
                                                        .doc = "Fields at points over time: probes.csv.",
                                                        .keys = scene_output_probes_rows,
                                                        .others = &scene_output_probe_row,
                                                        .rules =
                                                            "{'propertyNames': {'pattern': '^[A-Za-z_][A-Za-z0-9_]"
                                                            "{0,62}$', 'patternErrorMessage': 'The name of a probe "
                                                            "is an identifier (letters, digits and _).'}}"};
static const struct keys_section scene_output_checkpoints = {.name = "checkpoints",
                                                             .doc = "Exact states to go on from.",
                                                             .keys = scene_output_checkpoint_rows};

static const struct key scene_output_rows[] = {
    {.name = "directory", .type = KEYS_TEXT, .doc = "Output directory; out/CASE if not given; -o wins."},
    {.name = "snapshots",
     .type = KEYS_SECTION,
     .section = &scene_output_snapshots,
     .doc = "Fields for ParaView and yt."},
    {.name = "history",
     .type = KEYS_SECTION,
     .section = &scene_output_history,
     .fallback = "{}",
     .doc = "Scalars over time."},
    {.name = "probes", .type = KEYS_SECTION, .section = &scene_output_probes, .doc = "Fields at points over time."},
    {.name = "maps",
     .type = KEYS_SECTION,
     .section = &scene_map_list_keys,
     .doc = "Fields along lines and surfaces over time."},
    {.name = "peaks",
     .type = KEYS_SECTION,
     .section = &scene_peak_keys,
     .doc = "The time that counts for `max_...`, `min_...` and `when_...` fields."},
    {.name = "checkpoints",
     .type = KEYS_SECTION,
     .section = &scene_output_checkpoints,
     .fallback = "{}",
     .doc = "Exact states to go on from."},
    {.name = "writers",
     .type = KEYS_INTEGER,
     .min = 1,
     .max = 100000,
     .doc = "Ranks that write snapshots and checkpoints, each a file for itself and its neighbours; one per machine if "
            "not given. --writers is short for it."},
    {0},
};

const struct keys_section scene_output_keys = {.name = "output",
                                               .doc = "What is written, where and how often.",
                                               .keys = scene_output_rows};

static struct scene_every scene_output_every(const struct keys_value *value)
{
    return (struct scene_every){value->integer ? 0.0 : value->number, value->integer};
}

static void scene_output_folder(struct draft *draft, const struct keys_map *output)
{
    struct scene *scene = draft->scene;
    const struct keys_value *directory = keys_at(output, "directory");
    if (!scene->output.directory)
        scene->output.directory = directory->given ? mem_text(directory->text) : mem_print("out/%s", scene->name);
    if (!output) return;
    bool first = !directory->node;
    tree_set(draft->keys.forest, output->node, "directory",
             tree_scalar(draft->keys.forest, &output->node->mark, TREE_QUOTED, scene->output.directory));
    if (first) tree_first(output->node, output->node->count - 1);
}

static void scene_output_probe_read(struct draft *draft, struct scene_probe *probe, const struct keys_value *value)
{
    const struct scene *scene = draft->scene;
    const struct keys_value *at = keys_at(value->map, "at");
    snprintf(probe->name, SCENE_NAME, "%s", value->key->name);
    if (!text_is_identifier(value->key->name) || strlen(value->key->name) >= SCENE_NAME)
        keys_error(&draft->keys, value, "the name of a probe is an identifier (letters, digits and _)");
    scene_field_name_list(draft, keys_at(value->map, "fields"), &probe->fields, &probe->n_field);
    if (!scene_domain_vector(draft, at, probe->at)) return;
    for (int axis = 0; axis < scene->domain.dim; axis++)
        if (probe->at[axis] < scene->domain.lower[axis] || probe->at[axis] > scene->domain.upper[axis])
            keys_error(&draft->keys, &at->list[axis], "%g m is outside of the domain, %g to %g m", probe->at[axis],
                       scene->domain.lower[axis], scene->domain.upper[axis]);
}

static void scene_output_probes_read(struct draft *draft, const struct keys_map *probes)
{
    struct scene *scene = draft->scene;
    scene->output.probes_every = scene_output_every(keys_at(probes, "every"));
    scene->output.probes = mem_new(probes ? probes->count + 1 : 1, sizeof *scene->output.probes);
    for (unsigned i = 0; probes && i < probes->count; i++)
        if (probes->values[i].key->section == &scene_output_probe)
            scene_output_probe_read(draft, &scene->output.probes[scene->output.n_probe++], &probes->values[i]);
}

/* Pictures leave bodies out: what snapshots say of them goes with all other fields. */
static void scene_output_body(struct scene *scene)
{
    struct scene_output *output = &scene->output;
    unsigned n = output->n_snapshot_field;
    bool there = n == 0 || !scene->n_rigid;
    for (unsigned i = 0; i < n; i++) there = there || strcmp(output->snapshot_fields[i], "body") == 0;
    if (!there) snprintf(output->snapshot_fields[output->n_snapshot_field++], SCENE_NAME, "body");
}

void scene_output(struct draft *draft)
{
    const struct keys_map *output = keys_at(draft->root, "output")->map;
    const struct keys_map *snapshots = keys_at(output, "snapshots")->map;
    const struct keys_map *checkpoints = keys_at(output, "checkpoints")->map;
    struct scene *scene = draft->scene;
    scene_output_folder(draft, output);
    scene->output.snapshots = scene_output_every(keys_at(snapshots, "every"));
    scene_field_name_list(draft, keys_at(snapshots, "fields"), &scene->output.snapshot_fields,
                          &scene->output.n_snapshot_field);
    scene_output_body(scene);
    scene->output.snapshot_memory = (double)keys_at(snapshots, "memory")->integer * 0x1p20;
    scene->output.snapshot_double = keys_at(snapshots, "precision")->integer == 1;
    scene->output.history = scene_output_every(keys_at(keys_at(output, "history")->map, "every"));
    scene->output.history_finest = keys_at(keys_at(output, "history")->map, "steps-of")->integer == 1;
    scene_output_probes_read(draft, keys_at(output, "probes")->map);
    scene->output.checkpoints = scene_output_every(keys_at(checkpoints, "every"));
    scene->output.checkpoints_wall = keys_at(checkpoints, "wall")->number;
    scene->output.checkpoints_keep = (int)keys_at(checkpoints, "keep")->integer;
    scene->output.writers = (int)keys_at(output, "writers")->integer;
}
