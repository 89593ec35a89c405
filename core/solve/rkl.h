/* rkl.h - super time steps of what diffuses: `scheme: {diffusion: rkl2}`.
 *
 * Viscosity and conduction ask for steps of h^2, sound for steps of h. Where the first are the shorter ones, each stage
 * of the integrator from u over tau, u' = u + tau L(w), becomes a flow through tau, dY/dt = M(Y) + S,   Y(0) = u,   S =
 * (u' - u)/tau, M what diffuses, L all the rest: what that has made of u is a constant source. (A multirate midpoint
 * rule: of second order in time, and what the two parts hold in balance stays so, which split steps do not promise.)
 * The flow is taken by s stages of RKL2 (Meyer, Balsara & Aslam, J. Comput. Phys. 257 (2014) 594-626), with z = Y - u -
 * c S tau, z_1 = mu~_1 tau M(u), z_j = mu_j z_j-1 + nu_j z_j-2 + mu~_j tau M(Y_j-1) + gamma~_j tau M(u), b_j = (j^2 + j
 * - 2)/(2 j (j + 1)), b_0 = b_1 = b_2 = 1/3,   w = 4/(s^2 + s - 2), mu_j = (2j - 1)/j b_j/b_j-1,  nu_j = -(j - 1)/j
 * b_j/b_j-2,  mu~_j = mu_j w,  mu~_1 = b_1 w,  gamma~_j = -(1 - b_j-1) mu~_j, at the times c_j tau, c_j = (j^2 + j -
 * 2)/(s^2 + s - 2), c_1 = c_2/4. They are stable up to tau lambda = (s^2 + s - 2)/2: s goes with the root of what
 * explicit steps would number. It is counted in each step, from the fastest cell of all ranks.
 *
 * Each stage is an exchange and a gathering like those of the step; boundaries are asked at its time. An attempt begins
 * from u_old; nothing of one that fails is left. On one level and with one material (docs/decisions/super-steps.md);
 * several levels, or materials, go by
 * solve/flow.h. */
#ifndef RKL_H
#define RKL_H

#include "solve/stage.h"

enum { RKL_MOST = 63 }; /* stages: beyond, the time step gives in */

/* Stages of a flow that is as long as so many explicit steps: odd, from 3 to RKL_MOST; 0: the integrator bears it. */
int rkl_stages(double steps);

/* Of scenes with rkl2: does what diffuses flow before and after each step (flow.h), and not within its stages? */
bool rkl_flows(const struct scene *scene);

/* The part of a flow of s stages that explicit steps could be as long as: bounds that go by the step go by it. */
double rkl_bears(int s);

/* What of the pace of explicit steps remains with super steps of RKL_MOST stages. */
double rkl_relief(void);

/* The coefficients of stage j of s, and when it ends, in tau. */
struct rkl_stage {
    double mu, nu, mu_tilde, gamma_tilde, at;
};
struct rkl_stage rkl_stage(int s, int j);

/* Memory of a level. Between steps it holds nothing. */
struct rkl {
    int s[TABLEAU_STAGES];   /* stages of each stage of the integrator; 0: none */
    double *z, *before, *M0; /* [n_local][n_field][n_cell]: z_j-1 and z_j-2, M(u) */
    double *half; /* [n_local][n_velocity + 1][n_cell]: of z in the middle of a flow; NULL: the scene has none */
    size_t block; /* doubles of a tile */
    int j;        /* stage under way: it makes z_j */
};

/* Doubles of a tile in struct rkl, half. */
size_t rkl_half(const struct stage *stage);

/* z_1 = a M(u) of n values, and z_0 = 0 into `before`. */
void rkl_begin(size_t n, double a, const double *restrict M0, double *restrict z, double *restrict before);

/* z_j of n values takes the place of z_j-2, from M(Y_j-1). */
void rkl_go_on(size_t n, const struct rkl_stage *restrict stage, double tau, const double *restrict M0,
               const double *restrict M, const double *restrict z, double *restrict before);

/* Explicit steps that a time dt of a level stands for, from the fastest cell of all ranks. Collective. */
double rkl_steps(const struct stage *stage, double dt);

/* Memory of a level, or NULL: the scene takes explicit steps. */
struct rkl *rkl_new(const struct stage *stage);
void rkl_free(struct rkl *rkl);

/* Before an attempt: how many stages each stage of the integrator takes. Collective. */
void rkl_plan(struct stage *stage);

/* Does the step under way take super steps? */
bool rkl_acts(const struct stage *stage);

/* stage_take for steps that do. */
void rkl_take(struct stage *stage);

#endif
