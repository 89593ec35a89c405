/* mem.c - see mem.h. malloc is called in this file only. */
#include "base/mem.h"

#include "base/abort.h"
#include "base/status.h"

#include <math.h>
#include <stdarg.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/mman.h>
#include <sys/resource.h>
#include <unistd.h>

enum { MEM_ALIGN = 64, MEM_LARGE = 2 << 20 };

static void mem_give_up(size_t count, size_t size)
{
    fprintf(stderr, "bulla: error: out of memory: could not get %zu x %zu bytes\n", count, size);
    abort_all(STATUS_RUN);
}

static void *mem_new_aligned(size_t count, size_t size, size_t align)
{
    if (size && count > (SIZE_MAX - align) / size) mem_give_up(count, size);
    size_t bytes = (count * size / align + 1) * align;
    void *block = aligned_alloc(align, bytes);
    if (!block) mem_give_up(count, size);
    if (align > MEM_ALIGN) madvise(block, bytes, MADV_HUGEPAGE); /* a wish: refusal does no harm */
    memset(block, 0, bytes);
    return block;
}

void *mem_new(size_t count, size_t size)
{
    return mem_new_aligned(count, size, MEM_ALIGN);
}

void *mem_new_large(size_t count, size_t size)
{
    return mem_new_aligned(count, size, size && count < MEM_LARGE / size ? MEM_ALIGN : MEM_LARGE);
}

void *mem_grow(void *block, size_t old_count, size_t new_count, size_t size)
{
    void *larger = mem_new(new_count, size);
    if (block) memcpy(larger, block, (old_count < new_count ? old_count : new_count) * size);
    free(block);
    return larger;
}

void *mem_try(void *block, size_t bytes)
{
    if (bytes) return realloc(block, bytes);
    free(block);
    return NULL;
}

char *mem_text(const char *text)
{
    return text ? mem_text_n(text, strlen(text)) : NULL;
}

char *mem_text_n(const char *text, size_t length)
{
    char *copy = mem_new(length + 1, 1);
    memcpy(copy, text, length);
    return copy;
}

char *mem_print(const char *format, ...)
{
    va_list args, again;
    va_start(args, format);
    va_copy(again, args);
    int length = vsnprintf(NULL, 0, format, args);
    va_end(args);
    char *text = mem_new((size_t)length + 1, 1);
    vsnprintf(text, (size_t)length + 1, format, again);
    va_end(again);
    return text;
}

void mem_free(void *block)
{
    free(block);
}

double mem_peak(void)
{
    struct rusage usage;
    getrusage(RUSAGE_SELF, &usage);
    return 1024.0 * (double)usage.ru_maxrss;
}

/* A limit that the system writes as a number into a file; HUGE_VAL where there is none. */
static double mem_limit_in(const char *path)
{
    double bytes = HUGE_VAL;
    FILE *file = fopen(path, "r");
    if (file && (fscanf(file, "%lf", &bytes) != 1 || bytes <= 0)) bytes = HUGE_VAL; /* "max": none */
    if (file) fclose(file);
    return bytes;
}

double mem_machine(void)
{
    static const char *const groups[] = {"/sys/fs/cgroup/memory.max", "/sys/fs/cgroup/memory/memory.limit_in_bytes"};
    double bytes = (double)sysconf(_SC_PHYS_PAGES) * (double)sysconf(_SC_PAGESIZE);
    for (int i = 0; i < 2; i++) {
        double limit = mem_limit_in(groups[i]);
        if (limit < bytes) bytes = limit;
    }
    return bytes;
}

double mem_allowed(void)
{
    struct rlimit limit;
    return getrlimit(RLIMIT_AS, &limit) || limit.rlim_cur == RLIM_INFINITY ? HUGE_VAL : (double)limit.rlim_cur;
}
