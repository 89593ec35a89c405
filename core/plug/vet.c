/* vet.c - see vet.h. What is checked here is never checked again: the case layer, the schema and
 * the kernels take a loaded module's tables at their word. */
#include "plug/vet.h"

#include "base/status.h"
#include "bulla/boundary.h"
#include "bulla/conductivity.h"
#include "bulla/constitutive.h"
#include "bulla/damage.h"
#include "bulla/eos.h"
#include "bulla/field.h"
#include "bulla/inelastic.h"
#include "bulla/limiter.h"
#include "bulla/reconstruction.h"
#include "bulla/riemann.h"
#include "bulla/viscosity.h"
#include "plug/vet_try.h"

#include <ctype.h>
#include <stdbool.h>
#include <string.h>

/* Flags of limiters that are known. */
#define VET_LIMITER (BULLA_TWO_SIDED | BULLA_SURFACES)

enum { VET_ROWS = 256, VET_PRESETS = 256, VET_SLOTS = 8 };

/* A function that a kind must supply. */
struct vet_slot {
    const char *name;
    size_t offset;
};

/* All that the program knows of a kind, but for its contract (suite/contract_suite.c) and who calls it. */
struct vet_kind {
    const char *name;
    size_t size; /* of the table of functions, as it was in the first version that modules may come from */
    struct vet_slot slots[VET_SLOTS];
    int (*more)(const struct bulla_module *module); /* what else must hold of the table; NULL: nothing */
    bool (*try)(const void *table, const void *self);
    const char *complaint; /* what an instance gives that fails in `try` */
    const char *use;       /* how a case names it: @ stands for the name and, behind a "type:", the keys */
};

#define VET_SLOT(table, slot)               \
    {                                       \
#slot, offsetof(struct table, slot) \
    }

static bool vet_empty(const char *text)
{
    return !text || !*text;
}

/* Lower case with hyphens: [a-z][a-z0-9]*(-[a-z0-9]+)* */
static bool vet_name(const char *name)
{
    if (vet_empty(name) || !islower((unsigned char)*name)) return false;
    for (const char *at = name; *at; at++) {
        bool letter = islower((unsigned char)*at) || isdigit((unsigned char)*at);
        if (!letter && (*at != '-' || at[1] == '-' || at[1] == '\0')) return false;
    }
    return true;
}

static int vet_head(const struct bulla_module *module, size_t space)
{
    if (space && space < offsetof(struct bulla_module, kind))
        return status_fail(STATUS_CASE, "is no module: its bulla_module has %zu bytes", space);
    if (module->magic != BULLA_MAGIC)
        return status_fail(STATUS_CASE, "is no module: magic number 0x%08x instead of 0x%08x", module->magic,
                           BULLA_MAGIC);
    if (module->abi != BULLA_ABI)
        return status_fail(STATUS_CASE, "was built for %s module interface %u; this program has %u: build it again",
                           module->abi < BULLA_ABI ? "the older" : "a newer", module->abi, BULLA_ABI);
    size_t size = space && space < module->size ? space : module->size;
    if (size < sizeof *module)
        return status_fail(STATUS_CASE, "has a descriptor of %zu bytes; at least %zu are needed", size, sizeof *module);
    if (!vet_name(module->name))
        return status_fail(STATUS_CASE, "has the name '%s'; names are lower case with hyphens",
                           module->name ? module->name : "");
    if (vet_empty(module->version) || vet_empty(module->doc) || vet_empty(module->cite))
        return status_fail(STATUS_CASE, "lacks its %s",
                           vet_empty(module->version) ? "version"
                           : vet_empty(module->doc)   ? "doc"
                                                      : "cite");
    return STATUS_OK;
}

static bool vet_tells_flags(const struct bulla_limiter *table)
{
    return table->size >= offsetof(struct bulla_limiter, flags) + sizeof table->flags;
}

bool vet_two_sided(const struct bulla_limiter *table)
{
    return vet_tells_flags(table) && (table->flags & BULLA_TWO_SIDED);
}

