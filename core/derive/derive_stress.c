/* derive_stress.c - see derive_stress.h.
 *
 * Everything starts from the deviatoric stress s' or the stretch V of all cells of a tile, as blocks of the
 * components that the scene has. Principal values are found for s' and shifted by -p, so that a pressure of 1e8 Pa
 * does not eat the digits of a soft tissue's stress. With up to four components (xx, yy, zz, xy) zz is a principal
 * value and the other two come from a root; with six, from Jacobi rotations, which stay exact where two of them
 * meet. */
#include "derive/derive_stress.h"

#include "base/mem.h"
#include "phys/bearing.h"
#include "phys/elastic.h"
#include "phys/flow.h"
#include "phys/row.h"

#include <math.h>
#include <string.h>

enum { DERIVE_STRESS_SWEEPS = 8 };

/* Largest and least principal value of the tensor of cell i; a block of n cells with so many components. */
struct derive_stress_pair {
    double most, least;
};
typedef struct derive_stress_pair derive_stress_finder(const double *s, size_t n, unsigned components, size_t i);

/* Partial densities of the solids as far as they bear, rows of `m`, in `partial` [n_solid][n]. */
static void derive_stress_partial(const struct derive_view *tile, double *partial, const double **m)
{
    const struct model *model = tile->model;
    for (unsigned k = 0; k < model->n_solid; k++) {
        unsigned l = model->solids[k].material;
        const double *rho = derive_view_w(tile, model->i_m + l);
        for (size_t i = 0; i < tile->n; i++) partial[k * tile->n + i] = derive_view_alpha(tile, l, i) * rho[i];
        m[k] = partial + k * tile->n;
        for (size_t i = 0; model->solids[k].damage.law && i < tile->n; i++)
            partial[k * tile->n + i] *= bearing_part(derive_view_w(tile, model->solids[k].damage.field)[i]);
    }
}

/* Deviatoric stress of the tile by a model of it, [n_stretch][n]; release with mem_free. */
static double *derive_stress_by(const struct derive_view *tile, const struct model *model)
{
    double *s = mem_new((model->n_stretch + model->n_solid) * tile->n, sizeof *s);
    const double *m[SCENE_MATERIALS];
    derive_stress_partial(tile, s + model->n_stretch * tile->n, m);
    elastic_stress(model, tile->n, tile->n, derive_view_w(tile, model->i_V), m, s);
    return s;
}

static double *derive_stress_deviator(const struct derive_view *tile)
{
    return derive_stress_by(tile, tile->model);
}

static const double *derive_stress_pressure(const struct derive_view *tile)
{
    return derive_view_w(tile, tile->model->i_E);
}

void derive_stress_cauchy(const struct derive_view *tile, double *out)
{
    unsigned c = (unsigned)tile->field->index;
    const double *p = derive_stress_pressure(tile);
    double *s = derive_stress_deviator(tile);
    if (c < tile->model->n_stretch) memcpy(out, s + c * tile->n, tile->n * sizeof *out);
    else memset(out, 0, tile->n * sizeof *out);
    for (size_t i = 0; c <= ELASTIC_ZZ && i < tile->n; i++) out[i] -= p[i];
    mem_free(s);
}

/* The stretch of the tile, [n_stretch][n]: of several solids the mean by volume, 1 where there is none. Release with
 * mem_free. */
static double *derive_stress_stretches(const struct derive_view *tile)
{
    const struct model *model = tile->model;
    size_t n = tile->n, size = model->n_stretch * n;
    double *V = mem_new(size, sizeof *V);
    memcpy(V, derive_view_w(tile, model->solids[0].stretch), size * sizeof *V);
    for (size_t i = 0; model->n_solid > 1 && i < n; i++) {
        double all = 0.0, sum[6] = {0};
        for (unsigned s = 0; s < model->n_solid; s++) {
            double alpha = derive_view_alpha(tile, model->solids[s].material, i);
            all += alpha;
            for (unsigned c = 0; c < model->n_stretch; c++)
                sum[c] += alpha * derive_view_w(tile, model->solids[s].stretch + c)[i];
        }
        for (unsigned c = 0; c < model->n_stretch; c++) V[c * n + i] = all > 0.0 ? sum[c] / all : c < 3 ? 1.0 : 0.0;
    }
    return V;
}

