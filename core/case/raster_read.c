/* raster_read.c - the files of raster.h: PNG by libpng, and the header of NumPy's arrays (numpy.lib.format, version 1
 * to 3: a magic word, the length of a Python dictionary, the dictionary, the values). */
#include "case/raster.h"

#include "base/file.h"
#include "base/mem.h"
#include "base/status.h"

#include <errno.h>
#include <math.h>
#include <png.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* Images */

static int raster_read_make(const char *path, struct raster *raster)
{
    size_t count = 1;
    for (int d = 0; d < 3; d++) {
        if (raster->n[d] < 1 || raster->n[d] > RASTER_VALUES / count)
            return status_fail(STATUS_CASE, "%s has no values, or more than %d", path, RASTER_VALUES);
        count *= raster->n[d];
    }
    raster->value = mem_new(count, sizeof *raster->value);
    return STATUS_OK;
}

int raster_read_image(const char *path, struct raster *ret_raster)
{
    const char *why;
    FILE *file = file_open(path, &why);
    if (!file) return status_fail(STATUS_CASE, "%s cannot be read: %s", path, why);
    png_image image = {.version = PNG_IMAGE_VERSION};
    png_byte *grey = NULL;
    int code = png_image_begin_read_from_stdio(&image, file) ? STATUS_OK : STATUS_CASE;
    if (!code) {
        *ret_raster = (struct raster){.dim = 2, .n = {image.width, image.height, 1}};
        image.format = PNG_FORMAT_GRAY;
        code = raster_read_make(path, ret_raster);
    }
    if (!code) {
        grey = mem_new(ret_raster->n[0] * ret_raster->n[1], 1);
        const png_color white = {255, 255, 255};
        code = png_image_finish_read(&image, &white, grey, 0, NULL) ? STATUS_OK : STATUS_CASE;
    }
    for (size_t j = 0; !code && j < ret_raster->n[1]; j++) /* rows come from above */
        for (size_t i = 0; i < ret_raster->n[0]; i++)
            ret_raster->value[i * ret_raster->n[1] + j] =
                (float)grey[(ret_raster->n[1] - 1 - j) * ret_raster->n[0] + i] / 255.0f;
    if (code && PNG_IMAGE_FAILED(image)) status_fail(code, "%s is no image that can be read: %s", path, image.message);
    png_image_free(&image);
    mem_free(grey);
    fclose(file);
    return code;
}

/* Arrays */

enum { RASTER_HEADER = 4096 };

/* How a value stands in the file. */
struct raster_read_format {
    char kind; /* f, i, u, b */
    size_t bytes;
    bool swapped, fortran;
};

static bool raster_read_is_big_endian(void)
{
    const uint16_t one = 1;
    unsigned char first;
    memcpy(&first, &one, 1);
    return first == 0;
}

static const char *raster_read_entry(const char *header, const char *key)
{
    const char *at = strstr(header, key);
    at = at ? strchr(at + strlen(key), ':') : NULL;
    return at ? at + 1 + strspn(at + 1, " ") : "";
}

static bool raster_read_shape(const char *text, struct raster *raster)
{
    if (*text++ != '(') return false;
    for (raster->dim = 0; raster->dim < 3; raster->dim++) {
        text += strspn(text, " ,");
        if (*text == ')') break;
        char *end;
        raster->n[raster->dim] = strtoull(text, &end, 10);
        if (end == text) return false;
        text = end;
    }
    text += strspn(text, " ,");
    return *text == ')' && raster->dim > 0;
}

