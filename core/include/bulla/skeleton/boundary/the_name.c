/* the_name.c - a piston: a wall that moves at a given velocity, without leaving its place.
 *
 * The cells behind the face mirror those inside, seen from the wall: the mean of both velocities is that of the wall.
 * What the wall covers or sets free goes through the face; so its way must be short beside everything else. Yours may
 * be anything that keeps to bulla/boundary.h: finite behind any state, and true to what its traits say. `bulla module
 * check` tests all of that. */
#include <bulla/boundary.h>

#include <stdlib.h>

/* One instance: what `open` makes of the values in a case. */
struct the_name_values {
    double velocity, rise;
};

/* The outputs hold what is inside already: here only the velocity along the normal, u[0], differs. It points
 * outwards. */
static void the_name_fill(const void *self, const struct bulla_behind *faces)
{
    const struct the_name_values par = *(const struct the_name_values *)self;
    double part = faces->t < par.rise ? faces->t / par.rise : 1.0;
    double outwards = -par.velocity * part;
    const double *u = faces->u[0];
    double *behind = faces->u_behind[0];
    for (size_t i = 0; i < faces->n; i++) behind[i] = 2.0 * outwards - u[i];
}

/* MIRRORS: asked for each layer, with the cell that lies as far inside. DRIVES: moves what is at rest. */
static const struct bulla_boundary the_name_table = {.size = sizeof(struct bulla_boundary),
                                                     .traits = BULLA_BEHIND_MIRRORS | BULLA_BEHIND_DRIVES,
                                                     .fill = the_name_fill};

/* The keys of a case: name, SI unit, least, most, default (NAN: must be given), one sentence.
 * `open` gets the values in this order. */
enum { VELOCITY, RISE };

static const struct bulla_param the_name_params[] = {
    {"velocity", "m/s", -1e4, 1e4, 1.0, "velocity of the piston, into the domain", BULLA_NUMBER, 0},
    {"rise", "s", 0.0, 1e6, 0.0, "time in which it comes to that velocity", BULLA_NUMBER, 0},
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
    self->velocity = values[VELOCITY].number;
    self->rise = values[RISE].number;
    *ret_self = self;
    return 0;
}

BULLA_EXPORT const struct bulla_module bulla_module = {
    .magic = BULLA_MAGIC,
    .abi = BULLA_ABI,
    .size = sizeof(struct bulla_module),
    .kind = "boundary",
    .name = "the-name",
    .version = "0.1",
    .doc = "Say what lies behind the face. Say when to use it.",
    .cite = "paper and equation",
    .params = the_name_params,
    .open = the_name_open,
    .close = free,
    .table = &the_name_table,
};
