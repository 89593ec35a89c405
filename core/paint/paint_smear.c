/* paint_smear.c - see paint_smear.h. */
#include "paint/paint_smear.h"

#include "base/mem.h"
#include "phys/phase_pair.h"

#include <math.h>
#include <string.h>

/* Of the smaller one of two cells. So much starts bubbles as well as more does, and disturbs a layer of heat that a
 * case begins with less. */
#define PAINT_SMEAR_PART 0.05

bool paint_smear_is(const struct model *model)
{
    const struct scene *scene = model->scene;
    for (unsigned i = 0; i < scene->n_layer; i++)
        if (scene->layers[i].checkpoint) return false;
    return model->fronts && model->conducts;
}

/* Vapour and gases of pair k in a cell that holds nothing but the pair; -1 in others. */
static double paint_smear_thin(const struct paint_smear *box, unsigned k, size_t cell)
{
    const struct model_phase *phase = &box->model->phases[k];
    const double *alpha = box->u + box->model->i_alpha * box->n_cell + cell;
    double thin = 0.0, liquid = alpha[phase->member[0] * box->n_cell];
    for (unsigned j = 1; j < phase->n; j++) thin += alpha[phase->member[j] * box->n_cell];
    return liquid + thin > 1.0 - PHASE_PAIR_FELT ? thin : -1.0;
}

/* Do two cells change contents? */
static bool paint_smear_meets(const struct paint_smear *box, size_t a, size_t b)
{
    bool meets = false;
    for (unsigned k = 0; k < box->model->n_phase; k++) {
        double one = paint_smear_thin(box, k, a), other = paint_smear_thin(box, k, b);
        bool both = one >= 0.0 && other >= 0.0 && fabs(one - other) > PHASE_PAIR_FELT;
        meets = meets || (both && box->model->phases[k].scene->onset > 0.0);
    }
    return meets;
}

/* Volume of cell i along an axis, but for what all cells of its row have in common. */
static double paint_smear_volume(const struct paint_smear *box, int axis, int i)
{
    int power = axis == 0 ? box->beta + 1 : 1;
    return fabs(pow(box->edges[axis][i + 1], power) - pow(box->edges[axis][i], power));
}

/* The part of cell i that comes from its neighbour `side` (-1, 1) along the axis. */
static double paint_smear_share(const struct paint_smear *box, int axis, size_t cell, size_t step, int i, int side)
{
    if (i + side < 0 || i + side >= box->n[axis]) return 0.0;
    if (!paint_smear_meets(box, cell, side < 0 ? cell - step : cell + step)) return 0.0;
    double own = paint_smear_volume(box, axis, i), other = paint_smear_volume(box, axis, i + side);
    return PAINT_SMEAR_PART * (own < other ? own : other) / own;
}

/* Along one axis; part: 2 n_cell doubles to work with, row: n_cell. */
static void paint_smear_axis(const struct paint_smear *box, int axis, size_t step, double *part, double *row)
{
    size_t n = box->n_cell;
    for (size_t c = 0; c < n; c++) {
        int i = (int)(c / step % (size_t)box->n[axis]);
        part[c] = paint_smear_share(box, axis, c, step, i, -1);
        part[n + c] = paint_smear_share(box, axis, c, step, i, 1);
    }
    for (unsigned q = 0; q < box->model->i_V; q++) {
        double *u = box->u + q * n;
        memcpy(row, u, n * sizeof *row);
        for (size_t c = 0; c < n; c++) {
            double below = part[c] > 0.0 ? part[c] * (row[c - step] - row[c]) : 0.0;
            double above = part[n + c] > 0.0 ? part[n + c] * (row[c + step] - row[c]) : 0.0;
            u[c] = row[c] + (below + above);
        }
    }
}

void paint_smear(const struct paint_smear *box)
{
    size_t step = 1;
    double *part = mem_new(3 * box->n_cell, sizeof *part);
    for (int axis = 0; axis < box->dim; step *= (size_t)box->n[axis++])
        paint_smear_axis(box, axis, step, part, part + 2 * box->n_cell);
    mem_free(part);
}