void derive_stress_stretch(const struct derive_view *tile, double *out)
{
    unsigned c = (unsigned)tile->field->index;
    double *V = derive_stress_stretches(tile);
    if (c < tile->model->n_stretch) memcpy(out, V + c * tile->n, tile->n * sizeof *out);
    else memset(out, 0, tile->n * sizeof *out);
    mem_free(V);
}

/* Those in the plane of x and y. */
static struct derive_stress_pair derive_stress_of_plane(const double *s, size_t n, unsigned components, size_t i)
{
    double xx = s[ELASTIC_XX * n + i], yy = s[ELASTIC_YY * n + i];
    double xy = components > ELASTIC_XY ? s[ELASTIC_XY * n + i] : 0.0;
    double mean = 0.5 * (xx + yy), root = hypot(0.5 * (xx - yy), xy);
    return (struct derive_stress_pair){mean + root, mean - root};
}

/* One Jacobi rotation: a[p][q] becomes 0. */
static void derive_stress_rotate(double a[3][3], int p, int q)
{
    int r = 3 - p - q;
    if (a[p][q] == 0.0) return;
    double theta = 0.5 * (a[q][q] - a[p][p]) / a[p][q];
    double t = (theta < 0.0 ? -1.0 : 1.0) / (fabs(theta) + hypot(1.0, theta)), c = 1.0 / hypot(1.0, t);
    double rp = a[r][p], rq = a[r][q];
    a[p][p] -= t * a[p][q];
    a[q][q] += t * a[p][q];
    a[p][q] = a[q][p] = 0.0;
    a[r][p] = a[p][r] = c * (rp - t * rq);
    a[r][q] = a[q][r] = c * (rq + t * rp);
}

/* All six components (Jacobi 1846; Golub & Van Loan, Matrix Computations, 8.5). */
static struct derive_stress_pair derive_stress_of_space(const double *s, size_t n, size_t i)
{
    double a[3][3];
    for (unsigned p = 0; p < 3; p++)
        for (unsigned q = 0; q < 3; q++) a[p][q] = s[elastic_component(p, q) * n + i];
    for (int sweep = 0; sweep < DERIVE_STRESS_SWEEPS; sweep++) {
        derive_stress_rotate(a, 0, 1);
        derive_stress_rotate(a, 0, 2);
        derive_stress_rotate(a, 1, 2);
    }
    double x = a[0][0], y = a[1][1], z = a[2][2];
    double most = x > y ? x : y, least = x > y ? y : x;
    return (struct derive_stress_pair){most > z ? most : z, least < z ? least : z};
}

static struct derive_stress_pair derive_stress_of_all(const double *s, size_t n, unsigned components, size_t i)
{
    if (components > ELASTIC_XZ) return derive_stress_of_space(s, n, i);
    struct derive_stress_pair pair = derive_stress_of_plane(s, n, components, i);
    double zz = s[ELASTIC_ZZ * n + i];
    return (struct derive_stress_pair){pair.most > zz ? pair.most : zz, pair.least < zz ? pair.least : zz};
}

/* The part that the field asks for, of the principal values that `find` finds. */
static void derive_stress_pick(const struct derive_view *tile, derive_stress_finder *find, double *out)
{
    enum derive_stress_part part = (enum derive_stress_part)tile->field->index;
    bool most = part == DERIVE_STRESS_MAX || part == DERIVE_STRESS_MAX_DEV;
    bool total = part == DERIVE_STRESS_MAX || part == DERIVE_STRESS_MIN;
    const double *p = derive_stress_pressure(tile);
    double *s = derive_stress_deviator(tile);
    for (size_t i = 0; i < tile->n; i++) {
        struct derive_stress_pair pair = find(s, tile->n, tile->model->n_stretch, i);
        double value = most ? pair.most : pair.least, shear = 0.5 * (pair.most - pair.least);
        out[i] = part == DERIVE_STRESS_SHEAR ? shear : total ? value - p[i] : value;
    }
    mem_free(s);
}

