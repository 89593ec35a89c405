/* human.c - see human.h. */
#include "cli/human.h"

#include "base/status.h"

#include <math.h>
#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>

const char *human_si(double value, const char *unit, char text[HUMAN_ROOM])
{
    static const char *const prefixes[] = {"q", "r", "y", "z", "a", "f", "p", "n", "u", "m", "",
                                           "k", "M", "G", "T", "P", "E", "Z", "Y", "R", "Q"};
    int third = 0;
    if (value != 0 && isfinite(value)) third = (int)floor((log10(fabs(value)) + 1e-12) / 3);
    if (third < -10) third = -10;
    if (third > 10) third = 10;
    snprintf(text, HUMAN_ROOM, "%.4g %s%s", value / pow(10, 3 * third), prefixes[third + 10], unit);
    return text;
}

const char *human_count(double value, char text[HUMAN_ROOM])
{
    if (value < 1e5) snprintf(text, HUMAN_ROOM, "%.0f", value);
    else human_si(value, "", text);
    return text;
}

const char *human_duration(double seconds, char text[HUMAN_ROOM])
{
    if (!isfinite(seconds) || seconds < 0 || seconds > 1e10) {
        snprintf(text, HUMAN_ROOM, "-");
        return text;
    }
    long whole = lround(seconds), days = whole / 86400, hours = whole / 3600 % 24;
    int minutes = (int)(whole / 60 % 60), rest = (int)(whole % 60);
    if (days) snprintf(text, HUMAN_ROOM, "%ld d %02ld:%02d:%02d", days, hours, minutes, rest);
    else if (hours) snprintf(text, HUMAN_ROOM, "%ld:%02d:%02d", hours, minutes, rest);
    else snprintf(text, HUMAN_ROOM, "%d:%02d", minutes, rest);
    return text;
}

const char *human_bytes(double bytes, char text[HUMAN_ROOM])
{
    static const char *const units[] = {"B", "KiB", "MiB", "GiB", "TiB", "PiB"};
    size_t i = 0;
    while (bytes >= 1024 && i + 1 < sizeof units / sizeof *units) {
        bytes /= 1024;
        i++;
    }
    snprintf(text, HUMAN_ROOM, "%.3g %s", bytes, units[i]);
    return text;
}

int human_read_duration(const char *text, double *ret_seconds)
{
    double total = 0;
    const char *at = text;
    for (int part = 0; part < 3; part++) {
        char *end;
        long value = strtol(at, &end, 10);
        if (end == at || value < 0 || (part && value > 59)) break;
        total = 60 * total + (double)value;
        if (!*end) {
            *ret_seconds = total;
            return 0;
        }
        if (*end != ':') break;
        at = end + 1;
    }
    return status_fail(STATUS_CASE, "'%s' is no duration; write HH:MM:SS, MM:SS or seconds", text);
}

int human_read_bytes(const char *text, double *ret_bytes)
{
    static const char letters[] = "kmgtp";
    char *end;
    double number = strtod(text, &end);
    const char *unit = end + strspn(end, " ");
    const char *letter = *unit ? strchr(letters, *unit | 0x20) : NULL;
    int power = letter ? (int)(letter - letters) + 1 : 0;
    const char *rest = letter ? unit + 1 : unit;
    bool binary = letter && (!*rest || !strcasecmp(rest, "ib"));
    if (end != text && isfinite(number) && number > 0 && (binary || !*rest || !strcasecmp(rest, "b"))) {
        *ret_bytes = number * pow(binary ? 1024 : 1000, power);
        return 0;
    }
    return status_fail(STATUS_CASE, "'%s' is no amount of memory; write '8 GiB', '500 MB' or a number of bytes", text);
}
