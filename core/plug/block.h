/* block.h - the tables of modules: blocks of memory that all instances with the same values and all ranks of a machine
 * have in common, filled by these ranks together (struct bulla_host, `share`). */
#ifndef BLOCK_H
#define BLOCK_H

#include "bulla/module.h"

struct block_use; /* the blocks of one instance */

/* Between these two all ranks open the same modules with the same values in the same order, as they do when they read
 * the same case; otherwise blocks are made by each process alone. block_apart agrees on how it went: the largest `code`
 * of all ranks. Both collective. */
void block_together(void);
int block_apart(int code);

/* An instance is being opened: block_share belongs to it until block_end, which gives its blocks. */
void block_begin(const struct bulla_module *module, const struct bulla_value *values);
struct block_use *block_end(void);

/* The host's `share`. `reason`: where host->fail has written (of `room` bytes). */
const void *block_share(const char *name, size_t bytes, unsigned phases,
                        int (*fill)(void *context, void *block, unsigned phase, unsigned part, unsigned parts),
                        void *context, char *reason, size_t room);

/* Gives the blocks of an instance back; NULL is fine. */
void block_release(struct block_use *use);

#endif
