/* swap.c - see swap.h. Two tags take turns: who is done may begin the next exchange while others still look for
 * messages of this one, but not the one after that. */
#include "base/swap.h"

#include "base/comm.h"
#include "base/mem.h"

#include <sched.h>
#include <stdlib.h>
#include <string.h>

enum { SWAP_TAG = 900, SWAP_LOOKS = 100 };

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

static unsigned swap_run(const int *to, unsigned from, unsigned n)
{
    unsigned end = from + 1;
    while (end < n && to[end] == to[from]) end++;
    return end;
}

static void swap_send(struct swap_box *box, const char *items, size_t size, unsigned n, const int *to)
{
    MPI_Request *sends = mem_new(n, sizeof *sends);
    int n_send = 0;
    for (unsigned from = 0, end; from < n; from = end) {
        end = swap_run(to, from, n);
        const char *data = items + from * size;
        size_t bytes = (end - from) * size;
        if (to[from] != comm_rank())
            MPI_Issend(data, (int)bytes, MPI_BYTE, to[from], box->tag, comm_world(), &sends[n_send++]);
        else {
            box->own = data;
            swap_keep(box, (struct swap_mail){comm_rank(), bytes, NULL});
        }
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
    swap_send(&box, items, size, n, to);
    if (box.n) qsort(box.mail, box.n, sizeof *box.mail, swap_compare);
    for (unsigned i = 0; i < box.n; i++) bytes += box.mail[i].bytes;
    *ret = (struct swap){.n = (unsigned)(bytes / size), .n_piece = box.n};
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

void *swap_answer(const struct swap *asked, const void *answers, size_t size)
{
    struct swap got;
    int *to = mem_new(asked->n, sizeof *to), *next = to;
    for (unsigned p = 0; p < asked->n_piece; p++)
        for (unsigned i = 0; i < asked->pieces[p].n; i++) *next++ = asked->pieces[p].rank;
    swap_items(answers, size, asked->n, to, &got);
    mem_free(to);
    mem_free(got.pieces);
    return got.items;
}

void swap_done(struct swap *swap)
{
    mem_free(swap->items);
    mem_free(swap->pieces);
    *swap = (struct swap){0};
}
