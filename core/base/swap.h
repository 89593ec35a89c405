/* swap.h - items of equal size to some ranks, where only who sends knows to whom.
 *
 * No rank makes a list of all ranks and no count goes to those that get nothing: each message is confirmed, and a
 * barrier that nobody waits in ends the exchange (Hoefler, Siebert & Lumsdaine 2010, Proc. PPoPP, 159). What arrives
 * is in the order of the senders, so that results do not depend on who was first. */
#ifndef SWAP_H
#define SWAP_H

#include <stddef.h>

/* Items side by side that came from a rank. */
struct swap_piece {
    int rank;
    unsigned n;
};

struct swap {
    unsigned n;
    void *items; /* [n], of the lowest rank first, each rank's in the order it gave them */
    unsigned n_piece;
    struct swap_piece *pieces; /* ranks ascending; none is empty */
    unsigned n_sent;
    struct swap_piece *sent; /* what this rank gave, alike */
};

/* Items of one size, and the ranks that they will go to, in the order they were added. All zero: empty. */
struct swap_list {
    unsigned n, room;
    void *items;
    int *to;
};

/* One more item of `size` bytes, for rank `to`. */
void swap_add(struct swap_list *list, const void *item, size_t size, int to);

void swap_list_free(struct swap_list *list);

/* Item i of `items` (n of `size` bytes) goes to rank to[i], which must ascend; the own rank is one like others.
 * *ret is freed by swap_done. Collective. */
void swap_items(const void *items, size_t size, unsigned n, const int *to, struct swap *ret);

/* Brings items into the order of the ranks that get them; those of one rank keep theirs. */
void swap_sort(void *items, size_t size, unsigned n, int *to);

/* Answers to what has come: item i of `answers` (of `size` bytes) belongs to item i of `asked`. Returns the answers
 * to what this rank had asked, in the order it had asked (mem_free). Only those who have asked each other meet, since
 * each knows what will come. Collective. */
void *swap_answer(const struct swap *asked, const void *answers, size_t size);

void swap_done(struct swap *swap);

#endif
