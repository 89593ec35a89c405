/* unit.c - see unit.h. A small fixed table: what is used in fluids, ultrasound and bubbles.
 * Symbols are looked up whole first, then as prefix + symbol, so that "min" is a minute and
 * "Pa" never a peta-something. */
#include "case/unit.h"

#include "base/text.h"

#include <ctype.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>

struct unit_symbol {
    const char *name;
    int decimal;
    double factor;
    signed char power[UNIT_BASES];
    bool prefixed; /* takes SI prefixes */
};

static const struct unit_symbol unit_symbols[] = {
    {"m", 0, 1, {1, 0, 0, 0, 0}, true},
    {"g", -3, 1, {0, 1, 0, 0, 0}, true},
    {"s", 0, 1, {0, 0, 1, 0, 0}, true},
    {"K", 0, 1, {0, 0, 0, 1, 0}, true},
    {"mol", 0, 1, {0, 0, 0, 0, 1}, true},
    {"N", 0, 1, {1, 1, -2, 0, 0}, true},
    {"Pa", 0, 1, {-1, 1, -2, 0, 0}, true},
    {"bar", 5, 1, {-1, 1, -2, 0, 0}, true},
    {"atm", 0, 101325, {-1, 1, -2, 0, 0}, false},
    {"mmHg", 0, 133.322387415, {-1, 1, -2, 0, 0}, false},
    {"psi", 0, 6894.757293168361, {-1, 1, -2, 0, 0}, false},
    {"J", 0, 1, {2, 1, -2, 0, 0}, true},
    {"W", 0, 1, {2, 1, -3, 0, 0}, true},
    {"Hz", 0, 1, {0, 0, -1, 0, 0}, true},
    {"L", -3, 1, {3, 0, 0, 0, 0}, true},
    {"l", -3, 1, {3, 0, 0, 0, 0}, true},
    {"cal", 0, 4.184, {2, 1, -2, 0, 0}, true},
    {"min", 0, 60, {0, 0, 1, 0, 0}, false},
    {"h", 0, 3600, {0, 0, 1, 0, 0}, false},
    {"rad", 0, 1, {0, 0, 0, 0, 0}, true},
    {"deg", 0, 0.017453292519943295, {0, 0, 0, 0, 0}, false},
    {"%", -2, 1, {0, 0, 0, 0, 0}, false},
    {"ppm", -6, 1, {0, 0, 0, 0, 0}, false},
    {"1", 0, 1, {0, 0, 0, 0, 0}, false},
};
enum { UNIT_SYMBOLS = sizeof unit_symbols / sizeof *unit_symbols };

static const struct unit_prefix {
    const char *name;
    int decimal;
} unit_prefixes[] = {
    {"f", -15}, {"p", -12}, {"n", -9}, {"u", -6}, {"\xc2\xb5", -6}, {"\xce\xbc", -6}, {"m", -3},
    {"c", -2},  {"d", -1},  {"h", 2},  {"k", 3},  {"M", 6},         {"G", 9},         {"T", 12},
};
enum { UNIT_PREFIXES = sizeof unit_prefixes / sizeof *unit_prefixes };

