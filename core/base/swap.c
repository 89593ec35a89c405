/* swap.c - see swap.h. Two tags take turns: who is done may begin the next exchange while others still look for
 * messages of this one, but not the one after that. */
#include "base/swap.h"

#include "base/comm.h"
#include "base/mem.h"

#include <sched.h>
#include <stdlib.h>
#include <string.h>

enum { SWAP_TAG = 900, SWAP_ANSWER = 902, SWAP_LOOKS = 100 };

struct swap_mail {
    int rank;
    size_t bytes;
    char *data; /* of a message that has come; NULL: what this rank gives itself */
};

struct swap_box {
    int tag;
    unsigned n, room;
    struct swap_mail *mail;
    const char *own;
};

static void swap_keep(struct swap_box *box, struct swap_mail mail)
{
    if (box->n == box->room) {
        unsigned room = 2 * box->room + 8;
        box->mail = mem_grow(box->mail, box->room, room, sizeof *box->mail);
        box->room = room;
    }
    box->mail[box->n++] = mail;
}

/* Takes a message, if one has come. */
static bool swap_look(struct swap_box *box)
{
    int here, bytes;
    MPI_Status status;
    MPI_Iprobe(MPI_ANY_SOURCE, box->tag, comm_world(), &here, &status);
    if (!here) return false;
    MPI_Get_count(&status, MPI_BYTE, &bytes);
    struct swap_mail mail = {status.MPI_SOURCE, (size_t)bytes, mem_new((size_t)bytes, 1)};
    MPI_Recv(mail.data, bytes, MPI_BYTE, mail.rank, box->tag, comm_world(), MPI_STATUS_IGNORE);
    swap_keep(box, mail);
    return true;
}

/* Until all that any rank sends has arrived. */
static void swap_wait(struct swap_box *box, int n, MPI_Request *sends)
{
    MPI_Request barrier;
    int sent = 0, done = 0;
    for (int looks = 0; !done; looks++) {
        if (swap_look(box)) looks = 0;
        else if (sent) MPI_Test(&barrier, &done, MPI_STATUS_IGNORE);
        else {
            MPI_Testall(n, sends, &sent, MPI_STATUSES_IGNORE);
            if (sent) MPI_Ibarrier(comm_world(), &barrier);
        }
        if (looks >= SWAP_LOOKS) sched_yield();
    }
}

/* Items in a row for the same rank. */
static struct swap_piece *swap_pieces(const int *to, unsigned n, unsigned *ret_n)
{
    unsigned n_piece = 0, count = 0;
    for (unsigned i = 0; i < n; i++) n_piece += !i || to[i] != to[i - 1];
    struct swap_piece *pieces = mem_new(n_piece, sizeof *pieces);
    for (unsigned i = 0; i < n; i++) {
        if (!i || to[i] != to[i - 1]) pieces[count++].rank = to[i];
        pieces[count - 1].n++;
    }
    *ret_n = n_piece;
    return pieces;
}

static void swap_send(struct swap_box *box, const char *items, size_t size, const struct swap *swap)
{
    MPI_Request *sends = mem_new(swap->n_sent, sizeof *sends);
    int n_send = 0;
    for (const struct swap_piece *to = swap->sent; to < swap->sent + swap->n_sent; to++) {
        size_t bytes = to->n * size;
        if (to->rank != comm_rank())
            MPI_Issend(items, (int)bytes, MPI_BYTE, to->rank, box->tag, comm_world(), &sends[n_send++]);
        else {
            box->own = items;
            swap_keep(box, (struct swap_mail){comm_rank(), bytes, NULL});
        }
        items += bytes;
    }
    if (comm_active()) swap_wait(box, n_send, sends);
    mem_free(sends);
}

static int swap_compare(const void *a, const void *b)
{
    const struct swap_mail *x = a, *y = b;
    return (x->rank > y->rank) - (x->rank < y->rank);
}

