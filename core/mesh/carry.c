/* carry.c - see carry.h. Lists follow the curve, and the key of a parent is that of its child without the last digit:
 * born tiles of one parent follow each other and ask once. */
#include "mesh/carry.h"

#include "base/mem.h"
#include "base/swap.h"
#include "mesh/span.h"

#include <math.h>

/* What is the number of this tile, if it was there? */
struct carry_question {
    uint64_t key;
    uint32_t level, born; /* born: which of those who ask */
};

/* Who asks: born tiles of one parent, from tile `first` of a level on. */
struct carry_questions {
    unsigned n_born;
    struct swap_list list; /* of struct carry_question */
};

/* Numbers of tiles that were there; NAN: it is born. */
static double *carry_kept(const struct nest_set *set, const struct carry *before)
{
    double *values = mem_new(set->n, sizeof *values);
    for (unsigned i = 0, old = 0; i < set->n; i++) {
        uint64_t key = set->tiles[i].key;
        while (old < before->n && before->tiles[old].key < key) old++;
        bool there = old < before->n && before->tiles[old].key == key;
        values[i] = there ? before->values[old] : NAN;
    }
    return values;
}

/* Is tile i born, and the first of its parent that is? Then *parent becomes its parent. */
static bool carry_first(const struct nest_set *set, const double *values, unsigned i, uint64_t *parent)
{
    if (!isnan(values[i]) || set->tiles[i].key >> 3 == *parent) return false;
    *parent = set->tiles[i].key >> 3;
    return true;
}

/* Born tiles ask for all that may be below them: which of it was there, only its owner knows. */
static void carry_list(const struct mesh *mesh, int base, int l, const struct nest_set *set, const double *values,
                       struct carry_questions *questions)
{
    uint64_t parent = UINT64_MAX;
    for (unsigned i = 0; i < set->n; i++) {
        if (!carry_first(set, values, i, &parent)) continue;
        for (int m = l - 1 < mesh->n_level ? l - 1 : mesh->n_level - 1; m >= base; m--) {
            struct span span = span_of(mesh, m);
            const struct carry_question question = {set->tiles[i].key >> 3 * (l - m), (uint32_t)m, questions->n_born};
            swap_add(&questions->list, &question, sizeof question, span_owner(&span, question.key));
        }
        questions->n_born++;
    }
}

/* NAN: no such tile was there. */
static double carry_look(const struct carry *before, uint64_t key)
{
    unsigned low = 0, high = before->n;
    while (low < high) {
        unsigned middle = low + (high - low) / 2;
        if (before->tiles[middle].key < key) low = middle + 1;
        else high = middle;
    }
    return low < before->n && before->tiles[low].key == key ? before->values[low] : (double)NAN;
}

/* For each of those who ask the number of the finest tile that was there. */
static double *carry_answers(struct carry_questions *questions, const struct carry *before)
{
    struct swap asked;
    const struct swap_list *list = &questions->list;
    const struct carry_question *own = list->items;
    swap_sort(list->items, sizeof *own, list->n, list->to);
    swap_items(list->items, sizeof *own, list->n, list->to, &asked);
    const struct carry_question *question = asked.items;
    double *found = mem_new(asked.n, sizeof *found), *best = mem_new(questions->n_born, sizeof *best);
    int *level = mem_new(questions->n_born, sizeof *level);
    for (unsigned i = 0; i < asked.n; i++) found[i] = carry_look(&before[question[i].level], question[i].key);
    double *answers = swap_answer(&asked, found, sizeof *found);
    for (unsigned i = 0; i < questions->n_born; i++) level[i] = -1;
    for (unsigned i = 0; i < list->n; i++, own++) {
        if (isnan(answers[i]) || (int)own->level <= level[own->born]) continue;
        level[own->born] = (int)own->level;
        best[own->born] = answers[i];
    }
    mem_free(answers);
    mem_free(level);
    mem_free(found);
    swap_done(&asked);
    return best;
}

void carry_values(const struct mesh *mesh, int base, int highest, const struct nest_set *sets,
                  const struct carry *before, double **ret_values)
{
    struct carry_questions questions = {0};
    for (int l = base + 1; l <= highest; l++) {
        ret_values[l] = carry_kept(&sets[l], &before[l]);
        carry_list(mesh, base, l, &sets[l], ret_values[l], &questions);
    }
    double *answers = carry_answers(&questions, before);
    unsigned next = 0; /* of those who have asked */
    for (int l = base + 1; l <= highest; l++) {
        uint64_t parent = UINT64_MAX;
        for (unsigned i = 0; i < sets[l].n; i++) {
            next += carry_first(&sets[l], ret_values[l], i, &parent);
            if (isnan(ret_values[l][i])) ret_values[l][i] = answers[next - 1];
        }
    }
    mem_free(answers);
    swap_list_free(&questions.list);
}
