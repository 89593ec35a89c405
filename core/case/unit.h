/* unit.h - quantities with units: "10 um", "83.3 kHz", "998.2 kg/m3", "37 degC".
 *
 * A unit is a product of symbols with SI prefixes and powers; inside bulla everything is SI.
 * A dimension is the list of exponents of the base units. */
#ifndef UNIT_H
#define UNIT_H

#include <stdbool.h>
#include <stddef.h>

struct text;

enum { UNIT_BASES = 5 }; /* m, kg, s, K, mol */

/* SI value = number * 10^decimal * factor + offset. Powers of ten are kept apart so that
 * "10 um" is the same double as 10e-6; offset is for degC alone. */
struct unit {
    double factor, offset;
    int decimal;
    signed char power[UNIT_BASES];
};

/* Reads a whole unit text ("" is a pure number). On failure false and, in `bad`, the symbol
 * that is not known (or "" if the form is wrong). */
bool unit_parse(const char *text, struct unit *ret_unit, char bad[static 32]);

/* Reads a number with or without a unit; `ret_value` is in SI (may be infinite: overflow). The
 * number alone must be a YAML 1.2 number. */
enum unit_fault { UNIT_FINE, UNIT_NO_NUMBER, UNIT_UNKNOWN, UNIT_MALFORMED };
enum unit_fault unit_quantity(const char *text, double *ret_value, struct unit *ret_unit, char bad[static 32]);

bool unit_same(const struct unit *a, const struct unit *b);

/* What a dimension is called: "a pressure", or "a quantity in kg/m2/s" for one without a name
 * (written into `words`). */
const char *unit_kind(const struct unit *unit, char *words, size_t size);

/* Units that people use for a dimension: "Pa, kPa, MPa, GPa, bar, atm"; NULL if it has no list. */
const char *unit_examples(const struct unit *unit);

/* Adds a regular expression (of ECMA-262, as JSON Schema has them) for the unit texts of a dimension; NULL: of
 * any. Products and quotients are judged by their symbols only, not by their dimension. */
void unit_pattern(const struct unit *wanted, struct text *text);

/* A known unit symbol that was probably meant by `bad`, preferably one of dimension `wanted`;
 * "" if there is none. Written to `ret_symbol`. */
void unit_guess(const char *bad, const struct unit *wanted, char ret_symbol[static 32]);

#endif