void swap_items(const void *items, size_t size, unsigned n, const int *to, struct swap *ret)
{
    static int turn;
    struct swap_box box = {.tag = SWAP_TAG + (turn ^= 1)};
    size_t bytes = 0;
    *ret = (struct swap){0};
    ret->sent = swap_pieces(to, n, &ret->n_sent);
    swap_send(&box, items, size, ret);
    if (box.n) qsort(box.mail, box.n, sizeof *box.mail, swap_compare);
    for (unsigned i = 0; i < box.n; i++) bytes += box.mail[i].bytes;
    ret->n = (unsigned)(bytes / size);
    ret->n_piece = box.n;
    char *next = ret->items = mem_new(ret->n, size);
    ret->pieces = mem_new(box.n, sizeof *ret->pieces);
    for (unsigned i = 0; i < box.n; next += box.mail[i++].bytes) {
        memcpy(next, box.mail[i].data ? box.mail[i].data : box.own, box.mail[i].bytes);
        ret->pieces[i] = (struct swap_piece){box.mail[i].rank, (unsigned)(box.mail[i].bytes / size)};
        mem_free(box.mail[i].data);
    }
    mem_free(box.mail);
}

struct swap_place {
    int to;
    unsigned at;
};

static int swap_compare_places(const void *a, const void *b)
{
    const struct swap_place *x = a, *y = b;
    if (x->to != y->to) return x->to < y->to ? -1 : 1;
    return (x->at > y->at) - (x->at < y->at);
}

void swap_sort(void *items, size_t size, unsigned n, int *to)
{
    unsigned sorted = 1;
    while (sorted < n && to[sorted - 1] <= to[sorted]) sorted++;
    if (sorted >= n) return;
    struct swap_place *places = mem_new(n, sizeof *places);
    char *copy = mem_new(n, size);
    memcpy(copy, items, n * size);
    for (unsigned i = 0; i < n; i++) places[i] = (struct swap_place){to[i], i};
    qsort(places, n, sizeof *places, swap_compare_places);
    for (unsigned i = 0; i < n; i++) {
        to[i] = places[i].to;
        memcpy((char *)items + i * size, copy + places[i].at * size, size);
    }
    mem_free(copy);
    mem_free(places);
}

static unsigned swap_count(const struct swap_piece *pieces, unsigned n)
{
    unsigned count = 0;
    for (unsigned p = 0; p < n; p++) count += pieces[p].n;
    return count;
}

/* Where this rank's own items begin in what `pieces` are of; NULL: there are none. */
static char *swap_own(const struct swap_piece *pieces, unsigned n, char *items, size_t size)
{
    for (unsigned p = 0; p < n; items += pieces[p++].n * size)
        if (pieces[p].rank == comm_rank()) return items;
    return NULL;
}

void *swap_answer(const struct swap *asked, const void *answers, size_t size)
{
    MPI_Request *requests = mem_new(asked->n_sent + asked->n_piece, sizeof *requests);
    char *got = mem_new(swap_count(asked->sent, asked->n_sent), size), *to = got;
    const char *from = answers;
    int n = 0;
    for (const struct swap_piece *p = asked->sent; p < asked->sent + asked->n_sent; to += p++->n * size)
        if (p->rank != comm_rank())
            MPI_Irecv(to, (int)(p->n * size), MPI_BYTE, p->rank, SWAP_ANSWER, comm_world(), &requests[n++]);
    to = swap_own(asked->sent, asked->n_sent, got, size);
    for (const struct swap_piece *p = asked->pieces; p < asked->pieces + asked->n_piece; from += p++->n * size)
        if (p->rank != comm_rank())
            MPI_Isend(from, (int)(p->n * size), MPI_BYTE, p->rank, SWAP_ANSWER, comm_world(), &requests[n++]);
        else memcpy(to, from, p->n * size);
    if (n) comm_wait(n, requests, MPI_STATUSES_IGNORE);
    mem_free(requests);
    return got;
}

void swap_add(struct swap_list *list, const void *item, size_t size, int to)
{
    if (list->n == list->room) {
        unsigned room = 2 * list->room + 64;
        list->items = mem_grow(list->items, list->room, room, size);
        list->to = mem_grow(list->to, list->room, room, sizeof *list->to);
        list->room = room;
    }
    memcpy((char *)list->items + list->n * size, item, size);
    list->to[list->n++] = to;
}

void swap_list_free(struct swap_list *list)
{
    mem_free(list->items);
    mem_free(list->to);
    *list = (struct swap_list){0};
}

void swap_done(struct swap *swap)
{
    mem_free(swap->items);
    mem_free(swap->pieces);
    mem_free(swap->sent);
    *swap = (struct swap){0};
}
