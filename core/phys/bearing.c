/* bearing.c - see bearing.h. */
#include "phys/bearing.h"

/* (1 - D)^2 m */
static BULLA_KERNEL void bearing_kernel(size_t n, const double *restrict D, const double *restrict m,
                                        double *restrict left)
{
#pragma omp simd
    for (size_t i = 0; i < n; i++) {
        double d = D[i], whole = 1.0 - (d > 0.0 ? d : 0.0);
        whole = whole > 0.0 ? whole : 0.0;
        left[i] = whole * whole * m[i];
    }
}

void bearing_reduce(size_t n, const double *restrict D, const double *restrict m, double *restrict left)
{
    bearing_kernel(n, D, m, left);
}

/* The same with m D at hand. */
static BULLA_KERNEL void bearing_reduce_mass(size_t n, const double *restrict amount, const double *restrict m,
                                             double *restrict left)
{
#pragma omp simd
    for (size_t i = 0; i < n; i++) {
        double mass = m[i], broken = amount[i], d = broken / mass;
        d = mass > ELASTIC_NOTHING ? d : 0.0;
        double whole = 1.0 - (d > 0.0 ? d : 0.0);
        whole = whole > 0.0 ? whole : 0.0;
        left[i] = whole * whole * mass;
    }
}

void bearing_of(const struct model *model, size_t n, size_t stride, const double *fields, size_t pitch, double *room,
                const double **m)
{
    for (unsigned s = 0; model->damaged && s < model->n_solid; s++) {
        double *left = room + s * pitch;
        if (!model->solids[s].damage.law) continue;
        bearing_reduce(n, fields + model->solids[s].damage.field * stride, m[s], left);
        m[s] = left;
    }
}

void bearing_of_conserved(const struct model *model, size_t n, size_t stride, const double *fields, size_t pitch,
                          double *room, const double **m)
{
    for (unsigned s = 0; model->damaged && s < model->n_solid; s++) {
        double *left = room + s * pitch;
        if (!model->solids[s].damage.law) continue;
        bearing_reduce_mass(n, fields + model->solids[s].damage.field * stride, m[s], left);
        m[s] = left;
    }
}
