/* loader.c - see loader.h.
 *
 * Order of work: read the file whole (for the hash and elf_flaw), dlopen with RTLD_NOW so that a
 * missing symbol is refused now and not in mid-run, then compare the floating-point state: an
 * object linked with fast-math options switches the whole process to flush-to-zero while it loads. */
#include "plug/loader.h"

#include "base/mem.h"
#include "base/status.h"
#include "base/system.h"
#include "plug/elf.h"
#include "plug/probe.h"
#include "plug/vet.h"

#include <dlfcn.h>
#include <errno.h>
#include <fcntl.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>
#include <xxhash.h>

enum { LOADER_BYTES = 256 << 20 }; /* largest file that is looked at */

#ifdef __SSE2__
#include <xmmintrin.h>
enum { LOADER_FLAGS = 0x3f }; /* exceptions seen so far: no part of the mode */

static unsigned loader_fp_mode(void)
{
    return _mm_getcsr() & ~(unsigned)LOADER_FLAGS;
}

static void loader_fp_restore(unsigned mode)
{
    _mm_setcsr(mode);
}
#else
#include <fenv.h>

static unsigned loader_fp_mode(void)
{
    return (unsigned)fegetround();
}

static void loader_fp_restore(unsigned mode)
{
    fesetround((int)mode);
}
#endif

static int loader_read(int file, const char *path, char **ret_bytes, size_t *ret_size)
{
    struct stat about;
    if (fstat(file, &about) != 0) return status_fail(STATUS_CASE, "%s cannot be read: %s", path, strerror(errno));
    if (!S_ISREG(about.st_mode)) return status_fail(STATUS_CASE, "%s is not a file", path);
    if (about.st_size > LOADER_BYTES)
        return status_fail(STATUS_CASE, "%s is larger than %d bytes: no module", path, LOADER_BYTES);
    size_t size = (size_t)about.st_size, done = 0;
    char *bytes = mem_new(size, 1);
    while (done < size) {
        ssize_t got = read(file, bytes + done, size - done);
        if (got < 0 && errno == EINTR) continue;
        if (got <= 0) break;
        done += (size_t)got;
    }
    *ret_bytes = bytes;
    *ret_size = done;
    return STATUS_OK;
}

/* Hash, and a first look before the system's loader sees the file. */
static int loader_inspect(const char *path, uint64_t *ret_hash)
{
    int file = open(path, O_RDONLY | O_CLOEXEC | O_NONBLOCK);
    if (file < 0) return status_fail(STATUS_CASE, "%s cannot be read: %s", path, strerror(errno));
    char *bytes = NULL;
    size_t size = 0;
    int code = loader_read(file, path, &bytes, &size);
    close(file);
    if (code) return code;
    const char *flaw = elf_flaw(bytes, size);
    *ret_hash = XXH64(bytes, size, 0);
    mem_free(bytes);
    return flaw ? status_fail(STATUS_CASE, "%s %s", path, flaw) : STATUS_OK;
}

static int loader_map(const char *path, void **ret_handle)
{
    unsigned mode = loader_fp_mode();
    void *handle = dlopen(path, RTLD_NOW | RTLD_LOCAL);
    if (!handle) status_fail(STATUS_CASE, "%s cannot be loaded: %s", path, dlerror());
    if (loader_fp_mode() == mode) {
        *ret_handle = handle;
        return handle ? STATUS_OK : STATUS_CASE;
    }
    if (handle) dlclose(handle);
    loader_fp_restore(mode);
    return status_fail(STATUS_CASE,
                       "%s changes the floating-point mode (flush to zero?): link it without fast-math options", path);
}

/* The descriptor, and how many bytes the object file gives it (0: unknown). */
static const struct bulla_module *loader_symbol(void *handle, size_t *ret_space)
{
    const void *symbol = dlsym(handle, "bulla_module");
    *ret_space = system_symbol_size(symbol);
    return symbol;
}

int loader_open(const char *path, bool known, struct loader_object *ret_object)
{
    struct loader_object object = {0};
    char *real = realpath(path, NULL);
    if (!real) return status_fail(STATUS_CASE, "%s cannot be read: %s", path, strerror(errno));
    object.path = mem_text(real);
    free(real);
    int code = loader_inspect(object.path, &object.hash);
    if (!code && !known) code = probe_object(object.path);
    if (!code) code = loader_map(object.path, &object.handle);
    if (!code) {
        size_t space;
        object.module = loader_symbol(object.handle, &space);
        code = object.module ? vet_module(object.module, space)
                             : status_fail(STATUS_CASE, "is no module: it has no symbol bulla_module");
        if (code) status_wrap(code, "%s ", object.path);
    }
    if (code) {
        loader_close(&object);
        return code;
    }
    *ret_object = object;
    return STATUS_OK;
}

void loader_close(struct loader_object *object)
{
    if (object->handle) dlclose(object->handle);
    mem_free(object->path);
    *object = (struct loader_object){0};
}
