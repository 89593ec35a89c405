/* impedance.c - a wall from outside the tree that gives way: what it bears and how fast it moves are in proportion,
 *     p - p_0 = Z_w (u - u_0),
 * u along the outward normal, 0: the start of the run. A plane wave in the fluid, whose p + Z u arrives at the wall as
 * it left the cell inside, makes of it u - u_0 = (p_i - p_0 + Z (u_i - u_0))/(Z + Z_w),      Z = rho c, and comes back
 * with the part R = (Z_w - Z)/(Z_w + Z) of its pressure (Kinsler, Frey, Coppens & Sanders, Fundamentals of Acoustics,
 * 2000, section 6.2). Z_w = 0 gives way to everything, Z_w >> Z is rigid, Z_w = Z lets waves leave. The wall moves in
 * its place, as in linear acoustics: what it makes room for goes through the face. */
#include <bulla/boundary.h>

#include <stddef.h>
#include <stdlib.h>

static BULLA_KERNEL void impedance_rows(size_t n, double wall, const double *restrict p, const double *restrict u,
                                        const double *restrict Z, const double *restrict p_start,
                                        const double *restrict u_start, double *restrict p_behind,
                                        double *restrict u_behind)
{
#pragma omp simd
    for (size_t i = 0; i < n; i++) {
        double yields = (p[i] - p_start[i] + Z[i] * (u[i] - u_start[i])) / (Z[i] + wall);
        p_behind[i] = p_start[i] + wall * yields;
        u_behind[i] = u_start[i] + yields;
    }
}

static void impedance_fill(const void *self, const struct bulla_behind *faces)
{
    const double *wall = self;
    impedance_rows(faces->n, *wall, faces->p, faces->u[0], faces->Z, faces->p_start, faces->u_start, faces->p_behind,
                   faces->u_behind[0]);
}

static const struct bulla_boundary impedance_table = {.size = sizeof(struct bulla_boundary),
                                                      .traits = BULLA_BEHIND_REFERS | BULLA_BEHIND_OPEN |
                                                                BULLA_BEHIND_ISENTROPIC,
                                                      .fill = impedance_fill};

static const struct bulla_param impedance_params[] = {
    {"impedance", "Pa s/m", 0.0, 1e12, 1.5e6, "pressure per velocity of the wall, Z_w", BULLA_NUMBER, 0},
    {0},
};

static const double impedance_pvc[] = {3.27e6}, impedance_steel[] = {45.7e6};
static const struct bulla_preset impedance_presets[] = {
    {"pvc", "a thick wall of polyvinyl chloride, 1380 kg/m3 and 2370 m/s", impedance_pvc},
    {"steel", "a thick wall of steel, 7850 kg/m3 and 5820 m/s", impedance_steel},
    {0},
};

static int impedance_open(const struct bulla_host *host, const struct bulla_value *values, void **ret_self)
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
    .kind = "boundary",
    .name = "impedance",
    .version = "1.0",
    .doc =
        "A wall whose velocity is in proportion to the pressure on it. For linings, tubes and thick walls of another "
        "material.",
    .cite = "Kinsler, Frey, Coppens & Sanders, Fundamentals of Acoustics, 2000, section 6.2",
    .params = impedance_params,
    .presets = impedance_presets,
    .open = impedance_open,
    .close = free,
    .table = &impedance_table,
};
