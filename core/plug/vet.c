/* vet.c - see vet.h. What is checked here is never checked again: the case layer, the schema and
 * the kernels take a loaded module's tables at their word. */
#include "plug/vet.h"

#include "base/status.h"
#include "bulla/constitutive.h"
#include "bulla/eos.h"
#include "bulla/conductivity.h"
#include "bulla/inelastic.h"
#include "bulla/limiter.h"
#include "bulla/reconstruction.h"
#include "bulla/riemann.h"
#include "bulla/viscosity.h"

#include <ctype.h>
#include <math.h>
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

struct vet_kind {
    const char *name;
    size_t size; /* of the table of functions, as it was in the first version that modules may come from */
    struct vet_slot slots[VET_SLOTS];
};

#define VET_SLOT(table, slot)               \
    {                                       \
#slot, offsetof(struct table, slot) \
    }

static const struct vet_kind vet_kinds[] = {
    {"conductivity", sizeof(struct bulla_conductivity), {VET_SLOT(bulla_conductivity, k.value)}},
    {"constitutive",
     sizeof(struct bulla_constitutive),
     {VET_SLOT(bulla_constitutive, energy), VET_SLOT(bulla_constitutive, range)}},
    {"eos",
     offsetof(struct bulla_eos, energy), /* what came later is optional */
     {VET_SLOT(bulla_eos, state), VET_SLOT(bulla_eos, derivatives), VET_SLOT(bulla_eos, temperature),
      VET_SLOT(bulla_eos, entropy), VET_SLOT(bulla_eos, density), VET_SLOT(bulla_eos, p_min),
      VET_SLOT(bulla_eos, range)}},
    {"inelastic",
     sizeof(struct bulla_inelastic),
     {VET_SLOT(bulla_inelastic, strength), VET_SLOT(bulla_inelastic, needs)}},
    {"limiter", offsetof(struct bulla_limiter, flags), {{0}}},
    {"reconstruction", sizeof(struct bulla_reconstruction), {{0}}},
    {"riemann", offsetof(struct bulla_riemann, solids), {VET_SLOT(bulla_riemann, solve)}},
    {"viscosity", sizeof(struct bulla_viscosity), {VET_SLOT(bulla_viscosity, mu.value)}},
};

enum { VET_KINDS = sizeof vet_kinds / sizeof *vet_kinds };

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

static int vet_table(const struct bulla_module *module)
{
    const struct vet_kind *kind = NULL;
    for (int i = 0; i < VET_KINDS; i++)
        if (module->kind && strcmp(module->kind, vet_kinds[i].name) == 0) kind = &vet_kinds[i];
    if (!kind)
        return status_fail(
            STATUS_CASE,
            "is of the unknown kind '%s'; kinds are conductivity, constitutive, eos, inelastic, limiter, "
            "reconstruction, riemann, viscosity",
            module->kind ? module->kind : "");
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
    if (strcmp(module->kind, "limiter") != 0) return STATUS_OK;
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
    if (strcmp(module->kind, "reconstruction") != 0) return STATUS_OK;
    if (table->layers != 2 && table->layers != 3)
        return status_fail(STATUS_CASE, "asks for %u layers of neighbours; 2 or 3 can be had", table->layers);
    if (table->bounded > 1) return status_fail(STATUS_CASE, "says 'bounded' is %u; it is 0 or 1", table->bounded);
    if (!table->edges && !table->all)
        return status_fail(STATUS_CASE, "has neither of the functions 'edges' and 'all', of which kind reconstruction "
                                        "needs one");
    return STATUS_OK;
}

