/* outdir.c - see outdir.h. */
#include "run/outdir.h"

#include "base/comm.h"
#include "base/mem.h"
#include "base/status.h"
#include "base/text.h"
#include "io/parts.h"
#include "io/place.h"

#include <dirent.h>
#include <errno.h>
#include <fcntl.h>
#include <stdio.h>
#include <string.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

/* What a run writes; folders only with files that end in one of ours. */
static const char *const outdir_files[] = {"case.yaml",   "provenance.json", "history.csv", "probes.csv",
                                           "columns.csv", "expect.json",     "log.txt"};
static const char *const outdir_folders[] = {"fields", "checkpoints", "maps"};
static const char *const outdir_endings[] = {".hdf", ".hdf.series", ".chk", ".tmp"};
enum { FILES = 7, FOLDERS = 3, ENDINGS = 4 };

static bool outdir_is_ours(const char *name)
{
    size_t length = strlen(name);
    for (int i = 0; i < ENDINGS; i++) {
        size_t tail = strlen(outdir_endings[i]);
        if (length > tail && !strcmp(name + length - tail, outdir_endings[i])) return true;
    }
    return parts_is(name);
}

/* Of maps: tables too, which elsewhere are somebody's own. */
static bool outdir_is_map(const char *name)
{
    size_t length = strlen(name);
    return outdir_is_ours(name) || (length > 4 && !strcmp(name + length - 4, ".csv"));
}

static bool (*const outdir_meant[])(const char *name) = {outdir_is_ours, outdir_is_ours, outdir_is_map};

static bool outdir_is_draft(const char *name)
{
    size_t length = strlen(name);
    return length > 4 && !strcmp(name + length - 4, ".tmp");
}

/* Counts the files in a folder that `is_meant` names; removes them if asked. -1: cannot remove (errno). */
static int outdir_sweep(const char *folder, bool (*is_meant)(const char *name), bool remove_them)
{
    DIR *stream = opendir(folder);
    if (!stream) return 0;
    int count = 0;
    for (struct dirent *entry; count >= 0 && (entry = readdir(stream));) {
        if (!is_meant(entry->d_name)) continue;
        char *path = mem_print("%s/%s", folder, entry->d_name);
        count = remove_them && unlink(path) ? -1 : count + 1;
        mem_free(path);
    }
    int kept = errno;
    closedir(stream);
    errno = kept;
    return count;
}

static void outdir_list(const char *path, struct text *found)
{
    struct stat info;
    for (int i = 0; i < FILES; i++) {
        char *name = mem_print("%s/%s", path, outdir_files[i]);
        if (!stat(name, &info)) text_add(found, "%s%s", found->length ? ", " : "", outdir_files[i]);
        mem_free(name);
    }
    for (int i = 0; i < FOLDERS; i++) {
        char *name = mem_print("%s/%s", path, outdir_folders[i]);
        int count = outdir_sweep(name, outdir_meant[i], false);
        if (count > 0)
            text_add(found, "%s%s/ (%d file%s)", found->length ? ", " : "", outdir_folders[i], count,
                     count == 1 ? "" : "s");
        mem_free(name);
    }
}

/* case.yaml, the first file, goes last and provenance.json first: if this is cut short, what remains neither looks
 * finished nor like another case. */
static int outdir_clear(const char *path)
{
    int code = 0;
    for (int k = 1; k <= FILES + FOLDERS && !code; k++) {
        int i = k % (FILES + FOLDERS);
        bool is_file = i < FILES;
        char *name = mem_print("%s/%s", path, is_file ? outdir_files[i] : outdir_folders[i - FILES]);
        if (is_file ? unlink(name) && errno != ENOENT && errno != ENOTDIR
                    : outdir_sweep(name, outdir_meant[i - FILES], true) < 0)
            code = status_fail(STATUS_RUN, "cannot remove %s: %s", name, strerror(errno));
        mem_free(name);
    }
    return code;
}

static int outdir_make(const char *path)
{
    char *part = mem_text(path);
    int code = 0;
    for (char *at = part + 1; !code; at++) {
        if (*at && *at != '/') continue;
        char here = *at;
        *at = '\0';
        if (mkdir(part, 0777) && errno != EEXIST)
            code = status_fail(STATUS_RUN, "cannot make the output directory %s: %s", part, strerror(errno));
        *at = here;
        if (!here) break;
    }
    mem_free(part);
    return code;
}

static int outdir_check_here(const char *path, bool overwrite)
{
    struct stat info;
    if (!stat(path, &info) && !S_ISDIR(info.st_mode))
        return status_fail(STATUS_CASE, "the output directory %s is a file", path);
    if (overwrite) return 0;
    struct text found = {0};
    int code = 0;
    outdir_list(path, &found);
    if (found.length)
        code = status_fail(STATUS_CASE, "%s holds a run: %s; --overwrite replaces it, -o DIR writes elsewhere", path,
                           found.at);
    text_done(&found);
    return code;
}

int outdir_check(const char *path, bool overwrite)
{
    return comm_agree(comm_rank() == 0 ? outdir_check_here(path, overwrite) : 0);
}

/* A run has its directory to itself until its process ends, however it ends. File systems that know no such locks are
 * taken on trust. */
static int outdir_lock(const char *path)
{
    static int held = -1;
    if (held >= 0) close(held);
    held = open(path, O_RDONLY | O_DIRECTORY | O_CLOEXEC);
    if (held < 0 || !flock(held, LOCK_EX | LOCK_NB) || errno != EWOULDBLOCK) return STATUS_OK;
    return status_fail(STATUS_CASE, "another run is at work in %s; -o DIR writes elsewhere", path);
}

int outdir_claim(const char *path)
{
    return comm_agree(comm_rank() == 0 ? outdir_lock(path) : 0);
}

static int outdir_prepare_here(const char *path)
{
    TRY(outdir_make(path));
    TRY(outdir_lock(path));
    return outdir_clear(path);
}

int outdir_prepare(const char *path)
{
    return comm_agree(comm_rank() == 0 ? outdir_prepare_here(path) : 0);
}

static int outdir_go_on_here(const char *path)
{
    int code = outdir_lock(path);
    for (int i = 0; i < FOLDERS && !code; i++) {
        char *name = mem_print("%s/%s", path, outdir_folders[i]);
        if (outdir_sweep(name, outdir_is_draft, true) < 0)
            code = status_fail(STATUS_RUN, "cannot remove the drafts in %s: %s", name, strerror(errno));
        mem_free(name);
    }
    return code;
}

int outdir_go_on(const char *path)
{
    return comm_agree(comm_rank() == 0 ? outdir_go_on_here(path) : 0);
}

bool outdir_holds(const char *path, const char *name, const char *file)
{
    const char *slash = strrchr(file, '/');
    char *place = slash ? mem_text_n(file, (size_t)(slash - file + 1)) : mem_text(".");
    char *folder = mem_print("%s/%s", path, name);
    struct stat a, b;
    bool same = !stat(place, &a) && !stat(folder, &b) && a.st_dev == b.st_dev && a.st_ino == b.st_ino;
    mem_free(folder);
    mem_free(place);
    return same;
}

int outdir_write(const char *directory, const char *name, const char *text)
{
    char *path = mem_print("%s/%s", directory, name);
    int code = place_text(path, text);
    mem_free(path);
    return code;
}