static int raster_read_header(const char *path, const char *header, struct raster *raster,
                              struct raster_read_format *format)
{
    const char *type = raster_read_entry(header, "'descr'");
    *raster = (struct raster){.n = {1, 1, 1}};
    bool known = *type == '\'' && strchr("<>|=", type[1]) && strchr("fiub", type[2]);
    format->kind = known ? type[2] : 0;
    format->bytes = known ? strtoull(type + 3, NULL, 10) : 0;
    format->swapped = known && (type[1] == '>') != raster_read_is_big_endian() && strchr("<>", type[1]);
    format->fortran = strncmp(raster_read_entry(header, "'fortran_order'"), "True", 4) == 0;
    bool good = format->kind == 'f' ? format->bytes == 4 || format->bytes == 8
                                    : format->bytes == 1 || format->bytes == 2 || format->bytes == 4;
    if (!known || !good)
        return status_fail(STATUS_CASE,
                           "%s holds values of a kind that is not read: %.16s (float32, float64, bool, "
                           "integers of 1, 2 or 4 bytes are)",
                           path, type);
    if (!raster_read_shape(raster_read_entry(header, "'shape'"), raster))
        return status_fail(STATUS_CASE, "%s is no array of one to three axes", path);
    return raster_read_make(path, raster);
}

static double raster_read_number(const unsigned char *bytes, const struct raster_read_format *format)
{
    unsigned char b[8] = {0};
    for (size_t i = 0; i < format->bytes; i++) b[i] = bytes[format->swapped ? format->bytes - 1 - i : i];
    uint64_t bits = 0; /* as a number, whatever the order of bytes here */
    for (size_t i = 0; i < format->bytes; i++)
        bits |= (uint64_t)b[raster_read_is_big_endian() ? format->bytes - 1 - i : i] << 8 * i;
    float single;
    double real;
    const uint32_t word = (uint32_t)bits;
    switch (format->kind) {
    case 'f':
        memcpy(&single, &word, sizeof single);
        memcpy(&real, &bits, sizeof real);
        return format->bytes == 4 ? (double)single : real;
    case 'i': return format->bytes == 1 ? (int8_t)word : format->bytes == 2 ? (int16_t)word : (int32_t)word;
    default: return (double)word;
    }
}

/* The place of a value in memory from its place in the file. */
static size_t raster_read_index(const struct raster *raster, const struct raster_read_format *format, size_t k)
{
    if (!format->fortran) return k;
    size_t i = k % raster->n[0], j = k / raster->n[0] % raster->n[1], l = k / (raster->n[0] * raster->n[1]);
    return (i * raster->n[1] + j) * raster->n[2] + l;
}

static int raster_read_values(const char *path, FILE *file, const struct raster_read_format *format,
                              struct raster *raster)
{
    size_t count = raster->n[0] * raster->n[1] * raster->n[2];
    for (size_t k = 0; k < count; k++) {
        unsigned char bytes[8];
        if (fread(bytes, 1, format->bytes, file) != format->bytes)
            return status_fail(STATUS_CASE, "%s ends after %zu of %zu values", path, k, count);
        double value = raster_read_number(bytes, format);
        if (!isfinite(value)) return status_fail(STATUS_CASE, "%s: value %zu is not finite", path, k);
        raster->value[raster_read_index(raster, format, k)] = (float)value;
    }
    return STATUS_OK;
}

static int raster_read_file(const char *path, FILE *file, struct raster *raster)
{
    unsigned char head[12];
    char header[RASTER_HEADER + 1] = {0};
    if (fread(head, 1, 10, file) != 10 || memcmp(head, "\x93NUMPY", 6) != 0)
        return status_fail(STATUS_CASE, "%s is no file of NumPy (numpy.save)", path);
    size_t length = head[8] | (size_t)head[9] << 8;
    if (head[6] > 1 && fread(head + 10, 1, 2, file) == 2) length |= (size_t)head[10] << 16 | (size_t)head[11] << 24;
    if (length > RASTER_HEADER || fread(header, 1, length, file) != length)
        return status_fail(STATUS_CASE, "%s has a broken header", path);
    struct raster_read_format format;
    TRY(raster_read_header(path, header, raster, &format));
    return raster_read_values(path, file, &format, raster);
}

int raster_read_array(const char *path, struct raster *ret_raster)
{
    const char *why;
    FILE *file = file_open(path, &why);
    if (!file) return status_fail(STATUS_CASE, "%s cannot be read: %s", path, why);
    int code = raster_read_file(path, file, ret_raster);
    fclose(file);
    return code;
}
