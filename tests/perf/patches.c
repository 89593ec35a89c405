/* patches.c - what gathering tiles with edges and corners costs beside frames: `mpirun -n 2 bulla-bench-patches`. CPU
 * time per cell of a tile, the best of several passes over a periodic domain that no cache holds; messages and
 * memory per tile; and the making of a rim. Rank 0 prints. No test: times are those of the machine. */
#include "../unit/replicated.h"
#include "base/abort.h"
#include "base/comm.h"
#include "base/mem.h"
#include "levels/prolong_rim.h"
#include "mesh/halo.h"
#include "mesh/morton.h"
#include "scheme/frame.h"
#include "scheme/patch.h"

#include <stdio.h>
#include <stdlib.h>
#include <time.h>

enum { PASSES = 40 };

static double seconds(void)
{
    struct timespec time;
    clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &time);
    return (double)time.tv_sec + 1e-9 * (double)time.tv_nsec;
}

static struct mesh *domain(int dim, int tiles, int n, unsigned n_field)
{
    struct scene scene = {.domain = {.dim = dim, .cells_place = "bench"}, .mesh = {.tile = n, .levels = 1}};
    struct mesh *mesh;
    for (int d = 0; d < 3; d++) {
        scene.domain.cells[d] = d < dim ? tiles * n : 1;
        scene.domain.upper[d] = d < dim ? 1.0 : 0.0;
        scene.domain.boundary[d][0].type = scene.domain.boundary[d][1].type = SCENE_PERIODIC;
    }
    if (mesh_new(&scene, n_field, 2, &mesh)) abort_all(1);
    return mesh;
}

/* All frames of all tiles, along all axes. */
static void gather_frames(const struct frame_source *source, double *w)
{
    for (unsigned t = 0; t < source->level->n_local; t++)
        for (int axis = 0; axis < source->mesh->dim; axis++)
            for (size_t piece = 0; piece < frame_pieces(source->mesh, axis); piece++) {
                struct frame frame = frame_piece(source->mesh, axis, piece);
                frame_gather(source, t, &frame, FRAME_CELLS, w);
            }
}

static void gather_patches(const struct patch_source *source, double *w)
{
    for (unsigned t = 0; t < source->level->n_local; t++) patch_gather(source, t, w);
}

static double least(double best, double taken)
{
    return taken < best ? taken : best;
}

static void bench(int dim, int tiles, int n, unsigned n_field)
{
    struct mesh *mesh = domain(dim, tiles, n, n_field);
    const struct level *level = &mesh->levels[0];
    size_t cells = rim_block(mesh, RIM_LAYERS, NULL).pitch;
    double *w = mem_new(n_field * (cells > FRAME_CELLS ? cells : FRAME_CELLS), sizeof *w), frames = 1e9;
    double scale = 1e9 / ((double)level->n_local * (double)mesh->n_cell);
    const struct frame_source source = {
        .mesh = mesh, .level = level, .arrays = level->w, .halo = level->halo, .n_field = n_field};
    for (int pass = 0; pass < PASSES; pass++) {
        double start = seconds();
        gather_frames(&source, w);
        frames = least(frames, seconds() - start);
    }
    if (comm_rank() == 0)
        printf("%dD, %u fields, tiles of %d\n  frames, all axes: %.1f ns per cell\n", dim, n_field, n, frames * scale);
    for (int g = 1; g <= RIM_LAYERS; g++) {
        double start = seconds(), best = 1e9, exchange = 1e9;
        const struct patch_source patches = {.mesh = mesh,
                                             .level = level,
                                             .arrays = level->w,
                                             .rim = rim_of(mesh, 0, &(struct rim_form){n_field, g, 1, 0, NULL})};
        double made = seconds() - start;
        for (int pass = 0; pass < PASSES; pass++) {
            start = seconds();
            patch_start(&patches);
            patch_finish(&patches);
            exchange = least(exchange, seconds() - start);
            start = seconds();
            gather_patches(&patches, w);
            best = least(best, seconds() - start);
        }
        struct rim_bytes bytes = rim_size(patches.rim);
        double gathered = (double)rim_block(mesh, g, NULL).pitch / (double)mesh->n_cell;
        if (comm_rank() == 0)
            printf(
                "  patches, g = %d: %.1f ns per cell, %.2f per cell gathered; exchange %.1f; rim made in %.0f ns per "
                "tile, held %.0f bytes, sent %.0f bytes per tile\n",
                g, best * scale, best * scale / gathered, exchange * scale, 1e9 * made / level->n_local,
                (double)bytes.held / level->n_local, (double)bytes.same / level->n_local);
    }
    mem_free(w);
    mesh_free(mesh);
}

