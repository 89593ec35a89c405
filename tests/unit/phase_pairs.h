/* phase_pairs.h - what the tests of phase change share: the pairs of the reference data as families of laws. */
#ifndef PHASE_PAIRS_H
#define PHASE_PAIRS_H

#include "../module/law.h"

#include "phys/equilibrium.h"

/* A pair of the references, by the presets that it is made of. */
struct phase_pair {
    const char *name, *module, *preset;
};

static const struct phase_pair phase_pairs[] = {
    {"sg-water-2004", "stiffened-gas", "water-2004"},
    {"sg-dodecane-2004", "stiffened-gas", "dodecane-2004"},
    {"nasg-water-2016", "nasg", "water-2016"},
    {"sg-water-2017", "stiffened-gas", "water-2017"},
};

enum { PHASE_PAIRS = sizeof phase_pairs / sizeof *phase_pairs };

/* Liquid, vapour, air. */
struct phase_laws {
    struct law law[3];
    struct equilibrium_family family;
};

static inline void phase_open(const struct phase_pair *pair, unsigned n, struct phase_laws *ret_laws)
{
    *ret_laws = (struct phase_laws){.law = {law_preset(pair->module, pair->preset),
                                            law_preset("ideal-gas", pair->preset), law_preset("ideal-gas", "air")}};
    ret_laws->family = (struct equilibrium_family){.n = n, .exchange = true, .mixing = true};
    for (unsigned k = 0; k < n; k++) {
        const struct law *law = &ret_laws->law[k];
        ret_laws->family.eos[k] =
            (struct model_eos){.law = law->eos, .self = law->instance.self, .rho_fill = 1.0, .rho_most = 1e4};
        ret_laws->family.R[k] = law->eos->gas_constant(law->instance.self);
    }
}

static inline void phase_close(struct phase_laws *laws)
{
    for (int k = 0; k < 3; k++) instance_done(&laws->law[k].instance);
}

/* The pair of that name; PHASE_PAIRS: there is none. */
static inline unsigned phase_find(const char *name)
{
    unsigned found = 0;
    while (found < PHASE_PAIRS && strcmp(phase_pairs[found].name, name) != 0) found++;
    return found;
}

#endif
