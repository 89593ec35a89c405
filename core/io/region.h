/* region.h - how much of each cell a `where:` covers, computed once for each tile of a mesh. */
#ifndef REGION_H
#define REGION_H

#include "mesh/mesh.h"

struct region;

/* For the local tiles of all levels. The shape must outlive the region. */
struct region *region_new(const struct mesh *mesh, const struct shape *shape);
void region_free(struct region *region); /* NULL is fine */

/* To be called before region_tile when tiles may have changed: measures those that are new here. NULL is fine. */
void region_follow(struct region *region, const struct mesh *mesh);

enum region_cover { REGION_NONE, REGION_ALL, REGION_PART };

/* How a region covers local tile `local` of a level; REGION_PART: the fraction of each cell too. */
enum region_cover region_tile(const struct region *region, int level, unsigned local, const double **ret_fractions);

#endif