static int compare(const void *a, const void *b)
{
    uint64_t x = ((const struct tile *)a)->key, y = ((const struct tile *)b)->key;
    return (x > y) - (x < y);
}

/* Every fourth tile along the first axis is refined; fine tiles belong to the owner of the coarse one. */
static void refine(struct mesh *mesh)
{
    const struct level *coarse = &mesh->levels[0];
    const struct span span = {coarse->n_rank, 0, coarse->first_keys};
    struct nest_set all = {coarse->n_local, mem_new(coarse->n_local, sizeof *all.tiles)};
    if (all.n) memcpy(all.tiles, coarse->tiles + coarse->first, all.n * sizeof *all.tiles);
    replicated_join(&all);
    struct tile *tiles = mem_new((size_t)all.n << mesh->dim, sizeof *tiles);
    struct mesh_change change;
    unsigned n = 0;
    for (unsigned i = 0; i < all.n << mesh->dim; i++) {
        const struct tile *above = &all.tiles[i >> mesh->dim];
        if (above->at[0] % 4) continue;
        tiles[n].rank = span_owner(&span, above->key);
        for (int d = 0; d < mesh->dim; d++) tiles[n].at[d] = 2 * above->at[d] + (int)(i >> d & 1);
        tiles[n].key = morton_key(tiles[n].at);
        n++;
    }
    nest_keys_free_set(&all);
    qsort(tiles, n, sizeof *tiles, compare);
    replicated_replace(mesh, 1, tiles, n, &change);
    mesh_change_free(&change);
}

/* Pieces on the coarser level: planes of fine tiles, so that every coarse tile beside one makes as many. */
static void bench_levels(int dim, int tiles, int n, unsigned n_field)
{
    struct mesh *mesh = domain(dim, tiles, n, n_field);
    refine(mesh);
    for (int g = 1; g <= RIM_LAYERS; g++) {
        const struct rim_form form = {n_field, g, 2, 0, NULL};
        const struct level *level = &mesh->levels[0];
        const struct patch_source source = {.mesh = mesh,
                                            .level = level,
                                            .arrays = level->w,
                                            .rim = rim_of(mesh, 0, &form)};
        struct rim *fine = rim_of(mesh, 1, &form);
        double best = 1e9;
        unsigned makers = 0;
        for (unsigned t = 0; t < level->n_local; t++) makers += fine->source_from[t] < fine->source_from[t + 1];
        patch_start(&source);
        patch_finish(&source);
        for (int pass = 0; pass < PASSES; pass++) {
            double start = seconds();
            prolong_rim(&source, fine, 0, NULL);
            best = least(best, seconds() - start);
        }
        if (comm_rank() == 0)
            printf("%dD, %u fields, tiles of %d, g = %d: %u coarse tiles make %u pieces: %.0f ns per tile and slot\n",
                   dim, n_field, n, g, makers, fine->n_source, 1e9 * best / makers);
    }
    mesh_free(mesh);
}

int main(int argc, char **argv)
{
    comm_init(&argc, &argv);
    bench(2, 32, 16, 7);
    bench(2, 64, 8, 7);
    bench(3, 4, 16, 8);
    bench(3, 8, 8, 8);
    bench(2, 32, 16, 1);
    bench(3, 4, 16, 1);
    bench_levels(2, 16, 16, 7);
    bench_levels(3, 4, 16, 8);
    comm_done();
    return 0;
}
