/* cubic_open.h - instances of the laws of cubic_tabled.h: the keys of their table, and the table in a block that is
 * made and measured once per machine (`share` of bulla/module.h). */
#ifndef CUBIC_OPEN_H
#define CUBIC_OPEN_H

#include "cubic_tabled.h"
#include "cubic_thermal.h"

/* Behind a law's own parameters. */
enum { CUBIC_EVAL, CUBIC_INTERPOLATION, CUBIC_SIZE };

#define CUBIC_TABLED_PARAMS                                                                                        \
    {"eval", "1", 0.0, 0.0, 0.0, "the law itself, or a table of it", BULLA_CHOICE, "analytic|table"},              \
        {"interpolation", "1", 0.0, 0.0, 0.0, "between the nodes of the table", BULLA_CHOICE, "bicubic|bilinear"}, \
    {                                                                                                              \
        "table-size", "1", 8.0, 512.0, 128.0, "nodes of the table in each direction", BULLA_NUMBER, NULL           \
    }
#define CUBIC_TABLED_AIR 0.0, 0.0, 128.0

/* What fills the block. */
struct cubic_making {
    const struct cubic *law;
    size_t n;
    int bicubic;
};

/* Nodes, then errors. */
static int cubic_open_fill(void *context, void *block, unsigned phase, unsigned part, unsigned parts)
{
    const struct cubic_making *making = context;
    struct cubic_table table = cubic_table_in(making->law, making->n, making->bicubic, block);
    if (phase == 0) cubic_table_build(making->law, &table, part, parts);
    else cubic_table_errors(making->law, &table, part, parts);
    return 0;
}

/* Makes or finds the table and says what it is worth. */
static int cubic_open_table(const struct bulla_host *host, struct cubic_tabled *self, const char *name,
                            const struct bulla_value *values)
{
    int bicubic = strcmp(values[CUBIC_INTERPOLATION].text, "bicubic") == 0;
    size_t n = (size_t)values[CUBIC_SIZE].number, bytes = cubic_table_bytes(n, bicubic);
    struct cubic_making making = {&self->law, n, bicubic};
    double worst[3], *block = NULL;
    char text[200];
    if (BULLA_HOST_HAS(host, share)) block = (double *)host->share("grid", bytes, 2, cubic_open_fill, &making);
    else host->fail("this table needs a bulla that shares memory between ranks");
    if (!block) return 1;
    self->table = cubic_table_in(&self->law, n, bicubic, block);
    cubic_table_worst(&self->table, worst);
    snprintf(text, sizeof text,
             "%s: table of %zu x %zu nodes, %.2g MiB, %s: largest errors of T %.1e, of p(rho, e) %.1e, of c %.1e", name,
             n, n, (double)bytes / 1048576.0, bicubic ? "bicubic" : "bilinear", worst[0], worst[1], worst[2]);
    host->say(text);
    return 0;
}

/* Opens the law `par`; `values`: of CUBIC_TABLED_PARAMS. */
static int cubic_tabled_open(const struct bulla_host *host, struct cubic par, const char *name,
                             const struct bulla_value *values, void **ret_self)
{
    void *self = NULL;
    if (cubic_rows_open(host, par, sizeof(struct cubic_tabled), &self)) return 1;
    if (values[CUBIC_EVAL].text && strcmp(values[CUBIC_EVAL].text, "table") == 0 &&
        cubic_open_table(host, self, name, values)) {
        free(self);
        return 1;
    }
    *ret_self = self;
    return 0;
}

#define CUBIC_TABLED_FUNCTIONS                                                                                   \
    {                                                                                                            \
        .size = sizeof(struct bulla_eos), .state = cubic_tabled_state, .derivatives = cubic_tabled_derivatives,  \
        .temperature = cubic_tabled_temperature, .entropy = cubic_rows_entropy, .density = cubic_tabled_density, \
        .p_min = cubic_rows_p_min, .range = cubic_rows_range, .energy = cubic_tabled_energy,                     \
        .count_outside = cubic_rows_count_outside, .thermal = cubic_thermal, .gas_constant = cubic_thermal_gas   \
    }

#endif
