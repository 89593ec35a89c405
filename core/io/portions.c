/* portions.c - see portions.h. */
#include "io/portions.h"

#include "base/comm.h"
#include "base/mem.h"
#include "io/writers.h"

#include <stdlib.h>
#include <string.h>

enum { PORTIONS_TAG = 78 };

/* A list, behind two numbers that say how many rows the writer has and how long the list is. */
static void portions_post(struct portions_letter *letter, int to)
{
    struct portions *list = &letter->joined;
    letter->head[0] = list->total;
    letter->head[1] = list->n;
    MPI_Isend(letter->head, sizeof letter->head, MPI_BYTE, to, PORTIONS_TAG, comm_world(), &letter->requests[0]);
    MPI_Isend(list->list, (int)(list->n * sizeof *list->list), MPI_BYTE, to, PORTIONS_TAG, comm_world(),
              &letter->requests[1]);
}

static void portions_bytes(int from, size_t bytes, void *to)
{
    MPI_Request request;
    MPI_Irecv(to, (int)bytes, MPI_BYTE, from, PORTIONS_TAG, comm_world(), &request);
    comm_wait(1, &request, MPI_STATUSES_IGNORE);
}

static void portions_fetch(int from, struct portions *ret)
{
    size_t head[2];
    portions_bytes(from, sizeof head, head);
    ret->total = head[0];
    ret->n = (unsigned)head[1];
    ret->list = mem_new(ret->n + 1u, sizeof *ret->list);
    portions_bytes(from, ret->n * sizeof *ret->list, ret->list);
}

static int portions_compare(const void *a, const void *b)
{
    size_t x = ((const struct portion *)a)->first, y = ((const struct portion *)b)->first;
    return (x > y) - (x < y);
}

/* What a writer has been told: [rank from the leader on][n_range]. */
static void portions_order(struct portions *own, int ranks, unsigned n_range, const struct h5out_range *told)
{
    own->list = mem_new((size_t)ranks * n_range + 1, sizeof *own->list);
    for (size_t i = 0; i < (size_t)ranks * n_range; i++)
        if (told[i].count)
            own->list[own->n++] = (struct portion){own->leader + (int)(i / n_range), told[i].first, told[i].count, 0};
    qsort(own->list, own->n, sizeof *own->list, portions_compare);
    for (unsigned i = 0; i < own->n; i++) {
        own->list[i].place = own->total;
        own->total += own->list[i].count;
    }
}

/* The chunks that a portion begins and ends in. */
static size_t portions_first(const struct portions *own, unsigned i)
{
    return own->list[i].place / own->chunk;
}

static size_t portions_last(const struct portions *own, unsigned i)
{
    return (own->list[i].place + own->list[i].count - 1) / own->chunk;
}

/* Appends, from number `from` on, what lies in the chunks of portion i; returns what is next to be appended. */
static unsigned portions_around(const struct portions *own, unsigned i, unsigned from, struct portions *ret)
{
    unsigned low = i, end = i + 1;
    while (low > from && portions_last(own, low - 1) >= portions_first(own, i)) low--;
    while (end < own->n && portions_first(own, end) <= portions_last(own, i)) end++;
    low = low > from ? low : from;
    if (low >= end) return from;
    ret->list = mem_grow(ret->list, ret->n, ret->n + (end - low), sizeof *ret->list);
    memcpy(ret->list + ret->n, own->list + low, (end - low) * sizeof *ret->list);
    ret->n += end - low;
    return end;
}

/* What concerns each rank behind the leader, told to all of them. */
static void portions_answer(const struct portions *own, int ranks)
{
    struct portions_letter *letters = mem_new((size_t)ranks, sizeof *letters);
    unsigned *next = mem_new((size_t)ranks, sizeof *next);
    for (unsigned i = 0; i < own->n; i++) {
        int rank = own->list[i].rank - own->leader;
        if (rank) next[rank] = portions_around(own, i, next[rank], &letters[rank].joined);
    }
    for (int rank = 1; rank < ranks; rank++) {
        letters[rank].joined.total = own->total;
        portions_post(&letters[rank], own->leader + rank);
    }
    for (int rank = 1; rank < ranks; rank++) portions_sent(&letters[rank]);
    mem_free(next);
    mem_free(letters);
}

/* The part of a writer: what each of its ranks has, in their order. */
static void portions_lead(struct portions *own, int ranks, unsigned n_range, const struct h5out_range *ranges)
{
    struct h5out_range *told = mem_new((size_t)ranks * n_range + 1, sizeof *told);
    memcpy(told, ranges, n_range * sizeof *told);
    for (int rank = 1; rank < ranks; rank++)
        portions_bytes(own->leader + rank, n_range * sizeof *told, told + (size_t)rank * n_range);
    portions_order(own, ranks, n_range, told);
    mem_free(told);
}

void portions_take(int writers, size_t chunk, unsigned n_range, const struct h5out_range *ranges, struct portions *ret)
{
    int writer = writers_of(writers, comm_rank()), leader = writers_first(writers, writer);
    int ranks = writers_first(writers, writer + 1) - leader;
    *ret = (struct portions){.leader = leader};
    if (comm_rank() == leader) portions_lead(ret, ranks, n_range, ranges);
    else {
        MPI_Request request;
        MPI_Isend(ranges, (int)(n_range * sizeof *ranges), MPI_BYTE, leader, PORTIONS_TAG, comm_world(), &request);
        comm_wait(1, &request, MPI_STATUSES_IGNORE);
        portions_fetch(leader, ret);
    }
    ret->chunk = chunk < ret->total ? chunk : ret->total;
    if (comm_rank() == leader && ranks > 1) portions_answer(ret, ranks);
}

void portions_free(struct portions *portions)
{
    mem_free(portions->list);
}

/* Those that follow each other become one. */
static void portions_join(const struct portions *own, struct portions *ret)
{
    *ret = *own;
    ret->list = mem_new(own->n + 1u, sizeof *ret->list);
    ret->n = 0;
    for (unsigned i = 0; i < own->n; i++) {
        struct portion *last = ret->n ? &ret->list[ret->n - 1] : NULL;
        if (last && last->first + last->count == own->list[i].first) last->count += own->list[i].count;
        else ret->list[ret->n++] = own->list[i];
    }
}

void portions_send(const struct portions *own, struct portions_letter *ret_letter)
{
    *ret_letter = (struct portions_letter){.requests = {MPI_REQUEST_NULL, MPI_REQUEST_NULL}};
    if (comm_rank() != own->leader) return;
    portions_join(own, &ret_letter->joined);
    if (comm_rank()) portions_post(ret_letter, 0);
}

void portions_sent(struct portions_letter *letter)
{
    if (comm_active()) comm_wait(2, letter->requests, MPI_STATUSES_IGNORE);
    portions_free(&letter->joined);
}

void portions_receive(const struct portions_letter *own, int from, struct portions *ret)
{
    *ret = (struct portions){.leader = from};
    if (from) portions_fetch(from, ret);
    else portions_join(&own->joined, ret);
}