bool vet_surfaces(const struct bulla_limiter *table)
{
    return vet_tells_flags(table) && (table->flags & BULLA_SURFACES);
}

/* One slope, or edges on two sides. */
static int vet_limiter(const struct bulla_module *module)
{
    const struct bulla_limiter *table = module->table;
    bool two_sided = vet_two_sided(table);
    if (vet_tells_flags(table) && (table->flags & ~VET_LIMITER))
        return status_fail(STATUS_CASE, "has the flags 0x%x; this program knows 0x%x", table->flags, VET_LIMITER);
    if (two_sided ? !table->edges : !table->slope)
        return status_fail(STATUS_CASE, "has no function '%s', which %s needs", two_sided ? "edges" : "slope",
                           two_sided ? "BULLA_TWO_SIDED" : "kind limiter");
    return STATUS_OK;
}

/* What is more than a list of functions. */
static int vet_reconstruction(const struct bulla_module *module)
{
    const struct bulla_reconstruction *table = module->table;
    if (table->layers != 2 && table->layers != 3)
        return status_fail(STATUS_CASE, "asks for %u layers of neighbours; 2 or 3 can be had", table->layers);
    if (table->bounded > 1) return status_fail(STATUS_CASE, "says 'bounded' is %u; it is 0 or 1", table->bounded);
    if (!table->edges && !table->all)
        return status_fail(STATUS_CASE, "has neither of the functions 'edges' and 'all', of which kind reconstruction "
                                        "needs one");
    return STATUS_OK;
}

/* Bits that are known, and none that contradict each other. */
static int vet_boundary(const struct bulla_module *module)
{
    const struct bulla_boundary *table = module->table;
    uint32_t all = 2 * BULLA_BEHIND_ISENTROPIC - 1, moves = BULLA_BEHIND_DRIVES | BULLA_BEHIND_BRINGS;
    if (table->traits & ~all)
        return status_fail(STATUS_CASE, "has the traits 0x%x; this program knows 0x%x", table->traits, all);
    if (table->traits & BULLA_BEHIND_RESTS && table->traits & (moves | BULLA_BEHIND_REFERS))
        return status_fail(STATUS_CASE,
                           "says that it leaves what rests alone (RESTS), and that it refers to the start, "
                           "brings or drives");
    return STATUS_OK;
}

static int vet_output(const struct bulla_field_output *list, const struct bulla_field_output *output)
{
    bool plain = output->suffix && output->suffix[strspn(output->suffix, "abcdefghijklmnopqrstuvwxyz_0123456789")] == 0;
    if (!plain || vet_empty(output->unit) || vet_empty(output->doc))
        return status_fail(STATUS_CASE,
                           "has an output '%s' without a unit, a doc or a suffix of lower case letters, "
                           "digits and _",
                           output->suffix ? output->suffix : "");
    for (const struct bulla_field_output *other = list; other < output; other++)
        if (strcmp(other->suffix, output->suffix) == 0)
            return status_fail(STATUS_CASE, "has the output '%s' twice", output->suffix);
    return STATUS_OK;
}

static int vet_field(const struct bulla_module *module)
{
    const struct bulla_field *table = module->table;
    if (table->needs & ~(uint32_t)BULLA_FIELD_ALL)
        return status_fail(STATUS_CASE, "needs 0x%x; this program knows 0x%x", table->needs, BULLA_FIELD_ALL);
    if (!table->outputs->unit) return status_fail(STATUS_CASE, "has no outputs");
    for (const struct bulla_field_output *output = table->outputs; output->unit; output++) {
        if (output - table->outputs == BULLA_FIELD_OUTPUTS)
            return status_fail(STATUS_CASE, "has more than %d outputs", BULLA_FIELD_OUTPUTS);
        TRY(vet_output(table->outputs, output));
    }
    return STATUS_OK;
}

