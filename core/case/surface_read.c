/* surface_read.c - STL files, see surface.h: text (`solid NAME`, `facet normal`, `vertex x y z`) or binary (80 bytes, a
 * count, 50 bytes a triangle, little-endian). Binary files may begin with "solid", too: their length tells them.
 * Normals of the file are not read: the order of the corners says the same, and is right more often. */
#include "case/surface.h"

#include "base/file.h"
#include "base/mem.h"
#include "base/slots.h"
#include "base/status.h"

#include <errno.h>
#include <math.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { SURFACE_HEAD = 84, SURFACE_FACET = 50, SURFACE_LINE = 512 };

/* Corners as they come, three a triangle. */
struct surface_read_soup {
    size_t n, room;
    double (*corner)[3];
};

static void surface_read_soup_add(struct surface_read_soup *soup, const double x[3])
{
    if (soup->n == soup->room) {
        size_t room = soup->room ? 2 * soup->room : 3 * 1024;
        soup->corner = mem_grow(soup->corner, soup->room, room, sizeof *soup->corner);
        soup->room = room;
    }
    memcpy(soup->corner[soup->n++], x, sizeof *soup->corner);
}

static uint32_t surface_read_word(const unsigned char *bytes)
{
    return bytes[0] | (uint32_t)bytes[1] << 8 | (uint32_t)bytes[2] << 16 | (uint32_t)bytes[3] << 24;
}

static double surface_read_float(const unsigned char *bytes)
{
    uint32_t word = surface_read_word(bytes);
    float value;
    memcpy(&value, &word, sizeof value);
    return (double)value;
}

static int surface_read_binary(const char *path, FILE *file, size_t n, struct surface_read_soup *soup)
{
    unsigned char facet[SURFACE_FACET];
    for (size_t i = 0; i < n; i++) {
        if (fread(facet, 1, sizeof facet, file) != sizeof facet)
            return status_fail(STATUS_CASE, "%s ends within triangle %zu of %zu", path, i + 1, n);
        for (size_t k = 0; k < 3; k++) {
            double x[3];
            for (size_t d = 0; d < 3; d++) x[d] = surface_read_float(facet + 12 + 12 * k + 4 * d);
            if (!isfinite(x[0]) || !isfinite(x[1]) || !isfinite(x[2]))
                return status_fail(STATUS_CASE, "%s: triangle %zu has a corner that is no number", path, i + 1);
            surface_read_soup_add(soup, x);
        }
    }
    return STATUS_OK;
}

static const char *surface_read_word_after(const char *line, const char *word)
{
    size_t length = strlen(word);
    line += strspn(line, " \t");
    return strncmp(line, word, length) == 0 ? line + length : NULL;
}

/* Three numbers and nothing else. */
static bool surface_read_point(const char *text, double ret_x[3])
{
    for (int d = 0; d < 3; d++) {
        char *end;
        ret_x[d] = strtod(text, &end);
        if (end == text || !isfinite(ret_x[d])) return false;
        text = end;
    }
    return text[strspn(text, " \t\r\n")] == '\0';
}

static int surface_read_text(const char *path, FILE *file, struct surface_read_soup *soup)
{
    char line[SURFACE_LINE];
    for (size_t number = 1; fgets(line, sizeof line, file); number++) {
        const char *rest = surface_read_word_after(line, "vertex");
        double x[3];
        if (rest && !surface_read_point(rest, x))
            return status_fail(STATUS_CASE, "%s:%zu: three numbers are needed after 'vertex'", path, number);
        if (rest) surface_read_soup_add(soup, x);
        if (!surface_read_word_after(line, "endloop") || soup->n % 3 == 0) continue;
        return status_fail(STATUS_CASE, "%s:%zu: a loop ends that has not three corners", path, number);
    }
    return soup->n % 3 ? status_fail(STATUS_CASE, "%s ends within a triangle", path) : STATUS_OK;
}

