/* fuzz.h - what the fuzz targets share: one entry, and a scratch folder for readers that want a file.
 *
 * A target is a C file with FUZZ(data, size). With clang's libFuzzer (preset `fuzz`) it hunts; with any compiler
 * it is linked to replay.c and tries its corpus and a fixed set of changes to it in the test suite. */
#ifndef FUZZ_H
#define FUZZ_H

#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#define FUZZ(data, size)                                          \
    int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size); \
    int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)

static char fuzz_folder[64];

static void fuzz_leave(void)
{
    char command[128];
    if (chdir("/")) return;
    snprintf(command, sizeof command, "rm -rf '%s'", fuzz_folder);
    if (system(command)) perror(command);
}

/* Makes the scratch folder and goes there, once; in memory, where the system has such a place. */
static inline void fuzz_start(void)
{
    if (*fuzz_folder) return;
    snprintf(fuzz_folder, sizeof fuzz_folder, "%s/bulla-fuzz-XXXXXX", access("/dev/shm", W_OK) ? "/tmp" : "/dev/shm");
    setenv("BULLA_MODULE_PATH", FUZZ_MODULES, 0);
    if (!mkdtemp(fuzz_folder) || chdir(fuzz_folder)) abort();
    atexit(fuzz_leave);
}

static inline void fuzz_write(const char *name, const void *data, size_t size)
{
    FILE *file = fopen(name, "wb");
    if (!file || fwrite(data, 1, size, file) != size || fclose(file)) abort();
}

/* Where what the program says goes. */
static inline FILE *fuzz_nowhere(void)
{
    static FILE *nowhere;
    if (!nowhere) nowhere = fopen("/dev/null", "w");
    if (!nowhere) abort();
    return nowhere;
}

/* The input as a text; release with free. */
static inline char *fuzz_text(const uint8_t *data, size_t size)
{
    char *text = malloc(size + 1);
    if (!text) abort();
    memcpy(text, data, size);
    text[size] = '\0';
    return text;
}

#endif
