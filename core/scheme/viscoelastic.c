/* viscoelastic.c - see viscoelastic.h.
 *
 * Relaxation F and motion A make a step F(dt/6) A(dt/2) F(2 dt/3) A(dt/2) F(dt/6), or in short ones F(dt/2) A(dt)
 * F(dt/2), of second order (phys/flow_relax.h). F is exact, so a step may be longer than tau. What flows in through the
 * faces is that of the middle of the step, and is added in the middle. */
#include "scheme/viscoelastic.h"

#include "base/mem.h"
#include "phys/flow_relax.h"
#include "scheme/strain.h"
#include "scheme/terms.h"

#include <string.h>

static bool viscoelastic_wanted(const struct model *path)
{
    return path->n_branch > 0;
}

static void viscoelastic_list(struct terms *terms, int axis, unsigned first, const struct face_work *faces)
{
    const struct model *model = terms->model;
    (void)first;
    for (unsigned b = 0; b < model->n_branch; b++)
        strain_carry(terms, axis, model->n_solid + b, faces ? faces->stretch : NULL);
}

/* Room for the stretch of one branch of a tile. */
static void *viscoelastic_open(const struct term_room *room)
{
    return mem_new(room->model->n_stretch * room->mesh->n_cell, sizeof(double));
}

static size_t viscoelastic_apply(const struct term_tile *tile, double *u_new)
{
    const struct model *model = tile->model;
    size_t n_cell = tile->n_cell;
    double *half = tile->own;
    for (unsigned b = 0; b < model->n_branch; b++) {
        const struct model_branch *branch = &model->branches[b];
        struct flow_relax_parts parts = flow_relax_split(tile->dt / branch->time);
        memcpy(half, tile->u + branch->field * n_cell, model->n_stretch * n_cell * sizeof *half);
        flow_relax(model, n_cell, n_cell, parts.ends, half);
        strain_move(tile, model->n_solid + b, parts.middle, half, u_new);
        flow_relax(model, n_cell, n_cell, parts.ends, u_new + branch->field * n_cell);
    }
    return 0;
}

static void viscoelastic_say(const struct scene *scene, struct text *text)
{
    const char *comma = ": ";
    for (unsigned l = 0; l < scene->n_material; l++)
        for (unsigned b = 0; b < scene->material[l].n_branch; b++) {
            text_add(text, "%s%s tau = %g s", comma, scene->material[l].name, scene->material[l].branch[b].time);
            comma = ", ";
        }
}

const struct term viscoelastic_term = {
    .name = "branches",
    .owner = "core/scheme/viscoelastic.c",
    .equation = "dV_b/dt = -u.grad V_b + (L V_b)_sym-part - dev B_b V_b/(2 tau); its work is heat",
    .wanted = viscoelastic_wanted,
    .list = viscoelastic_list,
    .open = viscoelastic_open,
    .close = mem_free,
    .apply = viscoelastic_apply,
    .say = viscoelastic_say,
};
