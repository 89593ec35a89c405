/* the_name.c - how a solid breaks: at a stretch, in a time of its own.
 *
 *     aim = 1 where the largest principal stretch is at least `stretch`, rate = 1/duration
 * Yours may look at tension, the largest stress or stretch, elastic energy, equivalent stress, plastic strain, its rate
 * and temperature, and says in `needs` at which; core does the tensors, lets the damage grow and turns what it frees
 * into heat. It keeps to bulla/damage.h: aims from 0 to 1, rates that are not negative, and what is pulled harder does
 * not break later. `bulla module check` tests all of that. */
#include <bulla/damage.h>

#include <math.h>
#include <stdlib.h>

/* One instance: what `open` makes of the values in a case. */
struct the_name_values {
    double stretch, rate;
};

static void the_name_grow(const void *self, size_t n, const struct bulla_damage_state *state,
                          double *BULLA_RESTRICT aim, double *BULLA_RESTRICT rate)
{
    const struct the_name_values par = *(const struct the_name_values *)self;
    for (size_t i = 0; i < n; i++) {
        aim[i] = state->stretch[i] >= par.stretch ? 1.0 : 0.0;
        rate[i] = par.rate;
    }
}

/* What it looks at: the rows of all else are zeros. */
static uint32_t the_name_needs(const void *self)
{
    (void)self;
    return BULLA_DAMAGE_STRETCH;
}

static const struct bulla_damage the_name_table = {.size = sizeof(struct bulla_damage),
                                                   .grow = the_name_grow,
                                                   .needs = the_name_needs};

/* The keys of a case: name, SI unit, least, most, default (NAN: must be given), one sentence.
 * `open` gets the values in this order. The keys `time`, `opens`, `void-pressure` and `void-temperature` are core's. */
enum { STRETCH, DURATION };

static const struct bulla_param the_name_params[] = {
    {"stretch", "1", 1.0, 1e3, 1.2, "largest principal stretch that it bears", BULLA_NUMBER, 0},
    {"duration", "s", 1e-12, 1e3, 5e-6, "time in which it breaks beyond that", BULLA_NUMBER, 0},
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
    self->stretch = values[STRETCH].number;
    self->rate = 1.0 / values[DURATION].number;
    *ret_self = self;
    return 0;
}

BULLA_EXPORT const struct bulla_module bulla_module = {
    .magic = BULLA_MAGIC,
    .abi = BULLA_ABI,
    .size = sizeof(struct bulla_module),
    .kind = "damage",
    .name = "the-name",
    .version = "0.1",
    .doc = "Say what the criterion is. Say what solid it is good for.",
    .cite = "paper and equation",
    .params = the_name_params,
    .open = the_name_open,
    .close = free,
    .table = &the_name_table,
};
