/* study.c - see study.h. */
#include "study.h"

#include "../unit/replicated.h"
#include "base/mem.h"
#include "base/status.h"
#include "mesh/level.h"
#include "mesh/partition.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>

void study_start(struct study *study, struct sets_scene scene, int n)
{
    *study = (struct study){.scene = scene};
    study->scene.base = scene.base * scene.n / n; /* the same cells in other tiles */
    study->scene.n = n;
    sets_make(&study->scene, &study->mesh);
    study->mesh.n_field = 5 + (unsigned)scene.dim; /* two materials: alpha, m; momentum, energy */
    if (nest_check(&study->mesh)) {
        fprintf(stderr, "%s\n", status_text());
        exit(1);
    }
    for (int l = 0; l < study->mesh.n_level; l++) {
        study->graphs[l] = traffic_connect(&study->mesh, l);
        study->costs[l] = sets_costs(&study->scene, &study->mesh, l);
        study->tiles += study->mesh.levels[l].n_tile;
    }
}

void study_stop(struct study *study)
{
    for (int l = 0; l < study->mesh.n_level; l++) {
        traffic_free_graph(&study->graphs[l]);
        mem_free(study->costs[l]);
        level_drop(&study->mesh.levels[l]);
    }
}

static void study_cut(struct tile *tiles, unsigned n, const double *costs, int size, uint64_t weight, uint64_t *load)
{
    struct partition_runs runs = {0};
    uint32_t *first = mem_new((size_t)size + 1, sizeof *first);
    for (unsigned i = 0; i < n; i++) partition_add(&runs, 1, partition_units(costs[i]));
    partition_cut(&runs, size, weight, load, first);
    replicated_give(tiles, size, first);
    partition_free(&runs);
    mem_free(first);
}

void study_cut_levels(struct study *study, int size)
{
    uint64_t *load = mem_new((size_t)size, sizeof *load);
    for (int l = 0; l < study->mesh.n_level; l++) {
        struct level *level = &study->mesh.levels[l];
        study_cut(level->tiles, level->n_tile, study->costs[l], size, (uint64_t)1 << l, load);
    }
    mem_free(load);
}

void study_cut_coarse(struct study *study, int size, int k)
{
    uint64_t *load = mem_new((size_t)size, sizeof *load);
    study_cut_levels(study, size);
    for (int l = 0; l < study->mesh.n_level; l++) {
        struct level *level = &study->mesh.levels[l];
        int n = (int)level->n_tile, pieces = n > k ? n / k : 1;
        if (n >= size) continue;
        for (int r = 0; r < pieces; r++) load[r] = 0;
        study_cut(level->tiles, level->n_tile, study->costs[l], pieces, 1, load);
        for (int i = 0; i < n; i++) level->tiles[i].rank = (int)((long long)level->tiles[i].rank * size / pieces);
    }
    mem_free(load);
}

double study_imbalance(const struct tile *tiles, unsigned n, const double *costs, int size)
{
    uint64_t *load = mem_new((size_t)size, sizeof *load);
    for (unsigned i = 0; i < n; i++) load[tiles[i].rank] += partition_units(costs[i]);
    double imbalance = partition_imbalance(load, n, size);
    mem_free(load);
    return imbalance;
}

/* A tile on the one curve through all levels: by its first descendant on the finest, coarser tiles first. */
struct study_place {
    uint64_t key;
    int level;
    unsigned index;
};

static int study_compare_places(const void *a, const void *b)
{
    const struct study_place *x = a, *y = b;
    if (x->key != y->key) return x->key < y->key ? -1 : 1;
    return x->level - y->level;
}

void study_cut_curve(struct study *study, int size)
{
    size_t n = (size_t)study->tiles, count = 0;
    struct study_place *places = mem_new(n, sizeof *places);
    struct tile *tiles = mem_new(n, sizeof *tiles);
    double *costs = mem_new(n, sizeof *costs);
    uint64_t *load = mem_new((size_t)size, sizeof *load);
    int finest = study->mesh.n_level - 1;
    for (int l = 0; l <= finest; l++)
        for (unsigned i = 0; i < study->mesh.levels[l].n_tile; i++)
            places[count++] = (struct study_place){study->mesh.levels[l].tiles[i].key << 3 * (finest - l), l, i};
    qsort(places, n, sizeof *places, study_compare_places);
    for (size_t i = 0; i < n; i++) costs[i] = ldexp(study->costs[places[i].level][places[i].index], places[i].level);
    study_cut(tiles, (unsigned)n, costs, size, 1, load);
    for (size_t i = 0; i < n; i++) study->mesh.levels[places[i].level].tiles[places[i].index].rank = tiles[i].rank;
    mem_free(places);
    mem_free(tiles);
    mem_free(costs);
    mem_free(load);
}

struct traffic study_count(const struct study *study, int size)
{
    struct traffic traffic;
    traffic_count(&study->mesh, study->graphs, study->costs, size, &traffic);
    return traffic;
}

double study_efficiency(const struct study *study, const struct traffic *traffic)
{
    double mean = 0.0, most = 0.0;
    for (int l = 0; l < study->mesh.n_level; l++) {
        mean += ldexp(traffic->mean[l], l);
        most += ldexp(traffic->most[l], l);
    }
    return mean / most;
}

double study_work(const struct study *study)
{
    double cost = 0.0;
    for (int l = 0; l < study->mesh.n_level; l++)
        for (unsigned i = 0; i < study->mesh.levels[l].n_tile; i++) cost += ldexp(study->costs[l][i], l);
    return cost;
}
