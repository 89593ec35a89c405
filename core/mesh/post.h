/* post.h - fixed sets of numbers between ranks: one message per pair of ranks, persistent requests.
 *
 * A post is a list of items to send and a list to receive, each with a peer rank and a size. The
 * items of one pair of ranks must be listed in the same order on both sides; who lists them derives
 * them from what both know of the mesh, so there is no handshake. Items for the own rank are not allowed:
 * those are copied by whoever knows both ends. Without items no MPI call is made. */
#ifndef POST_H
#define POST_H

#include <stddef.h>

struct post;

/* Tags, one of each per level (added). */
enum {
    POST_HALO = 0,
    POST_DOWN = 100,
    POST_UP = 200,
    POST_MOVE = 300,
    POST_KEPT = 400,
    POST_LATE = 500,
    POST_DOZE = 600
};

struct post_item {
    int rank;       /* the peer */
    size_t doubles; /* its size */
};

/* `tag` tells posts apart that may be under way at once. Lists are copied. Not collective. */
struct post *post_new(int tag, unsigned n_out, const struct post_item *out, unsigned n_in, const struct post_item *in);
void post_free(struct post *post);

/* Where item i is written before post_start, and read after post_finish. */
double *post_out(struct post *post, unsigned i);
double *post_in(struct post *post, unsigned i);

void post_start(struct post *post);
void post_finish(struct post *post); /* safe to call twice, or without a start */

/* Doubles this rank sends per start, for reports. */
size_t post_volume(const struct post *post);

#endif
