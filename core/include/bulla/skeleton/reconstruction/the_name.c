/* the_name.c - a reconstruction: the parabola through a cell and its two neighbours, limited.
 *
 * With the differences a and b to the two neighbours, of the same sign, the parabola is at the upper edge
 * w + (a + 2 b)/6 and at the lower one w - (2 a + b)/6; neither edge may be further from w than `most` times the
 * smaller difference (Koren's limiter for `most` = 1). That keeps the promise `bounded` of bulla/reconstruction.h. A
 * scheme that looks at two cells on each side says `.layers = 3`; one that may overshoot says nothing of bounds, and
 * core looks at its edges; one that needs all components at once has the function `all`. `bulla module check` tests the
 * contract. */
#include <bulla/reconstruction.h>

#include <math.h>
#include <stdlib.h>

/* One instance: what `open` makes of the values in a case. */
struct the_name_values {
    double most;
};

/* From a cell to the edge on the side of `b`. Both ways out are computed and one is selected at the end: so a row of
 * them becomes vectors. Odd: with -a and -b the result is minus the result, to the bit. */
static inline double the_name_step(double most, double a, double b)
{
    double size_a = fabs(a), size_b = fabs(b), less = size_a < size_b ? size_a : size_b;
    double parabola = (size_a + 2.0 * size_b) / 6.0, limit = most * less;
    double size = parabola < limit ? parabola : limit;
    int one_way = ((a > 0.0) == (b > 0.0)) & (less > 0.0);
    return copysign(one_way ? size : 0.0, a);
}

/* One component: n cells, whose neighbours along the axis are `step` away. */
BULLA_KERNEL static void the_name_edges(const void *self, const struct bulla_limited *limited, size_t n, size_t step,
                                        const double *w, double *BULLA_RESTRICT lower, double *BULLA_RESTRICT upper)
{
    const double most = ((const struct the_name_values *)self)->most;
    const double *before = w - step, *after = w + step;
    (void)limited; /* the slopes of the case's limiter: limited->edges(limited, ...) */
#pragma omp simd
    for (size_t i = 0; i < n; i++) {
        double here = w[i], a = here - before[i], b = after[i] - here;
        lower[i] = here - the_name_step(most, b, a);
        upper[i] = here + the_name_step(most, a, b);
    }
}

static const struct bulla_reconstruction the_name_table = {.size = sizeof(struct bulla_reconstruction),
                                                           .layers = 2,
                                                           .bounded = 1,
                                                           .edges = the_name_edges};

/* The keys of a case: name, SI unit, least, most, default (NAN: must be given), one sentence. */
static const struct bulla_param the_name_params[] = {
    {"most", "1", 0.5, 1.0, 1.0, "most that an edge may be away, of the smaller difference", BULLA_NUMBER, 0},
    {0},
};

/* To refuse values that the table cannot: host->fail("why"); return 1. */
static int the_name_open(const struct bulla_host *host, const struct bulla_value *values, void **ret_self)
{
    struct the_name_values *self = malloc(sizeof *self);
    if (!self) {
        host->fail("out of memory");
        return 1;
    }
    self->most = values[0].number;
    *ret_self = self;
    return 0;
}

BULLA_EXPORT const struct bulla_module bulla_module = {
    .magic = BULLA_MAGIC,
    .abi = BULLA_ABI,
    .size = sizeof(struct bulla_module),
    .kind = "reconstruction",
    .name = "the-name",
    .version = "0.1",
    .doc = "Say what the scheme does. Say what it is good for.",
    .cite = "paper and equation",
    .params = the_name_params,
    .open = the_name_open,
    .close = free,
    .table = &the_name_table,
};
