/* muscl.c - limited slopes: the limiter does all the work. */
#include "bulla/reconstruction.h"

static void muscl_edges(const void *self, const struct bulla_limited *limited, size_t n, size_t step, const double *w,
                        double *BULLA_RESTRICT lower, double *BULLA_RESTRICT upper)
{
    (void)self;
    limited->edges(limited, n, step, w, lower, upper);
}

static const struct bulla_reconstruction muscl_table = {.size = sizeof(struct bulla_reconstruction),
                                                        .layers = 2,
                                                        .bounded = 1,
                                                        .edges = muscl_edges};

BULLA_EXPORT const struct bulla_module bulla_module = {
    .magic = BULLA_MAGIC,
    .abi = BULLA_ABI,
    .size = sizeof(struct bulla_module),
    .kind = "reconstruction",
    .name = "muscl",
    .version = "1.0",
    .doc =
        "Straight lines with the slopes of `limiter` and `interface-limiter`: second order, robust; the usual choice.",
    .cite = "van Leer, J. Comput. Phys. 32 (1979) 101-136",
    .table = &muscl_table,
};
