/* vortex.c - two fields from outside the tree that tell where a flow turns. Of the velocity gradient, S is the
 * symmetric part and W the other, q = (|W|^2 - |S|^2)/2       (Hunt, Wray & Moin, Center for Turbulence Research
 * CTR-S88, 1988), share = |W|^2/(|W|^2 + |S|^2 + floor)      (Liu, Wang, Yang & Duan, Sci. China 59 (2016) 684711): in
 * a vortex q > 0 and share > 1/2; a body that turns at w has q = w^2 and share 1. Around an axis (and a centre) S has
 * u_r/r, too. */
#include <bulla/field.h>

#include <stddef.h>
#include <stdlib.h>

enum { VORTEX_Q, VORTEX_SHARE };

/* |S|^2 and |W|^2 of one cell. */
static void vortex_parts(const struct bulla_points *cells, size_t i, double *strain, double *spin)
{
    double hoop = cells->beta ? cells->u[0][i] / cells->x[0][i] : 0.0;
    *strain = cells->beta * hoop * hoop;
    *spin = 0.0;
    for (int a = 0; a < 3; a++)
        for (int b = 0; b < 3; b++) {
            double g = cells->du[a][b][i], t = cells->du[b][a][i];
            *strain += 0.25 * (g + t) * (g + t);
            *spin += 0.25 * (g - t) * (g - t);
        }
}

static void vortex_compute(const void *self, const struct bulla_points *cells, double *const *values)
{
    const double *least = self;
    for (size_t i = 0; i < cells->n; i++) {
        double strain, spin;
        vortex_parts(cells, i, &strain, &spin);
        values[VORTEX_Q][i] = 0.5 * (spin - strain);
        values[VORTEX_SHARE][i] = spin / (spin + strain + *least);
    }
}

static const struct bulla_field_output vortex_outputs[] = {
    {"q", "1/s2", "Half of what the spin is above the strain, squared; above 0 in a vortex.", BULLA_FIELD_SIGNED},
    {"share", "1", "Share of the spin in the motion; above 1/2 in a vortex.",
     BULLA_FIELD_VANISHING | BULLA_FIELD_FRACTION},
    {0},
};

static const struct bulla_field vortex_table = {.size = sizeof(struct bulla_field),
                                                .needs = BULLA_FIELD_VELOCITY_SLOPES,
                                                .outputs = vortex_outputs,
                                                .compute = vortex_compute};

static const struct bulla_param vortex_params[] = {
    {"floor", "1/s2", 1e-300, 1e30, 1e-6, "motion that does not count: added below the share", BULLA_NUMBER, 0},
    {0},
};

static int vortex_open(const struct bulla_host *host, const struct bulla_value *values, void **ret_self)
{
    double *self = malloc(sizeof *self);
    if (!self) host->fail("out of memory");
    if (self) *self = values[0].number;
    *ret_self = self;
    return !self;
}

BULLA_EXPORT const struct bulla_module bulla_module = {
    .magic = BULLA_MAGIC,
    .abi = BULLA_ABI,
    .size = sizeof(struct bulla_module),
    .kind = "field",
    .name = "vortex",
    .version = "1.0",
    .doc = "Where a flow turns: the Q criterion, and the share of spin in the motion.",
    .cite = "Hunt, Wray & Moin, CTR-S88 (1988) 193-208; Liu, Wang, Yang & Duan, Sci. China Phys. 59 (2016) 684711",
    .params = vortex_params,
    .open = vortex_open,
    .close = free,
    .table = &vortex_table,
};
