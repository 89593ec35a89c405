/* tag_pair.c - see tag_pair.h.
 *
 * A difference is judged once per pair of cells and marks both: |a - b| is the same number from either side, so the
 * marks of a mirrored or turned state are the mirrored or turned marks to the bit. Pairs inside of a tile are
 * compared along the whole tile at once, whatever the axis; pairs that would wrap around a row are taken out again.
 * Most tiles are never looked at a second time: the least and the largest value of a tile and its neighbour bound all
 * of their differences, exactly, since rounding is monotone. */
#include "solve/tag_pair.h"

#include <math.h>

/* Does a pair exceed the rule? */
static inline double tag_pair_exceeds(double a, double b, double above, bool relative)
{
    double size_a = fabs(a), size_b = fabs(b), larger = size_a > size_b ? size_a : size_b;
    return fabs(a - b) > (relative ? above * larger : above) ? 1.0 : 0.0;
}

/* Pairs of cells along an axis inside of a tile. */
static void tag_pair_inside(const struct tag_pair *pair, int axis, const struct tag_pair_rule *rule,
                            const double *restrict values, double *restrict found)
{
    size_t n = (size_t)pair->mesh->n[axis], inner = 1;
    for (int d = 0; d < axis; d++) inner *= (size_t)pair->mesh->n[d];
    size_t count = pair->mesh->n_cell - inner;
    double above = rule->above[axis], *restrict step = pair->step;
    if (rule->relative)
        for (size_t i = 0; i < count; i++) step[i] = tag_pair_exceeds(values[i], values[i + inner], above, true);
    else
        for (size_t i = 0; i < count; i++) step[i] = tag_pair_exceeds(values[i], values[i + inner], above, false);
    for (size_t last = (n - 1) * inner; last < count; last += n * inner)
        for (size_t j = 0; j < inner; j++) step[last + j] = 0.0;
    for (size_t i = 0; i < count; i++) found[i] += step[i];
    for (size_t i = 0; i < count; i++) found[i + inner] += step[i];
}

/* Pairs across a face: the cells of this tile are judged, those behind belong to whoever owns them. */
static void tag_pair_across(const struct tag_pair *pair, unsigned local, int face, const struct tag_pair_rule *rule,
                            double *const *values, double *found)
{
    const struct neighbour *neighbour = &pair->level->neighbours[local][face];
    bool remote = neighbour->kind == NEIGHBOUR_REMOTE;
    int axis = face / 2, side = face % 2;
    size_t n = (size_t)pair->mesh->n[axis], inner = 1;
    for (int d = 0; d < axis; d++) inner *= (size_t)pair->mesh->n[d];
    size_t outer = pair->mesh->n_cell / n / inner, depth = remote ? (size_t)pair->mesh->ghosts : n;
    const double *own = values[local] + (side ? n - 1 : 0) * inner;
    const double *other = remote ? halo_slab(pair->halo, neighbour->index) : values[neighbour->index];
    other += (side ? 0 : depth - 1) * inner;
    double *to = found + (own - values[local]);
    for (size_t o = 0; o < outer; o++)
        for (size_t j = 0; j < inner; j++)
            to[o * n * inner + j] += tag_pair_exceeds(own[o * n * inner + j], other[o * depth * inner + j],
                                                      rule->above[axis], rule->relative);
}

/* In lanes of their own, so that the compiler may take several values at a time. */
struct tag_pair_bounds tag_pair_bounds_of(size_t n, const double *values)
{
    enum { LANES = 4 };
    double least[LANES], most[LANES];
    size_t i = 0;
    for (size_t k = 0; k < LANES; k++) least[k] = most[k] = values[0];
    for (; i + LANES <= n; i += LANES)
        for (size_t k = 0; k < LANES; k++) {
            least[k] = values[i + k] < least[k] ? values[i + k] : least[k];
            most[k] = values[i + k] > most[k] ? values[i + k] : most[k];
        }
    for (; i < n; i++) {
        least[0] = values[i] < least[0] ? values[i] : least[0];
        most[0] = values[i] > most[0] ? values[i] : most[0];
    }
    for (size_t k = 1; k < LANES; k++) {
        least[0] = least[k] < least[0] ? least[k] : least[0];
        most[0] = most[k] > most[0] ? most[k] : most[0];
    }
    return (struct tag_pair_bounds){least[0], most[0]};
}

/* Can no two values within the bounds exceed the rule along an axis? */
static bool tag_pair_is_flat(const struct tag_pair_rule *rule, int axis, struct tag_pair_bounds bounds)
{
    double size = bounds.least > 0.0 ? bounds.least : bounds.most < 0.0 ? -bounds.most : 0.0; /* least magnitude */
    return bounds.most - bounds.least <= (rule->relative ? rule->above[axis] * size : rule->above[axis]);
}

/* The same for the tile and what lies behind a face. */
static bool tag_pair_is_flat_across(const struct tag_pair *pair, unsigned local, int face,
                                    const struct tag_pair_rule *rule, const struct tag_pair_bounds *bounds)
{
    const struct neighbour *neighbour = &pair->level->neighbours[local][face];
    struct tag_pair_bounds both = bounds[local], other;
    if (neighbour->kind != NEIGHBOUR_LOCAL) return neighbour->kind != NEIGHBOUR_REMOTE;
    other = bounds[neighbour->index];
    both.least = other.least < both.least ? other.least : both.least;
    both.most = other.most > both.most ? other.most : both.most;
    return tag_pair_is_flat(rule, face / 2, both);
}

bool tag_pair_is_smooth(const struct tag_pair *pair, const struct tag_pair_rule *rule, struct tag_pair_bounds bounds)
{
    for (int axis = 0; axis < pair->mesh->dim; axis++)
        if (!tag_pair_is_flat(rule, axis, bounds)) return false;
    return true;
}

void tag_pair_needs(const struct tag_pair *pair, unsigned local, const struct tag_pair_rule *rule,
                    const struct tag_pair_bounds *bounds, bool *need)
{
    if (!tag_pair_is_smooth(pair, rule, bounds[local])) need[local] = true;
    for (int face = 0; face < 2 * pair->mesh->dim; face++) {
        const struct neighbour *neighbour = &pair->level->neighbours[local][face];
        if (tag_pair_is_flat_across(pair, local, face, rule, bounds)) continue;
        need[local] = true;
        if (neighbour->kind == NEIGHBOUR_LOCAL) need[neighbour->index] = true;
    }
}

bool tag_pair_differ(const struct tag_pair *pair, unsigned local, const struct tag_pair_rule *rule,
                     double *const *values, const struct tag_pair_bounds *bounds, double *found)
{
    bool any = false;
    for (int axis = 0; axis < pair->mesh->dim; axis++) {
        bool inside = !tag_pair_is_flat(rule, axis, bounds[local]);
        if (inside) tag_pair_inside(pair, axis, rule, values[local], found);
        any |= inside;
        for (int face = 2 * axis; face < 2 * axis + 2; face++) {
            bool flat = tag_pair_is_flat_across(pair, local, face, rule, bounds);
            if (!flat) tag_pair_across(pair, local, face, rule, values, found);
            any |= !flat;
        }
    }
    return any;
}