static const struct unit_family {
    signed char power[UNIT_BASES];
    const char *kind, *examples;
} unit_families[] = {
    {{0, 0, 0, 0, 0}, "a pure number", "1, %, deg"},
    {{1, 0, 0, 0, 0}, "a length", "m, cm, mm, um, nm"},
    {{2, 0, 0, 0, 0}, "an area", "m2, mm2, um2"},
    {{3, 0, 0, 0, 0}, "a volume", "m3, mm3, mL, L"},
    {{0, 1, 0, 0, 0}, "a mass", "kg, g, mg"},
    {{0, 0, 1, 0, 0}, "a time", "s, ms, us, ns"},
    {{0, 0, 0, 1, 0}, "a temperature", "K, degC"},
    {{0, 0, -1, 0, 0}, "a frequency or rate", "Hz, kHz, MHz, 1/s, 1/us"},
    {{-1, 1, -2, 0, 0}, "a pressure", "Pa, kPa, MPa, GPa, bar, atm"},
    {{-3, 1, 0, 0, 0}, "a density", "kg/m3, g/cm3"},
    {{1, 0, -1, 0, 0}, "a velocity", "m/s, km/s, mm/us"},
    {{1, 0, -2, 0, 0}, "an acceleration", "m/s2"},
    {{2, 0, -2, 0, 0}, "an energy per mass", "J/kg, kJ/kg, m2/s2"},
    {{2, 0, -2, -1, 0}, "a specific heat", "J/kg/K, kJ/kg/K"},
    {{2, 1, -2, 0, 0}, "an energy", "J, mJ, uJ"},
    {{3, -1, 0, 0, 0}, "a specific volume", "m3/kg, cm3/g"},
    {{-1, 1, -1, 0, 0}, "a dynamic viscosity", "Pa*s, mPa*s"},
    {{2, 0, -1, 0, 0}, "a kinematic viscosity or diffusivity", "m2/s, mm2/s"},
    {{0, 1, -2, 0, 0}, "a surface tension", "N/m, mN/m"},
    {{1, 1, -3, -1, 0}, "a heat conductivity", "W/m/K"},
    {{0, 1, 0, 0, -1}, "a molar mass", "kg/mol, g/mol"},
    {{1, 1, -2, 0, 0}, "a force", "N, mN, uN"},
    {{-2, 1, -2, 0, 0}, "a force per volume or a pressure gradient", "N/m3, Pa/m, kPa/m"},
    {{-1, 1, -3, 0, 0}, "a power per volume", "W/m3, MW/m3, W/cm3"},
    {{0, 1, -3, 0, 0}, "a power per area", "W/m2, kW/m2, W/cm2"},
    {{-3, 1, -1, 0, 0}, "a mass per volume and time", "kg/m3/s, g/cm3/us"},
};
enum { UNIT_FAMILIES = sizeof unit_families / sizeof *unit_families };

/* One symbol of `length` bytes, with or without a prefix. */
static bool unit_lookup(const char *from, size_t length, struct unit *ret)
{
    for (int pass = 0; pass <= UNIT_PREFIXES; pass++) {
        const struct unit_prefix *prefix = pass ? &unit_prefixes[pass - 1] : NULL;
        size_t head = prefix ? strlen(prefix->name) : 0;
        if (head >= length || (prefix && strncmp(from, prefix->name, head) != 0)) continue;
        for (int i = 0; i < UNIT_SYMBOLS; i++) {
            const struct unit_symbol *symbol = &unit_symbols[i];
            if (prefix && !symbol->prefixed) continue;
            if (strlen(symbol->name) != length - head || strncmp(from + head, symbol->name, length - head) != 0)
                continue;
            *ret = (struct unit){.factor = symbol->factor, .decimal = symbol->decimal + (prefix ? prefix->decimal : 0)};
            memcpy(ret->power, symbol->power, sizeof ret->power);
            return true;
        }
    }
    return false;
}

static bool unit_multiply(struct unit *product, const struct unit *by, int power)
{
    product->factor *= pow(by->factor, power);
    product->decimal += power * by->decimal;
    for (int i = 0; i < UNIT_BASES; i++) {
        int sum = product->power[i] + power * by->power[i];
        if (sum < -99 || sum > 99) return false;
        product->power[i] = (signed char)sum;
    }
    return true;
}

/* An exponent at `*at` ("3", "^3", "^-3", "-3"); 1 if there is none, 0 if it is badly formed. */
static int unit_exponent(const char **at)
{
    bool hat = **at == '^';
    if (hat) ++*at;
    int sign = **at == '-' ? -1 : 1;
    if (sign < 0) ++*at;
    if (!isdigit((unsigned char)**at)) return hat || sign < 0 ? 0 : 1;
    int value = **at - '0';
    ++*at;
    return isdigit((unsigned char)**at) ? 0 : sign * value;
}

static bool unit_product(const char **at, struct unit *ret, char bad[static 32], int depth);

/* A symbol or a bracket, with its exponent. */
static bool unit_factor(const char **at, struct unit *ret, char bad[static 32], int depth)
{
    bad[0] = '\0';
    if (**at == '(') {
        ++*at;
        if (depth > 8 || !unit_product(at, ret, bad, depth + 1) || **at != ')') return false;
        ++*at;
    } else {
        size_t length = strcspn(*at, " ()*/^.-0123456789\xc2\xb7");
        if (**at == '1' && !isdigit((unsigned char)(*at)[1])) length = 1;
        if (strncmp(*at, "\xc2\xb5", 2) == 0) length = 2 + strcspn(*at + 2, " ()*/^.-0123456789");
        if (!unit_lookup(*at, length, ret)) {
            snprintf(bad, 32, "%.*s", (int)length, *at);
            return false;
        }
        *at += length;
    }
    int exponent = unit_exponent(at);
    struct unit base = *ret;
    *ret = (struct unit){.factor = 1};
    return exponent != 0 && unit_multiply(ret, &base, exponent);
}

