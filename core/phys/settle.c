/* settle.c - see settle.h. Few cells are mixed: they are gathered into rows.
 *
 * A solid that flows resists a strain with rho_l c_l^2 alone, as s' hardly moves once it has reached the strength; one
 * that does not with its stiffness along n as well. With these slopes a few rounds of Newton's method converge. */
#include "phys/settle.h"

#include "base/mem.h"
#include "phys/bearing.h"
#include "phys/elastic.h"
#include "phys/flow.h"
#include "phys/mix.h"
#include "phys/traction.h"

#include <math.h>
#include <string.h>

enum { SETTLE_BATCH = 32, SETTLE_ROUNDS = 12 };

/* Volumes that change by less from round to round have arrived, as parts of the cell. */
#define SETTLE_ENOUGH 1e-11

/* Where surfaces lie as they like less solid than that in a cell takes no heat: dust in gas would boil. */
#define SETTLE_LEAST 1e-3

/* Volumes of a cell that are off by more together have gone astray. */
#define SETTLE_OFF 1e-3

/* No material loses more of its volume at once. */
#define SETTLE_MOST 0.5

struct settle {
    const struct model *model;
    bool flows;
    double dt;
    size_t n, cell[SETTLE_BATCH];
    double (*trial)[SETTLE_BATCH];           /* [n_field]: conserved fields that the cells came with */
    double (*u)[SETTLE_BATCH];               /* the same, strained */
    double (*w)[SETTLE_BATCH];               /* primitives: those of the trial, with densities and stretches of u */
    double p[SCENE_MATERIALS][SETTLE_BATCH]; /* pressures without strain and heat */
    double stiff[SCENE_MATERIALS][SETTLE_BATCH];
    double rho_c2[SCENE_MATERIALS][SETTLE_BATCH];
    double per_p[SCENE_MATERIALS][SETTLE_BATCH]; /* d(rho e)/dp */
    double x[SCENE_MATERIALS][SETTLE_BATCH];     /* strains along n */
    double pull[SCENE_MATERIALS][SETTLE_BATCH];  /* s'_nn */
    double heat[SETTLE_BATCH];                   /* energy that is left, per volume of the solids [J/m3] */
    double held[SETTLE_BATCH];                   /* what the cell holds, beside motion */
    double grown[SCENE_MATERIALS][SETTLE_BATCH]; /* of plastic strains */
    bool done[SETTLE_BATCH];                     /* has arrived, and stays, whoever else is in the batch */
    bool exact[SETTLE_BATCH];                    /* its volumes together stay what they are */
};

bool settle_wanted(const struct model *path)
{
    bool relaxes = path->n_branch && !path->n_normal;
    return (path->plastic || relaxes) && path->split && path->n_alpha;
}

bool settle_is(const struct model *model, size_t stride, const double *u)
{
    double solid = 0.0;
    for (unsigned s = 0; s < model->n_solid; s++) solid += u[(model->i_alpha + model->solids[s].material) * stride];
    return solid > (model->n_normal ? SETTLE_LEAST : MIX_ABSENT) && solid < 1.0 - settle_trace(model);
}

/* alpha of a material; 0: it is not there. */
static double settle_part(const struct settle *settle, unsigned l, size_t i)
{
    double alpha = settle->u[settle->model->i_alpha + l][i];
    return alpha > MIX_ABSENT && settle->u[settle->model->i_m + l][i] > ELASTIC_NOTHING ? alpha : 0.0;
}

/* Densities, stretches and s'_nn of the solids at u. */
static void settle_pull(struct settle *settle)
{
    const struct model *model = settle->model;
    for (unsigned l = 0; l < model->n_alpha; l++)
        for (size_t i = 0; i < settle->n; i++) {
            double alpha = settle_part(settle, l, i);
            settle->w[model->i_m + l][i] = alpha > 0.0 ? settle->u[model->i_m + l][i] / alpha : model->eos[l].rho_fill;
        }
    for (unsigned i = model_drawn(model); i < model_edged(model); i++)
        memcpy(settle->w[model->active[i]], settle->u[model->active[i]], settle->n * sizeof **settle->w);
    traction_own(model, settle->n, SETTLE_BATCH, settle->w[0], SETTLE_BATCH, settle->pull[0]);
}

/* p_l less what the strain takes off: of a gas that is compressed to little more than by a small strain. */
static double settle_pressure(const struct settle *settle, unsigned l, size_t i)
{
    double x = settle->x[l][i];
    return settle->p[l][i] - settle->rho_c2[l][i] * (x < 0.0 ? x / (1.0 + x) : x);
}

