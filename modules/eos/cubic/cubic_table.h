/* cubic_table.h - a table of a cubic law over
 *     u = ln(b rho/(1 - b rho)),   y = ln theta,   theta = (p + ac q) w/R,
 * which come from (rho, p) directly and make what is tabulated smooth up to the co-volume: e/(R theta),
 * c^2 w^2/(v^2 R theta) and T/theta are all of order one. Values between nodes are bicubic Hermite, from values and
 * slopes at the nodes, or bilinear.
 *
 * The table covers densities from 1e-3 kg/m3 to just before the edge of the co-volume and theta from 1.13 Tc to
 * 30000 K. At both ends of theta a band leads over to the law itself, so that e stays monotone in p. */
#ifndef CUBIC_TABLE_H
#define CUBIC_TABLE_H

#include "cubic_rows.h"
#include "shared/patch.h"

#define CUBIC_TABLE_THIN 1e-3    /* kg/m3 */
#define CUBIC_TABLE_DENSE 0.9799 /* times 1/b */
#define CUBIC_TABLE_COLD 1.131   /* times Tc */
#define CUBIC_TABLE_HOT 3e4      /* K */
#define CUBIC_TABLE_BAND 0.1     /* in y */
#define CUBIC_TABLE_STEP 3e-4    /* of the differences that give slopes */

enum { CUBIC_TABLE_ROW = 288 }; /* points that are made at once */
enum { CUBIC_E, CUBIC_C, CUBIC_T, CUBIC_FIELDS };

struct cubic_table {
    size_t n; /* nodes in each direction; 0: there is no table */
    int bicubic;
    double u0, y0, du, dy;
    double *node;   /* [n u][n y][field], and if bicubic [value, du f_u, dy f_y, du dy f_uy] */
    double *misses; /* [n u - 1][3]: largest errors in a row of cells, see cubic_table_errors */
};

/* Numbers of a node. */
static inline size_t cubic_table_values(int bicubic)
{
    return CUBIC_FIELDS * (bicubic ? 4 : 1);
}

/* The fields of the law itself at n points, at most CUBIC_TABLE_ROW. */
static void cubic_table_exact(const struct cubic *par, size_t n, const double *u, const double *y,
                              double (*ret_fields)[CUBIC_FIELDS])
{
    double rho[CUBIC_TABLE_ROW], p[CUBIC_TABLE_ROW], T[CUBIC_TABLE_ROW], rho_e[CUBIC_TABLE_ROW],
        rho_c2[CUBIC_TABLE_ROW];
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
        ret_fields[i][CUBIC_T] = T[i] / theta;
        ret_fields[i][CUBIC_E] = rho_e[i] / scale;
        ret_fields[i][CUBIC_C] = rho_c2[i] / (scale * stretch * stretch);
    }
}

/* `n` nodes along y: values and slopes from a stencil of nine points around each. */
static void cubic_table_nodes(const struct cubic *par, const struct cubic_table *table, double u, double y, size_t n,
                              double *ret_nodes)
{
    const double h = CUBIC_TABLE_STEP, per = 1.0 / (2.0 * h);
    double us[CUBIC_TABLE_ROW], ys[CUBIC_TABLE_ROW], fields[CUBIC_TABLE_ROW][CUBIC_FIELDS];
    for (size_t k = 0; k < 9 * n; k++) {
        us[k] = u + h * ((double)(k % 3) - 1.0);
        ys[k] = y + (double)(k / 9) * table->dy + h * ((double)(k / 3 % 3) - 1.0);
    }
    cubic_table_exact(par, 9 * n, us, ys, fields);
    for (size_t k = 0; k < n; k++)
        for (size_t l = 0; l < CUBIC_FIELDS; l++) {
            double(*f)[CUBIC_FIELDS] = fields + 9 * k, *node = ret_nodes + k * cubic_table_values(table->bicubic);
            if (!table->bicubic) {
                node[l] = f[4][l];
                continue;
            }
            node[4 * l] = f[4][l];
            node[4 * l + 1] = table->du * per * (f[5][l] - f[3][l]);
            node[4 * l + 2] = table->dy * per * (f[7][l] - f[1][l]);
            node[4 * l + 3] = table->du * table->dy * per * per * ((f[8][l] - f[6][l]) - (f[2][l] - f[0][l]));
        }
}

/* A field where cells begin at `at` and, in the next row, at `up`. */
ELEMENTARY_INLINE struct patch cubic_table_field(const double *node, const int bicubic, const int field, int at, int up,
                                                 const struct patch_weights *x, const struct patch_weights *y)
{
    const int first = field * (bicubic ? 4 : 1), next = CUBIC_FIELDS * (bicubic ? 4 : 1);
    return patch_at(bicubic, node, at + first, up + first, next, x, y);
}