void derive_stress_sigma(const struct derive_view *tile, double *out)
{
    derive_stress_pick(tile, derive_stress_of_plane, out);
}

void derive_stress_principal(const struct derive_view *tile, double *out)
{
    derive_stress_pick(tile, derive_stress_of_all, out);
}

void derive_stress_stretch_max(const struct derive_view *tile, double *out)
{
    double *V = derive_stress_stretches(tile);
    for (size_t i = 0; i < tile->n; i++) out[i] = derive_stress_of_all(V, tile->n, tile->model->n_stretch, i).most;
    mem_free(V);
}

/* sqrt(3/2 s:s) of a block of components. */
static void derive_stress_equivalent(const struct derive_view *tile, const double *s, double *out)
{
    size_t n = tile->n;
    memset(out, 0, n * sizeof *out);
    for (unsigned c = 0; c < tile->model->n_stretch; c++) {
        double weight = c <= ELASTIC_ZZ ? 1.5 : 3.0; /* s_xy stands twice in the tensor */
        for (size_t i = 0; i < n; i++) out[i] += weight * s[c * n + i] * s[c * n + i];
    }
    for (size_t i = 0; i < n; i++) out[i] = sqrt(out[i]);
}

void derive_stress_von_mises(const struct derive_view *tile, double *out)
{
    double *s = derive_stress_deviator(tile);
    derive_stress_equivalent(tile, s, out);
    mem_free(s);
}

void derive_stress_over(const struct derive_view *tile, double *out)
{
    struct model *rest = mem_new(1, sizeof *rest);
    *rest = *tile->model;
    rest->n_branch = 0;
    double *s = derive_stress_deviator(tile), *less = derive_stress_by(tile, rest);
    row_take(rest->n_stretch * tile->n, less, s);
    derive_stress_equivalent(tile, s, out);
    mem_free(less);
    mem_free(s);
    mem_free(rest);
}

void derive_stress_energy(const struct derive_view *tile, double *out)
{
    const struct model *model = tile->model;
    double *partial = mem_new(model->n_solid * tile->n, sizeof *partial);
    const double *m[SCENE_MATERIALS];
    derive_stress_partial(tile, partial, m);
    elastic_energy(model, tile->n, tile->n, derive_view_w(tile, model->i_V), m, out);
    mem_free(partial);
}

void derive_stress_invariant(const struct derive_view *tile, double *out)
{
    const struct model *model = tile->model;
    double *other = mem_new(tile->n, sizeof *other), *V = derive_stress_stretches(tile);
    bool first = tile->field->index == 0;
    elastic_invariants(model, tile->n, tile->n, V, first ? out : other, first ? other : out);
    mem_free(other);
    mem_free(V);
}

void derive_stress_strength(const struct derive_view *tile, double *out)
{
    flow_strength(tile->model, tile->n, tile->n, tile->w, out);
}

/* Less of a cell is a trace of a solid. */
#define DERIVE_STRESS_TRACE 1e-3

/* Of the memories of the solids with or without a greatest value, the mean by mass of the solids that have one; 0 where
 * they fill less than `least` of a cell. */
static void derive_stress_remember(const struct derive_view *tile, bool bounded, double least, double *out)
{
    const struct model *model = tile->model;
    for (size_t i = 0; i < tile->n; i++) {
        double mass = 0.0, sum = 0.0, filled = 0.0;
        for (unsigned k = 0; k < model->n_memory; k++) {
            unsigned l = model->solids[model->memories[k].solid].material, q = model->memories[k].field;
            double alpha = derive_view_alpha(tile, l, i), m = alpha * derive_view_w(tile, model->i_m + l)[i];
            if ((model->memories[k].most < HUGE_VAL) != bounded) continue;
            filled += alpha;
            mass += m;
            sum += m * derive_view_w(tile, q)[i];
        }
        out[i] = mass > ELASTIC_NOTHING && filled >= least ? sum / mass : 0.0;
    }
}

void derive_stress_plastic(const struct derive_view *tile, double *out)
{
    derive_stress_remember(tile, false, 0.0, out);
}

void derive_stress_damage(const struct derive_view *tile, double *out)
{
    derive_stress_remember(tile, true, DERIVE_STRESS_TRACE, out);
}
