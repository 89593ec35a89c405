/* model.h - which fields exist and the laws behind them: built once from a scene.
 *
 * Conserved fields u, in this order: alpha_l (N of them, none if N = 1), m_l = alpha_l rho_l,
 * rho u_i (n_velocity), rho E, what solids remember (n_inner: m_l eps_l of those whose strength knows their plastic
 * strain eps, m_l D_l of those that can break, D their damage from 0 to 1) and the stretch V of each solid (n_stretch:
 * xx, yy, zz, then xy, then xz, yz, as far as n_velocity reaches), then as many more for each Maxwell branch of a
 * solid, which has a stretch of its own (scheme/viscoelastic.h). Last, for each pair of materials with surface tension,
 * the curvature of their interface in the cell, which is no conserved field but made anew from the fractions in every
 * stage (scheme/tension.h). Primitives w, same count: alpha_l, rho_l, u_i, p, eps_l and D_l, V, those of the branches,
 * kappa. For N = 1 m is rho.
 *
 * This folder, phys: materials at points: which fields there are, mixtures, elasticity, presence, relaxation.
 * Batches of points, no neighbours. */
#ifndef MODEL_H
#define MODEL_H

#include "bulla/conductivity.h"
#include "bulla/constitutive.h"
#include "bulla/damage.h"
#include "bulla/eos.h"
#include "bulla/inelastic.h"
#include "bulla/limiter.h"
#include "bulla/reconstruction.h"
#include "bulla/riemann.h"
#include "bulla/viscosity.h"
#include "case/scene.h"

#include <stdbool.h>

struct model_eos {
    const struct bulla_eos *law;
    const void *self;
    double rho_fill; /* density that stands in where the material is absent */
    double rho_most; /* the greatest density that the law states, at least rho_fill */
    bool stiffens;   /* far beyond it the law bears no state: pressures grow without bound, or nothing is stated */
};

/* The elastic law of one solid. */
struct model_solid {
    const struct bulla_constitutive *law;
    const void *self;
    unsigned material;                      /* index into the materials of the same model */
    unsigned stretch;                       /* first component of its stretch */
    const struct bulla_inelastic *strength; /* NULL: purely elastic */
    const void *strength_self;
    unsigned strain; /* field of its plastic strain; 0: it has none */
    unsigned needs;  /* enum bulla_inelastic_needs, of the strength */
    bool slack;      /* its law bears nothing, as in a Maxwell fluid: its stretch means nothing and stays 1 */
    struct model_damage {
        const struct bulla_damage *law; /* NULL: it never breaks */
        const void *self;
        unsigned field; /* of m D */
        unsigned needs; /* enum bulla_damage_needs */
        double time;    /* in which it breaks at the fastest [s]; 0: at once */
        bool opens;     /* where it breaks in tension, a void opens */
        unsigned gas;   /* that fills it: a material of the same model */
        double p, rho;  /* pressure and density of the gas in a new void [Pa, kg/m3] */
    } damage;
};

/* What a solid remembers beside its stretch, as a field that travels with its mass: m times the plastic strain or
 * damage. */
struct model_memory {
    unsigned solid, field; /* index into the solids of the same model */
    double most;           /* of what it remembers: 1 of damage */
};

/* A Maxwell branch of a solid: a neo-Hookean spring on a stretch of its own, e = k (I1 - 3), and a dashpot in a row. */
struct model_branch {
    unsigned solid; /* index into the solids of the same model */
    unsigned field; /* first component of its stretch */
    double k;       /* G/(2 rho0) [J/kg] */
    double time;    /* of relaxation [s] */
};

/* A number of a material, as bulla/coefficient.h says; law NULL: 0. */
struct model_coefficient {
    const struct bulla_coefficient *law;
    const void *self;
    double number; /* of a law that looks at nothing: what it says; of one that looks at the rate: the most */
};

/* How viscous one material is. */
struct model_viscosity {
    struct model_coefficient mu;
    const struct bulla_viscosity *law; /* NULL: not at all */
    double zeta;                       /* of a law that looks at nothing but the rate */
    double usual;                      /* mu at 300 K and 1 bar; of a law that looks at the rate the most [Pa s] */
    bool thick;                        /* at least MODEL_THICK, and not of the rate: scheme/viscous_face.h */
};

/* Thrice that of water at room temperature [Pa s]. */
#define MODEL_THICK 3e-3

/* How a material conducts heat. */
struct model_conductivity {
    const struct bulla_coefficient *law; /* NULL: not at all */
    const void *self;
    double k; /* of a law that looks at nothing [W/(m K)] */
};

/* Two materials with surface tension between them. */
struct model_pair {
    unsigned inside, outside; /* materials of the same model; the curvature is positive where they are that */
    unsigned i_kappa;         /* field of the curvature */
    double sigma;             /* [N/m] */
};

