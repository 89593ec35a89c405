/* heights.c - see heights.h. A row of cells along x at a time, with the columns through them and those beside. Sums
 * begin with pairs that lie opposite, so that mirrors and the exchange of x and y keep all bits. */
#include "scheme/heights.h"

#include "mesh/metric.h"
#include "scheme/curvature_grid.h"

#include <math.h>
#include <stdbool.h>

/* Cells of a column on each side of its middle. */
enum { HEIGHTS_REACH = 3 };

/* Least n_d^2 of columns along d. */
#define HEIGHTS_STEEP 0.2

/* Least squared sine of an angle at a wall: flatter ones have no columns along it. */
#define HEIGHTS_LYING 1e-2

/* Tails of fronts: least and most of a material, slowest fall. */
#define HEIGHTS_TRACE 1e-9
#define HEIGHTS_FULL 0.999
#define HEIGHTS_SLOW 0.7

/* What the ends of three (nine) columns may lack of being pure, and from where on they count for nothing. */
#define HEIGHTS_PURE 0.05
#define HEIGHTS_MIXED 0.5

/* Fronts up to this wide, in cells, are columns' all; those of HEIGHTS_WIDE are none of theirs. */
#define HEIGHTS_THIN 0.7
#define HEIGHTS_WIDE 0.95

/* Heights in cells along the column's axis, of the columns through a row, from a cell before it to one behind it;
 * `turn`: how far a column goes from one material, -1 or 1, to the other; `width`: w of a front that is a tanh(x/w),
 * along the column. */
struct heights_columns {
    double height[METRIC_CELLS + 2], turn[METRIC_CELLS + 2], width[METRIC_CELLS + 2];
};

/* In the plane: columns that lie along rows are asked for three times, by their own row and by those beside it. */
struct heights_kept {
    const double *of[3]; /* the first cells of the rows; NULL: none yet */
    struct heights_columns columns[3];
};

/* A row of cells and the columns through its cells along one axis. */
struct heights_row {
    const struct mesh *mesh;
    const struct level *level;
    const struct metric *metric; /* of the row's cells */
    const double *a;             /* fraction of its first cell, in the patch */
    const struct curvature_grid *patch;
    const double *cosine; /* of the angles at walls (heights_take); NULL: none */
    struct heights_kept *kept;
    int at[3]; /* its first cell, counted from that of the tile */
    size_t n;
};

/* What the axes have said of a row so far. */
struct heights_sum {
    double kappa[METRIC_CELLS], weight[METRIC_CELLS], all[METRIC_CELLS];
};

/* What lies beyond the end of a column, where the last of its cells has e of a material and the one before it e2: odds
 * e/(1 - e) of a front that is a tanh fall by the same factor from cell to cell. Three cells one by one, then a
 * geometric series. */
static inline double heights_tail(double e, double e2)
{
    double last = e > 0.0 ? e : 0.0, before = e2 > HEIGHTS_TRACE ? e2 : HEIGHTS_TRACE;
    last = last < HEIGHTS_FULL ? last : HEIGHTS_FULL;
    before = before < HEIGHTS_FULL ? before : HEIGHTS_FULL;
    double odds = last / (1.0 - last), factor = odds * (1.0 - before) / before;
    factor = factor < HEIGHTS_SLOW ? factor : HEIGHTS_SLOW;
    double one = odds * factor, two = one * factor, three = two * factor, end = three / (1.0 + three);
    return (one / (1.0 + one) + two / (1.0 + two)) + (end + end * factor / (1.0 - factor));
}

/* What a column lacks: what lies beyond its empty end less what lacks beyond its full one. From its lower end on. */
static inline double heights_beyond(double first, double second, double sixth, double last)
{
    bool rises = last > first;
    double empty = rises ? first : last, empty2 = rises ? second : sixth, full = rises ? last : first,
           full2 = rises ? sixth : second;
    return heights_tail(empty, empty2) - heights_tail(1.0 - full, 1.0 - full2);
}

