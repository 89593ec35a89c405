/* plan.c - see plan.h. */
#include "solve/plan.h"

const struct plan_stage *plan_stages(void)
{
    static const struct plan_stage stages[] = {
        {"exchange", "send layers of primitives to neighbouring ranks", stage_exchange},
        {"ghosts", "with finer levels: what they see behind their edges at the beginning of the step", stage_ghosts},
        {"half",
         "u* = u + dt/2 L(w): gather, reconstruction (%L), states (%E), fluxes (%R), divergence, closure (%C)%S;\n"
         "              w = primitives of u* at the mixture pressure, admissibility",
         stage_half},
        {"exchange", "send layers of primitives to neighbouring ranks", stage_exchange},
        {"full", "u = u + dt L(w): gather, reconstruction (%L), states (%E), fluxes (%R), divergence, closure (%C)%S",
         stage_full},
        {"close", "w = primitives of u, admissibility, signal speed for the next dt", stage_close},
        {NULL, NULL, NULL},
    };
    return stages;
}

static void plan_laws(const struct scene *scene, struct text *text)
{
    for (unsigned l = 0; l < scene->n_material; l++) {
        const struct scene_material *material = &scene->material[l];
        const struct bulla_module *solid = material->constitutive.module;
        text_add(text, "%s%s: %s%s%s", l ? ", " : "", material->name, material->eos.module->name, solid ? " + " : "",
                 solid ? solid->name : "");
    }
}

static void plan_line(const struct scene *scene, const char *doc, struct text *text)
{
    for (; *doc; doc++) {
        if (*doc != '%') {
            text_add_n(text, doc, 1);
            continue;
        }
        doc++;
        if (*doc == 'L') text_add(text, "%s with %s", scene->reconstruction.module->name, scene->limiter.module->name);
        if (*doc == 'L' && scene->n_material > 1) text_add(text, "; alpha: %s", scene->interface_limiter.module->name);
        if (*doc == 'R') text_add(text, "%s", scene->riemann.module->name);
        if (*doc == 'C')
            text_add(text, "%s",
                     scene->n_material < 2            ? "none: one material"
                     : scene->closure == SCENE_KAPILA ? "kapila"
                                                      : "allaire");
        if (*doc == 'E') plan_laws(scene, text);
        if (*doc == 'S' && scene->sources) {
            text_add(text, ", sources (");
            source_text(scene, text);
            text_add(text, ")");
        }
    }
}

/* How the steps of levels follow each other (advance.c, sync.c, regrid.c). */
static void plan_levels(const struct scene *scene, struct text *text)
{
    static const char *const reflux[] = {"fluxes of the finer level replace those of the coarser at its edges",
                                         "plain flux correction (for comparison)",
                                         "no flux correction (for comparison)"};
    text_add(text,
             "with %d levels above level 0:\n"
             "  after each step of a level the next finer one takes %s to the same time, its ghosts interpolated\n"
             "  in space (primitives, minmod) and time; then averages of the finer level, and %s;\n"
             "  every %d steps of a level the finer ones get new tiles from %u criteria\n",
             scene->levels, scene->subcycle ? "two steps of half the size" : "one step", reflux[scene->reflux],
             scene->regrid_every, scene->n_refine);
}

void plan_text(const struct scene *scene, struct text *ret_text)
{
    const struct plan_stage *stages = plan_stages();
    text_add(ret_text, "one step of %s (explicit midpoint rule):\n", scene->levels ? "each level" : "level 0");
    for (int i = 0; stages[i].name; i++) {
        text_add(ret_text, "  %d  %-8s  ", i + 1, stages[i].name);
        plan_line(scene, stages[i].doc, ret_text);
        text_add(ret_text, "\n");
    }
    if (scene->levels) plan_levels(scene, ret_text);
    text_add(ret_text,
             "then: an inadmissible cell makes the step run again with first-order states and rusanov fluxes at its\n"
             "faces (3 rounds), then with half the time step (6 times), then the run stops with the place and cause\n");
}
