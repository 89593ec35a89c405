/* prolong_cell.c - see prolong_cell.h.
 *
 * Ranges are widened by what is noise: round-off on the scale of rho c and rho c^2 (in a stiff liquid p is a small
 * difference of large numbers), fractions that do not matter, and for p the energy of motion and of strain between the
 * children, which a conservative interpolation of momentum and energy takes from p: without it a shear flow or a bent
 * solid at uniform p would get no slopes. A fraction or partial density never falls below half its least neighbour, so
 * that absent stays absent. */
#include "levels/prolong_cell.h"

#include "phys/bearing.h"
#include "phys/elastic.h"
#include "phys/mix.h"

#include <math.h>
#include <string.h>

/* Round-off, relative to rho c^2 and rho c: 1e-4 of a pascal in a gas, 0.2 Pa in water. */
#define CELL_ROUND_OFF 1e-10

/* Fractions this small, and materials of less than this fraction, limit nobody else. */
#define CELL_TRACE 1e-6

/* A partial density below zero by less than this times rho is what the step leaves behind fronts of traces. */
#define CELL_DEFICIT 1e-8

/* Part of |p| by which the energy of motion and strain may move p out of its range. */
#define CELL_PART 0.1

struct prolong_cell_range {
    double low, high;
};

static void prolong_cell_widen(struct prolong_cell_range *range, double value)
{
    range->low = value < range->low ? value : range->low;
    range->high = value > range->high ? value : range->high;
}

/* Of a component over the coarse cell and its face neighbours; with `weight`, where that is positive. */
static struct prolong_cell_range prolong_cell_range(const struct prolong_cells *source, size_t at, const double *values,
                                                    const double *weight)
{
    struct prolong_cell_range range = {HUGE_VAL, -HUGE_VAL};
    for (int axis = 0; axis < source->model->dim; axis++)
        for (int step = -1; step <= 1; step++) {
            size_t cell = step < 0 ? at - source->stride[axis] : at + (size_t)step * source->stride[axis];
            if (!weight || weight[cell] > 0.0) prolong_cell_widen(&range, values[cell]);
        }
    return range;
}

/* What a field may leave its range by. */
static double prolong_cell_slack(const struct prolong_cells *source, size_t at, unsigned q)
{
    const struct model *model = source->model;
    double stiffness = source->rho_c2[at], rho = 0.0;
    if (q >= model->i_V) return CELL_ROUND_OFF;
    if (model->n_alpha && q < model->i_m) return CELL_TRACE;
    if (model->n_alpha && q < model->i_u) return CELL_TRACE * source->w[q * source->pitch + at];
    for (unsigned l = 0; l < model->n_material; l++) rho += source->u[(model->i_m + l) * source->pitch + at];
    if (q < model->i_u || model_is_inner(model, q)) return CELL_ROUND_OFF * rho;
    return CELL_ROUND_OFF * (q < model->i_E ? sqrt(rho * stiffness) : stiffness);
}

/* Difference of the neighbours along each axis, of each field. */
typedef double cell_difference[PROLONG_FIELDS][3];

/* Largest phi that keeps field q of all children in its range. */
static double prolong_cell_share(const struct prolong_cells *source, size_t at, unsigned q, double mean,
                                 const double give[3][2], const double difference[3])
{
    struct prolong_cell_range range = prolong_cell_range(source, at, source->u + q * source->pitch, NULL);
    double slack = prolong_cell_slack(source, at, q), up = 0.0, down = 0.0, phi = 1.0;
    prolong_cell_widen(&range, mean);
    bool positive = (q < source->model->i_u || model_is_inner(source->model, q)) && range.low >= 0.0;
    double low = range.low - slack, high = range.high + slack;
    if (positive && low < 0.5 * range.low) low = 0.5 * range.low;
    for (int axis = 0; axis < source->model->dim; axis++) {
        double a = give[axis][0] * difference[axis], b = give[axis][1] * difference[axis];
        up += a > b ? a : b;
        down += a < b ? a : b;
    }
    if (up > high - mean) phi = (high - mean) / up;
    if (down < low - mean && (low - mean) / down < phi) phi = (low - mean) / down;
    return phi;
}