/* 2 sum alpha (1 - alpha), which is w of a tanh, wherever the middle of the front lies between cells. */
static BULLA_KERNEL void heights_width_row(size_t n, size_t step, const double *restrict low, double *restrict width)
{
#pragma omp simd
    for (size_t i = 0; i < n; i++) {
        double a = low[i], b = low[i + step], c = low[i + 2 * step], d = low[i + 3 * step], e = low[i + 4 * step],
               f = low[i + 5 * step], g = low[i + 6 * step];
        double outer = (a * (1.0 - a) + g * (1.0 - g)) + (b * (1.0 - b) + f * (1.0 - f));
        width[i] = 2.0 * ((outer + (c * (1.0 - c) + e * (1.0 - e))) + d * (1.0 - d));
    }
}

static BULLA_KERNEL void heights_columns_row(size_t n, size_t step, const double *restrict low, double *restrict height,
                                             double *restrict turn)
{
#pragma omp simd
    for (size_t i = 0; i < n; i++) {
        double first = low[i], last = low[i + 6 * step];
        double outer = (first + last) + (low[i + step] + low[i + 5 * step]);
        double sum = (outer + (low[i + 2 * step] + low[i + 4 * step])) + low[i + 3 * step];
        height[i] = sum + heights_beyond(first, low[i + step], low[i + 5 * step], last);
        turn[i] = last - first;
    }
}

/* Columns along the radius: +-the radius of a cylinder of the same volume, in cells; r: of the first cell's middle. */
static BULLA_KERNEL void heights_radius_row(size_t n, double r, size_t step, const double *restrict low,
                                            double *restrict height, double *restrict turn)
{
#pragma omp simd
    for (size_t i = 0; i < n; i++) {
        double here = r + (double)(int)i, first = low[i], last = low[i + 6 * step];
        double second = low[i + step], sixth = low[i + 5 * step], side = last - first > 0.0 ? -1.0 : 1.0;
        double sum = first * (here - 3.0) + second * (here - 2.0) + low[i + 2 * step] * (here - 1.0) +
                     low[i + 3 * step] * here + low[i + 4 * step] * (here + 1.0) + sixth * (here + 2.0) +
                     last * (here + 3.0);
        sum += here * heights_beyond(first, second, sixth, last);
        double from = here - side * 3.5, square = from * from + side * (sum + sum);
        height[i] = side * sqrt(square > 0.0 ? square : 0.0);
        turn[i] = last - first;
    }
}

/* The columns along `axis` through the cells of a row that lies some steps beside. */
static void heights_columns(const struct heights_row *row, int axis, const double *beside, struct heights_columns *ret)
{
    size_t step = row->patch->stride[axis];
    const double *low = beside - HEIGHTS_REACH * step - 1;
    if (axis == 0 && row->mesh->beta == 1)
        heights_radius_row(row->n + 2, row->metric->centre[0] / row->level->h[0] - 1.0, step, low, ret->height,
                           ret->turn);
    else heights_columns_row(row->n + 2, step, low, ret->height, ret->turn);
    heights_width_row(row->n + 2, step, low, ret->width);
}

/* Those along the first axis through the row some steps beside. */
static const struct heights_columns *heights_along(const struct heights_row *row, int beside)
{
    const double *of = row->a + beside * (ptrdiff_t)row->patch->stride[1];
    int place = (row->at[1] + HEIGHTS_AROUND + 1 + beside) % 3;
    if (row->kept->of[place] != of) heights_columns(row, 0, of, &row->kept->columns[place]);
    row->kept->of[place] = of;
    return &row->kept->columns[place];
}

/* Three columns beside each other: how far the worst of them goes where the middle one goes. */
static BULLA_KERNEL void heights_least(size_t n, const double *restrict below, const double *restrict here,
                                       const double *restrict above, const double *restrict of, double *restrict ret)
{
#pragma omp simd
    for (size_t i = 0; i < n; i++) {
        double side = of[i] < 0.0 ? -1.0 : 1.0, a = below[i] * side, b = here[i] * side, c = above[i] * side,
               r = ret[i];
        double low = a < c ? a : c, all = low < b ? low : b;
        ret[i] = all < r ? all : r;
    }
}

