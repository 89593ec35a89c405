/* resume_runs.c - see resume_runs.h. */
#include "io/resume_runs.h"

#include "base/comm.h"
#include "base/mem.h"
#include "base/status.h"
#include "base/swap.h"
#include "mesh/partition.h"

#include <string.h>

const struct resume_run *resume_runs_find(const struct resume *resume, size_t tile)
{
    size_t low = 0, high = resume->n_run;
    while (high - low > 1) {
        size_t middle = low + (high - low) / 2;
        if (resume->runs[middle].first <= tile) low = middle;
        else high = middle;
    }
    return &resume->runs[low];
}

/* The runs that the tiles `from` to `end` - 1 are in, from `next` on; returns what is behind them. */
static const struct resume_run *resume_runs_pick(const struct resume *resume, size_t from, size_t end, int to,
                                                 const struct resume_run *next, struct swap_list *mail)
{
    if (from == end) return next;
    const struct resume_run *run = resume_runs_find(resume, from), *behind = resume->runs + resume->n_run;
    for (run = run > next ? run : next; run < behind && run->first < end; run++) swap_add(mail, run, sizeof *run, to);
    return run > next ? run : next;
}

/* What all ranks but the first need: the cut is known to all (partition_equal). */
static struct swap_list resume_runs_pack(const struct resume *resume)
{
    struct swap_list mail = {0};
    size_t room = (size_t)resume->size + 1;
    uint32_t *first = mem_new((size_t)resume->n_level * room, sizeof *first);
    for (int l = 0; l < resume->n_level; l++)
        partition_equal(resume->n_tile[l], resume->size, first + (size_t)l * room);
    for (int rank = 1; rank < resume->size; rank++) {
        const struct resume_run *next = resume->runs;
        size_t begin = 0;
        for (int l = 0; l < resume->n_level; begin += resume->n_tile[l++]) {
            const uint32_t *piece = first + (size_t)l * room + rank;
            next = resume_runs_pick(resume, begin + piece[0], begin + piece[1], rank, next, &mail);
        }
    }
    mem_free(first);
    return mail;
}

/* Part `number` of the list among those that this rank knows; it is looked at when it is new. */
static int resume_runs_part(struct resume *resume, const struct parts_list *list, unsigned number, unsigned *ret_part)
{
    for (*ret_part = 0; *ret_part < resume->n_part; ++*ret_part)
        if (!strcmp(resume->parts[*ret_part].path, list->at[number].path)) return STATUS_OK;
    struct resume_file file = {.file = -1};
    TRY(parts_check(resume->path, list, number, seal_read, &file.seal));
    file.path = mem_text(list->at[number].path);
    resume->parts = mem_grow(resume->parts, resume->n_part, resume->n_part + 1u, sizeof file);
    resume->parts[resume->n_part++] = file;
    return STATUS_OK;
}

int resume_runs_deal(struct resume *resume, const struct parts_list *list)
{
    struct swap_list mail = {0};
    struct swap got;
    int code = STATUS_OK;
    if (resume->rank == 0) mail = resume_runs_pack(resume);
    swap_items(mail.items, sizeof *resume->runs, mail.n, mail.to, &got);
    if (resume->rank > 0) {
        resume->n_run = got.n;
        resume->runs = got.items;
        got.items = NULL;
    }
    for (size_t i = 0; resume->rank > 0 && i < resume->n_run && !code; i++)
        code = resume_runs_part(resume, list, resume->runs[i].part, &resume->runs[i].part);
    swap_done(&got);
    swap_list_free(&mail);
    return comm_agree(code);
}
