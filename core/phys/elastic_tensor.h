/* elastic_tensor.h - symmetric 3 x 3 tensors at one point, for the kernels of elastic*.c.
 *
 * Kernels are written once with the number of velocity components as a constant: 1 (diagonal), 2 (one shear
 * component) or 3. Components that a scene does not have are the constant 0 and cost nothing. */
#ifndef ELASTIC_TENSOR_H
#define ELASTIC_TENSOR_H

#include <stddef.h>

/* The body of a kernel, compiled into each instance of it. */
#define ELASTIC_BODY inline __attribute__((always_inline))

/* Calls KERNEL(1, ...), (2, ...) or (3, ...). */
#define ELASTIC_CHOOSE(n_velocity, kernel, ...)              \
    do {                                                     \
        if ((n_velocity) == 1) kernel##_1(__VA_ARGS__);      \
        else if ((n_velocity) == 2) kernel##_2(__VA_ARGS__); \
        else kernel##_3(__VA_ARGS__);                        \
    } while (0)

/* Components that a scene with so many velocities has: 3, 4 or 6. */
static inline unsigned elastic_tensor_count(unsigned n_velocity)
{
    return n_velocity == 1 ? 3 : n_velocity == 2 ? 4 : 6;
}

struct elastic_tensor {
    double xx, yy, zz, xy, xz, yz;
};

/* Rows of the components; those of unused ones point at any row. */
struct elastic_rows {
    const double *row[6];
};

static inline struct elastic_rows elastic_tensor_rows(const double *V, size_t stride, unsigned count)
{
    struct elastic_rows rows;
    for (unsigned c = 0; c < 6; c++) rows.row[c] = V + (c < count ? c : 0) * stride;
    return rows;
}

/* Declares the rows of a tensor as locals of a kernel, so that loops need not look them up. */
#define ELASTIC_LOCAL(rows)                                                                                      \
    const double *restrict v_xx = (rows).row[0], *restrict v_yy = (rows).row[1], *restrict v_zz = (rows).row[2]; \
    const double *restrict v_xy = (rows).row[3], *restrict v_xz = (rows).row[4], *restrict v_yz = (rows).row[5]

/* The tensor at point i of those rows. */
#define ELASTIC_AT(i, nv)                                                                          \
    ((struct elastic_tensor){v_xx[i], v_yy[i], v_zz[i], (nv) > 1 ? v_xy[(nv) > 1 ? (i) : 0] : 0.0, \
                             (nv) > 2 ? v_xz[(nv) > 2 ? (i) : 0] : 0.0, (nv) > 2 ? v_yz[(nv) > 2 ? (i) : 0] : 0.0})

/* t t for a symmetric t. */
static ELASTIC_BODY struct elastic_tensor elastic_tensor_square(struct elastic_tensor t)
{
    return (struct elastic_tensor){t.xx * t.xx + t.xy * t.xy + t.xz * t.xz, t.xy * t.xy + t.yy * t.yy + t.yz * t.yz,
                                   t.xz * t.xz + t.yz * t.yz + t.zz * t.zz, t.xx * t.xy + t.xy * t.yy + t.xz * t.yz,
                                   t.xx * t.xz + t.xy * t.yz + t.xz * t.zz, t.xy * t.xz + t.yy * t.yz + t.yz * t.zz};
}

static ELASTIC_BODY double elastic_tensor_trace(struct elastic_tensor t)
{
    return t.xx + t.yy + t.zz;
}

/* t : t */
static ELASTIC_BODY double elastic_tensor_norm2(struct elastic_tensor t)
{
    return (t.xx * t.xx + t.yy * t.yy + t.zz * t.zz) + 2.0 * (t.xy * t.xy + t.xz * t.xz + t.yz * t.yz);
}

static ELASTIC_BODY double elastic_tensor_det(struct elastic_tensor t)
{
    double minor = t.xx * t.yy - t.xy * t.xy;
    return t.zz * minor + (2.0 * t.xy * t.xz * t.yz - t.xx * t.yz * t.yz - t.yy * t.xz * t.xz);
}

/* det t t^-1, the gradient of det. */
static ELASTIC_BODY struct elastic_tensor elastic_tensor_cofactors(struct elastic_tensor t)
{
    return (struct elastic_tensor){t.yy * t.zz - t.yz * t.yz, t.xx * t.zz - t.xz * t.xz, t.xx * t.yy - t.xy * t.xy,
                                   t.xz * t.yz - t.xy * t.zz, t.xy * t.yz - t.yy * t.xz, t.xy * t.xz - t.xx * t.yz};
}

/* d^(-1/3) by rounds of the series of (1 - e)^(-1/3) with e = 1 - d x^3: four are right to round-off for 1/8 < d < 8,
 * two to 1e-8 for 1 <= d < 2. Farther out x comes nearer by each. */
static ELASTIC_BODY double elastic_tensor_per_root(double d, int rounds)
{
    double x = 2.0 / (1.0 + d);
    for (int round = 0; round < rounds; round++) {
        double e = 1.0 - d * x * x * x;
        x = x * (1.0 + e * (1.0 / 3.0 + e * (2.0 / 9.0 + e * (14.0 / 81.0))));
    }
    return x;
}

/* Two Newton steps towards the nearest tensor of det 1, along the gradient of det: what a mean of stretches has too
 * much of volume is taken off the smallest ones, which bear least. Scaling would take it off all
 * (docs/decisions/solid-gradient.md). */
static ELASTIC_BODY struct elastic_tensor elastic_tensor_nearest(struct elastic_tensor t)
{
    for (int round = 0; round < 2; round++) {
        struct elastic_tensor C = elastic_tensor_cofactors(t);
        double det = t.zz * C.zz + (t.xz * C.xz + t.yz * C.yz), k = (det - 1.0) / elastic_tensor_norm2(C);
        t = (struct elastic_tensor){t.xx - k * C.xx, t.yy - k * C.yy, t.zz - k * C.zz,
                                    t.xy - k * C.xy, t.xz - k * C.xz, t.yz - k * C.yz};
    }
    return t;
}

#endif
