/* post.c - see post.h. The items of a peer lie side by side in one buffer, in the order of the list, so that what
 * is sent to it or comes from it is one message without a copy. */
#include "mesh/post.h"

#include "base/comm.h"
#include "base/mem.h"

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

/* Places the items; starts[r] .. starts[r + 1] becomes what belongs to peer r. */
static void post_place(struct post_way *way, unsigned n, const struct post_item *items, size_t *starts)
{
    int size = comm_size();
    for (int rank = 0; rank <= size; rank++) starts[rank] = 0;
    for (unsigned i = 0; i < n; i++) starts[items[i].rank + 1] += items[i].doubles;
    for (int rank = 0; rank < size; rank++) starts[rank + 1] += starts[rank];
    way->n = n;
    way->total = starts[size];
    way->at = mem_new(n, sizeof *way->at);
    way->buffer = mem_new_large(way->total, sizeof *way->buffer);
    for (unsigned i = 0; i < n; i++) {
        way->at[i] = starts[items[i].rank];
        starts[items[i].rank] += items[i].doubles; /* ends where the next peer began */
    }
    for (int rank = size; rank > 0; rank--) starts[rank] = starts[rank - 1];
    starts[0] = 0;
}

static void post_connect(struct post *post, const struct post_way *way, const size_t *starts, int tag, post_init *init)
{
    for (int rank = 0; rank < comm_size(); rank++)
        if (starts[rank + 1] > starts[rank])
            init(way->buffer + starts[rank], (int)(starts[rank + 1] - starts[rank]), MPI_DOUBLE, rank, tag,
                 comm_world(), &post->requests[post->n_request++]);
}

struct post *post_new(int tag, unsigned n_out, const struct post_item *out, unsigned n_in, const struct post_item *in)
{
    struct post *post = mem_new(1, sizeof *post);
    size_t ranks = (size_t)comm_size(), *starts = mem_new(ranks + 1, sizeof *starts);
    post->requests = mem_new(2 * ranks, sizeof *post->requests);
    post_place(&post->in, n_in, in, starts);
    post_connect(post, &post->in, starts, tag, post_receive);
    post_place(&post->out, n_out, out, starts);
    post_connect(post, &post->out, starts, tag, post_send);
    mem_free(starts);
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