static size_t cubic_table_bytes(size_t n, int bicubic)
{
    return (n * n * cubic_table_values(bicubic) + 3 * (n - 1)) * sizeof(double);
}

/* The table of n x n nodes whose numbers are in the block. */
static struct cubic_table cubic_table_in(const struct cubic *par, size_t n, int bicubic, double *block)
{
    double thin = CUBIC_TABLE_THIN * par->b, parts = (double)(n - 1);
    double u0 = log(thin / (1.0 - thin)), u1 = log(CUBIC_TABLE_DENSE / (1.0 - CUBIC_TABLE_DENSE));
    double y0 = log(CUBIC_TABLE_COLD * par->Tc), y1 = log(CUBIC_TABLE_HOT);
    return (struct cubic_table){
        n, bicubic, u0, y0, (u1 - u0) / parts, (y1 - y0) / parts, block, block + n * n * cubic_table_values(bicubic)};
}

/* Fills the rows of a part. */
static void cubic_table_build(const struct cubic *par, const struct cubic_table *table, size_t part, size_t parts)
{
    const size_t most = CUBIC_TABLE_ROW / 9, n = table->n;
    for (size_t i = part; i < n; i += parts)
        for (size_t j = 0; j < n; j += most)
            cubic_table_nodes(par, table, table->u0 + (double)i * table->du, table->y0 + (double)j * table->dy,
                              n - j < most ? n - j : most,
                              table->node + (i * n + j) * cubic_table_values(table->bicubic));
}

/* Relative errors at a point with the fields `exact`: of T, of p at this density and energy, of c. */
static void cubic_table_error(const struct cubic *par, const struct cubic_table *table, const double at[2],
                              const double exact[CUBIC_FIELDS], double worst[3])
{
    const int size = (int)cubic_table_values(table->bicubic), last = (int)table->n - 2;
    double i = (at[0] - table->u0) / table->du, j = (at[1] - table->y0) / table->dy;
    int iu = patch_cell(i, last), iy = patch_cell(j, last), first = (iu * (int)table->n + iy) * size;
    struct patch_weights wu = patch_weights(table->bicubic, i - iu), wy = patch_weights(table->bicubic, j - iy);
    struct patch f[CUBIC_FIELDS];
    for (int l = 0; l < CUBIC_FIELDS; l++)
        f[l] = cubic_table_field(table->node, table->bicubic, l, first, first + size * (int)table->n, &wu, &wy);
    struct cubic_room room = cubic_room(par, 1.0 / (par->b * (1.0 + exp(-at[0]))));
    double attraction = par->ac * room.q / (par->R * exp(at[1]) * room.per_w); /* p = R theta/w (1 - this) */
    double energy = (f[CUBIC_E].f - exact[CUBIC_E]) / (f[CUBIC_E].f + f[CUBIC_E].f_y / table->dy);
    const double error[3] = {f[CUBIC_T].f / exact[CUBIC_T] - 1.0, energy / (1.0 - attraction),
                             0.5 * (f[CUBIC_C].f / exact[CUBIC_C] - 1.0)};
    for (int l = 0; l < 3; l++) worst[l] = fabs(error[l]) > worst[l] ? fabs(error[l]) : worst[l];
}

/* The largest of them at the centres of the cells of a part's rows. */
static void cubic_table_errors(const struct cubic *par, const struct cubic_table *table, size_t part, size_t parts)
{
    double u[CUBIC_TABLE_ROW], y[CUBIC_TABLE_ROW], exact[CUBIC_TABLE_ROW][CUBIC_FIELDS];
    const size_t cells = table->n - 1;
    for (size_t i = part; i < cells; i += parts) {
        double *worst = table->misses + 3 * i;
        for (size_t first = 0; first < cells; first += CUBIC_TABLE_ROW) {
            size_t m = cells - first < CUBIC_TABLE_ROW ? cells - first : CUBIC_TABLE_ROW;
            for (size_t k = 0; k < m; k++) {
                u[k] = table->u0 + ((double)i + 0.5) * table->du;
                y[k] = table->y0 + ((double)(first + k) + 0.5) * table->dy;
            }
            cubic_table_exact(par, m, u, y, exact);
            for (size_t k = 0; k < m; k++)
                cubic_table_error(par, table, (const double[2]){u[k], y[k]}, exact[k], worst);
        }
    }
}

/* The largest of all rows. */
static void cubic_table_worst(const struct cubic_table *table, double ret_worst[3])
{
    for (int l = 0; l < 3; l++) ret_worst[l] = 0.0;
    for (size_t i = 0; i < 3 * (table->n - 1); i++)
        ret_worst[i % 3] = table->misses[i] > ret_worst[i % 3] ? table->misses[i] : ret_worst[i % 3];
}

#endif