/* Adds what columns along an axis say, with the squares of the normal; width: of the front along them. */
static BULLA_KERNEL void heights_add(size_t n, const double *restrict kappa, const double *restrict least,
                                     const double *restrict width, const double *restrict normal,
                                     struct heights_sum *sum)
{
    double *restrict k = sum->kappa, *restrict w = sum->weight, *restrict all = sum->all;
#pragma omp simd
    for (size_t i = 0; i < n; i++) {
        double across = normal[i], steep = across * across - HEIGHTS_STEEP, q = 1.0 - least[i], have = k[i],
               with = w[i], whole = all[i];
        double wide = width[i] * (across < 0.0 ? -across : across);
        double thin = (HEIGHTS_WIDE - wide) / (HEIGHTS_WIDE - HEIGHTS_THIN);
        double trust = (HEIGHTS_MIXED - q) / (HEIGHTS_MIXED - HEIGHTS_PURE), weight = steep > 0.0 ? steep * steep : 0.0;
        trust = trust < 1.0 ? trust : 1.0;
        thin = thin < 1.0 ? thin : 1.0;
        trust = trust > 0.0 ? trust * weight : 0.0;
        trust = thin > 0.0 ? trust * thin : 0.0;
        k[i] = have + trust * kappa[i];
        w[i] = with + trust;
        all[i] = whole + weight;
    }
}

/* kappa of a plane: -(upper n_upper - lower n_lower), n = H'/sqrt(1 + H'^2) at the faces; per: h of the column over
 * that between columns. */
static BULLA_KERNEL void heights_plane_row(size_t n, const double *restrict below, const double *restrict here,
                                           const double *restrict above, const double *restrict lower,
                                           const double *restrict upper, double per, double *restrict kappa)
{
#pragma omp simd
    for (size_t i = 0; i < n; i++) {
        double down = (here[i] - below[i]) * per, up = (above[i] - here[i]) * per;
        kappa[i] = lower[i] * (down / sqrt(1.0 + down * down)) - upper[i] * (up / sqrt(1.0 + up * up));
    }
}

/* The second curvature of columns along a radius. */
static BULLA_KERNEL void heights_ring_row(size_t n, const double *restrict below, const double *restrict here,
                                          const double *restrict above, double per, double h, double *restrict kappa)
{
#pragma omp simd
    for (size_t i = 0; i < n; i++) {
        double slope = 0.5 * (above[i] - below[i]) * per, k = kappa[i], r = here[i] * h;
        double ring = 1.0 / (r * sqrt(1.0 + slope * slope));
        kappa[i] = k + (r < 0.0 || r > 0.0 ? ring : 0.0);
    }
}

/* kappa in space, from nine columns: t, u: one step along the transverse axes; per: h of the column over theirs. */
static BULLA_KERNEL void heights_space_row(size_t n, const double *const at[9], double per_t, double per_u, double h,
                                           double *restrict kappa)
{
    const double *restrict o = at[4], *restrict b = at[1], *restrict t = at[7], *restrict l = at[3],
                           *restrict r = at[5], *restrict bl = at[0], *restrict br = at[2], *restrict tl = at[6],
                           *restrict tr = at[8];
    double tt = per_t * per_t / h, uu = per_u * per_u / h, tu = 0.25 * per_t * per_u / h;
#pragma omp simd
    for (size_t i = 0; i < n; i++) {
        double ht = 0.5 * (t[i] - b[i]) * per_t, hu = 0.5 * (r[i] - l[i]) * per_u;
        double two = o[i] + o[i], htt = ((t[i] + b[i]) - two) * tt, huu = ((r[i] + l[i]) - two) * uu;
        double htu = ((tr[i] + bl[i]) - (tl[i] + br[i])) * tu, length2 = 1.0 + (ht * ht + hu * hu);
        double sum = (htt * (1.0 + hu * hu) + huu * (1.0 + ht * ht)) - 2.0 * (htu * (ht * hu));
        kappa[i] = -sum / (length2 * sqrt(length2));
    }
}

