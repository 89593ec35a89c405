/* hostile.c - modules with one thing wrong each, for tests/unit/registry.c.
 *
 * Built once per flaw with -DFLAW=NAME; FLAW_none is in order, so that each refusal is due to the
 * flaw and to nothing else. */
#include "bulla/eos.h"
#include "bulla/limiter.h"

#include <math.h>
#include <string.h>

enum flaw {
    none,
    bad_magic,
    old_abi,
    new_abi,
    short_size,
    no_table,
    short_table,
    null_slot,
    new_flags,
    null_edges,
    unknown_kind,
    bad_name,
    no_doc,
    param_twice,
    param_upper,
    param_reserved,
    param_range,
    param_fallback,
    param_unit,
    param_choices,
    preset_range,
    duplicate,
    no_symbol,
    small_symbol,
    missing_function,
    flush_to_zero,
    fast_math,
    open_fails,
    aborts,
};

#define IS(name) (FLAW == (name))

#ifdef FLAW_MISSING
extern double nobody_defines_this(double x);
#define HOSTILE_SLOPE(x) nobody_defines_this(x)
#else
#define HOSTILE_SLOPE(x) ((x)*0.0)
#endif

#ifdef FLAW_FLUSH
#include <xmmintrin.h>
__attribute__((constructor)) static void hostile_flush(void)
{
    _mm_setcsr(_mm_getcsr() | 0x8040u);
}
#endif

#ifdef FLAW_ABORTS
#include <stdlib.h>
__attribute__((constructor)) static void hostile_abort(void)
{
    abort();
}
#endif

static void hostile_slope(const void *self, size_t n, const double *BULLA_RESTRICT d_minus,
                          const double *BULLA_RESTRICT d_plus, double *BULLA_RESTRICT slope)
{
    (void)self, (void)d_plus;
    for (size_t i = 0; i < n; i++) slope[i] = HOSTILE_SLOPE(d_minus[i]);
}

static int hostile_open(const struct bulla_host *host, const struct bulla_value *values, void **ret_self)
{
    (void)values, (void)ret_self;
    if (!IS(open_fails)) return 0;
    host->fail("the moon is not full");
    return 1;
}

static const struct bulla_limiter hostile_table = {.size = IS(short_table) ? 4 : sizeof(struct bulla_limiter),
                                                   .slope = IS(null_slot) ? NULL : hostile_slope,
                                                   .flags = IS(new_flags)    ? 4u
                                                            : IS(null_edges) ? BULLA_TWO_SIDED
                                                                             : 0u};

static const struct bulla_param hostile_params[] = {
    {IS(param_upper)      ? "Strength"
     : IS(param_reserved) ? "type"
                          : "strength",
     IS(param_unit) ? "" : "Pa", IS(param_range) ? 5.0 : 0.0, 2.0, IS(param_fallback) ? 3.0 : 1.0, "how strong",
     BULLA_NUMBER, NULL},
    {IS(param_twice) ? "strength" : "mode", "Pa", 0.0, 2.0, 1.0, "which way", BULLA_CHOICE,
     IS(param_choices) ? "one||two" : "one|two"},
    {"note", NULL, 0.0, 0.0, NAN, "any text", BULLA_TEXT, ""},
    {0},
};

static const struct bulla_preset hostile_presets[] = {
    {"usual", "nothing special", (const double[]){IS(preset_range) ? 7.0 : 0.5, 0.0, 0.0}},
    {0},
};

#ifdef FLAW_SMALL
extern BULLA_EXPORT const int bulla_module_int;
BULLA_EXPORT const int bulla_module_int __asm__("bulla_module") = 1;
const void *const hostile_keep[] = {&hostile_table, hostile_params, hostile_presets, (const void *)hostile_open};
#else
#ifdef FLAW_NAMELESS
#define HOSTILE_SYMBOL hostile_other_name
extern BULLA_EXPORT const struct bulla_module HOSTILE_SYMBOL;
#else
#define HOSTILE_SYMBOL bulla_module
#endif
BULLA_EXPORT const struct bulla_module HOSTILE_SYMBOL = {
    .magic = IS(bad_magic) ? 0x12345678u : BULLA_MAGIC,
    .abi = IS(old_abi)   ? BULLA_ABI - 1
           : IS(new_abi) ? BULLA_ABI + 1
                         : BULLA_ABI,
    .size = IS(short_size) ? 40 : sizeof(struct bulla_module),
    .kind = IS(unknown_kind) ? "weather" : "limiter",
    .name = IS(bad_name)    ? "Bad_Name"
            : IS(duplicate) ? "minmod"
                            : "hostile",
    .version = "1.0",
    .doc = IS(no_doc) ? NULL : "A limiter for tests.",
    .cite = "nobody",
    .params = hostile_params,
    .presets = hostile_presets,
    .open = hostile_open,
    .table = IS(no_table) ? NULL : &hostile_table,
};
#endif
