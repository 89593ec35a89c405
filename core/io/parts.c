/* parts.c - see parts.h. */
#include "io/parts.h"

#include "base/comm.h"
#include "base/mem.h"
#include "base/status.h"
#include "base/text.h"
#include "io/h5out.h"
#include "io/held.h"
#include "io/place.h"
#include "io/room.h"
#include "io/writers.h"

#include <ctype.h>
#include <dirent.h>
#include <errno.h>
#include <inttypes.h>
#include <stdio.h>
#include <string.h>
#include <unistd.h>

enum { PARTS_NUMBERS = 2 }; /* what a writer says of its part: bytes, seal */

struct parts {
    int n;
    char *path;
    char *stem, *own;               /* NAME.a; the part of this rank's writer. NULL with one writer */
    struct held *draft, *own_draft; /* where they are written; NULL on ranks that do not */
};

/* The last element of a path. */
static const char *parts_base(const char *path)
{
    const char *slash = strrchr(path, '/');
    return slash ? slash + 1 : path;
}

/* The first letter that no part of this file has: a file that is being replaced keeps its own. Rank 0. */
static char parts_letter(const char *path)
{
    for (char letter = 'a'; letter < 'z'; letter++) {
        char *first = mem_print("%s.%c1", path, letter);
        bool taken = access(first, F_OK) == 0;
        mem_free(first);
        if (!taken) return letter;
    }
    return 'z';
}

/* Where the draft of a file is written. */
static struct held *parts_draft(const char *path, bool in_memory)
{
    char *draft = place_draft(path);
    struct held *held = held_new(draft, in_memory);
    mem_free(draft);
    return held;
}

struct parts *parts_new(const char *path, int n, bool in_memory)
{
    struct parts *parts = mem_new(1, sizeof *parts);
    char letter = 'a';
    parts->n = n;
    parts->path = mem_text(path);
    if (comm_rank() == 0) parts->draft = parts_draft(path, in_memory);
    if (n == 1) return parts;
    if (comm_rank() == 0) letter = parts_letter(path);
    comm_bcast(&letter, 1);
    parts->stem = mem_print("%s.%c", path, letter);
    parts->own = mem_print("%s%d", parts->stem, writers_of(n, comm_rank()) + 1);
    if (writers_here(n)) parts->own_draft = parts_draft(parts->own, in_memory);
    return parts;
}

void parts_free(struct parts *parts)
{
    if (!parts) return;
    held_free(parts->own_draft);
    held_free(parts->draft);
    mem_free(parts->own);
    mem_free(parts->stem);
    mem_free(parts->path);
    mem_free(parts);
}

int parts_create(const struct parts *parts, size_t head, struct h5 **ret_file)
{
    const char *own = parts->own_draft ? held_path(parts->own_draft) : parts->own;
    const struct h5_parts made = {parts->n, parts->stem ? parts_base(parts->stem) : NULL, own, SEAL_BYTES};
    return h5_create_parts(parts->draft ? held_path(parts->draft) : parts->path, head, &made, ret_file);
}

int parts_store(const struct parts *parts)
{
    if (parts->own_draft) TRY(held_store(parts->own_draft));
    return parts->draft ? held_store(parts->draft) : STATUS_OK;
}

/* Does this rank write a part? */
static bool parts_here(const struct parts *parts)
{
    return parts->own && writers_here(parts->n);
}

/* The list, on rank 0; the same on all ranks, but there is no need. */
static void parts_list(const struct parts *parts, const struct seal *seal, struct text *ret_list)
{
    uint64_t own[PARTS_NUMBERS] = {seal->bytes, seal->hash};
    unsigned count;
    uint64_t *all = comm_join_keys(own, parts_here(parts) ? PARTS_NUMBERS : 0, &count);
    for (int i = 0; i < parts->n; i++)
        text_add(ret_list, "%s%d %" PRIu64 " %016" PRIx64 "\n", parts_base(parts->stem), i + 1, all[PARTS_NUMBERS * i],
                 all[PARTS_NUMBERS * i + 1]);
    mem_free(all);
}

int parts_seal(const struct parts *parts, struct h5 *file, const char *where, int (*seals)(const char *, struct seal *),
               struct seal *seal, uint64_t *ret_hash)
{
    struct text list = {0};
    if (parts->n == 1) return STATUS_OK;
    TRY(h5_close_part(file));
    seal->kind = SEAL_PIECE;
    TRY(comm_agree(parts_here(parts) ? seals(file->part->path, seal) : STATUS_OK));
    parts_list(parts, seal, &list);
    h5out_text(file, where, list.at);
    if (ret_hash) *ret_hash = seal_hash(list.at, list.length);
    text_done(&list);
    return STATUS_OK;
}