static int vet_conductivity(const struct bulla_module *module)
{
    const struct bulla_coefficient *table = module->table;
    if (!(table->needs & BULLA_NEEDS_RATE)) return STATUS_OK;
    return status_fail(STATUS_CASE, "looks at the rate of shear, which kind conductivity does not");
}

/* The time step must know how much it may give. */
static int vet_viscosity(const struct bulla_module *module)
{
    const struct bulla_coefficient *table = module->table;
    if (!(table->needs & BULLA_NEEDS_RATE) || table->most) return STATUS_OK;
    return status_fail(STATUS_CASE, "looks at the rate of shear but has no function 'most', which the time step needs");
}

/* "a|b|c" without empty or repeated words. */
static bool vet_choices(const char *choices)
{
    if (vet_empty(choices)) return false;
    for (const char *word = choices;;) {
        size_t length = strcspn(word, "|");
        if (length == 0) return false;
        for (const char *before = choices; before < word; before += strcspn(before, "|") + 1)
            if (strcspn(before, "|") == length && strncmp(before, word, length) == 0) return false;
        if (word[length] == '\0') return true;
        word += length + 1;
    }
}

static int vet_number(const struct bulla_param *row)
{
    if (vet_empty(row->unit)) return status_fail(STATUS_CASE, "has parameter '%s' without a unit", row->name);
    if (!(row->min <= row->max))
        return status_fail(STATUS_CASE, "has parameter '%s' with the range %g to %g", row->name, row->min, row->max);
    if (row->fallback < row->min || row->fallback > row->max) /* false for NaN: the key is required */
        return status_fail(STATUS_CASE, "has parameter '%s' with the default %g outside %g to %g", row->name,
                           row->fallback, row->min, row->max);
    return STATUS_OK;
}

/* Keys of a case that the program reads itself where it reads the parameters of a module, and those of a law of
 * rupture. */
#define VET_ALL "|type|preset|"
#define VET_DAMAGE "|type|preset|time|opens|void-pressure|void-temperature|"

/* Does the program read key `name` itself where it reads the parameters? */
static bool vet_taken(const char *name, const char *taken)
{
    size_t length = strlen(name);
    for (const char *at = taken; (at = strstr(at, name)); at += length)
        if (at[-1] == '|' && at[length] == '|') return true;
    return false;
}

static int vet_row(const struct bulla_param *table, const struct bulla_param *row, const char *taken)
{
    if (!vet_name(row->name))
        return status_fail(STATUS_CASE, "has a parameter '%s'; names are lower case with hyphens", row->name);
    if (vet_taken(row->name, taken))
        return status_fail(STATUS_CASE, "has a parameter '%s'; that key is reserved", row->name);
    for (const struct bulla_param *other = table; other < row; other++)
        if (strcmp(other->name, row->name) == 0) return status_fail(STATUS_CASE, "has parameter '%s' twice", row->name);
    if (vet_empty(row->doc)) return status_fail(STATUS_CASE, "has parameter '%s' without a doc", row->name);
    switch (row->type) {
    case BULLA_NUMBER: return vet_number(row);
    case BULLA_TEXT:
    case BULLA_FILE: return STATUS_OK;
    case BULLA_CHOICE:
        if (vet_choices(row->choices)) return STATUS_OK;
        return status_fail(STATUS_CASE, "has parameter '%s' with bad choices '%s'", row->name,
                           row->choices ? row->choices : "");
    default: return status_fail(STATUS_CASE, "has parameter '%s' of the unknown type %d", row->name, row->type);
    }
}

static int vet_params(const struct bulla_module *module)
{
    const char *taken = strcmp(module->kind, "damage") == 0 ? VET_DAMAGE : VET_ALL;
    if (!module->params) return STATUS_OK;
    const struct bulla_param *row = module->params;
    for (; row->name; row++) {
        if (row - module->params == VET_ROWS)
            return status_fail(STATUS_CASE, "has a parameter table without an end in %d rows", VET_ROWS);
        TRY(vet_row(module->params, row, taken));
    }
    return STATUS_OK;
}

