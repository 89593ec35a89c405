/* hardening.c - see hardening.h. */
#include "scheme/hardening.h"

#include "scheme/terms.h"

static bool hardening_wanted(const struct model *path)
{
    bool any = false;
    for (unsigned s = 0; s < path->n_solid; s++) any = any || path->solids[s].strain;
    return any;
}

static void hardening_list(struct terms *terms, int axis, unsigned first, const struct face_work *faces)
{
    const struct model *model = terms->model;
    (void)first;
    for (unsigned s = 0; s < model->n_solid; s++) {
        unsigned q = model->solids[s].strain;
        const double *row = faces && faces->strains ? faces->strains + (q - model->i_strain) * FACE_ROOM : NULL;
        if (q)
            terms_flux(terms, axis, (struct term_flux){.below = row, .above = row, .rate = q}, model->field_names[q],
                       "");
    }
}

/* The new fields are among those that convection.c makes: u + dt rate. */
const struct term hardening_term = {
    .name = "hardening",
    .owner = "core/scheme/hardening.c",
    .equation = "d(m_l eps_l)/dt = -div(eps F_l), F_l the mass flux of the solid",
    .wanted = hardening_wanted,
    .list = hardening_list,
};