/* The energy that is left for the solids when fluids have what their pressures ask for. */
static void settle_heat(struct settle *settle)
{
    const struct model *model = settle->model;
    double p[SETTLE_BATCH], rho_e[SETTLE_BATCH], rho_c2[SETTLE_BATCH], elastic[SETTLE_BATCH], solid[SETTLE_BATCH] = {0};
    double left[SCENE_MATERIALS * SETTLE_BATCH];
    const double *m[SCENE_MATERIALS];
    for (unsigned s = 0; s < model->n_solid; s++) m[s] = settle->u[model->i_m + model->solids[s].material];
    bearing_of_conserved(model, settle->n, SETTLE_BATCH, settle->u[0], SETTLE_BATCH, left, m);
    elastic_energy(model, settle->n, SETTLE_BATCH, settle->u[model->i_V], m, elastic);
    for (size_t i = 0; i < settle->n; i++) settle->heat[i] = settle->held[i] - elastic[i];
    for (unsigned l = 0; l < model->n_alpha; l++) {
        bool is = model_is_solid(model, l);
        for (size_t i = 0; i < settle->n; i++) p[i] = settle_pressure(settle, l, i);
        model->eos[l].law->state(model->eos[l].self, settle->n, settle->w[model->i_m + l], p, rho_e, rho_c2);
        for (size_t i = 0; i < settle->n; i++) {
            double alpha = settle_part(settle, l, i);
            settle->heat[i] -= alpha > 0.0 ? alpha * rho_e[i] : 0.0;
            solid[i] += is ? alpha : 0.0;
        }
    }
    for (size_t i = 0; i < settle->n; i++) settle->heat[i] /= solid[i];
}

/* The trial, strained by x along n; it flows. */
static void settle_strain(struct settle *settle)
{
    const struct model *model = settle->model;
    static const double none[9][SETTLE_BATCH];
    double one[SETTLE_BATCH], squeeze[SETTLE_BATCH], slope[3][SETTLE_BATCH];
    memcpy(settle->u, settle->trial, model->n_field * sizeof *settle->u);
    for (size_t i = 0; i < settle->n; i++) one[i] = 1.0;
    for (unsigned d = 0; d < 3; d++)
        for (size_t i = 0; i < settle->n; i++)
            slope[d][i] = d < model->n_normal ? settle->trial[model->i_normal + d][i] : d == 0 && !model->n_normal;
    for (unsigned l = 0; l < model->n_alpha; l++)
        for (size_t i = 0; i < settle->n; i++) settle->u[model->i_alpha + l][i] *= 1.0 + settle->x[l][i];
    for (unsigned k = 0; k < model_stretches(model); k++) {
        unsigned l = model->solids[model_bearer(model, k)].material, first = model_stretch(model, k);
        for (size_t i = 0; i < settle->n; i++) squeeze[i] = -settle->x[l][i];
        const struct elastic_rates rates = {.carried = none[0],
                                            .m_old = one,
                                            .m_new = one,
                                            .div = none[0],
                                            .gradient = none[0],
                                            .squeeze = squeeze,
                                            .slope = slope[0]};
        elastic_advance(model, settle->n, SETTLE_BATCH, 1.0, settle->trial[first], &rates, settle->u[first]);
        elastic_unimodular(model, settle->n, SETTLE_BATCH, settle->u[first]);
    }
    memset(settle->grown, 0, sizeof settle->grown);
    if (settle->flows)
        flow_return(model, settle->n, SETTLE_BATCH, settle->dt, settle->w[0], settle->u[0], settle->grown[0]);
}

/* The traction of material l, with its sign changed. */
static double settle_push(const struct settle *settle, unsigned l, size_t i)
{
    double own = settle_pressure(settle, l, i) - settle->pull[l][i];
    return model_is_solid(settle->model, l) ? own + settle->heat[i] / settle->per_p[l][i] : own;
}

/* The weight of a strain, which is one of the trial's volume. With the volumes of now their sum is kept to first order
 * only, which is kind to shells (docs/decisions/shells.md), and lets a film of gas go astray. */
static double settle_share(const struct settle *settle, unsigned l, size_t i)
{
    double alpha = settle_part(settle, l, i);
    return alpha > 0.0 && settle->exact[i] ? settle->trial[settle->model->i_alpha + l][i] : alpha;
}

