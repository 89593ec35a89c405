/* trouble.c - limiters that do worse than being wrong, for tests/program/module_check.sh. Built with -DTROUBLE=n:
 * 1 ends the process while it is loaded, 2 crashes in its function, 3 calls exit there, 4 never comes
 * back, 5 refuses the end of a range without a reason. */
#include <bulla/limiter.h>

#include <math.h>
#include <stdlib.h>

static void trouble_slope(const void *self, size_t n, const double *BULLA_RESTRICT d_minus,
                          const double *BULLA_RESTRICT d_plus, double *BULLA_RESTRICT slope)
{
    volatile double *nowhere = NULL;
    volatile int again = 1;
    const int bad = fabs(d_minus[0]) > 10.0; /* not yet when it is opened and tried with small numbers */
    (void)self;
    if (TROUBLE == 2 && bad) *nowhere = d_minus[0];
    if (TROUBLE == 3 && bad) exit(0);
    while (TROUBLE == 4 && bad && again) again = 1;
    for (size_t i = 0; i < n; i++) slope[i] = d_minus[i] * d_plus[i] > 0.0 ? d_minus[i] : 0.0;
}

__attribute__((constructor)) static void trouble_begin(void)
{
    if (TROUBLE == 1) abort();
}

static int trouble_open(const struct bulla_host *host, const struct bulla_value *values, void **ret_self)
{
    (void)host;
    *ret_self = NULL;
    return TROUBLE == 5 && values[0].number > 1.0;
}

static const struct bulla_limiter trouble_table = {.size = sizeof(struct bulla_limiter), .slope = trouble_slope};

static const struct bulla_param trouble_params[] = {
    {"amount", "1", 0.0, 2.0, 1.0, "how much trouble", BULLA_NUMBER, 0},
    {0},
};

BULLA_EXPORT const struct bulla_module bulla_module = {
    .magic = BULLA_MAGIC,
    .abi = BULLA_ABI,
    .size = sizeof(struct bulla_module),
    .kind = "limiter",
    .name = "trouble",
    .version = "0.1",
    .doc = "A limiter for tests.",
    .cite = "nobody",
    .params = trouble_params,
    .open = trouble_open,
    .table = &trouble_table,
};
