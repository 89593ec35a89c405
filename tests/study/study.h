/* study.h - a tile set under study: its mesh, who neighbours whom, what its tiles cost, and cuts of it. */
#ifndef STUDY_H
#define STUDY_H

#include "sets.h"
#include "traffic.h"

struct study {
    struct sets_scene scene;
    struct mesh mesh;
    struct traffic_graph graphs[MESH_LEVELS];
    double *costs[MESH_LEVELS];
    double tiles;
    double topology; /* seconds per tile and regrid: what every rank does */
};

/* Makes the sets of a scene in tiles of n cells (the same cells, whatever n); ends the program if they do not nest. */
void study_start(struct study *study, struct sets_scene scene, int n);
void study_stop(struct study *study);

/* Owners by a cut of each level, as the mesh does it. */
void study_cut_levels(struct study *study, int size);

/* The same, but levels with fewer tiles than ranks in pieces of k tiles, spread evenly over the ranks. */
void study_cut_coarse(struct study *study, int size, int k);

/* Largest over mean load of a level with the owners that its tiles have, less 1. */
double study_imbalance(const struct tile *tiles, unsigned n, const double *costs, int size);

/* For comparison: one curve through all levels, each tile weighted by its steps. */
void study_cut_curve(struct study *study, int size);

struct traffic study_count(const struct study *study, int size);

/* Ideal over real compute time of a coarse step, each sub-step of each level waiting for its slowest rank. */
double study_efficiency(const struct study *study, const struct traffic *traffic);

/* Steps of tiles of cost 1 in a coarse step. */
double study_work(const struct study *study);

#endif