/* Areas over volume of the faces between columns beside each other along an axis. */
static void heights_faces(const struct heights_row *row, int across, double *lower, double *upper)
{
    const struct metric *metric = row->metric;
    double h = row->level->h[across];
    for (size_t i = 0; i < row->n; i++) {
        lower[i] = across ? 1.0 / h : metric->area[i] / metric->volume[i];
        upper[i] = across ? 1.0 / h : metric->area[i + 1] / metric->volume[i];
    }
}

/* Heights and turns of three (nine) columns beside each other, of each cell of a row: place 4 + i + j of those i
 * along one axis and j along the other, with steps of 3 and 1, of 3 and 0 in the plane; width of the middle one. */
struct heights_nine {
    const double *height[9], *turn[9], *width;
    double behind[4][3][2][METRIC_CELLS]; /* columns behind walls, if any: their heights and turns */
};

/* A wall with an angle: its axis and side; steps among the nine across it and along it; h of the columns over that
 * between them. */
struct heights_wall {
    int axis, side, across, along;
    double per_across, per_along;
};

/* How much higher columns behind a wall are than those before it: n = H_t/sqrt(1 + H_t^2 + H_u^2) across the wall is
 * the cosine. */
static void heights_more(const struct heights_row *row, const struct heights_wall *wall,
                         const struct heights_nine *nine, double *ret)
{
    double cosine = row->cosine[2 * wall->axis + wall->side], sine2 = 1.0 - cosine * cosine;
    double most = cosine / sqrt(sine2 > HEIGHTS_LYING ? sine2 : HEIGHTS_LYING) / wall->per_across;
    const double *below = nine->height[4 - wall->along], *above = nine->height[4 + wall->along];
    for (size_t i = 0; i < row->n; i++) {
        double slope = 0.5 * (above[i] - below[i]) * wall->per_along;
        ret[i] = most * sqrt(1.0 + slope * slope);
    }
}

/* Columns of cells at the wall get their neighbours behind it. */
static void heights_behind(const struct heights_row *row, const struct heights_wall *wall, struct heights_nine *nine,
                           double (*room)[2][METRIC_CELLS])
{
    int last = wall->side ? row->mesh->n[wall->axis] - 1 : 0;
    double more[METRIC_CELLS];
    heights_more(row, wall, nine, more);
    for (int j = 0; j < 3; j++) {
        int from = 4 + (j - 1) * wall->along, to = from + (wall->side ? wall->across : -wall->across);
        double *height = room[j][0], *turn = room[j][1];
        for (size_t i = 0; i < row->n; i++) {
            bool here = row->at[wall->axis] + (wall->axis ? 0 : (int)i) == last;
            height[i] = here ? nine->height[from][i] + more[i] : nine->height[to][i];
            turn[i] = here ? nine->turn[from][i] : nine->turn[to][i];
        }
        nine->height[to] = height;
        nine->turn[to] = turn;
    }
}

static bool heights_leans(const struct heights_row *row, int axis, int side)
{
    return row->cosine && (row->cosine[2 * axis + side] < 0.0 || row->cosine[2 * axis + side] > 0.0);
}

/* Walls with an angle across the axes between columns: one in the plane, else two. */
static void heights_walls(const struct heights_row *row, const int axes[2], const double per[2],
                          struct heights_nine *nine)
{
    int n = row->mesh->dim - 1, step[2] = {3, n > 1 ? 1 : 0};
    for (int d = 0; d < n; d++)
        for (int side = 0; side < 2; side++)
            if (heights_leans(row, axes[d], side))
                heights_behind(row,
                               &(struct heights_wall){axes[d], side, step[d], step[1 - d], per[d],
                                                      n > 1 ? per[1 - d] : 0.0},
                               nine, nine->behind[2 * d + side]);
}

/* Would columns along an axis through cell i of a row cross a wall with an angle? */
static bool heights_cross(const struct heights_row *row, int axis, size_t i)
{
    int n = row->mesh->n[axis], at = row->at[axis] + (axis ? 0 : (int)i);
    return (heights_leans(row, axis, 0) && at < HEIGHTS_REACH) ||
           (heights_leans(row, axis, 1) && at >= n - HEIGHTS_REACH);
}

