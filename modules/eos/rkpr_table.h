/* rkpr_table.h - a table of a cubic law over
 *     u = ln(b rho/(1 - b rho)),   y = ln theta,   theta = (p + ac q) w/R,
 * which come from (rho, p) directly and make what is tabulated smooth up to the co-volume: T/theta, e/(R theta)
 * and c^2 w^2/(v^2 R theta) are all of order one. Values between nodes are bicubic Hermite, from values and slopes
 * at the nodes, or bilinear.
 *
 * The table covers densities from 1e-3 kg/m3 to just before the edge of the co-volume and theta from 1.13 Tc to
 * 30000 K. At both ends of theta a band leads over to the law itself, so that e stays monotone in p. */
#ifndef RKPR_TABLE_H
#define RKPR_TABLE_H

#include "cubic_rows.h"

#define RKPR_TABLE_THIN 1e-3    /* kg/m3 */
#define RKPR_TABLE_DENSE 0.9799 /* times 1/b */
#define RKPR_TABLE_COLD 1.131   /* times Tc */
#define RKPR_TABLE_HOT 3e4      /* K */
#define RKPR_TABLE_BAND 0.1     /* in y */
#define RKPR_TABLE_STEP 3e-4    /* of the differences that give slopes */

enum { RKPR_TABLE_ROW = 288 }; /* points that are made at once */
enum { RKPR_T, RKPR_E, RKPR_C, RKPR_FIELDS, RKPR_VALUES = 4 * RKPR_FIELDS };

struct rkpr_table {
    size_t n; /* nodes in each direction; 0: there is no table */
    int bicubic;
    double u0, y0, du, dy;
    double *node;   /* [n u][n y][field][value, du f_u, dy f_y, du dy f_uy] */
    double *misses; /* [n u - 1][3]: largest errors in a row of cells, see rkpr_table_errors */
};

/* Interpolated fields with their slopes in u and y. */
struct rkpr_look {
    double f[RKPR_FIELDS], f_u[RKPR_FIELDS], f_y[RKPR_FIELDS];
};

/* The fields of the law itself at n points, at most RKPR_TABLE_ROW. */
static void rkpr_table_exact(const struct cubic *par, size_t n, const double *u, const double *y,
                             double (*ret_fields)[RKPR_FIELDS])
{
    double rho[RKPR_TABLE_ROW], p[RKPR_TABLE_ROW], T[RKPR_TABLE_ROW], rho_e[RKPR_TABLE_ROW], rho_c2[RKPR_TABLE_ROW];
    for (size_t i = 0; i < n; i++) {
        rho[i] = 1.0 / (par->b * (1.0 + exp(-u[i])));
        struct cubic_room room = cubic_room(par, rho[i]);
        p[i] = par->R * exp(y[i]) * room.per_w - par->ac * room.q;
    }
    cubic_rows_temperature(par, n, rho, p, T);
    cubic_rows_state(par, n, rho, p, rho_e, rho_c2);
    for (size_t i = 0; i < n; i++) {
        struct cubic_room room = cubic_room(par, rho[i]);
        double theta = exp(y[i]), scale = rho[i] * par->R * theta, stretch = room.per_w * room.v;
        ret_fields[i][RKPR_T] = T[i] / theta;
        ret_fields[i][RKPR_E] = rho_e[i] / scale;
        ret_fields[i][RKPR_C] = rho_c2[i] / (scale * stretch * stretch);
    }
}