/* give times the differences along all axes: mirrors and the exchange of x and y keep the bits. */
static double prolong_cell_step(const double give[3][2], const double difference[3], int o)
{
    double x = give[0][o & 1] * difference[0], y = give[1][o >> 1 & 1] * difference[1];
    return (x + y) + give[2][o >> 2] * difference[2];
}

/* Children whose volumes have a lever get the mean back by those. */
static void prolong_cell_turn(const struct prolong_cells *source, double mean, struct prolong_children *ret)
{
    double *child = ret->u[source->model->i_u + 2], column[2] = {0.0, 0.0};
    int n = 1 << source->model->dim;
    for (int o = 0; o < n; o++) column[o & 1] += child[o] / (0.5 * n);
    double has = column[0] + source->turn * (column[1] - column[0]);
    for (int o = 0; o < n; o++) child[o] += mean - has;
}

/* Mean and slopes. What must not be negative may have become so by a rounding. */
static void prolong_cell_fill(const struct prolong_cells *source, const double *mean, const cell_difference difference,
                              const double give[3][2], double phi, struct prolong_children *ret)
{
    const struct model *model = source->model;
    unsigned sloped = model->n_field - model_renewed(model);
    for (unsigned q = 0; q < model->n_field; q++)
        for (int o = 0; o < 1 << model->dim; o++) {
            double share = q < sloped ? phi : 0.0;
            double value = mean[q] + share * prolong_cell_step(give, difference[q], o);
            bool positive = q < model->i_u || model_is_inner(model, q);
            ret->u[q][o] = positive && mean[q] >= 0.0 && value < 0.0 ? 0.0 : value;
        }
    if (model_turns(model)) prolong_cell_turn(source, mean[model->i_u + 2], ret);
    elastic_settle(model, (size_t)1 << model->dim, PROLONG_CHILDREN, ret->u[0]);
}

static void prolong_cell_differ(const struct prolong_cells *source, const double *values, double ret_difference[3])
{
    for (int axis = 0; axis < 3; axis++)
        ret_difference[axis] = values[source->stride[axis]] - *(values - source->stride[axis]);
}

/* The children's elastic energy against that of the coarse cells, interpolated as the total energy is. */
static void prolong_cell_strain(const struct prolong_cells *source, size_t at, const double give[3][2], double phi,
                                struct prolong_children *children)
{
    const struct model *model = source->model;
    double difference[3], energy[PROLONG_CHILDREN], left[SCENE_MATERIALS * PROLONG_CHILDREN];
    const double *m[SCENE_MATERIALS];
    memset(children->strain, 0, sizeof children->strain);
    if (!source->elastic) return;
    for (unsigned s = 0; s < model->n_solid; s++) m[s] = children->u[model->i_m + model->solids[s].material];
    bearing_of_conserved(model, (size_t)1 << model->dim, PROLONG_CHILDREN, children->u[0], PROLONG_CHILDREN, left, m);
    elastic_energy(model, (size_t)1 << model->dim, PROLONG_CHILDREN, children->u[model->i_V], m, energy);
    prolong_cell_differ(source, source->elastic + at, difference);
    for (int o = 0; o < 1 << model->dim; o++)
        children->strain[o] = fabs(energy[o] - (source->elastic[at] + phi * prolong_cell_step(give, difference, o)));
}

/* Is rho_l of child o within its range, and the material well-posed? */
static bool prolong_cell_material(const struct prolong_cells *source, size_t at, unsigned l, int o, double rho_c2,
                                  const struct prolong_children *children)
{
    const struct model *model = source->model;
    const double *weight = model->n_alpha ? source->w + (model->i_alpha + l) * source->pitch : NULL;
    double alpha = model->n_alpha ? children->w[model->i_alpha + l][o] : 1.0, rho = children->w[model->i_m + l][o];
    if (alpha > CELL_TRACE && !(rho_c2 > 0.0)) return false;
    if (!(alpha > 0.0)) return true;
    struct prolong_cell_range range =
        prolong_cell_range(source, at, source->w + (model->i_m + l) * source->pitch, weight);
    double slack = (1e-8 + 1e-14 / alpha) * rho; /* rho_l = m_l / alpha_l, and alpha_l has round-off of 1 */
    return rho >= range.low - slack && rho <= range.high + slack;
}

