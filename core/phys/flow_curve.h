/* flow_curve.h - tensors at one point for the flows of flow.c and flow_relax.c, which move along one curve of B. */
#ifndef FLOW_CURVE_H
#define FLOW_CURVE_H

#include "phys/elastic_tensor.h"

#include <math.h>

static ELASTIC_BODY struct elastic_tensor flow_curve_deviator(struct elastic_tensor t)
{
    double mean = elastic_tensor_trace(t) / 3.0;
    return (struct elastic_tensor){t.xx - mean, t.yy - mean, t.zz - mean, t.xy, t.xz, t.yz};
}

static ELASTIC_BODY double flow_curve_product(struct elastic_tensor s, struct elastic_tensor t)
{
    return (s.xx * t.xx + s.yy * t.yy + s.zz * t.zz) + 2.0 * (s.xy * t.xy + s.xz * t.xz + s.yz * t.yz);
}

/* V from B, by the closed form of a plane or by Newton's method from a stretch with the same axes. */
static ELASTIC_BODY struct elastic_tensor flow_curve_root_plane(struct elastic_tensor B)
{
    double d = sqrt(B.xx * B.yy - B.xy * B.xy), per = 1.0 / sqrt((B.xx + B.yy) + 2.0 * d);
    return (struct elastic_tensor){(B.xx + d) * per, (B.yy + d) * per, sqrt(B.zz), B.xy * per, 0.0, 0.0};
}

static ELASTIC_BODY struct elastic_tensor flow_curve_root_line(struct elastic_tensor B)
{
    return (struct elastic_tensor){sqrt(B.xx), sqrt(B.yy), sqrt(B.zz), 0.0, 0.0, 0.0};
}

/* One step V <- (V + V^-1 B)/2 of commuting tensors. */
static ELASTIC_BODY struct elastic_tensor flow_curve_root_step(struct elastic_tensor V, struct elastic_tensor B)
{
    struct elastic_tensor C = elastic_tensor_cofactors(V);
    double half = 0.5 / elastic_tensor_det(V);
    double xy = C.xx * B.xy + C.xy * B.yy + C.xz * B.yz, yx = C.xy * B.xx + C.yy * B.xy + C.yz * B.xz;
    double xz = C.xx * B.xz + C.xy * B.yz + C.xz * B.zz, zx = C.xz * B.xx + C.yz * B.xy + C.zz * B.xz;
    double yz = C.xy * B.xz + C.yy * B.yz + C.yz * B.zz, zy = C.xz * B.xy + C.yz * B.yy + C.zz * B.yz;
    return (struct elastic_tensor){0.5 * V.xx + half * (C.xx * B.xx + C.xy * B.xy + C.xz * B.xz),
                                   0.5 * V.yy + half * (C.xy * B.xy + C.yy * B.yy + C.yz * B.yz),
                                   0.5 * V.zz + half * (C.xz * B.xz + C.yz * B.yz + C.zz * B.zz),
                                   0.5 * (V.xy + half * (xy + yx)),
                                   0.5 * (V.xz + half * (xz + zx)),
                                   0.5 * (V.yz + half * (yz + zy))};
}

/* V: before the flow; per: the part of V - 1 that is left at small strain. */
static ELASTIC_BODY struct elastic_tensor flow_curve_root_space(struct elastic_tensor V, struct elastic_tensor B,
                                                                double per)
{
    V = (struct elastic_tensor){1.0 + per * (V.xx - 1.0),
                                1.0 + per * (V.yy - 1.0),
                                1.0 + per * (V.zz - 1.0),
                                per * V.xy,
                                per * V.xz,
                                per * V.yz};
    return flow_curve_root_step(flow_curve_root_step(flow_curve_root_step(flow_curve_root_step(V, B), B), B), B);
}

#endif
