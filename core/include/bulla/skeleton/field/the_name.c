/* the_name.c - two fields of one module: the pressure that a stream would have if it were stopped, as in a liquid, and
 * how fast matter swells.
 *
 *     head = p - p_ref + rho |u|^2 / 2,      dilatation = div u
 * Yours may be anything that keeps to bulla/field.h: finite in any state, each cell for itself. `bulla module check`
 * tests all of that. */
#include <bulla/field.h>

#include <stdlib.h>

enum { HEAD, DILATATION };

/* One instance: what `open` makes of the values in a case. */
struct the_name_values {
    double reference;
};

static double the_name_head(const struct bulla_points *cells, double reference, size_t i)
{
    double rho = 0.0, square = 0.0;
    for (uint32_t l = 0; l < cells->n_material; l++) rho += cells->alpha[l][i] * cells->rho[l][i];
    for (uint32_t d = 0; d < cells->n_velocity; d++) square += cells->u[d][i] * cells->u[d][i];
    return cells->p[i] - reference + 0.5 * rho * square;
}

/* Around an axis or a centre what moves outwards spreads, too. */
static double the_name_dilatation(const struct bulla_points *cells, size_t i)
{
    double sum = cells->du[0][0][i] + cells->du[1][1][i] + cells->du[2][2][i];
    return cells->beta ? sum + cells->beta * cells->u[0][i] / cells->x[0][i] : sum;
}

static void the_name_compute(const void *self, const struct bulla_points *cells, double *const *values)
{
    const struct the_name_values par = *(const struct the_name_values *)self;
    for (size_t i = 0; i < cells->n; i++) {
        values[HEAD][i] = the_name_head(cells, par.reference, i);
        values[DILATATION][i] = the_name_dilatation(cells, i);
    }
}

/* `fields: {NAME: {type: the-name}}` makes NAME_head and NAME_dilatation of these; of one output without a suffix,
 * NAME. */
static const struct bulla_field_output the_name_outputs[] = {
    {"head", "Pa", "Pressure of the stream when it is stopped.", 0},
    {"dilatation", "1/s", "Divergence of the velocity.", BULLA_FIELD_SIGNED},
    {0},
};

static const struct bulla_field the_name_table = {.size = sizeof(struct bulla_field),
                                                  .needs = BULLA_FIELD_VELOCITY_SLOPES,
                                                  .outputs = the_name_outputs,
                                                  .compute = the_name_compute};

/* The keys of a case: name, SI unit, least, most, default (NAN: must be given), one sentence.
 * `open` gets the values in this order. */
enum { REFERENCE };

static const struct bulla_param the_name_params[] = {
    {"reference", "Pa", -1e12, 1e12, 0.0, "pressure that is taken off", BULLA_NUMBER, 0},
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
    self->reference = values[REFERENCE].number;
    *ret_self = self;
    return 0;
}

BULLA_EXPORT const struct bulla_module bulla_module = {
    .magic = BULLA_MAGIC,
    .abi = BULLA_ABI,
    .size = sizeof(struct bulla_module),
    .kind = "field",
    .name = "the-name",
    .version = "0.1",
    .doc = "Say what the fields are. Say what they are good for.",
    .cite = "paper and equation",
    .params = the_name_params,
    .open = the_name_open,
    .close = free,
    .table = &the_name_table,
};