static int vet_preset(const struct bulla_module *module, const struct bulla_preset *preset)
{
    if (!vet_name(preset->name))
        return status_fail(STATUS_CASE, "has a preset '%s'; names are lower case with hyphens", preset->name);
    for (const struct bulla_preset *other = module->presets; other < preset; other++)
        if (strcmp(other->name, preset->name) == 0)
            return status_fail(STATUS_CASE, "has preset '%s' twice", preset->name);
    if (vet_empty(preset->doc) || !preset->values)
        return status_fail(STATUS_CASE, "has preset '%s' without a doc or values", preset->name);
    for (size_t i = 0; module->params[i].name; i++) {
        const struct bulla_param *row = &module->params[i];
        double value = preset->values[i];
        if (row->type == BULLA_NUMBER && !(value >= row->min && value <= row->max))
            return status_fail(STATUS_CASE, "has preset '%s' with %s = %g outside %g to %g", preset->name, row->name,
                               value, row->min, row->max);
    }
    return STATUS_OK;
}

static int vet_presets(const struct bulla_module *module)
{
    if (!module->presets) return STATUS_OK;
    if (!module->params) return status_fail(STATUS_CASE, "has presets but no parameters");
    for (const struct bulla_preset *preset = module->presets; preset->name; preset++) {
        if (preset - module->presets == VET_PRESETS)
            return status_fail(STATUS_CASE, "has a list of presets without an end in %d entries", VET_PRESETS);
        TRY(vet_preset(module, preset));
    }
    return STATUS_OK;
}

#define VET_OF_MATERIAL(key) "materials: {NAME: {" key ": {type: @}}}"

static const struct vet_kind vet_kinds[] = {
    {"boundary",
     sizeof(struct bulla_boundary),
     {VET_SLOT(bulla_boundary, fill)},
     vet_boundary,
     vet_try_boundary,
     "gives no finite state behind a face that air at rest or at 10 m/s has",
     "domain: {boundaries: {x+: {type: @}}}"},
    {"conductivity",
     sizeof(struct bulla_conductivity),
     {VET_SLOT(bulla_conductivity, k.value)},
     vet_conductivity,
     vet_try_coefficient,
     "gives no number from 0, at 300 K and 1 bar",
     VET_OF_MATERIAL("conductivity")},
    {"constitutive",
     sizeof(struct bulla_constitutive),
     {VET_SLOT(bulla_constitutive, energy), VET_SLOT(bulla_constitutive, range)},
     NULL,
     vet_try_constitutive,
     "gives no finite energy that rises at stretches of 1, 2 and 4",
     VET_OF_MATERIAL("constitutive")},
    {"damage",
     sizeof(struct bulla_damage),
     {VET_SLOT(bulla_damage, grow), VET_SLOT(bulla_damage, needs)},
     NULL,
     vet_try_damage,
     "gives no aims from 0 to 1 and rates from 0 of a solid at rest and of one that is pulled, or needs what core does "
     "not know",
     VET_OF_MATERIAL("damage")},
    {"eos",
     offsetof(struct bulla_eos, energy), /* what came later is optional */
     {VET_SLOT(bulla_eos, state), VET_SLOT(bulla_eos, derivatives), VET_SLOT(bulla_eos, temperature),
      VET_SLOT(bulla_eos, entropy), VET_SLOT(bulla_eos, density), VET_SLOT(bulla_eos, p_min),
      VET_SLOT(bulla_eos, range)},
     NULL,
     NULL,
     NULL,
     VET_OF_MATERIAL("eos")},
    {"field",
     sizeof(struct bulla_field),
     {VET_SLOT(bulla_field, compute), VET_SLOT(bulla_field, outputs)},
     vet_field,
     vet_try_field,
     "gives no finite values for air that is stretched and moves at 10 m/s",
     "fields: {NAME: {type: @}}"},
    {"inelastic",
     sizeof(struct bulla_inelastic),
     {VET_SLOT(bulla_inelastic, strength), VET_SLOT(bulla_inelastic, needs)},
     NULL,
     vet_try_inelastic,
     "gives no finite strengths at plastic strains of 0 and 1, or needs what core does not know",
     VET_OF_MATERIAL("plastic")},
    {"limiter",
     offsetof(struct bulla_limiter, flags),
     {{0}},
     vet_limiter,
     vet_try_limiter,
     "gives no finite slopes or edges for differences of 1 and 0",
     "scheme: {limiter: @}"},
    {"reconstruction",
     sizeof(struct bulla_reconstruction),
     {{0}},
     vet_reconstruction,
     vet_try_reconstruction,
     "gives no finite edges for a gas of rising density",
     "scheme: {reconstruction: @}"},
    {"riemann",
     offsetof(struct bulla_riemann, solids),
     {VET_SLOT(bulla_riemann, solve)},
     NULL,
     vet_try_riemann,
     "gives no finite fluxes for air that moves at 10 m/s",
     "scheme: {riemann: @}"},
    {"viscosity",
     sizeof(struct bulla_viscosity),
     {VET_SLOT(bulla_viscosity, mu.value)},
     vet_viscosity,
     vet_try_coefficient,
     "gives no number from 0 to what it says to be the most, for a liquid at 300 K and 1 bar that is sheared at 100 "
     "1/s",
     VET_OF_MATERIAL("viscosity")},
};