static int parts_rename(const struct parts *parts)
{
    char *draft = place_draft(parts->own);
    int code = rename(draft, parts->own) ? room_fail(parts->own, "rename to it") : STATUS_OK;
    mem_free(draft);
    return code;
}

/* Part files are lasting; their names become so with that of the file. */
int parts_accept(const struct parts *parts)
{
    if (parts->n == 1) return STATUS_OK;
    return comm_agree(parts_here(parts) ? parts_rename(parts) : STATUS_OK);
}

void parts_reject(const struct parts *parts)
{
    if (!parts_here(parts)) return;
    char *draft = place_draft(parts->own);
    int kept = truncate(draft, 0); /* as in place_reject */
    (void)kept;
    remove(draft);
    if (access(parts->path, F_OK)) remove(parts->own); /* a file that is there may be the one that has this part */
    mem_free(draft);
}

/* The length of a name without what makes it a part: NAME.a12. 0: it is none. */
static size_t parts_length(const char *name)
{
    size_t end = strlen(name), at = end;
    while (at > 0 && isdigit((unsigned char)name[at - 1])) at--;
    bool is =
        at < end && name[at] != '0' && at > 2 && name[at - 1] >= 'a' && name[at - 1] <= 'z' && name[at - 2] == '.';
    return is ? at - 2 : 0;
}

bool parts_is(const char *name)
{
    static const char *const kinds[] = {".hdf", ".chk"};
    size_t length = parts_length(name);
    for (int i = 0; i < 2; i++)
        if (length > 4 && !strncmp(name + length - 4, kinds[i], 4)) return true;
    return false;
}

/* Removes the parts of a file but for those with this stem (NULL: none). */
static void parts_remove_but(const char *path, const char *stem)
{
    const char *base = parts_base(path);
    size_t length = strlen(base);
    char *folder = base == path ? mem_text(".") : mem_text_n(path, (size_t)(base - path));
    DIR *stream = opendir(folder);
    for (struct dirent *entry; stream && (entry = readdir(stream));) {
        if (parts_length(entry->d_name) != length || strncmp(entry->d_name, base, length)) continue;
        if (stem && !strncmp(entry->d_name, parts_base(stem), length + 2)) continue;
        char *part = mem_print("%s/%s", folder, entry->d_name);
        remove(part);
        mem_free(part);
    }
    if (stream) closedir(stream);
    mem_free(folder);
}

void parts_clean(const struct parts *parts)
{
    if (comm_rank() == 0 && parts_letter(parts->path) != 'a') parts_remove_but(parts->path, parts->stem);
}

void parts_remove(const char *path)
{
    parts_remove_but(path, NULL);
}

int parts_read(const char *path, const char *text, struct parts_list *ret_list)
{
    struct parts_list list = {0};
    const char *base = parts_base(path);
    int code = STATUS_OK;
    for (int length = 0; !code && *text; text += length) {
        struct parts_entry part = {0};
        char *name = mem_text_n(text, strcspn(text, " \n"));
        int got = sscanf(text, "%*s %" SCNu64 " %" SCNx64 "%n", &part.bytes, &part.hash, &length);
        if (got != 2 || text[length++] != '\n' || !parts_length(name) || strchr(name, '/'))
            code = status_fail(STATUS_RUN, "%s: its list of parts is impossible", path);
        part.path = mem_print("%.*s%s", (int)(base - path), path, name);
        list.at = mem_grow(list.at, list.n, list.n + 1u, sizeof *list.at);
        list.at[list.n++] = part;
        mem_free(name);
    }
    if (code) parts_done(&list);
    else *ret_list = list;
    return code;
}

void parts_done(struct parts_list *list)
{
    for (unsigned i = 0; i < list->n; i++) mem_free(list->at[i].path);
    mem_free(list->at);
    *list = (struct parts_list){0};
}

int parts_check(const char *path, const struct parts_list *list, unsigned i, int (*looks)(const char *, struct seal *),
                struct seal *ret_seal)
{
    const struct parts_entry *part = &list->at[i];
    if (access(part->path, F_OK) && errno == ENOENT)
        return status_fail(STATUS_RUN, "%s: part %u of %u is lost: there is no %s beside it", path, i + 1, list->n,
                           parts_base(part->path));
    if (looks(part->path, ret_seal)) return status_wrap(STATUS_RUN, "%s: part %u of %u: ", path, i + 1, list->n);
    if (ret_seal->hash != part->hash || ret_seal->bytes != part->bytes)
        return status_fail(STATUS_RUN, "%s: part %u of %u is not its own: %s is whole, but of another run or moment",
                           path, i + 1, list->n, parts_base(part->path));
    return STATUS_OK;
}
