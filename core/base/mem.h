/* mem.h - memory that is there or the program ends cleanly.
 *
 * Sizes are decided by the case, which is checked against --max-memory before anything is
 * allocated; running out later is no state a caller could repair. mem_new therefore never
 * returns NULL: it reports the size asked for and ends all ranks with STATUS_RUN.
 * All blocks are 64-byte aligned (a cache line, an AVX-512 register) and zeroed.
 *
 * This folder, base: what any C program needs and knows nothing of simulations: memory, texts, messages, ranks,
 * hash tables. */
#ifndef MEM_H
#define MEM_H

#include <stddef.h>

/* Zeroed, 64-byte aligned memory for `count` items of `size` bytes; free with mem_free. */
void *mem_new(size_t count, size_t size);

/* The same for large arrays that live long: asks the system for large pages. */
void *mem_new_large(size_t count, size_t size);

/* Resizes a block made by mem_new or mem_grow (NULL: makes one), keeping the first
 * `old_count` items; new items are zeroed. */
void *mem_grow(void *block, size_t old_count, size_t new_count, size_t size);

/* Like realloc (0 bytes frees), unaligned and not zeroed; NULL when there is no memory. For memory with its
 * own limit, which the caller answers for (Lua). */
void *mem_try(void *block, size_t bytes);

/* A copy of a string (NULL gives NULL), of `length` bytes of it. */
char *mem_text(const char *text);
char *mem_text_n(const char *text, size_t length);

/* printf into a new string. */
char *mem_print(const char *format, ...) __attribute__((format(printf, 1, 2)));

/* Frees; NULL is fine. */
void mem_free(void *block);

/* Peak resident memory of this process so far [bytes]. */
double mem_peak(void);

/* Memory of this machine, or what the group of processes that this one belongs to may have of it [bytes]. */
double mem_machine(void);

/* What this process may have (ulimit -v) [bytes]; HUGE_VAL: no limit. */
double mem_allowed(void);

#endif
