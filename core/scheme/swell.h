/* swell.h - volume that heat and mass ask for where they arrive, so that the materials of a cell keep one pressure.
 *
 * A material that gets a power q_l per own volume, or mass, would have another pressure than its neighbours in the
 * cell. With the compliances s_l = alpha_l/(rho_l c_l^2), S = sum s_l, volume moves between them as in exchange.h: d
 * alpha_l/dt = e_l - s_l/S sum_k e_k,   e_l = s_l q_l/(d rho_l e_l/dp) + (mass source)/rho_l. Without it half water,
 * half air gains two thousand times too much pressure from heat in the water (docs/numerics.md, sources). Energy itself
 * is added by who brings it; this moves volume only. */
#ifndef SWELL_H
#define SWELL_H

#include "scheme/term.h"

enum { SWELL_BATCH = 256 };

/* In super steps (TERM_DIFFUSION, solve/flow.h) no volume moves: the rows of fractions get the power of each material
 * [W/m3 of the cell], and phys/warm.h makes the fractions of a stage from its sum. */
static inline bool swell_waits(const struct term_tile *tile)
{
    return tile->part == TERM_DIFFUSION;
}

/* A batch of cells of one tile. */
struct swell {
    const struct model *path;
    size_t n;
    double own[SCENE_MATERIALS][SWELL_BATCH];        /* e_l */
    double compliance[SCENE_MATERIALS][SWELL_BATCH]; /* s_l */
    double sum[SWELL_BATCH], all[SWELL_BATCH];       /* over the materials */
};

void swell_begin(struct swell *swell, const struct model *path, size_t n);

/* What material l gets: heat [W/m3 of its own volume], mass [kg/m3/s of the cell], or NULL; alpha, rho_l, p_l and rho_l
 * c_l^2 of the cells. Rows of n. Every material of the path once. */
void swell_material(struct swell *swell, unsigned l, const double *alpha, const double *rho, const double *p,
                    const double *rho_c2, const double *heat, const double *mass);

/* Volume that material l brought along by itself [1/s], after swell_material of it: also where it was not before. */
void swell_volume(struct swell *swell, unsigned l, const double *volume);

/* Adds to the rates of the tile, from cell `from` on: d alpha_l/dt, and p (the common traction, in models that are
 * split) times it to what volume carries (exchange.h), which stays as it is. For paths with Kapila's closure. */
void swell_share(const struct swell *swell, const struct term_tile *tile, size_t from);

#endif
