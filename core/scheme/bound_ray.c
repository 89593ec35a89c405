/* bound_ray.c - see bound_ray.h. */
#include "scheme/bound_ray.h"

#include <math.h>

/* From the origin to a point. */
struct bound_ray {
    double r, e[SCENE_AXES];
};

/* To the point that lies `way` outwards of face c. */
static struct bound_ray bound_ray_to(const struct bound_ray_row *row, size_t c, double way)
{
    struct bound_ray ray = {0};
    double square = 0.0;
    for (int d = 0; d < row->dim; d++) {
        double x = row->x[d][c] + (d == row->axis ? row->outward * way : 0.0);
        ray.e[d] = x - row->from->point[d];
        square += ray.e[d] * ray.e[d];
    }
    ray.r = sqrt(square);
    for (int d = 0; d < row->dim; d++) ray.e[d] /= ray.r;
    return ray;
}

/* u'e of the cell that lies `depth` cells inside the outermost one. */
static double bound_ray_along(const struct bound_ray_row *row, const struct bound_ray *ray, size_t c, int depth)
{
    double sum = 0.0;
    for (unsigned d = 0; d < row->n_velocity; d++) sum += ray->e[d] * (row->u[depth][d][c] - row->far_u[d][c]);
    return sum;
}

/* p + Z u'e there. */
static double bound_ray_leaving(const struct bound_ray_row *row, size_t c, int depth)
{
    struct bound_ray ray = bound_ray_to(row, c, -(depth + 0.5) * row->h);
    return row->p[depth][c] + row->Z[c] * bound_ray_along(row, &ray, c, depth);
}

/* What leaves goes on as it comes; not at shocks. */
static double bound_ray_onward(const struct bound_ray_row *row, size_t c)
{
    double last = bound_ray_leaving(row, c, 0), before = bound_ray_leaving(row, c, 1);
    double a = last - before, b = before - bound_ray_leaving(row, c, 2);
    return a * b <= 0.0 ? 0.0 : (row->layer + 1) * (fabs(a) < fabs(b) ? a : b);
}

/* The memory p' - Z u'e behind; on a line the way is that between the cells, to the last bit. */
static double bound_ray_near(const struct bound_ray_row *row, double r, double behind, double p, double Z_u)
{
    double d = row->dim == 1 ? (row->layer + 1) * row->h : behind - r, q = row->from->power;
    behind = r + d;
    double spread = q < 1.0 ? sqrt(r / behind) / behind : r / (behind * behind);
    return ((p - Z_u) * r + q * d * p) * spread;
}

/* u'e behind, from that in the cells that lie 0 and 1 cells inside. */
static double bound_ray_fall(const struct bound_ray_row *row, size_t c, double behind)
{
    double flow[2], power = 2.0 * row->from->power;
    for (int depth = 0; depth < 2; depth++) {
        struct bound_ray ray = bound_ray_to(row, c, -(depth + 0.5) * row->h);
        flow[depth] = pow(ray.r, power) * bound_ray_along(row, &ray, c, depth);
    }
    return (flow[0] + (row->layer + 1) * (flow[0] - flow[1])) / pow(behind, power);
}

/* The velocity behind whose part along e is given. */
static void bound_ray_put(const struct bound_ray_row *row, size_t c, const struct bound_ray *in,
                          const struct bound_ray *out, double along)
{
    double u = bound_ray_along(row, in, c, 0);
    for (unsigned d = 0; d < row->n_velocity; d++) row->to_u[d][c] = row->u[0][d][c] - u * in->e[d] + along * out->e[d];
}

static void bound_ray_point(const struct bound_ray_row *row, size_t c)
{
    struct bound_ray in = bound_ray_to(row, c, -0.5 * row->h), out = bound_ray_to(row, c, (row->layer + 0.5) * row->h);
    double p = row->p[0][c], far = row->far_p[c], Z = row->Z[c], u = bound_ray_along(row, &in, c, 0);
    double leaving = p + Z * u + bound_ray_onward(row, c);
    double entering = far + bound_ray_near(row, in.r, out.r, p - far, Z * u);
    row->to_p[c] = 0.5 * (leaving + entering);
    bound_ray_put(row, c, &in, &out, 0.5 * (leaving - entering) / Z);
}

void bound_ray_leave(const struct bound_ray_row *row)
{
    for (size_t c = 0; c < row->n; c++)
        if (row->outward * row->u[0][row->axis][c] < row->c_s[c]) bound_ray_point(row, c); /* else nothing comes back */
}

void bound_ray_flow(const struct bound_ray_row *row)
{
    for (size_t c = 0; c < row->n; c++) {
        struct bound_ray in = bound_ray_to(row, c, -0.5 * row->h);
        struct bound_ray out = bound_ray_to(row, c, (row->layer + 0.5) * row->h);
        bound_ray_put(row, c, &in, &out, bound_ray_fall(row, c, out.r));
    }
}
