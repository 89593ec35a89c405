/* block.c - see block.h. A block is known by its module, the values and its name, written as one text. Ranks that read
 * different cases (files that differ between machines) would wait for each other for ever: they compare these texts
 * first. */
#include "plug/block.h"

#include "base/comm.h"
#include "base/mem.h"
#include "base/share.h"
#include "base/status.h"
#include "base/text.h"

#include <stdbool.h>
#include <stdio.h>
#include <string.h>
#include <xxhash.h>

struct block {
    char *key;
    struct share share;
    unsigned users;
    struct block *next;
};

struct block_use {
    struct block *block;
    struct block_use *next;
};

static struct block *block_list;
static bool block_all_ranks;        /* asking together */
static bool block_parted;           /* another rank has come to block_apart already, with a failure */
static struct text block_key;       /* module and values of the instance being opened */
static struct block_use *block_now; /* its blocks so far */

void block_together(void)
{
    block_all_ranks = true;
    block_parted = false;
}

int block_apart(int code)
{
    block_all_ranks = false;
    if (block_parted) return code ? code : STATUS_CASE;
    return comm_agree(code);
}

void block_begin(const struct bulla_module *module, const struct bulla_value *values)
{
    text_done(&block_key);
    text_add(&block_key, "%s %s %s", module->kind, module->name, module->version);
    for (unsigned i = 0; module->params && module->params[i].name; i++)
        if (module->params[i].type == BULLA_NUMBER) text_add(&block_key, "|%a", values[i].number);
        else text_add(&block_key, "|%s", values[i].text ? values[i].text : "");
    block_now = NULL;
}

struct block_use *block_end(void)
{
    struct block_use *use = block_now;
    text_done(&block_key);
    block_now = NULL;
    return use;
}

static void block_drop(struct block *block)
{
    if (--block->users) return;
    struct block **at = &block_list;
    while (*at != block) at = &(*at)->next;
    *at = block->next;
    share_free(&block->share);
    mem_free(block->key);
    mem_free(block);
}

void block_release(struct block_use *use)
{
    while (use) {
        struct block_use *next = use->next;
        block_drop(use->block);
        mem_free(use);
        use = next;
    }
}

/* Does `code` say on all ranks that things go well? What went wrong on one becomes the message of all. */
static int block_agree(int code)
{
    return block_all_ranks ? comm_agree(code) : code;
}

/* Do all ranks ask for the same block? */
static int block_same(const char *key, size_t bytes)
{
    double what = (double)(XXH64(key, strlen(key), bytes) >> 12), ends[2] = {what, -what};
    if (!block_all_ranks) return STATUS_OK;
    int code = comm_agree(STATUS_OK);
    if (code) {
        block_all_ranks = false;
        block_parted = true;
        return code;
    }
    comm_max(ends, 2);
    if (ends[0] == -ends[1]) return STATUS_OK;
    return status_fail(STATUS_CASE, "the ranks open different laws: do all machines see the same files?");
}

/* All phases, each agreed on. */
static int block_fill(struct share *share, unsigned phases,
                      int (*fill)(void *context, void *block, unsigned phase, unsigned part, unsigned parts),
                      void *context, const char *reason)
{
    for (unsigned phase = 0; phase < phases; phase++) {
        int code = fill(context, share->at, phase, (unsigned)share->part, (unsigned)share->parts);
        if (code) code = status_fail(STATUS_CASE, "%s", reason);
        TRY(block_agree(code));
        share_meet(share);
    }
    return STATUS_OK;
}

static const void *block_take(struct block *block)
{
    struct block_use *use = mem_new(1, sizeof *use);
    *use = (struct block_use){block, block_now};
    block_now = use;
    block->users++;
    return block->share.at;
}

const void *block_share(const char *name, size_t bytes, unsigned phases,
                        int (*fill)(void *context, void *block, unsigned phase, unsigned part, unsigned parts),
                        void *context, char *reason, size_t room)
{
    char *key = mem_print("%s|%s|%zu", block_key.at ? block_key.at : "", name, bytes);
    for (struct block *block = block_list; block; block = block->next)
        if (!strcmp(block->key, key)) {
            mem_free(key);
            return block_take(block);
        }
    struct block *block = mem_new(1, sizeof *block);
    int code = block_same(key, bytes);
    if (!code) code = share_new(bytes, block_all_ranks, &block->share);
    if (!code) code = block_fill(&block->share, phases, fill, context, reason);
    if (code) {
        snprintf(reason, room, "%s", status_text());
        share_free(&block->share);
        mem_free(block);
        mem_free(key);
        return NULL;
    }
    block->key = key;
    block->next = block_list;
    block_list = block;
    return block_take(block);
}
