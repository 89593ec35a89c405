/* join.c - see join.h. Parts are verified, bit by bit, before anything is written. */
#include "io/join.h"

#include "base/mem.h"
#include "base/status.h"
#include "io/h5in.h"
#include "io/h5join.h"
#include "io/h5out.h"
#include "io/parts.h"
#include "io/place.h"
#include "io/resume.h"

#include <glob.h>
#include <string.h>
#include <sys/stat.h>

/* The seal of the one file, while it is put together. */
struct join {
    const struct resume *from; /* NULL: a snapshot */
    struct h5 *to;
    struct seal seal;
};

static const char *const join_without[] = {"/bulla/parts", "/parts", "/runs", NULL};

static void join_list(struct join *join, const char *path, uint64_t hash)
{
    uint64_t offset, length;
    h5out_place(join->to, path, &offset, &length);
    if (!join->to->code) seal_add(&join->seal, path, offset, length, hash);
}

static void join_told(void *context, const char *path, uint64_t hash)
{
    struct join *join = context;
    if (join->from) join_list(join, path, hash);
}

/* What the file itself has keeps its checksums. */
static void join_list_own(struct join *join)
{
    const struct seal *was = &join->from->seal;
    for (unsigned i = 0; i < was->n; i++) {
        char *name = mem_text_n(was->parts[i].name, SEAL_NAME);
        if (h5out_has(join->to, name)) join_list(join, name, was->parts[i].hash);
        mem_free(name);
    }
    join->seal.number = was->number;
}

static int join_draft(struct join *join, const char *path, const char *draft)
{
    struct h5 *from;
    TRY(h5_open(path, &from));
    int code = h5_create_behind(draft, join->from ? SEAL_BYTES : 0, &join->to);
    if (!code) {
        code = h5join_copy(from, join->to, join_without, join_told, join);
        if (!code && join->from) join_list_own(join);
        if (code) h5_abandon(join->to);
        else code = h5_close(join->to);
    }
    h5_abandon(from);
    if (!code && join->from) code = seal_close(draft, &join->seal);
    return code;
}

/* Puts one file in the place of a file and its parts. */
static int join_replace(const struct resume *resume, const char *path)
{
    struct join join = {.from = resume};
    char *draft = place_draft(path);
    int code = join_draft(&join, path, draft);
    mem_free(draft);
    if (code) place_reject(path);
    else code = place_accept(path);
    if (!code) parts_remove(path);
    return code;
}

/* How many parts a snapshot has, all of them whole. */
static int join_check_snapshot(const char *path, unsigned *ret_n)
{
    struct parts_list list = {0};
    struct seal seal;
    struct h5 *file;
    char *text = NULL;
    TRY(h5_open(path, &file));
    int code = h5in_has(file, "/bulla/parts") ? h5in_text(file, "/bulla/parts", &text) : STATUS_OK;
    h5_abandon(file);
    if (!code && text) code = parts_read(path, text, &list);
    for (unsigned i = 0; !code && i < list.n; i++) code = parts_check(path, &list, i, seal_check, &seal);
    *ret_n = list.n;
    parts_done(&list);
    mem_free(text);
    return code;
}

static int join_file(FILE *out, const char *path)
{
    struct resume *resume = NULL;
    unsigned n = 0;
    if (seal_is_piece(path)) return status_fail(STATUS_RUN, "%s: a part: name the file that it belongs to", path);
    if (seal_is(path)) TRY(resume_look(path, &resume));
    if (resume) n = resume->seal.kind == SEAL_HEAD ? resume->n_part : 0;
    int code = resume ? STATUS_OK : join_check_snapshot(path, &n);
    if (!code && n) code = join_replace(resume, path);
    resume_close(resume);
    if (!code && n) fprintf(out, "%s: one file of %u parts\n", path, n);
    else if (!code) fprintf(out, "%s: it has no parts\n", path);
    return code;
}

static int join_folder(FILE *out, const char *path)
{
    static const char *const patterns[] = {"fields/*.hdf", "checkpoints/*.chk", "*.hdf", "*.chk"};
    glob_t found;
    int code = STATUS_OK, flags = 0;
    for (size_t i = 0; i < sizeof patterns / sizeof *patterns; i++) {
        char *pattern = mem_print("%s/%s", path, patterns[i]);
        glob(pattern, flags, NULL, &found);
        flags = GLOB_APPEND;
        mem_free(pattern);
    }
    if (!found.gl_pathc)
        code = status_fail(STATUS_RUN, "%s: no snapshots (fields/*.hdf) and no checkpoints (checkpoints/*.chk)", path);
    for (size_t i = 0; !code && i < found.gl_pathc; i++) code = join_file(out, found.gl_pathv[i]);
    globfree(&found);
    return code;
}

int join_path(FILE *out, const char *path)
{
    struct stat info;
    bool is_folder = !stat(path, &info) && S_ISDIR(info.st_mode);
    return is_folder ? join_folder(out, path) : join_file(out, path);
}