/* Normals along an axis without those of cells whose columns cross a wall with an angle. */
static void heights_normal(const struct heights_row *row, int axis, const double *normal, double *ret)
{
    for (size_t i = 0; i < row->n; i++) ret[i] = heights_cross(row, axis, i) ? 0.0 : normal[i];
}

/* Widths of fronts, 0 near walls with an angle: normals know that angle less well than the columns of wide fronts. */
static const double *heights_width(const struct heights_row *row, const double *width, double *ret)
{
    if (!row->cosine) return width;
    for (size_t i = 0; i < row->n; i++) {
        bool near = false;
        for (int d = 0; d < row->mesh->dim; d++) near = near || heights_cross(row, d, i);
        ret[i] = near ? 0.0 : width[i];
    }
    return ret;
}

/* In the plane and around an axis: columns along `axis`, three rows of them, or one where they stand beside each other
 * in it. */
static void heights_plane(const struct heights_row *row, int axis, const double *normal, struct heights_sum *sum)
{
    int across = 1 - axis;
    size_t n = row->n;
    struct heights_columns own;
    const struct heights_columns *here = across ? heights_along(row, 0) : &own,
                                 *below = across ? heights_along(row, -1) : here,
                                 *above = across ? heights_along(row, 1) : here;
    size_t off = across ? 1 : 0, on = across ? 1 : 2;
    double lower[METRIC_CELLS], upper[METRIC_CELLS], kappa[METRIC_CELLS], least[METRIC_CELLS], width[METRIC_CELLS];
    double per = row->level->h[axis] / row->level->h[across];
    if (!across) heights_columns(row, axis, row->a, &own);
    struct heights_nine nine;
    const double *const height[3] = {below->height + off, here->height + 1, above->height + on},
                        *const turn[3] = {below->turn + off, here->turn + 1, above->turn + on};
    for (int i = 0; i < 3; i++) nine.height[3 * i + 1] = height[i], nine.turn[3 * i + 1] = turn[i];
    nine.width = here->width + 1;
    heights_walls(row, (int[2]){across}, (double[2]){per}, &nine);
    heights_faces(row, across, lower, upper);
    for (size_t i = 0; i < n; i++) least[i] = 1.0;
    heights_least(n, nine.turn[1], nine.turn[4], nine.turn[7], nine.turn[4], least);
    heights_plane_row(n, nine.height[1], nine.height[4], nine.height[7], lower, upper, per, kappa);
    if (axis == 0 && row->mesh->beta == 1)
        heights_ring_row(n, nine.height[1], nine.height[4], nine.height[7], per, row->level->h[0], kappa);
    heights_add(n, kappa, least, heights_width(row, nine.width, width), normal, sum);
}

/* Columns along `axis` through nine rows, or three where they stand beside each other in these. */
static void heights_take_nine(const struct heights_row *row, int axis, struct heights_columns columns[9],
                              struct heights_nine *ret)
{
    int t = (axis + 1) % 3, u = (axis + 2) % 3;
    const size_t *stride = row->patch->stride;
    for (size_t i = 0; i < 3; i++)
        for (size_t j = 0; j < 3; j++) {
            size_t row_t = t ? i : 1, row_u = u ? j : 1, along = t ? (u ? 1 : j) : i;
            struct heights_columns *of = &columns[3 * row_t + row_u];
            if (row_t == i && row_u == j)
                heights_columns(row, axis, row->a + i * stride[t] + j * stride[u] - stride[t] - stride[u], of);
            ret->height[3 * i + j] = of->height + along;
            ret->turn[3 * i + j] = of->turn + along;
            if (i == 1 && j == 1) ret->width = of->width + along;
        }
}

/* In space. */
static void heights_space(const struct heights_row *row, int axis, const double *normal, struct heights_sum *sum)
{
    int t = (axis + 1) % 3, u = (axis + 2) % 3;
    size_t n = row->n;
    struct heights_columns columns[9];
    struct heights_nine nine;
    double kappa[METRIC_CELLS], least[METRIC_CELLS], width[METRIC_CELLS], h = row->level->h[axis];
    double per_t = h / row->level->h[t], per_u = h / row->level->h[u];
    heights_take_nine(row, axis, columns, &nine);
    heights_walls(row, (int[2]){t, u}, (double[2]){per_t, per_u}, &nine);
    for (size_t i = 0; i < n; i++) least[i] = 1.0;
    for (int k = 0; k < 9; k++) heights_least(n, nine.turn[k], nine.turn[k], nine.turn[k], nine.turn[4], least);
    heights_space_row(n, nine.height, per_t, per_u, h, kappa);
    heights_add(n, kappa, least, heights_width(row, nine.width, width), normal, sum);
}

