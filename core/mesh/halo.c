/* halo.c - exchange between ranks: one message per pair, packed in an order both sides know.
 *
 * The order of slabs in the message from A to B is that of (receiving tile, receiving face).
 * B numbered its remote faces in just that order; A finds it by sorting what it sends. */
#include "mesh/halo.h"

#include "base/comm.h"
#include "base/mem.h"

#include <stdlib.h>
#include <string.h>

/* One slab to pack: face `face` of the local tile, for the tile `to` (global index) of a rank. */
struct halo_send {
    int rank;
    unsigned local;
    int face;
    unsigned to;
};

struct halo {
    const struct mesh *mesh;
    unsigned n_field, n_send, n_receive, n_request, n_peer_receive;
    struct halo_send *sends; /* sorted by rank, receiving tile, receiving face */
    size_t slab_doubles;     /* largest slab: all are given this room */
    double *send_buffer, **slabs, *receive_buffer;
    MPI_Request *requests;
};

static size_t halo_inner(const struct mesh *mesh, int axis)
{
    size_t inner = 1;
    for (int d = 0; d < axis; d++) inner *= (size_t)mesh->n[d];
    return inner;
}

static int halo_compare(const void *a, const void *b)
{
    const struct halo_send *x = a, *y = b;
    if (x->rank != y->rank) return x->rank < y->rank ? -1 : 1;
    if (x->to != y->to) return x->to < y->to ? -1 : 1;
    return (x->face ^ 1) - (y->face ^ 1);
}

static int halo_peer(const struct mesh *mesh, const struct level *level, unsigned local, int face)
{
    const struct tile *tile = &level->tiles[level->first + local];
    int at[3] = {tile->at[0], tile->at[1], tile->at[2]};
    at[face / 2] += face % 2 ? 1 : -1;
    return mesh_find(mesh, level, at);
}

static void halo_list(struct halo *halo, const struct level *level)
{
    const struct mesh *mesh = halo->mesh;
    halo->sends = mem_new((size_t)level->n_local * MESH_FACES, sizeof *halo->sends);
    for (unsigned t = 0; t < level->n_local; t++)
        for (int face = 0; face < 2 * mesh->dim; face++) {
            if (level->neighbours[t][face].kind != NEIGHBOUR_REMOTE) continue;
            unsigned other = (unsigned)halo_peer(mesh, level, t, face);
            halo->sends[halo->n_send++] =
                (struct halo_send){.rank = level->tiles[other].rank, .local = t, .face = face, .to = other};
        }
    halo->n_receive = halo->n_send; /* adjacency is symmetric */
}

/* Receive buffers: slab pointers by remote index, laid out rank by rank in index order, which
 * is the order of (tile, face). Requests for both directions. */
static void halo_connect(struct halo *halo, const struct level *level)
{
    const struct mesh *mesh = halo->mesh;
    unsigned total = halo->n_receive, placed = 0;
    size_t room = halo->slab_doubles;
    halo->send_buffer = mem_new(total * room, sizeof(double));
    halo->receive_buffer = mem_new(total * room, sizeof(double));
    halo->slabs = mem_new(total, sizeof *halo->slabs);
    halo->requests = mem_new(2 * (size_t)comm_size(), sizeof *halo->requests);
    for (int rank = 0; rank < comm_size(); rank++) {
        unsigned from = placed, sends = 0, send_from = 0;
        for (unsigned t = 0; t < level->n_local; t++)
            for (int face = 0; face < 2 * mesh->dim; face++) {
                const struct neighbour *neighbour = &level->neighbours[t][face];
                if (neighbour->kind != NEIGHBOUR_REMOTE) continue;
                if (level->tiles[halo_peer(mesh, level, t, face)].rank != rank) continue;
                halo->slabs[neighbour->index] = halo->receive_buffer + room * placed++;
            }
        while (send_from < total && halo->sends[send_from].rank < rank) send_from++;
        while (send_from + sends < total && halo->sends[send_from + sends].rank == rank) sends++;
        if (!sends) continue;
        MPI_Recv_init(halo->receive_buffer + room * from, (int)(room * (placed - from)), MPI_DOUBLE, rank, 0,
                      comm_world(), &halo->requests[halo->n_request++]);
        MPI_Send_init(halo->send_buffer + room * send_from, (int)(room * sends), MPI_DOUBLE, rank, 0, comm_world(),
                      &halo->requests[halo->n_request++]);
    }
}

struct halo *halo_new(const struct mesh *mesh, const struct level *level, unsigned n_field)
{
    struct halo *halo = mem_new(1, sizeof *halo);
    halo->mesh = mesh;
    halo->n_field = n_field;
    for (int axis = 0; axis < mesh->dim; axis++) {
        size_t slab = n_field * mesh->n_cell / (size_t)mesh->n[axis] * MESH_GHOST;
        if (slab > halo->slab_doubles) halo->slab_doubles = slab;
    }
    halo_list(halo, level);
    if (!halo->n_send) return halo;
    qsort(halo->sends, halo->n_send, sizeof *halo->sends, halo_compare);
    halo_connect(halo, level);
    return halo;
}

void halo_free(struct halo *halo)
{
    if (!halo) return;
    for (unsigned i = 0; i < halo->n_request; i++) MPI_Request_free(&halo->requests[i]);
    mem_free(halo->requests);
    mem_free(halo->slabs);
    mem_free(halo->receive_buffer);
    mem_free(halo->send_buffer);
    mem_free(halo->sends);
    mem_free(halo);
}

/* The layers next to a face: the first or last MESH_GHOST of the axis. */
static void halo_pack(const struct halo *halo, const double *array, int face, double *slab)
{
    const struct mesh *mesh = halo->mesh;
    int axis = face / 2, n = mesh->n[axis];
    size_t inner = halo_inner(mesh, axis), outer = mesh->n_cell / inner / (size_t)n;
    size_t skip = face % 2 ? (size_t)(n - MESH_GHOST) * inner : 0, length = MESH_GHOST * inner;
    for (size_t block = 0; block < halo->n_field * outer; block++)
        memcpy(slab + block * length, array + block * inner * (size_t)n + skip, length * sizeof *slab);
}

void halo_start(struct halo *halo, double *const *arrays)
{
    for (unsigned i = 0; i < halo->n_send; i++)
        halo_pack(halo, arrays[halo->sends[i].local], halo->sends[i].face, halo->send_buffer + i * halo->slab_doubles);
    if (halo->n_request) MPI_Startall((int)halo->n_request, halo->requests);
}

void halo_finish(struct halo *halo)
{
    if (halo->n_request) MPI_Waitall((int)halo->n_request, halo->requests, MPI_STATUSES_IGNORE);
}

const double *halo_slab(const struct halo *halo, unsigned index)
{
    return halo->slabs[index];
}

bool halo_is_remote(const struct level *level, unsigned local)
{
    for (int face = 0; face < MESH_FACES; face++)
        if (level->neighbours[local][face].kind == NEIGHBOUR_REMOTE) return true;
    return false;
}
