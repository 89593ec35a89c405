/* work.c - see work.h. */
#include "solve/work.h"

#include "base/mem.h"
#include "scheme/shore.h"
#include "solve/tableau.h"

static void work_add_terms(struct work *work, const struct model *path, struct face_work *faces)
{
    if (!path) return;
    work->terms[model_number(path) + 1] = terms_new(path, faces);
    operators_of(path, &work->operators[model_number(path) + 1]);
}

struct work *work_new(const struct model *model, const struct mesh *mesh)
{
    struct work *work = mem_new(1, sizeof *work);
    work->model = model;
    work->faces = face_new(model);
    if (model->mixed) work->faces_pure = face_new(model->pure[model->elastic ? model->solids[0].material : 0]);
    if (model->fluids) work->faces_fluids = face_new(model->fluids);
    work_add_terms(work, model, work->faces);
    work_add_terms(work, model->fluids, work->faces_fluids);
    for (unsigned l = 0; l < model->n_alpha; l++) work_add_terms(work, model->pure[l], work->faces_pure);
    terms_open(&(struct term_room){.model = model, .mesh = mesh}, work->own);
    work->prolong = prolong_new(model, mesh);
    work->around = around_new(model, mesh);
    work->curve = curve_new(model, mesh);
    if (tableau_slopes(tableau_of(model->scene))) work->hancock = hancock_new(model, mesh);
    work->rates = mem_new(work->terms[0]->n_rates * mesh->n_cell, sizeof(double));
    work->K = mem_new(model->n_material * mesh->n_cell, sizeof(double));
    work->rho_c2 = mem_new(model->n_material * mesh->n_cell, sizeof(double));
    work->c2 = mem_new(mesh->n_cell, sizeof(double));
    work->u_star = mem_new(model->n_field * mesh->n_cell, sizeof(double));
    if (model->plastic && model->damaged) work->grown = mem_new(model->n_solid * mesh->n_cell, sizeof(double));
    if (model->fronts) work->shore = mem_new(shore_room(model, mesh), sizeof *work->shore);
    return work;
}

void work_free(struct work *work)
{
    if (!work) return;
    for (unsigned i = 0; i < SCENE_MATERIALS + 2; i++) terms_free(work->terms[i]);
    terms_close(work->own);
    face_free(work->faces);
    face_free(work->faces_pure);
    face_free(work->faces_fluids);
    prolong_free(work->prolong);
    around_free(work->around);
    curve_free(work->curve);
    hancock_free(work->hancock);
    mem_free(work->rates);
    mem_free(work->K);
    mem_free(work->rho_c2);
    mem_free(work->c2);
    mem_free(work->u_star);
    mem_free(work->grown);
    mem_free(work->shore);
    mem_free(work);
}

const struct terms *work_terms(const struct work *work, const struct model *path)
{
    return work->terms[model_number(path) + 1];
}

const struct operators *work_operators(const struct work *work, const struct model *path)
{
    return &work->operators[model_number(path) + 1];
}