/* What is trusted, over all that surfaces of this direction could have. */
static BULLA_KERNEL void heights_end(size_t n, const struct heights_sum *sum, double *restrict kappa,
                                     double *restrict trust)
{
    const double *restrict k = sum->kappa, *restrict w = sum->weight, *restrict all = sum->all;
#pragma omp simd
    for (size_t i = 0; i < n; i++) {
        bool some = w[i] > 0.0;
        kappa[i] = some ? k[i] / w[i] : 0.0;
        trust[i] = some ? w[i] / all[i] : 0.0;
    }
}

/* Cells of a row with a surface that columns along an axis, whose normals these are, could say something of. */
static BULLA_KERNEL double heights_asked(size_t n, const double *restrict a, const double *restrict normal)
{
    double count = 0.0;
#pragma omp simd reduction(+ : count)
    for (size_t i = 0; i < n; i++) {
        double both = a[i] * (1.0 - a[i]), steep = normal[i] * normal[i] - HEIGHTS_STEEP;
        double here = both > 0.0 ? 1.0 : 0.0;
        count += steep > 0.0 ? here : 0.0;
    }
    return count;
}

static void heights_one(const struct heights_row *row, const double *const normal[3], double *kappa, double *trust)
{
    struct heights_sum sum;
    for (size_t i = 0; i < row->n; i++) sum.kappa[i] = sum.weight[i] = sum.all[i] = 0.0;
    for (int axis = 0; axis < row->mesh->dim; axis++) {
        double inside[METRIC_CELLS];
        const double *of = row->cosine ? inside : normal[axis];
        if (row->cosine) heights_normal(row, axis, normal[axis], inside);
        if (heights_asked(row->n, row->a, of) > 0.0)
            (row->mesh->dim == 2 ? heights_plane : heights_space)(row, axis, of, &sum);
    }
    heights_end(row->n, &sum, kappa, trust);
}

void heights_take(const struct mesh *mesh, const struct level *level, const struct tile *tile, const double *a,
                  double *const normal[3], const double *cosine, double *ret_kappa, double *ret_trust)
{
    const struct curvature_grid patch = curvature_grid(mesh, 2 * HEIGHTS_LAYERS),
                                to = curvature_grid(mesh, 2 * HEIGHTS_AROUND),
                                normals = curvature_grid(mesh, 2 * HEIGHTS_NORMALS);
    struct metric metric;
    struct heights_kept kept; /* large: filled as far as it is used */
    kept.of[0] = kept.of[1] = kept.of[2] = NULL;
    metric_of_cells(mesh, level, tile->at[0] * mesh->n[0] - HEIGHTS_AROUND, (int)to.n[0], &metric);
    for (size_t k = 0; k < to.n[2]; k++)
        for (size_t j = 0; j < to.n[1]; j++) {
            const struct heights_row row = {.mesh = mesh,
                                            .level = level,
                                            .metric = &metric,
                                            .a = a + curvature_grid_at(&patch, HEIGHTS_LAYERS - HEIGHTS_AROUND, j, k),
                                            .patch = &patch,
                                            .cosine = cosine,
                                            .kept = &kept,
                                            .at = {-HEIGHTS_AROUND, (int)j - HEIGHTS_AROUND, (int)k - HEIGHTS_AROUND},
                                            .n = to.n[0]};
            size_t at = j * to.stride[1] + k * to.stride[2],
                   from = curvature_grid_at(&normals, HEIGHTS_NORMALS - HEIGHTS_AROUND, j, k);
            const double *n[3] = {normal[0] + from, normal[1] + from, normal[2] + from};
            heights_one(&row, n, ret_kappa + at, ret_trust + at);
        }
}
