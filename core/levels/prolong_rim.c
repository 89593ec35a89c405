/* prolong_rim.c - see prolong_rim.h. */
#include "levels/prolong_rim.h"

#include "base/mem.h"
#include "levels/prolong_slope.h"
#include "phys/elastic.h"

/* What the coarse cells of a piece are taken from and where their children go. */
struct prolong_rim_work {
    const struct rim_coarse *piece;
    struct box_block patch, fine; /* one component each */
    struct box box;               /* of fine cells */
    size_t stride[3];             /* to the neighbours whose difference is a slope; 0: none */
};

/* Floor of half. */
static int prolong_rim_half(int i)
{
    return (i - (i & 1)) / 2;
}

/* Children of the coarse cell c of the piece that lie in its box; a layer may have one of two. */
static void prolong_rim_children(const struct prolong_rim_work *work, const int c[3], const double *at)
{
    int from[3], to[3];
    double slope[3];
    for (int d = 0; d < 3; d++) {
        int first = work->box.from[d], last = work->box.to[d] - 1, child = 2 * c[d];
        from[d] = child > first ? child : first;
        to[d] = child + 1 < last ? child + 1 : last;
        slope[d] = prolong_slope(at, work->stride[d]);
    }
    for (int k = from[2]; k <= to[2]; k++)
        for (int j = from[1]; j <= to[1]; j++)
            for (int i = from[0]; i <= to[0]; i++) {
                double x = i & 1 ? slope[0] : -slope[0], y = j & 1 ? slope[1] : -slope[1];
                double z = k & 1 ? slope[2] : -slope[2];
                work->fine.data[box_at(&work->fine, i, j, k)] = *at + ((y + x) + z);
            }
}

/* One component of a piece; coarse cells are counted in pairs of the fine tile's. */
static void prolong_rim_field(const struct prolong_rim_work *work)
{
    int from[3], to[3], c[3];
    const int *base = work->piece->base;
    for (int d = 0; d < 3; d++) {
        from[d] = prolong_rim_half(work->box.from[d]);
        to[d] = prolong_rim_half(work->box.to[d] - 1);
    }
    for (c[2] = from[2]; c[2] <= to[2]; c[2]++)
        for (c[1] = from[1]; c[1] <= to[1]; c[1]++)
            for (c[0] = from[0]; c[0] <= to[0]; c[0]++)
                prolong_rim_children(work, c,
                                     work->patch.data +
                                         box_at(&work->patch, base[0] + c[0], base[1] + c[1], base[2] + c[2]));
}

static void prolong_rim_piece(const struct mesh *mesh, const struct rim *fine, const struct rim_coarse *piece, int slot,
                              const struct box_block *patch)
{
    struct prolong_rim_work work = {.piece = piece, .patch = *patch, .box = rim_box(mesh, fine->form.g, piece->way)};
    size_t stride = 1;
    for (int d = 0; d < mesh->dim; d++) {
        work.stride[d] = d == piece->outer ? 0 : stride;
        stride *= patch->size[d];
    }
    for (unsigned q = 0; q < fine->form.n_field; q++) {
        work.fine = box_pack(&work.box, piece->data[slot]);
        work.fine.data += q * work.fine.pitch;
        work.patch.data = patch->data + q * patch->pitch;
        prolong_rim_field(&work);
    }
}

/* What prolong_strip does to a strip. */
static void prolong_rim_settle(const struct model *model, size_t n, double *data)
{
    if (model->n_alpha > 2) prolong_slope_normalise(n, model->n_alpha, data + model->i_alpha * n);
    elastic_settle(model, n, n, data);
}

void prolong_rim(const struct patch_source *coarse, struct rim *fine, int slot, const struct model *model)
{
    const struct mesh *mesh = coarse->mesh;
    struct box_block patch = rim_block(mesh, coarse->rim->form.g, NULL);
    patch.data = mem_new(fine->form.n_field * patch.pitch, sizeof *patch.data);
    for (unsigned t = 0; t < coarse->level->n_local; t++) {
        unsigned from = fine->source_from[t], to = fine->source_from[t + 1];
        if (from < to) patch_gather(coarse, t, patch.data);
        for (unsigned s = from; s < to; s++) {
            const struct rim_coarse *piece = &fine->sources[s];
            const struct box box = rim_box(mesh, fine->form.g, piece->way);
            prolong_rim_piece(mesh, fine, piece, slot, &patch);
            if (model) prolong_rim_settle(model, box_cells(&box), piece->data[slot]);
        }
    }
    mem_free(patch.data);
}