enum { VET_KINDS = sizeof vet_kinds / sizeof *vet_kinds };

static const struct vet_kind *vet_kind(const struct bulla_module *module)
{
    for (int i = 0; i < VET_KINDS; i++)
        if (module->kind && strcmp(module->kind, vet_kinds[i].name) == 0) return &vet_kinds[i];
    return NULL;
}

static int vet_unknown(const struct bulla_module *module)
{
    struct text list = {0};
    for (int i = 0; i < VET_KINDS; i++) text_add(&list, "%s%s", i ? ", " : "", vet_kinds[i].name);
    int code = status_fail(STATUS_CASE, "is of the unknown kind '%s'; kinds are %s", module->kind ? module->kind : "",
                           list.at);
    text_done(&list);
    return code;
}

static int vet_table(const struct bulla_module *module)
{
    const struct vet_kind *kind = vet_kind(module);
    if (!kind) return vet_unknown(module);
    if (!module->table) return status_fail(STATUS_CASE, "has no table of functions");
    uint32_t size;
    memcpy(&size, module->table, sizeof size);
    if (size < kind->size)
        return status_fail(STATUS_CASE, "has a table of functions of size %u; kind %s needs %zu", size, kind->name,
                           kind->size);
    for (const struct vet_slot *slot = kind->slots; slot->name; slot++) {
        void *function;
        memcpy(&function, (const char *)module->table + slot->offset, sizeof function);
        if (!function)
            return status_fail(STATUS_CASE, "has no function '%s', which kind %s needs", slot->name, kind->name);
    }
    return kind->more ? kind->more(module) : STATUS_OK;
}

int vet_module(const struct bulla_module *module, size_t space)
{
    TRY(vet_head(module, space));
    TRY(vet_table(module));
    TRY(vet_params(module));
    return vet_presets(module);
}

int vet_instance(const struct bulla_module *module, const void *self)
{
    const struct vet_kind *kind = vet_kind(module);
    if (!kind->try || kind->try(module->table, self)) return STATUS_OK;
    return status_fail(STATUS_CASE, "%s '%s' %s", kind->name, module->name, kind->complaint);
}

void vet_use(const struct bulla_module *module, const char *keys, struct text *text)
{
    const char *use = vet_kind(module)->use, *at = strchr(use, '@');
    text_add(text, "%.*s%s%s%s", (int)(at - use), use, module->name, strstr(use, "type:") ? keys : "", at + 1);
}