/* factor { (* | . | middle dot | blank) factor | / factor } */
static bool unit_product(const char **at, struct unit *ret, char bad[static 32], int depth)
{
    *ret = (struct unit){.factor = 1};
    int power = 1;
    for (;;) {
        struct unit factor;
        *at += strspn(*at, " ");
        if (!unit_factor(at, &factor, bad, depth) || !unit_multiply(ret, &factor, power)) return false;
        size_t blanks = strspn(*at, " ");
        *at += blanks;
        if (**at == '\0' || **at == ')') return true;
        power = **at == '/' ? -1 : 1;
        if (**at == '/' || **at == '*' || **at == '.') ++*at;
        else if (strncmp(*at, "\xc2\xb7", 2) == 0) *at += 2;
        else if (!blanks) return false;
    }
}

bool unit_parse(const char *text, struct unit *ret_unit, char bad[static 32])
{
    bad[0] = '\0';
    *ret_unit = (struct unit){.factor = 1};
    text += strspn(text, " ");
    if (!*text) return true;
    if (strcmp(text, "degC") == 0 || strcmp(text, "\xc2\xb0"
                                                  "C") == 0) {
        *ret_unit = (struct unit){.factor = 1, .offset = 273.15, .power = {0, 0, 0, 1, 0}};
        return true;
    }
    return unit_product(&text, ret_unit, bad, 0) && *text == '\0';
}

/* digits * 10^shift, rounded once */
static double unit_shift(const char *digits, size_t length, int shift)
{
    char number[400];
    size_t mantissa = 0;
    while (mantissa < length && digits[mantissa] != 'e' && digits[mantissa] != 'E') mantissa++;
    if (mantissa > sizeof number - 32) return strtod(digits, NULL) * pow(10, shift);
    long exponent = mantissa < length ? strtol(digits + mantissa + 1, NULL, 10) : 0;
    if (exponent > 100000) exponent = 100000;
    if (exponent < -100000) exponent = -100000;
    snprintf(number, sizeof number, "%.*se%ld", (int)mantissa, digits, exponent + shift);
    return strtod(number, NULL);
}

enum unit_fault unit_quantity(const char *text, double *ret_value, struct unit *ret_unit, char bad[static 32])
{
    double number;
    size_t read = text_number(text, &number);
    if (!read) return UNIT_NO_NUMBER;
    size_t end = strlen(text);
    while (end > read && text[end - 1] == ' ') end--;
    char words[128];
    snprintf(words, sizeof words, "%.*s", (int)(end - read), text + read);
    if (!unit_parse(words, ret_unit, bad)) return bad[0] ? UNIT_UNKNOWN : UNIT_MALFORMED;
    number = ret_unit->decimal ? unit_shift(text, read, ret_unit->decimal) : number;
    *ret_value = number * ret_unit->factor + ret_unit->offset;
    return UNIT_FINE;
}

bool unit_same(const struct unit *a, const struct unit *b)
{
    return memcmp(a->power, b->power, sizeof a->power) == 0;
}

static const struct unit_family *unit_family_of(const struct unit *unit)
{
    for (int i = 0; i < UNIT_FAMILIES; i++)
        if (memcmp(unit_families[i].power, unit->power, sizeof unit->power) == 0) return &unit_families[i];
    return NULL;
}

const char *unit_kind(const struct unit *unit, char *words, size_t size)
{
    static const char *const bases[UNIT_BASES] = {"m", "kg", "s", "K", "mol"};
    const struct unit_family *family = unit_family_of(unit);
    if (family) return family->kind;
    size_t at = (size_t)snprintf(words, size, "a quantity in");
    for (int i = 0; i < UNIT_BASES; i++)
        if (unit->power[i] && at < size)
            at += (size_t)snprintf(words + at, size - at, unit->power[i] == 1 ? " %s" : " %s%d", bases[i],
                                   unit->power[i]);
    return words;
}

const char *unit_examples(const struct unit *unit)
{
    const struct unit_family *family = unit_family_of(unit);
    return family ? family->examples : NULL;
}

