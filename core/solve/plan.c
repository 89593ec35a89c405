/* plan.c - see plan.h. */
#include "solve/plan.h"

#include "solve/rkl.h"
#include "solve/stage_exchange.h"

static void plan_add(struct plan *plan, struct plan_step step)
{
    plan->step[plan->n++] = step;
}

/* Every stage exchanges and takes; the first one leaves the ghosts of finer levels, the last one is closed. */
static void plan_make(const struct tableau *tableau, struct plan *plan)
{
    static const char *const exchange = "send layers of primitives to neighbouring ranks";
    static const char *const ghosts =
        "with finer levels: what they see behind their edges at the beginning of the step";
    static const char *const close = "w = primitives of u, admissibility, signal speed for the next dt";
    static const char *const then[] = {": the terms below", ": the terms below; w = primitives of it, admissibility"};
    static const char *const slopes =
        ": of the cells alone [core/scheme/hancock.h]; the first steps: u* = u + dt/2 L(w)";
    plan->n = 0;
    for (int s = 0; s < tableau->n; s++) {
        const struct tableau_stage *stage = &tableau->stage[s];
        plan_add(plan, (struct plan_step){"exchange", "", exchange, stage_exchange_start, s});
        if (s == 0) plan_add(plan, (struct plan_step){"ghosts", "", ghosts, stage_exchange_ghosts, s});
        plan_add(plan, (struct plan_step){stage->name, stage->doc, stage->slopes ? slopes : then[s + 1 < tableau->n],
                                          stage_take, s});
    }
    plan_add(plan, (struct plan_step){"close", "", close, stage_close, tableau->n - 1});
}

const struct plan *plan_of(const struct tableau *tableau)
{
    static struct plan plan;
    static const struct tableau *made;
    if (made != tableau) plan_make(tableau, &plan);
    made = tableau;
    return &plan;
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

/* What L(w) is made of at the faces. */
static void plan_faces(const struct scene *scene, struct text *text)
{
    text_add(text, "L(w), tile by tile and axis by axis: gather %d layers of neighbours, reconstruction (%s with %s",
             scene->scheme.ghosts, scene->scheme.reconstruction.module->name, scene->scheme.limiter.module->name);
    if (scene->n_material > 1) text_add(text, "; alpha: %s", scene->scheme.interface_limiter.module->name);
    if (scene->scheme.slanted)
        text_add(text, " across surfaces, %s along", scene_instance_along(&scene->scheme)->module->name);
    text_add(text, "), states (");
    plan_laws(scene, text);
    text_add(text, "), fluxes (%s); then\n", scene->scheme.riemann.module->name);
}

/* What acts beside the terms. */
static void plan_operators(const struct model *model, enum operator_when when, const char *head, struct text *text)
{
    struct operators operators;
    operators_of(model, &operators);
    if (operators.n[when]) text_add(text, "%s", head);
    operators_say(model, when, text);
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
             scene->mesh.levels, scene->mesh.subcycle ? "two steps of half the size" : "one step",
             reflux[scene->mesh.reflux], scene->mesh.regrid_every, scene->mesh.n_refine);
}

/* Super steps of what diffuses. */
static void plan_super(const struct scene *scene, struct text *text)
{
    if (scene->scheme.diffusion != SCENE_DIFFUSION_RKL2) return;
    if (rkl_flows(scene))
        text_add(
            text,
            "where they bind, viscosity and conduction take half of a step of level 0 before it and half after it, "
            "on all levels\n  together, in 3 to %d stages of RKL2 with an exchange each  [core/solve/flow.c]\n",
            RKL_MOST);
    else
        text_add(text,
                 "where they bind, viscosity and conduction take part of each stage of their own: u' = u + tau L(w) of "
                 "the others as a\n  constant source of a flow through tau, in 3 to %d stages of RKL2 with an exchange "
                 "each  "
                 "[core/solve/rkl.c]\n",
                 RKL_MOST);
}

void plan_text(const struct model *model, struct text *ret_text)
{
    const struct scene *scene = model->scene;
    const struct tableau *tableau = tableau_of(scene);
    const struct plan *plan = plan_of(tableau);
    text_add(ret_text, "one step of %s (%s):\n", scene->mesh.levels ? "each level" : "level 0", tableau->doc);
    for (int i = 0; i < plan->n; i++) {
        const struct plan_step *step = &plan->step[i];
        text_add(ret_text, "  %d  %-8s  %s%s\n", i + 1, step->name, step->formula, step->doc);
    }
    plan_super(scene, ret_text);
    plan_faces(scene, ret_text);
    terms_say(model, ret_text);
    plan_operators(model, OPERATOR_STAGE, "after every stage, before its primitives:\n", ret_text);
    plan_operators(model, OPERATOR_BETWEEN, "after every stage but the last:\n", ret_text);
    plan_operators(model, OPERATOR_STEP, "after the last stage, before close:\n", ret_text);
    if (scene->mesh.levels) plan_levels(scene, ret_text);
    text_add(ret_text,
             "then: an inadmissible cell makes the step run again with first-order states and rusanov fluxes at its\n"
             "faces (3 rounds), then with half the time step (6 times), then the run stops with the place and cause\n");
}