static int surface_read_file(const char *path, FILE *file, struct surface_read_soup *soup)
{
    unsigned char head[SURFACE_HEAD];
    size_t got = fread(head, 1, sizeof head, file), n = got == sizeof head ? surface_read_word(head + 80) : 0;
    long size = fseek(file, 0, SEEK_END) == 0 ? ftell(file) : -1;
    bool binary = got == sizeof head && size == (long)(SURFACE_HEAD + SURFACE_FACET * n);
    bool text = got > 5 && memcmp(head, "solid", 5) == 0;
    if (size < 0 || fseek(file, binary ? SURFACE_HEAD : 0, SEEK_SET) != 0)
        return status_fail(STATUS_CASE, "%s cannot be read: %s", path, strerror(errno));
    if (!binary && !text)
        return status_fail(STATUS_CASE,
                           "%s is no STL file: it neither begins with 'solid' nor has the %zu bytes that "
                           "%zu triangles take",
                           path, SURFACE_HEAD + SURFACE_FACET * n, n);
    if (binary && n > SURFACE_TRIANGLES)
        return status_fail(STATUS_CASE, "%s has %zu triangles; %d are allowed", path, n, SURFACE_TRIANGLES);
    return binary ? surface_read_binary(path, file, n, soup) : surface_read_text(path, file, soup);
}

static bool surface_read_same_point(const void *list, unsigned index, const void *key)
{
    const double *a = ((const double(*)[3])list)[index], *b = key;
    return a[0] == b[0] && a[1] == b[1] && a[2] == b[2];
}

/* One vertex for all equal corners; triangles that then have less than three are left out. */
static void surface_read_join(struct surface *surface, const struct surface_read_soup *soup)
{
    struct slots slots = {0};
    slots_start(&slots, soup->n);
    surface->vertex = mem_new(soup->n + 1, sizeof *surface->vertex);
    surface->corner = mem_new(soup->n / 3 + 1, sizeof *surface->corner);
    for (size_t i = 0; i < soup->n; i++) {
        uint64_t hash = 0;
        double x[3];
        for (int d = 0; d < 3; d++) {
            x[d] = soup->corner[i][d] + 0.0; /* -0 is 0 */
            uint64_t word;
            memcpy(&word, x + d, sizeof word);
            hash = slots_hash(hash, word);
        }
        unsigned *slot = slots_find(&slots, hash, surface_read_same_point, surface->vertex, x);
        if (!*slot) {
            memcpy(surface->vertex[surface->n_vertex++], x, sizeof x);
            *slot = (unsigned)surface->n_vertex;
        }
        size_t *corner = surface->corner[surface->n];
        corner[i % 3] = *slot - 1;
        bool flat = corner[0] == corner[1] || corner[1] == corner[2] || corner[2] == corner[0];
        if (i % 3 == 2 && !flat) surface->n++;
    }
    slots_done(&slots);
}

int surface_read(const char *path, struct surface *ret_surface)
{
    const char *why;
    FILE *file = file_open(path, &why);
    if (!file) return status_fail(STATUS_CASE, "%s cannot be read: %s", path, why);
    struct surface_read_soup soup = {0};
    int code = surface_read_file(path, file, &soup);
    fclose(file);
    if (!code) surface_read_join(ret_surface, &soup);
    mem_free(soup.corner);
    if (code) return code;
    if (!ret_surface->n)
        return status_fail(STATUS_CASE, "%s has no triangle; if it is a binary file, it is cut short", path);
    if (surface_check(ret_surface)) return status_wrap(STATUS_CASE, "%s: ", path);
    if (surface_volume(ret_surface) < 0.0)
        for (size_t i = 0; i < ret_surface->n; i++) {
            size_t *corner = ret_surface->corner[i], last = corner[2];
            corner[2] = corner[1];
            corner[1] = last;
        }
    return STATUS_OK;
}