/* One cell towards one traction, unless it has arrived there: the volumes would hardly change. */
static void settle_cell(struct settle *settle, size_t i)
{
    const struct model *model = settle->model;
    double give = 0.0, sum = 0.0, step[SCENE_MATERIALS], scale = 1.0, most = 0.0;
    for (unsigned l = 0; l < model->n_alpha; l++) {
        double alpha = settle_share(settle, l, i), K = settle->stiff[l][i];
        if (!(alpha > 0.0 && K > 0.0)) continue;
        give += alpha / K;
        sum += alpha / K * settle_push(settle, l, i);
    }
    for (unsigned l = 0; l < model->n_alpha; l++) {
        double alpha = settle_share(settle, l, i), K = settle->stiff[l][i];
        step[l] = alpha > 0.0 && K > 0.0 ? (settle_push(settle, l, i) - sum / give) / K : 0.0;
        double room = SETTLE_MOST + settle->x[l][i], part = room / -step[l];
        scale = step[l] < 0.0 && part < scale ? part : scale;
    }
    for (unsigned l = 0; l < model->n_alpha; l++) {
        double moved = fabs(scale * step[l]) * settle->trial[model->i_alpha + l][i];
        most = moved > most ? moved : most;
    }
    settle->done[i] = !(most > SETTLE_ENOUGH);
    for (unsigned l = 0; l < model->n_alpha && !settle->done[i]; l++) settle->x[l][i] += scale * step[l];
}

/* What the laws say of the trial at p. */
static void settle_ask(struct settle *settle)
{
    const struct model *model = settle->model;
    double none[SETTLE_BATCH];
    for (unsigned l = 0; l < model->n_alpha; l++) {
        const struct model_eos *eos = &model->eos[l];
        const double *rho = settle->w[model->i_m + l];
        eos->law->state(eos->self, settle->n, rho, settle->p[l], none, settle->rho_c2[l]);
        eos->law->derivatives(eos->self, settle->n, rho, settle->p[l], settle->per_p[l], none);
    }
}

/* What the cells hold beside motion. */
static void settle_hold(struct settle *settle)
{
    const struct model *model = settle->model;
    for (size_t i = 0; i < settle->n; i++) {
        double rho = 0.0, twice = 0.0;
        for (unsigned l = 0; l < model->n_material; l++) rho += settle->trial[model->i_m + l][i];
        for (unsigned q = model->i_u; q < model->i_E; q++) twice += settle->trial[q][i] * settle->trial[q][i];
        settle->held[i] = settle->trial[model->i_E][i] - 0.5 * twice / rho;
    }
}

static void settle_rounds(struct settle *settle)
{
    size_t left = settle->n;
    for (int round = 0; round < SETTLE_ROUNDS && left > 0; round++) {
        settle_strain(settle);
        settle_pull(settle);
        settle_heat(settle);
        left = 0;
        for (size_t i = 0; i < settle->n; i++) {
            if (!settle->done[i]) settle_cell(settle, i);
            left += !settle->done[i];
        }
    }
}

/* Have the volumes of a cell not stayed what they were, together? Then it begins again. */
static bool settle_astray(struct settle *settle, size_t i)
{
    double off = 0.0;
    for (unsigned l = 0; l < settle->model->n_alpha; l++)
        off += settle->u[settle->model->i_alpha + l][i] - settle->trial[settle->model->i_alpha + l][i];
    if (fabs(off) <= SETTLE_OFF) return false;
    for (unsigned l = 0; l < settle->model->n_alpha; l++) settle->x[l][i] = 0.0;
    settle->exact[i] = true;
    settle->done[i] = false;
    return true;
}

/* From the trial, of which p, stiff and rho_c2 are known, to u. */
static void settle_search(struct settle *settle)
{
    bool again = false;
    memset(settle->x, 0, sizeof settle->x);
    memset(settle->done, 0, sizeof settle->done);
    memset(settle->exact, 0, sizeof settle->exact);
    settle_hold(settle);
    settle_rounds(settle);
    for (size_t i = 0; i < settle->n; i++) {
        settle->done[i] = true;
        again = settle_astray(settle, i) || again;
    }
    if (again) settle_rounds(settle);
}

static void settle_gather(struct settle *settle, size_t stride, const double *from, double (*to)[SETTLE_BATCH])
{
    const struct model *model = settle->model;
    for (unsigned a = 0; a < model->n_active; a++) {
        unsigned q = model->active[a];
        for (size_t i = 0; i < settle->n; i++) to[q][i] = from[q * stride + settle->cell[i]];
    }
}