/* Laws of transport: the time step must know how much they may give. */
static int vet_coefficient(const struct bulla_module *module)
{
    const struct bulla_coefficient *table = module->table;
    bool heat = strcmp(module->kind, "conductivity") == 0;
    if (heat && table->needs & BULLA_NEEDS_RATE)
        return status_fail(STATUS_CASE, "looks at the rate of shear, which kind conductivity does not");
    if (heat || strcmp(module->kind, "viscosity") != 0) return STATUS_OK;
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

static int vet_row(const struct bulla_param *table, const struct bulla_param *row)
{
    if (!vet_name(row->name))
        return status_fail(STATUS_CASE, "has a parameter '%s'; names are lower case with hyphens", row->name);
    if (strcmp(row->name, "type") == 0 || strcmp(row->name, "preset") == 0)
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
    if (!module->params) return STATUS_OK;
    const struct bulla_param *row = module->params;
    for (; row->name; row++) {
        if (row - module->params == VET_ROWS)
            return status_fail(STATUS_CASE, "has a parameter table without an end in %d rows", VET_ROWS);
        TRY(vet_row(module->params, row));
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

int vet_module(const struct bulla_module *module, size_t space)
{
    TRY(vet_head(module, space));
    TRY(vet_table(module));
    TRY(vet_limiter(module));
    TRY(vet_reconstruction(module));
    TRY(vet_coefficient(module));
    TRY(vet_params(module));
    return vet_presets(module);
}

/* Slopes of a straight line, of nothing, of an extremum; or edges of such cells. */
static bool vet_try_limiter(const struct bulla_limiter *limiter, const void *self)
{
    enum { CELLS = 3 };
    const double minus[] = {1.0, 0.0, 1.0}, plus[] = {1.0, 0.0, -1.0};
    const double rows[3][CELLS] = {{0.0, 1.0, 0.0}, {1.0, 1.0, 1.0}, {2.0, 1.0, 0.0}}; /* one below the other */
    double slope[CELLS] = {(double)NAN, (double)NAN, (double)NAN}, lower[CELLS], upper[CELLS];
    if (vet_two_sided(limiter)) {
        memcpy(lower, slope, sizeof slope);
        memcpy(upper, slope, sizeof slope);
        limiter->edges(self, CELLS, CELLS, rows[1], lower, upper);
        for (int i = 0; i < CELLS; i++) slope[i] = lower[i] + upper[i];
    } else limiter->slope(self, CELLS, minus, plus, slope);
    return isfinite(slope[0]) && isfinite(slope[1]) && isfinite(slope[2]);
}

/* No slopes: what a scheme may ask for while it is tried. */
static void vet_flat(const struct bulla_limited *limited, size_t n, size_t step, const double *w,
                     double *BULLA_RESTRICT lower, double *BULLA_RESTRICT upper)
{
    (void)limited;
    (void)step;
    memcpy(lower, w, n * sizeof *w);
    memcpy(upper, w, n * sizeof *w);
}

/* Edges of a gas that moves and whose density rises, in a row of as many cells as one needs. */
static bool vet_try_reconstruction(const struct bulla_reconstruction *scheme, const void *self)
{
    enum { ROWS = 3, CELLS = 5 };
    static const struct bulla_limited flat = {.size = sizeof flat, .edges = vet_flat};
    const double gas[ROWS][CELLS] = {{1, 2, 3, 4, 5}, {10, 10, 10, 10, 10}, {1e5, 1e5, 1e5, 1e5, 1e5}};
    double edges[2][ROWS] = {{(double)NAN, (double)NAN, (double)NAN}, {(double)NAN, (double)NAN, (double)NAN}};
    const double *w[ROWS] = {gas[0] + 2, gas[1] + 2, gas[2] + 2};
    double *lower[ROWS] = {&edges[0][0], &edges[0][1], &edges[0][2]};
    double *upper[ROWS] = {&edges[1][0], &edges[1][1], &edges[1][2]}, sum = 0.0;
    const struct bulla_limited *limited[ROWS] = {&flat, &flat, &flat};
    const struct bulla_cells cells = {.size = sizeof cells,
                                      .n = 1,
                                      .step = 1,
                                      .n_row = ROWS,
                                      .n_rho = 1,
                                      .n_u = 1,
                                      .i_u = 1,
                                      .i_p = 2,
                                      .i_stretch = ROWS,
                                      .w = w,
                                      .lower = lower,
                                      .upper = upper,
                                      .limited = limited};
    if (scheme->all) scheme->all(self, &cells);
    for (int q = 0; q < ROWS && !scheme->all; q++) scheme->edges(self, &flat, 1, 1, w[q], lower[q], upper[q]);
    for (int q = 0; q < ROWS; q++) sum += *lower[q] + *upper[q];
    return isfinite(sum);
}

/* A gas that moves through a face, the same on both sides. */
static bool vet_try_riemann(const struct bulla_riemann *riemann, const void *self)
{
    double rho = 1.2, p = 1e5, rho_E = 2.5e5 + 60.0, c = 341.6, u = 10.0, work[4];
    double mass = (double)NAN, momentum = (double)NAN, energy = (double)NAN, speed = (double)NAN;
    const struct bulla_side side = {&rho, &p, &rho_E, &c, (const double *[]){&u}, (const double *[]){&rho}, NULL};
    const struct bulla_faces faces = {.n = 1,
                                      .n_material = 1,
                                      .n_velocity = 1,
                                      .left = side,
                                      .right = side,
                                      .flux = {(double *[]){&mass}, (double *[]){&momentum}, &energy, &speed, NULL},
                                      .work = {&work[0], &work[1], &work[2], &work[3]}};
    riemann->solve(self, &faces);
    return isfinite(mass) && isfinite(momentum) && isfinite(energy) && isfinite(speed);
}

/* A solid at rest, and stretched to twice and to four times its length. */
static bool vet_try_constitutive(const struct bulla_constitutive *law, const void *self)
{
    enum { N = 3 };
    const double I1[N] = {3.0, 5.0, 16.5}, I2[N] = {3.0, 4.25, 8.0625}, nan = (double)NAN;
    double e[N] = {nan, nan, nan}, e_1[N] = {nan, nan, nan}, e_2[N] = {nan, nan, nan}, sum = 0.0;
    law->energy(self, N, I1, I2, e, e_1, e_2);
    for (int i = 0; i < N; i++) sum += e[i] + e_1[i] + e_2[i];
    bool good = isfinite(sum), none = true;
    for (int i = 0; i < N; i++) none &= e[i] == 0.0 && e_1[i] == 0.0 && e_2[i] == 0.0;
    for (int i = 0; i < N; i++) good &= none || e_1[i] + e_2[i] > 0.0; /* a Maxwell fluid bears nothing at rest */
    if (!law->second) return good;
    double e_11[N] = {nan, nan, nan}, e_12[N] = {nan, nan, nan}, e_22[N] = {nan, nan, nan};
    law->second(self, N, I1, I2, e_11, e_12, e_22);
    for (int i = 0; i < N; i++) sum += e_11[i] + e_12[i] + e_22[i];
    return good && isfinite(sum);
}

/* Strength of a body at rest, of one that has flowed far and fast, and of a hot one. */
static bool vet_try_inelastic(const struct bulla_inelastic *law, const void *self)
{
    enum { N = 3 };
    const double eps[N] = {0.0, 1.0, 0.1}, rate[N] = {0.0, 1e6, 1.0}, p[N] = {1e5, 1e9, 0.0},
                 T[N] = {300.0, 600.0, 1e4};
    const double rho[N] = {1e3, 1e4, 1e3};
    double Y[N] = {(double)NAN, (double)NAN, (double)NAN};
    if (law->needs(self) & ~(uint32_t)BULLA_INELASTIC_ALL) return false;
    law->strength(self, N, eps, rate, p, T, rho, Y);
    return isfinite(Y[0] + Y[1] + Y[2]) && Y[0] >= 0.0 && Y[1] >= 0.0 && Y[2] >= 0.0;
}

/* A liquid that is sheared at 300 K: what comes out may stand in a flux, and what bounds it in a time step. */
static bool vet_try_coefficient(const struct bulla_coefficient *law, const void *self)
{
    const double rate = 100.0, T = 300.0, p = 1e5, rho = 1000.0;
    double value = (double)NAN;
    law->value(self, 1, law->needs & BULLA_NEEDS_RATE ? &rate : NULL, law->needs & BULLA_NEEDS_TEMPERATURE ? &T : NULL,
               law->needs & BULLA_NEEDS_PRESSURE ? &p : NULL, law->needs & BULLA_NEEDS_DENSITY ? &rho : NULL, &value);
    bool bounded = !(law->needs & BULLA_NEEDS_RATE) || (isfinite(law->most(self)) && law->most(self) >= value);
    return isfinite(value) && value >= 0.0 && bounded;
}

int vet_instance(const struct bulla_module *module, const void *self)
{
    if (strcmp(module->kind, "limiter") == 0 && !vet_try_limiter(module->table, self))
        return status_fail(STATUS_CASE, "limiter '%s' gives no finite slopes or edges for differences of 1 and 0",
                           module->name);
    if (strcmp(module->kind, "constitutive") == 0 && !vet_try_constitutive(module->table, self))
        return status_fail(STATUS_CASE,
                           "constitutive '%s' gives no finite energy that rises at stretches of 1, 2 and 4",
                           module->name);
    if (strcmp(module->kind, "inelastic") == 0 && !vet_try_inelastic(module->table, self))
        return status_fail(STATUS_CASE,
                           "inelastic '%s' gives no finite strengths at plastic strains of 0 and 1, or needs what core "
                           "does not know",
                           module->name);
    if (strcmp(module->kind, "reconstruction") == 0 && !vet_try_reconstruction(module->table, self))
        return status_fail(STATUS_CASE, "reconstruction '%s' gives no finite edges for a gas of rising density",
                           module->name);
    if (strcmp(module->kind, "riemann") == 0 && !vet_try_riemann(module->table, self))
        return status_fail(STATUS_CASE, "riemann '%s' gives no finite fluxes for air that moves at 10 m/s",
                           module->name);
    if (strcmp(module->kind, "viscosity") == 0 && !vet_try_coefficient(module->table, self))
        return status_fail(
            STATUS_CASE,
            "viscosity '%s' gives no number from 0 to what it says to be the most, for a liquid at 300 K "
            "and 1 bar that is sheared at 100 1/s",
            module->name);
    if (strcmp(module->kind, "conductivity") == 0 && !vet_try_coefficient(module->table, self))
        return status_fail(STATUS_CASE, "conductivity '%s' gives no number from 0, at 300 K and 1 bar", module->name);
    return STATUS_OK;
}
