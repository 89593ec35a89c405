/* moves.c - see moves.h. */
#include "moves.h"

#include "base/mem.h"
#include "mesh/level.h"
#include "mesh/partition.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

enum { MOVES_REGRIDS = 6 };

/* Owners as before, born tiles with those before them on the curve: if that balances within the slack of what a new
 * cut reaches. Both orders are merged; `level` has been cut anew. */
static void moves_keep(struct level *level, const struct level *old, const double *costs, int size)
{
    struct tile *kept = mem_new(level->n_tile, sizeof *kept);
    int rank = 0;
    for (unsigned i = 0, j = 0; i < level->n_tile; i++) {
        kept[i] = level->tiles[i];
        while (j < old->n_tile && old->tiles[j].key < kept[i].key) j++;
        if (j < old->n_tile && old->tiles[j].key == kept[i].key) rank = old->tiles[j].rank;
        kept[i].rank = rank;
    }
    double anew = 1.0 + study_imbalance(level->tiles, level->n_tile, costs, size);
    if (1.0 + study_imbalance(kept, level->n_tile, costs, size) <= (1.0 + PARTITION_SLACK) * anew)
        memcpy(level->tiles, kept, level->n_tile * sizeof *kept);
    mem_free(kept);
}

struct moves {
    double born, moved, away, tiles; /* away: to another node */
};

static void moves_add(const struct study *before, const struct study *after, struct moves *moves)
{
    for (int l = 1; l < after->mesh.n_level; l++)
        for (unsigned i = 0; i < after->mesh.levels[l].n_tile; i++) {
            const struct tile *tile = &after->mesh.levels[l].tiles[i];
            int index = level_find(&before->mesh.levels[l], tile->key);
            int rank = index < 0 ? tile->rank : before->mesh.levels[l].tiles[index].rank;
            moves->tiles += 1.0;
            moves->born += index < 0;
            moves->moved += rank != tile->rank;
            moves->away += rank / TRAFFIC_NODE != tile->rank / TRAFFIC_NODE;
        }
}

void moves_print(const struct study *study, int size, bool keep)
{
    struct moves moves = {0};
    double efficiency = 0.0;
    struct sets_scene scene = study->scene;
    struct study before, after;
    study_start(&before, scene, scene.n);
    study_cut_levels(&before, size);
    for (int regrid = 0; regrid < MOVES_REGRIDS; regrid++) {
        for (int f = 0; f < scene.n_feature; f++)
            scene.features[f].radius += ldexp(SETS_BUFFER * 2.0 / (scene.base * scene.n), -scene.features[f].finest);
        study_start(&after, scene, scene.n);
        study_cut_levels(&after, size);
        for (int l = 0; keep && l < after.mesh.n_level; l++)
            moves_keep(&after.mesh.levels[l], &before.mesh.levels[l], after.costs[l], size);
        moves_add(&before, &after, &moves);
        struct traffic traffic = study_count(&after, size);
        efficiency += study_efficiency(&after, &traffic) / MOVES_REGRIDS;
        study_stop(&before);
        before = after;
    }
    study_stop(&before);
    printf("| %s %dD, %d | %d | %s | %.3f | %.3f | %.3f | %.3f |\n", scene.name, scene.dim, scene.n, size,
           keep ? "kept" : "anew", moves.born / moves.tiles, moves.moved / moves.tiles, moves.away / moves.tiles,
           efficiency);
}