static void settle_scatter(const struct settle *settle, size_t stride, double *u)
{
    const struct model *model = settle->model;
    for (unsigned a = 0; a < model->n_active; a++) {
        unsigned q = model->active[a];
        for (size_t i = 0; i < settle->n; i++) u[q * stride + settle->cell[i]] = settle->u[q][i];
    }
}

/* The next cells that are mixed, from `from` on; returns where to go on. */
static size_t settle_find(struct settle *settle, size_t from, size_t n, size_t stride, const double *u)
{
    settle->n = 0;
    for (; from < n && settle->n < SETTLE_BATCH; from++)
        if (settle_is(settle->model, stride, u + from)) settle->cell[settle->n++] = from;
    return from;
}

/* Work space; NULL: there is no such cell. */
static struct settle *settle_new(const struct model *model, bool flows, double dt, size_t n, size_t stride,
                                 const double *u)
{
    bool any = false;
    for (size_t i = 0; i < n && !any; i++) any = settle_is(model, stride, u + i);
    if (!any) return NULL;
    struct settle *settle = mem_new(1, sizeof *settle);
    settle->trial = mem_new(3 * (size_t)model->n_field, sizeof *settle->trial);
    settle->u = settle->trial + model->n_field;
    settle->w = settle->u + model->n_field;
    settle->model = model;
    settle->flows = flows;
    settle->dt = dt;
    return settle;
}

static void settle_free(struct settle *settle)
{
    mem_free(settle->trial);
    mem_free(settle);
}

/* Pressures of solids that have the traction of the fluids. */
static void settle_follow(struct settle *settle)
{
    const struct model *model = settle->model;
    for (size_t i = 0; i < settle->n; i++) {
        double sum = 0.0, all = 0.0;
        for (unsigned l = 0; l < model->n_alpha; l++) {
            double alpha = model_is_solid(model, l) ? 0.0 : settle_part(settle, l, i);
            sum += alpha > 0.0 ? alpha * settle->p[l][i] : 0.0;
            all += alpha;
        }
        for (unsigned s = 0; s < model->n_solid; s++) {
            unsigned l = model->solids[s].material;
            settle->p[l][i] = sum / all + settle->pull[l][i];
        }
    }
}

void settle_fluids(const struct model *model, size_t n, size_t stride, const double *p, const double *stiff, double *u)
{
    struct settle *settle = settle_new(model, false, 0.0, n, stride, u);
    if (!settle) return;
    for (size_t from = settle_find(settle, 0, n, stride, u); settle->n;
         from = settle_find(settle, from, n, stride, u)) {
        settle_gather(settle, stride, u, settle->trial);
        memcpy(settle->u, settle->trial, model->n_field * sizeof *settle->u);
        memcpy(settle->w, settle->trial, model->n_field * sizeof *settle->w);
        for (unsigned l = 0; l < model->n_alpha; l++)
            for (size_t i = 0; i < settle->n; i++) {
                settle->p[l][i] = p[l * stride + settle->cell[i]];
                settle->stiff[l][i] = stiff[l * stride + settle->cell[i]];
            }
        settle_pull(settle);
        settle_follow(settle);
        settle_ask(settle);
        settle_search(settle);
        settle_scatter(settle, stride, u);
    }
    settle_free(settle);
}

void settle_flow(const struct model *model, size_t n, size_t stride, double dt, const double *w, double *u,
                 double *grown)
{
    struct traction_pressures parts;
    struct settle *settle = settle_new(model, true, dt, n, stride, u);
    if (!settle) return;
    for (size_t from = settle_find(settle, 0, n, stride, u); settle->n;
         from = settle_find(settle, from, n, stride, u)) {
        settle_gather(settle, stride, u, settle->trial);
        settle_gather(settle, stride, w, settle->w);
        traction_part(model, settle->n, SETTLE_BATCH, settle->w[0], &parts);
        for (unsigned l = 0; l < model->n_alpha; l++)
            memcpy(settle->p[l], traction_pressure(model, settle->n, l, settle->w[model->i_E], &parts),
                   settle->n * sizeof **settle->p);
        memcpy(settle->u, settle->trial, model->n_field * sizeof *settle->u);
        settle_pull(settle);
        settle_ask(settle);
        memcpy(settle->stiff, settle->rho_c2, sizeof settle->stiff);
        settle_search(settle);
        settle_scatter(settle, stride, u);
        for (unsigned s = 0; grown && s < model->n_solid; s++)
            for (size_t i = 0; i < settle->n; i++) grown[s * stride + settle->cell[i]] = settle->grown[s][i];
    }
    settle_free(settle);
}
