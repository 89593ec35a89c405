/* hllc_release.c - HLLC whose signals are slower where a surface lets go of pressure (wave.h). For fluids. */
#define CONTACT_SPEEDS wave_davis
#define CONTACT_SHEAR 0
#define CONTACT_SLOW 0
#define CONTACT_RELEASE 1
#include "contact.h"

#include <string.h>

/* Jumps of fractions that count in full. */
#define RELEASE_ALIEN 0.01

/* How unlike the mixtures of both sides are, 0 to 1; material by material. */
BULLA_KERNEL static void hllc_release_alien(size_t n, const double *restrict alpha_l, const double *restrict alpha_r,
                                            double *restrict alien)
{
#pragma omp simd
    for (size_t i = 0; i < n; i++) {
        double most = alien[i], jump = fabs(alpha_r[i] - alpha_l[i]) * (1.0 / RELEASE_ALIEN);
        jump = jump < 1.0 ? jump : 1.0;
        alien[i] = jump > most ? jump : most;
    }
}

static void hllc_release_solve(const void *self, const struct bulla_faces *faces)
{
    (void)self;
    memset(faces->work[3], 0, faces->n * sizeof(double));
    for (unsigned l = 0; l < faces->n_alpha; l++)
        hllc_release_alien(faces->n, faces->left.alpha[l], faces->right.alpha[l], faces->work[3]);
    contact_solve(faces);
}

static const struct bulla_riemann hllc_release_table = {.size = sizeof(struct bulla_riemann),
                                                        .solve = hllc_release_solve};

BULLA_EXPORT const struct bulla_module bulla_module = {
    .magic = BULLA_MAGIC,
    .abi = BULLA_ABI,
    .size = sizeof bulla_module,
    .kind = "riemann",
    .name = "hllc-release",
    .version = "1.0",
    .doc =
        "HLLC whose signals are slower where strong rarefactions leave a surface: liquids of 100 MPa and more beside "
        "light gas. Elsewhere, and in one material, it is hllc, bitwise. For fluids.",
    .cite = "Toro, Spruce & Speares, Shock Waves 4 (1994) 25-34; the speed of the released wave: "
            "docs/decisions/cut-cells.md",
    .table = &hllc_release_table,
};
