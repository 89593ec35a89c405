/* model_family.c - see model_family.h. */
#include "phys/model_family.h"

/* Families of the scene. */
static void model_family_phases(struct model *model)
{
    model->n_phase = model->scene->n_phase;
    for (unsigned k = 0; k < model->n_phase; k++) {
        const struct scene_phase *scene = &model->scene->phases[k];
        struct model_phase *phase = &model->phases[k];
        model->fronts = model->fronts || scene->onset > 0.0;
        model->squeezed = model->squeezed || scene->over > 0.0;
        *phase = (struct model_phase){.n = 2, .member = {scene->liquid, scene->vapour}, .scene = scene};
        for (unsigned g = 0; g < scene->n_gas; g++) phase->member[phase->n++] = scene->gas[g];
    }
}

/* Those families that a narrowed model has all of. */
static void model_family_phase_narrow(const struct model *model, struct model *narrow)
{
    narrow->n_phase = 0;
    narrow->fronts = narrow->squeezed = false;
    for (unsigned k = 0; k < model->n_phase; k++) {
        struct model_phase phase = model->phases[k];
        bool all = true;
        for (unsigned i = 0; i < phase.n; i++) {
            phase.member[i] -= narrow->first; /* wraps where it stands before */
            all = all && phase.member[i] < narrow->n_alpha;
        }
        if (!all) continue;
        narrow->phases[narrow->n_phase++] = phase;
        narrow->fronts = narrow->fronts || phase.scene->onset > 0.0;
        narrow->squeezed = narrow->squeezed || phase.scene->over > 0.0;
    }
}

/* Mixtures of gases of the scene. */
static void model_family_ficks(struct model *model)
{
    model->n_fick = model->scene->n_fick;
    for (unsigned k = 0; k < model->n_fick; k++) {
        const struct scene_fick *scene = &model->scene->ficks[k];
        model->ficks[k] = (struct model_fick){.n = scene->n, .scene = scene};
        for (unsigned g = 0; g < scene->n; g++) model->ficks[k].member[g] = scene->gas[g];
    }
}

/* What of them a narrowed model has, if it has two gases. */
static void model_family_fick_narrow(const struct model *model, struct model *narrow)
{
    narrow->n_fick = 0;
    for (unsigned k = 0; k < model->n_fick; k++) {
        struct model_fick fick = {.scene = model->ficks[k].scene};
        for (unsigned i = 0; i < model->ficks[k].n; i++) {
            unsigned member = model->ficks[k].member[i] - narrow->first; /* wraps where it stands before */
            if (member < narrow->n_alpha) fick.member[fick.n++] = member;
        }
        if (fick.n > 1) narrow->ficks[narrow->n_fick++] = fick;
    }
}

void model_family_all(struct model *model)
{
    model_family_phases(model);
    model_family_ficks(model);
}

void model_family_narrow(const struct model *model, struct model *narrow)
{
    model_family_phase_narrow(model, narrow);
    model_family_fick_narrow(model, narrow);
}