/* A liquid, its vapour and gases, which share a temperature and exchange mass (phys/phase.h). */
struct model_phase {
    unsigned n, member[SCENE_MATERIALS]; /* liquid, vapour, gases: materials of the same model */
    const struct scene_phase *scene;
};

/* Gases that diffuse through each other (scheme/fick.h). */
struct model_fick {
    unsigned n, member[SCENE_MATERIALS]; /* materials of the same model */
    const struct scene_fick *scene;
};

/* Most stretches a scene can have: of solids and of branches. */
enum { MODEL_STRETCHES = SCENE_MATERIALS + SCENE_BRANCHES };

/* Most evolved fields a scene can have: fractions, densities, velocities, energy, memories of solids, stretches,
 * normals, curvatures, slants. */
enum { MODEL_FIELDS = 4 * SCENE_MATERIALS + 3 + 1 + 6 * MODEL_STRETCHES + 3 + SCENE_PAIRS + 3 };

struct model {
    const struct scene *scene;
    int dim, beta;
    unsigned n_velocity;              /* >= dim */
    unsigned n_solid, n_stretch, i_V; /* components of one stretch, 0 in paths without a solid; first field of all
                                         stretches of the scene, be they of this path or not */
    struct model_solid solids[SCENE_MATERIALS];
    unsigned n_stretched; /* components of all of those */
    unsigned n_branch;
    struct model_branch branches[SCENE_BRANCHES];
    unsigned n_inner, i_inner; /* what the solids of the scene remember: first index */
    unsigned n_memory;         /* the same of this path */
    struct model_memory memories[2 * SCENE_MATERIALS];
    unsigned n_pair;
    struct model_pair pairs[SCENE_PAIRS];
    unsigned n_phase;
    struct model_phase phases[SCENE_PHASES];
    bool squeezed; /* some of them condense over cells (scheme/edges_squeeze.h) */
    bool fronts;   /* some of them evaporate at the end of their surface alone (scheme/shore.h) */
    bool reaches;  /* painted surfaces of pairs reach a trace beyond faces that they lie on (paint/paint.h) */
    unsigned n_fick;
    struct model_fick ficks[SCENE_PHASES];
    unsigned n_normal, i_normal; /* normals of the surfaces of solids (scheme/normal.h): dim, or 0 */
    unsigned n_slant, i_slant;   /* how surfaces lie to the axes (scheme/slant.h): dim, or 0 */
    unsigned n_material, n_alpha, n_field;
    unsigned i_alpha, i_m, i_u, i_E;         /* first index of each group; primitives: i_m holds rho_l, i_E holds p */
    unsigned n_active, active[MODEL_FIELDS]; /* components that evolve; all, but in a pure model */
    unsigned first;                          /* material of the scene that eos[0] is: 0, but in a pure model */
    bool mixed;                              /* the scene has several materials */
    bool elastic;                            /* the scene has a solid (this path need not) */
    bool tilted;                             /* the scene has normals (this path need not) */
    bool plastic;                            /* some solid of this path has a strength (flow.h) */
    bool aged;                               /* the scene has a plastic strain as a field */
    bool damaged;                            /* some solid of this path can break (damage.h) */
    struct model *pure[SCENE_MATERIALS];     /* the same scene where only material l is present (NULL for N = 1): one
                                            material, no fractions, indices into the same storage */
    struct model *fluids; /* the same scene where only its fluids are present; NULL without a solid, with less than two
                             fluids, with a viscous one, or if they do not stand together in the list of materials */
    bool kapila, linear;  /* linear: every law is linear in p, closed-form mixture pressure */
    bool thermal;         /* materials of a cell exchange volume in full: temperatures are meant (scheme/exchange.h) */
    bool conducts;        /* some material of the scene conducts heat (scheme/conduction.h) */
    bool forced;          /* forces act at faces, and pressure is reconstructed relative to them (scheme/face.h) */
    bool split;           /* the materials of a cell share their normal traction, not their pressure (traction.h) */
    bool lagged;          /* they have pressures of their own, by that or by surface tension */
    struct model_eos eos[SCENE_MATERIALS];
    struct model_viscosity viscosity[SCENE_MATERIALS];
    bool viscous; /* some material of the path is */
    bool calm;    /* faces beside strong shocks resist shear (scheme/calm.h) */
    /* What terms that look across edges see there: components of the primitives, the same in all paths of a scene. 0:
     * no term does. Fractions but the first, then velocities (viscous); pressure is the last (calm). */
    unsigned n_around, n_around_alpha;
    double colour[SCENE_MATERIALS]; /* what tells materials of the scene apart, by viscosity, less that of the first */
    unsigned i_around_rho,
        i_around_p; /* in it: densities of all materials and p, if viscosities of mixtures want them */
    unsigned char around[MODEL_FIELDS];
    struct model_conductivity conductivity[SCENE_MATERIALS];
    struct model_limiter {
        const struct bulla_limiter *law;
        const void *self;
    } limiter, limiter_alpha, limiter_along; /* of the primitives; of the volume fractions, across and along surfaces
                                                (scheme/slant.h) */
    const struct bulla_reconstruction *reconstruction;
    const void *reconstruction_self;
    const struct bulla_riemann *riemann;
    const void *riemann_self;
    bool resists;                       /* it diffuses jumps of u_t between fluids (bulla/riemann.h) */
    const struct bulla_riemann *robust; /* rusanov: faces of troubled cells (solve/guard.h) */
    char **names;                       /* derived field names, NULL-terminated (derive.h) */
    char **field_names;                 /* names of the evolved fields, for messages and ledgers */
};

