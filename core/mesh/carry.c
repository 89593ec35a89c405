/* carry.c - see carry.h. All lists follow the curve, and the key of a parent is that of its child without the last digit:
 * each is walked once. */
#include "mesh/carry.h"

#include "base/mem.h"
#include "base/swap.h"
#include "mesh/span.h"

#include <math.h>

/* Numbers of tiles that were there; NAN: it is born. Counts the parents of born ones. */
static double *carry_kept(const struct nest_set *set, const struct carry *before, unsigned *ret_parents)
{
    double *values = mem_new(set->n, sizeof *values);
    uint64_t parent = UINT64_MAX;
    *ret_parents = 0;
    for (unsigned i = 0, old = 0; i < set->n; i++) {
        uint64_t key = set->tiles[i].key;
        while (old < before->n && before->tiles[old].key < key) old++;
        bool there = old < before->n && before->tiles[old].key == key;
        values[i] = there ? before->values[old] : NAN;
        if (there || key >> 3 == parent) continue;
        parent = key >> 3;
        ++*ret_parents;
    }
    return values;
}

/* What the ranks have asked for. Within a piece keys ascend. */
static double *carry_answers(const struct swap *asked, const struct carry *below)
{
    const uint64_t *keys = asked->items;
    double *answers = mem_new(asked->n, sizeof *answers);
    for (unsigned p = 0, i = 0; p < asked->n_piece; p++)
        for (unsigned k = 0, tile = 0; k < asked->pieces[p].n; k++, i++) {
            while (tile < below->n && below->tiles[tile].key < keys[i]) tile++;
            answers[i] = below->values[tile];
        }
    return answers;
}

double *carry_values(const struct mesh *mesh, int l, const struct nest_set *set, const struct carry *before,
                     const struct carry *below)
{
    struct span span = span_of(mesh, l - 1);
    struct swap asked;
    unsigned n, count = 0;
    double *values = carry_kept(set, before, &n);
    uint64_t *parents = mem_new(n, sizeof *parents);
    int *to = mem_new(n, sizeof *to);
    for (unsigned i = 0; i < set->n; i++) {
        uint64_t parent = set->tiles[i].key >> 3;
        if (!isnan(values[i]) || (count && parents[count - 1] == parent)) continue;
        to[count] = count && span_holds(&span, to[count - 1], parent) ? to[count - 1] : span_owner(&span, parent);
        parents[count++] = parent;
    }
    swap_items(parents, sizeof *parents, count, to, &asked);
    double *found = carry_answers(&asked, below), *answers = swap_answer(&asked, found, sizeof *found);
    for (unsigned i = 0, parent = 0; i < set->n; i++) {
        if (!isnan(values[i])) continue;
        while (parents[parent] != set->tiles[i].key >> 3) parent++;
        values[i] = answers[parent];
    }
    mem_free(answers);
    mem_free(found);
    swap_done(&asked);
    mem_free(to);
    mem_free(parents);
    return values;
}
