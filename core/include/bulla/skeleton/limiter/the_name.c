/* the_name.c - a slope limiter: the mean of the two differences, at most `steepness` times the smaller one.
 *
 * steepness 1 is minmod, 2 is MC. Of two differences a, b of the same sign, with |a| <= |b|:
 *     slope = sign(a) min(steepness |a|, (|a| + |b|)/2).
 * Yours may be any function that keeps to bulla/limiter.h: 0 where the signs differ, at most twice the smaller
 * difference, odd, symmetric, and a where both are a. `bulla module check` tests all of that. */
#include <bulla/limiter.h>

#include <math.h>
#include <stdlib.h>

/* One instance: what `open` makes of the values in a case. */
struct the_name_values {
    double steepness;
};

/* One pair. Both sides are computed and one is selected at the end: so a row of them becomes vectors. */
static inline double the_name_limit(double steepness, double a, double b)
{
    double size_a = fabs(a), size_b = fabs(b);
    double less = size_a < size_b ? size_a : size_b, mean = 0.5 * (size_a + size_b), most = steepness * less;
    double size = most < mean ? most : mean;
    int one_way = ((a > 0.0) == (b > 0.0)) & (less > 0.0);
    return copysign(one_way ? size : 0.0, a);
}

BULLA_KERNEL static void the_name_slope(const void *self, size_t n, const double *BULLA_RESTRICT d_minus,
                                        const double *BULLA_RESTRICT d_plus, double *BULLA_RESTRICT slope)
{
    const double steepness = ((const struct the_name_values *)self)->steepness;
#pragma omp simd
    for (size_t i = 0; i < n; i++) slope[i] = the_name_limit(steepness, d_minus[i], d_plus[i]);
}

/* Optional: both edge values of a cell in one pass instead of three. Bit by bit what `slope` gives. */
BULLA_KERNEL static void the_name_edges(const void *self, size_t n, size_t step, const double *w,
                                        double *BULLA_RESTRICT lower, double *BULLA_RESTRICT upper)
{
    const double steepness = ((const struct the_name_values *)self)->steepness;
    const double *before = w - step, *after = w + step;
#pragma omp simd
    for (size_t i = 0; i < n; i++) {
        double here = w[i], half = 0.5 * the_name_limit(steepness, here - before[i], after[i] - here);
        lower[i] = here - half;
        upper[i] = here + half;
    }
}

static const struct bulla_limiter the_name_table = {.size = sizeof(struct bulla_limiter),
                                                    .slope = the_name_slope,
                                                    .edges = the_name_edges};

/* The keys of a case: name, SI unit, least, most, default (NAN: must be given), one sentence. */
static const struct bulla_param the_name_params[] = {
    {"steepness", "1", 1.0, 2.0, 1.5, "most that a slope may be of the smaller difference", BULLA_NUMBER, 0},
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
    self->steepness = values[0].number;
    *ret_self = self;
    return 0;
}

BULLA_EXPORT const struct bulla_module bulla_module = {
    .magic = BULLA_MAGIC,
    .abi = BULLA_ABI,
    .size = sizeof(struct bulla_module),
    .kind = "limiter",
    .name = "the-name",
    .version = "0.1",
    .doc = "Say what the limiter does. Say what it is good for.",
    .cite = "paper and equation",
    .params = the_name_params,
    .open = the_name_open,
    .close = free,
    .table = &the_name_table,
};