/* `n` nodes along y: values and slopes from a stencil of nine points around each. */
static void rkpr_table_nodes(const struct cubic *par, const struct rkpr_table *table, double u, double y, size_t n,
                             double *ret_nodes)
{
    const double h = RKPR_TABLE_STEP, per = 1.0 / (2.0 * h);
    double us[RKPR_TABLE_ROW], ys[RKPR_TABLE_ROW], fields[RKPR_TABLE_ROW][RKPR_FIELDS];
    for (size_t k = 0; k < 9 * n; k++) {
        us[k] = u + h * ((double)(k % 3) - 1.0);
        ys[k] = y + (double)(k / 9) * table->dy + h * ((double)(k / 3 % 3) - 1.0);
    }
    rkpr_table_exact(par, 9 * n, us, ys, fields);
    for (size_t k = 0; k < n; k++)
        for (int l = 0; l < RKPR_FIELDS; l++) {
            double(*f)[RKPR_FIELDS] = fields + 9 * k, *node = ret_nodes + k * RKPR_VALUES + 4 * l;
            node[0] = f[4][l];
            node[1] = table->du * per * (f[5][l] - f[3][l]);
            node[2] = table->dy * per * (f[7][l] - f[1][l]);
            node[3] = table->du * table->dy * per * per * ((f[8][l] - f[6][l]) - (f[2][l] - f[0][l]));
        }
}

/* Weights of the two ends of an interval at part t: of values, of scaled slopes, and their derivatives. */
struct rkpr_weight {
    double a[2], s[2], da[2], ds[2];
};

static inline struct rkpr_weight rkpr_table_weight(double t, int bicubic)
{
    double r = 1.0 - t;
    if (!bicubic) return (struct rkpr_weight){{r, t}, {0.0, 0.0}, {-1.0, 1.0}, {0.0, 0.0}};
    double bend = 6.0 * t * r;
    return (struct rkpr_weight){{r * r * (1.0 + 2.0 * t), t * t * (3.0 - 2.0 * t)},
                                {t * r * r, -t * t * r},
                                {-bend, bend},
                                {r * (1.0 - 3.0 * t), t * (3.0 * t - 2.0)}};
}

/* Clamped to the table; which cell and where in it. */
static inline size_t rkpr_table_cell(double x, double x0, double per, size_t n, double *ret_part)
{
    double at = (x - x0) * per, last = (double)(n - 2);
    at = at > 0.0 ? at : 0.0; /* a NaN ends here too; its caller drops what comes out */
    double cell = floor(at < last ? at : last), part = at - cell;
    *ret_part = part < 1.0 ? part : 1.0;
    return (size_t)cell;
}

/* Of the fields from `first` to `last` (constants where this is inlined: the rest costs nothing). */
ELEMENTARY_INLINE struct rkpr_look rkpr_table_look(const struct rkpr_table *table, double u, double y, int first,
                                                   int last)
{
    struct rkpr_look look = {{0}, {0}, {0}};
    double tu, ty;
    size_t i = rkpr_table_cell(u, table->u0, 1.0 / table->du, table->n, &tu);
    size_t j = rkpr_table_cell(y, table->y0, 1.0 / table->dy, table->n, &ty);
    struct rkpr_weight wu = rkpr_table_weight(tu, table->bicubic), wy = rkpr_table_weight(ty, table->bicubic);
    for (size_t k = 0; k < 4; k++) {
        size_t ku = k >> 1, ky = k & 1;
        const double *node = table->node + ((i + ku) * table->n + j + ky) * RKPR_VALUES + 4 * first;
        for (int l = first; l <= last; l++, node += 4) {
            double along = wy.a[ky] * node[0] + wy.s[ky] * node[2], across = wy.a[ky] * node[1] + wy.s[ky] * node[3];
            double slope = wy.da[ky] * node[0] + wy.ds[ky] * node[2], twist = wy.da[ky] * node[1] + wy.ds[ky] * node[3];
            look.f[l] += wu.a[ku] * along + wu.s[ku] * across;
            look.f_u[l] += (wu.da[ku] * along + wu.ds[ku] * across) / table->du;
            look.f_y[l] += (wu.a[ku] * slope + wu.s[ku] * twist) / table->dy;
        }
    }
    return look;
}

static size_t rkpr_table_bytes(size_t n)
{
    return (n * n * RKPR_VALUES + 3 * (n - 1)) * sizeof(double);
}

