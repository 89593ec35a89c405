/* post.c - see post.h. The items of a peer lie side by side in one buffer, in the order of the list, so that what
 * is sent to it or comes from it is one message without a copy. */
#include "mesh/post.h"

#include "base/comm.h"
#include "base/mem.h"

#include <stdlib.h>

/* One direction: all items in one buffer, peer by peer. */
struct post_way {
    unsigned n;
    size_t *at; /* [n] offset of each item in the buffer */
    size_t total;
    double *buffer;
};

struct post {
    struct post_way out, in;
    int n_request;
    MPI_Request *requests;
};

typedef int post_init(void *buffer, int count, MPI_Datatype type, int peer, int tag, MPI_Comm comm,
                      MPI_Request *ret_request);

static int post_send(void *buffer, int count, MPI_Datatype type, int peer, int tag, MPI_Comm comm,
                     MPI_Request *ret_request)
{
    return MPI_Send_init(buffer, count, type, peer, tag, comm, ret_request);
}

static int post_receive(void *buffer, int count, MPI_Datatype type, int peer, int tag, MPI_Comm comm,
                        MPI_Request *ret_request)
{
    return MPI_Recv_init(buffer, count, type, peer, tag, comm, ret_request);
}

/* Items of a peer side by side in the buffer. */
struct post_peer {
    int rank;
    size_t from, to; /* doubles */
};

struct post_sorted {
    int rank;
    unsigned item;
};

static int post_compare(const void *a, const void *b)
{
    const struct post_sorted *x = a, *y = b;
    if (x->rank != y->rank) return x->rank < y->rank ? -1 : 1;
    return (x->item > y->item) - (x->item < y->item);
}

/* Places the items; returns the peers, *ret_n of them: work and memory follow them, not all ranks. */
static struct post_peer *post_place(struct post_way *way, unsigned n, const struct post_item *items, unsigned *ret_n)
{
    struct post_sorted *sorted = mem_new(n, sizeof *sorted);
    struct post_peer *peers = mem_new(n, sizeof *peers);
    unsigned count = 0;
    for (unsigned i = 0; i < n; i++) sorted[i] = (struct post_sorted){items[i].rank, i};
    if (n) qsort(sorted, n, sizeof *sorted, post_compare);
    way->n = n;
    way->at = mem_new(n, sizeof *way->at);
    for (unsigned i = 0; i < n; i++) {
        if (!count || peers[count - 1].rank != sorted[i].rank)
            peers[count++] = (struct post_peer){sorted[i].rank, way->total, way->total};
        way->at[sorted[i].item] = way->total;
        way->total += items[sorted[i].item].doubles;
        peers[count - 1].to = way->total;
    }
    way->buffer = mem_new_large(way->total, sizeof *way->buffer);
    mem_free(sorted);
    *ret_n = count;
    return peers;
}

static void post_connect(struct post *post, const struct post_way *way, const struct post_peer *peers, unsigned n,
                         int tag, post_init *init)
{
    for (unsigned p = 0; p < n; p++)
        if (peers[p].to > peers[p].from)
            init(way->buffer + peers[p].from, (int)(peers[p].to - peers[p].from), MPI_DOUBLE, peers[p].rank, tag,
                 comm_world(), &post->requests[post->n_request++]);
}

struct post *post_new(int tag, unsigned n_out, const struct post_item *out, unsigned n_in, const struct post_item *in)
{
    struct post *post = mem_new(1, sizeof *post);
    unsigned to, from;
    struct post_peer *senders = post_place(&post->in, n_in, in, &from);
    struct post_peer *receivers = post_place(&post->out, n_out, out, &to);
    post->requests = mem_new((size_t)from + to, sizeof *post->requests);
    post_connect(post, &post->in, senders, from, tag, post_receive);
    post_connect(post, &post->out, receivers, to, tag, post_send);
    mem_free(senders);
    mem_free(receivers);
    return post;
}

static void post_drop(struct post_way *way)
{
    mem_free(way->buffer);
    mem_free(way->at);
}

void post_free(struct post *post)
{
    if (!post) return;
    for (int i = 0; i < post->n_request; i++) MPI_Request_free(&post->requests[i]);
    post_drop(&post->out);
    post_drop(&post->in);
    mem_free(post->requests);
    mem_free(post);
}

double *post_out(struct post *post, unsigned i)
{
    return post->out.buffer + post->out.at[i];
}

double *post_in(struct post *post, unsigned i)
{
    return post->in.buffer + post->in.at[i];
}

void post_start(struct post *post)
{
    if (post->n_request) MPI_Startall(post->n_request, post->requests);
}

void post_finish(struct post *post)
{
    if (post->n_request) comm_wait(post->n_request, post->requests, MPI_STATUSES_IGNORE);
}

size_t post_volume(const struct post *post)
{
    return post->out.total;
}