/* Is it one of the units that people use for the dimension? */
static bool unit_is_example(const char *symbol, const struct unit *wanted)
{
    const char *at = wanted ? unit_examples(wanted) : NULL;
    for (size_t length; at && *at; at += length + strspn(at + length, ", ")) {
        length = strcspn(at, ",");
        if (strlen(symbol) == length && strncmp(symbol, at, length) == 0) return true;
    }
    return false;
}

/* How far a candidate is from what was written: a wrong case is nearest, then typing errors;
 * among equals, units that people use for the wanted dimension. 9: not at all. */
static unsigned unit_distance(const char *bad, const char *candidate, bool example, bool same)
{
    unsigned edits = text_distance(bad, candidate);
    if (strcasecmp(bad, candidate) == 0) return example ? 0 : 1;
    if (edits > 1 || strlen(bad) < 2) return 9;
    return 4U - (same ? 2U : 0U) - (example ? 1U : 0U);
}

void unit_guess(const char *bad, const struct unit *wanted, char ret_symbol[static 32])
{
    unsigned least = 9;
    ret_symbol[0] = '\0';
    for (int i = 0; i < UNIT_SYMBOLS; i++) {
        bool same = wanted && memcmp(unit_symbols[i].power, wanted->power, sizeof wanted->power) == 0;
        for (int pass = 0; pass <= UNIT_PREFIXES; pass++) {
            if (pass && !unit_symbols[i].prefixed) break;
            char candidate[32];
            snprintf(candidate, sizeof candidate, "%s%s", pass ? unit_prefixes[pass - 1].name : "",
                     unit_symbols[i].name);
            unsigned distance = unit_distance(bad, candidate, unit_is_example(candidate, wanted), same);
            if (distance >= least) continue;
            least = distance;
            memcpy(ret_symbol, candidate, sizeof candidate);
        }
    }
}

/* The power of a symbol that gives a dimension, or 0. */
static int unit_root(const struct unit_symbol *symbol, const struct unit *wanted)
{
    for (int size = 1; size <= 9; size++)
        for (int power = size; power >= -size; power -= 2 * size) {
            bool same = true;
            for (int i = 0; i < UNIT_BASES; i++) same &= symbol->power[i] * power == wanted->power[i];
            if (same) return power;
        }
    return 0;
}

static void unit_pattern_prefixes(struct text *text)
{
    text_add(text, "(?:");
    for (int i = 0; i < UNIT_PREFIXES; i++) text_add(text, "%s%s", i ? "|" : "", unit_prefixes[i].name);
    text_add(text, ")?");
}

/* Symbols that take prefixes or do not, with the power that gives the dimension (`wanted` NULL: all, with any). */
static bool unit_pattern_symbols(const struct unit *wanted, bool prefixed, struct text *text)
{
    bool any = false;
    for (int i = 0; i < UNIT_SYMBOLS; i++) {
        int power = wanted ? unit_root(&unit_symbols[i], wanted) : 1;
        if (unit_symbols[i].prefixed != prefixed || !power) continue;
        if (any) text_add(text, "|");
        else if (prefixed) unit_pattern_prefixes(text);
        if (!any) text_add(text, "(?:");
        text_add(text, "%s", unit_symbols[i].name);
        if (wanted && power == 1) text_add(text, "(?:\\^?1)?");
        if (wanted && power != 1) text_add(text, "\\^?%d", power);
        any = true;
    }
    if (any) text_add(text, ")");
    return any;
}

static void unit_pattern_either(const struct unit *wanted, struct text *text)
{
    if (unit_pattern_symbols(wanted, true, text)) text_add(text, "|");
    if (!unit_pattern_symbols(wanted, false, text)) text_add(text, "(?!)");
}

void unit_pattern(const struct unit *wanted, struct text *text)
{
    bool warm = !wanted || (wanted->power[3] == 1 && unit_root(&unit_symbols[3], wanted) == 1);
    text_add(text, "(?:");
    if (wanted) unit_pattern_either(wanted, text);
    if (wanted) text_add(text, "|(?=.*[^ ][*/. \xc2\xb7(])"); /* more than one symbol */
    text_add(text, "(?:\\(?(?:");
    unit_pattern_either(NULL, text);
    text_add(text, ")\\)?(?:\\^?-?[1-9])?\\)?(?:\\^?-?[1-9])?(?: *[*/.\xc2\xb7] *(?=[^ ])| +(?=[^ ])|(?= *$)))+");
    if (warm)
        text_add(text, "|degC|\xc2\xb0"
                       "C");
    text_add(text, ")");
}