/* The table of n x n nodes whose numbers are in the block. */
static struct rkpr_table rkpr_table_in(const struct cubic *par, size_t n, int bicubic, double *block)
{
    double thin = RKPR_TABLE_THIN * par->b, parts = (double)(n - 1);
    double u0 = log(thin / (1.0 - thin)), u1 = log(RKPR_TABLE_DENSE / (1.0 - RKPR_TABLE_DENSE));
    double y0 = log(RKPR_TABLE_COLD * par->Tc), y1 = log(RKPR_TABLE_HOT);
    return (struct rkpr_table){
        n, bicubic, u0, y0, (u1 - u0) / parts, (y1 - y0) / parts, block, block + n * n * RKPR_VALUES};
}

/* Fills the rows of a part. */
static void rkpr_table_build(const struct cubic *par, const struct rkpr_table *table, size_t part, size_t parts)
{
    const size_t most = RKPR_TABLE_ROW / 9, n = table->n;
    for (size_t i = part; i < n; i += parts)
        for (size_t j = 0; j < n; j += most)
            rkpr_table_nodes(par, table, table->u0 + (double)i * table->du, table->y0 + (double)j * table->dy,
                             n - j < most ? n - j : most, table->node + (i * n + j) * RKPR_VALUES);
}

/* Relative errors at a point with the fields `exact`: of T, of p at this density and energy, of c. */
static void rkpr_table_error(const struct cubic *par, const struct rkpr_table *table, const double at[2],
                             const double exact[RKPR_FIELDS], double worst[3])
{
    double u = at[0], y = at[1];
    struct rkpr_look look = rkpr_table_look(table, u, y, RKPR_T, RKPR_C);
    struct cubic_room room = cubic_room(par, 1.0 / (par->b * (1.0 + exp(-u))));
    double attraction = par->ac * room.q / (par->R * exp(y) * room.per_w); /* p = R theta/w (1 - this) */
    double energy = (look.f[RKPR_E] - exact[RKPR_E]) / (look.f[RKPR_E] + look.f_y[RKPR_E]);
    const double error[3] = {look.f[RKPR_T] / exact[RKPR_T] - 1.0, energy / (1.0 - attraction),
                             0.5 * (look.f[RKPR_C] / exact[RKPR_C] - 1.0)};
    for (int l = 0; l < 3; l++) worst[l] = fabs(error[l]) > worst[l] ? fabs(error[l]) : worst[l];
}

/* The largest of them at the centres of the cells of a part's rows. */
static void rkpr_table_errors(const struct cubic *par, const struct rkpr_table *table, size_t part, size_t parts)
{
    double u[RKPR_TABLE_ROW], y[RKPR_TABLE_ROW], exact[RKPR_TABLE_ROW][RKPR_FIELDS];
    const size_t cells = table->n - 1;
    for (size_t i = part; i < cells; i += parts) {
        double *worst = table->misses + 3 * i;
        for (size_t first = 0; first < cells; first += RKPR_TABLE_ROW) {
            size_t m = cells - first < RKPR_TABLE_ROW ? cells - first : RKPR_TABLE_ROW;
            for (size_t k = 0; k < m; k++) {
                u[k] = table->u0 + ((double)i + 0.5) * table->du;
                y[k] = table->y0 + ((double)(first + k) + 0.5) * table->dy;
            }
            rkpr_table_exact(par, m, u, y, exact);
            for (size_t k = 0; k < m; k++) rkpr_table_error(par, table, (const double[2]){u[k], y[k]}, exact[k], worst);
        }
    }
}

/* The largest of all rows. */
static void rkpr_table_worst(const struct rkpr_table *table, double ret_worst[3])
{
    for (int l = 0; l < 3; l++) ret_worst[l] = 0.0;
    for (size_t i = 0; i < 3 * (table->n - 1); i++)
        ret_worst[i % 3] = table->misses[i] > ret_worst[i % 3] ? table->misses[i] : ret_worst[i % 3];
}

#endif