/* Is component q a volume fraction of this path? */
static inline bool model_is_fraction(const struct model *model, unsigned q)
{
    return q - model->i_alpha < model->n_alpha; /* wraps below i_alpha */
}

/* Is material l a solid of this path? */
static inline bool model_is_solid(const struct model *model, unsigned l)
{
    for (unsigned s = 0; s < model->n_solid; s++)
        if (model->solids[s].material == l) return true;
    return false;
}

/* Number of fields that are made anew in every stage, the last ones: normals, curvatures and slants. */
static inline unsigned model_renewed(const struct model *model)
{
    return model->n_normal + model->n_pair + model->n_slant;
}

/* Number of active fields that faces see: all others. */
static inline unsigned model_edged(const struct model *model)
{
    return model->n_active - model_renewed(model);
}

/* Have the materials of a cell pressures that differ by what acts in their interface? */
static inline bool model_jumps(const struct model *path)
{
    return path->n_pair > 0;
}

/* Does matter turn around the axis, with a velocity u_th that is the third? Its momentum counts with a lever
 * (mesh/metric.h). */
static inline bool model_turns(const struct model *path)
{
    return path->beta == 1 && path->n_velocity == 3;
}

/* Is field or primitive q that velocity or its momentum? */
static inline bool model_is_turn(const struct model *path, unsigned q)
{
    return model_turns(path) && q == path->i_u + 2;
}

/* Do solids of a path draw upon each other where they meet (scheme/cling.h)? */
static inline bool model_clings(const struct model *path)
{
    return path->n_solid > 1 && path->n_velocity > 1 && path->n_alpha > 0 && !path->beta;
}

/* Has a path terms that look across edges? */
static inline bool model_looks_around(const struct model *path)
{
    return path->viscous || path->calm || path->fronts || path->n_normal > 0 || model_clings(path);
}

/* Number of stretches of a path: those of its solids, then those of the branches. */
static inline unsigned model_stretches(const struct model *model)
{
    return model->n_solid + model->n_branch;
}

/* First component of stretch k of a path. */
static inline unsigned model_stretch(const struct model *model, unsigned k)
{
    return k < model->n_solid ? model->solids[k].stretch : model->branches[k - model->n_solid].field;
}

/* Active fields of stretches: the last but those made anew, from active[model_drawn()] to active[model_edged()]. */
static inline unsigned model_drawn(const struct model *model)
{
    return model_edged(model) - model_stretches(model) * model->n_stretch;
}

/* Is component q one of a stretch? ret_component: xx, yy, ... */
static inline bool model_is_stretch(const struct model *model, unsigned q, unsigned *ret_component)
{
    bool is = model->n_stretch && q - model->i_V < model->n_stretched; /* wraps below i_V */
    *ret_component = is ? (q - model->i_V) % model->n_stretch : 0;
    return is;
}

/* The solid that stretch k of a path belongs to. */
static inline unsigned model_bearer(const struct model *model, unsigned k)
{
    return k < model->n_solid ? k : model->branches[k - model->n_solid].solid;
}

/* Does solid s carry stretch k of a path with its mass? */
static inline bool model_carries(const struct model *model, unsigned k, unsigned s)
{
    return model_bearer(model, k) == s && !(k == s && model->solids[s].slack);
}

/* Is component q what a solid remembers? */
static inline bool model_is_inner(const struct model *model, unsigned q)
{
    return q - model->i_inner < model->n_inner; /* wraps below i_inner */
}

/* Number of a path for files: -1 the scene's model, l its material l alone, SCENE_MATERIALS its fluids. */
static inline int model_number(const struct model *path)
{
    if (path->n_material == path->scene->n_material) return -1;
    return path->n_alpha ? SCENE_MATERIALS : (int)path->first;
}

/* The path of that number; NULL: there is none. */
static inline const struct model *model_numbered(const struct model *model, int number)
{
    if (number < 0) return model;
    return number == SCENE_MATERIALS ? model->fluids : number < (int)model->n_alpha ? model->pure[number] : NULL;
}

/* Components of symmetric tensors in the order of elastic.h: "xx", "yy", ... */
extern const char *const model_tensor[6];

struct model *model_new(const struct scene *scene);
void model_free(struct model *model);

#endif
