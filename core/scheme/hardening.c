/* hardening.c - see hardening.h. */
#include "scheme/hardening.h"

#include "scheme/terms.h"

static bool hardening_wanted(const struct model *path)
{
    return path->n_memory > 0;
}

static void hardening_list(struct terms *terms, int axis, unsigned first, const struct face_work *faces)
{
    const struct model *model = terms->model;
    (void)first;
    for (unsigned k = 0; k < model->n_memory; k++) {
        unsigned q = model->memories[k].field;
        const double *row = faces && faces->strains ? faces->strains + (q - model->i_inner) * FACE_ROOM : NULL;
        terms_flux(terms, axis, (struct term_flux){.below = row, .above = row, .rate = q}, model->field_names[q], "");
    }
}

/* The new fields are among those that convection.c makes: u + dt rate. */
const struct term hardening_term = {
    .name = "hardening",
    .owner = "core/scheme/hardening.c",
    .equation = "d(m_l eps_l)/dt = -div(eps F_l), F_l the mass flux of the solid; of damage the same",
    .wanted = hardening_wanted,
    .list = hardening_list,
};