static bool prolong_cell_pressure(const struct prolong_cells *source, size_t at, int o, double rho,
                                  const struct prolong_children *children)
{
    const struct model *model = source->model;
    const double *pressures = source->w + model->i_E * source->pitch;
    struct prolong_cell_range range = prolong_cell_range(source, at, pressures, NULL);
    double p = children->w[model->i_E][o], motion = 4.0 * children->strain[o], most = CELL_PART * fabs(pressures[at]);
    for (unsigned q = model->i_u; q < model->i_E; q++) {
        double du = children->w[q][o] - source->w[q * source->pitch + at];
        motion += 2.0 * rho * du * du;
    }
    double slack = CELL_ROUND_OFF * prolong_cell_range(source, at, source->rho_c2, NULL).high;
    slack += motion < most ? motion : most;
    return p >= range.low - slack && p <= range.high + slack;
}

/* Written so that a NaN counts as bad. */
static bool prolong_cell_child(const struct prolong_cells *source, size_t at, int o,
                               double (*const stiffness)[PROLONG_CHILDREN], double c2,
                               const struct prolong_children *children)
{
    const struct model *model = source->model;
    double rho = 0.0;
    for (unsigned l = 0; l < model->n_material; l++) rho += children->u[model->i_m + l][o];
    if (!(rho > 0.0 && rho < HUGE_VAL && c2 > 0.0 && c2 < HUGE_VAL)) return false;
    for (unsigned l = 0; l < model->n_material; l++)
        if (!(children->u[model->i_m + l][o] >= -CELL_DEFICIT * rho) ||
            !prolong_cell_material(source, at, l, o, stiffness[l][o], children))
            return false;
    return prolong_cell_pressure(source, at, o, rho, children);
}

/* Children with slopes times phi and their primitives; iterated closures start from the coarse pressure. */
static void prolong_cell_make(const struct prolong_cells *source, size_t at, const double *mean,
                              const cell_difference difference, const double give[3][2], double phi,
                              struct prolong_children *ret)
{
    const struct model *model = source->model;
    prolong_cell_fill(source, mean, difference, give, phi, ret);
    prolong_cell_strain(source, at, give, phi, ret);
    for (int o = 0; o < PROLONG_CHILDREN; o++) ret->w[model->i_E][o] = source->w[model->i_E * source->pitch + at];
    mix_primitives(model, (size_t)1 << model->dim, PROLONG_CHILDREN, ret->u[0], ret->w[0]);
}

static bool prolong_cell_good(const struct prolong_cells *source, size_t at, const struct prolong_children *children)
{
    const struct model *model = source->model;
    size_t count = (size_t)1 << model->dim;
    double stiffness[SCENE_MATERIALS][PROLONG_CHILDREN], c2[PROLONG_CHILDREN];
    mix_stiffness(model, count, PROLONG_CHILDREN, children->w[0], stiffness[0]);
    mix_speed2(model, count, PROLONG_CHILDREN, children->w[0], stiffness[0], c2);
    for (int o = 0; o < 1 << model->dim; o++)
        if (!prolong_cell_child(source, at, o, stiffness, c2[o], children)) return false;
    return true;
}

double prolong_cell_children(const struct prolong_cells *source, size_t at, const double *mean, const double give[3][2],
                             struct prolong_children *ret)
{
    static const double tries[] = {1.0, 0.5, 0.25};
    const struct model *model = source->model;
    cell_difference difference;
    double most = 1.0;
    for (unsigned q = 0; q < model->n_field; q++) {
        prolong_cell_differ(source, source->u + q * source->pitch + at, difference[q]);
        double phi = prolong_cell_share(source, at, q, mean[q], give, difference[q]);
        most = phi < most ? phi : most;
    }
    for (size_t i = 0; i < sizeof tries / sizeof *tries; i++) {
        prolong_cell_make(source, at, mean, difference, give, tries[i] * most, ret);
        if (prolong_cell_good(source, at, ret)) return tries[i] * most;
    }
    prolong_cell_make(source, at, mean, difference, give, 0.0, ret);
    return 0.0;
}
